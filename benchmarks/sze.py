#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""The benchmarks of Sze, Liu and Lo beside their tables, benchmarks/sze/*.csv.

  benchmarks/sze.py [NAME...]            the meshes of prm/benchmarks/sze_*.prm
  benchmarks/sze.py --refine [NAME...]   p = 3, 4, with half the cells and all
  benchmarks/sze.py --picture PATH.png   curves of the last run, tables' dots
  benchmarks/sze.py --test NAME          a coarse mesh, few steps: exit code 1
                                         above the case's tolerance
  benchmarks/sze.py --list               the names

The first two print a table in Markdown: deviations are the largest relative to
the table's value, of all quantities (scripts/compare_path.py), with the load
factor where it is; a second one, relative to the quantity's largest value.

Needs Debian's python3-numpy, pictures python3-matplotlib.
"""

import argparse
import csv
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy

sys.dont_write_bytecode = True
PROJECT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PROJECT / "scripts"))
import compare_path  # noqa: E402  (found by the line above)
import plotting  # noqa: E402

TABLES = PROJECT / "benchmarks/sze"
PRM = PROJECT / "prm/benchmarks"
LAMINATES = ("isotropic", "0_90_0", "90_0_90")
CELLS = "Mid-surface/Subdivisions"
STEP = "Analysis/Time step"


class Case:
    """A curve: its file, its panel in the picture, the cells of the file, and
    what is set in it. `TESTS` adds what a test sets, and its tolerance."""

    def __init__(self, prm, panel, cells, settings=None):
        self.prm = PRM / f"sze_{prm}.prm"
        self.panel = panel
        self.cells = cells
        self.settings = settings or {}


def laminate(lay_up):
    if lay_up == "isotropic":
        return {}
    stack = lay_up.replace("_", "/")
    return {"Section/Type": "laminate",
            "Section/Laminate/Stack": f"[{stack}]"}


THIN = {"Section/Thickness": "6.35", "Section/Laminate/Thickness": "6.35",
        STEP: "0.02", "Analysis/Maximum time step": "0.05"}
CASES = {
    "end_shear": Case("end_shear", "3.1 end shear", (8, 1)),
    "end_moment": Case("end_moment", "3.2 end moment", (8, 1)),
    "slit_annulus": Case("slit_annulus", "3.3 slit annulus", (20, 3)),
    "hemisphere": Case("hemisphere", "3.4 hemisphere", (12, 12)),
    "pullout": Case("pullout", "3.5 pull-out", (12, 8)),
    "pinched_cylinder": Case("pinched_cylinder", "3.6 pinched cylinder",
                             (24, 24)),
    "semicylinder_isotropic": Case(
        "semicylinder", "3.7 semicylinder", (12, 12)),
    **{f"semicylinder_{lay_up}": Case(
        "semicylinder", "3.7 semicylinder", (12, 12),
        {"Study/Degrees": 4, **laminate(lay_up)})
       for lay_up in LAMINATES[1:]},
    **{f"roof_thick_{lay_up}": Case(
        "roof", "3.8 roof, h = 12.7", (8, 8), laminate(lay_up))
       for lay_up in LAMINATES},
    **{f"roof_thin_{lay_up}": Case(
        "roof", "3.8 roof, h = 6.35", (8, 8), {**THIN, **laminate(lay_up)})
       for lay_up in LAMINATES}}
# The largest deviation, relative to the largest values, on a coarse mesh.
TESTS = {
    "end_shear": (0.002, {CELLS: "4, 1", STEP: "0.1"}),
    "end_moment": (0.002, {CELLS: "6, 1"}),
    "slit_annulus": (0.01, {CELLS: "16, 2", STEP: "0.1"}),
    "hemisphere": (0.03, {CELLS: "6, 6", STEP: "0.1"}),
    "pullout": (0.02, {CELLS: "8, 5", STEP: "0.1"}),
    "semicylinder_isotropic": (0.02, {CELLS: "8, 8", STEP: "0.1",
                                      "Analysis/End time": "0.4"}),
    "roof_thick_isotropic": (0.015, {CELLS: "2, 2"}),
    "roof_thick_0_90_0": (0.015, {CELLS: "2, 2"}),
    "roof_thick_90_0_90": (0.015, {CELLS: "2, 2"}),
    "roof_thin_isotropic": (0.02, {CELLS: "2, 2"}),
    "roof_thin_0_90_0": (0.02, {CELLS: "3, 3"}),
    "roof_thin_90_0_90": (0.02, {CELLS: "2, 2"})}


class Run:
    """A path with its mesh and its deviations."""

    def __init__(self, path, study, found):
        self.path = path
        self.study = study
        self.found = found


def run(nacre, name, folder, settings, label=""):
    """Follow the path of a case; plotting.BadFile if it fails."""
    case = CASES[name]
    name_of_files = f"sze_{name}{label}"
    command = [str(nacre), str(case.prm), "--quiet"]
    for key, value in {"Study/Name": name_of_files,
                       "Study/Output folder": folder,
                       "Study/Write VTU": "false",
                       "Analysis/Checkpoint steps": "0", **case.settings,
                       **settings}.items():
        command += ["--set", f"{key}={value}"]
    environment = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1",
                   **os.environ}
    done = subprocess.run(command, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False,
                          env=environment, stdin=subprocess.DEVNULL)
    path_file = pathlib.Path(folder, f"{name_of_files}_path.csv")
    if done.returncode != 0:
        raise plotting.BadFile(
            f"{name}: {' '.join(command)}: exit code {done.returncode}\n"
            f"{done.stdout[-2000:]}")
    path = compare_path.read(path_file)
    with open(path_file.with_name(f"{name_of_files}.csv"), newline="",
              encoding="utf-8") as file:
        study = next(csv.DictReader(file))
    reference = compare_path.read(TABLES / f"{name}.csv")
    return Run(path, study,
               compare_path.compare(path, hit(path, reference)))


def hit(path, reference):
    """Of a path in large steps only the loads that are met; of one in arc
    length all rows."""
    loads = path["load_factor"]
    if not numpy.all(numpy.diff(loads) > 0.):
        return reference
    keep = [numpy.abs(loads - load).min() < 1e-9
            for load in reference["load_factor"]]
    if not any(keep):
        raise plotting.BadFile("the path meets no load of the table")
    return {column: values[keep] for column, values in reference.items()}


def percent(found):
    """The largest deviation of each quantity, and where."""
    return ", ".join(f"{name} {100. * relative:.2f} at {at:g}"
                     for name, relative, at, _, _ in found), \
        ", ".join(f"{100. * total:.2f} at {at:g}" if name != "distance" else "-"
                  for name, _, _, total, at in found)


def print_table(nacre, names, folder):
    print("| curve | cells | p | dofs | steps | iterations | largest deviation,"
          " % of the value | % of the largest value |\n" + "|---" * 8 + "|",
          flush=True)
    for name in names:
        result = run(nacre, name, folder, {})
        print("| " + " | ".join([
            name, result.study["cells"], result.study["degree"],
            result.study["dofs"], str(len(result.path["step"]) - 1),
            f"{result.path['iterations'].sum():.0f}",
            *percent(result.found)]) + " |", flush=True)


def print_refinement(nacre, names, folder):
    """Of the quantity that deviates most, and the values at the last row."""
    print("| curve | p | cells | dofs | deviation, % of the value |"
          " % of the largest value | values at the end |\n" + "|---" * 7 + "|",
          flush=True)
    for name in names:
        for degree in (3, 4):
            for divisor in (2, 1):
                cells = [max(1, n // divisor) for n in CASES[name].cells]
                result = run(
                    nacre, name, folder,
                    {"Study/Degrees": degree,
                     CELLS: ", ".join(str(n) for n in cells)},
                    f"_p{degree}_{cells[0]}")
                reference = compare_path.read(TABLES / f"{name}.csv")
                end = ", ".join(f"{column} {result.path[column][-1]:.5g}"
                                for column in reference
                                if column != "load_factor")
                print("| " + " | ".join(
                    [name, str(degree), " x ".join(str(n) for n in cells),
                     result.study["dofs"], *percent(result.found), end]) + " |",
                      flush=True)


def run_test(nacre, name):
    tolerance, settings = TESTS[name]
    with tempfile.TemporaryDirectory() as folder:
        result = run(nacre, name, folder, settings)
    for column, relative, at, total, total_at in result.found:
        print(f"{column}: {100. * relative:.2f} % of the value at {at:g}, "
              f"{100. * total:.2f} % of the largest at {total_at:g}")
    if max(entry[3] for entry in result.found) > tolerance:
        raise plotting.BadFile(
            f"{name}: above {100. * tolerance:g} %")


def draw(output, folder):
    """Panels of curves and of the tables' values as dots."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    panels = list(dict.fromkeys(case.panel for case in CASES.values()))
    figure, grid = plt.subplots(3, 3, figsize=(10., 8.4))
    for axes, panel in zip(grid.flat, panels):
        for name, case in CASES.items():
            path_file = pathlib.Path(folder, f"sze_{name}_path.csv")
            if case.panel != panel or not path_file.exists():
                continue
            path = compare_path.read(path_file)
            table = compare_path.read(TABLES / f"{name}.csv")
            for column in list(table)[1:]:
                lay_up = name.split("_", 2 if "roof" in name else 1)[-1]
                label = f"[{lay_up.replace('_', '/')}]" if "90" in lay_up \
                    else lay_up if lay_up == "isotropic" else column
                line, = axes.plot(path[column], path["load_factor"],
                                  linewidth=1., label=label)
                axes.plot(table[column], table["load_factor"], "o",
                          markersize=2.6, markerfacecolor="none",
                          markeredgewidth=0.6, color=line.get_color())
        axes.set_title(panel, fontsize=9)
        axes.grid(color="0.88", linewidth=0.5)
        axes.tick_params(labelsize=7)
        axes.legend(fontsize=6.5, frameon=False)
    for axes in grid[-1]:
        axes.set_xlabel("displacement", fontsize=8)
    for axes in grid[:, 0]:
        axes.set_ylabel("load factor", fontsize=8)
    figure.tight_layout()
    figure.savefig(output, dpi=80, metadata={"Software": None})


