// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Laminates at a point: A, B, D and stresses of plies by hand, the isotropic
// section as a special case, and the same body in any basis.

#include "laminate_parameters.h"
#include <nacre/mechanics/shell_strain.h>

using namespace Tests;

/** Of the plane z = 0 with the basis @p a_1, @p a_2. */
SurfaceFrame<>
frame_of(const Vector3 &a_1, const Vector3 &a_2)
{
  return make_surface_frame(a_1, a_2, {});
}

const SurfaceFrame<> plane =
  frame_of(Vector3({1., 0., 0.}), Vector3({0., 1., 0.}));

double
difference(const VoigtMatrix<> &found, const VoigtMatrix<> &expected)
{
  return (found - expected).norm() / expected.norm();
}

VoigtMatrix<>
matrix(const double m11,
       const double m22,
       const double m12,
       const double m16,
       const double m26,
       const double m66)
{
  VoigtMatrix<> m;
  m[0][0] = m11;
  m[1][1] = m22;
  m[2][2] = m66;
  m[0][1] = m[1][0] = m12;
  m[0][2] = m[2][0] = m16;
  m[1][2] = m[2][1] = m26;
  return m;
}

// Q of graphite: 1 - nu12 nu21 = 1 - 0.25^2/25 = 0.9975
const double Q11 = 25. / 0.9975, Q22 = 1. / 0.9975, Q12 = 0.25 / 0.9975,
             Q66 = 0.5;

void
test_stiffness()
{
  const double h = 0.2;
  {
    const LaminateParameters p(laminate_text("[0/90]", "0.2"));
    const auto               s    = p.section.stiffness(plane, Point<3>());
    const double             mean = 0.5 * (Q11 + Q22);
    check_below("[0/90]: A",
                difference(s.membrane,
                           h * matrix(mean, mean, Q12, 0., 0., Q66)),
                1e-14);
    check_below("[0/90]: B",
                difference(s.coupling,
                           h * h / 8. * (Q22 - Q11) *
                             matrix(1., -1., 0., 0., 0., 0.)),
                1e-14);
    check_below("[0/90]: D",
                difference(s.bending,
                           h * h * h / 12. *
                             matrix(mean, mean, Q12, 0., 0., Q66)),
                1e-14);
  }
  {
    // Qbar at 45 degrees: Jones (2.80) with m = n
    const LaminateParameters p(laminate_text("[+-45]", "0.2"));
    const auto               s   = p.section.stiffness(plane, Point<3>());
    const double             sum = 0.25 * (Q11 + Q22 + 2. * Q12);
    const double             Q16 = 0.25 * (Q11 - Q22);
    const double             Qs  = 0.25 * (Q11 + Q22 - 2. * Q12);
    check_below(
      "[+-45]: A",
      difference(s.membrane,
                 h * matrix(sum + Q66, sum + Q66, sum - Q66, 0., 0., Qs)),
      1e-14);
    check_below("[+-45]: B",
                difference(s.coupling,
                           -h * h / 4. * Q16 * matrix(0., 0., 0., 1., 1., 0.)),
                1e-14);
  }
  {
    const LaminateParameters p(
      laminate_text("[0/90]s", "0.2", "  set Offset = h/2\n"));
    const auto               s = p.section.stiffness(plane, Point<3>());
    const LaminateParameters q(laminate_text("[0/90]s", "0.2"));
    const auto               s0 = q.section.stiffness(plane, Point<3>());
    check_below("offset: B", difference(s.coupling, 0.1 * s.membrane), 1e-14);
    check_below("offset: D",
                difference(s.bending, s0.bending + 0.01 * s.membrane),
                1e-14);
    check_below("symmetric, no offset: B", s0.coupling.norm(), 1e-300);
    check("symmetric, no offset: coupled",
          !q.section.is_coupled(),
          q.section.is_coupled(),
          "=",
          0.);
    check("offset: coupled",
          p.section.is_coupled(),
          p.section.is_coupled(),
          "=",
          1.);
  }
  {
    // Plies of several materials and thicknesses
    const LaminateParameters p(laminate_text(
      "[0_skin/0_core]s",
      "",
      "",
      "skin: E1 = 25, E2 = 1, nu12 = 0.25, G12 = 0.5, ply = 0.01, "
      "density = 2; core: E1 = 1, E2 = 1, nu12 = 0, G12 = 0.5, ply = 0.04, "
      "density = 1"));
    const auto               s = p.section.stiffness(plane, Point<3>());
    check_below("sandwich: A11",
                std::abs(s.membrane[0][0] - 0.02 * Q11 - 0.08),
                1e-14);
    check_below("sandwich: density",
                std::abs(p.section.density(Point<3>()) - 1.2),
                1e-14);
    check_below("sandwich: thickness",
                std::abs(p.section.thickness(Point<3>()) - 0.1),
                1e-15);
  }
}

