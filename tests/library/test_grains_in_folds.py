# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Ellipsoids in folds, corners and on ridges of bumpy walls: what all paths of a wall do with several contacts of a grain, beside numpy (grain_oracle.py).

Overlaps are rounded by 1e-15 of sizes of 1, which the least eigenvalue, 0.1, makes ten times as large in a weight, and are over the largest of
a grain, which is 0.01 at least.
"""
import functools
import math
import pathlib
import tempfile

import numpy as np

import lsdcd
import vtp
from facts import at_most, fact
from grain_oracle import Ellipsoid, Shared, Surface, turned_by

EXACT = 1e-12
KN, KT, GAMMA_N, GAMMA_T, MU, DT = 1000.0, 700.0, 3.0, 5.0, 0.3, 1e-3
ELASTIC, RUBBING = f"hooke {KN} 0 0 0 0 0", f"hooke {KN} 0 {GAMMA_N} {GAMMA_T} {MU} 1"
MASS = 1.7
ABOUT = np.array([0.3, -0.2, 0.5])


def bumpy(random, n=6, half=3.0, height=0.4):
    along = np.linspace(-half, half, n + 1)
    vertices = [(x, y, height * random.normal()) for y in along for x in along]
    at = [j * (n + 1) + i for j in range(n) for i in range(n)]
    return vertices, [f for a in at for f in ((a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1))]


class Bed:
    """Grains that are pressed into walls, by their overlaps alone."""

    def __init__(self, seed, meshes, n):
        random = np.random.default_rng(seed)
        self.meshes = [make(random) for make in meshes]
        self.surfaces = [Surface(*mesh) for mesh in self.meshes]
        tried = 3 * n
        half = np.array([random.permutation([1.5, 0.5, 0.5] if random.random() < 0.4 else random.uniform(0.4, 1.2, 3)) for _ in range(tried)])
        quaternions = random.normal(size=(tried, 4))
        quaternions /= np.linalg.norm(quaternions, axis=1)[:, None]
        x = np.column_stack([random.uniform(-2, 2, (tried, 2)), np.full(tried, 3.0)])
        rho = half.min(axis=1)**2 / half.max(axis=1)
        self.come_down(x, half, quaternions, random.uniform(0.1, 0.8, tried) * rho)
        self.grains, self.shared = [], []
        for i in range(tried):
            grain = Ellipsoid(half[i], quaternions[i], x[i])
            shared = Shared(grain, self.surfaces)
            if len(shared.overlap) > 1 and shared.is_sure and shared.overlap.min() > 1e-4 and shared.overlap.max() > 0.01:
                self.grains.append(i)
                self.shared.append(shared)
            if len(self.grains) == n:
                break
        self.x, self.half, self.quaternions = x[self.grains], half[self.grains], quaternions[self.grains]
        self.inertia = MASS / 5 * ((self.half**2).sum(axis=1)[:, None] - self.half**2)
        self.v, self.omega = random.normal(size=(2, len(self.x), 3)) * 0.5

    def come_down(self, x, half, quaternions, wanted):
        grids = [lsdcd.Mesh(np.array(v, float), f).grid() for v, f in self.meshes]
        for k in range(80):
            deep = -np.min([grid.shape_distances(x, half, quaternions=quaternions).distance for grid in grids], axis=0)
            x[:, 2] += np.maximum(0.5 * (deep - wanted), -0.3 * wanted) if k > 40 else np.minimum(deep, 0) * 0.9

    def wall(self, law, of_mesh="", **values):
        """With `of_mesh` behind each mesh, and `values` in it."""
        meshes = {f"part{k}": lsdcd.Mesh(np.array(v, float), f) for k, (v, f) in enumerate(self.meshes)}
        words = " ".join(f"mesh ${name} {of_mesh}" for name in meshes)
        return lsdcd.Wall(f"{law} {words} shapes each_contact", values=meshes | values)

    def step(self, wall, x=None, v=None, quaternions=None, **more):
        n = len(self.x)
        force, torque = np.zeros((2, n, 3))
        wall.step(self.x if x is None else x, self.v if v is None else v, self.omega, np.zeros(n), np.full(n, MASS), force, torque,
                  DT, half_axes=self.half, inertia=self.inertia,
                  quaternions=self.quaternions if quaternions is None else quaternions, **more)
        return force, torque

    def velocities(self, i):
        """Of a grain's points along the wall, and their rates of overlap."""
        s = self.shared[i]
        v = self.v[i] + np.cross(self.omega[i], s.arm)
        rate = np.sum(v * s.normal, axis=1)
        return v - rate[:, None] * s.normal, rate


