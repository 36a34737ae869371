// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The records of conformance/*.json, written by an independent program: frames,
// strains, matrices, forces and energies of 8-node, 9-node and triangular
// cells and of an edge.

#include "record_meshes.h"
#include <nacre/forms/linear_kinematics.h>
#include <nacre/mechanics/shell_strain.h>

#include <deal.II/fe/fe_values.h>

#include <numeric>

/** A section of which only one stiffness counts. */
class PartialSection : public LinearSectionLaw
{
public:
  PartialSection(const SectionLaw &section, const double membrane)
    : section_(section)
    , membrane_(membrane)
  {}

  double
  thickness(const SectionPoint &point) const override
  {
    return section_.thickness(point);
  }

  double
  density(const SectionPoint &point) const override
  {
    return section_.density(point);
  }

  SectionStiffness
  stiffness(const SurfaceFrame<> &frame,
            const SectionPoint   &point) const override
  {
    const auto both = section_.stiffness(frame, point);
    return {membrane_ * both.membrane, (1. - membrane_) * both.bending};
  }

private:
  const SectionLaw &section_;
  const double      membrane_;
};

std::vector<double>
upper_triangle(const FullMatrix<double>        &matrix,
               const std::vector<unsigned int> &dofs)
{
  std::vector<double> numbers;
  for (unsigned int i = 0; i < dofs.size(); ++i)
    for (unsigned int j = i; j < dofs.size(); ++j)
      numbers.push_back(matrix(dofs[i], dofs[j]));
  return numbers;
}

/** The records' displacement fields at a node. */
Vector3
field_value(const std::string &name, const Point<3> &p)
{
  const double x = p[0], y = p[1], z = p[2];
  Vector3      u;
  if (name == "rigid")
    {
      Vector3 omega, shift;
      omega[0] = 0.3, omega[1] = -0.2, omega[2] = 0.5;
      shift[0] = 0.1, shift[1] = 0.2, shift[2] = -0.3;
      u = cross_product_3d(omega, Vector3(p)) + shift;
    }
  else if (name == "quadratic")
    {
      u[0] = 0.01 * (x * x - y * z);
      u[1] = 0.01 * (x * y + z);
      u[2] = 0.01 * (y * y + 2. * x * z - x * x);
    }
  else if (name == "trig")
    {
      u[0] = 0.01 * std::sin(x + 2. * y);
      u[1] = 0.01 * std::cos(y - z);
      u[2] = 0.01 * (std::sin(2. * x) * std::cos(y) + z * z);
    }
  else
    AssertThrow(false, ExcMessage("No such field: " + name));
  return u;
}

/** The field at the record's nodes, in the dofs' order. */
Vector<double>
field_vector(const std::string               &name,
             const std::vector<double>       &nodes,
             const std::vector<unsigned int> &dofs)
{
  Vector<double> u(dofs.size());
  for (unsigned int k = 0; k < dofs.size() / 3; ++k)
    {
      const auto value =
        field_value(name, {nodes[3 * k], nodes[3 * k + 1], nodes[3 * k + 2]});
      for (unsigned int c = 0; c < 3; ++c)
        u[dofs[3 * k + c]] = value[c];
    }
  return u;
}

std::vector<double>
in_record_order(const Vector<double>            &vector,
                const std::vector<unsigned int> &dofs,
                const double                     factor = 1.)
{
  std::vector<double> numbers;
  for (const unsigned int i : dofs)
    numbers.push_back(factor * vector[i]);
  return numbers;
}

Parameters
parameters_of(const Json &record)
{
  return Parameters(section_text(record.get<double>("E"),
                                 record.get<double>("nu"),
                                 record.get<double>("h")));
}

