// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/discretization/rigid_motions.h>
#include <nacre/simulation/rigid_shares.h>
#include <nacre/simulation/vibration_analysis.h>

#include <cmath>

namespace Nacre
{
  namespace
  {
    /**
     * The bending stiffness over the mass per area (length^4/time^2), mean of
     * this rank's cells: half of g : D : g of the metric g, which is
     * D (1 + nu) of an isotropic section.
     */
    std::pair<double, double>
    bending_and_mass(const Discretization &discretization,
                     const SectionLaw     &section)
    {
      ShellCellValues           values(discretization, QMidpoint<dim>(), false);
      std::pair<double, double> sum{0., 0.};
      for (const auto &cell :
           discretization.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            values.reinit_frames(cell);
            const auto &frame = values.frame(0);
            const auto  point = values.point(0);
            const auto &a     = frame.a_cov;
            Voigt<>     metric;
            metric[0]    = a[0] * a[0];
            metric[1]    = a[1] * a[1];
            metric[2]    = 2. * (a[0] * a[1]);
            const auto D = section.stiffness(frame, point).bending;
            sum.first += 0.5 * (metric * (D * metric)) * frame.j0;
            sum.second +=
              section.density(point) * section.thickness(point) * frame.j0;
          }
      return sum;
    }

    /** The size (1/time^2) of the lowest omega^2, roughly; collective. */
    double
    typical_square(const Discretization &discretization,
                   const SectionLaw     &section)
    {
      const auto   communicator = discretization.communicator();
      const auto   sums         = bending_and_mass(discretization, section);
      const double D            = Utilities::MPI::sum(sums.first, communicator);
      const double m = Utilities::MPI::sum(sums.second, communicator);
      return D / m * std::pow(numbers::PI / discretization.extent().second, 4);
    }
  } // namespace

  void
  VibrationAnalysis::check_problem(DiscreteShell   &shell,
                                   const Prestress &prestress) const
  {
    check_number(Utilities::MPI::sum(
      free_dofs(shell, prestress.constraints()).n_elements(),
      communicator_));
    const MassTerms mass(shell.discretization(), *problem_.model.section);
    // The eigensolver takes squares of these squares.
    const double square =
      typical_square(shell.discretization(), *problem_.model.section);
    AssertThrow(square > 1e-120 && square < 1e120,
                ExcMessage("Section/Density: with this mass the squares of "
                           "angular frequencies are of the size " +
                           Text::number(square) +
                           "; they must be between 1e-120 and 1e120. Choose "
                           "other units."));
    AssertThrow(problem_.modes.prestress == PrestressKind::none ||
                  prestress.acts(1.),
                ExcMessage("Analysis/Prestress: nothing acts on the shell at "
                           "t = 1; state a load, or choose 'Prestress = "
                           "none'."));
    AssertThrow(problem_.modes.prestress == PrestressKind::none ||
                  problem_.modes.prestress == PrestressKind::membrane_force ||
                  shell.conditions().free_rigid_motions().empty(),
                ExcMessage("Analysis/Prestress: the shell can move freely, so "
                           "that loads have no linear solution; prescribe "
                           "more, or choose 'Prestress = membrane force'."));
  }

  void
  VibrationAnalysis::assemble_mass(const MassTerms                 &mass,
                                   const AffineConstraints<double> &constraints,
                                   const DiscreteShell             &shell,
                                   Matrix                          &M) const
  {
    shell.assembly().reinit_matrix(constraints, M);
    Vector unused = shell.owned_vector();
    mass.assemble_system(constraints, shell.ghosted_vector(), M, unused);
    for (const auto &line : constraints.get_lines())
      if (shell.discretization().locally_owned_dofs().is_element(line.index))
        M.set(line.index, line.index, 0.);
    M.compress(VectorOperation::insert);
  }

  double
  VibrationAnalysis::lowest_shift(const DiscreteShell &shell,
                                  Eigenproblem        &problem) const
  {
    const double size =
      typical_square(shell.discretization(), *problem_.model.section);
    double shift = shell.conditions().free_rigid_motions().empty() ? 0. : -size;
    for (unsigned int trial = 0; trial < 40; ++trial)
      {
        if (problem.try_count_below(shift).value_or(1) == 0)
          return shift;
        shift = std::min(4. * shift, -size);
      }
    AssertThrow(false,
                ExcMessage("The prestress makes the shell so unstable that no "
                           "lowest frequency is found; make it smaller."));
    return shift;
  }

