// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Patch tests: solutions that the elements contain come out exactly, with
// prescribed displacements, rotations and moments on the edges.

#include "../tests_common.h"
#include <nacre/discretization/displacement_conditions.h>
#include <nacre/problem/midsurface.h>
#include <nacre/solvers/direct_solver.h>

using namespace Tests;

struct Case
{
  std::string name;
  /** Position over the unit square. */
  std::string  position;
  Element      element;
  unsigned int mapping_degree;
  /** Conditions of the four edges, and edge loads. */
  std::string edges;
  std::string loads;
  VectorField exact;
  double      tolerance;

  MembraneStrain membrane_strain = default_membrane_strain(element.type);
};

/** The residual of the solution @p u vanishes on all free dofs. */
void
test_residual(const std::string               &name,
              const Assembly                  &assembly,
              const AffineConstraints<double> &constraints,
              const TrilinosVector            &u)
{
  TrilinosVector residual(u);
  assembly.residual(u, residual);
  const double reactions = residual.linfty_norm();
  for (unsigned int i = 0; i < u.size(); ++i)
    if (constraints.is_constrained(i))
      residual(i) = 0.;
  residual.compress(VectorOperation::insert);
  check_below(name + ": residual", residual.linfty_norm() / reactions, 1e-10);
}

const std::vector<Element> elements = {{ElementType::lagrange, 2},
                                       {ElementType::lagrange, 3},
                                       serendipity,
                                       triangle};

/**
 * Largest error of the solution's nodes relative to the largest value: at most
 * the tolerance, or above it where a test cannot be passed.
 */
void
test_patch(const Case &patch, const bool passes = true)
{
  TextModel parameters(
    section_text(1000., 0.3, 0.4) +
      "subsection Mid-surface\n set Surface = expression\n"
      " set Subdivisions = 3, 3\n subsection expression\n  set Position = " +
      patch.position +
      "\n end\nend\nsubsection Boundary conditions\n set Edges = " +
      patch.edges + "\nend\nsubsection Loads\n " + patch.loads + "\nend\n",
    {{"D", 1000. * 0.064 / (12. * 0.91)}});
  ShellModel &model                = parameters.model;
  model.kinematics.membrane_strain = patch.membrane_strain;

  const Discretization           discretization(model.midsurface,
                                      MPI_COMM_WORLD,
                                      patch.element,
                                      patch.mapping_degree,
                                      0);
  const DisplacementConditions   displacements(discretization, model.supports);
  const Assembly                 assembly(discretization, model);
  const auto                    &constraints = displacements.constraints();
  TrilinosWrappers::SparseMatrix matrix;
  TrilinosVector load(discretization.locally_owned_dofs(), MPI_COMM_WORLD);
  TrilinosVector u(load);
  assembly.reinit_matrix(constraints, matrix);
  assembly.assemble_system(constraints, matrix, load);
  DirectSolver solver(MPI_COMM_WORLD);
  solver.factorize(matrix);
  solver.solve(u, load);
  constraints.distribute(u);

  const auto exact = interpolate(discretization, patch.exact);
  double     error = 0.;
  for (unsigned int i = 0; i < u.size(); ++i)
    error = std::max(error, std::abs(u(i) - exact(i)));
  error /= exact.linfty_norm();
  if (passes)
    check_below(patch.name, error, patch.tolerance);
  else
    check_above(patch.name + ": no", error, patch.tolerance);
  check_below(patch.name + ": negative pivots", *solver.n_negative_pivots(), 1);

  test_residual(patch.name, assembly, constraints, u);
}

const std::string skew = "u + 0.3*v, v, 0";
/** Straight boundary, all inner cells distorted. */
const std::string distorted = "u + 1.5*u*(1-u)*v*(1-v)*(0.7+u*v), "
                              "v + 2*u*(1-u)*v*(1-v)*(0.3-u), 0";

