// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_part_transfer_h
#define nacre_discretization_part_transfer_h

#include <nacre/discretization/discretization.h>

#include <deal.II/lac/trilinos_vector.h>

#include <optional>
#include <vector>

namespace Nacre
{
  /**
   * Carries fields to the same mesh with longer cuts. A part takes the
   * polynomial of the part that it comes from, so that the fields, hence mass
   * and bending energy, are those of before; nodes of small parts then follow
   * their roots, (C.3) of doc/cutting.md. Functions of tips, which move on,
   * are left out: nodes keep their displacements.
   *
   * The steps: the constructor; the discretisation goes, and another one takes
   * its triangulation; field_on(). Cells stay on their ranks.
   */
  class PartTransfer
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;

    /** @param fields with ghosts, such as displacements (length) */
    PartTransfer(const Discretization              &discretization,
                 const std::vector<const Vector *> &fields);

    /** The field @p k, owned entries. Collective. */
    Vector
    field_on(const Discretization &discretization, const unsigned int k) const;

  private:
    /** A part as it was. */
    struct FormerPart
    {
      /** None: all of the cell. */
      std::optional<CellPolygon> polygon;
      /** By field and dof of nodes. */
      std::vector<std::vector<double>> values;
    };

    const FormerPart &
    former_part(const Discretization &discretization,
                const CellPart       &part) const;

    /** By active cell index; of this rank's cells and ghosts. */
    std::vector<std::vector<FormerPart>> parts_;
  };
} // namespace Nacre

#endif
