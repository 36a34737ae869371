// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/problem/mesh_reader.h>

#include <array>
#include <cstdlib>
#include <set>
#include <utility>

namespace Nacre
{
  namespace
  {
    /** A gmsh .msh file, by sections: gmsh's reference manual, "MSH format". */
    class GmshReader
    {
    public:
      explicit GmshReader(MeshText &text)
        : text_(text)
        , builder_(text)
      {}

      MeshFile
      read()
      {
        while (!text_.at_end())
          {
            const std::string section = text_.word("a section");
            if (section.size() < 2 || section[0] != '$')
              text_.fail("found '" + section.substr(0, 40) +
                         "' where a section, as $Nodes, should begin.");
            read_section(section.substr(1));
          }
        for (const char *const section : {"MeshFormat", "Nodes", "Elements"})
          if (found_.count(section) == 0)
            text_.fail("the file has no section $" + std::string(section) +
                       ": it is truncated or no mesh.");
        return builder_.finish();
      }

    private:
      /** Dimension and tag of an entity or of a physical group. */
      using Tag = std::pair<int, long long>;

      void
      read_section(const std::string &name)
      {
        if (name != "MeshFormat" && name != "Comments" &&
            found_.count("MeshFormat") == 0)
          text_.fail("the section $" + name +
                     " comes before $MeshFormat; a gmsh file begins with "
                     "that.");
        if (name == "MeshFormat")
          read_format();
        else if (name == "PhysicalNames")
          read_names();
        else if (name == "Entities" && version_ > 4.)
          read_entities();
        else if (name == "Nodes")
          version_ < 3. ? read_nodes_2() : read_nodes_4();
        else if (name == "Elements")
          version_ < 3. ? read_elements_2() : read_elements_4();
        else if (name == "PartitionedEntities" && version_ > 4.)
          read_partitioned_entities();
        else
          {
            while (text_.word("$End" + name) != "$End" + name)
              ;
            return;
          }
        const std::string end = text_.word("$End" + name);
        if (end != "$End" + name)
          text_.fail("found '" + end.substr(0, 40) + "' where $End" + name +
                     " should be: the section holds more than its counts "
                     "say.");
        found_.insert(name);
      }

      void
      read_format()
      {
        version_          = text_.number("the version of the format");
        const auto binary = text_.integer("the type of the file");
        text_.integer("the size of the numbers");
        if (binary != 0)
          text_.fail("the file is binary; save it as text (gmsh: "
                     "Mesh.Binary = 0).");
        if (!((version_ >= 2. && version_ < 3.) || version_ == 4.1))
          text_.fail("the version " + std::to_string(version_).substr(0, 3) +
                     " of the format isn't known; known are 2.2 and 4.1 "
                     "(gmsh: -format msh22 or msh41).");
      }

      /** A name in quotes may hold blanks. */
      void
      read_names()
      {
        const auto n = text_.count("the number of physical names");
        for (std::size_t i = 0; i < n; ++i)
          {
            const auto  dim  = text_.integer("the dimension of a group");
            const auto  tag  = text_.integer("the number of a group");
            std::string name = Text::trim(text_.line("the name of a group"));
            if (name.size() < 3 || name.front() != '"' || name.back() != '"')
              text_.fail("found " + name +
                         " where the name of a group, in quotes, should be.");
            name               = Text::trim(name.substr(1, name.size() - 2));
            names_[{dim, tag}] = name;
          }
      }

      /** A group without a name is called by its number. */
      std::string
      group_name(const int dim, const long long tag) const
      {
        const auto found = names_.find({dim, tag});
        return found != names_.end() ? found->second : std::to_string(tag);
      }

      void
      read_entities(std::set<long long> *partitions = nullptr)
      {
        std::array<std::size_t, 4> n;
        for (auto &count : n)
          count = text_.count("the number of entities");
        for (int dim = 0; dim < 4; ++dim)
          for (std::size_t i = 0; i < n[dim]; ++i)
            {
              const long long tag = text_.integer("the number of an entity");
              if (partitions != nullptr)
                {
                  text_.integer("the dimension of the whole entity");
                  text_.integer("the number of the whole entity");
                  const auto found = read_integers("partition");
                  partitions->insert(found.begin(), found.end());
                }
              for (unsigned int c = 0; c < (dim == 0 ? 3 : 6); ++c)
                text_.number("a bound of the entity " + std::to_string(tag));
              // The sign is the direction of the curve in the group.
              for (const long long group : read_integers("group"))
                entity_groups_[{dim, tag}].push_back(
                  group_name(dim, std::abs(group)));
              if (dim > 0)
                read_integers("bounding entity");
            }
      }

