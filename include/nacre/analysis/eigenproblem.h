// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_eigenproblem_h
#define nacre_analysis_eigenproblem_h

#include <nacre/solvers/direct_solver.h>
#include <nacre/solvers/eigensolver.h>

#include <deal.II/base/index_set.h>

#include <optional>
#include <utility>
#include <vector>

namespace Nacre
{
  /** Eigenvalues in ascending order with their modes, and what they took. */
  struct Spectrum
  {
    using Vector = TrilinosWrappers::MPI::Vector;

    std::vector<double> values;
    /** Without ghosts, zero where constrained; x . B x = 1. */
    std::vector<Vector> modes;
    /** Eigenvalues below the first one, which weren't asked for. */
    unsigned int n_below = 0;
    /** The interval in which the pivots have counted as many as were found. */
    std::pair<double, double> counted;
    /** How many the first search had missed. */
    unsigned int n_missed = 0;
  };

  /**
   * The symmetric generalised eigenproblem K x = lambda M x on the dofs that
   * no constraint eliminates. Either M is positive definite, as a mass is, or
   * K is; the definite one is the inner product B.
   *
   * A search takes the factors of K - sigma M at a shift sigma below the
   * eigenvalues wanted, whose map (K - sigma M)^{-1} M has the eigenvalues
   * 1/(lambda - sigma). Then the factors at a shift above the last one count:
   * by Sylvester's law of inertia their negative pivots are the eigenvalues
   * below the shift (between 0 and the shift if only K is definite). If
   * fewer were found, the rest is sought from there, orthogonal to what is
   * known, and counted again.
   */
  class Eigenproblem
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;
    using Matrix = TrilinosWrappers::SparseMatrix;

    /**
     * Both matrices of one pattern, with the constraints eliminated: rows of
     * constrained dofs hold a positive diagonal in K and nothing in M. They
     * must live as long.
     * @param free the unconstrained dofs of this rank
     */
    Eigenproblem(const Matrix   &stiffness,
                 const Matrix   &mass,
                 const bool      mass_is_definite,
                 const IndexSet &free);

    /** Number of unconstrained dofs. */
    types::global_dof_index
    n_free() const
    {
      return n_free_;
    }

    /**
     * The @p n_wanted lowest eigenvalues above @p shift, or fewer if there are
     * no more, and all up to the next gap that is wider than the relative
     * @p tolerance; maybe some more. Throws if K - shift M is singular, or if
     * some can't be found. If only K is definite the shift isn't negative.
     * @param upper if given, those below only
     */
    Spectrum
    find_above(const double                 shift,
               const unsigned int           n_wanted,
               const std::optional<double> &upper,
               const double                 tolerance);

    /**
     * Negative pivots of K - shift M: the number of eigenvalues below the
     * shift. Changes @p shift a little if it is an eigenvalue itself.
     */
    unsigned int
    count_below(double &shift);

    /** The same; nothing if K - shift M is singular. */
    std::optional<unsigned int>
    try_count_below(const double shift);

    /** @name Of all searches so far */
    //@{
    unsigned int
    n_factorisations() const
    {
      return n_factorisations_;
    }

    unsigned int
    n_substitutions() const
    {
      return n_substitutions_;
    }
    //@}

  private:
    /** @p n eigenvalues next to the factors' shift, above or below it. */
    Eigenpairs
    search(const unsigned int         n,
           const bool                 above,
           const std::vector<Vector> &known);

    /** Add to @p spectrum, in order, what lies in the open interval. */
    static void
    add_pairs(Eigenpairs                     &&pairs,
              const double                     shift,
              const std::pair<double, double> &interval,
              Spectrum                        &spectrum);

    /**
     * A shift in the first gap above @p n_wanted of the ascending @p values,
     * or above all if there can't be more; none if there is no gap yet.
     */
    static std::optional<double>
    place_to_count(const std::vector<double> &values,
                   const unsigned int         n_wanted,
                   const unsigned int         n_most,
                   const double               tolerance);

    /** Count up to @p top, and seek what the search has missed. */
    void
    complete(const double shift, double top, Spectrum &spectrum);

    std::vector<Vector>
    start_block(const unsigned int n) const;

    const Matrix                 &stiffness_;
    const Matrix                 &mass_;
    const Matrix                 &inner_product_;
    const IndexSet                free_;
    const types::global_dof_index n_free_;
    Matrix                        shifted_;
    DirectSolver                  solver_;
    /** Of the factors, if there are any. */
    std::optional<double> factor_shift_;
    unsigned int          n_negative_       = 0;
    unsigned int          n_factorisations_ = 0;
    unsigned int          n_substitutions_  = 0;
  };
} // namespace Nacre

#endif
