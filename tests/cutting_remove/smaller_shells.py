#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Cut a shell along lines of its mesh, take a piece away, and compare with the
smaller shell, which has the same cells.

  smaller_shells.py NACRE CASE RANKS
"""

import argparse
import os
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
import run_study  # noqa: E402

BASE = """\
set Title = Shell
subsection Study
  set Degrees     = 3
  set Refinements = 0, 1
  set Write VTU   = false
end
subsection Section
  set Young's modulus = 1000
  set Poisson's ratio = 0.3
  set Thickness       = 0.05
end
"""

# Settings of both; of the larger one that is cut; of the smaller one.
CASES = {
    "plate": ({
        "Mid-surface/Surface": "plate",
        "Boundary conditions/Edges": "u=0: clamped",
        "Loads/Force per area": "0.1, 0.3*y, -1-x",
        "Quantities/Quantities":
            "U = energy; w = displacement z at (0.9, 0.8, 0); "
            "M = moment 11 at (0.1, 0.3, 0); "
            "F = reaction z of u=0",
    }, {
        "Mid-surface/Subdivisions": "4, 2",
        "Mid-surface/plate/Size": "2, 1",
        "Cuts/Cuts": "cut: uv (1, -0.1) (1, 1.1)",
        "Cuts/Remove": "(1.7, 0.3, 0); (1.2, 0.4, 0)",
    }, {
        "Mid-surface/Subdivisions": "2, 2",
        "Mid-surface/plate/Size": "1, 1",
    }),
    # A re-entrant corner
    "l_plate": ({
        "Mid-surface/L-shaped plate/Size": "1",
        "Section/Thickness": "0.1",
        "Loads/Force per area": "0.1, 0.3*y, -1-x",
        "Quantities/Quantities":
            "U = energy; w = displacement z at (0.9, 0.8, 0); "
            "v = displacement y at (-0.3, 0.2, 0)",
    }, {
        "Mid-surface/Surface": "expression",
        "Mid-surface/Subdivisions": "4",
        "Mid-surface/expression/Position": "u, v, 0",
        "Mid-surface/expression/Range u": "-1, 1",
        "Mid-surface/expression/Range v": "-1, 1",
        "Cuts/Cuts": "cut: uv (1.1, 0) (0, 0) (0, -1.1)",
        "Cuts/Remove": "(0.6, -0.6, 0)",
        "Boundary conditions/Edges": "u=0: clamped",
    }, {
        "Mid-surface/Surface": "L-shaped plate",
        "Mid-surface/Subdivisions": "2",
        "Boundary conditions/Edges": "left: clamped",
    }),
    "tube": ({
        "Mid-surface/Surface": "cylinder",
        "Boundary conditions/Edges": "v=0: clamped",
        "Loads/Force per area": "0.1*x, 0.3*x*z, -1-y",
        "Quantities/Quantities":
            "U = energy; u = displacement x at (1, 0, 0.8)",
    }, {
        "Mid-surface/Subdivisions": "8, 6",
        "Mid-surface/cylinder/Axial range": "0, 3",
        "Cuts/Cuts": "cut: uv (0, 1) (360, 1)",
        "Cuts/Remove": "(0, 1, 1.3)",
    }, {
        "Mid-surface/Subdivisions": "8, 2",
        "Mid-surface/cylinder/Axial range": "0, 1",
    }),
}
# Round-off of matrices with condition numbers of about 1e7.
TOLERANCE = 1e-9


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("nacre")
    parser.add_argument("case", choices=CASES)
    parser.add_argument("ranks", type=int)
    arguments = parser.parse_args()
    both, larger, smaller = CASES[arguments.case]
    tables = []
    try:
        for settings, ranks in ((larger, arguments.ranks), (smaller, 1)):
            with tempfile.TemporaryDirectory() as folder:
                arguments.prm = os.path.join(folder, "shell.prm")
                arguments.timeout = 100
                arguments.overrides = [f"{name}={value}" for name, value
                                       in (both | settings).items()]
                with open(arguments.prm, "w", encoding="utf-8") as file:
                    file.write(BASE)
                rows = run_study.run_nacre(arguments, ranks, folder)
            for row in rows:
                del row["cells"]  # removed ones are counted
            tables.append(rows)
        good = run_study.compare(*tables, "the smaller shell", TOLERANCE)
    except run_study.Failure as failure:
        print(f"FAILED: {failure}")
        return 1
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
