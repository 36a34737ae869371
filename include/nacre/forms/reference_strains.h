// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_reference_strains_h
#define nacre_forms_reference_strains_h

#include <nacre/discretization/discretization.h>
#include <nacre/discretization/membrane_tying.h>
#include <nacre/mechanics/section_law.h>

#include <deal.II/fe/fe_values.h>

#include <vector>

namespace Nacre
{
  /** The strains of ReferenceAssembly, by deal.II's FEValues alone. */
  namespace ReferenceStrains
  {
    /** The displacement: components 0, 1, 2 of the FESystem. */
    const FEValuesExtractors::Vector displacement(0);

    /** a_alpha, a^alpha, t0 and phi0,alpha beta: (5), (11), (12). */
    SurfaceFrame<>
    frame_at(const FEValuesBase<dim, spacedim> &fe_values,
             const unsigned int                 q);

    SectionPoint
    section_point(const FEValuesBase<dim, spacedim> &fe_values,
                  const unsigned int                 q);

    /**
     * The membrane strain (3), eps = 1/2 (grad u + grad u^T) between tangent
     * vectors.
     */
    Voigt<>
    membrane_strain(const FEValuesBase<dim, spacedim> &fe_values,
                    const SurfaceFrame<>              &frame,
                    const unsigned int                 i,
                    const unsigned int                 q);

    /**
     * The bending strain (4), rho = -t0 . hess u: deal.II's Hessian of a
     * function on a surface is its covariant second derivative.
     */
    Voigt<>
    bending_strain(const FEValuesBase<dim, spacedim> &fe_values,
                   const SurfaceFrame<>              &frame,
                   const unsigned int                 i,
                   const unsigned int                 q);

    /** theta = t0 . (grad u . nu), the rotation about an edge. */
    double
    rotation(const FEValuesBase<dim, spacedim> &fe_values,
             const Tensor<1, spacedim>         &t0,
             const Tensor<1, spacedim>         &nu,
             const unsigned int                 i,
             const unsigned int                 q);

    /** What tied membrane strains are made of: [sample][dof]. */
    std::vector<std::vector<double>>
    sample_membrane_strain(const MembraneTying           &tying,
                           const FEValues<dim, spacedim> &fe_values);

    /** The membrane strain at the point @p q, interpolated: [dof]. */
    std::vector<Voigt<>>
    tied_membrane_strain(const MembraneTying                    &tying,
                         const std::vector<std::vector<double>> &samples,
                         const unsigned int                      q);

    /**
     * The tied membrane strain of a cell at the points of one of its edges, for
     * sections that couple it with the moment there.
     */
    class TiedEdgeStrain
    {
    public:
      /** @param samples at the tying points, with update_gradients */
      TiedEdgeStrain(
        const Discretization                                  &discretization,
        const SectionLaw                                      &section,
        FEValues<dim, spacedim>                               &samples,
        const DoFHandler<dim, spacedim>::active_cell_iterator &cell,
        const unsigned int                                     face,
        const unsigned int                                     subface);

      /** At the point @p q: [dof]. */
      std::vector<Voigt<>>
      at(const unsigned int q) const
      {
        return tied_membrane_strain(tying_, samples_, q);
      }

    private:
      const MembraneTying              tying_;
      std::vector<std::vector<double>> samples_;
    };
  } // namespace ReferenceStrains
} // namespace Nacre

#endif
