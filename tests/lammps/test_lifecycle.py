# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Atoms that move in memory and between processes, arrive, grow and change their mass, and what
the wall keeps of them, in runs and between them."""

import math
import os
import pathlib
import re
import subprocess
import sys

import pytest

import lmp
import scene
import stl
from facts import at_most, fact

FORCES = lmp.pairs()
HOOKE = "hooke 1e4 NULL 20 NULL 0.1 1"
HISTORY = "hooke/history 1e4 NULL 20 NULL 0.4 1"
BUMPS = "mesh bumps.stl"
COLUMNS = " ".join(f"f_wall[{k}]" for k in range(1, 9))
# glibc looks behind every block that is freed.
CHECKED_HEAP = {"LD_PRELOAD": "libc_malloc_debug.so.0", "MALLOC_CHECK_": "3"}
ROWS = f"write_dump all custom {{}} id {COLUMNS} modify format float %.17g sort id\n"


def head(vary=""):
    return lmp.head("-4 4 -4 4 -1 5", style=f"sphere {vary}", modify="map array sort 0 0", types=2, more="processors * 1 1\n")


def rows_of(folder, name):
    return next(iter(lmp.read_dump(folder / name).values()))


def write_plates(path, n, centre, distance):
    """n small triangles around a point, each a place of its own where a sphere there touches."""
    golden = math.pi * (3 - math.sqrt(5))
    triangles = []
    for i in range(n):
        z = 1 - (2 * i + 1) / n
        s = math.sqrt(1 - z * z)
        out = (s * math.cos(golden * i), s * math.sin(golden * i), z)
        flat = math.hypot(out[0], out[1])
        u = (-out[1] / flat, out[0] / flat, 0)
        v = (-z * u[1], z * u[0], out[0] * u[1] - out[1] * u[0])
        triangles.append([])
        for k in range(3):
            a, b = 0.002 * math.cos(2.1 * k), 0.002 * math.sin(2.1 * k)
            triangles[i].append([c + distance * o + a * x + b * y for c, o, x, y in zip(centre, out, u, v)])
    stl.write(path, triangles)


def prepare(folder):
    lmp.flat_floor(folder)
    scene.write_floor(folder / "bumps.stl")


def test_rows_follow(folder):
    """The contacts array after LAMMPS has moved atoms in memory or to another process."""
    body = head() + """\
