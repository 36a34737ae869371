// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_mechanics_section_points_h
#define nacre_tests_mechanics_section_points_h

#include "../tests_common.h"
#include <nacre/mechanics/shell_section.h>

#include <algorithm>

namespace Tests
{
  /** The section of a parameter file's lines. */
  inline std::shared_ptr<const SectionLaw>
  section_of_lines(const std::string &lines)
  {
    ParameterAcceptor::clear();
    ShellSectionParameters parameters;
    read_text("subsection Section\n" + lines + "\nend\n");
    return parameters.make({}, {}, MeshRegions());
  }

  inline Vector3
  in_plane(const double x, const double y)
  {
    Vector3 v;
    v[0] = x;
    v[1] = y;
    return v;
  }

  /** The frame of the plane with the covariant basis @p a_1, @p a_2. */
  inline SurfaceFrame<>
  plane_frame(const Vector3 &a_1, const Vector3 &a_2)
  {
    return make_surface_frame<double>(a_1, a_2, {});
  }

  inline SurfaceFrame<>
  cartesian_frame()
  {
    return plane_frame(in_plane(1., 0.), in_plane(0., 1.));
  }

  /** Long, skewed, and not along the axes of Cartesian components. */
  inline SurfaceFrame<>
  skewed_frame()
  {
    return plane_frame(in_plane(0.7, 0.4), in_plane(-1.1, 2.3));
  }

  /** Cartesian resultants, energy and tangent, [n, m][eps, rho]. */
  struct Answer
  {
    std::array<double, 6>                force;
    std::array<std::array<double, 6>, 6> tangent;
    double                               energy;
  };

  using Strains = std::array<double, 6>;

  /**
   * A point of a flat section whose strains are given in Cartesian components
   * (e11, e22, 2 e12, k11, k22, 2 k12) whatever the frame, with its state.
   */
  class PointOfSection
  {
  public:
    PointOfSection(const SectionLaw &law, const SurfaceFrame<> &frame)
      : law_(law)
      , frame_(frame)
      , state_(law.n_state_variables())
      , to_frame_(
          strain_transformation({{frame.a_cov[0][0], frame.a_cov[0][1]}},
                                {{frame.a_cov[1][0], frame.a_cov[1][1]}}))
    {}

    Answer
    response(const Strains &strains) const
    {
      const auto [eps, rho] = in_frame(strains);
      const auto found =
        law_.response(eps, rho, frame_, point_, make_array_view(state_));
      const auto back  = transpose(to_frame_);
      const auto n     = back * found.membrane_force;
      const auto m     = back * found.moment;
      const auto block = [&](const VoigtMatrix<> &X) {
        return back * X * to_frame_;
      };
      const auto A = block(found.tangent.membrane);
      const auto B = block(found.tangent.coupling);
      const auto D = block(found.tangent.bending);
      Answer     answer;
      answer.energy = found.energy;
      for (unsigned int i = 0; i < 3; ++i)
        {
          answer.force[i]     = n[i];
          answer.force[3 + i] = m[i];
          for (unsigned int j = 0; j < 3; ++j)
            {
              answer.tangent[i][j]         = A[i][j];
              answer.tangent[i][3 + j]     = B[i][j];
              answer.tangent[3 + j][i]     = B[i][j];
              answer.tangent[3 + i][3 + j] = D[i][j];
            }
        }
      return answer;
    }

    Voigt<>
    stress(const Strains &strains, const double side) const
    {
      const auto [eps, rho] = in_frame(strains);
      return transpose(to_frame_) * law_.stress_at({},
                                                   eps,
                                                   rho,
                                                   side,
                                                   frame_,
                                                   point_,
                                                   make_array_view(state_));
    }

    /** The first of the law's state_results(). */
    double
    state_result(const double side) const
    {
      return law_.state_results(side, make_array_view(state_)).at(0);
    }

    double
    dissipated_energy() const
    {
      return law_.dissipated_energy(point_, make_array_view(state_));
    }

    /** The end of a step at these strains. */
    void
    accept(const Strains &strains)
    {
      const auto [eps, rho] = in_frame(strains);
      law_.update_state(eps, rho, frame_, point_, make_array_view(state_));
    }

