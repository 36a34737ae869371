// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/solvers/sparse_rows.h>
#include <nacre/solvers/symmetric_factors.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <dmumps_c.h>

#include <algorithm>
#include <limits>

namespace Nacre
{
  namespace
  {
    /** The upper triangle's entries of this rank, indices from one. */
    struct Entries
    {
      Entries(const SymmetricFactors::Matrix &matrix,
              const NonzeroEntries           &pattern,
              const bool                      with_values);

      std::vector<MUMPS_INT> rows, columns;
      std::vector<double>    values;
    };


    Entries::Entries(const SymmetricFactors::Matrix &matrix,
                     const NonzeroEntries           &pattern,
                     const bool                      with_values)
    {
      const SparseRows A(matrix);
      rows.reserve(pattern.n_upper());
      columns.reserve(pattern.n_upper());
      values.reserve(with_values ? pattern.n_upper() : 0);

      std::vector<MUMPS_INT> ids(A.n_columns());
      for (unsigned int j = 0; j < ids.size(); ++j)
        ids[j] = A.global_column(j) + 1;
      for (unsigned int i = 0; i < A.n_rows(); ++i)
        {
          const SparseRows::Row entries = A[i];
          const MUMPS_INT       row     = A.global_row(i) + 1;
          for (unsigned int k = 0; k < entries.length; ++k)
            {
              const MUMPS_INT column = ids[entries.columns[k]];
              if (column < row ||
                  (column > row && !pattern.contains(entries.values[k])))
                continue;
              rows.push_back(row);
              columns.push_back(column);
              if (with_values)
                values.push_back(entries.values[k]);
            }
        }
    }


    class MumpsFactors : public SymmetricFactors
    {
    public:
      MumpsFactors(const MPI_Comm communicator, const bool with_pivoting);
      ~MumpsFactors() override;

      MumpsFactors(const MumpsFactors &) = delete;
      MumpsFactors &
      operator=(const MumpsFactors &) = delete;

      void
      analyse(const Matrix           &matrix,
              const NonzeroEntries   &pattern,
              const std::vector<int> &place) override;

      bool
      factorize(const Matrix &matrix, const NonzeroEntries &pattern) override;

      void
      substitute(Vector &x, const Vector &b) override;

      unsigned int
      n_negative_pivots() const override
      {
        return mumps_.infog[11];
      }

      double
      memory() const override
      {
        return 1e6 * mumps_.infog[16];
      }

    private:
      /** Hand over @p entries and do @p job. */
      void
      run(const MUMPS_INT job, Entries &entries);
      /** Throw on all ranks if the last call of MUMPS failed. */
      void
      check_status() const;

      MPI_Comm       communicator_;
      DMUMPS_STRUC_C mumps_;
      /** Place of each unknown in the order of pivots from one, on rank 0. */
      std::vector<MUMPS_INT> places_;
      /** Of each rank: number of rows and first row. */
      std::vector<int> counts_, offsets_;
    };


    MumpsFactors::MumpsFactors(const MPI_Comm communicator,
                               const bool     with_pivoting)
      : communicator_(communicator)
      , mumps_()
    {
      mumps_.par          = 1;
      mumps_.sym          = with_pivoting ? 2 : 1;
      mumps_.comm_fortran = MPI_Comm_c2f(communicator);
      mumps_.job          = -1;
      dmumps_c(&mumps_);
      AssertThrow(mumps_.infog[0] == 0, ExcMessage("MUMPS does not start."));

      const auto icntl = [this](const unsigned int number) -> MUMPS_INT & {
        return mumps_.icntl[number - 1];
      };
      for (unsigned int stream = 1; stream <= 4; ++stream)
        icntl(stream) = 0; // silent
      icntl(6)       = 0;  // no column permutation
      icntl(7)       = 1;  // order given
      icntl(12)      = 1;  // no compression of 2x2 pivots
      icntl(13)      = 1;  // no ScaLAPACK at the root: does not count pivots
      icntl(18)      = 3;  // entries distributed
      icntl(28)      = 1;  // sequential analysis
      mumps_.cntl[0] = with_pivoting ? 0.01 : 0.;
    }


    MumpsFactors::~MumpsFactors()
    {
      int finalized = 0;
      MPI_Finalized(&finalized);
      if (finalized)
        return;
      mumps_.job = -2;
      dmumps_c(&mumps_);
    }


