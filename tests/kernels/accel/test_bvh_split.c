/* One split of a list against a plain search over all bin boundaries. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "kernels/accel/bvh_split.h"
#include "lrbni/base/random.h"
#include "tests/kernels/accel/soup.h"

enum { MOST = 400 };

typedef struct list {
    size_t count;
    bvh_ref refs[MOST];
    bvh_frame frame;
    bvh_bins bins;
} list;

static void list_fill(list *l, const scene *s, unsigned bins)
{
    l->count = s->triangle_count;
    for (size_t i = 0; i < l->count; i++)
        l->refs[i] = bvh_ref_create(&s->triangles[i], (uint32_t)i);
    l->frame = bvh_frame_create(bvh_refs_extent(l->refs, l->count), bins);
    bvh_bins_fill(&l->bins, &l->frame, l->refs, l->count);
}

static unsigned bin_of(const list *l, const scene_triangle *t, int axis)
{
    float low = fminf(t->v[0][axis], fminf(t->v[1][axis], t->v[2][axis]));
    float high = fmaxf(t->v[0][axis], fmaxf(t->v[1][axis], t->v[2][axis]));
    float place = (high + low - l->frame.origin[axis]) * l->frame.scale[axis];
    return (unsigned)fminf(floorf(place), l->frame.top);
}

/* Area times count of the triangles whose bin is on one side of a boundary; *count of them. */
static double side_cost(const list *l, const scene *s, int axis, unsigned bin, int right, size_t *count)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    *count = 0;
    for (size_t i = 0; i < s->triangle_count; i++) {
        const scene_triangle *t = &s->triangles[i];
        if ((bin_of(l, t, axis) > bin) != right)
            continue;
        ++*count;
        for (int corner = 0; corner < 3; corner++)
            for (int a = 0; a < 3; a++) {
                low[a] = fmin(low[a], (double)t->v[corner][a]);
                high[a] = fmax(high[a], (double)t->v[corner][a]);
            }
    }
    double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return *count ? (x * y + y * z + z * x) * (double)*count : 0.0;
}

/* The split that bvh_bins_split must find, by trying all. */
static bvh_split search(const list *l, const scene *s, unsigned bins, size_t most)
{
    bvh_split best = {.axis = -1};
    double least = HUGE_VAL;
    for (int axis = 0; axis < 3; axis++)
        for (unsigned bin = 0; bin + 1 < bins; bin++) {
            size_t left, right;
            double cost = side_cost(l, s, axis, bin, 0, &left) + side_cost(l, s, axis, bin, 1, &right);
            if (left && right && left <= most && right <= most && cost < least) {
                least = cost;
                best = (bvh_split){.axis = axis, .bin = bin, .left_count = left};
            }
        }
    return best;
}

static void check_split(const scene *s, unsigned bins, size_t most)
{
    list *l = calloc(1, sizeof *l);
    assert_non_null(l);
    list_fill(l, s, bins);
    bvh_split found = bvh_bins_split(&l->bins, bins, most), expected = search(l, s, bins, most);
    assert_int_equal(found.axis, expected.axis);
    if (found.axis >= 0) {
        assert_int_equal(found.bin, expected.bin);
        assert_int_equal(found.left_count, expected.left_count);
        assert_int_equal(bvh_bins_left_count(&l->bins, &found), found.left_count);
    }
    free(l);
}

static void bvh_split__random_lists__least_cost_of_all_boundaries(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 150; seed++) {
        scene s = soup_random(seed, 2 + seed * 7 % 300, 0.3);
        check_split(&s, 2 + seed % 63, SIZE_MAX);
        soup_free(&s);
    }
}

static void bvh_split__limited_sides__least_cost_within_the_limit(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 50; seed++) {
        scene s = soup_clustered(seed, 100);
        check_split(&s, 16, 50 + seed % 20);
        soup_free(&s);
    }
}

