// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_expression_h
#define nacre_base_expression_h

#include <nacre/base/types.h>

#include <deal.II/base/exceptions.h>

#include <array>
#include <memory>

namespace dealii
{
  template <int dim>
  class FunctionParser;
}

namespace Nacre
{
  /**
   * The value of a user's expression is not a finite number: maybe only from
   * some time on, which ends a path and not what has been computed.
   */
  class ExcUndefinedValue : public StandardExceptions::ExcMessage
  {
  public:
    using StandardExceptions::ExcMessage::ExcMessage;
  };

  /**
   * A muParser expression of a parameter file, with named constants (and pi).
   * Malformed text and unknown names throw an ExcMessage, values that aren't
   * finite an ExcUndefinedValue: it names the parameter, the expression, the
   * point and the time.
   */
  class Expression
  {
  public:
    /** The constant zero. */
    Expression();

    /**
     * @param text the expression, e.g. "q*cos(2*x)"
     * @param where the parameter that holds it, for messages
     * @param constants named constants
     * @param variables comma-separated names of the point's coordinates, at
     *        most three; a fourth one is the time
     */
    Expression(const std::string &text,
               const std::string &where,
               const Constants   &constants,
               const std::string &variables = "x,y,z");
    Expression(Expression &&) noexcept;
    Expression &
    operator=(Expression &&) noexcept;
    ~Expression();

    /** The value at @p point; throws if it isn't finite. */
    double
    operator()(const Point<3> &point) const;

    /** The value at another @p time and for another @p factor. */
    double
    value_at(const Point<3> &point,
             const double    time,
             const double    factor) const;

    /** Set the time, 0 before, and a factor of all values, 1 before. */
    void
    set_time(const double time, const double factor = 1.);

    /** Whether the text mentions none of the variables. */
    bool
    is_constant() const;

    /** Whether the expression is a constant and 0. */
    bool
    is_zero() const;

  private:
    /** The function's value times @p factor; throws if it isn't finite. */
    double
    evaluate(const Point<3> &point, const double factor) const;

    std::string                        text_;
    std::string                        where_;
    std::string                        variables_;
    bool                               constant_ = true;
    double                             value_    = 0.;
    double                             factor_   = 1.;
    std::unique_ptr<FunctionParser<3>> function_;
  };

  /** Three expressions: the components of a vector along x, y, z. */
  class VectorExpression
  {
  public:
    /** Zero. */
    VectorExpression() = default;

    /** From "fx, fy, fz"; anything but three components throws. */
    VectorExpression(const std::string &text,
                     const std::string &where,
                     const Constants   &constants,
                     const std::string &variables = "x,y,z");

    Tensor<1, 3>
    operator()(const Point<3> &point) const;

    /** As Expression::set_time(). */
    void
    set_time(const double time, const double factor = 1.);

    bool
    is_zero() const;

  private:
    std::array<Expression, 3> components_;
  };

  /** A number given as an expression of constants, e.g. "R*cos(40*pi/180)". */
  double
  evaluate_number(const std::string &text,
                  const std::string &where,
                  const Constants   &constants);

  /** A point or vector "(a, b, c)", parentheses optional, of such numbers. */
  Point<3>
  evaluate_point(const std::string &text,
                 const std::string &where,
                 const Constants   &constants);

  /** "R = 25, a = 2*R": later constants may use earlier ones. */
  Constants
  parse_constants(const std::string &text, const std::string &where);
} // namespace Nacre

#endif
