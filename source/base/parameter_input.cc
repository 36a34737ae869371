// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/input_file.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/output_file.h>
#include <nacre/base/parameter_input.h>
#include <nacre/base/text.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

// Boost 1.74 warns of a header that it includes itself.
#define BOOST_BIND_GLOBAL_PLACEHOLDERS
#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

namespace Nacre
{
  using namespace dealii;

  namespace
  {
    using Tree = boost::property_tree::ptree;
    using Path = std::vector<std::string>;

    constexpr auto declaration_order = ParameterHandler::KeepDeclarationOrder;

    /**
     * The declared sections and parameters by their plain names.
     * ParameterHandler doesn't show them in another way.
     */
    Tree
    declared_parameters()
    {
      std::stringstream json;
      ParameterAcceptor::prm.print_parameters(
        json,
        static_cast<ParameterHandler::OutputStyle>(ParameterHandler::JSON |
                                                   declaration_order));
      Tree tree;
      boost::property_tree::read_json(json, tree);
      return tree;
    }

    /** The text of a parameter's property as "value", or nothing. */
    std::optional<std::string>
    property(const Tree &parameter, const std::string &name)
    {
      const auto child = parameter.find(name);
      if (child == parameter.not_found() || !child->second.empty())
        return {};
      return child->second.data();
    }

    bool
    is_parameter(const Tree &tree)
    {
      return property(tree, "value") && property(tree, "pattern_description");
    }

    /** Names of the subsections, or of the parameters, of @p section. */
    Path
    names(const Tree &section, const bool parameters)
    {
      Path result;
      for (const auto &child : section)
        if (is_parameter(child.second) == parameters)
          result.push_back(child.first);
      return result;
    }

    const Tree *
    find(const Tree &section, const std::string &name, const bool parameter)
    {
      const auto child = section.find(name);
      return child != section.not_found() &&
                 is_parameter(child->second) == parameter ?
               &child->second :
               nullptr;
    }

    std::string
    join(const Path &path, const std::string &name = "")
    {
      std::string result;
      for (const auto &part : path)
        result += (result.empty() ? "" : "/") + part;
      return result + (result.empty() || name.empty() ? "" : "/") + name;
    }

    /** The alternatives of a selection "[Selection a|b|c ]", or none. */
    Path
    alternatives(const Tree &parameter)
    {
      const std::string text  = *property(parameter, "pattern_description");
      const std::string begin = "[Selection ";
      if (text.rfind(begin, 0) != 0)
        return {};
      const auto end = text.rfind(']');
      Path       result;
      for (const auto &name :
           Utilities::split_string_list(text.substr(begin.size(),
                                                    end - begin.size()),
                                        '|'))
        result.push_back(Text::trim(name));
      return result;
    }

    /** What a pattern allows; a list without its bound of 2^32 - 1. */
    std::string
    allowed_values(const Patterns::PatternBase &pattern)
    {
      const std::string text =
        Text::trim(pattern.description(Patterns::PatternBase::Text));
      const std::string begin  = "A list of ";
      const std::string middle = " to " +
                                 std::to_string(Patterns::List::max_int_value) +
                                 " elements where each element is [";
      const auto at = text.find(middle);
      if (text.rfind(begin, 0) != 0 || at == std::string::npos ||
          text.back() != ']')
        return text;
      const auto number = text.substr(begin.size(), at - begin.size());
      const auto inside = at + middle.size();
      return "A list, separated by commas, of at least " + number +
             " of: " + text.substr(inside, text.size() - inside - 1);
    }

    void
    check_value(const Tree        &parameter,
                const std::string &value,
                const std::string &where)
    {
      AssertThrow(value.find_first_of("{}#\n") == std::string::npos,
                  ExcMessage(where + ": '" + value +
                             "' holds one of the characters '{', '}', '#', "
                             "which have a special meaning in parameter "
                             "files."));
      const auto pattern =
        Patterns::pattern_factory(*property(parameter, "pattern_description"));
      if (pattern->match(value))
        return;
      const Path known = alternatives(parameter);
      AssertThrow(known.empty(),
                  ExcMessage(Text::unknown_name(where, "value", value, known)));
      AssertThrow(false,
                  ExcMessage(where + ": the value '" + value +
                             "' is not allowed. Allowed: " +
                             allowed_values(*pattern) + "."));
    }

    void
    collect_values(const Tree                         &section,
                   const std::string                  &path,
                   std::map<std::string, std::string> &values)
    {
      for (const auto &[name, child] : section)
        if (is_parameter(child))
          values[path + name] = *property(child, "value");
        else
          collect_values(child, path + name + "/", values);
    }

