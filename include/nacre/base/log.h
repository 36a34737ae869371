// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_log_h
#define nacre_base_log_h

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/mpi.h>

#include <set>
#include <string>

namespace Nacre
{
  /** What a run tells on the terminal; only rank 0 prints. */
  class Log
  {
  public:
    /** @param quiet whether progress() is suppressed. */
    explicit Log(const MPI_Comm communicator, const bool quiet = false);

    /** Lines that tell how far the run is; nothing if quiet. */
    dealii::ConditionalOStream &
    progress();

    /** Print what the run is made for, such as the table, even if quiet. */
    dealii::ConditionalOStream &
    results();

    /**
     * "nacre: warning: text" on std::cerr, once for each text, also if quiet.
     */
    void
    warning(const std::string &text);

    /** "nacre: note: text", likewise: what a user may want to know. */
    void
    note(const std::string &text);

    /** Different warnings so far. */
    unsigned int
    n_warnings() const
    {
      return n_warnings_;
    }

    bool
    is_quiet() const;

  private:
    /** Print @p line on std::cerr, once; whether it is new. */
    bool
    tell_once(const std::string &line);

    bool                       quiet_;
    dealii::ConditionalOStream progress_;
    dealii::ConditionalOStream results_;
    dealii::ConditionalOStream errors_;
    std::set<std::string>      told_;
    unsigned int               n_warnings_ = 0;
  };
} // namespace Nacre

#endif
