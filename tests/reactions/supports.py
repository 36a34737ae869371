#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Planes of symmetry, reactions and their balance, points between nodes and at
slits: whole runs of small inputs.

  supports.py NACRE N_RANKS NAME    run a case
  supports.py --list                names, each with the numbers of ranks
"""
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import run_study  # noqa: E402  (found by the line above)

CASES = {}


def case(*ranks):
    def register(function):
        CASES[function.__name__] = (ranks or (1,), function)
        return function
    return register


class Failure(Exception):
    """What is wrong, in a line."""


def check(condition, text):
    if not condition:
        raise Failure(text)


def near(found, expected, relative, what, scale=None):
    scale = abs(expected) if scale is None else scale
    check(abs(found - expected) <= relative * scale,
          f"{what}: {found!r} instead of {expected!r} within {relative:.0e} "
          f"of {scale:.6g}")


class Nacre:
    def __init__(self, program, n_ranks, folder):
        self.program = os.path.abspath(program)
        self.n_ranks = n_ranks
        self.folder = folder
        self.n_runs = 0

    def run(self, prm, settings=()):
        """Exit code and what it said, and the name of its results."""
        self.n_runs += 1
        name = f"run{self.n_runs}"
        (self.folder / f"{name}.prm").write_text(prm)
        command = [self.program, f"{name}.prm", "--set",
                   "Study/Write VTU=false", "--set", "Study/Output folder=."]
        for setting in settings:
            command += ["--set", setting]
        environment = dict(os.environ, OMP_NUM_THREADS="1",
                           OMPI_ALLOW_RUN_AS_ROOT="1",
                           OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        if self.n_ranks > 1:
            command = ["mpirun", "--oversubscribe", "-np", str(self.n_ranks),
                       *command]
        else:
            environment.update(run_study.start_alone(self.folder))
        done = subprocess.run(command, cwd=self.folder, env=environment,
                              text=True, capture_output=True, timeout=100,
                              check=False)
        return done.returncode, done.stdout + done.stderr, name

    def rows(self, prm, *settings):
        code, text, name = self.run(prm, settings)
        check(code == 0, f"exit code {code}: {text}")
        self.said = text
        path = self.folder / f"{name}_path.csv"
        if not path.exists():
            return run_study.read_table(self.folder / f"{name}.csv")
        lines = [line.split(",") for line in path.read_text().splitlines()]
        return [dict(zip(lines[0], map(float, line))) for line in lines[1:]]

    def last(self, prm, *settings):
        return self.rows(prm, *settings)[-1]

    def refuse(self, prm, *words, settings=()):
        code, text, _ = self.run(prm, settings)
        text = " ".join(text.split())
        check(code == 1, f"exit code {code} instead of 1: {text}")
        check(text.count("nacre: error:") == 1, f"not one message: {text}")
        for word in words:
            check(word in text, f"'{word}' is not in: {text}")

    def balance(self):
        """Rows of the last balance that was printed."""
        text = self.said[self.said.rindex("Balance of forces"):]
        found = re.findall(r"^ +(loads|reactions|inertia|internal|sum)"
                           r"((?: +\S+){6})$", text, re.M)
        return {name: [float(x) for x in numbers.split()]
                for name, numbers in found}


def sections(**parts):
    """Parameters by section, with "_" for a space."""
    text = ""
    for name, lines in parts.items():
        text += f"subsection {name.replace('_', ' ')}\n{lines}\nend\n"
    return text


# --- Planes of symmetry and diaphragms --------------------------------------
def rounded(x, digits):
    return f"{x:.{digits}g}"


def turned_plate(digits):
    """The half of a plate, turned by 30 degrees in its plane, as a file."""
    c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)
    text, number = "*NODE\n", 0
    for v in (0., 100.):
        for k in range(5):
            number += 1
            x, y = v, 25. * k
            text += (f"{number}, {rounded(c * x - s * y, digits)}, "
                     f"{rounded(s * x + c * y, digits)}, 0\n")
    text += "*ELEMENT, TYPE=S4, ELSET=PLATE\n"
    for k in range(1, 5):
        text += f"{k}, {k}, {k + 5}, {k + 6}, {k + 1}\n"
    return text + ("*NSET, NSET=sym\n1, 2, 3, 4, 5\n"
                   "*NSET, NSET=far\n6, 7, 8, 9, 10\n")


def of_file(name, edges, **more):
    return sections(
        Study="set Degrees = 3",
        **{"Mid-surface": "set Surface = file\nsubsection file\n"
                          f"set File name = {name}\nend"},
        Boundary_conditions=f"set Edges = {edges}", **more)


@case(1, 2)
def symmetry_of_few_digits(nacre):
    prm = of_file("plate.inp", "sym: symmetry; far: clamped",
                  Loads="set Pressure = 1e-9",
                  Quantities="set Quantities = w = displacement z at (0, 0, 0)")
    for digits, tolerance in ((12, 1e-4), (8, 1e-4), (5, 1e-3)):
        (nacre.folder / "plate.inp").write_text(turned_plate(digits))
        near(nacre.last(prm)["w"], 49.58, tolerance, f"{digits} digits")
    # w = 0 within the plane of the wall
    diaphragm = prm.replace("sym: symmetry", "sym: diaphragm")
    near(nacre.last(diaphragm)["w"], 0., 1e-10, "diaphragm", 1.)
    (nacre.folder / "plate.inp").write_text(turned_plate(3))
    nacre.refuse(prm, "edge 'sym'", "lies in no plane across the surface",
                 "is off by", "allowed is")


def roof(digits, angle):
    """A quarter of the Scordelis-Lo roof of 8-node cells, turned about z."""
    n, numbers, nodes = 4, {}, "*NODE\n"
    for j in range(2 * n + 1):
        for i in range(2 * n + 1):
            if i % 2 and j % 2:
                continue
            numbers[i, j] = len(numbers) + 1
            phi, y = math.radians(40. * i / (2 * n)), 25. * j / (2 * n)
            x, z = 25. * math.sin(phi), 25. * math.cos(phi)
            x, y = (x * math.cos(angle) - y * math.sin(angle),
                    x * math.sin(angle) + y * math.cos(angle))
            nodes += (f"{numbers[i, j]}, " +
                      ", ".join(rounded(c, digits) for c in (x, y, z)) + "\n")
    nodes += "*ELEMENT, TYPE=S8R, ELSET=ROOF\n"
    for j in range(0, 2 * n, 2):
        for i in range(0, 2 * n, 2):
            ring = [(0, 0), (2, 0), (2, 2), (0, 2),
                    (1, 0), (2, 1), (1, 2), (0, 1)]
            nodes += f"{i * n + j // 2 + 1}, " + ", ".join(
                str(numbers[i + a, j + b]) for a, b in ring) + "\n"
    for name, inside in (("crown", lambda i, j: i == 0),
                         ("end", lambda i, j: j == 0),
                         ("middle", lambda i, j: j == 2 * n)):
        nodes += f"*NSET, NSET={name}\n" + ",\n".join(
            str(k) for ij, k in numbers.items() if inside(*ij)) + "\n"
    return nodes


@case(1)
def planes_of_curved_edges(nacre):
    """Digits as in single precision, in planes oblique to the axes."""
    prm = of_file("roof.inp",
                  "crown, middle: symmetry; end: diaphragm",
                  Section="set Young's modulus = 4.32e8\n"
                          "set Poisson's ratio = 0\nset Thickness = 0.25",
                  Loads="set Force per area = 0, 0, -90",
                  Quantities="set Quantities = U = energy; w = displacement "
                             "z at (EAVES)")
    prm = prm.replace("Degrees = 3", "Degrees = 2")
    values = []
    for digits, angle in ((15, 0.), (7, 0.), (15, 0.5), (7, 0.5)):
        (nacre.folder / "roof.inp").write_text(roof(digits, angle))
        x, y = 25. * math.sin(math.radians(40.)), 25.
        eaves = (f"{x * math.cos(angle) - y * math.sin(angle)}, "
                 f"{x * math.sin(angle) + y * math.cos(angle)}, "
                 f"{25. * math.cos(math.radians(40.))}")
        values.append(nacre.last(prm.replace("EAVES", eaves),
                                 "Discretization/Element=serendipity"))
        near(values[-1]["U"], values[0]["U"], 1e-4, f"{digits}, {angle}: U")
        near(values[-1]["w"], -0.30059, 1e-2, f"{digits}, {angle}: w")


@case(1)
def plane_across_a_tilted_surface(nacre):
    """A flat shell, tilted about the edge in a coordinate plane."""
    energies = []
    for degrees in (0, 10, 20, 30, 60):
        prm = sections(
            Study="set Degrees = 2",
            **{"Mid-surface": "set Surface = expression\n"
                              "subsection expression\nset Position = u, "
                              f"v*cos({degrees}*pi/180), "
                              f"v*sin({degrees}*pi/180)\nend"},
            Boundary_conditions="set Edges = v=0: symmetry; v=1: clamped",
            Loads="set Pressure = 1e-6",
            Quantities="set Quantities = U = energy; "
                       "w = displacement normal at (0.5, 0, 0)")
        row = nacre.last(prm)
        energies.append(row["U"])
        near(energies[-1], energies[0], 1e-6, f"U at {degrees} degrees")
        check(abs(row["w"]) > 0., "the edge is held")


@case(1)
def planes_of_all_levels(nacre):
    """Multigrid finds a turned roof as easy as one in coordinate planes."""
    rows = []
    for angle in (0., 0.5):
        prm = f"set Constants = C = cos({angle}), S = sin({angle})\n"
        prm += sections(
            Study="set Degrees = 2, 3\nset Refinements = 2",
            **{"Mid-surface": "set Surface = expression\n"
                              "set Subdivisions = 1, 1\nsubsection expression\n"
                              "set Position = 25*sin(u)*C - v*S, "
                              "25*sin(u)*S + v*C, 25*cos(u)\n"
                              "set Range u = 0, 2*pi/9\n"
                              "set Range v = 0, 25\nend",
               "Linear solver": "set Solver = multigrid"},
            Section="set Young's modulus = 4.32e8\n"
                    "set Poisson's ratio = 0\nset Thickness = 0.25",
            Boundary_conditions="set Edges = u=0: symmetry; v=0: diaphragm; "
                                "v=1: symmetry",
            Loads="set Force per area = 0, 0, -90",
            Quantities=names(U="energy"))
        rows.append(nacre.rows(prm))
    for straight, turned in zip(*rows):
        near(turned["U"], straight["U"], 1e-6, "U")
        check(turned["iterations"] <= straight["iterations"] + 1,
              f"{turned['iterations']} iterations")


@case(1)
def no_plane(nacre):
    """An arc within a flat surface, and an edge that leaves any plane."""
    prm = sections(
        Study="set Degrees = 2",
        **{"Mid-surface": "set Surface = expression\nsubsection expression\n"
                          "set Position = (1+u)*cos(v), (1+u)*sin(v), 0\nend"},
        Boundary_conditions="set Edges = u=0: symmetry; u=1: clamped")
    nacre.refuse(prm, "edge 'u=0'", "curved within the surface", "is off by")
    bent = prm.replace("(1+u)*sin(v), 0", "(1+u)*sin(v), 0.1*sin(9*v)")
    nacre.refuse(bent, "edge 'u=0'", "lies in no plane", "is off by")


# --- Reactions and their balance ---------------------------------------------
def names(**quantities):
    return "set Quantities = " + "; ".join(f"{name} = {kind}" for name, kind
                                           in quantities.items())


@case(1, 2)
def four_edges(nacre):
    prm = sections(
        Study="set Degrees = 2",
        Boundary_conditions="set Edges = u=0, u=1, v=0, v=1: z = 0\n"
                            "set Points = (0, 0, 0): x = 0, y = 0; "
                            "(1, 0, 0): y = 0",
        Loads="set Pressure = 1",
        Quantities=names(
            edges="reaction z of u=0, u=1, v=0, v=1", all="reaction z of all",
            one="reaction z of u=0", other="reaction z of v=1",
            two="reaction z of u=0, v=1",
            corner="reaction z of point (0, 1, 0)",
            moment="moment x of all", at="moment x of all about (0, 1/2, 0)",
            twice="reaction z of u=0, u=0, point (0, 0, 0)") +
        "\nset Balance about = (0, 0, 0)")
    row = nacre.last(prm)
    for name in ("edges", "all"):
        near(row[name], -1., 1e-8, name)
    near(row["one"], row["other"], 1e-8, "of two edges")
    near(row["two"], row["one"] + row["other"] - row["corner"], 1e-8,
         "of two edges at once")
    near(row["twice"], row["one"], 1e-12, "of an edge twice")
    near(row["moment"], -0.5, 1e-8, "moment")
    near(row["at"], 0., 1e-8, "moment about the middle", 1.)
    balance = nacre.balance()
    for found, expected in zip(balance["loads"], (0, 0, 1, 0.5, -0.5, 0)):
        near(found, expected, 1e-8, "loads", 1.)
    for k in range(6):
        near(balance["sum"][k], 0., 1e-8, "sum", 1.)
        near(balance["reactions"][k], -balance["loads"][k], 1e-8,
             "reactions", 1.)
    nacre.refuse(prm, "(0.3, 0.3, 0)", "neither a node nor a support",
                 settings=["Quantities/Quantities=R = reaction z of point "
                           "(0.3, 0.3, 0)"])
    nacre.refuse(prm, "'R'", "u=7",
                 settings=["Quantities/Quantities=R = reaction z of u=0, u=7"])


CANTILEVER = sections(
    Study="set Degrees = 3",
    **{"Mid-surface": "set Surface = plate\nset Subdivisions = 4, 1\n"
                      "subsection plate\nset Size = 10, 1\nend"},
    Section="set Young's modulus = 1.2e6\nset Poisson's ratio = 0\n"
            "set Thickness = 0.1\nset Density = 1",
    Boundary_conditions="set Edges = u=0: clamped",
    Loads="set Edge forces = u=1: 0.5, 0, 4\n"
          "set Edge moments = v=0: 0.3\nset Gravity = 0, 0.2, -1\n"
          "set Pressure = 0.1\nset Point forces = (5, 0.3, 0): 0.1, 0.2, 0.3",
    Quantities=names(Fz="reaction z of u=0", My="moment y of u=0",
                     w="displacement z at (10, 0, 0)") +
    "\nset Balance about = (1, 2, 3)")


def check_balance(nacre, tolerance):
    balance = nacre.balance()
    scale = max(abs(x) for x in balance["loads"])
    check(scale > 1., "no loads")
    for k in range(6):
        near(balance["sum"][k], 0., tolerance, f"sum {k}", scale)
    return balance


@case(1, 2)
def balance_with_rotations(nacre):
    """Clamped edges carry moments by their rotation conditions too."""
    row = nacre.last(CANTILEVER)
    balance = check_balance(nacre, 1e-6)
    near(row["Fz"], balance["reactions"][2], 1e-5, "reaction")
    # The co-rotational bending form has a net moment, finite rotations none.
    for kinematics, moment in (("corotational", 5e-3), ("finite", 1e-8)):
        path = CANTILEVER + sections(
            Discretization=f"set Kinematics = {kinematics}",
            Analysis="set Type = static\nset Time step = 0.25")
        path = path.replace("set Pressure", "set Pressure follows = true\n"
                            "set Pressure")
        row = nacre.last(path)
        check(row["w"] > 3., f"{row['w']} is no large displacement")
        balance = check_balance(nacre, 1e-6)
        for k in range(6):
            near(balance["internal"][k], 0., 1e-8 if k < 3 else moment,
                 "internal", abs(balance["loads"][4]))
        near(row["Fz"], balance["reactions"][2], 1e-5, "reaction")


@case(1)
def balance_in_motion(nacre):
    """Inertia stands in the balance too: a free plate that falls."""
    prm = sections(
        Study="set Degrees = 2",
        Section="set Thickness = 0.1\nset Density = 2",
        Loads="set Gravity = 0, 0.5, -3",
        Discretization="set Kinematics = corotational",
        Analysis="set Type = dynamic\nset Load factor = 1\n"
                 "set End time = 0.2\nset Time step = 0.05",
        Quantities="set Balance about = (0, 0, 0)")
    nacre.rows(prm)
    balance = nacre.balance()
    for k, expected in enumerate((0., 0.1, -0.6)):
        near(balance["loads"][k], expected, 1e-8, "weight", 1.)
        near(balance["inertia"][k], -expected, 1e-6, "inertia", 1.)
    for k in range(6):
        near(balance["sum"][k], 0., 1e-6, "sum", 1.)
        near(balance["reactions"][k], 0., 1e-8, "reactions", 1.)


@case(1, 2)
def moment_is_the_energys_derivative(nacre):
    """A strip whose end is turned: T = dU/dtheta with deformed lever arms."""
    check_moment_of_a_turned_end(nacre, "corotational", 1e-4)


@case(1)
def moment_is_the_derivative_of_finite_rotations(nacre):
    """The same; both ends' moments balance to the solver's accuracy."""
    rows = check_moment_of_a_turned_end(nacre, "finite", 1e-7)
    # Simpson's rule for the work of the moment
    for before, row, after in zip(rows[2:], rows[3:], rows[4:]):
        mean = (before["T"] + 4 * row["T"] + after["T"]) / 6
        near(after["U"] - before["U"], mean * (after["time"] - before["time"]),
             1e-5, f"work until {after['time']}")


def check_moment_of_a_turned_end(nacre, kinematics, tolerance):
    prm = "set Constants = L = 10, b = 1\n" + sections(
        Study="set Degrees = 3",
        **{"Mid-surface": "set Surface = expression\nset Subdivisions = 6, 1\n"
                          "subsection expression\nset Position = L*u, b*v, 0\n"
                          "set Range v = -1/2, 1/2\nend"},
        Section="set Young's modulus = 1e6\nset Poisson's ratio = 0\n"
                "set Thickness = 0.05",
        Discretization=f"set Kinematics = {kinematics}",
        Boundary_conditions="set Edges = u=0: clamped; u=1: "
                            "y = y*(cos(t) - 1), z = y*sin(t)",
        Analysis="set Type = static\nset Load factor = 1\n"
                 "set Time step = 0.1\nset End time = 0.8",
        Quantities=names(T="moment x of u=1", U="energy",
                         R="moment x of u=0", S="moment x of all"))
    rows = nacre.rows(prm)
    for before, row, after in zip(rows[2:], rows[3:], rows[4:]):
        slope = (after["U"] - before["U"]) / (after["time"] - before["time"])
        near(row["T"], slope, 5e-3, f"T at {row['time']}")
        near(row["S"], 0., tolerance, "moments of both ends", abs(row["T"]))
        near(row["R"], -row["T"], tolerance, "moment of the other end")
    return rows


# --- Points ------------------------------------------------------------------
PLATE = sections(
    **{"Mid-surface": "set Subdivisions = 3, 3"},
    Boundary_conditions="set Edges = u=0: clamped; v=0: z = 0")
PLACE = "(0.41, 0.57, 0)"


@case(1, 2)
def points_between_nodes(nacre):
    """A prescribed displacement and the force that causes it agree."""
    quantities = names(
        w=f"displacement z at {PLACE}", R=f"reaction z of point {PLACE}",
        rest="reaction z of u=0, v=0", all="reaction z of all", U="energy")
    for element, degree in (("Lagrange", 2), ("Lagrange", 3), ("Lagrange", 4),
                            ("serendipity", 2), ("triangle", 2)):
        held = PLATE.replace("z = 0\n", "z = 0\nset Points = "
                             f"{PLACE}: z = 0.01\n") + sections(
            Study=f"set Degrees = {degree}",
            Discretization=f"set Element = {element}", Quantities=quantities)
        row = nacre.last(held)
        name = f"{element} {degree}"
        near(row["w"], 0.01, 1e-8, f"{name}: w")
        near(row["all"], 0., 1e-7, f"{name}: sum", abs(row["R"]))
        near(row["rest"], -row["R"], 1e-7, f"{name}: other reactions")
        near(row["U"], 0.5 * row["R"] * row["w"], 1e-7, f"{name}: energy")
        pushed = PLATE + sections(
            Study=f"set Degrees = {degree}",
            Discretization=f"set Element = {element}",
            Loads=f"set Point forces = {PLACE}: 0, 0, {row['R']!r}",
            Quantities=names(w=f"displacement z at {PLACE}", U="energy"))
        push = nacre.last(pushed)
        near(push["w"], 0.01, 1e-7, f"{name}: w of the force")
        near(push["U"], row["U"], 1e-7, f"{name}: energy of the force")


@case(1, 2)
def points_with_hanging_nodes(nacre):
    """On refined meshes, in all solvers, with several conditions a cell."""
    prm = sections(
        Study="set Degrees = 3\nset Refinements = 1",
        **{"Mid-surface": "set Subdivisions = 2, 2"},
        Adaptive_refinement="set Cycles = 3\nset Fraction = 0.3",
        Boundary_conditions="set Edges = u=0: clamped; v=0: symmetry\n"
                            f"set Points = {PLACE}: z = 0.01; "
                            "(0.43, 0.6, 0): z = 0.01; (0.7, 0, 0): z = 0; "
                            "(0, 0.3, 0): fixed; (1, 1, 0): x = 0.001",
        Quantities=names(
            w=f"displacement z at {PLACE}",
            v="displacement z at (0.43, 0.6, 0)",
            R=f"reaction z of point {PLACE}, point (0.43, 0.6, 0)",
            one=f"reaction z of point {PLACE}",
            other="reaction z of point (0.43, 0.6, 0)",
            x="reaction x of point (1, 1, 0)",
            all="reaction z of all", U="energy"))
    for solver in ("direct", "multigrid"):
        rows = nacre.rows(prm, f"Linear solver/Solver={solver}")
        for row in rows:
            near(row["w"], 0.01, 1e-8, "w")
            near(row["v"], 0.01, 1e-8, "v")
            near(row["all"], 0., 1e-6, "sum", abs(row["R"]))
            near(row["R"], row["one"] + row["other"], 1e-6, "both points")
            near(row["U"], 0.5 * (0.01 * row["R"] + 0.001 * row["x"]), 1e-6,
                 "energy")
        if solver == "direct":
            direct = rows
        else:
            check("direct solver" not in nacre.said, nacre.said)
            for a, b in zip(direct, rows):
                near(b["U"], a["U"], 1e-6, "energy of multigrid")


@case(1, 2)
def points_on_a_path(nacre):
    """Large rotations with a point between nodes held, and three hold all."""
    prm = CANTILEVER + sections(
        Discretization="set Kinematics = corotational",
        Analysis="set Type = static\nset Time step = 0.5")
    settings = ["Boundary conditions/Points=(4.1, 0.3, 0): z = 0.2*t, y = 0"]
    settings += ["Quantities/Quantities=" +
                 "w = displacement z at (4.1, 0.3, 0);"
                 "R = reaction z of point (4.1, 0.3, 0); U = energy"]
    row = nacre.last(prm, *settings)
    near(row["w"], 0.2, 1e-8, "w")
    check(abs(row["R"]) > 0.1, "no reaction")
    check_balance(nacre, 1e-6)

    three = sections(
        Study="set Degrees = 2",
        Loads="set Force per area = 0, 0, -1e-6",
        Quantities=names(all="reaction z of all", w="maximum displacement"))
    points = ("(0.13, 0.2, 0): fixed; (0.8, 0.31, 0): y = 0, z = 0"
              "; (0.44, 0.9, 0): z = 0")
    row = nacre.last(three, f"Boundary conditions/Points={points}")
    near(row["all"], 1e-6, 1e-6, "reactions of three points")
    nacre.refuse(three, "can move freely", settings=[
        "Boundary conditions/Points=" + points.rsplit(";", 1)[0]])
    nacre.refuse(three, "Contradicting conditions", settings=[
        f"Boundary conditions/Points={points}; (0.44, 0.9, 0): z = 1"])
    nacre.refuse(three, "lies off the mid-surface by 0.5", settings=[
        "Boundary conditions/Points=(0.44, 0.9, 0.5): z = 0"])


SLIT = sections(
    Study="set Degrees = 2",
    **{"Mid-surface": "set Surface = expression\nset Subdivisions = 6, 2\n"
                      "subsection expression\nset Position = "
                      "sin(2*pi*u), v, -cos(2*pi*u)\nend"},
    Boundary_conditions="set Edges = v=0: clamped")


@case(1, 2)
def lips_of_a_slit(nacre):
    """The seam of a cylinder that isn't closed has two nodes everywhere."""
    place = "(0, 0.8, -1)"
    words = ("two parts of the surface that aren't joined there", "such as (")
    for setting in (f"Quantities/Quantities=w = displacement x at {place}",
                    f"Loads/Point forces={place}: 1e-6, 0, 0",
                    f"Boundary conditions/Points={place}: x = 0"):
        nacre.refuse(SLIT, *words, settings=[setting])
    lips = ["(0.02, 0.8, -1)", "(-0.02, 0.8, -1)"]
    row = nacre.last(SLIT, f"Loads/Point forces={lips[0]}: 1e-6, 0, 0",
                     f"Quantities/Quantities=a = displacement x at {lips[0]};"
                     f"b = displacement x at {lips[1]}")
    check(row["a"] > 10. * abs(row["b"]), f"both lips move: {row}")


