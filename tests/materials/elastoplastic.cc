// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The elastoplastic section at a point: derivatives, strips bent beyond
// yielding and back, cycles, tubes, and that no basis matters.

#include "section_points.h"

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
         std::to_string(hardening) +
         "\n set Points = " + std::to_string(points) + "\nend\n";
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

  double
  dissipated() const
  {
    return point_.dissipated_energy();
  }

  /** The accumulated plastic strain over that of first yielding. */
  double
  accumulated(const double side) const
  {
    return point_.state_result(side) * E / yield;
  }

  /** kappa_yy/kappa_xx. */
  double
  contraction() const
  {
    return strains_[4] / strains_[3];
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


/** Any path at all, beyond yielding and back; the strains of its end. */
Strains
wander(PointOfSection &point)
{
  for (const Strains &strains :
       {Strains{{1e-3, 0.4e-3, 1e-3, 0.01, 0.02, -0.03}},
        Strains{{2e-3, 0., 1e-3, 0.06, -0.02, 0.05}},
        Strains{{-1e-3, 1e-3, -2e-3, -0.03, 0.04, 0.02}}})
    point.accept(strains);
  return {{-2e-3, 3e-3, -4e-3, -0.02, 0.01, 0.015}};
}

void
test_derivatives()
{
  const auto     section = section_of_lines(metal(0.3, 9, 0.05));
  PointOfSection skewed(*section, skewed_frame());
  PointOfSection straight(*section, cartesian_frame());
  const Strains  end = wander(skewed);
  wander(straight);
  // All layers yield there: no kink is near.
  check_derivatives("hardening", skewed, end, 4e-5, 1e-9);
  check_below("basis",
              difference(skewed.response(end), straight.response(end)),
              1e-12);
  double difference = 0., size = 0.;
  for (unsigned int k = 0; k < skewed.state().size(); ++k)
    {
      difference =
        std::max(difference, std::abs(skewed.state()[k] - straight.state()[k]));
      size = std::max(size, std::abs(straight.state()[k]));
    }
  check_below("basis, state", difference / size, 1e-12);
  const ElastoplasticSection of_numbers({E, 0.3, h}, yield, 0.05);
  PointOfSection             numbers(of_numbers, skewed_frame());
  wander(numbers);
  check_below("numbers",
              ::difference(numbers.response(end), skewed.response(end)),
              1e-14);
  const auto rest = section->stiffness(skewed_frame(), Point<3>());
  const auto zero = section->response({}, {}, skewed_frame(), Point<3>());
  check_below("stiffness at rest",
              (rest.bending - zero.tangent.bending).norm() /
                rest.bending.norm(),
              1e-13);
}

/** The stress lies on the yield surface, however far the strains are. */
void
test_yield_surface()
{
  const auto     section = section_of_lines(metal(0.3, 9));
  PointOfSection point(*section, skewed_frame());
  Strains        strains = wander(point);
  double         error   = 0.;
  for (unsigned int k = 0; k < 6; ++k)
    {
      for (const double side : {-1., 0., 0.1, 1.})
        {
          const auto s = point.stress(strains, side);
          error        = std::max(error,
                           std::abs(std::sqrt(s[0] * s[0] + s[1] * s[1] -
                                              s[0] * s[1] + 3. * s[2] * s[2]) /
                                      yield -
                                    1.));
        }
      for (double &strain : strains)
        strain *= 10.;
    }
  check_below("yield surface", error, 1e-12);
  check_derivatives("perfectly plastic", point, wander(point), 4e-5, 1e-8);
}

struct StripRow
{
  double k, moment, contraction;
};

/** Rows of M/M_y and kappa_yy/kappa_xx; perfectly plastic. */
void
test_strip(const std::string           &name,
           const double                 nu,
           const bool                   is_narrow,
           const std::vector<StripRow> &rows)
{
  const auto section = section_of_lines(metal(nu, 129));
  Strip      strip(*section, is_narrow);
  double     error = 0., contraction_error = 0., k = 0.;
  for (const auto &row : rows)
    {
      const double moment = strip.bend(row.k, std::ceil(20 * (row.k - k)));
      k                   = row.k;
      error               = std::max(error, std::abs(moment - row.moment));
      contraction_error =
        std::max(contraction_error,
                 std::abs(strip.contraction() + row.contraction));
    }
  check_below(name, error, 2.5e-4);
  check_below(name + ", contraction", contraction_error, 4e-4);
}

void
test_strips()
{
  test_strip("uniaxial",
             0.5,
             true,
             {{1.2, 1.1527778, 0.5},
              {1.5, 1.2777778, 0.5},
              {2., 1.375, 0.5},
              {3., 1.4444444, 0.5},
              {5., 1.48, 0.5},
              {10., 1.495, 0.5}});
  test_strip("narrow",
             0.3,
             true,
             {{1.2, 1.1538605, 0.30742},
              {1.5, 1.2802157, 0.32765},
              {2., 1.3776156, 0.35808},
              {3., 1.4460467, 0.39652},
              {5., 1.4805748, 0.43227},
              {10., 1.4950928, 0.46279}});
  test_strip("cylindrical",
             0.3,
             false,
             {{1., 1.0989011, 0.},
              {1.2, 1.2801359, 0.},
              {1.5, 1.4346946, 0.},
              {2., 1.5605486, 0.},
              {3., 1.6547022, 0.},
              {5., 1.7041378, 0.},
              {10., 1.7250719, 0.}});
}

/** The largest deviation of M/M_y in uniaxial stress, of any k, by rule. */
void
test_rules()
{
  for (const auto &[points, bound] : {std::make_pair(5u, 0.13),
                                      std::make_pair(9u, 0.032),
                                      std::make_pair(17u, 8e-3),
                                      std::make_pair(33u, 2e-3)})
    {
      const auto section = section_of_lines(metal(0.5, points));
      double     error   = 0.;
      for (double k = 1.; k < 20.; k += 0.05)
        {
          Strip strip(*section, true);
          error =
            std::max(error, std::abs(strip.bend(k, 1) - 1.5 + 0.5 / (k * k)));
        }
      check_below(std::to_string(points) + " points", error, bound);
    }
}

/** nu = 0: the contraction is of no table. */
void
test_strip_without_contraction()
{
  const auto section = section_of_lines(metal(0., 129));
  Strip      strip(*section, true);
  double     error = 0., k = 0.;
  for (const auto &[end, moment] : {std::make_pair(1.2, 1.1583677),
                                    std::make_pair(1.5, 1.2908046),
                                    std::make_pair(2., 1.3888790),
                                    std::make_pair(3., 1.4525905),
                                    std::make_pair(5., 1.4827023),
                                    std::make_pair(10., 1.4953468)})
    {
      error =
        std::max(error,
                 std::abs(strip.bend(end, std::ceil(20 * (end - k))) - moment));
      k = end;
    }
  check_below("narrow, nu = 0", error, 2.5e-4);
}

/**
 * Uniaxial stress from k = 4, which is exact with 17 points: the middle eighth
 * of the thickness to both sides stays elastic.
 */
void
test_springback()
{
  const auto section = section_of_lines(metal(0.5, 17));
  Strip      strip(*section, true);
  check_below("k = 4", std::abs(strip.bend(4., 1) - 1.46875), 1e-5);
  check_below("springback", std::abs(strip.unload(0.) - 2.53125), 1e-5);
  check_below("residual stress",
              std::abs(strip.stress(1.) + 0.46875) +
                std::abs(strip.stress(0.25) - 0.6328125) +
                std::abs(strip.stress(0.)),
              1e-5);
  check_below("until reverse yielding",
              std::abs(strip.unload(1.46875 - 1.998) - (4. - 1.998)),
              1e-5);
  check_below("reverse yielding",
              strip.unload(1.46875 - 2.2) - (4. - 2.2),
              -0.01);
}

void
test_cycles()
{
  const auto section = section_of_lines(metal(0.5, 17));
  Strip      strip(*section, true);
  strip.bend(4., 1);
  strip.bend(-4., 1);
  strip.bend(4., 1);
  const double before = strip.energy(), dissipated = strip.dissipated();
  strip.bend(-4., 1);
  strip.bend(4., 1);
  check_below("dissipation of a cycle",
              std::abs((strip.energy() - before) / (M_y * kappa_y) - 13.5),
              1e-4);
  check_below("as the law says",
              std::abs((strip.dissipated() - dissipated) / (M_y * kappa_y) -
                       13.5),
              1e-4);
  // At the bottom 3, and 6 with each way back; at a quarter only 1 and 2.
  check_below("accumulated plastic strain",
              std::abs(strip.accumulated(-1.) - 27.) +
                std::abs(strip.accumulated(0.5) - 9.) +
                std::abs(strip.accumulated(0.)),
              1e-4);
}

void
test_hardening()
{
  const double H = 0.25, r = H / (E + H);
  const auto   section = section_of_lines(metal(0.5, 17, H));
  Strip        strip(*section, true);
  check_below("linear hardening",
              std::abs(strip.bend(4., 1) -
                       ((1. - r) * (1.5 - 0.5 / 16.) + r * 4.)),
              1e-5);
}

/** A closed tube: the hoop force p R, the axial one half of it. */
void
test_tube()
{
  const double   H = 0.1, nu = 0.3, hoop = 1.5 * yield;
  const auto     section = section_of_lines(metal(nu, 5, H));
  PointOfSection tube(*section, skewed_frame());
  Strains        strains{};
  tube.solve(strains, {0, 1}, {hoop * h, 0.5 * hoop * h});
  const double root = std::sqrt(0.75);
  const double expected =
    hoop * (1. - 0.5 * nu) / E + root * (root * hoop - yield) / H;
  check_below("tube, hoop", std::abs(strains[0] / expected - 1.), 1e-12);
  check_below("tube, axial",
              std::abs(strains[1] / (hoop * (0.5 - nu) / E) - 1.),
              1e-11);
}

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_derivatives();
  test_yield_surface();
  test_strips();
  test_rules();
  test_strip_without_contraction();
  test_springback();
  test_cycles();
  test_hardening();
  test_tube();
  return n_failures > 0;
}
