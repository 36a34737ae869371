# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Buckling and vibration in Nacre and in CalculiX (*BUCKLE, *FREQUENCY):
seconds to a part of the converged eigenvalues."""

import math
import pathlib
import tempfile

from calculix import cylinder, deck, edge_forces, hemisphere
from runs import RunError, find_calculix, measure, reason, seconds

LIMIT = 0.01
MODES = 3
# CalculiX seeks the squares of frequencies next to 1: its unit of stress is
# this part of ours, so that all are above.
STIFFER = 1e6
# Asked for fewer load factors, it leaves out some of the lowest: the cylinder's
# first one where it is asked for 8.
ASKED = 20
SHORT = {"E": 1., "nu": 0.3, "h": 0.01}
QUARTER_CYLINDER = {
    "Mid-surface/expression/Range u": "0, L/2",
    "Mid-surface/expression/Range v": "0, pi/2",
    "Boundary conditions/Edges": "u=0: diaphragm; u=1, v=0, v=1: symmetry"}
QUARTER_PLATE = {"Mid-surface/plate/Size": "a/2, a/2"}
PLATE_EDGES = "left, bottom: symmetry; right, top: "
AXIAL = 0.01 ** 2 / math.sqrt(3. * (1. - 0.3 ** 2))
THRUST = math.pi ** 2 * 0.01 ** 3 / 12. / (1. - 0.3 ** 2)


def plate(u, v):
    return 0.5 * u, 0.5 * v, 0.


# Quarters between planes of symmetry; the rotation about an edge is direction
# 3 + axis. `load`: (edge, direction, force in all). `known`: the lowest value
# in closed form or of a series, doc/stability.md.
PROBLEMS = {
    "plate_buckling": {
        **SHORT, "position": plate, "prm": "buckling_plate",
        "symmetry": {("u", 0): 0, ("v", 0): 1},
        # Free in the plane: the thrust is uniform. An edge that is supported
        # has no rotation about its normal in thin plates.
        "held": {("u", 1): (2, 3), ("v", 1): (2, 4)},
        "load": (("u", 1), 0, -0.5 * THRUST), "known": 4.,
        "settings": {**QUARTER_PLATE,
                     "Boundary conditions/Edges": PLATE_EDGES + "fixed",
                     "Analysis/Membrane force": "-pi^2*D/a^2, 0, 0"},
        "meshes": (2, 4, 6, 8)},
    "plate_vibration": {
        **SHORT, "position": plate, "prm": "vibration_plate",
        "symmetry": {("u", 0): 0, ("v", 0): 1}, "held": {},
        "clamped": [("u", 1), ("v", 1)],
        "known": 35.985191 / math.sqrt(12. * (1. - 0.3 ** 2)) * 0.01,
        "settings": {**QUARTER_PLATE,
                     "Boundary conditions/Edges": PLATE_EDGES + "clamped"},
        "meshes": (2, 4, 6, 8, 12)},
    "cylinder_buckling": {
        **SHORT, "position": cylinder(1., 1., 90., "y"),
        "prm": "buckling_prestress",
        "symmetry": {("u", 0): 0, ("u", 1): 2, ("v", 1): 1},
        "held": {("v", 0): (0, 2)},
        "load": (("v", 0), 1, 0.5 * math.pi * AXIAL),
        "settings": {**QUARTER_CYLINDER, "Boundary conditions/Points": "",
                     "Loads/Edge forces": "u=0: (N_cl, 0, 0)"},
        "meshes": (4, 8, 12, 16, 24)},
    "cylinder_vibration": {
        **SHORT, "position": cylinder(1., 1., 90., "y"),
        "prm": "vibration_cylinder",
        "symmetry": {("u", 0): 0, ("u", 1): 2, ("v", 1): 1},
        "held": {("v", 0): (0, 2)}, "known": 0.12816557,
        "settings": {**QUARTER_CYLINDER,
                     "Mid-surface/expression/Closed": "none"},
        "meshes": (2, 4, 6, 8, 12)},
    "hemisphere_vibration": {
        "position": hemisphere(10., 18.), "E": 6.825e7, "nu": 0.3, "h": 0.04,
        "prm": "hemisphere_hole",
        "symmetry": {("u", 0): 1, ("u", 1): 0}, "held": {},
        "points": {(0, 0): (2,)},
        "settings": {"Boundary conditions/Points": "(R, 0, 0): z = 0",
                     "Section/Density": 1, "Loads/Point forces": "",
                     "Analysis/Type": "vibration"},
        "meshes": (2, 4, 6, 8, 12)}}


def is_buckling(problem):
    return "load" in problem


def step(problem, numbers, n, m, axes):
    """*BUCKLE of a linear state, or *FREQUENCY."""
    if not is_buckling(problem):
        return ["*STEP", "*FREQUENCY", f"{MODES}", "*END STEP"]
    edge, direction, force = problem["load"]
    return ["*STEP", "*BUCKLE", f"{ASKED}, 1e-4"] + \
        edge_forces(numbers, n, m, axes, edge, direction, STIFFER * force) + \
        ["*END STEP"]


def eigenvalues_of(dat):
    """Load factors, or angular frequencies, of the tables of a .dat."""
    values, column = [], None
    for line in dat.splitlines():
        words = line.split()
        if "B U C K L I N G" in line:
            column = 1
        elif "E I G E N V A L U E   O U T P U T" in line:
            column = 2
        elif "P A R T I C I P A T I O N" in line:
            column = None
        elif column is not None and len(words) > column and \
                words[0].isdigit():
            values.append(float(words[column]))
    return values


def calculix_run(program, problem, n, element):
    """(eigenvalues, CPU seconds)"""
    text = deck({"gravity": 0., "points": {}, "forces": [],
                 "watch": ((0, 0), 1), **problem, "E": STIFFER * problem["E"]},
                n, element, step)
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "deck.inp").write_text(text, encoding="utf-8")
        done = measure([program, "deck"], folder)
        dat = pathlib.Path(folder, "deck.dat").read_text(encoding="utf-8")
    values = eigenvalues_of(dat)
    if len(values) < MODES:
        raise RunError(f"error: {len(values)} of {MODES} eigenvalues")
    if not is_buckling(problem):
        values = [value / math.sqrt(STIFFER) for value in values]
    return sorted(values)[:MODES], done.cpu


def nacre_run(context, problem, degree, n):
    """(eigenvalues, CPU seconds)"""
    name = "load factor" if is_buckling(problem) else "omega"
    settings = {
        **context.settings(degree, n, (0,)), **problem["settings"],
        "Analysis/Number of modes": MODES,
        "Quantities/Quantities": "; ".join(
            f"e{k} = {name} {k}" for k in range(1, MODES + 1))}
    if problem["prm"] == "buckling_prestress":
        settings["Constants"] = f"R = 1, L = 2, N_cl = {AXIAL}, n = 2"
    row = context.nacre.run(f"benchmarks/{problem['prm']}.prm",
                            settings)[0][0]
    return [row[f"e{k}"] for k in range(1, MODES + 1)], seconds(row)


def best(run_mesh, n, repeat):
    """The eigenvalues, and the least seconds of several runs."""
    results = [run_mesh(n) for _ in range(repeat)]
    return results[0][0], min(cpu for _, cpu in results)


def series_rows(label, meshes, run_mesh, reference, repeat):
    """Rows of a series, to the first mesh below the limit."""
    rows = []
    for n in meshes:
        row = {"series": label, "cells along u": n}
        error = None
        try:
            values, row["cpu_s"] = best(run_mesh, n, repeat)
            error = max(abs(a / b - 1.) for a, b in zip(values, reference))
            row["deviation, %"] = 100. * error
            row["lowest"] = f"{values[0]:.6g}"
        except RunError as failure:
            row["deviation, %"] = "failed: " + reason(failure)
        rows.append(row)
        if error is not None and error <= LIMIT:
            break
    return rows


def eigenvalues(context):
    """buckling and vibration: seconds to 1 % of the lowest three values"""
    calculix = find_calculix()
    if calculix is None:
        context.say("CalculiX isn't installed (Debian: calculix-ccx); "
                    "its rows stay away.")
    table = []
    for name, problem in PROBLEMS.items():
        meshes = problem["meshes"][:2] if context.quick else problem["meshes"]
        if context.quick and not name.startswith("plate"):
            continue
        context.say(name)
        reference = nacre_run(context, problem, 4, meshes[-1])[0]
        row = {"problem": name, "series": "converged",
               "cells along u": meshes[-1], "lowest": f"{reference[0]:.6g}"}
        if "known" in problem:
            row["deviation, %"] = 100. * abs(reference[0] / problem["known"] -
                                             1.)
        table.append(row)
        series = {f"nacre, p = {degree}": lambda n, p=degree, problem=problem:
                  nacre_run(context, problem, p, n)
                  for degree in ((3,) if context.quick else (2, 3, 4))}
        if calculix is not None:
            for element in ("S8R",) if context.quick else ("S8R", "S8"):
                series[f"CalculiX {element}"] = \
                    lambda n, e=element, problem=problem: \
                    calculix_run(calculix, problem, n, e)
        for label, run_mesh in series.items():
            table += [{"problem": name, **row} for row in
                      series_rows(label, meshes, run_mesh, reference,
                                  context.repeat)]
    context.report.table(
        "eigenvalues", "The lowest three eigenvalues to 1 %",
        ["problem", "series", "cells along u", "cpu_s", "lowest",
         "deviation, %"], table,
        ["deviation: the largest of the three load factors or angular "
         "frequencies, relative to the converged ones: nacre's, p = 4, the "
         "finest mesh; theirs: of the lowest from the reference of "
         "doc/stability.md, where there is one",
         f"CalculiX is asked for {ASKED} load factors, since it leaves out "
         "some of the lowest where it is asked for fewer",
         "each series ends with its first mesh below 1 %, or its finest",
         "CPU seconds, the least of "
         f"{context.repeat} runs: of nacre's analysis, of CalculiX' program"])
