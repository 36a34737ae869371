// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/mechanics/initial_strain.h>
#include <nacre/mechanics/section_regions.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    const std::string initial_strain = "Section/Initial strain/";

    const std::vector<std::string> &
    strain_keys()
    {
      static const std::vector<std::string> keys = {"e11",
                                                    "e22",
                                                    "e12",
                                                    "k11",
                                                    "k22",
                                                    "k12",
                                                    "expansion",
                                                    "temperature",
                                                    "gradient"};
      return keys;
    }
  } // namespace

  InitialStrainParameters::InitialStrainParameters()
    : ParameterAcceptor("/Section/Initial strain")
  {
    add_parameter("Strain",
                  strain_text_,
                  "Tensor components e11, e22, e12 of the mid-surface's strain "
                  "without stress; as all values here, expressions of x, y, z "
                  "and the time t, which 'Analysis/Load factor' multiplies. "
                  "Units: none.");
    add_parameter("Curvature",
                  curvature_text_,
                  "Components k11, k22, k12 of the change of curvature without "
                  "stress: a fibre at the height z along the normal has the "
                  "strain e + z k. Units: 1/length.");
    add_parameter("Direction",
                  direction_text_,
                  "The axis 1 of both is its projection onto the surface: x, "
                  "y, z or three expressions of x, y, z; the axis 2 is the "
                  "normal times the axis 1. Units: none.");
    add_parameter("Thermal expansion",
                  expansion_text_,
                  "Of an isotropic section; in laminates the materials have "
                  "alpha1 and alpha2. Units: 1/temperature.");
    add_parameter("Temperature",
                  temperature_text_,
                  "How much warmer the mid-surface is than without stress. "
                  "Units: temperature.");
    add_parameter("Temperature gradient",
                  gradient_text_,
                  "How the temperature grows along the normal. "
                  "Units: temperature/length.");
    add_parameter("Keeps angles",
                  keeps_angles_,
                  "Whether strains of the mid-surface bring the change of "
                  "curvature along with which a curved shell grows uniformly "
                  "and keeps its angles, so that it stays free of stress if it "
                  "may move.");
    add_parameter("Regions",
                  regions_text_,
                  "Other values in regions of the mesh, by the names of its "
                  "groups of cells (mesh files only): 'web: temperature = 50; "
                  "flange: e11 = 1e-3, k22 = x'. Keys: e11, e22, e12, k11, "
                  "k22, k12, expansion, temperature, gradient. Units: as "
                  "above.");
  }

  void
  InitialStrainParameters::prepare(const Constants &constants,
                                   const bool       has_plies)
  {
    has_plies_ = has_plies;
    values_.clear();
    const auto &keys = strain_keys();
    const auto  read = [&](const std::string &text,
                          const std::string &name,
                          const unsigned int first,
                          const unsigned int n) {
      const std::string where = initial_strain + name;
      const auto        items = Text::split(text, ',', where);
      AssertThrow(items.size() == n,
                  ExcMessage(where + ": '" + text + "' has " +
                             std::to_string(items.size()) +
                             " components; it needs " + std::to_string(n) +
                             "."));
      for (unsigned int k = 0; k < n; ++k)
        values_.emplace(keys[first + k],
                        Expression(items[k], where, constants, "x,y,z,t"));
    };
    read(strain_text_, "Strain", 0, 3);
    read(curvature_text_, "Curvature", 3, 3);
    values_.emplace("expansion",
                    Expression(expansion_text_,
                               initial_strain + "Thermal expansion",
                               constants));
    read(temperature_text_, "Temperature", 7, 1);
    read(gradient_text_, "Temperature gradient", 8, 1);
    direction_ =
      read_direction(direction_text_, initial_strain + "Direction", constants);
    prepare_regions(constants);
    AssertThrow(!has_plies || values_.at("expansion").is_zero(),
                ExcMessage(initial_strain +
                           "Thermal expansion: a laminate takes alpha1 and "
                           "alpha2 of 'Section/Laminate/Materials'."));
    AssertThrow(!has_plies || !has_temperature() || !keeps_angles_,
                ExcMessage(initial_strain +
                           "Keeps angles: the plies of a laminate expand "
                           "differently, and it is for other strains than "
                           "those of a temperature."));
    const auto is_null = [](const Values &values) {
      return std::all_of(values.begin(), values.end(), [](const auto &entry) {
        return entry.first == "expansion" || entry.second.is_zero();
      });
    };
    is_zero_ =
      is_null(values_) &&
      std::all_of(regions_.begin(), regions_.end(), [&](const auto &region) {
        return is_null(region.second);
      });
  }

  void
  InitialStrainParameters::prepare_regions(const Constants &constants)
  {
    const std::string where = initial_strain + "Regions";
    const auto       &keys  = strain_keys();
    regions_.clear();
    region_of_id_.clear();
    for (const auto &entry :
         Text::entries(regions_text_, where, "region", "web: temperature = 50"))
      for (const auto &quoted : entry.names)
        {
          const std::string name = Text::unquoted(quoted);
          AssertThrow(regions_.count(name) == 0,
                      ExcMessage(where + ", '" + name + "' stands twice."));
          Values &values = regions_[name];
          for (const auto &item : Text::split(entry.value, ',', where))
            {
              const auto [key, text] = Text::key_and_value(item);
              AssertThrow(
                std::find(keys.begin(), keys.end(), key) != keys.end(),
                ExcMessage(Text::unknown_name(where, "value", key, keys)));
              AssertThrow(!has_plies_ || key != "expansion",
                          ExcMessage(
                            where + ", expansion: a laminate takes alpha1 and "
                                    "alpha2 of 'Section/Laminate/Materials'."));
              AssertThrow(values.count(key) == 0 && !text.empty(),
                          ExcMessage(where + ", '" + name + "', " + key +
                                     ": it needs one value."));
              values.emplace(key,
                             Expression(text,
                                        where + ", '" + name + "', " + key,
                                        constants,
                                        "x,y,z,t"));
            }
        }
  }

  void
  InitialStrainParameters::set_regions(const MeshRegions &mesh)
  {
    std::vector<std::string>    names;
    std::vector<const Values *> values;
    for (const auto &[name, region] : regions_)
      {
        names.push_back(name);
        values.push_back(&region);
      }
    region_of_id_.clear();
    for (const unsigned int k :
         assign_regions(mesh, names, initial_strain + "Regions"))
      region_of_id_.push_back(k == numbers::invalid_unsigned_int ? nullptr :
                                                                   values[k]);
  }

  bool
  InitialStrainParameters::has_temperature() const
  {
    return !values_.at("temperature").is_zero() ||
           !values_.at("gradient").is_zero() ||
           std::any_of(regions_.begin(),
                       regions_.end(),
                       [](const auto &region) {
                         return region.second.count("temperature") +
                                  region.second.count("gradient") >
                                0;
                       });
  }

  double
  InitialStrainParameters::value(const std::string  &key,
                                 const SectionPoint &point,
                                 const Instant      &instant) const
  {
    if (point.region() < region_of_id_.size())
      if (const Values *const own = region_of_id_[point.region()])
        {
          const auto found = own->find(key);
          if (found != own->end())
            return found->second(point, instant);
        }
    return values_.at(key)(point, instant);
  }

  InitialStrain
  InitialStrainParameters::at(const SurfaceFrame<> &frame,
                              const SectionPoint   &point,
                              const Instant        &instant) const
  {
    const auto get = [&](const char *const key) {
      return value(key, point, instant);
    };
    InitialStrain result;
    result.temperature = {get("temperature"), get("gradient")};
    double mean = 0., gradient = 0.;
    if (!has_plies_)
      {
        // A property: the factor of the instant is in the temperature.
        const double alpha = value("expansion", point, {instant.time, 1.});
        mean               = alpha * result.temperature.mean;
        gradient           = alpha * result.temperature.gradient;
      }
    const double e[3] = {get("e11") + mean, get("e22") + mean, get("e12")};
    const double k[3] = {get("k11") + gradient,
                         get("k22") + gradient,
                         get("k12")};
    // Where both are isotropic, no axis is needed.
    const bool is_isotropic =
      e[0] == e[1] && e[2] == 0. && k[0] == k[1] && k[2] == 0.;
    const auto e_1 = is_isotropic ?
                       frame.a_cov[0] / frame.a_cov[0].norm() :
                       projected_direction(direction_(point),
                                           frame.t0,
                                           point,
                                           initial_strain + "Direction");
    const auto e_2 = cross_product_3d(frame.t0, e_1);
    for (unsigned int v = 0; v < 3; ++v)
      {
        const auto  &a     = frame.a_cov[v == 1 ? 1 : 0];
        const auto  &b     = frame.a_cov[v == 0 ? 0 : 1];
        const double twice = (v < 2 ? 1. : 2.);
        const double a_1 = a * e_1, a_2 = a * e_2;
        const double b_1 = b * e_1, b_2 = b * e_2;
        const double dyad[] = {a_1 * b_1, a_2 * b_2, a_1 * b_2 + a_2 * b_1};
        for (unsigned int w = 0; w < 3; ++w)
          {
            result.membrane[v] += twice * dyad[w] * e[w];
            result.bending[v] += twice * dyad[w] * k[w];
          }
      }
    if (keeps_angles_)
      result.bending -= curvature_of_growth(result.membrane, frame);
    return result;
  }

  Voigt<>
  curvature_of_growth(const Voigt<> &E, const SurfaceFrame<> &frame)
  {
    const double g[2][2] = {{frame.metric_con[0], frame.metric_con[2]},
                            {frame.metric_con[2], frame.metric_con[1]}};
    const double e[2][2] = {{E[0], 0.5 * E[2]}, {0.5 * E[2], E[1]}};
    const double b[2][2] = {{frame.b(0), frame.b(2)}, {frame.b(2), frame.b(1)}};
    double       mixed[2][2] = {};
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int d = 0; d < 2; ++d)
            mixed[i][j] += e[i][c] * g[c][d] * b[d][j];
    return Voigt<>({mixed[0][0], mixed[1][1], mixed[0][1] + mixed[1][0]});
  }
} // namespace Nacre
