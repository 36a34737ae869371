# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""What is measured: each function is a section of benchmarks/run."""

import tempfile

import paper
from calculix import PROBLEMS, CalculiX
from eigenvalues import eigenvalues
from nonlinear import nonlinear
from runs import (PROJECT, RunError, build_empty_program, find_calculix,
                  measure, seconds)

# Seconds to 1 % and 0.1 % of other codes on one core of an Intel Xeon at
# 2.1 GHz, as the project was given them; not measured here.
GIVEN = {
    "scordelis_lo": {"gsKLShell (given)": (.014, .017),
                     "CalculiX S8R (given)": (.010, None),
                     "CalculiX S8 (given)": (.047, None)},
    "pinched_cylinder": {"gsKLShell (given)": (.23, 1.94),
                         "CalculiX S8R (given)": (None, None),
                         "CalculiX S8 (given)": (None, None)},
    "hemisphere_hole": {"gsKLShell (given)": (.053, .19),
                        "CalculiX S8R (given)": (.030, None),
                        "CalculiX S8 (given)": (1.0, 2.2)}}
# The point that holds the translation along z: a node of any mesh.
SUPPORTS = {"hemisphere_hole": {"Boundary conditions/Points":
                                "(R, 0, 0): z = 0"}}
# Grades the coarse cells, not their refinements.
GRADED = {"Mid-surface/Grading u": "s^2", "Mid-surface/Grading v": "s^2"}


class Context:
    """What all sections share."""

    def __init__(self, nacre, report, repeat, quick):
        self.nacre = nacre
        self.report = report
        self.repeat = 1 if quick else repeat
        self.quick = quick

    def settings(self, degree, n, refinements, solver="direct", **more):
        """Those of n x n coarse cells."""
        result = {"Study/Degrees": degree,
                  "Mid-surface/Subdivisions": f"{n}, {n}",
                  "Study/Refinements": ", ".join(str(r) for r in refinements)}
        result.update(self.nacre.solver_setting(solver))
        result.update(more)
        return result

    def say(self, text):
        print(text, flush=True)

    def solvers(self):
        return ["direct", "multigrid"] if self.nacre.has_solvers else ["direct"]


# --- error against seconds ----------------------------------------------------

def time_to(rows, limit):
    """Seconds of the coarsest mesh from which on all errors stay below."""
    good = None
    for row in sorted(rows, key=lambda row: -row["dofs"]):
        if row["error"] > limit:
            break
        good = row["cpu_s"] if good is None else min(good, row["cpu_s"])
    return good


def nacre_series(context, problem, degree, solver, more):
    """Rows of meshes from one cell on."""
    # Few coarse cells, refined; multigrid needs that.
    if context.quick:
        families = ((4, (0, 1)),)
    elif more == GRADED:
        families = tuple((n, (0,)) for n in (2, 3, 4, 6, 8, 10, 12, 16, 20))
    elif solver == "multigrid":
        families = ((4, (2, 3) if degree == 4 else (2, 3, 4)), (6, (2, 3)))
    else:
        families = ((1, (0, 1, 2, 3, 4, 5)), (3, (0, 1, 2, 3)), (5, (0, 1, 2)),
                    (7, (0, 1)))
    result = []
    for n, refinements in families:
        rows, _ = context.nacre.best(
            f"benchmarks/{problem}.prm",
            context.settings(degree, n, refinements, solver, **more,
                             **SUPPORTS.get(problem, {})),
            context.repeat)
        for row, r in zip(rows, refinements):
            result.append({"n": n * 2 ** r, "dofs": row["dofs"],
                           "error": abs(row["ratio"] - 1.),
                           "cpu_s": seconds(row)})
    return sorted(result, key=lambda row: row["dofs"])


def series_of(context, problem, calculix):
    """{label: rows} of one problem."""
    series = {}
    for solver in context.solvers():
        for degree in ((3,) if context.quick else (2, 3, 4)):
            context.say(f"{problem}, p = {degree}, {solver}")
            series[f"p = {degree}, {solver}"] = nacre_series(
                context, problem, degree, solver, {})
    if problem == "pinched_cylinder":
        for degree in (3, 4):
            context.say(f"{problem}, p = {degree}, graded")
            series[f"p = {degree}, direct, graded"] = nacre_series(
                context, problem, degree, "direct", GRADED)
    if calculix is not None:
        for element in ("S8R", "S8"):
            context.say(f"{problem}, CalculiX {element}")
            series[f"CalculiX {element}"] = [
                calculix.row(problem, n, element)
                for n in ((2, 4) if context.quick else (2, 4, 8, 16, 32, 64))]
    return series


