// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// DirectSolver: a known solution, the count of negative pivots against dense
// eigenvalues, reuse of the object and of its analysis, (nearly) singular and
// unsymmetric matrices, ranks without rows, and undefined numbers.

#include <nacre/solvers/direct_solver.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/trilinos_vector.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <string>

using namespace Nacre;
using TrilinosVector = TrilinosWrappers::MPI::Vector;

const MPI_Comm comm = MPI_COMM_WORLD;

/** Of report(); mutants are noticed by the exit code. */
unsigned int n_failures = 0;

/** Complain on rank 0, or state that all is well. */
void
report(const std::string &name, const bool is_good, const double value = 0.)
{
  n_failures += (is_good ? 0 : 1);
  if (Utilities::MPI::this_mpi_process(comm) == 0)
    std::cout << name << ": "
              << (is_good ? "OK" : "failed, " + std::to_string(value))
              << std::endl;
}

/** grad u . grad v - shift u v for three components of degree p. */
class Problem
{
public:
  Problem(const unsigned int n_cells, const unsigned int degree)
    : fe_(FE_Q<dim, spacedim>(degree), 3)
    , tria_(comm)
    , dof_handler_(tria_)
  {
    GridGenerator::subdivided_hyper_cube(tria_, n_cells);
    dof_handler_.distribute_dofs(fe_);
    owned_ = dof_handler_.locally_owned_dofs();
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler_, relevant);
    TrilinosWrappers::SparsityPattern pattern(owned_, owned_, relevant, comm);
    DoFTools::make_flux_sparsity_pattern(dof_handler_, pattern);
    pattern.compress();
    matrix.reinit(pattern);
  }

  /** Fill the matrix; @p is_fixed sets u = 0 on the boundary. */
  void
  assemble(const double shift, const bool is_fixed)
  {
    matrix = 0.;
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler_, relevant);
    AffineConstraints<double> constraints(relevant);
    if (is_fixed)
      DoFTools::make_zero_boundary_constraints(dof_handler_, constraints);
    constraints.close();

    const QGauss<dim>                    quadrature(fe_.degree + 1);
    FEValues<dim, spacedim>              values(fe_,
                                   quadrature,
                                   update_values | update_gradients |
                                     update_JxW_values);
    const unsigned int                   n = fe_.n_dofs_per_cell();
    FullMatrix<double>                   cell_matrix(n, n);
    std::vector<types::global_dof_index> dofs(n);
    for (const auto &cell : dof_handler_.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          cell_matrix = 0.;
          for (const unsigned int q : values.quadrature_point_indices())
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
                if (fe_.system_to_component_index(i).first ==
                    fe_.system_to_component_index(j).first)
                  cell_matrix(i, j) +=
                    (values.shape_grad(i, q) * values.shape_grad(j, q) -
                     shift * values.shape_value(i, q) *
                       values.shape_value(j, q)) *
                    values.JxW(q);
          cell->get_dof_indices(dofs);
          constraints.distribute_local_to_global(cell_matrix, dofs, matrix);
        }
    matrix.compress(VectorOperation::add);
  }

  /** Solve for a given solution; @return the largest error. */
  double
  error(DirectSolver &solver, double &backward_error) const
  {
    TrilinosVector x(owned_, comm), b(owned_, comm), exact(owned_, comm);
    for (const auto i : owned_)
      exact[i] = std::sin(1. * i);
    exact.compress(VectorOperation::insert);
    matrix.vmult(b, exact);
    backward_error = solver.solve(x, b).backward_error;
    x -= exact;
    return x.linfty_norm();
  }

  /** Negative eigenvalues, from the dense matrix on every rank. */
  unsigned int
  n_negative_eigenvalues() const
  {
    const unsigned int n = matrix.m();
    Vector<double>     entries(n * n), sum(n * n);
    for (const auto i : owned_)
      for (unsigned int j = 0; j < n; ++j)
        entries[i * n + j] = matrix.el(i, j);
    Utilities::MPI::sum(entries, comm, sum);
    LAPACKFullMatrix<double> dense(n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        dense(i, j) = sum[i * n + j];
    dense.compute_eigenvalues();
    unsigned int n_negative = 0;
    for (unsigned int i = 0; i < n; ++i)
      if (dense.eigenvalue(i).real() < 0.)
        ++n_negative;
    return n_negative;
  }

  TrilinosWrappers::SparseMatrix matrix;

private:
  const FESystem<dim, spacedim>                       fe_;
  parallel::distributed::Triangulation<dim, spacedim> tria_;
  DoFHandler<dim, spacedim>                           dof_handler_;
  IndexSet                                            owned_;
};

/** Report whether @p function throws a text that holds @p text. */
template <typename Function>
void
expect_exception(const std::string &name,
                 const std::string &text,
                 const Function    &function)
{
  bool has_thrown = false;
  try
    {
      function();
    }
  catch (const std::exception &exception)
    {
      has_thrown =
        std::string(exception.what()).find(text) != std::string::npos;
    }
  report(name, Utilities::MPI::min(int(has_thrown), comm) == 1);
}

