/* libFuzzer target: any bytes as a machine description. What is accepted must also hash, print and check. */
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include "sim/machine.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    sim_machine *machine = NULL;
    base_error err;
    if (sim_machine_parse("fuzz.ini", (const char *)data, size, &machine, &err) != BASE_OK) {
        if (machine || err.status == BASE_OK)
            abort();
        return 0;
    }
    sim_field_view view;
    for (size_t number = 0; number < SIM_FIELDS; number++)
        if (sim_machine_field(machine, number, &view) && !view.source[0])
            abort();
    if (sim_machine_check(machine, NULL) != BASE_OK || sim_machine_hash(machine) == 0)
        abort();
    sim_machine_destroy(&machine);
    return 0;
}
