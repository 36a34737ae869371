// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The report's edge terms (34)-(45) point by point: edge frame, push-forwards,
// N^, Delta t~ and their matrices against conformance/edges.json and
// boundary.json, of all elements that the files hold. Then the errata of
// doc/report.md: with the equations as they are printed the records are missed.

#include "report_elements.h"
#include <nacre/mechanics/shell_strain.h>

#include <deal.II/base/quadrature_lib.h>

#include <numeric>

using Vector2 = Tensor<1, 2>;

/** Largest differences by name: one line for all records. */
std::map<std::string, double> worst;

/** As compare(), for the table of the worst. */
void
note(const std::string         &name,
     const std::vector<double> &found,
     const std::vector<double> &record,
     const double               scale = 0.)
{
  double difference = (found.size() == record.size() ? 0. : 1e100);
  double size       = std::max(scale, 1e-300);
  for (unsigned int i = 0; i < record.size() && i < found.size(); ++i)
    {
      const double d = std::abs(found[i] - record[i]);
      difference     = !(d <= difference) ? d : difference;
      if (scale == 0.)
        size = std::max(size, std::abs(record[i]));
    }
  worst[name] = std::max(worst[name], difference / size);
}

std::vector<double>
numbers_of(const Tensor<1, 3> &v)
{
  return {v[0], v[1], v[2]};
}

std::vector<double>
numbers_of(const Tensor<2, 3> &m)
{
  std::vector<double> numbers;
  for (unsigned int v = 0; v < 3; ++v)
    for (unsigned int w = 0; w < 3; ++w)
      numbers.push_back(m[v][w]);
  return numbers;
}

/** Which of the errata are corrected. */
struct Route
{
  /** (38) in the edge's frame, else with each cell's own normal and basis. */
  bool edge_frame = true;
  /** (43), (45) with the edge's basis, else with the cell's: P = p = I. */
  bool pushed = true;
  /** (37), last line, with N^^T. */
  bool transposed = true;
  /** K^- at the reversed parameter of the edge. */
  bool reversed = true;
  /** The cell of the opposite orientation with -t0, -rho, -Delta t. */
  bool oriented = true;
};

/** The rows of one edge point; matrices [Voigt][3 node + component]. */
struct EdgeRows
{
  explicit EdgeRows(const unsigned int n_dofs)
    : jump(3, n_dofs)
    , tested_jump(3, n_dofs)
    , moment(3, n_dofs)
  {}

  SurfaceFrame<>               frame;
  std::array<VoigtMatrix<>, 2> p, P;
  /** In the edge's basis, and in those of the cells. */
  VoigtMatrix<>                H;
  std::array<VoigtMatrix<>, 2> H_cell;
  FullMatrix<double>           jump;
  /** The jump as the consistency terms take it. */
  FullMatrix<double> tested_jump;
  FullMatrix<double> moment;
};

/** Add a side: its jump times @p sign, its mean times @p share. */
void
add_side(const RecordPoint &point,
         const SectionLaw  &section,
         const unsigned int side,
         const double       sign,
         const double       share,
         const double       sigma,
         const Route       &route,
         EdgeRows          &rows)
{
  const auto &frame = point.frame;
  const auto  N_hat = EdgeFrame::jump_matrix(rows.frame);
  rows.p[side]      = EdgeFrame::strain_transformation(frame, rows.frame);
  rows.P[side]      = EdgeFrame::strain_transformation(rows.frame, frame);
  rows.H_cell[side] = section.stiffness(frame, Point<3>()).bending;
  for (unsigned int a = 0; a < point.cell.size(); ++a)
    {
      const auto change =
        route.edge_frame ?
          EdgeFrame::normal_change_of_shape_function(
            rows.frame,
            EdgeFrame::transform_derivatives(frame, rows.frame, point.dN[a])) :
          sigma *
            EdgeFrame::normal_change_of_shape_function(frame, point.dN[a]);
      const auto normal = route.edge_frame ? rows.frame.t0 : frame.t0;
      const auto rho    = ShellStrain::bending_of_shape_function(frame,
                                                              point.dN[a],
                                                              point.ddN[a]);
      const auto m =
        route.pushed ? rows.H * (rows.p[side] * rho) : rows.H_cell[side] * rho;
      const auto jump   = N_hat * change;
      const auto tested = route.transposed ? jump : transpose(N_hat) * change;
      for (unsigned int v = 0; v < 3; ++v)
        for (unsigned int c = 0; c < 3; ++c)
          {
            const unsigned int i = 3 * point.cell[a] + c;
            rows.jump(v, i) += sign * jump[v] * normal[c];
            rows.tested_jump(v, i) += sign * tested[v] * normal[c];
            rows.moment(v, i) += share * sigma * m[v] * frame.t0[c];
          }
    }
}

