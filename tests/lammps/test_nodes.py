# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Meshes whose nodes are atoms: strings and pressures in closed form, momentum, ranks, restart, errors."""

import math

import lmp
import stl
from facts import at_most, fact

BEGIN = lmp.head(style="hybrid sphere bond", modify="map array sort {sort} 0.5", newton="on", comm="vel yes cutoff {reach}") + """\
read_data       in.data
group           nodes type 2 3
group           grains type 1
group           held type 3
group           loose type 2
""" + lmp.pairs("zero {reach}", 0.1) + """\
bond_style      {bonds}
special_bonds   lj 1 1 1
timestep        {dt}
"""


class Net:
    """A mesh with an atom at each vertex, bonds, and spheres: in.data and sheet.stl."""

    def __init__(self, lo, hi):
        self.lo, self.hi = lo, hi
        self.nodes, self.grains, self.bonds, self.faces = [], [], [], []

    def node(self, x, y, z, held, mass):
        self.nodes.append((x, y, z, 3 if held else 2, mass))
        return len(self.nodes) - 1

    def write(self, folder, skip=(), twice=()):
        """`skip`: nodes without an atom; `twice`: with two."""
        stl.write(folder / "sheet.stl", [[self.nodes[v][:3] for v in face] for face in self.faces])
        atoms = []    # of a node the diameter and density give its mass
        for k, (x, y, z, kind, mass) in enumerate(self.nodes):
            for _ in range(0 if k in skip else 2 if k in twice else 1):
                atoms.append((kind, x, y, z, 0.01, mass / (math.pi / 6 * 0.01**3)))
        for x, y, z, radius, mass in self.grains:
            atoms.append((1, x, y, z, 2 * radius, mass / (4 / 3 * math.pi * radius**3)))
        text = f"nodes and grains\n\n{len(atoms)} atoms\n3 atom types\n{len(self.bonds)} bonds\n1 bond types\n"
        text += "".join(f"{self.lo[d]} {self.hi[d]} {'xyz'[d]}lo {'xyz'[d]}hi\n" for d in range(3))
        text += "\nAtoms\n\n" + "".join(f"{i + 1} {kind} {x:.17g} {y:.17g} {z:.17g} {diameter:.17g} {density:.17g} 1\n"
                                        for i, (kind, x, y, z, diameter, density) in enumerate(atoms))
        if self.bonds:
            text += "\nBonds\n\n" + "".join(f"{i + 1} {kind} {a + 1} {b + 1}\n" for i, (kind, a, b) in enumerate(self.bonds))
        (folder / "in.data").write_text(text)


def begin(dt, reach, coefficients, sort=0):
    bonds = "harmonic" + "".join(f"\nbond_coeff {k + 1} {c / 2:.17g} 0" for k, c in enumerate(coefficients))
    return BEGIN.format(dt=dt, reach=reach, bonds=bonds if coefficients else "zero\nbond_coeff *", sort=sort)


# ---- a string under a weight -------------------------------------------------------------

TENSION, SPAN, WEIGHT = 50.0, 2.0, 1.0


def string(folder, n):
    """A strip of 2 n squares along x between held ends; bonds of length 0 when slack have T/2 each in all shapes."""
    net = Net((-1.5, -0.5, -0.5), (1.5, 0.5, 0.5))
    half = 0.1
    rows = [[net.node(SPAN * i / (2 * n) - SPAN / 2, y, 0, i in (0, 2 * n), 0.02) for i in range(2 * n + 1)] for y in (-half, half)]
    for i in range(2 * n):
        a, b, c, d = rows[0][i], rows[0][i + 1], rows[1][i + 1], rows[1][i]
        net.faces += [(a, b, c), (a, c, d)]
        net.bonds += [(1, a, b), (1, d, c)]
    net.grains.append((0, 0, 0.06, 0.06, 1.0))
    coefficients = [TENSION / 2 / (SPAN / (2 * n))]
    net.write(folder)
    return net, rows, coefficients


FALL = f"""\
fix             w grains wall/lsdcd hooke 2e4 0 0 0 0 0 mesh sheet.stl nodes nodes
fix             down grains gravity {WEIGHT} vector 0 0 -1
fix             slow all viscous 4
fix             hold held setforce 0 0 0
fix             turn grains nve/sphere
fix             go loose nve
"""


