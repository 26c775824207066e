# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Runs input scripts under lmp-lsdcd and reads what they dump. Standard library only."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

CXX = os.environ.get("LSDCD_CXX", "c++")
HERE = pathlib.Path(__file__).resolve().parent
LMP = os.environ.get("LSDCD_LMP", str(HERE.parent.parent / "build" / "bin" / "lmp-lsdcd"))
LIB = pathlib.Path(LMP).resolve().parent.parent / "lib"

# The small samples of ./run test.
QUICK = bool(os.environ.get("LSDCD_QUICK"))

# The LAMMPS of hosts/build_host.sh and the plugin for it; empty where it was not built.
TEST_HOST = os.environ.get("LSDCD_TEST_HOST", "") and os.environ["LSDCD_TEST_HOST"] + "/lmp"
TEST_HOST_PLUGIN = LIB / "lsdcd-20260704-plugin.so"

# A LAMMPS with Kokkos and the plugin for it. Where LSDCD_KOKKOS is set, scripts run there as
# they are, with -sf kk.
KOKKOS_HOST = os.environ.get("LSDCD_KOKKOS_HOST", "") and os.environ["LSDCD_KOKKOS_HOST"] + "/lmp"
KOKKOS_PLUGIN = os.environ.get("LSDCD_KOKKOS_PLUGIN", "")
ON_KOKKOS = bool(os.environ.get("LSDCD_KOKKOS"))

# Spheres of diameter 1 in a box of side 6: with nothing that moves them, and with it.
SMALL_BOX_AT_REST = """\
units           lj
atom_style      sphere
atom_modify     map array
boundary        f f f
newton          off
comm_modify     vel yes
region          box block -3 3 -3 3 -1 5
create_box      1 box
{atoms}
set             group all diameter 1.0 density 2.0
pair_style      zero 1.2
pair_coeff      * *
"""
SMALL_BOX = SMALL_BOX_AT_REST + "fix             move all nve/sphere\n"

MPI_FOLDER = tempfile.TemporaryDirectory(prefix="mpi")


def environment():
    env = dict(os.environ, OMP_NUM_THREADS="1")
    # Open MPI refuses root, more ranks than cores, and binding in some containers.
    env.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
               OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_hwloc_base_binding_policy="none",
               OMPI_MCA_btl_vader_single_copy_mechanism="none")
    # A process alone needs no daemon, which would take longer than most scripts.
    env.update(OMPI_MCA_ess_singleton_isolated="1")
    # All processes are on one machine: looking for networks takes 0.2 s of each start.
    env.update(OMPI_MCA_pml="ob1")
    # After an error it gives the others a second or two to end by themselves.
    env.update(OMPI_MCA_odls_base_sigkill_timeout="0")
    # All such processes give their folder the same name and remove it when they end. Each gets a
    # parent folder of its own, so that none removes the folder of another.
    env.update(OMPI_MCA_orte_tmpdir_base=tempfile.mkdtemp(dir=MPI_FOLDER.name))
    return env


def for_host(text, flags):
    """A script with the plugin loaded. With a suffix, flat walls of LAMMPS stay without it: not
    every style of fix wall/gran has a form for Kokkos."""
    if DEVICE_MOVES:    # which fix wall/gran on the host would not allow
        text = re.sub(r"(fix +\S+ +\S+ +)wall/gran .* ([xyz])plane +(\S+) +(\S+)",
                      r"\1wall/reflect \2lo \3 \2hi \4 units box", text)
    if "-sf" in flags and "suffix " not in text:
        text = re.sub(r"^(\s*fix\s.*wall/gran\s(?:.*&\n)*.*)$", r"suffix off\n\1\nsuffix on", text,
                      flags=re.M)
    if not KOKKOS_PLUGIN:    # the styles are compiled in
        return text
    text = re.sub(r"^clear\b.*$", rf"\g<0>\nplugin load {KOKKOS_PLUGIN}", text, flags=re.M)
    return f"plugin load {KOKKOS_PLUGIN}\n" + text


# With LSDCD_KOKKOS_MOVES=device atoms are sorted and exchanged by Kokkos's kernels, as on a GPU; on
# a host without one Kokkos leaves that to LAMMPS.
# LSDCD_KOKKOS_FLAGS: of a host on a GPU, "-k on g 1 -sf kk -pk kokkos newton off neigh half"; empty for a LAMMPS without
# Kokkos, which LSDCD_KOKKOS_HOST and LSDCD_KOKKOS_PLUGIN may be as well.
KOKKOS = tuple(os.environ.get("LSDCD_KOKKOS_FLAGS", "-k on -sf kk").split())
# What starts several processes of it, and how many at most: those of MPICH never give up a core while they wait.
MPIRUN = os.environ.get("LSDCD_MPIRUN", "mpirun --oversubscribe").split()
MOST_RANKS = int(os.environ.get("LSDCD_MOST_RANKS", "1000"))
DEVICE_MOVES = os.environ.get("LSDCD_KOKKOS_MOVES") == "device"
if DEVICE_MOVES:
    KOKKOS += ("-pk", "kokkos", "comm", "device", "sort", "device")


