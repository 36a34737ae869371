// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/output_file.h>
#include <nacre/postprocess/results_table.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <ostream>
#include <set>
#include <sstream>

namespace Nacre
{
  /** A column as it is printed; a cell without a value is empty. */
  struct ResultsTable::Column
  {
    std::string              name;
    std::vector<std::string> cells;
    bool                     is_text = false;
  };

  namespace
  {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

    /** @p digits significant digits, "" for NaN. */
    std::string
    number(const double value,
           const int    digits,
           const bool   trailing_zeros = false)
    {
      if (std::isnan(value))
        return "";
      std::ostringstream out;
      if (trailing_zeros)
        out << std::showpoint;
      out << std::setprecision(digits) << value;
      return out.str();
    }

    /** With @p digits behind the point, "" for NaN. */
    std::string
    fixed_number(const double value, const int digits)
    {
      if (std::isnan(value))
        return "";
      std::ostringstream out;
      out << std::fixed << std::setprecision(digits) << value;
      return out.str();
    }

    std::string
    csv_cell(const std::string &text)
    {
      if (text.find_first_of(",\"\n") == std::string::npos)
        return text;
      std::string quoted = "\"";
      for (const char c : text)
        quoted += c == '"' ? "\"\"" : std::string(1, c);
      return quoted + "\"";
    }

    std::string
    tex_text(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        switch (c)
          {
            case '\\':
              result += "\\textbackslash{}";
              break;
            case '~':
              result += "\\textasciitilde{}";
              break;
            case '^':
              result += "\\textasciicircum{}";
              break;
            case '<':
              result += "\\textless{}";
              break;
            case '>':
              result += "\\textgreater{}";
              break;
            case '&':
            case '%':
            case '$':
            case '#':
            case '_':
            case '{':
            case '}':
              result += '\\';
              result += c;
              break;
            default:
              result += c;
          }
      return result;
    }

    /** A number in math mode, its exponent as a power of ten. */
    std::string
    tex_number(const std::string &text)
    {
      if (text.empty() ||
          text.find_first_not_of("+-.0123456789e") != std::string::npos)
        return tex_text(text);
      const auto e = text.find('e');
      if (e == std::string::npos)
        return '$' + text + '$';
      return '$' + text.substr(0, e) + " \\cdot 10^{" +
             std::to_string(std::stoi(text.substr(e + 1))) + "}$";
    }
  } // namespace


  ResultsTable::ResultsTable(const std::string           &title,
                             const std::vector<Quantity> &quantities)
    : title_(title)
    , quantities_(quantities)
  {
    std::set<std::string> names;
    for (const auto &quantity : quantities_)
      {
        const std::string where = "Quantities: '" + quantity.name + "'";
        AssertThrow(names.insert(quantity.name).second,
                    ExcMessage(where + " is given twice."));
        if (quantity.reference)
          AssertThrow(std::isfinite(*quantity.reference) &&
                        *quantity.reference != 0.,
                      ExcMessage(where + " has the reference value " +
                                 number(*quantity.reference, 6) +
                                 "; it must be finite and not 0 for the "
                                 "ratio."));
      }
  }


  void
  ResultsTable::add_row(const Row &row)
  {
    Assert(row.values.size() == quantities_.size(),
           ExcMessage("A row has one value for each quantity."));
    Assert(row.references.empty() ||
             row.references.size() == quantities_.size(),
           ExcMessage("A row has no references or one for each quantity."));
    rows_.push_back(row);
  }


  const std::vector<ResultsTable::Row> &
  ResultsTable::rows() const
  {
    return rows_;
  }


  std::optional<double>
  ResultsTable::reference(const unsigned int row,
                          const unsigned int quantity) const
  {
    const auto &references = rows_[row].references;
    if (!references.empty() && references[quantity])
      return references[quantity];
    return quantities_[quantity].reference;
  }


  bool
  ResultsTable::has_reference(const unsigned int quantity) const
  {
    if (quantities_[quantity].reference)
      return true;
    for (unsigned int r = 0; r < rows_.size(); ++r)
      if (reference(r, quantity))
        return true;
    return false;
  }


  double
  ResultsTable::ratio(const unsigned int row, const unsigned int quantity) const
  {
    const auto value = reference(row, quantity);
    return value ? rows_[row].values[quantity] / *value : nothing;
  }


