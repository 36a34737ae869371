// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_foundation_h
#define nacre_problem_foundation_h

#include <nacre/base/expression.h>
#include <nacre/base/mesh_region.h>
#include <nacre/base/selection.h>
#include <nacre/mechanics/section_law.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  /** On which side of the shell a foundation lies that can't pull. */
  enum class TensionFree
  {
    /** It pushes and pulls. */
    no,
    /** On the side -t0: it acts where u . t0 < 0. */
    below,
    /** On the side t0: it acts where u . t0 > 0. */
    above
  };

  const Selection<TensionFree> &selection(TensionFree);

  /**
   * An elastic foundation (Winkler, 1867): springs of the undeformed surface
   * with the energy per area, w = u . t0,
   *
   *   (k_n w^2 + k_t |u - w t0|^2)/2.
   *
   * They keep the direction of the undeformed normal t0 in all kinematics. A
   * tension-free one has k_n = 0 where it would pull; k_t acts everywhere.
   */
  struct Foundation
  {
    /** Functions of the point (force/length^3). */
    struct Springs
    {
      Expression normal;
      Expression tangential;

      bool
      is_zero() const
      {
        return normal.is_zero() && tangential.is_zero();
      }
    };

    Springs     springs;
    TensionFree tension_free = TensionFree::no;
    /** Of the mesh's regions; none, or beyond the end: springs. */
    std::vector<std::optional<Springs>> of_region = {};

    /** A force (force/length^2) or an energy with its derivative. */
    struct Answer
    {
      double force     = 0.;
      double stiffness = 0.;
    };

    /** Whether there are no springs anywhere. */
    bool
    is_zero() const;

    /** Whether forces aren't linear in displacements. */
    bool
    is_nonlinear() const
    {
      return tension_free != TensionFree::no && !is_zero();
    }

    /** (k_n, k_t) at @p point; throws if one is negative. */
    std::array<double, 2>
    stiffness(const SectionPoint &point) const;

    /** Energy per area of the normal springs of the stiffness @p k. */
    double
    normal_energy(const double k, const double w) const;

    /**
     * The normal springs' mean force (energy(end) - energy(start)) / (w_end -
     * w_start), a discrete gradient, and its derivative with respect to the
     * mean of both: for w_start = w_end the force and its derivative.
     */
    Answer
    normal_answer(const double k,
                  const double w_start,
                  const double w_end) const;
  };

  /** The section Foundation of a parameter file. */
  class FoundationParameters : public ParameterAcceptor
  {
  public:
    FoundationParameters();

    /** Throws for what is no expression, and for regions that aren't there. */
    Foundation
    make(const Constants &constants, const MeshRegions &regions) const;

  private:
    std::string normal_text_     = "0";
    std::string tangential_text_ = "0";
    std::string regions_text_;
    TensionFree tension_free_ = TensionFree::no;
  };
} // namespace Nacre

#endif
