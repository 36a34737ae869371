// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/shell_edge_values.h>
#include <nacre/forms/finite_edge.h>
#include <nacre/forms/foundation_term.h>
#include <nacre/forms/rotation_jump.h>
#include <nacre/postprocess/error_estimator.h>
#include <nacre/postprocess/error_weight.h>
#include <nacre/postprocess/residual_edges.h>
#include <nacre/postprocess/stress_polynomials.h>
#include <nacre/problem/shell_model.h>

#include <cmath>

namespace Nacre
{
  namespace
  {
    using Vector3  = Tensor<1, spacedim>;
    using Tensor3  = Tensor<2, spacedim>;
    using Iterator = DoFHandler<dim, spacedim>::active_cell_iterator;
  } // namespace

  /** The residuals of one or two fields, and their products. */
  class ErrorEstimator::Assembly
  {
  public:
    Assembly(const ErrorEstimator &estimator, const std::vector<Field> &fields)
      : estimator_(estimator)
      , discretization_(estimator.discretization_)
      , fields_(fields)
      , stresses_(discretization_,
                  estimator.parts_.section,
                  estimator.parts_.kinematics,
                  displacements(fields),
                  fields.front().section_states)
      , weights_(discretization_.n_part_indices())
      , cell_values_(discretization_,
                     discretization_.element().full_quadrature(),
                     false)
      , edge_(discretization_)
      , edge_rule_(discretization_.element().edge_quadrature())
      , differentiation_(make_differentiation(edge_rule_))
      , vectors_(fields.size())
      , moments_(fields.size())
      , rotations_(fields.size())
      , is_linear_(estimator.parts_.kinematics.model == KinematicsModel::linear)
      , has_linear_form_(is_linear_ && estimator.parts_.section.is_linear())
      , measure_(is_linear_ ? StrainMeasure::linear : StrainMeasure::green)
      , u_(discretization_.node_dofs().size())
    {
      Assert(has_linear_form_ || fields.size() == 1, ExcInternalError());
      fill_weights();
      for (unsigned int f = 0; f < fields.size(); ++f)
        for (unsigned int g = f; g < fields.size(); ++g)
          pairs_.emplace_back(f, g);
      products_.assign(pairs_.size(),
                       ErrorIndicators(
                         discretization_.triangulation().n_active_cells()));
    }

    static std::vector<const Vector *>
    displacements(const std::vector<Field> &fields)
    {
      std::vector<const Vector *> result;
      for (const auto &field : fields)
        result.push_back(field.displacement);
      return result;
    }

    /** W of all parts; nothing is estimated where tips have functions. */
    void
    fill_weights()
    {
      const auto      cell_type = discretization_.element().reference_cell();
      ShellCellValues values(discretization_,
                             Quadrature<dim>(cell_type.barycenter<dim>()),
                             false,
                             ShellCellValues::Points::given);
      for (const CellPart &part : discretization_.relevant_parts())
        {
          if (part.enrichment() != nullptr)
            continue;
          values.reinit_frames(part);
          const auto frame = deformed_frame_at(part, values, 0);
          weights_[part.index()] =
            error_weight(frame,
                         estimator_.parts_.section.stiffness(values.frame(0),
                                                             values.point(0)),
                         resolved_wave_number(discretization_.degree()));
        }
    }

    /** Set u_ to a field's values on a part. */
    void
    extract(const CellPart &part, const unsigned int field)
    {
      discretization_.get_dof_indices(part, dofs_);
      for (unsigned int i = 0; i < dofs_.size(); ++i)
        u_[i] = (*fields_[field].displacement)(dofs_[i]);
    }

    /** The frame itself in linear kinematics. */
    SurfaceFrame<>
    deformed_frame_at(const CellPart        &part,
                      const ShellCellValues &values,
                      const unsigned int     q)
    {
      if (is_linear_)
        return values.frame(q);
      extract(part, 0);
      extract_nodes(values, u_, nodes_[0]);
      return deformed_frame(values.frame(q), values.shapes(), q, nodes_[0]);
    }

    /** The time of a field's data. */
    Instant
    instant_of(const unsigned int field) const
    {
      const auto *const actions = fields_[field].actions;
      return actions != nullptr ? actions->loads : Instant();
    }

    const Tensor3 &
    weight_of(const CellPart &part) const
    {
      return weights_[part.index()];
    }

