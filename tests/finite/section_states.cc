// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Sections with memory: what happens to the states of all points at the end of
// a step, against closed forms, and how other ranks and meshes get them.

#include "finite_shell.h"
#include "power_section.h"
#include <nacre/discretization/part_transfer.h>

constexpr double E = 100., h = 0.2;

/** A plate of 4 x 2 cells that is clamped at one end. */
class Plate
{
public:
  Plate(const TextModelOf<MemorySectionParameters> &text,
        const MPI_Comm                              communicator)
    : discretization(text.model.midsurface,
                     communicator,
                     Element{ElementType::lagrange, 2},
                     0,
                     0)
    , assembly(discretization,
               ShellParts(*text.model.section,
                          text.model.supports,
                          text.model.loads,
                          finite(MembraneStrain::tied),
                          7.))
    , communicator_(communicator)
  {}

  /** Ghosted. */
  TrilinosVector
  interpolate(const VectorField &field) const
  {
    TrilinosVector owned(discretization.locally_owned_dofs(), communicator_);
    TrilinosVector result(discretization.locally_owned_dofs(),
                          discretization.locally_relevant_dofs(),
                          communicator_);
    std::vector<types::global_dof_index> dofs;
    for (const CellPart &part : discretization.owned_parts())
      {
        discretization.get_dof_indices(part, dofs);
        const auto nodes = discretization.node_positions(part);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (owned.in_local_range(dofs[i]))
            {
              const auto k = std::find(discretization.node_dofs().begin(),
                                       discretization.node_dofs().end(),
                                       i) -
                             discretization.node_dofs().begin();
              owned(dofs[i]) = field(nodes[k / 3])[k % 3];
            }
      }
    owned.compress(VectorOperation::insert);
    result = owned;
    return result;
  }

  double
  energy(const VectorField &field) const
  {
    return assembly.energies(interpolate(field)).total();
  }

  double
  force_norm(const VectorField &field) const
  {
    TrilinosVector force(discretization.locally_owned_dofs(), communicator_);
    assembly.residual(interpolate(field), force);
    return force.l2_norm();
  }

  void
  end_step(const VectorField &field) const
  {
    assembly.update_section_states(interpolate(field),
                                   assembly.actions(Instant()));
  }

  Discretization discretization;
  Assembly       assembly;

private:
  const MPI_Comm communicator_;
};

/** x -> x + s x e_1: E_11 = s + s^2/2. */
VectorField
stretch(const double s)
{
  return [s](const Point<3> &x) { return Vector3{{s * x[0], 0., 0.}}; };
}

/** The energy of the law per area at r if the largest was r_0, nu = 0. */
double
exact_energy(const double s, const double s_0)
{
  const auto q = [](const double a) {
    return 0.5 * E * h * std::pow(a + 0.5 * a * a, 2);
  };
  const double r = std::max(q(s), q(s_0));
  return r + MemorySection::beta * r * r +
         (1. + 2. * MemorySection::beta * r) * (q(s) - r);
}

void
test_uniform_stretch(const Plate &plate)
{
  constexpr double area     = 8.;
  const auto       error_at = [&](const double s, const double s_0) {
    const double exact = area * exact_energy(s, s_0);
    return std::abs(plate.energy(stretch(s)) - exact) / exact;
  };
  check_below("stretch: the first time", error_at(0.1, 0.), 1e-12);
  check_below("stretch: nothing is remembered of steps that don't end",
              error_at(0.05, 0.),
              1e-12);
  plate.end_step(stretch(0.1));
  check_below("stretch: unloaded", error_at(0.05, 0.1), 1e-12);
  plate.energy(stretch(0.3));
  check_below("stretch: after a step that failed", error_at(0.05, 0.1), 1e-12);
  plate.end_step(stretch(0.05));
  check_below("stretch: after a step back", error_at(0.06, 0.1), 1e-12);
  check_below("stretch: further", error_at(0.12, 0.1), 1e-12);
}

/** A bent field of no symmetry, clamped nowhere. */
VectorField
bent(const double factor)
{
  return [factor](const Point<3> &x) {
    Vector3 u = some_field(x);
    u[2] += x[0] * x[0];
    return factor * u;
  };
}

/** All ranks' states at all points. */
std::vector<SectionStates::Record>
all_records(const Plate &plate)
{
  std::vector<SectionStates::Record> result;
  for (const auto &of_rank : Utilities::MPI::all_gather(
         MPI_COMM_WORLD,
         plate.assembly.section_states().records(plate.discretization)))
    result.insert(result.end(), of_rank.begin(), of_rank.end());
  return result;
}