void
test_isotropic()
{
  // Any angles, any basis
  const auto frame =
    frame_of(Vector3({1.3, 0.2, 0.4}), Vector3({-0.5, 2., -0.3}));
  SectionStiffness expected;
  {
    const Parameters p(section_text(1000., 0.3, 0.2));
    expected = p.section.stiffness(frame, Point<3>());
  }
  const LaminateParameters p(
    laminate_text("[0/17/-33/90/45_2]",
                  "0.2",
                  "  set Material direction = 1, 2, 3\n",
                  "steel: E1 = 1000, E2 = 1000, nu12 = 0.3, G12 = 1000/2.6"));
  const auto found = p.section.stiffness(frame, Point<3>());
  check_below("isotropic: A",
              difference(found.membrane, expected.membrane),
              1e-13);
  check_below("isotropic: D",
              difference(found.bending, expected.bending),
              1e-13);
  check("isotropic: coupled",
        !p.section.is_coupled(),
        p.section.is_coupled(),
        "=",
        0.);
}

void
test_plies()
{
  const double             h = 0.2;
  const LaminateParameters p(laminate_text("[45/0]", "0.2"));
  // e_xx = 1e-3, kappa_xx = 2e-2 of the mid-surface
  Voigt<> eps, rho;
  eps[0]           = 1e-3;
  rho[0]           = 2e-2;
  const auto plies = p.section.layers(eps, rho, plane, Point<3>());
  double     error = 0.;
  for (unsigned int k = 0; k < 2; ++k)
    for (unsigned int face = 0; face < 2; ++face)
      {
        const double z = h / 2. * (double(k) - 1. + double(face));
        const double e = 1e-3 + 2e-2 * z;
        // At 45 degrees (e, e, -2 e)/2, along the fibres (e, 0, 0)
        const Voigt<> strain =
          k == 0 ? Voigt<>({0.5 * e, 0.5 * e, -e}) : Voigt<>({e, 0., 0.});
        const Voigt<> stress({Q11 * strain[0] + Q12 * strain[1],
                              Q12 * strain[0] + Q22 * strain[1],
                              Q66 * strain[2]});
        error =
          std::max({error,
                    (plies[k].strain[face] - strain).norm() / 1e-3,
                    (plies[k].stress[face] - stress).norm() / (Q11 * 1e-3)});
      }
  check_below("strains and stresses of plies", error, 1e-14);

  // The upper ply feels s1 alone at its top: e = 3e-3, s1 = Q11 e, s2 = Q12 e.
  const double s1 = Q11 * 3e-3, s2 = Q12 * 3e-3;
  check_below("maximum stress",
              std::abs(*plies[1].maximum_stress - std::max(s1 / 2., s2 / 0.05)),
              1e-14);
  const double F1 = 1. / 2. - 1. / 1.5, F2 = 1. / 0.05 - 1. / 0.2;
  const double F11 = 1. / 3., F22 = 1. / 0.01;
  check_below("Tsai-Wu",
              std::abs(*plies[1].tsai_wu -
                       (F1 * s1 + F2 * s2 + F11 * s1 * s1 + F22 * s2 * s2 -
                        std::sqrt(F11 * F22) * s1 * s2)),
              1e-14);
  OrthotropicMaterial material;
  material.strengths = {2., 1.5, 0.05, 0.2, 0.1};
  for (const auto &stress : {Voigt<>({2., 0., 0.}),
                             Voigt<>({-1.5, 0., 0.}),
                             Voigt<>({0., 0.05, 0.}),
                             Voigt<>({0., -0.2, 0.}),
                             Voigt<>({0., 0., 0.1}),
                             Voigt<>({0., 0., -0.1})})
    check_below("indices at a strength",
                std::abs(material.tsai_wu(stress) - 1.) +
                  std::abs(material.maximum_stress(stress) - 1.),
                1e-13);
}

/** Covariant (e11, e22, 2 e12) of a tensor of space. */
Voigt<>
covariant(const Tensor<2, 3> &e, const SurfaceFrame<> &frame)
{
  const auto &a = frame.a_cov;
  return Voigt<>(
    {a[0] * (e * a[0]), a[1] * (e * a[1]), 2. * (a[0] * (e * a[1]))});
}

