// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_ply_quantities_h
#define nacre_postprocess_ply_quantities_h

#include <nacre/base/types.h>

#include <string>

namespace Nacre
{
  struct ShellState;

  /** What a ply of a laminate feels at a point. */
  struct PlyQuantity
  {
    enum class Kind
    {
      /** (s1, s2, t12) or (e1, e2, 2 e12) of a face of a ply. */
      stress,
      strain,
      /** Failure indices, 1 at failure: the largest of all plies. */
      tsai_wu,
      maximum_stress
    };

    Kind kind;
    /** Voigt component, 0 to 2; of stresses and strains only, as the next. */
    unsigned int component = 0;
    /** Counted from 0 at the bottom. */
    unsigned int ply = 0;
    /** 0: the lower face of the ply, 1: the upper one. */
    unsigned int face  = 0;
    Point<3>     point = {};
    /** The parameter, for messages. */
    std::string where = {};
  };

  /** The words of PlyQuantity, for messages. */
  inline const char *const ply_quantity_form =
    "write 'ply stress 1|2|12 of NUMBER bottom|top at (x, y, z)', plies "
    "counted "
    "from 1 at the bottom, or 'ply strain' in the same way";

  /**
   * The stress or strain of the words @p component, "1", "2" or "12", and @p
   * ply, "3 top"; throws for others.
   */
  PlyQuantity
  parse_ply_quantity(const PlyQuantity::Kind kind,
                     const std::string      &component,
                     const std::string      &ply,
                     const Point<3>         &point,
                     const std::string      &where);

  /**
   * The value; collective. Throws on all ranks if the section has no such ply,
   * or no strengths for an index.
   */
  double
  evaluate_ply_quantity(const ShellState &state, const PlyQuantity &quantity);
} // namespace Nacre

#endif
