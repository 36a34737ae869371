// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// A free shell has exactly six modes without energy, the rigid motions: for
// all elements and membrane strains, on flat, curved and creased meshes, with
// hanging nodes too.

#include "../tests_common.h"

using namespace Tests;

/** Two cells of a plane, folded by an angle along their common edge. */
Mesh
folded_mesh(const double angle)
{
  Mesh mesh;
  for (const double y : {0., 1.})
    {
      mesh.vertices.emplace_back(-1. + 0.2 * y, y, 0.);
      mesh.vertices.emplace_back(0., 1.1 * y, 0.);
      mesh.vertices.emplace_back(1.2 * std::cos(angle),
                                 0.9 * y,
                                 1.2 * std::sin(angle));
    }
  mesh.cells = {{{0, 1, 3, 4}}, {{1, 2, 4, 5}}};
  return mesh;
}

Vector3
rigid_motion(const unsigned int k, const Point<3> &x)
{
  Vector3 e;
  e[k % 3] = 1.;
  return k < 3 ? e : cross_product_3d(e, Vector3(x));
}

void
test_mesh(const std::string    &name,
          const Parameters     &parameters,
          const Mesh           &mesh,
          const Element        &element,
          const MembraneStrain &membrane_strain)
{
  const auto     discretization = make_discretization(mesh, element);
  const Assembly assembly(*discretization,
                          ShellParts(parameters.section,
                                     parameters.conditions,
                                     parameters.loads,
                                     membrane_strain,
                                     {}));
  const auto     where =
    name + ", " + label(element) + ", " + name_of(membrane_strain);

  const auto  &constraints = discretization->node_constraints();
  const auto   system  = dense_system(*discretization, assembly, constraints);
  const auto   values  = eigenvalues(system.first, constraints);
  const double largest = values[values.size() - 1];
  double       six     = 0.;
  for (unsigned int k = 0; k < 6; ++k)
    six = std::max(six, std::abs(values[k]) / largest);
  check_below(where + ": six zero modes", six, 1e-12);
  check_above(where + ": no other", values[6] / largest, 1e-8);

  const double scale =
    assembly.energies(interpolate(*discretization, some_field)).total();
  double energy = 0.;
  for (unsigned int k = 0; k < 6; ++k)
    {
      const auto parts =
        assembly.energies(interpolate(*discretization, [&](const auto &x) {
          return rigid_motion(k, x);
        }));
      energy = std::max({energy,
                         std::abs(parts.membrane) / scale,
                         std::abs(parts.bending) / scale,
                         std::abs(parts.edge) / scale});
    }
  check_below(where + ": energy of rigid motions", energy, 1e-14);
}

void
test_element(const Parameters &parameters, const Element &element)
{
  for (const auto membrane_strain :
       {MembraneStrain::tied, MembraneStrain::full, MembraneStrain::reduced})
    {
      Mesh mesh = folded_mesh(0.);
      test_mesh("flat", parameters, mesh, element, membrane_strain);
      mesh     = folded_mesh(2.);
      mesh.map = bend;
      test_mesh("creased", parameters, mesh, element, membrane_strain);
      // Triangles have no hanging nodes.
      if (element.type == ElementType::triangle ||
          (element.degree == 4 && membrane_strain != MembraneStrain::tied))
        continue;
      mesh.refined = {1};
      test_mesh("creased, hanging nodes",
                parameters,
                mesh,
                element,
                membrane_strain);
      mesh         = folded_mesh(0.);
      mesh.map     = bend;
      mesh.refined = {0};
      test_mesh("curved, hanging nodes",
                parameters,
                mesh,
                element,
                membrane_strain);
    }
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Parameters                 parameters(section_text(100., 0.3, 0.1));
  for (const unsigned int degree : {2, 3, 4})
    test_element(parameters, {ElementType::lagrange, degree});
  test_element(parameters, serendipity);
  test_element(parameters, triangle);
  return n_failures > 0;
}
