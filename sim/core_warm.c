#include "sim/core_state.h"

void sim_core_fill(sim_core *s, const sim_contents *contents)
{
    sim_cache_assign(s->memory->l1, contents->l1);
    sim_cache_assign(s->memory->l2, contents->l2);
}
