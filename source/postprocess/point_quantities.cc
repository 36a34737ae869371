// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/expression.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/text.h>
#include <nacre/postprocess/point_quantities.h>

#include <algorithm>

namespace Nacre
{
  const Selection<PointQuantity::Kind> &
  selection(PointQuantity::Kind)
  {
    using Kind                         = PointQuantity::Kind;
    static const Selection<Kind> table = {
      {Kind::stress, "stress"},
      {Kind::principal_stress, "principal stress"},
      {Kind::von_mises_stress, "von Mises stress"},
      {Kind::membrane_force, "membrane force"},
      {Kind::principal_membrane_force, "principal membrane force"},
      {Kind::moment, "moment"},
      {Kind::principal_moment, "principal moment"},
      {Kind::transverse_shear, "transverse shear"},
      {Kind::rotation, "rotation"}};
    return table;
  }

  const Selection<ExtremeStress::Kind> &
  selection(ExtremeStress::Kind)
  {
    using Kind                         = ExtremeStress::Kind;
    static const Selection<Kind> table = {
      {Kind::largest_principal, "largest principal stress"},
      {Kind::smallest_principal, "smallest principal stress"},
      {Kind::largest_von_mises, "largest von Mises stress"}};
    return table;
  }

  namespace
  {
    using Kind = PointQuantity::Kind;

    bool
    has_face(const Kind kind)
    {
      return kind == Kind::stress || kind == Kind::principal_stress ||
             kind == Kind::von_mises_stress;
    }

    /** The components of a kind by their names; none of some kinds. */
    std::vector<std::pair<std::string, std::array<unsigned int, 2>>>
    components(const Kind kind)
    {
      if (kind == Kind::stress || kind == Kind::membrane_force ||
          kind == Kind::moment)
        return {{"11", {{0, 0}}}, {"22", {{1, 1}}}, {"12", {{0, 1}}}};
      if (kind == Kind::von_mises_stress || kind == Kind::rotation)
        return {};
      return {{"1", {{0, 0}}}, {"2", {{1, 1}}}};
    }

    /** Whether a quantity depends on the choice of the axis 1. */
    bool
    has_axes(const Kind kind)
    {
      return kind == Kind::stress || kind == Kind::membrane_force ||
             kind == Kind::moment || kind == Kind::transverse_shear;
    }

    /** How the quantities of a kind are written, for messages. */
    std::string
    form(const Kind kind)
    {
      const auto  names = components(kind);
      std::string text  = "write '" + name_of(kind);
      for (const auto &component : names)
        text += (component.first == names.front().first ? " " : "|") +
                component.first;
      if (kind == Kind::rotation)
        text += " x|y|z|(a, b, c)";
      if (has_face(kind))
        text += " bottom|middle|top";
      if (has_axes(kind))
        text += " [along x|y|z|(a, b, c)]";
      return text + " at (x, y, z)'";
    }

    Tensor<1, spacedim>
    parse_vector(const std::string    &word,
                 const QuantityPhrase &phrase,
                 const Constants      &constants)
    {
      const auto direction = parse_direction(word, phrase.where, constants);
      AssertThrow(direction,
                  ExcMessage(phrase.where +
                             ": 'normal' is no direction here; choose x, y, z "
                             "or (a, b, c)."));
      return *direction;
    }

    /** The results at the point, in the axes of the quantity. */
    double
    value_of(const PointQuantity &quantity, PointResults r)
    {
      if (quantity.axis)
        {
          r.e[0] = projected_direction(*quantity.axis,
                                       r.normal,
                                       r.point,
                                       quantity.where +
                                         ": the direction after 'along'");
          r.e[1] = cross_product_3d(r.normal, r.e[0]);
        }
      const auto &stress = r.stress[static_cast<unsigned int>(quantity.face)];
      const auto [i, j]  = quantity.component;
      const auto in_axes = [&, i = i, j = j](const auto &T) {
        return r.in_axes(T)[i][j];
      };
      switch (quantity.kind)
        {
          case Kind::stress:
            return in_axes(stress);
          case Kind::principal_stress:
            return r.principal(stress)[i].value;
          case Kind::von_mises_stress:
            return r.von_mises(quantity.face);
          case Kind::membrane_force:
            return in_axes(r.membrane_forces);
          case Kind::principal_membrane_force:
            return r.principal(r.membrane_forces)[i].value;
          case Kind::moment:
            return in_axes(r.moments);
          case Kind::principal_moment:
            return r.principal(r.moments)[i].value;
          case Kind::transverse_shear:
            return r.transverse_shear * r.e[i];
          case Kind::rotation:
            return r.rotation * quantity.direction;
        }
      Assert(false, ExcInternalError());
      return 0.;
    }
  } // namespace

