#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Let cuts grow in dynamics and check the tables of their growth.

  move_cuts.py NACRE CASE    run a case
  move_cuts.py --list        their names

A case has a parameter file of this folder, parameters to set, and a function
that checks the rows of <name>_growth.csv and <name>_path.csv. A state at which
a cut grows is in the first as it was before, in the second as it is
afterwards; the first has no rows while lips are being released.
"""
import argparse
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
sys.path.insert(0, str(HERE))
import run_study  # noqa: E402  (found by the lines above)
from grow_cuts import check, check_near, read_table  # noqa: E402


def conserved(path):
    """Nothing but the release changes momenta and energy."""
    first = path[0]
    for row in path:
        for name in ("px", "pz"):
            check_near(f"{name}, t = {row['time']:.3g}", row[name],
                       first[name], 1e-10 * first["T"])
        check_near("total and released energy", row["E"] + row["R"],
                   first["E"], 1e-9 * first["E"])


def moments(growth, path, n_steps, n_moments, tolerances):
    """The moments of cuts change energies by no more than the tolerances."""
    check_near("steps", growth[-1]["step"], n_steps, 0)
    after = {row["time"]: row for row in path}
    n_found = 0
    for before in growth:
        now = after[before["time"]]
        if now["R"] == before["R"]:
            continue
        n_found += 1
        for name, tolerance in tolerances.items():
            check_near(f"{name} after over before", now[name] / before[name],
                       1., tolerance)
    check_near("moments at which the energy of edges changes", n_found,
               n_moments, 0)


# A moment changes neither kinetic nor bending energy
CLOSED = {"T": 1e-10, "B": 1e-9, "U": 2e-2}


def released(growth, path, nacre):
    """The fracture takes the energy, on any number of ranks."""
    conserved(path)
    moments(growth, path, 4, 3, CLOSED)
    check(path[-1]["R"] > .1 * path[0]["E"],
          f"released {path[-1]['R']:.4g} of {path[0]['E']:.4g}")
    for row, other in zip(path, run(nacre, PLATE, {}, 2)[1]):
        for name in ("T", "U", "R"):
            check_near(f"{name} on two ranks", other[name], row[name],
                       1e-9 * row["E"])


def at_once(growth, path, _nacre):
    """The energy stays in the motion."""
    conserved(path)
    moments(growth, path, 4, 3, CLOSED)
    check_near("total energy", path[-1]["E"] / path[0]["E"], 1., 1e-2)


def with_functions(growth, path, _nacre):
    """What functions of the old tip have goes to the nodes."""
    conserved(path)
    moments(growth, path, 1, 1, {"T": 1e-5, "U": .1})


def slow(growth, _path, nacre):
    """At rest but for the release: the static path's lengths and G."""
    static = run(nacre, STRIP, {
        "Analysis/Type": "static", "Analysis/Mass damping": "0",
        "Analysis/Scheme": "energy momentum", "Quantities/Quantities":
        "U = energy; G1 = energy release rate of crack end radii 0.2, 0.4"})[0]
    before = {}
    for row in static:
        before.setdefault(row["time"], row)
    for row in growth:
        check_near(f"length at {row['time']:.3g}", row["length_crack"],
                   before[row["time"]]["length_crack"], 1e-9)
        check_near("G/static", row["G1"] / before[row["time"]]["G1"], 1., 1e-3)
    last = growth[-1]
    check(last["step"] >= 2, f"{last['step']:g} steps")
    # The legs open in the step in which the lips are released.
    loss = [(row["time"], row["U"] - after["U"])
            for row, after in zip(static, static[1:])
            if row["time"] == after["time"] < 1.]
    least = sum(drop for _, drop in loss)
    most = sum(drop * ((time + .1) / time)**2 for time, drop in loss)
    check(least < last["R"] < most,
          f"{least:.5g} < {last['R']:.5g} < {most:.5g}")
    check_near("energy balance", last["gain"], 0., 1e-3 * least)


PLATE, STRIP = "flying_plate.prm", "peeled_strip.prm"
# One step of growth
SHORT = {"Growth/Length": "1.6*t + 0.1", "Analysis/End time": "0.12"}
CASES = {
    "released": (PLATE, {}, released),
    "at_once": (PLATE, {"Growth/Release time": "0"}, at_once),
    "slow": (STRIP, {}, slow),
    "branch": (PLATE, {**SHORT, "Cuts/Tips": "branch functions",
                         "Mid-surface/Subdivisions": "10, 5"},
               with_functions),
    "harmonic": (PLATE, {**SHORT, "Cuts/Tips": "harmonic"}, with_functions),
}


def run(nacre, file, parameters, ranks=1):
    """The rows of growth and of the path."""
    settings = {"Study/Write VTU": "false", **parameters}
    arguments = argparse.Namespace(
        nacre=nacre, prm=HERE / file, timeout=120,
        overrides=[f"{name}={value}" for name, value in settings.items()])
    with tempfile.TemporaryDirectory() as folder:
        run_study.run_nacre(arguments, ranks, folder)
        return [read_table(pathlib.Path(folder, f"output/study_{name}.csv"))
                for name in ("growth", "path")]


def run_case(nacre, file, parameters, check_rows):
    check_rows(*run(nacre, file, parameters), nacre)


if __name__ == "__main__":
    sys.exit(run_study.run_cases(CASES, run_case, __doc__))
