// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/expression.h>
#include <nacre/base/text.h>
#include <nacre/problem/surfaces.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Nacre
{
  namespace
  {
    /** The two numbers of "a, b". */
    std::array<double, 2>
    number_pair(const std::string &text,
                const std::string &where,
                const Constants   &constants)
    {
      const std::vector<std::string> parts = Text::split(text, ',', where);
      AssertThrow(parts.size() == 2,
                  ExcMessage(where +
                             ": two numbers, separated by a comma, are "
                             "needed; found '" +
                             text + "'."));
      return {{evaluate_number(parts[0], where, constants),
               evaluate_number(parts[1], where, constants)}};
    }

    /** g(i/n) for i = 0..n: a grading must run from 0 to 1 and grow. */
    std::vector<double>
    graded_fractions(const std::string &text,
                     const std::string &where,
                     const Constants   &constants,
                     const unsigned int n)
    {
      const Expression grading(text, where, constants, "s");
      const auto       value = [&](const double s) {
        return grading(Point<3>(s, 0., 0.));
      };
      AssertThrow(std::abs(value(0.)) < 1e-12 &&
                    std::abs(value(1.) - 1.) < 1e-12,
                  ExcMessage(where + ": '" + text + "' runs from " +
                             Text::number(value(0.)) + " at s = 0 to " +
                             Text::number(value(1.)) +
                             " at s = 1; a grading g(s) must run from 0 to "
                             "1."));
      const unsigned int n_samples = 100;
      for (unsigned int i = 0; i < n_samples; ++i)
        AssertThrow(value((i + 1.) / n_samples) > value(double(i) / n_samples),
                    ExcMessage(
                      where + ": '" + text + "' doesn't grow between s = " +
                      Text::number(double(i) / n_samples) +
                      " and s = " + Text::number((i + 1.) / n_samples) +
                      "; a grading must grow everywhere, e.g. s^2."));

      std::vector<double> result(n + 1, 0.);
      for (unsigned int i = 1; i < n; ++i)
        result[i] = value(double(i) / n);
      result[n] = 1.;
      return result;
    }
  } // namespace


  SurfaceInput::SurfaceInput(const std::string &path,
                             const std::string &surface,
                             const Values      &values,
                             const Mesh        &mesh,
                             const Constants   &constants,
                             const Files       &files)
    : path_(path)
    , surface_(surface)
    , values_(values)
    , mesh_(mesh)
    , constants_(constants)
    , files_(files)
  {}


  SurfaceInput
  SurfaceInput::of_map(const std::string &surface) const
  {
    return {path_, surface, values_, {"4", {{"s", "s"}}}, constants_, files_};
  }


  InputFile
  SurfaceInput::file(const std::string &parameter) const
  {
    return read_input_file(files_.communicator,
                           text(parameter),
                           files_.folder,
                           where(parameter));
  }


  InputFile
  SurfaceInput::file_beside(const std::string &name,
                            const std::string &folder,
                            const std::string &where) const
  {
    return read_input_file(files_.communicator, name, folder, where);
  }


  std::string
  SurfaceInput::where(const std::string &parameter) const
  {
    return path_ + "/" + surface_ + (parameter.empty() ? "" : "/" + parameter);
  }


  const std::string &
  SurfaceInput::text(const std::string &parameter) const
  {
    const auto &values = values_.at(surface_);
    const auto  found  = values.find(parameter);
    Assert(found != values.end(),
           ExcMessage(where(parameter) + " isn't declared."));
    return found->second;
  }


  const Constants &
  SurfaceInput::constants() const
  {
    return constants_;
  }


  double
  SurfaceInput::number(const std::string &parameter) const
  {
    return evaluate_number(text(parameter), where(parameter), constants_);
  }


  double
  SurfaceInput::positive(const std::string &parameter) const
  {
    const double result = number(parameter);
    AssertThrow(result > 0.,
                ExcMessage(where(parameter) + ": found " +
                           Text::number(result) +
                           "; it must be greater than zero."));
    return result;
  }


  std::array<double, 2>
  SurfaceInput::positive_pair(const std::string &parameter) const
  {
    const std::array<double, 2> result =
      number_pair(text(parameter), where(parameter), constants_);
    for (const double value : result)
      AssertThrow(value > 0.,
                  ExcMessage(where(parameter) + ": found " +
                             Text::number(value) +
                             "; both numbers must be greater than zero."));
    return result;
  }


  SurfaceInput::Range
  SurfaceInput::range(const std::string &parameter) const
  {
    const Range result =
      number_pair(text(parameter), where(parameter), constants_);
    AssertThrow(result[0] < result[1],
                ExcMessage(where(parameter) + ": the range from " +
                           Text::number(result[0]) + " to " +
                           Text::number(result[1]) +
                           " is empty or reversed; its begin must be less "
                           "than its end."));
    return result;
  }


  SurfaceInput::Range
  SurfaceInput::angle_range(const std::string &parameter) const
  {
    const Range result = range(parameter);
    AssertThrow(result[1] - result[0] <= 360. + 1e-9,
                ExcMessage(where(parameter) + ": the range from " +
                           Text::number(result[0]) + " to " +
                           Text::number(result[1]) +
                           " degrees overlaps itself; it may be at most 360 "
                           "degrees long."));
    return result;
  }


  std::string
  SurfaceInput::choice(const std::string              &parameter,
                       const std::vector<std::string> &allowed) const
  {
    const std::string word = Text::trim(text(parameter));
    AssertThrow(
      std::find(allowed.begin(), allowed.end(), word) != allowed.end(),
      ExcMessage(
        Text::unknown_name(where(parameter), "choice", word, allowed)));
    return word;
  }


  unsigned int
  SurfaceInput::n_cells(const unsigned int direction, const bool closed) const
  {
    const std::string              where = path_ + "/Subdivisions";
    const std::vector<std::string> parts =
      Text::split(mesh_.subdivisions, ',', where);
    AssertThrow(parts.size() == 1 || parts.size() == 2,
                ExcMessage(where + ": one or two numbers are needed; found '" +
                           mesh_.subdivisions + "'."));
    const double number =
      evaluate_number(parts[std::min<std::size_t>(direction, parts.size() - 1)],
                      where,
                      constants_);
    AssertThrow(number == std::round(number) && number >= 1. && number <= 1000.,
                ExcMessage(where + ": found " + Text::number(number) +
                           "; numbers of cells are whole and between 1 and "
                           "1000 (refine for more)."));
    AssertThrow(!closed || number >= 3.,
                ExcMessage(where + ": found " + Text::number(number) +
                           " cells along " + (direction == 0 ? 'u' : 'v') +
                           "; the surface '" + surface_ +
                           "' is closed in that direction and needs at least "
                           "3."));
    return static_cast<unsigned int>(number);
  }


  std::vector<double>
  SurfaceInput::mesh_lines(const unsigned int direction,
                           const Range       &range,
                           const bool         closed) const
  {
    std::vector<double> lines =
      graded_fractions(mesh_.grading[direction],
                       path_ + (direction == 0 ? "/Grading u" : "/Grading v"),
                       constants_,
                       n_cells(direction, closed));
    for (double &line : lines)
      line = (1. - line) * range[0] + line * range[1];
    return lines;
  }


  unsigned int
  SurfaceInput::n_patch_cells() const
  {
    for (unsigned int direction = 0; direction < 2; ++direction)
      AssertThrow(Text::trim(mesh_.grading[direction]) == "s",
                  ExcMessage(path_ +
                             (direction == 0 ? "/Grading u" : "/Grading v") +
                             ": found '" + mesh_.grading[direction] +
                             "'; the surface '" + surface_ +
                             "' is made of patches and can't be graded: leave "
                             "it at s."));
    const unsigned int n = n_cells(0);
    AssertThrow(n_cells(1) == n,
                ExcMessage(path_ + "/Subdivisions: found '" +
                           mesh_.subdivisions + "'; the surface '" + surface_ +
                           "' is made of patches and takes one number of "
                           "cells along the edge of a patch."));
    return n;
  }
} // namespace Nacre
