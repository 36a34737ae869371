// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Rows of doc/initial_strain.md, doc/laminates.md and doc/finite.md that are
// files of prm/ with other data, p = 4, on coarse meshes. References: series,
// Ritz, closed forms.

#include "../study_rows.h"

using namespace Tests;

/** Square plates: deflection over q a^4/D, moment over q a^2 at the centre. */
void
check_foundations()
{
  struct Plate
  {
    std::string edge, K, w, M;
    double      tolerance;
  };
  const std::vector<Plate> plates = {
    {"z = 0", "0", "0.0040623527", "0.0478864", 1e-3},
    {"z = 0", "100", "0.0032137073", "0.0370521", 1e-3},
    {"z = 0", "1e4", "0.0001114769", "-0.0002162", 2e-2},
    {"clamped", "0", "0.0012653191", "0.0229051", 3e-3},
    {"clamped", "100", "0.0011704553", "0.0209552", 3e-3},
    {"clamped", "1e4", "0.0001142536", "0.0005032", 4e-2}};
  for (const auto &[edge, K, w, M, tolerance] : plates)
    check_quantities(
      "plate, " + edge + ", K = " + K,
      "benchmarks/foundation_plate",
      tolerance,
      "w = displacement z at (0, 0, 0) -> " + w +
        "*q*a^4/D; M = moment 11 at (0, 0, 0) -> " + M + "*q*a^2",
      {"Constants=a = 1, q = 1e-6, K = " + K + ", D = 0.01^3/12/(1 - 0.3^2)",
       "Boundary conditions/Edges=left, bottom: symmetry; right, top: " +
         edge});

  // Kelvin functions, over w(0) of an infinite plate
  check_quantities("disk of 10 l",
                   "benchmarks/foundation_disk",
                   5e-3,
                   "a = displacement z at (1, 0, 0) -> 0.63024675*w0; "
                   "b = displacement z at (2, 0, 0) -> 0.25770377*w0; "
                   "c = displacement z at (0, 0, 0) -> 1.000004141*w0; "
                   "r = displacement z at (10, 0, 0) -> 0.00114106*w0",
                   {"Mid-surface/disk/Radius=10", "Study/Refinements=1"});
  check_quantities("long strip under a line load",
                   "benchmarks/foundation_strip",
                   3e-3,
                   "w = displacement z at (0, 0.25, 0) -> -P/(2*k); "
                   "M = moment 11 at (0, 0.25, 0) -> -P/4",
                   {"Foundation/Tension free=no",
                    "Analysis/Type=linear",
                    "Mid-surface/plate/Size=14, 0.5",
                    "Mid-surface/Subdivisions=30, 1"});
}

