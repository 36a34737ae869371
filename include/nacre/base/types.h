// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_types_h
#define nacre_base_types_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <map>
#include <string>

/** Thin Kirchhoff-Love shells by a C0 interior-penalty method. */
namespace Nacre
{
  using namespace dealii;

  /** A shell is a surface (dim = 2) in space (spacedim = 3). */
  constexpr unsigned int dim      = 2;
  constexpr unsigned int spacedim = 3;

  /**
   * Symmetric surface tensors in Voigt order: strains (e11, e22, 2 e12),
   * resultants (n11, n22, n12); components in the covariant basis of the
   * mid-surface, strains with lower and resultants with upper indices.
   */
  template <typename Number = double>
  using Voigt = Tensor<1, 3, Number>;

  /** Section stiffness in Voigt order, [resultant][strain]. */
  template <typename Number = double>
  using VoigtMatrix = Tensor<2, 3, Number>;

  /** Named constants that every expression of a parameter file may use. */
  using Constants = std::map<std::string, double>;
} // namespace Nacre

#endif
