/* A courtyard of 8 by 3 bays of 3.2 m with two storeys of arcades about it. The gallery behind the arcade is one bay
 * deep: groin vaults below, beams above. Each of the four sides is drawn in a frame whose x runs along the edge of
 * the court, whose z points into it, and whose origin is the middle of that edge on the ground. */
#include "scene/builtin/architecture.h"
#include "scene/builtin/furniture.h"
#include "scene/builtin/scenes.h"

#define BAY 3.2
#define HALF_X (4 * BAY)   /* of the court */
#define HALF_Z (1.5 * BAY)
#define SPRING 3.0         /* of the lower arches */
#define FLOOR 5.0          /* of the upper gallery */
#define UPPER_SPRING 7.7
#define TOP 9.5            /* of the upper walls */

typedef struct palette {
    uint32_t plaster, stone, column, rib, vault, door, wood, beam, tile, iron, rope, leaf[3], slab[4], brick[3],
        cloth[6],
        water, earth, pot, pane, dark;
} palette;

static palette paint_palette(scene_mesh *m)
{
    palette p;
    p.plaster = scene_mesh_paint(m, 0.78, 0.66, 0.50);
    p.stone = scene_mesh_paint(m, 0.70, 0.63, 0.52);
    p.column = scene_mesh_paint(m, 0.80, 0.75, 0.66);
    p.rib = scene_mesh_paint(m, 0.62, 0.50, 0.38);
    p.vault = scene_mesh_paint(m, 0.72, 0.70, 0.62);
    p.door = scene_mesh_paint(m, 0.16, 0.30, 0.32);
    p.wood = scene_mesh_paint(m, 0.36, 0.22, 0.12);
    p.beam = scene_mesh_paint(m, 0.28, 0.17, 0.09);
    p.tile = scene_mesh_paint(m, 0.62, 0.27, 0.14);
    p.iron = scene_mesh_paint(m, 0.10, 0.10, 0.11);
    p.rope = scene_mesh_paint(m, 0.62, 0.52, 0.34);
    p.leaf[0] = scene_mesh_paint(m, 0.16, 0.34, 0.10);
    p.leaf[1] = scene_mesh_paint(m, 0.26, 0.42, 0.14);
    p.leaf[2] = scene_mesh_paint(m, 0.34, 0.40, 0.20);
    p.slab[0] = scene_mesh_paint(m, 0.52, 0.46, 0.38);
    p.slab[1] = scene_mesh_paint(m, 0.58, 0.52, 0.44);
    p.slab[2] = scene_mesh_paint(m, 0.47, 0.43, 0.38);
    p.slab[3] = scene_mesh_paint(m, 0.60, 0.50, 0.40);
    p.brick[0] = scene_mesh_paint(m, 0.50, 0.28, 0.19);
    p.brick[1] = scene_mesh_paint(m, 0.56, 0.34, 0.22);
    p.brick[2] = scene_mesh_paint(m, 0.45, 0.26, 0.20);
    p.cloth[0] = scene_mesh_paint(m, 0.62, 0.08, 0.07);
    p.cloth[1] = scene_mesh_paint(m, 0.10, 0.32, 0.16);
    p.cloth[2] = scene_mesh_paint(m, 0.09, 0.18, 0.45);
    p.cloth[3] = scene_mesh_paint(m, 0.80, 0.74, 0.60);
    p.cloth[4] = scene_mesh_paint(m, 0.82, 0.58, 0.22);
    p.cloth[5] = scene_mesh_paint(m, 0.74, 0.38, 0.24);
    p.water = scene_mesh_paint(m, 0.14, 0.36, 0.42);
    p.earth = scene_mesh_paint(m, 0.20, 0.14, 0.09);
    p.pot = scene_mesh_paint(m, 0.58, 0.30, 0.18);
    p.pane = scene_mesh_paint(m, 0.55, 0.66, 0.72);
    p.dark = scene_mesh_paint(m, 0.10, 0.08, 0.06);
    return p;
}

