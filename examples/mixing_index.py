#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Print Lacey's mixing index of each snapshot of LAMMPS dumps: 0 where marked grains are apart from the others, 1 where they are mixed at random.

The grains are counted in cubic cells. With the share p of marked grains in all, and p_i of the n_i grains of cell i, the variance is
s^2 = sum n_i (p_i - p)^2 / N. It is s0^2 = p (1 - p) where each cell has grains of one kind, and on average sR^2 = s0^2 (K - 1) / (N - 1) where N grains
are dealt to K cells at random. The index is (s0^2 - s^2) / (s0^2 - sR^2) (Lacey, J. Appl. Chem. 4, 1954, p. 257). It depends on the cell: give some
dozen grains to each, and the same to all runs that you compare.

  python3 mixing_index.py grains.txt --cell 0.01 --type 2
  python3 mixing_index.py grains.txt --cell 0.01 --side x 0

The dumps are text, with the columns id, x, y, z, and for --type also type: dump ID all custom N FILE id type x y z.
"""
import argparse
import sys
from pathlib import Path

import numpy as np


def snapshots(path):
    """Yield step and columns, as {name: numbers}, of each whole snapshot of a text dump."""
    with open(path) as file:
        while True:
            head = [file.readline() for _ in range(9)]
            if not head[-1]:
                return
            if not head[0].startswith("ITEM: TIMESTEP") or not head[8].startswith("ITEM: ATOMS"):
                raise SystemExit(f"{path}: this is no text dump of LAMMPS (dump ID all custom N FILE id type x y z)")
            names, n = head[8].split()[2:], int(head[3])
            rows = [file.readline().split() for _ in range(n)]
            if any(len(row) != len(names) for row in rows):
                return    # the run goes on, or has been stopped
            lacking = {"id", "x", "y", "z"} - set(names)
            if lacking:
                raise SystemExit(f"{path}: there is no column {sorted(lacking)[0]}: write dump ID all custom N FILE id type x y z")
            yield int(head[1]), {name: np.array([float(row[k]) for row in rows]) for k, name in enumerate(names) if name in KEPT}


KEPT = ("id", "type", "x", "y", "z")


def lacey(place, marked, cell):
    """Lacey's index, and the grains of a cell on average.

    place: (N, 3), lengths; marked: (N,), of truth values; cell: side of a cell, a length. The index is not a number where all grains or none are
    marked, or all are in one cell each."""
    keys = np.floor(place / cell).astype(np.int64)
    of = np.unique(keys, axis=0, return_inverse=True)[1].ravel()
    n_in = np.bincount(of)
    share = np.bincount(of, weights=marked) / n_in
    n, n_cells, p = len(place), len(n_in), marked.mean()
    apart = p * (1 - p)
    if n <= n_cells or apart == 0:
        return float("nan"), n / n_cells
    variance = (n_in * (share - p)**2).sum() / n
    return (apart - variance) / (apart - apart * (n_cells - 1) / (n - 1)), n / n_cells


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("dumps", nargs="+", type=Path)
    p.add_argument("--cell", type=float, required=True, help="side of a cell")
    which = p.add_mutually_exclusive_group(required=True)
    which.add_argument("--type", type=int, action="append", help="marked are the grains of this atom type; may be repeated")
    which.add_argument("--side", nargs=2, metavar=("AXIS", "AT"), help="marked are the grains that in the first snapshot are below this place along x, y or z")
    a = p.parse_args()
    if not a.cell > 0:
        p.error("--cell must be above 0")
    if a.side and a.side[0] not in ("x", "y", "z"):
        p.error(f"--side is along x, y or z, not {a.side[0]}")
    ids = None
    print("# step index grains marked grains_in_a_cell")
    for path in a.dumps:
        for step, rows in snapshots(path):
            if a.side and ids is None:
                ids = rows["id"][rows[a.side[0]] < float(a.side[1])]
            if a.type and "type" not in rows:
                raise SystemExit(f"{path}: there is no column type, which --type needs")
            if not len(rows["id"]):
                continue
            marked = np.isin(rows["id"], ids) if a.side else np.isin(rows["type"], a.type)
            index, in_cell = lacey(np.column_stack([rows[k] for k in "xyz"]), marked, a.cell)
            print(f"{step} {index:.6g} {len(marked)} {marked.sum()} {in_cell:.4g}")


if __name__ == "__main__":
    sys.exit(main())
