# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The wall's part of the pressure (fix_modify virial yes), against LAMMPS's flat wall and a closed form."""

import math

import lmp
from facts import at_most, fact
from test_moving import write_plane

SCRIPT = lmp.SMALL_BOX + """\
{walls}
compute         p all pressure NULL fix
timestep        1e-3
thermo_style    custom step c_p[1] c_p[2] c_p[3] c_p[4] c_p[5] c_p[6]
thermo_modify   norm no format float %.17g
thermo          1
dump            d all custom 1 spheres id x y z fx fy fz
dump_modify     d format float %.17g sort id
run             {steps}
"""
VOLUME = 6.0 ** 3
BED = """\
lattice         sc 1.2 origin 0 0 0.5
region          fill block -2.5 2.5 -2.5 2.5 0.4 0.6 units box
create_atoms    1 region fill
displace_atoms  all random 0.05 0.05 0.05 4711 units box
velocity        all create 0.1 17 loop geom"""
MESH = "fix wall all wall/lsdcd {law} mesh plane.stl {more}\nfix_modify wall virial yes"
FLAT = "fix flat all wall/harmonic zlo 0.0 5e3 1.0 0.5\nfix_modify flat virial yes"
FRICTION = "hooke/history 1e4 NULL 5 NULL 0.5 1"


def go(folder, walls, atoms=BED, steps=20, ranks=1):
    text = lmp.run_well(SCRIPT.format(walls=walls, atoms=atoms, steps=steps), folder, ranks)
    return lmp.read_thermo(text), lmp.read_dump(folder / "spheres")


def largest(a, b):
    return max(abs(u - v) for row, other in zip(a, b) for u, v in zip(row[1:], other[1:]))


def prepare(folder):
    write_plane(folder / "plane.stl", 2)


def test_on_a_floor(folder):
    """The arm is (0, 0, z) over a floor at z = 0."""
    friction = MESH.format(law=FRICTION, more="")
    for ranks in (1, 2):
        thermo, dump = go(folder, friction, ranks=ranks)
        expected = [[row[0], 0, 0, sum(s[2] * s[5] for s in dump[int(row[0])].values()) / VOLUME, 0, 0, 0]
                    for row in thermo]
        fact(f"spheres push the wall, {ranks} ranks", min(row[3] for row in expected) > 0.01)
        # Pressures of size 1.
        at_most(f"arm times force on a floor, {ranks} ranks", largest(thermo, expected), 1e-12)


def test_against_flat_wall(folder):
    """A spring of kn is LAMMPS's harmonic wall with kn / 2: the same trajectory, so that pressures of
    size 1 differ by roundings."""
    if lmp.ON_KOKKOS:
        print("SKIPPED: fix wall/harmonic, which the LAMMPS with Kokkos is built without")
        return
    flat, _ = go(folder, FLAT)
    mesh, _ = go(folder, MESH.format(law="hooke 1e4 NULL 0 NULL 0 0", more=""))
    fact("spheres push LAMMPS's wall", min(row[3] for row in flat) > 0.01)
    at_most("pressure as of fix wall/harmonic", largest(mesh, flat), 1e-12)


def test_of_a_wall_that_turns(folder):
    """Arm h n, n being the wall's normal, times the force that the dump has."""
    period, atom = 5, "create_atoms 1 single -0.4 0.3 0.49 units box\nvelocity all set 1 2 0"
    thermo, dump = go(folder, MESH.format(
        law=FRICTION, more=f"motion rotate 0 0 0 0 1 0 {period}"), atom, 40)
    worst = shear = 0
    for row in thermo:
        (x, y, z, *f), = dump[int(row[0])].values()
        angle = 2 * math.pi * 1e-3 * row[0] / period
        normal = (math.sin(angle), 0, math.cos(angle))
        height = x * normal[0] + z * normal[2]
        r = [height * c for c in normal]
        expected = [r[0] * f[0], r[1] * f[1], r[2] * f[2], r[0] * f[1], r[0] * f[2], r[1] * f[2]]
        worst = max([worst] + [abs(p - e / VOLUME) for p, e in zip(row[1:], expected)])
        shear = max(shear, abs(row[4]))
    fact("friction gives shear", shear > 1e-3)
    # Forces of 100 are rounded to 1e-14, from heights to 1e-16 times the stiffness: 1e-12.
    at_most("arm times force where the wall turns", worst, 1e-12)


def test_is_asked_for(folder):
    quiet = MESH.format(law=FRICTION, more="").split("\n")[0]
    thermo, _ = go(folder, quiet, steps=3)
    at_most("no part of it where it is not asked for", max(abs(v) for row in thermo for v in row[1:]), 0)
    asked = "fix_modify wall virial yes\n"
    late = SCRIPT.format(walls=quiet, atoms=BED, steps=10) + asked + "run 10\n"
    early = SCRIPT.format(walls=quiet + "\n" + asked, atoms=BED, steps=10) + "run 10\n"
    rows = [lmp.read_thermo(lmp.run_well(text, folder)) for text in (late, early)]
    at_most("asked for between runs, the same bits", largest(*rows), 0)
