// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/problem/mesh_reader.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace Nacre
{
  namespace
  {
    std::string
    upper_case(std::string text)
    {
      for (char &c : text)
        c = std::toupper(static_cast<unsigned char>(c));
      return text;
    }

    /** Words between commas, trimmed; an empty one at the end is left out. */
    std::vector<std::string>
    comma_separated(const std::string &line)
    {
      std::vector<std::string> words;
      std::size_t              begin = 0;
      while (begin <= line.size())
        {
          const auto comma = std::min(line.find(',', begin), line.size());
          words.push_back(Text::trim(line.substr(begin, comma - begin)));
          begin = comma + 1;
        }
      if (words.back().empty())
        words.pop_back();
      return words;
    }

    /** Shells, membranes and plane elements by the name of their type. */
    ElementKind
    to_kind(const std::string &type)
    {
      using Shape = ElementShape;
      for (const char *const line : {"T2D", "T3D", "B2", "B3", "SAX", "R2D"})
        if (type.find(line) == 0)
          {
            const bool quadratic = type == "T2D3" || type == "T3D3" ||
                                   type.find("B22") == 0 ||
                                   type.find("B32") == 0 || type == "SAX2";
            return {Shape::line, quadratic ? 3u : 2u, type};
          }
      for (const char *const solid : {"C3D", "DC3D", "AC3D", "CC3D", "SC"})
        if (type.find(solid) == 0)
          return {Shape::solid, 0, type};
      if (type == "STRI65")
        return {Shape::triangle, 6, type};
      for (const std::string family :
           {"STRI", "SFM3D", "M3D", "CPS", "CPE", "R3D", "DS", "S"})
        if (type.find(family) == 0 && type.size() > family.size())
          switch (type[family.size()])
            {
              case '3':
                return {Shape::triangle, 3, type};
              case '4':
                return {Shape::quadrilateral, 4, type};
              case '6':
                return {Shape::triangle, 6, type};
              case '8':
                return {Shape::quadrilateral, 8, type};
              case '9':
                return {Shape::quadrilateral, 9, type};
              default:
                break;
            }
      return {Shape::other, 0, type};
    }

    /** An Abaqus input file: keyword lines, "*NODE", and lines of data. */
    class AbaqusReader
    {
    public:
      explicit AbaqusReader(MeshText &text)
        : text_(text)
        , builder_(text)
      {}

      MeshFile
      read()
      {
        while (!text_.at_end())
          {
            const std::string line = text_.line("a line");
            if (line.compare(0, 2, "**") == 0)
              continue;
            if (line[0] == '*')
              begin_keyword(line);
            else
              read_data(line);
          }
        end_keyword();
        if (!has_elements_)
          text_.fail("the file has no elements (*ELEMENT): it is truncated or "
                     "no mesh.");
        return finish();
      }

    private:
      void
      begin_keyword(std::string line)
      {
        end_keyword();
        while (!line.empty() && line.back() == ',')
          line += text_.line("the rest of a keyword");
        parameters_.clear();
        const auto words = comma_separated(line);
        keyword_         = upper_case(words[0]);
        for (std::size_t i = 1; i < words.size(); ++i)
          {
            const auto equals = words[i].find('=');
            parameters_[upper_case(Text::trim(words[i].substr(0, equals)))] =
              equals == std::string::npos ?
                "" :
                Text::trim(words[i].substr(equals + 1));
          }
        for (const char *const refused :
             {"*INCLUDE", "*NGEN", "*NFILL", "*NCOPY", "*ELGEN", "*ELCOPY"})
          if (keyword_ == refused)
            text_.fail("found " + keyword_ +
                       "; write all nodes and elements into this file.");
        if (keyword_ == "*ELEMENT")
          begin_elements();
        if (keyword_ == "*ELSET" || keyword_ == "*NSET")
          set_name_ = required(keyword_.substr(1));
        if (keyword_ == "*NODE" && parameters_.count("SYSTEM") > 0 &&
            upper_case(parameters_["SYSTEM"]) != "R")
          text_.fail("the nodes are in a system of coordinates that isn't "
                     "known; write x, y, z.");
      }

      const std::string &
      required(const std::string &parameter)
      {
        if (parameters_.count(parameter) == 0)
          text_.fail(keyword_ + " has no " + parameter + "=.");
        return parameters_[parameter];
      }

      void
      begin_elements()
      {
        kind_         = to_kind(upper_case(required("TYPE")));
        has_elements_ = true;
      }

      /** An element that has begun must have got all of its nodes. */
      void
      end_keyword()
      {
        if (!element_.empty())
          text_.fail("the element " + element_[0] + " has " +
                     std::to_string(element_.size() - 1) + " nodes; its type " +
                     kind_.name + " has " + std::to_string(kind_.n_nodes) +
                     ". Is the file truncated?");
      }

      void
      read_data(const std::string &line)
      {
        const auto words = comma_separated(line);
        if (keyword_ == "*NODE")
          add_node(words);
        else if (keyword_ == "*ELEMENT")
          add_to_element(words);
        else if (keyword_ == "*ELSET")
          add_to_set(words, element_sets_);
        else if (keyword_ == "*NSET")
          add_to_set(words, node_sets_);
        else if (keyword_ == "*INSTANCE")
          text_.fail("the instance is moved or turned; write the nodes where "
                     "they are.");
        else if (keyword_.empty())
          text_.fail("found '" + line.substr(0, 40) +
                     "' before any keyword (*NODE).");
      }

      void
      add_node(const std::vector<std::string> &words)
      {
        if (words.size() < 3)
          text_.fail("a node needs a number and two or three coordinates: is "
                     "the file truncated?");
        const long long number = text_.to_integer(words[0], "a node's number");
        Point<3>        point;
        for (unsigned int c = 0; c < 3 && c + 1 < words.size(); ++c)
          point[c] = text_.to_number(words[c + 1],
                                     "a coordinate of the node " + words[0]);
        builder_.add_node(number, point);
        if (parameters_.count("NSET") > 0)
          node_sets_[parameters_["NSET"]].insert(number);
      }

      void
      add_to_element(const std::vector<std::string> &words)
      {
        element_.insert(element_.end(), words.begin(), words.end());
        const bool known = kind_.shape != ElementShape::solid &&
                           kind_.shape != ElementShape::other;
        if (known && element_.size() <= kind_.n_nodes)
          return;
        const long long number =
          text_.to_integer(element_[0], "an element's number");
        std::vector<long long> nodes;
        for (std::size_t i = 1; i < element_.size(); ++i)
          nodes.push_back(
            text_.to_integer(element_[i],
                             "a node of the element " + element_[0]));
        element_.clear();
        builder_.add_element(number, kind_, nodes, {});
        if (parameters_.count("ELSET") > 0)
          sets_of_elements_[parameters_["ELSET"]].insert(number);
        if (kind_.shape != ElementShape::line)
          cells_.insert(number);
      }

      using Sets = std::map<std::string, std::set<long long>>;

      /** Numbers, names of sets, or with GENERATE: first, last, step. */
      void
      add_to_set(const std::vector<std::string> &words, Sets &sets)
      {
        auto &set = sets[set_name_];
        if (parameters_.count("GENERATE") > 0)
          {
            if (words.size() < 2 || words.size() > 3)
              text_.fail("GENERATE needs 'first, last, step'.");
            const auto first = text_.to_integer(words[0], "the first number");
            const auto last  = text_.to_integer(words[1], "the last number");
            const auto step =
              words.size() < 3 ? 1 : text_.to_integer(words[2], "the step");
            if (step < 1 || last < first)
              text_.fail("GENERATE needs 'first, last, step' with "
                         "first <= last and a step above zero.");
            for (auto i = first; i <= last; i += step)
              set.insert(i);
            return;
          }
        for (const std::string &word : words)
          {
            const auto other = sets.find(word);
            if (other != sets.end())
              set.insert(other->second.begin(), other->second.end());
            else if (&sets == &element_sets_ &&
                     sets_of_elements_.count(word) > 0)
              set.insert(sets_of_elements_[word].begin(),
                         sets_of_elements_[word].end());
            else
              set.insert(
                text_.to_integer(word, "a number or the name of a set"));
          }
      }

      MeshFile
      finish()
      {
        MeshFile mesh          = builder_.finish();
        mesh.names_ignore_case = true;
        std::map<long long, unsigned int> cells, lines, nodes;
        for (const auto &cell : mesh.cells)
          cells.emplace(cell.number, cells.size());
        for (const auto &line : mesh.lines)
          lines.emplace(line.number, lines.size());
        for (const long long number : mesh.node_numbers)
          nodes.emplace(number, nodes.size());
        const auto make = [](const Sets                              &sets,
                             const std::map<long long, unsigned int> &indices) {
          MeshSets result;
          for (const auto &[name, set] : sets)
            for (const long long number : set)
              {
                const auto found = indices.find(number);
                if (found != indices.end())
                  result.add(name, found->second);
              }
          return result.finish();
        };
        for (auto &[name, set] : sets_of_elements_)
          element_sets_.emplace(name, set);
        mesh.cell_sets = make(element_sets_, cells);
        mesh.line_sets = make(element_sets_, lines);
        mesh.node_sets = make(node_sets_, nodes);
        return mesh;
      }

      MeshText                          &text_;
      MeshBuilder                        builder_;
      std::string                        keyword_;
      std::map<std::string, std::string> parameters_;
      ElementKind                        kind_;
      std::vector<std::string>           element_;
      std::string                        set_name_;
      std::set<long long>                cells_;
      /** From the keywords *ELSET and *NSET; from *ELEMENT. */
      Sets element_sets_;
      Sets node_sets_;
      Sets sets_of_elements_;
      bool has_elements_ = false;
    };
  } // namespace


  MeshFile
  read_abaqus_mesh(MeshText &text)
  {
    return AbaqusReader(text).read();
  }
} // namespace Nacre
