// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_common_h
#define nacre_tests_common_h

#include <nacre/discretization/discretization.h>
#include <nacre/forms/assembly.h>
#include <nacre/mechanics/linear_elastic_section.h>
#include <nacre/problem/shell_model.h>

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/distributed/tria.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

/** What several tests share. */
namespace Tests
{
  using namespace Nacre;
  using Vector3        = Tensor<1, 3>;
  using VectorField    = std::function<Vector3(const Point<3> &)>;
  using TrilinosVector = TrilinosWrappers::MPI::Vector;

  inline unsigned int n_failures = 0;

  /**
   * Prints "name: OK (< bound)", or the value if it isn't so. With the
   * environment variable NACRE_TEST_VALUES set, always the value.
   */
  inline void
  check(const std::string &name,
        const bool         good,
        const double       value,
        const std::string &relation,
        const double       bound)
  {
    n_failures += (good ? 0 : 1);
    std::cout << name << ": ";
    if (good && std::getenv("NACRE_TEST_VALUES") == nullptr)
      std::cout << "OK (";
    else
      std::cout << (good ? "OK, " : "FAILED, ") << value << " (";
    std::cout << relation << ' ' << bound << ')' << std::endl;
  }

  /** Comparisons with NaN are false, thus failures. */
  inline void
  check_below(const std::string &name, const double value, const double bound)
  {
    check(name, value < bound, value, "<", bound);
  }

  inline void
  check_above(const std::string &name, const double value, const double bound)
  {
    check(name, value > bound, value, ">", bound);
  }

  /** Forgets the parameters of objects that are gone. */
  struct NoParameters
  {
    NoParameters()
    {
      ParameterAcceptor::clear();
    }
  };

  /** The text of a parameter file to all parameter objects that there are. */
  inline void
  read_text(const std::string &text)
  {
    ParameterAcceptor::declare_all_parameters();
    ParameterAcceptor::prm.parse_input_from_string(text);
    ParameterAcceptor::parse_all_parameters();
  }

  /** What the section @p AnyParameters of a text is on a mesh of regions. */
  template <typename AnyParameters>
  auto
  section_of_text(const std::string &text, const MeshRegions &regions = {})
  {
    ParameterAcceptor::clear();
    AnyParameters parameters;
    read_text(text);
    return parameters.section({}, {}, regions);
  }

  /** The section of a text, no conditions and no loads. */
  struct Parameters
  {
    explicit Parameters(const std::string &text    = "",
                        const MeshRegions &regions = {})
      : section(section_of_text<LinearElasticSectionParameters>(text, regions))
    {}

    LinearElasticSection section;
    BoundaryConditions   conditions;
    Loads                loads;
  };

  /** The model of the text of a parameter file; one object at a time. */
  template <typename AnySectionParameters>
  struct TextModelOf : NoParameters
  {
    explicit TextModelOf(const std::string &text,
                         const Constants   &constants = {},
                         const MeshRegions &regions   = {})
      : model(read(text, constants, regions))
    {}

  private:
    ShellModel
    read(const std::string &text,
         const Constants   &constants,
         const MeshRegions &regions)
    {
      read_text(text);
      ShellModel result{midsurface_.make({}), section_.make({}, {}, regions)};
      result.supports = supports_.make(result.midsurface, constants);
      result.loads    = loads_.make(result.midsurface, constants);
      return result;
    }

    AnySectionParameters        section_;
    MidsurfaceParameters        midsurface_;
    BoundaryConditionParameters supports_;
    LoadParameters              loads_;

  public:
    ShellModel model;
  };

  using TextModel = TextModelOf<LinearElasticSectionParameters>;

  inline std::string
  section_text(const double E, const double nu, const double h)
  {
    return "subsection Section\n set Young's modulus = " + std::to_string(E) +
           "\n set Poisson's ratio = " + std::to_string(nu) +
           "\n set Thickness = " + std::to_string(h) + "\nend\n";
  }

