#!/usr/bin/env python3
"""Calls of every intrinsic that is made from a row of intrinsics.def, each beside the ops that it stands for.

intrinsic_calls.py INTRINSICS_FOLDER INTRINSICS_DEF OPS_DEF OUTPUT..., one output a family: calls_<family>.c. What a form means is
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

# (prefix of the name, operands of the intrinsic, the op, operands of the op); 0, 1, 2 are vectors, k is a mask.
CALLS = {
    "BINARY": [("", "0 1", "lrb_{0}", "0 1"), ("mask_", "2 k 0 1", "lrb_mask_{0}", "2 k 0 1")],
    "PLAIN": [("", "0 1", "lrb_{0}", "0 1")],
    "UNARY": [("", "0", "lrb_{0}", "0"), ("mask_", "2 k 0", "lrb_mask_{0}", "2 k 0")],
    "MOVE": [("mask_", "2 k 0", "lrb_mask_{0}", "2 k 0")],
    "BLEND": [("mask_", "k 0 1", "lrb_mask_{0}", "0 k 1")],
    # 132: d = d * b + a; 231: d = a * b + d (isa-facts 2.2)
    "FMA": [("", "0 1 2", "lrb_{1}", "2 0 1"), ("mask_", "0 k 1 2", "lrb_mask_{0}", "0 k 2 1"),
            ("mask3_", "0 1 2 k", "lrb_mask_{1}", "2 k 0 1")],
    "COMPARE": [("", "0 1", "lrb_{0}", "0 1"), ("mask_", "k 0 1", "lrb_mask_{0}", "k 0 1")],
    "SWAPPED": [("", "0 1", "lrb_{0}", "1 0"), ("mask_", "k 0 1", "lrb_mask_{0}", "k 1 0")],
    "MASK": [("", "k l", "lrb_{0}", "k l")],
    "MASK1": [("", "k", "lrb_{0}", "k")],
}
TO_MASK = ("COMPARE", "SWAPPED", "MASK", "MASK1")
MASK = {"k": "0", "l": "1"}


def slug(family):
    return re.sub(r"\W+", "_", family.lower())


def calls_of(form, name, ops):
    """(public name, call of the intrinsic, call of the op) of a row."""
    intrinsic, direct, note, note_op = OPERANDS.get(ops[0].rsplit("_", 1)[-1], ("", "", "", ""))
    for prefix, left, op, right in CALLS[form]:
        public = f"_mm512_{prefix}{name}"
        left = ", ".join(f"s->k[{MASK[word]}].bits" if word in MASK else f"s->{intrinsic}[{word}]" for word in left.split())
        right = ", ".join(f"s->k[{MASK[word]}]" if word in MASK else f"s->{direct}[{word}]" for word in right.split())
        first = f"note_bits(s, {public}({left}));" if form in TO_MASK else f"{note}(s, {public}({left}));"
        second = f"{'note_k' if form in TO_MASK else note_op}(s, {op.format(*ops)}(s->c, {right}));"
        yield public, first, second


def write_family(path, family, table):
    names = []
    with open(path, "w", encoding="ascii") as file:
        file.write('#include "tests/library/intrinsic_call.h"\n\n')
        for row_family, form, name, ops in table:
            if row_family != family or form not in CALLS:
                continue
            for public, first, second in calls_of(form, name, ops):
                file.write(f"static CALL_NOINLINE void i{public}(call_side *s) {{ {first} }}\n")
                file.write(f"static CALL_NOINLINE void o{public}(call_side *s) {{ {second} }}\n")
                names.append(public)
        file.write(f"\nextern const call_pair calls_{slug(family)}[];\nconst call_pair calls_{slug(family)}[] = {{\n")
        for public in names:
            file.write(f'    {{"{public}", i{public}, o{public}}},\n')
        file.write("    {0, 0, 0},\n};\n")


def main():
    folder, table_path, ops_path, outputs = sys.argv[1], sys.argv[2], sys.argv[3], sys.argv[4:]
    sys.dont_write_bytecode = True
    sys.path.insert(0, folder)
    import intrinsics # pylint: disable=import-outside-toplevel,import-error
    known = intrinsics.op_ids(ops_path)
    table = [row for row in intrinsics.rows(table_path) if all(op in known for op in row[3])]
    families = {slug(family): family for family, form, _, _ in table if form in CALLS}
    wanted = {re.fullmatch(r"calls_(\w+)\.c", os.path.basename(path)).group(1): path for path in outputs}
    if families.keys() != wanted.keys():
        sys.exit(f"families with calls are {' '.join(sorted(families))}: name their files in tests/library/meson.build")
    for name, path in wanted.items():
        write_family(path, families[name], table)


if __name__ == "__main__":
    main()
