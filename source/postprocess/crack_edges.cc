// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/shell_strain.h>
#include <nacre/postprocess/crack_edges.h>

#include <cmath>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, spacedim>;

    /** x,a d^a. */
    Vector3
    along_edge(const std::array<Vector3, 2> &x, const Tensor<1, dim> &d)
    {
      return d[0] * x[0] + d[1] * x[1];
    }

    /** The line of an edge's side at the advance s of the tip. */
    struct MovedLine
    {
      MovedLine(const CrackEdgeSide &side, const double s)
        : at(side.surface, side.extension, s)
        , d(side.tangent + s * side.extension.gradient * side.tangent)
        , tangent(along_edge(at.frame.a_cov, d))
        , conormal((side.outward / tangent.norm()) *
                   cross_product_3d(tangent, at.frame.t0))
      {}

      /** theta of (N.11), sigma left out, of a displacement there. */
      double
      rotation(const VectorDerivatives &u) const
      {
        return at.frame.t0 * ((at.frame.a_con[0] * conormal) * u.first[0] +
                              (at.frame.a_con[1] * conormal) * u.first[1]);
      }

      MovedPoint at;
      /** In the reference cell. */
      Tensor<1, dim> d;
      /** d (1) of the moved surface; of unit length at s = 0. */
      Vector3 tangent;
      /** nu. */
      Vector3 conormal;
    };

    /** A side of an edge at the advance s of the tip. */
    struct MovedEdgeSide
    {
      MovedEdgeSide(const SectionAt         &section,
                    const bool               is_linear,
                    const CrackEdgeSide     &side,
                    const VectorDerivatives &X,
                    const double             s);

      /** d (1) of the moved surface; of unit length at s = 0. */
      Vector3 tangent;
      /** sigma t0. */
      Vector3 normal;
      /** sigma t and the tangent of the deformed surface. */
      Vector3 deformed_normal;
      Vector3 deformed_tangent;
      /** theta of (N.11), in linear kinematics, and of X. */
      double rotation, X_rotation;
      /** lambda m_nn (force), and that of X's linear strains. */
      double moment, X_moment;
      /** D(nu, nu, nu, nu) (force times length). */
      double stiffness;
    };

    MovedEdgeSide::MovedEdgeSide(const SectionAt         &section,
                                 const bool               is_linear,
                                 const CrackEdgeSide     &side,
                                 const VectorDerivatives &X,
                                 const double             s)
    {
      const MovedLine line(side, s);
      const auto     &at    = line.at;
      const auto     &frame = at.frame;
      const auto     &d     = line.d;
      const auto      u     = moved(side.u, side.extension, s);
      const auto      X_s   = moved(X, side.extension, s);
      tangent               = line.tangent;
      normal                = side.sigma * frame.t0;
      rotation              = side.sigma * line.rotation(u);
      X_rotation            = side.sigma * line.rotation(X_s);
      const auto dyad       = ShellStrain::dyad_of(frame, line.conormal);
      const auto response   = at.response(section, is_linear, u, side.tying);
      const auto D_dyad     = response.tangent.bending * dyad;
      moment                = side.sigma * (dyad * response.moment);
      X_moment              = side.sigma *
                 (D_dyad * ShellStrain::bending(frame, X_s.first, X_s.second));
      stiffness =
        dyad * (section.law.stiffness(frame, at.point).bending * dyad);
      if (is_linear)
        return;
      const std::array<Vector3, 2> phi = {
        {frame.a_cov[0] + u.first[0], frame.a_cov[1] + u.first[1]}};
      const Vector3 area = cross_product_3d(phi[0], phi[1]);
      deformed_tangent   = along_edge(phi, d);
      deformed_normal    = side.sigma / area.norm() * area;
      const double lambda =
        area.norm() / frame.j0 * tangent.norm() / deformed_tangent.norm();
      moment *= lambda;
      X_moment *= lambda;
    }

    /** From @p a to @p b about the axis @p d, in (-pi, pi] (rad). */
    double
    angle_about(const Vector3 &d, const Vector3 &a, const Vector3 &b)
    {
      return std::atan2(cross_product_3d(a, b) * d / d.norm(), a * b);
    }
  } // namespace

  CrackEdgeSide::CrackEdgeSide(const CrackTip        &tip,
                               const CrackPlateau    &plateau,
                               const ShellEdgeValues &edge,
                               const unsigned int     side,
                               const unsigned int     q,
                               const CrackPoints     &points)
    : surface(points.surface(q))
    , extension(tip, plateau, surface)
    , u(points.derivatives(q))
    , tying(points.tying(q))
    , sigma(edge.sigma(side, q))
  {
    const Vector3 d =
      cross_product_3d(edge.conormal(0, q), edge.frame(0, q).t0);
    const auto &frame = edge.frame(side, q);
    for (unsigned int a = 0; a < dim; ++a)
      tangent[a] = frame.a_con[a] * d;
    outward =
      cross_product_3d(d, frame.t0) * edge.conormal(side, q) > 0. ? 1. : -1.;
  }

  CrackEdgeSide::CrackEdgeSide(const CrackTip       &tip,
                               const CrackPlateau   &plateau,
                               const CrackPoints    &points,
                               const unsigned int    q,
                               const Tensor<1, dim> &tangent,
                               const double          outward)
    : surface(points.surface(q))
    , extension(tip, plateau, surface)
    , u(points.derivatives(q))
    , tying(points.tying(q))
    , tangent(tangent)
    , outward(outward)
    , sigma(1.)
  {}

  namespace
  {
    /** An edge at the advance s of the tip. */
    struct MovedEdge
    {
      MovedEdge(const SectionAt                        &section,
                const bool                              is_linear,
                const std::array<CrackEdgeSide, 2>     &sides,
                const std::array<VectorDerivatives, 2> &X,
                const double                            s)
      {
        const MovedEdgeSide minus(section, is_linear, sides[0], X[0], s);
        const MovedEdgeSide plus(section, is_linear, sides[1], X[1], s);
        jump      = is_linear ?
                      plus.rotation - minus.rotation :
                      angle_about(minus.deformed_tangent,
                             minus.deformed_normal,
                             plus.deformed_normal) -
                   angle_about(minus.tangent, minus.normal, plus.normal);
        X_jump    = plus.X_rotation - minus.X_rotation;
        stiffness = 0.5 * (minus.stiffness + plus.stiffness);
        moment    = 0.5 * (minus.moment + plus.moment);
        X_moment  = 0.5 * (minus.X_moment + plus.X_moment);
        length    = minus.tangent.norm();
      }

      double jump, X_jump, stiffness, moment, X_moment, length;
    };
  } // namespace

  double
  edge_energy_change(const SectionAt                    &section,
                     const bool                          is_linear,
                     const std::array<CrackEdgeSide, 2> &sides,
                     const double                        penalty,
                     const double                        length)
  {
    const auto energy = [&](const double s) {
      const MovedEdge at(section, is_linear, sides, {}, s);
      return (0.5 * penalty * at.stiffness * at.jump - at.moment) * at.jump *
             at.length;
    };
    return change_with_advance(energy, length);
  }

  double
  edge_interaction_change(const SectionAt                        &section,
                          const bool                              is_linear,
                          const std::array<CrackEdgeSide, 2>     &sides,
                          const std::array<VectorDerivatives, 2> &X,
                          const double                            penalty,
                          const double                            length)
  {
    const auto work = [&](const double s) {
      const MovedEdge at(section, is_linear, sides, X, s);
      return ((penalty * at.stiffness * at.jump - at.moment) * at.X_jump -
              at.X_moment * at.jump) *
             at.length;
    };
    return change_with_advance(work, length);
  }

  double
  lip_work_change(const LineLoad            &load,
                  const Instant             &instant,
                  const CrackEdgeSide       &side,
                  const Tensor<1, spacedim> &u,
                  const double               length)
  {
    const auto work = [&](const double s) {
      const MovedLine line(side, s);
      const Point<3> &x = line.at.point;
      return (load.force_at(x, line.conormal, instant) * u -
              load.moment_at(x, instant) *
                line.rotation(moved(side.u, side.extension, s))) *
             line.tangent.norm();
    };
    return change_with_advance(work, length);
  }
} // namespace Nacre
