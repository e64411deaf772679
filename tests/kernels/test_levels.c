/* Levels of accounting change nothing but the accounting; host threads change nothing at all. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lrbni/base/hash.h"
#include "scene/builtin.h"
#include "tests/kernels/trace.h"

enum { SIZE = 80, KERNELS = 7 };

static const char *kernel_names[KERNELS] = {"packet16-primary", "packet256-primary", "mft-primary", "packet16-soft", "packet256-soft", "mft-soft",
                                             "mft-msaa"};

typedef struct fixture {
    scene *s;
    bvh *tree[KERNELS]; /* by kernel */
} fixture;

static int fixture_create(void **state)
{
    static fixture f;
    size_t count;
    char spec[128];
    snprintf(spec, sizeof spec, "builtin:%s", scene_builtin_list(&count)[0].name);
    if (scene_open(spec, &f.s, NULL) != BASE_OK)
        return -1;
    for (int k = 0; k < KERNELS; k++)
        f.tree[k] = trace_tree(f.s, kernel_find(kernel_names[k])->defaults.max_leaf);
    *state = &f;
    return 0;
}

static int fixture_destroy(void **state)
{
    fixture *f = *state;
    for (int k = 0; k < KERNELS; k++)
        bvh_destroy(&f->tree[k]);
    scene_destroy(&f->s);
    return 0;
}

static trace_picture picture(const fixture *f, int kernel, unsigned cull, int level, unsigned jobs)
{
    trace_request request = {.kernel = kernel_names[kernel], .tree = f->tree[kernel], .camera = &f->s->cameras[0], .width = SIZE,
                             .height = SIZE - 3, .cull = cull, .light = &f->s->light, .level = level, .jobs = jobs};
    return trace_run(&request);
}

static void levels__all__same_pictures_and_counts(void **state)
{
    for (int kernel = 0; kernel < KERNELS; kernel++)
        for (unsigned cull = 0; cull < 2; cull++) {
            trace_picture native = picture(*state, kernel, cull, LRB_NATIVE, 1);
            for (int level = LRB_COUNT; level < LRB_LEVELS; level++) {
                trace_picture other = picture(*state, kernel, cull, level, 1);
                trace_assert_equal(&native, &other, kernel_names[kernel]);
                assert_memory_equal(&native.counts, &other.counts, sizeof native.counts);
                trace_free(&other);
            }
            trace_free(&native);
        }
}

static void levels__native__nothing_accounted(void **state)
{
    for (int kernel = 0; kernel < KERNELS; kernel++) {
        trace_picture native = picture(*state, kernel, 0, LRB_NATIVE, 1);
        for (int op = 0; op < LRB_OP_COUNT; op++)
            assert_int_equal(native.ops[op], 0);
        assert_int_equal(native.idle_lanes, 0);
        assert_int_equal(native.events, 0);
        trace_free(&native);
    }
}

/* Markers are no ops: only events have them. */
static void levels__count_and_record__same_histogram(void **state)
{
    for (int kernel = 0; kernel < KERNELS; kernel++)
        for (unsigned cull = 0; cull < 2; cull++) {
            trace_picture count = picture(*state, kernel, cull, LRB_COUNT, 1), record = picture(*state, kernel, cull, LRB_RECORD, 1);
            uint64_t total = 0;
            for (int op = 0; op < LRB_OP_COUNT; op++) {
                total += record.ops[op];
                if (lrb_op_kind_of((lrb_op_id)op) == LRB_KIND_MARKER)
                    assert_int_equal(count.ops[op], 0);
                else if (count.ops[op] != record.ops[op])
                    fail_msg("%s, %s: %llu counted, %llu recorded", kernel_names[kernel], lrb_op_table[op].id,
                             (unsigned long long)count.ops[op], (unsigned long long)record.ops[op]);
            }
            assert_int_equal(total, record.events);
            assert_int_equal(count.idle_lanes, record.idle_lanes);
            assert_true(count.ops[LRB_OP_cmple_ps] > 0);
            trace_free(&count);
            trace_free(&record);
        }
}

