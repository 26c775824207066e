# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Scripts that are timed from outside: runs of LAMMPS and LIGGGHTS, and rows of what they took."""
import contextlib
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

import performance
from hard_cases import cpu, write_whole

COLUMNS = ("program", "case", "device", "commit", "compiler", "triangles", "spheres", "length", "order",
           "repeats", "median_ms", "min_ms", "max_ms", "bytes", "copy_gb_s", "floor_ms", "ratio", "facts")


# A process begins with the peak of the one that started it, so a small one is put between.
PEAK = ("import resource, subprocess, sys; status = subprocess.call(sys.argv[2:]); "
        "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, file=open(sys.argv[1], 'w')); "
        "sys.exit(status)")


class Run:
    """One process on one core: its output, wall-clock seconds and peak resident memory, MB. `clock`: see processor_clock."""

    def __init__(self, program, text, folder, clock=None):
        script, log, peak = folder / "in.script", folder / "out.txt", folder / "peak.txt"
        script.write_text(text)
        env = {**os.environ, "OMP_NUM_THREADS": "1"}
        program = [program] if clock is None else ["env", f"LD_PRELOAD={clock}", program]
        began = time.monotonic()
        with open(log, "w") as out:
            done = subprocess.run([sys.executable, "-c", PEAK, peak.name, *program, "-in", script.name, "-log", "none"],
                                  cwd=folder, env=env, stdout=out, stderr=subprocess.STDOUT)
        self.seconds = time.monotonic() - began
        self.output = log.read_text(errors="replace")
        if done.returncode != 0 or "ERROR" in self.output:
            raise SystemExit(f"{program[-1]} failed:\n{self.output[-3000:]}")
        self.peak_mb = int(peak.read_text()) * 1024 / 1e6

    def step_ms(self):
        """ms per step of each run of the script that has steps, by the program's own clock."""
        loops = re.findall(r"^Loop time of (\S+) on .* for (\d+) steps", self.output, re.M)
        return [1e3 * float(t) / int(n) for t, n in loops if int(n) > 0]

    def builds(self):
        """Of neighbour lists, in each of those runs."""
        builds = re.findall(r"^Neighbor list builds = (\d+)", self.output, re.M)
        return [int(b) for b in builds[-len(self.step_ms()):]]


def processor_clock(folder):
    """A library with which a program times itself by the processor time that it takes, whatever else the machine does."""
    made = folder / "processor_clock.so"
    source = pathlib.Path(__file__).resolve().parent / "processor_clock.c"
    subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-o", str(made), str(source)], check=True)
    return made.resolve()


def row(program, case, commit, triangles, spheres, order, ms, compiler="", **facts):
    """In the format of bench.h, from times in ms (they may be differences)."""
    r = dict.fromkeys(COLUMNS, "")
    r.update(program=program, case=case, device=f"CPU, 1 thread, {cpu()}", commit=commit,
             compiler=compiler, triangles=triangles, spheres=spheres, length=0, order=order,
             repeats=len(ms), median_ms=f"{statistics.median(ms):.5g}", min_ms=f"{min(ms):.5g}",
             max_ms=f"{max(ms):.5g}", facts=" ".join(f"{k}={v}" for k, v in facts.items()))
    print(", ".join(str(v) for v in list(r.values())[1:] if v != ""), flush=True)
    return {k: str(v) for k, v in r.items()}


# ---- rows that are kept ------------------------------------------------------------------

def kept(name, folder=performance.DATA, device="cpu"):
    return pathlib.Path(folder, f"{name}_{device}.csv")


def read_rows(name, folder=performance.DATA, device="cpu"):
    path = kept(name, folder, device)
    return performance.parse(path.read_text()) if path.exists() else []


def keep(name, rows, folder=performance.DATA, device="cpu"):
    """A row takes the place of the one under its key."""
    fresh = {performance.key(r): r for r in rows}
    old = [fresh.pop(performance.key(r), r) for r in read_rows(name, folder, device)]
    write_whole(str(kept(name, folder, device)), performance.as_csv(old + list(fresh.values())))


def rows_folder(args):
    """Where a command of run.py keeps its rows; quick ones are not for the document."""
    folder = args.rows_to or (os.path.join(args.build, "bench") if args.quick else performance.DATA)
    os.makedirs(folder, exist_ok=True)
    return folder


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


def machines(rows):
    """Which machines and commits the rows of a table are from."""
    lines = []
    for device in dict.fromkeys(r["device"] for r in rows):
        mine = [r for r in rows if r["device"] == device]
        commits, repeats = (", ".join(dict.fromkeys(r[k] for r in mine)) for k in ("commit", "repeats"))
        lines.append(f"* {device}: commit {commits}; medians of {repeats} (least to most).")
    return "\n".join(lines) or "* No rows are kept yet."