    /** Indicators of (0, 0), (0, 1), (1, 1), or of (0, 0) only. */
    std::vector<ErrorIndicators>
    run()
    {
      run_on_all_ranks(discretization_.communicator(), [&]() {
        for (const CellPart &part : discretization_.owned_parts())
          {
            if (part.enrichment() == nullptr)
              add_cell(part);
            add_lips(part);
            if (part.data == nullptr || part.data->number == 0)
              for (const auto face : part.cell->face_indices())
                add_face(part.cell, face);
          }
      });
      return std::move(products_);
    }

  private:
    /** Add @p factor times @p product(f, g) for all pairs of fields. */
    template <typename Product>
    void
    add(const CellPart &part,
        const Residual  residual,
        const double    factor,
        const Product  &product)
    {
      if (part.cell->is_locally_owned())
        for (unsigned int k = 0; k < pairs_.size(); ++k)
          products_[k].add(part.cell->active_cell_index(),
                           residual,
                           factor * product(pairs_[k].first, pairs_[k].second));
    }

    void
    add_cell(const CellPart &part)
    {
      cell_values_.reinit_frames(part);
      const auto &section = estimator_.parts_.section;
      const auto &loads   = estimator_.parts_.loads;
      const auto &W       = weight_of(part);
      for (unsigned int q = 0; q < cell_values_.n_points(); ++q)
        {
          const auto &frame = cell_values_.frame(q);
          const auto  x     = cell_values_.point(q);
          for (unsigned int f = 0; f < fields_.size(); ++f)
            {
              vectors_[f] =
                StressPolynomials::divergence(stresses_.nodal(part, f),
                                              cell_values_.shapes(),
                                              q) /
                frame.j0;
              if (fields_[f].has_data && !loads.no_surface_load())
                vectors_[f] += loads.force_per_area(x,
                                                    frame.t0,
                                                    section.density(x) *
                                                      section.thickness(x),
                                                    instant_of(f));
              if (const auto *const foundation = estimator_.parts_.foundation)
                {
                  extract(part, f);
                  vectors_[f] -=
                    foundation_force(*foundation, cell_values_, q, u_);
                }
              if (fields_[f].has_data && loads.pressure_follows())
                {
                  const auto phi = deformed_frame_at(part, cell_values_, q);
                  vectors_[f] += loads.pressure(x, instant_of(f)) * phi.j0 /
                                 frame.j0 * phi.t0;
                }
            }
          add(part,
              Residual::equilibrium,
              cell_values_.JxW(q),
              [&](const unsigned int f, const unsigned int g) {
                return vectors_[f] * (W * vectors_[g]);
              });
        }
    }

    /** Each edge once on each rank that owns one of its cells. */
    void
    add_face(const Iterator &cell, const unsigned int face)
    {
      const auto whole = numbers::invalid_unsigned_int;
      if (discretization_.cell_parts().has_pieces(cell, face))
        add_pieces(cell, face);
      else if (cell->at_boundary(face))
        {
          edge_.reinit(cell, face);
          find_prescribed_rotations({cell->active_cell_index(), face});
          add_edge(cell->face(face)->boundary_id());
        }
      else if (cell->neighbor(face)->has_children())
        {
          const unsigned int back = cell->neighbor_of_neighbor(face);
          for (unsigned int sub = 0; sub < cell->face(face)->n_children();
               ++sub)
            {
              const auto child = cell->neighbor_child_on_subface(face, sub);
              if (child->is_locally_owned())
                continue;
              edge_.reinit(cell, face, sub, child, back, whole);
              add_edge(numbers::internal_face_boundary_id);
            }
        }
      else if (cell->neighbor_is_coarser(face))
        {
          const auto neighbor = cell->neighbor(face);
          const auto back     = cell->neighbor_of_coarser_neighbor(face);
          edge_.reinit(cell, face, whole, neighbor, back.first, back.second);
          add_edge(numbers::internal_face_boundary_id);
        }
      else
        {
          if (is_taken_by_neighbor(cell, face))
            return;
          edge_.reinit(cell,
                       face,
                       whole,
                       cell->neighbor(face),
                       cell->neighbor_of_neighbor(face),
                       whole);
          add_edge(numbers::internal_face_boundary_id);
        }
    }

