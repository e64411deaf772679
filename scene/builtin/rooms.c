/* A small flat: a living room of 5 by 4.5 m, behind it a bedroom, to its right a kitchen. The living room's corner is
 * the origin; its back wall lies at z = 0, its window in the wall x = 0. With some 800 triangles each counts: faces
 * that nobody can see are left out. */
#include "scene/builtin/architecture.h"
#include "scene/builtin/furniture.h"
#include "scene/builtin/scenes.h"

#define HEIGHT 2.6
#define WALL 0.12 /* thickness between two rooms */

typedef struct palette {
    uint32_t warm, green, blue, white, floor, tile, carpet, wood, dark, sofa, rug, pane, lamp, canvas, pot, leaf,
        linen, quilt,
        fruit, book[5];
} palette;

static palette paint_palette(scene_mesh *m)
{
    palette p;
    p.warm = scene_mesh_paint(m, 0.80, 0.70, 0.54);
    p.green = scene_mesh_paint(m, 0.60, 0.70, 0.58);
    p.blue = scene_mesh_paint(m, 0.52, 0.62, 0.74);
    p.white = scene_mesh_paint(m, 0.86, 0.85, 0.81);
    p.floor = scene_mesh_paint(m, 0.48, 0.31, 0.18);
    p.tile = scene_mesh_paint(m, 0.62, 0.58, 0.52);
    p.carpet = scene_mesh_paint(m, 0.38, 0.36, 0.42);
    p.wood = scene_mesh_paint(m, 0.55, 0.34, 0.17);
    p.dark = scene_mesh_paint(m, 0.28, 0.17, 0.10);
    p.sofa = scene_mesh_paint(m, 0.20, 0.36, 0.40);
    p.rug = scene_mesh_paint(m, 0.56, 0.16, 0.13);
    p.pane = scene_mesh_paint(m, 0.62, 0.76, 0.88);
    p.lamp = scene_mesh_paint(m, 0.88, 0.66, 0.28);
    p.canvas = scene_mesh_paint(m, 0.30, 0.46, 0.52);
    p.pot = scene_mesh_paint(m, 0.62, 0.32, 0.20);
    p.leaf = scene_mesh_paint(m, 0.18, 0.40, 0.14);
    p.linen = scene_mesh_paint(m, 0.84, 0.82, 0.78);
    p.quilt = scene_mesh_paint(m, 0.62, 0.30, 0.34);
    p.fruit = scene_mesh_paint(m, 0.76, 0.26, 0.10);
    p.book[0] = scene_mesh_paint(m, 0.55, 0.12, 0.10);
    p.book[1] = scene_mesh_paint(m, 0.14, 0.26, 0.48);
    p.book[2] = scene_mesh_paint(m, 0.20, 0.40, 0.22);
    p.book[3] = scene_mesh_paint(m, 0.70, 0.56, 0.24);
    p.book[4] = scene_mesh_paint(m, 0.36, 0.20, 0.36);
    return p;
}

static void window(scene_mesh *m, const palette *p, scene_opening hole, unsigned rows)
{
    m->material = p->white;
    scene_reveal(m, hole, 0.22, SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_TOP | SCENE_FACE_BOTTOM);
    scene_frame before = scene_mesh_enter(m, 0, 0, -0.17, 0);
    scene_window_bars(m, hole, 2, rows, 0.05);
    m->frame = before;
    m->material = p->pane;
    scene_reveal(m, hole, 0.22, SCENE_FACE_BACK);
}

static void living_room(scene_mesh *m, const palette *p)
{
    scene_opening to_bedroom = {3.3, 4.2, 0, 2.05}, to_kitchen = {1.0, 1.95, 0, 2.05}, light = {-3.1, -1.3, 0.85, 2.2};
    m->material = p->floor;
    scene_mesh_floor(m, 0, 0, 5, 4.5, 0);
    m->material = p->white;
    scene_mesh_ceiling(m, 0, 0, 5, 4.5, HEIGHT);
    scene_reveal(m, to_bedroom, WALL, SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_TOP | SCENE_FACE_BOTTOM);
    m->material = p->warm;
    scene_wall(m, 0, 0, 5, HEIGHT, to_bedroom);
    scene_frame world = scene_mesh_enter(m, 5, 0, 0, 0.75);
    scene_wall(m, 0, 0, 4.5, HEIGHT, to_kitchen);
    m->material = p->white;
    scene_reveal(m, to_kitchen, WALL, SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_TOP | SCENE_FACE_BOTTOM);
    m->frame = world;
    scene_mesh_enter(m, 0, 0, 0, 0.25);
    m->material = p->warm;
    scene_wall(m, -4.5, 0, 0, HEIGHT, light);
    window(m, p, light, 2);
    m->frame = world;
    m->material = p->warm;
    scene_mesh_room(m, scene_at(0, 0, 0), scene_at(5, HEIGHT, 4.5), SCENE_FACE_FRONT);
}

