#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Steps that must fail, with what must be said, and steps that must not.

  failing_steps.py NACRE CASE [--ranks N]
  failing_steps.py --list

Each case runs a parameter file of this folder in an empty one, reads
NAME_path.csv and checks the exit code, the words and the numbers.
"""
import argparse
import csv
import math
import os
import re
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import run_study  # noqa: E402  (found by the line above)

TIMEOUT = 100


class Failure(Exception):
    """What is wrong, in a line."""


def check(condition, text):
    if not condition:
        raise Failure(text)


class Run:
    """A run: `code`, `text` of both outputs in one line, `rows` of the path
    as dictionaries of numbers, and the names of the `files` it left."""

    def __init__(self, arguments, prm, settings, folder):
        command = [os.path.abspath(arguments.nacre), str(HERE / prm)]
        settings = {"Study/Output folder": "out", "Study/Name": "run",
                    **settings}
        for name, value in settings.items():
            command += ["--set", f"{name}={value}"]
        if arguments.ranks > 1:
            command = ["mpirun", "--oversubscribe", "-np",
                       str(arguments.ranks), *command]
        environment = dict(os.environ, OMP_NUM_THREADS="1",
                           OMPI_ALLOW_RUN_AS_ROOT="1",
                           OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        if arguments.ranks == 1:
            environment.update(run_study.start_alone(folder))
        with subprocess.Popen(command, cwd=folder, env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              errors="replace",
                              start_new_session=True) as process:
            try:
                out, _ = process.communicate(timeout=TIMEOUT)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.communicate()
                raise Failure(f"hangs: no end after {TIMEOUT} s") from None
        print(out, flush=True)
        self.code = process.returncode
        self.text = " ".join(out.split())
        self.files = {path.name for path in Path(folder, "out").glob("*")}
        path = Path(folder, "out", "run_path.csv")
        self.rows = []
        if path.exists():
            with open(path, newline="", encoding="utf-8") as file:
                self.rows = [{name: float(value) for name, value in row.items()}
                             for row in csv.DictReader(file)]

    def ends(self, code, *words):
        """It ends with the code and one message that holds the words."""
        check(self.code == code, f"exit code {self.code} instead of {code}")
        said = self.text.partition("nacre: error:")[2]
        check(self.text.count("nacre: error:") == (code != 0),
              "one message is expected of a run that fails, none of others")
        for word in words:
            check(re.search(word, said), f"'{word}' is not in: {said}")
        for word in ("Segmentation", "terminate called", "MPI_ABORT"):
            check(word not in self.text, word)

    def keeps_last_state(self):
        """Fields of the last row and a complete checkpoint are written."""
        step = int(self.rows[-1]["step"])
        check(any(re.fullmatch(rf"run_0*{step}\.vtu", name)
                  for name in self.files), f"no fields of step {step}")
        check("run.checkpoint" in self.files, "no checkpoint")

    def cut_back(self):
        return self.text.count("trying half the step")


def never_falls(rows, name):
    """A load that grows only adds to the energy, but for an error of the mesh
    where it has no equilibrium any more."""
    for before, after in zip(rows, rows[1:]):
        check(after[name] >= 0.99 * before[name],
              f"{name} falls from {before[name]} to {after[name]} at t = "
              f"{after['time']}")


# --- A strip with a crease, bent back sharply at its clamp -------------------
FOLD_ENERGY = 2.0410  # 32 cells of p = 3, at t = 1
NO_VTU = {"Study/Write VTU": "false"}


def fold_force_coarse(run):
    """Cells that are too long for the bend: no equilibrium near t = 0.86."""
    result = run("fold_force.prm", NO_VTU)
    never_falls(result.rows, "U")
    if result.code == 0:
        check(abs(result.rows[-1]["U"] - FOLD_ENERGY) < 0.05 * FOLD_ENERGY,
              "the strip has folded")
    else:
        result.ends(1, r"at \(\S+ \S+ \S+\) of the undeformed surface",
                    r"last good state, at t = 0\.8\d+, is kept")


def fold_force_relaxation(run):
    """Relaxation finds the energy's minimum with the clamp torn off: refused"""
    result = run("fold_force.prm", {**NO_VTU, "Analysis/Type": "relaxation",
                                     "Analysis/Maximum iterations": 12,
                                     "Analysis/Minimum time step": 0.03})
    never_falls(result.rows, "U")
    check("torn off its prescribed rotation, by 1" in result.text,
          "not seen that the clamp is torn off")
    check(result.rows[-1]["time"] > 0.75, "it gives up early")
    check(result.rows[-1]["U"] > 1.8, "the strip has folded")
    if result.code != 0:
        result.ends(1, r"at \(\S+ \S+ \S+\) of the undeformed surface")


