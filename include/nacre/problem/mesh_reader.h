// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_mesh_reader_h
#define nacre_problem_mesh_reader_h

#include <nacre/base/input_file.h>
#include <nacre/problem/mesh_file.h>

#include <list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace Nacre
{
  /** The text of a mesh file, by words or by lines. */
  class MeshText
  {
  public:
    /** @p content must outlive this. */
    MeshText(const std::string &content, const std::string &path);

    /**
     * Read @p file next, and after its end, which at_end() notices, go on
     * here. Fails if it is being read already.
     */
    void
    include(InputFile file);

    /** Whether nothing but white space is left. */
    bool
    at_end();

    /** Whether line() has something to return, be it an empty line. */
    bool
    has_line() const;

    /** The rest of the current line, trimmed; fails at the end of the file. */
    std::string
    line(const std::string &what);

    /** The next line with something in it, not taken; empty at the end. */
    std::string
    peek_line();

    /**
     * The next word, across lines. @p what is what it should be, for the
     * message at the end of the file.
     */
    std::string
    word(const std::string &what);

    long long
    integer(const std::string &what);

    /** An integer not below zero. */
    std::size_t
    count(const std::string &what);

    /** "nan" and "inf" are numbers here; MeshBuilder refuses them. */
    double
    number(const std::string &what);

    Point<3>
    point(const std::string &what);

    /** Throw "path, line 7: text". */
    [[noreturn]] void
    fail(const std::string &text) const;

    /** "The mesh file 'path', line 7" */
    std::string
    where() const;

    const std::string &
    path() const;

    /** The path of the file that is being read: of one that is included. */
    const std::string &
    source_path() const;

    /** @name Words of a line that was taken */
    //@{
    long long
    to_integer(const std::string &word, const std::string &what) const;

    double
    to_number(const std::string &word, const std::string &what) const;
    //@}

  private:
    void
    skip_white_space();

    /** A file and how far it is read. */
    struct Source
    {
      std::string_view content;
      std::string      path;
      std::size_t      position = 0;
      unsigned int     line     = 1;
      /** Where the line or the word that was taken last is. */
      unsigned int last_line = 1;
    };

    Source &
    source();

    /** The file, the one that it includes, and so on. */
    std::vector<Source> sources_;
    /** Contents of included files. */
    std::list<InputFile> included_;
  };

  /** Shapes of elements, whatever a format calls them. */
  enum class ElementShape
  {
    point,
    line,
    triangle,
    quadrilateral,
    solid,
    other
  };

  struct ElementKind
  {
    ElementShape shape   = ElementShape::other;
    unsigned int n_nodes = 0;
    /** What the format calls it, for messages. */
    std::string name = {};
  };

  /** Sets by name, in the order in which they were begun. */
  class MeshSets
  {
  public:
    void
    add(const std::string &name, const unsigned int member);

    /** All sets that have members, which are sorted and unique. */
    std::vector<MeshFile::Set>
    finish();

  private:
    std::vector<MeshFile::Set>                   sets_;
    std::unordered_map<std::string, std::size_t> indices_;
  };

  /** Collects what a reader finds, with the numbers of the file. */
  class MeshBuilder
  {
  public:
    explicit MeshBuilder(const MeshText &text);

    void
    add_node(const long long number, const Point<3> &position);

    /** The position of a node that was added, else nothing. */
    std::optional<Point<3>>
    find_node(const long long number) const;

    /**
     * @param nodes numbers of the nodes: corners counterclockwise, then the
     *        middles of the sides from the first side on, then the centre.
     *        Solid cells are refused.
     * @param sets names of the sets that hold it. A point is no element of the
     *        mesh: its node enters sets of nodes.
     */
    void
    add_element(const long long                 number,
                const ElementKind              &kind,
                const std::vector<long long>   &nodes,
                const std::vector<std::string> &sets);

    /** Put the element that was added last into further sets. */
    void
    add_to_last_element(const std::vector<std::string> &sets);

    /** The mesh; nodes may be added after the elements that use them. */
    MeshFile
    finish();

  private:
    unsigned int
    node_index(const long long number, const std::string &user) const;

    struct RawElement
    {
      long long                number;
      ElementKind              kind;
      std::vector<long long>   nodes;
      std::vector<std::string> sets;
    };

    const MeshText                             &text_;
    MeshFile                                    mesh_;
    std::unordered_map<long long, unsigned int> node_indices_;
    std::vector<RawElement>                     elements_;
    std::unordered_map<long long, std::size_t>  element_indices_;
  };

  /** Names of the sets of an element in formats that number its group. */
  std::vector<std::string>
  group_names(const long long group);

  /**
   * Throw what to do with a file of another format that meshes come in, if
   * @p file is one.
   */
  void
  refuse_other_formats(const InputFile &file);

  /**
   * Make triangles of quadrilaterals with two neighbouring corners in one, if
   * all cells are such; refuse the mesh if some are.
   */
  void
  make_triangles_of_collapsed_cells(MeshFile &mesh);

  /** @name Readers of one format each */
  //@{
  MeshFile
  read_gmsh_mesh(MeshText &text);

  MeshFile
  read_vtk_mesh(MeshText &text);

  /** @p open reads the files that the mesh includes. */
  MeshFile
  read_abaqus_mesh(MeshText &text, const OpenFile &open);

  MeshFile
  read_ucd_mesh(MeshText &text);
  //@}
} // namespace Nacre

#endif
