// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Error estimates of deformed states: those of linear kinematics for small
// displacements, residual by residual; the same after any rigid motion.

#include "../laminates/laminate_parameters.h"
#include "finite_shell.h"
#include <nacre/postprocess/error_estimator.h>

namespace
{
  constexpr double eta = 5.;

  /** The residuals of a displacement, summed over the cells. */
  template <typename AnyParameters>
  std::array<double, n_residuals>
  estimate(const AnyParameters     &parameters,
           const Discretization    &discretization,
           const KinematicsOptions &kinematics,
           const VectorField       &field)
  {
    const EdgePenalty               penalty(discretization,
                              parameters.section,
                              discretization.element().full_quadrature(),
                              eta);
    const ErrorEstimator            estimator(discretization,
                                   ShellParts(parameters.section,
                                              parameters.conditions,
                                              parameters.loads,
                                              kinematics),
                                   penalty);
    const auto                      u = interpolate(discretization, field);
    const auto                      indicators = estimator.estimate({&u, true});
    std::array<double, n_residuals> sums;
    for (unsigned int r = 0; r < n_residuals; ++r)
      sums[r] = indicators.total(static_cast<Residual>(r), MPI_COMM_WORLD);
    return sums;
  }

  /** The largest difference, relative to the first of both. */
  double
  difference(const std::array<double, n_residuals> &a,
             const std::array<double, n_residuals> &b)
  {
    double largest = 0.;
    for (unsigned int r = 0; r < n_residuals; ++r)
      largest = std::max(largest, std::abs(b[r] / a[r] - 1.));
    return largest;
  }

  template <typename AnyParameters>
  void
  test_section(const std::string &name, const AnyParameters &parameters)
  {
    for (const unsigned int degree : {2, 3})
      {
        const auto discretization =
          make_discretization(difficult_mesh(true), degree);
        const auto found = [&](const KinematicsOptions &kinematics,
                               const VectorField       &field) {
          return estimate(parameters, *discretization, kinematics, field);
        };
        const std::string what = name + ", p = " + std::to_string(degree);

        const VectorField small = [](const Point<3> &x) {
          return 1e-7 * some_field(x);
        };
        check_below(what + ": small displacements, all residuals",
                    difference(found(MembraneStrain::tied, small),
                               found(finite(MembraneStrain::tied), small)),
                    1e-5);

        const auto motion =
          rigid_motion(Vector3{{1.9, -1.2, 0.8}}, Vector3{{0.3, -2., 1.}});
        const VectorField large = [](const Point<3> &x) {
          return 0.4 * some_field(x);
        };
        const VectorField moved = [&](const Point<3> &x) {
          const Vector3 u = large(x);
          return motion(x + u) + u;
        };
        check_below(what + ": large displacements and a rigid motion",
                    difference(found(finite(MembraneStrain::tied), large),
                               found(finite(MembraneStrain::tied), moved)),
                    1e-9);
      }
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  {
    const Parameters parameters(section_text(100., 0.3, 0.2));
    test_section("isotropic", parameters);
  }
  const LaminateParameters laminate(
    laminate_text("[0/30/-60]",
                  "0.2",
                  "  set Material direction = 1, 0.4, 0.1\n"));
  test_section("coupled", laminate);
  return n_failures > 0;
}
