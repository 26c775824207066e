#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Programs of 0.9.0 run with the library of today: all that it exported is there, and abi/program.c, compiled with
the header of 0.9.0, calls each function of it. Prints a line per fact.

From the environment: LSDCD_LIBRARY, the library; LSDCD_C and LSDCD_CXX, compilers.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent / "abi"
LIBRARY = pathlib.Path(os.environ["LSDCD_LIBRARY"])
failed = 0


def fact(name, good, detail=""):
    global failed
    failed += not good
    print(f"{'ok' if good else 'FAILED'}: {name}" + ("" if good else f"\n{detail}"), flush=True)


def run(*words, folder=None):
    done = subprocess.run([str(word) for word in words], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, env=dict(os.environ, OMP_NUM_THREADS="1"))
    return done.returncode, done.stdout


def main():
    names = [line for line in (HERE / "symbols.txt").read_text().split("\n") if line and not line.startswith("#")]
    exported = {line.split()[-1] for line in run("nm", "-D", "--defined-only", LIBRARY)[1].split("\n") if line}
    gone = [name for name in names if f"{name}@@LSDCD_0" not in exported]
    fact(f"the {len(names)} functions of 0.9.0 are exported in the version LSDCD_0", not gone, " ".join(gone))
    soname = run("objdump", "-p", LIBRARY)[1]
    fact("the soname is that of 0.9.0", "liblsdcd.so.0\n" in soname, soname)

    program = (HERE / "program.c").read_text()
    unused = [name for name in names if name + "(" not in program]
    fact("the program calls each of them", not unused, " ".join(unused))
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        for source, words in (("program.c", [os.environ["LSDCD_C"], "-std=c99"]),
                              ("program.cpp", [os.environ["LSDCD_CXX"], "-std=c++17"])):
            status, text = run(*words, "-Wall", "-Werror", "-I", HERE, HERE / source, "-o", folder / source[8:], LIBRARY,
                               "-lm", f"-Wl,-rpath,{LIBRARY.parent}")
            fact(f"{source} compiles with the header of 0.9.0", status == 0, text)
            if status == 0:
                status, text = run(folder / source[8:], folder=folder)
                fact(f"{source} runs with the library of today", status == 0, f"exit status {status}\n{text}")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
