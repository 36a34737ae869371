#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Shells of rubber and of metal that yields against doc/materials.md, coarse.

  materials.py NACRE N_RANKS NAME   run one test
  materials.py --list               names and numbers of ranks, a line each
"""
import math
import pathlib
import sys

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "runs"))
from runs import check, main, near  # noqa: E402  (found by the line above)

FILES = HERE.parents[1] / "prm/materials"
COARSE = {"Study__Name": "case", "Study__Write_VTU": "false",
          "Study__Degrees": "3"}
TESTS = {}


def test(*ranks):
    """Register a test and the numbers of ranks that it runs on."""
    def add(function):
        TESTS[function.__name__] = (function, ranks)
        return function
    return add


def check_path(folder, control, column, table, tolerance):
    """The value of `column` at those of `control`, on the way."""
    rows = folder.rows("case_path.csv")
    for at, expected in table:
        row = min(rows, key=lambda row: abs(float(row[control]) - at))
        check(near(float(row[control]), at, 1e-6),
              f"{control} = {at} isn't on the path: {rows}")
        check(near(float(row[column]), expected, tolerance),
              f"{column} at {control} = {at}: {row}, not {expected}")


def check_ratio(folder, column, tolerance):
    """The last value of `column` over its reference."""
    row = folder.rows("case.csv")[-1]
    check(abs(float(row[column]) - 1) <= tolerance, f"{column}: {row}")


@test(1)
def balloon(folder):
    """A sphere with bending; without, at the limit point l = 7^(1/6)."""
    folder.succeed(str(FILES / "balloon.prm"), **COARSE)
    check_path(folder, "w", "time",
               [(0.1, 0.79192692), (0.3, 1.21973309), (0.5, 1.21627078),
                (1, 0.98437256)], 3e-5)
    folder.succeed(str(FILES / "balloon.prm"), "--set",
                   "Constants=R = 1, h0 = 0.001", **COARSE,
                   Analysis__Control_values="0.4")
    point = folder.rows("case_points.csv")[0]
    check(point["kind"] == "limit"
          and near(float(point["time"]), 1.2394629, 1e-5), f"{point}")


@test(1)
def inflated_sheet(folder):
    folder.succeed(str(FILES / "inflated_sheet.prm"), **COARSE,
                   Study__Refinements="0")
    check_path(folder, "w", "time",
               [(0.1, 0.0137795), (0.2, 0.0998504), (0.5, 0.8980017),
                (0.8, 1.644119), (1, 1.839280), (1.5, 1.80358)], 1e-3)


@test(1)
def cone(folder):
    """The force on a quarter of the rim."""
    folder.succeed(str(FILES / "cone.prm"), **{**COARSE,
                                               "Study__Degrees": "4"})
    check_path(folder, "w", "F",
               [(-0.2, -0.25 * 0.0949637), (-1., -0.25 * 0.0208614),
                (-1.4, -0.25 * 0.0426004), (-1.6, -0.25 * 0.0169149)], 2e-4)


@test(1)
def impossible_strains(folder):
    """A sheet pressed to no length at all: steps are repeated shorter until
    the last possible one, which is kept."""
    folder.write("sheet.prm", """
subsection Section
  set Type = neo-Hookean
  subsection Neo-Hookean
    set Shear modulus = 1
  end
end
subsection Discretization
  set Kinematics = finite
end
subsection Boundary conditions
  set Edges = u=0, v=0: symmetry; u=1: x = -t, z = 0, rotation = 0
end
subsection Analysis
  set Type        = static
  set Load factor = 1
  set End time    = 1.5
  set Time step   = 0.5
  set Minimum time step = 0.1
end
subsection Quantities
  set Quantities = w = displacement x at (1, 0, 0); U = energy
end
""")
    text = folder.fail("sheet.prm", **COARSE,
                       expect=("infinite or not a number", "last good state"))
    check("trying half the step" in text, text)
    values = folder.values("case_path.csv", "U")
    check(len(values) >= 2 and all(math.isfinite(U) for U in values), text)


@test(1)
def springback(folder):
    folder.succeed(str(FILES / "springback.prm"), **COARSE)
    check_ratio(folder, "ratio", 1e-4)
    check_ratio(folder, "ratio_s", 1e-4)


@test(1)
def cyclic_strip(folder):
    """A strip that hardens, pulled to four times the strain of first yielding,
    pressed as far, and pulled again: force, energies, what it remembers."""
    E, s_y, H, h, b = 1., 1e-3, 0.1, 0.1, 0.2
    folder.write("strip.prm", f"""
subsection Mid-surface
  set Surface      = plate
  set Subdivisions = 1
  subsection plate
    set Size = 1, {b}
  end
