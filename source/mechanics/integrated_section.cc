// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/integrated_section.h>
#include <nacre/mechanics/j2_plasticity.h>
#include <nacre/mechanics/neo_hookean.h>
#include <nacre/mechanics/orthotropic_material.h>

namespace Nacre
{
  namespace
  {
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

    /** The @p n numbers of the point @p q of the rule; none of no state. */
    template <typename Number>
    ArrayView<Number>
    part(const ArrayView<Number> &state,
         const unsigned int       n,
         const unsigned int       q)
    {
      return state.size() == 0 ? state :
                                 ArrayView<Number>(state.data() + q * n, n);
    }
  } // namespace

  template <typename Material>
  SectionResponse
  IntegratedSection<Material>::response(const Voigt<>        &membrane_strain,
                                        const Voigt<>        &bending_strain,
                                        const SurfaceFrame<> &frame,
                                        const SectionPoint   &point,
                                        const SectionState   &state) const
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
          material.response(layers.strain(z),
                            layers.axes,
                            part(state, Material::n_state_variables, q));
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

  template <typename Material>
  void
  IntegratedSection<Material>::update_state(
    const Voigt<>           &membrane_strain,
    const Voigt<>           &bending_strain,
    const SurfaceFrame<>    &frame,
    const SectionPoint      &point,
    const ArrayView<double> &state) const
  {
    const Layers   layers(membrane_strain, bending_strain, frame);
    const Material material = material_at(point);
    const double   h        = thickness(point);
    for (unsigned int q = 0; q < rule_.size(); ++q)
      material.update(layers.strain(height(q) * h),
                      layers.axes,
                      part(state, Material::n_state_variables, q));
  }

  template <typename Material>
  Voigt<>
  IntegratedSection<Material>::stress_at(const Instant & /*instant*/,
                                         const Voigt<>        &membrane_strain,
                                         const Voigt<>        &bending_strain,
                                         const double          side,
                                         const SurfaceFrame<> &frame,
                                         const SectionPoint   &point,
                                         const SectionState   &state) const
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

  template <typename Material>
  std::vector<double>
  IntegratedSection<Material>::state_results(const double        side,
                                             const SectionState &state) const
  {
    std::vector<double> results = interpolate(state, 0.5 * side);
    results.resize(Material::result_names.size());
    return results;
  }

  template <typename Material>
  double
  IntegratedSection<Material>::dissipated_energy(
    const SectionPoint &point,
    const SectionState &state) const
  {
    const Material material = material_at(point);
    const double   h        = thickness(point);
    double         sum      = 0.;
    for (unsigned int q = 0; q < rule_.size(); ++q)
      sum += rule_.weight(q) * h *
             material.dissipated(part(state, Material::n_state_variables, q));
    return sum;
  }

  template <typename Material>
  std::vector<double>
  IntegratedSection<Material>::interpolate(const SectionState &state,
                                           const double        height) const
  {
    if (state.size() == 0)
      return {};
    unsigned int upper = 1;
    while (upper + 1 < rule_.size() && this->height(upper) < height)
      ++upper;
    const double share = (height - this->height(upper - 1)) /
                         (this->height(upper) - this->height(upper - 1));
    const auto below = part(state, Material::n_state_variables, upper - 1);
    const auto above = part(state, Material::n_state_variables, upper);
    std::vector<double> result(below.size());
    for (unsigned int k = 0; k < result.size(); ++k)
      result[k] = (1. - share) * below[k] + share * above[k];
    return result;
  }

  template class IntegratedSection<NeoHookean>;
  template class IntegratedSection<J2Plasticity>;
} // namespace Nacre
