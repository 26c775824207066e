# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Files that the fix writes every N steps: read by other programs' means, and where they cannot be
written."""

import math
import struct

import numpy

import lmp
import scene
import stl
import vtp
from facts import at_most, fact
from triangles import turn

LAW = "hooke/history 1e4 NULL 120 NULL 0.4 1"
SOFT = "hooke 1e-9 NULL 0 NULL 0 0"    # spheres do not notice the mesh, however it moves
TURN = "motion rotate 0.3 0.1 0.7 1 2 2 0.8"
RATE = 2 * math.pi / 0.8
FIELDS = "mesh_fields {} every 100"

prepare = scene.bumpy_floor


def turned(points, time):
    """By TURN."""
    about = numpy.array((0.3, 0.1, 0.7))
    return ((numpy.reshape(points, (-1, 3)) - about) @ turn((1, 2, 2), RATE * time).T + about).ravel()


def apart(a, b):
    assert len(a) == len(b)
    return max(abs(u - v) for u, v in zip(a, b))


def go(folder, words, run, begin=scene.CREATE, ranks=1):
    law = SOFT if "motion" in words else LAW
    return lmp.run_well(begin + scene.forces(law, mesh="mesh floor.stl " + words) + run, folder, ranks)


def test_series(folder):
    (folder / "out").mkdir()
    go(folder, f"{TURN} {FIELDS.format('out/a&b_*.vtp')}", "run 150\nrun 250\n", ranks=2)
    rows = vtp.listed(folder / "out" / "a&b_series.pvd")
    fact("the list has every file once, also of two runs",
         [f for _, f in rows] == [f"a&b_{k}.vtp" for k in (100, 200, 300, 400)], str(rows))
    # Sums of 0.001 round by 1e-16 each.
    at_most("with its time", max(abs(t - 0.1 * (k + 1)) for k, (t, _) in enumerate(rows)), 1e-13)
    go(folder, FIELDS.format("still.vtp"), "run 100\n")
    fact("a name without a star makes no list", not list(folder.glob("still*.pvd")))
    first = vtp.read(folder / "still.vtp")
    for time, name in rows:
        now = vtp.read(folder / "out" / name)
        # Rounding of places of size 10 in a few operations.
        at_most(f"{name}: points are where the mesh has turned to",
                apart(now["points"], turned(first["points"], time)), 1e-13)
        fact(f"{name}: with the triangles of the mesh", now["connectivity"] == first["connectivity"])
        fact(f"{name}: and the time of the list", now["TimeValue"] == [time])


def test_forces(folder):
    """Of triangles, against the totals, which the engine sums over spheres."""
    scene.write_floor(folder / "coarse.stl", cells=6)
    words = f"mesh coarse.stl move 0 0 0.3 motion rotate 0 0 0 1 2 2 20 mesh_fields v_*.vtp every 1"
    rows = lmp.read_thermo(lmp.run_well(
        scene.CREATE + scene.forces(LAW, mesh=words) + "thermo_style custom step f_wall[1] f_wall[2] f_wall[3]\n"
        "thermo_modify norm no format float %.17g\nthermo 1\nrun 120\n", folder))
    worst, size = 0, max(abs(v) for row in rows for v in row[1:])
    for step, *total in rows[1:]:
        force = vtp.read(folder / f"v_{step:g}.vtp")["force"]
        worst = max(worst, *(abs(sum(force[d::3]) - total[d]) for d in range(3)))
    fact("forces on the coarse floor act along all axes",
         all(max(abs(row[1 + d]) for row in rows) > 1 for d in range(3)))
    # Sums of up to 100 contacts, in another order and turned.
    at_most("forces of triangles of a turning mesh sum to the force on it", worst / size, 1e-13)


def test_units_of_stress(folder):
    """A force on one of two triangles of 18 square Angstroms, in bar: LAMMPS has 1.6021765e6 of these an eV/Angstrom^3."""
    stl.write(folder / "square.stl", stl.square(3))
    text = lmp.head("-3 3 -3 3 -1 5", units="metal") + "create_atoms 1 single 0.3 0.2 0.49 units box\nset group all diameter 1 density 2\n" + \
        lmp.pairs() + "fix move all nve/sphere\nfix wall all wall/lsdcd hooke 1 NULL 0 NULL 0 0 mesh square.stl mesh_fields m.vtp every 1\n" \
        "thermo_style custom step f_wall[3]\nthermo_modify format float %.17g norm no\nthermo 1\nrun 1\n"
    force = lmp.read_thermo(lmp.run_well(text, folder))[1][1]
    stress = [s for s in vtp.read(folder / "m.vtp")["normal_stress"] if s]
    fact("one triangle carries it", len(stress) == 1 and force < -0.005, str((stress, force)))
    at_most("in the unit of pressure", abs(stress[0] / (-force / 18 * 1.602176634e6) - 1), 1e-7)


def same(a, b):
    """Times are sums in another order."""
    return [f for _, f in a] == [f for _, f in b] and all(abs(t - u) < 1e-13 for (t, _), (u, _) in zip(a, b))


def test_continued(folder):
    words = f"{TURN} {FIELDS.format('c_*.vtp')}"
    go(folder, words, "run 250\nwrite_restart c.restart\nrun 250\n")
    whole = vtp.listed(folder / "c_series.pvd")
    again = scene.SETTINGS + "read_restart c.restart\n"
    go(folder, words, "run 100\n", again)
    fact("a run that goes back takes later files off the list",
         same(vtp.listed(folder / "c_series.pvd"), whole[:3]), str(vtp.listed(folder / "c_series.pvd")))
    go(folder, words, "run 250\n", again)
    fact("and one that goes on lists the earlier ones", same(vtp.listed(folder / "c_series.pvd"), whole))
    go(folder, words, "run 100\n")
    fact("a new run begins a new list", same(vtp.listed(folder / "c_series.pvd"), whole[:1]))


L_FLOOR = {
    "obj": "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n",
    "off": "OFF\n6 1 0\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n6 0 1 2 3 4 5\n",
    "ply": "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
           "property list uchar int vertex_indices\nend_header\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n6 0 1 2 3 4 5\n",
}
ON_L = lmp.head("-1 3 -1 3 -1 1", units="si") + """\
create_atoms 1 single 0.4 0.4 0.095
create_atoms 1 single 1.25 1.25 0.095
create_atoms 1 single 1.7 1.7 0.095
set group all diameter 0.2 density 2500
fix w all wall/lsdcd hooke 1000 NULL 0 0 0 0 mesh {}
fix m all nve/sphere
dump d all custom 1 forces.dump id fz
dump_modify d sort id
run 0
"""


def test_concave(folder):
    """One face of the shape L: a grain over its notch is not pushed, one over its corner by stiffness times overlap."""
    for ending, text in L_FLOOR.items():
        (folder / f"l.{ending}").write_text(text)
        lmp.run_well(ON_L.format(f"l.{ending}"), folder)
        forces = [atom[0] for atom in lmp.read_dump(folder / "forces.dump")[0].values()]
        fact(f"a grain over the notch of an L is not pushed: {ending}",
             abs(forces[0] - 5) < 1e-9 and forces[1:] == [0, 0], str(forces))


def test_stl(folder):
    go(folder, f"{TURN} mesh_stl s_*.stl every 40 mesh_fields s_*.vtp every 60", "run 130\n")
    names = {p.name for p in folder.glob("s_*")}
    fact("two files of the fix, each every so many steps", names == {
        "s_40.stl", "s_80.stl", "s_120.stl", "s_60.vtp", "s_120.vtp", "s_series.pvd"}, str(sorted(names)))
    field = vtp.read(folder / "s_120.vtp")
    corners = [field["points"][3 * c + d] for c in field["connectivity"] for d in range(3)]
    as_floats = list(struct.unpack(f"<{len(corners)}f", struct.pack(f"<{len(corners)}f", *corners)))
    fact("an STL of the mesh where it is", stl.points(folder / "s_120.stl") == as_floats)
    go(folder, "mesh_stl t.stl every 50", "run 50\n")
    lmp.run_well(scene.CREATE + scene.forces(LAW, mesh="mesh t.stl mesh_stl u.stl every 50") + "run 50\n", folder)
    fact("read again and written again it is the same file",
         (folder / "t.stl").read_bytes() == (folder / "u.stl").read_bytes())
    done = lmp.run(scene.CREATE + scene.forces(LAW, mesh="mesh floor.stl mesh_stl no/such.stl every 5") +
                   "run 10\n", folder)
    fact("mesh_stl into a missing folder stops before the run", done.returncode != 0 and
         "in 'mesh_stl', 'no/such.stl'" in done.stdout and "Step" not in done.stdout)
    text = on_full_disk(folder, 64, "mesh_stl t.stl every 50", "run 100\n")
    fact("mesh_stl on a full disk: one warning", len(lmp.mesh_warnings(text)) == 1 and
         "there is no mesh_stl of this step" in lmp.mesh_warnings(text)[0], str(lmp.mesh_warnings(text)))
    fact("and the older file as it was",
         (folder / "t.stl").read_bytes() == (folder / "u.stl").read_bytes())


def under_limit(folder, blocks):
    """LAMMPS where no file may grow past so many blocks of 512 bytes, as on a full disk."""
    path = folder / "limited.sh"
    program = lmp.HOST if lmp.ON_HOST else lmp.LMP
    path.write_text(f"#!/bin/sh\ntrap '' XFSZ\nulimit -f {blocks}\nexec '{program}' \"$@\"\n")
    path.chmod(0o755)
    return str(path)


def on_full_disk(folder, blocks, *args):
    name = "HOST" if lmp.ON_HOST else "LMP"
    program = getattr(lmp, name)
    limited = under_limit(folder, blocks)
    setattr(lmp, name, limited)
    try:
        return go(folder, *args)
    finally:
        setattr(lmp, name, program)


def test_not_written(folder):
    words = FIELDS.format("d_*.vtp")
    go(folder, words, "run 200\n")
    before = {p.name: p.read_bytes() for p in folder.glob("d_*")}
    size = len(before["d_100.vtp"]) // 512
    text = on_full_disk(folder, size // 2, words, "run 300\n")
    fact("a full disk: one warning, which says what is lost", len(lmp.mesh_warnings(text)) == 1 and
         "d_100.vtp" in lmp.mesh_warnings(text)[0] and "no mesh_fields of this step" in lmp.mesh_warnings(text)[0], str(lmp.mesh_warnings(text)))
    fact("and the run goes on to its end", "Loop time" in text)
    fact("older files are as they were, and nothing is beside them",
         {p.name: p.read_bytes() for p in folder.glob("d_*")} == before)

    # A folder that is away for a while.
    (folder / "e").mkdir()
    away = "run 100\nrun 200 pre no every 100 'shell mv e f'\nshell mv f e\nrun 100 pre no\n"
    text = go(folder, FIELDS.format("e/e_*.vtp"), away)
    fact("a folder that is gone: one warning", len(lmp.mesh_warnings(text)) == 1, str(lmp.mesh_warnings(text)))
    fact("files and list go on when it is back",
         [f for _, f in vtp.listed(folder / "e" / "e_series.pvd")] == ["e_100.vtp", "e_200.vtp", "e_400.vtp"])
    go(folder, FIELDS.format("g_*.vtp"), "run 100\nrun 100 pre no\nrun 200 pre no\n")
    a, b, c = (vtp.read(folder / n)["contacts"] for n in ("e/e_400.vtp", "g_300.vtp", "g_400.vtp"))
    # Sums of the same numbers in another order.
    at_most("what was not written is in the next average",
            apart([2 * v for v in a], [u + v for u, v in zip(b, c)]), 1e-12)


TETRAHEDRON = [[(0.6, 0.2, 1.5), (0.3, 0.2, 1.5), (0.3, 0.6, 1.5)], [(0.3, 0.2, 1.9), (0.3, 0.2, 1.5), (0.6, 0.2, 1.5)],
               [(0.3, 0.6, 1.5), (0.3, 0.2, 1.5), (0.3, 0.2, 1.9)], [(0.6, 0.2, 1.5), (0.3, 0.6, 1.5), (0.3, 0.2, 1.9)]]
GLASS = "units si\n{}material glass\n  youngs_modulus 5e7 Pa\n  poissons_ratio 0.25 1\npair glass glass\n  restitution 0.5 1\n  sliding_friction 0.5 1\n"
# The owner as a message names it, the keyword of the file, the file, and the line that reads it.
READERS = (
    ("region r", "mesh", "a.stl", "region r mesh/lsdcd a.stl"),
    ("compute c", "mesh", "a.stl", "compute c all lsdcd/collide wall mesh a.stl"),
    ("compute c", "atoms", "a.csv", "compute c all lsdcd/collide wall mesh b.stl atoms a.csv"),
    ("fix in", "mesh", "a.stl", "fix in all insert/lsdcd mesh a.stl diam one 0.1 dens 1 number 1"),
    ("fix n", "mesh", "a.stl", "fix n all massflow/lsdcd mesh a.stl"),
    ("fix w", "mesh", "a.stl", f"fix w all wall/lsdcd {SOFT} mesh a.stl"),
    ("fix w", "motion table", "a.csv", f"fix w all wall/lsdcd {SOFT} mesh b.stl motion table a.csv"),
    ("fix w", "material", "a.csv", "fix w all wall/lsdcd granular material a.csv glass mesh b.stl"),
    ("fix w", "material", "a.csv", "fix w all wall/lsdcd granular material b.lsdcd glass mesh b.stl"),
    ("pair_style granular/lsdcd", "material", "a.csv", "pair_style granular/lsdcd\npair_coeff * * law material a.csv glass"),
    ("pair_style granular/lsdcd", "material", "a.csv", "pair_style hybrid/overlay zero 1.0 granular/lsdcd\n"
     "pair_coeff * * zero\npair_coeff * * granular/lsdcd law material b.lsdcd glass"),
)


def test_inputs_stay(folder):
    """No output takes the place of a file that one of our styles reads."""
    begin = lmp.head("-3 3 -3 3 -1 5", modify="map array", units="si") + "".join(
        f"create_atoms 1 single {x} {y} {z} units box\n" for x, y, z in ((0.3, 0.2, 1.5), (0.6, 0.2, 1.5), (0.3, 0.6, 1.5), (0.3, 0.2, 1.9))) + \
        "set group all diameter 0.2 density 2.0\npair_style zero 1.0\npair_coeff * *\ntimestep 1e-5\n" + \
        f"fix wall all wall/lsdcd {SOFT} mesh floor.stl"
    contents = {"motion table": "0 0 0 0\n1 0 0 0\n", "material": GLASS.format(""), "atoms": "0.3 0.2 1.5\n0.6 0.2 1.5\n0.3 0.6 1.5\n0.3 0.2 1.9\n"}
    stl.write(folder / "b.stl", TETRAHEDRON)
    (folder / "b.lsdcd").write_text("units si\ninclude a.csv\n")
    for owner, what, name, line in READERS:
        if what == "mesh":
            stl.write(folder / name, TETRAHEDRON if line.startswith(("region", "compute", "fix w")) else TETRAHEDRON[:1])
        else:
            (folder / name).write_text(contents[what])
        before = (folder / name).read_bytes()
        fact(f"{owner}, {what}: reads the file", "Loop time" in lmp.run_well(f"{begin}\n{line}\nrun 1\n", folder))
        stl_or_csv = "mesh_stl" if name.endswith(".stl") else "impact_spectrum"
        for words in (f" {stl_or_csv} {name} every 1" + (" energy impacts 1e-3" if name.endswith(".csv") else ""),
                      f"\nfix flow all massflow/lsdcd mesh floor.stl file ./{name}"):
            lmp.refused(f"{words.split()[0]} as the {what} file of {owner}", f"{begin}{words}\n{line}\nrun 1\n", folder,
                        f"'{name}'" if words[0] == " " else f"'./{name}' is '{name}'", f"the {what} file that {owner} reads: name another file")
            fact("and the file stays", (folder / name).read_bytes() == before)
