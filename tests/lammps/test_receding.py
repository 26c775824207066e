# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Meshes that recede by their wear: Archard's depth, volumes, what is held back, ranks, restart, errors."""

import numpy

import lmp
import scene
import stl
import vtp
from facts import at_most, fact
from test_loads import apart
from triangles import volume

BEGIN = lmp.SMALL_BOX_AT_REST.format(atoms="create_atoms    1 single {x} units box") + "timestep        0.001\n"
EACH = 'fix out all print 1 "$(step) $(f_w[10]:%.17g) $(f_w[36]:%.17g) $(f_w[37]:%.17g)" file {} screen no\n'


def corners(fields):
    p = fields["points"]
    return [tuple(p[k:k + 3]) for k in range(0, len(p), 3)]


def worst_balance(rows, every, factor):
    """Compares removed and held back with what was worn one step before, where they have just been moved."""
    most = 0
    for before, row in zip(rows, rows[1:]):
        if row[0] % every == 0:
            most = max(most, abs(row[2] + row[3] - factor * before[1]))
    return most / (factor * rows[-1][1])


# ---- Archard -------------------------------------------------------------------------------

FORCE, WIDTH, CELL = 100.0, 0.5, 0.1    # kn 1e4 times an overlap of 0.01


def test_archard(folder):
    """A sphere slides along the middle of a strip: V = K F s/H, and a depth of V over the area that it swept."""
    n = 40
    def point(i, j):
        return (CELL * i - 2, WIDTH * (j - 0.5), 0)
    triangles = [t for i in range(n) for t in stl.quad(point(i, 0), point(i + 1, 0), point(i + 1, 1), point(i, 1))]
    for name, wound in (("up", triangles), ("down", [(a, c, b) for a, b, c in triangles])):
        stl.write(folder / "strip.stl", wound)
        lmp.run_well(BEGIN.format(x="-1.5005 0 0.49") +
                     "fix w all wall/lsdcd hooke 1e4 0 0 0 0.3 0 mesh strip.stl wear archard 2.5e-4 50 deform every 3000 &\n"
                     "factor 2 mesh_fields strip.vtp every 3001\nfix go all move linear 1 0 0 units box\n" +
                     EACH.format("strip.txt") + "run 3001\n", folder)
        rows = lmp.read_rows(folder / "strip.txt")
        worn = 2.5e-4 / 50 * FORCE * 2.999
        at_most(f"wound {name}: worn is K F s/H", abs(rows[-3][1] / worn - 1), 1e-10)
        at_most(f"wound {name}: twice that is removed", abs(rows[-2][2] / (2 * rows[-3][1]) - 1), 1e-12)
        # A step more or less in one of the cells beside a vertex is 1 % of what comes off there.
        depth = 2 * 2.5e-4 / 50 * FORCE / WIDTH
        inside = [z for x, _, z in corners(vtp.read(folder / "strip.vtp")) if abs(x) < 1.35]
        fact(f"wound {name}: there are vertices", len(inside) == 54)
        at_most(f"wound {name}: the depth is V over the area swept", max(abs(-z / depth - 1) for z in inside), 0.02)
        apart_at_ends = [z for x, _, z in corners(vtp.read(folder / "strip.vtp")) if abs(x) > 1.75]
        fact(f"wound {name}: nothing comes off elsewhere", max(map(abs, apart_at_ends)) == 0)


# ---- volumes, ranks, restart -------------------------------------------------------------------

def test_grains(folder):
    scene.write_floor(folder / "floor.stl", cells=13)
    every, factor = 7, 3
    wear = f"mesh floor.stl wear archard 2e-3 50 deform every {every} factor {factor} mesh_fields {{}} every 100"

    def go(name, ranks=1, begin=scene.CREATE, steps=400, last=""):
        text = begin + scene.forces("hooke/history 1e4 NULL 120 NULL 0.4 1", mesh=wear.format(name + ".vtp"))
        lmp.run_well(text + EACH.replace("f_w[", "f_wall[").format(name + ".txt") + f"run {steps}\n{last}", folder, ranks)
        return lmp.read_rows(folder / (name + ".txt")), vtp.read(folder / (name + ".vtp"))

    rows, one = go("one")
    fact("the floor has worn", rows[-1][1] > 0 and rows[-1][3] == 0, f"{rows[-1][1]:.3g}")
    at_most("removed is the factor times worn", worst_balance(rows, every, factor), 1e-12)
    lower = [scene.floor_height(x, y) - z for x, y, z in corners(one)]
    fact("its vertices went down", max(lower) > 1e-4 and min(lower) > -1e-12, f"{min(lower):.3g} to {max(lower):.3g}")
    _, two = go("two", ranks=2)
    at_most("the same shape on 2 ranks", apart(one, two, "points"), 1e-9)
    go("a", steps=203, last="write_restart half.restart\nrun 197\n")
    half, again = vtp.read(folder / "a.vtp"), go("b", begin=scene.SETTINGS + "read_restart half.restart\n", steps=197)
    at_most("the same shape after a restart", apart(half, again[1], "points"), 0)
    at_most("and volume", abs(again[0][-1][2] / lmp.read_rows(folder / "a.txt")[-1][2] - 1), 0)
    on_two = go("c", ranks=2, begin=scene.SETTINGS + "read_restart half.restart\n", steps=197)
    at_most("and on 2 ranks", apart(half, on_two[1], "points"), 1e-9)
    go("d", ranks=2, steps=203, last="write_restart two.restart\nrun 197\n")
    again = go("e", ranks=2, begin=scene.SETTINGS + "read_restart two.restart\n", steps=197)
    at_most("the same from a file of 2 ranks", apart(vtp.read(folder / "d.vtp"), again[1], "points"), 1e-9)
    text = lmp.run_well(scene.SETTINGS + "read_restart half.restart\n" +
                        scene.forces("hooke/history 1e4 NULL 120 NULL 0.4 1", mesh="mesh floor.stl wear archard 2e-3 50") +
                        "run 1\n", folder)
    fact("a wall without deform says that it leaves the shape", "the mesh has the shape of its file" in " ".join(text.split()))


