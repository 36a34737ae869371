// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/mechanics/shell_strain.h>
#include <nacre/postprocess/error_norms.h>
#include <nacre/problem/exact_solution.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_dgp.h>

#include <deal.II/lac/householder.h>

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
      add(const double factor, const FieldDerivatives &field)
      {
        value += factor * field.value;
        for (unsigned int alpha = 0; alpha < 2; ++alpha)
          du[alpha] += factor * field.first[alpha];
        for (unsigned int v = 0; v < 3; ++v)
          ddu[v] += factor * field.second[v];
      }

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

    /** Squares of the three norms of the error on one cell after another. */
    class CellErrors
    {
    public:
      explicit CellErrors(const SolvedShell &shell)
        : shell_(shell)
        , quadrature_(shell.discretization.element().fine_quadrature())
        , values_(shell.discretization,
                  quadrature_,
                  recovers_tied_strain(shell.model.kinematics.membrane_strain))
        , fine_fe_(shell.discretization.degree() + 2)
        , part_fe_(shell.discretization.degree() + 2)
        , fine_shapes_(fine_fe_, quadrature_.get_points())
        , dofs_(values_.n_dofs())
        , u_(values_.n_dofs())
      {}

      void
      add(const CellPart &part)
      {
        values_.reinit(part);
        shell_.discretization.get_dof_indices(part, dofs_);
        u_.reinit(dofs_.size(), true);
        for (unsigned int i = 0; i < dofs_.size(); ++i)
          u_[i] = shell_.displacement(dofs_[i]);

        exact_.clear();
        if (part.is_cut() || part.enrichment() != nullptr)
          add_part();
        else
          {
            for (const auto &unit : fine_fe_.get_unit_support_points())
              exact_.push_back(shell_.model.exact_solution.displacement(
                shell_.discretization.mapping()
                  .transform_unit_to_real_cell(part.cell, unit)));
            for (unsigned int q = 0; q < values_.n_points(); ++q)
              add_point(q, fine_shapes_);
          }
      }

      /** L2, H1, energy. */
      std::array<double, 3> squares{};

    private:
      /**
       * The least squares of complete polynomials at the part's own points: the
       * exact solution may jump at a cut, and nodes lie across it.
       */
      void
      add_part()
      {
        const ShapeTable   shapes(part_fe_, values_.quadrature().get_points());
        FullMatrix<double> matrix(values_.n_points(), shapes.n_nodes());
        std::array<Vector<double>, spacedim> data;
        data.fill(Vector<double>(values_.n_points()));
        for (unsigned int q = 0; q < values_.n_points(); ++q)
          {
            for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
              matrix(q, a) = shapes.value(q, a);
            const auto u =
              shell_.model.exact_solution.displacement(values_.point(q));
            for (unsigned int c = 0; c < spacedim; ++c)
              data[c](q) = u[c];
          }
        Householder<double> squares(matrix);
        Vector<double>      coefficients(shapes.n_nodes());
        exact_.resize(shapes.n_nodes());
        for (unsigned int c = 0; c < spacedim; ++c)
          {
            squares.least_squares(coefficients, data[c]);
            for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
              exact_[a][c] = coefficients(a);
          }
        for (unsigned int q = 0; q < values_.n_points(); ++q)
          add_point(q, shapes);
      }

      void
      add_point(const unsigned int q, const ShapeTable &fine_shapes)
      {
        Field exact;
        for (unsigned int a = 0; a < exact_.size(); ++a)
          exact.add(fine_shapes, q, a, exact_[a]);
        Field error = exact;
        for (unsigned int a = 0; a < values_.shapes().n_nodes(); ++a)
          {
            Vector3 node;
            for (unsigned int c = 0; c < spacedim; ++c)
              node[c] = u_[values_.dof(a, c)];
            error.add(values_.shapes(), q, a, -node);
          }
        for (unsigned int k = 0; k < values_.n_tip_functions(); ++k)
          error.add(-u_[values_.tip_dof(k)], values_.tip_function(q, k));

        const auto &frame           = values_.frame(q);
        const auto &g               = frame.metric_con;
        const auto  gradient_square = g[0] * (error.du[0] * error.du[0]) +
                                     g[1] * (error.du[1] * error.du[1]) +
                                     2. * g[2] * (error.du[0] * error.du[1]);
        const Voigt<> membrane =
          ShellStrain::membrane(frame, exact.du[0], exact.du[1]) -
          strain_of(values_.membrane_rows(), q, u_);
        const Voigt<> bending =
          ShellStrain::bending(frame, error.du, error.ddu);

        squares[0] += values_.JxW(q) * error.value.norm_square();
        squares[1] += values_.JxW(q) * gradient_square;
        const auto error_response =
          shell_.model.section->response(membrane,
                                         bending,
                                         frame,
                                         values_.point(q));
        squares[2] += values_.JxW(q) * 2. * error_response.energy;
      }

      const SolvedShell    &shell_;
      const Quadrature<dim> quadrature_;
      ShellCellValues       values_;
      /** On the square that holds a triangle, too. */
      const FE_Q<dim, spacedim>            fine_fe_;
      const FE_DGP<dim, spacedim>          part_fe_;
      const ShapeTable                     fine_shapes_;
      std::vector<types::global_dof_index> dofs_;
      Vector<double>                       u_;
      std::vector<Vector3>                 exact_;
    };
  } // namespace

  ErrorNorms
  compute_error_norms(const SolvedShell &shell)
  {
    const auto &discretization = shell.discretization;
    CellErrors  errors(shell);
    run_on_all_ranks(discretization.communicator(), [&]() {
      for (const CellPart &part : discretization.owned_parts())
        errors.add(part);
    });
    const auto root = [&](const double square) {
      return std::sqrt(
        Utilities::MPI::sum(square, discretization.communicator()));
    };
    return {root(errors.squares[0]),
            root(errors.squares[1]),
            root(errors.squares[2])};
  }
} // namespace Nacre
