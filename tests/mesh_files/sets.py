#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Names, sets, seams and checks of mesh files: what a name means, that sets
which nobody names change nothing, and what is told.

  sets.py NACRE N_RANKS [NAME ...]   run all cases or those
  sets.py --list                     their names

A case is a function: it runs nacre in an empty folder and compares values of
one mesh with those of another that says the same in plainer words.
"""
import csv
import os
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "parameters"))
from bad_input import Failure, Nacre, check, with_settings  # noqa: E402

EDGES, REGIONS = "Boundary conditions/Edges", "Section/Regions"
QUANTITIES = "Quantities/Quantities"
FORCES, MOMENTS = "Loads/Edge forces", "Loads/Edge moments"
MERGE, SLITS = "Mid-surface/file/Merge distance", "Mid-surface/file/Slits"

# Clamped at x = 0, under its weight; the names of edges are those of plate().
BASE = """\
subsection Study
  set Degrees     = 3
  set Refinements = 0
end
subsection Mid-surface
  set Surface = file
end
subsection Boundary conditions
  set Edges = left: clamped
end
subsection Loads
  set Force per area = 0, 0, -1e-6
end
subsection Quantities
  set Quantities = w = displacement z at (1, 0.5, 0); U = energy
end
"""


class Mesh:
    """An Abaqus file of n x n cells on the unit square, and its sets."""

    def __init__(self, n=4, degree=1):
        m = self.m = n * degree
        self.number = {(i, j): 1 + j * (m + 1) + i
                       for j in range(m + 1) for i in range(m + 1)}
        self.nodes = {k: (i / m, j / m, 0.)
                      for (i, j), k in self.number.items()}
        self.cells = {}
        ring = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]
        for j in range(n):
            for i in range(n):
                self.cells[1 + j * n + i] = [
                    self.number[(degree * i + a * degree // 2,
                                 degree * j + b * degree // 2)]
                    for a, b in (ring if degree == 2 else ring[:4])]
        used = {k for cell in self.cells.values() for k in cell}
        self.nodes = {k: x for k, x in self.nodes.items() if k in used}
        self.sets = []  # (keyword line, members)
        self.lines = []  # (group, number, nodes)

    def where(self, condition):
        return [k for k, x in self.nodes.items() if condition(*x[:2])]

    def node_set(self, name, members):
        self.sets.append((f"*NSET, NSET={name}", list(members)))
        return self

    def cell_set(self, name, members):
        self.sets.append((f"*ELSET, ELSET={name}", list(members)))
        return self

    def sides(self, left="left", right="right", bottom="bottom", top="top"):
        for name, condition in ((left, lambda x, y: x == 0),
                                (right, lambda x, y: x == 1),
                                (bottom, lambda x, y: y == 0),
                                (top, lambda x, y: y == 1)):
            if name:
                self.node_set(name, self.where(condition))
        return self

    def text(self):
        kind = {4: "S4", 8: "S8R"}[len(next(iter(self.cells.values())))]
        out = ["*NODE"]
        out += [", ".join(map(str, (k, *x))) for k, x in self.nodes.items()]
        out += [f"*ELEMENT, TYPE={kind}"]
        out += [", ".join(map(str, (k, *c))) for k, c in self.cells.items()]
        for keyword, members in self.sets:
            out.append(keyword)
            out += [", ".join(map(str, members[i:i + 8]))
                    for i in range(0, len(members), 8)]
        return "\n".join(out) + "\n"


def plate(**names):
    return Mesh().sides(**names)


class Runner:
    def __init__(self, nacre, folder):
        self.nacre, self.folder, self.count = nacre, folder, 0

    def start(self, mesh, settings):
        """Exit code and all that was said, as one line."""
        self.count += 1
        name = f"case{self.count}"
        text = mesh if isinstance(mesh, str) else mesh.text()
        kind = "msh" if text.startswith("$") else "inp"
        (self.folder / f"{name}.{kind}").write_text(text)
        settings = {"Mid-surface/file/File name": f"{name}.{kind}",
                    **(settings or {})}
        (self.folder / f"{name}.prm").write_text(with_settings(BASE, settings))
        code, _, said = self.nacre.run([f"{name}.prm", "--quiet"], self.folder)
        return name, code, said

    def good(self, mesh, settings=None, notes=()):
        """The quantities by name; notes: texts, each in one note."""
        name, code, said = self.start(mesh, settings)
        check(code == 0, f"exit code {code}: {said}")
        n_notes = said.count("nacre: note:")
        check(n_notes == len(notes),
              f"{n_notes} notes, not {len(notes)}: {said}")
        for note in notes:
            check(note in said, f"{note!r} is not in: {said}")
        path = self.folder / "output" / f"{name}.csv"
        with open(path, newline="", encoding="utf-8") as file:
            row = list(csv.DictReader(file))[-1]
        return {key: float(row[key]) for key in row
                if key not in ("element", "eta", "solver") and row[key]}

    def bad(self, expect, mesh, settings=None):
        _, code, said = self.start(mesh, settings)
        check(code == 1, f"exit code {code} instead of 1: {said}")
        check(said.count("nacre: error:") == 1, f"not one message: {said}")
        for text in expect:
            check(text in said, f"{text!r} is not in: {said}")


def same(a, b, names=("w", "U"), tolerance=1e-10):
    for name in names:
        check(abs(a[name] - b[name]) <= tolerance * abs(b[name]),
              f"{name} = {a[name]!r} and {b[name]!r}")


def differs(a, b, name, least):
    check(abs(a[name] / b[name] - 1) >= least,
          f"{name} = {a[name]!r} and {b[name]!r} hardly differ")


# --- Which sets count ------------------------------------------------------
CLAMPED_ROUND = {EDGES: "boundary: clamped", "Loads/Force per area": "0, 0, -1",
                 QUANTITIES: "w = displacement z at (0.5, 0.5, 0); U = energy"}


def with_probe():
    mesh = Mesh()
    return mesh.node_set("Probe", mesh.where(lambda x, y: max(x, y) <= 0.5))


def case_set_takes_boundary(run):
    """A set that no condition or load names leaves 'boundary' whole."""
    plain = run.good(Mesh(), CLAMPED_ROUND)
    same(run.good(with_probe(), CLAMPED_ROUND), plain)
    # To look at something doesn't change it.
    looked_at = {QUANTITIES: CLAMPED_ROUND[QUANTITIES] +
                 "; R = reaction z of Probe"}
    same(run.good(with_probe(), CLAMPED_ROUND | looked_at), plain)


def case_condition_takes_boundary(run):
    """A set that a condition or a load names isn't in 'boundary'."""
    plain = run.good(Mesh(), CLAMPED_ROUND)
    mesh = Mesh()
    mesh.node_set("Free", mesh.where(lambda x, y: x == 1))
    free = run.good(mesh, CLAMPED_ROUND | {EDGES: "boundary: clamped; "
                                                  "Free: free"})
    differs(free, plain, "w", 0.1)
    same(run.good(mesh, CLAMPED_ROUND | {FORCES: "Free: 0, 0, 0"}), free)


