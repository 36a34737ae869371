// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/simd.h>
#include <nacre/forms/cell_stiffness.h>
#include <nacre/forms/finite_cell_terms.h>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, spacedim>;

    /** Rows of a point in test_rows_ and trial_rows_. */
    constexpr unsigned int n_rows = 8;

    /** The three rows @p to += factor D times the three rows @p from. */
    NACRE_SIMD void
    add_stress_rows(const double *const D,
                    const double        factor,
                    const double *const from,
                    const unsigned int  n,
                    double *__restrict const to)
    {
      for (unsigned int v = 0; v < 3; ++v)
        {
          const double d_0 = factor * D[3 * v];
          const double d_1 = factor * D[3 * v + 1];
          const double d_2 = factor * D[3 * v + 2];
          for (unsigned int i = 0; i < n; ++i)
            to[v * n + i] +=
              d_0 * from[i] + d_1 * from[n + i] + d_2 * from[2 * n + i];
        }
    }
  } // namespace

  FiniteCellTerms::CellPoints::CellPoints(const Discretization  &discretization,
                                          const StrainMeasure    measure,
                                          const Quadrature<dim> &quadrature,
                                          const bool             tied,
                                          const bool             bends)
    : values(discretization, quadrature, tied)
    , cell(measure)
    , bends(bends)
  {}

  FiniteCellTerms::FiniteCellTerms(const Discretization &discretization,
                                   const SectionLaw     &section,
                                   const StrainMeasure   measure,
                                   const MembraneStrain  membrane_strain,
                                   const TangentType     tangent_type,
                                   SectionStates        *states)
    : section_(section)
    , is_stress_only_(tangent_type == TangentType::stress)
    , states_(states)
    , full_points_(discretization,
                   measure,
                   cell_quadrature(discretization.element(), membrane_strain),
                   membrane_strain == MembraneStrain::tied,
                   true)
  {
    full_points_.values.project_on_parts(membrane_strain !=
                                         MembraneStrain::full);
    if (blends_integration(discretization.element(), membrane_strain))
      reduced_points_.emplace(discretization,
                              measure,
                              discretization.element().reduced_quadrature(),
                              false,
                              false);
  }

  void
  FiniteCellTerms::add(const CellPart       &part,
                       const Vector<double> &u,
                       LocalTerms           &terms)
  {
    full_points_.values.reinit_frames(part);
    extract_nodes(full_points_.values, u, u_);
    add_terms(part, false, terms);
  }

  void
  FiniteCellTerms::add_step(const CellPart       &part,
                            const Vector<double> &u_start,
                            const Vector<double> &u_end,
                            LocalTerms           &terms)
  {
    Assert(full_points_.cell.measure() == StrainMeasure::green,
           ExcNotImplemented());
    full_points_.values.reinit_frames(part);
    extract_nodes(full_points_.values, u_start, ends_u_[0]);
    extract_nodes(full_points_.values, u_end, ends_u_[1]);
    add_terms(part, true, terms);
  }

  void
  FiniteCellTerms::evaluate(const CellPart &part,
                            CellPoints     &points,
                            const double    share,
                            const bool      in_step)
  {
    const auto &values = points.values;
    const auto  states = states_ != nullptr ? states_->of_cell(part, values) :
                                              SectionStates::Points();
    points.sections.clear();
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        points.sections.emplace_back(section_,
                                     values.frame(q),
                                     values.point(q),
                                     values.JxW(q),
                                     states[q]);
        auto &blocks = points.sections.back();
        blocks.A *= share;
        if (section_.has_initial_strain())
          {
            const double area = values.JxW(q);
            auto        &held = blocks.initial;
            held              = section_.initial_forces(values.frame(q),
                                           values.point(q),
                                           instant_);
            held.membrane_force *= share * area;
            held.membrane_energy *= share * area;
            held.moment *= area;
            held.bending_energy *= area;
          }
      }
    if (!in_step)
      {
        points.cell.reinit(values, points.sections, u_, points.bends);
        return;
      }
    for (unsigned int end = 0; end < 2; ++end)
      points.ends[end].reinit(values,
                              points.sections,
                              ends_u_[end],
                              points.bends);
    points.cell.take_means(values,
                           points.sections,
                           points.ends[0],
                           points.ends[1]);
  }

  void
  FiniteCellTerms::add_terms(const CellPart &part,
                             const bool      in_step,
                             LocalTerms     &terms)
  {
    const auto  &values = full_points_.values;
    const double share  = reduced_points_.has_value() ?
                            full_integration_share(values, section_) :
                            1.;
    force_.assign(values.shapes().n_nodes(), Vector3());
    const auto add_points = [&](CellPoints &points, const double factor) {
      evaluate(part, points, factor, in_step);
      points.cell.add_force(points.values, force_);
      if (!in_step)
        {
          terms.energies.membrane += points.cell.membrane_energy();
          terms.energies.bending += points.cell.bending_energy();
          if (section_.has_initial_strain() || !section_.is_linear())
            for (unsigned int q = 0; q < points.sections.size(); ++q)
              {
                const auto [E, kappa] = points.cell.strains(q);
                const auto energies =
                  points.sections[q].other_energies(E, kappa);
                terms.energies.membrane += energies[0];
                terms.energies.bending += points.bends ? energies[1] : 0.;
              }
        }
      if (terms.wants_tangent)
        add_tangent(points, terms);
    };
    add_points(full_points_, share);
    if (share < 1.)
      {
        reduced_points_->values.reinit_frames(part);
        add_points(*reduced_points_, 1. - share);
      }
    for (unsigned int a = 0; a < force_.size(); ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        terms.residual[values.dof(a, c)] += force_[a][c];
  }

  void
  FiniteCellTerms::add_tangent(const CellPoints &points, LocalTerms &terms)
  {
    const auto        &values = points.values;
    const unsigned int n      = values.n_dofs();
    test_rows_.reinit(n_rows * values.n_points(), n);
    trial_rows_.reinit(n_rows * values.n_points(), n);
    fill_membrane_rows(points);
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        if (points.bends)
          fill_bending_rows(points, q);
        if (!is_stress_only_)
          fill_stress_rows(points, q);
      }
    add_products(points, terms);
  }

  void
  FiniteCellTerms::fill_membrane_rows(const CellPoints &points)
  {
    const auto &values = points.values;
    membrane_tangent_.fill_rows(values.tying(),
                                values.tying_shapes(),
                                points.cell.membrane(),
                                [&values](const unsigned int a,
                                          const unsigned int c) {
                                  return values.dof(a, c);
                                });
    for (unsigned int q = 0; q < values.n_points(); ++q)
      for (unsigned int v = 0; v < 3; ++v)
        membrane_tangent_.add_strain_row(values.tying(),
                                         q,
                                         v,
                                         1.,
                                         &test_rows_(n_rows * q + v, 0));
  }

  void
  FiniteCellTerms::fill_bending_rows(const CellPoints  &points,
                                     const unsigned int q)
  {
    const auto        &values = points.values;
    const bool         varies = points.cell.measure() == StrainMeasure::green;
    const auto        &frame  = points.cell.deformed(q);
    const auto        &m      = points.cell.moment(q);
    const auto        &t      = frame.t0;
    const unsigned int n      = values.n_dofs();
    double *const      test   = &test_rows_(n_rows * q, 0);
    double *const      trial  = &trial_rows_(n_rows * q, 0);
    double             m_b    = 0.;
    for (unsigned int v = 0; v < 3; ++v)
      m_b += (v < 2 ? 1. : 2.) * m[v] * frame.b(v);
    for (unsigned int a = 0; a < values.shapes().n_nodes(); ++a)
      {
        const auto &dN = values.shapes().gradient(q, a);
        const auto  kappa =
          ShellStrain::bending_of_shape_function(frame,
                                                 dN,
                                                 values.shapes().hessian(q, a));
        // V = m^ab (N,ab - Gamma^g_ab N,g) and half of m : b
        const double  V         = -(m * kappa);
        const Vector3 dN_con[2] = {frame.metric_con[0] * t * dN[0] +
                                     frame.metric_con[2] * t * dN[1],
                                   frame.metric_con[2] * t * dN[0] +
                                     frame.metric_con[1] * t * dN[1]};
        for (unsigned int c = 0; c < spacedim; ++c)
          {
            const unsigned int i = values.dof(a, c);
            for (unsigned int v = 0; v < 3; ++v)
              test[(3 + v) * n + i] = kappa[v] * t[c];
            for (unsigned int g = 0; varies && g < 2; ++g)
              {
                test[(6 + g) * n + i] = dN[g] * t[c];
                trial[(6 + g) * n + i] =
                  V * frame.a_con[g][c] + 0.5 * m_b * dN_con[g][c];
              }
          }
      }
  }

  void
  FiniteCellTerms::fill_stress_rows(const CellPoints  &points,
                                    const unsigned int q)
  {
    const unsigned int   n       = points.values.n_dofs();
    const SectionBlocks &section = points.sections[q];
    const double *const  E       = &test_rows_(n_rows * q, 0);
    const double *const  kappa   = &test_rows_(n_rows * q + 3, 0);
    double *const        force   = &trial_rows_(n_rows * q, 0);
    double *const        moment  = &trial_rows_(n_rows * q + 3, 0);
    add_stress_rows(section.A.begin_raw(), 0.5, E, n, force);
    if (!points.bends)
      return;
    add_stress_rows(section.D.begin_raw(), 0.5, kappa, n, moment);
    if (!section.is_coupled)
      return;
    add_stress_rows(section.B.begin_raw(), 0.5, kappa, n, force);
    const VoigtMatrix<> B_transposed = transpose(section.B);
    add_stress_rows(B_transposed.begin_raw(), 0.5, E, n, moment);
  }

  void
  FiniteCellTerms::add_products(const CellPoints &points, LocalTerms &terms)
  {
    const unsigned int n = points.values.n_dofs();
    product_.reinit(n, n, true);
    test_rows_.Tmmult(product_, trial_rows_);
    for (unsigned int i = 0; i < n; ++i)
      {
        double *const row = &terms.tangent(i, 0);
        for (unsigned int j = 0; j < n; ++j)
          row[j] += product_(i, j) + product_(j, i);
      }
    if (points.cell.measure() == StrainMeasure::green)
      add_membrane_force_stiffness(points, terms);
  }

  void
  FiniteCellTerms::add_membrane_force_stiffness(const CellPoints &points,
                                                LocalTerms       &terms)
  {
    const auto &values = points.values;
    const auto &K = membrane_tangent_.force_stiffness(values.tying_shapes(),
                                                      points.cell.membrane());
    for (unsigned int a = 0; a < K.m(); ++a)
      for (unsigned int b = 0; b < K.n(); ++b)
        for (unsigned int c = 0; c < spacedim; ++c)
          terms.tangent(values.dof(a, c), values.dof(b, c)) += K(a, b);
  }
} // namespace Nacre
