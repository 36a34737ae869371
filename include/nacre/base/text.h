// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_text_h
#define nacre_base_text_h

#include <string>
#include <utility>
#include <vector>

/** Small parsers of parameter values; every error is an ExcMessage. */
namespace Nacre::Text
{
  /** Remove white space at both ends. */
  std::string
  trim(const std::string &text);

  std::string
  lower_case(std::string text);

  /** The number with 6 significant digits. */
  std::string
  number(const double value);

  bool
  begins_with(const std::string &text, const std::string &begin);

  /**
   * Where @p what stands outside of parentheses and of "double quotes" for the
   * first time from @p begin on, itself outside of them; or npos.
   */
  std::size_t
  find(const std::string &text,
       const std::string &what,
       const std::size_t  begin = 0);

  /**
   * A name that may be in double quotes, without them: `"left, 5"" wide"` gives
   * `left, 5" wide`. Other texts are trimmed.
   */
  std::string
  unquoted(const std::string &text);

  /**
   * The reverse: put the name in quotes if a list can't hold it without them.
   */
  std::string
  quoted(const std::string &name);

  /** Take @p word from the end of @p text, if it stands there behind others. */
  bool
  take_last_word(std::string &text, const std::string &word);

  /** Those of @p names that fit into a message: "a, b and 7 others". */
  std::string
  list(const std::vector<std::string> &names);

  /**
   * Split at @p separator wherever it stands outside of parentheses and double
   * quotes, trim the parts; an empty text has no parts. `split("a, f(x, y)",
   * ',')` gives {"a", "f(x, y)"}; quotes stay, see unquoted(). An unbalanced
   * parenthesis or quote and an empty part throw a message that quotes
   * @p where, the parameter that holds the text.
   */
  std::vector<std::string>
  split(const std::string &text,
        const char         separator,
        const std::string &where);

  /** "name, name: value", as lists of conditions, loads and regions hold. */
  struct Entry
  {
    /** The names as they stand in the text, with their quotes. */
    std::vector<std::string> names;
    std::string              value;
    /** The whole entry, for messages. */
    std::string text;
  };

  /**
   * Split "name[, name]: value; ...". A missing colon or name throws; @p what
   * says what is named, "edge", and @p form is an example for the message. A
   * value may be empty.
   */
  std::vector<Entry>
  entries(const std::string &text,
          const std::string &where,
          const std::string &what,
          const std::string &form);

  /**
   * Split "key = value" at the first '=' outside of parentheses and quotes that
   * isn't part of a comparison (==, <=, >=, !=). Without one, the value is
   * empty and `second` is "". Both sides are trimmed.
   */
  std::pair<std::string, std::string>
  key_and_value(const std::string &text);

  /** The @p candidates nearest to @p name (edit distance), best first. */
  std::vector<std::string>
  nearest(const std::string              &name,
          const std::vector<std::string> &candidates,
          const unsigned int              n_max = 3);

  /**
   * "where: unknown kind 'name'. Did you mean 'a' or 'b'? Known: a, b, c."
   * The text for an AssertThrow(..., ExcMessage(...)).
   */
  std::string
  unknown_name(const std::string              &where,
               const std::string              &kind,
               const std::string              &name,
               const std::vector<std::string> &candidates);
} // namespace Nacre::Text

#endif
