// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/corotational_edge_step.h>
#include <nacre/mechanics/step_differences.h>

#include <tuple>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, spacedim>;

  } // namespace

  void
  CorotationalEdgeStep::reinit(const ShellEdgeValues               &edge,
                               const unsigned int                   q,
                               const CorotationalEdgePoint<double> &start,
                               const CorotationalEdgePoint<double> &end,
                               const PrescribedRotation &rotation_start,
                               const PrescribedRotation &rotation_end)
  {
    n_sides_       = start.n_sides();
    rotation_work_ = 0.;
    for (unsigned int s = 0; s < n_sides_; ++s)
      {
        // The forces are linear in [[theta]] and {m_nn}: means, too.
        Side &side  = sides_[s];
        side.linear = start.side(s).linear;
        side.normal =
          StepDifferences::mean(start.side(s).normal, end.side(s).normal);
        side.rotation_force =
          0.5 * (start.rotation_force(s) + end.rotation_force(s));
        side.moment_force = 0.5 * (start.moment_force(s) + end.moment_force(s));
        side.normal_force =
          side.rotation_force *
            StepDifferences::mean(start.side(s).lambda, end.side(s).lambda) +
          side.moment_force *
            StepDifferences::mean(start.side(s).mu, end.side(s).mu);
        side.basis_forces = {};
      }
    if (n_sides_ == 2)
      turn_with_mean_normal(edge, q, start, end);
    else
      turn_as_prescribed(edge, q, start, end, {{rotation_start, rotation_end}});

    // e = phi,alpha times the components of d0, on the side 0
    for (unsigned int alpha = 0; alpha < 2; ++alpha)
      sides_[0].basis_forces[alpha] +=
        (start.initial_tangent() * edge.frame(0, q).a_con[alpha]) * edge_force_;
  }

  void
  CorotationalEdgeStep::turn_with_mean_normal(
    const ShellEdgeValues               &edge,
    const unsigned int                   q,
    const CorotationalEdgePoint<double> &start,
    const CorotationalEdgePoint<double> &end)
  {
    const double  sigma[2] = {1., edge.sigma(1, q)};
    const Vector3 b = StepDifferences::mean(start.binormal(), end.binormal());
    const Vector3 t = StepDifferences::mean(start.normal(), end.normal());
    const Vector3 e = StepDifferences::mean(start.stretch() * start.tangent(),
                                            end.stretch() * end.tangent());
    std::array<SurfaceFrame<>, 2> frames;
    Vector3                       T, force_b, force_t;
    for (unsigned int s = 0; s < 2; ++s)
      {
        frames[s] = StepDifferences::mean_frame(start.side(s).deformed,
                                                end.side(s).deformed);
        T += sigma[s] * frames[s].t0;
        const Vector3 &t0 = sides_[s].linear.t0;
        force_b += (t0 * start.initial_binormal()) * sides_[s].normal_force;
        force_t += (t0 * start.initial_normal()) * sides_[s].normal_force;
      }
    // Delta(t) = -(t . Delta(b)) dual_t[0] - (t . Delta(e)) dual_t[1]
    const auto dual_t = StepDifferences::dual_basis(b, e, t);
    force_b -= (dual_t[0] * force_t) * t;
    edge_force_ = -(dual_t[1] * force_t) * t;
    // Delta(b) = -(b . Delta(T)) dual_b[0] - (b . Delta(e)) dual_b[1]
    const auto dual_b = StepDifferences::dual_basis(T, e, b);
    edge_force_ -= (dual_b[1] * force_b) * b;
    const Vector3 force_T = -(dual_b[0] * force_b) * b;
    // Delta(T) is the sum of the sides' sigma Delta(t^s).
    for (unsigned int s = 0; s < 2; ++s)
      for (unsigned int alpha = 0; alpha < 2; ++alpha)
        sides_[s].basis_forces[alpha] =
          -(sigma[s] * (frames[s].a_con[alpha] * force_T)) * frames[s].t0;
  }

  void
  CorotationalEdgeStep::turn_as_prescribed(
    const ShellEdgeValues                   &edge,
    const unsigned int                       q,
    const CorotationalEdgePoint<double>     &start,
    const CorotationalEdgePoint<double>     &end,
    const std::array<PrescribedRotation, 2> &rotations)
  {
    std::array<Vector3, 2> p_b, p_t;
    for (unsigned int k = 0; k < 2; ++k)
      std::tie(p_b[k], p_t[k]) = prescribed_frame(edge.conormal(0, q),
                                                  edge.frame(0, q).t0,
                                                  rotations[k]);
    const Vector3 p_b_m = StepDifferences::mean(p_b[0], p_b[1]);
    const Vector3 p_t_m = StepDifferences::mean(p_t[0], p_t[1]);
    const Vector3 b = StepDifferences::mean(start.binormal(), end.binormal());
    const Vector3 t = StepDifferences::mean(start.normal(), end.normal());
    const Vector3 e = StepDifferences::mean(start.stretch() * start.tangent(),
                                            end.stretch() * end.tangent());
    // Delta(t) = spin b* - (t . Delta(e)) e*,
    // Delta(b) = -spin t* - (b . Delta(e)) e*, and p_b . t = p_t . b gives
    // spin = ((t . Delta(e)) p_b . e* - (b . Delta(e)) p_t . e*
    //         + Delta(p_t) . b - Delta(p_b) . t) / (p_b . b* + p_t . t*)
    const auto    dual    = StepDifferences::dual_basis(t, b, e);
    const Vector3 force_t = sides_[0].normal_force;
    const double  torque =
      (dual[1] * force_t) / (p_b_m * dual[1] + p_t_m * dual[0]);
    edge_force_ = torque * ((p_b_m * dual[2]) * t - (p_t_m * dual[2]) * b) -
                  (dual[2] * force_t) * t;
    rotation_work_ = torque * ((p_t[1] - p_t[0]) * b - (p_b[1] - p_b[0]) * t);
  }

  void
  CorotationalEdgeStep::add_force(const ShellEdgeValues &edge,
                                  const unsigned int     q,
                                  const unsigned int     side,
                                  NodeVectors<double>   &force) const
  {
    const Side &s = sides_[side];
    for (unsigned int a = 0; a < force.size(); ++a)
      {
        const auto &dN = edge.shapes(side).gradient(q, a);
        force[a] += (s.rotation_force * s.linear.rotation[a] +
                     s.moment_force * s.linear.moment[a]) *
                      s.normal +
                    dN[0] * s.basis_forces[0] + dN[1] * s.basis_forces[1];
      }
  }
} // namespace Nacre
