// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_path_analysis_h
#define nacre_analysis_path_analysis_h

#include <nacre/analysis/equilibrium_curve.h>
#include <nacre/analysis/path_state.h>

#include <optional>
#include <string>

namespace Nacre
{
  /**
   * Follows a shell along a load path or in time, with steps that are halved
   * where one fails.
   */
  class PathAnalysis
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;
    /**
     * @param section gives the mass; not used in statics
     */
    PathAnalysis(const PathParameters &parameters,
                 ShellSystem          &system,
                 const SectionLaw     &section);

    /**
     * The state at t = 0: at rest and undeformed, or with the displacement and
     * in dynamics the velocity of @p start, if there is one; in dynamics what
     * the parameters say is added. Collective.
     */
    PathState
    initial_state(const MotionState *start = nullptr) const;

    /**
     * Go on from @p state to the end time, or to a step where a callback says
     * so; the start is brought to equilibrium first if t is unknown along the
     * path. Returns "", or, if a step can't be made small enough, why; @p state
     * is then the last good one.
     */
    std::string
    run(PathState &state, const PathCallbacks &callbacks);

    /**
     * Bring a static @p state that is close to equilibrium, as one that comes
     * from another mesh, to equilibrium at its own time, or, if t is unknown
     * along the path, as near as the curve is. Returns "" or why that failed;
     * @p state is unchanged then. Collective.
     */
    std::string
    settle(PathState &state);

    /**
     * Give a motion the accelerations of its forces at its time: where a cut
     * grows, time integrators begin anew. Collective.
     */
    void
    balance_acceleration(PathState &state);

    /**
     * Go on from a @p state with shorter cuts. In statics that is settle(). In
     * dynamics what the lips have carried falls to zero within @p duration,
     * or, if that is 0, is missing in the next step. Collective.
     */
    std::string
    resume(PathState &state, const double duration);

    /** Of a path along which t is unknown; null for others. */
    EquilibriumCurve *
    curve()
    {
      return curve_ ? &*curve_ : nullptr;
    }

    /** The mass of the shell in motion; null in statics. */
    const MassTerms *
    dynamic_mass() const
    {
      return parameters_.is_dynamic() ? &*mass_ : nullptr;
    }

  private:
    using Attempt = PathAttempt;

    /** a + c v (length/time^2), whose mass times it the forces bear. */
    Vector
    inertial_acceleration(const MotionState &motion) const;

    /** The forces of a step without duration that begins at @p start. */
    Inertia
    inertia_at(const Vector &w, const StepStart &start) const;

    /** try_step() as the parameters say: with a line search, without, both. */
    Attempt
    try_searches(const PathState &state, const double dt);

    Attempt
    try_step(const PathState &state, const double dt, const bool line_search);

    Attempt
    dynamic_step(const PathState &state, const double dt, const bool search);

    /** Why a dynamic path must not go on with this balance; or "". */
    std::string
    find_energy_gain(const EnergyBalance &balance) const;

    /** Dynamic relaxation from the last good state. */
    Attempt
    relax(const PathState &state, const double dt);

    const PathParameters    &parameters_;
    ShellSystem             &system_;
    const TimeIntegrator     integrator_;
    const StepControl        step_control_;
    std::optional<MassTerms> mass_;
    /** In dynamics only. */
    std::optional<EnergyLedger> ledger_;
    /** If t is unknown along the path. */
    std::optional<EquilibriumCurve> curve_;
  };
} // namespace Nacre

#endif
