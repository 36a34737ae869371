// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_growth_archive_h
#define nacre_simulation_growth_archive_h

#include <nacre/simulation/crack_growth.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

namespace Nacre
{
  /**
   * @name How an archive of boost keeps what growth has made
   * It finds these functions by the types of their arguments.
   */
  //@{
  template <typename Archive>
  void
  serialize(Archive &archive, CutCurve &curve, const unsigned int)
  {
    archive &curve.name &curve.coordinates &curve.points &curve.is_closed;
  }

  template <typename Archive>
  void
  serialize(Archive &archive, GrowingTip &tip, const unsigned int)
  {
    archive &tip.name &tip.end.cut &tip.end.at_end &tip.is_alive &tip.advanced;
    archive &tip.position &tip.step &tip.rate &tip.closed;
    archive &tip.has_intensities &tip.intensities &tip.drive &tip.angle;
  }

  template <typename Archive>
  void
  serialize(Archive &archive, LineEnd &end, const unsigned int)
  {
    archive &end.distance &end.at_edge &end.at_cut;
  }

  template <typename Archive>
  void
  serialize(Archive &archive, CrackStart &start, const unsigned int)
  {
    archive &start.position &start.direction &start.normal &start.step;
    archive &start.distance &start.stress &start.ends &start.drive &start.turn;
  }

  template <typename Archive>
  void
  serialize(Archive &archive, GrowthState &state, const unsigned int)
  {
    archive &state.curves &state.tips &state.starts &state.n_started &state
      .n_steps;
  }
  //@}
} // namespace Nacre

#endif