      /**
       * The parts of entities stand in their place: they have numbers of their
       * own and the groups of the whole.
       */
      void
      read_partitioned_entities()
      {
        const auto n_partitions = text_.count("the number of partitions");
        const auto n_ghosts     = text_.count("the number of ghost entities");
        for (std::size_t i = 0; i < 2 * n_ghosts; ++i)
          text_.integer("a ghost entity or its partition");
        entity_groups_.clear();
        std::set<long long> partitions;
        read_entities(&partitions);
        if (partitions.size() < n_partitions)
          text_.fail("the file holds " + std::to_string(partitions.size()) +
                     " of the mesh's " + std::to_string(n_partitions) +
                     " partitions; save all of them in one file (gmsh: "
                     "Mesh.PartitionSplitMeshFiles = 0).");
      }

      /** A count, and so many integers, each a @p thing. */
      std::vector<long long>
      read_integers(const std::string &thing)
      {
        std::vector<long long> result(
          text_.count("a count, each a " + thing + ","));
        for (long long &integer : result)
          integer = text_.integer("a " + thing);
        return result;
      }

      void
      read_nodes_2()
      {
        const auto n = text_.count("the number of nodes");
        for (std::size_t i = 0; i < n; ++i)
          {
            const std::string what   = which("node", i, n);
            const long long   number = text_.integer(what);
            builder_.add_node(number, text_.point(what));
          }
      }

      void
      read_nodes_4()
      {
        const auto n_blocks = text_.count("the number of blocks of nodes");
        const auto n_nodes  = text_.count("the number of nodes");
        text_.integer("the smallest number of a node");
        text_.integer("the largest number of a node");
        std::size_t n_read = 0;
        for (std::size_t b = 0; b < n_blocks; ++b)
          {
            const auto dim = text_.integer("the dimension of an entity");
            text_.integer("the number of an entity");
            const auto parametric = text_.integer("parametric (0 or 1)");
            const auto n          = text_.count("the number of nodes");
            std::vector<long long> numbers;
            for (std::size_t i = 0; i < n; ++i)
              numbers.push_back(
                text_.integer(which("node", n_read + i, n_nodes)));
            for (const long long number : numbers)
              {
                const std::string what = which("node", n_read++, n_nodes);
                builder_.add_node(number, text_.point(what));
                for (long long c = 0; c < (parametric != 0 ? dim : 0); ++c)
                  text_.number(what);
              }
          }
        if (n_read != n_nodes)
          text_.fail("$Nodes announces " + std::to_string(n_nodes) +
                     " nodes and holds " + std::to_string(n_read) + ".");
      }

      /**
       * An element of an entity in several groups stands once for each, one
       * after the other, with numbers of their own.
       */
      void
      read_elements_2()
      {
        const auto n = text_.count("the number of elements");
        // Type, entity and nodes of the element before, and its group.
        std::vector<long long>   before;
        std::vector<std::string> groups_before;
        for (std::size_t i = 0; i < n; ++i)
          {
            const std::string        what   = which("element", i, n);
            const long long          number = text_.integer(what);
            const long long          type   = text_.integer(what);
            const ElementKind        kind   = to_kind(type, number);
            const auto               n_tags = text_.count(what);
            std::vector<std::string> groups;
            long long                entity = 0;
            for (std::size_t t = 0; t < n_tags; ++t)
              {
                const long long tag = text_.integer(what);
                if (t == 0 && tag != 0)
                  groups = {group_name(dimension(kind), std::abs(tag))};
                entity = t == 1 ? tag : entity;
              }
            const auto             nodes   = read_element_nodes(kind, what);
            std::vector<long long> current = {type, entity};
            current.insert(current.end(), nodes.begin(), nodes.end());
            // The sign of a group is the direction of the curve.
            if (kind.shape == ElementShape::line && nodes[0] > nodes[1])
              std::swap(current[2], current[3]);
            if (current == before && groups != groups_before)
              builder_.add_to_last_element(groups);
            else
              builder_.add_element(number, kind, nodes, groups);
            before        = std::move(current);
            groups_before = groups;
          }
      }

