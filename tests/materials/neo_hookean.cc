// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The neo-Hookean section at a point: derivatives, closed forms of sheets,
// spheres, tubes and of a bent strip.

#include "section_points.h"

using namespace Tests;

std::string
rubber(const unsigned int points = 4)
{
  return "set Type = neo-Hookean\n"
         "subsection Neo-Hookean\n"
         " set Shear modulus = 1\n"
         " set Points = " +
         std::to_string(points) + "\nend\n";
}

const std::string elastic = "set Young's modulus = 1\n"
                            "set Poisson's ratio = 0.3\n";

std::string
thick(const double h)
{
  return "set Thickness = " + std::to_string(h) + "\n";
}

/** Membrane strains of principal stretches. */
Strains
stretched(const double l_1, const double l_2)
{
  return {{0.5 * (l_1 * l_1 - 1.), 0.5 * (l_2 * l_2 - 1.), 0., 0., 0., 0.}};
}

void
test_derivatives()
{
  const auto           section = section_of_lines(rubber() + thick(0.3));
  const Strains        strains = {{0.3, -0.1, 0.25, 0.4, -0.7, 0.5}};
  const PointOfSection skewed(*section, skewed_frame());
  const PointOfSection straight(*section, cartesian_frame());
  check_derivatives("derivatives", skewed, strains, 2e-3, 1e-9);
  check_below("basis",
              difference(skewed.response(strains), straight.response(strains)),
              1e-12);
  const NeoHookeanSection of_numbers(1., 0.3);
  check_below(
    "numbers",
    difference(PointOfSection(of_numbers, skewed_frame()).response(strains),
               skewed.response(strains)),
    1e-14);
  const auto rest = section->stiffness(skewed_frame(), Point<3>());
  const auto zero = section->response({}, {}, skewed_frame(), Point<3>());
  check_below("stiffness at rest",
              (rest.membrane - zero.tangent.membrane).norm() /
                  rest.membrane.norm() +
                (rest.bending - zero.tangent.bending).norm() /
                  rest.bending.norm(),
              1e-13);
  // A sheet that keeps its volume: E = 3 mu, nu = 1/2
  const auto linear =
    LinearElasticSection(3., 0.5, 0.3).stiffness(skewed_frame(), Point<3>());
  check_below("isotropic section of nu = 1/2",
              (rest.membrane - linear.membrane).norm() /
                  linear.membrane.norm() +
                (rest.bending - linear.bending).norm() / linear.bending.norm(),
              1e-12);
  // C_11 of the lower face is negative
  const auto impossible = straight.response({{0., 0., 0., 4., 0., 0.}});
  check_below("no answer to impossible strains",
              std::isfinite(impossible.energy) ||
                std::isfinite(impossible.force[0]),
              1);
}

/** Nominal stress P = lambda S of a sheet. */
void
test_sheet()
{
  const auto           section = section_of_lines(rubber() + thick(0.1));
  const PointOfSection sheet(*section, skewed_frame());
  const double         l = 1.5, h = 0.1;
  const auto           nominal = [&](const double l_2) {
    return l * sheet.response(stretched(l, l_2)).force[0] / h;
  };
  check_below("uniaxial",
              std::abs(nominal(1. / std::sqrt(l)) - 1.0555555555556),
              1e-12);
  check_below("equibiaxial", std::abs(nominal(l) - 1.3683127572016), 1e-12);
  check_below("pure shear", std::abs(nominal(1.) - 1.2037037037037), 1e-12);
  check_below("uniaxial, free sides",
              std::abs(
                sheet.response(stretched(l, 1. / std::sqrt(l))).force[1]),
              1e-13);
  const auto S = sheet.stress(stretched(l, 1.), -1.);
  check_below("stress", std::abs(l * S[0] - 1.2037037037037), 1e-12);
}

/**
 * The pressure p R/h of a sphere of radius R = 1 that is inflated by the
 * stretch l: 4 pi l^2 p dl = 4 pi dw, and kappa = b0 - b = l - 1.
 */
double
sphere_pressure(const SectionLaw &law, const double h, const double l)
{
  Strains strains = stretched(l, l);
  strains[3] = strains[4] = l - 1.;
  const auto force =
    PointOfSection(law, skewed_frame()).response(strains).force;
  return ((force[0] + force[1]) * l + force[3] + force[4]) / (l * l * h);
}

