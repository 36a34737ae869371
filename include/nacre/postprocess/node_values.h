// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_node_values_h
#define nacre_postprocess_node_values_h

#include <nacre/postprocess/shell_state.h>

#include <string>

namespace Nacre
{
  /**
   * Write the positions and displacements of all nodes (length), each node
   * once, to the file @p name, in lines x,y,z,ux,uy,uz: what
   * 'Mid-surface/Imperfection/Modes' reads. Collective.
   */
  void
  write_node_values(const ShellState &shell, const std::string &name);
} // namespace Nacre

#endif
