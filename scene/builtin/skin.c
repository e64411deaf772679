#include "scene/builtin/skin.h"

#include <stdlib.h>

#include "scene/builtin/skin_field.h"

/* The body lies in a lattice of samples, worked through in blocks. A block draws the quads about the lattice edges that
 * start in it; these reach one layer of cells back, and a cell has a sample more than cells. */
enum { BLOCK = 16, CELLS = BLOCK + 1, SAMPLES = BLOCK + 2, PART = 3, PARTS = SAMPLES / PART };

typedef struct net {
    scene_mesh *mesh;
    const skin_field *field;
    double cell;
    uint32_t (*shade)(const void *user, scene_point at);
    const void *user;
    const skin_bone **all, **near_block, **near_part; /* field->count of each; all of them, then as many as are near */
    size_t near_block_count;
    double relief; /* the largest near the block */
    long first[3];                             /* the lattice indices of sample 0 of the block */
    double sample[SAMPLES][SAMPLES][SAMPLES]; /* [z][y][x] */
    scene_point vertex[CELLS][CELLS][CELLS];   /* of the cells that the skin goes through */
} net;

static scene_point lattice_point(const net *n, double x, double y, double z)
{
    return scene_at(n->field->low.x + n->cell * (n->first[0] + x), n->field->low.y + n->cell * (n->first[1] + y),
        n->field->low.z + n->cell * (n->first[2] + z));
}

/* Half the diagonal of so many samples a side and an edge more, so that no edge out of them meets the skin either. */
static double reach_of(const net *n, int samples)
{
    return n->cell * (0.87 * (samples - 1) + 1.0);
}

/* Sample a part of the block; away from the skin, one value stands for all, its sign being right. */
static int sample_part(net *n, int x0, int y0, int z0)
{
    scene_point middle = lattice_point(n, x0 + (PART - 1) / 2.0, y0 + (PART - 1) / 2.0, z0 + (PART - 1) / 2.0);
    double reach = reach_of(n, PART);
    double rough = skin_field_rough(n->field, n->near_block, n->near_block_count, middle), band = n->cell * n->field->slope;
    int far = fabs(rough) > reach * n->field->slope + n->relief;
    size_t count = far ? 0 : skin_field_near(n->field, n->near_block, n->near_block_count, middle, rough, reach, n->near_part);
    for (int z = z0; z < z0 + PART; z++)
        for (int y = y0; y < y0 + PART; y++)
            for (int x = x0; x < x0 + PART; x++)
                n->sample[z][y][x] = far ? rough
                    : skin_field_at(n->field, n->near_part, count, lattice_point(n, x, y, z), band, n->relief);
    return !far;
}

/* Where the edge between two samples meets the skin, away from its ends, so that no triangle gets too thin. */
static double crossing(double a, double b)
{
    double t = a / (a - b);
    return t < 0.06 ? 0.06 : t > 0.94 ? 0.94 : t;
}

/* Set a cell's vertex to the mean of the points where the skin meets its edges; 0 if it meets none. */
static int cell_vertex(net *n, int x, int y, int z)
{
    double sum[3] = {0, 0, 0};
    int count = 0, inside = 0;
    for (int k = 0; k < 8; k++)
        inside += n->sample[z + (k >> 2)][y + (k >> 1 & 1)][x + (k & 1)] < 0;
    if (inside == 0 || inside == 8)
        return 0;
    for (int axis = 0; axis < 3; axis++)
        for (int k = 0; k < 4; k++) {
            int at[3] = {0, 0, 0};
            at[(axis + 1) % 3] = k & 1;
            at[(axis + 2) % 3] = k >> 1;
            double a = n->sample[z + at[2]][y + at[1]][x + at[0]];
            double b = n->sample[z + at[2] + (axis == 2)][y + at[1] + (axis == 1)][x + at[0] + (axis == 0)];
            if ((a < 0) == (b < 0))
                continue;
            for (int i = 0; i < 3; i++)
                sum[i] += i == axis ? crossing(a, b) : at[i];
            count++;
        }
    n->vertex[z][y][x] = lattice_point(n, x + sum[0] / count, y + sum[1] / count, z + sum[2] / count);
    return 1;
}

static double area2(scene_point a, scene_point b, scene_point c)
{
    scene_point normal = scene_point_cross(scene_point_sub(b, a), scene_point_sub(c, a));
    return scene_point_dot(normal, normal);
}

