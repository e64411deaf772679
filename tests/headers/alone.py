#!/usr/bin/env python3
"""Compile every header alone, and twice in a row: alone.py SOURCE_ROOT c|cpp SKIPPED_PREFIXES COMPILER..., TAP on stdout.

SKIPPED_PREFIXES are folders whose libraries this build has not, separated by commas ("tests/oracles/").
"""

import os
import re
import subprocess
import sys

FOLDERS = ("lrbni", "scene", "kernels", "sim", "traces", "reports", "cli", "tests")

# Public to C++: the headers that C++ code of this project or of its users includes.
CPP = re.compile(r"(scene/[^/]+|sim/machine|reports/[^/]+|lrbni/base/[^/]+)\.h$")

# Pieces of a header in files of their own; the header that includes each is compiled.
FRAGMENTS = {
    "lrbni/host/float_memory.h": "included by each back end below the functions that it calls",
    "lrbni/host/double_memory.h": "the same",
    "lrbni/host/common/each_lane.h": "the same",
    "lrbni/host/common/arith.h": "the same",
    "tests/scene/near.h": "to be included after cmocka.h, as it says",
}

# What a header needs of the command line: the level and source number that every kernel file has, a path, instructions.
FLAGS = [
    (re.compile(r"lrbni/host/avx2/"), ["-mavx2", "-mfma"]),
    (re.compile(r"lrbni/host/avx512/"), ["-mavx512f", "-mavx2", "-mfma"]),
    (re.compile(r"(lrbni|kernels|tests)/"), ["-DLRB_LEVEL=2", "-DLRB_SOURCE=1"]),
    (re.compile(r"tests/sim/"), ['-DMACHINE_INI="larrabee.ini"']),
]
STRICT = ["-fsyntax-only", "-Wall", "-Wextra", "-Wno-unused-function", "-Wno-unused-const-variable", "-Wno-psabi", "-Werror",
          "-D_GNU_SOURCE"]


def headers(root):
    """Paths of all headers, from the root."""
    for folder in FOLDERS:
        for place, folders, names in os.walk(os.path.join(root, folder)):
            folders.sort()
            for name in sorted(names):
                if name.endswith(".h"):
                    yield os.path.relpath(os.path.join(place, name), root).replace(os.sep, "/")


def compile_alone(root, path, language, compiler):
    """The compiler's complaints about a file that includes the header twice and nothing else; empty if there are none."""
    standard = ["-x", "c", "-std=c17"] if language == "c" else ["-x", "c++", "-std=c++17"]
    extra = [flag for pattern, flags in FLAGS if pattern.match(path) for flag in flags]
    text = f'#include "{path}"\n#include "{path}"\nextern int nothing_else;\n'
    result = subprocess.run(compiler + standard + STRICT + extra + ["-I", root, "-"], input=text, text=True, capture_output=True,
                            check=False)
    return (result.stderr or "the compiler failed") if result.returncode else ""


def main():
    root, language, skipped = sys.argv[1], sys.argv[2], tuple(p for p in sys.argv[3].split(",") if p)
    compiler = sys.argv[4:]
    wanted = [path for path in headers(root) if language == "c" or CPP.match(path)]
    print(f"1..{len(wanted)}")
    for number, path in enumerate(wanted, 1):
        if path in FRAGMENTS:
            print(f"ok {number} - {path} # SKIP {FRAGMENTS[path]}")
        elif skipped and path.startswith(skipped):
            print(f"ok {number} - {path} # SKIP its library is not in this build")
        else:
            complaints = compile_alone(root, path, language, compiler)
            print(f"{'not ok' if complaints else 'ok'} {number} - {path}", flush=True)
            for line in complaints.splitlines()[:12]:
                print("# " + line)


if __name__ == "__main__":
    main()
