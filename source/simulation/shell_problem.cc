// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/kinematics.h>
#include <nacre/simulation/crack_growth.h>
#include <nacre/simulation/shell_problem.h>

#include <utility>

namespace Nacre
{
  const Selection<AssemblyMethod> &
  selection(AssemblyMethod)
  {
    static const Selection<AssemblyMethod> table = {
      {AssemblyMethod::fast, "fast"},
      {AssemblyMethod::reference, "reference"}};
    return table;
  }

  DiscretizationParameters::DiscretizationParameters()
    : ParameterAcceptor("/Discretization")
  {
    add_parameter(
      "Element",
      element_,
      "Displacement element, continuous: Lagrange, (p+1)^2 nodes on "
      "quadrilaterals, p = 2 to 5; serendipity, 8 nodes; "
      "triangle, 6 nodes on halves of the quadrilaterals.");
    add_parameter("Mapping degree",
                  mapping_degree_,
                  "Degree of the mid-surface's geometry, 1 to 6; 0 is that of "
                  "the element (isoparametric), the only one for other than "
                  "Lagrange cells. Above the element's degree, rigid rotations "
                  "store some energy.",
                  prm,
                  Patterns::Integer(0, 6));
    add_parameter("Membrane strain",
                  membrane_strain_,
                  "tied: sampled at Gauss points and interpolated, free of "
                  "membrane locking; full: integrated as it is, locks; "
                  "reduced: p x p points with a share of full integration, for "
                  "8-node cells 2 x 2 points and for triangles 3 points for "
                  "the bending strain as well; default: reduced for 8-node "
                  "cells, tied for all others.");
    add_parameter(
      "Edge form",
      kinematics_.edge_form,
      "rotation jump: rotations and moments of an edge in each cell's own "
      "frame, independent of creases; averaged normal: in a frame "
      "with the mean of both cells' normals, the same where the "
      "surface is smooth, but dependent on the angle of a crease.");
    add_parameter("Kinematics",
                  kinematics_.model,
                  "linear: small displacements; corotational: large rotations "
                  "with small strains, in frames that turn with the material; "
                  "finite: exact rotations and Green strains of any size, one "
                  "energy with its exact gradient and symmetric derivative.");
    add_parameter("Tangent",
                  kinematics_.tangent,
                  "Of co-rotational kinematics: symmetric, the symmetric part "
                  "of the derivative of the internal forces, which converges "
                  "as fast, since the rest is small; frozen, the derivative "
                  "with the rotations held, which needs many more iterations "
                  "and may not converge; consistent, the derivative itself, "
                  "is refused: it is unsymmetric, and the solvers are for "
                  "symmetric matrices. Of finite kinematics: consistent, the "
                  "derivative; symmetric, the same but at edges that are far "
                  "from their prescribed rotation, which Newton's method then "
                  "reaches from further away.");
    add_parameter(
      "Assembly",
      assembly_,
      "fast: tables and blocks of nodes; reference: a textbook's "
      "loop over FEValues and FEInterfaceValues, several times "
      "slower, for linear analyses in the rotation-jump form. Both give "
      "the same numbers.");
  }

  Element
  DiscretizationParameters::element(const unsigned int degree) const
  {
    if (element_ == ElementType::lagrange)
      return {element_, degree};
    AssertThrow(degree == 2,
                ExcMessage("Study/Degrees: the element '" + name_of(element_) +
                           "' is of degree 2; found " + std::to_string(degree) +
                           "."));
    AssertThrow(mapping_degree_ == 0 || mapping_degree_ == 2,
                ExcMessage("Discretization/Mapping degree: the element '" +
                           name_of(element_) +
                           "' is isoparametric: 0 or 2; found " +
                           std::to_string(mapping_degree_) + "."));
    return {element_, degree};
  }

  KinematicsOptions
  DiscretizationParameters::kinematics() const
  {
    KinematicsOptions options = kinematics_;
    options.membrane_strain =
      membrane_strain_.value_or(default_membrane_strain(element_));
    return options;
  }


  namespace
  {
    const std::string direction_name = "Reference direction";
    const std::string top_name       = "Top";
  } // namespace

