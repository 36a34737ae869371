// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_path_parameters_h
#define nacre_analysis_path_parameters_h

#include <nacre/analysis/time_grid.h>
#include <nacre/analysis/time_integrator.h>
#include <nacre/base/expression.h>
#include <nacre/solvers/newton_solver.h>

#include <deal.II/base/parameter_acceptor.h>

#include <cmath>
#include <string>
#include <vector>

namespace Nacre
{
  /** What is computed. */
  enum class AnalysisType
  {
    /** One linear solve. */
    linear,
    /** Equilibria along a load path. */
    quasi_static,
    /** The same; where Newton's method fails, by dynamic relaxation. */
    relaxation,
    /** Equilibria along a path whose load factor may fall. */
    arc_length,
    /** The same, by steps of a quantity. */
    displacement_control,
    /** Motion in time. */
    dynamic,
    /** Load factors at which the linear state is no longer stable. */
    buckling,
    /** Natural frequencies. */
    vibration
  };

  const Selection<AnalysisType> &selection(AnalysisType);

  /** Whether eigenvalues and modes are sought. */
  inline bool
  seeks_modes(const AnalysisType type)
  {
    return type == AnalysisType::buckling || type == AnalysisType::vibration;
  }

  /** When increments are shortened. */
  enum class LineSearch
  {
    /** When a step has failed without. */
    automatic,
    always,
    never
  };

  const Selection<LineSearch> &selection(LineSearch);

  /** When the tangent is assembled and factorised. */
  enum class TangentUpdates
  {
    every_iteration,
    /** In the first iteration of a step only. */
    every_step
  };

  const Selection<TangentUpdates> &selection(TangentUpdates);

  /** Which branches of a curve of equilibria are followed. */
  struct BranchChoice
  {
    /** The primary path and both sides of each branch. */
    bool all = false;
    /**
     * The numbers of bifurcation points, negative for the other side; 0 is the
     * primary path. Empty: the primary path only.
     */
    std::vector<int> numbers;

    /** The bifurcation point at which a single path changes over; or 0. */
    int
    change_over() const
    {
      return numbers.size() == 1 ? numbers.front() : 0;
    }

    /** Whether there are several paths with files of their own. */
    bool
    has_several() const
    {
      return all || numbers.size() > 1;
    }

    /** Whether the primary path is followed to its end. */
    bool
    has_primary() const;

    /** How many bifurcation points of the primary path are asked for. */
    unsigned int
    n_bifurcations() const;

    /** The branches other than 0 if the primary path has @p n_found points. */
    std::vector<int>
    branches(const unsigned int n_found) const;
  };

  /** A quantity beyond a value, at which a path ends. */
  struct PathBound
  {
    std::string quantity;
    bool        is_below = false;
    double      value    = 0.;

    bool
    holds(const double found) const
    {
      return is_below ? found < value : found > value;
    }

    /** "w < -30" */
    std::string
    text() const;
  };

  /** How an analysis goes on from step to step. */
  struct StepParameters
  {
    AnalysisType             type = AnalysisType::linear;
    NewtonSolver::Parameters newton;
    LineSearch               line_search     = LineSearch::automatic;
    TangentUpdates           tangent_updates = TangentUpdates::every_iteration;
    TimeScheme               scheme          = TimeScheme::energy_momentum;
    /** Of generalised alpha at high frequencies. */
    double spectral_radius = 0.8;
    /** Force per mass and velocity (1/time). */
    double mass_damping = 0.;
    /** @name Of a curve of equilibria */
    //@{
    unsigned int maximum_steps = 1000;
    /** 0: any number. */
    unsigned int maximum_points = 0;
    //@}
    /** Fields are written every so many steps; 0: at output_times only. */
    unsigned int vtu_steps = 1;
    /** The state is saved every so many steps; 0: never. */
    unsigned int checkpoint_steps = 10;
    /** Name of the run whose last state is the start; empty: none. */
    std::string start_from;

