// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_report_elements_h
#define nacre_tests_report_elements_h

// The elements of the report, 8- and 6-node cells, and 9-node ones, written
// out as polynomials through the records' nodes, and the two sides of a
// record's edge. Independent of the finite elements of the library.

#include "records.h"
#include <nacre/mechanics/edge_frame.h>

/** Shape functions of a record's cell in the records' own coordinates. */
class RecordElement
{
public:
  /** @param type S8, Q9 or T6 */
  explicit RecordElement(const std::string &type)
    : corners_(
        type == "T6" ?
          std::vector<Point<2>>{{0., 0.}, {1., 0.}, {0., 1.}} :
          std::vector<Point<2>>{{-1., -1.}, {1., -1.}, {1., 1.}, {-1., 1.}})
  {
    auto nodes = corners_;
    for (unsigned int k = 0; k < corners_.size(); ++k)
      nodes.push_back(edge_point(k, 0.));
    if (type == "Q9")
      nodes.emplace_back(0., 0.);
    for (unsigned int i = 0; i <= 2; ++i)
      for (unsigned int j = 0; j <= 2; ++j)
        if (type == "Q9" || (type == "S8" && i + j < 4) || i + j <= 2)
          powers_.push_back({{i, j}});
    AssertThrow(powers_.size() == nodes.size(),
                ExcMessage("No such element: " + type));
    coefficients_.reinit(nodes.size(), nodes.size());
    for (unsigned int a = 0; a < nodes.size(); ++a)
      for (unsigned int m = 0; m < powers_.size(); ++m)
        coefficients_(a, m) = monomial(m, nodes[a], {{0, 0}});
    coefficients_.gauss_jordan();
  }

  unsigned int
  n_nodes() const
  {
    return powers_.size();
  }

  /** The point t in [-1, 1] of the edge from the corner k to the next. */
  Point<2>
  edge_point(const unsigned int k, const double t) const
  {
    const Point<2> &next = corners_[(k + 1) % corners_.size()];
    return corners_[k] + 0.5 * (1. + t) * (next - corners_[k]);
  }

  /** The derivative of edge_point() with respect to t. */
  Tensor<1, 2>
  edge_direction(const unsigned int k) const
  {
    return edge_point(k, 1.) - edge_point(k, 0.);
  }

  /** The derivative of N^a, @p order times with respect to xi1 and xi2. */
  double
  derivative(const unsigned int                 a,
             const Point<2>                    &xi,
             const std::array<unsigned int, 2> &order) const
  {
    double value = 0.;
    for (unsigned int m = 0; m < powers_.size(); ++m)
      value += coefficients_(m, a) * monomial(m, xi, order);
    return value;
  }

private:
  double
  monomial(const unsigned int                 m,
           const Point<2>                    &xi,
           const std::array<unsigned int, 2> &order) const
  {
    double value = 1.;
    for (unsigned int d = 0; d < 2; ++d)
      {
        int power = powers_[m][d];
        for (unsigned int k = 0; k < order[d]; ++k, --power)
          value *= power;
        value *= power > 0 ? std::pow(xi[d], power) : 1.;
      }
    return value;
  }

  const std::vector<Point<2>>              corners_;
  std::vector<std::array<unsigned int, 2>> powers_;
  FullMatrix<double>                       coefficients_;
};

/** A cell of a record at one point: its frame and its shape functions. */
struct RecordPoint
{
  RecordPoint(const RecordElement             &element,
              const std::vector<double>       &nodes,
              const std::vector<unsigned int> &cell,
              const Point<2>                  &xi)
    : cell(cell)
  {
    const std::array<std::array<unsigned int, 2>, 5> orders = {
      {{{1, 0}}, {{0, 1}}, {{2, 0}}, {{0, 2}}, {{1, 1}}}};
    std::array<Vector3, 5> phi;
    for (unsigned int a = 0; a < element.n_nodes(); ++a)
      {
        std::array<double, 5> N;
        for (unsigned int k = 0; k < 5; ++k)
          {
            N[k] = element.derivative(a, xi, orders[k]);
            for (unsigned int c = 0; c < 3; ++c)
              phi[k][c] += N[k] * nodes[3 * cell[a] + c];
          }
        dN.push_back({{N[0], N[1]}});
        ddN.push_back({{N[2], N[3], N[4]}});
      }
    frame =
      make_surface_frame(phi[0],
                         phi[1],
                         std::array<Vector3, 3>{{phi[2], phi[3], phi[4]}});
  }

  /** Indices of the cell's nodes. */
  const std::vector<unsigned int>    cell;
  SurfaceFrame<>                     frame;
  std::vector<std::array<double, 2>> dN;
  std::vector<std::array<double, 3>> ddN;
};

/** The nodes of each cell of an edge's record. */
inline std::vector<std::vector<unsigned int>>
record_cells(const Json &record)
{
  std::vector<std::vector<unsigned int>> cells;
  for (const auto &cell : record.get_child("conn"))
    {
      cells.emplace_back();
      for (const double k : numbers_of(cell.second))
        cells.back().push_back(static_cast<unsigned int>(k));
    }
  return cells;
}

/** The records' displacement fields at all nodes, in the order 3 k + c. */
inline std::vector<double>
record_field(const std::string &name, const std::vector<double> &nodes)
{
  std::vector<double> u(nodes.size());
  for (unsigned int k = 0; k < nodes.size(); k += 3)
    {
      const double x = nodes[k], y = nodes[k + 1], z = nodes[k + 2];
      if (name == "rigid")
        {
          u[k]     = -0.2 * z - 0.5 * y + 0.1;
          u[k + 1] = 0.5 * x - 0.3 * z + 0.2;
          u[k + 2] = 0.3 * y + 0.2 * x - 0.3;
        }
      else if (name == "quadratic")
        {
          u[k]     = 0.01 * (x * x - y * z);
          u[k + 1] = 0.01 * (x * y + z);
          u[k + 2] = 0.01 * (y * y + 2. * x * z - x * x);
        }
      else if (name == "trig")
        {
          u[k]     = 0.01 * std::sin(x + 2. * y);
          u[k + 1] = 0.01 * std::cos(y - z);
          u[k + 2] = 0.01 * (std::sin(2. * x) * std::cos(y) + z * z);
        }
      else
        AssertThrow(false, ExcMessage("No such field: " + name));
    }
  return u;
}

#endif
