"""Write the C table of built-in machines: embed.py OUT.c MACHINE.ini..., in the order given."""
import os
import sys


def main(out, paths):
    names = [os.path.splitext(os.path.basename(path))[0] for path in paths]
    lines = ['/* Made by sim/machines/embed.py. */', '#include "sim/machine_values.h"', '']
    sizes = []
    for number, path in enumerate(paths):
        with open(path, 'rb') as file:
            data = file.read()
        sizes.append(len(data))
        # Numbers, not a string literal: compilers need not take literals of more than 4095 bytes.
        lines.append('static const char text_%d[] = {' % number)
        for start in range(0, len(data) + 1, 24):
            lines.append('    ' + ''.join('%d,' % byte for byte in (data + b'\0')[start:start + 24]))
        lines.append('};')
    lines.append('const size_t sim_builtin_count = %d;' % len(paths))
    lines.append('const char *const sim_builtin_names[] = {%s};' % ', '.join('"%s"' % name for name in names))
    lines.append('const sim_builtin_machine sim_builtin_machines[] = {')
    for number, name in enumerate(names):
        lines.append('    {"%s.ini", text_%d, %d},' % (name, number, sizes[number]))
    lines.append('};')
    with open(out, 'w', encoding='ascii') as file:
        file.write('\n'.join(lines) + '\n')


main(sys.argv[1], sys.argv[2:])
