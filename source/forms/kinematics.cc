// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/averaged_normal_kinematics.h>
#include <nacre/forms/corotational_kinematics.h>
#include <nacre/forms/finite_kinematics.h>

#include <tuple>

namespace Nacre
{
  Energies &
  Energies::operator+=(const Energies &other)
  {
    membrane += other.membrane;
    bending += other.bending;
    edge += other.edge;
    foundation += other.foundation;
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
    energies      = Energies();
    rotation_work = 0.;
  }

  namespace
  {
    Vector<double>
    mean(const Vector<double> &start, const Vector<double> &end)
    {
      Vector<double> result(start);
      result.sadd(0.5, 0.5, end);
      return result;
    }
  } // namespace

  void
  Kinematics::add_cell_step_terms(const CellPart       &part,
                                  const Vector<double> &u_start,
                                  const Vector<double> &u_end,
                                  LocalTerms           &terms)
  {
    const Energies energies = terms.energies;
    add_cell_terms(part, mean(u_start, u_end), terms);
    terms.energies = energies;
  }

  void
  Kinematics::add_edge_step_terms(const ShellEdgeValues &edge,
                                  const double           penalty,
                                  const Vector<double>  &u_start,
                                  const Vector<double>  &u_end,
                                  LocalTerms            &terms)
  {
    const Energies energies = terms.energies;
    add_edge_terms(edge, penalty, mean(u_start, u_end), terms);
    terms.energies = energies;
  }

  void
  Kinematics::add_rotation_step_terms(
    const ShellEdgeValues                 &edge,
    const double                           penalty,
    const std::vector<PrescribedRotation> &rotation_start,
    const std::vector<PrescribedRotation> &rotation_end,
    const Vector<double>                  &u_start,
    const Vector<double>                  &u_end,
    LocalTerms                            &terms)
  {
    std::vector<PrescribedRotation> rotation;
    for (unsigned int q = 0; q < rotation_start.size(); ++q)
      rotation.push_back(mean_rotation(rotation_start[q], rotation_end[q]));
    LocalTerms step;
    step.wants_tangent = terms.wants_tangent;
    step.reinit(u_start.size());
    add_rotation_terms(edge, penalty, rotation, mean(u_start, u_end), step);
    terms.residual += step.residual;
    if (terms.wants_tangent)
      terms.tangent.add(1., step.tangent);
    // What the energy changes by and the forces don't do
    LocalTerms start, end;
    for (const auto &[ends_terms, ends_rotation, ends_u] :
         {std::make_tuple(&start, &rotation_start, &u_start),
          std::make_tuple(&end, &rotation_end, &u_end)})
      {
        ends_terms->wants_tangent = false;
        ends_terms->reinit(u_start.size());
        add_rotation_terms(edge, penalty, *ends_rotation, *ends_u, *ends_terms);
      }
    Vector<double> change(u_end);
    change -= u_start;
    terms.rotation_work +=
      end.energies.total() - start.energies.total() - step.residual * change;
  }

  namespace
  {
    /**
     * Membrane strains of two rules would have to meet one bending strain: but
     * for LinearKinematics nobody has written that, since tied strains do
     * better.
     */
    void
    refuse_blended_coupling(const Element           &element,
                            const SectionLaw        &section,
                            const KinematicsOptions &options)
    {
      AssertThrow(!section.is_coupled() ||
                    !blends_integration(element, options.membrane_strain),
                  ExcMessage(
                    "Discretization/Membrane strain: reduced: in large "
                    "rotations, and for laws that aren't linear, it has no "
                    "terms for sections that couple membrane forces and "
                    "bending; use tied."));
    }

    /** Only FiniteKinematics asks a section at the strains of now. */
    void
    check_nonlinear(const SectionLaw &section, const KinematicsOptions &options)
    {
      if (section.is_linear())
        return;
      AssertThrow(!section.has_initial_strain(),
                  ExcMessage("Section/Initial strain: a section whose law "
                             "isn't linear has no terms for it; leave it "
                             "empty, or choose another 'Section/Type'."));
      AssertThrow(options.model != KinematicsModel::corotational,
                  ExcMessage("Discretization/Kinematics: '" +
                             name_of(options.model) +
                             "' is for linear sections only, and the law of "
                             "this section isn't; choose finite, or linear "
                             "for small displacements."));
      AssertThrow(section.is_coupled(),
                  ExcMessage("Section: a law that isn't linear must be said to "
                             "couple membrane forces and bending."));
    }
  } // namespace

  std::unique_ptr<Kinematics>
  make_kinematics(const Discretization    &discretization,
                  const SectionLaw        &section,
                  const KinematicsOptions &options,
                  SectionStates           *states)
  {
    check_nonlinear(section, options);
    if (options.edge_form == EdgeForm::averaged_normal)
      {
        AssertThrow(
          !section.is_coupled(),
          ExcMessage(
            "Discretization/Edge form: averaged normal: it has no terms for "
            "sections that couple membrane forces and bending; use rotation "
            "jump."));
        return std::make_unique<AveragedNormalKinematics>(
          discretization,
          section,
          options.membrane_strain);
      }
    if (options.model == KinematicsModel::corotational)
      {
        refuse_blended_coupling(discretization.element(), section, options);
        return std::make_unique<CorotationalKinematics>(discretization,
                                                        section,
                                                        options.membrane_strain,
                                                        options.tangent);
      }
    const bool is_finite = options.model == KinematicsModel::finite;
    if (is_finite || !section.is_linear())
      {
        AssertThrow(!is_finite || options.tangent != TangentType::frozen,
                    ExcMessage("Discretization/Tangent: 'frozen' is of the "
                               "co-rotational form; 'Kinematics = finite' has "
                               "the exact one only: choose 'symmetric'."));
        refuse_blended_coupling(discretization.element(), section, options);
        return std::make_unique<FiniteKinematics>(discretization,
                                                  section,
                                                  is_finite ?
                                                    StrainMeasure::green :
                                                    StrainMeasure::linear,
                                                  options.membrane_strain,
                                                  options.tangent,
                                                  states);
      }
    return std::make_unique<LinearKinematics>(discretization,
                                              section,
                                              options.membrane_strain);
  }
} // namespace Nacre
