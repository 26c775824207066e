# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""fix wall/lsdcd/kk in a LAMMPS with atoms in float (KOKKOS_PREC mixed or single).

LSDCD_HOST and LSDCD_HOST_PLUGIN name that LAMMPS and its plugin, LSDCD_DOUBLE_HOST and LSDCD_DOUBLE_PLUGIN
one with atoms in double. Contacts and forces are computed in double from the positions given, so that

- forces on the same positions are those of the other LAMMPS, but for their own rounding;
- trajectories are those of the plain fix in the same LAMMPS, which gets the same positions.
"""

import math
import os
import random
import re
import struct
import subprocess

import pytest

import lmp
import scene
import stl
from facts import at_most, fact
from test_kokkos import plain_among_kokkos

SPHERES = int(os.environ.get("LSDCD_SPHERES", 400))    # on the same positions
ROUNDS = 2.0**-24    # what a number loses in float, as a share of it
DOUBLE = (os.environ.get("LSDCD_DOUBLE_HOST", "") and os.environ["LSDCD_DOUBLE_HOST"] + "/lmp",
          os.environ.get("LSDCD_DOUBLE_PLUGIN", ""))
FLOAT = (lmp.HOST, lmp.PLUGIN)
pytestmark = pytest.mark.skipif(not (all(FLOAT) and all(DOUBLE)), reason="no LAMMPS with Kokkos in float beside one in double "
                                "(tests/lammps/hosts/build_host.sh single)")
HISTORY = "hooke/history 1e4 NULL 120 NULL 0.4 1"
# A share of the largest value of each column. The plain fix has radii and masses in double, 6e-8 of them apart, and contacts make
# such differences larger: up to 4e-5 was seen.
LIMIT = 1e-3
LAWS = {"hooke": "hooke 1e4 NULL 5 NULL 0.5 1", "hooke/history": HISTORY,
        "hertz/history": "hertz/history 1e5 NULL 50 NULL 0.5 1", "granular jkr": scene.GRANULAR}


def on(host, *args, **kwargs):
    """lmp.run in one of the two hosts."""
    own, (lmp.HOST, lmp.PLUGIN) = (lmp.HOST, lmp.PLUGIN), host
    try:
        return lmp.run(*args, host=True, **kwargs)
    finally:
        lmp.HOST, lmp.PLUGIN = own


def on_well(host, text, folder, **kwargs):
    done = on(host, text, folder, **kwargs)
    if done.returncode:
        raise AssertionError(f"script failed with {done.returncode}:\n{done.stdout[-4000:]}")
    return done.stdout


def as_float(number):
    return struct.unpack("f", struct.pack("f", number))[0]


def facet_height(x, y):
    """The height of the sheet of scene.write_floor(), of squares with a side of 0.5 from -6.5 on."""
    (i, u), (j, v) = (divmod((a + 6.5) / 0.5, 1) for a in (x, y))
    a, b, c, d = (scene.floor_height(-6.5 + 0.5 * (i + k), -6.5 + 0.5 * (j + m)) for k, m in ((0, 0), (1, 0), (1, 1), (0, 1)))
    return a + u * (b - a) + v * (c - b) if v <= u else a + v * (d - a) + u * (c - d)


def write_spheres(path, side):
    """Side by side, over the sheet and up to 4 % of their radius in it, with numbers that float has as they are. Returns
    the largest diameter."""
    rng = random.Random(4711)
    atoms, velocities = [], []
    for i in range(side * side):
        x, y = (-5 + 10 * (k + 0.5 * rng.random()) / side for k in (i % side, i // side))
        diameter = as_float(rng.choice((0.4, 0.36)) * 20 / side)
        z = facet_height(x, y) + diameter / 2 * (1.01 - 0.05 * rng.random())
        place = " ".join(f"{as_float(a)!r}" for a in (x, y, z))
        atoms.append(f"{i + 1} 1 {diameter!r} 2.0 {place}")
        velocities.append(f"{i + 1} " + " ".join(f"{as_float(rng.uniform(-1, 1))!r}" for _ in range(6)))
    path.write_text(f"spheres\n\n{len(atoms)} atoms\n1 atom types\n\n-6 6 xlo xhi\n-6 6 ylo yhi\n-1.5 8 zlo zhi\n\n"
                    "Atoms # sphere\n\n" + "\n".join(atoms) + "\n\nVelocities\n\n" + "\n".join(velocities) + "\n")
    return 8.0 / side


def prepare(folder):
    scene.write_floor(folder / "floor.stl")
    stl.write(folder / "flat.stl", stl.square(4))


def test_same_positions(folder):
    """Masses are rounded on the way in and forces on the way out: 1.2e-7 where they do not cancel."""
    side = math.isqrt(SPHERES)
    largest = write_spheres(folder / "spheres.data", side)
    for name, law in LAWS.items():
        text = scene.SETTINGS + f"""\
