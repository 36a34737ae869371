#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""A roof read from mesh files equals the built-in one; where files are looked
for; the parameters that were used repeat the run.

  mesh_files.py NACRE PRM-FOLDER
"""

import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile

TOLERANCE = 1e-10


class Runs:
    """Runs of one program in one folder, each with an output of its own."""

    def __init__(self, nacre, folder):
        self.nacre, self.folder, self.n = nacre, folder, 0

    def row(self, prm, *overrides, cwd=None):
        """The last row of the table without seconds, as numbers."""
        self.n += 1
        output = self.folder / f"output{self.n}"
        command = [self.nacre, str(prm), "--quiet"]
        for override in (f"Study/Output folder={output}", "Study/Name=run",
                         "Study/Write VTU=false", *overrides):
            command += ["--set", override]
        subprocess.run(command, cwd=cwd or self.folder, check=True,
                       stdout=subprocess.DEVNULL)
        with open(output / "run.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return {name: float(rows[-1][name]) for name in ("dofs", "w", "U")}


def difference(a, b):
    assert a["dofs"] == b["dofs"], (a, b)
    return max(abs(a[name] / b[name] - 1) for name in ("w", "U"))


def check(name, value, holds):
    print(f"{'OK  ' if holds else 'FAIL'} {name}: {value:.1e}", flush=True)
    return [] if holds else [name]


def compare_formats(runs, prm):
    wrong = []
    built_in = {element: runs.row(prm / "benchmarks" / "scordelis_lo.prm",
                                  "Mid-surface/Subdivisions=4",
                                  "Study/Degrees=2", "Study/Refinements=0",
                                  f"Discretization/Element={element}")
                for element in ("Lagrange", "serendipity", "triangle")}
    for name, element, files in (
            ("roof_gmsh", "Lagrange", ("roof_v2.msh", "roof_8_nodes.msh")),
            ("roof_gmsh", "serendipity", ("roof_8_nodes.msh",)),
            ("roof_gmsh", "triangle", ()), ("roof_triangles", "triangle", ()),
            ("roof_vtk", "Lagrange", ()), ("roof_ucd", "Lagrange", ()),
            ("roof_abaqus", "Lagrange", ())):
        for file in (None, *files):
            overrides = [f"Discretization/Element={element}"]
            if file:
                overrides.append(f"Mid-surface/file/File name={file}")
            found = difference(
                runs.row(prm / "meshes" / f"{name}.prm", *overrides),
                built_in[element])
            wrong += check(" ".join([name, *overrides]), found,
                           found < TOLERANCE)
    # the test of the test: another surface of the same cells
    flat = difference(runs.row(prm / "meshes" / "roof_gmsh.prm",
                               "Mid-surface/file/Curvature=flat"),
                      built_in["Lagrange"])
    wrong += check("flat is different", flat, flat > 1e-2)
    return wrong


def vtk_5(text):
    """The same VTK file as VTK 9 writes it: offsets, and METADATA."""
    lines = text.splitlines()
    cells = next(i for i, line in enumerate(lines) if line.startswith("CELLS"))
    n = int(lines[cells].split()[1])
    lists = [line.split()[1:] for line in lines[cells + 1:cells + 1 + n]]
    offsets = [0]
    for nodes in lists:
        offsets.append(offsets[-1] + len(nodes))
    metadata = ["METADATA", "INFORMATION 1",
                "NAME L2_NORM_RANGE LOCATION vtkDataArray", "DATA 2 0 35.5", ""]
    return "\n".join(
        ["# vtk DataFile Version 5.1"] + lines[1:cells] + metadata +
        [f"CELLS {n + 1} {offsets[-1]}", "OFFSETS vtktypeint64"] +
        [str(i) for i in offsets] + ["CONNECTIVITY vtktypeint64"] +
        [" ".join(nodes) for nodes in lists] + lines[cells + 1 + n:] +
        ["VECTORS v double"] + ["0 0 nan"] * n + metadata +
        ["POINT_DATA 81", "SCALARS MaterialID int", "LOOKUP_TABLE default"] +
        ["7"] * 81 + [""])


def compare_vtk_5(runs, prm):
    path = runs.folder / "roof_5.vtk"
    path.write_text(vtk_5((prm / "meshes" / "roof.vtk").read_text()))
    case = prm / "meshes" / "roof_vtk.prm"
    found = difference(runs.row(case, f"Mid-surface/file/File name={path}"),
                       runs.row(case))
    return check("VTK 5.1", found, found < TOLERANCE)


def compare_strip(runs, prm):
    """A folded strip of one section, from a file and built in."""
    common = ["Study/Degrees=2", "Study/Refinements=1",
              "Section/Thickness=0.02"]
    file = runs.row(prm / "meshes" / "strip.prm", *common, "Section/Regions=")
    thick = runs.row(prm / "meshes" / "strip.prm", *common,
                     "Section/Regions=wall: h = 0.02; lid: E = 1e6")
    regions = difference(file, thick)
    wrong = check("regions that say the same", regions, regions < TOLERANCE)
    split = runs.row(prm / "meshes" / "strip.prm", *common,
                     "Section/Regions=wall: h = 0.03")
    wrong += check("another region", split["w"] / file["w"],
                   split["w"] / file["w"] < 0.8)
    return wrong


def compare_edge_forms(runs, prm):
    """On a flat plate the two forms of the edges agree, also where regions of
    different stiffness meet."""
    sys.dont_write_bytecode = True
    sys.path.insert(0, str(prm.parent / "scripts"))
    import make_meshes  # noqa: E402  (found by the line above)
    mesh = make_meshes.grid([0., 1., 2., 4.], [0., 1., 1.5],
                            lambda u, v: (u, v, 0.),
                            ("clamp", "tip", None, None), 4,
                            lambda i, j: "wall" if i < 1 else "lid")
    path = runs.folder / "plate.msh"
    path.write_text("\n".join(make_meshes.gmsh_2(mesh)) + "\n")
    common = [f"Mid-surface/file/File name={path}", "Study/Degrees=3",
              "Study/Refinements=0", "Study/Penalties=20",
              "Section/Poisson's ratio=0.3",
              "Quantities/Quantities=w = maximum displacement; U = energy"]
    forms = [runs.row(prm / "meshes" / "strip.prm", *common,
                      f"Discretization/Edge form={form}")
             for form in ("rotation jump", "averaged normal")]
    found = difference(*forms)
    return check("edge forms between regions", found, found < 1e-9)


def check_folders(runs, prm):
    """Beside the parameter file first, then in the current folder."""
    wrong = []
    inputs, work = runs.folder / "my inputs", runs.folder / "work"
    for folder in inputs, work:
        (folder / "sub").mkdir(parents=True)
    shutil.copy(prm / "meshes" / "roof_gmsh.prm", inputs / "a.prm")
    shutil.copy(prm / "meshes" / "roof_v4.msh", inputs / "sub" / "roof.msh")
    shutil.copy(prm / "meshes" / "roof_v4.msh", work / "here.msh")
    (work / "sub" / "roof.msh").write_text("not this one")
    file_name = "Mid-surface/file/File name="
    beside = runs.row(inputs / "a.prm", file_name + "sub/roof.msh", cwd=work)
    here = runs.row(inputs / "a.prm", file_name + "here.msh", cwd=work)
    used = runs.folder / f"output{runs.n}" / "run.used.prm"
    again = runs.row(used, cwd=inputs)
    for name, row in ("current folder", here), ("used.prm", again):
        found = difference(row, beside)
        wrong += check(name, found, found == 0.)
    return wrong


def main():
    nacre, prm = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(str(nacre), pathlib.Path(folder))
        wrong = compare_formats(runs, prm)
        wrong += compare_vtk_5(runs, prm)
        wrong += compare_strip(runs, prm)
        wrong += compare_edge_forms(runs, prm)
        wrong += check_folders(runs, prm)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
