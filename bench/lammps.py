# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Runs of LAMMPS and LIGGGHTS that are timed from outside, and the words that all their benchmarks take."""
import argparse
import contextlib
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

import rows

sys.path.insert(0, str(rows.ROOT / "examples"))    # for stl.py

# A process begins with the peak of the one that started it, so a small one is put between.
PEAK = ("import resource, subprocess, sys; status = subprocess.call(sys.argv[2:]); "
        "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, file=open(sys.argv[1], 'w')); "
        "sys.exit(status)")
# Open MPI refuses root, and more ranks than cores.
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
       "OMPI_MCA_hwloc_base_binding_policy": "none"}


class Run:
    """What a program has printed, how long it took in seconds, its peak resident memory in MB, and whether it failed."""

    def __init__(self, output, seconds, peak_mb, failed):
        self.output, self.seconds, self.peak_mb, self.failed = output, seconds, peak_mb, failed

    def step_ms(self):
        """ms per step of each run of the script that has steps, by the program's own clock."""
        return loop_ms(self.output)

    def builds(self):
        """Of neighbour lists, in each of those runs."""
        builds = re.findall(r"^Neighbor list builds = (\d+)", self.output, re.M)
        return [int(b) for b in builds[-len(self.step_ms()):]]


def loop_ms(output):
    loops = re.findall(r"^Loop time of (\S+) on .* for (\d+) steps", output, re.M)
    return [1e3 * float(t) / int(n) for t, n in loops if int(n) > 0]


class Program:
    """A LAMMPS or LIGGGHTS, each process on one core: `flags` are words for it and `mpi` those that start several processes, in both
    of which {ranks} is their number. `clock`: see processor_clock."""

    def __init__(self, path, flags="", mpi="mpirun -np {ranks}", threads="1", clock=None):
        self.path, self.flags, self.mpi = os.path.abspath(path), flags, mpi
        self.env = {**os.environ, **MPI, "OMP_NUM_THREADS": threads}
        self.before = ["env", f"LD_PRELOAD={clock}"] if clock else []

    def run(self, text, folder, ranks=1, plain=False, may_fail=False):
        """Runs a script in the folder; `plain`: without the flags. A failure ends the benchmark, unless it may be."""
        (folder / "in.script").write_text(text)
        words = [*self.before, self.path, "-in", "in.script", "-log", "none"]
        words += [] if plain else shlex.split(self.flags.format(ranks=ranks))
        if ranks > 1:
            words = shlex.split(self.mpi.format(ranks=ranks)) + words
        began = time.monotonic()
        with open(folder / "out.txt", "w") as out:
            done = subprocess.run([sys.executable, "-c", PEAK, "peak.txt", *words], cwd=folder, env=self.env, stdout=out,
                                  stderr=subprocess.STDOUT)
        seconds = time.monotonic() - began
        output = (folder / "out.txt").read_text(errors="replace")
        failed = done.returncode != 0 or "ERROR" in output
        if failed and not may_fail:
            raise SystemExit(f"{self.path} failed:\n{output[-4000:]}")
        return Run(output, seconds, int((folder / "peak.txt").read_text()) * 1024 / 1e6, failed)


def in_turn(rounds, names, times):
    """The times of each name, of which times(name) returns some: in turn, so that what else the machine does meets all."""
    found = {name: [] for name in names}
    for _ in range(rounds):
        for name, mine in found.items():
            mine += times(name)
    return found


def processor_clock(folder):
    """A library with which a program times itself by the processor time that it takes, whatever else the machine does."""
    made = folder / "processor_clock.so"
    source = pathlib.Path(__file__).resolve().parent / "processor_clock.c"
    subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-o", str(made), str(source)], check=True)
    return made.resolve()


@contextlib.contextmanager
def work_folder(given):
    """The folder given, which stays, or one that is removed."""
    folder = pathlib.Path(given or tempfile.mkdtemp(prefix="lsdcd-bench-")).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    try:
        yield folder
    finally:
        if not given:
            shutil.rmtree(folder)


def bench(name, about, measure, words=(), steps=0, chunks=3, repeats=3, quick={}):
    """The main of a benchmark: prints the rows that measure(options, folder) returns. `words`: more of the command line, (name, how
    argparse takes it). `steps`: how many are timed as one, where the words of times are wanted; `quick`: what --quick sets where the command
    line does not."""
    p = argparse.ArgumentParser(prog=f"./run bench {name}", description=about, allow_abbrev=False,
                                formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--device", default="cpu", help=argparse.SUPPRESS)
    p.add_argument("--commit", default=rows.commit(), metavar="NAME", help="what was built, where git does not know")
    p.add_argument("--quick", action="store_true", help="small sizes, to see that all runs")
    p.add_argument("--lmp", metavar="FILE", default=os.path.join(os.environ.get("LSDCD_BUILD", "build"), "bin", "lmp-lsdcd"),
                   help="a LAMMPS (default: %(default)s)")
    p.add_argument("--scripts-to", metavar="DIR", help="leave scripts and meshes there")
    if steps:
        p.add_argument("--steps", type=int, default=steps, metavar="N", help="timed as one (default %(default)s)")
        p.add_argument("--chunks", type=int, default=chunks, metavar="N", help="of these in a run (default %(default)s)")
        p.add_argument("--repeats", type=int, default=repeats, metavar="N", help="of each run (default %(default)s)")
    for word, how in words:
        p.add_argument(word, **how)
    options = p.parse_args()
    if options.quick:
        p.set_defaults(**quick)
        options = p.parse_args()
    with work_folder(options.scripts_to) as folder, contextlib.redirect_stdout(sys.stderr):
        found = measure(options, folder)
    print(rows.as_csv(found), end="")
