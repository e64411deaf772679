#!/usr/bin/env python3
"""What simulation costs: the models' wall time and memory beside those of valgrind's cachegrind, a general simulator.

    valgrind.py BENCH_NATIVE_ONCE BACKEND LANETRACE [SIZE [ROUNDS]]

cachegrind simulates two levels of cache and a branch predictor for every instruction of the host that the native kernel executes, as
the core model does, with four threads and their pipes, for every op of the simulated machine. Times are those of the kernel alone, the
best of rounds in turn; slowdowns are over the native kernel of the same back end, as valgrind knows no AVX-512. Memory is the peak of
the whole process.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile

SCENE = 'builtin:hall-60k'
CACHES = ['--I1=32768,8,64', '--D1=32768,8,64', '--LL=262144,8,64']  # of the machine larrabee
CACHEGRIND = ['valgrind', '--tool=cachegrind', '--cache-sim=yes', '--branch-sim=yes', '--cachegrind-out-file=/dev/null', '--quiet'] + CACHES


def run(command):
    """Standard output and the peak of memory in MiB."""
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as child:
        out = child.stdout.read()
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit('%s: exit code %d' % (' '.join(command), child.returncode))
    return out, usage.ru_maxrss / 1024


def of_program(command):
    out, memory = run(command + ['--jobs', '1', '--stats', '-'])
    stats = json.loads(out)
    stats = stats['runs'][0] if 'runs' in stats else stats
    return stats['host']['kernel_s'], memory


def of_native_once(command):
    out, memory = run(command)
    return float(out.strip().splitlines()[-1].split(',')[2]), memory


def ways(program, backend, lanetrace, kernel, size, trace):
    """(name, how to measure it, the way that it is a slowdown of)"""
    live = [lanetrace, 'run-kernel', kernel, '--scene', SCENE, '--size', '%dx%d' % (size, size), '--model']
    once = [program, kernel, SCENE, str(size)]
    return [
        ('native', lambda: of_program(live + ['native']), 'native'),
        ('count', lambda: of_program(live + ['count']), 'native'),
        ('issue', lambda: of_program(live + ['issue']), 'native'),
        ('core', lambda: of_program(live + ['core']), 'native'),
        ('core from a trace', lambda: of_program([lanetrace, 'replay', trace, '--model', 'core']), 'native'),
        ('native ' + backend, lambda: of_native_once(once), 'native ' + backend),
        ('cachegrind on native ' + backend, lambda: of_native_once(CACHEGRIND + once), 'native ' + backend),
    ]


def bench(program, backend, lanetrace, kernel, size, rounds, trace):
    run([lanetrace, 'run-kernel', kernel, '--scene', SCENE, '--size', '%dx%d' % (size, size), '--model', 'native', '--trace', trace])
    seconds, memory = {}, {}
    for _ in range(rounds):
        for name, measure, _ in ways(program, backend, lanetrace, kernel, size, trace):
            taken, peak = measure()
            seconds[name] = min(taken, seconds.get(name, taken))
            memory[name] = max(peak, memory.get(name, peak))
    for name, _, native in ways(program, backend, lanetrace, kernel, size, trace):
        print('simulation/%s/%s,%d,%.6f,%.1f,%.1f' %
              (kernel, name, size, seconds[name], seconds[name] / seconds[native], memory[name]), flush=True)


def main():
    program, backend, lanetrace = sys.argv[1:4]
    size = int(sys.argv[4]) if len(sys.argv) > 4 else 256
    rounds = int(sys.argv[5]) if len(sys.argv) > 5 else 3
    if not shutil.which('valgrind'):
        print('# skipped: there is no valgrind')
        return 77
    print('# %s: %s' % (run(['valgrind', '--version'])[0].strip(), ' '.join(CACHEGRIND[1:4] + CACHES)))
    print('# %s' % run([lanetrace, '--version'])[0].strip())
    print('# %s, one thread, best of %d rounds' % (SCENE, rounds))
    print('row,size,seconds,times_native,peak_mib')
    with tempfile.TemporaryDirectory() as folder:
        for kernel in ('packet16-primary', 'mft-primary'):
            bench(program, backend, lanetrace, kernel, size, rounds, folder + '/t.ltr')
    return 0


if __name__ == '__main__':
    sys.exit(main())
