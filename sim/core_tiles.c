#include <string.h>

#include "sim/core_state.h"

/* Cycles up to now belong to the phase and region that end here. */
static void end_phase(sim_core *s, core_thread *h, uint32_t next)
{
    s->stats.phase[h->phase] += h->cycles - h->phase_start;
    h->phase_start = h->cycles;
    h->phase = h->at.phase = next < SIM_MAX_PHASES ? next : SIM_MAX_PHASES - 1;
}

static void end_region(core_thread *h, uint32_t next)
{
    h->regions[h->region] += h->cycles - h->region_start;
    h->region_start = h->cycles;
    h->region = next < SIM_MAX_REGIONS ? next : SIM_MAX_REGIONS;
}

static void pass(sim_core *s, core_thread *h, const lrb_event *e)
{
    if (s->observer)
        core_tell(s, h, e);
    s->forms[(size_t)h->phase * CORE_FORMS + e->op]++;
    if ((e->op & LRB_EVENT_ID) == LRB_OP_phase)
        end_phase(s, h, e->aux);
    else if ((e->op & LRB_EVENT_ID) == LRB_OP_region)
        end_region(h, e->aux);
    else if ((e->op & LRB_EVENT_ID) == LRB_OP_line)
        h->at.site = e->aux;
}

bool core_pass_markers(sim_core *s, core_thread *h)
{
    while (h->undecoded < h->end && s->price[h->undecoded->op].flags & SIM_PRICE_MARKER)
        pass(s, h, h->undecoded++);
    if (h->undecoded == h->end)
        return false;
    core_blocks_next(s, h);
    return true;
}

bool core_begin_tile(sim_core *s, core_thread *h, const lrb_event *events, size_t count)
{
    const uint32_t done = core_number(h);
    memset(h->producer + (h->issued - h->issued_begin) - s->window, CORE_READY * SIM_CONSUMERS, s->window);
    memset(h->stores, 0, sizeof h->stores);
    memset(h->regions, 0, sizeof h->regions);
    h->tile_first = h->first = done;
    h->late_until = h->unsettled_until = 0;
    h->phase = 0;
    h->at = (sim_whereabouts){0};
    h->region = SIM_MAX_REGIONS;
    h->phase_start = h->region_start = h->cycles;
    h->undecoded = events;
    h->end = events + count;
    h->op = h->block_end = h->block;
    return core_pass_markers(s, h);
}

void core_end_tile(sim_core *s, core_thread *h)
{
    end_phase(s, h, 0);
    end_region(h, 0);
}
