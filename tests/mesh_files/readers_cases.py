# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Mesh files as people bring them; readers.py runs them.

GOOD: files of the same two squares, x from 0 to 2, clamped at x = 0. BAD: files
that are refused, with words of the message. A case is a dictionary with
  files     name: content (text, or bytes); the first is the mesh
  edges     the name of the clamped edge
  settings  further parameters
  notes     words that the notes must hold, a list for each note; no other
            notes are allowed
  expect    BAD: words of the message
  ranks     1, or (1, 2)
"""

GOOD, BAD = {}, {}
NODES = """\
1, 0, 0, 0
2, 1, 0, 0
3, 2, 0, 0
4, 0, 1, 0
5, 1, 1, 0
6, 2, 1, 0
"""
CELLS = """\
1, 1, 2, 5, 4
2, 2, 3, 6, 5
"""
ROOT = "*NSET, NSET=Root\n1, 4\n"
MESH = f"*NODE\n{NODES}*ELEMENT, TYPE=S4R, ELSET=SHELL\n{CELLS}"
DECK = MESH + ROOT


def good(name, content, edges="Root", notes=(), files=None, settings=None,
         ranks=(1,)):
    GOOD[name] = dict(files={"mesh.inp": content, **(files or {})},
                      edges=edges, notes=notes, settings=settings or {},
                      ranks=ranks)


def bad(name, content, *expect, files=None, ranks=(1,), mesh="mesh.inp"):
    BAD[name] = dict(files={mesh: content, **(files or {})}, edges="Root",
                     settings={}, expect=expect, ranks=ranks)


# --- Text ------------------------------------------------------------------
good("plain", DECK)
good("byte_order_mark", b"\xef\xbb\xbf" + DECK.encode(), ranks=(1, 2))
good("carriage_returns", DECK.replace("\n", "\r\n").encode())
good("carriage_returns_alone", DECK.replace("\n", "\r").encode())
good("comments_and_blank_lines",
     "** a comment\n\n" + DECK.replace("*ELEMENT", "\n** another\n*ELEMENT"))
good("quoted_labels", DECK.replace("NSET=Root", 'NSET="my root, left"')
     .replace("ELSET=SHELL", 'ELSET="all of it"'),
     edges='"my root, left"')
good("any_case", """\
*Node, nset=nall
""" + NODES + """\
*Element, type=s4r, elset=Panel
""" + CELLS + """\
*Nset, Nset=root
1, 4
*Elset, elset=Outer
2
*Elset, elset=Load
OUTER
""", edges="ROOT")
good("keyword_goes_on", DECK.replace("*ELEMENT, TYPE", "*ELEMENT,\n TYPE"))
good("comma_behind_a_keyword", DECK.replace("NSET=Root", "NSET=Root,"))

# --- Nodes -----------------------------------------------------------------
good("blank_coordinates", DECK.replace(NODES, """\
1, 0, 0, 0
2, 1, , 0
3, 2
4, , 1., ,
5, 1, 1
6, 2, 1, 0, 
"""))
good("only_a_number", DECK.replace("1, 0, 0, 0\n", "1\n"))
good("normals_behind", DECK.replace("5, 1, 1, 0", "5, 1, 1, 0, 0, 0, 1"))
good("several_blocks", DECK.replace("4, 0, 1, 0\n", "4, 0, 1, 0\n*NODE, "
                                    "NSET=later\n2, 1, 0, 0\n"))
good("system_in_one_line", "*SYSTEM\n0., 0., 0., 0., 1., 0., -1., 0., 0.\n" +
     DECK.replace(NODES, """\
