#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Manufactured solutions of the linear Kirchhoff-Love shell.

Writes prm/convergence/manufactured_*.prm: loads from the strong form of the
equations in doc/formulation.md, never from the discrete form.

    manufactured.py          write the files
    manufactured.py --check  compare with the files instead; exit code 1 if
                             one differs
    manufactured.py --test   check what the files say against the weak form,
                             by Gauss quadrature in the surface's chart

Strong form. With P = I - t0 t0 the projection on the tangent plane and
D_k = P_kl d/dx_l the surface gradient in global components,

    eps_ij = 1/2 (P_ik D_j U_k + P_jk D_i U_k)             membrane strain
    rho_ij = - t0_c P_il D_j D_l U_c                       bending strain
    n = E h/(1-nu^2)         ((1-nu) eps + nu tr(eps) P)
    m = E h^3/(12 (1-nu^2))  ((1-nu) rho + nu tr(rho) P)

and integrating int n:eps(V) + m:rho(V) dA by parts for arbitrary V gives the
force per area

    f_c = - D_j n_cj - D_i (P_il D_j (m_lj t0_c)),

in surface coordinates -(1/sqrt a) [(sqrt a n^ab a_a),b + (sqrt a m^ab t0),ab
+ (sqrt a m^ab Gamma^g_ab t0),g]. For V = 0 on the boundary the remaining
boundary term is int f.V dA = int n:eps(V) + m:rho(V) dA + int m_nn theta(V) ds
with theta(V) = t0 . dV/dnu, nu the outward unit conormal, m_nn = nu . m nu.

