"""Write the C table of published values: embed.py OUT.c TABLE.csv..."""
import csv
import os
import sys


def quoted(text):
    escaped = ''.join('\\' + c if c in '"\\' else c if 32 <= ord(c) < 127 else ''.join('\\%03o' % b for b in c.encode()) for c in text)
    return '"' + escaped + '"'


def main(out, paths):
    lines = ['/* Made by reports/papers/embed.py. */', '#include <math.h>', '#include "reports/paper.h"', '',
             'static const report_paper_value values[] = {']
    for path in paths:
        table = os.path.splitext(os.path.basename(path))[0]
        with open(path, newline='', encoding='utf-8') as file:
            for row in csv.DictReader(file):
                text = [quoted(row[key]) for key in ('scene', 'algorithm', 'metric', 'unit', 'source', 'status', 'note')]
                value = repr(float(row['value'])) if row['value'] else '(double)NAN'
                lines.append('    {%s, %s, %s, %s, %s, %s, %s, %s, %s},' % (quoted(table), *text[:3], value, *text[3:]))
    lines += ['};', '', 'const report_paper_value *report_paper_list(size_t *count)', '{',
              '    *count = sizeof values / sizeof *values;', '    return values;', '}']
    with open(out, 'w', encoding='ascii') as file:
        file.write('\n'.join(lines) + '\n')


main(sys.argv[1], sys.argv[2:])
