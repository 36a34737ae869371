// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/forms/matrix_scatter.h>
#include <nacre/forms/shell_operator.h>
#include <nacre/forms/shell_pattern.h>
#include <nacre/problem/shell_model.h>

#include <deal.II/meshworker/mesh_loop.h>

namespace Nacre
{
  struct ShellOperator::ScratchData
  {
    ScratchData(const Discretization &discretization,
                const Kinematics     &kinematics)
      : kinematics(kinematics.clone())
      , edge(discretization)
    {}

    ScratchData(const ScratchData &other)
      : kinematics(other.kinematics->clone())
      , edge(other.edge)
    {}

    /** Set both ends of a step of which u is the mean. */
    void
    set_ends(const StepStart                            &start,
             const std::vector<types::global_dof_index> &dofs);

    std::unique_ptr<Kinematics> kinematics;
    ShellEdgeValues             edge;
    dealii::Vector<double>      u;
    dealii::Vector<double>      u_start;
    dealii::Vector<double>      u_end;
  };

  struct ShellOperator::FaceCopy
  {
    LocalTerms                           terms;
    std::vector<types::global_dof_index> dofs;
    /** Leading rows and columns of the tangent that the cell's has taken. */
    unsigned int n_done = 0;
  };

  struct ShellOperator::CopyData
  {
    bool                                 wants_tangent = true;
    LocalTerms                           terms;
    std::vector<types::global_dof_index> dofs;
    std::vector<FaceCopy>                faces;
    /** Faces in use; their storage is kept from cell to cell. */
    unsigned int n_faces = 0;

    CopyData()                      = default;
    CopyData(const CopyData &other) = default;

    /**
     * mesh_loop() resets by assignment: forget what the cell gave, but keep
     * the storage. Cells of other ranks leave it at that.
     */
    CopyData &
    operator=(const CopyData &other)
    {
      wants_tangent  = other.wants_tangent;
      terms.energies = Energies();
      dofs.clear();
      n_faces = 0;
      return *this;
    }

    /** Call @p add(terms, dofs, n_done) for the cell and its faces. */
    template <typename Function>
    void
    for_each(const Function &add) const
    {
      if (!dofs.empty())
        add(terms, dofs, 0);
      for (unsigned int f = 0; f < n_faces; ++f)
        add(faces[f].terms, faces[f].dofs, faces[f].n_done);
    }

    /**
     * The cell's dofs are the first of each of its faces: add that block of
     * the tangent to the cell's, which goes into the matrix anyway.
     */
    void
    take_block(FaceCopy &face)
    {
      face.n_done = (wants_tangent ? dofs.size() : 0);
      for (unsigned int i = 0; i < face.n_done; ++i)
        {
          const double *from = &face.terms.tangent(i, 0);
          double       *to   = &terms.tangent(i, 0);
          for (unsigned int j = 0; j < face.n_done; ++j)
            to[j] += from[j];
        }
    }

    FaceCopy &
    next_face()
    {
      if (n_faces == faces.size())
        faces.emplace_back();
      faces[n_faces].terms.wants_tangent = wants_tangent;
      faces[n_faces].n_done              = 0;
      return faces[n_faces++];
    }
  };

  namespace
  {
    /** Values of @p u (zero if null) at @p dofs. */
    void
    extract(const TrilinosWrappers::MPI::Vector        *u,
            const std::vector<types::global_dof_index> &dofs,
            Vector<double>                             &local)
    {
      if (u == nullptr)
        {
          local.reinit(0);
          return;
        }
      local.reinit(dofs.size(), true);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        local[i] = (*u)(dofs[i]);
    }

    Energies
    sum_over_ranks(const Energies &mine, const MPI_Comm communicator)
    {
      Energies sum;
      sum.membrane = Utilities::MPI::sum(mine.membrane, communicator);
      sum.bending  = Utilities::MPI::sum(mine.bending, communicator);
      sum.edge     = Utilities::MPI::sum(mine.edge, communicator);
      return sum;
    }
  } // namespace

  void
  ShellOperator::ScratchData::set_ends(
    const StepStart                            &start,
    const std::vector<types::global_dof_index> &dofs)
  {
    extract(&start.u, dofs, u_start);
    u_end = u;
    u_end.sadd(2., -1., u_start);
  }

  ShellOperator::ShellOperator(const Discretization &discretization,
                               const ShellModel     &model)
    : ShellOperator(discretization,
                    model.section,
                    model.supports,
                    model.loads,
                    model.kinematics,
                    model.eta,
                    model.load_factor ? &*model.load_factor : nullptr)
  {}

