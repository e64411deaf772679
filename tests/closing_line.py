"""Print what failed and was skipped, and 'N passed, N failed[, N skipped]' last: closing_line.py testlog.json...

A test program is one test. What a program leaves out it says in a TAP comment '# skipped: WHY'; each of those counts
as skipped, beside the programs that Meson itself skipped.
"""
import json
import sys


def main(paths):
    passed = 0
    failed = []
    skipped = []
    for path in paths:
        with open(path, encoding='utf-8') as file:
            for line in file:
                test = json.loads(line)
                if test['result'] in ('OK', 'EXPECTEDFAIL'):
                    passed += 1
                elif test['result'] == 'SKIP':
                    skipped.append('%s: %s' % (test['name'], ' '.join((test.get('stdout') or '').split())[:120]))
                else:
                    failed.append('%s: %s: %s after %.0f s' % (path, test['name'], test['result'], test['duration']))
                for text in (test.get('stdout') or '').splitlines():
                    if text.startswith('# skipped'):
                        skipped.append('%s: %s' % (test['name'], text[2:]))
    for line in skipped:
        print('skipped: ' + line)
    for line in failed:
        print('failed: ' + line)
    print('%d passed, %d failed' % (passed, len(failed)) + (', %d skipped' % len(skipped) if skipped else ''))


main(sys.argv[1:])
