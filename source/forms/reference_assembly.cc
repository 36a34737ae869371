// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/discretization.h>
#include <nacre/forms/kinematics.h>
#include <nacre/forms/reference_assembly.h>
#include <nacre/forms/reference_strains.h>
#include <nacre/mechanics/section_law.h>
#include <nacre/mechanics/shell_strain.h>
#include <nacre/problem/boundary_conditions.h>
#include <nacre/problem/foundation.h>
#include <nacre/problem/loads.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_interface_values.h>
#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/meshworker/mesh_loop.h>

namespace Nacre
{
  using namespace ReferenceStrains;

  namespace
  {
    const UpdateFlags geometry_flags =
      update_quadrature_points | update_jacobians | update_jacobian_grads;

    const UpdateFlags shape_flags = update_values | update_gradients |
                                    update_hessians | update_JxW_values |
                                    geometry_flags;
  } // namespace


  /** What a thread of the loop needs for a cell and its edges. */
  struct ReferenceAssembly::ScratchData
  {
    ScratchData(const Discretization &discretization,
                const MembraneStrain  membrane_strain)
      : discretization(discretization)
      , membrane(membrane_strain)
      , quadrature(cell_quadrature(discretization.element(), membrane_strain))
      , blends(blends_integration(discretization.element(), membrane_strain))
      , tying(
          membrane_strain == MembraneStrain::tied ?
            MembraneTying(discretization.element(), quadrature.get_points()) :
            MembraneTying::untied(quadrature.get_points()))
      , cell(discretization.mapping(),
             discretization.dof_handler().get_fe(),
             quadrature,
             shape_flags)
      , samples(discretization.mapping(),
                discretization.dof_handler().get_fe(),
                Quadrature<dim>(tying.points()),
                update_gradients | geometry_flags)
      , edge_samples(discretization.mapping(),
                     discretization.dof_handler().get_fe(),
                     Quadrature<dim>(
                       MembraneTying(discretization.element(), {}).points()),
                     update_gradients | geometry_flags)
      , reduced(discretization.mapping(),
                discretization.dof_handler().get_fe(),
                discretization.element().reduced_quadrature(),
                update_gradients | update_hessians | update_JxW_values |
                  geometry_flags)
      , edge(discretization.mapping(),
             discretization.dof_handler().get_fe(),
             discretization.element().edge_quadrature(),
             shape_flags | update_normal_vectors)
    {}

    ScratchData(const ScratchData &other)
      : ScratchData(other.discretization, other.membrane)
    {}

    const Discretization &discretization;
    const MembraneStrain  membrane;
    const Quadrature<dim> quadrature;
    /** Whether the membrane energy is part reduced, part full. */
    const bool              blends;
    const MembraneTying     tying;
    FEValues<dim, spacedim> cell;
    /** At the points where tied membrane strains are sampled. */
    FEValues<dim, spacedim> samples;
    /** Those for the membrane strains at edges, which are always tied. */
    FEValues<dim, spacedim>          edge_samples;
    FEValues<dim, spacedim>          reduced;
    FEInterfaceValues<dim, spacedim> edge;
  };


  /** Local matrices and vectors of a cell and of its edges. */
  struct ReferenceAssembly::CopyData
  {
    struct Part
    {
      FullMatrix<double>                   matrix;
      dealii::Vector<double>               vector;
      std::vector<types::global_dof_index> dofs;
    };

    Part &
    add_part(const std::vector<types::global_dof_index> &dofs)
    {
      parts.emplace_back();
      parts.back().matrix.reinit(dofs.size(), dofs.size());
      parts.back().vector.reinit(dofs.size());
      parts.back().dofs = dofs;
      return parts.back();
    }

    std::vector<Part> parts;
  };


  namespace
  {
    /** matrix += weight strain(i) : stiffness : strain(j). */
    void
    add_energy(const std::vector<Voigt<>> &strain,
               const VoigtMatrix<>        &stiffness,
               const double                weight,
               FullMatrix<double>         &matrix)
    {
      for (unsigned int i = 0; i < strain.size(); ++i)
        {
          const Voigt<> resultant = stiffness * strain[i];
          for (unsigned int j = 0; j < strain.size(); ++j)
            matrix(i, j) += weight * (resultant * strain[j]);
        }
    }

