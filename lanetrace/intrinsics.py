#!/usr/bin/env python3
"""From intrinsics.def: the header, the reference page, the names that the tests call.

intrinsics.py header|names INTRINSICS_DEF OPS_DEF OUTPUT
"""

import re
import sys

HEAD = """\
/* C intrinsics in the style of the Larrabee prototype library and of the compiler for Knights Corner, made of lrb_ ops: code that
 * is written with them compiles unchanged, and between lanetrace_begin and lanetrace_end it is counted and timed.
 *
 *     cc -include lanetrace/lrbni_intrinsics.h kernel.c $(pkg-config --cflags --libs lanetrace)
 *
 * docs/intrinsics.md lists them, and says what is accounted for and what is not. Names and operands are those of the Intel
 * Intrinsics Guide (KNCNI) and of the compiler's guide (ICC16); made from lanetrace/intrinsics.def, for C only.
 */
#ifndef LANETRACE_LRBNI_INTRINSICS_H
#define LANETRACE_LRBNI_INTRINSICS_H

#include "lanetrace/intrinsics_base.h"
#include "lanetrace/intrinsics_lanes.h"
#include "lanetrace/intrinsics_memory.h"
"""

# What goes with the suffix of an op: vector type, mask type, how the intrinsic's value becomes the op's and back.
SUFFIXES = {
    "ps": ("lrb_v16f", "__mmask16", "{}", "{}"),
    "pi": ("lrb_v16i", "__mmask16", "{}", "{}"),
    "pu": ("lrb_v16i", "__mmask16", "{}", "{}"),
    "pd": ("lrb_v8d", "__mmask8", "{}", "{}"),
    "pq": ("lrb_v16i", "__mmask8", "lanetrace_q({})", "lanetrace_i({})"),
}

C, K = "lanetrace_c()", "lanetrace_k(k)"

# Form: functions, each a prefix of the name, the parameters, and the call; V stands for the vector type, and the names of vectors
# in the call are converted where the op needs it.
VECTOR = {
    "BINARY": [("", "V a, V b", "lrb_{0}({C}, [a], [b])"),
               ("mask_", "V src, unsigned k, V a, V b", "lrb_mask_{0}({C}, [src], {K}, [a], [b])")],
    "PLAIN": [("", "V a, V b", "lrb_{0}({C}, [a], [b])")],
    "UNARY": [("", "V a", "lrb_{0}({C}, [a])"),
              ("mask_", "V src, unsigned k, V a", "lrb_mask_{0}({C}, [src], {K}, [a])")],
    "MOVE": [("mask_", "V src, unsigned k, V a", "lrb_mask_{0}({C}, [src], {K}, [a])")],
    "BLEND": [("mask_", "unsigned k, V a, V b", "lrb_mask_{0}({C}, [a], {K}, [b])")],
    "FMA": [("", "V a, V b, V c", "lrb_{1}({C}, [c], [a], [b])"),
            ("mask_", "V a, unsigned k, V b, V c", "lrb_mask_{0}({C}, [a], {K}, [c], [b])"),
            ("mask3_", "V a, V b, V c, unsigned k", "lrb_mask_{1}({C}, [c], {K}, [a], [b])")],
}
COMPARES = {
    "COMPARE": [("", "V a, V b", "lrb_{0}({C}, [a], [b])"), ("mask_", "unsigned k, V a, V b", "lrb_mask_{0}({C}, {K}, [a], [b])")],
    "SWAPPED": [("", "V a, V b", "lrb_{0}({C}, [b], [a])"), ("mask_", "unsigned k, V a, V b", "lrb_mask_{0}({C}, {K}, [b], [a])")],
}
MASKS = {
    "MASK": [("", "unsigned a, unsigned b", "lrb_{0}({C}, first, lanetrace_k(b))")],
    "MASK1": [("", "unsigned a", "lrb_{0}({C}, first)")],
}
WRITTEN = {"WRITTEN": ["", "mask_"], "WRITTEN1": [""]}


def rows(path):
    """(family, form, name, ops) of every row."""
    family = None
    with open(path, encoding="ascii") as file:
        for number, line in enumerate(file, 1):
            words = line.split()
            if not words or words[0].startswith("#"):
                continue
            if words[0] == "==":
                family = " ".join(words[1:-1])
            elif words[0] in VECTOR or words[0] in COMPARES or words[0] in MASKS or words[0] in WRITTEN:
                yield family, words[0], words[1], words[2:]
            else:
                sys.exit(f"{path}:{number}: no form {words[0]}")


def op_ids(path):
    """The ids of ops.def."""
    with open(path, encoding="utf-8") as file:
        return set(re.findall(r"^OP\((\w+),", file.read(), re.MULTILINE))


def public_name(name, prefix=""):
    """The intrinsic's name: _mm512_mask_add_ps."""
    return "_" + name if name.startswith("mm_") else f"_mm512_{prefix}{name}"


def functions(form, name, ops):
    """(public name, C source) of each function of a row; a function written by hand has no source here."""
    if form in WRITTEN:
        for prefix in WRITTEN[form]:
            yield public_name(name, prefix), None
        return
    vector, mask, to_op, back = SUFFIXES.get(ops[0].rsplit("_", 1)[-1], ("", "__mmask16", "{}", "{}"))
    for prefix, parameters, call in (VECTOR | COMPARES | MASKS)[form]:
        public = public_name(name, prefix)
        parameters = re.sub(r"\bV\b", vector, parameters)
        call = call.format(*ops, C=C, K=K)
        call = re.sub(r"\[(\w+)\]", lambda match: to_op.format(match.group(1)), call)
        if form in VECTOR:
            result, body = vector, f"return {back.format(call)};"
        else:
            result, body = mask, f"return ({mask})lanetrace_made({call});"
            if form in MASKS: # the masks are looked up before the result gets a place among them
                body = "lrb_k16 first = lanetrace_k(a); " + body
        yield public, f"static inline {result} lanetrace{public}({parameters}) {{ {body} }}"


def header(table):
    lines, defines = [HEAD], []
    family_before = None
    for family, form, name, ops in table:
        for public, source in functions(form, name, ops):
            if source:
                if family != family_before:
                    lines.append(f"\n/* {family} */")
                    family_before = family
                lines.append(source)
            defines += [f"#undef {public}", f"#define {public} lanetrace{public}"]
    lines.append("\n/* The names are taken over; vectors of the host are to be had before this header only. */")
    lines += ["#define __m512 lrb_v16f", "#define __m512i lrb_v16i", "#define __m512d lrb_v8d", *defines, "\n#endif"]
    return "\n".join(lines) + "\n"


def names(table):
    """The public names as C strings, one a line."""
    return "".join(f'"{public}",\n' for _, form, name, ops in table for public, _ in functions(form, name, ops))


def main():
    mode, table_path, ops_path, output = sys.argv[1:]
    known = op_ids(ops_path)
    table = [row for row in rows(table_path) if all(op in known for op in row[3])]
    with open(output, "w", encoding="ascii") as file:
        file.write({"header": header, "names": names}[mode](table))


if __name__ == "__main__":
    main()