  ResultAxesParameters::ResultAxesParameters()
    : ParameterAcceptor("/Output")
  {
    add_parameter(
      direction_name,
      direction_,
      "The axis 1 of stresses, forces and moments in fields and quantities: "
      "the projection of x, y, z or of a vector, e.g. '-y, x, 0', onto the "
      "surface, whose components may be expressions of x, y, z; empty: the "
      "first coordinate of each cell. The axis 2 is the normal times the axis "
      "1. Units: none.");
    add_parameter(
      top_name,
      top_,
      "The side of the top, where the normal of the results points to: "
      "'normal', that of the surface's normal, or that of a vector, e.g. '0, "
      "0, 1', which may be an expression of x, y, z. Units: none.");
  }

  SurfaceAxes
  ResultAxesParameters::make(const Constants &constants) const
  {
    SurfaceAxes axes;
    axes.direction_parameter = "Output/" + direction_name;
    axes.top_parameter       = "Output/" + top_name;
    if (!direction_.empty())
      axes.direction =
        read_direction(direction_, axes.direction_parameter, constants);
    if (top_ != "normal")
      axes.top = read_direction(top_, axes.top_parameter, constants);
    return axes;
  }


  ProblemParameters::ProblemParameters(
    std::unique_ptr<SectionParameters> section)
    : section_(std::move(section))
  {}

  ShellProblem
  ProblemParameters::make(const Constants          &constants_of_file,
                          const ShellCase          &shell_case,
                          std::optional<Midsurface> previous)
  {
    const Element element = discretization_.element(shell_case.degree);
    Constants     constants =
      all_constants(constants_of_file, shell_case.thickness);
    Midsurface midsurface   = midsurface_.make(constants, std::move(previous));
    auto       section      = section_->make(constants_of_file,
                                  shell_case.thickness,
                                  midsurface.regions());
    auto       edges_in_use = supports_.named_edges();
    for (const std::string &name : loads_.named_edges())
      edges_in_use.push_back(name);
    midsurface.use_edges(edges_in_use);

    ShellProblem problem{{std::move(midsurface), std::move(section)}};
    ShellModel  &model   = problem.model;
    model.supports       = supports_.make(model.midsurface, constants);
    model.cuts           = cuts_.make(constants, model.midsurface);
    model.loads          = loads_.make(model.midsurface, constants, model.cuts);
    model.exact_solution = exact_solution_.make(constants);
    model.element        = element;
    model.mapping_degree = discretization_.mapping_degree();
    model.kinematics     = discretization_.kinematics();
    model.eta            = shell_case.eta;
    model.result_axes    = result_axes_.make(constants);
    model.foundation = foundation_.make(constants, model.midsurface.regions());

    Expression load_factor = analysis_.load_factor(constants);
    problem.path           = analysis_.make(constants);
    problem.modes          = modes_.make(problem.path.type,
                                !problem.path.start_from.empty(),
                                constants);
    if (!problem.path.is_linear())
      model.load_factor = std::move(load_factor);
    model.cuts.tips_turn = takes_finite_rotations(problem);
    problem.growth =
      growth_.make(constants,
                   model.cuts,
                   !problem.path.is_linear(),
                   model.kinematics.model == KinematicsModel::linear &&
                     model.section->is_linear());
    problem.n_refinements = shell_case.n_refinements;
    problem.solver        = solver_.values;
    problem.assembly      = discretization_.assembly();
    problem.constants     = std::move(constants);
    check(problem);
    check_growth(problem);
    return problem;
  }

  Constants
  ProblemParameters::all_constants(const Constants             &constants,
                                   const std::optional<double> &thickness) const
  {
    Constants result = constants;
    for (const auto &[name, value] :
         section_->named_constants(constants, thickness))
      {
        AssertThrow(constants.count(name) == 0,
                    ExcMessage("Constants: '" + name +
                               "' is the section's; choose another name."));
        result[name] = value;
      }
    return result;
  }

  bool
  ProblemParameters::takes_finite_rotations(const ShellProblem &problem)
  {
    const PrestressKind prestress = problem.modes.prestress;
    return problem.model.kinematics.model != KinematicsModel::linear ||
           (seeks_modes(problem.path.type) &&
            (prestress == PrestressKind::forces_and_moments ||
             prestress == PrestressKind::tangent));
  }

