// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_multigrid_patch_smoother_h
#define nacre_multigrid_patch_smoother_h

#include <nacre/multigrid/level_matrix.h>
#include <nacre/multigrid/vertex_patches.h>

namespace Nacre
{
  /**
   * Multiplicative Schwarz smoother: exact solutions on overlapping patches
   * P, one after the other,
   *
   *     x_P += A_PP^-1 (b - A x)_P,
   *
   * the inverses in single precision. backward() visits the patches in the
   * reverse order of forward(), so that a V-cycle with forward() before and
   * backward() after the coarse correction is symmetric.
   *
   * On several ranks: a patch is inner if its rows have no column of another
   * rank; inner patches of different ranks don't interact and run at once.
   * The others, along the borders, take turns: ranks have colours such that
   * the border patches of ranks of one colour don't interact. So the smoother
   * is multiplicative on any number of ranks.
   */
  class PatchSmoother
  {
  public:
    using Vector = LevelMatrix::Vector;

    /**
     * Invert the patches' matrices. @p matrix must keep the rows of all dofs
     * of @p patches; both must stay alive. Returns whether all are positive
     * definite. Collective.
     * @param n_steps sweeps of forward() and backward()
     */
    bool
    reinit(const LevelMatrix   &matrix,
           const VertexPatches &patches,
           const unsigned int   n_steps);

    /**
     * Sweep from the first patch to the last. The ghosts of @p x and @p b must
     * be up to date; those of x are so afterwards. Collective.
     */
    void
    forward(Vector &x, const Vector &b) const;

    /** Sweep from the last patch to the first, as forward(). */
    void
    backward(Vector &x, const Vector &b) const;

  private:
    /** A patch's place in local_dofs_ and inverses_. */
    struct Patch
    {
      std::size_t  first_dof;
      std::size_t  first_entry;
      unsigned int n;
    };

    /** Append a patch's inverse, from @p first_dof on; false if impossible. */
    bool
    invert(const Patch &patch);

    /** Copy the patch's scaled matrix to dense_. */
    void
    extract(const Patch &patch);

    void
    find_colours();

    void
    relax(const Patch &patch, double *x, const double *b) const;

    /** Let the ranks of a colour sweep their border, and tell the others. */
    void
    sweep_border(const unsigned int colour,
                 const bool         backwards,
                 Vector            &x,
                 const Vector      &b) const;

    void
    sweep(const std::vector<Patch> &patches,
          const bool                backwards,
          Vector                   &x,
          const Vector             &b) const;

    const LevelMatrix *matrix_  = nullptr;
    unsigned int       n_steps_ = 1;
    std::vector<Patch> inner_;
    std::vector<Patch> border_;
    unsigned int       n_colours_ = 0;
    unsigned int       my_colour_ = 0;

    std::vector<unsigned int> local_dofs_;
    /** Of the matrices scaled to a unit diagonal, packed row by row. */
    std::vector<float> inverses_;
    /** 1 / sqrt(A_ii) by local index. */
    std::vector<double> scaling_;

    /** Room for one patch. */
    std::vector<double>       dense_;
    std::vector<unsigned int> columns_;
    /** Place in the row, and in the patch, of a row's entries. */
    std::vector<std::pair<unsigned int, unsigned int>> entries_;
    std::vector<int>                                   position_;
    mutable std::vector<double>                        products_;
    mutable std::vector<float>                         residual_, correction_;
    /** What this rank has added to dofs of other ranks. */
    mutable Vector additions_;
  };
} // namespace Nacre

#endif
