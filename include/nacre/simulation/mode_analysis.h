// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_mode_analysis_h
#define nacre_simulation_mode_analysis_h

#include <nacre/analysis/eigenproblem.h>
#include <nacre/analysis/prestress.h>
#include <nacre/base/cpu_timer.h>
#include <nacre/postprocess/mode_quantities.h>
#include <nacre/simulation/analysis.h>
#include <nacre/simulation/discrete_shell.h>

#include <optional>

namespace Nacre
{
  /**
   * What buckling and vibration have in common: a shell in a linear state, or
   * in that where another run has ended, eigenvalues with modes, their table
   * and fields.
   */
  class ModeAnalysis : public Analysis
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;
    using Matrix = TrilinosWrappers::SparseMatrix;

    ModeAnalysis(const MPI_Comm      communicator,
                 const ShellProblem &problem,
                 Log                &log);

    bool
    can_restart() const override
    {
      return false;
    }

    void
    check(const Recorder &recorder, const bool restart) override;

    void
    run(Recorder &recorder, const bool restart) override;

  protected:
    /** Modes, in the order in which they are reported. */
    struct Modes
    {
      ModeValues values;
      /** Without ghosts; constrained entries need not be set. */
      std::vector<Vector> vectors;
      /** Words beside a mode in the table; may be fewer. */
      std::vector<std::string> remarks;
      /** Sentences for the terminal: how complete the modes are. */
      std::vector<std::string> notes;
      unsigned int             n_factorisations = 0;
      unsigned int             n_substitutions  = 0;
      /** The linear state (length), ghosted. */
      Vector state;
      /** CPU seconds of all matrices. */
      double assembly = 0.;
    };

    /** The state of `Analysis/Start from`, in equilibrium. */
    struct StartState
    {
      /** Ghosted displacement (length), and du/dt along the curve. */
      Vector u;
      Vector velocity;
      double time = 0.;
    };

    /** Null if the state is a linear one. */
    const StartState *
    start() const
    {
      return start_ ? &*start_ : nullptr;
    }

    /** What is wrong with the problem on this mesh; throws. Collective. */
    virtual void
    check_problem(DiscreteShell &shell, const Prestress &prestress) const = 0;

    virtual Modes
    find_modes(DiscreteShell &shell, const Prestress &prestress) const = 0;

    /** Heading of the eigenvalues in tables. */
    virtual std::string
    value_name() const = 0;

    /** Unconstrained dofs of this rank. */
    static IndexSet
    free_dofs(const DiscreteShell             &shell,
              const AffineConstraints<double> &constraints);

    /** Throws if more modes are asked for than @p n_free dofs can have. */
    void
    check_number(const types::global_dof_index n_free) const;

    /** "11 below X, counted by ..." */
    static std::string
    counted_in_words(const Spectrum    &spectrum,
                     const std::string &quantity,
                     const double       lower,
                     const double       upper);

    /** How many of the ascending @p values each is one of. */
    std::vector<unsigned int>
    multiplicities(const std::vector<double> &values) const;

    const MPI_Comm      communicator_;
    const ShellProblem &problem_;
    Log                &log_;

  private:
    /** Find start_, if the problem has one. Collective. */
    void
    load_start_state(DiscreteShell &shell, const Recorder &recorder);

    void
    write_table(const Modes &modes, Recorder &recorder) const;

    /** The displacements of a mode, largest one 1, ghosted. */
    Vector
    scaled_mode(const Vector                    &mode,
                const AffineConstraints<double> &constraints,
                const DiscreteShell             &shell) const;

    void
    write_fields(const Modes         &modes,
                 const Prestress     &prestress,
                 const DiscreteShell &shell,
                 Recorder            &recorder) const;

    std::optional<StartState> start_;
  };
} // namespace Nacre

#endif
