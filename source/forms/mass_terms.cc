// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/shell_values.h>
#include <nacre/forms/mass_terms.h>

#include <sstream>

namespace Nacre
{
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
    return Utilities::MPI::sum(sum, discretization_.communicator());
  }

  void
  MassTerms::vmult(Vector &result, const Vector &v) const
  {
    result                = 0.;
    const auto &node_dofs = discretization_.node_dofs();
    std::vector<types::global_dof_index> dofs(node_dofs.size());
    dealii::Vector<double>               local(node_dofs.size());
    for (const CellPart &part : discretization_.owned_parts())
      {
        discretization_.get_dof_indices(part, dofs);
        local = 0.;
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
    matrix                = 0.;
    right_hand_side       = 0.;
    const auto &node_dofs = discretization_.node_dofs();
    std::vector<types::global_dof_index> dofs(node_dofs.size());
    FullMatrix<double>     local(node_dofs.size(), node_dofs.size());
    dealii::Vector<double> unused(node_dofs.size());
    for (const CellPart &part : discretization_.owned_parts())
      {
        discretization_.get_dof_indices(part, dofs);
        local = 0.;
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
    const auto &M         = cell_matrix(part);
    const auto &node_dofs = discretization_.node_dofs();
    for (unsigned int a = 0; a < M.m(); ++a)
      for (unsigned int b = 0; b < M.n(); ++b)
        for (unsigned int c = 0; c < spacedim; ++c)
          {
            const unsigned int i = node_dofs[spacedim * a + c];
            const unsigned int j = node_dofs[spacedim * b + c];
            residual[i] += M(a, b) * w(dofs[j]);
            if (tangent != nullptr)
              (*tangent)(i, j) += factor * M(a, b);
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