    bool
    keeps_tangent() const
    {
      return tangent_updates == TangentUpdates::every_step;
    }

    /** Whether one linear solve is all. */
    bool
    is_linear() const
    {
      return type == AnalysisType::linear;
    }

    /** Whether the shell moves in time. */
    bool
    is_dynamic() const
    {
      return type == AnalysisType::dynamic;
    }

    bool
    controls_displacement() const
    {
      return type == AnalysisType::displacement_control;
    }

    /** Whether t is unknown along the path. */
    bool
    follows_curve() const
    {
      return type == AnalysisType::arc_length || controls_displacement();
    }

    /** Whether inertia holds a shell that no support holds. */
    bool
    has_inertia() const
    {
      return is_dynamic() || type == AnalysisType::vibration;
    }

    /** Whether only factors of the matrix will do. */
    bool
    needs_direct_solver() const
    {
      return is_dynamic() || seeks_modes(type);
    }
  };

  /** A path: its steps, its times (in statics without a unit), its start. */
  struct PathParameters : StepParameters
  {
    /** Negative if a curve of equilibria ends at a negative t. */
    double end_time          = 1.;
    double time_step         = 0.1;
    double minimum_time_step = 1e-4;
    double maximum_time_step = 0.1;
    /** Times that are met exactly, and whose fields are written. */
    std::vector<double> output_times;
    /** Where it ends before. */
    std::vector<PathBound> bounds;

    /** @name Of a curve of equilibria */
    //@{
    BranchChoice branches;
    /** Whether t falls in the first step. */
    bool begins_downward = false;
    /** The quantity that is controlled, its values and the size of steps. */
    std::string         control;
    std::vector<double> control_values;
    double              control_step = 0.;
    //@}

    /** Displacement (length) and velocity at the start, in dynamics. */
    VectorExpression initial_displacement;
    VectorExpression initial_velocity;

    /** Where the steps end. */
    TimeGrid
    time_grid() const
    {
      return {time_step, std::abs(end_time), output_times};
    }

    /** The size of the first step: of t, or of the controlled quantity. */
    double
    first_step() const
    {
      return controls_displacement() ? control_step : time_step;
    }

    /** Of derivatives with respect to the time. */
    double
    rate_step() const
    {
      return 0.01 * time_step;
    }

    /** @p dt (time) as a size of steps, where these are of another quantity. */
    double
    step_of(const double dt) const
    {
      return first_step() / time_step * dt;
    }
  };

  /** The section Analysis of a parameter file. */
  class AnalysisParameters : public ParameterAcceptor
  {
  public:
    AnalysisParameters();

    /** Throws ExcMessage for values that don't go together. */
    PathParameters
    make(const Constants &constants) const;

    /** Factor of all loads and prescribed values over t. */
    Expression
    load_factor(const Constants &constants) const;

  private:
    /** The parameters of curves of equilibria. */
    void
    declare_curve();

    /** Those of a step's iterations. */
    void
    declare_iterations();

    /** Those of motions. */
    void
    declare_motion();

    void
    read_times(const Constants &constants, PathParameters &path) const;

    void
    read_start(const Constants &constants, PathParameters &path) const;

    void
    read_curve(const Constants &constants, PathParameters &path) const;

    void
    check_use(const PathParameters &path) const;

    StepParameters steps_;
    std::string    load_factor_text_          = "default";
    std::string    end_time_text_             = "1";
    std::string    time_step_text_            = "0.1";
    std::string    minimum_time_step_text_    = "default";
    std::string    maximum_time_step_text_    = "default";
    std::string    output_times_text_         = "";
    std::string    stop_where_text_           = "";
    std::string    switch_branch_text_        = "none";
    std::string    control_text_              = "";
    std::string    control_values_text_       = "";
    std::string    control_step_text_         = "default";
    std::string    mass_damping_text_         = "0";
    std::string    initial_displacement_text_ = "0, 0, 0";
    std::string    initial_velocity_text_     = "0, 0, 0";
  };
} // namespace Nacre

#endif
