#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Run a parameter file in a temporary folder and check its table.

  run_study.py NACRE FILE.prm [--set "Section/Parameter=value"]... [--ranks N]
               [--compare-ranks N]...
               [--compare-set "Section/Parameter=value"]...
               --expect "[any] ROWS: CONDITION"...

An expectation is checked on the rows of the .csv for which ROWS holds: on all
of them, or with the word `any` on at least one. It fails if there is no such
row, and if a value that it uses is missing or not finite. ROWS (`all` for
every row) and CONDITION are Python expressions of
  the columns       degree, eta, dofs, ratio, rate_w, ...; numbers, or texts as
                    eta == "default"
  step, last        the row's number, from 0, and if it is the finest, among
                    the rows of its degree, eta and thickness
  listed(a, b, ...) the value number `step` of the list
  at(NAME, thickness=1e-1, ...)
                    the value in the row with these columns and else the same
                    degree, eta, thickness and step
  order(NAME)       the observed order in the size of the cells, from the row of
                    the step before: of |NAME|, or with a second argument of
                    |NAME - exact|
for example
  --expect "any degree == 3 and dofs <= 600: abs(ratio - 1) <= 1e-3"
  --expect "degree == 2 and last: abs(order('L2') - 2) <= 0.15"
  --expect "eta == 5: abs(ratio - listed(.994, .999, .9998)) <= 2e-3"