  std::optional<PointQuantity>
  parse_point_quantity(QuantityPhrase &phrase, const Constants &constants)
  {
    const auto &kinds = selection(Kind());
    const auto  found =
      std::find_if(kinds.begin(), kinds.end(), [&](const auto &kind) {
        return phrase.take(kind.second);
      });
    if (found == kinds.end())
      return {};
    PointQuantity quantity{found->first};
    quantity.where = phrase.where;

    // "at" may be the first word that is left.
    phrase.text         = " " + phrase.text;
    QuantityPhrase what = {phrase.up_to("at"), phrase.where};
    AssertThrow(!phrase.text.empty(),
                ExcMessage(phrase.where + ": " + form(quantity.kind) + "."));
    quantity.point = evaluate_point(phrase.text, phrase.where, constants);

    const auto names = components(quantity.kind);
    if (!names.empty())
      {
        const std::string word = what.take_word();
        const auto        name =
          std::find_if(names.begin(), names.end(), [&](const auto &component) {
            return component.first == word;
          });
        AssertThrow(name != names.end(),
                    ExcMessage(phrase.where + ": '" + word +
                               "' is no component of a quantity at a point; " +
                               form(quantity.kind) + "."));
        quantity.component = name->second;
      }
    if (quantity.kind == Kind::rotation)
      quantity.direction =
        parse_vector(std::exchange(what.text, ""), what, constants);
    if (has_face(quantity.kind))
      quantity.face = parse_face(what.take_word(), what);
    if (has_axes(quantity.kind) && what.take("along"))
      quantity.axis =
        parse_vector(std::exchange(what.text, ""), what, constants);
    AssertThrow(what.text.empty(),
                ExcMessage(phrase.where + ": '" + what.text +
                           "' is not understood; " + form(quantity.kind) +
                           "."));
    return quantity;
  }

  std::optional<ExtremeStress>
  parse_extreme_stress(QuantityPhrase &phrase)
  {
    for (const auto &[kind, name] : selection(ExtremeStress::Kind()))
      if (phrase.take(name))
        return ExtremeStress{kind, parse_face(phrase.text, phrase)};
    return {};
  }

  Face
  parse_face(const std::string &word, const QuantityPhrase &phrase)
  {
    const auto face = find_value<Face>(word);
    AssertThrow(
      face,
      ExcMessage(
        Text::unknown_name(phrase.where, "face", word, names_of<Face>())));
    return *face;
  }

  double
  value_at_point(const ShellState                                  &state,
                 const Point<spacedim>                             &point,
                 const std::string                                 &where,
                 const std::function<double(const PointResults &)> &value,
                 const bool                                         with_shear)
  {
    const auto &discretization = state.discretization;
    const auto  place          = discretization.locate(point, where);
    double      result         = 0.;
    run_on_all_ranks(discretization.communicator(), [&]() {
      if (!place.is_mine)
        return;
      CellResults results(state, Quadrature<dim>(place.unit), with_shear);
      results.reinit(place.part);
      result = value(results.at(0));
    });
    return Utilities::MPI::sum(result, discretization.communicator());
  }

  double
  largest_value(const ShellState                                  &state,
                const std::function<double(const PointResults &)> &value)
  {
    const auto &discretization = state.discretization;
    double      largest        = -std::numeric_limits<double>::infinity();
    run_on_all_ranks(discretization.communicator(), [&]() {
      CellResults results(
        state,
        Quadrature<dim>(discretization.scalar_fe().get_unit_support_points()),
        false,
        true);
      for (const CellPart &part : discretization.owned_parts())
        {
          results.reinit(part);
          for (unsigned int q = 0; q < results.n_points(); ++q)
            largest = std::max(largest, value(results.at(q)));
        }
    });
    return Utilities::MPI::max(largest, discretization.communicator());
  }

  double
  evaluate_point_quantity(const ShellState    &state,
                          const PointQuantity &quantity)
  {
    return value_at_point(
      state,
      quantity.point,
      quantity.where,
      [&](const PointResults &results) { return value_of(quantity, results); },
      quantity.kind == Kind::transverse_shear);
  }