def times_of(problem, series):
    """Rows of the table of seconds to an error."""
    limits = {"to 1 %, s": 1e-2, "to 0.1 %, s": 1e-3}
    table = [dict({name: time_to(rows, limit) for name, limit
                   in limits.items()}, problem=problem, series=label)
             for label, rows in series.items()]
    ours = [row for row in table if row["series"].startswith("p = ")]
    table.append(dict(
        {name: min((row[name] for row in ours if row[name] is not None),
                   default=None) for name in limits},
        problem=problem, series="nacre, the best"))
    for label, given in GIVEN[problem].items():
        table.append(dict(zip(limits, given), problem=problem, series=label))
    for row in table:
        row.update({name: "-" for name in limits if row[name] is None})
    return table


def peers(context):
    """error against CPU seconds, beside CalculiX where it is installed"""
    calculix = find_calculix()
    calculix = CalculiX(calculix, context.repeat) if calculix else None
    if calculix is None:
        context.say("CalculiX isn't installed (Debian: calculix-ccx); "
                    "its columns stay away.")
    rows, table, panels = [], [], {}
    for problem in (["scordelis_lo"] if context.quick else PROBLEMS):
        series = series_of(context, problem, calculix)
        panels[problem.replace("_", " ")] = {
            label: ([row["cpu_s"] for row in one],
                    [row["error"] for row in one])
            for label, one in series.items()}
        for label, one in series.items():
            rows += [dict(row, problem=problem, series=label) for row in one]
        table += times_of(problem, series)
        # After each problem: a run that is stopped leaves the others'.
        write_peers(context, rows, table, panels)


def write_peers(context, rows, table, panels):
    context.report.table(
        "peers", "Error against CPU seconds: all meshes",
        ["problem", "series", "n", "dofs", "error", "cpu_s"], rows,
        ["n x n cells on the symmetric part; error: |w / w_KL - 1|",
         "cpu_s: data structures, assembly and solve on one rank, without the "
         "start of the process: nacre's own columns, the least of "
         f"{context.repeat} runs; CalculiX' CPU seconds less those of a deck "
         "of one element"], name="meshes")
    context.report.table(
        "peers", "CPU seconds to an error of 1 % and 0.1 %",
        ["problem", "series", "to 1 %, s", "to 0.1 %, s"], table,
        ["of the coarsest mesh from which on the errors of the series stay "
         "below; -: never. 'given': values that were not measured here"])
    context.report.plot("peers", panels, "CPU seconds",
                        "relative error of the displacement")


# --- parts of a run -----------------------------------------------------------

def assembly(context):
    """microseconds of assembly per cell"""
    rows = []
    repeat = 3 * context.repeat  # short, and the traffic of memory varies
    for degree in (2, 3, 4):
        for refinements in ((2,) if context.quick else (4, 5)):
            found = [context.nacre.run(
                "benchmarks/scordelis_lo.prm",
                context.settings(degree, 2, (refinements,), "multigrid"))[0][0]
                     for _ in range(repeat)]
            cells = found[0]["cells"]
            rows.append({"p": degree, "cells": cells,
                         "dofs": found[0]["dofs"],
                         "microseconds per cell":
                         1e6 * min(row["assembly_s"] for row in found) / cells,
                         "set-up, microseconds per cell":
                         1e6 * min(row["setup_s"] for row in found) / cells})
    context.report.table(
        "assembly", "Assembly of a curved surface, edges included, one rank",
        list(rows[0]), rows, [f"the least of {repeat} runs"])


def solver_rows(context, solver, cases, more=None):
    rows = []
    for degree, n, refinements in cases:
        row = context.nacre.best(
            "benchmarks/scordelis_lo.prm",
            context.settings(degree, n, (refinements,), solver, **(more or {})),
            context.repeat)[0][0]
        rows.append({"p": degree, "dofs": row["dofs"],
                     "solver": row.get("solver", ""),
                     "iterations": row.get("iterations", ""),
                     "set-up s": row["setup_s"],
                     "assembly s": row["assembly_s"],
                     "solve s": row["solve_s"], "sum s": seconds(row),
                     "microseconds per dof": 1e6 * seconds(row) / row["dofs"],
                     "peak GB": row.get("memory_gb", "")})
    return rows


def direct(context):
    """the direct solver: seconds and memory"""
    cases = [(3, 8, 0)] if context.quick else [
        (2, 64, 0), (2, 128, 0), (3, 32, 0), (3, 64, 0), (4, 32, 0),
        (4, 48, 0)]
    rows = solver_rows(context, "direct", cases)
    context.report.table(
        "direct", "Direct solver, Scordelis-Lo roof, one rank", list(rows[0]),
        rows, ["peak GB: of the whole program, the system's pages included"])


