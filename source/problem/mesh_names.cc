// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/problem/coarse_cell.h>
#include <nacre/problem/mesh_checks.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <set>

namespace Nacre
{
  namespace
  {
    /** The name of the sides that no edge in use holds. */
    const std::string rest_of_boundary = "boundary";

    /** Names in the order of their first use, and their numbers. */
    class NameList
    {
    public:
      explicit NameList(const bool ignore_case)
        : ignore_case_(ignore_case)
      {}

      unsigned int
      number(const std::string &name)
      {
        const auto [entry, is_new] =
          numbers_.emplace(ignore_case_ ? Text::lower_case(name) : name,
                           names_.size());
        if (is_new)
          names_.push_back(name);
        return entry->second;
      }

      bool
      holds(const std::string &name) const
      {
        return numbers_.count(ignore_case_ ? Text::lower_case(name) : name) > 0;
      }

      std::vector<std::string>
      names(const std::set<unsigned int> &numbers) const
      {
        std::vector<std::string> result;
        for (const unsigned int n : numbers)
          result.push_back(names_[n]);
        return result;
      }

    private:
      bool                                ignore_case_;
      std::vector<std::string>            names_;
      std::map<std::string, unsigned int> numbers_;
    };


    /** See find_names(): the names of the boundary's sides. */
    class EdgeFinder
    {
    public:
      EdgeFinder(const MeshFile &mesh, const MeshSides &sides)
        : mesh_(mesh)
        , sides_(sides)
        , list_(mesh.names_ignore_case)
      {
        for (const auto &[line, cells] : sides)
          if (cells.size() == 1)
            names_.emplace(line, std::set<unsigned int>());
      }

      void
      add_line_sets();

      void
      add_side_sets();

      void
      add_node_sets();

      /** Tell of the sets that are none why they are no edges. */
      void
      explain_others();

      void
      fill(MeshNames &names) const;

      EdgeNames edge_names;

    private:
      /**
       * The lines of a set are an edge if all of them are on the boundary;
       * @p kind is what the file calls them.
       */
      void
      add_lines(const std::string                              &name,
                const std::string                              &kind,
                const std::vector<MeshLine>                    &lines,
                const std::function<std::string(unsigned int)> &describe_line);

      void
      refuse(const std::string &name, const std::string &why);

      std::optional<MeshLine>
      side_of(const MeshFile::Element &element) const;

      void
      note_other_nodes(const MeshFile::Set          &set,
                       const std::set<unsigned int> &on_sides);

      const MeshFile                            &mesh_;
      const MeshSides                           &sides_;
      NameList                                   list_;
      std::map<MeshLine, std::set<unsigned int>> names_;
      /** Groups inside of the surface, and what the file calls them. */
      std::map<std::string, std::string> inside_;
    };


    void
    EdgeFinder::refuse(const std::string &name, const std::string &why)
    {
      edge_names.no_edges.emplace(name,
                                  "The mesh file '" + mesh_.path + "': " + why +
                                    ".");
    }


    /** The side of a cell that a line element is; any order of its nodes. */
    std::optional<MeshLine>
    EdgeFinder::side_of(const MeshFile::Element &element) const
    {
      const auto &nodes = element.nodes;
      for (unsigned int i = 0; i < nodes.size(); ++i)
        for (unsigned int j = 0; j < i; ++j)
          {
            const auto found = sides_.find(std::minmax(nodes[i], nodes[j]));
            if (found != sides_.end() &&
                (nodes.size() == 2 ||
                 found->second[0].middle == nodes[3 - i - j]))
              return found->first;
          }
      return {};
    }


