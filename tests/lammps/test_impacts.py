# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Impacts on a wall (keyword impacts), their spectrum, and what becomes of energy at each triangle."""

import math
import pathlib
import re

import lmp
import stl
import vtp
from facts import at_most, fact
from test_energy import ALONE, CAUSES, COLUMNS, DOWN, GRAIN, HELD, KN, MASS, MILL_K, MILL_LAW, NAMES, SPHERE, mill

COUNT, ENERGY = "f_wall[73]", "f_wall[74]"


def prepare(folder):
    """The floor as two triangles, and as 98 of which none has a seam where the others have one."""
    lmp.flat_floor(folder)
    stl.write(folder / "cut.stl", stl.sheet(7, lambda i, j: (-3 + 6 * i / 7, -3 + 6 * j / 7, 0)))


def row_of(text, names):
    return dict(zip(("step", "ke", "spin", *names), lmp.read_thermo(text)[-1]))


def hits(folder, law, dt, run, words="impacts 0.01", mesh="floor.stl", columns=(COUNT, ENERGY), ranks=1, **of):
    """The last row: step, ke, spin, impacts, energy."""
    of = {"x": "0.3 0.2 0.51", "v": "0 0 -1", "move": "fix move all nve/sphere", **of}
    script = SPHERE.replace("mesh floor.stl energy", f"mesh {mesh} {words}")
    return row_of(lmp.run_well(script.format(law=law, dt=repr(dt), columns=" ".join(columns), run=run, **of), folder, ranks),
                  ("impacts", "energy", *range(len(columns) - 2)))


LAWS = ("hooke 1e4 NULL 30 NULL 0 0", "hooke/history 1e4 1e4 30 NULL 0.5 1", "granular hertz 1e5 10 damping velocity tangential linear_nohistory 0 0.3",
        "granular jkr 1e6 10 0.25 0.001 damping velocity tangential mindlin NULL 1 0.3")


def test_bounce(folder):
    """A sphere that falls at speed v, also aslant, is one impact of m v^2/2 with the speed along the normal, of any law, with books of energy
    and without, wherever within a step it begins; slower than the least speed it is none. It moves freely before, so that v is exact."""
    for law in LAWS:
        for words in ("impacts 0.01", "impacts 0.01 energy"):
            for z in ("0.51", "0.5103", "0.5107"):
                b = hits(folder, law, 1e-3, "run 300", words, x=f"0.3 0.2 {z}", v="0.7 -0.3 -1")
                fact(f"{law} {words}: one impact", b["impacts"] == 1, b)
                at_most(f"{law} {words}: energy", abs(b["energy"] - 0.5), 1e-12)
        fact(f"{law}: not faster than the least speed", hits(folder, law, 1e-3, "run 300", "impacts 1.0001")["impacts"] == 0)


def test_units(folder):
    """The energy of an impact is LAMMPS's kinetic energy before it, also where a mass times the square of a velocity is no energy; a body has
    the reduced mass there, too."""
    for units, mv2e in (("real", 48.88821291 ** 2), ("metal", 1.0364269e-4), ("electron", 1.06657236), ("si", 1), ("nano", 1)):
        k, dt = 1e4, 0.01 * math.sqrt(mv2e / 1e4)    # sqrt(m/k) is 100 steps
        script = SPHERE.replace("units           lj", f"units           {units}").replace("energy\n", "impacts 1e-9 impact_spectrum s.csv every 150\n")
        for mesh, reduced in (("floor.stl", 1), ("floor.stl body mass 3 com 0 0 0 inertia 1 1 1 0 0 0 joint slider 0 0 1", 0.75)):
            text = script.replace("mesh floor.stl", f"mesh {mesh}").format(x="0.3 0.2 0.50001", v=f"0 0 {-1e-4 / dt!r}", move="fix move all nve/sphere",
                                                                          law=f"hooke {k} NULL 0 NULL 0 0", dt=repr(dt), columns=f"{COUNT} {ENERGY}", run="run 150")
            rows = lmp.read_thermo(lmp.run_well(text, folder))
            before, (found, energy) = rows[0][1], rows[-1][3:]
            fact(f"{units}, {mesh}: one impact", found == 1, rows)
            at_most(f"{units}, {mesh}: energy", abs(energy / (reduced * before) - 1), 1e-7)    # LAMMPS has mvv2e and ftm2v to 9 digits
            begin, end, n, of_bin = map(float, (folder / "s.csv").read_text().split("\n")[1].split(","))
            fact(f"{units}: the bin has it", begin <= of_bin < end and n == 1 and abs(of_bin / energy - 1) < 1e-12, (begin, end, n, of_bin))


