#include "tests/sim/slow_memory.h"

#include <stdlib.h>

#define SLOW_NONE UINT64_MAX

static bool table_init(slow_table *t, unsigned places, unsigned ways)
{
    t->ways = ways;
    t->sets = places / ways;
    t->entries = calloc(places, sizeof *t->entries);
    return t->entries;
}

static slow_entry *find(slow_table *t, uint64_t what)
{
    for (unsigned way = 0; way < t->ways; way++) {
        slow_entry *e = &t->entries[what % t->sets * t->ways + way];
        if (e->valid && e->what == what)
            return e;
    }
    return NULL;
}

/* A free place of the set, or else the one that was not used for longest. */
static slow_entry *place_for(slow_table *t, uint64_t what)
{
    slow_entry *set = &t->entries[what % t->sets * t->ways], *best = set;
    for (unsigned way = 0; way < t->ways; way++) {
        if (!set[way].valid)
            return &set[way];
        if (set[way].last_use < best->last_use)
            best = &set[way];
    }
    return best;
}

/* Use a line of a cache: it is there afterwards. */
static bool use(slow_table *t, uint64_t line)
{
    slow_entry *e = find(t, line);
    bool hit = e;
    if (!hit)
        e = place_for(t, line);
    *e = (slow_entry){.valid = true, .what = line, .last_use = ++t->uses};
    return hit;
}

bool slow_memory_init(slow_memory *m, const sim_machine *machine, sim_hierarchy_counts *counts)
{
    *m = (slow_memory){.machine = machine, .counts = counts, .line_room = 4096};
    for (int i = 0; i < 4; i++)
        m->sent[i] = SLOW_NONE;
    m->lines = calloc(m->line_room, sizeof *m->lines);
    return m->lines && table_init(&m->level[1], machine->l1.size_bytes / machine->l1.line_bytes, machine->l1.ways) &&
           table_init(&m->level[2], machine->l2.size_bytes / machine->l2.line_bytes, machine->l2.ways) &&
           table_init(&m->branches, machine->branch.btb_entries, machine->branch.btb_ways);
}

void slow_memory_free(slow_memory *m)
{
    free(m->level[1].entries);
    free(m->level[2].entries);
    free(m->branches.entries);
    free(m->lines);
}

/* The line on its way to a level, or NULL. */
static const slow_line *on_its_way(const slow_memory *m, int level, uint64_t line, uint64_t cycle)
{
    for (unsigned i = 0; i < m->line_count; i++)
        if (m->lines[i].level == level && m->lines[i].line == line && m->lines[i].arrival > cycle)
            return &m->lines[i];
    return NULL;
}

static void put_on_its_way(slow_memory *m, slow_line line, uint64_t cycle)
{
    unsigned kept = 0;
    for (unsigned i = 0; i < m->line_count; i++)
        if (m->lines[i].arrival > cycle)
            m->lines[kept++] = m->lines[i];
    m->line_count = kept;
    if (m->line_count == m->line_room)
        abort(); /* more lines under way than any machine of the tests allows */
    m->lines[m->line_count++] = line;
}

/* The cycle in which a source sends a line that it is asked for now. */
static uint64_t sent_in(slow_memory *m, int source, uint64_t cycle)
{
    const sim_machine *k = m->machine;
    uint64_t distance = k->l2.cycles_per_line_tenths, tenths = cycle * 10;
    if (source == 3) {
        uint64_t chip = k->memory.chip_bytes_per_cycle, bytes = (uint64_t)k->cores * k->l1.line_bytes;
        uint64_t share = chip ? bytes * 10 / chip + (bytes * 10 % chip != 0) : 0;
        distance = k->memory.cycles_per_line_tenths > share ? k->memory.cycles_per_line_tenths : share;
    }
    if (m->sent[source] != SLOW_NONE && m->sent[source] + distance > tenths)
        tenths = m->sent[source] + distance;
    m->sent[source] = tenths;
    return tenths / 10 + (tenths % 10 != 0);
}

static uint64_t from_memory(slow_memory *m, uint64_t line, uint64_t cycle)
{
    uint64_t arrival = sent_in(m, 3, cycle) + m->machine->memory.latency - m->machine->l1.latency;
    m->counts->memory_lines++;
    put_on_its_way(m, (slow_line){line, arrival, 2, 3}, cycle);
    return arrival;
}

/* The first level asks for a line. */
static slow_line ask(slow_memory *m, uint64_t line, uint64_t cycle)
{
    const slow_line *coming = on_its_way(m, 2, line, cycle);
    slow_line answer = {line, 0, 1, 3};
    uint64_t at_l2 = coming ? coming->arrival : 0;
    bool hit = use(&m->level[2], line);
    m->counts->l2_accesses++;
    if (!hit && !at_l2) {
        m->counts->l2_misses++;
        answer.arrival = from_memory(m, line, cycle);
    } else {
        answer.arrival = sent_in(m, 2, cycle) + m->machine->l2.latency - m->machine->l1.latency;
        answer.source = at_l2 > answer.arrival ? 3 : 2;
        answer.arrival = at_l2 > answer.arrival ? at_l2 : answer.arrival;
    }
    put_on_its_way(m, answer, cycle);
    return answer;
}

bool slow_memory_must_ask(slow_memory *m, int level, uint64_t line, uint64_t cycle)
{
    return !find(&m->level[level], line) && !on_its_way(m, level, line, cycle);
}

slow_access slow_memory_access(slow_memory *m, uint64_t line, uint64_t cycle)
{
    const slow_line *coming = on_its_way(m, 1, line, cycle);
    slow_line found = coming ? *coming : (slow_line){0};
    bool hit = use(&m->level[1], line);
    m->counts->l1_accesses++;
    if (coming) {
        m->counts->l1_waits++;
        return (slow_access){false, found.arrival, found.source};
    }
    if (hit)
        return (slow_access){false, 0, 0};
    m->counts->l1_misses++;
    found = ask(m, line, cycle);
    return (slow_access){true, found.arrival, found.source};
}

uint64_t slow_memory_prefetch(slow_memory *m, int level, uint64_t line, uint64_t cycle)
{
    m->counts->prefetches++;
    use(&m->level[level], line);
    return level == 1 ? ask(m, line, cycle).arrival : from_memory(m, line, cycle);
}

void slow_memory_evict(slow_memory *m, int level, uint64_t line)
{
    slow_entry *e = find(&m->level[level], line);
    if (e)
        e->valid = false;
}

int slow_memory_branch(slow_memory *m, uint32_t site, bool taken)
{
    slow_table *t = &m->branches;
    slow_entry *e = find(t, site);
    if (!e && !taken)
        return 0;
    if (!e) {
        *place_for(t, site) = (slow_entry){.valid = true, .what = site, .last_use = ++t->uses, .counter = 3};
        return 2;
    }
    bool predicted = e->counter >= 2;
    e->last_use = ++t->uses;
    if (taken && e->counter < 3)
        e->counter++;
    if (!taken && e->counter > 0)
        e->counter--;
    return predicted != taken;
}
