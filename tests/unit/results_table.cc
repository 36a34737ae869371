// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Ratios and observed rates of a study, as numbers and in the files.

#include "unit_test.h"
#include <nacre/postprocess/results_table.h>

#include <cmath>
#include <sstream>

using namespace Nacre;
using namespace UnitTests;

namespace
{
  ResultsTable::Row
  row(const unsigned int degree, const unsigned int dofs, const double value)
  {
    ResultsTable::Row row;
    row.element   = "Lagrange";
    row.degree    = degree;
    row.eta       = "default";
    row.thickness = "0.1";
    row.cells     = dofs / 10;
    row.dofs      = dofs;
    row.values    = {value};
    return row;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(results_table)

BOOST_AUTO_TEST_CASE(ratios_and_rates)
{
  ResultsTable table("w", {{"w", 2., true}});
  table.add_row(row(2, 100, 1.6));  // error 0.2
  table.add_row(row(2, 400, 1.9));  // error 0.05: order 2 in h
  table.add_row(row(3, 400, 1.98)); // another degree: no rate
  BOOST_TEST(std::abs(table.ratio(0, 0) - 0.8) < 1e-15);
  BOOST_TEST(std::isnan(table.rate(0, 0)));
  BOOST_TEST(std::abs(table.rate(1, 0) - 2.) < 1e-12);
  BOOST_TEST(std::isnan(table.rate(2, 0)));
}

BOOST_AUTO_TEST_CASE(files_hold_every_row)
{
  ResultsTable table("w", {{"w", 2., true}});
  table.add_row(row(2, 100, 1.6));
  table.add_row(row(2, 400, 1.9));
  std::ostringstream csv, text, tex;
  table.write_csv(csv);
  table.write_text(text, false);
  table.write_tex(tex);
  BOOST_TEST(holds(csv.str(), "element,degree,eta,thickness,cells,dofs,w"));
  BOOST_TEST(holds(csv.str(), "Lagrange,2,default,0.1,40,400,1.9"));
  BOOST_TEST(holds(text.str(), "0.95"));
  BOOST_TEST(!holds(text.str(), "solve_s"));
  BOOST_TEST(holds(tex.str(), "toprule"));
}

BOOST_AUTO_TEST_CASE(what_makes_no_ratio)
{
  BOOST_TEST(complaint([] { ResultsTable("", {{"w", 0., false}}); }) != "");
  BOOST_TEST(complaint([] {
               ResultsTable("", {{"w", {}, false}, {"w", {}, false}});
             }) != "");
}

BOOST_AUTO_TEST_SUITE_END()
