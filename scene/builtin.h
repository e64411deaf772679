/* The scenes made by code: one file each in scene/builtin/. */
#ifndef SCENE_BUILTIN_H
#define SCENE_BUILTIN_H

#include "lrbni/base/status.h"
#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scene_builtin {
    const char *name;      /* what it is, and its number of triangles, as in atrium-76k */
    const char *summary;   /* a line for `lanetrace scenes` */
    const char *stands_for; /* the published scene whose triangle count it has */
    size_t triangle_count; /* exact */
    base_status (*build)(scene *s, base_error *err); /* adds materials, triangles, camera and light to an empty scene */
} scene_builtin;

/** All built-in scenes, in order of size; *count entries. */
const scene_builtin *scene_builtin_list(size_t *count);

/**
 * Specs, as scene_open takes them, of the scenes that reports, baselines and tests run when none is named: the small indoor
 * ones; *count entries. The others take seconds to minutes each and are run by name.
 */
const char *const *scene_builtin_usual(size_t *count);

/** The entry of that name (without `builtin:`), or NULL. */
const scene_builtin *scene_builtin_find(const char *name);

#ifdef __cplusplus
}
#endif
#endif
