#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""The quick form of benchmarks/run: files appear, their numbers make sense.

  harness.py NACRE PROJECT

No time is judged. Also: the decks of CalculiX, which needn't be installed, and
the grammar of the job for Slurm.
"""
import csv
import pathlib
import re
import subprocess
import sys
import tempfile

FILES = ("peers_meshes", "peers", "assembly", "direct", "multigrid",
         "multigrid_iterations", "multigrid_others", "scaling", "nonlinear",
         "eigenvalues")


def rows(file):
    with open(file, encoding="utf-8") as lines:
        return list(csv.DictReader(lines))


def check(good, text):
    if not good:
        sys.exit(text)


def check_results(folder):
    for name in FILES:
        found = rows(folder / f"{name}.csv")
        check(found, f"{name}.csv is empty")
        text = (folder / f"{name}.md").read_text()
        check("quick form" in text and "benchmarks/run --only" in text,
              f"{name}.md doesn't say where it comes from")
        for row in found:
            for key, value in row.items():
                # "wall s" is a difference
                if key != "wall s" and value not in ("", "-") and \
                        key.endswith((" s", "_s", "cell")):
                    check(float(value) > 0., f"{name}: {key} = {value}")
    check((folder / "peers.png").stat().st_size > 1000, "no plot")
    meshes = [row for row in rows(folder / "peers_meshes.csv")
              if row["series"] == "p = 3, direct"]
    # Values of the roof, p = 3: tests/benchmarks
    check([int(float(row["dofs"])) for row in meshes] == [507, 1875],
          f"meshes: {meshes}")
    check(all(float(row["error"]) < 1e-4 for row in meshes),
          f"errors: {meshes}")
    # The last mesh of each series is within 1 % of a plate's three values
    last = {row["series"]: row for row in rows(folder / "eigenvalues.csv")}
    for row in last.values():
        check(float(row["deviation, %"]) < (10. if "CalculiX" in row["series"]
                                            else 1.), f"eigenvalues: {row}")
    text = (folder / "adaptive" / "hemisphere.md").read_text()
    check("dofs, global" in text, "adaptive: no table")
    ranks = [int(row["ranks"]) for row in rows(folder / "scaling.csv")]
    check(set(ranks) == {1, 2}, f"ranks: {ranks}")


def check_decks(project):
    sys.path.insert(0, str(project / "benchmarks" / "harness"))
    import calculix
    for name, problem in calculix.PROBLEMS.items():
        prm = (project / "prm" / "benchmarks" / f"{name}.prm").read_text()
        reference = float(re.search(r"w = .*?-> *([-+.0-9e]+)", prm)[1])
        check(abs(problem["reference"] / reference - 1.) < 1e-12,
              f"{name}: the reference {problem['reference']} isn't the "
              f".prm's {reference}")
        text = calculix.deck(problem, 4, "S8R")
        nodes = text.split("*ELEMENT")[0].count("\n") - 1
        cells = text.split("*ELEMENT")[1].split("*")[0].count("\n") - 1
        check((nodes, cells) == (65, 16), f"{name}: {nodes} nodes, {cells}")
    if calculix.find_calculix() is None:
        print("CalculiX isn't installed: decks not run")
        return
    ccx = calculix.CalculiX(calculix.find_calculix(), 1)
    # To 1 % with 8 x 8 cells: the supports are those of the benchmark.
    for name in ("scordelis_lo", "hemisphere_hole"):
        error = ccx.row(name, 8, "S8R")["error"]
        check(error < 0.01, f"{name}: CalculiX is off by {error}")


def main():
    nacre, project = sys.argv[1], pathlib.Path(sys.argv[2])
    run = project / "benchmarks" / "run"
    with tempfile.TemporaryDirectory() as folder:
        command = [run, "--quick", "--nacre", nacre, "--output", folder,
                   "--only", "peers,assembly,direct", "--only",
                   "multigrid,scaling,adaptive,nonlinear,eigenvalues"]
        done = subprocess.run(command, capture_output=True, text=True,
                              check=False)
        check(done.returncode == 0, done.stdout + done.stderr)
        check_results(pathlib.Path(folder))
    wrong = subprocess.run([run, "--only", "peers,nothing"],
                           capture_output=True, text=True, check=False)
    check(wrong.returncode != 0 and "'nothing'" in wrong.stderr, wrong.stderr)
    wrong = subprocess.run([run, "--nacre", "/nowhere/nacre"],
                           capture_output=True, text=True, check=False)
    check(wrong.returncode != 0 and "/nowhere/nacre" in wrong.stderr,
          wrong.stderr)
    check_decks(project)
    for script in ("run", "slurm_example.sh"):
        subprocess.run(["bash", "-n", project / "benchmarks" / script],
                       check=True)
    print("the harness runs")


if __name__ == "__main__":
    main()
