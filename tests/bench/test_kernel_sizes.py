#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The machine code of CUDA kernels is no larger than it was: read from the compiled files, without a
GPU or tools of CUDA's.

usage: test_kernel_sizes.py FILE ... [--keep], with LSDCD_COMPILER set. FILE: a library or objects

A case is a kernel and what it is made of, with its largest instance; kernels below 8 kB are left out.
"""
import os
import pathlib
import re
import struct
import subprocess
import sys

import kept_numbers

ROOM = 0.10
SMALLEST = 8192    # bytes
EM_CUDA = 190


def code_sections(data):
    """Name and bytes of each kernel in the ELF images that nvcc has embedded in a file."""
    at = -1
    while (at := data.find(b"\x7fELF\x02\x01", at + 1)) >= 0:
        if struct.unpack_from("<H", data, at + 18)[0] != EM_CUDA:
            continue
        table = at + struct.unpack_from("<Q", data, at + 40)[0]
        size, n, names = struct.unpack_from("<HHH", data, at + 58)
        sections = [struct.unpack_from("<IIQQQQ", data, table + k * size) for k in range(n)]
        for name, _, _, _, _, length in sections:
            start = at + sections[names][4] + name
            text = data[start:data.index(b"\0", start)].decode()
            if text.startswith(".text."):
                yield text[len(".text."):], length


def case_of(demangled):
    """FindCellSpheres GridWork, of void lsdcd::cuda_for_each_block<lsdcd::FindCellSpheres<lsdcd::GridWork<...> > >(...)."""
    words = [w for w in re.findall(r"lsdcd::(?:\(anonymous namespace\)::)?(\w+)", demangled)
             if w not in ("CudaBackend", "cuda_for_each_block", "lsdcd")]
    member = re.search(r">::(\w+)\(", demangled)
    return " ".join(dict.fromkeys(words[:2] + ([member.group(1)] if member else [])))


files = [a for a in sys.argv[1:] if not a.startswith("--")]
kernels = [k for f in files for k in code_sections(pathlib.Path(f).read_bytes())]
if not kernels:
    raise SystemExit(f"FAIL no kernel in {', '.join(files) or 'no file'}")
full = subprocess.run(["c++filt"], input="\n".join(name for name, _ in kernels),
                      stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()
found = {}
for name, (_, size) in zip(full, kernels):
    if "lsdcd::" in name and "cub::" not in name and size >= SMALLEST:
        found[case_of(name)] = max(size, found.get(case_of(name), 0))
sys.exit(kept_numbers.compare(pathlib.Path(__file__).with_name("kernel_sizes.csv"),
                              os.environ["LSDCD_COMPILER"], found, ROOM, "bytes") > 0)
