#!/usr/bin/env python3
"""From intrinsics.def: the header, the reference page, the names that the tests call.

intrinsics.py header|markdown|names INTRINSICS_DEF OPS_DEF OUTPUT
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
WRITTEN = re.compile(r"WRITTEN((?:/\d+){1,2})")


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
            elif words[0] in VECTOR | COMPARES | MASKS or WRITTEN.fullmatch(words[0]):
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
    """(public name, number of operands, C source) of each function of a row; one that is written by hand has no source here."""
    written = WRITTEN.fullmatch(form)
    if written:
        for prefix, operands in zip(("", "mask_"), written.group(1)[1:].split("/")):
            yield public_name(name, prefix), int(operands), None
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
        yield public, parameters.count(",") + 1, f"static inline {result} lanetrace{public}({parameters}) {{ {body} }}"


MOST_ORDERED = 7 # operands of the intrinsics whose operands may be ops


def ordered_call(operands):
    """The macro that calls a function with its operands evaluated from left to right; their names are new in every call."""
    letters = "abcdefg"[:operands]
    listed = ", ".join(letters)
    values = " ".join(f"__auto_type lanetrace_{x}##n = ({x});" for x in letters)
    call = ", ".join(f"lanetrace_{x}##n" for x in letters)
    name = f"LANETRACE_CALL_{operands}"
    return (f"#define {name}(op, {listed}) {name}_(__COUNTER__, op, {listed})\n"
            f"#define {name}_(n, op, {listed}) {name}__(n, op, {listed})\n"
            f"#define {name}__(n, op, {listed}) __extension__({{ {values} op({call}); }})")


def takeover(public, operands):
    """The macro that puts our function in the name's place."""
    if not 2 <= operands <= MOST_ORDERED:
        return f"#undef {public}\n#define {public} lanetrace{public}"
    listed = ", ".join("abcdefg"[:operands])
    return f"#undef {public}\n#define {public}({listed}) LANETRACE_CALL_{operands}(lanetrace{public}, {listed})"


def header(table):
    lines, defines = [HEAD], []
    family_before = None
    for family, form, name, ops in table:
        for public, operands, source in functions(form, name, ops):
            if source:
                if family != family_before:
                    lines.append(f"\n/* {family} */")
                    family_before = family
                lines.append(source)
            defines.append(takeover(public, operands))
    lines.append("\n/* C leaves open in which order operands are evaluated, and the order of ops is the result: it is from left to right. */")
    lines += [ordered_call(operands) for operands in range(2, MOST_ORDERED + 1)]
    lines.append("\n/* The names are taken over; vectors of the host are to be had before this header only. */")
    lines += ["#define __m512 lrb_v16f", "#define __m512i lrb_v16i", "#define __m512d lrb_v8d", *defines, "\n#endif"]
    return "\n".join(lines) + "\n"


PAGE = """\
# Intrinsics

`lanetrace/lrbni_intrinsics.h` has {count} intrinsics in the style of the Larrabee prototype library and of the compiler for Knights
Corner. They are made of ops, so code that is written with them compiles unchanged, in C with gcc or clang, and is counted and timed
between `lanetrace_begin` and `lanetrace_end`; outside of those an intrinsic stops at an assertion. The [tutorial](tutorial.md) has
an example. The header takes the place of `<immintrin.h>`, which it includes first:

    cc -include lanetrace/lrbni_intrinsics.h kernel.c $(pkg-config --cflags --libs lanetrace)

This page and the header are made from `lanetrace/intrinsics.def`. Names and operands: KNCNI, ICC16
([bibliography.md](bibliography.md)).

## What is accounted for

- **The ops of the list below, and nothing else.** C's own work costs nothing: loops, addresses, integer and float arithmetic,
  branches, operators on masks. A kernel whose scalar work matters is to be written with ops.
- **Masks are plain integers**, so an op's mask operand does not say which op made it. It is found by value: the eight newest masks
  that intrinsics have made in the piece of work are kept, as many as there are mask registers, and a mask operand is taken to be
  the newest of those with the same bits. If none has them (a constant, the result of C's `&`) the mask was ready long ago. So a constant
  with the bits of a recent mask seems to depend on it; `_mm512_kand` and its like keep what C's operators lose.
- **Pointers** were ready long ago. An array given to `lanetrace_map` has its address on the simulated machine; any other memory gets
  one line of 64 bytes after the other, in the order in which the piece of work first touches them. The last six bits of the host's
  address remain, so align what you do not map.
- **Constants** (`set1` and the like) are loads from a constant pool: the last line of the thread's scratch. Zero is an exclusive or of a
  register with itself.
- **A swizzle or broadcast is an op of its own.** A compiler would often make it part of the op that reads it.
- **Operands are evaluated from left to right**, by macros, because C leaves the order open and the order of ops is the result. It is still
  open between the operands of C's own operators: write `a = f(x); b = g(y);`, not `f(x) + g(y)`, if both are reductions.
- **A fused multiply-add** under a mask is the form whose destination is the first operand; unmasked and `mask3`, the third.
- **Reductions** are the sequence of Intel's compiler: halves, quarters, pairs, neighbours. The result leaves by way of memory.

What does not work: `__m512` is a structure, larger than 64 bytes, so a pointer to it is no pointer to lanes (use loads and stores), it has
no operators and no braces to initialise it; C++.

"""


def markdown(table):
    lines = [PAGE.format(count=sum(1 for _, form, name, ops in table for _ in functions(form, name, ops)))]
    family_before = None
    for family, form, name, ops in table:
        if family != family_before:
            lines.append(f"\n## {family}\n\n| intrinsic | ops |\n|---|---|\n")
            family_before = family
        publics = ", ".join(f"`{public}`" for public, _, _ in functions(form, name, ops))
        lines.append(f"| {publics} | {', '.join(f'`{op}`' for op in dict.fromkeys(ops)) or 'none'} |\n")
    return "".join(lines)


def names(table):
    """The public names as C strings, one a line."""
    return "".join(f'"{public}",\n' for _, form, name, ops in table for public, _, _ in functions(form, name, ops))


def main():
    mode, table_path, ops_path, output = sys.argv[1:]
    known = op_ids(ops_path)
    table = [row for row in rows(table_path) if all(op in known for op in row[3])]
    with open(output, "w", encoding="ascii") as file:
        file.write({"header": header, "markdown": markdown, "names": names}[mode](table))


if __name__ == "__main__":
    main()