def test_no_impact(folder):
    """A sphere that rests in overlap, at the begin of a run and of a second one, and one that slides over seams, are none."""
    for law in LAWS[:2]:
        for mesh in ("floor.stl", "cut.stl"):
            for move in (HELD.format(v="0.9 0.4 0"), HELD.format(v="0 0 -0.02")):
                b = hits(folder, law, 1e-3, "run 1000\nrun 1000", "impacts 1e-6", mesh, x=DOWN.replace("0.3 0.2", "-1.9 -1.1"), move=move)
                fact(f"{law}, {mesh}, {move}: none", b["impacts"] == 0, b)


def test_put_there(folder):
    """A sphere that something moves into overlap, deeper than it comes in a step, is none."""
    jump = "variable dz equal -0.03*(step>50)\nvariable vz equal -0.5\nfix move all move variable NULL NULL v_dz NULL NULL v_vz"
    for law in LAWS[:2]:
        b = hits(folder, law, 1e-3, "run 100", "impacts 1e-6", x="0.3 0.2 0.52", v="0 0 -0.5", move=jump)
        fact(f"{law}: none", b["impacts"] == 0, b)
        b = hits(folder, law, 1e-2, "run 100", "impacts 1e-6", x="0.3 0.2 0.5299", v="0 0 -0.5", move=jump)
        fact(f"{law}: as deep as it would come by itself, it is one", b["impacts"] == 1, b)


def test_body(folder):
    """A plate of mass 3 that is a body has the impact of the reduced mass, 3/4."""
    plate = "body mass 3 com 0 0 0 inertia 1 1 1 0 0 0 joint slider 0 0 1"
    b = hits(folder, LAWS[0], 1e-3, "run 300", f"{plate} impacts 0.01")
    fact("one impact", b["impacts"] == 1, b)
    at_most("energy", abs(b["energy"] - 0.375), 1e-12)


# ---- beside another contact --------------------------------------------------------------

# From the line of a fold to where a face ends.
LONG = 4


def side(way):
    """A face from the line x = z = 0 along `way` in x and z."""
    x, z = LONG * way[0], LONG * way[1]
    face = stl.quad((0, -2, 0), (x, -2, z), (x, 2, z), (0, 2, 0))
    return face if x > 0 else [triangle[::-1] for triangle in face]


def fold(folder, *ways):
    """Faces along these ways: all in fold.stl, and each in a mesh of its own. Returns the words of both walls."""
    faces = [side(way) for way in ways]
    stl.write(folder / "fold.stl", sum(faces, []))
    for k, face in enumerate(faces):
        stl.write(folder / f"side{k}.stl", face)
    return "fold.stl", " mesh ".join(f"side{k}.stl" for k in range(len(faces)))


BOXED = SPHERE.replace(lmp.head("-3 3 -3 3 -1 5"), lmp.head("-5 5 -3 3 -3 5"))
assert BOXED != SPHERE


def struck(folder, law, mesh, least, run, dt=1e-3, words="", script=BOXED, **of):
    """Number and energy of all impacts."""
    script = script.replace("mesh floor.stl energy", f"mesh {mesh} impacts {least} {words}")
    return lmp.read_thermo(lmp.run_well(script.format(law=law, dt=repr(dt), columns=f"{COUNT} {ENERGY}", run=run, **of), folder))[-1][3:5]


