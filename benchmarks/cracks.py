#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Cracks beside references: the tables of doc/benchmarks/cracked_plates.md.

  benchmarks/cracks.py [NAME...]   the tables, in Markdown
  benchmarks/cracks.py --list      their names

NAME: plates, sizes, inclined, difference, cylinders, and with cuts: cut_plates,
cut_ends, cut_inclined, cut_difference, cut_cylinders, tip_functions. The meshes
are made for each case; prm/fracture/ has the rest.
"""

import argparse
import csv
import math
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
PROJECT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PROJECT / "scripts"))
import make_meshes  # noqa: E402  (found by the line above)

E, NU, H = 1e6, 0.3, 0.1
NAMES = ("K_I", "K_II", "K_M", "K_T", "G", "U", "kink", "ratio", "ratio_K_II",
         "ratio_K_M", "ratio_K_T")
# Tips with Williams' fields, in cells of one size
TIPS = {"Cuts/Tips": "branch functions"}
UNIFORM = {"Mid-surface/Grading u": "s", "Mid-surface/Grading v": "s", **TIPS}
# kind, a, H, F in tension, F in bending: doc/benchmarks/cracked_plates.md
PLATES = [("centre", .2, 1, 1.0553776, 1.0177124),
          ("centre", .5, 1, 1.3337122, 1.1323155),
          ("centre", .5, 2, 1.1876356, 1.1311982),
          ("centre", .3, 2, None, 1.0407619),
          ("centre", .5, .5, 1.967084, None),
          ("edge", .2, 1, 1.3680397, 1.021464),
          ("edge", .5, 1, 2.8254653, 1.134243),
          ("edge", .5, .5, 3.008758, 1.157227)]
# The rest of the reference, for tips with functions
MORE_PLATES = [("centre", .3, 1, 1.1231911, None),
               ("centre", .2, 3, 1.0245902, None),
               ("centre", .3, 3, 1.0577474, None),
               ("centre", .5, 3, 1.186672, 1.1311),
               ("centre", .1, 3, None, 1.0042410),
               ("edge", .3, 1, 1.6611218, None),
               ("edge", .5, 1.5, 2.8245871, None),
               ("edge", .4, 2, 2.1114130, None),
               ("edge", .5, 2, 2.8245794, None)]
# nu, F in bending: centre, a/W = 0.5, H/W = 1
POISSON = [(0, 1.137266), (.25, 1.132899), (.3, 1.132315), (.5, 1.130730)]
# R/h, shell parameter, A_m, A_b, g: of shallow shells, but for R/h = 100
CYLINDERS = [(100, .5, 1.056193, .084205, 1.116651),
             (100, 1, 1.197637, .192525, 1.439387),
             (100, 2, 1.611888, .335721, 2.613119),
             (100, 4, 2.582478, .314864, 6.683788)] + [
                 (ratio, *row) for ratio in (1000, 10000) for row in (
                     (.5, 1.056395, .086589, 1.116956),
                     (1, 1.198183, .194199, 1.440594),
                     (2, 1.613317, .335548, 2.617575),
                     (4, 2.587417, .309868, 6.707337))]
AROUND = [(100, .5, 1.012960, .059984, 1.026427),
          (100, 1, 1.050086, .141684, 1.105134)] + [
              (ratio, *row) for ratio in (1000, 10000) for row in (
                  (.5, 1.012378, .061739, 1.025410),
                  (1, 1.047806, .143404, 1.100598),
                  (2, 1.165154, .211506, 1.363457),
                  (4, 1.458293, .028917, 2.126728))]
CUTS = ([(True, *row) for row in CYLINDERS] +
        [(False, *row) for row in AROUND])

# Of a difference of energies. Dead loads: Pi = -U; ends that are held: Pi = U
LOADS = [("tension", (1, 0), 1), ("bending", (0, 1), 1),
         ("ends turned by 0.5", (0, 0), -1)]
TURNED = {"Discretization/Kinematics": "finite", "Analysis/Type": "static",
          "Study/Degrees": "2"}


class Nacre:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def run(self, prm, mesh, settings):
        """The last row of the table, of a mesh of make_meshes or none."""
        if mesh:
            path = pathlib.Path(self.folder, "mesh.msh")
            path.write_text("\n".join(make_meshes.gmsh_2(mesh)) + "\n",
                            encoding="utf-8")
            settings = {"Mid-surface/file/File name": str(path), **settings}
        command = [str(self.program), str(PROJECT / "prm/fracture" / prm)]
        for key, value in {"Study/Output folder": self.folder,
                           "Study/Name": "cracks", "Study/Write VTU": "false",
                           "Study/Degrees": "3", "Study/Refinements": "0",
                           **settings}.items():
            command += ["--set", f"{key}={value}"]
        environment = {"OMP_NUM_THREADS": "1", **os.environ}
        done = subprocess.run(command, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False,
                              env=environment, stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)}\n{done.stdout}")
        with open(pathlib.Path(self.folder, "cracks.csv"), newline="",
                  encoding="utf-8") as file:
            row = list(csv.DictReader(file))[-1]
        return {key: float(row[key]) for key in NAMES if row.get(key)}


def quantities(tip, radii, names=("K_I", "K_II", "K_M", "K_T")):
    of = f"of tip {tip} radii {radii}"
    return "; ".join([f"{name} = {name} {of}" for name in names] +
                     [f"G = energy release rate {of}", "U = energy"])


def plate(nacre, kind, a, height, size, load, mesh=None, end=None,
          names=("K_I", "K_M"), more=None):
    """Of a plate of the half width 1 under the load (N, M)."""
    mesh = mesh or make_meshes.cracked((0., 1.), height, [a], size, 1.2)
    end = end or a
    settings = {
        "Constants": f"a = {end!r}, N = {load[0]}, M = {load[1]}",
        "Quantities/Quantities": quantities(
            f"({end!r}, 0, 0)", f"{0.05 * a}, {0.9 * min(a, 1 - a)}", names),
        "Boundary conditions/Edges": "left: symmetry",
        "Boundary conditions/Points":
            f"(1, 0, 0): y = 0, z = 0; (1, {height}, 0): z = 0"}
    if kind == "edge":
        settings["Boundary conditions/Edges"] = ""
        settings["Boundary conditions/Points"] = (
            f"(1, 0, 0): x = 0, y = 0; (1, {height}, 0): x = 0, z = 0; "
            f"(1, -{height}, 0): z = 0; (0, {height}, 0): z = 0")
    return nacre.run("cracked_plate.prm", mesh, {**settings, **(more or {})})


def factors(nacre, kind, a, height, size):
    """F of tension from K and from G, and of bending."""
    root = math.sqrt(math.pi * a)
    found = plate(nacre, kind, a, height, size, (1, 0))
    result = [found["K_I"] * H / root,
              math.sqrt(found["G"] * E * H) / root]
    stiffness = E * H**3 / (12 * (1 - NU**2)) * (1 - NU) * (3 + NU)
    found = plate(nacre, kind, a, height, size, (0, 1))
    return result + [found["K_M"] / root,
                     math.sqrt(found["G"] * stiffness) / root]


def line(*cells):
    print("| " + " | ".join(str(cell) for cell in cells) + " |", flush=True)


def head(*names):
    line(*names)
    line(*["---"] * len(names))


def compared(value, reference):
    if reference is None:
        return f"{value:.5f}"
    return f"{value:.5f} ({100 * (value / reference - 1):+.2f} %)"


def plates(nacre):
    head("crack", "a/W", "H/W", "tension", "from K_I", "from G", "bending",
         "from K_M", "from G")
    for kind, a, height, tension, bending in PLATES:
        t_k, t_g, b_k, b_g = factors(nacre, kind, a, height,
                                     min(a, 1 - a) / 50)
        line(kind, a, height, tension or "", compared(t_k, tension),
             compared(t_g, tension), bending or "", compared(b_k, bending),
             compared(b_g, bending))


def sizes(nacre):
    head("cell at the tip", "tension from K_I", "from G",
         "bending from K_M", "from G")
    for n in 10, 20, 40, 80:
        t_k, t_g, b_k, b_g = factors(nacre, "centre", .5, 1, .5 / n)
        line(f"a/{n}", compared(t_k, 1.3337122), compared(t_g, 1.3337122),
             compared(b_k, 1.1323155), compared(b_g, 1.1323155))


def inclined(nacre):
    """Lips in the direction x, the tension turned: K of an infinite plate."""
    head("angle", "K_I", "exact", "K_II", "exact")
    a, width = 1., 30.
    mesh = make_meshes.cracked((-width, width), width, [-a, a], a / 20, 1.4)
    for degrees in 30, 45, 60:
        beta = math.radians(degrees)
        n, t = math.cos(beta)**2, math.sin(beta) * math.cos(beta)
        found = nacre.run("cracked_plate.prm", mesh, {
            "Constants": "a = 1, N = 0, M = 0",
            "Loads/Edge forces":
                f"upper: {t}, {n}, 0; lower: -({t}), -({n}), 0",
            "Loads/Edge moments": "",
            "Quantities/Quantities": quantities("(1, 0, 0)", "0.05, 0.9"),
            "Boundary conditions/Edges": "",
            "Boundary conditions/Points":
                f"({width}, 0, 0): x = 0, y = 0, z = 0; "
                f"(-{width}, 0, 0): y = 0, z = 0; (0, {width}, 0): z = 0"})
        root = math.sqrt(math.pi * a) / H
        line(degrees, compared(found["K_I"] / root, n), f"{n:.6f}",
             compared(found["K_II"] / root, t), f"{t:.6f}")


def difference(nacre):
    """G beside the change of the energy between two lengths of the crack."""
    head("load", "G", "-dPi/da", "difference")
    a, step = .52, .002

    def moved(end):
        def position(u, v):
            x = u * end / a if u <= a else 1 - (1 - u) * (1 - end) / (1 - a)
            return x, v, 0.
        return make_meshes.cracked((0., 1.), 1., [a], a / 15, 1.3,
                                   position=position)

    turned = {**TURNED, "Boundary conditions/Edges":
              "left: symmetry; top, bottom: rotation = 0.5",
              "Boundary conditions/Points": "(1, 0, 0): y = 0, z = 0"}
    for (name, load, sign), more in zip(LOADS, (None, None, turned)):
        def solve(end, load=load, more=more):
            return plate(nacre, "centre", a, 1., None, load, moved(end), end,
                         (), more)

        slope = (solve(a + step)["U"] - solve(a - step)["U"]) / (2 * step)
        G = solve(a)["G"]
        line(name, f"{G:.6g}", f"{sign * slope:.6g}",
             f"{100 * (G / (sign * slope) - 1):+.2f} %")


def cylinders(nacre):
    head("R/h", "lambda", "A_m", "Nacre", "A_b", "Nacre", "g", "Nacre")
    for ratio, shell, a_m, a_b, g in CYLINDERS:
        h = 1 / ratio
        a = shell * math.sqrt(h) / (12 * (1 - NU**2))**.25
        far = min(16 * a, math.pi)
        mesh = make_meshes.cracked((0., far), far, [a], a / 20, 1.3,
                                   position=around_x)
        found = nacre.run("cracked_cylinder.prm", mesh, {
            "Constants": f"R = 1, thick = {h!r}, a = {a!r}, N = {h!r}",
            "Quantities/Quantities": quantities(
                f"({a!r}, 0, 1)", f"{.1 * a}, {.5 * a}", ("K_I", "K_M"))})
        root = math.sqrt(math.pi * a)
        line(ratio, shell, a_m, compared(found["K_I"] / root, a_m), a_b,
             compared(6 * found["K_M"] / (h * h * root), a_b), g,
             compared(found["G"] * 1e3 / (h * math.pi * a), g))


def around_x(u, v):
    return u, math.sin(v), math.cos(v)


def grading(place, n, size, cells):
    """Lines of n cells from 0 to 1, so many cells before the place; there they
    have the size."""
    at = cells / n
    slope = size * n
    before = (place - slope * at) / at**3
    behind = (1 - place - slope * (1 - at)) / (1 - at)**3
    return (f"{place!r} + {slope!r}*(s - {at!r}) + if(s < {at!r}, "
            f"-{before!r}*({at!r} - s)^3, "
            f"{behind!r}*(s - {at!r})^3)")


def to_middle(n, size):
    """Lines of n cells from 0 to 1, that in the middle has the size."""
    slope = size * n
    return (f"0.5 + if(s < 0.5, -0.5, 0.5)*({slope!r}*abs(2*s - 1) + "
            f"{1 - slope!r}*abs(2*s - 1)^3)")


def cut_plate(nacre, kind, a, height, load, cells=(24, 20, 51), mesh_a=None,
              size=None, radii=None, more=None):
    """Of a plate of the half width 1 that is cut from the left up to a, through
    cells of a/50 at the tip; cells: before and behind it, and across."""
    before, behind, across = cells
    n = before + behind
    mesh_a, size = mesh_a or a, size or a / 50
    settings = {
        "Constants": f"a = {a!r}",
        "Mid-surface/Subdivisions": f"{n}, {across}",
        "Mid-surface/Grading u": grading(mesh_a, n, size, before),
        "Mid-surface/Grading v": to_middle(across, size / height / 2),
        "Mid-surface/expression/Range u": "0, 1",
        "Mid-surface/expression/Range v": f"{-height}, {height}",
        "Cuts/Cuts": "crack: uv (-1, 0) (a, 0)",
        "Section/Young's modulus": E, "Section/Poisson's ratio": NU,
        "Section/Thickness": H,
        "Loads/Edge forces": f"v=1: 0, {load[0]}, 0; v=0: 0, -{load[0]}, 0",
        "Loads/Edge moments": f"v=0, v=1: {load[1]}",
        "Boundary conditions/Edges": "u=0: symmetry",
        "Boundary conditions/Points":
            f"(1, 0.01, 0): y = 0, z = 0; (1, {height}, 0): z = 0",
        "Quantities/Quantities": of_cut(
            radii or f"{0.05 * a}, {0.9 * min(a, 1 - a)}", ("K_I", "K_M"))}
    if kind == "edge":
        settings["Boundary conditions/Edges"] = ""
        settings["Boundary conditions/Points"] = (
            f"(1, 0.01, 0): x = 0, y = 0; (1, {height}, 0): x = 0, z = 0; "
            f"(1, -{height}, 0): z = 0; (0, {height}, 0): z = 0")
    return nacre.run("inclined_cut.prm", None, {**settings, **(more or {})})


def of_cut(radii, names):
    of = "of crack end" + (f" radii {radii}" if radii else "")
    return "; ".join([f"{name} = {name} {of}" for name in names] +
                     [f"G = energy release rate {of}", "U = energy"])


def cut_factors(*arguments, nu=NU, **more):
    """As factors()."""
    more["more"] = {"Section/Poisson's ratio": nu, **(more.get("more") or {})}
    root = math.sqrt(math.pi * arguments[2])
    found = cut_plate(*arguments, (1, 0), **more)
    result = [found["K_I"] * H / root, math.sqrt(found["G"] * E * H) / root]
    stiffness = E * H**3 / (12 * (1 - nu**2)) * (1 - nu) * (3 + nu)
    found = cut_plate(*arguments, (0, 1), **more)
    return result + [found["K_M"] / root,
                     math.sqrt(found["G"] * stiffness) / root]


def cut_plates(nacre):
    head("crack", "a/W", "H/W", "tension", "from K_I", "from G", "bending",
         "from K_M", "from G")
    for kind, a, height, tension, bending in PLATES:
        t_k, t_g, b_k, b_g = cut_factors(nacre, kind, a, height)
        line(kind, a, height, tension or "", compared(t_k, tension),
             compared(t_g, tension), bending or "", compared(b_k, bending),
             compared(b_g, bending))


def cut_ends(nacre):
    """Ends within a cell of a/50, by shares of it."""
    head("end of the cut", "tension from K_I", "from G",
         "bending from K_M", "from G")
    a = .5
    for share in 0., .25, .5, .75:
        t_k, t_g, b_k, b_g = cut_factors(nacre, "centre", a, 1,
                                         mesh_a=a - share * a / 50)
        line(share, compared(t_k, 1.3337122), compared(t_g, 1.3337122),
             compared(b_k, 1.1323155), compared(b_g, 1.1323155))


def inclined_cuts(nacre, levels, more, compared=compared):
    """The infinite plate, its displacements prescribed around."""
    head("angle", "cells", "K_I", "exact", "K_II", "exact", "kink", "exact")
    text = (PROJECT / "prm/fracture/inclined_cut.prm").read_text(
        encoding="utf-8")
    constants = " ".join(text.split("set Constants = ")[1].split("\n\n")[0]
                         .replace("\\\n", "").split())
    for degrees in 30, 45, 60:
        beta = math.radians(degrees)
        n, t = math.cos(beta)**2, math.sin(beta) * math.cos(beta)
        kink = 2 * math.degrees(math.atan(
            (n - math.sqrt(n * n + 8 * t * t)) / (4 * t)))
        for level in levels:
            found = nacre.run("inclined_cut.prm", None, {
                "Constants": constants.replace("pi/6", repr(beta)),
                "Study/Refinements": level, **more})
            root = math.sqrt(math.pi * .5)
            line(degrees, 400 * 4**level, compared(found["K_I"] / root, n),
                 f"{n:.6f}", compared(found["K_II"] / root, t), f"{t:.6f}",
                 f"{found['kink']:.3f}", f"{kink:.3f}")


def cut_inclined(nacre):
    inclined_cuts(nacre, (0, 1, 2), {})


def cut_difference(nacre):
    """As difference(), the lines of the mesh moved with the tip; fewer cells in
    finite rotations."""
    head("load", "G", "-dPi/da", "difference")
    a, step = .52, .002
    turned = {**TURNED, "Boundary conditions/Edges":
              "u=0: symmetry; v=0, v=1: rotation = 0.5",
              "Boundary conditions/Points": "(1, 0.01, 0): y = 0, z = 0",
              "Loads/Edge forces": "", "Loads/Edge moments": "",
              "Quantities/Quantities":
                  of_cut(f"{.05 * a}, {.9 * (1 - a)}", ())}
    for (name, load, sign), more in zip(LOADS, (None, None, turned)):
        def solve(end, load=load, more=more):
            return cut_plate(nacre, "centre", end, 1., load, size=a / 50,
                             cells=(16, 14, 31) if more else (24, 20, 51),
                             more=more)

        slope = (solve(a + step)["U"] - solve(a - step)["U"]) / (2 * step)
        G = solve(a)["G"]
        line(name, f"{G:.6g}", f"{sign * slope:.6g}",
             f"{100 * (G / (sign * slope) - 1):+.2f} %")


def cut_cylinder(nacre, axial, ratio, shell, inside=0, more=None):
    """A_m, A_b, g of a cylinder whose crack's lips are pulled.

    inside: the share of its cell by which the cut goes on behind the line of
    the mesh."""
    h = 1 / ratio
    a = shell * math.sqrt(h) / (12 * (1 - NU**2))**.25
    # What a crack disturbs reaches far along the axis.
    along, around = "min(400*a, 12)", "min(250*a, pi)"
    u, v = (along, around) if axial else (around, along)
    settings = {
        "Constants":
            f"h0 = {h!r}, W = 1e3, m = {NU}, n = 54, b = 14, c = 75, "
            f"a = {a!r}, w = 0.7*a/b, "
            f"U = {u}, V = {v}, "
            f"k = n*w/U, l = c*w/(2*V), e = (a - {inside}*w)/U",
        "Mid-surface/Subdivisions": "54, 75",
        "Cuts/Tips": "closed",
        "Quantities/Quantities":
            of_cut(f"{.1 * a}, {.5 * a}", ("K_I", "K_M"))}
    if axial:
        settings.update({
            "Mid-surface/expression/Position": "u, sin(v), cos(v)",
            "Boundary conditions/Edges":
                "u=0, v=0, v=1: symmetry; u=1: fixed"})
    found = nacre.run("cut_cylinder.prm", None, {**settings, **(more or {})})
    root = math.sqrt(math.pi * a)
    return (found["K_I"] / root, 6 * found["K_M"] / (h * h * root),
            found["G"] * 1e3 / (h * math.pi * a))


def cylinder_table(nacre, cuts, **more):
    head("crack", "R/h", "lambda", "A_m", "Nacre", "A_b", "Nacre", "g",
         "Nacre")
    for axial, ratio, shell, *references in cuts:
        cells = []
        for reference, value in zip(references, cut_cylinder(
                nacre, axial, ratio, shell, **more)):
            cells += [reference, compared(value, reference)]
        line("axial" if axial else "around", ratio, shell, *cells)


def cut_cylinders(nacre):
    cylinder_table(nacre, CUTS)


def off(value):
    return f"{value - 1:+.1e}"


def near(value, reference):
    if reference is None:
        return f"{value:.6f}"
    return f"{value:.6f} ({off(value / reference)})"


def tip_fields(nacre):
    """Williams' fields around as displacements."""
    head("p", "cells", "tip radius", "K_I", "K_II", "K_M", "K_T")
    text = (PROJECT / "prm/fracture/williams_fields.prm").read_text(
        encoding="utf-8")
    wanted = text.split("set Quantities = ")[1].split("\nend")[0].replace(
        "\\\n", "")
    for radius, radii in (0, "0.15, 0.7"), (0.5, "0.55, 0.93"):
        for degree, n in (2, 16), (2, 32), (2, 64), (3, 12), (3, 24):
            found = nacre.run("williams_fields.prm", None, {
                "Study/Degrees": degree, "Mid-surface/Subdivisions": n,
                "Cuts/Tip radius": radius,
                "Quantities/Quantities":
                " ".join(wanted.replace("0.15, 0.7", radii).split())})
            line(degree, n * n, radius, *(
                off(found["ratio" + mode])
                for mode in ("", "_K_II", "_K_M", "_K_T")))