/** An interior edge's record with all that it takes to evaluate a point. */
struct EdgeRecord
{
  explicit EdgeRecord(const Json &record)
    : record(record)
    , element(record.get<std::string>("type"))
    , nodes(numbers_of(record, "nodes"))
    , cells(record_cells(record))
    , parameters(section_text(record.get<double>("E"),
                              record.get<double>("nu"),
                              record.get<double>("h")))
    , flipped(record.get<bool>("flipped_neighbour"))
  {}

  EdgeRows
  rows(const double t, const Route &route) const
  {
    const auto point = [&](const std::string &side, const double s) {
      return RecordPoint(
        element,
        nodes,
        cells[record.get<unsigned int>("K_" + side)],
        element.edge_point(record.get<unsigned int>("local_edge_" + side), s));
    };
    const auto   plus  = point("plus", t);
    const auto   minus = point("minus", route.reversed && !flipped ? -t : t);
    const double sigma = flipped && route.oriented ? -1. : 1.;
    const auto   direction =
      element.edge_direction(record.get<unsigned int>("local_edge_plus"));

    EdgeRows rows(nodes.size());
    rows.frame =
      EdgeFrame::make_edge_frame(direction[0] * plus.frame.a_cov[0] +
                                   direction[1] * plus.frame.a_cov[1],
                                 sigma * minus.frame.t0,
                                 plus.frame.t0);
    const auto &section = parameters.section;
    rows.H              = section.stiffness(rows.frame, Point<3>()).bending;
    add_side(minus, section, 0, -1., 0.5, sigma, route, rows);
    add_side(plus, section, 1, 1., 0.5, 1., route, rows);
    return rows;
  }

  const Json                                  &record;
  const RecordElement                          element;
  const std::vector<double>                    nodes;
  const std::vector<std::vector<unsigned int>> cells;
  const Parameters                             parameters;
  const bool                                   flipped;
};

/** The penalty's and the consistency terms' matrices of an edge. */
struct EdgeMatrices
{
  explicit EdgeMatrices(const unsigned int n)
    : penalty(n, n)
    , consistency(n, n)
  {}

  void
  add(const EdgeRows &rows, const double eta, const double ds)
  {
    for (unsigned int v = 0; v < 3; ++v)
      for (unsigned int i = 0; i < penalty.m(); ++i)
        for (unsigned int j = 0; j < penalty.n(); ++j)
          {
            for (unsigned int w = 0; w < 3; ++w)
              penalty(i, j) +=
                eta * ds * rows.jump(v, i) * rows.H[v][w] * rows.jump(w, j);
            consistency(i, j) +=
              ds * (rows.tested_jump(v, i) * rows.moment(v, j) +
                    rows.moment(v, i) * rows.tested_jump(v, j));
          }
  }

  FullMatrix<double> penalty;
  FullMatrix<double> consistency;
};

EdgeMatrices
make_matrices(const EdgeRecord &edge, const Route &route = Route())
{
  EdgeMatrices matrices(edge.nodes.size());
  for (const auto &point : edge.record.get_child("edge_points"))
    {
      const auto rows = edge.rows(point.second.get<double>("t"), route);
      matrices.add(rows,
                   edge.record.get<double>("eta_e"),
                   rows.frame.j0 * point.second.get<double>("weight"));
    }
  return matrices;
}

std::vector<double>
upper_triangle(const FullMatrix<double> &matrix)
{
  std::vector<double> numbers;
  for (unsigned int i = 0; i < matrix.m(); ++i)
    for (unsigned int j = i; j < matrix.n(); ++j)
      numbers.push_back(matrix(i, j));
  return numbers;
}

Tensor<1, 3>
product(const FullMatrix<double> &rows, const std::vector<double> &u)
{
  Tensor<1, 3> values;
  for (unsigned int v = 0; v < 3; ++v)
    for (unsigned int i = 0; i < u.size(); ++i)
      values[v] += rows(v, i) * u[i];
  return values;
}

double
energy(const FullMatrix<double> &matrix, const std::vector<double> &u)
{
  double sum = 0.;
  for (unsigned int i = 0; i < u.size(); ++i)
    for (unsigned int j = 0; j < u.size(); ++j)
      sum += 0.5 * u[i] * matrix(i, j) * u[j];
  return sum;
}

