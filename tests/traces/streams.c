#include "tests/traces/streams.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/kernel.h"
#include "scene/scene.h"
#include "tests/sim/random_stream.h"

static void must(base_status status, const base_error *err)
{
    if (status != BASE_OK) {
        fprintf(stderr, "streams: %s: %s\n", err->what, err->why);
        exit(1);
    }
}

static void keep(void *user, const lrb_event *events, uint32_t count)
{
    stream *s = user;
    s->events = realloc(s->events, (s->count + count) * sizeof *events);
    if (!s->events)
        abort();
    memcpy(s->events + s->count, events, count * sizeof *events);
    s->count += count;
}

static stream_set record(const kernel_info *kernel, const kernel_job *job)
{
    stream_set set = {.count = (uint32_t)kernel_job_tiles(job)};
    kernel_counts counts = {{0}};
    set.tiles = calloc(set.count, sizeof *set.tiles);
    if (!set.tiles)
        abort();
    for (uint32_t tile = 0; tile < set.count; tile++) {
        base_error err = {0};
        lrb_ctx *c = NULL;
        must(lrb_ctx_create(keep, &set.tiles[tile], &c, &err), &err);
        kernel->tile[LRB_RECORD](c, job, tile, &counts);
        lrb_ctx_end(c);
        lrb_ctx_destroy(&c);
        set.events += set.tiles[tile].count;
    }
    return set;
}

stream_set stream_kernel(const char *name, unsigned size)
{
    base_error err = {0};
    const kernel_info *kernel = kernel_find(name);
    const scene_camera *camera;
    scene *s = NULL;
    bvh *tree = NULL;
    kernel_job *job = NULL;
    bvh_options options = bvh_options_default();
    options.max_leaf = kernel->defaults.max_leaf;
    options.bins = kernel->defaults.bins;
    must(scene_open("builtin:rooms-804", &s, &err), &err);
    must(scene_find_camera(s, NULL, &camera, &err), &err);
    must(bvh_build(s, &options, &tree, &err), &err);
    must(kernel_job_create(tree, camera, &s->light, size, size, &kernel->defaults, &job, &err), &err);
    stream_set set = record(kernel, job);
    kernel_job_destroy(&job);
    bvh_destroy(&tree);
    scene_destroy(&s);
    return set;
}

stream stream_random(base_random *random, size_t count)
{
    stream s = {.events = calloc(count + 1, sizeof *s.events), .count = count};
    size_t position = 0;
    if (!s.events)
        abort();
    random_stream(random, s.events, (uint32_t)count);
    for (size_t i = 0; i < count; i++) {
        for (int source = 0; source < 4; source++)
            if (s.events[i].src[source] > position)
                s.events[i].src[source] = 0;
        position += lrb_op_table[s.events[i].op & LRB_EVENT_ID].class_id != LRB_CLASS_marker;
    }
    return s;
}

void stream_free(stream *s)
{
    free(s->events);
    *s = (stream){0};
}

void stream_set_free(stream_set *set)
{
    for (uint32_t i = 0; i < set->count; i++)
        stream_free(&set->tiles[i]);
    free(set->tiles);
    *set = (stream_set){0};
}
