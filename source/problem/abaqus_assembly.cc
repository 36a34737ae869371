// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/abaqus_deck.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <optional>

namespace Nacre::Abaqus
{
  namespace
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

    /** Members of sets: indices in the whole mesh. */
    struct Members
    {
      std::vector<unsigned int> nodes, cells, lines;

      void
      append(const Members &other);

      void
      make_unique();
    };

    enum class SetKind
    {
      nodes,
      elements
    };

    /** See assemble(). */
    class Assembler
    {
    public:
      explicit Assembler(Deck &deck)
        : deck_(deck)
      {}

      MeshFile
      run();

    private:
      void
      add_scopes();
      void
      add_scope(const std::string &name, Part &part, const RigidMotion &motion);

      std::optional<unsigned int>
      find_scope(const std::string &instance) const;

      const Table<Set> &
      sets(const SetKind kind, const unsigned int scope) const;

      const Members &
      members(const SetKind kind, const unsigned int scope, const Set &set);

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

      template <typename Item>
      std::vector<std::string>
      names(const unsigned int scope,
            const Item        &item,
            const Table<Item> &of_assembly) const;

      void
      name_sets(const unsigned int scope);
      void
      name_surfaces(const unsigned int scope);
      void
      add_face(const std::string &surface,
               const std::string &face,
               const Members     &members);
      void
      name_parts();
      void
      add_aliases(Table<MeshFile::Set>       &sets,
                  const Table<MeshFile::Set> &aliases) const;
      void
      add_notes();

      Deck                            &deck_;
      MeshFile                         mesh_;
      std::map<const Part *, PartMesh> part_meshes_;
      /** The assembly first. */
      std::vector<Scope> scopes_;

      std::map<std::pair<const Set *, unsigned int>, Members> members_;
      /**
       * By the name of the set or surface: how many of its members the file
       * doesn't define, and the first.
       */
      std::map<std::string, std::pair<long long, std::string>> undefined_;
      std::set<std::string>                                    unknown_faces_;

      Table<MeshFile::Set>     node_sets_, cell_sets_, line_sets_;
      Table<MeshFile::SideSet> side_sets_;
      /** Surfaces of whole elements and of nodes; instances and parts. */
      Table<MeshFile::Set> node_aliases_, cell_aliases_, line_aliases_;
    };


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
    append(std::vector<unsigned int>       &result,
           const std::vector<unsigned int> &more)
    {
      result.insert(result.end(), more.begin(), more.end());
    }