static void levels__host_threads__same_everything(void **state)
{
    for (int kernel = 0; kernel < KERNELS; kernel++)
        for (int level = LRB_NATIVE; level < LRB_LEVELS; level++) {
            trace_picture one = picture(*state, kernel, 0, level, 1), three = picture(*state, kernel, 0, level, 3);
            trace_assert_equal(&one, &three, kernel_names[kernel]);
            assert_memory_equal(&one.counts, &three.counts, sizeof one.counts);
            assert_memory_equal(one.ops, three.ops, sizeof one.ops);
            assert_int_equal(one.idle_lanes, three.idle_lanes);
            assert_int_equal(one.events, three.events);
            assert_int_equal(one.events_hash, three.events_hash);
            trace_free(&one);
            trace_free(&three);
        }
}

/* ---- one stream, looked at event by event ---- */

typedef struct stream_check {
    const kernel_job *job;
    uint64_t ops;     /* in the tile so far */
    uint64_t errors;
    char first[160];
} stream_check;

static void complain(stream_check *s, const lrb_event *e, const char *why)
{
    if (s->errors++ == 0)
        snprintf(s->first, sizeof s->first, "op %llu (%s): %s", (unsigned long long)s->ops,
                 lrb_op_table[e->op & LRB_EVENT_ID].id, why);
}

static int in_segment(uint32_t address, uint32_t bytes, lrb_segment s)
{
    return address >= s.address && address - s.address + (size_t)bytes <= s.size;
}

static void check_address(stream_check *s, const lrb_event *e, uint32_t bytes)
{
    lrb_segment scratch = {.address = LRB_SCRATCH_ADDRESS, .size = LRB_SCRATCH_BYTES};
    const kernel_job *j = s->job;
    if (!in_segment(e->aux, bytes, scratch) && !in_segment(e->aux, bytes, j->nodes) && !in_segment(e->aux, bytes, j->records) &&
        !in_segment(e->aux, bytes, j->constants) && !in_segment(e->aux, bytes, j->tiles) && !in_segment(e->aux, bytes, j->frame) &&
        !in_segment(e->aux, bytes, j->samples) && !in_segment(e->aux, bytes, j->normals) && !in_segment(e->aux, bytes, j->shadows) &&
        !in_segment(e->aux, bytes, j->filter) && !in_segment(e->aux, bytes, j->rows) &&
        !in_segment(e->aux, bytes, j->msaa_constants) && !in_segment(e->aux, bytes, j->sample_constants) &&
        !in_segment(e->aux, bytes, j->msaa_tiles))
        complain(s, e, "an address in no segment");
    if (e->aux % bytes != 0 && bytes <= 64)
        complain(s, e, "a misaligned address");
}

static void check_events(void *user, const lrb_event *events, uint32_t count)
{
    stream_check *s = user;
    for (uint32_t i = 0; i < count; i++) {
        const lrb_event *e = &events[i];
        unsigned op = e->op & LRB_EVENT_ID;
        if (op >= LRB_OP_COUNT) {
            s->errors++;
            continue;
        }
        if (lrb_op_kind_of((lrb_op_id)op) == LRB_KIND_MARKER)
            continue;
        for (int k = 0; k < 4; k++)
            if (e->src[k] > s->ops)
                complain(s, e, "a source before the stream began");
        int vector = lrb_op_kind_of((lrb_op_id)op) == LRB_KIND_VECTOR;
        const int stream = op == LRB_OP_loadunpackl_ps || op == LRB_OP_loadunpackh_ps || op == LRB_OP_packstorel_ps || op == LRB_OP_packstoreh_ps;
        if (op == LRB_OP_gatherd_ps || stream) /* from elements, not from a line's beginning */
            check_address(s, e, 4);
        else if (vector && (e->op & LRB_FORM_MEMORY || lrb_op_is_memory((lrb_op_id)op)))
            check_address(s, e, lrb_form_bytes(e->op) ? lrb_form_bytes(e->op) : 64);
        else if (lrb_op_is_memory((lrb_op_id)op))
            check_address(s, e, op == LRB_OP_load16 ? 2 : 4);
        s->ops++;
    }
}

