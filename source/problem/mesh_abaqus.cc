// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/problem/abaqus_deck.h>
#include <nacre/problem/abaqus_notes.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace Nacre
{
  namespace
  {
    using namespace Abaqus;

    bool
    begins_with_letter(const std::string &line)
    {
      return !line.empty() &&
             std::isalpha(static_cast<unsigned char>(line[0])) != 0;
    }

    /** An Abaqus input file: keyword lines, "*NODE", and lines of data. */
    class AbaqusReader
    {
    public:
      AbaqusReader(MeshText &text, const OpenFile &open)
        : text_(text)
        , open_(open)
        , deck_(text)
        , part_(&deck_.assembly)
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
        add_spare_cells();
        deck_.notes = notes_.sentences();
        if (!has_cells_)
          text_.fail("the file has no cells of a surface (shells, membranes or "
                     "plane elements)." +
                     (deck_.notes.empty() ? "" : " " + deck_.notes[0]));
        return assemble(deck_);
      }

    private:
      void
      begin_keyword(std::string line);
      void
      begin_block();
      void
      begin_instance();
      void
      begin_elements();
      void
      begin_set();
      void
      begin_surface();
      void
      end_keyword();
      void
      end_system();
      void
      include(const std::string &name);

      void
      read_data(const std::string &line);
      void
      add_node(const std::vector<std::string> &words);
      void
      add_to_element(const std::vector<std::string> &words, const bool goes_on);
      void
      end_element();
      void
      add_to_set(const std::vector<std::string> &words);
      void
      add_to_surface(const std::vector<std::string> &words);
      void
      add_motion(const std::vector<std::string> &words);

      std::vector<double>
      to_numbers(const std::vector<std::string> &words) const;
      std::string
      required(const std::string &parameter) const;
      void
      add_spare_cells();

      MeshText       &text_;
      const OpenFile &open_;
      Deck            deck_;
      /** The part that keywords add to. */
      Part   *part_;
      Keyword keyword_;
      bool    has_elements_ = false;

      /** Of the keyword *ELEMENT. */
      DeckElement              type_;
      std::vector<std::string> element_;
      /** Of *NSET and *ELSET, of *SURFACE; or nullptr. */
      SetEntry *set_     = nullptr;
      Surface  *surface_ = nullptr;
      /** Of *INSTANCE, until its end. */
      std::string         instance_;
      std::vector<double> translation_, turn_;
      unsigned int        n_motion_lines_ = 0;
      /** Of *SYSTEM, until the next one or the end of the part. */
      std::vector<double> system_values_;
      RigidMotion         system_;
      bool                in_system_ = false;

      /** A cell if there are no others. */
      struct SpareCell
      {
        Part                  *part;
        long long              number;
        DeckElement            type;
        std::vector<long long> nodes;
      };

      std::vector<SpareCell> spare_;
      bool                   has_cells_ = false;
      DeckNotes              notes_;
    };


    void
    AbaqusReader::begin_keyword(std::string line)
    {
      // It goes on after a comma, unless data follow.
      while (line.back() == ',' && begins_with_letter(text_.peek_line()))
        {
          text_.at_end();
          line += text_.line("the rest of a keyword");
        }
      const Keyword keyword(line);
      if (keyword.name == "*INCLUDE")
        {
          // It may hold data of the keyword before.
          if (keyword.value("INPUT").empty())
            text_.fail("*INCLUDE has no INPUT=.");
          include(keyword.value("INPUT"));
          return;
        }
      end_keyword();
      keyword_ = keyword;

      const std::string &name = keyword_.name;
      for (const char *const refused :
           {"*NGEN", "*NFILL", "*NCOPY", "*NMAP", "*ELGEN", "*ELCOPY"})
        if (name == refused)
          text_.fail("found " + name +
                     "; write all nodes and elements into this file.");
      notes_.see_keyword(keyword_);

      if (name == "*NODE" || name == "*ELEMENT" || name == "*NSET" ||
          name == "*ELSET" || name == "*SURFACE")
        begin_block();
      else if (name == "*INSTANCE")
        begin_instance();
      else if (name == "*PART")
        {
          deck_.parts.emplace_back(required("NAME"), text_);
          part_      = &deck_.parts.back();
          in_system_ = false;
        }
      else if (name == "*ENDPART" || name == "*ASSEMBLY" ||
               name == "*ENDINSTANCE" || name == "*ENDASSEMBLY")
        {
          part_      = &deck_.assembly;
          in_system_ = false;
          instance_.clear();
        }
    }


    /** Keywords whose data may be in a file of its own. */
    void
    AbaqusReader::begin_block()
    {
      if (keyword_.name == "*NODE")
        {
          const std::string system = upper_case(keyword_.value("SYSTEM"));
          if (!system.empty() && system != "R" && system != "C")
            text_.fail("found SYSTEM=" + system +
                       "; nodes are known in rectangular (R) and cylindrical "
                       "(C) coordinates. Write x, y, z.");
        }
      else if (keyword_.name == "*ELEMENT")
        begin_elements();
      else if (keyword_.name == "*SURFACE")
        begin_surface();
      else
        begin_set();
      if (keyword_.has("INPUT"))
        include(keyword_.value("INPUT"));
    }


    void
    AbaqusReader::begin_instance()
    {
      Instance instance;
      instance.name  = required("NAME");
      instance.part  = keyword_.value("PART");
      instance.where = text_.where();
      for (const Instance &other : deck_.instances)
        if (upper_case(other.name) == upper_case(instance.name))
          text_.fail("the instance '" + instance.name + "' stands twice.");
      if (instance.part.empty())
        {
          // Its own nodes and elements follow.
          deck_.parts.emplace_back(instance.name, text_);
          part_         = &deck_.parts.back();
          instance.part = instance.name;
        }
      else
        instance_ = instance.name;
      deck_.instances.push_back(instance);
      translation_.clear();
      turn_.clear();
      n_motion_lines_ = 0;
    }


    void
    AbaqusReader::begin_elements()
    {
      type_         = element_type(upper_case(required("TYPE")));
      has_elements_ = true;
    }


    void
    AbaqusReader::begin_set()
    {
      const bool of_nodes = keyword_.name == "*NSET";
      Set       &set      = (of_nodes ? part_->node_sets : part_->element_sets)
                   .item(required(of_nodes ? "NSET" : "ELSET"));
      set.entries.emplace_back();
      set_ = &set.entries.back();
      set_->instance =
        keyword_.has("INSTANCE") ? keyword_.value("INSTANCE") : instance_;
      if (of_nodes && keyword_.has("ELSET"))
        {
          set_->names       = {keyword_.value("ELSET")};
          set_->of_elements = true;
        }
    }


    void
    AbaqusReader::begin_surface()
    {
      const std::string name = required("NAME");
      const std::string type = upper_case(keyword_.value("TYPE"));
      if ((!type.empty() && type != "ELEMENT" && type != "NODE") ||
          keyword_.has("COMBINE") || keyword_.has("CROP"))
        {
          notes_.leave_out_surface(name);
          return;
        }
      surface_           = &part_->surfaces.item(name);
      surface_->of_nodes = type == "NODE";
    }


    /** What has begun must be complete. */
    void
    AbaqusReader::end_keyword()
    {
      if (!element_.empty())
        {
          if (type_.use != ElementUse::left_out &&
              element_.size() <= type_.kind.n_nodes)
            text_.fail("the element " + element_[0] + " has " +
                       std::to_string(element_.size() - 1) +
                       " nodes; its type " + type_.kind.name + " has " +
                       std::to_string(type_.kind.n_nodes) +
                       ". Is the file truncated?");
          end_element();
        }
      if (keyword_.name == "*SYSTEM")
        end_system();
      if (keyword_.name == "*INSTANCE" &&
          !instance_motion(translation_, turn_, deck_.instances.back().motion))
        text_.fail("the two points of the axis of the instance '" +
                   deck_.instances.back().name + "' are the same.");
      set_     = nullptr;
      surface_ = nullptr;
    }


    void
    AbaqusReader::end_system()
    {
      if (!local_system(system_values_, system_))
        text_.fail("the points of *SYSTEM don't define axes: the origin, a "
                   "point on the x axis and one with y > 0 are needed.");
      in_system_ = !system_values_.empty();
      system_values_.clear();
    }


    void
    AbaqusReader::include(const std::string &name)
    {
      const std::string folder =
        std::filesystem::path(text_.source_path()).parent_path().string();
      text_.include(open_(name, folder, text_.where()));
    }


    void
    AbaqusReader::read_data(const std::string &line)
    {
      const std::string &name  = keyword_.name;
      const auto         words = comma_separated(line);
      if (name.empty())
        text_.fail("found '" + line.substr(0, 40) +
                   "' before any keyword (*NODE).");
      if (words.empty() && name != "*INSTANCE")
        return;
      if (name == "*NODE")
        add_node(words);
      else if (name == "*ELEMENT")
        add_to_element(words, line.back() == ',');
      else if (set_ != nullptr)
        add_to_set(words);
      else if (surface_ != nullptr)
        add_to_surface(words);
      else if (name == "*SYSTEM" || name == "*INSTANCE")
        add_motion(words);
    }


    void
    AbaqusReader::add_node(const std::vector<std::string> &words)
    {
      const long long number = text_.to_integer(words[0], "a node's number");
      const auto      values = to_numbers({words.begin() + 1, words.end()});
      Point<3>        point;
      for (unsigned int c = 0; c < 3 && c < values.size(); ++c)
        point[c] = values[c];
      if (upper_case(keyword_.value("SYSTEM")) == "C")
        {
          const double radius = point[0];
          const double angle  = point[1] * numbers::PI / 180.;
          point[0]            = radius * std::cos(angle);
          point[1]            = radius * std::sin(angle);
          notes_.convert_node();
        }
      if (in_system_)
        {
          point = system_(point);
          notes_.move_node();
        }
      const auto known = part_->mesh.find_node(number);
      if (!known)
        part_->mesh.add_node(number, point);
      else if (*known != point)
        text_.fail("the node " + std::to_string(number) +
                   " stands twice, with different coordinates.");
      if (!keyword_.value("NSET").empty())
        part_->node_sets.item(keyword_.value("NSET")).add(number);
    }


    void
    AbaqusReader::add_to_element(const std::vector<std::string> &words,
                                 const bool                      goes_on)
    {
      element_.insert(element_.end(), words.begin(), words.end());
      const bool is_cell =
        type_.use == ElementUse::cell || type_.use == ElementUse::spare_cell;
      // Beams may have a further node, the number of others isn't known.
      const bool is_complete =
        is_cell && type_.kind.n_nodes > 0 ?
          element_.size() > type_.kind.n_nodes :
          !goes_on && element_.size() > type_.kind.n_nodes;
      if (is_complete)
        end_element();
    }


    void
    AbaqusReader::end_element()
    {
      const std::vector<std::string> words = std::move(element_);
      element_.clear();
      const long long number =
        text_.to_integer(words[0], "an element's number");
      if (!keyword_.value("ELSET").empty())
        part_->element_sets.item(keyword_.value("ELSET")).add(number);

      const bool is_line = type_.use == ElementUse::line;
      // Nodes of an instance, as "Plate-1.17": between parts.
      bool left_out = type_.use == ElementUse::left_out;
      for (std::size_t i = 1; is_line && i <= type_.kind.n_nodes; ++i)
        left_out = left_out || words[i].find('.') != std::string::npos;
      if (left_out)
        {
          notes_.leave_out_element(type_);
          part_->left_out.insert(number);
          return;
        }
      std::vector<long long> nodes;
      const std::size_t n = is_line ? type_.kind.n_nodes : words.size() - 1;
      for (std::size_t i = 1; i <= n; ++i)
        nodes.push_back(
          text_.to_integer(words[i], "a node of the element " + words[0]));
      if (type_.use == ElementUse::spare_cell)
        {
          spare_.push_back({part_, number, type_, nodes});
          return;
        }
      part_->mesh.add_element(number, type_.kind, nodes, {});
      if (is_line)
        notes_.add_line(type_);
      else
        has_cells_ = true;
      if (type_.is_plane)
        part_->plane.insert(number);
    }


    /** Numbers, names of sets, or with GENERATE: first, last, step. */
    void
    AbaqusReader::add_to_set(const std::vector<std::string> &words)
    {
      if (!keyword_.has("GENERATE"))
        {
          for (const std::string &word : words)
            if (is_number(word))
              set_->add(text_.to_integer(word, "a number"));
            else if (!word.empty())
              set_->names.push_back(word);
          return;
        }
      if (words.size() < 2 || words.size() > 3)
        text_.fail("GENERATE needs 'first, last, step'.");
      Range range;
      range.first = text_.to_integer(words[0], "the first number");
      range.last  = text_.to_integer(words[1], "the last number");
      if (words.size() == 3)
        range.step = text_.to_integer(words[2], "the step");
      if (range.first < 0 || range.last < range.first || range.step < 1)
        text_.fail("GENERATE needs 'first, last, step' with "
                   "0 <= first <= last and a step above zero.");
      set_->numbers.push_back(range);
    }


    void
    AbaqusReader::add_to_surface(const std::vector<std::string> &words)
    {
      surface_->entries.push_back(
        {instance_,
         words[0],
         words.size() > 1 && !surface_->of_nodes ? upper_case(words[1]) : ""});
    }


    void
    AbaqusReader::add_motion(const std::vector<std::string> &words)
    {
      const auto values = to_numbers(words);
      if (keyword_.name == "*INSTANCE")
        {
          (n_motion_lines_ == 0 ? translation_ : turn_) = values;
          ++n_motion_lines_;
          return;
        }
      // A second line has the third point.
      if (!system_values_.empty())
        system_values_.resize(std::max<std::size_t>(6, system_values_.size()));
      system_values_.insert(system_values_.end(), values.begin(), values.end());
    }


    /** What is blank is zero. */
    std::vector<double>
    AbaqusReader::to_numbers(const std::vector<std::string> &words) const
    {
      std::vector<double> values;
      for (const std::string &word : words)
        values.push_back(word.empty() ? 0. :
                                        text_.to_number(word, "a coordinate"));
      return values;
    }


    std::string
    AbaqusReader::required(const std::string &parameter) const
    {
      const std::string value = keyword_.value(parameter);
      if (value.empty())
        text_.fail(keyword_.name + " has no " + parameter + "=.");
      return value;
    }


    /** Beside cells they are tools or a skin; alone they are a mesh. */
    void
    AbaqusReader::add_spare_cells()
    {
      for (const SpareCell &element : spare_)
        if (has_cells_)
          {
            notes_.leave_out_element(element.type);
            element.part->left_out.insert(element.number);
          }
        else
          element.part->mesh.add_element(element.number,
                                         element.type.kind,
                                         element.nodes,
                                         {});
      has_cells_ = has_cells_ || !spare_.empty();
    }
  } // namespace


  MeshFile
  read_abaqus_mesh(MeshText &text, const OpenFile &open)
  {
    return AbaqusReader(text, open).read();
  }
} // namespace Nacre
