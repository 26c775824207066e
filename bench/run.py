#!/usr/bin/env python3
"""Runs benchmark programs, keeps their CSV and prints it as a table.

usage: run.py [--build DIR] [NAME ...]     NAME: build, cache, step (default: all), accuracy,
                                           effects, hard-cases

Rows go to DIR/bench/NAME.csv, written whole or not at all. Three write documents instead:
hard-cases doc/hard_cases.md from runs of the tests (hard_cases.py), accuracy
doc/accuracy.md from runs of `lsdcd tradeoff` (tradeoff.py) and `lsdcd accuracy` (accuracy.py),
effects doc/effects.md from runs of `lsdcd effects` (effects.py).
"""
import argparse
import csv
import os
import subprocess
import sys

import accuracy
import effects
import hard_cases
import tradeoff

NAMES = ["build", "cache", "step"]
DOCUMENTS = {"accuracy": [tradeoff.main, accuracy.main], "effects": [effects.main],
             "hard-cases": [hard_cases.main]}
HIDDEN = {"bench", "compiler", "commit"}    # the same in every row; printed once


def table(rows, columns):
    width = [max(len(c), *(len(r[c]) for r in rows)) for c in columns]
    lines = ["  ".join(c.rjust(w) for c, w in zip(columns, width))]
    for r in rows:
        lines.append("  ".join(r[c].rjust(w) for c, w in zip(columns, width)))
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build", metavar="DIR", help="where bin/ is")
    parser.add_argument("names", nargs="*", metavar="NAME")
    args = parser.parse_args()
    build, names = args.build, args.names or NAMES
    for name in names:
        if name not in NAMES + list(DOCUMENTS):
            print(f"no benchmark '{name}'; there are: {', '.join(NAMES + list(DOCUMENTS))}",
                  file=sys.stderr)
            return 2
    out = os.path.join(build, "bench")
    os.makedirs(out, exist_ok=True)
    for name in names:
        if name in DOCUMENTS:
            for write in DOCUMENTS[name]:
                status = write(["--build", build])
                if status != 0:
                    return status
            continue
        print(f"running bench_{name} ...", flush=True)
        done = subprocess.run([os.path.join(build, "bin", "bench_" + name)],
                              stdout=subprocess.PIPE, text=True)
        if done.returncode != 0:
            print(f"bench_{name} failed with status {done.returncode}", file=sys.stderr)
            return 1
        path = os.path.join(out, name + ".csv")
        with open(path + ".part", "w") as f:
            f.write(done.stdout)
        os.replace(path + ".part", path)
        rows = list(csv.DictReader(done.stdout.splitlines()))
        columns = [c for c in rows[0] if c not in HIDDEN]
        print(f"{name}: commit {rows[0]['commit']}, {rows[0]['compiler']}; {path}")
        print(table(rows, columns))
    return 0


if __name__ == "__main__":
    sys.exit(main())
