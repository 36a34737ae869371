// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Cut shells: as many rigid motions as the pieces have, a matrix that is well
// conditioned wherever a cut runs, cuts along the edges of cells.

#include "cut_shell.h"
#include <nacre/forms/mass_terms.h>

using namespace CutShells;

namespace
{
  const std::string square = surface_text("u, v, 0", 4, 4);

  /** Eigenvalues of the matrix with unit diagonal. */
  Vector<double>
  scaled_eigenvalues(const CutShell &shell)
  {
    const auto &constraints = shell.discretization->node_constraints();
    auto        matrix =
      dense_system(*shell.discretization, *shell.assembly, constraints).first;
    Vector<double> scale(matrix.m());
    for (unsigned int i = 0; i < matrix.m(); ++i)
      scale[i] = 1. / std::sqrt(matrix(i, i));
    for (unsigned int i = 0; i < matrix.m(); ++i)
      for (unsigned int j = 0; j < matrix.n(); ++j)
        matrix(i, j) *= scale[i] * scale[j];
    return eigenvalues(matrix, constraints);
  }

  void
  test_condition(const std::string           &name,
                 const Element               &element,
                 const std::vector<CutCurve> &cuts,
                 const unsigned int           n_modes,
                 const CutTips                tips = CutTips::closed)
  {
    const CutShell shell(square, element, cuts, {}, {}, tips);
    const auto     values = scaled_eigenvalues(shell);
    const auto     where  = name + ", " + label(element) + ": ";
    const double   last   = values[values.size() - 1];
    check_below(where + std::to_string(n_modes) + " zero modes",
                std::abs(values[n_modes - 1]) / last,
                1e-10);
    check_below(where + "condition number of the others",
                last / values[n_modes],
                element.type == ElementType::triangle ? 1e5 :
                element.degree == 2                   ? 1e4 :
                                                        1e6);
  }

  void
  test_conditions()
  {
    const CutCurve one    = line("one", {{-.1, .37}, {1.1, .61}});
    const CutCurve across = line("across", {{.41, -.1}, {.57, 1.1}});
    for (const auto &element : {Element{ElementType::lagrange, 2},
                                Element{ElementType::lagrange, 3},
                                serendipity,
                                triangle})
      {
        test_condition("no cut", element, {}, 6);
        test_condition("one cut", element, {one}, 12);
        test_condition("crossing", element, {one, across}, 24);
        test_condition("tip inside",
                       element,
                       {line("tip", {{-.1, .37}, {.6, .45}})},
                       6);
        if (element.type != ElementType::triangle)
          {
            test_condition("harmonic tip",
                           element,
                           {line("tip", {{-.1, .37}, {.6, .45}})},
                           6,
                           CutTips::harmonic);
            test_condition("harmonic tip behind a vertex",
                           element,
                           {line("tip", {{-.1, -.1}, {.6, .6}})},
                           6,
                           CutTips::harmonic);
          }
        for (const double eps : {1e-1, 1e-3, 1e-5})
          if (element.type == ElementType::lagrange)
            {
              const double       y = .5 + eps / 4.;
              std::ostringstream size;
              size << eps;
              test_condition("parallel " + size.str(),
                             element,
                             {line("cut", {{-.1, y}, {1.1, y}})},
                             12);
              // It cuts corners of this size off two cells.
              const double s = 1. + eps / 4.;
              test_condition("corner " + size.str(),
                             element,
                             {line("cut", {{-.1, s + .1}, {s + .1, -.1}})},
                             12);
            }
      }
  }

  /** Cells of two or three sizes; the layer around the cuts is of one. */
  void
  test_hanging(const std::string           &name,
               const Element               &element,
               const std::vector<CutCurve> &cuts,
               const std::vector<Point<3>> &refined_at,
               const unsigned int           n_modes)
  {
    const CutShell shell(surface_text("u, v, 0", 5, 5),
                         element,
                         cuts,
                         {},
                         refined_at);
    const auto     values = scaled_eigenvalues(shell);
    const auto where = "hanging nodes, " + name + ", " + label(element) + ": ";
    check_below(where + std::to_string(n_modes) + " zero modes",
                std::abs(values[n_modes - 1]) / values[values.size() - 1],
                1e-10);
    check_below(where + "condition number of the others",
                values[values.size() - 1] / values[n_modes],
                1e6);
  }

