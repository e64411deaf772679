/* The box test of the scalar twins: 16 lanes, rays or frusta, each an interval of directions, one lane at a time. */
#ifndef TESTS_KERNELS_TWIN_UNIT_H
#define TESTS_KERNELS_TWIN_UNIT_H

#include "kernels/accel/bvh.h"
#include "kernels/counters.h"

/* The interval of directions of one lane, and what the box test makes of it. */
typedef struct twin_lane {
    float lo[3], hi[3]; /* widened */
    float near_rcp[3], back_rcp[3], far_rcp[3];
    float limit;
} twin_lane;

typedef struct twin_unit {
    twin_lane lane[16];
    unsigned active;
    int some_zero; /* a lane's interval holds 0: all lanes use the tight test */
} twin_unit;

/** 1/x from an estimate of 12 significant bits and two Newton steps. */
float twin_reciprocal(float x);

/** Whether the active lanes hold both signs on some axis. */
int twin_signs_mixed(const twin_unit *u);

/** Whether some active lane has no sign on some axis. */
int twin_signs_lacking(const twin_unit *u);

/** The reciprocals of all lanes, by their intervals and some_zero; limits become infinite. */
void twin_unit_reciprocals(twin_unit *u);

/** Count a unit by the path of its box test. */
void twin_count_path(kernel_counts *n, int some_zero, int mixed);

/** One lane against one box; the entry distance in *entry. */
int twin_lane_meets(const twin_lane *l, int some_zero, const bvh_node *box, const float origin[3], float *entry);

#endif
