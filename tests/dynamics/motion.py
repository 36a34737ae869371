#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Motions whose energy, momentum or period is known.

  motion.py NACRE CASE     one of the functions below

Each runs parameter files in a temporary folder and checks the rows of the path.
"""
import csv
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import run_study  # noqa: E402  (found by the line above)

HERE = Path(__file__).resolve().parent
PRM = HERE.parents[1] / "prm"
FAILURES = []
BALANCE = ("T = kinetic energy; U = energy; W = external work; "
           "P = work of prescribed motion; D = dissipation; "
           "gain = energy balance")


def check(text, value, low, high):
    good = low <= value <= high
    print(f"{'ok    ' if good else 'FAILED'} {text}: {value:.6g} "
          f"(from {low:.6g} to {high:.6g})", flush=True)
    if not good:
        FAILURES.append(text)


class Run:
    """A run, its exit code, output and the rows of its path."""

    def __init__(self, nacre, prm, settings, ranks=1, folder=None, args=()):
        with tempfile.TemporaryDirectory() as temporary:
            folder = folder or temporary
            command = [nacre, str(prm), *args]
            for name, value in settings.items():
                command += ["--set", f"{name}={value}"]
            command += ["--set", "Study/Output folder=output",
                        "--set", "Study/Name=motion",
                        "--set", "Study/Write VTU=false"]
            if ranks > 1:
                command = ["mpirun", "--oversubscribe", "-np", str(ranks),
                           *command]
            environment = dict(os.environ, OMP_NUM_THREADS="1",
                               OMPI_ALLOW_RUN_AS_ROOT="1",
                               OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
            if ranks == 1:
                environment.update(run_study.start_alone(folder))
            done = subprocess.run(command, cwd=folder, env=environment,
                                  text=True, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, timeout=300)
            self.code, self.output = done.returncode, done.stdout
            path = Path(folder, "output", "motion_path.csv")
            self.rows = []
            if path.exists():
                with open(path, newline="", encoding="utf-8") as file:
                    self.rows = [{name: float(text)
                                  for name, text in row.items()}
                                 for row in csv.DictReader(file)]

    def good(self):
        if self.code != 0:
            print(self.output)
            raise SystemExit(f"FAILED: exit code {self.code}")
        return self

    def column(self, name):
        return [row[name] for row in self.rows]

    def largest(self, name):
        return max(map(abs, self.column(name)))

    def drift(self, *names):
        """Largest change of a vector over its length at the start."""
        start = [self.rows[0][name] for name in names]
        return max(math.dist(start, [row[name] for name in names])
                   for row in self.rows) / math.hypot(*start)


def crossing(run):
    """When the plate hangs down: x + 1 changes its sign."""
    times, x = run.column("time"), [1 + x for x in run.column("x")]
    k = next(k for k in range(1, len(x)) if x[k - 1] * x[k] <= 0)
    first = min(max(k - 2, 0), len(x) - 4)
    points = range(first, first + 4)

    def cubic(t):
        return sum(x[a] * math.prod((t - times[b]) / (times[a] - times[b])
                                    for b in points if b != a) for a in points)

    low, high = times[k - 1], times[k]
    for _ in range(50):
        middle = 0.5 * (low + high)
        if cubic(low) * cubic(middle) <= 0:
            high = middle
        else:
            low = middle
    return low


def pendulum(nacre):
    """A rigid plate: period factor 1.180340599 from 90 degrees, sqrt(3 g/L)."""
    quarter = 2 * math.pi * math.sqrt(2 / (3 * 9.81)) * 1.180340599 / 4
    errors = []
    for step in (0.02, 0.01):
        run = Run(nacre, HERE / "pendulum.prm",
                  {"Analysis/End time": "0.52", "Analysis/Time step": step,
                   "Quantities/Quantities":
                   "x = displacement x at (L, L/2, 0); " + BALANCE}).good()
        errors.append(crossing(run) / quarter - 1)
        bottom = max(run.rows, key=lambda row: row["T"])
        check(f"step {step}: energy gained or lost / largest",
              run.largest("gain") / bottom["T"], 0, 1e-9)
    check("quarter of the period, step 0.01: error", errors[1], 0, 2.5e-4)
    check("its order in the step", math.log2(errors[0] / errors[1]), 1.6, 2.2)
    # T = 1/2 m L^2/3 omega^2, m = 78.5; the peak lies between two steps
    check("angular speed at the bottom", math.sqrt(6 * bottom["T"] / 78.5),
          0.998 * 5.42494240, 1.0005 * 5.42494240)


def swings(nacre):
    """Fourteen swings of the rigid plate gain and lose no energy."""
    run = Run(nacre, HERE / "pendulum.prm",
              {"Analysis/End time": "13.6", "Analysis/Time step": "0.02",
               "Quantities/Quantities":
               "x = displacement x at (L, L/2, 0); " + BALANCE}).good()
    hanging = [1 + x for x in run.column("x")]
    passes = sum(a * b < 0 for a, b in zip(hanging, hanging[1:]))
    check("swings", passes, 14, 14)
    check("energy gained or lost / largest",
          run.largest("gain") / run.largest("T"), 0, 2e-8)
    check("warnings", run.output.count("nacre: warning"), 0, 0)


def flag(nacre):
    """A cloth that falls and crumples: no energy is gained by default."""
    settings = {"Mid-surface/Subdivisions": "6, 6", "Analysis/End time": "0.9",
                "Quantities/Quantities": BALANCE}
    run = Run(nacre, HERE / "flag.prm", settings).good()
    check("energy gained or lost / largest",
          run.largest("gain") / run.largest("W"), 0, 1e-8)
    check("work of the weight", run.largest("W"), 1., 1.5)
    check("warnings", run.output.count("nacre: warning"), 0, 0)


def flag_finite(nacre):
    """The same cloth with exact finite rotations."""
    settings = {"Mid-surface/Subdivisions": "6, 6", "Analysis/End time": "0.6",
                "Discretization/Kinematics": "finite",
                "Quantities/Quantities": BALANCE}
    run = Run(nacre, HERE / "flag.prm", settings).good()
    check("energy gained or lost / largest",
          run.largest("gain") / run.largest("W"), 0, 1e-8)
    check("work of the weight", run.largest("W"), 0.5, 1.5)


def flag_midpoint(nacre):
    """The midpoint rule gains energy: warned of once, then the run ends."""
    settings = {"Mid-surface/Subdivisions": "6, 6",
                "Analysis/Scheme": "implicit midpoint",
                "Quantities/Quantities": BALANCE}
    run = Run(nacre, HERE / "flag.prm", settings)
    check("exit code", run.code, 1, 1)
    check("warnings", run.output.count("nacre: warning: Analysis/Scheme"), 1, 1)
    words = ("gained an energy that nothing has put in",
             "of the largest energy", "'Analysis/Scheme = energy momentum'")
    error = run.output[run.output.index("nacre: error"):]
    for text in words:
        check(f"the message has: {text}", error.count(text), 1, 1)
    check("the last state's gain / largest",
          run.rows[-1]["gain"] / run.largest("W"), 0.005, 0.1)
    check("time", run.rows[-1]["time"], 0.1, 1.5)


def free_flight(nacre):
    """Energy, momentum and angular momentum of a free strip."""
    prm = PRM / "benchmarks" / "free_flight.prm"
    run = Run(nacre, prm, {"Analysis/Scheme": "energy momentum",
                           "Analysis/End time": "1"}).good()
    check("energy: drift", run.drift("E"), 0, 1e-10)
    check("momentum: drift", run.drift("px", "py", "pz"), 0, 1e-10)
    check("angular momentum: drift", run.drift("Lx", "Ly", "Lz"), 0, 1e-10)
    # With large steps, too
    run = Run(nacre, prm, {"Analysis/Scheme": "energy momentum",
                           "Analysis/Time step": "0.05",
                           "Analysis/End time": "5"}).good()
    check("step 0.05: energy: drift", run.drift("E"), 0, 1e-9)
    check("step 0.05: angular momentum: drift", run.drift("Lx", "Ly", "Lz"),
          0, 1e-9)


FORCED = """\
set Constants = b = 0.2
subsection Study
  set Degrees = 2
