// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Rows of doc/stability.md and doc/benchmarks/stability_rows.md: critical
// loads, p = 4, on coarse meshes or a half wave of a cylinder. References:
// closed forms, Fourier series, Ritz.

#include "../study_rows.h"

using namespace Tests;

Settings
with_force(const std::string &force)
{
  return {"Analysis/Membrane force=" + force};
}

/** k = N b^2/(pi^2 D). */
void
check_plates()
{
  const std::string file   = "benchmarks/buckling_plate";
  const Settings    fixed  = with_edges("left, right, bottom, top: fixed");
  const Settings    square = with_cells("4, 4"),
                 long_plate =
                   with_cells("6, 3") + Settings{"Mid-surface/plate/Size=2, 1"},
                 disk = with_cells("2") + Settings{"Mid-surface/Surface=disk"} +
                        with_force("-D, -D, 0");
  const std::string along = "-pi^2*D, 0, 0", both = "-pi^2*D, -pi^2*D, 0",
                    bending = "-pi^2*D*(1 - 2*y), 0, 0", shear = "0, 0, pi^2*D";
  const std::vector<StudyRow> rows = {
    {"plate SSSS", file, 1e-3, {4., 6.25}, square + fixed + with_force(along)},
    {"plate SSSS, biaxial",
     file,
     1e-3,
     {2., 5., 5.},
     square + fixed + with_force(both)},
    {"plate CCCC",
     file,
     1e-3,
     {10.073948, 11.610113},
     square + with_force(along)},
    {"plate CCCC, biaxial",
     file,
     1e-3,
     {5.303626, 9.334153, 9.334153},
     square + with_force(both)},
    {"plate SSSS, shear",
     file,
     1e-3,
     {9.324520, 11.545909},
     square + fixed + with_force(shear)},
    {"plate 2 x 1 SSSS, shear",
     file,
     1e-3,
     {6.546029, 6.572789},
     long_plate + fixed + with_force(shear)},
    {"plate SSSS, bending",
     file,
     1e-3,
     {25.528348, 27.113849},
     square + fixed + with_force(bending)},
    {"plate 2 x 1 SSSS, bending",
     file,
     1e-3,
     {23.881813, 25.528348},
     long_plate + fixed + with_force(bending)},
    {"plate, loaded edges SS, sides clamped",
     file,
     1e-3,
     {7.691284, 8.604451},
     square + with_edges("left, right: fixed; bottom, top: clamped") +
       with_force(along)},
    {"plate, loaded edges clamped, sides SS",
     file,
     1e-3,
     {6.743190, 10.386480},
     square + with_edges("left, right: clamped; bottom, top: fixed") +
       with_force(along)},
    {"circle, clamped",
     file,
     1e-3,
     {14.681971},
     disk + with_edges("rim: clamped")},
    {"circle, SS", file, 1e-3, {4.197787}, disk + with_edges("rim: fixed")}};
  for (const auto &row : rows)
    check_row(row);
}

/** Over beam theory, and 1e-11 of the force. */
void
check_strips()
{
  const std::string file  = "benchmarks/buckling_strip";
  const Settings    cells = with_cells("8, 1"),
                 thrust   = {"Loads/Edge forces=right: (-pi^2*1e-9/48, 0, 0)"},
                 nu       = {"Section/Poisson's ratio=0.3"};
  check_row({"strip, end shear, nu = 0", file, 1e-3, {4.9289}, cells});
  check_row({"strip, end thrust, nu = 0", file, 1e-3, {1.}, cells + thrust});
  check_row(
    {"strip, end thrust, nu = 0.3", file, 1e-3, {1.0076}, cells + thrust + nu});
  check_row({"strip, end shear, nu = 0.3", file, 1e-3, {4.3636}, cells + nu});
}

/** Half a wave of n around between planes of symmetry. */
Settings
half_wave(const unsigned int n)
{
  return {"Mid-surface/expression/Range v=0, pi/" + std::to_string(n),
          "Mid-surface/expression/Closed=none",
          "Boundary conditions/Edges=u=0, u=1: diaphragm; v=0, v=1: symmetry"};
}