/* One bay of the lower arcade: x = 0 is its middle. */
static void lower_arch(scene_mesh *m, const palette *p)
{
    scene_arch wall = {1.35, 1.35, SPRING, 0.25, 14};
    m->material = p->plaster;
    scene_arch_spandrel(m, &wall, BAY / 2, FLOOR - 0.4);
    m->material = p->rib;
    scene_arch_band(m, &wall, 0.16, 0.03);
    scene_arch soffit = {1.35, 1.35, SPRING, 0.265, 14};
    scene_frame before = scene_mesh_enter(m, 0, 0, 0.015, 0);
    scene_arch_soffit(m, &soffit);
    m->frame = before;
}

static void upper_arch(scene_mesh *m, const palette *p)
{
    scene_arch wall = {1.40, 1.40, UPPER_SPRING, 0.20, 12};
    m->material = p->plaster;
    scene_arch_spandrel(m, &wall, BAY / 2, TOP);
    m->material = p->rib;
    scene_arch_band(m, &wall, 0.12, 0.03);
    scene_arch soffit = {1.40, 1.40, UPPER_SPRING, 0.215, 12};
    scene_frame before = scene_mesh_enter(m, 0, 0, 0.015, 0);
    scene_arch_soffit(m, &soffit);
    m->frame = before;
    scene_frame floor = scene_mesh_enter(m, 0, FLOOR, 0, 0);
    m->material = p->stone;
    scene_balustrade(m, -BAY / 2 + 0.19, BAY / 2 - 0.19, 0.92, 5, 5);
    m->frame = floor;
}

/* Column above column at a corner of a bay, and the rib from there to the outer wall. */
static void supports(scene_mesh *m, const palette *p)
{
    scene_column lower = {SPRING, 0.28, 12, 4}, upper = {UPPER_SPRING - FLOOR - 0.95, 0.15, 8, 3};
    m->material = p->column;
    scene_column_draw(m, &lower);
    scene_frame before = scene_mesh_enter(m, 0, FLOOR, 0, 0);
    m->material = p->stone;
    scene_mesh_box(m, scene_at(-0.22, 0, -0.22), scene_at(0.22, 0.06, 0.22), SCENE_FACES_STANDING);
    scene_mesh_box(m, scene_at(-0.20, 0.06, -0.20), scene_at(0.20, 0.88, 0.20), SCENE_FACES_AROUND);
    scene_mesh_box(m, scene_at(-0.23, 0.88, -0.23), scene_at(0.23, 0.95, 0.23), SCENE_FACES_ALL);
    scene_mesh_enter(m, 0, 0.95, 0, 0);
    m->material = p->column;
    scene_column_draw(m, &upper);
    m->frame = before;
}

static void rib(scene_mesh *m, const palette *p)
{
    scene_frame before = scene_mesh_enter(m, 0, 0, -1.725, 0.25);
    scene_arch arch = {1.325, 1.25, SPRING, 0.25, 10};
    m->material = p->rib;
    scene_arch_ring(m, &arch, 1.475, 1.40);
    scene_arch_soffit(m, &arch);
    m->frame = before;
    m->material = p->stone;
    scene_mesh_box(m, scene_at(-0.31, 0, -3.2), scene_at(0.31, 0.35, -2.99),
        SCENE_FACES_STANDING & SCENE_FACES_NO_BACK);
    scene_mesh_box(m, scene_at(-0.25, 0.35, -3.2), scene_at(0.25, 2.8, -3.05),
        SCENE_FACES_AROUND & SCENE_FACES_NO_BACK);
    scene_mesh_box(m, scene_at(-0.30, 2.8, -3.2), scene_at(0.30, SPRING, -3.0), SCENE_FACES_NO_BACK);
}

