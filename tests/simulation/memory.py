#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""The estimate of memory that nacre prints, against what it took: within a
factor of 1.5.

  memory.py NACRE FILE.prm [--set "Section/Parameter=value"]...
"""
import csv
import pathlib
import re
import subprocess
import sys
import tempfile


def main():
    nacre, prm, *settings = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [nacre, prm, *settings, "--set", "Study/Write VTU=false", "--set",
             f"Study/Output folder={folder}", "--set", "Study/Name=run"],
            capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(done.stdout + done.stderr)
        found = re.search(r"memory: about ([-+.e0-9]+) GB", done.stdout)
        if not found:
            sys.exit(f"no estimate: {done.stdout}")
        estimate = float(found[1])
        with open(pathlib.Path(folder, "run.csv"), encoding="utf-8") as file:
            row = list(csv.DictReader(file))[-1]
        peak = float(row["memory_gb"])
        print(f"{row['dofs']} dofs, {row['solver']}: estimate {estimate} GB, "
              f"peak {peak} GB")
        if not 1. / 1.5 < estimate / peak < 1.5:
            sys.exit("the estimate is wrong by more than a factor of 1.5")


if __name__ == "__main__":
    main()
