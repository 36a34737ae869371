// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/input_file.h>
#include <nacre/base/text.h>
#include <nacre/problem/imperfection.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>

namespace Nacre
{
  namespace
  {
    namespace bg = boost::geometry;

    using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;

    /** Points of a fit: more than the six coefficients of a quadratic. */
    constexpr unsigned int n_neighbours = 16;

    TreePoint
    tree_point(const Point<3> &x)
    {
      return {x[0], x[1], x[2]};
    }

    /** Whether a @p line doesn't begin with a number. */
    bool
    is_comment(const std::string &line)
    {
      char *end = nullptr;
      std::strtod(line.c_str(), &end);
      return end == line.c_str();
    }
  } // namespace

  struct PointField::Tree
  {
    bg::index::rtree<std::pair<TreePoint, unsigned int>, bg::index::rstar<8>>
      tree;
  };

  PointField::PointField(const std::string &text, const std::string &where)
    : where_(where)
  {
    std::istringstream                              in(text);
    std::string                                     line;
    std::size_t                                     n_columns = 0;
    std::vector<std::pair<TreePoint, unsigned int>> entries;
    for (unsigned int number = 1; std::getline(in, line); ++number)
      {
        line = Text::trim(line.substr(0, line.find('#')));
        if (is_comment(line))
          continue;
        const std::string in_line = where + ": line " + std::to_string(number);
        const std::string form    = "all lines have four numbers, 'x y z w', "
                                    "or six, 'x y z dx dy dz'";
        const auto        v       = read_numbers(line, in_line, form);
        if (n_columns == 0)
          n_columns = v.size();
        AssertThrow(v.size() == n_columns && (n_columns == 4 || n_columns == 6),
                    ExcMessage(in_line + " has " + std::to_string(v.size()) +
                               " numbers; " + form + "."));
        const Point<3> x(v[0], v[1], v[2]);
        entries.emplace_back(tree_point(x), points_.size());
        points_.push_back(x);
        values_.push_back(n_columns == 4 ? Tensor<1, 3>({v[3], 0., 0.}) :
                                           Tensor<1, 3>({v[3], v[4], v[5]}));
      }
    AssertThrow(points_.size() >= 3,
                ExcMessage(where + ": " + std::to_string(points_.size()) +
                           " points; a surface needs at least three."));
    is_along_normal_ = (n_columns == 4);
    tree_ =
      std::make_unique<const Tree>(Tree{{entries.begin(), entries.end()}});
  }

  PointField::PointField(PointField &&) noexcept = default;
  PointField::~PointField()                      = default;

  double
  PointField::largest() const
  {
    double result = 0.;
    for (const auto &value : values_)
      result = std::max(result, value.norm());
    return result;
  }

  std::vector<double>
  PointField::weights(const std::vector<Tensor<1, 3>> &offsets,
                      const Tensor<1, 3>              &t0)
  {
    double size = 0., nearest = std::numeric_limits<double>::max();
    for (const auto &d : offsets)
      {
        size    = std::max(size, d.norm());
        nearest = std::min(nearest, d.norm());
      }
    // Any two axes of the tangent plane will do.
    Tensor<1, 3> axis;
    axis[std::abs(t0[0]) < 0.7 ? 0 : 1] = 1.;
    Tensor<1, 3> e_1                    = cross_product_3d(t0, axis);
    e_1 /= e_1.norm();
    const auto e_2 = cross_product_3d(t0, e_1);

    std::vector<double>                result(offsets.size());
    std::vector<std::array<double, 6>> rows;
    LAPACKFullMatrix<double>           normal(6, 6);
    for (unsigned int k = 0; k < offsets.size(); ++k)
      {
        const double d = offsets[k].norm() / size;
        if (d <= 1e-9)
          {
            std::fill(result.begin(), result.end(), 0.);
            result[k] = 1.;
            return result;
          }
        const double s = offsets[k] * e_1 / size, t = offsets[k] * e_2 / size;
        rows.push_back({{1., s, t, s * s, s * t, t * t}});
        // 1 at the nearest point
        result[k] = std::pow(nearest / offsets[k].norm(), 4);
        for (unsigned int i = 0; i < 6; ++i)
          for (unsigned int j = 0; j < 6; ++j)
            normal(i, j) += result[k] * rows[k][i] * rows[k][j];
      }
    // Points on a line determine no more than a polynomial along it.
    normal.compute_inverse_svd(1e-12);
    Vector<double> unit(6), coefficients(6);
    unit[0] = 1.;
    normal.vmult(coefficients, unit);
    for (unsigned int k = 0; k < offsets.size(); ++k)
      {
        double sum = 0.;
        for (unsigned int i = 0; i < 6; ++i)
          sum += coefficients[i] * rows[k][i];
        result[k] *= sum;
      }
    return result;
  }

