// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Eigenvalues of diagonal matrices, of which a Krylov space of one vector sees
// each multiple one once: the count by pivots must tell, and the search after
// it find the rest. Constrained rows are no eigenvalues. And what a prestress
// adds to the stiffness of a flat plate, in closed form.

#include "../tests_common.h"
#include <nacre/analysis/eigenproblem.h>
#include <nacre/analysis/prestress.h>

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

  /**
   * The plate [0, 2] x [0, 1] of p = 2 under a pressure that follows. Its
   * fields below are polynomials of second order, which the element holds
   * exactly.
   */
  struct Plate
  {
    static constexpr double E = 3., nu = 0.25, h = 1., p = 5., area = 2.;
    static constexpr double C = E * h / (1. - nu * nu);
    static constexpr double D = C * h * h / 12.;

    Plate(const PrestressKind kind)
      : parameters(section_text(E, nu, h) + R"(
subsection Mid-surface
  set Surface = plate
  set Subdivisions = 2, 1
  subsection plate
    set Size = 2, 1
  end
end
subsection Loads
  set Pressure = 5
  set Pressure follows = true
end
)")
      , model(parameters.model)
    {
      model.kinematics.membrane_strain = MembraneStrain::full;
      options.prestress                = kind;
      discretization =
        std::make_unique<Discretization>(model.midsurface,
                                         MPI_COMM_WORLD,
                                         Element{ElementType::lagrange, 2},
                                         0,
                                         0);
      assembly = std::make_unique<Assembly>(*discretization, model);
      prestress =
        std::make_unique<Prestress>(*discretization, *assembly, model, options);
    }

    /** v . G u of the prestress of the state. */
    double
    product(const VectorField &state,
            const VectorField &v,
            const VectorField &u,
            const double       time = 0.) const
    {
      TrilinosWrappers::SparseMatrix G;
      assembly->reinit_matrix(prestress->constraints(), G);
      prestress->add(interpolate(*discretization, state), time, 1., G);
      TrilinosVector       result(interpolate(*discretization, v));
      const TrilinosVector trial(interpolate(*discretization, u));
      G.vmult(result, trial);
      return result * interpolate(*discretization, v);
    }

    TextModel                       parameters;
    ShellModel                     &model;
    ModeOptions                     options;
    std::unique_ptr<Discretization> discretization;
    std::unique_ptr<Assembly>       assembly;
    std::unique_ptr<Prestress>      prestress;
  };

  VectorField
  linear_field(const Vector3 &u_1, const Vector3 &u_2)
  {
    return [=](const Point<3> &x) { return x[0] * u_1 + x[1] * u_2; };
  }

  const VectorField zero_field = [](const Point<3> &) { return Vector3(); };

  /** int N_ab u,a . v,b dA of a uniform stretch, each component for itself. */
  void
  stress_stiffness()
  {
    Plate plate(PrestressKind::linear);
    plate.model.load_factor = Expression(0.);
    // Strains 0.2, -0.1 and a shear angle of 0.3
    const VectorField state =
      linear_field(Vector3({0.2, 0.1, 0.}), Vector3({0.2, -0.1, 0.}));
    const double N_11 = Plate::C * (0.2 - Plate::nu * 0.1);
    const double N_22 = Plate::C * (-0.1 + Plate::nu * 0.2);
    const double N_12 = Plate::C * 0.5 * (1. - Plate::nu) * 0.3;
    for (unsigned int c = 0; c < 3; ++c)
      {
        Vector3 e;
        e[c] = 1.;
        // u,1 = 2 e, u,2 = 3 e; v,1 = 5 e, v,2 = 7 e
        const double exact =
          Plate::area * (N_11 * 10. + N_22 * 21. + N_12 * (14. + 15.));
        const double found = plate.product(state,
                                           linear_field(5. * e, 7. * e),
                                           linear_field(2. * e, 3. * e));
        check_below("stress stiffness of component " + std::to_string(c + 1),
                    std::abs(found / exact - 1.),
                    1e-10);
      }
  }

  /** The stiffness of the load int p v . (phi,1 x phi,2) dA at rest. */
  void
  load_stiffness()
  {
    const Plate   plate(PrestressKind::linear);
    const Vector3 u_1({2., 3., 5.}), u_2({7., 11., 13.}), v({1., 2., 3.});
    const Vector3 e_1({1., 0., 0.}), e_2({0., 1., 0.});
    const auto    u        = linear_field(u_1, u_2);
    const auto    constant = [&](const Point<3> &) { return v; };
    const double  exact =
      -Plate::p * Plate::area *
      (v * (cross_product_3d(u_1, e_2) + cross_product_3d(e_1, u_2)));
    // The derivative of the load along a constant field is zero; half of the
    // sum is the symmetric part.
    const double found = plate.product(zero_field, constant, u) +
                         plate.product(zero_field, u, constant);
    check_below("stiffness of a following pressure",
                std::abs(found / exact - 1.),
                1e-10);
  }

  VectorField
  half_square(const unsigned int c)
  {
    return [c](const Point<3> &x) {
      Vector3 u;
      u[c] = 0.5 * x[0] * x[0];
      return u;
    };
  }

  /**
   * Of the deflection b x^2/2, whose moment m_11 = -D b does work on the second
   * variation v,11 . e_1 w,1 = x of kappa_11. The derivative of the tangent has
   * int -D b x and C b x^3 dA besides.
   */
  void
  forces_and_moments()
  {
    Plate plate(PrestressKind::forces_and_moments);
    plate.model.load_factor = Expression(0.);
    const double b          = 0.3;
    const auto   state      = [b](const Point<3> &x) {
      return Vector3({0., 0., 0.5 * b * x[0] * x[0]});
    };
    const double exact = -2. * b * Plate::D;
    const double found = plate.product(state, half_square(0), half_square(2));
    check_below("moments times the second variation of curvatures",
                std::abs(found / exact - 1.),
                1e-9);
    // The energy's third derivative along a field u, with jumps of rotations:
    // three times the work of u's forces and moments on the second variations.
    const VectorField u = [](const Point<3> &x) {
      return Vector3({std::sin(x[0] + 2. * x[1]),
                      std::cos(3. * x[0] - x[1]),
                      std::sin(2. * x[0]) * std::cos(x[1])});
    };
    Plate whole(PrestressKind::tangent);
    whole.model.load_factor = Expression(0.);
    const double third      = whole.product(u, u, u) / 3.;
    check_below("a third of the derivative of the tangent",
                std::abs(plate.product(u, u, u) / third - 1.),
                1e-9);
  }

  /**
   * The derivative of the tangent along a tilt s alpha x of the plate: of
   * v . K u = int C s alpha x^2 - D s alpha/(1 + s^2 alpha^2) dA for
   * v = (x^2/2, 0, 0), u = (0, 0, x^2/2). Differences that aren't extrapolated
   * are wrong by 7e-8.
   */
  void
  tangent_derivative()
  {
    Plate plate(PrestressKind::tangent);
    plate.model.load_factor = Expression(0.);
    const double alpha      = 0.7;
    const double exact = alpha * (Plate::C * 8. / 3. - Plate::D * Plate::area);
    const double found =
      plate.product(linear_field(Vector3({0., 0., alpha}), Vector3()),
                    half_square(0),
                    half_square(2));
    check_below("derivative of the tangent",
                std::abs(found / exact - 1.),
                1e-9);
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
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    {
      stress_stiffness();
      load_stiffness();
      forces_and_moments();
      tangent_derivative();
    }
  return n_failures == 0 ? 0 : 1;
}