/** Membrane forces and moments in space, energy, and states of all plies. */
struct Body
{
  Tensor<2, 3>            n, m;
  double                  energy;
  std::vector<LayerState> layers;
  double                  top_stress;
};

/** @p bending is the bending strain for the normal of the plane. */
Body
body_in(const SurfaceFrame<>  &frame,
        const LaminateSection &section,
        const Tensor<2, 3>    &membrane,
        const Tensor<2, 3>    &bending)
{
  // The bending strain changes its sign with the normal.
  const double sign   = frame.t0[2] > 0. ? 1. : -1.;
  const auto   eps    = covariant(membrane, frame);
  const auto   rho    = covariant(sign * bending, frame);
  const auto   answer = section.response(eps, rho, frame, Point<3>());
  return {ShellStrain::resultant_tensor(frame, answer.membrane_force),
          sign * ShellStrain::resultant_tensor(frame, answer.moment),
          answer.energy,
          section.layers(eps, rho, frame, Point<3>()),
          ShellStrain::resultant_tensor(
            frame,
            section.stress(eps, rho, sign, frame, Point<3>()))
            .norm()};
}

void
test_bases()
{
  Tensor<2, 3> membrane, bending;
  membrane[0][0] = 1e-3;
  membrane[0][1] = membrane[1][0] = 4e-4;
  membrane[1][1]                  = -7e-4;
  bending[0][0]                   = 3e-2;
  bending[0][1] = bending[1][0] = -1e-2;
  bending[1][1]                 = 2e-2;
  const LaminateParameters p(
    laminate_text("[0/30/-60_2]",
                  "0.2",
                  "  set Offset = 0.05\n  set Top = 0, 0.3, 1\n"
                  "  set Material direction = 1, 0.5, 7\n"));
  const auto    expected = body_in(plane, p.section, membrane, bending);
  const Vector3 a({1.3, 0.2, 0.}), b({-0.5, 2., 0.});
  for (const auto &[name, frame] :
       {std::make_pair("skew", frame_of(a, b)),
        std::make_pair("turned", frame_of(b, -a)),
        std::make_pair("swapped, the normal down", frame_of(b, a)),
        std::make_pair("mirrored, the normal down", frame_of(-a, b))})
    {
      const auto body = body_in(frame, p.section, membrane, bending);
      double     error =
        std::max({(body.n - expected.n).norm() / expected.n.norm(),
                  (body.m - expected.m).norm() / expected.m.norm(),
                  std::abs(body.top_stress / expected.top_stress - 1.),
                  std::abs(body.energy / expected.energy - 1.)});
      for (unsigned int k = 0; k < expected.layers.size(); ++k)
        for (unsigned int face = 0; face < 2; ++face)
          error = std::max(error,
                           (body.layers[k].stress[face] -
                            expected.layers[k].stress[face])
                               .norm() /
                             expected.layers[k].stress[face].norm());
      check_below(std::string("the same body, ") + name, error, 1e-13);
    }
  // Stresses at the faces are those of the outer plies: 3 rotations apart
  const auto stress_norm = [](const Voigt<> &s) {
    return std::sqrt(s[0] * s[0] + s[1] * s[1] + 2. * s[2] * s[2]);
  };
  check_below("stress at the top",
              std::abs(stress_norm(expected.layers.back().stress[1]) /
                         expected.top_stress -
                       1.),
              1e-13);
}

/** A study's thickness is that of all layups but those with their own. */
void
test_thickness_of_study()
{
  ParameterAcceptor::clear();
  LaminateSectionParameters parameters;
  read_text(laminate_text("[0/90]s",
                          "0.2",
                          "  set Offset = h/2\n"
                          "  set Regions = web: h = 0.3\n"));
  MeshRegions regions;
  regions.regions.push_back({{"web"}, ""});
  const auto section = parameters.section({}, 0.4, regions);
  for (const unsigned int region : {0, 1})
    {
      const double       h = region == 0 ? 0.4 : 0.3;
      const SectionPoint point(Point<3>(), region);
      const std::string  name = "study, region " + std::to_string(region);
      check_below(name + ": thickness",
                  std::abs(section.thickness(point) - h),
                  1e-15);
      const auto s = section.stiffness(plane, point);
      check_below(name + ": B of the offset",
                  difference(s.coupling, 0.5 * h * s.membrane),
                  1e-14);
    }
}

int
main()
{
  test_stiffness();
  test_isotropic();
  test_plies();
  test_bases();
  test_thickness_of_study();
  return n_failures > 0;
}
