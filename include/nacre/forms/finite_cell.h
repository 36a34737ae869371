// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_finite_cell_h
#define nacre_forms_finite_cell_h

#include <nacre/forms/corotational_cell.h>
#include <nacre/forms/section_blocks.h>
#include <nacre/forms/tied_green_strain.h>

namespace Nacre
{
  /**
   * kappa at the point @p q of @p shapes for the displacements @p u of nodes,
   * and the frame @p geometry of its variations: the deformed one, of
   * StrainMeasure::linear the undeformed one.
   */
  template <typename Number>
  Voigt<Number>
  bending_strain(const StrainMeasure        measure,
                 const SurfaceFrame<>      &frame,
                 const ShapeTable          &shapes,
                 const unsigned int         q,
                 const NodeVectors<Number> &u,
                 SurfaceFrame<Number>      &geometry)
  {
    if (measure == StrainMeasure::green)
      {
        geometry = deformed_frame(frame, shapes, q, u);
        return CorotationalStrain::bending(frame, geometry);
      }
    geometry = deformed_frame(frame, shapes, q, NodeVectors<Number>());
    return ShellStrain::bending(frame,
                                displacement_gradient(shapes, q, u),
                                displacement_hessian(shapes, q, u));
  }

  /**
   * Strains, resultants and internal forces of a cell with exact finite
   * rotations, at the points of one rule:
   *
   *   W = sum_q w_q w(E, kappa),
   *
   * w the section's energy, 1/2 E : n + 1/2 kappa : m of linear laws, E the
   * Green strain (GreenStrain), sampled at the tying points and interpolated to
   * the points q, and kappa the exact change of curvature; or those of
   * StrainMeasure::linear. The forces are the exact gradient of W.
   *
   * Templated on the scalar, so that tests can take complex steps; laws that
   * aren't linear know real numbers only.
   */
  template <typename Number>
  class FiniteCell
  {
  public:
    using Vector = Tensor<1, spacedim, Number>;

    explicit FiniteCell(const StrainMeasure measure = StrainMeasure::green)
      : measure_(measure)
      , membrane_(measure)
    {}

    /**
     * @param sections at the points, area and weight included; they take the
     *   strains
     * @param bends whether these points have bending energy
     */
    void
    reinit(const ShellCellValues      &values,
           std::vector<SectionBlocks> &sections,
           const NodeVectors<Number>  &u,
           const bool                  bends = true)
    {
      bends_ = bends;
      membrane_.reinit(values, u);
      membrane_strains_.resize(values.n_points());
      bending_strains_.assign(values.n_points(), Voigt<Number>());
      deformed_.resize(bends ? values.n_points() : 0);
      for (unsigned int q = 0; q < values.n_points(); ++q)
        {
          membrane_strains_[q] = membrane_.tied_strain(values.tying(), q);
          if (!bends)
            continue;
          bending_strains_[q] = bending_strain(measure_,
                                               values.frame(q),
                                               values.shapes(),
                                               q,
                                               u,
                                               deformed_[q]);
        }
      set_resultants(values, sections);
    }

    /**
     * Take the means over a step from @p start to @p end: of strains and
     * resultants, and StepDifferences' frames. The forces then do the work
     * W(end) - W(start) on the step's displacement: E is quadratic in it, so
     * that its difference is dE at the mean, and Delta(kappa) is that of
     * StepDifferences::mean_frame(). Of linear laws and Green strains only.
     */
    void
    take_means(const ShellCellValues      &values,
               std::vector<SectionBlocks> &sections,
               const FiniteCell<Number>   &start,
               const FiniteCell<Number>   &end)
    {
      bends_            = start.bends_;
      membrane_strains_ = start.membrane_strains_;
      bending_strains_  = start.bending_strains_;
      deformed_.resize(start.deformed_.size());
      membrane_.take_means(start.membrane_, end.membrane_);
      for (unsigned int q = 0; q < deformed_.size(); ++q)
        deformed_[q] =
          StepDifferences::mean_frame(start.deformed_[q], end.deformed_[q]);
      for (unsigned int q = 0; q < membrane_strains_.size(); ++q)
        {
          membrane_strains_[q] =
            0.5 * (start.membrane_strains_[q] + end.membrane_strains_[q]);
          bending_strains_[q] =
            0.5 * (start.bending_strains_[q] + end.bending_strains_[q]);
        }
      set_resultants(values, sections);
    }

