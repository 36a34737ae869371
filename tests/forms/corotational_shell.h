// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_corotational_shell_h
#define nacre_tests_corotational_shell_h

// A shell from parameters, and its tangent, for tests of large rotations.

#include "../tests_common.h"
#include <nacre/problem/midsurface.h>

using namespace Tests;

inline AffineConstraints<double>
no_constraints()
{
  AffineConstraints<double> constraints;
  constraints.close();
  return constraints;
}

inline KinematicsOptions
corotational(const MembraneStrain membrane_strain,
             const TangentType    tangent = TangentType::consistent)
{
  return {membrane_strain,
          EdgeForm::rotation_jump,
          KinematicsModel::corotational,
          tangent};
}

inline std::string
case_name(const Element &element, const MembraneStrain strain)
{
  return name_of(element.type) + " " + std::to_string(element.degree) + ", " +
         name_of(strain) + ": ";
}

inline const std::string edges_parameter = "subsection Boundary conditions\n"
                                           " set Edges = ";

/** A shell from the text of a parameter file. */
struct Shell
{
  Shell(const std::string &text, const Element &element)
    : parameters(text)
    , midsurface(&parameters.model.midsurface)
    , conditions(&parameters.model.supports)
    , loads(&parameters.model.loads)
    , section(parameters.model.section.get())
  {
    discretization = std::make_unique<Discretization>(*midsurface,
                                                      MPI_COMM_WORLD,
                                                      element,
                                                      0,
                                                      0);
  }

  std::unique_ptr<Assembly>
  make_operator(const KinematicsOptions &options, const double eta = 7.) const
  {
    return std::make_unique<Assembly>(
      *discretization,
      ShellParts(*section, *conditions, *loads, options, eta));
  }

  TextModel                       parameters;
  const Midsurface               *midsurface;
  const BoundaryConditions       *conditions;
  const Loads                    *loads;
  const SectionLaw               *section;
  std::unique_ptr<Discretization> discretization;
};

inline TrilinosVector
zero_vector(const Discretization &discretization)
{
  return TrilinosVector(discretization.locally_owned_dofs(), MPI_COMM_WORLD);
}

/** The tangent and the residual at @p u, constrained dofs included. */
inline std::pair<FullMatrix<double>, Vector<double>>
dense_tangent(const Discretization            &discretization,
              const Assembly                  &assembly,
              const TrilinosVector            &u,
              const AffineConstraints<double> &constraints = no_constraints())
{
  TrilinosWrappers::SparseMatrix matrix;
  auto                           force = zero_vector(discretization);
  assembly.reinit_matrix(constraints, matrix);
  assembly.assemble(u, constraints, matrix, force);
  const unsigned int                            n = matrix.m();
  std::pair<FullMatrix<double>, Vector<double>> dense;
  dense.first.reinit(n, n);
  dense.second.reinit(n);
  for (unsigned int i = 0; i < n; ++i)
    {
      for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
        dense.first(i, entry->column()) = entry->value();
      dense.second[i] = -force(i);
    }
  return dense;
}

#endif
