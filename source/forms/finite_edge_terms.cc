// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/finite_edge_terms.h>

#include <cmath>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, spacedim>;
  } // namespace

  FiniteEdgeTerms::FiniteEdgeTerms(const SectionLaw   &section,
                                   const StrainMeasure measure,
                                   const TangentType   tangent_type,
                                   SectionStates      *states)
    : section_(section)
    , measure_(measure)
    , limits_gap_(tangent_type == TangentType::symmetric)
    , is_stress_only_(tangent_type == TangentType::stress)
    , states_(states)
    , point_(measure)
    , membrane_{
        {TiedGreenStrain<double>(measure), TiedGreenStrain<double>(measure)}}
  {}

  void
  FiniteEdgeTerms::add(const ShellEdgeValues                 &edge,
                       const double                           penalty,
                       const std::vector<PrescribedRotation> &rotation,
                       const Vector<double>                  &u,
                       LocalTerms                            &terms)
  {
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      extract_nodes(edge, s, u, u_[s]);
    point_.set_states(SectionStates::of_edge(states_, edge));
    evaluate_membrane(edge);
    if (terms.wants_tangent)
      reinit_rows(edge);
    for (unsigned int q = 0; q < edge.n_points(); ++q)
      {
        point_.reinit(edge,
                      q,
                      section_,
                      penalty,
                      rotation[q],
                      u_,
                      strains_or_none(membrane_));
        terms.energies.edge += point_.energy();
        for (unsigned int s = 0; s < edge.n_sides(); ++s)
          {
            force_.assign(u_[s].size(), Vector3());
            point_.add_force(s, force_);
            add_residual(edge, s, terms);
            if (section_.is_coupled())
              membrane_[s].add_point_force(edge.tying(s),
                                           q,
                                           point_.membrane_force(s));
          }
        if (terms.wants_tangent)
          fill_rows(edge, q);
      }
    add_membrane_residual(edge, terms);
    if (terms.wants_tangent)
      add_tangent(edge, terms);
  }

  void
  FiniteEdgeTerms::add_step(
    const ShellEdgeValues                                        &edge,
    const double                                                  penalty,
    const std::array<const std::vector<PrescribedRotation> *, 2> &rotations,
    const std::array<const Vector<double> *, 2>                  &u,
    LocalTerms                                                   &terms)
  {
    Assert(measure_ == StrainMeasure::green, ExcNotImplemented());
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      {
        for (unsigned int end = 0; end < 2; ++end)
          extract_nodes(edge, s, *u[end], ends_u_[end][s]);
        u_[s].resize(ends_u_[0][s].size());
        for (unsigned int a = 0; a < u_[s].size(); ++a)
          u_[s][a] = 0.5 * (ends_u_[0][s][a] + ends_u_[1][s][a]);
        if (section_.is_coupled())
          for (unsigned int end = 0; end < 2; ++end)
            ends_membrane_[end][s].reinit(EdgeSideTying(edge, s),
                                          ends_u_[end][s]);
      }
    evaluate_membrane(edge);
    if (terms.wants_tangent)
      reinit_rows(edge);
    auto &[start, end] = ends_point_;
    for (unsigned int q = 0; q < edge.n_points(); ++q)
      {
        const std::array<PrescribedRotation, 2> rotation = {
          {(*rotations[0])[q], (*rotations[1])[q]}};
        for (unsigned int k = 0; k < 2; ++k)
          ends_point_[k].reinit(edge,
                                q,
                                section_,
                                penalty,
                                rotation[k],
                                ends_u_[k],
                                strains_or_none(ends_membrane_[k]));
        step_.reinit(edge, q, start, end, rotation);
        terms.rotation_work += step_.rotation_work();
        for (unsigned int s = 0; s < edge.n_sides(); ++s)
          {
            force_.assign(u_[s].size(), Vector3());
            step_.add_force(edge, q, s, force_);
            add_residual(edge, s, terms);
            if (section_.is_coupled())
              membrane_[s].add_point_force(edge.tying(s),
                                           q,
                                           step_.membrane_force(s));
          }
        if (!terms.wants_tangent)
          continue;
        point_.reinit(edge,
                      q,
                      section_,
                      penalty,
                      mean_rotation(rotation[0], rotation[1]),
                      u_,
                      strains_or_none(membrane_));
        point_.take_means(start, end);
        fill_rows(edge, q);
      }
    add_membrane_residual(edge, terms);
    if (terms.wants_tangent)
      add_tangent(edge, terms);
  }

  void
  FiniteEdgeTerms::add_tangent(const ShellEdgeValues &edge, LocalTerms &terms)
  {
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      {
        if (measure_ == StrainMeasure::linear)
          continue;
        add_side_tangent(edge, s, terms);
        if (section_.is_coupled())
          add_membrane_tangent(edge, s, terms);
      }
    add_jump_tangent(terms);
  }

  double
  FiniteEdgeTerms::rotation_gap(const ShellEdgeValues    &edge,
                                const unsigned int        q,
                                const PrescribedRotation &rotation,
                                const Vector<double>     &u)
  {
    if (measure_ == StrainMeasure::linear)
      return 0.;
    extract_nodes(edge, 0, u, u_[0]);
    point_.set_states({});
    point_.reinit(edge, q, section_, 1., rotation, u_);
    return std::abs(point_.jump());
  }

  void
  FiniteEdgeTerms::reinit_rows(const ShellEdgeValues &edge)
  {
    const unsigned int n_points = edge.n_points();
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      {
        const unsigned int n = edge.shapes(s).n_nodes();
        side_rows_[s].reinit(3 * n_points, n, true);
        side_derivative_rows_[s].reinit(3 * n_points,
                                        spacedim * spacedim * n,
                                        true);
      }
    const bool         is_coupled = section_.is_coupled();
    const unsigned int n_rows =
      n_points * (is_coupled ? 1 + edge.n_sides() : 1);
    jump_rows_.reinit(n_rows, edge.n_dofs());
    trial_rows_.reinit(n_rows, edge.n_dofs());
    if (!is_coupled)
      return;
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      membrane_tangents_[s].fill_rows(edge.tying(s),
                                      edge.tying_shapes(s),
                                      membrane_[s],
                                      [](const unsigned int a,
                                         const unsigned int c) {
                                        return spacedim * a + c;
                                      });
  }

  void
  FiniteEdgeTerms::evaluate_membrane(const ShellEdgeValues &edge)
  {
    if (section_.is_coupled())
      for (unsigned int s = 0; s < edge.n_sides(); ++s)
        membrane_[s].reinit(EdgeSideTying(edge, s), u_[s]);
  }

  void
  FiniteEdgeTerms::add_membrane_residual(const ShellEdgeValues &edge,
                                         LocalTerms            &terms)
  {
    if (!section_.is_coupled())
      return;
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      {
        membrane_[s].set_resultants(edge.tying(s));
        force_.assign(u_[s].size(), Vector3());
        membrane_[s].add_force(edge.tying_shapes(s), force_);
        add_residual(edge, s, terms);
      }
  }

  void
  FiniteEdgeTerms::add_membrane_rows(const ShellEdgeValues &edge,
                                     const unsigned int     side,
                                     const unsigned int     q)
  {
    const auto        &point   = point_.side(side);
    const unsigned int n_nodes = edge.shapes(side).n_nodes();
    membrane_row_.assign(spacedim * n_nodes, 0.);
    for (unsigned int v = 0; v < 3; ++v)
      membrane_tangents_[side].add_strain_row(edge.tying(side),
                                              q,
                                              v,
                                              point.coupling[v],
                                              membrane_row_.data());
    // d{lambda m_nn}, and dlambda = lambda nu . v_n
    const double mean =
      is_stress_only_ ? 0. : point_.fluxes().consistency * point.mean_factor;
    const double       g   = point_.moment_force(side) * point.lambda;
    const unsigned int row = edge.n_points() * (1 + side) + q;
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        {
          const unsigned int i = edge.dof(side, a, c);
          const double       M = membrane_row_[spacedim * a + c];
          trial_rows_(q, i) += mean * point.lambda * M;
          if (measure_ == StrainMeasure::linear)
            continue;
          jump_rows_(row, i)  = point.rows[1][a] * point.conormal[c];
          trial_rows_(row, i) = g * M;
        }
  }

  void
  FiniteEdgeTerms::add_membrane_tangent(const ShellEdgeValues &edge,
                                        const unsigned int     side,
                                        LocalTerms            &terms)
  {
    const auto &K =
      membrane_tangents_[side].force_stiffness(edge.tying_shapes(side),
                                               membrane_[side]);
    for (unsigned int a = 0; a < K.m(); ++a)
      for (unsigned int b = 0; b < K.n(); ++b)
        for (unsigned int c = 0; c < spacedim; ++c)
          terms.tangent(edge.dof(side, a, c), edge.dof(side, b, c)) += K(a, b);
  }

  void
  FiniteEdgeTerms::add_residual(const ShellEdgeValues &edge,
                                const unsigned int     s,
                                LocalTerms            &terms) const
  {
    for (unsigned int a = 0; a < force_.size(); ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        terms.residual[edge.dof(s, a, c)] += force_[a][c];
  }

  void
  FiniteEdgeTerms::fill_rows(const ShellEdgeValues &edge, const unsigned int q)
  {
    const auto &fluxes = point_.fluxes();
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      {
        const auto            &rows    = point_.side(s).rows;
        const auto             K       = point_.hessian(s, limits_gap_);
        const auto             jump    = point_.jump_gradient(s);
        const auto             moment  = point_.moment_gradient(s);
        const double           mean    = point_.side(s).mean_factor;
        const unsigned int     n_nodes = rows[0].size();
        std::array<Vector3, 3> trial;
        for (unsigned int k = 0; k < 3 && !is_stress_only_; ++k)
          trial[k] = 0.5 * fluxes.penalty * jump[k] +
                     fluxes.consistency * mean * moment[k];
        for (unsigned int b = 0; b < n_nodes; ++b)
          {
            const double R[3] = {rows[0][b], rows[1][b], rows[2][b]};
            for (unsigned int d = 0; d < spacedim; ++d)
              {
                const unsigned int j = edge.dof(s, b, d);
                for (unsigned int k = 0; k < 3; ++k)
                  {
                    jump_rows_(q, j) += R[k] * jump[k][d];
                    trial_rows_(q, j) += R[k] * trial[k][d];
                  }
              }
            for (unsigned int k = 0; k < 3; ++k)
              {
                side_rows_[s](3 * q + k, b) = R[k];
                double *const row = &side_derivative_rows_[s](3 * q + k, 0);
                for (unsigned int c = 0; c < spacedim; ++c)
                  for (unsigned int d = 0; d < spacedim; ++d)
                    row[spacedim * (c * n_nodes + b) + d] =
                      K[k][0][c][d] * R[0] + K[k][1][c][d] * R[1] +
                      (k < 2 ? K[k][2][c][d] * R[2] : 0.);
              }
          }
        if (section_.is_coupled())
          add_membrane_rows(edge, s, q);
      }
  }

  void
  FiniteEdgeTerms::add_side_tangent(const ShellEdgeValues &edge,
                                    const unsigned int     side,
                                    LocalTerms            &terms)
  {
    const unsigned int n_nodes = edge.shapes(side).n_nodes();
    product_.reinit(n_nodes, spacedim * spacedim * n_nodes, true);
    side_rows_[side].Tmmult(product_, side_derivative_rows_[side]);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        {
          const double *entry = &product_(a, spacedim * c * n_nodes);
          double *const row   = &terms.tangent(edge.dof(side, a, c), 0);
          for (unsigned int b = 0; b < n_nodes; ++b)
            for (unsigned int d = 0; d < spacedim; ++d)
              row[edge.dof(side, b, d)] += *entry++;
        }
  }

  void
  FiniteEdgeTerms::add_jump_tangent(LocalTerms &terms)
  {
    const unsigned int n = jump_rows_.n();
    product_.reinit(n, n, true);
    jump_rows_.Tmmult(product_, trial_rows_);
    for (unsigned int i = 0; i < n; ++i)
      {
        double *const row = &terms.tangent(i, 0);
        for (unsigned int j = 0; j < n; ++j)
          row[j] += product_(i, j) + product_(j, i);
      }
  }

  void
  FiniteEdgeTerms::add_moment(const ShellEdgeValues     &edge,
                              const std::vector<double> &moment,
                              const Vector<double>      &u,
                              LocalTerms                &terms)
  {
    const auto             &shapes = edge.shapes(0);
    FollowingMoment<double> load;
    const bool              follows = measure_ == StrainMeasure::green;
    extract_nodes(edge, 0, follows ? u : Vector<double>(), u_[0]);
    force_.assign(shapes.n_nodes(), Vector3());
    for (unsigned int q = 0; q < edge.n_points(); ++q)
      {
        load.reinit(edge, q, moment[q], u_[0]);
        load.add_force(edge, q, force_);
        if (!terms.wants_tangent || !follows)
          continue;
        const auto X = load.derivative();
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          for (unsigned int b = 0; b < shapes.n_nodes(); ++b)
            {
              const auto         &dN_a = shapes.gradient(q, a);
              const auto         &dN_b = shapes.gradient(q, b);
              Tensor<2, spacedim> K;
              for (unsigned int alpha = 0; alpha < 2; ++alpha)
                for (unsigned int g = 0; g < 2; ++g)
                  K += (dN_a[alpha] * dN_b[g]) * X[alpha][g];
              for (unsigned int c = 0; c < spacedim; ++c)
                for (unsigned int d = 0; d < spacedim; ++d)
                  terms.tangent(edge.dof(0, a, c), edge.dof(0, b, d)) +=
                    K[c][d];
            }
      }
    add_residual(edge, 0, terms);
  }
} // namespace Nacre
