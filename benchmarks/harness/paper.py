# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""10^9 dofs on paper: measured constants of one rank, counted surfaces."""

import csv
import math

# Assumed of a cluster's network: seconds a message, bytes a second.
LATENCY, BANDWIDTH = 2e-6, 1e10
DEGREE = 3
ITERATIONS = 15
COARSE_CELLS = 16
# GB of the program itself: doc/parallel.md
PROGRAM = 0.18


def measured(folder):
    """Seconds per dof of set-up with assembly, and of an iteration; bytes."""
    with open(folder / "multigrid.csv", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file)
                if float(row["p"]) == DEGREE and row["solver"] == "multigrid"]
    row = max(rows, key=lambda row: float(row["dofs"]))
    dofs = float(row["dofs"])
    set_up = (float(row["set-up s"]) + float(row["assembly s"])) / dofs
    return (dofs, set_up, float(row["solve s"]) / dofs,
            1e9 * (float(row["peak GB"]) - PROGRAM) / dofs)


def extrapolate(folder, dofs, ranks, colours=6):
    """One row: a large run by the constants of a small one."""
    _, set_up, solve, memory = measured(folder)
    per_rank = dofs / ranks
    cells = per_rank / (3. * DEGREE ** 2)
    side = math.sqrt(cells)
    # Patches of vertices next to another rank's cells, two rows of them.
    border = min(1., 8. / side)
    levels = 1 + math.ceil(math.log(dofs / (27. * COARSE_CELLS)) / math.log(4))
    ghosts = 4. * side * DEGREE * (DEGREE + 1) * 3.
    # Each level: a turn for each colour and one exchange more, both sweeps,
    # residual; eight neighbours. Coarser levels have half the ghosts each.
    exchanges = 2 * (colours + 1) + 2
    messages = ITERATIONS * exchanges * (8 * levels * LATENCY +
                                         2 * 8. * ghosts / BANDWIDTH)
    sums = ITERATIONS * 3 * 2 * math.log2(max(ranks, 2)) * LATENCY
    waiting = solve * per_rank * border * (min(colours, ranks) - 1)
    total = (set_up + solve) * per_rank + waiting + messages + sums
    return {"dofs": dofs, "ranks": float(ranks), "dofs a rank": per_rank,
            "GB a rank": PROGRAM + memory * per_rank / 1e9,
            "set-up and assembly s": set_up * per_rank,
            "solve s": solve * per_rank, "turns of colours s": waiting,
            "messages s": messages + sums, "sum s": total,
            "efficiency": (set_up + solve) * per_rank / total}


def table(folder):
    return [extrapolate(folder, dofs, ranks)
            for dofs, ranks in ((1e6, 1), (1e7, 32), (1e8, 512), (1e9, 1024),
                                (1e9, 4096), (1e9, 16384))]