    void
    EdgeFinder::add_lines(
      const std::string                              &name,
      const std::string                              &kind,
      const std::vector<MeshLine>                    &lines,
      const std::function<std::string(unsigned int)> &describe_line)
    {
      const auto inside =
        std::find_if(lines.begin(), lines.end(), [&](const MeshLine &line) {
          return names_.count(line) == 0;
        });
      const auto n_inside =
        std::count_if(lines.begin(), lines.end(), [&](const MeshLine &line) {
          return names_.count(line) == 0;
        });
      if (n_inside == 0)
        for (const MeshLine &line : lines)
          names_.at(line).insert(list_.number(name));
      else if (n_inside == static_cast<std::ptrdiff_t>(lines.size()))
        inside_.emplace(name, kind);
      else
        refuse(name,
               kind + " '" + name + "' is partly inside of the surface: " +
                 describe_line(inside - lines.begin()) +
                 " lies between two cells");
    }


    void
    EdgeFinder::add_line_sets()
    {
      for (const MeshFile::Set &set : mesh_.line_sets)
        {
          std::vector<MeshLine> lines;
          for (const unsigned int member : set.members)
            {
              const MeshFile::Element &element = mesh_.lines[member];
              const auto               line    = side_of(element);
              if (line)
                {
                  lines.push_back(*line);
                  continue;
                }
              const auto node = [&](const unsigned int i) {
                return std::to_string(mesh_.node_numbers[element.nodes[i]]);
              };
              refuse(set.name,
                     "the line " + std::to_string(element.number) +
                       " of the group '" + set.name + "', between the nodes " +
                       node(0) + " and " + node(1) + ", is no side of a cell");
            }
          if (lines.size() == set.members.size())
            add_lines(set.name, "the group", lines, [&](const unsigned int i) {
              return "the line " +
                     std::to_string(mesh_.lines[set.members[i]].number);
            });
        }
    }


    void
    EdgeFinder::add_side_sets()
    {
      for (const MeshFile::SideSet &set : mesh_.side_sets)
        {
          std::vector<MeshLine> lines;
          for (const auto &[cell, side] : set.sides)
            {
              const auto &nodes = mesh_.cells[cell].nodes;
              const auto &ends =
                CoarseCell::sides(mesh_.n_corners(cell))[side].corners;
              lines.push_back(std::minmax(nodes[ends[0]], nodes[ends[1]]));
            }
          add_lines(set.name, "the surface", lines, [&](const unsigned int i) {
            return describe(mesh_, lines[i]);
          });
        }
    }


    /**
     * A set of nodes stands for the sides of which it holds all nodes, or both
     * corners if it holds corners only.
     */
    void
    EdgeFinder::add_node_sets()
    {
      std::vector<bool> is_corner(mesh_.nodes.size(), false);
      for (const auto &[line, cells] : sides_)
        is_corner[line.first] = is_corner[line.second] = true;
      std::vector<bool> is_member(mesh_.nodes.size(), false);
      for (const MeshFile::Set &set : mesh_.node_sets)
        {
          bool corners_only = true;
          for (const unsigned int node : set.members)
            {
              is_member[node] = true;
              corners_only    = corners_only && is_corner[node];
            }
          std::set<unsigned int> on_sides;
          for (auto &[line, names] : names_)
            {
              const unsigned int middle = sides_.at(line)[0].middle;
              const bool         whole  = corners_only ||
                                 middle == numbers::invalid_unsigned_int ||
                                 is_member[middle];
              if (!is_member[line.first] || !is_member[line.second] || !whole)
                continue;
              names.insert(list_.number(set.name));
              on_sides.insert({line.first, line.second, middle});
            }
          note_other_nodes(set, on_sides);
          for (const unsigned int node : set.members)
            is_member[node] = false;
        }
    }


    void
    EdgeFinder::note_other_nodes(const MeshFile::Set          &set,
                                 const std::set<unsigned int> &on_sides)
    {
      if (on_sides.empty())
        return;
      unsigned int n_others = 0, first = 0;
      for (const unsigned int node : set.members)
        if (on_sides.count(node) == 0 && n_others++ == 0)
          first = node;
      if (n_others > 0)
        edge_names.notes[set.name] =
          "The edge '" + set.name +
          "' are the sides of the boundary between the nodes of that set; " +
          std::to_string(n_others) + " of its " +
          std::to_string(set.members.size()) +
          " nodes lie on none of them, the first is the node " +
          std::to_string(mesh_.node_numbers[first]) + ".";
    }


