// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_problem_record_h
#define nacre_simulation_problem_record_h

#include <nacre/problem/midsurface.h>

#include <deal.II/base/mpi.h>

#include <map>
#include <string>

namespace Nacre
{
  /**
   * What a checkpoint remembers of the run that wrote it: its parameters and
   * its mesh file. A restart compares it with its own.
   */
  struct ProblemRecord
  {
    /**
     * Texts by "Section/Parameter", and the fingerprint of the content of an
     * imperfection's files.
     */
    std::map<std::string, std::string> parameters;
    /** The fingerprint of the mesh file's content; empty without one. */
    std::string  mesh_file;
    unsigned int n_ranks = 0;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &parameters &mesh_file &n_ranks;
    }
  };

  /**
   * The record of the parameters in use, of which @p midsurface has been made:
   * then the name of a mesh file is complete. Collective.
   */
  ProblemRecord
  current_problem(const MPI_Comm communicator, const Midsurface &midsurface);

  /**
   * What makes @p now another problem than @p then: "Section/Parameter: 'value
   * then' then, 'value now' now; ..."; empty if a path of one can go on with
   * the other. Values that differ in their spelling only are the same.
   */
  std::string
  forbidden_changes(const ProblemRecord &then, const ProblemRecord &now);

  /** The same of the parameters that may change at a restart. */
  std::string
  permitted_changes(const ProblemRecord &then, const ProblemRecord &now);

  /** The same of the parameters of @p section alone, whatever they are. */
  std::string
  changes_in(const std::string   &section,
             const ProblemRecord &then,
             const ProblemRecord &now);

  /** Whether a parameter has another value, but for its spelling. */
  bool
  has_changed(const std::string   &parameter,
              const ProblemRecord &then,
              const ProblemRecord &now);

  /**
   * Whether an expression of the parameters of @p section, "place: value; ..."
   * or a value, mentions the variable @p name.
   */
  bool
  mentions(const ProblemRecord &record,
           const std::string   &section,
           const std::string   &name);
} // namespace Nacre

#endif
