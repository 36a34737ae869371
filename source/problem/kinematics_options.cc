// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/kinematics_options.h>

namespace Nacre
{
  const Selection<MembraneStrain> &
  selection(MembraneStrain)
  {
    static const Selection<MembraneStrain> table = {
      {MembraneStrain::tied, "tied"},
      {MembraneStrain::full, "full"},
      {MembraneStrain::reduced, "reduced"}};
    return table;
  }

  const Selection<EdgeForm> &
  selection(EdgeForm)
  {
    static const Selection<EdgeForm> table = {
      {EdgeForm::rotation_jump, "rotation jump"},
      {EdgeForm::averaged_normal, "averaged normal"}};
    return table;
  }

  const Selection<KinematicsModel> &
  selection(KinematicsModel)
  {
    static const Selection<KinematicsModel> table = {
      {KinematicsModel::linear, "linear"},
      {KinematicsModel::corotational, "corotational"},
      {KinematicsModel::finite, "finite"}};
    return table;
  }

  const Selection<TangentType> &
  selection(TangentType)
  {
    static const Selection<TangentType> table = {
      {TangentType::frozen, "frozen"},
      {TangentType::symmetric, "symmetric"},
      {TangentType::consistent, "consistent"}};
    return table;
  }

  bool
  recovers_tied_strain(const MembraneStrain membrane_strain)
  {
    return membrane_strain != MembraneStrain::full;
  }
} // namespace Nacre