static void bvh_split__equal_costs__lowest_axis_then_lowest_bin(void **state)
{
    (void)state;
    /* Eight equal triangles at the corners of a cube: all three axes cost the same, and bins 1..14 are empty. */
    scene s = soup_create("corners", 8);
    for (int i = 0; i < 8; i++)
        for (int corner = 0; corner < 3; corner++)
            for (int axis = 0; axis < 3; axis++)
                s.triangles[i].v[corner][axis] = (float)(4 * (i >> axis & 1) + (corner == axis));
    list *l = calloc(1, sizeof *l);
    assert_non_null(l);
    list_fill(l, &s, 16);
    bvh_split split = bvh_bins_split(&l->bins, 16, SIZE_MAX);
    assert_int_equal(split.axis, 0);
    assert_int_equal(split.bin, 0);
    assert_int_equal(split.left_count, 4);
    free(l);
    soup_free(&s);
}

static void bvh_split__equal_centroids__no_split(void **state)
{
    (void)state;
    scene s = soup_identical(20);
    check_split(&s, 16, SIZE_MAX);
    soup_free(&s);
}

static void bvh_split__list_in_pieces__same_bins(void **state)
{
    (void)state;
    scene s = soup_random(3, 300, 0.2);
    list *l = calloc(1, sizeof *l);
    bvh_bins *sum = calloc(1, sizeof *sum), *part = calloc(1, sizeof *part);
    assert_true(l && sum && part);
    list_fill(l, &s, 16);
    bvh_bins_fill(sum, &l->frame, l->refs, 0);
    for (size_t begin = 0; begin < 300; begin += 60) {
        bvh_bins_fill(part, &l->frame, l->refs + begin, 60);
        bvh_bins_add(sum, part, 16);
    }
    for (int axis = 0; axis < 3; axis++)
        for (int bin = 0; bin < 16; bin++) {
            const float *a = sum->box[axis][bin].v, *b = l->bins.box[axis][bin].v;
            assert_memory_equal(a, b, 3 * sizeof *a);
            assert_memory_equal(a + 4, b + 4, 3 * sizeof *a);
            assert_int_equal(sum->count[axis][bin], l->bins.count[axis][bin]);
        }
    free(l);
    free(sum);
    free(part);
    soup_free(&s);
}

static void bvh_split__division__sides_by_bin_in_the_order_of_the_list(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        scene s = soup_random(seed, MOST, 0.2);
        list *l = calloc(1, sizeof *l);
        bvh_ref *to = calloc(MOST, sizeof *to);
        assert_true(l && to);
        list_fill(l, &s, 16);
        bvh_split split = bvh_bins_split(&l->bins, 16, SIZE_MAX);
        assert_true(split.axis >= 0);
        bvh_refs_divide(l->refs, MOST, &l->frame, &split, to, 0, split.left_count);
        for (size_t i = 0; i < MOST; i++) {
            uint32_t id = bvh_ref_id(&to[i]);
            assert_int_equal(bin_of(l, &s.triangles[id], split.axis) > split.bin, i >= split.left_count);
            assert_true(i == 0 || i == split.left_count || bvh_ref_id(&to[i - 1]) < id);
        }
        accel_box left = bvh_refs_box(to, split.left_count);
        accel_box right = bvh_refs_box(to + split.left_count, MOST - split.left_count);
        assert_memory_equal(left.v, split.left.v, 12);
        assert_memory_equal(left.v + 4, split.left.v + 4, 12);
        assert_memory_equal(right.v, split.right.v, 12);
        assert_memory_equal(right.v + 4, split.right.v + 4, 12);
        free(l);
        free(to);
        soup_free(&s);
    }
}

static void bvh_split__ids__come_back(void **state)
{
    static const uint32_t ids[] = {0, 1, 0x7fffff, 0x800000, 0x1ffffff};
    const scene_triangle t = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    (void)state;
    for (size_t i = 0; i < sizeof ids / sizeof *ids; i++) {
        bvh_ref ref = bvh_ref_create(&t, ids[i]);
        assert_int_equal(bvh_ref_id(&ref), ids[i]);
        assert_true(isnormal(ref.v[3]));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bvh_split__random_lists__least_cost_of_all_boundaries),
        cmocka_unit_test(bvh_split__limited_sides__least_cost_within_the_limit),
        cmocka_unit_test(bvh_split__equal_costs__lowest_axis_then_lowest_bin),
        cmocka_unit_test(bvh_split__equal_centroids__no_split),
        cmocka_unit_test(bvh_split__list_in_pieces__same_bins),
        cmocka_unit_test(bvh_split__division__sides_by_bin_in_the_order_of_the_list),
        cmocka_unit_test(bvh_split__ids__come_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
