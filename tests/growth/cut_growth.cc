// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Cuts that become longer: the moment of a cut, at which nothing changes
// (V16), and whereto a tip goes.

#include "../cutting/cut_shell.h"
#include <nacre/discretization/cut_growth.h>
#include <nacre/discretization/part_transfer.h>
#include <nacre/forms/mass_terms.h>

using namespace CutShells;

namespace
{
  /** Parts that are small don't follow others: nothing may change then. */
  Cuts
  without_extension(const std::vector<CutCurve> &curves)
  {
    Cuts cuts;
    cuts.curves        = curves;
    cuts.smallest_part = 0.;
    return cuts;
  }

  struct GrowingShell
  {
    GrowingShell(const std::string           &text,
                 const Element               &element,
                 const std::vector<CutCurve> &curves)
      : parameters(text)
      , element(element)
      , cuts(without_extension(curves))
    {
      discretize(
        parameters.model.midsurface
          .create_triangulation(MPI_COMM_WORLD, element.reference_cell(), 0));
    }

    void
    discretize(std::unique_ptr<parallel::TriangulationBase<2, 3>> mesh)
    {
      discretization =
        std::make_unique<Discretization>(std::move(mesh),
                                         parameters.model.midsurface,
                                         element,
                                         0,
                                         cuts);
    }

    CutTrace::Tip
    tip(const unsigned int cut, const bool at_end) const
    {
      for (const auto &tip : discretization->tips())
        if (tip.cut == cut && tip.at_end == at_end)
          return tip;
      return {numbers::invalid_unsigned_int, at_end, {}, {}, {}, {}};
    }

    /** Advance the tip, and take the longer cut. */
    TipAdvance
    grow(const unsigned int cut,
         const bool         at_end,
         const double       angle,
         const double       length)
    {
      const auto advance = advance_tip(*discretization,
                                       parameters.model.midsurface,
                                       tip(cut, at_end),
                                       angle,
                                       length,
                                       cuts);
      auto       mesh    = discretization->release_triangulation();
      discretization.reset();
      discretize(std::move(mesh));
      return advance;
    }

    TrilinosVector
    with_ghosts(const TrilinosVector &owned) const
    {
      TrilinosVector u(discretization->locally_owned_dofs(),
                       discretization->locally_relevant_dofs(),
                       MPI_COMM_WORLD);
      u = owned;
      return u;
    }

    /** Energies of u, and v . M v in place of the edges'. */
    Energies
    energies(const TrilinosVector &u) const
    {
      const Assembly assembly(*discretization,
                              ShellParts(*parameters.model.section,
                                         parameters.model.supports,
                                         parameters.model.loads,
                                         MembraneStrain::tied,
                                         {}));
      const auto     ghosted  = with_ghosts(u);
      auto           energies = assembly.energies(ghosted);
      auto           product  = u;
      MassTerms(*discretization).vmult(product, ghosted);
      energies.edge = product * u;
      return energies;
    }

    TextModel                       parameters;
    const Element                   element;
    Cuts                            cuts;
    std::unique_ptr<Discretization> discretization;
  };

