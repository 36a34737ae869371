// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/part_quadrature.h>
#include <nacre/discretization/part_tying.h>
#include <nacre/discretization/shell_values.h>
#include <nacre/mechanics/shell_strain.h>

namespace Nacre
{
  ShellCellValues::Tables::Tables(const Discretization  &discretization,
                                  const Quadrature<dim> &quadrature,
                                  const MembraneTying   &tying,
                                  const bool             has_tying_points)
    : quadrature(quadrature)
    , tying(tying)
    , has_tying_points(has_tying_points)
    , shapes(discretization.scalar_fe(), quadrature.get_points())
    , tying_shapes(has_tying_points ?
                     ShapeTable(discretization.scalar_fe(), tying.points()) :
                     shapes)
    , geometry(
        discretization.geometry_fe() == discretization.scalar_fe() ?
          GeometryTable(shapes) :
          GeometryTable(discretization.geometry_fe(), quadrature.get_points()))
    , tying_geometry(
        has_tying_points ?
          GeometryTable(discretization.geometry_fe(), tying.points()) :
          geometry)
  {}

  ShellCellValues::ShellCellValues(const Discretization  &discretization,
                                   const Quadrature<dim> &quadrature,
                                   const bool             tied,
                                   const Points           points)
    : discretization_(discretization)
    , tied_(tied)
    , points_(points)
    , projects_(tied)
    , of_cell_(discretization,
               quadrature,
               tied ? MembraneTying(discretization.element(),
                                    quadrature.get_points()) :
                      MembraneTying::untied(quadrature.get_points()),
               tied)
  {
    resize();
  }

  void
  ShellCellValues::resize()
  {
    const Tables      &of      = tables();
    const unsigned int n       = of.quadrature.size();
    const bool         samples = of.has_tying_points || is_cut();
    frames_.resize(n);
    tying_frames_.resize(of.has_tying_points ? of.tying.points().size() : 0);
    membrane_rows_.reinit(3 * n, n_dofs(), true);
    bending_rows_.reinit(3 * n, n_dofs(), true);
    tying_rows_.reinit(samples ? of.tying.samples().size() : 0, n_dofs(), true);
  }

  void
  ShellCellValues::set_tables(const CellPart &part)
  {
    const bool                  was_cut    = is_cut();
    const PartEnrichment *const enrichment = enrichment_of(part);
    n_functions_ = enrichment != nullptr ? enrichment->n_functions() : 0;
    n_tip_functions_ =
      enrichment != nullptr && !enrichment->has_scalars() ? n_functions_ : 0;
    if (enrichment != nullptr)
      {
        // Strains of tip functions are singular: neither tied nor projected,
        // nor are those of the nodes, which balance them.
        const auto targets =
          points_ == Points::rule ?
            enriched_quadrature(part, discretization_.degree()) :
            of_cell_.quadrature;
        of_part_.emplace(discretization_,
                         targets,
                         MembraneTying::untied(targets.get_points()),
                         false);
      }
    else if (part.is_cut())
      {
        const Quadrature<dim> rule =
          part_quadrature(part.polygon(), discretization_.degree());
        const bool  integrates = points_ == Points::rule;
        const auto &targets    = integrates ? rule : of_cell_.quadrature;
        of_part_.emplace(
          discretization_,
          targets,
          projects_ ?
            part_tying(discretization_, part, rule, targets.get_points()) :
            MembraneTying::untied(targets.get_points()),
          projects_ && !integrates);
      }
    else
      of_part_.reset();
    if (was_cut || is_cut())
      resize();
  }

  void
  ShellCellValues::evaluate(const CellPart &part)
  {
    if (is_cut() || part.is_cut() || enrichment_of(part) != nullptr)
      set_tables(part);
    const auto nodes = discretization_.geometry_nodes(part);
    material_id_     = part.cell->material_id();
    tables().geometry.evaluate(nodes, geometry_);
    for (unsigned int q = 0; q < n_points(); ++q)
      frames_[q] = geometry_.frame(q);
    if (tables().has_tying_points)
      tables().tying_geometry.evaluate(nodes, tying_geometry_);
    if (const auto *const enrichment = enrichment_of(part))
      evaluate_tip_functions(*enrichment);
  }

  void
  ShellCellValues::evaluate_tip_functions(const PartEnrichment &enrichment)
  {
    tip_functions_.clear();
    for (unsigned int q = 0; q < n_points(); ++q)
      enrichment.evaluate(shapes(),
                          geometry_,
                          q,
                          quadrature().point(q),
                          tip_functions_,
                          lip_);
    if (!enrichment.has_scalars())
      return;
    of_part_->shapes.append_functions(tip_functions_);
    of_part_->tying_shapes = of_part_->shapes;
  }