def tip_places(nacre):
    """The same, at places of a cell."""
    head("across the cell", "along the cell", "K_I", "K_II", "K_M", "K_T")
    text = (PROJECT / "prm/fracture/williams_fields.prm").read_text(
        encoding="utf-8")
    constants = text.split("set Constants = ")[1].split("subsection")[0]
    for b, a in ((.3, 0), (.3, .01), (.3, .25), (.3, .5), (.3, .75), (.3, .99),
                 (.01, .5), (.01, .01), (.03, .97)):
        found = nacre.run("williams_fields.prm", None, {
            "Constants": constants.replace("\\\n", "").strip().replace(
                "a = 0.07, b = 0.05", f"a = {a / 6!r}, b = {b / 6!r}"),
            "Cuts/Snap": 0.001})
        line(b, a, *(off(found["ratio" + mode]) for mode in
                     ("", "_K_II", "_K_M", "_K_T")))


def tip_meeting_lines(nacre):
    """A cut across cells or along edges, that ends between or on lines."""
    head("across", "along", "tension from K_I", "from G", "bending from K_M",
         "from G")
    for cells in (12, 11, 45), (12, 12, 45), (12, 11, 46), (12, 12, 46):
        t_k, t_g, b_k, b_g = cut_factors(nacre, "centre", .5, 1, cells=cells,
                                         more=UNIFORM)
        line("inside" if cells[2] % 2 else "on a line",
             "on a line" if cells[1] == 12 else "inside",
             near(t_k, 1.3337122), near(t_g, 1.3337122), near(b_k, 1.1323155),
             near(b_g, 1.1323155))


