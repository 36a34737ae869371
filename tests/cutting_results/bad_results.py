# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Wrong input about results of cut shells, and what they can't have yet;
../parameters/bad_input.py runs the cases and says what they hold."""
import pathlib

WITH_GOOD_CASES = False
BASE = pathlib.Path(__file__).with_name("two_strips.prm").read_text()
CASES = {}


def case(name, expect, settings, args=("--check",)):
    CASES[name] = dict(expect=expect, settings=settings, change=None, prm=BASE,
                       args=list(args), folder={}, code=1)


case("cut_unknown",
     ["Quantities/Quantities, 'a'", "unknown cut 'slot'", "slit"],
     {"Quantities/Quantities": "a = length of slot"})
case("cut_none", ["the shell has no cuts", "Cuts/Cuts"],
     {"Quantities/Quantities": "a = length of slit", "Cuts/Cuts": ""})
case("opening_without_point", ["'a'", "write 'opening of CUT at (x, y, z)'"],
     {"Quantities/Quantities": "a = opening z of slit"})
case("opening_direction", ["'a'", "direction 'across'"],
     {"Quantities/Quantities": "a = opening across of slit at (1, 0.37, 0)"})
case("lip_point", ["'a'", "lies on two parts of the surface",
                   "Choose a point further inside"],
     {"Quantities/Quantities": "a = displacement z at (1, 0.37, 0)"}, [])
case("reference_assembly_of_cuts",
     ["Discretization/Assembly", "cuts (Cuts/Cuts)", "choose 'fast'"],
     {"Discretization/Assembly": "reference"})
