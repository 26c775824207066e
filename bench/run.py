#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Runs benchmarks: programs that print CSV.

usage: run.py [--build DIR] [--only cpu|cuda] [--quick] [--keep | --rows-to DIR] [--commit NAME] [NAME ... | all] [words ...]

Without --keep rows go to build/bench; with it to doc/data, where a row takes the place of the one of the same case, sizes and
order. Then bench/pages.py writes the tables of the pages. Words go to the programs: `./run bench query --help` lists them.
`all` runs each benchmark that this machine can, one after another, says at the end what each took and what could not be run, and with
--keep writes the tables of the pages.

"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import rows

# Name: file of doc/data, devices, command, what it measures. A command with {csv} writes its rows there, others print them.
CPU, BOTH = ("cpu",), ("cpu", "cuda")
COMMON = "--device {device} --commit {commit} {quick}"
SCRIPT = "{python} {bench}/"
BENCHMARKS = {
    "query": ("performance", BOTH, "{bin}/bench_query " + COMMON, "distances by the library, Embree and CGAL"),
    "build": ("performance", BOTH, "{bin}/bench_build " + COMMON, "building of grids, and their cache files"),
    "step": ("performance", BOTH, "{bin}/bench_step " + COMMON, "steps of the engine"),
    "mesh-size": ("mesh-size", BOTH, "{bin}/bench_mesh_size " + COMMON, "the same contacts with 1e2 to 1e7 triangles"),
    "effects": ("effects", BOTH, "{bin}/bench_effects {device} {effects} {commit}", "what each effect of a wall costs"),
    "pairs": ("effects_pairs", CPU, "{bin}/bench_effects pairs 8000 401 {commit}", "what each effect costs between grains"),
    "bodies": ("effects_bodies", CPU, "{bin}/bench_effects bodies 5000 61 {commit}", "what meshes that are rigid bodies cost"),
    "kokkos": ("kokkos", CPU, SCRIPT + "kokkos.py " + COMMON, "steps of a LAMMPS with Kokkos, on its own device"),
    "scale": ("scale", CPU, SCRIPT + "kokkos_scale.py " + COMMON, "how many grains LAMMPS with Kokkos holds in a mesh, and what the wall costs then"),
    "hopper": ("hopper", CPU, SCRIPT + "kokkos_hopper.py " + COMMON, "what each fix adds to a hopper in a LAMMPS with Kokkos"),
    "liggghts": ("liggghts", CPU, SCRIPT + "liggghts.py " + COMMON, "our wall beside LIGGGHTS's"),
    "cores": ("cores", CPU, SCRIPT + "cores.py " + COMMON, "where the time of a step goes on many cores, beside LIGGGHTS"),
    "hard-curves": ("hard_curves", CPU, SCRIPT + "hard_curves.py " + COMMON, "hard cases beside LIGGGHTS and another rule, as curves"),
    "floor": ("floor", CPU, SCRIPT + "own_walls.py floor " + COMMON, "a mesh beside a flat plane"),
    "region": ("region", CPU, SCRIPT + "own_walls.py region " + COMMON, "a mesh beside fix wall/gran/region"),
    "shapes": ("shapes", CPU, "{bin}/bench_shapes " + COMMON, "spheres, ellipsoids and superellipsoids at faces and edges"),
    "nodes": ("nodes", BOTH, "{bin}/bench_nodes " + COMMON, "a rigid sheet and one whose nodes move"),
    "tradeoff": ("tradeoff_vessel", BOTH, SCRIPT + "tradeoff.py vessel " + COMMON, "what accuracy costs in time, in the vessel of examples/vessel"),
    "tradeoff-paper": ("tradeoff_paper", BOTH, SCRIPT + "tradeoff.py paper " + COMMON, "the same on the paper's cylinder"),
    "accuracy": ("accuracy", BOTH, "{bin}/lsdcd accuracy all --device {device} --commit {commit} {study} --csv {csv}", "the paper's study"),
    "hard-cases": ("hard_cases.tsv", BOTH, SCRIPT + "hard_cases.py " + COMMON, "the rows of doc/hard_cases.md, by the tests"),
    "device": ("device", CPU, SCRIPT + "device.py " + COMMON, "steps of a LAMMPS without Kokkos on a core and on a GPU"),
}
DEFAULT = ("query", "build", "step")
ON_ONE_CORE = ("mesh-size", "effects", "pairs", "bodies", "nodes", "shapes", "tradeoff", "tradeoff-paper")
EFFECTS = {"cpu": "5000 401", "cuda": "200000 31"}    # spheres, rounds
STUDY = {"cpu": "", "cuda": "--order random sorted --most-spheres 6e7 --most-triangles 1e6"}
QUICK_STUDY = "--spheres 1e5 --most-triangles 1e4 --repeats 1"


