// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_path_parameters_h
#define nacre_analysis_path_parameters_h

#include <nacre/analysis/time_grid.h>
#include <nacre/analysis/time_integrator.h>
#include <nacre/base/expression.h>
#include <nacre/solvers/newton_solver.h>

#include <deal.II/base/parameter_acceptor.h>

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
    /** Of a path with arc length. */
    unsigned int maximum_steps = 1000;
    /** Number of the bifurcation point at which it leaves; 0: at none. */
    int switch_branch = 0;
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
    double end_time          = 1.;
    double time_step         = 0.1;
    double minimum_time_step = 1e-4;
    double maximum_time_step = 0.1;
    /** Times that are met exactly, and whose fields are written. */
    std::vector<double> output_times;
    /** Displacement (length) and velocity at the start, in dynamics. */
    VectorExpression initial_displacement;
    VectorExpression initial_velocity;

    /** Where the steps end. */
    TimeGrid
    time_grid() const
    {
      return {time_step, end_time, output_times};
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
    void
    read_times(const Constants &constants, PathParameters &path) const;

    void
    read_start(const Constants &constants, PathParameters &path) const;

    StepParameters steps_;
    std::string    load_factor_text_          = "default";
    std::string    end_time_text_             = "1";
    std::string    time_step_text_            = "0.1";
    std::string    minimum_time_step_text_    = "default";
    std::string    maximum_time_step_text_    = "default";
    std::string    output_times_text_         = "";
    std::string    initial_displacement_text_ = "0, 0, 0";
    std::string    initial_velocity_text_     = "0, 0, 0";
  };
} // namespace Nacre

#endif
