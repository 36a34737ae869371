# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Wrong foundations, initial strains and imperfections and what Nacre must say;
tests/parameters/bad_input.py runs them and explains the cases."""

WITH_GOOD_CASES = False
BASE = """\
set Title = Plate

subsection Study
  set Degrees     = 2
  set Refinements = 0
  set Write VTU   = false
end
subsection Mid-surface
  set Surface      = plate
  set Subdivisions = 2
  subsection plate
    set Size = 2, 1
  end
end
subsection Boundary conditions
  set Edges = left: clamped
end
"""

CASES = {}


def case(name, expect, settings, change=None, folder=None):
    assert name not in CASES, name
    CASES[name] = dict(expect=expect, settings=settings, change=change,
                       prm=BASE, args=["--check"], folder=folder or {}, code=1)


F = "Foundation/"
S = "Section/Initial strain/"
I = "Mid-surface/Imperfection/"
HEATED = {S + "Temperature": "1", S + "Thermal expansion": "1e-5"}

case("foundation_negative", ["Normal stiffness: -1 at", "not be negative"],
     {F + "Normal stiffness": "-1"})
case("foundation_linear", ["Tension free: 'below' is nonlinear", "static"],
     {F + "Normal stiffness": "1", F + "Tension free": "below"})
case("foundation_holds_no_motion_in_plane",
     ["shell can move freely", "translation along (1, 0, 0)"],
     {F + "Normal stiffness": "1", "Boundary conditions/Edges": ""})
case("foundation_of_no_region", ["Foundation/Regions", "'soil'"],
     {F + "Regions": "soil: normal = 1"})
case("strain_of_two", ["Initial strain/Strain: '1, 2' has 2 components"],
     {S + "Strain": "1, 2"})
case("strain_adaptive", ["Cycles", "estimate knows no initial strains"],
     {**HEATED, "Adaptive refinement/Cycles": "1"})
case("temperature_without_expansion",
     ["Initial strain/Temperature", "'Thermal expansion'", "strains nothing"],
     {S + "Temperature": "20"})
case("strain_of_no_region", ["Initial strain/Regions", "'web'"],
     {S + "Regions": "web: e11 = 1"})
case("imperfection_no_file", ["Imperfection/Modes, 'no.csv'", "doesn't exist"],
     {I + "Modes": "no.csv: 1"})
case("imperfection_columns", ["'w.points': line 2 has 3 numbers", "x y z w"],
     {I + "Points": "w.points: 1"}, folder={"w.points": "x y z\n1 2 3\n"})
case("imperfection_not_finite",
     ["'w.points': line 3: 'nan' is no finite number", "x y z w"],
     {I + "Points": "w.points: 1"},
     folder={"w.points": "x y z w\n0 0 0 1\nnan 1 0 1\n0 1 0 1\n1 1 0 1\n"})
case("imperfection_elsewhere", ["no point of the file is near"],
     {I + "Points": "w.points: 1"},
     folder={"w.points": "0 0 5 1\n1 0 5 1\n0 1 5 1\n2 1 5 1\n"})
