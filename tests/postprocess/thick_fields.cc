// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The body of a shell: its volume, its stresses and displacements at bottom
// and top against closed forms, on quadrilaterals and triangles, with the top
// on either side; the plies of a laminate, whose stresses jump, with an offset.

#include "../tests_common.h"
#include "square_model.h"
#include <nacre/mechanics/laminate_parameters.h>
#include <nacre/postprocess/thick_fields.h>

#include <deal.II/base/mpi.h>

using namespace Tests;

namespace
{
  const double E = 1000., nu = 0.3, h = 0.1, k = 0.02;

  Mesh
  rectangle()
  {
    Mesh mesh;
    mesh.vertices =
      {{0, 0, 0}, {1, 0, 0}, {2.5, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2.5, 1, 0}};
    mesh.cells = {{{0, 1, 3, 4}}, {{1, 2, 4, 5}}};
    return mesh;
  }

  /** w = -k x^2/2: the strain at the height z is k z. */
  Vector3
  bent(const Point<3> &x)
  {
    return Point<3>(0., 0., -0.5 * k * x[0] * x[0]);
  }

  /** (x_0, x_1, x_2) of the vertices 0, 1, 2 and the height of the last. */
  double
  volume(const ThickFields::Patch &patch)
  {
    const bool   wedge = patch.data.n_cols() == 6;
    const auto   a     = patch.vertices[1] - patch.vertices[0];
    const auto   b     = patch.vertices[2] - patch.vertices[0];
    const auto   c     = patch.vertices[wedge ? 3 : 4] - patch.vertices[0];
    const double whole = cross_product_3d(a, b) * c;
    // VTK's wedges begin with the outer triangle.
    return wedge ? -0.5 * whole : whole;
  }

  void
  test_isotropic(const Element &element, const double side)
  {
    const Parameters parameters(section_text(E, nu, h));
    const auto       mesh  = make_discretization(rectangle(), element);
    const auto       u     = interpolate(*mesh, bent);
    auto             model = square_model(parameters.section);
    model.result_axes.top  = VectorExpression(Vector3({0., 0., side}));
    const ThickFields fields({*mesh, model, u}, 0);
    double            whole = 0., stress = 0., displacement = 0., height = 0.;
    for (const auto &patch : fields.get_patches())
      {
        whole += volume(patch);
        for (unsigned int v = 0; v < patch.data.n_cols(); ++v)
          {
            const Point<3> x = patch.vertices[v];
            height = std::max(height, std::abs(std::abs(x[2]) - 0.5 * h));
            stress = std::max(stress,
                              std::abs(patch.data(3, v) -
                                       E / (1. - nu * nu) * k * x[2]));
            // u_x = -z w,x
            displacement =
              std::max(displacement,
                       std::abs(patch.data(0, v) - x[2] * k * x[0]));
          }
      }
    const std::string name =
      label(element) + (side > 0. ? ", top above: " : ", top below: ");
    // The bottom comes first: the cells are turned over if it is above.
    check_below(name + "volume", std::abs(whole - side * 2.5 * h), 1e-12);
    check_below(name + "height", height, 1e-14);
    // deal.II's patches hold single precision.
    check_below(name + "stress", stress / (E * k * h), 1e-5);
    check_below(name + "displacement", displacement / (k * h), 1e-5);
  }

  void
  test_laminate()
  {
    const auto laminate = section_of_text<LaminateSectionParameters>(
      "subsection Section\n subsection Laminate\n"
      "  set Materials = m: E1 = 100, E2 = 10, nu12 = 0, G12 = 5\n"
      "  set Stack = [0/90]\n  set Thickness = 0.1\n  set Offset = 0.05\n"
      "  set Material direction = x\n end\nend\n");
    const auto mesh =
      make_discretization(rectangle(), Element{ElementType::lagrange, 2});
    const auto        u     = interpolate(*mesh, bent);
    const auto        model = square_model(laminate);
    const ThickFields fields({*mesh, model, u}, 0);
    double            stress = 0., low = 1., high = 0.;
    for (const auto &patch : fields.get_patches())
      for (unsigned int v = 0; v < 8; ++v)
        {
          const double z      = patch.vertices[v][2];
          const bool   second = patch.data(15, v) > 1.5;
          low                 = std::min(low, z);
          high                = std::max(high, z);
          stress              = std::max(stress,
                            std::abs(patch.data(3, v) -
                                     (second ? 10. : 100.) * k * z));
        }
    check_below("laminate: lowest and highest point",
                std::abs(low) + std::abs(high - 0.1),
                1e-14);
    check_below("laminate: stress of each ply", stress / (10. * k * 0.1), 1e-4);
    check_below("laminate: cells of both plies",
                std::abs(fields.get_patches().size() - 16.),
                0.5);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const double side : {1., -1.})
    {
      test_isotropic(Element{ElementType::lagrange, 3}, side);
      test_isotropic(triangle, side);
    }
  test_laminate();
  return n_failures == 0 ? 0 : 1;
}
