// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/forms/cell_stiffness.h>
#include <nacre/forms/edge_penalty.h>
#include <nacre/forms/rotation_jump.h>

#include <deal.II/base/qprojector.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/lac/lapack_templates.h>

#include <sstream>

namespace Nacre
{
  namespace
  {
    /** Lengths of the edges of a cell, with a point more than the form's. */
    class Perimeter
    {
    public:
      explicit Perimeter(const Discretization &discretization)
        : quadrature_(discretization.degree() + 2)
      {
        const auto cell = discretization.element().reference_cell();
        for (const auto face : cell.face_indices())
          {
            std::vector<Point<dim>> points(quadrature_.size());
            QProjector<dim>::project_to_face(cell, quadrature_, face, points);
            tables_.emplace_back(discretization.geometry_fe(), points);
            directions_.push_back(
              cell.vertex<dim>(cell.face_to_cell_vertices(face, 1, 1)) -
              cell.vertex<dim>(cell.face_to_cell_vertices(face, 0, 1)));
          }
      }

      double
      length(const ArrayView<const Point<spacedim>> &nodes)
      {
        double sum = 0.;
        for (unsigned int face = 0; face < tables_.size(); ++face)
          {
            tables_[face].evaluate(nodes, values_);
            for (unsigned int q = 0; q < quadrature_.size(); ++q)
              sum += quadrature_.weight(q) *
                     (directions_[face][0] * values_.tangent(q, 0) +
                      directions_[face][1] * values_.tangent(q, 1))
                       .norm();
          }
        return sum;
      }

    private:
      const QGauss<1>             quadrature_;
      std::vector<GeometryTable>  tables_;
      std::vector<Tensor<1, dim>> directions_;
      GeometryTable::Values       values_;
    };

    /** |A| / |dA| and lambda_K of one cell after another. */
    class CellBound
    {
    public:
      CellBound(const Discretization  &discretization,
                const SectionLaw      &section,
                const Quadrature<dim> &quadrature)
        : section_(section)
        , values_(discretization, quadrature, section.is_coupled())
        , edge_(discretization)
        , perimeter_(discretization)
        , discretization_(discretization)
      {}

      void
      reinit(const CellPart &part)
      {
        values_.reinit(part);
        double area = 0.;
        for (unsigned int q = 0; q < values_.n_points(); ++q)
          area += values_.JxW(q);
        // (16) has whole cells; for parts, this is their size, too.
        size = area / perimeter_.length(discretization_.geometry_nodes(part));

        std::vector<EdgePiece> pieces;
        for (const auto face : part.cell->face_indices())
          for (const auto &piece :
               discretization_.cell_parts().pieces_of(part, face))
            pieces.push_back(piece);
        // Rows m_nn sqrt(ds / D) on all edges, in local dofs.
        const unsigned int n_dofs = values_.n_dofs();
        moments_.clear();
        for (const EdgePiece &piece : pieces)
          {
            if (part.is_cut())
              edge_.reinit(piece);
            else
              edge_.reinit(part.cell, piece.sides[0].face);
            for (unsigned int q = 0; q < edge_.n_points(); ++q)
              {
                moments_.resize(moments_.size() + n_dofs);
                add_moment(q, moments_.data() + moments_.size() - n_dofs);
              }
          }
        eigenvalue = pieces.empty() ? 0. : largest_eigenvalue();
      }

      double size       = 0.;
      double eigenvalue = 0.;

