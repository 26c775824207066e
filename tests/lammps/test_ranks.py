# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""One script on 1, 2 and 4 ranks gives the same trajectory, springs included.

Spheres that touch only the wall: forces do not depend on the order of atoms, so
the numbers are equal to the last bit, through migration and sorting. Fix balance
takes positions to box coordinates and back, which rounds them. LSDCD_QUICK=1 takes one law.
"""

import os
import re

import pytest

import lmp
import scene
from facts import at_most, fact

LAWS = {"hooke": "hooke 1e4 NULL 120 NULL 0.4 1",
        "hooke_history": "hooke/history 1e4 NULL 120 NULL 0.4 1",
        "hertz_history": "hertz/history 1e5 NULL 1500 NULL 0.4 1",
        "granular": scene.GRANULAR}
TOTALS = ("thermo_style custom step f_wall f_wall[1] f_wall[2] f_wall[3] f_wall[4] f_wall[5] "
          "f_wall[6] f_wall[7] f_wall[8] f_wall[9]\nthermo_modify format float %.15g norm no\nthermo 100\n")
BALANCE = "fix even all balance 100 1.02 shift xy 10 1.02\n"


def go(law, folder, ranks, more="", steps=1200):
    text = lmp.run_well(scene.SETTINGS + "read_data start.data\n" + scene.forces(law, more=more) + TOTALS +
                        scene.dump("moves", 100) + f"run {steps}\n", folder, ranks)
    return lmp.read_dump(folder / "moves"), lmp.read_thermo(text), text


def prepare(folder):
    scene.write_floor(folder / "floor.stl")
    # The order of create_atoms and the sums of velocity depend on the ranks.
    lmp.run_well(scene.CREATE + "write_data start.data\n", folder)


def test_ranks(folder):
    for name, law in lmp.sample(LAWS).items():
        one, sums, _ = go(law, folder, 1)
        fact(f"{name}: spheres touch", max(row[8] for row in sums) > 20)
        for ranks, more in ((2, ""), (4, ""), (4, BALANCE)):
            many, many_sums, text = go(law, folder, ranks, more)
            where = f"{name}: {ranks} ranks{' balanced' if more else ''}"
            # Positions are rounded to 1e-15, which a stiffness of 1e4 makes 1e-11 of forces, beside 100 to 800. Such a part of 1e-13
            # grows where spheres hop from bump to bump: 1e3 in 1200 steps at most.
            at_most(f"{where}: same trajectory", lmp.largest_difference(one, many),
                    1e-10 if more else 0)
            # Totals are added in another order.
            size = [max(abs(row[k]) for row in sums) or 1 for k in range(len(sums[0]))]
            apart = max(abs(a - b) / s for u, v in zip(sums, many_sums)
                        for a, b, s in zip(u, v, size))
            at_most(f"{where}: same totals", apart, 1e-10 if more else 1e-12)
            fact(f"{where}: one grid per node", "one copy per node" in text)


@pytest.mark.skipif(lmp.ON_HOST, reason="the preloaded module is of the LAMMPS that is installed")
def test_room_of_other_fixes(folder):
    """Bisections send atoms in messages with room for what the one fix with the largest maxexchange packs: ours asks for that of all."""
    more = "fix flow all massflow/lsdcd mesh floor.stl move 0 0 0.3\ncomm_style tiled\nfix even all balance 20 1.0 rcb\n"
    for law in ("hooke", "granular"):
        text = scene.SETTINGS + "read_data start.data\n" + scene.forces(LAWS[law], more=more) + "run 400\n"
        out = lmp.run_well(text, folder, 2, env={"LD_PRELOAD": os.environ["LSDCD_EXCHANGE_ROOM"]})
        rooms = [tuple(map(int, row)) for row in re.findall(r"room for (\d+), packed (\d+)", out)]
        fact(f"{law}: all fixes find room for what they pack", len(rooms) > 10 and max(packed for _, packed in rooms) > 10 and
             all(packed <= room for room, packed in rooms), rooms[:20])


@pytest.mark.skipif(lmp.ON_HOST, reason="the preloaded module is of the LAMMPS that is installed")
def test_room_between_runs(folder):
    """A command that sends atoms between runs finds room for the contacts that are there, and not for the most that an atom may have."""
    text = scene.SETTINGS + "read_data start.data\n" + scene.forces(LAWS["granular"]) + "run 400\nbalance 1.0 shift x 10 1.0\nrun 0\nbalance 1.0 rcb\n"
    out = lmp.run_well(text.replace("read_data", "comm_style tiled\nread_data"), folder, 2, env={"LD_PRELOAD": os.environ["LSDCD_EXCHANGE_ROOM"]})
    rooms = [tuple(map(int, row)) for row in re.findall(r"room for (\d+), packed (\d+)", out)]
    most = max(packed for _, packed in rooms)
    fact("atoms have contacts", most > 10, str(rooms))
    fact("there is room, and for no more than the atom with most contacts", all(packed <= room <= most + 3 for room, packed in rooms), str(rooms))
