// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The smoother of multigrid on the matrix of a small plate.

#include "../tests_common.h"
#include "unit_test.h"
#include <nacre/multigrid/patch_smoother.h>

#include <deal.II/dofs/dof_tools.h>

using namespace Nacre;

namespace
{
  using LevelVector = LevelMatrix::Vector;

  /** A clamped plate of 3 x 3 cells, smoothed by patches. */
  struct Plate
  {
    Plate(const unsigned int degree, const PatchExtent extent)
      : parameters(Tests::section_text(1., 0.3, 0.1))
    {
      Tests::Mesh mesh;
      for (unsigned int j = 0; j < 4; ++j)
        for (unsigned int i = 0; i < 4; ++i)
          mesh.vertices.emplace_back(i, j, 0.);
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int v = 4 * j + i;
            mesh.cells.push_back({{v, v + 1, v + 4, v + 5}});
          }
      shell = Tests::make_discretization(mesh, degree);
      const Assembly assembly(*shell,
                              ShellParts(parameters.section,
                                         parameters.conditions,
                                         parameters.loads,
                                         KinematicsOptions(),
                                         {}));
      DoFTools::make_zero_boundary_constraints(shell->dof_handler(),
                                               constraints);
      constraints.close();
      Tests::TrilinosVector load(shell->locally_owned_dofs(), MPI_COMM_WORLD);
      assembly.reinit_matrix(constraints, matrix);
      assembly.assemble_system(constraints, matrix, load);
      const VertexPatches patches(*shell, constraints, extent);
      level.reinit(matrix, patches.foreign_dofs);
      is_definite = smoother.reinit(level, patches, 1);
    }

    /** A vector that fulfils the constraints. */
    LevelVector
    some_vector(const unsigned int seed) const
    {
      LevelVector v(level.partitioner());
      for (unsigned int i = 0; i < v.size(); ++i)
        v(i) =
          constraints.is_constrained(i) ? 0. : std::sin(seed + 1.7 * i * i);
      return v;
    }

    double
    energy(const LevelVector &x) const
    {
      LevelVector zero(x), Ax(x);
      zero = 0.;
      level.residual(Ax, x, zero);
      return -(Ax * x);
    }

    Tests::Parameters               parameters;
    std::unique_ptr<Discretization> shell;
    AffineConstraints<double>       constraints;
    TrilinosWrappers::SparseMatrix  matrix;
    LevelMatrix                     level;
    PatchSmoother                   smoother;
    bool                            is_definite = false;
  };
} // namespace

BOOST_AUTO_TEST_SUITE(patch_smoother)

BOOST_AUTO_TEST_CASE(smooths)
{
  for (const unsigned int degree : {2, 3})
    for (const auto extent : {PatchExtent::star, PatchExtent::closed_star})
      {
        const Plate plate(degree, extent);
        BOOST_TEST(plate.is_definite);

        // The solution stays, up to the inverses' single precision.
        const LevelVector x = plate.some_vector(1);
        LevelVector       zero(x), b(x);
        zero = 0.;
        plate.level.residual(b, x, zero);
        b *= -1.;
        LevelVector y(x);
        plate.smoother.forward(y, b);
        y -= x;
        BOOST_TEST(y.linfty_norm() < 1e-9 * x.linfty_norm());

        // Every sweep lowers the energy of the error.
        LevelVector  error   = plate.some_vector(2);
        const double initial = plate.energy(error);
        plate.smoother.forward(error, zero);
        const double smoothed = plate.energy(error);
        BOOST_TEST(smoothed < 0.9 * initial);
        BOOST_TEST(smoothed > 0.);
        plate.smoother.backward(error, zero);
        BOOST_TEST(plate.energy(error) < smoothed);
      }
}

BOOST_AUTO_TEST_CASE(forward_and_backward_are_adjoint)
{
  const Plate       plate(2, PatchExtent::closed_star);
  const LevelVector b = plate.some_vector(3), c = plate.some_vector(4);
  LevelVector       x(b), y(c);
  x = 0.;
  y = 0.;
  plate.smoother.forward(x, b);
  plate.smoother.backward(y, c);
  BOOST_TEST(std::abs(x * c - b * y) < 1e-5 * std::abs(x * c));
}

BOOST_AUTO_TEST_SUITE_END()
