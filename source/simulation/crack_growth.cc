// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/base/text.h>
#include <nacre/postprocess/tip_release.h>
#include <nacre/simulation/crack_growth.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Nacre
{
  namespace
  {
    /** The ring in which G is taken is that large if there is room: cells. */
    constexpr double widest_ring = 6.;
    /** How far a crack may leave its last direction there, of the radius. */
    constexpr double straight_ring = 0.018;

    /**
     * How far from a tip (length) nothing but its own straight crack lies: no
     * edge of the surface, no other cut, tip or kink. Collective.
     * @param least a radius within which the crack counts as straight if it
     *   leaves its direction by no more than snapping does
     */
    double
    find_room(const Discretization &discretization,
              const CrackTip       &crack,
              const unsigned int    cut,
              const double          least)
    {
      double     room = std::numeric_limits<double>::max();
      const auto take = [&](const Point<spacedim> &x) {
        room = std::min(room, x.distance(crack.position));
      };
      for (const CellPart &part : discretization.owned_parts())
        for (const auto face : part.cell->face_indices())
          if (part.cell->at_boundary(face))
            {
              const auto nodes = discretization.node_positions(part);
              for (const unsigned int a : discretization.face_nodes(face))
                take(nodes[a]);
            }
      for (const auto &line : discretization.cut_lines())
        for (const auto &x : line.points)
          {
            const auto   d   = x - crack.position;
            const double off = std::abs(d * crack.axes[1]);
            if (line.cut != cut ||
                off > straight_ring * std::max(d.norm(), least) ||
                d * crack.axes[0] > (1. + 1e-6) * crack.closed + 1e-6 * least)
              take(x);
          }
      for (const auto &other : discretization.tips())
        if (other.position.distance(crack.position) >
            crack.closed + 0.1 * crack.cell_size)
          // The cut may be closed over the last cell.
          room = std::min(room,
                          other.position.distance(crack.position) -
                            1.5 * crack.cell_size);
      return Utilities::MPI::min(room, discretization.communicator());
    }
  } // namespace

  CrackGrowth::CrackGrowth(ShellProblem &problem, Log &log)
    : problem_(problem)
    , log_(log)
  {
    for (const Growth::Tip &end : problem.growth.tips)
      {
        GrowingTip tip;
        tip.name = in_words(end, problem.model.cuts);
        tip.end  = end;
        tips_.push_back(tip);
      }
  }

  CutTrace::Tip
  CrackGrowth::find(const Discretization &discretization,
                    const GrowingTip     &tip) const
  {
    for (const CutTrace::Tip &end : discretization.tips())
      if (end.cut == tip.end.cut && end.at_end == tip.end.at_end)
        return end;
    AssertThrow(false,
                ExcMessage("Growth/Tips, '" + tip.name +
                           "': this end of the cut lies on or beyond an edge "
                           "of the surface and is no tip; only ends inside "
                           "of the surface grow."));
    return {};
  }

  void
  CrackGrowth::check(const Discretization &discretization) const
  {
    for (const GrowingTip &tip : tips_)
      if (tip.is_alive)
        find(discretization, tip);
    for (const CoarseCrack &crack : coarse_cracks(discretization))
      for (const GrowingTip &tip : tips_)
        AssertThrow(!tip.is_alive || tip.end.cut != crack.cut,
                    ExcMessage("Growth/Tips, '" + tip.name +
                               "': " + in_words(crack, problem_.model.cuts) +
                               " (Study/Refinements)."));
    const Growth &growth = problem_.growth;
    const double  extent = discretization.extent().second;
    for (const auto &[parameter, length] :
         {std::make_pair("Step", growth.step),
          std::make_pair("Averaging distance", growth.averaging_distance)})
      AssertThrow(length.is_in_cells || length.value <= extent,
                  ExcMessage("Growth/" + std::string(parameter) + ": " +
                             Text::number(length.value) +
                             " is longer than the shell, whose extent is " +
                             Text::number(extent) + "."));
  }

  void
  CrackGrowth::observe(const SolvedShell &shell)
  {
    const Growth &growth = problem_.growth;
    for (GrowingTip &tip : tips_)
      {
        if (!tip.is_alive)
          continue;
        const CutTrace::Tip end = find(shell.discretization, tip);
        tip.position            = end.position;
        tip.step = growth.step.at(cell_size_at(shell.discretization, end));
        if (growth.is_by_energy())
          measure_energy(shell, end, tip);
        tip.angle =
          chosen_angle(shell.discretization, end, tip, shell.instant.time);
        if (growth.is_by_strength())
          measure_stress(shell, end, tip);
      }
    starts_.clear();
    if (n_starts_left() > 0)
      starts_ = find_crack_starts(shell, growth, n_starts_left());
  }

  double
  CrackGrowth::critical_factor() const
  {
    if (problem_.growth.is_prescribed())
      return 1.;
    const double drive     = largest_drive();
    const bool   by_energy = problem_.growth.is_by_energy();
    AssertThrow(
      drive > 0.,
      ExcMessage(
        "Growth/Criterion: " +
        std::string(by_energy ? "no tip releases energy under the loads and "
                                "prescribed values of the file (largest "
                                "G/(G_c h) = " :
                                "nothing is pulled at the places where cracks "
                                "may grow or start, under the loads and "
                                "prescribed values of the file (largest "
                                "stress over the strength = ") +
        std::to_string(drive) + "); loads that open the cuts are needed."));
    return by_energy ? 1. / std::sqrt(drive) : 1. / drive;
  }

  void
  CrackGrowth::scale(const double factor)
  {
    const double drive =
      problem_.growth.is_by_energy() ? factor * factor : factor;
    for (CrackStart &start : starts_)
      start.drive *= drive;
    for (GrowingTip &tip : tips_)
      {
        tip.rate *= factor * factor;
        tip.drive *= drive;
        for (double &intensity : tip.intensities)
          intensity *= factor;
      }
  }

  void
  CrackGrowth::measure_energy(const SolvedShell   &shell,
                              const CutTrace::Tip &end,
                              GrowingTip          &tip) const
  {
    const Growth     &growth = problem_.growth;
    const std::string where  = "Growth/Tips, '" + tip.name + "'";
    const CrackTip    crack  = make_crack_tip(shell.discretization, end, where);
    AssertThrow(tip.step > 1.5 * crack.closed,
                ExcMessage("Growth/Step: at the tip '" + tip.name +
                           "' a step of " + Text::number(tip.step) +
                           " is too short to tell G: the crack is closed over "
                           "the last " +
                           Text::number(crack.closed) +
                           " of the cut, within a cell. Choose a longer step, "
                           "or a finer mesh."));
    // The kink of the last step lies outside.
    const double least = 0.95 * (tip.step - crack.closed);
    const double room =
      find_room(shell.discretization, crack, tip.end.cut, least);
    const double outer =
      std::min(0.9 * room, std::max(least, widest_ring * crack.cell_size));
    const TipRelease release =
      compute_tip_release(shell, crack, CrackPlateau{outer / 3., outer}, where);
    AssertThrow(release.has_intensities ||
                  growth.direction != GrowthDirection::hoop_stress,
                ExcMessage("Growth/Direction: at the tip '" + tip.name +
                           "' the section isn't homogeneous and isotropic, as "
                           "'hoop stress' needs it; choose 'straight' or a "
                           "vector 'dx, dy, dz'."));
    tip.closed          = crack.closed;
    tip.rate            = release.rate;
    tip.has_intensities = release.has_intensities;
    tip.intensities     = release.intensities;
    tip.drive           = release.rate / (growth.toughness * release.thickness);
    tip.angle           = release.hoop_stress.angle;
  }

  void
  CrackGrowth::measure_stress(const SolvedShell   &shell,
                              const CutTrace::Tip &end,
                              GrowingTip          &tip) const
  {
    const Growth     &growth = problem_.growth;
    const std::string where  = "Growth/Tips, '" + tip.name + "'";
    const CrackTip    crack  = make_crack_tip(shell.discretization, end, where);
    const bool        seeks  = growth.direction == GrowthDirection::hoop_stress;
    const AveragedHoopStress stress =
      averaged_hoop_stress(shell,
                           crack,
                           tip.end.cut,
                           growth.averaging_distance.at(crack.cell_size),
                           seeks ? std::optional<double>() : tip.angle,
                           tip.name);
    tip.closed = crack.closed;
    tip.drive  = stress.value / growth.strength;
    tip.angle  = stress.angle;
  }

  double
  CrackGrowth::chosen_angle(const Discretization &discretization,
                            const CutTrace::Tip  &end,
                            const GrowingTip     &tip,
                            const double          time) const
  {
    const Growth &growth = problem_.growth;
    if (growth.direction == GrowthDirection::hoop_stress)
      return tip.angle;
    if (growth.direction == GrowthDirection::straight)
      return 0.;
    const auto   axes  = tip_axes(discretization, end);
    const auto   along = growth.along(end.position, time);
    const double x = along * axes[0], y = along * axes[1];
    AssertThrow(std::hypot(x, y) > 1e-6 * along.norm(),
                ExcMessage("Growth/Direction: at the tip '" + tip.name +
                           "' the vector is 0 or perpendicular to the surface; "
                           "give one with a part along the surface."));
    return std::atan2(y, x);
  }

  bool
  CrackGrowth::has_tips() const
  {
    return n_starts_left() > 0 ||
           std::any_of(tips_.begin(), tips_.end(), [](const auto &tip) {
             return tip.is_alive;
           });
  }

  double
  CrackGrowth::largest_drive() const
  {
    double largest = 0.;
    for (const GrowingTip &tip : tips_)
      if (tip.is_alive)
        largest = std::max(largest, tip.drive);
    for (const CrackStart &start : starts_)
      largest = std::max(largest, start.drive);
    return largest;
  }

  bool
  CrackGrowth::is_behind(const GrowingTip &tip, const double time) const
  {
    // A length that is a step ahead but for round-off is a step ahead.
    const double length =
      problem_.growth.length(Point<spacedim>(), time) - tip.advanced;
    return tip.is_alive && length >= (1. - 1e-9) * tip.step;
  }

  bool
  CrackGrowth::is_due(const double time) const
  {
    if (has_ended())
      return false;
    if (!problem_.growth.is_prescribed())
      return largest_drive() >= 1.;
    return std::any_of(tips_.begin(), tips_.end(), [&](const auto &tip) {
      return is_behind(tip, time);
    });
  }

  void
  CrackGrowth::advance(const Discretization &discretization,
                       const double          time,
                       const bool            takes_all)
  {
    const Growth &growth = problem_.growth;
    before_              = state();
    const double least   = (1. - growth.tolerance) * largest_drive();
    ++n_steps_;
    for (GrowingTip &tip : tips_)
      {
        const bool grows = growth.is_prescribed() ?
                             takes_all || is_behind(tip, time) :
                             tip.drive >= least;
        if (tip.is_alive && grows)
          advance_tip(discretization, tip);
      }
    for (const CrackStart &place : starts_)
      if (place.drive >= least)
        start(discretization, place);
  }

  void
  CrackGrowth::advance_tip(const Discretization &discretization,
                           GrowingTip           &tip)
  {
    Cuts            &cuts    = problem_.model.cuts;
    const TipAdvance advance = Nacre::advance_tip(discretization,
                                                  problem_.model.midsurface,
                                                  find(discretization, tip),
                                                  tip.angle,
                                                  tip.step,
                                                  cuts);
    tip.advanced += tip.step;
    tip.is_alive = advance.stays();
    std::ostringstream text;
    text << tip.name << " advances by " << Text::number(tip.step)
         << ", turned by " << Text::number(tip.angle * 180. / numbers::PI)
         << " degrees";
    if (advance.leaves)
      text << ", and leaves the surface";
    if (advance.met)
      text << ", and meets the cut " << cuts.curves[*advance.met].name;
    tell(text.str());
  }

  void
  CrackGrowth::start(const Discretization &discretization,
                     const CrackStart     &place)
  {
    Cuts          &cuts   = problem_.model.cuts;
    auto          &curves = cuts.curves;
    const CutStart cut    = make_cut(discretization, place, cuts);
    ++n_started_;
    for (const bool at_end : {false, true})
      if (at_end ? cut.has_end : cut.has_begin)
        {
          GrowingTip tip;
          tip.end  = {static_cast<unsigned int>(curves.size()), at_end};
          tip.name = cut.curve.name + (at_end ? " end" : " begin");
          tips_.push_back(tip);
        }
    std::ostringstream text;
    text << "the crack '" << cut.curve.name << "' starts at (" << place.position
         << ')';
    tell(text.str());
    curves.push_back(cut.curve);
  }

  void
  CrackGrowth::tell(const std::string &text) const
  {
    log_.progress() << "growth step " << n_steps_ << ": " << text << std::endl;
  }

  GrowthState
  CrackGrowth::state() const
  {
    return {problem_.model.cuts.curves, tips_, starts_, n_started_, n_steps_};
  }

  void
  CrackGrowth::set_state(const GrowthState &state)
  {
    problem_.model.cuts.curves = state.curves;
    tips_                      = state.tips;
    starts_                    = state.starts;
    n_started_                 = state.n_started;
    n_steps_                   = state.n_steps;
  }

  void
  CrackGrowth::resume(const GrowthState &then)
  {
    // A file of points may have changed, which no parameter tells.
    const auto is_same = [](const auto &a, const auto &b) {
      return a.distance(b) <= 1e-10 * (a.norm() + b.norm());
    };
    const auto &curves = problem_.model.cuts.curves;
    for (unsigned int k = 0; k < curves.size(); ++k)
      {
        const auto &now   = curves[k].points;
        const auto &grown = then.curves.at(k).points;
        AssertThrow(std::search(grown.begin(),
                                grown.end(),
                                now.begin(),
                                now.end(),
                                is_same) != grown.end(),
                    ExcMessage("--restart: the cut '" + curves[k].name +
                               "' began with other points in the run of the "
                               "checkpoint (Cuts/Cuts)."));
      }
    set_state(then);
  }

  namespace
  {
    /** Throws for shells that no criterion of strength knows. */
    void
    check_strength(const ShellProblem &problem)
    {
      const ShellModel &model = problem.model;
      AssertThrow(!problem.growth.is_by_strength() ||
                    model.section->n_layers() == 0,
                  ExcMessage("Growth/Criterion: 'strength' is that of a "
                             "homogeneous section, and this one has layers; "
                             "choose 'energy release rate' or 'prescribed'."));
      const bool starts = problem.growth.starting_cracks > 0;
      AssertThrow(!starts || problem.assembly == AssemblyMethod::fast,
                  ExcMessage("Growth/Starting cracks: 'Discretization/Assembly "
                             "= reference' knows no cells that cuts divide; "
                             "choose 'fast'."));
      AssertThrow(!starts || model.mapping_degree == 0 ||
                    model.mapping_degree == model.element.degree ||
                    model.element.type != ElementType::lagrange,
                  ExcMessage("Growth/Starting cracks: with cuts the geometry "
                             "is isoparametric; found 'Discretization/Mapping "
                             "degree = " +
                             std::to_string(model.mapping_degree) +
                             "', choose 0."));
    }
  } // namespace

  void
  check_growth(const ShellProblem &problem)
  {
    if (!problem.growth.is_on())
      return;
    const PathParameters &path = problem.path;
    AssertThrow(path.is_linear() || path.type == AnalysisType::quasi_static ||
                  path.type == AnalysisType::relaxation ||
                  path.follows_curve() || path.is_dynamic(),
                ExcMessage(
                  "Growth/Tips: with 'Analysis/Type = " + name_of(path.type) +
                  "' cuts don't grow; choose 'linear', 'static', 'relaxation', "
                  "'arc length', 'displacement control' or 'dynamic', or "
                  "'Tips = none'."));
    AssertThrow(!path.branches.has_several(),
                ExcMessage("Analysis/Switch branch: several branches begin "
                           "with the cuts of their points, which aren't kept "
                           "where cuts grow (Growth/Tips); name one branch, or "
                           "'none'."));
    AssertThrow(problem.growth.starting_cracks == 0 || !path.is_dynamic() ||
                  problem.growth.release_time,
                ExcMessage(
                  "Growth/Release time: 'default' is that of tips "
                  "that advance, and cracks may start (Growth/Starting "
                  "cracks); give the time in which the lips of a new "
                  "crack are released, 0 for at once."));
    AssertThrow(!problem.growth.release_time || path.is_dynamic(),
                ExcMessage("Growth/Release time: with 'Analysis/Type = " +
                           name_of(path.type) +
                           "' lips are free at once, since it has no inertia; "
                           "leave it out, or choose 'Analysis/Type = "
                           "dynamic'."));
    AssertThrow(problem.growth.is_prescribed() || !path.is_linear() ||
                  !problem.model.section->has_initial_strain(),
                ExcMessage("Growth/Criterion: in a linear analysis '" +
                           name_of(problem.growth.criterion) +
                           "' takes the factor of all loads at which a tip "
                           "advances, and initial strains (Section/Initial "
                           "strain) have none; choose 'prescribed', or "
                           "'Analysis/Type = static'."));
    const bool has_stresses = !problem.growth.is_prescribed();
    AssertThrow(problem.growth.direction != GrowthDirection::hoop_stress ||
                  has_stresses,
                ExcMessage("Growth/Direction: 'hoop stress' needs the stresses "
                           "of 'Criterion = energy release rate' or "
                           "'strength'; choose 'straight' or a vector 'dx, "
                           "dy, dz'."));
    check_strength(problem);
  }
} // namespace Nacre