void
test_points(const EdgeRecord &edge)
{
  const auto trig = record_field("trig", edge.nodes);
  for (const auto &child : edge.record.get_child("edge_points"))
    {
      const Json &point = child.second;
      const auto  rows  = edge.rows(point.get<double>("t"), Route());
      const auto  check = [&](const std::string         &name,
                             const std::string         &key,
                             const std::vector<double> &found) {
        note("edges, " + name, found, numbers_of(point, key));
      };
      check("(34) t_e", "t_e", numbers_of(rows.frame.t0));
      check("(35) phi_e_1", "phi_e_1", numbers_of(rows.frame.a_cov[0]));
      check("(35) phi_e_2", "phi_e_2", numbers_of(rows.frame.a_cov[1]));
      check("j~", "ds", {rows.frame.j0});
      check("(41) H_m", "Hm_edge_voigt", numbers_of(rows.H));
      check("(42) P^-", "P_minus", numbers_of(rows.P[0]));
      check("(42) P^+", "P_plus", numbers_of(rows.P[1]));
      check("(44) p^-", "p_minus", numbers_of(rows.p[0]));
      check("(44) p^+", "p_plus", numbers_of(rows.p[1]));
      check("(37) N^ [[Delta t~]]",
            "trig_field_NDt_jump",
            numbers_of(product(rows.jump, trig)));
      check("(37) {m~}",
            "trig_field_mean_moment_voigt",
            numbers_of(product(rows.moment, trig)));
      // Where the tangent planes agree the tensors are inverse to each other.
      if (edge.record.get<double>("max_normal_angle_rad") < 1e-7)
        for (unsigned int side = 0; side < 2; ++side)
          {
            const auto &P = rows.P[side];
            note("smooth edges, P p = I",
                 numbers_of(P * rows.p[side]),
                 {1., 0., 0., 0., 1., 0., 0., 0., 1.});
            note("smooth edges, (41) P^T H_m P",
                 numbers_of(transpose(P) * rows.H_cell[side] * P),
                 numbers_of(rows.H));
          }
    }
}

/** Energies of one form, `report` or `own`, of all fields. */
void
test_energies(const EdgeRecord   &edge,
              const std::string  &form,
              const EdgeMatrices &matrices)
{
  for (const auto &field : edge.record.get_child("fields"))
    {
      const auto  u       = record_field(field.first, edge.nodes);
      const auto &numbers = field.second.get_child(form);
      for (const std::string part : {"penalty", "consistency"})
        {
          const auto &matrix =
            part == "penalty" ? matrices.penalty : matrices.consistency;
          // Energies that vanish do so up to the round-off of their terms.
          double scale = 0.;
          if (field.first != "trig")
            for (unsigned int i = 0; i < u.size(); ++i)
              scale += 0.5 * std::abs(u[i] * matrix(i, i) * u[i]);
          note("edges, U_" + part + " (" + form + "), " +
                 (field.first == "trig" ? "trig" : "others"),
               {energy(matrix, u)},
               numbers_of(numbers, "U_" + part),
               scale);
        }
    }
}

/** What the consistency terms of an edge become without a correction. */
double
miss(const EdgeRecord &edge, const Route &route)
{
  return relative_difference(make_matrices(edge, route).consistency,
                             make_matrices(edge).consistency);
}

void
test_matrices(const EdgeRecord &edge, const Json &expected)
{
  const auto matrices = make_matrices(edge);
  note("edges, K_penalty",
       upper_triangle(matrices.penalty),
       numbers_of(expected, "K_penalty_upper"));
  note("edges, K_consistency",
       upper_triangle(matrices.consistency),
       numbers_of(expected, "K_consistency_upper"));
  test_energies(edge, "report", matrices);
  Route own;
  own.edge_frame = false;
  test_energies(edge, "own", make_matrices(edge, own));
}