def case_boundary_is_empty(run):
    run.bad(["no side is left for the edge 'boundary'", EDGES],
            plate(), {EDGES: "left, right, top, bottom: clamped; "
                             "boundary: free"})


def case_own_boundary(run):
    """A set of the file with the name 'boundary' is what it says."""
    plain = run.good(plate())
    same(run.good(Mesh().sides(left="boundary"), {EDGES: "boundary: clamped"},
                  ["'boundary' is the file's own set of that name, with 4 of "
                   "the 16 sides"]), plain)


def case_unused_sets(run):
    """Sets that overlap, that hold no side or nodes in no cell: no matter."""
    plain = run.good(plate())
    mesh = plate().cell_set("Some", [1, 2, 3]).cell_set("All", range(1, 17))
    mesh.cell_set("More", [3, 4, 5]).node_set("Nall", mesh.nodes)
    mesh.node_set("One", [1]).node_set("Inside", [7, 8])
    same(run.good(mesh), plain)


# --- Several names ---------------------------------------------------------
def two_names():
    """Left and bottom have names of their own and one together."""
    mesh = plate()
    return mesh.node_set("both", mesh.where(lambda x, y: x == 0 or y == 0))


def case_several_names(run):
    plain = run.good(plate(), {EDGES: "left, bottom: clamped"})
    same(run.good(two_names(), {EDGES: "both: clamped"}), plain)
    same(run.good(two_names(), {EDGES: "left, bottom: clamped"}), plain)
    # The same conditions by two names are no conflict.
    same(run.good(two_names(), {EDGES: "left, both: clamped"}), plain)
    same(run.good(two_names(), {EDGES: "both, bottom: clamped"}), plain)