def test_sags(folder):
    """A weight in the middle of a string sags by W L/(4 T)."""
    wanted, found = WEIGHT * SPAN / (4 * TENSION), []
    for n in (5, 10):
        _, rows, coefficients = string(folder, n)
        middle = rows[0][n] + 1
        lmp.run_well(begin(1e-3, 0.5, coefficients) + FALL + "run 4000\nrun 1000\n"
                     f"print \"$(z[{middle}]:%.17g) $(f_w[3]:%.17g)\" file out.txt screen no\n", folder)
        found.append(lmp.read_rows(folder / "out.txt")[0])
    at_most("a string sags by W L/(4 T)", abs(-found[1][0] - wanted), 0.01 * wanted)
    at_most("it carries the weight", abs(-found[1][1] - WEIGHT), 1e-4)
    at_most("with half as many nodes, too", abs(-found[0][0] - wanted), 0.01 * wanted)


def test_on_processes(folder):
    """Places of all after 400 steps: on 1, 2 and 4 processes, with sorted atoms, and with a restart in the middle."""
    _, _, coefficients = string(folder, 5)
    dump = "dump out all custom 400 {0} id x y z vx vy vz\ndump_modify out sort id format float %.17g first no\n"
    def places(name):
        text = (folder / name).read_text().split("ITEM: ATOMS")[-1].split("\n")[1:]
        return [float(w) for line in text for w in line.split()[1:]]
    found = {}
    for name, ranks, sort in (("one", 1, 0), ("two", 2, 0), ("four", 4, 0), ("sorted", 2, 7)):
        lmp.run_well(begin(1e-3, 0.5, coefficients, sort) + FALL + dump.format(name) + "run 400\n", folder, ranks)
        found[name] = places(name)
    for name in ("two", "four", "sorted"):
        worst = max(abs(a - b) for a, b in zip(found["one"], found[name]))
        at_most(f"places and velocities, {name}", worst, 1e-11)
    # The set-up of a run gives fix viscous the velocities of the whole step.
    head = begin(1e-3, 0.5, coefficients)
    lmp.run_well(head + FALL + dump.format("halves") + "run 200\nrun 200\n", folder, 2)
    lmp.run_well(head + FALL + "run 200\nwrite_restart half.restart\n", folder, 2)
    again = head.replace("read_data       in.data", "read_restart half.restart")
    lmp.run_well(again + FALL + dump.format("again") + "run 200\n", folder, 2)
    worst = max(abs(a - b) for a, b in zip(places("halves"), places("again")))
    at_most("restarted in the middle", worst, 1e-11)


# ---- errors ----------------------------------------------------------------------------------

def test_refused(folder):
    net, _, coefficients = string(folder, 3)
    head = begin(1e-3, 0.8, coefficients)
    def fails(name, text, says):
        lmp.refused(name, head + text + "run 1\n", folder, says)
    wall = "fix w {group} wall/lsdcd hooke 2e4 0 0 0 0 0 mesh sheet.stl nodes {nodes} {more}\n"
    fails("nodes in the group of the fix", wall.format(group="all", nodes="nodes", more=""), "and also in the group of the fix")
    fails("a group that is not there", wall.format(group="grains", nodes="noes", more=""), "there is no group 'noes'")
    fails("a motion beside nodes", wall.format(group="grains", nodes="nodes", more="motion linear 0 0 1"), "in 'nodes', its nodes alone move")
    fails("pressure without nodes", wall.format(group="grains", nodes="nodes", more="").replace("nodes nodes", "pressure 1"),
          "it acts on nodes, and the mesh has none")
    soft = head.replace("pair_style      zero 0.8\npair_coeff      * *", "pair_style soft 0.8\npair_coeff * * 0")
    for name, line, warns in (("warned of", "", True), ("of another type", "neigh_modify exclude type 3 1\n", True),
                              ("by types", "neigh_modify exclude type 3 1 exclude type 1 2\n", False),
                              ("excluded", "neigh_modify exclude group nodes grains\n", False)):
        done = lmp.run(soft + line + wall.format(group="grains", nodes="nodes", more="") + "run 1\n", folder)
        fact(f"a pair style between nodes and grains, {name}",
             done.returncode == 0 and ("pair_style soft also acts between" in " ".join(done.stdout.split())) == warns)
    bonds, net.bonds = net.bonds, []
    net.write(folder, skip=(3, 5))
    fails("vertices without an atom", wall.format(group="grains", nodes="nodes", more=""),
          "2 of the 14 vertices of mesh 'sheet.stl' have no atom of group 'nodes'")
    net.write(folder, twice=(2,))
    fails("two atoms at a vertex", wall.format(group="grains", nodes="nodes", more=""), "2 atoms of group 'nodes' are at the vertex")
    net.bonds = bonds
    net.write(folder)
    fails("a lost node", wall.format(group="grains", nodes="nodes", more="") + "thermo_modify lost ignore\nrun 1\n"
          "group one id 3\ndelete_atoms group one bond yes\n", "atom 3, a node of mesh 'sheet.stl', is lost")


