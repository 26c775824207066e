#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Runs clang-tidy, with the checks of .clang-tidy, over the sources of src that a build folder compiles, some
together as they are compiled there. Left out is src/lammps, whose names follow LAMMPS.

usage: tidy.py BUILD [PATTERN]
  PATTERN   only sources that have a file whose path in the repository has a match

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


def files_of(source):
    """The files that a source which CMake wrote includes, or itself; paths in the repository."""
    if not source.endswith(".cxx"):
        return [os.path.relpath(source, ROOT)]
    with open(source, encoding="utf-8") as f:
        return [os.path.relpath(path, ROOT) for path in re.findall(r'#include "(.*)"', f.read())]


def commands(build, pattern):
    """One entry of the build's compile_commands.json for each source with files of src; no file is in two."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as f:
        entries = json.load(f)
    chosen, seen = [], set()
    for entry in entries:
        files = [path for path in files_of(entry["file"]) if re.match(r"src/(?!lammps/).*\.cpp$", path)]
        if files and not seen & set(files) and any(re.search(pattern, path) for path in files):
            chosen.append(entry)
            seen |= set(files)
    return chosen, len(seen)


def findings(tidy, folder, path):
    """What clang-tidy says of a source; empty: nothing."""
    run = subprocess.run([tidy, "-p", folder, "--config-file=" + os.path.join(ROOT, ".clang-tidy"),
                          "--checks=-bugprone-suspicious-include",    # CMake's sources include sources
                          "--quiet", path], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return "" if run.returncode == 0 else run.stdout


def main():
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__)
    tidy = shutil.which("clang-tidy-14") or shutil.which("clang-tidy")
    version = subprocess.run([tidy, "--version"], stdout=subprocess.PIPE, text=True, check=False).stdout if tidy else ""
    if "version 14." not in version:
        print("skipped: clang-tidy 14 is missing, install clang-tidy")
        sys.exit(77)
    entries, n_files = commands(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "")
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "compile_commands.json"), "w", encoding="utf-8") as f:
            json.dump(entries, f)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            said = list(pool.map(lambda entry: findings(tidy, folder, entry["file"]), entries))
    for text in filter(None, said):
        print(text)
    n_bad = sum(map(bool, said))
    print(f"{n_bad} of {len(entries)} sources of {n_files} files with findings")
    sys.exit(n_bad > 0 or not entries)


if __name__ == "__main__":
    main()