/* Behind the back wall: seen from it, the door is mirrored. */
static void bedroom(scene_mesh *m, const palette *p)
{
    scene_point low = {1.6, 0, -3.6}, high = {5.2, HEIGHT, -WALL};
    m->material = p->carpet;
    scene_mesh_floor(m, low.x, low.z, high.x, high.z, 0);
    m->material = p->white;
    scene_mesh_ceiling(m, low.x, low.z, high.x, high.z, HEIGHT);
    m->material = p->blue;
    scene_mesh_room(m, low, high, SCENE_FACE_LEFT | SCENE_FACE_RIGHT);
    scene_frame world = scene_mesh_enter(m, 0, 0, -WALL, 0.5);
    scene_wall(m, -high.x, 0, -low.x, HEIGHT, (scene_opening){-4.2, -3.3, 0, 2.05});
    m->frame = world;
    scene_mesh_enter(m, 0, 0, low.z, 0);
    scene_opening light = {2.6, 3.7, 0.9, 2.1};
    scene_wall(m, low.x, 0, high.x, HEIGHT, light);
    window(m, p, light, 1);
    m->frame = world;
    m->material = p->wood; /* bed, its head against the right wall */
    scene_mesh_box(m, scene_at(3.05, 0.12, -3.3), scene_at(5.12, 0.34, -1.8), SCENE_FACES_NO_RIGHT);
    scene_mesh_box(m, scene_at(5.12, 0, -3.4), scene_at(5.199, 1.0, -1.7), SCENE_FACES_STANDING & SCENE_FACES_NO_RIGHT);
    m->material = p->quilt;
    scene_mesh_box(m, scene_at(3.02, 0.34, -3.33), scene_at(4.45, 0.52, -1.77), SCENE_FACES_STANDING);
    m->material = p->linen;
    scene_mesh_box(m, scene_at(4.5, 0.34, -2.95), scene_at(5.0, 0.58, -2.15), SCENE_FACES_STANDING);
}

static void kitchen(scene_mesh *m, const palette *p)
{
    scene_point low = {5 + WALL, 0, 0.1}, high = {8.0, HEIGHT, 3.4};
    m->material = p->tile;
    scene_mesh_floor(m, low.x, low.z, high.x, high.z, 0);
    m->material = p->white;
    scene_mesh_ceiling(m, low.x, low.z, high.x, high.z, HEIGHT);
    m->material = p->green;
    scene_mesh_room(m, low, high, SCENE_FACE_RIGHT | SCENE_FACE_BACK | SCENE_FACE_FRONT);
    scene_frame world = scene_mesh_enter(m, low.x, 0, 0, 0.25);
    scene_wall(m, -high.z, 0, -low.z, HEIGHT, (scene_opening){-1.95, -1.0, 0, 2.05});
    m->frame = world;
    m->material = p->white;
    scene_mesh_box(m, scene_at(7.4, 0, 0.7), scene_at(7.999, 0.86, 3.0), SCENE_FACES_AROUND & SCENE_FACES_NO_RIGHT);
    scene_mesh_box(m, scene_at(7.65, 1.5, 0.7), scene_at(7.999, 2.2, 2.2), SCENE_FACES_NO_RIGHT);
    m->material = p->dark;
    scene_mesh_box(m, scene_at(7.36, 0.86, 0.66), scene_at(7.999, 0.91, 3.04), SCENE_FACES_NO_RIGHT);
    m->material = p->pot;
    scene_mesh_enter(m, 7.65, 0.91, 1.35, 0);
    scene_ware_draw(m, SCENE_WARE_GLASS, 0.11, 0.16, 5);
    m->frame = world;
}

/* A case of books against the back wall, from x = 0.7 to 1.9. */
static void book_case(scene_mesh *m, const palette *p)
{
    scene_frame world = scene_mesh_enter(m, 0.7, 0, 0.001, 0);
    m->material = p->wood;
    for (int i = 0; i < 2; i++)
        scene_mesh_box(m, scene_at(i ? 1.17 : 0, 0, 0), scene_at(i ? 1.2 : 0.03, 1.8, 0.28),
        SCENE_FACES_STANDING & SCENE_FACES_NO_BACK);
    for (int i = 0; i < 4; i++)
        scene_mesh_box(m, scene_at(0.03, 0.08 + 0.55 * i, 0), scene_at(1.17, 0.11 + 0.55 * i, 0.27),
            SCENE_FACE_TOP | SCENE_FACE_BOTTOM | SCENE_FACE_FRONT);
    static const struct {
        double x, width;
        unsigned count;
    } row[3] = {{0.04, 0.9, 4}, {0.06, 0.9, 7}, {0.5, 0.6, 4}};
    for (int i = 0; i < 3; i++) {
        scene_frame shelf = scene_mesh_enter(m, row[i].x, 0.11 + 0.55 * i, 0.24, 0);
        scene_books(m, row[i].width, 0.40, 0.2, row[i].count, p->book, 5);
        m->frame = shelf;
    }
    m->frame = world;
}

