// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_expression_h
#define nacre_base_expression_h

#include <nacre/base/instant.h>
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
   * Thrown if the value of a user's expression is not finite. In a path this
   * may begin at some time: it ends the path, and earlier steps stay valid.
   */
  class ExcUndefinedValue : public StandardExceptions::ExcMessage
  {
  public:
    using StandardExceptions::ExcMessage::ExcMessage;
  };

  /**
   * A function of a point and of the time: a number, or a muParser expression
   * of a parameter file with named constants (and pi). Malformed text and
   * unknown names throw an ExcMessage, values that aren't finite an
   * ExcUndefinedValue: it names the parameter, the expression, the point and
   * the time. Copies share the parser.
   */
  class Expression
  {
  public:
    /** The constant @p value, for messages with the name @p where. */
    Expression(const double value = 0., const std::string &where = "");

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
    /** The value at @p point and @p time; throws if it isn't finite. */
    double
    operator()(const Point<3> &point, const double time = 0.) const
    {
      return (*this)(point, Instant{time, 1.});
    }

    /** The value at its time, times its factor; throws if it isn't finite. */
    double
    operator()(const Point<3> &point, const Instant &instant) const;

    /** The parameter that holds it, or a name, for messages. */
    const std::string &
    where() const
    {
      return where_;
    }

    /** Whether the text mentions none of the variables. */
    bool
    is_constant() const;

    /** Whether the expression is a constant and 0. */
    bool
    is_zero() const;

  private:
    std::string                        text_;
    std::string                        where_;
    std::string                        variables_;
    bool                               constant_ = true;
    double                             value_    = 0.;
    std::shared_ptr<FunctionParser<3>> function_;
  };

  /** Three expressions: the components of a vector along x, y, z. */
  class VectorExpression
  {
  public:
    /** The constant @p value. */
    VectorExpression(const Tensor<1, 3> &value = {})
      : components_{{value[0], value[1], value[2]}}
    {}

    /** From "fx, fy, fz"; anything but three components throws. */
    VectorExpression(const std::string &text,
                     const std::string &where,
                     const Constants   &constants,
                     const std::string &variables = "x,y,z");

    /** At @p point and @p time. */
    Tensor<1, 3>
    operator()(const Point<3> &point, const double time = 0.) const
    {
      return (*this)(point, Instant{time, 1.});
    }

    /** The value at its time, times its factor. */
    Tensor<1, 3>
    operator()(const Point<3> &point, const Instant &instant) const;

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
