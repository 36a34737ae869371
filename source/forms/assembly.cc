// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/forms/assembly.h>
#include <nacre/forms/matrix_scatter.h>
#include <nacre/forms/shell_pattern.h>

#include <deal.II/meshworker/mesh_loop.h>

#include <algorithm>

namespace Nacre
{
  struct Assembly::FaceCopy
  {
    LocalTerms                           terms;
    std::vector<types::global_dof_index> dofs;
    /** Leading rows and columns of the tangent that the cell's has taken. */
    unsigned int n_done = 0;
  };

  /** What one part of a cell and its edges give. */
  struct Assembly::PartCopy
  {
    LocalTerms                           terms;
    std::vector<types::global_dof_index> dofs;
    std::vector<FaceCopy>                faces;
    /** Faces in use; their storage is kept from cell to cell. */
    unsigned int n_faces = 0;

    /** Call @p add(terms, dofs, n_done) for the part and its faces. */
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
     * The part's dofs are the first of each of its faces: add that block of
     * the tangent to the part's, which goes into the matrix anyway.
     */
    void
    take_block(FaceCopy &face)
    {
      face.n_done = (terms.wants_tangent ? dofs.size() : 0);
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
      faces[n_faces].terms.wants_tangent = terms.wants_tangent;
      faces[n_faces].n_done              = 0;
      return faces[n_faces++];
    }
  };

  struct Assembly::CopyData
  {
    bool                  wants_tangent = true;
    std::vector<PartCopy> parts         = std::vector<PartCopy>(1);

    CopyData()                      = default;
    CopyData(const CopyData &other) = default;

    /**
     * mesh_loop() resets by assignment: forget what the cell gave, but keep
     * the storage. Cells of other ranks leave it at that.
     */
    CopyData &
    operator=(const CopyData &other)
    {
      wants_tangent = other.wants_tangent;
      for (auto &part : parts)
        {
          part.terms.energies = Energies();
          part.dofs.clear();
          part.n_faces = 0;
        }
      return *this;
    }

    template <typename Function>
    void
    for_each(const Function &add) const
    {
      for (const auto &part : parts)
        part.for_each(add);
    }

    /** Of the part number @p k; @p n parts have room. */
    PartCopy &
    start(const unsigned int k, const unsigned int n)
    {
      if (parts.size() < n)
        parts.resize(n);
      parts[k].terms.wants_tangent = wants_tangent;
      return parts[k];
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

    const StepStart *
    start_of(const Inertia *inertia)
    {
      return inertia != nullptr ? inertia->start : nullptr;
    }

    Energies
    sum_over_ranks(const Energies &mine, const MPI_Comm communicator)
    {
      Energies sum;
      sum.membrane   = Utilities::MPI::sum(mine.membrane, communicator);
      sum.bending    = Utilities::MPI::sum(mine.bending, communicator);
      sum.edge       = Utilities::MPI::sum(mine.edge, communicator);
      sum.foundation = Utilities::MPI::sum(mine.foundation, communicator);
      return sum;
    }
  } // namespace

  /** What a loop calls for cells, interior edges and boundary edges. */
  class Assembly::Worker
  {
  public:
    Worker(const Assembly &shell, const TermPointers &terms, const State &state)
      : shell_(shell)
      , terms_(terms)
      , state_(state)
      , acts_on_lips_(
          std::any_of(terms.begin(),
                      terms.end(),
                      [](const Term *term) { return term->acts_on_lips(); }))
      , kinematics_(shell.kinematics_->clone())
      , edge_(shell.discretization_)
    {
      kinematics_->set_instant(state.actions.loads);
    }

    /** mesh_loop() copies it: scratch data of its own. */
    Worker(const Worker &other)
      : Worker(other.shell_, other.terms_, other.state_)
    {}

