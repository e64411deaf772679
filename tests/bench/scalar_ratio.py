#!/usr/bin/env python3
"""Scalar ops of the simulated machine against the scalar instructions that the host executes for the same kernel.

    scalar_ratio.py BENCH_NATIVE_ONCE BACKEND LANETRACE [SCENE [SIZE]]

Kernels write the scalar work of the machine as ops: loop control, addresses, masks, the stack, branches. The native build of
the same source is what a compiler makes of that work; callgrind counts its instructions within the kernel's function,
by address, and objdump tells what they are. An instruction with a vector register is vector work, all others are scalar.
docs/where-cycles-go.md explains the ratio.
"""
import collections
import json
import re
import shutil
import subprocess
import sys
import tempfile

VECTOR_REGISTER = re.compile(r'%[xyz]mm')


def host_instructions(program, kernel, scene, size):
    """Executed instructions of the kernel's function and what it calls, by address in the program."""
    function = kernel.replace('-', '_') + '_native'
    counts = collections.Counter()
    with tempfile.NamedTemporaryFile() as out:
        subprocess.run(['valgrind', '--tool=callgrind', '--quiet', '--dump-instr=yes', '--compress-pos=no', '--compress-strings=no',
                        '--toggle-collect=' + function, '--callgrind-out-file=' + out.name, program, kernel, scene, size],
                       check=True, capture_output=True)
        after_call = elsewhere = False
        for line in open(out.name, encoding='utf-8'):
            cost = re.match(r'(0x[0-9a-f]+) \d+ (\d+)$', line)
            if line.startswith('ob='):
                elsewhere = not line.strip().endswith(program.rsplit('/', 1)[-1])
            elif line.startswith('calls='):
                after_call = True  # the next line is what the call cost, which stands at the called function as well
            elif cost:
                if not after_call:
                    counts['elsewhere' if elsewhere else int(cost[1], 16)] += int(cost[2])
                after_call = False
    return counts


def kinds_of(program):
    """'vector', 'branch' or 'scalar' by address."""
    kinds = {}
    text = subprocess.run(['objdump', '-d', '--no-show-raw-insn', program], check=True, capture_output=True, text=True).stdout
    for address, mnemonic, operands in re.findall(r'^\s*([0-9a-f]+):\t(?:notrack |bnd )?(\S+)[ \t]*(.*)$', text, re.MULTILINE):
        branch = mnemonic.startswith('j') or mnemonic in ('call', 'ret')
        kinds[int(address, 16)] = 'vector' if VECTOR_REGISTER.search(operands) else 'branch' if branch else 'scalar'
    return kinds


def simulated_ops(lanetrace, kernel, scene, size):
    """Scalar, mask and branch ops by kind."""
    out = subprocess.run([lanetrace, 'run-kernel', kernel, '--scene', scene, '--size', f'{size}x{size}', '--model', 'count', '--stats',
                          '-'], check=True, capture_output=True, text=True).stdout
    ops = json.loads(out)['ops']
    mask = sum(n for op, n in ops['by_op'].items() if re.match(r'(k|vkmov)', op))
    branch = ops['by_op'].get('jcc', 0) + ops['by_op'].get('jmp', 0)
    return {'scalar': ops['scalar'] - mask - branch, 'mask': mask, 'branch': branch, 'vector': ops['vector']}


def main():
    program, backend, lanetrace = sys.argv[1:4]
    scene = sys.argv[4] if len(sys.argv) > 4 else 'builtin:hall-60k'
    size = sys.argv[5] if len(sys.argv) > 5 else '64'
    if not shutil.which('valgrind') or not shutil.which('objdump'):
        print('# skipped: there is no valgrind, or no objdump')
        return 77
    version = subprocess.run(['valgrind', '--version'], check=True, capture_output=True, text=True).stdout.strip()
    print(f'# {version}: --tool=callgrind; back end {backend}; {scene}, {size}x{size}')
    print('kernel,scalar_ops,mask_ops,branch_ops,vector_ops,host_scalar,host_branch,host_vector,host_elsewhere,ops_per_host_instruction')
    kinds = kinds_of(program)
    for kernel in ('packet16-primary', 'mft-primary'):
        ops = simulated_ops(lanetrace, kernel, scene, size)
        host = collections.Counter()
        for address, count in host_instructions(program, kernel, scene, size).items():
            host['elsewhere' if address == 'elsewhere' else kinds[address]] += count
        simulated = ops['scalar'] + ops['mask'] + ops['branch']
        ratio = simulated / (host['scalar'] + host['branch'])
        print(f'{kernel},{ops["scalar"]},{ops["mask"]},{ops["branch"]},{ops["vector"]},{host["scalar"]},{host["branch"]},{host["vector"]},'
              f'{host["elsewhere"]},{ratio:.3f}', flush=True)
    return 0


if __name__ == '__main__':
    sys.exit(main())
