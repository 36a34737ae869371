// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Cut shells: the patch test, another constant state in each piece; pieces
// that move as rigid bodies, each another way.

#include "cut_shell.h"
#include <nacre/discretization/shell_components.h>

using namespace CutShells;

namespace
{
  /**
   * Constant tension and bending along an oblique cut, other ones on either
   * side of it: no force at nodes inside.
   */
  void
  test_patch(const Element               &element,
             const MembraneStrain         strain,
             const std::vector<Point<3>> &refined_at = {})
  {
    const double   s = std::sin(.576), c = std::cos(.576), nu = .3;
    const CutShell shell(
      surface_text("u, v, 0", 8, 5, "0, 2"),
      element,
      {line("cut", {{1. - 3. * c, .5 - 3. * s}, {1. + 3. * c, .5 + 3. * s}})},
      strain,
      refined_at);
    const auto u =
      shell.interpolate([&](const CellPart &part, const Point<3> &X) {
        const auto   inside = shell.discretization->point_inside(part);
        const bool   above  = c * (inside[1] - .5) - s * (inside[0] - 1.) > 0.;
        const double x = X[0] - 1., y = X[1] - .5;
        const double along = c * x + s * y, off = c * y - s * x;
        const double e = above ? .01 : -.02, k = above ? .3 : -.5;
        return Vector3{{e * (along * c + nu * off * s),
                        e * (along * s - nu * off * c),
                        .02 * k - .5 * k * (along * along - nu * off * off)}};
      });
    TrilinosWrappers::SparseMatrix matrix;
    auto                           load  = zero_vector(*shell.discretization);
    auto                           force = load;
    const auto &constraints = shell.discretization->node_constraints();
    shell.assembly->reinit_matrix(constraints, matrix);
    shell.assembly->assemble_system(constraints, matrix, load);
    auto masters = u;
    constraints.set_zero(masters);
    matrix.vmult(force, masters);
    const auto   on_boundary = shell.boundary_dofs();
    double       inside = 0., outside = 0.;
    unsigned int n_inside = 0;
    for (unsigned int i = 0; i < on_boundary.size(); ++i)
      if (!constraints.is_constrained(i))
        {
          double &largest = on_boundary[i] ? outside : inside;
          largest         = std::max(largest, std::abs(force(i)));
          n_inside += on_boundary[i] ? 0 : 1;
        }
    const auto name = "patch, " + label(element) + ", " + name_of(strain) +
                      (refined_at.empty() ? "" : ", hanging nodes");
    check_below(name + ": force inside", inside / outside, 1e-9);
    check_above(name + ": nodes inside", n_inside, 60);
  }

  /** Two pieces of a curved shell, each moved as a rigid body. */
  void
  test_finite_motions(const Element               &element,
                      const KinematicsModel        model,
                      const std::vector<Point<3>> &refined_at = {})
  {
    const double   E = 100., h = .2;
    const CutShell shell(
      surface_text(
        "u + 0.1*sin(3*v), v + 0.1*sin(2*u), 0.3*u^2 + 0.2*cos(3*v + u)",
        4,
        3,
        "-1, 1",
        section_text(E, .3, h)),
      element,
      {line("cut", {{-1.1, .35}, {0., .41}, {1.1, .69}})},
      {MembraneStrain::tied,
       EdgeForm::rotation_jump,
       model,
       TangentType::consistent},
      refined_at);
    const ShellComponents components(*shell.discretization);
    const VectorField     motions[] = {
          rigid_motion(Vector3{{1.9, -1.2, .8}}, Vector3{{.3, -2., 1.}}),
          rigid_motion(Vector3{{-.4, .9, 2.1}}, Vector3{{1., .5, -.7}})};
    const auto u =
      shell.interpolate([&](const CellPart &part, const Point<3> &X) {
        return motions[components.of(part)](X);
      });
    auto force = zero_vector(*shell.discretization);
    shell.assembly->residual(u, force);
    const auto name =
      "two finite motions, " + label(element) + ", " +
      (model == KinematicsModel::finite ? "finite: " : "corotational: ") +
      (refined_at.empty() ? "" : "hanging nodes, ");
    unsigned int n_followers = 0;
    for (unsigned int i = 0; i < shell.discretization->n_dofs(); ++i)
      n_followers +=
        shell.discretization->node_constraints().is_constrained(i) ? 1 : 0;
    check_above(name + "pieces", components.size(), 1);
    check_above(name + "followers", n_followers, 10);
    // The shell is two long, and moves by more
    check_below(name + "force over E h u",
                force.linfty_norm() / (E * h * u.linfty_norm()),
                1e-12);
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const auto &element : {Element{ElementType::lagrange, 2},
                              Element{ElementType::lagrange, 3},
                              triangle})
    test_patch(element, MembraneStrain::tied);
  test_patch({ElementType::lagrange, 2}, MembraneStrain::full);
  test_patch(serendipity, MembraneStrain::reduced);
  for (const auto model :
       {KinematicsModel::corotational, KinematicsModel::finite})
    for (const auto &element : {Element{ElementType::lagrange, 2},
                                Element{ElementType::lagrange, 3},
                                triangle})
      test_finite_motions(element, model);

  // Smaller cells beside the layer around the cut, then the cut's smaller, too
  const std::vector<Point<3>> corners{{.1, .9, 0.}, {1.9, .1, 0.}};
  auto                        all = corners;
  all.emplace_back(1., .5, 0.);
  const Element quadratic{ElementType::lagrange, 2};
  test_patch({ElementType::lagrange, 3}, MembraneStrain::tied, corners);
  test_patch(quadratic, MembraneStrain::tied, all);
  test_finite_motions(quadratic,
                      KinematicsModel::finite,
                      {{.63, -.7, .12}, {.09, .41, .07}});
  test_finite_motions(serendipity, KinematicsModel::finite, {{.63, -.7, .12}});
  return n_failures > 0;
}