read_data       spheres.data
neighbor        {0.3 * largest} bin
pair_style      zero {1.2 * largest}
pair_coeff      * *
fix             move all nve/sphere
fix             wall all wall/lsdcd {law} mesh floor.stl
dump            forces all custom 1 forces id fx fy fz tqx tqy tqz
dump_modify     forces format float %.17g sort id
run             0
"""
        dumps = []
        for host in (DOUBLE, FLOAT):
            on_well(host, text, folder)
            dumps.append(lmp.read_dump(folder / "forces"))
        touching = sum(any(row) for row in dumps[0][0].values())
        fact(f"{name}: most spheres touch", touching > side * side / 2, str(touching))
        apart = lmp.largest_difference(*dumps)
        at_most(f"{name}: forces on the same positions as in double", apart, 1e-6)
        fact(f"{name}: and not to the last bit", apart > 0)


def test_as_the_plain_fix(folder):
    """The plain fix adds to the forces in double, which are rounded then; so do we, whatever else moves, sorts and
    exchanges atoms."""
    turning = "mesh floor.stl motion wiggle 0 0 0.05 0.4"
    two = "mesh floor.stl motion rotate 0 0 0 0 0 1 9 mesh bar.stl"
    stl.write(folder / "bar.stl", stl.quad((-6, -1, 0.6), (6, -1, 0.6), (6, 1, 0.6), (-6, 1, 0.6)))
    cases = [(name, law, "mesh floor.stl", 1) for name, law in LAWS.items()]
    cases += [("a mesh that moves", HISTORY, turning, 1), ("two meshes", HISTORY, two, 1), ("2 ranks", HISTORY, two, 2),
              ("forces set before", HISTORY, "mesh floor.stl", 1)]
    for name, law, mesh, ranks in cases:
        text = scene.CREATE + scene.forces(law, mesh) + scene.dump("moves", 100) + "run 600\n"
        if name == "forces set before":
            text = re.sub(r"(?=^fix +wall )", "fix pushes all setforce 0.0 0.0 -4.0\n", text, flags=re.M)
        if mesh == two:
            text = text.replace("neigh_modify    delay 0 every 1", "neigh_modify    delay 0 every 2")
        dumps = []
        for script in (text, plain_among_kokkos(text)):
            on_well(FLOAT, script, folder, ranks=ranks)
            dumps.append(lmp.read_dump(folder / "moves"))
        touching = sum(row[9] > 0 for rows in dumps[0].values() for row in rows.values())
        fact(f"{name}: spheres touch", touching > 5, str(touching))
        at_most(f"{name}: as the plain fix in the same LAMMPS", lmp.largest_difference(*dumps), LIMIT)


# A sphere of mass 1 falls on a plane at z = 0, in a box that reaches to 8 from 0. It was put 1e-4 above it.
ONE_SPHERE = lmp.head("-3 3 -3 3 -1 8") + """\
create_atoms    1 single 0.3 0.2 0.5001 units box
set             atom 1 diameter 1.0 density 1.9098593171027443
velocity        all set 0 0 -{speed}
pair_style      zero 1.2
pair_coeff      * *
fix             move all nve/sphere
fix             wall all wall/lsdcd hooke {stiff} NULL {damping} NULL 0 1 mesh flat.stl
timestep        {dt}
run             {steps}
print           "speed $(vcm(all,z):%.17g)"
"""


def test_rebound(folder):
    """The sphere leaves the floor as in double. Each of n steps rounds its speed twice, by at most 2^-24, and its height
    of 0.5, by e = 3e-8; over half a period of the contact the latter change the speed by pi e / d of it, with the deepest
    overlap d = v sqrt(m / k) = 0.01."""
    n = 400
    text = ONE_SPHERE.format(speed=1, stiff="1e4", damping=30, dt="1e-4", steps=n)
    speeds = [float(re.findall(r"^speed (\S+)", on_well(host, text, folder), re.M)[-1]) for host in (DOUBLE, FLOAT)]
    fact("the sphere leaves the floor", 0.1 < speeds[0] < 0.9, str(speeds[0]))
    at_most("its speed is that in double", abs(speeds[1] - speeds[0]),
            2 * n * ROUNDS + math.pi * 0.5 * ROUNDS / 0.01)


def test_words(folder):
    """At 8 from 0 float rounds by 4.8e-7. With v = 2 the sphere goes 2 sqrt(1 / k) deep: 0.02 for k = 1e4, of which that is
    0.002 %, and 2e-5 for k = 1e10, of which it is 2.4 %."""
    for name, stiff, dt, deepest in (("soft", "1e4", "1e-4", 0.02), ("stiff", "1e10", "1e-6", 2e-5)):
        text = ONE_SPHERE.format(speed=2, stiff=stiff, damping=0, dt=dt, steps=400)
        said = on_well(FLOAT, text + "run 10\nrun 10\n", folder)
        line = re.search(r"atoms are in float.* positions up to 8 from 0 are rounded by up to (\S+), which is 1 % of an overlap "
                         r"of (\S+), and an atom there that is slower than (\S+) stands still;", said)
        fact(f"{name}: the log says once what float positions cost", said.count("atoms are in float") == 1 + (deepest < 1e-3) and
             line and abs(float(line[1]) / 2**-21 - 1) < 1e-5 and abs(float(line[2]) / 2**-21 / 100 - 1) < 1e-5 and abs(float(line[3]) * float(dt) / 2**-21 - 1) < 1e-5,
             str(line and line.groups()))
        warned = re.findall(r"WARNING.*atoms are in float.* by up to \S+: (\S+) % of the deepest overlap of this run, (\S+), ", said)
        fact(f"{name}: {'one warning' if deepest < 1e-3 else 'no warning'}", len(warned) == (deepest < 1e-3), str(warned))
        # Among some thirty steps of a contact one is nearest to the deepest point, by half a step: 0.5 (pi / 60)^2 short of it.
        for share, overlap in warned:
            at_most("its overlap is that of the run", abs(float(overlap) / deepest - 1), 0.01)
            at_most("its share is that of the overlap", abs(float(share) / 100 * float(overlap) / 2**-21 - 1), 1e-4)
    said = on_well(DOUBLE, text, folder)
    fact("in double the log says nothing of it", "in float" not in said)


def test_refusals(folder):
    """A plugin in a LAMMPS of another precision: one sentence, and LAMMPS goes on."""
    named = {host: subprocess.run([host[0], "-help"], stdout=subprocess.PIPE, text=True, env=lmp.environment()).stdout
             for host in (DOUBLE, FLOAT)}
    precision = {host: re.search(r"KOKKOS package precision: (\w+)", text).group(1) for host, text in named.items()}
    fact("one LAMMPS is in double, the other not",
         precision[DOUBLE] == "double" and precision[FLOAT] in ("mixed", "single"), str(sorted(precision.values())))
    for host, other in ((DOUBLE, FLOAT), (FLOAT, DOUBLE)):
        done = on((host[0], other[1]), "print 'LAMMPS goes on'\n", folder)
        said = [line for line in done.stdout.splitlines() if "not loaded" in line]
        fact(f"LAMMPS in {precision[host]} refuses the plugin for {precision[other]}, and goes on",
             done.returncode == 0 and "LAMMPS goes on" in done.stdout and len(said) == 1 and
             f"in precision {precision[other]}, this LAMMPS has no KOKKOS package in precision {precision[other]}. "
             "Rebuild it" in said[0], f"exit status {done.returncode}, {' '.join(said) or done.stdout[-300:]}")