@case(1, 2)
def no_slit(nacre):
    """Neither cells much longer than wide nor sharp folds are slits."""
    places = [f"({x}, {y}, 0)" for x in (0., 1e-3, 1.1e-3, 2e-3, 4.45e-3, 0.3)
              for y in (0., 0.4999, 0.5, 0.73, 1.)]
    prm = sections(
        Study="set Degrees = 2",
        **{"Mid-surface": "set Surface = plate\nset Subdivisions = 30, 2\n"
                          "set Grading u = s^2"},
        Boundary_conditions="set Edges = u=1: clamped",
        Loads="set Force per area = 0, 0, 1e-9",
        Quantities=names(**{f"w{k}": f"displacement z at {place}"
                            for k, place in enumerate(places)}))
    row = nacre.last(prm)
    for k in range(25):
        near(row[f"w{k}"], row["w2"], 0.1, f"w{k}")
    fold = sections(
        Study="set Degrees = 4",
        **{"Mid-surface": "set Surface = expression\n"
                          "set Subdivisions = 2, 2\nsubsection expression\n"
                          "set Position = abs(u), v, 0.2*u\n"
                          "set Range u = -1, 1\nend"},
        Boundary_conditions="set Edges = u=0: clamped",
        Quantities=names(a="displacement x at (0, 0.5, 0)",
                         b="displacement x at (0.0005, 0.3, 0)",
                         c="displacement x at (0.002, 0.5, -0.0004)",
                         d="displacement normal at (0, 1, 0)"))
    nacre.last(fold)


def main():
    if sys.argv[1] == "--list":
        for name, (ranks, _) in CASES.items():
            for n in ranks:
                print(f"{name} {n}")
        return
    program, n_ranks, name = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    with tempfile.TemporaryDirectory() as folder:
        try:
            CASES[name][1](Nacre(program, n_ranks, Path(folder)))
        except Failure as failure:
            sys.exit(f"{name}: {failure}")
    print(f"{name}: as expected")


if __name__ == "__main__":
    main()