end
subsection Mid-surface
  set Surface      = plate
  set Subdivisions = 6, 1
  subsection plate
    set Size = 1, b
  end
end
subsection Section
  set Young's modulus = 1e6
  set Poisson's ratio = 0.3
  set Thickness       = 0.01
  set Density         = 1000
end
subsection Discretization
  set Kinematics = corotational
end
subsection Boundary conditions
  set Edges = u=0: x = 0, y = 0, z = 0.2*(1 - cos(4*t)), rotation = sin(3*t)
end
subsection Loads
  set Gravity          = 0, 0, -2
  set Pressure         = 3*sin(5*t)
  set Pressure follows = true
  set Edge moments     = u=1: 1e-3*t
end
subsection Analysis
  set Type             = dynamic
  set Time step        = 0.01
  set End time         = 0.5
  set Mass damping     = 0.5
  set Checkpoint steps = 10
end
subsection Quantities
  set Quantities = """ + BALANCE + """
end
"""


def largest_energy(run):
    return max(run.largest(name) for name in "TUWPD")


def forced(nacre):
    """A support that moves and turns does work; loads that change, too."""
    with tempfile.TemporaryDirectory() as folder:
        prm = Path(folder, "forced.prm")
        prm.write_text(FORCED, encoding="utf-8")
        run = Run(nacre, prm, {}).good()
        scale = largest_energy(run)
        check("energy momentum: gain / largest", run.largest("gain") / scale,
              0, 1e-8)
        for name in "TUWPD":
            check(f"part of {name}", run.largest(name) / scale, 0.003, 1)
        ranks = Run(nacre, prm, {}, ranks=2).good()
        check("2 ranks: largest difference / largest",
              max(abs(a[name] - b[name]) for name in "TUWPD"
                  for a, b in zip(run.rows, ranks.rows)) / scale, 0, 1e-7)
        # The work of 0.3 s, whether stopped halfway or not
        part = {"Analysis/End time": "0.2"}
        Run(nacre, prm, part, folder=folder).good()
        again = Run(nacre, prm, {"Analysis/End time": "0.5"}, folder=folder,
                    args=["--restart"]).good()
        check("restarted: largest difference / largest",
              max(abs(a[name] - b[name]) for name in ("W", "P", "D", "gain")
                  for a, b in zip(run.rows, again.rows)) / scale, 0, 1e-10)
        check("rows", len(again.rows), len(run.rows), len(run.rows))


def forced_order(nacre):
    """The other schemes' balance closes with the square of the step."""
    with tempfile.TemporaryDirectory() as folder:
        prm = Path(folder, "forced.prm")
        prm.write_text(FORCED, encoding="utf-8")
        for scheme in ("newmark", "generalised alpha", "implicit midpoint"):
            gains = []
            for step in (4e-3, 2e-3):
                run = Run(nacre, prm, {"Analysis/Scheme": scheme,
                                       "Discretization/Kinematics": "linear",
                                       "Section/Young's modulus": "1e4",
                                       "Analysis/Time step": step,
                                       "Analysis/End time": "0.2"}).good()
                gains.append(run.largest("gain") / largest_energy(run))
            check(f"{scheme}: gain / largest", gains[1], 1e-12, 1e-4)
            check(f"{scheme}: order", math.log2(gains[0] / gains[1]), 1.8, 9)


def main():
    nacre, name = os.path.abspath(sys.argv[1]), sys.argv[2]
    globals()[name](nacre)
    return 1 if FAILURES else 0


if __name__ == "__main__":
    sys.exit(main())
