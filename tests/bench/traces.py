"""Host cost of traces: traces.py LANETRACE [SIZE [ROUNDS]]. CSV on stdout.

For both kernels on builtin:hall-60k, one thread, medians of rounds in turn: seconds of the kernel live, recorded and replayed,
by the program's own clock; bytes of an event in the file.
"""
import json
import os
import statistics
import subprocess
import sys
import tempfile

PROGRAM = sys.argv[1]
SIZE = int(sys.argv[2]) if len(sys.argv) > 2 else 512
ROUNDS = int(sys.argv[3]) if len(sys.argv) > 3 else 5


def run(*words):
    result = subprocess.run([PROGRAM, *words, '--jobs', '1', '--stats', '-'], check=True, capture_output=True, text=True)
    return json.loads(result.stdout)


def seconds(stats):
    return stats['runs'][0]['host']['kernel_s'] if 'runs' in stats else stats['host']['kernel_s']


def ways(kernel, path):
    live = ['run-kernel', kernel, '--scene', 'builtin:hall-60k', '--size', '%dx%d' % (SIZE, SIZE)]
    both = ['--machine', 'larrabee', '--machine', 'knc']
    return {
        'native': live + ['--model', 'native'],
        'native, recorded': live + ['--model', 'native', '--trace', path],
        'issue': live + ['--model', 'issue'],
        'issue, recorded': live + ['--model', 'issue', '--trace', path],
        'core': live + ['--model', 'core'],
        'core, recorded': live + ['--model', 'core', '--trace', path],
        'count, replayed': ['replay', path, '--model', 'count'],
        'issue, replayed': ['replay', path, '--model', 'issue'],
        'issue, replayed on two machines': ['replay', path, '--model', 'issue'] + both,
        'core, replayed': ['replay', path, '--model', 'core'],
        'core, replayed on two machines': ['replay', path, '--model', 'core'] + both,
    }


def events_of(path):
    """Events of a trace, from its tail."""
    with open(path, 'rb') as file:
        file.seek(-40, os.SEEK_END)
        return int.from_bytes(file.read(16)[8:], 'little')


def bench(kernel, folder):
    path = folder + '/t.ltr'
    times = {way: [] for way in ways(kernel, path)}
    for _ in range(ROUNDS):
        for way, words in ways(kernel, path).items():
            times[way].append(seconds(run(*words)))
    events = events_of(path)
    for way, list_of_seconds in times.items():
        median = statistics.median(list_of_seconds)
        print('traces/%s/%s,%.4f,%.1f,%.2f' % (kernel, way.replace(',', ''), median, 1e-6 * events / median, 1e9 * median / events))
    print('traces/%s/file,,,,%.4f' % (kernel, os.path.getsize(path) / events))
    core = statistics.median(times['core'])
    print('# %s: %.1f M events; recording takes %.2f times core alone (goal: at most 2)' %
          (kernel, 1e-6 * events, statistics.median(times['core, recorded']) / core))


def main():
    print('# %s' % subprocess.run([PROGRAM, '--version'], capture_output=True, text=True, check=True).stdout.strip())
    with open('/proc/cpuinfo', encoding='utf-8') as file:
        print('# cpu%s' % next((line.split('model name')[1].strip() for line in file if line.startswith('model name')), ': unknown'))
    print('# builtin:hall-60k, %dx%d, one thread, medians of %d rounds' % (SIZE, SIZE, ROUNDS))
    print('row,seconds,million_events_per_s,ns_per_event,bytes_per_event')
    with tempfile.TemporaryDirectory() as folder:
        for kernel in ('packet16-primary', 'mft-primary'):
            bench(kernel, folder)


main()
