// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/postprocess/refinement_marking.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    /**
     * The indicators of at least the largest threshold whose cells' @p amount,
     * summed over the ranks, reaches @p target: found by bisection, since no
     * rank knows all of them.
     */
    template <typename Amount>
    std::vector<bool>
    mark(const std::vector<double> &indicators,
         const double               target,
         const Amount              &amount,
         const MPI_Comm             communicator)
    {
      const double mine =
        indicators.empty() ?
          0. :
          *std::max_element(indicators.begin(), indicators.end());
      const double maximum = Utilities::MPI::max(mine, communicator);

      std::vector<bool> marked(indicators.size(), false);
      if (maximum == 0.)
        return marked;
      const auto reaches = [&](const double threshold) {
        double sum = 0.;
        for (const double indicator : indicators)
          if (indicator >= threshold)
            sum += amount(indicator);
        return Utilities::MPI::sum(sum, communicator) >= target;
      };
      double lower = 0., upper = maximum;
      if (reaches(upper))
        lower = upper;
      for (unsigned int k = 0; k < 200 && upper - lower > 1e-8 * upper; ++k)
        {
          const double middle               = 0.5 * (lower + upper);
          (reaches(middle) ? lower : upper) = middle;
        }
      for (unsigned int cell = 0; cell < indicators.size(); ++cell)
        marked[cell] =
          indicators[cell] > 0. && indicators[cell] >= (1. - 1e-6) * lower;
      return marked;
    }
  } // namespace

  std::vector<bool>
  RefinementMarking::bulk(const std::vector<double> &indicators,
                          const double               fraction,
                          const MPI_Comm             communicator)
  {
    double sum = 0.;
    for (const double indicator : indicators)
      sum += indicator;
    // Round-off of the sum must not call for the last cell.
    const double target =
      (1. - 1e-12) * fraction * Utilities::MPI::sum(sum, communicator);
    return mark(
      indicators,
      target,
      [](const double indicator) { return indicator; },
      communicator);
  }

  std::vector<bool>
  RefinementMarking::fixed_fraction(const std::vector<double>     &indicators,
                                    const double                   fraction,
                                    const types::global_cell_index n_cells,
                                    const MPI_Comm                 communicator)
  {
    return mark(
      indicators,
      std::max(1., std::round(fraction * n_cells)),
      [](const double) { return 1.; },
      communicator);
  }
} // namespace Nacre