Settings
cylinder(const std::string &L, const std::string &h, const std::string &more)
{
  return {"Section/Thickness=" + h,
          "Constants=R = 1, L = " + L + ", N_cl = " + h +
            "^2/sqrt(3*(1 - 0.3^2))" + more};
}

/** N/N_cl and p of cylinders between diaphragms. */
void
check_diaphragms()
{
  struct Geometry
  {
    std::string L, h, cells;
    /** Waves around of the axial modes and their loads. */
    std::vector<std::pair<unsigned int, double>> axial;
    /** Waves around, exponent and lateral and hydrostatic loads: the pressure
     * follows, and it is dead. */
    unsigned int          n;
    std::string           unit;
    std::array<double, 4> pressures;
  };
  const std::vector<Geometry> geometries = {
    {"1",
     "0.01",
     "5, 2",
     {{7, .9594893}, {9, .9830070}},
     8,
     "1e-5",
     {{1.0548486, 1.0684124, .97682416, .98844709}}},
    {"2",
     "0.01",
     "5, 2",
     {{5, .9261229}, {7, .9594893}, {8, .9702351}},
     6,
     "1e-6",
     {{4.8433828, 4.9688910, 4.6733861, 4.7901378}}},
    {"2",
     "0.002",
     "5, 2",
     {{8, .9703909}, {11, .9837015}},
     9,
     "1e-8",
     {{8.4102885, 8.5109844, 8.2808947, 8.3784982}}},
    {"20",
     "0.02",
     "10, 2",
     {{2, .6148973}, {3, .8081845}},
     2,
     "1e-6",
     {{2.4778592, 3.2924866, 2.4651360, 3.2700619}}}};
  for (const auto &[L, h, cells, axial, n, unit, pressures] : geometries)
    {
      const std::string name = "cylinder L = " + L + ", h = " + h;
      for (const auto &[waves, expected] : axial)
        check_row({name + ", axial, n = " + std::to_string(waves),
                   "benchmarks/buckling_cylinder",
                   1e-3,
                   {expected},
                   cylinder(L, h, "") + half_wave(waves) + with_cells(cells)});
      for (unsigned int k = 0; k < 4; ++k)
        check_row({name + (k < 2 ? ", lateral" : ", hydrostatic") +
                     (k % 2 == 0 ? ", follows" : ", dead"),
                   "benchmarks/buckling_pressure",
                   1e-3,
                   {pressures[k]},
                   cylinder(L, h, ", p = " + unit) + half_wave(n) +
                     with_cells(cells) +
                     with_force(k < 2 ? "0, -p*R, 0" : "-p*R/2, -p*R, 0") +
                     Settings{std::string("Loads/Pressure follows=") +
                              (k % 2 == 0 ? "true" : "false")}});
    }
}

