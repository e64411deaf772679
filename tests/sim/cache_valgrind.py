"""Caches against cachegrind's, on an address stream that valgrind's lackey records: cache_valgrind.py WALK REPLAY; TAP."""
import re
import shutil
import subprocess
import sys

# I1, D1, LL as SIZE,WAYS,LINE: the larrabee machine's, the knc machine's, and small ones that miss a lot.
CACHES = [
    ('32768,8,64', '32768,8,64', '262144,8,64'),
    ('32768,8,64', '32768,8,64', '524288,8,64'),
    ('1024,1,32', '4096,2,32', '16384,16,32'),
    ('512,2,64', '2048,4,128', '65536,1,128'),
]


def cachegrind(walk, caches):
    """The nine counts: refs, first-level and last-level misses of instructions, reads and writes."""
    options = ['--%s=%s' % pair for pair in zip(('I1', 'D1', 'LL'), caches)]
    result = subprocess.run(['valgrind', '--tool=cachegrind', '--cache-sim=yes', '--cachegrind-out-file=/dev/stdout', *options, walk],
                            capture_output=True, text=True, check=True)
    events = re.search(r'^events: (.*)$', result.stdout, re.MULTILINE).group(1).split()
    summary = dict(zip(events, map(int, re.search(r'^summary: (.*)$', result.stdout, re.MULTILINE).group(1).split())))
    return [summary[e] for e in ('Ir', 'I1mr', 'ILmr', 'Dr', 'D1mr', 'DLmr', 'Dw', 'D1mw', 'DLmw')]


def main():
    walk, replay = sys.argv[1:3]
    if not shutil.which('valgrind'):
        print('1..0 # SKIP there is no valgrind')
        return 0
    stream = subprocess.run(['valgrind', '--tool=lackey', '--trace-mem=yes', '--log-fd=1', walk],
                            capture_output=True, check=True).stdout
    print('1..%d' % len(CACHES))
    failed = False
    for number, caches in enumerate(CACHES, 1):
        ours = list(map(int, subprocess.run([replay, *caches], input=stream, capture_output=True, check=True).stdout.split()))
        theirs = cachegrind(walk, caches)
        failed |= ours != theirs
        print('%s %d - cache__%s__as_cachegrind' % ('ok' if ours == theirs else 'not ok', number, '_'.join(caches)))
        if ours != theirs:
            print('# sim/cache: %s\n# cachegrind: %s' % (ours, theirs))
    return failed


sys.exit(main())
