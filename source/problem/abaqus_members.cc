// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/abaqus_members.h>

#include <algorithm>

namespace Nacre::Abaqus
{
  namespace
  {
    void
    append(std::vector<unsigned int>       &result,
           const std::vector<unsigned int> &more)
    {
      result.insert(result.end(), more.begin(), more.end());
    }

    void
    make_unique(std::vector<unsigned int> &items)
    {
      std::sort(items.begin(), items.end());
      items.erase(std::unique(items.begin(), items.end()), items.end());
    }
  } // namespace


  PartMesh::PartMesh(Part &part)
    : mesh(part.mesh.finish())
  {
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      nodes.emplace(mesh.node_numbers[i], i);
    for (unsigned int i = 0; i < mesh.cells.size(); ++i)
      cells.emplace(mesh.cells[i].number, i);
    for (unsigned int i = 0; i < mesh.lines.size(); ++i)
      lines.emplace(mesh.lines[i].number, i);
  }


  void
  Members::append(const Members &other)
  {
    Abaqus::append(nodes, other.nodes);
    Abaqus::append(cells, other.cells);
    Abaqus::append(lines, other.lines);
  }


  void
  Members::make_unique()
  {
    Abaqus::make_unique(nodes);
    Abaqus::make_unique(cells);
    Abaqus::make_unique(lines);
  }


  std::optional<unsigned int>
  SetResolver::find_scope(const unsigned int scope,
                          const std::string &instance) const
  {
    if (instance.empty())
      return scope;
    for (unsigned int i = 1; i < scopes_.size(); ++i)
      if (upper_case(scopes_[i].name) == upper_case(instance))
        return i;
    return {};
  }


  Members
  SetResolver::named(const SetKind      kind,
                     const unsigned int scope,
                     const std::string &instance,
                     const std::string &word,
                     const std::string &user)
  {
    Members    result;
    const auto home = find_scope(scope, instance);
    if (!home)
      miss(user, "the instance '" + instance + "'");
    else if (is_number(word))
      add_range(kind,
                *home,
                {std::stoll(word), std::stoll(word), 1},
                user,
                result);
    else
      add_name(kind, *home, word, user, result);
    return result;
  }


  const Table<Set> &
  SetResolver::sets(const SetKind kind, const unsigned int scope) const
  {
    const Part &part = *scopes_[scope].part;
    return kind == SetKind::nodes ? part.node_sets : part.element_sets;
  }


  const Members &
  SetResolver::members(const SetKind      kind,
                       const unsigned int scope,
                       const Set         &set)
  {
    const auto [entry, is_new] =
      members_.emplace(std::make_pair(&set, scope), Members());
    // A set that holds itself gains nothing from that.
    if (!is_new)
      return entry->second;
    Members result;
    for (const SetEntry &part : set.entries)
      {
        const auto home = find_scope(scope, part.instance);
        if (!home)
          {
            miss(set.name, "the instance '" + part.instance + "'");
            continue;
          }
        for (const Range &range : part.numbers)
          add_range(kind, *home, range, set.name, result);
        for (const std::string &name : part.names)
          if (part.of_elements)
            {
              Members elements;
              add_name(SetKind::elements, *home, name, set.name, elements);
              add_nodes_of_elements(elements);
              append(result.nodes, elements.nodes);
            }
          else
            add_name(kind, *home, name, set.name, result);
      }
    result.make_unique();
    entry->second = std::move(result);
    return entry->second;
  }


  /** Returns whether the number is defined. */
  bool
  SetResolver::add_number(const SetKind      kind,
                          const unsigned int scope,
                          const long long    number,
                          Members           &result) const
  {
    const Scope &home = scopes_[scope];
    const auto   add  = [&](const auto                &indices,
                         const unsigned int         first,
                         std::vector<unsigned int> &members) {
      const auto found = indices.find(number);
      if (found == indices.end())
        return false;
      members.push_back(first + found->second);
      return true;
    };
    if (kind == SetKind::nodes)
      return add(home.mesh->nodes, home.first_node, result.nodes);
    return add(home.mesh->cells, home.first_cell, result.cells) ||
           add(home.mesh->lines, home.first_line, result.lines) ||
           home.part->left_out.count(number) > 0;
  }


