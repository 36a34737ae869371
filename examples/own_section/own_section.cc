// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Shells with a section of one's own: an orthotropic one, as of a ply of
// fibres. Nacre's library does the rest: nothing of it is changed.

#include <nacre/base/expression.h>
#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/parameter_input.h>
#include <nacre/mechanics/section_parameters.h>
#include <nacre/simulation/convergence_study.h>

#include <deal.II/base/mpi.h>

#include <iostream>
#include <memory>
#include <optional>
#include <string>

namespace OwnSection
{
  using namespace Nacre;

  /**
   * Orthotropic linear elastic section of the thickness h. Along the fibres
   * (direction 1: the material direction, projected onto the surface) and
   * across them (2) the stress is Q times the strain, in Voigt order
   *   Q11 = E1/(1 - nu12 nu21), Q22 = E2/(1 - nu12 nu21),
   *   Q12 = nu12 Q22, Q33 = G12, nu21 = nu12 E2/E1;
   * H_n = h Q, H_m = h^3/12 Q.
   */
  class OrthotropicSection : public LinearSectionLaw
  {
  public:
    struct Values
    {
      double       E_1 = 1., E_2 = 1., nu_12 = 0.3, G_12 = 0.4;
      double       thickness = 0.1;
      Tensor<1, 3> direction = Tensor<1, 3>({1., 0., 0.});
    };

    explicit OrthotropicSection(const Values &values)
      : values_(values)
    {
      AssertThrow(values_.thickness > 0.,
                  ExcMessage(
                    "Section/Thickness: " + std::to_string(values_.thickness) +
                    "; it must be positive."));
      AssertThrow(values_.E_1 > 0. && values_.E_2 > 0. && values_.G_12 > 0. &&
                    values_.nu_12 * values_.nu_12 * values_.E_2 < values_.E_1,
                  ExcMessage("Section: the moduli must be positive, and the "
                             "square of Poisson's ratio smaller than the ratio "
                             "of Young's moduli along and across."));
    }

    double
    thickness(const SectionPoint &) const override
    {
      return values_.thickness;
    }

    double
    density(const SectionPoint &) const override
    {
      return 0.;
    }

    SectionStiffness
    stiffness(const SurfaceFrame<> &frame, const SectionPoint &) const override
    {
      const double        h = values_.thickness;
      const VoigtMatrix<> T = strain_transformation(frame);
      const VoigtMatrix<> H = transpose(T) * material_stiffness() * T;
      return {h * H, h * h * h / 12. * H};
    }

  private:
    VoigtMatrix<>
    material_stiffness() const
    {
      const double factor =
        1. / (1. - values_.nu_12 * values_.nu_12 * values_.E_2 / values_.E_1);
      VoigtMatrix<> Q;
      Q[0][0] = factor * values_.E_1;
      Q[1][1] = factor * values_.E_2;
      Q[0][1] = Q[1][0] = values_.nu_12 * Q[1][1];
      Q[2][2]           = values_.G_12;
      return Q;
    }

    /**
     * From covariant strains (e11, e22, 2 e12) to those along and across the
     * fibres: e_d = d^a e_ab d^b with the contravariant components
     * d^a = d . a^a of a direction d.
     */
    VoigtMatrix<>
    strain_transformation(const SurfaceFrame<> &frame) const
    {
      const Tensor<1, 3> tangent =
        values_.direction - (values_.direction * frame.t0) * frame.t0;
      AssertThrow(tangent.norm() > 1e-8 * values_.direction.norm(),
                  ExcMessage("Section/Material direction: it is normal to the "
                             "surface somewhere, and must not be."));
      const Tensor<1, 3> along  = tangent / tangent.norm();
      const Tensor<1, 3> across = cross_product_3d(frame.t0, along);
      const double       c_1    = along * frame.a_con[0];
      const double       c_2    = along * frame.a_con[1];
      const double       s_1    = across * frame.a_con[0];
      const double       s_2    = across * frame.a_con[1];
      return VoigtMatrix<>(
        {{c_1 * c_1, c_2 * c_2, c_1 * c_2},
         {s_1 * s_1, s_2 * s_2, s_1 * s_2},
         {2. * c_1 * s_1, 2. * c_2 * s_2, c_1 * s_2 + c_2 * s_1}});
    }

    const Values values_;
  };

  /** The section Section of a parameter file. */
  class OrthotropicSectionParameters : public SectionParameters
  {
  public:
    OrthotropicSectionParameters()
      : SectionParameters("/Section")
    {
      add_parameter("Young's modulus along",
                    values_.E_1,
                    "Young's modulus along the fibres. Units: force/length^2.");
      add_parameter(
        "Young's modulus across",
        values_.E_2,
        "Young's modulus across the fibres. Units: force/length^2.");
      add_parameter("Poisson's ratio",
                    values_.nu_12,
                    "Contraction across the fibres by stress along them. "
                    "Units: none.");
      add_parameter("Shear modulus",
                    values_.G_12,
                    "Shear modulus of the surface. Units: force/length^2.");
      add_parameter("Thickness",
                    values_.thickness,
                    "Thickness h. Units: length.");
      add_parameter("Material direction",
                    direction_,
                    "Three components; the fibres follow its projection onto "
                    "the surface. Units: none.");
    }

    // For the expressions of the parameter file.
    Constants
    named_constants(const Constants & /*constants*/,
                    const std::optional<double> &thickness) const override
    {
      return {{"E1", values_.E_1},
              {"E2", values_.E_2},
              {"nu12", values_.nu_12},
              {"G12", values_.G_12},
              {"h", thickness.value_or(values_.thickness)}};
    }

    // The same in all regions of a mesh.
    std::shared_ptr<const SectionLaw>
    make(const Constants             &constants,
         const std::optional<double> &thickness,
         const MeshRegions & /*regions*/) const override
    {
      OrthotropicSection::Values values = values_;
      values.thickness                  = thickness.value_or(values_.thickness);
      values.direction =
        evaluate_point(direction_, "Section/Material direction", constants);
      return std::make_shared<OrthotropicSection>(values);
    }

  private:
    OrthotropicSection::Values values_;
    std::string                direction_ = "1, 0, 0";
  };

  int
  run(const int argc, char **argv)
  {
    if (argc < 2)
      {
        std::cerr << "Usage: own_section FILE.prm "
                     "[\"Section/Parameter=value\"]...\n";
        return 2;
      }
    ConvergenceStudy study(MPI_COMM_WORLD,
                           std::make_unique<OrthotropicSectionParameters>());
    read_parameters(argv[1], {argv + 2, argv + argc});
    study.prepare(argv[1]);
    Log log(MPI_COMM_WORLD);
    study.run(log);
    return 0;
  }
} // namespace OwnSection


int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return Nacre::run_guarded(MPI_COMM_WORLD,
                            [&]() { return OwnSection::run(argc, argv); });
}
