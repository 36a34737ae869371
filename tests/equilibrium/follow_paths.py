#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Follow load paths and check their steps.

  follow_paths.py NACRE CASE    run a case
  follow_paths.py --list        their names

A case has a parameter file, parameters to set, and a function that checks the
rows of the path, each a dictionary of the columns of <name>_path.csv. A path
that ends with an error fails always.
"""
import argparse
import csv
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import run_study  # noqa: E402  (found by the line above)

TIMEOUT = 600 if "NACRE_SLOW" in os.environ else 120


def check(condition, text):
    if not condition:
        raise run_study.Failure(text)


def check_near(name, value, expected, tolerance):
    """`tolerance` is relative to `expected`."""
    print(f"{name}: {value:.8g}, expected {expected:.8g}")
    check(abs(value - expected) <= tolerance * abs(expected),
          f"{name}: {value:.8g} differs from {expected:.8g} by more than "
          f"{tolerance:g} of it")


def check_iterations(rows, most, first=1):
    """In each row from `first` on."""
    for row in rows[first:]:
        check(row["iterations"] <= most,
              f"t = {row['time']:g}: {row['iterations']:g} iterations")


def check_stable(rows):
    for row in rows:
        check(row["negative_pivots"] == 0, f"t = {row['time']:g}: unstable")


def at(rows, time):
    found = [row for row in rows if abs(row["time"] - time) < 1e-9]
    check(len(found) == 1, f"{len(found)} rows at t = {time}")
    return found[0]


# --- Newton's method stops at round-off -------------------------------------
def held(rows):
    check_iterations(rows, 2, first=3)
    check_near("w", rows[-1]["w"], -4.790409, 1e-6)
    check_near("w, held", rows[-1]["w"], rows[2]["w"], 1e-11)


def later(rows):
    check_iterations(rows[:3], 2)
    check(abs(rows[2]["w"]) < 1e-9, "moved without a load")
    check_near("w", rows[-1]["w"], -4.790409, 1e-6)


def stretched(rows):
    check_iterations(rows, 2, first=3)
    check(rows[-1]["u"] == rows[2]["u"] != 0., "not held")


def small_steps(rows):
    """They are solved, too: the displacement is smooth in the load."""
    check_iterations(rows, 3)
    slopes = [(b["w"] - a["w"]) / (b["load_factor"] - a["load_factor"])
              for a, b in zip(rows[1:], rows[2:])]
    for slope in slopes[1:]:
        check_near("dw/dp", slope, slopes[0], 1e-3)


def tiny_steps(rows):
    """A step of 1e-8 of the load, of 1e-6 of the thickness, is a step."""
    check_near("dw/dt", (rows[2]["w"] - rows[1]["w"]) / 1e-8, -13.093856, 1e-4)


def at_rest(rows):
    check_iterations(rows[-20:], 3)
    check_near("w", rows[-1]["w"], rows[-2]["w"], 1e-9)
    check(rows[-1]["T"] < 1e-12, "still moving")


# --- Dynamic relaxation ------------------------------------------------------
def roof(w):
    """The state beyond the limit point, as two steps of 1500 find it, too."""
    def check_roof(rows):
        check(len(rows) == 2, "cut back")
        check_stable(rows)
        check_iterations(rows, 40)
        check_near("w", rows[-1]["w"], w, 1e-6)
    return check_roof


def inflated(rows):
    check(len(rows) == 2, "cut back")
    check_stable(rows)
    check_iterations(rows, 140)


def compressed_plate(rows):
    """Series: the path of a plate that is imperfect by nothing."""
    check_stable(rows)
    n_cr, h = 1518.40 * 250, 5.
    for time, force, w in ((0.3, 1.08007, 0.58677), (0.5, 1.38380, 1.2979)):
        row = at(rows, time)
        check_near("N/N_cr", row["N"] / n_cr, force, 2e-3)
        check_near("w/h", abs(row["w"]) / h, w, 5e-3)
    # Before it buckles, it stays plane.
    check(abs(at(rows, 0.2)["w"]) < 1e-6, "bent too early")


def elastica(rows):
    """Half of a pinned strut is a clamped-free one; ends, not its middle."""
    check_stable(rows)
    check_near("shortening", -rows[-1]["u"], 1.79704060, 3e-3)
    check_near("lateral", abs(rows[-1]["w"]), 2.54267079, 3e-3)


def ring(rows):
    """The elastica of a ring, inextensible, of two lobes: R = 1, EI = 1."""
    check_stable(rows)
    for time, long, short in ((0.7, 1.30855814, 0.49523512),
                              (0.8, 1.35686902, 0.29133701),
                              (1.0, 1.37162233, 0.04395922)):
        axes = sorted((1. + at(rows, time)["w"], 1. + at(rows, time)["v"]))
        check_near("long half axis", axes[1], long, 1e-3)
        check_near("displacement along the short one", 1. - axes[0], 1. - short,
                   1e-3)
    check(abs(at(rows, 0.5)["w"]) < 1e-4, "buckled too early")


def pinched_cylinder(rows):
    """It wrinkles, and jumps three times; without the push along unstable
    modes the jumps took 40, 42 and 48 iterations, the path 390."""
    check(len(rows) == 21, "cut back")
    check_stable(rows)
    check_iterations(rows, 39)
    n_iterations = sum(row["iterations"] for row in rows)
    print(f"iterations: {n_iterations:g}")
    check(n_iterations <= 375, f"{n_iterations:g} iterations")
    check_near("w", rows[-1]["w"], -79.50031, 1e-5)


def cylinder(rows):
    check_stable(rows)
    n_iterations = sum(row["iterations"] for row in rows)
    print(f"iterations: {n_iterations:g}")
    check(n_iterations <= 150, f"{n_iterations:g} iterations")


BUCKLING = {"Constants": "L = 250, Ncr = 1518.40, imp = 0, "
                         "dcr = 1518.40*250/(2.1e5*5)",
            "Analysis/Type": "relaxation", "Analysis/Time step": "0.1",
            "Analysis/End time": "0.5"}
ROOF = {"Analysis/Type": "relaxation", "Analysis/Time step": "1"}
FIGURE3 = HERE.parents[1] / "prm/report/figure3.prm"
BENCHMARKS = HERE.parents[1] / "prm/benchmarks"

# name: file, parameters, check, and numbers of ranks if not only one
# --- Arc length -----------------------------------------------------------
def check_points(rows, expected, tolerance):
    """`expected`: kind, load factor, negative pivots before and after."""
    check(len(rows.points) == len(expected), f"{len(rows.points)} points")
    for point, (kind, factor, before, after) in zip(rows.points, expected):
        check(point["kind"] == kind, f"{point['kind']}, not {kind}")
        check((float(point["pivots_before"]), float(point["pivots_after"])) ==
              (before, after), f"pivots at {point['load_factor']}")
        check_near(kind, float(point["load_factor"]), factor, tolerance)


def arch(rows):
    """The largest and the smallest load of a semi-analytical solution."""
    check(len(rows) < 30, f"{len(rows)} rows")
    check_points(rows, [("limit", 52.580408 / 60., 0, 1),
                        ("limit", 46.188430 / 60., 1, 0)], 2e-6)
    check(abs(rows[-1]["time"] - 1.) < 1e-12, "not at the end time")


def first_limit(rows):
    check_points(rows, [("limit", 52.580408 / 60., 0, 1)], 1e-4)


def displaced_arch(rows):
    """Prescribed displacements move with t, too."""
    check_stable(rows)
    for row in rows:
        check(abs(row["w"] + 0.25 * row["time"]) < 1e-12, "not as prescribed")
    check(abs(rows[-1]["time"] - 1.) < 1e-12, "not at the end time")


def branch(rows):
    """The elastica with P = 2 P_cr; its strip has a thickness of L/500."""
    check_points(rows, [("bifurcation", 1., 0, 1)], 2e-6)
    check_near("shortening", rows[-1]["u"], -0.929138184, 2e-5)
    check_near("deflection", rows[-1]["w"], 0.796961416, 2e-5)


def other_branch(rows):
    """The mirror image, and the bifurcation is met by a step's middle."""
    check_points(rows, [("bifurcation", 1., 0, 1)], 2e-6)
    check(rows[-1]["w"] < -0.1, "the same side")


