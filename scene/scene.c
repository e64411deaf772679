#include "scene/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lrbni/base/hash.h"
#include "scene/vector.h"

base_status scene_create(const char *name, scene **out, base_error *err)
{
    scene *s = calloc(1, sizeof *s);
    *out = s;
    if (!s)
        return base_fail(err, BASE_ERR_NOMEM, name, "out of memory");
    snprintf(s->name, sizeof s->name, "%s", name);
    return BASE_OK;
}

void scene_destroy(scene **s)
{
    if (!s || !*s)
        return;
    free((*s)->triangles);
    free((*s)->triangle_material);
    free((*s)->materials);
    free((*s)->cameras);
    free(*s);
    *s = NULL;
}

/* Elements that an array of `count` has room for: a power of two, so that no capacity need be stored. */
static size_t room_for(size_t count)
{
    size_t room = 16;
    while (room < count)
        room *= 2;
    return count ? room : 0;
}

/* Make *array, which holds `count` elements, large enough for `more` others; unchanged if there is no memory. */
static int grow(void **array, size_t count, size_t more, size_t element_bytes)
{
    size_t room = room_for(count + more);
    if (room <= room_for(count))
        return 1;
    if (room > SIZE_MAX / element_bytes)
        return 0;
    void *larger = realloc(*array, room * element_bytes);
    if (!larger)
        return 0;
    *array = larger;
    return 1;
}

base_status scene_add_triangles(scene *s, const scene_triangle *triangles, size_t count, uint32_t material, base_error *err)
{
    if (count == 0)
        return BASE_OK;
    if (material >= s->material_count)
        return base_fail(err, BASE_ERR_INPUT, s->name, "material %u of triangle %zu does not exist", material, s->triangle_count);
    if (count > SCENE_MAX_TRIANGLES - s->triangle_count)
        return base_fail(err, BASE_ERR_INPUT, s->name, "more than %zu triangles", SCENE_MAX_TRIANGLES);
    void *grown = s->triangles, *grown_materials = s->triangle_material;
    int ok = grow(&grown, s->triangle_count, count, sizeof *s->triangles);
    s->triangles = grown;
    ok = ok && grow(&grown_materials, s->triangle_count, count, sizeof *s->triangle_material);
    s->triangle_material = grown_materials;
    if (!ok)
        return base_fail(err, BASE_ERR_NOMEM, s->name, "out of memory for %zu triangles", s->triangle_count + count);
    memcpy(s->triangles + s->triangle_count, triangles, count * sizeof *triangles);
    for (size_t i = 0; i < count; i++)
        s->triangle_material[s->triangle_count + i] = material;
    s->triangle_count += count;
    return BASE_OK;
}

base_status scene_add_material(scene *s, scene_material material, uint32_t *index, base_error *err)
{
    void *grown = s->materials;
    if (s->material_count >= UINT32_MAX || !grow(&grown, s->material_count, 1, sizeof material))
        return base_fail(err, BASE_ERR_NOMEM, s->name, "out of memory for %zu materials", s->material_count + 1);
    s->materials = grown;
    *index = (uint32_t)s->material_count;
    s->materials[s->material_count++] = material;
    return BASE_OK;
}

base_status scene_add_camera(scene *s, scene_camera camera, base_error *err)
{
    camera.name[sizeof camera.name - 1] = '\0';
    base_status status = scene_camera_check(&camera, err);
    if (status != BASE_OK)
        return status;
    void *grown = s->cameras;
    if (!grow(&grown, s->camera_count, 1, sizeof camera))
        return base_fail(err, BASE_ERR_NOMEM, s->name, "out of memory for %zu cameras", s->camera_count + 1);
    s->cameras = grown;
    s->cameras[s->camera_count++] = camera;
    return BASE_OK;
}

static base_status check_materials(const scene *s, base_error *err)
{
    for (size_t i = 0; i < s->material_count; i++)
        for (int c = 0; c < 3; c++)
            if (!(s->materials[i].base_color[c] >= 0 && s->materials[i].base_color[c] <= 1))
                return base_fail(err, BASE_ERR_INPUT, s->name, "material %zu: base colour %g is not between 0 and 1", i,
                                 (double)s->materials[i].base_color[c]);
    return BASE_OK;
}

/* Bounds of the vertices, each checked on the way. */
static base_status find_bounds(scene *s, base_error *err)
{
    for (int axis = 0; axis < 3; axis++) {
        s->bounds_min[axis] = HUGE_VAL;
        s->bounds_max[axis] = -HUGE_VAL;
    }
    for (size_t i = 0; i < s->triangle_count; i++)
        for (int corner = 0; corner < 3; corner++)
            for (int axis = 0; axis < 3; axis++) {
                double x = (double)s->triangles[i].v[corner][axis];
                if (isnan(x))
                    return base_fail(err, BASE_ERR_INPUT, s->name, "triangle %zu: vertex is NaN", i);
                if (isinf(x))
                    return base_fail(err, BASE_ERR_INPUT, s->name, "triangle %zu: vertex is infinite", i);
                if (fabs(x) > SCENE_MAX_COORDINATE)
                    return base_fail(err, BASE_ERR_INPUT, s->name, "triangle %zu: coordinate %g is beyond %g", i, x,
                                     SCENE_MAX_COORDINATE);
                s->bounds_min[axis] = fmin(s->bounds_min[axis], x);
                s->bounds_max[axis] = fmax(s->bounds_max[axis], x);
            }
    for (int axis = 0; axis < 3; axis++) { /* fmin may give either zero: make it +0 on every host */
        s->bounds_min[axis] += 0.0;
        s->bounds_max[axis] += 0.0;
    }
    return BASE_OK;
}

