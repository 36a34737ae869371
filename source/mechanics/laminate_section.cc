// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/mechanics/checked_value.h>
#include <nacre/mechanics/laminate_section.h>
#include <nacre/mechanics/ply_stack.h>
#include <nacre/mechanics/section_regions.h>
#include <nacre/mechanics/surface_axes.h>

#include <algorithm>
#include <sstream>

namespace Nacre
{
  namespace
  {
    const std::string parameters = "Section/Laminate/";

    /** The values of a material by their keys. */
    std::map<std::string, double>
    read_values(const std::string &text,
                const std::string &where,
                const Constants   &constants)
    {
      static const std::vector<std::string> keys = {"E1",
                                                    "E2",
                                                    "nu12",
                                                    "G12",
                                                    "density",
                                                    "alpha1",
                                                    "alpha2",
                                                    "ply",
                                                    "Xt",
                                                    "Xc",
                                                    "Yt",
                                                    "Yc",
                                                    "S"};
      std::map<std::string, double>         values;
      for (const auto &item : Text::split(text, ',', where))
        {
          const auto [key, value] = Text::key_and_value(item);
          AssertThrow(std::find(keys.begin(), keys.end(), key) != keys.end(),
                      ExcMessage(
                        Text::unknown_name(where, "value", key, keys)));
          const std::string what = where + ", " + key;
          AssertThrow(values.count(key) == 0,
                      ExcMessage(what + " stands twice."));
          AssertThrow(!value.empty(),
                      ExcMessage(what + " has no value; write '" + key +
                                 " = number'."));
          values[key] = evaluate_number(value, what, constants);
          AssertThrow(key == "nu12" || key.substr(0, 5) == "alpha" ||
                        values[key] > 0. ||
                        (key == "density" && values[key] == 0.),
                      ExcMessage(what + ": " + Text::number(values[key]) +
                                 (key == "density" ?
                                    "; it must not be negative." :
                                    "; it must be positive.")));
        }
      return values;
    }

    /** The material of the @p values; throws if some are missing. */
    OrthotropicMaterial
    make_material(const std::map<std::string, double> &values,
                  const std::string                   &where)
    {
      for (const char *const key : {"E1", "E2", "nu12", "G12"})
        AssertThrow(values.count(key) == 1,
                    ExcMessage(where + " has no value '" + key +
                               "'; E1, E2, nu12 and G12 are needed."));
      OrthotropicMaterial material;
      material.E1   = values.at("E1");
      material.E2   = values.at("E2");
      material.nu12 = values.at("nu12");
      material.G12  = values.at("G12");
      for (const auto &[key, member] :
           {std::make_pair("density", &OrthotropicMaterial::density),
            std::make_pair("alpha1", &OrthotropicMaterial::alpha1),
            std::make_pair("alpha2", &OrthotropicMaterial::alpha2)})
        if (values.count(key) == 1)
          material.*member = values.at(key);
      const double product =
        material.nu12 * material.nu12 * material.E2 / material.E1;
      AssertThrow(product < 1.,
                  ExcMessage(where + ", nu12: " + Text::number(material.nu12) +
                             "; nu12^2 E2/E1 is " + Text::number(product) +
                             " and must be smaller than 1."));
      unsigned int n_strengths = 0;
      for (const char *const key : {"Xt", "Xc", "Yt", "Yc", "S"})
        n_strengths += values.count(key);
      AssertThrow(n_strengths == 0 || n_strengths == 5,
                  ExcMessage(where + " has " + std::to_string(n_strengths) +
                             " of the strengths Xt, Xc, Yt, Yc, S; all of "
                             "them are needed, or none."));
      if (n_strengths == 5)
        material.strengths = {values.at("Xt"),
                              values.at("Xc"),
                              values.at("Yt"),
                              values.at("Yc"),
                              values.at("S")};
      return material;
    }
  } // namespace