def slides(folder, law, mesh, angle, z=0.4999, words=""):
    """The same of a ball that slides at 1 along a floor, at this height, to a wall at this angle from it."""
    # Where it touches the wall: the corner rule hides that up to the depth of the floor times the cosine.
    c, s = math.cos(angle), math.sin(angle)
    x = ((0.5 if c > 0 else z) * c - 0.5) / s - 0.0403
    return struck(folder, law, mesh, 1e-4, "run 60", words=words, x=f"{x!r} 0.1 {z}", v="0 0 0", move=HELD.format(v="1 0 0"))


def test_wall_beside_a_floor(folder):
    """A ball that slides on a floor at 1 strikes a wall at any angle from it: one impact of the speed sin(angle), whether both are one mesh or two,
    how deep it lies on the floor, of any law, and with books of energy."""
    for degrees in (0.1, 1, 10, 30, 60, 80, 90 - 1e-7, 90, 90 + 1e-7, 100, 120):
        a = math.radians(degrees)
        meshes = fold(folder, (-1, 0), (math.cos(a), math.sin(a)))
        cases = [(LAWS[0], mesh, z, "") for mesh in meshes for z in (0.4999, 0.45)]
        if degrees == 60:
            cases += [(law, meshes[0], 0.4999, words) for law in LAWS[1:] for words in ("", "energy")]
        for law, mesh, z, words in cases:
            found = slides(folder, law, mesh, a, z, words)
            name = f"{degrees}, {law}, {mesh}, z {z} {words}"
            fact(f"{name}: one impact", found[0] == 1, found)
            # The normal is rounded, by less than 1e-15 of corners up to 4 over an angle of 1.7e-3.
            at_most(f"{name}: energy", abs(found[1] / (0.5 * math.sin(a) ** 2) - 1), 1e-11)


def test_drop_into_a_fold(folder):
    """A ball that falls at 1 into a fold whose sides are a apart strikes one with c = cos(a/2), and the other one with what is left, which is 2 c sin(a/2)^2:
    on its line, and beside it, where it comes to the other side later. At a right angle it has half of its energy with each."""
    steps, dt = 20, 1e-3
    for degrees in (0.1, 1, 10, 30, 60, 90):
        a = math.radians(degrees)
        c, s = math.cos(a / 2), math.sin(a / 2)
        meshes = fold(folder, (-c, s), (c, s))
        second = 2 * c * s ** 2
        for beside in (0, steps):
            # It slides along a side at s. The corner rule has it touch the other one where it is on the line.
            along = 0.5 * s / c + beside * dt * s
            x, z = along * c - 0.5 * s, along * s + 0.5 * c + 0.0103
            for mesh in meshes:
                for least in (1e-4, 0.2):
                    found = struck(folder, "hooke 100 NULL 0 NULL 0 0", mesh, least, "run 60", dt, x=f"{x!r} 0.1 {z!r}", v="0 0 -1",
                                   move="fix move all nve/sphere")
                    of_both = [speed for speed in (c, second) if speed > least]
                    name = f"{degrees}, {mesh}, {beside} steps beside the line, faster than {least}"
                    fact(f"{name}: number", found[0] == len(of_both), found)
                    at_most(f"{name}: energy", abs(found[1] - math.fsum(v * v / 2 for v in of_both)), 1e-9)


def test_drop_into_a_corner(folder):
    """In the corner of a box a ball has a third of its energy with each side."""
    stl.write(folder / "corner.stl", stl.quad((0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)) + stl.quad((0, 0, 0), (0, 4, 0), (0, 4, 4), (0, 0, 4)) +
              stl.quad((0, 0, 0), (0, 0, 4), (4, 0, 4), (4, 0, 0)))
    found = struck(folder, LAWS[0], "corner.stl", 0.1, "run 60", x="0.5103 0.5103 0.5103", v="-1 -1 -1", move="fix move all nve/sphere")
    fact("three impacts", found[0] == 3, found)
    at_most("of m v^2/2 in all", abs(found[1] - 1.5), 1e-12)


