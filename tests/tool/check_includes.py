#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Checks the layout of src and kokkos: who includes whom, where files lie, and who knows the host.

usage: check_includes.py [ROOT]

* A file includes its own module and modules on lower layers (LAYERS, from the lowest). Modules of one
  layer do not include each other.
* Inside a module a file includes its own folder and lower ones (FOLDERS, from the lowest).
* The words of scripts (INPUT_MODULE) are for the modules INPUT_USERS.
* The study is for STUDY_MODULES, bench/ and tests: what it measures is no part of a plugin or the library.
* Only LAMMPS_MODULES include headers of LAMMPS, which have no module in their name, and of MPI.
* Outside of src/backend headers of CUDA's backend are for sources of nvcc (.cu), and what a GPU's blocks have (block.h) for files *_gpu.h.
* A header of ONLY_IN, which is slow to compile, is included by its one file.
* HOST_FREE_MODULES name no host in texts: neither LAMMPS nor its commands (HOST_WORDS). A host has
  its words and remedies in messages by Host::names().
* The lists of LAMMPS's Modify (MODIFY_LISTS), which LAMMPS 13Nov2026 does not have, are for MODIFY_READER; others ask its functions.
* No file includes itself by way of others.
* src itself has no source file: each lies in a module, and each module has a layer.
* A source that only some builds of the core have is compiled alone (lsdcd_alone of src/CMakeLists.txt), so that the others are
  compiled together in the same way in all of them.

Prints one line per violation, and exits with 1 if there is one.
"""
import os
import re
import sys

LAYERS = [["base"], ["backend"], ["geometry", "shape"], ["mesh"], ["box"], ["host"], ["motion"], ["grid", "rigid", "tree"], ["clump", "contact"], ["law"], ["engine"],
          ["bodies", "query", "effects", "output", "material", "flow", "insert"],
          ["pair", "study"], ["wall"], ["input"], ["lammps", "tool", "api"], ["kokkos"]]
# Of each module with folders. "." stands for the files that lie in none, but for those that are named.
FOLDERS = {
    "mesh": [".", "io"],
    "grid": [".", "lookup", "plan", "build", "cache"],
    "law": ["contact.h", "force_parts.h", "reach.h", "submodels", "."],
    "engine": ["results", ".", "lists", "nodes", "loads", "broad_phase", "step", "on_backend"],
    "wall": ["spec", "spheres", "sums", "saved", "surface", "move", "part", "coat", "checks", "reports", "."],
    "lammps": [".", "launcher"],
}
INPUT_MODULE = "input"
INPUT_USERS = {"api", "input", "lammps", "tool"}
STUDY_MODULES = {"study", "tool"}
HOST_FREE_MODULES = {"host", "wall", "engine"}
HOST_WORDS = re.compile(
    r"\b(lammps\w*|kokkos\w*|atoms?|fix(es)?|scripts?|skin|reruns?|dump(s|ed)?|thermo\w*|restart files?"
    r"|fix_\w+|\w+_modify|\w+_restart|reset_timestep|create_atoms|enforce2d|set group|nktv2p|ftm2v)\b", re.IGNORECASE)
LAMMPS_MODULES = {"lammps", "kokkos"}
GENERATED = {"grid": "lsdcd_grid_sources.h"}
ONLY_IN = {"CLI/CLI.hpp": "src/tool/command.cpp"}
MODIFY_READER = "src/lammps/host_fixes.h"
MODIFY_LISTS = re.compile(r"\b(nfix|ncompute|fmask|find_(fix|compute)(_by_style)?)\b|\bmodify\s*(->|\.)\s*(fix|compute)\b")
OF_CUDA = re.compile(r"backend/(backend_cuda|cuda_(?!available)\w+)\.h")

LAYER = {module: layer for layer, modules in enumerate(LAYERS) for module in modules}
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


def module_of(path):
    parts = path.split("/")
    return "kokkos" if parts[0] == "kokkos" else parts[1] if len(parts) > 2 else None


def folder_of(module, path):
    """The entry of FOLDERS[module] for one of its files."""
    first, *rest = path.split(f"{module}/", 1)[1].split("/")
    return first if rest or first in FOLDERS.get(module, []) else "."


def wrong_folder(module, path, included):
    """Why a file of a module may not include another one of it; None: it may."""
    order = FOLDERS.get(module, ["."])
    here, there = folder_of(module, path), folder_of(module, included)
    if there in order and order.index(there) <= order.index(here):
        return None
    return f"lies in {there}, which is not below {here} in FOLDERS"


def wrong_include(module, path, included):
    """Why this file of `module` may not include that; None: it may."""
    if "/" not in included:
        if module in LAMMPS_MODULES or GENERATED.get(module) == included:
            return None
        return "has no module in its name"
    other = included.split("/")[0]
    if other not in LAYER:
        return f"is of an unknown module {other}"
    if other == "study" and module not in STUDY_MODULES:
        return "lies in the study, which is for the tool, bench/ and tests"
    if other == module:
        return wrong_folder(module, path, included)
    if LAYER[other] < LAYER[module]:
        return None
    return f"lies in a module {'beside' if LAYER[other] == LAYER[module] else 'above'} {module}"


def wrong_input(module, path, included):
    """Why this file may not include a header of INPUT_MODULE; None: it may, or it is none."""
    if included.split("/")[0] != INPUT_MODULE or module in INPUT_USERS:
        return None
    return "knows the words of scripts, which are for " + ", ".join(sorted(INPUT_USERS))


def wrong_backend(module, path, included):
    """Why this file may not include a header of src/backend; None: it may, or it is none."""
    if module == "backend":
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
                # kokkos/ has no module in the names of its own headers.
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
        module = module_of(path)
        if module not in LAYER:
            yield f"{path}: lies in no module" if module is None else f"{path}: module {module} has no layer"
            continue
        if folder_of(module, path) not in FOLDERS.get(module, ["."]):
            yield f"{path}: its folder has no place in FOLDERS"
            continue
        for number, line in enumerate(lines, 1):
            include = INCLUDE.match(line)
            why = include and (wrong_include(module, path, include[1]) or wrong_input(module, path, include[1])
                               or wrong_backend(module, path, include[1]))
            if why:
                yield f"{path}:{number}: {include[1]} {why}"
            word = module in HOST_FREE_MODULES and not line.lstrip().startswith("#") and HOST_WORDS.search(" ".join(TEXT.findall(line)))
            if word:
                yield f"{path}:{number}: '{word[0]}' is of a host, which {module} does not know"
            lists = module in LAMMPS_MODULES and path != MODIFY_READER and MODIFY_LISTS.search(line)
            if lists:
                yield f"{path}:{number}: '{lists[0]}' is not in LAMMPS 13Nov2026: ask {MODIFY_READER}"
            system = SYSTEM_INCLUDE.match(line)
            if system and system[1] == "mpi.h" and module not in LAMMPS_MODULES:
                yield f"{path}:{number}: mpi.h is for {', '.join(sorted(LAMMPS_MODULES))} only"
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