void
test_frame(const std::string      &name,
           const double            scale,
           const Json             &sample,
           const SurfaceFrame<>   &frame,
           const Point<3>         &point,
           const SectionStiffness &stiffness)
{
  const auto check_vector =
    [&](const std::string &key, const Vector3 &v, const double factor) {
      compare(name + key,
              {factor * v[0], factor * v[1], factor * v[2]},
              numbers_of(sample, key));
    };
  check_vector("x", Vector3(point), 1.);
  check_vector("phi_1", frame.a_cov[0], scale);
  check_vector("phi_2", frame.a_cov[1], scale);
  check_vector("phi_11", frame.a_cov_derivatives[0], scale * scale);
  check_vector("phi_22", frame.a_cov_derivatives[1], scale * scale);
  check_vector("phi_12", frame.a_cov_derivatives[2], scale * scale);
  check_vector("phi_up_1", frame.a_con[0], 1. / scale);
  check_vector("phi_up_2", frame.a_con[1], 1. / scale);
  check_vector("t0", frame.t0, 1.);
  compare(name + "j0", {scale * scale * frame.j0}, numbers_of(sample, "j0"));

  std::vector<double> H_n, H_m;
  const double        to_record = 1. / std::pow(scale, 4);
  for (unsigned int v = 0; v < 3; ++v)
    for (unsigned int w = 0; w < 3; ++w)
      {
        H_n.push_back(to_record * stiffness.membrane[v][w]);
        H_m.push_back(to_record * stiffness.bending[v][w]);
      }
  compare(name + "Hn_voigt", H_n, numbers_of(sample, "Hn_voigt"));
  compare(name + "Hm_voigt", H_m, numbers_of(sample, "Hm_voigt"));
}

/** Strains and the change of the normal at the point @p q. */
void
test_rows(const std::string               &name,
          const Json                      &sample,
          const RecordType                &type,
          const Discretization            &discretization,
          const ShellCellValues           &values,
          const unsigned int               q,
          const std::vector<unsigned int> &dofs)
{
  const unsigned int  n     = dofs.size();
  const double        scale = type.scale * type.scale;
  std::vector<double> B_n, B_m, Dt(3 * n);
  for (unsigned int v = 0; v < 3; ++v)
    for (const unsigned int i : dofs)
      {
        B_n.push_back(scale * values.membrane_rows()(3 * q + v, i));
        B_m.push_back(scale * values.bending_rows()(3 * q + v, i));
      }
  for (unsigned int a = 0; a < n / 3; ++a)
    for (unsigned int c = 0; c < 3; ++c)
      {
        Vector3 e;
        e[c]           = 1.;
        const auto &dN = values.shapes().gradient(q, a);
        const auto  row =
          ShellStrain::normal_change(values.frame(q), {{dN[0] * e, dN[1] * e}});
        const auto k =
          type.node(discretization.scalar_fe().unit_support_point(a));
        for (unsigned int r = 0; r < 3; ++r)
          Dt[n * r + 3 * k + c] = row[r];
      }
  compare(name + "Bn", B_n, numbers_of(sample, "Bn"));
  compare(name + "Bm", B_m, numbers_of(sample, "Bm"));
  compare(name + "Dt", Dt, numbers_of(sample, "Dt"));
}

void
test_samples(const Json                      &record,
             const RecordType                &type,
             const Discretization            &discretization,
             const SectionLaw                &section,
             const std::vector<unsigned int> &dofs)
{
  std::vector<Point<2>> points;
  for (const auto &sample : record.get_child("samples"))
    {
      const auto xi = numbers_of(sample.second, "xi");
      points.push_back(type.unit_point({xi[0], xi[1]}));
    }
  ShellCellValues values(discretization,
                         Quadrature<2>(points,
                                       std::vector<double>(points.size(), 1.)),
                         false);
  values.reinit(discretization.dof_handler().begin_active());

  unsigned int q = 0;
  for (const auto &sample : record.get_child("samples"))
    {
      const auto name = record.get<std::string>("name") + ", sample " +
                        std::to_string(q) + ": ";
      test_frame(name,
                 type.scale,
                 sample.second,
                 values.frame(q),
                 values.point(q),
                 section.stiffness(values.frame(q), values.point(q)));
      if (sample.second.count("Bn") == 1)
        test_rows(name, sample.second, type, discretization, values, q, dofs);
      ++q;
    }
}