  ModeAnalysis::Modes
  VibrationAnalysis::find_modes(DiscreteShell   &shell,
                                const Prestress &prestress) const
  {
    Modes           modes;
    Matrix          K, M;
    CpuTimer        timer(communicator_);
    const MassTerms mass(shell.discretization(), *problem_.model.section);
    if (start() != nullptr)
      prestress.assemble_tangent(start()->u, start()->time, K);
    else
      prestress.assemble_stiffness(K);
    assemble_mass(mass, prestress.constraints(), shell, M);
    modes.assembly += timer.lap();
    modes.state =
      start() != nullptr ? start()->u : prestress.solve(K, 1., shell.solver());
    timer.lap();
    if (problem_.modes.prestress != PrestressKind::none)
      {
        Matrix G;
        shell.assembly().reinit_matrix(prestress.constraints(), G);
        prestress.add(modes.state, 1., 1., G);
        K.add(1., G);
      }
    modes.assembly += timer.lap();

    Eigenproblem problem(K, M, true, free_dofs(shell, prestress.constraints()));
    const auto  &range     = problem_.modes.range;
    const auto   to_square = [](const double frequency) {
      return std::pow(2. * numbers::PI * frequency, 2);
    };
    std::optional<double> upper;
    if (range)
      upper = to_square(range->second);
    Spectrum spectrum =
      problem.find_above(range && range->first > 0. ?
                           to_square(range->first) :
                           lowest_shift(shell, problem),
                         problem_.modes.n_modes,
                         upper,
                         problem_.modes.multiplicity_tolerance);
    const auto to_frequency = [](const double square) {
      return std::sqrt(std::max(square, 0.)) / (2. * numbers::PI);
    };
    modes.notes.push_back(
      counted_in_words(spectrum,
                       "frequencies",
                       to_frequency(spectrum.counted.first),
                       to_frequency(spectrum.counted.second)));
    modes.n_factorisations = problem.n_factorisations();
    modes.n_substitutions  = problem.n_substitutions();
    modes.values.n_below   = spectrum.n_below;
    describe(shell, mass, K, prestress.constraints(), spectrum, modes);
    const auto n =
      std::min<std::size_t>(problem_.modes.n_modes, spectrum.values.size());
    modes.values.values.resize(n);
    modes.values.multiplicities.resize(n);
    modes.remarks.resize(n);
    modes.vectors.assign(std::make_move_iterator(spectrum.modes.begin()),
                         std::make_move_iterator(spectrum.modes.begin() + n));
    return modes;
  }

  void
  VibrationAnalysis::describe(const DiscreteShell             &shell,
                              const MassTerms                 &mass,
                              const Matrix                    &K,
                              const AffineConstraints<double> &constraints,
                              const Spectrum                  &spectrum,
                              Modes                           &modes) const
  {
    const auto rigid =
      rigid_shares(shell, mass, K, constraints, spectrum.modes);
    std::vector<double> squares(spectrum.values);
    modes.remarks.resize(squares.size());
    unsigned int n_unstable = 0;
    for (unsigned int k = 0; k < squares.size(); ++k)
      if (rigid[k])
        {
          squares[k]       = 0.;
          modes.remarks[k] = "rigid motion";
          ++modes.values.n_rigid;
        }
      else if (squares[k] < 0.)
        {
          modes.remarks[k] = "unstable: omega^2 < 0";
          ++n_unstable;
        }
    modes.values.are_frequencies = true;
    modes.values.multiplicities  = multiplicities(squares);
    for (const double square : squares)
      modes.values.values.push_back(
        std::copysign(std::sqrt(std::abs(square)), square));
    if (modes.values.n_rigid > 0)
      {
        std::string text = std::to_string(modes.values.n_rigid) + " of them " +
                           (modes.values.n_rigid == 1 ? "is a rigid motion" :
                                                        "are rigid motions");
        const auto names = shell.conditions().free_rigid_motions();
        for (const auto &name : names)
          text += (&name == &names.front() ? ": " : "; ") + name;
        modes.notes.push_back(text + '.');
      }
    if (n_unstable > 0)
      log_.warning("the shell is unstable under its prestress: " +
                   std::to_string(n_unstable) +
                   (n_unstable == 1 ? " mode grows" : " modes grow") +
                   " instead of vibrating; omega is -sqrt(-omega^2) there.");
  }
} // namespace Nacre
