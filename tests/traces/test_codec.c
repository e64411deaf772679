/* Tiles encoded and decoded again: every bit of every event is back, and nothing that is no tile is taken for one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zstd.h>

#include "lrbni/ctx.h"
#include "lrbni/op_table.h"
#include "tests/traces/streams.h"
#include "traces/columns.h"
#include "traces/decoder.h"
#include "traces/encoder.h"

typedef struct codec {
    trace_encoder *encoder;
    trace_decoder *decoder;
} codec;

static int set_up(void **state)
{
    codec *c = calloc(1, sizeof *c);
    *state = c;
    return trace_encoder_create(&c->encoder, NULL) || trace_decoder_create(&c->decoder, NULL);
}

static int tear_down(void **state)
{
    codec *c = *state;
    trace_encoder_destroy(&c->encoder);
    trace_decoder_destroy(&c->decoder);
    free(c);
    return 0;
}

/* Encode in batches of `batch` events. */
static base_status encode(codec *c, const lrb_event *events, size_t count, size_t batch, trace_tile *tile, base_error *err)
{
    trace_encoder_begin(c->encoder);
    for (size_t i = 0; i < count; i += batch)
        trace_encoder_events(c->encoder, events + i, (uint32_t)(count - i < batch ? count - i : batch));
    return trace_encoder_end(c->encoder, tile, err);
}

static base_status decode(codec *c, const trace_tile *tile, lrb_event *events, uint32_t batch, size_t *count, base_error *err)
{
    uint32_t got = 1;
    base_status status = trace_decoder_begin(c->decoder, tile, "test", err);
    *count = 0;
    while (status == BASE_OK && got) {
        status = trace_decoder_next(c->decoder, events + *count, batch, &got, err);
        *count += got;
    }
    return status;
}

/* There and back; returns the bytes of the tile. */
static size_t round_trip(codec *c, const lrb_event *events, size_t count, size_t batch_in, uint32_t batch_out)
{
    base_error err = {0};
    trace_tile tile;
    size_t got = 0;
    lrb_event *back = malloc((count + batch_out) * sizeof *back);
    if (encode(c, events, count, batch_in, &tile, &err) || decode(c, &tile, back, batch_out, &got, &err))
        fail_msg("%s: %s", err.what, err.why);
    assert_int_equal(tile.events, count);
    assert_int_equal(got, count);
    for (size_t i = 0; i < count; i++)
        if (memcmp(&back[i], &events[i], sizeof *back) != 0)
            fail_msg("event %zu of %zu differs: op %04x, not %04x", i, count, back[i].op, events[i].op);
    free(back);
    return tile.size;
}

static void kernel_streams(codec *c, const char *kernel)
{
    stream_set set = stream_kernel(kernel, 96);
    size_t bytes = 0;
    for (uint32_t i = 0; i < set.count; i++)
        bytes += round_trip(c, set.tiles[i].events, set.tiles[i].count, LRB_BATCH, LRB_BATCH);
    printf("# %s: %zu events, %.3f bytes each\n", kernel, set.events, (double)bytes / (double)set.events);
    assert_true((double)bytes <= 1.5 * (double)set.events);
    stream_set_free(&set);
}

static void codec__packets__every_bit_is_back(void **state)
{
    kernel_streams(*state, "packet16-primary");
}

static void codec__frusta__every_bit_is_back(void **state)
{
    kernel_streams(*state, "mft-primary");
}

static void codec__random_streams__every_bit_is_back(void **state)
{
    base_random random = {.state = 4};
    for (int i = 0; i < 200; i++) {
        stream s = stream_random(&random, base_random_bits(&random) % 3000);
        round_trip(*state, s.events, s.count, 1 + base_random_bits(&random) % 100, (uint32_t)(1 + base_random_bits(&random) % 100));
        stream_free(&s);
    }
}

/* So long that all sites are forgotten several times, and distances reach their limit. */
static void codec__long_random_stream__every_bit_is_back(void **state)
{
    base_random random = {.state = 5};
    for (int i = 0; i < 3; i++) {
        stream s = stream_random(&random, 300000);
        round_trip(*state, s.events, s.count, LRB_BATCH, LRB_BATCH);
        stream_free(&s);
    }
}