void
test_records(const TextModelOf<MemorySectionParameters> &text,
             const Plate                                &plate)
{
  plate.end_step(bent(0.2));
  const auto   records = all_records(plate);
  unsigned int n_edges = 0;
  double       least   = 1.;
  for (const auto &record : records)
    {
      n_edges += record.face != numbers::invalid_unsigned_int ? 1 : 0;
      for (const double value : record.values)
        least = std::min(least, value);
    }
  // Both sides of 10 edges between cells, and two edges that are clamped.
  check_below("records: cells", std::abs(records.size() - n_edges - 8.), 0.5);
  check_below("records: sides of edges", std::abs(n_edges - 22.), 0.5);
  check_above("records: the least of all", least, 1e-6);

  const double expected = plate.force_norm(bent(0.15));
  const Plate  virgin(text, MPI_COMM_WORLD);
  check_above("at rest the force is another",
              std::abs(virgin.force_norm(bent(0.15)) / expected - 1.),
              0.01);
  virgin.assembly.section_states().take(virgin.discretization, records);
  check_below("another shell goes on",
              std::abs(virgin.force_norm(bent(0.15)) / expected - 1.),
              1e-12);
  const Plate alone(text, MPI_COMM_SELF);
  alone.assembly.section_states().take(alone.discretization, records);
  check_below("one rank goes on",
              std::abs(alone.force_norm(bent(0.15)) / expected - 1.),
              1e-12);
  alone.end_step(bent(0.2));
  check_below("one rank goes on: records",
              std::abs(1. * alone.assembly.section_states()
                              .records(alone.discretization)
                              .size() -
                       records.size()),
              0.5);
}

/** Results take the state of the nearest point, on ghosts as well. */
void
test_nearest(const Plate &plate)
{
  double least = 1.;
  for (const auto &cell :
       plate.discretization.dof_handler().active_cell_iterators())
    if (!cell->is_artificial())
      {
        const auto state =
          plate.assembly.section_states().nearest(CellPart(cell),
                                                  Point<2>(0.1, 0.8));
        least = std::min(least, state.size() == 1 ? state[0] : 0.);
      }
  check_above("nearest: the least of all",
              Utilities::MPI::min(least, MPI_COMM_WORLD),
              1e-6);
}

/** On a refined mesh points begin with the state of a point near to them. */
void
test_refinement(const TextModelOf<MemorySectionParameters> &text)
{
  // E_11 = s + s^2/2, s = u_1,1
  const auto root_at = [](const double x) {
    const double s = 0.04 * x;
    return std::sqrt(0.5 * E * h) * (s + 0.5 * s * s);
  };
  Plate coarse(text, MPI_COMM_WORLD);
  coarse.end_step([](const Point<3> &x) {
    return Vector3{{0.02 * x[0] * x[0], 0., 0.}};
  });
  PartTransfer transfer(coarse.discretization,
                        {},
                        coarse.assembly.section_states().of_rules());
  auto         mesh = coarse.discretization.release_triangulation();
  transfer.refine(*mesh, std::vector<bool>(mesh->n_active_cells(), true));
  const Discretization fine(std::move(mesh),
                            text.model.midsurface,
                            Element{ElementType::lagrange, 2},
                            0,
                            Cuts());
  SectionStates        states(*text.model.section);
  states.take(fine, transfer);
  double error = 0.;
  for (const auto &cell : fine.dof_handler().active_cell_iterators())
    if (!cell->is_artificial())
      {
        const auto state = states.nearest(CellPart(cell), Point<2>(0.5, 0.5));
        error =
          std::max(error,
                   std::abs(std::sqrt(state[0]) - root_at(cell->center()[0])));
      }
  // Points of the coarse rule lie at 0.11, 0.5, 0.89, the middles of fine
  // cells at 0.25 and 0.75 of the coarse cells, whose length is 1.
  check_below("refined: states of the nearest point",
              Utilities::MPI::max(error, MPI_COMM_WORLD),
              root_at(4.) - root_at(3.85));
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  // One rank speaks for all: values are global.
  std::cout.setstate(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ?
                       std::ios::goodbit :
                       std::ios::failbit);
  const TextModelOf<MemorySectionParameters> text(
    "subsection Mid-surface\n set Surface = plate\n set Subdivisions = 4, 2\n"
    " subsection plate\n  set Size = 4, 2\n end\nend\n" +
    section_text(E, 0., h) + edges_parameter + "u=0: clamped\nend\n");
  const Plate plate(text, MPI_COMM_WORLD);
  test_uniform_stretch(plate);
  test_records(text, plate);
  test_nearest(plate);
  test_refinement(text);
  return Utilities::MPI::max(n_failures, MPI_COMM_WORLD) > 0;
}
