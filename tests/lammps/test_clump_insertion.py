# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Clumps of fix insert/lsdcd, by the molecules that lsdcd clump makes, under the LAMMPS of hosts/build_host.sh, whose headers have
molecules: numpy knows how spheres lie in the files, and compute rigid/local what bodies fix rigid/small has made of them."""

import math

import command
import lmp
import numpy as np
import pytest
import stl
from facts import at_most, fact

LISTS = {"four": ("0 0 0 1\n1 0.2 0 0.9\n1.2 1 0.3 0.7\n0.5 0.5 0.9 0.8\n", 3, 1),
         "rod": ("".join(f"{0.6 * k} 0 0 0.5\n" for k in range(-2, 3)), 2, 2)}
SHARE = 0.3    # of the first kind
BEGIN = lmp.head(boundary="p p f", comm="vel yes cutoff 6")
MOLECULES = "fix number all property/atom mol ghost yes\nmolecule clumps four.mol rod.mol\n"
FORCES = """\
{pairs}
fix             bodies all rigid/small molecule mol clumps
fix             in all insert/lsdcd region top mol clumps fraction 0.3 0.7 rigid bodies {words}
thermo_style    custom step f_in[1] f_in[2] f_in[3]
thermo_modify   format float %.17g
thermo          100
timestep        1e-3
dump            atoms all custom {every} atoms id mol type x y z xu yu zu vx vy vz radius mass
dump_modify     atoms format float %.17g sort id
"""
PAIRS = lmp.pairs("zero 2.2", 0.5, "delay 0 every 1 check yes exclude molecule/intra all")
REST = ((lmp.pairs("granular", 0.5, "delay 0 every 1 check yes exclude molecule/intra all", "hooke 1e4 10 tangential linear_nohistory 1 0.5")) +
        "fix pull all gravity 1 vector 0 0 -1\n")


def box(side):
    return f"region box block 0 {side} 0 {side} 0 {side}\ncreate_box 2 box\nregion top block INF INF INF INF 4 {side - 4}\n"


def prepare(folder):
    """Makes the two molecules, and returns what lsdcd clump told of them."""
    told = []
    for name, (spheres, density, type_) in LISTS.items():
        (folder / f"{name}.txt").write_text(spheres)
        told.append(command.told(folder, "clump", "--list", f"{name}.txt", "--density", density, "--type", type_, "-o", f"{name}.mol"))
    return told


def floor(folder, side, height):
    stl.write(folder / "floor.stl", stl.sheet(1, lambda i, j: (side * i, side * j, height)))


def template(name):
    return np.array([line.split() for line in LISTS[name][0].splitlines()], float)


def last_atoms(folder, name="atoms"):
    """Rows of the last step as they are dumped: ID, molecule, type, place, place without the box, velocity, radius, mass."""
    return np.array([line.split() for line in (folder / name).read_text().split("ITEM: ATOMS")[-1].splitlines()[1:]], float)


def clumps_of(atoms):
    """Kind of each molecule, and the rows of its atoms, in the order of IDs."""
    return [(int(atoms[first, 2]) - 1, atoms[first:last]) for first, last in
            zip(*(lambda ends: (ends[:-1], ends[1:]))(np.flatnonzero(np.diff(atoms[:, 1], prepend=-1, append=-1))))]


def shape_error(clumps):
    """By how much distances of spheres of a clump differ from those in its list."""
    most = 0
    for kind, name in enumerate(LISTS):
        x = np.array([rows[:, 6:9] for k, rows in clumps if k == kind])
        as_listed = template(name)[:, :3]
        d = np.linalg.norm(x[:, :, None] - x[:, None], axis=-1)
        most = max(most, np.abs(d - np.linalg.norm(as_listed[:, None] - as_listed[None], axis=-1)).max())
    return most


def least_gap(atoms, side):
    """Between spheres of two molecules, in a box that is periodic in x and y. By all pairs of a list in the order of z."""
    atoms = atoms[np.argsort(atoms[:, 5])]
    x, r, molecule, least = atoms[:, 3:6], atoms[:, 12], atoms[:, 1], math.inf
    reach = 2 * r.max()
    for k in range(1, len(x)):
        up = x[k:, 2] - x[:-k, 2]
        if up.min() > reach:
            break
        i = np.flatnonzero(up < reach)
        along = np.abs(x[i + k, 0] - x[i, 0])
        i = i[(np.minimum(along, side - along) < reach) & (molecule[i + k] != molecule[i])]
        d = x[i + k] - x[i]
        d[:, :2] -= side * np.round(d[:, :2] / side)
        least = min(least, (np.sqrt((d * d).sum(1)) - r[i + k] - r[i]).min(initial=math.inf))
    return least


@lmp.of_host
def test_all_at_once(folder):
    """1e4 clumps beside a floor."""
    told, side = prepare(folder), 70
    floor(folder, side, 30)
    text = lmp.run_well(BEGIN + box(side) + MOLECULES + "fix floor all wall/lsdcd hooke 1e4 NULL 10 NULL 0.5 1 mesh floor.stl\n" +
                        FORCES.format(pairs=PAIRS, words="number 10000 vel 1 2 -3", every=1) + "run 1\n", folder)
    atoms = last_atoms(folder)
    clumps = clumps_of(atoms)
    fact("1e4 clumps", len(clumps) == 10000 == lmp.read_thermo(text)[-1][1], str(len(clumps)))
    # Places are of 70, rounded to 1e-14.
    gap = least_gap(atoms, side)
    fact("least gap of two clumps", -1e-12 < gap < 1e-3, str(gap))
    above = (np.abs(atoms[:, 5] - 30) - atoms[:, 12]).min()
    fact("least gap of a clump and the floor", -1e-12 < above < 0.01, str(above))
    at_most("clumps have their shapes", shape_error(clumps), 1e-12)
    masses = sum(told[kind]["mass"] for kind, _ in clumps)
    at_most("their mass", abs(lmp.read_thermo(text)[-1][2] / masses - 1), 1e-12)
    at_most("mass of their atoms", abs(atoms[:, 13].sum() / masses - 1), 1e-12)
    # Four standard deviations of means over 1e4 clumps, and over 7e3 rods of which the square of a cosine has that of 2/sqrt(45).
    at_most("share of the first kind", abs(sum(kind == 0 for kind, _ in clumps) / 10000 - SHARE), 4 * math.sqrt(0.21 / 1e4))
    ends = np.array([rows[-1, 6:9] - rows[0, 6:9] for kind, rows in clumps if kind == 1])
    cosines = (ends / np.linalg.norm(ends, axis=1)[:, None])**2
    at_most("turns are uniform", np.abs(cosines.mean(0) - 1 / 3).max(), 4 * 2 / math.sqrt(45 * len(ends)))
    fact("velocities", (atoms[:, 9:12] == (1, 2, -3)).all())


@lmp.of_host
def test_bodies(folder):
    """The bodies of fix rigid/small have the mass, inertia and axes that lsdcd clump told of, before LAMMPS sums their atoms anew: in
    their first step forces act on them for half of it, which turn them as their tensor has it."""
    told, dt = prepare(folder), 1e-3
    push = "variable push atom 1e3*(id%3-1)\nfix push all addforce v_push 0 0\n"
    lmp.run_well(BEGIN + box(40) + MOLECULES + push + FORCES.format(pairs=PAIRS, words="number 200 vel 0 0 -2", every=1) + "run 1\n", folder)
    clumps, worst = clumps_of(last_atoms(folder)), 0
    for kind, atoms in clumps:
        listed, clump = template(list(LISTS)[kind])[:, :3], told[kind]
        x, force = atoms[:, 6:9], np.outer(1e3 * (atoms[:, 0] % 3 - 1), (1, 0, 0))
        # The rotation between two sets of points (Kabsch).
        u, _, v = np.linalg.svd((listed - listed.mean(0)).T @ (x - x.mean(0)))
        turn = v.T @ np.diag((1, 1, np.linalg.det(v.T @ u.T))) @ u.T
        xx, yy, zz, xy, xz, yz = clump["inertia"]
        arm = x - x.mean(0) - turn @ (clump["centre"] - listed.mean(0))
        tensor = turn @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ turn.T
        omega = np.linalg.solve(tensor, dt / 2 * np.cross(arm, force).sum(0))
        gained = dt / 2 * force.sum(0) / clump["mass"] + np.cross(omega, arm)
        worst = max(worst, np.abs(atoms[:, 9:12] - (0, 0, -2) - gained).max() / np.abs(gained).max())
    fact("200 bodies", len(clumps) == 200, str(len(clumps)))
    # LAMMPS's Jacobi rotations, which find the axes, end at 1e-8 and less.
    at_most("bodies gain velocities as lsdcd clump has it", worst, 1e-7)


@lmp.of_host
def test_rate_restart_processes(folder):
    """A rate to a grain. A file in mid-feed and two processes change no clump, also where they have fallen on each other."""
    prepare(folder)
    feed = FORCES.format(pairs=REST, words="numberrate 50 number 90 vel 0 0 -3 jitter 0.5", every=1000)
    begin = BEGIN + box(24) + MOLECULES + "fix floor all wall/lsdcd hooke 1e4 NULL 10 NULL 0.5 1 mesh floor.stl\n"
    floor(folder, 24, 2)
    text = lmp.run_well(begin + feed + "run 1000\nwrite_restart mid.restart\nrun 1000\n", folder)
    for step, number, _, late in lmp.read_thermo(text):
        # A grain is due in the step in which the amount has reached it.
        due = min(90, math.floor(50e-3 * step + 1e-9))
        at_most(f"number at step {step:g}", abs(number + late - due), 1)
    atoms, end = last_atoms(folder), lmp.read_thermo(text)[-1]
    clumps = clumps_of(atoms)
    fact("90 clumps", len(clumps) == 90, str(len(clumps)))
    # Shapes hold by rotations of quaternions of length 1, to rounding in each of 2000 steps.
    at_most("clumps keep their shapes", shape_error(clumps), 1e-10)
    fact("clumps have turned", np.abs(atoms[:, 9:12] - atoms[:, 9:12].mean(0)).max() > 1)
    for ranks in (1, 2):
        restart = BEGIN + "read_restart mid.restart\n" + box(24).split("create_box 2 box\n")[1] + begin.split(box(24))[1] + feed + "run 1000\n"
        again = lmp.run_well(restart, folder, ranks)
        others = last_atoms(folder)
        fact(f"restart on {ranks}: number and mass", lmp.read_thermo(again)[-1][1:3] == end[1:3], str(lmp.read_thermo(again)[-1]))
        fact(f"restart on {ranks}: the same clumps", (others[:, :3] == atoms[:, :3]).all())
    two = lmp.run_well(begin + feed + "run 2000\n", folder, 2)
    fact("2 processes: number and mass", lmp.read_thermo(two)[-1][1:3] == end[1:3], str(lmp.read_thermo(two)[-1]))
    fact("2 processes: the same clumps", (last_atoms(folder)[:, :3] == atoms[:, :3]).all())


@lmp.of_host
def test_refused(folder):
    prepare(folder)
    (folder / "light.mol").write_text((folder / "rod.mol").read_text().split("\nMasses")[0])
    fix = "fix in all insert/lsdcd region top number 10 "
    bodies = "fix bodies all rigid/small molecule mol clumps\n"
    for name, text, says in (
            ("a template that is none", bodies + fix + "mol none rigid bodies", "there is no template 'none'"),
            ("a rigid fix that is none", fix + "mol clumps rigid bodies", "in 'rigid', there is no fix 'bodies'"),
            ("a fix that is not rigid", "fix pull all gravity 1 vector 0 0 -1\n" + fix + "mol clumps rigid pull", "takes no new bodies"),
            ("another template", "molecule rods rod.mol\n" + bodies + fix + "mol rods rigid bodies", "has another template than 'rods'"),
            ("a fraction too few", bodies + fix + "mol clumps fraction 1 rigid bodies", "1 fraction, and template 'clumps' has 2 molecules"),
            ("a molecule without masses", "molecule light light.mol\n" + bodies + fix + "mol light rigid bodies", "has no section Masses"),
            ("a group of others", "group some type 1\nfix bodies some rigid/small molecule mol clumps\n" + fix + "mol clumps rigid bodies",
             "acts on a group in which new atoms are not")):
        lmp.refused(name, BEGIN + box(40) + MOLECULES + PAIRS + text + "\nrun 1\n", folder, says)


@pytest.mark.skipif(lmp.ON_HOST, reason="of a LAMMPS without the header of molecules")
def test_host_without_molecules(folder):
    prepare(folder)
    lmp.refused("clumps", BEGIN + box(40) + MOLECULES + PAIRS + "fix bodies all rigid/small molecule mol clumps\n"
                "fix in all insert/lsdcd region top mol clumps rigid bodies number 10\nrun 1\n", folder, "'mol' needs a plugin")
