/* A building of seven storeys, 48 by 24.4 m: galleries about a court that is open through all storeys, furnished rooms along
 * both sides of them. The court's middle is the origin, x runs along the building, y = 0 is the lowest floor. */
#include "scene/builtin/furniture.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/tower_rooms.h"

enum { STOREYS = 7, ROOMS = 12 }; /* rooms on a side of a storey */

#define COUNT_OF(a) (sizeof(a) / sizeof *(a))
#define STOREY 3.4
#define HALF_X 24.0
#define HALF_Z 6.2 /* of the galleries, to the wall of the rooms */
#define COURT_X 9.0
#define COURT_Z 3.4
#define SLAB (STOREY - SCENE_TOWER_ROOM_HEIGHT)
#define FLIGHT 1.3 /* a stair's width */

/* Posts and rails along x. */
static void railing(scene_mesh *m, const scene_office_palette *p, double x0, double x1)
{
    static const scene_profile post[] = {{0.05, 0}, {0.05, 0.02}, {0.022, 0.03}, {0.022, 0.98}, {0.03, 1.0}};
    unsigned posts = 1 + (unsigned)((x1 - x0) / 1.1);
    m->material = p->steel;
    for (unsigned i = 0; i <= posts; i++) {
        scene_frame before = scene_mesh_enter(m, x0 + (x1 - x0) * i / posts, 0, 0, 0);
        scene_mesh_lathe(m, post, COUNT_OF(post), 8);
        m->frame = before;
    }
    for (int i = 0; i < 7; i++) {
        scene_point rail[2] = {{x0, 0.16 + 0.12 * i, 0}, {x1, 0.16 + 0.12 * i, 0}};
        scene_mesh_pipe(m, rail, 2, 0.007, 6);
    }
    m->material = p->wood[0];
    scene_mesh_box(m, scene_at(x0 - 0.03, 1.0, -0.04), scene_at(x1 + 0.03, 1.05, 0.04), SCENE_FACES_ALL);
}

/* The floor of the galleries with its underside and the edge about the court. */
static void slab(scene_mesh *m, const scene_office_palette *p)
{
    static const double x[3][2] = {{-HALF_X, -COURT_X}, {-COURT_X, COURT_X}, {COURT_X, HALF_X}};
    for (int i = 0; i < 3; i++)
        for (int side = -1; side < 2; side += 2) {
            double z0 = i == 1 ? side * COURT_Z : 0.0, z1 = side * HALF_Z, low = side < 0 ? z1 : z0, high = side < 0 ? z0 : z1;
            m->material = p->carpet[0];
            scene_mesh_floor(m, x[i][0], low, x[i][1], high, 0);
            m->material = p->ceiling;
            scene_mesh_ceiling(m, x[i][0], low, x[i][1], high, -SLAB);
        }
    m->material = p->trim;
    scene_mesh_room(m, scene_at(-COURT_X, -SLAB, -COURT_Z), scene_at(COURT_X, 0, COURT_Z), SCENE_FACES_AROUND);
}

/* A flight from this storey to the next, rising along +x inside the court's edge, with a landing at each end. */
static void flight(scene_mesh *m, const scene_office_palette *p)
{
    enum { STEPS = 19 };
    double rise = STOREY / (STEPS + 1), tread = 6.0 / STEPS;
    for (int i = 0; i < STEPS; i++) {
        double x = -3.0 + tread * i, y = rise * (i + 1);
        m->material = p->wood[1];
        scene_mesh_box(m, scene_at(x - 0.02, y - 0.04, 0.05), scene_at(x + tread, y, FLIGHT - 0.05), SCENE_FACES_ALL);
    }
    m->material = p->steel;
    for (int side = 0; side < 2; side++) {
        double z = side ? FLIGHT - 0.03 : 0.03;
        scene_mesh_beam(m, scene_at(-3.2, -0.10, z), scene_at(3.0, STOREY - 0.10, z), 0.05, 0.24, 1);
        scene_mesh_beam(m, scene_at(-3.1, 0.98, z), scene_at(3.0, STOREY + 0.98, z), 0.05, 0.04, 1);
        for (int i = 0; i <= STEPS; i++) {
            double x = -3.0 + tread * i, y = rise * i;
            scene_mesh_beam(m, scene_at(x, y + 0.05, z), scene_at(x, y + 1.0, z), 0.014, 0.014, 0);
        }
    }
    m->material = p->trim;
    scene_mesh_box(m, scene_at(-4.3, -0.2, 0), scene_at(-3.0, 0, FLIGHT), SCENE_FACES_ALL);
    scene_mesh_box(m, scene_at(3.0, STOREY - 0.2, 0), scene_at(4.3, STOREY, FLIGHT), SCENE_FACES_ALL);
    scene_frame before = scene_mesh_enter(m, 0, 0, FLIGHT, 0);
    railing(m, p, -4.3, -3.1);
    scene_mesh_enter(m, 0, STOREY, 0, 0);
    railing(m, p, 3.1, 4.3);
    m->frame = before;
}

