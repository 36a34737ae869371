# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Decks of the benchmarks for CalculiX with 8-node shells, S8 or S8R."""

import math
import pathlib
import subprocess
import tempfile

from runs import RunError, find_calculix, measure

AXES = ((1., 0., 0.), (0., 1., 0.), (0., 0., 1.))


def cylinder(radius, length, angle, along):
    """Position at (u, v) in the unit square of a part of a cylinder."""
    def position(u, v):
        theta = u * math.radians(angle)
        if along == "y":
            return (radius * math.sin(theta), v * length,
                    radius * math.cos(theta))
        return (radius * math.cos(theta), radius * math.sin(theta), v * length)
    return position


def hemisphere(radius, hole):
    """u: azimuth from x to y, v: from the equator to the hole (degrees)."""
    def position(u, v):
        azimuth = u * math.pi / 2
        elevation = v * math.radians(90 - hole)
        return (radius * math.cos(azimuth) * math.cos(elevation),
                radius * math.sin(azimuth) * math.cos(elevation),
                radius * math.sin(elevation))
    return position


# Edges by the coordinate that is fixed there: planes of symmetry by the
# direction of their normal, and what is held: displacements 0 to 2, rotations
# about the axes 3 to 5; points by (u, v). The
# reference is the Kirchhoff-Love value that the .prm files have as well.
PROBLEMS = {
    "scordelis_lo": {
        "position": cylinder(25., 25., 40., "y"),
        "E": 4.32e8, "nu": 0., "h": 0.25, "gravity": 90.,
        "symmetry": {("u", 0): 0, ("v", 1): 1}, "held": {("v", 0): (0, 2)},
        "points": {}, "forces": [],
        "watch": ((1, 1), 3), "reference": -0.30059246},
    "pinched_cylinder": {
        "position": cylinder(300., 300., 90., "z"),
        "E": 3e6, "nu": 0.3, "h": 3., "gravity": 0.,
        "symmetry": {("u", 0): 1, ("u", 1): 0, ("v", 0): 2},
        "held": {("v", 1): (0, 1)},
        "points": {}, "forces": [((0, 0), 0, -0.25)],
        "watch": ((0, 0), 1), "reference": -1.828195e-5},
    "hemisphere_hole": {
        "position": hemisphere(10., 18.),
        "E": 6.825e7, "nu": 0.3, "h": 0.04, "gravity": 0.,
        "symmetry": {("u", 0): 1, ("u", 1): 0}, "held": {},
        "points": {(0, 0): (2,)},
        "forces": [((0, 0), 0, 1.), ((1, 0), 1, -1.)],
        "watch": ((0, 0), 1), "reference": 0.09352155}}


def grid(n, m=None):
    """Numbers of the nodes (i, j) of n x m 8-node cells; cells as lists."""
    m = m or n
    numbers = {}
    for j in range(2 * m + 1):
        for i in range(2 * n + 1):
            if i % 2 == 0 or j % 2 == 0:
                numbers[i, j] = len(numbers) + 1
    around = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
    cells = [[numbers[2 * i + a, 2 * j + b] for a, b in around]
             for j in range(m) for i in range(n)]
    return numbers, cells


def cross(a, b):
    return tuple(a[(c + 1) % 3] * b[(c + 2) % 3] -
                 a[(c + 2) % 3] * b[(c + 1) % 3] for c in range(3))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def surface_normal(position, u, v):
    """Unit normal by differences."""
    d = 1e-5
    across = [[(a - b) for a, b in zip(position(u + e, v + f),
                                       position(u - e, v - f))]
              for e, f in ((d, 0.), (0., d))]
    normal = cross(*across)
    return tuple(c / math.sqrt(dot(normal, normal)) for c in normal)


def symmetry_node(position, plane, u, v):
    """
    Axes of a node on a plane of symmetry: normal of the plane, tangent of the
    edge, normal of the surface. No rotation is held about the latter, or the
    model is far too stiff.
    """
    normal = surface_normal(position, u, v)
    p = AXES[plane]
    tangent = cross(normal, p)
    length = math.sqrt(dot(tangent, tangent))
    return p, tuple(c / length for c in tangent), normal


def local(axes, direction):
    """(number, sign) of the local axis that a global direction is."""
    for k, axis in enumerate(axes):
        if abs(abs(axis[direction]) - 1.) < 1e-6:
            return k, math.copysign(1., axis[direction])
    raise ValueError(f"the direction {direction} is no axis of {axes}")


def on_edge(edge, i, j, n, m):
    coordinate, end = edge
    return i == 2 * n * end if coordinate == "u" else j == 2 * m * end


