#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Make the mesh files of prm/meshes.

  make_meshes.py           write them
  make_meshes.py --check   compare them with what would be written
  make_meshes.py --folder FOLDER [--cells N]
                           write them elsewhere, the roofs with N x N cells
  make_meshes.py --cap ANGLE SECTOR FILE.msh
                           another cap: its half angle and its sector in degrees

A quarter of the Scordelis-Lo roof, x = (R sin u, v, R cos u), 0 <= u <= 40
degrees, 0 <= v <= L/2, in several formats, a strip folded twice, sectors of
spherical caps, and plates with slits.
"""

import argparse
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "prm" / "meshes"
RADIUS, LENGTH, ANGLE = 25., 50., 40.
# gmsh's type by the number of nodes of cells and of lines
GMSH_CELLS = {3: 2, 6: 9, 4: 3, 8: 16, 9: 10}
GMSH_LINES = {2: 1, 3: 8}
VTK_CELLS = {3: 5, 6: 22, 4: 9, 8: 23, 9: 28}
VTK_LINES = {2: 3, 3: 21}


class Mesh:
    """Nodes, cells and boundary lines; nodes are numbered from 1.

    Cells have their corners counterclockwise, then the middles of the sides
    from the first side on, then the centre: the order of all formats.
    """

    def __init__(self):
        self.nodes = []
        self.cells = []           # (group, nodes)
        self.lines = []           # (group, nodes)
        self.cell_groups = []     # names
        self.line_groups = []


def group(names, name):
    if name not in names:
        names.append(name)
    return names.index(name) + 1


def grid(lines_u, lines_v, position, edges, n_nodes, region=lambda i, j: None):
    """A mesh over a rectangle with mesh lines u and v.

    edges: names of u = begin, u = end, v = begin, v = end; None: no group.
    region: the name of the group of the cell (i, j).
    """
    second = n_nodes > 4
    step = 2 if second else 1

    def halves(lines):
        if not second:
            return list(lines)
        result = [lines[0]]
        for a, b in zip(lines, lines[1:]):
            result += [(a + b) / 2, b]
        return result

    u, v = halves(lines_u), halves(lines_v)
    mesh, number = Mesh(), {}
    for j, v_j in enumerate(v):
        for i, u_i in enumerate(u):
            if n_nodes == 8 and i % 2 and j % 2:
                continue
            mesh.nodes.append(position(u_i, v_j))
            number[i, j] = len(mesh.nodes)

    corners = [(0, 0), (step, 0), (step, step), (0, step)]
    middles = [(1, 0), (2, 1), (1, 2), (0, 1)] if second else []
    centre = [(1, 1)] if n_nodes == 9 else []
    for j in range(0, len(v) - 1, step):
        for i in range(0, len(u) - 1, step):
            name = region(i // step, j // step)
            mesh.cells.append((name and group(mesh.cell_groups, name) or 0,
                               [number[i + a, j + b]
                                for a, b in corners + middles + centre]))

    def add_line(name, points):
        if name:
            ends = [points[0], points[-1]] + points[1:-1]
            mesh.lines.append((group(mesh.line_groups, name),
                               [number[point] for point in ends]))

    last_u, last_v = len(u) - 1, len(v) - 1
    for j in range(0, last_v, step):
        for name, i in (edges[0], 0), (edges[1], last_u):
            add_line(name, [(i, j + k) for k in range(step + 1)])
    for i in range(0, last_u, step):
        for name, j in (edges[2], 0), (edges[3], last_v):
            add_line(name, [(i + k, j) for k in range(step + 1)])
    return mesh


def triangles(mesh, n):
    """Every 9-node cell of n x n cut into two 6-node triangles, along the
    diagonals that meet in every second vertex: as nacre cuts its own."""
    result = Mesh()
    result.nodes, result.lines = mesh.nodes, mesh.lines
    result.cell_groups = mesh.cell_groups
    result.line_groups = mesh.line_groups
    for k, (name, nodes) in enumerate(mesh.cells):
        a, b, c, d, ab, bc, cd, da, centre = nodes
        if (k % n + k // n) % 2 == 0:
            halves = [[a, b, c, ab, bc, centre], [a, c, d, centre, cd, da]]
        else:
            halves = [[a, b, d, ab, centre, da], [b, c, d, bc, cd, centre]]
        result.cells += [(name, half) for half in halves]
    return result


def text(numbers):
    """Doubles with all of their digits."""
    return " ".join(repr(number) for number in numbers)


# --- formats ------------------------------------------------------------------
def gmsh_names(mesh):
    names = [(1, i, name) for i, name in enumerate(mesh.line_groups, 1)]
    names += [(2, i, name) for i, name in enumerate(mesh.cell_groups, 1)]
    return (["$PhysicalNames", str(len(names))] +
            [f'{dim} {i} "{name}"' for dim, i, name in names] +
            ["$EndPhysicalNames"])


def gmsh_2(mesh):
    out = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"] + gmsh_names(mesh)
    out += ["$Nodes", str(len(mesh.nodes))]
    out += [f"{i} {text(x)}" for i, x in enumerate(mesh.nodes, 1)]
    out += ["$EndNodes", "$Elements", str(len(mesh.lines) + len(mesh.cells))]
    elements = [(GMSH_LINES, line) for line in mesh.lines]
    elements += [(GMSH_CELLS, cell) for cell in mesh.cells]
    for i, (types, (number, nodes)) in enumerate(elements, 1):
        # type, two tags: the group and the geometric entity
        out.append(f"{i} {types[len(nodes)]} 2 {number} {max(number, 1)} " +
                   " ".join(map(str, nodes)))
    return out + ["$EndElements"]


def gmsh_4(mesh):
    def bounds(nodes):
        points = [mesh.nodes[i - 1] for i in nodes]
        return text([min(x[c] for x in points) for c in range(3)] +
                    [max(x[c] for x in points) for c in range(3)])

    blocks = {}                  # (dimension, entity) -> list of nodes
    for dim, elements in (1, mesh.lines), (2, mesh.cells):
        for number, nodes in elements:
            blocks.setdefault((dim, number), []).append(nodes)
    n_nodes = len(mesh.nodes)
    out = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat"] + gmsh_names(mesh)
    counts = [sum(d == dim for d, _ in blocks) for dim in (1, 2)]
    out += ["$Entities", f"0 {counts[0]} {counts[1]} 0"]
    for (dim, number), lists in sorted(blocks.items()):
        groups = f"1 {number}" if number else "0"
        out.append(f"{number or 1} {bounds(sum(lists, []))} {groups} 0")
    out += ["$EndEntities", "$Nodes", f"1 {n_nodes} 1 {n_nodes}",
            f"2 1 0 {n_nodes}"]
    out += [str(i) for i in range(1, n_nodes + 1)]
    out += [text(x) for x in mesh.nodes]
    n_elements = len(mesh.lines) + len(mesh.cells)
    out += ["$EndNodes", "$Elements",
            f"{len(blocks)} {n_elements} 1 {n_elements}"]
    i = 0
    for (dim, number), lists in sorted(blocks.items()):
        types = GMSH_LINES if dim == 1 else GMSH_CELLS
        out.append(f"{dim} {number or 1} {types[len(lists[0])]} {len(lists)}")
        for nodes in lists:
            i += 1
            out.append(f"{i} " + " ".join(map(str, nodes)))
    return out + ["$EndElements"]


def vtk(mesh, title):
    elements = mesh.lines + mesh.cells
    types = ([VTK_LINES[len(nodes)] for _, nodes in mesh.lines] +
             [VTK_CELLS[len(nodes)] for _, nodes in mesh.cells])
    out = ["# vtk DataFile Version 3.0", title, "ASCII",
           "DATASET UNSTRUCTURED_GRID", f"POINTS {len(mesh.nodes)} double"]
    out += [text(x) for x in mesh.nodes]
    out.append(f"CELLS {len(elements)} "
               f"{sum(1 + len(nodes) for _, nodes in elements)}")
    out += [" ".join(map(str, [len(nodes)] + [i - 1 for i in nodes]))
            for _, nodes in elements]
    out += [f"CELL_TYPES {len(elements)}"] + list(map(str, types))
    numbers = [number for number, _ in mesh.lines] + [0] * len(mesh.cells)
    out += [f"CELL_DATA {len(elements)}", "SCALARS MaterialID int 1",
            "LOOKUP_TABLE default"] + list(map(str, numbers))
    return out


def ucd(mesh, title):
    out = [f"# {title}",
           f"{len(mesh.nodes)} {len(mesh.lines) + len(mesh.cells)} 0 0 0"]
    out += [f"{i} {text(x)}" for i, x in enumerate(mesh.nodes, 1)]
    elements = [(number, "line", nodes) for number, nodes in mesh.lines]
    elements += [(0, "quad", nodes) for _, nodes in mesh.cells]
    out += [f"{i} {number} {name} " + " ".join(map(str, nodes))
            for i, (number, name, nodes) in enumerate(elements, 1)]
    return out


def abaqus(mesh, title, kind):
    """Edges as sets of nodes, as a preprocessor writes them."""
    out = ["*HEADING", title, "*NODE"]
    out += [f"{i}, " + ", ".join(map(repr, x))
            for i, x in enumerate(mesh.nodes, 1)]
    out.append(f"*ELEMENT, TYPE={kind}, ELSET={mesh.cell_groups[0]}")
    out += [f"{i}, " + ", ".join(map(str, nodes))
            for i, (_, nodes) in enumerate(mesh.cells, 1)]
    for number, name in enumerate(mesh.line_groups, 1):
        nodes = sorted({i for k, line in mesh.lines if k == number
                        for i in line})
        out.append(f"*NSET, NSET={name}")
        out += [", ".join(map(str, nodes[i:i + 10]))
                for i in range(0, len(nodes), 10)]
    return out


# --- meshes -------------------------------------------------------------------
def roof(n_cells, n_nodes):
    def position(u, v):
        angle = u * (math.pi / 180.)
        return (RADIUS * math.sin(angle), v, RADIUS * math.cos(angle))

    def lines(end):
        return [(1. - i / n_cells) * 0. + i / n_cells * end
                for i in range(n_cells + 1)]

    return grid(lines(ANGLE), lines(LENGTH / 2), position,
                ("crown", "eaves", "end", "middle"), n_nodes,
                lambda i, j: "roof")


def folded_strip():
    """Legs of lengths 2, 1, 1: along x, up, and back along -x."""
    def position(u, v):
        return (min(u, 2.) - max(u - 3., 0.), v, min(max(u - 2., 0.), 1.))

    return grid([i / 2 for i in range(9)], [0., 0.25],
                position, ("clamp", "tip", None, None), 4,
                lambda i, j: "base" if i < 4 else "wall" if i < 6 else "lid")


def cap(half_angle, sector=90., radius=1., n=2):
    """A sector of a cap of a sphere about z: three patches, n x n."""
    mesh, number = Mesh(), {}

    def blend(corners, u, v):
        weights = (1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v
        return [sum(w * x[c] for w, x in zip(weights, corners))
                for c in (0, 1)]

    def outer(u, v, mirrored):
        angle = v * math.pi / 4
        inside = blend([(0.5, 0), (0.5, 0), (0.4, 0.4), (0.4, 0.4)], u, v)
        x, y = [a + u * (b - a) for a, b in
                zip(inside, (math.cos(angle), math.sin(angle)))]
        return (y, x) if mirrored else (x, y)

    patches = (lambda u, v: blend([(0, 0), (0.5, 0), (0.4, 0.4), (0, 0.5)],
                                  u, v),
               lambda u, v: outer(u, v, False), lambda u, v: outer(v, u, True))

    def node(patch, i, j):
        x, y = patch(i / (2 * n), j / (2 * n))
        r = math.hypot(x, y) * math.radians(half_angle)
        around_z = math.atan2(y, x) * sector / 90.
        position = (radius * math.sin(r) * math.cos(around_z),
                    radius * math.sin(r) * math.sin(around_z),
                    radius * math.cos(r))
        key = tuple(round(c, 9) for c in position)
        if key not in number:
            mesh.nodes.append(position)
            number[key] = len(mesh.nodes)
        return number[key]

    def line(name, points):
        mesh.lines.append((group(mesh.line_groups, name),
                           [points[0], points[2], points[1]]))

    around = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1),
              (1, 1))
    for p, patch in enumerate(patches):
        for j in range(0, 2 * n, 2):
            for i in range(0, 2 * n, 2):
                mesh.cells.append((group(mesh.cell_groups, "cap"),
                                   [node(patch, i + a, j + b)
                                    for a, b in around]))
        for i in range(0, 2 * n, 2):
            along_u = [node(patch, i + k, 0) for k in range(3)]
            along_v = [node(patch, 0, i + k) for k in range(3)]
            if p != 2:
                line("begin", along_u)
            if p != 1:
                line("end", along_v)
            if p == 1:
                line("rim", [node(patch, 2 * n, i + k) for k in range(3)])
            if p == 2:
                line("rim", [node(patch, i + k, 2 * n) for k in range(3)])
    return mesh


def graded(length, size, n_equal, growth):
    """Distances from 0 to length: n_equal cells of the size or a little more,
    then each larger by the growth."""
    result, step = [0.], size
    while result[-1] < length:
        result.append(result[-1] + step)
        if len(result) > n_equal:
            step *= growth
    return [x / result[-1] * length for x in result]


def around(tips, begin, end, *grading):
    """Lines from begin to end, graded from the tips, in ascending order."""
    lines = [tips[0] - x for x in graded(tips[0] - begin, *grading)]
    for a, b in zip(tips, tips[1:]):
        half = graded((b - a) / 2, *grading)
        lines += [a + x for x in half] + [b - x for x in half]
    lines += [tips[-1] + x for x in graded(end - tips[-1], *grading)]
    return sorted(set(lines))


def cracked(width, height, tips, size, growth=1.5, n_equal=4,
            position=lambda u, v: (u, v, 0.)):
    """A sheet begin <= u <= end, |v| <= height with a slit at v = 0, between
    two tips or from u = begin to one; edges left, right, bottom, top, and the
    lips lower and upper."""
    begin, end = width
    grading = size, n_equal, growth
    u = around(tips, begin, end, *grading)
    half = graded(height, *grading)
    v = [-y for y in half[:0:-1]] + half
    mesh = grid(u, v, position, ("left", "right", "bottom", "top"), 4)

    first = u.index(tips[0]) if len(tips) == 2 else 0
    last = u.index(tips[-1])
    row = (len(half) - 1) * len(u) + 1  # the node at u = begin, v = 0
    lower = range(row + first, row + last + 1)
    twins = {}
    for node in lower:
        if node != lower[-1] and not (len(tips) == 2 and node == lower[0]):
            mesh.nodes.append(mesh.nodes[node - 1])
            twins[node] = len(mesh.nodes)

    def above(nodes):
        return [twins.get(node, node) for node in nodes]

    n = len(mesh.cells) // 2
    mesh.cells[n:] = [(name, above(nodes)) for name, nodes in mesh.cells[n:]]
    for k, (name, nodes) in enumerate(mesh.lines):
        if min(nodes) == row and max(nodes) > row + last:
            mesh.lines[k] = name, above(nodes)
    for name, side in ("lower", list(lower)), ("upper", above(lower)):
        number = group(mesh.line_groups, name)
        mesh.lines += [(number, [a, b]) for a, b in zip(side, side[1:])]
    return mesh


def cracked_cylinder():
    """Of the radius 1 about x, the crack half as long as sqrt(h R) for h =
    R/100 or so."""
    a = 0.1 / 10.92**0.25
    return cracked((0., 1.), math.pi, [a], a / 6, 2.2, 3,
                   lambda u, v: (u, math.sin(v), math.cos(v)))


def files(n_cells):
    title = "A quarter of the Scordelis-Lo roof"
    q9, q8 = roof(n_cells, 9), roof(n_cells, 8)
    return {"roof_v2.msh": gmsh_2(q9),
            "roof_v4.msh": gmsh_4(q9),
            "roof_8_nodes.msh": gmsh_2(q8),
            "roof.vtk": vtk(q9, title),
            "roof_abaqus.inp": abaqus(q8, title, "S8R"),
            "roof.ucd": ucd(q8, title),
            "roof_first_order.msh": gmsh_4(roof(n_cells, 4)),
            "roof_triangles.msh": gmsh_2(triangles(q9, n_cells)),
            "strip.msh": gmsh_4(folded_strip()),
            "cap_6.msh": gmsh_2(cap(18.998073)),
            "cap_8.msh": gmsh_2(cap(25.422925, 45.)),
            "cap_30.msh": gmsh_2(cap(30.)),
            "cap_dynamic.msh": gmsh_2(cap(26.67, radius=22.27)),
            "cracked_plate.msh": gmsh_2(cracked((0., 1.), 1., [0.5], 1 / 16,
                                                2., 3)),
            "cracked_cylinder.msh": gmsh_2(cracked_cylinder())}


def agree(old, new):
    """Equal but for the last digits: sines differ between machines."""
    old_words, new_words = old.split(), new.split()
    if len(old_words) != len(new_words):
        return False
    for a, b in zip(old_words, new_words):
        if a != b:
            try:
                if abs(float(a.strip(",")) - float(b.strip(","))) > 1e-12:
                    return False
            except ValueError:
                return False
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--folder", type=pathlib.Path, default=FOLDER)
    parser.add_argument("--cells", type=int, default=4)
    parser.add_argument("--cap", nargs=3, metavar=("ANGLE", "SECTOR", "FILE"))
    arguments = parser.parse_args()
    if arguments.cap:
        half_angle, sector, file = arguments.cap
        lines = gmsh_2(cap(float(half_angle), float(sector)))
        pathlib.Path(file).write_text("\n".join(lines) + "\n",
                                      encoding="utf-8")
        return 0
    wrong = 0
    for name, lines in files(arguments.cells).items():
        path, content = arguments.folder / name, "\n".join(lines) + "\n"
        if not arguments.check:
            path.write_text(content, encoding="utf-8")
        elif not path.exists() or not agree(path.read_text(encoding="utf-8"),
                                            content):
            print(f"{path} isn't what make_meshes.py makes")
            wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
