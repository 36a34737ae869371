// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/shell_strain.h>
#include <nacre/postprocess/part_points.h>
#include <nacre/postprocess/transverse_shear.h>

#include <deal.II/base/qprojector.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, spacedim>;
    using Moment  = SymmetricTensor<2, spacedim>;

    /** Cosine of the angle of two normals from which an edge is a crease. */
    constexpr double crease = 0.94;
    /** The same to the middle of a patch, which is projected onto a plane. */
    constexpr double bent = 0.5;

    /**
     * The points where moments are taken, p - 1 Gauss points each way, where
     * second derivatives of functions of degree p are superconvergent; then the
     * middles of the faces and of the cell.
     */
    Quadrature<dim>
    make_sample_points(const Element &element)
    {
      const auto              cell   = element.reference_cell();
      const unsigned int      n      = element.degree - 1;
      auto                    points = element.type == ElementType::triangle ?
                                         QGaussSimplex<dim>(n).get_points() :
                                         QGauss<dim>(n).get_points();
      std::vector<Point<dim>> middle(1);
      for (const unsigned int face : cell.face_indices())
        {
          QProjector<dim>::project_to_face(cell, QMidpoint<1>(), face, middle);
          points.push_back(middle[0]);
        }
      points.push_back(cell.barycenter<dim>());
      return Quadrature<dim>(points);
    }

    /**
     * Polynomials in two coordinates (x, y) that are orthonormal on given
     * points: monomials of ascending degree, made orthogonal one after the
     * other. The points are at distances of 1 or so. Those that the points can
     * hardly tell from the ones before are
     * left out, as are those of a high degree across a strip of one cell.
     */
    class OrthogonalPolynomials
    {
    public:
      OrthogonalPolynomials(const unsigned int           degree,
                            const std::vector<Point<2>> &points)
      {
        for (unsigned int k = 0; k <= degree; ++k)
          for (unsigned int j = 0; j <= k; ++j)
            add({{k - j, j}}, points);
      }

      unsigned int
      size() const
      {
        return values_.size();
      }

      /** Of the polynomial @p i at all points. */
      const std::vector<double> &
      values(const unsigned int i) const
      {
        return values_[i];
      }

      /** The gradients of all polynomials at any point. */
      std::vector<Tensor<1, 2>>
      gradients(const Point<2> &x) const
      {
        std::vector<Tensor<1, 2>> result;
        for (unsigned int i = 0; i < size(); ++i)
          {
            const auto [a, b] = exponents_[i];
            Tensor<1, 2> gradient;
            if (a > 0)
              gradient[0] = a * std::pow(x[0], a - 1) * std::pow(x[1], b);
            if (b > 0)
              gradient[1] = b * std::pow(x[0], a) * std::pow(x[1], b - 1);
            for (unsigned int j = 0; j < i; ++j)
              gradient -= parts_[i][j] * result[j];
            result.push_back(gradient / norms_[i]);
          }
        return result;
      }

    private:
      using Exponents = std::array<unsigned int, 2>;

      void
      add(const Exponents &exponents, const std::vector<Point<2>> &points)
      {
        if (size() == points.size())
          return;
        std::vector<double> value;
        for (const auto &x : points)
          value.push_back(std::pow(x[0], exponents[0]) *
                          std::pow(x[1], exponents[1]));
        const auto product = [&](const std::vector<double> &other) {
          return std::inner_product(value.begin(), value.end(), &other[0], 0.);
        };
        const double        whole = std::sqrt(product(value));
        std::vector<double> parts(size());
        // Twice is enough for orthogonality to round-off.
        for (unsigned int twice = 0; twice < 2; ++twice)
          for (unsigned int j = 0; j < size(); ++j)
            {
              const double part = product(values_[j]);
              parts[j] += part;
              for (unsigned int q = 0; q < value.size(); ++q)
                value[q] -= part * values_[j][q];
            }
        const double norm = std::sqrt(product(value));
        // Of the coordinates' unit too: a row of points tells nothing across.
        if (norm <= 0.02 * std::max(whole, std::sqrt(1. * points.size())))
          return;
        for (double &v : value)
          v /= norm;
        exponents_.push_back(exponents);
        values_.push_back(value);
        parts_.push_back(parts);
        norms_.push_back(norm);
      }

      /** By polynomial: x^a y^b, less parts of those before, over a norm. */
      std::vector<Exponents>           exponents_;
      std::vector<std::vector<double>> values_, parts_;
      std::vector<double>              norms_;
    };
  } // namespace

  TransverseShear::TransverseShear(const ShellState &state)
    : state_(state)
    , sample_points_(make_sample_points(state.discretization.element()))
    , strains_(state, sample_points_)
    , cells_of_vertex_(
        GridTools::vertex_to_cell_map(state.discretization.triangulation()))
    , samples_(state.discretization.n_part_indices())
  {}

  Quadrature<dim>
  TransverseShear::sample_points_of(const CellPart &part) const
  {
    const auto &all = sample_points_.get_points();
    // The middles are those of the cell.
    const auto middles = all.end() - (part.cell->n_faces() + 1);
    auto       points  = state_.discretization.degree() == 2 ?
                           std::vector<Point<dim>>{centroid(part.polygon())} :
                           points_on_part(part, {all.begin(), middles});
    points.insert(points.end(), middles, all.end());
    return Quadrature<dim>(points);
  }

  const TransverseShear::Samples &
  TransverseShear::samples(const CellPart &part)
  {
    Samples &samples = samples_[part.index()];
    if (!samples.normals.empty())
      return samples;
    std::optional<StrainValues> of_part;
    if (part.is_cut())
      of_part.emplace(state_, sample_points_of(part));
    StrainValues &strains = of_part ? *of_part : strains_;
    strains.reinit(part);
    const auto        &values  = strains.values();
    const unsigned int n_other = part.cell->n_faces() + 1;
    const unsigned int n       = values.n_points() - n_other;
    for (unsigned int q = 0; q < n; ++q)
      {
        const auto answer = state_.section().response(strains.membrane(q),
                                                      strains.bending(q),
                                                      values.frame(q),
                                                      values.point(q),
                                                      strains.section_state(q));
        samples.positions.push_back(values.point(q));
        samples.moments.emplace_back(symmetrize(
          ShellStrain::resultant_tensor(values.frame(q), answer.moment)));
      }
    for (unsigned int q = n; q < values.n_points(); ++q)
      samples.normals.push_back(values.frame(q).t0);
    samples.middle = values.point(values.n_points() - 1);
    return samples;
  }

  std::vector<TransverseShear::Neighbor>
  TransverseShear::neighbors(const CellPart    &part,
                             const unsigned int face) const
  {
    const auto &cell  = part.cell;
    const auto &parts = state_.discretization.cell_parts();
    if (cell->at_boundary(face))
      return {};
    if (cell->neighbor_is_coarser(face))
      return {{parts.part(cell->neighbor(face)),
               cell->neighbor_of_coarser_neighbor(face).first}};
    const auto other = cell->neighbor_of_neighbor(face);
    if (cell->neighbor(face)->has_children())
      {
        std::vector<Neighbor> children;
        for (const unsigned int sub : {0, 1})
          children.emplace_back(parts.part(cell_iterator(
                                  cell->neighbor_child_on_subface(face, sub))),
                                other);
        return children;
      }
    const cell_iterator neighbor = cell->neighbor(face);
    if (neighbor->is_artificial() || !parts.has_pieces(cell, face))
      return {{parts.part(neighbor), other}};
    std::vector<Neighbor> result;
    for (const EdgePiece &piece : parts.pieces_between(cell, face))
      if (piece.sides[0].part.index() == part.index())
        result.emplace_back(piece.sides[1].part, other);
    return result;
  }

  std::set<unsigned int>
  TransverseShear::parts_around(const CellPart &part) const
  {
    const auto            &cell  = part.cell;
    const auto            &parts = state_.discretization.cell_parts();
    std::set<unsigned int> around;
    for (const unsigned int v : cell->vertex_indices())
      if (!part.is_cut() ||
          part.polygon().contains(cell->reference_cell().vertex<dim>(v), 1e-6))
        for (const auto &other : cells_of_vertex_[cell->vertex_index(v)])
          if (!other->is_artificial() &&
              other->material_id() == cell->material_id())
            {
              const cell_iterator it(&state_.discretization.triangulation(),
                                     other->level(),
                                     other->index(),
                                     &state_.discretization.dof_handler());
              for (unsigned int i = 0; i < parts.n_parts(it); ++i)
                around.insert(parts.part(it, i).index());
            }
    if (part.is_cut())
      for (const unsigned int face : cell->face_indices())
        for (const auto &[other, other_face] : neighbors(part, face))
          if (!other.cell->is_artificial() &&
              other.cell->material_id() == cell->material_id())
            around.insert(other.index());
    // A cell that a cut divides is on one side of it.
    for (unsigned int i = 0; i < parts.n_parts(cell); ++i)
      around.erase(parts.part(cell, i).index());
    return around;
  }

  std::vector<TransverseShear::Member>
  TransverseShear::patch(const CellPart &part)
  {
    auto                around  = parts_around(part);
    const Vector3       middle  = samples(part).normals.back();
    std::vector<Member> members = {{part, 1.}};
    for (unsigned int i = 0; i < members.size(); ++i)
      for (const unsigned int face : part.cell->face_indices())
        for (const auto &[other, other_face] : neighbors(members[i].part, face))
          {
            if (around.count(other.index()) == 0)
              continue;
            const double cosine = samples(members[i].part).normals[face] *
                                  samples(other).normals[other_face];
            const double sign =
              cosine > 0. ? members[i].sign : -members[i].sign;
            if (std::abs(cosine) < crease ||
                sign * (middle * samples(other).normals.back()) < bent)
              continue;
            around.erase(other.index());
            members.push_back({other, sign});
          }
    return members;
  }

  template <typename Place>
  std::pair<std::vector<Point<2>>, std::vector<TransverseShear::Moment>>
  TransverseShear::gather(const std::vector<Member> &members,
                          const Place               &place)
  {
    std::vector<Point<2>> places;
    std::vector<Moment>   moments;
    for (const bool takes_small : {false, true})
      if (places.empty())
        for (const auto &member : members)
          if (takes_small || !state_.discretization.is_small(member.part))
            {
              const Samples &from = samples(member.part);
              for (const auto &x : from.positions)
                places.push_back(place(x));
              for (const auto &M : from.moments)
                moments.push_back(member.sign * M);
            }
    return {places, moments};
  }

  void
  TransverseShear::reinit(const CellPart &part, const ShellCellValues &points)
  {
    const auto               members = patch(part);
    const Point<spacedim>    origin  = samples(part).middle;
    const auto               n       = samples(part).normals.back();
    std::array<Vector3, dim> e;
    e[0] = points.frame(0).a_cov[0];
    e[0] -= (e[0] * n) * n;
    e[0] /= e[0].norm();
    e[1] = cross_product_3d(n, e[0]);

    // The cell is of the size 1 in both coordinates.
    std::array<double, dim> size{};
    for (const auto &x : state_.discretization.geometry_nodes(part))
      for (unsigned int i = 0; i < dim; ++i)
        size[i] = std::max(size[i], std::abs((x - origin) * e[i]));
    const auto place = [&](const Point<spacedim> &x) {
      const Vector3 d = x - origin;
      return Point<2>(d * e[0] / size[0], d * e[1] / size[1]);
    };
    const auto [places, moments] = gather(members, place);
    const OrthogonalPolynomials polynomials(state_.discretization.degree(),
                                            places);
    std::vector<Moment>         coefficients(polynomials.size());
    for (unsigned int i = 0; i < polynomials.size(); ++i)
      for (unsigned int q = 0; q < places.size(); ++q)
        coefficients[i] += polynomials.values(i)[q] * moments[q];

    values_.resize(points.n_points());
    for (unsigned int q = 0; q < values_.size(); ++q)
      {
        const auto &frame     = points.frame(q);
        const auto  gradients = polynomials.gradients(place(points.point(q)));
        Vector3     divergence;
        for (unsigned int b = 0; b < dim; ++b)
          for (unsigned int i = 0; i < polynomials.size(); ++i)
            {
              const double derivative =
                gradients[i][0] * (e[0] * frame.a_cov[b]) / size[0] +
                gradients[i][1] * (e[1] * frame.a_cov[b]) / size[1];
              divergence += derivative * (coefficients[i] * frame.a_con[b]);
            }
        values_[q] = divergence - (divergence * frame.t0) * frame.t0;
      }
  }
} // namespace Nacre
