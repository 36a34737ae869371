#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Paths of prm/benchmarks past limit and bifurcation points, motions, and rows
of doc/stability.md whose parameters hold semicolons.

  stability_paths.py --list
  stability_paths.py NACRE CASE

Each case runs a file on a coarse mesh and compares points of its path with the
references of doc/benchmarks/stability_paths.md and dynamics.md.
"""
import argparse
import csv
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import run_study  # noqa: E402  (found by the line above)

BENCHMARKS = HERE.parents[1] / "prm/benchmarks"


def near(what, value, expected, tolerance):
    text = f"{what}: {value}, expected {expected} (relative {tolerance})"
    print(text)
    if not abs(value - expected) <= tolerance * abs(expected):
        raise run_study.Failure(text)


def point(points, number, pivots, expected, tolerance):
    """The number-th point: pivots before and after, load factor."""
    if len(points) <= number:
        raise run_study.Failure(f"{len(points)} points")
    row = points[number]
    found = int(row["pivots_before"]), int(row["pivots_after"])
    if found != pivots:
        raise run_study.Failure(f"negative pivots {found}, not {pivots}")
    near(f"point {number}", float(row["load_factor"]), expected, tolerance)
    return row


def at(rows, time):
    return min(rows, key=lambda row: abs(row["time"] - time))


def hinged(rows, points, table):
    first = point(points, 0, (0, 1), 0.70539241, 1e-4)
    near("w there", float(first["w"]), -0.0532757, 1e-4)
    limit = point(points, 1, (1, 2), 0.79724734, 1e-4)
    near("w there", float(limit["w"]), -0.0976460, 1e-3)


def second_branch(rows, points, table):
    """The crown moves sideways, and the load falls."""
    first = point(points, 0, (0, 1), 0.70539241, 1e-4)
    after = [row for row in rows if row["w"] < float(first["w"])]
    if not (max(row["time"] for row in after) < 0.7 and
            all(abs(row["u"]) > 0.004 for row in after)):
        raise run_study.Failure(f"not on the second branch: {after}")


def deep(rows, points, table):
    """h/R = 1/100, half of the cells of the page."""
    limit = point(points, 0, (0, 1), 0.89688232, 3e-3)
    near("w there", float(limit["w"]), -113.710, 3e-3)


RING = ((3.1, 1.17338701, 0.78332389), (4, 1.35686902, 0.29133701),
        (5, 1.37162233, 0.04395922))


def ring(rows, points, table):
    for pressure, long, short in RING:
        row = at(rows, pressure)
        near(f"p = {pressure}: long semi-axis", 1 + row["c"], long, 1e-3)
        near("short semi-axis, over R", 1 + (1 + row["d"]), 1 + short, 1e-3)
    near("the walls touch", rows[-1]["d"], -1., 1e-4)


def plate(rows, points, table):
    point(points, 0, (0, 1), 1., 1e-3)
    n_cr = 3.61520e-6  # 4 pi^2 D/a^2
    near("N/N_cr", rows[-1]["N"] / (n_cr / 2), 1.38380, 2e-4)
    near("w/h", abs(rows[-1]["w"]) / 0.01, 1.2979, 1e-3)


def cap_6(rows, points, table):
    point(points, 0, (0, 1), 0.7641315, 1e-3)


def cap_8(rows, points, table):
    point(points, 0, (0, 1), 0.7588446, 1e-3)


def between(below, above):
    """A check that the tangent turns indefinite between two load levels: the
    search for the point itself takes ten seconds."""
    def check(rows, points, table):
        for time, stable in (below, True), (above, False):
            row = at(rows, time)
            print(f"t {row['time']}: {row['negative_pivots']} negative pivots")
            if (abs(row["time"] - time) > 1e-12 or
                    (row["negative_pivots"] == 0) != stable):
                raise run_study.Failure(f"t = {time}")
    return check


def static_levels(below, above, **parameters):
    return {"Analysis/Type": "static", "Analysis/Time step": "0.4",
            "Analysis/Output times": f"{below}", "Analysis/End time": above,
            "Analysis/Maximum time step": "0.4", SUBDIVISIONS: "16, 2",
            **parameters}


def sudden_plate(rows, points, table):
    """w D/(q a^4) at t/T = 0.05 and 0.1."""
    scale = 0.01**3 / 12 / 0.91 / 1e-10
    period = (0.01 / (0.01**3 / 12 / 0.91))**0.5
    for tau, expected in (0.05, 0.00179035), (0.1, 0.00558268):
        near(f"tau {tau}", at(rows, tau * period)["w"] * scale, expected, 5e-3)


def sudden_cap(rows, points, table):
    """The apex; what the first waves do needs finer meshes."""
    for time, expected in (0.3, -0.0574), (0.4, -0.0910):
        near(f"{time} ms", at(rows, time * 1e-3)["w"], expected, 1e-2)


def values(tolerance, **expected):
    """A check of columns of the study's table."""
    def check(rows, points, table):
        for name, value in expected.items():
            near(name, table[0][name], value, tolerance)
    return check


