// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_load_terms_h
#define nacre_forms_load_terms_h

#include <nacre/forms/term.h>

namespace Nacre
{
  class Loads;

  /** The virtual work -l(v) of a load, (N.19); the loads must live as long. */
  class LoadTerm : public Term
  {
  public:
    explicit LoadTerm(const Loads &loads)
      : loads_(loads)
    {}

    bool
    is_load() const override
    {
      return true;
    }

  protected:
    const Loads &loads_;
  };

  /** Dead forces per area: force, weight and a pressure that doesn't follow. */
  class SurfaceLoadTerm : public LoadTerm
  {
  public:
    SurfaceLoadTerm(const SectionLaw &section, const Loads &loads);

    void
    add_on_cell(TermCell &cell, LocalTerms &terms) const override;

  private:
    const SectionLaw &section_;
  };

  /**
   * Pressure along the deformed normal on the deformed area: the force per
   * reference area is p phi,1 x phi,2; with its derivative. In a step with
   * energy-momentum forces it is the mean over the straight way of the step:
   * its work is the pressure times the volume that the surface sweeps.
   */
  class FollowingPressureTerm : public LoadTerm
  {
  public:
    using LoadTerm::LoadTerm;

    void
    add_on_cell(TermCell &cell, LocalTerms &terms) const override;
  };

  /** Forces and moments per length of boundary edges and of lips of cuts. */
  class EdgeLoadTerm : public LoadTerm
  {
  public:
    using LoadTerm::LoadTerm;

    bool
    acts_on_boundary(const types::boundary_id                     id,
                     const std::pair<unsigned int, unsigned int> &place,
                     const ShellActions &actions) const override;

    void
    add_on_boundary(const TermEdge &edge, LocalTerms &terms) const override;

    bool
    acts_on_lips() const override;

    void
    add_on_lip(const TermEdge &edge,
               const CutLip   &lip,
               LocalTerms     &terms) const override;
  };

  /** Forces at points. */
  class PointForceTerm : public LoadTerm
  {
  public:
    /**
     * Throws if a point force lies off the mesh or on both lips of a slit;
     * collective.
     */
    PointForceTerm(const Discretization &discretization, const Loads &loads);

    void
    add_point_forces(
      const AffineConstraints<double> &constraints,
      const ShellActions              &actions,
      TrilinosWrappers::MPI::Vector   &right_hand_side) const override;

  private:
    const Discretization     &discretization_;
    std::vector<SurfacePoint> places_;
  };
} // namespace Nacre

#endif
