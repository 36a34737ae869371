// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_convergence_study_h
#define nacre_simulation_convergence_study_h

#include <nacre/mechanics/shell_section.h>
#include <nacre/postprocess/quantities_of_interest.h>
#include <nacre/postprocess/results_table.h>
#include <nacre/postprocess/vtu_output.h>
#include <nacre/simulation/adaptive_refinement.h>
#include <nacre/simulation/checkpoint.h>
#include <nacre/simulation/shell_problem.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  class Log;

  /**
   * What a parameter file describes: a shell and the lists of degrees,
   * penalties, thicknesses and refinements for which it is solved.
   */
  class ConvergenceStudy : public ParameterAcceptor
  {
  public:
    explicit ConvergenceStudy(
      const MPI_Comm              communicator,
      std::unique_ptr<SectionLaw> section = std::make_unique<ShellSection>());

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
     * Solve all cases; writes the table after each of them, so that nothing is
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

    /** Read and check everything for one case. */
    void
    prepare_case(const ShellCase &shell_case);

    /** Folder and name of the output files, without their endings. */
    std::string
    base_name() const;

    /**
     * Make the folder, remove older results unless they are kept, write the
     * .used.prm.
     */
    void
    prepare_output(const bool keeps_results) const;

    void
    check_restart(const bool restart, const std::size_t n_cases) const;

    /**
     * Set up the case given to prepare_case(), and check the quantities on its
     * mesh.
     */
    void
    set_up_case(Log &log);

    /** What a case is called in names of files: p3_r2. */
    std::string
    label(const ShellCase &shell_case) const;

    /** Name of the files of a path: that of the study if it is the only one. */
    std::string
    path_name(const std::vector<ShellCase> &cases,
              const ShellCase              &shell_case) const;

    /** Folder and name of a path's files, without their endings. */
    std::string
    path_base(const std::string &name) const;

    /**
     * The state that a path begins with other than the undeformed shell: that
     * of the @p checkpoint at a restart, or the last one of another run.
     */
    std::optional<CheckpointData>
    load_state(const ProblemRecord &problem,
               const std::string   &base,
               const bool           restart,
               Checkpoint          &checkpoint,
               Log                 &log) const;

    /**
     * Follow the path of one case, which writes files of its own; returns what
     * it has written.
     */
    std::string
    follow_path(const std::string &name, const bool restart, Log &log);

    /**
     * Solve one case on its mesh and, with adaptive refinement, on refined
     * ones: a row, and fields, of each.
     * @param progress what the lines of progress begin with
     */
    void
    solve_cycles(const ShellCase   &shell_case,
                 const std::string &progress,
                 ResultsTable      &table,
                 VtuOutput         &vtu_output,
                 Log               &log);

    /**
     * Tell the table, what has been solved and written, a line for each of the
     * @p paths, and the number of warnings.
     */
    void
    print_results(const ResultsTable &table,
                  const std::string  &paths,
                  const unsigned int  n_warnings,
                  Log                &log) const;

    /** The row of the case just solved. */
    ResultsTable::Row
    make_row(const ShellCase &shell_case) const;

    /** Add the balance of forces of the case just solved, if asked for. */
    void
    add_balance();

    std::string
    progress_line(const ResultsTable::Row &row) const;

    VtuOutput::Options
    field_options() const;

    /** What follows the table of results. */
    std::string balances_;

    const MPI_Comm communicator_;
    Heading        heading_;

    std::string               name_;
    std::string               output_folder_ = "output";
    std::vector<unsigned int> degrees_       = {2};
    std::vector<std::string>  penalties_     = {"default"};
    std::vector<std::string>  thicknesses_;
    std::vector<unsigned int> refinements_    = {0};
    bool                      write_vtu_      = true;
    bool                      report_seconds_ = true;
    std::string               field_format_   = "vtu";
    unsigned int              ranks_per_file_ = 16;
    unsigned int              n_subdivisions_ = 0;

    ShellProblem         problem_;
    QuantitiesOfInterest quantities_;
    AdaptiveRefinement   adaptive_;
  };
} // namespace Nacre

#endif
