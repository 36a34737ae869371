# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Programs run and measured."""

import csv
import os
import pathlib
import resource
import shutil
import subprocess
import tempfile
import time

PROJECT = pathlib.Path(__file__).resolve().parents[2]


class RunError(Exception):
    """A program failed; the text says how."""


def reason(failure):
    """The line of a failed program that says why."""
    lines = [line.strip() for line in str(failure).splitlines()
             if line.strip()]
    errors = [line for line in lines if "error" in line.lower()]
    return (errors or lines)[-1][:60]


class Measurement:
    """Wall and CPU seconds of a program and its children."""

    def __init__(self, wall, cpu, output):
        self.wall = wall
        self.cpu = cpu
        self.output = output


def measure(command, folder, timeout=3600):
    """Run a program to its end; RunError if it fails."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    done = subprocess.run([str(word) for word in command], cwd=folder,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, errors="replace", timeout=timeout,
                          check=False, stdin=subprocess.DEVNULL)
    wall = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise RunError(f"{' '.join(str(word) for word in command)}: exit code "
                       f"{done.returncode}\n{done.stdout[-2000:]}")
    return Measurement(wall, after.ru_utime + after.ru_stime -
                       before.ru_utime - before.ru_stime, done.stdout)


class Nacre:
    """The program that is measured."""

    def __init__(self, program):
        self.program = pathlib.Path(program).resolve()
        if not self.program.is_file():
            raise RunError(f"'{program}' is not there: build it by "
                           "scripts/configure && cmake --build --preset "
                           "release, or name another one by --nacre")
        self.template = subprocess.run(
            [str(self.program), "--template"], capture_output=True, text=True,
            check=True).stdout
        self.version = subprocess.run(
            [str(self.program), "--version"], capture_output=True, text=True,
            check=True).stdout.strip()
        # Multigrid shows a number of iterations; without the section the
        # direct solver is the only one.
        self.has_solvers = "subsection Linear solver" in self.template

    def solver_setting(self, solver):
        return {"Linear solver/Solver": solver} if self.has_solvers else {}

    def run(self, prm, settings, ranks=1, timeout=3600):
        """(rows of the table, measurement); numbers where they are."""
        with tempfile.TemporaryDirectory() as folder:
            command = [self.program, PROJECT / "prm" / prm, "--quiet"]
            if ranks > 1:
                command = ["mpirun", "--oversubscribe", "-np",
                           ranks] + command
            everywhere = {"Study/Output folder": folder, "Study/Name": "run",
                          "Study/Write VTU": "false"}
            for key, value in {**everywhere, **settings}.items():
                command += ["--set", f"{key}={value}"]
            measurement = measure(command, folder, timeout)
            with open(pathlib.Path(folder, "run.csv"),
                      encoding="utf-8") as file:
                rows = [{key: number(value) for key, value in row.items()}
                        for row in csv.DictReader(file)]
        return rows, measurement

    def best(self, prm, settings, repeat, ranks=1):
        """Each row with the least seconds of several runs; the least wall."""
        best_rows, best_wall = None, None
        for _ in range(repeat):
            rows, measurement = self.run(prm, settings, ranks)
            if best_rows is None:
                best_rows, best_wall = rows, measurement.wall
            best_wall = min(best_wall, measurement.wall)
            best_rows = [a if seconds(a) <= seconds(b) else b
                         for a, b in zip(best_rows, rows)]
        return best_rows, best_wall


def seconds(row):
    """CPU seconds of a row: data structures, assembly and solve."""
    return row["setup_s"] + row["assembly_s"] + row["solve_s"]


def number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return text


def build_empty_program(folder):
    """The path of the program that starts deal.II and ends."""
    for command in (["cmake", "-S", PROJECT / "benchmarks" / "empty_program",
                     "-B", folder], ["cmake", "--build", folder]):
        measure(command, folder)
    return pathlib.Path(folder, "empty_program")


def find_calculix():
    """CalculiX' program, or None where it isn't installed."""
    return shutil.which("ccx")


def processor():
    """Name and frequency of the processor, and how many cores."""
    name, frequency = "unknown processor", ""
    try:
        for line in open("/proc/cpuinfo", encoding="utf-8"):
            key, _, value = line.partition(":")
            if key.strip() == "model name":
                name = value.strip()
            if key.strip() == "cpu MHz":
                frequency = f", {float(value) / 1000:.1f} GHz"
    except OSError:
        pass
    return f"{name}{frequency}, {os.cpu_count()} cores"
