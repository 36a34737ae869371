// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/mesh_reader.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace Nacre
{
  namespace
  {
    /** Arrays of cell data that hold groups, the better first. */
    constexpr std::array<const char *, 4> group_arrays = {
      {"gmsh:physical", "MaterialID", "CellEntityIds", "group"}};

    /** A legacy VTK file: "VTK file formats", VTK user's guide. */
    class VtkReader
    {
    public:
      explicit VtkReader(MeshText &text)
        : text_(text)
        , builder_(text)
      {}

      MeshFile
      read()
      {
        text_.line("the version");
        text_.line("the title");
        const std::string coding = text_.word("ASCII");
        if (coding != "ASCII")
          text_.fail("found '" + coding.substr(0, 40) +
                     "'; the file must be text: ASCII.");
        expect("DATASET");
        const std::string dataset = text_.word("the kind of the dataset");
        if (dataset != "UNSTRUCTURED_GRID" && dataset != "POLYDATA")
          text_.fail("the dataset is " + dataset +
                     "; known are UNSTRUCTURED_GRID and POLYDATA.");
        while (!text_.at_end())
          read_section(text_.word("a section"));
        if (!has_points_)
          text_.fail("the file has no POINTS: it is truncated or no mesh.");
        add_cells();
        return builder_.finish();
      }

    private:
      void
      expect(const std::string &word)
      {
        const std::string found = text_.word(word);
        if (found != word)
          text_.fail("found '" + found.substr(0, 40) + "' where " + word +
                     " should be.");
      }

      void
      read_section(const std::string &name)
      {
        if (name == "POINTS")
          read_points();
        else if (name == "CELLS")
          read_lists(0);
        else if (name == "VERTICES")
          read_lists(2);
        else if (name == "LINES")
          read_lists(4);
        else if (name == "POLYGONS")
          read_lists(7);
        else if (name == "CELL_TYPES")
          read_types();
        else if (name == "CELL_DATA" || name == "POINT_DATA")
          {
            of_cells_ = (name == "CELL_DATA");
            n_data_   = text_.count("the number of values");
          }
        else if (name == "SCALARS")
          read_scalars();
        else if (name == "FIELD")
          read_field();
        else if (name == "METADATA")
          {
            // Until an empty line.
            text_.line("METADATA");
            while (text_.has_line() && !text_.line("METADATA").empty())
              ;
          }
        else if (n_data_ == 0 && !name.empty() &&
                 std::isalpha(static_cast<unsigned char>(name[0])) == 0)
          text_.fail("found '" + name.substr(0, 40) +
                     "' where a section should begin: the one before holds "
                     "more than it announces.");
        // Other data are read over, word by word.
      }

      void
      read_points()
      {
        const auto n = text_.count("the number of points");
        text_.word("the type of the points");
        for (std::size_t i = 0; i < n; ++i)
          builder_.add_node(i,
                            text_.point("point " + std::to_string(i) + " of " +
                                        std::to_string(n)));
        has_points_ = true;
      }

      /** Lists of points, as "n p1 ... pn" or with offsets (version 5). */
      void
      read_lists(const int type)
      {
        const auto n    = text_.count("the number of cells");
        const auto size = text_.count("the size of the list of cells");
        if (text_.peek_line().find("OFFSETS") == 0)
          read_offsets(n, size, type);
        else
          for (std::size_t i = 0; i < n; ++i)
            {
              const std::string what =
                "cell " + std::to_string(i) + " of " + std::to_string(n);
              Cell cell{type, {}};
              for (auto k = text_.count("the number of points of " + what);
                   k > 0;
                   --k)
                cell.points.push_back(text_.integer("a point of " + what));
              cells_.push_back(cell);
            }
      }

      void
      read_offsets(const std::size_t n, const std::size_t size, const int type)
      {
        expect("OFFSETS");
        text_.word("the type of the offsets");
        std::vector<std::size_t> offsets;
        for (std::size_t i = 0; i < n; ++i)
          offsets.push_back(text_.count("an offset"));
        expect("CONNECTIVITY");
        text_.word("the type of the connectivity");
        std::vector<long long> points;
        for (std::size_t i = 0; i < size; ++i)
          points.push_back(text_.integer("a point of a cell"));
        for (std::size_t i = 0; i + 1 < n; ++i)
          {
            if (offsets[i] > offsets[i + 1] || offsets[i + 1] > size)
              text_.fail("the offsets of cell " + std::to_string(i) +
                         " are out of range.");
            cells_.push_back(
              {type,
               {points.begin() + offsets[i], points.begin() + offsets[i + 1]}});
          }
      }

      void
      read_types()
      {
        const auto n = text_.count("the number of types");
        if (n != cells_.size())
          text_.fail("there are " + std::to_string(cells_.size()) +
                     " cells and " + std::to_string(n) + " types.");
        for (Cell &cell : cells_)
          cell.type = text_.integer("the type of a cell");
        has_types_ = true;
      }

      void
      read_scalars()
      {
        const std::string name = text_.word("the name of an array");
        text_.word("the type of an array");
        std::string word         = text_.word("LOOKUP_TABLE");
        std::size_t n_components = 1;
        if (word != "LOOKUP_TABLE")
          {
            n_components = text_.to_integer(word, "the number of components");
            expect("LOOKUP_TABLE");
          }
        text_.word("the name of the table");
        read_array(name, n_components, n_data_);
      }

      void
      read_field()
      {
        text_.word("the name of the field");
        auto n_arrays = text_.count("the number of arrays");
        for (; n_arrays > 0; --n_arrays)
          {
            std::string name = text_.word("the name of an array");
            while (name == "METADATA")
              {
                read_section(name);
                name = text_.word("the name of an array");
              }
            const auto n_components = text_.count("the number of components");
            const auto n            = text_.count("the number of values");
            text_.word("the type of an array");
            read_array(name, n_components, n);
          }
      }

      void
      read_array(const std::string &name,
                 const std::size_t  n_components,
                 const std::size_t  n)
      {
        const bool wanted =
          of_cells_ && n_components == 1 &&
          std::find(group_arrays.begin(), group_arrays.end(), name) !=
            group_arrays.end();
        std::vector<long long> values;
        for (std::size_t i = 0; i < n_components * n; ++i)
          {
            const std::string word = text_.word("a value of " + name);
            if (wanted)
              values.push_back(
                static_cast<long long>(text_.to_number(word, "a group")));
          }
        if (wanted)
          arrays_[name] = values;
      }

      void
      add_cells()
      {
        if (!has_types_)
          for (const Cell &cell : cells_)
            if (cell.type == 0)
              text_.fail("the file has no CELL_TYPES: it is truncated.");
        const std::vector<long long> *groups = nullptr;
        for (const char *const name : group_arrays)
          if (groups == nullptr && arrays_.count(name) > 0)
            groups = &arrays_.at(name);
        if (groups != nullptr && groups->size() != cells_.size())
          text_.fail("there are " + std::to_string(cells_.size()) +
                     " cells and " + std::to_string(groups->size()) +
                     " values of their groups.");
        for (std::size_t k = 0; k < cells_.size(); ++k)
          {
            Cell &cell = cells_[k];
            if (cell.type == 8 && cell.points.size() == 4)
              std::swap(cell.points[2], cell.points[3]);
            const long long group = groups == nullptr ? 0 : (*groups)[k];
            builder_.add_element(k,
                                 to_kind(cell.type, cell.points.size()),
                                 cell.points,
                                 group_names(group));
          }
      }

      /** The kind of a type; some types come with several numbers of nodes. */
      static ElementKind
      to_kind(const int type, const std::size_t n)
      {
        using Shape                                   = ElementShape;
        static const std::map<int, ElementKind> kinds = {
          {1, {Shape::point, 1, "vertex"}},
          {2, {Shape::point, 1, "vertices"}},
          {3, {Shape::line, 2, "line"}},
          {4, {Shape::line, 2, "polyline"}},
          {5, {Shape::triangle, 3, "triangle"}},
          {8, {Shape::quadrilateral, 4, "pixel"}},
          {9, {Shape::quadrilateral, 4, "quad"}},
          {21, {Shape::line, 3, "quadratic edge"}},
          {22, {Shape::triangle, 6, "quadratic triangle"}},
          {23, {Shape::quadrilateral, 8, "quadratic quad"}},
          {28, {Shape::quadrilateral, 9, "biquadratic quad"}}};
        const auto found = kinds.find(type);
        if (found != kinds.end())
          return found->second;
        const unsigned int n_nodes = n;
        const std::string name = "VTK type " + std::to_string(type) + " with " +
                                 std::to_string(n) + " nodes";
        if (type == 7)
          return {n == 3 ? Shape::triangle : Shape::quadrilateral,
                  n == 3 ? 3u : 4u,
                  "polygon"};
        if (type == 68)
          return {Shape::line, n_nodes, name};
        if (type == 69)
          return {Shape::triangle, n_nodes, name};
        if (type == 70)
          return {n == 8 ? Shape::other : Shape::quadrilateral, n_nodes, name};
        const bool solid =
          (type >= 10 && type <= 14) || (type >= 24 && type <= 27) ||
          type == 29 || type == 32 || type == 33 || (type >= 71 && type <= 74);
        return {solid ? Shape::solid : Shape::other, n_nodes, name};
      }

      struct Cell
      {
        int                    type;
        std::vector<long long> points;
      };

      MeshText                                     &text_;
      MeshBuilder                                   builder_;
      bool                                          has_points_ = false;
      bool                                          has_types_  = false;
      std::vector<Cell>                             cells_;
      std::map<std::string, std::vector<long long>> arrays_;
      bool                                          of_cells_ = false;
      std::size_t                                   n_data_   = 0;
    };
  } // namespace


  MeshFile
  read_vtk_mesh(MeshText &text)
  {
    return VtkReader(text).read();
  }
} // namespace Nacre