@functools.lru_cache
def one_mesh():
    """The bed of all tests of one mesh: numpy takes a tenth of a second a grain."""
    return Bed(1, [bumpy], 100)


def elastic(bed, i):
    s = bed.shared[i]
    return KN * s.overlap[:, None] * -s.normal, np.full(len(s.overlap), KN)


def rubbing(bed, i):
    """The hooke of LAMMPS: a dashpot along the wall, up to the friction limit."""
    s, (along, rate) = bed.shared[i], bed.velocities(i)
    push = KN * s.overlap + MASS * GAMMA_N * rate
    speed = np.linalg.norm(along, axis=1)
    rub = np.minimum(MASS * GAMMA_T, MU * np.abs(push) / speed)
    return push[:, None] * -s.normal - rub[:, None] * along, np.full(len(s.overlap), KN)


def hertzian(bed, i):
    """hertz/history in its first step, with the radius of the mean curvature."""
    s, (along, rate) = bed.shared[i], bed.velocities(i)
    radius = np.array([s.grain.radius(arm) for arm in s.arm])
    size = np.sqrt(np.minimum(radius, s.grain.half.max()**2 / s.overlap) * s.overlap)
    push = size * (KN * s.overlap + MASS * GAMMA_N * rate)
    pull = size[:, None] * (KT * DT + MASS * GAMMA_T) * along
    most = MU * np.abs(push) / np.linalg.norm(pull, axis=1)
    return push[:, None] * -s.normal - np.minimum(1, most)[:, None] * pull, KN * size


def expected(bed, law):
    """Of each grain: the forces at its contacts by weight, and the couples there."""
    forces, couples = [], []
    for i, s in enumerate(bed.shared):
        force, stiffness = law(bed, i)
        forces.append(s.weight[:, None] * force)
        couples.append(s.couples(stiffness))
    return forces, couples


def check_pushes(name, bed, law, force, torque):
    forces, couples = expected(bed, law)
    off = [max(np.abs(force[i] - f.sum(axis=0)).max(), np.abs(torque[i] - (np.cross(s.arm, f) + c).sum(axis=0)).max()) /
           np.linalg.norm(f, axis=1).max() for i, (s, f, c) in enumerate(zip(bed.shared, forces, couples))]
    at_most(f"{name}: forces and torques of {len(off)} grains", max(off), EXACT)
    return forces, couples


def check_totals(name, bed, wall, forces, couples):
    """What the meshes get: the forces at the grains' points, and the couples, of two meshes half each."""
    size = max(np.abs(f).max() for f in forces) * len(forces)
    for m in range(len(bed.surfaces)):
        total = wall.totals(m, about=ABOUT)
        force, torque = np.zeros((2, 3))
        for s, f, c in zip(bed.shared, forces, couples):
            mine = np.array(s.surface) == m
            force -= f[mine].sum(axis=0)
            torque -= (np.cross(s.grain.x + s.arm[mine] - ABOUT, f[mine]) + c[mine]).sum(axis=0)
        at_most(f"{name}: totals of mesh {m}", max(np.abs(total.force - force).max(), np.abs(total.torque - torque).max()) / size, EXACT)


def check_contacts(name, bed, wall, forces):
    found, off, rows = wall.contacts(), 0, 0
    for i, (s, f) in enumerate(zip(bed.shared, forces)):
        mine = np.flatnonzero(found.sphere == i)
        bearing = np.flatnonzero(s.weight > 0)
        rows += len(mine) != len(bearing)
        foot = s.grain.x + s.arm - s.overlap[:, None] * s.normal
        for k in mine:
            j = min(bearing, key=lambda j: np.linalg.norm(foot[j] - found.point[k]))
            off = max(off, np.abs(found.force[k] - f[j]).max() / np.abs(f).max(), abs(found.overlap[k] - s.overlap[j]) / s.overlap.max(),
                      1e-3 * np.abs(found.point[k] - foot[j]).max(), int(found.mesh[k] != s.surface[j]))
    fact(f"{name}: each bearing contact has a row", rows == 0, rows)
    at_most(f"{name}: force, point, overlap and mesh of each contact", off, EXACT)


