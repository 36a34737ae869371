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

    /** Those of branch_functions(). */
    static constexpr unsigned int n_branch_functions = 8;

    /**
     * The singular ones: Williams' membrane and bending fields of the orders
     * n = 1 and 3, symmetric and antisymmetric. They are scaled such that they
     * are of order 1 at the distance @p length from the tip.
     */
    static TipFunctions
    branch_functions(const Tip   &tip,
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

    unsigned int
    size() const
    {
      return fields_.size();
    }

    const Tip &
    tip() const
    {
      return tip_;
    }

    /**
     * The values of all functions. @p side is positive on the sheet of the
     * crack's left lip, negative on that of its right one, where theta goes on
     * beyond half a turn; 0: theta as it is.
     */
    std::vector<Tensor<1, 3>>
    values(const Point<3> &position, const int side) const;

    /**
     * Those, and their derivatives by the surface's coordinates.
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
      return components[0] * tip_.axes[0] + components[1] * tip_.axes[1] +
             components[2] * tip_.axes[2];
    }

    Tip                        tip_;
    double                     length_;
    std::vector<WilliamsField> fields_;
  };
} // namespace Nacre

#endif
