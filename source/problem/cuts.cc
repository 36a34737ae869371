// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/expression.h>
#include <nacre/base/input_file.h>
#include <nacre/base/number_range.h>
#include <nacre/base/text.h>
#include <nacre/problem/cuts.h>
#include <nacre/problem/midsurface.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace Nacre
{
  namespace
  {
    const std::string cuts_parameter   = "Cuts/Cuts";
    const std::string remove_parameter = "Cuts/Remove";

    const char *const cut_forms =
      "'uv (0, 0.5) (1, 0.5)', 'xyz (0, 0, 1) (0.2, 0, 1)', 'uv closed "
      "expression cos(2*pi*s), sin(2*pi*s), 64 points' or 'file NAME'";

    /** Take the first word of a text, up to a blank or a parenthesis. */
    std::string
    take_word(std::string &text)
    {
      const std::size_t end  = text.find_first_of(" \t(");
      const std::string word = text.substr(0, end);
      text = end == std::string::npos ? "" : Text::trim(text.substr(end));
      return word;
    }

    Point<spacedim>
    to_point(const std::vector<double> &numbers)
    {
      return Point<spacedim>(numbers[0],
                             numbers[1],
                             numbers.size() == 3 ? numbers[2] : 0.);
    }

    std::string
    in_words(const Point<spacedim> &x, const CutCurve::Coordinates coordinates)
    {
      std::ostringstream text;
      text << '(' << x[0] << ", " << x[1];
      if (coordinates == CutCurve::Coordinates::space)
        text << ", " << x[2];
      text << ')';
      return text.str();
    }

    std::string
    form_of_points(const CutCurve::Coordinates coordinates)
    {
      return coordinates == CutCurve::Coordinates::chart ?
               "two numbers, '(u, v)'" :
               "three numbers, '(x, y, z)'";
    }

    unsigned int
    n_coordinates(const CutCurve::Coordinates coordinates)
    {
      return coordinates == CutCurve::Coordinates::chart ? 2 : 3;
    }

    /** The points "(a, b) (c, d) ..." of a text. */
    std::vector<Point<spacedim>>
    read_points(const std::string          &text,
                const CutCurve::Coordinates coordinates,
                const std::string          &where,
                const Constants            &constants)
    {
      std::vector<Point<spacedim>> points;
      std::size_t                  begin = 0;
      while (begin < text.size())
        {
          AssertThrow(text[begin] == '(',
                      ExcMessage(where + ": found '" + text.substr(begin) +
                                 "' where a point in parentheses, " +
                                 form_of_points(coordinates) +
                                 ", is expected."));
          // Text::entries() has found each '(' closed.
          std::size_t end = begin;
          for (int depth = 0; end < text.size(); ++end)
            {
              depth += (text[end] == '(') - (text[end] == ')');
              if (depth == 0)
                break;
            }
          const std::string   inside = text.substr(begin + 1, end - begin - 1);
          std::vector<double> numbers;
          for (const auto &part : Text::split(inside, ',', where))
            numbers.push_back(evaluate_number(part, where, constants));
          AssertThrow(numbers.size() == n_coordinates(coordinates),
                      ExcMessage(where + ": the point '(" + inside + ")' has " +
                                 std::to_string(numbers.size()) +
                                 " numbers; a point has " +
                                 form_of_points(coordinates) + "."));
          points.push_back(to_point(numbers));
          begin = text.find_first_not_of(" \t,", end + 1);
        }
      return points;
    }

    /** The points of "u(s), v(s), 64 points" for s from 0 to 1. */
    std::vector<Point<spacedim>>
    read_expressions(const std::string &text,
                     const CutCurve    &curve,
                     const std::string &where,
                     const Constants   &constants)
    {
      const unsigned int n_components = n_coordinates(curve.coordinates);
      auto               parts        = Text::split(text, ',', where);
      const std::string  word         = "points";
      const std::string  count        = parts.empty() ? "" : parts.back();
      const bool         has_count =
        count.size() > word.size() &&
        count.compare(count.size() - word.size(), word.size(), word) == 0;
      AssertThrow(parts.size() == n_components + 1 && has_count,
                  ExcMessage(where + ": found '" + text + "'; " +
                             std::to_string(n_components) +
                             " expressions of s, 0 <= s <= 1, and a number of "
                             "points are expected: 'expression " +
                             (n_components == 3 ? "s, s^2, 0" : "s, s^2") +
                             ", 32 points'."));
      const double n =
        evaluate_number(count.substr(0, count.size() - word.size()),
                        where + ", number of points",
                        constants);
      const double n_min = curve.is_closed ? 3. : 2.;
      AssertThrow(n >= n_min && n <= 1e6 && n == std::floor(n),
                  ExcMessage(where + ": found " + Text::number(n) +
                             " points; a whole number from " +
                             Text::number(n_min) + " to 1000000 is allowed."));

      std::vector<Expression> components;
      for (unsigned int c = 0; c < n_components; ++c)
        components.emplace_back(parts[c], where, constants, "s");
      std::vector<Point<spacedim>> points(static_cast<std::size_t>(n));
      for (std::size_t i = 0; i < points.size(); ++i)
        {
          const Point<3> s(i / (curve.is_closed ? n : n - 1.), 0., 0.);
          for (unsigned int c = 0; c < n_components; ++c)
            points[i][c] = components[c](s);
        }
      return points;
    }

    /** The curves of a file: one point a line, an empty line between curves. */
    std::vector<CutCurve>
    read_curves(const std::string &content, const std::string &where)
    {
      std::vector<CutCurve> curves;
      std::istringstream    in(content);
      std::string           line;
      bool                  begins = true;
      for (unsigned int number = 1; std::getline(in, line); ++number)
        {
          const std::string text = Text::trim(line.substr(0, line.find('#')));
          const bool is_comment  = text.empty() && !Text::trim(line).empty();
          const std::string in_line =
            where + ", line " + std::to_string(number);
          if (is_comment)
            continue;
          if (text.empty())
            {
              begins = true;
              continue;
            }
          const auto numbers =
            read_numbers(text,
                         in_line,
                         "a line holds two numbers, 'u, v', or three, "
                         "'x, y, z'");
          AssertThrow(numbers.size() == 2 || numbers.size() == 3,
                      ExcMessage(in_line + ": found " +
                                 std::to_string(numbers.size()) +
                                 " numbers; two, 'u, v', or three, 'x, y, z', "
                                 "are allowed."));
          const auto coordinates = numbers.size() == 2 ?
                                     CutCurve::Coordinates::chart :
                                     CutCurve::Coordinates::space;
          if (begins)
            curves.push_back({"", coordinates, {}, false});
          begins = false;
          AssertThrow(coordinates == curves.back().coordinates,
                      ExcMessage(in_line + ": found " +
                                 std::to_string(numbers.size()) +
                                 " numbers; the lines before have " +
                                 form_of_points(curves.back().coordinates) +
                                 ", and an empty line begins another curve."));
          curves.back().points.push_back(to_point(numbers));
        }
      AssertThrow(!curves.empty(),
                  ExcMessage(where +
                             ": the file holds no points; a line for "
                             "each, 'u, v' or 'x, y, z', is expected."));
      return curves;
    }

    /** Distance below which two points are one: far above round-off. */
    double
    coincidence(const std::vector<Point<spacedim>> &points)
    {
      double size = 0.;
      for (const auto &point : points)
        size = std::max(size, Tensor<1, spacedim>(point).norm());
      return 1e-13 * size;
    }

    /** Take a repeated first point as the sign of a closed curve. */
    void
    close_if_repeated(CutCurve &curve)
    {
      auto &points = curve.points;
      if (points.size() < 3 ||
          points.front().distance(points.back()) > coincidence(points))
        return;
      points.pop_back();
      curve.is_closed = true;
    }

    void
    check_points(const CutCurve &curve, const std::string &where)
    {
      const auto        &points = curve.points;
      const unsigned int n_min  = curve.is_closed ? 3 : 2;
      AssertThrow(points.size() >= n_min,
                  ExcMessage(where + ": found " +
                             std::to_string(points.size()) +
                             (points.size() == 1 ? " point; " : " points; ") +
                             (curve.is_closed ? "a closed cut needs three " :
                                                "a cut needs two ") +
                             "at least."));
      const double tolerance = coincidence(points);
      for (std::size_t i = 0; i + (curve.is_closed ? 0 : 1) < points.size();
           ++i)
        {
          const std::size_t next = (i + 1) % points.size();
          AssertThrow(points[i].distance(points[next]) > tolerance,
                      ExcMessage(where + ": the points " +
                                 std::to_string(i + 1) + " and " +
                                 std::to_string(next + 1) + " are the same, " +
                                 in_words(points[i], curve.coordinates) +
                                 "; neighbours must differ."));
        }
    }

    /** The curve of "uv [closed] (..) (..)" or "uv [closed] expression ..". */
    CutCurve
    read_curve(const std::string &name,
               const std::string &value,
               const std::string &where,
               const Constants   &constants)
    {
      std::string       rest  = value;
      const std::string first = take_word(rest);
      AssertThrow(first == "uv" || first == "xyz",
                  ExcMessage(where + ": unknown coordinates '" + first +
                             "'; 'uv', 'xyz' and 'file' are allowed: " +
                             cut_forms + "."));
      CutCurve    curve{name,
                     first == "uv" ? CutCurve::Coordinates::chart :
                                        CutCurve::Coordinates::space,
                     {},
                     false};
      std::string after = rest;
      if (take_word(after) == "closed")
        {
          curve.is_closed = true;
          rest            = after;
        }
      after = rest;
      if (take_word(after) == "expression")
        curve.points = read_expressions(after, curve, where, constants);
      else
        curve.points = read_points(rest, curve.coordinates, where, constants);
      return curve;
    }

    /** The curves of "name: ..."; relative names of files are in @p folder. */
    std::vector<CutCurve>
    read_entry(const Text::Entry &entry,
               const Constants   &constants,
               const MPI_Comm     communicator,
               const std::string &folder)
    {
      AssertThrow(entry.names.size() == 1,
                  ExcMessage(cuts_parameter + ": '" + entry.text + "' has " +
                             std::to_string(entry.names.size()) +
                             " names; a cut has one."));
      const std::string     name  = Text::unquoted(entry.names.front());
      const std::string     where = cuts_parameter + ", '" + entry.text + "'";
      std::string           file  = entry.value;
      std::vector<CutCurve> curves;
      if (take_word(file) == "file")
        curves = read_curves(
          read_input_file(communicator, Text::unquoted(file), folder, where)
            .content,
          where);
      else
        curves = {read_curve(name, entry.value, where, constants)};
      const bool is_alone = curves.size() == 1;
      for (std::size_t i = 0; i < curves.size(); ++i)
        {
          CutCurve &curve = curves[i];
          curve.name = is_alone ? name : name + "-" + std::to_string(i + 1);
          close_if_repeated(curve);
          check_points(curve,
                       is_alone ? where : where + ", curve " + curve.name);
        }
      return curves;
    }
  } // namespace


  const Selection<CutTips> &
  selection(CutTips)
  {
    static const Selection<CutTips> table = {
      {CutTips::closed, "closed"},
      {CutTips::harmonic, "harmonic"},
      {CutTips::harmonic_all_components, "harmonic, all components"},
      {CutTips::branch_functions, "branch functions"}};
    return table;
  }


  unsigned int
  find_cut(const std::string &name, const Cuts &cuts, const std::string &where)
  {
    std::vector<std::string> names;
    for (const CutCurve &curve : cuts.curves)
      names.push_back(curve.name);
    AssertThrow(!names.empty(),
                ExcMessage(where + ": the shell has no cuts; 'Cuts/Cuts' "
                                   "names them."));
    const auto found = std::find(names.begin(), names.end(), name);
    AssertThrow(found != names.end(),
                ExcMessage(Text::unknown_name(where, "cut", name, names)));
    return found - names.begin();
  }

  CutParameters::CutParameters()
    : ParameterAcceptor("/Cuts")
  {
    add_parameter("Cuts",
                  cuts_text_,
                  "Curves along which the shell is cut, 'name: where; ...'. "
                  "Where: 'uv (2, 0) (2, 3)', points of the surface's (u, v), "
                  "joined by straight lines there; 'xyz (0, 0, 1) (0.2, 0, 1)' "
                  "points in space, joined over the surface; behind 'uv' or "
                  "'xyz' also 'closed', and 'expression cos(2*pi*s), "
                  "sin(2*pi*s), 64 points' in place of points, 0 <= s <= 1; or "
                  "'file NAME' with a point a line, two numbers for uv, three "
                  "for xyz, and an empty line between curves, NAME-1, NAME-2. "
                  "A cut may run beyond the surface's edges; an end inside is "
                  "a tip. Units: those of u and v; length.");
    add_parameter("Remove",
                  remove_text_,
                  "Pieces that the cuts separate and that are taken away: a "
                  "point (x, y, z) of each, '(1, 2, 0); (0, 1, 0)'. Units: "
                  "length.");
    add_parameter("Snap",
                  snap_,
                  "A cut that crosses an edge of a cell nearer to its end than "
                  "this part of the edge runs through the end. Units: none.",
                  prm,
                  Patterns::Double(0., 0.2));
    add_parameter("Smallest part",
                  smallest_part_,
                  "Parts that are smaller than this part of their cell take "
                  "their displacements from a neighbour, so that the matrix "
                  "stays well conditioned. Units: none.",
                  prm,
                  Patterns::Double(0., 0.5));
    add_parameter("Tips",
                  tips_,
                  "What displacements can do at the tip of a cut that ends "
                  "inside a cell. 'closed': the crack closes at the edge by "
                  "which it enters that cell. 'harmonic': functions of the "
                  "cell open it up to its end, tangential displacements by a "
                  "harmonic function, normal ones by a biharmonic one; "
                  "'harmonic, all components': harmonic ones for all, whose "
                  "bending energy is infinite but for the quadrature. Both are "
                  "for quadrilaterals, with the direct solver; in large "
                  "rotations 'harmonic' takes the biharmonic one for all. "
                  "'branch functions': the singular fields of Williams around "
                  "the tip's very place are added, with coefficients of their "
                  "own, vectors in large rotations; for a homogeneous "
                  "isotropic section, with the direct solver.",
                  prm);
    add_parameter("Tip radius",
                  tip_radius_,
                  "Distance from a tip up to which branch functions are whole; "
                  "in the cells that touch the tip's cell they are whatever it "
                  "is. With 0 that zone shrinks as a mesh is refined, and the "
                  "error of stress intensities with the size of the cells; "
                  "with a zone that remains it shrinks with the order of the "
                  "degree. Units: length.");
  }


  void
  CutParameters::set_files(const MPI_Comm     communicator,
                           const std::string &folder)
  {
    communicator_ = communicator;
    folder_       = folder;
  }


  Cuts
  CutParameters::make(const Constants  &constants,
                      const Midsurface &midsurface) const
  {
    Cuts result;
    result.snap          = snap_;
    result.smallest_part = smallest_part_;
    result.tips          = tips_;
    result.tip_radius =
      nonnegative_number(tip_radius_, "Cuts/Tip radius", constants);
    AssertThrow(result.tip_radius == 0. || tips_ == CutTips::branch_functions,
                ExcMessage("Cuts/Tip radius: found " +
                           Text::number(result.tip_radius) +
                           " with 'Tips = " + name_of(tips_) +
                           "'; only branch functions have a radius."));
    // Names of curves, and the entries that give them.
    std::map<std::string, std::string> known;
    for (const auto &entry : Text::entries(cuts_text_,
                                           cuts_parameter,
                                           "cut",
                                           "slit: uv (0, 0.5) (1, 0.5)"))
      for (CutCurve &curve :
           read_entry(entry, constants, communicator_, folder_))
        {
          const std::string where = cuts_parameter + ", '" + entry.text + "'";
          AssertThrow(known.emplace(curve.name, entry.text).second,
                      ExcMessage(where + ": the name '" + curve.name +
                                 "' is that of '" + known[curve.name] +
                                 "'; two cuts can't have one name."));
          AssertThrow(curve.coordinates != CutCurve::Coordinates::chart ||
                        midsurface.has_chart(),
                      ExcMessage(where +
                                 ": this surface isn't described over a "
                                 "rectangle of (u, v); give the points in "
                                 "space, 'xyz (x, y, z) ...'."));
          result.curves.push_back(std::move(curve));
        }
    for (const auto &text : Text::split(remove_text_, ';', remove_parameter))
      result.remove.push_back(
        evaluate_point(text, remove_parameter, constants));
    AssertThrow(result.remove.empty() || !result.is_empty(),
                ExcMessage(remove_parameter + ": found '" + remove_text_ +
                           "', but 'Cuts/Cuts' is empty; only pieces that cuts "
                           "separate can be taken away."));
    return result;
  }
} // namespace Nacre