All quantities are polynomials over the rationals in x, y, z, nu, h^2/12, the
waves sin(...), cos(...) of the exact displacement and, on the hyperbolic
paraboloid, r = 1/sqrt(1 + x^2 + y^2); only the gradients of these generators
and one algebraic relation depend on the surface.
"""

import argparse
import math
import pathlib
import sys

import numpy as np
import sympy

SPACE = range(3)
TOLERANCE = 1e-8
WIDTH = 78
FOLDER = pathlib.Path(__file__).resolve().parent.parent / "prm" / "convergence"


# -------------------------------------------------------------------- text
def linear_text(factors, names):
    """(4, -2), ("x", "y") -> 4*x-2*y"""
    text = ""
    for factor, name in zip(factors, names):
        if factor != 0:
            text += f"{factor:+d}*{name}"
    return text.removeprefix("+")


def join(first, second):
    return first + (second if second.startswith("-") else "+" + second)


def times(text, is_sum, name, power):
    """text * name^power; a name that begins with / divides."""
    exponent = "" if power == 1 else f"^{power}"
    if name.startswith("/"):
        return (f"({text})" if is_sum else text) + name + exponent
    if is_sum:
        return f"{name}{exponent}*({text})"
    if text in ("1", "-1"):
        return text[:-1] + name + exponent
    return f"{text}*{name}{exponent}"


def horner(terms, names):
    """(text, whether it is a sum) of {exponents: integer} in Horner form,
    the first name outermost."""
    if all(not any(exponents) for exponents in terms):
        (value,) = terms.values()
        return str(value), False
    i = min(k for e in terms for k, power in enumerate(e) if power > 0)
    power = min(e[i] for e in terms if e[i] > 0)
    rest = {e: c for e, c in terms.items() if e[i] == 0}
    inner = {e[:i] + (e[i] - power,) + e[i + 1:]: c
             for e, c in terms.items() if e[i] > 0}
    text = times(*horner(inner, names), names[i], power)
    if not rest:
        return text, False
    return join(horner(rest, names)[0], text), True


def polynomial_text(surface, f, prefix=""):
    """prefix * f for muParser; r^2 is printed as 1/(1+x^2+y^2)."""
    if f == 0:
        return "0"
    order = ([n for n in ("r",) if n in surface.names]
             + [n for n in surface.names if n[0] in "SC"]
             + ["nu", "b", "x", "y", "z"])
    index = [surface.names.index(n) for n in order]
    scale = math.lcm(*(int(c.denominator) for _, c in f.terms()))
    terms = {tuple(m[i] for i in index): int(c * scale)
             for m, c in f.terms()}
    scale = sympy.Rational(math.gcd(*terms.values()), scale)
    if len(terms) == 1 and not prefix and scale.q == 1:
        scale = sympy.S.One
    terms = {m: c // int(scale.p) for m, c in terms.items()}
    if scale.q != 1:
        prefix = (prefix or "1") + f"/{scale.q}"
    if scale.p != 1:
        prefix = (f"{scale.p}{prefix[1:]}" if prefix.startswith("1/") else
                  f"{scale.p}*{prefix}".removesuffix("*"))
    text = surface.text()
    if order[0] == "r":
        odd = {m[0] % 2 for m in terms}.pop()
        assert all(m[0] % 2 == odd for m in terms)
        terms = {((m[0] - odd) // 2,) + m[1:]: c for m, c in terms.items()}
        order[0] = "q"
        if odd:
            prefix = (prefix or "1") + "/sqrt(1+x^2+y^2)"
    result, is_sum = horner(terms, [text[n] for n in order])
    if not prefix:
        return result
    return f"{prefix}*({result})"


# ---------------------------------------------------------------- surfaces
class Surface:
    """Polynomial ring, calculus and text of one surface.

    waves: the phases, each a pair (gradient of the phase along the chart's
    coordinates, text); wave k gives the generators S<k> and C<k>.
    """

    coordinates = "x y z"

    def __init__(self):
        names = self.coordinates.split()
        self.phases = self.waves()
        for k in range(len(self.phases)):
            names += [f"S{k}", f"C{k}"]
        names += ["nu", "b"]
        self.ring = sympy.polys.rings.ring(names, sympy.QQ)[0]
        self.g = dict(zip(names, self.ring.gens))
        self.names = names
        self.rates = self.gradients()
        for k, phase in enumerate(self.phases):
            slope = self.phase_gradient(phase)
            sine, cosine = self.g[f"S{k}"], self.g[f"C{k}"]
            self.rates[f"S{k}"] = [cosine * s for s in slope]
            self.rates[f"C{k}"] = [-sine * s for s in slope]
        self.t0 = self.normal()
        one, zero = self.ring.one, self.ring.zero
        self.P = [[self.reduce((one if i == j else zero)
                               - self.t0[i] * self.t0[j])
                   for j in SPACE] for i in SPACE]
        self.U = [self.reduce(u) for u in self.displacement()]

    def constant(self, value):
        return self.ring(sympy.QQ(value))

    def gradients(self):
        """Gradient of x, y, z: the unit vectors."""
        return {name: [self.constant(int(i == j)) for j in SPACE]
                for i, name in enumerate("xyz")}

    def phase_gradient(self, phase):
        """Phases are linear in x, y, z unless a surface says otherwise."""
        return [self.constant(k) for k in phase]

    def phase_text(self, phase):
        return linear_text(phase, ("x", "y", "z"))

    def text(self):
        """What to print for each generator."""
        names = {name: name for name in self.names}
        names["b"] = "h^2/12"
        names["q"] = "/(1+x^2+y^2)"
        for k, phase in enumerate(self.phases):
            names[f"S{k}"] = f"sin({self.phase_text(phase)})"
            names[f"C{k}"] = f"cos({self.phase_text(phase)})"
        return names

    def surface_gradient(self, f):
        """D_k f, k = 0, 1, 2."""
        full = [self.ring.zero] * 3
        for name, rate in self.rates.items():
            slope = f.diff(self.g[name])
            if slope != 0:
                full = [full[k] + slope * rate[k] for k in SPACE]
        return [self.reduce(sum(self.P[k][l] * full[l] for l in SPACE))
                for k in SPACE]

    def project(self, t):
        """P_il t_lj."""
        return [[self.reduce(sum(self.P[i][l] * t[l][j] for l in SPACE))
                 for j in SPACE] for i in SPACE]

    def section(self, strain):
        """(1-nu) strain + nu tr(strain) P."""
        nu = self.g["nu"]
        trace = sum(strain[i][i] for i in SPACE)
        return [[self.reduce((1 - nu) * strain[i][j]
                             + nu * trace * self.P[i][j])
                 for j in SPACE] for i in SPACE]

    def membrane_strain(self):
        t = self.project([self.surface_gradient(u) for u in self.U])
        half = self.ring(sympy.QQ(1, 2))
        return [[half * (t[i][j] + t[j][i]) for j in SPACE] for i in SPACE]

    def bending_strain(self):
        rho = [[self.ring.zero] * 3 for _ in SPACE]
        for c in SPACE:
            hessian = self.project([self.surface_gradient(w) for w in
                                    self.surface_gradient(self.U[c])])
            rho = [[self.reduce(rho[i][j] - self.t0[c] * hessian[i][j])
                    for j in SPACE] for i in SPACE]
        return rho

    def divergence(self, t):
        """D_j t_ij."""
        return [self.reduce(sum(self.surface_gradient(t[i][j])[j]
                                for j in SPACE)) for i in SPACE]

    def force(self):
        """f (1-nu^2)/(E h), b standing for h^2/12."""
        n = self.section(self.membrane_strain())
        m = self.section(self.bending_strain())
        membrane = self.divergence(n)
        result = []
        for c in SPACE:
            w = self.divergence([[self.reduce(m[l][j] * self.t0[c])
                                  for j in SPACE] for l in SPACE])
            tangent = [self.reduce(sum(self.P[i][l] * w[l] for l in SPACE))
                       for i in SPACE]
            bending = sum(self.surface_gradient(tangent[i])[i]
                          for i in SPACE)
            result.append(self.reduce(-membrane[c] - self.g["b"] * bending))
        return result

    def rotation(self, conormal):
        """theta = t0 . dU/dnu for the conormal nu."""
        return self.reduce(sum(
            self.t0[c] * conormal[k] * self.surface_gradient(self.U[c])[k]
            for c in SPACE for k in SPACE))

    def moment(self, conormal):
        """m_nn 12 (1-nu^2)/(E h^3)."""
        m = self.section(self.bending_strain())
        return self.reduce(sum(conormal[i] * m[i][j] * conormal[j]
                               for i in SPACE for j in SPACE))

    def replace_square(self, f, name, square):
        """f with every name^2 replaced by the polynomial square."""
        index = self.names.index(name)
        parts = {}
        for monomial, coefficient in f.terms():
            power = monomial[index]
            rest = list(monomial)
            rest[index] = power % 2
            part = parts.setdefault(power // 2, self.ring.zero)
            part[tuple(rest)] = part.get(tuple(rest), 0) + coefficient
            parts[power // 2] = part
        result = self.ring.zero
        for power, part in parts.items():
            result = result + part * square ** power
        return result


class Plane(Surface):
    name = "plane"
    title = "Manufactured solution on a plane"
    surface = "plate"
    parameters = ["Size = 1, 1"]

    def waves(self):
        return [(4, -2, 0), (2, 4, 0), (4, 3, 0), (2, -5, 0)]

    def displacement(self):
        g = self.g
        return [g["C0"], g["S1"], g["S2"] + g["C3"]]

    def reduce(self, f):
        return f

    def normal(self):
        return [self.ring.zero, self.ring.zero, self.ring.one]

    def conormals(self):
        """For u=1 and v=1: the outward unit conormal times sqrt(text), text
        (empty: 1) and vector."""
        one, zero = self.ring.one, self.ring.zero
        return [("", [one, zero, zero]), ("", [zero, one, zero])]

    @staticmethod
    def chart():
        u, v = sympy.symbols("u v")
        return (u, v), (u, v, sympy.S.Zero), ((0, 1), (0, 1))


class Cylinder(Surface):
    """Radius 1, axis z; u = angle a, v = z; waves in (a, z)."""

    name = "cylinder"
    title = "Manufactured solution on a cylinder"
    surface = "cylinder"
    parameters = ["Radius = 1", "Axis = z", "Angle range = 0, 60",
                  "Axial range = 0, 1"]

    def waves(self):
        return [(5, 4), (3, -2), (2, 3)]

    def phase_gradient(self, phase):
        x, y = self.g["x"], self.g["y"]
        return [-phase[0] * y, phase[0] * x, self.constant(phase[1])]

    def phase_text(self, phase):
        return linear_text(phase, ("atan2(y,x)", "z"))

    def displacement(self):
        g = self.g
        radial, hoop = g["S0"], g["C1"]
        return [g["x"] * radial - g["y"] * hoop,
                g["y"] * radial + g["x"] * hoop, g["S2"]]

    def reduce(self, f):
        return self.replace_square(f, "y", 1 - self.g["x"] ** 2)

    def normal(self):
        return [self.g["x"], self.g["y"], self.ring.zero]

    def conormals(self):
        zero, one = self.ring.zero, self.ring.one
        return [("", [-self.g["y"], self.g["x"], zero]),
                ("", [zero, zero, one])]

    @staticmethod
    def chart():
        u, v = sympy.symbols("u v")
        return ((u, v), (sympy.cos(u), sympy.sin(u), v),
                ((0, math.pi / 3), (0, 1)))


class HyperbolicParaboloid(Surface):
    """z = (x^2 - y^2)/2; generator r = (1 + x^2 + y^2)^(-1/2)."""

    name = "hyperbolic_paraboloid"
    title = "Manufactured solution on a hyperbolic paraboloid"
    surface = "hyperbolic paraboloid"
    parameters = ["Coefficient = 0.5", "Range x = -0.5, 0.5",
                  "Range y = -0.5, 0.5"]
    coordinates = "x y z r"

    def waves(self):
        return [(4, 0, 0), (0, 4, 0)]

    def gradients(self):
        result = super().gradients()
        x, y, r = self.g["x"], self.g["y"], self.g["r"]
        result["r"] = [-x * r ** 3, -y * r ** 3, self.ring.zero]
        return result

    def displacement(self):
        g = self.g
        return [g["S1"], g["C0"], g["S0"] + g["C1"]]

    def reduce(self, f):
        """y^2 r^2 = 1 - r^2 - x^2 r^2."""
        i, j = self.names.index("y"), self.names.index("r")
        square = 1 - (1 + self.g["x"] ** 2) * self.g["r"] ** 2
        parts = {}
        for monomial, coefficient in f.terms():
            power = min(monomial[i] // 2, monomial[j] // 2)
            rest = list(monomial)
            rest[i] -= 2 * power
            rest[j] -= 2 * power
            part = parts.setdefault(power, self.ring.zero)
            part[tuple(rest)] = part.get(tuple(rest), 0) + coefficient
        result = self.ring.zero
        for power, part in parts.items():
            result += part * square ** power
        return result if max(parts, default=0) == 0 else self.reduce(result)

    def normal(self):
        x, y, r = self.g["x"], self.g["y"], self.g["r"]
        return [-x * r, y * r, r]

    def conormals(self):
        x, y, r = self.g["x"], self.g["y"], self.g["r"]
        return [("1+y^2", [r * (1 + y ** 2), r * x * y, r * x]),
                ("1+x^2", [r * x * y, r * (1 + x ** 2), -r * y])]

    @staticmethod
    def chart():
        u, v = sympy.symbols("u v")
        return ((u, v), (u, v, (u ** 2 - v ** 2) / 2),
                ((-0.5, 0.5), (-0.5, 0.5)))


class Sphere(Surface):
    """Radius 1; u = polar angle, v = azimuth, away from the poles."""

    name = "sphere"
    title = "Manufactured solution on a sphere"
    surface = "expression"
    parameters = ["Position = sin(u)*cos(v), sin(u)*sin(v), cos(u)",
                  "Range u = 40*pi/180, 80*pi/180",
                  "Range v = 0, 60*pi/180"]

    def waves(self):
        return [(0, 0, 5), (5, 0, 0), (0, 5, 0)]

    def displacement(self):
        g = self.g
        return [g["S0"], g["C1"], g["S2"]]

    def reduce(self, f):
        return self.replace_square(
            f, "z", 1 - self.g["x"] ** 2 - self.g["y"] ** 2)

    def normal(self):
        return [self.g["x"], self.g["y"], self.g["z"]]

    def conormals(self):
        x, y, z = self.g["x"], self.g["y"], self.g["z"]
        return [("x^2+y^2", [x * z, y * z, -x ** 2 - y ** 2]),
                ("x^2+y^2", [-y, x, self.ring.zero])]

    @staticmethod
    def chart():
        u, v = sympy.symbols("u v")
        sin, cos = sympy.sin, sympy.cos
        return ((u, v), (sin(u) * cos(v), sin(u) * sin(v), cos(u)),
                ((math.radians(40), math.radians(80)), (0, math.pi / 3)))




SURFACES = (Plane, Cylinder, HyperbolicParaboloid, Sphere)


# -------------------------------------------------------------------- files
HEADER = """\
# Generated by scripts/manufactured.py: change that script, not this file.
#
# {title}:
# the displacement u below is the exact solution of the linear Kirchhoff-Love
# shell under the force per area
#   f = -(1/sqrt a) [ (sqrt a n^ab a_a),b + (sqrt a m^ab t0),ab
#                     + (sqrt a m^ab Gamma^g_ab t0),g ]
#   n^ab = E h/(1-nu^2) H^abcd eps_cd(u)
#   m^ab = E h^3/(12 (1-nu^2)) H^abcd rho_cd(u)
#   H^abcd = nu a^ab a^cd + (1-nu)/2 (a^ac a^bd + a^ad a^bc)
#   eps_ab(u) = 1/2 (a_a.u,b + a_b.u,a)
#   rho_ab(u) = -(u,ab - Gamma^g_ab u,g).t0
# which is the strong form, not the discrete one. On the edges: u; on u=0, v=0
# and v=1 the rotation theta = t0.du/dn, n the outward conormal; on u=1 the
# moment m_nn. Loads and data hold for every E, nu and h.
#
# Expected rates: L2 error 2 for p = 2 and p+1 for p >= 3; energy error p-1.
# One penalty for all degrees, above the bound (1.7) of p = 4: with the smaller
# default of p = 2 the same rate in L2 shows up to two refinements later.
"""


def entry(name, value):
    """A parameter, its value broken before operators or after separators."""
    line = f"  set {name} = {value}"
    lines = []
    while len(line) > WIDTH:
        cuts = [max(line.rfind(c, 1, WIDTH - 2) + len(c) - 1 for c in group)
                for group in ((", ", "; "), "+-", "*/")]
        cut = next(c for c, low in zip(cuts, (50, 30, 5)) if c > low)
        lines.append(line[:cut].rstrip() + " \\")
        line = "    " + line[cut:].strip()
    return "\n".join(lines + [line])


def subsection(name, entries):
    return "\n".join([f"subsection {name}"] + entries + ["end", ""])


def boundary_texts(surface):
    """Values of Edges and of Edge moments."""
    u = ", ".join(f"{c} = {polynomial_text(surface, f)}"
                  for c, f in zip("xyz", surface.U))
    edges = []
    for direction, (square, conormal) in zip("uv", surface.conormals()):
        for end, sign in (0, -1), (1, 1):
            edge = f"{direction}={end}"
            if edge == "u=1":
                edges.append(f"{edge}: {u}")
                continue
            theta = surface.rotation([sign * n for n in conormal])
            factor = f"1/sqrt({square})" if square else ""
            edges.append(f"{edge}: {u}, rotation = "
                         + polynomial_text(surface, theta, factor))
    square, conormal = surface.conormals()[0]
    factor = "E*h^3/(12*(1-nu^2))" + (f"/({square})" if square else "")
    moment = polynomial_text(surface, surface.moment(conormal), factor)
    return "; ".join(edges), f"u=1: {moment}"


def parameter_file(surface):
    force = [polynomial_text(surface, f, "E*h/(1-nu^2)")
             for f in surface.force()]
    displacement = [polynomial_text(surface, f) for f in surface.U]
    edges, moments = boundary_texts(surface)
    midsurface = [entry("Surface", surface.surface),
                  entry("Subdivisions", "2, 2"),
                  f"  subsection {surface.surface}"]
    midsurface += ["    set " + p for p in surface.parameters] + ["  end"]
    return HEADER.format(title=surface.title) + "\n" + "\n".join([
        f"set Title = {surface.title}", "",
        subsection("Study", [
            entry("Degrees", "2, 3, 4"),
            entry("Penalties", "5"),
            entry("Refinements", "0, 1, 2, 3"),
            entry("Write VTU", "false")]),
        subsection("Mid-surface", midsurface),
        subsection("Section", [
            entry("Young's modulus", "1"),
            entry("Poisson's ratio", "0.3"),
            entry("Thickness", "0.1")]),
        subsection("Boundary conditions", [entry("Edges", edges)]),
        subsection("Loads", [
            entry("Force per area", ", ".join(force)),
            entry("Edge moments", moments)]),
        subsection("Exact solution", [
            entry("Displacement", ", ".join(displacement))]),
        subsection("Quantities", [
            entry("Quantities", "L2 = L2 error; H1 = H1 error; "
                  "en = energy error")])])


def path(surface):
    return FOLDER / f"manufactured_{surface.name}.prm"


# --------------------------------------------------------------------- test
def read_values(text):
    """{parameter: value} of a parameter file."""
    text = "\n".join(line for line in text.split("\n")
                     if not line.startswith("#"))
    values = {}
    while "\\\n" in text:
        before, after = text.split("\\\n", 1)
        text = before + after.lstrip()
    for line in text.split("\n"):
        if line.strip().startswith("set "):
            name, value = line.strip()[4:].split("=", 1)
            values[name.strip()] = value.strip()
    return values


def split(text, separator):
    """Parts of text between separators outside parentheses."""
    parts, depth = [""], 0
    for character in text:
        depth += (character == "(") - (character == ")")
        if character == separator and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return [part.strip() for part in parts]


class WeakForm:
    """The chart's formulas of section 2, at Gauss points, by numbers."""

    def __init__(self, surface, values):
        self.numbers = {"E": float(values["Young's modulus"]),
                        "nu": float(values["Poisson's ratio"]),
                        "h": float(values["Thickness"])}
        self.values = values
        self.uv, self.X, self.ranges = surface.chart()
        self.U = [self.symbol(c) for c in split(values["Displacement"], ",")]
        points, weights = np.polynomial.legendre.leggauss(40)
        self.points, self.weights = (points + 1) / 2, weights / 2

    def symbol(self, text):
        """A muParser expression as a function of the chart's (u, v)."""
        return sympy.sympify(
            text.replace("^", "**"),
            locals=dict(zip("xyz", self.X), **{
                k: sympy.Symbol(k) for k in self.numbers}))

    def evaluate(self, expression, u, v):
        f = sympy.lambdify(self.uv, sympy.sympify(expression).subs(
            self.numbers), "numpy")
        return f(u, v) * np.ones_like(u)

    def field(self, f, u, v):
        """Value, first and second derivatives: [c], [a][c], [a][b][c]."""
        def vector(g):
            return np.array([self.evaluate(c, u, v) for c in g])

        def diff(g, i):
            return [sympy.diff(c, self.uv[i]) for c in g]
        return (vector(f),
                np.array([vector(diff(f, a)) for a in (0, 1)]),
                np.array([[vector(diff(diff(f, a), b)) for b in (0, 1)]
                          for a in (0, 1)]))

    def at(self, text, u, v):
        """A muParser expression at the points X(u, v), not by sympy."""
        names = {n: getattr(np, n) for n in ("sin", "cos", "sqrt")}
        names["atan2"] = np.arctan2
        names.update(self.numbers)
        names.update(zip("xyz", self.field(self.X, u, v)[0]))
        return eval(text.replace("^", "**"), names) * np.ones_like(u)

    def frame(self, u, v):
        _, a, da = self.field(self.X, u, v)
        t0 = np.cross(a[0], a[1], axis=0)
        j0 = np.linalg.norm(t0, axis=0)
        t0 /= j0
        metric = np.einsum("acq,bcq->qab", a, a)
        inverse = np.linalg.inv(metric).transpose(1, 2, 0)
        dual = np.einsum("abq,bcq->acq", inverse, a)
        gamma = np.einsum("gcq,abcq->gabq", dual, da)
        return a, dual, inverse, gamma, t0, j0

    @staticmethod
    def strains(frame, field):
        a, _, _, gamma, t0, _ = frame
        eps = np.einsum("acq,bcq->abq", a, field[1])
        covariant = field[2] - np.einsum("gabq,gcq->abcq", gamma, field[1])
        return (0.5 * (eps + eps.transpose(1, 0, 2)),
                -np.einsum("abcq,cq->abq", covariant, t0))

    def section(self, frame, strain, factor):
        inverse, nu = frame[2], self.numbers["nu"]
        raised = np.einsum("acq,bdq,cdq->abq", inverse, inverse, strain)
        trace = np.einsum("abq,abq->q", inverse, strain)
        return factor * ((1 - nu) * raised + nu * inverse * trace)

    def resultants(self, frame, u, v):
        eps, rho = self.strains(frame, self.field(self.U, u, v))
        E, nu, h = (self.numbers[k] for k in ("E", "nu", "h"))
        factor = E * h / (1 - nu ** 2)
        return (self.section(frame, eps, factor),
                self.section(frame, rho, factor * h ** 2 / 12))

    def interior(self, V):
        """int f.V dA and int n:eps(V) + m:rho(V) dA."""
        (u0, u1), (v0, v1) = self.ranges
        s, t = (g.ravel() for g in np.meshgrid(self.points, self.points))
        u, v = u0 + (u1 - u0) * s, v0 + (v1 - v0) * t
        frame = self.frame(u, v)
        dA = np.outer(self.weights, self.weights).ravel() * frame[5]
        dA = dA * (u1 - u0) * (v1 - v0)
        field = self.field(V, u, v)
        force = np.array([self.at(f, u, v) for f in
                          split(self.values["Force per area"], ",")])
        work = sum(np.einsum("abq,abq,q->", r, e, dA) for r, e in
                   zip(self.resultants(frame, u, v),
                       self.strains(frame, field)))
        return np.einsum("cq,cq,q->", force, field[0], dA), work

    def edge(self, name):
        """Points, frame, outward conormal, ds of an edge, e.g. "u=1"."""
        along = 1 if name[0] == "u" else 0
        end = int(name[2])
        uv = [None, None]
        uv[1 - along] = np.full_like(self.points,
                                     self.ranges[1 - along][end])
        low, high = self.ranges[along]
        uv[along] = low + (high - low) * self.points
        frame = self.frame(*uv)
        length = np.linalg.norm(frame[0][along], axis=0)
        conormal = frame[1][1 - along] * (1 if end else -1)
        conormal = conormal / np.linalg.norm(conormal, axis=0)
        return uv, frame, conormal, length * self.weights * (high - low)

    @staticmethod
    def theta(frame, conormal, field):
        along = np.einsum("acq,cq->aq", frame[1], conormal)
        return np.einsum("aq,acq,cq->q", along, field[1], frame[4])


