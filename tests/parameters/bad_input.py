#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Wrong input must end with a message that helps, and the command line do
what it says.

  bad_input.py NACRE N_RANKS CASES.py [NAME ...]   run all cases or those
  bad_input.py --list CASES.py                     their names

Each case runs in an empty folder. It passes if nacre ends by itself with the
expected exit code and one error message that holds the expected texts, and
leaves nothing that looks like a result.
"""
import importlib.util
import os
import re
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import run_study  # noqa: E402  (found by the line above)

TIMEOUT = 60 if "NACRE_SLOW" in os.environ else 20
RESULTS = {".csv", ".txt", ".tex", ".vtu", ".pvtu", ".pvd",
           ".h5", ".xdmf"}
CRASH = ("Segmentation", "terminate called", "An error occurred in",
         "MPI_ABORT", "Backtrace", "backtrace", "*** Process received signal",
         "Additional information", "The violated condition")


class Failure(Exception):
    """What is wrong, in a line."""


def check(condition, text):
    if not condition:
        raise Failure(text)


def load_cases(path):
    spec = importlib.util.spec_from_file_location("cases", path)
    module = importlib.util.module_from_spec(spec)
    sys.dont_write_bytecode = True
    spec.loader.exec_module(module)
    return module


class Nacre:
    def __init__(self, program, n_ranks):
        self.program = program
        self.n_ranks = n_ranks

    def run(self, args, folder):
        """Exit code, standard output, and both outputs as one line."""
        command = [self.program, *args]
        if self.n_ranks > 1:
            command = ["mpirun", "--oversubscribe", "-np", str(self.n_ranks),
                       *command]
        environment = dict(os.environ, OMP_NUM_THREADS="1",
                           OMPI_ALLOW_RUN_AS_ROOT="1",
                           OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        if self.n_ranks == 1:
            environment.update(run_study.start_alone(folder))
        with subprocess.Popen(command, cwd=folder, env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              stdin=subprocess.DEVNULL, errors="replace",
                              start_new_session=True) as process:
            try:
                out, err = process.communicate(timeout=TIMEOUT)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.communicate()
                raise Failure(f"hangs: no end after {TIMEOUT} s") from None
        return process.returncode, out, " ".join((out + err).split())


def with_settings(prm, settings):
    """The file with "A/B/c": value appended; the last value counts."""
    for path, value in settings.items():
        *sections, name = path.split("/")
        prm += "".join(f"subsection {section}\n" for section in sections)
        prm += f"set {name} = {value}\n" + "end\n" * len(sections)
    return prm


def results_in(folder, known=()):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*")
                  if path.is_file() and path.suffix in RESULTS)


def run_case(nacre, case, folder):
    for name, text in case["folder"].items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    args = case["args"]
    if case["prm"] is not None:
        prm = case["prm"]
        if case["change"]:
            check(case["change"][0] in prm, "the text to change isn't there")
            prm = prm.replace(*case["change"], 1)
        (folder / "case.prm").write_text(with_settings(prm, case["settings"]))
        if "{prm}" not in args:
            args = ["{prm}", *args]
        args = ["case.prm" if arg == "{prm}" else arg for arg in args]
    code, out, text = nacre.run(args, folder)

    said = re.sub(r" -{20,}.*", "", text)
    for fragment in case["expect"]:
        found = (fragment in text if isinstance(fragment, str) else
                 fragment.search(text))
        check(found, f"{fragment!r} is not in: {said}")
    check(code == case["code"],
          f"exit code {code} instead of {case['code']}: {said}")
    for word in CRASH:
        check(word not in text, f"'{word}': {text}")
    n_messages = text.count("nacre: error:")
    check(n_messages == 1, f"{n_messages} messages: {said}")
    check(not re.search(r"(?<![\w'\"])-?(nan|inf)(?!\w)", out, re.I),
          f"NaN as a result: {out}")
    check(not results_in(folder), f"results: {results_in(folder)}")


# --- What must work --------------------------------------------------------
def succeed(nacre, args, folder, *expect):
    code, out, text = nacre.run(args, folder)
    check(code == 0, f"{args}: exit code {code}: {text}")
    check("nacre: error:" not in text, text)
    for fragment in expect:
        check(fragment in text, f"{fragment!r} is not in: {text}")
    return out


def table(path):
    """The .csv but for the columns of CPU seconds."""
    rows = [line.split(",") for line in path.read_text().splitlines()]
    keep = [i for i, name in enumerate(rows[0])
            if not name.endswith(("_s", "memory_gb"))]
    check(len(rows) > 1 and "dofs" in rows[0], f"{path} is no table")
    return [[row[i] for i in keep] for row in rows]


def good_help(nacre, base, folder):
    out = succeed(nacre, ["--help"], folder, "Usage: nacre", "--set",
                  "--check", "--template", "--list", "--quiet", "--version")
    check(out.count("Usage: nacre") == 1, "printed by more than one rank")


def good_version(nacre, base, folder):
    out = succeed(nacre, ["--version"], folder, "deal.II")
    check(re.fullmatch(r"nacre \d+\.\d+\.\d+\S* \(deal.II \S+\)\n", out),
          f"no version: {out!r}")


def good_list(nacre, base, folder):
    succeed(nacre, ["--list"], folder, "Lagrange", "tied", "cylinder",
            "hyperbolic paraboloid", "clamped", "diaphragm", "Edge moments",
            "maximum displacement", "H1 error")


def good_template(nacre, base, folder):
    """It documents everything and is the input of --check and of a run."""
    out = succeed(nacre, ["--template"], folder)
    for text in ("Units: length", "set Thickness", "set Quantities",
                 "subsection folded strip"):
        check(text in out, f"{text!r} is not in the template")
    (folder / "template.prm").write_text(out)
    held = ["--set", "Boundary conditions/Edges=u=0: clamped"]
    succeed(nacre, ["template.prm", "--check", *held], folder, "no errors")
    succeed(nacre, ["template.prm", "--quiet", *held], folder)
    table(folder / "output/template.csv")


def good_check(nacre, base, folder):
    (folder / "case.prm").write_text(base)
    out = succeed(nacre, ["--check", "case.prm"], folder, "no errors")
    check(out.count("no errors") == 1, "printed by more than one rank")
    check(not (folder / "output").exists(), "--check has written files")


def good_set(nacre, base, folder):
    """--set counts as the same text in the file; the last one wins."""
    (folder / "a.prm").write_text(base)
    values = {"Section/Thickness": "0.1", "Study/Degrees": "2, 3",
              "Boundary conditions/Edges": "u=0, u=1: clamped",
              "Title": "Another"}
    (folder / "b.prm").write_text(with_settings(base, values))
    sets = ["--set", "Section/Thickness = 7"]
    for name, value in values.items():
        sets += ["--set", f"{name}={value}"]
    succeed(nacre, ["a.prm", *sets], folder, "Another")
    succeed(nacre, ["b.prm"], folder, "Another")
    rows = table(folder / "output/a.csv")
    check(rows == table(folder / "output/b.csv"), "results differ")
    check(len(rows) == 3 and "0.1" in rows[1], f"not as set: {rows}")


def good_used_prm(nacre, base, folder):
    (folder / "case.prm").write_text(base)
    succeed(nacre, ["case.prm", "--set", "Section/Thickness=0.2", "--set",
                    "Study/Output folder=first"], folder)
    succeed(nacre, ["first/case.used.prm", "--set",
                    "Study/Output folder=second"], folder)
    check(table(folder / "first/case.csv") ==
          table(folder / "second/case.csv"), "results differ")


def good_any_folder(nacre, base, folder):
    """Output goes below the current folder, wherever the file is."""
    for name in ("files", "elsewhere/deep"):
        (folder / name).mkdir(parents=True)
    (folder / "files/case.prm").write_text(base)
    succeed(nacre, ["../../files/case.prm"], folder / "elsewhere/deep")
    table(folder / "elsewhere/deep/output/case.csv")
    check(not (folder / "files/output").exists(), "output beside the file")
    for suffix in ("csv", "txt", "tex", "pvd", "used.prm"):
        check((folder / "elsewhere/deep/output" / f"case.{suffix}").exists(),
              f"no case.{suffix}")


def good_quiet(nacre, base, folder):
    (folder / "case.prm").write_text(base)
    out = succeed(nacre, ["case.prm"], folder)
    check(out.count("[1/1]") == 1, f"no single line of progress: {out}")
    out = succeed(nacre, ["case.prm", "--quiet"], folder)
    check("[1/1]" not in out, f"not quiet: {out}")


def good_continued_lines(nacre, base, folder):
    (folder / "case.prm").write_text(
        base.replace("(1, 0.5, 0); U", "(1, 0.5, 0); \\\n   U")
        .replace("set Title", "# a comment = with 'quotes'\nset Title"))
    succeed(nacre, ["case.prm"], folder)
    check("U" in (folder / "output/case.csv").read_text(), "U is missing")


GOOD = {name[5:]: function for name, function in list(globals().items())
        if name.startswith("good_")}


def names_of(module):
    """Of all cases of a file; what must work goes with the first."""
    good = GOOD if getattr(module, "WITH_GOOD_CASES", False) else {}
    return (["bad/" + name for name in module.CASES] +
            ["good/" + name for name in good])


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "--list":
        module = load_cases(sys.argv[2])
        print("\n".join(names_of(module)))
        return 0
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    nacre = Nacre(os.path.abspath(sys.argv[1]), int(sys.argv[2]))
    module = load_cases(sys.argv[3])
    names = sys.argv[4:] or names_of(module)
    n_failed = 0
    for name in names:
        kind, key = name.split("/")
        try:
            with tempfile.TemporaryDirectory(prefix="nacre_") as folder:
                if kind == "bad":
                    run_case(nacre, module.CASES[key], Path(folder))
                else:
                    GOOD[key](nacre, module.BASE, Path(folder))
            print(f"passed  {name}", flush=True)
        except Failure as failure:
            n_failed += 1
            print(f"FAILED  {name}: {failure}", flush=True)
    print(f"{len(names) - n_failed} of {len(names)} cases passed on "
          f"{nacre.n_ranks} rank{'s' if nacre.n_ranks > 1 else ''}.")
    return 1 if n_failed else 0


if __name__ == "__main__":
    sys.exit(main())
