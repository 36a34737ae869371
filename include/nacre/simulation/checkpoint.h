// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_checkpoint_h
#define nacre_simulation_checkpoint_h

#include <nacre/analysis/path_analysis.h>
#include <nacre/forms/section_states.h>
#include <nacre/postprocess/vtu_output.h>
#include <nacre/simulation/crack_growth.h>
#include <nacre/simulation/mesh_record.h>
#include <nacre/simulation/problem_record.h>

#include <functional>
#include <string>

namespace Nacre
{
  class Discretization;

  /** How far the cuts of a path have grown. */
  struct GrowthRecord
  {
    GrowthState state;
    /**
     * Whether a step of growth comes next, and not a step of the path: from an
     * equilibrium with G = G_c h along arc length, and after one that failed.
     */
    bool is_critical = false;
    /** Rows of growth's table. */
    unsigned int n_rows = 0;
  };

  /** What the discretization of a saved state is made of. */
  struct CheckpointHead
  {
    /** Of the run that saves it. */
    ProblemRecord problem;
    GrowthRecord  growth;
    MeshRecord    mesh;
  };

  /** What a checkpoint holds. */
  struct CheckpointData : CheckpointHead
  {
    PathState state;
    /** Of lips that are being released. */
    FadingForce held;
    /** The fields written so far, by their step. */
    FieldRecords written_fields;
    /** Of a section with memory: what this rank knows, or, read, all of it. */
    std::vector<SectionStates::Record> section_states;
  };

  /**
   * Saves the state of a path in two slots in turn, a file for each rank, and
   * then, in one stroke, the name of the new slot in `NAME.checkpoint`: whoever
   * is killed at any moment finds the last complete one. Numbers are kept bit
   * for bit.
   *
   * The first entries are the layout and the CheckpointHead. Then a rank's file
   * holds the positions and values of the nodes of its cells, cell by cell
   * under the cell's CellId, which no partition changes: any number of ranks
   * can go on from it. Cells are dealt out along a curve, so that a rank finds
   * its cells in a few neighbouring files and reads no others; but of sections
   * with memory it reads all, since edges may be in the file of either cell.
   */
  class Checkpoint
  {
  public:
    /**
     * @param base_name folder and name of the run's files
     * @param where what asks for the checkpoint, for messages of load()
     */
    Checkpoint(const MPI_Comm     communicator,
               const std::string &base_name,
               const std::string &where = "--restart");

    /**
     * Collective; throws on all ranks if a file can't be written.
     * @param discretization of the state
     */
    void
    save(const Discretization &discretization, const CheckpointData &data);

    /** Says what is wrong with a record, or "". It must not communicate. */
    using Judge = std::function<std::string(const ProblemRecord &)>;

    /**
     * The head alone, whose cuts and mesh load() needs. Throws on all ranks if
     * there is no checkpoint, or one that @p judge doesn't accept. Collective.
     */
    CheckpointHead
    load_head(const Judge &judge);

    /**
     * The data on any number of ranks. Throws on all ranks if there is no
     * checkpoint, one that @p judge doesn't accept, or one of another element
     * or mesh. Collective.
     */
    CheckpointData
    load(const Discretization &discretization, const Judge &judge);

    /** Remove the files of an earlier run; on rank 0. */
    void
    remove() const;

  private:
    class CellValues;

    std::string
    slot_file(const unsigned int slot, const unsigned int rank) const;

    /** The record of the last complete slot; sets slot_. */
    void
    read_record(unsigned int &n_writers);

    /**
     * Read one file; throws ExcMessage.
     * @param values null: the head only
     */
    void
    read_file(const unsigned int writer,
              CheckpointData    &data,
              CellValues        *values,
              const Judge       &judge) const;

    /** Remove the files of the ranks from @p first on. */
    void
    remove_slot(const unsigned int slot, const unsigned int first) const;

    const MPI_Comm     communicator_;
    const std::string  base_name_;
    const std::string  where_;
    const unsigned int rank_;
    const unsigned int n_ranks_;
    unsigned int       slot_ = 0;
  };
} // namespace Nacre

#endif
