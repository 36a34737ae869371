// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_checkpoint_h
#define nacre_simulation_checkpoint_h

#include <nacre/analysis/path_analysis.h>

#include <map>
#include <string>

namespace Nacre
{
  /** What a checkpoint holds. */
  struct CheckpointData
  {
    PathState state;
    /** Step and time of the fields written so far. */
    std::map<unsigned int, double> written_fields;
  };

  /**
   * Saves the state of a path in two slots in turn, a file for each rank, and
   * then, in one stroke, the name of the new slot in `NAME.checkpoint`: whoever
   * is killed at any moment finds the last complete one. Numbers are kept bit
   * for bit.
   */
  class Checkpoint
  {
  public:
    /**
     * @param base_name folder and name of the run's files
     * @param problem words that tell this problem from any other
     */
    Checkpoint(const MPI_Comm     communicator,
               const std::string &base_name,
               const std::string &problem);

    /** Collective; throws on all ranks if a file can't be written. */
    void
    save(const CheckpointData &data);

    /**
     * Fill @p data, whose vectors have their distribution already. Throws if
     * there is no checkpoint, or one of another problem or number of ranks.
     */
    void
    load(CheckpointData &data);

    /** Remove the files of an earlier run; on rank 0. */
    void
    remove() const;

  private:
    std::string
    slot_file(const unsigned int slot, const unsigned int rank) const;

    const MPI_Comm     communicator_;
    const std::string  base_name_;
    const std::string  problem_;
    const unsigned int rank_;
    const unsigned int n_ranks_;
    unsigned int       slot_ = 0;
  };
} // namespace Nacre

#endif
