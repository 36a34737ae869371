// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/cpu_timer.h>
#include <nacre/simulation/buckling_analysis.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace Nacre
{
  namespace
  {
    template <typename T>
    std::vector<T>
    reordered(const std::vector<T>            &values,
              const std::vector<unsigned int> &order)
    {
      std::vector<T> result;
      for (const unsigned int k : order)
        result.push_back(values[k]);
      return result;
    }
  } // namespace

  void
  BucklingAnalysis::check_problem(DiscreteShell   &shell,
                                  const Prestress &prestress) const
  {
    check_number(Utilities::MPI::sum(
      free_dofs(shell, prestress.constraints()).n_elements(),
      communicator_));
    AssertThrow(start() != nullptr || prestress.acts(1.),
                ExcMessage("Loads: nothing acts on the shell at t = 1; "
                           "'Analysis/Type = buckling' needs a load, a "
                           "prescribed displacement, or 'Prestress = membrane "
                           "force'. 'Load factor' must not vanish there."));
  }

  void
  BucklingAnalysis::assemble(DiscreteShell   &shell,
                             const Prestress &prestress,
                             Matrix          &K,
                             Matrix          &G,
                             Modes           &modes) const
  {
    CpuTimer timer(communicator_);
    prestress.assemble_stiffness(K);
    modes.assembly += timer.lap();
    modes.state = prestress.solve(K, 1., shell.solver());
    timer.lap();
    shell.assembly().reinit_matrix(prestress.constraints(), G);
    prestress.add(modes.state, 1., -1., G);
    modes.assembly += timer.lap();
    const double full = G.frobenius_norm();
    if (prestress.acts(0.))
      {
        // K + G(0) + lambda (G(1) - G(0)); G holds -G(1) so far.
        const Vector start = prestress.solve(K, 0., shell.solver());
        timer.lap();
        Matrix fixed;
        fixed.reinit(G);
        fixed = 0.;
        prestress.add(start, 0., 1., fixed);
        G.add(1., fixed);
        K.add(1., fixed);
        modes.assembly += timer.lap();
      }
    AssertThrow(G.frobenius_norm() > 1e-10 * full,
                ExcMessage("Analysis/Load factor: the loads at t = 0 and t = 1 "
                           "are the same, so that nothing is left to scale; "
                           "what depends on t is scaled by the load factors "
                           "that are sought."));
  }

  void
  BucklingAnalysis::assemble_at_start(const DiscreteShell &shell,
                                      const Prestress     &prestress,
                                      Matrix              &K,
                                      Matrix              &G,
                                      Modes               &modes) const
  {
    CpuTimer timer(communicator_);
    prestress.assemble_tangent(start()->u, start()->time, K);
    shell.assembly().reinit_matrix(prestress.constraints(), G);
    prestress.add_tangent_rate(start()->u,
                               start()->velocity,
                               start()->time,
                               -1.,
                               G);
    modes.state = start()->u;
    modes.assembly += timer.lap();
    std::ostringstream text;
    text << "The tangent and its rate are those at t = " << start()->time
         << "; load factors are values of t.";
    modes.notes.push_back(text.str());
  }

  ModeAnalysis::Modes
  BucklingAnalysis::find_modes(DiscreteShell   &shell,
                               const Prestress &prestress) const
  {
    Modes  modes;
    Matrix K, G;
    if (start() != nullptr)
      assemble_at_start(shell, prestress, K, G, modes);
    else
      assemble(shell, prestress, K, G, modes);
    Eigenproblem problem(K,
                         G,
                         false,
                         free_dofs(shell, prestress.constraints()));
    double       zero = 0.;
    AssertThrow(problem.count_below(zero) == 0,
                ExcMessage(start() != nullptr ?
                             "Analysis/Start from: that state is unstable; "
                             "take one before the first limit or bifurcation "
                             "point." :
                             "The shell is unstable without the loads that are "
                             "scaled: the stiffness with those at t = 0 is not "
                             "positive definite. Make them smaller."));
    const FactorSign sign = problem_.modes.sign;
    if (sign != FactorSign::negative)
      add_modes(problem, 1., modes);
    if (sign != FactorSign::positive)
      {
        G *= -1.;
        Eigenproblem reversed(K,
                              G,
                              false,
                              free_dofs(shell, prestress.constraints()));
        add_modes(reversed, -1., modes);
        modes.n_factorisations += reversed.n_factorisations();
        modes.n_substitutions += reversed.n_substitutions();
      }
    modes.n_factorisations += problem.n_factorisations();
    modes.n_substitutions += problem.n_substitutions();
    sort_by_size(modes);
    return modes;
  }

  void
  BucklingAnalysis::sort_by_size(Modes &modes) const
  {
    std::vector<unsigned int> order(modes.vectors.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](auto i, auto j) {
      return std::abs(modes.values.values[i] - origin()) <
             std::abs(modes.values.values[j] - origin());
    });
    order.resize(std::min<std::size_t>(order.size(), problem_.modes.n_modes));
    modes.vectors               = reordered(modes.vectors, order);
    modes.values.values         = reordered(modes.values.values, order);
    modes.values.multiplicities = reordered(modes.values.multiplicities, order);
  }

  void
  BucklingAnalysis::add_modes(Eigenproblem &problem,
                              const double  sign,
                              Modes        &modes) const
  {
    const auto           &range = problem_.modes.range;
    std::optional<double> upper;
    if (range)
      upper = std::max(sign * (range->second - origin()), 0.);
    const double lower =
      range ? std::max(sign * (range->first - origin()), 0.) : 0.;
    Spectrum spectrum =
      problem.find_above(lower,
                         problem_.modes.n_modes,
                         upper,
                         problem_.modes.multiplicity_tolerance);
    const std::string name =
      sign > 0. ? "load factors" : "load factors of the reversed loads";
    if (spectrum.values.empty() && !range)
      modes.notes.push_back("There are no " + name +
                            ": that way nothing buckles.");
    else
      modes.notes.push_back(
        counted_in_words(spectrum,
                         name,
                         origin() + sign * spectrum.counted.first,
                         origin() + sign * spectrum.counted.second));
    modes.values.n_below = spectrum.n_below;
    const auto counts    = multiplicities(spectrum.values);
    for (unsigned int k = 0; k < spectrum.values.size(); ++k)
      {
        modes.values.values.push_back(origin() + sign * spectrum.values[k]);
        modes.values.multiplicities.push_back(counts[k]);
        modes.vectors.push_back(std::move(spectrum.modes[k]));
      }
  }
} // namespace Nacre