    /** matrix += weight (eps(i) : B : rho(j) + rho(i) : B^T : eps(j)). */
    void
    add_coupling(const std::vector<Voigt<>> &eps,
                 const VoigtMatrix<>        &B,
                 const std::vector<Voigt<>> &rho,
                 const double                weight,
                 FullMatrix<double>         &matrix)
    {
      for (unsigned int j = 0; j < rho.size(); ++j)
        {
          const Voigt<> n = B * rho[j];
          for (unsigned int i = 0; i < eps.size(); ++i)
            {
              matrix(i, j) += weight * (eps[i] * n);
              matrix(j, i) += weight * (eps[i] * n);
            }
        }
    }

    /** Virtual work of the forces that initial strains take off n or m. */
    void
    add_initial_work(const std::vector<Voigt<>> &strain,
                     const Voigt<>              &force,
                     const double                weight,
                     dealii::Vector<double>     &vector)
    {
      for (unsigned int i = 0; i < strain.size(); ++i)
        vector(i) += weight * (strain[i] * force);
    }

    /** Share of the full rule, min(1, h^2 / |K|), where rules are blended. */
    double
    full_share(const FEValues<dim, spacedim> &cell, const SectionLaw &section)
    {
      double area = 0., volume = 0.;
      for (const unsigned int q : cell.quadrature_point_indices())
        {
          area += cell.JxW(q);
          volume += cell.JxW(q) * section.thickness(section_point(cell, q));
        }
      const double h = volume / area;
      return std::min(1., h * h / area);
    }
  } // namespace


  ReferenceAssembly::ReferenceAssembly(const Discretization &discretization,
                                       const ShellParts     &parts,
                                       const EdgePenalty    &penalty)
    : discretization_(discretization)
    , parts_(parts)
    , penalty_(penalty)
  {}


  void
  ReferenceAssembly::reinit_matrix(const AffineConstraints<double> &constraints,
                                   Matrix &matrix) const
  {
    const IndexSet        &owned    = discretization_.locally_owned_dofs();
    const IndexSet        &relevant = discretization_.locally_relevant_dofs();
    DynamicSparsityPattern pattern(owned.size(), owned.size(), relevant);
    DoFTools::make_flux_sparsity_pattern(discretization_.dof_handler(),
                                         pattern,
                                         constraints,
                                         false);
    SparsityTools::distribute_sparsity_pattern(pattern,
                                               owned,
                                               discretization_.communicator(),
                                               relevant);
    matrix.reinit(owned, owned, pattern, discretization_.communicator());
  }


