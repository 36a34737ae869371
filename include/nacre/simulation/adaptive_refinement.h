// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_adaptive_refinement_h
#define nacre_simulation_adaptive_refinement_h

#include <nacre/postprocess/quantities_of_interest.h>
#include <nacre/postprocess/results_table.h>
#include <nacre/simulation/shell_problem.h>

#include <deal.II/base/parameter_acceptor.h>

#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  /** An estimated error and where it comes from. */
  struct ErrorEstimate
  {
    /**
     * The norm of the error in the energy, (sum eta_K^2)^1/2; or the error of
     * the goal with its sign, exact minus computed.
     */
    double value = 0.;
    /** For a goal: sum eta_K(u) eta_K(z), without cancellation. */
    double bound = 0.;
    /** eta_K^2, or eta_K(u) eta_K(z), by active cell index. */
    std::vector<double> indicators;
    /** CPU seconds, summed over the ranks. */
    double seconds = 0.;
  };

  /** What is estimated. */
  enum class EstimatorType
  {
    /** The error in the energy norm. */
    residual,
    /** The error of one quantity. */
    goal
  };

  const Selection<EstimatorType> &selection(EstimatorType);

  /** Which cells are refined. */
  enum class MarkingType
  {
    /** The fewest that hold a fraction of the estimate. */
    doerfler,
    /** A fraction of all. */
    fixed_fraction
  };

  const Selection<MarkingType> &selection(MarkingType);

  /**
   * Cycles of solving, estimating the error, and refining where it is large:
   * doc/adaptive.md. Along a path a cycle is a step of the path. By default
   * there are none.
   */
  class AdaptiveRefinement
  {
  public:
    /** Whether errors are estimated. */
    bool
    is_on() const
    {
      return n_cycles_ > 0;
    }

    /** Refinements after the first mesh. */
    unsigned int
    n_cycles() const
    {
      return n_cycles_;
    }

    /** Whether the mesh is to be refined after the step @p step of a path. */
    bool
    is_due(const unsigned int step) const
    {
      return is_on() && step % n_steps_ == 0;
    }

    /** The goal, or null for the energy norm of the error. */
    const GoalFunctional *
    goal() const;

    /**
     * The error of a solution, at the time of its actions, or of a linear
     * analysis; collective.
     * @param dual the ghosted dual solution of goal(); unused without
     */
    ErrorEstimate
    estimate(const SolvedShell                   &solution,
             const TrilinosWrappers::MPI::Vector &dual) const;

    /** Columns of the table that tell of the estimate. */
    std::vector<ResultsTable::Quantity>
    columns(const ExactSolution &exact_solution) const;

    /**
     * Add their values to the row of the @p solution.
     */
    void
    add_to_row(const SolvedShell   &solution,
               const ErrorEstimate &estimate,
               ResultsTable::Row   &row) const;

    /**
     * The cells to refine, or nothing if the mesh has dofs enough or the
     * estimate is below the tolerance. Of cuts, all cells along them or none.
     */
    std::optional<std::vector<bool>>
    mark(const ErrorEstimate &estimate, const SolvedShell &solution) const;

  private:
    friend class AdaptiveRefinementParameters;

    /** Throws where errors of the problem aren't estimated. */
    void
    check(const ShellProblem &problem) const;

    /** What no nonlinear analysis can do. */
    void
    check_path(const PathParameters &path) const;

    /** Mark this rank's cells that hold a tip and are longer than tip_size_. */
    void
    add_cells_at_tips(const Discretization &discretization,
                      std::vector<bool>    &marked) const;

    unsigned int  n_cycles_  = 0;
    EstimatorType estimator_ = EstimatorType::residual;
    std::string   goal_name_;
    MarkingType   marking_   = MarkingType::doerfler;
    double        fraction_  = 0.5;
    unsigned int  max_dofs_  = 1000000;
    double        tolerance_ = 0.;
    unsigned int  n_steps_   = 1;
    /** Length; 0: no rule of their own. */
    double tip_size_ = 0.;

    /** Place of the goal among the quantities. */
    std::optional<unsigned int> goal_index_;
    GoalFunctional              goal_;
    std::optional<double>       reference_;
  };

  /** The section "Adaptive refinement". */
  class AdaptiveRefinementParameters : public ParameterAcceptor
  {
  public:
    AdaptiveRefinementParameters();

    /**
     * Throws for a problem whose errors aren't estimated, and for a goal that
     * isn't among @p quantities or isn't linear.
     */
    AdaptiveRefinement
    make(const ShellProblem         &problem,
         const QuantitiesOfInterest &quantities) const;

  private:
    /** As read; its goal isn't found yet. */
    AdaptiveRefinement values_;
    std::string        tip_size_ = "0";
  };
} // namespace Nacre

#endif
