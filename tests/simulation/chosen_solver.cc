// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// ChosenSolver: the direct solver takes over from an iterative one that fails,
// at its preparation or later; and the choice between them.

#include <nacre/base/log.h>
#include <nacre/simulation/chosen_solver.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <functional>
#include <iostream>
#include <sstream>

using namespace Nacre;
using TrilinosVector = TrilinosWrappers::MPI::Vector;

/** An iterative solver that fails at the call that it is told. */
class FailingSolver : public LinearSolver
{
public:
  explicit FailingSolver(const unsigned int good_calls)
    : good_calls_(good_calls)
  {}

  bool
  try_prepare(const LinearSystem &) override
  {
    call();
    return true;
  }

  SolveAccuracy
  solve(TrilinosVector &x, const TrilinosVector &b) override
  {
    call();
    x = b; // no solution: tells who solved
    SolveAccuracy accuracy;
    accuracy.n_iterations = 7;
    return accuracy;
  }

  std::optional<unsigned int>
  n_negative_pivots() const override
  {
    return {};
  }

  std::optional<unsigned int>
  count_negative_eigenvalues() override
  {
    call();
    return 0;
  }

private:
  void
  call()
  {
    if (good_calls_-- == 0)
      AssertThrow(false, ExcIterationFailed("stagnation after 7 iterations"));
  }

  unsigned int good_calls_;
};

/** What is on std::cerr while @p function runs. */
std::string
errors_of(const std::function<void()> &function)
{
  std::ostringstream text;
  auto *const        buffer = std::cerr.rdbuf(text.rdbuf());
  function();
  std::cerr.rdbuf(buffer);
  return text.str();
}

void
test_reserve(const unsigned int good_calls, const std::string &name)
{
  const MPI_Comm         comm  = MPI_COMM_WORLD;
  const auto             owned = complete_index_set(3);
  DynamicSparsityPattern pattern(3, 3);
  for (unsigned int i = 0; i < 3; ++i)
    pattern.add(i, i);
  TrilinosWrappers::SparseMatrix matrix;
  matrix.reinit(owned, owned, pattern, comm);
  TrilinosVector x(owned, comm), b(owned, comm);
  for (unsigned int i = 0; i < 3; ++i)
    {
      matrix.set(i, i, i == 2 ? -1. : 2.);
      b(i) = 1.;
    }
  matrix.compress(VectorOperation::insert);
  b.compress(VectorOperation::insert);
  const AffineConstraints<double> constraints;

  ChosenSolver::Factory factory = [&]() {
    return std::make_unique<FailingSolver>(good_calls);
  };
  const std::string errors = errors_of([&]() {
    Log          log(comm);
    ChosenSolver solver(comm, factory, log);
    solver.prepare({matrix, constraints});
    const auto accuracy = solver.solve(x, b);
    std::cout << name << ": " << solver.name() << ", " << accuracy.n_iterations
              << " iterations, x_0 = " << x(0) << ", negative pivots "
              << *solver.n_negative_pivots() << std::endl;
    solver.prepare({matrix, constraints});
    std::cout << "  then " << solver.name();
    for (const double last : {2., -1.})
      {
        matrix.set(2, 2, last);
        matrix.compress(VectorOperation::insert);
        solver.prepare({matrix, constraints});
        std::cout << ", with " << last << ": " << solver.name();
      }
    std::cout << ", " << *solver.count_negative_eigenvalues()
              << " negative eigenvalue" << std::endl;
  });
  std::cout << "  " << (errors.empty() ? "no warning\n" : errors);
}

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_reserve(100, "iterative");
  test_reserve(0, "fails at first");
  test_reserve(1, "fails later");
  test_reserve(5, "fails to count");

  const auto choice = [](const SolverTask &task) {
    return prefers_multigrid(task) ? "multigrid" : "direct";
  };
  // dofs, degree, right-hand sides, levels, GB
  std::cout << "small: " << choice({1000, 3, 1, 3, 16.}) << std::endl
            << "large: " << choice({1000000, 3, 1, 5, 64.}) << std::endl
            << "large without refinements: " << choice({1000000, 3, 1, 0, 64.})
            << std::endl
            << "many right-hand sides: " << choice({200000, 3, 1000, 4, 64.})
            << std::endl
            << "little memory: " << choice({200000, 3, 1000, 4, 0.5})
            << std::endl;
  return 0;
}
