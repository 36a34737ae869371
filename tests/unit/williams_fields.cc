// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The fields at a crack's tip: derivatives, equilibrium, free lips,
// intensities, the energy that they release, by an integral over a domain, and
// the functions that tips of cuts have.

#include "unit_test.h"
#include <nacre/discretization/tip_functions.h>
#include <nacre/mechanics/hoop_stress.h>
#include <nacre/mechanics/linear_elastic_section.h>
#include <nacre/postprocess/crack_extension.h>

#include <deal.II/base/quadrature_lib.h>

#include <complex>

using namespace Nacre;

namespace
{
  const ElasticPlate plate{70., 0.3, 0.2};

  struct Plate : LinearSectionLaw
  {
    double
    thickness(const SectionPoint &) const override
    {
      return plate.thickness;
    }
    double
    density(const SectionPoint &) const override
    {
      return 0.;
    }
    SectionStiffness
    stiffness(const SurfaceFrame<> &frame, const SectionPoint &) const override
    {
      const auto   H = isotropic_stiffness(frame, plate.poissons_ratio);
      const double D = plate.bending_stiffness();
      return {12. * D / (plate.thickness * plate.thickness) * H, D * H};
    }
  };

  std::vector<WilliamsField>
  all_fields()
  {
    std::vector<WilliamsField> fields;
    for (const unsigned int n : {1, 2, 3, 5})
      for (const bool symmetric : {true, false})
        {
          fields.push_back(membrane_williams_field(n, symmetric, plate));
          fields.push_back(bending_williams_field(n, symmetric, plate));
        }
    return fields;
  }

  /** Membrane forces and moments 11, 22, 12 at a point. */
  template <typename Number>
  std::array<Voigt<Number>, 2>
  resultants(const WilliamsField &field, const Number &r, const Number &theta)
  {
    const double nu = plate.poissons_ratio, D = plate.bending_stiffness();
    const auto   du = field.gradient(r, theta), ddu = field.hessian(r, theta);
    const auto   answer = [&](const double  stiffness,
                            const Number &e11,
                            const Number &e22,
                            const Number &e12) {
      Voigt<Number> n;
      n[0] = stiffness * (e11 + nu * e22);
      n[1] = stiffness * (e22 + nu * e11);
      n[2] = stiffness * (1. - nu) * e12;
      return n;
    };
    return {{answer(12. * D / (plate.thickness * plate.thickness),
                    du[0][0],
                    du[1][1],
                    0.5 * (du[0][1] + du[1][0])),
             answer(D, -ddu[0][2], -ddu[1][2], -ddu[2][2])}};
  }

  using Complex       = std::complex<double>;
  constexpr double ih = 1e-30;

  /** The derivatives of a function of (r, theta) along x and y. */
  template <typename Function>
  auto
  gradient_of(const Function &function, const double r, const double theta)
  {
    const double c = std::cos(theta), s = std::sin(theta);
    return std::make_pair(
      function(Complex(r, ih * c), Complex(theta, -ih * s / r)),
      function(Complex(r, ih * s), Complex(theta, ih * c / r)));
  }

  double
  slope(const Complex &value)
  {
    return value.imag() / ih;
  }

  const std::array<CrackMode, 4> modes = {{CrackMode::opening,
                                           CrackMode::sliding,
                                           CrackMode::bending,
                                           CrackMode::twisting}};

