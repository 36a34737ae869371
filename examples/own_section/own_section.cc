// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Shells with a section of one's own: an orthotropic one, as of a ply of
// fibres. Nacre's library does the rest: nothing of it is changed.

#include <nacre/base/expression.h>
#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/parameter_input.h>
#include <nacre/mechanics/section_law.h>
#include <nacre/simulation/convergence_study.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>

#include <iostream>
#include <memory>

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
  class OrthotropicSection
    : public LinearSectionLaw
    , public ParameterAcceptor
  {
  public:
    OrthotropicSection()
      : ParameterAcceptor("/Section")
    {
      add_parameter("Young's modulus along",
                    E_1_,
                    "Young's modulus along the fibres. Units: force/length^2.");
      add_parameter(
        "Young's modulus across",
        E_2_,
        "Young's modulus across the fibres. Units: force/length^2.");
      add_parameter("Poisson's ratio",
                    nu_12_,
                    "Contraction across the fibres by stress along them. "
                    "Units: none.");
      add_parameter("Shear modulus",
                    G_12_,
                    "Shear modulus of the surface. Units: force/length^2.");
      add_parameter("Thickness", thickness_, "Thickness h. Units: length.");
      add_parameter("Material direction",
                    direction_text_,
                    "Three components; the fibres follow its projection onto "
                    "the surface. Units: none.");
    }

    void
    prepare(const Constants &constants) override
    {
      direction_ = evaluate_point(direction_text_,
                                  "Section/Material direction",
                                  constants);
      AssertThrow(thickness_ > 0.,
                  ExcMessage(
                    "Section/Thickness: " + std::to_string(thickness_) +
                    "; it must be positive."));
      AssertThrow(E_1_ > 0. && E_2_ > 0. && G_12_ > 0. &&
                    nu_12_ * nu_12_ * E_2_ < E_1_,
                  ExcMessage("Section: the moduli must be positive, and the "
                             "square of Poisson's ratio smaller than the ratio "
                             "of Young's moduli along and across."));
    }

    void
    set_thickness(const double thickness) override
    {
      thickness_ = thickness;
    }

    // For the expressions of the parameter file.
    Constants
    named_constants() const override
    {
      return {{"E1", E_1_},
              {"E2", E_2_},
              {"nu12", nu_12_},
              {"G12", G_12_},
              {"h", thickness_}};
    }

    double
    thickness(const SectionPoint &) const override
    {
      return thickness_;
    }

    double
    density(const SectionPoint &) const override
    {
      return 0.;
    }

    SectionStiffness
    stiffness(const SurfaceFrame<> &frame, const SectionPoint &) const override
    {
      const VoigtMatrix<> T = strain_transformation(frame);
      const VoigtMatrix<> H = transpose(T) * material_stiffness() * T;
      return {thickness_ * H, std::pow(thickness_, 3) / 12. * H};
    }

  private:
    VoigtMatrix<>
    material_stiffness() const
    {
      const double  factor = 1. / (1. - nu_12_ * nu_12_ * E_2_ / E_1_);
      VoigtMatrix<> Q;
      Q[0][0] = factor * E_1_;
      Q[1][1] = factor * E_2_;
      Q[0][1] = Q[1][0] = nu_12_ * Q[1][1];
      Q[2][2]           = G_12_;
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
        direction_ - (direction_ * frame.t0) * frame.t0;
      AssertThrow(tangent.norm() > 1e-8 * direction_.norm(),
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

    double       E_1_            = 1.;
    double       E_2_            = 1.;
    double       nu_12_          = 0.3;
    double       G_12_           = 0.4;
    double       thickness_      = 0.1;
    std::string  direction_text_ = "1, 0, 0";
    Tensor<1, 3> direction_;
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
                           std::make_unique<OrthotropicSection>());
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
