// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/mutation.h>
#include <nacre/forms/matrix_scatter.h>
#include <nacre/forms/shell_operator.h>
#include <nacre/forms/shell_pattern.h>
#include <nacre/problem/boundary_conditions.h>
#include <nacre/problem/loads.h>

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

    std::unique_ptr<Kinematics> kinematics;
    ShellEdgeValues             edge;
    dealii::Vector<double>      u;
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

  ShellOperator::ShellOperator(const Discretization        &discretization,
                               const SectionLaw            &section,
                               const BoundaryConditions    &boundary_conditions,
                               const Loads                 &loads,
                               const KinematicsOptions     &kinematics_options,
                               const std::optional<double> &eta)
    : discretization_(discretization)
    , section_(section)
    , boundary_conditions_(boundary_conditions)
    , loads_(loads)
    , penalty_(discretization,
               section,
               // Strains that vanish at few points only must not count as none.
               discretization.element().full_quadrature(),
               eta)
    , kinematics_(make_kinematics(discretization, section, kinematics_options))
    , symmetrizes_(kinematics_options.tangent != TangentType::consistent)
    , has_deformed_levers_(kinematics_options.model != KinematicsModel::linear)
  {
    locate_point_forces();
    AssertThrow(!loads_.has_pressure() || is_consistently_oriented(),
                ExcMessage("Loads/Pressure: neighbouring cells have opposite "
                           "normals, so that a pressure has no direction; use "
                           "Force per area."));
  }

  void
  ShellOperator::locate_point_forces()
  {
    for (const auto &force : loads_.point_forces())
      force_points_.push_back(
        discretization_.locate(force.position, force.source));
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
    assemble_at(nullptr, nullptr, constraints, matrix, right_hand_side);
  }

  Energies
  ShellOperator::assemble(const Vector                    &u,
                          const AffineConstraints<double> &constraints,
                          Matrix                          &matrix,
                          Vector                          &right_hand_side,
                          const Inertia                   *inertia) const
  {
    return sum_over_ranks(
      assemble_at(&u, inertia, constraints, matrix, right_hand_side),
      discretization_.communicator());
  }

  Energies
  ShellOperator::assemble_at(const Vector                    *u,
                             const Inertia                   *inertia,
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
    loop(u, inertia, true, [&](const CopyData &copy) {
      copy.for_each([&](const LocalTerms  &terms,
                        const auto        &dofs,
                        const unsigned int n_done) {
        force = terms.residual;
        force *= -1.;
        if (u == nullptr || !symmetrizes_)
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
    add_point_forces(constraints, 1., right_hand_side);
    return sum;
  }

  Energies
  ShellOperator::residual(const Vector  &u,
                          Vector        &result,
                          const Inertia *inertia) const
  {
    result = 0.;
    Energies sum;
    loop(&u, inertia, false, [&](const CopyData &copy) {
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
    add_point_forces(none, -1., result);
    return sum_over_ranks(sum, discretization_.communicator());
  }

  Energies
  ShellOperator::energies(const Vector &u) const
  {
    Vector result(discretization_.locally_owned_dofs(),
                  discretization_.communicator());
    return residual(u, result);
  }

  void
  ShellOperator::loop(const Vector  *u,
                      const Inertia *inertia,
                      const bool     wants_tangent,
                      const Copier  &copier) const
  {
    using Iterator = DoFHandler<dim, spacedim>::active_cell_iterator;

    const auto cell_worker =
      [&](const Iterator &cell, ScratchData &scratch, CopyData &copy) {
        this->cell_worker(cell, u, inertia, scratch, copy);
      };
    const auto face_worker = [&](const Iterator    &cell,
                                 const unsigned int f,
                                 const unsigned int sf,
                                 const Iterator    &neighbor,
                                 const unsigned int nf,
                                 const unsigned int nsf,
                                 ScratchData       &scratch,
                                 CopyData          &copy) {
      scratch.edge.reinit(cell, f, sf, neighbor, nf, nsf);
      FaceCopy &face = copy.next_face();
      face.dofs      = scratch.edge.dof_indices();
      face.terms.reinit(face.dofs.size());
      extract(u, face.dofs, scratch.u);
      scratch.kinematics->add_edge_terms(scratch.edge,
                                         penalty_.interior(cell, neighbor),
                                         scratch.u,
                                         face.terms);
      copy.take_block(face);
    };
    const auto boundary_worker = [&](const Iterator    &cell,
                                     const unsigned int f,
                                     ScratchData       &scratch,
                                     CopyData          &copy) {
      this->boundary_worker(cell, f, u, scratch, copy);
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
  ShellOperator::cell_worker(
    const DoFHandler<dim, spacedim>::active_cell_iterator &cell,
    const Vector                                          *u,
    const Inertia                                         *inertia,
    ScratchData                                           &scratch,
    CopyData                                              &copy) const
  {
    copy.terms.wants_tangent = copy.wants_tangent;
    copy.dofs.resize(cell->get_fe().n_dofs_per_cell());
    cell->get_dof_indices(copy.dofs);
    copy.terms.reinit(copy.dofs.size());
    extract(u, copy.dofs, scratch.u);
    scratch.kinematics->add_cell_terms(cell, scratch.u, copy.terms);
    if (!loads_.no_surface_load())
      subtract_surface_loads(scratch.kinematics->cell_values(),
                             copy.terms.residual);
    if (loads_.pressure_follows())
      subtract_following_pressure(scratch.kinematics->cell_values(),
                                  scratch.u,
                                  copy.terms);
    if (inertia != nullptr)
      inertia->add(cell,
                   copy.dofs,
                   discretization_.node_dofs(),
                   copy.terms.residual,
                   copy.wants_tangent ? &copy.terms.tangent : nullptr);
  }

  void
  ShellOperator::subtract_following_pressure(const ShellCellValues &values,
                                             const dealii::Vector<double> &u,
                                             LocalTerms &terms) const
  {
    const auto &shapes = values.shapes();
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        auto phi = values.frame(q).a_cov;
        for (unsigned int a = 0; u.size() > 0 && a < shapes.n_nodes(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            for (unsigned int alpha = 0; alpha < dim; ++alpha)
              phi[alpha][c] +=
                shapes.gradient(q, a)[alpha] * u[values.dof(a, c)];
        const double p =
          loads_.pressure(values.point(q)) * values.JxW(q) / values.frame(q).j0;
        const auto force = p * cross_product_3d(phi[0], phi[1]);
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            terms.residual[values.dof(a, c)] -= shapes.value(q, a) * force[c];
        if (!terms.wants_tangent)
          continue;
        for (unsigned int b = 0; b < shapes.n_nodes(); ++b)
          {
            // d(phi,1 x phi,2) = du,1 x phi,2 + phi,1 x du,2 = m x du
            const auto m = shapes.gradient(q, b)[1] * phi[0] -
                           shapes.gradient(q, b)[0] * phi[1];
            for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
              for (unsigned int c = 0; c < spacedim; ++c)
                {
                  const unsigned int d = (c + 1) % 3, e = (c + 2) % 3;
                  const double       w = p * shapes.value(q, a);
                  terms.tangent(values.dof(a, c), values.dof(b, e)) -=
                    NACRE_MUTABLE(following_tangent, 1., -1.) * w * m[d];
                  terms.tangent(values.dof(a, c), values.dof(b, d)) += w * m[e];
                }
          }
      }
  }

  void
  ShellOperator::subtract_surface_loads(const ShellCellValues  &values,
                                        dealii::Vector<double> &residual) const
  {
    const auto               &shapes = values.shapes();
    const unsigned int *const dofs   = discretization_.node_dofs().data();
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        const auto   x            = values.point(q);
        const double area_density = section_.density(x) * section_.thickness(x);
        const auto   load =
          values.JxW(q) *
          loads_.force_per_area(x, values.frame(q).t0, area_density);
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            residual[dofs[spacedim * a + c]] -= shapes.value(q, a) * load[c];
      }
  }

  void
  ShellOperator::boundary_worker(
    const DoFHandler<dim, spacedim>::active_cell_iterator &cell,
    const unsigned int                                     f,
    const Vector                                          *u,
    ScratchData                                           &scratch,
    CopyData                                              &copy) const
  {
    const auto id         = cell->face(f)->boundary_id();
    const auto conditions = boundary_conditions_.edges().find(id);
    const bool rotates    = (conditions != boundary_conditions_.edges().end() &&
                          conditions->second.rotation != nullptr);
    if (!rotates && loads_.edge_forces().count(id) == 0 &&
        loads_.edge_moments().count(id) == 0)
      return;

    scratch.edge.reinit(cell, f);
    FaceCopy &face = copy.next_face();
    face.dofs      = scratch.edge.dof_indices();
    face.terms.reinit(face.dofs.size());
    extract(u, face.dofs, scratch.u);
    if (rotates)
      {
        std::vector<double> rotation(scratch.edge.n_points());
        for (unsigned int q = 0; q < rotation.size(); ++q)
          rotation[q] = (*conditions->second.rotation)(scratch.edge.point(q));
        scratch.kinematics->add_rotation_terms(scratch.edge,
                                               penalty_.boundary(cell),
                                               rotation,
                                               scratch.u,
                                               face.terms);
      }
    add_edge_loads(id,
                   scratch.edge,
                   scratch.u,
                   *scratch.kinematics,
                   face.terms);
    copy.take_block(face);
  }

  void
  ShellOperator::add_edge_loads(const types::boundary_id      id,
                                const ShellEdgeValues        &edge,
                                const dealii::Vector<double> &u,
                                Kinematics                   &kinematics,
                                LocalTerms                   &terms) const
  {
    const auto moment = loads_.edge_moments().find(id);
    if (moment != loads_.edge_moments().end())
      {
        std::vector<double> values(edge.n_points());
        for (unsigned int q = 0; q < values.size(); ++q)
          values[q] = moment->second(edge.point(q));
        kinematics.add_moment_terms(edge, values, u, terms);
      }
    const auto force = loads_.edge_forces().find(id);
    if (force == loads_.edge_forces().end())
      return;
    const auto &shapes = edge.shapes(0);
    for (unsigned int q = 0; q < edge.n_points(); ++q)
      {
        const auto f = edge.JxW(q) * force->second(edge.point(q));
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            terms.residual[edge.dof(0, a, c)] -= shapes.value(q, a) * f[c];
      }
  }

  void
  ShellOperator::add_point_forces(const AffineConstraints<double> &constraints,
                                  const double                     factor,
                                  Vector                          &vector) const
  {
    const auto &fe = discretization_.scalar_fe();
    for (unsigned int k = 0; k < force_points_.size(); ++k)
      if (force_points_[k].is_mine)
        {
          const auto &place = force_points_[k];
          const auto  force =
            loads_.point_forces()[k].force(loads_.point_forces()[k].position);
          const auto             n = discretization_.node_dofs().size();
          dealii::Vector<double> local(n);
          std::vector<types::global_dof_index> dofs(n);
          place.cell->get_dof_indices(dofs);
          for (unsigned int a = 0; a < fe.n_dofs_per_cell(); ++a)
            for (unsigned int c = 0; c < spacedim; ++c)
              local[discretization_.node_dofs()[spacedim * a + c]] =
                factor * fe.shape_value(a, place.unit) * force[c];
          constraints.distribute_local_to_global(local, dofs, vector);
        }
    vector.compress(VectorOperation::add);
  }

  Tensor<1, spacedim>
  ShellOperator::rotation_reaction(const types::boundary_id id,
                                   const Vector            &u) const
  {
    Tensor<1, spacedim> sum;
    const auto          conditions = boundary_conditions_.edges().find(id);
    if (conditions != boundary_conditions_.edges().end() &&
        conditions->second.rotation != nullptr)
      {
        ScratchData scratch(discretization_, *kinematics_);
        LocalTerms  terms;
        terms.wants_tangent = false;
        for (const auto &cell :
             discretization_.dof_handler().active_cell_iterators())
          if (cell->is_locally_owned())
            for (const auto f : cell->face_indices())
              if (cell->at_boundary(f) && cell->face(f)->boundary_id() == id)
                {
                  auto &edge = scratch.edge;
                  edge.reinit(cell, f);
                  std::vector<double> rotation(edge.n_points());
                  for (unsigned int q = 0; q < rotation.size(); ++q)
                    rotation[q] = (*conditions->second.rotation)(edge.point(q));
                  terms.reinit(edge.n_dofs());
                  extract(&u, edge.dof_indices(), scratch.u);
                  scratch.kinematics->add_rotation_terms(edge,
                                                         penalty_.boundary(
                                                           cell),
                                                         rotation,
                                                         scratch.u,
                                                         terms);
                  // Virtual work on the rigid rotation e_k x x.
                  const auto nodes = discretization_.node_positions(cell);
                  for (unsigned int a = 0; a < nodes.size(); ++a)
                    {
                      Tensor<1, spacedim> x(nodes[a]), force;
                      for (unsigned int c = 0; c < spacedim; ++c)
                        {
                          force[c] = terms.residual[edge.dof(0, a, c)];
                          if (has_deformed_levers_)
                            x[c] += scratch.u[edge.dof(0, a, c)];
                        }
                      sum += cross_product_3d(x, force);
                    }
                }
      }
    return Utilities::MPI::sum(sum, discretization_.communicator());
  }

  bool
  ShellOperator::is_consistently_oriented() const
  {
    ShellEdgeValues edge(discretization_);
    bool            consistent = true;
    for (const auto &cell :
         discretization_.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto f : cell->face_indices())
          if (!cell->at_boundary(f) && cell->neighbor(f)->is_active() &&
              !cell->neighbor_is_coarser(f))
            {
              edge.reinit(cell,
                          f,
                          numbers::invalid_unsigned_int,
                          cell->neighbor(f),
                          cell->neighbor_of_neighbor(f),
                          numbers::invalid_unsigned_int);
              consistent &= (edge.sigma(1, 0) > 0.);
            }
    return Utilities::MPI::min(consistent ? 1 : 0,
                               discretization_.communicator()) == 1;
  }
} // namespace Nacre
