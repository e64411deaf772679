#include "cli/annotate.h"

#include <inttypes.h>
#include <string.h>

#include "cli/places.h"
#include "cli/stats.h"
#include "reports/accounts.h"
#include "reports/text.h"

enum { WAIT_SIZE = 64, WAIT_WIDTH = 30 };

static double percent(uint64_t part, uint64_t whole)
{
    return whole ? 100 * (double)part / (double)whole : 0;
}

/* The largest of the waits and its share of the place's cycles: "operand_vector_alu 62 %"; empty if that is below a half percent. */
static void main_wait(const sim_place *cost, char text[WAIT_SIZE])
{
    json_t *stalls = report_stalls_json(&cost->cycles), *value;
    const char *name, *largest = "";
    json_int_t most = 0;
    json_object_foreach(stalls, name, value)
        if (strncmp(name, "issued_", 7) != 0 && json_integer_value(value) > most) {
            most = json_integer_value(value);
            largest = name;
        }
    text[0] = 0;
    if (percent((uint64_t)most, sim_cycles_sum(&cost->cycles)) >= 0.5)
        snprintf(text, WAIT_SIZE, "%s %.0f %%", largest, percent((uint64_t)most, sim_cycles_sum(&cost->cycles)));
    json_decref(stalls);
}

static base_status write_functions(const places *p, FILE *out, base_error *err)
{
    static const char *const columns[] = {"cycles", "issue", "operand wait", "memory wait", "other", "ops"};
    char name[64], wait[WAIT_SIZE];
    report_table *t = report_table_create("By function");
    report_table_add_column(t, &(report_column){.name = "function"});
    report_table_add_column(t, &(report_column){.name = "source"});
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++)
        report_table_add_column(t, &(report_column){.name = columns[i], .kind = REPORT_INTEGER});
    report_table_add_column(t, &(report_column){.name = "share", .unit = "%", .kind = REPORT_REAL, .decimals = 1});
    report_table_add_column(t, &(report_column){.name = "main wait"});
    for (size_t i = 0; i < p->function_count; i++) {
        const place *f = &p->functions[i];
        const place_groups g = place_groups_of(&f->cost.cycles);
        const uint64_t numbers[] = {g.cycles, g.issue, g.operand, g.memory, g.other, f->cost.ops};
        report_table_begin_row(t);
        report_table_add_text(t, place_function_name(f, name));
        report_table_add_text(t, place_source_name(f, name));
        for (size_t n = 0; n < sizeof numbers / sizeof *numbers; n++)
            report_table_add_integer(t, (int64_t)numbers[n]);
        report_table_add_real(t, percent(g.cycles, sim_cycles_sum(&p->total.cycles)));
        main_wait(&f->cost, wait);
        report_table_add_text(t, wait);
    }
    base_status status = report_table_write_text(t, out, err);
    report_table_destroy(&t);
    return status;
}

/* One line of a source; `cost` NULL: no op is written there. */
static void write_line(const places *p, const sim_place *cost, unsigned number, kernel_source_line text, FILE *out)
{
    char cycles[REPORT_NUMBER_BYTES] = "", ops[REPORT_NUMBER_BYTES] = "", share[16] = "", wait[WAIT_SIZE] = "";
    if (cost) {
        uint64_t sum = sim_cycles_sum(&cost->cycles);
        report_format_integer(cycles, (int64_t)sum, true);
        report_format_integer(ops, (int64_t)cost->ops, true);
        snprintf(share, sizeof share, "%.1f %%", percent(sum, sim_cycles_sum(&p->total.cycles)));
        main_wait(cost, wait);
    }
    fprintf(out, "%14s %7s %14s  %-*s %5u  %.*s\n", cycles, share, ops, WAIT_WIDTH, wait, number, (int)text.length,
            text.text ? text.text : "");
}

static void write_source(const places *p, const place *source, FILE *out)
{
    const unsigned lines = source->source ? kernel_source_lines(source->source) : 0;
    char name[64], cycles[REPORT_NUMBER_BYTES];
    size_t next = 0;
    report_format_integer(cycles, (int64_t)sim_cycles_sum(&source->cost.cycles), true);
    fprintf(out, "\n%s: %s cycles, %.1f %%\n\n", place_source_name(source, name), cycles,
            percent(sim_cycles_sum(&source->cost.cycles), sim_cycles_sum(&p->total.cycles)));
    fprintf(out, "%14s %7s %14s  %-*s %5s\n", "cycles", "share", "ops", WAIT_WIDTH, "main wait", "line");
    while (next < p->line_count && p->lines[next].cost.site >> 16 != source->cost.site >> 16)
        next++;
    for (unsigned line = 1; line <= lines; line++) {
        bool has_ops = next < p->line_count && p->lines[next].cost.site == ((source->cost.site & 0xffff0000u) | line);
        write_line(p, has_ops ? &p->lines[next].cost : NULL, line, kernel_source_at(source->source, line), out);
        next += has_ops;
    }
    for (; next < p->line_count && p->lines[next].cost.site >> 16 == source->cost.site >> 16; next++)
        write_line(p, &p->lines[next].cost, p->lines[next].cost.site & 0xffff, (kernel_source_line){NULL, 0}, out);
}

base_status annotate_write(const run_result *result, FILE *out, base_error *err)
{
    char title[STATS_TITLE_SIZE], cycles[REPORT_NUMBER_BYTES];
    places p;
    base_status status = places_create(result, &p, err);
    if (status == BASE_OK) {
        stats_title(result, title, sizeof title);
        report_format_integer(cycles, (int64_t)sim_cycles_sum(&p.total.cycles), true);
        fprintf(out, "%s: %s cycles\n\n", title, cycles);
        status = write_functions(&p, out, err);
    }
    for (size_t i = 0; status == BASE_OK && i < p.source_count; i++)
        write_source(&p, &p.sources[i], out);
    places_destroy(&p);
    return status;
}