def test_clump_in_a_fold(folder):
    """Each of two spheres of a clump that lie along the line of a fold has the impacts of one, of the clump's mass."""
    a = math.radians(60)
    c, s = math.cos(a / 2), math.sin(a / 2)
    clump = BOXED.replace("fix             wall", "variable one atom 1\nfix wall")
    clump = clump.replace("set             group all diameter", "create_atoms 1 single {other} units box\nset group all diameter")
    z = 0.5 / c + 0.0103
    for mesh in fold(folder, (-c, s), (c, s)):
        clumped = clump.replace("timestep        {dt}", "fix bodies all rigid/small custom v_one\ntimestep {dt}")
        found = struck(folder, "hooke 100 NULL 0 NULL 0 0", mesh, 1e-4, "run 60", script=clumped, x=f"0 0.3 {z!r}", other=f"0 -0.3 {z!r}", v="0 0 -1", move="")
        fact(f"{mesh}: two of each", found[0] == 4, found)
        at_most(f"{mesh}: energy", abs(found[1] - 2 * (c ** 2 + (2 * c * s ** 2) ** 2)), 1e-9)


def test_flat_floor_in_pieces(folder):
    """A ball that falls aslant onto a flat floor strikes it once, though it goes over to another mesh, or over several triangles, in the next step."""
    meshes = fold(folder, (-1, 0), (1, 0))
    stl.write(folder / "fine.stl", stl.sheet(60, lambda i, j: (-0.6 + i / 50, -0.6 + j / 50, 0)))
    for mesh, v in (*((mesh, 5) for mesh in meshes), ("fine.stl", 90)):
        for beside in range(8):
            x = -v * 0.0105 - v * 1e-3 * beside / 8
            found = struck(folder, LAWS[0], mesh, 0.01, "run 13", x=f"{x!r} 0.1 0.5103", v=f"{v} 0 -1", move="fix move all nve/sphere")
            fact(f"{mesh}, {x}: one impact", found[0] == 1, found)
            at_most(f"{mesh}, {x}: energy", abs(found[1] - 0.5), 1e-12)


FILES = "mesh_fields f_*.vtp every 100 impact_spectrum s_*.csv every 100"


def fields(folder, step):
    return vtp.read(pathlib.Path(folder) / f"f_{step}.vtp")


def spectrum(folder, step):
    text = (pathlib.Path(folder) / f"s_{step}.csv").read_text().split("\n")
    fact("the first line names the columns", text[0] == "energy_from,energy_to,impacts,energy", text[0])
    return [[float(word) for word in line.split(",")] for line in text[1:] if line]


def sums(found):
    return {name: math.fsum(found[name]) for name in ("dissipated_energy", "impacts", "impact_energy")}


def test_place(folder):
    """The triangle that is hit has the impact, its energy and speed, and what the bounce dissipates; another cut of the floor changes
    nothing but the place."""
    both = {}
    for mesh in ("floor.stl", "cut.stl"):
        b = hits(folder, LAWS[1], 1e-3, "run 300", f"impacts 0.01 energy {FILES}", mesh, (COUNT, ENERGY, *COLUMNS))
        found, of = fields(folder, 300), dict(zip(NAMES, (b[k] for k in range(len(NAMES)))))
        hit = [k for k, n in enumerate(found["impacts"]) if n]
        fact(f"{mesh}: one triangle", len(hit) == 1, hit)
        points, corners = found["points"], found["connectivity"]
        xy = [(points[3 * c], points[3 * c + 1]) for c in corners[3 * hit[0]:3 * hit[0] + 3]]
        side = [(a[0] - 0.3) * (c[1] - 0.2) - (a[1] - 0.2) * (c[0] - 0.3) for a, c in zip(xy, xy[1:] + xy[:1])]
        fact(f"{mesh}: it is below the sphere", min(side) > 0 or max(side) < 0, xy)
        at_most(f"{mesh}: its speed", abs(found["impact_speed"][hit[0]] - 1), 1e-12)
        total = sums(found)
        at_most(f"{mesh}: its energy", abs(total["impact_energy"] - 0.5), 1e-12)
        at_most(f"{mesh}: dissipated", abs(total["dissipated_energy"] - sum(of[c] for c in CAUSES)), 1e-12)
        fact(f"{mesh}: all of it there", found["dissipated_energy"][hit[0]] == total["dissipated_energy"])
        both[mesh] = total
        rows = spectrum(folder, 300)
        fact(f"{mesh}: the bin has it", len(rows) == 1 and rows[0][0] <= 0.5 < rows[0][1] and rows[0][2] == 1, rows)
        at_most(f"{mesh}: bins are of equal ratio", abs(rows[0][1] / rows[0][0] - 10 ** 0.1), 1e-12)
        at_most(f"{mesh}: its energy in the bin", abs(rows[0][3] - 0.5), 1e-12)
    fact("of both the same", all(abs(both["floor.stl"][k] - both["cut.stl"][k]) <= 1e-12 for k in both["floor.stl"]), both)


