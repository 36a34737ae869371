// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_laminate_h
#define nacre_mechanics_laminate_h

#include <nacre/mechanics/orthotropic_material.h>
#include <nacre/mechanics/section_law.h>

#include <vector>

namespace Nacre
{
  /**
   * A stack of plies in its own axes 1, 2 and 3, 3 from the bottom to the top:
   * classical lamination theory (Jones, chapter 4; Reddy, Mechanics of
   * Laminated Composite Plates and Shells, section 3.3). A fibre at the height
   * z above the reference surface has the strain eps + z kappa; with the plies'
   * stiffnesses in these axes, Qbar,
   *   A = int Qbar dz,   B = int z Qbar dz,   D = int z^2 Qbar dz .
   */
  class Laminate
  {
  public:
    struct Layer
    {
      OrthotropicMaterial material;
      /** From the axis 1 towards the axis 2 (degrees). */
      double angle;
      /** Any unit: only the ratio to the sum of all counts. */
      double thickness;
    };

    /** Of no thickness. */
    Laminate() = default;

    /** @param layers from bottom to top, at least one */
    explicit Laminate(const std::vector<Layer> &layers);

    /**
     * A, B, D (force/length, force, force times length) of a laminate of the
     * thickness @p h whose middle lies by @p offset above the reference
     * surface (length).
     */
    SectionStiffness
    stiffness(const double h, const double offset) const;

    /** Whether B = 0 without an offset: symmetric stacks, isotropic ones. */
    bool
    is_symmetric() const
    {
      return is_symmetric_;
    }

    /** The mean over the thickness (mass/length^3). */
    double
    density() const;

    unsigned int
    n_layers() const
    {
      return layers_.size();
    }

    /**
     * Strains and stresses of all layers, for the strains @p eps and @p kappa
     * (1/length) of the reference surface in the axes 1, 2; heights along 3.
     * Strains are those that stress takes, without the free expansion.
     */
    std::vector<LayerState>
    states(const Voigt<>     &eps,
           const Voigt<>     &kappa,
           const double       h,
           const double       offset,
           const Temperature &temperature = {}) const;

    /**
     * What the free expansion of all layers by the @p temperature, whose
     * gradient is along 3, takes to be held, in the axes 1, 2:
     *   n0 = int Qbar alpha T dz,   m0 = int z Qbar alpha T dz,
     * and the energy 1/2 int alpha Qbar alpha T^2 dz, as a membrane energy.
     */
    InitialForces
    thermal_forces(const Temperature &temperature,
                   const double       h,
                   const double       offset) const;

    /**
     * The stress in the axes 1, 2 at the height @p zeta h above the middle,
     * -1/2 <= zeta <= 1/2; between two layers that of the upper one.
     */
    Voigt<>
    stress(const Voigt<>     &eps,
           const Voigt<>     &kappa,
           const double       zeta,
           const double       h,
           const double       offset,
           const Temperature &temperature = {}) const;

  private:
    struct PlacedLayer
    {
      OrthotropicMaterial material;
      /** Strains in the axes 1, 2 to those along and across the fibres. */
      VoigtMatrix<> to_ply;
      /** Q along and across the fibres. */
      VoigtMatrix<> Q;
      /** Heights above the middle; the whole is 1 thick. */
      double bottom, top;
    };

    std::vector<PlacedLayer> layers_;
    /** A, B, D of the thickness 1 about the middle. */
    SectionStiffness unit_;
    bool             is_symmetric_ = true;
  };
} // namespace Nacre

#endif
