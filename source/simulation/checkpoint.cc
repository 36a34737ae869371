// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/output_file.h>
#include <nacre/discretization/discretization.h>
#include <nacre/simulation/checkpoint.h>
#include <nacre/simulation/growth_archive.h>

#include <deal.II/grid/cell_id.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/set.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>

namespace Nacre
{
  namespace
  {
    using Vector = TrilinosWrappers::MPI::Vector;

    /** The first entry of each file: another layout has another number. */
    const std::string layout = "nacre checkpoint 8";

    std::vector<Vector *>
    vectors_of(CheckpointData &data)
    {
      auto                 &motion = data.state.motion;
      std::vector<Vector *> vectors{&motion.u, &motion.v, &motion.a};
      if (data.held.duration > 0.)
        vectors.push_back(&data.held.force);
      return vectors;
    }

    template <typename Archive>
    void
    head_of(Archive &archive, CheckpointHead &head)
    {
      GrowthRecord &growth = head.growth;
      archive &head.problem &growth.state &growth.is_critical &growth.n_rows;
      archive &head.mesh.n_refinements &head.mesh.refined;
    }

    /** All plain numbers, in one order for both directions. */
    template <typename Archive>
    void
    numbers_of(Archive &archive, CheckpointData &data)
    {
      PathState &s = data.state;
      archive &s.step &s.time &s.next_step &s.n_good_steps &s.load_factor &s
        .iterations &s.residual &s.n_negative_pivots;
      archive &s.n_points &s.n_bifurcations &s.branch &s.begins_branch &s
        .n_controls &s.controlled;
      EnergyBalance &b = s.balance;
      archive &b.is_kept &b.kinetic &b.strain &b.initial &b.external_work &b
        .prescribed_work &b.dissipation &b.released &b.largest;
      archive &data.held.start &data.held.duration &data.written_fields;
    }
  } // namespace


  /**
   * Values of several vectors at the nodes of this rank's cells, by cell; of
   * divided ones for each part.
   */
  class Checkpoint::CellValues
  {
  public:
    explicit CellValues(const Discretization &discretization)
      : discretization_(discretization)
      , owned_(discretization.locally_owned_dofs())
    {
      for (const CellPart &part : discretization.owned_parts())
        missing_.emplace(key_of(part), part);
    }

    /** @p vectors are ghosted; one rank's own archive. */
    template <typename Archive>
    void
    write(Archive &archive, const std::vector<Vector> &vectors)
    {
      std::vector<unsigned int> keys, sizes;
      std::vector<double>       values;
      for (const CellPart &part : discretization_.owned_parts())
        {
          for (const unsigned int number : key_of(part))
            keys.push_back(number);
          for (const auto &x : discretization_.node_positions(part))
            values.insert(values.end(), x.begin_raw(), x.end_raw());
          values.push_back(fraction_of(part));
          discretization_.get_dof_indices(part, dofs_);
          sizes.push_back(dofs_.size());
          for (const Vector &vector : vectors)
            for (const auto dof : dofs_)
              values.push_back(vector(dof));
        }
      unsigned int                  n_dofs = discretization_.node_dofs().size();
      archive &n_dofs &keys &sizes &values;
    }

    /**
     * Take the values of those cells that are this rank's. Throws what is wrong
     * with @p file.
     */
    template <typename Archive>
    void
    read(Archive                     &archive,
         const std::vector<Vector *> &vectors,
         const std::string           &file)
    {
      unsigned int                  n_dofs = 0;
      std::vector<unsigned int>     keys, sizes;
      std::vector<double>           values;
      archive &n_dofs &keys &sizes &values;
      const unsigned int            n_here = discretization_.node_dofs().size();
      const std::size_t             n_cells = sizes.size();
      const std::size_t             n_values =
        n_cells * (n_dofs + 1) +
        vectors.size() * std::accumulate(sizes.begin(), sizes.end(), 0ul);
      AssertThrow(n_dofs == n_here && values.size() == n_values,
                  ExcMessage(file + "' is of another element: " +
                             std::to_string(n_dofs) + " unknowns a cell, and " +
                             std::to_string(n_here) + " here."));
      Key  key;
      auto next = values.begin();
      for (std::size_t k = 0; k < n_cells; ++k)
        {
          auto value = next;
          next += n_dofs + 1 + vectors.size() * sizes[k];
          std::copy_n(keys.begin() + k * key.size(), key.size(), key.begin());
          const auto found = missing_.find(key);
          if (found == missing_.end())
            continue;
          discretization_.get_dof_indices(found->second, dofs_);
          check_positions(found->second, &*value, file);
          value += n_dofs;
          AssertThrow(std::abs(*value - fraction_of(found->second)) <= 1e-6 &&
                        sizes[k] == dofs_.size(),
                      ExcMessage(file + "' is of a shell with other cuts "
                                        "(Cuts/Cuts, Tips), or with cuts that "
                                        "have grown (Growth/Tips)."));
          ++value;
          for (Vector *const vector : vectors)
            for (const auto dof : dofs_)
              {
                if (owned_.is_element(dof))
                  (*vector)(dof) = *value;
                ++value;
              }
          missing_.erase(found);
        }
    }