end
subsection Section
  set Type            = elastoplastic
  set Young's modulus = {E}
  set Thickness       = {h}
  subsection Plasticity
    set Yield stress      = {s_y}
    set Hardening modulus = {H}
    set Points            = 5
  end
end
subsection Discretization
  set Kinematics = linear
end
subsection Boundary conditions
  set Edges  = u=0, v=0: symmetry; u=1: x = {4 * s_y / E}
  set Points = (0, 0, 0): z = 0
end
subsection Analysis
  set Type         = static
  set Load factor  = 2/pi*asin(sin(pi*t/2))
  set End time     = 5
  set Time step    = 1
end
subsection Quantities
  set Quantities = F = reaction x of u=1; U = energy; \\
    D = plastic dissipation; \\
    a = accumulated plastic strain top at (0.4, 0.1, 0); \\
    A = largest accumulated plastic strain bottom
end
""")
    folder.succeed("strip.prm", **{**COARSE, "Study__Degrees": "2"},
                   Study__Refinements="0")
    stress = s_y + E * H / (E + H) * 3 * s_y / E
    for k in range(2):  # The other way, by twice the strain
        stress += E * H / (E + H) * (8 * s_y / E - 2 * stress / E)
    a = (stress - s_y) / H
    energy = stress**2 / (2 * E) + s_y * a + H * a**2 / 2
    found = folder.rows("case_path.csv")[-1]
    for column, expected in (("F", stress * h * b), ("U", energy * h * b),
                             ("D", s_y * a * h * b), ("a", a), ("A", a)):
        check(near(float(found[column]), expected, 1e-8),
              f"{column}: {found}, not {expected}")


@test(1)
def plastic_tube(folder):
    folder.succeed(str(FILES / "plastic_tube.prm"), **COARSE)
    check_ratio(folder, "ratio", 2e-4)
    check_ratio(folder, "ratio_d", 2e-4)


@test(1)
def plastic_plate(folder):
    """w in units of M_p a^2/D at the load q a^2/M_p."""
    unit = 1e-6 * 0.02**2 / 4 / (0.02**3 / 12 / (1 - 0.3**2))
    folder.succeed(str(FILES / "plastic_plate.prm"),
                   **{**COARSE, "Study__Degrees": "4"},
                   Discretization__Kinematics="linear",
                   Section__Plasticity__Points="9",
                   Analysis__Control_step=str(0.4 * unit),
                   Analysis__Control_values=", ".join(
                       str(w * unit) for w in (0.2599, 0.4777, 1.087, 3)))
    check_path(folder, "w", "time",
               [(0.2599 * unit, 4), (0.4777 * unit, 5.5),
                (1.087 * unit, 6.3), (3 * unit, 6.5)], 5e-3)


@test(1)
def square_plate(folder):
    """Near its limit load 25.0 M_p/a^2, from coarse steps."""
    folder.succeed(str(FILES / "limit_load.prm"),
                   **{**COARSE, "Study__Degrees": "4",
                      "Mid-surface__Subdivisions": "2"},
                   Section__Plasticity__Points="5",
                   Analysis__Control_step="0.2*w0",
                   Analysis__Control_values="0.6*w0")
    load = float(folder.rows("case_path.csv")[-1]["time"])
    check(near(load, 25.0, 1e-2), f"limit load {load}, not 25.0")


@test(1, 2)
def never_yields(folder):
    """In small displacements a metal that doesn't yield is the linear section:
    supports that turn, edge moments, symmetry."""
    rows = {}
    for kind in "isotropic", "elastoplastic":
        folder.write("shell.prm", f"""
subsection Mid-surface
  set Surface      = cylinder
  set Subdivisions = 3
  subsection cylinder
    set Radius      = 2
    set Angle range = 0, 60
    set Axial range = 0, 2
  end
end
subsection Section
  set Type            = {kind}
  set Young's modulus = 100
  set Thickness       = 0.1
  subsection Plasticity
    set Yield stress = 1e9
  end
end
subsection Boundary conditions
  set Edges = u=0: clamped; u=1: rotation = 0.2*t; v=0: symmetry
end
subsection Loads
  set Force per area = 0, 0.1, -0.01
  set Edge moments   = v=1: 0.05
end
subsection Analysis
  set Type = static
end
subsection Quantities
  set Quantities = w = maximum displacement; U = energy; \\
                   M = moment 11 at (1.9, 0.6, 1)
end
""")
        folder.succeed("shell.prm", **COARSE, Study__Refinements="0",
                       Study__Penalties="5", Analysis__Time_step="0.5")
        rows[kind] = folder.rows("case.csv")[-1]
    linear, metal = rows["isotropic"], rows["elastoplastic"]
    for column in "w", "U", "M":
        check(near(float(metal[column]), float(linear[column]), 1e-9),
              f"{column}: {metal}, not {linear}")


if __name__ == "__main__":
    main(TESTS)