SUBDIVISIONS = "Mid-surface/Subdivisions"
STEPS = "Analysis/Maximum steps"
CASES = {
    "arch_hinged": ("path_arch_hinged", {STEPS: "11"}, hinged),
    "arch_second_branch": ("path_arch_hinged", {
        "Analysis/Switch branch": "1", STEPS: "10"}, second_branch),
    "arch_deep": ("path_arch_deep", {SUBDIVISIONS: "8, 1", STEPS: "20"}, deep),
    "ring": ("path_ring", {SUBDIVISIONS: "6, 1"}, ring),
    "plate": ("path_plate", {SUBDIVISIONS: "2, 2"}, plate),
    "cap_6": ("path_cap", {STEPS: "4"}, cap_6),
    "cap_8": ("path_cap", {
        STEPS: "4",
        "Mid-surface/file/File name": "../meshes/cap_8.msh"}, cap_8),
    # 0.8331983 and 0.2507458
    "cylinder": ("path_cylinder", static_levels(0.830, 0.836),
                 between(0.830, 0.836)),
    "cylinder_imperfect": ("path_cylinder", static_levels(
        0.2495, 0.252,
        Constants="R = 1, L = 2, n = 4, a = 0.5, "
                  "N_cl = 0.01^2/sqrt(3*(1 - 0.3^2))"),
                           between(0.2495, 0.252)),
    "sudden_plate": ("dynamics_plate", {
        SUBDIVISIONS: "2, 2", "Analysis/End time": "0.1*T"}, sudden_plate),
    "sudden_cap": ("dynamics_cap", {
        "Analysis/Time step": "4e-6", "Analysis/End time": "0.4e-3"},
                   sudden_cap),
    "cap_static": ("dynamics_cap", {
        "Analysis/Type": "static", "Analysis/Time step": "1",
        "Analysis/End time": "1"}, values(1e-4, w=-0.0365187)),
    "sphere_breathes": ("dynamics_sphere", {},
                        values(3e-4, ratio=1.)),
    "sphere_pressure": ("buckling_sphere", {
        SUBDIVISIONS: "5", "Analysis/Number of modes": "1",
        "Quantities/Quantities": "k = load factor 1"},
                        values(5e-4, k=0.9945911)),
}


def run_case(nacre, file, parameters, check_path):
    settings = {"Study/Write VTU": "false", **parameters}
    arguments = argparse.Namespace(
        nacre=nacre, prm=BENCHMARKS / (file + ".prm"), timeout=300,
        overrides=[f"{name}={value}" for name, value in settings.items()])
    with tempfile.TemporaryDirectory() as folder:
        table = run_study.run_nacre(arguments, 1, folder)
        output = pathlib.Path(folder, "output")

        def read(name):
            path = output / name
            if not path.exists():
                return []
            with open(path, newline="", encoding="utf-8") as table:
                return list(csv.DictReader(table))

        rows = [{name: float(value) for name, value in row.items()}
                for row in read("study_path.csv")]
        check_path(rows, read("study_points.csv"), table)


if __name__ == "__main__":
    sys.exit(run_study.run_cases(CASES, run_case, __doc__))
