// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Tips in large rotations: a shell that is deformed and then turned by a finite
// rotation, the coefficients of functions with it, has the same energy and the
// turned forces; forces and tangents are derivatives. Sections that couple
// membrane forces and bending, too.

#include "cut_shell.h"
#include <nacre/forms/mass_terms.h>

using namespace CutShells;

namespace
{
  /**
   * A doubly curved shell with a tip and parts that follow others; a plate for
   * harmonic functions, which need straight cuts.
   */
  CutShell
  cracked_shell(const KinematicsModel model,
                const CutTips         tips,
                const std::string    &section = section_text(100., .3, .2))
  {
    return CutShell(surface_text(tips == CutTips::harmonic ?
                                   "u, v, 0" :
                                   "u + 0.05*v^2, v, 0.15*u^2 + "
                                   "0.1*cos(2*v + u)",
                                 6,
                                 5,
                                 "-1, 1",
                                 section),
                    {ElementType::lagrange, 2},
                    {line("cut", {{-1.1, .44}, {.16, .44}})},
                    {MembraneStrain::tied,
                     EdgeForm::rotation_jump,
                     model,
                     TangentType::consistent},
                    {},
                    tips);
  }

  /** @p use(i, a, x) for the first dof i of each vector a, x its place. */
  template <typename Use>
  void
  for_each_vector(const Discretization &discretization, const Use &use)
  {
    std::vector<types::global_dof_index> dofs;
    for (const CellPart &part : discretization.owned_parts())
      {
        discretization.get_dof_indices(part, dofs);
        const auto nodes = discretization.node_positions(part);
        for (unsigned int a = 0; a < dofs.size() / 3; ++a)
          {
            // The coefficients of functions have no place.
            const Point<3> X = a < nodes.size() ? nodes[a] : Point<3>();
            use({{dofs[discretization.local_dof(a, 0)],
                  dofs[discretization.local_dof(a, 1)],
                  dofs[discretization.local_dof(a, 2)]}},
                Vector3(X));
          }
      }
  }

  using Dofs3 = std::array<types::global_dof_index, 3>;

  Vector3
  vector_at(const TrilinosVector &v, const Dofs3 &dofs)
  {
    return Vector3{{v(dofs[0]), v(dofs[1]), v(dofs[2])}};
  }

  std::string
  label(const KinematicsModel model,
        const CutTips         tips,
        const std::string    &section)
  {
    return name_of(model) + ", " + name_of(tips) +
           (section == laminate ? ", laminate" : "");
  }

  /** Energy-momentum forces of a step do the work that the energy rises by. */
  void
  test_step(const std::string    &name,
            const CutShell       &shell,
            const TrilinosVector &u,
            const TrilinosVector &v)
  {
    auto start = u;
    start *= .5;
    auto mean = start, change = v, force = v;
    mean.sadd(.5, .5, v);
    change -= start;
    const MassTerms mass(*shell.discretization);
    const auto      zero = zero_vector(*shell.discretization);
    const StepStart from{start, {}};
    const Inertia   inertia{mass, zero, 0., &from};
    shell.assembly->residual(mean,
                             shell.assembly->actions(Instant()),
                             force,
                             &inertia);
    const double rise = shell.assembly->energies(v).total() -
                        shell.assembly->energies(start).total();
    check_below(name + ": work of a step",
                std::abs(force * change / rise - 1.),
                1e-9);
  }

