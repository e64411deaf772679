/* lanetrace ops: the ops of the vector ISA and what they cost, as text, as JSON, and as the reference page. */
#include <stdio.h>
#include <string.h>

#include "cli/command.h"
#include "lrbni/op_table.h"
#include "reports/table.h"

enum { KEY_JSON = 'j', KEY_MACHINE = 256, KEY_MARKDOWN };

static const struct argp_option option_table[] = {
    {"machine", KEY_MACHINE, "M", 0, "whose costs: a machine (see lanetrace machines), or a description's path; default larrabee", 0},
    {"json", KEY_JSON, NULL, 0, "as JSON", 0},
    {"markdown", KEY_MARKDOWN, NULL, 0, "as the page docs/isa-reference.md", 0},
    {0},
};

typedef struct arguments {
    base_error *err;
    const char *machine;
    bool json, markdown;
} arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case KEY_MACHINE: a->machine = text; return 0;
    case KEY_JSON: a->json = true; return 0;
    case KEY_MARKDOWN: a->markdown = true; return 0;
    case ARGP_KEY_ARG:
        base_fail(a->err, BASE_ERR_USAGE, text, "an argument too many");
        return EINVAL;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp argp = {
    option_table, parse, NULL,
    "The ops of the vector ISA (lrbni/ops.def), and what each costs on a machine: the pipes it may issue in, the cycles until its result "
    "may be used, the cycles until the next of its class. Which chips have it: L the original Larrabee, K Knights Corner.",
    NULL, NULL, NULL,
};

/* What a class costs: pipes, latency and throughput, as a machine's description has them. */
typedef struct op_cost {
    char pipes[4], latency[16], throughput[16];
} op_cost;

static op_cost cost_of(const sim_machine *machine, lrb_cost_class class_id)
{
    const sim_class_cost *c = &machine->cost[class_id];
    op_cost text = {"", "", ""};
    if (class_id == LRB_CLASS_marker)
        return text;
    snprintf(text.pipes, sizeof text.pipes, "%s%s", c->pipes & SIM_PIPE_U ? "U" : "", c->pipes & SIM_PIPE_V ? "V" : "");
    snprintf(text.latency, sizeof text.latency, "%u", c->latency);
    snprintf(text.throughput, sizeof text.throughput, "%u%s", c->throughput / 2, c->throughput % 2 ? ".5" : "");
    return text;
}

static report_table *ops_table(const sim_machine *machine)
{
    static const char *const columns[] = {"op",    "instruction", "shape", "lane i",  "mask",       "rounding",
                                          "chips", "class",       "pipes", "latency", "throughput", "source"};
    char title[64];
    snprintf(title, sizeof title, "Ops, machine %s", machine->name);
    report_table *t = report_table_create(title);
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++)
        report_table_add_column(t, &(report_column){.name = columns[i]});
    for (int i = 0; i < LRB_OP_COUNT; i++) {
        const lrb_op_info *op = &lrb_op_table[i];
        op_cost cost = cost_of(machine, op->class_id);
        const char *const cells[] = {op->id, op->mnemonic, lrb_shape_table[op->shape].name, op->formula, lrb_mask_names[op->mask],
                                     lrb_round_names[op->round], lrb_chips_names[op->chips], lrb_cost_classes[op->class_id].name,
                                     cost.pipes, cost.latency, cost.throughput, op->source};
        report_table_begin_row(t);
        for (size_t k = 0; k < sizeof cells / sizeof *cells; k++)
            report_table_add_text(t, cells[k]);
    }
    return t;
}

/* Text for a cell of a Markdown table. */
static void write_cell(FILE *out, const char *mark, const char *text)
{
    fprintf(out, " %s", mark);
    for (; *text; text++)
        fprintf(out, *text == '|' ? "\\%c" : "%c", *text);
    fprintf(out, "%s |", mark);
}

static bool has_ops(lrb_cost_class class_id)
{
    for (int i = 0; i < LRB_OP_COUNT; i++)
        if (lrb_op_table[i].class_id == class_id)
            return true;
    return false;
}