/* The outer wall of one bay, both storeys: doors and niches in turn, windows above. The frame lies in the wall. */
static void outer_wall(scene_mesh *m, const palette *p, int is_door)
{
    scene_opening door = {-0.62, 0.62, 0, 2.35}, niche = {-0.5, 0.5, 0.9, 2.4}, window = {-0.55, 0.55, 6.2, 8.0};
    scene_opening below = is_door ? door : niche;
    m->material = p->plaster;
    scene_wall(m, -BAY / 2, 0, BAY / 2, FLOOR - 0.5, below);
    scene_wall(m, -BAY / 2, FLOOR, BAY / 2, TOP, window);
    m->material = p->stone;
    unsigned around = SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_TOP;
    scene_reveal(m, below, 0.3, is_door ? around : around | SCENE_FACE_BOTTOM | SCENE_FACE_BACK);
    scene_reveal(m, window, 0.22, around | SCENE_FACE_BOTTOM);
    scene_mesh_box(m, scene_at(-0.66, 6.12, -0.001), scene_at(0.66, 6.2, 0.08), SCENE_FACES_NO_BACK);
    scene_frame before = scene_mesh_enter(m, 0, 0, is_door ? -0.28 : -0.2, 0);
    if (is_door) {
        m->material = p->door;
        scene_panel_door(m, 1.24, 2.35);
    } else {
        scene_mesh_enter(m, 0, 0.9, 0.05, 0);
        m->material = p->pot;
        scene_ware_draw(m, SCENE_WARE_VASE, 0.18, 0.7, 10);
    }
    m->frame = before;
    scene_mesh_enter(m, 0, 0, -0.22, 0);
    m->material = p->pane;
    scene_mesh_quad(m, scene_at(-0.55, 6.2, 0), scene_at(0.55, 6.2, 0), scene_at(0.55, 8.0, 0), scene_at(-0.55, 8.0,
        0));
    scene_mesh_enter(m, 0, 0, 0.05, 0);
    m->material = p->wood;
    scene_window_bars(m, window, 3, 5, 0.04);
    m->frame = before;
}

/* What lies between two storeys and under the eaves, and the joists of the upper ceiling. */
static void long_parts(scene_mesh *m, const palette *p, double half)
{
    static const scene_profile cornice[] = {{0.25, 4.42}, {0.31, 4.46}, {0.31, 4.56}, {0.37, 4.62}, {0.37, 4.68},
        {0.47, 4.78},
        {0.49, 4.82}, {0.49, 4.94}, {0.46, FLOOR}, {-0.30, FLOOR}};
    static const scene_profile eaves[] = {{0.20, 9.26}, {0.25, 9.30}, {0.25, 9.40}, {0.34, 9.48}, {0.34, 9.56},
        {0.85, 9.44},
        {0.85, 9.52}, {-0.60, 10.05}};
    m->material = p->stone;
    scene_mesh_moulding(m, cornice, sizeof cornice / sizeof *cornice, -half, half, 1, -1);
    m->material = p->wood;
    scene_mesh_moulding(m, eaves, sizeof eaves / sizeof *eaves, -half, half, 1, -1);
    m->material = p->tile;
    unsigned rows = (unsigned)((2 * half - 0.9) / 0.32);
    for (unsigned i = 0; i < rows; i++) {
        scene_frame before = scene_mesh_enter(m, (i + 0.5 - rows * 0.5) * 0.32, 9.90, -0.16, 0);
        scene_mesh_pitch(m, 0.0555);
        scene_roof_tiles(m, 0.14, 0.55, 2, 4);
        m->frame = before;
    }
    m->material = p->beam;
    unsigned joists = (unsigned)((2 * half + BAY - 0.2) / 0.60); /* each side roofs the corner at its left */
    for (unsigned i = 0; i < joists; i++) {
        double x = (i + 0.5) * 0.60 - half - BAY;
        scene_mesh_box(m, scene_at(x - 0.06, TOP - 0.2, -3.2), scene_at(x + 0.06, TOP, x < -half ? -0.2 : 0.2),
            SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_BOTTOM);
    }
    m->material = p->plaster;
    scene_mesh_ceiling(m, -half - BAY, -3.2, half - 0.19, 0.19, TOP - 0.001);
    m->material = p->brick[1];
    scene_mesh_floor(m, -half - BAY, -3.2, half + 0.30, -0.30, FLOOR);
}

static void corner(scene_mesh *m, const palette *p, double half)
{
    scene_frame before = scene_mesh_enter(m, half, 0, 0, 0);
    m->material = p->plaster;
    scene_mesh_box(m, scene_at(-0.27, SPRING, -0.27), scene_at(0.27, FLOOR - 0.4, 0.27), SCENE_FACES_AROUND
        | SCENE_FACE_BOTTOM);
    scene_mesh_box(m, scene_at(-0.22, UPPER_SPRING, -0.22), scene_at(0.22, TOP, 0.22), SCENE_FACES_AROUND
        | SCENE_FACE_BOTTOM);
    scene_mesh_enter(m, BAY / 2 + 0.125, SPRING, -1.725, 0);
    m->material = p->vault;
    scene_groin_vault(m, 1.475, 1.475, 1.40, 10, 3);
    m->frame = before;
    /* the two blind walls of the corner bay */
    for (int side = 0; side < 2; side++) {
        before = m->frame;
        if (side == 0)
            scene_mesh_enter(m, half + BAY / 2, 0, -BAY, 0);
        else
            scene_mesh_enter(m, half + BAY, 0, -BAY / 2, 0.75);
        outer_wall(m, p, 0);
        m->frame = before;
    }
}

