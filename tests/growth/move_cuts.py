#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Let cuts grow in dynamics and check the tables of their growth.

  move_cuts.py NACRE CASE    run a case
  move_cuts.py --list        their names

Cases are those of grow_cuts.py, of the parameter files beside this one; a
table has no rows while lips are being released.
"""
import pathlib
import sys

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
sys.path.insert(0, str(HERE))
import grow_cuts  # noqa: E402  (found by the lines above)
import run_study  # noqa: E402
from grow_cuts import check, check_near  # noqa: E402


def conserved(rows):
    """Nothing but the release changes momenta and energy."""
    first, last = rows[0], rows[-1]
    check(last["step"] == 4, "the plate is cut through")
    for row in rows:
        for name in ("px", "pz"):
            check_near(f"{name}, t = {row['time']:.3g}", row[name],
                       first[name], 1e-9 * abs(first["pz"]))
        check_near("energy balance", row["gain"], 0., 1e-8 * first["E"])
    check_near("total and released energy", last["E"] + last["R"], first["E"],
               1e-8 * first["E"])


def released(rows):
    """The fracture takes energy, and no more than what the lips have held."""
    conserved(rows)
    check(rows[-1]["R"] > .05 * rows[0]["E"],
          f"released {rows[-1]['R']:.4g} of {rows[0]['E']:.4g}")


def free_at_once(rows):
    """The moment of a cut changes neither kinetic nor bending energy."""
    conserved(rows)
    check_near("energy taken out", rows[-1]["R"], 0., 1e-8 * rows[0]["E"])


FLYING = str(HERE / "flying_plate.prm")
CASES = {
    "released": (FLYING, {}, (1, 2), released),
    "at_once": (FLYING, {"Growth/Release time": "0"}, (1,), free_at_once),
}

if __name__ == "__main__":
    sys.exit(run_study.run_cases(CASES, grow_cuts.run_case, __doc__))
