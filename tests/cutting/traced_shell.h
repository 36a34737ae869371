// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_traced_shell_h
#define nacre_tests_traced_shell_h

// A surface with its mesh, and what a trace of cuts through it amounts to.

#include <nacre/discretization/cut_trace.h>
#include <nacre/problem/midsurface.h>

#include <deal.II/base/mpi.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Tests
{
  using namespace Nacre;

  using Points = std::vector<Point<3>>;
  using Mesh   = parallel::TriangulationBase<2, 3>;

  /** A surface with its mesh. */
  struct Shell
  {
    Shell(const std::string  &prm,
          const unsigned int  n_refinements,
          const ReferenceCell cell = ReferenceCells::Quadrilateral)
    {
      ParameterAcceptor::clear();
      MidsurfaceParameters parameters;
      ParameterAcceptor::declare_all_parameters();
      std::string text = "subsection Mid-surface\n";
      for (const char c : prm)
        text += (c == ';' ? '\n' : c);
      ParameterAcceptor::prm.parse_input_from_string(text + "\nend\n");
      ParameterAcceptor::parse_all_parameters();
      surface =
        std::make_unique<const Midsurface>(parameters.make({{"R", 2.}}));
      mesh = surface->create_triangulation(MPI_COMM_WORLD, cell, n_refinements);
      maps = make_cell_maps(*surface, cell);
    }

    std::unique_ptr<const Midsurface> surface;
    std::unique_ptr<Mesh>             mesh;
    CellMaps                          maps;
  };

  /** How many chains and openings end at the places on a face. */
  inline std::map<double, unsigned int>
  places(const Shell       &shell,
         const CutTrace    &trace,
         const unsigned int cell,
         const unsigned int face,
         const bool         is_turned)
  {
    const auto &reference = shell.maps.reference_cell;
    const auto  corner    = [&](const unsigned int i) {
      return reference.vertex<2>(reference.face_to_cell_vertices(face, i, 1));
    };
    const Tensor<1, 2>             along = corner(1) - corner(0);
    std::map<double, unsigned int> result;
    const auto                     add = [&](const double s) {
      if (s > 0. && s < 1.)
        ++result[is_turned ? 1. - s : s];
    };
    for (const CutChain &chain : trace.chains(cell))
      for (const auto &x : {chain.points.front(), chain.points.back()})
        {
          const Tensor<1, 2> to = x - corner(0);
          if (to[0] * along[1] - to[1] * along[0] == 0.)
            add(to * along / (along * along));
        }
    for (const auto &[begin, end] : trace.opened(cell, face))
      {
        add(begin);
        add(end);
      }
    return result;
  }

  /**
   * Whether cuts pass through the same places of an edge. A cut may turn back
   * there, or meet an opening.
   */
  inline bool
  agree(const std::map<double, unsigned int>     &a,
        const std::map<double, unsigned int>     &b,
        const std::vector<std::array<double, 2>> &opened)
  {
    for (const auto *one : {&a, &b})
      for (const auto &place : *one)
        {
          const double s = place.first;
          const bool   is_opened =
            std::any_of(opened.begin(),
                        opened.end(),
                        [&](const auto &interval) {
                          return interval[0] <= s && s <= interval[1];
                        });
          if (place.second % 2 == 1 && !is_opened &&
              (one == &a ? b : a).count(s) == 0)
            return false;
        }
    return true;
  }

  /** Edges whose two cells don't agree exactly, but for tips there. */
  inline unsigned int
  n_different_edges(const Shell &shell, const CutTrace &trace)
  {
    unsigned int n = 0;
    for (const auto &cell : shell.mesh->active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        {
          if (!cell->is_locally_owned() || cell->at_boundary(f) ||
              !cell->neighbor(f)->is_active() || cell->neighbor_is_coarser(f))
            continue;
          const auto         other = cell->neighbor(f);
          const unsigned int g     = cell->neighbor_of_neighbor(f);
          const auto         first = [&](const auto &k, const unsigned int h) {
            return k->vertex_index(
              shell.maps.reference_cell.face_to_cell_vertices(h, 0, 1));
          };
          const bool is_turned = first(cell, f) != first(other, g);
          const auto here =
            places(shell, trace, cell->active_cell_index(), f, false);
          const auto there =
            places(shell, trace, other->active_cell_index(), g, is_turned);
          auto intervals = trace.opened(other->active_cell_index(), g);
          if (is_turned)
            {
              std::reverse(intervals.begin(), intervals.end());
              for (auto &[begin, end] : intervals)
                std::tie(begin, end) = std::make_pair(1. - end, 1. - begin);
            }
          bool is_tip = false;
          for (const auto &tip : trace.tips())
            is_tip =
              is_tip || tip.cell == cell->id() || tip.cell == other->id();
          const auto &opened = trace.opened(cell->active_cell_index(), f);
          if ((!agree(here, there, opened) && !is_tip) || intervals != opened)
            ++n;
        }
    return Utilities::MPI::sum(n, MPI_COMM_WORLD);
  }

  /** What a trace amounts to on all ranks. */
  struct Summary
  {
    unsigned int n_chains = 0;
    unsigned int n_opened = 0;
    double       length   = 0.;
    /** Ends that nothing continues. */
    Points loose_ends;
  };

  /** Whether a line passes through @p x. */
  inline bool
  ends_on_one(const std::vector<Points> &lines, const Point<3> &x)
  {
    for (const auto &line : lines)
      for (std::size_t i = 1; i < line.size(); ++i)
        {
          const Tensor<1, 3> along = line[i] - line[i - 1];
          const double s = (x - line[i - 1]) * along / along.norm_square();
          if (s >= 0. && s <= 1. && x.distance(line[i - 1] + s * along) < 1e-9)
            if (x.distance(line.front()) > 1e-9 &&
                x.distance(line.back()) > 1e-9)
              return true;
        }
    return false;
  }

  inline Summary
  summarise(const Shell &shell, const CutTrace &trace)
  {
    Summary result;
    for (const auto &cell : shell.mesh->active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int k = cell->active_cell_index();
          result.n_chains += trace.chains(k).size();
          for (const unsigned int f : cell->face_indices())
            if (!cell->at_boundary(f) && cell->id() < cell->neighbor(f)->id())
              result.n_opened += trace.opened(k, f).size();
        }
    Points              ends;
    std::vector<Points> lines;
    for (const auto &line : trace.lines())
      {
        for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
          result.length += line.points[i].distance(line.points[i + 1]);
        ends.push_back(line.points.front());
        ends.push_back(line.points.back());
        lines.push_back(line.points);
      }
    result.n_chains = Utilities::MPI::sum(result.n_chains, MPI_COMM_WORLD);
    result.n_opened = Utilities::MPI::sum(result.n_opened, MPI_COMM_WORLD);
    result.length   = Utilities::MPI::sum(result.length, MPI_COMM_WORLD);
    Points all;
    for (const auto &part : Utilities::MPI::all_gather(MPI_COMM_WORLD, ends))
      all.insert(all.end(), part.begin(), part.end());
    std::vector<Points> all_lines;
    for (const auto &part : Utilities::MPI::all_gather(MPI_COMM_WORLD, lines))
      all_lines.insert(all_lines.end(), part.begin(), part.end());
    for (const auto &x : all)
      if (!ends_on_one(all_lines, x) &&
          std::count_if(all.begin(), all.end(), [&](const Point<3> &y) {
            return x.distance(y) < 1e-9;
          }) == 1)
        result.loose_ends.push_back(x);
    return result;
  }
} // namespace Tests

#endif
