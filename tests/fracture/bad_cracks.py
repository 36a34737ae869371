# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Tips that are none, and plateaus that hold more than a straight crack;
tests/parameters/bad_input.py runs them."""
import pathlib

WITH_GOOD_CASES = False
FOLDER = pathlib.Path(__file__).resolve().parents[2] / "prm/fracture"
MESH = FOLDER.parent / "meshes/cracked_plate.msh"
BASE = (FOLDER / "cracked_plate.prm").read_text(encoding="utf-8").replace(
    "../meshes/cracked_plate.msh", str(MESH)).replace("2, 3", "2").replace(
    "0, 1", "0")
QUANTITIES = "Quantities/Quantities"
CASES = {}


def case(name, quantity, expect, settings=None, args=()):
    assert name not in CASES, name
    CASES[name] = dict(expect=[QUANTITIES, "'q'", *expect], change=None,
                       prm=BASE, args=list(args), folder={}, code=1,
                       settings={QUANTITIES: f"q = {quantity}",
                                 **(settings or {})})


case("tip_inside", "K_I of tip (a + 1/18, 0, 0)",
     ["no crack ends", "inside the shell", "Slits"], args=["--check"])
case("tip_at_corner", "K_I of tip (1, 1, 0)",
     ["no crack ends", "angle of 90 degrees"])
case("tip_at_lips", "K_I of tip (0, 0, 0)", ["4 edges of the boundary"])
case("tip_no_vertex", "K_I of tip (0.51, 0.01, 0)",
     ["no vertex of the mesh", "nearest one is (0.5, 0, 0)"])
case("tip_no_point", "K_I at (0.5, 0, 0)", ["K_I of tip (x, y, z)"])
case("radii_one", "K_I of tip (a, 0, 0) radii 0.2", ["write two"])
case("radii_order", "K_I of tip (a, 0, 0) radii 0.2, 0.1",
     ["0.2 and 0.1", "smaller than the outer one"])
case("plateau_beyond_edge", "K_I of tip (a, 0, 0) radii 0.2, 0.8",
     ["another edge", "smaller radii"],
     {"Boundary conditions/Points":
      "(1, 1, 0): y = 0, z = 0; (1, -1, 0): z = 0"})
case("plateau_point_force", "K_I of tip (a, 0, 0)",
     ["a point force", "smaller radii"],
     {"Loads/Point forces": "(0.6, 0.1, 0): 0, 0, 1"})
case("plateau_lips_held", "K_I of tip (a, 0, 0)",
     ["lip of the crack is supported"],
     {"Boundary conditions/Edges": "left: symmetry; upper: y = 0"})
case("intensity_finite", "K_I of tip (a, 0, 0)",
     ["Kinematics = linear", "energy release rate is known"],
     {"Discretization/Kinematics": "finite", "Analysis/Type": "static",
      "Constants": "a = 0.5, N = 1e-3, M = 1e-5"})