def case_conflicts(run):
    run.bad([EDGES, "'both'", "the side between the nodes 1 and 6", "'left'",
             "other conditions"],
            two_names(), {EDGES: "left: clamped; both: z = 0"})
    for parameter, load in ((FORCES, "0, 0, 1"), (MOMENTS, "1")):
        run.bad([parameter, "'both'", "the side between the nodes 1 and 6",
                 "'left'", "a load already"],
                two_names(), {parameter: f"left: {load}; both: {load}"})


def case_loads_of_several_names(run):
    loads = {FORCES: "{}: 0, 0, 1e-6", MOMENTS: "{}: 1e-7"}
    settings = {EDGES: "right: clamped",
                QUANTITIES: "w = displacement z at (0, 0, 0); U = energy"}
    plain = run.good(plate(), settings | {
        name: load.format("left, bottom") for name, load in loads.items()})
    same(run.good(two_names(), settings | {
        name: load.format("both") for name, load in loads.items()}), plain)


def case_reaction_of_several_names(run):
    """One edge of two names holds what it holds under one, corners once."""
    settings = {EDGES: "both: clamped", QUANTITIES:
                "R = reaction z of both; M = moment x of both about (0, 0, 0)"}
    # Before there were several names: one name for the two sides.
    mesh = Mesh()
    mesh.node_set("both", mesh.where(lambda x, y: x == 0 or y == 0))
    plain = run.good(mesh, settings)
    same(run.good(two_names(), settings), plain, ("R", "M"))
    check(abs(plain["R"] - 1e-6) < 1e-14, f"R = {plain['R']!r}")


def case_plane_of_several_names(run):
    """The plane of a symmetric edge is that of the whole edge."""
    mesh = Mesh().sides(bottom="")
    for i in range(4):
        mesh.node_set(f"part{i}", [i + 1, i + 2])
    settings = {EDGES: "left: clamped; line: symmetry"}
    whole = mesh.where(lambda x, y: y == 0)
    same(run.good(mesh.node_set("line", whole), settings),
         run.good(Mesh().sides(bottom="line"), settings))


# --- Regions ---------------------------------------------------------------
def case_regions(run):
    """Cells of several names: a conflict only where both are used."""
    plain = run.good(plate().cell_set("thin", range(1, 9)),
                     {REGIONS: "thin: h = h/2"})
    mesh = plate().cell_set("thin", range(1, 9)).cell_set("all", range(1, 17))
    mesh.cell_set("odd", range(1, 17, 2))
    same(run.good(mesh, {REGIONS: "thin: h = h/2"}), plain)
    same(run.good(mesh, {REGIONS: "THIN: h = h/2"}), plain)
    run.bad([REGIONS, "cell 1 ", "'odd'", "'thin'"],
            mesh, {REGIONS: "thin: h = h/2; odd: E = 2*E"})
    run.bad([REGIONS, "unknown region 'tin'", "Did you mean 'thin'?", "odd"],
            mesh, {REGIONS: "tin: h = 1"})


def case_regions_of_one_value(run):
    mesh = plate().cell_set("low", range(1, 9)).cell_set("high", range(9, 17))
    same(run.good(mesh, {REGIONS: "low, high: h = h/2"}),
         run.good(mesh, {"Section/Thickness": "0.05"}))


# --- What is an edge -------------------------------------------------------
def lines_of(groups):
    """Two squares of gmsh with lines of groups: name -> pairs of nodes."""
    names = list(groups)
    nodes = ["0 0 0", "1 0 0", "2 0 0", "0 1 0", "1 1 0", "2 1 0"]
    elements = [f"1 2 {k + 1} 1 {pair}" for k, name in enumerate(names)
                for pair in groups[name]]
    elements += ["3 2 99 1 1 2 5 4", "3 2 99 1 2 3 6 5"]
    return "\n".join(
        ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames",
         str(len(names) + 1)] +
        [f'1 {k + 1} "{name}"' for k, name in enumerate(names)] +
        ['2 99 "shell"', "$EndPhysicalNames", "$Nodes", "6"] +
        [f"{k + 1} {x}" for k, x in enumerate(nodes)] +
        ["$EndNodes", "$Elements", str(len(elements))] +
        [f"{k + 1} {text}" for k, text in enumerate(elements)] +
        ["$EndElements", ""])


