// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/abaqus_notes.h>

namespace Nacre::Abaqus
{
  namespace
  {
    /** "3 elements of the type B31 (beams)" */
    std::string
    describe(const std::pair<DeckElement, std::size_t> &count)
    {
      const auto &[type, n] = count;
      return std::to_string(n) + (n == 1 ? " element" : " elements") +
             " of the type " + type.kind.name + " (" + type.plural + ")";
    }

    std::string
    join(const std::set<std::string> &names)
    {
      std::string text;
      for (const std::string &name : names)
        text += (text.empty() ? "" : ", ") + name;
      return text;
    }
  } // namespace


  void
  DeckNotes::see_keyword(const Keyword &keyword)
  {
    for (const std::string constraint : {"*RIGID BODY",
                                         "*EQUATION",
                                         "*MPC",
                                         "*TIE",
                                         "*COUPLING",
                                         "*DISTRIBUTING COUPLING",
                                         "*KINEMATIC COUPLING",
                                         "*EMBEDDED ELEMENT",
                                         "*SHELL TO SOLID COUPLING"})
      if (keyword.name == Keyword(constraint).name)
        constraints_.insert(constraint);
    if (keyword.name == "*SHELLSECTION" && keyword.has("OFFSET"))
      ++n_with_offsets_;
  }


  void
  DeckNotes::add(const DeckElement &type, Counts &counts)
  {
    ++counts.emplace(type.kind.name, std::make_pair(type, 0))
        .first->second.second;
  }


  void
  DeckNotes::leave_out_element(const DeckElement &type)
  {
    add(type, left_out_);
  }


  void
  DeckNotes::add_line(const DeckElement &type)
  {
    add(type, lines_);
  }


  void
  DeckNotes::leave_out_surface(const std::string &name)
  {
    surfaces_.insert("'" + name + "'");
  }


  void
  DeckNotes::move_node()
  {
    ++n_moved_;
  }


  void
  DeckNotes::convert_node()
  {
    ++n_cylindrical_;
  }


  std::vector<std::string>
  DeckNotes::sentences() const
  {
    std::vector<std::string> result;
    for (const auto &[name, count] : left_out_)
      result.push_back(describe(count) + (count.second == 1 ? " is" : " are") +
                       " left out, with what the deck says of " +
                       (count.second == 1 ? "it." : "them."));
    for (const auto &[name, count] : lines_)
      result.push_back(describe(count) + " can name edges; " +
                       (count.second == 1 ? "its" : "their") +
                       " stiffness is left out.");
    if (!constraints_.empty())
      result.push_back("The constraints of the deck are left out: " +
                       join(constraints_) + ".");
    if (!surfaces_.empty())
      result.push_back("Surfaces that aren't made of faces or nodes are left "
                       "out: " +
                       join(surfaces_) + ".");
    if (n_with_offsets_ > 0)
      result.push_back("The OFFSET of *SHELL SECTION is left out: the nodes "
                       "lie in the mid-surface.");
    if (n_moved_ > 0)
      result.push_back("*SYSTEM moves " + std::to_string(n_moved_) +
                       " nodes from a local system to x, y, z.");
    if (n_cylindrical_ > 0)
      result.push_back(std::to_string(n_cylindrical_) +
                       " nodes are given in cylindrical coordinates.");
    return result;
  }
} // namespace Nacre::Abaqus
