#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""The expectations of run_study.py hold, and they fail where they must."""

import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import run_study  # noqa: E402  (found by the line above)

TABLE = """element,degree,eta,thickness,cells,dofs,w,ratio,rate_w,solve_s
Lagrange,2,5,0.1,4,75,-0.9,0.9,,0.1
Lagrange,2,5,0.1,16,243,-0.975,0.975,2.3,0.1
Lagrange,2,5,0.01,4,75,-0.8,0.8,,0.1
Lagrange,2,5,0.01,16,243,-0.96,0.96,2.3,0.1
Lagrange,3,default,0.1,4,147,nan,nan,,0.1
"""
HOLD = ["degree == 2 and last: ratio > .95",
        "any degree == 2: ratio > .97",
        "degree == 2 and thickness == .1: "
        "abs(ratio - listed(.9, .975)) <= 1e-9",
        "step == 1 and thickness == .1: abs(order('ratio', 1) - 2) <= 1e-9",
        "step == 1 and thickness == .1: abs(at('ratio', thickness=.01) - .96)"
        " <= 1e-9",
        "eta == 'default': degree == 3"]
FAIL = ["degree == 2: ratio > .85",           # not for all rows
        "any degree == 2: ratio > .98",       # for no row
        "degree == 4: ratio > 0",             # no such row
        "degree == 3: ratio > 0",             # nan
        "degree == 3: ratio != 0",            # nan, though the condition holds
        "degree == 2: rate_w > 0",            # no value in the first row
        "degree == 2: ration > 0",            # no such column
        "degree == 2: abs(ratio - listed(.9)) < 1",      # too few values
        "step == 0: abs(order('ratio', 1)) < 9",         # nothing before it
        "degree == 2: at('ratio', thickness=1) > 0",     # no such row
        "degree == 2: ratio",                 # compares nothing
        "degree == 2: ratio > ",              # not an expression
        "degree == 2 ratio > 0"]              # no colon


def holds(text, rows):
    try:
        return run_study.Expectation(text).holds(rows)
    except run_study.Failure as failure:
        print(f"  FAILED: {failure}")
        return False


def read(folder, text):
    path = pathlib.Path(folder, "study.csv")
    path.write_text(text, encoding="utf-8")
    return run_study.read_table(path)


def main():
    with tempfile.TemporaryDirectory() as folder:
        rows = read(folder, TABLE)
        other = read(folder, TABLE.replace("-0.96", "-0.9600001")
                     .replace(",0.1\n", ",0.2\n").replace("nan", "1"))
    wrong = [text for text in HOLD if not holds(text, rows)]
    wrong += [text for text in FAIL if holds(text, rows)]
    # seconds aren't compared; a nan is a difference even to itself
    finite, finite_other = rows[:4], other[:4]
    for tolerance, expected in (1e-6, True), (1e-8, False):
        same = run_study.compare(finite, finite_other, "a run", tolerance)
        if same != expected:
            wrong.append(f"compare to {tolerance}")
    if run_study.compare(rows, rows, "a run", 1e-6):
        wrong.append("compare nan")
    for text in wrong:
        print(f"WRONG: {text}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