    /** 1/2 sum of E : n (force times length). */
    Number
    membrane_energy() const
    {
      Number sum = 0.;
      for (unsigned int q = 0; q < forces_.size(); ++q)
        sum += 0.5 * (membrane_strains_[q] * forces_[q]);
      return sum;
    }

    /** 1/2 sum of kappa : m (force times length). */
    Number
    bending_energy() const
    {
      Number sum = 0.;
      for (unsigned int q = 0; q < moments_.size(); ++q)
        sum += 0.5 * (bending_strains_[q] * moments_[q]);
      return sum;
    }

    /** Add the internal force of each node (force). */
    void
    add_force(const ShellCellValues &values, NodeVectors<Number> &force) const
    {
      membrane_.add_force(values.tying_shapes(), force);
      for (unsigned int q = 0; q < deformed_.size(); ++q)
        for (unsigned int a = 0; a < force.size(); ++a)
          {
            const Voigt<Number> strain = ShellStrain::bending_of_shape_function(
              deformed_[q],
              values.shapes().gradient(q, a),
              values.shapes().hessian(q, a));
            force[a] += (strain * moments_[q]) * deformed_[q].t0;
          }
    }

    /** E and kappa at the point @p q, Voigt. */
    std::pair<Voigt<Number>, Voigt<Number>>
    strains(const unsigned int q) const
    {
      return {membrane_strains_[q], bending_strains_[q]};
    }

    /** E at the tying points, and the forces that do work on it. */
    const TiedGreenStrain<Number> &
    membrane() const
    {
      return membrane_;
    }

    StrainMeasure
    measure() const
    {
      return measure_;
    }

    /** The frame of the variations, the deformed one, at the point @p q. */
    const SurfaceFrame<Number> &
    deformed(const unsigned int q) const
    {
      return deformed_[q];
    }

    /** n^ab times area and weight at the point @p q, Voigt. */
    const Voigt<Number> &
    force(const unsigned int q) const
    {
      return forces_[q];
    }

    /** m^ab times area and weight at the point @p q, Voigt. */
    const Voigt<Number> &
    moment(const unsigned int q) const
    {
      return moments_[q];
    }

  private:
    /** n and m at the points, and what n does to the tying points. */
    void
    set_resultants(const ShellCellValues      &values,
                   std::vector<SectionBlocks> &sections)
    {
      const auto &tying = values.tying();
      forces_.resize(membrane_strains_.size());
      moments_.assign(membrane_strains_.size(), Voigt<Number>());
      for (unsigned int q = 0; q < forces_.size(); ++q)
        {
          sections[q].evaluate(membrane_strains_[q], bending_strains_[q]);
          forces_[q] =
            sections[q].force(membrane_strains_[q], bending_strains_[q]);
          if (bends_)
            moments_[q] =
              sections[q].moment(membrane_strains_[q], bending_strains_[q]);
          membrane_.add_point_force(tying, q, forces_[q]);
        }
      membrane_.set_resultants(tying);
    }

    StrainMeasure           measure_;
    bool                    bends_ = true;
    TiedGreenStrain<Number> membrane_;
    /** By point. */
    std::vector<SurfaceFrame<Number>> deformed_;
    std::vector<Voigt<Number>>        membrane_strains_;
    std::vector<Voigt<Number>>        bending_strains_;
    std::vector<Voigt<Number>>        forces_;
    std::vector<Voigt<Number>>        moments_;
  };
} // namespace Nacre

#endif