def test_paths_of_a_wall():
    bed = one_mesh()
    several = [len(s.overlap) for s in bed.shared]
    couples = [np.abs(s.couples(np.ones(len(s.overlap)))).max() / s.overlap.max()**2 for s in bed.shared]
    fact("grains have 2 contacts and more, some fade, and some have couples", several.count(2) > 20 and sum(k > 2 for k in several) > 4 and
         sum(s.fade.max() > 0.01 for s in bed.shared) > 4 and sum(c > 0.01 for c in couples) > 10, (several, couples))
    for name, law, own in (("hooke", ELASTIC, elastic), ("hooke with damping and friction", RUBBING, rubbing),
                           ("hertz/history", f"hertz/history {KN} {KT} {GAMMA_N} {GAMMA_T} {MU} 1", hertzian)):
        wall = bed.wall(law)
        forces, couples = check_pushes(name, bed, own, *bed.step(wall))
        check_totals(name, bed, wall, forces, couples)
        check_contacts(name, bed, wall, forces)

    # Energy: each contact bears l = w d, and the sum of d l / 2 is that of the formula where none fades more than it bears.
    wall = bed.wall(ELASTIC)
    bed.step(wall)
    energy = KN * sum(s.overlap @ s.pressed - s.pressed @ s.matrix @ s.pressed / 2 for s in bed.shared)
    at_most("hooke: energy", abs(wall.totals().elastic_energy / energy - 1), EXACT)


def test_library_has_all_contacts():
    """Those that bear nothing, too."""
    bed = one_mesh()
    mesh = lsdcd.Mesh(np.array(bed.meshes[0][0], float), bed.meshes[0][1])
    found = mesh.grid().shape_contacts(bed.x, bed.half, quaternions=bed.quaternions)
    off, rows = 0, 0
    for i, s in enumerate(bed.shared):
        mine = slice(found.first[i], found.first[i + 1])
        rows += found.first[i + 1] - found.first[i] != len(s.overlap)
        point = s.grain.x + s.arm
        for overlap, normal, of_grain in zip(found.overlap[mine], found.normal[mine], found.of_grain[mine]):
            j = np.abs(point - of_grain).max(axis=1).argmin()
            off = max(off, abs(overlap - s.overlap[j]), 1e-3 * np.abs(normal + s.normal[j]).max(), 1e-3 * np.abs(of_grain - point[j]).max())
    fact("shape_contacts(): as many as by a look at every feature", rows == 0, rows)
    at_most("shape_contacts(): overlaps, and to 1e-9 normals and points", off, EXACT)


def test_several_meshes():
    """Two rough floors that go through each other: contacts with both share without a pass, and each mesh has half of their couple."""
    bed = Bed(3, [lambda random: bumpy(random, height=0.15)] * 2, 60)
    both = sum(len(set(s.surface)) == 2 for s in bed.shared)
    fact("many grains touch both meshes", both > 10, both)
    for name, law, own in (("two meshes", ELASTIC, elastic), ("two meshes with friction", RUBBING, rubbing)):
        wall = bed.wall(law)
        forces, couples = check_pushes(name, bed, own, *bed.step(wall))
        check_totals(name, bed, wall, forces, couples)
        check_contacts(name, bed, wall, forces)


