#include <stdio.h>
#include <string.h>

#include "scene/builtin.h"
#include "scene/gltf_loader.h"
#include "scene/scene.h"

static base_status unknown_builtin(const char *spec, base_error *err)
{
    char list[400] = "";
    size_t count, used = 0;
    const scene_builtin *all = scene_builtin_list(&count);
    for (size_t i = 0; i < count && used + 1 < sizeof list; i++) {
        int n = snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", all[i].name);
        used += n > 0 ? (size_t)n : 0;
    }
    return base_fail(err, BASE_ERR_USAGE, spec, "no such built-in scene; there are %s", list);
}

static base_status open_builtin(const char *spec, const char *name, scene **out, base_error *err)
{
    const scene_builtin *entry = scene_builtin_find(name);
    if (!entry)
        return unknown_builtin(spec, err);
    base_status status = scene_create(entry->name, out, err);
    if (status == BASE_OK)
        status = entry->build(*out, err);
    if (status == BASE_OK)
        status = scene_finish(*out, err);
    if (status != BASE_OK)
        scene_destroy(out);
    return status;
}

base_status scene_open(const char *spec, scene **out, base_error *err)
{
    static const char prefix[] = "builtin:";
    *out = NULL;
    if (strncmp(spec, prefix, strlen(prefix)) == 0)
        return open_builtin(spec, spec + strlen(prefix), out, err);
    return scene_gltf_load(spec, out, err);
}