1, 0, 0, 0
2, 0, -1, 0
3, 0, -2, 0
4, 1, 0, 0
5, 1, -1, 0
6, 1, -2, 0
"""), notes=[["*SYSTEM", "6 nodes"]])
# the local axes x, y are y, z, the origin is (1, 2, 3)
good("system_in_two_lines", DECK.replace("*NODE\n" + NODES, """\
*SYSTEM
1, 2, 3, 1, 4, 3
1, 2, 8
*NODE
1, -2, -3, -1
2, -2, -3, 0
*SYSTEM
1, 2, 3
*NODE
3, 1, -2, -3
*SYSTEM
*NODE
4, 0, 1, 0
*NODE, SYSTEM=C
5, 1.4142135623730951, 45
*NODE
6, 2, 1, 0
"""), notes=[["*SYSTEM", "3 nodes"], ["1 nodes", "cylindrical"]])
good("transform_moves_nothing", DECK.replace(
    "*ELEMENT", "*TRANSFORM, NSET=x, TYPE=C\n0, 0, 0, 0, 0, 1\n*ELEMENT"))

# --- Sets ------------------------------------------------------------------
good("sets_overlap", DECK + """\
*ELSET, ELSET=Panel
1
*ELSET, ELSET=_Pressure_SPOS, INTERNAL
1
*NSET, NSET=West
1, 4
*SURFACE, TYPE=ELEMENT, NAME=Pressure
_Pressure_SPOS, SPOS
""")
good("generate", MESH + """\
*NSET, NSET=Root, GENERATE
1, 4, 3
*NSET, NSET=Out, GENERATE
1, 999999999999
*ELSET, ELSET=Out, GENERATE
1, 4
""", notes=[["'Out'", "doesn't define", "7 and 999999999994 more"]])
good("undefined_members", DECK + """\
*NSET, NSET=Probe
3, 77, Nowhere
""", notes=[["'Probe'", "77 and 1 more", "doesn't define"]])
good("sets_of_sets", MESH + """\
*NSET, NSET=Root
Lower, Upper
*NSET, NSET=Lower
1
*NSET, NSET=Upper
4
*NSET, NSET=Circle
Circle, 6
""")
good("nodes_of_elements", MESH + """\
*NSET, NSET=Root, ELSET=Stiff
*ELEMENT, TYPE=B31, ELSET=Stiff
3, 1, 4
""", notes=[["1 element ", "B31 (beams)", "stiffness"]])
good("lines_name_an_edge", MESH + """\
*ELEMENT, TYPE=T3D2, ELSET=Root
3, 1, 4
""", notes=[["1 element ", "T3D2 (trusses)", "stiffness"]])
good("lines_partly_inside", MESH + """\
*ELEMENT, TYPE=B31, ELSET=B31
11, 1, 4
12, 2, 5
13, 3, 6
*ELSET, ELSET=Root
11
""", notes=[["3 elements ", "B31 (beams)", "stiffness"]])

# --- Elements --------------------------------------------------------------
good("plane_elements", DECK.replace("S4R, ELSET=SHELL", "CAX4P"))
good("rigid_elements_alone", DECK.replace("S4R, ELSET=SHELL", "R3D4"))
good("others_are_left_out", DECK + """\
*ELEMENT, TYPE=SPRINGA, ELSET=Bed
11, 2, 5
12, 3, 6
*SPRING, ELSET=Bed

