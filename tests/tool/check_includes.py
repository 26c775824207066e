#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Checks the house of src and kokkos: who includes whom, where files lie, and who knows the host.

usage: check_includes.py [ROOT]

* A file includes its own room and rooms on lower floors (FLOORS, from the lowest). Rooms of one
  floor do not include each other.
* Inside a room a file includes its own folder and lower ones (FOLDERS, from the lowest).
* The words of scripts (INPUT_ROOM) are for the rooms INPUT_USERS.
* The study is for STUDY_ROOMS, bench/ and tests: what it measures is no part of a plugin or the library.
* Only LAMMPS_ROOMS include headers of LAMMPS, which have no room in their name, and of MPI.
* Outside of src/backend headers of CUDA's backend are for sources of nvcc (.cu), and what a GPU's blocks have (block.h) for files *_gpu.h.
* A header of ONLY_IN, which is slow to compile, is included by its one file.
* HOST_FREE_ROOMS name no host in texts: neither LAMMPS nor its commands (HOST_WORDS). A host has
  its words and remedies in messages by Host::names().
* The lists of LAMMPS's Modify (MODIFY_LISTS), which LAMMPS 13Nov2026 does not have, are for MODIFY_READER; others ask its functions.
* No file includes itself by way of others.
* src itself has no source file: each lies in a room, and each room has a floor.
* A source that only some builds of the core have is compiled alone (lsdcd_alone of src/CMakeLists.txt), so that the others are
  compiled together in the same way in all of them.

