// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Rows of doc/stability.md and doc/benchmarks/stability_rows.md: frequencies,
// p = 4, on coarse meshes or a half wave of a cylinder. References: closed
// forms, Fourier series, Ritz.

#include "../study_rows.h"

using namespace Tests;

Settings
with_force(const std::string &force)
{
  return {"Analysis/Prestress=membrane force",
          "Analysis/Membrane force=" + force};
}

/** omega 1 is the first one within 5e-4 of a frequency. */
Settings
near(const std::string &omega)
{
  return {"Analysis/Range of modes=" + omega + "*0.9995/(2*pi), " + omega +
          "*1.0005/(2*pi)"};
}

/** omega a^2 sqrt(rho h/D). */
void
check_plates()
{
  const Settings scale   = {"Section/Young's modulus=12*(1 - 0.3^2)/0.01^2"},
                 square  = with_cells("4, 4"),
                 clamped = with_edges("left, right, bottom, top: clamped"),
                 disk = with_cells("2") + Settings{"Mid-surface/Surface=disk"};
  const std::string     file = "benchmarks/vibration_plate";
  std::vector<StudyRow> rows = {
    {"plate CCCC",
     file,
     1e-3,
     {35.985191,
      73.393846,
      73.393846,
      108.216502,
      131.580773,
      132.204790,
      165.000406,
      165.000406},
     with_cells("5, 5") + clamped},
    {"plate 3 x 2 CCCC",
     file,
     1e-3,
     {60.761099, 93.833467, 148.77972, 149.67423, 179.56108},
     with_cells("6, 4") + clamped + Settings{"Mid-surface/plate/Size=1, 2/3"}},
    {"plate SFSF",
     file,
     1e-3,
     {9.631385, 16.134777, 36.725642, 38.944959, 46.738147},
     square + with_edges("left, right: fixed")},
    {"plate CSCS",
     file,
     1e-3,
     {28.950850, 54.743071, 69.327014, 94.585278, 102.216191},
     square + with_edges("left, right: clamped; bottom, top: fixed")},
    {"plate CCCC, tension",
     file,
     1e-3,
     {49.734563, 90.661690, 90.661690, 127.125191},
     square + clamped + with_force("50*0.01, 50*0.01, 0")},
    {"plate CCCC, half the buckling load",
     file,
     1e-3,
     {26.092275, 55.625220, 69.332314, 97.320757},
     square + clamped + with_force("-10.073948/2*pi^2*0.01, 0, 0")},
    {"plate SSSS, forces, foundation",
     file,
     1e-3,
     // omega^2 = (4 - 1 + 2 + 3) pi^4
     {std::sqrt(8.) * numbers::PI * numbers::PI},
     square + with_force("-pi^2*0.01, 2*pi^2*0.01, 0") +
       Settings{"Foundation/Normal stiffness=3*pi^4*0.01"}},
    {"cantilever plate",
     file,
     1e-3,
     {3.471, 8.506, 21.284, 27.199, 30.955},
     square + with_edges("left: clamped")},
    {"free plate",
     file,
     1e-3,
     {13.468, 19.596, 24.270, 34.801, 34.801},
     square + with_edges(""),
     7},
    {"circle, clamped",
     file,
     1e-3,
     {10.215826, 21.260398, 21.260398, 34.877035, 34.877035, 39.771148},
     disk + with_edges("rim: clamped")},
    {"circle, SS",
     file,
     1e-3,
     {4.935149, 13.898165, 13.898165, 25.613297, 25.613297},
     disk + with_edges("rim: fixed")},
    {"circle, free",
     file,
     1e-3,
     {5.358330, 5.358330, 9.003137, 12.438988, 12.438988, 20.474550, 20.474550},
     disk + with_edges(""),
     7}};
  for (auto &row : rows)
    {
      row.settings = scale + row.settings;
      check_row(row);
    }
}

/** Half a wave of n around between planes of symmetry. */
Settings
half_wave(const unsigned int n, const std::string &ends)
{
  return Settings{"Mid-surface/expression/Range v=0, pi/" + std::to_string(n),
                  "Mid-surface/expression/Closed=none"} +
         with_edges(ends + (ends.empty() ? "" : "; ") + "v=0, v=1: symmetry");
}