create_atoms 1 single -1.0 0 0.45 units box
create_atoms 1 single -1.5 2 3.00 units box
create_atoms 1 single -2.0 -2 0.48 units box
set group all diameter 1.0 density 2.0
group one id 1
""" + FORCES + f"fix wall all wall/lsdcd {HOOKE} mesh floor.stl contacts\nrun 0\n"
    body += ROWS.format("before")
    lmp.run_well(body + "delete_atoms group one compress no\n" + ROWS.format("after"), folder)
    before, after = rows_of(folder, "before"), rows_of(folder, "after")
    # Overlaps of 0.05 and 0.02: 500 and 200.
    fact("contacts rows: what they are of", math.isclose(before[1][3], 500, rel_tol=1e-12))
    del before[1]
    fact("contacts rows follow atoms when one is deleted", after == before,
         f"atom 2 has {after[2][3]:g}, atom 3 has {after[3][3]:g}")
    lmp.run_well(body + "displace_atoms all move 3 0 0\n" + ROWS.format("after"), folder, 2)
    before, after = rows_of(folder, "before"), rows_of(folder, "after")
    fact("contacts rows follow atoms to another process", after == before,
         f"atom 1 has {after[1][3]:g}, atom 3 has {after[3][3]:g}")


def test_rows_are_read(folder):
    """Another fix reads the array before the wall writes it: the rows of the last step."""
    start = scene.SETTINGS.replace("sort 40 1.5", "sort {} 1.5")
    lmp.run_well(scene.CREATE + "write_data start.data\n", folder)
    moves, letter = {}, lmp.column()
    for name, every, ranks in (("unsorted", 0, 1), ("sorted", 1, 1), ("spread", 0, 4)):
        body = (start.format(every) + "read_data start.data\n" +
                scene.forces(scene.GRANULAR, BUMPS))
        # The push comes before the wall in the order of fixes.
        body = body.replace("fix             wall ", "fix             push all addforce v_px 0 0\n"
                                                     "fix             wall ")
        body = body.replace("pair_style", f"variable        px atom 0.1*{letter}_wall[2]\npair_style", 1)
        lmp.run_well(body + scene.dump("moves", 100) + "run 1000\n", folder, ranks)
        moves[name] = lmp.read_dump(folder / "moves")
    for name in ("sorted", "spread"):
        at_most(f"a fix that reads contacts rows before the wall: {name} as unsorted",
                lmp.largest_difference(moves["unsorted"], moves[name]), 0)


def test_crowded_migrates(folder):
    """One sphere with 500 springs goes to another process outside of a run, and back."""
    write_plates(folder / "plates.stl", 500, (-1, 0, 2), 0.49)
    walls = "fix wall{} all wall/lsdcd {} mesh plates.stl corner sum contacts\n"
    # After run 0 the springs are those that LAMMPS asked for room for.
    for n_walls, law, runs in ((1, HISTORY, "run 1"), (2, HISTORY, "run 1\nrun 0"),
                               (1, scene.GRANULAR, "run 1")):
        walls = "".join(f"fix wall{k} all wall/lsdcd {law} mesh plates.stl corner sum contacts\n"
                        for k in range(n_walls))
        body = head() + """\
create_atoms 1 single -1.0 0 2.0 units box
set group all diameter 1.0 density 2.0
velocity all set 30 20 10
""" + FORCES + "fix move all nve/sphere\n" + walls + "timestep 1e-5\nthermo_style custom step " + \
            " ".join(f"f_wall{k} f_wall{k}[7]" for k in range(n_walls)) + \
            "\nthermo_modify format float %.17g norm no\n" + runs + "\n"
        stays = lmp.read_thermo(lmp.run_well(body + "run 0\n", folder))[-1]
        name = f"{n_walls} of {law.split()[0]}, {runs.split()[-1]}"
        fact(f"{name}: 500 springs", stays[2] == 500, str(stays[2]))
        try:
            there_and_back = "displace_atoms all move 3 0 0\ndisplace_atoms all move -3 0 0\n"
            done = lmp.run(body + 3 * there_and_back + "run 0\n", folder, 2, timeout=60,
                           env=CHECKED_HEAP)
            moved = [] if done.returncode else lmp.read_thermo(done.stdout)[-1]
        except subprocess.TimeoutExpired:    # Open MPI waits for the heap that glibc found broken
            moved = []
        # The energy of springs, too; displacing rounds.
        fact(f"{name}: they move to another process and back", moved and all(
            math.isclose(a, b, rel_tol=1e-9) for a, b in zip(stays, moved)), f"{stays} and {moved}")


def test_read_without_atoms(folder):
    """A restart file read where most processes get no atom."""
    create = scene.CREATE.replace("block -5 5 -5 5", "block -5 5 -5 -2")
    more = "run 200\nwrite_restart few.restart\n"
    lmp.run_well(create + scene.forces(HISTORY, BUMPS) + more + scene.dump("two", 50) +
                 "run 200\n", folder)
    two = lmp.read_dump(folder / "two")
    for ranks in (2, 4):
        done = lmp.run(scene.SETTINGS + "processors 1 * 1\nread_restart few.restart\n" +
                       scene.forces(HISTORY, BUMPS) + scene.dump("continued", 50) + "run 200\n",
                       folder, ranks)
        name = f"springs read on {ranks} ranks, of which some have no atoms"
        if done.returncode:
            fact(name, False, done.stdout[-300:])
        else:
            continued = lmp.read_dump(folder / "continued")
            at_most(name, lmp.largest_difference(two, continued), 0)
    springs = sum(row[9] > 0 for row in two[200].values())
    text = lmp.run_well(scene.SETTINGS + "read_restart few.restart\n" + scene.forces(HOOKE, BUMPS) +
                        "run 0\n", folder, 2)
    found = re.search(r"(\d+) atoms lose their springs: the restart file was written with a different "
                      "contact law", text)
    fact("a law without springs: says how many atoms lose theirs",
         found and int(found.group(1)) == springs > 0, f"{springs} touch, " +
         (found.group(0) if found else "no warning"))


ONE = """\
create_atoms 1 single 0.3 0.2 0.55 units box
set group all diameter {} density 2.0
velocity all set 1.0 -0.7 -1.3
"""


def as_wall_gran(folder, name, body, law=HISTORY):
    """The script with WALL in place of the wall, whose dump is 'moves', beside LAMMPS's plane."""
    dumps = []
    for wall in (lmp.flat_walls(f"fix wall all wall/gran {law} zplane 0 NULL"), f"fix wall all wall/lsdcd {law} mesh floor.stl\n"):
        done = lmp.run(body.replace("fix wall all WALL\n", wall), folder)
        if done.returncode:
            fact(name, False, re.search(r"ERROR.*|$", done.stdout).group(0))
            return ""
        dumps.append(lmp.read_dump(folder / "moves"))
    touched = sum(abs(row[k][11]) > 0 for row in dumps[0].values() for k in row)
    fact(f"{name}: touches the floor", touched > 20, f"{touched} times")
    # Rounding of 1e-16 per operation over up to 10^4 of them, as in test_parity.
    at_most(name, lmp.largest_difference(*dumps), 1e-12)
    return done.stdout


