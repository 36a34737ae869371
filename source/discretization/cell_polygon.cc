// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/cell_polygon.h>
#include <nacre/discretization/cut_graph.h>
#include <nacre/discretization/plane_geometry.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace Nacre
{
  using namespace PlaneGeometry;

  CellPolygon::CellPolygon(const ReferenceCell    &cell,
                           std::vector<Point<dim>> vertices,
                           std::vector<Side>       sides)
    : cell_(cell)
    , vertices_(std::move(vertices))
    , sides_(std::move(sides))
  {
    AssertDimension(vertices_.size(), sides_.size());
    for (unsigned int i = 0; i < vertices_.size() && vertices_.size() > 3;)
      {
        const unsigned int n      = vertices_.size();
        const unsigned int before = (i + n - 1) % n;
        const bool         same_line =
          sides_[before].face == sides_[i].face &&
          sides_[before].cut == sides_[i].cut &&
          sides_[before].is_left == sides_[i].is_left &&
          std::abs(
            offset(vertices_[before], vertices_[(i + 1) % n], vertices_[i])) <
            round_off / 100.;
        if (same_line)
          {
            vertices_.erase(vertices_.begin() + i);
            sides_.erase(sides_.begin() + i);
          }
        else
          ++i;
      }
    Assert(vertices_.size() >= 3, ExcMessage("A polygon has three vertices."));
  }

  CellPolygon
  CellPolygon::whole(const ReferenceCell &cell)
  {
    const std::vector<unsigned int> around =
      cell == ReferenceCells::Triangle ? std::vector<unsigned int>{0, 1, 2} :
                                         std::vector<unsigned int>{0, 1, 3, 2};
    AssertDimension(around.size(), cell.n_vertices());
    std::vector<Point<dim>> vertices;
    std::vector<Side>       sides;
    for (unsigned int i = 0; i < around.size(); ++i)
      for (const unsigned int face : cell.face_indices())
        if (std::minmax(cell.face_to_cell_vertices(face, 0, 1),
                        cell.face_to_cell_vertices(face, 1, 1)) ==
            std::minmax(around[i], around[(i + 1) % around.size()]))
          {
            vertices.push_back(cell.template vertex<dim>(around[i]));
            sides.push_back({face, numbers::invalid_unsigned_int});
          }
    return {cell, vertices, sides};
  }

  double
  CellPolygon::area() const
  {
    double twice = 0.;
    for (unsigned int i = 2; i < n_vertices(); ++i)
      twice += twice_area(vertices_[0], vertices_[i - 1], vertices_[i]);
    return 0.5 * twice;
  }

  bool
  CellPolygon::contains(const Point<dim> &x, const double tolerance) const
  {
    return distance_to_polygon(vertices_, x) <= tolerance;
  }

  Point<dim>
  CellPolygon::inner_point() const
  {
    const auto ears    = triangles();
    const auto smaller = [](const auto &e, const auto &f) {
      return twice_area(e[0], e[1], e[2]) < twice_area(f[0], f[1], f[2]);
    };
    const auto &[a, b, c] =
      *std::max_element(ears.begin(), ears.end(), smaller);
    return Point<dim>((a + Tensor<1, dim>(b) + c) / 3.);
  }

  std::vector<std::array<double, 2>>
  CellPolygon::intervals(const unsigned int face) const
  {
    const Point<dim> start =
      cell_.template vertex<dim>(cell_.face_to_cell_vertices(face, 0, 1));
    const Tensor<1, dim> along =
      cell_.template vertex<dim>(cell_.face_to_cell_vertices(face, 1, 1)) -
      start;
    const auto coordinate = [&](const Point<dim> &x) {
      return ((x - start) * along) / along.norm_square();
    };
    std::vector<std::array<double, 2>> pieces;
    for (unsigned int i = 0; i < n_vertices(); ++i)
      if (sides_[i].face == face)
        {
          const double s = coordinate(vertices_[i]);
          const double t = coordinate(vertices_[(i + 1) % n_vertices()]);
          pieces.push_back({{std::min(s, t), std::max(s, t)}});
        }
    std::sort(pieces.begin(), pieces.end());

    std::vector<std::array<double, 2>> merged;
    for (const auto &piece : pieces)
      if (!merged.empty() && piece[0] <= merged.back()[1] + snap_distance)
        merged.back()[1] = std::max(merged.back()[1], piece[1]);
      else
        merged.push_back(piece);
    return merged;
  }

  double
  distance_to_polygon(const std::vector<Point<dim>> &vertices,
                      const Point<dim>              &x)
  {
    // A ray along xi1 leaves the inside through an odd number of sides.
    bool   inside  = false;
    double nearest = std::numeric_limits<double>::max();
    for (unsigned int i = 0; i < vertices.size(); ++i)
      {
        const Point<dim> &a = vertices[i];
        const Point<dim> &b = vertices[(i + 1) % vertices.size()];
        nearest = std::min(nearest, nearest_on_segment(a, b, x).distance(x));
        if ((a[1] > x[1]) != (b[1] > x[1]) &&
            (twice_area(a, b, x) > 0.) == (b[1] > a[1]))
          inside = !inside;
      }
    return inside ? 0. : nearest;
  }

  namespace
  {
    /**
     * Of the triangle at the vertex @p i: whether it is an ear, with no other
     * vertex in it or on its boundary, and its height over its length, 0 if
     * it is flat or reflex.
     */
    std::pair<bool, double>
    ear_and_shape(const std::vector<Point<dim>> &vertices, const unsigned int i)
    {
      const unsigned int n = vertices.size();
      const Point<dim>  &a = vertices[(i + n - 1) % n];
      const Point<dim>  &b = vertices[i];
      const Point<dim>  &c = vertices[(i + 1) % n];
      const double       length =
        std::max({a.distance(b), b.distance(c), c.distance(a)});
      const double height = twice_area(a, b, c) / length;
      if (height <= round_off)
        return {false, 0.};
      const bool ear =
        std::none_of(vertices.begin(), vertices.end(), [&](const auto &x) {
          return x != a && x != b && x != c && offset(a, b, x) > -round_off &&
                 offset(b, c, x) > -round_off && offset(c, a, x) > -round_off;
        });
      return {ear, height / length};
    }
  } // namespace

  std::vector<std::array<Point<dim>, 3>>
  CellPolygon::triangles() const
  {
    std::vector<std::array<Point<dim>, 3>> ears;
    for (auto rest = vertices_; rest.size() > 2;)
      {
        // Ears come before other corners, which are only needed where sides
        // overlap by the distance of snapping.
        const unsigned int      n    = rest.size();
        unsigned int            best = 0;
        std::pair<bool, double> most(false, 0.);
        for (unsigned int i = 0; i < n; ++i)
          if (const auto corner = ear_and_shape(rest, i); corner > most)
            {
              most = corner;
              best = i;
            }
        if (most.second == 0.)
          break; // what is left is flat
        ears.push_back(
          {{rest[(best + n - 1) % n], rest[best], rest[(best + 1) % n]}});
        rest.erase(rest.begin() + best);
      }
    Assert(!ears.empty(), ExcMessage("The polygon has no area."));
    return ears;
  }

  std::vector<CellPolygon>
  CellPolygon::split(const CutChain &chain) const
  {
    CutGraph graph(*this);
    graph.insert(chain);
    return graph.parts();
  }

  std::vector<CellPolygon>
  divide(const ReferenceCell &cell, const std::vector<CutChain> &chains)
  {
    const auto whole = CellPolygon::whole(cell);
    CutGraph   graph(whole);
    for (const auto &chain : chains)
      graph.insert(chain);
    return graph.parts();
  }
} // namespace Nacre
