// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_recorder_h
#define nacre_simulation_recorder_h

#include <nacre/postprocess/quantities_of_interest.h>
#include <nacre/postprocess/results_table.h>
#include <nacre/simulation/output_options.h>
#include <nacre/simulation/shell_problem.h>

#include <string>
#include <vector>

namespace Nacre
{
  class Log;

  /** What a solve took. */
  struct SolveRecord
  {
    /** @name CPU seconds, summed over the ranks */
    //@{
    double setup    = 0.;
    double assembly = 0.;
    double solve    = 0.;
    //@}
    /** The linear solver, and its iterations in all. */
    std::string  solver;
    unsigned int n_iterations = 0;
    /** The largest eta taken (1). */
    double eta = 0.;
  };

  /** @p number with so many significant digits at most. */
  std::string
  in_text(const double number, const int n_digits);

  /**
   * Takes what the analyses of a study find: a row of the table for each
   * solution, its fields, its balance of forces, a line of progress; and tells
   * at the end what has been solved and written.
   */
  class Recorder
  {
  public:
    /** What files of a study's case are called, and how far the study is. */
    struct CaseNames
    {
      /** "p3_r2": of the files of its fields. */
      std::string label;
      /** The name of files of its own, as of a path. */
      std::string own_name;
      /** What its lines of progress begin with. */
      std::string progress;
    };

    using Columns = std::vector<ResultsTable::Quantity>;

    /** @param columns of the table, the quantities and what follows them */
    Recorder(const MPI_Comm              communicator,
             const OutputOptions        &options,
             const std::string          &title,
             const Columns              &columns,
             const QuantitiesOfInterest &quantities,
             Log                        &log);

    /**
     * Make the folder, remove older results unless they are kept, write the
     * .used.prm. Collective.
     */
    void
    start_files(const bool keeps_results) const;

    /** All that follows is of the case of @p problem. */
    void
    begin_case(const ShellProblem &problem, const CaseNames &names);

    /** Throw for a quantity that @p mesh can't have. Collective. */
    void
    check_quantities(const Discretization &mesh) const;

    /** The row of a solution, with the quantities. Collective. */
    ResultsTable::Row
    make_row(const SolvedShell &shell, const SolveRecord &record) const;

    /**
     * Add a row, which is written at once, so that nothing is lost if what
     * comes fails. Collective.
     * @param note begins the line of progress
     * @param shows_imbalance whether that tells how unequal the ranks' parts
     *   of the mesh are
     */
    void
    add(const ResultsTable::Row &row,
        const SolvedShell       &shell,
        const SolveRecord       &record,
        const std::string       &note            = "",
        const bool               shows_imbalance = false);

    /**
     * Write the fields of the row added last. Collective.
     * @param ending what their names end with
     * @param indicators of the error, by active cell index; may be empty
     */
    void
    write_fields(const SolvedShell         &shell,
                 const std::string         &ending,
                 const std::vector<double> &indicators);

    /** A line for the end that tells what the case has written by itself. */
    void
    add_summary(const std::string &summary)
    {
      summaries_ += summary + '\n';
    }

    /**
     * Tell the table, what has been solved and written, and the number of
     * warnings.
     * @param what is solved in a case, in the singular
     * @param pattern of the names of fields, after the study's
     */
    void
    print_results(const std::string &what, const std::string &pattern) const;

    /** @name For files that a case writes by itself */
    //@{
    const OutputOptions &
    options() const
    {
      return options_;
    }

    const CaseNames &
    names() const
    {
      return names_;
    }

    const QuantitiesOfInterest &
    quantities() const
    {
      return quantities_;
    }
    //@}

  private:
    void
    add_balance(const SolvedShell &shell);

    std::string
    progress_line(const ResultsTable::Row &row,
                  const SolvedShell       &shell,
                  const SolveRecord       &record,
                  const bool               shows_imbalance) const;

    const MPI_Comm              communicator_;
    const OutputOptions         options_;
    const std::string           title_;
    ResultsTable                table_;
    const QuantitiesOfInterest &quantities_;
    Log                        &log_;
    const unsigned int          n_warnings_before_;
    VtuOutput                   vtu_output_;
    bool                        has_fields_ = false;
    /** What follows the table. */
    std::string balances_;
    std::string summaries_;

    const ShellProblem *problem_ = nullptr;
    CaseNames           names_;
  };
} // namespace Nacre

#endif
