// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_path_failure_h
#define nacre_analysis_path_failure_h

#include <nacre/analysis/path_parameters.h>
#include <nacre/solvers/step_failure.h>

#include <string>

namespace Nacre
{
  /** What helps a path that steps of any size can't continue. */
  std::string
  remedy(const FailureKind kind, const PathParameters &parameters);
} // namespace Nacre

#endif
