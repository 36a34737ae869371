// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The report's cell route (21)-(33), written out with vector products, against
// the cheaper forms that the library takes: membrane and bending rows of a
// shape function, the change of the normal, the section's Voigt matrices; and
// what (31) gives as it is printed.

#include "../tests_common.h"
#include <nacre/mechanics/shell_strain.h>

using namespace Tests;

Vector3
vector(const double x, const double y, const double z)
{
  Vector3 v;
  v[0] = x;
  v[1] = y;
  v[2] = z;
  return v;
}

/** Some shape function: its first and second derivatives. */
struct Shape
{
  std::array<double, 2> dN;
  std::array<double, 3> ddN;
};

/** One node's block of a strain matrix, [Voigt][component]. */
using Block = Tensor<2, 3>;

double
difference(const Block &found, const Block &expected)
{
  return (found - expected).norm() / expected.norm();
}

/** Column c is the strain of the displacement N e_c. */
template <typename Strain>
Block
columns(const Strain &strain)
{
  Block block;
  for (unsigned int c = 0; c < 3; ++c)
    {
      Vector3 e;
      e[c]             = 1.;
      const auto voigt = strain(e);
      for (unsigned int v = 0; v < 3; ++v)
        block[v][c] = voigt[v];
    }
  return block;
}

/** Membrane rows: N,1 phi,1; N,2 phi,2; N,2 phi,1 + N,1 phi,2. */
Block
report_membrane(const SurfaceFrame<> &frame, const Shape &N)
{
  Block block;
  block[0] = N.dN[0] * frame.a_cov[0];
  block[1] = N.dN[1] * frame.a_cov[1];
  block[2] = N.dN[1] * frame.a_cov[0] + N.dN[0] * frame.a_cov[1];
  return block;
}

/**
 * Bending rows, (4) and (28): with the vector products of the linearised
 * normal,
 * rho_ab = -u,ab . t0 + (u,1 . (phi,ab x phi,2) + u,2 . (phi,1 x phi,ab)) / j0
 *          + (t0 . phi,ab) (u,1 . (phi,2 x t0) + u,2 . (t0 x phi,1)) / j0.
 */
Block
report_bending(const SurfaceFrame<> &frame, const Shape &N)
{
  const auto &[a_1, a_2] = frame.a_cov;
  const auto &t0         = frame.t0;
  const auto  tilt =
    N.dN[0] * cross_product_3d(a_2, t0) + N.dN[1] * cross_product_3d(t0, a_1);
  Block block;
  for (unsigned int v = 0; v < 3; ++v)
    {
      const auto &a_ab = frame.a_cov_derivatives[v];
      block[v]         = -N.ddN[v] * t0 +
                 (N.dN[0] * cross_product_3d(a_ab, a_2) +
                  N.dN[1] * cross_product_3d(a_1, a_ab) + (t0 * a_ab) * tilt) /
                   frame.j0;
    }
  block[2] *= 2.;
  return block;
}

/**
 * Change of the normal, rows are its components:
 * Delta t = (1 - t0 t0^T) (u,1 x phi,2 + phi,1 x u,2) / j0.
 */
Block
report_normal_change(const SurfaceFrame<> &frame, const Shape &N)
{
  return columns([&](const Vector3 &e) {
    const auto change = (N.dN[0] * cross_product_3d(e, frame.a_cov[1]) +
                         N.dN[1] * cross_product_3d(frame.a_cov[0], e)) /
                        frame.j0;
    return change - (change * frame.t0) * frame.t0;
  });
}

/** phi,1, phi,2, phi,11, phi,22, phi,12: points of no symmetry, a flat one. */
const std::vector<std::array<Vector3, 5>> points = {{{vector(1.1, 0.2, -0.3),
                                                      vector(0.5, 0.8, 0.4),
                                                      vector(0.3, -0.7, 0.9),
                                                      vector(-0.2, 0.6, 1.3),
                                                      vector(0.4, 0.5, -0.8)}},
                                                    {{vector(-0.3, 0.9, 0.2),
                                                      vector(-1.4, -0.2, 0.7),
                                                      vector(0.1, 0.2, 2.9),
                                                      vector(-1.2, 0.3, 0.3),
                                                      vector(0.7, -0.4, 0.6)}},
                                                    {{vector(2., 0.1, 0.),
                                                      vector(-0.4, 0.7, 0.),
                                                      vector(0.2, 0.3, 0.),
                                                      vector(-0.1, 0.5, 0.),
                                                      vector(0.4, 0.6, 0.)}}};

