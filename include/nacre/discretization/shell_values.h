// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_shell_values_h
#define nacre_discretization_shell_values_h

#include <nacre/discretization/discretization.h>
#include <nacre/discretization/membrane_tying.h>
#include <nacre/discretization/part_enrichment.h>
#include <nacre/discretization/shape_table.h>
#include <nacre/mechanics/section_law.h>
#include <nacre/mechanics/surface_frame.h>

#include <deal.II/base/quadrature.h>

#include <deal.II/lac/full_matrix.h>

#include <optional>
#include <vector>

namespace Nacre
{
  /**
   * Frames and strains on a cell: FEValues for shells.
   *
   * The rows of strains are matrices [3 q + v][i]: Voigt component v of the
   * strain at the point q of the local dof i.
   *
   * Tied membrane strains (against membrane locking) are interpolated from the
   * samples of a MembraneTying. On parts of divided cells, the L2 projection
   * over the part onto the same polynomials takes the place of interpolation,
   * which would lose consistency there.
   */
  class ShellCellValues
  {
  public:
    /** What the points are. */
    enum class Points
    {
      /** A rule of whole cells; parts have a rule of their own. */
      rule,
      /** Points where values are wanted, on any part of the cell. */
      given
    };

    /**
     * @param quadrature points in the reference cell
     * @param tied whether membrane strains are tied
     */
    ShellCellValues(const Discretization  &discretization,
                    const Quadrature<dim> &quadrature,
                    const bool             tied,
                    const Points           points = Points::rule);

    /**
     * Whether membrane strains are projected on parts of divided cells; tied
     * ones are unless this says otherwise.
     */
    void
    project_on_parts(const bool projects)
    {
      projects_ = projects;
    }

    /**
     * Whether parts near the tips of cuts have the functions of these, which
     * they do unless this says otherwise.
     */
    void
    use_tip_functions(const bool uses)
    {
      uses_tip_functions_ = uses;
    }

    /** The points lie on a lip, as PartEnrichment::evaluate() takes it. */
    void
    use_lip(const Tensor<1, dim> &lip)
    {
      lip_ = lip;
    }

    /** Frames and rows of the linear strains; of tying frames a_cov only. */
    void
    reinit(const CellPart &part);

    /** Frames only. */
    void
    reinit_frames(const CellPart &part);

    /** Whether the last part is one of a divided cell. */
    bool
    is_cut() const
    {
      return of_part_.has_value();
    }

    unsigned int
    n_points() const
    {
      return frames_.size();
    }

    /** Those of the nodes, and behind them those of tip functions. */
    unsigned int
    n_dofs() const
    {
      return discretization_.node_dofs().size() + n_functions_;
    }

    /** Those that aren't scalars; these are among the shapes(). */
    unsigned int
    n_tip_functions() const
    {
      return n_tip_functions_;
    }

    /** psi_k at the point @p q, of the local dof tip_dof(k). */
    const FieldDerivatives &
    tip_function(const unsigned int q, const unsigned int k) const
    {
      return tip_functions_[q * n_tip_functions_ + k];
    }

    unsigned int
    tip_dof(const unsigned int k) const
    {
      return discretization_.node_dofs().size() + k;
    }

    /** The points in the reference cell, and their weights. */
    const Quadrature<dim> &
    quadrature() const
    {
      return tables().quadrature;
    }

    const SurfaceFrame<> &
    frame(const unsigned int q) const
    {
      return frames_[q];
    }

    /** Position of the point @p q (length), and the region of the cell. */
    SectionPoint
    point(const unsigned int q) const
    {
      return {geometry_.position(q), material_id_};
    }

    /** Area element times weight (length^2). */
    double
    JxW(const unsigned int q) const
    {
      return frames_[q].j0 * tables().quadrature.weight(q);
    }

    const ShapeTable &
    shapes() const
    {
      return tables().shapes;
    }

    /** Local dof of the component @p c of the shape function @p a. */
    unsigned int
    dof(const unsigned int a, const unsigned int c) const
    {
      return discretization_.local_dof(a, c);
    }

    /** Where the membrane strain is sampled: at the points if untied. */
    const MembraneTying &
    tying() const
    {
      return tables().tying;
    }

    /** Shape functions at the tying points. */
    const ShapeTable &
    tying_shapes() const
    {
      return tables().tying_shapes;
    }

    /** Frame at the tying point @p k; no second derivatives if tied. */
    const SurfaceFrame<> &
    tying_frame(const unsigned int k) const
    {
      return tables().has_tying_points ? tying_frames_[k] : frames_[k];
    }

    /** Rows of the membrane strain, (3) or its tied interpolation. */
    const FullMatrix<double> &
    membrane_rows() const
    {
      return membrane_rows_;
    }

    /** Rows of the bending strain, (4). */
    const FullMatrix<double> &
    bending_rows() const
    {
      return bending_rows_;
    }

  private:
    /** What the reference cell alone determines. */
    struct Tables
    {
      Tables(const Discretization  &discretization,
             const Quadrature<dim> &quadrature,
             const MembraneTying   &tying,
             const bool             has_tying_points);

      Quadrature<dim> quadrature;
      MembraneTying   tying;
      /** Whether strains are sampled at other points. */
      bool          has_tying_points;
      ShapeTable    shapes;
      ShapeTable    tying_shapes;
      GeometryTable geometry;
      GeometryTable tying_geometry;
    };

    const Tables &
    tables() const
    {
      return of_part_ ? *of_part_ : of_cell_;
    }

    /** Tables of a part of a divided cell, or of the whole cell. */
    void
    set_tables(const CellPart &part);

    /** Room for the points of the tables. */
    void
    resize();

    /** Frames at the points, and the geometry at the tying points. */
    void
    evaluate(const CellPart &part);

    void
    evaluate_tip_functions(const PartEnrichment &enrichment);

    void
    fill_membrane_rows();

    void
    fill_tied_membrane_rows();

    void
    fill_bending_rows();

    /** The tip functions of the part that are in use. */
    const PartEnrichment *
    enrichment_of(const CellPart &part) const
    {
      return uses_tip_functions_ ? part.enrichment() : nullptr;
    }

    const Discretization &discretization_;
    const bool            tied_;
    const Points          points_;
    bool                  projects_;
    bool                  uses_tip_functions_ = true;
    Tensor<1, dim>        lip_;
    const Tables          of_cell_;
    std::optional<Tables> of_part_;

    GeometryTable::Values geometry_;
    GeometryTable::Values tying_geometry_;
    types::material_id    material_id_ = 0;

    /** Of the dofs of tips, and of their functions that aren't scalars. */
    unsigned int                  n_functions_     = 0;
    unsigned int                  n_tip_functions_ = 0;
    std::vector<FieldDerivatives> tip_functions_;

    std::vector<SurfaceFrame<>> frames_;
    std::vector<SurfaceFrame<>> tying_frames_;
    FullMatrix<double>          membrane_rows_;
    FullMatrix<double>          bending_rows_;
    FullMatrix<double>          tying_rows_;
  };
} // namespace Nacre

#endif
