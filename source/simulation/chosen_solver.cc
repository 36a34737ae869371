// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/base/text.h>
#include <nacre/simulation/chosen_solver.h>

#include <array>
#include <cmath>
#include <sstream>

namespace Nacre
{
  namespace
  {
    /**
     * Seconds on one core at 10^5 dofs, and the powers of the dofs with which
     * they grow: fitted to the roof's, doc/solvers.md, "The choice".
     */
    struct MeasuredCosts
    {
      double factorise, substitute, set_up, iterate;
      /** GB of the factors. */
      double factors;
    };

    constexpr double power_of_factors = 1.35;
    constexpr double power_of_memory  = 1.1;
    /** Other shells take more iterations than the roof. */
    constexpr double iterations_to_spare = 1.5;

    std::string
    reason(const ExcIterationFailed &failure)
    {
      std::ostringstream text;
      failure.print_info(text);
      return Text::trim(text.str());
    }

    const std::array<MeasuredCosts, 4> costs = {{{3.6, 0.1, 1.5, 2.0, 0.7},
                                                 {6.2, 0.2, 1.4, 1.4, 1.0},
                                                 {10., 0.3, 2.3, 1.5, 1.5},
                                                 {13., 0.4, 4.0, 2.0, 2.0}}};
  } // namespace

  const Selection<SolverType> &
  selection(SolverType)
  {
    static const Selection<SolverType> table = {{SolverType::automatic, "auto"},
                                                {SolverType::direct, "direct"},
                                                {SolverType::multigrid,
                                                 "multigrid"}};
    return table;
  }

  LinearSolverParameters::LinearSolverParameters()
    : ParameterAcceptor("/Linear solver")
  {
    add_parameter(
      "Solver",
      values.type,
      "direct: sparse factorisation; multigrid: conjugate gradients "
      "with geometric multigrid on the refinements of the coarse "
      "mesh; auto: whichever is expected to be faster, by the "
      "number of unknowns, and fits into the memory. If multigrid "
      "fails, the direct solver takes over, with a warning.");
    add_parameter("Max iterations",
                  values.max_iterations,
                  "Iterations after which multigrid gives up. Units: none.",
                  prm,
                  Patterns::Integer(1));
    add_parameter("Coarsest unknowns",
                  values.coarse_dofs,
                  "Multigrid adds coarser levels until one has at most so "
                  "many unknowns, which the direct solver takes. Units: none.",
                  prm,
                  Patterns::Integer(1));
  }

  bool
  prefers_multigrid(const SolverTask &task)
  {
    if (task.n_levels == 0)
      return false;
    const auto  &cost = costs[std::min(std::max(task.degree, 2u), 5u) - 2];
    const double n    = task.n_dofs / 1e5;
    if (cost.factors * std::pow(n, power_of_memory) > 0.8 * task.memory)
      return true;
    return (cost.set_up +
            task.n_right_hand_sides * iterations_to_spare * cost.iterate) *
             n <
           cost.factorise * std::pow(n, power_of_factors) +
             task.n_right_hand_sides * cost.substitute * n;
  }

  ChosenSolver::ChosenSolver(const MPI_Comm communicator,
                             const Factory &make_multigrid,
                             Log           &log)
    : direct_(communicator)
    , multigrid_(make_multigrid ? make_multigrid() : nullptr)
    , has_factors_(multigrid_ == nullptr)
    , log_(log)
  {}

  bool
  ChosenSolver::try_prepare(const LinearSystem &system)
  {
    system_      = std::make_unique<const LinearSystem>(system);
    has_factors_ = multigrid_ == nullptr || is_indefinite_;
    if (has_factors_)
      return factorize();
    try
      {
        return multigrid_->try_prepare(system);
      }
    catch (const ExcIterationFailed &failure)
      {
        return fall_back(failure);
      }
  }

  SolveAccuracy
  ChosenSolver::solve(TrilinosWrappers::MPI::Vector       &x,
                      const TrilinosWrappers::MPI::Vector &b)
  {
    if (!has_factors_)
      try
        {
          return multigrid_->solve(x, b);
        }
      catch (const ExcIterationFailed &failure)
        {
          if (!fall_back(failure))
            {
              SolveAccuracy accuracy;
              accuracy.is_regular = false;
              return accuracy;
            }
        }
    return direct_.solve(x, b);
  }

  bool
  ChosenSolver::factorize()
  {
    const bool is_regular = direct_.try_prepare(*system_);
    is_indefinite_        = !is_regular || *direct_.n_negative_pivots() > 0;
    return is_regular;
  }

  bool
  ChosenSolver::fall_back(const ExcIterationFailed &failure)
  {
    has_factors_          = true;
    const bool is_regular = factorize();
    if (!is_indefinite_ || !has_warned_)
      log_.warning("multigrid failed: " + reason(failure) +
                   "; the direct solver takes over" +
                   (is_indefinite_ ? " where the matrix is indefinite." : "."));
    has_warned_ = true;
    if (!is_indefinite_)
      multigrid_.reset();
    return is_regular;
  }

  std::optional<unsigned int>
  ChosenSolver::n_negative_pivots() const
  {
    return has_factors_ ? direct_.n_negative_pivots() : 0;
  }

  std::optional<unsigned int>
  ChosenSolver::count_negative_eigenvalues()
  {
    if (!has_factors_)
      try
        {
          return multigrid_->count_negative_eigenvalues();
        }
      catch (const ExcIterationFailed &failure)
        {
          if (!fall_back(failure))
            return {};
        }
    return direct_.n_negative_pivots();
  }

  std::string
  ChosenSolver::name() const
  {
    return name_of(type());
  }
} // namespace Nacre
