#!/usr/bin/env python3
"""The order of events is the same for every compiler: one_line.py FILE..., TAP.

Every call of an op stands on one line of its source: the number is in the stream, as the site of a branch, and in the lines
of an annotated source. And at most one argument of a call, or value of a list, emits events: C leaves the order of arguments
to the compiler, and gcc and clang choose differently.
"""
import re
import sys

CALL = re.compile(r'\blrb_\w+\(')
EMITS = re.compile(r'\b\w+\(c\b')
NO_OPS = {'lrb_at', 'lrb_at_index', 'lrb_imm', 'lrb_mask', 'lrb_segment_at'}
COMMENT = re.compile(r'/\*.*?\*/', re.DOTALL)


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


def unordered_calls(text):
    """Line numbers of lists, in round brackets or braces, more than one of whose values emits events."""
    text = COMMENT.sub(lambda comment: re.sub(r'[^\n]', ' ', comment.group()), text)
    lists = []  # of the brackets that are open: line, and where each value began
    for at, character in enumerate(text):
        if character in '({':
            lists.append((text.count('\n', 0, at) + 1, [at + 1]))
        elif character == ',' and lists:
            lists[-1][1].append(at + 1)
        elif character in ')}' and lists:
            line, starts = lists.pop()
            values = [text[a:b] for a, b in zip(starts, starts[1:] + [at])]
            if ';' not in text[starts[0]:at] and sum(bool(EMITS.search(value)) for value in values) > 1:
                yield line


def main():
    assert list(broken_calls('x = lrb_add_ps(c, a,\n b);\ny = lrb_add_ps(c, a, b);\nlrb_jz(c, lrb_test(c, a,\n a))')) == [1, 4, 4]
    assert list(unordered_calls('f(c, g(c, a), h(c, b));\nf(c, g(c, a), b);\nv = {g(c),\n h(c)};')) == [1, 3]
    print(f'1..{len(sys.argv) - 1}')
    for number, path in enumerate(sys.argv[1:], 1):
        with open(path, encoding='utf-8') as file:
            text = file.read()
        broken, unordered = sorted(set(broken_calls(text))), sorted(set(unordered_calls(text)))
        print(f'{"not ok" if broken or unordered else "ok"} {number} - {path}')
        for line in broken:
            print(f'# {path}:{line}: a call of an op goes on in the next line')
        for line in unordered:
            print(f'# {path}:{line}: two values of one list emit events: their order is the compiler\'s')


main()
