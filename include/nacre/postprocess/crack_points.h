// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_crack_points_h
#define nacre_postprocess_crack_points_h

#include <nacre/postprocess/crack_extension.h>
#include <nacre/postprocess/strain_values.h>

namespace Nacre
{
  /**
   * The surface with three derivatives, and the displacement with two, at
   * fixed points of one cell after the other.
   */
  class CrackPoints
  {
  public:
    /** @param state must live as long @param points in the reference cell */
    CrackPoints(const ShellState &state, const Quadrature<dim> &points);

    void
    reinit(const DoFHandler<dim, spacedim>::active_cell_iterator &cell);

    const StrainValues &
    strains() const
    {
      return strains_;
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

    VectorDerivatives
    displacement(const unsigned int q) const;

  private:
    const ShellState     &state_;
    const Quadrature<dim> quadrature_;
    StrainValues          strains_;
    /** Of the geometry's shape functions, [point][node]: 111, 112, 122, 222. */
    std::vector<std::array<double, 4>> third_;

    Vector<double>                   u_;
    ArrayView<const Point<spacedim>> nodes_;
  };
} // namespace Nacre

#endif
