#!/usr/bin/env python3
"""Calls of every intrinsic that is made from a row of intrinsics.def, each beside the ops that it stands for.

intrinsic_calls.py INTRINSICS_FOLDER INTRINSICS_DEF OUTPUT..., one output a family: calls_<family>.c. What a form means is
written down here once more, by op and operand, and not taken from the generator of the header.
"""

import os
import re
import sys

# Per suffix: operands of the intrinsic, operands of the op, how a result of each is noted.
OPERANDS = {
    "ps": ("f", "f", "note_f", "note_f"),
    "pi": ("i", "i", "note_i", "note_i"),
    "pu": ("i", "i", "note_i", "note_i"),
    "pd": ("d", "d", "note_d", "note_d"),
    "pq": ("i", "q", "note_i", "note_q"),
}

# Values of the operands beside vectors: for the intrinsic, and for the op.
EXTRAS = {
    "": ("", ""),
    "nearest": ("", "LRB_RN"),
    "round": ("_MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC", "LRB_RU"),
    "sae": ("_MM_FROUND_NO_EXC", ""),
    "fixed": ("_MM_FROUND_TO_NEG_INF, _MM_EXPADJ_8", "LRB_RD, LRB_ADJUST_8"),
    "mantissa": ("_MM_MANT_NORM_p5_1, _MM_MANT_SIGN_zero", "LRB_MANTISSA_P5_1, LRB_SIGN_PLUS"),
    "mantissa_sae": ("_MM_MANT_NORM_p75_1p5, _MM_MANT_SIGN_nan, _MM_FROUND_NO_EXC", "LRB_MANTISSA_P75_1P5, LRB_SIGN_NAN"),
    "count": ("5", "5"),
    "words": ("0x1b", "0x1b"),
}

# (prefix of the name, operands of the intrinsic, the op, operands of the op). D0, D1, D2 are vectors like the result, B like the last
# source, A like the others; k is a mask, + what there is beside.
CALLS = {
    "BINARY": [("", "A0 B1 +", "lrb_{0}", "A0 B1 +"), ("mask_", "D2 k A0 B1 +", "lrb_mask_{0}", "D2 k A0 B1 +")],
    "PLAIN": [("", "A0 B1", "lrb_{0}", "A0 B1")],
    "UNARY": [("", "B0 +", "lrb_{0}", "B0 +"), ("mask_", "D2 k B0 +", "lrb_mask_{0}", "D2 k B0 +")],
    "TERNARY": [("", "D2 A0 B1", "lrb_{0}", "D2 A0 B1"), ("mask_", "D2 k A0 B1", "lrb_mask_{0}", "D2 k A0 B1")],
    "MOVE": [("mask_", "D2 k B0", "lrb_mask_{0}", "D2 k B0")],
    "BLEND": [("mask_", "k A0 B1", "lrb_{0}", "k A0 B1")],
    # 132: d = d * b + a; 231: d = a * b + d (isa-facts 2.2)
    "FMA": [("", "A0 A1 A2 +", "lrb_{1}", "A2 A0 A1 +"), ("mask_", "A0 k A1 A2 +", "lrb_mask_{0}", "A0 k A2 A1 +"),
            ("mask3_", "A0 A1 A2 k +", "lrb_mask_{1}", "A2 k A0 A1 +")],
    "COMPARE": [("", "A0 A1", "lrb_{0}", "A0 A1"), ("mask_", "k A0 A1", "lrb_mask_{0}", "k A0 A1")],
    "SWAPPED": [("", "A0 A1", "lrb_{0}", "A1 A0"), ("mask_", "k A0 A1", "lrb_mask_{0}", "k A1 A0")],
    "MASK": [("", "k l", "lrb_{0}", "k l")],
    "MASK1": [("", "k", "lrb_{0}", "k")],
}
TO_MASK = ("COMPARE", "SWAPPED", "MASK", "MASK1")
MASK = {"k": "s->k[0]", "l": "s->k[1]"}


def slug(family):
    return re.sub(r"\W+", "_", family.lower())


def listed(row, words, side):
    """C operands of the intrinsic (side 0) or of the op (side 1)."""
    types, values = {"D": row.result, "A": row.first, "B": row.source}, []
    for word in words.split():
        if word == "+":
            values.append(EXTRAS[row.extra][side])
        elif word in MASK:
            values.append(MASK[word] + (".bits" if side == 0 else ""))
        else:
            values.append(f"s->{OPERANDS[types[word[0]]][side]}[{word[1]}]")
    return ", ".join(value for value in values if value)


def calls_of(row):
    """(public name, call of the intrinsic, call of the op) of a row."""
    for prefix, left, op, right in CALLS[row.form]:
        public = f"_mm512_{prefix}{row.name}"
        op = op.format(*row.ops)
        if row.extra == "round" and row.form in ("BINARY", "FMA"): # lrb_add_round_ps
            op = re.sub(r"_(\w\w)$", r"_round_\1", op)
        notes = ("note_bits", "note_k") if row.form in TO_MASK else OPERANDS[row.result][2:]
        yield (public, f"{notes[0]}(s, {public}({listed(row, left, 0)}));",
               f"{notes[1]}(s, {op}(s->c, {listed(row, right, 1)}));")


def write_family(path, family, table):
    names = []
    with open(path, "w", encoding="ascii") as file:
        file.write('#include "tests/library/intrinsic_call.h"\n\n')
        for row in table:
            if slug(row.family) != family or row.form not in CALLS:
                continue
            for public, first, second in calls_of(row):
                file.write(f"static CALL_NOINLINE void i{public}(call_side *s) {{ {first} }}\n")
                file.write(f"static CALL_NOINLINE void o{public}(call_side *s) {{ {second} }}\n")
                names.append(public)
        file.write(f"\nextern const call_pair calls_{family}[];\nconst call_pair calls_{family}[] = {{\n")
        for public in names:
            file.write(f'    {{"{public}", i{public}, o{public}}},\n')
        file.write("    {0, 0, 0},\n};\n")


def main():
    folder, table_path, outputs = sys.argv[1], sys.argv[2], sys.argv[3:]
    sys.dont_write_bytecode = True
    sys.path.insert(0, folder)
    import intrinsics # pylint: disable=import-outside-toplevel,import-error
    table = list(intrinsics.rows(table_path))
    families = {slug(row.family) for row in table if row.form in CALLS}
    wanted = {re.fullmatch(r"calls_(\w+)\.c", os.path.basename(path)).group(1): path for path in outputs}
    if families != wanted.keys():
        sys.exit(f"families with calls are {' '.join(sorted(families))}: name their files in tests/library/meson.build")
    for family, path in wanted.items():
        write_family(path, family, table)


if __name__ == "__main__":
    main()
