# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Plates, six of them as a box, and scripts with spheres among them."""

import lmp
import stl

SIDE = 3.0
LAWS = {"hooke": "hooke 1e5 NULL 20 NULL 0.5 1",
        "hooke_history": "hooke/history 1e5 NULL 20 NULL 0.5 1",
        "hertz_history": "hertz/history 1e6 NULL 200 NULL 0.5 1"}
SMOOTH = "hooke 1e4 NULL 0 0 0 0"
FACES = {f"{'xyz'[d]}{side}": (d, (-1 if side == "lo" else 1) * SIDE)
         for d in range(3) for side in ("lo", "hi")}

CREATE = lmp.head("{box}", boundary="{boundary}", types="{types}") + """\
{atoms}
set             group all diameter 1.0 density 2.0
{kick}
"""
FORCES = lmp.pairs() + """\
fix             move all nve/sphere
{walls}
timestep        {dt}
{more}
"""
DUMP = """\
dump            d all custom {every} {name} id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz
dump_modify     d format float %.17g sort id
"""
GRID = (-1.9, -0.95, 0.0, 0.95, 1.9)
# Thrown at all sides, edges and corners. Each by itself: numbers of atoms that a lattice makes depend
# on how many processes there are.
GAS = "\n".join(f"create_atoms 1 single {x:.2f} {y:.2f} {z:.2f} units box"
                for x in GRID for y in GRID for z in GRID)
FAST = "\n".join([f"variable v{d} atom 6*{d}" for d in "xyz"] + [
    "velocity all create 4.0 4711 loop geom", "velocity all set v_vx v_vy v_vz sum yes",
    "set group all omega 2.1 -3.3 1.7"])
OPEN = "-4 4 -4 4 -4 4"


def write_plate(path, axis, at, lo=(-SIDE, -SIDE), hi=(SIDE, SIDE), cells=1):
    """2 cells^2 triangles across an axis, between lo and hi along the other two."""
    def point(i, j):
        uv = [lo[k] + (hi[k] - lo[k]) * n / cells for k, n in ((0, i), (1, j))]
        uv.insert(axis, at)
        return uv

    stl.write(path, stl.sheet(cells, point))


def six(law, more={}, common=""):
    meshes = " ".join(f"mesh {name}.stl {more.get(name, '')}" for name in FACES)
    return f"fix wall all wall/lsdcd {law} {meshes} {common}"


def planes(law, more=""):
    """`more`: of the lower plane across z."""
    walls = [f"fix {axis} all wall/gran {law} {axis}plane {-SIDE} {SIDE}" for axis in "xy"]
    return lmp.flat_walls("\n".join(walls + [f"fix zlo all wall/gran {law} zplane {-SIDE} NULL {more}",
                                             f"fix zhi all wall/gran {law} zplane NULL {SIDE}"]))


def build(walls, name, steps, atoms=GAS, kick=FAST, dt=1e-4, every=1, more="", box=OPEN, boundary="f f f",
          types=1):
    return (CREATE.format(atoms=atoms, kick=kick, box=box, boundary=boundary, types=types) +
            FORCES.format(walls=walls, dt=dt, more=more) + DUMP.format(every=every, name=name) +
            f"run {steps}\n")


def go(folder, walls, name, steps, ranks=1, **words):
    text = lmp.run_well(build(walls, name, steps, **words), folder, ranks)
    return lmp.read_dump(folder / name), text


def thermo(columns, every=1):
    return f"thermo_style custom step {columns}\nthermo_modify norm no format float %.17g\nthermo {every}"


def write_box(folder):
    for name, (axis, at) in FACES.items():
        write_plate(folder / f"{name}.stl", axis, at)
