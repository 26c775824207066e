# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run a script with one wall and with another, read what it dumped, compare."""
import os
import subprocess
from pathlib import Path

import numpy as np

from runs import ROOT, environment

DIAMETER = 0.003    # of the spheres in the scripts that are compared
LAWS = {
    "hooke": "hooke 2000 NULL 1700 NULL 0.3 1",
    "hooke/history": "hooke/history 2000 NULL 1700 NULL 0.3 1",
    "hertz/history": "hertz/history 8e6 NULL 1e7 NULL 0.3 1",
}


def mesh(path, words=""):
    """Script variables that put the mesh in the built-in wall's place."""
    return {"wall": "wall/lsdcd", "at": f"mesh {path} {words}"}


def run_script(script, folder, ranks=1, **variables):
    """Run `script` in `folder` with LAMMPS variables; the log goes to log.lammps there."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    lmp = os.environ.get("LSDCD_LMP", str(ROOT / "build/bin/lmp-lsdcd"))
    command = [lmp, "-in", str(Path(script).resolve()), "-screen", "none"]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    if ranks > 1:
        command = ["mpirun", "-np", str(ranks)] + command
    with environment() as env:
        result = subprocess.run(command, cwd=folder, env=env, stdin=subprocess.DEVNULL,
                                capture_output=True, text=True)
    if result.returncode:
        log = folder / "log.lammps"
        tail = log.read_text().splitlines()[-5:] if log.exists() else []
        raise SystemExit("\n".join([" ".join(command), *tail, result.stderr[-2000:]]))


def read_dump(path):
    """Steps and data[step, atom, column] of a text dump sorted by id."""
    steps, frames = [], []
    with open(path) as file:
        while file.readline():
            steps.append(int(file.readline()))
            file.readline()
            n = int(file.readline())
            for _ in range(5):
                file.readline()
            frames.append([[float(x) for x in file.readline().split()] for _ in range(n)])
    return np.array(steps), np.array(frames)


def read_thermo(path):
    """Rows of the last run's thermo output, as {column: array}."""
    rows, names = [], None
    for line in Path(path).read_text().splitlines():
        words = line.split()
        if words[:1] == ["Step"]:
            names, rows = words, []
        elif names and len(words) == len(names):
            try:
                rows.append([float(w) for w in words])
            except ValueError:
                pass
    table = np.array(rows)
    return {name: table[:, i] for i, name in enumerate(names)}


def largest_difference(a, b):
    """Largest |dF| over the largest |F|, and largest |dx| over DIAMETER.

    Columns of `a` and `b`: x y z fx fy fz, per step and atom.
    """
    size = np.linalg.norm(a[:, :, 3:6], axis=2).max()
    d_force = np.linalg.norm(a[:, :, 3:6] - b[:, :, 3:6], axis=2).max()
    d_place = np.linalg.norm(a[:, :, :3] - b[:, :, :3], axis=2).max()
    return d_force / size, d_place / DIAMETER


def distance(a, b):
    """Largest |dx| over DIAMETER at each dumped step."""
    return np.linalg.norm(a[:, :, :3] - b[:, :, :3], axis=2).max(axis=1) / DIAMETER
