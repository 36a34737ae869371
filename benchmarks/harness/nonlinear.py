# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Benchmarks of Sze, Liu and Lo in Nacre and in CalculiX: seconds and
iterations to a part of the converged curve."""

import csv
import math
import pathlib
import tempfile

from calculix import (cylinder, deck, edge_forces, hemisphere,
                      point_forces)
from runs import (PROJECT, RunError, find_calculix, measure, number, reason,
                  seconds)

LIMIT = 0.015
LEVELS = 10


def plate(length, width):
    return lambda u, v: (u * length, v * width, 0.)


def annulus(inner, outer):
    """As prm/benchmarks/sze_slit_annulus.prm has it."""
    def position(u, v):
        angle = u * (2. * math.pi - 1e-3)
        radius = inner + v * (outer - inner)
        return radius * math.cos(angle), radius * math.sin(angle), 0.
    return position


# Those that a static path follows to `end` of their load: no limit point.
# `edge_force`: along z, of the edge u = 1, in all; `edge_moment`: about y.
# `meshes`: cells along u. `deck`: what CalculiX takes instead.
PROBLEMS = {
    "end_shear": {
        "position": plate(10., 1.), "E": 1.2e6, "nu": 0., "h": 0.1,
        "symmetry": {}, "held": {}, "clamped": [("u", 0)],
        "edge_force": 4., "forces": [], "watch": ((1, 0), 3), "quantity": "w",
        "cells_along_v": lambda n: 1, "meshes": (2, 4, 8)},
    # The end turns by 86 degrees: CalculiX' moments on shells end at 90. Its
    # S8R has modes without energy where one cell spans the width.
    "end_moment": {
        "position": plate(12., 1.), "E": 1.2e6, "nu": 0., "h": 0.1,
        "symmetry": {}, "held": {}, "clamped": [("u", 0)],
        "edge_moment": -50. / 3. * math.pi, "forces": [],
        "watch": ((1, 0), 3), "quantity": "w", "end": 0.24,
        "cells_along_v": lambda n: 1, "meshes": (2, 4, 8),
        "deck": {"cells_along_v": lambda n: 2}},
    "slit_annulus": {
        "position": annulus(6., 10.), "E": 21e6, "nu": 0., "h": 0.03,
        "symmetry": {}, "held": {}, "clamped": [("u", 0)],
        "edge_force": 3.2, "forces": [], "watch": ((1, 1), 3),
        "quantity": "wb", "cells_along_v": lambda n: max(1, n // 8),
        "meshes": (16, 24)},
    "hemisphere": {
        "position": hemisphere(10., 18.), "E": 6.825e7, "nu": 0.3, "h": 0.04,
        "symmetry": {("u", 0): 1, ("u", 1): 0}, "held": {},
        "points": {(0, 0): (2,)},
        "forces": [((0, 0), 0, 200.), ((1, 0), 1, -200.)],
        "watch": ((1, 0), 2), "quantity": "v", "meshes": (4, 6, 8),
        "settings": {"Boundary conditions/Points": "(R, 0, 0): z = 0"}},
    "pullout": {
        "position": cylinder(4.953, 5.175, 90., "y"), "E": 10.5e6,
        "nu": 0.3125, "h": 0.094,
        "symmetry": {("u", 0): 0, ("u", 1): 2, ("v", 1): 1}, "held": {},
        "forces": [((0, 1), 2, 10000.)], "watch": ((0, 1), 3),
        "quantity": "wa", "meshes": (4, 6, 8, 12)},
    # Up to where its creases begin to jump between lines of nodes
    "pinched_cylinder": {
        "position": cylinder(100., 100., 90., "y"), "E": 3e4, "nu": 0.3,
        "h": 1., "symmetry": {("u", 0): 0, ("u", 1): 2, ("v", 1): 1},
        "held": {("v", 0): (0, 2)}, "forces": [((0, 1), 2, -3000.)],
        "watch": ((0, 1), 3), "quantity": "wa", "end": 0.1,
        "meshes": (8, 12, 16, 20), "settings": {"Analysis/Output times": ""}},
    "semicylinder": {
        "position": cylinder(101.6, 304.8, 90., "y"), "E": 2068.5, "nu": 0.3,
        "h": 3., "symmetry": {("u", 0): 0, ("u", 1): 2}, "held": {},
        "clamped": [("v", 1)], "forces": [((0, 0), 2, -1000.)],
        "watch": ((0, 0), 3), "quantity": "w", "meshes": (4, 6, 8, 12)},
    "roof": {
        "position": cylinder(2540., 254., 18. / math.pi, "y"), "E": 3102.75,
        "nu": 0.3, "h": 12.7, "symmetry": {("u", 0): 0, ("v", 1): 1},
        "held": {("u", 1): (0, 1, 2)}, "forces": [((0, 1), 2, -750.)],
        "watch": ((0, 1), 3), "quantity": "w", "end": 0.7,
        "meshes": (1, 2, 4)}}


def step(problem, numbers, n, m, axes):
    """The load in levels, of sizes that CalculiX chooses between them."""
    end = problem.get("end", 1.)
    lines = ["*TIME POINTS, NAME=LEVELS, GENERATE",
             f"{end / LEVELS}, {end}, {end / LEVELS}",
             "*AMPLITUDE, NAME=RAMP", "0., 0., 1., 1.",
             "*STEP, NLGEOM, INC=2000", "*STATIC",
             f"{end / LEVELS}, {end}, 1e-8, {end / LEVELS}",
             # Twice the iterations, and cut-backs, that are its defaults
             "*CONTROLS, PARAMETERS=TIME INCREMENTATION",
             "8, 16, 18, 32, 20, 4, , 20"]
    forces = point_forces(problem, numbers, n, m, axes)
    for key, component in (("edge_force", 2), ("edge_moment", 4)):
        if key in problem:
            forces = edge_forces(numbers, n, m, axes, ("u", 1), component,
                                 problem[key])
    forces[0] += ", AMPLITUDE=RAMP"
    return lines + forces + [
        "*NODE PRINT, NSET=WATCH, GLOBAL=YES, TIME POINTS=LEVELS", "U",
        "*END STEP"]


def calculix_run(program, problem, n, element):
    """(values at the levels, iterations, CPU seconds), or why not."""
    problem = {"gravity": 0., "points": {}, **problem,
               **problem.get("deck", {})}
    text = deck(problem, n, element, step)
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "deck.inp").write_text(text, encoding="utf-8")
        done = measure([program, "deck"], folder)
        direction = problem["watch"][1]
        values = [float(line.split()[direction]) for line in
                  pathlib.Path(folder, "deck.dat").read_text(
                      encoding="utf-8").splitlines()
                  if len(line.split()) == 4 and line.split()[0].isdigit()]
        log = pathlib.Path(folder, "deck.sta").read_text(encoding="utf-8")
    # STEP INC ATT ITRS TOT_TIME ...; an attempt that failed has a U or an
    # own line.
    iterations = sum(int(words[3]) for words in map(str.split,
                                                    log.splitlines())
                     if len(words) >= 5 and words[3].isdigit())
    return values, iterations, done.cpu


def nacre_run(context, name, problem, degree, n):
    """(values at the levels, iterations, CPU seconds)"""
    end = problem.get("end", 1.)
    cells = (n, problem.get("cells_along_v", lambda n: n)(n))
    settings = {
        "Study/Degrees": degree, "Study/Name": "run",
        "Study/Write VTU": "false", "Analysis/Checkpoint steps": 0,
        "Analysis/Type": "static", "Analysis/End time": end,
        "Analysis/Time step": end / LEVELS, "Linear solver/Solver": "direct",
        "Analysis/Maximum time step": "default",
        "Mid-surface/Subdivisions": f"{cells[0]}, {cells[1]}",
        "Mid-surface/Grading u": "s", **problem.get("settings", {})}
    with tempfile.TemporaryDirectory() as folder:
        command = [context.nacre.program,
                   PROJECT / f"prm/benchmarks/sze_{name}.prm", "--quiet",
                   "--set", f"Study/Output folder={folder}"]
        for key, value in settings.items():
            command += ["--set", f"{key}={value}"]
        measure(command, folder)
        with open(pathlib.Path(folder, "run_path.csv"),
                  encoding="utf-8") as file:
            path = list(csv.DictReader(file))
        with open(pathlib.Path(folder, "run.csv"), encoding="utf-8") as file:
            row = {key: number(value)
                   for key, value in next(csv.DictReader(file)).items()}
    levels = [end * (k + 1) / LEVELS for k in range(LEVELS)]
    values = [next(float(line[problem["quantity"]]) for line in path
                   if abs(float(line["time"]) - level) < 1e-9)
              for level in levels]
    return (values, sum(int(line["iterations"]) for line in path),
            seconds(row))


def deviation(values, reference):
    """The largest of a level, relative to the converged value there."""
    if len(values) != len(reference):
        return None
    return max(abs(abs(a) / abs(b) - 1.) for a, b in zip(values, reference))


def series_rows(label, meshes, run_mesh, reference):
    """Rows of a series, to the first mesh below the limit."""
    rows = []
    for n in meshes:
        row = {"series": label, "cells along u": n}
        try:
            values, iterations, cpu = run_mesh(n)
            error = deviation(values, reference)
            row.update({"iterations": iterations, "cpu_s": cpu})
            row["deviation, %"] = 100. * error if error is not None else \
                f"{len(values)} of {LEVELS} levels"
        except RunError as failure:
            error = None
            row["deviation, %"] = "failed: " + reason(failure)
        rows.append(row)
        if error is not None and error <= LIMIT:
            break
    return rows


def nonlinear(context):
    """paths of large rotations: seconds and iterations to 1.5 %"""
    calculix = find_calculix()
    if calculix is None:
        context.say("CalculiX isn't installed (Debian: calculix-ccx); "
                    "its rows stay away.")
    table = []
    for name, problem in PROBLEMS.items():
        meshes = problem["meshes"][:2] if context.quick else problem["meshes"]
        if context.quick and name not in ("end_shear", "roof"):
            continue
        context.say(name)
        reference = nacre_run(context, name, problem, 3 if context.quick else 4,
                              meshes[-1])[0]
        series = {f"nacre, p = {degree}": lambda n, p=degree:
                  nacre_run(context, name, problem, p, n)
                  for degree in ((3,) if context.quick else (2, 3))}
        if calculix is not None:
            for element in ("S8R",) if context.quick else ("S8R", "S8"):
                series[f"CalculiX {element}"] = lambda n, e=element: \
                    calculix_run(calculix, problem, n, e)
        for label, run_mesh in series.items():
            table += [{"problem": name, **row} for row in
                      series_rows(label, meshes, run_mesh, reference)]
    context.report.table(
        "nonlinear", "Paths of large rotations to 1.5 % of the converged curve",
        ["problem", "series", "cells along u", "iterations", "cpu_s",
         "deviation, %"], table,
        [f"{LEVELS} levels of the load; the deviation is the largest of a "
         "level, relative to nacre's value there, p = 4, the finest mesh",
         "each series ends with its first mesh below 1.5 %, or its finest",
         "CPU seconds: of nacre's analysis, of CalculiX' program"])
