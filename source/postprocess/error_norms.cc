// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/mechanics/shell_strain.h>
#include <nacre/postprocess/error_norms.h>
#include <nacre/problem/exact_solution.h>

#include <deal.II/base/quadrature_lib.h>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, spacedim>;

    /** Value and reference derivatives of a displacement at a point. */
    struct Field
    {
      Vector3                value;
      std::array<Vector3, 2> du;
      std::array<Vector3, 3> ddu;

      void
      add(const ShapeTable  &shapes,
          const unsigned int q,
          const unsigned int a,
          const Vector3     &u)
      {
        value += shapes.value(q, a) * u;
        for (unsigned int alpha = 0; alpha < 2; ++alpha)
          du[alpha] += shapes.gradient(q, a)[alpha] * u;
        for (unsigned int v = 0; v < 3; ++v)
          ddu[v] += shapes.hessian(q, a)[v] * u;
      }
    };

    /** rows(3 q .. 3 q + 2) times the local displacement. */
    Voigt<>
    strain_of(const FullMatrix<double> &rows,
              const unsigned int        q,
              const Vector<double>     &u)
    {
      Voigt<> strain;
      for (unsigned int v = 0; v < 3; ++v)
        for (unsigned int i = 0; i < u.size(); ++i)
          strain[v] += rows(3 * q + v, i) * u[i];
      return strain;
    }
  } // namespace

  ErrorNorms
  compute_error_norms(const SolvedShell &shell)
  {
    const auto               &discretization = shell.discretization;
    const unsigned int        p              = discretization.degree();
    const QGauss<dim>         quadrature(p + 3);
    ShellCellValues           values(discretization,
                           quadrature,
                           shell.membrane_strain == MembraneStrain::tied);
    const FE_Q<dim, spacedim> fine_fe(p + 2);
    const ShapeTable          fine_shapes(fine_fe, quadrature.get_points());

    std::array<double, 3>                squares{};
    std::vector<types::global_dof_index> dofs(values.n_dofs());
    Vector<double>                       u(values.n_dofs());
    run_on_all_ranks(discretization.communicator(), [&]() {
      for (const auto &cell :
           discretization.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            values.reinit(cell);
            cell->get_dof_indices(dofs);
            for (unsigned int i = 0; i < dofs.size(); ++i)
              u[i] = shell.displacement(dofs[i]);

            std::vector<Vector3> exact;
            for (const auto &unit : fine_fe.get_unit_support_points())
              exact.push_back(shell.exact_solution.displacement(
                discretization.mapping().transform_unit_to_real_cell(cell,
                                                                     unit)));

            for (unsigned int q = 0; q < values.n_points(); ++q)
              {
                Field field, error;
                for (unsigned int a = 0; a < exact.size(); ++a)
                  field.add(fine_shapes, q, a, exact[a]);
                error = field;
                for (unsigned int a = 0; a < values.shapes().n_nodes(); ++a)
                  {
                    Vector3 node;
                    for (unsigned int c = 0; c < spacedim; ++c)
                      node[c] = u[values.dof(a, c)];
                    error.add(values.shapes(), q, a, -node);
                  }

                const auto   &frame      = values.frame(q);
                const Vector3 gradient[] = {frame.metric_con[0] * error.du[0] +
                                              frame.metric_con[2] * error.du[1],
                                            frame.metric_con[2] * error.du[0] +
                                              frame.metric_con[1] *
                                                error.du[1]};
                const auto    stiffness =
                  shell.section.stiffness(frame, values.point(q));
                const Voigt<> membrane =
                  ShellStrain::membrane(frame, field.du[0], field.du[1]) -
                  strain_of(values.membrane_rows(), q, u);
                const Voigt<> bending =
                  ShellStrain::bending(frame, error.du, error.ddu);

                squares[0] += values.JxW(q) * error.value.norm_square();
                squares[1] += values.JxW(q) * (gradient[0] * error.du[0] +
                                               gradient[1] * error.du[1]);
                squares[2] +=
                  values.JxW(q) * (membrane * (stiffness.membrane * membrane) +
                                   bending * (stiffness.bending * bending));
              }
          }
    });

    ErrorNorms norms;
    const auto root = [&](const double square) {
      return std::sqrt(
        Utilities::MPI::sum(square, discretization.communicator()));
    };
    norms.L2     = root(squares[0]);
    norms.H1     = root(squares[1]);
    norms.energy = root(squares[2]);
    return norms;
  }
} // namespace Nacre
