// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_shell_problem_h
#define nacre_simulation_shell_problem_h

#include <nacre/analysis/mode_parameters.h>
#include <nacre/analysis/path_parameters.h>
#include <nacre/mechanics/section_parameters.h>
#include <nacre/problem/growth.h>
#include <nacre/problem/shell_model.h>
#include <nacre/simulation/chosen_solver.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <optional>
#include <string>

namespace Nacre
{
  /** What one solve of a study varies. */
  struct ShellCase
  {
    unsigned int          degree        = 2;
    unsigned int          n_refinements = 0;
    std::optional<double> eta;
    std::optional<double> thickness;
  };

  /** Who assembles the system of a linear analysis. */
  enum class AssemblyMethod
  {
    /** Assembly */
    fast,
    /** ReferenceAssembly */
    reference
  };

  const Selection<AssemblyMethod> &selection(AssemblyMethod);

  /** A shell and what is to be computed of it: one case of a study. */
  struct ShellProblem
  {
    ShellModel       model;
    unsigned int     n_refinements = 0;
    PathParameters   path          = {};
    ModeOptions      modes         = {};
    SolverParameters solver        = {};
    /** Of the model's cuts, which an analysis lengthens. */
    Growth         growth   = {};
    AssemblyMethod assembly = AssemblyMethod::fast;
    /** Constants of the file and of the section, for more expressions. */
    Constants constants = {};
  };

  /** The section Discretization of a parameter file. */
  class DiscretizationParameters : public ParameterAcceptor
  {
  public:
    DiscretizationParameters();

    /** Throws ExcMessage for an element that @p degree doesn't suit. */
    Element
    element(const unsigned int degree) const;

    KinematicsOptions
    kinematics() const;

    unsigned int
    mapping_degree() const
    {
      return mapping_degree_;
    }

    AssemblyMethod
    assembly() const
    {
      return assembly_;
    }

  private:
    ElementType  element_        = ElementType::lagrange;
    unsigned int mapping_degree_ = 0;
    /** None: what suits the element. */
    std::optional<MembraneStrain> membrane_strain_;
    KinematicsOptions             kinematics_;
    AssemblyMethod                assembly_ = AssemblyMethod::fast;
  };

  /** The section Output of a parameter file: the axes of results. */
  class ResultAxesParameters : public ParameterAcceptor
  {
  public:
    ResultAxesParameters();

    /** Throws ExcMessage for what is no vector. */
    SurfaceAxes
    make(const Constants &constants) const;

  private:
    std::string direction_;
    std::string top_ = "normal";
  };

  /** The sections of a parameter file that describe a ShellProblem. */
  class ProblemParameters
  {
  public:
    explicit ProblemParameters(std::unique_ptr<SectionParameters> section);

    /**
     * Mesh files are read on rank 0 of @p communicator, and looked for in the
     * @p folder of the parameter file.
     */
    void
    set_files(const MPI_Comm communicator, const std::string &folder)
    {
      midsurface_.set_files(communicator, folder);
      cuts_.set_files(communicator, folder);
    }

    /**
     * Read and check everything for a case; throws ExcMessage. Collective if
     * the mid-surface is a file's.
     * @param previous the mid-surface of the case before: see
     *   MidsurfaceParameters::make()
     */
    ShellProblem
    make(const Constants          &constants,
         const ShellCase          &shell_case,
         std::optional<Midsurface> previous);

  private:
    /** @p constants and those of the section. */
    Constants
    all_constants(const Constants             &constants,
                  const std::optional<double> &thickness) const;

    static void
    check(const ShellProblem &problem);

    /** What there is for sections whose law isn't linear, or has a memory. */
    static void
    check_section(const ShellProblem &problem);

    /** Whether functions of the tips of cuts are to turn. */
    static bool
    takes_finite_rotations(const ShellProblem &problem);

    /** What the tips of cuts may have functions in. */
    static void
    check_tips(const ShellProblem &problem);

    std::unique_ptr<SectionParameters> section_;
    MidsurfaceParameters               midsurface_;
    BoundaryConditionParameters        supports_;
    LoadParameters                     loads_;
    ExactSolutionParameters            exact_solution_;
    AnalysisParameters                 analysis_;
    ModeParameters                     modes_;
    LinearSolverParameters             solver_;
    DiscretizationParameters           discretization_;
    ResultAxesParameters               result_axes_;
    FoundationParameters               foundation_;
    CutParameters                      cuts_;
    GrowthParameters                   growth_;
  };
} // namespace Nacre

#endif
