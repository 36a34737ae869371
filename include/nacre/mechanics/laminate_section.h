// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_laminate_section_h
#define nacre_mechanics_laminate_section_h

#include <nacre/base/expression.h>
#include <nacre/mechanics/laminate.h>
#include <nacre/mechanics/section_law.h>
#include <nacre/mechanics/section_regions.h>

#include <array>
#include <optional>
#include <vector>

namespace Nacre
{
  /** A laminate in its place on a surface. */
  struct Layup
  {
    Laminate laminate;
    /** The whole thickness (length), positive. */
    Expression thickness;
    /** Of the middle from the reference surface, towards the top (length). */
    double offset = 0.;
    /** Whose projection is the axis 1; any length. */
    VectorExpression direction = Tensor<1, 3>({1., 0., 0.});
    /** In place of the direction the line of the parameter u (0) or v (1). */
    std::optional<unsigned int> line = {};
  };

  /**
   * A section of orthotropic plies: classical lamination theory, Laminate.
   *
   * The plies' angles are measured from the axis 1, the projection of the
   * material direction onto the surface or the line of a parameter of the
   * surface, towards the axis 2 = top x 1; `top` is the unit normal on the side
   * of the stack's top. That is the side of the normal t0, or the side to which
   * a vector field points. Both depend on the position only, so that
   * the stack is the same body whatever the numbering and the orientation of a
   * cell.
   */
  class LaminateSection : public LinearSectionLaw
  {
  public:
    /**
     * @param top the side of the stack's top; none: that of the normal t0
     * @param lines MeshRegions::parameter_lines; throws if a layup needs them
     *        and there are none
     */
    explicit LaminateSection(
      ByRegion<Layup>                                          layups,
      std::optional<VectorExpression>                          top   = {},
      const std::vector<std::array<std::array<double, 2>, 2>> &lines = {});

    double
    thickness(const SectionPoint &point) const override;

    /** The mean of the plies. */
    double
    density(const SectionPoint &point) const override;

    SectionStiffness
    stiffness(const SurfaceFrame<> &frame,
              const SectionPoint   &point) const override;

    bool
    is_coupled() const override
    {
      return is_coupled_;
    }

    Voigt<>
    stress(const Voigt<>        &membrane_strain,
           const Voigt<>        &bending_strain,
           const double          side,
           const SurfaceFrame<> &frame,
           const SectionPoint   &point) const override
    {
      return stress(membrane_strain,
                    bending_strain,
                    side,
                    frame,
                    point,
                    Temperature());
    }

    std::vector<LayerState>
    layers(const Voigt<>        &membrane_strain,
           const Voigt<>        &bending_strain,
           const SurfaceFrame<> &frame,
           const SectionPoint   &point) const override
    {
      return layers(membrane_strain,
                    bending_strain,
                    frame,
                    point,
                    Temperature());
    }

    /** @name The same with plies that are warmer by the @p temperature */
    //@{
    Voigt<>
    stress(const Voigt<>        &membrane_strain,
           const Voigt<>        &bending_strain,
           const double          side,
           const SurfaceFrame<> &frame,
           const SectionPoint   &point,
           const Temperature    &temperature) const;

    std::vector<LayerState>
    layers(const Voigt<>        &membrane_strain,
           const Voigt<>        &bending_strain,
           const SurfaceFrame<> &frame,
           const SectionPoint   &point,
           const Temperature    &temperature) const;
    //@}

    /** Laminate::thermal_forces() in the covariant basis. */
    InitialForces
    thermal_forces(const Temperature    &temperature,
                   const SurfaceFrame<> &frame,
                   const SectionPoint   &point) const;

    unsigned int
    n_layers() const override;

  private:
    /** Axes of the stack at a point. */
    struct Axes
    {
      /** Covariant strains to those along the axes 1, 2. */
      VoigtMatrix<> to_axes;
      /** +1 if the top is on the side of t0, -1 otherwise. */
      double side;
    };

    /** Along the axis 1, or with a part normal to the surface; any length. */
    Tensor<1, 3>
    direction(const Layup          &layup,
              const SurfaceFrame<> &frame,
              const SectionPoint   &point) const;

    Axes
    axes(const Layup          &layup,
         const SurfaceFrame<> &frame,
         const SectionPoint   &point) const;

    ByRegion<Layup>                 layups_;
    std::optional<VectorExpression> top_;
    /** By region: the lines of u and v. */
    std::vector<std::array<std::array<double, 2>, 2>> lines_;
    bool                                              is_coupled_ = false;
  };
} // namespace Nacre

#endif
