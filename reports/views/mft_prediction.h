/* The view of a prediction: costs of events, measured, times the counts that the MFT paper published, against its cycles.
 *
 *   reading                      scene                algorithm  published   predicted    error [%]
 *   4 threads, a test is a pair  T-Rex (69K tri)      P-Packet   94,100,000  95,123,000   1.1
 *
 * The cycles of a run are those of its phases, and each phase belongs to one kind of event: so a cost is a quotient of sums, and
 * nothing is fitted.
 */
#ifndef REPORTS_VIEWS_MFT_PREDICTION_H
#define REPORTS_VIEWS_MFT_PREDICTION_H

#include "reports/plot.h"
#include "reports/views/mft_paper.h"

/* Kinds of events, each with the phase whose cycles are charged to it. */
typedef enum mft_event {
    MFT_EVENT_SETUP, /* a pixel: set-up of its packets or groups, and shading; not the filter, which the paper reports apart */
    MFT_EVENT_AABB,  /* a box tested: traversal */
    MFT_EVENT_TRI,   /* a triangle accessed: culling */
    MFT_EVENT_ISECT, /* an intersection test: intersection */
    MFT_EVENTS
} mft_event;

/* One algorithm on one scene and machine. */
typedef struct mft_events {
    size_t machine; /* number of it */
    mft_algorithm algorithm;
    const char *scene;
    double cycles[MFT_EVENTS], events[MFT_EVENTS];
} mft_events;

/* What has been measured. */
typedef struct mft_measured {
    const char *const *machines; /* names: "4 threads" */
    size_t machine_count;
    const mft_events *events;
    size_t count;
    size_t algorithms; /* the first so many have been measured */
} mft_measured;

/** By reading (machine, and what the paper's AABB test is): median and worst error. NULL if out of memory. */
report_table *mft_prediction_summary(const mft_measured *m, const char *caption);

/** Rows that the reading with the least median error is far off in, and the event behind it. NULL if out of memory. */
report_table *mft_prediction_far(const mft_measured *m);

/** By machine and algorithm: what the published cycles leave for an AABB test of each scene. NULL if out of memory. */
report_table *mft_prediction_left(const mft_measured *m, const char *caption);

/** What an event costs, over all scenes and in the least and dearest of them. NULL if out of memory. */
report_table *mft_prediction_costs(const mft_measured *m, const char *caption);

/** Every row of the paper under every reading. NULL if out of memory. */
report_table *mft_prediction_rows(const mft_measured *m, const char *caption);

/* Points of the plot: predicted against published under the reading with the least median error. */
typedef struct mft_prediction_points {
    double published[MFT_ALGORITHMS][MFT_SCENES], predicted[MFT_ALGORITHMS][MFT_SCENES], ends[2];
    report_series series[MFT_ALGORITHMS + 1]; /* the last one is the line of equality */
    size_t count;
    char title[160];
} mft_prediction_points;

void mft_prediction_points_of(const mft_measured *m, mft_prediction_points *out);

#endif