# Radii, for the thickness of a shell R/h.
RADII = {"scordelis_lo": 25., "pinched_cylinder": 300.,
         "hemisphere_hole": 10., "hemisphere": 10.}
# Further elements, meshes without refinements, and hanging nodes.
OTHER_CELLS = [
    ("8-node cells", 2, 4, 5, {"Discretization/Element": "serendipity"}),
    ("6-node triangles", 2, 4, 4, {"Discretization/Element": "triangle"}),
    ("one mesh", 3, 64, 0, {}), ("one mesh", 4, 48, 0, {})]


def iteration_rows(context):
    """Iterations for several slendernesses and numbers of dofs."""
    for problem in (["scordelis_lo"] if context.quick else RADII):
        for degree in ((3,) if context.quick else (2, 3, 4)):
            refinements = (2,) if context.quick else \
                {2: (4, 5), 3: (3, 4), 4: (2, 3)}[degree]
            for slenderness in ((100,) if context.quick else
                                (100, 1000, 10000)):
                thickness = RADII[problem] / slenderness
                for row in context.nacre.run(
                        f"benchmarks/{problem}.prm",
                        context.settings(degree, 4, refinements, "multigrid",
                                         **{"Section/Thickness": thickness})
                        )[0]:
                    yield {"problem": problem, "p": degree,
                           "R/h": slenderness, "dofs": row["dofs"],
                           "solver": row["solver"],
                           "iterations": row["iterations"]}


def other_rows(context):
    """Multigrid beside the direct solver where the hierarchy is another."""
    for mesh, degree, n, refinements, more in OTHER_CELLS:
        if context.quick:
            n, refinements = (8, 0) if refinements == 0 else (2, 2)
        for solver in ("multigrid", "direct"):
            yield dict(solver_rows(context, solver, [(degree, n, refinements)],
                                   more)[0], mesh=mesh)


def multigrid(context):
    """the multilevel solver: iterations, seconds and memory"""
    if "multigrid" not in context.solvers():
        context.say("This nacre has no multigrid.")
        return
    cases = [(3, 2, 2)] if context.quick else [
        (2, 4, 4), (2, 4, 5), (2, 9, 5), (3, 4, 3), (3, 4, 4), (3, 4, 5),
        (3, 3, 6), (4, 4, 3), (4, 4, 4), (4, 9, 4)]
    rows = solver_rows(context, "multigrid", cases)
    context.report.table(
        "multigrid", "Multigrid, Scordelis-Lo roof, one rank", list(rows[0]),
        rows, ["solve s: levels, smoothers and iterations"])
    rows = list(iteration_rows(context))
    context.report.table(
        "multigrid", "Iterations of multigrid", list(rows[0]), rows,
        ["solver 'direct': multigrid gave up and the direct solver took over"],
        name="iterations")
    rows = list(other_rows(context))
    context.report.table(
        "multigrid", "Other cells, and meshes without refinements",
        ["mesh"] + [name for name in rows[0] if name != "mesh"], rows,
        ["one mesh: the coarse level has degree 2"], name="others")


# --- several ranks ------------------------------------------------------------

def start_of(context, ranks):
    """Wall seconds of 16 cells: the start of the program and of MPI."""
    return context.nacre.best("benchmarks/scordelis_lo.prm",
                              context.settings(2, 4, (0,)), context.repeat,
                              ranks)[1]


def ranks_rows(context, kind, solver, meshes):
    """
    Rows of one rank and of two, by turns: machines are not always equally
    fast. Parts in CPU seconds over ranks, which MPI spends waiting.
    """
    found = {}
    for _ in range(context.repeat):
        for ranks, (n, refinements) in zip((1, 2), meshes):
            rows, measurement = context.nacre.run(
                "benchmarks/scordelis_lo.prm",
                context.settings(3, n, (refinements,), solver), ranks)
            if ranks not in found or measurement.wall < found[ranks][1]:
                found[ranks] = rows[0], measurement.wall
    return [{"scaling": kind, "solver": solver, "ranks": ranks,
             "dofs": row["dofs"], "iterations": row.get("iterations", ""),
             "set-up s": row["setup_s"] / ranks,
             "assembly s": row["assembly_s"] / ranks,
             "solve s": row["solve_s"] / ranks,
             "wall s": wall - start_of(context, ranks),
             "peak GB": row.get("memory_gb", "")}
            for ranks, (row, wall) in found.items()]


