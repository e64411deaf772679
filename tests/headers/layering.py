#!/usr/bin/env python3
"""Enforce who may include whom: layering.py SOURCE_ROOT, TAP on stdout.

Includes of the tree are written from its top. Every quoted include of every C and C++ file is held against RULES; a file
of a folder that has no rule, an include that is not written from the top, and one that names no file are errors too.
"""

import os
import re
import sys

# Folder: what its files may include, as folders ("sim/") or headers ("lrbni/op_table.h"). tests/ may include everything;
# nobody else may include tests/ or cli/.
RULES = {
    "lrbni": ["lrbni/"],
    "scene": ["lrbni/base/", "scene/"],
    "exact": ["lrbni/base/", "scene/", "exact/"],
    "kernels": ["lrbni/", "scene/", "kernels/"],
    "sim": ["lrbni/", "sim/"],
    "traces": ["lrbni/", "traces/"],
    "reports": ["lrbni/base/", "lrbni/op_table.h", "sim/machine.h", "sim/cycles.h", "sim/issue.h", "sim/count.h", "reports/"],
    "lanetrace": ["lrbni/", "sim/", "reports/", "lanetrace/"],
    "cli": ["lrbni/", "scene/", "exact/", "kernels/", "sim/", "traces/", "reports/", "cli/"],
    "tests": ["lrbni/", "scene/", "exact/", "kernels/", "sim/", "traces/", "reports/", "lanetrace/", "cli/", "tests/"],
}
# lrbni/base is the root of the tree: it uses nothing else, lrbni's other headers included.
INNER_RULES = {"lrbni/base": ["lrbni/base/"]}

# Headers that the build makes.
MADE = {"lanetrace/lrbni_intrinsics.h", "lrbni/op_lines.h"}

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
SOURCE = (".c", ".h", ".cpp", ".hpp", ".def")


def source_files(root):
    """Paths of all sources below the folders of RULES, from the root."""
    for folder in sorted(RULES):
        for place, folders, names in os.walk(os.path.join(root, folder)):
            folders.sort()
            for name in sorted(names):
                if name.endswith(SOURCE):
                    yield os.path.relpath(os.path.join(place, name), root).replace(os.sep, "/")


def problems_of(root, path):
    """What is wrong with the includes of one file."""
    folder = path.split("/")[0]
    allowed = RULES[folder]
    for inner, rule in INNER_RULES.items():
        if path.startswith(inner + "/"):
            allowed = rule
    with open(os.path.join(root, path), encoding="utf-8") as file:
        text = file.read()
    for name in INCLUDE.findall(text):
        if name not in MADE and not os.path.exists(os.path.join(root, name)):
            yield f"{path} includes {name}, which is no file from the top of the tree"
        elif not any(name == rule or (rule.endswith("/") and name.startswith(rule)) for rule in allowed):
            yield f"{path} includes {name}: {folder}/ may include {', '.join(allowed)} only"


def unruled_folders(root):
    """Folders with sources that have no rule; build folders (with meson-info) and hidden ones are no part of the tree."""
    for name in sorted(os.listdir(root)):
        place = os.path.join(root, name)
        if name.startswith(".") or name in RULES or not os.path.isdir(place) or os.path.exists(os.path.join(place, "meson-info")):
            continue
        for _, _, names in os.walk(place):
            if any(n.endswith(SOURCE) for n in names):
                yield name
                break


def main():
    root = sys.argv[1]
    files = list(source_files(root))
    print(f"1..{len(RULES) + 1}")
    for number, folder in enumerate(sorted(RULES), 1):
        own = [path for path in files if path.startswith(folder + "/")]
        problems = [problem for path in own for problem in problems_of(root, path)]
        print(f"{'not ok' if problems else 'ok'} {number} - {folder} ({len(own)} files)")
        for problem in problems:
            print("# " + problem)
    unruled = list(unruled_folders(root))
    print(f"{'not ok' if unruled or not files else 'ok'} {len(RULES) + 1} - every folder with sources has a rule")
    for name in unruled:
        print(f"# {name}/ has sources, but no rule in tests/headers/layering.py")


if __name__ == "__main__":
    main()
