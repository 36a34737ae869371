// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The edge form of the averaged normal in whole meshes: the rotation-jump form
// where the surface has tangent planes, another form at a crease, there too
// without energy of rigid motions and indifferent to the cells' order and
// orientation.

#include "../tests_common.h"
#include <nacre/forms/averaged_normal_kinematics.h>

using namespace Tests;

/** Twice as stiff in cells of the region 1. */
class RegionSection : public LinearElasticSection
{
public:
  using LinearElasticSection::LinearElasticSection;

  SectionStiffness
  stiffness(const SurfaceFrame<> &frame,
            const SectionPoint   &point) const override
  {
    const auto   both   = LinearElasticSection::stiffness(frame, point);
    const double factor = 1. + point.region();
    return {factor * both.membrane, factor * both.bending};
  }
};

struct RegionParameters
{
  RegionSection      section{100., 0.3, 1.};
  BoundaryConditions conditions;
  Loads              loads;
};

/** 3 x 3 cells of [0, 3]^2, affine, or distorted. */
Mesh
patch_mesh(const bool distorted)
{
  Mesh mesh;
  for (unsigned int j = 0; j < 4; ++j)
    for (unsigned int i = 0; i < 4; ++i)
      {
        const double bulge = distorted && i % 3 > 0 && j % 3 > 0 ?
                               0.25 * (i == j ? 1. : -0.7) :
                               0.;
        mesh.vertices.emplace_back(i + 0.3 * j + bulge, j - 0.5 * bulge, 0.);
      }
  for (unsigned int j = 0; j < 3; ++j)
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int k = 4 * j + i;
        mesh.cells.push_back({{k, k + 1, k + 4, k + 5}});
      }
  // One cell the other way round.
  std::swap(mesh.cells[4][1], mesh.cells[4][2]);
  return mesh;
}

/** 2 x 2 cells with a fold by 1.2 rad along their middle. */
Mesh
creased_mesh()
{
  Mesh mesh;
  for (const double y : {0., 0.9, 2.})
    {
      mesh.vertices.emplace_back(-1. + 0.1 * y, y, 0.);
      mesh.vertices.emplace_back(0., y, 0.);
      mesh.vertices.emplace_back(std::cos(1.2), 1.1 * y, std::sin(1.2));
    }
  mesh.cells = {{{0, 1, 3, 4}}, {{1, 2, 4, 5}}, {{3, 4, 6, 7}}, {{4, 5, 7, 8}}};
  mesh.map   = bend;
  return mesh;
}

/** Matrix with hanging nodes eliminated, residual and energies of a field. */
struct System
{
  template <typename ParametersType>
  System(const ParametersType &parameters,
         const Discretization &discretization,
         const EdgeForm        form,
         const VectorField    &field = some_field)
    : u(discretization.locally_owned_dofs(), MPI_COMM_WORLD)
    , residual(u)
  {
    const Assembly assembly(discretization,
                            ShellParts(parameters.section,
                                       parameters.conditions,
                                       parameters.loads,
                                       {MembraneStrain::tied, form},
                                       10.));
    matrix =
      dense_system(discretization, assembly, discretization.node_constraints())
        .first;
    // What the library puts on the diagonal of eliminated rows means nothing.
    for (unsigned int i = 0; i < matrix.m(); ++i)
      if (discretization.node_constraints().is_constrained(i))
        matrix(i, i) = 0.;
    u        = interpolate(discretization, field);
    energies = assembly.residual(u, residual);
  }

  FullMatrix<double> matrix;
  TrilinosVector     u, residual;
  Energies           energies;
};

template <typename ParametersType>
void
compare_with_rotation_jump(const std::string    &name,
                           const ParametersType &parameters,
                           const Discretization &discretization)
{
  const System averaged(parameters, discretization, EdgeForm::averaged_normal);
  const System jump(parameters, discretization, EdgeForm::rotation_jump);
  check_below(name + ": the rotation-jump form's matrix",
              relative_difference(averaged.matrix, jump.matrix),
              1e-12);
  check_below(name + ": the rotation-jump form's edge energy",
              std::abs(averaged.energies.edge / jump.energies.edge - 1.),
              1e-11);
}

void
test_smooth(const std::string &name,
            const Parameters  &parameters,
            const Mesh        &mesh,
            const unsigned int degree)
{
  compare_with_rotation_jump(name + ", p = " + std::to_string(degree),
                             parameters,
                             *make_discretization(mesh, degree));
}

/** Sections that jump at the edges: means of both cells' stiffnesses. */
void
test_regions()
{
  const RegionParameters parameters;
  const auto discretization = make_discretization(patch_mesh(true), 2);
  for (const auto &cell :
       discretization->triangulation().active_cell_iterators())
    cell->set_material_id(cell->index() % 2);
  compare_with_rotation_jump("two regions", parameters, *discretization);
}