def add_speed_ups(rows):
    """Against one rank of the same kind and solver."""
    for row in rows:
        one = next(other for other in rows if other["ranks"] == 1 and
                   other["scaling"] == row["scaling"] and
                   other["solver"] == row["solver"])
        factor = row["dofs"] / one["dofs"]
        for part in ("assembly", "wall"):
            row[f"{part}, times"] = factor * one[f"{part} s"] / \
                max(row[f"{part} s"], 1e-6)


def scaling(context):
    """strong and weak scaling; iterations on more ranks than cores"""
    rows = []
    # Coarse cells along an edge and refinements; p = 3: 201 243 dofs, and
    # 101 568 a rank
    meshes = {"direct": {"strong": ((43, 1), (43, 1)),
                         "weak": ((61, 0), (86, 0))},
              "multigrid": {"strong": ((11, 3), (11, 3)),
                            "weak": ((8, 3), (11, 3)),
                            "10^6 dofs": ((3, 6), (3, 6))}}
    if context.quick:
        meshes = {solver: {"strong": ((4, 1), (4, 1)),
                           "weak": ((4, 1), (6, 1))} for solver in meshes}
    for solver in context.solvers():
        for kind, of_ranks in meshes[solver].items():
            rows += ranks_rows(context, kind, solver, of_ranks)
    add_speed_ups(rows)
    context.report.table(
        "scaling", "One rank and two, Scordelis-Lo roof, p = 3",
        list(rows[0]), rows,
        ["wall s: of the whole program, less that of a run with 16 cells; the "
         f"least of {context.repeat} runs, by turns",
         "parts: CPU seconds of all ranks over their number; ranks that wait "
         "compute nothing but count",
         "times: how many times faster than one rank, for the same work"])
    if "multigrid" not in context.solvers():
        return
    rows = []
    for ranks in ((1, 2) if context.quick else (1, 2, 4, 8)):
        row = context.nacre.run(
            "benchmarks/scordelis_lo.prm",
            context.settings(3, 4, (2 if context.quick else 4,), "multigrid"),
            ranks)[0][0]
        rows.append({"ranks": ranks, "dofs": row["dofs"],
                     "iterations": row["iterations"],
                     "ratio": f"{row['ratio']:.9f}"})
    context.report.table(
        "scaling", "Iterations of multigrid on several ranks", list(rows[0]),
        rows, ["more ranks than cores: no times"], name="iterations")


def extrapolation(context):
    """10^9 dofs on paper, from the results of the section multigrid"""
    folder = context.report.folder
    try:
        dofs, _, _, _ = paper.measured(folder)
    except (OSError, ValueError, KeyError):
        context.say("There are no results of the section multigrid yet.")
        return
    rows = paper.table(folder)
    context.report.table(
        "extrapolation", "10^9 dofs on paper", list(rows[0]), rows,
        [f"seconds and memory per dof: multigrid at p = {paper.DEGREE}, "
         f"{dofs:.0f} dofs, one rank, multigrid.csv",
         "turns of colours: border patches of the ranks take turns, six of "
         "them, while the other ranks wait",
         f"messages: {paper.LATENCY * 1e6:g} microseconds each and "
         f"{paper.BANDWIDTH / 1e9:g} GB/s, assumed; "
         f"{paper.ITERATIONS} iterations"])


# --- adaptive refinement ------------------------------------------------------

def adaptive(context):
    """uniform and adaptive refinement: error against dofs and seconds"""
    command = [PROJECT / "benchmarks" / "adaptive.py", context.nacre.program,
               "--output", context.report.folder / "adaptive"]
    if context.quick:
        command += ["--cases", "hemisphere", "--degrees", "2", "--max-dofs",
                    "500"]
    print(measure(command, PROJECT).output)


# --- start --------------------------------------------------------------------

def startup(context):
    """wall time of a tiny problem above an empty deal.II program"""
    repeat = 2 if context.quick else 15
    with tempfile.TemporaryDirectory() as folder:
        try:
            empty = build_empty_program(folder)
        except RunError as error:
            context.say(f"The empty program can't be built: {error}")
            return
        nothing = min(measure([empty], folder).wall for _ in range(repeat))
        tiny = min(context.nacre.run(
            "benchmarks/scordelis_lo.prm",
            context.settings(2, 2, (0,)))[1].wall for _ in range(repeat))
    rows = [{"program": "an empty deal.II MPI program", "wall s": nothing},
            {"program": "nacre, 4 cells", "wall s": tiny},
            {"program": "difference", "wall s": tiny - nothing}]
    context.report.table("startup", "What a run costs before it computes",
                         list(rows[0]), rows,
                         [f"one rank, the least of {repeat} runs"])


SECTIONS = {function.__name__: function
            for function in (peers, assembly, direct, multigrid, scaling,
                             extrapolation, adaptive, startup, nonlinear,
                             eigenvalues)}
