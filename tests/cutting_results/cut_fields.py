#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""cut_fields.py NACRE FILE.prm: what runs of two strips write.

Files for ParaView, read back by VTK: the cells of both strips cover them, no
value is that of the other strip, the cut is a line. The error estimate of two
strips is that of one, and nothing where the solution is a polynomial. A path
goes on from its checkpoint."""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

LENGTH, EDGE, STIFFNESS = 10., .37, 1e6 * 1e-3 / 12.


def read(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def area(corners):
    """Of a polygon in the plane."""
    return .5 * abs(sum(a[0] * b[1] - b[0] * a[1]
                        for a, b in zip(corners, corners[1:] + corners[:1])))


class Row(dict):
    """Of a table; numbers are read when they are asked for."""
    def __getitem__(self, key):
        return float(super().__getitem__(key))


class Runs:
    def __init__(self, nacre, prm, folder):
        self.nacre, self.prm, self.folder = nacre, prm, folder

    def run(self, name, *arguments, **settings):
        """The last row of the table; underscores stand for blanks."""
        command = [self.nacre, self.prm, *arguments]
        for key, value in {"Study/Name": name,
                           "Study/Output_folder": "output",
                           **settings}.items():
            command += ["--set", f"{key.replace('_', ' ')}={value}"]
        subprocess.run(command, cwd=self.folder, check=True,
                       stdout=subprocess.DEVNULL)
        with open(self.output(name + ".csv"), encoding="utf-8") as file:
            return Row(list(csv.DictReader(file))[-1])

    def output(self, file):
        return pathlib.Path(self.folder, "output", file)


def check_fields(runs):
    runs.run("strips", **{"Study/Write_VTU": "true"})
    grid = read(runs.output("strips_p3_r0.vtu"))
    moved, shear = (grid.GetPointData().GetArray(name)
                    for name in ("displacement", "q1"))
    covered, errors = [0., 0.], [0., 0.]
    for k in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(k)
        points = [cell.GetPointId(i) for i in range(cell.GetNumberOfPoints())]
        at = {i: grid.GetPoint(i) for i in points}
        side = int(sum(x[1] for x in at.values()) / len(at) > EDGE)
        covered[side] += area([at[i] for i in points[:4]])
        load = (1., -2.5)[side]
        for i, (x, _, _) in at.items():
            w = load * x * x * (3. * LENGTH - x) / (6. * STIFFNESS)
            errors[0] = max(errors[0], abs(moved.GetTuple(i)[2] - w))
            errors[1] = max(errors[1], abs(shear.GetTuple(i)[0] - load))
    cut = read(runs.output("strips_cuts.vtu"))
    length = sum(
        math.dist(*(cut.GetPoint(cut.GetCell(k).GetPointId(i))
                    for i in (0, 1))) for k in range(cut.GetNumberOfCells()))
    wrong = (abs(covered[0] - LENGTH * EDGE)
             + abs(covered[1] - LENGTH * (1. - EDGE)))
    # The files hold single precision.
    return {"both strips are covered": wrong < 1e-5,
            "displacements of each strip": errors[0] < 1e-5,
            "shear forces of each strip": errors[1] < 1e-5,
            "the cut is a line": abs(length - LENGTH) < 1e-5}


def check_estimates(runs):
    only = {"Adaptive_refinement/Cycles": "1",
            "Adaptive_refinement/Max_dofs": "1",
            "Quantities/Quantities": "U = energy"}
    exact = runs.run("exact", **only)
    only.update({"Section/Poisson's_ratio": ".3", "Study/Degrees": "2",
                 "Loads/Edge_forces": "u=1: 0, 0, 1"})
    # Cut along edges: the cells of two plates of half the width.
    both = runs.run("both", **only, **{
        "Mid-surface/Subdivisions": "5, 4",
        "Cuts/Cuts": "slit: uv (0, .5) (L, .5)"})
    one = runs.run("one", **only, **{
        "Mid-surface/Subdivisions": "5, 2", "Cuts/Cuts": "",
        "Mid-surface/plate/Size": "L, .5"})
    # Inside cells: halves of cells, of the same length.
    inside = runs.run("inside", **only, **{
        "Mid-surface/Subdivisions": "5, 5",
        "Cuts/Cuts": "slit: uv (0, .5) (L, .5)"})
    twice = math.sqrt(2.) * one["estimate"]
    return {"no estimate of a polynomial":
            exact["estimate"] < 1e-6 * math.sqrt(2. * exact["U"]),
            "estimate of two strips": abs(both["estimate"] - twice)
            < 1e-6 * twice,
            # Without lips it would be .77 of it.
            "estimate of halves of cells": .9 * twice < inside["estimate"]
            < 1.25 * twice}


def check_restart(runs):
    common = {"Study/Degrees": "2", "Analysis/Time_step": ".5",
              "Analysis/Checkpoint_steps": "1",
              "Quantities/Quantities": "w = displacement z at (L, 0, 0)"}
    paths = {"a path goes on":
             {"Discretization/Kinematics": "finite",
              "Loads/Edge_forces": "u=1: 0, 0, .1*if(y < y0, 1, -2.5)",
              "Analysis/Type": "static"},
             # The state of a motion holds the coefficients of the tip.
             "a motion with functions of a tip goes on":
             {"Cuts/Cuts": "slit: uv (.53*L, .37) (1.1*L, .37)",
              "Cuts/Tips": "branch functions", "Section/Density": "1e4",
              "Analysis/Type": "dynamic"}}
    checks = {}
    for name, path in paths.items():
        whole = runs.run("path", **common, **path)
        runs.run("again", **common, **path, **{"Analysis/End_time": ".5"})
        again = runs.run("again", "--restart", **common, **path)
        checks[name] = (abs(again["w"] - whole["w"]) < 1e-8 * abs(whole["w"]))
    return checks


def main():
    nacre, prm = (str(pathlib.Path(name).resolve()) for name in sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(nacre, prm, folder)
        checks = {**check_fields(runs), **check_estimates(runs),
                  **check_restart(runs)}
    for name, good in checks.items():
        print(f"{'ok    ' if good else 'FAILED'} {name}")
    return 0 if all(checks.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
