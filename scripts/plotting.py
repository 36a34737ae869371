# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables and pictures, as plot, plot_path and compare_path.py take them, and
what is wrong with them in one sentence."""

import argparse
import csv
import pathlib
import sys

# Pictures of curves may be any of these.
CURVES = (".png", ".pdf", ".svg")


class BadFile(Exception):
    """What is wrong with a file, in one sentence."""


def read_rows(path, needed, least=1):
    """Rows of a .csv, `least` or more, as dictionaries of trimmed texts, with a
    column `needed` and as many cells each as there are names."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            names, *lines = [[cell.strip() for cell in line]
                             for line in csv.reader(file) if line] or [[]]
    except OSError as error:
        raise BadFile(f"{path}: {error.strerror}") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise BadFile(f"{path} is no table: {error}") from error
    if needed not in names:
        raise BadFile(f"{path} has no column '{needed}'")
    if len(lines) < least:
        raise BadFile(f"{path} has {len(lines)} rows; {least} at least are "
                      "needed")
    for number, line in enumerate(lines, 2):
        if len(line) != len(names):
            raise BadFile(f"{path}, row {number}: {len(line)} cells; there "
                          f"are {len(names)} columns")
    return [dict(zip(names, line)) for line in lines]


def numbers(path, rows, name):
    """The numbers of a column; nan where a cell is empty."""
    if rows and name not in rows[0]:
        raise BadFile(f"{path} has no column '{name}'; it has: "
                      + ", ".join(rows[0]))
    values = []
    for row in rows:
        try:
            values.append(float(row[name] or "nan"))
        except ValueError as error:
            raise BadFile(f"{path}: '{row[name]}' in the column '{name}' is no "
                          "number") from error
    return values


def picture(*suffixes):
    """A type of argparse: a file to write, with one of the suffixes."""
    def check(text):
        path = pathlib.Path(text)
        if path.suffix.lower() not in suffixes:
            raise argparse.ArgumentTypeError(
                f"'{text}' doesn't end with " + " or ".join(suffixes))
        if not path.parent.is_dir():
            raise argparse.ArgumentTypeError(
                f"'{text}': there is no folder '{path.parent}'")
        return text
    return check


def positive(kind):
    """A type of argparse: a finite number of the kind, above 0."""
    def check(text):
        try:
            value = kind(text)
        except ValueError:
            value = 0
        if not 0 < value < float("inf"):
            raise argparse.ArgumentTypeError(f"'{text}' is no positive number")
        return value
    return check


def run(program, main):
    """Call main(); what is wrong ends the program with a line and code 1."""
    try:
        main()
    except BadFile as error:
        sys.exit(f"{program}: {error}")
    except OSError as error:
        sys.exit(f"{program}: {error.filename}: {error.strerror}")
