#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Curves of equilibria: their points, ends, branches and files.

  paths.py NACRE N_RANKS NAME   run one test
  paths.py --list               names and numbers of ranks, a line each
"""
import math
import pathlib
import sys

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "runs"))
from runs import check, main, near  # noqa: E402  (found by the line above)

BENCHMARKS = HERE.parents[1] / "prm/benchmarks"
ARCH = str(BENCHMARKS / "arc_length_arch.prm")
HINGED = str(BENCHMARKS / "path_arch_hinged.prm")
CIRCLE = str(BENCHMARKS / "finite_circle.prm")
STRIP = str(BENCHMARKS / "arc_length_elastica.prm")
CANTILEVER = str(BENCHMARKS / "cantilever_elastica.prm")
METAL = str(BENCHMARKS.parent / "materials/plastic_plate.prm")
# Semi-analytical: the largest and the smallest load, of 60.
LARGEST, SMALLEST = 52.580408 / 60., 46.188430 / 60.
NO_FIELDS = {"Study__Write_VTU": "false"}
COARSE = {"Study__Degrees": "3", "Study__Name": "case", **NO_FIELDS}
# The strip of the elastica, just beyond its bifurcation.
SHORT = {"Study__Refinements": "0", "Analysis__End_time": "1.05",
         "Study__Name": "strip", **NO_FIELDS}
TESTS = {}


def test(*ranks):
    """Register a test and the numbers of ranks that it runs on."""
    def add(function):
        TESTS[function.__name__] = (function, ranks)
        return function
    return add


def check_near(name, value, expected, tolerance):
    check(near(float(value), expected, tolerance),
          f"{name}: {value}, not {expected}")


def check_same(name, rows, others, tolerance):
    """All columns of two tables but what Newton's method took."""
    check(len(rows) == len(others), f"{name}: {len(rows)}, {len(others)} rows")
    for row, other in zip(rows, others):
        for column in set(row) - {"iterations", "residual", "kind"}:
            check(near(float(row[column]), float(other[column]), tolerance)
                  or abs(float(row[column]) - float(other[column])) < 1e-9,
                  f"{name}, {column}: {row} and {other}")


@test(1)
def point_files(folder):
    """A point is written with its mode, and a path can begin there."""
    text = folder.succeed(ARCH, Study__Degrees="3", Study__Name="case",
                          Study__Refinements="0", Analysis__Maximum_points="1",
                          Analysis__Switch_branch="1")
    check("'Maximum points'" in text, text)
    check("only 0 bifurcation points" in text, f"no warning: {text}")
    points = folder.rows("case_points.csv")
    check(len(points) == 1 and points[0]["kind"] == "limit"
          and points[0]["branch"] == "0", f"points {points}")
    check('Name="mode"' in folder.read("case_point1.vtu"), "no mode")
    check("case_point1.vtu" in folder.read("case_points.pvd"), "not listed")
    folder.succeed(ARCH, Study__Degrees="3", Study__Name="held",
                   Study__Refinements="0", Analysis__Type="static",
                   Analysis__Load_factor=points[0]["time"],
                   Analysis__Start_from="output/case_point1",
                   Analysis__End_time="0.1", **NO_FIELDS)
    check_near("w", folder.rows("held_path.csv")[0]["w"],
               float(points[0]["w"]), 1e-9)


@test(1)
def ends(folder):
    """A bound ends a path of any kind; t may fall first."""
    for kind, time in (("arc length", 1), ("static", 0.8)):
        text = folder.succeed(ARCH, **COARSE, Analysis__Type=kind,
                              Analysis__Stop_where="load factor > 9, w < -0.05",
                              Analysis__End_time=time)
        w = folder.values("case_path.csv", "w")
        check(w[-1] < -0.05 <= w[-2] and "path ends: w < -0.05" in text, text)
    folder.succeed(ARCH, **COARSE, Analysis__Time_step="-0.1",
                   Analysis__End_time="-0.4")
    rows = folder.rows("case_path.csv")
    check(float(rows[-1]["time"]) == -0.4 and float(rows[-1]["w"]) > 0.
          and float(rows[1]["time"]) < 0., f"upward: {rows}")
    folder.fail(ARCH, "--check", **COARSE, Analysis__Stop_where="z < 1",
                expect=("Analysis/Stop where", "'z'", "load factor"))


