// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_stiffness_terms_h
#define nacre_forms_stiffness_terms_h

#include <nacre/forms/term.h>

namespace Nacre
{
  /** Membrane and bending strains of the cells, (32)-(33). */
  class StrainTerm : public Term
  {
  public:
    void
    add_on_cell(TermCell &cell, LocalTerms &terms) const override;
  };

  /**
   * The interior penalty form of the edges between cells, (N.12): it keeps the
   * angle of two cells.
   */
  class RotationJumpTerm : public Term
  {
  public:
    bool
    acts_between_cells() const override
    {
      return true;
    }

    void
    add_between_cells(const TermEdge &edge, LocalTerms &terms) const override;
  };

  /**
   * The same form of the boundary edges whose rotation is prescribed, (N.15):
   * those that ShellActions name.
   */
  class PrescribedRotationTerm : public Term
  {
  public:
    bool
    acts_on_boundary(const types::boundary_id                     id,
                     const std::pair<unsigned int, unsigned int> &place,
                     const ShellActions &actions) const override;

    void
    add_on_boundary(const TermEdge &edge, LocalTerms &terms) const override;
  };
} // namespace Nacre

#endif