    /** An edge of a cell that is cut, or whose neighbour is. */
    void
    add_pieces(const Iterator &cell, const unsigned int face)
    {
      const auto id = cell->at_boundary(face) ?
                        cell->face(face)->boundary_id() :
                        numbers::internal_face_boundary_id;
      for (const EdgePiece &piece :
           residual_pieces(discretization_.cell_parts(), cell, face))
        {
          // The points of whole edges stand where their rotations are given.
          if (cell->at_boundary(face) && !piece.sides[0].part.is_cut())
            edge_.reinit(cell, face);
          else
            edge_.reinit(piece);
          if (piece.n_sides == 1)
            find_prescribed_rotations(piece.place());
          add_edge(id);
        }
    }

    void
    add_lips(const CellPart &part)
    {
      for (const CutLip &lip : discretization_.cell_parts().lips(part))
        {
          edge_.reinit_lip(part, lip);
          prescribed_.assign(edge_.n_points(), PrescribedRotation());
          add_edge(numbers::internal_face_boundary_id,
                   estimator_.parts_.loads.on_lip({lip.cut, lip.is_left}));
        }
    }

    /** d/ds (m^ab nu_a tau_b t0) of a side at all points of the edge. */
    std::vector<Vector3>
    twisting_forces(const unsigned int side, const unsigned int field) const
    {
      const unsigned int   n = edge_.n_points();
      std::vector<Vector3> twist(n), forces(n);
      for (unsigned int q = 0; q < n; ++q)
        {
          const auto   &frame = edge_.frame(side, q);
          const Vector3 nu    = outward(side, q);
          const Vector3 tau   = tangents_[q];
          twist[q]            = StressPolynomials::moment(
                       stresses_.nodal(edge_.part(side), field),
                       edge_.shapes(side),
                       q,
                       {{frame.a_cov[0] * nu, frame.a_cov[1] * nu}},
                       {{frame.a_cov[0] * tau, frame.a_cov[1] * tau}}) /
                     frame.j0;
        }
      for (unsigned int q = 0; q < n; ++q)
        for (unsigned int r = 0; r < n; ++r)
          forces[q] += edge_rule_.weight(q) / edge_.JxW(q) *
                       differentiation_(q, r) * twist[r];
      return forces;
    }

    Vector3
    outward(const unsigned int side, const unsigned int q) const
    {
      return (side == 0 ? 1. : -1.) * edge_.conormal(side, q);
    }

    /** Unit tangents along which the points follow each other. */
    void
    fill_tangents()
    {
      const unsigned int n     = edge_.n_points();
      const Vector3      along = edge_.point(n - 1) - edge_.point(0);
      tangents_.resize(n);
      for (unsigned int q = 0; q < n; ++q)
        {
          const Vector3 tau =
            cross_product_3d(edge_.frame(0, q).t0, edge_.conormal(0, q));
          tangents_[q] = (tau * along > 0. ? 1. : -1.) * tau;
        }
    }

    /**
     * Add the edge that edge_ holds; @p id of a boundary, or internal, that of
     * a lip as well.
     */
    void
    add_edge(const types::boundary_id id)
    {
      add_edge(id, estimator_.parts_.loads.on_edge(id));
    }

    void
    add_edge(const types::boundary_id id, const LineLoad &load)
    {
      const unsigned int n_sides = edge_.n_sides();
      for (unsigned int side = 0; side < n_sides; ++side)
        if (edge_.part(side).enrichment() != nullptr)
          return;
      fill_tangents();
      std::vector<std::vector<Vector3>> tractions(fields_.size(),
                                                  std::vector<Vector3>(
                                                    edge_.n_points()));
      for (unsigned int f = 0; f < fields_.size(); ++f)
        for (unsigned int side = 0; side < n_sides; ++side)
          {
            const auto twist = twisting_forces(side, f);
            for (unsigned int q = 0; q < edge_.n_points(); ++q)
              {
                const auto &frame = edge_.frame(side, q);
                const auto  nu    = outward(side, q);
                const auto  force =
                  StressPolynomials::forces(stresses_.nodal(edge_.part(side),
                                                            f),
                                            edge_.shapes(side),
                                            q);
                for (unsigned int b = 0; b < 2; ++b)
                  tractions[f][q] +=
                    (frame.a_cov[b] * nu) / frame.j0 * force[b];
                tractions[f][q] += twist[q];
              }
          }
      for (unsigned int q = 0; q < edge_.n_points(); ++q)
        {
          for (unsigned int f = 0; f < fields_.size(); ++f)
            vectors_[f] = tractions[f][q];
          has_linear_form_ ? fill_jumps(q) : fill_energy_jumps(q);
          if (n_sides == 1)
            apply_boundary_data(id, load, q);
          add_edge_point(q);
        }
    }

