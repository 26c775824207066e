#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Shows that effects which are off are not in the kernels of laws without them.

usage: free_when_off.py [--build DIR]

Compiles the kernels of four laws twice: with the sources as they are, and with a copy
from which every branch of the effects (moving surfaces, records, contact torques, heat, moving nodes,
extra memory) has been cut out.
Counts the instructions that run (callgrind) and those that the GPU's kernel has (SASS,
where there is nvcc). Exits with 1 where two counts differ. DIR is a build of LSDCD with tests.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile

from hard_cases import ROOT

LAWS = ["hooke", "hooke/history", "hertz/history", "granular hertz, linear_history"]
NVCC = shutil.which("nvcc") or "/usr/local/cuda/bin/nvcc"
FLAGS = ["-std=c++17", "-O3", "-DNDEBUG", "-ffp-contract=off"]
# Effects' branches in headers of the kernel.
WALL_FORCE = "engine/step/contact_forces.h"
BRANCHES = {WALL_FORCE: ["Law::kSurface", "Law::kKeepsContacts", "Law::kContactTorque", "Law::kHeat",
                         "Law::kNodes", "Law::kExtra > 0"],
            "law/contact_model.h": ["kContactTorque", "kHeat", "kFull"]}


def end_of_statement(text, at):
    """The place after the statement or block that begins at `at`."""
    while text[at].isspace():
        at += 1
    if text[at] == "{":
        depth = 0
        for i in range(at, len(text)):
            depth += {"{": 1, "}": -1}.get(text[i], 0)
            if depth == 0:
                return i + 1
    if re.match(r"(for|if)\b", text[at:]):
        depth, i = 0, text.index("(", at)
        while True:
            depth += {"(": 1, ")": -1}.get(text[i], 0)
            i += 1
            if depth == 0:
                return end_of_statement(text, i)
    return text.index(";", at) + 1


def cut(text, branches, name):
    for condition in branches:
        head = f"if constexpr ({condition})"
        if head not in text:
            sys.exit(f"{name} has no branch '{head}': free_when_off.py needs its new name")
        while head in text:
            at = text.index(head)
            end = end_of_statement(text, at + len(head))
            rest = re.match(r"\s*else\b", text[end:])
            text = text[:at] + text[end + (rest.end() if rest else 0):]
    return text


def run(command, **kwargs):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          **kwargs)
    if done.returncode != 0:
        sys.exit(" ".join(command) + "\n" + done.stdout)
    return done.stdout


def instructions_run(sources, build, law, folder):
    program = os.path.join(folder, "probe")
    libraries = [os.path.join(build, *name) for name in (("tests", "liblsdcd_test_support.a"),
                                                         ("src", "study", "liblsdcd_study.a"),
                                                         ("src", "liblsdcd_core.a"))]
    runtime = os.path.join(os.path.dirname(NVCC), "..", "lib64", "libcudart_static.a")
    if os.path.exists(runtime):    # of a build with CUDA
        libraries += [runtime, "-lpthread", "-lrt"]
    run(["g++", *FLAGS, "-fopenmp", f"-DPROBE_LAW={law}", "-I" + sources,
         "-I" + os.path.join(ROOT, "tests"), os.path.join(ROOT, "bench", "kernel_probe.cpp"),
         *libraries, "-lzstd", "-lxxhash", "-ldl", "-o", program])
    text = run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                "--toggle-collect=probed_kernel(*", program],
               env=dict(os.environ, OMP_NUM_THREADS="1"))
    return int(re.search(r"Collected : (\d+)", text).group(1))


def instructions_of_gpu(sources, law, folder):
    binary = os.path.join(folder, "probe.cubin")
    run([NVCC, "-std=c++17", "-O3", "-DNDEBUG", "-fmad=false", "--expt-relaxed-constexpr",
         "-arch=sm_90", "-cubin", f"-DPROBE_LAW={law}", "-I" + sources,
         os.path.join(ROOT, "bench", "kernel_probe.cu"), "-o", binary])
    # Machine code is in sections .text.NAME, 16 bytes per instruction.
    sections = re.findall(r"\.text\.\S*\s+PROGBITS\s+\S+\s+\S+\s+([0-9a-f]+)",
                          run(["readelf", "-SW", binary]))
    return sum(int(size, 16) for size in sections) // 16


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build", metavar="DIR")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        whole, without = os.path.join(ROOT, "src"), os.path.join(folder, "src")
        shutil.copytree(whole, without)
        for name, branches in BRANCHES.items():
            with open(os.path.join(without, name)) as f:
                text = f.read()
            with open(os.path.join(without, name), "w") as f:
                f.write(cut(text, branches, name))
        differs = False
        print("| law | counted | with the effects' source | without it |")
        print("| --- | --- | --- | --- |")
        for law, name in enumerate(LAWS):
            counts = {"CPU":
                      [instructions_run(s, args.build, law, folder) for s in (whole, without)]}
            if os.path.exists(NVCC):
                counts["GPU"] = [
                    instructions_of_gpu(s, law, folder) for s in (whole, without)]
            for what, (a, b) in counts.items():
                print(f"| {name} | {what} | {a} | {b} |", flush=True)
                differs = differs or a != b
    return 1 if differs else 0


if __name__ == "__main__":
    sys.exit(main())
