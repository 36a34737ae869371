// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/simd.h>
#include <nacre/forms/corotational_kinematics.h>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, spacedim>;

  } // namespace

  FullMatrix<double>
  membrane_stiffness(const ShellCellValues            &values,
                     const std::vector<VoigtMatrix<>> &stiffness)
  {
    const auto         &tying = values.tying();
    const unsigned int  n     = tying.n_coefficients();
    FullMatrix<double>  M(n);
    std::vector<double> force(n);
    for (unsigned int q = 0; q < stiffness.size(); ++q)
      for (unsigned int v = 0; v < 3; ++v)
        {
          std::fill(force.begin(), force.end(), 0.);
          for (unsigned int w = 0; w < 3; ++w)
            for (const auto &[s, weight] : tying.weights(q, w))
              force[s] += stiffness[q][v][w] * weight;
          for (const auto &[r, weight] : tying.weights(q, v))
            add_scaled(n, weight, force.data(), &M(r, 0));
        }
    return M;
  }

  CorotationalKinematics::CellPoints::CellPoints(
    const Discretization  &discretization,
    const Quadrature<dim> &quadrature,
    const bool             tied)
    : values(discretization, quadrature, tied)
  {
    number_membrane_rows();
  }

  void
  CorotationalKinematics::CellPoints::number_membrane_rows()
  {
    const auto &tying = values.tying();
    n_membrane_rows   = 0;
    membrane_rows.assign(2 * tying.points().size(),
                         numbers::invalid_unsigned_int);
    for (const auto &sample : tying.samples())
      for (unsigned int alpha = 0; alpha < 2; ++alpha)
        {
          unsigned int &row = membrane_rows[2 * sample.point + alpha];
          if ((sample.direction[alpha] != 0. || sample.direction[2] != 0.) &&
              row == numbers::invalid_unsigned_int)
            row = n_membrane_rows++;
        }
  }

  CorotationalKinematics::CorotationalKinematics(
    const Discretization &discretization,
    const SectionLaw     &section,
    const MembraneStrain  membrane_strain,
    const TangentType     tangent_type)
    : discretization_(discretization)
    , section_(section)
    , membrane_strain_(membrane_strain)
    , tangent_type_(tangent_type)
    , full_points_(discretization,
                   cell_quadrature(discretization.element(), membrane_strain),
                   membrane_strain == MembraneStrain::tied)
  {
    full_points_.values.project_on_parts(membrane_strain !=
                                         MembraneStrain::full);
    if (blends_integration(discretization.element(), membrane_strain))
      reduced_points_.emplace(discretization,
                              discretization.element().reduced_quadrature(),
                              false);
  }

  std::unique_ptr<Kinematics>
  CorotationalKinematics::clone() const
  {
    return std::make_unique<CorotationalKinematics>(*this);
  }

  void
  CorotationalKinematics::add_cell_terms(const CellPart       &part,
                                         const Vector<double> &u,
                                         LocalTerms           &terms)
  {
    in_step_ = false;
    reinit_frames(part);
    extract_nodes(full_points_.values, u, u_);
    add_cell(part, terms);
  }

  void
  CorotationalKinematics::add_cell_step_terms(const CellPart       &part,
                                              const Vector<double> &u_start,
                                              const Vector<double> &u_end,
                                              LocalTerms           &terms)
  {
    in_step_ = true;
    reinit_frames(part);
    extract_nodes(full_points_.values, u_start, ends_u_[0]);
    extract_nodes(full_points_.values, u_end, ends_u_[1]);
    u_.resize(ends_u_[0].size());
    for (unsigned int a = 0; a < u_.size(); ++a)
      u_[a] = 0.5 * (ends_u_[0][a] + ends_u_[1][a]);
    add_cell(part, terms);
  }

  void
  CorotationalKinematics::reinit_frames(const CellPart &part)
  {
    ShellCellValues &values  = full_points_.values;
    const bool       was_cut = values.is_cut();
    values.reinit_frames(part);
    if (values.is_cut() || was_cut)
      full_points_.number_membrane_rows();
  }

  void
  CorotationalKinematics::add_cell(const CellPart &part, LocalTerms &terms)
  {
    const ShellCellValues &values = full_points_.values;
    const double           share  = reduced_points_.has_value() ?
                                      full_integration_share(values, section_) :
                                      1.;
    const bool             both   = share < 1.;
    full_points_.stiffness.reinit(values, section_, share);
    full_points_.held = held_forces(values, section_, {{share, 1.}}, instant_);
    force_.assign(u_.size(), Vector3());

    const unsigned int n_full    = full_points_.n_membrane_rows;
    const unsigned int n_bending = 3 * values.n_points();
    const unsigned int n_rows =
      n_full + n_bending + (both ? reduced_points_->n_membrane_rows : 0);
    if (terms.wants_tangent)
      {
        shape_rows_.reinit(n_rows, u_.size(), true);
        derivative_rows_.reinit(n_rows, spacedim * values.n_dofs());
      }
    add_membrane_terms(full_points_, 0, terms);
    add_bending_terms(full_points_, n_full, terms);
    if (both)
      {
        reduced_points_->values.reinit_frames(part);
        reduced_points_->stiffness.reinit(reduced_points_->values,
                                          section_,
                                          1. - share);
        reduced_points_->held = held_forces(reduced_points_->values,
                                            section_,
                                            {{1. - share, 0.}},
                                            instant_);
        add_membrane_terms(*reduced_points_, n_full + n_bending, terms);
      }

    for (unsigned int a = 0; a < force_.size(); ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        terms.residual[values.dof(a, c)] += force_[a][c];
    if (terms.wants_tangent)
      add_cell_tangent(terms);
  }

  void
  CorotationalKinematics::evaluate_strains(CellPoints &points)
  {
    points.membrane_stiffness =
      membrane_stiffness(points.values, points.stiffness.membrane);
    membrane_.reinit(points.values, points.membrane_stiffness, u_);
    if (in_step_)
      {
        for (unsigned int end = 0; end < 2; ++end)
          ends_membrane_[end].reinit(points.values,
                                     points.membrane_stiffness,
                                     ends_u_[end]);
        membrane_.take_mean_strains(points.values,
                                    points.membrane_stiffness,
                                    ends_membrane_[0],
                                    ends_membrane_[1]);
      }
    if (!points.held.empty())
      membrane_.subtract(points.values.tying(), points.held);
    // Reduced points are of the membrane strain alone.
    if (&points != &full_points_)
      return;
    if (in_step_)
      {
        for (unsigned int end = 0; end < 2; ++end)
          ends_bending_[end].reinit(points.values,
                                    points.stiffness.bending,
                                    ends_u_[end]);
        bending_.take_means(ends_bending_[0], ends_bending_[1]);
      }
    else
      bending_.reinit(points.values, points.stiffness.bending, u_);
    if (!points.stiffness.coupling.empty())
      bending_.couple(points.values.tying(),
                      points.stiffness.coupling,
                      membrane_);
    bending_.subtract(points.held);
  }

  void
  CorotationalKinematics::add_initial_energies(const CellPoints &points,
                                               Energies         &energies) const
  {
    for (unsigned int q = 0; q < points.held.size(); ++q)
      {
        const InitialForces &held = points.held[q];
        energies.membrane +=
          held.membrane_energy -
          0.5 * (held.membrane_force *
                 membrane_.tied_strain(points.values.tying(), q));
        energies.bending += held.bending_energy;
        if (&points == &full_points_)
          energies.bending -= 0.5 * (held.moment * bending_.strain(q));
      }
  }

  void
  CorotationalKinematics::add_membrane_terms(CellPoints        &points,
                                             const unsigned int first_row,
                                             LocalTerms        &terms)
  {
    evaluate_strains(points);
    if (in_step_)
      add_membrane_step_force(points);
    else
      {
        membrane_.add_force(points.values, force_);
        terms.energies.membrane += membrane_.energy();
        add_initial_energies(points, terms.energies);
      }
    if (terms.wants_tangent)
      {
        if (!in_step_)
          set_sample_vectors(points);
        fill_sample_rows(points);
        fill_membrane_rows(points, first_row);
      }
  }

  void
  CorotationalKinematics::add_bending_terms(CellPoints        &points,
                                            const unsigned int first_row,
                                            LocalTerms        &terms)
  {
    if (in_step_)
      add_bending_step_force(points);
    else
      {
        bending_.add_force(points.values, force_);
        terms.energies.bending += bending_.energy();
      }
    if (terms.wants_tangent)
      fill_bending_rows(points, first_row);
  }

  void
  CorotationalKinematics::add_membrane_step_force(const CellPoints &points)
  {
    const auto &values  = points.values;
    const auto &samples = values.tying().samples();
    force_vectors_.resize(samples.size());
    for (unsigned int s = 0; s < samples.size(); ++s)
      {
        const auto &[k, direction] = samples[s];
        const auto &frame          = values.tying_frame(k);
        Voigt<>     strain;
        for (const auto &end : ends_membrane_)
          strain +=
            0.5 *
            CorotationalStrain::membrane(frame, end.deformed(k), end.polar(k));
        force_vectors_[s] =
          StepDifferences::stretch_vectors(frame,
                                           membrane_.deformed(k),
                                           strain,
                                           direction);
        const Vector3 g_1 = membrane_.sample_force(s) * force_vectors_[s][0];
        const Vector3 g_2 = membrane_.sample_force(s) * force_vectors_[s][1];
        for (unsigned int a = 0; a < force_.size(); ++a)
          {
            const auto &dN = values.tying_shapes().gradient(k, a);
            force_[a] += dN[0] * g_1 + dN[1] * g_2;
          }
      }
    strain_vectors_ = force_vectors_;
  }

  void
  CorotationalKinematics::add_bending_step_force(const CellPoints &points)
  {
    const auto &values = points.values;
    for (unsigned int q = 0; q < values.n_points(); ++q)
      for (unsigned int a = 0; a < force_.size(); ++a)
        {
          const Voigt<> strain = ShellStrain::bending_of_shape_function(
            bending_.deformed(q),
            values.shapes().gradient(q, a),
            values.shapes().hessian(q, a));
          force_[a] += (strain * bending_.moment(q)) * bending_.deformed(q).t0;
        }
  }

  void
  CorotationalKinematics::set_sample_vectors(const CellPoints &points)
  {
    const auto &samples = points.values.tying().samples();
    force_vectors_.resize(samples.size());
    strain_vectors_.resize(samples.size());
    for (unsigned int s = 0; s < samples.size(); ++s)
      {
        const auto &[k, direction] = samples[s];
        force_vectors_[s]          = membrane_.sample_vectors(direction, k);
        strain_vectors_[s]         = force_vectors_[s];
        if (is_consistent())
          strain_vectors_[s] = membrane_.sample_derivatives(direction, k);
      }
  }

  void
  CorotationalKinematics::fill_sample_rows(const CellPoints &points)
  {
    const auto &samples = points.values.tying().samples();
    const auto &shapes  = points.values.tying_shapes();
    sample_rows_.reinit(samples.size(), points.values.n_dofs(), true);
    for (unsigned int s = 0; s < samples.size(); ++s)
      {
        const auto &vectors = strain_vectors_[s];
        double     *row     = &sample_rows_(s, 0);
        for (unsigned int b = 0; b < u_.size(); ++b)
          {
            const auto &dN = shapes.gradient(samples[s].point, b);
            for (unsigned int d = 0; d < spacedim; ++d)
              *row++ = dN[0] * vectors[0][d] + dN[1] * vectors[1][d];
          }
      }
    points.values.tying().sum_rows(sample_rows_);
    force_rows_.reinit(sample_rows_.m(), sample_rows_.n(), true);
    points.membrane_stiffness.mmult(force_rows_, sample_rows_);
    if (!points.stiffness.coupling.empty())
      {
        fill_strain_rows(points);
        add_coupling_to_force_rows(points);
      }
  }

  void
  CorotationalKinematics::fill_membrane_rows(const CellPoints  &points,
                                             const unsigned int first_row)
  {
    const auto        &samples = points.values.tying().samples();
    const auto        &shapes  = points.values.tying_shapes();
    const unsigned int n       = points.values.n_dofs();
    points.values.tying().spread_rows(force_rows_);
    // Forces change with the strains ...
    for (unsigned int s = 0; s < samples.size(); ++s)
      {
        const unsigned int k       = samples[s].point;
        const auto        &vectors = force_vectors_[s];
        for (unsigned int alpha = 0; alpha < 2; ++alpha)
          {
            if (samples[s].direction[alpha] == 0. &&
                samples[s].direction[2] == 0.)
              continue;
            const unsigned int r =
              first_row + points.membrane_rows[2 * k + alpha];
            const double *df = &force_rows_(s, 0);
            for (unsigned int c = 0; c < spacedim; ++c)
              add_scaled(n, vectors[alpha][c], df, &derivative_rows_(r, c * n));
          }
      }
    // ... and turn.
    for (unsigned int k = 0; k < shapes.n_points(); ++k)
      {
        const auto X = membrane_.turn_derivative(k);
        for (unsigned int alpha = 0; alpha < 2; ++alpha)
          {
            const unsigned int row = points.membrane_rows[2 * k + alpha];
            if (row == numbers::invalid_unsigned_int)
              continue;
            for (unsigned int a = 0; a < u_.size(); ++a)
              shape_rows_(first_row + row, a) = shapes.gradient(k, a)[alpha];
            if (is_consistent())
              for (unsigned int c = 0; c < spacedim; ++c)
                {
                  double *dg = &derivative_rows_(first_row + row, c * n);
                  for (unsigned int b = 0; b < u_.size(); ++b)
                    {
                      const auto &dN = shapes.gradient(k, b);
                      for (unsigned int d = 0; d < spacedim; ++d)
                        *dg++ +=
                          X[alpha][0][c][d] * dN[0] + X[alpha][1][c][d] * dN[1];
                    }
                }
          }
      }
  }

  void
  CorotationalKinematics::fill_bending_rows(const CellPoints  &points,
                                            const unsigned int first_row)
  {
    const auto        &values = points.values;
    const auto        &shapes = values.shapes();
    const unsigned int n      = values.n_dofs();
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        const auto   &deformed = bending_.deformed(q);
        const auto   &phi      = deformed.a_con;
        const Vector3 t        = deformed.t0;
        const auto   &m        = bending_.moment(q);
        const auto   &H        = points.stiffness.bending[q];
        for (unsigned int b = 0; b < u_.size(); ++b)
          {
            const auto &dN  = shapes.gradient(q, b);
            const auto &ddN = shapes.hessian(q, b);
            const auto  virtual_strain =
              ShellStrain::bending_of_shape_function(in_step_ ? deformed :
                                                                values.frame(q),
                                                     dN,
                                                     ddN);
            // d(rho_ab) = -(du,ab - Gamma^g_ab du,g) . t, Gamma the deformed
            const auto moment =
              H * (is_consistent() ?
                     ShellStrain::bending_of_shape_function(deformed, dN, ddN) :
                     virtual_strain);
            // dt = -phi^g (t . du,g)
            Vector3 turn;
            if (is_consistent())
              turn = -(dN[0] * phi[0] + dN[1] * phi[1]);
            for (unsigned int v = 0; v < 3; ++v)
              {
                const unsigned int r = first_row + 3 * q + v;
                shape_rows_(r, b)    = virtual_strain[v];
                const Vector3 dg     = moment[v] * t + m[v] * turn;
                for (unsigned int c = 0; c < spacedim; ++c)
                  for (unsigned int d = 0; d < spacedim; ++d)
                    derivative_rows_(r, c * n + 3 * b + d) = dg[c] * t[d];
              }
          }
      }
    if (!points.stiffness.coupling.empty())
      add_coupling_to_bending_rows(points, first_row);
  }

  void
  CorotationalKinematics::add_cell_tangent(LocalTerms &terms)
  {
    const auto        &values = full_points_.values;
    const unsigned int n      = values.n_dofs();
    product_.reinit(u_.size(), spacedim * n, true);
    shape_rows_.Tmmult(product_, derivative_rows_);
    for (unsigned int a = 0; a < u_.size(); ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        {
          const double *entry = &product_(a, c * n);
          double       *row   = &terms.tangent(values.dof(a, c), 0);
          for (unsigned int b = 0; b < u_.size(); ++b)
            for (unsigned int d = 0; d < spacedim; ++d)
              row[values.dof(b, d)] += *entry++;
        }
  }
} // namespace Nacre