    bool
    is_complete() const
    {
      return missing_.empty();
    }

  private:
    /** Of a cell, and the number of the part. */
    using Key =
      std::array<unsigned int, std::tuple_size_v<CellId::binary_type> + 1>;

    static Key
    key_of(const CellPart &part)
    {
      Key        key;
      const auto cell = part.cell->id().to_binary<dim>();
      std::copy(cell.begin(), cell.end(), key.begin());
      key.back() = part.data != nullptr ? part.data->number : 0;
      return key;
    }

    /** Of its cell. */
    static double
    fraction_of(const CellPart &part)
    {
      return part.data != nullptr ? part.data->fraction : 1.;
    }

    /** Throw if the nodes of the @p part don't lie at the @p coordinates. */
    void
    check_positions(const CellPart    &part,
                    const double      *coordinates,
                    const std::string &file) const
    {
      // Positions depend on the number of ranks by rounding only.
      const double tolerance = 1e-6 * part.cell->diameter();
      for (const auto &x : discretization_.node_positions(part))
        {
          Point<spacedim> other;
          for (unsigned int c = 0; c < spacedim; ++c)
            other[c] = *coordinates++;
          if (x.distance(other) <= tolerance)
            continue;
          std::ostringstream message;
          message << file << "' is of another mesh: a node lies at (" << other
                  << ") there, and at (" << x << ") here.";
          AssertThrow(false, ExcMessage(message.str()));
        }
    }

    const Discretization                &discretization_;
    const IndexSet                      &owned_;
    std::vector<types::global_dof_index> dofs_;
    std::map<Key, CellPart>              missing_;
  };


  Checkpoint::Checkpoint(const MPI_Comm     communicator,
                         const std::string &base_name,
                         const std::string &where)
    : communicator_(communicator)
    , base_name_(base_name)
    , where_(where)
    , rank_(Utilities::MPI::this_mpi_process(communicator_))
    , n_ranks_(Utilities::MPI::n_mpi_processes(communicator_))
  {}

  std::string
  Checkpoint::slot_file(const unsigned int slot, const unsigned int rank) const
  {
    return base_name_ + ".checkpoint." + std::to_string(slot) + "." +
           std::to_string(rank);
  }

  void
  Checkpoint::save(const Discretization &discretization,
                   const CheckpointData &data)
  {
    slot_ = 1 - slot_;
    CheckpointData copy(data);
    if (copy.held.share(copy.state.time) == 0.)
      copy.held = FadingForce();
    std::vector<Vector> ghosted;
    for (const Vector *const vector : vectors_of(copy))
      {
        ghosted.emplace_back(discretization.locally_owned_dofs(),
                             discretization.locally_relevant_dofs(),
                             communicator_);
        ghosted.back() = *vector;
      }
    run_on_all_ranks(communicator_, [&]() {
      write_file(slot_file(slot_, rank_), [&](std::ostream &out) {
        // An archive writes past the stream, which wouldn't notice a full disk.
        std::ostringstream              content;
        boost::archive::binary_oarchive archive(content);
        archive                        &layout;
        head_of(archive, copy);
        numbers_of(archive, copy);
        archive &copy.section_states;
        CellValues(discretization).write(archive, ghosted);
        out << content.str();
      });
    });
    // All slots' files are complete: point to them.
    run_on_root(communicator_, [&]() {
      write_file(base_name_ + ".checkpoint", [&](std::ostream &out) {
        out << slot_ << ' ' << data.state.step << ' ' << n_ranks_ << '\n';
      });
      // Files of an earlier run on more ranks may still be in this slot.
      remove_slot(slot_, n_ranks_);
    });
  }

