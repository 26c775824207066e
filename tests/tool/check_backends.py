#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Checks that the backends have the verbs that src/backend/backend.h lists and no others, and that only they
know CUDA's runtime.

usage: check_backends.py [ROOT]

Prints one line per violation, and exits with 1 if there is one.
"""
import os
import re
import sys

import check_includes

MORE = {"backend_cpu.h": set(), "backend_cuda.h": {"launch"}}    # beside the list
# Calls of the runtime, and the syntax that starts a kernel.
RUNTIME = re.compile(r"<<<|\bcuda[A-Z]\w*\s*\(")
# The tool is a program of its own, which uses the library as any other does.
MAY_CALL = {"src/tool/point_answers.cpp"}


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
                call = RUNTIME.search(re.sub(r'//.*|"[^"]*"', "", line))
                if call:
                    yield f"{path}:{number}: {call[0]} is for src/backend only"


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