  /** GENERATE may name many more numbers than there are. */
  void
  SetResolver::add_range(const SetKind      kind,
                         const unsigned int scope,
                         const Range       &range,
                         const std::string &user,
                         Members           &result)
  {
    const PartMesh &mesh      = *scopes_[scope].mesh;
    const long long n         = (range.last - range.first) / range.step + 1;
    const long long n_defined = mesh.nodes.size() + mesh.cells.size() +
                                mesh.lines.size() +
                                scopes_[scope].part->left_out.size();
    long long   n_found = 0;
    std::string missing;
    const auto  try_number = [&](const long long number) {
      if (add_number(kind, scope, number, result))
        ++n_found;
      else if (missing.empty())
        missing = std::to_string(number);
    };
    if (n <= 2 * n_defined)
      for (long long i = 0; i < n; ++i)
        try_number(range.first + i * range.step);
    else
      {
        const auto in_range = [&](const long long number) {
          return number >= range.first && number <= range.last &&
                 (number - range.first) % range.step == 0;
        };
        const auto try_all = [&](const auto &numbers) {
          for (const auto &[number, index] : numbers)
            if (in_range(number))
              try_number(number);
        };
        if (kind == SetKind::nodes)
          try_all(mesh.nodes);
        else
          {
            try_all(mesh.cells);
            try_all(mesh.lines);
            for (const long long number : scopes_[scope].part->left_out)
              if (in_range(number))
                try_number(number);
          }
        Members unused;
        for (long long i = 0; missing.empty(); ++i)
          if (!add_number(kind, scope, range.first + i * range.step, unused))
            missing = std::to_string(range.first + i * range.step);
      }
    if (n_found < n)
      miss(user, missing, n - n_found);
  }


  /** A set, "Instance.Set" or "Instance.17". */
  void
  SetResolver::add_name(const SetKind      kind,
                        const unsigned int scope,
                        const std::string &name,
                        const std::string &user,
                        Members           &result)
  {
    for (const unsigned int home : {scope, 0u})
      if (const Set *const set = sets(kind, home).find(name))
        {
          result.append(members(kind, home, *set));
          return;
        }
    // The name of an instance may have dots of its own.
    auto dot = name.find('.');
    while (dot != std::string::npos &&
           !find_scope(0, name.substr(0, dot)).value_or(0))
      dot = name.find('.', dot + 1);
    if (dot == std::string::npos)
      {
        miss(user, "'" + name + "'");
        return;
      }
    const unsigned int home = *find_scope(0, name.substr(0, dot));
    const std::string  rest = name.substr(dot + 1);
    if (is_number(rest))
      add_range(kind,
                home,
                {std::stoll(rest), std::stoll(rest), 1},
                user,
                result);
    else
      add_name(kind, home, rest, user, result);
  }


  void
  SetResolver::add_nodes_of_elements(Members &result) const
  {
    for (const unsigned int cell : result.cells)
      append(result.nodes, mesh_.cells[cell].nodes);
    for (const unsigned int line : result.lines)
      append(result.nodes, mesh_.lines[line].nodes);
  }


  void
  SetResolver::miss(const std::string &user,
                    const std::string &what,
                    const long long    n)
  {
    undefined_.emplace(user, std::make_pair(0, what)).first->second.first += n;
  }


  std::string
  SetResolver::note_of_undefined() const
  {
    constexpr unsigned int n_listed = 5;
    unsigned int           n        = 0;
    std::string            text;
    for (const auto &[user, missing] : undefined_)
      {
        if (n < n_listed)
          text += (n == 0 ? "'" : "; '") + user + "': " + missing.second +
                  (missing.first > 1 ?
                     " and " + std::to_string(missing.first - 1) + " more" :
                     "");
        ++n;
      }
    if (n == 0)
      return "";
    return "Sets name members that the file doesn't define; these are left "
           "out: " +
           text + (n > n_listed ? "; ..." : "") + ".";
  }
} // namespace Nacre::Abaqus
