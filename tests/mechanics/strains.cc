// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Frames of closed-form surfaces; strains and the change of the normal against
// automatic differentiation of the deformed geometry; the isotropic stiffness
// against the fourth-order tensor.

#include "../tests_common.h"
#include <nacre/mechanics/linear_elastic_section.h>
#include <nacre/mechanics/shell_strain.h>

#include <deal.II/differentiation/ad.h>

using namespace Tests;
using Dual = Sacado::Fad::DFad<double>;

/** phi0,1, phi0,2, phi0,11, phi0,22, phi0,12. */
using Derivatives = std::array<Vector3, 5>;

Vector3
vector(const double x, const double y, const double z)
{
  Vector3 v;
  v[0] = x;
  v[1] = y;
  v[2] = z;
  return v;
}

SurfaceFrame<>
make_frame(const Derivatives &d)
{
  return make_surface_frame(d[0],
                            d[1],
                            std::array<Vector3, 3>{{d[2], d[3], d[4]}});
}

/** Cylinder R (cos s, sin s), z with s = xi1 / R + 0.3 xi2, z = xi2. */
void
test_cylinder()
{
  const double R = 2.5, s = 0.7, k = 0.3;
  const auto   radial = vector(std::cos(s), std::sin(s), 0.);
  const auto   hoop   = vector(-std::sin(s), std::cos(s), 0.);
  const auto   frame  = make_frame({{hoop,
                                     R * k * hoop + vector(0, 0, 1),
                                     -1. / R * radial,
                                     -R * k * k * radial,
                                     -k * radial}});
  // Metric a_11 = 1, a_12 = R k, a_22 = 1 + (R k)^2: determinant 1.
  check_below("cylinder: normal", (frame.t0 - radial).norm(), 1e-13);
  check_below("cylinder: area", std::abs(frame.j0 - 1.), 1e-13);
  check_below("cylinder: metric",
              std::abs(frame.metric_con[0] - 1. - R * k * R * k) +
                std::abs(frame.metric_con[1] - 1.) +
                std::abs(frame.metric_con[2] + R * k),
              1e-13);
  double christoffel = 0.;
  for (const auto &symbols : frame.christoffel)
    for (const double symbol : symbols)
      christoffel += std::abs(symbol);
  check_below("cylinder: Christoffel symbols", christoffel, 1e-13);
}

/** Sphere of radius R by longitude xi1 and latitude xi2. */
void
test_sphere()
{
  const double R = 1.5, l = 0.4, b = 0.6;
  const double cl = std::cos(l), sl = std::sin(l), cb = std::cos(b),
               sb  = std::sin(b);
  const auto frame = make_frame({{R * cb * vector(-sl, cl, 0),
                                  R * vector(-sb * cl, -sb * sl, cb),
                                  -R * cb * vector(cl, sl, 0),
                                  -R * vector(cb * cl, cb * sl, sb),
                                  -R * sb * vector(-sl, cl, 0)}});
  check_below("sphere: normal",
              (frame.t0 - vector(cb * cl, cb * sl, sb)).norm(),
              1e-13);
  check_below("sphere: area", std::abs(frame.j0 - R * R * cb), 1e-13);
  check_below("sphere: metric",
              std::abs(frame.metric_con[0] - 1. / (R * R * cb * cb)) +
                std::abs(frame.metric_con[1] - 1. / (R * R)) +
                std::abs(frame.metric_con[2]),
              1e-13);
  double dual = 0.;
  for (unsigned int a = 0; a < 2; ++a)
    for (unsigned int g = 0; g < 2; ++g)
      dual += std::abs(frame.a_con[a] * frame.a_cov[g] - (a == g));
  check_below("sphere: contravariant basis", dual, 1e-13);
  // Gamma^2_11 = sin b cos b, Gamma^1_12 = -tan b, all others vanish.
  const std::array<std::array<double, 3>, 2> exact = {
    {{{0., 0., -sb / cb}}, {{sb * cb, 0., 0.}}}};
  double error = 0.;
  for (unsigned int g = 0; g < 2; ++g)
    for (unsigned int v = 0; v < 3; ++v)
      error += std::abs(frame.christoffel[g][v] - exact[g][v]);
  check_below("sphere: Christoffel symbols", error, 1e-13);
}

/** A skew, curved point of no particular symmetry and a displacement. */
const Derivatives geometry     = {{vector(1.1, 0.2, -0.3),
                                   vector(0.5, 0.8, 0.4),
                                   vector(0.3, -0.7, 0.9),
                                   vector(-0.2, 0.6, 1.3),
                                   vector(0.4, 0.5, -0.8)}};
const Derivatives displacement = {{vector(0.3, -0.4, 0.7),
                                   vector(-0.6, 0.2, 0.5),
                                   vector(0.9, 0.1, -0.4),
                                   vector(0.2, -0.8, 0.6),
                                   vector(-0.5, 0.7, 0.3)}};