def listed():
    return "\n".join(f"  {name:14} {what}" for name, (_, _, _, what) in BENCHMARKS.items())


def has_gpu():
    try:
        return subprocess.run(["nvidia-smi", "-L"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0
    except OSError:
        return False


def measure(name, device, args, words, folder):
    """Runs a benchmark on a device and keeps its rows in a folder; its exit status."""
    file, _, command, _ = BENCHMARKS[name]
    known = {"bin": os.path.join(args.build, "bin"), "python": sys.executable, "bench": os.path.dirname(os.path.abspath(__file__)),
             "device": device, "commit": args.commit.replace(" ", "_"), "quick": "--quick" * args.quick, "effects": EFFECTS[device],
             "study": QUICK_STUDY if args.quick else STUDY[device]}
    with tempfile.TemporaryDirectory() as made:
        known["csv"] = os.path.join(made, "rows.csv")
        return run_command([word.format(**known) for word in command.format(**known).split()] + words, name, device, args, folder, known["csv"])


def run_command(command, name, device, args, folder, csv):
    """What measure() does with a command, which may write its rows to `csv`."""
    file, words = BENCHMARKS[name][0], command[1:]
    env = dict(os.environ, LSDCD_BUILD=os.path.abspath(args.build))
    threads = "1" if device == "cpu" and name in ON_ONE_CORE else str(os.cpu_count() or 1)
    if name in ON_ONE_CORE:
        env["OMP_NUM_THREADS"] = threads
    env.setdefault("OMP_NUM_THREADS", threads)
    print(" ".join(command), file=sys.stderr, flush=True)
    if "--help" in words:
        return subprocess.run(command, env=env).returncode
    done = subprocess.run(command, env=env, stdout=subprocess.PIPE, text=True)
    print(done.stdout, flush=True)
    if done.returncode == 0:
        text = pathlib.Path(csv).read_text() if os.path.exists(csv) else done.stdout
        for path in rows.keep(folder, file, text, device):
            print("rows are in", path, file=sys.stderr)
    return done.returncode


def measure_all(devices_of, args, words, folder):
    """Runs all benchmarks, however one of them ends; whether all gave their rows."""
    told = []
    for name in BENCHMARKS:
        for device in devices_of(name):
            begin = time.monotonic()
            status = measure(name, device, args, words, folder)
            told.append((name, device, status, time.monotonic() - begin))
    print("\nbenchmark        device  minutes", file=sys.stderr)
    for name, device, status, seconds in told:
        print(f"{name:16} {device:6} {seconds / 60:8.1f}" + (f"  NOT MEASURED: it ended with {status}, see above" if status else ""), file=sys.stderr)
    if args.keep:
        subprocess.run([sys.executable, os.path.join(os.path.dirname(os.path.abspath(__file__)), "pages.py"), "--plots"], check=True)
    return all(status == 0 for _, _, status, _ in told)


def main():
    parser = argparse.ArgumentParser(description=__doc__ + listed(), formatter_class=argparse.RawDescriptionHelpFormatter,
                                     add_help=False, allow_abbrev=False)
    parser.add_argument("--build", default="build", metavar="DIR", help="where bin/ is")
    parser.add_argument("--only", choices=BOTH, help="this device alone")
    parser.add_argument("--quick", action="store_true", help="small sizes, to see that all runs")
    parser.add_argument("--keep", action="store_true", help="put the rows into doc/data")
    parser.add_argument("--rows-to", metavar="DIR", help="put the rows there, as for a machine without the repository")
    parser.add_argument("--commit", metavar="NAME", help="what was built, where git does not know")
    args, rest = parser.parse_known_args()
    names = []
    while rest and not rest[0].startswith("-"):
        names.append(rest.pop(0))
    if not names and {"--help", "-h"} & set(rest):
        parser.print_help()
        return 0
    unknown = [name for name in names if name not in BENCHMARKS and names != ["all"]]
    if unknown:
        print(f"no benchmark '{unknown[0]}'; there are:\n{listed()}", file=sys.stderr)
        return 2
    args.commit = args.commit or rows.commit()
    folder = args.rows_to or (rows.DATA if args.keep else os.path.join(args.build, "bench"))

    def devices_of(name):
        return [d for d in BENCHMARKS[name][1] if args.only == d or (args.only is None and (d == "cpu" or has_gpu()))]
    if names == ["all"]:
        return 0 if measure_all(devices_of, args, rest, folder) else 1
    for name in names or DEFAULT:
        for device in devices_of(name):
            status = measure(name, device, args, rest, folder)
            if status != 0 or "--help" in rest:
                return status
    return 0


if __name__ == "__main__":
    sys.exit(main())