/** Clamped cylinders: uniform forces, and those of an end shortening. */
void
check_prestress()
{
  const std::string file    = "benchmarks/buckling_prestress";
  const auto        uniform = Settings{"Boundary conditions/Points=",
                                "Loads/Edge forces=",
                                "Analysis/Prestress=membrane force"} +
                       with_edges("u=0, u=1: clamped; v=0, v=1: symmetry") +
                       with_force("-N_cl, 0, 0") + with_cells("12, 2");
  const auto shortened =
    with_edges("u=0: clamped; u=1: x = -N_cl*L/h, y = 0, z = 0, rotation = 0; "
               "v=0, v=1: symmetry") +
    Settings{"Boundary conditions/Points=", "Loads/Edge forces="} +
    with_cells("12, 2");
  const std::string reaction = "reaction x of u=1 -> -N_cl*pi/n";
  const auto        tube =
    [](const std::string &L, const std::string &h, const unsigned int n) {
      return cylinder(L, h, ", n = " + std::to_string(n));
    };
  const auto prestress = [](const std::string &kind) {
    return Settings{"Analysis/Prestress=" + kind};
  };
  const std::vector<StudyRow> rows = {
    {"clamped, n = 9", file, 1e-4, {.9869629}, tube("2", "0.01", 9) + uniform},
    {"clamped, n = 8", file, 1e-3, {.9983401}, tube("2", "0.01", 8) + uniform},
    {"L = 1, h = 0.005",
     file,
     1e-4,
     {1.0008201},
     tube("1", "0.005", 12) + uniform},
    {"clamped, linear state",
     file,
     1e-4,
     {.9872320},
     tube("2", "0.01", 9) + shortened + prestress("linear"),
     1,
     reaction},
    {"its moments as well",
     file,
     1e-4,
     {.9872326},
     tube("2", "0.01", 9) + shortened + prestress("forces and moments"),
     1,
     reaction},
    {"derivative of the tangent",
     file,
     1e-4,
     {.9889302},
     tube("2", "0.01", 9) + shortened + prestress("tangent"),
     1,
     reaction},
    {"L = 1, h = 0.005, linear state",
     file,
     1e-4,
     {1.0009709},
     tube("1", "0.005", 12) + shortened + prestress("linear"),
     1,
     reaction},
    {"its moments as well, L = 1",
     file,
     1e-4,
     {1.0009689},
     tube("1", "0.005", 12) + shortened + prestress("forces and moments"),
     1,
     reaction},
    {"derivative of the tangent, L = 1",
     file,
     1e-4,
     {1.0019386},
     tube("1", "0.005", 12) + shortened + prestress("tangent"),
     1,
     reaction}};
  for (const auto &row : rows)
    check_row(row);
}

/** p R^3/(E I): n^2 - 1, or n^2 if the pressure is dead. */
void
check_ring()
{
  const Settings ring = with_cells("1, 8") + with_force("0, -p*R, 0") +
                        with_edges("v=0, v=1: symmetry") +
                        Settings{"Constants=R = 1, L = 0.02, p = 0.01^3/12",
                                 "Mid-surface/expression/Range v=0, pi/2",
                                 "Mid-surface/expression/Closed=none"};
  const std::string file = "benchmarks/buckling_pressure";
  check_row({"ring, pressure follows", file, 1e-3, {3.}, ring});
  check_row({"ring, dead pressure",
             file,
             1e-3,
             {4.},
             ring + Settings{"Loads/Pressure follows=false"}});
}

/** N_xt, e-5, of a whole cylinder: its waves wind around it. */
void
check_torsion()
{
  const auto twisted = with_cells("4, 16") + with_force("0, 0, 1e-5");
  check_row({"cylinder, torsion",
             "benchmarks/buckling_cylinder",
             3e-3,
             {1.6505101},
             twisted + Settings{"Analysis/Range of modes=1.64, 1.66"}});
  const Settings held = {"Boundary conditions/Points="};
  check_row({"cylinder, torsion, fixed",
             "benchmarks/buckling_cylinder",
             7e-3,
             {1.7470157},
             twisted + held + with_edges("u=0, u=1: fixed") +
               Settings{"Analysis/Range of modes=1.74, 1.76"}});
  check_row({"cylinder, torsion, clamped",
             "benchmarks/buckling_cylinder",
             7e-3,
             {1.7677112},
             twisted + held + with_edges("u=0, u=1: clamped") +
               Settings{"Analysis/Range of modes=1.76, 1.79"}});
}

/** (W/h)^2 eps of the modes that are even across, in a quarter. */
void
check_stretched_sheet()
{
  for (const auto &[nu, critical] :
       std::vector<std::pair<std::string, double>>{{"0.3", 5.132},
                                                   {"0.49999", 2.012}})
    check_row({"stretched sheet, nu = " + nu,
               "benchmarks/buckling_strip",
               1e-2,
               {critical},
               with_cells("6, 5") +
                 with_edges("left: x = -eps*L/2, y = 0, z = 0, rotation = 0; "
                            "right, bottom: symmetry") +
                 Settings{"Constants=L = 2, W = 1, eps = 1e-2",
                          "Mid-surface/plate/Size=L/2, W/2",
                          "Mid-surface/Grading u=s^2",
                          "Section/Thickness=1e-3",
                          "Section/Poisson's ratio=" + nu,
                          "Loads/Edge forces="}});
}

