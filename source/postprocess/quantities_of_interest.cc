// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/forms/assembly.h>
#include <nacre/mechanics/j2_plasticity.h>
#include <nacre/postprocess/crack_quantities.h>
#include <nacre/postprocess/cut_quantities.h>
#include <nacre/postprocess/mode_quantities.h>
#include <nacre/postprocess/ply_quantities.h>
#include <nacre/postprocess/point_quantities.h>
#include <nacre/postprocess/quantities_of_interest.h>
#include <nacre/postprocess/reactions.h>
#include <nacre/postprocess/simple_quantities.h>
#include <nacre/postprocess/state_quantities.h>
#include <nacre/problem/exact_solution.h>
#include <nacre/problem/midsurface.h>

#include <functional>
#include <sstream>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, spacedim>;

    /** g of direction . u(point) = g . u; none: along the normal. */
    TrilinosWrappers::MPI::Vector
    displacement_functional(const Discretization         &discretization,
                            const Point<spacedim>        &point,
                            const std::optional<Vector3> &direction,
                            const std::string            &where)
    {
      return point_functional(discretization,
                              point,
                              where,
                              [&](const ShellCellValues &values,
                                  const auto & /*dofs*/) {
                                PointWeights weights;
                                weights.value =
                                  direction ? *direction : values.frame(0).t0;
                                return weights;
                              });
    }

    double
    displacement_at(const ShellState             &shell,
                    const Point<spacedim>        &point,
                    const std::optional<Vector3> &direction,
                    const std::string            &where)
    {
      const auto g =
        displacement_functional(shell.discretization, point, direction, where);
      double value = 0.;
      for (const auto i : shell.discretization.locally_owned_dofs())
        value += g(i) * shell.displacement(i);
      return Utilities::MPI::sum(value, shell.discretization.communicator());
    }

    using Phrase   = QuantityPhrase;
    using Quantity = QuantitiesOfInterest::Quantity;

    void
    set_of_displacement(
      Quantity                                        &quantity,
      const std::function<double(const ShellState &)> &evaluate)
    {
      quantity.evaluate        = evaluate;
      quantity.of_displacement = evaluate;
      quantity.is_static       = true;
    }

    /** "DIRECTION at (point)" */
    void
    parse_displacement(QuantitiesOfInterest::Quantity &quantity,
                       Phrase                          phrase,
                       const Constants                &constants)
    {
      const std::string &where = phrase.where;
      const auto         direction =
        parse_direction(phrase.up_to("at"), where, constants);
      AssertThrow(!phrase.text.empty(),
                  ExcMessage(where + ": write 'displacement z at (x, y, z)'."));
      const auto point = evaluate_point(phrase.text, where, constants);
      quantity.point   = point;
      set_of_displacement(quantity, [=](const ShellState &shell) {
        return displacement_at(shell, point, direction, where);
      });
      quantity.goal.load = [=](const Discretization &discretization) {
        return displacement_functional(discretization, point, direction, where);
      };
    }

    /** "EDGE, point (x, y, z), ...", or "all" */
    Supports
    parse_supports(const std::string &text,
                   const std::string &where,
                   const Midsurface  &midsurface,
                   const Constants   &constants)
    {
      Supports supports;
      supports.where = where;
      for (const auto &item : Text::split(text, ',', where))
        if (Phrase phrase{item, where}; phrase.take("point") &&
                                        !phrase.text.empty() &&
                                        phrase.text.front() == '(')
          supports.points.push_back(
            evaluate_point(phrase.text, where, constants));
        else if (item == "all")
          supports.all = true;
        else
          {
            const auto ids = midsurface.edge_ids(item, where);
            supports.edges.insert(ids.begin(), ids.end());
          }
      return supports;
    }

    /** "DIRECTION of SUPPORTS" of a reaction or, "about (point)", its moment */
    void
    parse_reaction(QuantitiesOfInterest::Quantity &quantity,
                   Phrase                          phrase,
                   const bool                      is_moment,
                   const Midsurface               &midsurface,
                   const Constants                &constants)
    {
      const std::string &where = phrase.where;
      const auto         direction =
        parse_direction(phrase.up_to("of"), where, constants);
      AssertThrow(direction && !phrase.text.empty(),
                  ExcMessage(where +
                             ": write 'reaction x of EDGE' or 'moment x of "
                             "EDGE', with 'EDGE, point (x, y, z), ...' or "
                             "'all' for several supports."));
      quantity.is_static = true;
      const auto supports =
        parse_supports(phrase.up_to(is_moment ? "about" : ";"),
                       where,
                       midsurface,
                       constants);
      if (!is_moment)
        {
          quantity.evaluate = [=](const SolvedShell &shell) {
            return reaction(shell, supports, *direction);
          };
          quantity.goal.reaction =
            [=](const Discretization         &discretization,
                const DisplacementConditions &conditions) {
              return support_displacement(discretization,
                                          conditions,
                                          supports,
                                          *direction);
            };
          return;
        }
      const auto origin = phrase.text.empty() ?
                            Point<spacedim>() :
                            evaluate_point(phrase.text, where, constants);
      quantity.evaluate = [=](const SolvedShell &shell) {
        return reaction_moment(shell, supports, *direction, origin);
      };
    }

    /** "ply stress 1 of 3 top at (point)", or "Tsai-Wu index at (point)" */
    void
    parse_ply(QuantitiesOfInterest::Quantity &quantity,
              Phrase                          phrase,
              const PlyQuantity::Kind         kind,
              const Constants                &constants)
    {
      const std::string &where    = phrase.where;
      const bool         is_index = kind == PlyQuantity::Kind::tsai_wu ||
                            kind == PlyQuantity::Kind::maximum_stress;
      // "at" is the first word of an index, which has no other.
      phrase.text                 = " " + phrase.text;
      const std::string component = is_index ? "" : phrase.up_to("of");
      if (!is_index)
        phrase.text = " " + phrase.text;
      const std::string ply = phrase.up_to("at");
      AssertThrow(!phrase.text.empty() && (!is_index || ply.empty()),
                  ExcMessage(where + ": " +
                             (is_index ? "write 'Tsai-Wu index at (x, y, z)' "
                                         "or 'maximum stress index at (x, y, "
                                         "z)'" :
                                         ply_quantity_form) +
                             "."));
      const auto  point = evaluate_point(phrase.text, where, constants);
      PlyQuantity ply_quantity{kind, 0, 0, 0, point, where};
      if (!is_index)
        ply_quantity = parse_ply_quantity(kind, component, ply, point, where);
      quantity.point = point;
      set_of_displacement(quantity, [=](const ShellState &shell) {
        return evaluate_ply_quantity(shell, ply_quantity);
      });
    }

    /** The kinds of parse_ply(). */
    const std::vector<std::pair<std::string, PlyQuantity::Kind>> &
    ply_kinds()
    {
      static const std::vector<std::pair<std::string, PlyQuantity::Kind>>
        kinds = {{"ply stress", PlyQuantity::Kind::stress},
                 {"ply strain", PlyQuantity::Kind::strain},
                 {"Tsai-Wu index", PlyQuantity::Kind::tsai_wu},
                 {"maximum stress index", PlyQuantity::Kind::maximum_stress}};
      return kinds;
    }

    /**
     * Whether "moment" begins that of reactions, which is about a direction of
     * space, and not a component of the shell's moments at a point. Takes the
     * word if so.
     */
    bool
    is_reaction_moment(Phrase &phrase)
    {
      Phrase rest = phrase;
      if (!rest.take("moment") || rest.take("11") || rest.take("22") ||
          rest.take("12"))
        return false;
      phrase = rest;
      return true;
    }

    /** Those of simple_quantities(); returns whether the words are one. */
    bool
    parse_simple(QuantitiesOfInterest::Quantity &quantity,
                 const Phrase                   &phrase,
                 const ExactSolution            &exact_solution)
    {
      const std::string &kind = phrase.text;
      for (const auto &simple : simple_quantities())
        if (kind == simple.name)
          {
            AssertThrow(!simple.is_error || exact_solution.is_known(),
                        ExcMessage(phrase.where + ": '" + kind +
                                   "' needs 'Exact solution/Displacement'."));
            quantity.evaluate       = simple.evaluate;
            quantity.is_static      = simple.is_static;
            quantity.is_error       = simple.is_error;
            quantity.goal.is_energy = (kind == "energy");
            return true;
          }
      return false;
    }

    /** Whether it is a result of the section's states; then it is filled. */
    bool
    parse_result_of_state(QuantitiesOfInterest::Quantity &quantity,
                          Phrase                         &phrase,
                          const SectionLaw               &section,
                          const Constants                &constants)
    {
      const auto of_state =
        parse_state_quantity(phrase, section.state_result_names(), constants);
      if (!of_state)
        return false;
      quantity.point = of_state->point;
      set_of_displacement(quantity, [of_state](const ShellState &shell) {
        return evaluate_state_quantity(shell, *of_state);
      });
      return true;
    }

    void
    parse_at_point(QuantitiesOfInterest::Quantity &quantity,
                   const PointQuantity            &at_point)
    {
      quantity.point = at_point.point;
      set_of_displacement(quantity, [=](const ShellState &shell) {
        return evaluate_point_quantity(shell, at_point);
      });
      if (at_point.kind == PointQuantity::Kind::rotation)
        quantity.angle = [=](const Discretization &discretization,
                             const TrilinosWrappers::MPI::Vector &u) {
          return evaluate_angle(discretization, u, at_point);
        };
    }

    /** Those of cracks and cuts; returns whether the words are one. */
    bool
    parse_of_cut(QuantitiesOfInterest::Quantity &quantity,
                 Phrase                         &phrase,
                 const Cuts                     &cuts,
                 const SectionLaw               &section,
                 const Constants                &constants)
    {
      if (const auto crack =
            parse_crack_quantity(phrase, cuts, section, constants))
        {
          quantity.check = [=](const Discretization &mesh) {
            find_tip_of(mesh, cuts, *crack);
          };
          quantity.evaluate = [crack](const SolvedShell &shell) {
            return evaluate_crack_quantity(shell, *crack);
          };
          quantity.is_static = true;
          return true;
        }
      const auto of_cut = parse_cut_quantity(phrase, cuts, constants);
      if (!of_cut)
        return false;
      set_of_displacement(quantity, [of_cut](const ShellState &shell) {
        return evaluate_cut_quantity(shell, *of_cut);
      });
      quantity.is_static = of_cut->kind == CutQuantity::Kind::opening;
      return true;
    }

    /** All that isn't a parse_simple(): evaluate, and what is known of it. */
    void
    parse_kind(QuantitiesOfInterest::Quantity &quantity,
               Phrase                          phrase,
               const Midsurface               &midsurface,
               const Cuts                     &cuts,
               const SectionLaw               &section,
               const Constants                &constants)
    {
      const std::string kind = phrase.text;
      // "energy release rate" begins as "energy" does.
      if (parse_of_cut(quantity, phrase, cuts, section, constants))
        return;
      for (const auto &simple : simple_quantities())
        AssertThrow(!phrase.take(simple.name),
                    ExcMessage(phrase.where + ": '" + phrase.text +
                               "' after the kind of quantity is not "
                               "understood."));
      for (const auto &[name, ply_kind] : ply_kinds())
        if (phrase.take(name))
          return parse_ply(quantity, phrase, ply_kind, constants);
      if (parse_result_of_state(quantity, phrase, section, constants))
        return;
      if (const auto mode = parse_mode_quantity(kind, phrase.where))
        quantity.evaluate = [mode](const SolvedShell &shell) {
          return evaluate_mode_quantity(shell.modes, *mode);
        };
      else if (const auto extreme = parse_extreme_stress(phrase))
        set_of_displacement(quantity, [extreme](const ShellState &shell) {
          return evaluate_extreme_stress(shell, *extreme);
        });
      else if (is_reaction_moment(phrase))
        parse_reaction(quantity, phrase, true, midsurface, constants);
      else if (const auto at_point = parse_point_quantity(phrase, constants))
        parse_at_point(quantity, *at_point);
      else if (phrase.take("displacement"))
        parse_displacement(quantity, phrase, constants);
      else if (phrase.take("reaction"))
        parse_reaction(quantity, phrase, false, midsurface, constants);
      else
        AssertThrow(false,
                    ExcMessage(
                      Text::unknown_name(phrase.where,
                                         "kind of quantity",
                                         kind,
                                         QuantitiesOfInterest::kinds())));
    }

    /** A quantity's name is a column of the table. */
    void
    check_name(const std::string &name,
               const std::string &entry,
               const std::string &parameter)
    {
      static const std::set<std::string> columns = {"element",
                                                    "degree",
                                                    "eta",
                                                    "thickness",
                                                    "cells",
                                                    "dofs",
                                                    "ratio",
                                                    "rate",
                                                    "estimate",
                                                    "bound",
                                                    "effectivity",
                                                    "setup_s",
                                                    "assembly_s",
                                                    "solve_s",
                                                    "estimate_s"};
      AssertThrow(!name.empty(),
                  ExcMessage(parameter + ": '" + entry +
                             "' has no name before '='."));
      AssertThrow(columns.count(name) == 0,
                  ExcMessage(parameter + ": '" + name +
                             "' is another column of the table; choose "
                             "another name."));
    }
  } // namespace

  QuantityParameters::QuantityParameters()
    : ParameterAcceptor("/Quantities")
  {
    add_parameter(
      "Quantities",
      text_,
      "'name = kind [-> reference]; ...'. Kinds: displacement "
      "x|y|z|normal|(a, b, c) at (point); maximum displacement; energy; "
      "membrane energy; bending energy; edge energy; reaction x|y|z of "
      "SUPPORTS; "
      "moment x|y|z of SUPPORTS [about (point)], SUPPORTS 'EDGE, point (x, y, "
      "z), ...' or 'all', each node once; L2 error; H1 error; energy "
      "error; stress 11|22|12 bottom|middle|top at (point), principal stress "
      "1|2 bottom|middle|top at (point), von Mises stress bottom|middle|top at "
      "(point), membrane force|moment 11|22|12 at (point), principal membrane "
      "force|moment 1|2 at (point), transverse shear 1|2 at (point), rotation "
      "x|y|z|(a, b, c) at (point), of the normal; components in the axes of "
      "'Output/Reference direction', or 'along x|y|z|(a, b, c)' before 'at'; "
      "largest|smallest principal stress, largest von Mises stress "
      "bottom|middle|top, over the nodes of all cells; of metals "
      "accumulated plastic strain bottom|middle|top at (point), largest "
      "accumulated plastic strain bottom|middle|top, plastic dissipation; in "
      "laminates ply "
      "stress|strain 1|2|12 of NUMBER bottom|top at "
      "(point), Tsai-Wu index at (point), maximum stress index at (point), the "
      "largest of all plies; of cuts length of CUT, opening "
      "[x|y|z|normal|(a, b, c)] of CUT at (point), the left lip less the right "
      "one; in dynamics kinetic energy, total energy, "
      "external work, work "
      "of prescribed motion, dissipation (by mass damping), released "
      "energy (where cuts grow), energy balance "
      "(gained by the scheme), momentum x|y|z, angular momentum x|y|z about "
      "the origin; in buckling load factor NUMBER, in vibration omega NUMBER "
      "(of time) and frequency NUMBER, omega/(2 pi), in both multiplicity "
      "NUMBER, modes counted from 1; energy release rate|K_I|K_II|K_M|K_T|kink "
      "angle of CUT begin|end [radii INNER, OUTER], or of tip (point) "
      "for a slit of the mesh, the angle in degrees. Units: those of the "
      "quantity.");
    add_parameter("Balance about",
                  balance_text_,
                  "A point '(x, y, z)': the resultants of loads and reactions "
                  "and their moments about the point are printed after the "
                  "results. Units: length.");
  }

  std::vector<std::string>
  QuantitiesOfInterest::kinds()
  {
    std::vector<std::string> names = {"displacement", "reaction"};
    for (const auto &name : names_of<PointQuantity::Kind>())
      names.push_back(name);
    for (const auto &name : names_of<ExtremeStress::Kind>())
      names.push_back(name);
    for (const std::string name : J2Plasticity::result_names)
      {
        names.push_back(name);
        names.push_back("largest " + name);
      }
    for (const auto &name : names_of<CrackQuantity::Kind>())
      names.push_back(name);
    for (const auto &kind : ply_kinds())
      names.push_back(kind.first);
    for (const auto &name : names_of<CutQuantity::Kind>())
      names.push_back(name);
    for (const auto &name : mode_quantity_names())
      names.push_back(name);
    for (const auto &simple : simple_quantities())
      names.push_back(simple.name);
    return names;
  }

  QuantitiesOfInterest
  QuantityParameters::make(const Midsurface    &midsurface,
                           const Cuts          &cuts,
                           const ExactSolution &exact_solution,
                           const SectionLaw    &section,
                           const Constants     &constants) const
  {
    const std::string       parameter = "Quantities/Quantities";
    std::optional<Point<3>> balance_origin;
    if (!balance_text_.empty())
      balance_origin =
        evaluate_point(balance_text_, "Quantities/Balance about", constants);
    std::vector<QuantitiesOfInterest::Quantity> quantities;
    std::set<std::string>                       names;
    for (const auto &entry : Text::split(text_, ';', parameter))
      {
        const auto [name, definition] = Text::key_and_value(entry);
        AssertThrow(!definition.empty(),
                    ExcMessage(parameter + ": '" + entry +
                               "' is not of the form 'name = kind'."));
        check_name(name, entry, parameter);
        AssertThrow(names.insert(name).second,
                    ExcMessage(parameter + ": two quantities are named '" +
                               name + "'."));
        const std::string              where = parameter + ", '" + name + "'";
        QuantitiesOfInterest::Quantity quantity;
        quantity.name = name;

        const auto arrow = Text::find(definition, "->");
        if (arrow != std::string::npos)
          quantity.reference =
            evaluate_number(Text::trim(definition.substr(arrow + 2)),
                            where + ", the reference",
                            constants);
        AssertThrow(!quantity.reference || *quantity.reference != 0.,
                    ExcMessage(where + ": the reference is 0, so that there "
                                       "is no ratio to it."));
        const Phrase phrase{Text::trim(definition.substr(0, arrow)), where};
        if (!parse_simple(quantity, phrase, exact_solution))
          parse_kind(quantity, phrase, midsurface, cuts, section, constants);
        quantities.push_back(std::move(quantity));
      }
    return {std::move(quantities), balance_origin};
  }
} // namespace Nacre
