// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/text.h>
#include <nacre/forms/shell_actions.h>
#include <nacre/mechanics/shell_strain.h>
#include <nacre/postprocess/crack_points.h>
#include <nacre/postprocess/energy_release.h>

#include <deal.II/base/qprojector.h>
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
    /** Cosine of the angle of two normals from which an edge is a crease. */
    constexpr double crack_crease = 0.94;
    /** The same of a normal to that at the tip. */
    constexpr double crack_bend = 0.5;

    /** q isn't polynomial: more points than for the stiffness. */
    unsigned int
    n_points(const Discretization &discretization)
    {
      return discretization.degree() + 5;
    }

    Quadrature<dim>
    ring_quadrature(const Discretization &discretization)
    {
      const unsigned int n = n_points(discretization);
      if (discretization.element().type == ElementType::triangle)
        return QDuffy(n, 1.);
      return QGauss<dim>(n);
    }

    std::string
    coordinates_of(const Point<3> &x)
    {
      return "(" + Text::number(x[0]) + ", " + Text::number(x[1]) + ", " +
             Text::number(x[2]) + ")";
    }

    /** Positive for cells on the side of e_2. */
    double
    side_of(const CrackTip &tip, const ArrayView<const Point<spacedim>> &nodes)
    {
      double side = 0.;
      for (const auto &x : nodes)
        side += (x - tip.position) * tip.axes[1];
      return side;
    }

    VectorDerivatives &
    add(VectorDerivatives &u, const double factor, const VectorDerivatives &v)
    {
      for (unsigned int a = 0; a < 2; ++a)
        u.first[a] += factor * v.first[a];
      for (unsigned int k = 0; k < 3; ++k)
        u.second[k] += factor * v.second[k];
      return u;
    }

    /**
     * A field @p X in equilibrium in the tangent plane of the tip needs loads
     * on a curved surface, which do work as u moves with the tip. Per area
     * (force/length), those at the lips included, it is what the virtual work
     * of X's membrane forces on v = u,g q^g differs by from that in the plane:
     *
     *   eps(X) : A : eps(v) - eps(P X) : A : eps(P v),  P = 1 - e_3 e_3.
     *
     * The loads that its moments need are smaller by (h/r)^2.
     */
    double
    held_work(const SectionLaw        &section,
              const CrackTip          &tip,
              const SurfacePatch      &surface,
              const SurfaceFrame<>    &frame,
              const VectorDerivatives &X,
              const VectorDerivatives &u,
              const CrackExtension    &extension)
    {
      const auto            &q  = extension.q;
      const auto            &dq = extension.gradient;
      std::array<Vector3, 2> v; // v,1 and v,2
      for (unsigned int a = 0; a < 2; ++a)
        v[a] = q[a] * u.second[a] + q[1 - a] * u.second[2] +
               dq[0][a] * u.first[0] + dq[1][a] * u.first[1];
      const auto in_plane = [&](const std::array<Vector3, 2> &d) {
        const auto &e_3 = tip.axes[2];
        return ShellStrain::membrane(frame,
                                     d[0] - (d[0] * e_3) * e_3,
                                     d[1] - (d[1] * e_3) * e_3);
      };
      const auto A = section.stiffness(frame, surface.position).membrane;
      return A * ShellStrain::membrane(frame, X.first[0], X.first[1]) *
               ShellStrain::membrane(frame, v[0], v[1]) -
             A * in_plane(X.first) * in_plane(v);
    }

    /** The force per area of the undeformed surface (force/length^2). */
    Vector3
    surface_load(const SolvedShell       &shell,
                 const SectionPoint      &x,
                 const SurfaceFrame<>    &frame,
                 const VectorDerivatives &u)
    {
      const Loads   &loads   = shell.model.loads;
      const auto    &section = shell.model.section;
      const Instant &instant = shell.actions.loads;
      Vector3        load =
        loads.force_per_area(x,
                             frame.t0,
                             section.density(x) * section.thickness(x),
                             instant);
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
    , where_(where + ": within " + Text::number(plateau.outer) +
             " of the tip at " + coordinates_of(tip.position) + " ")
  {
    Assert(0. < plateau.inner && plateau.inner < plateau.outer,
           ExcMessage("Radii of a plateau"));
    check_model();
    run_on_all_ranks(shell.discretization.communicator(),
                     [&]() { check_inside(); });
    check_lips();
  }

  void
  EnergyRelease::check_model() const
  {
    AssertThrow(shell_.mass == nullptr && shell_.modes == nullptr,
                ExcMessage(where_ + "energy release rates and stress "
                                    "intensity factors are those of statics: "
                                    "forces of inertia are left out, and "
                                    "modes have no size."));
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
  EnergyRelease::for_each_cell(
    const std::function<void(const cell_iterator &)> &function) const
  {
    for (const auto &cell :
         shell_.discretization.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto   nodes   = shell_.discretization.geometry_nodes(cell);
          const double size    = nodes[0].distance(nodes[nodes.size() - 1]);
          double       nearest = nodes[0].distance(tip_.position);
          double       extent  = size;
          for (const auto &x : nodes)
            {
              nearest = std::min(nearest, x.distance(tip_.position));
              extent  = std::max(extent, x.distance(nodes[0]));
            }
          if (nearest >= plateau_.outer + extent)
            continue;
          AssertThrow(!shell_.discretization.cell_parts().is_touched(cell),
                      ExcMessage(where_ +
                                 "lies a cut of Cuts/Cuts; tips of slits of "
                                 "the mesh are meant here."));
          function(cell);
        }
  }

  void
  EnergyRelease::check_inside() const
  {
    const auto     &tip_region = tip_.position.region();
    ShellEdgeValues edge(shell_.discretization);
    for_each_cell([&](const cell_iterator &cell) {
      for (const unsigned int face : cell->face_indices())
        edge.for_pieces_to_neighbor(cell, face, [&](const auto &edge) {
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
    });
  }

  void
  EnergyRelease::for_each_lip_point(
    const std::function<void(const LipPoint &)> &function) const
  {
    const auto     &discretization = shell_.discretization;
    const auto      reference      = discretization.element().reference_cell();
    const QGauss<1> rule(n_points(discretization));
    std::vector<CrackPoints> points; // by face
    for (const unsigned int face : reference.face_indices())
      {
        std::vector<Point<dim>> on_face(rule.size());
        QProjector<dim>::project_to_face(reference, rule, face, on_face);
        points.emplace_back(shell_,
                            Quadrature<dim>(on_face, rule.get_weights()));
      }

    for_each_cell([&](const cell_iterator &cell) {
      for (const unsigned int face : cell->face_indices())
        {
          if (!cell->at_boundary(face))
            continue;
          const auto d = reference.template vertex<dim>(
                           reference.face_to_cell_vertices(face, 1, 1)) -
                         reference.template vertex<dim>(
                           reference.face_to_cell_vertices(face, 0, 1));
          points[face].reinit(cell);
          for (unsigned int q = 0; q < rule.size(); ++q)
            {
              const auto surface = points[face].surface(q);
              if (surface.position.distance(tip_.position) >= plateau_.outer)
                continue;
              const CrackExtension extension(tip_, plateau_, surface);
              const auto          &x  = surface.derivatives;
              const Vector3 tangent   = d[0] * x.first[0] + d[1] * x.first[1];
              const Vector3 curvature = d[0] * d[0] * x.second[0] +
                                        d[1] * d[1] * x.second[1] +
                                        2. * d[0] * d[1] * x.second[2];
              const double  length   = tangent.norm();
              const Vector3 velocity = carried(x, extension);
              const double  along    = extension.q * d / (d * d);
              const double  slope    = d * (extension.gradient * d) / (d * d);
              const double  weight   = points[face].weight(q);
              function(
                {points[face],
                 q,
                 cell,
                 face,
                 tangent,
                 along,
                 (slope * length + along * (tangent * curvature) / length) *
                   weight,
                 weight,
                 cross_product_3d(tangent / length,
                                  points[face].strains().values().frame(q).t0) *
                   velocity});
            }
        }
    });
  }

  void
  EnergyRelease::check_lips() const
  {
    const auto &supports = shell_.model.supports.edges();
    const auto &moments  = shell_.model.loads.edge_moments();
    double      length   = 0.;
    run_on_all_ranks(shell_.discretization.communicator(), [&]() {
      for_each_lip_point([&](const LipPoint &lip) {
        const Point<3>     x = lip.points.surface(lip.q).position;
        const Tensor<1, 3> d = x - tip_.position;
        const auto at = ", at " + coordinates_of(x) + "; choose smaller radii.";
        AssertThrow(d * tip_.axes[0] < 0. &&
                      std::abs(d * tip_.axes[1]) < straight * plateau_.outer &&
                      std::abs(lip.across) < straight,
                    ExcMessage(where_ +
                               "lies another edge of the shell, or "
                               "the crack turns" +
                               at));
        const auto id      = lip.cell->face(lip.face)->boundary_id();
        const auto support = supports.find(id);
        AssertThrow(
          support == supports.end() || (support->second.displacements.empty() &&
                                        !support->second.rotation),
          ExcMessage(where_ + "a lip of the crack is supported" + at));
        const auto moment = moments.find(id);
        AssertThrow(moment == moments.end() || moment->second.is_zero(),
                    ExcMessage(where_ +
                               "a moment acts on a lip of the "
                               "crack, which these quantities don't "
                               "know" +
                               at));
        length += lip.divergence;
      });
    });
    // Both lips begin where nothing moves and end at the tip, which moves by 1.
    length = Utilities::MPI::sum(length, shell_.discretization.communicator());
    AssertThrow(std::abs(length - 2.) < straight,
                ExcMessage(where_ + "the crack has its other end, or its lips "
                                    "are far from straight; choose smaller "
                                    "radii."));
  }

  double
  EnergyRelease::release_of_cell(CrackPoints         &points,
                                 const cell_iterator &cell,
                                 const WilliamsField *field,
                                 const double         factor) const
  {
    const bool is_linear =
      shell_.model.kinematics.model == KinematicsModel::linear;
    const double side =
      side_of(tip_, shell_.discretization.geometry_nodes(cell));
    points.reinit(cell);
    double sum = 0.;
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const auto surface = points.surface(q);
        if (surface.position.distance(tip_.position) >= plateau_.outer)
          continue;
        const auto          &frame = points.strains().values().frame(q);
        const CrackExtension extension(tip_, plateau_, surface);
        auto                 u = points.displacement(q);
        const Voigt<>        tying =
          points.strains().membrane(q) - membrane_strain(frame, u, is_linear);
        const auto load = surface_load(shell_, surface.position, frame, u);
        if (field != nullptr)
          {
            const auto X = williams_derivatives(*field, tip_, side, surface);
            sum -= points.weight(q) * factor * frame.j0 *
                   held_work(shell_.model.section,
                             tip_,
                             surface,
                             frame,
                             X,
                             u,
                             extension);
            add(u, factor, X);
          }
        sum -=
          points.weight(q) * (energy_change(shell_.section(),
                                            is_linear,
                                            surface,
                                            extension,
                                            u,
                                            tying,
                                            plateau_.outer - plateau_.inner) +
                              load * carried(u, extension) * frame.j0);
      }
    return sum;
  }

  double
  EnergyRelease::release(const WilliamsField *field, const double factor) const
  {
    const auto    &discretization = shell_.discretization;
    const auto    &forces         = shell_.model.loads.edge_forces();
    const Instant &instant        = shell_.actions.loads;
    CrackPoints    points(shell_, ring_quadrature(discretization));
    double         sum = 0.;
    run_on_all_ranks(discretization.communicator(), [&]() {
      for_each_cell([&](const cell_iterator &cell) {
        sum += release_of_cell(points, cell, field, factor);
      });
      for_each_lip_point([&](const LipPoint &lip) {
        const auto force = forces.find(lip.cell->face(lip.face)->boundary_id());
        if (force == forces.end())
          return;
        const SectionPoint x = lip.points.surface(lip.q).position;
        Vector3            u = lip.points.strains().displacement(lip.q);
        if (field != nullptr)
          u += factor *
               williams_value(*field,
                              tip_,
                              side_of(tip_,
                                      discretization.geometry_nodes(lip.cell)),
                              x);
        // Along the lip's tangent; a difference of second order
        const double step =
          1e-4 * (plateau_.outer - plateau_.inner) / lip.tangent.norm();
        const Vector3 slope = (force->second(x + step * lip.tangent, instant) -
                               force->second(x - step * lip.tangent, instant)) /
                              (2. * step);
        sum += u * (force->second(x, instant) * lip.divergence +
                    slope * lip.velocity * lip.tangent.norm() * lip.weight);
      });
    });
    return Utilities::MPI::sum(sum, discretization.communicator());
  }

  double
  EnergyRelease::rate() const
  {
    return release(nullptr, 0.);
  }

  double
  EnergyRelease::intensity(const CrackMode mode) const
  {
    AssertThrow(shell_.model.kinematics.model == KinematicsModel::linear,
                ExcMessage(where_ + "stress intensity factors are those of "
                                    "'Kinematics = linear'; the energy "
                                    "release rate is known for all."));
    const auto plate = plate_at_tip();
    const auto field = unit_williams_field(mode, plate);
    return (release(&field, 1.) - release(&field, -1.)) /
           (4. * unit_release_rate(mode, plate));
  }

  ElasticPlate
  EnergyRelease::plate_at_tip() const
  {
    const auto &section = shell_.model.section;
    const auto  frame =
      make_surface_frame(tip_.axes[0], tip_.axes[1], std::array<Vector3, 3>());
    const auto   C = section.stiffness(frame, tip_.position);
    const double h = section.thickness(tip_.position);
    const double A = C.membrane[0][0], nu = C.membrane[0][1] / A;

    // What the stiffnesses of such a plate are, to some digits
    VoigtMatrix<> H;
    H[0][0] = H[1][1] = 1.;
    H[0][1] = H[1][0] = nu;
    H[2][2]           = 0.5 * (1. - nu);
    AssertThrow(section.is_linear() && (C.membrane - A * H).norm() < 1e-8 * A &&
                  (C.bending - A * h * h / 12. * H).norm() < 1e-8 * A * h * h &&
                  C.coupling.norm() < 1e-8 * A * h,
                ExcMessage(where_ + "the section isn't homogeneous and "
                                    "isotropic, as stress intensity factors "
                                    "take it; the energy release rate is "
                                    "known for all sections."));
    return {A * (1. - nu * nu) / h, nu, h};
  }
} // namespace Nacre
