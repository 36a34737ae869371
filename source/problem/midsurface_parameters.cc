// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The mid-surface of a parameter file.

#include <nacre/base/text.h>
#include <nacre/problem/midsurface.h>
#include <nacre/problem/parametric_surface.h>
#include <nacre/problem/surfaces.h>

#include <algorithm>
#include <filesystem>

namespace Nacre
{
  namespace
  {
    std::string
    list_of_surfaces()
    {
      std::string text;
      for (const SurfaceKind &kind : surface_kinds())
        text += (text.empty() ? "" : " | ") + kind.name;
      return text;
    }
  } // namespace

  MidsurfaceParameters::MidsurfaceParameters()
    : ParameterAcceptor("/Mid-surface")
  {
    add_parameter("Surface",
                  surface_name_,
                  "The surface: " + list_of_surfaces() +
                    "; its parameters are in the subsection of its name, "
                    "lengths and angles may be expressions of the constants. "
                    "Units: none");
    add_parameter("Subdivisions",
                  subdivisions_,
                  "Coarse cells along u and v, before any refinement; one "
                  "number for both. Closed directions need at least 3. Units: "
                  "none");
    add_parameter("Grading u",
                  grading_[0],
                  "Expression g(s) that grows from 0 at s = 0 to 1 at s = 1, "
                  "e.g. s^2: coarse mesh line i of n lies at g(i/n) of the "
                  "range of u (of each leg of a folded strip). Refinement "
                  "halves the coarse cells. Units: none");
    add_parameter("Grading v",
                  grading_[1],
                  "The same for the lines across v. Units: none");

    for (const SurfaceKind &kind : surface_kinds())
      {
        enter_subsection(kind.name);
        for (const SurfaceParameter &parameter : kind.parameters)
          {
            std::string &value = values_[kind.name][parameter.name];
            value              = parameter.default_value;
            add_parameter(parameter.name, value, parameter.documentation);
          }
        leave_subsection();
      }
  }


  void
  MidsurfaceParameters::set_files(const MPI_Comm     communicator,
                                  const std::string &folder)
  {
    communicator_ = communicator;
    folder_       = folder;
    constants_of_file_.reset();
  }


  void
  MidsurfaceParameters::fix_file_name() const
  {
    namespace fs  = std::filesystem;
    fs::path path = Text::trim(values_.at("file").at("File name"));
    if (path.is_relative() && fs::exists(fs::path(folder_) / path))
      path = fs::path(folder_) / path;
    prm.enter_subsection("Mid-surface");
    prm.enter_subsection("file");
    prm.set("File name", fs::absolute(path).lexically_normal().string());
    prm.leave_subsection();
    prm.leave_subsection();
  }


  Midsurface
  MidsurfaceParameters::make(const Constants          &constants,
                             std::optional<Midsurface> previous)
  {
    const std::string        path  = "Mid-surface";
    const std::string        name  = Text::trim(surface_name_);
    const auto              &kinds = surface_kinds();
    std::vector<std::string> names;
    for (const SurfaceKind &kind : kinds)
      names.push_back(kind.name);
    const auto found = std::find(names.begin(), names.end(), name);
    AssertThrow(
      found != names.end(),
      ExcMessage(
        Text::unknown_name(path + "/Surface", "surface", name, names)));

    // A study makes one for each of its cases.
    const bool is_file =
      (kinds[found - names.begin()].make == make_file_surface);
    if (is_file && previous && constants_of_file_ == constants)
      return *std::move(previous);
    constants_of_file_.reset();
    const SurfaceInput input(path,
                             name,
                             values_,
                             {subdivisions_, grading_},
                             constants,
                             {communicator_, folder_});
    Midsurface         midsurface(std::make_unique<const ParametricSurface>(
                            kinds[found - names.begin()].make(input),
                            input.where()),
                          name);
    midsurface.set_imperfection(
      imperfection_.make(constants, communicator_, folder_));
    if (is_file)
      {
        fix_file_name();
        constants_of_file_ = constants;
      }
    return midsurface;
  }
} // namespace Nacre