  void
  test_rotation(const KinematicsModel model,
                const CutTips         tips,
                const std::string    &section = section_text(100., .3, .2))
  {
    const CutShell shell  = cracked_shell(model, tips, section);
    const auto    &space  = *shell.discretization;
    const auto     u      = random_field(space, 2e-3);
    const auto     motion = rigid_motion(Vector3{{1.9, -1.2, .8}}, Vector3());
    const auto     turned = [&](const Vector3 &x) {
      return Vector3(x + motion(Point<3>(x)));
    };
    auto v = zero_vector(space), rigid = v, f_u = v, f_v = v, f_rigid = v;
    for_each_vector(space, [&](const Dofs3 &dofs, const Vector3 &X) {
      const Vector3 x = turned(X + vector_at(u, dofs)) - X;
      const Vector3 r = turned(X) - X;
      for (unsigned int c = 0; c < 3; ++c)
        {
          v(dofs[c])     = x[c];
          rigid(dofs[c]) = r[c];
        }
    });
    v.compress(VectorOperation::insert);
    rigid.compress(VectorOperation::insert);
    const auto name = label(model, tips, section);

    auto followed = v;
    space.node_constraints().distribute(followed);
    followed -= v;
    check_below(name + ": followers turn", followed.linfty_norm(), 1e-12);
    unsigned int n_functions = 0;
    for (const CellPart &part : space.owned_parts())
      if (part.enrichment() != nullptr)
        n_functions = std::max(n_functions, part.enrichment()->n_functions());
    if (tips != CutTips::closed)
      check_above(name + ": functions", n_functions, 8);

    shell.assembly->residual(u, f_u);
    shell.assembly->residual(v, f_v);
    shell.assembly->residual(rigid, f_rigid);
    double       error = 0.;
    const double scale = f_u.linfty_norm();
    for_each_vector(space, [&](const Dofs3 &dofs, const Vector3 &) {
      const Vector3 f = turned(vector_at(f_u, dofs));
      error           = std::max(error, (vector_at(f_v, dofs) - f).norm());
    });
    const double U = shell.assembly->energies(u).total();
    const double V = shell.assembly->energies(v).total();
    check_below(name + ": force after a rotation", error / scale, 1e-9);
    check_below(name + ": energy after it", std::abs(V / U - 1.), 1e-9);
    check_below(name + ": force of a rotation over E h",
                f_rigid.linfty_norm() / (100. * .2),
                1e-11);
    // Functions of tips are continuous to the error of their fit
    if (tips == CutTips::closed)
      test_step(name, shell, u, v);
  }

  void
  test_derivatives(const KinematicsModel model,
                   const CutTips         tips,
                   const std::string    &section = section_text(100., .3, .2))
  {
    const CutShell shell = cracked_shell(model, tips, section);
    const auto     name  = label(model, tips, section);
    const auto    &space = *shell.discretization;
    const auto     u     = random_field(space, 2e-3);
    // Another direction; the constraints hold along it.
    auto       du   = zero_vector(space);
    const auto size = space.n_dofs();
    for (unsigned int i = 0; i < size; ++i)
      du(i) = u((7 * i + 3) % size);
    du.compress(VectorOperation::insert);
    const auto &constraints = space.node_constraints();
    constraints.distribute(du);
    const double t     = 1e-4;
    auto         force = zero_vector(space), f_1 = force, f_2 = force;
    shell.assembly->residual(u, force);
    const auto moved = [&](const double factor) {
      auto v = u;
      v.add(factor * t, du);
      return v;
    };
    // Co-rotational forces are the gradient of no energy.
    const double W = (8. * (shell.assembly->energies(moved(1.)).total() -
                            shell.assembly->energies(moved(-1.)).total()) -
                      shell.assembly->energies(moved(2.)).total() +
                      shell.assembly->energies(moved(-2.)).total()) /
                     (12. * t);
    if (model == KinematicsModel::finite)
      check_below(name + ": force is the energy's derivative",
                  std::abs(force * du - W) / (force.l2_norm() * du.l2_norm()),
                  1e-7);

    shell.assembly->residual(moved(1.), f_1);
    shell.assembly->residual(moved(-1.), f_2);
    f_1 -= f_2;
    f_1 *= 1. / (2. * t);
    TrilinosWrappers::SparseMatrix matrix;
    auto                           load = force, K_du = force;
    AffineConstraints<double>      none(space.locally_relevant_dofs());
    none.close();
    shell.assembly->reinit_matrix(none, matrix);
    shell.assembly->assemble(u, none, matrix, load);
    matrix.vmult(K_du, du);
    f_1 -= K_du;
    check_below(name + ": tangent is the force's derivative",
                f_1.linfty_norm() / K_du.linfty_norm(),
                1e-5);
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_rotation(KinematicsModel::finite, CutTips::branch_functions);
  test_derivatives(KinematicsModel::finite, CutTips::branch_functions);
  test_rotation(KinematicsModel::corotational, CutTips::branch_functions);
  for (const auto model :
       {KinematicsModel::finite, KinematicsModel::corotational})
    {
      test_rotation(model, CutTips::harmonic, laminate);
      test_rotation(model, CutTips::closed, laminate);
      test_derivatives(model, CutTips::closed, laminate);
    }
  return n_failures > 0;
}
