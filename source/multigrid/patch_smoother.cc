// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/multigrid/dense_kernels.h>
#include <nacre/multigrid/patch_smoother.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace Nacre
{
  namespace
  {
    /**
     * The colour of each rank from each rank's neighbours: different for ranks
     * that are neighbours or have one in common.
     */
    std::vector<unsigned int>
    colour_ranks(const std::vector<std::vector<unsigned int>> &neighbours)
    {
      const unsigned int                  n = neighbours.size();
      std::vector<std::set<unsigned int>> near(n);
      for (unsigned int rank = 0; rank < n; ++rank)
        for (const unsigned int other : neighbours[rank])
          {
            near[rank].insert(other);
            near[other].insert(rank);
          }
      std::vector<unsigned int> colours(n, n);
      for (unsigned int rank = 0; rank < n; ++rank)
        {
          std::set<unsigned int> taken;
          for (const unsigned int other : near[rank])
            {
              taken.insert(colours[other]);
              for (const unsigned int third : near[other])
                if (third != rank)
                  taken.insert(colours[third]);
            }
          colours[rank] = 0;
          while (taken.count(colours[rank]) > 0)
            ++colours[rank];
        }
      return colours;
    }
  } // namespace


  bool
  PatchSmoother::reinit(const LevelMatrix   &matrix,
                        const VertexPatches &patches,
                        const unsigned int   n_steps)
  {
    matrix_                 = &matrix;
    n_steps_                = n_steps;
    const auto &partitioner = *matrix.partitioner();
    position_.assign(matrix.n_local(), -1);
    scaling_.assign(matrix.n_local(), 0.);
    bool is_definite = true;
    for (unsigned int i = 0; i < scaling_.size(); ++i)
      if (matrix.row_length(i) > 0)
        {
          is_definite &= (matrix.diagonal(i) > 0.);
          scaling_[i] = 1. / std::sqrt(std::abs(matrix.diagonal(i)));
        }
    additions_.reinit(matrix.partitioner());

    inner_.clear();
    border_.clear();
    local_dofs_.resize(patches.dofs.size());
    for (std::size_t k = 0; k < local_dofs_.size(); ++k)
      local_dofs_[k] = partitioner.global_to_local(patches.dofs[k]);
    std::size_t  n_entries = 0;
    unsigned int n_max     = 0;
    for (unsigned int k = 0; k < patches.size(); ++k)
      {
        const unsigned int n = patches.start[k + 1] - patches.start[k];
        const Patch        patch{patches.start[k], n_entries, n};
        bool               is_inner = true;
        for (unsigned int i = 0; i < n; ++i)
          is_inner &= matrix.is_interior(local_dofs_[patch.first_dof + i]);
        (is_inner ? inner_ : border_).push_back(patch);
        n_entries += std::size_t(n) * (n + 1) / 2;
        n_max = std::max(n_max, n);
      }
    inverses_.resize(n_entries);
    dense_.resize(std::size_t(n_max) * n_max);
    for (auto *room : {&residual_, &correction_})
      room->resize(n_max);
    products_.resize(n_max);
    for (const auto *list : {&inner_, &border_})
      for (const Patch &patch : *list)
        is_definite = is_definite && invert(patch);
    find_colours();
    return Utilities::MPI::min(is_definite ? 1 : 0,
                               partitioner.get_mpi_communicator()) == 1;
  }


  void
  PatchSmoother::find_colours()
  {
    const auto               &partitioner = *matrix_->partitioner();
    std::vector<unsigned int> neighbours;
    for (const auto &target : partitioner.ghost_targets())
      neighbours.push_back(target.first);
    const auto communicator = partitioner.get_mpi_communicator();
    const auto colours =
      colour_ranks(Utilities::MPI::all_gather(communicator, neighbours));
    my_colour_ = colours[Utilities::MPI::this_mpi_process(communicator)];
    n_colours_ = colours.size() == 1 ?
                   0 :
                   1 + *std::max_element(colours.begin(), colours.end());
    Assert(n_colours_ > 0 || border_.empty(), ExcInternalError());
  }


  void
  PatchSmoother::extract(const Patch &patch)
  {
    const unsigned int *dofs = local_dofs_.data() + patch.first_dof;
    const unsigned int  n    = patch.n;
    for (unsigned int i = 0; i < n; ++i)
      position_[dofs[i]] = i;
    std::fill(dense_.begin(), dense_.begin() + std::size_t(n) * n, 0.);
    for (unsigned int i = 0; i < n; ++i)
      {
        // Dofs of a node share their columns.
        if (i == 0 ||
            matrix_->pattern(dofs[i]) != matrix_->pattern(dofs[i - 1]))
          {
            matrix_->get_columns(dofs[i], columns_);
            entries_.clear();
            for (unsigned int k = 0; k < columns_.size(); ++k)
              if (position_[columns_[k]] >= 0)
                entries_.push_back({k, position_[columns_[k]]});
          }
        const double *values  = matrix_->row_values(dofs[i]);
        const double  scale_i = scaling_[dofs[i]];
        for (const auto &[k, j] : entries_)
          dense_[i * n + j] = scale_i * values[k] * scaling_[dofs[j]];
      }
    for (unsigned int i = 0; i < n; ++i)
      position_[dofs[i]] = -1;
  }


  bool
  PatchSmoother::invert(const Patch &patch)
  {
    extract(patch);
    // LAPACK's upper triangle, columns first, is the lower one of rows.
    const types::blas_int n = patch.n;
    types::blas_int       info;
    potrf("U", &n, dense_.data(), &n, &info);
    if (info != 0)
      return false;
    potri("U", &n, dense_.data(), &n, &info);
    float *inverse = inverses_.data() + patch.first_entry;
    for (unsigned int i = 0; i < patch.n; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        *inverse++ = static_cast<float>(dense_[i * patch.n + j]);
    return info == 0;
  }


  void
  PatchSmoother::relax(const Patch &patch, double *x, const double *b) const
  {
    const unsigned int *dofs = local_dofs_.data() + patch.first_dof;
    matrix_->multiply_rows(patch.n, dofs, x, products_.data());
    for (unsigned int i = 0; i < patch.n; ++i)
      residual_[i] =
        static_cast<float>(scaling_[dofs[i]] * (b[dofs[i]] - products_[i]));
    DenseKernels::multiply_packed(patch.n,
                                  inverses_.data() + patch.first_entry,
                                  residual_.data(),
                                  correction_.data());
    for (unsigned int i = 0; i < patch.n; ++i)
      x[dofs[i]] += scaling_[dofs[i]] * correction_[i];
  }


  void
  PatchSmoother::sweep(const std::vector<Patch> &patches,
                       const bool                backwards,
                       Vector                   &x,
                       const Vector             &b) const
  {
    if (backwards)
      for (auto patch = patches.rbegin(); patch != patches.rend(); ++patch)
        relax(*patch, x.begin(), b.begin());
    else
      for (const Patch &patch : patches)
        relax(patch, x.begin(), b.begin());
  }


  void
  PatchSmoother::sweep_border(const unsigned int colour,
                              const bool         backwards,
                              Vector            &x,
                              const Vector      &b) const
  {
    const unsigned int n_owned = matrix_->n_owned();
    const unsigned int n_local = matrix_->n_local();
    additions_.zero_out_ghost_values();
    double *additions = additions_.begin();
    std::fill(additions, additions + n_local, 0.);
    if (colour == my_colour_)
      {
        for (unsigned int i = n_owned; i < n_local; ++i)
          additions[i] = -x.begin()[i];
        sweep(border_, backwards, x, b);
        for (unsigned int i = n_owned; i < n_local; ++i)
          additions[i] += x.begin()[i];
      }
    additions_.compress(VectorOperation::add);
    for (unsigned int i = 0; i < n_owned; ++i)
      x.begin()[i] += additions[i];
    x.update_ghost_values();
  }


  void
  PatchSmoother::forward(Vector &x, const Vector &b) const
  {
    for (unsigned int step = 0; step < n_steps_; ++step)
      {
        for (unsigned int colour = 0; colour < n_colours_; ++colour)
          sweep_border(colour, false, x, b);
        sweep(inner_, false, x, b);
        x.update_ghost_values();
      }
  }


  void
  PatchSmoother::backward(Vector &x, const Vector &b) const
  {
    for (unsigned int step = 0; step < n_steps_; ++step)
      {
        sweep(inner_, true, x, b);
        x.update_ghost_values();
        for (unsigned int colour = n_colours_; colour-- > 0;)
          sweep_border(colour, true, x, b);
      }
  }
} // namespace Nacre
