# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Wrong input and what Nacre must say about it; bad_input.py runs them.

A case is named and has
  expect    texts that the message must hold, white space normalised;
            re.compile(...) for a pattern
  settings  "Section/Parameter": value, appended to BASE
  change    (old, new) text of BASE
  prm       a whole file instead of BASE, or None for no file
  args      command line behind the file; with {prm} it is the whole one
  folder    files to make first: name -> text
  code      the exit code
"""
import re

WITH_GOOD_CASES = True
BASE = """\
set Title     = Plate
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
  set Young's modulus = 1000
  set Poisson's ratio = 0.3
  set Thickness       = 0.05
end
subsection Boundary conditions
  set Edges = u=0: clamped; u=1: fixed
end
subsection Loads
  set Force per area = 0, 0, -q
end
subsection Quantities
  set Quantities = w = displacement z at (1, 0.5, 0); U = energy
end
"""

CASES = {}


def case(name, expect, settings=None, change=None, prm=BASE, args=(),
         folder=None, code=1):
    assert name not in CASES, name
    CASES[name] = dict(expect=expect, settings=settings or {}, change=change,
                       prm=prm, args=list(args), folder=folder or {},
                       code=code)


# --- Linear solver ---------------------------------------------------------
case("solver_unknown", ["Linear solver", "Solver", "fast", "multigrid"],
     {"Linear solver/Solver": "fast"})
case("solver_no_iterations", ["Linear solver", "Max iterations", "0"],
     {"Linear solver/Max iterations": "0"})
case("solver_multigrid_dynamic",
     ["Linear solver/Solver", "'multigrid'", "dynamic", "auto or direct"],
     {"Linear solver/Solver": "multigrid", "Analysis/Type": "dynamic",
      "Section/Density": "1"})

# --- Analysis --------------------------------------------------------------
case("analysis_type", ["Type", "quasistatic", "static"],
     {"Analysis/Type": "quasistatic"})
case("analysis_corotational_linear",
     ["Discretization/Kinematics", "corotational", "Analysis/Type"],
     {"Discretization/Kinematics": "corotational"})
case("tangent_consistent",
     ["Discretization/Tangent", "'consistent'", "unsymmetric", "'symmetric'"],
     {"Discretization/Tangent": "consistent",
      "Discretization/Kinematics": "corotational", "Analysis/Type": "static"})
case("analysis_time_step", ["Analysis/Time step", "-1", "not positive"],
     {"Analysis/Type": "static", "Analysis/Time step": "-1"})
case("analysis_minimum_step", ["Analysis/Minimum time step", "larger"],
     {"Analysis/Type": "static", "Analysis/Minimum time step": "2"})
ARC = {"Analysis/Type": "arc length"}
case("arc_length_output_times", ["Analysis/Output times", "isn't prescribed"],
     {**ARC, "Analysis/Output times": "0.5"})
case("arc_length_updates", ["Analysis/Tangent updates", "'every step'"],
     {**ARC, "Analysis/Tangent updates": "every step"})
case("arc_length_line_search", ["Analysis/Line search", "'always'"],
     {**ARC, "Analysis/Line search": "always"})
case("arc_length_damping", ["Analysis/Damping of iterations", "choose 1"],
     {**ARC, "Analysis/Damping of iterations": "0.5"})
case("arc_length_frozen", ["Discretization/Tangent", "'frozen'"],
     {**ARC, "Discretization/Kinematics": "corotational",
      "Discretization/Tangent": "frozen"})
case("switch_branch_of_static", ["Analysis/Switch branch", "arc length"],
     {"Analysis/Type": "static", "Analysis/Switch branch": "1"})
case("branches_adaptive", ["Adaptive refinement/Cycles", "Switch branch"],
     {**ARC, "Adaptive refinement/Cycles": "2",
      "Analysis/Switch branch": "all"})
case("switch_branch_text", ["Analysis/Switch branch", "'first'", "'all'"],
     {**ARC, "Analysis/Switch branch": "first"})
case("switch_branch_twice", ["Analysis/Switch branch", "'1'", "twice"],
     {**ARC, "Analysis/Switch branch": "1, 1"})
case("maximum_points_of_static", ["Analysis/Maximum points", "arc length"],
     {"Analysis/Type": "static", "Analysis/Maximum points": "1"})
case("stop_where_form", ["Analysis/Stop where", "'w = 3'", "<"],
     {**ARC, "Analysis/Stop where": "w = 3"})
case("stop_where_of_linear", ["Analysis/Stop where", "no path"],
     {"Analysis/Stop where": "w < 3"})
case("thickness_huge", ["Section", "bending stiffness", "units"],
     {"Section/Thickness": "1e300"})
case("control_of_static", ["Analysis/Control", "displacement control"],
     {"Analysis/Type": "static", "Analysis/Control": "w"})
case("control_missing", ["Analysis/Control", "Control values"],
     {"Analysis/Type": "displacement control", "Analysis/Control": "w"})
case("control_step_of_zero", ["Analysis/Control step", "all 0"],
     {"Analysis/Type": "displacement control", "Analysis/Control": "w",
      "Analysis/Control values": "0"})
case("arc_length_no_step", ["Analysis/Time step", "zero"],
     {**ARC, "Analysis/Time step": "0"})
case("static_downward", ["Analysis/Time step", "not positive"],
     {"Analysis/Type": "static", "Analysis/Time step": "-0.1"})
case("analysis_maximum_step", ["Analysis/Maximum time step", "smaller"],
     {"Analysis/Type": "static", "Analysis/Maximum time step": "0.01"})
case("analysis_load_factor", ["Analysis/Load factor", "s"],
     {"Analysis/Type": "static", "Analysis/Load factor": "2*s"})
case("analysis_no_density", ["Section/Density", "0", "positive"],
     {"Analysis/Type": "dynamic"})
case("analysis_following_linear", ["Loads/Pressure follows", "linear"],
     {"Loads/Pressure": "1", "Loads/Pressure follows": "true"})
case("analysis_scheme", ["Scheme", "euler", "implicit euler"],
     {"Analysis/Type": "dynamic", "Analysis/Scheme": "euler"})
case("analysis_spectral_radius", ["Spectral radius", "2"],
     {"Analysis/Type": "dynamic", "Analysis/Spectral radius": "2"})
case("analysis_mass_damping", ["Analysis/Mass damping", "-a", "negative"],
     {"Analysis/Type": "dynamic", "Analysis/Mass damping": "-a"})
case("analysis_time_constant", ["'t'", "time", "constant"],
     {"Loads/Force per area": "0, 0, -q*t"},
     change=("set Constants = a = 2, q = 0.01",
             "set Constants = a = 2, q = 0.01, t = 1"))
case("analysis_restart_nothing", ["--restart", "no checkpoint", "checkpoint"],
     {"Analysis/Type": "static"}, args=["--restart"])
case("analysis_restart_linear", ["--restart", "Analysis/Type"],
     args=["--restart"])

# --- Adaptive refinement ---------------------------------------------------
CYCLES = {"Adaptive refinement/Cycles": "2"}
GOAL = dict(CYCLES, **{"Adaptive refinement/Estimator": "goal"})
for name, value in (("zero", "0"), ("negative", "-0.5"), ("above_one", "1.5")):
    case("adaptive_fraction_" + name,
         ["Adaptive refinement/Fraction", value, "above 0 and at most 1"],
         dict(CYCLES, **{"Adaptive refinement/Fraction": value}))
case("adaptive_goal_unknown",
     ["Adaptive refinement/Goal", "wmax", "w, U"],
     dict(GOAL, **{"Adaptive refinement/Goal": "wmax"}))
case("adaptive_tips", ["Adaptive refinement/Cells at tips", "no cuts"],
     dict(CYCLES, **{"Adaptive refinement/Cells at tips": "0.1"}))
case("adaptive_tips_negative",
     ["Adaptive refinement/Cells at tips", "-a/10", "negative"],
     dict(CYCLES, **{"Adaptive refinement/Cells at tips": "-a/10"}))
case("adaptive_motion", ["Adaptive refinement/Cycles", "keeps its mesh"],
     dict(CYCLES, **{"Analysis/Type": "dynamic"}))
case("adaptive_path_goal", ["Adaptive refinement/Estimator", "linear analyses"],
     dict(GOAL, **{"Adaptive refinement/Goal": "w", "Analysis/Type": "static",
                   "Discretization/Kinematics": "finite"}))
case("adaptive_tolerance_of_goal", ["Adaptive refinement/Tolerance", "energy"],
     dict(GOAL, **{"Adaptive refinement/Goal": "w",
                   "Adaptive refinement/Tolerance": "0.1"}))
case("adaptive_goal_missing", ["Adaptive refinement/Goal", "w, U"], GOAL)
case("adaptive_goal_nonlinear",
     ["Adaptive refinement/Goal", "'m'", "not linear",
      "a displacement at a point"],
     dict(GOAL, **{"Adaptive refinement/Goal": "m",
                   "Quantities/Quantities": "m = maximum displacement"}))
case("adaptive_goal_without_effect",
     ["Adaptive refinement/Goal", "'w'", "Estimator = goal"],
     dict(CYCLES, **{"Adaptive refinement/Goal": "w"}))
case("adaptive_triangles",
     ["Adaptive refinement/Cycles", "triangles", "quadrilaterals"],
     dict(CYCLES, **{"Discretization/Element": "triangle"}))
case("adaptive_estimator", ["Estimator", "patch", "residual"],
     dict(CYCLES, **{"Adaptive refinement/Estimator": "patch"}))
case("adaptive_column", ["Quantities/Quantities", "estimate", "another name"],
     {"Quantities/Quantities": "estimate = energy"})

# --- Section ---------------------------------------------------------------
for name, value in (("negative", "-0.1"), ("zero", "0")):
    case("thickness_" + name,
         ["Section/Thickness", value, "must be positive"],
         {"Section/Thickness": value})
case("thickness_negative_somewhere",
     ["Section/Thickness", "at the point (", "must be positive"],
     {"Section/Thickness": "1.9 - x"})
case("thickness_expression_not_finite",
     ["Section/Thickness", "0.1/(x-x)", "must be finite"],
     {"Section/Thickness": "0.1/(x-x)"})
case("thickness_empty", ["Section/Thickness", "is empty"],
     {"Section/Thickness": ""})
case("youngs_modulus_zero",
     ["Section/Young's modulus", "0", "must be positive"],
     {"Section/Young's modulus": "0"})
case("youngs_modulus_negative_somewhere",
     ["Section/Young's modulus", "at the point (", "must be positive"],
     {"Section/Young's modulus": "1 - x"})
for name, value in (("too_large", "0.7"), ("above_half", "0.501"),
                    ("minus_one", "-1")):
    case("poissons_ratio_" + name,
         ["Section/Poisson's ratio", value, "larger than -1",
          "at most 0.5"],
         {"Section/Poisson's ratio": value})
case("thickness_vanishes",
     ["Section: the bending stiffness of the cell at", "too small to reckon"],
     {"Section/Thickness": "1e-200"})
case("thickness_negative_on_one_rank",
     ["Section/Thickness", "at the point (2", "must be positive"],
     {"Section/Thickness": "1.95 - x", "Mid-surface/Subdivisions": "8, 2"})
case("density_negative", ["Section/Density", "-1", "must not be negative"],
     {"Section/Density": "-1", "Loads/Gravity": "0, 0, -9.81"})

# --- Study -----------------------------------------------------------------
for name, value in (("zero", "0"), ("negative", "-5")):
    case("eta_" + name, ["Study/Penalties", value, "not positive"],
         {"Study/Penalties": value})
case("eta_too_small",
     ["is below the bound", "not positive definite", "negative pivots",
      "Study/Penalties: eta = 1e-06 is too small"],
     {"Study/Penalties": "1e-6", "Study/Degrees": "3"})
case("eta_unknown_word",
     ["Study/Penalties, 'default' or a number", "unknown name 'defualt'"],
     {"Study/Penalties": "defualt"})
case("eta_none", ["Study/Penalties", "'default' or a number"],
     {"Study/Penalties": ""})
case("thicknesses_negative", ["Study/Thicknesses", "'-0.1'", "not positive"],
     {"Study/Thicknesses": "0.1, -0.1"})
case("degree_1", ["Degrees", "'1'", "at least 1", "2 <= n <= 5"],
     {"Study/Degrees": "1"})
case("degree_6", ["Degrees", "'2, 6'", "2", "5"], {"Study/Degrees": "2, 6"})
case("degree_none", ["Degrees", "''", "not allowed"], {"Study/Degrees": ""})
case("degree_not_a_number", ["Degrees", "'two'", "not allowed"],
     {"Study/Degrees": "two"})
case("refinement_negative", ["Refinements", "'-1'", "not allowed"],
     {"Study/Refinements": "-1"})
case("refinements_none", ["Refinements", "''", "not allowed"],
     {"Study/Refinements": ""})
case("name_is_a_path", ["Study/Name", "'a/b'", "Output folder"],
     {"Study/Name": "a/b"})
case("not_a_bool", ["Write VTU", "'maybe'", "true", "false"],
     {"Study/Write VTU": "maybe"})
case("output_folder_is_a_file",
     ["output folder", "'results'", "Study/Output folder"],
     {"Study/Output folder": "results"}, folder={"results": "a file\n"})
case("output_folder_below_a_file",
     ["output folder", "'results/a'", "Study/Output folder"],
     {"Study/Output folder": "results/a"}, folder={"results": "a file\n"})
case("output_file_is_a_folder",
     ["results/case.used.prm", "can't be written"],
     {"Study/Output folder": "results"},
     folder={"results/case.used.prm/x": ""})
case("result_file_is_a_folder",
     ["results/case.txt", "can't be written"],
     {"Study/Output folder": "results"}, folder={"results/case.txt/x": ""})

# --- Form of the file ------------------------------------------------------
case("misspelt_section",
     ["line 8", "unknown subsection 'Mid-surfaces'", "'Mid-surface'?"],
     change=("subsection Mid-surface\n", "subsection Mid-surfaces\n"))
case("misspelt_parameter",
     ["line 18", "'Section'", "unknown parameter 'Thicknes'",
      "Did you mean 'Thickness'?"],
     change=("Thickness       =", "Thicknes       ="))
case("misspelt_statement", ["line 18", "unknown statement", "set"],
     change=("set Thickness ", "sett Thickness "))
case("parameter_in_wrong_section",
     ["subsection 'Loads'", "unknown parameter 'Thickness'", "Pressure"],
     change=("set Force per area = 0, 0, -q", "set Thickness = 1"))
case("missing_end", ["'end'", "'Section'", "missing", "line 15"],
     change=("0.05\nend\n", "0.05\n"))
case("missing_last_end",
     ["the 'end' of subsection 'Quantities'", "is missing"],
     change=("U = energy\nend\n", "U = energy\n"))
case("end_too_many", ["'end' has no 'subsection'"],
     change=("0.05\nend\n", "0.05\nend\nend\n"))
case("no_equals_sign", ["line 18", "has no '='"],
     change=("Thickness       = 0.05", "Thickness 0.05"))
case("value_out_of_pattern", ["Mapping degree", "'9'", "not allowed", "6"],
     {"Discretization/Mapping degree": "9"})
case("unknown_element", ["Element", "unknown value 'Lagrang'", "'Lagrange'?"],
     {"Discretization/Element": "Lagrang"})
for element in ("serendipity", "triangle"):
    case(f"{element}_of_degree_3",
         ["Study/Degrees", f"'{element}'", "of degree 2", "found 3"],
         {"Discretization/Element": element, "Study/Degrees": "3"})
    case(f"{element}_mapping_degree_3",
         ["Discretization/Mapping degree", f"'{element}'", "0 or 2", "found 3"],
         {"Discretization/Element": element,
          "Discretization/Mapping degree": "3"})
case("unknown_membrane_strain",
     ["Membrane strain", "unknown value 'tide'", "'tied'?", "reduced"],
     {"Discretization/Membrane strain": "tide"})
case("unknown_edge_form",
     ["Edge form", "unknown value 'averaged normals'", "'averaged normal'?"],
     {"Discretization/Edge form": "averaged normals"})
case("corotational_averaged_normal",
     ["Discretization/Edge form", "'averaged normal'", "rotation jump"],
     {"Discretization/Edge form": "averaged normal",
      "Discretization/Kinematics": "corotational", "Analysis/Type": "static"})

case("finite_frozen_tangent",
     ["Discretization/Tangent", "'frozen'", "choose 'symmetric'"],
     {"Discretization/Tangent": "frozen",
      "Discretization/Kinematics": "finite", "Analysis/Type": "static"})

# --- Constants and expressions ---------------------------------------------
case("constant_without_value", ["Constants", "'b'", "has no value"],
     {"Constants": "a = 2, q = 1, b"})
case("constant_bad_name", ["Constants", "'2b'", "can't be the name"],
     {"Constants": "a = 2, q = 1, 2b = 3"})
case("constant_shadows_coordinate",
     ["Constants", "'x'", "it is a coordinate"],
     {"Constants": "a = 2, q = 1, x = 3"})
case("constant_shadows_pi", ["Constants", "'pi'", "3.14159"],
     {"Constants": "a = 2, q = 1, pi = 3"})
case("constant_shadows_function", ["Constants", "'sin'", "it is a function"],
     {"Constants": "a = 2, q = 1, sin = 3"})
case("constant_shadows_section",
     ["Constants", "'h'", "section's", "another name"],
     {"Constants": "a = 2, q = 1, h = 3"})
case("poissons_ratio_expression",
     ["Section/Poisson's ratio", "'0.3*x'", "unknown name 'x'"],
     {"Section/Poisson's ratio": "0.3*x"})
case("constant_twice", ["Constants", "'q'", "before"],
     {"Constants": "a = 2, q = 1, q = 3"})
case("constant_division_by_zero", ["Constants/b", "'1/0'", "finite"],
     {"Constants": "a = 2, q = 1, b = 1/0"})
case("expression_malformed",
     ["Loads/Force per area (z)", "'-q*'", "not a valid expression"],
     {"Loads/Force per area": "0, 0, -q*"})
case("expression_parenthesis", ["Loads/Pressure", "'(1 + 2'", "parenthesis"],
     {"Loads/Pressure": "(1 + 2"})
case("expression_unknown_name",
     ["Loads/Pressure", "'2*sim(x)'", "unknown name 'sim'", "'sin'"],
     {"Loads/Pressure": "2*sim(x)"})
case("expression_unknown_constant",
     ["Loads/Force per area (z)", "unknown name 'Q'", "'q'"],
     {"Loads/Force per area": "0, 0, Q"})
case("expression_random", ["Loads/Pressure", "'rand()'", "random"],
     {"Loads/Pressure": "rand()"})
case("expression_assigns", ["Loads/Pressure", "'x = 1'", "="],
     {"Loads/Pressure": "x = 1"})
case("load_division_by_zero",
     ["Loads/Pressure", "'1/(x-x)'", " at ", "must be finite"],
     {"Loads/Pressure": "1/(x-x)"})
case("load_not_a_number",
     ["Loads/Force per area (z)", "'sqrt(-1-x)'", "must be finite"],
     {"Loads/Force per area": "0, 0, sqrt(-1-x)"})
case("load_not_finite_somewhere",
     ["Loads/Force per area (z)", "'sqrt(1-x)'", "must be finite"],
     {"Loads/Force per area": "0, 0, sqrt(1-x)"})
case("load_constant_not_a_number",
     ["Loads/Pressure", "'0/0'", "must be finite"], {"Loads/Pressure": "0/0"})

# --- Surfaces --------------------------------------------------------------
case("misspelt_surface",
     ["Mid-surface/Surface", "unknown surface 'cilinder'", "'cylinder'?",
      "hyperbolic paraboloid"],
     {"Mid-surface/Surface": "cilinder"})
case("radius_negative",
     ["Mid-surface/cylinder/Radius", "-1", "greater than zero"],
     {"Mid-surface/Surface": "cylinder",
      "Mid-surface/cylinder/Radius": "-1"})
case("size_zero", ["Mid-surface/plate/Size", "0", "greater than zero"],
     {"Mid-surface/plate/Size": "a, 0"})
case("size_one_number", ["Mid-surface/plate/Size", "two numbers", "'a'"],
     {"Mid-surface/plate/Size": "a"})
case("range_reversed",
     ["Mid-surface/cylinder/Axial range", "from 1 to 0", "reversed"],
     {"Mid-surface/Surface": "cylinder", "Mid-surface/Subdivisions": "4, 2",
      "Mid-surface/cylinder/Axial range": "1, 0"})
case("angle_range_too_long",
     ["Mid-surface/cylinder/Angle range", "400", "360"],
     {"Mid-surface/Surface": "cylinder",
      "Mid-surface/cylinder/Angle range": "0, 400"})
case("axis_unknown",
     ["Mid-surface/cylinder/Axis", "unknown choice 'w'", "x, y, z"],
     {"Mid-surface/Surface": "cylinder", "Mid-surface/cylinder/Axis": "w"})
case("torus_meets_itself",
     ["Mid-surface/torus/Minor radius", "less than the major radius"],
     {"Mid-surface/Surface": "torus", "Mid-surface/Subdivisions": "4",
      "Mid-surface/torus/Minor radius": "3"})
case("fold_angle", ["Mid-surface/folded strip/Fold angle", "180"],
     {"Mid-surface/Surface": "folded strip",
      "Mid-surface/folded strip/Fold angle": "180"})
case("hole_angle", ["Mid-surface/hemisphere/Hole angle", "95", "90"],
     {"Mid-surface/Surface": "hemisphere",
      "Mid-surface/hemisphere/Hole angle": "95"})
case("disk_part", ["Mid-surface/disk/Part", "'quater'", "'quarter'?"],
     {"Mid-surface/Surface": "disk", "Mid-surface/disk/Part": "quater"})
case("patches_two_subdivisions",
     ["Mid-surface/Subdivisions", "'2, 3'", "one number"],
     {"Mid-surface/Surface": "disk", "Mid-surface/Subdivisions": "2, 3"})
case("subdivisions_zero", ["Mid-surface/Subdivisions", "0", "between 1 and"],
     {"Mid-surface/Subdivisions": "0"})
case("subdivisions_none", ["Mid-surface/Subdivisions", "''", "one or two"],
     {"Mid-surface/Subdivisions": ""})
case("grading_none", ["Mid-surface/Grading u is empty"],
     {"Mid-surface/Grading u": ""})
case("subdivisions_fraction", ["Mid-surface/Subdivisions", "2.5", "whole"],
     {"Mid-surface/Subdivisions": "2.5"})
case("subdivisions_closed",
     ["Mid-surface/Subdivisions", "2", "closed", "at least 3"],
     {"Mid-surface/Surface": "cylinder"})
case("grading_wrong_end",
     ["Mid-surface/Grading u", "'2*s'", "from 0 to 1"],
     {"Mid-surface/Grading u": "2*s"})
case("grading_falls", ["Mid-surface/Grading v", "doesn't grow between"],
     {"Mid-surface/Grading v": "s*(4*s^2 - 4*s + 1)"})
case("position_two_components",
     ["Mid-surface/expression/Position", "three expressions", "'u, v'"],
     {"Mid-surface/Surface": "expression",
      "Mid-surface/expression/Position": "u, v"})
case("position_unknown_name",
     ["Mid-surface/expression/Position", "unknown name 'x'", "u, v"],
     {"Mid-surface/Surface": "expression",
      "Mid-surface/expression/Position": "u, v, x"})
case("position_not_finite",
     ["Mid-surface/expression/Position", "'1/u'", "finite"],
     {"Mid-surface/Surface": "expression",
      "Mid-surface/expression/Position": "u, v, 1/u"})
case("surface_degenerate_pole",
     ["Mid-surface/expression", "degenerate", "Jacobian"],
     {"Mid-surface/Surface": "expression",
      "Mid-surface/expression/Position": "u*cos(v), u*sin(v), 0"})
case("surface_degenerate_line",
     ["Mid-surface/expression", "degenerate", "Jacobian"],
     {"Mid-surface/Surface": "expression",
      "Mid-surface/expression/Position": "u, u, u"})
for name, x in (("fold", "abs(u - 0.3)"), ("cusp", "(u - 0.31)^2")):
    case("surface_degenerate_" + name,
         ["Mid-surface/expression", "degenerate", "turns back", "between"],
         {"Mid-surface/Surface": "expression", "Quantities/Quantities": "",
          "Mid-surface/expression/Position": x + ", v, 0"})
case("surface_does_not_meet",
     ["Mid-surface/expression", "closed"],
     {"Mid-surface/Surface": "expression",
      "Mid-surface/Subdivisions": "4, 2",
      "Mid-surface/expression/Position": "cos(u), sin(u), v",
      "Mid-surface/expression/Range u": "0, 6",
      "Mid-surface/expression/Closed": "u"})

# --- Conditions ------------------------------------------------------------
EDGES = "Boundary conditions/Edges"
POINTS = "Boundary conditions/Points"
case("misspelt_edge", [EDGES, "unknown edge 'u=2'", "'u=0'", "v=1"],
     {EDGES: "u=2: clamped"})
case("edge_of_closed_surface",
     [EDGES, "unknown edge 'u=0'", "Known: v=0, v=1"],
     {"Mid-surface/Surface": "cylinder", "Mid-surface/Subdivisions": "4, 2"})
case("surface_without_edges", [EDGES, "unknown edge 'u=0'", "no edges"],
     {"Mid-surface/Surface": "sphere"})
case("misspelt_condition",
     [EDGES, "'u=0'", "unknown condition 'clampd'", "'clamped'?",
      "diaphragm"],
     {EDGES: "u=0: clampd"})
case("misspelt_component",
     [EDGES, "'u=0'", "unknown condition 'conorml'", "'conormal'"],
     {EDGES: "u=0: conorml = 0"})
case("condition_without_value", [EDGES, "'x' needs a value", "x = 0"],
     {EDGES: "u=0: x"})
case("condition_without_colon", [EDGES, "'u=0 clamped'", "has no ':'"],
     {EDGES: "u=0 clamped"})
case("condition_without_edge", [EDGES, "': fixed'", "names no edge"],
     {EDGES: ": fixed"})
case("condition_list_ends_in_comma", [EDGES, "part 2 of 'fixed,' is empty"],
     {EDGES: "u=0: fixed,"})
case("edge_without_condition", [EDGES, "'u=0'", "no condition", "free"],
     {EDGES: "u=0:"})
case("edge_twice", [EDGES, "'u=0'", "conditions twice"],
     {EDGES: "u=0: clamped; u=0: x = 1"})
case("component_twice", [EDGES, "'u=0'", "prescribes 'x' a second time"],
     {EDGES: "u=0: x = 0, x = 1; u=1: fixed"})
case("component_after_clamped",
     [EDGES, "'u=0'", "'z = 1'", "a second time"],
     {EDGES: "u=0: clamped, z = 1"})
case("rotation_twice", [EDGES, "rotation", "a second time"],
     {EDGES: "u=0: clamped, rotation = 1"})
case("contradiction_at_corner",
     ["Contradicting conditions at the point (0, 0, 0)", "'u=0'", "'v=0'",
      "z = 1"],
     {EDGES: "u=0: clamped; v=0: z = 1"})
case("contradiction_on_edge",
     ["Contradicting conditions at the point (", "conormal = 1", "x = 0"],
     {EDGES: "u=0: x = 0, y = 0, z = 0, conormal = 1; u=1: fixed"})
# Small values contradict as large ones do, where normals are but nearly axes.
case("contradiction_of_small_values",
     ["Contradicting conditions at the point (1, 0, 0)", "x = 0",
      "normal = 1e-9"],
     {"Mid-surface/Surface": "sphere", "Mid-surface/sphere/Part": "octant",
      "Study/Refinements": "1",
      EDGES: "y=0: normal = 1e-9; equator: x = 0"})
# Two directions of the diaphragm lie in what u=0 and the other one prescribe.
case("contradiction_of_two_directions",
     ["Contradicting conditions", "diaphragm' against", "edge 'u=0': y = 0"],
     {"Mid-surface/Surface": "expression",
      "Mid-surface/expression/Position":
      "0.8*u + 0.15*u^2, v - 0.3*u, -0.09*u^2",
      EDGES: "u=0: x = 1, y = 0; v=0: diaphragm; u=1: fixed"})
case("contradiction_at_support",
     ["Contradicting conditions at the point (0, 0, 0)", POINTS, "z = 1"],
     {POINTS: "(0, 0, 0): z = 1"})
case("condition_not_finite", [EDGES, "'u=0'", "1/(x-x)", "must be finite"],
     {EDGES: "u=0: x = 0, y = 0, z = 1/(x-x), rotation = 0"})
case("symmetry_not_plane",
     [EDGES, "'v=0'", "symmetry", "lies in no plane"],
     {"Mid-surface/Surface": "expression",
      "Mid-surface/expression/Position": "u, v + u^2, u^3*(1 - v)",
      EDGES: "u=0: clamped; v=0: symmetry"})
case("support_off_the_mesh",
     [POINTS, "(0.1, 0.1, 0.5)", "lies off the mid-surface by 0.5",
      "nearest point of the mesh is (0.1, 0.1, 0)"],
     {POINTS: "(0.1, 0.1, 0.5): x = 0"})
case("support_two_components", [POINTS, "(0, 0)", "2 components"],
     {POINTS: "(0, 0): x = 0"})
case("support_condition", [POINTS, "'clamped'", "'x = value'", "'fixed'"],
     {POINTS: "(0, 0, 0): clamped"})
case("support_without_condition", [POINTS, "(2, 1, 0)", "no condition"],
     {POINTS: "(2, 1, 0):"})

case("point_support_twice",
     ["Contradicting conditions at the point (1, 0.5, 0)", "x = 1", "x = 0"],
     {POINTS: "(1, 0.5, 0): x = 0; (1, 0.5, 0): x = 1"})

# --- Free motions ----------------------------------------------------------
case("free_plate",
     ["Boundary conditions", "can move freely", "translation along (1, 0, 0)",
      "translation along (0, 1, 0)", "translation along (0, 0, 1)",
      "rotation about (1, 0, 0)", "rotation about (0, 1, 0)",
      "rotation about (0, 0, 1)"],
     {EDGES: ""})
case("plate_may_slide",
     ["can move freely: translation along (0, 1, 0)"],
     {EDGES: "u=0: x = 0, z = 0; u=1: x = 0, z = 0"})
case("plate_may_turn",
     ["can move freely: rotation about (0, 1, 0) through (0, 0.5, 0)"],
     {EDGES: "u=0: fixed"})
case("roof_may_slide",
     ["can move freely: translation along (0, 1, 0)"],
     {"Mid-surface/Surface": "cylinder", "Mid-surface/cylinder/Axis": "y",
      "Mid-surface/cylinder/Radius": "25",
      "Mid-surface/cylinder/Axial range": "0, 50",
      "Mid-surface/cylinder/Angle range": "-40, 40",
      EDGES: "v=0, v=1: diaphragm"})

# --- Loads -----------------------------------------------------------------
case("force_two_components", ["Loads/Force per area", "'0, 1'", "three"],
     {"Loads/Force per area": "0, 1"})
case("edge_force_on_unknown_edge",
     ["Loads/Edge forces", "unknown edge 'u=3'", "u=1"],
     {"Loads/Edge forces": "u=3: 0, 0, 1"})
case("edge_force_twice", ["Loads/Edge forces", "'u=1'", "twice"],
     {"Loads/Edge forces": "u=1: 0, 0, 1; u=1: 0, 0, 2"})
case("edge_force_not_finite",
     ["Loads/Edge forces", "'v=1'", "1/(y-y)", "must be finite"],
     {"Loads/Edge forces": "v=1: 0, 0, 1/(y-y)"})
case("load_not_finite_on_one_rank",
     ["Loads/Pressure", "'sqrt(1.9-x)'", "must be finite"],
     {"Loads/Pressure": "sqrt(1.9-x)", "Mid-surface/Subdivisions": "8, 2"})
case("edge_force_not_finite_on_one_rank",
     ["Loads/Edge forces", "'1/(2-x)'", "must be finite"],
     {"Loads/Edge forces": "u=1: 1/(2-x), 0, 0",
      "Mid-surface/Subdivisions": "8, 2"})
case("edge_force_without_edge", ["Loads/Edge forces", "names no place"],
     {"Loads/Edge forces": ": 1, 0, 0"})
case("load_overflows", ["quantity 'w'", "not a finite number"],
     {"Constants": "a = 2, q = 1e308"})
case("edge_moment_of_three", ["Loads/Edge moments", "'u=1'", "one expression"],
     {"Loads/Edge moments": "u=1: 0, 0, 1"})
case("edge_moment_without_colon", ["Loads/Edge moments", "'u=1 5'", "no ':'"],
     {"Loads/Edge moments": "u=1 5"})
case("point_force_off_the_mesh",
     ["Loads/Point forces", "off the mid-surface", "nearest point",
      re.compile(r"\(\s*1,? 0.5,? -?0\)")],
     {"Loads/Point forces": "(1, 0.5, 1): 0, 0, 1"})
case("point_force_two_components",
     ["Loads/Point forces", "'0, 1'", "2 components"],
     {"Loads/Point forces": "(1, 0.5, 0): 0, 1"})

# --- Quantities ------------------------------------------------------------
QUANTITIES = "Quantities/Quantities"
case("misspelt_quantity",
     [QUANTITIES, "'w'", "unknown kind of quantity 'enregy'", "'energy'",
      "maximum displacement"],
     {QUANTITIES: "w = enregy"})
case("quantity_without_kind", [QUANTITIES, "'energy'", "name = kind"],
     {QUANTITIES: "energy"})
case("quantity_named_as_column", [QUANTITIES, "'dofs'", "another column"],
     {QUANTITIES: "dofs = energy"})
case("quantity_twice", [QUANTITIES, "named 'w'"],
     {QUANTITIES: "w = energy; w = bending energy"})
case("quantity_without_name", [QUANTITIES, "no name"],
     {QUANTITIES: "= energy"})
case("quantity_more_words", [QUANTITIES, "'w'", "'of all'"],
     {QUANTITIES: "w = energy of all"})
case("free_torus",
     ["can move freely: rotation about (1, 0, 0) through (0, 0, 0); "
      "rotation about (0, 1, 0) through (3, 0, 0); "
      "rotation about (0, 0, 1) through (3, 0, 0)"],
     {"Mid-surface/Surface": "torus", "Mid-surface/Subdivisions": "4",
      EDGES: "", POINTS: "(3, 0, 0): fixed", QUANTITIES: ""})
case("quantity_direction", [QUANTITIES, "'w'", "unknown direction 'Z'", "'z'"],
     {QUANTITIES: "w = displacement Z at (1, 0.5, 0)"})
case("quantity_direction_zero", [QUANTITIES, "'w'", "no length"],
     {QUANTITIES: "w = displacement (0, 0, 0) at (1, 0.5, 0)"})
case("quantity_without_point",
     [QUANTITIES, "'w'", "displacement z at (x, y, z)"],
     {QUANTITIES: "w = displacement z"})
case("quantity_off_the_mesh",
     [QUANTITIES, "'w'", "off the mid-surface", "nearest point",
      re.compile(r"\(2, 0.5, -?0\)")],
     {QUANTITIES: "w = displacement z at (3, 0.5, 0)"})
case("quantity_unknown_edge", [QUANTITIES, "'R'", "unknown edge 'u=7'", "u=1"],
     {QUANTITIES: "R = reaction x of u=7"})
case("quantity_reaction_form", [QUANTITIES, "'R'", "reaction x of EDGE"],
     {QUANTITIES: "R = reaction x"})
case("reference_zero", [QUANTITIES, "'w'", "reference", "0"],
     {QUANTITIES: "w = displacement z at (1, 0.5, 0) -> 0"})
case("reference_malformed", [QUANTITIES, "'w'", "not a valid expression"],
     {QUANTITIES: "w = energy -> 1 +"})
case("reference_empty", [QUANTITIES, "'w', the reference", "is empty"],
     {QUANTITIES: "w = energy ->"})
case("error_without_exact_solution",
     [QUANTITIES, "'e'", "'L2 error'", "Exact solution/Displacement"],
     {QUANTITIES: "e = L2 error"})
case("exact_solution_two_components",
     ["Exact solution/Displacement", "three", "'x, y'"],
     {"Exact solution/Displacement": "x, y"})
case("exact_solution_not_finite",
     ["Exact solution/Displacement", "log(-1-x)", "must be finite"],
     {"Exact solution/Displacement": "x, y, log(-1-x)",
      QUANTITIES: "e = L2 error"})

# --- Command line ----------------------------------------------------------
case("empty_file", ["can move freely"], prm="")
case("no_parameter_file", ["line 1", "unknown statement"],
     prm="\x7fELF\x01 nothing\n")
case("unknown_short_option", ["unknown option '-x'", "--set"],
     args=["{prm}", "-x"], code=2)
case("file_missing", ["'nowhere.prm'", "doesn't exist"], prm=None,
     args=["nowhere.prm"])
case("file_is_a_folder", ["'here'", "is a folder"], prm=None, args=["here"],
     folder={"here/x": ""})
case("no_file", ["no parameter file", "Usage", "--help"], prm=None, code=2)
case("two_files", ["more than one parameter file", "Usage"],
     args=["{prm}", "{prm}"], code=2)
case("unknown_option", ["unknown option", "'--chek'", "'--check'?"],
     args=["{prm}", "--chek"], code=2)
case("set_without_argument", ["command line", "--set", "--help"],
     args=["{prm}", "--set"], code=2)
case("set_without_equals",
     ["--set", "Section/Thickness", "has no '='", "Section/Parameter=value"],
     args=["--set", "Section/Thickness"])
case("set_unknown_section",
     ["--set", "unknown section 'Sektion'", "'Section'?"],
     args=["--set", "Sektion/Thickness=1"])
case("set_unknown_parameter",
     ["--set", "unknown parameter 'thickness'", "'Thickness'?"],
     args=["--set", "Section/thickness=1"])
case("set_value_out_of_pattern",
     ["--set", "Study/Degrees=7", "'7'", "not allowed"],
     args=["--set", "Study/Degrees=7"])
case("set_bad_value", ["Section/Thickness", "-1", "positive"],
     args=["--set", "Section/Thickness=-1"])
case("check_finds_error", ["unknown condition 'clampd'"],
     {EDGES: "u=0: clampd"}, args=["--check"])
