// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_integrated_section_h
#define nacre_mechanics_integrated_section_h

#include <nacre/mechanics/linear_elastic_section.h>
#include <nacre/mechanics/orthotropic_material.h>
#include <nacre/mechanics/plane_stress.h>

#include <deal.II/base/quadrature.h>

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
   * A material is a value with response() and update(), as NeoHookean. The
   * state of the section is that of the material at each point of the rule,
   * from the bottom up.
   */
  template <typename Material>
  class IntegratedSection : public SectionLaw
  {
  public:
    /** Thickness, density and elastic constants are those of @p values. */
    explicit IntegratedSection(LinearElasticSection &values)
      : values_(values)
    {}

    void
    prepare(const Constants &constants) override
    {
      values_.prepare(constants);
    }

    void
    set_thickness(const double thickness) override
    {
      values_.set_thickness(thickness);
    }

    Constants
    named_constants() const override
    {
      return values_.named_constants();
    }

    void
    set_regions(const MeshRegions &mesh) override
    {
      values_.set_regions(mesh);
    }

    double
    thickness(const SectionPoint &point) const override
    {
      return values_.thickness(point);
    }

    double
    density(const SectionPoint &point) const override
    {
      return values_.density(point);
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
             const SectionState   &state) const override
    {
      const Layers    layers(membrane_strain, bending_strain, frame);
      const Material  material = material_at(point);
      const double    h        = thickness(point);
      SectionResponse answer;
      for (unsigned int q = 0; q < rule_.size(); ++q)
        {
          const double z  = height(q) * h;
          const double dz = rule_.weight(q) * h;
          const auto   layer =
            material.response(layers.strain(z), layers.axes, part(state, q));
          answer.membrane_force += dz * layer.stress;
          answer.moment += (dz * z) * layer.stress;
          answer.energy += dz * layer.energy;
          answer.tangent.membrane += dz * layer.tangent;
          answer.tangent.coupling += (dz * z) * layer.tangent;
          answer.tangent.bending += (dz * z * z) * layer.tangent;
        }
      const auto &T         = layers.to_axes;
      const auto  T_t       = transpose(T);
      answer.membrane_force = T_t * answer.membrane_force;
      answer.moment         = T_t * answer.moment;
      for (auto *const block : {&answer.tangent.membrane,
                                &answer.tangent.coupling,
                                &answer.tangent.bending})
        *block = T_t * *block * T;
      return answer;
    }

    void
    update_state(const Voigt<>           &membrane_strain,
                 const Voigt<>           &bending_strain,
                 const SurfaceFrame<>    &frame,
                 const SectionPoint      &point,
                 const ArrayView<double> &state) const override
    {
      const Layers   layers(membrane_strain, bending_strain, frame);
      const Material material = material_at(point);
      const double   h        = thickness(point);
      for (unsigned int q = 0; q < rule_.size(); ++q)
        material.update(layers.strain(height(q) * h),
                        layers.axes,
                        part(state, q));
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
    stress_at(const Instant & /*instant*/,
              const Voigt<>        &membrane_strain,
              const Voigt<>        &bending_strain,
              const double          side,
              const SurfaceFrame<> &frame,
              const SectionPoint   &point,
              const SectionState   &state) const override
    {
      const Layers layers(membrane_strain, bending_strain, frame);
      const auto   here = interpolate(state, 0.5 * side);
      return transpose(layers.to_axes) *
             material_at(point)
               .response(layers.strain(0.5 * side * thickness(point)),
                         layers.axes,
                         make_array_view(here))
               .stress;
    }

  protected:
    /** The material at @p point of the surface. */
    virtual Material
    material_at(const SectionPoint &point) const = 0;

    /** Points in [0, 1] from the bottom up, at least two. */
    void
    set_rule(const Quadrature<1> &rule)
    {
      rule_ = rule;
    }

    const LinearElasticSection &
    values() const
    {
      return values_;
    }

  private:
    /** The strains of the layers along orthogonal axes of the surface. */
    struct Layers
    {
      Layers(const Voigt<>        &membrane_strain,
             const Voigt<>        &bending_strain,
             const SurfaceFrame<> &frame)
      {
        axes[0]       = frame.a_cov[0] / frame.a_cov[0].norm();
        axes[1]       = cross_product_3d(frame.t0, axes[0]);
        const auto &a = frame.a_con;
        to_axes  = strain_transformation({{axes[0] * a[0], axes[0] * a[1]}},
                                        {{axes[1] * a[0], axes[1] * a[1]}});
        membrane = to_axes * membrane_strain;
        bending  = to_axes * bending_strain;
      }

      Voigt<>
      strain(const double z) const
      {
        return membrane + z * bending;
      }

      TangentAxes   axes;
      VoigtMatrix<> to_axes;
      Voigt<>       membrane, bending;
    };

    /** The height of the point @p q of the rule over the thickness. */
    double
    height(const unsigned int q) const
    {
      return rule_.point(q)[0] - 0.5;
    }

    /** What of the section's @p state is that of the point @p q of the rule. */
    template <typename Number>
    static ArrayView<Number>
    part(const ArrayView<Number> &state, const unsigned int q)
    {
      const unsigned int n = Material::n_state_variables;
      return state.size() == 0 ? state :
                                 ArrayView<Number>(state.data() + q * n, n);
    }

    /** The state at @p height, between two points of the rule or beyond. */
    std::vector<double>
    interpolate(const SectionState &state, const double height) const
    {
      if (state.size() == 0)
        return {};
      unsigned int upper = 1;
      while (upper + 1 < rule_.size() && this->height(upper) < height)
        ++upper;
      const double share = (height - this->height(upper - 1)) /
                           (this->height(upper) - this->height(upper - 1));
      const auto          below = part(state, upper - 1);
      const auto          above = part(state, upper);
      std::vector<double> result(below.size());
      for (unsigned int k = 0; k < result.size(); ++k)
        result[k] = (1. - share) * below[k] + share * above[k];
      return result;
    }

    LinearElasticSection &values_;
    Quadrature<1>         rule_;
  };
} // namespace Nacre

#endif
