// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/problem/abaqus_deck.h>

#include <algorithm>
#include <cctype>

namespace Nacre::Abaqus
{
  std::string
  upper_case(std::string text)
  {
    for (char &c : text)
      c = std::toupper(static_cast<unsigned char>(c));
    return text;
  }


  std::vector<std::string>
  comma_separated(const std::string &line)
  {
    std::vector<std::string> words(1);
    bool                     quoted = false;
    for (const char c : line)
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        words.emplace_back();
      else
        words.back() += c;
    for (std::string &word : words)
      word = Text::trim(word);
    if (words.back().empty())
      words.pop_back();
    return words;
  }


  bool
  is_number(const std::string &word)
  {
    // A long long has 18 digits at least.
    return !word.empty() && word.size() <= 18 &&
           std::all_of(word.begin(), word.end(), [](const unsigned char c) {
             return std::isdigit(c) != 0;
           });
  }


  void
  SetEntry::add(const long long number)
  {
    if (!numbers.empty() && numbers.back().step == 1 &&
        numbers.back().last + 1 == number)
      numbers.back().last = number;
    else
      numbers.push_back({number, number, 1});
  }


  void
  Set::add(const long long number)
  {
    if (entries.empty() || !entries.back().instance.empty() ||
        !entries.back().names.empty())
      entries.emplace_back();
    entries.back().add(number);
  }


  Keyword::Keyword(const std::string &line)
  {
    const auto words = comma_separated(line);
    if (words.empty())
      return;
    for (const char c : upper_case(words[0]))
      if (std::isspace(static_cast<unsigned char>(c)) == 0)
        name += c;
    for (std::size_t i = 1; i < words.size(); ++i)
      {
        const auto  equals = words[i].find('=');
        const auto  key    = Text::trim(words[i].substr(0, equals));
        std::string value;
        if (equals != std::string::npos)
          value = Text::trim(words[i].substr(equals + 1));
        parameters[upper_case(key)] = value;
      }
  }


  bool
  Keyword::has(const std::string &parameter) const
  {
    return parameters.count(parameter) > 0;
  }


  std::string
  Keyword::value(const std::string &parameter) const
  {
    const auto found = parameters.find(parameter);
    return found == parameters.end() ? "" : found->second;
  }
} // namespace Nacre::Abaqus
