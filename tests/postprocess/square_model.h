// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_square_model_h
#define nacre_tests_square_model_h

#include <nacre/problem/shell_model.h>
#include <nacre/problem/surfaces.h>

namespace Tests
{
  /** A model for meshes that are handed over: its own surface is not used. */
  template <typename Section>
  Nacre::ShellModel
  square_model(const Section              &section,
               const Nacre::MembraneStrain strain = Nacre::MembraneStrain::tied)
  {
    Nacre::ChartRectangle rectangle;
    rectangle.u = rectangle.v = {0., 1.};
    Nacre::ShellModel model{Nacre::Midsurface(Nacre::make_rectangle(
                              rectangle,
                              Nacre::make_chart_map(
                                [](const dealii::Point<3> &c) { return c; }))),
                            std::make_shared<Section>(section)};
    model.kinematics.membrane_strain = strain;
    return model;
  }
} // namespace Tests

#endif
