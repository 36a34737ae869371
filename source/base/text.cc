// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <sstream>

namespace Nacre::Text
{
  std::string
  number(const double value)
  {
    std::ostringstream text;
    text << value;
    return text.str();
  }

  bool
  take_last_word(std::string &text, const std::string &word)
  {
    if (text.size() <= word.size() ||
        text.compare(text.size() - word.size(), word.size(), word) != 0 ||
        text[text.size() - word.size() - 1] != ' ')
      return false;
    text = trim(text.substr(0, text.size() - word.size()));
    return true;
  }

  bool
  begins_with(const std::string &text, const std::string &begin)
  {
    return text.compare(0, begin.size(), begin) == 0;
  }

  using dealii::ExcMessage;

  namespace
  {
    /**
     * Number of insertions, deletions, replacements and swaps of neighbours
     * that make @p b of @p a (optimal string alignment).
     */
    std::size_t
    edit_distance(const std::string &a, const std::string &b)
    {
      const std::size_t                     n = a.size(), m = b.size();
      std::vector<std::vector<std::size_t>> d(n + 1,
                                              std::vector<std::size_t>(m + 1));
      for (std::size_t i = 0; i <= n; ++i)
        d[i][0] = i;
      std::iota(d[0].begin(), d[0].end(), 0);
      for (std::size_t i = 1; i <= n; ++i)
        for (std::size_t j = 1; j <= m; ++j)
          {
            d[i][j] = std::min({d[i - 1][j] + 1,
                                d[i][j - 1] + 1,
                                d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
              d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
          }
      return d[n][m];
    }

    /** One name within the other, as "sphere" in "hemisphere". */
    bool
    one_holds_the_other(const std::string &a, const std::string &b)
    {
      return std::min(a.size(), b.size()) >= 3 &&
             (a.find(b) != std::string::npos || b.find(a) != std::string::npos);
    }
    /** Where a text is, read from its begin: in parentheses, in quotes. */
    class Place
    {
    public:
      /** Take the next letter. */
      void
      read(const char c)
      {
        if (c == '"')
          quoted_ = !quoted_;
        else if (!quoted_)
          depth_ += (c == '(') - (c == ')');
      }

      bool
      is_outside() const
      {
        return depth_ == 0 && !quoted_;
      }

      bool
      is_quoted() const
      {
        return quoted_;
      }

      /** Parentheses open, less those closed. */
      int
      depth() const
      {
        return depth_;
      }

    private:
      int  depth_  = 0;
      bool quoted_ = false;
    };
  } // namespace


  std::string
  trim(const std::string &text)
  {
    const char *const space = " \t\n\r\f\v";
    const auto        begin = text.find_first_not_of(space);
    if (begin == std::string::npos)
      return "";
    return text.substr(begin, text.find_last_not_of(space) - begin + 1);
  }


  std::string
  lower_case(std::string text)
  {
    for (char &c : text)
      c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
  }


  std::size_t
  find(const std::string &text,
       const std::string &what,
       const std::size_t  begin)
  {
    Place place;
    for (std::size_t i = 0; i < text.size(); ++i)
      {
        if (i >= begin && place.is_outside() &&
            text.compare(i, what.size(), what) == 0)
          return i;
        place.read(text[i]);
      }
    return std::string::npos;
  }


  std::string
  unquoted(const std::string &text)
  {
    const std::string name = trim(text);
    if (name.size() < 2 || name.front() != '"' || name.back() != '"')
      return name;
    std::string result;
    for (std::size_t i = 1; i + 1 < name.size(); ++i)
      {
        result += name[i];
        // A doubled quote stands for one.
        if (name[i] == '"' && name[i + 1] == '"')
          ++i;
      }
    return result;
  }


  std::string
  quoted(const std::string &name)
  {
    if (name.find_first_of(",:;()\"") == std::string::npos &&
        name.find("->") == std::string::npos)
      return name;
    std::string result = "\"";
    for (const char c : name)
      result += (c == '"') ? "\"\"" : std::string(1, c);
    return result + '"';
  }


  std::string
  list(const std::vector<std::string> &names)
  {
    const std::size_t n_shown = std::min<std::size_t>(names.size(), 40);
    std::string       text;
    for (std::size_t i = 0; i < n_shown; ++i)
      text += (i == 0 ? "" : ", ") + names[i];
    if (n_shown < names.size())
      text += " and " + std::to_string(names.size() - n_shown) + " others";
    return text;
  }


  std::vector<std::string>
  split(const std::string &text, const char separator, const std::string &where)
  {
    std::vector<std::string> parts;
    if (trim(text).empty())
      return parts;
    Place       place;
    std::string part;
    for (const char c : text)
      {
        const bool separates = (c == separator && place.is_outside());
        place.read(c);
        AssertThrow(place.depth() >= 0,
                    ExcMessage(where + ": '" + trim(text) +
                               "' has a ')' without '('."));
        if (separates)
          {
            parts.push_back(trim(part));
            part.clear();
          }
        else
          part += c;
      }
    AssertThrow(!place.is_quoted(),
                ExcMessage(where + ": '" + trim(text) +
                           "' has a quote '\"' without a second one."));
    AssertThrow(place.depth() == 0,
                ExcMessage(where + ": '" + trim(text) +
                           "' has a '(' without ')'."));
    parts.push_back(trim(part));
    for (std::size_t i = 0; i < parts.size(); ++i)
      AssertThrow(!parts[i].empty(),
                  ExcMessage(where + ": part " + std::to_string(i + 1) +
                             " of '" + trim(text) +
                             "' is empty; the parts are separated by '" +
                             separator + "'."));
    return parts;
  }


  std::vector<Entry>
  entries(const std::string &text,
          const std::string &where,
          const std::string &what,
          const std::string &form)
  {
    std::vector<Entry> result;
    for (const std::string &part : split(text, ';', where))
      {
        const auto colon = find(part, ":");
        AssertThrow(colon != std::string::npos,
                    ExcMessage(where + ": '" + part + "' has no ':'; write '" +
                               form + "'."));
        const std::string names = trim(part.substr(0, colon));
        AssertThrow(!names.empty(),
                    ExcMessage(where + ": '" + part + "' names no " + what +
                               "; write '" + form + "'."));
        result.push_back(
          {split(names, ',', where), trim(part.substr(colon + 1)), part});
      }
    return result;
  }


  std::pair<std::string, std::string>
  key_and_value(const std::string &text)
  {
    for (std::size_t i = find(text, "="); i != std::string::npos;
         i             = find(text, "=", i + 1))
      {
                    if (i + 1 < text.size() && text[i + 1] == '=')
          ++i; // ==
        else if (i == 0 ||
                 std::string("<>!").find(text[i - 1]) == std::string::npos)
          return {trim(text.substr(0, i)), trim(text.substr(i + 1))};
      }
    return {trim(text), ""};
  }


  std::vector<std::string>
  nearest(const std::string              &name,
          const std::vector<std::string> &candidates,
          const unsigned int              n_max)
  {
    const std::string wanted = lower_case(trim(name));
    // A single letter is near to the same letter in the other case only.
    const std::size_t limit = (wanted.size() + 1) / 3;
    std::vector<std::pair<std::size_t, std::string>> found;
    for (const auto &candidate : candidates)
      {
        const std::string known    = lower_case(candidate);
        std::size_t       distance = edit_distance(wanted, known);
        if (one_holds_the_other(wanted, known))
          distance = std::min(distance, limit);
        if (distance <= limit)
          found.emplace_back(distance, candidate);
      }
    std::stable_sort(found.begin(),
                     found.end(),
                     [](const auto &a, const auto &b) {
                       return a.first < b.first;
                     });
    std::vector<std::string> result;
    for (const auto &entry : found)
      if (result.size() < n_max &&
          std::find(result.begin(), result.end(), entry.second) == result.end())
        result.push_back(entry.second);
    return result;
  }


  std::string
  unknown_name(const std::string              &where,
               const std::string              &kind,
               const std::string              &name,
               const std::vector<std::string> &candidates)
  {
    std::string message      = where + ": unknown " + kind + " '" + name + "'.";
    const auto  near         = nearest(name, candidates);
    const std::size_t n_near = near.size();
    for (std::size_t i = 0; i < n_near; ++i)
      message += (i == 0          ? " Did you mean '" :
                  i + 1 == n_near ? " or '" :
                                    ", '") +
                 near[i] + "'";
    if (n_near > 0)
      message += "?";
    if (candidates.empty())
      return message + " None is known here.";
    return message + " Known: " + list(candidates) + ".";
  }
} // namespace Nacre::Text