    /** Jumps of m_nn and theta, or their values on the boundary. */
    void
    fill_jumps(const unsigned int q)
    {
      stiffness_ = 0.;
      normal_    = Vector3();
      std::fill(moments_.begin(), moments_.end(), 0.);
      std::fill(rotations_.begin(), rotations_.end(), 0.);
      for (unsigned int side = 0; side < edge_.n_sides(); ++side)
        {
          side_.reinit(edge_, side, q, estimator_.parts_.section);
          stiffness_ += side_.stiffness / edge_.n_sides();
          normal_ += edge_.sigma(side, q) * edge_.frame(side, q).t0;
          const double sign = (edge_.n_sides() == 2 && side == 0) ? -1. : 1.;
          for (unsigned int f = 0; f < fields_.size(); ++f)
            for (unsigned int a = 0; a < side_.rotation.size(); ++a)
              {
                Vector3 u;
                for (unsigned int c = 0; c < spacedim; ++c)
                  u[c] = (*fields_[f].displacement)(
                    edge_.dof_indices()[edge_.dof(side, a, c)]);
                rotations_[f] += sign * side_.rotation[a] * (side_.t0 * u);
                moments_[f] += sign * side_.moment_of(a, u);
              }
        }
    }

    /** The rotations prescribed at the points of a boundary edge, or none. */
    void
    find_prescribed_rotations(const PrescribedRotations::key_type &place)
    {
      prescribed_.assign(edge_.n_points(), PrescribedRotation());
      const auto *const actions = fields_[0].actions;
      if (actions == nullptr)
        return;
      const auto found = actions->rotations.find(place);
      if (found != actions->rotations.end())
        prescribed_ = found->second;
    }

    /** fill_jumps() by energies, what is prescribed included. */
    void
    fill_energy_jumps(const unsigned int q)
    {
      const unsigned int n_sides = edge_.n_sides();
      const auto        &section = estimator_.parts_.section;
      const auto *const  strains = section.is_coupled() ? &membrane_ : nullptr;
      if (q == 0)
        {
          point_.set_states(
            SectionStates::of_edge(fields_[0].section_states, edge_));
          dealii::Vector<double> u(edge_.n_dofs());
          for (unsigned int i = 0; i < u.size(); ++i)
            u[i] = (*fields_[0].displacement)(edge_.dof_indices()[i]);
          for (unsigned int s = 0; s < n_sides; ++s)
            {
              extract_nodes(edge_, s, u, nodes_[s]);
              if (strains != nullptr)
                membrane_[s].reinit(EdgeSideTying(edge_, s), nodes_[s]);
            }
        }
      const auto rotation =
        n_sides == 1 ? prescribed_[q] : PrescribedRotation();
      point_.reinit(edge_, q, section, 1., rotation, nodes_, strains);
      stiffness_    = point_.stiffness();
      rotations_[0] = point_.jump();
      moments_[0]   = 0.;
      normal_       = Vector3();
      for (unsigned int side = 0; side < n_sides; ++side)
        {
          const auto &of_side = point_.side(side);
          moments_[0] += (n_sides == 2 && side == 0 ? -1. : 1.) *
                         of_side.lambda * of_side.moment;
          normal_ += of_side.normal;
        }
    }

    /** From the values on the boundary to residuals. */
    void
    apply_boundary_data(const types::boundary_id id,
                        const LineLoad          &load,
                        const unsigned int       q)
    {
      const auto edge    = estimator_.parts_.supports.edges().find(id);
      const bool rotates = (edge != estimator_.parts_.supports.edges().end() &&
                            edge->second.rotation != nullptr);
      const auto point   = edge_.point(q);
      for (unsigned int f = 0; f < fields_.size(); ++f)
        {
          if (fields_[f].has_data)
            {
              vectors_[f] -=
                load.force_at(point, edge_.conormal(0, q), instant_of(f));
              moments_[f] -= load.moment_at(point, instant_of(f));
              if (rotates && has_linear_form_)
                rotations_[f] -= (*edge->second.rotation)(point, instant_of(f));
            }
          vectors_[f] = estimator_.conditions_.free_part(id,
                                                         edge_.frame(0, q).t0,
                                                         edge_.conormal(0, q),
                                                         vectors_[f]);
          // What is prescribed leaves its dual quantity free.
          (rotates ? moments_ : rotations_)[f] = 0.;
        }
    }