  /** "p = 3" for Lagrange elements, the name of others. */
  inline std::string
  label(const Element &element)
  {
    return element.type == ElementType::lagrange ?
             "p = " + std::to_string(element.degree) :
             name_of(element.type);
  }

  constexpr Element serendipity{ElementType::serendipity, 2};
  constexpr Element triangle{ElementType::triangle, 2};

  /** Coarse cells, vertices in deal.II's order, and a map of space. */
  struct Mesh
  {
    std::vector<Point<3>>                     vertices;
    std::vector<std::array<unsigned int, 4>>  cells;
    std::function<Point<3>(const Point<3> &)> map = [](const Point<3> &x) {
      return x;
    };
    /** Coarse cells to refine once. */
    std::vector<unsigned int> refined;
  };

  using PositionFunction =
    std::function<Point<3>(const Triangulation<2, 3>::cell_iterator &,
                           const Point<2> &)>;

  /** The cells cut in halves, on a mesh that takes triangles. */
  inline std::unique_ptr<parallel::TriangulationBase<2, 3>>
  make_triangles(const Mesh &mesh)
  {
    Assert(mesh.refined.empty(), ExcNotImplemented());
    std::vector<CellData<2>> cells;
    for (const auto &v : mesh.cells)
      {
        cells.emplace_back(3);
        cells.back().vertices = {v[0], v[1], v[3]};
        cells.emplace_back(3);
        cells.back().vertices = {v[0], v[3], v[2]};
      }
    auto triangulation =
      std::make_unique<parallel::shared::Triangulation<2, 3>>(
        MPI_COMM_WORLD,
        Triangulation<2, 3>::none,
        true,
        parallel::shared::Triangulation<2, 3>::partition_zorder);
    triangulation->create_triangulation(mesh.vertices, cells, SubCellData());
    return triangulation;
  }

  inline std::unique_ptr<parallel::TriangulationBase<2, 3>>
  make_triangulation(const Mesh &mesh)
  {
    std::vector<CellData<2>> cells(mesh.cells.size());
    for (unsigned int k = 0; k < cells.size(); ++k)
      cells[k].vertices.assign(mesh.cells[k].begin(), mesh.cells[k].end());
    auto triangulation =
      std::make_unique<parallel::distributed::Triangulation<2, 3>>(
        MPI_COMM_WORLD);
    triangulation->create_triangulation(mesh.vertices, cells, SubCellData());
    if (!mesh.refined.empty())
      {
        for (const auto &cell : triangulation->active_cell_iterators())
          for (const unsigned int k : mesh.refined)
            if (static_cast<unsigned int>(cell->index()) == k)
              cell->set_refine_flag();
        triangulation->execute_coarsening_and_refinement();
      }
    return triangulation;
  }

  /** The map of the linear interpolation of the vertices. */
  inline std::unique_ptr<Discretization>
  make_discretization(const Mesh        &mesh,
                      const Element     &element,
                      const unsigned int mapping_degree = 0)
  {
    const PositionFunction position = [&](const auto &cell, const auto &unit) {
      Point<3> x;
      for (const unsigned int v : cell->vertex_indices())
        x += cell->reference_cell().d_linear_shape_function(unit, v) *
             Vector3(cell->vertex(v));
      return mesh.map(x);
    };
    return std::make_unique<Discretization>(element.type ==
                                                ElementType::triangle ?
                                              make_triangles(mesh) :
                                              make_triangulation(mesh),
                                            position,
                                            element,
                                            mapping_degree);
  }

  inline std::unique_ptr<Discretization>
  make_discretization(const Mesh        &mesh,
                      const unsigned int degree,
                      const unsigned int mapping_degree = 0)
  {
    return make_discretization(mesh,
                               Element{ElementType::lagrange, degree},
                               mapping_degree);
  }

