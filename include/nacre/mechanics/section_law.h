// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_section_law_h
#define nacre_mechanics_section_law_h

#include <nacre/base/instant.h>
#include <nacre/mechanics/surface_frame.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/types.h>

#include <array>
#include <optional>
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

  /**
   * The tangent of a section, covariant basis, Voigt [resultant][strain]:
   *   dn = A deps + B drho,   dm = B^T deps + D drho.
   */
  struct SectionStiffness
  {
    /** A: membrane forces n^ab from membrane strains (H_n, (8)). */
    VoigtMatrix<> membrane;
    /** D: moments m^ab from bending strains (H_m, (9)). */
    VoigtMatrix<> bending;
    /** B: membrane forces from bending strains; zero if not coupled. */
    VoigtMatrix<> coupling = {};
  };

  /**
   * What a section remembers at a point: numbers whose meaning its law knows,
   * as many as n_state_variables(). Zeros are the state at rest, of a point
   * that was never loaded; an empty view stands for zeros.
   */
  using SectionState = ArrayView<const double>;

  /** What a section answers to strains; covariant basis, Voigt. */
  struct SectionResponse
  {
    /** n^ab (force/length^3 in the covariant basis). */
    Voigt<> membrane_force;
    /** m^ab (force/length^2 in the covariant basis). */
    Voigt<> moment;
    /** A, B, D at these strains. */
    SectionStiffness tangent;
    /** w per area of the undeformed surface (force/length). */
    double energy = 0.;
  };

  /**
   * What stands against initial strains that are held: the resultants of the
   * strains E, kappa are those of response() less these, and the energy is that
   * of response() less E : n0 + kappa : m0, plus these energies.
   */
  struct InitialForces
  {
    /** n0^ab and m0^ab, as SectionResponse. */
    Voigt<> membrane_force;
    Voigt<> moment;
    /** Per area (force/length). */
    double membrane_energy = 0.;
    double bending_energy  = 0.;
  };

  /** How much warmer a section is than without stress. */
  struct Temperature
  {
    /** At the reference surface (temperature). */
    double mean = 0.;
    /** Along t0 (temperature/length). */
    double gradient = 0.;
  };

  /**
   * The strains and stresses of a layer of a section at its lower and upper
   * face, in the axes 1, 2 of its material, Voigt (11, 22, 2 * 12) and
   * (11, 22, 12).
   */
  struct LayerState
  {
    /** At the lower face and at the upper one. */
    std::array<Voigt<>, 2> strain, stress;
    /** Of both faces above the reference surface, along t0 (length). */
    std::array<double, 2> height{};
    /**
     * The larger of both faces' failure indices; 1 at failure. None if the
     * material has no strengths.
     */
    std::optional<double> tsai_wu, maximum_stress;
  };

  /**
   * The law of a section: how membrane forces and moments follow from strains.
   * To add a linear one, derive from LinearSectionLaw, otherwise from this
   * class; a ShellModel takes it. Parameter files have SectionParameters that
   * make it. A law is complete and doesn't change.
   *
   * Strains are those of the reference surface: a fibre at the distance z
   * along t0 has the strain eps + z rho.
   *
   * A law may have a state at each point, which is that of the start of a step
   * until update_state() replaces it at the step's end: what it answers within
   * a step depends on the strains alone, as if it were elastic.
   */
  class SectionLaw
  {
  public:
    virtual ~SectionLaw() = default;

    /** Thickness (length) at @p point; throws if it isn't positive. */
    virtual double
    thickness(const SectionPoint &point) const = 0;

    /** Mass per volume at @p point. */
    virtual double
    density(const SectionPoint &point) const = 0;

    /** Of how many numbers the state of a point consists. */
    virtual unsigned int
    n_state_variables() const
    {
      return 0;
    }

    /**
     * Membrane forces, moments, tangent and energy at @p point with the
     * surface's @p frame: n = dw/deps, m = dw/drho, and the tangent is the
     * second derivative of w, which is symmetric.
     * @param membrane_strain eps (e11, e22, 2 e12) (length^2)
     * @param bending_strain rho (r11, r22, 2 r12) (length)
     * @param state at the start of the step
     */
    virtual SectionResponse
    response(const Voigt<>        &membrane_strain,
             const Voigt<>        &bending_strain,
             const SurfaceFrame<> &frame,
             const SectionPoint   &point,
             const SectionState   &state) const = 0;

    /** In the state at rest. */
    SectionResponse
    response(const Voigt<>        &membrane_strain,
             const Voigt<>        &bending_strain,
             const SurfaceFrame<> &frame,
             const SectionPoint   &point) const
    {
      return response(membrane_strain,
                      bending_strain,
                      frame,
                      point,
                      SectionState());
    }

    /**
     * Replace @p state, that of the start of a step, by that of its end at
     * these strains, which response() takes.
     */
    virtual void
    update_state(const Voigt<> & /*membrane_strain*/,
                 const Voigt<> & /*bending_strain*/,
                 const SurfaceFrame<> & /*frame*/,
                 const SectionPoint & /*point*/,
                 const ArrayView<double> & /*state*/) const
    {}

    /**
     * What users see of the state, as "accumulated plastic strain": the names
     * of the numbers of state_results().
     */
    virtual std::vector<std::string>
    state_result_names() const
    {
      return {};
    }

    /** At z = @p side h/2 from the middle of the section, as stress(). */
    virtual std::vector<double>
    state_results(const double /*side*/, const SectionState & /*state*/) const
    {
      return {};
    }

    /**
     * What of the energy of response() has been dissipated on the way to the @p
     * state, per area of the undeformed surface (force/length).
     */
    virtual double
    dissipated_energy(const SectionPoint & /*point*/,
                      const SectionState & /*state*/) const
    {
      return 0.;
    }

    /** The tangent at rest; for linear laws at all strains. */
    virtual SectionStiffness
    stiffness(const SurfaceFrame<> &frame, const SectionPoint &point) const
    {
      return response(Voigt<>(), Voigt<>(), frame, point).tangent;
    }

    /** Whether the tangent is the same for all strains. */
    virtual bool
    is_linear() const = 0;

    /**
     * Whether B differs from zero anywhere. Forms that know it to be zero
     * save the terms that couple membrane and bending.
     */
    virtual bool
    is_coupled() const = 0;

    /**
     * The stress at z = @p side h/2 from the middle of the section, -1 <= side
     * <= 1 along t0, in the covariant basis, Voigt (force/length^4). Here that
     * of a homogeneous elastic section, n/h + 6 side m/h^2.
     */
    virtual Voigt<>
    stress(const Voigt<>        &membrane_strain,
           const Voigt<>        &bending_strain,
           const double          side,
           const SurfaceFrame<> &frame,
           const SectionPoint   &point) const;

    /**
     * The state of the layers, bottom to top; none if the section is
     * homogeneous.
     */
    virtual std::vector<LayerState>
    layers(const Voigt<> & /*membrane_strain*/,
           const Voigt<> & /*bending_strain*/,
           const SurfaceFrame<> & /*frame*/,
           const SectionPoint & /*point*/) const
    {
      return {};
    }

    /**
     * @name Initial strains, as of a temperature: none by default
     *
     * The functions above know nothing of them; SectionAt does.
     */
    //@{
    virtual bool
    has_initial_strain() const
    {
      return false;
    }

    virtual InitialForces
    initial_forces(const SurfaceFrame<> & /*frame*/,
                   const SectionPoint & /*point*/,
                   const Instant & /*instant*/) const
    {
      return {};
    }

    /**
     * stress() and layers() with the initial strains of @p instant and in
     * @p state, that of response(): laws with states override these.
     */
    virtual Voigt<>
    stress_at(const Instant & /*instant*/,
              const Voigt<>        &membrane_strain,
              const Voigt<>        &bending_strain,
              const double          side,
              const SurfaceFrame<> &frame,
              const SectionPoint   &point,
              const SectionState & /*state*/) const
    {
      return stress(membrane_strain, bending_strain, side, frame, point);
    }

    virtual std::vector<LayerState>
    layers_at(const Instant & /*instant*/,
              const Voigt<>        &membrane_strain,
              const Voigt<>        &bending_strain,
              const SurfaceFrame<> &frame,
              const SectionPoint   &point,
              const SectionState & /*state*/) const
    {
      return layers(membrane_strain, bending_strain, frame, point);
    }
    //@}

    /** The largest number of layers at any point. */
    virtual unsigned int
    n_layers() const
    {
      return 0;
    }
  };

  /**
   * A section at an instant: what it answers with its initial strains, in a
   * state, by default that at rest.
   */
  struct SectionAt
  {
    const SectionLaw &law;
    Instant           instant;

    SectionResponse
    response(const Voigt<>        &membrane_strain,
             const Voigt<>        &bending_strain,
             const SurfaceFrame<> &frame,
             const SectionPoint   &point,
             const SectionState   &state = {}) const;

    Voigt<>
    stress(const Voigt<>        &membrane_strain,
           const Voigt<>        &bending_strain,
           const double          side,
           const SurfaceFrame<> &frame,
           const SectionPoint   &point,
           const SectionState   &state = {}) const
    {
      return law.stress_at(instant,
                           membrane_strain,
                           bending_strain,
                           side,
                           frame,
                           point,
                           state);
    }

    std::vector<LayerState>
    layers(const Voigt<>        &membrane_strain,
           const Voigt<>        &bending_strain,
           const SurfaceFrame<> &frame,
           const SectionPoint   &point,
           const SectionState   &state = {}) const
    {
      return law.layers_at(instant,
                           membrane_strain,
                           bending_strain,
                           frame,
                           point,
                           state);
    }
  };

  /**
   * A linear law: n = A eps + B rho, m = B^T eps + D rho,
   * w = (n : eps + m : rho)/2, with the stiffness of the derived class.
   */
  class LinearSectionLaw : public SectionLaw
  {
  public:
    /** A, B, D at @p point with the surface's @p frame. */
    SectionStiffness
    stiffness(const SurfaceFrame<> &frame,
              const SectionPoint   &point) const override = 0;

    using SectionLaw::response;

    SectionResponse
    response(const Voigt<>        &membrane_strain,
             const Voigt<>        &bending_strain,
             const SurfaceFrame<> &frame,
             const SectionPoint   &point,
             const SectionState   &state) const override;

    bool
    is_linear() const override
    {
      return true;
    }

    /** Of laws without B; those with it say so. */
    bool
    is_coupled() const override
    {
      return false;
    }
  };
} // namespace Nacre

#endif
