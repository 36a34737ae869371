// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/expression.h>
#include <nacre/base/input_file.h>
#include <nacre/base/parameter_input.h>
#include <nacre/base/text.h>
#include <nacre/simulation/problem_record.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iomanip>
#include <sstream>
#include <vector>

namespace Nacre
{
  namespace
  {
    const std::string mesh_file_name = "Mid-surface/file/File name";
    /** No parameter, but what it names. */
    const std::string imperfection_files =
      "Mid-surface/Imperfection/(content of the files)";

    /**
     * Parameters, and sections with their '/', that a path may go on with
     * other values of: they change where it ends, how it is solved, and what
     * is told of it. All others define the problem. A mesh file may be moved:
     * its content counts.
     */
    const std::vector<std::string> &
    free_parameters()
    {
      static const std::vector<std::string> names = {
        "Title",
        "Study/Write VTU",
        "Study/Output format",
        "Study/Ranks per VTU file",
        "Study/Output subdivisions",
        "Study/Thick output",
        "Study/Report seconds",
        mesh_file_name,
        "Discretization/Assembly",
        "Discretization/Tangent",
        "Analysis/End time",
        "Analysis/Time step",
        "Analysis/Minimum time step",
        "Analysis/Maximum time step",
        "Analysis/Maximum steps",
        "Analysis/Maximum points",
        "Analysis/Stop where",
        "Analysis/Output times",
        "Analysis/Maximum iterations",
        "Analysis/Increment tolerance",
        "Analysis/Energy tolerance",
        "Analysis/Damping of iterations",
        "Analysis/Tangent updates",
        "Analysis/Line search",
        "Analysis/VTU steps",
        "Analysis/Checkpoint steps",
        "Linear solver/",
        "Output/",
        "Quantities/",
        "Exact solution/"};
      return names;
    }

    bool
    is_free(const std::string &parameter)
    {
      const auto &names = free_parameters();
      return std::any_of(names.begin(), names.end(), [&](const auto &name) {
        return name.back() == '/' ? parameter.rfind(name, 0) == 0 :
                                    parameter == name;
      });
    }

    bool
    is_of_name(const char c)
    {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    }

    /** Names, numbers (all digits) and signs of a text, without white space. */
    std::vector<std::string>
    words_of(const std::string &text)
    {
      std::vector<std::string> words;
      for (std::size_t k = 0; k < text.size();)
        {
          const auto  c   = static_cast<unsigned char>(text[k]);
          char       *end = nullptr;
          std::size_t n   = 1;
          std::string word(1, text[k]);
          if (std::isdigit(c) != 0 || c == '.')
            {
              std::ostringstream number;
              number << std::setprecision(17)
                     << std::strtod(text.c_str() + k, &end);
              n = end - (text.c_str() + k);
              if (n > 0)
                word = number.str();
              n = std::max<std::size_t>(n, 1);
            }
          else if (is_of_name(text[k]))
            {
              while (k + n < text.size() && is_of_name(text[k + n]))
                ++n;
              word = text.substr(k, n);
            }
          if (std::isspace(c) == 0)
            words.push_back(word);
          k += n;
        }
      return words;
    }

    std::string
    quoted(const std::map<std::string, std::string> &values,
           const std::string                        &name)
    {
      const auto found = values.find(name);
      return found == values.end() ? "unknown" : "'" + found->second + "'";
    }

    /** Constants that only one of both knows change nothing by themselves. */
    bool
    constants_differ(const std::string &then, const std::string &now)
    {
      const auto first  = parse_constants(then, "Constants");
      const auto second = parse_constants(now, "Constants");
      return std::any_of(first.begin(), first.end(), [&](const auto &entry) {
        const auto other = second.find(entry.first);
        return other != second.end() && other->second != entry.second;
      });
    }

    /** The changes of the parameters that @p count. */
    template <typename Predicate>
    std::string
    changes(const ProblemRecord &then,
            const ProblemRecord &now,
            const Predicate     &counts)
    {
      // Either may know parameters that the other's version doesn't.
      auto all = then.parameters;
      all.insert(now.parameters.begin(), now.parameters.end());
      std::string text;
      for (const auto &[name, value] : all)
        if (counts(name) && has_changed(name, then, now))
          text += (text.empty() ? "" : "; ") + name + ": " +
                  quoted(then.parameters, name) + " then, " +
                  quoted(now.parameters, name) + " now";
      return text;
    }
  } // namespace


  ProblemRecord
  current_problem(const MPI_Comm communicator, const Midsurface &midsurface)
  {
    ProblemRecord record;
    record.n_ranks    = Utilities::MPI::n_mpi_processes(communicator);
    record.parameters = parameter_values();
    // Where the files are is no part of the problem.
    record.parameters.erase("Study/Name");
    record.parameters.erase("Study/Output folder");
    if (Text::trim(record.parameters["Mid-surface/Surface"]) == "file")
      record.mesh_file =
        fingerprint(read_input_file(communicator,
                                    record.parameters[mesh_file_name],
                                    "",
                                    mesh_file_name)
                      .content);
    const std::string imperfection = midsurface.imperfection_files();
    if (!imperfection.empty())
      record.parameters[imperfection_files] = fingerprint(imperfection);
    return record;
  }

  bool
  has_changed(const std::string   &parameter,
              const ProblemRecord &then,
              const ProblemRecord &now)
  {
    const auto first  = then.parameters.find(parameter);
    const auto second = now.parameters.find(parameter);
    if (first == then.parameters.end() || second == now.parameters.end())
      return true;
    if (parameter == "Constants")
      return constants_differ(first->second, second->second);
    return words_of(first->second) != words_of(second->second);
  }

  std::string
  forbidden_changes(const ProblemRecord &then, const ProblemRecord &now)
  {
    std::string text = changes(then, now, [](const std::string &name) {
      return !is_free(name);
    });
    if (then.mesh_file != now.mesh_file)
      text += (text.empty() ? "" : "; ") + mesh_file_name +
              ": the file has another content now";
    return text;
  }

  std::string
  permitted_changes(const ProblemRecord &then, const ProblemRecord &now)
  {
    std::string text = changes(then, now, is_free);
    if (then.n_ranks != now.n_ranks)
      text += (text.empty() ? "" : "; ") + std::string("ranks: ") +
              std::to_string(then.n_ranks) + " then, " +
              std::to_string(now.n_ranks) + " now";
    return text;
  }

  std::string
  changes_in(const std::string   &section,
             const ProblemRecord &then,
             const ProblemRecord &now)
  {
    return changes(then, now, [&](const std::string &name) {
      return name.rfind(section + "/", 0) == 0;
    });
  }

  bool
  mentions(const ProblemRecord &record,
           const std::string   &section,
           const std::string   &name)
  {
    for (const auto &[parameter, value] : record.parameters)
      if (parameter.rfind(section + "/", 0) == 0)
        {
          // Names of places stand before a colon.
          bool found = false;
          for (const auto &word : words_of(value + ";"))
            {
              if (word == ";" && found)
                return true;
              found = (word == name) || (found && word != ":");
            }
        }
    return false;
  }
} // namespace Nacre