  void
  ReferenceAssembly::assemble_cell(const Iterator &cell,
                                   ScratchData    &scratch,
                                   CopyData       &copy) const
  {
    const auto &fe_values = scratch.cell;
    scratch.cell.reinit(cell);
    scratch.samples.reinit(cell);
    std::vector<types::global_dof_index> dofs(fe_values.dofs_per_cell);
    cell->get_dof_indices(dofs);
    auto &part = copy.add_part(dofs);

    const double share =
      scratch.blends ? full_share(fe_values, parts_.section) : 1.;
    const auto samples = sample_membrane_strain(scratch.tying, scratch.samples);
    std::vector<Voigt<>> rho(dofs.size());
    for (const unsigned int q : fe_values.quadrature_point_indices())
      {
        const auto   frame = frame_at(fe_values, q);
        const auto   x     = section_point(fe_values, q);
        const double dA    = fe_values.JxW(q);
        const auto   H     = parts_.section.stiffness(frame, x); // (8)-(10)

        // (N.10): eps(v):H_n:eps(u) + rho(v):H_m:rho(u)
        const auto eps = tied_membrane_strain(scratch.tying, samples, q);
        for (const unsigned int i : fe_values.dof_indices())
          rho[i] = bending_strain(fe_values, frame, i, q);
        add_energy(eps, H.membrane, share * dA, part.matrix);
        add_energy(rho, H.bending, dA, part.matrix);
        // Coupling: eps(v):B:rho(u) + rho(v):B^T:eps(u)
        if (parts_.section.is_coupled())
          add_coupling(eps, H.coupling, rho, share * dA, part.matrix);
        // n0:eps(v) + m0:rho(v), what initial strains take off n and m
        const auto held = parts_.section.initial_forces(frame, x, Instant());
        add_initial_work(eps, held.membrane_force, share * dA, part.vector);
        add_initial_work(rho, held.moment, dA, part.vector);

        // f . v
        const double area_density =
          parts_.section.density(x) * parts_.section.thickness(x);
        const auto f = parts_.loads.force_per_area(x, frame.t0, area_density);
        for (const unsigned int i : fe_values.dof_indices())
          part.vector(i) += f * fe_values[displacement].value(i, q) * dA;
        if (parts_.foundation == nullptr || parts_.foundation->is_zero())
          continue;
        // k_n (u . t0) (v . t0) + k_t (u . v - (u . t0) (v . t0))
        const auto [k_n, k_t] = parts_.foundation->stiffness(x);
        for (const unsigned int i : fe_values.dof_indices())
          for (const unsigned int j : fe_values.dof_indices())
            {
              const auto   u   = fe_values[displacement].value(j, q);
              const auto   v   = fe_values[displacement].value(i, q);
              const double u_v = u * v;
              const double w_w = (u * frame.t0) * (v * frame.t0);
              part.matrix(i, j) += (k_n * w_w + k_t * (u_v - w_w)) * dA;
            }
      }
    if (share == 1.)
      return;
    scratch.reduced.reinit(cell);
    std::vector<Voigt<>> eps(dofs.size());
    const bool           is_coupled = parts_.section.is_coupled();
    for (const unsigned int q : scratch.reduced.quadrature_point_indices())
      {
        const auto frame = frame_at(scratch.reduced, q);
        const auto H =
          parts_.section.stiffness(frame, section_point(scratch.reduced, q));
        const double dA = (1. - share) * scratch.reduced.JxW(q);
        for (unsigned int i = 0; i < eps.size(); ++i)
          {
            eps[i] = membrane_strain(scratch.reduced, frame, i, q);
            if (is_coupled)
              rho[i] = bending_strain(scratch.reduced, frame, i, q);
          }
        add_energy(eps, H.membrane, dA, part.matrix);
        if (is_coupled)
          add_coupling(eps, H.coupling, rho, dA, part.matrix);
        const auto held =
          parts_.section.initial_forces(frame,
                                        section_point(scratch.reduced, q),
                                        Instant());
        add_initial_work(eps, held.membrane_force, dA, part.vector);
      }
  }


  namespace
  {
    /** Rotation and moment of one side of an edge at a point, for each dof. */
    struct EdgeSide
    {
      EdgeSide(const FEValuesBase<dim, spacedim> &fe_values,
               const unsigned int                 q,
               const Tensor<1, spacedim>         &nu,
               const SectionLaw                  &section,
               const TiedEdgeStrain              &tied)
        : frame(frame_at(fe_values, q))
        , nu(nu)
        , theta(fe_values.dofs_per_cell)
        , m_nn(fe_values.dofs_per_cell)
      {
        const auto H = section.stiffness(frame, section_point(fe_values, q));
        // nu . m . nu = (nu nu) : (B^T : eps + D : rho), and D(nu, nu, nu, nu)
        const auto nu_nu = ShellStrain::dyad_of(frame, nu);
        D                = nu_nu * (H.bending * nu_nu);
        m0_nn =
          nu_nu *
          section.initial_forces(frame, section_point(fe_values, q), Instant())
            .moment;
        for (unsigned int i = 0; i < theta.size(); ++i)
          {
            theta[i] = rotation(fe_values, frame.t0, nu, i, q);
            m_nn[i] =
              nu_nu * (H.bending * bending_strain(fe_values, frame, i, q));
          }
        if (section.is_coupled())
          {
            const auto eps = tied.at(q);
            for (unsigned int i = 0; i < theta.size(); ++i)
              m_nn[i] += (H.coupling * nu_nu) * eps[i];
          }
      }

      /** The tangent of the edge, as this side sees it. */
      Tensor<1, spacedim>
      tangent() const
      {
        return cross_product_3d(nu, frame.t0);
      }

      SurfaceFrame<>      frame;
      Tensor<1, spacedim> nu;
      double              D     = 0.;
      double              m0_nn = 0.;
      std::vector<double> theta;
      std::vector<double> m_nn;
    };
  } // namespace


