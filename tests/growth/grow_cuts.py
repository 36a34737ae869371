#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Let cuts grow and check the tables of their growth.

  grow_cuts.py NACRE CASE    run a case
  grow_cuts.py --list        their names

A case has a parameter file of prm/cutting, parameters to set, numbers of
ranks, and a function that checks the rows, dictionaries of the columns of
<name>_growth.csv.
"""
import argparse
import csv
import math
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
PRM = HERE.parents[1] / "prm/cutting"
sys.path.insert(0, str(HERE.parent))
import run_study  # noqa: E402  (found by the line above)


def check(condition, text):
    print(text)
    if not condition:
        raise run_study.Failure(text)


def check_near(name, value, expected, tolerance):
    check(abs(value - expected) <= tolerance,
          f"{name}: {value:.8g}, expected {expected:.8g} +- {tolerance:g}")


def inclined(rows):
    """V13: the tips; each state is critical, and its G is what is released."""
    check_near("rows", len(rows), 6, 0)
    for tip, x, y in (("crack_begin", -.63605, -.12470),
                      ("crack_end", .65803, .10987)):
        check_near(f"x of {tip}", rows[-1][f"x_{tip}"], x, 2e-3)
        check_near(f"y of {tip}", rows[-1][f"y_{tip}"], y, 2e-3)
    for row in rows:
        check_near("larger G over Gc h", 20. * max(row["G_crack_begin"],
                                                   row["G_crack_end"]),
                   1., 1e-9)
    # Both tips advance: dU/da of fixed loads, the crack's length closed up
    length = [row["length_crack"] - row["closed_crack_begin"] -
              row["closed_crack_end"] for row in rows]
    for before, row, after in zip((1, 2, 3), rows[2:], (3, 4, 5)):
        rise = (rows[after]["U"] / rows[after]["load_factor"]**2 -
                rows[before]["U"] / rows[before]["load_factor"]**2)
        released = rise / (length[after] - length[before])
        check_near("dU/da at unit loads over G",
                   released * 2. * row["load_factor"]**2 /
                   (row["G_crack_begin"] + row["G_crack_end"]), 1., .06)


# G E/(h sigma^2 pi a) of an axial crack of the half length a, by lambda =
# (12 (1 - nu^2))^(1/4) a/(R h)^(1/2), in a shallow shell
FOLIAS = {1: 1.440594, 1.5: 1.945582, 2: 2.617575, 3: 4.407315, 4: 6.707337,
          6: 12.589003, 8: 19.950275}


def folias(place):
    """By the parabola through the next three values."""
    near = sorted(sorted(FOLIAS, key=lambda key: abs(key - place))[:3])
    return sum(FOLIAS[i] * math.prod((place - j) / (i - j)
                                     for j in near if j != i) for i in near)


def tube(rows):
    """The pressure falls as Folias' crack says."""
    check_near("rows", len(rows), 4, 0)
    for row in rows:
        a = (row["length_crack"] - row["closed_crack_begin"] -
             row["closed_crack_end"]) / 2.
        place = (12. * .91)**.25 * a / .1
        sigma = 100. * row["load_factor"]
        g = row["G_crack_end"] * 1e9 / (.01 * sigma**2 * math.pi * a)
        check_near(f"G at lambda = {place:.3g}", g / folias(place), 1., .02)
        check(abs(row["angle_crack_end"]) < 1.5, "straight")
    factors = [row["load_factor"] for row in rows]
    check(sorted(factors, reverse=True) == factors, "the pressure falls")


def trouser(rows):
    """A step releases between G before it and G after it, at held legs."""
    n_steps = 0
    for before, after in zip(rows, rows[1:]):
        if before["step"] == after["step"]:
            continue
        n_steps += 1
        check_near("time", after["time"], before["time"], 0)
        released = (before["U"] - after["U"]) / (after["length_tear"] -
                                                 before["length_tear"])
        check(after["G_tear_end"] < released < before["G_tear_end"],
              f"{after['G_tear_end']:.5g} < {released:.5g} < "
              f"{before['G_tear_end']:.5g}")
        check(before["G_tear_end"] >= 66.7 * .02, "above the toughness")
    for row, other in zip(rows, rows[1:]):
        check(row["time"] == other["time"] or row["G_tear_end"] < 66.7 * .02,
              "the time goes on below the toughness only")
    check(n_steps >= 2, f"{n_steps} steps")
    # Rivlin and Thomas; the legs are short, and the mesh is coarse
    check_near("G/(2 F)", before["G_tear_end"] / (2. * before["F"]), 1., .06)


