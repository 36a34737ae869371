// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/cut_growth.h>
#include <nacre/simulation/lip_release.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Nacre
{
  double
  rayleigh_speed(const SectionLaw   &section,
                 const SectionPoint &x,
                 const Tensor<1, 3> &e_1,
                 const Tensor<1, 3> &e_2)
  {
    const auto frame =
      make_surface_frame(e_1, e_2, std::array<Tensor<1, 3>, 3>());
    const auto   A  = section.stiffness(frame, x).membrane;
    const double nu = A[0][1] / A[0][0];
    const double shear_speed =
      std::sqrt(A[2][2] / (section.density(x) * section.thickness(x)));
    // Viktorov, Rayleigh and Lamb Waves (1967)
    return shear_speed * (0.862 + 1.14 * nu) / (1. + nu);
  }

  double
  release_time(const ShellProblem            &problem,
               const Discretization          &discretization,
               const std::vector<GrowingTip> &before,
               const std::vector<GrowingTip> &after)
  {
    if (problem.growth.release_time)
      return *problem.growth.release_time;
    AssertDimension(before.size(), after.size());
    double longest = 0.;
    for (unsigned int k = 0; k < before.size(); ++k)
      {
        const double advance = after[k].advanced - before[k].advanced;
        if (advance <= 0.)
          continue;
        const auto &ends = discretization.tips();
        const auto  end =
          std::find_if(ends.begin(), ends.end(), [&](const auto &tip) {
            return tip.cut == before[k].end.cut &&
                   tip.at_end == before[k].end.at_end;
          });
        Assert(end != ends.end(), ExcInternalError());
        const auto place = discretization.nearest(end->position);
        const auto region =
          Utilities::MPI::max(place.is_mine ? place.part.cell->material_id() :
                                              0u,
                              discretization.communicator());
        const auto   axes  = tip_axes(discretization, *end);
        const double speed = rayleigh_speed(*problem.model.section,
                                            {end->position, region},
                                            axes[0],
                                            axes[1]);
        longest            = std::max(longest, advance / speed);
      }
    return longest;
  }
} // namespace Nacre