# ---- worn through ------------------------------------------------------------------------------

def plate(n, size, thick):
    """A closed plate of n x n cells, wound outwards; its top is at 0."""
    def at(z):
        return lambda i, j: (size * (i / n - 0.5), size * (j / n - 0.5), z)
    top, bottom = at(0), at(-thick)
    triangles = stl.sheet(n, top) + [(a, c, b) for a, b, c in stl.sheet(n, bottom)]
    for k in range(n):
        for a, b in (((k, 0), (k + 1, 0)), ((n, k), (n, k + 1)), ((k + 1, n), (k, n)), ((0, k + 1), (0, k))):
            triangles += stl.quad(bottom(*a), bottom(*b), top(*b), top(*a))
    return triangles


def test_through(folder):
    """A sphere that is pressed on a moving plate wears it through: nothing folds, and what is held back is told."""
    stl.write(folder / "plate.stl", plate(12, 1.8, 0.05))
    text = lmp.run_well(BEGIN.format(x="0.02 0.01 0.495") +
                        "fix w all wall/lsdcd hooke 1e4 0 100 0 0 0 mesh plate.stl surface_vel 1 0 0 &\n"
                        "wear archard 1.25e-3 50 deform every 20 factor 4 mesh_fields plate_*.vtp every 20 draw faces 1\n"
                        "fix down all addforce 0 0 -50\nfix hold all setforce 0 0 NULL\nfix go all nve\n"
                        "group none empty\ndump im none image 2500 plate.*.ppm type type fix w type 1 0 size 100 100\n" +
                        EACH.format("plate.txt") + "run 2500\n", folder)
    rows = lmp.read_rows(folder / "plate.txt")
    flat = " ".join(text.split())
    fact("it is said once that corners stay", flat.count("would fold over or cut another") == 1)
    fact("much is removed, and then held back", rows[-1][2] > 1e-3 and rows[-1][3] > 1e-3,
         f"{rows[-1][2]:.3g} and {rows[-1][3]:.3g}")
    at_most("both are the factor times worn", worst_balance(rows, 20, 4), 1e-12)
    first, last = vtp.read(folder / "plate_20.vtp"), vtp.read(folder / "plate_2500.vtp")
    whole, now = 1.8 * 1.8 * 0.05, volume(numpy.reshape([corners(last)[k] for k in last["connectivity"]], (-1, 3, 3)))
    # The sum of 1000 products of coordinates of 1.
    at_most("a closed mesh has lost what was removed", abs(whole - now - rows[-1][2]), 1e-14)
    fact("dump image draws it anew", len({(folder / f"plate.{k}.ppm").read_bytes() for k in (0, 2500)}) == 2)
    fact("its shape has changed", apart(first, last, "points") > 0.01)
    lowest = [z for x, y, z in corners(last) if z > -0.05]
    fact("its top stays above its bottom", -0.05 < min(lowest) < -0.02, f"{min(lowest):.3g}")


# ---- errors ----------------------------------------------------------------------------------

def test_refused(folder):
    stl.write(folder / "plate.stl", plate(2, 1.8, 0.2))
    stl.write(folder / "mixed.stl", [((-2, -2, 0), (2, -2, 0), (2, 2, 0)), ((-2, -2, 0), (-2, 2, 0), (2, 2, 0))])

    def fails(name, words, says, begin=BEGIN.format(x="0 0 0.495")):
        lmp.refused(name, begin + f"fix w all wall/lsdcd hooke 1e4 0 0 0 0.3 0 {words}\nfix go all move linear 1 0 0 units box\nrun 10\n",
                    folder, says)
    wear = "wear archard 0.1 50 deform"
    fails("deform without a number", f"mesh plate.stl {wear}", "'every N' is missing")
    fails("a factor of 0", f"mesh plate.stl {wear} every 5 factor 0", "factor")
    fails("a body", f"mesh plate.stl body density 1 {wear} every 5", "the mass and centre of a body are those of its shape")
    fails("triangles wound in opposite ways", f"mesh mixed.stl {wear} every 5", "wind them alike")
    fails("periodic images", f"mesh plate.stl move 2.5 0 0 {wear} every 5", "has periodic images",
          BEGIN.format(x="2.5 0 0.495").replace("boundary        f f f", "boundary        p f f"))
    fails("too much at once", f"mesh plate.stl {wear} every 5 factor 1e9", "give a smaller factor")