static void draw_side(scene_mesh *m, const palette *p, unsigned bays)
{
    double half = bays * BAY / 2;
    for (unsigned i = 0; i < bays; i++) {
        scene_frame before = scene_mesh_enter(m, -half + (i + 0.5) * BAY, 0, 0, 0);
        lower_arch(m, p);
        upper_arch(m, p);
        scene_frame bay = scene_mesh_enter(m, 0, SPRING, -1.725, 0);
        m->material = p->vault;
        scene_groin_vault(m, 1.35, 1.475, 1.40, 10, 3);
        m->frame = bay;
        scene_mesh_enter(m, 0, 0, -BAY, 0);
        outer_wall(m, p, i % 2 == 0);
        m->frame = before;
    }
    for (unsigned i = 0; i <= bays; i++) {
        scene_frame before = scene_mesh_enter(m, -half + i * BAY, 0, 0, 0);
        if (i < bays)
            supports(m, p);
        rib(m, p);
        m->frame = before;
    }
    long_parts(m, p, half);
    corner(m, p, half);
}

static void ground(scene_mesh *m, const palette *p)
{
    m->material = p->dark;
    scene_mesh_floor(m, -HALF_X - BAY - 0.3, -HALF_Z - BAY - 0.3, HALF_X + BAY + 0.3, HALF_Z + BAY + 0.3, -0.02);
    scene_slabs(m, -HALF_X, -HALF_Z, 32, 12, 0.8, p->slab, 4);
    for (int side = 0; side < 2; side++) {
        double z = side ? HALF_Z : -HALF_Z - BAY, x = side ? HALF_X : -HALF_X - BAY;
        scene_slabs(m, -HALF_X - BAY, z, 20, 2, 1.6, p->brick, 3);
        scene_slabs(m, x, -HALF_Z, 2, 6, 1.6, p->brick, 3);
    }
}

static void fountain(scene_mesh *m, const palette *p)
{
    static const scene_profile step[] = {{2.10, 0}, {2.10, 0.12}, {1.80, 0.12}};
    static const scene_profile basin[] = {{1.70, 0.12}, {1.70, 0.20}, {1.55, 0.26}, {1.50, 0.52}, {1.62, 0.60},
        {1.62, 0.68},
        {1.40, 0.68}, {1.36, 0.50}};
    static const scene_profile stem[] = {{0.34, 0.45}, {0.30, 0.62}, {0.18, 0.72}, {0.14, 1.00}, {0.22, 1.10}, {0.14,
        1.20},
        {0.20, 1.36}, {0.60, 1.52}, {0.80, 1.68}, {0.82, 1.74}, {0.76, 1.73}, {0.55, 1.64}};
    static const scene_profile finial[] = {{0.12, 1.60}, {0.08, 1.85}, {0.12, 1.92}, {0.07, 2.00}, {0.24, 2.12},
        {0.32, 2.22},
        {0.30, 2.23}, {0.10, 2.18}, {0.05, 2.35}, {0.09, 2.42}, {0.06, 2.50}, {0, 2.56}};
    static const scene_profile pool[] = {{1.40, 0.56}, {0, 0.56}}, dish[] = {{0.70, 1.705}, {0, 1.705}};
    scene_frame before = scene_mesh_enter(m, 2.4, 0, 0, 0.03);
    m->material = p->stone;
    scene_mesh_lathe(m, step, 3, 16);
    scene_mesh_lathe(m, basin, sizeof basin / sizeof *basin, 32);
    m->material = p->column;
    scene_mesh_lathe(m, stem, sizeof stem / sizeof *stem, 24);
    scene_mesh_lathe(m, finial, sizeof finial / sizeof *finial, 16);
    m->material = p->water;
    scene_mesh_lathe(m, pool, 2, 32);
    scene_mesh_lathe(m, dish, 2, 24);
    for (unsigned i = 0; i < 8; i++) { /* jets from the dish into the basin */
        scene_frame jet = scene_mesh_enter(m, 0, 0, 0, i / 8.0);
        scene_mesh_rope(m, scene_at(0, 1.74, 0.78), scene_at(0, 0.55, 1.15), -0.14, 0.012, 8, 3);
        m->frame = jet;
    }
    m->frame = before;
}