# ---- atoms that get other IDs, another mesh --------------------------------------------------

SHEET = lmp.head(comm="vel yes cutoff 1.0") + """\
{create}
group           nodes type 2
group           grains type 1
pair_style      zero 1.0
pair_coeff      * *
neighbor        0.1 bin
timestep        1e-3
fix             w grains wall/lsdcd hooke 2000 NULL 0 NULL 0 1 mesh {mesh} nodes nodes
"""
# The last number is the force of a grain 0.01 deep: 2000 x 0.01.
PRESS = """\
create_atoms    1 single 0.1 0.2 {z}
set             type 1 diameter 0.5 density 15
group           grains type 1
run             0
print           "$(f_w[3]:%.17g)" file out.txt screen no
"""


def sheet(folder):
    """A grain, which has the first ID, over 4 x 4 squares; meshes of the same and of other triangles. The begin of scripts."""
    n = 4
    at = [(2 * i / n - 1, 2 * j / n - 1, 0) for j in range(n + 1) for i in range(n + 1)]
    triangles = stl.sheet(n, lambda i, j: at[j * (n + 1) + i])
    stl.write(folder / "sheet.stl", triangles)
    stl.write(folder / "turned.stl", [t[1:] + t[:1] for t in triangles])
    stl.write(folder / "coarse.stl", stl.square(1))
    create = "region box block -2 2 -2 2 -1 2\ncreate_box 2 box\ncreate_atoms 1 single -1.5 -1.5 -0.5\n"
    # In an order that is not that of places, as of a mesher.
    create += "".join("create_atoms 2 single {} {} {}\n".format(*at[7 * k % len(at)]) for k in range(len(at)))
    return create + "set type 2 diameter 0.01 density 1e9\nset type 1 diameter 0.5 density 15"


def test_pressure(folder):
    """A pressure by a variable: its number in each step times the area of 4, up."""
    text = "variable p equal 0.4+step\n" + SHEET.format(create=sheet(folder), mesh="sheet.stl pressure v_p") + """\
compute         push nodes reduce sum fx fy fz
thermo_style    custom step c_push[1] c_push[2] c_push[3]
thermo          1
thermo_modify   format float %.17g norm no
run             2
"""
    for ranks in (1, 2):
        rows = lmp.read_thermo(lmp.run_well(text, folder, ranks))
        off = max(abs(f - wanted) for step, *push in rows for f, wanted in zip(push, (0, 0, 4 * (0.4 + step))))
        fact(f"a pressure pushes with its number times the area, {ranks} ranks", len(rows) == 3 and off < 1e-12, f"{off} {rows}")


def test_renumbered(folder):
    """Commands between runs give the nodes other IDs: a grain 0.01 deep has its force still, or the run is refused."""
    head = SHEET.format(create=sheet(folder), mesh="sheet.stl") + "run 1\n"
    def force(text, z=0.24, ranks=1):
        lmp.run_well(head + text + PRESS.format(z=z), folder, ranks)
        return lmp.read_rows(folder / "out.txt")[0][0]
    for name, text, ranks in (("delete_atoms", "delete_atoms group grains\n", 1),
                              ("reset_atom_ids on two processes", "delete_atoms group grains compress no\nreset_atom_ids\n", 2)):
        at_most(f"nodes that have other IDs after {name}", abs(force(text, ranks=ranks) + 20), 1e-9)
    keep = "delete_atoms group grains compress no\n"
    moved = force(keep + "displace_atoms nodes move 0 0 0.3\n", 0.54)
    at_most("nodes that were displaced between runs", abs(moved + 20), 1e-9)
    for text, says in (("delete_atoms group grains\n", "a node of mesh 'sheet.stl', is lost"),
                       ("reset_atom_ids sort yes\n", "other atoms may have these IDs now")):
        lmp.refused(f"nodes that were displaced after {text.strip()}", head + text + "displace_atoms nodes move 0 0 0.3\nrun 0\n", folder,
                    says, "delete_atoms and reset_atom_ids give atoms different IDs")
    # Behind a part of a run write_data initialises fixes while LAMMPS says that a run goes on.
    parts = keep + "velocity nodes set 0 0 1\nfix go nodes nve\nrun 4 every 2 {} {} {}\n"
    for reset in ("reset_atom_ids", "reset_atom_ids sort yes"):
        at_most(f"nodes that have other IDs after {reset} in a run, before write_data",
                abs(force(parts.format(f'"{reset}"', '"write_data one.data nocoeff"', '"write_data two.data nocoeff"'), 0.244) + 20), 1e-9)
    # A rerun of the steps of the run before it, whose nodes come much closer from snapshot to snapshot.
    dumped = keep + "fix go nodes move variable NULL NULL NULL v_vx NULL NULL\nvariable vx atom -250*x\ndump d all custom 2 all.txt id type x y z vx vy vz\n"
    lmp.run_well(head + "reset_timestep 0\n" + dumped + "run 4\nrerun all.txt first 0 last 4 dump x y z vx vy vz\n", folder)
    # Without a setup LAMMPS says nothing of the commands before it.
    lmp.run_well(head + "delete_atoms group grains\nrun 1 pre no\n" + PRESS.format(z=0.24), folder)
    at_most("and after a run without setup", abs(lmp.read_rows(folder / "out.txt")[0][0] + 20), 1e-9)