  ShellOperator::ShellOperator(const Discretization        &discretization,
                               const SectionLaw            &section,
                               const BoundaryConditions    &boundary_conditions,
                               const Loads                 &loads,
                               const KinematicsOptions     &kinematics_options,
                               const std::optional<double> &eta,
                               const Expression            *load_factor)
    : discretization_(discretization)
    , section_(section)
    , boundary_conditions_(boundary_conditions)
    , loads_(loads)
    , load_terms_(discretization, section, loads)
    , penalty_(discretization,
               section,
               // Strains that vanish at few points only must not count as none.
               discretization.element().full_quadrature(),
               eta)
    , kinematics_(make_kinematics(discretization, section, kinematics_options))
    , symmetrizes_(kinematics_options.tangent != TangentType::consistent)
    , has_deformed_levers_(kinematics_options.model != KinematicsModel::linear)
    , load_factor_(load_factor)
  {
    AssertThrow(!loads_.has_pressure() || is_consistently_oriented(),
                ExcMessage("Loads/Pressure: neighbouring cells have opposite "
                           "normals, so that a pressure has no direction; use "
                           "Force per area."));
  }

  void
  ShellOperator::reinit_matrix(const AffineConstraints<double> &constraints,
                               Matrix                          &matrix) const
  {
    make_shell_pattern(discretization_, constraints, matrix);
  }

  void
  ShellOperator::assemble_system(const AffineConstraints<double> &constraints,
                                 Matrix                          &matrix,
                                 Vector &right_hand_side) const
  {
    const ShellActions at_start = actions(Instant());
    assemble_at({nullptr, at_start, nullptr},
                constraints,
                matrix,
                right_hand_side);
  }

  Energies
  ShellOperator::assemble(const Vector                    &u,
                          const ShellActions              &actions,
                          const AffineConstraints<double> &constraints,
                          Matrix                          &matrix,
                          Vector                          &right_hand_side,
                          const Inertia                   *inertia) const
  {
    return sum_over_ranks(
      assemble_at({&u, actions, inertia}, constraints, matrix, right_hand_side),
      discretization_.communicator());
  }

  Energies
  ShellOperator::assemble_at(const State                     &state,
                             const AffineConstraints<double> &constraints,
                             Matrix                          &matrix,
                             Vector &right_hand_side) const
  {
    matrix          = 0.;
    right_hand_side = 0.;
    MatrixScatter          scatter(constraints, matrix, right_hand_side);
    dealii::Vector<double> force;
    FullMatrix<double>     tangent;
    Energies               sum;
    loop(state, true, [&](const CopyData &copy) {
      copy.for_each([&](const LocalTerms  &terms,
                        const auto        &dofs,
                        const unsigned int n_done) {
        force = terms.residual;
        force *= -1.;
        if (state.u == nullptr || !symmetrizes_)
          scatter.add(terms.tangent, force, dofs, n_done);
        else
          {
            // Nearly symmetric: its symmetric part iterates as well, and
            // suits a symmetric solver.
            tangent = terms.tangent;
            tangent.symmetrize();
            scatter.add(tangent, force, dofs, n_done);
          }
        sum += terms.energies;
      });
    });
    matrix.compress(VectorOperation::add);
    right_hand_side.compress(VectorOperation::add);
    load_terms_.add_point_forces(constraints,
                                 1.,
                                 state.actions.loads,
                                 right_hand_side);
    return sum;
  }

  Energies
  ShellOperator::residual(const Vector       &u,
                          const ShellActions &actions,
                          Vector             &result,
                          const Inertia      *inertia) const
  {
    result = 0.;
    Energies sum;
    loop({&u, actions, inertia}, false, [&](const CopyData &copy) {
      copy.for_each(
        [&](const LocalTerms &terms, const auto &dofs, unsigned int) {
          result.add(dofs,
                     std::vector<double>(terms.residual.begin(),
                                         terms.residual.end()));
          sum += terms.energies;
        });
    });
    result.compress(VectorOperation::add);
    AffineConstraints<double> none;
    none.close();
    load_terms_.add_point_forces(none, -1., actions.loads, result);
    return sum_over_ranks(sum, discretization_.communicator());
  }

  Energies
  ShellOperator::energies(const Vector &u, const ShellActions &actions) const
  {
    Vector result(discretization_.locally_owned_dofs(),
                  discretization_.communicator());
    return residual(u, actions, result);
  }

