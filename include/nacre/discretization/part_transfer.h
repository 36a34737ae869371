// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_part_transfer_h
#define nacre_discretization_part_transfer_h

#include <nacre/discretization/child_map.h>
#include <nacre/discretization/tip_transfer.h>

#include <functional>
#include <utility>
#include <vector>

namespace Nacre
{
  /** The polygon of a part in its reference cell; none: all of the cell. */
  using Outline = std::vector<Point<dim>>;

  Outline
  outline_of(const CellPart &part);

  /**
   * The place of the outline that holds @p x, or of the nearest one, and how
   * far @p x is outside of it. A cut's chord in a child is not quite that in
   * its parent, where cells are curved in the chart.
   */
  std::pair<unsigned int, double>
  nearest_outline(const std::vector<Outline> &outlines, const Point<dim> &x);

  /** Numbers at points of a part. */
  struct PointValues
  {
    /** In the reference cell. */
    std::vector<Point<dim>> points;
    /** Point by point. */
    std::vector<double> values;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &points &values;
    }
  };

  /**
   * Carries fields to the same mesh with longer cuts, or to the mesh that
   * refinement makes of it, on any ranks. A part takes the polynomials of the
   * part before in which its inner point lies, so that on the same mesh mass
   * and bending energy are those of before; nodes of small parts then follow
   * their roots, (C.3) of doc/cutting.md. New nodes of the geometry lie on the
   * exact surface, so that the deformed surface changes by as much as the
   * undeformed one does. Branch functions of tips go along as TipTransfer says,
   * and so does what a part has at points, such as states of its section.
   *
   * The steps, each collective: the constructor; the triangulation of the
   * discretisation is released; refine(), if wanted; another discretisation
   * takes it; field_on(). Cells that aren't refined stay on their ranks.
   */
  class PartTransfer
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;
    using Mesh   = parallel::TriangulationBase<dim, spacedim>;

    /**
     * @param fields with ghosts, such as displacements (length)
     * @param at_points what a part of this rank's cells has besides
     */
    PartTransfer(
      const Discretization                               &discretization,
      const std::vector<const Vector *>                  &fields,
      const std::function<PointValues(const CellPart &)> &at_points = {});

    /**
     * Refine the triangulation of the discretisation, now @p mesh.
     * @param marked by active cell index; those of this rank
     */
    void
    refine(Mesh &mesh, const std::vector<bool> &marked);

    /**
     * The field @p k, owned entries, nodes that follow others included.
     * @throws ExcMessage if on the same mesh a part lies in none of before
     */
    Vector
    field_on(const Discretization &discretization, const unsigned int k) const;

    /**
     * What the constructor's at_points said of the part that @p part comes
     * from; the points in this part's cell, or around it.
     */
    PointValues
    points_of(const CellPart &part) const;

  private:
    /** The fields on a part of a cell. */
    struct PartFields
    {
      Outline outline;
      /** By field. */
      std::vector<NodalVectors>       values;
      std::vector<TipTransfer::Share> tips;
      PointValues                     at_points;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &outline &values &tips &at_points;
      }
    };

    /** The cell that a cell comes from. */
    struct Source
    {
      std::vector<PartFields> parts;
      /** Which of child_maps() leads to it. */
      unsigned int map = ChildMap::identity;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &parts &map;
      }
    };

    /** Those that hold @p part; null: all was removed there. */
    const PartFields *
    fields_around(const CellPart &part, const Point<dim> &inside) const;

    const TipTransfer tips_;
    /** By active cell index; of this rank's cells and ghosts. */
    std::vector<Source> sources_;
    bool                is_refined_ = false;
  };
} // namespace Nacre

#endif