def torn_clamp(run):
    """The first step of it, not to be made smaller."""
    result = run("fold_force.prm", {"Analysis/Type": "relaxation",
                                    "Analysis/Maximum iterations": 12,
                                    "Analysis/Minimum time step": 0.1})
    result.ends(1, r"the edge at \(0 \S+ 0\) of the undeformed surface is "
                   r"torn off its prescribed rotation, by 1\d\d",
                "at t = 0, is kept", "finer mesh or a higher degree",
                "'Type = dynamic'")
    result.keeps_last_state()


def fold_force_fine(run):
    """Cells short enough follow the bend, without a false alarm."""
    result = run("fold_force.prm", {**NO_VTU, "Study/Refinements": 1})
    result.ends(0)
    never_falls(result.rows, "U")
    check(abs(result.rows[-1]["U"] - FOLD_ENERGY) < 2e-3 * FOLD_ENERGY,
          f"U = {result.rows[-1]['U']}")


# --- Steps that can't be solved ----------------------------------------------
def undefined_load(run):
    """A load that is not a number from t = 0.5 on."""
    result = run("strip.prm", {
        "Analysis/Load factor": 1,
        "Loads/Force per area": "0, 0, -1e-3*sqrt(0.55 - t)"})
    result.ends(1, r"Loads/Force per area \(z\): '-1e-3\*sqrt\(0\.55 - t\)' is "
                   r"not a number at x = .*, t = 0\.6; it must be finite",
                r"last good state, at t = 0\.5, is kept")
    check(abs(result.rows[-1]["time"] - 0.5) < 1e-12, "the wrong last step")
    check(result.cut_back() == 0, "smaller steps don't help")
    result.keeps_last_state()


def undefined_point_force(run):
    """The same on one rank only, and in time."""
    result = run("strip.prm", {
        "Analysis/Type": "dynamic", "Section/Density": 1,
        "Loads/Point forces": "(10, 0.5, 0): 0, 0, 1e-3*log(0.55 - t)"})
    result.ends(1, r"Loads/Point forces.*is (not a number|infinite) at .*"
                r"t = 0\.5\d+;",
                r"last good state, at t = 0\.5, is kept")
    check(result.cut_back() == 0, "smaller steps don't help")
    result.keeps_last_state()


def undefined_displacement(run):
    """A prescribed displacement that is infinite at t = 0.3."""
    result = run("strip.prm", {
        "Analysis/Load factor": 1,
        "Boundary conditions/Edges":
            "u=0: clamped; u=1: z = t/if(t < 0.25, 1, 0)"})
    result.ends(1, r"edge 'u=1' \(z\).* is infinite at .*t = 0\.3;",
                r"last good state, at t = 0\.2, is kept")
    result.keeps_last_state()


def collapsed_cell(run):
    """One end is pushed through the other: the cell's area vanishes."""
    result = run("strip.prm", {
        "Analysis/Load factor": 1,
        "Boundary conditions/Edges":
            "u=0: clamped; u=1: x = -20*t, y = 0, z = 0",
        "Mid-surface/Subdivisions": "1, 1", "Analysis/Time step": 0.25,
        "Study/Degrees": 2})
    result.ends(1, "has shrunk to|is turned over|not a number",
                r"at \(\S+ \S+ \S+\) of the undeformed surface",
                "last good state, at t = 0.4", "finer mesh")
    check(result.cut_back() > 2, "the step is not cut back")
    result.keeps_last_state()


def singular_tangent(run):
    """So thin that its bending stiffness vanishes in round-off."""
    result = run("strip.prm", {"Section/Thickness": 1e-20,
                               "Loads/Force per area": "0, 0, -1e-12"})
    result.ends(1, "the tangent is singular to working precision",
                "part of it, may move freely", "at t = 0, is kept")
    check(result.cut_back() > 2, "the step is not cut back")
    result.keeps_last_state()


