# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Cuts that can't grow; ../parameters/bad_input.py runs the cases and says
what they hold."""

WITH_GOOD_CASES = False
BASE = """\
subsection Study
  set Degrees     = 2
  set Refinements = 0
end
subsection Mid-surface
  set Surface      = plate
  set Subdivisions = 7
  subsection plate
    set Size = 1, 1
  end
end
subsection Cuts
  set Cuts = slit: uv (-0.1, 0.5) (0.5, 0.5); \\
             hole: uv closed (0.6, 0.1) (0.9, 0.1) (0.9, 0.3)
  set Remove = (0.85, 0.15, 0)
end
subsection Growth
  set Tips      = slit end
  set Toughness = 1
end
subsection Section
  set Young's modulus = 1000
  set Poisson's ratio = 0.3
  set Thickness       = 0.05
end
subsection Boundary conditions
  set Edges = v=0: clamped; v=1: clamped
end
subsection Loads
  set Force per area = 0, 0, -1
end
subsection Quantities
  set Quantities = U = energy
end
"""

CASES = {}


def case(name, expect, args=("--check",), **settings):
    assert name not in CASES, name
    values = {f"Growth/{key.replace('_', ' ')}": value
              for key, value in settings.items() if "/" not in key}
    values.update({key: value for key, value in settings.items()
                   if "/" in key})
    CASES[name] = dict(expect=expect, settings=values, change=None, prm=BASE,
                       args=list(args), folder={}, code=1)


case("growth_unknown_cut", ["Growth/Tips, 'slot end'", "unknown cut 'slot'",
                            "'slit'"], Tips="slot end")
case("growth_no_end", ["Growth/Tips, 'slit'", "write 'CUT begin' or 'CUT end'"],
     Tips="slit")
case("growth_closed_cut", ["'hole end'", "is closed and has no ends"],
     Tips="hole end")
case("growth_twice", ["'slit end' is listed twice"], Tips="slit end, slit end")
case("growth_no_tip", ["Growth/Tips, 'slit begin'", "is no tip"],
     Tips="slit begin")
case("growth_no_cuts", ["Growth/Tips", "'Cuts/Cuts' is empty"],
     **{"Cuts/Cuts": "", "Cuts/Remove": ""})
case("growth_without_tips", ["Growth/Tips: none, but 'Toughness'"],
     Tips="none")
case("growth_no_toughness", ["Growth/Toughness", "needs it"], Toughness="")
case("growth_toughness_of_knife",
     ["Growth/Toughness", "'Growth/Criterion = prescribed' doesn't use it"],
     Criterion="prescribed")
case("growth_length_in_linear", ["Growth/Length", "in a linear analysis"],
     Criterion="prescribed", Toughness="", Length="t")
case("growth_no_length", ["Growth/Length", "'0.1*t'"],
     Criterion="prescribed", Toughness="", **{"Analysis/Type": "static"})
case("growth_direction", ["Growth/Direction: found 'up'", "'dx, dy, dz'"],
     Direction="up")
case("growth_hoop_of_knife", ["Growth/Direction: 'hoop stress'"],
     Criterion="prescribed", Toughness="", Direction="hoop stress")
case("growth_short_step", ["Growth/Step: at the tip 'slit end'", "too short"],
     args=(), Step="0.01")
case("growth_long_step", ["Growth/Step: 3 is longer than the shell", "1.4"],
     Step="3")
case("growth_long_average",
     ["Growth/Averaging distance: 1e+300 is longer than the shell"],
     Criterion="strength", Toughness="", Averaging_distance="1e300",
     Strength="1")
case("growth_of_modes", ["Growth/Tips", "'Analysis/Type = vibration'"],
     **{"Analysis/Type": "vibration"})
case("growth_buckling", ["Growth/Tips", "'Analysis/Type = buckling'",
                         "'arc length'"], **{"Analysis/Type": "buckling"})
case("growth_branches", ["Analysis/Switch branch", "Growth/Tips"],
     **{"Analysis/Type": "arc length", "Analysis/Switch branch": "0, 1"})
case("growth_release_in_statics",
     ["Growth/Release time", "'Analysis/Type = static'", "dynamic"],
     Release_time="0.1", **{"Analysis/Type": "static"})
case("growth_negative_release", ["Growth/Release time: '-1' is negative"],
     Release_time="-1", **{"Analysis/Type": "dynamic"})
case("growth_adaptive", ["Adaptive refinement/Cycles", "Growth/Tips"],
     **{"Adaptive refinement/Cycles": "1",
        "Adaptive refinement/Max dofs": "1"})
case("growth_restart", ["--restart", "no checkpoint"], args=("--restart",),
     **{"Analysis/Type": "static"})
case("growth_vector", ["Growth/Direction: at the tip 'slit end'", "surface"],
     args=(), Direction="0, 0, 1")
case("growth_no_strength", ["Growth/Strength", "needs it"],
     Criterion="strength", Toughness="", Averaging_distance="0.2")
case("growth_strength_of_nothing", ["Growth/Strength", "is not positive"],
     Criterion="strength", Toughness="", Averaging_distance="0.2",
     Strength="0")
case("growth_no_distance", ["Growth/Averaging distance", "needs it"],
     Criterion="strength", Toughness="", Strength="1")
case("growth_toughness_of_strength",
     ["Growth/Toughness", "'Growth/Criterion = strength' doesn't use it"],
     Criterion="strength", Strength="1", Averaging_distance="0.2")
case("growth_starts_by_energy",
     ["Growth/Starting cracks", "energy release rate' doesn't use it"],
     Starting_cracks="1")
case("growth_strength_without_tips",
     ["Growth/Tips: none, but 'Strength' is given"], Tips="none",
     Criterion="strength", Toughness="", Strength="1")
case("growth_strength_of_layers",
     ["Growth/Criterion", "homogeneous section"],
     Criterion="strength", Toughness="", Averaging_distance="0.2",
     Strength="1", **{"Section/Type": "laminate",
                      "Section/Laminate/Materials":
                      "ply: E1 = 30, E2 = 10, nu12 = 0.25, G12 = 6",
                      "Section/Laminate/Stack": "[0/90]",
                      "Section/Laminate/Thickness": "0.05",
                      "Section/Laminate/Material direction": "y"})
case("growth_short_average",
     ["Growth/Averaging distance", "less than a cell"], args=(),
     Criterion="strength", Toughness="", Averaging_distance="0.05",
     Strength="1")
case("growth_starts_in_motion", ["Growth/Release time", "Starting cracks"],
     Criterion="strength", Toughness="", Averaging_distance="0.2",
     Strength="1", Starting_cracks="1",
     **{"Analysis/Type": "dynamic", "Section/Density": "1"})
case("growth_few_cells",
     ["Growth/Tips, 'slit end'", "the crack 'slit' runs through 3 cells",
      "4 at least", "Study/Refinements"],
     **{"Cuts/Cuts": "slit: uv (0.4, 0.5) (0.6, 0.5); hole: uv closed "
                     "(0.6, 0.1) (0.9, 0.1) (0.9, 0.3)"})