def knife(rows):
    """A tip is where it is told to be, whatever the shell does."""
    check_near("rows", len(rows), 6, 0)
    for row in rows:
        check_near("length", row["length_tear"], 2. + .25 * row["step"], 1e-6)
        length = 1.05 * row["time"]
        check(.25 * row["step"] <= length + 1e-9, "not ahead of the knife")
    check_near("the last row's lag", 1.05 - .25 * rows[-1]["step"], .05, 1e-9)


def short(rows):
    """Novozhilov's mean of Westergaard's stress ahead of the crack."""
    a, d = .3, .2
    check_near("load factor", rows[0]["load_factor"],
               20. * .05 / math.sqrt(1. + 2. * a / d), 2e-4)
    check(abs(rows[0]["angle_crack_end"]) < 1., "straight")
    check_near("stress over strength",
               rows[0]["stress_ratio_crack_end"], 1., 1e-9)


def kirsch(rows):
    """The mean of Kirsch's stress over d from the edge of the hole."""
    a, d = .41, .2
    mean = 1. + (a - a**2 / (a + d) + a - a**4 / (a + d)**3) / (2. * d)
    check_near("load factor", rows[0]["load_factor"], 10. / mean, .03)
    check(abs(rows[0]["x_start"]) < .02 and
          abs(abs(rows[0]["y_start"]) - a) < .05, "at the hole's side")
    check("length_started_1" in rows[1] and "length_started_2" in rows[1],
          "two cracks start")
    for number in (1, 2):
        check_near("length", rows[1][f"length_started_{number}"], .3, .02)


def bent(rows):
    """A plate of which the middle is thin, without any cut, is bent."""
    check_near("load factor", rows[0]["load_factor"], 100. * .05**2 / 6., 3e-4)
    check_near("y of the start", rows[0]["y_start"], 0., .1)
    # From the edge inwards
    check_near("length", rows[1]["length_started_1"], .4, .001)
    check_near("x of the tip", rows[1]["x_started_1_end"], -.6, .001)
    check(rows[2]["x_started_1_end"] > -.3, "it grows")


def pulled(rows):
    """Along a path cracks start when the strength is reached."""
    started = next(i for i, row in enumerate(rows) if row["step"] > 0)
    for row in rows[:started - 1]:
        check(row["stress_ratio_start"] < 1., "below the strength")
    check(rows[started - 1]["stress_ratio_start"] >= 1., "it is reached")
    check_near("time", rows[started]["time"], rows[started - 1]["time"], 0)
    check_near("steps", rows[-1]["step"], 2, 0)
    check(rows[started]["U"] < rows[started - 1]["U"], "energy is released")


def legs(rows):
    """By arc length: G = G_c h, and what the J-integral of the edges says."""
    critical = [row for row in rows if row["G_crack_end"] > .019]
    check_near("critical states", len(critical), 2, 0)
    for row in critical:
        check_near("G", row["G_crack_end"], .02, 1e-7)
        force = .001 * row["load_factor"]
        sine = (row["o"] - row["i"]) / .2
        check_near("2 F sin(theta)", 2. * force * sine, .02, .035 * .02)
    loads = [row["load_factor"] for row in critical]
    check(loads[0] > 1.1 * loads[1], "the load falls")


def held(rows):
    """A lip's displacement is held while a tip advances, and the ends give."""
    n_steps = 0
    for before, after in zip(rows, rows[1:]):
        if before["step"] == after["step"]:
            continue
        n_steps += 1
        check(before["G_crack_end"] >= 1e-4, "above the toughness")
        check_near("w", after["w"], before["w"], 1e-8 * before["w"])
        check(after["time"] < before["time"], "the ends go back")
        check_near("length", after["length_crack"],
                   before["length_crack"] + 1.5 / 12., 1e-6)
    check(n_steps >= 2, f"{n_steps} steps")
    # Equilibria of one length are multiples of each other.
    n_pairs = 0
    for row, other in zip(rows, rows[1:]):
        if row["step"] == other["step"] and row["time"] > 0.:
            n_pairs += 1
            check_near("U/w^2", (other["U"] / other["w"]**2) /
                       (row["U"] / row["w"]**2), 1., 1e-7)
            check_near("t/w", (other["time"] / other["w"]) /
                       (row["time"] / row["w"]), 1., 1e-7)
    check(n_pairs >= 3, f"{n_pairs} pairs")