  double
  ResultsTable::error(const unsigned int row, const unsigned int quantity) const
  {
    return reference(row, quantity) ? std::abs(ratio(row, quantity) - 1.) :
                                      std::abs(rows_[row].values[quantity]);
  }


  double
  ResultsTable::rate(const unsigned int row, const unsigned int quantity) const
  {
    const Row &fine = rows_[row];
    for (unsigned int r = row; r-- > 0;)
      {
        const Row &coarse = rows_[r];
        if (coarse.element != fine.element || coarse.degree != fine.degree ||
            coarse.eta != fine.eta || coarse.thickness != fine.thickness)
          continue;
        const double e1 = error(r, quantity), e2 = error(row, quantity);
        // Below, ratios to a reference are round-off.
        if (has_reference(quantity) && e2 < 1e-9)
          return nothing;
        const double refinement = std::sqrt(static_cast<double>(fine.dofs) /
                                            static_cast<double>(coarse.dofs));
        const double value      = std::log(e1 / e2) / std::log(refinement);
        return std::isfinite(value) ? value : nothing;
      }
    return nothing;
  }


  std::vector<ResultsTable::Column>
  ResultsTable::leading_columns() const
  {
    std::vector<Column> columns = {{"element", {}, true},
                                   {"degree", {}},
                                   {"eta", {}, true},
                                   {"thickness", {}, true},
                                   {"cells", {}},
                                   {"dofs", {}}};
    for (const Row &row : rows_)
      {
        const std::string cells[] = {row.element,
                                     std::to_string(row.degree),
                                     row.eta,
                                     row.thickness,
                                     std::to_string(row.cells),
                                     std::to_string(row.dofs)};
        for (unsigned int c = 0; c < columns.size(); ++c)
          columns[c].cells.push_back(cells[c]);
      }
    return columns;
  }


  std::vector<ResultsTable::Column>
  ResultsTable::quantity_columns(const int  digits,
                                 const bool trailing_zeros) const
  {
    std::vector<Column> columns;
    for (unsigned int q = 0; q < quantities_.size(); ++q)
      {
        columns.push_back({quantities_[q].name, {}});
        for (const Row &row : rows_)
          columns.back().cells.push_back(
            number(row.values[q], digits, trailing_zeros));
      }
    return columns;
  }


  std::vector<ResultsTable::Column>
  ResultsTable::ratio_columns(const int digits, const bool csv_names) const
  {
    std::vector<Column> columns;
    for (unsigned int q = 0; q < quantities_.size(); ++q)
      {
        if (!has_reference(q))
          continue;
        const std::string name = quantities_[q].name;
        columns.push_back({!csv_names      ? name + "/ref" :
                           columns.empty() ? "ratio" :
                                             "ratio_" + name,
                           {}});
        for (unsigned int r = 0; r < rows_.size(); ++r)
          columns.back().cells.push_back(
            number(ratio(r, q), digits, !csv_names));
      }
    return columns;
  }


  std::vector<ResultsTable::Column>
  ResultsTable::rate_columns(const int digits, const bool csv_names) const
  {
    std::vector<Column> columns;
    for (unsigned int q = 0; q < quantities_.size(); ++q)
      {
        if (!quantities_[q].rate)
          continue;
        columns.push_back(
          {csv_names ? "rate_" + quantities_[q].name : "rate", {}});
        for (unsigned int r = 0; r < rows_.size(); ++r)
          columns.back().cells.push_back(csv_names ?
                                           number(rate(r, q), digits) :
                                           fixed_number(rate(r, q), digits));
      }
    return columns;
  }


  std::vector<ResultsTable::Column>
  ResultsTable::seconds_columns(const bool csv) const
  {
    std::vector<Column> columns = {{"setup_s", {}},
                                   {"assembly_s", {}},
                                   {"solve_s", {}}};
    const auto          text    = [&](const double seconds) {
      return csv ? number(seconds, 6) : fixed_number(seconds, 4);
    };
    if (!rows_.empty() && rows_.front().estimate_s)
      columns.push_back({"estimate_s", {}});
    for (const Row &row : rows_)
      {
        columns[0].cells.push_back(text(row.setup_s));
        columns[1].cells.push_back(text(row.assembly_s));
        columns[2].cells.push_back(text(row.solve_s));
        if (columns.size() == 4)
          columns[3].cells.push_back(text(row.estimate_s.value_or(0.)));
      }
    return columns;
  }


