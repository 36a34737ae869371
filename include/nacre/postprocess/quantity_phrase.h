// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_quantity_phrase_h
#define nacre_postprocess_quantity_phrase_h

#include <nacre/base/types.h>

#include <optional>
#include <string>

namespace Nacre
{
  /** The words of a quantity, which are taken one after the other. */
  struct QuantityPhrase
  {
    std::string text;
    /** The parameter, for messages. */
    std::string where;

    /** Remove @p word from the beginning, if it stands there. */
    bool
    take(const std::string &word);

    /** Remove the first word, up to a space outside of parentheses. */
    std::string
    take_word();

    /**
     * What stands before @p word, outside of parentheses and quotes, or before
     * the end.
     */
    std::string
    up_to(const std::string &word);
  };

  /** The unit vector along x, y, z, (a, b, c); none for "normal". */
  std::optional<Tensor<1, spacedim>>
  parse_direction(const std::string &text,
                  const std::string &where,
                  const Constants   &constants);
} // namespace Nacre

#endif
