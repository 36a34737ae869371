// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/text.h>
#include <nacre/postprocess/ply_quantities.h>
#include <nacre/postprocess/shell_state.h>
#include <nacre/postprocess/strain_values.h>

#include <algorithm>
#include <cstdlib>

namespace Nacre
{
  namespace
  {
    double
    value_of(const PlyQuantity &quantity, const std::vector<LayerState> &layers)
    {
      using Kind = PlyQuantity::Kind;
      AssertThrow(!layers.empty(),
                  ExcMessage(quantity.where +
                             ": the section has no plies; 'Section/Type' must "
                             "be 'laminate'."));
      if (quantity.kind == Kind::stress || quantity.kind == Kind::strain)
        {
          AssertThrow(quantity.ply < layers.size(),
                      ExcMessage(quantity.where + ": there is no ply " +
                                 std::to_string(quantity.ply + 1) +
                                 "; the stack has " +
                                 std::to_string(layers.size()) + "."));
          const LayerState &layer = layers[quantity.ply];
          return (quantity.kind == Kind::stress ?
                    layer.stress :
                    layer.strain)[quantity.face][quantity.component];
        }
      std::optional<double> largest;
      for (const LayerState &layer : layers)
        {
          const auto &index = quantity.kind == Kind::tsai_wu ?
                                layer.tsai_wu :
                                layer.maximum_stress;
          if (index)
            largest = largest ? std::max(*largest, *index) : index;
        }
      AssertThrow(largest,
                  ExcMessage(quantity.where +
                             ": no material of the stack has strengths; give "
                             "Xt, Xc, Yt, Yc, S in "
                             "'Section/Laminate/Materials'."));
      return *largest;
    }
  } // namespace

  PlyQuantity
  parse_ply_quantity(const PlyQuantity::Kind kind,
                     const std::string      &component,
                     const std::string      &ply,
                     const Point<3>         &point,
                     const std::string      &where)
  {
    PlyQuantity quantity{kind};
    quantity.point                            = point;
    quantity.where                            = where;
    const std::vector<std::string> components = {"1", "2", "12"};
    const auto                     found =
      std::find(components.begin(), components.end(), component);
    AssertThrow(found != components.end(),
                ExcMessage(where + ": '" + component +
                           "' is no component in the axes of a ply; " +
                           ply_quantity_form + "."));
    quantity.component = found - components.begin();

    const auto        space = ply.find(' ');
    const std::string face =
      space == std::string::npos ? "" : Text::trim(ply.substr(space));
    char      *end    = nullptr;
    const long number = std::strtol(ply.c_str(), &end, 10);
    AssertThrow((face == "bottom" || face == "top") && *end == ' ' &&
                  number >= 1,
                ExcMessage(where + ": '" + ply + "' is no face of a ply; " +
                           ply_quantity_form + "."));
    quantity.ply  = number - 1;
    quantity.face = face == "top" ? 1 : 0;
    return quantity;
  }

  double
  evaluate_ply_quantity(const ShellState &state, const PlyQuantity &quantity)
  {
    const auto &discretization = state.discretization;
    const auto  place = discretization.locate(quantity.point, quantity.where);
    double      value = 0.;
    run_on_all_ranks(discretization.communicator(), [&]() {
      if (!place.is_mine)
        return;
      StrainValues strains(state, Quadrature<dim>(place.unit));
      strains.reinit(place.part);
      value = value_of(quantity,
                       state.section().layers(strains.membrane(0),
                                              strains.bending(0),
                                              strains.values().frame(0),
                                              strains.values().point(0),
                                              strains.section_state(0)));
    });
    return Utilities::MPI::sum(value, discretization.communicator());
  }
} // namespace Nacre
