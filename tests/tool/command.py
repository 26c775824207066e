# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Runs the command-line tool for its tests."""
import json
import os
import pathlib
import subprocess

from facts import fact

TOOL = os.environ["LSDCD_TOOL"]


def run(folder, *words, **more):
    """Of what is printed, stdout and stderr apart."""
    return subprocess.run([TOOL, *map(str, words)], cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, **more)


def told(folder, *words):
    """What --json says; what went wrong stops the test."""
    done = run(folder, *words, "--json")
    if done.returncode != 0:
        raise AssertionError(f"lsdcd {' '.join(map(str, words))}: {done.stderr}{done.stdout}")
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
