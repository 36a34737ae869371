// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/tip_transfer.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    /** What a tip's functions are on a part; null: they aren't there. */
    const PartEnrichment::Share *
    share_of(const CellPart &part, const CutTrace::Tip &tip)
    {
      if (part.enrichment() == nullptr)
        return nullptr;
      const auto &shares = part.enrichment()->shares;
      const auto  found =
        std::find_if(shares.begin(), shares.end(), [&](const auto &share) {
          return share.cut == tip.cut && share.at_end == tip.at_end;
        });
      return found == shares.end() ? nullptr : &*found;
    }

    /** Whether they are one but for what 'Cuts/Snap' moves them by. */
    bool
    is_same(const CutTrace::Tip &a, const CutTrace::Tip &b, const double length)
    {
      return a.cut == b.cut && a.at_end == b.at_end &&
             a.position.distance(b.position) < 0.05 * length;
    }
  } // namespace

  Tensor<1, spacedim>
  value_at(const FiniteElement<dim, spacedim> &fe,
           const NodalVectors                 &u,
           const Point<dim>                   &unit)
  {
    Tensor<1, spacedim> value;
    for (unsigned int b = 0; b < u.size(); ++b)
      value += fe.shape_value(b, unit) * u[b];
    return value;
  }

  TipTransfer::TipTransfer(const Discretization              &discretization,
                           const std::vector<const Vector *> &fields)
  {
    const TipPatches *const patches = discretization.tip_patches();
    if (patches == nullptr)
      return;
    for (unsigned int t = 0; t < discretization.tips().size(); ++t)
      {
        tips_.push_back({discretization.tips()[t], patches->functions(t), {}});
        for (const Vector *const field : fields)
          {
            tips_.back().coefficients.emplace_back();
            for (unsigned int i = 0; i < tips_.back().functions->size(); ++i)
              tips_.back().coefficients.back().push_back(
                (*field)(patches->first_dof(t) + i));
          }
      }
  }

  std::vector<TipTransfer::Share>
  TipTransfer::shares(const CellPart &part) const
  {
    std::vector<Share> result;
    for (unsigned int t = 0; t < tips_.size(); ++t)
      if (const auto *const share = share_of(part, tips_[t].place))
        {
          result.push_back({t, share->side, share->cutoff, {}});
          for (const auto &coefficients : tips_[t].coefficients)
            {
              NodalVectors u;
              for (const auto &values : share->at_nodes)
                u.push_back(share->functions->sum(values, coefficients));
              result.back().at_nodes.push_back(u);
            }
        }
    return result;
  }

  TipTransfer::Field
  TipTransfer::on(const Discretization &discretization,
                  const unsigned int    k) const
  {
    Field                   field(discretization, k);
    const TipPatches *const patches = discretization.tip_patches();
    const auto             &places  = discretization.tips();
    for (const Tip &tip : tips_)
      {
        field.tips_.push_back({tip.place, nullptr, {}, 0});
        auto &now = field.tips_.back();
        for (unsigned int t = 0; t < places.size() && patches != nullptr; ++t)
          if (is_same(places[t], tip.place, tip.functions->length()))
            {
              now.functions = patches->functions(t);
              now.coefficients =
                tip.functions->coefficients_of(*now.functions,
                                               tip.coefficients[k]);
              now.first_dof = patches->first_dof(t);
            }
      }
    return field;
  }

  Tensor<1, spacedim>
  TipTransfer::Field::value_at_node(const std::vector<Share> &shares,
                                    const unsigned int        a,
                                    const CellPart           &part,
                                    const Point<dim>         &unit) const
  {
    Tensor<1, spacedim> value;
    for (const Share &share : shares)
      {
        const Tip &tip = tips_[share.tip];
        if (tip.functions == nullptr)
          continue;
        // The sheet of a node is that of now, where it has one.
        const auto *const now = share_of(part, tip.place);
        const auto        X   = discretization_.node_positions(part)[a];
        const auto F = now == nullptr ? tip.functions->values(X, share.side) :
                                        now->at_nodes[a];
        value +=
          PartEnrichment::chi(share.cutoff, unit) *
          (tip.functions->sum(F, tip.coefficients) -
           value_at(discretization_.scalar_fe(), share.at_nodes[k_], unit));
      }
    return value;
  }

  void
  TipTransfer::Field::set_coefficients(Vector &field) const
  {
    const auto &owned = discretization_.locally_owned_dofs();
    for (const Tip &tip : tips_)
      for (unsigned int i = 0; i < tip.coefficients.size(); ++i)
        if (owned.is_element(tip.first_dof + i))
          field(tip.first_dof + i) = tip.coefficients[i];
  }
} // namespace Nacre
