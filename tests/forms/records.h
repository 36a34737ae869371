// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_records_h
#define nacre_tests_records_h

// Reading and comparing the numbers of conformance/*.json.

// Else Boost 1.74 prints a note on its own use of _1, _2 as global names.
#define BOOST_BIND_GLOBAL_PLACEHOLDERS
#include "../tests_common.h"

#include <boost/property_tree/json_parser.hpp>

using namespace Tests;
using Json = boost::property_tree::ptree;

constexpr double tolerance = 1e-10;

inline std::vector<double>
numbers_of(const Json &json)
{
  std::vector<double> numbers;
  if (json.empty())
    numbers.push_back(json.get_value<double>());
  for (const auto &child : json)
    for (const double x : numbers_of(child.second))
      numbers.push_back(x);
  return numbers;
}

inline std::vector<double>
numbers_of(const Json &json, const std::string &key)
{
  return numbers_of(json.get_child(key));
}
/** Largest difference relative to the largest number of the record. */
inline void
compare(const std::string         &name,
        const std::vector<double> &found,
        const std::vector<double> &record)
{
  double difference = (found.size() == record.size() ? 0. : 1e100);
  double size       = 1e-300;
  for (unsigned int i = 0; i < record.size() && i < found.size(); ++i)
    {
      const double d = std::abs(found[i] - record[i]);
      difference     = !(d <= difference) ? d : difference;
      size           = std::max(size, std::abs(record[i]));
    }
  check_below(name, difference / size, tolerance);
}

#endif