    void
    work_on_cell(const Cell &cell, CopyData &copy)
    {
      const unsigned int n = cell_parts().n_parts(cell);
      for (unsigned int k = 0; k < n; ++k)
        {
          const CellPart part   = cell_parts().part(cell, k);
          PartCopy      &result = copy.start(k, n);
          shell_.discretization_.get_dof_indices(part, result.dofs);
          result.terms.reinit(result.dofs.size());
          extract_state(result.dofs);
          TermCell place(part,
                         result.dofs,
                         local_,
                         state_.actions,
                         *kinematics_);
          for (const Term *term : terms_)
            term->add_on_cell(place, result.terms);
          if (acts_on_lips_)
            add_on_lips(part, result);
        }
    }

    void
    work_between_cells(const Cell        &cell,
                       const unsigned int face,
                       const unsigned int subface,
                       const Cell        &neighbor,
                       const unsigned int neighbor_face,
                       const unsigned int neighbor_subface,
                       CopyData          &copy)
    {
      if (cell_parts().has_pieces(cell, face))
        for (const EdgePiece &piece : cell_parts().pieces_between(cell, face))
          {
            edge_.reinit(piece);
            add_between_cells(copy.parts[piece.sides[0].part.data->number]);
          }
      else
        {
          edge_.reinit(cell,
                       face,
                       subface,
                       neighbor,
                       neighbor_face,
                       neighbor_subface);
          add_between_cells(copy.parts[0]);
        }
    }

    void
    work_on_boundary(const Cell &cell, const unsigned int face, CopyData &copy)
    {
      for (unsigned int k = 0; k < cell_parts().n_parts(cell); ++k)
        {
          const CellPart part = cell_parts().part(cell, k);
          if (!part.is_cut())
            add_on_boundary(EdgePiece(part, face), copy.parts[k]);
          else
            for (const auto &piece : cell_parts().pieces_of(part, face))
              add_on_boundary(piece, copy.parts[k]);
        }
    }

  private:
    const CellParts &
    cell_parts() const
    {
      return shell_.discretization_.cell_parts();
    }

    /** The terms of the edge between two parts. */
    void
    add_between_cells(PartCopy &copy)
    {
      FaceCopy      &result = start_edge(copy);
      const TermEdge place{edge_,
                           shell_.penalty_.interior(edge_.part(0),
                                                    edge_.part(1)),
                           local_,
                           state_.actions,
                           *kinematics_,
                           numbers::internal_face_boundary_id,
                           {}};
      for (const Term *term : terms_)
        term->add_between_cells(place, result.terms);
      copy.take_block(result);
    }

    void
    add_on_boundary(const EdgePiece &piece, PartCopy &copy)
    {
      const auto &[part, face, interval] = piece.sides[0];
      const auto id                      = part.cell->face(face)->boundary_id();
      const auto key                     = piece.place();
      const auto acts                    = [&](const Term *term) {
        return term->acts_on_boundary(id, key, state_.actions);
      };
      if (std::none_of(terms_.begin(), terms_.end(), acts))
        return;
      if (part.is_cut())
        edge_.reinit(piece);
      else
        edge_.reinit(part.cell, face);
      FaceCopy      &result = start_edge(copy);
      const TermEdge place{edge_,
                           shell_.penalty_.boundary(part),
                           local_,
                           state_.actions,
                           *kinematics_,
                           id,
                           key};
      for (const Term *term : terms_)
        if (acts(term))
          term->add_on_boundary(place, result.terms);
      copy.take_block(result);
    }

    void
    add_on_lips(const CellPart &part, PartCopy &copy)
    {
      for (const CutLip &lip : cell_parts().lips(part))
        {
          edge_.reinit_lip(part, lip);
          FaceCopy      &result = start_edge(copy);
          const TermEdge place{edge_,
                               shell_.penalty_.boundary(part),
                               local_,
                               state_.actions,
                               *kinematics_,
                               numbers::internal_face_boundary_id,
                               {}};
          for (const Term *term : terms_)
            if (term->acts_on_lips())
              term->add_on_lip(place, lip, result.terms);
          copy.take_block(result);
        }
    }