  void
  ProblemParameters::check_tips(const ShellProblem &problem)
  {
    if (problem.model.cuts.tips == CutTips::closed)
      return;
    const std::string tips = "'" + name_of(problem.model.cuts.tips) + "'";
    AssertThrow(problem.model.kinematics.edge_form == EdgeForm::rotation_jump,
                ExcMessage("Cuts/Tips: " + tips +
                           " is for 'Edge form = rotation jump'; choose "
                           "'closed'."));
    AssertThrow(problem.model.cuts.tips == CutTips::branch_functions ||
                  problem.model.element.type != ElementType::triangle,
                ExcMessage("Cuts/Tips: " + tips +
                           " is for quadrilaterals; choose 'closed' or "
                           "'branch functions' for triangles."));
  }

  namespace
  {
    /** What a section with memory doesn't know. */
    void
    check_memory(const ShellProblem &problem)
    {
      const PathParameters &path   = problem.path;
      const Growth         &growth = problem.growth;
      AssertThrow(path.start_from.empty(),
                  ExcMessage("Analysis/Start from: what this section remembers "
                             "doesn't come from another run; leave it empty, "
                             "or go on with --restart."));
      AssertThrow(!path.branches.has_several(),
                  ExcMessage("Analysis/Switch branch: this section remembers "
                             "one path; name a single branch."));
      AssertThrow(problem.solver.type != SolverType::multigrid,
                  ExcMessage("Linear solver/Solver: the coarse levels of "
                             "'multigrid' don't know what this section "
                             "remembers; choose auto or direct."));
      if (!growth.is_on())
        return;
      AssertThrow(!growth.is_by_energy(),
                  ExcMessage("Growth/Criterion: what this section takes up "
                             "depends on its path, so that it has no 'energy "
                             "release rate'; choose 'strength' or "
                             "'prescribed'."));
      AssertThrow(growth.is_prescribed() ||
                    path.type != AnalysisType::arc_length,
                  ExcMessage("Growth/Criterion: 'Analysis/Type = arc length' "
                             "goes back to where 'strength' is just reached, "
                             "and this section remembers that it was beyond; "
                             "choose static or displacement control, or "
                             "'prescribed'."));
    }
  } // namespace

  void
  ProblemParameters::check_section(const ShellProblem &problem)
  {
    const SectionLaw     &section = *problem.model.section;
    const PathParameters &path    = problem.path;
    if (section.is_linear())
      return;
    const std::string is_not = " and the law of this section isn't linear";
    AssertThrow(!path.is_linear() && !seeks_modes(path.type),
                ExcMessage("Analysis/Type: '" + name_of(path.type) +
                           "' is for linear sections only," + is_not +
                           "; choose static or another path."));
    AssertThrow(!path.is_dynamic() ||
                  path.scheme != TimeScheme::energy_momentum,
                ExcMessage("Analysis/Scheme: 'energy momentum' conserves the "
                           "energy of linear sections only," +
                           is_not + "; choose another scheme."));
    AssertThrow(problem.model.cuts.tips == CutTips::closed,
                ExcMessage("Cuts/Tips: '" + name_of(problem.model.cuts.tips) +
                           "' is for linear sections only," + is_not +
                           "; choose closed."));
    if (section.n_state_variables() > 0)
      check_memory(problem);
    const Growth &growth = problem.growth;
    AssertThrow(!growth.is_on() || !growth.is_by_energy() ||
                  growth.direction != GrowthDirection::hoop_stress,
                ExcMessage("Growth/Direction: 'hoop stress' takes the stress "
                           "intensity factors of linear sections," +
                           is_not +
                           "; choose 'straight' or a vector 'dx, dy, dz'."));
  }

