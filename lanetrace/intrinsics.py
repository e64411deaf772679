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
#include "lanetrace/intrinsics_reduce.h"
"""

PAGE = """\
# Intrinsics

`lanetrace/lrbni_intrinsics.h` has {count} intrinsics in the style of the Larrabee prototype library and of the compiler for Knights
Corner. They are made of ops, so code that is written with them compiles unchanged, in C with gcc or clang, and is counted and timed
between `lanetrace_begin` and `lanetrace_end`; outside of those an intrinsic stops at an assertion. The [tutorial](tutorial.md) has
an example. The header takes the place of `<immintrin.h>`, which it includes first:

    cc -include lanetrace/lrbni_intrinsics.h kernel.c $(pkg-config --cflags --libs lanetrace)

This page and the header are made from `lanetrace/intrinsics.def`. Names and operands: KNCNI, ICC16, PROTO
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
- **A gather or scatter** is the loop that a compiler makes: an execution for each cache line, each with a test of the mask and a jump.
- **Operands are evaluated from left to right**, by macros, because C leaves the order open and the order of ops is the result. It is still
  open between the operands of C's own operators: write `a = f(x); b = g(y);`, not `f(x) + g(y)`, if both are reductions.
- **A fused multiply-add** under a mask is the form whose destination is the first operand; unmasked and `mask3`, the third.
- **Reductions** are the sequence of Intel's compiler: halves, quarters, pairs, neighbours. The result leaves by way of memory.
- **Rounding operands**: `_MM_FROUND_CUR_DIRECTION` is to nearest even, as the machine starts. Non-temporal hints change no result.

What does not work: `__m512` is a structure, larger than 64 bytes, so a pointer to it is no pointer to lanes (use loads and stores), it has
no operators and no braces to initialise it; C++; sequences with 64-bit indices (`i64gather` and the like), which no instruction has.
"""

# What goes with a suffix: vector type, mask type, how the intrinsic's value becomes the op's and back.
SUFFIXES = {
    "ps": ("lrb_v16f", "__mmask16", "{}", "{}"),
    "pi": ("lrb_v16i", "__mmask16", "{}", "{}"),
    "pu": ("lrb_v16i", "__mmask16", "{}", "{}"),
    "pd": ("lrb_v8d", "__mmask8", "{}", "{}"),
    "pq": ("lrb_v16i", "__mmask8", "lrb_castpi_pq({})", "lrb_castpq_pi({})"),
}

# Operands beside vectors: parameters of the intrinsic, and what the op takes.
EXTRAS = {
    "none": ("", ""),
    "nearest": ("", "LRB_RN"),
    "round": ("int rounding", "lanetrace_rounding(rounding)"),
    "sae": ("int rounding", ""),
    "fixed": ("int rounding, lanetrace_expadj adjust", "lanetrace_rounding(rounding), (lrb_adjust)adjust"),
    "mantissa": ("_MM_MANTISSA_NORM_ENUM interval, _MM_MANTISSA_SIGN_ENUM sign", "(lrb_mantissa)interval, (lrb_mantissa_sign)sign"),
    "mantissa_sae": ("_MM_MANTISSA_NORM_ENUM interval, _MM_MANTISSA_SIGN_ENUM sign, int rounding",
                     "(lrb_mantissa)interval, (lrb_mantissa_sign)sign"),
    "count": ("unsigned n", "n"),
    "words": ("int n", "(unsigned)n & 0xff"),
}

# Form: functions, each a prefix of the name, the parameters and the operands of the op; D is a vector as the op's result, B one as its
# last source, A one as the others; k is a mask, + the operands beside. The op is the first named, under a mask lrb_mask_.
VECTOR = {
    "BINARY": [("", "A a, B b +", "0: a b +"), ("mask_", "D src, k, A a, B b +", "m0: src k a b +")],
    "PLAIN": [("", "A a, B b +", "0: a b +")],
    "UNARY": [("", "B a +", "0: a +"), ("mask_", "D src, k, B a +", "m0: src k a +")],
    "TERNARY": [("", "D a, A b, B c +", "0: a b c +"), ("mask_", "D a, k, A b, B c +", "m0: a k b c +")],
    "MOVE": [("mask_", "D src, k, B a +", "m0: src k a +")],
    "BLEND": [("mask_", "k, A a, B b +", "0: k a b +")],
    "FMA": [("", "A a, A b, A c +", "1: c a b +"), ("mask_", "A a, k, A b, A c +", "m0: a k c b +"),
            ("mask3_", "A a, A b, A c, k +", "m1: c k a b +")],
}
COMPARES = {
    "COMPARE": [("", "A a, A b", "0: a b"), ("mask_", "k, A a, A b", "m0: k a b")],
    "SWAPPED": [("", "A a, A b", "0: b a"), ("mask_", "k, A a, A b", "m0: k b a")],
}
MASKS = {"MASK": 2, "MASK1": 1}
WRITTEN = re.compile(r"WRITTEN((?:/\d+){1,2})")


class Row:
    """A row of intrinsics.def. A form may be followed by `:from` or `:to:from`, suffixes of the sources and of the result where
    they are not the op's own, and by `+extra`, what operands there are beside vectors."""

    def __init__(self, family, words):
        self.family, self.name, self.ops = family, words[1], words[2:]
        form, _, self.extra = words[0].partition("+")
        self.form, *types = form.split(":")
        own = self.ops[0].rsplit("_", 1)[-1] if self.ops else ""
        self.source = types[-1] if types else own
        self.result = types[0] if len(types) == 2 else own
        self.first = own if len(types) == 1 else self.source

    def known(self):
        return self.form in VECTOR or self.form in COMPARES or self.form in MASKS or WRITTEN.fullmatch(self.form)