def test_meshes_that_move():
    """A pose of the program, a body and a servo: all get the torque that the grains lose."""
    bed = one_mesh()
    forces, couples = expected(bed, elastic)
    size = max(np.abs(f).max() for f in forces) * len(forces)
    force = -sum(f.sum(axis=0) for f in forces)
    torque = -sum((np.cross(s.grain.x + s.arm, f) + c).sum(axis=0) for s, f, c in zip(bed.shared, forces, couples))
    couple = sum(c.sum(axis=0) for c in couples)
    fact("the couples are more than roundings of a total", np.abs(couple).max() > 1e4 * EXACT * size, couple)

    wall = bed.wall(ELASTIC, "motion caller")
    q, shift = np.array([0.8, 0.36, -0.48, 0.0]), np.array([0.4, -1.3, 0.7])
    turn = turned_by(q)
    wall.set_pose(0, position=shift, quaternion=q)
    w, *u = q
    turns = np.array([[w * p[0] - np.dot(u, p[1:]), *(w * p[1:] + p[0] * np.array(u) + np.cross(u, p[1:]))] for p in bed.quaternions])
    pushed, twisted = bed.step(wall, bed.x @ turn.T + shift, quaternions=turns)
    check_pushes("a pose", bed, elastic, pushed @ turn, twisted @ turn)

    wall = bed.wall(ELASTIC, "body mass 2 com 0 0 0 inertia 3 3 3 0 0 0")
    bed.step(wall, setup=True)
    state = wall.body(0)
    bed.step(wall)
    # A step from rest: half a step by the load before and half by that at its end, both known by totals alone but for the way in between.
    total = wall.totals(0)
    moved = wall.body(0)
    at_most("a body at rest: no velocity", np.abs(state.velocity).max(), 0)
    at_most("a body: the loads of a setup are those of the grains", max(np.abs(moved.velocity - DT / 2 / 2 * (force + total.force)).max() / (DT * size),
            np.abs(moved.angular_velocity - DT / 2 / 3 * (torque + total.torque - np.cross(moved.centre, total.force))).max() / (DT * size)), EXACT)

    axis, point = np.array([0.6, 0, 0.8]), np.array([0.1, 0.2, -0.3])
    wall = bed.wall(ELASTIC, "servo torque axis $axis through $point 1 vmax 1e-9", axis=axis, point=point)
    bed.step(wall, setup=True)
    at_most("a servo that turns: its push", abs(wall.totals(0).servo_push + axis @ (torque - np.cross(point, force))) / size, EXACT)


def test_fields_of_triangles():
    """Forces of triangles are those of contacts: they add up to the force of the wall, and have no couple."""
    bed = one_mesh()
    with tempfile.TemporaryDirectory() as folder:
        wall = bed.wall(ELASTIC, "mesh_fields $file every 1", file=pathlib.Path(folder) / "wall.vtp")
        bed.step(wall, setup=True)
        bed.step(wall)
        written = next(pathlib.Path(folder).glob("*.vtp"))
        rows = vtp.read(written)
    forces, _ = expected(bed, elastic)
    on_triangles = np.sum(np.reshape(rows["force"], (-1, 3)), axis=0)
    on_grains = sum(f.sum(axis=0) for f in forces)
    at_most("forces of triangles add up", np.abs(on_triangles + on_grains).max() / (len(forces) * max(np.abs(f).max() for f in forces)), EXACT)


def test_rows_of_deep_contacts():
    """The overlap in a row is that of the force, also where a rod is deeper in a plane than its least radius of curvature, 0.2."""
    square = np.array([[-40, -40, 0], [40, -40, 0], [40, 40, 0], [-40, 40, 0]], float)
    wall = lsdcd.Wall(f"{ELASTIC} mesh $square shapes each_contact", square=lsdcd.Mesh(square, [[0, 1, 2], [0, 2, 3]]))
    tilt, overlap = 0.8, np.array([0.1, 0.3, 0.6, 0.9, 1.15])    # the foot of the last one is outside of the rod
    n, height = len(overlap), math.hypot(5 * math.cos(tilt), math.sin(tilt))
    x = np.column_stack([np.zeros((n, 2)), height - overlap])
    still, force, torque = np.zeros((3, n, 3))
    wall.step(x, still, still, np.zeros(n), np.ones(n), force, torque, DT, half_axes=np.tile([1.0, 1, 5], (n, 1)), inertia=np.ones((n, 3)),
              quaternions=np.tile([math.cos(tilt / 2), 0, math.sin(tilt / 2), 0], (n, 1)))
    rows = wall.contacts()
    at_most("overlaps of rows, by the forces", np.abs(rows.overlap - force[:, 2] / KN).max(), 1e-13)
    at_most("and by how deep the lowest point is, while the foot is in the rod", np.abs(rows.overlap - overlap)[:4].max(), 1e-13)
