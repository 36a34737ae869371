// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Lists, names, expressions, files: what reads and writes the user's words.

#include "unit_test.h"
#include <nacre/base/expression.h>
#include <nacre/base/input_file.h>
#include <nacre/base/output_file.h>
#include <nacre/base/text.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <stdexcept>

using namespace Nacre;
using namespace UnitTests;
using Strings = std::vector<std::string>;

namespace
{
  std::string
  content(const std::string &file)
  {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
} // namespace

BOOST_AUTO_TEST_SUITE(base)

BOOST_AUTO_TEST_CASE(split_lists)
{
  BOOST_TEST((Text::split("a, f(x, y)", ',', "P") == Strings{"a", "f(x, y)"}));
  BOOST_TEST(
    (Text::split("\"a, b\"; c", ';', "P") == Strings{"\"a, b\"", "c"}));
  BOOST_TEST(Text::split("  ", ',', "P").empty());
  for (const std::string text : {"a, , b", "f(x, y", "\"a, b", "a,"})
    BOOST_TEST(holds(complaint([&] { Text::split(text, ',', "Param"); }),
                     "Param"),
               text);
}

BOOST_AUTO_TEST_CASE(quoted_names)
{
  for (const std::string name : {"left", "left, 5\" wide", "a: b", "x; y"})
    BOOST_TEST(Text::unquoted(Text::quoted(name)) == name);
  BOOST_TEST(Text::quoted("left") == "left");
}

BOOST_AUTO_TEST_CASE(entries_of_names)
{
  const auto entries =
    Text::entries("u=0, top: clamped; \"a:b\": x = 0", "P", "edge", "e: c");
  BOOST_TEST(entries.size() == 2);
  BOOST_TEST((entries[0].names == Strings{"u=0", "top"}));
  BOOST_TEST(entries[0].value == "clamped");
  BOOST_TEST(Text::unquoted(entries[1].names[0]) == "a:b");
  BOOST_TEST(
    holds(complaint([] { Text::entries("u=0 clamped", "P", "edge", "e: c"); }),
          "P"));
}

BOOST_AUTO_TEST_CASE(keys_and_values)
{
  using Pair = std::pair<std::string, std::string>;
  BOOST_TEST((Text::key_and_value(" x = a==b") == Pair("x", "a==b")));
  BOOST_TEST((Text::key_and_value("f(a=1) = 2") == Pair("f(a=1)", "2")));
  BOOST_TEST((Text::key_and_value("clamped") == Pair("clamped", "")));
  BOOST_TEST((Text::key_and_value("x<=1") == Pair("x<=1", "")));
}

BOOST_AUTO_TEST_CASE(names_that_resemble)
{
  const Strings known = {"clamped", "hinged", "symmetry"};
  BOOST_TEST(Text::nearest("clampd", known).front() == "clamped");
  BOOST_TEST(
    holds(Text::unknown_name("P", "support", "simetry", known), "'symmetry'"));
}

BOOST_AUTO_TEST_CASE(expressions)
{
  const Constants  constants = {{"q", 3.}};
  const Expression f("q*cos(x) + t", "Loads", constants, "x,y,z,t");
  BOOST_TEST(f(Point<3>()) == 3.);
  BOOST_TEST(f(Point<3>(), 2.) == 5.);
  BOOST_TEST(!f.is_constant());
  BOOST_TEST(Expression("2*q", "Loads", constants).is_constant());
  BOOST_TEST(Expression("q - 3", "Loads", constants).is_zero());
  BOOST_CHECK_THROW(Expression("log(x)", "Loads", constants)(Point<3>()),
                    ExcUndefinedValue);
  BOOST_TEST(holds(complaint([&] { Expression("q*y*p", "Loads", constants); }),
                   "Loads"));
}

BOOST_AUTO_TEST_CASE(vectors_and_constants)
{
  const Constants constants = parse_constants("R = 25, a = 2*R", "Constants");
  BOOST_TEST(constants.at("a") == 50.);
  BOOST_TEST(evaluate_number("a/R + sin(pi/2)", "P", constants) == 3.);
  BOOST_TEST(evaluate_point("(R, -a, 0)", "P", constants) ==
             Point<3>(25., -50., 0.));
  const VectorExpression v("x, 2*y, R", "P", constants);
  BOOST_TEST(v(Point<3>(1., 2., 3.)) == Point<3>(1., 4., 25.));
  BOOST_TEST(
    holds(complaint([&] { VectorExpression("1, 2", "Param", constants); }),
          "Param"));
  BOOST_TEST(
    holds(complaint([] { parse_constants("a = b", "Constants"); }), "b"));
}

BOOST_AUTO_TEST_CASE(files_are_whole)
{
  const std::string file = "unit_test_folder/file.txt";
  write_file(file, [](std::ostream &out) { out << "first"; });
  BOOST_TEST(content(file) == "first");
  // Without success the old one stays.
  BOOST_CHECK_THROW(write_file(file,
                               [](std::ostream &out) {
                                 out << "second";
                                 throw std::runtime_error("no");
                               }),
                    std::runtime_error);
  BOOST_TEST(content(file) == "first");
  BOOST_TEST(holds(complaint([] {
                     write_file("unit_test_folder/" + std::string(300, 'n'),
                                [](std::ostream &) {});
                   }),
                   "File name too long"));
  std::filesystem::remove_all("unit_test_folder");
}

BOOST_AUTO_TEST_CASE(encodings)
{
  BOOST_TEST(plain_text("\xEF\xBB\xBF*NODE", "f") == "*NODE");
  BOOST_TEST(plain_text("*NODE\r1, 0\r\r", "f") == "*NODE\n1, 0\n\n");
  BOOST_TEST(plain_text("*NODE\r\n1, 0", "f") == "*NODE\r\n1, 0");
  BOOST_TEST(holds(complaint([] {
                     plain_text(std::string("\xFF\xFE*\0", 4), "mesh.inp");
                   }),
                   "mesh.inp"));
  BOOST_TEST(fingerprint("a") != fingerprint("b"));
}

BOOST_AUTO_TEST_SUITE_END()