def main():
    parser = argparse.ArgumentParser(
        prog="benchmarks/sze.py", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME",
                        help="curves; default: all")
    parser.add_argument("--nacre", metavar="PROGRAM", type=pathlib.Path,
                        default=PROJECT / "build/release/nacre")
    parser.add_argument("--folder", default="output", help="of the paths")
    parser.add_argument("--refine", action="store_true")
    parser.add_argument("--picture", metavar="PATH.png")
    parser.add_argument("--test", action="store_true")
    parser.add_argument("--list", action="store_true",
                        help="with --test, those that have a test")
    arguments = parser.parse_args()
    names = arguments.names or list(CASES)
    for name in names:
        if name not in CASES:
            parser.error(f"there is no curve '{name}'; curves: " +
                         ", ".join(CASES))
    if arguments.test:
        names = [name for name in names if name in TESTS]
    try:
        if arguments.list:
            print("\n".join(names))
        elif arguments.picture:
            draw(arguments.picture, arguments.folder)
        elif arguments.test:
            for name in names:
                run_test(arguments.nacre, name)
        elif arguments.refine:
            print_refinement(arguments.nacre, names, arguments.folder)
        else:
            print_table(arguments.nacre, names, arguments.folder)
    except plotting.BadFile as error:
        sys.exit(f"benchmarks/sze.py: {error}")


if __name__ == "__main__":
    main()
