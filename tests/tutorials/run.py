#!/usr/bin/env python3
"""run.py TUTORIAL [FOLDER]: does in FOLDER (a new one) what a tutorial says, block after block, and checks what it says that one sees.

TUTORIAL: Markdown with blocks sh, python and output (whose lines must stand in what the block before has printed, but for blanks), or a notebook.
Exits with 77 where a Python module is missing that it needs.
"""

import contextlib
import io
import json
import os
import re
import subprocess
import sys
import tempfile

os.environ["MPLBACKEND"] = "Agg"


def blocks(path):
    """(kind, text, line) of each block."""
    if path.endswith(".ipynb"):
        with open(path, encoding="utf-8") as file:
            cells = json.load(file)["cells"]
        return [("python", "".join(cell["source"]), number) for number, cell in enumerate(cells, 1) if cell["cell_type"] == "code"]
    found, kind, lines, first = [], None, [], 0
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            if kind is None and (fence := re.fullmatch(r"```(\w+)\n", line)):
                kind, lines, first = fence[1], [], number
            elif kind is not None and line == "```\n":
                found.append((kind, "".join(lines), first))
                kind = None
            elif kind is not None:
                lines.append(line)
    return found


def run_python(text, where, names):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile(text, where, "exec"), names)
    return out.getvalue()


def plain(text):
    return re.sub(r"\s+", " ", text)


def main():
    path = os.path.abspath(sys.argv[1])
    folder = sys.argv[2] if len(sys.argv) > 2 else tempfile.mkdtemp()
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    printed, names, checked = "", {"__name__": "__main__"}, 0
    for kind, text, line in blocks(path):
        where = f"{os.path.basename(path)}:{line}"
        if kind == "sh":
            done = subprocess.run(["bash", "-euo", "pipefail", "-c", text], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
            printed = done.stdout
            if done.returncode != 0:
                sys.exit(f"{where}: exit code {done.returncode}\n{printed}")
        elif kind == "python":
            try:
                printed = run_python(text, where, names)
            except ModuleNotFoundError as missing:
                print(f"{where}: {missing}; skipped")
                sys.exit(77)
        elif kind == "output":
            for wanted in text.splitlines():
                checked += 1
                if plain(wanted) not in plain(printed):
                    sys.exit(f"{where}: {wanted!r} is not in what was printed:\n{printed}")
        else:
            sys.exit(f"{where}: a block of kind {kind!r}")
    print(f"{os.path.basename(path)}: done, {checked} lines of output as told; in {folder}")


main()
