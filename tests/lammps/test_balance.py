# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""A rotating drum with load balancing on 1 to 8 ranks: the same physics, no sphere lost, and every
contact that there is by brute force over all triangles. LSDCD_QUICK=1: on 1 and 4, in fewer steps."""

import numpy

import lmp
import drum
import stl
from facts import at_most, fact
from triangles import closest_on_triangle

RANKS = (1, 4) if lmp.QUICK else (1, 2, 4, 8)
STEPS, EVERY = 2300 if lmp.QUICK else 4000, 100
# Spheres fall for 1000 steps. Then every impact parts neighbouring paths by 1 + path / radius, at
# most 10: in 400 steps there are 6 at most. 10 for the sums of many.
ALIKE, GROWTH = 1400, 1e-16 * 10**6 * 10
ROWS = (f"dump rows all custom {EVERY} rows id radius x y z " + " ".join(f"f_wall[{k}]" for k in range(1, 9)) +
        "\ndump_modify rows format float %.17g sort id\n")
ROUNDING = 1e-12    # of places of size 5, some turned by sines and cosines of their own


def brute_force(at, rows):
    """Of every step in the dump: who touches, and with what force where it is at one place."""
    missed = false_ones = touching = single = 0
    wrong = 0.0
    for step, atoms in rows.items():
        table = numpy.array(list(atoms.values()))
        radius, x, count, force = table[:, 0], table[:, 1:4], table[:, 4], table[:, 5:8]
        points = numpy.stack([closest_on_triangle(x, *t)[0] for t in drum.turned(step * drum.DT)], 1)
        apart = numpy.linalg.norm(points - x[:, None, :], axis=-1)
        nearest = apart.argmin(1)
        least = apart[numpy.arange(len(x)), nearest]
        overlap = radius - least
        missed += int(((overlap > ROUNDING) & (count == 0)).sum())
        false_ones += int(((overlap < -ROUNDING) & (count > 0)).sum())
        touching += int((count > 0).sum())
        # All that is within the radius is one point, of as many triangles as share it.
        foot = points[numpy.arange(len(x)), nearest]
        same = numpy.linalg.norm(points - foot[:, None, :], axis=-1) < 1e-9
        one = (overlap > 1e-6) & (same | (apart > radius[:, None])).all(1)
        normal = (x - foot) / least[:, None]
        off = numpy.abs((force * normal).sum(-1) / drum.STIFFNESS - overlap)
        single += int(one.sum())
        wrong = max(wrong, off[one].max(initial=0), numpy.abs(count[one] - 1).max(initial=0))
    fact(f"{at}: spheres touch", touching > 200 and single > 150,
         f"{touching}, {single} at one place")
    fact(f"{at}: no contact is missed", missed == 0, str(missed))
    fact(f"{at}: none is false", false_ones == 0, str(false_ones))
    at_most(f"{at}: overlap by the normal force of those that touch at one place", wrong, ROUNDING)


def test_totals_and_rows(folder):
    stl.write(folder / "drum.stl", drum.triangles())
    n = drum.write_data(folder / "drum.data")
    alone = None
    for ranks in RANKS:
        at = f"{ranks} rank{'s' * (ranks > 1)}"
        balance = f"fix even all balance {EVERY // 2} 1.0 shift xz 10 1.02\nthermo {EVERY // 2}\n"
        text = lmp.run_well(drum.BEGIN + balance + ROWS + f'run {STEPS}\nprint "imbalance $(f_even)"\n',
                            folder, ranks)
        totals = numpy.array(lmp.read_thermo(text))
        fact(f"{at}: no sphere is lost", set(totals[:, 1]) == {n} and n > 300, str(n))
        at_most(f"{at}: most on a rank over the mean", float(text.split("\nimbalance ")[1].split()[0]), 2)
        brute_force(at, lmp.read_dump(folder / "rows"))
        if alone is None:
            alone = totals
            continue
        apart = numpy.abs(totals - alone) / numpy.abs(alone).max(0)
        at_most(f"{at}: totals as on one", apart[totals[:, 0] <= ALIKE].max(), GROWTH)