  /** A smooth map of the plane that curves it every way. */
  inline Point<3>
  bend(const Point<3> &x)
  {
    return {x[0] + 0.1 * x[1] * x[2],
            x[1] + 0.1 * std::sin(x[0]),
            x[2] + 0.3 * x[0] * x[0] - 0.2 * x[1] * x[1] +
              0.15 * std::sin(x[0] * x[1])};
  }

  /** A displacement without any symmetry. */
  inline Vector3
  some_field(const Point<3> &x)
  {
    Vector3 u;
    u[0] = std::sin(x[0] + 2. * x[1]);
    u[1] = std::cos(x[1] - x[2]);
    u[2] = std::sin(2. * x[0]) * std::cos(x[1]) + x[2] * x[2];
    return u;
  }

  /** Nodal interpolation, on one rank. */
  inline TrilinosVector
  interpolate(const Discretization &discretization, const VectorField &field)
  {
    TrilinosVector u(discretization.locally_owned_dofs(), MPI_COMM_WORLD);
    std::vector<types::global_dof_index> dofs(
      discretization.node_dofs().size());
    for (const auto &cell :
         discretization.dof_handler().active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        const auto nodes = discretization.node_positions(cell);
        for (unsigned int a = 0; a < nodes.size(); ++a)
          {
            const auto value = field(nodes[a]);
            for (unsigned int c = 0; c < 3; ++c)
              u(dofs[discretization.node_dofs()[3 * a + c]]) = value[c];
          }
      }
    u.compress(VectorOperation::insert);
    discretization.node_constraints().distribute(u);
    return u;
  }

  /** The assembled matrix and load, constrained rows and columns included. */
  inline std::pair<FullMatrix<double>, Vector<double>>
  dense_system(const Discretization            &discretization,
               const Assembly                  &assembly,
               const AffineConstraints<double> &constraints)
  {
    TrilinosWrappers::SparseMatrix matrix;
    TrilinosVector load(discretization.locally_owned_dofs(), MPI_COMM_WORLD);
    assembly.reinit_matrix(constraints, matrix);
    assembly.assemble_system(constraints, matrix, load);
    const unsigned int                            n = matrix.m();
    std::pair<FullMatrix<double>, Vector<double>> dense;
    dense.first.reinit(n, n);
    dense.second.reinit(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
          dense.first(i, entry->column()) = entry->value();
        dense.second[i] = load(i);
      }
    return dense;
  }

  /** Eigenvalues, ascending, of the unconstrained rows and columns. */
  inline Vector<double>
  eigenvalues(const FullMatrix<double>        &matrix,
              const AffineConstraints<double> &constraints)
  {
    std::vector<unsigned int> free;
    for (unsigned int i = 0; i < matrix.m(); ++i)
      if (!constraints.is_constrained(i))
        free.push_back(i);
    LAPACKFullMatrix<double> reduced(free.size());
    for (unsigned int i = 0; i < free.size(); ++i)
      for (unsigned int j = 0; j < free.size(); ++j)
        reduced(i, j) =
          0.5 * (matrix(free[i], free[j]) + matrix(free[j], free[i]));
    Vector<double>     values;
    FullMatrix<double> vectors;
    const double       bound = 2. * reduced.linfty_norm();
    reduced.compute_eigenvalues_symmetric(-bound, bound, 0., values, vectors);
    return values;
  }

  /** Largest difference relative to the largest entry of @p expected. */
  inline double
  relative_difference(const FullMatrix<double> &found,
                      const FullMatrix<double> &expected)
  {
    double difference = 0., size = 0.;
    for (unsigned int i = 0; i < expected.m(); ++i)
      for (unsigned int j = 0; j < expected.n(); ++j)
        {
          // The negated comparison keeps NaN.
          const double d = std::abs(found(i, j) - expected(i, j));
          difference     = !(d <= difference) ? d : difference;
          size           = std::max(size, std::abs(expected(i, j)));
        }
    return difference / size;
  }
} // namespace Tests

#endif