  LaminateSection::LaminateSection()
    : ParameterAcceptor("/Section/Laminate")
  {
    texts_.offset    = "0";
    texts_.direction = "x";
    add_parameter(
      "Materials",
      materials_text_,
      "'name: key = value, key = value; name: ...'. Keys: E1 along "
      "the fibres, E2 across, G12 (units: force/length^2), nu12 "
      "(none), density (mass/length^3), alpha1, alpha2, the thermal "
      "expansion along and across the fibres (1/temperature), "
      "ply, the thickness of a "
      "ply of this material (length), and for failure indices "
      "the strengths Xt, Xc along the fibres in tension and "
      "compression, Yt, Yc across, S in shear "
      "(force/length^2, all positive). Values are numbers or "
      "expressions of constants.");
    add_parameter(
      "Stack",
      texts_.stack,
      "The plies' angles from the bottom to the top: "
      "'[0/45/-45/90]s', '[0/90]2s', '[+-45/0_2]', "
      "'[(0/90)_2/45]'; with several materials '[0_carbon/0_2glass]'. "
      "Positive from the material direction, the axis 1, towards "
      "the axis 2, which is the normal of the top times the axis 1. "
      "Units: degrees.");
    add_parameter("Ply thickness",
                  texts_.ply_thickness,
                  "Thickness of each ply whose material has none; empty if "
                  "'Thickness' is given. Units: length.");
    add_parameter("Thickness",
                  texts_.thickness,
                  "The whole thickness, a number or an expression of x, y, z, "
                  "in place of 'Ply thickness': plies have equal parts of it, "
                  "or parts in the ratio of their materials' plies. "
                  "Units: length.");
    add_parameter("Offset",
                  texts_.offset,
                  "Distance of the laminate's middle from the mid-surface of "
                  "the mesh, positive towards the top; may use h, the whole "
                  "thickness. Units: length.");
    add_parameter("Material direction",
                  texts_.direction,
                  "The axis 1 is its projection onto the surface: x, y, z or "
                  "three expressions of x, y, z, as '-y, x, 0' around the axis "
                  "z. Or u, v: along the lines of this parameter of the "
                  "surface, in which it grows. Units: none.");
    add_parameter("Top",
                  top_text_,
                  "Where the top of the stack is. normal: on the side of the "
                  "surface's normal; or three expressions of x, y, z: on the "
                  "side to which this vector points. Units: none.");
    add_parameter("Regions",
                  regions_text_,
                  "Other stacks in regions of the mesh, by the names of its "
                  "groups of cells (mesh files only): "
                  "'web: stack = [0/90]s, ply = 0.1; flange: h = 0.3'. Keys: "
                  "stack, ply, h (the whole thickness), offset, direction. "
                  "Units: as above.");
  }

  void
  LaminateSection::read_materials(const Constants &constants)
  {
    const std::string where = parameters + "Materials";
    materials_.clear();
    for (const auto &entry :
         Text::entries(materials_text_,
                       where,
                       "material",
                       "name: E1 = 25, E2 = 1, nu12 = 0.25, G12 = 0.5"))
      for (const auto &quoted : entry.names)
        {
          const std::string name = Text::unquoted(quoted);
          const std::string what = where + ", '" + name + "'";
          AssertThrow(materials_.count(name) == 0,
                      ExcMessage(what + " stands twice."));
          const auto values = read_values(entry.value, what, constants);
          Material   material{make_material(values, what), {}};
          if (values.count("ply") == 1)
            material.ply_thickness = values.at("ply");
          materials_[name] = material;
        }
    AssertThrow(!materials_.empty(),
                ExcMessage(where + " is empty; a laminate needs a material: "
                                   "'name: E1 = 25, E2 = 1, nu12 = 0.25, G12 "
                                   "= 0.5'."));
  }

  std::vector<Laminate::Layer>
  LaminateSection::make_layers(const LayupTexts  &texts,
                               const std::string &where) const
  {
    std::vector<std::string> names;
    for (const auto &material : materials_)
      names.push_back(material.first);
    std::vector<Laminate::Layer> layers;
    for (const Ply &ply : parse_ply_stack(texts.stack, where))
      {
        AssertThrow(!ply.material.empty() || materials_.size() == 1,
                    ExcMessage(where + ": '" + texts.stack +
                               "' has a ply without a material; with several "
                               "materials each ply names its own, as in "
                               "'[0_" +
                               names.front() + "/90_" + names.back() + "]'."));
        const std::string name =
          ply.material.empty() ? names.front() : ply.material;
        AssertThrow(materials_.count(name) == 1,
                    ExcMessage(
                      Text::unknown_name(where, "material", name, names)));
        const Material &material = materials_.at(name);
        layers.push_back(
          {material.material, ply.angle, material.ply_thickness.value_or(0.)});
      }
    return layers;
  }