def test_another_mesh(folder):
    """A restart file names the nodes of its mesh: those of another one are found by their places."""
    lmp.run_well(SHEET.format(create=sheet(folder), mesh="sheet.stl") + "delete_atoms group grains compress no\n"
                 "run 1\nwrite_restart one.restart\n", folder)
    for mesh in ("sheet", "turned", "coarse"):
        out = lmp.run_well(SHEET.format(create="read_restart one.restart", mesh=mesh + ".stl") + PRESS.format(z=0.24), folder)
        at_most(f"restart with {mesh}.stl", abs(lmp.read_rows(folder / "out.txt")[0][0] + 20), 1e-9)
        fact(f"and a warning, {mesh}.stl",
             ("was written with a different mesh" in " ".join(out.split())) == (mesh != "sheet"))


# ---- nodes that fix move moves -------------------------------------------------------------

def test_turntable(folder):
    """A grain on a turntable stays there for a turn. The springs of friction hold w^2 r m with 1e-3 of r."""
    create = sheet(folder).replace("single -1.5 -1.5 -0.5", "single 0.6 0 0.2499")
    law = "hooke/history 1e5 3e4 50 20 0.9 1"
    text = SHEET.format(create=create, mesh="sheet.stl").replace("hooke 2000 NULL 0 NULL 0 1", law)
    lmp.run_well(text + f"""\
velocity        grains set 0 {0.6 * math.pi} 0
fix             pull grains gravity 20 vector 0 0 -1
fix             turn grains nve
fix             go nodes move rotate 0 0 0 0 0 1 2.0
timestep        2e-3
run             1000
print           "$(xcm(grains,x):%.17g) $(xcm(grains,y):%.17g)" file out.txt screen no
""", folder)
    x, y = lmp.read_rows(folder / "out.txt")[0]
    at_most("a grain stays on a turntable that fix move turns", math.hypot(x - 0.6, y), 1e-3 * 0.6)


# ---- power -------------------------------------------------------------------------------

SQUARE = lmp.head("-3 3 -3 3 -3 3", types=2) + """\
create_atoms    1 single 0.2 0.1 -0.21 units box
create_atoms    2 single -1 -1 0 units box
create_atoms    2 single  1 -1 0 units box
create_atoms    2 single  1  1 0 units box
create_atoms    2 single -1  1 0 units box
set             type 1 diameter 0.4 density 1
set             type 2 diameter 0.1
set             type 2 density 477.46482927568604
group           nodes type 2
group           grains type 1
velocity        nodes set 0 0 -1
""" + lmp.pairs("zero 1.0") + """\
timestep        {dt}
fix             m nodes nve
fix             w grains wall/lsdcd hooke/history 1e3 NULL 0 NULL 0 0 mesh square.stl nodes nodes
variable        p atom -fx*vx-fy*vy-fz*vz
compute         p nodes reduce sum v_p
variable        a equal f_w[11]
variable        b equal c_p
thermo_style    custom step f_w[11] c_p
thermo_modify   format float %.17g norm no
thermo          {every}
fix             sum all ave/time 1 {steps} {steps} v_a v_b
run             {steps}
velocity        nodes set 0 0 0
print           "work $(f_sum[1]*{steps}*dt) $(f_sum[2]*{steps}*dt) power $(f_w[11])"
"""


