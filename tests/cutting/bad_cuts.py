# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Wrong input about cuts; ../parameters/bad_input.py runs the cases and says
what they hold."""

WITH_GOOD_CASES = False
BASE = """\
set Title     = Plate
set Constants = a = 2

subsection Study
  set Degrees     = 2
  set Refinements = 0
end
subsection Mid-surface
  set Surface      = plate
  set Subdivisions = 3
  subsection plate
    set Size = a, 1
  end
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


def case(name, expect, cuts, folder=None, **settings):
    assert name not in CASES, name
    values = {"Cuts/Cuts": cuts}
    values.update({"Cuts/" + key.replace("_", " "): value
                   for key, value in settings.items()})
    CASES[name] = dict(expect=expect, settings=values, change=None, prm=BASE,
                       args=["--check"], folder=folder or {}, code=1)


case("cut_coordinates",
     ["Cuts/Cuts, 'slit: rt (0, 0.5) (1, 0.5)'", "unknown coordinates 'rt'",
      "'uv', 'xyz' and 'file' are allowed"],
     "slit: rt (0, 0.5) (1, 0.5)")
case("cut_without_name", ["Cuts/Cuts", "has no ':'", "slit: uv"],
     "uv (0, 0.5) (1, 0.5)")
case("cut_same_name",
     ["'slit: uv (0, 0.2) (1, 0.2)'", "the name 'slit'",
      "two cuts can't have one name"],
     "slit: uv (0, 0.5) (1, 0.5); slit: uv (0, 0.2) (1, 0.2)")
case("cut_unreadable_point",
     ["'slit: uv (0, 0.5) 1, 0.5'", "found '1, 0.5'",
      "a point in parentheses", "'(u, v)'"],
     "slit: uv (0, 0.5) 1, 0.5")
case("cut_two_numbers",
     ["the point '(0, 0.5)' has 2 numbers", "three numbers, '(x, y, z)'"],
     "slit: xyz (0, 0.5) (1, 0.5)")
case("cut_one_point", ["found 1 point; a cut needs two at least"],
     "slit: uv (0, 0.5)")
case("cut_closed_two_points",
     ["found 2 points; a closed cut needs three at least"],
     "slit: uv closed (0.2, 0.5) (1, 0.5)")
case("cut_point_twice",
     ["the points 2 and 3 are the same, (1, 0.5)", "neighbours must differ"],
     "slit: uv (0, 0.5) (a/2, 0.5) (1, 0.5) (1, 0.7)")
case("cut_not_finite", ["'slit: uv (0, 1/0) (1, 0.5)'", "must be finite"],
     "slit: uv (0, 1/0) (1, 0.5)")
case("cut_expression_number",
     ["found 1 points; a whole number from 2 to 1000000 is allowed"],
     "slit: uv expression s, 0.5, 1 points")
case("cut_expression_not_finite",
     ["1/(s-0.5)", "infinite at s = 0.5", "must be finite"],
     "slit: uv expression 1/(s-0.5), 0.5, 3 points")
case("cut_no_file",
     ["'flap: file flap.dat'", "the file 'flap.dat' doesn't exist"],
     "flap: file flap.dat")
case("cut_empty_file", ["'flap: file flap.dat'", "the file holds no points"],
     "flap: file flap.dat", folder={"flap.dat": "# u, v\n\n"})
case("cut_file_word",
     ["'flap: file flap.dat', line 2: 'nan' is no finite number"],
     "flap: file flap.dat", folder={"flap.dat": "0, 0.5\n1, nan\n"})
case("cut_file_numbers",
     ["'flap: file flap.dat', line 2: found 3 numbers",
      "the lines before have two numbers"],
     "flap: file flap.dat", folder={"flap.dat": "0, 0.5\n1, 0.5, 0\n"})
case("cut_file_curve", ["curve flap-2: found 1 point"],
     "flap: file flap.dat", folder={"flap.dat": "0 .5\n1 .5\n\n0 .2\n"})
case("cut_snap", ["Cuts", "Snap", "0.3", "0.2"],
     "slit: uv (0, 0.5) (1, 0.5)", Snap="0.3")