  std::vector<ResultsTable::Column>
  ResultsTable::solver_columns() const
  {
    std::vector<Column> columns = {{"solver", {}, true},
                                   {"iterations", {}},
                                   {"memory_gb", {}}};
    for (const Row &row : rows_)
      {
        columns[0].cells.push_back(row.solver);
        columns[1].cells.push_back(
          row.iterations > 0 ? std::to_string(row.iterations) : "");
        columns[2].cells.push_back(number(row.memory_gb, 4));
      }
    return columns;
  }


  std::vector<ResultsTable::Column>
  ResultsTable::readable_columns(const bool with_seconds) const
  {
    std::vector<Column> columns = leading_columns();
    const auto          values  = quantity_columns(6, true);
    const auto          ratios  = ratio_columns(6, false);
    const auto          rates   = rate_columns(2, false);
    auto                ratio   = ratios.begin();
    auto                rate    = rates.begin();
    for (unsigned int q = 0; q < quantities_.size(); ++q)
      {
        columns.push_back(values[q]);
        if (has_reference(q))
          columns.push_back(*ratio++);
        if (quantities_[q].rate)
          columns.push_back(*rate++);
      }
    if (with_seconds)
      for (const auto &column : seconds_columns(false))
        columns.push_back(column);
    return columns;
  }


  void
  ResultsTable::write_text(std::ostream &out, const bool with_seconds) const
  {
    const auto               columns = readable_columns(with_seconds);
    std::vector<std::string> lines(rows_.size() + 1);
    for (const auto &column : columns)
      {
        std::size_t width = column.name.size();
        for (const auto &cell : column.cells)
          width = std::max({width, cell.size(), std::size_t(1)});
        const auto append = [&](std::string &line, std::string cell) {
          if (cell.empty())
            cell = "-";
          const std::string padding(width - cell.size(), ' ');
          line += (line.empty() ? "" : "  ") +
                  (column.is_text ? cell + padding : padding + cell);
        };
        append(lines[0], column.name);
        for (unsigned int r = 0; r < rows_.size(); ++r)
          append(lines[r + 1], column.cells[r]);
      }
    for (auto &line : lines)
      {
        line.erase(line.find_last_not_of(' ') + 1);
        out << line << '\n';
      }
  }


  void
  ResultsTable::write_csv(std::ostream &out) const
  {
    std::vector<Column> columns = leading_columns();
    for (const auto &group : {quantity_columns(12, false),
                              ratio_columns(12, true),
                              rate_columns(12, true),
                              seconds_columns(true),
                              solver_columns()})
      columns.insert(columns.end(), group.begin(), group.end());

    const auto write_line =
      [&](const std::function<std::string(const Column &)> &cell) {
        for (std::size_t c = 0; c < columns.size(); ++c)
          out << (c == 0 ? "" : ",") << csv_cell(cell(columns[c]));
        out << '\n';
      };
    write_line([](const Column &column) { return column.name; });
    for (unsigned int r = 0; r < rows_.size(); ++r)
      write_line([&](const Column &column) { return column.cells[r]; });
  }


  void
  ResultsTable::write_tex(std::ostream &out) const
  {
    const auto columns = readable_columns(true);
    if (!title_.empty())
      out << "% " << title_ << '\n';
    out << "% needs \\usepackage{booktabs}\n\\begin{tabular}{";
    for (const auto &column : columns)
      out << (column.is_text ? 'l' : 'r');
    out << "}\n\\toprule\n";
    for (std::size_t c = 0; c < columns.size(); ++c)
      out << (c == 0 ? "" : " & ") << tex_text(columns[c].name);
    out << " \\\\\n\\midrule\n";
    for (unsigned int r = 0; r < rows_.size(); ++r)
      {
        for (std::size_t c = 0; c < columns.size(); ++c)
          out << (c == 0 ? "" : " & ") << tex_number(columns[c].cells[r]);
        out << " \\\\\n";
      }
    out << "\\bottomrule\n\\end{tabular}\n";
  }


  void
  ResultsTable::write_files(const std::string &base_name) const
  {
    write_file(base_name + ".txt", [&](std::ostream &out) {
      if (!title_.empty())
        out << title_ << "\n\n";
      write_text(out);
    });
    write_file(base_name + ".csv", [&](std::ostream &out) { write_csv(out); });
    write_file(base_name + ".tex", [&](std::ostream &out) { write_tex(out); });
  }
} // namespace Nacre
