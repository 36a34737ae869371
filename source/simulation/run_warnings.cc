// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/expression.h>
#include <nacre/base/log.h>
#include <nacre/discretization/discretization.h>
#include <nacre/simulation/problem_record.h>
#include <nacre/simulation/run_warnings.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace Nacre
{
  void
  warn_of_linear_path(Log &log)
  {
    log.warning("Discretization/Kinematics: linear, which holds for small "
                "displacements and rotations only, all along the path; "
                "'finite' and 'corotational' follow large ones.");
  }

  void
  warn_of_large_displacements(const Discretization &discretization,
                              const TrilinosWrappers::MPI::Vector &displacement,
                              Log                                 &log)
  {
    double largest = 0.;
    for (const auto i : discretization.locally_owned_dofs())
      largest = std::max(largest, std::abs(displacement(i)));
    largest = Utilities::MPI::max(largest, discretization.communicator());
    const double size = discretization.extent().second;
    if (largest <= size)
      return;
    std::ostringstream text;
    text << std::setprecision(3) << "Discretization/Kinematics: a displacement"
         << " of " << largest << " is larger than the shell, " << size
         << "; linear kinematics holds for small displacements only. Are the "
            "units of loads and section the same? 'finite' and 'corotational', "
            "with an 'Analysis/Type' other than linear, follow large "
            "rotations.";
    log.warning(text.str());
  }

  void
  warn_of_load_factor(const Expression    &load_factor,
                      const ProblemRecord &problem,
                      Log                 &log)
  {
    if (load_factor.is_constant())
      return;
    std::string found;
    for (const auto *const section :
         {"Loads", "Boundary conditions", "Section/Initial strain"})
      if (mentions(problem, section, "t"))
        found += (found.empty() ? "'" : " and '") + std::string(section) + "'";
    if (found.empty())
      return;
    const auto &factor = problem.parameters.at("Analysis/Load factor");
    log.warning("Analysis/Load factor: '" + factor + "'" +
                (factor == "default" ? ", which is t," : "") +
                " multiplies values of " + found +
                " that depend on t themselves. 'Load factor = 1' takes them "
                "as they are.");
  }
} // namespace Nacre