/* Sources lie within the stream, addresses within what is mapped, aligned to what is read (the machine would fault). */
static void stream__every_event__sources_and_addresses_valid(void **state)
{
    const fixture *f = *state;
    for (int kernel = 0; kernel < KERNELS; kernel++) {
        const kernel_info *info = kernel_find(kernel_names[kernel]);
        kernel_job *job = NULL;
        lrb_ctx *c = NULL;
        kernel_counts n = {{0}};
        assert_int_equal(kernel_job_create(f->tree[kernel], &f->s->cameras[0], &f->s->light, SIZE, SIZE, &info->defaults, &job, NULL), BASE_OK);
        stream_check s = {.job = job};
        assert_int_equal(lrb_ctx_create(check_events, &s, &c, NULL), BASE_OK);
        for (uint32_t tile = 0; tile < kernel_job_tiles(job); tile++) {
            s.ops = 0;
            lrb_ctx_begin(c);
            info->tile[LRB_RECORD](c, job, tile, &n);
            lrb_ctx_end(c);
        }
        if (s.errors)
            fail_msg("%s: %llu bad events, first %s", kernel_names[kernel], (unsigned long long)s.errors, s.first);
        lrb_ctx_destroy(&c);
        kernel_job_destroy(&job);
    }
}

/* ---- what caches see of a stream ---- */

enum { LINE_BITS = 6, CACHE_SETS = 16 };

typedef struct touches {
    uint64_t count, hash;
    uint32_t latest[CACHE_SETS]; /* by set: the line accessed last, of the tile, if no hint came since */
} touches;

/* A cache sees an access unless it is to the latest line of a set, and all hints. */
static bool is_seen(touches *t, const lrb_event *e)
{
    const lrb_access access = lrb_shape_table[lrb_op_table[e->op & LRB_EVENT_ID].shape].access;
    const uint32_t line = e->aux >> LINE_BITS, before = t->latest[line % CACHE_SETS];
    if (!(e->op & LRB_FORM_MEMORY) && (access == LRB_ACCESS_NONE || (access != LRB_ACCESS_HINT && e->mask == 0)))
        return false;
    const bool hint = !(e->op & LRB_FORM_MEMORY) && access == LRB_ACCESS_HINT;
    t->latest[line % CACHE_SETS] = hint ? UINT32_MAX : line;
    return hint || before != line;
}

static void add_touches(void *user, const lrb_event *events, uint32_t count)
{
    touches *t = user;
    for (uint32_t i = 0; i < count; i++) {
        const lrb_event e = {.op = events[i].op, .mask = events[i].mask, .aux = events[i].aux};
        if (!is_seen(t, &e))
            continue;
        t->hash = base_hash(t->hash, &e, sizeof e);
        t->count++;
    }
}

/* Of a kernel at a level; `ops` receives how many ops it counted, or, at LRB_RECORD, made events of. */
static touches touches_of(const kernel_info *kernel, kernel_job *job, int level, uint64_t *ops)
{
    lrb_ctx *c = NULL;
    kernel_counts n = {{0}};
    touches t = {.hash = BASE_HASH_START};
    assert_int_equal(lrb_ctx_create(add_touches, &t, &c, NULL), BASE_OK);
    lrb_ctx_set_lines(c, 1 << LINE_BITS, CACHE_SETS);
    *ops = 0;
    for (uint32_t tile = 0; tile < kernel_job_tiles(job); tile++) {
        memset(t.latest, 0xff, sizeof t.latest);
        lrb_ctx_begin(c);
        kernel->tile[level](c, job, tile, &n);
        *ops += c->next_event - LRB_FAR;
        lrb_ctx_end(c);
    }
    for (int op = 0; op < LRB_OP_COUNT; op++)
        *ops += c->ops[op];
    lrb_ctx_destroy(&c);
    return t;
}

