// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_finite_shell_h
#define nacre_tests_finite_shell_h

// What the tests of finite rotations share.

#include "../forms/rigid_motions.h"

inline KinematicsOptions
finite(const MembraneStrain membrane_strain,
       const TangentType    tangent = TangentType::consistent)
{
  return {membrane_strain,
          EdgeForm::rotation_jump,
          KinematicsModel::finite,
          tangent};
}

#endif
