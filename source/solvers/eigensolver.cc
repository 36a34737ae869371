// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/solvers/eigensolver.h>

#include <deal.II/base/exceptions.h>

#include <AnasaziBasicEigenproblem.hpp>
#include <AnasaziBlockKrylovSchurSolMgr.hpp>
#include <AnasaziEpetraAdapter.hpp>
#include <Epetra_MultiVector.h>
#include <Epetra_Operator.h>

#include <algorithm>
#include <numeric>

namespace Nacre
{
  namespace
  {
    using TrilinosVector = TrilinosWrappers::MPI::Vector;
    using EigenMap =
      std::function<void(TrilinosVector &, const TrilinosVector &)>;
    using EigenBlock = Epetra_MultiVector;
    using Problem =
      Anasazi::BasicEigenproblem<double, EigenBlock, Epetra_Operator>;
    using Solver =
      Anasazi::BlockKrylovSchurSolMgr<double, EigenBlock, Epetra_Operator>;

    /** A linear map as Anasazi wants it. */
    class MapOperator : public Epetra_Operator
    {
    public:
      MapOperator(const EigenMap       &apply,
                  const Epetra_Map     &map,
                  const TrilinosVector &pattern)
        : apply_(apply)
        , map_(map)
        , x_(pattern)
        , y_(pattern)
      {}

      int
      Apply(const EigenBlock &x, EigenBlock &y) const override
      {
        for (int k = 0; k < x.NumVectors(); ++k)
          {
            std::copy_n(x[k], x.MyLength(), x_.trilinos_vector()[0]);
            apply_(y_, x_);
            std::copy_n(y_.trilinos_vector()[0], y.MyLength(), y[k]);
            ++n_applications_;
          }
        return 0;
      }

      unsigned int
      n_applications() const
      {
        return n_applications_;
      }

      int
      SetUseTranspose(bool) override
      {
        return -1;
      }

      int
      ApplyInverse(const EigenBlock &, EigenBlock &) const override
      {
        return -1;
      }

      double
      NormInf() const override
      {
        return 0.;
      }

      const char *
      Label() const override
      {
        return "Nacre's map";
      }

      bool
      UseTranspose() const override
      {
        return false;
      }

      bool
      HasNormInf() const override
      {
        return false;
      }

      const Epetra_Comm &
      Comm() const override
      {
        return map_.Comm();
      }

      const Epetra_Map &
      OperatorDomainMap() const override
      {
        return map_;
      }

      const Epetra_Map &
      OperatorRangeMap() const override
      {
        return map_;
      }

    private:
      const EigenMap        &apply_;
      const Epetra_Map       map_;
      mutable TrilinosVector x_, y_;
      mutable unsigned int   n_applications_ = 0;
    };

    Teuchos::RCP<EigenBlock>
    make_block(const std::vector<TrilinosVector> &vectors,
               const Epetra_Map                  &map)
    {
      auto block = Teuchos::rcp(new EigenBlock(map, vectors.size()));
      for (unsigned int k = 0; k < vectors.size(); ++k)
        std::copy_n(vectors[k].trilinos_vector()[0],
                    block->MyLength(),
                    (*block)[k]);
      return block;
    }

    /** A basis of some times as many vectors as are wanted. */
    Teuchos::ParameterList
    make_parameters(const EigenSearch &search,
                    const int          block_size,
                    const int          n_available)
    {
      // Memory is cheap beside the substitutions that restarts cost.
      const int n_kept   = (search.n_wanted + block_size - 1) / block_size;
      const int n_blocks = n_kept + std::max(n_kept, 80 / block_size);
      Teuchos::ParameterList parameters;
      parameters.set("Which", search.end == SpectrumEnd::largest ? "LR" : "SR");
      parameters.set("Block Size", block_size);
      parameters.set("Num Blocks",
                     std::min(n_blocks, n_available / block_size));
      parameters.set("Step Size", std::max(1, 8 / block_size));
      parameters.set("Maximum Restarts", 60);
      parameters.set("Convergence Tolerance", search.tolerance);
      parameters.set("Verbosity", int(Anasazi::Errors));
      return parameters;
    }
  } // namespace

  Eigenpairs
  find_eigenpairs(const EigenMap                       &apply,
                  const TrilinosWrappers::SparseMatrix &inner_product,
                  const std::vector<TrilinosVector>    &start,
                  const std::vector<TrilinosVector>    &known,
                  const EigenSearch                    &search)
  {
    Assert(!start.empty(), ExcMessage("A block has one vector at least."));
    const Epetra_Map &map = inner_product.trilinos_matrix().RowMap();
    const auto op = Teuchos::rcp(new MapOperator(apply, map, start.front()));
    const Teuchos::RCP<const Epetra_Operator> B =
      Teuchos::rcp(&inner_product.trilinos_matrix(), false);

    std::vector<TrilinosVector> first(start);
    for (unsigned int k = 0; k < start.size(); ++k)
      apply(first[k], start[k]);
    const auto problem = Teuchos::rcp(new Problem());
    problem->setOperator(op);
    problem->setM(B);
    problem->setInitVec(make_block(first, map));
    if (!known.empty())
      problem->setAuxVecs(make_block(known, map));
    problem->setHermitian(true);
    problem->setNEV(search.n_wanted);
    AssertThrow(problem->setProblem(),
                ExcMessage("Anasazi refuses the eigenproblem."));

    auto   parameters = make_parameters(search,
                                      start.size(),
                                      start.front().size() - known.size());
    Solver solver(problem, parameters);
    solver.solve();
    const auto               &solution = problem->getSolution();
    std::vector<unsigned int> order(solution.numVecs);
    std::iota(order.begin(), order.end(), 0u);
    const double sign = (search.end == SpectrumEnd::largest ? -1. : 1.);
    std::stable_sort(order.begin(),
                     order.end(),
                     [&](const unsigned int i, const unsigned int j) {
                       return sign * solution.Evals[i].realpart <
                              sign * solution.Evals[j].realpart;
                     });
    Eigenpairs pairs;
    for (const unsigned int i : order)
      {
        pairs.values.push_back(solution.Evals[i].realpart);
        pairs.vectors.emplace_back(start.front());
        std::copy_n((*solution.Evecs)[i],
                    solution.Evecs->MyLength(),
                    pairs.vectors.back().trilinos_vector()[0]);
      }
    pairs.n_applications = op->n_applications() + start.size();
    return pairs;
  }
} // namespace Nacre