/** Derivatives with respect to the load factor of the deformed geometry. */
void
test_linearisations()
{
  std::array<Tensor<1, 3, Dual>, 5> phi;
  const Dual                        factor(1, 0, 0.);
  for (unsigned int k = 0; k < 5; ++k)
    for (unsigned int c = 0; c < 3; ++c)
      phi[k][c] = geometry[k][c] + factor * displacement[k][c];
  const auto deformed = make_surface_frame(phi[0],
                                           phi[1],
                                           std::array<Tensor<1, 3, Dual>, 3>{
                                             {phi[2], phi[3], phi[4]}});

  const auto                   frame = make_frame(geometry);
  const std::array<Vector3, 2> du    = {{displacement[0], displacement[1]}};
  const std::array<Vector3, 3> ddu   = {
      {displacement[2], displacement[3], displacement[4]}};
  const auto derivative = [](const Dual &x) { return x.dx(0); };

  // Green strain's linearisation, (3).
  const auto eps = ShellStrain::membrane(frame, du[0], du[1]);
  check_below("membrane strain against differentiation",
              std::abs(eps[0] - derivative(0.5 * (phi[0] * phi[0]))) +
                std::abs(eps[1] - derivative(0.5 * (phi[1] * phi[1]))) +
                std::abs(eps[2] - derivative(phi[0] * phi[1])),
              1e-13);

  // (4): -(phi,ab . t) + (phi0,ab . t0).
  const auto rho   = ShellStrain::bending(frame, du, ddu);
  double     error = 0.;
  for (unsigned int v = 0; v < 3; ++v)
    error += std::abs(rho[v] - (v == 2 ? 2. : 1.) *
                                 derivative(-(phi[2 + v] * deformed.t0)));
  check_below("bending strain against differentiation", error, 1e-13);

  // The same of a shape function times a direction.
  const std::array<double, 2> dN  = {{0.3, -0.8}};
  const std::array<double, 3> ddN = {{0.7, -0.2, 1.1}};
  const auto                  e   = vector(0.2, -0.5, 0.9);
  const auto                  whole =
    ShellStrain::bending(frame,
                         std::array<Vector3, 2>{{dN[0] * e, dN[1] * e}},
                         std::array<Vector3, 3>{
                           {ddN[0] * e, ddN[1] * e, ddN[2] * e}});
  const auto single = ShellStrain::bending_of_shape_function(frame, dN, ddN);
  check_below("bending strain of a shape function",
              (whole - (frame.t0 * e) * single).norm(),
              1e-13);

  const auto change = ShellStrain::normal_change(frame, du);
  error             = 0.;
  for (unsigned int c = 0; c < 3; ++c)
    error += std::abs(change[c] - derivative(deformed.t0[c]));
  check_below("change of normal against differentiation", error, 1e-13);
}

/** (8)-(10) with loops over all components. */
void
test_stiffness()
{
  const double     E = 210., nu = 0.27, h = 0.2;
  const Parameters parameters(section_text(E, nu, h));
  const auto       frame     = make_frame(geometry);
  const auto       stiffness = parameters.section.stiffness(frame, Point<3>());

  const std::array<std::array<double, 2>, 2> G = {
    {{{frame.metric_con[0], frame.metric_con[2]}},
     {{frame.metric_con[2], frame.metric_con[1]}}}};
  const std::array<std::array<unsigned int, 2>, 3> pair = {
    {{{0, 0}}, {{1, 1}}, {{0, 1}}}};
  double membrane = 0., bending = 0.;
  for (unsigned int v = 0; v < 3; ++v)
    for (unsigned int w = 0; w < 3; ++w)
      {
        const auto [a, b] = pair[v];
        const auto [c, d] = pair[w];
        const double H =
          nu * G[a][b] * G[c][d] +
          0.5 * (1. - nu) * (G[a][c] * G[b][d] + G[a][d] * G[b][c]);
        const double H_n = E * h / (1. - nu * nu) * H;
        membrane += std::abs(stiffness.membrane[v][w] - H_n);
        bending += std::abs(stiffness.bending[v][w] - h * h / 12. * H_n);
      }
  check_below("isotropic membrane stiffness", membrane, 1e-11);
  check_below("isotropic bending stiffness", bending, 1e-13);

  // Contraction with a unit vector: components against space tensors.
  const auto nu_1 = vector(0.4, -0.1, 0.3);
  auto       unit = nu_1 - (nu_1 * frame.t0) * frame.t0;
  unit /= unit.norm();
  Voigt<> resultant;
  resultant[0]      = 0.7;
  resultant[1]      = -0.4;
  resultant[2]      = 0.9;
  const auto tensor = ShellStrain::resultant_tensor(frame, resultant);
  const auto dyad   = ShellStrain::dyad_of(frame, unit);
  check_below("resultants across a direction",
              std::abs(dyad * resultant - unit * (tensor * unit)),
              1e-13);
  // H(nu, nu, nu, nu) of the isotropic law is 1 in every direction.
  check_below("isotropic stiffness across a direction",
              std::abs(dyad * (stiffness.bending * dyad) /
                         (E * h * h * h / (12. * (1. - nu * nu))) -
                       1.),
              1e-13);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_cylinder();
  test_sphere();
  test_linearisations();
  test_stiffness();
  return n_failures > 0;
}
