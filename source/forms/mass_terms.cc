// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/shell_values.h>
#include <nacre/forms/mass_terms.h>

#include <sstream>

namespace Nacre
{
  namespace
  {
    /** Add dm psi_k . phi_i of a point for all dofs i of the part. */
    void
    add_tip_rows(const ShellCellValues &values,
                 const unsigned int     q,
                 const double           dm,
                 FullMatrix<double>    &rows)
    {
      const unsigned int n_tip = values.n_tip_functions();
      if (rows.m() == 0)
        rows.reinit(n_tip, values.n_dofs());
      for (unsigned int k = 0; k < n_tip; ++k)
        {
          const auto &psi = values.tip_function(q, k).value;
          for (unsigned int a = 0; a < values.shapes().n_nodes(); ++a)
            for (unsigned int c = 0; c < spacedim; ++c)
              rows(k, values.dof(a, c)) +=
                dm * psi[c] * values.shapes().value(q, a);
          for (unsigned int l = 0; l < n_tip; ++l)
            rows(k, values.tip_dof(l)) +=
              dm * (psi * values.tip_function(q, l).value);
        }
    }
  } // namespace

  MassTerms::MassTerms(const Discretization &discretization,
                       const SectionLaw     &section)
    : discretization_(discretization)
  {
    make_matrices([&](const SectionPoint &x) {
      const double       rho = section.density(x);
      std::ostringstream message;
      message << "Section/Density: " << rho << " at the point (" << x
              << "); an analysis with inertia needs a positive one.";
      AssertThrow(rho > 0., ExcMessage(message.str()));
      return rho * section.thickness(x);
    });
  }

  MassTerms::MassTerms(const Discretization &discretization)
    : discretization_(discretization)
  {
    make_matrices([](const SectionPoint &) { return 1.; });
  }

  void
  MassTerms::make_matrices(
    const std::function<double(const SectionPoint &)> &area_density)
  {
    cell_matrices_.resize(discretization_.n_part_indices());
    ShellCellValues values(discretization_,
                           discretization_.element().full_quadrature(),
                           false);
    run_on_all_ranks(discretization_.communicator(), [&]() {
      for (const CellPart &part : discretization_.owned_parts())
        {
          values.reinit_frames(part);
          const auto &shapes = values.shapes();
          const auto  n      = shapes.n_nodes();
          auto       &M      = cell_matrices_[part.index()];
          M.reinit(n, n);
          for (unsigned int q = 0; q < values.n_points(); ++q)
            {
              const double dm = area_density(values.point(q)) * values.JxW(q);
              total_ += dm;
              for (unsigned int a = 0; a < n; ++a)
                for (unsigned int b = 0; b < n; ++b)
                  M(a, b) += dm * shapes.value(q, a) * shapes.value(q, b);
              if (values.n_tip_functions() > 0)
                add_tip_rows(values, q, dm, tip_rows_[part.index()]);
            }
        }
    });
    total_ = Utilities::MPI::sum(total_, discretization_.communicator());
  }

  double
  MassTerms::trace() const
  {
    double sum = 0.;
    for (const auto &M : cell_matrices_)
      for (unsigned int a = 0; a < M.m(); ++a)
        sum += spacedim * M(a, a);
    for (const auto &[index, rows] : tip_rows_)
      for (unsigned int k = 0; k < rows.m(); ++k)
        sum += rows(k, rows.n() - rows.m() + k);
    return Utilities::MPI::sum(sum, discretization_.communicator());
  }

  void
  MassTerms::vmult(Vector &result, const Vector &v) const
  {
    result = 0.;
    std::vector<types::global_dof_index> dofs;
    dealii::Vector<double>               local;
    for (const CellPart &part : discretization_.owned_parts())
      {
        discretization_.get_dof_indices(part, dofs);
        local.reinit(dofs.size());
        add_on_cell(part, dofs, v, 0., local, nullptr);
        result.add(dofs, std::vector<double>(local.begin(), local.end()));
      }
    result.compress(VectorOperation::add);
  }

  void
  MassTerms::assemble_system(const AffineConstraints<double> &constraints,
                             const Vector                    &ghosted_b,
                             TrilinosWrappers::SparseMatrix  &matrix,
                             Vector &right_hand_side) const
  {
    matrix          = 0.;
    right_hand_side = 0.;
    std::vector<types::global_dof_index> dofs;
    FullMatrix<double>                   local;
    dealii::Vector<double>               unused;
    for (const CellPart &part : discretization_.owned_parts())
      {
        discretization_.get_dof_indices(part, dofs);
        local.reinit(dofs.size(), dofs.size());
        unused.reinit(dofs.size());
        add_on_cell(part, dofs, ghosted_b, 1., unused, &local);
        constraints.distribute_local_to_global(local, dofs, matrix);
      }
    matrix.compress(VectorOperation::add);
    // b is a sum over nodes already: each rank adds what it owns.
    dealii::Vector<double> entry(1);
    for (const auto i : discretization_.locally_owned_dofs())
      {
        entry[0] = ghosted_b(i);
        constraints.distribute_local_to_global(
          entry,
          std::vector<types::global_dof_index>{i},
          right_hand_side);
      }
    right_hand_side.compress(VectorOperation::add);
  }

  void
  MassTerms::add_on_cell(const CellPart                             &part,
                         const std::vector<types::global_dof_index> &dofs,
                         const Vector                               &w,
                         const double                                factor,
                         dealii::Vector<double>                     &residual,
                         FullMatrix<double> *tangent) const
  {
    const auto &M = cell_matrices_[part.index()];
    for (unsigned int a = 0; a < M.m(); ++a)
      for (unsigned int b = 0; b < M.n(); ++b)
        for (unsigned int c = 0; c < spacedim; ++c)
          {
            const unsigned int i = discretization_.local_dof(a, c);
            const unsigned int j = discretization_.local_dof(b, c);
            residual[i] += M(a, b) * w(dofs[j]);
            if (tangent != nullptr)
              (*tangent)(i, j) += factor * M(a, b);
          }
    const auto found = tip_rows_.find(part.index());
    if (found == tip_rows_.end())
      return;
    const auto        &rows  = found->second;
    const unsigned int first = rows.n() - rows.m();
    const auto         add =
      [&](const unsigned int i, const unsigned int j, const double m) {
        residual[i] += m * w(dofs[j]);
        if (tangent != nullptr)
          (*tangent)(i, j) += factor * m;
      };
    for (unsigned int k = 0; k < rows.m(); ++k)
      for (unsigned int j = 0; j < rows.n(); ++j)
        {
          add(first + k, j, rows(k, j));
          if (j < first)
            add(j, first + k, rows(k, j));
        }
  }

  Inertia::Inertia(const MassTerms                     &mass,
                   const TrilinosWrappers::MPI::Vector &w,
                   const double                         factor,
                   const StepStart                     *start)
    : start(start)
    , mass_(mass)
    , w_(w)
    , factor_(factor)
  {}

  void
  Inertia::add_on_cell(TermCell &cell, LocalTerms &terms) const
  {
    mass_.add_on_cell(cell.part,
                      cell.dofs,
                      w_,
                      factor_,
                      terms.residual,
                      terms.wants_tangent ? &terms.tangent : nullptr);
  }
} // namespace Nacre