    template <typename Item>
    void
    make_unique(std::vector<Item> &items)
    {
      std::sort(items.begin(), items.end());
      items.erase(std::unique(items.begin(), items.end()), items.end());
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


    MeshFile
    Assembler::run()
    {
      mesh_.path              = deck_.path;
      mesh_.names_ignore_case = true;
      mesh_.notes             = deck_.notes;
      add_scopes();
      for (unsigned int scope = 0; scope < scopes_.size(); ++scope)
        {
          name_sets(scope);
          name_surfaces(scope);
        }
      name_parts();
      add_aliases(node_sets_, node_aliases_);
      add_aliases(cell_sets_, cell_aliases_);
      add_aliases(line_sets_, line_aliases_);
      add_notes();

      const auto finish = [](const Table<MeshFile::Set> &table) {
        std::vector<MeshFile::Set> result;
        for (MeshFile::Set set : table.items())
          {
            make_unique(set.members);
            if (!set.members.empty())
              result.push_back(std::move(set));
          }
        return result;
      };
      mesh_.node_sets = finish(node_sets_);
      mesh_.cell_sets = finish(cell_sets_);
      mesh_.line_sets = finish(line_sets_);
      for (MeshFile::SideSet set : side_sets_.items())
        {
          make_unique(set.sides);
          mesh_.side_sets.push_back(std::move(set));
        }
      return std::move(mesh_);
    }


    /** Without instances each part is taken as it is. */
    void
    Assembler::add_scopes()
    {
      add_scope("", deck_.assembly, {});
      std::set<std::string> used;
      for (const Instance &instance : deck_.instances)
        {
          const auto part = std::find_if(deck_.parts.begin(),
                                         deck_.parts.end(),
                                         [&](const Part &part) {
                                           return upper_case(part.name) ==
                                                  upper_case(instance.part);
                                         });
          AssertThrow(part != deck_.parts.end(),
                      ExcMessage(instance.where + ": the instance '" +
                                 instance.name + "' is of the part '" +
                                 instance.part +
                                 "', which the file doesn't define."));
          add_scope(instance.name, *part, instance.motion);
          used.insert(upper_case(part->name));
        }
      for (Part &part : deck_.parts)
        if (deck_.instances.empty())
          add_scope(part.name, part, {});
        else if (used.count(upper_case(part.name)) == 0)
          mesh_.notes.push_back("The part '" + part.name +
                                "' has no instance and is left out.");
      if (scopes_.size() > 2)
        for (const Scope &scope : scopes_)
          mesh_.instances.push_back(scope.name);
    }


    void
    Assembler::add_scope(const std::string &name,
                         Part              &part,
                         const RigidMotion &motion)
    {
      const PartMesh &own = part_meshes_.try_emplace(&part, part).first->second;
      const unsigned int first_node = mesh_.nodes.size();
      scopes_.push_back({name,
                         &part,
                         &own,
                         first_node,
                         static_cast<unsigned int>(mesh_.cells.size()),
                         static_cast<unsigned int>(mesh_.lines.size())});
      for (const Point<3> &node : own.mesh.nodes)
        mesh_.nodes.push_back(motion(node));
      mesh_.node_numbers.insert(mesh_.node_numbers.end(),
                                own.mesh.node_numbers.begin(),
                                own.mesh.node_numbers.end());
      const auto add = [&](const std::vector<MeshFile::Element> &elements,
                           std::vector<MeshFile::Element>       &result) {
        for (MeshFile::Element element : elements)
          {
            for (unsigned int &node : element.nodes)
              node += first_node;
            element.instance = scopes_.size() - 1;
            result.push_back(std::move(element));
          }
      };
      add(own.mesh.cells, mesh_.cells);
      add(own.mesh.lines, mesh_.lines);
    }


    std::optional<unsigned int>
    Assembler::find_scope(const std::string &instance) const
    {
      for (unsigned int scope = 1; scope < scopes_.size(); ++scope)
        if (upper_case(scopes_[scope].name) == upper_case(instance))
          return scope;
      return {};
    }


    const Table<Set> &
    Assembler::sets(const SetKind kind, const unsigned int scope) const
    {
      const Part &part = *scopes_[scope].part;
      return kind == SetKind::nodes ? part.node_sets : part.element_sets;
    }


    const Members &
    Assembler::members(const SetKind      kind,
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
          const auto home = part.instance.empty() ?
                              std::optional<unsigned int>(scope) :
                              find_scope(part.instance);
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
    Assembler::add_number(const SetKind      kind,
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
    Assembler::add_range(const SetKind      kind,
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
    Assembler::add_name(const SetKind      kind,
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
      for (auto dot = name.find('.'); dot != std::string::npos;
           dot      = name.find('.', dot + 1))
        {
               const auto        home = find_scope(name.substr(0, dot));
               const std::string rest = name.substr(dot + 1);
               if (!home)
            continue;
          if (is_number(rest))
            add_range(kind,
                      *home,
                      {std::stoll(rest), std::stoll(rest), 1},
                      user,
                      result);
          else
            add_name(kind, *home, rest, user, result);
          return;
        }
      miss(user, "'" + name + "'");
    }


    void
    Assembler::add_nodes_of_elements(Members &result) const
    {
      for (const unsigned int cell : result.cells)
        append(result.nodes, mesh_.cells[cell].nodes);
      for (const unsigned int line : result.lines)
        append(result.nodes, mesh_.lines[line].nodes);
    }


    void
    Assembler::miss(const std::string &user,
                    const std::string &what,
                    const long long    n)
    {
      undefined_.emplace(user, std::make_pair(0, what)).first->second.first +=
        n;
    }


    /**
     * A name of the assembly stands for its own thing. That of a part stands
     * for the things of all instances, and with the name of the instance for
     * one of them, where that makes a difference.
     */
    template <typename Item>
    std::vector<std::string>
    Assembler::names(const unsigned int scope,
                     const Item        &item,
                     const Table<Item> &of_assembly) const
    {
      if (scope == 0)
        return {item.name};
      std::vector<std::string> result;
      const bool               hidden = of_assembly.find(item.name) != nullptr;
      if (!hidden)
        result.push_back(item.name);
      if (hidden || scopes_.size() > 2)
        result.push_back(scopes_[scope].name + "." + item.name);
      return result;
    }


    void
    Assembler::name_sets(const unsigned int scope)
    {
      for (const SetKind kind : {SetKind::nodes, SetKind::elements})
        for (const Set &set : sets(kind, scope).items())
          {
            const Members &found = members(kind, scope, set);
            for (const std::string &name : names(scope, set, sets(kind, 0)))
              {
                append(node_sets_.item(name).members, found.nodes);
                append(cell_sets_.item(name).members, found.cells);
                append(line_sets_.item(name).members, found.lines);
              }
          }
    }


    void
    Assembler::name_surfaces(const unsigned int scope)
    {
      for (const Surface &surface : scopes_[scope].part->surfaces.items())
        for (const SurfaceEntry &entry : surface.entries)
          {
            const SetKind kind =
              surface.of_nodes ? SetKind::nodes : SetKind::elements;
            const auto home = entry.instance.empty() ?
                                std::optional<unsigned int>(scope) :
                                find_scope(entry.instance);
            Members    found;
            if (!home)
              miss(surface.name, "the instance '" + entry.instance + "'");
            else if (is_number(entry.member))
              add_range(kind,
                        *home,
                        {std::stoll(entry.member), std::stoll(entry.member), 1},
                        surface.name,
                        found);
            else
              add_name(kind, *home, entry.member, surface.name, found);
            for (const std::string &name :
                 names(scope, surface, deck_.assembly.surfaces))
              add_face(name, entry.face, found);
          }
    }


    /**
     * "E2" is a side of a shell, as CalculiX' "S4"; plane elements have "S2".
     * The other faces of shells are the whole element, from above or below.
     */
    void
    Assembler::add_face(const std::string &surface,
                        const std::string &face,
                        const Members     &members)
    {
      append(node_aliases_.item(surface).members, members.nodes);
      append(line_aliases_.item(surface).members, members.lines);
      const bool is_numbered = face.size() == 2 &&
                               (face[0] == 'E' || face[0] == 'S') &&
                               face[1] >= '1' && face[1] <= '6';
      if (!is_numbered && !face.empty() && face != "SPOS" && face != "SNEG")
        {
          unknown_faces_.insert(face);
          return;
        }
      for (const unsigned int cell : members.cells)
        {
          const auto        &element = mesh_.cells[cell];
          const Part        &part    = *scopes_[element.instance].part;
          const unsigned int number  = is_numbered ? face[1] - '0' : 0;
          // Of a shell, S1 and S2 are below and above.
          const bool is_shell_face = is_numbered && face[0] == 'S' &&
                                     part.plane.count(element.number) == 0;
          const unsigned int first = is_shell_face ? 3 : 1;
          if (number < first)
            cell_aliases_.item(surface).members.push_back(cell);
          else if (number - first < mesh_.n_corners(cell))
            side_sets_.item(surface).sides.emplace_back(cell, number - first);
          else
            unknown_faces_.insert(face);
        }
    }


    /** Instances and parts are sets of all their cells. */
    void
    Assembler::name_parts()
    {
      for (const Scope &scope : scopes_)
        for (unsigned int k = 0; k < scope.mesh->mesh.cells.size(); ++k)
          for (const std::string &name :
               std::set<std::string>{scope.name, scope.part->name})
            if (!name.empty())
              cell_aliases_.item(name).members.push_back(scope.first_cell + k);
    }


    /** Sets have the right to their name. */
    void
    Assembler::add_aliases(Table<MeshFile::Set>       &sets,
                           const Table<MeshFile::Set> &aliases) const
    {
      for (const MeshFile::Set &alias : aliases.items())
        if (sets.find(alias.name) == nullptr)
          sets.item(alias.name).members = alias.members;
    }


    void
    Assembler::add_notes()
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
      if (n > 0)
        mesh_.notes.push_back(
          "Sets name members that the file doesn't define; these are left "
          "out: " +
          text + (n > n_listed ? "; ..." : "") + ".");
      std::string faces;
      for (const std::string &face : unknown_faces_)
        faces += (faces.empty() ? "" : ", ") + face;
      if (!faces.empty())
        mesh_.notes.push_back("Surfaces name faces that their elements don't "
                              "have; these are left out: " +
                              faces + ".");
    }
  } // namespace


  MeshFile
  assemble(Deck &deck)
  {
    return Assembler(deck).run();
  }
} // namespace Nacre::Abaqus
