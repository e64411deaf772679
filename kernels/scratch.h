/* Where the tracing kernels keep what registers cannot hold: offsets in the scratch of a hardware thread.
 *
 * Larrabee has no path from a lane to all lanes but through memory: a vector is stored here, and its words come back as
 * {1to16} operands.
 */
#ifndef KERNELS_SCRATCH_H
#define KERNELS_SCRATCH_H

#include "kernels/accel/bvh.h"

enum {
    SCRATCH_BOXES = 0,      /* 64 bytes: a pair of boxes relative to the origin */
    SCRATCH_EDGES = 64,     /* 64: edge planes of a triangle (kernels/triangle16.h) */
    SCRATCH_PLANE = 128,    /* 64: distance of a triangle's plane */
    SCRATCH_GUARD = 192,    /* 64: rounding bounds of the edge planes */
    SCRATCH_MINUS_GUARD = 256, /* 64: the same, negative */
    SCRATCH_CORNERS = 320,  /* 3 x 64: directions of the first rays of the 16 blocks, by axis */
    SCRATCH_OTHER_CORNERS = 512, /* 3 x 3 x 64: those of their other corner rays, by corner and axis */
    SCRATCH_LOW = 1088,     /* 64: a triangle's bounds relative to the origin: smallest x y z ... */
    SCRATCH_HIGH = 1152,    /* 64: ... and largest */
    SCRATCH_STACK = 1216,   /* traversal stack: 8 bytes an entry, one per level at most */
    SCRATCH_STACK_ENTRY = 8,
    SCRATCH_STACK_END = SCRATCH_STACK + SCRATCH_STACK_ENTRY * (BVH_MAX_DEPTH + 1),

    /* Shadow rays of a block of pixels, lane = pixel (kernels/shadow16.h). */
    SCRATCH_HIT_POINTS = (SCRATCH_STACK_END + 63) / 64 * 64, /* 3 x 64: where the rays start, by axis */
    SCRATCH_TO_LIGHT = SCRATCH_HIT_POINTS + 192,     /* 3 x 64: directions to the light's corner: rays are this and a sample's delta */
    SCRATCH_LIGHT_CORNERS = SCRATCH_TO_LIGHT + 192,  /* 4 x 3 x 64: corner rays of the frusta, by corner and axis */
    SCRATCH_LIGHT_SLACK = SCRATCH_LIGHT_CORNERS + 768, /* 64: the widening for box tests ... */
    SCRATCH_LIGHT_REACH = SCRATCH_LIGHT_SLACK + 64,  /* 64: ... how far a hit may lie outside its triangle's bounds, by t ... */
    SCRATCH_LIGHT_GUARD = SCRATCH_LIGHT_REACH + 64,  /* 64: ... and the factor of the rounding error of corner tests */
    SCRATCH_OCCLUSION = SCRATCH_LIGHT_GUARD + 64,    /* 64: bits of the blocked rays */
    SCRATCH_SEEN = SCRATCH_OCCLUSION + 64,           /* 64: number of samples seen, all sets */
    SCRATCH_LANE_EDGES = SCRATCH_SEEN + 64,          /* 3 x 3 x 64: edge planes of a triangle from each lane's origin, by edge and axis */
    SCRATCH_LANE_PLANE = SCRATCH_LANE_EDGES + 576,   /* 64: distance of its plane */
    SCRATCH_INTERVALS = SCRATCH_LANE_PLANE + 64,     /* 2 x 3 x 64: intervals of the directions, widened: smallest, largest */
    SCRATCH_RECTANGLE = SCRATCH_INTERVALS + 384,     /* 4 x 64: part of the light that is left: smallest and largest a, the same of b */
    SCRATCH_SHADING = SCRATCH_RECTANGLE + 256,       /* 64: what the light's point would lend the hit points */
    SCRATCH_ALIVE = SCRATCH_SHADING + 64,            /* 4: mask of the pixels that may see the light, of several passes */
    SCRATCH_PASS = SCRATCH_ALIVE + 4,                /* 4: number of the pass, of several */
    SCRATCH_END = SCRATCH_ALIVE + 64,

    /* Groups of 16 packets of 16 rays (kernels/packet/packets256.h): by axis where there are three, then by packet. */
    SCRATCH_PACKET_NEAR = SCRATCH_END,                      /* 3 x 16 x 64: reciprocals of the directions, for near planes ... */
    SCRATCH_PACKET_BACK = SCRATCH_PACKET_NEAR + 3072,       /* 3 x 16 x 64: ... for those of rays that go back ... */
    SCRATCH_PACKET_FAR = SCRATCH_PACKET_BACK + 3072,        /* 3 x 16 x 64: ... and for far planes */
    SCRATCH_PACKET_ORIGIN = SCRATCH_PACKET_FAR + 3072,      /* 16 x 64: of shadow rays: x y z 0, four times */
    SCRATCH_PACKET_NEGATIVE = SCRATCH_PACKET_ORIGIN + 1024, /* 3 x 64: masks of the rays that go back ... */
    SCRATCH_PACKET_STRICT = SCRATCH_PACKET_NEGATIVE + 192,  /* 3 x 64: ... and of those that have a sign */
    SCRATCH_PACKET_MET = SCRATCH_PACKET_STRICT + 192,       /* 2 x 64: masks of the rays that meet the boxes of a pair */
    SCRATCH_PACKET_END = SCRATCH_PACKET_MET + 128
};

#endif