  TrilinosWrappers::MPI::Vector
  point_functional(const Discretization  &discretization,
                   const Point<spacedim> &point,
                   const std::string     &where,
                   const std::function<PointWeights(
                     const ShellCellValues &,
                     const std::vector<types::global_dof_index> &)> &weights)
  {
    const auto                    place = discretization.locate(point, where);
    TrilinosWrappers::MPI::Vector g(discretization.locally_owned_dofs(),
                                    discretization.communicator());
    run_on_all_ranks(discretization.communicator(), [&]() {
      if (!place.is_mine)
        return;
      ShellCellValues values(discretization,
                             Quadrature<dim>(place.unit),
                             false,
                             ShellCellValues::Points::given);
      values.reinit(place.part);
      std::vector<types::global_dof_index> dofs;
      discretization.get_dof_indices(place.part, dofs);
      const PointWeights here   = weights(values, dofs);
      const auto        &shapes = values.shapes();
      for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
        {
          auto part = shapes.value(0, a) * here.value;
          for (unsigned int alpha = 0; alpha < dim; ++alpha)
            part += shapes.gradient(0, a)[alpha] * here.derivatives[alpha];
          for (unsigned int c = 0; c < spacedim; ++c)
            g(dofs[values.dof(a, c)]) += part[c];
        }
      for (unsigned int k = 0; k < values.n_tip_functions(); ++k)
        {
          const auto &psi  = values.tip_function(0, k);
          double      part = here.value * psi.value;
          for (unsigned int alpha = 0; alpha < dim; ++alpha)
            part += psi.first[alpha] * here.derivatives[alpha];
          g(dofs[values.tip_dof(k)]) += part;
        }
    });
    g.compress(VectorOperation::add);
    return g;
  }

  Angle
  evaluate_angle(const Discretization                &discretization,
                 const TrilinosWrappers::MPI::Vector &displacement,
                 const PointQuantity                 &quantity)
  {
    using Vector3 = Tensor<1, spacedim>;
    Angle      angle;
    const auto weights = [&](const ShellCellValues                      &values,
                             const std::vector<types::global_dof_index> &dofs) {
      const auto &shapes = values.shapes();
      auto        phi    = values.frame(0).a_cov;
      for (unsigned int alpha = 0; alpha < dim; ++alpha)
        {
          for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
            for (unsigned int c = 0; c < spacedim; ++c)
              phi[alpha][c] += shapes.gradient(0, a)[alpha] *
                               displacement(dofs[values.dof(a, c)]);
          for (unsigned int k = 0; k < values.n_tip_functions(); ++k)
            phi[alpha] += displacement(dofs[values.tip_dof(k)]) *
                          values.tip_function(0, k).first[alpha];
        }
      const Vector3 &d  = quantity.direction;
      const Vector3 &t0 = values.frame(0).t0;
      const Vector3  s  = cross_product_3d(d, t0);
      const Vector3  p  = t0 - (d * t0) * d;
      AssertThrow(s.norm() > 1e-6,
                  ExcMessage(quantity.where +
                             ": the normal doesn't turn about itself; "
                             "choose a direction along the surface."));
      const Vector3 n = cross_product_3d(phi[0], phi[1]);
      const double  x = n * p, y = n * s;
      angle.value = std::atan2(y, x);
      // d(angle) = w . dn
      const Vector3 w = (x * s - y * p) / (x * x + y * y);
      PointWeights  result;
      result.derivatives = {
        {cross_product_3d(phi[1], w), cross_product_3d(w, phi[0])}};
      return result;
    };
    angle.gradient =
      point_functional(discretization, quantity.point, quantity.where, weights);
    angle.value =
      Utilities::MPI::sum(angle.value, discretization.communicator());
    return angle;
  }

  double
  evaluate_extreme_stress(const ShellState    &state,
                          const ExtremeStress &quantity)
  {
    using Extreme     = ExtremeStress::Kind;
    const double sign = quantity.kind == Extreme::smallest_principal ? -1. : 1.;
    return sign * largest_value(state, [&](const PointResults &r) {
             const auto &stress =
               r.stress[static_cast<unsigned int>(quantity.face)];
             return quantity.kind == Extreme::largest_von_mises ?
                      r.von_mises(quantity.face) :
                      sign * r.principal(stress)[sign > 0. ? 0 : 1].value;
           });
  }
} // namespace Nacre
