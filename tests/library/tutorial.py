#!/usr/bin/env python3
"""Runs the tutorial: installs the library into a folder of its own, writes the files that the page shows, runs its commands with
each compiler that there is, and compares what they print with what the page says. TAP on stdout.

tutorial.py SOURCE_ROOT BUILD_ROOT COMPILER SANITIZERS [--update]

COMPILER is the build's; the other of gcc and clang is used too, but not with sanitizers, whose run-time libraries do not mix.
--update writes what the commands print into the page instead.
"""

import os
import re
import shutil
import stat
import subprocess
import sys
import tempfile

PAGE = "docs/tutorial.md"
BLOCK = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def script(folder, name, text):
    """A command that stands in for one of the page's."""
    path = os.path.join(folder, name)
    with open(path, "w", encoding="ascii") as file:
        file.write("#!/bin/sh\n" + text + "\n")
    os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)


def environment(folder, source, build, compiler, sanitizers):
    """Variables in which `cc` is the compiler, what is installed goes to a folder of its own, and is found there."""
    tools, root = os.path.join(folder, "tools"), os.path.join(folder, "root")
    os.makedirs(tools, exist_ok=True)
    flags = f"-fsanitize={sanitizers}" if sanitizers != "none" else ""
    script(tools, "cc", f'exec {compiler} {flags} -Wall -Wextra -Werror "$@"')
    script(tools, "ldconfig", "exit 0")
    script(tools, "meson", f'cd {source} && exec {shutil.which("meson")} install -C {build} --no-rebuild --quiet --destdir {root} '
                           "--tags devel,runtime >&2")
    libraries = [place for place, _, files in os.walk(root) if "liblanetrace.so.0" in files]
    configs = [place for place, _, files in os.walk(root) if "lanetrace.pc" in files]
    return dict(os.environ, PATH=tools + ":" + os.environ["PATH"], LC_ALL="C", LD_LIBRARY_PATH=":".join(libraries),
                PKG_CONFIG_PATH=":".join(configs), PKG_CONFIG_SYSROOT_DIR=root)


def compilers(compiler, sanitizers):
    """The build's compiler, and the other of gcc and clang where it is there and no sanitizer's run-time library is in the way."""
    others = [other for other in ("gcc", "clang") if shutil.which(other) and other not in os.path.basename(compiler)]
    return [compiler] + (others if sanitizers == "none" else [])


def commands(text):
    """(command, expected output) of a console block."""
    for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        command, _, output = part.partition("\n")
        yield command, output


class Run:
    """One pass over the page."""

    def __init__(self, source, build, folder, compiler, sanitizers, avx2):
        self.arguments = (folder, source, build, compiler, sanitizers)
        self.work = os.path.join(folder, "work-" + os.path.basename(compiler))
        os.makedirs(self.work)
        self.avx2 = avx2

    def command(self, command):
        """What a command prints; None if it is left out here."""
        if command.startswith("./setup"):
            return "" # the build that runs this test is its result
        if "avx2" in command and not self.avx2:
            return None
        result = subprocess.run(command, shell=True, cwd=self.work, env=environment(*self.arguments), text=True, capture_output=True,
                                check=False)
        return result.stdout if result.returncode == 0 else f"exit code {result.returncode}: {result.stdout}{result.stderr}"

    def page(self, text):
        """(command, expected, printed) of every command, in order."""
        for language, name, body in BLOCK.findall(text):
            if language == "console":
                for command, expected in commands(body):
                    yield command, expected, self.command(command)
            elif name:
                with open(os.path.join(self.work, name), "w", encoding="utf-8") as file:
                    file.write(body)


def update(path, text, results):
    """Put what was printed into the page."""
    printed = iter(results)

    def block(match):
        if match.group(1) != "console":
            return match.group(0)
        return "```console\n" + "".join(f"$ {command}\n{next(printed)[2]}" for command, _ in commands(match.group(3))) + "```"
    with open(path, "w", encoding="utf-8") as file:
        file.write(BLOCK.sub(block, text))


def has_avx2():
    try:
        with open("/proc/cpuinfo", encoding="ascii", errors="replace") as file:
            return " avx2 " in file.read()
    except OSError:
        return False


def main():
    source, build, compiler, sanitizers = sys.argv[1:5]
    path = os.path.join(source, PAGE)
    with open(path, encoding="utf-8") as file:
        text = file.read()
    with tempfile.TemporaryDirectory() as folder:
        if "--update" in sys.argv:
            update(path, text, list(Run(source, build, folder, compiler, sanitizers, True).page(text)))
            return
        number = 0
        for one in compilers(compiler, sanitizers):
            for command, expected, printed in Run(source, build, folder, one, sanitizers, has_avx2()).page(text):
                number += 1
                same = printed is None or printed == expected
                print(f"{'ok' if same else 'not ok'} {number} - {os.path.basename(one)}: {command}"
                      f"{' # SKIP no AVX2' if printed is None else ''}", flush=True)
                if not same:
                    for label, lines in (("the page", expected), ("printed", printed)):
                        print("".join(f"# {label}: {line}\n" for line in lines.splitlines()), end="")
        print(f"1..{number}")


if __name__ == "__main__":
    main()
