// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Eigenvalues of diagonal matrices, of which a Krylov space of one vector sees
// each multiple one once: the count by pivots must tell, and the search after
// it find the rest. Constrained rows are no eigenvalues.

#include "../tests_common.h"
#include <nacre/analysis/eigenproblem.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

using namespace Tests;

namespace
{
  constexpr unsigned int n_rows = 120;

  IndexSet
  owned_rows()
  {
    const unsigned int n_ranks =
      Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    IndexSet           owned(n_rows);
    owned.add_range(n_rows * rank / n_ranks, n_rows * (rank + 1) / n_ranks);
    return owned;
  }

  TrilinosWrappers::SparseMatrix
  diagonal(const std::function<double(unsigned int)> &entry)
  {
    const IndexSet         owned = owned_rows();
    DynamicSparsityPattern pattern(n_rows, n_rows, owned);
    for (const auto i : owned)
      pattern.add(i, i);
    TrilinosWrappers::SparseMatrix matrix;
    matrix.reinit(owned, owned, pattern, MPI_COMM_WORLD);
    for (const auto i : owned)
      matrix.set(i, i, entry(i));
    matrix.compress(VectorOperation::insert);
    return matrix;
  }

  /** 1 twelve times, then 2, 3, 4, ... */
  double
  multiple(const unsigned int i)
  {
    return i < 12 ? 1. : i - 10.;
  }

  /** More may be found than were wanted. */
  void
  expect(const std::string         &name,
         const Spectrum            &spectrum,
         const std::vector<double> &values)
  {
    check(name + ", number",
          spectrum.values.size() >= values.size(),
          spectrum.values.size(),
          ">=",
          values.size());
    double error = 0.;
    for (unsigned int k = 0;
         k < std::min(values.size(), spectrum.values.size());
         ++k)
      error = std::max(error, std::abs(spectrum.values[k] / values[k] - 1.));
    check_below(name + ", values", error, 1e-10);
  }

  void
  definite_mass()
  {
    const auto          K = diagonal(multiple);
    const auto          M = diagonal([](unsigned int) { return 1.; });
    Eigenproblem        problem(K, M, true, owned_rows());
    std::vector<double> values(12, 1.);
    values.insert(values.end(), {2., 3., 4.});
    const Spectrum lowest = problem.find_above(0., 15, {}, 1e-4);
    expect("lowest", lowest, values);
    check("missed at first", lowest.n_missed > 0, lowest.n_missed, ">", 0);
    double product = 0.;
    for (unsigned int k = 0; k < lowest.modes.size(); ++k)
      for (unsigned int l = 0; l < k; ++l)
        product =
          std::max(product, std::abs(lowest.modes[k] * lowest.modes[l]));
    check_below("orthogonality", product, 1e-8);
    const Spectrum range = problem.find_above(4.5, 10, 8.5, 1e-4);
    expect("in a range", range, {5., 6., 7., 8.});
    check("no more in the range",
          range.values.size() == 4,
          range.values.size(),
          "=",
          4);
    check("below the range", range.n_below == 15, range.n_below, "=", 15);
    expect("few of a multiple one",
           problem.find_above(0., 2, {}, 1e-4),
           std::vector<double>(12, 1.));
  }

  void
  definite_stiffness()
  {
    // K x = lambda M x with M of both signs: lambda = 1/M_ii.
    const auto   K = diagonal([](unsigned int) { return 1.; });
    const auto   M = diagonal([](const unsigned int i) {
      return (i % 2 == 0 ? 1. : -1.) / (1. + i / 2);
    });
    Eigenproblem problem(K, M, false, owned_rows());
    expect("positive ones",
           problem.find_above(0., 4, {}, 1e-4),
           {1., 2., 3., 4.});
  }

  void
  constrained_rows()
  {
    // Every third row is constrained: K holds any positive number there.
    const auto is_free = [](const unsigned int i) { return i % 3 != 0; };
    const auto K       = diagonal(
      [&](const unsigned int i) { return is_free(i) ? 1. + i : 0.01; });
    const auto M =
      diagonal([&](const unsigned int i) { return is_free(i) ? 1. : 0.; });
    IndexSet free(n_rows);
    for (const auto i : owned_rows())
      if (is_free(i))
        free.add_index(i);
    Eigenproblem problem(K, M, true, free);
    expect("without constrained ones",
           problem.find_above(0., 4, {}, 1e-4),
           {2., 3., 5., 6.});
  }
} // namespace

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    std::cout.setstate(std::ios::failbit);
  definite_mass();
  definite_stiffness();
  constrained_rows();
  return n_failures == 0 ? 0 : 1;
}
