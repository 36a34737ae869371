# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Wrong materials and what Nacre must say; tests/parameters/bad_input.py runs
them and explains the cases."""

WITH_GOOD_CASES = False
BASE = """\
set Title = Strip

subsection Study
  set Degrees     = 2
  set Refinements = 0
end
subsection Mid-surface
  set Surface      = plate
  set Subdivisions = 2
end
subsection Discretization
  set Kinematics = finite
end
subsection Boundary conditions
  set Edges = u=0: clamped
end
subsection Loads
  set Force per area = 0, 0, -1e-6
end
subsection Analysis
  set Type = static
end
subsection Quantities
  set Quantities = w = displacement z at (1, 0.5, 0)
end
"""
TYPE = "Section/Type"
MU = "Section/Neo-Hookean/Shear modulus"
YIELD = "Section/Plasticity/Yield stress"
HARDENING = "Section/Plasticity/Hardening modulus"
POINTS = "Section/Plasticity/Points"

CASES = {}


def case(name, expect, settings):
    assert name not in CASES, name
    CASES[name] = dict(expect=expect, settings=settings, change=None, prm=BASE,
                       args=[], folder={}, code=1)


def rubber(name, expect, **settings):
    case(name, expect, {TYPE: "neo-Hookean", MU: "1", **settings})


def metal(name, expect, **settings):
    case(name, expect, {TYPE: "elastoplastic", YIELD: "1e-3", **settings})


rubber("no_shear_modulus", [MU, "empty"], **{MU: ""})
rubber("shear_modulus", [MU, "-1", "positive"], **{MU: "-1"})
rubber("shear_modulus_somewhere", [MU, "positive", "point"], **{MU: "x - 0.5"})
rubber("rubber_regions", ["Section/Regions", "neo-Hookean", "expressions"],
       **{"Section/Regions": "web: h = 1"})
rubber("rubber_initial_strain", ["Section/Initial strain", "Section/Type"],
       **{"Section/Initial strain/Temperature": "1",
          "Section/Initial strain/Thermal expansion": "1e-5"})
metal("no_yield_stress", [YIELD, "empty"], **{YIELD: ""})
metal("yield_stress", [YIELD, "0", "positive"], **{YIELD: "0"})
metal("softening", [HARDENING, "-0.1", "not be negative"],
      **{HARDENING: "-0.1"})
metal("simpson_points", [POINTS, "7", "5, 9, 13"], **{POINTS: "7"})
metal("corotational", ["Discretization/Kinematics", "corotational", "finite"],
      **{"Discretization/Kinematics": "corotational"})
metal("linear_analysis", ["Analysis/Type", "linear", "static"],
      **{"Discretization/Kinematics": "linear", "Analysis/Type": "linear"})
RESULT = "Quantities/Quantities"
TEAR = {"Cuts/Cuts": "tear: uv (-0.1, 0.45) (0.45, 0.45)"}
GROWS = {**TEAR, "Growth/Tips": "tear end"}
metal("growth", ["Growth/Criterion", "energy release rate", "strength"],
      **GROWS, **{"Growth/Toughness": "1"})
metal("growth_along_arc", ["Growth/Criterion", "arc length", "displacement"],
      **GROWS, **{"Growth/Criterion": "strength", "Growth/Strength": "1",
                  "Growth/Averaging distance": "2 cells",
                  "Analysis/Type": "arc length"})
rubber("hoop_stress", ["Growth/Direction", "'hoop stress'", "straight"],
       **GROWS, **{"Growth/Toughness": "1", "Growth/Direction": "hoop stress"})
rubber("intensity", [RESULT, "'K_I'", "energy release rate"],
       **TEAR, **{RESULT: "k = K_I of tear end"})
metal("release_rate", [RESULT, "depends on its path"],
      **TEAR, **{RESULT: "g = energy release rate of tear end"})
rubber("plastic_strain",
       [RESULT, "accumulated plastic strain", "elastoplastic"],
       **{RESULT: "a = accumulated plastic strain top at (0, 0, 0)"})
metal("plastic_strain_face", [RESULT, "face", "'up'", "middle"],
      **{RESULT: "a = largest accumulated plastic strain up"})