DUMP = """\
dump moves all custom 5 moves id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz
dump_modify moves format float %.17g sort id
timestep 1e-4
"""


def test_radii_grow(folder):
    """Against fix wall/gran, which knows no grid."""
    grow = "variable d equal 1.0+0.5*step/1500\nfix grow all adapt 10 atom diameter v_d mass yes\n"
    wall = "fix wall all WALL\n"
    begin = ONE.format(1.0) + FORCES + "fix move all nve/sphere\n"
    if lmp.DEVICE_MOVES:    # which fix wall/gran does not allow
        return
    for first in ("run 300", "run 0"):    # after run 0 the run begins where that one was set up
        as_wall_gran(folder, f"{first}, set diameter and run pre no: as with wall/gran", head() +
                     begin + wall + DUMP + first + "\nset group all diameter 1.4\nrun 300 pre no\n")
    if lmp.ON_KOKKOS:
        return    # Kokkos's atom_style sphere has no radii that vary
    for name, fixes in (("before", grow + wall), ("after", wall + grow)):
        text = as_wall_gran(folder,
                            f"fix adapt {name} the wall: radii grow as with wall/gran",
                            head("1") + begin + fixes + DUMP + "run 1500\n")
    # 10 % each time from 0.5 past 0.75: 1.1^5 = 1.61.
    fact("the log tells of each grid", text.count("larger grains, grid rebuilt") == 5,
         str(text.count("larger grains, grid rebuilt")))


@pytest.mark.skipif(lmp.ON_KOKKOS, reason="the hosts have no RIGID")
def test_masses_change(folder):
    """Fix adapt shrinks a sphere that damping sees, beside a rigid body."""
    as_wall_gran(folder, "masses beside a rigid body: as with wall/gran", head("1") +
                 ONE.format(1.4) + """\
create_atoms 1 single -2.69 0.22 0.505 units box
create_atoms 1 single -2.19 0.42 0.905 units box
group body id 2 3
set group body diameter 1.0 density 2.0
velocity body set 1.0 -0.7 -1.3
group free subtract all body
""" + FORCES + """\
neigh_modify exclude group body body
fix stiff body rigid single
fix move free nve/sphere
variable d equal 1.4-0.5*step/1500
fix shrink free adapt 10 atom diameter v_d mass yes
fix wall all WALL
""" + DUMP + "run 1500\n")


