// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_mesh_checks_h
#define nacre_problem_mesh_checks_h

#include <nacre/base/mesh_region.h>
#include <nacre/problem/mesh_file.h>
#include <nacre/problem/parametric_surface.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

/**
 * From a mesh as the file has it to one that a surface can be made of. The
 * order: leave_out_unused_nodes(), merge_nodes(), check_places(),
 * check_cells(), find_sides(), check_hanging_nodes(), find_names(),
 * orient_cells(). All throw an ExcMessage with the file and the numbers of the
 * nodes or cells.
 */
namespace Nacre
{
  /** The end nodes of a side, the smaller index first. */
  using MeshLine = std::pair<unsigned int, unsigned int>;

  /** A side as a cell sees it. */
  struct MeshSide
  {
    unsigned int cell;
    /** Whether the cell goes from the smaller node to the larger. */
    bool forward;
    /** The node in the middle, or invalid_unsigned_int. */
    unsigned int middle;
  };

  /** The cells at each side: two inside, one on the boundary. */
  using MeshSides = std::map<MeshLine, std::vector<MeshSide>>;

  /** Throw "The mesh file 'path': text". */
  [[noreturn]] void
  fail(const MeshFile &mesh, const std::string &text);

  /** "the side between the nodes 1 and 5" */
  std::string
  describe(const MeshFile &mesh, const MeshLine &line);

  /** @name Nodes */
  //@{
  /**
   * Make one node of those at most @p distance (length) apart. Throws if a
   * cell would lose a side.
   */
  void
  merge_nodes(MeshFile &mesh, const double distance);

  /** Note the nodes that belong to no cell, and take them out of the sets. */
  void
  leave_out_unused_nodes(MeshFile &mesh);

  /**
   * Nodes much closer to each other than their cells are large are a seam that
   * isn't merged, along which the surface would gape: that throws, or is noted
   * where @p slits are meant.
   */
  void
  check_places(MeshFile &mesh, const bool slits);

  /**
   * Throws where a node lies on a side of the boundary that isn't its own: a
   * seam of two parts that were meshed differently.
   */
  void
  check_hanging_nodes(const MeshFile &mesh, const MeshSides &sides);
  //@}

  /** @name Cells */
  //@{
  /**
   * Throws for no cells, cells of several kinds, a node twice in a cell, a cell
   * that stands twice, degenerate or folded cells, middles far off their sides.
   */
  void
  check_cells(const MeshFile &mesh);

  /**
   * The sides of all cells; throws where three cells share one or two have
   * different middles.
   */
  MeshSides
  find_sides(const MeshFile &mesh);

  /**
   * Turn cells over until all have one orientation, that of the greater part of
   * the cells, and note how many. Throws for surfaces of one side and for
   * unconnected parts.
   */
  void
  orient_cells(MeshFile &mesh, const MeshSides &sides);
  //@}

  /** What the names in a file mean. */
  struct MeshNames
  {
    /** Of each combination of names on the boundary. */
    std::vector<SurfaceDescription::Edge> edges;
    /** Index into edges of every side of the boundary. */
    std::map<MeshLine, unsigned int> edge_of_line;
    /** Of each combination of names of cells. */
    MeshRegions regions;
    /** Index into regions of every cell. */
    std::vector<unsigned int> region_of_cell;
    EdgeNames                 edge_names;
  };

  /**
   * Resolve the sets of a file, before cells are turned over. Nothing is
   * refused: a set that can't be an edge is told when a parameter names it.
   */
  MeshNames
  find_names(const MeshFile &mesh, const MeshSides &sides);
} // namespace Nacre

#endif