# --- Edges that turn ---------------------------------------------------------
def twist(run):
    """A strip is twisted by a whole turn with `rotation = 0` at its end."""
    result = run("twist.prm", NO_VTU)
    result.ends(0)
    check(result.cut_back() == 0, "a step is cut back")
    rows = result.rows
    check(len(rows) == 21, f"{len(rows)} rows")
    # Saint-Venant's torque and the stretch of the fibres off the axis:
    # U = 1/2 GJ k^2 L + 1/2 E h b^5/720 k^4 L with k = 2 pi t/L, nu = 0
    def energy(t):
        k, length, b, h, young = 2 * math.pi * t / 10, 10., 1., 0.05, 1e6
        torsion = young / 2 * b * h**3 / 3
        return length * (torsion * k**2 + young * h * b**5 / 720 * k**4) / 2
    for row in rows[1:]:
        check(abs(row["U"] - energy(row["time"])) <= 0.1 * energy(row["time"]),
              f"U = {row['U']} at t = {row['time']}, about "
              f"{energy(row['time'])} is right")
    # Third differences of a smooth energy, about 180 degrees and elsewhere
    U = [row["U"] for row in rows]
    third = [U[i + 3] - 3 * U[i + 2] + 3 * U[i + 1] - U[i]
             for i in range(len(U) - 3)]
    for i in range(2, len(third)):
        check(third[i] >= third[i - 1] > 0, f"U is not smooth near row {i}")


def twist_back(run):
    """Turned the other way: the mirrored state, with the same energy."""
    few = {**NO_VTU, "Analysis/End time": 0.6, "Analysis/Time step": 0.1,
           "Mid-surface/Subdivisions": "6, 1"}
    forth = run("twist.prm", few)
    back = run("twist.prm", {**few, "Constants": "L = 10, b = 1, turns = -1"})
    for result in (forth, back):
        result.ends(0)
        check(len(result.rows) == 7 and result.cut_back() == 0, "cut back")
    for a, b in zip(forth.rows, back.rows):
        check(abs(a["U"] - b["U"]) <= 1e-6 * a["U"] + 1e-15,
              f"{a['U']} and {b['U']} at t = {a['time']}")


def fold_rotate_in_plane(run):
    """The same between symmetry planes: edges turn by exactly 180 degrees."""
    fold_rotate(run, {"Boundary conditions/Edges":
                      "start: fixed, rotation = 4*pi; v=0, v=1: symmetry"})


def fold_rotate(run, more=()):
    """A hinged strip turned by two whole turns stores no energy."""
    result = run("fold_rotate.prm", {**NO_VTU, **dict(more)})
    result.ends(0)
    check(len(result.rows) == 25 and result.cut_back() == 0, "cut back")
    for row in result.rows:
        check(row["U"] < 1e-20, f"U = {row['U']} at t = {row['time']}")
        angle = 4 * math.pi * row["time"]
        c, s = math.cos(angle), math.sin(angle)
        # The corner (1, 1) of the profile turns from x towards -z.
        check(abs(row["x"] - (c + s - 1)) < 1e-8
              and abs(row["z"] - (c - s - 1)) < 1e-8,
              f"x, z = {row['x']}, {row['z']} at t = {row['time']}")


CASES = {case.__name__: case for case in (
    fold_force_coarse, fold_force_relaxation, torn_clamp, fold_force_fine,
    undefined_load, undefined_point_force, undefined_displacement,
    collapsed_cell, singular_tangent, twist, twist_back, fold_rotate,
    fold_rotate_in_plane)}


def main():
    if sys.argv[1:] == ["--list"]:
        print("\n".join(CASES))
        return 0
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("nacre")
    parser.add_argument("case", choices=CASES)
    parser.add_argument("--ranks", type=int, default=1)
    arguments = parser.parse_args()

    def run(prm, settings):
        with tempfile.TemporaryDirectory() as folder:
            return Run(arguments, prm, settings, folder)

    try:
        CASES[arguments.case](run)
    except Failure as failure:
        print(f"FAILED: {failure}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