  void
  ShellOperator::loop(const State  &state,
                      const bool    wants_tangent,
                      const Copier &copier) const
  {
    const StepStart *const start = state.start();

    const auto cell_worker =
      [&](const Cell &cell, ScratchData &scratch, CopyData &copy) {
        this->cell_worker(cell, state, scratch, copy);
      };
    const auto face_worker = [&](const Cell        &cell,
                                 const unsigned int f,
                                 const unsigned int sf,
                                 const Cell        &neighbor,
                                 const unsigned int nf,
                                 const unsigned int nsf,
                                 ScratchData       &scratch,
                                 CopyData          &copy) {
      scratch.edge.reinit(cell, f, sf, neighbor, nf, nsf);
      FaceCopy &face = copy.next_face();
      face.dofs      = scratch.edge.dof_indices();
      face.terms.reinit(face.dofs.size());
      extract(state.u, face.dofs, scratch.u);
      const double penalty = penalty_.interior(cell, neighbor);
      if (start == nullptr)
        scratch.kinematics->add_edge_terms(scratch.edge,
                                           penalty,
                                           scratch.u,
                                           face.terms);
      else
        {
          scratch.set_ends(*start, face.dofs);
          scratch.kinematics->add_edge_step_terms(scratch.edge,
                                                  penalty,
                                                  scratch.u_start,
                                                  scratch.u_end,
                                                  face.terms);
        }
      copy.take_block(face);
    };
    const auto boundary_worker = [&](const Cell        &cell,
                                     const unsigned int f,
                                     ScratchData       &scratch,
                                     CopyData          &copy) {
      this->boundary_worker(cell, f, state, scratch, copy);
    };

    CopyData copy;
    copy.wants_tangent = wants_tangent;
    // The user's expressions may be undefined on the cells of one rank only.
    run_on_all_ranks(discretization_.communicator(), [&]() {
      MeshWorker::mesh_loop(discretization_.dof_handler().begin_active(),
                            discretization_.dof_handler().end(),
                            cell_worker,
                            copier,
                            ScratchData(discretization_, *kinematics_),
                            copy,
                            MeshWorker::assemble_own_cells |
                              MeshWorker::assemble_own_interior_faces_once |
                              MeshWorker::assemble_ghost_faces_once |
                              MeshWorker::assemble_boundary_faces,
                            boundary_worker,
                            face_worker);
    });
  }

  void
  ShellOperator::cell_worker(const Cell  &cell,
                             const State &state,
                             ScratchData &scratch,
                             CopyData    &copy) const
  {
    copy.terms.wants_tangent = copy.wants_tangent;
    copy.dofs.resize(cell->get_fe().n_dofs_per_cell());
    cell->get_dof_indices(copy.dofs);
    copy.terms.reinit(copy.dofs.size());
    extract(state.u, copy.dofs, scratch.u);
    if (state.start() == nullptr)
      scratch.kinematics->add_cell_terms(cell, scratch.u, copy.terms);
    else
      {
        scratch.set_ends(*state.start(), copy.dofs);
        scratch.kinematics->add_cell_step_terms(cell,
                                                scratch.u_start,
                                                scratch.u_end,
                                                copy.terms);
      }
    load_terms_.subtract_on_cell(scratch.kinematics->cell_values(),
                                 scratch.u,
                                 scratch.u_start,
                                 state.actions.loads,
                                 copy.terms);
    if (state.inertia != nullptr)
      state.inertia->add(cell,
                         copy.dofs,
                         discretization_.node_dofs(),
                         copy.terms.residual,
                         copy.wants_tangent ? &copy.terms.tangent : nullptr);
  }

  void
  ShellOperator::boundary_worker(const Cell        &cell,
                                 const unsigned int f,
                                 const State       &state,
                                 ScratchData       &scratch,
                                 CopyData          &copy) const
  {
    const auto                          id = cell->face(f)->boundary_id();
    const std::pair<unsigned, unsigned> place{cell->active_cell_index(), f};
    const auto rotation = state.actions.rotations.find(place);
    const bool rotates  = (rotation != state.actions.rotations.end());
    if (!rotates && !load_terms_.act_on(id))
      return;

    scratch.edge.reinit(cell, f);
    FaceCopy &face = copy.next_face();
    face.dofs      = scratch.edge.dof_indices();
    face.terms.reinit(face.dofs.size());
    extract(state.u, face.dofs, scratch.u);
    if (rotates && state.start() == nullptr)
      scratch.kinematics->add_rotation_terms(scratch.edge,
                                             penalty_.boundary(cell),
                                             rotation->second,
                                             scratch.u,
                                             face.terms);
    else if (rotates)
      {
        scratch.set_ends(*state.start(), face.dofs);
        scratch.kinematics->add_rotation_step_terms(scratch.edge,
                                                    penalty_.boundary(cell),
                                                    state.start()->rotations.at(
                                                      place),
                                                    rotation->second,
                                                    scratch.u_start,
                                                    scratch.u_end,
                                                    face.terms);
      }
    load_terms_.subtract_on_edge(id,
                                 scratch.edge,
                                 scratch.u,
                                 state.actions.loads,
                                 *scratch.kinematics,
                                 face.terms);
    copy.take_block(face);
  }
} // namespace Nacre
