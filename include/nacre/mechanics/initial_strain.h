// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_initial_strain_h
#define nacre_mechanics_initial_strain_h

#include <nacre/mechanics/section_law.h>
#include <nacre/mechanics/surface_axes.h>

#include <deal.II/base/parameter_acceptor.h>

#include <map>
#include <string>
#include <vector>

namespace Nacre
{
  /** Strains that a section has without any stress. */
  struct InitialStrain
  {
    /** E0 (e11, e22, 2 e12), covariant (length^2). */
    Voigt<> membrane;
    /** kappa0 (k11, k22, 2 k12), covariant (length). */
    Voigt<> bending;
    /** How much warmer the plies of a laminate are. */
    Temperature temperature;
  };

  /**
   * The change of the second fundamental form of a surface with the covariant
   * strain @p E (e11, e22, 2 e12) that keeps angles to the normal: the
   * symmetric part of E_a^c b_cb, Voigt (11, 22, 2 * 12); phi scaled by 1 + e
   * has (1 + e) b, to first order in e.
   */
  Voigt<>
  curvature_of_growth(const Voigt<> &E, const SurfaceFrame<> &frame);

  /**
   * The initial strains of a parameter file, subsection Section/Initial strain:
   * growth, and thermal strains, which are alpha T + z alpha T' of an isotropic
   * section. All of them are multiplied by the factor of an Instant.
   */
  class InitialStrainParameters : public ParameterAcceptor
  {
  public:
    InitialStrainParameters();

    /**
     * Evaluate the texts; throws for what is no expression, and for values that
     * a section with plies takes from their materials.
     */
    void
    prepare(const Constants &constants, const bool has_plies);

    /** As SectionLaw::set_regions(). */
    void
    set_regions(const MeshRegions &mesh);

    bool
    is_zero() const
    {
      return is_zero_;
    }

    /** Whether plies are warmer. */
    bool
    has_temperature() const;

    /** At a @p point of the surface; throws as projected_direction(). */
    InitialStrain
    at(const SurfaceFrame<> &frame,
       const SectionPoint   &point,
       const Instant        &instant) const;

  private:
    /** Values by their keys; what is missing is zero, or the section's. */
    using Values = std::map<std::string, Expression>;

    void
    prepare_regions(const Constants &constants);

    double
    value(const std::string  &key,
          const SectionPoint &point,
          const Instant      &instant) const;

    /** Keys of the texts, in the order of keys(). */
    std::string strain_text_      = "0, 0, 0";
    std::string curvature_text_   = "0, 0, 0";
    std::string direction_text_   = "x";
    std::string expansion_text_   = "0";
    std::string temperature_text_ = "0";
    std::string gradient_text_    = "0";
    bool        keeps_angles_     = false;
    std::string regions_text_;

    Values                        values_;
    VectorExpression              direction_;
    bool                          has_plies_ = false;
    bool                          is_zero_   = true;
    std::map<std::string, Values> regions_;
    /** By the region of a point; null: none of its own. */
    std::vector<const Values *> region_of_id_;
  };
} // namespace Nacre

#endif
