# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What each contact of a wall dissipates (each_contact with energy), against closed forms and the totals of meshes.

Energies of contacts and of totals are sums of the same products in another order, totals in fixed point: they differ by 1e-13 of what the largest have.
"""
import math

import numpy as np

import lsdcd
from facts import at_most, fact

ROUNDING = 1e-13
DAMPING, SLIDER, ROLLING, TWISTING, ADHESION = range(5)


def sheet(n=1, half=3.0, height=lambda x, y: 0.0):
    """A square of 2 n^2 triangles around the origin."""
    along = np.linspace(-half, half, n + 1)
    vertices = [(x, y, height(x, y)) for y in along for x in along]
    at = [j * (n + 1) + i for j in range(n) for i in range(n)]
    return np.array(vertices, float), [f for a in at for f in ((a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1))]


def square(*corners):
    return lsdcd.Mesh(np.array(corners, float), [[0, 1, 2], [0, 2, 3]])


# A flat floor; a bumpy one, four sides as one mesh, a paddle that turns, and a plate on a spring.
CORNERS = [(-2.5, -2.5), (2.5, -2.5), (2.5, 2.5), (-2.5, 2.5)]
MESHES = {"floor": lsdcd.Mesh(*sheet()),
          "bumps": lsdcd.Mesh(*sheet(12, 3.0, lambda x, y: 0.15 * math.sin(2 * x) * math.cos(3 * y))),
          "sides": lsdcd.Mesh(np.array([(*c, z) for z in (-1, 4) for c in CORNERS], float),
                              [f for k in range(4) for f in ((k, (k + 1) % 4, k + 4), ((k + 1) % 4, (k + 1) % 4 + 4, k + 4))]),
          "paddle": square((-1.5, 0, -0.2), (1.5, 0, -0.2), (1.5, 0, 1), (-1.5, 0, 1)),
          "plate": square((-2, -2, 0.3), (-1, -2, 0.3), (-1, -1, 0.3), (-2, -1, 0.3))}
PARTS = "mesh $bumps mesh $sides mesh $paddle motion rotate 0 0 0 0 0 1 1.5"
BOXED = f"{PARTS} mesh $plate body mass 5 com 0 0 0 inertia 1 1 2 0 0 0 joint slider 0 0 1 spring 500 5"

ROUGH = """granular hertz 2e4 10 tangential mindlin 1e4 1 0.4 damping mass_velocity
           rolling sds 2e3 1 0.1 twisting sds 500 0.2 0.05"""
STICKY = """granular jkr 2e4 0.3 0.3 4 tangential mindlin_rescale/force NULL 0.6 0.4 damping viscoelastic
            rolling sds 2e3 5 0.1 twisting marshall"""
CLASSIC = "hooke/history 1e4 4e3 30 NULL 0.5 1"
LISTED = "each_contact energy"


class Grains:
    """Spheres that feel walls and gravity alone, by velocity Verlet."""

    def __init__(self, x, v=0.0, omega=0.0, radius=0.5, mass=1.0, gravity=(0, 0, 0), dt=1e-3, **shapes):
        self.x = np.array(x, float)
        n = len(self.x)
        self.v, self.omega = (np.array(np.broadcast_to(a, (n, 3)), float) for a in (v, omega))
        self.radius, self.mass = (np.array(np.broadcast_to(a, n), float) for a in (radius, mass))
        self.force, self.torque = np.zeros((2, n, 3))
        self.gravity, self.dt, self.shapes = np.array(gravity, float), dt, shapes

    def kick(self):
        self.v += self.dt / 2 * (self.force / self.mass[:, None] + self.gravity)
        self.omega += self.dt / 2 * self.torque / (0.4 * self.mass * self.radius**2)[:, None]

    def push(self, wall, **more):
        self.force[:] = self.torque[:] = 0
        wall.step(self.x, self.v, self.omega, self.radius, self.mass, self.force, self.torque, self.dt, **self.shapes, **more)

    def step(self, wall):
        self.kick()
        self.x += self.dt * self.v
        self.push(wall)
        self.kick()

    def keep(self, which):
        for name in ("x", "v", "omega", "radius", "mass", "force", "torque"):
            setattr(self, name, getattr(self, name)[which].copy())


def wall_of(*words, **meshes):
    """Of the words, with what they name of `meshes` and MESHES."""
    text = " ".join(words)
    return lsdcd.Wall(text, values={name: mesh for name, mesh in (MESHES | meshes).items() if f"${name}" in text.split()}, threads=1)


class Ledger:
    """What contacts with each mesh have dissipated, as rows of contacts() say: by steps, and by whole lives."""

    def __init__(self, n_meshes):
        self.meshes = range(n_meshes)
        self.by_steps, self.ended = np.zeros((2, n_meshes, 5))
        self.n_ended, self.off, self.bears = 0, 0.0, 0

    def add(self, wall, dt):
        rows = wall.contacts()
        gone = rows.has_ended == 1
        size = np.abs(rows.dissipated_power).sum(axis=0) + 1e-12    # of power
        for m in self.meshes:
            power = rows.dissipated_power[rows.mesh == m].sum(axis=0)
            self.off = max(self.off, (np.abs(power - wall.totals(m).dissipated_power) / size).max())
            self.by_steps[m] += dt * power
            self.ended[m] += rows.dissipated[(rows.mesh == m) & gone].sum(axis=0)
        self.n_ended += gone.sum()
        self.bears += np.count_nonzero(rows.force[gone]) + np.count_nonzero(rows.overlap[gone])
        return rows

    def check(self, name, wall, least_ended=1):
        rows, booked = wall.contacts(), np.array([wall.totals(m).dissipated for m in self.meshes])
        there = np.array([rows.dissipated[(rows.mesh == m) & (rows.has_ended == 0)].sum(axis=0) for m in self.meshes])
        size = np.abs(booked).sum()
        fact(f"{name}: energy is dissipated, and contacts end", size > 0 and self.n_ended >= least_ended, (size, self.n_ended))
        fact(f"{name}: those bear nothing", self.bears == 0, self.bears)
        at_most(f"{name}: power of contacts and of meshes", self.off, ROUNDING)
        at_most(f"{name}: energy of their steps", np.abs(self.by_steps - booked).max() / size, ROUNDING)
        at_most(f"{name}: energy of their lives", np.abs(self.ended + there - booked).max() / size, ROUNDING)


def bed(seed, n=60, **more):
    random = np.random.default_rng(seed)
    x = np.column_stack([random.uniform(-2.2, 2.2, (n, 2)), random.uniform(0.7, 1.3, n)])
    radius = random.uniform(0.25, 0.5, n)
    return Grains(x, random.normal(size=(n, 3)), random.normal(size=(n, 3)) * 4, radius, 2 * radius**3, (2, 1, -10), **more)


def test_sums():
    """Grains with several contacts at several meshes, over edges, on a body: what contacts dissipate in each step, and in their lives, adds up to the
    totals of each mesh, by cause."""
    for name, law in (("rough", ROUGH), ("sticky", STICKY), ("classic", CLASSIC)):
        wall, grains, ledger = wall_of(law, BOXED, LISTED), bed(7), Ledger(4)
        grains.push(wall, setup=True)
        most = 0
        for _ in range(1500):
            grains.step(wall)
            rows = ledger.add(wall, grains.dt)
            most = max(most, np.bincount(rows.sphere[rows.has_ended == 0]).max(initial=0))
        fact(f"{name}: some grain has several contacts", most >= 2, most)
        ledger.check(name, wall, 100)
        booked = np.array([wall.totals(m).dissipated for m in range(4)])
        fact(f"{name}: all meshes and causes have a part", (np.abs(booked).sum(axis=1) > 0).all() and
             (np.abs(booked).sum(axis=0) > 0).sum() == {"rough": 4, "sticky": 5, "classic": 2}[name], booked)


def test_sums_of_others():
    """The same of ellipsoids, of a sheet whose nodes move, and where runs begin anew."""
    random = np.random.default_rng(3)
    grains, n = bed(5, 25, dt=2e-4), 25
    half, quaternions = random.uniform(0.2, 0.5, (n, 3)), random.normal(size=(n, 4))
    quaternions /= np.linalg.norm(quaternions, axis=1)[:, None]
    grains.shapes = {"half_axes": half, "quaternions": quaternions,
                     "inertia": grains.mass[:, None] / 5 * ((half**2).sum(axis=1)[:, None] - half**2)}
    wall, ledger = wall_of(CLASSIC, PARTS, LISTED, "shapes"), Ledger(3)
    for _ in range(2000):
        grains.omega[:] = 0    # they bounce and slide as they lie
        grains.step(wall)
        ledger.add(wall, grains.dt)
    ledger.check("ellipsoids", wall, 20)

    nodes, faces = sheet(6)
    wall = wall_of(ROUGH, "mesh $sheet nodes caller mesh $sides", LISTED, sheet=lsdcd.Mesh(nodes, faces))
    grains, ledger = bed(9), Ledger(2)
    for k in range(800):
        if k % 100 == 50:
            grains.push(wall, setup=True)
        t = k * grains.dt
        up, speed = 0.1 * np.sin(2 * nodes[:, 0] + 20 * t), 2 * np.cos(2 * nodes[:, 0] + 20 * (t - grains.dt / 2))
        wall.set_nodes(0, nodes + np.outer(up, [0, 0, 1]), np.outer(speed, [0, 0, 1]))
        grains.step(wall)
        ledger.add(wall, grains.dt)
    ledger.check("nodes", wall, 50)


def test_bounce():
    """A sphere that comes at speed 1 with a restitution of 0.5 has dissipated 0.75 m v^2/2 when it leaves, all by damping: its row says so in the step in
    which it has ended, and there is none after it. Of 200 steps the dashpot begins with a force, within one: a part of 1/200 at most."""
    kn, e, n = 1e4, 0.5, 200
    gamma = -2 * math.log(e) / math.sqrt(math.pi**2 + math.log(e)**2) * math.sqrt(kn)
    wall = wall_of(f"hooke {kn} 0 {gamma} 0 0 0 mesh $floor", LISTED)
    dt = math.pi / math.sqrt(kn - gamma**2 / 4) / n
    grains = Grains([[0.3, 0.2, 0.5 + 5.5 * dt]], [0, 0, -1], dt=dt)
    ends = []
    for _ in range(n + 30):
        grains.step(wall)
        rows = wall.contacts()
        ends += [(rows, wall.totals())] * int(rows.has_ended.sum())
    fact("it ends once", len(ends) == 1 and len(rows.sphere) == 0 and grains.v[0, 2] > 0.4, (len(ends), grains.v))
    rows, totals = ends[0]
    at_most("it has dissipated 0.75 m v^2/2", abs(rows.dissipated[0, DAMPING] - 0.375) / 0.375, 1 / n)
    at_most("as the mesh has", np.abs(rows.dissipated[0] - totals.dissipated).max(), 1e-15)
    at_most("the point is where it was", np.abs(rows.point[0] - [0.3, 0.2, 0]).max(), 1e-12)
    fact("by damping alone, without force", not rows.dissipated[0, 1:].any() and not rows.force.any() and rows.overlap[0] == 0, rows)


def test_groove():
    """A block (a sphere that cannot turn) that is pressed into a groove of two unlike planes and drawn along it at speed v: each contact dissipates mu F v
    with its own F, by the slider, and mu F s since it began to slide."""
    mu, speed, dt = 0.3, 0.7, 1e-3
    flat = square((-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0))
    steep = square((-9, 0, -9), (9, 0, -9), (9, 0, 9), (-9, 0, 9))
    wall = wall_of(f"hooke/history 1e4 5e3 20 NULL {mu} 1 mesh $flat mesh $steep corner sum", LISTED, flat=flat, steep=steep)
    x, v, one = np.array([[-1.0, 0.48, 0.47]]), np.array([[speed, 0, 0]]), np.ones(1)
    zero, before = np.zeros((1, 3)), None
    for k in range(1000):
        x += dt * v
        wall.step(x, v, zero, 0.5 * one, one, zero.copy(), zero.copy(), dt)
        rows = wall.contacts()
        if k == 499:
            before = rows
    press = 1e4 * np.array([0.03, 0.02])
    fact("two contacts, one with each", rows.mesh.tolist() == [0, 1] and not rows.has_ended.any(), rows)
    at_most("power of each is mu F v", np.abs(rows.dissipated_power[:, SLIDER] / (mu * press * speed) - 1).max(), 1e-12)
    at_most("and nothing else", np.abs(np.delete(rows.dissipated_power, SLIDER, axis=1)).max(), 1e-12)
    at_most("energy of each is mu F s", np.abs((rows.dissipated - before.dissipated)[:, SLIDER] / (mu * press * speed * 500 * dt) - 1).max(), 1e-12)


def test_seams():
    """A contact goes on over the seams of a mesh, and ends where another mesh begins."""
    right = square((2, -2, 0), (6, -2, 0), (6, 2, 0), (2, 2, 0))
    wall = wall_of(CLASSIC, "mesh $left mesh $right", LISTED, left=lsdcd.Mesh(*sheet(8, 2.0)), right=right)
    grains, ledger, ends = Grains([[-1.5, 0.1, 0.49]], [2, 0.3, 0], gravity=(0, 0, -100)), Ledger(2), []
    for _ in range(2700):
        grains.step(wall)
        rows = ledger.add(wall, grains.dt)
        ends += rows.mesh[rows.has_ended == 1].tolist()
    fact("it ends once, with the first mesh", ends == [0] and rows.mesh.tolist() == [1], (ends, grains.x))
    ledger.check("from mesh to mesh", wall)


class Scene:
    """The bed of test_kept, from its beginning or from where another one is."""

    def __init__(self, wall, of=None):
        self.wall, self.grains = wall, bed(11)
        for name in ("x", "v", "omega", "force", "torque") if of else ():
            getattr(self.grains, name)[:] = getattr(of.grains, name)

    def run(self, steps):
        """What contacts() says behind it."""
        for _ in range(steps):
            self.grains.step(self.wall)
        return self.wall.contacts()


def test_kept():
    """What contacts have dissipated follows spheres that get other places, and goes on from saved numbers; a wall that lists none takes up springs of one
    that does, and the other way round."""
    first = Scene(wall_of(ROUGH, BOXED, LISTED))
    first.run(800)
    saved = first.wall.save()

    def from_there(books=LISTED):
        scene = Scene(wall_of(ROUGH, BOXED, books), first)
        scene.wall.restore(saved)
        return scene
    again, unlisted, moved = from_there(), from_there("energy"), from_there()
    wanted = first.run(200)
    found = again.run(200)
    fact("saved numbers go on bit for bit", all(np.array_equal(getattr(found, name), getattr(wanted, name)) for name in vars(found)))

    for _ in range(100):
        unlisted.grains.step(unlisted.wall)
    listed = Scene(wall_of(ROUGH, BOXED, LISTED), unlisted)
    listed.wall.restore(unlisted.wall.save())
    found = listed.run(100)
    fact("with the same springs behind a wall without a list", np.array_equal(found.force, wanted.force))
    fact("from where contacts count from 0", (found.dissipated.sum(axis=1) <= wanted.dissipated.sum(axis=1) * (1 + 1e-12)).all() and
         found.dissipated.sum() < wanted.dissipated.sum(), (found.dissipated.sum(), wanted.dissipated.sum()))

    moved.run(100)
    order = np.random.default_rng(1).permutation(len(moved.grains.x))
    moved.grains.keep(order)
    moved.wall.renumber(order)
    found = moved.run(100)

    def by_sphere(rows, sphere):
        return rows.dissipated[np.lexsort((*rows.point.T, rows.mesh, sphere))]
    fact("it follows spheres", np.array_equal(by_sphere(found, order[found.sphere]), by_sphere(wanted, wanted.sphere)))


def test_without_books():
    """Without `energy` all is 0, and no contact is listed that has ended."""
    wall = wall_of(CLASSIC, "mesh $floor each_contact")
    grains = Grains([[0.3, 0.2, 0.4995]], [1.0, 0, -1])
    ended = 0
    for _ in range(100):
        grains.step(wall)
        rows = wall.contacts()
        ended += rows.has_ended.sum() + np.count_nonzero(rows.dissipated) + np.count_nonzero(rows.dissipated_power)
    fact("it has left, and nothing is said of energy", ended == 0 and len(rows.sphere) == 0 and grains.v[0, 2] > 0, rows)
