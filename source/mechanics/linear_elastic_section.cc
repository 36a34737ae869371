// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mutation.h>
#include <nacre/mechanics/linear_elastic_section.h>

#include <sstream>

namespace Nacre
{
  namespace
  {
    /** To print also the tiny numbers that std::to_string makes 0. */
    std::string
    to_text(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }

    double
    positive(const double value, const char *what, const Point<3> &point)
    {
      AssertThrow(value > 0.,
                  ExcMessage("Section/" + std::string(what) + ": " +
                             to_text(value) + " at the point (" +
                             to_text(point[0]) + ", " + to_text(point[1]) +
                             ", " + to_text(point[2]) +
                             "); it must be positive."));
      return value;
    }
  } // namespace

  LinearElasticSection::LinearElasticSection()
    : ParameterAcceptor("/Section")
  {
    add_parameter("Young's modulus",
                  youngs_modulus_text_,
                  "Young's modulus E, a number or an expression of x, y, z. "
                  "Units: force/length^2.");
    add_parameter("Poisson's ratio",
                  nu_text_,
                  "Poisson's ratio nu, larger than -1 and smaller than 0.5. "
                  "Units: none.");
    add_parameter("Thickness",
                  thickness_text_,
                  "Thickness h, a number or an expression of x, y, z. "
                  "Units: length.");
    add_parameter("Density",
                  density_text_,
                  "Mass per volume, a number or an expression of x, y, z. "
                  "Units: mass/length^3.");
  }

  void
  LinearElasticSection::prepare(const Constants &constants)
  {
    nu_ = evaluate_number(nu_text_, "Section/Poisson's ratio", constants);
    AssertThrow(nu_ > -1. && nu_ < 0.5,
                ExcMessage("Section/Poisson's ratio: " + to_text(nu_) +
                           "; it must be larger than -1 and smaller than "
                           "0.5."));
    youngs_modulus_ =
      Expression(youngs_modulus_text_, "Section/Young's modulus", constants);
    thickness_ = Expression(thickness_text_, "Section/Thickness", constants);
    density_   = Expression(density_text_, "Section/Density", constants);
    // Constants are checked at once, expressions at the points of use.
    if (youngs_modulus_.is_constant())
      youngs_modulus(Point<3>());
    if (thickness_.is_constant())
      thickness(Point<3>());
    if (density_.is_constant())
      density(Point<3>());
  }

  void
  LinearElasticSection::set_thickness(const double thickness)
  {
    thickness_of_study_ = thickness;
  }

  Constants
  LinearElasticSection::named_constants() const
  {
    Constants constants;
    constants["nu"] = nu_;
    if (youngs_modulus_.is_constant())
      constants["E"] = youngs_modulus_(Point<3>());
    if (thickness_of_study_)
      constants["h"] = *thickness_of_study_;
    else if (thickness_.is_constant())
      constants["h"] = thickness_(Point<3>());
    return constants;
  }

  double
  LinearElasticSection::youngs_modulus(const Point<3> &point) const
  {
    return positive(youngs_modulus_(point), "Young's modulus", point);
  }

  double
  LinearElasticSection::thickness(const Point<3> &point) const
  {
    return thickness_of_study_ ?
             *thickness_of_study_ :
             positive(thickness_(point), "Thickness", point);
  }

  double
  LinearElasticSection::density(const Point<3> &point) const
  {
    const double value = density_(point);
    AssertThrow(value >= 0.,
                ExcMessage("Section/Density: " + to_text(value) +
                           "; it must not be negative."));
    return value;
  }

  SectionStiffness
  LinearElasticSection::stiffness(const SurfaceFrame<> &frame,
                                  const Point<3>       &point) const
  {
    const double E = youngs_modulus(point);
    const double h = thickness(point);
    const auto   H = isotropic_stiffness(frame, NACRE_MUTABLE(nu, nu_, -nu_));
    // (8), (9); the report's (31) prints (1 - nu^2)^2 by mistake.
    const double membrane = E * h / (1. - nu_ * nu_);
    const double bending  = membrane * h * h / NACRE_MUTABLE(twelve, 12., 10.);
    return {membrane * H, bending * H};
  }
} // namespace Nacre