/** Heated plates and cylinders, plates with an initial curvature. */
void
check_initial_strains()
{
  const std::string file     = "benchmarks/thermal_buckling";
  const Settings    coarse   = {"Mid-surface/Subdivisions=4, 4"};
  const auto        critical = [](const std::string &value) {
    return "k = load factor 1 -> " + value;
  };
  const Settings fixed = {
    "Boundary conditions/Edges=left, right, bottom, top: fixed"};
  check_quantities("heated plate, clamped",
                   file,
                   1e-3,
                   critical("3.3554289"),
                   coarse);
  check_quantities("heated plate, SS",
                   file,
                   1e-3,
                   critical("1.26533390"),
                   coarse + fixed);
  for (const bool clamped : {true, false})
    check_quantities(std::string("heated disk, ") +
                       (clamped ? "clamped" : "SS"),
                     file,
                     1e-3,
                     critical(clamped ? "0.94115196" : "0.26908892"),
                     {"Mid-surface/Surface=disk",
                      "Mid-surface/disk/Radius=a",
                      "Mid-surface/Subdivisions=2",
                      std::string("Boundary conditions/Edges=rim: ") +
                        (clamped ? "clamped" : "fixed")});

  const Settings    curved = {"Analysis/Type=linear",
                              "Section/Initial strain/Temperature=0",
                              "Section/Initial strain/Curvature=1e-3, 1e-3, 0"};
  const std::string M      = "M = moment 11 at (a/2, a/2, 0) -> ";
  check_quantities("plate with a curvature, SS",
                   file,
                   3e-3,
                   "w = displacement z at (a/2, a/2, 0) -> "
                   "0.0736713533*(1 + nu)*1e-3*a^2; " +
                     M + "-E*h^3*1e-3/24",
                   coarse + fixed + curved);
  check_quantities("plate with a curvature, clamped",
                   file,
                   1e-6,
                   M + "-E*h^3/12/(1 - nu)*1e-3",
                   coarse + curved);

  const auto bimetal = [](const std::string &E1, const std::string &stack) {
    return Settings{"Section/Laminate/Stack=[" + stack + "]",
                    "Section/Laminate/Materials=steel: E1 = " + E1 +
                      ", E2 = " + E1 + ", nu12 = 0.3, G12 = " + E1 +
                      "/2.6; brass: E1 = 1, E2 = 1, nu12 = 0.3, G12 = 1/2.6, "
                      "alpha1 = 2e-5, alpha2 = 2e-5"};
  };
  const auto bent = [](const std::string &kappa, const std::string &e) {
    return "w = displacement z at (a, a, 0) -> -" + kappa +
           "*a^2; u = displacement x at (a, a, 0) -> " + e + "*a";
  };
  check_quantities("one metal, a half is heated",
                   "benchmarks/thermal_bimetal",
                   1e-5,
                   bent("0.15", "5e-4"),
                   bimetal("1", "0_steel/0_brass"));
  check_quantities("bimetal, E1/E2 = 3, h1/h2 = 1/3",
                   "benchmarks/thermal_bimetal",
                   1e-5,
                   bent("0.141176471", "6.76471e-4"),
                   bimetal("3", "0_steel/0_3brass"));
  check_quantities("heated cylinder, ends turn",
                   "benchmarks/thermal_cylinder",
                   1e-5,
                   "w = displacement y at (L/2, R, 0) -> 9.999858e-4; "
                   "u = displacement x at (L, R, 0) -> 2.023376e-3",
                   {"Boundary conditions/Edges=u=0: x = 0, normal = 0; "
                    "u=1: normal = 0; v=0, v=1: symmetry"});
}

