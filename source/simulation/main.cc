// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/parameter_input.h>
#include <nacre/base/text.h>
#include <nacre/simulation/convergence_study.h>
#include <nacre/solvers/blas_check.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/thread_management.h>

#include <boost/program_options.hpp>

#ifdef __GLIBC__
#  include <malloc.h>
#endif

#include <csignal>
#include <cstdio>
#include <iostream>
#include <optional>

namespace
{
  namespace options = boost::program_options;

  constexpr int success     = 0;
  constexpr int usage_error = 2;

  /** The options of the command line that --help shows. */
  options::options_description
  visible_options()
  {
    options::options_description description("Options");
    description.add_options()(
      "set",
      options::value<std::vector<std::string>>()->composing()->value_name(
        "\"Section/Parameter=value\""),
      "another value than the file's; repeatable");
    description.add_options()("check",
                              "check the parameter file and all that a run "
                              "needs before it solves");
    description.add_options()("template",
                              "print a parameter file of all defaults, with "
                              "documentation and units");
    description.add_options()("list",
                              "list elements, membrane strains, surfaces, "
                              "conditions, loads and quantities");
    description.add_options()("restart",
                              "go on from the last checkpoint of a path");
    description.add_options()("quiet", "no lines of progress");
    description.add_options()("help", "print this");
    description.add_options()("version", "print the version");
    return description;
  }

  /** The command line, or nothing after telling what is wrong with it. */
  std::optional<options::variables_map>
  parse_command_line(const int argc, char **argv, std::ostream &errors)
  {
    const auto                   visible = visible_options();
    options::options_description all;
    all.add(visible).add_options()("file",
                                   options::value<std::vector<std::string>>());
    options::positional_options_description positional;
    positional.add("file", -1);
    const auto style =
      options::command_line_style::unix_style &
      ~static_cast<int>(options::command_line_style::allow_guessing);
    try
      {
        options::variables_map values;
        options::store(options::command_line_parser(argc, argv)
                         .options(all)
                         .positional(positional)
                         .style(style)
                         .run(),
                       values);
        options::notify(values);
        return values;
      }
    catch (const options::unknown_option &error)
      {
        std::vector<std::string> names;
        for (const auto &option : visible.options())
          names.push_back("--" + option->long_name());
        errors << "nacre: error: "
               << Nacre::Text::unknown_name("command line",
                                            "option",
                                            error.get_option_name(),
                                            names)
               << std::endl;
      }
    catch (const options::error &error)
      {
        errors << "nacre: error: command line: " << error.what()
               << ". See nacre --help." << std::endl;
      }
    return {};
  }

  void
  print_help(std::ostream &out)
  {
    out << "Usage: nacre [options] FILE.prm\n"
           "       mpirun -np 2 nacre [options] FILE.prm\n\n"
           "Computes the thin shells that FILE.prm describes.\n\n"
        << visible_options()
        << "\nExit code: 0 success, 1 an error, 2 a wrong command line.\n"
        << std::flush;
  }

  /** The parameters of which a user wants to know the choices. */
  void
  print_list(std::ostream &out)
  {
    for (const char *const parameter : {"Discretization/Element",
                                        "Discretization/Membrane strain",
                                        "Analysis/Type",
                                        "Analysis/Scheme",
                                        "Mid-surface/Surface",
                                        "Boundary conditions/Edges",
                                        "Boundary conditions/Points",
                                        "Loads/Edge forces",
                                        "Loads/Edge moments",
                                        "Loads/Lip forces",
                                        "Loads/Lip moments",
                                        "Loads/Lip pressures",
                                        "Loads/Point forces",
                                        "Quantities/Quantities"})
      {
        Nacre::print_documentation(out, parameter);
        out << std::endl;
      }
  }

