# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""A mesh acts through the periodic faces of the box, and follows the box when it changes.

The oracle is the same scene somewhere else: moved by half a box it does not cross a face, in a
larger box without periodicity the sphere meets the wall that its image stands for, and a flat
floor is fix wall/gran's zplane. Coordinates of the order of the box are rounded to 1e-15; a
contact multiplies a difference by at most its stiffness over its overlap, so that 1e-10 of the box
leaves room for 1e5 roundings.
"""

import lmp
import stl
from facts import at_most, fact


WALL = stl.quad((0, -20, -20), (0, 20, -20), (0, 20, 20), (0, -20, 20))    # x = 0, across the box


def floor(x0, x1, y0, y1, cells=1, z=0.0):
    """Of 2 cells^2 triangles."""
    return stl.sheet(cells, lambda i, j: (x0 + (x1 - x0) * i / cells, y0 + (y1 - y0) * j / cells, z))


def scene(wall, x, v, box="0 10 0 10 -1 10", boundary="p f f", skin=0.3, steps=2000, dt=1e-3, radius=0.5,
          gravity=0, neigh="delay 0 every 1 check yes", more="", omega=(0, 0, 0), every=20,
          out="moves"):
    """One sphere; dumps unwrapped places."""
    pull = f"fix pull all gravity {gravity} vector 0 0 -1" if gravity else ""
    lines = f"fix wall all {wall}\n"
    if wall.startswith("wall/gran"):
        lines = lmp.flat_walls(lines)
    return lmp.head(box, boundary) + f"""\
