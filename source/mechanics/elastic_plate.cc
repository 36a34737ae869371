// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/elastic_plate.h>

namespace Nacre
{
  std::optional<ElasticPlate>
  elastic_plate(const SectionLaw   &section,
                const SectionPoint &x,
                const Tensor<1, 3> &e_1,
                const Tensor<1, 3> &e_2)
  {
    const auto frame =
      make_surface_frame(e_1, e_2, std::array<Tensor<1, 3>, 3>());
    const auto   C = section.stiffness(frame, x);
    const double h = section.thickness(x);
    const double A = C.membrane[0][0], nu = C.membrane[0][1] / A;

    // What the stiffnesses of such a plate are, to some digits
    VoigtMatrix<> H;
    H[0][0] = H[1][1] = 1.;
    H[0][1] = H[1][0] = nu;
    H[2][2]           = 0.5 * (1. - nu);
    if (!section.is_linear() || (C.membrane - A * H).norm() > 1e-8 * A ||
        (C.bending - A * h * h / 12. * H).norm() > 1e-8 * A * h * h ||
        C.coupling.norm() > 1e-8 * A * h)
      return {};
    return ElasticPlate{A * (1. - nu * nu) / h, nu, h};
  }
} // namespace Nacre
