// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The elastoplastic section at a point: derivatives, strips bent beyond
// yielding and back, cycles, tubes, and that no basis matters.

#include "section_points.h"

#include <map>

using namespace Tests;

const double E = 1., h = 0.1, yield = 1e-3;

/** Moment at first yielding and curvature per E of a strip. */
const double M_y = yield * h * h / 6., kappa_y = 2. * yield / (E * h);

std::string
metal(const double nu, const unsigned int points, const double hardening = 0.)
{
  return "set Type = elastoplastic\n"
         "set Thickness = 0.1\n"
         "set Poisson's ratio = " +
         std::to_string(nu) +
         "\n"
         "subsection Plasticity\n"
         " set Yield stress = 1e-3\n"
         " set Hardening modulus = " +
         std::to_string(hardening) + "\n set Points = " +
         std::to_string(points) + "\nend\n";
}

/** A strip along x that is bent in steps, with free or straight sides. */
class Strip
{
public:
  Strip(const SectionLaw &law, const bool is_narrow)
    : point_(law, skewed_frame())
    , is_narrow_(is_narrow)
  {}

  /** To the curvature k kappa_y in @p n steps; returns M/M_y. */
  double
  bend(const double k, const unsigned int n)
  {
    const double begin = strains_[3], end = k * kappa_y;
    for (unsigned int step = 1; step <= n; ++step)
      {
        strains_[3] = begin + (end - begin) * step / n;
        if (is_narrow_)
          point_.solve(strains_, {4}, {0.});
        point_.accept(strains_);
      }
    return moment();
  }

  /** To the moment M/M_y in one step; returns the curvature over kappa_y. */
  double
  unload(const double moment)
  {
    point_.solve(strains_, {3, 4}, {moment * M_y, 0.});
    point_.accept(strains_);
    return strains_[3] / kappa_y;
  }

  double
  moment() const
  {
    return point_.response(strains_).force[3] / M_y;
  }

  double
  energy() const
  {
    return point_.response(strains_).energy;
  }

  /** kappa_yy/kappa_xx. */
  double
  contraction() const
  {
    return strains_[4] / strains_[3];
  }

  /** d(M/M_y)/d(kappa/kappa_y) of the tangent, kappa_yy as it is. */
  double
  tangent() const
  {
    return point_.response(strains_).tangent[3][3] * kappa_y / M_y;
  }

  /** Over the yield stress. */
  double
  stress(const double side) const
  {
    return point_.stress(strains_, side)[0] / yield;
  }

private:
  PointOfSection point_;
  bool           is_narrow_;
  Strains        strains_{};
};

struct StripRow
{
  double k, value;
};

/** The largest deviation of M/M_y; in all @p n steps to k = 1, and so on. */
double
strip_error(const double                 nu,
            const bool                   is_narrow,
            const std::vector<StripRow> &rows,
            const unsigned int           points,
            const unsigned int           n)
{
  const SectionOfText text(metal(nu, points));
  Strip               strip(text.section, is_narrow);
  double              error = 0., k = 0.;
  for (const auto &row : rows)
    {
      const double moment =
        strip.bend(row.k, std::ceil(n * (row.k - k)));
      k     = row.k;
      std::cerr << nu << ' ' << row.k << ' ' << moment-row.value << ' '<<strip.contraction() << '\n';
      error = std::max(error, std::abs(moment - row.value));
    }
  return error;
}

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (int p : {9, 17, 33, 65, 129, 201}) for (int n: {10, 40})
  {
  std::cerr << "points " << p << " n " << n << '\n';
  strip_error(0.49999999, true, {{1.2,1.1527778},{1.5, 1.2777778},{2, 1.375},{3, 1.4444444},{5, 1.48},{10, 1.495}}, p, n);
  strip_error(0.3, true, {{1.2,1.1538605},{1.5, 1.2802157},{2, 1.3776156},{3, 1.4460467},{5, 1.4805748},{10, 1.4950928}}, p, n);
  strip_error(0., true, {{1.2,1.1583677},{1.5, 1.2908046},{2, 1.3888790},{3, 1.4525905},{5, 1.4827023},{10, 1.4953468}}, p, n);
  strip_error(0.3, false, {{1.2,1.2801359},{1.5, 1.4346946},{2, 1.5605486},{3, 1.6547022},{5, 1.7041378},{10, 1.7250719}}, p, n);
  }
  return n_failures > 0;
}
