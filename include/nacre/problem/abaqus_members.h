// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_abaqus_members_h
#define nacre_problem_abaqus_members_h

#include <nacre/problem/abaqus_deck.h>

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

/** Members of the sets of decks, as indices in the whole mesh. */
namespace Nacre::Abaqus
{
  /** The nodes and elements of a part, and where its numbers are. */
  struct PartMesh
  {
    MeshFile                                    mesh;
    std::unordered_map<long long, unsigned int> nodes, cells, lines;

    explicit PartMesh(Part &part);
  };

  /** An instance of a part, or the assembly; where its mesh begins. */
  struct Scope
  {
    std::string     name;
    const Part     *part;
    const PartMesh *mesh;
    unsigned int    first_node, first_cell, first_line;
  };

  /** Indices in the whole mesh. */
  struct Members
  {
    std::vector<unsigned int> nodes, cells, lines;

    void
    append(const Members &other);

    /** Sort, and keep one of each. */
    void
    make_unique();
  };

  enum class SetKind
  {
    nodes,
    elements
  };

  /** Finds the members of sets, in any order of their definitions. */
  class SetResolver
  {
  public:
    /** Both may grow until the first set is asked for. */
    SetResolver(const std::vector<Scope> &scopes, const MeshFile &mesh)
      : scopes_(scopes)
      , mesh_(mesh)
    {}

    const Table<Set> &
    sets(const SetKind kind, const unsigned int scope) const;

    const Members &
    members(const SetKind kind, const unsigned int scope, const Set &set);

    /**
     * The members that a word names: a number, the name of a set,
     * "Instance.Set" or "Instance.17". @p instance is that of *NSET or
     * *SURFACE, or empty; @p user the set or surface, for the note.
     */
    Members
    named(const SetKind      kind,
          const unsigned int scope,
          const std::string &instance,
          const std::string &word,
          const std::string &user);

    /** A note of the members that the file doesn't define, or nothing. */
    std::string
    note_of_undefined() const;

  private:
    /** The instance, or the scope itself if no instance is named. */
    std::optional<unsigned int>
    find_scope(const unsigned int scope, const std::string &instance) const;

    void
    add_range(const SetKind      kind,
              const unsigned int scope,
              const Range       &range,
              const std::string &user,
              Members           &result);
    bool
    add_number(const SetKind      kind,
               const unsigned int scope,
               const long long    number,
               Members           &result) const;
    void
    add_name(const SetKind      kind,
             const unsigned int scope,
             const std::string &name,
             const std::string &user,
             Members           &result);
    void
    add_nodes_of_elements(Members &result) const;
    void
    miss(const std::string &user,
         const std::string &what,
         const long long    n = 1);

    const std::vector<Scope>                               &scopes_;
    const MeshFile                                         &mesh_;
    std::map<std::pair<const Set *, unsigned int>, Members> members_;
    /**
     * By the name of the set or surface: how many of its members the file
     * doesn't define, and the first.
     */
    std::map<std::string, std::pair<long long, std::string>> undefined_;
  };
} // namespace Nacre::Abaqus

#endif
