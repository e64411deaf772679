#include "cli/tile_exchange.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { PLACES = 32 };

typedef enum place_state { PLACE_FREE, PLACE_DECODING, PLACE_READY } place_state;

typedef struct place {
    place_state state;
    uint32_t tile, count;
    unsigned wanted; /* members that have not taken it */
    lrb_event *events;
    size_t room;
} place;

struct tile_exchange {
    const trace_reader *trace;
    pthread_mutex_t mutex; /* guards what follows; the events of a place belong to who decodes it, then to all who read them */
    pthread_cond_t changed;
    unsigned members, jobs, running;
    uint32_t *next; /* tile that each member takes next; UINT32_MAX: it has left */
    place place[PLACES];
};

base_status tile_exchange_create(const trace_reader *trace, unsigned members, unsigned jobs, tile_exchange **out, base_error *err)
{
    tile_exchange *x = calloc(1, sizeof *x);
    if (x) {
        pthread_mutex_init(&x->mutex, NULL);
        pthread_cond_init(&x->changed, NULL);
        x->trace = trace;
        x->members = members;
        x->jobs = jobs;
        x->next = calloc(members, sizeof *x->next);
    }
    if (!x || !x->next) {
        tile_exchange_destroy(&x);
        return base_fail(err, BASE_ERR_NOMEM, "replay", "out of memory");
    }
    *out = x;
    return BASE_OK;
}

void tile_exchange_destroy(tile_exchange **x)
{
    if (*x) {
        for (int i = 0; i < PLACES; i++)
            free((*x)->place[i].events);
        pthread_mutex_destroy(&(*x)->mutex);
        pthread_cond_destroy(&(*x)->changed);
        free((*x)->next);
        free(*x);
    }
    *x = NULL;
}

/* Begin to run once fewer than `jobs` do; the mutex is held. */
static void run(tile_exchange *x)
{
    while (x->running == x->jobs)
        pthread_cond_wait(&x->changed, &x->mutex);
    x->running++;
}

/* Let others run until something has changed; the mutex is held. */
static void stand_aside(tile_exchange *x)
{
    x->running--;
    pthread_cond_broadcast(&x->changed);
    pthread_cond_wait(&x->changed, &x->mutex);
    run(x);
}

void tile_exchange_enter(tile_exchange *x)
{
    pthread_mutex_lock(&x->mutex);
    run(x);
    pthread_mutex_unlock(&x->mutex);
}

/* One member less wants what is there; the mutex is held. */
static void give_up(place *p)
{
    if (--p->wanted == 0 && p->state == PLACE_READY)
        p->state = PLACE_FREE;
}

void tile_exchange_leave(tile_exchange *x, unsigned member)
{
    pthread_mutex_lock(&x->mutex);
    for (int i = 0; i < PLACES; i++)
        if (x->place[i].state != PLACE_FREE && x->place[i].tile >= x->next[member])
            give_up(&x->place[i]);
    x->next[member] = UINT32_MAX;
    x->running--;
    pthread_cond_broadcast(&x->changed);
    pthread_mutex_unlock(&x->mutex);
}

/* Decode a tile into a place that is the caller's alone. */
static base_status decode(const tile_exchange *x, place *p, trace_source *source, base_error *err)
{
    const uint32_t size = trace_reader_tile_events(x->trace, p->tile);
    base_status status = trace_source_seek(source, p->tile, err);
    if (status == BASE_OK && p->room < size) {
        free(p->events);
        p->events = malloc(size * sizeof *p->events);
        p->room = p->events ? size : 0;
        if (!p->events)
            return base_fail(err, BASE_ERR_NOMEM, "replay", "out of memory for the events of a tile");
    }
    return status == BASE_OK ? trace_source_read(source, p->events, size, &p->count, err) : status;
}

/* Wait until the tile is in its place, decoded by whoever came first; the mutex is held. */
static base_status find_tile(tile_exchange *x, place *p, trace_source *source, uint32_t tile, base_error *err)
{
    while (p->state != PLACE_READY || p->tile != tile) {
        if (p->state != PLACE_FREE) {
            stand_aside(x);
            continue;
        }
        *p = (place){.state = PLACE_DECODING, .tile = tile, .events = p->events, .room = p->room};
        for (unsigned m = 0; m < x->members; m++)
            p->wanted += x->next[m] <= tile;
        pthread_mutex_unlock(&x->mutex);
        base_status status = decode(x, p, source, err);
        pthread_mutex_lock(&x->mutex);
        p->state = status == BASE_OK ? PLACE_READY : PLACE_FREE;
        pthread_cond_broadcast(&x->changed);
        if (status != BASE_OK)
            return status;
    }
    return BASE_OK;
}

base_status tile_exchange_take(tile_exchange *x, unsigned member, trace_source *source, uint32_t tile, lrb_event *events,
                               uint32_t *count, base_error *err)
{
    place *p = &x->place[tile % PLACES];
    pthread_mutex_lock(&x->mutex);
    base_status status = find_tile(x, p, source, tile, err);
    pthread_mutex_unlock(&x->mutex);
    if (status != BASE_OK)
        return status;
    *count = p->count; /* the place stays as it is as long as a member wants it */
    if (p->count)
        memcpy(events, p->events, p->count * sizeof *events);
    pthread_mutex_lock(&x->mutex);
    x->next[member] = tile + 1;
    give_up(p);
    pthread_cond_broadcast(&x->changed);
    pthread_mutex_unlock(&x->mutex);
    return BASE_OK;
}