def test_twice(folder):
    """A face that is hit again, more slowly, has the speed of the first time, and all of the energy."""
    b = hits(folder, LAWS[1], 1e-3, "run 400", f"impacts 0.01 {FILES}", move="fix move all nve/sphere\nfix g all gravity 10 vector 0 0 -1")
    found = fields(folder, 400)
    fact("several impacts on one face", b["impacts"] >= 2 and max(found["impacts"]) == b["impacts"], b)
    at_most("the speed is that of a fall from 0.01 at 1", abs(max(found["impact_speed"]) - math.sqrt(1.2)), 0.01)
    at_most("energies add up", abs(b["energy"] - max(found["impact_energy"])), 1e-12)
    fact("to more than the first one", 0.65 < b["energy"] < 0.6 * b["impacts"], b)


def test_two_meshes(folder):
    """A ceiling that nothing touches has nothing of what hits the floor, and each mesh has a spectrum of its own."""
    stl.write(folder / "lid.stl", stl.quad((-2, -2, 3), (2, -2, 3), (2, 2, 3), (-2, 2, 3)))
    lid = FILES.replace("f_*", "lid_*").replace("s_*", "lid_*")
    hits(folder, LAWS[1], 1e-3, "run 300", f"{FILES} mesh lid.stl {lid} impacts 0.01 energy")
    at_most("the floor's impact", abs(sums(fields(folder, 300))["impact_energy"] - 0.5), 1e-12)
    fact("its spectrum", sum(row[2] for row in spectrum(folder, 300)) == 1)
    fact("the lid has none", set(sums(vtp.read(folder / "lid_300.vtp")).values()) == {0})
    fact("in its spectrum, too", len((folder / "lid_300.csv").read_text().split("\n")) == 2)


def test_image(folder):
    """A sphere on one side of a periodic face that hits the edge of a plate beyond it: the plate has the impact."""
    stl.write(folder / "plate.stl", stl.quad((-2.95, -1, 0), (-2, -1, 0), (-2, 1, 0), (-2.95, 1, 0)))
    script = SPHERE.replace("mesh floor.stl energy", f"mesh plate.stl impacts 0.01 energy {FILES}")
    script = re.sub("boundary .*", "boundary p p f", script)
    row = lmp.read_thermo(lmp.run_well(script.format(law=LAWS[0], dt="1e-3", columns=" ".join((COUNT, ENERGY, *COLUMNS)), run="run 300", x="2.95 0.2 0.51",
                                                     v="0 0 -1", move="fix move all nve/sphere"), folder))[-1]
    found, of = fields(folder, 300), dict(zip(("impacts", "energy", *NAMES), row[3:]))
    fact("one impact", of["impacts"] == 1 and 0.4 < of["energy"] < 0.5, of)
    total = sums(found)
    at_most("it is the plate's", abs(total["impacts"] - 1) + abs(total["impact_energy"] - of["energy"]), 1e-12)
    at_most("and what the bounce dissipates", abs(total["dissipated_energy"] - of["damping"]) / of["damping"], 1e-12)


def test_edge(folder):
    """Both faces that meet at an edge have half of an impact there, and its whole speed."""
    stl.write(folder / "ridge.stl", stl.quad((-2, -2, -1), (0.3, -2, 0), (0.3, 2, 0), (-2, 2, -1)) + stl.quad((0.3, -2, 0), (2.6, -2, -1), (2.6, 2, -1), (0.3, 2, 0)))
    b = hits(folder, LAWS[1], 1e-3, "run 300", f"impacts 0.01 energy {FILES}", "ridge.stl", (COUNT, ENERGY, *COLUMNS))
    found = fields(folder, 300)
    fact("one impact", b["impacts"] == 1, b)
    at_most("sums", abs(sums(found)["impact_energy"] - 0.5) + abs(sums(found)["impacts"] - 1), 1e-12)
    hit = [k for k, n in enumerate(found["impacts"]) if n]
    fact("two faces have half of it each", [found["impacts"][k] for k in hit] == [0.5, 0.5], hit)
    at_most("the speed", max(abs(found["impact_speed"][k] - 1) for k in hit), 1e-12)