def column():
    """The letter before the ID of a fix whose per-atom array an atom-style variable reads: F in 29Sep2021, f in later LAMMPS."""
    said = subprocess.run([KOKKOS_HOST if ON_KOKKOS else LMP, "-h"], env=environment(), text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL, check=False).stdout
    return "F" if re.search(r"LAMMPS 2021|Simulator - \d+ \w+ 2021", said) else "f"


def run(script, folder, ranks=1, timeout=300, env=None, host=ON_KOKKOS, flags=KOKKOS, **variables):
    """Runs a script (a path, or text) in `folder`; returns the finished process. With `host`
    under the LAMMPS with Kokkos, given `flags`."""
    script, folder = str(script), pathlib.Path(folder)
    if host:
        script = for_host(script if "\n" in script else pathlib.Path(script).read_text(), flags)
    if "\n" in script:
        (folder / "in.script").write_text(script)
        script = str(folder / "in.script")
    command = [KOKKOS_HOST if host else LMP, "-in", script, "-log", "none", "-nocite"]
    command += flags if host else ()
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    if ranks > 1:
        command = [*MPIRUN, "-np", str(min(ranks, MOST_RANKS)), *command]
    return subprocess.run(command, cwd=folder, env={**environment(), **(env or {})}, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=timeout)


def run_well(*args, **kwargs):
    """The same; the script must succeed."""
    done = run(*args, **kwargs)
    if done.returncode:
        sys.exit(f"script failed with {done.returncode}:\n{done.stdout[-4000:]}")
    return done.stdout


def scratch():
    return pathlib.Path(tempfile.mkdtemp(prefix="lsdcd-"))


def read_dump(path):
    """{step: {atom: [numbers after the id]}} of a text dump whose first column is id."""
    steps, lines = {}, pathlib.Path(path).read_text().split("\n")
    at = 0
    while at < len(lines) and lines[at].startswith("ITEM: TIMESTEP"):
        step, count = int(lines[at + 1]), int(lines[at + 3])
        rows = [line.split() for line in lines[at + 9:at + 9 + count]]
        steps[step] = {int(row[0]): [float(word) for word in row[1:]] for row in rows}
        at += 9 + count
    return steps


def read_thermo(output):
    """Rows of numbers of the last thermo table."""
    rows = []
    for line in output.split("\n"):
        if re.match(r"^\s*Step\b", line):
            rows = []
        elif re.match(r"^\s*\d+(\s+[-+\d.einaf]+)+\s*$", line):
            rows.append([float(word) for word in line.split()])
    return rows


def largest_difference(a, b):
    """Of two dumps of the same steps and atoms, relative to the largest value of each column."""
    if a.keys() != b.keys():
        sys.exit(f"steps differ: {sorted(a)[:3]}... and {sorted(b)[:3]}...")
    columns = len(next(iter(next(iter(a.values())).values())))
    size, apart = [0.0] * columns, [0.0] * columns
    for step in a:
        if a[step].keys() != b[step].keys():
            sys.exit(f"atoms differ at step {step}")
        for atom, row in a[step].items():
            for k, (u, v) in enumerate(zip(row, b[step][atom])):
                size[k] = max(size[k], abs(u))
                apart[k] = max(apart[k], abs(u - v))
    return max(d / s if s else d for d, s in zip(apart, size))


def sample(laws):
    """All laws of a table; in the small samples the last, for tests of walls, which are the same for each law."""
    return dict(list(laws.items())[-1:]) if QUICK else laws


class Checks:
    """Counts facts; the exit status of the test is whether all held."""

    def __init__(self):
        self.failed = 0

    def fact(self, name, holds, detail=""):
        print(f"{'PASS' if holds else 'FAIL'} {name}{': ' + detail if detail else ''}")
        self.failed += not holds

    def at_most(self, name, value, limit):
        self.fact(name, value <= limit, f"{value:.3g} (at most {limit:g})")

    def done(self, folder=None):
        if folder and not self.failed:
            shutil.rmtree(folder)
        elif folder:
            print("files are in", folder)
        sys.exit(1 if self.failed else 0)