/** Plates: 100 w E2 h^3/(q a^4), moments over q a^2, stresses s h^2/(q a^2). */
void
check_laminates()
{
  const auto deflection = [](const std::string &value) {
    return "w = displacement z at (0.5, 0.5, 0) -> " + value + "*q/(100*h^3)";
  };
  const auto moments = [](const std::string &M_x, const std::string &M_y) {
    return "; x = moment 11 along x at (0.5, 0.5, 0) -> " + M_x +
           "*q; y = moment 22 along x at (0.5, 0.5, 0) -> " + M_y + "*q";
  };
  const auto stresses =
    [](const std::string &ply, const std::string &s_1, const std::string &s_2) {
      const std::string name = ply.substr(0, 1) + ply.substr(2, 1),
                        at   = " of " + ply + " at (0.5, 0.5, 0) -> ";
      return "; a" + name + " = ply stress 1" + at + s_1 + "*q/h^2; b" + name +
             " = ply stress 2" + at + s_2 + "*q/h^2";
    };
  const auto stack = [](const std::string &plies) {
    return Settings{"Section/Laminate/Stack=[" + plies + "]"};
  };
  const Settings uniform    = {"Loads/Force per area=0, 0, q"},
                 finer      = {"Mid-surface/Subdivisions=6, 6"};
  const std::string SS_1    = "laminates/plate_cross_ply",
                    SS_2    = "laminates/plate_angle_ply",
                    clamped = "laminates/laminate_clamped";
  check_quantities("[0/90] SS-1, uniform",
                   SS_1,
                   6e-3,
                   deflection("1.69546617") + moments("0.0630087", "0.0630087"),
                   stack("0/90") + uniform);
  check_quantities("[0/90/90/0] SS-1, sine",
                   SS_1,
                   2e-3,
                   deflection("0.43124691") +
                     stresses("1 bottom", "-0.53869659", "-0.02666815") +
                     stresses("1 top", "-0.26934829", "-0.01333407") +
                     stresses("2 bottom", "-0.26934829", "-0.01333407") +
                     stresses("4 top", "0.53869659", "0.02666815"),
                   stack("0/90/90/0") + finer);
  check_quantities("[0/90/90/0] SS-1, uniform",
                   SS_1,
                   5e-3,
                   deflection("0.67966564") +
                     moments("0.1209417", "0.0200326") +
                     stresses("1 bottom", "-0.823648", "-0.0361738") +
                     stresses("1 top", "-0.411824", "-0.0180869") +
                     stresses("2 bottom", "-0.354175", "-0.0198338"),
                   stack("0/90/90/0") + uniform + finer);
  check_quantities("[45/-45] SS-2, uniform",
                   SS_2,
                   8e-3,
                   deflection("1.02804340") + moments("0.0375572", "0.0375572"),
                   stack("45/-45") + uniform);
  check_quantities("[0/90] clamped",
                   clamped,
                   1e-2,
                   deflection("0.39519985") + moments("0.023867", "0.023867"),
                   stack("0/90") + finer);
  check_quantities("[0/90/90/0] clamped",
                   clamped,
                   2e-2,
                   deflection("0.14365533") + moments("0.042449", "0.005689"),
                   stack("0/90/90/0") + finer);
  check_quantities("[45/-45] clamped",
                   clamped,
                   1e-2,
                   deflection("0.4072976") + moments("0.021553", "0.021553"),
                   stack("45/-45") + finer);
  check_quantities("tube [55/-55/-55/55]",
                   "laminates/tube",
                   1e-3,
                   "ex = displacement z at (R, 0, L) -> 3.547942253*p*L; "
                   "et = displacement x at (R, 0, L/2) -> 6.751992350*p*R",
                   stack("55/-55/-55/55") + Settings{"Study/Refinements=1"});
}

/** Large deflections and rotations. */
void
check_finite_rotations()
{
  const std::vector<std::pair<std::string, std::string>> loads =
    {{"17.79", "0.236169"}, {"95", "0.901782"}};
  for (const auto &[load, w] : loads)
    check_quantities("clamped plate, nu = 0.316, q a^4/(E h^4) = " + load,
                     "benchmarks/finite_plate",
                     1e-3,
                     "w = displacement z at (a/2, a/2, 0) -> " + w + "*h0",
                     {"Section/Poisson's ratio=0.316",
                      "Analysis/Output times=",
                      "Analysis/Time step=" + load,
                      "Analysis/End time=" + load,
                      "Mid-surface/Subdivisions=2, 2"});

  // A quarter of the load; values of isogeometric cells, within 2 %
  const std::string line      = "materials/cylinder_line_load";
  const Settings    quarter   = {"Analysis/End time=0.25",
                                 "Analysis/Time step=0.125",
                                 "Analysis/Maximum time step=0.125",
                                 "Analysis/Output times=",
                                 "Study/Degrees=3",
                                 "Mid-surface/Subdivisions=3, 6"};
  const auto        deflected = [](const std::string &w) {
    return "w = displacement z at (0, L/2, R) -> -" + w;
  };
  check_quantities("cylinder under a line load, rubber",
                   line,
                   3e-2,
                   deflected("0.025199"),
                   quarter);
  check_quantities("the same, Saint Venant and Kirchhoff",
                   line,
                   3e-2,
                   deflected("0.030931"),
                   quarter + Settings{"Section/Type=isotropic",
                                      "Section/Young's modulus=1.68e11",
                                      "Section/Poisson's ratio=0.4"});
}

int
main(int argc, char *argv[])
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_foundations();
  check_initial_strains();
  check_laminates();
  check_finite_rotations();
  return n_failures > 0;
}
