/* Smooth noise for bark, ground and skin. */
#ifndef SCENE_BUILTIN_NOISE_H
#define SCENE_BUILTIN_NOISE_H

#include "scene/builtin/point.h"

/** A smooth random function of space in [-1, 1], one bump per unit cell; its slope is at most 3.75 along an axis. */
double scene_noise(scene_point p);

/** Noise, plus half of it at twice the frequency, and so on `octaves` times; in (-2, 2). */
double scene_noise_sum(scene_point p, unsigned octaves);

#endif