  double
  LaminateSection::fill_thicknesses(std::vector<Laminate::Layer>     &layers,
                                    const LayupTexts                 &texts,
                                    const std::array<std::string, 2> &names,
                                    const Constants &constants) const
  {
    const auto &[ply, whole] = names;
    const bool   has_whole   = !texts.thickness.empty();
    unsigned int n_plain     = 0;
    for (const auto &layer : layers)
      n_plain += layer.thickness == 0. ? 1 : 0;
    double ply_thickness = 1.;
    if (!texts.ply_thickness.empty())
      ply_thickness =
        positive(evaluate_number(texts.ply_thickness, ply, constants),
                 ply,
                 Point<3>());
    else
      AssertThrow(n_plain == 0 || (has_whole && n_plain == layers.size()),
                  ExcMessage(
                    has_whole ?
                      whole +
                        ": some plies have a thickness by their "
                        "material, " +
                        std::to_string(n_plain) +
                        " don't; give 'ply' for all materials or for none." :
                      ply + " and " + whole +
                        " are empty; one of them, or 'ply' of the materials, "
                        "must say how thick the plies are."));
    double sum = 0.;
    for (auto &layer : layers)
      {
        if (layer.thickness == 0.)
          layer.thickness = ply_thickness;
        sum += layer.thickness;
      }
    return sum;
  }

  LaminateSection::Layup
  LaminateSection::make_layup(const LayupTexts  &texts,
                              const std::string &where,
                              const Constants   &constants) const
  {
    const bool is_region = where != parameters;
    const auto name = [&](const char *const parameter, const char *const key) {
      return where + (is_region ? key : parameter);
    };
    Layup             layup;
    const std::string stack = name("Stack", "stack");
    AssertThrow(!texts.stack.empty(),
                ExcMessage(stack + " is empty; write the plies' angles from "
                                   "bottom to top, as in '[0/45/-45/90]s'."));
    auto              layers = make_layers(texts, stack);
    const std::string ply    = name("Ply thickness", "ply");
    const std::string whole  = name("Thickness", "h");
    layup.where              = whole;
    const bool has_whole     = !texts.thickness.empty();
    AssertThrow(!has_whole || texts.ply_thickness.empty(),
                ExcMessage(ply + ": '" + texts.ply_thickness + "' and " +
                           whole + ": '" + texts.thickness +
                           "' are both given; leave one of them empty."));
    const double sum =
      fill_thicknesses(layers, texts, {{ply, whole}}, constants);
    layup.laminate = Laminate(layers);
    std::ostringstream total;
    total.precision(17);
    total << sum;
    layup.thickness =
      Expression(has_whole ? texts.thickness : total.str(), whole, constants);
    Constants known = constants;
    if (layup.thickness.is_constant())
      known["h"] = positive(thickness(layup, Point<3>()), whole, Point<3>());
    layup.offset =
      evaluate_number(texts.offset, name("Offset", "offset"), known);
    const std::string direction = Text::trim(texts.direction);
    if (direction == "u" || direction == "v")
      layup.line = direction == "u" ? 0 : 1;
    else
      layup.direction = read_direction(direction,
                                       name("Material direction", "direction"),
                                       constants);
    return layup;
  }

  void
  LaminateSection::prepare(const Constants &constants)
  {
    layup_of_id_.clear();
    read_materials(constants);
    layup_ = make_layup(texts_, parameters, constants);
    top_.reset();
    if (Text::trim(top_text_) != "normal")
      top_ = read_direction(top_text_, parameters + "Top", constants);
    read_regions(constants);
    const auto couples = [](const Layup &layup) {
      return !layup.laminate.is_symmetric() || layup.offset != 0.;
    };
    is_coupled_ = couples(layup_);
    for (const auto &region : regions_)
      is_coupled_ = is_coupled_ || couples(region.second);
  }

  void
  LaminateSection::read_regions(const Constants &constants)
  {
    const std::string parameter = parameters + "Regions";
    regions_.clear();
    Constants known = constants;
    for (const auto &[name, value] : named_constants())
      known[name] = value;
    for (const auto &entry : Text::entries(regions_text_,
                                           parameter,
                                           "region",
                                           "name: stack = [0/90]s"))
      for (const auto &quoted : entry.names)
        {
          const std::string name  = Text::unquoted(quoted);
          const std::string where = parameter + ", region '" + name + "'";
          AssertThrow(regions_.count(name) == 0,
                      ExcMessage(where + " stands twice."));
          LayupTexts                                 texts = texts_;
          const std::map<std::string, std::string *> keys  = {
             {"stack", &texts.stack},
             {"ply", &texts.ply_thickness},
             {"h", &texts.thickness},
             {"offset", &texts.offset},
             {"direction", &texts.direction}};
          bool has_thickness = false;
          for (const auto &item : Text::split(entry.value, ',', where))
            {
              const auto [key, value] = Text::key_and_value(item);
              const auto found        = keys.find(key);
              AssertThrow(found != keys.end(),
                          ExcMessage(Text::unknown_name(
                            where,
                            "value",
                            key,
                            {"stack", "ply", "h", "offset", "direction"})));
              if (!has_thickness && (key == "h" || key == "ply"))
                {
                  // It takes the place of the section's, whichever that is.
                  has_thickness = true;
                  texts.thickness.clear();
                  texts.ply_thickness.clear();
                }
              *found->second = value;
            }
          Layup layup             = make_layup(texts, where + ", ", known);
          layup.has_own_thickness = has_thickness;
          regions_[name]          = std::move(layup);
        }
  }

