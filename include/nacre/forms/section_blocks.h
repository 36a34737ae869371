// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_section_blocks_h
#define nacre_forms_section_blocks_h

#include <nacre/forms/section_states.h>

#include <type_traits>

namespace Nacre
{
  /**
   * A section at a point, as the finite-rotation forms use it: its membrane
   * forces n, its moments m and its tangent, covariant basis of the undeformed
   * surface, Voigt order [resultant][strain],
   *
   *   dn = A dE + B dkappa,   dm = B^T dE + D dkappa.
   *
   * For linear laws these are n = A E + B kappa and m = B^T E + D kappa; others
   * are asked at the strains of evaluate().
   *
   * Nothing else in these forms knows how resultants follow from strains.
   */
  struct SectionBlocks
  {
    /**
     * @param point_frame must live as long
     * @param factor of all blocks: 1, or area times weight of a point
     * @param point_state must be there at evaluate()
     */
    SectionBlocks(const SectionLaw     &section,
                  const SurfaceFrame<> &point_frame,
                  const SectionPoint   &position,
                  const double          factor      = 1.,
                  const PointState     &point_state = {})
      : is_coupled(section.is_coupled())
      , law(section)
      , frame(point_frame)
      , point(position)
      , weight(factor)
      , state(point_state)
      , is_linear(section.is_linear())
    {
      if (is_linear)
        set_tangent(section.stiffness(frame, point));
    }

    /**
     * Take the strains E and kappa. Laws that aren't linear answer with n, m,
     * w and the tangent; where it is time, the state is replaced after that.
     * Such laws know no complex strains.
     */
    template <typename Number>
    void
    evaluate(const Voigt<Number> &membrane, const Voigt<Number> &bending)
    {
      if (is_linear)
        return;
      if constexpr (std::is_same<Number, double>::value)
        {
          const SectionResponse answer =
            law.response(membrane, bending, frame, point, state.values);
          if (state.is_updated)
            law.update_state(membrane, bending, frame, point, state.values);
          set_tangent(answer.tangent);
          n_answered = weight * answer.membrane_force;
          m_answered = weight * answer.moment;
          w_answered = weight * answer.energy;
        }
      else
        Assert(false, ExcNotImplemented());
    }

    /** n from E and kappa, those of evaluate(). */
    template <typename Number>
    Voigt<Number>
    force(const Voigt<Number> &membrane, const Voigt<Number> &bending) const
    {
      if (!is_linear)
        return Voigt<Number>(n_answered);
      Voigt<Number> n = A * membrane;
      if (is_coupled)
        n += B * bending;
      return subtract(n, initial.membrane_force);
    }

    /** m from E and kappa, those of evaluate(). */
    template <typename Number>
    Voigt<Number>
    moment(const Voigt<Number> &membrane, const Voigt<Number> &bending) const
    {
      if (!is_linear)
        return Voigt<Number>(m_answered);
      Voigt<Number> m = D * bending;
      if (is_coupled)
        m += transpose(B) * membrane;
      return subtract(m, initial.moment);
    }

    VoigtMatrix<> A, B, D;
    /** Whether B isn't zero. */
    bool is_coupled;
    /** Of initial strains, with the factors of the blocks: zero at first. */
    InitialForces initial;

    /**
     * What the energy is beyond 1/2 E : n and 1/2 kappa : m: that of initial
     * strains, and w - 1/2 E : n - 1/2 kappa : m of laws that aren't linear,
     * which counts as membrane energy.
     */
    std::array<double, 2>
    other_energies(const Voigt<> &membrane, const Voigt<> &bending) const
    {
      if (!is_linear)
        return {{w_answered - 0.5 * (n_answered * membrane) -
                   0.5 * (m_answered * bending),
                 0.}};
      return {
        {initial.membrane_energy - 0.5 * (initial.membrane_force * membrane),
         initial.bending_energy - 0.5 * (initial.moment * bending)}};
    }

  private:
    void
    set_tangent(const SectionStiffness &tangent)
    {
      A = weight * tangent.membrane;
      B = weight * tangent.coupling;
      D = weight * tangent.bending;
    }

    template <typename Number>
    static Voigt<Number>
    subtract(Voigt<Number> a, const Voigt<> &b)
    {
      for (unsigned int v = 0; v < 3; ++v)
        a[v] -= b[v];
      return a;
    }

    const SectionLaw     &law;
    const SurfaceFrame<> &frame;
    SectionPoint          point;
    double                weight;
    PointState            state;
    bool                  is_linear;
    /** Of evaluate(), weight included. */
    Voigt<> n_answered, m_answered;
    double  w_answered = 0.;
  };
} // namespace Nacre

#endif
