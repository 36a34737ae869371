// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_multigrid_level_transfer_h
#define nacre_multigrid_level_transfer_h

#include <nacre/base/types.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <memory>
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
   * ones: it is the embedding of the space of a coarse cell into that of its
   * children, or, on the same mesh, into a space of higher degree, with the
   * constrained coarse dofs (hanging nodes, supports)
   * expressed by unconstrained ones. The restriction is its transpose. The
   * meshes may be distributed differently.
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
    /** Where the space of a fine cell comes from. */
    struct CoarseCell
    {
      /** Number of the fine cell among the children; none if it's the same. */
      unsigned int                         child;
      std::vector<types::global_dof_index> dofs;
    };

    /** Cells of the mesh of @p coarse by this rank's fine cells. */
    void
    find_coarse_cells();

    void
    build(const AffineConstraints<double> &fine_constraints,
          const AffineConstraints<double> &coarse_constraints);

    const Discretization &fine_;
    const Discretization &coarse_;

    /** By the order of this rank's active cells. */
    std::vector<CoarseCell> coarse_cells_;

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
