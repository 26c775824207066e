#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Draws which modules of src and kokkos include which: doc/img/modules.svg, by graphviz (Debian: graphviz).

An arrow goes from a module to one that it includes. It is left out where a way along other arrows leads there too.
"""
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "tool"))
sys.dont_write_bytecode = True
import check_includes    # noqa: E402

STYLE = """digraph modules {
graph [ranksep=0.35 nodesep=0.2 bgcolor=white fontname="sans-serif"]
node [shape=box style="filled,rounded" fillcolor="#eef3f8" color="#5b7a99" fontname="sans-serif" fontsize=13 height=0.4 margin="0.12,0.05"]
edge [color="#8a8a8a" arrowsize=0.6]
"""


def arrows():
    """Pairs of modules of which the first includes the second."""
    for path in sorted(check_includes.sources(ROOT)):
        module = check_includes.module_of(path)
        with open(os.path.join(ROOT, path), encoding="utf-8") as f:
            names = [m[1] for m in map(check_includes.INCLUDE.match, f) if m]
        yield from ((module, name.split("/")[0]) for name in names if "/" in name)


graph = STYLE + "".join(f'"{a}" -> "{b}"\n' for a, b in sorted(set(arrows())) if a != b) + "}\n"
direct = subprocess.run(["tred"], input=graph, stdout=subprocess.PIPE, text=True, check=True).stdout
subprocess.run(["dot", "-Tsvg", "-o", os.path.join(ROOT, "doc", "img", "modules.svg")], input=direct, text=True, check=True)
