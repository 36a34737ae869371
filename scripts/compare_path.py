#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Compare a load path with a table of reference values.

  scripts/compare_path.py NAME_path.csv REFERENCE.csv [--tolerance 0.015]

REFERENCE.csv has a column load_factor and columns of the path's quantities.
Where the load factor of the path only grows, each value is compared at its load
factor; the path is a cubic through its steps. Else each row is compared with
the nearest point of that cubic, and the deviation is the distance

  sqrt(((load - row's load) / S)^2 + sum over columns (v/row's v - 1)^2)

with S the load factor of the first row from which on it falls. Printed are, for
each column or the distance, the largest deviation relative to the row's value,
the largest relative to the column's largest value, and their load factors. With
--tolerance the exit code is 1 if a deviation relative to the largest value (or
a distance) is above it. A row beyond the end of the path is an error.

Needs Debian's python3-numpy.
"""

import argparse
import sys

import numpy

import plotting

# Points of the cubic between two steps.
FINE = 200


def read(path):
    """{column: values} of a table."""
    rows = plotting.read_rows(path, "load_factor")
    return {name: numpy.array(plotting.numbers(path, rows, name))
            for name in rows[0]}


def refined(curve):
    """Points of a cubic through those of `curve` (steps x columns): Hermite's,
    its slopes those of parabolas through three points, over the chord's
    length in the curve's ranges."""
    extent = numpy.ptp(curve, axis=0)
    extent[extent == 0.] = 1.
    length = numpy.linalg.norm(numpy.diff(curve / extent, axis=0), axis=1)
    keep = numpy.append(True, length > 0.)
    curve, length = curve[keep], length[length > 0.]
    if len(curve) < 3:
        return curve
    chord = numpy.diff(curve, axis=0) / length[:, None]
    left, right = length[:-1, None], length[1:, None]
    middle = (chord[:-1] * right + chord[1:] * left) / (left + right)
    slopes = numpy.vstack([2. * chord[0] - middle[0], middle,
                           2. * chord[-1] - middle[-1]])
    pieces = []
    s = numpy.linspace(0., 1., FINE, endpoint=False)[:, None]
    for k, step in enumerate(length):
        a, b = curve[k], curve[k + 1]
        pieces.append(a * (1. + 2. * s) * (1. - s)**2 +
                      b * s**2 * (3. - 2. * s) +
                      step * (slopes[k] * s * (1. - s)**2 -
                              slopes[k + 1] * s**2 * (1. - s)))
    return numpy.vstack(pieces + [curve[-1:]])


def first_maximum(loads):
    falls = numpy.nonzero(numpy.diff(loads) < 0.)[0]
    return abs(loads[falls[0]]) if len(falls) else numpy.abs(loads).max()


def compare(path, reference):
    """[(name, relative to the row, its load, to the largest, its load)]"""
    names = [name for name in reference if name != "load_factor"]
    for name in names:
        if name not in path:
            raise plotting.BadFile(f"the path has no quantity '{name}'; it "
                                   f"has: {', '.join(path)}")
    curve = numpy.column_stack([path[n] for n in ["load_factor"] + names])
    loads = reference["load_factor"]
    for which, table in ("path", path), ("reference", reference):
        for name in reference:
            if not numpy.isfinite(table[name]).all():
                raise plotting.BadFile(f"the {which} has an empty cell in the "
                                       f"column '{name}'")
            if not numpy.any(reference[name]):
                raise plotting.BadFile(f"the reference's column '{name}' is "
                                       "zero: nothing is relative to it")
    if curve[:, 0].max() < loads.max() * (1. - 1e-9):
        raise plotting.BadFile("the path ends below the load factor "
                               f"{loads.max()}")
    fine = refined(curve)
    found = []
    if numpy.all(numpy.diff(curve[:, 0]) > 0.):
        for k, name in enumerate(names):
            values = numpy.interp(loads, fine[:, 0], fine[:, k + 1])
            difference = numpy.abs(values - reference[name])
            size = numpy.abs(reference[name])
            relative = difference / numpy.where(size > 0., size, numpy.inf)
            total = difference / size.max()
            found.append((name, relative.max(), loads[relative.argmax()],
                          total.max(), loads[total.argmax()]))
        return found
    scale = first_maximum(loads)
    distances = []
    for k, load in enumerate(loads):
        row = numpy.array([reference[name][k] for name in names])
        distances.append(numpy.sqrt(
            ((fine[:, 0] - load) / scale)**2 +
            ((fine[:, 1:] / row - 1.)**2).sum(axis=1)).min())
    distances = numpy.array(distances)
    worst = loads[distances.argmax()]
    return [("distance", distances.max(), worst, distances.max(), worst)]


def main():
    parser = argparse.ArgumentParser(
        prog="compare_path.py", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path", metavar="NAME_path.csv")
    parser.add_argument("reference", metavar="REFERENCE.csv")
    parser.add_argument("--tolerance", type=float)
    arguments = parser.parse_args()
    found = compare(read(arguments.path), read(arguments.reference))
    for name, relative, at, total, total_at in found:
        print(f"{name}: {100. * relative:.2f} % of the value at {at:g}, "
              f"{100. * total:.2f} % of the largest at {total_at:g}")
    if arguments.tolerance is not None and \
            max(total for _, _, _, total, _ in found) > arguments.tolerance:
        sys.exit(f"compare_path.py: above {100. * arguments.tolerance:g} %")


if __name__ == "__main__":
    plotting.run("compare_path.py", main)