/** By waves around; R = 1, L = 2, h = 0.01. */
void
check_cylinders()
{
  struct Ends
  {
    std::string name, edges, cells;
    /** Waves around, number of the first mode that isn't rigid, omega. */
    std::vector<std::tuple<unsigned int, unsigned int, std::vector<double>>>
             modes;
    Settings more = {};
  };
  const std::string       diaphragms = "u=0, u=1: diaphragm";
  const std::vector<Ends> all        = {
           {"diaphragms",
            diaphragms,
            "5, 3",
            {{3, 2, {.12816557, .20519768}}, {7, 2, {.15819326, .23940283}}}},
           {"diaphragms, inner pressure",
            diaphragms,
            "5, 2",
            {{4, 2, {.18542562}},
             {5, 2, {.19483553}},
             {3, 2, {.22418686}},
             {6, 2, {.22709821}}},
            with_force("0.5e-5, 1e-5, 0") +
              Settings{"Loads/Pressure=1e-5", "Loads/Pressure follows=true"}},
           {"clamped and free",
            "u=0: clamped",
            "7, 2",
            {{2, 3, {.1445914}},
             {4, 1, {.0669247}},
             {6, 1, {.1084801}},
             {5, 1, {.0798177}},
             {3, 1, {.0833158}}}},
           {"clamped",
            "u=0, u=1: clamped",
            "8, 2",
            {{6, 1, {.1606194}},
             {5, 1, {.1679724}},
             {7, 1, {.1770689}},
             {4, 1, {.2039080}}}},
           {"free",
            "",
            "5, 2",
            {{2, 2, {.0080914, .0108048}},
             {3, 2, {.0228860, .0272345}},
             {4, 2, {.0438806, .0489460}}}}};
  for (const auto &[name, edges, cells, modes, more] : all)
    for (const auto &[n, first, omega] : modes)
      check_row({"cylinder, " + name + ", n = " + std::to_string(n),
                 "benchmarks/vibration_cylinder",
                 1e-3,
                 omega,
                 half_wave(n, edges) + with_cells(cells) + more,
                 first});

  // One wave around: the quarter between the planes of its symmetries
  const Settings quarter =
    half_wave(2, diaphragms) +
    with_edges(diaphragms + "; v=0: symmetry; v=1: diaphragm") +
    with_cells("4, 4");
  const Settings strip = half_wave(30, diaphragms) + with_cells("4, 1");
  for (const double omega : {.60044483, 1.30820683, 2.04233398})
    check_row({"n = 1, " + std::to_string(omega),
               "benchmarks/vibration_cylinder",
               1e-3,
               {omega},
               quarter + near(std::to_string(omega))});
  for (const double omega : {.97313761, 1.69216209})
    check_row({"n = 0, " + std::to_string(omega),
               "benchmarks/vibration_cylinder",
               1e-3,
               {omega},
               strip + near(std::to_string(omega))});
  check_row({"n = 0, torsion",
             "benchmarks/vibration_cylinder",
             1e-3,
             {.97416653},
             strip + with_edges(diaphragms + "; v=0, v=1: diaphragm") +
               near("0.97416653")});
}