static void planter(scene_mesh *m, const palette *p, double x, double z, unsigned kind)
{
    scene_frame before = scene_mesh_enter(m, x, 0, z, 0.07 * kind);
    m->material = p->pot;
    scene_ware_draw(m, SCENE_WARE_POT, 0.38, 0.55, 12);
    double tall = kind % 2 ? 2.1 : 1.0;
    m->material = p->wood;
    scene_point trunk[4] = {{0, 0.45, 0}, {0.04, 0.45 + 0.3 * tall, 0.02}, {-0.03, 0.45 + 0.6 * tall, 0.03}, {0,
        0.45 + tall, 0}};
    scene_mesh_pipe(m, trunk, 4, 0.035, 6);
    m->material = p->leaf[kind % 3];
    scene_mesh_enter(m, 0, 0.45 + tall, 0, 0);
    scene_leaves(m, 100, kind % 2 ? 0.55 : 0.45, kind % 2 ? 0.60 : 0.5, 0.17);
    m->frame = before;
}

static void cloths(scene_mesh *m, const palette *p)
{
    for (unsigned i = 0; i < 8; i++) { /* banners over the balustrade, facing the court from both long sides */
        double x = (i % 4 * 2.0 - 3.0) * BAY + (i < 4 ? -BAY / 2 : BAY / 2);
        scene_frame before = scene_mesh_enter(m, x, FLOOR + 0.86, i < 4 ? -HALF_Z + 0.62 : HALF_Z - 0.62,
            i < 4 ? 0 : 0.5);
        m->material = p->iron;
        scene_mesh_beam(m, scene_at(-0.85, 0.02, 0), scene_at(0.85, 0.02, 0), 0.03, 0.03, 1);
        scene_mesh_beam(m, scene_at(-0.80, 0.03, -0.04), scene_at(-0.80, 0.05, -0.52), 0.02, 0.02, 0);
        scene_mesh_beam(m, scene_at(0.80, 0.03, -0.04), scene_at(0.80, 0.05, -0.52), 0.02, 0.02, 0);
        m->material = p->cloth[i % 3];
        scene_cloth cloth = {1.5, 2.7, 0.05, 3.0 + 0.5 * (i % 3), i % 2 ? -0.25 : 0.25, 12, 10};
        scene_cloth_draw(m, &cloth);
        m->frame = before;
    }
    for (unsigned i = 0; i < 6; i++) { /* curtains in the lower arches */
        double x = (i % 3 * 3.0 - 3.5) * BAY;
        scene_frame before = scene_mesh_enter(m, x, SPRING + 0.05, i < 3 ? -HALF_Z : HALF_Z, i < 3 ? 0 : 0.5);
        m->material = p->iron;
        scene_mesh_beam(m, scene_at(-1.4, 0.02, 0), scene_at(1.4, 0.02, 0), 0.03, 0.03, 0);
        m->material = p->cloth[(i + 2) % 6];
        scene_mesh_enter(m, i % 2 ? 0.75 : -0.75, 0, 0, 0);
        scene_cloth cloth = {1.15, 2.5, 0.09, 4.5, 0.0, 16, 6};
        scene_cloth_draw(m, &cloth);
        m->frame = before;
    }
}

/* An awning between two ropes across the court: the frame's origin is the middle of it. */
typedef struct awning {
    double half_x, half_z, sag;
} awning;

static scene_point awning_place(const void *user, double u, double v)
{
    const awning *a = user;
    double slack = 4 * v * (1 - v), dip = 4 * u * (1 - u);
    double y = -a->sag * slack * (0.6 + 0.4 * dip) - 0.12 * dip;
    return scene_at((2 * u - 1) * a->half_x, y, (2 * v - 1) * a->half_z);
}

