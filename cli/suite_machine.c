#include "cli/suite_machine.h"

#include <stdio.h>

#define WITHOUT_CACHES                                                                                                            \
    {"l2.latency", NULL}, {"l2.cycles_per_line", "0"}, {"memory.latency", NULL}, {"memory.cycles_per_line", "0"},                \
        {"memory.chip_bytes_per_cycle", "0"}
#define WITHOUT_THREADS {"machine.threads", "1"}

const suite_change suite_without_caches[] = {WITHOUT_CACHES, {0}};
const suite_change suite_without_threads[] = {WITHOUT_THREADS, {0}};
const suite_change suite_without_caches_and_threads[] = {WITHOUT_THREADS, WITHOUT_CACHES, {0}};
const suite_change suite_without_mispredictions[] = {{"branch.mispredict_penalty", "0"}, {"branch.btb_miss_penalty", "0"}, {0}};

base_status suite_machine_create(const suite *s, const suite_change *changes, suite_machine *out, base_error *err)
{
    size_t length = 0;
    *out = (suite_machine){0};
    base_status status = command_machine(s->options->machine_name ? s->options->machine_name : "larrabee", &s->options->sets, &out->machine, err);
    for (const suite_change *c = changes; status == BASE_OK && c && c->field; c++) {
        char set[80], hit[16];
        snprintf(hit, sizeof hit, "%u", out->machine->l1.latency);
        snprintf(set, sizeof set, "%s=%s", c->field, c->value ? c->value : hit);
        length += (size_t)snprintf(out->changed + length, sizeof out->changed - length, "%s%s", length ? ", " : "", set);
        status = sim_machine_set(out->machine, set, err);
    }
    return status == BASE_OK ? sim_machine_check(out->machine, err) : status;
}
