#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Runs benchmarks on the CPU and, where there is one, a GPU, and writes what they tell.

usage: run.py [--build DIR] [--only cpu|cuda] [--quick] [--write-only] [--rows-to DIR]
              [--commit NAME] [NAME ...] [words for the programs ...]

NAME: query, build, step, cache (default: these four) make doc/performance.md; three make
documents of their own from runs of other programs: accuracy doc/accuracy.md, doc/paper.md (tradeoff.py,
accuracy.py), effects doc/effects.md (effects.py), hard-cases doc/hard_cases.md
(hard_cases.py). Four compare, also into doc/performance.md: kokkos times steps of a LAMMPS with
Kokkos (kokkos.py), liggghts our wall against LIGGGHTS's (liggghts.py), floor a mesh against a flat
plane (floor.py), mesh-size the same contacts with 1e2 to 1e7 triangles (mesh_size.py). run.py
NAME --words lists the words of the first three. Four print their rows and write no document: turning times
spheres that a turning wall carries along or leaves behind, cells steps by the length of cells, sides on which side of
a closed mesh points are, nodes a rigid sheet and one whose nodes move, on one core. region times a mesh against fix
wall/gran/region (region.py), device steps of a LAMMPS without Kokkos on a core and on a GPU (device.py); both print
their table. decomposition computes how a vessel of 1e9 grains would be shared by 1e3 GPUs, and runs nothing
(decomposition.py).

Rows of the four are kept in doc/data/performance_DEVICE.csv (performance.py). Further words
go to them, as --spheres 1e6; bench_query --help lists them. query --part near-and-far times
distances on one core beside Embree and CGAL. On a machine lent for a GPU:
  run.py --build build --only cuda --rows-to DIR query build step
then, where the repository is, copy DIR/*.csv to doc/data and run.py --write-only.
"""
import argparse
import os
import subprocess
import sys

import accuracy
import device
import effects
import hard_cases
import floor
import kokkos
import liggghts
import mesh_size
import performance
import region
import tradeoff

DOCUMENTS = {"accuracy": [tradeoff.main, accuracy.main], "effects": [effects.main],
             "hard-cases": [hard_cases.main]}
COMPARISONS = {"kokkos": kokkos.main, "liggghts": liggghts.main, "floor": floor.main,
               "mesh-size": mesh_size.main}


def decomposition(args, words):
    """Needs numpy, which a machine lent for a GPU may lack."""
    import decomposition as computed
    return computed.main(args, words)


PRINTED = ["turning", "cells", "sides", "nodes"]
# Tables that they print: region for doc/other-walls.md, device and decomposition for doc/performance.md.
PEERS = {"region": region.main, "device": device.main, "decomposition": decomposition}


def print_rows(name, args, rest):
    """Runs one of PRINTED with its own words; returns its exit status."""
    words = ["--device", args.only] if args.only else []
    words += ["--quick"] if args.quick else []
    env = {**os.environ, "OMP_NUM_THREADS": "1"} if name == "nodes" else None
    return subprocess.run([os.path.join(args.build, "bin", "bench_" + name), *words, *rest], env=env).returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build", metavar="DIR", help="where bin/ is")
    parser.add_argument("--only", choices=performance.DEVICES, help="this device alone")
    parser.add_argument("--quick", action="store_true",
                        help="small sizes, to see that all runs; rows go to DIR/bench")
    parser.add_argument("--write-only", action="store_true",
                        help="make tables and plots from the rows that are kept, and measure nothing; "
                             "without names all of doc/performance.md")
    parser.add_argument("--rows-to", metavar="DIR", help="leave the rows there, write nothing else")
    parser.add_argument("--commit", metavar="NAME", help="what was built, where git does not know")
    args, rest = parser.parse_known_args()
    names = []
    while rest and not rest[0].startswith("-"):
        names.append(rest.pop(0))
    names = names or [*performance.PROGRAMS, *(COMPARISONS if args.write_only else ())]
    known = [*performance.PROGRAMS, *DOCUMENTS, *COMPARISONS, *PRINTED, *PEERS]
    for name in names:
        if name not in known:
            print(f"no benchmark '{name}'; there are: {', '.join(known)}", file=sys.stderr)
            return 2
    programs = [n for n in names if n in performance.PROGRAMS]
    if programs:
        status = performance.main(args, programs, rest)
        if status != 0:
            return status
    for name in names:
        status = COMPARISONS[name](args, rest) if name in COMPARISONS else 0
        if name in PEERS:
            status = PEERS[name](args, rest)
        if name in PRINTED:
            status = print_rows(name, args, rest)
        if status != 0:
            return status
    for name in names:
        for write in DOCUMENTS.get(name, []):
            status = write(["--build", args.build, *["--write-only"] * args.write_only])
            if status != 0:
                return status
    return 0


if __name__ == "__main__":
    sys.exit(main())
