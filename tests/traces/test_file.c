/* Trace files: the same bytes however the tiles come, read in any order, and refused if anything is wrong with them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lrbni/base/hash.h"
#include "lrbni/op_table.h"
#include "tests/base/files.h"
#include "tests/traces/streams.h"
#include "traces/format.h"
#include "traces/reader.h"
#include "traces/writer.h"

enum { TILES = 7, EVENTS = 40 }; /* a prime number of tiles; tile i has i x EVENTS events */
static const char head_text[] = "{\"kernel\":\"none\"}", tail_text[] = "{\"counts\":{}}";

typedef struct fixture {
    char *folder, *path;
    stream tiles[TILES];
} fixture;

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    base_random random = {.state = 11};
    f->folder = files_make_directory();
    f->path = files_path(f->folder, "a.ltr");
    for (size_t i = 0; i < TILES; i++)
        f->tiles[i] = stream_random(&random, i * EVENTS); /* the first one is empty */
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    for (int i = 0; i < TILES; i++)
        stream_free(&f->tiles[i]);
    free(f->path);
    files_remove_directory(f->folder);
    free(f);
    return 0;
}

static void put(trace_writer *w, trace_encoder *e, const fixture *f, uint32_t tile)
{
    trace_tile bytes;
    trace_encoder_begin(e);
    trace_encoder_events(e, f->tiles[tile].events, (uint32_t)f->tiles[tile].count);
    assert_int_equal(trace_encoder_end(e, &bytes, NULL), BASE_OK);
    assert_int_equal(trace_writer_put(w, tile, &bytes, NULL), BASE_OK);
}

/* Write a trace, its tiles put in the order i * step mod TILES. */
static void write_trace(const fixture *f, const char *path, uint32_t step)
{
    trace_writer *w = NULL;
    trace_encoder *e = NULL;
    const int files = files_count(f->folder);
    assert_int_equal(trace_encoder_create(&e, NULL), BASE_OK);
    assert_int_equal(trace_writer_create(path, TILES, head_text, &w, NULL), BASE_OK);
    for (uint32_t i = 0; i < TILES; i++)
        put(w, e, f, i * step % TILES);
    assert_int_equal(files_count(f->folder), files + 1); /* beside what was there */
    assert_int_equal(trace_writer_commit(w, tail_text, NULL), BASE_OK);
    trace_writer_destroy(&w);
    trace_encoder_destroy(&e);
}

static void check_tile(const fixture *f, trace_source *s, uint32_t tile)
{
    const lrb_event *events;
    uint32_t count = 1;
    size_t done = 0;
    assert_int_equal(trace_source_seek(s, tile, NULL), BASE_OK);
    while (count) {
        assert_int_equal(trace_source_next(s, &events, &count, NULL), BASE_OK);
        assert_true(done + count <= f->tiles[tile].count);
        if (count)
            assert_memory_equal(events, f->tiles[tile].events + done, count * sizeof *events);
        done += count;
    }
    assert_int_equal(done, f->tiles[tile].count);
    lrb_event whole[TILES * EVENTS];
    assert_int_equal(trace_source_seek(s, tile, NULL), BASE_OK);
    assert_int_equal(trace_source_read(s, whole, TILES * EVENTS, &count, NULL), BASE_OK);
    assert_int_equal(count, f->tiles[tile].count);
    if (count)
        assert_memory_equal(whole, f->tiles[tile].events, count * sizeof *whole);
}

static void file__written__read_in_any_order(void **state)
{
    const fixture *f = *state;
    trace_reader *r = NULL;
    trace_source *s = NULL;
    write_trace(f, f->path, 1);
    assert_int_equal(trace_reader_open(f->path, &r, NULL), BASE_OK);
    assert_int_equal(trace_reader_tiles(r), TILES);
    assert_int_equal(trace_reader_events(r), EVENTS * TILES * (TILES - 1) / 2);
    assert_string_equal(trace_reader_head_text(r), head_text);
    assert_string_equal(trace_reader_tail_text(r), tail_text);
    assert_int_equal(trace_source_create(r, &s, NULL), BASE_OK);
    for (uint32_t i = 0; i < 3 * TILES; i++)
        check_tile(f, s, i * 5 % TILES);
    trace_source_destroy(&s);
    trace_reader_close(&r);
}

