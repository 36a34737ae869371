#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""What a run does around its solves, test by test.

  runs.py NACRE N_RANKS NAME   run one test
  runs.py --list               names and numbers of ranks, a line each
"""
import csv
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import run_study  # noqa: E402  (found by the line above)

TESTS = {}


def test(*ranks):
    """Register a test and the numbers of ranks that it runs on."""
    def add(function):
        TESTS[function.__name__] = (function, ranks)
        return function
    return add


def check(condition, text):
    if not condition:
        sys.exit(f"FAILED: {text}")


class Folder:
    """A folder to run nacre in."""

    def __init__(self, program, ranks, path):
        self.program, self.ranks, self.path = program, ranks, path

    def write(self, name, text):
        (self.path / name).write_text(text)

    def read(self, name):
        return (self.path / "output" / name).read_text()

    def exists(self, name):
        return (self.path / "output" / name).exists()

    def rows(self, name):
        with open(self.path / "output" / name, encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def values(self, name, column):
        return [float(row[column]) for row in self.rows(name)]

    def run(self, *words, limit=None, **settings):
        """Exit code and all that is said, with a limit of the size of files
        in kB. Settings: Section__Name="value"."""
        command = [self.program, *words]
        if limit:
            command = ["/bin/bash", "-c", f'ulimit -f {limit}; exec "$0" "$@"',
                       *command]
        if self.ranks > 1:
            command = ["mpirun", "--oversubscribe", "-np", str(self.ranks),
                       *command]
        for name, value in settings.items():
            path = name.replace("__", "/").replace("_", " ")
            command += ["--set", f"{path}={value}"]
        environment = dict(os.environ, OMP_NUM_THREADS="1",
                           OMPI_ALLOW_RUN_AS_ROOT="1",
                           OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        if self.ranks == 1:
            environment.update(run_study.start_alone(self.path))
        elif limit:
            # Shared memory would be a file beyond the limit.
            environment["OMPI_MCA_btl"] = "self,tcp"
        done = subprocess.run(
            command, cwd=self.path, env=environment, text=True, timeout=60,
            capture_output=True, check=False, errors="replace")
        return done.returncode, done.stdout + done.stderr

    def succeed(self, *words, **settings):
        code, text = self.run(*words, **settings)
        check(code == 0, f"{words} {settings}: exit code {code}: {text}")
        return text

    def fail(self, *words, expect=(), **settings):
        """An error of one line that holds the expected texts."""
        code, text = self.run(*words, **settings)
        check(code == 1, f"{words} {settings}: exit code {code}: {text}")
        errors = [line for line in text.splitlines() if "nacre: error:" in line]
        check(len(errors) == 1, f"{len(errors)} errors: {text}")
        for fragment in expect:
            check(fragment in errors[0],
                  f"{words} {settings}: '{fragment}' isn't in: {errors[0]}")
        return text

    def contents(self):
        """All output files by name."""
        return {path.name: path.read_bytes()
                for path in (self.path / "output").iterdir()}


def warnings_in(text):
    return [line for line in text.splitlines() if "nacre: warning:" in line]


def near(a, b, tolerance):
    return abs(a - b) <= tolerance * max(abs(a), abs(b))


SWINGING = """\
set Constants = q = 10
subsection Study
  set Report seconds = false
end
subsection Mid-surface
  set Subdivisions = 8, 2
  subsection plate
    set Size = 1, 0.2
  end
end
subsection Section
  set Young's modulus = 1e9
  set Thickness = 0.01
  set Density = 1000
end
subsection Boundary conditions
  set Edges = u=0: clamped
end
subsection Loads
  set Force per area = 0, 0, -q
end
subsection Analysis
  set Type = dynamic
  set End time = 0.04
  set Time step = 0.01
  set VTU steps = 0
  set Checkpoint steps = 2
end
subsection Quantities
  set Quantities = w = displacement z at (1, 0.1, 0); E = total energy
end
"""

STRETCHED = """\
set Constants = L = 10, b = 1, d = 0.05, q = 20
subsection Study
  set Report seconds = false
end
subsection Mid-surface
  set Subdivisions = 8, 1
  subsection plate
    set Size = L, b
  end
end
subsection Section
  set Young's modulus = 1.2e6
  set Poisson's ratio = 0
  set Thickness       = 0.05
  set Density         = 1