100.
*ELEMENT, TYPE=MASS
13, 6
*ELEMENT, TYPE=DASHPOTA
14, 3, 6
*ELEMENT, TYPE=F3D4
15, 1, 2, 5, 4
*ELEMENT, TYPE=R3D4
16, 1, 2, 5, 4
*ELEMENT, TYPE=SFM3D4
19, 1, 2, 5, 4
*ELEMENT, TYPE=CONN3D2
17, 5, 6
*ELEMENT, TYPE=GAPUNI
18, 2, 6
*NSET, NSET=Held, ELSET=Bed
*TIE, NAME=a
b, c
""", notes=[["2 elements ", "SPRINGA (springs)"],
                  ["1 element ", "MASS (masses)"],
            ["1 element ", "DASHPOTA (dashpots)"],
            ["1 element ", "F3D4 (fluid elements)"],
            ["1 element ", "R3D4 (rigid elements)"],
            ["1 element ", "SFM3D4 (surface elements without stiffness)"],
            ["1 element ", "CONN3D2 (connectors)"],
            ["1 element ", "GAPUNI (gaps)"], ["constraints", "*TIE"]],
     ranks=(1, 2))

# --- Surfaces --------------------------------------------------------------
good("sides_of_a_set", MESH + """\
*SURFACE, NAME=Root
Left, E4
*ELSET, ELSET=Left
1
""")
good("sides_of_elements", MESH + "*SURFACE, NAME=Root, TYPE=ELEMENT\n1, e4\n")
good("sides_of_plane_elements", MESH.replace("S4R", "CPS4R") +
     "*SURFACE, NAME=Root\n1, S4\n")
good("sides_of_calculix", MESH + "*SURFACE, NAME=Root\n1, S6\n")
good("nodes_as_a_surface", DECK.replace("=Root", "=Left") +
     "*SURFACE, NAME=Root, TYPE=NODE\nLeft, 1.\n")
good("surface_with_the_name_of_sets", MESH.replace("=SHELL", "=ROOT") + """\
*NSET, NSET=root
3
*SURFACE, NAME=Root
1, E4
""")
good("faces_that_are_not", MESH + """\
*SURFACE, NAME=Root
1, E4
2, E7
*SURFACE, NAME=Tool, TYPE=CYLINDER
START, 0, 0
""", notes=[["'Tool'"], ["E7"]])
# turned over to the majority: its sides keep their names
good("sides_of_turned_cells", MESH.replace("1, 1, 2, 5, 4", "1, 4, 5, 2, 1") +
     "3, 3, 7, 8, 6\n*NODE\n7, 3, 0, 0\n8, 3, 1, 0\n" +
     "*SURFACE, NAME=Root\n1, E4\n", settings={"three": True},
     notes=[["turned"]])

# --- Parts -----------------------------------------------------------------
PART = "*PART, NAME=Plate\n{}*END PART\n"
ASSEMBLY = """\
*ASSEMBLY, NAME=Assembly
*INSTANCE, NAME=Plate-1, PART=PLATE
{}*END INSTANCE
{}*END ASSEMBLY
"""
SET = "*NSET, NSET=Root, INSTANCE=plate-1\n1, 4\n"
good("part_alone", PART.format(DECK))
good("assembly", PART.format(MESH) + ASSEMBLY.format("", SET), ranks=(1, 2))
good("sides_in_the_assembly", PART.format(MESH) + ASSEMBLY.format("", """\
*ELSET, ELSET=_Root_E4, INTERNAL, INSTANCE=Plate-1
1
*SURFACE, TYPE=ELEMENT, NAME=Root
_Root_E4, E4
"""))
good("set_of_the_part", PART.format(DECK) + ASSEMBLY.format("", ""))
good("set_by_instance", PART.format(DECK) + ASSEMBLY.format(
    "", "*NSET, NSET=Left\nPlate-1.Root\n"), edges="Left")
good("node_by_instance", PART.format(MESH) + ASSEMBLY.format(
    "", "*NSET, NSET=Root\nPlate-1.1, Plate-1.4\n"))
# the assembly has a set of the same name: the part's goes by its full name
good("hidden_set", PART.format(DECK) + ASSEMBLY.format(
    "", "*NSET, NSET=Root, INSTANCE=Plate-1\n3, 6\n"), edges="Plate-1.Root")
good("reference_point", PART.format(MESH) + ASSEMBLY.format(
    "", "*NODE\n1, 3, 0.5, 0\n*NSET, NSET=RP\n1,\n" + SET),
     notes=[["node 1 at (3, 0.5, 0)", "no cell"]])
MOVED = """\
1, -5, 1, 0.5
2, -4, 1, 0.5
3, -3, 1, 0.5
4, -5, 2, 0.5
5, -4, 2, 0.5
6, -3, 2, 0.5
"""
good("moved", PART.format(DECK.replace(NODES, MOVED)) +
     ASSEMBLY.format("5, -1, -0.5\n", ""))
# 90 degrees about the axis through (1, 0, 0) along z, after a translation
TURNED = """\
1, 1, 1, -3
2, 1, 0, -3
3, 1, -1, -3
4, 2, 1, -3
5, 2, 0, -3
6, 2, -1, -3
"""
good("turned", PART.format(DECK.replace(NODES, TURNED)) +
     ASSEMBLY.format("0, 0, 3\n1, 0, 0, 1, 0, 2, 90\n", ""))
HALF = """\
*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 0, 1, 0
4, 1, 1, 0
*ELEMENT, TYPE=S4, ELSET=All
1, 1, 2, 4, 3
*NSET, NSET=Left
1, 3
"""
good("two_instances", PART.format(HALF) + """\
*ASSEMBLY, NAME=Assembly
*INSTANCE, NAME=A, PART=Plate
*END INSTANCE
*INSTANCE, NAME=B, PART=Plate
1, 0, 0
*END INSTANCE
*END ASSEMBLY
""", edges="A.Left", settings={"Mid-surface/file/Merge distance": "1e-6",
                               "Section/Regions": "B: h = h; a.all: h = h"},
     notes=[["2 "]], ranks=(1, 2))
good("unused_part", PART.format(DECK) + "*PART, NAME=Tool\n*NODE\n1, 0, 0, 9\n"
     "*END PART\n" + ASSEMBLY.format("", ""), notes=[["'Tool'", "no instance"]])
good("instance_without_part", "*ASSEMBLY, NAME=a\n*INSTANCE, NAME=I\n" + DECK +
     "*END INSTANCE\n*END ASSEMBLY\n")

# --- Further files ---------------------------------------------------------
good("include", DECK.replace(NODES, "*INCLUDE, INPUT=sub/nodes.txt\n")
     .replace(CELLS, ""),
     files={"sub/nodes.txt": "\ufeff" + NODES + "*include, input=rest.txt\n",
            "sub/rest.txt": "*ELEMENT, TYPE=S4\n" + CELLS}, ranks=(1, 2))
# written on Windows
good("include_in_windows_names", DECK.replace(
    NODES, "*INCLUDE, INPUT=.\\Sub\\NODES.txt\n").replace(CELLS, ""),
     files={"sub/nodes.TXT": NODES + "*include, input=Rest.txt\n",
            "sub/rest.txt": "*ELEMENT, TYPE=S4\n" + CELLS}, ranks=(1, 2))
good("node_input", DECK.replace("*NODE\n" + NODES,
                                "*NODE, INPUT=nodes.txt\n"),
     files={"nodes.txt": NODES})

# --- Collapsed quadrilaterals ----------------------------------------------
TRIANGLES = "1, 1, 2, 5\n2, 1, 5, 4\n3, 2, 3, 6\n4, 2, 6, 5\n"
COLLAPSED = "1, 1, 2, 5, 5\n2, 1, 1, 5, 4\n3, 3, 6, 2, 2\n4, 6, 5, 2, 6\n"
good("triangles", MESH.replace("S4R", "S3").replace(CELLS, TRIANGLES) + ROOT,
     settings={"Discretization/Element": "triangle"})
good("all_are_collapsed", MESH.replace(CELLS, COLLAPSED) +
     "*SURFACE, NAME=Root\n2, E4\n2, E1\n",
     settings={"Discretization/Element": "triangle"},
     notes=[["taken as triangles"]])



def middles(cells):
    """The cells with middles of their sides, and the nodes of these."""
    places = {int(number): [float(x) for x in rest]
              for number, *rest in (line.split(",")
                                    for line in NODES.splitlines())}
    nodes, lines = {}, []
    for line in cells.splitlines():
        number, *corners = (int(word) for word in line.split(","))
        ends = list(zip(corners, corners[1:] + corners[:1]))
        sides = [a if a == b else 10 * min(a, b) + max(a, b) for a, b in ends]
        for (a, b), side in zip(ends, sides):
            if a != b:
                nodes[side] = [(x + y) / 2 for x, y in
                               zip(places[a], places[b])]
        lines.append(", ".join(map(str, [number, *corners, *sides])) + "\n")
    return ("".join(f"{number}, {x}, {y}, {z}\n"
                    for number, (x, y, z) in nodes.items()), "".join(lines))


MIDDLES, COLLAPSED_8 = middles(COLLAPSED)
good("all_of_8_nodes_are_collapsed",
     DECK.replace(NODES, NODES + MIDDLES).replace("S4R", "S8R")
     .replace(CELLS, COLLAPSED_8),
     settings={"Discretization/Element": "triangle"},
     notes=[["taken as triangles"]])

# --- gmsh ------------------------------------------------------------------
GMSH = """\
$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
5
0 5 "corner"
1 1 "Root"
1 2 "Left"
2 3 "shell"
2 4 "inner"
$EndPhysicalNames
$Nodes
6
""" + NODES.replace(",", "") + """\
$EndNodes
$Elements
6
1 15 2 5 1 1
2 1 2 1 1 1 4
3 1 2 2 1 4 1
4 3 2 3 1 1 2 5 4
5 3 2 4 1 1 2 5 4
6 3 2 3 2 2 3 6 5
$EndElements
"""
good("gmsh_2_groups", GMSH)
good("gmsh_2_other_group", GMSH, edges="Left",
     settings={"Section/Regions": "inner: h = h"})
GMSH_4 = """\
$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
1 1 "Root"
1 2 "Left"
2 3 "shell"
$EndPhysicalNames
$Entities
0 1 1 0
1 0 0 0 0 1 0 2 1 -2 0
1 0 0 0 2 1 0 1 3 0
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
good("gmsh_4_groups", GMSH_4)
good("gmsh_4_other_group", GMSH_4, edges="Left")
# as gmsh -part 2 writes it: a curve and two halves of the surface
GMSH_PARTITIONED = GMSH_4.replace("$Nodes", """\
$PartitionedEntities
2
1
9 1
0 1 2 0
5 1 1 1 1 0 0 0 0 1 0 2 1 -2 0
2 2 1 1 1 0 0 0 1 1 0 1 3 1 5
3 2 1 1 2 1 0 0 2 1 0 1 3 0
$EndPartitionedEntities
$Nodes""").replace("2 3 1 3\n1 1", "3 3 1 12\n1 5").replace(
    "2 1 3 2\n", "2 2 3 1\n").replace("12 2", "2 3 3 1\n12 2")
