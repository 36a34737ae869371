#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Kill a run with SIGKILL at random moments and restart it until it ends: its
results are those of a run that was left alone, bit for bit on one rank.

  restart.py NACRE [--ranks N]
  restart.py NACRE --change-ranks

Also: a path that can't go on leaves its last good state, and says why.
With --change-ranks, runs are stopped halfway and go on on another number of
ranks, with quadrilaterals and with triangles.
"""
import argparse
import csv
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

PRM = """\
set Constants = L = 10, b = 1
subsection Study
  set Degrees        = 2
  set Refinements    = 0
  set Report seconds = false
end
subsection Mid-surface
  set Surface      = plate
  set Subdivisions = 16, 2
  subsection plate
    set Size = L, b
  end
end
subsection Section
  set Young's modulus = 1.2e6
  set Poisson's ratio = 0.3
  set Thickness       = 0.1
  set Density         = 1
end
subsection Discretization
  set Kinematics = corotational
end
subsection Boundary conditions
  set Edges = u=0: clamped
end
subsection Loads
  set Edge forces = u=1: 0, 0, 2*sin(3*t)
end
subsection Analysis
  set Type             = dynamic
  set End time         = 2
  set Time step        = 0.02
  set Checkpoint steps = 3
  set VTU steps        = 5
end
subsection Quantities
  set Quantities = w = displacement z at (L, b/2, 0); E = total energy