def tip_functions(nacre):
    for table in tip_fields, tip_places, tip_meeting_lines:
        table(nacre)
        print()
    head("crack", "a/W", "H/W", "tension", "from K_I", "from G", "bending",
         "from K_M", "from G")
    for kind, a, height, tension, bending in PLATES + MORE_PLATES:
        across = 2 * math.floor(23 * height) - 1
        t_k, t_g, b_k, b_g = cut_factors(
            nacre, kind, a, height, cells=(12, 11, across), more=UNIFORM)
        line(kind, a, height, tension or "", near(t_k, tension),
             near(t_g, tension), bending or "", near(b_k, bending),
             near(b_g, bending))
    print()
    head("nu", "bending", "from K_M", "from G")
    for nu, bending in POISSON:
        found = cut_factors(nacre, "centre", .5, 1, cells=(12, 11, 45),
                            nu=nu, more=UNIFORM)
        line(nu, bending, *(near(value, bending) for value in found[2:]))
    print()
    inclined_cuts(nacre, (0, 1), {
        **UNIFORM, "Quantities/Quantities": of_cut(
            "0.1, 0.45", ("K_I", "K_II")) +
        "; kink = kink angle of crack end radii 0.1, 0.45"}, near)
    print()
    cylinder_table(nacre, CUTS, inside=.5, more=TIPS)


TABLES = {table.__name__: table
          for table in (plates, sizes, inclined, difference, cylinders,
                        cut_plates, cut_ends, cut_inclined, cut_difference,
                        cut_cylinders, tip_functions)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--nacre", default=PROJECT / "build/release/nacre")
    arguments = parser.parse_args()
    if arguments.list:
        print("\n".join(TABLES))
        return
    for name in arguments.names or TABLES:
        if name not in TABLES:
            sys.exit(f"cracks.py: no table '{name}'; known: "
                     f"{', '.join(TABLES)}")
        print(f"\n{name}\n")
        with tempfile.TemporaryDirectory() as folder:
            TABLES[name](Nacre(arguments.nacre, folder))


if __name__ == "__main__":
    main()