good("gmsh_4_partitioned", GMSH_PARTITIONED,
     settings={"Section/Regions": "shell: h = h"})
good("gmsh_windows", ("\ufeff" + GMSH_4.replace("\n", "\r\n")).encode())

# --- What is refused -------------------------------------------------------
bad("utf_16", DECK.encode("utf-16"), "'mesh.inp'", "UTF-16", "UTF-8",
    ranks=(1, 2))
bad("utf_16_without_mark", DECK.encode("utf-16-le"), "UTF-16", "UTF-8")
bad("nastran", "$ Nastran bulk data\nSOL 101\nBEGIN BULK\n"
    "GRID    1               0.0     0.0     0.0\nENDDATA\n",
    "'mesh.inp'", "Nastran", "gmsh FILE -save -format msh2", ranks=(1, 2))
bad("nastran_bulk", "GRID,1,,0.,0.,0.\nCQUAD4,1,1,1,2,3,4\n", "Nastran")
bad("ls_dyna", "$ comment\n*KEYWORD\n*NODE\n" + NODES, "LS-DYNA")
bad("ls_dyna_part", "*NODE\n1 0. 0. 0.\n*ELEMENT_SHELL\n1 1 1 2 5 4\n",
    "LS-DYNA")
bad("gmsh_1", "$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n0\n$ENDELM\n", "gmsh",
    "format 1", "-format msh2")
