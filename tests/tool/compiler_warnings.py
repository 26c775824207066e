#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Lets the compiler of a build folder read the sources that it compiles, without making code, and prints its warnings.

usage: compiler_warnings.py BUILD [PATTERN] [--jobs N]
  PATTERN   only sources whose path, in the repository or in the build folder, has a match
  --jobs    compilers at once (default: one per core)

Sources that are only made while building are left out where they are missing. Ends with 1 where there is a warning or
an error. Warnings of the optimizer, as of values that may not be set, come only with a whole build.
"""
import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def reading(entry):
    """The command of an entry of compile_commands.json, without the cache in front of it, for reading only."""
    words = shlex.split(entry["command"])
    if os.path.basename(words[0]) == "ccache":
        words.pop(0)
    at = words.index("-o")
    words[at:at + 2] = []
    return [word for word in words if word != "-c"] + ["-fsyntax-only"]


def read(entry):
    """Whether a source was read, and what the compiler said of it."""
    run = subprocess.run(reading(entry), cwd=entry["directory"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                         check=False)
    return run.returncode == 0, run.stdout


def main():
    words = sys.argv[1:]
    jobs = os.cpu_count()
    if "--jobs" in words:
        at = words.index("--jobs")
        jobs = int(words[at + 1])
        words[at:at + 2] = []
    if not 1 <= len(words) <= 2:
        sys.exit(__doc__)
    build, pattern = words[0], (words + [""])[1]
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as f:
        # Some are compiled for several targets.
        sources = {entry["file"]: entry for entry in json.load(f) if entry["file"].endswith((".cpp", ".cxx"))}
    chosen = {}
    for path, entry in sources.items():
        short = os.path.relpath(path, build if path.startswith(os.path.abspath(build)) else ROOT)
        if re.search(pattern, short):
            chosen[short] = entry
    missing = [short for short, entry in chosen.items() if not os.path.exists(entry["file"])]
    for short in missing:
        print(f"left out, not made yet: {short}")
        del chosen[short]
    bad = 0
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for short, (well, text) in zip(chosen, pool.map(read, chosen.values())):
            if text or not well:
                bad += 1
                print(f"{short}:\n{text}", flush=True)
    print(f"{len(chosen)} sources read, {bad} with warnings or errors, {len(missing)} left out")
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