def case_line_groups(run):
    """Groups inside or partly inside: told where a parameter names them."""
    plain = run.good(lines_of({"left": ["1 4"]}))
    groups = {"left": ["1 4"], "inner": ["2 5"], "part": ["3 6", "5 2"],
              "none": ["1 5"]}
    same(run.good(lines_of(groups)), plain)
    run.bad(["unknown edge 'inner'", "Known: left, boundary",
             "'inner' lies inside of the surface"],
            lines_of(groups), {EDGES: "inner: clamped"})
    run.bad(["'part' is partly inside", "the line 4", "between two cells"],
            lines_of(groups), {EDGES: "part: clamped"})
    run.bad(["the line 5", "the nodes 1 and 5", "no side of a cell"],
            lines_of(groups), {EDGES: "none: clamped"})


def case_line_in_two_groups(run):
    groups = {"left": ["1 4"], "ends": ["1 4", "3 6"]}
    same(run.good(lines_of(groups), {EDGES: "ends: clamped"}),
         run.good(lines_of({"a": ["1 4"], "b": ["6 3"]}),
                  {EDGES: "a, b: clamped"}), ("U",))


def case_corners_only(run):
    """A set of corners names the sides between them; one with a middle does
    so where it has the middle."""
    full = run.good(Mesh(2, 2).sides())
    corners = Mesh(2, 2)
    corners.node_set("left", [k for k in corners.where(lambda x, y: x == 0)
                              if corners.nodes[k][1] in (0, 0.5, 1)])
    same(run.good(corners), full)
    mesh = Mesh(2, 2)
    left = mesh.where(lambda x, y: x == 0)
    run.bad(["unknown edge 'left'", "a set of nodes that holds both ends of no "
             "side"], mesh.node_set("left", left[:2]))


def case_nodes_off_the_sides(run):
    """A set in use whose nodes aren't all on its sides is told."""
    mesh = Mesh()
    left = mesh.where(lambda x, y: x == 0)
    same(run.good(mesh.node_set("left", [*left, 7, 5]), None,
                  ["2 of its 7 nodes lie on none of them, the first is the "
                   "node 5"]), run.good(plate()))


def case_unknown_label(run):
    """The reply shows the file's own names, near ones first."""
    mesh = plate().cell_set("leftmost", [1])
    run.bad(["unknown edge 'lefd'", "Did you mean 'left'?",
             "Known: ", "bottom", "right", "top", "boundary"],
            mesh, {EDGES: "lefd: clamped"})
    run.bad(["unknown edge 'leftmost'", "is a set of cells"],
            mesh, {EDGES: "leftmost: clamped"})
    same(run.good(mesh, {EDGES: "LEFT: clamped"}), run.good(plate()))


# --- Seams -----------------------------------------------------------------
def tube(gap, merged=False):
    """A tube of 6 x 1 cells whose last nodes are the first, or near them."""
    import math
    mesh = Mesh(1)
    mesh.nodes, mesh.cells = {}, {}
    for i in range(6 if merged else 7):
        angle = 2 * math.pi * i / 6 - (gap if i == 6 else 0)
        for j in range(2):
            mesh.nodes[2 * i + j + 1] = (math.cos(angle), math.sin(angle),
                                         2. * j)
    n = len(mesh.nodes)
    for i in range(6):
        a, b = 2 * i + 1, (2 * i + 2) % n + 1
        mesh.cells[i + 1] = [a, b, b + 1, a + 1]
    mesh.node_set("left", [k for k, x in mesh.nodes.items() if x[2] == 0])
    return mesh


TUBE = {"Mid-surface/file/Curvature": "cylinder",
        "Mid-surface/cylinder/Radius": "1",
        "Mid-surface/cylinder/Axial range": "0, 2",
        "Section/Young's modulus": "1e6", "Section/Thickness": "0.02",
        "Loads/Force per area": "-y, x, 0",
        QUANTITIES: "w = displacement y at (1, 0, 2); U = energy"}


