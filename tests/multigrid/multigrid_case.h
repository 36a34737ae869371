// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_multigrid_case_h
#define nacre_tests_multigrid_case_h

#include "../tests_common.h"
#include <nacre/base/expression.h>
#include <nacre/discretization/displacement_conditions.h>
#include <nacre/forms/kinematics.h>
#include <nacre/multigrid/multigrid_solver.h>
#include <nacre/problem/midsurface.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

/** A shell of a parameter file, solved by multigrid. */
namespace MultigridTests
{
  using namespace Nacre;
  using TrilinosVector = TrilinosWrappers::MPI::Vector;
  using Mesh           = parallel::TriangulationBase<dim, spacedim>;

  inline bool
  is_root()
  {
    return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  /** Chooses the cells to refine by the position of their centre. */
  using Marker = std::function<bool(const Point<spacedim> &)>;

  struct NoParameters
  {
    NoParameters()
    {
      ParameterAcceptor::clear();
    }
  };

  /** Everything that a parameter file says; one object at a time. */
  struct Case : NoParameters
  {
    /** @param thickness instead of the file's, if not zero */
    explicit Case(const std::string &text, const double thickness = 0.)
      : model(read(text, thickness))
    {}

    std::unique_ptr<Discretization>
    discretize(const Element             &element,
               const unsigned int         n_refinements,
               const std::vector<Marker> &markers = {},
               const Cuts                &cuts    = {}) const
    {
      auto mesh =
        model.midsurface.create_triangulation(MPI_COMM_WORLD,
                                              element.reference_cell(),
                                              n_refinements);
      for (const auto &marker : markers)
        {
          for (const auto &cell : mesh->active_cell_iterators())
            if (cell->is_locally_owned() &&
                marker(model.midsurface.position(cell, Point<dim>(.5, .5))))
              cell->set_refine_flag();
          mesh->execute_coarsening_and_refinement();
        }
      return std::make_unique<Discretization>(std::move(mesh),
                                              model.midsurface,
                                              element,
                                              0,
                                              cuts);
    }

  private:
    ShellModel
    read(const std::string &text, const double thickness)
    {
      auto &prm = ParameterAcceptor::prm;
      prm.declare_entry("Constants", "");
      ParameterAcceptor::declare_all_parameters();
      prm.parse_input_from_string(text, "", true);
      ParameterAcceptor::parse_all_parameters();
      auto constants = parse_constants(prm.get("Constants"), "Constants");
      std::optional<double> given;
      if (thickness > 0.)
        given = thickness;
      const Constants of_section = section_.named_constants(constants, given);
      const Constants of_file    = constants;
      constants.insert(of_section.begin(), of_section.end());
      Midsurface midsurface = midsurface_.make(constants);
      auto       section = section_.make(of_file, given, midsurface.regions());
      ShellModel result{std::move(midsurface), std::move(section)};
      result.supports = supports_.make(result.midsurface, constants);
      result.loads    = loads_.make(result.midsurface, constants);
      return result;
    }

    LinearElasticSectionParameters section_;
    MidsurfaceParameters           midsurface_;
    BoundaryConditionParameters    supports_;
    LoadParameters                 loads_;

  public:
    /** Tests choose the kinematics and eta. */
    ShellModel model;
  };

  inline std::string
  read_file(const std::string &name)
  {
    std::ifstream      file(name);
    std::ostringstream text;
    text << file.rdbuf();
    AssertThrow(file, ExcMessage("no file " + name));
    return text.str();
  }

  /** The linear system of a mesh. */
  struct System
  {
    System(const ShellModel     &model,
           const Discretization &discretization,
           const TrilinosVector *u = nullptr)
      : conditions(discretization, model.supports)
      , assembly(discretization, model)
      , b(discretization.locally_owned_dofs(), MPI_COMM_WORLD)
    {
      assembly.reinit_matrix(conditions.constraints(), matrix);
      if (u == nullptr)
        assembly.assemble_system(conditions.constraints(), matrix, b);
      else
        assembly.assemble(*u, conditions.constraints(), matrix, b);
    }

    DisplacementConditions         conditions;
    Assembly                       assembly;
    TrilinosWrappers::SparseMatrix matrix;
    TrilinosVector                 b;
  };
} // namespace MultigridTests

#endif
