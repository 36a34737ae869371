// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_prescribed_rotation_h
#define nacre_forms_prescribed_rotation_h

#include <nacre/base/types.h>

#include <deal.II/base/symmetric_tensor.h>

namespace Nacre
{
  /** The rotation prescribed at a point of a boundary edge. */
  struct PrescribedRotation
  {
    /** @param angle theta_bar (rad) about the edge */
    PrescribedRotation(const double angle = 0.)
      : angle(angle)
      , turn(unit_symmetric_tensor<spacedim>())
    {}

    double angle;
    /** How the prescribed displacements have turned the edge. */
    Tensor<2, spacedim> turn;
  };

  /** The mean angle of both, with the turn of @p end. */
  inline PrescribedRotation
  mean_rotation(const PrescribedRotation &start, const PrescribedRotation &end)
  {
    PrescribedRotation mean(end);
    mean.angle = 0.5 * (start.angle + end.angle);
    return mean;
  }
} // namespace Nacre

#endif
