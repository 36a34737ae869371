// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/cell_projection.h>
#include <nacre/discretization/cut_events.h>
#include <nacre/discretization/cut_trace.h>
#include <nacre/discretization/plane_geometry.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace Nacre
{
  /** What is found, before neighbours have told each other. */
  class CutTrace::Tracer
  {
  public:
    Tracer(const parallel::TriangulationBase<dim, spacedim> &mesh,
           const CellMaps                                   &maps,
           const Cuts                                       &cuts,
           const std::vector<CutPath>                       &paths);

    /** Trace this rank's cells. */
    void
    trace();

    /**
     * Tell what one cell of an edge has found to the other, on this rank and on
     * others; collective.
     */
    void
    join();

    /** Throws as check_sizes(), and for cuts without a part; collective. */
    void
    check() const;

    /** The tips of all ranks; collective. */
    std::vector<Tip>
    tips() const;

    /** Add this rank's pieces of cuts. */
    void
    add_lines(std::vector<Line> &lines) const;

    /** Hand over the chains and openings of an owned or ghost cell. */
    void
    move_to(const unsigned int                               index,
            std::vector<CutChain>                           &chains,
            std::vector<std::vector<std::array<double, 2>>> &opened,
            std::vector<std::vector<CutOpening>>            &by_cut);

  private:
    /** Several cells may share a tip. */
    struct TipOfCell
    {
      /** Whether the cut does no more than touch the cell there. */
      bool touches;
      Tip  tip;
      /** Whether it lies on a cut in the cell, and is no tip then. */
      bool joins = false;

      bool
      operator<(const TipOfCell &other) const
      {
        return touches == other.touches ? tip.cell < other.tip.cell :
                                          other.touches;
      }

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &touches &tip &joins;
      }
    };

    /** Of a cell. */
    struct CellTrace
    {
      std::vector<CutChain>                chains;
      std::vector<std::vector<CutOpening>> openings;

      bool
      is_empty() const
      {
        return chains.empty() && openings.empty();
      }

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        std::size_t n = chains.size();
        archive    &n;
        chains.resize(n);
        for (CutChain &chain : chains)
          archive &chain.points &chain.cut;
        archive &openings;
      }
    };

    void
    trace_run(const Cell &cell, const unsigned int cut, CutRun run);

    /** The begin or the end of a cut, which is the only or last event there. */
    void
    add_tip(const Cell        &cell,
            const unsigned int cut,
            const bool         at_end,
            const CutEvent    &event,
            const bool         touches);

    /** Whether it lies on another cut, or another leg of its own. */
    bool
    joins_cut(const Tip &tip) const;

    /** Add to a face, in the terms of its cell. */
    void
    open(const Cell &cell, const unsigned int face, const CutOpening &opening);

    void
    exchange();

    bool
    is_on_boundary(const Cell &cell, const CutEvent &event) const;

    /** Throws if cells at the vertices of a cut cell have other sizes. */
    void
    check_sizes() const;

    const parallel::TriangulationBase<dim, spacedim> &mesh_;
    const CellMaps                                   &maps_;
    const Cuts                                       &cuts_;
    const std::vector<CutPath>                       &paths_;
    const double                                      snap_;
    const CutFaces                                    faces_;
    std::vector<CellTrace>                            traces_;
    std::vector<TipOfCell>                            tips_;
    /** By vertex index. */
    const std::map<unsigned int, Point<spacedim>> boundary_vertices_;
  };


  CutTrace::Tracer::Tracer(
    const parallel::TriangulationBase<dim, spacedim> &mesh,
    const CellMaps                                   &maps,
    const Cuts                                       &cuts,
    const std::vector<CutPath>                       &paths)
    : mesh_(mesh)
    , maps_(maps)
    , cuts_(cuts)
    , paths_(paths)
    , snap_(std::max(cuts.snap, 1e-7))
    , faces_(maps.reference_cell)
    , traces_(mesh.n_active_cells())
    , boundary_vertices_(GridTools::get_all_vertices_at_boundary(mesh))
  {}


  void
  CutTrace::Tracer::trace()
  {
    const CutCrossings crossings(maps_, paths_, cuts_.snap);
    for (const auto &cell : mesh_.active_cell_iterators())
      if (cell->is_locally_owned() && crossings.may_cross(cell))
        for (const auto &[path, run] :
             cut_runs(crossings, paths_, faces_, cell))
          trace_run(cell, path, run);
  }


  void
  CutTrace::Tracer::trace_run(const Cell        &cell,
                              const unsigned int cut,
                              CutRun             run)
  {
    snap_points(run, faces_, snap_);
    const std::size_t n = run.size();
    if (run.front().is_begin)
      add_tip(cell, cut, false, run.front(), n == 1);
    if (run.back().is_end)
      add_tip(cell, cut, true, run.back(), n == 1);

    // From place to place on the cell's boundary
    CutChain chain{{run[0].unit}, cut};
    for (std::size_t i = 1; i < n; ++i)
      {
        const CutEvent &a = run[i - 1], &b = run[i];
        const bool      begins_here = chain.points.size() == 1 && a.faces != 0;
        const unsigned int common   = a.faces & b.faces;
        if (begins_here && common != 0)
          {
            unsigned int f = 0;
            while (((common >> f) & 1u) == 0)
              ++f;
            const double s_a = faces_.parameter(f, a.unit);
            const double s_b = faces_.parameter(f, b.unit);
            open(cell,
                 f,
                 {std::min(s_a, s_b), std::max(s_a, s_b), cut, s_a < s_b});
            chain.points = {b.unit};
            continue;
          }
        chain.points.push_back(b.unit);
        if (b.faces == 0 && i + 1 < n)
          continue;
        traces_[cell->active_cell_index()].chains.push_back(chain);
        chain.points = {b.unit};
      }
  }


  bool
  CutTrace::Tracer::is_on_boundary(const Cell     &cell,
                                   const CutEvent &event) const
  {
    for (const unsigned int v : cell->vertex_indices())
      if (event.unit == maps_.reference_cell.template vertex<dim>(v) &&
          boundary_vertices_.count(cell->vertex_index(v)) == 1)
        return true;
    for (unsigned int f = 0; f < faces_.size(); ++f)
      if (((event.faces >> f) & 1u) != 0 && cell->at_boundary(f))
        return true;
    return false;
  }


  void
  CutTrace::Tracer::add_tip(const Cell        &cell,
                            const unsigned int cut,
                            const bool         at_end,
                            const CutEvent    &event,
                            const bool         touches)
  {
    if (is_on_boundary(cell, event))
      return;
    const auto tangents = [&](const CellMaps::Map &of_cells) {
      const auto map = [&](const Point<dim> &unit) {
        return of_cells(cell, unit);
      };
      return DifferentiatedMap<decltype(map)>{map}.tangents(event.unit);
    };
    // The last leg's direction in the reference cell, then in space
    const CutPath &path = paths_[cut];
    const auto     ahead =
      at_end ? path.legs.back().along : -path.legs.front().along;
    const auto   a = tangents(path.is_in_chart ? maps_.chart : maps_.position);
    const double a_11 = a[0] * a[0], a_22 = a[1] * a[1], a_12 = a[0] * a[1];
    const double b_1 = a[0] * ahead, b_2 = a[1] * ahead;
    const auto   x = tangents(maps_.position);
    Tensor<1, spacedim> direction =
      (a_22 * b_1 - a_12 * b_2) * x[0] + (a_11 * b_2 - a_12 * b_1) * x[1];
    direction /= direction.norm();
    tips_.push_back({touches,
                     {cut,
                      at_end,
                      maps_.position(cell, event.unit),
                      direction,
                      cell->id(),
                      event.unit}});
  }


  void
  CutTrace::Tracer::open(const Cell        &cell,
                         const unsigned int face,
                         const CutOpening  &opening)
  {
    if (cell->at_boundary(face))
      return;
    auto &openings = traces_[cell->active_cell_index()].openings;
    openings.resize(faces_.size());
    // Both cells of an edge may have found it.
    if (std::none_of(openings[face].begin(),
                     openings[face].end(),
                     [&](const CutOpening &other) {
                       return other.begin == opening.begin &&
                              other.end == opening.end &&
                              other.cut == opening.cut;
                     }))
      openings[face].push_back(opening);
  }


  void
  CutTrace::Tracer::exchange()
  {
    GridTools::exchange_cell_data_to_ghosts<CellTrace>(
      mesh_,
      [&](const Cell &cell) -> std_cxx17::optional<CellTrace> {
        const CellTrace &trace = traces_[cell->active_cell_index()];
        if (trace.is_empty())
          return {};
        return trace;
      },
      [&](const Cell &cell, const CellTrace &trace) {
        traces_[cell->active_cell_index()] = trace;
      });
  }


  void
  CutTrace::Tracer::join()
  {
    exchange();
    const auto corner = [&](const unsigned int f) {
      return maps_.reference_cell.face_to_cell_vertices(f, 0, 1);
    };
    const std::vector<CellTrace> before = traces_;
    for (const auto &cell : mesh_.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          {
            if (cell->at_boundary(f) || !cell->neighbor(f)->is_active() ||
                cell->neighbor_is_coarser(f))
              continue;
            const auto  neighbor = cell->neighbor(f);
            const auto &openings =
              before[neighbor->active_cell_index()].openings;
            if (openings.empty())
              continue;
            const unsigned int g      = cell->neighbor_of_neighbor(f);
            const bool         turned = neighbor->vertex_index(corner(g)) !=
                                cell->vertex_index(corner(f));
            for (CutOpening opening : openings[g])
              {
                if (turned)
                  opening = {1. - opening.end,
                             1. - opening.begin,
                             opening.cut,
                             !opening.is_forward};
                open(cell, f, opening);
              }
          }
    exchange();
  }


  void
  CutTrace::Tracer::check_sizes() const
  {
    std::map<unsigned int, Cell> cut_cells; // by vertex
    for (const auto &cell : mesh_.active_cell_iterators())
      if (!cell->is_artificial() &&
          !traces_[cell->active_cell_index()].is_empty())
        for (const unsigned int v : cell->vertex_indices())
          cut_cells.emplace(cell->vertex_index(v), cell);
    for (const auto &cell : mesh_.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          {
            const auto cut = cut_cells.find(cell->vertex_index(v));
            if (cut == cut_cells.end() || cut->second->level() == cell->level())
              continue;
            const auto         middle = maps_.reference_cell.barycenter<dim>();
            std::ostringstream message;
            message << "Cuts/Cuts: a cut runs through the cell at ("
                    << maps_.position(cut->second, middle)
                    << "), which is of another size than the one beside it at ("
                    << maps_.position(cell, middle)
                    << "). Cells along a cut and those that touch them must be "
                       "of one size; refine them alike.";
            AssertThrow(false, ExcMessage(message.str()));
          }
  }


  void
  CutTrace::Tracer::check() const
  {
    std::vector<unsigned int> is_found(paths_.size(), 0);
    run_on_all_ranks(mesh_.get_communicator(), [&]() {
      for (const auto &cell : mesh_.active_cell_iterators())
        {
          const CellTrace &trace = traces_[cell->active_cell_index()];
          if (!cell->is_locally_owned() || trace.is_empty())
            continue;
          for (const auto &chain : trace.chains)
            is_found[chain.cut] = 1;
          for (const auto &openings : trace.openings)
            for (const auto &opening : openings)
              is_found[opening.cut] = 1;
        }
      check_sizes();
    });
    is_found = [&]() {
      std::vector<unsigned int> of_all(is_found.size());
      Utilities::MPI::max(is_found, mesh_.get_communicator(), of_all);
      return of_all;
    }();
    for (std::size_t i = 0; i < is_found.size(); ++i)
      AssertThrow(is_found[i] == 1,
                  ExcMessage("Cuts/Cuts, '" + cuts_.curves[i].name +
                             "': no part of the cut lies inside the surface; "
                             "a cut along the surface's edge, or shorter than "
                             "'Snap' of a cell, cuts nothing."));
  }


  bool
  CutTrace::Tracer::joins_cut(const Tip &tip) const
  {
    using namespace PlaneGeometry;
    const Cell       cell  = mesh_.create_cell_iterator(tip.cell);
    const CellTrace &trace = traces_[cell->active_cell_index()];
    const auto       is_on =
      [&](const unsigned int cut, const Point<dim> &a, const Point<dim> &b) {
        const bool is_its_own =
          cut == tip.cut && (a.distance(tip.unit) < snap_distance ||
                             b.distance(tip.unit) < snap_distance);
        return !is_its_own &&
               nearest_on_segment(a, b, tip.unit).distance(tip.unit) <
                 snap_distance;
      };
    for (const CutChain &chain : trace.chains)
      for (std::size_t i = 1; i < chain.points.size(); ++i)
        if (is_on(chain.cut, chain.points[i - 1], chain.points[i]))
          return true;
    for (unsigned int f = 0; f < trace.openings.size(); ++f)
      for (const CutOpening &opening : trace.openings[f])
        if (is_on(opening.cut,
                  faces_.point(f, opening.begin),
                  faces_.point(f, opening.end)))
          return true;
    return false;
  }


  std::vector<CutTrace::Tip>
  CutTrace::Tracer::tips() const
  {
    std::vector<TipOfCell> mine = tips_;
    for (TipOfCell &tip : mine)
      tip.joins = joins_cut(tip.tip);
    std::map<std::pair<unsigned int, bool>, TipOfCell> lowest;
    for (const auto &tips :
         Utilities::MPI::all_gather(mesh_.get_communicator(), mine))
      for (const TipOfCell &tip : tips)
        {
          const auto found =
            lowest.emplace(std::make_pair(tip.tip.cut, tip.tip.at_end), tip)
              .first;
          const bool joins = tip.joins || found->second.joins;
          if (tip < found->second)
            found->second = tip;
          found->second.joins = joins;
        }
    std::vector<Tip> result;
    for (const auto &[key, of_cell] : lowest)
      {
        // A cut around a closed surface ends where it has begun.
        const Tip &tip   = of_cell.tip;
        const auto other = lowest.find({key.first, !key.second});
        if (!of_cell.joins &&
            (other == lowest.end() ||
             other->second.tip.position.distance(tip.position) >
               1e-9 * Tensor<1, spacedim>(tip.position).norm()))
          result.push_back(tip);
      }
    return result;
  }


  void
  CutTrace::Tracer::add_lines(std::vector<Line> &lines) const
  {
    const unsigned int n_pieces = 8;
    const auto         add      = [&](const Cell                    &cell,
                         const unsigned int             cut,
                         const std::vector<Point<dim>> &points) {
      Line line{cut, {maps_.position(cell, points[0])}};
      for (std::size_t i = 0; i + 1 < points.size(); ++i)
        for (unsigned int k = 1; k <= n_pieces; ++k)
          {
            const double part = static_cast<double>(k) / n_pieces;
            line.points.push_back(maps_.position(
              cell,
              Point<dim>((1. - part) * points[i] + part * points[i + 1])));
          }
      lines.push_back(line);
    };
    for (const auto &cell : mesh_.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const CellTrace &trace = traces_[cell->active_cell_index()];
          for (const CutChain &chain : trace.chains)
            add(cell, chain.cut, chain.points);
          for (unsigned int f = 0; f < trace.openings.size(); ++f)
            if (!cell->at_boundary(f) && cell->id() < cell->neighbor(f)->id())
              for (const CutOpening &opening : trace.openings[f])
                add(cell,
                    opening.cut,
                    {faces_.point(f, opening.begin),
                     faces_.point(f, opening.end)});
        }
  }


  void
  CutTrace::Tracer::move_to(
    const unsigned int                               index,
    std::vector<CutChain>                           &chains,
    std::vector<std::vector<std::array<double, 2>>> &opened,
    std::vector<std::vector<CutOpening>>            &by_cut)
  {
    CellTrace &trace = traces_[index];
    chains           = std::move(trace.chains);
    opened.resize(faces_.size());
    by_cut = std::move(trace.openings);
    by_cut.resize(faces_.size());
    for (unsigned int f = 0; f < faces_.size(); ++f)
      {
        std::vector<CutOpening> sorted = by_cut[f];
        std::sort(sorted.begin(),
                  sorted.end(),
                  [](const CutOpening &a, const CutOpening &b) {
                    return a.begin < b.begin;
                  });
        for (const CutOpening &opening : sorted)
          if (!opened[f].empty() && opening.begin <= opened[f].back()[1])
            opened[f].back()[1] = std::max(opened[f].back()[1], opening.end);
          else
            opened[f].push_back({{opening.begin, opening.end}});
        std::stable_sort(by_cut[f].begin(),
                         by_cut[f].end(),
                         [](const CutOpening &a, const CutOpening &b) {
                           return a.cut < b.cut;
                         });
      }
  }


  CutTrace::CutTrace(const parallel::TriangulationBase<dim, spacedim> &mesh,
                     const CellMaps                                   &maps,
                     const Cuts                                       &cuts)
    : chains_(mesh.n_active_cells())
    , opened_(mesh.n_active_cells(),
              std::vector<std::vector<std::array<double, 2>>>(
                maps.reference_cell.n_faces()))
    , openings_(mesh.n_active_cells(),
                std::vector<std::vector<CutOpening>>(
                  maps.reference_cell.n_faces()))
  {
    if (cuts.is_empty())
      return;
    const auto paths = make_cut_paths(mesh, maps, cuts);
    Tracer     tracer(mesh, maps, cuts, paths);
    run_on_all_ranks(mesh.get_communicator(), [&]() { tracer.trace(); });
    tracer.join();
    tracer.check();
    tips_ = tracer.tips();
    run_on_all_ranks(mesh.get_communicator(),
                     [&]() { tracer.add_lines(lines_); });
    for (const auto &cell : mesh.active_cell_iterators())
      if (!cell->is_artificial())
        tracer.move_to(cell->active_cell_index(),
                       chains_[cell->active_cell_index()],
                       opened_[cell->active_cell_index()],
                       openings_[cell->active_cell_index()]);
  }


  bool
  CutTrace::is_cut(const unsigned int active_cell_index) const
  {
    return !chains_[active_cell_index].empty() ||
           std::any_of(opened_[active_cell_index].begin(),
                       opened_[active_cell_index].end(),
                       [](const auto &intervals) {
                         return !intervals.empty();
                       });
  }
} // namespace Nacre