bad("gmsh_4_0", GMSH_4.replace("4.1 0 8", "4 0 8"), "version 4.0",
    "2.2 and 4.1",
    "msh22")
bad("gmsh_binary", GMSH_4.replace("4.1 0 8", "4.1 1 8"), "binary",
    "Mesh.Binary = 0")
bad("gmsh_4_one_partition",
    GMSH_PARTITIONED.replace("Entities\n2\n1", "Entities\n3\n1"),
    "2 of the mesh's 3 partitions",
    "Mesh.PartitionSplitMeshFiles = 0")
bad("hdf5", b"\x89HDF\r\n\x1a\n\0\0", "HDF5", "meshio")
bad("netcdf", b"CDF\x01\0\0", "NetCDF", "meshio")
bad("vtu", '<?xml version="1.0"?>\n<VTKFile>\n', "XML", "meshio")
bad("stl", "solid a\nfacet normal 0 0 1\n", "STL", "gmsh")
bad("obj", "# a comment\nv 0 0 0\nv 1 0 0\n", "OBJ", "meshio")
bad("include_itself", "*INCLUDE, INPUT=a.txt\n" + DECK, "'a.txt', line 1",
    "'mesh.inp' includes itself",
    files={"a.txt": "*INCLUDE, INPUT=mesh.inp\n"}, ranks=(1, 2))
bad("include_missing", "*INCLUDE, INPUT=b.txt\n" + DECK, "'mesh.inp', line 1",
    "'b.txt' doesn't exist", ranks=(1, 2))
bad("node_twice", DECK.replace("*ELEMENT", "*NODE\n4, 0, 1, 1e-9\n*ELEMENT"),
    "the node 4 stands twice", "different coordinates")
bad("generate_backward", DECK.replace("=Root\n1, 4", "=Root, GENERATE\n4, 1"),
    "first <= last")
bad("generated_nodes", DECK.replace("*ELEMENT", "*NGEN\n1, 6\n*ELEMENT"),
    "found *NGEN", "write all nodes")
bad("some_are_collapsed", DECK.replace("2, 2, 3, 6, 5", "2, 2, 3, 6, 6"),
    "cell 2", "quadrilateral with the node 6 twice", "triangle", "alone")
bad("springs_only", DECK.replace("S4R", "SPRING1"), "no cells of a surface",
    "2 elements of the type SPRING1 (springs)")
bad("solids_beside_shells", DECK + "*ELEMENT, TYPE=C3D4\n3, 1, 2, 3, 4\n",
    "the element 3", "C3D4", "Save the surface only")
bad("spherical", DECK.replace("*NODE\n", "*NODE, SYSTEM=S\n"), "SYSTEM=S",
    "Write x, y, z")
bad("system_of_one_line", "*SYSTEM\n0, 0, 0, 1, 0, 0\n2, 0, 0\n" + DECK,
    "*SYSTEM", "don't define axes")
bad("instance_of_nothing", PART.format(DECK) +
    ASSEMBLY.format("", "").replace("PART=PLATE", "PART=Shell"),
    "'Plate-1'", "'Shell'", "doesn't define")
bad("axis_of_one_point", PART.format(DECK) +
    ASSEMBLY.format("0, 0, 0\n1, 0, 0, 1, 0, 0, 90\n", ""), "axis", "'Plate-1'")