    void
    add_edge_point(const unsigned int q)
    {
      const unsigned int n_sides = edge_.n_sides();
      Tensor3            W;
      double             h = 0.;
      for (unsigned int side = 0; side < n_sides; ++side)
        {
          W += weight_of(edge_.part(side)) / n_sides;
          h += cell_height(edge_.frame(side, q), outward(side, q)) / n_sides;
        }
      const Vector3 t   = normal_ / normal_.norm();
      const double  k   = resolved_wave_number(discretization_.degree()) / h;
      const double  W_n = t * (W * t);
      const auto   &penalty = estimator_.penalty_;
      const double  eta     = n_sides == 2 ?
                                penalty.interior(edge_.part(0), edge_.part(1)) :
                                2. * penalty.boundary(edge_.part(0));
      const double  share   = edge_.JxW(q) / n_sides;
      for (unsigned int side = 0; side < n_sides; ++side)
        {
          const auto add_part = [&](const Residual residual,
                                    const double   factor,
                                    const auto    &product) {
            add(edge_.part(side), residual, share * factor, product);
          };
          add_part(Residual::traction,
                   0.25 * k,
                   [&](const unsigned int f, const unsigned int g) {
                     return vectors_[f] * (W * vectors_[g]);
                   });
          add_part(Residual::moment,
                   0.25 * k * k * k * W_n,
                   [&](const unsigned int f, const unsigned int g) {
                     return moments_[f] * moments_[g];
                   });
          add_part(Residual::rotation,
                   eta * stiffness_,
                   [&](const unsigned int f, const unsigned int g) {
                     return rotations_[f] * rotations_[g];
                   });
        }
    }

    const ErrorEstimator                              &estimator_;
    const Discretization                              &discretization_;
    const std::vector<Field>                          &fields_;
    const StressPolynomials                            stresses_;
    std::vector<Tensor3>                               weights_;
    ShellCellValues                                    cell_values_;
    ShellEdgeValues                                    edge_;
    const Quadrature<1>                                edge_rule_;
    const FullMatrix<double>                           differentiation_;
    JumpSide                                           side_;
    std::vector<std::pair<unsigned int, unsigned int>> pairs_;
    std::vector<ErrorIndicators>                       products_;
    /** @name At the current point, by field */
    //@{
    std::vector<Vector3> vectors_;
    std::vector<double>  moments_;
    std::vector<double>  rotations_;
    //@}
    double               stiffness_ = 0.;
    std::vector<Vector3> tangents_;
    /** Sum of the sides' normals, deformed in large rotations. */
    Vector3 normal_;
    /** @name In large rotations, and of laws that aren't linear */
    //@{
    const bool                             is_linear_, has_linear_form_;
    const StrainMeasure                    measure_;
    dealii::Vector<double>                 u_;
    std::vector<types::global_dof_index>   dofs_;
    std::array<NodeVectors<double>, 2>     nodes_;
    std::array<TiedGreenStrain<double>, 2> membrane_{
      {TiedGreenStrain<double>(measure_), TiedGreenStrain<double>(measure_)}};
    FiniteEdgePoint<double>         point_{measure_};
    std::vector<PrescribedRotation> prescribed_;
    //@}
  };

  ErrorEstimator::ErrorEstimator(const Discretization &discretization,
                                 const ShellParts     &parts,
                                 const EdgePenalty    &penalty)
    : discretization_(discretization)
    , parts_(parts)
    , penalty_(penalty)
    , conditions_(discretization, parts_.supports)
  {}

  ErrorIndicators
  ErrorEstimator::estimate(const Field &field) const
  {
    const std::vector<Field> fields = {field};
    return std::move(Assembly(*this, fields).run().front());
  }

  std::array<ErrorIndicators, 3>
  ErrorEstimator::estimate(const Field &u, const Field &z) const
  {
    const std::vector<Field> fields   = {u, z};
    auto                     products = Assembly(*this, fields).run();
    return {{products[0], products[2], products[1]}};
  }
} // namespace Nacre
