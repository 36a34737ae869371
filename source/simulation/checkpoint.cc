// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/output_file.h>
#include <nacre/simulation/checkpoint.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <filesystem>
#include <fstream>

namespace Nacre
{
  namespace
  {
    using Vector = TrilinosWrappers::MPI::Vector;

    std::vector<double>
    owned_values(const Vector &v)
    {
      return std::vector<double>(v.begin(), v.end());
    }

    void
    set_owned_values(Vector                    &v,
                     const std::vector<double> &values,
                     const std::string         &file)
    {
      AssertThrow(values.size() == v.locally_owned_size(),
                  ExcMessage("The checkpoint '" + file +
                             "' is of another mesh: it has " +
                             std::to_string(values.size()) +
                             " unknowns on this rank, the problem " +
                             std::to_string(v.locally_owned_size()) + "."));
      std::copy(values.begin(), values.end(), v.begin());
    }

    /** All plain numbers, in one order for both directions. */
    template <typename Archive>
    void
    numbers_of(Archive &archive, CheckpointData &data)
    {
      PathState &s = data.state;
      archive &s.step &s.time &s.next_step &s.n_good_steps &s.load_factor &s
        .iterations &s.residual &s.n_negative_pivots;
      archive                   &data.written_fields;
    }
  } // namespace

  Checkpoint::Checkpoint(const MPI_Comm     communicator,
                         const std::string &base_name,
                         const std::string &problem)
    : communicator_(communicator)
    , base_name_(base_name)
    , problem_(problem)
    , rank_(Utilities::MPI::this_mpi_process(communicator))
    , n_ranks_(Utilities::MPI::n_mpi_processes(communicator))
  {}

  std::string
  Checkpoint::slot_file(const unsigned int slot, const unsigned int rank) const
  {
    return base_name_ + ".checkpoint." + std::to_string(slot) + "." +
           std::to_string(rank);
  }

  void
  Checkpoint::save(const CheckpointData &data)
  {
    slot_ = 1 - slot_;
    run_on_all_ranks(communicator_, [&]() {
      write_file(slot_file(slot_, rank_), [&](std::ostream &out) {
        boost::archive::binary_oarchive archive(out);
        std::string                     problem = problem_;
        unsigned int                    n_ranks = n_ranks_;
        CheckpointData                  copy(data);
        archive &problem               &n_ranks;
        numbers_of(archive, copy);
        for (const Vector *v :
             {&copy.state.motion.u, &copy.state.motion.v, &copy.state.motion.a})
          {
            std::vector<double> values = owned_values(*v);
            archive            &values;
          }
      });
    });
    // All slots' files are complete: point to them.
    run_on_root(communicator_, [&]() {
      write_file(base_name_ + ".checkpoint", [&](std::ostream &out) {
        out << slot_ << ' ' << data.state.step << ' ' << n_ranks_ << '\n';
      });
    });
  }

  void
  Checkpoint::load(CheckpointData &data)
  {
    const std::string record = base_name_ + ".checkpoint";
    run_on_all_ranks(communicator_, [&]() {
      std::ifstream in(record);
      unsigned int  step = 0, n_ranks = 0;
      AssertThrow(in,
                  ExcMessage("--restart: there is no checkpoint '" + record +
                             "'. 'Analysis/Checkpoint steps' tells when one is "
                             "written."));
      in >> slot_ >> step >> n_ranks;
      AssertThrow(in && slot_ < 2,
                  ExcMessage("--restart: '" + record + "' is damaged."));
      AssertThrow(n_ranks == n_ranks_,
                  ExcMessage("--restart: the checkpoint '" + record +
                             "' was written by " + std::to_string(n_ranks) +
                             " ranks, not " + std::to_string(n_ranks_) + "."));
      const std::string file = slot_file(slot_, rank_);
      std::ifstream     state(file, std::ios::binary);
      AssertThrow(state,
                  ExcMessage("--restart: '" + file + "' can't be read."));
      try
        {
          boost::archive::binary_iarchive archive(state);
          std::string                     problem;
          archive &problem               &n_ranks;
          AssertThrow(problem == problem_,
                      ExcMessage("--restart: the checkpoint '" + record +
                                 "' is of another problem: " + problem +
                                 " instead of " + problem_ + "."));
          numbers_of(archive, data);
          for (Vector *v : {&data.state.motion.u,
                            &data.state.motion.v,
                            &data.state.motion.a})
            {
              std::vector<double> values;
              archive            &values;
              set_owned_values(*v, values, record);
            }
        }
      catch (const boost::archive::archive_exception &error)
        {
          AssertThrow(false,
                      ExcMessage("--restart: '" + file +
                                 "' is damaged: " + error.what() + "."));
        }
    });
  }

  void
  Checkpoint::remove() const
  {
    std::error_code not_there;
    std::filesystem::remove(base_name_ + ".checkpoint", not_there);
    for (const unsigned int slot : {0, 1})
      for (unsigned int rank = 0; rank < n_ranks_; ++rank)
        std::filesystem::remove(slot_file(slot, rank), not_there);
  }
} // namespace Nacre
