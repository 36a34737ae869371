// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/expression.h>
#include <nacre/base/text.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <sstream>

namespace Nacre
{
  namespace
  {
    /** Prefix of the names that fill up the parser's three variables. */
    const std::string unused_variable = "nacre_unused_";

    bool
    is_digit(const char c)
    {
      return std::isdigit(static_cast<unsigned char>(c)) != 0;
    }

    bool
    begins_name(const char c)
    {
      return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
    }

    bool
    continues_name(const char c)
    {
      return begins_name(c) || is_digit(c);
    }

    bool
    contains(const std::vector<std::string> &names, const std::string &name)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }

    /** The names in @p text; the e of 1e-3 isn't one. */
    std::vector<std::string>
    names_in(const std::string &text)
    {
      std::vector<std::string> names;
      const std::size_t        n = text.size();
      for (std::size_t i = 0; i < n;)
        {
          const std::size_t begin = i;
          if (begins_name(text[i]))
            {
              while (i < n && continues_name(text[i]))
                ++i;
              names.push_back(text.substr(begin, i - begin));
            }
          else if (is_digit(text[i]) || text[i] == '.')
            {
              while (i < n && (is_digit(text[i]) || text[i] == '.'))
                ++i;
              if (i < n && (text[i] == 'e' || text[i] == 'E'))
                {
                  std::size_t j = i + 1;
                  if (j < n && (text[j] == '+' || text[j] == '-'))
                    ++j;
                  if (j < n && is_digit(text[j]))
                    for (i = j; i < n && is_digit(text[i]);)
                      ++i;
                }
            }
          else
            ++i;
        }
      return names;
    }

    std::string
    quote(const std::string &where, const std::string &text)
    {
      return where + ": '" + text + "'";
    }

    /** While it lives, nothing reaches std::cerr, where deal.II reports. */
    class SilentErrors
    {
    public:
      SilentErrors()
        : old_(std::cerr.rdbuf(ignored_.rdbuf()))
      {}

      ~SilentErrors()
      {
        std::cerr.rdbuf(old_);
      }

      SilentErrors(const SilentErrors &) = delete;
      SilentErrors &
      operator=(const SilentErrors &) = delete;

    private:
      std::ostringstream ignored_;
      std::streambuf    *old_;
    };

    /** What the parser said, without deal.II's frame. */
    std::string
    parser_message(const ExceptionBase &exception)
    {
      std::ostringstream out;
      exception.print_info(out);
      const std::string info = Text::trim(out.str());
      const std::string mark = "The parser said: ";
      const auto        pos  = info.find(mark);
      std::string       message =
        pos == std::string::npos ? info : info.substr(pos + mark.size());
      while (!message.empty() && message.back() == '.')
        message.pop_back();
      return message;
    }

    /** Names of functions whose values don't differ from call to call. */
    std::vector<std::string>
    function_names()
    {
      std::vector<std::string> names =
        dealii::internal::FunctionParser::get_function_names();
      names.erase(std::remove_if(names.begin(),
                                 names.end(),
                                 [](const std::string &name) {
                                   return name.rfind("rand", 0) == 0;
                                 }),
                  names.end());
      return names;
    }

    /**
     * The first name in @p text that the parser doesn't know, explained, or
     * "". Of the many functions only the near ones are listed.
     */
    std::string
    explain_unknown_name(const std::string              &text,
                         const std::string              &message,
                         const Constants                &constants,
                         const std::vector<std::string> &variables)
    {
      std::vector<std::string> known = variables;
      for (const auto &constant : constants)
        known.push_back(constant.first);
      const auto functions = function_names();
      for (const auto &name : names_in(text))
        if (!contains(known, name) && !contains(functions, name))
          {
            for (const auto &near : Text::nearest(name, functions))
              known.push_back(near);
            return Text::unknown_name(message, "name", name, known);
          }
      return "";
    }