/** rho_ab(u) = -t0 . hess u, the second gradient in space. */
void
test_space_hessian(const std::string    &name,
                   const Discretization &discretization)
{
  const auto      quadrature = discretization.element().full_quadrature();
  ShellCellValues values(discretization, quadrature, false);
  values.reinit(discretization.dof_handler().begin_active());
  FEValues<2, 3> fe_values(discretization.mapping(),
                           discretization.scalar_fe(),
                           quadrature,
                           update_hessians);
  fe_values.reinit(static_cast<Triangulation<2, 3>::cell_iterator>(
    discretization.dof_handler().begin_active()));
  double error = 0., size = 0.;
  for (unsigned int q = 0; q < quadrature.size(); ++q)
    for (unsigned int a = 0; a < values.shapes().n_nodes(); ++a)
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int v = 0; v < 3; ++v)
          {
            const auto &frame = values.frame(q);
            const auto &a_1   = frame.a_cov[v == 1 ? 1 : 0];
            const auto &a_2   = frame.a_cov[v == 0 ? 0 : 1];
            const auto  rho   = -(v == 2 ? 2. : 1.) * frame.t0[c] *
                             (a_1 * (fe_values.shape_hessian(a, q) * a_2));
            size = std::max(size, std::abs(rho));
            error =
              std::max(error,
                       std::abs(rho - values.bending_rows()(3 * q + v,
                                                            values.dof(a, c))));
          }
  check_below(name + ": bending strain is -t0 . hess u", error / size, 1e-11);
}

void
test_element(const Json &record)
{
  const auto name       = record.get<std::string>("name");
  const auto parameters = parameters_of(record);
  const auto nodes      = numbers_of(record, "nodes");

  const RecordType          type(record);
  std::vector<unsigned int> all_nodes(nodes.size() / 3);
  std::iota(all_nodes.begin(), all_nodes.end(), 0);
  const auto discretization = make_discretization(type, nodes, {all_nodes});
  const auto dofs           = record_dofs(type, *discretization);
  const auto cell           = discretization->dof_handler().begin_active();
  test_samples(record, type, *discretization, parameters.section, dofs);
  test_space_hessian(name, *discretization);

  // The record's rule is the full or the reduced one of our element.
  const auto n_points = numbers_of(record, "quad.weights").size();
  const bool is_full  = (n_points == type.element.full_quadrature().size());
  AssertThrow(is_full || n_points == type.element.reduced_quadrature().size(),
              ExcInternalError());
  for (const std::string part : {"membrane", "bending"})
    {
      const PartialSection section(parameters.section,
                                   part == "membrane" ? 1. : 0.);
      LinearKinematics     kinematics(*discretization,
                                  section,
                                  is_full ? MembraneStrain::full :
                                                MembraneStrain::reduced);
      LocalTerms           terms;
      terms.reinit(dofs.size());
      kinematics.add_cell_terms(cell, Vector<double>(), terms);
      compare(name + ": K_" + part,
              upper_triangle(terms.tangent, dofs),
              numbers_of(record, "K_" + part + "_upper"));

      terms.wants_tangent = false;
      for (const auto &field : record.get_child("fields"))
        {
          const auto field_name = field.second.get<std::string>("name");
          const auto where      = name + ", field " + field_name + ": ";
          terms.reinit(dofs.size());
          kinematics.add_cell_terms(cell,
                                    field_vector(field_name, nodes, dofs),
                                    terms);
          const double energy = (part == "membrane" ? terms.energies.membrane :
                                                      terms.energies.bending);
          const double other  = terms.energies.total() - energy;
          if (field_name == "rigid")
            check_below(where + "U_" + part, std::abs(energy), 1e-12);
          else
            compare(where + "U_" + part,
                    {energy, other},
                    {field.second.get<double>("U_" + part), 0.});
          if (field.second.count("f_" + part) == 1)
            compare(where + "f_" + part,
                    in_record_order(terms.residual, dofs),
                    numbers_of(field.second, "f_" + part));
        }
    }
}

