# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Scripts that are timed from outside: runs of LAMMPS and LIGGGHTS."""
import argparse
import contextlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

import rows
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


def parser(name, about):
    """The words that run.py gives every script."""
    p = argparse.ArgumentParser(prog=f"./run bench {name}", description=about, allow_abbrev=False,
                                formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--device", default="cpu", help=argparse.SUPPRESS)
    p.add_argument("--commit", default=rows.commit(), metavar="NAME", help="what was built, where git does not know")
    p.add_argument("--quick", action="store_true", help="small sizes, to see that all runs")
    p.add_argument("--lmp", metavar="FILE", default=os.path.join(os.environ.get("LSDCD_BUILD", "build"), "bin", "lmp-lsdcd"),
                   help="a LAMMPS (default: %(default)s)")
    p.add_argument("--scripts-to", metavar="DIR", help="leave scripts and meshes there")
    return p