    /**
     * Strains whose components in @p free take the @p forces, the others as
     * given, by Newton's method.
     */
    void
    solve(Strains                         &strains,
          const std::vector<unsigned int> &free,
          const std::vector<double>       &forces) const
    {
      const unsigned int n = free.size();
      for (unsigned int iteration = 0; iteration < 30; ++iteration)
        {
          const auto         answer = response(strains);
          FullMatrix<double> K(n, n);
          Vector<double>     r(n), step(n);
          for (unsigned int i = 0; i < n; ++i)
            {
              r[i] = forces[i] - answer.force[free[i]];
              for (unsigned int j = 0; j < n; ++j)
                K(i, j) = answer.tangent[free[i]][free[j]];
            }
          K.gauss_jordan();
          K.vmult(step, r);
          for (unsigned int i = 0; i < n; ++i)
            strains[free[i]] += step[i];
          double size = 0.;
          for (const double strain : strains)
            size = std::max(size, std::abs(strain));
          if (step.linfty_norm() <= 1e-13 * size)
            return;
        }
      AssertThrow(false, ExcMessage("Newton's method does not converge."));
    }

    const std::vector<double> &
    state() const
    {
      return state_;
    }

  private:
    /** eps and rho in the covariant basis. */
    std::pair<Voigt<>, Voigt<>>
    in_frame(const Strains &s) const
    {
      return {to_frame_ * Voigt<>({s[0], s[1], s[2]}),
              to_frame_ * Voigt<>({s[3], s[4], s[5]})};
    }

    const SectionLaw   &law_;
    SurfaceFrame<>      frame_;
    Point<3>            point_;
    std::vector<double> state_;
    VoigtMatrix<>       to_frame_;
  };

  /**
   * Forces against the derivative of the energy, the tangent against that of
   * the forces, by central differences of order 8, relative to the largest.
   */
  inline void
  check_derivatives(const std::string    &name,
                    const PointOfSection &point,
                    const Strains        &strains,
                    const double          step,
                    const double          bound)
  {
    const std::array<double, 4> weights = {
      {4. / 5., -1. / 5., 4. / 105., -1. / 280.}};
    const auto found      = point.response(strains);
    double     force_size = 0., tangent_size = 0.;
    double     force_error = 0., tangent_error = 0.;
    for (unsigned int j = 0; j < 6; ++j)
      {
        double                force = 0.;
        std::array<double, 6> column{};
        for (unsigned int k = 0; k < 4; ++k)
          for (const double sign : {1., -1.})
            {
              Strains moved = strains;
              moved[j] += sign * (k + 1) * step;
              const auto   there  = point.response(moved);
              const double weight = sign * weights[k] / step;
              force += weight * there.energy;
              for (unsigned int i = 0; i < 6; ++i)
                column[i] += weight * there.force[i];
            }
        force_size  = std::max(force_size, std::abs(found.force[j]));
        force_error = std::max(force_error, std::abs(force - found.force[j]));
        for (unsigned int i = 0; i < 6; ++i)
          {
            const double entry = found.tangent[i][j];
            tangent_size       = std::max(tangent_size, std::abs(entry));
            tangent_error =
              std::max(tangent_error, std::abs(column[i] - entry));
          }
      }
    check_below(name + ", forces", force_error / force_size, bound);
    check_below(name + ", tangent", tangent_error / tangent_size, bound);
  }

  /** Of all numbers, relative to the largest of each kind. */
  inline double
  difference(const Answer &found, const Answer &expected)
  {
    double force = 0., tangent = 0., force_size = 0., tangent_size = 0.;
    for (unsigned int i = 0; i < 6; ++i)
      {
        force = std::max(force, std::abs(found.force[i] - expected.force[i]));
        force_size = std::max(force_size, std::abs(expected.force[i]));
        for (unsigned int j = 0; j < 6; ++j)
          {
            tangent =
              std::max(tangent,
                       std::abs(found.tangent[i][j] - expected.tangent[i][j]));
            tangent_size =
              std::max(tangent_size, std::abs(expected.tangent[i][j]));
          }
      }
    return force / force_size + tangent / tangent_size +
           std::abs(found.energy / expected.energy - 1.);
  }
} // namespace Tests

#endif
