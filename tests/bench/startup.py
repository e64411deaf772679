#!/usr/bin/env python3
"""Start-up time of the program: the median of 20 runs of the smallest jobs.

    startup.py LANETRACE
"""
import statistics
import subprocess
import sys
import time

RUNS = 20
TARGET_SECONDS = 0.020
JOBS = (
    ('version', ['--version'], None),
    ('count-rooms-64', ['run-kernel', 'mft-primary', '--scene', 'builtin:rooms-804', '--size', '64x64', '--model', 'count'],
     TARGET_SECONDS),
)


def seconds(command):
    start = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    return time.perf_counter() - start


def main():
    failed = 0
    program = sys.argv[1]
    print(f'# median and best of {RUNS} runs, with the making of the process')
    print('row,median_seconds,best_seconds')
    for name, arguments, target in JOBS:
        try:
            times = [seconds([program] + arguments) for _ in range(RUNS)]
        except subprocess.CalledProcessError as error:
            print(f'startup.py: error: {error}: {error.stderr.decode(errors="replace").strip()}', file=sys.stderr)
            failed = 1
            continue
        median = statistics.median(times)
        print(f'startup/{name},{median:.6f},{min(times):.6f}')
        if target:
            print(f'# target: {name} in less than {1e3 * target:g} ms: {"reached" if median < target else "not reached"} '
                  f'({1e3 * median:.1f} ms)')
    return failed


if __name__ == '__main__':
    sys.exit(main())
