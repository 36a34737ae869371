#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Adaptive beside global refinement: dofs and CPU seconds against the error.

  benchmarks/adaptive.py NACRE [-o FOLDER] [--cases NAME,...] [--degrees P,...]
                         [--max-dofs N]

Runs prm/benchmarks/adaptive_CASE.prm twice for each degree, as it is and with
all cells refined, and writes into FOLDER (output/adaptive) the tables of both,
CASE.md with the degrees of freedom and the seconds that each takes to an error
of a quantity, and to an estimated one, and CASE.png. The seconds of an
adaptive mesh are those of all meshes before it
and of all estimates; those of a global one are its own, without an estimate.
Between two meshes, dofs and seconds are interpolated in logarithms, and an
error counts as reached when no finer mesh exceeds it again.
"""

import argparse
import csv
import math
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Quantity with a reference, error levels, and those of the estimated energy
# norm relative to (2 U)^1/2 where that is what the meshes are refined for.
CASES = {"l_plate": ("U", (1e-2, 1e-3, 1e-4, 1e-5),
                     (1.5e-1, 5e-2, 2e-2, 1e-2)),
         "pinched_cylinder": ("w", (2e-2, 1e-2, 1e-3, 1e-4), ()),
         "hemisphere": ("w", (5e-3, 1e-3, 1e-4, 2e-5), ())}
GLOBAL = ["Adaptive refinement/Marking=fixed fraction",
          "Adaptive refinement/Fraction=1"]
COLOURS = {2: "#0072b2", 3: "#d55e00", 4: "#009e73", 5: "#cc79a7"}


def run(nacre, folder, case, degree, everywhere, max_dofs):
    """Rows (dofs, seconds, error, estimated energy norm) of one run."""
    name = f"{case}_p{degree}_{'global' if everywhere else 'adaptive'}"
    command = [nacre, str(ROOT / f"prm/benchmarks/adaptive_{case}.prm"),
               "--quiet"]
    settings = GLOBAL if everywhere else []
    if everywhere or max_dofs:
        settings = settings + ["Adaptive refinement/Max dofs="
                               f"{max_dofs or 25000}"]
    for override in [f"Study/Name={name}", f"Study/Output folder={folder}",
                     f"Study/Degrees={degree}",
                     "Study/Write VTU=false"] + settings:
        command += ["--set", override]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    for suffix in ("txt", "tex", "used.prm"):  # the .csv holds it all
        pathlib.Path(folder, f"{name}.{suffix}").unlink()
    rows, before = [], 0.
    with open(pathlib.Path(folder, name + ".csv"), newline="",
              encoding="utf-8") as file:
        for row in csv.DictReader(file):
            own = sum(float(row[c])
                      for c in ("setup_s", "assembly_s", "solve_s"))
            if not everywhere:
                own += float(row["estimate_s"])
            rows.append((int(row["dofs"]), before + own,
                         abs(float(row["ratio"]) - 1.),
                         abs(float(row["estimate"]))
                         / math.sqrt(2. * float(row["U"]))))
            if not everywhere:
                before += own
    return rows


def reach(rows, level, e):
    """(dofs, seconds) that the error `level` in column `e` takes, or None."""
    above = [k for k, row in enumerate(rows) if row[e] > level]
    if not above:
        return rows[0][:2]
    k = above[-1]
    if k + 1 == len(rows):
        return None
    share = (math.log(rows[k][e] / level)
             / math.log(rows[k][e] / max(rows[k + 1][e], 1e-300)))
    return tuple(rows[k][c] * (rows[k + 1][c] / rows[k][c]) ** share
                 for c in (0, 1))


def table(title, levels, results, e):
    """Lines of a table of markdown for the errors in column `e`."""
    lines = [f"| p | {title} | dofs, global | adaptive | ratio |"
             " CPU s, global | adaptive |", "|---|---|---|---|---|---|---|"]
    for degree, (everywhere, adaptive) in results.items():
        for level in levels:
            g, a = reach(everywhere, level, e), reach(adaptive, level, e)
            if g is None and a is None:
                continue
            most = (everywhere[-1], adaptive[-1])
            cells = [str(degree), f"{100 * level:g} %",
                     f"{g[0]:.0f}" if g else f"> {most[0][0]}",
                     f"{a[0]:.0f}" if a else f"> {most[1][0]}",
                     f"{g[0] / a[0]:.1f}" if g and a else
                     f"> {most[0][0] / a[0]:.0f}" if a else
                     f"< {g[0] / most[1][0]:.1f}",
                     f"{g[1]:.2f}" if g else f"> {most[0][1]:.1f}",
                     f"{a[1]:.2f}" if a else f"> {most[1][1]:.1f}"]
            lines.append("| " + " | ".join(cells) + " |")
    return lines


def write_markdown(path, case, results):
    quantity, levels, estimates = CASES[case]
    lines = table(f"error of {quantity}", levels, results, 2)
    if estimates:
        lines += [""] + table("energy norm", estimates, results, 3)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"{path}\n" + "\n".join(lines), flush=True)


def plot(path, quantity, results):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, 2, figsize=(9., 3.6), sharey=True)
    for degree, pair in results.items():
        for rows, style, text in zip(pair, ("--", "-"), ("global", "adaptive")):
            for column, panel in enumerate(axes):
                panel.loglog([row[column] for row in rows],
                             [row[2] for row in rows], style, marker="o",
                             markersize=3, linewidth=1.2,
                             color=COLOURS.get(degree, "black"),
                             label=f"p = {degree}, {text}")
    axes[0].set_xlabel("degrees of freedom", fontsize=9)
    axes[1].set_xlabel("CPU seconds, all meshes before included", fontsize=9)
    axes[0].set_ylabel(f"|{quantity}/reference - 1|", fontsize=9)
    axes[0].legend(fontsize=7, frameon=False)
    for panel in axes:
        panel.grid(which="major", color="0.85", linewidth=0.6)
        panel.tick_params(which="both", labelsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=100)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("nacre")
    parser.add_argument("-o", "--output", default="output/adaptive")
    parser.add_argument("--cases", default=",".join(CASES))
    parser.add_argument("--degrees", default="2,3,4")
    parser.add_argument("--max-dofs", type=int, metavar="N",
                        help="end there; default: what the .prm says, and "
                        "25000 with all cells refined")
    arguments = parser.parse_args()
    folder = pathlib.Path(arguments.output)
    folder.mkdir(parents=True, exist_ok=True)
    for case in arguments.cases.split(","):
        if case not in CASES:
            parser.error(f"--cases: '{case}' is none of " + ", ".join(CASES))
        results = {degree: [run(os.path.abspath(arguments.nacre), folder, case,
                                degree, everywhere,
                                arguments.max_dofs)
                            for everywhere in (True, False)]
                   for degree in map(int, arguments.degrees.split(","))}
        write_markdown(folder / f"{case}.md", case, results)
        plot(folder / f"{case}.png", CASES[case][0], results)


if __name__ == "__main__":
    main()
