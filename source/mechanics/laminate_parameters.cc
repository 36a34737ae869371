// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/mechanics/checked_value.h>
#include <nacre/mechanics/laminate_parameters.h>
#include <nacre/mechanics/ply_stack.h>
#include <nacre/mechanics/surface_axes.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace Nacre
{
  namespace
  {
    const std::string parameters   = "Section/Laminate/";
    const std::string regions_name = parameters + "Regions";

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

    using LayupTexts = LaminateSectionParameters::LayupTexts;

    struct PlyMaterial
    {
      OrthotropicMaterial material;
      /** Of a ply of it (length). */
      std::optional<double> ply_thickness;
    };

    /** The materials by their names. */
    std::map<std::string, PlyMaterial>
    read_materials(const std::string &text, const Constants &constants)
    {
      const std::string                  where = parameters + "Materials";
      std::map<std::string, PlyMaterial> materials;
      for (const auto &entry :
           Text::entries(text,
                         where,
                         "material",
                         "name: E1 = 25, E2 = 1, nu12 = 0.25, G12 = 0.5"))
        for (const auto &quoted : entry.names)
          {
            const std::string name = Text::unquoted(quoted);
            const std::string what = where + ", '" + name + "'";
            AssertThrow(materials.count(name) == 0,
                        ExcMessage(what + " stands twice."));
            const auto  values = read_values(entry.value, what, constants);
            PlyMaterial material{make_material(values, what), {}};
            if (values.count("ply") == 1)
              material.ply_thickness = values.at("ply");
            materials[name] = material;
          }
      AssertThrow(!materials.empty(),
                  ExcMessage(where + " is empty; a laminate needs a material: "
                                     "'name: E1 = 25, E2 = 1, nu12 = 0.25, G12 "
                                     "= 0.5'."));
      return materials;
    }

    std::vector<Laminate::Layer>
    make_layers(const LayupTexts                         &texts,
                const std::map<std::string, PlyMaterial> &materials,
                const std::string                        &where)
    {
      std::vector<std::string> names;
      for (const auto &material : materials)
        names.push_back(material.first);
      std::vector<Laminate::Layer> layers;
      for (const Ply &ply : parse_ply_stack(texts.stack, where))
        {
          AssertThrow(!ply.material.empty() || materials.size() == 1,
                      ExcMessage(where + ": '" + texts.stack +
                                 "' has a ply without a material; with several "
                                 "materials each ply names its own, as in "
                                 "'[0_" +
                                 names.front() + "/90_" + names.back() +
                                 "]'."));
          const std::string name =
            ply.material.empty() ? names.front() : ply.material;
          AssertThrow(materials.count(name) == 1,
                      ExcMessage(
                        Text::unknown_name(where, "material", name, names)));
          const PlyMaterial &material = materials.at(name);
          layers.push_back({material.material,
                            ply.angle,
                            material.ply_thickness.value_or(0.)});
        }
      return layers;
    }

    /**
     * Give all layers a thickness and return the sum (length, or the number of
     * plies if only the whole is known). @p names are those of the parameters
     * of a ply's and of the whole thickness, for messages.
     */
    double
    fill_thicknesses(std::vector<Laminate::Layer>     &layers,
                     const LayupTexts                 &texts,
                     const std::array<std::string, 2> &names,
                     const Constants                  &constants)
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

    /**
     * The layup of the @p texts. @p where is the beginning of the parameters'
     * names in messages. The @p thickness of a study takes the place of that of
     * the texts, which are checked all the same.
     */
    Layup
    make_layup(const LayupTexts                         &texts,
               const std::map<std::string, PlyMaterial> &materials,
               const std::optional<double>              &thickness,
               const std::string                        &where,
               const Constants                          &constants)
    {
      const bool is_region = where != parameters;
      const auto name      = [&](const char *const parameter,
                            const char *const key) {
        return where + (is_region ? key : parameter);
      };
      Layup             layup;
      const std::string stack = name("Stack", "stack");
      AssertThrow(!texts.stack.empty(),
                  ExcMessage(stack + " is empty; write the plies' angles from "
                                     "bottom to top, as in '[0/45/-45/90]s'."));
      auto              layers    = make_layers(texts, materials, stack);
      const std::string ply       = name("Ply thickness", "ply");
      const std::string whole     = name("Thickness", "h");
      const bool        has_whole = !texts.thickness.empty();
      AssertThrow(!has_whole || texts.ply_thickness.empty(),
                  ExcMessage(ply + ": '" + texts.ply_thickness + "' and " +
                             whole + ": '" + texts.thickness +
                             "' are both given; leave one of them empty."));
      const double sum =
        fill_thicknesses(layers, texts, {{ply, whole}}, constants);
      layup.laminate  = Laminate(layers);
      layup.thickness = has_whole ?
                          Expression(texts.thickness, whole, constants) :
                          Expression(sum, whole);
      check_positive(layup.thickness);
      if (thickness)
        layup.thickness = {*thickness, "Study/Thicknesses"};
      Constants known = constants;
      if (layup.thickness.is_constant())
        known["h"] = layup.thickness(Point<3>());
      layup.offset =
        evaluate_number(texts.offset, name("Offset", "offset"), known);
      const std::string direction = Text::trim(texts.direction);
      if (direction == "u" || direction == "v")
        layup.line = direction == "u" ? 0 : 1;
      else
        layup.direction =
          read_direction(direction,
                         name("Material direction", "direction"),
                         constants);
      return layup;
    }

    /** "name: stack = [0/90]s, ply = 0.1; ...", by the names. */
    std::map<std::string, Layup>
    read_layups(const std::string                        &text,
                const LayupTexts                         &section,
                const std::map<std::string, PlyMaterial> &materials,
                const std::optional<double>              &thickness,
                const Constants                          &known)
    {
      std::map<std::string, Layup> layups;
      for (const auto &entry :
           Text::entries(text, regions_name, "region", "name: stack = [0/90]s"))
        for (const auto &quoted : entry.names)
          {
            const std::string name  = Text::unquoted(quoted);
            const std::string where = regions_name + ", region '" + name + "'";
            AssertThrow(layups.count(name) == 0,
                        ExcMessage(where + " stands twice."));
            LayupTexts                                 texts = section;
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
            layups.emplace(name,
                           make_layup(texts,
                                      materials,
                                      has_thickness ? std::nullopt : thickness,
                                      where + ", ",
                                      known));
          }
      return layups;
    }
  } // namespace

  LaminateSectionParameters::LaminateSectionParameters()
    : SectionParameters("/Section/Laminate")
  {
    add_parameter(
      "Materials",
      materials_,
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
                  top_,
                  "Where the top of the stack is. normal: on the side of the "
                  "surface's normal; or three expressions of x, y, z: on the "
                  "side to which this vector points. Units: none.");
    add_parameter("Regions",
                  regions_,
                  "Other stacks in regions of the mesh, by the names of its "
                  "groups of cells (mesh files only): "
                  "'web: stack = [0/90]s, ply = 0.1; flange: h = 0.3'. Keys: "
                  "stack, ply, h (the whole thickness), offset, direction. "
                  "Units: as above.");
  }

  Constants
  LaminateSectionParameters::named_constants(
    const Constants             &constants,
    const std::optional<double> &thickness) const
  {
    const Layup layup = make_layup(texts_,
                                   read_materials(materials_, constants),
                                   thickness,
                                   parameters,
                                   constants);
    if (!layup.thickness.is_constant())
      return {};
    return {{"h", layup.thickness(Point<3>())}};
  }

  LaminateSection
  LaminateSectionParameters::section(const Constants             &constants,
                                     const std::optional<double> &thickness,
                                     const MeshRegions           &regions) const
  {
    const auto  materials = read_materials(materials_, constants);
    const Layup everywhere =
      make_layup(texts_, materials, thickness, parameters, constants);
    std::optional<VectorExpression> top;
    if (Text::trim(top_) != "normal")
      top = read_direction(top_, parameters + "Top", constants);
    Constants known = constants;
    if (everywhere.thickness.is_constant())
      known["h"] = everywhere.thickness(Point<3>());
    const auto layups =
      read_layups(regions_, texts_, materials, thickness, known);
    return LaminateSection(
      ByRegion<Layup>(everywhere, layups, regions, regions_name),
      std::move(top),
      regions.parameter_lines);
  }
} // namespace Nacre