    /** Text that the parser takes without complaint but not as one value. */
    void
    check_one_value(const std::string &text, const std::string &where)
    {
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          if (text[i] != '=')
            continue;
          const bool comparison =
            (i > 0 &&
             std::string("=<>!").find(text[i - 1]) != std::string::npos) ||
            (i + 1 < text.size() && text[i + 1] == '=');
          AssertThrow(comparison,
                      ExcMessage(quote(where, text) +
                                 " assigns a value with '='; an expression "
                                 "is expected."));
        }
      const auto n = Text::split(text, ',', where).size();
      AssertThrow(n == 1,
                  ExcMessage(quote(where, text) + " has " + std::to_string(n) +
                             " values separated by commas; one expression is "
                             "expected."));
      for (const auto &name : names_in(text))
        AssertThrow(name != "rand" && name != "rand_seed",
                    ExcMessage(quote(where, text) +
                               ": random numbers would differ between ranks; "
                               "rand isn't allowed."));
    }

    /** " at x = 1, y = 2, t = 3" of the variables that there are. */
    std::string
    describe_point(const Point<3>    &point,
                   const double       time,
                   const std::string &variables)
    {
      std::ostringstream out;
      unsigned int       c = 0;
      for (const auto &name : Text::split(variables, ',', "Variables"))
        {
          out << (c == 0 ? " at " : ", ") << name << " = "
              << (c < 3 ? point[c] : time);
          ++c;
        }
      return out.str();
    }

    std::string
    not_finite(const std::string &where,
               const std::string &text,
               const double       value)
    {
      return quote(where, text) + " is " +
             (std::isnan(value) ? "not a number" : "infinite");
    }

    /** The parts of "a, b, c", parentheses around all of it optional. */
    std::vector<std::string>
    components_of(const std::string &text, const std::string &where)
    {
      const std::string given = Text::trim(text);
      auto              parts = Text::split(given, ',', where);
      // "(a, b, c)" is one part at first.
      if (parts.size() == 1 && given.front() == '(' && given.back() == ')')
        parts = Text::split(given.substr(1, given.size() - 2), ',', where);
      return parts;
    }

    std::vector<std::string>
    filled_up(std::vector<std::string> variables)
    {
      AssertThrow(variables.size() <= 4,
                  ExcMessage("An Expression has at most three coordinates and "
                             "the time."));
      while (variables.size() < 3)
        variables.push_back(unused_variable + std::to_string(variables.size()));
      return variables;
    }

    /** Parse and evaluate once; explain what the parser rejects. */
    double
    compile(FunctionParser<3>              &function,
            const std::string              &text,
            const std::string              &where,
            const Constants                &constants,
            const std::vector<std::string> &variables)
    {
      const auto all = filled_up(variables);
      // The parser's own exception for this is no std::exception.
      for (const auto &variable : all)
        AssertThrow(constants.count(variable) == 0,
                    ExcMessage(
                      where + ": '" + variable + "' is " +
                      (&variable == &all[0] + 3 ? "the time" : "a coordinate") +
                      " and can't be a constant."));
      try
        {
          const SilentErrors silent;
          std::string        names;
          for (const auto &variable : all)
            names += (names.empty() ? "" : ",") + variable;
          function.initialize(names,
                              std::vector<std::string>{text},
                              constants,
                              all.size() == 4);
          // initialize() doesn't parse yet. The value at this point, with
          // nothing special about it, counts only for constants.
          return function.value(Point<3>(0.31371, 0.27183, 0.41421));
        }
      catch (const ExceptionBase &exception)
        {
          const std::string message =
            quote(where, text) +
            " is not a valid expression: " + parser_message(exception);
          const std::string more =
            explain_unknown_name(text, message, constants, variables);
          AssertThrow(false, ExcMessage(more.empty() ? message + "." : more));
          return 0.;
        }
    }
  } // namespace


  Expression::Expression(const double value, const std::string &where)
    : where_(where)
    , value_(value)
  {}


  Expression::Expression(const std::string &text,
                         const std::string &where,
                         const Constants   &constants,
                         const std::string &variables)
    : text_(Text::trim(text))
    , where_(where)
    , variables_(variables)
  {
    AssertThrow(!text_.empty(),
                ExcMessage(where_ + " is empty; a number or an expression is "
                                    "expected."));
    const auto variable_names = Text::split(variables, ',', where_);
    auto       all_constants  = constants;
    all_constants["pi"]       = numbers::PI;

    auto function = std::make_shared<FunctionParser<3>>();
    value_ = compile(*function, text_, where_, all_constants, variable_names);
    check_one_value(text_, where_);

    const auto names = names_in(text_);
    constant_        = std::none_of(variable_names.begin(),
                             variable_names.end(),
                             [&](const std::string &variable) {
                               return contains(names, variable);
                             });
    AssertThrow(!constant_ || std::isfinite(value_),
                ExcMessage(not_finite(where_, text_, value_) +
                           "; it must be finite."));
    if (!constant_)
      function_ = std::move(function);
  }


  double
  Expression::operator()(const Point<3> &point, const Instant &instant) const
  {
    if (constant_)
      return instant.factor * value_;
    function_->set_time(instant.time);
    const double value = instant.factor * function_->value(point);
    AssertThrow(std::isfinite(value),
                ExcUndefinedValue(
                  not_finite(where_, text_, value) +
                  describe_point(point, instant.time, variables_) +
                  "; it must be finite."));
    return value;
  }


  bool
  Expression::is_constant() const
  {
    return constant_;
  }


  bool
  Expression::is_zero() const
  {
    return constant_ && value_ == 0.;
  }


  VectorExpression::VectorExpression(const std::string &text,
                                     const std::string &where,
                                     const Constants   &constants,
                                     const std::string &variables)
  {
    const auto parts = components_of(text, where);
    AssertThrow(parts.size() == 3,
                ExcMessage(quote(where, Text::trim(text)) + " has " +
                           std::to_string(parts.size()) +
                           " components; three are expected, along x, y, z: "
                           "'fx, fy, fz'."));
    const char *const axes[] = {" (x)", " (y)", " (z)"};
    for (unsigned int c = 0; c < 3; ++c)
      components_[c] =
        Expression(parts[c], where + axes[c], constants, variables);
  }


  Tensor<1, 3>
  VectorExpression::operator()(const Point<3> &point,
                               const Instant  &instant) const
  {
    Tensor<1, 3> value;
    for (unsigned int c = 0; c < 3; ++c)
      value[c] = components_[c](point, instant);
    return value;
  }


  bool
  VectorExpression::is_zero() const
  {
    return std::all_of(components_.begin(),
                       components_.end(),
                       [](const Expression &component) {
                         return component.is_zero();
                       });
  }


  double
  evaluate_number(const std::string &text,
                  const std::string &where,
                  const Constants   &constants)
  {
    return Expression(text, where, constants, "")(Point<3>());
  }


  Point<3>
  evaluate_point(const std::string &text,
                 const std::string &where,
                 const Constants   &constants)
  {
    const auto parts = components_of(text, where);
    AssertThrow(parts.size() == 3,
                ExcMessage(quote(where, Text::trim(text)) + " has " +
                           std::to_string(parts.size()) +
                           " components; a point is '(x, y, z)'."));
    Point<3> point;
    for (unsigned int c = 0; c < 3; ++c)
      point[c] = evaluate_number(parts[c], where, constants);
    return point;
  }


  Constants
  parse_constants(const std::string &text, const std::string &where)
  {
    const std::vector<std::string> coordinates = {"x", "y", "z", "u", "v"};
    const auto                     functions   = function_names();
    Constants                      constants;
    for (const auto &part : Text::split(text, ',', where))
      {
        const auto [name, value] = Text::key_and_value(part);
        AssertThrow(!value.empty(),
                    ExcMessage(quote(where, part) +
                               " has no value; 'name = value' is expected."));
        const bool is_name =
          !name.empty() && begins_name(name[0]) &&
          std::all_of(name.begin(), name.end(), continues_name);
        AssertThrow(is_name,
                    ExcMessage(where + ": '" + name +
                               "' can't be the name of a constant; a letter "
                               "followed by letters, digits and '_' is "
                               "expected."));
        const char *const reason =
          name == "pi"                ? "pi is 3.14159... already" :
          contains(coordinates, name) ? "it is a coordinate" :
          contains(functions, name)   ? "it is a function" :
          constants.count(name) != 0  ? "it has been defined before" :
                                        nullptr;
        AssertThrow(reason == nullptr,
                    ExcMessage(where + ": '" + name +
                               "' can't be the name of a constant: " + reason +
                               "."));
        constants[name] = evaluate_number(value, where + "/" + name, constants);
      }
    return constants;
  }
} // namespace Nacre
