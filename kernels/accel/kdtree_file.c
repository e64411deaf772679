#include "kernels/accel/kdtree_file.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "kernels/accel/box.h"
#include "kernels/accel/kdtree_tally.h"
#include "lrbni/base/hash.h"
#include "lrbni/base/output_file.h"

/* Changes whenever the format does, or the tree that the same scene and options give. */
enum { VERSION = 2 };

/* The start of the file. Little-endian, as are the arrays behind it: nodes, lists, ids of the records' triangles, components,
   sets, members; at the end the checksum (FNV-1a) of all before it. */
typedef struct header {
    char magic[8];
    uint32_t version;
    float traversal_cost;
    uint32_t empty_percent, covered_planes, min_area, perfect_splits, empty_occluders, max_depth;
    uint64_t scene_hash;
    uint64_t nodes, lists, records, sets, members; /* how many */
} header;

_Static_assert(sizeof(header) == 88, "no padding");

static header header_of(const scene *s, const kdtree_options *o)
{
    header h = {
        .magic = {'l', 't', '-', 'k', 'd', 't', 'r', 'e'},
        .version = VERSION,
        .traversal_cost = o->traversal_cost + 0.0f,
        .empty_percent = o->empty_percent,
        .covered_planes = o->covered_planes,
        .min_area = o->min_area,
        .perfect_splits = o->perfect_splits,
        .empty_occluders = o->empty_occluders,
        .max_depth = o->max_depth,
        .scene_hash = s->hash,
    };
    return h;
}

/* The part of a header that names what the tree was built from. */
enum { KEY_BYTES = offsetof(header, nodes) };

/* ---- writing ---- */

typedef struct writer {
    FILE *stream;
    uint64_t hash;
} writer;

/* A write that fails is found by the commit. */
static void put(writer *w, const void *data, size_t size)
{
    if (size == 0)
        return;
    w->hash = base_hash(w->hash, data, size);
    fwrite(data, 1, size, w->stream);
}

static void put_nodes(writer *w, const kdtree *tree)
{
    for (size_t i = 0; i < tree->node_count; i++) {
        kdtree_node node = tree->nodes[i];
        if (i != 1 && kdtree_is_leaf(&node))
            node.extent &= ~(uint32_t)KDTREE_OCCLUDER;
        put(w, &node, sizeof node);
    }
}

base_status kdtree_write(const kdtree *tree, const scene *s, const kdtree_options *options, const char *path, base_error *err)
{
    base_output out;
    base_status status = base_output_begin(path, false, &out, err);
    if (status != BASE_OK)
        return status;
    writer w = {out.stream, BASE_HASH_START};
    header h = header_of(s, options);
    h.nodes = tree->node_count;
    h.lists = tree->list_count;
    h.records = tree->record_count;
    h.sets = tree->set_count;
    h.members = tree->member_count;
    put(&w, &h, sizeof h);
    put_nodes(&w, tree);
    put(&w, tree->lists, tree->list_count * sizeof *tree->lists);
    for (size_t i = 0; i < tree->record_count; i++)
        put(&w, &tree->records[i].id, sizeof tree->records[i].id);
    put(&w, tree->components, tree->record_count * sizeof *tree->components);
    put(&w, tree->sets, tree->set_count * sizeof *tree->sets);
    put(&w, tree->members, tree->member_count * sizeof *tree->members);
    fwrite(&w.hash, sizeof w.hash, 1, w.stream);
    return base_output_commit(&out, err);
}

/* ---- reading ---- */

typedef struct reader {
    FILE *stream;
    const char *path;
    uint64_t hash;
    base_error *err;
} reader;

static base_status bad(const reader *r, const char *why)
{
    return base_fail(r->err, BASE_ERR_INPUT, r->path, "%s", why);
}

static base_status get(reader *r, void *data, size_t size)
{
    if (size > 0 && fread(data, 1, size, r->stream) != size)
        return bad(r, "it ends early or cannot be read");
    r->hash = size > 0 ? base_hash(r->hash, data, size) : r->hash;
    return BASE_OK;
}

