// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_section_law_h
#define nacre_mechanics_section_law_h

#include <nacre/base/mesh_region.h>
#include <nacre/mechanics/surface_frame.h>

#include <deal.II/base/types.h>

#include <string>
#include <vector>

namespace Nacre
{
  /**
   * A point of the mid-surface (length) as a section sees it: the position and
   * the region of the mesh that the cell belongs to.
   */
  class SectionPoint : public Point<3>
  {
  public:
    /** Not explicit: on surfaces without regions any point will do. */
    SectionPoint(const Point<3> &position, const types::material_id region = 0)
      : Point<3>(position)
      , region_(region)
    {}

    /** The cell's material id; 0: no region of a name. */
    types::material_id
    region() const
    {
      return region_;
    }

  private:
    types::material_id region_;
  };

  /** Stiffness of a section, covariant basis, Voigt [resultant][strain]. */
  struct SectionStiffness
  {
    /** H_n: membrane forces n^ab from membrane strains. */
    VoigtMatrix<> membrane;
    /** H_m: moments m^ab from bending strains. */
    VoigtMatrix<> bending;
  };

  /**
   * The law of a section: how membrane forces and moments follow from strains.
   * To add one, derive from this class and hand it to ConvergenceStudy.
   */
  class SectionLaw
  {
  public:
    virtual ~SectionLaw() = default;

    /**
     * Evaluate the parameters' expressions and check them; throws ExcMessage
     * on values out of range.
     */
    virtual void
    prepare(const Constants &constants) = 0;

    /** Replace the thickness (length), for a study over thicknesses. */
    virtual void
    set_thickness(const double thickness) = 0;

    /**
     * The constants E, nu, h of the section as far as they are numbers, for
     * the expressions of loads and reference values.
     */
    virtual Constants
    named_constants() const = 0;

    /**
     * Tell the section the mesh's regions; the index is the region() of a
     * point, and region 0 has no name. A name may stand for several regions,
     * and a region may have several names. Called after prepare(). Throws if
     * the section has values for a region that isn't there, or for two names
     * of one region. Sections that are the same everywhere need not care.
     */
    virtual void
    set_regions(const MeshRegions &mesh)
    {
      (void)mesh;
    }

    /** Thickness (length) at @p point; throws if it isn't positive. */
    virtual double
    thickness(const SectionPoint &point) const = 0;

    /** Mass per volume at @p point. */
    virtual double
    density(const SectionPoint &point) const = 0;

    /** H_n and H_m, (8)-(10), at @p point with the surface's @p frame. */
    virtual SectionStiffness
    stiffness(const SurfaceFrame<> &frame, const SectionPoint &point) const = 0;
  };
} // namespace Nacre

#endif
