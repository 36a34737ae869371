// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_growth_h
#define nacre_problem_growth_h

#include <nacre/base/expression.h>
#include <nacre/base/selection.h>
#include <nacre/problem/cuts.h>

#include <deal.II/base/parameter_acceptor.h>

#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  /** When a tip advances. */
  enum class GrowthCriterion
  {
    /** When its energy release rate reaches the toughness times h. */
    energy_release_rate,
    /** When the stress ahead, averaged over a distance, reaches the strength.
     */
    strength,
    /** As the user says: a knife. */
    prescribed
  };

  const Selection<GrowthCriterion> &selection(GrowthCriterion);

  /** Where a tip turns. */
  enum class GrowthDirection
  {
    /** To the largest hoop stress: (C.10), or what is averaged. */
    hoop_stress,
    straight,
    /** Along a vector. */
    expression
  };

  /** A length, or a number of edges of the cells there. */
  struct CellLength
  {
    double value       = 0.;
    bool   is_in_cells = false;

    /** @param cell_size of the cells there (length) */
    double
    at(const double cell_size) const
    {
      return is_in_cells ? value * cell_size : value;
    }
  };

  /** How cuts grow. */
  struct Growth
  {
    /** An end of a cut. */
    struct Tip
    {
      unsigned int cut;
      /** Whether it is the last point of the cut, not the first. */
      bool at_end;
    };

    /** That may grow; none: the cuts stay as they are. */
    std::vector<Tip> tips = {};

    GrowthCriterion criterion = GrowthCriterion::energy_release_rate;
    /** G_c, energy per area of the crack (force/length). */
    double toughness = 0.;
    /** sigma_c (force/length^2), and the distance of the averages. */
    double     strength = 0.;
    CellLength averaging_distance;
    /** How many cracks may start at most where there are none. */
    unsigned int starting_cracks = 0;
    /** Tips whose G is lower than the largest by this part grow, too. */
    double tolerance = 0.1;

    GrowthDirection direction = GrowthDirection::straight;
    /** The direction in space, if it is an expression (1). */
    VectorExpression along = {};

    /** How far a tip advances at once: cells at the tip, or a length. */
    CellLength step = {3., true};
    /** Length by which each tip has advanced at t, if that is prescribed. */
    Expression length = {};

    unsigned int maximum_steps = 20;

    /**
     * In dynamics: how long (time) the forces of new lips take to fall to
     * zero; 0: at once; none: as long as a Rayleigh wave takes for the step.
     */
    std::optional<double> release_time = {};

    bool
    is_on() const
    {
      return !tips.empty() || starting_cracks > 0;
    }

    bool
    is_prescribed() const
    {
      return criterion == GrowthCriterion::prescribed;
    }

    bool
    is_by_energy() const
    {
      return criterion == GrowthCriterion::energy_release_rate;
    }

    bool
    is_by_strength() const
    {
      return criterion == GrowthCriterion::strength;
    }
  };

  /** "tear end" */
  std::string
  in_words(const Growth::Tip &tip, const Cuts &cuts);

  /** The section Growth of a parameter file. */
  class GrowthParameters : public ParameterAcceptor
  {
  public:
    GrowthParameters();

    /**
     * Throws an ExcMessage for tips that no cut has, and for parameters that
     * don't go together.
     * @param is_path whether the analysis has a time
     * @param is_linear whether kinematics and the section are; decides the
     *   default direction
     */
    Growth
    make(const Constants &constants,
         const Cuts      &cuts,
         const bool       is_path,
         const bool       is_linear) const;

  private:
    void
    read_tips(const Cuts &cuts, Growth &growth) const;

    /** Throws for parameters that the criterion doesn't use, or that it needs.
     */
    void
    check_uses(const bool is_path) const;

    void
    read_criterion(const Constants &constants, Growth &growth) const;

    void
    read_direction(const Constants &constants,
                   const bool       is_linear,
                   Growth          &growth) const;

    void
    read_release(const Constants &constants, Growth &growth) const;

    std::string     tips_text_      = "none";
    GrowthCriterion criterion_      = Growth().criterion;
    std::string     toughness_text_ = "";
    std::string     strength_text_  = "";
    std::string     distance_text_  = "";
    unsigned int    starting_       = Growth().starting_cracks;
    double          tolerance_      = Growth().tolerance;
    std::string     direction_text_ = "default";
    std::string     step_text_      = "3 cells";
    std::string     length_text_    = "";
    std::string     release_text_   = "default";
    unsigned int    maximum_steps_  = Growth().maximum_steps;
  };
} // namespace Nacre

#endif
