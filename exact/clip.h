/* Oracle O2: the part of a triangle in a box, in rational arithmetic. */
#ifndef EXACT_CLIP_H
#define EXACT_CLIP_H

#include <gmp.h>

/**
 * Clip a triangle to a closed box (Sutherland and Hodgman 1974, exactly).
 *
 * @param min, max  corners of the box, finite, min <= max
 * @param axis      0..2: along which the area is projected
 * @param area      out, set up by the caller: twice the area of the part's projection; at least 0
 * @return          number of corners of the part; 0: the triangle has no point in the box
 */
int exact_clip(const float v[3][3], const double min[3], const double max[3], int axis, mpq_t area);

#endif
