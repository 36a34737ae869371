// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/finite_edge_step.h>

#include <cmath>
#include <tuple>

namespace Nacre
{
  namespace
  {
    using Vector3   = Tensor<1, spacedim>;
    using EdgePoint = FiniteEdgePoint<double>;

    /** e = dx/ds, mean of both ends. */
    Vector3
    mean_edge(const EdgePoint::Side &start, const EdgePoint::Side &end)
    {
      return StepDifferences::mean(start.length * start.tangent,
                                   end.length * end.tangent);
    }

    /** nu0^alpha of a side. */
    std::array<double, 2>
    conormal_components(const ShellEdgeValues &edge,
                        const unsigned int     s,
                        const unsigned int     q)
    {
      const auto &a_con = edge.frame(s, q).a_con;
      const auto &nu    = edge.conormal(s, q);
      return {{nu * a_con[0], nu * a_con[1]}};
    }
  } // namespace

  void
  FiniteEdgeStep::reinit(const ShellEdgeValues                   &edge,
                         const unsigned int                       q,
                         const EdgePoint                         &start,
                         const EdgePoint                         &end,
                         const std::array<PrescribedRotation, 2> &rotations)
  {
    rotation_work_ = 0.;
    for (unsigned int s = 0; s < start.n_sides(); ++s)
      {
        sides_[s]            = Side();
        sides_[s].moment_row = start.side(s).rows[2];
      }
    add_angle_forces(start, end, edge, q, rotations);
    for (unsigned int s = 0; s < start.n_sides(); ++s)
      {
        add_moment_forces(start, end, edge, q, s);
        set_basis_forces(start, end, edge, q, s);
      }
  }

  void
  FiniteEdgeStep::add_angle_forces(
    const EdgePoint                         &start,
    const EdgePoint                         &end,
    const ShellEdgeValues                   &edge,
    const unsigned int                       q,
    const std::array<PrescribedRotation, 2> &rotations)
  {
    // The forces are linear in theta and {lambda m_nn}: means.
    const double  force = 0.5 * (start.rotation_force() + end.rotation_force());
    const double  half  = 0.5 * (end.jump() - start.jump());
    const double  alpha = start.initial_angle() + start.jump() + half;
    const double  scale = half == 0. ? 1. : half / std::sin(half);
    const double  of_x  = -force * scale * std::sin(alpha);
    const double  of_y  = force * scale * std::cos(alpha);
    const Vector3 t =
      StepDifferences::mean(start.side(0).normal, end.side(0).normal);
    const Vector3 nu =
      StepDifferences::mean(start.side(0).conormal, end.side(0).conormal);
    const Vector3 t_plus =
      StepDifferences::mean(start.normal_plus(), end.normal_plus());

    sides_[0].normal_force   = of_x * t_plus;
    sides_[0].conormal_force = -of_y * t_plus;
    const Vector3 force_plus = of_x * t - of_y * nu;
    if (start.n_sides() == 2)
      sides_[1].normal_force = force_plus;
    else
      turn_as_prescribed(start, end, edge, q, rotations, force_plus);
  }

  void
  FiniteEdgeStep::turn_as_prescribed(
    const EdgePoint                         &start,
    const EdgePoint                         &end,
    const ShellEdgeValues                   &edge,
    const unsigned int                       q,
    const std::array<PrescribedRotation, 2> &rotations,
    const Vector                            &force_t)
  {
    std::array<Vector3, 2> p_b, p_t;
    for (unsigned int k = 0; k < 2; ++k)
      std::tie(p_b[k], p_t[k]) = prescribed_frame(edge.conormal(0, q),
                                                  edge.frame(0, q).t0,
                                                  rotations[k]);
    const Vector3 p_b_m = StepDifferences::mean(p_b[0], p_b[1]);
    const Vector3 p_t_m = StepDifferences::mean(p_t[0], p_t[1]);
    const Vector3 t =
      StepDifferences::mean(start.normal_plus(), end.normal_plus());
    // b = t x d is the prescribed conormal, turned with the edge.
    const Vector3 b = StepDifferences::mean(
      cross_product_3d(start.normal_plus(), start.side(0).tangent),
      cross_product_3d(end.normal_plus(), end.side(0).tangent));
    const Vector3 e = mean_edge(start.side(0), end.side(0));
    // CorotationalEdgeStep::turn_as_prescribed()
    const auto   dual = StepDifferences::dual_basis(t, b, e);
    const double torque =
      (dual[1] * force_t) / (p_b_m * dual[1] + p_t_m * dual[0]);
    sides_[0].edge_force +=
      torque * ((p_b_m * dual[2]) * t - (p_t_m * dual[2]) * b) -
      (dual[2] * force_t) * t;
    rotation_work_ = torque * ((p_t[1] - p_t[0]) * b - (p_b[1] - p_b[0]) * t);
  }

