# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Nacre authors
"""Tables and plots, each with a header that says where it comes from."""

import csv
import datetime
import os
import subprocess

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as pyplot  # noqa: E402  (after the choice above)

from runs import PROJECT, processor  # noqa: E402

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00",
           "#000000", "#7f7f7f")
MARKERS = "osD^vP*X"


def shown(value):
    """A number with three digits, a text as it is."""
    if isinstance(value, float):
        if value == int(value) and abs(value) < 1e7:
            return str(int(value))
        return f"{value:.3g}"
    return "" if value is None else str(value)


class Report:
    """The folder of the results."""

    def __init__(self, folder, nacre, calculix, quick):
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        commit = subprocess.run(
            ["git", "-C", str(PROJECT), "rev-parse", "--short", "HEAD"],
            capture_output=True, text=True, check=False).stdout.strip()
        self.origin = (
            f"{nacre.version}, commit {commit or 'unknown'}; "
            f"{'CalculiX ' + calculix if calculix else 'no CalculiX'}; "
            f"{processor()}, load {os.getloadavg()[0]:.1f} at the start; "
            f"OpenBLAS kernels {os.environ.get('OPENBLAS_CORETYPE', 'auto')}; "
            f"{datetime.date.today().isoformat()}"
            f"{'; quick form: no measurement' if quick else ''}")
        self.quick = quick

    def table(self, section, title, columns, rows, notes=(), name=None):
        """Write SECTION[_NAME].csv and .md; rows are dictionaries."""
        base = self.folder / (section + (f"_{name}" if name else ""))
        with open(f"{base}.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(columns)
            for row in rows:
                writer.writerow([row.get(column, "") for column in columns])
        command = f"benchmarks/run --only {section}" + \
            (" --quick" if self.quick else "")
        lines = [f"# {title}", "", f"`{command}`", "", f"{self.origin}.", ""]
        lines += ["| " + " | ".join(columns) + " |",
                  "|" + "---|" * len(columns)]
        lines += ["| " + " | ".join(shown(row.get(column))
                                    for column in columns) + " |"
                  for row in rows]
        lines += [""] + [f"* {note}" for note in notes]
        with open(f"{base}.md", "w", encoding="utf-8") as file:
            file.write("\n".join(lines).rstrip() + "\n")
        print("\n".join(lines[6:]) + "\n", flush=True)

    def plot(self, section, panels, x_label, y_label, name=None):
        """Curves in logarithmic axes: panels = {title: {label: (x, y)}}."""
        panels = {title: curves for title, curves in panels.items() if curves}
        if not panels:
            return
        labels = []
        for curves in panels.values():
            labels += [label for label in curves if label not in labels]
        figure, axes = pyplot.subplots(
            1, len(panels), figsize=(4.2 * len(panels), 4.), squeeze=False)
        for axis, (title, curves) in zip(axes[0], panels.items()):
            for label, (x, y) in curves.items():
                k = labels.index(label)
                axis.loglog(x, y, marker=MARKERS[k % len(MARKERS)],
                            color=COLOURS[k % len(COLOURS)], markersize=4,
                            linewidth=1., label=label)
            axis.set_title(title, fontsize=10)
            axis.set_xlabel(x_label)
            axis.grid(True, which="major", linewidth=0.3)
        axes[0][0].set_ylabel(y_label)
        handles = {}
        for axis in axes[0]:
            for handle, label in zip(*axis.get_legend_handles_labels()):
                handles.setdefault(label, handle)
        figure.legend([handles[label] for label in labels], labels,
                      loc="lower center", ncol=min(4, len(labels)), fontsize=8,
                      frameon=False)
        figure.tight_layout(rect=(0., 0.05 + 0.04 * ((len(labels) - 1) // 4),
                                  1., 1.))
        base = section + (f"_{name}" if name else "")
        figure.savefig(self.folder / f"{base}.png", dpi=90,
                       metadata={"Software": None})
        pyplot.close(figure)
