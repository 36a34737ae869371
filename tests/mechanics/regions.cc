// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Section values by region: own ones, those of the section, those of a study.

#include <nacre/mechanics/linear_elastic_section.h>

#include <cmath>
#include <iostream>
#include <string>

using namespace Nacre;

namespace
{
  int n_failures = 0;

  void
  check_equal(const std::string &name,
              const double       found,
              const double       expected)
  {
    const bool good = std::abs(found - expected) <= 1e-14 * std::abs(expected);
    n_failures += good ? 0 : 1;
    std::cout << name << ": ";
    if (good)
      std::cout << "OK" << std::endl;
    else
      std::cout << found << " instead of " << expected << std::endl;
  }

  SectionPoint
  at(const unsigned int region)
  {
    return SectionPoint(Point<3>(2., 0., 0.), region);
  }

  void
  check_region(const LinearElasticSection &section,
               const unsigned int          region,
               const double                E,
               const double                nu,
               const double                h,
               const double                density)
  {
    const std::string name = "region " + std::to_string(region) + ", ";
    check_equal(name + "h", section.thickness(at(region)), h);
    check_equal(name + "density", section.density(at(region)), density);
    Tensor<1, 3> a_1, a_2;
    a_1[0] = a_2[1] = 1.;
    const auto stiffness =
      section.stiffness(make_surface_frame(a_1, a_2, {}), at(region));
    check_equal(name + "H_n", stiffness.membrane[0][0], E * h / (1. - nu * nu));
    check_equal(name + "H_m",
                stiffness.bending[0][1],
                nu * E * h * h * h / (12. * (1. - nu * nu)));
  }

  /** Numbers out of range are refused by their name. */
  void
  check_refusal(const std::string &name,
                const double       E,
                const double       nu,
                const double       h,
                const double       density)
  {
    std::string message = "nothing";
    try
      {
        LinearElasticSection(E, nu, h, density);
      }
    catch (const ExceptionBase &error)
      {
        message = error.what();
      }
    const bool good = message.find(name + ": ") != std::string::npos;
    n_failures += good ? 0 : 1;
    std::cout << "refused " << name << ": " << (good ? "OK" : message)
              << std::endl;
  }
} // namespace


int
main()
{
  LinearElasticSectionParameters parameters;
  ParameterAcceptor::declare_all_parameters();
  ParameterAcceptor::prm.parse_input_from_string(
    "subsection Section\n"
    "set Young's modulus = 100\n set Poisson's ratio = 0.3\n"
    "set Thickness = 0.2\n set Density = 5\n"
    "set Regions = web: h = c*h, E = 2*E; flange: nu = 0.1, density = 3*x\n"
    "end\n");
  ParameterAcceptor::parse_all_parameters();
  MeshRegions regions;
  for (const char *const name : {"flange", "plain", "web"})
    regions.regions.push_back({{name}, ""});
  const Constants constants = {{"c", 0.25}};
  const auto      section   = parameters.section(constants, {}, regions);
  check_region(section, 0, 100., 0.3, 0.2, 5.);
  check_region(section, 1, 100., 0.1, 0.2, 6.);
  check_region(section, 2, 100., 0.3, 0.2, 5.);
  check_region(section, 3, 200., 0.3, 0.05, 5.);
  std::cout << "thickness of a study" << std::endl;
  const auto other = parameters.section(constants, 0.4, regions);
  check_region(other, 1, 100., 0.1, 0.4, 6.);
  check_region(other, 3, 200., 0.3, 0.1, 5.);
  check_refusal("Young's modulus", 0., 0.3, 0.1, 1.);
  check_refusal("Poisson's ratio", 1., 0.51, 0.1, 1.);
  check_refusal("Thickness", 1., 0.3, -0.1, 1.);
  check_refusal("Density", 1., 0.3, 0.1, -1.);
  return n_failures;
}