end
"""


def command(arguments, folder, *more, ranks=None):
    ranks = ranks or arguments.ranks
    start = (["mpirun", "--oversubscribe", "-np", str(ranks)]
             if ranks > 1 else [])
    return start + [arguments.nacre, str(folder / "run.prm"), "--set",
                    f"Study/Output folder={folder / 'out'}", *more]


def rows(file):
    with open(file, encoding="utf-8") as lines:
        return list(csv.reader(lines))


def run(arguments, folder, *more, ranks=None):
    done = subprocess.run(command(arguments, folder, *more, ranks=ranks),
                          text=True, capture_output=True, timeout=250,
                          check=False)
    return done.returncode, done.stdout + done.stderr


def saved_step(folder):
    """The step of the last checkpoint."""
    try:
        return int((folder / "out" / "run.checkpoint").read_text().split()[1])
    except FileNotFoundError:
        return 0


def state_bytes(folder):
    """What the last checkpoint holds for the first rank."""
    slot = (folder / "out" / "run.checkpoint").read_text().split()[0]
    return (folder / "out" / f"run.checkpoint.{slot}.0").read_bytes()


def wait_for_step(process, folder, step):
    """Whether the run reaches the step before it ends."""
    file = folder / "out" / "run_path.csv"
    while process.poll() is None:
        if file.exists() and len(file.read_text().splitlines()) >= step + 2:
            return True
        time.sleep(0.002)
    return False


def kill_and_restart(arguments, folder, n_kills):
    """Run to the end through kills; returns how many hit a run."""
    generator = random.Random(31)
    hits = 0
    for k in range(n_kills + 1):
        start = saved_step(folder)
        process = subprocess.Popen(
            command(arguments, folder, *(["--restart"] if start > 0 else [])),
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
            start_new_session=True)
        if k < n_kills and wait_for_step(process, folder,
                                         start + generator.randint(1, 8)):
            # At any moment of a step, or of writing.
            time.sleep(generator.uniform(0., 0.05))
            # All of it: mpirun and its ranks.
            subprocess.run(["pkill", "-KILL", "-s", str(process.pid)],
                           check=False)
            process.kill()
            hits += 1
        errors = process.communicate(timeout=250)[1]
        if k == n_kills and process.returncode != 0:
            sys.exit(f"the last restart failed: {errors}")
    return hits


def compare(found, expected, tolerance):
    if len(found) != len(expected):
        sys.exit(f"{len(found)} rows instead of {len(expected)}")
    for a, b in zip(found, expected):
        if a == b:
            continue
        if tolerance == 0. or a[:2] != b[:2]:
            sys.exit(f"the row {a} should be {b}")
        # Iterations and residuals depend on round-off.
        for x, y in zip(a[6:], b[6:]):
            if abs(float(x) - float(y)) > tolerance * max(1., abs(float(y))):
                sys.exit(f"the row {a} should be {b}")


def check_failing_path(arguments, folder):
    """A limit point in statics: the last state is kept."""
    (folder / "run.prm").write_text(PRM)
    code, text = run(arguments, folder, "--set", "Analysis/Type=static",
                     "--set", "Analysis/Load factor=1e6*t",
                     "--set", "Analysis/Maximum iterations=3",
                     "--set", "Analysis/Minimum time step=0.005")
    if code == 0 or "The last good state" not in text or "Try" not in text:
        sys.exit(f"a failing path: code {code}, said {text}")
    step = int(rows(folder / "out" / "run_path.csv")[-1][0])
    if not (folder / "out" / f"run_{step}.vtu").exists() and \
       not (folder / "out" / f"run_{step}.pvtu").exists():
        sys.exit(f"the fields of the last good step {step} are missing")


def must_run(arguments, folder, *more, ranks=None):
    code, text = run(arguments, folder, *more, ranks=ranks)
    if code != 0:
        sys.exit(f"exit code {code}: {text}")


def listed_fields(out):
    """The files of fields in the list of all steps."""
    if (out / "run.xdmf").exists():
        text = (out / "run.xdmf").read_text()
        return sorted(set(re.findall(r"(\S+\.h5):/nodes", text)))
    return re.findall('file="([^"]*)"', (out / "run.pvd").read_text())


def check_change_of_ranks(arguments, folder, element, field_format, changes):
    """Halfway on some ranks, the rest on others, as if nothing had happened."""
    (folder / "run.prm").write_text(PRM)
    short = ("--set", "Analysis/End time=0.16",
             "--set", f"Discretization/Element={element}",
             "--set", f"Study/Output format={field_format}")
    half = short + ("--set", "Analysis/End time=0.08")
    must_run(arguments, folder, *short, ranks=1)
    expected = rows(folder / "out" / "run_path.csv")
    for first, second in changes:
        must_run(arguments, folder, *half, ranks=first)
        must_run(arguments, folder, *short, "--restart", ranks=second)
        compare(rows(folder / "out" / "run_path.csv"), expected, 1e-8)
        out = folder / "out"
        record = (out / "run.checkpoint").read_text().split()
        left = len(list(out.glob(f"run.checkpoint.{record[0]}.*")))
        if int(record[2]) != second or left != second:
            sys.exit(f"{element}, {first} to {second} ranks: {left} files, "
                     f"record {record}")
        listed = listed_fields(out)
        missing = [file for file in listed if not (out / file).exists()]
        if len(listed) != 4 or missing:
            sys.exit(f"listed are {listed}; not there: {missing}")


def check_refusals(arguments, folder):
    """A file that is gone."""
    (folder / "run.prm").write_text(PRM)
    short = ("--set", "Analysis/End time=0.06")
    must_run(arguments, folder, *short, ranks=2)
    slot = (folder / "out" / "run.checkpoint").read_text().split()[0]
    (folder / "out" / f"run.checkpoint.{slot}.0").unlink()
    code, text = run(arguments, folder, *short, "--restart", ranks=2)
    if code == 0 or f"run.checkpoint.{slot}.0' can't be read" not in text:
        sys.exit(f"a restart without a file: code {code}, said {text}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("nacre")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--change-ranks", action="store_true")
    arguments = parser.parse_args()
    if arguments.change_ranks:
        with tempfile.TemporaryDirectory() as name:
            for element, field_format, changes in (
                    ("Lagrange", "vtu", ((3, 1), (2, 3))),
                    ("triangle", "hdf5", ((3, 2),))):
                folder = pathlib.Path(name, element)
                folder.mkdir()
                check_change_of_ranks(arguments, folder, element,
                                      field_format, changes)
            check_refusals(arguments, folder)
        print("the same path on changing numbers of ranks")
        return
    with tempfile.TemporaryDirectory() as name:
        alone, killed = (pathlib.Path(name, run) for run in ("alone", "killed"))
        failing = pathlib.Path(name, "failing")
        # A step on several ranks takes ten times as long, as a start does.
        prm = PRM if arguments.ranks == 1 else PRM.replace("= 2\n  set Time",
                                                           "= 0.8\n  set Time")
        for folder in (alone, killed, failing):
            folder.mkdir()
            (folder / "run.prm").write_text(prm)
        code, text = run(arguments, alone)
        if code != 0:
            sys.exit(text)
        n_kills = 10 if arguments.ranks == 1 else 4
        hits = kill_and_restart(arguments, killed, n_kills)
        if hits < n_kills:
            sys.exit(f"only {hits} kills hit a running program")
        tolerance = 0. if arguments.ranks == 1 else 1e-6
        compare(rows(killed / "out" / "run_path.csv"),
                rows(alone / "out" / "run_path.csv"), tolerance)
        # All 64 bits of displacements, velocities and accelerations.
        states = [state_bytes(folder) for folder in (alone, killed)]
        if arguments.ranks == 1 and states[0] != states[1]:
            sys.exit("the last checkpoints differ")
        records = [[line for line in
                    (folder / "out" / "run.pvd").read_text().splitlines()
                    if "DataSet" in line] for folder in (alone, killed)]
        if records[0] != records[1]:
            sys.exit(f"the .pvd lists other files after restarts: {records}")
        check_failing_path(arguments, failing)
        print(f"{hits} kills, the same results")


if __name__ == "__main__":
    main()