void
test_rows()
{
  const Shape N        = {{{0.3, -0.8}}, {{0.7, -0.2, 1.1}}};
  double      membrane = 0., bending = 0., change = 0., without_gamma = 1e300;
  for (const auto &phi : points)
    {
      const auto frame =
        make_surface_frame(phi[0],
                           phi[1],
                           std::array<Vector3, 3>{{phi[2], phi[3], phi[4]}});
      membrane =
        std::max(membrane,
                 difference(columns([&](const Vector3 &e) {
                              return ShellStrain::membrane(frame,
                                                           N.dN[0] * e,
                                                           N.dN[1] * e);
                            }),
                            report_membrane(frame, N)));
      const auto rho =
        ShellStrain::bending_of_shape_function(frame, N.dN, N.ddN);
      const auto expected = report_bending(frame, N);
      bending =
        std::max(bending, difference(outer_product(rho, frame.t0), expected));
      // The test can fail: without the Christoffel symbols it does.
      const auto flat = ShellStrain::bending_of_shape_function(
        make_surface_frame(phi[0], phi[1], std::array<Vector3, 3>()),
        N.dN,
        N.ddN);
      without_gamma =
        std::min(without_gamma,
                 difference(outer_product(flat, frame.t0), expected));
      change = std::max(change,
                        difference(columns([&](const Vector3 &e) {
                                     return ShellStrain::normal_change(
                                       frame,
                                       {{N.dN[0] * e, N.dN[1] * e}});
                                   }),
                                   report_normal_change(frame, N)));
    }
  check_below("membrane rows", membrane, 1e-14);
  check_below("bending rows: (28) against the Christoffel form",
              bending,
              1e-13);
  check_above("bending rows without Christoffel symbols", without_gamma, 0.1);
  check_below("change of the normal", change, 1e-13);
}

/** Voigt matrices of the section, (29)-(31), against the tensor (8)-(10). */
void
test_section()
{
  const double     E = 1000., nu = 0.3, h = 0.1;
  const Parameters parameters(section_text(E, nu, h));
  const auto       frame      = make_surface_frame(vector(1.1, 0.2, -0.3),
                                        vector(0.5, 0.8, 0.4),
                                        std::array<Vector3, 3>());
  const auto       stiffness  = parameters.section.stiffness(frame, Point<3>());
  const auto &[G11, G22, G12] = frame.metric_con;

  // (29): the dimensionless H in Voigt order 11, 22, 12.
  VoigtMatrix<> H;
  H[0][0] = G11 * G11;
  H[1][1] = G22 * G22;
  H[0][1] = H[1][0] = nu * G11 * G22 + (1. - nu) * G12 * G12;
  H[0][2] = H[2][0] = G11 * G12;
  H[1][2] = H[2][1] = G22 * G12;
  H[2][2]           = 0.5 * ((1. - nu) * G11 * G22 + (1. + nu) * G12 * G12);

  const double factor = 1. - nu * nu;
  check_below("(29)-(30): membrane stiffness",
              difference(E * h / factor * H, stiffness.membrane),
              1e-14);
  const double bending = E * h * h * h / 12.;
  check_below("(31) with 1 - nu^2: bending stiffness",
              difference(bending / factor * H, stiffness.bending),
              1e-14);
  // Printed: 1 / 0.91 - 1 too stiff.
  check_above("printed (31), (1 - nu^2)^2: misses by",
              difference(bending / (factor * factor) * H, stiffness.bending),
              0.09);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_rows();
  test_section();
  return n_failures > 0;
}