  void
  FiniteEdgeStep::add_moment_forces(const EdgePoint       &start,
                                    const EdgePoint       &end,
                                    const ShellEdgeValues &edge,
                                    const unsigned int     q,
                                    const unsigned int     s)
  {
    const auto   &first  = start.side(s);
    const auto   &last   = end.side(s);
    Side         &side   = sides_[s];
    const double  force  = 0.5 * (start.moment_force(s) + end.moment_force(s));
    const double  lambda = 0.5 * (first.lambda + last.lambda);
    const double  moment = 0.5 * (first.moment + last.moment);
    const auto    nu_con = conormal_components(edge, s, q);
    const Vector3 p =
      nu_con[0] *
        StepDifferences::mean(first.deformed.a_cov[0], last.deformed.a_cov[0]) +
      nu_con[1] *
        StepDifferences::mean(first.deformed.a_cov[1], last.deformed.a_cov[1]);
    // Delta(m) = -(Delta(Y) . t + Y . Delta(t)) + c : Delta(E)
    side.membrane_force = (force * lambda) * first.coupling;
    side.moment_force =
      -(force * lambda) * StepDifferences::mean(first.normal, last.normal);
    side.normal_force -=
      (force * lambda) * StepDifferences::mean(first.Y, last.Y);
    // Delta(lambda) = Delta(nu) . p + nu . Delta(p)
    side.conormal_force += (force * moment) * p;
    side.stretch_force =
      (force * moment) * StepDifferences::mean(first.conormal, last.conormal);
  }

  void
  FiniteEdgeStep::set_basis_forces(const EdgePoint       &start,
                                   const EdgePoint       &end,
                                   const ShellEdgeValues &edge,
                                   const unsigned int     q,
                                   const unsigned int     s)
  {
    const auto   &first = start.side(s);
    const auto   &last  = end.side(s);
    Side         &side  = sides_[s];
    const Vector3 t     = StepDifferences::mean(first.normal, last.normal);
    const Vector3 nu    = StepDifferences::mean(first.conormal, last.conormal);
    const Vector3 e     = mean_edge(first, last);
    // Delta(nu) = -(nu . Delta(e)) dual[0] - (nu . Delta(t)) dual[1]
    const auto dual = StepDifferences::dual_basis(e, t, nu);
    side.edge_force -= (dual[0] * side.conormal_force) * nu;
    side.normal_force -= (dual[1] * side.conormal_force) * nu;
    // Delta(t) = -(t . Delta(phi,g)) phi*^g
    const auto frame =
      StepDifferences::mean_frame(first.deformed, last.deformed);
    const auto nu_con = conormal_components(edge, s, q);
    for (unsigned int g = 0; g < 2; ++g)
      side.basis_forces[g] = -(frame.a_con[g] * side.normal_force) * t +
                             first.tau[g] * side.edge_force +
                             nu_con[g] * side.stretch_force;
  }

  void
  FiniteEdgeStep::add_force(const ShellEdgeValues &edge,
                            const unsigned int     q,
                            const unsigned int     side,
                            NodeVectors<double>   &force) const
  {
    const Side &s = sides_[side];
    for (unsigned int a = 0; a < force.size(); ++a)
      {
        const auto &dN = edge.shapes(side).gradient(q, a);
        force[a] += dN[0] * s.basis_forces[0] + dN[1] * s.basis_forces[1] +
                    s.moment_row[a] * s.moment_force;
      }
  }
} // namespace Nacre
