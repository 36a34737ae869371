// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_mesh_file_h
#define nacre_problem_mesh_file_h

#include <nacre/base/input_file.h>
#include <nacre/base/types.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * A surface mesh as a file describes it. A cell, a line, a side and a node
   * may be in any number of named sets; a set that no parameter names has no
   * meaning. Sets are in the order of the file, names are unique among the
   * sets of one kind, members are sorted and unique.
   */
  struct MeshFile
  {
    /** A cell, or a line. */
    struct Element
    {
      /** The file's number of it. */
      long long number = 0;
      /**
       * Indices into nodes. Cells: in the order of CoarseCell; 3, 4, 6, 8 (no
       * centre) or 9. Lines: the ends, and the middle if there is one.
       */
      std::vector<unsigned int> nodes;
      /** Index into instances, if there are any. */
      unsigned int instance = 0;
    };

    /** A named set of cells, of lines or of nodes. */
    struct Set
    {
      std::string               name;
      std::vector<unsigned int> members;
    };

    /** A named set of sides of cells. */
    struct SideSet
    {
      std::string name;
      /**
       * Cell and side. The file counts the sides of a cell counterclockwise,
       * side s from its corner s to s + 1: that is CoarseCell::sides()[s], as
       * long as nobody has turned the cell over.
       */
      std::vector<std::pair<unsigned int, unsigned int>> sides;
    };

    /** For messages. */
    std::string path;

    std::vector<Point<3>> nodes;
    /** The file's numbers of the nodes; those of two instances may agree. */
    std::vector<long long> node_numbers;
    std::vector<Element>   cells;
    std::vector<Element>   lines;

    /** Regions. */
    std::vector<Set> cell_sets;
    std::vector<Set> line_sets;
    /** A set of nodes stands for the boundary lines between them. */
    std::vector<Set>     node_sets;
    std::vector<SideSet> side_sets;
    /** Whether "ROOT" and "Root" are one name, as in Abaqus. */
    bool names_ignore_case = false;

    /** Names of the instances of parts, where there are several. */
    std::vector<std::string> instances;

    /**
     * What the reader left out or changed, a sentence each: "3 elements of
     * the type B31 (beams) are left out, with their stiffness."
     */
    std::vector<std::string> notes;

    /** "node 17 at (0, 0.5, 1)" */
    std::string
    describe_node(const unsigned int node) const;

    /** "cell 17", or "cell 17 of 'Plate-1'" where there are instances. */
    std::string
    describe_cell(const unsigned int cell) const;

    /** Corners of a cell: 3 or 4. */
    unsigned int
    n_corners(const unsigned int cell) const;

    /**
     * The points of a cell for CoarseCell; an 8-node cell gets the centre that
     * its functions give.
     */
    std::vector<Point<3>>
    points(const unsigned int cell) const;
  };

  /**
   * How to read a file that a mesh file includes: its name, relative to the
   * folder of the file that includes it or to the current one, that folder,
   * and the place that names it, for messages. All ranks call it.
   */
  using OpenFile = std::function<InputFile(const std::string &name,
                                           const std::string &folder,
                                           const std::string &where)>;

  /**
   * The mesh in a @p file; the format is recognised by the content: gmsh .msh
   * 2 and 4.1, VTK legacy, Abaqus .inp, UCD (AVS), as text. Throws an
   * ExcMessage with the path and the line for what isn't in the format, and
   * with the number of the element or node for solid cells, cells of higher
   * degree, nodes that aren't defined or are twice, coordinates that aren't
   * finite.
   */
  MeshFile
  read_mesh(const InputFile &file, const OpenFile &open);
} // namespace Nacre

#endif
