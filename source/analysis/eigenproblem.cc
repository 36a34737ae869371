// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/eigenproblem.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace Nacre
{
  namespace
  {
    /** Eigenvalues sought beside those wanted: to find a gap to count in. */
    constexpr unsigned int n_extra = 4;
    /**
     * Vectors of a block. One takes the fewest substitutions; copies of a
     * multiple eigenvalue come by round-off, or by the search after a count.
     */
    constexpr unsigned int block_size = 1;

    /** A shift in a gap above the value @p k of ascending @p values. */
    double
    middle_of_gap(const std::vector<double> &values, const unsigned int k)
    {
      return 0.5 * (values[k - 1] + values[k]);
    }
  } // namespace

  Eigenproblem::Eigenproblem(const Matrix   &stiffness,
                             const Matrix   &mass,
                             const bool      mass_is_definite,
                             const IndexSet &free)
    : stiffness_(stiffness)
    , mass_(mass)
    , inner_product_(mass_is_definite ? mass : stiffness)
    , free_(free)
    , n_free_(Utilities::MPI::sum(free.n_elements(),
                                  stiffness.get_mpi_communicator()))
    , solver_(stiffness.get_mpi_communicator())
  {
    shifted_.copy_from(stiffness_);
  }

  std::optional<unsigned int>
  Eigenproblem::try_count_below(const double shift)
  {
    if (factor_shift_ && *factor_shift_ == shift)
      return n_negative_;
    factor_shift_.reset();
    shifted_.copy_from(stiffness_);
    if (shift != 0.)
      shifted_.add(-shift, mass_);
    ++n_factorisations_;
    if (!solver_.try_factorize(shifted_))
      return {};
    factor_shift_ = shift;
    n_negative_   = solver_.n_negative_pivots().value_or(0);
    return n_negative_;
  }

  unsigned int
  Eigenproblem::count_below(double &shift)
  {
    for (unsigned int trial = 1; trial <= 4; ++trial)
      {
        if (const auto count = try_count_below(shift))
          return *count;
        // The shift is an eigenvalue: step aside.
        shift *= 1. + 1e-6 * trial;
      }
    check_regular(false);
    return 0;
  }

  std::vector<Eigenproblem::Vector>
  Eigenproblem::start_block(const unsigned int n) const
  {
    // The same on any number of ranks.
    std::vector<Vector> block;
    for (unsigned int k = 0; k < n; ++k)
      {
        Vector x(stiffness_.locally_owned_range_indices(),
                 stiffness_.get_mpi_communicator());
        for (const auto i : free_)
          x(i) = std::fmod(0.6180339887498949 * (i + 1.) * (k + 1.), 1.) - 0.5;
        x.compress(VectorOperation::insert);
        block.push_back(std::move(x));
      }
    return block;
  }

  Eigenpairs
  Eigenproblem::search(const unsigned int         n,
                       const bool                 above,
                       const std::vector<Vector> &known)
  {
    Assert(factor_shift_, ExcNotInitialized());
    Vector      Mx(stiffness_.locally_owned_range_indices(),
              stiffness_.get_mpi_communicator());
    EigenSearch wanted;
    wanted.n_wanted  = n;
    wanted.end       = above ? SpectrumEnd::largest : SpectrumEnd::smallest;
    Eigenpairs pairs = find_eigenpairs(
      [&](Vector &y, const Vector &x) {
        mass_.vmult(Mx, x);
        solver_.substitute(y, Mx);
      },
      inner_product_,
      start_block(block_size),
      known,
      wanted);
    n_substitutions_ += pairs.n_applications;
    return pairs;
  }

  void
  Eigenproblem::add_pairs(Eigenpairs                     &&pairs,
                          const double                     shift,
                          const std::pair<double, double> &interval,
                          Spectrum                        &spectrum)
  {
    for (unsigned int k = 0; k < pairs.values.size(); ++k)
      {
        const double lambda = shift + 1. / pairs.values[k];
        if (!(lambda > interval.first && lambda < interval.second))
          continue;
        const auto place = std::upper_bound(spectrum.values.begin(),
                                            spectrum.values.end(),
                                            lambda) -
                           spectrum.values.begin();
        spectrum.values.insert(spectrum.values.begin() + place, lambda);
        spectrum.modes.insert(spectrum.modes.begin() + place,
                              std::move(pairs.vectors[k]));
      }
  }

  void
  Eigenproblem::complete(const double shift, double top, Spectrum &spectrum)
  {
    for (unsigned int trial = 0; trial < 4; ++trial)
      {
        const unsigned int n_counted = count_below(top) - spectrum.n_below;
        const unsigned int n_found   = std::lower_bound(spectrum.values.begin(),
                                                      spectrum.values.end(),
                                                      top) -
                                     spectrum.values.begin();
        spectrum.counted = {shift, top};
        if (n_found == n_counted)
          return;
        std::ostringstream text;
        text << "The search for eigenvalues between " << shift << " and " << top
             << " has found " << n_found << ", but the pivots count "
             << n_counted
             << ". Ask for more modes, or for another range of modes.";
        AssertThrow(trial < 3 && n_found < n_counted, ExcMessage(text.str()));
        spectrum.n_missed += n_counted - n_found;
        add_pairs(search(n_counted - n_found, false, spectrum.modes),
                  top,
                  {shift, top},
                  spectrum);
      }
  }

  std::optional<double>
  Eigenproblem::place_to_count(const std::vector<double> &values,
                               const unsigned int         n_wanted,
                               const unsigned int         n_most,
                               const double               tolerance)
  {
    unsigned int k = std::min<std::size_t>(n_wanted, values.size());
    while (k < values.size() &&
           values[k] - values[k - 1] <=
             tolerance * std::max(std::abs(values[k]), std::abs(values[k - 1])))
      ++k;
    if (k < values.size())
      return middle_of_gap(values, k);
    if (values.size() >= n_most || values.size() < n_wanted)
      // There are no more.
      return values.back() + 1e-3 * std::abs(values.back());
    return {};
  }

  Spectrum
  Eigenproblem::find_above(const double                 lower,
                           const unsigned int           n_wanted,
                           const std::optional<double> &upper,
                           const double                 tolerance)
  {
    const double       infinity = std::numeric_limits<double>::infinity();
    Spectrum           spectrum;
    double             shift = lower, top = upper.value_or(infinity);
    unsigned int       n     = n_wanted;
    const unsigned int n_top = upper ? count_below(top) : 0;
    spectrum.n_below         = count_below(shift);
    spectrum.counted         = {shift, top};
    if (upper)
      n = std::min(n, n_top - spectrum.n_below);
    if (n == 0)
      return spectrum;

    const unsigned int n_most =
      std::min<types::global_dof_index>(n_free_ - spectrum.n_below,
                                        n_free_ - block_size);
    unsigned int n_sought = std::min(n + n_extra, n_most);
    while (true)
      {
        count_below(shift);
        add_pairs(search(n_sought, true, spectrum.modes),
                  shift,
                  {shift, infinity},
                  spectrum);
        if (spectrum.values.empty())
          return spectrum;
        // After a search for all there are no more.
        const unsigned int n_there =
          n_sought == n_most ? spectrum.values.size() : n_most;
        if (const auto place =
              place_to_count(spectrum.values, n, n_there, tolerance))
          {
            complete(shift, *place, spectrum);
            break;
          }
        n_sought = std::min(2 * n_sought, n_most);
      }
    const unsigned int n_kept =
      std::lower_bound(spectrum.values.begin(),
                       spectrum.values.end(),
                       std::min(spectrum.counted.second, top)) -
      spectrum.values.begin();
    spectrum.values.resize(n_kept);
    spectrum.modes.resize(n_kept);
    return spectrum;
  }
} // namespace Nacre
