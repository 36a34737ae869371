// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_point_constraints_h
#define nacre_discretization_point_constraints_h

#include <nacre/discretization/discretization.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace Nacre
{
  /** A point of the mesh as a combination of nodes, known to all ranks. */
  struct PointPlace
  {
    Point<spacedim> position;
    /** The rank that owns the cell. */
    unsigned int owner = 0;
    /** Nodes whose shape functions don't vanish there, and their values. */
    std::vector<std::array<types::global_dof_index, spacedim>> dofs;
    std::vector<double>                                        weights;
    /** Whether the point is a node, and no hanging one. */
    bool is_node = false;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &position &dofs &weights &is_node;
    }
  };

  /** This rank's part of the displacement @p u there. */
  Tensor<1, spacedim>
  displacement_of(const PointPlace                    &place,
                  const TrilinosWrappers::MPI::Vector &u,
                  const IndexSet                      &owned);

  /**
   * Find @p point on the mesh, at a node or on an edge if it lies within a
   * thousandth of a cell of it. Collective; throws as
   * Discretization::locate() does.
   */
  PointPlace
  place_point(const Discretization  &discretization,
              const Point<spacedim> &point,
              const std::string     &source);

  /** One displacement component prescribed at a point between the nodes. */
  struct PointCondition
  {
    /** Which of BoundaryConditions::points(). */
    std::size_t        support;
    unsigned int       component;
    PointPlace         place;
    double             value;
    const std::string *source;
  };

  /**
   * Conditions sum_a N_a u_a = value at points between the nodes, solved for
   * one dof each, together with the conditions of nodes and hanging nodes.
   */
  class PointConstraints
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;

    /** None. */
    PointConstraints() = default;

    /**
     * Collective. Throws if a condition contradicts others, unless on a
     * coarse level.
     * @param others closed constraints of hanging nodes and of nodes; a copy
     *   is kept
     */
    PointConstraints(const Discretization              &discretization,
                     const std::vector<PointCondition> &conditions,
                     const AffineConstraints<double>   &others);

    bool
    is_empty() const
    {
      return conditions_.empty();
    }

    const std::vector<PointCondition> &
    conditions() const
    {
      return conditions_;
    }

    /** Constraints of hanging nodes, nodes and points; close() them. */
    void
    add_to(AffineConstraints<double> &constraints) const;

    /** All dofs of the lines, ascending, the same on all ranks. */
    const std::vector<types::global_dof_index> &
    dofs() const
    {
      return columns_;
    }

    /** The values of the conditions' displacements in @p u; collective. */
    std::vector<double>
    values(const Vector &u) const;

    /**
     * Change the displacement @p v of this rank's dofs so that its values() are
     * @p targets, by displacements that fulfil all other conditions, as
     * homogeneous ones. Then r . v is, for the residual r, the sum of the
     * support forces times the targets. Collective.
     */
    void
    set_values(const std::vector<double> &targets, Vector &v) const;

  private:
    using Line = std::vector<std::pair<types::global_dof_index, double>>;

    /**
     * A condition in terms of dofs that don't hang, and in terms of free dofs.
     */
    struct Equation
    {
      Line   by_nodes;
      Line   by_free;
      double known = 0.;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &by_nodes &by_free &known;
      }
    };

    Equation
    make_equation(const PointCondition &condition) const;

    /** Solve the equations for pivots, Gauss-Jordan. */
    void
    eliminate(const bool checks);

    /** Throw if the equation @p k, a sum of others, contradicts them. */
    void
    check_dependent(const unsigned int k) const;

    /** The value of an equation minus its known part. */
    double
    right_hand_side(const unsigned int k) const;

    const Discretization       *discretization_ = nullptr;
    AffineConstraints<double>   others_;
    std::vector<PointCondition> conditions_;
    std::vector<Equation>       equations_;
    /** Free dofs of all equations. */
    std::vector<types::global_dof_index> columns_;
    /** Row k: the k-th equation after elimination, by columns_. */
    FullMatrix<double> rows_;
    /** rows_ = combination_ times the equations. */
    FullMatrix<double> combination_;
    /** Rows and their columns of value 1; no other row has an entry there. */
    std::vector<std::pair<unsigned int, unsigned int>> pivots_;
  };
} // namespace Nacre

#endif
