/* What stands in the saloon of hall-60k: bar, tables, lamps, piano, stove. */
#ifndef SCENE_BUILTIN_HALL_BAR_H
#define SCENE_BUILTIN_HALL_BAR_H

#include "scene/builtin/mesh.h"

/* Materials of the saloon, by what they are used for. */
typedef struct scene_hall_palette {
    uint32_t wall, wainscot, beam, ceiling, plank[4], gap, rail, baluster, bar, brass, mirror, bottle[5], glass, chair,
        table, cushion, iron, candle, barrel, curtain, pane, picture[3], key, card;
} scene_hall_palette;

/** Furnish the saloon, in the scene's world frame. */
void scene_hall_furnish(scene_mesh *m, const scene_hall_palette *p);

#endif
