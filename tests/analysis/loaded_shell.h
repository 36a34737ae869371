// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_loaded_shell_h
#define nacre_tests_loaded_shell_h

#include "../tests_common.h"
#include <nacre/problem/midsurface.h>

namespace Tests
{
  /** The shell of a parameter text at p = 2, with finite rotations or without,
   * whose forces are compared with differences. */
  struct LoadedShell
  {
    LoadedShell(const std::string    &text,
                const KinematicsModel kinematics,
                const unsigned int    n_refinements)
      : parameters(text)
      , model(prepare(parameters.model, kinematics))
      , discretization(model.midsurface,
                       MPI_COMM_WORLD,
                       Element{ElementType::lagrange, 2},
                       n_refinements,
                       0)
      , assembly(discretization, model)
    {}

    /** A direction in which no entry is like another. */
    TrilinosVector
    direction() const
    {
      TrilinosVector result(discretization.locally_owned_dofs(),
                            MPI_COMM_WORLD);
      for (const auto i : discretization.locally_owned_dofs())
        result(i) = std::sin(1. + 3. * i);
      result.compress(VectorOperation::insert);
      return result;
    }

  private:
    static ShellModel &
    prepare(ShellModel &model, const KinematicsModel kinematics)
    {
      model.kinematics.model   = kinematics;
      model.kinematics.tangent = TangentType::consistent;
      model.eta                = 5.;
      return model;
    }

    TextModel parameters;

  public:
    ShellModel          &model;
    const Discretization discretization;
    const Assembly       assembly;
  };
} // namespace Tests

#endif
