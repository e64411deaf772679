#include "cli/record_ahead.h"

#include <pthread.h>
#include <stdlib.h>

typedef enum place_state { PLACE_FREE, PLACE_RECORDING, PLACE_READY, PLACE_TAKEN } place_state;

typedef struct place {
    recording recording; /* first, so that one names the other */
    size_t tile;
    place_state state;
} place;

typedef struct helper {
    record_ahead *ahead;
    recorder *recorder;
    pthread_t thread;
} helper;

struct record_ahead {
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    size_t end, next; /* next: the tile that is recorded next */
    bool stop;
    base_error error; /* of the first helper that failed; status BASE_OK: none did */
    unsigned places, helpers;
    place *place;
    helper *helper;
};

static place *find_place(record_ahead *a, place_state state)
{
    for (unsigned i = 0; i < a->places; i++)
        if (a->place[i].state == state)
            return &a->place[i];
    return NULL;
}

/* Wait for a free place and take the next tile; NULL: there is nothing left to do. The mutex is held. */
static place *begin_tile(record_ahead *a)
{
    for (;;) {
        if (a->stop || a->next == a->end)
            return NULL;
        place *p = find_place(a, PLACE_FREE);
        if (p) {
            p->state = PLACE_RECORDING;
            p->tile = a->next++;
            return p;
        }
        pthread_cond_wait(&a->changed, &a->mutex);
    }
}

static void *help(void *user)
{
    helper *h = user;
    record_ahead *a = h->ahead;
    place *p;
    pthread_mutex_lock(&a->mutex);
    while ((p = begin_tile(a))) {
        base_error err = {0};
        pthread_mutex_unlock(&a->mutex);
        base_status status = recorder_tile(h->recorder, p->tile, &p->recording, &err);
        pthread_mutex_lock(&a->mutex);
        p->state = PLACE_READY;
        if (status != BASE_OK && a->error.status == BASE_OK) {
            a->error = err;
            a->stop = true;
        }
        pthread_cond_broadcast(&a->changed);
    }
    pthread_mutex_unlock(&a->mutex);
    return NULL;
}

base_status record_ahead_start(recorder *recorders, unsigned count, size_t first, size_t end, unsigned held,
                               record_ahead **out, base_error *err)
{
    record_ahead *a = calloc(1, sizeof *a);
    *out = a;
    if (a) {
        pthread_mutex_init(&a->mutex, NULL);
        pthread_cond_init(&a->changed, NULL);
        a->next = first;
        a->end = end;
        a->places = held + 2 * count;
        a->place = calloc(a->places, sizeof *a->place);
        a->helper = calloc(count, sizeof *a->helper);
    }
    for (unsigned i = 0; a && a->place && a->helper && i < count; i++, a->helpers++) {
        a->helper[i] = (helper){.ahead = a, .recorder = &recorders[i]};
        if (pthread_create(&a->helper[i].thread, NULL, help, &a->helper[i]) != 0)
            break;
    }
    if (a && a->helpers)
        return BASE_OK;
    record_ahead_stop(out);
    return base_fail(err, BASE_ERR_NOMEM, "--jobs", "no memory or no thread to record tiles");
}

/* The place of a tile that is ready, or NULL. */
static place *ready_place(record_ahead *a, size_t tile)
{
    for (unsigned i = 0; i < a->places; i++)
        if (a->place[i].state == PLACE_READY && a->place[i].tile == tile)
            return &a->place[i];
    return NULL;
}

base_status record_ahead_take(record_ahead *a, size_t tile, recording **out, base_error *err)
{
    place *p;
    pthread_mutex_lock(&a->mutex);
    while (!(p = ready_place(a, tile)) && a->error.status == BASE_OK)
        pthread_cond_wait(&a->changed, &a->mutex);
    const base_error failure = a->error;
    if (p && failure.status == BASE_OK)
        p->state = PLACE_TAKEN;
    pthread_mutex_unlock(&a->mutex);
    if (failure.status != BASE_OK)
        return base_fail(err, failure.status, failure.what, "%s", failure.why);
    *out = &p->recording;
    return BASE_OK;
}

void record_ahead_release(record_ahead *a, recording *r)
{
    pthread_mutex_lock(&a->mutex);
    ((place *)r)->state = PLACE_FREE;
    pthread_cond_broadcast(&a->changed);
    pthread_mutex_unlock(&a->mutex);
}

void record_ahead_stop(record_ahead **ahead)
{
    record_ahead *a = *ahead;
    if (!a)
        return;
    pthread_mutex_lock(&a->mutex);
    a->stop = true;
    pthread_cond_broadcast(&a->changed);
    pthread_mutex_unlock(&a->mutex);
    for (unsigned i = 0; i < a->helpers; i++)
        pthread_join(a->helper[i].thread, NULL);
    for (unsigned i = 0; a->place && i < a->places; i++)
        recording_free(&a->place[i].recording);
    pthread_mutex_destroy(&a->mutex);
    pthread_cond_destroy(&a->changed);
    free(a->place);
    free(a->helper);
    free(a);
    *ahead = NULL;
}