    private:
      /** Set the row of the point @p q of edge_. */
      void
      add_moment(const unsigned int q, double *const row)
      {
        side_.reinit(edge_, 0, q, section_);
        const double weight = std::sqrt(edge_.JxW(q) / side_.stiffness);
        for (unsigned int a = 0; a < side_.moment.size(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            {
              double &entry = row[values_.dof(a, c)];
              entry         = weight * side_.moment[a] * side_.t0[c];
              if (!side_.membrane_moment.empty())
                entry += weight * side_.membrane_moment[a][c];
            }
        for (unsigned int k = 0; k < side_.tip_moment.size(); ++k)
          row[values_.tip_dof(k)] = weight * side_.tip_moment[k];
      }

      /** Set energy_ to K, the matrix of the second form of the pair. */
      void
      fill_energy()
      {
        stiffness_.reinit(values_, section_, 1.);
        const auto &rho = values_.bending_rows();
        energy_.reinit(rho.n(), rho.n(), true);
        add_rows(stiffness_.bending, rho, rho, false);
        if (section_.is_coupled())
          {
            const auto &eps = values_.membrane_rows();
            add_rows(stiffness_.membrane, eps, eps, true);
            add_rows(stiffness_.coupling, eps, rho, true);
            stress_rows_.Tmmult(energy_, eps, true);
          }

        // Displacements without strain have no moment either: a tiny shift
        // makes K regular and leaves the eigenvalues.
        const double shift = 1e-11 * energy_.linfty_norm();
        for (unsigned int i = 0; i < energy_.m(); ++i)
          energy_(i, i) += shift;
      }

      /** K = test^T H trial, or K += that; stress_rows_ is H trial. */
      void
      add_rows(const std::vector<VoigtMatrix<>> &H,
               const FullMatrix<double>         &test,
               const FullMatrix<double>         &trial,
               const bool                        add)
      {
        stress_rows_.reinit(trial.m(), trial.n(), true);
        for (unsigned int q = 0; q < values_.n_points(); ++q)
          multiply_voigt_rows(H[q],
                              &trial(3 * q, 0),
                              trial.n(),
                              &stress_rows_(3 * q, 0));
        test.Tmmult(energy_, stress_rows_, add);
      }

      /**
       * lambda_max of (M^T M, K), M the rows of moments_, as that of the
       * smaller of Y^T Y and Y Y^T, Y = L^-1 M^T, K = L L^T.
       */
      double
      largest_eigenvalue()
      {
        fill_energy();
        // LAPACK's matrices are the transposes of ours.
        const types::blas_int n   = energy_.m();
        const types::blas_int m   = moments_.size() / n;
        const double          one = 1., zero = 0.;
        types::blas_int       info = 0;
        potrf("L", &n, &energy_(0, 0), &n, &info);
        check(info);
        trtrs("L",
              "N",
              "N",
              &n,
              &m,
              &energy_(0, 0),
              &n,
              moments_.data(),
              &n,
              &info);
        check(info);
        const types::blas_int size = std::min(m, n);
        small_.reinit(size, size, true);
        syrk("L",
             m <= n ? "T" : "N",
             &size,
             m <= n ? &n : &m,
             &one,
             moments_.data(),
             &n,
             &zero,
             &small_(0, 0),
             &size);
        eigenvalues_.resize(size);
        work_.resize(64 * size);
        const types::blas_int n_work = work_.size();
        syev("N",
             "L",
             &size,
             &small_(0, 0),
             &size,
             eigenvalues_.data(),
             work_.data(),
             &n_work,
             &info);
        check(info);
        return eigenvalues_.back();
      }

      /** Throw what makes LAPACK end with @p info, if that isn't 0. */
      void
      check(const types::blas_int info) const
      {
        if (info == 0)
          return;
        std::ostringstream text;
        text << "Section: the bending stiffness of the cell at ("
             << values_.point(0)
             << ") is too large or too small to reckon with. Check the units "
                "of thickness and stiffness, and the shape of the cell.";
        AssertThrow(false, ExcMessage(text.str()));
      }

      const SectionLaw     &section_;
      ShellCellValues       values_;
      ShellEdgeValues       edge_;
      Perimeter             perimeter_;
      JumpSide              side_;
      const Discretization &discretization_;
      std::vector<double>   moments_; // by rows
      CellStiffness         stiffness_;
      FullMatrix<double>    stress_rows_;
      FullMatrix<double>    energy_;
      FullMatrix<double>    small_;
      std::vector<double>   eigenvalues_;
      std::vector<double>   work_;
    };
  } // namespace

  EdgePenalty::EdgePenalty(const Discretization        &discretization,
                           const SectionLaw            &section,
                           const Quadrature<dim>       &quadrature,
                           const std::optional<double> &eta)
    : eta_(eta)
    , sizes_(discretization.n_part_indices())
    , eigenvalues_(discretization.n_part_indices())
  {
    run_on_all_ranks(discretization.communicator(), [&]() {
      CellBound cell_bound(discretization, section, quadrature);
      for (const CellPart &part : discretization.relevant_parts())
        {
          cell_bound.reinit(part);
          sizes_[part.index()]       = cell_bound.size;
          eigenvalues_[part.index()] = cell_bound.eigenvalue;
        }
    });

    const CellParts &parts = discretization.cell_parts();
    for (const CellPart &part : discretization.owned_parts())
      for (const auto face : part.cell->face_indices())
        {
          const auto &cell   = part.cell;
          double      size   = sizes_[part.index()];
          double      lambda = eigenvalues_[part.index()];
          if (!cell->at_boundary(face) && cell->neighbor(face)->is_active())
            {
              const CellPart::Cell neighbor = cell->neighbor(face);
              for (unsigned int k = 0; k < parts.n_parts(neighbor); ++k)
                {
                  const unsigned int n = parts.part(neighbor, k).index();
                  size                 = std::min(size, sizes_[n]);
                  lambda               = std::max(lambda, eigenvalues_[n]);
                }
            }
          bound_ = std::max(bound_, 0.5 * size * lambda);
        }
    bound_ = Utilities::MPI::max(bound_, discretization.communicator());
  }

  double
  EdgePenalty::interior(const CellPart &part, const CellPart &neighbor) const
  {
    const unsigned int k = part.index();
    const unsigned int n = neighbor.index();
    if (eta_)
      return *eta_ / std::min(sizes_[k], sizes_[n]); // (15), (16)
    return std::max(eigenvalues_[k], eigenvalues_[n]);
  }

  double
  EdgePenalty::boundary(const CellPart &part) const
  {
    const unsigned int k = part.index();
    return eta_ ? *eta_ / sizes_[k] : eigenvalues_[k];
  }
} // namespace Nacre