/* An array of its own, 64-byte aligned, and its contents. */
static base_status get_array(reader *r, void **array, size_t count, size_t size)
{
    size_t bytes = (count * size + 63) / 64 * 64;
    *array = aligned_alloc(64, bytes ? bytes : 64);
    return *array ? get(r, *array, count * size) : base_fail(r->err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
}

/* Counts within what the format can hold, and a file just as long as they say. */
static base_status check_length(const reader *r, const header *h)
{
    struct stat about;
    if (h->nodes < 2 || h->nodes % 2 != 0 || h->nodes * sizeof(kdtree_node) > UINT32_MAX || h->nodes > UINT32_MAX)
        return bad(r, "its number of nodes is impossible");
    if (h->lists > UINT32_MAX / 4 || h->records > SCENE_MAX_TRIANGLES || h->sets < 1 || h->sets > UINT32_MAX / 4 ||
        h->members > UINT32_MAX)
        return bad(r, "its counts are impossible");
    uint64_t length = sizeof *h + h->nodes * sizeof(kdtree_node) + h->lists * 4 + h->records * 8 + h->sets * sizeof(kdtree_set) +
                      h->members * 4 + sizeof r->hash;
    if (fstat(fileno(r->stream), &about) != 0 || !S_ISREG(about.st_mode) || (uint64_t)about.st_size != length)
        return bad(r, "its length is not that of its contents");
    return BASE_OK;
}

/* The records from the ids of their triangles, of which there is each that is not degenerate, once; and the root's box. */
static base_status make_records(reader *r, const scene *s, const uint32_t *ids, kdtree *tree)
{
    unsigned char *seen = calloc(s->triangle_count + 1, 1);
    tree->records = aligned_alloc(64, (tree->record_count + 1) * sizeof *tree->records);
    base_status status = seen && tree->records ? BASE_OK : base_fail(r->err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
    accel_box box = accel_box_empty();
    for (size_t i = 0; status == BASE_OK && i < tree->record_count; i++) {
        if (ids[i] >= s->triangle_count || seen[ids[i]]++ || accel_triangle_is_degenerate(&s->triangles[ids[i]]))
            status = bad(r, "it names a triangle that it should not");
        else {
            accel_box one = accel_box_of_triangle(&s->triangles[ids[i]]);
            accel_box_add(&box, &one);
            tree->records[i] = bvh_triangle_create(&s->triangles[ids[i]], ids[i]);
        }
    }
    for (size_t i = 0; status == BASE_OK && i < s->triangle_count; i++)
        if (!seen[i]) {
            tree->degenerate_count++;
            if (!accel_triangle_is_degenerate(&s->triangles[i]))
                status = bad(r, "a triangle is missing");
        }
    for (int axis = 0; axis < 3; axis++) {
        tree->min[axis] = box.v[axis];
        tree->max[axis] = 0.0f - box.v[axis + 4];
    }
    free(seen);
    return status;
}

static base_status check_sets(const reader *r, const kdtree *tree)
{
    size_t members = 0;
    uint32_t components = 0;
    for (size_t i = 0; i < tree->record_count; i++)
        if (tree->components[i] != KDTREE_OPEN) {
            const uint32_t number = tree->components[i] >> 1;
            if (number >= tree->record_count)
                return bad(r, "a component's number is impossible");
            components = number >= components ? number + 1 : components;
        }
    for (size_t i = 0; i < tree->set_count; i++) {
        const kdtree_set *set = &tree->sets[i];
        if (set->first != members || set->count > tree->member_count - members || (set->count == 0) != (i == 0))
            return bad(r, "a set is not where it belongs");
        for (size_t k = 0; k < set->count; k++)
            if (tree->members[members + k] >> 1 >= components ||
                (k > 0 && tree->members[members + k] >> 1 <= tree->members[members + k - 1] >> 1))
                return bad(r, "a set is out of order");
        members += set->count;
    }
    return members == tree->member_count ? BASE_OK : bad(r, "its sets do not use all members");
}

static base_status read_arrays(reader *r, const scene *s, const header *h, kdtree *tree)
{
    uint32_t *ids = NULL;
    uint64_t stored = 0;
    tree->node_count = h->nodes;
    tree->list_count = h->lists;
    tree->record_count = h->records;
    tree->set_count = h->sets;
    tree->member_count = h->members;
    base_status status = get_array(r, (void **)&tree->nodes, tree->node_count, sizeof *tree->nodes);
    if (status == BASE_OK)
        status = get_array(r, (void **)&tree->lists, tree->list_count, sizeof *tree->lists);
    if (status == BASE_OK)
        status = get_array(r, (void **)&ids, tree->record_count, sizeof *ids);
    if (status == BASE_OK)
        status = get_array(r, (void **)&tree->components, tree->record_count, sizeof *tree->components);
    if (status == BASE_OK)
        status = get_array(r, (void **)&tree->sets, tree->set_count, sizeof *tree->sets);
    if (status == BASE_OK)
        status = get_array(r, (void **)&tree->members, tree->member_count, sizeof *tree->members);
    uint64_t hash = r->hash;
    if (status == BASE_OK)
        status = get(r, &stored, sizeof stored);
    if (status == BASE_OK && stored != hash)
        status = bad(r, "its checksum is wrong");
    if (status == BASE_OK)
        status = make_records(r, s, ids, tree);
    free(ids);
    return status == BASE_OK ? check_sets(r, tree) : status;
}

static base_status read_tree(reader *r, const scene *s, const kdtree_options *options, kdtree *tree)
{
    header h, wanted = header_of(s, options);
    static const kdtree_node zero;
    base_status status = get(r, &h, sizeof h);
    if (status != BASE_OK)
        return status;
    if (memcmp(h.magic, wanted.magic, sizeof h.magic) != 0)
        return bad(r, "it is no kd-tree");
    if (h.version != wanted.version)
        return bad(r, "it is of another version");
    if (memcmp(&h, &wanted, KEY_BYTES) != 0)
        return bad(r, "it is of another scene or other parameters");
    status = check_length(r, &h);
    if (status == BASE_OK)
        status = read_arrays(r, s, &h, tree);
    if (status != BASE_OK)
        return status;
    if (memcmp(&tree->nodes[1], &zero, sizeof zero) != 0)
        return bad(r, "the root's neighbour is not zero");
    return kdtree_tally(tree, options, r->path, r->err);
}

base_status kdtree_read(const char *path, const scene *s, const kdtree_options *options, kdtree **out, base_error *err)
{
    reader r = {.path = path, .hash = BASE_HASH_START, .err = err};
    *out = calloc(1, sizeof **out);
    if (!*out)
        return base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
    r.stream = fopen(path, "rb");
    base_status status = r.stream ? read_tree(&r, s, options, *out) : bad(&r, strerror(errno));
    if (r.stream)
        fclose(r.stream);
    if (status != BASE_OK)
        kdtree_destroy(out);
    return status;
}

/* ---- a folder of trees ---- */

base_status kdtree_open(const scene *s, const kdtree_options *options, const char *folder, kdtree **out, base_error *note,
                        base_error *err)
{
    *note = (base_error){.status = BASE_OK};
    if (!folder)
        return kdtree_build(s, options, out, err);
    header key = header_of(s, options);
    size_t room = strlen(folder) + 64;
    char *path = malloc(room);
    if (!path)
        return base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
    snprintf(path, room, "%s/%016llx.kdtree", folder, (unsigned long long)base_hash(BASE_HASH_START, &key, KEY_BYTES));
    base_status status = BASE_OK;
    bool there = access(path, F_OK) == 0;
    if (!there || kdtree_read(path, s, options, out, note) != BASE_OK) {
        status = kdtree_build(s, options, out, err);
        base_error problem = {0};
        if (status == BASE_OK) {
            mkdir(folder, 0777); /* if that fails, so does the writing */
            if (kdtree_write(*out, s, options, path, &problem) != BASE_OK && note->status == BASE_OK)
                *note = problem;
        }
    }
    free(path);
    return status;
}