case("cut_smallest_part", ["Smallest part", "-0.1", "0.5"],
     "slit: uv (0, 0.5) (1, 0.5)", Smallest_part="-0.1")
case("cut_remove_without", ["Cuts/Remove", "'Cuts/Cuts' is empty"],
     "", Remove="(1, 0.5, 0)")
case("cut_no_chart",
     ["'slit: uv (0, 0.5) (1, 0.5)'", "isn't described over a rectangle",
      "'xyz (x, y, z) ...'"],
     "slit: uv (0, 0.5) (1, 0.5)")
CASES["cut_no_chart"]["settings"].update({
    "Mid-surface/Surface": "disk", "Boundary conditions/Edges": "rim: fixed"})
case("cut_piece_without_support",
     ["the shell can move freely", "of the piece around",
      "can be taken away (Cuts/Remove)"],
     "slit: uv (a/2, -0.1) (a/2, 1.1)")
case("cut_along_the_edge",
     ["Cuts/Cuts, 'slit'", "no part of the cut lies inside the surface"],
     "slit: uv (0, -0.1) (0, 1.1)")


def removal(name, expect, remove, cuts="slit: uv (1.2, -0.1) (1.3, 1.1)",
            settings=None):
    case(name, expect, cuts, Remove=remove)
    CASES[name]["settings"].update(settings or {})


removal("remove_off_surface",
        ["Cuts/Remove: (1.8 0.5 0.3)", "lies off the mid-surface by 0.3"],
        "(1.8, 0.5, 0.3)")
removal("remove_on_lip",
        ["Cuts/Remove: (1.25 0.5 0)", "two parts of the surface",
         "Choose a point further inside"],
        "(1.25, 0.5, 0)")
removal("remove_only_component",
        ["Cuts/Remove: (1.8 0.5 0)", "the cuts separate no piece",
         "Close the cut"],
        "(1.8, 0.5, 0)", "slit: uv (1.2, -0.1) (1.25, 0.6)")
removal("remove_everything",
        ["Cuts/Remove", "in all 2 pieces", "nothing is left"],
        "(1.8, 0.5, 0); (0.2, 0.5, 0)")
removal("remove_quantity",
        ["Quantities", "'w'", "the point lies off the mid-surface by"],
        "(1.9, 0.5, 0)",
        settings={"Quantities/Quantities":
                  "w = displacement z at (1.8, 0.5, 0)"})
removal("remove_loaded_edge",
        ["Cuts/Remove takes away all of the edge 'u=1'",
         "which Loads/Edge forces names", "Leave the edge out"],
        "(1.9, 0.5, 0)", settings={"Loads/Edge forces": "u=1: 0, 0, 1"})
removal("remove_supported_edge",
        ["Cuts/Remove takes away all of the edge 'u=1'",
         "which Boundary conditions/Edges names", "Leave the edge out"],
        "(1.9, 0.5, 0)",
        settings={"Boundary conditions/Edges": "u=0: clamped; u=1: fixed"})


def lips(name, expect, load, cuts="slit: uv (1.2, -0.1) (1.3, 0.6)",
         **settings):
    case(name, expect, cuts, **settings)
    CASES[name]["settings"]["Loads/Lip forces"] = load


lips("lip_unknown_cut", ["Loads/Lip forces, 'slot left'", "unknown cut 'slot'",
                         "'slit'"], "slot left: 0, 0, 1")
lips("lip_twice", ["the left lip of the cut 'slit' has a load already",
                   "as a part of 'slit left'"],
     "slit left: 0, 0, 1; slit: 0, 0, 2")
lips("lip_closed", ["the cut 'slit' has no right lip", "no cell is open",
                    "name the other side, 'CUT left'"],
     "slit: 0, 0, 1", cuts="slit: uv (0.75, 0.5) (0.9, 0.5)")
lips("lip_removed", ["the cut 'slit' has no right lip", "Cuts/Remove"],
     "slit: 0, 0, 1", cuts="slit: uv (1.2, -0.1) (1.3, 1.1)",
     Remove="(1.9, 0.5, 0)")
