// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_cut_shell_h
#define nacre_tests_cut_shell_h

// A shell that cuts divide, for tests of its forms.

#include "../finite/finite_shell.h"
#include <nacre/discretization/part_transfer.h>
#include <nacre/mechanics/shell_section.h>
#include <nacre/postprocess/refinement_marking.h>
#include <nacre/problem/cuts.h>

#include <random>

namespace CutShells
{
  constexpr auto uv = CutCurve::Coordinates::chart;

  inline CutCurve
  line(const std::string &name, const std::vector<Point<2>> &uv_points)
  {
    std::vector<Point<3>> points;
    for (const auto &x : uv_points)
      points.emplace_back(x[0], x[1], 0.);
    return {name, uv, points, false};
  }

  inline std::string
  surface_text(const std::string &position,
               const unsigned int n_u,
               const unsigned int n_v,
               const std::string &range_u = "0, 1",
               const std::string &section = section_text(1000., 0.3, 0.1))
  {
    return "subsection Mid-surface\n set Surface = expression\n"
           " set Subdivisions = " +
           std::to_string(n_u) + ", " + std::to_string(n_v) +
           "\n subsection expression\n  set Position = " + position +
           "\n  set Range u = " + range_u + "\n end\nend\n" + section;
  }

  /** The stack of a laminate that couples membrane and bending. */
  const std::string laminate =
    "subsection Section\n set Type = laminate\n subsection Laminate\n"
    "  set Materials = a: E1 = 25, E2 = 1, nu12 = 0.25, G12 = 0.5\n"
    "  set Stack = [0/90/30]\n  set Thickness = 0.2\n end\nend\n";

  /** A shell and its parts; the cells at @p refined_at are quartered. */
  struct CutShell
  {
    CutShell(const std::string           &text,
             const Element               &element,
             const std::vector<CutCurve> &curves,
             const KinematicsOptions     &options    = {},
             const std::vector<Point<3>> &refined_at = {},
             const CutTips                tips       = CutTips::closed)
      : parameters(text)
      , tips(tips)
      , kinematics(options)
    {
      const auto &model = parameters.model;
      make_discretization(
        model.midsurface.create_triangulation(MPI_COMM_WORLD,
                                              element.reference_cell(),
                                              0),
        element,
        curves);
      for (const auto &point : refined_at)
        refine(point, element, curves);
      if (element.type == ElementType::serendipity)
        kinematics.membrane_strain = MembraneStrain::reduced;
      assembly = std::make_unique<Assembly>(*discretization,
                                            ShellParts(*model.section,
                                                       model.supports,
                                                       model.loads,
                                                       kinematics,
                                                       {}));
    }

    using Mesh = parallel::TriangulationBase<2, 3>;

    void
    make_discretization(std::unique_ptr<Mesh>        mesh,
                        const Element               &element,
                        const std::vector<CutCurve> &curves)
    {
      Cuts cuts;
      cuts.curves         = curves;
      cuts.tips           = tips;
      cuts.tips_turn      = kinematics.model != KinematicsModel::linear;
      cuts.poissons_ratio = [](const auto &, const auto &, const auto &) {
        return 0.3;
      };
      discretization =
        std::make_unique<Discretization>(std::move(mesh),
                                         parameters.model.midsurface,
                                         element,
                                         0,
                                         cuts);
    }

    /** Quarter the cells at @p point. The @p fields, and what they become. */
    std::vector<TrilinosVector>
    refine(const Point<3>                            &point,
           const Element                             &element,
           const std::vector<CutCurve>               &curves,
           const std::vector<const TrilinosVector *> &fields = {})
    {
      std::vector<bool> marked(discretization->triangulation().n_active_cells(),
                               false);
      marked[discretization->nearest(point).part.cell->active_cell_index()] =
        true;
      RefinementMarking::add_cells_along_cuts(*discretization, marked);
      PartTransfer transfer(*discretization, fields);
      auto         mesh = discretization->release_triangulation();
      discretization.reset();
      transfer.refine(*mesh, marked);
      make_discretization(std::move(mesh), element, curves);
      std::vector<TrilinosVector> result;
      for (unsigned int k = 0; k < fields.size(); ++k)
        result.push_back(transfer.field_on(*discretization, k));
      return result;
    }

    /** Nodal values of a field of each part; followers follow. */
    TrilinosVector
    interpolate(const std::function<Vector3(const CellPart &, const Point<3> &)>
                  &field) const
    {
      auto                                 u = zero_vector(*discretization);
      std::vector<types::global_dof_index> dofs;
      for (const CellPart &part : discretization->owned_parts())
        {
          discretization->get_dof_indices(part, dofs);
          const auto nodes = discretization->node_positions(part);
          for (unsigned int a = 0; a < nodes.size(); ++a)
            {
              const auto value = field(part, nodes[a]);
              for (unsigned int c = 0; c < 3; ++c)
                u(dofs[discretization->node_dofs()[3 * a + c]]) = value[c];
            }
        }
      u.compress(VectorOperation::insert);
      discretization->node_constraints().distribute(u);
      return u;
    }

    /** Dofs of parts that meet the boundary, or that these follow. */
    std::vector<bool>
    boundary_dofs() const
    {
      std::vector<bool> result(discretization->n_dofs(), false);
      std::vector<types::global_dof_index> dofs;
      for (const CellPart &part : discretization->owned_parts())
        for (const unsigned int face : part.cell->face_indices())
          if (part.cell->at_boundary(face) &&
              !discretization->cell_parts().pieces_of(part, face).empty())
            {
              discretization->get_dof_indices(part, dofs);
              for (const auto dof : dofs)
                {
                  result[dof] = true;
                  const auto entries =
                    discretization->node_constraints().get_constraint_entries(
                      dof);
                  if (entries != nullptr)
                    for (const auto &entry : *entries)
                      result[entry.first] = true;
                }
            }
      return result;
    }

    TextModelOf<ShellSectionParameters> parameters;
    const CutTips                       tips;
    KinematicsOptions                   kinematics;
    std::unique_ptr<Discretization>     discretization;
    std::unique_ptr<Assembly>           assembly;
  };

  /** Numbers below @p size, the same ones each time. */
  inline TrilinosVector
  random_field(const Discretization &discretization, const double size)
  {
    std::mt19937                           engine(4);
    std::uniform_real_distribution<double> number(-size, size);
    auto                                   u = zero_vector(discretization);
    for (unsigned int i = 0; i < discretization.n_dofs(); ++i)
      u(i) = number(engine);
    u.compress(VectorOperation::insert);
    discretization.node_constraints().distribute(u);
    return u;
  }
} // namespace CutShells

#endif
