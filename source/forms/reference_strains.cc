// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/reference_strains.h>

#include <deal.II/base/qprojector.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    /** (e_11, e_22, 2 e_12), e_ab = a_a . e . a_b, of a tensor in space. */
    Voigt<>
    covariant(const Tensor<2, spacedim> &e, const SurfaceFrame<> &frame)
    {
      const auto &a = frame.a_cov;
      Voigt<>     components;
      components[0] = a[0] * (e * a[0]);
      components[1] = a[1] * (e * a[1]);
      components[2] = a[0] * (e * a[1]) + a[1] * (e * a[0]);
      return components;
    }

    /** The points of an edge in the reference cell. */
    std::vector<Point<dim>>
    unit_points(const Discretization &discretization,
                const DoFHandler<dim, spacedim>::active_cell_iterator &cell,
                const unsigned int                                     face,
                const unsigned int                                     subface)
    {
      const auto quadrature = discretization.element().edge_quadrature();
      std::vector<Point<dim>> points(quadrature.size());
      if (subface == numbers::invalid_unsigned_int)
        QProjector<dim>::project_to_face(cell->reference_cell(),
                                         quadrature,
                                         face,
                                         points);
      else
        QProjector<dim>::project_to_subface(cell->reference_cell(),
                                            quadrature,
                                            face,
                                            subface,
                                            points);
      if (!cell->face_orientation(face))
        std::reverse(points.begin(), points.end());
      return points;
    }
  } // namespace

  namespace ReferenceStrains
  {
    SurfaceFrame<>
    frame_at(const FEValuesBase<dim, spacedim> &fe_values, const unsigned int q)
    {
      const auto         &jacobian   = fe_values.jacobian(q);
      const auto         &derivative = fe_values.jacobian_grad(q);
      Tensor<1, spacedim> a_1, a_2;
      std::array<Tensor<1, spacedim>, 3> phi_ab;
      for (unsigned int c = 0; c < spacedim; ++c)
        {
          a_1[c]       = jacobian[c][0];
          a_2[c]       = jacobian[c][1];
          phi_ab[0][c] = derivative[c][0][0];
          phi_ab[1][c] = derivative[c][1][1];
          phi_ab[2][c] = derivative[c][0][1];
        }
      return make_surface_frame(a_1, a_2, phi_ab);
    }

    SectionPoint
    section_point(const FEValuesBase<dim, spacedim> &fe_values,
                  const unsigned int                 q)
    {
      return SectionPoint(fe_values.quadrature_point(q),
                          fe_values.get_cell()->material_id());
    }

    Voigt<>
    membrane_strain(const FEValuesBase<dim, spacedim> &fe_values,
                    const SurfaceFrame<>              &frame,
                    const unsigned int                 i,
                    const unsigned int                 q)
    {
      return covariant(fe_values[displacement].gradient(i, q), frame);
    }

    Voigt<>
    bending_strain(const FEValuesBase<dim, spacedim> &fe_values,
                   const SurfaceFrame<>              &frame,
                   const unsigned int                 i,
                   const unsigned int                 q)
    {
      return covariant(-frame.t0 * fe_values[displacement].hessian(i, q),
                       frame);
    }

    double
    rotation(const FEValuesBase<dim, spacedim> &fe_values,
             const Tensor<1, spacedim>         &t0,
             const Tensor<1, spacedim>         &nu,
             const unsigned int                 i,
             const unsigned int                 q)
    {
      return t0 * (fe_values[displacement].gradient(i, q) * nu);
    }

    std::vector<std::vector<double>>
    sample_membrane_strain(const MembraneTying           &tying,
                           const FEValues<dim, spacedim> &fe_values)
    {
      std::vector<std::vector<double>> values;
      for (const auto &[point, direction] : tying.samples())
        {
          const auto    frame = frame_at(fe_values, point);
          const Voigt<> d({direction[0], direction[1], direction[2]});
          values.emplace_back(fe_values.dofs_per_cell);
          for (const unsigned int i : fe_values.dof_indices())
            values.back()[i] = d * membrane_strain(fe_values, frame, i, point);
        }
      return values;
    }

    std::vector<Voigt<>>
    tied_membrane_strain(const MembraneTying                    &tying,
                         const std::vector<std::vector<double>> &samples,
                         const unsigned int                      q)
    {
      std::vector<Voigt<>> strain(samples.front().size());
      for (unsigned int v = 0; v < 3; ++v)
        for (const auto &[k, weight] : tying.weights(q, v))
          for (unsigned int i = 0; i < strain.size(); ++i)
            strain[i][v] += weight * samples[k][i];
      return strain;
    }

    TiedEdgeStrain::TiedEdgeStrain(
      const Discretization                                  &discretization,
      const SectionLaw                                      &section,
      FEValues<dim, spacedim>                               &samples,
      const DoFHandler<dim, spacedim>::active_cell_iterator &cell,
      const unsigned int                                     face,
      const unsigned int                                     subface)
      : tying_(discretization.element(),
               unit_points(discretization, cell, face, subface))
    {
      if (!section.is_coupled())
        return;
      samples.reinit(cell);
      samples_ = sample_membrane_strain(tying_, samples);
    }
  } // namespace ReferenceStrains
} // namespace Nacre
