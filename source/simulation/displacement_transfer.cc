// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/simulation/displacement_transfer.h>

#include <deal.II/dofs/dof_tools.h>

namespace Nacre
{
  namespace
  {
    using Vector = TrilinosWrappers::MPI::Vector;
    using Dofs   = DoFHandler<dim, spacedim>;

    /** Take the values of @p from, ghosted, to the owned entries of @p to. */
    void
    copy_by_cell(const Dofs   &from_dofs,
                 const Vector &from,
                 const Dofs   &to_dofs,
                 Vector       &to)
    {
      const unsigned int n     = from_dofs.get_fe().n_dofs_per_cell();
      const IndexSet    &owned = to_dofs.locally_owned_dofs();
      std::vector<types::global_dof_index> from_indices(n), to_indices(n);
      for (const auto &cell : from_dofs.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const Dofs::active_cell_iterator same(&to_dofs.get_triangulation(),
                                                  cell->level(),
                                                  cell->index(),
                                                  &to_dofs);
            cell->get_dof_indices(from_indices);
            same->get_dof_indices(to_indices);
            for (unsigned int i = 0; i < n; ++i)
              if (owned.is_element(to_indices[i]))
                to(to_indices[i]) = from(from_indices[i]);
          }
      to.compress(VectorOperation::insert);
    }
  } // namespace

  DisplacementTransfer::DisplacementTransfer(
    const Discretization              &discretization,
    const std::vector<const Vector *> &fields,
    const std::vector<bool>           &marked)
    : fe_(discretization.dof_handler().get_fe().clone())
    , dof_handler_(discretization.triangulation())
    , marked_(marked)
  {
    dof_handler_.distribute_dofs(*fe_);
    for (const Vector *const field : fields)
      {
        Vector owned(dof_handler_.locally_owned_dofs(),
                     dof_handler_.get_communicator());
        copy_by_cell(discretization.dof_handler(), *field, dof_handler_, owned);
        values_.push_back(ghosted_vector());
        values_.back() = owned;
      }
  }

  DisplacementTransfer::Vector
  DisplacementTransfer::ghosted_vector() const
  {
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler_, relevant);
    return Vector(dof_handler_.locally_owned_dofs(),
                  relevant,
                  dof_handler_.get_communicator());
  }

  void
  DisplacementTransfer::refine(Mesh &mesh)
  {
    Assert(&mesh == &dof_handler_.get_triangulation(), ExcInternalError());
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned() && marked_[cell->active_cell_index()])
        cell->set_refine_flag();
    mesh.prepare_coarsening_and_refinement();
    transfer_ = std::make_unique<Transfer>(dof_handler_);
    std::vector<const Vector *> before;
    for (const Vector &values : values_)
      before.push_back(&values);
    transfer_->prepare_for_coarsening_and_refinement(before);
    mesh.execute_coarsening_and_refinement();
    dof_handler_.distribute_dofs(*fe_);
    std::vector<Vector>   owned(values_.size(),
                              Vector(dof_handler_.locally_owned_dofs(),
                                     dof_handler_.get_communicator()));
    std::vector<Vector *> after;
    for (Vector &values : owned)
      after.push_back(&values);
    transfer_->interpolate(after);
    for (unsigned int k = 0; k < owned.size(); ++k)
      {
        values_[k] = ghosted_vector();
        values_[k] = owned[k];
      }
  }

  DisplacementTransfer::Vector
  DisplacementTransfer::field_on(const Discretization &discretization,
                                 const unsigned int    k) const
  {
    Vector owned(discretization.locally_owned_dofs(),
                 discretization.communicator());
    copy_by_cell(dof_handler_, values_[k], discretization.dof_handler(), owned);
    discretization.node_constraints().distribute(owned);
    return owned;
  }
} // namespace Nacre
