// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_foundation_term_h
#define nacre_forms_foundation_term_h

#include <nacre/forms/term.h>

namespace Nacre
{
  struct Foundation;

  /**
   * Force per area that holds the shell back at the displacement @p u of a
   * cell's dofs.
   */
  Tensor<1, spacedim>
  foundation_force(const Foundation             &foundation,
                   const ShellCellValues        &values,
                   const unsigned int            q,
                   const dealii::Vector<double> &u);

  /**
   * The virtual work of an elastic foundation, the sum over the points of
   * JxW (k_n w t0 + k_t (u - w t0)) . v with w = u . t0, and its energy. In a
   * step with energy-momentum forces it does the work that the energy changes
   * by (Foundation::normal_answer()).
   */
  class FoundationTerm : public Term
  {
  public:
    /** @param foundation must live as long */
    explicit FoundationTerm(const Foundation &foundation)
      : foundation_(foundation)
    {}

    void
    add_on_cell(TermCell &cell, LocalTerms &terms) const override;

  private:
    const Foundation &foundation_;
  };
} // namespace Nacre

#endif