void
test_membrane()
{
  // u linear in the plane, all edges prescribed, or stresses on one of them:
  // sigma_xx = E/(1-nu^2) (e_xx + nu e_yy) times h = 0.4.
  const std::string fixed = "x = 0.01*x + 0.03*y, y = 0.02*y - 0.01*x, z = 0";
  const VectorField exact = [](const Point<3> &x) {
    Vector3 u;
    u[0] = 0.01 * x[0] + 0.03 * x[1];
    u[1] = 0.02 * x[1] - 0.01 * x[0];
    return u;
  };
  // n = h C eps: n_xx = 400/0.91 (0.01 + 0.3 0.02), n_xy = 400/2.6 0.02
  const std::string force =
    "set Edge forces = u=1: 400/0.91*0.016, 400/2.6*0.02, 0";
  for (const Element &element : elements)
    {
      const unsigned int p        = element.degree;
      const bool         lagrange = element.type == ElementType::lagrange;
      const auto         name_of  = ", " + label(element);
      test_patch({"membrane, skew cells" + name_of,
                  skew,
                  element,
                  0,
                  "u=0, u=1, v=0, v=1: " + fixed,
                  "",
                  exact,
                  1e-12});
      const auto test_distorted = [&](const MembraneStrain membrane_strain,
                                      const double         tolerance) {
        const auto name = Nacre::name_of(membrane_strain);
        test_patch(
          {"membrane, distorted cells, edge force" + name_of + ", " + name,
           distorted,
           element,
           lagrange ? 1U : 0U,
           "u=0, v=0, v=1: " + fixed + "; u=1: z = 0",
           force,
           exact,
           tolerance,
           membrane_strain});
      };
      test_distorted(MembraneStrain::full, 1e-11);
      // Tied strains of test functions aren't integrated exactly.
      test_distorted(MembraneStrain::tied, p == 2 ? 1e-3 : 1e-4);
    }
}

void
test_bending()
{
  // w = 0.01 x^2 + 0.02 x y - 0.03 y^2 and its slopes; rho = -hess w.
  const std::string w     = "z = 0.01*x^2 + 0.02*x*y - 0.03*y^2, x = 0, y = 0";
  const std::string w_x   = "(0.02*x + 0.02*y)";
  const std::string w_y   = "(0.02*x - 0.06*y)";
  const VectorField exact = [](const Point<3> &x) {
    Vector3 u;
    u[2] = 0.01 * x[0] * x[0] + 0.02 * x[0] * x[1] - 0.03 * x[1] * x[1];
    return u;
  };
  const std::string skew_edges =
    "v=0: " + w + ", rotation = -" + w_y + "; v=1: " + w +
    ", rotation = " + w_y + "; u=0: " + w + ", rotation = (-" + w_x +
    " + 0.3*" + w_y + ")/sqrt(1.09); u=1: " + w + ", rotation = (" + w_x +
    " - 0.3*" + w_y + ")/sqrt(1.09)";
  const std::string square_edges = "v=0: " + w + ", rotation = -" + w_y +
                                   "; v=1: " + w + ", rotation = " + w_y +
                                   "; u=0: " + w + ", rotation = -" + w_x +
                                   "; u=1: " + w;
  // m_xx = D (rho_xx + nu rho_yy), rho = -(0.02, -0.06)
  const std::string moment = "set Edge moments = u=1: D*(-0.02 + 0.3*0.06)";
  for (const Element &element : elements)
    {
      const unsigned int p        = element.degree;
      const bool         lagrange = element.type == ElementType::lagrange;
      const auto         name_of  = ", " + label(element);
      test_patch({"bending, skew cells, rotations" + name_of,
                  skew,
                  element,
                  0,
                  skew_edges,
                  "",
                  exact,
                  p == 2 ? 1e-11 : 1e-10});
      test_patch({"bending, square cells, moment" + name_of,
                  "u, v, 0",
                  element,
                  0,
                  square_edges,
                  moment,
                  exact,
                  p == 2 ? 1e-11 : 1e-10});
      // Rational integrands: the edges' rule isn't exact. Bilinear images of
      // the 8 nodes' functions do not hold all quadratic polynomials, nor do
      // curved triangles.
      test_patch({"bending, distorted cells, moment" + name_of,
                  distorted,
                  element,
                  lagrange ? 1U : 0U,
                  square_edges,
                  moment,
                  exact,
                  lagrange ? (p == 2 ? 1e-7 : 1e-8) : 1e-4},
                 lagrange);
    }
}

