// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_discretization_h
#define nacre_discretization_discretization_h

#include <nacre/discretization/cut_trace.h>
#include <nacre/discretization/part_extension.h>
#include <nacre/discretization/tip_openings.h>
#include <nacre/problem/element.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/index_set.h>

#include <deal.II/distributed/tria_base.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Nacre
{
  class Midsurface;

  /** A point of the discrete mid-surface, found by Discretization::locate(). */
  struct SurfacePoint
  {
    /** Whether the cell is this rank's. */
    bool is_mine = false;
    /** The cell or its part, valid where is_mine. */
    CellPart part;
    /** Coordinates in the reference cell, valid where is_mine. */
    Point<dim> unit;
    /** Nearest point of the mid-surface (length), valid on all ranks. */
    Point<spacedim> position;
    /** Distance from the point asked for (length), valid on all ranks. */
    double distance = 0.;
    /** Diameter of the cell (length), valid on all ranks. */
    double cell_diameter = 0.;
  };

  /**
   * One mesh of the mid-surface with its isoparametric geometry (18) and its
   * displacement space: three components of an Element, continuous
   * displacements, discontinuous rotations.
   *
   * The geometry is a field on the mesh with the hanging-node constraints
   * applied, so that it is continuous across hanging edges too, and the rigid
   * motions lie in the displacement space if the mapping's degree is at most
   * that of the element.
   *
   * Cuts divide cells into parts, each with the whole space of its cell, (C.1)
   * of doc/cutting.md. Everything that happens on cells happens on the
   * owned_parts(): without cuts, these are the cells.
   */
  class Discretization
  {
  public:
    /**
     * @param mapping_degree degree of the geometry; 0 means isoparametric,
     *   which is the only choice for cells other than Lagrange ones, and for
     *   all cells if there are @p cuts
     */
    Discretization(const Midsurface  &midsurface,
                   const MPI_Comm     communicator,
                   const Element     &element,
                   const unsigned int mapping_degree,
                   const unsigned int n_refinements);

    /** Take over a mesh of @p midsurface, and divide its cells by @p cuts. */
    Discretization(
      std::unique_ptr<parallel::TriangulationBase<dim, spacedim>> triangulation,
      const Midsurface                                           &midsurface,
      const Element                                              &element,
      const unsigned int mapping_degree,
      const Cuts        &cuts);

    /**
     * Take over a mesh that is no Midsurface's. @p position gives the positions
     * of the nodes of the geometry (on a mesh of one rank, ordered as @p
     * dof_handler's support points), as for MappingQCache.
     */
    Discretization(
      std::unique_ptr<parallel::TriangulationBase<dim, spacedim>> triangulation,
      const std::function<
        Point<spacedim>(const Triangulation<dim, spacedim>::cell_iterator &,
                        const Point<dim> &)> &position,
      const Element                          &element,
      const unsigned int                      mapping_degree);

    const Element &
    element() const
    {
      return element_;
    }

    /** Degree p of the displacements. */
    unsigned int
    degree() const
    {
      return element_.degree;
    }

    MPI_Comm
    communicator() const;

    const parallel::TriangulationBase<dim, spacedim> &
    triangulation() const;

    const Mapping<dim, spacedim> &
    mapping() const;

    /**
     * The displacement space without cuts, FESystem(scalar_fe(), 3). With cuts
     * its numbers of dofs are not those of get_dof_indices().
     */
    const DoFHandler<dim, spacedim> &
    dof_handler() const;

    /** @name Cells and their parts */
    //@{
    /** Which parts cuts make of the cells, and where these meet. */
    const CellParts &
    cell_parts() const
    {
      return parts_;
    }

    /** This rank's cells; of divided ones all parts. */
    const std::vector<CellPart> &
    owned_parts() const
    {
      return owned_parts_;
    }

    /** Those, and the parts of ghosts. */
    std::vector<CellPart>
    relevant_parts() const;

    /** The dofs of a part, in the order of the element; those of tip functions
     * follow. */
    void
    get_dof_indices(const CellPart                       &part,
                    std::vector<types::global_dof_index> &dofs) const;

    /** One more than the largest CellPart::index(). */
    unsigned int
    n_part_indices() const
    {
      return parts_.is_empty() ? triangulation_->n_active_cells() :
                                 parts_.n_indices();
    }

    types::global_dof_index
    n_dofs() const
    {
      return numbering_->n_dofs();
    }

    /** Whether the part is so small that it follows a larger one. */
    bool
    is_small(const CellPart &part) const
    {
      return part.data != nullptr && part.data->fraction < smallest_part_;
    }

    /** Whether tips of cuts have functions, PartEnrichment. */
    bool
    has_tip_functions() const
    {
      return tip_patches_ != nullptr || tip_openings_ != nullptr;
    }

    const SplitNodes &
    split_nodes() const
    {
      return numbering_->split_nodes();
    }

    /** Whether the discrete crack ends at @p tip, not at its cell's edge. */
    bool
    opens_tip(const CutTrace::Tip &tip) const
    {
      return tip_patches_ != nullptr ||
             (tip_openings_ != nullptr && tip_openings_->opens(tip));
    }

    /** Of tips that have branch functions; null: none. */
    const TipPatches *
    tip_patches() const
    {
      return tip_patches_.get();
    }

    /** Of tips that harmonic functions should open; null: none. */
    const TipOpenings *
    tip_openings() const
    {
      return tip_openings_.get();
    }

    /** The cuts in this rank's cells, each piece once (length). */
    const std::vector<CutTrace::Line> &
    cut_lines() const
    {
      return cut_lines_;
    }

    /** The ends of cuts inside the surface, the same on all ranks. */
    const std::vector<CutTrace::Tip> &
    tips() const
    {
      return tips_;
    }
    //@}

    /** The scalar element whose nodes carry the displacements. */
    const FiniteElement<dim, spacedim> &
    scalar_fe() const;

    /** The scalar element of the geometry (18). */
    const FiniteElement<dim, spacedim> &
    geometry_fe() const
    {
      return geometry_fe_.base_element(0);
    }

    /**
     * Positions X0 (length) of the nodes of geometry_fe() on an active cell or
     * a part of it that this rank owns or has as a ghost:
     * phi0 = sum_b N^b X0^b (18).
     */
    ArrayView<const Point<spacedim>>
    geometry_nodes(const CellPart &part) const
    {
      if (part.data != nullptr && !part.data->nodes.empty())
        return {part.data->nodes.data(), part.data->nodes.size()};
      const std::size_t n = geometry_to_nodes_.n();
      return {geometry_nodes_.data() + part.cell->active_cell_index() * n, n};
    }

    /** The nodes a of the local edge @p face of any cell. */
    const std::vector<unsigned int> &
    face_nodes(const unsigned int face) const
    {
      return face_nodes_[face];
    }

    /** Local dof of the component c of the node a: index 3 a + c. */
    const std::vector<unsigned int> &
    node_dofs() const
    {
      return node_dofs_;
    }

    /**
     * Local dof of the component @p c of the shape function @p a, that of a
     * node or one of the scalar functions of tips, which follow them.
     */
    unsigned int
    local_dof(const unsigned int a, const unsigned int c) const
    {
      const unsigned int k = spacedim * a + c;
      return k < node_dofs_.size() ? node_dofs_[k] : k;
    }

    const IndexSet &
    locally_owned_dofs() const;

    const IndexSet &
    locally_relevant_dofs() const;

    /** Nodes that follow others: hanging ones, and those of small parts. */
    const AffineConstraints<double> &
    node_constraints() const;

    /** The longest edge of a cell, from vertex to vertex (length). */
    double
    longest_edge(const CellPart::Cell &cell) const;

    /** A point inside of @p part (length). */
    Point<spacedim>
    point_inside(const CellPart &part) const;

    /** Positions (length) of the displacement nodes of @p part. */
    std::vector<Point<spacedim>>
    node_positions(const CellPart &part) const;

    /**
     * The point of the mid-surface nearest to @p point, in the lowest of the
     * cells that share it; collective. Throws for a point off the mid-surface
     * and for one at both lips of a slit, unless this is a coarse level.
     * @param source begins the messages
     */
    SurfacePoint
    locate(const Point<spacedim> &point, const std::string &source) const;

    /** The same without any check: at a slit, on the lip of the lowest cell. */
    SurfacePoint
    nearest(const Point<spacedim> &point) const;

    /**
     * Mark the mesh as a coarser level of another one. Here locate() takes the
     * nearest point: the finest level has checked what the user states.
     */
    void
    set_coarse_level()
    {
      is_coarse_level_ = true;
    }

    bool
    is_coarse_level() const
    {
      return is_coarse_level_;
    }

    /**
     * Extent of the mid-surface: the diagonal of its bounding box (length),
     * and the box' centre.
     */
    std::pair<Point<spacedim>, double>
    extent() const;

    /**
     * Give the mesh away. The caller may refine it, but only after this object
     * has been destroyed, and may call nothing else of this object.
     */
    std::unique_ptr<parallel::TriangulationBase<dim, spacedim>>
    release_triangulation()
    {
      return std::move(triangulation_);
    }

  private:
    void
    build_geometry(const std::function<Point<spacedim>(
                     const Triangulation<dim, spacedim>::cell_iterator &,
                     const Point<dim> &)> &position,
                   const unsigned int      mapping_degree);

    /** Fill geometry_nodes_ from geometry_. */
    void
    store_geometry_nodes();

    /** Divide the cells. */
    void
    cut(const Midsurface &midsurface, const Cuts &cuts);

    /** Take away the pieces of the cut shell that hold @p points (length). */
    void
    remove(const std::vector<Point<spacedim>> &points);

    /** The functions of tips, of whatever kind; null: none. */
    TipDofs *
    tip_dofs() const;

    MeshNodes
    mesh_nodes() const;

    /** Number the dofs of all parts. */
    void
    number_dofs(const bool extends_parts = true);

    /**
     * Set node_constraints_ of a mesh with cuts.
     * @param extends_parts whether small parts follow larger ones
     */
    void
    constrain_parts(const bool extends_parts);

    std::unique_ptr<parallel::TriangulationBase<dim, spacedim>> triangulation_;

    const Element                                       element_;
    const std::unique_ptr<FiniteElement<dim, spacedim>> scalar_fe_;
    const std::vector<std::vector<unsigned int>>        face_nodes_;
    FESystem<dim, spacedim>                             fe_;
    DoFHandler<dim, spacedim>                           dof_handler_;
    std::vector<unsigned int>                           node_dofs_;

    CellParts                      parts_;
    double                         smallest_part_ = 0.;
    std::vector<CutTrace::Line>    cut_lines_;
    std::vector<CutTrace::Tip>     tips_;
    std::unique_ptr<TipPatches>    tip_patches_;
    std::unique_ptr<TipOpenings>   tip_openings_;
    std::unique_ptr<PartNumbering> numbering_;
    AffineConstraints<double>      node_constraints_;
    std::vector<CellPart>          owned_parts_;

    FESystem<dim, spacedim>                    geometry_fe_;
    DoFHandler<dim, spacedim>                  geometry_dof_handler_;
    LinearAlgebra::distributed::Vector<double> geometry_;
    /** By active cell index and node of the geometry. */
    std::vector<Point<spacedim>> geometry_nodes_;
    /** Geometry's shape functions at the displacement nodes. */
    FullMatrix<double>                      geometry_to_nodes_;
    std::unique_ptr<Mapping<dim, spacedim>> mapping_;
    bool                                    is_coarse_level_ = false;
  };
} // namespace Nacre

#endif