def snap_back(rows):
    """Sze, Liu and Lo (2004): P/3000 and -w between the limit points."""
    check_points(rows, [("limit", 0.1951, 0, 1), ("limit", -0.1289, 1, 0)],
                 2e-3)
    most = max(rows[:20], key=lambda row: -row["w"])
    check_near("-w at the first snap-back", -most["w"], 17.008, 5e-3)


CASES = {
    "arch": (BENCHMARKS / "arc_length_arch.prm", {}, arch),
    "arch.ranks": (BENCHMARKS / "arc_length_arch.prm",
                   {"Study/Degrees": "3", "Analysis/Maximum steps": "9"},
                   first_limit, 2),
    "arch.displacement": (BENCHMARKS / "arc_length_arch.prm", {
        "Boundary conditions/Edges":
            "u=0: x = 0, z = -1, rotation = 0; u=1: clamped",
        "Loads/Edge forces": "", "Analysis/Load factor": "0.25*t"},
                          displaced_arch),
    "branch": (BENCHMARKS / "arc_length_elastica.prm",
               {"Study/Refinements": "0"}, branch),
    "branch.other": (BENCHMARKS / "arc_length_elastica.prm", {
        "Study/Refinements": "1", "Study/Degrees": "3",
        "Analysis/End time": "1.01", "Analysis/Switch branch": "-1"},
                     other_branch),
    "snap_back": (BENCHMARKS / "arc_length_roof.prm", {
        "Analysis/Maximum steps": "35"}, snap_back),
    "held_load": ("roof.prm", {"Analysis/Load factor": "min(t, 0.5)",
                               "Analysis/Time step": "0.25"}, held),
    "later_load": ("roof.prm", {"Analysis/Load factor": "max(t - 0.5, 0)",
                                "Analysis/Time step": "0.25"}, later),
    "held_edge": ("strut.prm", {
        "Boundary conditions/Edges":
            "u=0: clamped; u=1: x = 0.01*min(t, 0.5), y = 0, z = 0",
        "Loads/Edge forces": "", "Analysis/Type": "static",
        "Analysis/Load factor": "1", "Analysis/Time step": "0.25",
        "Analysis/End time": "1"}, stretched),
    "small_steps": ("ring.prm", {"Analysis/Load factor": "0.58 + 0.05*t",
                                 "Analysis/End time": "0.3"}, small_steps),
    "tiny_steps": ("roof.prm", {"Analysis/Load factor": "0.5 + 1e-8*(t - 1)",
                                "Analysis/End time": "2",
                                "Analysis/Time step": "1"}, tiny_steps),
    "at_rest": ("strip.prm", {"Analysis/Time step": "0.05",
                              "Analysis/End time": "12",
                              "Analysis/Mass damping": "8"}, at_rest),
    "roof.p2_2": ("roof.prm", {**ROOF, "Study/Degrees": "2",
                               "Mid-surface/Subdivisions": "2, 2"},
                  roof(-28.24692)),
    "roof.p2_6": ("roof.prm", {**ROOF, "Study/Degrees": "2",
                               "Mid-surface/Subdivisions": "6, 6"},
                  roof(-28.60295)),
    "roof.p3_3": ("roof.prm", {**ROOF, "Mid-surface/Subdivisions": "3, 3"},
                  roof(-28.70883)),
    "roof.p3_4": ("roof.prm", ROOF, roof(-28.71590)),
    "pillow": ("pillow.prm", {"Analysis/End time": "1e-3"}, inflated),
    "plate": ("plate.prm", BUCKLING, compressed_plate),
    "plate.ranks": ("plate.prm", BUCKLING, compressed_plate, 2),
    "strut": ("strut.prm", {"Study/Degrees": "3", "Analysis/Time step": "1",
                            "Analysis/Load factor": "1.1*t",
                            "Analysis/End time": "1"}, elastica),
    "ring": ("ring.prm", {
        "Analysis/Type": "relaxation", "Analysis/Time step": "0.1",
        "Quantities/Quantities": "w = displacement x at (R, 0, 0); "
                                 "v = displacement y at (0, R, 0)"}, ring),
    "pinched_cylinder": ("pinched_cylinder.prm", {}, pinched_cylinder),
    "cylinder": (FIGURE3, {"Mid-surface/Subdivisions": "16, 10",
                           "Analysis/Minimum time step": "0.2"}, cylinder),
}


class Rows(list):
    """The rows of a path, and its points."""
    points = ()


def read_path(path, points):
    with open(path, newline="", encoding="utf-8") as file:
        rows = Rows({name: float(value) for name, value in row.items()}
                    for row in csv.DictReader(file))
    if points.exists():
        with open(points, newline="", encoding="utf-8") as file:
            rows.points = list(csv.DictReader(file))
    return rows


def run_case(nacre, file, parameters, check_rows, n_ranks=1):
    settings = {"Study/Write VTU": "false", **parameters}
    arguments = argparse.Namespace(
        nacre=nacre, prm=HERE / file, timeout=TIMEOUT,
        overrides=[f"{name}={value}" for name, value in settings.items()])
    with tempfile.TemporaryDirectory() as folder:
        run_study.run_nacre(arguments, n_ranks, folder)
        output = pathlib.Path(folder, "output")
        rows = read_path(output / "study_path.csv", output / "study_points.csv")
    check_rows(rows)


if __name__ == "__main__":
    sys.exit(run_study.run_cases(CASES, run_case, __doc__))