def test_power_of_a_bounce(folder):
    """A free square of mass 1 meets a held sphere without loss: the power is that of the forces on the nodes with the
    velocities of their whole step, and its sum over the bounce is 0 but for dt^2."""
    stl.write(folder / "square.stl", stl.quad((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)))
    works = []
    for ranks, dt, steps in ((1, 2e-3, 60), (2, 2e-3, 60), (1, 1e-3, 120)):
        text = lmp.run_well(SQUARE.format(dt=dt, steps=steps, every=5), folder, ranks)
        rows = [row for row in lmp.read_thermo(text)]
        fact("it bounces", max(abs(row[2]) for row in rows) > 5)
        # Of forces up to 12 and velocities up to 1: some roundings of 1e-16.
        at_most(f"power, {ranks} processes", max(abs(row[1] - row[2]) for row in rows), 1e-12)
        words = text.split("\nwork ")[-1].split()
        works.append(float(words[0]))
        at_most("work, as of the forces", abs(float(words[0]) - float(words[1])), 1e-12)
    # Of an energy of 0.5; the mean of velocities at half steps would be 0.036.
    at_most("work of a bounce", max(map(abs, works)), 1e-3)
    during = SQUARE.format(dt=2e-3, steps=20, every=20)
    text = lmp.run_well(during, folder)
    last = lmp.read_thermo(text)[-1][1]
    kept = float(text.split("\nwork ")[-1].split()[3])
    fact("power of the last step, after a command has stopped the nodes", kept == last and kept > 5, f"{kept} {last}")


# ---- with Kokkos -------------------------------------------------------------------------

FREE = lmp.head("-2 2 -2 2 -1 2", comm="vel yes cutoff 1.0", types=2) + """\
{atoms}
set             type 2 diameter 0.01 density 2e7
set             type 1 diameter 0.5 density 3
group           nodes type 2
group           grains type 1
""" + lmp.pairs("gran/hooke/history 2e4 NULL 50 NULL 0.5 1", 0.1, neigh="delay 0 every 1 check yes exclude group nodes grains") + """\
timestep        1e-3
fix             w grains {style} hooke/history 2e4 NULL 50 NULL 0.5 1 mesh sheet.stl nodes nodes
fix             down grains gravity 1 vector 0.3 0.1 -1
fix             turn grains nve/sphere
fix             go nodes nve
dump            out all custom 1000 {style_name} id x y z vx vy vz
dump_modify     out sort id format float %.17g first no
run             1000
"""


@lmp.of_kokkos
def test_beside_plain(folder):
    """wall/lsdcd/kk and the plain fix in the LAMMPS with Kokkos: heavy nodes, on which grains fall, roll and bounce."""
    n = 6
    at = [(2 * i / n - 1, 2 * j / n - 1, 0.05 * ((i + j) % 3)) for j in range(n + 1) for i in range(n + 1)]
    stl.write(folder / "sheet.stl", stl.sheet(n, lambda i, j: at[j * (n + 1) + i]))
    atoms = "".join(f"create_atoms 2 single {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in at)
    atoms += "".join(f"create_atoms 1 single {x} {y} {z}\n"
                     for x, y, z in ((-0.6, -0.5, 0.4), (0.1, -0.55, 0.45), (-0.4, 0.3, 0.5), (0.35, 0.3, 0.4), (0, 0, 1.1)))
    found = {}
    for name, style, flags in (("plain", "wall/lsdcd", ()), ("kk", "wall/lsdcd/kk", lmp.FLAGS)):
        lmp.run_well(FREE.format(atoms=atoms, style=style, style_name=name), folder, flags=flags)
        rows = (folder / name).read_text().split("ITEM: ATOMS")[-1].split("\n")[1:]
        found[name] = [[float(w) for w in row.split()] for row in rows if row]
    fact("all are there", len(found["plain"]) == len(found["kk"]) == len(at) + 5)
    worst = max(abs(a - b) for p, k in zip(found["plain"], found["kk"]) for a, b in zip(p, k))
    # Other fixes may round in their own way with Kokkos.
    at_most("places and velocities with wall/lsdcd/kk, as with the plain fix", worst, 1e-10)
    fact("grains have pushed nodes", max(abs(row[3] - x[2]) for row, x in zip(found["kk"], at)) > 1e-3)