/** The mesh of an edge's record and the edge between K^- and K^+. */
struct RecordEdge
{
  explicit RecordEdge(const Json &record)
    : type(record)
    , cells(cells_of(record))
    , discretization(
        make_discretization(type, numbers_of(record, "nodes"), cells))
    , minus(cell(record.get<int>("K_minus")))
    , plus(cell(record.get<int>("K_plus")))
    , edge(*discretization)
  {
    unsigned int face = 0;
    while (minus->at_boundary(face))
      ++face;
    edge.reinit(minus,
                face,
                numbers::invalid_unsigned_int,
                plus,
                minus->neighbor_of_neighbor(face),
                numbers::invalid_unsigned_int);

    const auto &fe = discretization->scalar_fe();
    dofs.resize(edge.n_dofs());
    for (unsigned int side = 0; side < 2; ++side)
      for (unsigned int a = 0; a < fe.n_dofs_per_cell(); ++a)
        for (unsigned int c = 0; c < 3; ++c)
          dofs[3 * cells[(side == 0 ? minus : plus)->index()]
                        [type.node(fe.unit_support_point(a))] +
               c] = edge.dof(side, a, c);
  }

  static std::vector<std::vector<unsigned int>>
  cells_of(const Json &record)
  {
    std::vector<std::vector<unsigned int>> cells;
    for (const auto &cell : record.get_child("conn"))
      {
        cells.emplace_back();
        for (const double k : numbers_of(cell.second))
          cells.back().push_back(static_cast<unsigned int>(k));
      }
    return cells;
  }

  ShellEdgeValues::cell_iterator
  cell(const int index) const
  {
    for (const auto &cell :
         discretization->dof_handler().active_cell_iterators())
      if (cell->index() == index)
        return cell;
    AssertThrow(false, ExcInternalError());
    return discretization->dof_handler().begin_active();
  }

  const RecordType                             type;
  const std::vector<std::vector<unsigned int>> cells;
  const std::unique_ptr<Discretization>        discretization;
  const ShellEdgeValues::cell_iterator         minus;
  const ShellEdgeValues::cell_iterator         plus;
  ShellEdgeValues                              edge;
  /** The record's dofs among those of the edge. */
  std::vector<unsigned int> dofs;
};

/** Smooth surfaces: both sides have the same frame. */
void
test_edge_frames(const std::string &name, const ShellEdgeValues &edge)
{
  double normals = 0., conormals = 0., orientation = 0.;
  for (unsigned int q = 0; q < edge.n_points(); ++q)
    {
      normals =
        std::max(normals, (edge.frame(0, q).t0 - edge.frame(1, q).t0).norm());
      conormals =
        std::max(conormals, (edge.conormal(0, q) - edge.conormal(1, q)).norm());
      orientation = std::max(orientation, std::abs(edge.sigma(1, q) - 1.));
    }
  check_below(name + ": normals agree", normals, 1e-13);
  check_below(name + ": conormals agree", conormals, 1e-13);
  check_below(name + ": sigma", orientation, 1e-13);
}

/** The terms with the penalty and those without. */
std::pair<LocalTerms, LocalTerms>
penalty_and_consistency(const RecordEdge     &mesh,
                        const SectionLaw     &section,
                        const EdgeForm        form,
                        const double          eta_e,
                        const Vector<double> &u)
{
  const auto kinematics = make_kinematics(*mesh.discretization,
                                          section,
                                          {MembraneStrain::full, form});
  std::pair<LocalTerms, LocalTerms> terms;
  terms.first.reinit(mesh.edge.n_dofs());
  terms.second.reinit(mesh.edge.n_dofs());
  kinematics->add_edge_terms(mesh.edge, eta_e, u, terms.first);
  kinematics->add_edge_terms(mesh.edge, 0., u, terms.second);
  terms.first.tangent.add(-1., terms.second.tangent);
  terms.first.energies.edge -= terms.second.energies.edge;
  return terms;
}