    /** The state on the edge, and zero terms. */
    FaceCopy &
    start_edge(PartCopy &copy)
    {
      FaceCopy &result = copy.next_face();
      result.dofs      = edge_.dof_indices();
      result.terms.reinit(result.dofs.size());
      extract_state(result.dofs);
      return result;
    }

    void
    extract_state(const std::vector<types::global_dof_index> &dofs)
    {
      extract(state_.u, dofs, local_.u);
      if (state_.start == nullptr)
        return;
      extract(&state_.start->u, dofs, local_.u_start);
      local_.u_end = local_.u;
      local_.u_end.sadd(2., -1., local_.u_start);
      local_.rotations_start = &state_.start->rotations;
    }

    const Assembly             &shell_;
    const TermPointers         &terms_;
    const State                &state_;
    const bool                  acts_on_lips_;
    std::unique_ptr<Kinematics> kinematics_;
    ShellEdgeValues             edge_;
    LocalState                  local_;
  };

  Assembly::Assembly(const Discretization &discretization,
                     const ShellParts     &parts,
                     const TermSelection   selection)
    : discretization_(discretization)
    , penalty_(discretization,
               parts.section,
               // Strains that vanish at few points only must not count as none.
               discretization.element().full_quadrature(),
               parts.eta)
    , section_states_(std::make_unique<SectionStates>(parts.section))
    , kinematics_(make_kinematics(discretization,
                                  parts.section,
                                  parts.kinematics,
                                  section_states_.get()))
    , rotation_conditions_(discretization,
                           parts.supports,
                           parts.load_factor,
                           penalty_,
                           *kinematics_)
    , terms_(make_terms(discretization, parts, selection))
    , symmetrizes_(parts.kinematics.tangent != TangentType::consistent)
  {}

  Assembly::TermPointers
  Assembly::terms_at(const State &state) const
  {
    TermPointers terms;
    for (const auto &term : terms_)
      terms.push_back(term.get());
    if (state.inertia != nullptr)
      terms.push_back(state.inertia);
    return terms;
  }

  void
  Assembly::update_section_states(const Vector       &u,
                                  const ShellActions &actions) const
  {
    section_states_->update(discretization_, [&]() {
      Vector unused(discretization_.locally_owned_dofs(),
                    discretization_.communicator());
      residual(u, actions, unused);
    });
  }

  void
  Assembly::reinit_matrix(const AffineConstraints<double> &constraints,
                          Matrix                          &matrix) const
  {
    make_shell_pattern(discretization_, constraints, matrix);
  }

  void
  Assembly::assemble_system(const AffineConstraints<double> &constraints,
                            Matrix                          &matrix,
                            Vector &right_hand_side) const
  {
    const ShellActions at_start = actions(Instant());
    assemble_at({nullptr, at_start}, constraints, matrix, right_hand_side);
  }

  Energies
  Assembly::assemble(const Vector                    &u,
                     const ShellActions              &actions,
                     const AffineConstraints<double> &constraints,
                     Matrix                          &matrix,
                     Vector                          &right_hand_side,
                     const Inertia                   *inertia) const
  {
    return sum_over_ranks(assemble_at({&u, actions, inertia, start_of(inertia)},
                                      constraints,
                                      matrix,
                                      right_hand_side),
                          discretization_.communicator());
  }

  Energies
  Assembly::assemble_at(const State                     &state,
                        const AffineConstraints<double> &constraints,
                        Matrix                          &matrix,
                        Vector                          &right_hand_side) const
  {
    matrix          = 0.;
    right_hand_side = 0.;
    MatrixScatter          scatter(constraints, matrix, right_hand_side);
    dealii::Vector<double> force;
    FullMatrix<double>     tangent;
    Energies               sum;
    const TermPointers     terms = terms_at(state);
    loop(terms, state, true, [&](const CopyData &copy) {
      copy.for_each([&](const LocalTerms  &local,
                        const auto        &dofs,
                        const unsigned int n_done) {
        force = local.residual;
        force *= -1.;
        if (state.u == nullptr || !symmetrizes_)
          scatter.add(local.tangent, force, dofs, n_done);
        else
          {
            // Nearly symmetric: its symmetric part iterates as well, and
            // suits a symmetric solver.
            tangent = local.tangent;
            tangent.symmetrize();
            scatter.add(tangent, force, dofs, n_done);
          }
        sum += local.energies;
      });
    });
    matrix.compress(VectorOperation::add);
    right_hand_side.compress(VectorOperation::add);
    for (const Term *term : terms)
      term->add_point_forces(constraints, state.actions, right_hand_side);
    return sum;
  }

