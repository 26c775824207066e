# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Grains in a drum that turns, 10 000 steps by Python with the library and by LAMMPS with the fix: the same
trajectory. LSDCD_LMP names lmp-lsdcd, PYTHONPATH and LSDCD_LIBRARY the module and its library."""
import os
import subprocess
import sys
import tempfile

import numpy as np

import lsdcd

N, STEPS, DT, GRAVITY = 40, 10000, 4e-5, 9.81
LAW = "hertz/history 1e5 5e4 1e5 5e4 0.5 1"
MOTION = "motion rotate 0 0 0 0 1 0 0.5"
SKIPPED = 77

# The same numbers in both, though in another order: forces are sums of gravity and of one or two contacts, so that a
# step differs by a few roundings, 1e-16 of a force. Over 1e4 steps of contacts that do not part trajectories (a drum
# brings grains together) they add up to at most 1e4 roundings of places of 0.1.
BOUND = 1e4 * 1e-16 * 0.1 * 10    # 10: contacts that begin a rounding earlier


def drum(name):
    """A closed cylinder about y of radius 0.1 and length 0.1, from 64 flat sides."""
    a = 2 * np.pi * np.arange(64) / 64
    rim = np.stack([0.1 * np.cos(a), 0 * a, 0.1 * np.sin(a)], 1)
    facets = []
    for i in range(64):
        j, up = (i + 1) % 64, np.array([0, 0.1, 0])
        low, high = rim - up / 2, rim + up / 2
        facets += [(low[i], low[j], high[j]), (low[i], high[j], high[i]), (low[i], low[j], -up / 2),
                   (high[i], up / 2, high[j])]
    with open(name, "w", encoding="utf-8") as f:
        f.write("solid drum\n")
        for facet in facets:
            f.write("facet normal 0 0 0\nouter loop\n")
            for corner in facet:
                f.write("vertex " + " ".join(repr(float(c)) for c in corner) + "\n")
            f.write("endloop\nendfacet\n")
        f.write("endsolid drum\n")


def grains():
    r = np.random.default_rng(7)
    x = r.uniform(-0.05, 0.05, (N, 3))
    x[:, 1] *= 0.6
    radius = r.uniform(0.004, 0.006, N)
    return x, radius


def by_lammps(lmp, folder, x, radius):
    rows = "".join(f"create_atoms 1 single {' '.join(repr(float(c)) for c in at)} units box\n" for at in x)
    sizes = "".join(f"set atom {i + 1} diameter {2 * float(r)!r} density 2500\n" for i, r in enumerate(radius))
    script = f"""units si
atom_style sphere
comm_modify vel yes
atom_modify map yes sort 0 0
boundary f f f
region box block -0.2 0.2 -0.2 0.2 -0.2 0.2
create_box 1 box
{rows}{sizes}pair_style zero 0.012
pair_coeff * *
neighbor 0.002 bin
neigh_modify delay 0 every 1 check yes exclude type 1 1
timestep {DT}
fix move all nve/sphere
fix down all gravity {GRAVITY} vector 0 0 -1
fix wall all wall/lsdcd {LAW} mesh drum.stl {MOTION} device cpu
run {STEPS}
write_dump all custom end.dump id x y z vx vy vz omegax omegay omegaz modify sort id format float %.17g
"""
    with open(os.path.join(folder, "in.drum"), "w", encoding="utf-8") as f:
        f.write(script)
    done = subprocess.run([lmp, "-in", "in.drum", "-log", "none"], cwd=folder, stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(done.stdout[-2000:] + done.stderr[-2000:])
    return np.loadtxt(os.path.join(folder, "end.dump"), skiprows=9)[:, 1:]


def by_library(folder, x, radius):
    """fix nve/sphere: velocity Verlet, with the moment of inertia of a sphere."""
    mass = 4 * np.pi / 3 * radius**3 * 2500
    # LAMMPS's factor of pressure, nktv2p, is 1 in si.
    wall = lsdcd.Wall(f"{LAW} mesh {folder}/drum.stl {MOTION} device cpu", lo=(-0.2,) * 3, hi=(0.2,) * 3)
    v, omega = np.zeros((N, 3)), np.zeros((N, 3))
    force, torque = np.zeros((N, 3)), np.zeros((N, 3))
    to_v, to_omega = 0.5 * DT / mass[:, None], 0.5 * DT / 0.4 / (radius**2 * mass)[:, None]

    def forces(**words):
        force[:] = torque[:] = 0
        force[:, 2] -= GRAVITY * mass
        wall.step(x, v, omega, radius, mass, force, torque, DT, **words)

    contacts = 0
    forces(setup=True)
    for _ in range(STEPS):
        v[:] += to_v * force
        x[:] += DT * v
        omega[:] += to_omega * torque
        forces()
        v[:] += to_v * force
        omega[:] += to_omega * torque
        contacts += wall.totals().contacts
    return np.hstack([x, v, omega]), contacts


def main():
    lmp = os.environ.get("LSDCD_LMP")
    if not lmp or not os.path.exists(lmp):
        print("skipped: no lmp-lsdcd (LSDCD_LMP)")
        return SKIPPED
    with tempfile.TemporaryDirectory(prefix="lsdcd-") as folder:
        drum(f"{folder}/drum.stl")
        x, radius = grains()
        theirs = by_lammps(lmp, folder, x, radius)
        ours, contacts = by_library(folder, x.copy(), radius)
    apart = np.abs(ours[:, :3] - theirs[:, :3]).max()
    print(f"places are {apart:.3g} apart, bound {BOUND:.3g}; {contacts:.0f} contacts in {STEPS} steps")
    return 0 if apart <= BOUND and contacts > STEPS else 1    # one in each step at least, or nothing is shown


if __name__ == "__main__":
    sys.exit(main())