static void write_class(FILE *out, const sim_machine *machine, lrb_cost_class class_id)
{
    fprintf(out, "\n## %s\n\n%s.\n\n", lrb_cost_classes[class_id].name, lrb_cost_classes[class_id].sentence);
    fprintf(out, "| op | instruction | operands | lane i | mask | rounding | chips | pipes, latency, throughput | source |\n");
    fprintf(out, "|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < LRB_OP_COUNT; i++) {
        const lrb_op_info *op = &lrb_op_table[i];
        op_cost cost = cost_of(machine, op->class_id);
        if (op->class_id != class_id)
            continue;
        fprintf(out, "| `%s` | `%s` | %s |", op->id, op->mnemonic, lrb_shape_table[op->shape].name);
        write_cell(out, "`", op->formula);
        fprintf(out, " %s | %s | %s | %s %s %s |", lrb_mask_names[op->mask], lrb_round_names[op->round], lrb_chips_names[op->chips],
                cost.pipes, cost.latency, cost.throughput);
        write_cell(out, "", op->source);
        fputc('\n', out);
    }
}

static void write_shapes(FILE *out)
{
    fprintf(out, "\n## Operands\n\n| shape | what the ops take and give |\n|---|---|\n");
    for (int i = 0; i < LRB_SHAPE_COUNT; i++)
        fprintf(out, "| %s | %s |\n", lrb_shape_table[i].name, lrb_shape_table[i].sentence);
}

static void write_page(FILE *out, const sim_machine *machine)
{
    fprintf(out,
            "# ISA reference\n\n"
            "Made from `lrbni/ops.def` by `lanetrace ops --markdown`; a test compares. %d ops, by cost class; costs are those of the machine\n"
            "`%s` (`--machine` takes another; [machine-model.md](machine-model.md) has the bases of the numbers).\n\n"
            "An op is the C function `lrb_<op>(context, sources...)`. A vector op has up to four forms: `lrb_X`, `lrb_X_s3` whose last source is\n"
            "swizzled or in memory, and `lrb_mask_X`, `lrb_mask_X_s3` with the old destination and a mask before the sources.\n\n"
            "- *lane i*: what lane i of the result becomes; a, b are the sources in order, d the old destination, m memory, k masks, r general registers.\n"
            "- *mask*: `merge` keeps the old lanes where the mask has 0, `zero` gives 0 bits there, `select` does not touch memory there.\n"
            "- *rounding*: `exact`: none happens; `nearest`: once, to nearest even unless the machine's state says otherwise; `mode`: once, as an\n"
            "  operand asks; `assumed`: no public source tells, the formula is our rule.\n"
            "- *chips*: L the original Larrabee, K Knights Corner, library: only in published intrinsics.\n"
            "- *pipes, latency, throughput*: where it may issue, cycles until its result may be used, cycles to the next of its class.\n"
            "- *source*: keys of [bibliography.md](bibliography.md).\n",
            LRB_OP_COUNT, machine->name);
    write_shapes(out);
    for (int class_id = 0; class_id < LRB_CLASS_COUNT; class_id++)
        if (has_ops((lrb_cost_class)class_id))
            write_class(out, machine, (lrb_cost_class)class_id);
}

static base_status write_ops(const arguments *a, const sim_machine *machine, base_error *err)
{
    base_status status = BASE_OK;
    if (a->markdown) {
        write_page(stdout, machine);
    } else {
        report_table *t = ops_table(machine);
        status = a->json ? report_table_write_json(t, stdout, err) : report_table_write_text(t, stdout, err);
        report_table_destroy(&t);
    }
    if (status == BASE_OK && (fflush(stdout) != 0 || ferror(stdout)))
        status = base_fail(err, BASE_ERR_IO, "stdout", "cannot be written");
    return status;
}

int command_ops(int argc, char **argv)
{
    base_error err = {0};
    arguments a = {.err = &err};
    sim_machine *machine = NULL;
    base_status status = command_parse(&argp, argc, argv, &a, &err);
    if (status == BASE_OK && a.json && a.markdown)
        status = base_fail(&err, BASE_ERR_USAGE, "--markdown", "is not for --json");
    if (status == BASE_OK)
        status = sim_machine_load(a.machine ? a.machine : "larrabee", &machine, &err);
    if (status == BASE_OK)
        status = write_ops(&a, machine, &err);
    sim_machine_destroy(&machine);
    return status == BASE_OK ? 0 : command_fail(&err);
}