    /** Checks a file line by line as ParameterHandler would read it. */
    class FileScanner
    {
    public:
      explicit FileScanner(const std::string &file)
        : file_(file)
        , declared_(declared_parameters())
        , sections_{&declared_}
      {}

      /** Throw what is wrong with @p content. */
      void
      check(const std::string &content)
      {
        std::istringstream in(content);
        std::string        line, joined;
        bool               continued = false;
        for (unsigned int n = 1; std::getline(in, line); ++n)
          {
            line = Text::trim(line);
            if (!continued)
              line_ = n;
            continued = !line.empty() && line.back() == '\\';
            if (continued)
              line.pop_back();
            joined += line;
            if (!continued)
              {
                check_line(joined);
                joined.clear();
              }
          }
        if (continued)
          check_line(joined);
        AssertThrow(path_.empty(),
                    ExcMessage(file_ + ": the 'end' of subsection '" +
                               join(path_) + "', which begins in line " +
                               std::to_string(begins_.back()) +
                               ", is missing."));
      }

    private:
      std::string
      here() const
      {
        return file_ + ", line " + std::to_string(line_);
      }

      std::string
      here_in_section() const
      {
        return here() +
               (path_.empty() ? "" : ", subsection '" + join(path_) + "'");
      }

      void
      check_line(const std::string &raw)
      {
        std::string line = raw.substr(0, raw.find('#'));
        std::replace(line.begin(), line.end(), '\t', ' ');
        line             = Text::trim(line);
        const auto space = line.find(' ');
        const auto rest =
          space == std::string::npos ? "" : Text::trim(line.substr(space));
        const auto word = line.substr(0, space);
        if (line.empty() || word == "include" || word == "INCLUDE")
          return; // ParameterHandler reports what is wrong in another file.
        if (word == "subsection" || word == "SUBSECTION")
          enter(rest);
        else if (word == "end" || word == "END")
          {
            AssertThrow(rest.empty(),
                        ExcMessage(here() + ": '" + rest +
                                   "' stands behind 'end'."));
            leave();
          }
        else if (word == "set" || word == "SET")
          check_entry(rest);
        else
          AssertThrow(false,
                      ExcMessage(Text::unknown_name(
                        here(),
                        "statement",
                        line,
                        {"subsection", "set", "end", "include"})));
      }

      void
      enter(const std::string &name)
      {
        const Tree *const section = find(*sections_.back(), name, false);
        if (section == nullptr)
          unknown("subsection", name, false);
        sections_.push_back(section);
        path_.push_back(name);
        begins_.push_back(line_);
      }

      void
      leave()
      {
        AssertThrow(!path_.empty(),
                    ExcMessage(here() +
                               ": this 'end' has no 'subsection' to end."));
        sections_.pop_back();
        path_.pop_back();
        begins_.pop_back();
      }

      void
      check_entry(const std::string &entry)
      {
        const auto equals = entry.find('=');
        AssertThrow(equals != std::string::npos,
                    ExcMessage(here() + ": 'set " + entry +
                               "' has no '='; 'set Parameter = value' is "
                               "expected."));
        const std::string name      = Text::trim(entry.substr(0, equals));
        const Tree *const parameter = find(*sections_.back(), name, true);
        if (parameter == nullptr)
          unknown("parameter", name, true);
        check_value(*parameter,
                    Text::trim(entry.substr(equals + 1)),
                    here() + ", '" + join(path_, name) + "'");
      }

      /** Throw that there is no such section or parameter here. */
      [[noreturn]] void
      unknown(const std::string &kind,
              const std::string &name,
              const bool         parameter) const
      {
        std::string message =
          Text::unknown_name(here_in_section(),
                             kind,
                             name,
                             names(*sections_.back(), parameter));
        for (std::size_t i = 0; i + 1 < sections_.size(); ++i)
          if (find(*sections_[i], name, parameter) != nullptr)
            {
              message += " There is one outside of subsection '" + path_[i] +
                         "', which begins in line " +
                         std::to_string(begins_[i]) + ": is its 'end' missing?";
              break;
            }
        throw ExcMessage(message);
      }

      std::string file_;
      Tree        declared_;
      /** Line of the statement that is being checked. */
      unsigned int line_ = 0;
      /** The sections that are open, the whole tree first. */
      std::vector<const Tree *> sections_;
      Path                      path_;
      /** Where each of path_ begins. */
      std::vector<unsigned int> begins_;
    };

