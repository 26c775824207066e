#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Runs the tests of hard cases (doc/hard_cases.md) and prints their rows, tab-separated as doc/data/hard_cases_*.tsv. LSDCD_BUILD: the build folder.

usage: hard_cases.py [--device cpu|cuda] [--commit NAME] [--quick] [--jobs N]
"""
import argparse
import concurrent.futures
import os
import pathlib
import subprocess
import sys
import tempfile

import rows

HEADS = ("theme", "id", "what", "backend", "precision", "relation", "answer", "ours", "tolerance", "derivation", "holds")
BAD_MESHES, RANDOM = "test_bad_meshes", "test_properties"    # those of other labels than physics


def rows_of_test(name, device, env, folder):
    """Rows of all forms of a test on a device, and the end of what it printed if it failed."""
    path = pathlib.Path(folder, name)
    pattern = f"^{name}([.](" + ("cpu|long|more_pairs" if device == "cpu" else "cuda") + "))?$"
    done = subprocess.run(["ctest", "--test-dir", env["LSDCD_BUILD"], "-R", pattern, "--output-on-failure", "-j1"],
                          env={**env, "LSDCD_HARD_CASES": str(path)}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return path.read_text().splitlines() if path.exists() else [], done.stdout[-3000:] if done.returncode else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--device", choices=("cpu", "cuda"), default="cpu")
    parser.add_argument("--commit", default=rows.commit())
    parser.add_argument("--quick", action="store_true", help="a tenth of the random pairs")
    parser.add_argument("--jobs", type=int, default=1, help="tests at a time, as with MPS on a GPU (%(default)s)")
    args = parser.parse_args()
    env = dict(os.environ)
    env.pop("LSDCD_QUICK", None)
    if args.quick:
        env.update(LSDCD_QUICK="1", LSDCD_PAIRS="2e5")
    listed = subprocess.run(["ctest", "--test-dir", env["LSDCD_BUILD"], "-N", "-L", "physics"], stdout=subprocess.PIPE, text=True, check=True).stdout
    names = [line.split()[-1] for line in listed.splitlines() if line.strip().startswith("Test #")]
    names = sorted({name.partition(".")[0] for name in names} | {BAD_MESHES, RANDOM})
    found = []
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(args.jobs) as jobs:
        for name, (made, failed) in zip(names, jobs.map(lambda name: rows_of_test(name, args.device, env, folder), names)):
            found += [line for line in made if line.split("\t")[3] == args.device]
            rows.say(f"{name}: {len(made)} rows")
            if failed:
                sys.exit(f"{name} fails:\n{failed}")
    if not found:
        sys.exit(f"{env['LSDCD_BUILD']} has no tests of hard cases for {args.device}: configure it with -D LSDCD_TESTS=ON")
    where = rows.gpu() if args.device == "cuda" else rows.cpu()
    print(f"# commit {args.commit}, {where}\n# " + "\t".join(HEADS) + "\n" + "\n".join(found))


if __name__ == "__main__":
    main()
