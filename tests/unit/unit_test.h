// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_unit_test_h
#define nacre_unit_test_h

#include <deal.II/base/exceptions.h>

#include <boost/test/unit_test.hpp>

#include <string>

namespace UnitTests
{
  /** What the exception says that @p function throws, "" if none. */
  template <typename Function>
  std::string
  complaint(const Function &function)
  {
    try
      {
        function();
      }
    catch (const dealii::ExceptionBase &exception)
      {
        return exception.what();
      }
    return "";
  }

  inline bool
  holds(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }
} // namespace UnitTests

#endif