  Energies
  Assembly::residual(const Vector       &u,
                     const ShellActions &actions,
                     Vector             &result,
                     const Inertia      *inertia) const
  {
    const State    state{&u, actions, inertia, start_of(inertia)};
    const Energies mine = sum_residuals(terms_at(state), state, result);
    return sum_over_ranks(mine, discretization_.communicator());
  }

  Energies
  Assembly::sum_residuals(const TermPointers &terms,
                          const State        &state,
                          Vector             &result) const
  {
    result = 0.;
    Energies sum;
    loop(terms, state, false, [&](const CopyData &copy) {
      copy.for_each(
        [&](const LocalTerms &local, const auto &dofs, unsigned int) {
          result.add(dofs,
                     std::vector<double>(local.residual.begin(),
                                         local.residual.end()));
          sum += local.energies;
        });
    });
    result.compress(VectorOperation::add);
    // Those of points go to the other side of the equation.
    AffineConstraints<double> none;
    none.close();
    result *= -1.;
    for (const Term *term : terms)
      term->add_point_forces(none, state.actions, result);
    result *= -1.;
    return sum;
  }

  void
  Assembly::loads(const Vector    &u,
                  Vector          &result,
                  const Instant   &instant,
                  const StepStart *start) const
  {
    const ShellActions actions{instant, {}};
    TermPointers       loads;
    for (const auto &term : terms_)
      if (term->is_load())
        loads.push_back(term.get());
    sum_residuals(loads, {&u, actions, nullptr, start}, result);
    result *= -1.;
  }

  Energies
  Assembly::energies(const Vector &u, const ShellActions &actions) const
  {
    Vector result(discretization_.locally_owned_dofs(),
                  discretization_.communicator());
    return residual(u, actions, result);
  }

  void
  Assembly::loop(const TermPointers &terms,
                 const State        &state,
                 const bool          wants_tangent,
                 const Copier       &copier) const
  {
    const auto cell_worker =
      [](const Cell &cell, Worker &worker, CopyData &copy) {
        worker.work_on_cell(cell, copy);
      };
    const auto boundary_worker = [](const Cell        &cell,
                                    const unsigned int face,
                                    Worker            &worker,
                                    CopyData          &copy) {
      worker.work_on_boundary(cell, face, copy);
    };
    const auto face_worker = [](const Cell        &cell,
                                const unsigned int face,
                                const unsigned int subface,
                                const Cell        &neighbor,
                                const unsigned int neighbor_face,
                                const unsigned int neighbor_subface,
                                Worker            &worker,
                                CopyData          &copy) {
      worker.work_between_cells(cell,
                                face,
                                subface,
                                neighbor,
                                neighbor_face,
                                neighbor_subface,
                                copy);
    };
    auto what =
      MeshWorker::assemble_own_cells | MeshWorker::assemble_boundary_faces;
    if (std::any_of(terms.begin(), terms.end(), [](const Term *term) {
          return term->acts_between_cells();
        }))
      what = what | MeshWorker::assemble_own_interior_faces_once |
             MeshWorker::assemble_ghost_faces_once;
    CopyData copy;
    copy.wants_tangent = wants_tangent;
    // The user's expressions may be undefined on the cells of one rank only.
    run_on_all_ranks(discretization_.communicator(), [&]() {
      MeshWorker::mesh_loop(discretization_.dof_handler().begin_active(),
                            discretization_.dof_handler().end(),
                            cell_worker,
                            copier,
                            Worker(*this, terms, state),
                            copy,
                            what,
                            boundary_worker,
                            face_worker);
    });
  }
} // namespace Nacre