def test_seam(folder):
    """What slides over the seams of a cut floor dissipates mu F s there in all, by the triangles on its way."""
    mu, v, n = 0.3, 0.9, 2000
    totals = []
    for mesh in ("floor.stl", "cut.stl"):
        b = hits(folder, f"hooke/history {KN} 1e4 0 0 {mu} 1", 1e-3, f"run {n}", f"impacts 0.01 energy {FILES}", mesh, (COUNT, ENERGY, *COLUMNS),
                 x=DOWN.replace("0.3 0.2", "-0.9 0.11"), v="0 0 0", move=HELD.format(v=f"{v} 0 0"))
        found, of = fields(folder, n), dict(zip(NAMES, (b[k] for k in range(len(NAMES)))))
        lost = mu * KN * 0.01 * v * 1e-3 * n
        at_most(f"{mesh}: by triangle as of the mesh", abs(sums(found)["dissipated_energy"] - sum(of[c] for c in CAUSES)) / lost, 1e-12)
        at_most(f"{mesh}: mu F s", abs(of["slider"] - lost) / lost, 0.01)
        fact(f"{mesh}: triangles on the way", sum(e > 0 for e in found["dissipated_energy"]) >= (2 if mesh == "cut.stl" else 1))
        totals.append(of["slider"])
    at_most("another cut", abs(totals[0] - totals[1]) / totals[0], 1e-12)


def test_ellipsoid(folder):
    """What an ellipsoid that rocks over a cut floor dissipates is at the triangles on its way, in all as of the mesh."""
    script = GRAIN.replace("mesh {mesh} energy", "mesh {mesh} energy mesh_fields f_*.vtp every 100")
    row = lmp.read_thermo(lmp.run_well(script.format(
        x="0.3 0.2 0.4", quat="0 1 0 10", spin="0.3 -0.4 0.1", v="2 0.8 -0.2", law=LAWS[1].replace("30", "5"), mesh="cut.stl", dt="5e-4",
        columns=" ".join(COLUMNS), run="run 1000").replace("timestep", "fix pull all gravity 20 vector 0 0 -1\ntimestep", 1), folder))[-1]
    of = dict(zip(NAMES, row[3:]))
    found = fields(folder, 1000)["dissipated_energy"]
    lost = sum(of[c] for c in CAUSES)
    fact("it dissipates, on several triangles", lost > 0.1 and sum(abs(e) > 1e-6 for e in found) >= 2, (lost, found))
    at_most("by triangle as of the mesh", abs(math.fsum(found) - lost) / lost, 1e-12)


# ---- nodes that move ---------------------------------------------------------------------

CUTS = 4    # of a membrane of 2 x 2, along each side
PLACES = [(-1 + 2 * i / CUTS, -1 + 2 * j / CUTS) for i in range(CUTS + 1) for j in range(CUTS + 1)]
MEMBRANE = lmp.head("-3 3 -3 3 -3 3", types=2) + """\
create_atoms    1 single -0.3 -0.4 -0.21 units box
create_atoms    1 single 0.45 0.1 -0.22 units box
create_atoms    1 single -0.1 0.55 -0.3 units box
""" + "".join(f"create_atoms    2 single {x} {y} 0 units box\n" for x, y in PLACES) + f"""\
set             type 1 diameter 0.4 mass 0.8
set             type 2 diameter 0.01 mass {10 / len(PLACES)}
group           nodes type 2
group           grains type 1
velocity        nodes set 0 0 -1
velocity        grains set 3 0.8 0
""" + lmp.pairs("zero 1.0") + """\
timestep        1e-3
fix             m nodes {nodes}
fix             s grains nve/sphere
fix             wall grains wall/lsdcd granular hooke 1e3 5 damping mass_velocity tangential linear_history 300 1 0.3 rolling sds 5 0.01 0.05 &
                mesh membrane.stl {moves} impacts 0.02 {words}
thermo_style    custom step c_thermo_temp c_thermo_temp {columns}
thermo_modify   format float %.17g norm no
thermo          1000000
{run}
"""
BOOKED = f"energy {FILES}"