/* A quad, cut along the diagonal that gives the larger of the two smaller halves. */
static void draw_quad(net *n, const scene_point p[4], int reversed)
{
    scene_point a = p[0], b = p[reversed ? 3 : 1], c = p[2], d = p[reversed ? 1 : 3];
    if (n->shade)
        n->mesh->material = n->shade(n->user, scene_point_mix(a, 0.5, c, 0.5));
    if (fmin(area2(a, b, c), area2(a, c, d)) >= fmin(area2(a, b, d), area2(b, c, d)))
        scene_mesh_quad(n->mesh, a, b, c, d);
    else
        scene_mesh_quad(n->mesh, b, c, d, a);
}

/* The quad about the edge from sample (x, y, z) along each axis, if the skin crosses it. */
static void draw_edges(net *n, int x, int y, int z)
{
    for (int axis = 0; axis < 3; axis++) {
        double a = n->sample[z][y][x];
        double b = n->sample[z + (axis == 2)][y + (axis == 1)][x + (axis == 0)];
        if ((a < 0) == (b < 0))
            continue;
        scene_point corner[4];
        for (int k = 0; k < 4; k++) { /* the cells about the edge, counter-clockwise seen from its far end */
            int at[3] = {x, y, z};
            at[(axis + 1) % 3] -= k == 0 || k == 3;
            at[(axis + 2) % 3] -= k == 0 || k == 1;
            corner[k] = n->vertex[at[2]][at[1]][at[0]];
        }
        draw_quad(n, corner, b < 0);
    }
}

static void draw_block(net *n)
{
    int some = 0;
    for (int k = 0; k < PARTS * PARTS * PARTS; k++)
        some |= sample_part(n, k % PARTS * PART, k / PARTS % PARTS * PART, k / PARTS / PARTS * PART);
    if (!some)
        return;
    some = 0;
    for (int k = 0; k < CELLS * CELLS * CELLS; k++)
        some |= cell_vertex(n, k % CELLS, k / CELLS % CELLS, k / CELLS / CELLS);
    if (!some)
        return;
    for (int z = 1; z <= BLOCK; z++)
        for (int y = 1; y <= BLOCK; y++)
            for (int x = 1; x <= BLOCK; x++)
                draw_edges(n, x, y, z);
}

static void draw_blocks(net *n)
{
    const skin_field *f = n->field;
    long blocks[3] = {1 + (long)((f->high.x - f->low.x) / (n->cell * BLOCK)),
        1 + (long)((f->high.y - f->low.y) / (n->cell * BLOCK)), 1 + (long)((f->high.z - f->low.z) / (n->cell * BLOCK))};
    double reach = reach_of(n, SAMPLES);
    for (long k = 0; k < blocks[0] * blocks[1] * blocks[2] && n->mesh->status == BASE_OK; k++) {
        n->first[0] = k % blocks[0] * BLOCK - 1;
        n->first[1] = k / blocks[0] % blocks[1] * BLOCK - 1;
        n->first[2] = k / blocks[0] / blocks[1] * BLOCK - 1;
        scene_point middle = lattice_point(n, (SAMPLES - 1) / 2.0, (SAMPLES - 1) / 2.0, (SAMPLES - 1) / 2.0);
        double rough = skin_field_rough(f, n->all, f->count, middle);
        if (fabs(rough) > reach * f->slope + f->relief)
            continue;
        n->near_block_count = skin_field_near(f, n->all, f->count, middle, rough, reach, n->near_block);
        n->relief = skin_field_relief(n->near_block, n->near_block_count);
        draw_block(n);
    }
}

void scene_skin_draw(scene_mesh *m, const scene_limb *limbs, size_t count, double cell,
    uint32_t (*shade)(const void *user, scene_point at), const void *user)
{
    skin_field field = {0};
    if (m->status != BASE_OK)
        return;
    int ok = skin_field_begin(&field, limbs, count);
    net *n = malloc(sizeof *n);
    const skin_bone **lists = malloc(3 * (field.count + 1) * sizeof *lists);
    if (ok && n && lists) {
        *n = (net){.mesh = m, .field = &field, .cell = cell, .shade = shade, .user = user, .all = lists,
            .near_block = lists + field.count, .near_part = lists + 2 * field.count};
        for (size_t i = 0; i < field.count; i++)
            lists[i] = &field.bones[i];
        draw_blocks(n);
    } else {
        m->status = base_fail(m->err, BASE_ERR_NOMEM, m->target->name, "out of memory for a skin");
    }
    free(lists);
    free(n);
    skin_field_end(&field);
}

double scene_skin_around(scene_point out)
{
    double sum = fabs(out.y) + fabs(out.z);
    if (sum == 0.0)
        return 0.0;
    double y = out.y / sum, z = out.z / sum;
    return z >= 0.0 ? 1.0 - y : 3.0 + y;
}