/** A plane in space: components along normal, conormal and tangent. */
void
test_in_space()
{
  // x' = 0.6 x + 0.8 z in the plane, normal (-0.8, 0, 0.6). Displacement
  // w = 0.01 x'^2 along the normal and 0.02 x' in the plane.
  const std::string x     = "(0.6*x + 0.8*z)";
  const std::string w     = "normal = 0.01*" + x + "^2";
  const VectorField exact = [](const Point<3> &p) {
    const double x = 0.6 * p[0] + 0.8 * p[2];
    const double w = 0.01 * x * x, v = 0.02 * x;
    Vector3      u;
    u[0] = 0.6 * v - 0.8 * w;
    u[2] = 0.8 * v + 0.6 * w;
    return u;
  };
  // The tangent t0 x n is (-x') on v = 1 and x' on v = 0.
  test_patch({"plane in space, components of the edges' frames",
              "0.6*u, v, 0.8*u",
              {ElementType::lagrange, 2},
              0,
              "u=0: " + w + ", conormal = -0.02*" + x +
                ", tangent = 0, rotation = -0.02*" + x + "; u=1: " + w +
                ", conormal = 0.02*" + x + ", tangent = 0, rotation = 0.02*" +
                x + "; v=0: " + w + ", conormal = 0, tangent = 0.02*" + x +
                ", rotation = 0; v=1: " + w +
                ", conormal = 0, tangent = -0.02*" + x + ", rotation = 0",
              "",
              exact,
              1e-11});
}

/** Resultant force and moment about the origin of nodal forces. */
template <typename VectorType>
std::array<double, 6>
work_on_rigid_motions(const Discretization &discretization,
                      const VectorType     &forces)
{
  std::array<double, 6> work;
  for (unsigned int k = 0; k < 6; ++k)
    {
      const auto motion = interpolate(discretization, [&](const Point<3> &x) {
        Vector3 e;
        e[k % 3] = 1.;
        return k < 3 ? e : cross_product_3d(e, Vector3(x));
      });
      work[k]           = 0.;
      for (unsigned int i = 0; i < motion.size(); ++i)
        work[k] += forces(i) * motion(i);
    }
  return work;
}

/** Resultant force and moment about the origin of all kinds of loads. */
void
test_load_resultants()
{
  const TextModel parameters(
    "subsection Section\n set Thickness = 0.4\n set Density = 5\nend\n"
    "subsection Mid-surface\n set Surface = expression\n"
    " set Subdivisions = 3, 2\n subsection expression\n  set Position = " +
    skew +
    "\n end\nend\nsubsection Loads\n"
    " set Force per area = 1, 2, 3\n set Gravity = 0, 0, -2\n"
    " set Pressure = 0.7\n set Edge forces = v=1: 0.5, 0, 0\n"
    " set Edge moments = v=0: 0.2\n"
    " set Point forces = (0.65, 0.5, 0): 0, 0, 1.5\nend\n");
  const ShellModel    &model = parameters.model;
  const Discretization discretization(model.midsurface,
                                      MPI_COMM_WORLD,
                                      Element{ElementType::lagrange, 3},
                                      0,
                                      0);
  const Assembly       assembly(discretization, model);

  // Centroid (0.65, 0.5), area 1, the edge v = 1 from (0.3, 1) to (1.3, 1). The
  // moment 0.2 works on theta = -1 when the plate turns about x.
  const std::array<double, 6> exact = {{1.5,
                                        2.,
                                        3. - 4. + 0.7 + 1.5,
                                        0.5 * (-0.3 + 1.5) + 0.2,
                                        -0.65 * (-0.3 + 1.5),
                                        0.65 * 2. - 0.5 * 1. - 0.5}};
  AffineConstraints<double>   none;
  none.close();
  const auto     load = dense_system(discretization, assembly, none).second;
  TrilinosVector residual(discretization.locally_owned_dofs(), MPI_COMM_WORLD);
  assembly.residual(interpolate(discretization,
                                [](const auto &) { return Vector3(); }),
                    residual);
  const auto load_work     = work_on_rigid_motions(discretization, load);
  const auto residual_work = work_on_rigid_motions(discretization, residual);
  double     error = 0., residual_error = 0.;
  for (unsigned int k = 0; k < 6; ++k)
    {
      error = std::max(error, std::abs(load_work[k] - exact[k]));
      residual_error =
        std::max(residual_error, std::abs(residual_work[k] + exact[k]));
    }
  check_below("resultants of the loads", error, 1e-12);
  check_below("resultants of the residual", residual_error, 1e-12);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_membrane();
  test_bending();
  test_in_space();
  test_load_resultants();
  return n_failures > 0;
}