def on_membrane(folder, run, ranks=1, moves="nodes nodes", nodes="nve", words=BOOKED, script=MEMBRANE):
    """The last row, fields and spectrum after 200 steps."""
    stl.write(folder / "membrane.stl", stl.sheet(CUTS, lambda i, j: (*PLACES[i * (CUTS + 1) + j], 0)))
    columns = COLUMNS if "energy" in words else [COUNT] * len(COLUMNS)
    out = lmp.run_well(script.format(moves=moves, nodes=nodes, words=words, run=run, columns=f"{COUNT} {ENERGY} {' '.join(columns)}"), folder, ranks)
    return row_of(out, ("impacts", "energy", *NAMES)), fields(folder, 200), spectrum(folder, 200)


def test_membrane(folder):
    """Three spheres that hit a membrane of free nodes and slide on it: the first contact of each is an impact of m v^2/2 with the speed of both along the
    normal; triangles have what contacts dissipate, and impacts, in all as the mesh; 4 processes and a restart in the middle change nothing, nor does it
    change impacts that no energy is booked."""
    whole = row, found, rows = on_membrane(folder, "run 100\nrun 100")
    fact("all are hit", row["impacts"] >= 3 and row["slider"] > 1e-3, row)
    at_most("the first ones have the speed that was set", abs(max(found["impact_speed"]) - 1), 1e-12)
    lost, total = sum(row[c] for c in CAUSES), sums(found)
    fact("several triangles", sum(e > 1e-4 for e in found["dissipated_energy"]) >= 4, found["dissipated_energy"])
    at_most("dissipated by triangle", abs(total["dissipated_energy"] - lost) / lost, 1e-12)
    at_most("impacts by triangle", abs(total["impacts"] - row["impacts"]), 1e-12)
    at_most("their energy by triangle", abs(total["impact_energy"] - row["energy"]) / row["energy"], 1e-12)
    at_most("energy by bin", abs(math.fsum(r[3] for r in rows) - row["energy"]) / row["energy"], 1e-12)
    same("4 processes", on_membrane(folder, "run 100\nrun 100", 4), whole)
    alone = on_membrane(folder, "run 100\nrun 100", words=FILES)
    fact("without books the same impacts", alone[0]["impacts"] == row["impacts"] and alone[2] == rows)
    lmp.run_well(MEMBRANE.format(moves="nodes nodes", nodes="nve", words=BOOKED, run="run 100\nwrite_restart half.restart", columns=COUNT), folder)
    lines = MEMBRANE.splitlines(keepends=True)
    first = next(k for k, line in enumerate(lines) if line.startswith("pair_style"))
    again = "atom_modify map array\nread_restart half.restart\ncomm_modify vel yes\n" + "".join(lines[first:])
    for ranks in (1, 4):
        same(f"restarted on {ranks}", on_membrane(folder, "run 100", ranks, script=again), whole)


def test_membrane_as_one_mesh(folder):
    """Nodes that all move alike are a mesh with a motion: each triangle has the same."""
    a, b = (on_membrane(folder, "run 200", nodes="move linear 0.3 0 -1 units box", moves=moves) for moves in ("nodes nodes", "motion linear 0.3 0 -1"))
    fact("it is hit", b[0]["impacts"] >= 3 and b[0]["work"] > 0.1, b[0])
    fact("as many impacts", a[0]["impacts"] == b[0]["impacts"])
    for field, size in (("dissipated_energy", b[0]["work"]), ("impacts", 1), ("impact_energy", b[0]["energy"]), ("impact_speed", 1)):
        at_most(f"{field} of each triangle", max(abs(x - y) for x, y in zip(a[1][field], b[1][field])) / size, 1e-11)


