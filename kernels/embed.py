"""Write the kernels' sources as C: embed.py OUT.c SOURCE_ROOT FILE..., each with the number that its LRB_SOURCE names."""
import os
import re
import sys


def main(out, root, *paths):
    lines = ['/* Made by kernels/embed.py. */', '#include "kernels/kernel.h"', '#include "kernels/source_texts.h"', '']
    rows = []
    for number, path in enumerate(paths):
        with open(path, 'rb') as file:
            data = file.read()
        source = re.search(rb'^#define LRB_SOURCE (\w+)$', data, re.MULTILINE)
        if not source:
            sys.exit(f'{path}: has no line "#define LRB_SOURCE ..."')
        # Numbers, not a string literal: compilers need not take literals of more than 4095 bytes.
        lines.append(f'static const char text_{number}[] = {{')
        for start in range(0, len(data) + 1, 24):
            lines.append('    ' + ''.join(f'{byte},' for byte in (data + b'\0')[start:start + 24]))
        lines.append('};')
        name = os.path.relpath(path, root).replace(os.sep, '/')
        rows.append(f'    {{{source.group(1).decode()}, "{name}", text_{number}, {len(data)}}},')
    lines += ['const kernel_source kernel_source_texts[] = {', *rows, '};', f'const size_t kernel_source_text_count = {len(rows)};']
    with open(out, 'w', encoding='ascii') as file:
        file.write('\n'.join(lines) + '\n')


main(*sys.argv[1:])
