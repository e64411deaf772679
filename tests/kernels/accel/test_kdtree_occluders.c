/* Empty occluders against solid angles: an empty leaf's set holds exactly the closed components that wind around its points
   (hard cases C9, C10). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "kernels/accel/kdtree.h"
#include "lrbni/base/random.h"
#include "tests/kernels/accel/kdtree_check.h"
#include "tests/kernels/accel/soup.h"

enum { ROOM = 20000 }; /* triangles, at most */

/* A scene that grows shape by shape, and where each shape's triangles begin. */
typedef struct shapes {
    scene scene;
    size_t first[16], count;
} shapes;

static shapes shapes_create(void)
{
    shapes s = {.scene = soup_create("shapes", ROOM)};
    s.scene.triangle_count = 0;
    return s;
}

static void add(shapes *s, const float a[3], const float b[3], const float c[3])
{
    scene_triangle *t = &s->scene.triangles[s->scene.triangle_count++];
    memcpy(t->v[0], a, sizeof t->v[0]);
    memcpy(t->v[1], b, sizeof t->v[1]);
    memcpy(t->v[2], c, sizeof t->v[2]);
}

static void begin_shape(shapes *s)
{
    s->first[s->count++] = s->scene.triangle_count;
    s->first[s->count] = ROOM;
}

/* A box, outward. */
static void add_box(shapes *s, float x0, float y0, float z0, float x1, float y1, float z1)
{
    static const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    begin_shape(s);
    for (int q = 0; q < 6; q++) {
        float p[4][3];
        for (int i = 0; i < 4; i++) {
            p[i][0] = quads[q][i] & 1 ? x1 : x0;
            p[i][1] = quads[q][i] & 2 ? y1 : y0;
            p[i][2] = quads[q][i] & 4 ? z1 : z0;
        }
        add(s, p[0], p[1], p[2]);
        add(s, p[0], p[2], p[3]);
    }
}

/* A ball of n meridians and n / 2 parallels, outward; its poles are single points. */
static void add_ball(shapes *s, const float centre[3], float radius, int n)
{
    begin_shape(s);
    for (int i = 0; i < n / 2; i++)
        for (int j = 0; j < n; j++) {
            float p[4][3];
            for (int k = 0; k < 4; k++) {
                int row = i + k / 2, column = (j + (k & 1)) % n;
                double theta = 3.14159265358979 * row / (n / 2), phi = 6.28318530717959 * column / n;
                double ring = row == 0 || row == n / 2 ? 0.0 : sin(theta);
                p[k][0] = (float)((double)centre[0] + (double)radius * ring * cos(phi));
                p[k][1] = (float)((double)centre[1] + (double)radius * cos(theta));
                p[k][2] = (float)((double)centre[2] + (double)radius * ring * sin(phi));
            }
            if (i > 0)
                add(s, p[0], p[1], p[2]);
            if (i < n / 2 - 1)
                add(s, p[1], p[3], p[2]);
        }
}

/* Times that a shape winds around a point: solid angles over 4 pi (Van Oosterom and Strackee 1983). */
static double winding(const shapes *s, size_t shape, const double point[3])
{
    double sum = 0.0;
    for (size_t i = s->first[shape]; i < s->first[shape + 1] && i < s->scene.triangle_count; i++) {
        double v[3][3], length[3];
        for (int k = 0; k < 3; k++) {
            for (int axis = 0; axis < 3; axis++)
                v[k][axis] = (double)s->scene.triangles[i].v[k][axis] - point[axis];
            length[k] = sqrt(v[k][0] * v[k][0] + v[k][1] * v[k][1] + v[k][2] * v[k][2]);
        }
        double det = 0.0, dots = length[0] * length[1] * length[2];
        for (int axis = 0; axis < 3; axis++) {
            int b = (axis + 1) % 3, c = (axis + 2) % 3;
            det += v[0][axis] * (v[1][b] * v[2][c] - v[1][c] * v[2][b]);
            dots += v[0][axis] * v[1][axis] * length[2] + v[1][axis] * v[2][axis] * length[0];
            dots += v[2][axis] * v[0][axis] * length[1];
        }
        sum += 2.0 * atan2(det, dots);
    }
    return sum / (4.0 * 3.14159265358979);
}

