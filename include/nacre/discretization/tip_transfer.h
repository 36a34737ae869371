// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_tip_transfer_h
#define nacre_discretization_tip_transfer_h

#include <nacre/discretization/discretization.h>

#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <vector>

namespace Nacre
{
  /** Vectors at the nodes of a part. */
  using NodalVectors = std::vector<Tensor<1, spacedim>>;

  /** sum_b N_b u_b at @p unit in the reference cell. */
  Tensor<1, spacedim>
  value_at(const FiniteElement<dim, spacedim> &fe,
           const NodalVectors                 &u,
           const Point<dim>                   &unit);

  /**
   * The part of PartTransfer that branch functions of tips have in fields. A
   * tip that stays where it is has the same functions F_k on both meshes, but
   * for the length that scales them, and keeps its coefficients c_k. A node at
   * X_a, at xi in the part before, takes the value there of all the field,
   * (C.4''') of doc/cutting.md,
   *
   *   u_a = sum_b N_b(xi) u_b
   *         + chi(xi) sum_k c_k (F_k(X_a) - sum_b N_b(xi) F_k(X_b)),
   *
   * by which on a plate the new field is the old one where both chi are 1.
   * Where chi has fallen, the two are as far apart as the F_k and their
   * interpolants. Functions of a tip that moves on are left out.
   */
  class TipTransfer
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;

    /** What the functions of one tip are on a part of before. */
    struct Share
    {
      /** The tip's number before. */
      unsigned int tip;
      /** The sheet, as TipFunctions takes it. */
      int                    side;
      PartEnrichment::Cutoff cutoff;
      /** sum_k c_k F_k(X_b) (length), by field. */
      std::vector<NodalVectors> at_nodes;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &tip &side &cutoff &at_nodes;
      }
    };

    /** @param fields with ghosts */
    TipTransfer(const Discretization              &discretization,
                const std::vector<const Vector *> &fields);

    /** Those of @p part, which this rank owns or has as a ghost. */
    std::vector<Share>
    shares(const CellPart &part) const;

    /** One field's functions on the mesh of now. */
    class Field
    {
    public:
      /**
       * What the functions add to the polynomials at the node @p a of @p part.
       * @param unit the node in the reference cell of before
       */
      Tensor<1, spacedim>
      value_at_node(const std::vector<Share> &shares,
                    const unsigned int        a,
                    const CellPart           &part,
                    const Point<dim>         &unit) const;

      /** Set the coefficients that this rank owns. */
      void
      set_coefficients(Vector &field) const;

    private:
      Field(const Discretization &discretization, const unsigned int k)
        : discretization_(discretization)
        , k_(k)
      {}

      /** A tip; without functions, if it has moved on. */
      struct Tip
      {
        CutTrace::Tip                       place;
        std::shared_ptr<const TipFunctions> functions;
        std::vector<double>                 coefficients;
        types::global_dof_index             first_dof = 0;
      };

      const Discretization &discretization_;
      const unsigned int    k_;
      std::vector<Tip>      tips_; // by their numbers before

      friend class TipTransfer;
    };

    /** The field @p k on the mesh of @p discretization. */
    Field
    on(const Discretization &discretization, const unsigned int k) const;

  private:
    /** Known to all ranks. */
    struct Tip
    {
      CutTrace::Tip                       place;
      std::shared_ptr<const TipFunctions> functions;
      /** c_k by field. */
      std::vector<std::vector<double>> coefficients;
    };

    std::vector<Tip> tips_;
  };
} // namespace Nacre

#endif
