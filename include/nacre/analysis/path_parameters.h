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
    /** Motion in time. */
    dynamic
  };

  /** When increments are shortened. */
  enum class LineSearch
  {
    /** When a step has failed without. */
    automatic,
    always,
    never
  };

  /** The section Analysis of a parameter file. */
  class PathParameters : public ParameterAcceptor
  {
  public:
    PathParameters();

    /** Throws ExcMessage for values that don't go together. */
    void
    prepare(const Constants &constants);

    /** Where the steps end. */
    TimeGrid
    time_grid() const
    {
      return {time_step, end_time, output_times};
    }

    AnalysisType type = AnalysisType::linear;
    /** Name of the run whose last state is the start; empty: none. */
    std::string start_from;
    /** Factor of loads and prescribed values over t. */
    Expression load_factor;
    double     end_time  = 1.;
    double     time_step = 0.1;
    double     minimum_time_step;
    double     maximum_time_step;
    /** Times that are met exactly, and whose fields are written. */
    std::vector<double> output_times;

    NewtonSolver::Parameters newton;
    LineSearch               line_search = LineSearch::automatic;
    /** Factorise in the first iteration of a step only. */
    bool keeps_tangent = false;

    TimeScheme       scheme          = TimeScheme::energy_momentum;
    double           spectral_radius = 0.8;
    double           mass_damping    = 0.;
    VectorExpression initial_displacement;
    VectorExpression initial_velocity;

    unsigned int vtu_steps        = 1;
    unsigned int checkpoint_steps = 10;

  private:
    void
    prepare_times(const Constants &constants);

    void
    prepare_start(const Constants &constants);

    std::string type_text_                 = "linear";
    std::string load_factor_text_          = "default";
    std::string end_time_text_             = "1";
    std::string time_step_text_            = "0.1";
    std::string minimum_time_step_text_    = "default";
    std::string maximum_time_step_text_    = "default";
    std::string output_times_text_         = "";
    std::string line_search_text_          = "automatic";
    std::string tangent_updates_text_      = "every iteration";
    std::string scheme_text_               = "energy momentum";
    std::string initial_displacement_text_ = "0, 0, 0";
    std::string initial_velocity_text_     = "0, 0, 0";
  };
} // namespace Nacre

#endif
