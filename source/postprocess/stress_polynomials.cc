// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/finite_cell.h>
#include <nacre/postprocess/stress_polynomials.h>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, spacedim>;

    /**
     * Rows [point][node] that give the nodal values of the polynomial of the
     * element that is closest to values at the points: collocation where there
     * are as many points as nodes.
     */
    FullMatrix<double>
    make_projection(const ShapeTable &shapes, const Quadrature<dim> &quadrature)
    {
      const unsigned int n = shapes.n_nodes();
      FullMatrix<double> values(n, quadrature.size()), normal(n, n);
      FullMatrix<double> projection(n, quadrature.size());
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            values(a, q) = quadrature.weight(q) * shapes.value(q, a);
            for (unsigned int b = 0; b < n; ++b)
              normal(a, b) += values(a, q) * shapes.value(q, b);
          }
      normal.gauss_jordan();
      normal.mmult(projection, values);
      return projection;
    }

    /** N^1, N^2, M^11, M^22, M^12 of n and m times the root of the metric. */
    std::array<Vector3, 5>
    vectors_of(const SurfaceFrame<> &frame, const Voigt<> &n, const Voigt<> &m)
    {
      const auto            &a = frame.a_cov;
      std::array<Vector3, 5> vectors;
      vectors[0] = n[0] * a[0] + n[2] * a[1];
      vectors[1] = n[2] * a[0] + n[1] * a[1];
      for (unsigned int b = 0; b < 2; ++b)
        {
          const auto &Gamma = frame.christoffel[b];
          vectors[b] +=
            (m[0] * Gamma[0] + m[1] * Gamma[1] + 2. * m[2] * Gamma[2]) *
            frame.t0;
        }
      for (unsigned int v = 0; v < 3; ++v)
        vectors[2 + v] = m[v] * frame.t0;
      return vectors;
    }

    /** Those of a linear displacement at a point of the values' rule. */
    std::array<Vector3, 5>
    vectors_at(const ShellCellValues        &values,
               const SectionLaw             &section,
               const SectionStates::Points  &states,
               const dealii::Vector<double> &u,
               const unsigned int            q)
    {
      Voigt<> eps, rho;
      for (unsigned int v = 0; v < 3; ++v)
        for (unsigned int i = 0; i < u.size(); ++i)
          {
            eps[v] += values.membrane_rows()(3 * q + v, i) * u[i];
            rho[v] += values.bending_rows()(3 * q + v, i) * u[i];
          }
      const auto &frame = values.frame(q);
      const auto  answer =
        section.response(eps, rho, frame, values.point(q), states[q].values);
      return vectors_of(frame,
                        frame.j0 * answer.membrane_force,
                        frame.j0 * answer.moment);
    }

    /** The deformed cell, with n and m times the root of the metric. */
    void
    deform(const ShellCellValues        &values,
           const SectionLaw             &section,
           const SectionStates::Points  &states,
           const dealii::Vector<double> &u,
           FiniteCell<double>           &cell)
    {
      std::vector<SectionBlocks> sections;
      for (unsigned int q = 0; q < values.n_points(); ++q)
        sections.emplace_back(section,
                              values.frame(q),
                              values.point(q),
                              values.frame(q).j0,
                              states[q]);
      NodeVectors<double> nodes;
      extract_nodes(values, u, nodes);
      cell.reinit(values, sections, nodes);
    }
  } // namespace

  StressPolynomials::StressPolynomials(
    const Discretization                    &discretization,
    const SectionLaw                        &section,
    const KinematicsOptions                 &kinematics,
    const std::vector<const Displacement *> &displacements,
    SectionStates *const                     states)
    : n_displacements_(displacements.size())
    , n_nodes_(discretization.scalar_fe().n_dofs_per_cell())
    , nodal_(std::size_t(discretization.n_part_indices()) * n_displacements_ *
             n_vectors * n_nodes_)
  {
    const auto quadrature = discretization.element().full_quadrature();
    // On parts the same points of the cell, to which their polynomials go on.
    ShellCellValues values(discretization,
                           quadrature,
                           recovers_tied_strain(kinematics.membrane_strain),
                           ShellCellValues::Points::given);
    values.project_on_parts(kinematics.membrane_strain != MembraneStrain::full);
    const bool         is_linear = kinematics.model == KinematicsModel::linear;
    FiniteCell<double> deformed;
    const auto projection = make_projection(values.shapes(), quadrature);
    dealii::Vector<double>               u(values.n_dofs());
    std::vector<types::global_dof_index> dofs;
    for (const CellPart &part : discretization.relevant_parts())
      {
        if (part.enrichment() != nullptr)
          continue;
        is_linear ? values.reinit(part) : values.reinit_frames(part);
        discretization.get_dof_indices(part, dofs);
        for (unsigned int d = 0; d < n_displacements_; ++d)
          {
            for (unsigned int i = 0; i < u.size(); ++i)
              u[i] = (*displacements[d])(dofs[i]);
            const auto at_start = states != nullptr ?
                                    states->of_cell(part, values) :
                                    SectionStates::Points();
            if (!is_linear)
              deform(values, section, at_start, u, deformed);
            Vector3 *nodal = &nodal_[begin(part, d)];
            for (unsigned int q = 0; q < quadrature.size(); ++q)
              {
                const auto vectors =
                  is_linear ? vectors_at(values, section, at_start, u, q) :
                              vectors_of(deformed.deformed(q),
                                         deformed.force(q),
                                         deformed.moment(q));
                for (unsigned int v = 0; v < n_vectors; ++v)
                  for (unsigned int a = 0; a < n_nodes_; ++a)
                    nodal[v * n_nodes_ + a] += projection(a, q) * vectors[v];
              }
          }
      }
  }

  std::array<Vector3, 2>
  StressPolynomials::forces(const Vector3     *nodal,
                            const ShapeTable  &shapes,
                            const unsigned int q)
  {
    std::array<Vector3, 2> f;
    const unsigned int     n = shapes.n_nodes();
    for (unsigned int a = 0; a < n; ++a)
      {
        const auto &dN = shapes.gradient(q, a);
        f[0] += shapes.value(q, a) * nodal[a] + dN[0] * nodal[2 * n + a] +
                dN[1] * nodal[4 * n + a];
        f[1] += shapes.value(q, a) * nodal[n + a] + dN[1] * nodal[3 * n + a] +
                dN[0] * nodal[4 * n + a];
      }
    return f;
  }

  Vector3
  StressPolynomials::divergence(const Vector3     *nodal,
                                const ShapeTable  &shapes,
                                const unsigned int q)
  {
    Vector3            sum;
    const unsigned int n = shapes.n_nodes();
    for (unsigned int a = 0; a < n; ++a)
      {
        const auto &dN  = shapes.gradient(q, a);
        const auto &ddN = shapes.hessian(q, a);
        sum += dN[0] * nodal[a] + dN[1] * nodal[n + a] +
               ddN[0] * nodal[2 * n + a] + ddN[1] * nodal[3 * n + a] +
               2. * ddN[2] * nodal[4 * n + a];
      }
    return sum;
  }

  Vector3
  StressPolynomials::moment(const Vector3               *nodal,
                            const ShapeTable            &shapes,
                            const unsigned int           q,
                            const std::array<double, 2> &x,
                            const std::array<double, 2> &y)
  {
    Vector3            sum;
    const unsigned int n = shapes.n_nodes();
    for (unsigned int a = 0; a < n; ++a)
      sum += shapes.value(q, a) *
             (x[0] * y[0] * nodal[2 * n + a] + x[1] * y[1] * nodal[3 * n + a] +
              (x[0] * y[1] + x[1] * y[0]) * nodal[4 * n + a]);
    return sum;
  }
} // namespace Nacre
