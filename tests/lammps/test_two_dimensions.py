# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Discs in two dimensions on an outline drawn out along z move as on fix wall/gran's planes.

Discs that do not collide do not amplify rounding: 1e-12, as in test_parity. LSDCD_QUICK=1 takes one law.
"""

import re

import pytest

import lmp
import stl
from facts import at_most, fact

# In contact laws of 29Sep2021 and later alike.
LAWS = {
    "hooke": "hooke 1e4 NULL 5 NULL 0.5 1",
    "hooke_history": "hooke/history 1e4 NULL 5 NULL 0.5 1",
    "hertz_history": "hertz/history 1e5 NULL 50 NULL 0.5 1",
}


def write_outline(path, points, half=0.6, parts=1):
    """Upright faces over a line of points in the plane, each piece in 2 x parts triangles."""
    triangles = []
    for (ax, ay), (bx, by) in zip(points, points[1:]):
        for k in range(parts):
            s, t = k / parts, (k + 1) / parts
            a, b = (ax + s * (bx - ax), ay + s * (by - ay)), (ax + t * (bx - ax), ay + t * (by - ay))
            triangles += stl.quad((*a, -half), (*b, -half), (*b, half), (*a, half))
    stl.write(path, triangles)


HEAD = lmp.head("0 20 0 20 -0.5 0.5", "{boundary} p", more="dimension 2\n")
TAIL = lmp.pairs("gran/{law}", 0.2) + """\
{walls}
fix             flat all enforce2d
timestep        {dt}
dump            d all custom {every} {out} id x y vx vy omegaz fx fy tqz
dump_modify     d format float %.17g sort id
run             {steps}
"""
ONE = """\
create_atoms    1 single 1.1 1.3 0 units box
set             group all diameter 1.0
set             group all density/disc 2.0
velocity        all set -1.1 -1.7 0
set             group all omega 0 0 9
fix             move all nve/sphere disc
fix             pull all gravity 3.0 vector -0.3 -1 0
"""
# Three that do not meet, over the periodic face at x = 0 and 20.
THREE = """\
create_atoms    1 single 2.0 0.52 0 units box
create_atoms    1 single 9.0 1.1 0 units box
create_atoms    1 single 17.0 0.8 0 units box
set             group all diameter 1.0
set             group all density/disc 2.0
velocity        all set 4.0 -1.0 0
set             group all omega 0 0 5
fix             move all nve/sphere disc
fix             pull all gravity 3.0 vector 0.4 -1 0
"""
def move(folder, out, particles, walls, law, host, boundary="f f", steps=1000, dt=1e-3, every=1):
    text = lmp.run_well(HEAD.format(boundary=boundary) + particles +
                        TAIL.format(law=law, walls=walls, dt=dt, every=every, out=out, steps=steps),
                        folder, host=host, flags=())
    return lmp.read_dump(folder / out), text


def alone(folder, name, particles, hosts, mesh, law, host, **more):
    theirs, _ = move(folder, "theirs", particles, hosts, law, host, **more)
    ours, text = move(folder, "ours", particles, f"fix w all wall/lsdcd {law} {mesh}", law, host, **more)
    touched = sum(any(row[7] != 0 for row in rows.values()) for rows in ours.values())
    fact(f"{name}: discs touch the wall", touched > 20, f"{touched} steps")
    at_most(f"{name}: trajectory as with wall/gran", lmp.largest_difference(theirs, ours), 1e-12)
    fact(f"{name}: no word of faces that lean", "lean" not in text)


def words(folder, host):
    """What cannot be meant in two dimensions is said."""
    def text_of(points, mesh, half=0.6):
        write_outline(folder / "said.stl", points, half=half)
        return lmp.run(HEAD.format(boundary="f f") + ONE +
                       TAIL.format(law=LAWS["hooke"], dt=1e-3, every=1, out="d", steps=0,
                                   walls=f"fix w all wall/lsdcd {LAWS['hooke']} mesh said.stl {mesh}"), folder, host=host, flags=()).stdout
    floor = [(-1.0, 0.0), (21.0, 0.0)]
    text = text_of(floor, "move 0 0 0.7")
    refused = re.search(r"which the mesh does not cut: .*move 0 0 \S*\)", text)
    fact("a mesh beside the plane is refused", bool(refused) and "from 0.1 to 1.3" in refused[0] and
         "(move 0 0 -0.7)" in refused[0], refused[0] if refused else text[-300:])
    text = text_of(floor, "rotate 1 0 0 30")
    warned = re.search(r"\d+ faces lean .* degrees", text)
    fact("faces that lean are told of", bool(warned) and warned[0][:2] == "2 " and
         warned[0].endswith("by up to 30 degrees"), warned[0] if warned else text[-300:])
    text = text_of(floor, "", half=500)
    fact("an outline may be drawn out far past the box", not re.search("ERROR|WARNING", text))


def prepare(folder):
    write_outline(folder / "corner.stl", [(0, 22), (0, 0), (22, 0)], parts=7)
    write_outline(folder / "floor.stl", [(-1.5, 0), (21.5, 0)], parts=46)


BOTH = pytest.mark.parametrize("host", (False, pytest.param(True, marks=lmp.needs_host)))


@BOTH
def test_alone(folder, host):
    for name, law in lmp.sample(LAWS).items():
        gran = f"fix {{}} all wall/gran {law} {{}}"
        xplane, yplane = (gran.format(f"w{p[0]}", p) for p in ("xplane 0 NULL", "yplane 0 NULL"))
        alone(folder, f"{name}, corner", ONE, f"{xplane}\n{yplane}", "mesh corner.stl", law, host, steps=2000)
        alone(folder, f"{name}, chute", THREE, yplane, "mesh floor.stl periodic", law, host, boundary="p f", steps=2000)
        alone(folder, f"{name}, moving floor", THREE, f"{yplane} shear x 6.0", "mesh floor.stl periodic surface_vel 6 0 0", law, host,
              boundary="p f", steps=2000)


@BOTH
def test_words(folder, host):
    words(folder, host)
