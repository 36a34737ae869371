// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/forms/edge_penalty.h>
#include <nacre/forms/hinge_form.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/lac/lapack_full_matrix.h>

namespace Nacre
{
  namespace
  {
    /** |A| / |dA| and lambda_K of one cell after another. */
    class CellBound
    {
    public:
      CellBound(const Discretization  &discretization,
                const SectionLaw      &section,
                const Quadrature<dim> &quadrature)
        : section_(section)
        , values_(discretization, quadrature, false)
        , edge_(discretization)
        , fe_nothing_(discretization.element().reference_cell())
        , perimeter_values_(discretization.mapping(),
                            fe_nothing_,
                            QGauss<1>(discretization.degree() + 2),
                            update_JxW_values)
        , discretization_(discretization)
      {}

      void
      reinit(const DoFHandler<dim, spacedim>::active_cell_iterator &cell)
      {
        values_.reinit(cell);
        double area = 0.;
        for (unsigned int q = 0; q < values_.n_points(); ++q)
          area += values_.JxW(q);

        // Rows m_nn sqrt(ds / D) on the whole boundary, in local dofs.
        const unsigned int       n_points  = edge_.n_points();
        double                   perimeter = 0.;
        LAPACKFullMatrix<double> moments(values_.n_dofs(),
                                         cell->n_faces() * n_points);
        for (const auto face : cell->face_indices())
          {
            perimeter_values_.reinit(
              static_cast<Triangulation<dim, spacedim>::cell_iterator>(cell),
              face);
            for (const double ds : perimeter_values_.get_JxW_values())
              perimeter += ds;
            edge_.reinit(cell, face);
            for (unsigned int q = 0; q < n_points; ++q)
              {
                hinge_.reinit(edge_, 0, q, section_);
                const double weight =
                  std::sqrt(edge_.JxW(q) / hinge_.stiffness);
                for (unsigned int a = 0; a < hinge_.moment.size(); ++a)
                  for (unsigned int c = 0; c < spacedim; ++c)
                    moments(values_.dof(a, c), face * n_points + q) =
                      weight * hinge_.moment[a] * hinge_.t0[c];
              }
          }
        size       = area / perimeter;
        eigenvalue = largest_eigenvalue(moments);
      }

      double size       = 0.;
      double eigenvalue = 0.;

    private:
      /**
       * lambda_max of (M M^T, K) with M given and K the bending matrix of the
       * cell, as that of the small matrix M^T K^-1 M.
       */
      double
      largest_eigenvalue(const LAPACKFullMatrix<double> &moments)
      {
        const auto        &rows = values_.bending_rows();
        FullMatrix<double> stress_rows(rows.m(), rows.n());
        for (unsigned int q = 0; q < values_.n_points(); ++q)
          {
            const auto D =
              values_.JxW(q) *
              section_.stiffness(values_.frame(q), values_.point(q)).bending;
            for (unsigned int v = 0; v < 3; ++v)
              for (unsigned int w = 0; w < 3; ++w)
                for (unsigned int i = 0; i < rows.n(); ++i)
                  stress_rows(3 * q + v, i) += D[v][w] * rows(3 * q + w, i);
          }
        FullMatrix<double> bending(rows.n(), rows.n());
        rows.Tmmult(bending, stress_rows);

        // Displacements without bending strain have no moment either: a tiny
        // shift makes K regular and leaves the eigenvalues.
        const double shift = 1e-11 * bending.linfty_norm();
        for (unsigned int i = 0; i < bending.m(); ++i)
          bending(i, i) += shift;

        LAPACKFullMatrix<double> K(bending.m());
        K = bending;
        K.set_property(LAPACKSupport::symmetric);
        K.compute_cholesky_factorization();
        LAPACKFullMatrix<double> solution(moments);
        K.solve(solution);

        const unsigned int       n = moments.n();
        LAPACKFullMatrix<double> small(n);
        moments.Tmmult(small, solution);
        Vector<double>     values;
        FullMatrix<double> vectors;
        small.compute_eigenvalues_symmetric(0., 1e30, 0., values, vectors);
        return values.size() > 0 ? values[values.size() - 1] : 0.;
      }

      const SectionLaw &section_;
      ShellCellValues   values_;
      ShellEdgeValues   edge_;
      /** Lengths of curved edges, with a point more than the form's. */
      FE_Nothing<dim, spacedim>   fe_nothing_;
      FEFaceValues<dim, spacedim> perimeter_values_;
      HingeSide                   hinge_;
      const Discretization       &discretization_;
    };
  } // namespace

  EdgePenalty::EdgePenalty(const Discretization        &discretization,
                           const SectionLaw            &section,
                           const Quadrature<dim>       &quadrature,
                           const std::optional<double> &eta)
    : eta_(eta)
    , sizes_(discretization.triangulation().n_active_cells())
    , eigenvalues_(discretization.triangulation().n_active_cells())
  {
    run_on_all_ranks(discretization.communicator(), [&]() {
      CellBound cell_bound(discretization, section, quadrature);
      for (const auto &cell :
           discretization.dof_handler().active_cell_iterators())
        if (!cell->is_artificial())
          {
            cell_bound.reinit(cell);
            sizes_[cell->active_cell_index()]       = cell_bound.size;
            eigenvalues_[cell->active_cell_index()] = cell_bound.eigenvalue;
          }
    });

    for (const auto &cell :
         discretization.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto face : cell->face_indices())
          {
            const unsigned int k      = cell->active_cell_index();
            double             size   = sizes_[k];
            double             lambda = eigenvalues_[k];
            if (!cell->at_boundary(face) && cell->neighbor(face)->is_active())
              {
                const unsigned int n =
                  cell->neighbor(face)->active_cell_index();
                size   = std::min(size, sizes_[n]);
                lambda = std::max(lambda, eigenvalues_[n]);
              }
            bound_ = std::max(bound_, 0.5 * size * lambda);
          }
    bound_ = Utilities::MPI::max(bound_, discretization.communicator());
  }

  double
  EdgePenalty::interior(const cell_iterator &cell,
                        const cell_iterator &neighbor) const
  {
    const unsigned int k = cell->active_cell_index();
    const unsigned int n = neighbor->active_cell_index();
    if (eta_)
      return *eta_ / std::min(sizes_[k], sizes_[n]); // (15), (16)
    return std::max(eigenvalues_[k], eigenvalues_[n]);
  }

  double
  EdgePenalty::boundary(const cell_iterator &cell) const
  {
    const unsigned int k = cell->active_cell_index();
    return eta_ ? *eta_ / sizes_[k] : eigenvalues_[k];
  }
} // namespace Nacre
