// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_shell_edge_values_h
#define nacre_discretization_shell_edge_values_h

#include <nacre/discretization/discretization.h>
#include <nacre/discretization/membrane_tying.h>
#include <nacre/discretization/part_enrichment.h>
#include <nacre/discretization/shape_table.h>
#include <nacre/mechanics/section_law.h>
#include <nacre/mechanics/surface_frame.h>

#include <deal.II/base/quadrature.h>

#include <deal.II/lac/full_matrix.h>

#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * Frames and shape functions at the points of an edge, on both sides:
   * FEInterfaceValues for shells, computed from the nodes' positions alone.
   * Side 0 is K^-, side 1 is K^+; on the boundary and for a single cell there
   * is side 0 only.
   *
   * Conventions, here and nowhere else: jump = plus - minus; the conormal
   * nu^- = n^-, nu^+ = -n^+, n being outward of its own cell; sigma = -1 where
   * the neighbour has the opposite orientation and multiplies all rotations
   * and moments of K^+.
   */
  class ShellEdgeValues
  {
  public:
    explicit ShellEdgeValues(const Discretization &discretization);

    /** As ShellCellValues::use_tip_functions(). */
    void
    use_tip_functions(const bool uses)
    {
      uses_tip_functions_ = uses;
    }

    using cell_iterator = DoFHandler<dim, spacedim>::active_cell_iterator;

    /**
     * The edge between two cells without pieces, arguments as mesh_loop's face
     * worker.
     */
    void
    reinit(const cell_iterator &cell,
           const unsigned int   face,
           const unsigned int   subface,
           const cell_iterator &neighbor,
           const unsigned int   neighbor_face,
           const unsigned int   neighbor_subface);

    /** One edge of one cell without pieces. */
    void
    reinit(const cell_iterator &cell, const unsigned int face);

    /** A piece of an edge, with one or two sides. */
    void
    reinit(const EdgePiece &piece);

    /** One of CellParts::lips(): one side, without a face. */
    void
    reinit_lip(const CellPart &part, const CutLip &lip);

    /**
     * Call @p use(*this) for each piece of the edge that @p cell shares with an
     * active neighbour of its size or coarser; never on the boundary and
     * where finer neighbours meet the edge from their side. Over all cells
     * that a rank owns, all ranks together meet every interior edge, hanging
     * ones included.
     */
    template <typename Function>
    void
    for_pieces_to_neighbor(const cell_iterator &cell,
                           const unsigned int   face,
                           const Function      &use);

    unsigned int
    n_sides() const
    {
      return n_sides_;
    }

    unsigned int
    n_points() const
    {
      return rule().size();
    }

    /** Those that aren't scalars; these are among the shapes(). */
    unsigned int
    n_tip_functions(const unsigned int side) const
    {
      return tip_dofs_[side].size();
    }

    /** psi_k of a side's part at the point @p q. */
    const FieldDerivatives &
    tip_function(const unsigned int side,
                 const unsigned int q,
                 const unsigned int k) const
    {
      return tip_functions_[side][q * tip_dofs_[side].size() + k];
    }

    /** Index within dof_indices() of a side's function psi_k. */
    unsigned int
    tip_dof(const unsigned int side, const unsigned int k) const
    {
      return tip_dofs_[side][k];
    }

    /** Dofs of the cells of all sides, shared ones once. */
    unsigned int
    n_dofs() const
    {
      return dof_indices_.size();
    }

    const std::vector<types::global_dof_index> &
    dof_indices() const
    {
      return dof_indices_;
    }

    /** Length element times weight (length). */
    double
    JxW(const unsigned int q) const
    {
      return JxW_[q];
    }

    /** Position (length), and the region of the cell of the side. */
    SectionPoint
    point(const unsigned int q, const unsigned int side = 0) const
    {
      return {geometry_[side].position(q), material_ids_[side]};
    }

    const SurfaceFrame<> &
    frame(const unsigned int side, const unsigned int q) const
    {
      return frames_[side][q];
    }

    /** nu of the side, at the point @p q: nu^- = n^-, nu^+ = -n^+. */
    const Tensor<1, spacedim> &
    conormal(const unsigned int side, const unsigned int q) const
    {
      return conormals_[side][q];
    }

    /**
     * +1 for the side 0 and a neighbour of the same orientation, -1 for a
     * neighbour of the opposite one:
     * sigma = sign[(nu^+ x t0^+) . (nu^- x t0^-)].
     */
    double
    sigma(const unsigned int side, const unsigned int q) const;

    const ShapeTable &
    shapes(const unsigned int side) const
    {
      return table_of(side).shapes;
    }

    /** The edge's points in the reference cell of a side. */
    const std::vector<Point<dim>> &
    unit_points(const unsigned int side) const
    {
      return table_of(side).points;
    }

    /** Its cell's face that a side lies on. */
    unsigned int
    face(const unsigned int side) const
    {
      return table_of_side_[side].first;
    }

    /** The part of a side. */
    const CellPart &
    part(const unsigned int side) const
    {
      return parts_[side];
    }

    /**
     * @name Membrane strains at the points of the edge
     *
     * They are tied as those of ShellCellValues: interpolated on whole cells,
     * projected on parts of divided ones, and those of the displacement itself
     * on parts with tip functions. Only sections that couple membrane and
     * bending want them: all is computed when it is first asked for after
     * reinit().
     */
    //@{
    /**
     * Rows of a side, [3 q + v][3 a + c]: Voigt component v at the point q of
     * the displacement e_c of the node a. Tip functions that aren't scalars
     * have the strain of the displacement.
     */
    const FullMatrix<double> &
    tied_membrane_rows(const unsigned int side) const;

    /** Where the strain is sampled, and what a side's points take of it. */
    const MembraneTying &
    tying(const unsigned int side) const;

    /** Shape functions at the tying points of a side. */
    const ShapeTable &
    tying_shapes(const unsigned int side) const
    {
      return tying_table(side).shapes;
    }

    /** Frames at the tying points of a side, without second derivatives. */
    const std::vector<SurfaceFrame<>> &
    tying_frames(const unsigned int side) const;
    //@}

    /** Index within dof_indices() of a side's shape function and component. */
    unsigned int
    dof(const unsigned int side,
        const unsigned int a,
        const unsigned int c) const
    {
      return joint_dofs_[side][spacedim * a + c];
    }

  private:
    /** Points of one position of an edge in the reference cell. */
    struct Table
    {
      Table(const Discretization          &discretization,
            const std::vector<Point<dim>> &points);

      std::vector<Point<dim>> points;
      ShapeTable              shapes;
      GeometryTable           geometry;
    };

    /** What belongs to the tied strains of one side. */
    struct TiedSide
    {
      /** Those of a piece; the table is that of a part of a divided cell. */
      std::optional<MembraneTying> tying;
      std::optional<Table>         table;
      bool                         has_frames = false;
      bool                         has_rows   = false;
      std::vector<SurfaceFrame<>>  frames;
      FullMatrix<double>           rows;
      FullMatrix<double>           samples;
      GeometryTable::Values        geometry;
    };

    /** The tip functions of the part that are in use. */
    const PartEnrichment *
    enrichment_of(const CellPart &part) const
    {
      return uses_tip_functions_ ? part.enrichment() : nullptr;
    }

    void
    make_directions();

    /** Of tables_; this one stands for piece_tables_. */
    static constexpr unsigned int piece_kind = 4;

    /** The table, made when it is first asked for. */
    const Table &
    table(const unsigned int face, const unsigned int kind);

    const Table &
    table_of(const unsigned int side) const
    {
      const auto [face, kind] = table_of_side_[side];
      return kind == piece_kind ? *piece_tables_[side] : *tables_[face][kind];
    }

    /** That of the tying points of a side. */
    const Table &
    tying_table(const unsigned int side) const;

    /** tying() of a side that is a piece. */
    const MembraneTying &
    piece_tying(const unsigned int side) const;

    /** The part of a side, and the table of the edge or its half. */
    void
    update_side(const unsigned int side,
                const CellPart    &part,
                const unsigned int face,
                const unsigned int subface);

    /** The part of a side, and a table of the interval. */
    void
    update_side(const unsigned int side, const EdgePiece::Side &piece);

    /**
     * Frames, conormals and lengths at the points of the side's table.
     * @param along the edge in the reference cell, its length included
     * @param outward whether along x normal points outward (+1) or inward (-1)
     * @param share of the edge
     * @param is_lip whether along is CutLip::along
     */
    void
    evaluate(const unsigned int    side,
             const Tensor<1, dim> &along,
             const double          outward,
             const double          share,
             const bool            is_lip = false);

    bool
    reinit_to_neighbor(const cell_iterator &cell, const unsigned int face);

    /** The interval of a whole edge. */
    EdgePiece::Side
    whole_side(const CellPart &part, const unsigned int face) const;

    const Quadrature<1> &
    rule() const
    {
      return tip_rule_ ? *tip_rule_ : quadrature_;
    }

    /** A rule of its own where one of the sides has tip functions. */
    void
    choose_rule(const EdgePiece &piece);

    /** @param tip_rule in place of quadrature_, if it has a value */
    void
    use_rule(const std::optional<Quadrature<1>> &tip_rule);

    void
    resize();

    /**
     * The tip functions of a side, and room for their dofs.
     * @param lip as PartEnrichment::evaluate()
     */
    void
    evaluate_tip_functions(const unsigned int side, const Tensor<1, dim> &lip);

    /** Number the dofs of both sides, shared ones once. */
    void
    join_dofs();

    /** Number those of the tips on the side 1. */
    void
    join_tip_dofs();

    /** Those of scalar functions are dofs of shape functions. */
    void
    move_scalar_dofs();

    const Discretization &discretization_;
    const Quadrature<1>   quadrature_;
    /** In place of it. */
    std::optional<Quadrature<1>> tip_rule_;
    bool                         uses_tip_functions_ = true;
    /** [face][subface 0, subface 1, whole face, whole face backwards]. */
    std::vector<std::array<std::optional<Table>, 4>> tables_;
    /** Of each face of the reference cell: along it, its length included. */
    std::vector<Tensor<1, dim>> directions_;
    /** Whether direction x normal points outward (+1) or inward (-1). */
    std::vector<double> outward_;

    std::array<std::optional<Table>, 2> piece_tables_;

    unsigned int n_sides_ = 0;
    /** Face and kind of each side's table. */
    std::array<std::pair<unsigned int, unsigned int>, 2> table_of_side_;
    std::array<GeometryTable::Values, 2>                 geometry_;
    std::array<types::material_id, 2>                    material_ids_;
    std::array<std::vector<SurfaceFrame<>>, 2>           frames_;
    std::array<std::vector<Tensor<1, spacedim>>, 2>      conormals_;
    std::vector<double>                                  JxW_;
    std::array<std::vector<unsigned int>, 2>             joint_dofs_;
    std::vector<types::global_dof_index>                 dof_indices_;
    std::array<std::vector<types::global_dof_index>, 2>  cell_dofs_;
    std::array<CellPart, 2>                              parts_;
    std::array<std::vector<unsigned int>, 2>             tip_dofs_;
    std::array<std::vector<FieldDerivatives>, 2>         tip_functions_;
    /** @name For tied strains only; tyings by face and kind of the table */
    //@{
    mutable std::map<std::pair<unsigned int, unsigned int>, MembraneTying>
      tyings_;
    /** Of whole cells, whose tying points are the same. */
    mutable std::optional<Table>    tying_table_;
    mutable std::array<TiedSide, 2> tied_sides_;
    //@}
    /** Index 3 a + c of each local dof. */
    std::vector<unsigned int> local_to_node_;
  };

  template <typename Function>
  void
  ShellEdgeValues::for_pieces_to_neighbor(const cell_iterator &cell,
                                          const unsigned int   face,
                                          const Function      &use)
  {
    const CellParts &parts = discretization_.cell_parts();
    if (parts.has_pieces(cell, face) && !cell->at_boundary(face))
      for (const EdgePiece &piece : parts.pieces_between(cell, face))
        {
          reinit(piece);
          use(*this);
        }
    else if (reinit_to_neighbor(cell, face))
      use(*this);
  }
} // namespace Nacre

#endif
