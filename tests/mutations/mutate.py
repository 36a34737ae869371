#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Copies of sources in which the terms of mutants.ini can be falsified.

  mutate.py --list SOURCE_DIR         what CMake needs to know, as lists
  mutate.py SOURCE_DIR FILE RESULT    the copy of one file

In a copy, an expression becomes (is_mutant("name") ? replacement : it).
"""
import configparser
import pathlib
import re
import sys


class Mutant:
    def __init__(self, name, row):
        self.name = name
        self.file = row["file"]
        self.text = row["text"]
        self.replacement = row["replacement"]
        self.tests = row["tests"].split()

    def span(self, source):
        """Where the expression stands in source."""
        parts = re.split(r"\{\{(.*)\}\}", self.text, flags=re.S)
        if len(parts) == 1:
            parts = ["", parts[0], ""]
        found = list(re.finditer(spaced(parts), source))
        if len(found) != 1:
            sys.exit(f"mutants.ini: [{self.name}]: {self.file} holds "
                     f"{len(found)} times what one text must match once:\n"
                     f"{self.text}")
        return found[0].span(1)


def spaced(parts):
    """A pattern of three texts, the second a group; white space is free."""
    def pattern(text):
        # A blank may be missing where a line breaks after a bracket.
        words = re.findall(r"\w+|[^\w\s]", text)
        return r"\s*".join(re.escape(word) for word in words)

    before, middle, after = map(pattern, parts)
    return before + r"\s*(" + middle + r")\s*" + after


def read(folder):
    table = configparser.ConfigParser(interpolation=None)
    table.read(folder / "tests/mutations/mutants.ini")
    return [Mutant(name, table[name]) for name in table.sections()]


def mutate(source, mutants):
    spans = {}
    for mutant in mutants:
        spans.setdefault(mutant.span(source), []).append(mutant)
    end = len(source)
    for begin, stop in sorted(spans, reverse=True):
        if stop > end:
            sys.exit("mutants.ini: the expressions of "
                     + ", ".join(m.name for m in spans[begin, stop])
                     + " and of another mutant overlap.")
        expression = source[begin:stop]
        for m in spans[begin, stop]:
            expression = (f'(Nacre::is_mutant("{m.name}") ? ({m.replacement})'
                          f" : ({expression}))")
        source = source[:begin] + expression + source[stop:]
        end = begin
    return "#include <nacre_mutant.h>\n" + source


def sources_with(folder, headers):
    """The sources that include one of the headers, by whatever way."""
    text = {f.relative_to(folder).as_posix(): f.read_text()
            for part in ("source", "include")
            for f in (folder / part).rglob("*.[ch]*")}
    wanted = set(headers)
    while True:
        more = {f for f in text if f not in wanted and
                any(f"<{h[len('include/'):]}>" in text[f] for h in wanted
                    if h.startswith("include/"))}
        if not more:
            return {f for f in wanted if f.startswith("source/")}
        wanted |= more


def main():
    if sys.argv[1] == "--list":
        folder = pathlib.Path(sys.argv[2])
        mutants = read(folder)
        files = sorted({m.file for m in mutants})
        compiled = sources_with(folder, files)
        print("\n".join(files))
        print("--")
        print("\n".join(sorted(compiled - set(files))))
        print("--")
        print("\n".join(f"{m.name}:{test}" for m in mutants
                        for test in m.tests), end="")
    else:
        folder, file, result = pathlib.Path(sys.argv[1]), *sys.argv[2:]
        mutants = [m for m in read(folder) if m.file == file]
        result = pathlib.Path(result)
        result.parent.mkdir(parents=True, exist_ok=True)
        result.write_text(mutate((folder / file).read_text(), mutants))


main()
