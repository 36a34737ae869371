// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_parameter_input_h
#define nacre_base_parameter_input_h

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

/**
 * Reading and writing of parameter files. All functions work on
 * ParameterAcceptor::prm, that is on the parameters of all ParameterAcceptor
 * objects that exist when they are called.
 */
namespace Nacre
{
  /**
   * Give the parameters the values of @p file, then those of @p overrides,
   * each "Section/Subsection/Parameter=value".
   *
   * Throws an ExcMessage that names the file and line, or the override, for a
   * file that can't be read, a section or parameter that doesn't exist (with
   * the near names), a value that its parameter doesn't allow (with what it
   * allows), a missing 'end' and anything else that isn't in the format. Every
   * rank reads the file; all throw the same.
   */
  void
  read_parameters(const std::string              &file,
                  const std::vector<std::string> &overrides = {});

  /**
   * Write the parameters in use to @p file, such that running that file
   * repeats the run. For rank 0 only.
   */
  void
  write_used_parameters(const std::string &file);

  /** The texts of all parameters in use, by "Section/Subsection/Parameter". */
  std::map<std::string, std::string>
  parameter_values();

  /** A parameter file of all defaults, annotated with documentation. */
  void
  print_template(std::ostream &out);

  /**
   * The documentation of one parameter, as "Mid-surface/Surface", and the
   * values that it may have; the subsections of its section that are named as
   * such a value are listed with their parameters. A parameter that doesn't
   * exist throws.
   */
  void
  print_documentation(std::ostream &out, const std::string &parameter);
} // namespace Nacre

#endif