    void
    MumpsFactors::run(const MUMPS_INT job, Entries &entries)
    {
      mumps_.nnz_loc = entries.rows.size();
      mumps_.irn_loc = entries.rows.data();
      mumps_.jcn_loc = entries.columns.data();
      mumps_.a_loc   = entries.values.data();
      mumps_.job     = job;
      dmumps_c(&mumps_);
      mumps_.irn_loc = nullptr;
      mumps_.jcn_loc = nullptr;
      mumps_.a_loc   = nullptr;
    }


    void
    MumpsFactors::check_status() const
    {
      const int error = mumps_.infog[0];
      if (error >= 0)
        return;
      const std::string numbers =
        " (MUMPS: INFOG(1) = " + std::to_string(error) +
        ", INFOG(2) = " + std::to_string(mumps_.infog[1]) + ").";
      if (error == -7 || error == -8 || error == -9 || error == -13 ||
          error == -19)
        throw_lack_of_memory(mumps_.n, numbers);
      AssertThrow(false, ExcMessage("The direct solver failed" + numbers));
    }


    void
    MumpsFactors::analyse(const Matrix           &matrix,
                          const NonzeroEntries   &pattern,
                          const std::vector<int> &place)
    {
      AssertThrow(matrix.m() < std::numeric_limits<MUMPS_INT>::max(),
                  ExcMessage("Too many unknowns for the direct solver."));
      counts_ =
        Utilities::MPI::all_gather(communicator_, int(matrix.local_size()));
      offsets_.assign(1, 0);
      for (const int count : counts_)
        offsets_.push_back(offsets_.back() + count);

      places_ = place;
      for (MUMPS_INT &p : places_)
        ++p;
      mumps_.n       = matrix.m();
      mumps_.perm_in = places_.data();
      Entries entries(matrix, pattern, false);
      run(1, entries);
      check_status();
    }


    bool
    MumpsFactors::factorize(const Matrix &matrix, const NonzeroEntries &pattern)
    {
      Entries    entries(matrix, pattern, true);
      MUMPS_INT &percent_more = mumps_.icntl[13];
      percent_more            = 20;
      for (unsigned int trial = 0; trial < 4; ++trial)
        {
          run(2, entries);
          const int error = mumps_.infog[0];
          // The workspace foreseen by the analysis was too small.
          if (error != -8 && error != -9 && error != -14 && error != -15 &&
              error != -17 && error != -20)
            break;
          percent_more *= 4;
        }
      if (mumps_.infog[0] == -10)
        return false;
      check_status();
      return true;
    }


    void
    MumpsFactors::substitute(Vector &x, const Vector &b)
    {
      const unsigned int rank = Utilities::MPI::this_mpi_process(communicator_);
      std::vector<double> all(rank == 0 ? mumps_.n : 0);

      int ierr = MPI_Gatherv(b.begin(),
                             counts_[rank],
                             MPI_DOUBLE,
                             all.data(),
                             counts_.data(),
                             offsets_.data(),
                             MPI_DOUBLE,
                             0,
                             communicator_);
      AssertThrowMPI(ierr);
      mumps_.rhs  = all.data();
      mumps_.nrhs = 1;
      mumps_.lrhs = mumps_.n;
      mumps_.job  = 3;
      dmumps_c(&mumps_);
      mumps_.rhs = nullptr;
      check_status();
      ierr = MPI_Scatterv(all.data(),
                          counts_.data(),
                          offsets_.data(),
                          MPI_DOUBLE,
                          x.begin(),
                          counts_[rank],
                          MPI_DOUBLE,
                          0,
                          communicator_);
      AssertThrowMPI(ierr);
    }
  } // namespace


  void
  SymmetricFactors::throw_lack_of_memory(const std::size_t  n,
                                         const std::string &reason)
  {
    throw ExcMessage(
      "The direct solver has too little memory for " + std::to_string(n) +
      " unknowns: use a coarser mesh or a lower degree" + reason);
  }


  std::unique_ptr<SymmetricFactors>
  make_mumps_factors(const MPI_Comm communicator, const bool with_pivoting)
  {
    return std::make_unique<MumpsFactors>(communicator, with_pivoting);
  }
} // namespace Nacre
