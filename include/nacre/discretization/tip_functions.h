// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_tip_functions_h
#define nacre_discretization_tip_functions_h

#include <nacre/mechanics/williams_fields.h>

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace Nacre
{
  /** A vector field at a point, with derivatives along two coordinates. */
  struct FieldDerivatives
  {
    Tensor<1, 3>                value;
    std::array<Tensor<1, 3>, 2> first;
    /** 11, 22, 12. */
    std::array<Tensor<1, 3>, 3> second;

    /** Add @p factor times @p other. */
    void
    add(const double factor, const FieldDerivatives &other);
  };

  /**
   * Displacements F_k around a crack's tip, functions of x = (X - X_tip) . e_1
   * and y = (X - X_tip) . e_2, whose components are those along the tip's axes.
   *
   * Or scalar functions f_k of x and y, each of which stands for the three
   * displacements f_k e_x, f_k e_y, f_k e_z along the axes of space: their
   * coefficients are a vector, as those of a node are, and their span is that
   * of the same functions after any rotation.
   */
  class TipFunctions
  {
  public:
    /** At a tip in the plane or tangent to a surface. */
    struct Tip
    {
      /** Length. */
      Point<3> position;
      /** e_1 ahead, e_2 to the left, e_3 = e_1 x e_2. */
      std::array<Tensor<1, 3>, 3> axes;
    };

    /**
     * The singular ones: Williams' membrane and bending fields of the orders
     * n = 1 and 3, symmetric and antisymmetric. They are scaled such that they
     * are of order 1 at the distance @p length from the tip.
     */
    static TipFunctions
    branch_functions(const Tip   &tip,
                     const double poissons_ratio,
                     const double length);

    /**
     * The scalar functions that span, times vectors, those of
     * branch_functions() after any rotation: r^(n/2) times the cosine and the
     * sine of n theta/2 and (n/2 - 2) theta, n = 1 and 3, among which are
     * Williams' deflections w of the order n = 1, and w of the order 3.
     */
    static TipFunctions
    branch_scalars(const Tip   &tip,
                   const double poissons_ratio,
                   const double length);

    /** @param length size of the cell */
    TipFunctions(const Tip                        &tip,
                 const std::vector<WilliamsField> &fields,
                 const double                      length)
      : tip_(tip)
      , length_(length)
      , fields_(fields)
    {}

    /** Scalar functions; @param length size of the cell */
    TipFunctions(const Tip                      &tip,
                 const std::vector<PolarSeries> &scalars,
                 const double                    length);

    /** Whether they are scalar functions. */
    bool
    are_scalars() const
    {
      return are_scalars_;
    }

    /** Of the fields F_k, or of the scalars f_k. */
    unsigned int
    n_fields() const
    {
      return fields_.size();
    }

    /** Of the coefficients. */
    unsigned int
    size() const
    {
      return (are_scalars_ ? 3 : 1) * n_fields();
    }

    /** The direction of the component @p i of the fields. */
    Tensor<1, 3>
    direction(const unsigned int i) const
    {
      Tensor<1, 3> e;
      e[i] = 1.;
      return are_scalars_ ? e : tip_.axes[i];
    }

    const Tip &
    tip() const
    {
      return tip_;
    }

    /**
     * The values of all fields; f_k e_x of scalars. @p side is positive on the
     * sheet of the crack's left lip, negative on that of its right one, where
     * theta goes on beyond half a turn; 0: theta as it is.
     */
    std::vector<Tensor<1, 3>>
    values(const Point<3> &position, const int side) const;

    /**
     * The displacement (length) sum_k c_k F_k, or sum_k f_k c_k of scalars.
     * @param values as values() returns them
     * @param coefficients c_k, the three of each scalar in turn
     */
    Tensor<1, 3>
    sum(const std::vector<Tensor<1, 3>> &values,
        const std::vector<double>       &coefficients) const;

    /**
     * The coefficients by which the branch functions @p other, of the same
     * tip but scaled by another length, are the displacement that these are
     * with @p coefficients: the F_k go as a power of r over the length.
     */
    std::vector<double>
    coefficients_of(const TipFunctions        &other,
                    const std::vector<double> &coefficients) const;

    /** By which the functions are scaled. */
    double
    length() const
    {
      return length_;
    }

    /**
     * The values of all fields, and their derivatives by the surface's
     * coordinates.
     * @param surface position, and its derivatives (length)
     */
    void
    evaluate(const FieldDerivatives        &surface,
             const int                      side,
             std::vector<FieldDerivatives> &result) const;

  private:
    std::pair<double, double>
    polar_coordinates(const Tensor<1, 3> &position, const int side) const;

    Tensor<1, 3>
    in_space(const Tensor<1, 3> &components) const
    {
      return components[0] * direction(0) + components[1] * direction(1) +
             components[2] * direction(2);
    }

    Tip                        tip_;
    double                     length_;
    std::vector<WilliamsField> fields_;
    bool                       are_scalars_ = false;
  };
} // namespace Nacre

#endif