Prints one line per violation, and exits with 1 if there is one.
"""
import os
import re
import sys

FLOORS = [["base"], ["backend"], ["geometry", "shape"], ["mesh"], ["box"], ["host"], ["motion"], ["grid", "rigid", "tree"], ["contact"], ["law"], ["engine"],
          ["bodies", "query", "effects", "output", "material", "flow", "insert"],
          ["pair", "study"], ["wall"], ["input"], ["lammps", "tool", "api"], ["kokkos"]]
# Of each room with folders. "." stands for the files that lie in none, but for those that are named.
FOLDERS = {
    "mesh": [".", "io"],
    "grid": [".", "lookup", "plan", "build", "cache"],
    "law": ["contact.h", "force_parts.h", "submodels", "."],
    "engine": ["results", ".", "lists", "nodes", "loads", "broad_phase", "step", "on_backend"],
    "wall": ["spec", "spheres", "sums", "saved", "surface", "move", "part", "coat", "checks", "reports", "."],
    "lammps": [".", "launcher"],
}
INPUT_ROOM = "input"
INPUT_USERS = {"input", "lammps", "tool"}
STUDY_ROOMS = {"study", "tool"}
HOST_FREE_ROOMS = {"host", "wall", "engine"}
HOST_WORDS = re.compile(
    r"\b(lammps\w*|kokkos\w*|atoms?|fix(es)?|scripts?|skin|reruns?|dump(s|ed)?|thermo\w*|restart files?"
    r"|fix_\w+|\w+_modify|\w+_restart|reset_timestep|create_atoms|enforce2d|set group|nktv2p|ftm2v)\b", re.IGNORECASE)
LAMMPS_ROOMS = {"lammps", "kokkos"}
GENERATED = {"grid": "lsdcd_grid_sources.h"}
ONLY_IN = {"CLI/CLI.hpp": "src/tool/command.cpp"}
MODIFY_READER = "src/lammps/host_fixes.h"
MODIFY_LISTS = re.compile(r"\b(nfix|ncompute|fmask|find_(fix|compute)(_by_style)?)\b|\bmodify\s*(->|\.)\s*(fix|compute)\b")
OF_CUDA = re.compile(r"backend/(backend_cuda|cuda_(?!available)\w+)\.h")

FLOOR = {room: floor for floor, rooms in enumerate(FLOORS) for room in rooms}
SOURCE = re.compile(r"\.(h|cuh|cpp|cu)(\.in)?$")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')
TEXT = re.compile(r'"(?:[^"\\]|\\.)*"')
SYSTEM_INCLUDE = re.compile(r"^\s*#\s*include\s*<([^>]+)>")


def sources(root):
    for top in ("src", "kokkos"):
        for folder, _, names in os.walk(os.path.join(root, top)):
            for name in sorted(names):
                if SOURCE.search(name):
                    yield os.path.relpath(os.path.join(folder, name), root)


def room_of(path):
    parts = path.split("/")
    return "kokkos" if parts[0] == "kokkos" else parts[1] if len(parts) > 2 else None


def folder_of(room, path):
    """The entry of FOLDERS[room] for one of its files."""
    first, *rest = path.split(f"{room}/", 1)[1].split("/")
    return first if rest or first in FOLDERS.get(room, []) else "."


def wrong_folder(room, path, included):
    """Why a file of a room may not include another one of it; None: it may."""
    order = FOLDERS.get(room, ["."])
    here, there = folder_of(room, path), folder_of(room, included)
    if there in order and order.index(there) <= order.index(here):
        return None
    return f"lies in {there}, which is not below {here} in FOLDERS"


def wrong_include(room, path, included):
    """Why this file of `room` may not include that; None: it may."""
    if "/" not in included:
        if room in LAMMPS_ROOMS or GENERATED.get(room) == included:
            return None
        return "has no room in its name"
    other = included.split("/")[0]
    if other not in FLOOR:
        return f"is of an unknown room {other}"
    if other == "study" and room not in STUDY_ROOMS:
        return "lies in the study, which is for the tool, bench/ and tests"
    if other == room:
        return wrong_folder(room, path, included)
    if FLOOR[other] < FLOOR[room]:
        return None
    return f"lies in a room {'beside' if FLOOR[other] == FLOOR[room] else 'above'} {room}"


def wrong_input(room, path, included):
    """Why this file may not include a header of INPUT_ROOM; None: it may, or it is none."""
    if included.split("/")[0] != INPUT_ROOM or room in INPUT_USERS:
        return None
    return "knows the words of scripts, which are for " + ", ".join(sorted(INPUT_USERS))


def wrong_backend(room, path, included):
    """Why this file may not include a header of src/backend; None: it may, or it is none."""
    if room == "backend":
        return None
    if OF_CUDA.fullmatch(included) and not path.endswith(".cu"):
        return "is of CUDA's backend, for sources that nvcc compiles"
    if included == "backend/block.h" and not path.endswith("_gpu.h"):
        return "has the blocks of a GPU, for files *_gpu.h"
    return None


def circles(root):
    """The includes of src and kokkos that lead back to the file they began in, a list of files each."""
    files = {path: path.split("/", 1)[1] if path.startswith("src/") else path for path in sources(root)}
    path_of = {name: path for path, name in files.items()}
    state = {}    # of a file: True while its includes are followed, then False

    def follow(path, way):
        if state.get(path):
            yield way[way.index(path):] + [path]
        if path in state:
            return
        state[path] = True
        with open(os.path.join(root, path), encoding="utf-8") as f:
            for include in filter(None, map(INCLUDE.match, f)):
                # kokkos/ has no room in the names of its own headers.
                for name in (include[1], f"{os.path.dirname(path)}/{include[1]}"):
                    if name in path_of:
                        yield from follow(path_of[name], way + [path])
        state[path] = False

    for path in files:
        yield from follow(path, [])


def batches(root):
    """Sources that a condition or a return() before them keeps from some builds, and that are compiled with others."""
    for folder, _, names in sorted(os.walk(os.path.join(root, "src"))):
        if "CMakeLists.txt" not in names:
            continue
        with open(os.path.join(folder, "CMakeLists.txt"), encoding="utf-8") as f:
            text = f.read()
        alone = " ".join(re.findall(r"lsdcd_alone\(([^)]*)\)", text)).split()
        for match in re.finditer(r"^( *)target_sources\(lsdcd_core PRIVATE ([^)]*)\)", text, re.M):
            if match[1] or "return()" in text[:match.start()]:
                for name in match[2].split():
                    if name.endswith(".cpp") and name not in alone:
                        yield f"{os.path.relpath(os.path.join(folder, name), root)}: only some builds have it, so it is compiled alone"


def violations(root):
    yield from batches(root)
    for circle in circles(root):
        yield f"{circle[0]}: includes itself: {' -> '.join(circle[1:])}"
    for path in sources(root):
        with open(os.path.join(root, path), encoding="utf-8") as f:
            lines = f.read().splitlines()
        room = room_of(path)
        if room not in FLOOR:
            yield f"{path}: lies in no room" if room is None else f"{path}: room {room} has no floor"
            continue
        if folder_of(room, path) not in FOLDERS.get(room, ["."]):
            yield f"{path}: its folder has no place in FOLDERS"
            continue
        for number, line in enumerate(lines, 1):
            include = INCLUDE.match(line)
            why = include and (wrong_include(room, path, include[1]) or wrong_input(room, path, include[1])
                               or wrong_backend(room, path, include[1]))
            if why:
                yield f"{path}:{number}: {include[1]} {why}"
            word = room in HOST_FREE_ROOMS and not line.lstrip().startswith("#") and HOST_WORDS.search(" ".join(TEXT.findall(line)))
            if word:
                yield f"{path}:{number}: '{word[0]}' is of a host, which {room} does not know"
            lists = room in LAMMPS_ROOMS and path != MODIFY_READER and MODIFY_LISTS.search(line)
            if lists:
                yield f"{path}:{number}: '{lists[0]}' is not in LAMMPS 13Nov2026: ask {MODIFY_READER}"
            system = SYSTEM_INCLUDE.match(line)
            if system and system[1] == "mpi.h" and room not in LAMMPS_ROOMS:
                yield f"{path}:{number}: mpi.h is for {', '.join(sorted(LAMMPS_ROOMS))} only"
            if system and ONLY_IN.get(system[1], path) != path:
                yield f"{path}:{number}: {system[1]} is for {ONLY_IN[system[1]]} only"


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    root = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.dirname(here))
    found = list(violations(root))
    for line in found:
        print(line)
    n = sum(1 for _ in sources(root))
    print(f"{len(found)} violations in {n} files")
    return 1 if found or n == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
