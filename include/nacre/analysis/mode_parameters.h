// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_mode_parameters_h
#define nacre_analysis_mode_parameters_h

#include <nacre/analysis/path_parameters.h>

#include <optional>

namespace Nacre
{
  /** What the state before buckling, or of a vibrating shell, adds to K. */
  enum class PrestressKind
  {
    none,
    /** G of a membrane force that the user states. */
    membrane_force,
    /** G of the membrane forces of the linear solution. */
    linear,
    /** The same and the second variation of the bending strains times the
     * moments of the linear solution, which still leaves out displacements. */
    forces_and_moments,
    /** The derivative of the tangent of finite rotations along the linear
     * solution: forces, moments and displacements before buckling. */
    tangent
  };

  const Selection<PrestressKind> &selection(PrestressKind);

  /** Which load factors are sought. */
  enum class FactorSign
  {
    positive,
    negative,
    both
  };

  const Selection<FactorSign> &selection(FactorSign);

  /** What a buckling or vibration analysis seeks. */
  struct ModeOptions
  {
    unsigned int n_modes = 10;
    /** Of frequencies (1/time) or load factors; both or none. */
    std::optional<std::pair<double, double>> range;
    PrestressKind                            prestress = PrestressKind::none;
    FactorSign                               sign      = FactorSign::positive;
    /** (N11, N22, N12) along force_axis and across (force/length). */
    VectorExpression membrane_force;
    /** Whose projection on the surface is the direction 1. */
    VectorExpression force_axis;
    /** Relative difference of eigenvalues that count as one. */
    double multiplicity_tolerance = 1e-4;
  };

  /** What the section Analysis says of modes. */
  class ModeParameters : public ParameterAcceptor
  {
  public:
    ModeParameters();

    /**
     * Throws ExcMessage for values that @p type doesn't use.
     * @param has_start whether the state is that of another run
     */
    ModeOptions
    make(const AnalysisType type,
         const bool         has_start,
         const Constants   &constants) const;

  private:
    void
    check_use(const AnalysisType type) const;

    ModeOptions                  values_;
    std::optional<PrestressKind> prestress_;
    std::string                  range_text_;
    std::string                  membrane_force_text_;
    std::string                  force_axis_text_ = "1, 0, 0";
  };
} // namespace Nacre

#endif