  Tensor<1, 3>
  PointField::operator()(const Point<3> &x, const Tensor<1, 3> &t0) const
  {
    std::vector<unsigned int> near;
    for (auto it =
           tree_->tree.qbegin(bg::index::nearest(tree_point(x), n_neighbours));
         it != tree_->tree.qend();
         ++it)
      near.push_back(it->second);
    // The order of equally near points must not matter.
    std::sort(near.begin(), near.end());
    std::vector<Tensor<1, 3>> offsets;
    Tensor<1, 3>              nearest;
    double                    spread = 0.;
    for (const unsigned int k : near)
      {
        offsets.push_back(points_[k] - x);
        if (k == near[0] || offsets.back().norm() < nearest.norm())
          nearest = offsets.back();
        spread = std::max(spread, points_[k].distance(points_[near[0]]));
      }
    // Beside the points, or off the surface on which they lie
    std::ostringstream message;
    message << where_ << ": no point of the file is near the point (" << x
            << ") of the surface; the nearest is " << nearest.norm()
            << " away.";
    AssertThrow(nearest.norm() <= spread &&
                  std::abs(nearest * t0) <= 0.1 * spread,
                ExcMessage(message.str()));
    Tensor<1, 3> result;
    const auto   w = weights(offsets, t0);
    for (unsigned int k = 0; k < near.size(); ++k)
      result += w[k] * values_[near[k]];
    return is_along_normal_ ? result[0] * t0 : result;
  }

  Tensor<1, 3>
  Imperfection::operator()(const Point<3> &x, const Tensor<1, 3> &t0) const
  {
    Tensor<1, 3> result = along_normal(x) * t0 + displacement(x);
    for (const auto &[field, factor] : fields)
      result += factor * field(x, t0);
    return result;
  }

  ImperfectionParameters::ImperfectionParameters()
    : ParameterAcceptor("/Mid-surface/Imperfection")
  {
    add_parameter("Along normal",
                  normal_text_,
                  "How far the shell without stress lies from the surface, "
                  "along its normal, an expression of x, y, z of the perfect "
                  "surface. Units: length.");
    add_parameter("Displacement",
                  displacement_text_,
                  "The same along x, y, z, added. Units: length.");
    add_parameter("Modes",
                  modes_text_,
                  "'file: amplitude; ...': modes that another run has written, "
                  "NAME_mode1.csv and so on, added with their largest "
                  "displacement of so many thicknesses, for example "
                  "'output/cylinder_mode1.csv: 0.1'. Units: none.");
    add_parameter("Points",
                  points_text_,
                  "'file: factor; ...': values at scattered points, added: "
                  "lines 'x y z w' of positions on the perfect surface and the "
                  "distance along the normal, or 'x y z dx dy dz'. "
                  "Units: length; the factor none.");
  }

  std::unique_ptr<const Imperfection>
  ImperfectionParameters::make(const Constants   &constants,
                               const MPI_Comm     communicator,
                               const std::string &folder) const
  {
    const std::string section = "Mid-surface/Imperfection/";
    auto              result  = std::make_unique<Imperfection>();
    result->along_normal =
      Expression(normal_text_, section + "Along normal", constants);
    result->displacement =
      VectorExpression(displacement_text_, section + "Displacement", constants);
    const auto add_files = [&](const std::string &text,
                               const std::string &name,
                               const bool         are_modes) {
      for (const auto &entry :
           Text::entries(text, section + name, "file", "mode1.csv: 0.1"))
        for (const auto &quoted : entry.names)
          {
            const std::string file  = Text::unquoted(quoted);
            const std::string where = section + name + ", '" + file + "'";
            double factor = evaluate_number(entry.value, where, constants);
            const std::string content =
              read_input_file(communicator, file, folder, where).content;
            PointField field(content, where);
            result->content += content;
            if (are_modes)
              {
                AssertThrow(constants.count("h") == 1,
                            ExcMessage(where +
                                       ": the section has no thickness h that "
                                       "is a number; use 'Points', whose "
                                       "factor multiplies the values."));
                AssertThrow(field.largest() > 0.,
                            ExcMessage(where + ": all values are zero."));
                factor *= constants.at("h") / field.largest();
              }
            result->fields.emplace_back(std::move(field), factor);
          }
    };
    add_files(modes_text_, "Modes", true);
    add_files(points_text_, "Points", false);
    if (result->along_normal.is_zero() && result->displacement.is_zero() &&
        result->fields.empty())
      return nullptr;
    return result;
  }
} // namespace Nacre
