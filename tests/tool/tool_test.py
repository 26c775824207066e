# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Runs the command-line tool for its tests, which are lists of facts."""
import json
import os
import pathlib
import struct
import subprocess
import sys

TOOL = os.environ["LSDCD_TOOL"]
failed = 0


def fact(name, holds, detail=""):
    global failed
    print(f"{'PASS' if holds else 'FAIL'} {name}{': ' + str(detail) if detail else ''}")
    failed += not holds


def end():
    sys.exit(1 if failed else 0)


def run(folder, *words, **more):
    """Of what is printed, stdout and stderr apart."""
    return subprocess.run([TOOL, *map(str, words)], cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, **more)


def told(folder, *words):
    """What --json says; what went wrong stops the test."""
    done = run(folder, *words, "--json")
    if done.returncode != 0:
        raise SystemExit(f"FAIL lsdcd {' '.join(map(str, words))}: {done.stderr}{done.stdout}")
    return json.loads(done.stdout)


def refused(folder, words, *expected, code=1):
    """The words are refused, and what is said has all that is expected in it."""
    before = sorted(p.name for p in pathlib.Path(folder).iterdir())
    done = run(folder, *words)
    said = done.stderr + done.stdout
    fact(f"refused: {' '.join(map(str, words))[-90:]}",
         done.returncode == code and all(e in said for e in expected)
         and before == sorted(p.name for p in pathlib.Path(folder).iterdir()),
         f"{done.returncode} {said.strip()[-300:]}")


def write_ascii_stl(path, triangles):
    """In all digits."""
    with open(path, "w") as out:
        out.write("solid s\n")
        for t in triangles:
            out.write("facet normal 0 0 0\nouter loop\n")
            for p in t:
                out.write("vertex " + " ".join(repr(float(x)) for x in p) + "\n")
            out.write("endloop\nendfacet\n")
        out.write("endsolid s\n")


def read_stl(path):
    """Triangles of a binary file, as floats."""
    data = pathlib.Path(path).read_bytes()
    n = struct.unpack_from("<I", data, 80)[0]
    rows = (struct.unpack_from("<12f", data, 84 + 50 * i) for i in range(n))
    return [(r[3:6], r[6:9], r[9:12]) for r in rows]
