// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/text.h>
#include <nacre/discretization/part_quadrature.h>
#include <nacre/forms/assembly.h>
#include <nacre/forms/shell_actions.h>
#include <nacre/mechanics/elastic_plate.h>
#include <nacre/postprocess/crack_edges.h>
#include <nacre/postprocess/crack_interaction.h>
#include <nacre/postprocess/crack_lips.h>
#include <nacre/postprocess/crack_points.h>
#include <nacre/postprocess/energy_release.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, spacedim>;

    /** How far lips may leave the plane y = 0, in shares of the distance. */
    constexpr double straight = 0.02;
    /** Their slope: crossings with edges that snap turn a piece by that. */
    constexpr double crooked = 0.3;
    /** Cosine of the angle of two normals from which an edge is a crease. */
    constexpr double crack_crease = 0.94;
    /** The same of a normal to that at the tip. */
    constexpr double crack_bend = 0.5;

    /** q isn't polynomial: more points than for the stiffness. */
    unsigned int
    n_points(const Discretization &discretization)
    {
      return discretization.degree() + 6;
    }

    Quadrature<dim>
    ring_quadrature(const Discretization &discretization)
    {
      const unsigned int n = n_points(discretization);
      if (discretization.element().type == ElementType::triangle)
        return QDuffy(n, 1.);
      return QGauss<dim>(n);
    }

    /** Of a part of a divided cell, or one that has tip functions. */
    Quadrature<dim>
    ring_quadrature(const Discretization &discretization, const CellPart &part)
    {
      if (part.enrichment() != nullptr)
        return enriched_quadrature(part, discretization.degree());
      // 2 degree + 1 points a direction
      const unsigned int n = n_points(discretization);
      return part_quadrature(part.polygon(),
                             std::max(discretization.degree(), n / 2));
    }

    std::string
    coordinates_of(const Point<3> &x)
    {
      return "(" + Text::number(x[0]) + ", " + Text::number(x[1]) + ", " +
             Text::number(x[2]) + ")";
    }

    /**
     * The force per area of the undeformed surface (force/length^2), that of
     * inertia and of mass damping included: d'Alembert's -rho h (a + c v). The
     * kinetic energy that moves along with the points has no part in G.
     */
    Vector3
    surface_load(const SolvedShell       &shell,
                 const CrackPoints       &points,
                 const unsigned int       q,
                 const SectionPoint      &x,
                 const VectorDerivatives &u)
    {
      const auto    &frame   = points.frame(q);
      const Loads   &loads   = shell.model.loads;
      const auto    &section = *shell.model.section;
      const Instant &instant = shell.actions.loads;
      const double   mass    = section.density(x) * section.thickness(x);
      Vector3        load = loads.force_per_area(x, frame.t0, mass, instant) -
                     mass * points.acceleration(q);
      if (loads.pressure_follows())
        load += loads.pressure(x, instant) / frame.j0 *
                cross_product_3d(frame.a_cov[0] + u.first[0],
                                 frame.a_cov[1] + u.first[1]);
      return load;
    }
  } // namespace

  EnergyRelease::EnergyRelease(const SolvedShell  &shell,
                               const CrackTip     &tip,
                               const CrackPlateau &plateau,
                               const std::string  &where)
    : shell_(shell)
    , tip_(tip)
    , plateau_(plateau)
    , is_linear_(shell.model.kinematics.model == KinematicsModel::linear)
    , where_(where + ": within " + Text::number(plateau.outer) +
             " of the tip at " + coordinates_of(tip.position) + " ")
  {
    Assert(0. < plateau.inner && plateau.inner < plateau.outer,
           ExcMessage("Radii of a plateau"));
    check_model();
    check_cuts();
    run_on_all_ranks(shell.discretization.communicator(),
                     [&]() { check_inside(); });
    check_lips();
    rotation_ = mean_rotation();
  }

  void
  EnergyRelease::check_law(const SectionLaw &section, const std::string &where)
  {
    AssertThrow(section.n_state_variables() == 0,
                ExcMessage(where + " the section's energy depends on its path "
                                   "and has no release rate."));
  }

  void
  EnergyRelease::check_model() const
  {
    AssertThrow(shell_.modes == nullptr,
                ExcMessage(where_ + "energy release rates and stress "
                                    "intensity factors are those of statics "
                                    "and of motions; modes have no size."));
    check_law(*shell_.model.section, where_);
    AssertThrow(shell_.model.foundation.is_zero(),
                ExcMessage(where_ + "lies a foundation, whose energy these "
                                    "quantities don't know."));
    const auto check = [&](const Point<3> &point, const std::string &what) {
      AssertThrow(point.distance(tip_.position) > plateau_.outer,
                  ExcMessage(where_ + "lies " + what + " at " +
                             coordinates_of(point) +
                             "; choose smaller radii."));
    };
    for (const auto &force : shell_.model.loads.point_forces())
      check(force.position, "a point force");
    for (const auto &support : shell_.model.supports.points())
      check(support.position, "a support");
  }

  void
  EnergyRelease::check_cuts() const
  {
    // The two ends of a cut may lie in one cell, and open nothing.
    for (const auto &tip : shell_.discretization.tips())
      {
        const double distance = tip.position.distance(tip_.position);
        AssertThrow(distance > plateau_.outer ||
                      tip.position.distance(tip_.position +
                                            tip_.closed * tip_.axes[0]) <
                        0.1 * tip_.cell_size,
                    ExcMessage(where_ + "lies another tip, of the cut '" +
                               shell_.model.cuts.curves[tip.cut].name +
                               "', at " + coordinates_of(tip.position) +
                               "; choose smaller radii, and cells that suit "
                               "them."));
      }
  }

  void
  EnergyRelease::for_each_part(
    const std::function<void(const CellPart &)> &function) const
  {
    for (const CellPart &part : shell_.discretization.owned_parts())
      {
        const auto nodes   = shell_.discretization.geometry_nodes(part);
        double     nearest = nodes[0].distance(tip_.position);
        double     extent  = nodes[0].distance(nodes[nodes.size() - 1]);
        for (const auto &x : nodes)
          {
            nearest = std::min(nearest, x.distance(tip_.position));
            extent  = std::max(extent, x.distance(nodes[0]));
          }
        if (nearest < plateau_.outer + extent)
          function(part);
      }
  }

  void
  EnergyRelease::for_each_points(
    const std::function<void(const CrackPoints &, const CellPart &)> &function)
    const
  {
    CrackPoints points(shell_, ring_quadrature(shell_.discretization));
    for_each_part([&](const CellPart &part) {
      if (!part.is_cut() && part.enrichment() == nullptr)
        {
          points.reinit(part);
          return function(points, part);
        }
      CrackPoints of_part(shell_, ring_quadrature(shell_.discretization, part));
      of_part.reinit(part);
      function(of_part, part);
    });
  }

  void
  EnergyRelease::for_each_edge(
    const std::function<void(const ShellEdgeValues &)> &function) const
  {
    ShellEdgeValues edge(shell_.discretization);
    for_each_part([&](const CellPart &part) {
      if (part.data != nullptr && part.data->number != 0)
        return; // all pieces of the cell's edges at once
      const auto &cell = part.cell;
      for (const unsigned int face : cell->face_indices())
        {
          if (cell->at_boundary(face) ||
              (!cell->neighbor_is_coarser(face) &&
               cell->neighbor(face)->id() < cell->id()))
            continue;
          edge.for_pieces_to_neighbor(cell, face, function);
        }
    });
  }

  void
  EnergyRelease::check_inside() const
  {
    const auto &tip_region = tip_.position.region();
    for_each_edge([&](const ShellEdgeValues &edge) {
      for (unsigned int q = 0; q < edge.n_points(); ++q)
        {
          const Point<3> x = edge.point(q);
          if (x.distance(tip_.position) > plateau_.outer)
            continue;
          const double cosine =
            edge.sigma(1, q) * (edge.frame(0, q).t0 * edge.frame(1, q).t0);
          AssertThrow(cosine > crack_crease,
                      ExcMessage(where_ + "lies a crease, at " +
                                 coordinates_of(x) +
                                 "; choose smaller radii."));
          AssertThrow(edge.point(q, 0).region() == tip_region &&
                        edge.point(q, 1).region() == tip_region,
                      ExcMessage(where_ + "lies another region, at " +
                                 coordinates_of(x) +
                                 "; choose smaller radii."));
          AssertThrow(edge.frame(0, q).t0 * tip_.axes[2] > crack_bend,
                      ExcMessage(where_ +
                                 "the surface turns by more than "
                                 "60 degrees, at " +
                                 coordinates_of(x) +
                                 "; choose smaller radii."));
        }
    });
  }

  void
  EnergyRelease::for_each_lip_point(
    const std::function<void(const LipPoint &)> &function) const
  {
    const QGauss<1> rule(n_points(shell_.discretization));
    for_each_part([&](const CellPart &part) {
      for (const FreeSide &side :
           free_sides(shell_.discretization.cell_parts(), part))
        {
          const auto             &d = side.along;
          std::vector<Point<dim>> on_side;
          for (const auto &x : rule.get_points())
            on_side.push_back(side.begin + x[0] * d);
          CrackPoints points(shell_,
                             Quadrature<dim>(on_side, rule.get_weights()),
                             side.edge ? Tensor<1, dim>() : d);
          points.reinit(part);
          const auto &loads = shell_.model.loads;
          const auto  load =
            side.edge ? loads.on_edge(*side.edge) : loads.on_lip(side.cut);
          for (unsigned int q = 0; q < rule.size(); ++q)
            {
              const auto surface = points.surface(q);
              if (surface.position.distance(tip_.position) >= plateau_.outer)
                continue;
              const CrackExtension extension(tip_, plateau_, surface);
              const auto          &x  = surface.derivatives;
              const Vector3 tangent   = d[0] * x.first[0] + d[1] * x.first[1];
              const Vector3 curvature = d[0] * d[0] * x.second[0] +
                                        d[1] * d[1] * x.second[1] +
                                        2. * d[0] * d[1] * x.second[2];
              const double  length = tangent.norm();
              const Vector3 outward =
                side.part_is_left *
                cross_product_3d(tangent / length, points.frame(q).t0);
              const double along  = extension.q * d / (d * d);
              const double slope  = d * (extension.gradient * d) / (d * d);
              const double weight = points.weight(q);
              function(
                {points,
                 q,
                 side.edge,
                 load,
                 d / length,
                 side.part_is_left,
                 length * weight,
                 (slope * length + along * (tangent * curvature) / length) *
                   weight,
                 outward * carried(x, extension),
                 -(outward * tip_.axes[1])});
            }
        }
    });
  }

  void
  EnergyRelease::check_lips() const
  {
    const auto &supports = shell_.model.supports.edges();
    double      length   = 0.;
    run_on_all_ranks(shell_.discretization.communicator(), [&]() {
      for_each_lip_point([&](const LipPoint &lip) {
        const Point<3>     x = lip.points.surface(lip.q).position;
        const Tensor<1, 3> d = x - tip_.position;
        const auto at = ", at " + coordinates_of(x) + "; choose smaller radii.";
        AssertThrow(d * tip_.axes[0] < tip_.closed &&
                      std::abs(d * tip_.axes[1]) < straight * plateau_.outer &&
                      std::abs(lip.across) < crooked,
                    ExcMessage(where_ +
                               "lies another edge of the shell or another "
                               "cut, or the crack turns" +
                               at));
        length += lip.divergence;
        AssertThrow(is_linear_ || lip.load.moment == nullptr ||
                      lip.load.moment->is_zero(),
                    ExcMessage(where_ +
                               "a moment acts on a lip of the crack, which "
                               "these quantities know in linear kinematics "
                               "only" +
                               at));
        if (!lip.edge)
          return;
        const auto support = supports.find(*lip.edge);
        AssertThrow(
          support == supports.end() || (support->second.displacements.empty() &&
                                        !support->second.rotation),
          ExcMessage(where_ + "a lip of the crack is supported" + at));
      });
    });
    // Both lips begin where nothing moves and end at the tip, which moves by 1.
    length = Utilities::MPI::sum(length, shell_.discretization.communicator());
    AssertThrow(std::abs(length - 2.) < crooked,
                ExcMessage(where_ + "the crack has its other end, or its lips "
                                    "are far from straight; choose smaller "
                                    "radii."));
  }

  void
  EnergyRelease::add_part(const CrackPoints                &points,
                          const CellPart                   &part,
                          const std::vector<WilliamsField> &fields,
                          std::vector<double>              &sums) const
  {
    const double width = plateau_.outer - plateau_.inner;
    const double side  = side_of_crack(shell_.discretization, tip_, part);
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const auto surface = points.surface(q);
        if (surface.position.distance(tip_.position) >= plateau_.outer)
          continue;
        const auto          &frame = points.frame(q);
        const CrackExtension extension(tip_, plateau_, surface);
        const auto           u      = points.derivatives(q);
        const auto           tying  = points.tying(q);
        const double         weight = points.weight(q);
        const auto load = surface_load(shell_, points, q, surface.position, u);
        sums[0] -= weight * (energy_change(shell_.section(),
                                           is_linear_,
                                           surface,
                                           extension,
                                           u,
                                           tying,
                                           width) +
                             load * carried(u, extension) * frame.j0);
        if (fields.empty())
          continue;
        const auto         w  = turned_back(rotation_, surface, u);
        const auto         n  = is_linear_ ?
                                  Voigt<>() :
                                  MovedPoint(surface, extension, 0.)
                           .response(shell_.section(), is_linear_, w, tying)
                           .membrane_force;
        const PointAtCrack at = {*shell_.model.section,
                                 tip_,
                                 surface,
                                 frame,
                                 extension};
        for (unsigned int i = 0; i < fields.size(); ++i)
          {
            const auto X = williams_derivatives(fields[i], tip_, side, surface);
            double     held = held_work(at, X, w);
            if (!is_linear_)
              held += bent_work(at, X, w, n);
            sums[i + 1] -=
              weight *
              (interaction_change(shell_.section(),
                                  is_linear_,
                                  surface,
                                  extension,
                                  w,
                                  tying,
                                  X,
                                  width) +
               (load * (rotation_ * carried(X, extension)) + held) * frame.j0);
          }
      }
  }

  void
  EnergyRelease::add_edge(const ShellEdgeValues            &edge,
                          const std::vector<WilliamsField> &fields,
                          std::vector<double>              &sums) const
  {
    const auto is_inside = [&](const unsigned int q) {
      return edge.point(q).distance(tip_.position) < plateau_.outer;
    };
    bool any = false;
    for (unsigned int q = 0; q < edge.n_points(); ++q)
      any |= is_inside(q);
    if (!any)
      return;
    std::array<CrackPoints, 2> points = {
      {CrackPoints(shell_, Quadrature<dim>(edge.unit_points(0))),
       CrackPoints(shell_, Quadrature<dim>(edge.unit_points(1)))}};
    std::array<double, 2> side_of_lip;
    for (unsigned int s = 0; s < 2; ++s)
      {
        points[s].reinit(edge.part(s));
        side_of_lip[s] =
          side_of_crack(shell_.discretization, tip_, edge.part(s));
      }
    const double penalty =
      shell_.assembly.penalty().interior(edge.part(0), edge.part(1));
    const double width = plateau_.outer - plateau_.inner;
    for (unsigned int q = 0; q < edge.n_points(); ++q)
      {
        if (!is_inside(q))
          continue;
        std::array<CrackEdgeSide, 2> sides = {
          {CrackEdgeSide(tip_, plateau_, edge, 0, q, points[0]),
           CrackEdgeSide(tip_, plateau_, edge, 1, q, points[1])}};
        sums[0] -= edge.JxW(q) * edge_energy_change(shell_.section(),
                                                    is_linear_,
                                                    sides,
                                                    penalty,
                                                    width);
        for (CrackEdgeSide &side : sides)
          side.u = turned_back(rotation_, side.surface, side.u);
        for (unsigned int i = 0; i < fields.size(); ++i)
          {
            std::array<VectorDerivatives, 2> X;
            for (unsigned int s = 0; s < 2; ++s)
              X[s] = williams_derivatives(fields[i],
                                          tip_,
                                          side_of_lip[s],
                                          sides[s].surface);
            sums[i + 1] -=
              edge.JxW(q) * edge_interaction_change(shell_.section(),
                                                    is_linear_,
                                                    sides,
                                                    X,
                                                    penalty,
                                                    width);
          }
      }
  }

  void
  EnergyRelease::add_lips(const std::vector<WilliamsField> &fields,
                          std::vector<double>              &sums) const
  {
    const double width = plateau_.outer - plateau_.inner;
    for_each_lip_point([&](const LipPoint &lip) {
      if (lip.load.is_zero())
        return;
      CrackEdgeSide side(tip_,
                         plateau_,
                         lip.points,
                         lip.q,
                         lip.tangent,
                         lip.outward);
      const auto    change = [&](const Vector3 &u) {
        return lip.length *
               lip_work_change(lip.load, shell_.actions.loads, side, u, width);
      };
      sums[0] += change(lip.points.displacement(lip.q));
      for (unsigned int i = 0; i < fields.size(); ++i)
        {
          const auto &X = fields[i];
          side.u        = williams_derivatives(X, tip_, lip.side, side.surface);
          sums[i + 1] +=
            change(rotation_ *
                   williams_value(X, tip_, lip.side, side.surface.position));
        }
    });
  }

  Tensor<2, 3>
  EnergyRelease::mean_rotation() const
  {
    Tensor<2, 3> F(unit_symmetric_tensor<3>());
    if (is_linear_)
      return F;
    F = 0.;
    run_on_all_ranks(shell_.discretization.communicator(), [&]() {
      for_each_points([&](const CrackPoints &points, const CellPart &) {
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            const auto surface = points.surface(q);
            if (surface.position.distance(tip_.position) >= plateau_.outer)
              continue;
            F += points.weight(q) * points.frame(q).j0 *
                 deformation_gradient(points.frame(q), points.derivatives(q));
          }
      });
    });
    return project_onto_orthogonal_tensors(
      Utilities::MPI::sum(F, shell_.discretization.communicator()));
  }

  std::vector<double>
  EnergyRelease::release(const std::vector<WilliamsField> &fields) const
  {
    const auto         &discretization = shell_.discretization;
    std::vector<double> sums(fields.size() + 1, 0.);
    run_on_all_ranks(discretization.communicator(), [&]() {
      for_each_points([&](const CrackPoints &points, const CellPart &part) {
        add_part(points, part, fields, sums);
      });
      for_each_edge(
        [&](const ShellEdgeValues &edge) { add_edge(edge, fields, sums); });
      add_lips(fields, sums);
    });
    Utilities::MPI::sum(sums, discretization.communicator(), sums);
    AssertThrow(std::isfinite(sums[0]),
                ExcMessage(where_ + "a layer is pressed to nothing and has no "
                                    "finite energy; take finer cells."));
    return sums;
  }

  double
  EnergyRelease::rate() const
  {
    return release({})[0];
  }

  double
  EnergyRelease::intensity(const CrackMode mode) const
  {
    const auto plate = plate_or_throw();
    return release({unit_williams_field(mode, plate)})[1] /
           (2. * unit_release_rate(mode, plate));
  }

  EnergyRelease::All
  EnergyRelease::rate_and_intensities(const ElasticPlate &plate) const
  {
    const std::array<CrackMode, 4> modes = {{CrackMode::opening,
                                             CrackMode::sliding,
                                             CrackMode::bending,
                                             CrackMode::twisting}};
    std::vector<WilliamsField>     fields;
    for (const CrackMode mode : modes)
      fields.push_back(unit_williams_field(mode, plate));
    const auto sums = release(fields);
    All        all{sums[0], {}};
    for (unsigned int i = 0; i < modes.size(); ++i)
      all.intensities[i] =
        sums[i + 1] / (2. * unit_release_rate(modes[i], plate));
    return all;
  }

  std::optional<ElasticPlate>
  EnergyRelease::plate() const
  {
    return elastic_plate(*shell_.model.section,
                         tip_.position,
                         tip_.axes[0],
                         tip_.axes[1]);
  }

  ElasticPlate
  EnergyRelease::plate_or_throw() const
  {
    const auto plate = this->plate();
    AssertThrow(plate.has_value(),
                ExcMessage(where_ + "the section isn't linear, homogeneous and "
                                    "isotropic, as stress intensity factors "
                                    "take it; the energy release rate is "
                                    "known for all elastic sections."));
    return *plate;
  }
} // namespace Nacre