  void
  ReferenceAssembly::assemble_edge(const Iterator    &cell,
                                   const unsigned int face,
                                   const unsigned int subface,
                                   const Iterator    &neighbor,
                                   const unsigned int neighbor_face,
                                   const unsigned int neighbor_subface,
                                   ScratchData       &scratch,
                                   CopyData          &copy) const
  {
    auto &edge = scratch.edge;
    edge.reinit(cell, face, subface, neighbor, neighbor_face, neighbor_subface);
    auto                &part = copy.add_part(edge.get_interface_dof_indices());
    const auto          &minus = edge.get_fe_face_values(0);
    const auto          &plus  = edge.get_fe_face_values(1);
    const double         eta   = penalty_.interior(cell, neighbor);
    const auto           n     = edge.n_current_interface_dofs();
    const TiedEdgeStrain tied_minus(discretization_,
                                    parts_.section,
                                    scratch.edge_samples,
                                    cell,
                                    face,
                                    subface);
    const TiedEdgeStrain tied_plus(discretization_,
                                   parts_.section,
                                   scratch.edge_samples,
                                   neighbor,
                                   neighbor_face,
                                   neighbor_subface);

    std::vector<double> jump(n), mean(n);
    for (const unsigned int q : edge.quadrature_point_indices())
      {
        // Each side has its own frame: nu^- = n^-, nu^+ = -n^+.
        const EdgeSide side_minus(minus,
                                  q,
                                  minus.normal_vector(q),
                                  parts_.section,
                                  tied_minus);
        const EdgeSide side_plus(plus,
                                 q,
                                 -plus.normal_vector(q),
                                 parts_.section,
                                 tied_plus);
        // A neighbour of the opposite orientation enters with the other sign.
        const double sigma =
          side_plus.tangent() * side_minus.tangent() > 0. ? 1. : -1.;
        for (unsigned int i = 0; i < n; ++i)
          {
            const auto [i_minus, i_plus] = edge.interface_dof_to_dof_indices(i);
            jump[i] = mean[i] = 0.;
            if (i_minus != numbers::invalid_unsigned_int)
              {
                jump[i] -= side_minus.theta[i_minus];
                mean[i] += 0.5 * side_minus.m_nn[i_minus];
              }
            if (i_plus != numbers::invalid_unsigned_int)
              {
                jump[i] += sigma * side_plus.theta[i_plus];
                mean[i] += 0.5 * sigma * side_plus.m_nn[i_plus];
              }
          }
        // (N.12): eta D [[theta]][[theta]] - {m_nn}[[theta]] - [[theta]]{m_nn}
        const double D  = 0.5 * (side_minus.D + side_plus.D);
        const double m0 = 0.5 * (side_minus.m0_nn + sigma * side_plus.m0_nn);
        for (unsigned int i = 0; i < n; ++i)
          {
            // The moment of stresses is {m_nn} - {m0_nn}.
            part.vector(i) -= m0 * jump[i] * minus.JxW(q);
            for (unsigned int j = 0; j < n; ++j)
              part.matrix(i, j) += (eta * D * jump[i] * jump[j] -
                                    mean[i] * jump[j] - jump[i] * mean[j]) *
                                   minus.JxW(q);
          }
      }
  }


  void
  ReferenceAssembly::assemble_boundary(const Iterator    &cell,
                                       const unsigned int face,
                                       ScratchData       &scratch,
                                       CopyData          &copy) const
  {
    const auto id     = cell->face(face)->boundary_id();
    const auto edge   = parts_.supports.edges().find(id);
    const auto force  = parts_.loads.edge_forces().find(id);
    const auto moment = parts_.loads.edge_moments().find(id);
    const bool rotates =
      edge != parts_.supports.edges().end() && edge->second.rotation;

    scratch.edge.reinit(cell, face);
    const auto  &fe_values = scratch.edge.get_fe_face_values(0);
    auto        &part = copy.add_part(scratch.edge.get_interface_dof_indices());
    const double eta  = penalty_.boundary(cell);
    const TiedEdgeStrain tied(discretization_,
                              parts_.section,
                              scratch.edge_samples,
                              cell,
                              face,
                              numbers::invalid_unsigned_int);
    for (const unsigned int q : fe_values.quadrature_point_indices())
      {
        const auto     x  = fe_values.quadrature_point(q);
        const double   ds = fe_values.JxW(q);
        const EdgeSide side(fe_values,
                            q,
                            fe_values.normal_vector(q),
                            parts_.section,
                            tied);
        for (const unsigned int i : fe_values.dof_indices())
          {
            if (force != parts_.loads.edge_forces().end())
              part.vector(i) +=
                force->second(x) * fe_values[displacement].value(i, q) * ds;
            if (moment != parts_.loads.edge_moments().end())
              part.vector(i) -= moment->second(x) * side.theta[i] * ds;
            if (!rotates)
              continue;
            // (N.15), (N.16): 2 eta D theta theta + m_nn theta + theta m_nn
            const double test =
              2. * eta * side.D * side.theta[i] + side.m_nn[i];
            part.vector(i) += (test * (*edge->second.rotation)(x) +
                               side.m0_nn * side.theta[i]) *
                              ds;
            for (const unsigned int j : fe_values.dof_indices())
              part.matrix(i, j) +=
                (test * side.theta[j] + side.theta[i] * side.m_nn[j]) * ds;
          }
      }
  }


