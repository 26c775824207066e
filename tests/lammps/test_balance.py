# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""A rotating drum with load balancing on 1 to 8 ranks: the same physics, no sphere lost, and every
contact that there is by brute force over all triangles. LSDCD_QUICK=1: on 1 and 4, in fewer steps.

Then all that is kept of grains and pairs goes to another process each tenth step: springs of pairs and of the wall, with what both
dissipate, insertion and mass flow. LSDCD_QUICK=1: on 2 and 3."""

import itertools

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


# ---- balance in each tenth step ------------------------------------------------------------

# Grains that overlap from the first step on, in the lower half of the drum, under an inlet; others pass the plane of the mass flow.
LIFE_STEPS = 150
LAW_OF_GRAINS = "hooke 2e4 60 tangential linear_history 1e4 1 0.5 damping mass_velocity rolling sds 5e3 20 0.1"
LIFE = drum.BEGIN.replace("pair_style      gran/hooke/history", "pair_style      granular/lsdcd #").replace(
    "pair_coeff      * *", f"pair_coeff      * * {LAW_OF_GRAINS}").replace(
    f"wall/lsdcd {drum.LAW}", f"wall/lsdcd granular {LAW_OF_GRAINS}").replace(" contacts\n", " contacts energy\n")
MEASURED = f"""\
region upper block INF INF INF INF 0 INF
delete_atoms region upper compress no
velocity all set 0.1 0 -3
fix in all insert/lsdcd mesh inlet.stl massrate 40 diam poly 2 0.4 0.5 0.5 0.5 dens 2 type 1 vel normal 2 seed 11
fix flow all massflow/lsdcd mesh plane.stl
fix_modify wall names wall all
compute grains all lsdcd/energy
thermo_style custom step atoms ke f_wall[1] f_wall[2] f_wall[3] f_wall[7] f_in[1] f_in[2] f_flow[*] c_grains[*] &
             v_wall_dissipated_damping v_wall_dissipated_slider v_wall_dissipated_rolling v_wall_drive_work
thermo_modify norm no format float %.17g
thermo 10
dump rows all custom {LIFE_STEPS} life id x y z vx vy vz omegax omegay omegaz
dump_modify rows format float %.17g sort id
run {LIFE_STEPS}
"""
BY = {"shift": "shift xz 10 1.01", "rcb": "rcb"}
# Sums in another order part paths by 1e-16 of the largest forces; a contact of 15 steps lets that grow by less than 10, and none has more
# than five in the run.
SAME = 1e-10


def life(folder, ranks, how=None):
    """Thermo rows and the last dump: of one life, with balance in each tenth step by `how`."""
    begin = LIFE.replace("comm_style brick", "comm_style tiled") if how == "rcb" else LIFE
    balance = f"fix even all balance 10 1.0 {BY[how]}\n" if how else ""
    text = lmp.run_well(begin + balance + MEASURED, folder, ranks)
    dump = lmp.read_dump(folder / "life")
    return numpy.array(lmp.read_thermo(text)), dump[LIFE_STEPS]


def test_lives_with_balance(folder):
    stl.write(folder / "drum.stl", drum.triangles())
    stl.write(folder / "inlet.stl", [t[::-1] for t in stl.square(1.0, 2.0)])
    stl.write(folder / "plane.stl", stl.square(4.5, -0.75))
    drum.write_data(folder / "drum.data", spacing=0.69)
    alone, grains = life(folder, 1)
    touching, inserted, passed = alone[:, 6].max(), alone[-1, 7], alone[-1, 11]
    fact("grains touch the wall, come, and pass the plane", min(touching, inserted, passed) > 5, f"{touching}, {inserted}, {passed}")
    for ranks, how in ((2, "shift"), (3, "rcb")) if lmp.QUICK else itertools.product((1, 2, 4, 8), BY):
        rows, same = life(folder, ranks, how)
        at = f"{ranks} ranks, {how}"
        fact(f"{at}: the same grains", set(same) == set(grains), f"{len(same)}, {len(grains)}")
        size = numpy.maximum(numpy.abs(alone).max(0), 1)    # some cancel to what rounding of larger ones leaves
        at_most(f"{at}: totals, energies, insertion and mass flow as on one", (numpy.abs(rows - alone) / size).max(), SAME)
        at_most(f"{at}: grains as on one", lmp.largest_difference({0: grains}, {0: same}), SAME)
