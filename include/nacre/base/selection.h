// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_selection_h
#define nacre_base_selection_h

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * The values of an enumeration beside their names in parameter files, in the
   * order in which messages list them. An enumeration E that a parameter can
   * hold has a table of its own, declared beside it:
   *
   *   const Selection<E> &selection(E);
   *
   * The argument only chooses the overload. Then add_parameter() takes a
   * variable of the type E, or std::optional<E>, whose empty value is called
   * "default", and declares a Patterns::Selection of the names.
   */
  template <typename E>
  using Selection = std::vector<std::pair<E, std::string>>;

  /** The name of @p value in parameter files. */
  template <typename E>
  const std::string &
  name_of(const E value)
  {
    const Selection<E> &table = selection(value);
    const auto          found =
      std::find_if(table.begin(), table.end(), [&](const auto &entry) {
        return entry.first == value;
      });
    Assert(found != table.end(), dealii::ExcInternalError());
    return found->second;
  }

  /** All names of an enumeration. */
  template <typename E>
  std::vector<std::string>
  names_of()
  {
    std::vector<std::string> names;
    for (const auto &entry : selection(E()))
      names.push_back(entry.second);
    return names;
  }

  /** The value called @p name; nothing if there is none. */
  template <typename E>
  std::optional<E>
  find_value(const std::string &name)
  {
    for (const auto &entry : selection(E()))
      if (entry.second == name)
        return entry.first;
    return {};
  }

  namespace internal
  {
    /** The type E of a variable of the type E or std::optional<E>. */
    template <typename T>
    struct Selected
    {
      using type                        = T;
      static constexpr bool is_optional = false;
    };

    template <typename E>
    struct Selected<std::optional<E>>
    {
      using type                        = E;
      static constexpr bool is_optional = true;
    };
  } // namespace internal
} // namespace Nacre

namespace dealii::Patterns::Tools
{
  /** Conversion of enumerations that have a Nacre::Selection. */
  template <typename T>
  struct Convert<T,
                 std::enable_if_t<
                   std::is_enum_v<typename Nacre::internal::Selected<T>::type>>>
  {
    using Selected = Nacre::internal::Selected<T>;
    using E        = typename Selected::type;

    static std::unique_ptr<PatternBase>
    to_pattern()
    {
      std::string sequence = Selected::is_optional ? "default" : "";
      for (const auto &name : Nacre::names_of<E>())
        sequence += (sequence.empty() ? "" : "|") + name;
      return std::make_unique<Patterns::Selection>(sequence);
    }

    static std::string
    to_string(const T &value, const PatternBase & = *to_pattern())
    {
      if constexpr (Selected::is_optional)
        return value ? Nacre::name_of(*value) : "default";
      else
        return Nacre::name_of(value);
    }

    static T
    to_value(const std::string &name, const PatternBase &p = *to_pattern())
    {
      AssertThrow(p.match(name), ExcNoMatch(name, p.description()));
      const auto value = Nacre::find_value<E>(name);
      if constexpr (Selected::is_optional)
        return value;
      else
        return *value;
    }
  };
} // namespace dealii::Patterns::Tools

#endif
