// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_edge_penalty_h
#define nacre_forms_edge_penalty_h

#include <nacre/discretization/shell_values.h>
#include <nacre/mechanics/section_law.h>

#include <optional>
#include <vector>

namespace Nacre
{
  /**
   * The penalty eta^e = eta / h^e (15) of the edges, with the characteristic
   * size h^e = min(|A| / |dA|) over both cells (16): area over perimeter.
   *
   * The form is coercive if, on both cells K of every edge, eta is at least
   * eta_K = (h^e / 2) lambda_K, lambda_K (1/length) the largest eigenvalue of
   * the pair (int_dK m_nn^2 / D ds, int_K rho:D:rho dA). Without a user's
   * eta, twice the larger of both cells' eta_K is taken, so that eta^e = max
   * lambda_K. For sections that couple membrane and bending the second form is
   * the whole energy, int eps:A:eps + 2 eps:B:rho + rho:D:rho dA, with tied
   * membrane strains, as the moments have them.
   *
   * Reduced bending energies (8-node cells with 2 x 2 points) take the bound of
   * full integration, too, as an estimate: a curved cell has modes without any
   * strain at those points but with moments on its edges. Its neighbours alone
   * hold them, so that no bound of a single cell covers them.
   */
  class EdgePenalty
  {
  public:
    /**
     * @param quadrature full integration of the bending energy
     * @param eta the user's eta; none: the bound
     */
    EdgePenalty(const Discretization        &discretization,
                const SectionLaw            &section,
                const Quadrature<dim>       &quadrature,
                const std::optional<double> &eta);

    /** eta^e (1/length) of the edge between two cells or parts. */
    double
    interior(const CellPart &part, const CellPart &neighbor) const;

    /** eta^e (1/length) of a boundary edge, without the factor 2. */
    double
    boundary(const CellPart &part) const;

    /**
     * The largest eta_K over all edges, the bound that makes the form
     * coercive (1); with a user's eta below it, the matrix may be indefinite.
     */
    double
    bound() const
    {
      return bound_;
    }

    /** The user's eta, or twice the bound: the largest eta taken (1). */
    double
    eta() const
    {
      return eta_ ? *eta_ : 2. * bound_;
    }

    /** lambda_K (1/length) of a part that this rank owns or has as a ghost. */
    double
    eigenvalue(const CellPart &part) const
    {
      return eigenvalues_[part.index()];
    }

  private:
    const std::optional<double> eta_;
    /** By CellPart::index(): |A| / |dA| (length), and lambda_K. */
    std::vector<double> sizes_;
    std::vector<double> eigenvalues_;
    double              bound_ = 0.;
  };
} // namespace Nacre

#endif