void
test_large()
{
  Problem      problem(26, 3); // 18723 unknowns
  DirectSolver solver(comm);
  for (const double shift : {0., 0.3})
    {
      problem.assemble(shift, true);
      solver.factorize(problem.matrix);
      double       backward_error;
      const double error = problem.error(solver, backward_error);
      report("known solution", error < 1e-10, error);
      report("backward error", backward_error < 2e-15, backward_error);
      report("positive definite", solver.n_negative_pivots() == 0);
    }
}

void
test_negative_pivots()
{
  Problem      problem(3, 3);
  DirectSolver solver(comm);
  for (const double shift : {-1., 30., 300., 3000., 1e6})
    {
      problem.assemble(shift, shift > 100.);
      solver.factorize(problem.matrix);
      report("negative pivots",
             solver.n_negative_pivots() == problem.n_negative_eigenvalues(),
             *solver.n_negative_pivots());
      double       backward_error;
      const double error = problem.error(solver, backward_error);
      report("indefinite solution", error < 1e-9, error);
    }
}

void
test_exceptions()
{
  DirectSolver solver(comm);
  for (const unsigned int degree : {1, 2, 3})
    {
      Problem problem(12, degree);
      problem.assemble(0., false);
      expect_exception("free body", "matrix is singular", [&]() {
        solver.factorize(problem.matrix);
      });
    }

  Problem problem(12, 2);
  problem.matrix = 0.;
  expect_exception("zero matrix", "matrix is singular", [&]() {
    solver.factorize(problem.matrix);
  });

  const double nan = std::numeric_limits<double>::quiet_NaN();
  problem.assemble(0., true);
  problem.matrix *= nan; // set() would assert
  expect_exception("undefined entry", "The matrix of the linear system", [&]() {
    solver.factorize(problem.matrix);
  });

  problem.assemble(0., true);
  solver.factorize(problem.matrix);
  double backward_error;
  report("solver after exceptions",
         problem.error(solver, backward_error) < 1e-10);
  TrilinosVector x(problem.matrix.locally_owned_range_indices(), comm), b(x);
  report("zero right-hand side",
         solver.solve(x, b).backward_error == 0. && x.linfty_norm() == 0.);
  if (b.in_local_range(7))
    b[7] = 1. / std::numeric_limits<double>::denorm_min();
  b.compress(VectorOperation::insert);
  expect_exception("infinite load", "The right-hand side", [&]() {
    solver.solve(x, b);
  });
}

/** No factors without pivoting: blocks of (0 1; 1 0). */
void
test_zero_diagonal()
{
  const unsigned int n       = 500;
  const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
  const unsigned int rank    = Utilities::MPI::this_mpi_process(comm);
  IndexSet           owned(n);
  owned.add_range(n * rank / n_ranks, n * (rank + 1) / n_ranks);
  TrilinosWrappers::SparseMatrix matrix(owned, owned, comm, 2);
  for (const auto i : owned)
    {
      matrix.set(i, i, 0.);
      matrix.set(i, (i + n / 2) % n, 1.);
    }
  matrix.compress(VectorOperation::insert);
  DirectSolver solver(comm);
  solver.factorize(matrix);
  report("zero diagonal", solver.n_negative_pivots() == n / 2);
}

/** No couplings at all, and rows whose scales differ widely. */
void
test_diagonal()
{
  const unsigned int n       = 1001;
  const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
  const unsigned int rank    = Utilities::MPI::this_mpi_process(comm);
  IndexSet           owned(n);
  owned.add_range(n * rank / n_ranks, n * (rank + 1) / n_ranks);
  TrilinosWrappers::SparseMatrix matrix(owned, owned, comm, 1);
  for (const auto i : owned)
    matrix.set(i, i, std::pow(10., i % 25 - 12.) * (i % 7 == 0 ? -1. : 1.));
  matrix.compress(VectorOperation::insert);
  DirectSolver solver(comm);
  solver.factorize(matrix);
  report("diagonal matrix", solver.n_negative_pivots() == 143);
}

/** Eigenvalues next to zero, of both signs, that factors can tell from it. */
void
test_nearly_singular()
{
  Problem      problem(12, 2);
  DirectSolver solver(comm);
  for (const double shift : {-1e-8, 1e-8})
    {
      problem.assemble(shift, false);
      solver.factorize(problem.matrix);
      report("nearly singular",
             solver.n_negative_pivots() == (shift > 0. ? 3 : 0),
             *solver.n_negative_pivots());
      double       backward_error;
      const double error = problem.error(solver, backward_error);
      report("nearly singular, solution", error < 1e-4, error);
      report("nearly singular, backward error",
             backward_error < 2e-15,
             backward_error);
    }
  problem.assemble(-1e-17, false);
  expect_exception("too nearly singular", "matrix is singular", [&]() {
    solver.factorize(problem.matrix);
  });
}