/* Branches to ever new places: the table of blocks is full again and again. */
static void codec__many_branches__every_bit_is_back(void **state)
{
    enum { COUNT = 20000 };
    lrb_event *events = calloc(COUNT, sizeof *events);
    for (uint32_t i = 0; i < COUNT; i++) {
        events[i] = (lrb_event){.op = LRB_OP_jcc, .mask = i / 3 & 1, .aux = i % 1777};
        if (i % 2)
            events[i] = (lrb_event){.op = LRB_OP_cmp, .mask = 0xffff, .src = {(uint16_t)(i < 9 ? 0 : i % 9)}};
    }
    round_trip(*state, events, COUNT, LRB_BATCH, LRB_BATCH);
    free(events);
}

/* One site's sources are ever other events of one name: makers of fixed events run out. */
static void codec__many_fixed_makers__every_bit_is_back(void **state)
{
    enum { COUNT = 60000 };
    base_random random = {.state = 6};
    lrb_event *events = calloc(COUNT, sizeof *events);
    for (uint32_t i = 0; i < COUNT; i++) {
        events[i] = (lrb_event){.op = (uint16_t)(i % 9 ? LRB_OP_add : LRB_OP_jmp), .mask = i % 9 ? 0xffff : 1, .aux = i % 9 ? 0 : i / 9 % 7};
        for (int source = 0; source < 4 && i; source++)
            events[i].src[source] = (uint16_t)(base_random_bits(&random) % i);
    }
    round_trip(*state, events, COUNT, LRB_BATCH, LRB_BATCH);
    free(events);
}

static void codec__no_events_and_one__every_bit_is_back(void **state)
{
    lrb_event event = {.op = LRB_OP_add_ps, .mask = 0xffff};
    round_trip(*state, &event, 0, LRB_BATCH, LRB_BATCH);
    round_trip(*state, &event, 1, LRB_BATCH, LRB_BATCH);
}

/* A loop without any surprise: long runs, which must end where the tile does. */
static void codec__runs_of_every_length__every_bit_is_back(void **state)
{
    lrb_event events[1200];
    for (size_t i = 0; i < 1200; i++)
        events[i] = (lrb_event){.op = i % 4 ? LRB_OP_add : LRB_OP_jmp, .mask = i % 4 ? 0xffff : 1, .aux = i % 4 ? 0 : 7};
    for (size_t count = 0; count <= 1200; count++)
        round_trip(*state, events, count, 7, 11);
}

static void codec__same_events__same_bytes_whatever_came_before(void **state)
{
    codec *c = *state;
    base_random random = {.state = 7};
    stream s = stream_random(&random, 5000), other = stream_random(&random, 9000);
    trace_tile tile;
    assert_int_equal(encode(c, s.events, s.count, LRB_BATCH, &tile, NULL), BASE_OK);
    unsigned char *first = malloc(tile.size);
    size_t size = tile.size;
    memcpy(first, tile.bytes, size);
    assert_int_equal(encode(c, other.events, other.count, LRB_BATCH, &tile, NULL), BASE_OK);
    assert_int_equal(encode(c, s.events, s.count, 13, &tile, NULL), BASE_OK);
    assert_int_equal(tile.size, size);
    assert_memory_equal(tile.bytes, first, size);
    free(first);
    stream_free(&s);
    stream_free(&other);
}

static void refuse(codec *c, lrb_event event, const char *named)
{
    const lrb_event events[2] = {{.op = LRB_OP_add_ps, .mask = 0xffff}, event};
    base_error err = {0};
    trace_tile tile;
    assert_int_equal(encode(c, events, 2, 2, &tile, &err), BASE_ERR_INPUT);
    assert_non_null(strstr(err.why, named));
}

static void encoder__impossible_events__refused(void **state)
{
    refuse(*state, (lrb_event){.op = LRB_OP_COUNT}, "does not exist");
    refuse(*state, (lrb_event){.op = UINT16_MAX}, "does not exist");
    refuse(*state, (lrb_event){.op = LRB_OP_add_ps, .src = {0, 2}}, "before the beginning");
    refuse(*state, (lrb_event){.op = LRB_OP_add_ps, .src = {0, 0, 0, 65535}}, "before the beginning");
}

