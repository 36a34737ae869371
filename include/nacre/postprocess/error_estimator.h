// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_error_estimator_h
#define nacre_postprocess_error_estimator_h

#include <nacre/discretization/displacement_conditions.h>
#include <nacre/forms/edge_penalty.h>
#include <nacre/forms/shell_actions.h>
#include <nacre/forms/shell_terms.h>
#include <nacre/postprocess/error_indicators.h>

#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <vector>

namespace Nacre
{
  /**
   * Residual estimator of the energy norm of the error,
   *
   *   eta_K^2 = int_K r . W r dA                              equilibrium
   *     + 1/2 sum_e int_e k/4 J . W J                         traction
   *                     + k^3/4 W_n [[m_nn]]^2                moment
   *                     + eta^e D [[theta]]^2 ds              rotation
   *
   * with the residuals of the strong form: the vector of internal forces
   *   f^b = n^ab a_a + (1/sqrt a) (sqrt a m^ab t0),a + m^cd Gamma^b_cd t0
   * and p the load give r = p + div f; J is the jump of the traction
   * f^b nu_b + d/ds (m^ab nu_a tau_b t0). The stresses are interpolated
   * within each cell and differentiated, and no residual is split into
   * components: the weight W, a tensor of space, does that (error_weight()).
   *
   * In large rotations the residuals are those of equilibrium at the deformed
   * state, exactly but for the shear strain of edges against 1, f that of
   * StressPolynomials, theta and m_nn those of FiniteEdgePoint (lambda m_nn);
   * the weight is that of the deformed surface without its prestress.
   *
   * Of cells that cuts divide, eta_K^2 is the sum over their parts, whose lips
   * are free edges. doc/adaptive.md derives the estimate and tells what is
   * neglected.
   */
  class ErrorEstimator
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;

    /** A displacement and the data whose solution it approximates. */
    struct Field
    {
      /** Ghosted displacement (length). */
      const Vector *displacement;
      /**
       * Whether loads act and rotations are prescribed as stated; else all of
       * them are 0, as for the dual solution.
       */
      bool has_data = true;
      /** The loads and rotations at its time; null: those of Instant(). */
      const ShellActions *actions = nullptr;
      /** Of a section with memory; null: at rest. */
      SectionStates *section_states = nullptr;
    };

    /** Everything must stay alive; collective. */
    ErrorEstimator(const Discretization &discretization,
                   const ShellParts     &parts,
                   const EdgePenalty    &penalty);

    /** eta_K^2 of one field, of any kinematics; collective. */
    ErrorIndicators
    estimate(const Field &field) const;

    /**
     * Of two fields of linear kinematics: eta_K^2(u), eta_K^2(z), and the
     * signed products.
     */
    std::array<ErrorIndicators, 3>
    estimate(const Field &u, const Field &z) const;

  private:
    class Assembly;

    const Discretization        &discretization_;
    const ShellParts             parts_;
    const EdgePenalty           &penalty_;
    const DisplacementConditions conditions_;
  };
} // namespace Nacre

#endif