create_atoms    1 single {x[0]} {x[1]} {x[2]} units box
set             atom 1 diameter {2 * radius} density 2.0
velocity        all set {v[0]} {v[1]} {v[2]}
set             atom 1 omega {omega[0]} {omega[1]} {omega[2]}
""" + lmp.pairs(f"zero {2 * radius}", skin, neigh=neigh) + f"""\
fix             move all nve/sphere
{pull}
{lines}timestep        {dt}
{more}
dump            d all custom {every} {out} id xu yu zu vx vy vz omegax omegay omegaz
dump_modify     d format float %.17g
run             {steps}
"""


def go(folder, *args, ranks=1, **kwargs):
    text = lmp.run_well(scene(*args, **kwargs), folder, ranks=ranks)
    return lmp.read_dump(folder / kwargs.get("out", "moves")), text


def apart(a, b, size):
    return max(abs(u - v) for step in a for u, v in zip(a[step][1], b[step][1])) / size


def moved(moves, shift):
    return {step: {1: [u + s for u, s in zip(row[1], list(shift) + [0] * 6)]} for step, row in moves.items()}


ELASTIC = "wall/lsdcd hooke 2e4 NULL 0 NULL 0 0 mesh"
ROUGH = "hooke/history 2e3 NULL 20 NULL 0.4 1"


def test_near_a_face(folder):
    """The wall is a radius and a bit inside one face; the sphere meets it through the other."""
    stl.write(folder / "wall.stl", WALL)
    for skin in (0.1, 0.3):
        here, _ = go(folder, f"{ELASTIC} wall.stl move 9.4995 0 0", (0.29, 5, 5), (-3, 0, 0), skin=skin, steps=600)
        there, _ = go(folder, f"{ELASTIC} wall.stl move 4.4995 0 0", (5.29, 5, 5), (-3, 0, 0), skin=skin, steps=600)
        fact(f"skin {skin}: the sphere comes back", here[600][1][3] > 2.9, f"{here[600][1][3]:.6f}")
        at_most(f"skin {skin}: a wall near a face, as in the middle of the box",
                apart(here, moved(there, (-5, 0, 0)), 10), 1e-10)
    # Where nothing is checked between two reneighbourings, and spheres go far.
    many, text = go(folder, f"{ELASTIC} wall.stl move 9.4995 0 0", (0.29, 5, 5), (-3, 2.9, 0), skin=0.05,
                    steps=3000, boundary="p p f", neigh="delay 0 every 400 check no")
    fact("spheres far past a face are warned of", "past a periodic face before it was wrapped" in text)


def test_over_the_seam(folder):
    """A sphere slides and rolls from one end of a floor on to its image, and on."""
    floors = (("ends at the faces", (0, 10), 1), ("ends at the faces, 200 triangles", (0, 10), 10), ("reaches past both", (-0.05, 10.05), 1),
              ("reaches far past", (-7, 16), 3), ("1000 boxes long", (-5000, 5010), 1))
    kwargs = dict(x=(9.2, 9.3, 0.05), v=(3, 2.1, 0), boundary="p p f", radius=0.05, skin=1, gravity=9.81,
                  steps=4000, dt=2e-4, omega=(3, -5, 7), every=50)
    for law in (ROUGH, "hertz/history 2e5 NULL 50 NULL 0.4 1"):
        flat, _ = go(folder, f"wall/gran {law} zplane 0.0 NULL", **kwargs)
        for name, ends, cells in floors:
            stl.write(folder / "floor.stl", floor(*ends, *ends, cells))
            mesh, text = go(folder, f"wall/lsdcd {law} mesh floor.stl periodic", **kwargs)
            at_most(f"floor {name}, {law.split()[0]}: as zplane", apart(mesh, flat, 10), 1e-11)
            fact(f"floor {name}: no warning of its ends", "periodic face" not in text)


def test_larger_spheres(folder):
    """A larger sphere comes to a floor that reaches past the faces by its radius and no more."""
    stl.write(folder / "floor.stl", floor(-0.5, 10.5, -0.5, 10.5))
    done = lmp.run(scene(f"wall/lsdcd {ROUGH} mesh floor.stl periodic", (3, 3, 0.45), (0, 0, 0), radius=0.45,
                         boundary="p p f", gravity=9.81, steps=100,
                         more="run 10\ncreate_atoms 1 single 9.9 7 0.5 units box\nset atom 2 diameter 1 density 2"),
                   folder)
    fact("the grid is built anew for a larger sphere, whatever reaches past the faces",
         done.returncode == 0 and "larger grains, grid rebuilt for radius 0.55" in done.stdout)


def test_hills(folder):
    """A wavy floor as long as the box, and the same three boxes long in a box that it fits."""
    import math

    def wavy(x0, x1):
        n = round(2 * (x1 - x0))
        z = [0.2 * math.sin(2 * math.pi * k / 20) for k in range(20)]
        xs = [x0 + k / 2 for k in range(n + 1)]
        out = []
        for i in range(n):
            a, b = xs[i], xs[i + 1]
            za, zb = z[round(2 * a) % 20], z[round(2 * b) % 20]
            out += stl.quad((a, -1, za), (b, -1, zb), (b, 11, zb), (a, 11, za))
        return out
    stl.write(folder / "one.stl", wavy(0, 10))
    stl.write(folder / "three.stl", wavy(-10, 20))
    kwargs = dict(x=(8.2, 5.1, 0.9), v=(6, 0.5, 0), gravity=9.81, steps=6000, dt=2e-4, omega=(1, 2, 0), radius=0.3,
                  every=50, skin=0.6)
    for law in (ROUGH, "hooke/history 2e3 NULL 20 NULL 5.0 1"):
        here, _ = go(folder, f"wall/lsdcd {law} mesh one.stl", boundary="p f f", **kwargs)
        there, _ = go(folder, f"wall/lsdcd {law} mesh three.stl", boundary="f f f", box="-10 20 0 10 -1 10", **kwargs)
        fact("the sphere crosses the face", here[6000][1][0] > 10.5)
        at_most(f"springs cross a bent seam, xmu {law.split()[5]}", apart(here, there, 10), 1e-9)


def test_tilted(folder):
    """The wall of a tilted box, met across the face that leans."""
    stl.write(folder / "wall.stl", stl.quad((0, 0, -1), (0, 10, -1), (0, 10, 10), (0, 0, 10)))
    for y in (0.6, 4.0, 8.7):
        here, text = go(folder, f"{ELASTIC} wall.stl move 12 0 0", (8, y, 5), (3, 0, 0), steps=3000,
                        box="0 10 0 10 -1 10 4.9 0 0", boundary="p p f")
        there, _ = go(folder, f"{ELASTIC} wall.stl move 12 0 0", (8, y, 5), (3, 0, 0), steps=3000,
                      box="-20 40 -5 15 -1 10", boundary="f f f")
        fact(f"tilted box, y = {y}: the sphere comes back", here[3000][1][3] < 0)
        at_most(f"tilted box, y = {y}: as without periodicity", apart(here, there, 10), 1e-10)
    fact("a mesh past a face is warned of", "reaches past the periodic face in x" in text)


def test_belts(folder):
    """Ends that do not meet, and a screen whose holes lie across the face."""
    run = dict(x=(5, 5, 3), v=(0, 0, 0), steps=0, radius=0.02)
    stl.write(folder / "belt.stl", floor(0.005, 9.995, 4, 6, 4))
    _, text = go(folder, f"{ELASTIC} belt.stl", **run)
    fact("ends 1 cm apart are named", "ends of the mesh do not meet across the periodic face in x, "
         "where its open edges face a gap of 0.01;" in text)
    screen = [t for i in range(20) for j in range(20)
              if (i % 4, j % 4) != (0, 0) for t in floor(i / 2 - 0.25, i / 2 + 0.25, j / 2, j / 2 + 0.5)]
    stl.write(folder / "screen.stl", screen)
    _, text = go(folder, f"{ELASTIC} screen.stl periodic", **run)
    fact("a screen with holes across the face has no loose ends", "do not meet" not in text)


def test_box_changes(folder):
    """The walls of a box that changes in a run."""
    stl.write(folder / "wall.stl", WALL)
    # The face comes in past the wall at 9 to x = 8: what is met is its image at 1.
    here, text = go(folder, f"{ELASTIC} wall.stl move 9 0 0", (5.5, 5, 5), (1, 0, 0), steps=8000, every=1,
                    more="fix shrink all deform 1 x final 0 8 remap none\nrun 1000\nunfix shrink")
    turn = max(row[1][0] for row in here.values())
    # Unwrapped places count the last box: the image at 1 is at 9 there; it gives by v sqrt(m/k).
    # Images follow the box to 1e-4 of the radius; a turn is seen to 2e-5 in steps of 1e-3.
    give = (2 * 0.5235987755982988 / 2e4) ** 0.5
    at_most("a wall past a shrunk box acts by its image", abs(turn - (9 - 0.5 + give)), 1e-4)
    fact("the log tells of it", "the box has changed, grid rebuilt at step" in text)
    # The box outgrows its floor.
    stl.write(folder / "floor.stl", floor(0, 10, 0, 10, 2))
    lmp.refused("a box that outgrows its periodic floor", scene(
        "wall/lsdcd hooke 2e4 NULL 20 NULL 0 0 mesh floor.stl periodic", (5, 5, 0.5), (0, 0, 0), gravity=9.81,
        more="fix grow all deform 1 x final -1 11 remap none"), folder, "ends of the mesh do not meet across the periodic face in x")
    # change_box between runs, the wall in the way of the new face.
    here, _ = go(folder, f"{ELASTIC} wall.stl move 9.7 0 0", (5, 5, 5), (-2, 0, 0), steps=3000, every=1,
                 more="run 100\nchange_box all x final 0 9.4 boundary p f f")
    far = min(row[1][0] for row in here.values())
    at_most("change_box: the wall acts by its image", abs(far - (0.3 + 0.5 - 2 * give)), 1e-4)


def test_parted(folder):
    """A mesh that met itself and no longer does stops the run, however wide the gap is beside the box; an opening from the
    beginning on does not."""
    for name, x0, x1 in (("floor.stl", 0, 10), ("long.stl", 0, 20), ("open.stl", 0, 6)):
        stl.write(folder / name, floor(x0, x1, -20, 20))
    wall = "wall/lsdcd hooke 1e4 NULL 0 0 0 0 mesh {} periodic"
    change = "run 1\nchange_box all x final {}"
    for gap, to in (("0.9", "0 10.9"), ("10", "0 20"), ("90", "-40 60")):
        lmp.refused(f"a gap of {gap}", scene(wall.format("floor.stl"), (5, 0, 1), (0, 0, 0), steps=1, more=change.format(to)), folder,
                    f"the box has changed, and the ends of the mesh do not meet across the periodic face in x, where its open "
                    f"edges face a gap of {gap};")
    lmp.refused("with larger grains", scene(wall.format("floor.stl"), (5, 0, 1), (0, 0, 0), steps=1,
                                            more=change.format("0 20") + "\nset group all diameter 1.5"), folder, "face a gap of 10;")
    for name, to in (("long.stl", "0 20"), ("open.stl", "0 12")):
        text = lmp.run_well(scene(wall.format(name), (5, 0, 1), (0, 0, 0), steps=1, more=change.format(to)), folder)
        fact(f"{name}: goes on", "do not meet" not in text)


def test_large_meshes(folder):
    """The grid is there where spheres can be, and no further."""
    for wide in (1e3, 1e6):
        stl.write(folder / "floor.stl", floor(-wide, wide, -wide, wide))
        kwargs = dict(x=(5, 5, 0.6), v=(1, 0.3, 0), gravity=9.81, omega=(3, -5, 7), boundary="f f f")
        mesh, text = go(folder, f"wall/lsdcd {ROUGH} mesh floor.stl", **kwargs)
        flat, _ = go(folder, f"wall/gran {ROUGH} zplane 0.0 NULL", **kwargs)
        at_most(f"floor {2 * wide:g} wide: as zplane", apart(mesh, flat, 10), 1e-10)
        line = next(row for row in text.split("\n") if "built in" in row)
        size = float(line.split()[0]) * {"kB,": 1e-3, "MB,": 1}[line.split()[1]]
        at_most(f"floor {2 * wide:g} wide: MB", size, 2)
    # Spheres fly past what a shrink-wrapped box was at first.
    stl.write(folder / "wall.stl", WALL)
    far = [tuple(tuple(1e3 * c for c in p) for p in t) for t in stl.quad((0, -1, -1), (0, 1, -1), (0, 1, 1), (0, -1, 1))]
    stl.write(folder / "far.stl", far + [tuple((p[0] + 400, p[1], p[2]) for p in t) for t in far])
    here, text = go(folder, f"{ELASTIC} far.stl move -200 0 0", (5, 5, 5), (30, 0, 0), boundary="m m m", steps=8000)
    fact("a far wall is met", max(r[1][0] for r in here.values()) < 200 and here[8000][1][3] < 0)
    fact("the grid follows a shrink-wrapped box", "the box has changed" in text)


def test_scales(folder):
    """A mesh in millimetres in a box in metres."""
    hundred = floor(-50, 50, -50, 50, z=-50) + floor(-50, 50, -50, 50, z=50)
    stl.write(folder / "vessel.stl", hundred)
    done = lmp.run(scene(f"{ELASTIC} vessel.stl", (0, 0, 0), (0, 0, 0), box="-.06 .06 -.06 .06 -.06 .06", radius=0.001,
                         boundary="f f f", steps=1), folder)
    fact("a forgotten scale is named", "far larger than the box" in done.stdout
         and "add scale 0.001" in done.stdout)
    fact("what no particle can touch stops the run",
         done.returncode != 0 and "no grain in the box can touch the mesh" in done.stdout)
