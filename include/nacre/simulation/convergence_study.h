// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_convergence_study_h
#define nacre_simulation_convergence_study_h

#include <nacre/mechanics/shell_section.h>
#include <nacre/postprocess/quantities_of_interest.h>
#include <nacre/simulation/adaptive_refinement.h>
#include <nacre/simulation/recorder.h>
#include <nacre/simulation/shell_problem.h>

#include <deal.II/base/parameter_acceptor.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  class Analysis;
  class Log;

  /**
   * What a parameter file describes: a shell and the lists of degrees,
   * penalties, thicknesses and refinements for which it is solved.
   */
  class ConvergenceStudy : public ParameterAcceptor
  {
  public:
    explicit ConvergenceStudy(const MPI_Comm                     communicator,
                              std::unique_ptr<SectionParameters> section =
                                std::make_unique<ShellSectionParameters>());
    ~ConvergenceStudy() override;

    /**
     * Check the parameters, read before, against each other for every case;
     * throws ExcMessage.
     * @param prm_file the file they come from: its name is the default name
     */
    void
    prepare(const std::string &prm_file);

    /** What a user may want to know about the input, a sentence each. */
    std::vector<std::string>
    notes() const;

    /**
     * Check all cases as far as that goes without solving one: what run() would
     * complain of before its first solve; throws ExcMessage. Collective.
     */
    void
    check(Log &log, const bool restart);

    /**
     * Solve all cases; writes the table after each solution, so that nothing is
     * lost if one fails.
     * @param restart whether to go on from the checkpoint of a path
     */
    void
    run(Log &log, const bool restart = false);

  private:
    /** The part of the file outside all sections. */
    class Heading : public ParameterAcceptor
    {
    public:
      Heading();
      std::string title     = "";
      std::string constants = "";
    };

    void
    check_lists() const;

    /** All combinations: thickness, penalty, degree, refinement. */
    std::vector<ShellCase>
    make_cases() const;

    /** Read and check everything for one case: problem_ and its quantities. */
    void
    prepare_case(const ShellCase &shell_case);

    /** Call @p work for the analysis of each case. */
    void
    for_each_case(const std::function<void(Analysis &)> &work,
                  Recorder                              &recorder,
                  const bool                             restart,
                  Log                                   &log);

    Recorder
    make_recorder(Log &log) const;

    /** What a case is called in names of files: p3_r2. */
    std::string
    label(const ShellCase &shell_case) const;

    /** How the names of fields follow from those of the cases. */
    std::string
    label_pattern() const;

    const MPI_Comm communicator_;
    Heading        heading_;

    OutputOptions             output_;
    std::vector<unsigned int> degrees_   = {2};
    std::vector<std::string>  penalties_ = {"default"};
    std::vector<std::string>  thicknesses_;
    std::vector<unsigned int> refinements_ = {0};

    ProblemParameters            problem_parameters_;
    QuantityParameters           quantity_parameters_;
    AdaptiveRefinementParameters adaptive_parameters_;
    /** Of the case prepared last. */
    std::optional<ShellProblem> problem_;
    QuantitiesOfInterest        quantities_;
    AdaptiveRefinement          adaptive_;
  };
} // namespace Nacre

#endif
