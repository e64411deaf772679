#!/usr/bin/env python3
"""Every call of an op stands on one line of its source, whose number is the same for every compiler: one_line.py FILE..., TAP.

The number is in the stream, as the site of a branch, and in the lines of an annotated source.
"""
import re
import sys

CALL = re.compile(r'\blrb_\w+\(')
NO_OPS = {'lrb_at', 'lrb_at_index', 'lrb_imm', 'lrb_mask', 'lrb_segment_at'}


def broken_calls(text):
    """Line numbers of calls that do not end in the line where they begin."""
    for number, line in enumerate(text.splitlines(), 1):
        if re.match(r'\s*(#|\*|/\*|LRB_INLINE|static|void)', line):
            continue
        for call in CALL.finditer(line):
            rest = line[call.end() - 1:]
            depth = [rest[:i + 1].count('(') - rest[:i + 1].count(')') for i in range(len(rest))]
            if 0 not in depth and call.group()[:-1] not in NO_OPS:
                yield number


def main():
    assert list(broken_calls('x = lrb_add_ps(c, a,\n b);\ny = lrb_add_ps(c, a, b);\nlrb_jz(c, lrb_test(c, a,\n a))')) == [1, 4, 4]
    print(f'1..{len(sys.argv) - 1}')
    for number, path in enumerate(sys.argv[1:], 1):
        with open(path, encoding='utf-8') as file:
            broken = sorted(set(broken_calls(file.read())))
        print(f'{"not ok" if broken else "ok"} {number} - {path}')
        for line in broken:
            print(f'# {path}:{line}: a call of an op goes on in the next line')


main()