def test_edges(weak, values):
    """Largest error of the displacements and rotations on the edges."""
    worst = 0.
    for part in split(values["Edges"], ";"):
        name, items = part.split(":", 1)
        uv, frame, conormal, _ = weak.edge(name)
        field = weak.field(weak.U, *uv)
        exact = dict(zip("xyz", field[0]))
        exact["rotation"] = weak.theta(frame, conormal, field)
        for item in split(items, ","):
            key, text = item.split("=", 1)
            error = weak.at(text, *uv) - exact[key.strip()]
            worst = max(worst, np.abs(error).max())
    return worst


def test_work(weak, values):
    """Largest relative error of int f.V dA = internal work + edge moment."""
    (u0, u1), (v0, v1) = weak.ranges
    s = (weak.uv[0] - u0) / (u1 - u0)
    t = (weak.uv[1] - v0) / (v1 - v0)
    bump = 256 * (s * (1 - s) * t * (1 - t)) ** 4 * (1 + s + 2 * t)
    hinge = 16 * s ** 2 * (1 - s) * (t * (1 - t)) ** 2 * (2 - t)
    name, text = values["Edge moments"].split(":", 1)
    uv, frame, conormal, ds = weak.edge(name)
    worst = 0.
    for shape in bump, hinge:
        for c in SPACE:
            V = [shape * int(c == d) for d in SPACE]
            load, work = weak.interior(V)
            rotation = weak.theta(frame, conormal, weak.field(V, *uv))
            moment = np.sum(weak.at(text, *uv) * rotation * ds)
            scale = max(abs(load), abs(work), abs(moment))
            worst = max(worst, abs(load - work - moment) / scale)
    return worst


def test(surface, text):
    """True if the weak form confirms the parameter file."""
    values = read_values(text)
    good = True
    for thickness in values["Thickness"], "2":
        values["Thickness"] = thickness
        weak = WeakForm(surface, values)
        errors = {"edge data": test_edges(weak, values),
                  "work": test_work(weak, values)}
        for what, error in errors.items():
            passed = error < TOLERANCE
            good = good and passed
            print(f"{surface.name}, h = {thickness}, {what}: {error:.1e}",
                  "passed" if passed else "FAILED")
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--check", action="store_true",
                        help="compare with the files, write nothing")
    parser.add_argument("--test", action="store_true",
                        help="check the files' contents by the weak form")
    arguments = parser.parse_args()
    good = True
    for surface in (kind() for kind in SURFACES):
        text = parameter_file(surface)
        file = path(surface)
        if arguments.test:
            good = test(surface, text) and good
        if arguments.check:
            same = file.exists() and file.read_text() == text
            good = good and same
            print(file.name, "as generated" if same else "DIFFERS")
        elif not arguments.test:
            file.write_text(text)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
