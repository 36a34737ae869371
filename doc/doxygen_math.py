#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Filter of Doxyfile.in: the formulas of Markdown in Doxygen's notation.

$...$ becomes \\f$...\\f$ and $$...$$ becomes \\f[...\\f].
"""

import re
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    text = file.read()
text = re.sub(r"\$\$(.+?)\$\$", lambda m: "\\f[" + m[1] + "\\f]", text,
              flags=re.DOTALL)
text = re.sub(r"(?<![\\$])\$((?:[^$`\n]|\n(?!\n))+?)\$",
              lambda m: "\\f$" + m[1] + "\\f$", text)
sys.stdout.write(text)
