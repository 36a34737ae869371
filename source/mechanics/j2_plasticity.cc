// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/j2_plasticity.h>
#include <nacre/mechanics/linear_elastic_section.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace Nacre
{
  namespace
  {
    /** The Cartesian components of e_p in a state, behind a. */
    SymmetricTensor<2, 3>
    read_plastic_strain(const SectionState &state)
    {
      SymmetricTensor<2, 3> e_p;
      for (unsigned int k = 0; k < e_p.n_independent_components; ++k)
        e_p.access_raw_entry(k) = state[1 + k];
      return e_p;
    }

    /** (e11, e22, 2 e12) along the axes. */
    Voigt<>
    along(const TangentAxes &axes, const SymmetricTensor<2, 3> &e)
    {
      const auto &[d1, d2] = axes;
      return Voigt<>({d1 * (e * d1), d2 * (e * d2), 2. * (d1 * (e * d2))});
    }

    /** The tensor of the tangent plane with these components. */
    SymmetricTensor<2, 3>
    in_space(const TangentAxes &axes, const Voigt<> &e)
    {
      const auto &[d1, d2] = axes;
      return symmetrize(e[0] * outer_product(d1, d1) +
                        e[1] * outer_product(d2, d2) +
                        e[2] * outer_product(d1, d2));
    }

    /**
     * s_eq^2 as a sum of what the mean of s11, s22 and what the deviation from
     * it contribute: plasticity scales each by a factor of its own.
     */
    std::array<double, 2>
    squared_equivalent(const Voigt<> &s)
    {
      const double sum = s[0] + s[1], difference = s[0] - s[1];
      return {
        {0.25 * sum * sum, 0.75 * difference * difference + 3. * s[2] * s[2]}};
    }

    /** P s of (s11, s22, s12): the flow (e11, e22, 2 e12), Simo & Taylor. */
    Voigt<>
    flow(const Voigt<> &s)
    {
      return Voigt<>(
        {(2. * s[0] - s[1]) / 3., (2. * s[1] - s[0]) / 3., 2. * s[2]});
    }
  } // namespace

  double
  J2Plasticity::plastic_multiplier(const Voigt<> &trial,
                                   const double   limit) const
  {
    const auto [mean, deviation] = squared_equivalent(trial);
    if (mean + deviation <= limit * limit)
      return 0.;
    // The stress of the multiplier x is the trial stress with the factors
    // 1/(1 + c x). The condition s_eq = limit + 2/3 H x s_eq, divided by s_eq
    // and limit, is concave and grows: Newton's method from 0 ascends to its
    // root, in one iteration if both factors are equal.
    const double c_mean      = youngs_modulus / (3. * (1. - poissons_ratio));
    const double c_deviation = youngs_modulus / (1. + poissons_ratio);
    const double hardens     = 2. / 3. * hardening;
    double       x           = 0.;
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
      {
        const double f_mean        = 1. / (1. + c_mean * x);
        const double f_deviation   = 1. / (1. + c_deviation * x);
        const double now_mean      = mean * f_mean * f_mean;
        const double now_deviation = deviation * f_deviation * f_deviation;
        const double equivalent    = std::sqrt(now_mean + now_deviation);
        const double value = 1. / equivalent - (1. - hardens * x) / limit;
        const double slope = (now_mean * c_mean * f_mean +
                              now_deviation * c_deviation * f_deviation) /
                               (equivalent * equivalent * equivalent) +
                             hardens / limit;
        const double step = -value / slope;
        x += step;
        if (!(step > 1e-14 * x))
          break;
      }
    return x;
  }

  VoigtMatrix<>
  J2Plasticity::algorithmic_stiffness(const double multiplier) const
  {
    // C and P have the same eigenvectors: (1, 1, 0), (1, -1, 0), (0, 0, 1).
    const double  E = youngs_modulus, nu = poissons_ratio;
    const double  mean      = E / (1. - nu + multiplier * E / 3.);
    const double  deviation = E / (1. + nu + multiplier * E);
    VoigtMatrix<> stiffness;
    stiffness[0][0] = stiffness[1][1] = 0.5 * (mean + deviation);
    stiffness[0][1] = stiffness[1][0] = 0.5 * (mean - deviation);
    stiffness[2][2]                   = 0.5 * deviation;
    return stiffness;
  }

  J2Plasticity::Return
  J2Plasticity::return_mapping(const Voigt<>      &strain,
                               const TangentAxes  &axes,
                               const SectionState &state) const
  {
    Return result;
    result.accumulated = 0.;
    if (state.size() > 0)
      {
        result.accumulated    = state[0];
        result.plastic_strain = along(axes, read_plastic_strain(state));
      }
    const Voigt<> trial = strain - result.plastic_strain;
    result.multiplier =
      plastic_multiplier(algorithmic_stiffness(0.) * trial,
                         yield_stress + hardening * result.accumulated);
    result.stress = algorithmic_stiffness(result.multiplier) * trial;
    if (result.multiplier == 0.)
      return result;
    const auto [mean, deviation] = squared_equivalent(result.stress);
    result.accumulated +=
      2. / 3. * result.multiplier * std::sqrt(mean + deviation);
    result.plastic_strain += result.multiplier * flow(result.stress);
    return result;
  }

  VoigtMatrix<>
  J2Plasticity::tangent(const Voigt<> &stress, const double multiplier) const
  {
    const VoigtMatrix<> stiffness = algorithmic_stiffness(multiplier);
    if (multiplier == 0.)
      return stiffness;
    // Simo & Taylor (1986): ds = Xi (de - dx P s), and dx by consistency
    const Voigt<> n              = flow(stress);
    const Voigt<> Xi_n           = stiffness * n;
    const auto [mean, deviation] = squared_equivalent(stress);
    const double hardens         = 2. / 3. * hardening;
    const double beta =
      2. / 3. * hardens * (mean + deviation) / (1. - hardens * multiplier);
    return stiffness - outer_product(Xi_n, Xi_n) / (n * Xi_n + beta);
  }

  PlaneStress
  J2Plasticity::response(const Voigt<>      &strain,
                         const TangentAxes  &axes,
                         const SectionState &state) const
  {
    const Return end = return_mapping(strain, axes, state);
    PlaneStress  answer;
    answer.stress  = end.stress;
    answer.tangent = tangent(end.stress, end.multiplier);
    answer.energy =
      0.5 * (end.stress * (strain - end.plastic_strain)) +
      (yield_stress + 0.5 * hardening * end.accumulated) * end.accumulated;
    return answer;
  }

  void
  J2Plasticity::update(const Voigt<>           &strain,
                       const TangentAxes       &axes,
                       const ArrayView<double> &state) const
  {
    const Return end = return_mapping(strain, axes, state);
    const auto   e_p = in_space(axes, end.plastic_strain);
    state[0]         = end.accumulated;
    for (unsigned int k = 0; k < e_p.n_independent_components; ++k)
      state[1 + k] = e_p.access_raw_entry(k);
  }
} // namespace Nacre
