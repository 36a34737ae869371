// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_quantities_of_interest_h
#define nacre_postprocess_quantities_of_interest_h

#include <nacre/base/expression.h>
#include <nacre/postprocess/point_quantities.h>
#include <nacre/postprocess/shell_state.h>

#include <deal.II/base/parameter_acceptor.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * What makes a quantity the goal of an error estimate: its derivative at
   * any displacement, or that it is the energy. A quantity Q(u) is linear with
   * one of
   *   load:     Q(u) = g . u
   *   reaction: Q(u) = v . (K u - f), the virtual work of the residual on the
   *             displacement v of supports
   */
  struct GoalFunctional
  {
    using Vector = TrilinosWrappers::MPI::Vector;
    std::function<Vector(const Discretization &)> load;
    std::function<Vector(const Discretization &,
                         const DisplacementConditions &)>
         reaction;
    bool is_energy = false;

    bool
    is_known() const
    {
      return load || reaction || is_energy;
    }
  };

  /** The quantities that a study reports, by name. */
  class QuantitiesOfInterest
  {
  public:
    struct Quantity
    {
      std::string           name;
      std::optional<double> reference;
      /** Whether it is a norm of the error. */
      bool is_error = false;
      /** The value; collective. */
      std::function<double(const SolvedShell &)> evaluate;
      /**
       * Whether a displacement at a time determines it, with its forces and
       * energies and what the section remembers then: displacement control can
       * prescribe it.
       */
      bool is_static = false;
      /** The same value where no force is needed; else empty. */
      std::function<double(const ShellState &)> of_displacement;
      /** Of the mid-surface, if the quantity is taken at one (length). */
      std::optional<Point<3>> point;
      /** What throws before a solve if it can't be taken; may be empty. */
      std::function<void(const Discretization &)> check;
      /** Of a rotation: evaluate_angle() of a ghosted displacement. */
      std::function<Angle(const Discretization &,
                          const TrilinosWrappers::MPI::Vector &)>
        angle;
      /** Unknown for quantities that can't be a goal. */
      GoalFunctional goal;
    };

    /** None. */
    QuantitiesOfInterest() = default;

    /** @param balance_origin as balance_origin() */
    QuantitiesOfInterest(std::vector<Quantity>          quantities,
                         const std::optional<Point<3>> &balance_origin)
      : quantities_(std::move(quantities))
      , balance_origin_(balance_origin)
    {}

    const std::vector<Quantity> &
    quantities() const
    {
      return quantities_;
    }

    /** Where to take the moments of a Balance; none if it isn't asked for. */
    const std::optional<Point<3>> &
    balance_origin() const
    {
      return balance_origin_;
    }

    /** Kinds, for messages and --list. */
    static std::vector<std::string>
    kinds();

  private:
    std::vector<Quantity>   quantities_;
    std::optional<Point<3>> balance_origin_;
  };

  /** The section Quantities of a parameter file. */
  class QuantityParameters : public ParameterAcceptor
  {
  public:
    QuantityParameters();

    /**
     * Throws for unknown kinds and edges, for two quantities of one name and
     * for an error norm without an exact solution. Of the @p section the
     * results of its states have names.
     */
    QuantitiesOfInterest
    make(const Midsurface    &midsurface,
         const Cuts          &cuts,
         const ExactSolution &exact_solution,
         const SectionLaw    &section,
         const Constants     &constants) const;

  private:
    std::string text_;
    std::string balance_text_;
  };
} // namespace Nacre

#endif