/* Decode columns; whatever comes out must be what simulators take. Returns whether all of it was taken. */
static bool decode_columns(codec *c, unsigned char *columns, size_t size, uint32_t events)
{
    lrb_event batch[LRB_BATCH];
    base_error err = {0};
    uint32_t count = 1;
    size_t position = 0;
    base_status status = trace_decoder_begin_plain(c->decoder, columns, size, events, "test", &err);
    while (status == BASE_OK && count) {
        status = trace_decoder_next(c->decoder, batch, LRB_BATCH, &count, &err);
        for (uint32_t i = 0; status == BASE_OK && i < count; i++) {
            assert_true((batch[i].op & LRB_EVENT_ID) < LRB_OP_COUNT);
            for (int source = 0; source < 4; source++)
                assert_true(batch[i].src[source] <= position);
            position += lrb_op_table[batch[i].op & LRB_EVENT_ID].class_id != LRB_CLASS_marker;
        }
    }
    assert_true(status == BASE_OK || (status == BASE_ERR_INPUT && err.why[0]));
    return status == BASE_OK;
}

static void decoder__damaged_columns__no_impossible_event(void **state)
{
    codec *c = *state;
    stream_set set = stream_kernel("mft-primary", 16);
    base_random random = {.state = 8};
    trace_tile tile;
    assert_int_equal(encode(c, set.tiles[0].events, set.tiles[0].count, LRB_BATCH, &tile, NULL), BASE_OK);
    size_t size = tile.plain_size;
    unsigned char *plain = malloc(size), *damaged = malloc(size);
    assert_int_equal(ZSTD_decompress(plain, size, tile.bytes, tile.size), size);
    assert_true(decode_columns(c, plain, size, tile.events));
    int refused = 0;
    for (int i = 0; i < 600; i++) {
        memcpy(damaged, plain, size);
        for (uint64_t flips = 1 + base_random_bits(&random) % 3; flips; flips--)
            damaged[base_random_bits(&random) % size] ^= (unsigned char)(1 + base_random_bits(&random) % 255);
        refused += !decode_columns(c, damaged, size, tile.events);
    }
    assert_true(refused > 200);
    for (size_t length = 0; length < size; length += 1 + length / 50)
        assert_false(decode_columns(c, plain, length, tile.events));
    for (uint32_t wrong = 0; wrong < 100; wrong++)
        assert_false(decode_columns(c, plain, size, tile.events - 1 - wrong) || decode_columns(c, plain, size, tile.events + 1 + wrong));
    free(plain);
    free(damaged);
    stream_set_free(&set);
}

static void decoder__no_zstd_frame__refused(void **state)
{
    codec *c = *state;
    unsigned char noise[64] = {1, 2, 3};
    base_error err = {0};
    trace_tile tile = {.bytes = noise, .size = sizeof noise, .plain_size = 100, .events = 10};
    assert_int_equal(trace_decoder_begin(c->decoder, &tile, "file, tile 7", &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "file, tile 7");
    tile.plain_size = TRACE_MAX_TILE_BYTES + 1;
    assert_int_equal(trace_decoder_begin(c->decoder, &tile, "file, tile 7", &err), BASE_ERR_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(codec__packets__every_bit_is_back, set_up, tear_down),
        cmocka_unit_test_setup_teardown(codec__frusta__every_bit_is_back, set_up, tear_down),
        cmocka_unit_test_setup_teardown(codec__random_streams__every_bit_is_back, set_up, tear_down),
        cmocka_unit_test_setup_teardown(codec__long_random_stream__every_bit_is_back, set_up, tear_down),
        cmocka_unit_test_setup_teardown(codec__many_branches__every_bit_is_back, set_up, tear_down),
        cmocka_unit_test_setup_teardown(codec__many_fixed_makers__every_bit_is_back, set_up, tear_down),
        cmocka_unit_test_setup_teardown(codec__no_events_and_one__every_bit_is_back, set_up, tear_down),
        cmocka_unit_test_setup_teardown(codec__runs_of_every_length__every_bit_is_back, set_up, tear_down),
        cmocka_unit_test_setup_teardown(codec__same_events__same_bytes_whatever_came_before, set_up, tear_down),
        cmocka_unit_test_setup_teardown(encoder__impossible_events__refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(decoder__damaged_columns__no_impossible_event, set_up, tear_down),
        cmocka_unit_test_setup_teardown(decoder__no_zstd_frame__refused, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
