// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/problem/mesh_reader.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdlib>

namespace Nacre
{
  namespace
  {
    bool
    is_space(const char c)
    {
      return std::isspace(static_cast<unsigned char>(c)) != 0;
    }

    /** What the shells of ours can't be made of, in plain words. */
    std::string
    refusal(const ElementKind &kind)
    {
      if (kind.shape == ElementShape::solid)
        return "is a solid (" + kind.name +
               "); shells need surface cells: triangles or quadrilaterals. "
               "Save the surface only";
      return "is of the type " + kind.name +
             "; known are lines, triangles with 3 or 6 nodes and "
             "quadrilaterals with 4, 8 or 9";
    }

    bool
    is_known(const ElementKind &kind)
    {
      switch (kind.shape)
        {
          case ElementShape::point:
            return true;
          case ElementShape::line:
            return kind.n_nodes == 2 || kind.n_nodes == 3;
          case ElementShape::triangle:
            return kind.n_nodes == 3 || kind.n_nodes == 6;
          case ElementShape::quadrilateral:
            return kind.n_nodes == 4 || kind.n_nodes == 8 || kind.n_nodes == 9;
          default:
            return false;
        }
    }

    /** From counterclockwise to the order of CoarseCell. */
    const std::vector<unsigned int> &
    node_order(const ElementShape shape)
    {
      static const std::vector<unsigned int> as_it_is = {0, 1, 2, 3, 4, 5};
      static const std::vector<unsigned int> quadrilateral =
        {0, 1, 3, 2, 7, 5, 4, 6, 8};
      return shape == ElementShape::quadrilateral ? quadrilateral : as_it_is;
    }
  } // namespace


  MeshText::MeshText(const std::string &content, const std::string &path)
  {
    sources_.push_back({content, path});
  }


  MeshText::Source &
  MeshText::source()
  {
    return sources_.back();
  }


  void
  MeshText::include(InputFile file)
  {
    for (const Source &open : sources_)
      if (open.path == file.path)
        fail("the file '" + file.path + "' includes itself.");
    included_.push_back(std::move(file));
    sources_.push_back({included_.back().content, included_.back().path});
  }


  void
  MeshText::skip_white_space()
  {
    Source &s = source();
    while (s.position < s.content.size() && is_space(s.content[s.position]))
      if (s.content[s.position++] == '\n')
        ++s.line;
  }


  bool
  MeshText::at_end()
  {
    skip_white_space();
    while (sources_.size() > 1 && !has_line())
      {
        sources_.pop_back();
        skip_white_space();
      }
    source().last_line = source().line;
    return !has_line();
  }


  bool
  MeshText::has_line() const
  {
    return sources_.back().position < sources_.back().content.size();
  }


  std::string
  MeshText::line(const std::string &what)
  {
    if (!has_line())
      fail("the file ends where " + what + " should be: it is truncated.");
    Source           &s   = source();
    const auto        end = s.content.find('\n', s.position);
    const std::string text(s.content.substr(s.position, end - s.position));
    const bool        is_last = end == std::string_view::npos;
    s.position                = is_last ? s.content.size() : end + 1;
    s.last_line               = s.line;
    s.line += is_last ? 0 : 1;
    return Text::trim(text);
  }


  std::string
  MeshText::peek_line()
  {
    skip_white_space();
    const Source &s   = source();
    const auto    end = s.content.find('\n', s.position);
    return Text::trim(
      std::string(s.content.substr(s.position, end - s.position)));
  }


  std::string
  MeshText::word(const std::string &what)
  {
    if (at_end())
      fail("the file ends where " + what + " should be: it is truncated.");
    Source    &s     = source();
    const auto begin = s.position;
    while (s.position < s.content.size() && !is_space(s.content[s.position]))
      ++s.position;
    return std::string(s.content.substr(begin, s.position - begin));
  }


  long long
  MeshText::to_integer(const std::string &word, const std::string &what) const
  {
    char *end              = nullptr;
    errno                  = 0;
    const long long result = std::strtoll(word.c_str(), &end, 10);
    if (word.empty() || *end != '\0' || errno != 0)
      fail("found '" + word + "' where " + what +
           ", a whole number, should be.");
    return result;
  }


  double
  MeshText::to_number(const std::string &word, const std::string &what) const
  {
    // Fortran writes 1.0D+00.
    std::string text = word;
    for (char &c : text)
      c = (c == 'D' || c == 'd') ? 'e' : c;
    char        *end    = nullptr;
    const double result = std::strtod(text.c_str(), &end);
    if (word.empty() || *end != '\0')
      fail("found '" + word + "' where " + what + ", a number, should be.");
    return result;
  }


  long long
  MeshText::integer(const std::string &what)
  {
    return to_integer(word(what), what);
  }


  std::size_t
  MeshText::count(const std::string &what)
  {
    const long long result = integer(what);
    if (result < 0)
      fail(what + " is " + std::to_string(result) +
           "; it can't be less than zero.");
    return result;
  }