/**
 * Matrices and energies of one of the record's forms.
 * @param expected the record with the matrices
 */
void
test_edge_form(const Json        &record,
               const Json        &expected,
               const RecordEdge  &mesh,
               const EdgeForm     form,
               const std::string &key)
{
  const auto   name       = record.get<std::string>("name") + ", " + key;
  const auto   parameters = parameters_of(record);
  const auto   nodes      = numbers_of(record, "nodes");
  const double eta_e      = record.get<double>("eta_e");

  const auto matrices = penalty_and_consistency(mesh,
                                                parameters.section,
                                                form,
                                                eta_e,
                                                Vector<double>());
  compare(name + ": K_penalty",
          upper_triangle(matrices.first.tangent, mesh.dofs),
          numbers_of(expected, "K_penalty_upper"));
  compare(name + ": K_consistency",
          upper_triangle(matrices.second.tangent, mesh.dofs),
          numbers_of(expected, "K_consistency_upper"));

  for (const auto &field : record.get_child("fields"))
    {
      const auto where    = name + ", field " + field.first + ": ";
      const auto energies = field.second.get_child(key);
      const auto terms =
        penalty_and_consistency(mesh,
                                parameters.section,
                                form,
                                eta_e,
                                field_vector(field.first, nodes, mesh.dofs));
      const auto check = [&](const std::string &part, const double found) {
        // What vanishes, or nearly, does so up to round-off.
        const double exact = energies.get<double>(part);
        if (std::abs(exact) > 1e-8)
          compare(where + part, {found}, {exact});
        else
          check_below(where + part, std::abs(found - exact), 1e-13);
      };
      check("U_penalty", terms.first.energies.edge);
      check("U_consistency", terms.second.energies.edge);
    }
}

/** @param expected the record with the matrices */
void
test_edge(const Json &record, const Json &expected)
{
  const auto       name       = record.get<std::string>("name");
  const auto       parameters = parameters_of(record);
  const RecordEdge mesh(record);
  // The matrices are the report's; where the surface is smooth, of all forms.
  if (record.get<double>("max_normal_angle_rad") < 1e-7)
    {
      test_edge_frames(name, mesh.edge);
      test_edge_form(record,
                     expected,
                     mesh,
                     EdgeForm::rotation_jump,
                     "rotation jump");
    }
  test_edge_form(record, expected, mesh, EdgeForm::averaged_normal, "report");

  const auto        &element = mesh.discretization->element();
  const auto         full    = element.full_quadrature();
  const unsigned int n       = record.get<unsigned int>("element_quad_n");
  const unsigned int n_points =
    element.type == ElementType::triangle ? n : n * n;
  const EdgePenalty penalty(*mesh.discretization,
                            parameters.section,
                            n_points == full.size() ?
                              full :
                              element.reduced_quadrature(),
                            record.get<double>("eta"));
  const double      found = penalty.interior(mesh.minus, mesh.plus);
  compare(name + ": eta_e", {found}, numbers_of(record, "eta_e"));
  compare(name + ": h_e",
          {record.get<double>("eta") / found},
          numbers_of(record, "h_e"));
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  Json                             elements, edges;
  boost::property_tree::read_json(SOURCE_DIR "/conformance/elements.json",
                                  elements);
  boost::property_tree::read_json(SOURCE_DIR "/conformance/edges.json", edges);
  for (const auto &record : elements)
    test_element(record.second);
  // Some records have the matrices of the one before them.
  const Json *expected = nullptr;
  for (const auto &record : edges)
    {
      if (!record.second.get_child("K_penalty_upper").empty())
        expected = &record.second;
      test_edge(record.second, *expected);
    }
  return n_failures > 0;
}