  void
  Checkpoint::read_record(unsigned int &n_writers)
  {
    const std::string record = base_name_ + ".checkpoint";
    std::ifstream     in(record);
    unsigned int      step = 0;
    AssertThrow(in,
                ExcMessage(where_ + ": there is no checkpoint '" + record +
                           "'. 'Analysis/Checkpoint steps' tells when one is "
                           "written."));
    in >> slot_ >> step >> n_writers;
    AssertThrow(in && slot_ < 2 && n_writers > 0,
                ExcMessage(where_ + ": '" + record + "' is damaged."));
  }

  void
  Checkpoint::read_file(const unsigned int writer,
                        CheckpointData    &data,
                        CellValues        *values,
                        const Judge       &judge) const
  {
    const std::string file = slot_file(slot_, writer);
    std::ifstream     in(file, std::ios::binary);
    AssertThrow(in, ExcMessage(where_ + ": '" + file + "' can't be read."));
    try
      {
        boost::archive::binary_iarchive archive(in);
        std::string                     found_layout;
        archive                        &found_layout;
        AssertThrow(found_layout == layout,
                    ExcMessage(where_ + ": '" + file +
                               "' was written by another version of nacre ('" +
                               found_layout + "' instead of '" + layout +
                               "'): go on with that version, or start anew."));
        head_of(archive, data);
        const std::string complaint = judge(data.problem);
        AssertThrow(complaint.empty(),
                    ExcMessage(where_ + ": the checkpoint '" + base_name_ +
                               ".checkpoint' is of another problem: " +
                               complaint + "."));
        if (values == nullptr)
          return;
        numbers_of(archive, data);
        std::vector<SectionStates::Record> states;
        archive                           &states;
        data.section_states.insert(data.section_states.end(),
                                   states.begin(),
                                   states.end());
        values->read(archive, vectors_of(data), where_ + ": '" + file);
      }
    catch (const boost::archive::archive_exception &error)
      {
        AssertThrow(false,
                    ExcMessage(where_ + ": '" + file +
                               "' is damaged: " + error.what() + "."));
      }
  }

  CheckpointHead
  Checkpoint::load_head(const Judge &judge)
  {
    CheckpointData data;
    run_on_all_ranks(communicator_, [&]() {
      unsigned int n_writers = 0;
      read_record(n_writers);
      // The cells of all ranks.
      for (unsigned int writer = 0; writer < n_writers; ++writer)
        {
          auto before = std::move(data.mesh.refined);
          read_file(writer, data, nullptr, judge);
          data.mesh.refined.merge(before);
          if (data.mesh.n_refinements == 0)
            break;
        }
    });
    return data;
  }

  CheckpointData
  Checkpoint::load(const Discretization &discretization, const Judge &judge)
  {
    CheckpointData data;
    auto          &motion = data.state.motion;
    for (Vector *const vector :
         {&motion.u, &motion.v, &motion.a, &data.held.force})
      vector->reinit(discretization.locally_owned_dofs(), communicator_);
    run_on_all_ranks(communicator_, [&]() {
      unsigned int n_writers = 0;
      read_record(n_writers);
      // The files in the order of their distance on the curve, this rank's
      // place on which is the same part of the whole.
      std::vector<unsigned int> writers(n_writers);
      for (unsigned int writer = 0; writer < n_writers; ++writer)
        writers[writer] = writer;
      const double place = (rank_ + 0.5) * n_writers / n_ranks_ - 0.5;
      std::stable_sort(writers.begin(),
                       writers.end(),
                       [place](const unsigned int a, const unsigned int b) {
                         return std::abs(a - place) < std::abs(b - place);
                       });
      CellValues values(discretization);
      for (const unsigned int writer : writers)
        {
          // A rank without cells needs the numbers of the path, too.
          if (values.is_complete() && writer != writers.front() &&
              data.section_states.empty())
            break;
          read_file(writer, data, &values, judge);
        }
      AssertThrow(values.is_complete(),
                  ExcMessage(where_ + ": the checkpoint '" + base_name_ +
                             ".checkpoint' is of another mesh: it lacks cells "
                             "of this one."));
    });
    for (Vector *const vector : vectors_of(data))
      vector->compress(VectorOperation::insert);
    return data;
  }

  void
  Checkpoint::remove_slot(const unsigned int slot,
                          const unsigned int first) const
  {
    std::error_code not_there;
    for (unsigned int rank = first;
         std::filesystem::remove(slot_file(slot, rank), not_there);
         ++rank)
      {}
  }

  void
  Checkpoint::remove() const
  {
    std::error_code not_there;
    std::filesystem::remove(base_name_ + ".checkpoint", not_there);
    for (const unsigned int slot : {0, 1})
      remove_slot(slot, 0);
  }
} // namespace Nacre
