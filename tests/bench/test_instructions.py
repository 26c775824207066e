#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""A step on the CPU executes no more instructions per sphere than it did: counted by valgrind, so
that a slower step shows without timing.

usage: test_instructions.py [--keep], with LSDCD_COUNT_STEPS, LSDCD_COUNT_SHAPES and LSDCD_COUNT_PAIRS (the programs) and
LSDCD_COMPILER set
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import kept_numbers

ROOM = 0.05


def count(program, *words):
    done = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                           "--toggle-collect=counted_steps", program, *words],
                          env={**os.environ, "OMP_NUM_THREADS": "1"}, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    scene = re.search(r"^(\d+) spheres, (\d+) steps", done.stdout, re.M)
    collected = re.search(r"Collected : (\d+)", done.stdout)
    if done.returncode != 0 or not scene or not collected:
        raise SystemExit(f"FAIL valgrind ended with {done.returncode}:\n{done.stdout[-2000:]}")
    return int(collected.group(1)) / (int(scene.group(1)) * int(scene.group(2)))


if not shutil.which("valgrind"):
    kept_numbers.skip("no valgrind")
found = {f"{style}, near list {which}": count(os.environ["LSDCD_COUNT_STEPS"], style, which)
         for style in ("hooke", "hertz/history") for which in ("kept", "anew")}
found["hertz/history with energy, near list kept"] = count(os.environ["LSDCD_COUNT_STEPS"], "energy", "kept")
for i, kind in enumerate(("sphere", "ellipsoid 2:1:1", "n = 4", "n = 8")):
    for k, place in enumerate(("at faces", "at edges", "in folds")):
        found[f"{kind}, {place}"] = count(os.environ["LSDCD_COUNT_SHAPES"], str(i), str(k))
for types in (1, 2, 20, 40):
    found[f"pairs, types with laws of their own: {types}"] = count(os.environ["LSDCD_COUNT_PAIRS"], str(types))
sys.exit(kept_numbers.compare(pathlib.Path(__file__).with_name("step_instructions.csv"),
                              os.environ["LSDCD_COMPILER"], found, ROOM, "per sphere and step") > 0)
