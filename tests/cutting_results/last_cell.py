#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""last_cell.py NACRE FILE.prm: what files for ParaView show of the cell in
which a cut ends. Williams' fields around (0, 0), in the middle of a cell of
0.4, open it as the square root of the distance, read back by VTK."""
import math
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
import cut_fields  # noqa: E402  (leaves no __pycache__)


def check(runs):
    E, nu, h, K_1, K_2, M, Q = 1e5, .3, .1, 1., .6, .002, .0015
    kappa, g = (3 - nu) / (1 + nu), (1 + nu) / E / math.sqrt(2 * math.pi)
    A, B = 3 * (1 - nu) / (7 + nu), 3 * (1 - nu) / (5 + 3 * nu)
    D = E * h**3 / 12 / (1 - nu**2)
    constants = dict(a=0, b=0, Y=E, m=nu, H=h, k=kappa, g=g, K1=K_1, K2=K_2,
                     M=M, Q=Q, A=A, B=B, D=D)
    runs.run("tip", **{
        "Study/Degrees": "2", "Mid-surface/Subdivisions": "5",
        "Quantities/Quantities": "L = length of crack",
        "Constants": ", ".join(f"{k} = {v!r}" for k, v in constants.items())})
    grid = cut_fields.read(runs.output("tip_p2_r0.vtu"))
    moved = grid.GetPointData().GetArray("displacement")
    covered, lips = 0., {-1: {}, 1: {}}
    for k in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(k)
        points = [cell.GetPointId(i) for i in range(cell.GetNumberOfPoints())]
        at = [grid.GetPoint(i) for i in points]
        covered += cut_fields.area(at[:4])
        side = 1 if sum(x[1] for x in at) > 0. else -1
        for i, (x, y, _) in zip(points, at):
            if -.201 < x < -.01 and abs(y) < 1e-6:
                lips[side][round(x, 5)] = moved.GetTuple(i)
    exact = {x: (0., 2 * g * math.sqrt(-x) * K_1 * (kappa + 1),
                 -2 * (-x)**1.5 * Q * (1 + B)) for x in lips[1]}
    error = max((abs(lips[1][x][c] - lips[-1][x][c] - exact[x][c])
                 / abs(exact[-.2][c]) for x in exact for c in (1, 2)),
                default=1.) if -.2 in exact else 1.
    return {"the cells cover the plate": abs(covered - 4.) < 1e-5,
            "the last cell opens between its edge and the tip":
            lips[1].keys() == lips[-1].keys() and len(lips[1]) >= 2
            and error < .02}


def main():
    nacre, prm = (str(pathlib.Path(name).resolve()) for name in sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        checks = check(cut_fields.Runs(nacre, prm, folder))
    for name, good in checks.items():
        print(f"{'ok    ' if good else 'FAILED'} {name}")
    return 0 if all(checks.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