  /** A field that jumps at the old cut stays what it is. */
  void
  test_moment(const Element &element)
  {
    const auto   tear  = line("tear", {{-.1, .43}, {.41, .47}});
    const auto   other = line("other", {{.73, -.1}, {.71, .31}});
    GrowingShell shell(surface_text("u, v, 0", 6, 4), element, {tear, other});

    auto                                 u = zero_vector(*shell.discretization);
    std::vector<types::global_dof_index> dofs;
    for (const CellPart &part : shell.discretization->owned_parts())
      {
        shell.discretization->get_dof_indices(part, dofs);
        const auto X     = shell.discretization->node_positions(part);
        const bool above = shell.discretization->point_inside(part)[1] > .46;
        for (unsigned int a = 0; a < X.size(); ++a)
          for (unsigned int c = 0; c < 3; ++c)
            u(dofs[shell.discretization->node_dofs()[3 * a + c]]) =
              std::sin(3. * X[a][0] + c) * std::cos(2. * X[a][1]) +
              (above && part.is_cut() ? .3 : 0.);
      }
    u.compress(VectorOperation::insert);
    const auto         before  = shell.energies(u);
    const auto         n_dofs  = shell.discretization->n_dofs();
    const auto         ghosted = shell.with_ghosts(u);
    const PartTransfer transfer(*shell.discretization, {&ghosted});
    shell.grow(0, true, .4, .35);
    const auto moved = transfer.field_on(*shell.discretization, 0);
    const auto after = shell.energies(moved);
    const auto name  = "moment of a cut, " + label(element);
    check_above(name + ": new dofs", shell.discretization->n_dofs(), n_dofs);
    check_below(name + ": mass", std::abs(after.edge / before.edge - 1.), 1e-8);
    check_below(name + ": bending energy",
                std::abs(after.bending / before.bending - 1.),
                1e-8);
    check_below(name + ": membrane energy",
                std::abs(after.membrane / before.membrane - 1.),
                .05);
  }

  void
  check_tip(const std::string   &name,
            const CutTrace::Tip &tip,
            const Point<3>      &position)
  {
    check_below(name + ": tip", tip.position.distance(position), 1e-9);
  }

  void
  test_tips(const Element &element)
  {
    GrowingShell plate(surface_text("u, v, 0", 6, 4),
                       element,
                       {line("tear", {{.2, .5}, {.4, .5}}),
                        line("other", {{.7, .3}, {.7, .6}})});
    check_below("straight, " + label(element),
                plate.grow(0, false, 0., .07).stays() ? 0. : 1.,
                .5);
    check_tip("straight", plate.tip(0, false), {.13, .5, 0.});
    check_below("beyond the edge, " + label(element),
                plate.grow(0, false, 0., .12).leaves ? 0. : 1.,
                .5);
    check_below("no tip there", plate.tip(0, false).cut > 1 ? 0. : 1., .5);
    plate.grow(0, true, .5 * numbers::PI, .1);
    check_tip("turned", plate.tip(0, true), {.4, .6, 0.});
    plate.grow(0, true, -.5 * numbers::PI, .2);
    const auto met = plate.grow(0, true, std::atan2(-.1, .1), .1 * 1.4);
    check_below("meets a cut", met.met == 1u ? 0. : 1., .5);
  }

  /** Across the line at which the chart of a tube is closed. */
  void
  test_tube(const CutCurve &curve)
  {
    GrowingShell tube(
      "subsection Mid-surface\n set Surface = expression\n"
      " set Subdivisions = 12, 4\n subsection expression\n"
      "  set Position = cos(u), sin(u), v\n  set Range u = 0, 2*pi\n"
      "  set Closed = u\n end\nend\n" +
        section_text(1000., .3, .1),
      {ElementType::lagrange, 3},
      {curve});
    tube.grow(0, true, 0., .3);
    // The arc whose tangent has the length .3
    const double angle = std::atan(.3) - .1;
    check_below("tube: angle",
                (tube.tip(0, true).position -
                 Point<3>(std::cos(angle), std::sin(angle), .52))
                  .norm(),
                1e-4);
    tube.grow(0, true, .5 * numbers::PI, .3);
    check_below("tube: along the axis",
                std::abs(tube.tip(0, true).position[2] - .82),
                1e-4);
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const auto &element : {Element{ElementType::lagrange, 2},
                              Element{ElementType::lagrange, 3},
                              triangle})
    test_moment(element);
  for (const auto &element : {Element{ElementType::lagrange, 2}, triangle})
    test_tips(element);
  const double start = 2. * numbers::PI - .1;
  test_tube(line("tear", {{start - .5, .52}, {start, .52}}));
  test_tube({"tear",
             CutCurve::Coordinates::space,
             {{std::cos(-.6), std::sin(-.6), .52},
              {std::cos(-.35), std::sin(-.35), .52},
              {std::cos(-.1), std::sin(-.1), .52}},
             false});
  return n_failures > 0;
}
