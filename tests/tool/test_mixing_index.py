# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""examples/mixing_index.py: Lacey's index of grains whose variance is known. 8 cells have 10 grains each."""
import pathlib
import random
import subprocess
import sys

from facts import at_most, fact

SCRIPT = pathlib.Path(__file__).resolve().parent.parent.parent / "examples" / "mixing_index.py"
CELLS = [(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
PLACES = [[c + 0.05 + 0.09 * n for c in cell] for cell in CELLS for n in range(10)]


def dump(*snapshots, columns="id type x y z"):
    """Text of snapshots, rows of types in the order of PLACES."""
    head = "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n0 2\n0 2\n0 2\nITEM: ATOMS " + columns + "\n"
    return "".join(head.format(step, len(kinds)) +
                   "".join(f"{n + 1} {kind} {x} {y} {z}\n" for n, (kind, (x, y, z)) in enumerate(zip(kinds, PLACES)))
                   for step, kinds in enumerate(snapshots))


def run(folder, text, *words):
    (folder / "grains.txt").write_text(text)
    return subprocess.run([sys.executable, SCRIPT, "grains.txt", *words], cwd=folder, text=True, capture_output=True, check=False)


def indices(folder, text, *words):
    done = run(folder, text, *words)
    return [float(line.split()[1]) for line in done.stdout.splitlines()[1:]]


def test_known(folder):
    halves = [1 + (x > 1) for x, _, _ in PLACES]
    even = [1 + n % 2 for n in range(80)]
    fact("halves are apart: 0", indices(folder, dump(halves), "--cell", "1", "--type", "2") == [0])
    # No variance at all is less than that of chance, p (1 - p) 7 / 79.
    at_most("the same share in each cell", abs(indices(folder, dump(even), "--cell", "1", "--type", "2")[0] - 79 / 72), 1e-5)
    shares = [[1 + (n % 10 < 2 + 6 * (n // 10 % 2)) for n in range(80)]]    # 0.2 and 0.8 in turn: a variance of 0.09 about 0.5
    at_most("shares of 0.2 and 0.8", abs(indices(folder, dump(*shares), "--cell", "1", "--type", "2")[0] - 0.16 / 0.25 * 79 / 72), 1e-5)
    one = run(folder, dump([1] * 80), "--cell", "1", "--type", "2").stdout
    fact("no grain is marked: no number", one.splitlines()[1] == "0 nan 80 0 10", one)


def test_dealt_at_random(folder):
    """The mean is 1. The variance of a cell of 10 has that of about chi^2 of 7: the index a deviation of 72 / 79 sqrt(2 / 7) x 7 / 72 = 0.05."""
    deal = random.Random(5)
    kinds = [1] * 40 + [2] * 40
    snapshots = []
    for _ in range(200):
        deal.shuffle(kinds)
        snapshots.append(list(kinds))
    found = indices(folder, dump(*snapshots), "--cell", "1", "--type", "2")
    at_most("mean of 200 deals, off 1", abs(sum(found) / 200 - 1), 5 * 0.06 / 200**0.5)


def test_side(folder):
    """Marked are the grains that were below in the first snapshot, wherever they are later."""
    first = dump([1] * 80)
    moved = dump([1] * 80).replace("TIMESTEP\n0", "TIMESTEP\n9")
    lines = moved.splitlines()
    lines[9:] = [" ".join([str((n * 7) % 80 + 1), *line.split()[1:]]) for n, line in enumerate(lines[9:])]
    rows = run(folder, first + "\n".join(lines) + "\n", "--cell", "1", "--side", "x", "1").stdout.splitlines()[1:]
    fact("0, then mixed, of the same 40", rows[0] == "0 0 80 40 10" and rows[1].split()[0] == "9" and rows[1].split()[3] == "40" and
         float(rows[1].split()[1]) > 0.8, str(rows))


def test_files_that_are_not_whole(folder):
    fact("a snapshot that is cut off is left out", len(indices(folder, dump([1, 2] * 40, [1, 2] * 40)[:-200], "--cell", "1", "--type", "2")) == 1)
    fact("no dump", "this is no text dump" in run(folder, "hello\n" * 20, "--cell", "1", "--type", "1").stderr)
    fact("a column is missing", "there is no column type" in run(folder, dump([1] * 80, columns="id kind x y z"), "--cell", "1", "--type", "1").stderr)
