// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_laminate_section_h
#define nacre_mechanics_laminate_section_h

#include <nacre/base/expression.h>
#include <nacre/mechanics/laminate.h>
#include <nacre/mechanics/section_law.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  /**
   * A section of orthotropic plies: classical lamination theory, Laminate.
   *
   * The plies' angles are measured from the axis 1, the projection of the
   * material direction onto the surface or the line of a parameter of the
   * surface, towards the axis 2 = top x 1; `top` is the unit normal on the side
   * of the stack's top. That is the side of the normal t0, or the side to which
   * the vector field of 'Top' points. Both depend on the position only, so that
   * the stack is the same body whatever the numbering and the orientation of a
   * cell.
   */
  class LaminateSection
    : public LinearSectionLaw
    , public ParameterAcceptor
  {
  public:
    LaminateSection();

    void
    prepare(const Constants &constants) override;

    void
    set_thickness(const double thickness) override;

    Constants
    named_constants() const override;

    void
    set_regions(const MeshRegions &mesh) override;

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
    /** The parameters of a stack, as texts; regions may have some of their own.
     */
    struct LayupTexts
    {
      std::string stack, thickness, ply_thickness, offset, direction;
    };

    /** A stack in its place. */
    struct Layup
    {
      Laminate laminate;
      /** The whole thickness (length). */
      Expression thickness;
      /** Whether a study over thicknesses leaves it. */
      bool             has_own_thickness = false;
      double           offset            = 0.;
      VectorExpression direction;
      /** In place of the direction the line of the parameter u (0) or v (1). */
      std::optional<unsigned int> line;
      /** The parameter, for messages. */
      std::string where;
    };

    /** Axes of the stack at a point. */
    struct Axes
    {
      /** Covariant strains to those along the axes 1, 2. */
      VoigtMatrix<> to_axes;
      /** +1 if the top is on the side of t0, -1 otherwise. */
      double side;
    };

    void
    read_materials(const Constants &constants);

    /**
     * The layup of the @p texts. @p where is the beginning of the parameters'
     * names in messages.
     */
    Layup
    make_layup(const LayupTexts  &texts,
               const std::string &where,
               const Constants   &constants) const;

    std::vector<Laminate::Layer>
    make_layers(const LayupTexts &texts, const std::string &where) const;

    /**
     * Give all layers a thickness and return the sum (length, or the number of
     * plies if only the whole is known). @p names are those of the parameters
     * of a ply's and of the whole thickness, for messages.
     */
    double
    fill_thicknesses(std::vector<Laminate::Layer>     &layers,
                     const LayupTexts                 &texts,
                     const std::array<std::string, 2> &names,
                     const Constants                  &constants) const;

    void
    read_regions(const Constants &constants);

    const Layup &
    layup(const SectionPoint &point) const;

    double
    thickness(const Layup &layup, const SectionPoint &point) const;

    /** Along the axis 1, or with a part normal to the surface; any length. */
    Tensor<1, 3>
    direction(const Layup          &layup,
              const SurfaceFrame<> &frame,
              const SectionPoint   &point) const;

    Axes
    axes(const Layup          &layup,
         const SurfaceFrame<> &frame,
         const SectionPoint   &point) const;

    std::string materials_text_;
    LayupTexts  texts_;
    std::string top_text_ = "normal";
    std::string regions_text_;

    struct Material
    {
      OrthotropicMaterial material;
      /** Of a ply of it (length). */
      std::optional<double> ply_thickness;
    };

    std::map<std::string, Material> materials_;
    Layup                           layup_;
    std::map<std::string, Layup>    regions_;
    std::vector<const Layup *>      layup_of_id_;
    /** By region: the lines of u and v, MeshRegions::parameter_lines. */
    std::vector<std::array<std::array<double, 2>, 2>> lines_of_id_;
    std::optional<VectorExpression>                   top_;
    std::optional<double>                             thickness_of_study_;
    bool                                              is_coupled_ = false;
  };
} // namespace Nacre

#endif