def pure_shear(rows):
    """W H of the strip far ahead (Rivlin and Thomas 1953); a step at held grips
    releases it."""
    before, after = rows[-2:]
    check(before["step"] == 0. and after["step"] == 1., "a step of growth")
    check_near("time", after["time"], before["time"], 0)
    rate = (before["U"] - after["U"]) / (after["length_crack"] -
                                         before["length_crack"])
    for row in rows:
        if row["time"] == 1.:
            check_near("released over G", rate / row["G_crack_end"], 1., 1e-3)
        stretch = 1. + .5 * row["time"]
        energy = .5 * .1 * (stretch - 1. / stretch)**2
        check_near(f"G/(W H) at {stretch:g}", row["G"] / energy, 1., 3e-3)


def stretched_ring(stretch, n_steps=100):
    """The mean over d = 0.5 of the hoop stress S/mu of a neo-Hookean ring, 1 <
    R < 3, whose outer edge is pulled to the stretch: d(P_1)/dR = (P_2 -
    P_1)/R by Runge and Kutta, the stretch inside by the secant method."""
    size = 2. / n_steps

    def slope(R, radial, hoop):
        rise = (radial - hoop) / R
        P_1, P_2 = (x - 1. / (x * radial * hoop)**2 * x
                    for x in (radial, hoop))
        return (((P_2 - P_1) / R - 2. * rise / (radial * hoop)**3) /
                (1. + 3. / (radial**4 * hoop**2))), rise

    def shoot(hoop):
        R, radial, stresses = 1., hoop**-.5, []
        for _ in range(n_steps):
            stresses.append(1. - 1. / (hoop**4 * radial**2))
            k = [(0., 0.)]
            for part in (0., .5, .5, 1.):
                k.append(slope(R + part * size,
                               radial + part * size * k[-1][0],
                               hoop + part * size * k[-1][1]))
            radial, hoop = (x + size / 6. * (k[1][i] + 2. * k[2][i] +
                                             2. * k[3][i] + k[4][i])
                            for i, x in enumerate((radial, hoop)))
            R += size
        n = n_steps // 4
        return hoop, (sum(stresses[:n + 1]) -
                      .5 * (stresses[0] + stresses[n])) / n

    a, b = stretch, 2. * stretch - 1.
    while abs(b - a) > 1e-8:
        at_a, at_b = shoot(a)[0], shoot(b)[0]
        a, b = b, b + (stretch - at_b) * (b - a) / (at_b - at_a)
    return shoot(b)[1]


def ring(rows):
    """Stresses of rubber, from small to large stretches."""
    check_near("rows", len(rows), 4, 0)
    for row in rows:
        expected = stretched_ring(1. + .5 * row["time"]**2)
        check_near(f"mean stress at t = {row['time']:g}",
                   row["stress_ratio_start"] / expected, 1., 5e-3)


def yielding(rows):
    """Stresses of the faces: sigma_y and hardening, of unloading 2 less."""
    check_near("rows", len(rows), 3, 0)
    for row, curvature, back in zip(rows, (3., 3., 7.), (0., 2., 0.)):
        stress = 2. * (1. + (curvature - 1.) / 11. - back)
        for name in ("start", "slit_begin"):
            check_near(f"stress over strength, {name}",
                       row[f"stress_ratio_{name}"], abs(stress) / 4., 1e-6)


UNIT = {"Study/Degrees": "2"}
HOLE = {"Growth/Criterion": "strength", "Growth/Strength": "100",
        "Growth/Averaging distance": "0.2", "Growth/Starting cracks": "2",
        "Growth/Step": "0.3", "Growth/Maximum steps": "1",
        "Study/Degrees": "3", "Study/Refinements": "0"}
BENT = {**UNIT, "Cuts/Cuts": "", "Cuts/Remove": "", "Loads/Edge forces": "",
        "Loads/Edge moments": "v=0: q; v=1: q", "Section/Poisson's ratio": "0",
        "Section/Thickness": "H*(1 + 0.2*y^2)", "Mid-surface/Subdivisions":
        "15", "Growth/Step": "0.4", "Growth/Starting cracks": "1",
        "Growth/Averaging distance": "0.15", "Growth/Maximum steps": "2"}
