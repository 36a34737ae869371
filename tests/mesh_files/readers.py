#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Mesh files as people bring them give the displacement of the plain file, and
a note for each thing that is left out; others are refused with the remedy.

  readers.py NACRE N_RANKS [CASE ...]
"""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import readers_cases  # noqa: E402  (found in the folder of this file)
import run_study  # noqa: E402  (found by the line above)

TOLERANCE = 1e-10
PRM = """\
subsection Mid-surface
  set Surface = file
  subsection file
    set File name = {mesh}
  end
end
subsection Boundary conditions
  set Edges = {edges}: clamped
end
subsection Loads
  set Force per area = 0, 0, -1e-6
end
subsection Quantities
  set Quantities = w = displacement z at ({length}, 0, 0)
end
"""


class Failure(Exception):
    """What is wrong, in a line."""


def check(condition, text):
    if not condition:
        raise Failure(text)


class Nacre:
    def __init__(self, program, n_ranks):
        self.program = os.path.abspath(program)
        self.n_ranks = n_ranks

    def run(self, case):
        """Exit code, output and the last row of the table."""
        with tempfile.TemporaryDirectory(prefix="nacre_") as name:
            folder = pathlib.Path(name)
            for path, content in case["files"].items():
                (folder / path).parent.mkdir(exist_ok=True)
                (folder / path).write_bytes(
                    content if isinstance(content, bytes) else content.encode())
            settings = dict(case["settings"])
            length = 3 if settings.pop("three", False) else 2
            prm = PRM.format(mesh=next(iter(case["files"])),
                             edges=case["edges"], length=length)
            if "byte order mark" in case:
                prm = "\ufeff" + prm.replace("\n", "\r\n")
            (folder / "case.prm").write_bytes(
                prm.encode(case.get("encoding", "utf-8")))
            code, output = self.call(folder, settings)
            table = folder / "output" / "case.csv"
            rows = []
            if table.exists():
                with open(table, newline="", encoding="utf-8") as file:
                    rows = list(csv.DictReader(file))
        return code, output, rows

    def call(self, folder, settings):
        command = [self.program, "case.prm"]
        for path, value in settings.items():
            command += ["--set", f"{path}={value}"]
        environment = dict(os.environ, OMP_NUM_THREADS="1",
                           OMPI_ALLOW_RUN_AS_ROOT="1",
                           OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        if self.n_ranks > 1:
            command = ["mpirun", "--oversubscribe", "-np", str(self.n_ranks),
                       *command]
        else:
            environment.update(run_study.start_alone(folder))
        done = subprocess.run(command, cwd=folder, env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              stdin=subprocess.DEVNULL, errors="replace",
                              timeout=60)
        return done.returncode, done.stdout


def notes_of(output):
    """The notes; a note may go on in indented lines."""
    notes = []
    for line in output.splitlines():
        if line.startswith("nacre: note:"):
            notes.append(line)
        elif notes and line.startswith("  "):
            notes[-1] += " " + line.strip()
    return notes


class Reference:
    """Displacements of the plain mesh, by cells along x and element."""

    def __init__(self, nacre):
        self.nacre, self.values = nacre, {}

    def value(self, case):
        key = (case["settings"].get("three", False),
               case["settings"].get("Discretization/Element", ""))
        if key not in self.values:
            name = "triangles" if key[1] else "plain"
            plain = dict(readers_cases.GOOD[name])
            if key[0]:
                cells = "2, 2, 3, 6, 5\n"
                more = "3, 3, 7, 8, 6\n*NODE\n7, 3, 0, 0\n8, 3, 1, 0\n"
                text = plain["files"]["mesh.inp"]
                plain["files"] = {"mesh.inp": text.replace(cells,
                                                           cells + more)}
                plain["settings"] = {"three": True}
            code, output, rows = self.nacre.run(plain)
            check(code == 0, f"the plain mesh: {output}")
            self.values[key] = float(rows[-1]["w"])
        return self.values[key]


def run_good(nacre, reference, case):
    code, output, rows = nacre.run(case)
    check(code == 0, f"exit code {code}: {output}")
    value, expected = float(rows[-1]["w"]), reference.value(case)
    check(abs(value / expected - 1) <= TOLERANCE,
          f"w = {value}, expected {expected}")
    notes = notes_of(output)
    check(len(notes) == len(case["notes"]),
          f"{len(notes)} notes instead of {len(case['notes'])}: {notes}")
    for words in case["notes"]:
        check(any(all(word in note for word in words) for note in notes),
              f"no note with {words}: {notes}")


def run_bad(nacre, _, case):
    code, output, rows = nacre.run(case)
    text = " ".join(output.split())
    check(code == 1, f"exit code {code}: {text}")
    check(text.count("nacre: error:") == 1, f"not one message: {text}")
    check(not rows, "there are results")
    for words in case["expect"]:
        check(words in text, f"{words!r} is not in: {text}")


def parameter_files():
    """Parameter files of editors that mark or encode them."""
    plain = readers_cases.GOOD["plain"]
    readers_cases.GOOD["parameters_with_mark"] = dict(
        plain, ranks=(1, 2)) | {"byte order mark": True}
    readers_cases.BAD["parameters_in_utf_16"] = dict(
        plain, ranks=(1, 2), encoding="utf-16", expect=("UTF-16", "case.prm"))


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    nacre, names = Nacre(sys.argv[1], int(sys.argv[2])), sys.argv[3:]
    parameter_files()
    reference = Reference(nacre)
    n_run = n_failed = 0
    for run, cases in ((run_good, readers_cases.GOOD),
                       (run_bad, readers_cases.BAD)):
        for name, case in cases.items():
            if (names and name not in names
                    or nacre.n_ranks not in case["ranks"]):
                continue
            n_run += 1
            try:
                run(nacre, reference, case)
                print(f"passed  {name}", flush=True)
            except (Failure, subprocess.TimeoutExpired) as failure:
                n_failed += 1
                print(f"FAILED  {name}: {failure}", flush=True)
    print(f"{n_run - n_failed} of {n_run} cases passed.")
    return 1 if n_failed or not n_run else 0


if __name__ == "__main__":
    sys.exit(main())