/** A sphere, a hemisphere and a cap, E = R = 1, h = 0.01. */
void
check_spheres()
{
  const std::string file   = "benchmarks/vibration_sphere";
  const Settings    octant = {"Mid-surface/sphere/Part=octant"};
  const Settings    even   = with_edges("x=0, y=0, z=0: symmetry"),
                 odd       = with_edges("x=0: symmetry; y=0: diaphragm"),
                 cap       = {"Mid-surface/Surface=file",
                              "Mid-surface/file/File name=../meshes/cap_30.msh",
                              "Mid-surface/file/Curvature=sphere"};
  const std::vector<StudyRow> rows = {
    {"sphere, l = 0",
     file,
     1e-3,
     {1.69031556},
     octant + even + with_cells("2") + near("1.69031556")},
    {"sphere, l = 2, 4",
     file,
     1e-3,
     {.73485493, .73485493, .92458594, .92458594, .92458594},
     octant + even + with_cells("2")},
    {"sphere, torsion, l = 2",
     file,
     1e-3,
     {1.24034735},
     octant + with_edges("x=0, y=0, z=0: diaphragm") + with_cells("2") +
       near("1.24034735")},
    {"hemisphere, n = 2, 4",
     file,
     1e-3,
     {.01290506, .06708172},
     octant + with_cells("3") + with_edges("x=0, y=0: symmetry"),
     2},
    {"hemisphere, n = 3, 5",
     file,
     1e-3,
     {.03549696, .10660780},
     octant + with_cells("3") + odd,
     3},
    {"hemisphere, h = 0.05, n = 2",
     file,
     1e-3,
     {.06163323},
     octant + with_cells("3") + with_edges("x=0, y=0: symmetry") +
       Settings{"Section/Thickness=0.05"},
     2},
    {"hemisphere, h = 0.05, n = 3",
     file,
     1e-3,
     {.16323484},
     octant + with_cells("3") + odd + Settings{"Section/Thickness=0.05"},
     3},
    {"cap, n = 0, 2",
     file,
     1e-3,
     {1.04668898, 1.10609507},
     cap + with_edges("begin, end: symmetry; rim: clamped")},
    {"cap, n = 1, 3",
     file,
     1e-3,
     {1.05141797, 1.18068815},
     cap + with_edges("begin: symmetry; end: diaphragm; rim: clamped")}};
  for (const auto &row : rows)
    check_row(row);
}

/** omega a^2 sqrt(rho/E2)/h of plates, over 100; omega of cylinders. */
void
check_laminates()
{
  const auto stack = [](const std::string &plies) {
    return Settings{"Section/Laminate/Stack=[" + plies + "]"};
  };
  const Settings    vibration  = {"Analysis/Type=vibration",
                                  "Loads/Force per area=0, 0, 0"};
  const std::string SS_1       = "laminates/plate_cross_ply",
                    SS_2       = "laminates/plate_angle_ply",
                    clamped    = "laminates/laminate_clamped";
  std::vector<StudyRow> plates = {{"[0/90] SS-1",
                                   SS_1,
                                   1e-3,
                                   {.0969598208, .26821239, .26821239},
                                   stack("0/90")},
                                  {"[0/90/90/0] SS-1",
                                   SS_1,
                                   1e-3,
                                   {.1522779427, .27947505},
                                   stack("0/90/90/0")},
                                  {"[45/-45] SS-2",
                                   SS_2,
                                   1e-3,
                                   {.1235813914, .28670753, .28670753},
                                   stack("45/-45")},
                                  {"[0/90] clamped",
                                   clamped,
                                   1e-3,
                                   {.204845544, .42283674, .42283674},
                                   stack("0/90")},
                                  {"[0/90/90/0] clamped",
                                   clamped,
                                   1e-3,
                                   {.334459594, .48046837},
                                   stack("0/90/90/0")},
                                  {"[45/-45] clamped",
                                   clamped,
                                   1e-3,
                                   {.19920876, .4009245, .4009245},
                                   stack("45/-45")}};
  for (auto &row : plates)
    {
      row.settings = row.settings + vibration + with_cells("4, 4");
      check_row(row);
    }

  const Settings laminate = {
    "Section/Type=laminate",
    "Section/Laminate/Materials=graphite: E1 = 25, E2 = 1, nu12 = 0.25, "
    "G12 = 0.5, density = 1",
    "Section/Laminate/Thickness=0.01",
    "Section/Laminate/Material direction=x"};
  const std::vector<std::tuple<std::string, unsigned int, double>> cylinders = {
    {"0/90", 5, .23596798},
    {"0/90", 4, .25672450},
    {"0/90/90/0", 5, .23417788}};
  for (const auto &[plies, n, omega] : cylinders)
    check_row({"cylinder [" + plies + "], n = " + std::to_string(n),
               "benchmarks/vibration_cylinder",
               1e-3,
               {omega},
               laminate + stack(plies) + half_wave(n, "u=0, u=1: diaphragm") +
                 with_cells("5, 2"),
               2});
}

int
main(int argc, char *argv[])
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_plates();
  check_cylinders();
  check_spheres();
  check_laminates();
  return n_failures > 0;
}
