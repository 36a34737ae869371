// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_multigrid_level_transfer_h
#define nacre_multigrid_level_transfer_h

#include <nacre/base/types.h>
#include <nacre/multigrid/coarse_parts.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <utility>
#include <vector>

namespace dealii
{
  template <typename number>
  class AffineConstraints;
  namespace TrilinosWrappers
  {
    namespace MPI
    {
      class Vector;
    }
  } // namespace TrilinosWrappers
} // namespace dealii

namespace Nacre
{
  class Discretization;

  /**
   * Transfer between two meshes. Each active cell of the fine mesh is an active
   * cell of the coarse one or the child of one.
   *
   * The prolongation P takes unconstrained coarse dofs to unconstrained fine
   * ones: it evaluates the functions of a coarse cell, or of the part of it
   * that holds a fine part, at the nodes of the fine one; on the same mesh, at
   * those of a space of higher degree. Constrained coarse dofs (hanging nodes,
   * supports, nodes of small parts) are expressed by unconstrained ones. The
   * restriction is its transpose. The meshes may be distributed differently.
   */
  class LevelTransfer
  {
  public:
    using Vector = LinearAlgebra::distributed::Vector<double>;

    /** Collective. The arguments must stay alive. */
    LevelTransfer(const Discretization            &fine,
                  const AffineConstraints<double> &fine_constraints,
                  const Discretization            &coarse,
                  const AffineConstraints<double> &coarse_constraints);

    /** fine += P coarse, own entries of both. Collective. */
    void
    prolongate_and_add(Vector &fine, const Vector &coarse) const;

    /** coarse = P^T fine, own entries of both. Collective. */
    void
    restrict_to(Vector &coarse, const Vector &fine) const;

    /**
     * The interpolation of the ghosted displacement @p fine at the coarse
     * nodes, ghosted. Collective.
     */
    TrilinosWrappers::MPI::Vector
    interpolate(const TrilinosWrappers::MPI::Vector &fine) const;

  private:
    /** A value of the fine displacement at a coarse node. */
    struct NodeValue
    {
      types::global_dof_index dof;
      double                  value;
      /** Of the values of a dof that of the largest weight counts. */
      double weight;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &dof &value &weight;
      }
    };

    /** What this rank's parts know of @p fine at the coarse nodes. */
    std::vector<NodeValue>
    values_at_coarse_nodes(const TrilinosWrappers::MPI::Vector &fine) const;

    /** A fine dof as a combination of coarse ones. */
    using Row = std::vector<std::pair<types::global_dof_index, double>>;

    /** Those of P for this rank's fine dofs. Collective. */
    std::vector<Row>
    rows(const AffineConstraints<double> &fine_constraints,
         const AffineConstraints<double> &coarse_constraints) const;

    void
    store(const std::vector<Row> &rows);

    const Discretization &fine_;
    const Discretization &coarse_;

    std::vector<ChildMap> maps_;
    /** In the order of the fine mesh's owned_parts(). */
    std::vector<CoarsePart> coarse_parts_;

    /** @name P in compressed rows, columns are local indices of coarse_vector_
     */
    //@{
    std::vector<std::size_t>  row_start_;
    std::vector<unsigned int> columns_;
    std::vector<double>       weights_;
    //@}
    mutable Vector coarse_vector_;
  };
} // namespace Nacre

#endif
