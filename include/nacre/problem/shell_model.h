// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_shell_model_h
#define nacre_problem_shell_model_h

#include <nacre/mechanics/surface_axes.h>
#include <nacre/problem/boundary_conditions.h>
#include <nacre/problem/cuts.h>
#include <nacre/problem/element.h>
#include <nacre/problem/exact_solution.h>
#include <nacre/problem/foundation.h>
#include <nacre/problem/kinematics_options.h>
#include <nacre/problem/loads.h>
#include <nacre/problem/midsurface.h>

#include <memory>
#include <optional>

namespace Nacre
{
  class SectionLaw;

  /**
   * A shell, and how it is discretised: values that ShellModelParameters reads
   * from a parameter file, or that a program states. A model holds no time:
   * whoever evaluates loads and conditions says which Instant is meant.
   *
   *   ShellModel model{
   *     Midsurface(describe_my_surface()),
   *     std::make_shared<LinearElasticSection>(210e9, 0.3, 0.01)};
   *   model.supports.clamp(model.midsurface.edge_ids("left", "my program"));
   *   model.loads.force = Tensor<1, 3>({0., 0., -1e3});
   */
  struct ShellModel
  {
    Midsurface                        midsurface;
    std::shared_ptr<const SectionLaw> section;
    BoundaryConditions                supports = {};
    Loads                             loads    = {};
    /**
     * Factor of loads and prescribed values over the time; none: they are
     * taken as they stand, at t = 0, as linear analyses do.
     */
    std::optional<Expression> load_factor    = {};
    ExactSolution             exact_solution = {};

    Element element = {};
    /** Of the mid-surface's geometry; 0: isoparametric. */
    unsigned int      mapping_degree = 0;
    KinematicsOptions kinematics     = {};
    /** The penalty's factor (15); none: twice the bound of each cell. */
    std::optional<double> eta = {};

    /** The axes of stresses, forces and moments in the results. */
    SurfaceAxes result_axes = {};

    Foundation foundation = {};

    /** Where the shell is cut. */
    Cuts cuts = {};

    /** @p time with the factor of loads and prescribed values there. */
    Instant
    at(const double time) const
    {
      return {time, load_factor ? (*load_factor)(Point<3>(), time) : 1.};
    }
  };
} // namespace Nacre

#endif
