# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run a script at several settings side by side, read the numbers that it prints, plot them."""
import argparse
import concurrent.futures
import contextlib
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def options(doc, folder):
    """--lmp and --work, for a script in `folder`."""
    p = argparse.ArgumentParser(description=doc)
    p.add_argument("--lmp", default=os.environ.get("LSDCD_LMP", ROOT / "build/bin/lmp-lsdcd"))
    p.add_argument("--work", type=Path, default=ROOT / "build/examples" / folder.name,
                   help="folder for the runs")
    p.add_argument("--flags", default="", metavar="WORDS", help="for LAMMPS, as '-k on g 1 -sf kk -pk kokkos newton off neigh half'")
    p.add_argument("--at-once", type=int, default=os.cpu_count(), metavar="N", help="runs side by side: 1 on a GPU (default: cores)")
    return p


@contextlib.contextmanager
def environment():
    """Open MPI's own files apart, so that runs side by side do not remove each other's."""
    with tempfile.TemporaryDirectory(prefix="mpi") as mpi:
        yield dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
                   OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1",
                   OMPI_MCA_ess_singleton_isolated="1", OMPI_MCA_orte_tmpdir_base=mpi)


def make_meshes(script, work, *more):
    """Let `script` write its STL files into `work`."""
    work.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, script, "--out", work, *map(str, more)], check=True)


def run_script(a, script, **variables):
    """Numbers by name, of the line `NAME key value key value ...` that in.NAME prints at its end."""
    command = [Path(a.lmp).resolve(), *a.flags.split(), "-in", script, "-log", "none"]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    with environment() as env:
        done = subprocess.run(command, cwd=a.work, env=env, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
    name = script.name.split(".", 1)[1]
    lines = re.findall(rf"^{name} (\S+ \S+(?: \S+ \S+)*)$", done.stdout, re.M)
    if done.returncode or not lines:
        raise SystemExit(done.stdout[-2000:])
    words = lines[-1].split()
    return dict(zip(words[::2], map(float, words[1::2])))


def run_scripts(a, script, cases):
    """The same for each of `cases`, dicts of LAMMPS variables; `a.at_once` of them side by side."""
    with concurrent.futures.ThreadPoolExecutor(a.at_once) as pool:
        return list(pool.map(lambda variables: run_script(a, script, **variables), cases))


def print_table(titles, rows):
    print("| " + " | ".join(titles) + " |")
    print("| " + " | ".join("---" for _ in titles) + " |")
    for row in rows:
        print("| " + " | ".join(row) + " |")


@contextlib.contextmanager
def plot(path, x, y):
    """Axes to draw in; x and y are their titles. Written to `path` at the end. Ends the program where there is no matplotlib."""
    try:
        import matplotlib
    except ImportError:
        raise SystemExit(f"{path} is not drawn, as matplotlib is missing: install it (Debian: python3-matplotlib)") from None
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
    yield axes
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    figure.savefig(path, dpi=120)
    print(path)
