# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Mesh files that are wrong and what Nacre must say about them; bad_input.py
runs them, bad_input_cases.py tells what a case is."""
import math

BASE = """\
subsection Study
  set Degrees     = 2
  set Refinements = 0
end
subsection Mid-surface
  set Surface = file
  subsection file
    set File name = bad.msh
  end
end
subsection Boundary conditions
  set Edges = left: clamped
end
subsection Loads
  set Force per area = 0, 0, -0.01
end
subsection Quantities
  set Quantities = U = energy
end
"""

CASES = {}
NAME = "Mid-surface/file/File name"
# Two squares, the elements of gmsh: number, type, group, nodes
NODES = {1: "0 0 0", 2: "1 0 0", 3: "2 0 0",
         4: "0 1 0", 5: "1 1 0", 6: "2 1 0"}
LINE, TRIANGLE, QUAD, TETRAHEDRON, HEXAHEDRON, QUAD_9, QUAD_8 = (
    1, 2, 3, 4, 5, 10, 16)
LEFT = (7, LINE, 1, "1 4")
CELLS = ((11, QUAD, 2, "1 2 5 4"), (12, QUAD, 2, "2 3 6 5"))


def msh(nodes=None, elements=(LEFT, *CELLS)):
    nodes = nodes or NODES
    return "\n".join(
        ["$MeshFormat", "2.2 0 8", "$EndMeshFormat",
         "$PhysicalNames", "4", '1 1 "left"', '2 2 "shell"', '1 3 "right"',
         '2 4 "other"', "$EndPhysicalNames", "$Nodes", str(len(nodes))] +
        [f"{number} {x}" for number, x in nodes.items()] +
        ["$EndNodes", "$Elements", str(len(elements))] +
        [f"{number} {kind} 2 {group} 1 {points}"
         for number, kind, group, points in elements] + ["$EndElements", ""])


def case(name, expect, content=None, settings=None, file="bad.msh"):
    assert "mesh_" + name not in CASES, name
    folder = {} if content is None else {file: content}
    settings = dict(settings or {})
    if file != "bad.msh":
        settings[NAME] = file
    CASES["mesh_" + name] = dict(expect=expect, settings=settings, change=None,
                                 prm=BASE, args=[], folder=folder, code=1)


def wrong(name, expect, nodes=None, elements=(LEFT, *CELLS), settings=None):
    case(name, ["'bad.msh'", *expect], msh(nodes, elements), settings)


# --- The file --------------------------------------------------------------
case("missing", [NAME, "'bad.msh' doesn't exist"])
case("no_name", [NAME, "no file is named"], settings={NAME: ""})
case("folder", [NAME, "is a folder"], settings={NAME: "."})
case("empty", ["'bad.msh' is empty"], "")
case("blank", ["'bad.msh' is empty"], "\n  \n")
case("no_mesh", ["'bad.msh' isn't a mesh", "'Dear all,'", "gmsh", "Abaqus"],
     "Dear all,\nthe mesh follows.\n")
GOOD = msh()
case("truncated_nodes", ["'bad.msh', line 16", "node 4 of 6", "truncated"],
     GOOD[:GOOD.index("4 0 1 0") + 6])
case("truncated_elements",
     ["'bad.msh', line 24", "element 3 of 3", "truncated"],
     GOOD[:GOOD.index("12 3")])
case("truncated_end", ["'bad.msh'", "$EndElements", "truncated"],
     GOOD[:GOOD.index("$EndElements")])
case("no_elements", ["'bad.msh'", "no section $Elements"],
     GOOD[:GOOD.index("$Elements")])
case("too_many_nodes", ["'bad.msh', line 18", "where $EndNodes should be"],
     GOOD.replace("$Nodes\n6", "$Nodes\n5"))
case("not_a_number", ["'bad.msh', line 13", "'zero'", "a number"],
     GOOD.replace("1 0 0 0", "1 zero 0 0"))
case("gmsh_binary", ["'bad.msh'", "binary", "Mesh.Binary = 0"],
     GOOD.replace("2.2 0 8", "2.2 1 8"))
case("gmsh_version", ["'bad.msh'", "version 4.0", "2.2 and 4.1"],
     GOOD.replace("2.2 0 8", "4.0 0 8"))

# --- Nodes -----------------------------------------------------------------
for number in "nan", "inf":
    wrong("node_" + number,
          ["line 17", "the node 5", "y coordinate", "must be finite"],
          NODES | {5: f"1 {number} 0"})
wrong("node_twice", ["line 19", "the node 5 stands twice"],
      NODES | {"5 ": "1 1 0"})
wrong("nodes_at_one_place", ["the nodes 5 and 8 lie at the same place"],
      NODES | {8: "1 1.00000000001 0"},
      (LEFT, CELLS[0], (12, QUAD, 2, "2 3 6 8")))
wrong("node_unknown", ["the element 12", "the node 99", "doesn't define"],
      elements=(LEFT, CELLS[0], (12, QUAD, 2, "2 3 99 5")))

# --- Cells -----------------------------------------------------------------
wrong("no_cells", ["no cells"], elements=(LEFT,))
wrong("tetrahedron", ["the element 12", "tetrahedron", "surface"],
      elements=(CELLS[0], (12, TETRAHEDRON, 2, "2 3 6 5")))
wrong("hexahedron", ["the element 12", "hexahedron", "surface"],
      elements=(CELLS[0], (12, HEXAHEDRON, 2, "1 2 3 4 5 6 7 8")))
wrong("third_order", ["the element 12", "gmsh 36", "known are"],
      elements=(CELLS[0], (12, 36, 2, "1")))
wrong("mixed_shapes", ["cell 12 has 3 nodes", "cell 11 has 4"],
      elements=(LEFT, CELLS[0], (12, TRIANGLE, 2, "2 3 6"),
                (13, TRIANGLE, 2, "2 6 5")))
MIDDLES = NODES | {7: "1.5 0 0", 8: "2 0.5 0", 9: "1.5 1 0", 10: "1 0.5 0"}
wrong("mixed_degrees", ["cell 12 has 8 nodes", "cell 11 has 4"], MIDDLES,
      (LEFT, CELLS[0], (12, QUAD_8, 2, "2 3 6 5 7 8 9 10")))
wrong("repeated_node", ["cell 12", "the node 3 twice"],
      elements=(LEFT, CELLS[0], (12, QUAD, 2, "2 3 3 5")))
wrong("cell_twice", ["cell 13", "same corners as cell 12"],
      elements=(LEFT, *CELLS, (13, QUAD, 4, "3 6 5 2")))
wrong("zero_area", ["cell 12 is degenerate"],
      NODES | {3: "1 0.3 0", 6: "1 0.7 0"})
wrong("bow_tie", ["cell 12 is degenerate"],
      elements=(LEFT, CELLS[0], (12, QUAD, 2, "2 6 3 5")))
wrong("bow_tie_uneven", ["cell 12 is folded"], NODES | {6: "2 1.7 0"},
      (LEFT, CELLS[0], (12, QUAD, 2, "2 6 3 5")))
wrong("concave", ["cell 12 is folded"], NODES | {6: "1.2 0.2 0"})
EIGHT = {number: x for number, x in MIDDLES.items() if number not in (1, 4)}
ONE_OF_EIGHT = ((7, LINE, 1, "2 5"), (12, QUAD_8, 2, "2 3 6 5 7 8 9 10"))
wrong("middle_far_off", ["node 7 at (1.8, 0, 0)", "middle",
                         "the side between the nodes 2 and 3", "cell 12"],
      EIGHT | {7: "1.8 0 0"}, ONE_OF_EIGHT)
wrong("middles_in_wrong_order", ["node 8 at", "cell 12", "order"], EIGHT,
      (ONE_OF_EIGHT[0], (12, QUAD_8, 2, "2 3 6 5 8 7 9 10")))
wrong("centre_far_off", ["node 11 at (1.9, 0.5, 0)", "cell 12"],
      EIGHT | {11: "1.9 0.5 0"},
      (ONE_OF_EIGHT[0], (12, QUAD_9, 2, "2 3 6 5 7 8 9 10 11")))

# --- Topology --------------------------------------------------------------
wrong("three_cells", ["between the nodes 2 and 5", "shared by 3 cells",
                      "11, 12, 13"],
      NODES | {7: "1 0 1", 8: "1 1 1"},
      (LEFT, *CELLS, (13, QUAD, 2, "2 7 8 5")))
wrong("two_parts", ["several parts", "cell 11 and cell 13"],
      NODES | {7: "5 0 0", 8: "6 0 0", 9: "6 1 0", 10: "5 1 0"},
      (LEFT, *CELLS, (13, QUAD, 2, "7 8 9 10")))
wrong("connected_by_a_node_only", ["several parts", "cell 11 and cell 13"],
      NODES | {8: "3 1 0", 9: "3 2 0", 10: "2 2 0"},
      (LEFT, *CELLS, (13, QUAD, 2, "6 8 9 10")))


def moebius(n=12):
    nodes, cells = {}, []
    for i in range(n):
        u = 2 * math.pi * i / n
        for k, s in enumerate((-0.2, 0.2)):
            r = 1 + s * math.cos(u / 2)
            nodes[2 * i + k + 1] = (f"{r * math.cos(u)!r} {r * math.sin(u)!r} "
                                    f"{s * math.sin(u / 2)!r}")
        a, b = 2 * i + 1, 2 * i + 2
        c, d = (a + 2, b + 2) if i + 1 < n else (2, 1)
        cells.append((i + 1, QUAD, 2, f"{a} {c} {d} {b}"))
    return nodes, cells


wrong("moebius", ["one orientation", "Moebius", "cell "], *moebius())

# --- Groups ----------------------------------------------------------------
case("unknown_edge", ["Boundary conditions/Edges", "unknown edge 'lft'",
                      "Did you mean 'left'?", "boundary"],
     GOOD, {"Boundary conditions/Edges": "lft: clamped"})
wrong("line_is_no_side", ["the line 8", "nodes 1 and 5", "no side"],
      elements=(LEFT, (8, LINE, 1, "1 5"), *CELLS))
wrong("group_partly_inside", ["the group 'left'", "the line 8",
                              "between two cells"],
      elements=(LEFT, (8, LINE, 1, "2 5"), *CELLS))
wrong("line_in_two_groups",
      ["between the nodes 1 and 4", "'left'", "'right'", "other conditions"],
      elements=(LEFT, (8, LINE, 3, "1 4"), *CELLS),
      settings={"Boundary conditions/Edges": "left: clamped; right: free"})
case("group_inside_is_no_edge",
     ["unknown edge 'right'", "Known: left, boundary"],
     msh(elements=(LEFT, (8, LINE, 3, "2 5"), *CELLS)),
     {"Boundary conditions/Edges": "right: clamped"})
case("unknown_region",
     ["Section/Regions", "unknown region 'shel'", "'shell'?"],
     GOOD, {"Section/Regions": "shel: h = 1"})
for name, value, text in (("unknown_key", "shell: t = 1", "unknown value 't'"),
                          ("negative", "shell: h = -1", "must be positive"),
                          ("no_colon", "shell", "has no ':'"),
                          ("nu", "shell: nu = 0.6", "at most 0.5"),
                          ("twice", "shell: h = 1; shell: h = 2", "twice")):
    case("region_" + name, ["Section/Regions", text], GOOD,
         {"Section/Regions": value})
case("region_without_file", ["Section/Regions", "no region 'shell'"],
     settings={"Section/Regions": "shell: h = 1",
               "Mid-surface/Surface": "plate",
               "Boundary conditions/Edges": "u=0: clamped"})

# --- Curvature -------------------------------------------------------------
case("curvature_unknown",
     ["Mid-surface/file/Curvature", "'cylindre'", "'cylinder'"],
     GOOD, {"Mid-surface/file/Curvature": "cylindre"})
case("curvature_of_a_file",
     ["Mid-surface/file/Curvature", "'files'", "Known: file, flat"],
     GOOD, {"Mid-surface/file/Curvature": "files"})
case("curvature_far_off",
     ["'bad.msh'", "node 1 at (0, 0, 0)", "away from the surface 'sphere'",
      "Mid-surface/sphere"],
     GOOD, {"Mid-surface/file/Curvature": "sphere"})
case("triangles",
     ["Mid-surface/file", "triangles", "Discretization/Element",
      "quadrilaterals"],
     msh(elements=(LEFT, (11, TRIANGLE, 2, "1 2 5"), (12, TRIANGLE, 2, "1 5 4"),
                   (13, TRIANGLE, 2, "2 3 6"), (14, TRIANGLE, 2, "2 6 5"))))

# --- gmsh 4.1 --------------------------------------------------------------
MSH_4 = """\
$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "left"
2 2 "shell"
$EndPhysicalNames
$Entities
0 1 1 0
1 0 0 0 0 1 0 1 -1 0
1 0 0 0 2 1 0 1 2 0
$EndEntities
$Nodes
1 6 1 6
2 1 0 6
1
2
3
4
5
6
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
$EndNodes
$Elements
2 3 1 3
1 1 1 1
7 1 4
2 1 3 2
11 1 2 5 4
12 2 3 6 5
$EndElements
"""
case("gmsh4_truncated", ["'bad.msh', line 28", "node 6 of 6", "truncated"],
     MSH_4[:MSH_4.index("2 1 0\n$EndNodes")])
case("gmsh4_counts", ["'bad.msh'", "announces 7 nodes and holds 6"],
     MSH_4.replace("1 6 1 6", "1 7 1 6"))
case("gmsh4_solid", ["'bad.msh'", "the element 11", "tetrahedron"],
     MSH_4.replace("2 1 3 2\n", "3 1 4 2\n"))
case("gmsh4_unknown_edge", ["unknown edge 'lef'", "Did you mean 'left'?"],
     MSH_4, {"Boundary conditions/Edges": "lef: clamped"})

# --- VTK -------------------------------------------------------------------
VTK = """\
# vtk DataFile Version 3.0
two squares
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 6 double
0 0 0 1 0 0 2 0 0
0 1 0 1 1 0 2 1 0
CELLS 3 13
2 0 3
4 0 1 4 3
4 1 2 5 4
CELL_TYPES 3
3 9 9
CELL_DATA 3
SCALARS MaterialID int 1
LOOKUP_TABLE default
1 0 0
"""
for name, expect, old, new in (
        ("binary", ["must be text: ASCII"], "ASCII", "BINARY"),
        ("structured", ["STRUCTURED_GRID", "UNSTRUCTURED_GRID and POLYDATA"],
         "UNSTRUCTURED", "STRUCTURED"),
        ("solid", ["the element 2", "solid", "type 10"], "3 9 9", "3 9 10"),
        ("truncated_points", ["point 4 of 6", "truncated"],
         VTK[VTK.index(" 1 1 0 2 1 0"):], ""),
        ("truncated_cells", ["cell 2 of 3", "truncated"],
         VTK[VTK.index("4 1 2"):], ""),
        ("no_types", ["no CELL_TYPES"], VTK[VTK.index("CELL_TYPES"):], ""),
        ("few_points", ["line 7", "'2'", "more than it announces"],
         "POINTS 6", "POINTS 5"),
        ("unknown_point", ["the element 2", "the node 9"], "4 1 2 5",
         "4 1 9 5"),
        ("nodes_of_type", ["the element 1", "has 4 nodes", "has 3"], "3 9 9",
         "3 5 9"),
        ("few_groups", ["a value of MaterialID", "truncated"], "1 0 0\n",
         "1 0\n"),
        ("unknown_group", ["unknown edge 'left'", "Known: 1, boundary"], "",
         "")):
    assert old in VTK, name
    case("vtk_" + name, expect, VTK.replace(old, new), file="bad.vtk")

# --- Abaqus ----------------------------------------------------------------
ABAQUS = """\
*HEADING
two squares
*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 2, 0, 0
4, 0, 1
5, 1, 1
6, 2, 1
*ELEMENT, TYPE=S4R, ELSET=shell
11, 1, 2, 5, 4
12, 2, 3, 6, 5
*NSET, NSET=left
1, 4
"""
for name, expect, old, new in (
        ("solid", ["the element 11", "C3D4", "solid"], "S4R", "C3D4"),
        ("unknown_type", ["the element 11", "PLATE4"], "S4R", "PLATE4"),
        ("truncated", ["the element 12 has 2 nodes", "truncated"],
         ABAQUS[ABAQUS.index(" 6, 5"):], ""),
        ("no_elements", ["no elements", "*ELEMENT"],
         ABAQUS[ABAQUS.index("*ELEMENT"):], ""),
        ("no_type", ["*ELEMENT has no TYPE"], "TYPE=S4R, ", ""),
        ("unknown_edge", ["unknown edge 'left'", "Known: west, boundary"],
         "NSET=left", "NSET=west")):
    assert old in ABAQUS, name
    case("abaqus_" + name, expect, ABAQUS.replace(old, new), file="bad.inp")

# --- UCD -------------------------------------------------------------------
UCD = """\
# two squares
6 3 0 0 0
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
1 1 line 1 4
2 0 quad 1 2 5 4
3 0 quad 2 3 6 5
"""
for name, expect, old, new in (
        ("truncated_nodes", ["node 5 of 6", "truncated"],
         UCD[UCD.index("5 1 1"):], ""),
        ("truncated_cells", ["cell 3 of 3", "truncated"],
         UCD[UCD.index("3 0 quad"):], ""),
        ("cut_cell", ["the element 3", "'quad' with 2 nodes"], " 6 5\n", "\n"),
        ("solid", ["the element 3", "'tet'", "solid"], "3 0 quad", "3 0 tet"),
        ("unknown_group", ["unknown edge 'left'", "Known: 1, boundary"],
         "", "")):
    assert old in UCD, name
    case("ucd_" + name, expect, UCD.replace(old, new), file="bad.ucd")
