# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""pair_style granular/lsdcd beside LAMMPS's own pair styles where these are right, and beside closed forms.

Grains of a lattice in a periodic box, which touch and part, turn, and go from process to process. Numbers are compared
while rounding has not grown: it doubles in some 40 steps of such a gas.
"""

import math
import random
import re
import struct

import pytest

import lmp
from facts import at_most, fact

GRANULAR = "hertz/material 1e4 0.7 0.3 tangential mindlin NULL 0.5 0.4 damping coeff_restitution"
FULL = "hertz/material 1e4 5 0.3 tangential mindlin_rescale NULL 0.5 0.4 rolling sds 300 2 0.3 twisting sds 30 1 0.3"
SIDE, DT = 6, 2e-4
COLUMNS = "id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz"


def grains(folder, types=1, tilt=0.0, seed=1, name="grains.data"):
    """Grains of a lattice that overlap in places, with velocities and spins."""
    rng = random.Random(seed)
    atoms, velocities = [], []
    for i in range(SIDE**3):
        place = [(i // SIDE**k) % SIDE + 0.5 + rng.uniform(-0.05, 0.05) for k in range(3)]
        place[0] += tilt * place[1] / SIDE
        atoms.append(f"{i + 1} {1 + i % types} {rng.uniform(0.95, 1.05)} {rng.uniform(1, 2)} {place[0]} {place[1]} {place[2]}")
        velocities.append(f"{i + 1} " + " ".join(str(rng.uniform(-1, 1)) for _ in range(6)))
    box = "".join(f"0 {SIDE} {a}lo {a}hi\n" for a in "xyz") + (f"{tilt} 0 0 xy xz yz\n" if tilt else "")
    (folder / name).write_text(f"grains\n\n{SIDE**3} atoms\n{types} atom types\n\n{box}\nAtoms # sphere\n\n" + "\n".join(atoms) +
                               "\n\nVelocities\n\n" + "\n".join(velocities) + "\n")


def settings(newton="off", units="lj"):
    return lmp.head(boundary="p p p", newton=newton, units=units) + "neighbor 0.1 bin\nneigh_modify delay 0 every 1 check yes\n"


def script(pair, steps=200, every=100, newton="off", more="", name="out", data="grains.data", integrate="fix i all nve/sphere",
           units="lj"):
    """`pair`: pair_style and pair_coeff, a line each."""
    return settings(newton, units) + f"read_data {data}\n{pair}\n{more}\n{integrate}\ntimestep {DT}\n" + dump(name, every) + f"run {steps}\n"


def dump(name, every):
    return f"thermo 100\nthermo_style custom step ke pe press\ndump d all custom {every} {name} {COLUMNS}\ndump_modify d format float %.17g sort id\n"


def ours(*coeffs, style="granular/lsdcd"):
    return f"pair_style {style}\n" + "\n".join(f"pair_coeff {c}" for c in coeffs)


def states(folder, *args, ranks=1, **more):
    lmp.run_well(script(*args, **more), folder, ranks)
    return lmp.read_dump(folder / more.get("name", "out"))


def prepare(folder):
    grains(folder)
    grains(folder, 2, name="two.data")
    grains(folder, tilt=1.5, name="tilted.data")


CLASSIC = {"hooke": "hooke 1e4 NULL 30 NULL 0.4 1", "hooke_history": "hooke/history 1e4 NULL 30 NULL 0.4 1",
           "hertz_history": "hertz/history 1e4 NULL 300 NULL 0.4 1"}


# The stiffnesses of hertz/history are pressures, a force per area times 68568 in units real.
IN_REAL = "hertz/history 7e8 NULL 300 NULL 0.4 1"


@pytest.mark.parametrize("law", [*CLASSIC.values(), IN_REAL], ids=[*CLASSIC, "hertz_history_in_real"])
def test_classic(folder, law):
    """The styles before granular are those of LAMMPS, in its log's thermo table, too, but for the elastic energy."""
    units = "real" if law == IN_REAL else "lj"
    style, numbers = law.split(" ", 1)
    theirs = states(folder, f"pair_style gran/{style} {numbers}\npair_coeff * *", name="theirs", units=units)
    own = states(folder, ours(f"* * law {law}"), units=units)
    at_most(f"{law}: positions, velocities, forces, torques", lmp.largest_difference(theirs, own), 1e-10)


def test_tilted(folder):
    style, numbers = CLASSIC["hertz_history"].split(" ", 1)
    theirs = states(folder, f"pair_style gran/{style} {numbers}\npair_coeff * *", name="theirs", data="tilted.data")
    own = states(folder, ours(f"* * law {CLASSIC['hertz_history']}"), data="tilted.data")
    at_most("tilted: positions, velocities, forces, torques", lmp.largest_difference(theirs, own), 1e-10)


# Of bodies and of grains that do not move: a mass of one side, or of the body.
@pytest.mark.parametrize("what", ["freeze", "rigid"])
def test_masses(folder, what):
    style, numbers = CLASSIC["hooke_history"].split(" ", 1)
    more = "group some id 1:80\ngroup rest subtract all some\n"
    if what == "freeze":
        integrate = more + "fix f some freeze\nfix i rest nve/sphere"
    else:
        integrate = more + "fix b some rigid single\nneigh_modify exclude group some some\nfix i rest nve/sphere"
    if what == "rigid" and lmp.ON_HOST:
        pytest.skip("that LAMMPS is built without the package RIGID")
    theirs = states(folder, f"pair_style gran/{style} {numbers}\npair_coeff * *", name="theirs", integrate=integrate)
    own = states(folder, ours(f"* * law {CLASSIC['hooke_history']}"), integrate=integrate)
    at_most(f"{what}: positions, velocities, forces, torques", lmp.largest_difference(theirs, own), 1e-10)


FROZEN = lmp.head("-12 12 -12 12 -12 12", newton="{newton}") + """\
create_atoms 1 single -4.6 0 0
create_atoms 1 single -0.3 0 0
create_atoms 1 single 4.2 0 0
create_atoms 1 single 0 4 4
create_atoms 1 single 0 4.9 4
set atom 1*3 diameter 6 density 1
set atom 4*5 diameter 1 density 1
group still id 1:3
group free id 4:5
pair_style granular/lsdcd
pair_coeff * * {law}
neighbor 0.1 bin
fix move free nve/sphere
fix hold still freeze
compute pairs all pair/local eng
dump pairs all local 1 pairs c_pairs
thermo_style custom step pe press
thermo_modify norm no
run 0
"""


@pytest.mark.parametrize("law", ["law hooke 1000 0 0 0 0 0", "hooke 1000 0 tangential linear_nohistory 0 0 damping velocity"])
@pytest.mark.parametrize("newton", ["off", "on"])
def test_two_frozen_grains(folder, law, newton):
    """Two grains that do not move do not act, be they in a list or not: of three pairs that overlap the energy is that of the free one,
    1000 0.1^2/2, and the pressure its 1000 0.1 0.9 over 3 times the volume of the box."""
    for ranks in (1, 2):
        text = FROZEN.format(law=law, newton=newton)
        pe, pressure = lmp.read_thermo(lmp.run_well(text, folder, ranks=ranks))[-1][1:]
        of_pairs = sum(float(line) for line in (folder / "pairs").read_text().split("c_pairs")[-1].split())
        at_most(f"{ranks}: energy", abs(pe / 5 - 1), 1e-7)    # as many digits as the log has
        at_most(f"{ranks}: energy of pairs", abs(of_pairs / 5 - 1), 1e-7)
        at_most(f"{ranks}: pressure", abs(pressure / (90 / (3 * 24**3)) - 1), 1e-6)


