// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Cut shells: the patch test, another constant state in each piece, of all
// section laws; moments at edges; pieces that move as rigid bodies, each
// another way.

#include "cut_shell.h"
#include <nacre/discretization/shell_components.h>
#include <nacre/forms/rotation_jump.h>
#include <nacre/mechanics/shell_strain.h>

using namespace CutShells;

namespace
{
  /**
   * The strains (eps, rho) of n^11 = @p force and m^11 = @p moment in the
   * frame's basis, all other resultants zero, by Newton's method.
   */
  std::array<Voigt<>, 2>
  uniaxial_strains(const SectionLaw     &section,
                   const SurfaceFrame<> &frame,
                   const double          force,
                   const double          moment)
  {
    std::array<Voigt<>, 2> strains;
    FullMatrix<double>     tangent(6, 6);
    Vector<double>         r(6), step(6);
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        const auto [n, m, C, energy] =
          section.response(strains[0], strains[1], frame, Point<3>(), {});
        for (unsigned int i = 0; i < 3; ++i)
          {
            r[i]     = (i == 0 ? force : 0.) - n[i];
            r[3 + i] = (i == 0 ? moment : 0.) - m[i];
            for (unsigned int j = 0; j < 3; ++j)
              {
                tangent(i, j)         = C.membrane[i][j];
                tangent(i, 3 + j)     = C.coupling[i][j];
                tangent(3 + i, j)     = C.coupling[j][i];
                tangent(3 + i, 3 + j) = C.bending[i][j];
              }
          }
        tangent.gauss_jordan();
        tangent.vmult(step, r);
        for (unsigned int i = 0; i < 6; ++i)
          strains[i / 3][i % 3] += step[i];
      }
    return strains;
  }

  /** A displacement that has them at all points @p x of the frame's plane. */
  Vector3
  constant_strains(const std::array<Voigt<>, 2> &strains,
                   const SurfaceFrame<>         &frame,
                   const KinematicsModel         model,
                   const Vector3                &x)
  {
    const auto &[e, k]    = strains;
    const double x_1      = x * frame.a_cov[0];
    const double x_2      = x * frame.a_cov[1];
    const auto   gradient = [&](const double strain) {
      // Of Green strains if rotations are finite
      return model == KinematicsModel::finite ?
                 std::sqrt(1. + 2. * strain) - 1. :
                 strain;
    };
    return (gradient(e[0]) * x_1 + .5 * e[2] * x_2) * frame.a_cov[0] +
           (.5 * e[2] * x_1 + gradient(e[1]) * x_2) * frame.a_cov[1] -
           .5 * (k[0] * x_1 * x_1 + k[1] * x_2 * x_2 + k[2] * x_1 * x_2) *
             frame.t0;
  }

  struct Patch
  {
    std::string     name;
    std::string     section    = section_text(1000., 0.3, 0.1);
    MembraneStrain  strain     = MembraneStrain::tied;
    KinematicsModel kinematics = KinematicsModel::linear;
    /** Resultants n and m on either side. */
    std::array<std::array<double, 2>, 2> resultants{
      {{{1., .025}}, {{-2., -.04}}}};
  };

  /**
   * Constant tension and bending along an oblique cut, other ones on either
   * side of it: no force at nodes inside.
   */
  void
  test_patch(const Element               &element,
             const Patch                 &patch      = {},
             const std::vector<Point<3>> &refined_at = {})
  {
    const double      s = std::sin(.576), c = std::cos(.576);
    KinematicsOptions options;
    options.membrane_strain = patch.strain;
    options.model           = patch.kinematics;
    const CutShell shell(
      surface_text("u, v, 0", 8, 5, "0, 2", patch.section),
      element,
      {line("cut", {{1. - 3. * c, .5 - 3. * s}, {1. + 3. * c, .5 + 3. * s}})},
      options,
      refined_at);
    const auto frame =
      make_surface_frame(Vector3{{c, s, 0.}}, Vector3{{-s, c, 0.}}, {});
    std::array<std::array<Voigt<>, 2>, 2> strains;
    for (unsigned int side = 0; side < 2; ++side)
      strains[side] = uniaxial_strains(*shell.parameters.model.section,
                                       frame,
                                       patch.resultants[side][0],
                                       patch.resultants[side][1]);
    const auto u =
      shell.interpolate([&](const CellPart &part, const Point<3> &X) {
        const auto inside = shell.discretization->point_inside(part);
        const bool above  = c * (inside[1] - .5) - s * (inside[0] - 1.) > 0.;
        return constant_strains(strains[above],
                                frame,
                                patch.kinematics,
                                X - Point<3>(1., .5, 0.)) +
               Vector3{{0., 0., above ? .01 : -.02}};
      });
    TrilinosWrappers::SparseMatrix matrix;
    auto                           force = zero_vector(*shell.discretization);
    const auto &constraints = shell.discretization->node_constraints();
    shell.assembly->reinit_matrix(constraints, matrix);
    shell.assembly->assemble(u, constraints, matrix, force);
    const auto   on_boundary = shell.boundary_dofs();
    double       inside = 0., outside = 0.;
    unsigned int n_inside = 0;
    for (unsigned int i = 0; i < on_boundary.size(); ++i)
      if (!constraints.is_constrained(i))
        {
          double &largest = on_boundary[i] ? outside : inside;
          largest         = std::max(largest, std::abs(force(i)));
          n_inside += on_boundary[i] ? 0 : 1;
        }
    const auto name = "patch, " + patch.name + label(element) + ", " +
                      name_of(patch.strain) +
                      (refined_at.empty() ? "" : ", hanging nodes");
    check_below(name + ": force inside", inside / outside, 1e-9);
    check_above(name + ": nodes inside", n_inside, 60);
  }

  /**
   * Compare m_nn of each dof at the points of @p edge with that of the strains
   * of @p values there: the largest difference, and size.
   */
  void
  compare_moments(const ShellEdgeValues &edge,
                  const ShellCellValues &values,
                  const SectionLaw      &section,
                  double                &error,
                  double                &size)
  {
    JumpSide side;
    for (unsigned int q = 0; q < edge.n_points(); ++q)
      {
        side.reinit(edge, 0, q, section);
        const auto C = section.stiffness(values.frame(q), values.point(q));
        const auto dyad =
          ShellStrain::dyad_of(values.frame(q), edge.conormal(0, q));
        const auto compare = [&](const unsigned int i, const double found) {
          Voigt<> eps, rho;
          for (unsigned int v = 0; v < 3; ++v)
            {
              eps[v] = values.membrane_rows()(3 * q + v, i);
              rho[v] = values.bending_rows()(3 * q + v, i);
            }
          const double expected =
            dyad * (transpose(C.coupling) * eps + C.bending * rho);
          size  = std::max(size, std::abs(expected));
          error = std::max(error, std::abs(found - expected));
        };
        for (unsigned int a = 0; a < side.moment.size(); ++a)
          for (unsigned int c = 0; c < 3; ++c)
            {
              Vector3 u;
              u[c] = 1.;
              compare(values.dof(a, c), side.moment_of(a, u));
            }
        for (unsigned int k = 0; k < side.tip_moment.size(); ++k)
          compare(values.tip_dof(k), side.tip_moment[k]);
      }
  }

  /** Moments at edges are those of the strains of the part itself. */
  void
  test_edge_moments(const Element     &element,
                    const std::string &position,
                    const CutTips      tips = CutTips::closed)
  {
    const CutShell        shell(surface_text(position, 4, 4, "0, 1", laminate),
                         element,
                         {line("cut", {{-.1, .37}, {.6, .45}})},
                         MembraneStrain::tied,
                         {},
                         tips);
    const Discretization &space = *shell.discretization;
    ShellEdgeValues       edge(space);
    double                error = 0., size = 0.;
    unsigned int          n_cut = 0, n_functions = 0;
    for (const CellPart &part : space.owned_parts())
      for (const unsigned int face : part.cell->face_indices())
        for (const EdgePiece &piece : space.cell_parts().pieces_of(part, face))
          {
            edge.reinit(piece);
            ShellCellValues values(space,
                                   Quadrature<2>(edge.unit_points(0)),
                                   true,
                                   ShellCellValues::Points::given);
            values.reinit(part);
            compare_moments(edge,
                            values,
                            *shell.parameters.model.section,
                            error,
                            size);
            n_cut += part.is_cut();
            if (part.enrichment() != nullptr)
              n_functions += part.enrichment()->n_functions();
          }
    const auto name =
      "moments at edges, " + label(element) + ", " + name_of(tips) + ": ";
    check_below(name + "difference from the part's", error / size, 1e-11);
    check_above(name + "edges of divided cells", n_cut, 10);
    if (tips != CutTips::closed)
      check_above(name + "functions of tips", n_functions, 10);
  }

  /** Two pieces of a curved shell, each moved as a rigid body. */
  void
  test_finite_motions(const Element               &element,
                      const KinematicsModel        model,
                      const std::vector<Point<3>> &refined_at = {})
  {
    const double   E = 100., h = .2;
    const CutShell shell(
      surface_text(
        "u + 0.1*sin(3*v), v + 0.1*sin(2*u), 0.3*u^2 + 0.2*cos(3*v + u)",
        4,
        3,
        "-1, 1",
        section_text(E, .3, h)),
      element,
      {line("cut", {{-1.1, .35}, {0., .41}, {1.1, .69}})},
      {MembraneStrain::tied,
       EdgeForm::rotation_jump,
       model,
       TangentType::consistent},
      refined_at);
    const ShellComponents components(*shell.discretization);
    const VectorField     motions[] = {
          rigid_motion(Vector3{{1.9, -1.2, .8}}, Vector3{{.3, -2., 1.}}),
          rigid_motion(Vector3{{-.4, .9, 2.1}}, Vector3{{1., .5, -.7}})};
    const auto u =
      shell.interpolate([&](const CellPart &part, const Point<3> &X) {
        return motions[components.of(part)](X);
      });
    auto force = zero_vector(*shell.discretization);
    shell.assembly->residual(u, force);
    const auto name =
      "two finite motions, " + label(element) + ", " +
      (model == KinematicsModel::finite ? "finite: " : "corotational: ") +
      (refined_at.empty() ? "" : "hanging nodes, ");
    unsigned int n_followers = 0;
    for (unsigned int i = 0; i < shell.discretization->n_dofs(); ++i)
      n_followers +=
        shell.discretization->node_constraints().is_constrained(i) ? 1 : 0;
    check_above(name + "pieces", components.size(), 1);
    check_above(name + "followers", n_followers, 10);
    // The shell is two long, and moves by more
    check_below(name + "force over E h u",
                force.linfty_norm() / (E * h * u.linfty_norm()),
                1e-12);
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  Patch                            coupled, plastic, rubber;
  coupled.name       = "laminate, ";
  coupled.section    = laminate;
  coupled.resultants = {{{{.02, .0015}}, {{-.04, -.0025}}}};
  plastic.name       = "elastoplastic, ";
  plastic.section    = section_text(1000., 0.3, 0.1) +
                    "subsection Section\n set Type = elastoplastic\n"
                    " subsection Plasticity\n  set Yield stress = 5\n"
                    "  set Hardening modulus = 200\n end\nend\n";
  plastic.resultants = {{{{.7, .005}}, {{-.6, -.008}}}};
  rubber.name        = "neo-Hookean, ";
  rubber.section     = "subsection Section\n set Type = neo-Hookean\n"
                       " set Thickness = 0.1\n subsection Neo-Hookean\n"
                       "  set Shear modulus = 10\n end\nend\n";
  rubber.kinematics  = KinematicsModel::finite;
  rubber.resultants  = {{{{.8, 0.}}, {{-.3, 0.}}}};
  for (const auto &element : {Element{ElementType::lagrange, 2},
                              Element{ElementType::lagrange, 3},
                              triangle})
    {
      test_patch(element);
      test_patch(element, coupled);
    }
  Patch full, reduced;
  full.strain    = MembraneStrain::full;
  reduced.strain = MembraneStrain::reduced;
  test_patch({ElementType::lagrange, 2}, full);
  test_patch(serendipity, reduced);
  test_patch({ElementType::lagrange, 2}, plastic);
  test_patch({ElementType::lagrange, 2}, rubber);
  for (const auto &element : {Element{ElementType::lagrange, 3}, triangle})
    test_edge_moments(element, "u, v, 0.3*u^2 + 0.2*cos(3*v + u)");
  for (const auto tips : {CutTips::harmonic, CutTips::branch_functions})
    test_edge_moments({ElementType::lagrange, 2}, "u, v, 0", tips);
  for (const auto model :
       {KinematicsModel::corotational, KinematicsModel::finite})
    for (const auto &element : {Element{ElementType::lagrange, 2},
                                Element{ElementType::lagrange, 3},
                                triangle})
      test_finite_motions(element, model);

  // Smaller cells beside the layer around the cut, then the cut's smaller, too
  const std::vector<Point<3>> corners{{.1, .9, 0.}, {1.9, .1, 0.}};
  auto                        all = corners;
  all.emplace_back(1., .5, 0.);
  const Element quadratic{ElementType::lagrange, 2};
  test_patch({ElementType::lagrange, 3}, coupled, corners);
  test_patch(quadratic, {}, all);
  test_finite_motions(quadratic,
                      KinematicsModel::finite,
                      {{.63, -.7, .12}, {.09, .41, .07}});
  test_finite_motions(serendipity, KinematicsModel::finite, {{.63, -.7, .12}});
  return n_failures > 0;
}