  /** --help and its like, or a wrong command line: no file is run. */
  std::optional<int>
  answer_without_run(const options::variables_map &values,
                     std::ostream                 &out,
                     std::ostream                 &errors)
  {
    if (values.count("help") > 0)
      print_help(out);
    else if (values.count("version") > 0)
      out << "nacre " << NACRE_VERSION << " (deal.II "
          << DEAL_II_PACKAGE_VERSION << ')' << std::endl;
    else if (values.count("template") > 0)
      Nacre::print_template(out);
    else if (values.count("list") > 0)
      print_list(out);
    else
      {
        const auto n_files =
          values.count("file") == 0 ?
            0 :
            values["file"].as<std::vector<std::string>>().size();
        if (n_files == 1)
          return {};
        errors << "nacre: error: "
               << (n_files == 0 ? "no parameter file" :
                                  "more than one parameter file")
               << " is given. Usage: nacre [options] FILE.prm; see nacre "
                  "--help."
               << std::endl;
        return usage_error;
      }
    return success;
  }

  /**
   * SuperLU_DIST, which comes with Trilinos, tells the C library at its start
   * never to give freed memory back to the system: its defaults again, but for
   * arrays below 4 MB, whose pages are worth keeping.
   */
  void
  give_freed_memory_back()
  {
#ifdef __GLIBC__
    mallopt(M_MMAP_MAX, 65536);
    mallopt(M_MMAP_THRESHOLD, 4 << 20);
    mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
  }

  /**
   * A file that outgrows the limit of the shell (ulimit -f) is an error of
   * writing, as on a full disk, not the end without a word that the signal's
   * default would be.
   */
  void
  let_writing_fail()
  {
#ifdef SIGXFSZ
    std::signal(SIGXFSZ, SIG_IGN);
#endif
  }

  /** What the terminal hasn't taken, or a file in its place, is lost. */
  void
  check_standard_output()
  {
    std::cout.flush();
    // Other streams write to the same place.
    AssertThrow(std::cout.good() && std::ferror(stdout) == 0,
                dealii::ExcMessage("The standard output can't be written: is "
                                   "the disk full?"));
  }

  int
  run(const int argc, char **argv)
  {
    const MPI_Comm communicator = MPI_COMM_WORLD;
    // Writing to a stream without a buffer does nothing: the other ranks.
    const bool root =
      dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    std::ostream out(root ? std::cout.rdbuf() : nullptr);
    std::ostream errors(root ? std::cerr.rdbuf() : nullptr);

    const auto values = parse_command_line(argc, argv, errors);
    if (!values)
      return usage_error;

    // Its members declare their parameters.
    Nacre::ConvergenceStudy study(communicator);
    if (const auto code = answer_without_run(*values, out, errors))
      return *code;

    const auto file = (*values)["file"].as<std::vector<std::string>>().front();
    std::vector<std::string> overrides;
    if (values->count("set") > 0)
      overrides = (*values)["set"].as<std::vector<std::string>>();
    Nacre::read_parameters(file, overrides);
    study.prepare(file);
    const bool restart    = values->count("restart") > 0;
    const bool only_check = values->count("check") > 0;
    Nacre::Log log(communicator, only_check || values->count("quiet") > 0);
    for (const std::string &note : study.notes())
      log.note(note);
    if (only_check)
      {
        study.check(log, restart);
        out << file << ": no errors." << std::endl;
        return success;
      }
    const auto complaint =
      Nacre::BlasCheck::complaint(Nacre::BlasCheck::kernel(),
                                  Nacre::BlasCheck::processor());
    if (!complaint.empty())
      log.warning(complaint);
    study.run(log, restart);
    return success;
  }
} // namespace


int
main(int argc, char **argv)
{
  give_freed_memory_back();
  let_writing_fail();
  // One thread for each rank.
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  // The library of threads reads the process' memory map at its first task:
  // part of the start, not of the first case.
  dealii::Threads::new_task([]() {}).join();
  return Nacre::run_guarded(MPI_COMM_WORLD, [&]() {
    const int code = run(argc, argv);
    check_standard_output();
    return code;
  });
}