@test(1)
def points_of_any_steps(folder):
    """A point is found to 1e-6 of a step, whatever the steps. One at t = 0
    almost, of a path that begins downward, has no scale but that of a step."""
    strip = {**SHORT, "Study__Degrees": "3", "Analysis__Maximum_points": "1",
             "Analysis__Switch_branch": "none", "Analysis__End_time": "2"}

    def bifurcation(**settings):
        folder.succeed(STRIP, **dict(strip, **settings))
        point = folder.rows("strip_points.csv")[0]
        check(point["kind"] == "bifurcation", f"{point}")
        return float(point["load_factor"])

    load = bifurcation(Analysis__Time_step="0.9")
    check_near("other steps", bifurcation(Analysis__Time_step="0.3"), load,
               5e-7)
    check_near("downward", bifurcation(Analysis__Time_step="-0.4",
                                       Analysis__End_time="-2",
                                       Analysis__Load_factor="0.9999993-t"),
               load, 5e-7)


@test(1)
def control(folder):
    """The arch is pushed down through both limit points, and back."""
    pushed = {**COARSE, "Analysis__Type": "displacement control",
              "Analysis__Control": "w", "Analysis__Control_step": "0.03",
              "Analysis__Control_values": "-0.33, -0.3",
              "Analysis__Maximum_time_step": "0.1"}
    folder.succeed(ARCH, **pushed)
    rows, points = folder.rows("case_path.csv"), folder.rows("case_points.csv")
    for k, row in enumerate(rows[:-1]):
        check(abs(float(row["w"]) + 0.03 * k) < 1e-12, f"not as asked: {row}")
    check(len(rows) == 13 and abs(float(rows[-1]["w"]) + 0.3) < 1e-12
          and near(float(rows[-1]["time"]), float(rows[10]["time"]), 1e-7),
          f"not the way back: {rows}")
    check(len(points) == 2, f"points {points}")
    for point, expected in zip(points, (LARGEST, SMALLEST)):
        check_near(point["kind"], point["time"], expected, 1e-4)
    folder.fail(ARCH, "--check", **dict(pushed, Analysis__Control="v"),
                expect=("Analysis/Control", "'v'", "w"))
    folder.fail(ARCH, "--check", **pushed,
                Quantities__Quantities="w = kinetic energy",
                expect=("Analysis/Control", "none that", "arc length"))


