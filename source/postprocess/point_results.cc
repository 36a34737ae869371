// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/shell_strain.h>
#include <nacre/postprocess/point_results.h>

#include <algorithm>
#include <cmath>

namespace Nacre
{
  const Selection<Face> &
  selection(Face)
  {
    static const Selection<Face> table = {{Face::bottom, "bottom"},
                                          {Face::middle, "middle"},
                                          {Face::top, "top"}};
    return table;
  }

  std::string
  field_name(std::string name)
  {
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
  }

  PointResults::PlaneTensor
  PointResults::in_axes(const Tensor3 &T) const
  {
    PlaneTensor plane;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        plane[i][j] = e[i] * (T * e[j]);
    return plane;
  }

  std::array<PointResults::Principal, dim>
  PointResults::principal(const Tensor3 &T) const
  {
    std::array<Principal, dim> result;
    const PlaneTensor          plane = in_axes(T);
    if (!std::isfinite(plane.norm()))
      {
        // Strains of no body, as a law may answer them
        result.fill({plane.norm(), Vector3()});
        return result;
      }
    const auto pairs = eigenvectors(plane);
    for (unsigned int i = 0; i < dim; ++i)
      result[i] = {pairs[i].first,
                   pairs[i].second[0] * e[0] + pairs[i].second[1] * e[1]};
    return result;
  }

  double
  PointResults::von_mises(const Tensor3 &S) const
  {
    const PlaneTensor s     = in_axes(S);
    const double      trace = s[0][0] + s[1][1];
    const double      det   = s[0][0] * s[1][1] - s[0][1] * s[0][1];
    return std::sqrt(std::max(trace * trace - 3. * det, 0.));
  }

  CellResults::CellResults(const ShellState      &state,
                           const Quadrature<dim> &points,
                           const bool             with_shear,
                           const bool             spread)
    : state_(state)
    , strains_(state, points, spread)
  {
    if (with_shear)
      shear_.emplace(state);
  }

  void
  CellResults::reinit(const CellPart &part)
  {
    strains_.reinit(part);
    if (shear_)
      shear_->reinit(part, strains_.values());
  }

  PointResults
  CellResults::at(const unsigned int q) const
  {
    const SectionAt section = state_.section();
    const auto     &frame   = strains_.values().frame(q);
    const auto      point   = strains_.values().point(q);
    const auto      eps     = strains_.membrane(q);
    const auto      rho     = strains_.bending(q);
    const auto      state   = strains_.section_state(q);
    const auto      answer  = section.response(eps, rho, frame, point, state);
    const auto      axes    = state_.model.result_axes.at(frame, point);

    PointResults r;
    r.point          = point;
    r.displacement   = strains_.displacement(q);
    r.normal         = axes.normal;
    r.e              = axes.e;
    r.normal_change  = axes.side * strains_.normal_change(q);
    r.rotation       = strains_.rotation(q);
    r.energy_density = answer.energy;
    r.membrane_forces =
      ShellStrain::resultant_tensor(frame, answer.membrane_force);
    r.moments = axes.side * ShellStrain::resultant_tensor(frame, answer.moment);
    for (unsigned int k = 0; k < n_faces; ++k)
      {
        r.stress[k]        = stress(q, k - 1.);
        r.state_results[k] = state_results(q, k - 1.);
      }
    if (shear_)
      r.transverse_shear = axes.side * shear_->value(q);
    r.layers = section.layers(eps, rho, frame, point, state);
    for (LayerState &layer : r.layers)
      for (double &height : layer.height)
        height *= axes.side;
    return r;
  }

  PointResults
  CellResults::with_layers(const unsigned int q) const
  {
    PointResults r = at(q);
    if (r.layers.empty())
      {
        const auto   point = strains_.values().point(q);
        const double h     = state_.model.section->thickness(point);
        r.layers.resize(1);
        r.layers[0].height = {{-0.5 * h, 0.5 * h}};
      }
    return r;
  }

  std::vector<double>
  CellResults::state_results(const unsigned int q, const double side) const
  {
    const auto axes = state_.model.result_axes.at(strains_.values().frame(q),
                                                  strains_.values().point(q));
    return state_.model.section->state_results(axes.side * side,
                                               strains_.section_state(q));
  }

  Tensor<2, spacedim>
  CellResults::stress(const unsigned int q, const double side) const
  {
    const auto &frame = strains_.values().frame(q);
    const auto  point = strains_.values().point(q);
    const auto  axes  = state_.model.result_axes.at(frame, point);
    return ShellStrain::resultant_tensor(
      frame,
      state_.section().stress(strains_.membrane(q),
                              strains_.bending(q),
                              axes.side * side,
                              frame,
                              point,
                              strains_.section_state(q)));
  }
} // namespace Nacre