  void
  LaminateSection::set_regions(const MeshRegions &mesh)
  {
    std::vector<std::string>   names;
    std::vector<const Layup *> layups;
    for (const auto &[name, layup] : regions_)
      {
        names.push_back(name);
        layups.push_back(&layup);
      }
    lines_of_id_ = mesh.parameter_lines;
    layup_of_id_.clear();
    for (const unsigned int k :
         assign_regions(mesh, names, parameters + "Regions"))
      layup_of_id_.push_back(k == numbers::invalid_unsigned_int ? &layup_ :
                                                                  layups[k]);
    layups.push_back(&layup_);
    for (const Layup *const layup : layups)
      AssertThrow(!layup->line || !lines_of_id_.empty(),
                  ExcMessage(parameters +
                             "Material direction: this surface has no lines of "
                             "parameters u and v, as surfaces over a rectangle "
                             "of (u, v) have; give x, y, z or three "
                             "expressions of x, y, z."));
  }

  void
  LaminateSection::set_thickness(const double thickness)
  {
    thickness_of_study_ = thickness;
  }

  Constants
  LaminateSection::named_constants() const
  {
    if (!thickness_of_study_ && !layup_.thickness.is_constant())
      return {};
    return {{"h", thickness(layup_, Point<3>())}};
  }

  const LaminateSection::Layup &
  LaminateSection::layup(const SectionPoint &point) const
  {
    return point.region() < layup_of_id_.size() ?
             *layup_of_id_[point.region()] :
             layup_;
  }

  double
  LaminateSection::thickness(const Layup        &layup,
                             const SectionPoint &point) const
  {
    return thickness_of_study_ && !layup.has_own_thickness ?
             *thickness_of_study_ :
             positive(layup.thickness(point), layup.where, point);
  }

  double
  LaminateSection::thickness(const SectionPoint &point) const
  {
    return thickness(layup(point), point);
  }

  double
  LaminateSection::density(const SectionPoint &point) const
  {
    return layup(point).laminate.density();
  }

  Tensor<1, 3>
  LaminateSection::direction(const Layup          &layup,
                             const SurfaceFrame<> &frame,
                             const SectionPoint   &point) const
  {
    if (!layup.line)
      return layup.direction(point);
    AssertIndexRange(point.region(), lines_of_id_.size());
    const auto &line = lines_of_id_[point.region()][*layup.line];
    return line[0] * frame.a_cov[0] + line[1] * frame.a_cov[1];
  }

  LaminateSection::Axes
  LaminateSection::axes(const Layup          &layup,
                        const SurfaceFrame<> &frame,
                        const SectionPoint   &point) const
  {
    const auto  &t0 = frame.t0;
    const double side =
      top_ ? side_of((*top_)(point), t0, point, parameters + "Top") : 1.;
    const auto  e1 = projected_direction(direction(layup, frame, point),
                                        t0,
                                        point,
                                        parameters + "Material direction");
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
    const Layup &here    = layup(point);
    const auto [T, side] = axes(here, frame, point);
    const auto in_axes =
      here.laminate.stiffness(thickness(here, point), here.offset);
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
    const Layup &here        = layup(point);
    const auto [T, top_side] = axes(here, frame, point);
    return transpose(T) *
           here.laminate.stress(T * membrane_strain,
                                top_side * (T * bending_strain),
                                0.5 * top_side * side,
                                thickness(here, point),
                                here.offset,
                                {temperature.mean,
                                 top_side * temperature.gradient});
  }

  InitialForces
  LaminateSection::thermal_forces(const Temperature    &temperature,
                                  const SurfaceFrame<> &frame,
                                  const SectionPoint   &point) const
  {
    const Layup &here    = layup(point);
    const auto [T, side] = axes(here, frame, point);
    InitialForces result =
      here.laminate.thermal_forces({temperature.mean,
                                    side * temperature.gradient},
                                   thickness(here, point),
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
    const Layup &here    = layup(point);
    const auto [T, side] = axes(here, frame, point);
    auto states =
      here.laminate.states(T * membrane_strain,
                           side * (T * bending_strain),
                           thickness(here, point),
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
    unsigned int n = layup_.laminate.n_layers();
    for (const auto &region : regions_)
      n = std::max(n, region.second.laminate.n_layers());
    return n;
  }
} // namespace Nacre
