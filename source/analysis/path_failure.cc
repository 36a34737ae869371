// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/path_failure.h>

namespace Nacre
{
  namespace
  {
    /** For a path that has no equilibrium, or several, nearby. */
    std::string
    other_analysis(const PathParameters &parameters)
    {
      switch (parameters.type)
        {
          case AnalysisType::dynamic:
            return parameters.scheme == TimeScheme::energy_momentum ?
                     "a finer mesh where the shell crumples" :
                     "'Scheme = energy momentum', which gains no energy";
          case AnalysisType::arc_length:
            return "a finer mesh or a smaller 'Analysis/Maximum time step' "
                   "where the path turns sharply";
          case AnalysisType::displacement_control:
            return "'Type = arc length' where the controlled quantity turns "
                   "back or the loads hardly change it, or a smaller "
                   "'Analysis/Control step'";
          case AnalysisType::relaxation:
            return "'Type = dynamic'";
          default:
            return "'Type = arc length', 'relaxation' or 'dynamic' if the path "
                   "has a limit or bifurcation point there";
        }
    }
  } // namespace

  std::string
  remedy(const FailureKind kind, const PathParameters &parameters)
  {
    switch (kind)
      {
        case FailureKind::impossible_deformation:
          return "Try a finer mesh or a higher degree there: a cell can't "
                 "follow a sharp bend; or " +
                 other_analysis(parameters) + ".";
        case FailureKind::singular_tangent:
          return "The shell, or a part of it, may move freely in that state, "
                 "its cells may be too thin, or the path bifurcates there: "
                 "prescribe more, or try " +
                 other_analysis(parameters) + ".";
        case FailureKind::constant_quantity:
          return "No step is small enough: 'Analysis/Control' needs a quantity "
                 "that the loads change in that state. What begins with their "
                 "square, as an energy, can be controlled from a loaded state "
                 "on: 'Analysis/Start from'.";
        case FailureKind::not_finite:
          return "Cells collapse, or the loads or the stiffness are of an "
                 "extreme size: check their units, or try a finer mesh.";
        case FailureKind::no_stable_state:
          return "Try more 'Analysis/Maximum iterations', or " +
                 other_analysis(parameters) + ".";
        default:
          return "Try a smaller 'Analysis/Minimum time step', or " +
                 other_analysis(parameters) + ".";
      }
  }
} // namespace Nacre