def rows(path):
    """The rows, in order."""
    family = None
    with open(path, encoding="ascii") as file:
        for number, line in enumerate(file, 1):
            words = line.split()
            if not words or words[0].startswith("#"):
                continue
            if words[0] == "==":
                family = " ".join(words[1:-1])
                continue
            row = Row(family, words)
            if not row.known() or row.extra not in ("", *EXTRAS):
                sys.exit(f"{path}:{number}: no form {words[0]}")
            yield row


def op_ids(path):
    """The ids of ops.def."""
    with open(path, encoding="utf-8") as file:
        return set(re.findall(r"^OP\((\w+),", file.read(), re.MULTILINE))


def public_name(name, prefix=""):
    """The intrinsic's name: _mm512_mask_add_ps."""
    return "_" + name if name.startswith("mm_") else f"_mm512_{prefix}{name}"


def op_call(row, operands, types):
    """The call of the op: `m0: src k a b +` with the types of the vectors."""
    which, _, listed = operands.partition(": ")
    op = row.ops[int(which[-1])]
    if row.extra in ("round",) and row.form in ("BINARY", "FMA"):
        op = re.sub(r"_(\w+)$", r"_round_\1", op)
    values = ["lanetrace_c()"]
    for word in listed.split():
        if word == "k":
            values.append("lanetrace_k(k)")
        elif word == "+":
            values += [EXTRAS[row.extra or "none"][1]] if EXTRAS[row.extra or "none"][1] else []
        else:
            values.append(SUFFIXES[types[word]][2].format(word))
    return f"lrb_{'mask_' if which[0] == 'm' else ''}{op}({', '.join(values)})"


