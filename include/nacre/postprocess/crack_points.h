// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_crack_points_h
#define nacre_postprocess_crack_points_h

#include <nacre/postprocess/crack_extension.h>
#include <nacre/postprocess/strain_values.h>

namespace Nacre
{
  /**
   * Positive for a part behind the tip on the side of e_2, negative for one on
   * the other side, 0 for one that lies at no lip: williams_value().
   */
  double
  side_of_crack(const Discretization &discretization,
                const CrackTip       &tip,
                const CellPart       &part);

  /**
   * The surface with three derivatives, and the displacement with two, at
   * fixed points of one part after the other. All that an energy release rate
   * takes of a displacement is here.
   */
  class CrackPoints
  {
  public:
    /**
     * @param shell must live as long
     * @param points in the reference cell
     * @param lip on which they lie, as PartEnrichment::evaluate() takes it
     */
    CrackPoints(const SolvedShell     &shell,
                const Quadrature<dim> &points,
                const Tensor<1, dim>  &lip = {});

    void
    reinit(const CellPart &part);

    const SurfaceFrame<> &
    frame(const unsigned int q) const
    {
      return strains_.values().frame(q);
    }

    unsigned int
    size() const
    {
      return quadrature_.size();
    }

    /** Of the reference cell. */
    double
    weight(const unsigned int q) const
    {
      return quadrature_.weight(q);
    }

    SurfacePatch
    surface(const unsigned int q) const;

    /** u (length). */
    Tensor<1, spacedim>
    displacement(const unsigned int q) const
    {
      return strains_.displacement(q);
    }

    /** SolvedShell::acceleration; 0 in statics (length/time^2). */
    Tensor<1, spacedim>
    acceleration(const unsigned int q) const;

    /** u,a and u,ab. */
    VectorDerivatives
    derivatives(const unsigned int q) const;

    /**
     * What the tied or projected membrane strain has more than that of u,
     * covariant (e11, e22, 2 e12) (length^2).
     */
    Voigt<>
    tying(const unsigned int q) const
    {
      return strains_.membrane(q) -
             membrane_strain(frame(q), derivatives(q), is_linear_);
    }

  private:
    const SolvedShell    &shell_;
    const bool            is_linear_;
    const Quadrature<dim> quadrature_;
    StrainValues          strains_;
    /** Of the geometry's shape functions, [point][node]: 111, 112, 122, 222. */
    std::vector<std::array<double, 4>> third_;

    Vector<double>                   u_;
    Vector<double>                   acceleration_;
    ArrayView<const Point<spacedim>> nodes_;
  };
} // namespace Nacre

#endif