typedef struct check {
    const shapes *shapes;
    const bool *closed; /* by shape; closed ones are components 0, 1, ... */
    bool oriented;      /* all of those are */
    base_random random;
    size_t inside;
} check;

static void check_leaf(void *user, const kdtree *tree, const kdtree_leaf *leaf)
{
    check *c = user;
    double point[3];
    if (kdtree_leaf_count(leaf->node) > 0)
        return;
    const kdtree_set *set = &tree->sets[leaf->node->link / 4];
    for (int axis = 0; axis < 3; axis++) {
        if (!(leaf->max[axis] > leaf->min[axis]))
            return;
        point[axis] = base_random_range(&c->random, (double)leaf->min[axis], (double)leaf->max[axis]);
    }
    uint32_t component = 0, found = 0;
    for (size_t shape = 0; shape < c->shapes->count; shape++) {
        if (!c->closed[shape])
            continue;
        double turns = winding(c->shapes, shape, point);
        bool listed = false;
        for (uint32_t k = 0; k < set->count; k++) {
            uint32_t member = tree->members[set->first + k];
            listed |= member >> 1 == component;
            if (member >> 1 == component && c->oriented)
                assert_int_equal(member & KDTREE_OUTWARD, turns > 0.5 ? KDTREE_OUTWARD : 0);
            if (!c->oriented)
                assert_int_equal(member & KDTREE_OUTWARD, 0);
        }
        assert_int_equal(listed, fabs(turns) > 0.5);
        found += listed;
        component++;
    }
    assert_int_equal(found, set->count);
    c->inside += set->count > 0;
}

/* Build, and compare every empty leaf; the tree is the caller's. */
static kdtree *check_shapes(const shapes *s, const bool *closed, bool oriented, size_t *inside)
{
    kdtree_options options = kdtree_options_default();
    kdtree *tree = NULL;
    check c = {.shapes = s, .closed = closed, .oriented = oriented, .random = {5}};
    options.min_area = 0;
    options.jobs = 2;
    assert_int_equal(kdtree_build(&s->scene, &options, &tree, NULL), BASE_OK);
    kdtree_check(&s->scene, tree, &options);
    kdtree_each_leaf(tree, check_leaf, &c);
    *inside = c.inside;
    return tree;
}

static size_t marked(const kdtree *tree)
{
    size_t count = 0;
    for (size_t i = 0; i < tree->node_count; i++)
        count += i != 1 && kdtree_is_leaf(&tree->nodes[i]) && kdtree_leaf_count(&tree->nodes[i]) == 0 &&
                 (tree->nodes[i].extent & KDTREE_OCCLUDER) != 0;
    return count;
}

static void occluders__balls_and_boxes__sets_of_the_solid_angles(void **state)
{
    static const float at[3] = {0.5f, 0.25f, -0.125f}, beside[3] = {3.0f, 0.0f, 0.0f}, over[3] = {0.75f, 1.5f, 0.0f};
    static const bool closed[] = {true, true, true, true};
    shapes s = shapes_create();
    size_t inside;
    (void)state;
    add_ball(&s, at, 1.0f, 24);
    add_ball(&s, beside, 0.75f, 16);
    add_box(&s, -4.0f, -3.0f, -3.0f, -2.0f, 2.0f, 1.0f);
    add_ball(&s, over, 1.0f, 16); /* runs through the first */
    kdtree *tree = check_shapes(&s, closed, true, &inside);
    assert_in_range(inside, 100, tree->empty_count - 100);
    kdtree_destroy(&tree);
    soup_free(&s.scene);
}