PULLED = {**UNIT, "Mid-surface/Subdivisions": "11",
          "Growth/Maximum steps": "2", "Analysis/Type": "static",
          "Analysis/Time step": "0.5", "Loads/Edge forces": "",
          "Boundary conditions/Points": "(-1, -1, 0): x = 0",
          "Boundary conditions/Edges": "v=0: y = 0, z = 0; v=1: y = 0.15*t, "
          "z = 0", "Growth/Step": "2 cells"}

HELD = {"Analysis/Type": "displacement control", "Analysis/Control": "w",
        "Analysis/Control values": "9e-4", "Analysis/Control step": "1.5e-4",
        "Analysis/Maximum steps": "20", "Growth/Maximum steps": "3",
        # At the tip 1/12, at the ends 0.14 long
        "Growth/Step": "1.5 cells", "Mid-surface/Grading v":
        "0.5 + (s - 0.5)*(0.6 + 1.6*(s - 0.5)^2)",
        "Boundary conditions/Edges": "u=0, u=1: z = 0; v=0: y = -0.005, "
        "z = 0; v=1: y = 0.005, z = 0", "Quantities/Quantities":
        "w = displacement y at (0.01, 0.001, 0); U = energy"}

CASES = {
    "inclined": ("inclined_crack.prm", UNIT, (1,), inclined),
    "tube": ("cracked_tube.prm", {**UNIT, "Growth/Maximum steps": "3"}, (1,),
             tube),
    "trouser": ("trouser_tear.prm", {**UNIT, "Analysis/Time step": "0.07",
                                     "Analysis/End time": "0.77"},
                (1,), trouser),
    "knife": ("trouser_tear.prm", {
        **UNIT, "Discretization/Kinematics": "finite",
        "Mid-surface/Subdivisions": "20, 4", "Constants":
        "L = 5, b = 1, a = 2, d = 0.3, Gc = 1", "Growth/Toughness": "",
        "Growth/Criterion": "prescribed", "Growth/Length": "1.05*t",
        "Growth/Step": "0.25", "Analysis/Time step": "0.5"}, (1, 2), knife),
    "legs": ("double_cantilever.prm",
             {**UNIT, "Growth/Maximum steps": "1",
              "Analysis/Maximum steps": "4"}, (1,), legs),
    "held": ("../../tests/growth/snap_back.prm", HELD, (1,), held),
    "short": ("short_crack.prm", {}, (1,), short),
    "kirsch": ("plate_with_hole.prm", HOLE, (1,), kirsch),
    "bent": ("starting_cracks.prm", BENT, (1,), bent),
    "pure_shear": ("../../tests/growth/rubber_strip.prm", {}, (1,),
                   pure_shear),
    "ring": ("../../tests/growth/rubber_ring.prm", {}, (1,), ring),
    "yielding": ("../../tests/growth/bent_metal.prm", {}, (1,), yielding),
    "pulled": ("starting_cracks.prm", PULLED, (1, 2, 3), pulled),
}


def read_table(path):
    with open(path, newline="", encoding="utf-8") as file:
        # Before a crack starts its columns are empty.
        return [{name: float(value) for name, value in row.items() if value}
                for row in csv.DictReader(file)]


def run_case(nacre, file, parameters, ranks, check_rows):
    settings = {"Study/Write VTU": "false", **parameters}
    arguments = argparse.Namespace(
        nacre=nacre, prm=PRM / file, timeout=120,
        overrides=[f"{name}={value}" for name, value in settings.items()])
    first = None
    for n_ranks in ranks:
        with tempfile.TemporaryDirectory() as folder:
            run_study.run_nacre(arguments, n_ranks, folder)
            rows = read_table(pathlib.Path(folder, "output/study_growth.csv"))
        check_rows(rows)
        first = first or rows
        for row, other in zip(first, rows):
            for name in {"load_factor", "U", "o"} & set(row):
                check_near(f"{name} on {n_ranks} ranks", other[name],
                           row[name], 1e-7 * abs(row[name]))


if __name__ == "__main__":
    sys.exit(run_study.run_cases(CASES, run_case, __doc__))