# ---- many spheres, processes and restart -------------------------------------------------

WORDS = f"energy impacts 0.02 {FILES}"


def roll(folder, steps, run, ranks=1, script=ALONE, words=WORDS):
    dt = math.pi * math.sqrt(MASS / MILL_K) / 50
    text = script.replace("periodic energy", f"periodic {words}")
    out = lmp.run_well(text.format(law=MILL_LAW, dt=repr(dt), columns=f"{COUNT} {ENERGY} {' '.join(COLUMNS)}", run=run.format(n=steps)), folder, ranks)
    return row_of(out, ("impacts", "energy", *NAMES)), fields(folder, 2 * steps), spectrum(folder, 2 * steps)


def same(name, a, b):
    at_most(f"{name}: rows", max(abs(a[0][k] - b[0][k]) for k in ("impacts", "energy", *CAUSES)) / b[0]["work"], 1e-12)
    fact(f"{name}: number of impacts", a[0]["impacts"] == b[0]["impacts"])
    for field, size in (("dissipated_energy", b[0]["work"]), ("impacts", b[0]["impacts"]), ("impact_energy", b[0]["energy"]), ("impact_speed", 1)):
        at_most(f"{name}: {field} of each triangle", max(abs(x - y) for x, y in zip(a[1][field], b[1][field])) / size, 1e-12)
    fact(f"{name}: the numbers of the spectrum", [r[:3] for r in a[2]] == [r[:3] for r in b[2]])
    at_most(f"{name}: its energies", max(abs(x[3] - y[3]) for x, y in zip(a[2], b[2])) / b[0]["energy"], 1e-12)


def test_mill(folder):
    """Sums by triangle and by bin are those of the mesh; they are the same on 4 processes and after a restart in the middle."""
    mill(folder / "mill.stl")
    steps = 2000
    whole = roll(folder, steps, "run {n}\nrun {n}")
    row, found, rows = whole
    fact("there are impacts", row["impacts"] > 100 and len(rows) > 5, row)
    total = sums(found)
    at_most("dissipated by triangle", abs(total["dissipated_energy"] - sum(row[c] for c in CAUSES)) / row["work"], 1e-12)
    at_most("impacts by triangle", abs(total["impacts"] - row["impacts"]) / row["impacts"], 1e-12)
    at_most("their energy by triangle", abs(total["impact_energy"] - row["energy"]) / row["energy"], 1e-12)
    fact("impacts by bin", math.fsum(r[2] for r in rows) == row["impacts"])
    at_most("energy by bin", abs(math.fsum(r[3] for r in rows) - row["energy"]) / row["energy"], 1e-12)
    fact("a bin has what its borders allow", all(r[2] * r[0] <= r[3] * (1 + 1e-12) and r[3] <= r[2] * r[1] * (1 + 1e-12) for r in rows))
    same("4 processes", roll(folder, steps, "run {n}\nrun {n}", 4), whole)
    alone = roll(folder, steps, "run {n}\nrun {n}", words=f"impacts 0.02 {FILES}", script=ALONE.replace("{columns}", f"{COUNT} {ENERGY}"))
    fact("without books the same impacts", alone[0]["impacts"] == row["impacts"] and alone[2] == rows)


def test_restart(folder):
    """After a restart in the middle all is as without, on 1 and 4 processes."""
    mill(folder / "mill.stl")
    steps = 2000
    whole = roll(folder, steps, "run {n}\nrun {n}")
    roll_half = ALONE.replace("{run}", "run {run}\nwrite_restart half.restart")
    dt = math.pi * math.sqrt(MASS / MILL_K) / 50
    lmp.run_well(roll_half.replace("periodic energy", f"periodic {WORDS}").format(law=MILL_LAW, dt=repr(dt), columns=" ", run=steps), folder)
    lines = ALONE.splitlines(keepends=True)
    first = next(k for k, line in enumerate(lines) if line.startswith("pair_style"))
    again = "read_restart half.restart\ncomm_modify vel yes\n" + "".join(lines[first:])
    for ranks in (1, 4):
        same(f"restarted on {ranks}", roll(folder, steps, "run {n}", ranks, again), whole)
