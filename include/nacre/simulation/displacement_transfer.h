// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_displacement_transfer_h
#define nacre_simulation_displacement_transfer_h

#include <nacre/discretization/discretization.h>
#include <nacre/forms/section_states.h>

#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace Nacre
{
  /**
   * Carries displacements to the mesh that refinement makes of its own: the
   * same polynomials of the reference cells, on any ranks. A part of a cell
   * takes those of the part before in which its inner point lies. New nodes of
   * the geometry lie on the exact surface, so that the deformed surface changes
   * by as much as the undeformed one does. Points of a section with memory take
   * the states of the nearest points of the cell before.
   *
   * The steps, each collective: the constructor; Discretization's triangulation
   * is released; refine(); another Discretization takes it; field_on().
   */
  class DisplacementTransfer
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;
    using Mesh   = parallel::TriangulationBase<dim, spacedim>;

    /**
     * @param fields ghosted, such as displacements (length)
     * @param states of the section; those of edges aren't carried on
     * @param marked cells to refine, by active cell index; those of this rank
     */
    DisplacementTransfer(const Discretization              &discretization,
                         const std::vector<const Vector *> &fields,
                         const SectionStates               &states,
                         const std::vector<bool>           &marked);

    /** Refine the triangulation of the discretisation, now @p mesh. */
    void
    refine(Mesh &mesh);

    /** The field @p k, owned entries, nodes that follow others included. */
    Vector
    field_on(const Discretization &discretization, const unsigned int k) const;

    /** What @p states of the refined mesh begin with. */
    void
    set_states(const Discretization &discretization,
               SectionStates        &states) const;

  private:
    /** The fields on a part of a cell. */
    struct PartFields
    {
      /** Of its polygon; none: the whole cell. */
      std::vector<Point<dim>> vertices;
      /** By field, then 3 node + component. */
      std::vector<std::vector<double>> values;
      /** Of the section, at the points of the cell's rule. */
      std::vector<SectionStates::Record> states;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &vertices &values &states;
      }
    };

    /** Of all parts of a cell. */
    using CellFields = std::vector<PartFields>;

    /** Where a refined mesh's cell comes from. */
    struct Source
    {
      /** In cells_. */
      unsigned int cell;
      /** Which child of that cell; invalid: that cell itself. */
      unsigned int child;
    };

    /** Place in the source's reference cell of a cell's @p unit. */
    static Point<dim>
    place_before(const Source &source, const Point<dim> &unit);

    /** That part of the source which a part comes from; null: a sliver. */
    const PartFields *
    fields_around(const Discretization &discretization,
                  const CellPart       &part) const;

    const std::vector<bool> marked_;
    std::vector<CellFields> cells_;
    /** By active cell index of the refined mesh, for this rank's cells. */
    std::vector<Source> sources_;
  };
} // namespace Nacre

#endif
