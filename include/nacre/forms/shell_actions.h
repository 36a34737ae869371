// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_shell_actions_h
#define nacre_forms_shell_actions_h

#include <nacre/base/instant.h>
#include <nacre/forms/prescribed_rotation.h>

#include <map>
#include <utility>
#include <vector>

namespace Nacre
{
  /** Prescribed rotations at an edge's points, by cell index and face. */
  using PrescribedRotations = std::map<std::pair<unsigned int, unsigned int>,
                                       std::vector<PrescribedRotation>>;

  /**
   * What acts on a shell beside prescribed displacements, which are
   * constraints: Assembly::actions().
   */
  struct ShellActions
  {
    /** Of the loads. */
    Instant loads;
    /** Of this rank's edges, at the same time or in a step at another. */
    PrescribedRotations rotations;
  };
} // namespace Nacre

#endif