def test_masses_change(folder):
    """A grain that fix adapt makes heavier after lists are made has its new mass at once, also where there are rigid bodies elsewhere."""
    bodies = "fix mark all property/atom i_body\nset group body i_body 1\nfix stiff body rigid/small custom i_body\n"
    dumps = []
    for rigid in ("", bodies):
        text = lmp.head("-6 6 -4 4 -4 4", style="sphere 1") + "".join(f"create_atoms 1 single {at} 0\n" for at in ("0 0", "1.06 0.2", "-4 0", "-4 0.5", "-3.5 0"))
        text += f"""set group all diameter 1 density 2
group body id > 2
group free id < 3
group one id 1
velocity one set 3 0.3 0
{ours("* * law hooke/history 1e4 NULL 30 NULL 0.4 1")}
neighbor 2 bin
neigh_modify delay 0 every 1 check yes exclude group body body
{rigid}fix move free nve/sphere
fix grow free adapt 1 atom diameter v_wide
variable wide equal 1.0+0.05*(step>0)
timestep 2e-4
dump d free custom 400 out id x y vx vy omegaz
dump_modify d sort id format float %.17g
run 400
"""
        lmp.run_well(text, folder)
        dumps.append(lmp.read_dump(folder / "out"))
    at_most("positions and velocities", lmp.largest_difference(*dumps), 1e-12)


def approaching(newton="off", rigid=False):
    """Two grains, one on each side of the face between processes, approach each other with lists that stay."""
    bodies = "fix mark all property/atom i_body\nset group body i_body 1\nfix stiff body rigid/small custom i_body\n"
    return lmp.head("-3 3 -3 3 -3 3", newton=newton, more="processors * 1 1\n") + "".join(
        f"create_atoms 1 single {at} 0\n" for at in ("-0.499 0", "0.499 0", "-2 -2", "-2 -1.7")) + f"""set group all diameter 1 density 1
group body id > 2
group pair id < 3
set group body diameter 0.5 density 1
group left id 1
group right id 2
velocity left set 0.1 0 0
velocity right set -0.1 0 0
neigh_modify delay 0 every 1000 check no exclude group body body
{ours("* * hooke 1000 50 tangential linear_nohistory 0 0 damping mass_velocity")}
fix move pair nve/noforce
{bodies if rigid else ""}timestep 1e-4
""" + dump("out", 1)


def push_of_two(step, diameters, densities):
    """A spring of 1000 and a dashpot of 50 of the reduced mass, at a speed of 0.2."""
    masses = [rho * math.pi / 6 * d**3 for d, rho in zip(diameters, densities)]
    return 1000 * (sum(diameters) / 2 - (0.998 - 0.2e-4 * step)) + 50 * 0.2 * masses[0] * masses[1] / sum(masses)


def is_push(what, row, push):
    # Sums of numbers up to 1000, of which each is rounded to 1e-16: 1e-13 of a push above 1.
    at_most(what, max(abs(row[1][9] + push), abs(row[2][9] - push)) / push, 1e-12)


@pytest.mark.parametrize("rigid", [False, True])
def test_set_before_a_run_without_setup(folder, rigid):
    """The command set changes radii and masses of both grains of a pair, where LAMMPS makes no new lists before the run, and where there are rigid
    bodies elsewhere."""
    if rigid and lmp.ON_HOST:
        pytest.skip("the command set of LAMMPS 4Jul2026 reads through a null pointer where a fix rigid is set up")
    change = "run 5\nset atom 1 diameter 1.004 density 2\nset atom 2 diameter 1.008 density 3\nrun 5 pre no\n"
    for newton in ("off", "on"):
        for ranks in (1, 2):
            lmp.run_well(approaching(newton, rigid) + change, folder, ranks)
            for step, rows in lmp.read_dump(folder / "out").items():
                push = push_of_two(step, (1, 1), (1, 1)) if step <= 5 else push_of_two(step, (1.004, 1.008), (2, 3))
                is_push(f"newton {newton}, {ranks} ranks, step {step}", rows, push)


def changed_by_fix_set(every, newton, rigid):
    return approaching(newton, rigid) + lmp.set_in_run(every, 1, 2, diameter="1+0.0004*id*step", density="1+0.1*id*step") + "run 12\n"


