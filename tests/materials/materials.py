#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Shells of rubber and of metal that yields against doc/materials.md, coarse.

  materials.py NACRE N_RANKS NAME   run one test
  materials.py --list               names and numbers of ranks, a line each
"""
import pathlib
import sys

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "runs"))
from runs import check, main, near  # noqa: E402  (found by the line above)

FILES = HERE.parents[1] / "prm/materials"
COARSE = {"Study__Name": "case", "Study__Write_VTU": "false",
          "Study__Degrees": "3"}
TESTS = {}


def test(*ranks):
    """Register a test and the numbers of ranks that it runs on."""
    def add(function):
        TESTS[function.__name__] = (function, ranks)
        return function
    return add


def check_path(folder, control, column, table, tolerance):
    """The value of `column` at those of `control`, on the way."""
    rows = folder.rows("case_path.csv")
    for at, expected in table:
        row = min(rows, key=lambda row: abs(float(row[control]) - at))
        check(near(float(row[control]), at, 1e-6),
              f"{control} = {at} isn't on the path: {rows}")
        check(near(float(row[column]), expected, tolerance),
              f"{column} at {control} = {at}: {row}, not {expected}")


if __name__ == "__main__":
    main(TESTS)