void
test_edges(const Json &records)
{
  Route not_pushed, not_transposed, not_reversed, not_oriented;
  not_pushed.pushed         = false;
  not_transposed.transposed = false;
  not_reversed.reversed     = false;
  not_oriented.oriented     = false;

  double pushed = 0., transposed = 0., least = 1e300, reversed = 1e300,
         oriented      = 0.;
  const Json *expected = nullptr;
  for (const auto &record : records)
    {
      const EdgeRecord edge(record.second);
      // Some records have the matrices of the one before them.
      if (!record.second.get_child("K_penalty_upper").empty())
        expected = &record.second;
      test_points(edge);
      test_matrices(edge, *expected);

      least      = std::min(least, miss(edge, not_pushed));
      pushed     = std::max(pushed, miss(edge, not_pushed));
      transposed = std::max(transposed, miss(edge, not_transposed));
      if (edge.flipped)
        oriented = miss(edge, not_oriented);
      else
        reversed = std::min(reversed, miss(edge, not_reversed));
    }
  check_above("printed (43), (45), P = p = I: at least", least, 0.2);
  check_above("printed (43), (45), P = p = I: up to", pushed, 5.);
  check_above("printed (37), N^ for N^^T: up to", transposed, 0.4);
  check_above("printed (37), K^- not reversed: at least", reversed, 0.05);
  check_above("printed (37), opposite cell with +t0", oriented, 0.4);
}

/** One-sided: [[Delta t]] = -Delta t, {m} = m. */
EdgeRows
boundary_rows(const RecordElement       &element,
              const std::vector<double> &nodes,
              const SectionLaw          &section,
              const unsigned int         side,
              const double               t)
{
  std::vector<unsigned int> cell(element.n_nodes());
  std::iota(cell.begin(), cell.end(), 0);
  const RecordPoint point(element, nodes, cell, element.edge_point(side, t));
  // K^- runs along the reversed edge.
  const auto direction = -element.edge_direction(side);
  EdgeRows   rows(nodes.size());
  rows.frame = EdgeFrame::make_edge_frame(direction[0] * point.frame.a_cov[0] +
                                            direction[1] * point.frame.a_cov[1],
                                          point.frame.t0,
                                          point.frame.t0);
  rows.H     = section.stiffness(rows.frame, Point<3>()).bending;
  add_side(point, section, 0, -1., 1., 1., Route(), rows);
  return rows;
}

/** Where the displacement of an edge vanishes, so does Delta t along it. */
void
test_edge_at_rest(const RecordElement &element,
                  const unsigned int   side,
                  const EdgeRows      &rows)
{
  double along = 0., about = 0.;
  for (unsigned int i = 0; i < rows.jump.n(); ++i)
    {
      const auto point = element.edge_point(side, 0.123);
      if (std::abs(element.derivative(i / 3, point, {{0, 0}})) > 1e-12)
        continue;
      along = std::max(along, std::abs(rows.jump(2, i)));
      about = std::max(about, std::abs(rows.jump(1, i)));
    }
  note("boundary, Delta t along an edge at rest", {along}, {0.}, about);
}

/** Energies of a boundary edge; the penalty is doubled. */
void
test_boundary(const Json &record)
{
  const RecordElement element(record.get<std::string>("type"));
  const auto          nodes = numbers_of(record, "nodes");
  const Parameters    parameters(section_text(record.get<double>("E"),
                                           record.get<double>("nu"),
                                           record.get<double>("h")));
  const bool          clamped = record.get<std::string>("kind") == "clamp";
  const unsigned int  side    = record.get<unsigned int>("local_edge");
  const double        eta     = record.get<double>("penalty_factor") *
                     record.get<double>("eta") / record.get<double>("h_e");

  const QGauss<1> quadrature(record.get<unsigned int>("n_edge_gauss"));
  EdgeMatrices    matrices(nodes.size());
  for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      const double t = 2. * quadrature.point(q)[0] - 1.;
      auto rows = boundary_rows(element, nodes, parameters.section, side, t);
      test_edge_at_rest(element, side, rows);
      // Symmetry: the rotation about the edge only, the rotation-jump form.
      if (!clamped)
        for (unsigned int i = 0; i < nodes.size(); ++i)
          rows.jump(2, i) = rows.tested_jump(2, i) = 0.;
      matrices.add(rows, eta, 2. * quadrature.weight(q) * rows.frame.j0);
    }
  for (const auto &field : record.get_child("energies"))
    {
      const auto        u    = record_field(field.first, nodes);
      const std::string name = clamped ? ", clamped" : ", symmetry";
      // Rigid motions have no moments but for round-off.
      const double penalty = energy(matrices.penalty, u);
      note("boundary, U_penalty" + name,
           {penalty},
           numbers_of(field.second, "U_penalty"));
      note("boundary, U_consistency" + name,
           {energy(matrices.consistency, u)},
           numbers_of(field.second, "U_consistency"),
           field.first == "rigid" ? penalty : 0.);
    }
}

