# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Wrong input of buckling and vibration and what Nacre must say;
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
subsection Section
  set Young's modulus = 1000
  set Poisson's ratio = 0.3
  set Thickness       = 0.05
  set Density         = 1
end
subsection Boundary conditions
  set Edges = left: clamped
end
subsection Loads
  set Edge forces = right: (-1, 0, 0)
end
subsection Analysis
  set Type            = buckling
  set Number of modes = 2
end
"""

CASES = {}


def case(name, expect, settings, args=()):
    assert name not in CASES, name
    CASES[name] = dict(expect=expect, settings=settings, change=None, prm=BASE,
                       args=list(args), folder={}, code=1)


A = "Analysis/"
VIBRATION = {A + "Type": "vibration"}
EDGES = "Boundary conditions/Edges"
LOAD = "Loads/Edge forces"

case("no_load", ["nothing acts", "t = 1", "Prestress = membrane force"],
     {LOAD: ""}, args=["--check"])
case("nothing_scaled", ["Load factor", "t = 0 and t = 1", "the same"],
     {A + "Load factor": "1"})
case("unstable_start", ["unstable without the loads that are scaled"],
     {A + "Load factor": "100 + t"})
case("not_supported", ["shell can move freely", "translation"], {EDGES: ""},
     args=["--check"])
case("no_density", ["Section/Density: 0", "needs a positive one"],
     {**VIBRATION, "Section/Density": "0"}, args=["--check"])
case("too_many_modes", ["Number of modes: 500", "unconstrained degrees"],
     {A + "Number of modes": "500"}, args=["--check"])
case("no_mode_in_range", ["'o'", "none is in the range", "Range of modes"],
     {**VIBRATION, "Section/Density": "1", LOAD: "",
      A + "Range of modes": "1e6, 1.1e6",
      "Quantities/Quantities": "o = omega 1"})
case("no_prestress", ["Analysis/Prestress", "buckling needs one"],
     {A + "Prestress": "none"})
case("prestress_of_no_load", ["Analysis/Prestress", "nothing acts", "none"],
     {**VIBRATION, A + "Prestress": "linear", LOAD: ""})
case("prestress_of_free_shell", ["Analysis/Prestress", "can move freely"],
     {**VIBRATION, A + "Prestress": "linear", EDGES: ""})
case("membrane_force_unused",
     ["Analysis/Membrane force", "Prestress = linear", "doesn't use it"],
     {A + "Membrane force": "-1, 0, 0"})
case("membrane_force_missing", ["Analysis/Membrane force", "N11, N22, N12"],
     {A + "Prestress": "membrane force"})
case("axis_normal", ["Membrane force axis", "normal to the surface"],
     {A + "Prestress": "membrane force", A + "Membrane force": "-1, 0, 0",
      A + "Membrane force axis": "0, 0, 1"})
case("range_of_one", ["Range of modes", "'lower, upper'"],
     {A + "Range of modes": "3"})
case("range_falls", ["Range of modes", "'3, 2'", "rise"],
     {A + "Range of modes": "3, 2"})
case("sign_of_vibration", ["Sign of load factors", "vibration"],
     {**VIBRATION, A + "Sign of load factors": "both"})
case("corotational", ["Kinematics", "buckling", "Kinematics = linear"],
     {"Discretization/Kinematics": "corotational"})
case("density_beyond_numbers", ["Section/Density", "between", "units"],
     {**VIBRATION, "Section/Density": "1e300"})
case("multigrid", ["'multigrid' has no factors", "vibration"],
     {**VIBRATION, "Linear solver/Solver": "multigrid"})
case("adaptive", ["Adaptive refinement/Cycles", "linear analysis"],
     {"Adaptive refinement/Cycles": "2"})
case("start_from", ["Start from", "buckling", "'finite'"],
     {A + "Start from": "output/other"})
case("initial_velocity", ["Initial velocity", "Type = vibration"],
     {**VIBRATION, A + "Initial velocity": "1, 0, 0"})
case("mode_not_found", ["'k'", "mode 7", "1 to 2"],
     {"Quantities/Quantities": "k = load factor 7"})
case("frequency_of_buckling", ["'k'", "belong to Type = vibration"],
     {"Quantities/Quantities": "k = frequency 1"})
case("factor_of_vibration", ["'k'", "belongs to Type = buckling"],
     {**VIBRATION, "Quantities/Quantities": "k = load factor 1"})
case("mode_of_linear", ["'k'", "buckling", "have modes"],
     {A + "Type": "linear", "Quantities/Quantities": "k = omega 1"})
case("mode_zero", ["'omega 0'", "omega NUMBER"],
     {**VIBRATION, "Quantities/Quantities": "k = omega 0"})