    void
    EdgeFinder::explain_others()
    {
      const auto explain = [&](const std::string &name,
                               const std::string &what) {
        if (!list_.holds(name))
          refuse(name, "'" + name + "' is " + what);
      };
      for (const auto &[name, kind] : inside_)
        if (!list_.holds(name))
          refuse(name, kind + " '" + name + "' lies inside of the surface");
      for (const MeshFile::Set &set : mesh_.node_sets)
        explain(set.name,
                "a set of nodes that holds both ends of no side of the "
                "boundary");
      for (const MeshFile::Set &set : mesh_.cell_sets)
        explain(set.name, "a set of cells, which is a region and no edge");
      for (const std::string &name : mesh_.instances)
        if (!name.empty())
          explain(name, "an instance of a part");

      if (!list_.holds(rest_of_boundary))
        {
          edge_names.rest = rest_of_boundary;
          return;
        }
      const unsigned int own = list_.number(rest_of_boundary);
      const auto         n_own =
        std::count_if(names_.begin(), names_.end(), [&](const auto &side) {
          return side.second.count(own) > 0;
        });
      if (n_own < static_cast<std::ptrdiff_t>(names_.size()))
        edge_names.notes[rest_of_boundary] =
          "The edge '" + rest_of_boundary +
          "' is the file's own set of that name, with " +
          std::to_string(n_own) + " of the " + std::to_string(names_.size()) +
          " sides of the boundary.";
    }


    void
    EdgeFinder::fill(MeshNames &result) const
    {
      std::map<std::set<unsigned int>, unsigned int> combinations;
      for (const auto &[line, names] : names_)
        combinations.emplace(names, 0);
      // Sides without a name come last.
      unsigned int n = 0;
      for (auto &[names, edge] : combinations)
        if (!names.empty())
          edge = n++;
      if (combinations.count({}) > 0)
        combinations[{}] = n++;

      result.edges.resize(n);
      for (const auto &[names, edge] : combinations)
        {
          SurfaceDescription::Edge &entry = result.edges[edge];
          entry.aliases                   = list_.names(names);
          entry.name                      = edge_names.rest;
          if (!names.empty())
            {
              entry.name = entry.aliases.front();
              entry.aliases.erase(entry.aliases.begin());
            }
        }
      for (const auto &[line, names] : names_)
        {
          const unsigned int edge   = combinations.at(names);
          result.edge_of_line[line] = edge;
          if (result.edges[edge].example.empty())
            result.edges[edge].example =
              describe(mesh_, line) + " of '" + mesh_.path + "'";
        }
      result.edge_names             = edge_names;
      result.edge_names.ignore_case = mesh_.names_ignore_case;
    }


    /** The regions in the order in which the cells come. */
    void
    find_regions(const MeshFile &mesh, MeshNames &result)
    {
      NameList                            list(mesh.names_ignore_case);
      std::vector<std::set<unsigned int>> names(mesh.cells.size());
      for (const MeshFile::Set &set : mesh.cell_sets)
        for (const unsigned int cell : set.members)
          names[cell].insert(list.number(set.name));

      result.regions.names_ignore_case = mesh.names_ignore_case;
      std::map<std::set<unsigned int>, unsigned int> combinations = {{{}, 0}};
      for (unsigned int k = 0; k < names.size(); ++k)
        {
          auto &regions = result.regions.regions;
          const auto [entry, is_new] =
            combinations.emplace(names[k], regions.size());
          if (is_new)
            regions.push_back({list.names(names[k]), mesh.describe_cell(k)});
          result.region_of_cell.push_back(entry->second);
        }
    }
  } // namespace


  MeshNames
  find_names(const MeshFile &mesh, const MeshSides &sides)
  {
    EdgeFinder finder(mesh, sides);
    finder.add_line_sets();
    finder.add_side_sets();
    finder.add_node_sets();
    finder.explain_others();
    MeshNames names;
    finder.fill(names);
    find_regions(mesh, names);
    return names;
  }
} // namespace Nacre