/* The rails about the court, open where flights begin and end: storey by storey they lie on the one side and the other. */
static void rails(scene_mesh *m, const scene_office_palette *p, int storey)
{
    scene_frame before = m->frame;
    for (int side = 0; side < 2; side++) {
        int begins = storey % 2 == side && storey + 1 < STOREYS, ends = storey % 2 != side;
        scene_mesh_enter(m, 0, 0, side ? COURT_Z + 0.06 : -COURT_Z - 0.06, side ? 0.5 : 0.0);
        railing(m, p, -COURT_X, -4.35);
        railing(m, p, begins ? -3.0 : -4.25, ends ? 3.0 : 4.25);
        railing(m, p, 4.35, COURT_X);
        m->frame = before;
        scene_mesh_enter(m, side ? COURT_X + 0.06 : -COURT_X - 0.06, 0, 0, side ? 0.75 : 0.25);
        railing(m, p, -COURT_Z, COURT_Z);
        m->frame = before;
    }
}

/* What stands and hangs in the galleries: lamps, benches, plants, boards between the doors. */
static void gallery_things(scene_mesh *m, const scene_office_palette *p)
{
    scene_frame before = m->frame;
    for (int i = 0; i < 2 * ROOMS; i++) {
        double x = -HALF_X + (i / 2 + 0.5) * SCENE_TOWER_ROOM_WIDTH;
        int side = i % 2;
        scene_mesh_enter(m, x, SCENE_TOWER_ROOM_HEIGHT, side ? 4.8 : -4.8, 0);
        scene_ceiling_lamp(m, p, 1.2, 24, 1);
        m->frame = before;
        scene_mesh_enter(m, x + SCENE_TOWER_ROOM_WIDTH / 2, 0, side ? HALF_Z - 0.35 : 0.35 - HALF_Z, side ? 0.5 : 0.0);
        if (i % 6 == 1 && i + 2 < 2 * ROOMS)
            scene_pot_plant(m, p, 1.5, 80, 2);
        m->frame = before;
    }
    for (int i = 0; i < 4; i++) {
        scene_mesh_enter(m, i & 1 ? 14.0 : -14.0, 0, i & 2 ? 0.55 : -0.55, i & 2 ? 0.0 : 0.5);
        scene_armchair(m, p, (unsigned)i, 1.9, 2);
        m->frame = before;
    }
    for (int i = 0; i < 2; i++) { /* the ends of the building */
        const scene_opening window = {-2.2, 2.2, 0.6, 2.6};
        scene_mesh_enter(m, i ? HALF_X : -HALF_X, 0, 0, i ? 0.75 : 0.25);
        m->material = p->wall;
        scene_wall(m, -HALF_Z, 0, HALF_Z, SCENE_TOWER_ROOM_HEIGHT, window);
        m->material = p->trim;
        scene_reveal(m, window, 0.25, SCENE_FACE_LEFT | SCENE_FACE_RIGHT | SCENE_FACE_TOP | SCENE_FACE_BOTTOM);
        scene_window_bars(m, window, 4, 3, 0.05);
        m->material = p->glass;
        scene_reveal(m, window, 0.25, SCENE_FACE_BACK);
        m->frame = before;
    }
}