  void
  ReferenceAssembly::add_point_forces(
    const AffineConstraints<double> &constraints,
    Vector                          &right_hand_side) const
  {
    for (const auto &point_force : parts_.loads.point_forces())
      {
        const auto place =
          discretization_.locate(point_force.position, point_force.source);
        if (!place.is_mine)
          continue;
        const auto              force = point_force.force(point_force.position);
        FEValues<dim, spacedim> fe_values(
          discretization_.mapping(),
          discretization_.dof_handler().get_fe(),
          Quadrature<dim>(place.unit),
          update_values);
        fe_values.reinit(place.part.cell);
        std::vector<types::global_dof_index> dofs(fe_values.dofs_per_cell);
        place.part.cell->get_dof_indices(dofs);
        dealii::Vector<double> local(dofs.size());
        for (const unsigned int i : fe_values.dof_indices())
          local(i) = force * fe_values[displacement].value(i, 0);
        constraints.distribute_local_to_global(local, dofs, right_hand_side);
      }
    right_hand_side.compress(VectorOperation::add);
  }


  void
  ReferenceAssembly::assemble_system(
    const AffineConstraints<double> &constraints,
    Matrix                          &matrix,
    Vector                          &right_hand_side) const
  {
    matrix          = 0.;
    right_hand_side = 0.;
    const auto cell_worker =
      [this](const Iterator &cell, ScratchData &scratch, CopyData &copy) {
        assemble_cell(cell, scratch, copy);
      };
    const auto boundary_worker = [this](const Iterator    &cell,
                                        const unsigned int face,
                                        ScratchData       &scratch,
                                        CopyData          &copy) {
      assemble_boundary(cell, face, scratch, copy);
    };
    const auto edge_worker = [this](const Iterator    &cell,
                                    const unsigned int face,
                                    const unsigned int subface,
                                    const Iterator    &neighbor,
                                    const unsigned int neighbor_face,
                                    const unsigned int neighbor_subface,
                                    ScratchData       &scratch,
                                    CopyData          &copy) {
      assemble_edge(cell,
                    face,
                    subface,
                    neighbor,
                    neighbor_face,
                    neighbor_subface,
                    scratch,
                    copy);
    };
    const auto copier = [&](const CopyData &copy) {
      for (const auto &part : copy.parts)
        constraints.distribute_local_to_global(part.matrix,
                                               part.vector,
                                               part.dofs,
                                               matrix,
                                               right_hand_side);
    };
    // The user's expressions may be undefined on the cells of one rank only.
    run_on_all_ranks(discretization_.communicator(), [&]() {
      MeshWorker::mesh_loop(discretization_.dof_handler().begin_active(),
                            discretization_.dof_handler().end(),
                            cell_worker,
                            copier,
                            ScratchData(discretization_,
                                        parts_.kinematics.membrane_strain),
                            CopyData(),
                            MeshWorker::assemble_own_cells |
                              MeshWorker::assemble_own_interior_faces_once |
                              MeshWorker::assemble_ghost_faces_once |
                              MeshWorker::assemble_boundary_faces,
                            boundary_worker,
                            edge_worker);
    });
    matrix.compress(VectorOperation::add);
    right_hand_side.compress(VectorOperation::add);
    add_point_forces(constraints, right_hand_side);
  }
} // namespace Nacre