@test(1, 2)
def control_of_a_rotation(folder):
    """The end of a strip turned once around: the moment is the closed form's,
    t of doc/finite.md's circle; and a path stopped beyond half a turn."""
    n_eighths = 8 if folder.ranks == 1 else 2
    turned = dict(COARSE, Study__Refinements="0", Study__Degrees="4",
                  Quantities__Quantities="a = rotation y at (L, b/2, 0)",
                  Analysis__Type="displacement control", Analysis__Control="a",
                  Analysis__Control_step="pi/4",
                  Analysis__Control_values=f"-{n_eighths}*pi/4",
                  Analysis__Checkpoint_steps="1")
    folder.succeed(CIRCLE, **turned,
                   Analysis__Maximum_steps=str(n_eighths * 5 // 8))
    folder.succeed(CIRCLE, "--restart", **turned)
    rows = folder.rows("case_path.csv")
    check(len(rows) == n_eighths + 1, f"not by eighths of a turn: {rows}")
    for k, row in enumerate(rows[1:], 1):
        check_near("t of the moment", row["time"], k / 8, 1e-6)
        # As many as with the moment prescribed: the gradient is exact.
        check(int(row["iterations"]) <= 9, f"slow: {row}")
        if k != 4:  # half a turn has two signs
            angle = -math.remainder(k * math.pi / 4, 2 * math.pi)
            check(abs(float(row["a"]) - angle) < 1e-9, f"not as asked: {row}")
    if folder.ranks > 1:
        return
    folder.fail(CIRCLE, "--check", **turned,
                Discretization__Kinematics="linear",
                expect=("Analysis/Control", "corotational", "'a'"))
    turned["Quantities__Quantities"] = "a = rotation z at (L, b/2, 0)"
    folder.fail(CIRCLE, "--check", **turned,
                expect=("'a'", "along the surface"))


@test(1, 2)
def control_of_results(folder):
    """The moment at the arch's crown rises through both limit points. The size
    of a stress has a kink at rest, an energy no slope. A metal's moment is that
    of the displacement, by the same steps."""
    arch = dict(COARSE, Quantities__Quantities="m = moment 11 at (0, b/2, R); "
                "s = von Mises stress top at (0, b/2, R); U = energy",
                Analysis__Type="displacement control", Analysis__Control="m",
                Analysis__Control_values="-40" if folder.ranks == 1 else "-20",
                Analysis__Control_step="10", Analysis__Maximum_time_step="0.1")
    folder.succeed(ARCH, **arch)
    rows = folder.rows("case_path.csv")
    for k, row in enumerate(rows[1:], 1):
        check_near("m as asked", row["m"], -10 * k, 1e-6)
        # As for displacements: a good slope
        check(int(row["iterations"]) <= 7, f"slow: {row}")
    if folder.ranks > 1:
        return
    points = folder.rows("case_points.csv")
    check(len(points) == 2, f"points {points}")
    for point, expected in zip(points, (LARGEST, SMALLEST)):
        check_near(point["kind"], point["time"], expected, 1e-4)
    size = float(rows[-1]["s"])
    folder.succeed(ARCH, **dict(arch, Analysis__Control="s",
                                Analysis__Control_values=size,
                                Analysis__Control_step=size / 3))
    check_near("t", folder.values("case_path.csv", "time")[-1],
               float(rows[-1]["time"]), 1e-6)
    folder.fail(ARCH, **dict(arch, Analysis__Control="U"),
                expect=("doesn't change", "Analysis/Control", "Start from"))
    metal = dict(COARSE, Quantities__Quantities="w = displacement z at (0, 0, "
                 "0); m = moment 11 at (0.2, 0, 0)", Study__Degrees="2",
                 Analysis__Control="m", Analysis__Control_step="0.45*M_p",
                 Analysis__Control_values="0.9*M_p",
                 Analysis__Maximum_steps="2")
    folder.succeed(METAL, **metal)
    rows = folder.rows("case_path.csv")
    check_near("a metal's m", rows[-1]["m"], 0.9e-10, 1e-6)
    w = [float(row["w"]) for row in rows[1:]]
    check(w[-1] > 2.1 * w[-2], f"it doesn't yield: {w}")
    metal.update(Analysis__Control="w", Analysis__Control_step=w[-1],
                 Analysis__Control_values=", ".join(map(repr, w)))
    folder.succeed(METAL, **metal)
    check_near("its t", folder.values("case_path.csv", "time")[-1],
               float(rows[-1]["time"]), 1e-5)


@test(1)
def all_branches(folder):
    """Each side of the strip's branch in files of its own; mirror images. A
    run that goes on with what an earlier one has found ends up the same."""
    folder.succeed(STRIP, **SHORT, Analysis__Switch_branch="all")
    points = folder.rows("strip_points.csv")
    check(len(points) == 1 and points[0]["kind"] == "bifurcation", f"{points}")
    check_near("load", points[0]["load_factor"], 1., 1e-5)
    paths = {name: folder.rows(f"strip{name}_path.csv")
             for name in ("", "_branch1", "_branch-1")}
    check(abs(float(paths[""][-1]["w"])) < 1e-6, "not the primary path")
    check_near("start", paths["_branch1"][0]["time"],
               float(points[0]["time"]), 1e-12)
    ends = [float(paths[f"_branch{k}"][-1]["w"]) for k in (1, -1)]
    check(ends[0] > 0.3 and near(ends[0], -ends[1], 1e-6), f"ends {ends}")
    for name in ("_branch-1_path.csv", "_branch-1.checkpoint"):
        (folder.path / "output" / f"strip{name}").unlink()
    folder.succeed(STRIP, "--restart", **SHORT, Analysis__Switch_branch="all")
    for name, rows in paths.items():
        check_same(name, folder.rows(f"strip{name}_path.csv"), rows, 1e-12)


@test(1)
def branch_meets_the_path(folder):
    """Where the hinged arch's branch passes through the symmetric path, t turns
    and the pivots stay. The symmetric path has its bifurcation there."""
    coarse = {"Study__Degrees": "3", "Study__Name": "case", **NO_FIELDS,
              "Mid-surface__Subdivisions": "4, 1"}
    folder.succeed(HINGED, **coarse, Analysis__Switch_branch="1",
                   Analysis__Maximum_time_step="0.15",
                   Analysis__Maximum_points="2")
    meeting = folder.rows("case_points.csv")[-1]
    check(meeting["kind"] == "bifurcation of another path"
          and meeting["branch"] == "1"
          and meeting["pivots_before"] == meeting["pivots_after"] == "1"
          and abs(float(meeting["u"])) < 1e-4, f"{meeting}")
    path = folder.values("case_path.csv", "time")
    check(path[-1] > float(meeting["time"]) < path[-2], f"no turn: {path}")
    # From the snapped shape, while the load is reversed
    folder.succeed(HINGED, **{**coarse, "Study__Name": "snapped"},
                   Analysis__Type="relaxation", Analysis__Time_step="1",
                   Analysis__Maximum_time_step="1",
                   Analysis__Switch_branch="none")
    folder.succeed(HINGED, **coarse, Analysis__Start_from="output/snapped",
                   Analysis__Load_factor="1-t", Analysis__End_time="3",
                   Analysis__Maximum_points="1")
    point = folder.rows("case_points.csv")[0]
    check(point["kind"] == "bifurcation" and
          abs(float(point["load_factor"]) - float(meeting["load_factor"]))
          < 2e-6, f"{point} and {meeting}")


@test(1, 2)
def control_of_a_reaction(folder):
    """The end of a strip is moved until its support bears a force: as far as
    the force moves it, that of a load there included."""
    strip = dict(COARSE, Study__Refinements="0",
                 Discretization__Kinematics="finite",
                 Quantities__Quantities="w = displacement z at (L, b/2, 0); "
                 "F = reaction z of u=1")
    cases = [("", "P/4", "finite")]
    if folder.ranks == 1:
        cases = [("", "P", "finite"), ("u=1: 0, 0, P/4", "P/2", "finite"),
                 ("", "P", "corotational")]
    for load, end, kinematics in cases:
        strip["Discretization__Kinematics"] = kinematics
        folder.succeed(CANTILEVER, **strip, Loads__Edge_forces=load,
                       Boundary_conditions__Edges="u=0: clamped; u=1: z = L",
                       Analysis__Type="displacement control",
                       Analysis__Control="F", Analysis__Control_step="P/4",
                       Analysis__Control_values=end)
        rows = folder.rows("case_path.csv")
        slowest = max(int(row["iterations"]) for row in rows)
        check(kinematics == "corotational" or slowest <= 12, f"slow: {rows}")
        w, force, time = (float(rows[-1][c]) for c in ("w", "F", "time"))
        check_near("F", force, {"P": 4., "P/2": 2., "P/4": 1.}[end], 1e-6)
        total = force + (time if load else 0.)
        folder.succeed(CANTILEVER, **dict(strip, Study__Name="pushed"),
                       Loads__Edge_forces=f"u=1: 0, 0, {total}")
        check_near("w", w, folder.values("pushed_path.csv", "w")[-1], 1e-6)


@test(1, 2)
def points_with_multigrid(folder):
    """Multigrid, too, sees that a point was passed, though nothing excites the
    mode and the coarser mesh buckles at a higher load, and goes on where the
    path is stable again. The points are those of the direct solver."""
    strip = {**SHORT, "Study__Degrees": "2", "Study__Refinements": "1",
             "Mid-surface__Subdivisions": "2, 1", "Analysis__End_time": "1.03",
             "Analysis__Switch_branch": "none", "Analysis__Time_step": "0.51",
             "Analysis__Maximum_time_step": "0.51"}
    arch = {**COARSE, "Study__Degrees": "2", "Study__Name": "strip"}
    cases = [(STRIP, strip, 1), (ARCH, arch, 2)]
    for file, settings, n_points in cases[:1 if folder.ranks > 1 else 2]:
        settings["Analysis__Maximum_points"] = str(n_points)
        folder.succeed(file, **settings, Linear_solver__Solver="direct")
        points = folder.rows("strip_points.csv")
        check(len(points) == n_points, f"points {points}")
        text = folder.succeed(file, **settings,
                              Linear_solver__Solver="multigrid",
                              Linear_solver__Coarsest_unknowns="50")
        check_same("points", folder.rows("strip_points.csv"), points, 1e-6)
        check(text.count("takes over where the matrix is indefinite") == 1,
              f"no change of solvers: {text}")


@test(1, 2)
def interrupted(folder):
    """A path that was stopped halfway is the whole path; its points, too."""
    whole = dict(COARSE, Study__Refinements="0", Analysis__Checkpoint_steps="1")
    if folder.ranks > 1:
        whole["Analysis__Maximum_points"] = "1"
    folder.succeed(ARCH, **whole)
    rows, points = folder.rows("case_path.csv"), folder.rows("case_points.csv")
    folder.succeed(ARCH, **whole,
                   Analysis__Maximum_steps="7" if folder.ranks == 1 else "3")
    folder.succeed(ARCH, "--restart", **whole)
    check_same("path", folder.rows("case_path.csv"), rows, 1e-9)
    check_same("points", folder.rows("case_points.csv"), points, 1e-6)
    if folder.ranks > 1:
        return
    controlled = dict(whole, Analysis__Type="displacement control",
                      Analysis__Control="w",
                      Analysis__Control_values="0, -0.4, -0.1, -0.3",
                      Analysis__Control_step="0.1")
    folder.succeed(ARCH, **controlled)
    rows = folder.rows("case_path.csv")
    folder.succeed(ARCH, **controlled, Analysis__Maximum_steps="5")
    folder.succeed(ARCH, "--restart", **controlled)
    check_same("control", folder.rows("case_path.csv"), rows, 1e-9)


@test(1)
def load_cases(folder):
    """Half of the load first, then the rest by arc length: the same curve."""
    folder.succeed(ARCH, **dict(COARSE, Study__Name="first"),
                   Analysis__Type="static", Analysis__End_time="0.4")
    folder.succeed(ARCH, **COARSE, Analysis__Start_from="output/first",
                   Analysis__Load_factor="0.4 + t", Analysis__End_time="0.6")
    first = folder.rows("case_path.csv")[0]
    check_near("w", first["w"], folder.values("first_path.csv", "w")[-1], 1e-9)
    points = folder.rows("case_points.csv")
    check(len(points) == 2, f"points {points}")
    for point, expected in zip(points, (LARGEST, SMALLEST)):
        check_near(point["kind"], point["load_factor"], expected, 1e-4)


@test(1)
def refined(folder):
    """A path whose mesh is refined passes the same limit points, also if it is
    stopped after the first refinement and goes on."""
    settings = dict(COARSE, Study__Refinements="0",
                    Adaptive_refinement__Cycles="2",
                    Adaptive_refinement__Every_steps="2")
    text = folder.succeed(ARCH, **settings, Analysis__Maximum_points="2")
    check(text.count("refined after step") == 2, text)
    points = folder.rows("case_points.csv")
    check(len(points) == 2, f"points {points}")
    for point, expected in zip(points, (LARGEST, SMALLEST)):
        check_near(point["kind"], point["load_factor"], expected, 1e-3)
    rows = folder.rows("case_path.csv")
    folder.succeed(ARCH, **settings, Analysis__Maximum_steps="3")
    folder.ranks = 2
    folder.succeed(ARCH, "--restart", **settings, Analysis__Maximum_steps="5")
    check_same("path", folder.rows("case_path.csv"), rows[:6], 1e-9)


def thrust_frequency(load):
    """The lowest omega of w,xxxx + P w,xx = rho h omega^2 w, clamped at 0, with
    w,xx = 0 and w,xxx + P w,x = 0 at 1; rho h = 0.002, P = load pi^2/4."""
    p = load * math.pi ** 2 / 4

    def determinant(omega):
        root = math.sqrt(p * p / 4 + 0.002 * omega ** 2)
        a, b = math.sqrt(root - p / 2), math.sqrt(root + p / 2)
        sh, ch, s, c = math.sinh(a), math.cosh(a), math.sin(b), math.cos(b)
        moment = a * a * ch + b * b * c, a * a * sh + a * b * s
        force = (a ** 3 * sh - b ** 3 * s + p * (a * sh + b * s),
                 a ** 3 * ch + a * b * b * c + p * (a * ch - a * c))
        return moment[0] * force[1] - moment[1] * force[0]

    low, high = 1., 85.
    for _ in range(60):
        middle = (low + high) / 2
        if determinant(middle) * determinant(low) > 0.:
            low = middle
        else:
            high = middle
    return low


@test(1, 2)
def modes_of_a_state(folder):
    """At a state near the bifurcation the buckling load is the bifurcation;
    frequencies are those of a strut under that thrust."""
    def find(kind, start, *column, **settings):
        folder.succeed(STRIP, **dict(SHORT, Study__Name="modes"),
                       Analysis__Type=kind, Analysis__Switch_branch="none",
                       Analysis__Start_from=f"output/{start}",
                       Analysis__Number_of_modes="1", **settings)
        return folder.values("modes_modes.csv", column[0])[0]

    folder.succeed(STRIP, **dict(SHORT, Analysis__End_time="0.9"),
                   Analysis__Switch_branch="none",
                   Analysis__Maximum_time_step="0.4")
    check_near("load", find("buckling", "strip", "load_factor"), 1., 1e-6)
    if folder.ranks > 1:
        return
    folder.succeed(STRIP, **dict(SHORT, Study__Name="half",
                                 Analysis__End_time="0.4"),
                   Analysis__Type="static", Analysis__Switch_branch="none",
                   Analysis__Maximum_time_step="0.4")
    for name, load in (("half", 0.4), ("strip", 0.9)):
        check_near(name, find("vibration", name, "omega", Section__Density="1"),
                   thrust_frequency(load), 1e-4)
    folder.fail(STRIP, "--check", **dict(SHORT, Study__Name="modes"),
                Analysis__Type="buckling", Analysis__Switch_branch="none",
                Analysis__Start_from="output/strip",
                Analysis__Prestress="linear",
                expect=("Analysis/Prestress", "Start from"))


TUBE = """\
set Constants = L = 0.3, D = 1e-6/12/(1 - 0.3^2)
subsection Study
  set Degrees     = 3
  set Refinements = 0
  set Write VTU   = false
end
subsection Mid-surface
  set Surface      = expression
  set Subdivisions = 1, 6
  subsection expression
    set Position = u, cos(v), -sin(v)
    set Range u  = 0, L
    set Range v  = 0, pi/2
  end
end
subsection Section
  set Young's modulus = 1
  set Poisson's ratio = 0.3
  set Thickness       = 0.01
end
subsection Discretization
  set Kinematics = finite
end
subsection Analysis
  set Type            = static
  set End time        = 0.4
  set Time step       = 0.4
  set Number of modes = 1
end
subsection Boundary conditions
  set Edges = u=0, u=1, v=0, v=1: symmetry
end
subsection Loads
  set Pressure         = -4*D
  set Pressure follows = true
end
"""


@test(1)
def following_pressure(folder):
    """A long tube buckles at p R^3/D = 3, whose pressure grows with t: the
    load's own stiffness is part of the tangent and of its rate."""
    folder.write("tube.prm", TUBE)
    folder.succeed("tube.prm")
    folder.succeed("tube.prm", Study__Name="modes", Analysis__Type="buckling",
                   Analysis__Start_from="output/tube")
    check_near("t", folder.values("modes_modes.csv", "load_factor")[0], 0.75,
               5e-4)


if __name__ == "__main__":
    main(TESTS)
