#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Check what doc/architecture.md promises of the sources.

* A file includes headers of its own folder and of lower floors only, never of
  a sibling folder on its floor nor of a higher floor.
* Include guards are nacre_<folder>_<file>_h.
* Each source file begins with the SPDX line; none exceeds 600 lines.
* No line of a source, a script, or a file of CMake is longer than 80 columns.

Usage: scripts/check_sources.py [project folder]
Lists offenders and exits with 1 if there are any. Needs Python only.
"""

import pathlib
import re
import sys

FLOORS = [
    ["base"],
    ["mechanics", "elements", "solvers"],
    ["problem"],
    ["discretization"],
    ["forms"],
    ["postprocess", "multigrid", "analysis"],
    ["simulation"],
]
FLOOR_OF = {name: floor for floor, names in enumerate(FLOORS) for name in names}
SPDX = "SPDX-License-Identifier: LGPL-2.1-or-later"
MAX_LINES = 600
MAX_COLUMNS = 80
TEXT_SUFFIXES = (".h", ".cc", ".py", ".cmake")
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:<([^>]+)>|"([^"]+)")', re.MULTILINE)


def check_sources(root, path, folder, text):
    """Messages about the include directives of one library file."""
    if folder not in FLOOR_OF:
        return [f"folder '{folder}' is on no floor: add it to FLOORS and to "
                "doc/architecture.md"]
    messages = []
    for match in INCLUDE.finditer(text):
        line = text.count("\n", 0, match.start(1) if match.group(1)
                          else match.start(2)) + 1
        target = match.group(1) or match.group(2)
        if match.group(2):
            # A private header beside its source file is fine.
            if path.parts[-3] == "source" and \
               (path.parent / target).is_file():
                continue
            messages.append(f"{line}: include \"{target}\" as "
                            "<nacre/folder/file.h>")
            continue
        if not target.startswith("nacre/"):
            continue
        parts = target.split("/")
        other = parts[1] if len(parts) == 3 else ""
        if other not in FLOOR_OF:
            messages.append(f"{line}: <{target}> is in no known folder")
        elif not (root / "include" / target).is_file():
            messages.append(f"{line}: <{target}> does not exist")
        elif other != folder and FLOOR_OF[other] == FLOOR_OF[folder]:
            messages.append(f"{line}: {folder} includes its sibling on floor "
                            f"{FLOOR_OF[folder]}: <{target}>")
        elif FLOOR_OF[other] > FLOOR_OF[folder]:
            messages.append(f"{line}: {folder} (floor {FLOOR_OF[folder]}) "
                            f"includes floor {FLOOR_OF[other]}: <{target}>")
    return messages


def check_guard(path, folder, text):
    """Messages about the include guard of a header."""
    guard = f"nacre_{folder}_{path.stem}_h"
    wanted = rf"#ifndef {guard}\n#define {guard}\n"
    if not re.search(wanted, text) or not text.rstrip().endswith("#endif"):
        return [f"1: include guard isn't {guard}"]
    return []


def check_file(root, path):
    """All messages about one file, each beginning with a line number."""
    text = path.read_text(encoding="utf-8")
    messages = []
    if SPDX not in "\n".join(text.splitlines()[:2]):
        messages.append(f"1: the first line isn't // {SPDX}")
    n_lines = text.count("\n")
    if n_lines > MAX_LINES:
        messages.append(f"{n_lines}: {n_lines} lines, at most {MAX_LINES}")
    relative = path.relative_to(root).parts
    if relative[0] == "include":
        # include/nacre/<folder>/<file>.h
        folder = relative[2] if len(relative) == 4 else "/".join(relative[2:-1])
        messages += check_sources(root, path, folder, text)
        messages += check_guard(path, folder, text)
    elif relative[0] == "source":
        folder = "/".join(relative[1:-1])
        messages += check_sources(root, path, folder, text)
        if path.suffix == ".h":
            messages += check_guard(path, folder, text)
    return messages


def check_columns(path):
    """A message for each line that is too long."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return [f"{number}: {len(line)} columns, at most {MAX_COLUMNS}"
            for number, line in enumerate(lines, 1) if len(line) > MAX_COLUMNS]


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1
                        else pathlib.Path(__file__).parent.parent).resolve()
    files = sorted(path for top in ("include", "source", "tests", "benchmarks")
                   for path in (root / top).rglob("*")
                   if path.suffix in (".h", ".cc"))
    if not files:
        sys.exit(f"check_sources: no C++ file below {root}")
    offences = [f"{path.relative_to(root)}:{message}"
                for path in files for message in check_file(root, path)]
    texts = [path for top in ("include", "source", "tests", "benchmarks",
                              "examples", "scripts", "cmake")
             for path in sorted((root / top).rglob("*"))
             if path.is_file() and (path.suffix in TEXT_SUFFIXES
                                    or path.name == "CMakeLists.txt"
                                    or top == "scripts")
             and "__pycache__" not in path.parts]
    offences += [f"{path.relative_to(root)}:{message}"
                 for path in texts + [root / "CMakeLists.txt"]
                 for message in check_columns(path)]
    if offences:
        print("\n".join(offences), file=sys.stderr)
        sys.exit(f"check_sources: {len(offences)} offences in "
                 f"{len(files)} files")
    print(f"check_sources: {len(files)} files keep to the floors")


if __name__ == "__main__":
    main()
