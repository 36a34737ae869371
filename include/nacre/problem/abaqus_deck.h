// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_abaqus_deck_h
#define nacre_problem_abaqus_deck_h

#include <nacre/base/types.h>
#include <nacre/problem/mesh_reader.h>

#include <array>
#include <list>
#include <map>
#include <set>
#include <string>
#include <vector>

/** Abaqus input files ("decks"): parts, their instances, sets and surfaces. */
namespace Nacre::Abaqus
{
  /** Labels ignore case: they are compared as this. */
  std::string
  upper_case(std::string text);

  /**
   * Words between commas, trimmed and without quotes, in which commas have no
   * meaning; an empty word at the end is left out.
   */
  std::vector<std::string>
  comma_separated(const std::string &line);

  /** Whether a word is the number of a node or element, not a name. */
  bool
  is_number(const std::string &word);

  /** A keyword line: "*NSET, NSET=Root, GENERATE". */
  struct Keyword
  {
    /** In capitals, without blanks: "*ENDPART". */
    std::string name;
    /** Names in capitals, values as they are. */
    std::map<std::string, std::string> parameters;

    explicit Keyword(const std::string &line = "");

    bool
    has(const std::string &parameter) const;

    /** The value of a parameter, or an empty text. */
    std::string
    value(const std::string &parameter) const;
  };

  /** What Nacre makes of elements. */
  enum class ElementUse
  {
    /** A cell of the surface, or an error for solids and unknown types. */
    cell,
    /** A cell if the file has no others: rigid or without stiffness. */
    spare_cell,
    /** It can name an edge; its stiffness is left out. */
    line,
    left_out
  };

  struct DeckElement
  {
    ElementUse  use = ElementUse::cell;
    ElementKind kind;
    /** What the elements are, in the plural: "beams". */
    std::string plural = {};
    /** Plane or axisymmetric: its faces are its sides. */
    bool is_plane = false;
  };

  /** The type of elements by its name in capitals, as "S4R". */
  DeckElement
  element_type(const std::string &name);

  /** A position x becomes rotation*x + shift. */
  struct RigidMotion
  {
    Tensor<2, 3> rotation = unit_symmetric_tensor<3>();
    Tensor<1, 3> shift    = {};

    Point<3>
    operator()(const Point<3> &x) const;
  };

  /**
   * *SYSTEM: the motion that takes the coordinates of a local system to global
   * ones. @p values are the coordinates of the origin, of a point on the local
   * x axis, and of a point in the local x-y plane with y > 0. With the first
   * only, a translation; without the third, the z axis stays. Returns false if
   * the points don't define axes.
   */
  bool
  local_system(const std::vector<double> &values, RigidMotion &motion);

  /**
   * *INSTANCE: a translation, then a rotation by @p turn, two points of an
   * axis and an angle in degrees (may be empty). Returns false if the points
   * don't define an axis.
   */
  bool
  instance_motion(const std::vector<double> &translation,
                  const std::vector<double> &turn,
                  RigidMotion               &motion);

  /** first, first + step, ... up to last. */
  struct Range
  {
    long long first = 0, last = 0, step = 1;
  };

  /** What one keyword adds to a set. */
  struct SetEntry
  {
    /** The instance that the members are of, or empty. */
    std::string        instance;
    std::vector<Range> numbers;
    /** Other sets; for sets of nodes maybe sets of elements. */
    std::vector<std::string> names;
    bool                     of_elements = false;

    void
    add(const long long number);
  };

  struct Set
  {
    /** As the file spells it first. */
    std::string           name;
    std::vector<SetEntry> entries;

    /** A member of *NODE, NSET= or *ELEMENT, ELSET=. */
    void
    add(const long long number);
  };

  /** A line of *SURFACE: elements or a set of them, and the face. */
  struct SurfaceEntry
  {
    /** The instance that the member is of, or empty. */
    std::string instance;
    std::string member;
    /** In capitals: "SPOS", "E1"; or empty. */
    std::string face;
  };

  struct Surface
  {
    std::string               name;
    bool                      of_nodes = false;
    std::vector<SurfaceEntry> entries;
  };

  /** Things with a name, in the order of the file. */
  template <typename Item>
  class Table
  {
  public:
    /** The item @p name, which is added if it isn't there. */
    Item &
    item(const std::string &name)
    {
      const auto [entry, is_new] =
        indices_.emplace(upper_case(name), items_.size());
      if (is_new)
        {
          items_.emplace_back();
          items_.back().name = name;
        }
      return items_[entry->second];
    }

    /** Or nullptr. */
    const Item *
    find(const std::string &name) const
    {
      const auto found = indices_.find(upper_case(name));
      return found == indices_.end() ? nullptr : &items_[found->second];
    }

    const std::vector<Item> &
    items() const
    {
      return items_;
    }

  private:
    std::vector<Item>                  items_;
    std::map<std::string, std::size_t> indices_;
  };

  /** Nodes, elements and sets with numbers of their own. */
  struct Part
  {
    std::string name;
    MeshBuilder mesh;
    /** Numbers of the elements that are left out. */
    std::set<long long> left_out;
    /** Those of plane elements, whose faces are their sides. */
    std::set<long long> plane;
    Table<Set>          node_sets;
    Table<Set>          element_sets;
    Table<Surface>      surfaces;

    Part(const std::string &name, const MeshText &text)
      : name(name)
      , mesh(text)
    {}
  };

  struct Instance
  {
    std::string name;
    std::string part;
    RigidMotion motion;
    /** Line of the keyword, for messages. */
    std::string where;
  };

  struct Deck
  {
    explicit Deck(const MeshText &text)
      : path(text.path())
      , assembly("", text)
    {}

    std::string path;
    /** What stands outside of parts: all, in files that have none. */
    Part                  assembly;
    std::list<Part>       parts;
    std::vector<Instance> instances;
    /** See MeshFile::notes. */
    std::vector<std::string> notes;
  };

  /** Put the instances of the parts together. */
  MeshFile
  assemble(Deck &deck);
} // namespace Nacre::Abaqus

#endif
