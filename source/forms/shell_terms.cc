// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/orientation.h>
#include <nacre/forms/foundation_term.h>
#include <nacre/forms/load_terms.h>
#include <nacre/forms/shell_terms.h>
#include <nacre/forms/stiffness_terms.h>
#include <nacre/problem/foundation.h>
#include <nacre/problem/shell_model.h>

namespace Nacre
{
  ShellParts::ShellParts(const ShellModel &model)
    : section(*model.section)
    , supports(model.supports)
    , loads(model.loads)
    , kinematics(model.kinematics)
    , eta(model.eta)
    , load_factor(model.load_factor ? &*model.load_factor : nullptr)
    , foundation(&model.foundation)
  {}

  ShellParts::ShellParts(const SectionLaw            &section,
                         const BoundaryConditions    &supports,
                         const Loads                 &loads,
                         const KinematicsOptions     &kinematics,
                         const std::optional<double> &eta)
    : section(section)
    , supports(supports)
    , loads(loads)
    , kinematics(kinematics)
    , eta(eta)
  {}

  Terms
  make_terms(const Discretization &discretization,
             const ShellParts     &parts,
             const TermSelection   selection)
  {
    const Loads &loads     = parts.loads;
    const bool   has_sides = loads.has_pressure() || loads.has_lip_loads();
    AssertThrow(!has_sides || is_consistently_oriented(discretization),
                ExcMessage(loads.has_pressure() ?
                             "Loads/Pressure: neighbouring cells have opposite "
                             "normals, so that a pressure has no direction; "
                             "use Force per area." :
                             "Loads/Lip forces, Lip moments, Lip pressures: "
                             "neighbouring cells have opposite normals, so "
                             "that a cut has no left side; orient the cells "
                             "of the mesh alike."));
    Terms terms;
    terms.push_back(std::make_unique<StrainTerm>());
    terms.push_back(std::make_unique<RotationJumpTerm>());
    terms.push_back(std::make_unique<PrescribedRotationTerm>());
    if (parts.foundation != nullptr && !parts.foundation->is_zero())
      terms.push_back(std::make_unique<FoundationTerm>(*parts.foundation));
    if (selection == TermSelection::all && !loads.no_surface_load())
      terms.push_back(std::make_unique<SurfaceLoadTerm>(parts.section, loads));
    if (loads.pressure_follows())
      terms.push_back(std::make_unique<FollowingPressureTerm>(loads));
    // Moments follow the surface: they have a tangent.
    terms.push_back(std::make_unique<EdgeLoadTerm>(loads));
    if (selection == TermSelection::all)
      terms.push_back(std::make_unique<PointForceTerm>(discretization, loads));
    return terms;
  }
} // namespace Nacre
