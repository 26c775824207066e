#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Checks that the backends have the verbs that src/backend/backend.h lists and no others, and that only they
know CUDA.

* Outside of src/backend no file has a word of CUDA's language, runtime or libraries, but for the markers of
  functions in MARKERS.
* There headers of CUDA's backend are included by sources for nvcc (.cu) only, and what a GPU's blocks have
  (block.h) by files *_gpu.h only.

usage: check_backends.py [ROOT]

Prints one line per violation, and exits with 1 if there is one.
"""
import os
import re
import sys

import check_includes

MORE = {"backend_cpu.h": set(), "backend_cuda.h": {"for_each_block", "Limits", "sort_in"}}    # beside the list
MARKERS = "src/base/real.h"
# The tool is a program of its own, which uses the library as any other does.
MAY_CALL = {MARKERS, "src/tool/point_answers.cpp"}
CUDA = re.compile("|".join([
    r"<<<|\bcuda[A-Z]\w*\s*\(|\bcudaStream_t\b|\b(?:cub|thrust)::|<(?:cuda|cub/|thrust/)[\w/.]+>",    # runtime
    r"__CUDA\w*|__(?:global|device|host|shared|constant|grid_constant|launch_bounds)__",    # language
    r"\b(?:(?:thread|block)Idx|(?:block|grid)Dim|uint4|atomic(?:Add|Or|Max|CAS|Exch))\b",
    r"\b__(?:sync|ballot|any_sync|shfl|pipeline|popc|ffs|ldcs|activemask|dadd|double_as)\w*"]))    # intrinsics
# Headers of src/backend, and who includes them: sources for a backend, and code for a GPU's blocks.
OF_CUDA = re.compile(r'#include "backend/(?:backend_cuda|cuda_(?!available)\w+)\.h"')
OF_GPU = re.compile(r'#include "backend/block\.h"')


def listed(text):
    """The verbs in the comment of backend.h: words that begin a row, up to its description."""
    rows = re.findall(r"^//   (\w+(?:, \w+)*)  ", text, re.M)
    return {word for row in rows for word in row.split(", ")}


def members(text):
    """Names of public functions and types of the backend in this file; what holds memory is no verb."""
    body = re.search(r"^struct \w+Backend \{(.*?)^(?: private:|\};)", text, re.M | re.S)[1]
    functions = re.findall(r"^  (?! |explicit|return)[\w:<>*& ]+?[ *&](\w+)\(", body, re.M)
    types = re.findall(r"^  (?:struct|class|using) (\w+)", body, re.M)
    return set(functions + [t for t in types if not t.endswith("Memory")])


def violations(root):
    backend = os.path.join(root, "src", "backend")
    with open(os.path.join(backend, "backend.h"), encoding="utf-8") as f:
        verbs = listed(f.read())
    for name, more in MORE.items():
        with open(os.path.join(backend, name), encoding="utf-8") as f:
            found = members(f.read())
        for verb in sorted(found ^ (verbs | more)):
            yield f"src/backend/{name}: {verb} is {'not in the list' if verb in found else 'missing'}"
    for path in check_includes.sources(root):
        if path.startswith("src/backend/") or path in MAY_CALL:
            continue
        with open(os.path.join(root, path), encoding="utf-8") as f:
            for number, line in enumerate(f, 1):
                word = CUDA.search(re.sub(r'//.*|/\*.*|"[^"]*"', "", line))
                if word:
                    yield f"{path}:{number}: {word[0]} is for src/backend only"
                if OF_CUDA.match(line) and not path.endswith(".cu"):
                    yield f"{path}:{number}: a header of CUDA's is for a source that nvcc compiles"
                if OF_GPU.match(line) and not path.endswith("_gpu.h"):
                    yield f"{path}:{number}: blocks of a GPU are for a file *_gpu.h"


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    root = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.dirname(here))
    found = list(violations(root))
    for line in found:
        print(line)
    print(f"{len(found)} violations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
