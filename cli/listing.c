#include "cli/listing.h"

#include <stdarg.h>

#include "cli/places.h"
#include "cli/stats.h"
#include "reports/text.h"

enum { NAME_WIDTH = 28 };

/* "  109,694,034      cycles                       #  104.614 per ray" */
__attribute__((format(printf, 4, 5))) static void write_count(FILE *out, uint64_t count, const char *name, const char *meaning, ...)
{
    char number[REPORT_NUMBER_BYTES];
    va_list arguments;
    report_format_integer(number, (int64_t)count, true);
    fprintf(out, "%20s      %-*s #  ", number, NAME_WIDTH, name);
    va_start(arguments, meaning);
    vfprintf(out, meaning, arguments);
    va_end(arguments);
    fputc('\n', out);
}

static double ratio(uint64_t a, uint64_t b)
{
    return b ? (double)a / (double)b : 0;
}

static void write_stalls(const place_groups *g, const sim_cycles *c, FILE *out)
{
    const uint64_t branch = c->mispredict + c->btb_miss;
    write_count(out, g->issue, "cycles with an issue", "%7.2f %% of all cycles", 100 * ratio(g->issue, g->cycles));
    write_count(out, c->issued_pair, "cycles with two", "%7.2f %% of all cycles", 100 * ratio(c->issued_pair, g->cycles));
    write_count(out, g->operand, "operand waits", "%7.2f %% of all cycles", 100 * ratio(g->operand, g->cycles));
    write_count(out, g->memory, "memory waits", "%7.2f %% of all cycles", 100 * ratio(g->memory, g->cycles));
    write_count(out, branch, "branch waits", "%7.2f %% of all cycles", 100 * ratio(branch, g->cycles));
    write_count(out, g->other - branch, "other waits", "%7.2f %% of all cycles", 100 * ratio(g->other - branch, g->cycles));
}

static void write_core(const sim_core_stats *s, FILE *out)
{
    const sim_hierarchy_counts *m = &s->memory;
    write_count(out, s->branches, "branches", "%7.2f per 1000 cycles", 1000 * ratio(s->branches, s->cycles));
    write_count(out, s->mispredicted, "branch-misses", "%7.2f %% of all branches", 100 * ratio(s->mispredicted, s->branches));
    write_count(out, m->l1_accesses, "L1-accesses", "%7.2f per 1000 cycles", 1000 * ratio(m->l1_accesses, s->cycles));
    write_count(out, m->l1_misses, "L1-misses", "%7.2f %% of all L1 accesses", 100 * ratio(m->l1_misses, m->l1_accesses));
    write_count(out, m->l2_misses, "L2-misses", "%7.2f %% of all L2 accesses", 100 * ratio(m->l2_misses, m->l2_accesses));
}

base_status listing_write(const run_result *result, FILE *out, base_error *err)
{
    (void)err;
    char title[STATS_TITLE_SIZE];
    const report_op_totals ops = run_totals(result);
    const sim_cycles cycles = stats_cycles(result);
    const place_groups groups = place_groups_of(&cycles);
    stats_title(result, title, sizeof title);
    fprintf(out, " Simulated performance of %s:\n\n", title);
    write_count(out, result->cycles, "cycles", "%7.2f per ray", ratio(result->cycles, result->counts.n[KERNEL_rays]));
    write_count(out, ops.total, "ops", "%7.2f per cycle", ratio(ops.total, groups.cycles));
    write_count(out, ops.vector, "vector-ops", "%7.2f %% of their lanes at work", 100 * ops.lane_utilisation);
    write_count(out, ops.memory, "memory-ops", "%7.2f %% of all ops", 100 * ratio(ops.memory, ops.total));
    if (result->options.model == RUN_CORE)
        write_core(&result->core, out);
    write_stalls(&groups, &cycles, out);
    if (groups.cycles != result->cycles)
        fprintf(out, "\n Shares are of the cycles of all simulated cores, each as long as the run.\n");
    fprintf(out, "\n%20.6f      seconds at %.2f GHz\n", (double)result->cycles / (double)result->machine->clock_hz,
            (double)result->machine->clock_hz / 1e9);
    return BASE_OK;
}
