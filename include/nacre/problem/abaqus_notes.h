// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_abaqus_notes_h
#define nacre_problem_abaqus_notes_h

#include <nacre/problem/abaqus_deck.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Nacre::Abaqus
{
  /** What a reader of decks leaves out or changes. */
  class DeckNotes
  {
  public:
    /** Look for constraints and offsets, which aren't read. */
    void
    see_keyword(const Keyword &keyword);

    void
    leave_out_element(const DeckElement &type);

    /** Its stiffness is left out. */
    void
    add_line(const DeckElement &type);

    void
    leave_out_surface(const std::string &name);

    void
    move_node();

    void
    convert_node();

    /** A sentence for each kind of thing: MeshFile::notes. */
    std::vector<std::string>
    sentences() const;

  private:
    /** How many elements there are of each type, by its name. */
    using Counts = std::map<std::string, std::pair<DeckElement, std::size_t>>;

    static void
    add(const DeckElement &type, Counts &counts);

    Counts                left_out_, lines_;
    std::set<std::string> constraints_, surfaces_;
    std::size_t           n_moved_        = 0;
    std::size_t           n_cylindrical_  = 0;
    std::size_t           n_with_offsets_ = 0;
  };
} // namespace Nacre::Abaqus

#endif
