// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_section_states_h
#define nacre_forms_section_states_h

#include <nacre/discretization/part_transfer.h>
#include <nacre/discretization/shell_edge_values.h>
#include <nacre/discretization/shell_values.h>
#include <nacre/mechanics/section_law.h>

#include <array>
#include <functional>
#include <map>
#include <vector>

namespace Nacre
{
  /** The state of a section at a point, as a form sees it. */
  struct PointState
  {
    /** Empty: at rest. */
    ArrayView<double> values = {};
    /** Whether the form must replace it by that of the end of the step. */
    bool is_updated = false;
  };

  /**
   * The states of a section with memory at all points at which this rank's
   * forms ask it: those of its cells' rule, and those of both sides of the
   * edges that it assembles, whose cells may be ghosts. They are those of the
   * start of a step, and nothing but update() replaces them: a step that fails
   * leaves them as they were. Of laws without states nothing is stored or
   * looked up.
   *
   * Points are found by their cell, its part and their places in the reference
   * cell, which no partition changes. Not for several threads at a time.
   */
  class SectionStates
  {
    /** As a face: the points of the cell's rule. */
    static constexpr unsigned int inside = numbers::invalid_unsigned_int;

  public:
    explicit SectionStates(const SectionLaw &section)
      : n_variables_(section.n_state_variables())
    {}

    /** The states of the points of a cell, or of one side of an edge. */
    class Points
    {
    public:
      PointState
      operator[](const unsigned int q) const
      {
        if (first_ == nullptr)
          return {};
        return {{first_ + q * n_variables_, n_variables_}, is_updated_};
      }

    private:
      friend class SectionStates;

      double     *first_       = nullptr; // null: all are at rest
      std::size_t n_variables_ = 0;
      bool        is_updated_  = false;
    };

    /** Whether the section has no memory. */
    bool
    has_none() const
    {
      return n_variables_ == 0;
    }

    /** At the points of the rule of @p values, which are those of @p part. */
    Points
    of_cell(const CellPart &part, const ShellCellValues &values)
    {
      return has_none() ?
               Points() :
               find(key_of(part, inside), values.quadrature().get_points());
    }

    /** At the points of the side @p side of an edge. */
    Points
    of_side(const ShellEdgeValues &edge, const unsigned int side)
    {
      return has_none() ? Points() :
                          find(key_of(edge.part(side), edge.face(side)),
                               edge.unit_points(side));
    }

    /** Of both sides of an edge; of @p states that are null: all at rest. */
    static std::array<Points, 2>
    of_edge(SectionStates *const states, const ShellEdgeValues &edge)
    {
      std::array<Points, 2> result;
      for (unsigned int s = 0; states != nullptr && s < edge.n_sides(); ++s)
        result[s] = states->of_side(edge, s);
      return result;
    }

    /**
     * Replace all states: @p assemble must ask for each point once and replace
     * its state, as PointState::is_updated tells it to. Points that it doesn't
     * ask for are forgotten. Ghosts get those of their cells' rule. Collective.
     */
    void
    update(const Discretization        &discretization,
           const std::function<void()> &assemble);

    /**
     * The state of the point of a cell's rule which is nearest to @p unit in
     * the reference cell. The cell is one of this rank's or a ghost.
     */
    SectionState
    nearest(const CellPart &part, const Point<dim> &unit) const;

    /** The states of some points, as a checkpoint keeps them. */
    struct Record
    {
      CellId::binary_type     cell;
      unsigned int            part;
      unsigned int            face;
      std::vector<Point<dim>> points;
      std::vector<double>     values;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        for (unsigned int &number : cell)
          archive &number;
        archive &part &face &points &values;
      }
    };

    /** What this rank knows; of the rules of ghosts their owners do. */
    std::vector<Record>
    records(const Discretization &discretization) const;

    /**
     * Take those of this rank's cells and of its ghosts; of other points in a
     * cell than its rule's, all points take the nearest. Collective.
     */
    void
    take(const Discretization      &discretization,
         const std::vector<Record> &records);

    /** The states of a cell's rule, for PartTransfer. */
    std::function<PointValues(const CellPart &)>
    of_rules() const;

    /**
     * Take what @p transfer brings of the mesh before: all points take the
     * nearest of their cell's rule there. Collective.
     */
    void
    take(const Discretization &discretization, const PartTransfer &transfer);

  private:
    /** Active cell index, part, and face or inside. */
    using Key = std::array<unsigned int, 3>;

    using Entry = PointValues;

    /** Values: [q][variable] */
    using Entries = std::map<Key, std::vector<Entry>>;

    static Key
    key_of(const CellPart &part, const unsigned int face)
    {
      return {{part.cell->active_cell_index(),
               part.data != nullptr ? part.data->number : 0,
               face}};
    }

    /** The states at @p points, or none if they are at rest. */
    Points
    find(const Key &key, const std::vector<Point<dim>> &points);

    /**
     * Null if there is none. An edge's points may be stored from its other end:
     * they are turned round then. Points that aren't stored take the state of
     * the nearest of their cell's rule.
     */
    Entry *
    stored(const Key &key, const std::vector<Point<dim>> &points);

    Entry
    turned_round(const Entry &entry) const;

    void
    send_to_ghosts(const Discretization &discretization);

    unsigned int n_variables_;
    Entries      states_;
    /** At the end of the step, during update(). */
    Entries next_;
    bool    is_updating_ = false;
  };
} // namespace Nacre

#endif