static void sofa(scene_mesh *m, const palette *p)
{
    /* under the window, its back to the wall x = 0 */
    m->material = p->sofa;
    scene_mesh_box(m, scene_at(0.30, 0.08, 1.42), scene_at(0.95, 0.42, 2.98), SCENE_FACE_RIGHT | SCENE_FACE_TOP
        | SCENE_FACE_BOTTOM);
    scene_mesh_box(m, scene_at(0.06, 0, 1.42), scene_at(0.30, 0.80, 2.98), SCENE_FACE_LEFT | SCENE_FACE_RIGHT
        | SCENE_FACE_TOP);
    for (int i = 0; i < 2; i++)
        scene_mesh_box(m, scene_at(0.05, 0, i ? 2.98 : 1.22), scene_at(0.98, 0.58, i ? 3.18 : 1.42),
        SCENE_FACES_STANDING);
}

static void table_and_chairs(scene_mesh *m, const palette *p)
{
    static const double place[3][3] = {{-0.35, -0.62, 0.01}, {0.48, -0.72, -0.03}, {0.95, 0.10, 0.76}};
    scene_frame world = scene_mesh_enter(m, 2.75, 0, 1.75, 0.02);
    m->material = p->wood;
    scene_table(m, 1.5, 0.85, 0.75);
    for (int i = 0; i < 3; i++) {
        scene_frame table = scene_mesh_enter(m, place[i][0], 0, place[i][1], place[i][2]);
        m->material = p->dark;
        scene_chair(m);
        m->frame = table;
    }
    m->frame = world;
    m->material = p->rug;
    scene_mesh_box(m, scene_at(1.55, 0, 0.75), scene_at(4.15, 0.012, 3.0), SCENE_FACES_STANDING);
    scene_mesh_enter(m, 2.75, HEIGHT, 1.75, 0);
    m->material = p->dark;
    scene_mesh_beam(m, scene_at(0, -0.75, 0), scene_at(0, 0, 0), 0.012, 0.012, 0);
    m->material = p->lamp;
    scene_mesh_enter(m, 0, -0.98, 0, 0);
    scene_ware_draw(m, SCENE_WARE_SHADE, 0.26, 0.24, 6);
    m->frame = world;
}

base_status scene_build_rooms(scene *s, base_error *err)
{
    scene_mesh m = scene_mesh_begin(s, 6, err);
    palette p = paint_palette(&m);
    scene_frame world = m.frame;
    living_room(&m, &p);
    bedroom(&m, &p);
    kitchen(&m, &p);
    book_case(&m, &p);
    sofa(&m, &p);
    table_and_chairs(&m, &p);
    scene_mesh_enter(&m, 2.60, 1.55, 0, 0);
    scene_picture(&m, 0.9, 0.6, p.dark, p.canvas);
    m.frame = world;
    scene_mesh_enter(&m, 4.6, 0, 0.42, 0);
    m.material = p.pot;
    scene_ware_draw(&m, SCENE_WARE_POT, 0.20, 0.34, 5);
    m.material = p.leaf;
    scene_mesh_enter(&m, 0, 0.72, 0, 0);
    scene_leaves(&m, 8, 0.18, 0.38, 0.42);
    m.frame = world;
    scene_mesh_enter(&m, 2.75, 0.752, 1.75, 0);
    m.material = p.fruit; /* lies about on the table: what the count leaves over */
    if (s->triangle_count < SCENE_ROOMS_TRIANGLES)
        scene_pebbles(&m, SCENE_ROOMS_TRIANGLES - s->triangle_count, -0.25, -0.2, 0.25, 0.15, 0.06);
    base_status status = scene_mesh_end(&m, SCENE_ROOMS_TRIANGLES);
    const double eye[3] = {1.0, 1.65, 4.35}, target[3] = {2.9, 1.05, 1.0}, up[3] = {0, 1, 0};
    s->light = (scene_light){.has_area = 1, .corner = {1.5, 2.55, 1.9}, .u = {0.9, 0, 0}, .v = {0, 0, 0.9}};
    return status != BASE_OK ? status : scene_add_camera(s, scene_camera_look_at("main", eye, target, up, 1.13), err);
}
