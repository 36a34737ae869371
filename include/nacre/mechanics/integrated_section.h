// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_integrated_section_h
#define nacre_mechanics_integrated_section_h

#include <nacre/mechanics/linear_elastic_section.h>

#include <deal.II/base/quadrature.h>

#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * A section of one material in plane stress, by a rule through the thickness:
   * with the strain e = eps + z rho of the layer at the height z,
   *   n = int S dz,   m = int z S dz,   w = int psi dz,
   *   A = int T dz,   B = int z T dz,   D = int z^2 T dz
   * where T = dS/de. Areas, and the metric, are those of the mid-surface, as in
   * the linear section: an error of the order h/R.
   *
   * A material is a value with response() and update(), as NeoHookean, and a
   * line at the end of integrated_section.cc. The state of the section is that
   * of the material at each point of the rule, from the bottom up; the first
   * numbers of it are the results of the names Material::result_names.
   */
  template <typename Material>
  class IntegratedSection : public SectionLaw
  {
  public:
    /**
     * @param elastic its thickness and density are those of the section, its
     *        elastic constants those of materials that have such ones
     * @param rule points in [0, 1] from the bottom up, at least two
     */
    IntegratedSection(LinearElasticSection elastic, const Quadrature<1> &rule)
      : elastic_(std::move(elastic))
      , rule_(rule)
    {
      AssertThrow(rule_.size() > 1,
                  ExcMessage("A rule through the thickness needs two points "
                             "or more."));
    }

    double
    thickness(const SectionPoint &point) const override
    {
      return elastic_.thickness(point);
    }

    double
    density(const SectionPoint &point) const override
    {
      return elastic_.density(point);
    }

    unsigned int
    n_state_variables() const override
    {
      return rule_.size() * Material::n_state_variables;
    }

    using SectionLaw::response;

    SectionResponse
    response(const Voigt<>        &membrane_strain,
             const Voigt<>        &bending_strain,
             const SurfaceFrame<> &frame,
             const SectionPoint   &point,
             const SectionState   &state) const override;

    void
    update_state(const Voigt<>           &membrane_strain,
                 const Voigt<>           &bending_strain,
                 const SurfaceFrame<>    &frame,
                 const SectionPoint      &point,
                 const ArrayView<double> &state) const override;

    std::vector<std::string>
    state_result_names() const override
    {
      return {Material::result_names.begin(), Material::result_names.end()};
    }

    std::vector<double>
    state_results(const double side, const SectionState &state) const override;

    double
    dissipated_energy(const SectionPoint &point,
                      const SectionState &state) const override;

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

    Voigt<>
    stress(const Voigt<>        &membrane_strain,
           const Voigt<>        &bending_strain,
           const double          side,
           const SurfaceFrame<> &frame,
           const SectionPoint   &point) const override
    {
      return stress_at({},
                       membrane_strain,
                       bending_strain,
                       side,
                       frame,
                       point,
                       {});
    }

    /**
     * The second stress of Piola and Kirchhoff; between two points of the rule
     * the state is that of linear interpolation.
     */
    Voigt<>
    stress_at(const Instant        &instant,
              const Voigt<>        &membrane_strain,
              const Voigt<>        &bending_strain,
              const double          side,
              const SurfaceFrame<> &frame,
              const SectionPoint   &point,
              const SectionState   &state) const override;

  protected:
    /** The material at @p point of the surface. */
    virtual Material
    material_at(const SectionPoint &point) const = 0;

    const LinearElasticSection &
    elastic() const
    {
      return elastic_;
    }

  private:
    /** The height of the point @p q of the rule over the thickness. */
    double
    height(const unsigned int q) const
    {
      return rule_.point(q)[0] - 0.5;
    }

    /** The state at @p height, between two points of the rule or beyond. */
    std::vector<double>
    interpolate(const SectionState &state, const double height) const;

    LinearElasticSection elastic_;
    Quadrature<1>        rule_;
  };
} // namespace Nacre

#endif
