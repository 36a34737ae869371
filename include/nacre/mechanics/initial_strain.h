// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_initial_strain_h
#define nacre_mechanics_initial_strain_h

#include <nacre/mechanics/section_law.h>
#include <nacre/mechanics/section_regions.h>
#include <nacre/mechanics/surface_axes.h>

#include <deal.II/base/parameter_acceptor.h>

#include <map>
#include <string>

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
   * The initial strains of a section over its surface. All of them are
   * multiplied by the factor of an Instant.
   */
  class InitialStrains
  {
  public:
    /** Values by their keys, those of the parameter 'Regions', all of them. */
    using Values = std::map<std::string, Expression>;

    /**
     * @param direction the axis 1 is its projection onto the surface
     * @param keeps_angles whether curvature_of_growth() is added
     * @param has_plies whether temperatures are left to plies; otherwise they
     *        strain the section by alpha T + z alpha T'
     */
    InitialStrains(ByRegion<Values>        values,
                   const VectorExpression &direction,
                   const bool              keeps_angles,
                   const bool              has_plies);

    bool
    is_zero() const
    {
      return is_zero_;
    }

    /** Whether there are temperatures. */
    bool
    has_temperature() const
    {
      return has_temperature_;
    }

    /** At a @p point of the surface; throws as projected_direction(). */
    InitialStrain
    at(const SurfaceFrame<> &frame,
       const SectionPoint   &point,
       const Instant        &instant) const;

  private:
    ByRegion<Values> values_;
    VectorExpression direction_;
    bool             keeps_angles_;
    bool             has_plies_;
    bool             is_zero_;
    bool             has_temperature_;
  };

  /** The section Section/Initial strain of a parameter file. */
  class InitialStrainParameters : public ParameterAcceptor
  {
  public:
    InitialStrainParameters();

    /**
     * Throws for what is no expression, for values that a section with plies
     * takes from their materials, and as ByRegion for the mesh's @p regions.
     */
    InitialStrains
    make(const Constants   &constants,
         const bool         has_plies,
         const MeshRegions &regions) const;

  private:
    using Values = InitialStrains::Values;

    /** Those of everywhere. */
    Values
    values(const Constants &constants) const;

    /** Those of regions, by their names. */
    std::map<std::string, Values>
    values_of_regions(const Values    &everywhere,
                      const Constants &constants,
                      const bool       has_plies) const;

    std::string strain_       = "0, 0, 0";
    std::string curvature_    = "0, 0, 0";
    std::string direction_    = "x";
    std::string expansion_    = "0";
    std::string temperature_  = "0";
    std::string gradient_     = "0";
    bool        keeps_angles_ = false;
    std::string regions_;
  };
} // namespace Nacre

#endif