  double
  MeshText::number(const std::string &what)
  {
    return to_number(word(what), what);
  }


  Point<3>
  MeshText::point(const std::string &what)
  {
    Point<3> result;
    for (unsigned int c = 0; c < 3; ++c)
      result[c] = number(what);
    return result;
  }


  std::string
  MeshText::where() const
  {
    return "The mesh file '" + sources_.back().path + "', line " +
           std::to_string(sources_.back().last_line);
  }


  void
  MeshText::fail(const std::string &text) const
  {
    throw StandardExceptions::ExcMessage(where() + ": " + text);
  }


  const std::string &
  MeshText::path() const
  {
    return sources_.front().path;
  }


  const std::string &
  MeshText::source_path() const
  {
    return sources_.back().path;
  }


  void
  MeshSets::add(const std::string &name, const unsigned int member)
  {
    const auto [entry, is_new] = indices_.emplace(name, sets_.size());
    if (is_new)
      sets_.push_back({name, {}});
    sets_[entry->second].members.push_back(member);
  }


  std::vector<MeshFile::Set>
  MeshSets::finish()
  {
    std::vector<MeshFile::Set> result;
    for (MeshFile::Set &set : sets_)
      {
        auto &members = set.members;
        std::sort(members.begin(), members.end());
        members.erase(std::unique(members.begin(), members.end()),
                      members.end());
        if (!members.empty())
          result.push_back(std::move(set));
      }
    return result;
  }


  MeshBuilder::MeshBuilder(const MeshText &text)
    : text_(text)
  {
    mesh_.path = text.path();
  }


  void
  MeshBuilder::add_node(const long long number, const Point<3> &position)
  {
    const std::string node = "the node " + std::to_string(number);
    for (unsigned int c = 0; c < 3; ++c)
      if (!std::isfinite(position[c]))
        text_.fail(node + " has the " + "xyz"[c] + " coordinate " +
                   std::to_string(position[c]) + "; it must be finite.");
    if (!node_indices_.emplace(number, mesh_.nodes.size()).second)
      text_.fail(node + " stands twice.");
    mesh_.nodes.push_back(position);
    mesh_.node_numbers.push_back(number);
  }


  std::optional<Point<3>>
  MeshBuilder::find_node(const long long number) const
  {
    const auto found = node_indices_.find(number);
    if (found == node_indices_.end())
      return {};
    return mesh_.nodes[found->second];
  }


  void
  MeshBuilder::add_element(const long long                 number,
                           const ElementKind              &kind,
                           const std::vector<long long>   &nodes,
                           const std::vector<std::string> &sets)
  {
    const std::string element = "the element " + std::to_string(number) + " ";
    if (!is_known(kind))
      text_.fail(element + refusal(kind) + ".");
    if (nodes.size() != kind.n_nodes)
      text_.fail(element + "has " + std::to_string(nodes.size()) +
                 " nodes; its type " + kind.name + " has " +
                 std::to_string(kind.n_nodes) + ".");
    if (kind.shape != ElementShape::point &&
        !element_indices_.emplace(number, elements_.size()).second)
      text_.fail(element + "stands twice.");
    elements_.push_back({number, kind, nodes, sets});
  }


  void
  MeshBuilder::add_to_last_element(const std::vector<std::string> &sets)
  {
    auto &all = elements_.back().sets;
    all.insert(all.end(), sets.begin(), sets.end());
  }


  unsigned int
  MeshBuilder::node_index(const long long number, const std::string &user) const
  {
    const auto found = node_indices_.find(number);
    AssertThrow(found != node_indices_.end(),
                ExcMessage("The mesh file '" + mesh_.path + "': " + user +
                           " refers to the node " + std::to_string(number) +
                           ", which the file doesn't define."));
    return found->second;
  }


  MeshFile
  MeshBuilder::finish()
  {
    MeshSets cell_sets, line_sets, node_sets;
    for (RawElement &raw : elements_)
      {
        MeshFile::Element element;
        element.number    = raw.number;
        const auto &order = node_order(raw.kind.shape);
        for (unsigned int i = 0; i < raw.nodes.size(); ++i)
          element.nodes.push_back(
            node_index(raw.nodes[order[i]],
                       "the element " + std::to_string(raw.number)));
        if (raw.kind.shape == ElementShape::point)
          {
            for (const std::string &name : raw.sets)
              node_sets.add(name, element.nodes[0]);
            continue;
          }
        const bool is_line = raw.kind.shape == ElementShape::line;
        auto      &home    = is_line ? mesh_.lines : mesh_.cells;
        for (const std::string &name : raw.sets)
          (is_line ? line_sets : cell_sets).add(name, home.size());
        home.push_back(std::move(element));
      }
    mesh_.cell_sets = cell_sets.finish();
    mesh_.line_sets = line_sets.finish();
    mesh_.node_sets = node_sets.finish();
    return std::move(mesh_);
  }


  std::vector<std::string>
  group_names(const long long group)
  {
    if (group == 0)
      return {};
    return {std::to_string(group)};
  }
} // namespace Nacre