void
test_sphere()
{
  const double h       = 0.05;
  const auto   section = section_of_lines(rubber() + thick(h));
  double       error   = 0.;
  for (const auto &[l, p] : {std::make_pair(1.1, 0.79192692),
                             std::make_pair(1.3, 1.21973309),
                             std::make_pair(1.5, 1.21627078),
                             std::make_pair(2., 0.98437256)})
    error = std::max(error, std::abs(sphere_pressure(*section, h, l) - p));
  check_below("sphere", error, 1e-8);
}

/** The linear law through the thickness: Saint Venant and Kirchhoff's. */
void
test_saint_venant_sphere()
{
  const double h       = 0.05;
  const auto   section = section_of_lines(elastic + thick(h));
  double       error   = 0.;
  for (const auto &[l, p] : {std::make_pair(1.1, 0.27277647),
                             std::make_pair(1.3, 0.75834742),
                             std::make_pair(1.5, 1.19060847),
                             std::make_pair(2., 2.14300595)})
    error = std::max(error, std::abs(sphere_pressure(*section, h, l) - p));
  check_below("sphere, Saint Venant-Kirchhoff", error, 1e-8);
}

/** p R/(mu h) of long tubes without bending, hoop stretch l. */
void
test_tube()
{
  const double         h       = 0.1;
  const auto           section = section_of_lines(rubber() + thick(h));
  const PointOfSection tube(*section, skewed_frame());
  struct Row
  {
    double l, fixed, free, closed, axial;
  };
  double error = 0.;
  for (const Row &row :
       {Row{1.1, 0.31698654, 0.26082324, 0.32362626, 1.00645074},
        Row{1.5, 0.80246914, 0.86185750, 0.74445086, 1.13860139},
        Row{2., 0.9375, 1.23743687, 0.67549281, 1.43549997}})
    {
      error =
        std::max(error,
                 std::abs(tube.response(stretched(row.l, 1.)).force[0] / h -
                          row.fixed));
      // p R 2 pi l dl times the length
      Strains strains = stretched(row.l, std::pow(row.l, -0.4));
      tube.solve(strains, {1}, {0.});
      const double axial = std::sqrt(1. + 2. * strains[1]);
      error              = std::max(error,
                       std::abs(tube.response(strains).force[0] / (h * axial) -
                                row.free));
      const auto closed  = tube.response(stretched(row.l, row.axial)).force;
      error =
        std::max(error, std::abs(closed[0] / (h * row.axial) - row.closed));
      // Axial nominal force: p pi (l R)^2
      error = std::max(error,
                       std::abs(closed[1] * row.axial / h -
                                0.5 * row.closed * row.l * row.l));
    }
  check_below("tubes", error, 2e-8);
}

/** M/(th/3) at the rotation th per length of a strip whose width is kept. */
void
test_bending()
{
  struct Row
  {
    double rotation, moment, stretch;
  };
  const auto           section = section_of_lines(rubber(8) + thick(1.));
  const PointOfSection strip(*section, skewed_frame());
  double               error = 0., stretch_error = 0.;
  for (const Row &row : {Row{0.01, 1.000053, 1.0000167},
                         Row{0.05, 1.001334, 1.0004170},
                         Row{0.1, 1.005349, 1.0016720},
                         Row{0.5, 1.142559, 1.0450744}})
    {
      // b_11 = l th; dw/dl = l n + th m = 0 by the secant method
      const auto strains = [&](const double l) {
        Strains result = stretched(l, 1.);
        result[3]      = l * row.rotation;
        return result;
      };
      const auto axial = [&](const double l) {
        const auto force = strip.response(strains(l)).force;
        return l * force[0] + row.rotation * force[3];
      };
      double last = 1., l = 1. + 0.1 * row.rotation * row.rotation;
      double f_last = axial(last);
      for (unsigned int k = 0; k < 12 && std::abs(l - last) > 1e-13; ++k)
        {
          const double f    = axial(l);
          const double next = l - f * (l - last) / (f - f_last);
          last              = l;
          f_last            = f;
          l                 = next;
        }
      const double moment = l * strip.response(strains(l)).force[3];
      error =
        std::max(error, std::abs(3. * moment / row.rotation - row.moment));
      stretch_error = std::max(stretch_error, std::abs(l - row.stretch));
    }
  check_below("pure bending", error, 1e-6);
  check_below("pure bending, stretch", stretch_error, 1e-7);
}

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_derivatives();
  test_sheet();
  test_sphere();
  test_saint_venant_sphere();
  test_tube();
  test_bending();
  return n_failures > 0;
}
