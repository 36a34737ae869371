// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/simulation/analysis.h>
#include <nacre/simulation/convergence_study.h>

#include <filesystem>
#include <utility>

namespace Nacre
{
  ConvergenceStudy::Heading::Heading()
    : ParameterAcceptor("/")
  {
    add_parameter("Title", title, "What the file computes; for the tables.");
    add_parameter("Constants",
                  constants,
                  "Named numbers for all expressions: 'R = 25, L = 2*R'. pi, "
                  "and E, nu, h of the section where they are numbers, are "
                  "known as well.");
  }

  ConvergenceStudy::ConvergenceStudy(const MPI_Comm communicator,
                                     std::unique_ptr<SectionParameters> section)
    : ParameterAcceptor("/Study")
    , communicator_(communicator)
    , problem_parameters_(std::move(section))
  {
    add_parameter("Name",
                  output_.name,
                  "Name of the output files; by default that of the .prm.");
    add_parameter("Output folder",
                  output_.folder,
                  "Made if it doesn't exist; a relative path starts from the "
                  "current folder.");
    add_parameter("Degrees",
                  degrees_,
                  "Degrees p of the element, from 2 to 5. Units: none.",
                  prm,
                  Patterns::List(Patterns::Integer(2, 5), 1));
    add_parameter("Penalties",
                  penalties_,
                  "Values of eta, the penalty (15); 'default': twice the bound "
                  "of each cell. Units: none.");
    add_parameter("Thicknesses",
                  thicknesses_,
                  "Thicknesses, expressions of constants; none: "
                  "'Section/Thickness'. Units: length.");
    add_parameter("Refinements",
                  refinements_,
                  "Global refinements of the coarse mesh; each quarters the "
                  "cells. Units: none.",
                  prm,
                  Patterns::List(Patterns::Integer(0, 12), 1));
    add_parameter("Write VTU",
                  output_.write_vtu,
                  "Write the fields of every case for ParaView.");
    add_parameter("Output format",
                  output_.fields.format,
                  "Files of the fields. vtu: higher-order cells, a .pvd lists "
                  "all times; hdf5: linear cells, one file for any number of "
                  "ranks, an .xdmf lists all times.");
    add_parameter("Ranks per VTU file",
                  output_.fields.ranks_per_file,
                  "The cells of so many ranks share a .vtu; if it takes more "
                  "than one, a .pvtu lists them. Units: none.",
                  prm,
                  Patterns::Integer(1));
    add_parameter("Output subdivisions",
                  output_.fields.n_subdivisions,
                  "Parts of each edge of quadrilaterals in the fields: points "
                  "(vtu) or linear cells (hdf5), up to 10; 0: the degree p. "
                  "Units: none.",
                  prm,
                  Patterns::Integer(0, 10));
    add_parameter("Thick output",
                  output_.fields.thick,
                  "Whether each .vtu has a companion NAME_thick_LABEL.vtu: the "
                  "shell as a body, from the bottom to the top, with its "
                  "stresses, ply by ply in laminates.");
    add_parameter("Report seconds",
                  output_.report_seconds,
                  "Whether the terminal shows CPU seconds; without them the "
                  "output is the same from run to run. The .csv has them.");
  }

  ConvergenceStudy::~ConvergenceStudy() = default;

  void
  ConvergenceStudy::check_lists() const
  {
    AssertThrow(!penalties_.empty(),
                ExcMessage("Study/Penalties: give 'default' or a number."));
    AssertThrow(!output_.name.empty() &&
                  output_.name.find('/') == std::string::npos,
                ExcMessage("Study/Name: '" + output_.name +
                           "' is no file name; use 'Output folder' for the "
                           "folder."));
  }

  std::vector<ShellCase>
  ConvergenceStudy::make_cases() const
  {
    const auto constants = parse_constants(heading_.constants, "Constants");

    std::vector<std::optional<double>> thicknesses, penalties;
    for (const auto &text : thicknesses_)
      {
        thicknesses.emplace_back(
          evaluate_number(text, "Study/Thicknesses", constants));
        AssertThrow(*thicknesses.back() > 0.,
                    ExcMessage("Study/Thicknesses: '" + text +
                               "' is not positive."));
      }
    if (thicknesses.empty())
      thicknesses.emplace_back();
    for (const auto &text : penalties_)
      if (text == "default")
        penalties.emplace_back();
      else
        {
          penalties.emplace_back(
            evaluate_number(text,
                            "Study/Penalties, 'default' or a number",
                            constants));
          AssertThrow(*penalties.back() > 0.,
                      ExcMessage("Study/Penalties: eta = '" + text +
                                 "' is not positive."));
        }

    std::vector<ShellCase> cases;
    for (const auto &thickness : thicknesses)
      for (const auto &eta : penalties)
        for (const auto degree : degrees_)
          for (const auto n_refinements : refinements_)
            cases.push_back({degree, n_refinements, eta, thickness});
    return cases;
  }

