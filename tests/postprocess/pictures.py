#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""What scripts/plot, plot_path and compare_path.py say of files that are no
tables of theirs, and of pictures that can't be: a line and an exit code.

  pictures.py
"""
import os
import pathlib
import subprocess
import sys
import tempfile

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
PATH = "time,load_factor,w,negative_pivots\n"
FILES = {
    "path.csv": PATH + "0,0,0,0\n1,1,2,0\n",
    "some_path.csv": PATH + "0,0,0.5,0\n1,1,,1\n",
    "some_points.csv": "step,kind,load_factor,w\n1,limit,0.5,1\n",
    "motion.csv": "time,w\n0,1\n1,2\n",
    "short.csv": PATH + "0,0,0,0\n1,1\n",
    "words.csv": PATH + "0,0,low,0\n1,1,high,0\n",
    "one_row.csv": PATH + "0,0,0,0\n",
    "empty.csv": "",
    "binary.csv": b"\xff\xfe\0",
    "table.csv": "load_factor,w\n0,0\n1,2\n",
    "gap.csv": "load_factor,w\n0,0\n1,\n",
    "zero.csv": "load_factor,w\n0,0\n1,0\n",
}
GOOD = [
    ("plot_path", "path.csv w -o new.png"),
    ("plot_path", "some_path.csv w -o new.svg --load --branch path.csv "
                  "--reference table.csv"),
    ("compare_path.py", "path.csv table.csv --tolerance 1e-9"),
]
# Program, arguments, exit code, words of the message
BAD = [
    ("plot", "convergence none.csv -o new.png", 1, "none.csv: No such file"),
    ("plot", "convergence path.csv -o new.png", 1, "no column 'dofs'"),
    ("plot", "convergence binary.csv -o new.png", 1, "binary.csv is no table"),
    ("plot", "convergence path.csv -o none/new.png", 2, "no folder 'none'"),
    ("plot", "convergence path.csv -o new.doc", 2, "doesn't end with .png"),
    ("plot", "shell path.csv -o new.gif", 2, "doesn't end with .png"),
    ("plot", "modes path.csv -o new.png --columns 0", 2, "'0' is no positive"),
    ("plot", "animation path.csv -o new.gif --seconds nan", 2, "'nan' is no"),
    ("plot_path", "empty.csv w -o new.png", 1, "no column 'time'"),
    ("plot_path", "one_row.csv w -o new.png", 1, "has 1 rows; 2 at least"),
    ("plot_path", "path.csv v -o new.png", 1, "no column 'v'; it has: time"),
    ("plot_path", "short.csv w -o new.png", 1, "short.csv, row 3: 2 cells"),
    ("plot_path", "words.csv w -o new.png", 1, "'low' in the column 'w'"),
    ("plot_path", "path.csv w -o new.png --drift", 1, "zero at the start"),
    ("plot_path", "motion.csv w -o new.png --load", 1, "'load_factor'"),
    ("plot_path", "some_path.csv time -o new.png --load", 1,
     "some_points.csv has no column 'time'"),
    ("compare_path.py", "path.csv none.csv", 1, "none.csv: No such file"),
    ("compare_path.py", "path.csv gap.csv", 1, "empty cell in the column 'w'"),
    ("compare_path.py", "path.csv zero.csv", 1, "column 'w' is zero"),
]


def run(program, arguments, folder):
    done = subprocess.run(
        [sys.executable, "-B", SCRIPTS / program, *arguments.split()],
        cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        text=True, check=False, stdin=subprocess.DEVNULL,
        env={**os.environ, "DISPLAY": ":none"})
    return done.returncode, done.stdout


def main():
    failures = []
    with tempfile.TemporaryDirectory(prefix="nacre_") as name:
        folder = pathlib.Path(name)
        for file, content in FILES.items():
            (folder / file).write_bytes(
                content if isinstance(content, bytes) else content.encode())
        for program, arguments in GOOD:
            code, text = run(program, arguments, folder)
            if code != 0 or "Warning" in text:
                failures.append(f"{program} {arguments}: {code}: {text}")
        pictures = sorted(path.name for path in folder.glob("new*"))
        if pictures != ["new.png", "new.svg"]:
            failures.append(f"pictures: {pictures}")
        for program, arguments, expected, words in BAD:
            code, text = run(program, arguments, folder)
            if code != expected or words not in text or "Traceback" in text:
                failures.append(f"{program} {arguments}: {code}: {text}")
    print("\n".join(failures) or "All is well.")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
