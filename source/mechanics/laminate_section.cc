// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/checked_value.h>
#include <nacre/mechanics/laminate_section.h>
#include <nacre/mechanics/surface_axes.h>

#include <algorithm>
#include <utility>

namespace Nacre
{
  namespace
  {
    const std::string direction_parameter =
      "Section/Laminate/Material direction";
    const std::string top_parameter = "Section/Laminate/Top";
  } // namespace

  LaminateSection::LaminateSection(
    ByRegion<Layup>                                          layups,
    std::optional<VectorExpression>                          top,
    const std::vector<std::array<std::array<double, 2>, 2>> &lines)
    : layups_(std::move(layups))
    , top_(std::move(top))
    , lines_(lines)
  {
    for (const Layup &layup : layups_.all())
      {
        AssertThrow(layup.laminate.n_layers() > 0,
                    ExcMessage("A laminate without plies."));
        check_positive(layup.thickness);
        AssertThrow(!layup.line || !lines_.empty(),
                    ExcMessage(direction_parameter +
                               ": this surface has no lines of parameters u "
                               "and v, as surfaces over a rectangle of (u, v) "
                               "have; give x, y, z or three expressions of x, "
                               "y, z."));
        is_coupled_ =
          is_coupled_ || !layup.laminate.is_symmetric() || layup.offset != 0.;
      }
  }

  double
  LaminateSection::thickness(const SectionPoint &point) const
  {
    return positive(layups_.at(point).thickness, point);
  }

  double
  LaminateSection::density(const SectionPoint &point) const
  {
    return layups_.at(point).laminate.density();
  }

  Tensor<1, 3>
  LaminateSection::direction(const Layup          &layup,
                             const SurfaceFrame<> &frame,
                             const SectionPoint   &point) const
  {
    if (!layup.line)
      return layup.direction(point);
    AssertIndexRange(point.region(), lines_.size());
    const auto &line = lines_[point.region()][*layup.line];
    return line[0] * frame.a_cov[0] + line[1] * frame.a_cov[1];
  }

  LaminateSection::Axes
  LaminateSection::axes(const Layup          &layup,
                        const SurfaceFrame<> &frame,
                        const SectionPoint   &point) const
  {
    const auto  &t0 = frame.t0;
    const double side =
      top_ ? side_of((*top_)(point), t0, point, top_parameter) : 1.;
    const auto  e1 = projected_direction(direction(layup, frame, point),
                                        t0,
                                        point,
                                        direction_parameter);
    const auto  e2 = side * cross_product_3d(t0, e1);
    const auto &a  = frame.a_con;
    return {strain_transformation({{e1 * a[0], e1 * a[1]}},
                                  {{e2 * a[0], e2 * a[1]}}),
            side};
  }

  SectionStiffness
  LaminateSection::stiffness(const SurfaceFrame<> &frame,
                             const SectionPoint   &point) const
  {
    const Layup &here    = layups_.at(point);
    const auto [T, side] = axes(here, frame, point);
    const auto in_axes =
      here.laminate.stiffness(positive(here.thickness, point), here.offset);
    const auto       T_t = transpose(T);
    SectionStiffness result;
    result.membrane = T_t * in_axes.membrane * T;
    result.bending  = T_t * in_axes.bending * T;
    // The strain at the height z above the mid-surface on the top's side is
    // eps + side z rho.
    if (is_coupled_)
      result.coupling = side * (T_t * in_axes.coupling * T);
    return result;
  }

  Voigt<>
  LaminateSection::stress(const Voigt<>        &membrane_strain,
                          const Voigt<>        &bending_strain,
                          const double          side,
                          const SurfaceFrame<> &frame,
                          const SectionPoint   &point,
                          const Temperature    &temperature) const
  {
    const Layup &here        = layups_.at(point);
    const auto [T, top_side] = axes(here, frame, point);
    return transpose(T) *
           here.laminate.stress(T * membrane_strain,
                                top_side * (T * bending_strain),
                                0.5 * top_side * side,
                                positive(here.thickness, point),
                                here.offset,
                                {temperature.mean,
                                 top_side * temperature.gradient});
  }

  InitialForces
  LaminateSection::thermal_forces(const Temperature    &temperature,
                                  const SurfaceFrame<> &frame,
                                  const SectionPoint   &point) const
  {
    const Layup &here    = layups_.at(point);
    const auto [T, side] = axes(here, frame, point);
    InitialForces result =
      here.laminate.thermal_forces({temperature.mean,
                                    side * temperature.gradient},
                                   positive(here.thickness, point),
                                   here.offset);
    result.membrane_force = transpose(T) * result.membrane_force;
    result.moment         = side * (transpose(T) * result.moment);
    return result;
  }

  std::vector<LayerState>
  LaminateSection::layers(const Voigt<>        &membrane_strain,
                          const Voigt<>        &bending_strain,
                          const SurfaceFrame<> &frame,
                          const SectionPoint   &point,
                          const Temperature    &temperature) const
  {
    const Layup &here    = layups_.at(point);
    const auto [T, side] = axes(here, frame, point);
    auto states =
      here.laminate.states(T * membrane_strain,
                           side * (T * bending_strain),
                           positive(here.thickness, point),
                           here.offset,
                           {temperature.mean, side * temperature.gradient});
    for (LayerState &state : states)
      for (double &height : state.height)
        height *= side;
    return states;
  }

  unsigned int
  LaminateSection::n_layers() const
  {
    unsigned int n = 0;
    for (const Layup &layup : layups_.all())
      n = std::max(n, layup.laminate.n_layers());
    return n;
  }
} // namespace Nacre
