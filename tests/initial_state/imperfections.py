#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""An imperfection from the mode of another mesh, and from scattered points.

  imperfections.py NACRE STRUT.prm

A pin-ended strut of the deflection a sin(pi x/L) without load deflects by
a P/(P_E - P) more under the thrust P, here 3 a.
"""
import argparse
import math
import pathlib
import random
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import run_study  # noqa: E402  (found by the line above)

IMPERFECTION = "Mid-surface/Imperfection/"
MODE = "mode.csv"
AMPLITUDE = 1e-6
CENTRE = f"displacement z at (L/2, b/2, {AMPLITUDE})"


def run(arguments, folder, ranks, settings):
    settings = {IMPERFECTION + "Along normal": "0", "Study/Refinements": "0",
                **settings}
    return run_study.run_nacre(arguments, ranks, folder,
                               [f"{k}={v}" for k, v in settings.items()])[-1]


def check(name, value, expected, tolerance):
    print(f"{name}: {value:.10g}, expected {expected:.10g}")
    if not abs(value - expected) <= tolerance * abs(expected):
        raise run_study.Failure(f"{name}: {value:.10g}, not {expected:.10g}")


def read_mode(folder):
    """The mode's points and displacements."""
    text = pathlib.Path(folder, "output", "study_mode1.csv").read_text("ascii")
    return text, [[float(v) for v in line.split(",")]
                  for line in text.splitlines()[1:]]


def find_mode(arguments, folder, ranks, **settings):
    run(arguments, folder, ranks,
        {"Discretization/Kinematics": "linear", "Analysis/Type": "buckling",
         "Analysis/Number of modes": "1", "Study/Degrees": "3",
         "Mid-surface/Subdivisions": "10, 1", "Analysis/End time": "1",
         "Analysis/Time step": "1",
         "Quantities/Quantities": "k = load factor 1", **settings})
    return read_mode(folder)


def main():
    arguments = argparse.Namespace(nacre=sys.argv[1], prm=sys.argv[2],
                                   timeout=120, overrides=[])
    with tempfile.TemporaryDirectory() as folder:
        text, lines = find_mode(arguments, folder, 2)
        check("nodes of the mode", len(lines), 31 * 4, 0.)
        pathlib.Path(folder, MODE).write_text(text, "ascii")
        centre = [v[5] for v in lines if abs(v[0] - 0.5) < 1e-9]
        sign = math.copysign(1., centre[0])
        # A finer space of another degree, on two ranks
        path = {"Study/Degrees": "4", "Study/Write VTU": "false",
                "Quantities/Quantities": f"w = {CENTRE}"}
        mode = {IMPERFECTION + "Modes": f"{MODE}: {sign * AMPLITUDE}/h"}
        row = run(arguments, folder, 2, {**path, **mode})
        check("w of the mode", row["w"], 3 * AMPLITUDE, 1e-4)
        # The nodes lie on the imperfect surface.
        lines = find_mode(arguments, folder, 1, **mode)[1]
        check("height", max(v[2] for v in lines), AMPLITUDE, 1e-6)

        points = random.Random(1)
        with open(pathlib.Path(folder, "points.txt"), "w",
                  encoding="ascii") as out:
            print("# x y z w", file=out)
            for _ in range(400):
                x, y = points.random(), 0.1 * points.random()
                print(x, y, 0., math.sin(math.pi * x), file=out)
        row = run(arguments, folder, 1, {
            **path, IMPERFECTION + "Points": f"points.txt: {AMPLITUDE}"})
        check("w of points", row["w"], 3 * AMPLITUDE, 3e-4)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except run_study.Failure as failure:
        sys.exit(f"FAILED: {failure}")
