// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/mechanics/initial_strain.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

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

    bool
    has_heat(const InitialStrains::Values &values)
    {
      return !values.at("temperature").is_zero() ||
             !values.at("gradient").is_zero();
    }
  } // namespace

  InitialStrains::InitialStrains(ByRegion<Values>        values,
                                 const VectorExpression &direction,
                                 const bool              keeps_angles,
                                 const bool              has_plies)
    : values_(std::move(values))
    , direction_(direction)
    , keeps_angles_(keeps_angles)
    , has_plies_(has_plies)
  {
    const auto &all  = values_.all();
    has_temperature_ = std::any_of(all.begin(), all.end(), has_heat);
    is_zero_ = std::all_of(all.begin(), all.end(), [](const Values &values) {
      return std::all_of(values.begin(), values.end(), [](const auto &entry) {
        return entry.first == "expansion" || entry.second.is_zero();
      });
    });
  }

  InitialStrain
  InitialStrains::at(const SurfaceFrame<> &frame,
                     const SectionPoint   &point,
                     const Instant        &instant) const
  {
    const Values &values = values_.at(point);
    const auto    get    = [&](const char *const key) {
      return values.at(key)(point, instant);
    };
    InitialStrain result;
    result.temperature = {get("temperature"), get("gradient")};
    double mean = 0., gradient = 0.;
    if (!has_plies_)
      {
        // A property: the factor of the instant is in the temperature.
        const double alpha = values.at("expansion")(point, instant.time);
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

  InitialStrainParameters::InitialStrainParameters()
    : ParameterAcceptor("/Section/Initial strain")
  {
    add_parameter("Strain",
                  strain_,
                  "Tensor components e11, e22, e12 of the mid-surface's strain "
                  "without stress; as all values here, expressions of x, y, z "
                  "and the time t, which 'Analysis/Load factor' multiplies. "
                  "Units: none.");
    add_parameter("Curvature",
                  curvature_,
                  "Components k11, k22, k12 of the change of curvature without "
                  "stress: a fibre at the height z along the normal has the "
                  "strain e + z k. Units: 1/length.");
    add_parameter("Direction",
                  direction_,
                  "The axis 1 of both is its projection onto the surface: x, "
                  "y, z or three expressions of x, y, z; the axis 2 is the "
                  "normal times the axis 1. Units: none.");
    add_parameter("Thermal expansion",
                  expansion_,
                  "Of an isotropic section; in laminates the materials have "
                  "alpha1 and alpha2. Units: 1/temperature.");
    add_parameter("Temperature",
                  temperature_,
                  "How much warmer the mid-surface is than without stress. "
                  "Units: temperature.");
    add_parameter("Temperature gradient",
                  gradient_,
                  "How the temperature grows along the normal. "
                  "Units: temperature/length.");
    add_parameter("Keeps angles",
                  keeps_angles_,
                  "Whether strains of the mid-surface bring the change of "
                  "curvature along with which a curved shell grows uniformly "
                  "and keeps its angles, so that it stays free of stress if it "
                  "may move.");
    add_parameter("Regions",
                  regions_,
                  "Other values in regions of the mesh, by the names of its "
                  "groups of cells (mesh files only): 'web: temperature = 50; "
                  "flange: e11 = 1e-3, k22 = x'. Keys: e11, e22, e12, k11, "
                  "k22, k12, expansion, temperature, gradient. Units: as "
                  "above.");
  }

  InitialStrainParameters::Values
  InitialStrainParameters::values(const Constants &constants) const
  {
    const auto &keys = strain_keys();
    Values      result;
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
        result.emplace(keys[first + k],
                       Expression(items[k], where, constants, "x,y,z,t"));
    };
    read(strain_, "Strain", 0, 3);
    read(curvature_, "Curvature", 3, 3);
    result.emplace("expansion",
                   Expression(expansion_,
                              initial_strain + "Thermal expansion",
                              constants));
    read(temperature_, "Temperature", 7, 1);
    read(gradient_, "Temperature gradient", 8, 1);
    return result;
  }

  std::map<std::string, InitialStrainParameters::Values>
  InitialStrainParameters::values_of_regions(const Values    &everywhere,
                                             const Constants &constants,
                                             const bool       has_plies) const
  {
    const std::string             where = initial_strain + "Regions";
    const auto                   &keys  = strain_keys();
    std::map<std::string, Values> result;
    for (const auto &entry :
         Text::entries(regions_, where, "region", "web: temperature = 50"))
      for (const auto &quoted : entry.names)
        {
          const std::string name     = Text::unquoted(quoted);
          const auto [place, is_new] = result.try_emplace(name, everywhere);
          std::set<std::string> own_keys;
          AssertThrow(is_new,
                      ExcMessage(where + ", '" + name + "' stands twice."));
          for (const auto &item : Text::split(entry.value, ',', where))
            {
              const auto [key, text] = Text::key_and_value(item);
              const std::string what = where + ", '" + name + "', " + key;
              AssertThrow(
                std::find(keys.begin(), keys.end(), key) != keys.end(),
                ExcMessage(Text::unknown_name(where, "value", key, keys)));
              AssertThrow(!has_plies || key != "expansion",
                          ExcMessage(
                            where + ", expansion: a laminate takes alpha1 and "
                                    "alpha2 of 'Section/Laminate/Materials'."));
              AssertThrow(own_keys.insert(key).second && !text.empty(),
                          ExcMessage(what + ": it needs one value."));
              place->second[key] = Expression(text, what, constants, "x,y,z,t");
            }
        }
    return result;
  }

  InitialStrains
  InitialStrainParameters::make(const Constants   &constants,
                                const bool         has_plies,
                                const MeshRegions &regions) const
  {
    const Values everywhere = values(constants);
    const auto   direction =
      read_direction(direction_, initial_strain + "Direction", constants);
    const auto of_regions = values_of_regions(everywhere, constants, has_plies);
    InitialStrains result(ByRegion<Values>(everywhere,
                                           of_regions,
                                           regions,
                                           initial_strain + "Regions"),
                          direction,
                          keeps_angles_,
                          has_plies);
    AssertThrow(!has_plies || everywhere.at("expansion").is_zero(),
                ExcMessage(initial_strain +
                           "Thermal expansion: a laminate takes alpha1 and "
                           "alpha2 of 'Section/Laminate/Materials'."));
    const bool expands =
      has_plies || !everywhere.at("expansion").is_zero() ||
      std::any_of(of_regions.begin(), of_regions.end(), [](const auto &region) {
        return !region.second.at("expansion").is_zero();
      });
    AssertThrow(expands || !result.has_temperature(),
                ExcMessage(initial_strain +
                           "Temperature: without a 'Thermal expansion' it "
                           "strains nothing; give that, too."));
    AssertThrow(!has_plies || !result.has_temperature() || !keeps_angles_,
                ExcMessage(initial_strain +
                           "Keeps angles: the plies of a laminate expand "
                           "differently, and it is for other strains than "
                           "those of a temperature."));
    return result;
  }
} // namespace Nacre