  namespace
  {
    /** Edge form, tangent and assembly. */
    void
    check_forms(const ShellProblem &problem)
    {
      const KinematicsOptions &options = problem.model.kinematics;
      const bool               has_rotation_jump =
        options.edge_form == EdgeForm::rotation_jump;
      AssertThrow(options.model == KinematicsModel::linear || has_rotation_jump,
                  ExcMessage("Discretization/Edge form: co-rotational and "
                             "finite kinematics have 'rotation jump' only; "
                             "found '" +
                             name_of(options.edge_form) + "'."));
      AssertThrow(options.tangent != TangentType::consistent ||
                    options.model != KinematicsModel::corotational,
                  ExcMessage("Discretization/Tangent: 'consistent', the "
                             "derivative itself, is an unsymmetric matrix, and "
                             "the solvers are for symmetric ones; choose "
                             "'symmetric', its symmetric part, which is what "
                             "'consistent' has been so far."));
      AssertThrow(!problem.path.follows_curve() ||
                    options.tangent != TangentType::frozen,
                  ExcMessage("Discretization/Tangent: 'frozen' converges "
                             "slowly, and 'Analysis/Type = " +
                             name_of(problem.path.type) +
                             "' needs the derivative; choose 'symmetric'."));
      if (problem.assembly == AssemblyMethod::fast)
        return;
      const std::string reference = "Discretization/Assembly: 'reference' ";
      AssertThrow(problem.path.is_linear() && has_rotation_jump,
                  ExcMessage(reference + "knows linear analyses in the "
                                         "rotation-jump form only; choose "
                                         "'fast'."));
      AssertThrow(problem.model.cuts.is_empty(),
                  ExcMessage(reference + "knows no cells that cuts "
                                         "(Cuts/Cuts) divide; choose 'fast'."));
    }

    /** What modes are sought about. */
    void
    check_modes(const ShellProblem &problem)
    {
      if (!seeks_modes(problem.path.type))
        return;
      const KinematicsOptions &options = problem.model.kinematics;
      const std::string        type =
        "'Analysis/Type = " + name_of(problem.path.type) + "'";
      const bool at_rest = problem.path.start_from.empty();
      AssertThrow(!at_rest || (options.model == KinematicsModel::linear &&
                               options.edge_form == EdgeForm::rotation_jump),
                  ExcMessage("Discretization/Kinematics, Edge form: " + type +
                             " linearises about the undeformed shell; choose "
                             "'Kinematics = linear' and 'Edge form = rotation "
                             "jump', and by 'Analysis/Prestress' what the "
                             "state before adds; or name a state by "
                             "'Analysis/Start from'."));
      AssertThrow(at_rest || options.model == KinematicsModel::finite,
                  ExcMessage("Discretization/Kinematics: " + type +
                             " about the state of 'Analysis/Start from' takes "
                             "the derivative of an exact tangent; choose "
                             "'finite', with which that state must have been "
                             "found, too."));
    }

    void
    check_multigrid(const ShellProblem &problem)
    {
      AssertThrow(problem.solver.type != SolverType::multigrid ||
                    !problem.path.needs_direct_solver(),
                  ExcMessage(
                    seeks_modes(problem.path.type) ?
                      "Linear solver/Solver: 'multigrid' has no factors, which "
                      "'Analysis/Type = " +
                        name_of(problem.path.type) +
                        "' needs; choose auto or direct." :
                      std::string("Linear solver/Solver: 'multigrid' doesn't "
                                  "know the inertia of a dynamic analysis; "
                                  "choose auto or direct.")));
    }

    /** What no linear analysis knows. */
    void
    check_linear(const ShellProblem &problem)
    {
      AssertThrow((!problem.path.is_linear() &&
                   !seeks_modes(problem.path.type)) ||
                    !problem.model.foundation.is_nonlinear(),
                  ExcMessage("Foundation/Tension free: '" +
                             name_of(problem.model.foundation.tension_free) +
                             "' is nonlinear, and 'Analysis/Type = " +
                             name_of(problem.path.type) +
                             "' is linear; choose 'Analysis/Type = static' or "
                             "'Tension free = no'."));
      if (!problem.path.is_linear())
        return;
      const KinematicsModel model = problem.model.kinematics.model;
      AssertThrow(model == KinematicsModel::linear,
                  ExcMessage("Discretization/Kinematics: '" + name_of(model) +
                             "' is nonlinear; choose 'Analysis/Type = "
                             "static', relaxation or dynamic."));
      AssertThrow(!problem.model.loads.pressure_follows(),
                  ExcMessage("Loads/Pressure follows: a linear analysis "
                             "knows the undeformed surface only; choose "
                             "another 'Analysis/Type'."));
    }
  } // namespace

  void
  ProblemParameters::check(const ShellProblem &problem)
  {
    check_forms(problem);
    check_multigrid(problem);
    check_modes(problem);
    check_tips(problem);
    check_section(problem);
    check_linear(problem);
  }
} // namespace Nacre
