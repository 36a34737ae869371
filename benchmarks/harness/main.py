# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Command line of benchmarks/run."""

import argparse
import pathlib
import sys

from calculix import version
from report import Report
from runs import PROJECT, Nacre, RunError, find_calculix
from sections import SECTIONS, Context


def parse():
    parser = argparse.ArgumentParser(
        prog="benchmarks/run", formatter_class=argparse.RawTextHelpFormatter,
        description="Measure, and write tables and plots.\n\nSections:\n" +
        "\n".join(f"  {name:13} {function.__doc__}"
                  for name, function in SECTIONS.items()))
    parser.add_argument("--only", action="append", default=[],
                        metavar="SECTION[,SECTION...]",
                        help="these sections, not all")
    parser.add_argument("--quick", action="store_true",
                        help="tiny meshes, to see that everything runs; "
                        "results go to build/benchmarks")
    parser.add_argument("--nacre", default=PROJECT / "build/release/nacre",
                        metavar="PROGRAM", help="default: build/release/nacre")
    parser.add_argument("--output", type=pathlib.Path, metavar="FOLDER",
                        help="default: benchmarks/results")
    parser.add_argument("--repeat", type=int, default=3, metavar="N",
                        help="the least seconds of N runs count; default 3")
    arguments = parser.parse_args()
    names = [name for text in arguments.only for name in text.split(",")]
    for name in names:
        if name not in SECTIONS:
            parser.error(f"--only: there is no section '{name}'; sections: " +
                         ", ".join(SECTIONS))
    if arguments.repeat < 1:
        parser.error("--repeat: at least 1")
    arguments.only = names or list(SECTIONS)
    if arguments.output is None:
        arguments.output = PROJECT / (
            "build/benchmarks" if arguments.quick else "benchmarks/results")
    return arguments


def main():
    arguments = parse()
    try:
        nacre = Nacre(arguments.nacre)
        calculix = find_calculix()
        report = Report(arguments.output, nacre,
                        version(calculix) if calculix else "",
                        arguments.quick)
        context = Context(nacre, report, arguments.repeat, arguments.quick)
        for name in arguments.only:
            print(f"=== {name}: {SECTIONS[name].__doc__}", flush=True)
            SECTIONS[name](context)
    except RunError as error:
        sys.exit(f"benchmarks/run: {error}")
    print(f"Results: {arguments.output}")


if __name__ == "__main__":
    main()