def test_inserted_atoms_are_checked(folder):
    """A sphere of radius 0.5 put at z = 0.3 over the plane z = 0 overlaps by 40 %."""
    body = (head() + FORCES + "fix move all nve/sphere\n" +
            f"fix wall all wall/lsdcd {HOOKE} mesh floor.stl\n")
    said = re.compile(r"atom (\d+) appeared inside the wall, which it overlaps by (\S+) % of its radius 0.5 in step (\d+)")

    def put(z, x=0):
        return f"create_atoms 1 single {x} 0 {z} units box\nset group all diameter 1.0 density 2.0\n"

    text = lmp.run_well(body + put(2) + "run 5\n" + put(0.3, 1.5) + "run 5\n" + put(0.35, -1.5) + "run 5\n" +
                        put(0.2, 2.5) + "run 5\n", folder)
    fact("spheres put into the wall are told, again where deeper",
         said.findall(text) == [("2", "40", "5"), ("4", "60", "15")], str(said.findall(text)))
    text = lmp.run_well(body + put(0.3) + "run 0\nwrite_restart in.restart\n", folder)
    fact("and where a run begins", said.findall(text) == [("1", "40", "0")], str(said.findall(text)))
    again = body[body.index(FORCES):] + "reset_timestep 0\nrun 0\n"
    for law in (HOOKE, HISTORY):
        lmp.run_well(body.replace(HOOKE, law) + put(0.3) + "run 1\nwrite_restart in.restart\n", folder)
        text = lmp.run_well(scene.SETTINGS + "read_restart in.restart\n" + again.replace(HOOKE, law), folder)
        fact("a run that goes on from a restart file at step 0 is not a new one", not said.findall(text) and
             "atom 1 sank into the wall" in text, str(said.findall(text)))
    text = lmp.run_well(body + put(0.48) + "fix g all gravity 8.0 vector 0 0 -1\n" + put(3, 1) +
                        "velocity all set 0 0 -9\nrun 600\n", folder)
    fact("one that falls in is not", "sank into the wall" in text and not said.findall(text))
    fact("and its radius is told", re.search(r"sank into the wall by \S+ % of its radius 0.5 in step", text))
    # Both are in the wall, and only the deeper one is told; then one more falls in.
    both = body + put(0.3) + put(0.32, 1.5) + "timestep 0.001\n"
    text = lmp.run_well(both + "run 100\n", folder)
    fact("spheres that were put into the wall have not sunk", len(said.findall(text)) == 1 and
         "sank" not in text)
    text = lmp.run_well(both + "run 100\nvelocity all set 0 0 -40\nrun 80\n", folder)
    fact("once they were out they may", "sank into the wall" in text)
    if lmp.ON_KOKKOS:    # which has no fix deposit
        return
    text = lmp.run_well(body + """\
region low block -2 2 -2 2 0.3 0.3000001 units box
fix in all deposit 3 1 20 4711 region low near 1.2
timestep 0.0005
run 60
""", folder, 2)
    fact("spheres of fix deposit too, on 2 ranks", [t[1] for t in said.findall(text)] == ["40"],
         str(said.findall(text)))


