// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_buckling_analysis_h
#define nacre_simulation_buckling_analysis_h

#include <nacre/simulation/mode_analysis.h>

namespace Nacre
{
  /**
   * Linear buckling: load factors lambda and modes u of
   *
   *   (K + G_0 + lambda G) u = 0
   *
   * with the stiffness K of the undeformed shell, G_0 of the Prestress at
   * t = 0, which stays, and G of what the loads change from t = 0 to t = 1. At
   * the state of another run, in equilibrium at t_0,
   *
   *   (K(u_0) + (lambda - t_0) dK/dt) u = 0
   *
   * with the derivative of the tangent along the curve of equilibria: lambda is
   * the t of a bifurcation or limit point to the first order.
   */
  class BucklingAnalysis : public ModeAnalysis
  {
  public:
    using ModeAnalysis::ModeAnalysis;

    std::string
    name() const override
    {
      return "buckling problem";
    }

  protected:
    void
    check_problem(DiscreteShell   &shell,
                  const Prestress &prestress) const override;

    Modes
    find_modes(DiscreteShell &shell, const Prestress &prestress) const override;

    std::string
    value_name() const override
    {
      return "load_factor";
    }

  private:
    /** The same at start(). */
    void
    assemble_at_start(const DiscreteShell &shell,
                      const Prestress     &prestress,
                      Matrix              &K,
                      Matrix              &G,
                      Modes               &modes) const;

    /** The factor that the eigenvalues are counted from. */
    double
    origin() const
    {
      return start() != nullptr ? start()->time : 0.;
    }

    /**
     * K + G_0, and minus G, which is the mass of the eigenproblem; and the
     * linear state at t = 1.
     */
    void
    assemble(DiscreteShell   &shell,
             const Prestress &prestress,
             Matrix          &K,
             Matrix          &G,
             Modes           &modes) const;

    /** By the size of the factors, as many as are wanted. */
    void
    sort_by_size(Modes &modes) const;

    /** Add the modes of factors of one @p sign of G, and how complete. */
    void
    add_modes(Eigenproblem &problem, const double sign, Modes &modes) const;
  };
} // namespace Nacre

#endif