    std::string
    read_file(const std::string &file)
    {
      AssertThrow(std::filesystem::exists(file),
                  ExcMessage("The parameter file '" + file +
                             "' doesn't exist."));
      AssertThrow(!std::filesystem::is_directory(file),
                  ExcMessage("'" + file +
                             "' is a folder; a parameter file is expected."));
      std::ifstream in(file);
      AssertThrow(in.good(),
                  ExcMessage("The parameter file '" + file +
                             "' can't be read."));
      std::ostringstream content;
      content << in.rdbuf();
      return plain_text(content.str(), file);
    }

    /** The section in which the parameter @p full_name is, and its name. */
    std::pair<const Tree *, Path>
    resolve(const Tree        &declared,
            const std::string &full_name,
            const std::string &where)
    {
      Path        path;
      const Tree *section = &declared;
      for (const auto &part : Utilities::split_string_list(full_name, '/'))
        path.push_back(Text::trim(part));
      for (std::size_t i = 0; i + 1 < path.size(); ++i)
        {
          const Tree *const next = find(*section, path[i], false);
          AssertThrow(next != nullptr,
                      ExcMessage(Text::unknown_name(where,
                                                    "section",
                                                    path[i],
                                                    names(*section, false))));
          section = next;
        }
      const std::string name = path.empty() ? "" : path.back();
      AssertThrow(
        find(*section, name, true) != nullptr,
        ExcMessage(
          Text::unknown_name(where, "parameter", name, names(*section, true))));
      return {section, path};
    }

    void
    apply_override(const Tree &declared, const std::string &text)
    {
      const std::string where = "--set \"" + text + "\"";
      // Edges such as u=0 are part of values, never of names.
      const auto equals = text.find('=');
      AssertThrow(equals != std::string::npos,
                  ExcMessage(where +
                             " has no '='; \"Section/Parameter=value\" is "
                             "expected."));
      const std::string value = Text::trim(text.substr(equals + 1));
      const auto [section, path] =
        resolve(declared, text.substr(0, equals), where);
      check_value(*find(*section, path.back(), true), value, where);

      auto &prm = ParameterAcceptor::prm;
      for (std::size_t i = 0; i + 1 < path.size(); ++i)
        prm.enter_subsection(path[i]);
      prm.set(path.back(), value);
      for (std::size_t i = 0; i + 1 < path.size(); ++i)
        prm.leave_subsection();
    }
  } // namespace


  void
  read_parameters(const std::string              &file,
                  const std::vector<std::string> &overrides)
  {
    const std::string content = read_file(file);
    ParameterAcceptor::declare_all_parameters();
    FileScanner(file).check(content);
    try
      {
        std::istringstream in(content);
        ParameterAcceptor::prm.parse_input(in, file);
      }
    catch (const ExceptionBase &exception)
      {
        std::ostringstream reason;
        exception.print_info(reason);
        AssertThrow(false, ExcMessage(file + ": " + Text::trim(reason.str())));
      }
    const Tree declared = declared_parameters();
    for (const auto &text : overrides)
      apply_override(declared, text);
    ParameterAcceptor::parse_all_parameters();
  }


  void
  write_used_parameters(const std::string &file)
  {
    write_file(file, [](std::ostream &out) {
      out << "# The parameters of a run of nacre " << NACRE_VERSION
          << "; running this file repeats it.\n";
      ParameterAcceptor::prm.print_parameters(
        out,
        static_cast<ParameterHandler::OutputStyle>(ParameterHandler::ShortPRM |
                                                   declaration_order));
    });
  }


  std::map<std::string, std::string>
  parameter_values()
  {
    std::map<std::string, std::string> values;
    collect_values(declared_parameters(), "", values);
    return values;
  }


  void
  print_template(std::ostream &out)
  {
    ParameterAcceptor::declare_all_parameters();
    // ParameterHandler throws on a stream that writes nothing: other ranks'.
    std::ostringstream text;
    ParameterAcceptor::prm.print_parameters(
      text,
      static_cast<ParameterHandler::OutputStyle>(ParameterHandler::PRM |
                                                 declaration_order));
    out << text.str();
  }


  void
  print_documentation(std::ostream &out, const std::string &parameter)
  {
    const Tree declared        = declared_parameters();
    const auto [section, path] = resolve(declared, parameter, "--list");
    const Tree &entry          = *find(*section, path.back(), true);
    out << parameter << '\n';
    for (const auto &line : Utilities::break_text_into_lines(
           property(entry, "documentation").value_or(""),
           74))
      out << "    " << line << '\n';
    for (const auto &name : alternatives(entry))
      {
        out << "  " << name;
        if (const Tree *const details = find(*section, name, false))
          {
            const Path parameters = names(*details, true);
            for (std::size_t i = 0; i < parameters.size(); ++i)
              out << (i == 0 ? ": " : ", ") << parameters[i];
          }
        out << '\n';
      }
  }
} // namespace Nacre
