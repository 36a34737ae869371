# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Wrong laminates and what Nacre must say; tests/parameters/bad_input.py runs
them and explains the cases."""

WITH_GOOD_CASES = False
BASE = """\
set Title     = Laminated plate
set Constants = a = 2, q = 0.01

subsection Study
  set Degrees     = 2
  set Refinements = 0
end
subsection Mid-surface
  set Surface      = plate
  set Subdivisions = 2
  subsection plate
    set Size = a, 1
  end
end
subsection Section
  set Type = laminate
  subsection Laminate
    set Materials     = ud: E1 = 25, E2 = 1, nu12 = 0.25, G12 = 0.5
    set Stack         = [0/90]s
    set Ply thickness = 0.01
  end
end
subsection Boundary conditions
  set Edges = u=0: clamped
end
subsection Loads
  set Force per area = 0, 0, -q
end
subsection Quantities
  set Quantities = w = displacement z at (1, 0.5, 0)
end
"""

CASES = {}
L = "Section/Laminate/"


def case(name, expect, settings, args=()):
    assert name not in CASES, name
    CASES[name] = dict(expect=expect, settings=settings, change=None, prm=BASE,
                       args=list(args), folder={}, code=1)


def laminate(name, expect, **parameters):
    case("laminate_" + name, expect,
         {L + key.replace("_", " "): value
          for key, value in parameters.items()})


MANY = ("a: E1 = 25, E2 = 1, nu12 = 0.25, G12 = 0.5; "
        "b: E1 = 1, E2 = 1, nu12 = 0.25, G12 = 0.4")

case("section_type", ["Type", "composite", "laminate"],
     {"Section/Type": "composite"})
case("laminate_isotropic_regions",
     ["Section/Regions", "isotropic", "Section/Laminate/Regions"],
     {"Section/Regions": "web: h = 1"})

laminate("no_materials", [L + "Materials", "empty", "E1"], Materials="")
laminate("material_without_values",
         [L + "Materials", "'ud'", "'G12'", "needed"],
         Materials="ud: E1 = 25, E2 = 1, nu12 = 0.25")
laminate("material_key", [L + "Materials", "G13", "G12", "Known"],
         Materials="ud: E1 = 25, E2 = 1, nu12 = 0.25, G13 = 0.5")
laminate("material_twice", [L + "Materials", "'a'", "twice"],
         Materials="a: E1 = 25, E2 = 1, nu12 = 0.25, G12 = 0.5; "
                   "a: E1 = 25, E2 = 1, nu12 = 0.25, G12 = 0.5")
laminate("material_negative", ["'ud', E2", "-1", "positive"],
         Materials="ud: E1 = 25, E2 = -1, nu12 = 0.25, G12 = 0.5")
laminate("material_nu", ["'ud', nu12", "6", "smaller than 1"],
         Materials="ud: E1 = 25, E2 = 1, nu12 = 6, G12 = 0.5")
laminate("material_strengths", ["'ud'", "2 of the strengths", "none"],
         Materials="ud: E1 = 25, E2 = 1, nu12 = 0.25, G12 = 0.5, Xt = 1, "
                   "Xc = 1")
laminate("no_stack", [L + "Stack", "empty", "[0/45/-45/90]s"], Stack="")
laminate("stack_syntax", [L + "Stack", "'[0/90]x'", "symmetric"],
         Stack="[0/90]x")
laminate("stack_angle", [L + "Stack", "'[0/abc]'", "degrees", "abc"],
         Stack="[0/abc]")
laminate("stack_two_meanings", [L + "Stack", "two meanings", "(+-45)_2"],
         Stack="[+-45_2]")
laminate("stack_material", [L + "Stack", "'foam'", "ud"],
         Stack="[0_foam/90_ud]")
laminate("stack_without_material", [L + "Stack", "without a material", "0_a"],
         Stack="[0/90_b]", Materials=MANY)
laminate("no_thickness", ["Ply thickness", "Thickness", "empty"],
         Ply_thickness="")
laminate("two_thicknesses",
         ["Ply thickness", "0.01", "Thickness", "0.1", "both"],
         Thickness="0.1")
laminate("ply_thickness", [L + "Ply thickness", "-0.1", "positive"],
         Ply_thickness="-0.1")
laminate("thickness_somewhere", [L + "Thickness", "0", "positive", "point"],
         Ply_thickness="", Thickness="0.1*(x - 2)")
laminate("mixed_thicknesses", [L + "Thickness", "2 don't", "'ply'"],
         Materials=MANY + ", ply = 0.1", Stack="[0_a/0_b]s",
         Ply_thickness="", Thickness="1")
laminate("direction_normal",
         [L + "Material direction", "normal to the surface", "point"],
         Material_direction="z")
laminate("direction_zero", [L + "Material direction", "no length"],
         Material_direction="0, 0, 0")
laminate("direction_components", [L + "Material direction", "2", "three"],
         Material_direction="1, 0")
case("direction_no_lines",
     [L + "Material direction", "no lines of parameters u and v", "x, y, z"],
     {"Mid-surface/Surface": "disk", L + "Material direction": "u"})
laminate("top_tangent", [L + "Top", "tangent", "point"], Top="x")
laminate("region_unknown", [L + "Regions", "'web'", "no region"],
         Regions="web: stack = [0]4")
laminate("region_key", [L + "Regions", "'web'", "angle", "stack"],
         Regions="web: angle = 3")
case("ply_number", ["'s'", "no ply 5", "4"],
     {"Quantities/Quantities": "s = ply stress 1 of 5 top at (1, 0.5, 0)"})
case("ply_component", ["'s'", "'3'", "1|2|12"],
     {"Quantities/Quantities": "s = ply stress 3 of 1 top at (1, 0.5, 0)"})
case("ply_face", ["'s'", "'1 middle'", "bottom|top"],
     {"Quantities/Quantities": "s = ply stress 1 of 1 middle at (1, 0.5, 0)"})
case("ply_no_strengths", ["'f'", "strengths", "Xt"],
     {"Quantities/Quantities": "f = Tsai-Wu index at (1, 0.5, 0)"})
case("ply_isotropic", ["'s'", "no plies", "Section/Type"],
     {"Section/Type": "isotropic",
      "Quantities/Quantities": "s = ply stress 1 of 1 top at (1, 0.5, 0)"})
case("laminate_averaged_normal", ["averaged normal", "rotation jump"],
     {L + "Stack": "[0/90]", "Discretization/Edge form": "averaged normal"})
for model in ("corotational", "finite"):
    case("laminate_reduced_" + model, ["Membrane strain", "use tied"],
         {L + "Stack": "[0/90]", "Discretization/Membrane strain": "reduced",
          "Discretization/Kinematics": model, "Analysis/Type": "static"})