  /** G of a field in a plane, by the integral over the ring of the plateau. */
  double
  release_rate(const std::vector<std::pair<double, CrackMode>> &fields,
               const bool                                       is_linear)
  {
    const Plate     section;
    const SectionAt at{section, Instant()};
    const CrackTip  tip{
      Point<3>(),
      {{Point<3>(1, 0, 0), Point<3>(0, 1, 0), Point<3>(0, 0, 1)}},
      1.};
    const CrackPlateau plateau{0.5, 2.};
    double             G = 0.;
    for (unsigned int part = 0; part < 8; ++part)
      {
        const QGauss<2> rule(12);
        for (unsigned int k = 0; k < rule.size(); ++k)
          {
            const double r = 0.5 + 1.5 * rule.point(k)[0];
            const double theta =
              numbers::PI / 4. * (part - 4. + rule.point(k)[1]);
            SurfacePatch      x{Point<3>(r * std::cos(theta),
                                    r * std::sin(theta),
                                    0.),
                           {{{Point<3>(1, 0, 0), Point<3>(0, 1, 0)}}, {}},
                           {}};
            VectorDerivatives u;
            for (const auto &[factor, mode] : fields)
              {
                const auto X =
                  williams_derivatives(unit_williams_field(mode, plate),
                                       tip,
                                       theta,
                                       x);
                for (unsigned int a = 0; a < 2; ++a)
                  u.first[a] += factor * X.first[a];
                for (unsigned int v = 0; v < 3; ++v)
                  u.second[v] += factor * X.second[v];
              }
            const CrackExtension q(tip, plateau, x);
            G -= energy_change(at, is_linear, x, q, u, Voigt<>(), 1.5) *
                 rule.weight(k) * 1.5 * r * numbers::PI / 4.;
          }
      }
    return G;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(williams_fields)

BOOST_AUTO_TEST_CASE(derivatives)
{
  for (const auto &field : all_fields())
    for (const double theta : {-3., 0.3, 2., 4.})
      {
        const double r = 0.7;
        for (unsigned int c = 0; c < 3; ++c)
          {
            const auto du   = field.gradient(r, theta);
            const auto ddu  = field.hessian(r, theta);
            const auto by_u = gradient_of(
              [&](const Complex &r, const Complex &theta) {
                return field.value(r, theta)[c];
              },
              r,
              theta);
            BOOST_TEST(std::abs(slope(by_u.first) - du[0][c]) < 1e-13);
            BOOST_TEST(std::abs(slope(by_u.second) - du[1][c]) < 1e-13);
            for (unsigned int a = 0; a < 2; ++a)
              {
                const auto by_du = gradient_of(
                  [&](const Complex &r, const Complex &theta) {
                    return field.gradient(r, theta)[a][c];
                  },
                  r,
                  theta);
                BOOST_TEST(std::abs(slope(by_du.first) -
                                    ddu[a == 0 ? 0 : 2][c]) < 1e-12);
                BOOST_TEST(std::abs(slope(by_du.second) -
                                    ddu[a == 0 ? 2 : 1][c]) < 1e-12);
              }
          }
      }
}

BOOST_AUTO_TEST_CASE(functions_of_a_tip)
{
  // On a curved surface, beside differences
  const TipFunctions functions = TipFunctions::branch_functions(
    {Point<3>(0.1, 0., 0.2),
     {{Point<3>(0.6, 0.8, 0), Point<3>(-0.8, 0.6, 0), Point<3>(0, 0, 1)}}},
    plate.poissons_ratio,
    0.5);
  const auto surface = [](const double u, const double v) {
    return FieldDerivatives{
      Point<3>(u + 0.1 * u * v, v + 0.2 * u * u, 0.3 * v * v + u),
      {{Point<3>(1. + 0.1 * v, 0.4 * u, 1.), Point<3>(0.1 * u, 1., 0.6 * v)}},
      {{Point<3>(0, 0.4, 0), Point<3>(0, 0, 0.6), Point<3>(0.1, 0, 0)}}};
  };
  const auto at = [&](const double u, const double v, const int side) {
    std::vector<FieldDerivatives> result;
    functions.evaluate(surface(u, v), side, result);
    return result;
  };
  const double d = 1e-5;
  for (const int side : {0, 1, -1})
    for (const auto &[u, v] :
         {std::pair(0.7, 0.3), std::pair(-0.2, 0.5), std::pair(-0.4, -0.5)})
      {
        const auto F = at(u, v, side);
        const auto values =
          functions.values(Point<3>(surface(u, v).value), side);
        const auto u_0 = at(u - d, v, side), u_1 = at(u + d, v, side);
        const auto v_0 = at(u, v - d, side), v_1 = at(u, v + d, side);
        for (unsigned int k = 0; k < F.size(); ++k)
          {
            const auto slope = [&](const Tensor<1, 3> &left,
                                   const Tensor<1, 3> &right,
                                   const Tensor<1, 3> &derivative) {
              BOOST_TEST(((right - left) / (2. * d) - derivative).norm() <
                         1e-7);
            };
            BOOST_TEST((F[k].value - values[k]).norm() < 1e-13);
            slope(u_0[k].value, u_1[k].value, F[k].first[0]);
            slope(v_0[k].value, v_1[k].value, F[k].first[1]);
            slope(u_0[k].first[0], u_1[k].first[0], F[k].second[0]);
            slope(v_0[k].first[1], v_1[k].first[1], F[k].second[1]);
            slope(v_0[k].first[0], v_1[k].first[0], F[k].second[2]);
          }
      }
  // The sheet of a lip goes on beyond the crack's line, which has a jump.
  const auto &tip    = functions.tip();
  const auto  behind = tip.position - 0.3 * tip.axes[0];
  for (const int side : {1, -1})
    {
      const auto lip = functions.values(behind, side);
      const auto before =
        functions.values(behind + 1e-6 * side * tip.axes[1], 0);
      const auto beyond =
        functions.values(behind - 1e-6 * side * tip.axes[1], side);
      const auto other = functions.values(behind, -side);
      double     jump  = 0.;
      for (unsigned int k = 0; k < lip.size(); ++k)
        {
          BOOST_TEST((lip[k] - before[k]).norm() < 1e-4);
          BOOST_TEST((lip[k] - beyond[k]).norm() < 1e-4);
          jump += (lip[k] - other[k]).norm();
        }
      BOOST_TEST(jump > 1.);
    }
}

BOOST_AUTO_TEST_CASE(equilibrium)
{
  // div n = 0, and the Laplacian of w is harmonic.
  for (const auto &field : all_fields())
    for (const double theta : {-2.5, 0.4, 1.7})
      {
        const double r      = 0.8;
        const auto   forces = [&](const unsigned int v) {
          return gradient_of(
            [&](const Complex &r, const Complex &theta) {
              return resultants(field, r, theta)[0][v];
            },
            r,
            theta);
        };
        const auto n11 = forces(0), n22 = forces(1), n12 = forces(2);
        BOOST_TEST(std::abs(slope(n11.first) + slope(n12.second)) < 1e-10);
        BOOST_TEST(std::abs(slope(n12.first) + slope(n22.second)) < 1e-10);

        // The Laplacian in a circle around the point has its value as mean.
        const auto laplacian = [&](const double x, const double y) {
          const auto ddu = field.hessian(std::hypot(x, y), std::atan2(y, x));
          return ddu[0][2] + ddu[1][2];
        };
        const double x = r * std::cos(theta), y = r * std::sin(theta);
        double       mean = 0.;
        for (unsigned int k = 0; k < 32; ++k)
          mean += laplacian(x + 0.1 * std::cos(numbers::PI * k / 16.),
                            y + 0.1 * std::sin(numbers::PI * k / 16.)) /
                  32.;
        BOOST_TEST(std::abs(mean - laplacian(x, y)) < 1e-12);
      }
}

BOOST_AUTO_TEST_CASE(free_lips)
{
  for (const auto &field : all_fields())
    for (const double theta : {-numbers::PI, numbers::PI})
      {
        const double r     = 0.6;
        const auto [n, m]  = resultants(field, r, theta);
        const double scale = 12. / (plate.thickness * plate.thickness);
        BOOST_TEST(std::abs(n[1]) < 1e-12 * scale);
        BOOST_TEST(std::abs(n[2]) < 1e-12 * scale);
        BOOST_TEST(std::abs(m[1]) < 1e-12);
        // V = m_22,2 + 2 m_12,1
        const auto along = [&](const unsigned int v) {
          return gradient_of(
            [&](const Complex &r, const Complex &theta) {
              return resultants(field, r, theta)[1][v];
            },
            r,
            theta);
        };
        BOOST_TEST(std::abs(slope(along(1).second) +
                            2. * slope(along(2).first)) < 1e-12);
      }
}

BOOST_AUTO_TEST_CASE(intensities)
{
  const double r = 0.01, nu = plate.poissons_ratio;
  const double root = std::sqrt(2. * numbers::PI * r);
  for (const auto mode : modes)
    {
      const auto [n, m] = resultants(unit_williams_field(mode, plate), r, 0.);
      const std::array<double, 4> found = {
        {n[1] / plate.thickness * root,
         n[2] / plate.thickness * root,
         m[1] * root,
         m[2] * root * (3. + nu) / (1. + nu)}};
      for (unsigned int k = 0; k < 4; ++k)
        BOOST_TEST(std::abs(found[k] - (mode == modes[k] ? 1. : 0.)) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(release_rates)
{
  for (const auto mode : modes)
    {
      const double G = unit_release_rate(mode, plate);
      BOOST_TEST(std::abs(release_rate({{1., mode}}, true) / G - 1.) < 1e-8);
      // Strains of 1e-8 are linear.
      BOOST_TEST(std::abs(1e16 * release_rate({{1e-8, mode}}, false) / G - 1.) <
                 1e-6);
      for (const auto other : modes)
        if (other != mode)
          {
            const double sum = release_rate({{1., mode}, {1., other}}, true) /
                               (G + unit_release_rate(other, plate));
            BOOST_TEST(std::abs(sum - 1.) < 1e-8);
          }
    }
}

BOOST_AUTO_TEST_CASE(hoop_stress)
{
  // Membrane forces alone: the closed form; nothing pulled: nothing
  for (const double K_II : {-2., -0.1, 1e-3, 0.7, 5.})
    {
      const double angle =
        largest_hoop_stress({{1., K_II, 0., 0.}}, plate).angle;
      const double root = std::sqrt(1. + 8. * K_II * K_II);
      BOOST_TEST(std::abs(std::tan(angle / 2.) - (1. - root) / (4. * K_II)) <
                 1e-12);
    }
  for (const double K_I : {0., -1.})
    {
      const auto none = largest_hoop_stress({{K_I, 0., 0., 0.}}, plate);
      BOOST_TEST(none.angle == 0.);
      BOOST_TEST(none.intensity == 0.);
    }

  // Beside the stresses of the fields, at heights and angles
  const double h = plate.thickness, b = h * h / 6.;
  for (const std::array<double, 4> &K :
       {std::array<double, 4>{{1., 0.3, 0., 0.}},
        std::array<double, 4>{{0., 0., b, 0.4 * b}},
        std::array<double, 4>{{0.2, -1., -b, 0.}},
        std::array<double, 4>{{-0.5, 0.1, 0.3 * b, -b}}})
    {
      const auto stress = [&](const double theta, const double z) {
        const double c = std::cos(theta), s = std::sin(theta);
        double       sum = 0.;
        for (unsigned int k = 0; k < 4; ++k)
          {
            const auto [n, m] =
              resultants(unit_williams_field(modes[k], plate), 1., theta);
            const auto sigma = n / h + 12. * z / (h * h * h) * m;
            sum += K[k] * (sigma[0] * s * s + sigma[1] * c * c -
                           2. * sigma[2] * s * c);
          }
        return std::sqrt(2. * numbers::PI) * sum;
      };
      const auto found = largest_hoop_stress(K, plate);
      BOOST_TEST(std::abs(stress(found.angle, found.height) / found.intensity -
                          1.) < 1e-12);
      for (int i = -99; i < 100; ++i)
        for (const double z : {-h / 2., 0., h / 4., h / 2.})
          BOOST_TEST(stress(numbers::PI * i / 100., z) <
                     (1. + 1e-12) * found.intensity);
    }
}

BOOST_AUTO_TEST_SUITE_END()
