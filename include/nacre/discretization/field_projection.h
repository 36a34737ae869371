// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_field_projection_h
#define nacre_discretization_field_projection_h

#include <nacre/discretization/part_transfer.h>
#include <nacre/mechanics/section_law.h>

#include <memory>
#include <vector>

namespace Nacre
{
  struct PartEnrichment;

  /**
   * Fields before cuts of a mesh become longer, functions of tips included, for
   * their projection onto the shape functions phi_i of the nodes afterwards,
   *
   *   int rho h phi_i . (w - w_h) dA = 0,
   *
   * which have all rigid motions: a velocity w_h has the momentum and the
   * angular momentum of w.
   *
   * The steps, each collective: the constructor; the triangulation of the
   * discretisation is released; another discretisation takes it; missing().
   */
  class FieldProjection
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;

    /** @param fields with ghosts, such as displacements (length) */
    FieldProjection(const Discretization              &discretization,
                    const std::vector<const Vector *> &fields);

    /**
     * The integrals above (mass times field), by field, without constraints.
     * @param discretization of the same mesh and longer cuts
     * @param fields w_h with ghosts
     * @param section gives rho h
     */
    std::vector<Vector>
    missing(const Discretization              &discretization,
            const std::vector<const Vector *> &fields,
            const SectionLaw                  &section) const;

  private:
    /** The fields on a part of a cell. */
    struct PartFields
    {
      Outline                               outline;
      std::shared_ptr<const PartEnrichment> enrichment;
      /** By field and local dof. */
      std::vector<std::vector<double>> values;
    };

    /** Add the integrals over a part. */
    void
    add_on_part(const Discretization              &discretization,
                const std::vector<const Vector *> &fields,
                const SectionLaw                  &section,
                const CellPart                    &part,
                const PartFields                  &before,
                std::vector<Vector>               &result) const;

    /** By active cell index; of this rank's cells. */
    std::vector<std::vector<PartFields>> parts_;
  };
} // namespace Nacre

#endif
