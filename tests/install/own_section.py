#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Install a build, build a project of its own against it, and run both.

  own_section.py CMAKE BUILD_FOLDER PROJECT_FOLDER [argument of cmake]...

All in a temporary folder; the build must be complete.
"""

import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import run_study  # noqa: E402  (found by the line above)

EXPECTATIONS = [
    "degree == 2 and last: abs(ratio - 1) <= 1e-2",
    "degree == 3 and last: abs(ratio - 1) <= 1e-5",
    "degree == 4 and last: abs(ratio - 1) <= 1e-7",
]


def run(*command, folder):
    """Run a command; what it prints is shown if it fails."""
    print("$ " + " ".join(map(str, command)), flush=True)
    done = subprocess.run(
        list(map(str, command)), cwd=folder, text=True, errors="replace",
        env=dict(os.environ, OMP_NUM_THREADS="1"),
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if done.returncode != 0:
        print(done.stdout)
        raise run_study.Failure(f"{command[0]}: exit code {done.returncode}")
    return done.stdout


def check_program(prefix, folder):
    """The installed program and parameter files."""
    nacre = prefix / "bin" / "nacre"
    version = run(nacre, "--version", folder=folder)
    if not version.startswith("nacre "):
        raise run_study.Failure(f"nacre --version: {version}")
    prm = prefix / "share" / "nacre" / "prm" / "benchmarks" / "scordelis_lo.prm"
    run(nacre, prm, "--set", "Study/Degrees=2", "--set", "Study/Refinements=0",
        folder=folder)


def check_project(cmake, project, prefix, arguments, folder):
    """The project: find_package(nacre), a section of its own, its numbers."""
    build = folder / "build"
    run(cmake, "-S", project, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}",
        *arguments, folder=folder)
    run(cmake, "--build", build, folder=folder)
    programs = [path for path in build.glob("**/own_section") if path.is_file()]
    print(run(programs[0], project / "plate.prm", "Study/Write VTU=false",
              folder=folder))
    rows = run_study.read_table(folder / "output" / "plate.csv")
    results = [run_study.Expectation(text).holds(rows) for text in EXPECTATIONS]
    return all(results)


def main():
    cmake, build, project = sys.argv[1:4]
    try:
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(temporary)
            prefix = folder / "prefix"
            run(cmake, "--install", build, "--prefix", prefix, folder=folder)
            check_program(prefix, folder)
            good = check_project(cmake, pathlib.Path(project), prefix,
                                 sys.argv[4:], folder)
    except run_study.Failure as failure:
        print(f"FAILED: {failure}")
        return 1
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