--compare-ranks N runs the file on N ranks too and compares all columns but the
CPU seconds, memory, solver, iterations, and what divides by a small error
(rates, effectivity) with those of the first run, to the relative --tolerance.
--compare-set does so with a run of another value of a parameter.
"""

import argparse
import ast
import csv
import math
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile

GROUP = ("element", "degree", "eta", "thickness")
OPERATORS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=",
             ast.Eq: "==", ast.NotEq: "!="}
NAMES = {"abs": abs, "min": min, "max": max, "sqrt": math.sqrt}


class Failure(Exception):
    """What a test found, in one sentence."""


def start_alone(folder):
    """Settings of Open MPI for one rank: no daemon, which saves a fifth of a
    second, and a session directory of its own: programs without a daemon
    share one by default, which one that ends removes while another starts."""
    return {"OMPI_MCA_ess_singleton_isolated": "1",
            "OMPI_MCA_orte_tmpdir_base": os.path.abspath(folder)}


def run_nacre(arguments, ranks, folder, overrides=()):
    """Run nacre in `folder` and return the rows of its .csv."""
    command = [os.path.abspath(arguments.nacre), os.path.abspath(arguments.prm)]
    for override in (*arguments.overrides, *overrides):
        command += ["--set", override]
    command += ["--set", "Study/Output folder=output",
                "--set", "Study/Name=study"]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-np", str(ranks)] + command
    environment = dict(os.environ, OMP_NUM_THREADS="1",
                       OMPI_ALLOW_RUN_AS_ROOT="1",
                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    if ranks == 1:
        environment.update(start_alone(folder))
    process = subprocess.Popen(command, cwd=folder, env=environment,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               text=True, errors="replace",
                               start_new_session=True)
    try:
        output, _ = process.communicate(timeout=arguments.timeout)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        raise Failure(f"no end after {arguments.timeout} s on {ranks} ranks")
    print(f"--- {ranks} rank{'s' if ranks > 1 else ''}\n{output}", flush=True)
    if process.returncode != 0:
        raise Failure(f"exit code {process.returncode} on {ranks} ranks")
    return read_table(pathlib.Path(folder, "output", "study.csv"))


def read_table(path):
    """Rows of a .csv: numbers where possible, None where there is no value."""
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text or None

    with open(path, newline="", encoding="utf-8") as file:
        rows = [{name: value(text) for name, text in row.items()}
                for row in csv.DictReader(file)]
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[name] for name in GROUP), []).append(row)
    for group in groups.values():
        for step, row in enumerate(group):
            row["step"] = float(step)
            row["last"] = row is group[-1]
    return rows


class Expectation:
    """One --expect: rows, a condition, and what is measured for it."""

    def __init__(self, text):
        self.text = text
        rows, colon, condition = text.partition(":")
        if not colon:
            raise Failure(f"'{text}': no ':' between the rows and the "
                          "condition")
        match = re.fullmatch(r"\s*(any\b)?\s*(.*?)\s*", rows)
        self.any = bool(match[1])
        self.rows = "True" if match[2] in ("", "all") else match[2]
        self.condition = condition.strip()
        tree = parse(self.condition)
        parse(self.rows)
        self.comparisons = [node for node in ast.walk(tree)
                            if isinstance(node, ast.Compare)]
        self.columns = sorted({node.id for node in ast.walk(tree)
                               if isinstance(node, ast.Name)}
                              - NAMES.keys()
                              - {"at", "order", "listed", "step", "last"})
        if not self.comparisons:
            raise Failure(f"'{text}': the condition compares nothing")

    @staticmethod
    def _evaluate(expression, row, rows, checked):
        """The expression's value in a row; `checked`: values must be finite."""
        def finite(name, value):
            if checked and (value is None or (isinstance(value, float)
                                              and not math.isfinite(value))):
                raise Failure(f"'{name}' has the value '{value}' in the row "
                              + describe(row))
            return value

        def at(name, **columns):
            wanted = {key: row[key] for key in GROUP + ("step",)} | columns
            found = [other for other in rows
                     if all(other[key] == wanted[key] for key in wanted)]
            if len(found) != 1:
                raise Failure(f"at('{name}', {columns}): {len(found)} rows")
            return finite(name, found[0][name])

        def order(name, exact=0.):
            before = [other for other in rows
                      if all(other[key] == row[key] for key in GROUP)
                      and other["step"] == row["step"] - 1]
            if not before:
                raise Failure(f"order('{name}') in the first row")
            errors = [abs(finite(name, other[name]) - exact)
                      for other in (before[0], row)]
            return (math.log(errors[0] / errors[1])
                    / math.log(math.sqrt(row["cells"] / before[0]["cells"])))

        def listed(*values):
            if row["step"] >= len(values):
                raise Failure(f"more rows than values in listed{values}")
            return values[int(row["step"])]

        used = {node.id for node in ast.walk(parse(expression))
                if isinstance(node, ast.Name)}
        names = dict(NAMES, at=at, order=order, listed=listed)
        for name in used - names.keys():
            if name not in row:
                raise Failure(f"no column '{name}'; there are: "
                              + ", ".join(row))
            names[name] = finite(name, row[name])
        try:
            return eval(expression, {"__builtins__": {}}, names)
        except (ArithmeticError, KeyError, TypeError, ValueError) as error:
            raise Failure(f"'{expression}': {error!r}") from error

    def holds(self, rows):
        """Check and print; whether the expectation is met."""
        chosen = [row for row in rows
                  if self._evaluate(self.rows, row, rows, False)]
        print(f"expect {self.text}")
        if not chosen:
            print("  FAILED: no such row")
            return False
        results = []
        for row in chosen:
            good = bool(self._evaluate(self.condition, row, rows, True))
            verdict = "ok" if good else "no" if self.any else "FAILED"
            print(f"  {verdict:6} {describe(row)}: "
                  f"{self._measured(row, rows)}")
            results.append(good)
        success = any(results) if self.any else all(results)
        if self.any and not success:
            print("  FAILED: holds for no row")
        return success

    def _measured(self, row, rows):
        """The columns' values and both sides of the condition's comparisons."""
        def number(node):
            value = self._evaluate(ast.unparse(node), row, rows, True)
            return value if isinstance(value, str) else f"{value:.4g}"

        values = [f"{name} = {row[name]}" if isinstance(row[name], str) else
                  f"{name} = {row[name]:.8g}" for name in self.columns]
        for node in self.comparisons:
            values.append(number(node.left) + "".join(
                f" {OPERATORS.get(type(operator), '?')} {number(right)}"
                for operator, right in zip(node.ops, node.comparators)))
        return ", ".join(values)