static void storey(scene_mesh *m, const scene_office_palette *p, int number)
{
    scene_frame world = scene_mesh_enter(m, 0, STOREY * number, 0, 0), floor = m->frame;
    if (number > 0) {
        slab(m, p);
        rails(m, p, number);
    }
    gallery_things(m, p);
    if (number + 1 < STOREYS) {
        scene_mesh_enter(m, 0, 0, number % 2 ? COURT_Z : -COURT_Z, number % 2 ? 0.5 : 0.0);
        flight(m, p);
        m->frame = floor;
    }
    for (int i = 0; i < 2 * ROOMS; i++) {
        double kind = scene_mesh_random(m, 0, 5), x = -HALF_X + (i / 2 + 0.5) * SCENE_TOWER_ROOM_WIDTH;
        scene_mesh_enter(m, x, 0, i % 2 ? HALF_Z + SCENE_TOWER_WALL : -HALF_Z - SCENE_TOWER_WALL, i % 2 ? 0.0 : 0.5);
        scene_tower_room(m, p, (unsigned)kind);
        m->frame = floor;
    }
    m->frame = world;
}

/* The court's floor with a garden on gravel, which takes what the count leaves over, and its glazed roof. */
static void court(scene_mesh *m, const scene_office_palette *p)
{
    double top = STOREY * STOREYS - SLAB;
    scene_frame world = m->frame;
    m->material = p->carpet[2];
    scene_mesh_floor(m, -HALF_X, -HALF_Z, HALF_X, HALF_Z, 0);
    m->material = p->ceiling;
    scene_mesh_ceiling(m, -HALF_X, -HALF_Z, HALF_X, HALF_Z, top);
    m->material = p->steel;
    for (int i = 0; i < 13; i++) {
        double x = -COURT_X + 1.5 * i;
        scene_mesh_box(m, scene_at(x - 0.06, top - 0.35, -COURT_Z), scene_at(x + 0.06, top, COURT_Z), SCENE_FACES_HANGING);
    }
    m->material = p->trim;
    scene_mesh_box(m, scene_at(-6.5, 0, -1.3), scene_at(6.5, 0.45, -1.1), SCENE_FACES_STANDING);
    scene_mesh_box(m, scene_at(-6.5, 0, 1.1), scene_at(6.5, 0.45, 1.3), SCENE_FACES_STANDING);
    scene_mesh_box(m, scene_at(-6.5, 0, -1.1), scene_at(-6.3, 0.45, 1.1), SCENE_FACES_STANDING);
    scene_mesh_box(m, scene_at(6.3, 0, -1.1), scene_at(6.5, 0.45, 1.1), SCENE_FACES_STANDING);
    for (int i = 0; i < 14; i++) {
        double x = -5.8 + 0.9 * i, z = scene_mesh_random(m, -0.5, 0.5), height = scene_mesh_random(m, 1.2, 2.8);
        scene_mesh_enter(m, x, 0.2, z, 0.1 * i);
        scene_pot_plant(m, p, height, 240, 3);
        m->frame = world;
    }
    m->material = p->trim;
    scene_mesh_enter(m, 0, 0.30, 0, 0);
    if (m->target->triangle_count < SCENE_TOWER_TRIANGLES)
        scene_pebbles(m, SCENE_TOWER_TRIANGLES - m->target->triangle_count, -6.2, -1.0, 6.2, 1.0, 0.05);
    m->frame = world;
}

base_status scene_build_tower(scene *s, base_error *err)
{
    scene_mesh m = scene_mesh_begin(s, 2195, err);
    scene_office_palette p = scene_office_paint(&m);
    for (int i = 0; i < STOREYS; i++)
        storey(&m, &p, i);
    court(&m, &p);
    base_status status = scene_mesh_end(&m, SCENE_TOWER_TRIANGLES);
    const double eye[3] = {10.6, 3 * STOREY + 1.75, 3.9}, target[3] = {-4.0, 3 * STOREY + 0.1, -3.0}, up[3] = {0, 1, 0};
    s->light = (scene_light){.has_area = 1, .corner = {2.0, 3 * STOREY + 2.9, -1.5}, .u = {4, 0, 0}, .v = {0, 0, 3}};
    if (status == BASE_OK)
        status = scene_add_camera(s, scene_camera_look_at("main", eye, target, up, 1.15), err);
    const double seat[3] = {3.5, 3 * STOREY + 1.6, HALF_Z + 1.0}, window[3] = {1.4, 3 * STOREY + 0.9, HALF_Z + 5.0};
    return status != BASE_OK ? status : scene_add_camera(s, scene_camera_look_at("room", seat, window, up, 1.15), err);
}
