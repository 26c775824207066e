#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Runs clang-tidy, with the checks of .clang-tidy, over the sources of src that a build folder compiles. Left out
is src/lammps, whose names follow LAMMPS.

usage: tidy.py BUILD [PATTERN]     PATTERN: only files whose path in the repository has a match

Ends with 1 where there is a finding, with 77 where clang-tidy 14 is missing.
"""
import concurrent.futures
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def commands(build, pattern):
    """One entry of the build's compile_commands.json for each .cpp of src."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as f:
        entries = json.load(f)
    chosen = {}
    for entry in entries:
        path = os.path.relpath(entry["file"], ROOT)
        if re.match(r"src/(?!lammps/).*\.cpp$", path) and re.search(pattern, path):
            chosen.setdefault(path, entry)
    return [chosen[path] for path in sorted(chosen)]


def findings(tidy, folder, path):
    """What clang-tidy says of a file; empty: nothing."""
    run = subprocess.run([tidy, "-p", folder, "--quiet", path], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                         text=True, check=False)
    return "" if run.returncode == 0 else run.stdout


def main():
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__)
    tidy = shutil.which("clang-tidy-14") or shutil.which("clang-tidy")
    version = subprocess.run([tidy, "--version"], stdout=subprocess.PIPE, text=True, check=False).stdout if tidy else ""
    if "version 14." not in version:
        print("skipped: clang-tidy 14 is missing, install clang-tidy")
        sys.exit(77)
    entries = commands(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "")
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "compile_commands.json"), "w", encoding="utf-8") as f:
            json.dump(entries, f)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            said = list(pool.map(lambda entry: findings(tidy, folder, entry["file"]), entries))
    for text in filter(None, said):
        print(text)
    n_bad = sum(map(bool, said))
    print(f"{n_bad} of {len(entries)} files with findings")
    sys.exit(n_bad > 0 or not entries)


if __name__ == "__main__":
    main()
