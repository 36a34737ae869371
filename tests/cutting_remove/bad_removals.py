# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Wrong input about pieces that are taken away; ../parameters/bad_input.py runs
the cases and says what they hold."""

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
  set Subdivisions = 4, 2
  subsection plate
    set Size = 2, 1
  end
end
subsection Cuts
  set Cuts = slit: uv (1.2, -0.1) (1.3, 1.1)
end
subsection Section
  set Young's modulus = 1000
  set Poisson's ratio = 0.3
  set Thickness       = 0.05
end
subsection Boundary conditions
  set Edges = u=0: clamped
end
subsection Loads
  set Force per area = 0, 0, -1
end
subsection Quantities
  set Quantities = U = energy
end
"""

CASES = {}


def case(name, expect, remove, **settings):
    values = {"Cuts/Remove": remove}
    values.update({key.replace("_", " ").replace("  ", "/"): value
                   for key, value in settings.items()})
    CASES[name] = dict(expect=expect, settings=values, change=None, prm=BASE,
                       args=["--check"], folder={}, code=1)


case("remove_off_surface",
     ["Cuts/Remove: (1.8 0.5 0.3)", "lies off the mid-surface by 0.3"],
     "(1.8, 0.5, 0.3)")
case("remove_on_lip",
     ["Cuts/Remove: (1.25 0.5 0)", "two parts of the surface",
      "Choose a point further inside"],
     "(1.25, 0.5, 0)")
case("remove_only_component",
     ["Cuts/Remove: (1.8 0.5 0)", "the cuts separate no piece",
      "Close the cut"],
     "(1.8, 0.5, 0)", Cuts__Cuts="slit: uv (1.2, -0.1) (1.25, 0.6)")
case("remove_everything",
     ["Cuts/Remove", "in all 2 pieces", "nothing is left"],
     "(1.8, 0.5, 0); (0.2, 0.5, 0)")
case("remove_nothing_held",
     ["of the piece around", "can be taken away (Cuts/Remove)"],
     "")
case("remove_quantity",
     ["Quantities", "'w'", "the point lies off the mid-surface by"],
     "(1.9, 0.5, 0)",
     Quantities__Quantities="w = displacement z at (1.8, 0.5, 0)")
