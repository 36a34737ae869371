// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/expression.h>
#include <nacre/base/text.h>
#include <nacre/postprocess/crack_quantities.h>
#include <nacre/postprocess/cut_quantities.h>
#include <nacre/postprocess/tip_release.h>
#include <nacre/problem/cuts.h>

#include <deal.II/base/numbers.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
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
                                          {Kind::twisting, "K_T"},
                                          {Kind::kink_angle, "kink angle"}};
    return table;
  }

  std::optional<CrackQuantity>
  parse_crack_quantity(QuantityPhrase   &phrase,
                       const Cuts       &cuts,
                       const SectionLaw &section,
                       const Constants  &constants)
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
    EnergyRelease::check_law(section, phrase.where + ":");
    AssertThrow(section.is_linear() ||
                  quantity.kind == CrackQuantity::Kind::energy_release_rate,
                ExcMessage(phrase.where + ": '" + found->second +
                           "' is of linear sections, and the law of this one "
                           "isn't linear; it has an 'energy release rate'."));
    const std::string form = phrase.where + ": write '" + found->second +
                             " of CUT begin' or '" + found->second +
                             " of CUT end' of a cut, '" + found->second +
                             " of tip (x, y, z)' of a slit of the mesh, with "
                             "'radii INNER, OUTER' behind it for other radii.";
    AssertThrow(phrase.take("of"), ExcMessage(form));
    const std::string tip = phrase.up_to("radii");
    const bool        is_slit =
      QuantityPhrase{tip, ""}.take("tip") && tip.find('(') != std::string::npos;
    if (is_slit)
      quantity.point = evaluate_point(tip.substr(3), phrase.where, constants);
    else
      {
        const auto        space = tip.find_last_of(' ');
        const std::string end =
          space == std::string::npos ? "" : tip.substr(space + 1);
        AssertThrow(end == "begin" || end == "end", ExcMessage(form));
        quantity.cut_end = {find_cut(Text::trim(tip.substr(0, space)),
                                     cuts,
                                     phrase.where),
                            end == "end"};
      }
    if (!phrase.text.empty())
      quantity.plateau = parse_radii(phrase.text, phrase.where, constants);
    return quantity;
  }

  CrackTip
  find_tip_of(const Discretization &discretization,
              const Cuts           &cuts,
              const CrackQuantity  &quantity)
  {
    if (!quantity.cut_end)
      return find_crack_tip(discretization, quantity.point, quantity.where);
    return make_crack_tip(discretization,
                          find_cut_tip(discretization,
                                       cuts,
                                       quantity.cut_end->cut,
                                       quantity.cut_end->at_end,
                                       quantity.where),
                          quantity.where);
  }

  double
  evaluate_crack_quantity(const SolvedShell   &shell,
                          const CrackQuantity &quantity)
  {
    const auto tip =
      find_tip_of(shell.discretization, shell.model.cuts, quantity);
    const EnergyRelease release(shell,
                                tip,
                                quantity.plateau.value_or(
                                  default_plateau(tip, shell.model.cuts)),
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
        case Kind::kink_angle:
          {
            const auto plate = release.plate_or_throw();
            return largest_hoop_stress(
                     release.rate_and_intensities(plate).intensities,
                     plate)
                     .angle *
                   180. / numbers::PI;
          }
      }
    Assert(false, ExcInternalError());
    return 0.;
  }
} // namespace Nacre
