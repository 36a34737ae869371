// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/section_states.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    /** Index of that one of the points which is nearest to @p place. */
    std::size_t
    nearest_of(const std::vector<Point<dim>> &points, const Point<dim> &place)
    {
      return std::min_element(points.begin(),
                              points.end(),
                              [&](const auto &a, const auto &b) {
                                return a.distance_square(place) <
                                       b.distance_square(place);
                              }) -
             points.begin();
    }
  } // namespace

  void
  SectionStates::update(const Discretization        &discretization,
                        const std::function<void()> &assemble)
  {
    if (has_none())
      return;
    next_.clear();
    is_updating_ = true;
    assemble();
    is_updating_ = false;
    states_.swap(next_);
    next_.clear();
    send_to_ghosts(discretization);
  }

  SectionStates::Points
  SectionStates::find(const Key &key, const std::vector<Point<dim>> &points)
  {
    Entry *entry = stored(key, points);
    if (is_updating_)
      {
        auto &ends = next_[key];
        if (entry != nullptr)
          ends.push_back(*entry);
        else
          ends.push_back(
            {points, std::vector<double>(points.size() * n_variables_)});
        entry = &ends.back();
      }
    Points result;
    if (entry == nullptr)
      return result;
    result.first_       = entry->values.data();
    result.n_variables_ = n_variables_;
    result.is_updated_  = is_updating_;
    return result;
  }

  SectionStates::Entry *
  SectionStates::stored(const Key &key, const std::vector<Point<dim>> &points)
  {
    // The rounding of places may differ from run to run, by no more.
    const auto is_same = [](const Point<dim> &a, const Point<dim> &b) {
      return a.distance(b) < 1e-8;
    };
    if (const auto found = states_.find(key); found != states_.end())
      for (Entry &entry : found->second)
        {
          if (entry.points.size() != points.size())
            continue;
          if (is_same(entry.points.front(), points.front()) &&
              is_same(entry.points.back(), points.back()))
            return &entry;
          if (is_same(entry.points.back(), points.front()) &&
              is_same(entry.points.front(), points.back()))
            {
              entry = turned_round(entry);
              return &entry;
            }
        }
    // Of a mesh that was refined since: what the nearest points remember.
    const auto rule = states_.find({{key[0], key[1], inside}});
    if (rule == states_.end())
      return nullptr;
    Entry entry{points, {}};
    for (const auto &point : points)
      {
        const Entry &before = rule->second.front();
        const auto   first  = before.values.begin() +
                           n_variables_ * nearest_of(before.points, point);
        entry.values.insert(entry.values.end(), first, first + n_variables_);
      }
    states_[key].push_back(std::move(entry));
    return &states_[key].back();
  }

  SectionStates::Entry
  SectionStates::turned_round(const Entry &entry) const
  {
    Entry result{{entry.points.rbegin(), entry.points.rend()}, {}};
    for (unsigned int q = entry.points.size(); q-- > 0;)
      result.values.insert(result.values.end(),
                           entry.values.begin() + q * n_variables_,
                           entry.values.begin() + (q + 1) * n_variables_);
    return result;
  }

  SectionState
  SectionStates::nearest(const CellPart &part, const Point<dim> &unit) const
  {
    const auto found = states_.find(key_of(part, inside));
    if (found == states_.end())
      return {};
    const Entry &entry = found->second.front();
    return {&entry.values[nearest_of(entry.points, unit) * n_variables_],
            n_variables_};
  }

  void
  SectionStates::send_to_ghosts(const Discretization &discretization)
  {
    using Cell    = CellPart::Cell;
    using Message = std::map<unsigned int, std::vector<Entry>>;
    GridTools::exchange_cell_data_to_ghosts<Message>(
      discretization.dof_handler(),
      [&](const Cell &cell) -> std_cxx17::optional<Message> {
        Message message;
        for (unsigned int k = 0; k < discretization.cell_parts().n_parts(cell);
             ++k)
          {
            const auto part  = discretization.cell_parts().part(cell, k);
            const auto found = states_.find(key_of(part, inside));
            if (found != states_.end())
              message.emplace(found->first[1], found->second);
          }
        return message;
      },
      [&](const Cell &cell, const Message &message) {
        for (const auto &[part, entries] : message)
          states_[{{cell->active_cell_index(), part, inside}}] = entries;
      });
  }

  std::vector<SectionStates::Record>
  SectionStates::records(const Discretization &discretization) const
  {
    std::vector<Record> result;
    if (has_none())
      return result;
    for (const auto &cell :
         discretization.triangulation().active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        const unsigned int index = cell->active_cell_index();
        for (auto entries = states_.lower_bound({{index, 0, 0}});
             entries != states_.end() && entries->first[0] == index;
             ++entries)
          {
            const auto [of_cell, part, face] = entries->first;
            (void)of_cell;
            if (face == inside && cell->is_ghost())
              continue;
            for (const Entry &entry : entries->second)
              result.push_back({cell->id().to_binary<dim>(),
                                part,
                                face,
                                entry.points,
                                entry.values});
          }
      }
    return result;
  }

  void
  SectionStates::take(const Discretization      &discretization,
                      const std::vector<Record> &records)
  {
    states_.clear();
    if (has_none())
      return;
    std::map<CellId::binary_type, unsigned int> indices;
    for (const auto &cell :
         discretization.triangulation().active_cell_iterators())
      if (!cell->is_artificial())
        indices.emplace(cell->id().to_binary<dim>(), cell->active_cell_index());
    for (const Record &record : records)
      {
        const auto index = indices.find(record.cell);
        if (index == indices.end())
          continue;
        AssertThrow(record.values.size() == record.points.size() * n_variables_,
                    ExcMessage("Section: its states are of another law than "
                               "those of the checkpoint."));
        states_[{{index->second, record.part, record.face}}].push_back(
          {record.points, record.values});
      }
    send_to_ghosts(discretization);
  }

  std::function<PointValues(const CellPart &)>
  SectionStates::of_rules() const
  {
    if (has_none())
      return {};
    return [this](const CellPart &part) {
      const auto found = states_.find(key_of(part, inside));
      return found == states_.end() ? PointValues() : found->second.front();
    };
  }

  void
  SectionStates::take(const Discretization &discretization,
                      const PartTransfer   &transfer)
  {
    states_.clear();
    if (has_none())
      return;
    for (const CellPart &part : discretization.owned_parts())
      if (auto values = transfer.points_of(part); !values.points.empty())
        states_[key_of(part, inside)].push_back(std::move(values));
    send_to_ghosts(discretization);
  }
} // namespace Nacre