/* What a cache sees of the recorded stream, one by one, and no other event; and all ops are counted. */
static void touch__every_kernel__accesses_of_the_record(void **state)
{
    const fixture *f = *state;
    for (int kernel = 0; kernel < KERNELS; kernel++) {
        const kernel_info *info = kernel_find(kernel_names[kernel]);
        kernel_job *job = NULL;
        uint64_t recorded, counted;
        assert_int_equal(kernel_job_create(f->tree[kernel], &f->s->cameras[0], &f->s->light, SIZE, SIZE, &info->defaults, &job, NULL), BASE_OK);
        const touches record = touches_of(info, job, LRB_RECORD, &recorded), touch = touches_of(info, job, LRB_TOUCH, &counted);
        assert_true(touch.count > 0 && touch.count < recorded / 2);
        assert_int_equal(touch.count, record.count);
        assert_int_equal(touch.hash, record.hash);
        assert_int_equal(counted, recorded);
        kernel_job_destroy(&job);
    }
}

/* Tiles of a pass are independent: any order gives the same frame and the same events a tile. */
static void tiles__any_order__same_results(void **state)
{
    const fixture *f = *state;
    for (int kernel = 0; kernel < KERNELS; kernel++) {
        const kernel_info *info = kernel_find(kernel_names[kernel]);
        kernel_job *job[2] = {NULL, NULL};
        kernel_counts n[2] = {{{0}}, {{0}}};
        lrb_ctx *c = NULL;
        assert_int_equal(lrb_ctx_create(NULL, NULL, &c, NULL), BASE_OK);
        for (int turn = 0; turn < 2; turn++) {
            assert_int_equal(kernel_job_create(f->tree[kernel], &f->s->cameras[0], &f->s->light, SIZE, SIZE, &info->defaults, &job[turn], NULL), BASE_OK);
            memset(job[turn]->frame_host, 0xa5, job[turn]->frame.size);
            if (job[turn]->shadows_host)
                memset(job[turn]->shadows_host, 0xa5, job[turn]->shadows.size);
            const uint32_t tiles = kernel_job_tiles(job[turn]), first = kernel_job_first_pass(job[turn]);
            for (uint32_t i = 0; i < tiles; i++) {
                lrb_ctx_begin(c);
                info->tile[LRB_RECORD](c, job[turn], !turn ? i : i < first ? first - 1 - i : tiles - 1 - (i - first), &n[turn]);
                lrb_ctx_end(c);
            }
        }
        assert_memory_equal(job[0]->frame_host, job[1]->frame_host, job[0]->frame.size);
        if (job[0]->shadows_host)
            assert_memory_equal(job[0]->shadows_host, job[1]->shadows_host, job[0]->shadows.size);
        if (job[0]->rows_host)
            assert_memory_equal(job[0]->rows_host, job[1]->rows_host, job[0]->rows.size);
        assert_memory_equal(&n[0], &n[1], sizeof n[0]);
        kernel_job_destroy(&job[0]);
        kernel_job_destroy(&job[1]);
        lrb_ctx_destroy(&c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels__all__same_pictures_and_counts),
        cmocka_unit_test(levels__native__nothing_accounted),
        cmocka_unit_test(levels__count_and_record__same_histogram),
        cmocka_unit_test(levels__host_threads__same_everything),
        cmocka_unit_test(stream__every_event__sources_and_addresses_valid),
        cmocka_unit_test(touch__every_kernel__accesses_of_the_record),
        cmocka_unit_test(tiles__any_order__same_results),
    };
    return cmocka_run_group_tests_name("levels", tests, fixture_create, fixture_destroy);
}