def conditions(problem, numbers, n, m):
    """Local axes of nodes, and what is held: (node, degree of freedom)."""
    axes, held = {}, set()
    for (i, j), number in numbers.items():
        at = (i / (2 * n), j / (2 * m))
        if any(on_edge(edge, i, j, n, m)
               for edge in problem.get("clamped", ())):
            held |= {(number, k) for k in range(1, 7)}
            continue
        for edge, plane in problem["symmetry"].items():
            if not on_edge(edge, i, j, n, m):
                continue
            if number not in axes:
                axes[number] = symmetry_node(problem["position"], plane, *at)
                held |= {(number, 1), (number, 5)}
            else:  # a second plane, along the first edge
                k, _ = local(axes[number], plane)
                assert k == 1
                held |= {(number, 2), (number, 4)}
        directions = [d for edge, held_there in problem["held"].items()
                      if on_edge(edge, i, j, n, m) for d in held_there]
        directions += problem["points"].get(at, ())
        if set(directions) == {0, 1, 2}:  # in any axes
            held |= {(number, k) for k in (1, 2, 3)}
            continue
        for direction in directions:
            k = local(axes[number], direction % 3)[0] if number in axes \
                else direction % 3
            held.add((number, k + 1 + 3 * (direction // 3)))
    return axes, held


def step(problem, numbers, n, m, axes):
    """The linear analysis of the loads."""
    lines = ["*STEP", "*STATIC"]
    if problem["gravity"]:
        lines += ["*DLOAD", "SHELL, GRAV, 1., 0., 0., -1."]
    return lines + point_forces(problem, numbers, n, m, axes) + \
        ["*NODE PRINT, NSET=WATCH, GLOBAL=YES", "U", "*END STEP"]


def point_forces(problem, numbers, n, m, axes):
    lines = ["*CLOAD"] if problem["forces"] else []
    for (u, v), direction, value in problem["forces"]:
        node = numbers[2 * n * u, 2 * m * v]
        k, sign = local(axes[node], direction)
        lines.append(f"{node}, {k + 1}, {sign * value}")
    return lines


def edge_forces(numbers, n, m, axes, edge, direction, total):
    """A uniform force on an edge of equal cells: Simpson's shares."""
    along_u = edge[0] == "v"
    cells = n if along_u else m
    lines = ["*CLOAD"]
    for k in range(2 * cells + 1):
        node = numbers[(k, 2 * m * edge[1]) if along_u else
                       (2 * n * edge[1], k)]
        axis, sign = local(axes[node], direction) if node in axes else \
            (direction, 1.)
        share = 4. if k % 2 else 1. if k in (0, 2 * cells) else 2.
        # It reads 20 characters of a number
        lines.append(f"{node}, {axis + 1}, "
                     f"{sign * total * share / (6. * cells):.12g}")
    return lines


def deck(problem, n, element, make_step=step):
    """The input of CalculiX as text: n cells along u."""
    m = problem.get("cells_along_v", lambda n: n)(n)
    numbers, cells = grid(n, m)
    lines = ["*NODE, NSET=ALL"]
    for (i, j), number in numbers.items():
        x = problem["position"](i / (2 * n), j / (2 * m))
        lines.append(f"{number}, " + ", ".join(f"{c:.15g}" for c in x))
    lines.append(f"*ELEMENT, TYPE={element}, ELSET=SHELL")
    for k, cell in enumerate(cells):
        lines.append(f"{k + 1}, " + ", ".join(str(node) for node in cell))
    axes, held = conditions(problem, numbers, n, m)
    for node, (first, second, _) in axes.items():
        lines += [f"*NSET, NSET=N{node}", str(node),
                  f"*TRANSFORM, NSET=N{node}, TYPE=R",
                  ", ".join(f"{c:.15g}" for c in first + second)]
    lines.append("*BOUNDARY")
    lines += [f"{node}, {direction}, {direction}"
              for node, direction in sorted(held)]
    density = problem["gravity"] / problem["h"] or 1.
    lines += ["*MATERIAL, NAME=STUFF", "*ELASTIC",
              f"{problem['E']}, {problem['nu']}", "*DENSITY", f"{density}",
              "*SHELL SECTION, ELSET=SHELL, MATERIAL=STUFF", f"{problem['h']}"]
    (u, v), _ = problem["watch"]
    lines += ["*NSET, NSET=WATCH", str(numbers[2 * n * u, 2 * m * v])]
    return "\n".join(lines + make_step(problem, numbers, n, m, axes)) + "\n"


def watched(dat, direction):
    """The displacement printed into the .dat."""
    values = [line.split() for line in dat.splitlines()
              if len(line.split()) == 4 and line.split()[0].isdigit()]
    if not values:
        raise RunError(f"CalculiX printed no displacement:\n{dat}")
    return float(values[-1][direction])


def version(program):
    """It tells its version and ends with an error."""
    words = subprocess.run([program, "-v"], capture_output=True, text=True,
                           check=False).stdout.split()
    return words[-1] if words else "?"


class CalculiX:
    """Runs decks; CPU seconds without those of starting the program."""

    def __init__(self, program, repeat):
        self.program = program
        self.repeat = repeat
        # One element: start, reading and writing.
        self.start = min(self.run("scordelis_lo", 1, "S8R")[1]
                         for _ in range(max(3, repeat)))

    def run(self, name, n, element):
        """(watched displacement, CPU seconds in all)"""
        problem = PROBLEMS[name]
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "deck.inp").write_text(
                deck(problem, n, element), encoding="utf-8")
            done = measure([self.program, "deck"], folder)
            dat = pathlib.Path(folder, "deck.dat")
            if not dat.exists():
                raise RunError(f"CalculiX failed:\n{done.output[-2000:]}")
            value = watched(dat.read_text(encoding="utf-8"),
                            problem["watch"][1])
        return value, done.cpu

    def row(self, name, n, element):
        """Equations, error and seconds of one mesh."""
        results = [self.run(name, n, element) for _ in range(self.repeat)]
        numbers, _ = grid(n)
        return {"n": n, "dofs": 6 * len(numbers),
                "error": abs(results[0][0] / PROBLEMS[name]["reference"] - 1.),
                "cpu_s": max(min(cpu for _, cpu in results) - self.start,
                             1e-3)}
