#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Tips of cuts on coarse meshes beside references; finer ones by
benchmarks/cracks.py, whose cases these are.

  cuts.py NACRE
"""
import math
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] /
                       "benchmarks"))
import cracks  # noqa: E402  (found by the line above)

failures = 0


def check(name, found, expected, tolerance):
    global failures
    for key, reference in expected.items():
        error = found[key] / reference - 1
        good = abs(error) <= tolerance
        failures += not good
        print(f"{'passed' if good else 'FAILED'}: {name}, {key}: "
              f"{found[key]:.6g}, expected {reference:.6g} to {tolerance:g}, "
              f"found {error:+.1e}")


def loaded_lips(nacre):
    """The infinite plate of inclined_cut.prm less its uniform stress along y,
    whose tractions the lips carry."""
    text = (cracks.PROJECT / "prm/fracture/inclined_cut.prm").read_text(
        encoding="utf-8")
    edges = " ".join(text.split("set Edges = ")[1].split("\nend")[0]
                     .replace("\\\n", "").split())
    edges = edges.replace(", y = ", " + m*x/W, y = ").replace(
        ", z = ", " - y/W, z = ")
    angle, a = math.pi / 6, .5
    root = math.sqrt(math.pi * a) * math.cos(angle)
    # h0 and W of the file
    exact = dict(K_I=root * math.cos(angle), K_II=root * math.sin(angle),
                 G=root**2 * .05 / 1e3)
    check("loaded lips in an infinite plate",
          nacre.run("inclined_cut.prm", None, {
              "Boundary conditions/Edges": edges,
              "Loads/Lip forces":
                  "crack left: 0, h0*c, 0; crack right: 0, -h0*c, 0",
              "Cuts/Tips": "branch functions", "Study/Degrees": "2",
              "Mid-surface/Grading u": "s", "Mid-surface/Grading v": "s",
              "Mid-surface/Subdivisions": "15",
              "Quantities/Quantities":
                  cracks.of_cut(".1, .45", ("K_I", "K_II"))}),
          exact, 1e-4)


def main():
    with tempfile.TemporaryDirectory() as folder:
        nacre = cracks.Nacre(sys.argv[1], folder)
        load = 1, .1

        def solve(kind="centre", a=.5, across=17, **more):
            return cracks.cut_plate(nacre, kind, a, 1., load,
                                    cells=(10, 8, across), **more)

        def exact(F_N, F_M):
            root = math.sqrt(math.pi * .5)
            K_I, K_M = load[0] * F_N * root / cracks.H, load[1] * F_M * root
            D = cracks.E * cracks.H**3 / (12 * (1 - cracks.NU**2))
            return dict(K_I=K_I, K_M=K_M, G=K_I**2 * cracks.H / cracks.E +
                        K_M**2 / (D * (1 - cracks.NU) * (3 + cracks.NU)))

        centre = solve()
        check("centre crack", centre, exact(1.3337122, 1.1323155), 7e-3)
        check("edge crack along edges of cells", solve("edge", across=18),
              exact(2.8254653, 1.134243), 4e-3)

        # The cell in which a cut ends is closed: the crack ends before it.
        check("end inside of a cell",
              solve(a=.505, mesh_a=.5, size=.01, radii="0.025, 0.45"),
              {key: centre[key] for key in ("K_I", "K_M", "G")}, 1e-9)

        step = .004
        ends = [solve(a=.5 + sign * step, size=.01)["U"] for sign in (1, -1)]
        slope = (ends[0] - ends[1]) / (2 * step)
        check("change of the energy", centre, dict(G=slope), 3e-3)
        loaded_lips(nacre)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
