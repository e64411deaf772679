#include "scene/builtin.h"

#include <string.h>

#include "scene/builtin/scenes.h"

static const scene_builtin builtins[] = {
    {"rooms-804", "three small furnished rooms joined by doorways", "Erw6", SCENE_ROOMS_TRIANGLES, scene_build_rooms},
    {"hall-60k", "a two-storey saloon with bar, gallery, stairs and a plank floor", "Saloon", SCENE_HALL_TRIANGLES,
        scene_build_hall},
    {"creature-69k", "a standing two-legged reptile with folded skin on stony ground", "T-Rex", SCENE_CREATURE_TRIANGLES,
        scene_build_creature},
    {"atrium-76k", "a courtyard with two storeys of vaulted arcades, cloths, ropes and a fountain", "Sponza",
        SCENE_ATRIUM_TRIANGLES, scene_build_atrium},
    {"forest-174k", "a forest glade with a cottage: old trees, toadstools, ferns and grass on large ground", "Fairy Forest", SCENE_FOREST_TRIANGLES,
        scene_build_forest},
    {"fern-212k", "a fern of thousands of small leaflets on a forest floor", "Fern", SCENE_FERN_TRIANGLES, scene_build_fern},
    {"conference-282k", "a conference room: an oval table with twenty chairs, armchairs, blinds, lamps and what lies about", "Conference", SCENE_CONFERENCE_TRIANGLES,
        scene_build_conference},
    {"tower-2195k", "a building of seven storeys with furnished rooms about an open court, seen from a gallery", "Soda Hall", SCENE_TOWER_TRIANGLES,
        scene_build_tower},
    {"dragon-7m", "a sculpted dragon in coils on a rock, scale by scale", "Asian Dragon", SCENE_DRAGON_TRIANGLES,
        scene_build_dragon},
};

const scene_builtin *scene_builtin_list(size_t *count)
{
    *count = sizeof builtins / sizeof *builtins;
    return builtins;
}

const char *const *scene_builtin_usual(size_t *count)
{
    static const char *const usual[] = {"builtin:rooms-804", "builtin:hall-60k", "builtin:atrium-76k"};
    *count = sizeof usual / sizeof *usual;
    return usual;
}

const scene_builtin *scene_builtin_find(const char *name)
{
    for (size_t i = 0; i < sizeof builtins / sizeof *builtins; i++)
        if (strcmp(builtins[i].name, name) == 0)
            return &builtins[i];
    return NULL;
}
