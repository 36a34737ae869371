// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/laminate.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Nacre
{
  namespace
  {
    double
    largest_entry(const VoigtMatrix<> &matrix)
    {
      double largest = 0.;
      for (unsigned int v = 0; v < 3; ++v)
        for (unsigned int w = 0; w < 3; ++w)
          largest = std::max(largest, std::abs(matrix[v][w]));
      return largest;
    }

    /** alpha T of a layer at the height @p z, along and across its fibres. */
    Voigt<>
    free_expansion(const OrthotropicMaterial &material,
                   const Temperature         &temperature,
                   const double               z)
    {
      const double T = temperature.mean + z * temperature.gradient;
      return Voigt<>({material.alpha1 * T, material.alpha2 * T, 0.});
    }
  } // namespace

  Laminate::Laminate(const std::vector<Layer> &layers)
  {
    AssertThrow(!layers.empty(), ExcMessage("A laminate without plies."));
    double total = 0.;
    for (const Layer &layer : layers)
      total += layer.thickness;
    double bottom = -0.5, below = 0.;
    for (const Layer &layer : layers)
      {
        const double angle = layer.angle * numbers::PI / 180.;
        const double c = std::cos(angle), s = std::sin(angle);
        below += layer.thickness;
        PlacedLayer placed{layer.material,
                           strain_transformation({{c, s}}, {{-s, c}}),
                           layer.material.stiffness(),
                           bottom,
                           below / total - 0.5};
        bottom = placed.top;

        // Jones (4.22)-(4.24)
        const VoigtMatrix<> Qbar =
          transpose(placed.to_ply) * placed.Q * placed.to_ply;
        const double z0 = placed.bottom, z1 = placed.top;
        unit_.membrane += (z1 - z0) * Qbar;
        unit_.coupling += 0.5 * (z1 * z1 - z0 * z0) * Qbar;
        unit_.bending += (z1 * z1 * z1 - z0 * z0 * z0) / 3. * Qbar;
        layers_.push_back(placed);
      }
    // What is left of B in symmetric stacks is round-off of the sum.
    const double round_off = 8. * layers.size() *
                             std::numeric_limits<double>::epsilon() *
                             largest_entry(unit_.membrane);
    is_symmetric_ = largest_entry(unit_.coupling) <= round_off;
    if (is_symmetric_)
      unit_.coupling = 0.;
  }

  SectionStiffness
  Laminate::stiffness(const double h, const double offset) const
  {
    // z = h zeta + offset
    SectionStiffness result;
    result.membrane = h * unit_.membrane;
    result.coupling = h * h * unit_.coupling + h * offset * unit_.membrane;
    result.bending  = h * h * h * unit_.bending +
                     2. * h * h * offset * unit_.coupling +
                     h * offset * offset * unit_.membrane;
    return result;
  }

  double
  Laminate::density() const
  {
    double sum = 0.;
    for (const auto &layer : layers_)
      sum += (layer.top - layer.bottom) * layer.material.density;
    return sum;
  }

  std::vector<LayerState>
  Laminate::states(const Voigt<>     &eps,
                   const Voigt<>     &kappa,
                   const double       h,
                   const double       offset,
                   const Temperature &temperature) const
  {
    std::vector<LayerState> result;
    for (const auto &layer : layers_)
      {
        LayerState   state;
        const double heights[2] = {layer.bottom, layer.top};
        for (unsigned int face = 0; face < 2; ++face)
          {
            const double z     = h * heights[face] + offset;
            state.height[face] = z;
            state.strain[face] = layer.to_ply * (eps + z * kappa) -
                                 free_expansion(layer.material, temperature, z);
            state.stress[face] = layer.Q * state.strain[face];
            if (!layer.material.strengths)
              continue;
            const auto larger = [&](std::optional<double> &index,
                                    const double           value) {
              index = index ? std::max(*index, value) : value;
            };
            larger(state.tsai_wu, layer.material.tsai_wu(state.stress[face]));
            larger(state.maximum_stress,
                   layer.material.maximum_stress(state.stress[face]));
          }
        result.push_back(state);
      }
    return result;
  }

  Voigt<>
  Laminate::stress(const Voigt<>     &eps,
                   const Voigt<>     &kappa,
                   const double       zeta,
                   const double       h,
                   const double       offset,
                   const Temperature &temperature) const
  {
    const auto layer =
      std::find_if(layers_.begin(), layers_.end() - 1, [&](const auto &l) {
        return zeta < l.top;
      });
    const double z = h * zeta + offset;
    return transpose(layer->to_ply) *
           (layer->Q * (layer->to_ply * (eps + z * kappa) -
                        free_expansion(layer->material, temperature, z)));
  }

  InitialForces
  Laminate::thermal_forces(const Temperature &temperature,
                           const double       h,
                           const double       offset) const
  {
    InitialForces result;
    const double  T = temperature.mean, dT = temperature.gradient;
    for (const auto &layer : layers_)
      {
        const double z0 = h * layer.bottom + offset;
        const double z1 = h * layer.top + offset;
        // int z^k dz
        const double  I0      = z1 - z0;
        const double  I1      = 0.5 * (z1 * z1 - z0 * z0);
        const double  I2      = (z1 * z1 * z1 - z0 * z0 * z0) / 3.;
        const Voigt<> alpha   = free_expansion(layer.material, {1., 0.}, 0.);
        const Voigt<> Q_alpha = layer.Q * alpha;
        const Voigt<> stress  = transpose(layer.to_ply) * Q_alpha;
        result.membrane_force += (T * I0 + dT * I1) * stress;
        result.moment += (T * I1 + dT * I2) * stress;
        result.membrane_energy +=
          0.5 * (alpha * Q_alpha) *
          (T * T * I0 + 2. * T * dT * I1 + dT * dT * I2);
      }
    return result;
  }
} // namespace Nacre
