#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The machine code of CUDA kernels is no larger than it was and needs no more registers, of which a processor has 65 536 for all
threads that it runs at once. Stacks are no larger than what a driver gives each program anyhow. All is read from the compiled files,
without a GPU or tools of CUDA's.

usage: test_kernel_sizes.py FILE ... [--keep], with LSDCD_COMPILER set. FILE: a library or objects

A case is a kernel and what it is made of, with its largest instance; kernels below 8 kB are left out. Stacks are those of
the kernels of a step, which run beside all spheres of a program. Walls whose nodes move and those that book energy or
have impacts are left out: they ask for more.
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
SYMBOLS = 2    # the type of a section
# In .nv.info: a format, of which 4 has a length, and an attribute.
MIN_STACK_SIZE = 0x0412
REGISTERS = 0x042f
# Words in a name, of cases of their own: the wall moves and has records, and its nodes move, or it books energy, by triangle, too, or
# has impacts.
KINDS = {"ELb1ELb1ELb1ELb0ELb0EEE": " at nodes that move", "ELb1ELb1ELb0ELb1ELb0EEE": " with books of energy",
         "ELb1ELb1ELb0ELb1ELb1EEE": " with energy of triangles",
         "ELb1ELb1ELb1ELb1ELb0EEE": " with books of energy at nodes that move", "ELb1ELb1ELb0ELb0ELb1EEE": " with impacts",
         "ELb1ELb1ELb1ELb1ELb1EEE": " with energy of triangles at nodes that move", "ELb1ELb1ELb1ELb0ELb1EEE": " with impacts at nodes that move"}
MOST_STACK = 1024    # bytes a thread; a driver sets more aside for every thread that a GPU can hold


def images(data):
    """Sections, by name, of each ELF image that nvcc has embedded in a file: type, link and bytes."""
    at = -1
    while (at := data.find(b"\x7fELF\x02\x01", at + 1)) >= 0:
        if struct.unpack_from("<H", data, at + 18)[0] != EM_CUDA:
            continue
        table = at + struct.unpack_from("<Q", data, at + 40)[0]
        size, n, names = struct.unpack_from("<HHH", data, at + 58)
        rows = [struct.unpack_from("<IIQQQQI", data, table + k * size) for k in range(n)]
        sections = [(kind, link, data[at + offset:at + offset + length])
                    for _, kind, _, _, offset, length, link in rows]
        text = sections[names][2]
        yield sections, {text_at(text, row[0]): k for k, row in enumerate(rows)}


def text_at(data, at):
    return data[at:data.index(b"\0", at)].decode()


def code_sections(data):
    """Name and bytes of each kernel."""
    for sections, named in images(data):
        for name, k in named.items():
            if name.startswith(".text."):
                yield name[len(".text."):], len(sections[k][2])


def attributes(data, wanted):
    """Name and value of an attribute of each kernel."""
    for sections, named in images(data):
        info = sections[named[".nv.info"]][2] if ".nv.info" in named else b""
        _, link, symbols = next(s for s in sections if s[0] == SYMBOLS)
        at = 0
        while at < len(info):
            kind, length = struct.unpack_from(">H", info, at)[0], struct.unpack_from("<H", info, at + 2)[0]
            if kind >> 8 != 4:    # the value is in place of the length
                at += 4
                continue
            if kind == wanted:
                symbol, value = struct.unpack_from("<II", info, at + 4)
                yield text_at(sections[link][2], struct.unpack_from("<I", symbols, 24 * symbol)[0]), value
            at += 4 + length


def case_of(demangled):
    """FindCellSpheres GridWork, of void lsdcd::cuda_for_each_block<lsdcd::FindCellSpheres<lsdcd::GridWork<...> > >(...)."""
    words = [w for w in re.findall(r"lsdcd::(?:\(anonymous namespace\)::)?(\w+)", demangled)
             if w not in ("CudaBackend", "cuda_for_each_block", "lsdcd")]
    member = re.search(r">::(\w+)\(", demangled)
    return " ".join(dict.fromkeys(words[:2] + ([member.group(1)] if member else [])))


files = [a for a in sys.argv[1:] if not a.startswith("--")]
contents = [pathlib.Path(f).read_bytes() for f in files]
kernels = [k for data in contents for k in code_sections(data)]
if not kernels:
    raise SystemExit(f"FAIL no kernel in {', '.join(files) or 'no file'}")
registers = {name: n for data in contents for name, n in attributes(data, REGISTERS)}
full = subprocess.run(["c++filt"], input="\n".join(name for name, _ in kernels),
                      stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()
found = {}
for name, (mangled, size) in zip(full, kernels):
    if "lsdcd::" in name and "cub::" not in name and size >= SMALLEST:
        case = case_of(name)
        case += "".join(words for kind, words in KINDS.items() if kind in mangled)
        found[case] = max(size, found.get(case, 0))
        found[case + ", registers"] = max(registers[mangled], found.get(case + ", registers", 0))
of_steps = [(size, name) for data in contents for name, size in attributes(data, MIN_STACK_SIZE)
            if "StepPart" in name and not any(kind in name for kind in KINDS)]
size, name = max(of_steps, default=(0, ""))
print(f"{len(of_steps)} kernels of a step: stacks of {size} bytes at most, of {MOST_STACK}")
if size > MOST_STACK:
    raise SystemExit(f"FAIL {name} asks for a stack of {size} bytes")
sys.exit(kept_numbers.compare(pathlib.Path(__file__).with_name("kernel_sizes.csv"),
                              os.environ["LSDCD_COMPILER"], found, ROOM, "bytes or registers") > 0)