static void occluders__nested__both_or_one(void **state)
{
    static const float at[3] = {0.0f, 0.0f, 0.0f};
    static const float origins[][3] = {{0.0f, 0.0f, 1.5f}, {0.01f, 0.02f, 0.03f}, {9.0f, 0.0f, 0.0f}};
    static const bool closed[] = {true, true};
    shapes s = shapes_create();
    size_t inside;
    (void)state;
    add_ball(&s, at, 2.0f, 16);
    add_ball(&s, at, 1.0f, 16);
    kdtree *tree = check_shapes(&s, closed, true, &inside);
    assert_int_equal(tree->set_count, 3);
    assert_int_equal(kdtree_mark_occluders(tree, NULL, 0, false, NULL), BASE_OK);
    assert_int_equal(marked(tree), tree->enclosed_count);
    assert_int_equal(kdtree_mark_occluders(tree, &origins[2], 1, false, NULL), BASE_OK); /* outside of the scene */
    assert_int_equal(marked(tree), tree->enclosed_count);
    assert_int_equal(kdtree_mark_occluders(tree, origins, 1, false, NULL), BASE_OK); /* between the two: only the inner one occludes */
    assert_in_range(marked(tree), 1, tree->enclosed_count - 1);
    assert_int_equal(kdtree_mark_occluders(tree, origins, 2, false, NULL), BASE_OK); /* in both */
    assert_int_equal(marked(tree), 0);
    kdtree_destroy(&tree);
    soup_free(&s.scene);
}

static void occluders__origin_on_the_surface__counts_as_inside(void **state)
{
    static const float origins[][3] = {{1.0f, 0.5f, 0.25f}, {0.0f, 0.0f, 0.0f}};
    static const bool closed[] = {true};
    shapes s = shapes_create();
    size_t inside;
    (void)state;
    add_box(&s, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f);
    kdtree *tree = check_shapes(&s, closed, true, &inside);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(kdtree_mark_occluders(tree, &origins[i], 1, false, NULL), BASE_OK);
        assert_int_equal(marked(tree), 0);
    }
    kdtree_destroy(&tree);
    soup_free(&s.scene);
}

static void turn(shapes *s, size_t shape)
{
    for (size_t i = s->first[shape]; i < s->first[shape + 1] && i < s->scene.triangle_count; i++) {
        float (*v)[3] = s->scene.triangles[i].v, swapped[3];
        memcpy(swapped, v[1], sizeof swapped);
        memcpy(v[1], v[2], sizeof swapped);
        memcpy(v[2], swapped, sizeof swapped);
    }
}

/* Of back faces that are culled nothing is hit, and what is behind them is seen. */
static void occluders__fronts_inside__nothing_where_back_faces_are_culled(void **state)
{
    static const bool closed[] = {true, true, true};
    static const float at[3] = {0.5f, 0.5f, 0.5f};
    shapes s = shapes_create();
    size_t inside;
    (void)state;
    add_box(&s, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f);
    add_box(&s, 2.0f, 0.0f, 0.0f, 3.0f, 1.0f, 1.0f);
    add_ball(&s, at, 0.25f, 12);
    turn(&s, 0);
    turn(&s, 2);
    kdtree *tree = check_shapes(&s, closed, true, &inside);
    assert_int_equal(kdtree_mark_occluders(tree, NULL, 0, false, NULL), BASE_OK);
    assert_int_equal(marked(tree), tree->enclosed_count);
    assert_int_equal(kdtree_mark_occluders(tree, NULL, 0, true, NULL), BASE_OK); /* the second box */
    assert_in_range(marked(tree), 1, tree->enclosed_count - 1);
    kdtree_destroy(&tree);
    soup_free(&s.scene);
}

/* Its edges are used four times: one component, which parity alone would not find its points in. */
static void occluders__same_ball_twice__wound_twice(void **state)
{
    static const float at[3] = {0.0f, 0.0f, 0.0f};
    static const float origin[1][3] = {{0.0f, 0.1f, 0.0f}};
    static const bool closed[] = {true};
    shapes s = shapes_create();
    size_t inside;
    (void)state;
    add_ball(&s, at, 1.0f, 12);
    add_ball(&s, at, 1.0f, 12);
    s.count = 1;
    s.first[1] = ROOM;
    kdtree *tree = check_shapes(&s, closed, true, &inside);
    assert_true(inside > 20);
    for (int cull = 0; cull < 2; cull++) {
        assert_int_equal(kdtree_mark_occluders(tree, NULL, 0, cull, NULL), BASE_OK);
        assert_int_equal(marked(tree), tree->enclosed_count);
        assert_int_equal(kdtree_mark_occluders(tree, origin, 1, cull, NULL), BASE_OK);
        assert_int_equal(marked(tree), 0);
    }
    kdtree_destroy(&tree);
    soup_free(&s.scene);
}