/* Numbers are hashed byte by byte from the low end, so that the hash is the same on every host. */
static uint64_t hash_u32(uint64_t hash, uint32_t x)
{
    unsigned char bytes[4];
    for (int i = 0; i < 4; i++)
        bytes[i] = (unsigned char)(x >> 8 * i);
    return base_hash(hash, bytes, sizeof bytes);
}

static uint64_t hash_u64(uint64_t hash, uint64_t x)
{
    return hash_u32(hash_u32(hash, (uint32_t)x), (uint32_t)(x >> 32));
}

static uint64_t hash_float(uint64_t hash, float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return hash_u32(hash, bits);
}

static uint64_t hash_vector(uint64_t hash, const double v[3])
{
    for (int axis = 0; axis < 3; axis++) {
        uint64_t bits;
        memcpy(&bits, &v[axis], sizeof bits);
        hash = hash_u64(hash, bits);
    }
    return hash;
}

static uint64_t hash_camera(uint64_t hash, const scene_camera *c)
{
    const double lens[3] = {c->yfov, 0, 0};
    hash = base_hash(hash, c->name, strlen(c->name) + 1);
    hash = hash_vector(hash, c->position);
    hash = hash_vector(hash, c->forward);
    hash = hash_vector(hash, c->right);
    hash = hash_vector(hash, c->up);
    return hash_vector(hash, lens);
}

static uint64_t hash_light(uint64_t hash, const scene_light *light)
{
    hash = hash_u32(hash, light->has_area != 0);
    hash = hash_u32(hash, light->has_point != 0);
    hash = hash_vector(hash, light->corner);
    hash = hash_vector(hash, light->u);
    hash = hash_vector(hash, light->v);
    return hash_vector(hash, light->point);
}

static uint64_t hash_scene(const scene *s)
{
    uint64_t hash = hash_u64(BASE_HASH_START, s->triangle_count);
    for (size_t i = 0; i < s->triangle_count; i++) {
        for (int corner = 0; corner < 3; corner++)
            for (int axis = 0; axis < 3; axis++)
                hash = hash_float(hash, s->triangles[i].v[corner][axis]);
        hash = hash_u32(hash, s->triangle_material[i]);
    }
    hash = hash_u64(hash, s->material_count);
    for (size_t i = 0; i < s->material_count; i++)
        for (int c = 0; c < 3; c++)
            hash = hash_float(hash, s->materials[i].base_color[c]);
    hash = hash_u64(hash, s->camera_count);
    for (size_t i = 0; i < s->camera_count; i++)
        hash = hash_camera(hash, &s->cameras[i]);
    hash = hash_light(hash, &s->light);
    hash = hash_vector(hash, s->bounds_min);
    return hash_vector(hash, s->bounds_max);
}

base_status scene_finish(scene *s, base_error *err)
{
    if (s->triangle_count == 0)
        return base_fail(err, BASE_ERR_INPUT, s->name, "no triangles");
    base_status status = check_materials(s, err);
    if (status == BASE_OK)
        status = find_bounds(s, err);
    if (status == BASE_OK && s->camera_count == 0)
        status = scene_add_camera(s, scene_camera_framing(s->bounds_min, s->bounds_max), err);
    if (status != BASE_OK)
        return status;
    scene_light_complete(&s->light, s->bounds_min, s->bounds_max);
    status = scene_light_check(&s->light, err);
    if (status == BASE_OK)
        s->hash = hash_scene(s);
    return status;
}

/* The camera that a decimal index means, or NULL: "1" of two or more. */
static const scene_camera *camera_by_index(const scene *s, const char *name)
{
    size_t index = 0;
    if (!*name)
        return NULL;
    for (const char *c = name; *c; c++) {
        if (*c < '0' || *c > '9')
            return NULL;
        index = index * 10 + (size_t)(*c - '0');
        if (index >= s->camera_count)
            return NULL;
    }
    return &s->cameras[index];
}

base_status scene_find_camera(const scene *s, const char *name, const scene_camera **out, base_error *err)
{
    *out = NULL;
    if (!name && s->camera_count > 0)
        *out = &s->cameras[0];
    else if (name)
        *out = camera_by_index(s, name);
    for (size_t i = 0; name && !*out && i < s->camera_count; i++)
        if (strcmp(s->cameras[i].name, name) == 0)
            *out = &s->cameras[i];
    if (*out)
        return BASE_OK;
    char list[400] = "";
    for (size_t i = 0, used = 0; i < s->camera_count && used + 1 < sizeof list; i++) {
        int n = snprintf(list + used, sizeof list - used, "%s%zu (%s)", i ? ", " : "", i, s->cameras[i].name);
        used += n > 0 ? (size_t)n : 0;
    }
    return base_fail(err, BASE_ERR_USAGE, name ? name : "camera", "no such camera; the scene has %s", *list ? list : "none");
}
