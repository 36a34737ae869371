// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_results_table_h
#define nacre_postprocess_results_table_h

#include <nacre/base/types.h>

#include <deal.II/base/types.h>

#include <iosfwd>
#include <optional>
#include <vector>

namespace Nacre
{
  /**
   * The table of a study: one row for each solve.
   *
   * A quantity Q with a reference value R has a column of ratios Q/R. Where a
   * rate is wanted there is a column of observed rates
   *   log(e1/e2) / log(sqrt(N2/N1)),
   * with the numbers N of degrees of freedom of this row and of the one before
   * that has the same element, degree, eta and thickness; e is |Q/R - 1|, or
   * |Q| if there is no reference (Q is an error norm then). sqrt(1/N) is
   * proportional to the mesh size, so that this is the order in h.
   */
  class ResultsTable
  {
  public:
    struct Quantity
    {
      std::string name;
      /** The value to compare with; none for an error norm. */
      std::optional<double> reference;
      /** Whether there is a column of observed rates. */
      bool rate = false;
    };

    struct Row
    {
      std::string  element;
      unsigned int degree = 0;
      /** As the user gave it, e.g. "default" or "10". */
      std::string eta;
      /** As the user gave it; an expression if it varies. */
      std::string             thickness;
      types::global_dof_index cells = 0;
      types::global_dof_index dofs  = 0;
      /** In the order of the quantities. */
      std::vector<double> values;
      /**
       * References of this row in the order of the quantities, where they
       * differ from row to row (with the thickness); else empty.
       */
      std::vector<std::optional<double>> references;
      /** CPU seconds. */
      double setup_s    = 0.;
      double assembly_s = 0.;
      double solve_s    = 0.;
      /** The linear solver, and its iterations if it is an iterative one. */
      std::string  solver;
      unsigned int iterations = 0;
      /** Largest memory of all ranks together until now (GB). */
      double memory_gb = 0.;
      /** None if no error is estimated: then there is no such column. */
      std::optional<double> estimate_s;
    };

    /**
     * @p title is the caption of the .tex. Throws for a reference that is 0 or
     * not finite and for two quantities of one name.
     */
    explicit ResultsTable(const std::string           &title      = "",
                          const std::vector<Quantity> &quantities = {});

    void
    add_row(const Row &row);

    const std::vector<Row> &
    rows() const;

    /** Ratio Q/R of a quantity; NaN without a reference. */
    double
    ratio(const unsigned int row, const unsigned int quantity) const;

    /** Observed rate; NaN where there is none. */
    double
    rate(const unsigned int row, const unsigned int quantity) const;

    /**
     * Aligned columns, 6 significant digits.
     * @param with_seconds false leaves out what differs from run to run.
     */
    void
    write_text(std::ostream &out, const bool with_seconds = true) const;

    /**
     * The columns element, degree, eta, thickness, cells, dofs, the
     * quantities, `ratio` of the first quantity that has a reference,
     * `ratio_NAME` of the others, `rate_NAME`, setup_s, assembly_s, solve_s,
     * estimate_s where errors are estimated, solver, iterations, memory_gb; 12
     * significant
     * digits, nothing where there is no value.
     */
    void
    write_csv(std::ostream &out) const;

    /** A tabular with the rules of the package booktabs. */
    void
    write_tex(std::ostream &out) const;

    /**
     * Write @p base_name .txt, .csv and .tex, each as a whole or not at all.
     * Throws an ExcMessage that names the folder if it can't be written to.
     * For rank 0 only.
     */
    void
    write_files(const std::string &base_name) const;

  private:
    struct Column;

    std::optional<double>
    reference(const unsigned int row, const unsigned int quantity) const;

    bool
    has_reference(const unsigned int quantity) const;

    /** |Q/R - 1|, or |Q| without a reference. */
    double
    error(const unsigned int row, const unsigned int quantity) const;

    /** Columns of element to dofs. */
    std::vector<Column>
    leading_columns() const;

    std::vector<Column>
    quantity_columns(const int digits, const bool trailing_zeros) const;

    std::vector<Column>
    ratio_columns(const int digits, const bool csv_names) const;

    std::vector<Column>
    rate_columns(const int digits, const bool csv_names) const;

    std::vector<Column>
    seconds_columns(const bool csv) const;

    /** How the linear systems were solved. */
    std::vector<Column>
    solver_columns() const;

    /** Columns of the text and the .tex: each quantity with ratio and rate. */
    std::vector<Column>
    readable_columns(const bool with_seconds) const;

    std::string           title_;
    std::vector<Quantity> quantities_;
    std::vector<Row>      rows_;
  };
} // namespace Nacre

#endif
