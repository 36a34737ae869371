#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""A shell in other units has the same results in those units: no tolerance is
a length, a force or a time.

  units.py NACRE NAME   run one test
  units.py --list       their names, a line each

The texts take l, S and d, units of length, stress and density, and the time
T = l sqrt(d/S) from the constants.
"""
import csv
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import run_study  # noqa: E402  (found by the line above)

# l, S, d
UNITS = ((1e-6, 1., 1e3), (1e6, 1e6, 1.))
TOLERANCE = 1e-6
SECTION = {"Section/Young's modulus": "1000*S", "Section/Thickness": "0.05*l",
           "Section/Density": "2*d"}
PLATE = {**SECTION, "Mid-surface/Subdivisions": "2",
         "Mid-surface/plate/Size": "2*l, l"}
SHEET = {**SECTION, "Mid-surface/Surface": "expression",
         "Mid-surface/Subdivisions": "9",
         "Mid-surface/expression/Position": "u, v, 0",
         "Mid-surface/expression/Range u": "-l, l",
         "Mid-surface/expression/Range v": "-l, l",
         "Boundary conditions/Points":
             "(l, -l, 0): y = 0, z = 0; (-l, -l, 0): x = 0, y = 0, z = 0; "
             "(-l, l, 0): z = 0",
         "Loads/Edge forces": "v=1: 0, S*l, 0; v=0: 0, -S*l, 0"}
ARCH = {"Section/Young's modulus": "1.2e6*S", "Section/Poisson's ratio": "0",
        "Section/Thickness": "0.05*l",
        "Mid-surface/Surface": "expression", "Mid-surface/Subdivisions": "4, 1",
        "Mid-surface/expression/Position": "10*l*sin(u), l*v, 10*l*cos(u)",
        "Mid-surface/expression/Range u": "-0.2, 0.2",
        "Boundary conditions/Edges": "u=0, u=1: fixed; v=0, v=1: y = 0",
        "Loads/Point forces": "(0, l/2, 10*l): 0, 0, -10*S*l^2",
        "Discretization/Kinematics": "finite", "Study/Degrees": "3"}
RING = "of crack end radii 0.1*l, 0.4*l"

# NAME: settings, quantities with their powers of l, S and T
TESTS = {
    "vault": ({
        **SECTION, "Mid-surface/Surface": "cylinder",
        "Mid-surface/cylinder/Radius": "2*l",
        "Mid-surface/cylinder/Angle range": "0, 90",
        "Mid-surface/cylinder/Axial range": "0, l",
        "Boundary conditions/Edges": "u=0: diaphragm; u=1: symmetry",
        "Boundary conditions/Points":
            "(2*l, 0, 0): y = 0; (0, 2*l, 0): z = 0, y = 0",
        "Loads/Gravity": "0, 0, -0.1*l/T^2", "Loads/Pressure": "0.1*S",
        "Loads/Edge moments": "v=0: 0.01*S*l^2"}, {
            "U = energy": (3, 1, 0), "R = reaction y of all": (2, 1, 0),
            "p = largest principal stress top": (0, 1, 0),
            "m = largest von Mises stress bottom": (0, 1, 0)}),
    "refinement": ({
        **SECTION, "Mid-surface/Surface": "L-shaped plate",
        "Mid-surface/Subdivisions": "2",
        "Mid-surface/L-shaped plate/Size": "l",
        "Boundary conditions/Edges": "x=0, y=0: clamped",
        "Loads/Force per area": "0, 0, -0.1*S",
        "Adaptive refinement/Cycles": "3", "Linear solver/Solver": "multigrid",
        "Linear solver/Coarsest unknowns": "100"}, {
            "U = energy": (3, 1, 0)}),
    "arch": ({
        **ARCH, "Analysis/Type": "arc length", "Analysis/Time step": "0.2",
        "Analysis/Maximum time step": "0.4", "Analysis/Maximum steps": "8",
        "Analysis/Switch branch": "1"}, {
            "w = displacement z at (0, l/2, 10*l)": (1, 0, 0)}),
    "buckling": ({
        **PLATE, "Boundary conditions/Edges": "left, right, v=0, v=1: z = 0",
        "Boundary conditions/Points":
            "(0, 0, 0): x = 0, y = 0; (2*l, 0, 0): y = 0",
        "Loads/Edge forces": "left: (S*l, 0, 0); right: (-S*l, 0, 0)",
        "Analysis/Type": "buckling", "Analysis/Number of modes": "2",
        "Analysis/Prestress": "tangent"}, {
            "k = load factor 2": (0, 0, 0)}),
    "vibration": ({
        **PLATE, "Analysis/Type": "vibration",
        "Analysis/Number of modes": "8"}, {
            "o = omega 8": (0, 0, -1), "f = frequency 7": (0, 0, -1)}),
    "motion": ({
        **PLATE, "Discretization/Kinematics": "finite",
        "Loads/Force per area": "0, 0, 0.3*S*sin(t/T)",
        "Analysis/Type": "dynamic", "Analysis/Time step": "0.1*T",
        "Analysis/End time": "0.4*T",
        "Analysis/Initial velocity": "0, 0.1*l/T, x/T"}, {
            "w = displacement z at (0, 0, 0)": (1, 0, 0),
            "E = total energy": (3, 1, 0), "p = momentum z": (2, 1, 1)}),
    "crack": ({
        **SHEET, "Cuts/Tips": "branch functions",
        "Mid-surface/Subdivisions": "7",
        "Cuts/Cuts": "crack: uv (-0.5*l, 0.003*l) (0.5*l, 0.003*l)",
        "Loads/Edge moments": "v=1, v=0: 0.1*S*l^2",
        "Loads/Lip forces": "crack left: 0.1*S*l, 0.1*S*l, 0"}, {
            f"K_I = K_I {RING}": (.5, 1, 0),
            f"K_M = K_M {RING}": (2.5, 1, 0),
            f"G = energy release rate {RING}": (2, 1, 0),
            f"k = kink angle {RING}": (0, 0, 0),
            "o = opening y of crack at (0, 0.003*l, 0)": (1, 0, 0)}),
    "starting_crack": ({
        **SHEET, "Cuts/Remove": "(0, 0, 0)",
        "Cuts/Cuts": "hole: uv closed expression 0.3*l*cos(2*pi*s), "
                     "0.3*l*sin(2*pi*s), 32 points",
        "Growth/Criterion": "strength", "Growth/Strength": "100*S",
        "Growth/Averaging distance": "0.4*l", "Growth/Starting cracks": "2",
        "Growth/Maximum steps": "1"}, {
            "v = displacement y at (0, l, 0)": (1, 0, 0)}),
    "yielding": ({
        **PLATE, "Section/Type": "elastoplastic",
        "Section/Plasticity/Yield stress": "S",
        "Section/Plasticity/Hardening modulus": "10*S",
        "Discretization/Kinematics": "finite",
        "Boundary conditions/Edges": "u=0: clamped",
        "Loads/Edge moments": "u=1: 1.2*S*(0.05*l)^2/6",
        "Analysis/Type": "static", "Analysis/Load factor": "min(t, 2 - t)",
        "Analysis/End time": "2", "Analysis/Time step": "0.5"}, {
            "k = rotation y at (2*l, 0, 0)": (0, 0, 0),
            "f = stress 11 top at (l, l/2, 0)": (0, 1, 0)}),
}


def rows_of(program, settings, units, folder):
    """The rows of all tables of a run, table by table."""
    length, stress, density = units
    folder.mkdir()
    (folder / "shell.prm").write_text("")
    constants = (f"l = {length}, S = {stress}, d = {density}, "
                 "T = l*sqrt(d/S)")
    command = [program, "--quiet", "shell.prm"]
    for name, value in {"Constants": constants, "Study/Write VTU": "false",
                        **settings}.items():
        command += ["--set", f"{name}={value}"]
    run = subprocess.run(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        text=True, check=False, timeout=90,
        env=dict(os.environ, OMP_NUM_THREADS="1",
                 **run_study.start_alone(folder)))
    if run.returncode != 0:
        sys.exit(f"FAILED: units {units}: {run.stdout}")
    tables = []
    for file in sorted((folder / "output").glob("*.csv")):
        with open(file, encoding="utf-8") as lines:
            tables.append(list(csv.DictReader(lines)))
    return tables


def values_of(tables, name, units, powers):
    """All of a quantity in its units."""
    length, stress, density = units
    of_length, of_stress, of_time = powers
    time = length * (density / stress)**.5
    unit = length**of_length * stress**of_stress * time**of_time
    return [float(row[name]) / unit for rows in tables for row in rows
            if row.get(name)]


def main(program, name):
    settings, quantities = TESTS[name]
    settings = {**settings, "Quantities/Quantities": "; ".join(quantities)}
    with tempfile.TemporaryDirectory() as folder:
        tables = [rows_of(program, settings, units,
                          pathlib.Path(folder) / str(k))
                  for k, units in enumerate(UNITS)]
    n_failures = 0
    for quantity, powers in quantities.items():
        column = quantity.split(" = ")[0]
        small, large = (values_of(rows, column, units, powers)
                        for rows, units in zip(tables, UNITS))
        size = max(map(abs, small))
        good = size > 0. and len(small) == len(large) and all(
            abs(a - b) <= TOLERANCE * size for a, b in zip(small, large))
        n_failures += not good
        print(f"{'passed' if good else 'FAILED'}: {column}, {len(small)} and "
              f"{len(large)} values, at last {small[-1]:.9g} in small units, "
              f"{large[-1]:.9g} in large ones")
    sys.exit(n_failures > 0)


if __name__ == "__main__":
    if sys.argv[1] == "--list":
        print(*TESTS, sep="\n")
    else:
        main(*sys.argv[1:])
