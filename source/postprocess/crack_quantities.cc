// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/expression.h>
#include <nacre/base/text.h>
#include <nacre/postprocess/crack_quantities.h>
#include <nacre/postprocess/crack_tip.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    /** Radii of the plateau, in cells at the tip. */
    constexpr double inner_cells = 2., outer_cells = 6.;

    CrackPlateau
    parse_radii(const std::string &text,
                const std::string &where,
                const Constants   &constants)
    {
      const auto radii = Text::split(text, ',', where);
      AssertThrow(radii.size() == 2,
                  ExcMessage(where + ": 'radii " + text +
                             "'; write two, the inner and the outer one, as "
                             "in 'radii 0.1, 0.4'."));
      const CrackPlateau plateau{evaluate_number(radii[0], where, constants),
                                 evaluate_number(radii[1], where, constants)};
      AssertThrow(0. < plateau.inner && plateau.inner < plateau.outer,
                  ExcMessage(where + ": the radii are " +
                             Text::number(plateau.inner) + " and " +
                             Text::number(plateau.outer) +
                             "; the inner one must be positive and smaller "
                             "than the outer one."));
      return plateau;
    }
  } // namespace

  const Selection<CrackQuantity::Kind> &
  selection(CrackQuantity::Kind)
  {
    using Kind                         = CrackQuantity::Kind;
    static const Selection<Kind> table = {{Kind::energy_release_rate,
                                           "energy release rate"},
                                          {Kind::opening, "K_I"},
                                          {Kind::sliding, "K_II"},
                                          {Kind::bending, "K_M"},
                                          {Kind::twisting, "K_T"}};
    return table;
  }

  std::optional<CrackQuantity>
  parse_crack_quantity(QuantityPhrase &phrase, const Constants &constants)
  {
    const auto &kinds = selection(CrackQuantity::Kind());
    const auto  found =
      std::find_if(kinds.begin(), kinds.end(), [&](const auto &kind) {
        return phrase.take(kind.second);
      });
    if (found == kinds.end())
      return {};
    CrackQuantity quantity{found->first};
    quantity.where = phrase.where;
    AssertThrow(phrase.take("of") && phrase.take("tip"),
                ExcMessage(phrase.where + ": write '" + found->second +
                           " of tip (x, y, z)', with 'radii INNER, OUTER' "
                           "behind it for other radii than " +
                           Text::number(inner_cells) + " and " +
                           Text::number(outer_cells) + " cells at the tip."));
    quantity.tip =
      evaluate_point(phrase.up_to("radii"), phrase.where, constants);
    if (!phrase.text.empty())
      quantity.plateau = parse_radii(phrase.text, phrase.where, constants);
    return quantity;
  }

  double
  evaluate_crack_quantity(const SolvedShell   &shell,
                          const CrackQuantity &quantity)
  {
    const auto tip =
      find_crack_tip(shell.discretization, quantity.tip, quantity.where);
    const EnergyRelease release(shell,
                                tip,
                                quantity.plateau.value_or(
                                  CrackPlateau{inner_cells * tip.cell_size,
                                               outer_cells * tip.cell_size}),
                                quantity.where);
    using Kind = CrackQuantity::Kind;
    switch (quantity.kind)
      {
        case Kind::energy_release_rate:
          return release.rate();
        case Kind::opening:
          return release.intensity(CrackMode::opening);
        case Kind::sliding:
          return release.intensity(CrackMode::sliding);
        case Kind::bending:
          return release.intensity(CrackMode::bending);
        case Kind::twisting:
          return release.intensity(CrackMode::twisting);
      }
    Assert(false, ExcInternalError());
    return 0.;
  }
} // namespace Nacre
