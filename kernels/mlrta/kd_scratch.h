/* Where the kernels on the kd-tree keep what registers cannot hold: offsets in the scratch of a hardware thread, behind those of
 * the other tracing kernels, whose triangle test they share.
 */
#ifndef KERNELS_MLRTA_KD_SCRATCH_H
#define KERNELS_MLRTA_KD_SCRATCH_H

#include "kernels/accel/kdtree.h"
#include "kernels/scratch.h"

enum { KD_MAILBOX_SLOTS = 64, KD_STACK_ENTRY = 16, ENTRY_STACK_ENTRY = 64, ENTRY_TILE_FRAME = 64, ENTRY_TILE_LEVELS = 8 };

enum {
    KD_ROWS = 8192, /* 3 x 64: how the packet's rays meet planes, by axis (kernels/mlrta/kd16.h) */
    KD_MAILBOX = KD_ROWS + 3 * 64, /* 4 bytes a slot: offset of the record that was tested last of those that share the slot */
    KD_STACK = KD_MAILBOX + 4 * KD_MAILBOX_SLOTS, /* of a packet: farther children and their intervals */
    ENTRY_ROWS = KD_STACK + (KD_STACK_ENTRY * (KDTREE_MAX_DEPTH + 1) + 63) / 64 * 64, /* 3 x 64: how a tile's rays meet planes */
    ENTRY_LEAST = ENTRY_ROWS + 3 * 64, /* 64: smallest and ... */
    ENTRY_MOST = ENTRY_LEAST + 64,     /* 64: ... largest reciprocals of its directions */
    ENTRY_CORNERS = ENTRY_MOST + 64,   /* 4 x 64: its corner rays: all axes, then x, y, z */
    ENTRY_CELL = ENTRY_CORNERS + 4 * 64, /* 64: a cell, to be read by words */
    ENTRY_PLANES = ENTRY_CELL + 64,      /* 6 x 64: planes around its rays, by word of a cell; or reciprocals of its corner rays */
    ENTRY_TILES = ENTRY_PLANES + 6 * 64, /* tiles that are being split, the largest first */
    ENTRY_STACK = ENTRY_TILES + ENTRY_TILE_FRAME * ENTRY_TILE_LEVELS, /* of the search: nodes with two possible children, and their cells */
    HARD_RAYS = ENTRY_STACK + ENTRY_STACK_ENTRY * (KDTREE_MAX_DEPTH + 1), /* rays from the light to the hits of a tile: by block, */
    HARD_BLOCK = 6 * 64, /* 3 x 64: directions, 3 x 64: normals of the surfaces */
    HARD_ALIVE = HARD_RAYS + 16 * HARD_BLOCK, /* 4 bytes a block: those that are traced ... */
    HARD_HITS = HARD_ALIVE + 64,              /* ... of the pixels with a hit */
    ENTRY_LOOP = HARD_HITS + 64,              /* 64: what mlrta-primary's loops remember while packets are traced */
    KD_SCRATCH_END = ENTRY_LOOP + 64
};

_Static_assert((int)KD_ROWS >= (int)SCRATCH_END, "the kernels on the kd-tree use the triangle test's scratch as well");

#endif