  void
  test_all_hanging()
  {
    const CutCurve one    = line("one", {{-.1, .13}, {1.1, .17}});
    const CutCurve across = line("across", {{.11, -.1}, {.17, 1.1}});
    const CutCurve tip    = line("tip", {{-.1, .13}, {.5, .16}});
    const Element  p_2{ElementType::lagrange, 2};
    const Element  p_3{ElementType::lagrange, 3};
    // Beside the layer; that of the cut
    const Point<3> beside(.5, .5, 0.), at_cut(.1, .15, 0.);
    test_hanging("one cut", p_2, {one}, {at_cut}, 12);
    test_hanging("one cut", p_3, {one}, {beside}, 12);
    test_hanging("crossing", p_2, {one, across}, {beside}, 24);
    test_hanging("tip inside", p_2, {tip}, {beside}, 6);
  }

  /** v . M v of a mass of 1 per area beside the integral of v . v. */
  void
  test_mass(const Element &element)
  {
    const CutShell shell(square,
                         element,
                         {line("tip", {{-.1, .37}, {.6, .45}})},
                         {},
                         {},
                         CutTips::branch_functions);
    const auto    &discretization = *shell.discretization;
    auto           v = zero_vector(discretization), Mv = v;
    for (const auto i : v.locally_owned_elements())
      v[i] = std::fmod(0.6180339887498949 * i, 1.) - 0.3;
    v.compress(VectorOperation::insert);
    MassTerms(discretization).vmult(Mv, v);

    ShellCellValues                      values(discretization,
                           discretization.element().full_quadrature(),
                           false);
    std::vector<types::global_dof_index> dofs;
    double                               square_of_v = 0.;
    for (const CellPart &part : discretization.owned_parts())
      {
        discretization.get_dof_indices(part, dofs);
        values.reinit_frames(part);
        for (unsigned int q = 0; q < values.n_points(); ++q)
          {
            Tensor<1, 3> at_point;
            for (unsigned int a = 0; a < values.shapes().n_nodes(); ++a)
              for (unsigned int c = 0; c < 3; ++c)
                at_point[c] +=
                  values.shapes().value(q, a) * v(dofs[values.dof(a, c)]);
            for (unsigned int k = 0; k < values.n_tip_functions(); ++k)
              at_point += static_cast<double>(v(dofs[values.tip_dof(k)])) *
                          values.tip_function(q, k).value;
            square_of_v += values.JxW(q) * at_point.norm_square();
          }
      }
    check_below("mass of functions of a tip, " + label(element),
                std::abs(v * Mv / square_of_v - 1.),
                1e-11);
  }

  /** A cut along edges of cells is a mesh whose nodes are double there. */
  void
  test_seam(const Element &element)
  {
    const CutShell cut(square, element, {line("cut", {{.5, 1.1}, {.5, -.1}})});
    const CutShell half(surface_text("u, v, 0", 2, 4, "0, 0.5"), element, {});
    const auto     values     = scaled_eigenvalues(cut);
    const auto     expected   = scaled_eigenvalues(half);
    double         difference = values.size() == 2 * expected.size() ? 0. : 1.;
    for (unsigned int k = 0; k < values.size(); ++k)
      difference = std::max(difference, std::abs(values[k] - expected[k / 2]));
    check_below("seam, " + label(element) + ": eigenvalues", difference, 1e-12);
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_conditions();
  test_all_hanging();
  for (const auto &element :
       {Element{ElementType::lagrange, 2}, serendipity, triangle})
    test_seam(element);
  test_mass({ElementType::lagrange, 2});
  return n_failures > 0;
}