/** Two unit squares with a fold by @p angle, their edge's energy of a field. */
double
fold_energy(const double       angle,
            const Route       &route,
            const std::string &field,
            double            &conormal_angle)
{
  const RecordElement       element("Q9");
  const Parameters          parameters(section_text(1., 0.3, 1.));
  std::vector<double>       nodes;
  std::vector<unsigned int> cell(9);
  for (const int side : {-1, 1})
    for (unsigned int k = 0; k < 9; ++k)
      {
        const Point<2> corner =
          k < 4 ? element.edge_point(k, -1.) :
                  (k < 8 ? element.edge_point(k - 4, 0.) : Point<2>());
        const double x = 0.5 * (corner[0] + side);
        nodes.push_back(side < 0 ? x : x * std::cos(angle));
        nodes.push_back(corner[1]);
        nodes.push_back(side < 0 ? 0. : x * std::sin(angle));
      }
  std::iota(cell.begin(), cell.end(), 0);
  const RecordPoint minus(element, nodes, cell, {1., 0.3});
  std::iota(cell.begin(), cell.end(), 9);
  const RecordPoint plus(element, nodes, cell, {-1., 0.3});

  EdgeRows rows(nodes.size());
  rows.frame     = EdgeFrame::make_edge_frame(-1. * minus.frame.a_cov[1],
                                          minus.frame.t0,
                                          plus.frame.t0);
  conormal_angle = std::acos(rows.frame.a_cov[1] * minus.frame.a_cov[0] /
                             minus.frame.a_cov[0].norm());
  rows.H         = parameters.section.stiffness(rows.frame, Point<3>()).bending;
  add_side(minus, parameters.section, 0, -1., 0.5, 1., route, rows);
  add_side(plus, parameters.section, 1, 1., 0.5, 1., route, rows);
  EdgeMatrices matrices(nodes.size());
  matrices.add(rows, 1., 1.);
  return energy(matrices.penalty, record_field(field, nodes));
}

/** At a crease of 90 degrees. */
void
test_fold()
{
  double     conormal_angle = 0.;
  const auto share          = [&](const Route &route) {
    return fold_energy(numbers::PI / 2., route, "rigid", conormal_angle);
  };
  Route own;
  own.edge_frame = false;
  check_below("crease, energy of a rigid rotation", share(Route()), 1e-14);
  check_above("printed (38), own frames: energy of a rigid rotation",
              share(own),
              1e-4);
  // After (36): phi_e,2 = nu^-, printed, is off by half the kink.
  check_below("crease, angle from phi_e_2 to nu^- is half the kink",
              std::abs(conormal_angle - numbers::PI / 4.),
              1e-12);
}

/** Section 3.1: 8 nodes don't hold all quadratics on cells not affine. */
void
test_eight_nodes()
{
  const std::array<Point<2>, 4> corners = {
    {{0., 0.}, {1., 0.1}, {1.4, 1.2}, {-0.1, 0.9}}};
  const Point<2> xi(0.2, -0.4);
  for (const std::string type : {"S8", "Q9"})
    {
      const RecordElement element(type);
      double              x = 0., y = 0., f = 0.;
      for (unsigned int a = 0; a < element.n_nodes(); ++a)
        {
          const auto node =
            a < 4 ?
              Vector2(corners[a]) :
              (a < 8 ? 0.5 * (Vector2(corners[a - 4]) +
                              Vector2(corners[(a - 3) % 4])) :
                       0.25 * (Vector2(corners[0]) + Vector2(corners[1]) +
                               Vector2(corners[2]) + Vector2(corners[3])));
          const double N = element.derivative(a, xi, {{0, 0}});
          x += N * node[0];
          y += N * node[1];
          f += N * node[0] * node[1];
        }
      if (type == "Q9")
        check_below("9 nodes: x y", std::abs(f - x * y), 1e-14);
      else
        check_above("8 nodes: x y", std::abs(f - x * y), 1e-3);
    }
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  Json                             edges, boundary;
  boost::property_tree::read_json(SOURCE_DIR "/conformance/edges.json", edges);
  boost::property_tree::read_json(SOURCE_DIR "/conformance/boundary.json",
                                  boundary);
  test_edges(edges);
  for (const auto &record : boundary)
    test_boundary(record.second);
  for (const auto &[name, difference] : worst)
    check_below(name, difference, tolerance);
  test_fold();
  test_eight_nodes();
  return n_failures > 0;
}