  void
  ShellCellValues::reinit_frames(const CellPart &part)
  {
    evaluate(part);
    for (unsigned int k = 0; k < tying_frames_.size(); ++k)
      tying_frames_[k] = make_surface_frame(tying_geometry_.tangent(k, 0),
                                            tying_geometry_.tangent(k, 1),
                                            {});
  }

  void
  ShellCellValues::reinit(const CellPart &part)
  {
    evaluate(part);
    for (unsigned int k = 0; k < tying_frames_.size(); ++k)
      for (unsigned int alpha = 0; alpha < dim; ++alpha)
        tying_frames_[k].a_cov[alpha] = tying_geometry_.tangent(k, alpha);
    if (n_functions_ == 0 && (tied_ || (is_cut() && projects_)))
      fill_tied_membrane_rows();
    else
      fill_membrane_rows();
    fill_bending_rows();
  }

  void
  ShellCellValues::fill_membrane_rows()
  {
    const ShapeTable &shapes = this->shapes();
    for (unsigned int q = 0; q < n_points(); ++q)
      {
        const auto &a_cov  = frames_[q].a_cov;
        double     *row[3] = {&membrane_rows_(3 * q, 0),
                              &membrane_rows_(3 * q + 1, 0),
                              &membrane_rows_(3 * q + 2, 0)};
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          {
            const auto &dN = shapes.gradient(q, a);
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                const unsigned int i = dof(a, c);
                row[0][i]            = a_cov[0][c] * dN[0];
                row[1][i]            = a_cov[1][c] * dN[1];
                row[2][i] = a_cov[0][c] * dN[1] + a_cov[1][c] * dN[0];
              }
          }
        for (unsigned int k = 0; k < n_tip_functions_; ++k)
          {
            const auto &psi = tip_function(q, k);
            const auto  strain =
              ShellStrain::membrane(frames_[q], psi.first[0], psi.first[1]);
            for (unsigned int v = 0; v < 3; ++v)
              row[v][tip_dof(k)] = strain[v];
          }
      }
  }

  void
  ShellCellValues::fill_tied_membrane_rows()
  {
    const MembraneTying      &tying  = this->tying();
    const ShapeTable         &shapes = tying_shapes();
    const unsigned int *const dofs   = discretization_.node_dofs().data();
    for (unsigned int k = 0; k < tying_rows_.m(); ++k)
      {
        const auto &[point, direction] = tying.samples()[k];
        const auto &[a_1, a_2]         = tying_frame(point).a_cov;
        double *const row              = &tying_rows_(k, 0);
        // direction . (a_1 N,1, a_2 N,2, a_1 N,2 + a_2 N,1), (3)
        const auto g_1 = direction[0] * a_1 + direction[2] * a_2;
        const auto g_2 = direction[2] * a_1 + direction[1] * a_2;
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          {
            const auto &dN = shapes.gradient(point, a);
            for (unsigned int c = 0; c < spacedim; ++c)
              row[dofs[spacedim * a + c]] = dN[0] * g_1[c] + dN[1] * g_2[c];
          }
      }
    tying.sum_rows(tying_rows_);
    for (unsigned int q = 0; q < n_points(); ++q)
      for (unsigned int v = 0; v < 3; ++v)
        combine(tying_rows_,
                tying.weights(q, v),
                &membrane_rows_(3 * q + v, 0));
  }

  void
  ShellCellValues::fill_bending_rows()
  {
    const ShapeTable &shapes = this->shapes();
    for (unsigned int q = 0; q < n_points(); ++q)
      {
        const auto &t0     = frames_[q].t0;
        double     *row[3] = {&bending_rows_(3 * q, 0),
                              &bending_rows_(3 * q + 1, 0),
                              &bending_rows_(3 * q + 2, 0)};
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          {
            const auto strain =
              ShellStrain::bending_of_shape_function(frames_[q],
                                                     shapes.gradient(q, a),
                                                     shapes.hessian(q, a));
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                const unsigned int i = dof(a, c);
                for (unsigned int v = 0; v < 3; ++v)
                  row[v][i] = strain[v] * t0[c];
              }
          }
        for (unsigned int k = 0; k < n_tip_functions_; ++k)
          {
            const auto &psi = tip_function(q, k);
            const auto  strain =
              ShellStrain::bending(frames_[q], psi.first, psi.second);
            for (unsigned int v = 0; v < 3; ++v)
              row[v][tip_dof(k)] = strain[v];
          }
      }
  }
} // namespace Nacre
