#include "cli/callgrind.h"

#include <inttypes.h>

#include "cli/places.h"
#include "cli/stats.h"
#include "cli/version.h"

static void write_costs(const sim_place *cost, FILE *out)
{
    const place_groups g = place_groups_of(&cost->cycles);
    fprintf(out, "%" PRIu64 " %" PRIu64 " %" PRIu64 " %" PRIu64 " %" PRIu64 " %" PRIu64 "\n", g.cycles, g.issue, g.operand, g.memory,
            g.other, cost->ops);
}

static void write_head(const run_result *result, const places *p, FILE *out)
{
    char title[STATS_TITLE_SIZE];
    stats_title(result, title, sizeof title);
    fprintf(out, "# callgrind format\nversion: 1\ncreator: lanetrace %s\ncmd: %s\npart: 1\n\n", VERSION_NUMBER, title);
    fprintf(out, "positions: line\nevents: Cycles Issue OperandWait MemoryWait OtherWait Ops\nsummary: ");
    write_costs(&p->total, out);
}

base_status callgrind_write(const run_result *result, FILE *out, base_error *err)
{
    char name[64];
    places p;
    base_status status = places_create(result, &p, err);
    if (status == BASE_OK)
        write_head(result, &p, out);
    for (size_t f = 0; status == BASE_OK && f < p.function_count; f++) {
        const place *function = &p.functions[f];
        fprintf(out, "\nfl=%s\n", place_source_name(function, name));
        fprintf(out, "fn=%s\n", place_function_name(function, name));
        for (size_t i = 0; i < p.line_count; i++) {
            const place *line = &p.lines[i];
            if (line->cost.site >> 16 != function->cost.site >> 16 || line->function.text != function->function.text)
                continue;
            fprintf(out, "%u ", line->cost.site & 0xffff);
            write_costs(&line->cost, out);
        }
    }
    if (status == BASE_OK) {
        fprintf(out, "\ntotals: ");
        write_costs(&p.total, out);
    }
    places_destroy(&p);
    return status;
}