def case_seam(run):
    """Nodes much nearer than their cells are large are told or merged."""
    merged = run.good(tube(0, True), TUBE)
    for gap in (0, 1e-7, 1e-4):
        run.bad(["the nodes 1 and 13 lie at the same place", "Merge distance",
                 "Slits"], tube(gap), TUBE)
        same(run.good(tube(gap), TUBE | {MERGE: "2e-4"},
                      ["2 nodes are merged with others at most 0.0002 away; "
                       "the first is the node 13, with the node 1."]), merged)
    # A gap that is meant to be one needs no word.
    run.good(tube(0.01), TUBE)


def case_slit(run):
    merged = run.good(tube(0, True), TUBE)
    slit = run.good(tube(1e-7),
                    TUBE | {SLITS: "allowed", QUANTITIES: "U = energy"},
                    ["2 pairs of nodes are taken as the lips of slits"])
    check(slit["U"] > 1.5 * merged["U"],
          f"U = {slit['U']!r} and {merged['U']!r}")


def case_seam_of_other_cells(run):
    """A node on a side that hasn't got it: cells of two sizes that don't
    fit, joined at their corners."""
    mesh = plate()
    n = len(mesh.nodes)
    mesh.nodes |= {n + 1: (2., 0., 0.), n + 2: (2., 1., 0.)}
    mesh.cells[17] = [5, n + 1, n + 2, 25]
    mesh.nodes |= {n + 3: (2., -1., 0.), n + 4: (1., -1., 0.),
                   n + 5: (0.75, -1., 0.)}
    mesh.cells[18] = [n + 4, n + 3, n + 1, 5]
    mesh.cells[19] = [n + 5, n + 4, 5, 4]
    run.bad(["node 10 at (1, 0.25, 0) lies on the side between the nodes 5 and "
             "25 of cell 17", "Slits"], mesh)
    run.good(mesh, {SLITS: "allowed", QUANTITIES: "U = energy"})


def case_merge_too_much(run):
    run.bad(["cell 1 ", "the nodes 1 and 3", "Merge distance",
             "smaller than the cells"], tube(1e-7), TUBE | {MERGE: "1.1"})
    run.bad([MERGE, "-1", "negative"], tube(1e-7), TUBE | {MERGE: "-1"})


# --- Checks ----------------------------------------------------------------
def case_unused_nodes(run):
    plain = run.good(plate())
    mesh = plate()
    mesh.nodes[100] = (5., 0., 0.)
    mesh.node_set("Tip", [100])
    same(run.good(mesh, None, ["node 100 at (5, 0, 0) belongs to no cell"]),
         plain)
    mesh.nodes[101] = (0., 0., 0.)
    same(run.good(mesh, None, ["2 nodes belong to no cell"]), plain)


def case_turned_over(run):
    plain = run.good(plate(), {"Loads/Pressure": "3e-6"})
    mesh = plate()
    for k in (3, 7):
        mesh.cells[k].reverse()
    same(run.good(mesh, {"Loads/Pressure": "3e-6"},
                  ["2 of 16 cells are turned over to the orientation of the "
                   "others; the first is cell 3."]), plain)


def case_collapsed(run):
    mesh = plate()
    mesh.cells[2][3] = mesh.cells[2][2]
    run.bad(["cell 2 is a quadrilateral with the node 8 twice",
             "a triangle", "one of them alone"], mesh)


def case_branch(run):
    mesh = plate()
    n = len(mesh.nodes)
    mesh.nodes |= {n + 1: (0.5, 0.25, 1.), n + 2: (0.5, 0.5, 1.)}
    mesh.cells[17] = [8, 13, n + 2, n + 1]
    run.bad(["between the nodes 8 and 13 is shared by 3 cells", "branch"], mesh)


def case_eight_nodes(run):
    """Files of 8-node cells do for elements of all kinds."""
    for settings in ({"Study/Degrees": "2"}, {"Study/Degrees": "3"},
                     {"Study/Degrees": "2",
                      "Discretization/Element": "serendipity"}):
        same(run.good(Mesh(2, 2).sides(), settings),
             run.good(Mesh(2, 1).sides(), settings), tolerance=1e-9)


