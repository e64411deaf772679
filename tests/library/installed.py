#!/usr/bin/env python3
"""What is installed, and existing code against it: installs into a folder of its own, looks at the files, compiles the public headers
alone and the samples, which are written with intrinsics, with every compiler and back end that there is. TAP on stdout.

installed.py SOURCE_ROOT BUILD_ROOT COMPILER SANITIZERS
"""

import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import tutorial # pylint: disable=wrong-import-position

HEADERS = {"lanetrace/session.h": [], "lanetrace/lrbni_intrinsics.h": [], "lrbni/lrbni.h": ["-DLRB_LEVEL=2", "-DLRB_SOURCE=1"]}
STRICT = "-std=c17 -Wall -Wextra -Wpedantic -Wshadow -Werror"


def shell(command, environment, folder):
    return subprocess.run(command, shell=True, cwd=folder, env=environment, text=True, capture_output=True, check=False)


def installed_files(root):
    """Paths of all installed files below include/lanetrace and lib*."""
    for place, _, files in os.walk(root):
        for name in files:
            yield os.path.relpath(os.path.join(place, name), root)


def check_files(root):
    """What is wrong with the files."""
    files = list(installed_files(root))
    headers = [path for path in files if "/include/lanetrace/" in path]
    problems = [f"{path} is no header" for path in headers if not path.endswith((".h", ".def"))]
    for wanted in ("/lanetrace/session.h", "/lanetrace/lrbni_intrinsics.h", "/lrbni/lrbni.h", "/lrbni/ops.def", "/lanetrace.pc", "/liblanetrace.so.0"):
        if not any(path.endswith(wanted) for path in files):
            problems.append(f"{wanted[1:]} is not installed")
    return problems


def backends(cpu):
    """Variables of the pkg-config file that this CPU can run, and none."""
    return [""] + [f"$(pkg-config --variable=backend_{name} lanetrace)" for name, flag in (("avx2", "avx2"), ("avx512", "avx512f")) if flag in cpu]


def cpu_flags():
    try:
        with open("/proc/cpuinfo", encoding="ascii", errors="replace") as file:
            return set(file.read().split())
    except OSError:
        return set()


def checks(source, build, compiler, sanitizers):
    """(name, complaint or None) of every check."""
    samples = os.path.join(source, "tests", "library", "samples")
    costs = {}
    with tempfile.TemporaryDirectory() as folder:
        for one in tutorial.compilers(compiler, sanitizers):
            arguments = (folder, source, build, one, sanitizers)
            result = shell("meson", tutorial.environment(*arguments), folder)
            environment = tutorial.environment(*arguments)
            name = os.path.basename(one)
            yield f"{name}: files", result.stderr if result.returncode else "\n".join(check_files(os.path.join(folder, "root"))) or None
            for header, flags in HEADERS.items():
                with open(os.path.join(folder, "alone.c"), "w", encoding="ascii") as file:
                    file.write(f"#include <{header}>\n#include <{header}>\nextern int nothing_else;\n")
                result = shell(f"cc {STRICT} {' '.join(flags)} -fsyntax-only alone.c $(pkg-config --cflags lanetrace)", environment, folder)
                yield f"{name}: {header} alone", result.stderr if result.returncode else None
            for backend in backends(cpu_flags()):
                command = (f"cc {STRICT} -O1 {backend} -include lanetrace/lrbni_intrinsics.h -c {samples}/nbody.c {samples}/select.c "
                           f"$(pkg-config --cflags lanetrace) && cc {STRICT} -O1 {samples}/driver.c nbody.o select.o -o samples "
                           "$(pkg-config --cflags --libs lanetrace) && ./samples")
                result = shell(command, environment, folder)
                costs[name, backend] = result.stdout
                same = result.stdout == next(iter(costs.values()))
                complaint = result.stderr or f"exit code {result.returncode}" if result.returncode else None if same else "other costs"
                yield f"{name}: samples {backend}", complaint


def main():
    number = 0
    for number, (name, complaint) in enumerate(checks(*sys.argv[1:5]), 1):
        print(f"{'not ok' if complaint else 'ok'} {number} - {name}", flush=True)
        for line in (complaint or "").splitlines()[:20]:
            print("# " + line)
    print(f"1..{number}")


if __name__ == "__main__":
    main()
