# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Stress and wear of the triangles: files, totals, ranks and restart."""

import math

import lmp
import scene
import stl
import vtp
from facts import at_most, fact

LAW = "hooke/history 1e4 NULL 120 NULL 0.4 1"
FIRST, SECOND = 300, 400
ON_RANKS = 1e-12    # sums of the same numbers in another order


def apart(a, b, name):
    return max(abs(x - y) for x, y in zip(a[name], b[name])) / max(map(abs, a[name]))


def test_loads(folder):
    scene.write_floor(folder / "floor.stl")
    with_loads = "mesh floor.stl wear archard 0.001 50 mesh_fields {} every 100"

    def forces(name, more=""):
        return scene.forces(LAW, mesh=with_loads.format(name), more=more)

    def go(name, ranks=1, begin=scene.CREATE, steps=FIRST + SECOND, last=""):
        thermo = ("thermo_style custom step f_wall[3] f_wall[7] f_wall[10] "
                  "f_wall[1] f_wall[2]\n"
                  "thermo_modify norm no format float %.17g\nthermo 1\n")
        text = lmp.run_well(begin + forces(name, thermo) + f"run {steps}\n" + last, folder, ranks)
        return lmp.read_thermo(text)

    rows = go("one_*.vtp")
    fields = {s: vtp.read(folder / f"one_{s}.vtp") for s in range(100, FIRST + SECOND + 1, 100)}
    last = fields[FIRST + SECOND]
    fact("a file every 100 steps, none at the start", not (folder / "one_0.vtp").exists())
    fact("a value for every triangle", len(last["worn_volume"]) == 2 * 26 * 26)
    fact("the floor has worn", rows[-1][3] > 0, f"{rows[-1][3]:.3g}")
    at_most("worn volumes sum to the fix's tenth number",
            abs(sum(last["worn_volume"]) / rows[-1][3] - 1), ON_RANKS)
    at_most("contacts average to the mean of the fix's seventh number",
            abs(sum(last["contacts"]) / (sum(r[2] for r in rows[-100:]) / 100) - 1), ON_RANKS)
    mean = [sum(r[k] for r in rows[-100:]) / 100 for k in (4, 5, 1)]
    at_most("forces sum to the mean of the fix's first three numbers",
            max(abs(sum(last["force"][d::3]) / mean[d] - 1) for d in range(3)), ON_RANKS)

    go("two_*.vtp", ranks=2)
    for name in ("worn_volume", "normal_stress", "shear_stress", "contacts", "force"):
        at_most(f"{name} on 2 ranks", apart(last, vtp.read(folder / f"two_{FIRST + SECOND}.vtp"), name),
                1e-9)

    # A run in two pieces, in one input and through a file, in the middle of an average.
    half = FIRST + 50
    go("a_*.vtp", steps=half, last=f"write_restart half.restart\nrun {SECOND - 50}\n")
    for ranks in (1, 2):
        rows = go("b_*.vtp", ranks, scene.SETTINGS + "read_restart half.restart\n", SECOND - 50)
        for step in (FIRST + 100, FIRST + SECOND):
            a, b = (vtp.read(folder / f"{x}_{step}.vtp") for x in "ab")
            for name in ("worn_volume", "normal_stress", "contacts", "force"):
                at_most(f"{name} at {step}, continued on {ranks}", apart(a, b, name),
                        0 if ranks == 1 else 1e-9)

    scene.write_floor(folder / "floor.stl", cells=4)
    text = lmp.run_well(scene.SETTINGS + "read_restart half.restart\n" + forces("c_*.vtp") +
                        "run 10\n", folder)
    fact("another mesh: loads begin at zero, with a warning", "begin at zero" in text)
    scene.write_floor(folder / "floor.stl", side=6.49)
    text = lmp.run_well(scene.SETTINGS + "read_restart half.restart\n" + forces("c_*.vtp") +
                        "run 10\n", folder)
    fact("also of one with as many triangles", "begin at zero" in text)


# Diameter, place and velocity; the third is slower than the threshold.
GRAINS = [(1.0, (-2.2, -1.7, 0.6), (1.1, 0.3, -1.4)), (0.6, (1.3, 0.8, 0.5), (0, 0, -2.0)), (0.8, (2.1, -2.4, 0.42), (0.5, 0, -0.2)),
          (0.8, (-1.6, 2.3, 0.7), (-0.4, 1.6, -0.9))]
E90, HARDNESS, N1, N2, K2, K3, SPEED, DIAMETER, LEAST = 3e-4, 1.2, 0.73, 2.0, 2.3, 0.19, 5.0, 0.3, 0.5
MESH_MOVES = (0.2, -0.1, 0.05)


def worn_by(diameter, velocity):
    """The formula of Oka, Okamura and Yoshida (2005), of grains of the density 2 against the mesh that moves."""
    vx, vy, vz = (v - w for v, w in zip(velocity, MESH_MOVES))
    v = math.sqrt(vx**2 + vy**2 + vz**2)
    sine = -vz / v
    mass = 2.0 * math.pi / 6 * diameter**3
    return E90 * mass * sine**N1 * (1 + HARDNESS * (1 - sine))**N2 * (v / SPEED)**K2 * (diameter / DIAMETER)**K3 * (-vz > LEAST)


def test_oka(folder):
    stl.write(folder / "floor.stl", stl.sheet(26, lambda i, j: (i / 2 - 6.5, j / 2 - 6.5, 0)))
    place = "".join(f"create_atoms 1 single {x} {y} {z} units box\n" for _, (x, y, z), _ in GRAINS)
    move = "".join(f"set atom {k} diameter {d} density 2.0\ngroup g{k} id {k}\nvelocity g{k} set {vx} {vy} {vz} units box\n"
                   for k, (d, _, (vx, vy, vz)) in enumerate(GRAINS, 1))
    begin = lmp.head(modify="map array") + f"region box {scene.BOX}\ncreate_box 1 box\n" + place + move
    wall = ("fix wall all wall/lsdcd hooke/history 1e5 NULL 0 NULL 0.3 1 mesh floor.stl motion linear " + " ".join(map(str, MESH_MOVES)) +
            f" wear oka {E90} {HARDNESS} {N1} {N2} {K2} {K3} {SPEED} {DIAMETER} {LEAST}")
    run = lmp.pairs("zero 1.2") + "fix move all nve/sphere\ntimestep 1e-3\n" + wall + "\nthermo_style custom step f_wall[10]\n" \
        "thermo_modify norm no format float %.17g\nthermo 10\nrun {}\n"
    exact = sum(worn_by(d, v) for d, _, v in GRAINS)
    for ranks in (1, 2):
        worn = lmp.read_thermo(lmp.run_well(begin + run.format(500), folder, ranks))
        at_most(f"worn by three impacts of four, on {ranks}", abs(worn[-1][1] / exact - 1), 1e-12)
    lmp.run_well(begin + run.format(150) + "write_restart half.restart\n", folder)
    worn = lmp.read_thermo(lmp.run_well(lmp.head(modify="map array") + "read_restart half.restart\n" + run.format(350), folder))
    fact("some had struck before the restart", 0 < worn[0][1] < worn[-1][1])
    at_most("continued", abs(worn[-1][1] / exact - 1), 1e-12)
