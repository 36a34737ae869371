# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Tips that are none, and plateaus that hold more than a straight crack;
tests/parameters/bad_input.py runs them."""
import pathlib
import re

WITH_GOOD_CASES = False
FOLDER = pathlib.Path(__file__).resolve().parents[2] / "prm/fracture"
MESH = FOLDER.parent / "meshes/cracked_plate.msh"
BASE = (FOLDER / "cracked_plate.prm").read_text(encoding="utf-8").replace(
    "../meshes/cracked_plate.msh", str(MESH)).replace("2, 3", "2").replace(
    "0, 1", "0")
QUANTITIES = "Quantities/Quantities"
CUT = (FOLDER / "inclined_cut.prm").read_text(encoding="utf-8").replace(
    "0, 1\nend", "0\nend").replace("Degrees     = 3", "Degrees     = 2")
CASES = {}


def case(name, quantity, expect, settings=None, args=(), prm=BASE):
    assert name not in CASES, name
    CASES[name] = dict(expect=[QUANTITIES, "'q'", *expect], change=None,
                       prm=prm, args=list(args), folder={}, code=1,
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


def cut(name, quantity, expect, cuts=None, args=("--check",), remove=""):
    settings = {"Cuts/Cuts": cuts, "Cuts/Remove": remove} if cuts else {}
    case(name, quantity, expect, settings, args, CUT)


cut("cut_unknown", "K_I of crck end", ["crck", "crack"])
cut("cut_closed", "energy release rate of crack end",
    ["'crack' is closed", "no tips"],
    "crack: uv closed (-0.3, -0.2) (0.3, -0.2) (0, 0.3)", remove="(0, 0, 0)")
cut("cut_ends_outside", "kink angle of crack begin",
    ["the begin of the cut 'crack'", "outside of the surface"],
    "crack: uv (-1.1, -j) (i, j)")
cut("cut_ends_on_cut", "K_M of crack end",
    ["the end of the cut 'crack'", "or on another cut"],
    "crack: uv (-i, -j) (i, j); other: uv (i - 0.2, j) (i + 0.2, j)")
cut("cut_beside_cut", "K_I of crack end radii 0.05, 0.2", ["another cut"],
    "crack: uv (-i, -j) (i, j); other: uv (-2, j + 0.05) (2, j + 0.05)", ())
cut("cut_turns", "K_T of crack end radii 0.05, 0.3",
    ["the crack turns", "smaller radii"],
    "crack: uv (-i, -j) (i - 0.1, j) (i, j)", ())
cut("cut_turns_in_cell", "K_I of crack end",
    ["turns within the cell", "refine the mesh"],
    "crack: uv (-i, -j) (i + 0.006, j + 0.002) (i + 0.007, j + 0.01)")
cut("cut_beside_tip", "K_I of crack end radii 0.05, 0.2",
    ["another tip", "'other'"],
    "crack: uv (-i, -j) (i, j); other: uv (i, j + 0.05) (i, 0.9)", ())
cut("crack_of_few_cells", "K_I of crack end radii 0.05, 0.3",
    ["another tip", "the crack 'crack' runs through 2 cells", "4 at least",
     "Study/Refinements"],
    "crack: uv (0.01, 0.01) (0.15, 0.05)", ())
case("lip_bent_in_large_rotations", "energy release rate of crack end",
     ["a moment acts on a lip of the crack", "in linear kinematics only"],
     {"Discretization/Kinematics": "finite", "Analysis/Type": "static",
      "Constants": re.search(r"Constants = (.*?)\n\n", CUT, re.S)[1]
      .replace("\\\n", "").replace("W = 1e3", "W = 1e9"),
      "Loads/Lip moments": "crack: 1e-9"}, (), CUT)
