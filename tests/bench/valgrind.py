#!/usr/bin/env python3
"""What a general simulator costs: the native kernel's wall time under valgrind's cachegrind, beside its own.

    valgrind.py BENCH_NATIVE_ONCE BACKEND [SCENE [SIZE]]

cachegrind simulates two levels of cache for every instruction of the host, as the project's models do for every op of
the simulated machine. Times are those of the kernel alone; without valgrind the best of 5. valgrind knows no AVX-512:
the program is built for a smaller back end.
"""
import shutil
import subprocess
import sys


def kernel_seconds(command):
    out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return float(out.strip().splitlines()[-1].split(',')[2])


def main():
    program, backend = sys.argv[1:3]
    scene = sys.argv[3] if len(sys.argv) > 3 else 'builtin:hall-60k'
    size = sys.argv[4] if len(sys.argv) > 4 else '128'
    if not shutil.which('valgrind'):
        print('# skipped: there is no valgrind')
        return 77
    cachegrind = ['valgrind', '--tool=cachegrind', '--cache-sim=yes', '--cachegrind-out-file=/dev/null', '--quiet']
    version = subprocess.run(['valgrind', '--version'], check=True, capture_output=True, text=True).stdout.strip()
    print(f'# {version}: {" ".join(cachegrind[1:4])}; back end {backend}')
    print('row,size,native_seconds,cachegrind_seconds,times_native')
    for kernel in ('packet16-primary', 'mft-primary'):
        command = [program, kernel, scene, size]
        native = min(kernel_seconds(command) for _ in range(5))
        slow = kernel_seconds(cachegrind + command)
        print(f'cachegrind/{kernel}/{scene.split(":")[-1]},{size},{native:.6f},{slow:.6f},{slow / native:.1f}', flush=True)
    return 0


if __name__ == '__main__':
    sys.exit(main())
