#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Prints how many lines the rooms of the sources, the folders of tests and bench/ have.

usage: lines.py [COMMIT]     COMMIT: beside it the lines of a commit, and what has changed since

A line is one with something on it, comments too; the two of a licence are not counted. Rooms that were
renamed stand under their new name (RENAMED).
"""
import os
import re
import subprocess
import sys
import tarfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
RENAMED = {"src/deck": "src/input", "src/model": "src/law", "src/parallel": "src/backend", "src/tune": "src/study"}
COUNTED = re.compile(r"^(src|kokkos|tests|bench)/(.*\.(h|hpp|cuh|cpp|cu|in|py|sh|map)|(.*/)?(CMakeLists\.txt|in\.\w+))$")


def room_of(path):
    """src/ROOM, tests/FOLDER, or the top folder."""
    parts = path.split("/")
    room = "/".join(parts[:2 if parts[0] in ("src", "tests") and len(parts) > 2 else 1])
    return RENAMED.get(room, room)


def lines_of(text):
    return sum(1 for line in text.splitlines() if line.strip() and "SPDX-" not in line)


def count(files):
    """{room: lines} of (path, text)."""
    rooms = {}
    for path, text in files:
        if COUNTED.match(path):
            rooms[room_of(path)] = rooms.get(room_of(path), 0) + lines_of(text)
    return rooms


def files_of_tree(root):
    for top in ("src", "kokkos", "tests", "bench"):
        for folder, _, names in os.walk(os.path.join(root, top)):
            for name in names:
                path = os.path.join(folder, name)
                if COUNTED.match(os.path.relpath(path, root)):
                    with open(path, encoding="utf-8") as f:
                        yield os.path.relpath(path, root), f.read()


def files_of_commit(root, commit):
    git = subprocess.Popen(["git", "-C", root, "archive", commit, "src", "kokkos", "tests", "bench"],
                           stdout=subprocess.PIPE)
    with tarfile.open(fileobj=git.stdout, mode="r|") as tar:
        for member in tar:
            if member.isfile() and COUNTED.match(member.name):
                yield member.name, tar.extractfile(member).read().decode("utf-8")


def table(now, before):
    """Text; `before` may be None."""
    text = f"{'':18}{'lines':>8}" + (f"{'before':>8}{'change':>8}\n" if before is not None else "\n")
    def row(name, here, there):
        return f"{name:18}{here:8}" + (f"{there:8}{here - there:+8}\n" if before is not None else "\n")
    before_of = before or {}
    for room in sorted(set(now) | set(before_of)):
        text += row(room, now.get(room, 0), before_of.get(room, 0))
    for what, tops in (("sources", ("src", "kokkos")), ("tests", ("tests",)), ("bench", ("bench",))):
        def total(rooms, tops=tops):
            return sum(n for room, n in rooms.items() if room.split("/")[0] in tops)
        text += row(f"all {what}", total(now), total(before_of))
    return text


def main():
    if len(sys.argv) > 2 or (sys.argv[1:] and sys.argv[1].startswith("-")):
        sys.exit(__doc__)
    before = count(files_of_commit(ROOT, sys.argv[1])) if sys.argv[1:] else None
    print(table(count(files_of_tree(ROOT)), before), end="")


if __name__ == "__main__":
    main()