def test_timestep_is_checked(folder):
    """Contact times pi sqrt(m / kn): 0.0321 at a diameter of 1, 0.0114 at 0.5."""
    body = (head() + FORCES + "fix move all nve/sphere\n" +
            f"fix wall all wall/lsdcd {HOOKE} mesh floor.stl\n")
    said = re.compile(r"timestep \S+ is more than a tenth of the shortest contact time (\S+)")

    def times(text):
        return [float(word.rstrip(":")) for word in said.findall(text)]

    if not lmp.ON_KOKKOS:    # which has no fix pour
        found = times(lmp.run_well(body + "fix g all gravity 8.0 vector 0 0 -1\n" + """\
region slab block -3 3 -3 3 1 4 units box
fix pour all pour 12 1 4711 region slab diam one 1.0 dens 2.0 2.0 vol 0.25 100
timestep 0.004
run 300
""", folder))
        fact("timestep: warned of once when the first spheres are poured",
             len(found) == 1 and math.isclose(found[0], 0.0321, rel_tol=0.01), str(found))
    more = """\
create_atoms 1 single 0 0 2 units box
set group all diameter 1.0 density 2.0
timestep 0.002
run 5
create_atoms 2 single 1 1 2 units box
set type 2 diameter 0.5 density 2.0
run 5
run 5
"""
    found = times(lmp.run_well(body + more, folder))
    fact("timestep: warned of once for a smaller sphere that comes later",
         len(found) == 1 and math.isclose(found[0], 0.0114, rel_tol=0.01), str(found))


@pytest.mark.skipif("LSDCD_TWO_NODES" not in os.environ, reason="no LSDCD_TWO_NODES")
def test_full_node(folder):
    """Memory for the grid that the second of two nodes has not."""
    body = (head() + ONE.format(1.0) + FORCES +
            f"fix wall all wall/lsdcd {HOOKE} mesh floor.stl grid 0.05\nrun 0\n")
    try:
        done = lmp.run(body, folder, 2, timeout=30,
                       env={"LD_PRELOAD": os.environ["LSDCD_TWO_NODES"], "LSDCD_FULL_NODE": "1"})
        text = re.search(r"ERROR.*|$", done.stdout).group(0)
        ended = done.returncode != 0
    except subprocess.TimeoutExpired:
        ended, text = False, "waits forever"
    fact("no memory on one node: both stop and say so",
         ended and "ERROR: " in text and "out of memory for the wall grid" in text, text)


REFUSED = """\
import ctypes, sys
library, plugin = sys.argv[1:]
lammps = ctypes.CDLL(library, ctypes.RTLD_GLOBAL)
lammps.lammps_open_no_mpi.restype = ctypes.c_void_p
words = [b"lmp", b"-log", b"none", b"-nocite", b"-screen", b"none"]
words = (ctypes.c_char_p * len(words))(*words)
me = ctypes.c_void_p(lammps.lammps_open_no_mpi(len(words), words, None))
text = ctypes.create_string_buffer(1000)
for line in ["plugin load " + plugin] + sys.stdin.read().replace("&\\n", "").split("\\n"):
    lammps.lammps_command(me, line.encode())
    if lammps.lammps_has_error(me):
        lammps.lammps_get_last_error_message(me, text, 1000)
        print(text.value.decode())
print("went on to the end")
"""


@lmp.needs_host
@pytest.mark.skipif(lmp.ON_KOKKOS, reason="once is enough")
def test_refused(folder):
    """A LAMMPS that goes on after an error calls no wall that it has refused."""
    body = head().replace("sort 0 0", "sort 1 1.0") + ONE.format(1.0) + FORCES + f"""\
fix move all nve/sphere
fix wall all wall/lsdcd {HISTORY} mesh floor.stl move 100 0 0
run 1
"""
    library = pathlib.Path(lmp.HOST).parent / "liblammps.so.0"
    done = subprocess.run([sys.executable, "-c", REFUSED, library, lmp.PLUGIN],
                          cwd=folder, input=body, text=True, env=lmp.environment(),
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60)
    said = done.stdout
    fact("a refused wall: LAMMPS says so", "the mesh is outside the box" in said, said[-200:])
    fact("a refused wall: LAMMPS goes on without it",
         "went on to the end" in said and said.count("ERROR") == 1, said[-200:])
