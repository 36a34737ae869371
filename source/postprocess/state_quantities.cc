// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/expression.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/mechanics/j2_plasticity.h>
#include <nacre/postprocess/state_quantities.h>

namespace Nacre
{
  std::optional<StateQuantity>
  parse_state_quantity(QuantityPhrase                 &phrase,
                       const std::vector<std::string> &names,
                       const Constants                &constants)
  {
    QuantityPhrase rest       = phrase;
    const bool     is_largest = rest.take("largest");
    for (unsigned int k = 0; k < names.size(); ++k)
      if (rest.take(names[k]))
        {
          StateQuantity quantity{k};
          quantity.where = phrase.where;
          quantity.face  = parse_face(rest.take_word(), rest);
          if (!is_largest && rest.take("at") && !rest.text.empty())
            quantity.point = evaluate_point(rest.text, rest.where, constants);
          AssertThrow(quantity.point || (is_largest && rest.text.empty()),
                      ExcMessage(phrase.where + ": write '" + names[k] +
                                 " bottom|middle|top at (x, y, z)' or "
                                 "'largest " +
                                 names[k] + " bottom|middle|top'."));
          return quantity;
        }
    for (const std::string name : J2Plasticity::result_names)
      AssertThrow(!rest.take(name),
                  ExcMessage(phrase.where + ": the section has no '" + name +
                             "'; 'Section/Type' must be 'elastoplastic'."));
    return {};
  }

  double
  evaluate_state_quantity(const ShellState    &state,
                          const StateQuantity &quantity)
  {
    const auto value = [&](const PointResults &results) {
      return results.state_results[static_cast<unsigned int>(quantity.face)]
                                  [quantity.result];
    };
    return quantity.point ?
             value_at_point(state, *quantity.point, quantity.where, value) :
             largest_value(state, value);
  }

  double
  plastic_dissipation(const ShellState &state)
  {
    const auto &discretization = state.discretization;
    double      sum            = 0.;
    if (state.section_states == nullptr || state.section_states->has_none())
      return sum;
    run_on_all_ranks(discretization.communicator(), [&]() {
      ShellCellValues values(discretization,
                             discretization.element().full_quadrature(),
                             false);
      for (const CellPart &part : discretization.owned_parts())
        {
          values.reinit_frames(part);
          const auto &points = values.quadrature().get_points();
          for (unsigned int q = 0; q < values.n_points(); ++q)
            sum +=
              values.JxW(q) * state.model.section->dissipated_energy(
                                values.point(q),
                                state.section_states->nearest(part, points[q]));
        }
    });
    return Utilities::MPI::sum(sum, discretization.communicator());
  }
} // namespace Nacre
