// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_point_results_h
#define nacre_postprocess_point_results_h

#include <nacre/base/selection.h>
#include <nacre/postprocess/strain_values.h>
#include <nacre/postprocess/transverse_shear.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <optional>
#include <vector>

namespace Nacre
{
  /** Where in the thickness a stress is taken. */
  enum class Face
  {
    bottom,
    middle,
    top
  };
  constexpr unsigned int n_faces = 3;

  const Selection<Face> &selection(Face);

  /**
   * What is known of a shell at one point of its undeformed mid-surface.
   * Forces, moments and stresses are tensors of space, tangent to the
   * undeformed surface; for large rotations they are the conjugates of the
   * strains of StrainValues (of the second Piola-Kirchhoff kind): they turn
   * along with the shell, and differ from those per deformed length by the size
   * of the strains.
   *
   * `bottom` and `top` are the faces at -h/2 and h/2 along the normal of
   * ShellModel::result_axes; positive moments stretch the top.
   */
  struct PointResults
  {
    using Vector3     = Tensor<1, spacedim>;
    using Tensor3     = Tensor<2, spacedim>;
    using PlaneTensor = SymmetricTensor<2, dim>;

    /** A principal value, and its direction in space (1). */
    struct Principal
    {
      double  value;
      Vector3 direction;
    };

    /** X0 (length), and the region. */
    Point<spacedim> point;
    /** u (length). */
    Vector3 displacement;
    /** Unit normal of the undeformed surface on the side of the top. */
    Vector3 normal;
    /** The axes 1 and 2 of the tangent plane, 2 = normal x 1. */
    std::array<Vector3, dim> e;
    /**
     * The change of the normal, t - t0; linearised, (17), in linear analyses,
     * turned back by no rotation in others (1).
     */
    Vector3 normal_change;
    /**
     * The rotation vector that turns the undeformed normal into the deformed
     * one by the shortest way (rad); t0 x Delta t (17) in linear analyses. It
     * has no part about the normal itself.
     */
    Vector3 rotation;
    /** N = n^ab a_a (x) a_b (force/length). */
    Tensor3 membrane_forces;
    /** M = m^ab a_a (x) a_b (force). */
    Tensor3 moments;
    /** Of the section law, by Face (force/length^2). */
    std::array<Tensor3, n_faces> stress;
    /** q = Div M of TransverseShear (force/length); 0 if not wanted. */
    Vector3 transverse_shear;
    /** w per undeformed area (force/length). */
    double energy_density = 0.;
    /** SectionLaw::state_results(), by Face. */
    std::array<std::vector<double>, n_faces> state_results;
    /** Of laminates, bottom to top of the stack; heights along the normal. */
    std::vector<LayerState> layers;

    /** e_i . T e_j of a tensor of the tangent plane. */
    PlaneTensor
    in_axes(const Tensor3 &T) const;

    /**
     * Eigenvalues of a tensor of the tangent plane, the larger first, with
     * their directions. Each direction is that of a line: its sign means
     * nothing.
     */
    std::array<Principal, dim>
    principal(const Tensor3 &T) const;

    /** sqrt(s11^2 - s11 s22 + s22^2 + 3 s12^2) of a plane stress. */
    double
    von_mises(const Tensor3 &S) const;

    /** The same at a face. */
    double
    von_mises(const Face face) const
    {
      return von_mises(stress[static_cast<unsigned int>(face)]);
    }
  };

  /** The @p name as files of fields write it, with _ for spaces. */
  std::string
  field_name(std::string name);

  /** PointResults at the same points of one cell after the other. */
  class CellResults
  {
  public:
    /**
     * @param state must live as long
     * @param points in the reference cell
     * @param with_shear whether transverse shear forces are recovered, which
     *        looks at the neighbours of a cell too
     * @param spread see StrainValues
     */
    CellResults(const ShellState      &state,
                const Quadrature<dim> &points,
                const bool             with_shear,
                const bool             spread = false);

    void
    reinit(const CellPart &part);

    unsigned int
    n_points() const
    {
      return strains_.values().n_points();
    }

    Point<spacedim>
    position(const unsigned int q) const
    {
      return strains_.values().point(q);
    }

    /** Throws where ShellModel::result_axes has no direction. */
    PointResults
    at(const unsigned int q) const;

    /**
     * The same, where a homogeneous section has a single layer; of it only the
     * heights are filled in.
     */
    PointResults
    with_layers(const unsigned int q) const;

    /**
     * The stress at @p side h/2 from the middle of the section along the
     * normal of the results, a tensor of space (force/length^2).
     */
    Tensor<2, spacedim>
    stress(const unsigned int q, const double side) const;

    /** SectionLaw::state_results() there. */
    std::vector<double>
    state_results(const unsigned int q, const double side) const;

  private:
    const ShellState               state_;
    StrainValues                   strains_;
    std::optional<TransverseShear> shear_;
  };
} // namespace Nacre

#endif
