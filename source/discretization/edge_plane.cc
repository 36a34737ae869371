// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/edge_plane.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, spacedim>;

    /** The nodes and what follows from them. */
    class EdgeShape
    {
    public:
      EdgeShape(const std::vector<PlaneNode> &nodes, const double extent);

      /** The node farthest from the plane through the centre, and how far. */
      std::pair<double, Point<spacedim>>
      deviation(const Vector3 &normal) const
      {
        std::pair<double, Point<spacedim>> farthest(0., centre_);
        for (const auto &node : nodes_)
          {
            const double distance =
              std::abs((node.position - centre_) * normal);
            if (distance > farthest.first)
              farthest = {distance, node.position};
          }
        return farthest;
      }

      bool
      is_in_plane(const Vector3 &normal) const
      {
        return deviation(normal).first <= allowed;
      }

      /** Mean of (conormal . direction)^2: 1 if all are parallel to it. */
      double
      alignment(const Vector3 &direction) const
      {
        double sum = 0.;
        for (const auto &node : nodes_)
          sum += (node.conormal * direction) * (node.conormal * direction);
        return sum / nodes_.size();
      }

      /** How far a node may be off (length). */
      double allowed;
      /** Largest angle between normals in a cell at the edge (rad). */
      double turn = 0.;
      /**
       * Unit vectors along the edge, across it in its plane, and normal to the
       * plane.
       */
      Vector3 along, sideways, fitted;
      /** Mean conormal orthogonal to the edge, of either sign. */
      Vector3 conormal;

    private:
      const std::vector<PlaneNode> &nodes_;
      Point<spacedim>               centre_;
    };

    EdgeShape::EdgeShape(const std::vector<PlaneNode> &nodes,
                         const double                  extent)
      : nodes_(nodes)
    {
      double coordinate = 0., size = 0.;
      for (const auto &node : nodes)
        {
          centre_ += (1. / nodes.size()) * node.position;
          turn = std::max(turn, node.turn);
          for (unsigned int c = 0; c < spacedim; ++c)
            coordinate = std::max(coordinate, std::abs(node.position[c]));
        }
      SymmetricTensor<2, spacedim> moments, conormals;
      for (const auto &node : nodes)
        {
          const Vector3 x = (node.position - centre_) / extent;
          size            = std::max(size, 2. * extent * x.norm());
          moments += symmetrize(outer_product(x, x));
        }
      allowed = std::min(2e-5 * extent + 1e-7 * coordinate, 1e-2 * size);

      const auto axes = eigenvectors(moments);
      along           = axes[0].second;
      sideways        = axes[1].second;
      fitted          = axes[2].second;
      for (const auto &node : nodes)
        {
          const Vector3 n = node.conormal - (node.conormal * along) * along;
          conormals += symmetrize(outer_product(n, n));
        }
      conormal = eigenvectors(conormals)[0].second;
    }

    /**
     * The normal of a coordinate plane or else of a plane parallel to an axis
     * that holds the edge as well, within @p angle (rad) of @p normal. Returns
     * @p normal if there is no such plane.
     */
    Vector3
    take_simple(const EdgeShape &edge,
                const Vector3   &normal,
                const double     angle)
    {
      std::array<Vector3, spacedim> axes;
      std::vector<Vector3>          simple;
      for (unsigned int c = 0; c < spacedim; ++c)
        axes[c][c] = 1.;
      simple.assign(axes.begin(), axes.end());
      for (const auto &axis : axes)
        if (const Vector3 n = cross_product_3d(edge.along, axis);
            n.norm() > 0.1)
          simple.push_back(n / n.norm());
      for (const auto &candidate : simple)
        if (cross_product_3d(candidate, normal).norm() <= angle &&
            edge.is_in_plane(candidate))
          return candidate;
      return normal;
    }

    std::string
    in_words(const std::pair<double, Point<spacedim>> &off,
             const double                              allowed)
    {
      std::ostringstream text;
      text << "its node (" << off.second[0] << ", " << off.second[1] << ", "
           << off.second[2] << ") is off by " << off.first << "; allowed is "
           << allowed << ", which 5 digits of the coordinates keep.";
      return text.str();
    }
  } // namespace

  Tensor<1, spacedim>
  plane_of_edge(const std::vector<PlaneNode> &nodes,
                const double                  extent,
                const std::string            &source)
  {
    const EdgeShape edge(nodes, extent);
    // Conormals are as precise as the geometry's derivatives in a cell.
    const double angle   = 1e-4 + 0.1 * edge.turn;
    const double sagitta = edge.deviation(edge.sideways).first;
    const double off     = edge.deviation(edge.fitted).first;

    const bool conormals_agree = edge.alignment(edge.conormal) > 0.5;
    const bool is_precise = off <= 1e-3 * sagitta && sagitta > 1e-9 * extent;
    const bool is_across =
      cross_product_3d(edge.fitted, edge.conormal).norm() <= angle;
    if (conormals_agree && edge.is_in_plane(edge.conormal) &&
        sagitta <= 100. * edge.allowed && !(is_precise && is_across))
      return take_simple(edge, edge.conormal, angle);

    AssertThrow(edge.is_in_plane(edge.fitted),
                ExcMessage(
                  source +
                  ": the edge lies in no plane, as a symmetry or "
                  "diaphragm edge must: " +
                  in_words(edge.deviation(edge.fitted), edge.allowed)));
    AssertThrow(edge.alignment(edge.fitted) > 0.01,
                ExcMessage(
                  source +
                  ": the edge lies in no plane across the surface, "
                  "as a symmetry or diaphragm edge must, but is "
                  "curved within the surface: from a straight line " +
                  in_words(edge.deviation(edge.sideways), edge.allowed)));
    return take_simple(edge, edge.fitted, 3. * off / sagitta + 1e-8);
  }
} // namespace Nacre