/** A matrix that has to be definite and isn't is given up; the next is not. */
void
test_definite_only()
{
  Problem      problem(12, 2);
  DirectSolver solver(comm);
  problem.assemble(100., true);
  const bool is_regular = solver.try_factorize(problem.matrix, true);
  report("indefinite matrix, definite only",
         Utilities::MPI::n_mpi_processes(comm) == 1 ?
           !is_regular :
           solver.n_negative_pivots() > 0u);
  solver.factorize(problem.matrix);
  report("indefinite matrix", solver.n_negative_pivots() > 0u);
  problem.assemble(-1., true);
  double backward_error;
  report("definite matrix, definite only",
         solver.try_factorize(problem.matrix, true) &&
           problem.error(solver, backward_error) < 1e-10);
}

/** One analysis a pattern; many right-hand sides with one factorisation. */
void
test_reuse()
{
  Problem      problem(12, 2);
  DirectSolver solver(comm);
  problem.assemble(-2., true);
  const double memory = solver.factor_memory(problem.matrix);
  report("memory of factors", memory > 5e-4 && memory < 0.02, memory);
  for (const double shift : {-2., -1., 0.1})
    {
      problem.assemble(shift, true);
      solver.factorize(problem.matrix);
      double error = 0., backward_error;
      for (unsigned int k = 0; k < 5; ++k)
        error = std::max(error, problem.error(solver, backward_error));
      report("many right-hand sides", error < 1e-10, error);
    }
  report("one analysis", solver.n_analyses() == 1, solver.n_analyses());

  // From the second indefinite matrix on, L D L^T comes first.
  for (const double shift : {300., 310., 320.})
    {
      problem.assemble(shift, true);
      solver.factorize(problem.matrix);
      report("indefinite", *solver.n_negative_pivots() > 0);
    }
  report("two analyses", solver.n_analyses() <= 2, solver.n_analyses());
  problem.assemble(-1., false);
  solver.factorize(problem.matrix);
  const unsigned int n_analyses = solver.n_analyses();
  solver.factorize(problem.matrix);
  report("another pattern",
         n_analyses <= 3 && solver.n_analyses() == n_analyses &&
           solver.n_negative_pivots() == 0,
         n_analyses);
}

/** Tridiagonal with rows on the last rank only. */
class Tridiagonal
{
public:
  explicit Tridiagonal(const unsigned int n)
    : owned(rows(n))
    , matrix(owned, owned, comm, 3)
  {}

  static IndexSet
  rows(const unsigned int n)
  {
    IndexSet result(n);
    if (Utilities::MPI::this_mpi_process(comm) + 1 ==
        Utilities::MPI::n_mpi_processes(comm))
      result.add_range(0, n);
    return result;
  }

  /** a_ij is 2 on the diagonal and @p upper and @p lower beside it. */
  void
  fill(const double upper, const double lower, const bool stores_zeros)
  {
    for (const auto i : owned)
      {
        matrix.set(i, i, 2.);
        if (i + 1 < owned.size() && (upper != 0. || stores_zeros))
          matrix.set(i, i + 1, upper);
        if (i > 0 && (lower != 0. || stores_zeros))
          matrix.set(i, i - 1, lower);
      }
    matrix.compress(VectorOperation::insert);
  }

  IndexSet                       owned;
  TrilinosWrappers::SparseMatrix matrix;
};

void
test_empty_ranks()
{
  const unsigned int n = 300;
  DirectSolver       solver(comm);
  for (const double coupling : {-1., 3.})
    {
      Tridiagonal problem(n);
      problem.fill(coupling, coupling, true);
      solver.factorize(problem.matrix);
      // Eigenvalues 2 + 2 c cos(k pi / (n + 1)).
      unsigned int n_negative = 0;
      for (unsigned int k = 1; k <= n; ++k)
        n_negative +=
          1. + coupling * std::cos(k * numbers::PI / (n + 1)) < 0. ? 1 : 0;
      report("ranks without rows", solver.n_negative_pivots() == n_negative);
      TrilinosVector x(problem.owned, comm), b(x), exact(x);
      for (const auto i : problem.owned)
        exact[i] = std::sin(1. * i);
      exact.compress(VectorOperation::insert);
      problem.matrix.vmult(b, exact);
      solver.solve(x, b);
      x -= exact;
      report("ranks without rows, solution",
             x.linfty_norm() < 1e-10,
             x.linfty_norm());
    }

  // Round-off may leave a zero on one side of the diagonal only.
  Tridiagonal one_sided(n);
  one_sided.fill(0., 1e-30, true);
  solver.factorize(one_sided.matrix);
  report("zeros on one side", solver.n_negative_pivots() == 0);
  Tridiagonal triangular(n);
  triangular.fill(0., 1e-30, false);
  expect_exception("unsymmetric pattern", "symmetric matrices only", [&]() {
    solver.factorize(triangular.matrix);
  });
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi_initialization(argc, argv, 1);
  test_large();
  test_negative_pivots();
  test_exceptions();
  test_zero_diagonal();
  test_diagonal();
  test_nearly_singular();
  test_definite_only();
  test_reuse();
  test_empty_ranks();
  return n_failures > 0;
}