static void awnings(scene_mesh *m, const palette *p)
{
    for (unsigned i = 0; i <= 8; i++) {
        double x = -HALF_X + i * BAY + (i == 0 ? 0.9 : i == 8 ? -0.9 : 0);
        m->material = p->rope;
        scene_mesh_rope(m, scene_at(x, 9.2, -HALF_Z + 0.2), scene_at(x, 9.2, HALF_Z - 0.2), 0.5, 0.012, 12, 4);
    }
    for (unsigned i = 0; i < 8; i++) {
        double x0 = -HALF_X + i * BAY + (i == 0 ? 0.9 : 0), x1 = -HALF_X + (i + 1) * BAY - (i == 7 ? 0.9 : 0);
        m->material = p->cloth[3 + i % 3];
        scene_frame before = scene_mesh_enter(m, (x0 + x1) / 2, 9.16, 0, 0);
        awning a = {(x1 - x0) / 2 - 0.04, HALF_Z - 0.55, 0.40};
        scene_mesh_fabric(m, 4, 12, awning_place, &a, scene_at(0, -0.002, 0));
        m->frame = before;
    }
    /* washing lines and lamp chains: long and thin */
    m->material = p->rope;
    scene_mesh_rope(m, scene_at(-HALF_X, 6.9, -HALF_Z), scene_at(HALF_X, 7.2, HALF_Z), 0.8, 0.008, 48, 4);
    scene_mesh_rope(m, scene_at(-HALF_X, 7.3, HALF_Z), scene_at(HALF_X, 6.8, -HALF_Z), 0.7, 0.008, 48, 4);
}

static void clutter(scene_mesh *m, const palette *p)
{
    for (unsigned i = 0; i < 5; i++) {
        planter(m, p, (i - 2.0) * 2 * BAY * 0.8, HALF_Z - 0.85, i);
        planter(m, p, (i - 2.0) * 2 * BAY * 0.8, -HALF_Z + 0.85, i + 1);
    }
    for (unsigned i = 0; i < 9; i++) { /* jars and crates in the corners of the court */
        double x = scene_mesh_random(m, -11.8, -9.0), z = scene_mesh_random(m, -3.9, -2.8);
        double size = scene_mesh_random(m, 0.8, 1.4);
        scene_frame before = scene_mesh_enter(m, i % 2 ? x : -x, 0, i % 3 ? z : -z, 0.1 * i);
        m->material = i % 4 == 3 ? p->wood : p->pot;
        if (i % 4 == 3)
            scene_mesh_box(m, scene_at(-0.3, 0, -0.25), scene_at(0.3, 0.45, 0.25), SCENE_FACES_STANDING);
        else
            scene_ware_draw(m, i % 2 ? SCENE_WARE_VASE : SCENE_WARE_BARREL, 0.2 * size, 0.5 * size, 10);
        m->frame = before;
    }
}

base_status scene_build_atrium(scene *s, base_error *err)
{
    scene_mesh m = scene_mesh_begin(s, 76, err);
    palette p = paint_palette(&m);
    ground(&m, &p);
    for (unsigned side = 0; side < 4; side++) {
        double x = side == 1 ? -HALF_X : side == 3 ? HALF_X : 0, z = side == 0 ? -HALF_Z : side == 2 ? HALF_Z : 0;
        scene_frame before = scene_mesh_enter(&m, x, 0, z, side * 0.25);
        draw_side(&m, &p, side % 2 ? 3 : 8);
        m.frame = before;
    }
    fountain(&m, &p);
    cloths(&m, &p);
    awnings(&m, &p);
    clutter(&m, &p);
    m.material = p.stone;
    if (s->triangle_count < SCENE_ATRIUM_TRIANGLES)
        scene_pebbles(&m, SCENE_ATRIUM_TRIANGLES - s->triangle_count, -0.6, -3.0, 5.4, 3.0, 0.03);
    base_status status = scene_mesh_end(&m, SCENE_ATRIUM_TRIANGLES);
    const double eye[3] = {-11.9, 2.3, 1.5}, target[3] = {0, 3.3, -0.5}, up[3] = {0, 1, 0};
    s->light = (scene_light){.has_area = 1, .corner = {-2.0, 8.1, -1.5}, .u = {4, 0, 0}, .v = {0, 0, 3}};
    return status != BASE_OK ? status : scene_add_camera(s, scene_camera_look_at("main", eye, target, up, 1.1), err);
}