/** p/p_cl of the odd harmonics l = 17, in an octant. */
void
check_sphere()
{
  check_row({"sphere, l = 17",
             "benchmarks/buckling_sphere",
             1e-3,
             {.9966094},
             with_cells("4") + with_edges("x=0, y=0, z=0: diaphragm") +
               Settings{"Analysis/Range of modes=0.995, 0.9973"}});
}

/** N a^2/(E2 h^3) of plates, and N, p of cylinders with diaphragms. */
void
check_laminates()
{
  const Settings buckling = {"Analysis/Type=buckling",
                             "Analysis/Prestress=membrane force",
                             "Analysis/Membrane force=-h^3, 0, 0",
                             "Loads/Force per area=0, 0, 0"};
  const auto     stack    = [](const std::string &plies) {
    return Settings{"Section/Laminate/Stack=[" + plies + "]"};
  };
  // Coupling lowers the loads of the plates by (h/a)^2: doc/stability.md
  const Settings    thin             = {"Section/Laminate/Thickness=0.001"};
  const std::string SS_1             = "laminates/plate_cross_ply",
                    SS_2             = "laminates/plate_angle_ply",
                    clamped          = "laminates/laminate_clamped";
  const std::vector<StudyRow> plates = {
    {"[0/90] SS-1", SS_1, 1e-3, {9.52645510}, stack("0/90") + thin},
    {"[0/90/90/0] SS-1", SS_1, 1e-3, {23.49493546}, stack("0/90/90/0")},
    {"[45/-45] SS-2", SS_2, 1e-3, {15.47576296}, stack("45/-45") + thin},
    {"[0/90] clamped", clamped, 1e-3, {31.785470}, stack("0/90") + thin},
    {"[0/90/90/0] clamped", clamped, 1e-3, {87.710739}, stack("0/90/90/0")},
    {"[45/-45] clamped", clamped, 1e-3, {30.98237}, stack("45/-45") + thin}};
  for (auto row : plates)
    {
      row.settings = row.settings + buckling + with_cells("4, 4");
      check_row(row);
    }

  const Settings laminate = {
    "Section/Type=laminate",
    "Section/Laminate/Materials=graphite: E1 = 25, E2 = 1, nu12 = 0.25, "
    "G12 = 0.5",
    "Section/Laminate/Thickness=0.01",
    "Section/Laminate/Material direction=x"};
  const std::string axial               = "benchmarks/buckling_cylinder",
                    hydrostatic         = "benchmarks/buckling_pressure";
  const std::vector<StudyRow> cylinders = {
    {"cylinder [0/90], axial",
     axial,
     1e-3,
     {1.3005545},
     stack("0/90") + half_wave(8) + with_force("-1e-4, 0, 0") +
       with_cells("10, 2")},
    {"cylinder [0/90/90/0], axial",
     axial,
     1e-3,
     {1.7461977},
     stack("0/90/90/0") + half_wave(7) + with_force("-1e-4, 0, 0") +
       with_cells("8, 2")},
    {"cylinder [0/90], hydrostatic",
     hydrostatic,
     1e-3,
     {1.9368798},
     stack("0/90") + half_wave(6) + with_force("-p*R/2, -p*R, 0") +
       Settings{"Constants=R = 1, L = 2, p = 1e-5"} + with_cells("5, 2")},
    {"cylinder [0/90/90/0], hydrostatic",
     hydrostatic,
     1e-3,
     {1.8155018},
     stack("0/90/90/0") + half_wave(6) + with_force("-p*R/2, -p*R, 0") +
       Settings{"Constants=R = 1, L = 2, p = 1e-5"} + with_cells("5, 2")}};
  for (auto row : cylinders)
    {
      row.settings = laminate + row.settings;
      check_row(row);
    }
}

int
main(int argc, char *argv[])
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_plates();
  check_strips();
  check_diaphragms();
  check_prestress();
  check_ring();
  check_torsion();
  check_stretched_sheet();
  check_sphere();
  check_laminates();
  return n_failures > 0;
}