@pytest.mark.parametrize("rigid", [False, True])
def test_fix_set(folder, rigid):
    """Radii and masses that fix set changes are those of both grains in the next step, also where lists stay and processes share the pair, and
    where there are rigid bodies elsewhere."""
    for every, newton, ranks in ((1, "off", 1), (5, "off", 2), (1, "on", 2), (5, "on", 1)):
        lmp.run_well(changed_by_fix_set(every, newton, rigid), folder, ranks)
        for step, rows in lmp.read_dump(folder / "out").items():
            last = max(0, (step - 1) // every * every)    # fix set acts at the end of a step
            push = push_of_two(step, [1 + 0.0004 * i * last for i in (1, 2)], [1 + 0.1 * i * last for i in (1, 2)])
            is_push(f"set each {every}, newton {newton}, {ranks} ranks, step {step}", rows, push)


def test_tiles(folder):
    """With newton on LAMMPS cannot send what pairs keep by comm_style tiled; with newton off, or of a law that keeps nothing, it can."""
    history, none = ours("* * law hooke/history 1e4 NULL 30 NULL 0.4 1"), ours("* * law hooke 1e4 NULL 30 NULL 0.4 1")
    tiles = "comm_style tiled\nneigh_modify every 40 delay 0 check no\n"    # with Kokkos a buffer of LAMMPS grows by half each time
    lmp.refused("newton on", script(history, newton="on", more=tiles), folder, "write newton off")
    one = states(folder, history)
    at_most("newton off", lmp.largest_difference(one, states(folder, history, more=tiles, ranks=2)), 1e-10)
    lmp.run_well(script(none, newton="on", more=tiles), folder, 2)


@pytest.mark.parametrize("newton", ["off", "on"])
def test_ranks(folder, newton):
    """What pairs keep goes with the grains: lists are made anew in each tenth step, and grains go to other processes."""
    one = states(folder, ours("* * " + FULL), steps=400, name="one")
    for ranks in (1, 4):
        other = states(folder, ours("* * " + FULL), steps=400, newton=newton, ranks=ranks)
        at_most(f"newton {newton}, {ranks} ranks", lmp.largest_difference(one, other), 1e-10)


def test_mixed(folder):
    """Two materials without a law of their pair: E* and G* of both, the geometric mean of other numbers. The same law in words."""
    e, nu = (1e4, 3e4), (0.3, 0.2)
    star = 1 / sum((1 - n * n) / m for m, n in zip(e, nu))
    shear = 1 / sum(2 * (2 - n) * (1 + n) / m for m, n in zip(e, nu))
    laws = [f"{i + 1} {i + 1} hertz/material {e[i]} {(5, 7)[i]} {nu[i]} tangential mindlin NULL {(0.5, 0.2)[i]} {(0.4, 0.9)[i]}"
            for i in range(2)]
    both = f"1 2 hertz {4 / 3 * star:.17g} {35**0.5:.17g} tangential mindlin {8 * shear:.17g} {0.1**0.5:.17g} {0.36**0.5:.17g}"
    mixed = states(folder, ours(*laws), data="two.data", name="mixed")
    given = states(folder, ours(*laws, both), data="two.data")
    at_most("mixed", lmp.largest_difference(mixed, given), 1e-10)
    lmp.refused("laws that differ", script(ours(laws[0], "2 2 hooke 1 1 tangential linear_nohistory 1 1"), data="two.data"), folder,
                "types 1 and 2 cannot be mixed", "pair_coeff")


def test_rolling_and_twisting_across_a_border(folder):
    """Two grains go through a periodic face side by side, with spins that nothing changes: the torques are k angle + gamma spin, and
    stay so where the pair changes places."""
    steps, overlap, spin = 500, 0.02, (0.3, 0.7)
    law = "hooke 1e4 0 tangential linear_history 0 0 100 damping velocity rolling sds 300 2 1e6 twisting sds 30 1 1e6"
    for newton in ("off", "on"):
        lmp.run_well(settings(newton) + f"""\
region box block 0 4 0 4 0 4
create_box 1 box
create_atoms 1 single 1.5 2 2
create_atoms 1 single {2.5 - overlap} 2 2
set group all diameter 1 density 1
set atom 1 omega {spin[0]} {spin[1]} 0
velocity all set 20 0 0
{ours("* * " + law)}
fix i all nve/noforce
timestep 1e-3
neigh_modify delay 0 every 1 check no
{dump("out", 1)}run {steps}
""", folder)
        worst = 0
        for step, rows in lmp.read_dump(folder / "out").items():
            time = 1e-3 * step
            # The normal of grain 1 is -x, its twist -spin x; the rolling displacement R_eff w x n, at the arm R_eff.
            twist = -30 * time * spin[0] - 1 * spin[0]
            roll = -(0.25**2) * (300 * time * spin[1] + 2 * spin[1])
            worst = max(worst, abs(rows[1][12] - twist), abs(rows[1][13] - roll), abs(rows[2][12] + twist), abs(rows[2][13] + roll))
        at_most(f"newton {newton}: torques", worst, 1e-11)


def test_restart(folder):
    """A run that goes on from a file is the run that goes on, to the bit; springs of another law are refused."""
    for newton in ("off", "on"):
        lmp.run_well(script(ours("* * " + FULL), newton=newton, name="first") + "write_restart r\nundump d\n" + dump("two", 50) +
                     "run 200\n", folder, 2)
        lmp.run_well(settings(newton) + "read_restart r\n" + ours("* * " + FULL) + f"\nfix i all nve/sphere\ntimestep {DT}\n" +
                     dump("continued", 50) + "run 200\n", folder, 2)
        at_most(f"newton {newton}: restart", lmp.largest_difference(lmp.read_dump(folder / "two"), lmp.read_dump(folder / "continued")), 0)
        lmp.run_well(settings(newton) + "pair_style zero 1\nclear\n" + settings(newton) + "read_restart r\npair_style zero 1\n" +
                     ours("* * " + FULL) + f"\nfix i all nve/sphere\ntimestep {DT}\n" + dump("later", 50) + "run 200\n", folder, 2)
        at_most(f"newton {newton}: restart after other pair styles",
                lmp.largest_difference(lmp.read_dump(folder / "two"), lmp.read_dump(folder / "later")), 0)
    lmp.refused("springs of another law", settings("on") + "read_restart r\n" + ours("* * " + GRANULAR) + "\nrun 0\n", folder,
                "springs of other contact laws")
    text = lmp.run_well(settings("on") + "read_restart r\n" + ours("* * hooke 1e4 1 tangential linear_nohistory 0 0") + "\nrun 0\n", folder)
    fact("a law without springs: said", "Unused restart file" in text or "unused" in text.lower(), text[-300:])


def by_mass(path):
    """The rows of a dump's last step by the second column, a mass that no other grain has, without IDs."""
    steps = lmp.read_dump(path)
    return {row[0]: row[1:] for row in steps[max(steps)].values()}


@pytest.mark.parametrize("newton, ranks", [("off", 1), ("on", 4)])
def test_new_ids(folder, newton, ranks):
    """Grains that get other IDs between runs, as by delete_atoms, keep their springs: they go on as with their old IDs. So they do behind
    write_data, which sets up an exchange between runs."""
    law = f"{ours('* * ' + FULL)}\nfix i all nve/sphere\ntimestep {DT}\n" + dump("out", 100).replace("out id", "out id mass")

    def end(compress, commands="", first=""):
        lmp.run_well(settings(newton) + f"read_data grains.data\n{law}run 200\n{first}group gone id 3:200:9\ndelete_atoms group gone compress {compress}\n"
                     f"{commands}run 100\n", folder, ranks)
        return {0: by_mass(folder / "out")}

    kept = end("no")
    fact("grains", len(kept[0]) == SIDE**3 - 22, str(len(kept[0])))
    at_most("new IDs", lmp.largest_difference(kept, end("yes")), 1e-10)
    write = "write_data {}.data nocoeff\n"
    at_most("write_data", lmp.largest_difference(kept, end("no", write.format("behind"), write.format("before"))), 1e-10)
    halves = "run 100 every 50 {}\n"
    at_most("write_data in a run", lmp.largest_difference(end("no", halves.format("NULL")), end("no", halves.format('"write_data part.data nocoeff"'))), 1e-10)
    at_most("write_data and new IDs", lmp.largest_difference(kept, end("yes", first=write.format("before"))), 1e-10)
    at_most("new IDs, and a restart", lmp.largest_difference(kept, end("yes", "write_restart r\nclear\n" + settings(newton) + "read_restart r\n" + law)), 1e-10)
    reset = "reset_atoms id\n" if lmp.version() > 20210929 else "reset_atom_ids\n"
    restarted = end("no", "write_restart r\nclear\n" + settings(newton) + "read_restart r\n" + law + reset)
    at_most("new IDs after a restart", lmp.largest_difference(kept, restarted), 1e-10)


def test_id_of_another(folder):
    """A grain that gets the ID and the place of one that was deleted does not get its springs."""
    lmp.run_well(settings() + f"""\
region b block 0 4 0 4 0 4
create_box 1 b
create_atoms 1 single 1 2 2
create_atoms 1 single 1.98 2 2
set group all diameter 1 density 1
set group all omega 0 0 1
{ours("* * law hooke/history 1e4 5e3 0 0 2 0")}
group second id 2
fix i all nve/noforce
timestep 1e-4
run 1000
write_dump all custom first {COLUMNS}
delete_atoms group second
create_atoms 1 single 1.98 2 2
set atom 2 diameter 1 density 1
run 0
write_dump all custom second {COLUMNS}
""", folder)
    friction = [lmp.read_dump(folder / name)[1000][1][10] for name in ("first", "second")]
    fact("friction of the first contact", abs(friction[0]) > 1, str(friction))
    at_most("friction of the new contact", abs(friction[1]), 0)


def test_order_of_fixes(folder):
    """Fixes that create or delete atoms stand behind the pair style, as the springs go to atoms before."""
    for fix in ("all evaporate 10 1 everywhere 4711", "all deposit 1 1 10 4711 region somewhere near 0.1"):
        first = f"region everywhere block INF INF INF INF INF INF\nregion somewhere block 1 5 1 5 1 5\nfix early {fix}\n"
        text = script(first + ours("* * " + GRANULAR))
        lmp.refused(fix, text, folder, "fix early", "write pair_style before")


# Two pairs whose grains slide past each other, in the halves of two processes, which change places when the box flips.
FLIPPED = """units lj
atom_style sphere
comm_modify vel yes
newton off
processors 2 1 1
region box prism -5 5 -5 5 -5 5 4.98 0 0
box tilt large
create_box 1 box
neigh_modify every 50 delay 0 check no
timestep 1e-3
{before}
pair_style granular/lsdcd
pair_coeff * * hooke 1000 0 tangential linear_history 500 0 100 damping mass_velocity
{behind}
create_atoms 1 single 0 0.1 0
create_atoms 1 single 0 0.1 0.95
create_atoms 1 single 5 0.1 0
create_atoms 1 single 5 0.1 0.95
set group all diameter 1 density 1
group one id 2
group two id 4
group rest subtract all one two
fix one one move linear 0 0.1 0
fix two two move linear 0 -0.2 0
fix rest rest move linear 0 0 0
dump d all custom 1000 forces id fy
dump_modify d format float %.17g
run 1000
"""


def test_flip(folder):
    """Atoms that fix deform gives to another process take their springs along, or an error says where pair_style has to stand."""
    flip = "fix flip all deform 10 xy delta 0.04 remap none"
    lmp.run_well(FLIPPED.format(before="", behind=flip), folder, 2)
    forces = lmp.read_dump(folder / "forces")[1000]
    # The normal leans by 0.1 / 0.95 and 0.2 / 0.95 at the end: it turns the shear displacement by 2 %, and a normal force of at most
    # 1000 * 0.05 takes up to 11 % of 50, the lesser friction.
    for k, slid in ((1, 0.1), (3, -0.2)):
        at_most(f"force of atom {k}, of a stiffness of 500", abs(forces[k][0] / (500 * slid) - 1), 0.15)
    lmp.refused("fix deform before it", FLIPPED.format(before=flip, behind=""), folder, "given them to other processes", "write pair_style before",
                ranks=2)


def test_damaged_restart(folder):
    """The count of an atom's partners in a restart file is not that of its numbers: the atom is named."""
    lmp.run_well(script(ours("* * " + GRANULAR), steps=100) + "write_restart r\n", folder)
    data = (folder / "r").read_bytes()
    # Of an atom: 7 numbers, its ID, a count, a partner's ID and a shear displacement.
    at = max(data.find(struct.pack("<3d", 7, tag, 1)) for tag in range(SIDE**3 + 1))
    fact("an atom has one partner", at > 0, str(at))
    (folder / "r").write_bytes(data[:at + 16] + struct.pack("<d", 2) + data[at + 24:])
    lmp.refused("damaged", settings() + "read_restart r\n" + ours("* * " + GRANULAR) + "\nrun 0\n", folder, "in the restart file are damaged")


def test_poured(folder):
    """Grains that fix pour and fix deposit make, of two types and sizes that were not there, fall on a floor: LAMMPS's thermo table."""
    tables = {}
    for name, pair in (("theirs", "pair_style gran/hertz/history 1e4 NULL 50 NULL 0.5 1\npair_coeff * *"),
                       ("ours", ours("* * law hertz/history 1e4 NULL 50 NULL 0.5 1"))):
        tables[name] = lmp.read_thermo(lmp.run_well(lmp.head(box="0 8 0 8 0 14", boundary="p p f", types=2, modify="") + f"""\
neighbor 0.2 bin
neigh_modify delay 0 every 1 check yes
{pair}
region low block 0 8 0 8 4 8
region high block 1 7 1 7 10 12
fix g all gravity 2 vector 0 0 -1
fix w all wall/gran hertz/history 1e4 NULL 50 NULL 0.5 1 zplane 0 NULL
fix p all pour 300 1 4711 vol 0.4 20 region low diam range 0.5 1.0
fix d all deposit 40 2 25 813 region high near 1.2 vz -1 -1
fix i all nve/sphere
timestep 1e-3
thermo_style custom step atoms ke press pxx pyy pzz pxy
thermo_modify format float %.17g lost error norm no
compute_modify thermo_temp dynamic/dof yes
thermo 100
run 1500
""", folder))
    last = tables["ours"][-1]
    fact("grains are poured and deposited", last[1] > 150, str(last))
    for k, what in ((1, "atoms"), (2, "kinetic energy"), (3, "pressure"), (7, "pxy")):
        most = max(abs(row[k]) for row in tables["theirs"])
        at_most(what, max(abs(a[k] - b[k]) for a, b in zip(*tables.values())) / most, 1e-8)


def test_levels_of_respa(folder):
    """Springs move by the timestep of their level: pairs at the inner level of two are those of half the timestep."""
    law, more = ours("* * " + FULL), "fix i all nve"
    lmp.run_well(settings() + f"read_data grains.data\n{law}\n{more}\ntimestep {DT / 2}\n" + dump("half", 100) + "run 200\n", folder)
    respa = settings() + f"read_data grains.data\n{law}\n{more}\nrun_style respa 2 2 pair 1\ntimestep {DT}\n" + dump("levels", 50) + "run 100\n"
    if lmp.version() > 20210929 and not lmp.ON_HOST:    # Debian's package lacks respa.h
        lmp.refused("respa", respa, folder, "does not say which timestep a level of run_style respa has")
        return
    lmp.run_well(respa, folder)
    half, levels = lmp.read_dump(folder / "half"), lmp.read_dump(folder / "levels")
    at_most("respa", lmp.largest_difference({k // 2: v for k, v in half.items()}, levels), 1e-10)


def test_minimization(folder):
    """Contacts keep their springs where LAMMPS reneighbours in a minimization: as with a skin that is so wide that it does not."""
    dumps = []
    for skin in (0.02, 0.5):
        out = lmp.run_well(script(ours("* * law hooke/history 1e4 NULL 30 NULL 0.4 1"), 60, 30, more=f"neighbor {skin} bin\nmin_style quickmin\n") +
                           "minimize 0 0 60 1000\nrun 60\n", folder)
        built = re.findall(r"Neighbor list builds = (\d+)", out)
        fact(f"reneighbours with a narrow skin alone, {skin}", len(built) == 3 and (int(built[1]) > 0) == (skin < 0.1), str(built))
        dumps.append(lmp.read_dump(folder / "out"))
    at_most("minimization", lmp.largest_difference(*dumps), 1e-8)


IN_SETUPS = ["hertz 2000 5 tangential linear_history 1500 0.5 0.4 damping viscoelastic",
             "hertz/material 1e4 5 0.3 tangential mindlin/force NULL 0.5 0.4 rolling sds 100 3 0.1 twisting sds 10 2 0.02",
             FULL, "hertz/material 1e4 5 0.3 tangential mindlin_liggghts NULL 0.5 0.4 rolling epsd2 0.3"]


@pytest.mark.parametrize("law", IN_SETUPS)
def test_setups(folder, law):
    """A setup moves no spring: grains that are stopped have the friction and couples of their springs alone, the same bits with more setups
    before, of which each sees velocities of another time than the step before it."""
    seen = []
    for more in ("", "run 0\n", "min_style quickmin\nminimize 0 0 0 0\n"):
        lmp.run_well(lmp.head("-3 3 -3 3 -3 3") + f"""\
create_atoms 1 single 0 0 0 units box
create_atoms 1 single 0.99 0 0 units box
set group all diameter 1 mass 1
set atom 1 omega 5 3 20
set atom 2 vx -0.5 vy 0.3
{ours("* * " + law)}
neighbor 0.1 bin
fix move all nve/sphere
timestep 1e-4
run 100
{more}velocity all set 0 0 0 units box
set group all omega 0 0 0
compute p all pair/local p1 p2 p3 p5 p6 p7 p9
dump p all local 1 pairs c_p[1] c_p[2] c_p[3] c_p[4] c_p[5] c_p[6] c_p[7]
dump_modify p format float %.17g
run 0
""", folder)
        seen.append((folder / "pairs").read_text().split("\n")[-2].split())
    fact("the spring of the friction is stretched", abs(float(seen[0][1])) > 1e-3, str(seen[0]))
    fact("springs are the same with more setups", seen[1] == seen[0], str(seen[1]))
    fact("springs are the same after a minimization that moves nothing", seen[2] == seen[0], str(seen[2]))


def listed(said):
    return [int(n) for n in re.findall(r"Total # of neighbors = (\d+)", said)]


def test_lists_of_adhesion(folder):
    """Lists of jkr are by radii: a large grain among small ones of its type has only those for neighbours that are near."""
    rng, skin, large = random.Random(4), 0.05, 1.0
    grains, rows = [(0.0, 0.0, 0.0, large)], []
    while len(grains) < 400:
        x = [rng.uniform(-2, 2) for _ in range(3)]
        if sum(a * a for a in x)**0.5 > large:
            grains.append((*x, 0.1))
    for i, (x, y, z, r) in enumerate(grains):
        rows.append(f"{i + 1} 1 {2 * r} 1 {x!r} {y!r} {z!r}")
    near = sum((a[0] - b[0])**2 + (a[1] - b[1])**2 + (a[2] - b[2])**2 <= (a[3] + b[3] + skin)**2 for i, a in enumerate(grains) for b in grains[:i])
    (folder / "sizes.data").write_text(f"grains\n\n{len(rows)} atoms\n1 atom types\n\n" + "".join(f"-3 3 {a}lo {a}hi\n" for a in "xyz") +
                                       "\nAtoms # sphere\n\n" + "\n".join(rows) + "\n")
    said = lmp.run_well(lmp.head() + f"read_data sizes.data\n{ours('* * jkr 1e4 5 0.3 0.001 tangential mindlin NULL 0.5 0.4')}\n"
                        f"neighbor {skin} bin\nfix move all nve/sphere\nrun 0\n", folder)
    fact("pairs in the list are those within the skin of touch", listed(said) == [near], f"{listed(said)} and {near}")


@pytest.mark.parametrize("gamma", [1, 40])
def test_held_beyond_the_skin(folder, gamma):
    """Adhesion holds grains that are pulled apart as far as with a wide skin, whether a narrow one is more than its reach or less, while
    lists are made anew in each step."""
    seen = []
    for skin in (0.02, 0.5):
        lmp.run_well(lmp.head("-3 3 -3 3 -3 3") + f"""\
create_atoms 1 single 0 0 0 units box
create_atoms 1 single 0.999 0 0 units box
set group all diameter 1 mass 1
{ours(f"* * jkr 1e4 0 0.3 {gamma} tangential linear_nohistory 0 0 damping velocity")}
neighbor {skin} bin
neigh_modify delay 0 every 1 check no
group two id 2
fix move two move linear 1 0 0 units box
timestep 1e-4
{dump("out", 20)}run 1000
""", folder)
        seen.append(lmp.read_dump(folder / "out"))
    pulled = [row[2][9] for row in seen[0].values()]
    far = max(row[2][0] for row in seen[0].values() if row[2][9] < 0) - 1
    fact("the pull lasts beyond half of the skin only if it is strong", (far > 0.01) == (gamma > 1) and 0 < far < 0.09 and pulled[-1] == 0, str(far))
    at_most("with a wide skin", lmp.largest_difference(*seen), 0)


def test_neighbours_by_size(folder):
    """LAMMPS asks the style for cutoffs of radii where it sorts grains by their size."""
    law = ours("* * " + GRANULAR)
    plain = states(folder, law, name="plain")
    by_size = states(folder, law, more="neighbor 0.01 multi\nneigh_modify collection/interval 2 1.0 1.05")
    at_most("by size", lmp.largest_difference(plain, by_size), 1e-10)


def test_suffix_and_hybrid(folder):
    """-sf lsdcd takes the place of granular, and hybrid/overlay adds to it."""
    plain = states(folder, ours("* * " + GRANULAR), name="plain")
    lmp.run_well("suffix lsdcd\n" + script("pair_style granular\npair_coeff * * " + GRANULAR), folder)
    at_most("suffix", lmp.largest_difference(plain, lmp.read_dump(folder / "out")), 0)
    overlay = states(folder, "pair_style hybrid/overlay zero 0.5 granular/lsdcd\npair_coeff * * zero\npair_coeff * * granular/lsdcd " + GRANULAR)
    at_most("hybrid/overlay", lmp.largest_difference(plain, overlay), 1e-10)


def test_hybrid_of_types(folder):
    """Each pair of types has its own style: a pair of ours is what it is among pairs of another one."""
    laws = ["1 1 " + GRANULAR, "2 2 hooke 1e4 0 tangential linear_nohistory 0 0", "1 2 hooke 1e4 0 tangential linear_nohistory 0 0"]
    plain = states(folder, ours(*laws), name="plain", data="two.data")
    hybrid = states(folder, "pair_style hybrid granular/lsdcd gran/hooke 1e4 0 0 0 0 0\n" +
                    f"pair_coeff 1 1 granular/lsdcd {GRANULAR}\npair_coeff 2 2 gran/hooke\npair_coeff 1 2 gran/hooke", data="two.data")
    at_most("hybrid", lmp.largest_difference(plain, hybrid), 1e-10)


def test_rerun(folder):
    """In a rerun springs are 0, also in a script that has run before: forces are those of a script that begins with the rerun."""
    columns, law = "id type x y z vx vy vz", ours("* * hertz/material 1e4 0 0.3 tangential mindlin NULL 0 0.4 damping velocity")
    lmp.run_well(script(law, steps=100, every=1000) + f"""\
dump t all custom 20 path {columns}
dump_modify t format float %.17g sort id
run 100
undump t
undump d
dump d all custom 20 out {COLUMNS}
dump_modify d format float %.17g sort id
rerun path dump x y z vx vy vz
""", folder)
    again = lmp.read_dump(folder / "out")
    lmp.run_well(script(law, steps=200, every=1000).replace("run 200\n", "") + f"""\
undump d
dump d all custom 20 fresh {COLUMNS}
dump_modify d format float %.17g sort id
rerun path dump x y z vx vy vz
""", folder)
    fresh = lmp.read_dump(folder / "fresh")
    fact("snapshots", len(again) == 6, str(sorted(again)))
    forces = [{step: {i: row[9:12] for i, row in rows.items()} for step, rows in dump.items()} for dump in (again, fresh)]
    at_most("forces", lmp.largest_difference(*forces), 1e-12)


ACROSS = """\
region b block 0 4 0 4 0 4
create_box 1 b
create_atoms 1 single {} 2 2
create_atoms 1 single {} 2 2
set group all diameter 1 density 1
{}
fix i all nve/noforce
"""


def test_short_cutoff(folder):
    """Grains that touch further apart than a cutoff that is given act on each other, also across a periodic face."""
    for style, coeff in (("granular/lsdcd", ""), ("granular/lsdcd 0.3", ""), ("granular/lsdcd", "cutoff 0.3")):
        law = ours(f"* * hertz 1e4 0 tangential linear_nohistory 0 0 damping velocity {coeff}", style=style)
        lmp.run_well(settings() + ACROSS.format(0.3, 3.4, law) + dump("out", 1) + "run 0\n", folder)
        push = lmp.read_dump(folder / "out")[0][1][9]
        at_most(f"{style} {coeff}: the push across the face", abs(push / (1e4 * 0.1 * (0.25 * 0.1)**0.5) - 1), 1e-10)


def test_growth(folder):
    """Radii that fix adapt makes larger than lists are for are an error, whether lists are made anew or not; runs begin with new ones."""
    law = ours("* * hertz 1e4 0 tangential linear_nohistory 0 0 damping velocity")
    text = settings() + "atom_style sphere 1\n" + ACROSS.format(1, 2.5, law) + """\
variable d equal 1+step*0.001
fix grow all adapt 1 atom diameter v_d
""" + dump("out", 700)
    for check, says in (("yes", "contacts would be missed"), ("no", "end the run before")):
        lmp.refused(f"check {check}", text + f"neigh_modify delay 0 every 1 check {check}\nrun 700\n", folder, says)
    # A grain that becomes as large as the others are, after the list was made.
    lmp.refused("in the setup", text.replace("fix grow", "set atom 2 diameter 0.3\nfix grow") + "run 0\n", folder, "it was 0.15", "set radii before")
    # Lists that are anew in each step hold grains up to a cutoff that is given.
    wide = text.replace("granular/lsdcd\n", "granular/lsdcd 1.8\n") + "neigh_modify delay 0 every 1 check no\nrun 700\n"
    for name, run in (("many runs", text + "run 700 every 20 NULL\n"), ("a cutoff", wide)):
        lmp.run_well(run, folder)
        push = lmp.read_dump(folder / "out")[700][1][9]
        at_most(f"{name}: the push", abs(push / (-1e4 * 0.2 * (0.425 * 0.2)**0.5) - 1), 1e-10)


def test_growth_before_a_run_without_setup(folder):
    """The command set makes grains larger than lists are for, and one as large as the others are."""
    text = settings() + ACROSS.format(1, 2.5, ours("* * hooke 1000 0 tangential linear_nohistory 0 0 damping velocity"))
    for before, after, says in (("", "set group all diameter 1.7", "is 0.85"), ("set atom 2 diameter 0.3", "set atom 2 diameter 0.9", "it was 0.15")):
        lmp.refused(after, text + f"{before}\nrun 5\n{after}\nrun 5 pre no\n", folder, "contacts would be missed", says)


def test_growth_by_fix_set(folder):
    """As by fix adapt."""
    plain, wide = (settings() + ACROSS.format(1, 2.5, ours("* * hooke 1000 0 tangential linear_nohistory 0 0 damping velocity", style=style)) +
                   lmp.set_in_run(1, 1, 2, diameter="1+step*0.001") + dump("out", 700) for style in ("granular/lsdcd", "granular/lsdcd 1.8"))
    for style, check, says in ((plain, "yes", "contacts would be missed"), (plain, "no", "end the run before"), (wide, "yes", "since neighbor lists")):
        lmp.refused(f"check {check}", style + f"neigh_modify delay 0 every 1 check {check}\nrun 700\n", folder, says)
    for name, run in (("a cutoff", wide + "neigh_modify delay 0 every 1 check no\nrun 700\n"), ("many runs", plain + "run 700 every 20 NULL\n")):
        lmp.run_well(run, folder)
        # Step 700 has what was set at the end of step 699: an overlap of 1.699 - 1.5.
        at_most(name, abs(lmp.read_dump(folder / "out")[700][1][9] / -199 - 1), 1e-10)


LARGE_AND_SMALL = """\
create_atoms 1 single -2 -2 0
create_atoms 2 single -0.49 0 0
create_atoms 2 single 0.49 0 0
set type 1 diameter 0.1 density 1
set type 2 diameter 1 density 1
fix i all nve/noforce
neigh_modify delay 0 every 1 check no
"""


@pytest.mark.parametrize("law", ["hooke 1000 0 tangential linear_nohistory 0 0", "jkr 1000 0 0.3 1 tangential linear_nohistory 0 0"])
def test_large_grains_of_another_type(folder, law):
    """Large grains that fix set gives the type of small ones still touch, also where LAMMPS makes lists by types: for jkr, and with neighbor multi."""
    begin = lmp.head("-4 4 -4 4 -4 4", "p p p", types=2, more="processors * 1 1\n") + LARGE_AND_SMALL
    right = "granular" if lmp.ON_HOST else "granular/lsdcd"    # 29Sep2021 ends by jkr without history
    lmp.run_well(begin + "neighbor 0.05 bin\n" + ours("* * " + law, style=right) + "\n" + dump("theirs", 10) + "run 10\n", folder)
    theirs = lmp.read_dump(folder / "theirs")
    fact("they touch", abs(theirs[10][2][9]) > 0.1, str(theirs[10][2]))
    for neighbor in ("neighbor 0.05 bin\n", "neighbor 0.05 multi\ncomm_modify mode multi vel yes\n"):
        for ranks in (1, 2):
            lmp.run_well(begin + neighbor + ours("* * " + law) + "\n" + lmp.set_in_run(1, 1, 3, type="1") + dump("out", 10) + "run 10\n", folder, ranks)
            at_most(f"{neighbor.split()[2]}, {ranks} ranks", lmp.largest_difference(theirs, lmp.read_dump(folder / "out")), 1e-10)


def test_another_type_is_no_growth(folder):
    """Lists by radii hold a large grain of any type, where there are grains whose radii fix adapt sets, too."""
    text = lmp.head("-4 4 -4 4 -4 4", types=2, style="sphere 1") + LARGE_AND_SMALL + """\
group small id 1
variable d equal 0.1
fix grow small adapt 1 atom diameter v_d
""" + ours("* * hooke 1000 0 tangential linear_nohistory 0 0 damping velocity") + "\n" + dump("out", 10)
    changes = {"set": "run 5\nset group all type 1\nrun 5 pre no\n", "fix set": lmp.set_in_run(1, 1, 3, type="1") + "run 10\n"}
    for name, change in changes.items():
        lmp.run_well(text + change, folder)
        at_most(f"{name}: the push", abs(lmp.read_dump(folder / "out")[10][2][9] / (-1000 * 0.02) - 1), 1e-12)


def test_hybrid_of_laws(folder):
    """Within a hybrid style two types whose laws cannot be mixed may have a pair of another style."""
    laws = ("hooke 1e4 0 tangential linear_nohistory 0 0", GRANULAR)
    plain = states(folder, ours(f"1 1 {laws[0]}", f"2 2 {laws[1]}", f"1 2 {laws[0]}"), name="plain", data="two.data")
    hybrid = states(folder, "pair_style hybrid granular/lsdcd gran/hooke 1e4 0 0 0 0 0\n" +
                    f"pair_coeff 1 1 granular/lsdcd {laws[0]}\npair_coeff 2 2 granular/lsdcd {laws[1]}\npair_coeff 1 2 gran/hooke", data="two.data")
    at_most("hybrid", lmp.largest_difference(plain, hybrid), 1e-10)


def test_excluded(folder):
    """Pairs that neigh_modify exclude leaves out do not act."""
    gas = states(folder, ours("* * " + GRANULAR), more="neigh_modify exclude type 1 1")
    first, last = gas[0], gas[max(gas)]
    still = max(abs(a - b) for i in first for a, b in zip(first[i][3:6], last[i][3:6]))
    at_most("excluded: velocities", still, 0)


def test_energy(folder):
    """Grains that nothing damps or rubs keep their energy, of motion and elastic: pe has it."""
    text = lmp.run_well(script(ours("* * hertz 1e4 0 tangential linear_nohistory 0 0 damping velocity"), steps=2000), folder)
    rows = lmp.read_thermo(text)
    total = [row[1] + row[2] for row in rows]
    at_most("total energy", max(abs(e / total[0] - 1) for e in total), 1e-4)


def test_pair_local(folder):
    """compute pair/local sees each pair: pushes and friction add up to the forces of all grains. It reads velocities of another time
    than the step does: without dashpots."""
    law = "hertz/material 1e4 0 0.3 tangential mindlin_rescale NULL 0 0.4 damping velocity rolling sds 300 0 0.3"
    lmp.run_well(script(ours("* * " + law), steps=100, newton="on", more="""\
compute p all pair/local dist force p1 p2 p3 p4 p10 p11 p12 cutoff radius
compute i all property/local patom1 patom2 cutoff radius
dump p all local 100 pairs index c_i[1] c_i[2] c_p[2] c_p[3] c_p[4] c_p[5] c_p[6] c_p[7] c_p[8] c_p[9]
dump_modify p format float %.17g"""), folder)
    forces = lmp.read_dump(folder / "out")[100]
    sums = {i: [0.0] * 3 for i in forces}
    lines = (folder / "pairs").read_text().split("ITEM: TIMESTEP")[-1].split("\n")
    count = 0
    for line in lines:
        words = line.split()
        if len(words) != 11 or words[0] == "ITEM:":
            continue
        _, i, j, push, *rest = (float(w) for w in words)
        dist = sum(a * a for a in rest[4:7])**0.5
        count += 1
        for k in range(3):
            f = push * rest[4 + k] / dist + rest[k]
            sums[int(i)][k] += f
            sums[int(j)][k] -= f
    most = max(abs(a) for row in forces.values() for a in row[9:12])
    worst = max(abs(a - b) for i in forces for a, b in zip(sums[i], forces[i][9:12]))
    fact("pairs are listed", count > 100, str(count))
    at_most("pair/local: forces", worst / most, 1e-12)


def test_refusals(folder):
    for name, coeff, says in (("mdr", "* * mdr 1e4 0.3 1 1 0.5 0.5 tangential linear_nohistory 1 1", "suffix off"),
                              ("no law", "* *", "two atom types and a law"),
                              ("bad sub-model", "* * hooke 1 1 tangential mindlyn 1 1 1", "'mindlyn' is not a sub-model"),
                              ("limited adhesion, with the syntax of two grains", "* * jkr 1e5 0.7 0.3 0.3 tangential mindlin NULL 0.6 0.4 limit_damping",
                               "leave limit_damping out. Syntax: granular hooke|hertz|hertz/material|dmt|jkr|hysteretic|hysteretic/size|hysteretic/edem|eepa|lepa|thornton ... tangential MODEL ... [damping MODEL] [rolling MODEL ...] "
                               "[twisting MODEL ...] [heat MODEL ...] [cohesion MODEL ...] [limit_damping] (")):
        lmp.refused(name, script(ours(coeff)), folder, says)
    exact = "* * hooke 1e4 {} tangential linear_nohistory 0 0 damping coeff_restitution"
    lmp.refused("a restitution in metal", script(ours(exact.format(0.5)), units="metal"), folder, "in the law of types 1 and 1", "returns the restitution e",
                "in those that are used it gives 9648.53")
    lmp.refused("a part of a critical dashpot in metal", script(ours("* * law hooke/history 1e4 NULL 0 NULL 0.4 1 rolling epsd 0.3 0.2"), units="metal"), folder,
                "(epsd or epsd3) is the part of the critical dashpot")
    lmp.run_well(script(ours(exact.format(1)), units="metal", steps=1), folder)    # has no dashpot
    lmp.refused("no ghost velocities", script(ours("* * " + GRANULAR), more="comm_modify vel no"), folder, "comm_modify vel yes")


def test_materials(folder):
    """A material file gives what its numbers give: those that the log tells."""
    (folder / "mine.lsdcd").write_text("""\
units si
material soft
  youngs_modulus    1e4  Pa
  poissons_ratio    0.3  1
pair soft soft
  restitution       0.7  1
  sliding_friction  0.4  1
""")
    text = lmp.run_well(script(ours("* * law material mine.lsdcd soft"), name="material", units="si"), folder)
    lmp.run_well(script(ours("* * " + GRANULAR.replace("NULL 0.5", "NULL 1")), name="numbers", units="si"), folder)
    told = [line.split(": ", 1)[1] for line in text.split("\n") if line.startswith("  types 1 1: ")]
    fact("the log has the law", told and told[0].startswith("granular hertz/material "), str(told))
    at_most("material", lmp.largest_difference(lmp.read_dump(folder / "material"), lmp.read_dump(folder / "numbers")), 1e-10)
    (folder / "two.lsdcd").write_text("units si\n" + "".join(
        f"material {name}\n  youngs_modulus {e} Pa\n  poissons_ratio 0.3 1\n" for name, e in (("soft", 1e4), ("hard", 1e5))) + "".join(
        f"pair {pair}\n  restitution {e} 1\n  sliding_friction 0.4 1\n" for pair, e in (("soft soft", 0.7), ("hard hard", 0.9), ("soft hard", 0.5))))
    two = [f"{i} {i} law material two.lsdcd {name}" for i, name in ((1, "soft"), (2, "hard"))]
    for more in ([], ["1 2 law material two.lsdcd soft on hard"]):
        text = lmp.run_well(script(ours(*two, *more), steps=0, data="two.data", units="si"), folder)
        fact(f"{'no ' * bool(more)}types are mixed of two materials", ("a file says of both materials comes by pair_coeff 1 2 law material FILE A on B" in text) == (not more),
             text[-800:])
    syntax = (". Syntax: pair_coeff I J law [granular] [hertz/material|jkr|dmt|hysteretic/edem|thornton] material FILE A [on B] [with [MATERIAL] KEY VALUE ...] "
              "[sub-models, NULL for a number of the file] [cutoff C]")
    for name, words, says in (("file", "", "the file name is missing"), ("second material", " mine.lsdcd soft hard", "'hard' is not a keyword: if it is the material of the "
                               "other grain, write 'on hard'"), ("other", " mine.lsdcd soft on", "after 'on' the material of the other grain is missing"),
                              ("word behind", " mine.lsdcd soft damping tsuji more", "'more' is not expected"),
                              ("override", " mine.lsdcd soft with restitution 2", "restitution")):
        lmp.refused(f"{name}: the syntax of two grains", script(ours(f"* * law material{words}"), units="si"), folder, says + syntax * (name != "override"))


def test_timestep(folder):
    """The log tells the longest timestep that resolves the shortest contact, of the smallest grains, and warns above it: half a period of
    hooke is pi sqrt(m/2 / k)."""
    law = ours("* * hooke 1e4 0 tangential linear_nohistory 0 0 damping velocity")
    small = lmp.head("0 4 0 4 0 4") + "create_atoms 1 single 1 1 1\ncreate_atoms 1 single 3 3 3\nset group all diameter 1 density 2\n" + law + "\n"
    mass = 2 * 3.141592653589793 / 6
    longest = 3.141592653589793 * (mass / 2 / 1e4)**0.5 / 10
    for dt, warns in ((0.99 * longest, False), (1.01 * longest, True)):
        text = lmp.run_well(small + f"timestep {dt}\nfix i all nve/sphere\nrun 0\n", folder)
        told = re.search(r"the timestep should be at most ([-+.\de]+)", text)
        fact("the longest timestep is told", bool(told), text[-500:])
        at_most("the longest timestep", abs(float(told[1]) / longest - 1), 1e-4)
        fact(f"timestep {dt}: warned" if warns else f"timestep {dt}: not warned", ("contacts will not be resolved" in text) == warns)


# Grains of diameter 1 that a box with another width along y lets touch on both sides, and that spin about z as in gears.
IN_A_SLICE = """\
neighbor 0.05 bin
neigh_modify delay 0 every 7 check no
{pair}
{atoms}
set group all diameter 1 density 1
set group all omega 0 0 2
fix i all nve/noforce
timestep 1e-4
"""
SLICES = {"two images": ("-5 5 0 1.9 -5 5", "create_atoms 1 single 0 0.3 0\ncreate_atoms 1 single 0 1.25 0\n"),
          "its own image": ("-5 5 0 0.95 -5 5", "create_atoms 1 single 0 0.3 0\n"),
          "two images in a tilted box": ("-5 5 0 1.9 -5 5 0 0 0.2", "create_atoms 1 single 0 0.3 0\ncreate_atoms 1 single 0 1.25 0\n")}


@pytest.mark.parametrize("newton", ["off", "on"])
@pytest.mark.parametrize("slice", SLICES)
def test_narrow_box(folder, slice, newton):
    """A grain that touches two images of another, or of itself, has two springs, which go with it to other processes and into restart
    files. Surfaces slip by 2 w R: the torque is that of two such contacts at an arm of R, and forces cancel."""
    box, atoms = SLICES[slice]
    start = lmp.head(box, "p p p", newton=newton)
    rest = IN_A_SLICE.format(pair=ours("* * law hooke/history 1e4 5e3 0 0 100 0"), atoms=atoms)
    for ranks in (1, 2):
        lmp.run_well(start + rest + "run 505\n" + dump("out", 500) + "run 500\nwrite_restart r\n", folder, ranks)
        again = rest.replace(atoms, "").replace("set group all diameter 1 density 1\n", "")
        lmp.run_well(lmp.head("", "p p p", newton=newton) + "read_restart r\n" + again + dump("later", 995) + "run 995\n", folder, ranks)
        for name, step in (("out", 1000), ("later", 1990)):
            expected = -2 * 0.5 * 5e3 * (2 * 2 * 0.5) * 1e-4 * step
            for number, row in lmp.read_dump(folder / name)[step].items():
                where = f"{slice}, newton {newton}, {ranks} ranks, step {step}, grain {number}"
                at_most(where + ": torque", abs(row[14] / expected - 1), 1e-10)
                at_most(where + ": friction", abs(row[9]), 1e-9 * abs(expected))


@pytest.mark.parametrize("cutoff", [1, 2.5])
def test_images_in_a_list(folder, cutoff):
    """Lists of jkr reach as far as the pair style's cutoff. One image of a grain that touches and one that does not have one spring,
    which is that of the first: the friction is k 2 w R t, and forces cancel."""
    atoms = "create_atoms 1 single 0 0.3 0\ncreate_atoms 1 single 0 1.25 0\n"
    law = ours("* * jkr 1e4 0 0.3 0.01 tangential linear_history 5e3 0 100", style=f"granular/lsdcd {cutoff}")
    lmp.run_well(lmp.head("-5 5 0 2.6 -5 5", "p p p") + IN_A_SLICE.format(pair=law, atoms=atoms) + dump("out", 100) + "run 100\n", folder)
    rows = lmp.read_dump(folder / "out")[100]
    expected = 5e3 * (2 * 2 * 0.5) * 1e-4 * 100
    for number, sign in ((1, 1), (2, -1)):
        at_most(f"friction on grain {number}, cutoff {cutoff}", abs(rows[number][9] - sign * expected), 1e-9 * expected)


# Pairs of laws and whether their springs mean the same.
DISPLACEMENT = "hooke 1e4 0 tangential linear_history 5e3 0 1 damping velocity"
OTHER = {"hooke 2e4 0 tangential linear_history 2.5e3 0 1 damping velocity": True,
         "hertz 1e4 0 tangential mindlin/force 5e3 0 1 damping velocity": False,
         DISPLACEMENT + " rolling sds 300 0 1": False,
         "hooke 1e4 0 tangential linear_nohistory 0 1 damping velocity": None}


@pytest.mark.parametrize("law", OTHER)
def test_types_change(folder, law):
    """A contact whose grains get other types begins anew where the law of these keeps other numbers, and the log tells it; where the
    numbers are the same, springs stay."""
    text = lmp.head("0 4 0 4 0 4", types=2) + f"""\
create_atoms 1 single 1 2 2
create_atoms 1 single 1.98 2 2
set group all diameter 1 density 1
set group all omega 0 0 0.1
{ours("1 1 " + DISPLACEMENT, "2 2 " + law, "1 2 " + DISPLACEMENT)}
fix i all nve/noforce
timestep 1e-4
run 1000
write_dump all custom first {COLUMNS}
"""
    pairs = "\n".join(line for line in text.split("\n") if line.startswith("pair_")) + "\n"
    # R w t on both sides, and in a step more.
    spring, more = 2 * 0.5 * 0.1 * 0.1, 2 * 0.5 * 0.1 * 1e-4
    changes = {"set": "set group all type 2\nrun 0\n", "set, with lists as they are": "set group all type 2\nrun 1 pre no\n",
               "restart": "set group all type 2\nwrite_restart r\nclear\n" + lmp.head() + "read_restart r\n" + pairs + "run 0\n",
               "set after a restart": "write_restart r\nclear\n" + lmp.head() + "read_restart r\n" + pairs + "set group all type 2\nrun 0\n"}
    for name, change in changes.items():
        said = lmp.run_well(text + change + f"write_dump all custom second {COLUMNS}\n", folder)
        before, after = (max(lmp.read_dump(folder / f).items())[1][1][10] for f in ("first", "second"))
        at_most(f"{law}, {name}: friction before", abs(abs(before) / (5e3 * spring) - 1), 1e-10)
        expected = 2.5e3 * spring if OTHER[law] else 0
        at_most(f"{law}, {name}: friction", abs(abs(after) - expected), 5e3 * more if "lists" in name else 1e-10)
        fact(f"{law}, {name}: said", ("begin anew" in said) == (OTHER[law] is not True), said[-500:])


# ---- LAMMPS 4Jul2026 ------------------------------------------------------------------------

NORMAL = ["hooke 1e4 5", "hertz 1e4 5", "hertz/material 1e4 5 0.3", "dmt 1e4 5 0.3 3", "jkr 1e4 5 0.3 3"]
DAMPING = ["velocity", "mass_velocity", "viscoelastic"]
TANGENTIAL = ["linear_nohistory 0.5 0.4", "linear_history 500 0.5 0.4", "mindlin 1e3 0.5 0.4", "mindlin/force 1e3 0.5 0.4",
              "mindlin_rescale 1e3 0.5 0.4", "mindlin_rescale/force 1e3 0.5 0.4"]


@lmp.of_host
def test_as_granular(folder):
    """Each combination of sub-models is that of LAMMPS's pair granular, where that is right: tsuji has another mass, marshall beside
    mindlin lacks the contact radius, and a setup winds the spring of twisting up where its dashpot alone is beyond the limit, so
    that a dashpot is there below it, and the limit without a dashpot."""
    twisting = ["twisting sds 30 1 300", "twisting sds 30 0 0.003"]
    rng = random.Random(3)
    combinations = [(n, d, t) for n in NORMAL for d in DAMPING for t in TANGENTIAL]
    for n, d, t in rng.sample(combinations, 10 if lmp.QUICK else len(combinations)):
        beside = rng.choice(["", "rolling sds 300 2 0.3", *twisting, *(f"rolling sds 300 2 0.3 {t}" for t in twisting)])
        law = f"* * {n} tangential {t} damping {d} {beside}"
        # A pair that crosses a border has wrong signs there: so short that no list is made anew.
        theirs = states(folder, ours(law, style="granular"), steps=10, every=5, name="theirs")
        own = states(folder, ours(law), steps=10, every=5)
        at_most(law, lmp.largest_difference(theirs, own), 1e-12)


@lmp.of_host
def test_types_change_in_a_run(folder):
    """Fix set changes types in the middle of a run: the contact begins anew, and slips R w t on both sides from then on."""
    other = "hertz 1e4 0 tangential mindlin/force 5e3 0 1 damping velocity"
    for newton, every in (("off", 1), ("on", 1), ("off", 100)):
        lmp.run_well(lmp.head("0 4 0 4 0 4", types=2, newton=newton) + f"""\
neigh_modify delay 0 every {every} check no
create_atoms 1 single 1 2 2
create_atoms 1 single 1.98 2 2
set group all diameter 1 density 1
set group all omega 0 0 0.1
{ours("1 1 " + DISPLACEMENT, "2 2 " + other, "1 2 " + DISPLACEMENT)}
variable type atom 1+(step>=500)
fix change all set 1 0 group all type v_type
fix i all nve/noforce
timestep 1e-4
{dump("out", 1000)}run 1000
""", folder)
        radius = (0.25 * 0.02)**0.5    # of the contact, sqrt(R_eff overlap)
        expected = 5e3 * radius * 2 * 0.5 * 0.1 * 0.05
        at_most(f"newton {newton}, lists each {every}: friction", abs(abs(lmp.read_dump(folder / "out")[1000][1][10]) / expected - 1), 1e-10)


@lmp.of_host
def test_wall_under_the_suffix(folder):
    """LAMMPS cuts the suffix off the wall's name in restart files, and would lose its springs: the wall refuses to be written."""
    lmp.flat_floor(folder)
    text = lmp.head("-3 3 -3 3 -1 5") + """\
create_atoms 1 single 0 0 0.49
set group all diameter 1 density 2
pair_style zero 1.2
pair_coeff * *
fix w all wall/lsdcd hooke/history 1e4 NULL 10 NULL 0.5 1 mesh floor.stl
run 0
write_restart r
"""
    lmp.refused("wall with springs under -sf lsdcd", "suffix lsdcd\n" + text, folder, "suffix off")
    lmp.run_well("suffix lsdcd\n" + text.replace("hooke/history", "hooke"), folder)


@lmp.of_host
@pytest.mark.parametrize("law", ["hertz/material 1e4 40 0.3 tangential mindlin 9e3 0.5 0.4 heat area 0.3",
                                 "jkr 1e4 40 0.3 20 tangential mindlin 9e3 0.5 0.4 heat radius 0.3"])
def test_heat_stress_and_contacts(folder, law):
    """Heat flows, temperatures, contacts of each grain and the pressure are those of LAMMPS's pair granular, also where processes share the
    grains anew."""
    more = """\
variable T atom id*0.01
set group all temperature v_T
fix h all heat/flow constant 1.0
compute t all property/atom temperature heatflow
compute c all contact/atom
"""
    read = "fix prop all property/atom temperature heatflow ghost yes\nread_data grains.data fix prop NULL NULL\n"

    def results(style, name, ranks=1, balance="", newton="off"):
        text = script(ours("* * " + law, style=style), steps=300, every=100, name=name, more=more + balance, newton=newton)
        text = text.replace("read_data grains.data\n", read).replace(COLUMNS, COLUMNS + " c_t[1] c_t[2] c_c")
        text = text.replace("thermo_style custom step ke pe press\n", "thermo_style custom step ke press pxy\nthermo_modify format float %.15g\n")
        rows = lmp.read_thermo(lmp.run_well(text, folder, ranks))
        return lmp.read_dump(folder / name), rows

    right = {newton: results("granular", "theirs", newton=newton) for newton in ("off", "on")}
    temperatures = [[row[-3] for row in right[newton][0][300].values()] for newton in right]
    at_most("temperatures of newton on", max(abs(a / b - 1) for a, b in zip(*temperatures)), 1e-10)
    for ranks, balance, newton in ((1, "", "off"), (1, "", "on"), (4, "fix b all balance 50 1.0 shift xyz 5 1.05\n", "off"), (2, "", "on")):
        own, own_pressure = results("granular/lsdcd", "out", ranks, balance, newton)
        theirs, pressure = right[newton]
        if newton == "on":    # fix heat/flow sends no heat in a setup
            theirs, own = ({step: rows for step, rows in grains.items() if step > 0} for grains in (theirs, own))
        at_most(f"{ranks} ranks, newton {newton}: grains", lmp.largest_difference(theirs, own), 1e-10)
        worst = max(abs(a / b - 1) for rows in zip(pressure, own_pressure) for a, b in zip(*rows) if b)
        at_most(f"{ranks} ranks, newton {newton}: motion and stress", worst, 1e-10)
    without = script(ours("* * " + law), newton="on").replace("read_data grains.data\n", read)
    lmp.refused("newton on without fix heat/flow", without, folder, "there is none: write that fix, or 'newton off'")