static void occluders__hole_or_turned_triangle__open_or_closed(void **state)
{
    static const float at[3] = {0.0f, 0.0f, 0.0f};
    static const bool open[] = {false};
    shapes s = shapes_create();
    size_t inside;
    (void)state;
    add_ball(&s, at, 1.0f, 12);
    scene_triangle hole = s.scene.triangles[50];
    s.scene.triangles[50] = s.scene.triangles[--s.scene.triangle_count];
    kdtree *tree = check_shapes(&s, open, true, &inside);
    assert_int_equal(inside, 0);
    kdtree_destroy(&tree);
    s.scene.triangles[s.scene.triangle_count] = hole; /* closed again, one triangle turned: parity does not mind */
    memcpy(s.scene.triangles[s.scene.triangle_count].v[0], hole.v[1], sizeof hole.v[0]);
    memcpy(s.scene.triangles[s.scene.triangle_count++].v[1], hole.v[0], sizeof hole.v[0]);
    static const bool closed[] = {true};
    tree = check_shapes(&s, closed, false, &inside);
    assert_true(inside > 20);
    assert_int_equal(kdtree_mark_occluders(tree, NULL, 0, false, NULL), BASE_OK);
    assert_int_equal(marked(tree), tree->enclosed_count);
    assert_int_equal(kdtree_mark_occluders(tree, NULL, 0, true, NULL), BASE_OK); /* culled, the turned triangle is a hole */
    assert_int_equal(marked(tree), 0);
    kdtree_destroy(&tree);
    soup_free(&s.scene);
}

static void occluders__sheet_on_a_box__only_its_component_is_open(void **state)
{
    static const float a[3] = {1.0f, 1.0f, 1.0f}, b[3] = {1.0f, 1.0f, 0.0f}, c[3] = {2.0f, 1.0f, 0.5f}; /* shares an edge */
    static const bool first_open[] = {false, false, true};
    shapes s = shapes_create();
    size_t inside;
    (void)state;
    add_box(&s, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f);
    begin_shape(&s);
    add(&s, a, b, c);
    add_box(&s, 1.0f, -1.0f, -1.0f, 2.0f, 0.0f, 0.0f); /* shares a vertex */
    kdtree *tree = check_shapes(&s, first_open, true, &inside);
    assert_true(inside > 0);
    kdtree_destroy(&tree);
    soup_free(&s.scene);
}

static void occluders__switched_off__no_components(void **state)
{
    shapes s = shapes_create();
    kdtree_options options = kdtree_options_default();
    kdtree *tree = NULL;
    (void)state;
    add_box(&s, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f);
    options.empty_occluders = 0;
    assert_int_equal(kdtree_build(&s.scene, &options, &tree, NULL), BASE_OK);
    assert_int_equal(tree->set_count, 1);
    assert_int_equal(tree->enclosed_count, 0);
    for (size_t i = 0; i < tree->record_count; i++)
        assert_true(tree->components[i] == KDTREE_OPEN);
    assert_int_equal(kdtree_mark_occluders(tree, NULL, 0, false, NULL), BASE_OK);
    assert_int_equal(marked(tree), 0);
    kdtree_destroy(&tree);
    soup_free(&s.scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(occluders__balls_and_boxes__sets_of_the_solid_angles),
        cmocka_unit_test(occluders__nested__both_or_one),
        cmocka_unit_test(occluders__origin_on_the_surface__counts_as_inside),
        cmocka_unit_test(occluders__fronts_inside__nothing_where_back_faces_are_culled),
        cmocka_unit_test(occluders__same_ball_twice__wound_twice),
        cmocka_unit_test(occluders__hole_or_turned_triangle__open_or_closed),
        cmocka_unit_test(occluders__sheet_on_a_box__only_its_component_is_open),
        cmocka_unit_test(occluders__switched_off__no_components),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
