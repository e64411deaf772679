/* The field behind a skin: how far a point lies outside the body, negative inside; private to skin*.c. */
#ifndef SCENE_BUILTIN_SKIN_FIELD_H
#define SCENE_BUILTIN_SKIN_FIELD_H

#include "scene/builtin/skin.h"

/* A straight piece of a limb's centre line; in the limb's own space, whose z is divided by the limb's width. */
typedef struct skin_bone {
    const scene_limb *limb;
    scene_point from, step; /* its start and its extent */
    double per_length2;     /* 1 / |step|^2 */
    double radius, growth;  /* at the start, and by how much it grows to the end */
    double along, length;   /* arc length at the start, and of the piece */
    double limb_length;
} skin_bone;

/* The bone of a limb that is nearest to a point. */
typedef struct skin_nearest {
    const skin_bone *bone;
    double t, distance; /* where along the bone; of its skin without relief */
} skin_nearest;

typedef struct skin_field {
    skin_bone *bones; /* owned, in the order of the limbs */
    skin_nearest *nearest; /* owned, room for one a limb while a field is computed */
    size_t count;
    double slope;  /* the field without relief changes by at most this per metre */
    double relief; /* the largest relief of any limb */
    scene_point low, high; /* nothing of the body lies outside */
} skin_field;

/** The field of some limbs; 0 if there is no memory. Free it with skin_field_end. */
int skin_field_begin(skin_field *f, const scene_limb *limbs, size_t count);
void skin_field_end(skin_field *f);

/** The field at a point from the bones in `list`, in their order, without relief. */
double skin_field_rough(const skin_field *f, const skin_bone *const *list, size_t count, scene_point p);

/**
 * The same with relief, if the skin may lie within `band`; beyond, without it, its sign being that with relief.
 *
 * @param relief  the largest of the limbs in the list
 */
double skin_field_at(const skin_field *f, const skin_bone *const *list, size_t count, scene_point p, double band, double relief);

/** The largest relief of the limbs in a list. */
double skin_field_relief(const skin_bone *const *list, size_t count);

/**
 * The bones that can matter within `reach` of a point: those in `from`, less the far ones, into `list` (which may be
 * `from`). The field from them is the same to the bit as that from all.
 *
 * @param rough  skin_field_rough of these at p
 */
size_t skin_field_near(const skin_field *f, const skin_bone *const *from, size_t count, scene_point p, double rough,
    double reach, const skin_bone **list);

#endif
