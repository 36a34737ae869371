// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/shell_section.h>

namespace Nacre
{
  ShellSection::ShellSection()
    : ParameterAcceptor("/Section")
  {
    add_parameter("Type",
                  type_,
                  "isotropic: a homogeneous section of the values below; "
                  "laminate: a stack of orthotropic plies, by the subsection "
                  "Laminate alone; neo-Hookean: an incompressible material of "
                  "large strains, by the subsection Neo-Hookean and the "
                  "thickness and density below; elastoplastic: the isotropic "
                  "section, whose layers yield, by the subsection Plasticity. "
                  "The last two need an analysis that iterates, and "
                  "'Discretization/Kinematics = finite' or 'linear'.",
                  prm,
                  Patterns::Selection(
                    "isotropic|laminate|neo-Hookean|elastoplastic"));
  }

  void
  ShellSection::prepare(const Constants &constants)
  {
    AssertThrow(type_ != "laminate" || !isotropic_.has_regions(),
                ExcMessage("Section/Regions: these are regions of isotropic "
                           "sections; for 'Type = laminate' use "
                           "'Section/Laminate/Regions'."));
    AssertThrow(type_ != "neo-Hookean" || !isotropic_.has_regions(),
                ExcMessage("Section/Regions: these are regions of isotropic "
                           "sections; for 'Type = neo-Hookean' thickness and "
                           "shear modulus may be expressions of x, y, z."));
    choose();
    chosen_->prepare(constants);
    Constants known = constants;
    for (const auto &[name, value] : chosen_->named_constants())
      known.emplace(name, value);
    initial_strain_.prepare(known, chosen_ == &laminate_);
  }

  InitialForces
  ShellSection::initial_forces(const SurfaceFrame<> &frame,
                               const SectionPoint   &point,
                               const Instant        &instant) const
  {
    const auto initial = initial_strain_.at(frame, point, instant);
    const auto answer =
      chosen_->response(initial.membrane, initial.bending, frame, point);
    InitialForces result{answer.membrane_force, answer.moment};
    result.membrane_energy = 0.5 * (result.membrane_force * initial.membrane);
    result.bending_energy  = 0.5 * (result.moment * initial.bending);
    if (chosen_ != &laminate_ || !initial_strain_.has_temperature())
      return result;
    const InitialForces thermal =
      laminate_.thermal_forces(initial.temperature, frame, point);
    result.membrane_energy += thermal.membrane_energy +
                              thermal.membrane_force * initial.membrane +
                              thermal.moment * initial.bending;
    result.membrane_force += thermal.membrane_force;
    result.moment += thermal.moment;
    return result;
  }

  Voigt<>
  ShellSection::stress_at(const Instant        &instant,
                          const Voigt<>        &membrane_strain,
                          const Voigt<>        &bending_strain,
                          const double          side,
                          const SurfaceFrame<> &frame,
                          const SectionPoint   &point,
                          const SectionState   &state) const
  {
    if (!has_initial_strain())
      return chosen_->stress_at(instant,
                                membrane_strain,
                                bending_strain,
                                side,
                                frame,
                                point,
                                state);
    const auto initial = initial_strain_.at(frame, point, instant);
    const auto eps     = membrane_strain - initial.membrane;
    const auto rho     = bending_strain - initial.bending;
    return chosen_ == &laminate_ ?
             laminate_
               .stress(eps, rho, side, frame, point, initial.temperature) :
             chosen_->stress(eps, rho, side, frame, point);
  }

  std::vector<LayerState>
  ShellSection::layers_at(const Instant        &instant,
                          const Voigt<>        &membrane_strain,
                          const Voigt<>        &bending_strain,
                          const SurfaceFrame<> &frame,
                          const SectionPoint   &point,
                          const SectionState   &state) const
  {
    if (!has_initial_strain() || chosen_ != &laminate_)
      return chosen_->layers_at(instant,
                                membrane_strain,
                                bending_strain,
                                frame,
                                point,
                                state);
    const auto initial = initial_strain_.at(frame, point, instant);
    return laminate_.layers(membrane_strain - initial.membrane,
                            bending_strain - initial.bending,
                            frame,
                            point,
                            initial.temperature);
  }

  void
  ShellSection::choose()
  {
    if (type_ == "laminate")
      chosen_ = &laminate_;
    else if (type_ == "neo-Hookean")
      chosen_ = &neo_hookean_;
    else if (type_ == "elastoplastic")
      chosen_ = &elastoplastic_;
    else
      chosen_ = &isotropic_;
  }
} // namespace Nacre
