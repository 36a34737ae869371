// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_shell_section_h
#define nacre_mechanics_shell_section_h

#include <nacre/mechanics/elastoplastic_section.h>
#include <nacre/mechanics/initial_strain.h>
#include <nacre/mechanics/laminate_section.h>
#include <nacre/mechanics/linear_elastic_section.h>
#include <nacre/mechanics/neo_hookean_section.h>

namespace Nacre
{
  /** The section that 'Section/Type' chooses. */
  class ShellSection
    : public SectionLaw
    , public ParameterAcceptor
  {
  public:
    ShellSection();

    void
    prepare(const Constants &constants) override;

    void
    set_thickness(const double thickness) override
    {
      choose();
      chosen_->set_thickness(thickness);
    }

    Constants
    named_constants() const override
    {
      return chosen_->named_constants();
    }

    void
    set_regions(const MeshRegions &mesh) override
    {
      chosen_->set_regions(mesh);
      initial_strain_.set_regions(mesh);
    }

    double
    thickness(const SectionPoint &point) const override
    {
      return chosen_->thickness(point);
    }

    double
    density(const SectionPoint &point) const override
    {
      return chosen_->density(point);
    }

    unsigned int
    n_state_variables() const override
    {
      return chosen_->n_state_variables();
    }

    using SectionLaw::response;

    SectionResponse
    response(const Voigt<>        &membrane_strain,
             const Voigt<>        &bending_strain,
             const SurfaceFrame<> &frame,
             const SectionPoint   &point,
             const SectionState   &state) const override
    {
      return chosen_->response(membrane_strain,
                               bending_strain,
                               frame,
                               point,
                               state);
    }

    void
    update_state(const Voigt<>           &membrane_strain,
                 const Voigt<>           &bending_strain,
                 const SurfaceFrame<>    &frame,
                 const SectionPoint      &point,
                 const ArrayView<double> &state) const override
    {
      chosen_->update_state(membrane_strain,
                            bending_strain,
                            frame,
                            point,
                            state);
    }

    SectionStiffness
    stiffness(const SurfaceFrame<> &frame,
              const SectionPoint   &point) const override
    {
      return chosen_->stiffness(frame, point);
    }

    bool
    is_linear() const override
    {
      return chosen_->is_linear();
    }

    bool
    is_coupled() const override
    {
      return chosen_->is_coupled();
    }

    Voigt<>
    stress(const Voigt<>        &membrane_strain,
           const Voigt<>        &bending_strain,
           const double          side,
           const SurfaceFrame<> &frame,
           const SectionPoint   &point) const override
    {
      return chosen_->stress(membrane_strain,
                             bending_strain,
                             side,
                             frame,
                             point);
    }

    std::vector<LayerState>
    layers(const Voigt<>        &membrane_strain,
           const Voigt<>        &bending_strain,
           const SurfaceFrame<> &frame,
           const SectionPoint   &point) const override
    {
      return chosen_->layers(membrane_strain, bending_strain, frame, point);
    }

    unsigned int
    n_layers() const override
    {
      return chosen_->n_layers();
    }

    bool
    has_initial_strain() const override
    {
      return !initial_strain_.is_zero();
    }

    InitialForces
    initial_forces(const SurfaceFrame<> &frame,
                   const SectionPoint   &point,
                   const Instant        &instant) const override;

    Voigt<>
    stress_at(const Instant        &instant,
              const Voigt<>        &membrane_strain,
              const Voigt<>        &bending_strain,
              const double          side,
              const SurfaceFrame<> &frame,
              const SectionPoint   &point,
              const SectionState   &state) const override;

    std::vector<LayerState>
    layers_at(const Instant        &instant,
              const Voigt<>        &membrane_strain,
              const Voigt<>        &bending_strain,
              const SurfaceFrame<> &frame,
              const SectionPoint   &point,
              const SectionState   &state) const override;

  private:
    /** Set chosen_ from the parameter, which may have changed. */
    void
    choose();

    std::string          type_ = "isotropic";
    LinearElasticSection isotropic_;
    LaminateSection      laminate_;
    NeoHookeanSection    neo_hookean_{isotropic_};
    ElastoplasticSection elastoplastic_{isotropic_};
    SectionLaw          *chosen_ = &isotropic_;

    InitialStrainParameters initial_strain_;
  };
} // namespace Nacre

#endif
