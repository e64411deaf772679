#include "cli/registers_report.h"

#include <stdio.h>

#include "reports/text.h"

enum { PRESSURE_DECIMALS = 3 };

static double mean(const run_result *r, int phase, int file)
{
    uint64_t ops = r->registers.ops[phase];
    return ops ? (double)r->registers.pressure[phase][file].live / (double)ops : 0;
}

double registers_spill_cycles(const run_result *r)
{
    const sim_class_cost *cost = r->machine->cost;
    const unsigned move = cost[LRB_CLASS_mask_move].throughput;
    const unsigned store[SIM_FILES] = {cost[LRB_CLASS_vector_store].throughput, move + cost[LRB_CLASS_scalar_store].throughput, 0};
    const unsigned load[SIM_FILES] = {cost[LRB_CLASS_vector_load].throughput, move + cost[LRB_CLASS_scalar_load].throughput, 0};
    uint64_t halves = 0;
    for (int phase = 0; phase < SIM_MAX_PHASES; phase++)
        for (int file = 0; file < SIM_FILES; file++) {
            const sim_pressure *p = &r->registers.pressure[phase][file];
            halves += p->stores * store[file] + p->reloads * load[file];
        }
    return (double)halves / 2;
}

json_t *registers_json(const run_result *r)
{
    json_t *object = json_object();
    for (int file = 0; file < SIM_FILES; file++) {
        json_t *phases = json_object();
        for (int phase = 0; phase < KERNEL_PHASE_COUNT; phase++) {
            const sim_pressure *p = &r->registers.pressure[phase][file];
            if (!kernel_has_phase(r->options.kernel, phase, r->registers.ops[phase]))
                continue;
            json_t *numbers = json_object();
            json_object_set_new(numbers, "max", json_integer((json_int_t)p->max));
            json_object_set_new(numbers, "mean", report_json_real(mean(r, phase, file), PRESSURE_DECIMALS));
            json_object_set_new(numbers, "stores", json_integer((json_int_t)p->stores));
            json_object_set_new(numbers, "reloads", json_integer((json_int_t)p->reloads));
            json_object_set_new(phases, kernel_phase_names[phase], numbers);
        }
        json_object_set_new(object, sim_file_names[file], phases);
    }
    json_object_set_new(object, "spill_cycles", report_json_real(registers_spill_cycles(r), 1));
    return object;
}

report_table *registers_table(const run_result *r)
{
    char text[160];
    report_table *t = report_table_create("Registers: values that are live at once, by file and phase");
    report_table_add_column(t, &(report_column){.name = "phase"});
    report_table_add_column(t, &(report_column){.name = "most", .kind = REPORT_INTEGER});
    report_table_add_column(t, &(report_column){.name = "mean", .kind = REPORT_REAL, .decimals = 1});
    report_table_add_column(t, &(report_column){.name = "spills", .kind = REPORT_INTEGER});
    report_table_add_column(t, &(report_column){.name = "reloads", .kind = REPORT_INTEGER});
    for (int file = 0; file < SIM_FILES; file++) {
        unsigned registers = sim_file_registers[file];
        snprintf(text, sizeof text, registers ? "%s, %u registers" : "%s", sim_file_names[file], registers);
        report_table_begin_group(t, text);
        for (int phase = 0; phase < KERNEL_PHASE_COUNT; phase++) {
            const sim_pressure *p = &r->registers.pressure[phase][file];
            if (!kernel_has_phase(r->options.kernel, phase, r->registers.ops[phase]))
                continue;
            report_table_begin_row(t);
            report_table_add_text(t, kernel_phase_names[phase]);
            report_table_add_integer(t, (int64_t)p->max);
            report_table_add_real(t, mean(r, phase, file));
            report_table_add_integer(t, (int64_t)p->stores);
            report_table_add_integer(t, (int64_t)p->reloads);
        }
    }
    snprintf(text, sizeof text, "Cycles of the spills if nothing waits for them: %.1f; they are %s the events that the run timed.",
             registers_spill_cycles(r), r->options.model == RUN_CORE ? "among" : "not among");
    report_table_add_note(t, text);
    report_table_add_note(t, "Values made before a tile began (pointers, constants, the mask of all lanes) are not counted.");
    return t;
}
