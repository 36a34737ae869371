// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/expression.h>
#include <nacre/base/text.h>
#include <nacre/postprocess/quantity_phrase.h>

#include <utility>

namespace Nacre
{
  bool
  QuantityPhrase::take(const std::string &word)
  {
    if (text.compare(0, word.size(), word) != 0)
      return false;
    const std::string rest = Text::trim(text.substr(word.size()));
    if (text.size() > word.size() && text[word.size()] != ' ' &&
        text[word.size()] != '(')
      return false;
    text = rest;
    return true;
  }

  std::string
  QuantityPhrase::take_word()
  {
    const auto        place = Text::find(text, " ");
    const std::string word  = text.substr(0, place);
    text = place == std::string::npos ? "" : Text::trim(text.substr(place));
    return word;
  }

  std::string
  QuantityPhrase::up_to(const std::string &word)
  {
    const auto place = Text::find(text, " " + word + " ");
    if (place == std::string::npos)
      return std::exchange(text, "");
    const std::string before = Text::trim(text.substr(0, place));
    text                     = Text::trim(text.substr(place + word.size() + 2));
    return before;
  }

  std::optional<Tensor<1, spacedim>>
  parse_direction(const std::string &text,
                  const std::string &where,
                  const Constants   &constants)
  {
    if (text == "normal")
      return {};
    for (unsigned int c = 0; c < spacedim; ++c)
      if (text == std::string(1, "xyz"[c]))
        return Point<spacedim>::unit_vector(c);
    AssertThrow(!text.empty() && text.front() == '(',
                ExcMessage(
                  Text::unknown_name(where,
                                     "direction",
                                     text,
                                     {"x", "y", "z", "normal", "(a, b, c)"})));
    const Tensor<1, spacedim> direction =
      evaluate_point(text, where, constants);
    AssertThrow(direction.norm() > 0.,
                ExcMessage(where + ": the direction " + text +
                           " has no length."));
    return direction / direction.norm();
  }
} // namespace Nacre
