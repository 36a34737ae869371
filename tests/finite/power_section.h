// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_power_section_h
#define nacre_tests_power_section_h

#include <nacre/mechanics/linear_elastic_section.h>

#include <algorithm>
#include <utility>

namespace Tests
{
  using namespace Nacre;

  /**
   * A law that isn't linear, made of a linear one of the energy q:
   *
   *   w = q + beta q^2,   n = g n_lin,   m = g m_lin,   g = 1 + 2 beta q,
   *
   * which couples membrane and bending, and whose energy has derivatives of all
   * orders up to the fourth in the strains.
   *
   * With memory, g is that of r, the largest q so far: unloading is linear, and
   * the law is elastic as long as q grows. Its state is r.
   */
  template <typename Linear>
  class PowerSection : public Linear
  {
  public:
    template <typename... Arguments>
    PowerSection(const double beta,
                 const bool   has_memory,
                 Arguments &&...arguments)
      : Linear(std::forward<Arguments>(arguments)...)
      , beta_(beta)
      , has_memory_(has_memory)
    {}

    using Linear::response;

    SectionResponse
    response(const Voigt<>        &eps,
             const Voigt<>        &rho,
             const SurfaceFrame<> &frame,
             const SectionPoint   &point,
             const SectionState   &state) const override
    {
      SectionResponse answer = Linear::response(eps, rho, frame, point, {});
      const double    q      = answer.energy;
      const double    r      = largest(q, state);
      const double    g      = 1. + 2. * beta_ * r;
      const double    dg     = r == q ? 2. * beta_ : 0.;
      const auto      n = answer.membrane_force, m = answer.moment;
      answer.energy = r + beta_ * r * r + g * (q - r);
      answer.membrane_force *= g;
      answer.moment *= g;
      SectionStiffness &C = answer.tangent;
      C.membrane          = g * C.membrane + dg * outer_product(n, n);
      C.bending           = g * C.bending + dg * outer_product(m, m);
      C.coupling          = g * C.coupling + dg * outer_product(n, m);
      return answer;
    }

    SectionStiffness
    stiffness(const SurfaceFrame<> &frame,
              const SectionPoint   &point) const override
    {
      return Linear::stiffness(frame, point);
    }

    void
    update_state(const Voigt<>           &eps,
                 const Voigt<>           &rho,
                 const SurfaceFrame<>    &frame,
                 const SectionPoint      &point,
                 const ArrayView<double> &state) const override
    {
      if (has_memory_)
        state[0] =
          largest(Linear::response(eps, rho, frame, point, {}).energy, state);
    }

    unsigned int
    n_state_variables() const override
    {
      return has_memory_ ? 1 : 0;
    }

    bool
    is_linear() const override
    {
      return false;
    }

    bool
    is_coupled() const override
    {
      return true;
    }

  private:
    /** r of q and the state. */
    double
    largest(const double q, const SectionState &state) const
    {
      return has_memory_ && state.size() > 0 ? std::max(q, state[0]) : q;
    }

    const double beta_;
    const bool   has_memory_;
  };

  /** With memory, of an isotropic section. */
  struct MemorySection : PowerSection<LinearElasticSection>
  {
    explicit MemorySection(const LinearElasticSection &section)
      : PowerSection<LinearElasticSection>(beta, true, section)
    {}

    static constexpr double beta = 0.05;
  };

  struct MemorySectionParameters : LinearElasticSectionParameters
  {
    std::shared_ptr<const SectionLaw>
    make(const Constants             &constants,
         const std::optional<double> &thickness,
         const MeshRegions           &regions) const override
    {
      return std::make_shared<MemorySection>(
        section(constants, thickness, regions));
    }
  };
} // namespace Tests

#endif
