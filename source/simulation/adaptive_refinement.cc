// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/cpu_timer.h>
#include <nacre/base/number_range.h>
#include <nacre/base/text.h>
#include <nacre/forms/assembly.h>
#include <nacre/postprocess/error_estimator.h>
#include <nacre/postprocess/error_norms.h>
#include <nacre/postprocess/refinement_marking.h>
#include <nacre/simulation/adaptive_refinement.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace Nacre
{
  const Selection<EstimatorType> &
  selection(EstimatorType)
  {
    static const Selection<EstimatorType> table =
      {{EstimatorType::residual, "residual"}, {EstimatorType::goal, "goal"}};
    return table;
  }

  const Selection<MarkingType> &
  selection(MarkingType)
  {
    static const Selection<MarkingType> table = {
      {MarkingType::doerfler, "Doerfler"},
      {MarkingType::fixed_fraction, "fixed fraction"}};
    return table;
  }

  AdaptiveRefinementParameters::AdaptiveRefinementParameters()
    : ParameterAcceptor("/Adaptive refinement")
  {
    add_parameter("Cycles",
                  values_.n_cycles_,
                  "How often at most to refine the mesh of "
                  "'Study/Refinements' where the estimated error is large; "
                  "each mesh is a row of the table, or goes on along the path. "
                  "0: no estimate. Units: none.",
                  prm,
                  Patterns::Integer(0, 100));
    add_parameter("Estimator",
                  values_.estimator_,
                  "residual: the energy norm of the error, (2 energy)^1/2, "
                  "from residuals and jumps; goal: the error of one quantity, "
                  "by the dual solution.");
    add_parameter("Goal",
                  values_.goal_name_,
                  "Name of a quantity of 'Quantities': a displacement at a "
                  "point, a reaction or the energy.");
    add_parameter("Marking",
                  values_.marking_,
                  "Doerfler: the fewest cells that hold the fraction of the "
                  "estimate (of its square, for the energy norm); fixed "
                  "fraction: that fraction of the cells.");
    add_parameter("Fraction",
                  values_.fraction_,
                  "Fraction that 'Marking' takes, above 0 and at most 1; with "
                  "'fixed fraction' 1 refines all cells. Units: none.",
                  prm,
                  Patterns::Double());
    add_parameter("Cells at tips",
                  tip_size_,
                  "Each cycle refines the cells that hold a tip of a cut until "
                  "their longest edge is no longer than this, along with all "
                  "cells along that cut; 0: no more than the estimate says. "
                  "Units: length.");
    add_parameter("Max dofs",
                  values_.max_dofs_,
                  "A mesh that has more degrees of freedom isn't refined any "
                  "more. Units: none.",
                  prm,
                  Patterns::Integer(1));
    add_parameter("Tolerance",
                  values_.tolerance_,
                  "An estimate of the energy norm below this fraction of that "
                  "of the solution, (2 energy)^1/2, isn't refined any more; 0: "
                  "no limit. Units: none.",
                  prm,
                  Patterns::Double(0., 1.));
    add_parameter("Every steps",
                  values_.n_steps_,
                  "Along a path the mesh is refined after every so many steps. "
                  "Units: none.",
                  prm,
                  Patterns::Integer(1));
  }

  AdaptiveRefinement
  AdaptiveRefinementParameters::make(
    const ShellProblem         &problem,
    const QuantitiesOfInterest &quantities) const
  {
    AdaptiveRefinement result = values_;
    if (!result.is_on())
      return result;
    result.tip_size_ = nonnegative_number(tip_size_,
                                          "Adaptive refinement/Cells at tips",
                                          problem.constants);
    result.check(problem);
    if (result.estimator_ == EstimatorType::residual)
      return result;
    const std::string       &goal_name = result.goal_name_;
    std::vector<std::string> names;
    for (const auto &quantity : quantities.quantities())
      {
        if (quantity.name == goal_name)
          {
            result.goal_index_ = names.size();
            result.goal_       = quantity.goal;
            result.reference_  = quantity.reference;
          }
        names.push_back(quantity.name);
      }
    AssertThrow(!goal_name.empty() && result.goal_index_,
                ExcMessage(Text::unknown_name("Adaptive refinement/Goal",
                                              "quantity",
                                              goal_name,
                                              names)));
    AssertThrow(result.goal_.is_known(),
                ExcMessage("Adaptive refinement/Goal: the quantity '" +
                           goal_name +
                           "' is not linear in the displacement, so that it "
                           "has no dual solution; possible are a "
                           "displacement at a point, a reaction of an edge "
                           "and the energy."));
    return result;
  }

  void
  AdaptiveRefinement::check(const ShellProblem &problem) const
  {
    const std::string section = "Adaptive refinement/";
    AssertThrow(fraction_ > 0. && fraction_ <= 1.,
                ExcMessage(section + "Fraction: found " +
                           std::to_string(fraction_) +
                           "; it must be above 0 and at most 1."));
    AssertThrow(tip_size_ == 0. || !problem.model.cuts.is_empty(),
                ExcMessage(section + "Cells at tips: there are no cuts "
                                     "(Cuts/Cuts); set it to 0."));
    AssertThrow(!problem.growth.is_on(),
                ExcMessage(section +
                           "Cycles: cuts that grow (Growth/Tips) keep their "
                           "mesh; set it to 0."));
    check_path(problem.path);
    AssertThrow(!problem.model.section->has_initial_strain(),
                ExcMessage(section +
                           "Cycles: the estimate knows no initial strains; set "
                           "it to 0, and refine the whole mesh."));
    AssertThrow(problem.model.element.type != ElementType::triangle,
                ExcMessage(section + "Cycles: meshes of triangles are refined "
                                     "as a whole only; set it to 0, or choose "
                                     "an element of quadrilaterals."));
    AssertThrow(estimator_ == EstimatorType::goal || goal_name_.empty(),
                ExcMessage(section + "Goal: '" + goal_name_ +
                           "' has no effect unless 'Estimator = goal'."));
  }

  void
  AdaptiveRefinement::check_path(const PathParameters &path) const
  {
    const std::string section = "Adaptive refinement/";
    AssertThrow(!path.is_dynamic(),
                ExcMessage(section +
                           "Cycles: a motion keeps its mesh: velocities that "
                           "come from another one would change its energy, and "
                           "the estimate knows no inertia; set it to 0, or "
                           "'Analysis/Type' to static or linear."));
    AssertThrow(!seeks_modes(path.type),
                ExcMessage(section +
                           "Cycles: 'Analysis/Type = " + name_of(path.type) +
                           "' has no estimate; it is for a linear analysis "
                           "and static paths: set it to 0."));
    AssertThrow(!path.branches.has_several(),
                ExcMessage(
                  section +
                  "Cycles: several branches begin on the meshes of their "
                  "points, which aren't kept; set it to 0, or name one branch "
                  "in 'Analysis/Switch branch'."));
    AssertThrow(path.is_linear() || estimator_ == EstimatorType::residual,
                ExcMessage(section +
                           "Estimator: 'goal' is for linear analyses only; "
                           "along a path choose residual."));
    AssertThrow(tolerance_ == 0. || estimator_ == EstimatorType::residual,
                ExcMessage(section +
                           "Tolerance: it is one of the energy norm, that "
                           "'Estimator = goal' doesn't estimate; set it to "
                           "0."));
  }

  const GoalFunctional *
  AdaptiveRefinement::goal() const
  {
    return goal_index_ ? &goal_ : nullptr;
  }

  ErrorEstimate
  AdaptiveRefinement::estimate(const SolvedShell                   &solution,
                               const TrilinosWrappers::MPI::Vector &dual) const
  {
    const MPI_Comm       communicator = solution.discretization.communicator();
    CpuTimer             timer(communicator);
    const ErrorEstimator estimator(solution.discretization,
                                   solution.model,
                                   solution.assembly.penalty());
    ErrorEstimate        result;
    const ErrorEstimator::Field u{&solution.displacement,
                                  true,
                                  &solution.actions,
                                  &solution.assembly.section_states()};
    if (!goal_index_)
      {
        const auto indicators = estimator.estimate(u);
        for (unsigned int k = 0; k < indicators.n_cells(); ++k)
          result.indicators.push_back(indicators.of_cell(k));
        result.value = std::sqrt(indicators.total(communicator));
      }
    else if (goal_.is_energy)
      {
        // U = l(u)/2: the error is half the square of the norm.
        const auto indicators = estimator.estimate(u);
        for (unsigned int k = 0; k < indicators.n_cells(); ++k)
          result.indicators.push_back(0.5 * indicators.of_cell(k));
        result.value = result.bound = 0.5 * indicators.total(communicator);
      }
    else
      {
        const ErrorEstimator::Field z{&dual, false};
        const auto [uu, zz, uz] = estimator.estimate(u, z);
        for (unsigned int k = 0; k < uu.n_cells(); ++k)
          {
            result.indicators.push_back(
              std::sqrt(uu.of_cell(k) * zz.of_cell(k)));
            result.bound += result.indicators.back();
          }
        result.value = uz.total(communicator);
        result.bound = Utilities::MPI::sum(result.bound, communicator);
      }
    result.seconds = timer.lap();
    return result;
  }

  std::vector<ResultsTable::Quantity>
  AdaptiveRefinement::columns(const ExactSolution &exact_solution) const
  {
    if (!is_on())
      return {};
    std::vector<ResultsTable::Quantity> columns = {{"estimate", {}, true}};
    if (goal_index_)
      columns.push_back({"bound", {}, true});
    if (goal_index_ ? reference_.has_value() : exact_solution.is_known())
      columns.push_back({"effectivity", {}, false});
    return columns;
  }

  void
  AdaptiveRefinement::add_to_row(const SolvedShell   &solution,
                                 const ErrorEstimate &estimate,
                                 ResultsTable::Row   &row) const
  {
    std::optional<double> error;
    if (goal_index_)
      {
        if (reference_)
          error = *reference_ - row.values[*goal_index_];
      }
    else if (solution.model.exact_solution.is_known())
      error = compute_error_norms(solution).energy;

    row.values.push_back(estimate.value);
    if (goal_index_)
      row.values.push_back(estimate.bound);
    if (error)
      row.values.push_back(*error == 0. ? std::numeric_limits<double>::max() :
                                          estimate.value / *error);
    row.references.resize(row.values.size());
    row.estimate_s = estimate.seconds;
  }

  std::optional<std::vector<bool>>
  AdaptiveRefinement::mark(const ErrorEstimate &estimate,
                           const SolvedShell   &solution) const
  {
    const Discretization &mesh = solution.discretization;
    const double norm = std::sqrt(std::max(0., 2. * solution.energies.total()));
    if (mesh.n_dofs() > max_dofs_ ||
        (tolerance_ > 0. && estimate.value <= tolerance_ * norm))
      return {};
    auto marked = marking_ == MarkingType::doerfler ?
                    RefinementMarking::bulk(estimate.indicators,
                                            fraction_,
                                            mesh.communicator()) :
                    RefinementMarking::fixed_fraction(
                      estimate.indicators,
                      fraction_,
                      mesh.triangulation().n_global_active_cells(),
                      mesh.communicator());
    add_cells_at_tips(mesh, marked);
    RefinementMarking::add_cells_along_cuts(mesh, marked);
    return marked;
  }

  void
  AdaptiveRefinement::add_cells_at_tips(const Discretization &discretization,
                                        std::vector<bool>    &marked) const
  {
    if (tip_size_ == 0.)
      return;
    std::set<CellId> with_tip;
    for (const auto &tip : discretization.tips())
      with_tip.insert(tip.cell);
    for (const auto &cell :
         discretization.triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && with_tip.count(cell->id()) == 1)
        for (const auto face : cell->face_indices())
          if (cell->face(face)->vertex(0).distance(
                cell->face(face)->vertex(1)) > (1. + 1e-9) * tip_size_)
            marked[cell->active_cell_index()] = true;
  }
} // namespace Nacre
