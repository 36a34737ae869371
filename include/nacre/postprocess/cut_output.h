// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_cut_output_h
#define nacre_postprocess_cut_output_h

#include <nacre/discretization/discretization.h>

#include <string>

namespace Nacre
{
  /**
   * Write the cuts of the undeformed mesh as lines, NAME.vtu with the field
   * `cut`, the number of the cut, from 1. Nothing is written without cuts.
   * Collective; throws if the file can't be written.
   * @param name of the file, with its folder
   */
  void
  write_cut_lines(const Discretization &discretization,
                  const std::string    &name);
} // namespace Nacre

#endif
