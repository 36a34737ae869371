// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_imperfection_h
#define nacre_problem_imperfection_h

#include <nacre/base/expression.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * Values at scattered points of a surface, from lines 'x y z w' (along the
   * normal) or 'x y z dx dy dz' of a file; blanks, commas or semicolons
   * separate numbers. Lines that don't begin with a number are comments.
   *
   * In between, the value is that of the quadratic polynomial in the tangent
   * plane that fits the nearest points best, with weights that grow without
   * bound at a point (moving least squares; Lancaster and Salkauskas 1981): the
   * points' own values are met.
   */
  class PointField
  {
  public:
    /** Throws for lines that are no points; @p where names the parameter. */
    PointField(const std::string &text, const std::string &where);
    PointField(PointField &&) noexcept;
    ~PointField();

    /** The displacement at the point @p x with the unit normal @p t0. */
    Tensor<1, 3>
    operator()(const Point<3> &x, const Tensor<1, 3> &t0) const;

    /** The length of the largest value (length). */
    double
    largest() const;

  private:
    struct Tree;

    /** Weights of a quadratic fit at @p x for points at the @p offsets. */
    static std::vector<double>
    weights(const std::vector<Tensor<1, 3>> &offsets, const Tensor<1, 3> &t0);

    std::string                 where_;
    bool                        is_along_normal_ = false;
    std::vector<Point<3>>       points_;
    std::vector<Tensor<1, 3>>   values_;
    std::unique_ptr<const Tree> tree_;
  };

  /**
   * How far a shell without stress is from its perfect mid-surface: a sum of
   * expressions and of files' values.
   */
  struct Imperfection
  {
    Expression       along_normal;
    VectorExpression displacement;
    /** With the factors of their values. */
    std::vector<std::pair<PointField, double>> fields;
    /** The content of their files, one after the other. */
    std::string content;

    /** The displacement (length) of the point @p x with the normal @p t0. */
    Tensor<1, 3>
    operator()(const Point<3> &x, const Tensor<1, 3> &t0) const;
  };

  /** The subsection Mid-surface/Imperfection of a parameter file. */
  class ImperfectionParameters : public ParameterAcceptor
  {
  public:
    ImperfectionParameters();

    /**
     * Null if there is none. Files are read on rank 0 of @p communicator, from
     * the @p folder; throws for what isn't as it should be. Collective.
     */
    std::unique_ptr<const Imperfection>
    make(const Constants   &constants,
         const MPI_Comm     communicator,
         const std::string &folder) const;

  private:
    std::string normal_text_       = "0";
    std::string displacement_text_ = "0, 0, 0";
    std::string modes_text_;
    std::string points_text_;
  };
} // namespace Nacre

#endif