def case_eight_and_nine_nodes(run):
    """An 8-node cell beside 9-node ones is one of them."""
    nodes = {1: "0 0 0", 2: "1 0 0", 3: "2 0 0", 4: "0 1 0", 5: "1 1 0",
             6: "2 1 0", 7: "0.5 0 0.1", 8: "1 0.5 0", 9: "0.5 1 0.1",
             10: "0 0.5 0", 11: "1.5 0 0.1", 12: "2 0.5 0", 13: "1.5 1 0.1",
             14: "1.5 0.5 0.1"}

    def text(centre):
        # The centre of an 8-node cell: half the middles, less a fourth of the
        # corners.
        second = "2 3 6 5 11 12 13 8"
        kind = "10 2 9 1 " + second + " 14" if centre else "16 2 9 1 " + second
        known = {k: x for k, x in nodes.items() if centre or k != 14}
        return "\n".join(
            ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes",
             str(len(known))] + [f"{k} {x}" for k, x in known.items()] +
            ["$EndNodes", "$Elements", "3", "1 8 2 1 1 1 4 10",
             "2 16 2 9 1 1 2 5 4 7 8 9 10", "3 " + kind, "$EndElements", ""])

    settings = {EDGES: "1: clamped", "Study/Degrees": "2"}
    same(run.good(text(True), settings), run.good(text(False), settings))


# --- Names in quotes -------------------------------------------------------
def case_quoted(run):
    plain = run.good(lines_of({"left": ["1 4"], "right": ["3 6"]}), {
        EDGES: "left: clamped; right: free", FORCES: "right: 0, 0, 1e-6",
        MOMENTS: "right: 1e-7", REGIONS: "shell: h = 0.05",
        QUANTITIES: "w = displacement z at (2, 0, 0); U = energy; "
                    "R = reaction z of left; M = moment y of left about "
                    "(0, 0, 0)"})
    groups = {"left, clamped": ["1 4"], "right: load; (all": ["3 6"]}
    left, right = ('"' + name + '"' for name in groups)
    mesh = lines_of(groups).replace('"shell"', '"a; shell: 1 -> 2"')
    same(run.good(mesh, {
        EDGES: f"{left}: clamped; {right}: free",
        FORCES: f"{right}: 0, 0, 1e-6",
        MOMENTS: f"{right}: 1e-7", REGIONS: '"a; shell: 1 -> 2": h = 0.05',
        QUANTITIES: "w = displacement z at (2, 0, 0); U = energy; "
                    f"R = reaction z of {left}; M = moment y of {left} about "
                    "(0, 0, 0)"}), plain, ("w", "U", "R", "M"))


def case_reply_in_quotes(run):
    """A reply gives names as they are to be written."""
    mesh = lines_of({"left, clamped": ["1 4"], "a; b": ["2 5"]})
    run.bad(["unknown edge 'left'", """Known: "left, clamped", boundary.""",
             """that are no edges: "a; b", """], mesh, {EDGES: "left: clamped"})


def case_quote_within(run):
    """A quote in a name is doubled; one alone is an error."""
    mesh = lines_of({'Left 5"': ["1 4"]})
    same(run.good(mesh, {EDGES: '"Left 5""": clamped'}),
         run.good(lines_of({"left": ["1 4"]})))
    run.bad([EDGES, "a quote '\"' without a second one"],
            mesh, {EDGES: '"left: clamped'})


CASES = {name[5:]: function for name, function in list(globals().items())
         if name.startswith("case_")}


def main():
    if sys.argv[1:] == ["--list"]:
        print("\n".join(CASES))
        return 0
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    nacre = Nacre(os.path.abspath(sys.argv[1]), int(sys.argv[2]))
    n_failed = 0
    for name in sys.argv[3:] or CASES:
        try:
            with tempfile.TemporaryDirectory(prefix="nacre_") as folder:
                CASES[name](Runner(nacre, Path(folder)))
            print(f"passed  {name}", flush=True)
        except Failure as failure:
            n_failed += 1
            print(f"FAILED  {name}: {failure}", flush=True)
    return 1 if n_failed else 0


if __name__ == "__main__":
    sys.exit(main())