end
subsection Discretization
  set Kinematics = corotational
end
subsection Boundary conditions
  set Edges = u=0: fixed; u=1: x = d*min(t, 1), y = 0, z = 0
end
subsection Loads
  set Force per area = 0, 0, -q*max(t - 1, 0)
end
subsection Analysis
  set Type        = static
  set Load factor = 1
  set End time    = 2
  set Time step   = 0.5
  set VTU steps   = 0
end
subsection Quantities
  set Quantities = w = displacement z at (L/2, b/2, 0); \\
                   N = reaction x of u=1; U = energy; T = kinetic energy
end
"""

ROD = """\
*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 2, 0, 0
4, 0, 1, 0
5, 1, 1, 0
6, 2, 1, 0
*ELEMENT, TYPE=S4, ELSET=PLATE
1, 1, 2, 5, 4
2, 2, 3, 6, 5
*NSET, NSET=ROOT
1, 4
"""


# --- Restarts ---------------------------------------------------------------
CHANGES = (
    ("Section/Density: '1000' then, '4000' now", {"Section__Density": "4000"}),
    ("Section/Young's modulus: '1e9' then, '2e9' now",
     {"Section__Young's_modulus": "2e9"}),
    ("Section/Thickness", {"Section__Thickness": "0.02"}),
    ("Constants: 'q = 10' then, 'q = 11' now", {"Constants": "q = 11"}),
    ("Mid-surface/plate/Size", {"Mid-surface__plate__Size": "1, 0.3"}),
    ("Mid-surface/Subdivisions: '8, 2' then, '2, 8' now",
     {"Mid-surface__Subdivisions": "2, 8"}),
    ("Boundary conditions/Edges",
     {"Boundary_conditions__Edges": "u=1: clamped"}),
    ("Loads/Force per area", {"Loads__Force_per_area": "0, 0, 10"}),
    ("Discretization/Kinematics: 'linear' then, 'corotational' now",
     {"Discretization__Kinematics": "corotational"}),
    ("Analysis/Type: 'dynamic' then, 'static' now",
     {"Analysis__Type": "static"}),
    ("Study/Degrees: '2' then, '3' now", {"Study__Degrees": "3"}))


@test(1, 2)
def restart_of_another_problem(folder):
    """Refused, with what differs; all files stay as they were."""
    folder.write("case.prm", SWINGING)
    folder.succeed("case.prm")
    before = folder.contents()
    for words, change in CHANGES if folder.ranks == 1 else CHANGES[::4]:
        folder.fail("case.prm", "--restart", expect=("--restart", words),
                    Analysis__End_time="0.06", **change)
        check(folder.contents() == before, f"{change}: files have changed")


@test(1)
def restart_of_the_same_problem(folder):
    """Another spelling is no change; a longer path is the longer path."""
    folder.write("case.prm", SWINGING)
    folder.succeed("case.prm", Analysis__End_time="0.08")
    whole = folder.read("case_path.csv")
    folder.succeed("case.prm")
    text = folder.succeed(
        "case.prm", "--restart", Section__Density="1.0e+3",
        Loads__Force_per_area="0,0,-q", Constants="q =10.0, unused = 1",
        Analysis__End_time="0.08", Study__Write_VTU="false")
    check(folder.read("case_path.csv") == whole, "other rows than in one run")
    check("changed: Analysis/End time: '0.04' then, '0.08' now" in text,
          f"not told: {text}")
    folder.ranks = 2
    text = folder.succeed("case.prm", "--restart", Analysis__End_time="0.09")
    check("ranks: 1 then, 2 now" in text, f"not told: {text}")


@test(1)
def restart_with_another_step(folder):
    folder.write("case.prm", SWINGING)
    folder.succeed("case.prm")
    folder.succeed("case.prm", "--restart", Analysis__Time_step="0.005",
                   Analysis__End_time="0.05")
    check(folder.values("case_path.csv", "time")
          == [0., 0.01, 0.02, 0.03, 0.04, 0.045, 0.05],
          folder.read("case_path.csv"))


@test(1, 2)
def restart_with_other_quantities(folder):
    """New rows stand under their own header, and no row is lost."""
    folder.write("case.prm", SWINGING)
    folder.succeed("case.prm")
    old = folder.read("case_path.csv")
    text = folder.succeed("case.prm", "--restart", Analysis__End_time="0.06",
                          Quantities__Quantities="T = kinetic energy")
    check("case_path_until_4.csv" in text, f"not told: {text}")
    check(folder.read("case_path_until_4.csv") == old, "old rows are lost")
    rows = folder.rows("case_path.csv")
    check([row["step"] for row in rows] == ["5", "6"]
          and "T" in rows[0] and "w" not in rows[0], f"rows {rows}")
    # The same name for something else.
    folder.succeed("case.prm", "--restart", Analysis__End_time="0.08",
                   Quantities__Quantities="T = total energy")
    check(len(folder.rows("case_path.csv")) == 2
          and len(folder.rows("case_path_until_6.csv")) == 2, "rows are mixed")


@test(1)
def restart_with_another_format(folder):
    """Each list names files of its own format only."""
    folder.write("case.prm", SWINGING)
    folder.succeed("case.prm")
    folder.succeed("case.prm", "--restart", Analysis__End_time="0.06",
                   Study__Output_format="hdf5")
    check(re.findall('file="([^"]*)"', folder.read("case.pvd"))
          == ["case_4.vtu"] and "case_6.h5" in folder.read("case.xdmf")
          and "case_4" not in folder.read("case.xdmf"),
          folder.read("case.xdmf"))


@test(1)
def restart_of_a_mesh_file(folder):
    """The content counts, not the place."""
    folder.write("rod.inp", ROD)
    folder.write("case.prm", SWINGING)
    mesh = {"Mid-surface__Surface": "file",
            "Mid-surface__file__File_name": "rod.inp",
            "Boundary_conditions__Edges": "ROOT: clamped",
            "Quantities__Quantities": "E = total energy"}
    folder.succeed("case.prm", **mesh)
    folder.write("moved.inp", ROD)
    folder.succeed("case.prm", "--restart", Analysis__End_time="0.06",
                   **dict(mesh, **{"Mid-surface__file__File_name":
                                   "moved.inp"}))
    folder.write("rod.inp", ROD.replace("1, 4\n", "3, 6\n"))
    folder.fail("case.prm", "--restart", **mesh,
                expect=("Mid-surface/file/File name", "another content"))


@test(1)
def restart_of_an_imperfection(folder):
    """The content of its files counts."""
    bumps = [f"{x / 8} {y / 20} 0 {1e-4 * x * y}" for x in range(9)
             for y in range(5)]
    folder.write("bumps.txt", "\n".join(bumps))
    folder.write("case.prm", SWINGING)
    imperfect = {"Mid-surface__Imperfection__Points": "bumps.txt: 1"}
    folder.succeed("case.prm", **imperfect)
    folder.succeed("case.prm", "--restart", Analysis__End_time="0.06",
                   **imperfect)
    folder.write("bumps.txt", "\n".join(bumps).replace("0.0032", "0.0033"))
    folder.fail("case.prm", "--restart", Analysis__End_time="0.08",
                **imperfect, expect=("--restart", "Mid-surface/Imperfection/",
                                     "content"))


@test(1)
def restart_of_an_old_checkpoint(folder):
    folder.write("case.prm", SWINGING)
    folder.succeed("case.prm")
    slot = folder.read("case.checkpoint").split()[0]
    file = folder.path / "output" / f"case.checkpoint.{slot}.0"
    file.write_bytes(file.read_bytes().replace(b"nacre checkpoint 8",
                                               b"nacre checkpoint 2"))
    folder.fail("case.prm", "--restart",
                expect=("another version of nacre", "nacre checkpoint 2"))


# --- Starts from other runs -------------------------------------------------
@test(1, 2)
def start_from_static(folder):
    """Stretched in one run, loaded in another with supports of its own: as in
    one path. From the same state a string swings: w = v0/f sin(f t) with
    f = pi/L (N/(rho h b))^1/2."""
    folder.write("case.prm", STRETCHED)
    folder.succeed("case.prm", Study__Name="whole")
    folder.succeed("case.prm", Study__Name="stretch", Analysis__End_time="1")
    held = {"Boundary_conditions__Edges":
            "u=0: fixed; u=1: x = d, y = 0, z = 0",
            "Analysis__Start_from": "output/stretch", "Study__Name": "loaded"}
    text = folder.succeed("case.prm", **held, Analysis__End_time="1",
                          Loads__Force_per_area="0, 0, -q*t")
    check("start from step 2, t = 1 of output/stretch" in text, text)
    whole, loaded = (folder.rows(f"{name}_path.csv")
                     for name in ("whole", "loaded"))
    for a, b in zip(whole[2:], loaded):
        for name in ("w", "N", "U"):
            check(near(float(a[name]), float(b[name]), 1e-6)
                  or abs(float(a[name])) < 1e-10, f"{name}: {a} and {b}")
    check(abs(float(loaded[-1]["w"])) > 0.1, f"no load: {loaded}")

    folder.succeed("case.prm", **dict(held, Study__Name="swing"),
                   Analysis__Type="dynamic", Analysis__Scheme="newmark",
                   Analysis__End_time="0.04", Analysis__Time_step="0.005",
                   Loads__Force_per_area="0, 0, 0",
                   Analysis__Initial_velocity="0, 0, sin(pi*x/L)")
    first, *_, last = folder.rows("swing_path.csv")
    check(near(float(first["U"]), float(whole[2]["U"]), 1e-8)
          and near(float(first["N"]), 300., 1e-8), f"swing begins with {first}")
    f = math.pi / 10 * (300 / 0.05) ** 0.5
    check(near(float(last["w"]), math.sin(f * 0.04) / f, 1e-2),
          f"swing ends with {last}")


@test(1)
def start_from_dynamic(folder):
    """Velocities go on, too; the checkpoint of one rank serves two."""
    folder.write("case.prm", SWINGING)
    free = {"Loads__Force_per_area": "0, 0, 0",
            "Quantities__Quantities":
            "w = displacement z at (1, 0.1, 0); T = kinetic energy",
            "Analysis__Scheme": "newmark"}
    folder.succeed("case.prm", **free, Study__Name="whole",
                   Analysis__End_time="0.08",
                   Analysis__Initial_velocity="0, 0, x^2")
    folder.succeed("case.prm", **free, Study__Name="first",
                   Analysis__Initial_velocity="0, 0, x^2")
    folder.ranks = 2
    folder.succeed("case.prm", **free, Study__Name="then",
                   Analysis__Start_from="output/first.checkpoint")
    for name in ("w", "T"):
        found = folder.values("then_path.csv", name)
        expected = folder.values("whole_path.csv", name)[4:]
        scale = max(abs(value) for value in expected)
        check(len(found) == 5 and
              all(abs(a - b) <= 1e-6 * scale for a, b in zip(found, expected)),
              f"{name}: {found} instead of {expected}")


@test(1, 2)
def start_from_the_wrong_run(folder):
    folder.write("case.prm", SWINGING)
    folder.succeed("case.prm", Study__Name="first")
    start = {"Analysis__Start_from": "output/first"}
    where = "Analysis/Start from"
    for check_only in ((), ("--check",)) if folder.ranks == 1 else ((),):
        for words, change in (
                (("another element", "27 unknowns", "48 here"),
                 {"Study__Degrees": "3"}),
                (("another mesh", "lacks cells"), {"Study__Refinements": "1"}),
                (("another mesh", "a node lies at"),
                 {"Mid-surface__plate__Size": "1, 0.3",
                  "Quantities__Quantities": "E = energy"}),
                (("no checkpoint", "output/missing.checkpoint"),
                 {"Analysis__Start_from": "output/missing"}),
                (("itself writes",), {"Study__Name": "first"}),
                (("Type = linear",), {"Analysis__Type": "linear"}))[
                    ::1 if folder.ranks == 1 else 3]:
            folder.fail("case.prm", *check_only, expect=(where, *words),
                        **dict(start, **change))
    folder.succeed("case.prm", "--check", **start)
    text = folder.succeed("case.prm", **start, Section__Thickness="0.02")
    check("Section/Thickness: '0.01' then, '0.02' now" in text, text)


# --- Checks without a run ---------------------------------------------------
@test(1, 2)
def check_finds_what_a_run_finds(folder):
    folder.write("case.prm", SWINGING)
    inputs = (
        ("can move freely", {"Boundary_conditions__Edges": "u=0: free",
                             "Analysis__Type": "linear"}),
        ("Contradicting conditions",
         {"Boundary_conditions__Edges": "u=0: clamped; v=0: z = 1"}),
        ("Loads/Point forces", {"Loads__Point_forces": "(3, 0, 0): 0, 0, 1"}),
        ("Boundary conditions/Points",
         {"Boundary_conditions__Points": "(0.33, 0.1, 0.2): z = 0"}),
        ("Quantities/Quantities, 'w'",
         {"Quantities__Quantities": "w = displacement z at (3, 0, 0)"}),
        ("Section/Thickness", {"Section__Thickness": "0.01*(x - 0.5)"}),
        ("Section/Density", {"Section__Density": "0"}),
        ("Section/Density", {"Section__Density": "1000*(x - 0.5)"}),
        ("Loads/Force per area", {"Loads__Force_per_area":
                                  "0, 0, log(x - 0.5)"}))
    for words, change in inputs if folder.ranks == 1 else inputs[::3]:
        checked = folder.fail("case.prm", "--check", expect=(words,), **change)
        check(not (folder.path / "output").exists(), "--check writes files")
        run = folder.fail("case.prm", "--quiet", expect=(words,), **change,
                          Study__Output_folder="other")
        said = [[line for line in text.splitlines() if "error:" in line]
                for text in (checked, run)]
        check(said[0] == said[1], f"--check says {said[0]}, a run {said[1]}")
    check("no errors" in folder.succeed("case.prm", "--check"), "--check")
    check(not (folder.path / "output").exists(), "--check writes files")


@test(1)
def check_of_all_cases(folder):
    """What is wrong with the last case of a study only."""
    folder.write("case.prm", SWINGING)
    load = "0, 0, log(h - 0.005)"
    folder.succeed("case.prm", "--check", Study__Thicknesses="0.01",
                   Loads__Force_per_area=load)
    folder.fail("case.prm", "--check", Study__Thicknesses="0.01, 0.004",
                Loads__Force_per_area=load, expect=("Loads/Force per area",))


@test(1)
def initial_motion_where_none_is(folder):
    folder.write("case.prm", SWINGING)
    for name in ("displacement", "velocity"):
        for kind in ("static", "relaxation", "linear"):
            folder.fail("case.prm", "--check", Analysis__Type=kind,
                        expect=(f"Analysis/Initial {name}", kind),
                        **{f"Analysis__Initial_{name}": "0, 0, x"})
    folder.succeed("case.prm", "--check",
                   Analysis__Initial_displacement="0, 0, x^2",
                   Analysis__Initial_velocity="0, 0, x")


# --- Times ------------------------------------------------------------------
@test(1)
def output_times(folder):
    """Met exactly, on the grid or off it; their fields are written."""
    folder.write("case.prm", SWINGING)
    folder.succeed("case.prm",
                   Analysis__Output_times="0.03, 0.0125, 2*0.01, 0.0375")
    check(folder.values("case_path.csv", "time")
          == [0., 0.01, 0.0125, 0.02, 0.03, 0.0375, 0.04],
          folder.read("case_path.csv"))
    times = re.findall('timestep="([^"]*)"', folder.read("case.pvd"))
    check([float(t) for t in times] == [0.0125, 0.02, 0.03, 0.0375, 0.04],
          f"fields at {times}")
    for wrong in ("0.05", "0", "-1", "soon"):
        folder.fail("case.prm", "--check", Analysis__Output_times=wrong,
                    expect=("Analysis/Output times",))


# Steps are cut at the beginning, when the load grows fast.
JUMP = dict(
    Analysis__Time_step="0.25", Analysis__End_time="1.25",
    Analysis__Maximum_iterations="12", Study__Write_VTU="false",
    Boundary_conditions__Edges="u=0: clamped",
    Quantities__Quantities="w = displacement z at (L, b/2, 0)")


@test(1)
def grid_after_cut_backs(folder):
    """Steps that fail are halved, and the path returns to the multiples."""
    folder.write("case.prm", STRETCHED)
    text = folder.succeed(
        "case.prm", **JUMP,
        Loads__Force_per_area="0, 0, 2*tanh(14*t) + 0.01*t")
    check("trying half the step" in text, f"no cut-back: {text}")
    times = folder.values("case_path.csv", "time")
    for k in range(6):
        check(0.25 * k in times, f"{0.25 * k} isn't among {times}")
    check(len(times) > 6 and times == sorted(times), f"times {times}")


# --- Warnings and words -----------------------------------------------------
@test(1)
def warnings_of_paths(folder):
    folder.write("case.prm", SWINGING)
    path = {"Analysis__Type": "static", "Analysis__End_time": "1",
            "Analysis__Time_step": "0.5"}
    curved = {"Discretization__Kinematics": "corotational"}

    def said(**settings):
        text = folder.succeed("case.prm", **dict(path, **settings))
        found = warnings_in(text)
        n = len(found)
        check(f", {n} warning{'' if n == 1 else 's'}\n" in text,
              f"{n} warnings, but: {text}")
        return " ".join(found)

    check("Kinematics: linear" in said(), "linear kinematics")
    check("Kinematics: linear" in said(Analysis__Type="dynamic"), "dynamic")
    check(said(**curved) == "", "a warning of nothing")
    twice = said(**curved, Loads__Force_per_area="0, 0, -q*t")
    check("Analysis/Load factor" in twice and "'Loads'" in twice, twice)
    twice = said(**curved, Analysis__Load_factor="sin(t)",
                 Boundary_conditions__Edges="u=0: clamped; u=1: z = t/100")
    check("'Boundary conditions'" in twice, twice)
    grown = {"Discretization__Kinematics": "finite",
             "Section__Initial_strain__Strain": "1e-4*t, 0, 0"}
    twice = said(**grown)
    check("'Section/Initial strain'" in twice, twice)
    check(said(**grown, Analysis__Load_factor="1") == "", "growth once only")
    check(said(**curved, Analysis__Load_factor="1",
               Loads__Force_per_area="0, 0, -q*t") == "", "t once only")


@test(1, 2)
def linear_displacements_beyond_the_shell(folder):
    folder.write("case.prm", SWINGING)
    linear = {"Analysis__Type": "linear", "Study__Degrees": "2, 3"}
    text = folder.succeed("case.prm", **linear)
    check(not warnings_in(text), f"a warning of nothing: {text}")
    text = folder.succeed("case.prm", **linear, Section__Thickness="1e-3",
                          Study__Refinements="0, 1")
    found = warnings_in(text)
    check(found and "is larger than the shell, 1.02;" in found[0]
          and len(found) <= 2, f"no warning: {text}")


TWISTED = """\
subsection Mid-surface
  set Surface = expression
  set Subdivisions = 24, 4
  subsection expression
    set Position = u, v*cos(pi/24*u), v*sin(pi/24*u)
    set Range u = 0, 12
    set Range v = -0.55, 0.55
  end
