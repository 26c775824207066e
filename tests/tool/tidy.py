#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Runs clang-tidy, with the checks of .clang-tidy, over the sources of src that a build folder compiles. Left out
is src/lammps, whose names follow LAMMPS.

usage: tidy.py BUILD [PATTERN]     PATTERN: only files whose path in the repository has a match

Files of a folder are checked some at a time, in one source that includes them, because most of the time goes into
headers. Where two of them have a local name in common they are checked in halves. Ends with 1 where there is a finding, with
77 where clang-tidy 14 is missing.
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
CONFIG = "--config-file=" + os.path.join(ROOT, ".clang-tidy")


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


def groups_of(entries, most):
    """The entries, up to `most` at a time of those that are compiled by the same words."""
    by_words = {}
    for entry in entries:
        words = entry["command"].split(" -o ")[0]
        by_words.setdefault((entry["directory"], words, os.path.dirname(entry["file"])), []).append(entry)
    return [all[k:k + most] for all in by_words.values() for k in range(0, len(all), most)]


def said_of(tidy, folder, path):
    """What clang-tidy says of a source; empty: nothing."""
    run = subprocess.run([tidy, "-p", folder, CONFIG, "--quiet", path], stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True, check=False)
    return "" if run.returncode == 0 else run.stdout


def unit_of(folder, group):
    """A source that includes the files of a group, in a folder with the words that compile it."""
    first = group[0]
    place = tempfile.mkdtemp(dir=folder)
    unit = os.path.join(place, "unit.cpp")
    with open(unit, "w", encoding="utf-8") as f:
        f.writelines(f'#include "{entry["file"]}"    // NOLINT(bugprone-suspicious-include)\n' for entry in group)
    with open(os.path.join(place, "compile_commands.json"), "w", encoding="utf-8") as f:
        json.dump([{"directory": first["directory"], "file": unit,
                    "command": first["command"].replace(first["file"], unit)}], f)
    return unit


def findings(tidy, folder, group):
    """What clang-tidy says of the files of a group."""
    if len(group) == 1:
        return [said_of(tidy, folder, group[0]["file"])]
    unit = unit_of(folder, group)
    text = said_of(tidy, os.path.dirname(unit), unit)
    if "[clang-diagnostic-error]" not in text:
        return [text]
    half = len(group) // 2
    return findings(tidy, folder, group[:half]) + findings(tidy, folder, group[half:])


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
            said = sum(pool.map(lambda group: findings(tidy, folder, group), groups_of(entries, 6)), [])
    for text in filter(None, said):
        print(text)
    n_bad = sum(map(bool, said))
    print(f"{n_bad} findings in {len(entries)} files" if n_bad else f"{len(entries)} files, nothing found")
    sys.exit(n_bad > 0 or not entries)


if __name__ == "__main__":
    main()
