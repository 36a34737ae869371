// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/simd.h>
#include <nacre/forms/cell_stiffness.h>

namespace Nacre
{
  namespace
  {
    NACRE_SIMD void
    multiply_rows(const double *const D,
                  const double *const b,
                  const unsigned int  n,
                  double *const       s)
    {
      for (unsigned int v = 0; v < 3; ++v)
        for (unsigned int i = 0; i < n; ++i)
          s[v * n + i] = D[3 * v] * b[i] + D[3 * v + 1] * b[n + i] +
                         D[3 * v + 2] * b[2 * n + i];
    }
  } // namespace

  void
  multiply_voigt_rows(const VoigtMatrix<> &D,
                      const double        *strain,
                      const unsigned int   n,
                      double              *stress)
  {
    multiply_rows(D.begin_raw(), strain, n, stress);
  }

  void
  CellStiffness::reinit(const ShellCellValues &values,
                        const SectionLaw      &section,
                        const double           membrane_factor)
  {
    membrane.resize(values.n_points());
    bending.resize(values.n_points());
    const bool is_coupled = section.is_coupled();
    coupling.resize(is_coupled ? values.n_points() : 0);
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        const auto stiffness =
          section.stiffness(values.frame(q), values.point(q));
        membrane[q] = membrane_factor * values.JxW(q) * stiffness.membrane;
        bending[q]  = values.JxW(q) * stiffness.bending;
        if (is_coupled)
          coupling[q] = membrane_factor * values.JxW(q) * stiffness.coupling;
      }
  }

  std::vector<InitialForces>
  held_forces(const ShellCellValues       &values,
              const SectionLaw            &section,
              const std::array<double, 2> &shares,
              const Instant               &instant)
  {
    std::vector<InitialForces> result;
    if (section.has_initial_strain())
      for (unsigned int q = 0; q < values.n_points(); ++q)
        {
          InitialForces held =
            section.initial_forces(values.frame(q), values.point(q), instant);
          const double membrane_area = shares[0] * values.JxW(q);
          const double bending_area  = shares[1] * values.JxW(q);
          held.membrane_force *= membrane_area;
          held.membrane_energy *= membrane_area;
          held.moment *= bending_area;
          held.bending_energy *= bending_area;
          result.push_back(held);
        }
    return result;
  }

  double
  full_integration_share(const ShellCellValues &values,
                         const SectionLaw      &section)
  {
    // On parts of divided cells the membrane strain is projected.
    if (values.is_cut())
      return 1.;
    double area = 0., volume = 0.;
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        area += values.JxW(q);
        volume += values.JxW(q) * section.thickness(values.point(q));
      }
    const double thickness = volume / area;
    return std::min(1., thickness * thickness / area);
  }
} // namespace Nacre