end
subsection Section
  set Young's modulus = 29e6
  set Poisson's ratio = 0.22
  set Thickness = 0.00032
end
subsection Boundary conditions
  set Edges = u=0: clamped
end
subsection Loads
  set Edge forces = u=1: 0, 1e-9/1.1, 0
end
subsection Study
  set Refinements = 1
  set Write VTU = false
end
"""


@test(1)
def lost_digits(folder):
    """The warning of an ill-conditioned matrix names the likely cause first."""
    folder.write("case.prm", TWISTED)
    solver = {"Linear_solver__Solver": "direct"}
    thin = warnings_in(folder.succeed("case.prm", **solver))
    check(thin and re.search(r"of their size: the shell is 37\d\d\d times as "
                             r"long as thick", thin[0]), f"thin: {thin}")
    long = warnings_in(folder.succeed(
        "case.prm", **solver, **{"Section__Thickness": "0.1",
                                 "Mid-surface__Subdivisions": "6, 60"}))
    check(long and re.search(r"of their size: cells are up to \d+\.\d times as "
                             r"long as wide", long[0]), f"long: {long}")


@test(1)
def names_of_fields(folder):
    """Files tell degree, refinement, and what else varies."""
    folder.write("case.prm", SWINGING)
    linear = {"Analysis__Type": "linear", "Study__Degrees": "2, 3",
              "Study__Refinements": "0, 1"}
    text = folder.succeed("case.prm", **linear)
    names = ["case_p2_r0.vtu", "case_p2_r1.vtu", "case_p3_r0.vtu",
             "case_p3_r1.vtu"]
    check(re.findall('file="([^"]*)"', folder.read("case.pvd")) == names
          and all(folder.exists(name) for name in names),
          folder.read("case.pvd"))
    check("Fields: output/case_pP_rR.vtu, 4 solutions\n"
          "Solved: 4 linear systems of up to 1911 dofs, 0 warnings\n" in text,
          text)
    folder.succeed("case.prm", Analysis__Type="linear",
                   Study__Thicknesses="0.01, 0.02",
                   Study__Penalties="default, 12.5")
    check(all(folder.exists(f"case_p2_r0_{tail}.vtu") for tail in
              ("h0.01_etadefault", "h0.01_eta12.5", "h0.02_etadefault",
               "h0.02_eta12.5")), sorted(folder.contents()))
    folder.succeed("case.prm", Study__Degrees="2, 3",
                   Study__Output_format="hdf5", Study__Name="path")
    check(all(folder.exists(name) for name in (
        "path_p2_r0_path.csv", "path_p3_r0_4.h5", "path_p3_r0.xdmf",
        "path_p3_r0.checkpoint")), sorted(folder.contents()))


@test(1)
def names_of_adaptive_meshes(folder):
    folder.write("case.prm", SWINGING)
    folder.succeed("case.prm", Analysis__Type="linear",
                   Adaptive_refinement__Cycles="1")
    check(folder.exists("case_p2_r0_c0.vtu")
          and folder.exists("case_p2_r0_c1.vtu"), sorted(folder.contents()))


@test(1)
def summary_of_a_path(folder):
    folder.write("case.prm", SWINGING)
    text = folder.succeed("case.prm", "--quiet")
    for words in ("Path: 4 steps to t = 0.04: output/case_path.csv; fields of "
                  "1 step: output/case.pvd; output/case.checkpoint\n",
                  "Solved: 1 path of 255 dofs, 1 warning\n"):
        check(words in text, f"'{words}' isn't in: {text}")
    row = folder.rows("case.csv")[0]
    check(float(row["assembly_s"]) > 0. and float(row["solve_s"]) > 0.,
          f"seconds: {row}")


@test(1)
def seconds_left(folder):
    """Not many times of what the whole run takes, also after cut-backs."""
    folder.write("case.prm", STRETCHED)
    begin = time.monotonic()
    text = folder.succeed(
        "case.prm", **JUMP, Study__Report_seconds="true",
        Loads__Force_per_area="0, 0, 5*tanh(14*t) + 0.01*t")
    seconds = time.monotonic() - begin
    left = [float(number) for number in re.findall(r"([\d.e+]+) s left", text)]
    check(len(left) > 5 and max(left) <= 10 * seconds,
          f"{left} of {seconds} s: {text}")


@test(1, 2)
def full_disk(folder):
    """A file that can't be written to its end is an error that names it."""
    folder.write("case.prm", SWINGING)

    linear = {"Analysis__Type": "linear", "Study__Refinements": "2"}
    cases = [
        ("case_p2_r2.vtu", linear),
        ("case_p2_r2.h5", dict(linear, Study__Output_format="hdf5")),
        ("case.checkpoint.", {"Study__Write_VTU": "false",
                              "Study__Refinements": "1"})]
    for file, settings in cases:
        text = folder.fail("case.prm", limit=20, **settings,
                           expect=(file, "is the disk full?"))
        left = [name for name in folder.contents() if ".part" in name]
        check(not left, f"{left} are left: {text}")
    if folder.ranks == 1:
        folder.fail("case.prm", Study__Write_VTU="false",
                    Analysis__Checkpoint_steps="0", Analysis__End_time="4",
                    limit=20, expect=("case_path.csv", "is the disk full?"))


@test(1)
def full_standard_output(folder):
    """What is printed and gets lost is an error."""
    folder.write("case.prm", SWINGING)
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = subprocess.run(
            [folder.program, "case.prm", "--check"], cwd=folder.path,
            stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    check(done.returncode == 1 and "standard output can't be written" in
          done.stderr, f"exit code {done.returncode}: {done.stderr}")


def main(tests):
    """List the tests (name: function, numbers of ranks), or run one."""
    if sys.argv[1:] == ["--list"]:
        for name, (_, ranks) in tests.items():
            for n in ranks:
                print(name, n)
        return
    program, ranks, name = sys.argv[1:]
    with tempfile.TemporaryDirectory() as path:
        tests[name][0](Folder(os.path.abspath(program), int(ranks),
                              pathlib.Path(path)))
    print("OK")


if __name__ == "__main__":
    main(TESTS)