def vector_function(row, prefix, parameters, operands):
    """(public name, number of operands, C source) of one function of a row."""
    letters, types, listed = {"D": row.result, "A": row.first, "B": row.source}, {}, []
    for parameter in parameters.replace(" +", "").split(", "):
        if parameter == "k":
            listed.append("unsigned k")
            continue
        letter, name = parameter.split()
        types[name] = letters[letter]
        listed.append(f"{SUFFIXES[letters[letter]][0]} {name}")
    if " +" in parameters and EXTRAS[row.extra or "none"][0]:
        listed += EXTRAS[row.extra][0].split(", ")
    public, call = public_name(row.name, prefix), op_call(row, operands, types)
    if row.form in VECTOR:
        result, body = SUFFIXES[row.result][0], f"return {SUFFIXES[row.result][3].format(call)};"
    else:
        result = SUFFIXES[row.source][1]
        body = f"return ({result})lanetrace_made({call});"
    unused = "(void)rounding; " if row.extra.endswith("sae") else ""
    return public, len(listed), f"static inline {result} lanetrace{public}({', '.join(listed)}) {{ {unused}{body} }}"


def functions(row):
    """(public name, number of operands, C source) of each function of a row; one that is written by hand has no source here."""
    written = WRITTEN.fullmatch(row.form)
    if written:
        for prefix, operands in zip(("", "mask_"), written.group(1)[1:].split("/")):
            yield public_name(row.name, prefix), int(operands), None
    elif row.form in MASKS: # the masks are looked up before the result gets a place among them
        names = "ab"[:MASKS[row.form]]
        public = public_name(row.name)
        yield public, len(names), (
            f"static inline __mmask16 lanetrace{public}({', '.join('unsigned ' + x for x in names)}) {{ "
            + "".join(f"lrb_k16 k{x} = lanetrace_k({x}); " for x in names)
            + f"return (__mmask16)lanetrace_made(lrb_{row.ops[0]}(lanetrace_c(), {', '.join('k' + x for x in names)})); }}")
    else:
        for prefix, parameters, operands in (VECTOR | COMPARES)[row.form]:
            yield vector_function(row, prefix, parameters, operands)


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
    for row in table:
        for public, operands, source in functions(row):
            if source:
                if row.family != family_before:
                    lines.append(f"\n/* {row.family} */")
                    family_before = row.family
                lines.append(source)
            defines.append(takeover(public, operands))
    lines.append("\n/* C leaves open in which order operands are evaluated, and the order of ops is the result: it is from left to right. */")
    lines += [ordered_call(operands) for operands in range(2, MOST_ORDERED + 1)]
    lines.append("\n/* The names are taken over; vectors of the host are to be had before this header only. */")
    lines += [f"#define {name} {ours}" for name, ours in (
        ("__m512", "lrb_v16f"), ("__m512i", "lrb_v16i"), ("__m512d", "lrb_v8d"), ("_M512", "lrb_v16f"), ("_M512I", "lrb_v16i"),
        ("_M512D", "lrb_v8d"), ("__mmask", "__mmask16"))]
    lines += [*defines, "\n#endif"]
    return "\n".join(lines) + "\n"


def markdown(table):
    lines = [PAGE.format(count=sum(1 for row in table for _ in functions(row)))]
    family_before = None
    for row in table:
        if row.family != family_before:
            lines.append(f"\n## {row.family}\n\n| intrinsic | ops |\n|---|---|\n")
            family_before = row.family
        publics = ", ".join(f"`{public}`" for public, _, _ in functions(row))
        lines.append(f"| {publics} | {', '.join(f'`{op}`' for op in dict.fromkeys(row.ops)) or 'none'} |\n")
    return "".join(lines)


def names(table):
    """The public names as C strings, one a line."""
    return "".join(f'"{public}",\n' for row in table for public, _, _ in functions(row))


def main():
    mode, table_path, ops_path, output = sys.argv[1:]
    ids = op_ids(ops_path)
    table = list(rows(table_path))
    for row in table:
        for op in row.ops:
            if op not in ids:
                sys.exit(f"{table_path}: {row.name}: no op {op} in {ops_path}")
    with open(output, "w", encoding="ascii") as file:
        file.write({"header": header, "markdown": markdown, "names": names}[mode](table))


if __name__ == "__main__":
    main()