  void
  ConvergenceStudy::prepare(const std::string &prm_file)
  {
    if (output_.name.empty())
      {
        std::filesystem::path path = std::filesystem::path(prm_file).stem();
        if (path.extension() == ".used")
          path = path.stem();
        output_.name = path.string();
      }
    check_lists();
    problem_parameters_.set_files(
      communicator_,
      std::filesystem::path(prm_file).parent_path().string());
    for (const auto &shell_case : make_cases())
      prepare_case(shell_case);
  }

  void
  ConvergenceStudy::prepare_case(const ShellCase &shell_case)
  {
    std::optional<Midsurface> midsurface;
    if (problem_)
      midsurface.emplace(std::move(problem_->model.midsurface));
    problem_.reset();
    problem_.emplace(
      problem_parameters_.make(parse_constants(heading_.constants, "Constants"),
                               shell_case,
                               std::move(midsurface)));
    quantities_ = quantity_parameters_.make(problem_->model.midsurface,
                                            problem_->model.cuts,
                                            problem_->model.exact_solution,
                                            *problem_->model.section,
                                            problem_->constants);
    adaptive_   = adaptive_parameters_.make(*problem_, quantities_);
  }

  std::vector<std::string>
  ConvergenceStudy::notes() const
  {
    return problem_->model.midsurface.notes();
  }

  void
  ConvergenceStudy::for_each_case(const std::function<void(Analysis &)> &work,
                                  Recorder  &recorder,
                                  const bool restart,
                                  Log       &log)
  {
    const auto cases = make_cases();
    for (unsigned int k = 0; k < cases.size(); ++k)
      {
        prepare_case(cases[k]);
        const auto analysis =
          make_analysis(communicator_, *problem_, adaptive_, log);
        AssertThrow(!restart || (cases.size() == 1 && analysis->can_restart()),
                    ExcMessage("--restart: only a study of one case with an "
                               "'Analysis/Type' other than linear can go on; "
                               "this one has " +
                               std::to_string(cases.size()) + "."));
        const std::string name = label(cases[k]);
        recorder.begin_case(*problem_,
                            {name,
                             cases.size() == 1 ? output_.name :
                                                 output_.name + "_" + name,
                             '[' + std::to_string(k + 1) + '/' +
                               std::to_string(cases.size()) + "] "});
        work(*analysis);
      }
  }

  void
  ConvergenceStudy::check(Log &log, const bool restart)
  {
    Recorder recorder = make_recorder(log);
    for_each_case([&](
                    Analysis &analysis) { analysis.check(recorder, restart); },
                  recorder,
                  restart,
                  log);
  }

  void
  ConvergenceStudy::run(Log &log, const bool restart)
  {
    Recorder    recorder = make_recorder(log);
    std::string what;
    const auto  run_case = [&](Analysis &analysis) {
      // An analysis that goes on says itself when the old files may change.
      if (what.empty() && !restart)
        recorder.start_files(false);
      what = analysis.name();
      analysis.run(recorder, restart);
    };
    for_each_case(run_case, recorder, restart, log);
    recorder.print_results(what, label_pattern());
  }

  Recorder
  ConvergenceStudy::make_recorder(Log &log) const
  {
    Recorder::Columns columns;
    for (const auto &quantity : quantities_.quantities())
      columns.push_back({quantity.name,
                         quantity.reference,
                         quantity.is_error || quantity.reference.has_value()});
    for (const auto &column : adaptive_.columns(problem_->model.exact_solution))
      columns.push_back(column);
    return Recorder(communicator_,
                    output_,
                    heading_.title,
                    columns,
                    quantities_,
                    log);
  }

  std::string
  ConvergenceStudy::label(const ShellCase &shell_case) const
  {
    std::string text = "p" + std::to_string(shell_case.degree) + "_r" +
                       std::to_string(shell_case.n_refinements);
    if (thicknesses_.size() > 1)
      text += "_h" + in_text(*shell_case.thickness, 6);
    if (penalties_.size() > 1)
      text +=
        "_eta" + (shell_case.eta ? in_text(*shell_case.eta, 4) : "default");
    return text;
  }

  std::string
  ConvergenceStudy::label_pattern() const
  {
    return std::string("_pP_rR") + (thicknesses_.size() > 1 ? "_hH" : "") +
           (penalties_.size() > 1 ? "_etaETA" : "") +
           (adaptive_.is_on() ? "_cCYCLE" : "");
  }
} // namespace Nacre
