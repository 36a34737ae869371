// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/corotational_strain.h>
#include <nacre/mechanics/green_strain.h>
#include <nacre/postprocess/crack_extension.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace Nacre
{
  namespace
  {
    /** The two coordinates of the Voigt pairs 11, 22, 12. */
    constexpr std::array<std::array<unsigned int, 2>, 3> pairs = {
      {{{0, 0}}, {{1, 1}}, {{0, 1}}}};

    /** The Voigt index of a pair. */
    unsigned int
    pair_of(const unsigned int a, const unsigned int b)
    {
      return a == b ? a : 2;
    }

    /** x,ab c of the pair v and the coordinate c. */
    const Tensor<1, 3> &
    third_derivative(const SurfacePatch &surface,
                     const unsigned int  v,
                     const unsigned int  c)
    {
      return surface.third[pairs[v][0] + pairs[v][1] + c];
    }

    /** A function of the squared distance, with two derivatives by it. */
    struct PlateauValues
    {
      double value = 1., first = 0., second = 0.;
    };

    PlateauValues
    plateau_values(const CrackPlateau &plateau, const double r)
    {
      const double width = plateau.outer - plateau.inner;
      const double t     = (r - plateau.inner) / width;
      if (t <= 0.)
        return {};
      if (t >= 1.)
        return {0., 0., 0.};
      const double tt = t * t, b = t * (1. - t);
      const double eta =
        1. -
        t * tt * tt * (126. - t * (420. - t * (540. - t * (315. - 70. * t))));
      const double d  = -630. * b * b * b * b / width;
      const double dd = -2520. * b * b * b * (1. - 2. * t) / (width * width);
      return {eta, d / (2. * r), (dd - d / r) / (4. * r * r)};
    }

    /** r and theta in the tangent plane of the tip. */
    std::pair<double, double>
    polar_coordinates(const CrackTip &tip,
                      const double    side,
                      const Point<3> &point)
    {
      const Tensor<1, 3> d = point - tip.position;
      const double       x = d * tip.axes[0], y = d * tip.axes[1];
      double             theta = std::atan2(y, x);
      // At the lips y = 0 is no side.
      if (x < 0. && theta * side < 0.)
        theta += (side > 0. ? 2. : -2.) * numbers::PI;
      return {std::hypot(x, y), theta};
    }

    /** The vector with the components along the axes of the tip. */
    Tensor<1, 3>
    in_space(const CrackTip &tip, const Tensor<1, 3> &components)
    {
      return components[0] * tip.axes[0] + components[1] * tip.axes[1] +
             components[2] * tip.axes[2];
    }

    Voigt<>
    bending_strain(const SurfaceFrame<>    &frame,
                   const VectorDerivatives &u,
                   const bool               is_linear)
    {
      if (is_linear)
        return ShellStrain::bending(frame, u.first, u.second);
      VectorDerivatives phi(u);
      for (unsigned int a = 0; a < 2; ++a)
        phi.first[a] += frame.a_cov[a];
      for (unsigned int v = 0; v < 3; ++v)
        phi.second[v] += frame.a_cov_derivatives[v];
      return CorotationalStrain::bending(frame,
                                         make_surface_frame(phi.first[0],
                                                            phi.first[1],
                                                            phi.second));
    }
  } // namespace

  CrackExtension::CrackExtension(const CrackTip     &tip,
                                 const CrackPlateau &plateau,
                                 const SurfacePatch &surface)
  {
    const Tensor<1, 3> d   = surface.position - tip.position;
    const auto         eta = plateau_values(plateau, d.norm());
    const auto        &x   = surface.derivatives;

    Tensor<2, 2> J;
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int a = 0; a < 2; ++a)
        J[i][a] = tip.axes[i] * x.first[a];
    const Tensor<2, 2> J_inverse = invert(J);
    q                            = J_inverse * Tensor<1, 2>({eta.value, 0.});

    // (J q),a = (eta,a, 0)
    std::array<Tensor<2, 2>, 2> dJ;
    std::array<double, 2>       squared; // of the distance, its derivatives
    for (unsigned int a = 0; a < 2; ++a)
      {
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int b = 0; b < 2; ++b)
            dJ[a][i][b] = tip.axes[i] * x.second[pair_of(a, b)];
        squared[a] = 2. * (d * x.first[a]);
        const Tensor<1, 2> dq =
          J_inverse * (Tensor<1, 2>({eta.first * squared[a], 0.}) - dJ[a] * q);
        for (unsigned int g = 0; g < 2; ++g)
          gradient[g][a] = dq[g];
      }
    // (J q),ab = (eta,ab, 0)
    for (unsigned int v = 0; v < 3; ++v)
      {
        const auto [a, b] = pairs[v];
        Tensor<2, 2> ddJ;
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int c = 0; c < 2; ++c)
            ddJ[i][c] = tip.axes[i] * third_derivative(surface, v, c);
        const double second = 2. * (x.first[a] * x.first[b] + d * x.second[v]);
        const Tensor<2, 2> dq = transpose(gradient); // [a][g]
        hessian[v] =
          J_inverse *
          (Tensor<1, 2>(
             {eta.second * squared[a] * squared[b] + eta.first * second, 0.}) -
           ddJ * q - dJ[a] * dq[b] - dJ[b] * dq[a]);
      }
  }

  Tensor<1, 3>
  carried(const VectorDerivatives &u, const CrackExtension &extension)
  {
    return extension.q[0] * u.first[0] + extension.q[1] * u.first[1];
  }

  Tensor<1, 3>
  williams_value(const WilliamsField &field,
                 const CrackTip      &tip,
                 const double         side,
                 const Point<3>      &point)
  {
    const auto [r, theta] = polar_coordinates(tip, side, point);
    return in_space(tip, field.value(r, theta));
  }

  VectorDerivatives
  williams_derivatives(const WilliamsField &field,
                       const CrackTip      &tip,
                       const double         side,
                       const SurfacePatch  &surface)
  {
    const auto [r, theta] = polar_coordinates(tip, side, surface.position);
    const auto gradient   = field.gradient(r, theta);
    const auto hessian    = field.hessian(r, theta);

    VectorDerivatives result;
    const auto       &position = surface.derivatives;
    for (unsigned int i = 0; i < 2; ++i)
      {
        const Tensor<1, 3> along = in_space(tip, gradient[i]);
        for (unsigned int a = 0; a < 2; ++a)
          result.first[a] += (tip.axes[i] * position.first[a]) * along;
        for (unsigned int v = 0; v < 3; ++v)
          result.second[v] += (tip.axes[i] * position.second[v]) * along;
        for (unsigned int j = 0; j < 2; ++j)
          {
            const Tensor<1, 3> second = in_space(tip, hessian[pair_of(i, j)]);
            for (unsigned int v = 0; v < 3; ++v)
              result.second[v] += (tip.axes[i] * position.first[pairs[v][0]]) *
                                  (tip.axes[j] * position.first[pairs[v][1]]) *
                                  second;
          }
      }
    return result;
  }

  Voigt<>
  membrane_strain(const SurfaceFrame<>    &frame,
                  const VectorDerivatives &u,
                  const bool               is_linear)
  {
    return is_linear ? ShellStrain::membrane(frame, u.first[0], u.first[1]) :
                       GreenStrain::membrane(frame, u.first);
  }

  VectorDerivatives
  moved(const VectorDerivatives &u,
        const CrackExtension    &extension,
        const double             s)
  {
    VectorDerivatives result(u);
    const auto       &dq = extension.gradient;
    for (unsigned int g = 0; g < 2; ++g)
      {
        for (unsigned int a = 0; a < 2; ++a)
          result.first[a] -= s * dq[g][a] * u.first[g];
        for (unsigned int v = 0; v < 3; ++v)
          {
            const auto [a, b] = pairs[v];
            result.second[v] -= s * (dq[g][a] * u.second[pair_of(g, b)] +
                                     dq[g][b] * u.second[pair_of(g, a)] +
                                     extension.hessian[v][g] * u.first[g]);
          }
      }
    return result;
  }

  MovedPoint::MovedPoint(const SurfacePatch   &surface,
                         const CrackExtension &extension,
                         const double          s)
    : point(surface.position)
  {
    const auto       &x  = surface.derivatives;
    const auto       &dq = extension.gradient;
    VectorDerivatives here(x);
    for (unsigned int g = 0; g < 2; ++g)
      {
        const double shift = s * extension.q[g];
        for (unsigned int a = 0; a < 2; ++a)
          here.first[a] += shift * x.second[pair_of(a, g)];
        for (unsigned int v = 0; v < 3; ++v)
          here.second[v] += shift * third_derivative(surface, v, g);
        static_cast<Point<3> &>(point) += shift * x.first[g];
      }
    frame = make_surface_frame(here.first[0], here.first[1], here.second);
    determinant =
      (1. + s * dq[0][0]) * (1. + s * dq[1][1]) - s * s * dq[0][1] * dq[1][0];
  }

  SectionResponse
  MovedPoint::response(const SectionAt         &section,
                       const bool               is_linear,
                       const VectorDerivatives &u,
                       const Voigt<>           &tying) const
  {
    return section.response(tying + membrane_strain(frame, u, is_linear),
                            bending_strain(frame, u, is_linear),
                            frame,
                            point);
  }

  double
  energy_change(const SectionAt         &section,
                const bool               is_linear,
                const SurfacePatch      &surface,
                const CrackExtension    &extension,
                const VectorDerivatives &u,
                const Voigt<>           &tying,
                const double             length)
  {
    const auto energy = [&](const double s) {
      const MovedPoint at(surface, extension, s);
      return at.response(section, is_linear, moved(u, extension, s), tying)
               .energy *
             at.frame.j0 * at.determinant;
    };
    return change_with_advance(energy, length);
  }
} // namespace Nacre
