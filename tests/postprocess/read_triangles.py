#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""read_triangles.py NACRE FILE.prm: the .vtu of a run on 6-node triangles, read
back by VTK: quadratic triangles with their mid-sides on the surface."""
import math
import pathlib
import subprocess
import sys
import tempfile

from vtkmodules.vtkCommonDataModel import VTK_LAGRANGE_TRIANGLE
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


def main():
    nacre, prm = (str(pathlib.Path(name).resolve()) for name in sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([nacre, prm, "--set", "Study/Output folder=output"],
                       cwd=folder, check=True, stdout=subprocess.DEVNULL)
        reader = vtkXMLUnstructuredGridReader()
        files = pathlib.Path(folder, "output").glob("*.vtu")
        reader.SetFileName(str(next(files)))
        reader.Update()
    grid = reader.GetOutput()
    cells = [grid.GetCell(k) for k in range(grid.GetNumberOfCells())]
    checks = {"128 cells": len(cells) == 128,
              "quadratic triangles": all(
                  cell.GetCellType() == VTK_LAGRANGE_TRIANGLE
                  and cell.GetNumberOfPoints() == 6 for cell in cells)}
    # Mid-sides on the cylinder of radius 25, not on its chords
    radii = [math.hypot(*(grid.GetPoint(k)[c] for c in (0, 2)))
             for k in range(grid.GetNumberOfPoints())]
    checks["points on the cylinder"] = max(abs(r - 25.) for r in radii) < 1e-4
    moved = grid.GetPointData().GetArray("displacement")
    lowest = min(moved.GetTuple(k)[2] for k in range(moved.GetNumberOfTuples()))
    checks["lowest point"] = abs(lowest + 0.2981767) < 1e-6
    for name, good in checks.items():
        print(f"{'ok    ' if good else 'FAILED'} {name}")
    return 0 if all(checks.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
