#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Paths whose cuts grow go on from an earlier checkpoint, as after a kill:
their tables and last checkpoints are those of the run, bit for bit.

  interrupt_growth.py NACRE CASE    run a case
  interrupt_growth.py --list        their names

A case has a parameter file, parameters to set, the step to go on from, and
what is done besides.
"""
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
sys.path.insert(0, str(HERE.parent / "runs"))
sys.path.insert(0, str(HERE))
import run_study  # noqa: E402  (found by the lines above)
from grow_cuts import PRM, PULLED, check_near  # noqa: E402
from runs import Folder, check  # noqa: E402

TABLES = ("case_path.csv", "case_growth.csv")


def names(settings):
    """Section/Parameter as a Folder takes them."""
    return {name.replace("/", "__").replace(" ", "_"): value
            for name, value in settings.items()}


def results(folder):
    """The tables, and all bits of the last checkpoint."""
    found = {name: folder.read(name) for name in TABLES}
    slot = folder.read("case.checkpoint").split()[0]
    found["state"] = folder.contents()[f"case.checkpoint.{slot}.0"]
    return found


def go_back(folder, step):
    """To the checkpoint before the last one, which is in the other slot."""
    record = folder.path / "output" / "case.checkpoint"
    slot = 1 - int(record.read_text().split()[0])
    record.write_text(f"{slot} {step} 1\n")


def on_two_ranks(folder, prm, settings, step):
    """The rest there."""
    expected = [folder.rows(name) for name in TABLES]
    go_back(folder, step)
    folder.ranks = 2
    folder.succeed(prm, "--restart", **settings)
    for name, rows in zip(TABLES, expected):
        found = folder.rows(name)
        check(len(found) == len(rows), f"{name}: {len(found)} rows")
        for row, other in zip(rows, found):
            for column in sorted(set(row) - {"iterations", "residual"}):
                check_near(f"{name}, {column}", float(other[column]),
                           float(row[column]), 1e-9)


def refused(folder, prm, settings, _step):
    """Another growth, and another file of the cut."""
    folder.fail(prm, "--restart", "--check", **settings, Growth__Step="0.1",
                expect=("--restart", "of another problem", "Growth/Step"))
    folder.write("crack.txt", CRACK.replace("-0.1", "-0.2"))
    folder.fail(prm, "--restart", "--check", **settings,
                expect=("--restart", "'crack' began with other points"))


CRACK = "-0.1 0\n0.15 0\n"
FLYING, SNAP_BACK, METAL = (
    str(HERE / f"{name}.prm")
    for name in ("flying_plate", "snap_back", "plastic_strip"))
CASES = {
    "resumed_motion": (FLYING, {"Mid-surface/Subdivisions": "5, 3",
                                "Analysis/End time": "0.28"}, 4, on_two_ranks),
    "resumed_curve": (SNAP_BACK, {"Cuts/Cuts": "crack: file crack.txt",
                                  "Mid-surface/Subdivisions": "8, 7"}, 2,
                      refused),
    "resumed_metal": (METAL, {"Analysis/End time": "4",
                              "Mid-surface/Subdivisions": "5, 3"}, 3, None),
    "resumed_starts": (str(PRM / "starting_cracks.prm"), PULLED, 1, None),
}


def run_case(nacre, prm, parameters, step, more):
    settings = names({"Study/Write VTU": "false", "Study/Name": "case",
                      "Analysis/Checkpoint steps": str(step), **parameters})
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(os.path.abspath(nacre), 1, pathlib.Path(path))
        folder.write("crack.txt", CRACK)
        folder.succeed(prm, **settings)
        whole = results(folder)
        go_back(folder, step)
        folder.succeed(prm, "--restart", **settings)
        for name, value in results(folder).items():
            check(value == whole[name], f"{name}: {value} is not {whole[name]}")
        if more:
            more(folder, prm, settings, step)


if __name__ == "__main__":
    sys.exit(run_study.run_cases(CASES, run_case, __doc__))