def parse(expression):
    try:
        return ast.parse(expression, mode="eval")
    except SyntaxError as error:
        raise Failure(f"'{expression}' is not an expression") from error


def describe(row):
    """The row in a few words."""
    texts = [str(row[name]) if isinstance(row[name], str) else
             f"{row[name]:g}"
             for name in ("degree", "eta", "thickness", "dofs")]
    return "p {}, eta {}, h {}, {} dofs".format(*texts)


def compare(first, second, what, tolerance):
    """Whether the tables of two runs agree; prints the largest difference."""
    def skipped(name):
        return name.startswith("rate_") or re.fullmatch(
            ".*_s|solver|iterations|memory_gb|effectivity", name)

    if len(first) != len(second):
        raise Failure(f"{len(first)} and {len(second)} rows")
    largest, where = 0., ""
    for a, b in zip(first, second):
        for name in a:
            if skipped(name) or a[name] == b[name]:
                continue
            if not isinstance(a[name], float) or not isinstance(b[name], float):
                raise Failure(f"{name}: {a[name]} and {b[name]}")
            difference = (abs(a[name] - b[name])
                          / max(abs(a[name]), abs(b[name])))
            # nan compares false: a value that isn't finite is a difference
            if not difference <= largest:
                largest, where = difference, f" ({name}, {describe(a)})"
    good = largest <= tolerance
    print(f"{'ok    ' if good else 'FAILED'} {what} differs by "
          f"{largest:.2g}{where}, allowed are {tolerance:g}")
    return good


def run_cases(cases, run_case, usage):
    """Of a script NACRE CASE, or --list: the exit code of run_case(NACRE,
    *cases[CASE])."""
    if sys.argv[1:] == ["--list"]:
        print("\n".join(cases))
        return 0
    if len(sys.argv) != 3 or sys.argv[2] not in cases:
        sys.exit(usage)
    try:
        run_case(sys.argv[1], *cases[sys.argv[2]])
    except Failure as failure:
        print(f"FAILED: {failure}")
        return 1
    return 0


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("nacre", help="the program")
    parser.add_argument("prm", help="parameter file")
    parser.add_argument("--set", action="append", default=[], dest="overrides",
                        metavar="Section/Parameter=value")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--compare-ranks", type=int, action="append",
                        default=[])
    parser.add_argument("--compare-set", action="append", default=[],
                        metavar="Section/Parameter=value")
    parser.add_argument("--tolerance", type=float, default=1e-6)
    parser.add_argument("--expect", action="append", default=[])
    parser.add_argument("--timeout", type=float, default=300, help="seconds")
    arguments = parser.parse_args()
    if not (arguments.expect or arguments.compare_ranks
            or arguments.compare_set):
        parser.error("neither --expect nor a comparison: nothing to check")
    return arguments


def main():
    arguments = parse_arguments()
    try:
        expectations = [Expectation(text) for text in arguments.expect]
        with tempfile.TemporaryDirectory() as folder:
            rows = run_nacre(arguments, arguments.ranks, folder)
        if not rows:
            raise Failure("the table is empty")
        results = [expectation.holds(rows) for expectation in expectations]
        for ranks in arguments.compare_ranks:
            with tempfile.TemporaryDirectory() as folder:
                others = run_nacre(arguments, ranks, folder)
            results.append(compare(rows, others, f"the run on {ranks} ranks",
                                   arguments.tolerance))
        for override in arguments.compare_set:
            with tempfile.TemporaryDirectory() as folder:
                others = run_nacre(arguments, arguments.ranks, folder,
                                   [override])
            results.append(compare(rows, others, override, arguments.tolerance))
    except Failure as failure:
        print(f"FAILED: {failure}")
        return 1
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
