// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_midsurface_h
#define nacre_problem_midsurface_h

#include <nacre/base/mesh_region.h>
#include <nacre/base/types.h>
#include <nacre/problem/imperfection.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>

#include <deal.II/distributed/tria_base.h>

#include <deal.II/grid/reference_cell.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace Nacre
{
  class ParametricSurface;
  struct SurfaceDescription;

  /**
   * The mid-surface phi0 of the shell: a coarse mesh in a chart and the map
   * from the chart to space, built in or read from a mesh file. For triangles
   * each coarse quadrilateral is cut along a diagonal.
   *
   * The mesh is only a topology. The position of any point of any descendant
   * cell follows from the coarse cell, the path of children down to the cell,
   * and the exact map, so that refinement puts new nodes on the exact surface
   * and needs neither a manifold nor a pull-back.
   */
  class Midsurface
  {
  public:
    /**
     * @param surface a surface that has passed the checks
     * @param name what messages call it
     */
    explicit Midsurface(std::unique_ptr<const ParametricSurface> surface,
                        const std::string &name = "surface");

    /** Throws as ParametricSurface does for a @p description that is wrong. */
    explicit Midsurface(SurfaceDescription &&description,
                        const std::string   &name = "surface");

    Midsurface(Midsurface &&) noexcept;
    Midsurface &
    operator=(Midsurface &&) noexcept;
    ~Midsurface();

    /**
     * The mesh of the mid-surface of cells like @p reference_cell, refined
     * @p n_refinements times, with the boundary ids of edge_names() and the
     * material ids of regions(): quadrilaterals on p4est, triangles on a
     * mesh that all ranks know. Triangles of a file can't be quadrilaterals:
     * that throws.
     */
    std::unique_ptr<parallel::TriangulationBase<dim, spacedim>>
    create_triangulation(const MPI_Comm       communicator,
                         const ReferenceCell &reference_cell,
                         const unsigned int   n_refinements) const;

    /**
     * Move the surface by an @p imperfection, null: none. Its new shape is
     * without stress.
     */
    void
    set_imperfection(std::unique_ptr<const Imperfection> imperfection);

    /** The content of the files of the imperfection; empty without any. */
    std::string
    imperfection_files() const
    {
      return imperfection_ == nullptr ? "" : imperfection_->content;
    }

    /**
     * phi0 (length) at the point @p unit of the reference cell of @p cell, on
     * the exact surface, with its imperfection.
     */
    Point<spacedim>
    position(const Triangulation<dim, spacedim>::cell_iterator &cell,
             const Point<dim>                                  &unit) const;

    /**
     * Whether the surface lies over a rectangle of parameters (u, v), as its
     * documentation describes them. Others have charts of their own making.
     */
    bool
    has_chart() const;

    /** The chart point (u, v, 0) there, for surfaces that have a chart. */
    Point<spacedim>
    chart(const Triangulation<dim, spacedim>::cell_iterator &cell,
          const Point<dim>                                  &unit) const;

    /**
     * The period of u and of v for surfaces that have a chart; 0 where the
     * surface isn't closed.
     */
    std::array<double, 2>
    chart_periods() const;

    /** A name of the sides of each boundary id, which is the index. */
    const std::vector<std::string> &
    edge_names() const;

    /**
     * Tell the names of the edges that conditions and loads use, in double
     * quotes or not: the edge 'boundary' of a mesh file is what they leave.
     * Called before edge_ids().
     */
    void
    use_edges(const std::vector<std::string> &names);

    /**
     * The boundary ids of the edge @p name, which may be in double quotes: a
     * side of the boundary may have several names, and an id stands for the
     * sides of one combination of names. An unknown name throws and lists the
     * near ones. @p where is the parameter that mentions it.
     */
    std::set<types::boundary_id>
    edge_ids(const std::string &name, const std::string &where) const;

    /** A side of the boundary with the boundary id @p id, for messages. */
    std::string
    describe_side(const types::boundary_id id) const;

    /** The regions of cells, by material id; the first has no name. */
    const MeshRegions &
    regions() const;

    /**
     * What a run should tell about the surface and its edges in use, a sentence
     * each.
     */
    std::vector<std::string>
    notes() const;

    /** Whether the coarse cells are triangles. */
    bool
    has_triangles() const;

  private:
    /** A point of a coarse cell, in which descendants' points are told. */
    struct CoarsePoint
    {
      /** Index of the coarse cell of the mesh. */
      unsigned int cell;
      /** Whether it is half of the surface's. */
      bool       is_half;
      Point<dim> unit;
    };

    CoarsePoint
    coarse_point(const Triangulation<dim, spacedim>::cell_iterator &cell,
                 const Point<dim>                                  &unit) const;

    /** Without the imperfection, in the coarse cell number @p cell. */
    Point<spacedim>
    perfect_position(const unsigned int cell,
                     const bool         is_half,
                     const Point<dim>  &unit) const;

    /** Its unit normal there. */
    Tensor<1, spacedim>
    perfect_normal(const unsigned int cell,
                   const bool         is_half,
                   const Point<dim>  &unit) const;

    /** Whether the edge number @p edge of the surface has the @p name. */
    bool
    has_name(const unsigned int edge, const std::string &name) const;

    /** Whether no name in use but that of the rest holds the edge. */
    bool
    is_left(const unsigned int edge) const;

    /** Names of the edges, then that of the rest, quoted where they must be. */
    std::vector<std::string>
    known_edges() const;

    /** The message for a @p name that is no edge. */
    std::string
    unknown_edge(const std::string &name, const std::string &where) const;

    /** Not null. */
    std::unique_ptr<const ParametricSurface> surface_;
    std::string                              name_;
    /** Null: none. */
    std::unique_ptr<const Imperfection> imperfection_;
    /** How each coarse quadrilateral is cut for triangles. */
    std::vector<unsigned int> diagonals_;
    std::vector<std::string>  edge_names_;
    /** Names of the edges that conditions and loads use. */
    std::set<std::string> edges_in_use_;
  };

  /** The section Mid-surface of a parameter file. */
  class MidsurfaceParameters : public ParameterAcceptor
  {
  public:
    MidsurfaceParameters();

    /**
     * How make() reads a mesh file: on rank 0 of @p communicator, a relative
     * name from the @p folder of the parameter file. Without this call every
     * process reads for itself.
     */
    void
    set_files(const MPI_Comm communicator, const std::string &folder);

    /**
     * The chosen surface. Throws for an unknown surface, for parameters out of
     * range, for a surface that is degenerate (area Jacobian zero or not
     * finite), and for a file that isn't a good mesh. Collective if the surface
     * is a file's.
     * @param previous what the last call has returned, if it is still there: a
     *   file is not read again for the same constants
     */
    Midsurface
    make(const Constants &constants, std::optional<Midsurface> previous = {});

  private:
    /** Write where the mesh file is into the parameters, for used.prm. */
    void
    fix_file_name() const;

    std::string                surface_name_ = "plate";
    std::string                subdivisions_ = "4, 4";
    std::array<std::string, 2> grading_{{"s", "s"}};
    /** Texts of the surfaces' own parameters by surface and parameter. */
    std::map<std::string, std::map<std::string, std::string>> values_;

    MPI_Comm    communicator_ = MPI_COMM_SELF;
    std::string folder_;

    ImperfectionParameters imperfection_;
    /** With what the last surface of a file was built. */
    std::optional<Constants> constants_of_file_;
  };
} // namespace Nacre

#endif