void
test_crease(const Parameters &parameters)
{
  auto mesh                   = creased_mesh();
  mesh.refined                = {1};
  const auto   discretization = make_discretization(mesh, 2);
  const System averaged(parameters, *discretization, EdgeForm::averaged_normal);
  const System jump(parameters, *discretization, EdgeForm::rotation_jump);
  check_above("crease: not the rotation-jump form's matrix",
              relative_difference(averaged.matrix, jump.matrix),
              0.05);
  FullMatrix<double> transposed(averaged.matrix);
  transposed.copy_transposed(averaged.matrix);
  check_below("crease: matrix is symmetric",
              relative_difference(transposed, averaged.matrix),
              1e-13);

  // The matrix lacks the hanging nodes' rows; the field has their values.
  Vector<double> values(averaged.u.size()), forces(averaged.u.size()),
    product(averaged.u.size());
  for (unsigned int i = 0; i < values.size(); ++i)
    {
      values[i] = averaged.u(i);
      forces[i] = averaged.residual(i);
    }
  const auto &constraints = discretization->node_constraints();
  constraints.condense(forces);
  constraints.set_zero(values);
  averaged.matrix.vmult(product, values);
  product -= forces;
  check_below("crease: residual is K u",
              product.linfty_norm() / forces.linfty_norm(),
              1e-12);
  check_below("crease: energy is u . K u / 2",
              std::abs(0.5 * (values * forces) / averaged.energies.total() -
                       1.),
              1e-12);

  double energy = 0.;
  for (unsigned int k = 0; k < 6; ++k)
    {
      Vector3 e;
      e[k % 3] = 1.;
      const System rigid(parameters,
                         *discretization,
                         EdgeForm::averaged_normal,
                         [&](const Point<3> &x) {
                           return k < 3 ? e : cross_product_3d(e, Vector3(x));
                         });
      energy = std::max(energy, std::abs(rigid.energies.edge));
    }
  check_below("crease: edge energy of rigid motions",
              energy / averaged.energies.total(),
              1e-14);
}

void
test_orientation(const Parameters &parameters)
{
  auto       mesh     = creased_mesh();
  const auto energies = [&]() {
    return System(parameters,
                  *make_discretization(mesh, 2),
                  EdgeForm::averaged_normal)
      .energies.edge;
  };
  const double exact = energies();
  mesh.cells[1]      = {{1, 4, 2, 5}};
  mesh.cells[3]      = {{4, 7, 5, 8}};
  check_below("crease, neighbours reversed: edge energy",
              std::abs(energies() / exact - 1.),
              1e-11);
  mesh.cells = {{{4, 5, 7, 8}}, {{1, 2, 4, 5}}, {{3, 4, 6, 7}}, {{0, 1, 3, 4}}};
  check_below("crease, cells in another order: edge energy",
              std::abs(energies() / exact - 1.),
              1e-11);
}

/** The edge of two cells with either first. */
void
test_side_swap(const Parameters &parameters)
{
  auto mesh = creased_mesh();
  mesh.cells.resize(2);
  mesh.vertices.resize(6);
  const auto discretization = make_discretization(mesh, 2);
  const auto kinematics =
    make_kinematics(*discretization,
                    parameters.section,
                    {MembraneStrain::tied, EdgeForm::averaged_normal});
  const unsigned int n      = discretization->dof_handler().n_dofs();
  const auto         none   = numbers::invalid_unsigned_int;
  const auto         first  = discretization->dof_handler().begin_active();
  const auto         second = std::next(first);
  std::array<FullMatrix<double>, 2> matrices;
  for (const unsigned int swapped : {0, 1})
    {
      ShellEdgeValues edge(*discretization);
      LocalTerms      terms;
      if (swapped == 0)
        edge.reinit(first, 1, none, second, 0, none);
      else
        edge.reinit(second, 0, none, first, 1, none);
      terms.reinit(edge.n_dofs());
      kinematics->add_edge_terms(edge, 7., Vector<double>(), terms);
      matrices[swapped].reinit(n, n);
      for (unsigned int i = 0; i < edge.n_dofs(); ++i)
        for (unsigned int j = 0; j < edge.n_dofs(); ++j)
          matrices[swapped](edge.dof_indices()[i], edge.dof_indices()[j]) =
            terms.tangent(i, j);
    }
  check_below("crease, sides swapped",
              relative_difference(matrices[1], matrices[0]),
              1e-12);
}

/** Two cells in the same place, their normals opposite. */
void
test_folded_flat(const Parameters &parameters)
{
  Mesh mesh;
  mesh.vertices =
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  mesh.cells                 = {{{0, 1, 2, 3}}, {{4, 0, 5, 2}}};
  const auto  discretization = make_discretization(mesh, 2);
  std::string message;
  try
    {
      System(parameters, *discretization, EdgeForm::averaged_normal);
    }
  catch (const std::exception &error)
    {
      message = error.what();
    }
  for (const std::string text :
       {"Discretization/Edge form", "folded onto each other", "rotation jump"})
    check_above("folded flat: the message has '" + text + "'",
                message.find(text) != std::string::npos,
                0.5);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_regions();
  // So thick that edges count beside the membrane's stiffness.
  const Parameters parameters(section_text(100., 0.3, 1.));
  for (const unsigned int degree : {2, 3})
    {
      auto mesh = patch_mesh(true);
      test_smooth("flat, distorted cells", parameters, mesh, degree);
      mesh.refined = {4};
      test_smooth("flat, hanging nodes", parameters, mesh, degree);
      mesh     = patch_mesh(false);
      mesh.map = [](const Point<3> &x) {
        return Point<3>(x[0],
                        x[1],
                        0.2 * x[0] * x[0] - 0.15 * x[1] * x[1] +
                          0.1 * x[0] * x[1]);
      };
      test_smooth("quadratic surface, affine cells", parameters, mesh, degree);
      mesh.refined = {0};
      test_smooth("quadratic surface, hanging nodes", parameters, mesh, degree);
    }
  test_crease(parameters);
  test_orientation(parameters);
  test_side_swap(parameters);
  test_folded_flat(parameters);
  return n_failures > 0;
}
