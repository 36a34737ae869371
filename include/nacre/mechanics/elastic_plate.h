// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_elastic_plate_h
#define nacre_mechanics_elastic_plate_h

#include <nacre/mechanics/section_law.h>
#include <nacre/mechanics/williams_fields.h>

#include <optional>

namespace Nacre
{
  /**
   * The homogeneous isotropic plate that a section is at @p x, by its membrane
   * and bending stiffness; nothing if it is none.
   * @param e_1, e_2 tangent, orthogonal, of length 1
   */
  std::optional<ElasticPlate>
  elastic_plate(const SectionLaw   &section,
                const SectionPoint &x,
                const Tensor<1, 3> &e_1,
                const Tensor<1, 3> &e_2);
} // namespace Nacre

#endif
