// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/averaged_normal_kinematics.h>
#include <nacre/forms/corotational_kinematics.h>

namespace Nacre
{
  const std::vector<std::string> &
  membrane_strain_names()
  {
    static const std::vector<std::string> names = {"tied", "full", "reduced"};
    return names;
  }

  bool
  recovers_tied_strain(const MembraneStrain membrane_strain)
  {
    return membrane_strain != MembraneStrain::full;
  }

  const std::vector<std::string> &
  edge_form_names()
  {
    static const std::vector<std::string> names = {"hinge", "averaged normal"};
    return names;
  }

  const std::vector<std::string> &
  kinematics_model_names()
  {
    static const std::vector<std::string> names = {"linear", "corotational"};
    return names;
  }

  const std::vector<std::string> &
  tangent_type_names()
  {
    static const std::vector<std::string> names = {"frozen",
                                                   "symmetric",
                                                   "consistent"};
    return names;
  }

  Energies &
  Energies::operator+=(const Energies &other)
  {
    membrane += other.membrane;
    bending += other.bending;
    edge += other.edge;
    return *this;
  }

  Quadrature<dim>
  cell_quadrature(const Element &element, const MembraneStrain membrane_strain)
  {
    return membrane_strain == MembraneStrain::reduced &&
               element.type != ElementType::lagrange ?
             element.reduced_quadrature() :
             element.full_quadrature();
  }

  bool
  blends_integration(const Element       &element,
                     const MembraneStrain membrane_strain)
  {
    return membrane_strain == MembraneStrain::reduced &&
           element.type == ElementType::lagrange;
  }

  MembraneStrain
  default_membrane_strain(const ElementType element)
  {
    return element == ElementType::serendipity ? MembraneStrain::reduced :
                                                 MembraneStrain::tied;
  }

  void
  LocalTerms::reinit(const unsigned int n_dofs)
  {
    if (wants_tangent)
      tangent.reinit(n_dofs, n_dofs);
    residual.reinit(n_dofs);
    energies = Energies();
  }

  std::unique_ptr<Kinematics>
  make_kinematics(const Discretization    &discretization,
                  const SectionLaw        &section,
                  const KinematicsOptions &options)
  {
    if (options.edge_form == EdgeForm::averaged_normal)
      return std::make_unique<AveragedNormalKinematics>(
        discretization,
        section,
        options.membrane_strain);
    if (options.model == KinematicsModel::corotational)
      return std::make_unique<CorotationalKinematics>(discretization,
                                                      section,
                                                      options.membrane_strain,
                                                      options.tangent);
    return std::make_unique<LinearKinematics>(discretization,
                                              section,
                                              options.membrane_strain);
  }
} // namespace Nacre
