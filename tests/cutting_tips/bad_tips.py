# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Shells and analyses for which tips have no functions, and tips that are too
near; tests/parameters/bad_input.py runs them."""
import pathlib

WITH_GOOD_CASES = False
FOLDER = pathlib.Path(__file__).resolve().parents[2] / "prm/fracture"
BASE = (FOLDER / "tip_functions.prm").read_text(encoding="utf-8").replace(
    "2, 3", "2").replace("= 25", "= 9")
CASES = {}


def case(name, expect, settings, args=()):
    assert name not in CASES, name
    CASES[name] = dict(expect=expect, change=None, prm=BASE, args=list(args),
                       folder={}, code=1, settings=settings)


case("edge_form", ["Cuts/Tips", "'Edge form = rotation jump'", "'closed'"],
     {"Discretization/Edge form": "averaged normal"}, ["--check"])
case("laminate", ["Cuts/Tips", "homogeneous isotropic section"],
     {"Section/Type": "laminate", "Quantities/Quantities": "",
      "Section/Laminate/Materials":
      "a: E1 = 25, E2 = 1, nu12 = 0.25, G12 = 0.5",
      "Section/Laminate/Stack": "[0/90]s", "Section/Laminate/Thickness": "0.1",
      "Loads/Edge moments": ""})
case("near", ["Cuts/Tips", "'crack'", "reach the tip of", "refine"],
     {"Cuts/Cuts": "crack: uv (-0.2, 0.003) (0.2, 0.003)"})
case("radius_to_other_tip", ["Cuts/Tips", "'crack'", "'Cuts/Tip radius'",
                             "smaller radius"], {"Cuts/Tip radius": "1.1"})
case("radius_of_closed_tip", ["Cuts/Tip radius", "0.3", "'Tips = closed'",
                              "branch functions"],
     {"Cuts/Tip radius": "0.3", "Cuts/Tips": "closed"}, ["--check"])
case("radius_negative", ["Cuts/Tip radius", "-1/10", "negative"],
     {"Cuts/Tip radius": "-1/10"}, ["--check"])
case("radius_of_bent_surface", ["Cuts/Tips", "'Cuts/Tip radius'",
                                "60 degrees", "smaller radius"],
     {"Cuts/Tip radius": "0.9", "Mid-surface/expression/Position":
      "sin(2*u)/2, v, (1 - cos(2*u))/2", "Quantities/Quantities": "",
      "Cuts/Cuts": "crack: uv (-1.1, 0.003) (0, 0.003)",
      "Loads/Edge moments": "", "Boundary conditions/Points": "",
      "Boundary conditions/Edges": "v=0: fixed"})
case("point_force", ["Loads", "two cells of the tip", "'Cuts/Tips = closed'"],
     {"Loads/Point forces": "(0.55, 0.2, 0): 0, 0, 1"})
case("turns", ["Cuts/Tips", "turns in the cell in which it ends"],
     {"Cuts/Cuts": "crack: uv (-1.1, 0.003) (0.4, 0.003) (0.44, 0.06)",
      "Quantities/Quantities": ""})
case("harmonic_triangles", ["Cuts/Tips", "quadrilaterals"],
     {"Cuts/Tips": "harmonic, all components", "Discretization/Element":
      "triangle"}, ["--check"])
