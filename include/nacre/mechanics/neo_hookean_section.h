// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_neo_hookean_section_h
#define nacre_mechanics_neo_hookean_section_h

#include <nacre/mechanics/integrated_section.h>
#include <nacre/mechanics/neo_hookean.h>

namespace Nacre
{
  /**
   * A section of an incompressible NeoHookean material, by Gauss points through
   * the thickness: C_ab(z) = a_ab - 2 z (b_ab - b0_ab) of the deformed surface,
   * with the metric of the undeformed mid-surface.
   */
  class NeoHookeanSection
    : public IntegratedSection<NeoHookean>
    , public ParameterAcceptor
  {
  public:
    /** Thickness and density are those of @p values. */
    explicit NeoHookeanSection(LinearElasticSection &values);

    void
    prepare(const Constants &constants) override;

    /** mu; E = 3 mu and nu = 1/2 as at small strains; h. */
    Constants
    named_constants() const override;

    SectionStiffness
    stiffness(const SurfaceFrame<> &frame,
              const SectionPoint   &point) const override;

  protected:
    NeoHookean
    material_at(const SectionPoint &point) const override;

  private:
    std::string  shear_modulus_text_;
    unsigned int n_points_ = 4;
    Expression   shear_modulus_;
  };
} // namespace Nacre

#endif
