#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Run a parameter file from another folder than its own: where the output goes.

  folders.py NACRE FILE.prm
"""

import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile

SHORT = ["--quiet", "--set", "Study/Degrees=2", "--set", "Study/Refinements=0"]


def run(nacre, prm, folder, *overrides):
    """Run nacre in `folder`."""
    command = [nacre, str(prm)] + SHORT
    for override in overrides:
        command += ["--set", override]
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)


def check_results(folder, name):
    """All files of a run are there; the rows of its .csv without seconds."""
    for ending in (".csv", ".txt", ".tex", ".pvd", ".used.prm"):
        path = folder / (name + ending)
        assert path.is_file() and path.stat().st_size > 0, f"no {path}"
    assert list(folder.glob(name + "*.*vtu")), f"no .vtu in {folder}"
    with open(folder / (name + ".csv"), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert rows and "dofs" in rows[0] and "ratio" in rows[0], rows
    return [{key: value for key, value in row.items()
             if not key.endswith(("_s", "memory_gb"))} for row in rows]


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def main():
    nacre = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as temporary:
        root = pathlib.Path(temporary)
        inputs, work = root / "my inputs", root / "work"
        inputs.mkdir()
        work.mkdir()
        prm = inputs / "plate.prm"
        shutil.copy(sys.argv[2], prm)

        # by default below the current folder, named as the file
        run(nacre, "../my inputs/plate.prm", work)
        rows = check_results(work / "output", "plate")
        assert names(inputs) == ["plate.prm"], names(inputs)
        assert names(work) == ["output"], names(work)

        # folders that don't exist yet, relative to the current one; absolute
        run(nacre, prm, work, "Study/Output folder=deep/er", "Study/Name=p")
        assert check_results(work / "deep" / "er", "p") == rows
        run(nacre, "plate.prm", inputs, f"Study/Output folder={root}/third")
        assert check_results(root / "third", "plate") == rows
        assert names(inputs) == ["plate.prm"], names(inputs)

        # the parameters that were used repeat the run
        run(nacre, root / "third" / "plate.used.prm", work,
            "Study/Output folder=again")
        assert check_results(work / "again", "plate") == rows


if __name__ == "__main__":
    main()
