// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/abaqus_members.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <numeric>

namespace Nacre::Abaqus
{
  namespace
  {
    /** See assemble(). */
    class Assembler
    {
    public:
      explicit Assembler(Deck &deck)
        : deck_(deck)
        , resolver_(scopes_, mesh_)
      {}

      MeshFile
      run();

    private:
      void
      add_scopes();
      void
      add_scope(const std::string &name, Part &part, const RigidMotion &motion);

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
      SetResolver        resolver_;

      std::set<std::string> unknown_faces_;

      Table<MeshFile::Set>     node_sets_, cell_sets_, line_sets_;
      Table<MeshFile::SideSet> side_sets_;
      /** Surfaces of whole elements and of nodes; instances and parts. */
      Table<MeshFile::Set> node_aliases_, cell_aliases_, line_aliases_;
    };


    /** Nothing doesn't make a set. */
    void
    add(Table<MeshFile::Set>            &sets,
        const std::string               &name,
        const std::vector<unsigned int> &members)
    {
      if (members.empty())
        return;
      auto &all = sets.item(name).members;
      all.insert(all.end(), members.begin(), members.end());
    }


    template <typename Item>
    void
    make_unique(std::vector<Item> &items)
    {
      std::sort(items.begin(), items.end());
      items.erase(std::unique(items.begin(), items.end()), items.end());
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
        for (const Set &set : resolver_.sets(kind, scope).items())
          {
            const Members &found = resolver_.members(kind, scope, set);
            for (const std::string &name :
                 names(scope, set, resolver_.sets(kind, 0)))
              {
                add(node_sets_, name, found.nodes);
                add(cell_sets_, name, found.cells);
                add(line_sets_, name, found.lines);
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
            const Members found = resolver_.named(kind,
                                                  scope,
                                                  entry.instance,
                                                  entry.member,
                                                  surface.name);
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
      add(node_aliases_, surface, members.nodes);
      add(line_aliases_, surface, members.lines);
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
        {
          std::vector<unsigned int> cells(scope.mesh->mesh.cells.size());
          std::iota(cells.begin(), cells.end(), scope.first_cell);
          for (const std::string &name :
               std::set<std::string>{scope.name, scope.part->name})
            if (!name.empty())
              add(cell_aliases_, name, cells);
        }
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
      const std::string undefined = resolver_.note_of_undefined();
      if (!undefined.empty())
        mesh_.notes.push_back(undefined);
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