static void file__tiles_in_another_order__same_bytes(void **state)
{
    const fixture *f = *state;
    char *other = files_path(f->folder, "b.ltr");
    size_t size, other_size;
    write_trace(f, f->path, 1);
    char *bytes = files_read(f->path, &size);
    for (uint32_t step = 2; step < TILES; step++) {
        files_write(other, "old");
        write_trace(f, other, step);
        char *other_bytes = files_read(other, &other_size);
        assert_int_equal(other_size, size);
        assert_memory_equal(other_bytes, bytes, size);
        free(other_bytes);
        assert_int_equal(remove(other), 0);
    }
    free(bytes);
    free(other);
}

static void file__not_committed__gone(void **state)
{
    const fixture *f = *state;
    trace_writer *w = NULL;
    files_write(f->path, "old");
    assert_int_equal(trace_writer_create(f->path, TILES, head_text, &w, NULL), BASE_OK);
    trace_writer_destroy(&w);
    char *text = files_read(f->path, NULL);
    assert_string_equal(text, "old");
    assert_int_equal(files_count(f->folder), 1);
    free(text);
}

static void write_bytes(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static base_status read_tile(trace_source *s, uint32_t tile, base_error *err)
{
    const lrb_event *events;
    uint32_t count = 1;
    base_status status = trace_source_seek(s, tile, err);
    while (status == BASE_OK && count)
        status = trace_source_next(s, &events, &count, err);
    return status;
}

/* Open a file of these bytes and read all of it. Whatever is wrong is an input error in one line that names the file. */
static base_status read_bytes(const fixture *f, const void *bytes, size_t size, base_error *err)
{
    trace_reader *r = NULL;
    trace_source *s = NULL;
    write_bytes(f->path, bytes, size);
    *err = (base_error){0};
    base_status status = trace_reader_open(f->path, &r, err);
    if (status == BASE_OK)
        status = trace_source_create(r, &s, err);
    for (uint32_t tile = 0; status == BASE_OK && tile < trace_reader_tiles(r); tile++)
        status = read_tile(s, tile, err);
    if (status != BASE_OK) {
        assert_int_equal(status, BASE_ERR_INPUT);
        assert_non_null(strstr(err->what, "a.ltr"));
        assert_true(err->why[0] && !strchr(err->why, '\n'));
    }
    trace_source_destroy(&s);
    trace_reader_close(&r);
    return status;
}

static void file__truncated_anywhere__refused(void **state)
{
    const fixture *f = *state;
    size_t size;
    base_error err;
    write_trace(f, f->path, 1);
    char *bytes = files_read(f->path, &size);
    assert_int_equal(read_bytes(f, bytes, size, &err), BASE_OK);
    for (size_t length = 0; length < size; length++)
        assert_int_equal(read_bytes(f, bytes, length, &err), BASE_ERR_INPUT);
    assert_non_null(strstr(err.why, "truncated"));
    assert_int_equal(read_bytes(f, bytes, 0, &err), BASE_ERR_INPUT);
    free(bytes);
}

static void file__any_bit_flipped__refused(void **state)
{
    const fixture *f = *state;
    size_t size;
    base_error err;
    write_trace(f, f->path, 1);
    char *bytes = files_read(f->path, &size);
    for (size_t i = 0; i < size; i++) {
        char flip = (char)(1 << i % 8);
        bytes[i] ^= flip;
        if (read_bytes(f, bytes, size, &err) == BASE_OK)
            fail_msg("a flipped bit of byte %zu of %zu is not found", i, size);
        bytes[i] ^= flip;
    }
    free(bytes);
}

/* Change the head, and its checksum with it. */
static base_status read_with_head(const fixture *f, char *bytes, size_t size, trace_head head, base_error *err)
{
    head.hash = base_hash(base_hash(BASE_HASH_START, &head, offsetof(trace_head, hash)), bytes + sizeof head, head.text_bytes);
    memcpy(bytes, &head, sizeof head);
    return read_bytes(f, bytes, size, err);
}

static void file__another_version_or_set_of_ops__refused_and_said_so(void **state)
{
    const fixture *f = *state;
    size_t size;
    base_error err;
    trace_head head, changed;
    write_trace(f, f->path, 1);
    char *bytes = files_read(f->path, &size);
    memcpy(&head, bytes, sizeof head);
    changed = head;
    changed.version = 2;
    assert_int_equal(read_with_head(f, bytes, size, changed, &err), BASE_ERR_INPUT);
    assert_non_null(strstr(err.why, "version 2"));
    changed = head;
    changed.ops_hash ^= 1;
    assert_int_equal(read_with_head(f, bytes, size, changed, &err), BASE_ERR_INPUT);
    assert_non_null(strstr(err.why, "another set of ops"));
    changed = head;
    changed.tiles = UINT32_MAX;
    assert_int_equal(read_with_head(f, bytes, size, changed, &err), BASE_ERR_INPUT);
    changed.tiles = TILES - 1;
    assert_int_equal(read_with_head(f, bytes, size, changed, &err), BASE_ERR_INPUT);
    assert_int_equal(read_with_head(f, bytes, size, head, &err), BASE_OK);
    free(bytes);
}

/* Change one entry of the index, and the tail's checksum with it. */
static void refuse_index(const fixture *f, const char *bytes, size_t size, uint32_t tile, trace_entry change)
{
    base_error err;
    trace_tail tail;
    char *copy = malloc(size);
    memcpy(copy, bytes, size);
    memcpy(&tail, copy + size - sizeof tail, sizeof tail);
    trace_entry *index = malloc(TILES * sizeof *index);
    memcpy(index, copy + tail.index_offset, TILES * sizeof *index);
    index[tile].offset += change.offset;
    index[tile].size += change.size;
    index[tile].plain_size += change.plain_size;
    index[tile].events += change.events;
    index[tile].hash += change.hash;
    tail.events += change.events;
    memcpy(copy + tail.index_offset, index, TILES * sizeof *index);
    uint64_t hash = base_hash(BASE_HASH_START, copy + tail.index_offset, TILES * sizeof *index + tail.text_bytes);
    tail.hash = base_hash(hash, &tail, offsetof(trace_tail, hash));
    memcpy(copy + size - sizeof tail, &tail, sizeof tail);
    assert_int_equal(read_bytes(f, copy, size, &err), BASE_ERR_INPUT);
    free(index);
    free(copy);
}

static void file__index_that_lies__refused(void **state)
{
    const fixture *f = *state;
    size_t size;
    write_trace(f, f->path, 1);
    char *bytes = files_read(f->path, &size);
    for (uint32_t tile = 0; tile < TILES; tile++) {
        refuse_index(f, bytes, size, tile, (trace_entry){.offset = 1});
        refuse_index(f, bytes, size, tile, (trace_entry){.size = 1});
        refuse_index(f, bytes, size, tile, (trace_entry){.size = UINT32_MAX});
        refuse_index(f, bytes, size, tile, (trace_entry){.plain_size = 1});
        refuse_index(f, bytes, size, tile, (trace_entry){.plain_size = UINT32_MAX});
        refuse_index(f, bytes, size, tile, (trace_entry){.plain_size = UINT32_C(1) << 31});
        refuse_index(f, bytes, size, tile, (trace_entry){.events = 1});
        refuse_index(f, bytes, size, tile, (trace_entry){.events = UINT32_C(1) << 31});
        refuse_index(f, bytes, size, tile, (trace_entry){.hash = 1});
    }
    free(bytes);
}

static void reader__no_file__says_why(void **state)
{
    const fixture *f = *state;
    base_error err = {0};
    trace_reader *r = NULL;
    assert_int_equal(trace_reader_open(f->path, &r, &err), BASE_ERR_INPUT);
    assert_null(r);
    assert_string_equal(err.what, f->path);
    assert_int_equal(trace_reader_open(f->folder, &r, &err), BASE_ERR_INPUT);
    assert_int_equal(trace_reader_open("/dev/zero", &r, &err), BASE_ERR_INPUT);
    base_status status = read_bytes(f, "not a trace, but long enough to be the head of one", 50, &err);
    assert_int_equal(status, BASE_ERR_INPUT);
    assert_non_null(strstr(err.why, "no trace"));
}

static void writer__full_disk__said_so(void **state)
{
    const fixture *f = *state;
    trace_writer *w = NULL;
    trace_encoder *e = NULL;
    base_error err = {0};
    assert_int_equal(trace_encoder_create(&e, NULL), BASE_OK);
    assert_int_equal(trace_writer_create("/dev/full", 1, head_text, &w, &err), BASE_OK);
    put(w, e, f, 0);
    assert_int_equal(trace_writer_commit(w, tail_text, &err), BASE_ERR_IO);
    trace_writer_destroy(&w);
    trace_encoder_destroy(&e);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(file__written__read_in_any_order, set_up, tear_down),
        cmocka_unit_test_setup_teardown(file__tiles_in_another_order__same_bytes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(file__not_committed__gone, set_up, tear_down),
        cmocka_unit_test_setup_teardown(file__truncated_anywhere__refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(file__any_bit_flipped__refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(file__another_version_or_set_of_ops__refused_and_said_so, set_up, tear_down),
        cmocka_unit_test_setup_teardown(file__index_that_lies__refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(reader__no_file__says_why, set_up, tear_down),
        cmocka_unit_test_setup_teardown(writer__full_disk__said_so, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