      void
      read_elements_4()
      {
        const auto n_blocks   = text_.count("the number of blocks of elements");
        const auto n_elements = text_.count("the number of elements");
        text_.integer("the smallest number of an element");
        text_.integer("the largest number of an element");
        std::size_t n_read = 0;
        for (std::size_t b = 0; b < n_blocks; ++b)
          {
            const int   dim    = text_.integer("the dimension of an entity");
            const auto  tag    = text_.integer("the number of an entity");
            const auto  type   = text_.integer("the type of elements");
            const auto  n      = text_.count("the number of elements");
            const auto &groups = entity_groups_[{dim, tag}];
            for (std::size_t i = 0; i < n; ++i)
              {
                const std::string what = which("element", n_read++, n_elements);
                const long long   number = text_.integer(what);
                const ElementKind kind   = to_kind(type, number);
                builder_.add_element(number,
                                     kind,
                                     read_element_nodes(kind, what),
                                     groups);
              }
          }
        if (n_read != n_elements)
          text_.fail("$Elements announces " + std::to_string(n_elements) +
                     " elements and holds " + std::to_string(n_read) + ".");
      }

      std::vector<long long>
      read_element_nodes(const ElementKind &kind, const std::string &what)
      {
        std::vector<long long> nodes;
        for (unsigned int a = 0; a < kind.n_nodes; ++a)
          nodes.push_back(text_.integer("a node of " + what));
        return nodes;
      }

      static std::string
      which(const std::string &thing, const std::size_t i, const std::size_t n)
      {
        return thing + ' ' + std::to_string(i + 1) + " of " + std::to_string(n);
      }

      static int
      dimension(const ElementKind &kind)
      {
        return kind.shape == ElementShape::point ? 0 :
               kind.shape == ElementShape::line  ? 1 :
                                                   2;
      }

      /** Refuses what isn't known: its number of nodes isn't either. */
      ElementKind
      to_kind(const long long type, const long long number) const
      {
        using Shape                                         = ElementShape;
        static const std::map<long long, ElementKind> kinds = {
          {15, {Shape::point, 1, "point"}},
          {1, {Shape::line, 2, "line"}},
          {8, {Shape::line, 3, "second-order line"}},
          {2, {Shape::triangle, 3, "triangle"}},
          {9, {Shape::triangle, 6, "second-order triangle"}},
          {3, {Shape::quadrilateral, 4, "quadrilateral"}},
          {16, {Shape::quadrilateral, 8, "8-node quadrilateral"}},
          {10, {Shape::quadrilateral, 9, "9-node quadrilateral"}}};
        static const std::map<long long, std::string> solids = {
          {4, "tetrahedron"},
          {5, "hexahedron"},
          {6, "prism"},
          {7, "pyramid"},
          {11, "second-order tetrahedron"},
          {12, "second-order hexahedron"},
          {13, "second-order prism"},
          {14, "second-order pyramid"},
          {17, "20-node hexahedron"},
          {18, "15-node prism"},
          {19, "13-node pyramid"}};
        const auto kind = kinds.find(type);
        if (kind != kinds.end())
          return kind->second;
        const auto  solid = solids.find(type);
        ElementKind unknown;
        unknown.shape = solid != solids.end() ? Shape::solid : Shape::other;
        unknown.name  = solid != solids.end() ? solid->second :
                                                "gmsh " + std::to_string(type);
        MeshBuilder(text_).add_element(number, unknown, {}, {});
        return unknown;
      }

      MeshText                               &text_;
      MeshBuilder                             builder_;
      double                                  version_ = 0.;
      std::set<std::string>                   found_;
      std::map<Tag, std::string>              names_;
      std::map<Tag, std::vector<std::string>> entity_groups_;
    };
  } // namespace


  MeshFile
  read_gmsh_mesh(MeshText &text)
  {
    return GmshReader(text).read();
  }
} // namespace Nacre
