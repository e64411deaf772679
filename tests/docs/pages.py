#!/usr/bin/env python3
"""Pages that are made from tables equal what is made from them now. TAP on stdout.

pages.py SOURCE_ROOT LANETRACE [--update]; --update writes the pages.
"""

import os
import subprocess
import sys
import tempfile


def pages(source, lanetrace):
    """(path, text as it should be) of every page."""
    reference = subprocess.run([lanetrace, "ops", "--markdown"], capture_output=True, text=True, check=True)
    yield "docs/isa-reference.md", reference.stdout
    folder = os.path.join(source, "lanetrace")
    with tempfile.NamedTemporaryFile("r", encoding="utf-8") as page:
        subprocess.run([sys.executable, os.path.join(folder, "intrinsics.py"), "markdown", os.path.join(folder, "intrinsics.def"),
                        os.path.join(source, "lrbni", "ops.def"), page.name], check=True)
        yield "docs/intrinsics.md", page.read()


def main():
    source, lanetrace = sys.argv[1:3]
    made = list(pages(source, lanetrace))
    print(f"1..{len(made)}")
    for number, (path, text) in enumerate(made, 1):
        place = os.path.join(source, path)
        if "--update" in sys.argv:
            with open(place, "w", encoding="utf-8") as file:
                file.write(text)
        with open(place, encoding="utf-8") as file:
            same = file.read() == text
        print(f"{'ok' if same else 'not ok'} {number} - {path}{'' if same else ': ninja -C BUILD update-docs'}")


if __name__ == "__main__":
    main()
