# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Spheres of Yade at a wall of the library, beside Yade's own facets: a sphere that rolls over the seams of a flat
floor, and grains in a drum that turns.

usage: yade -n -x -j1 yade_drum.py [FOLDER [floor | GRAINS STEPS [ours]]]

Writes its meshes and FOLDER/yade_floor.png, and prints both walls side by side. Units are SI.
"""
import os
import sys
import time

import numpy as np
from yade import *
from yade import utils, ymport

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import drum
import lsdcd

DENSITY, GRAVITY, FRICTION = 2500.0, 9.81, 0.5
WALLS = ("Yade's facets", False), ("lsdcd.Wall", True)


def numbers(vectors):
    """Yade's vectors as (n, 3)."""
    return np.fromiter((c for p in vectors for c in (p[0], p[1], p[2])), float).reshape(-1, 3)


class MeshWall:
    """An engine of Yade: step() hands the spheres near the mesh to an lsdcd.Wall, and adds forces and torques.

    Its springs are Yade's, and `keywords` those of the mesh. Which spheres are near is looked up before any other can have come.
    `speed`: of the mesh, at most."""

    def __init__(self, stiffness, name, keywords="", speed=0.0):
        mesh = lsdcd.Mesh(name)
        self.wall = lsdcd.Wall(f"hooke/history $kn $kt 0 0 $xmu 0  mesh $mesh {keywords}", threads=1,
                               mesh=mesh, kn=stiffness, kt=0.5 * stiffness, xmu=FRICTION)
        spheres = [b for b in O.bodies if isinstance(b.shape, Sphere)]
        self.ids = np.array([b.id for b in spheres])
        self.states = [b.state for b in spheres]
        self.radius = np.array([b.shape.radius for b in spheres])
        self.mass = np.array([b.state.mass for b in spheres])
        self.room, self.speed = 0.5 * self.radius.min(), speed
        self.grid = mesh.grid(cutoff=self.radius.max() + self.room)
        self.near, self.steps_left, self.began = np.zeros(0, int), 0, False
        self.spent = 0.0    # seconds in the library

    def look(self):
        x = numbers(s.pos for s in self.states)
        pose = self.wall.pose()
        distance = self.grid.query((x - pose[:, 3]) @ pose[:, :3], "distance").distance    # in the mesh's frame
        near = np.nonzero(distance < self.radius + self.room)[0]
        late = np.setdiff1d(np.nonzero(distance < self.radius)[0], self.near)
        if self.began and len(late):
            raise RuntimeError(f"{len(late)} spheres came to the wall unseen: look more often")
        place = np.full(len(x), -1)
        place[self.near] = np.arange(len(self.near))
        if self.began:
            self.wall.renumber(place[near])
        self.near = near
        # A sphere at rest may fall from now on, and any may become twice as fast.
        fastest = 2 * np.sqrt((numbers(s.vel for s in self.states)**2).sum(1).max()) + self.speed
        fall = np.sqrt(2 * self.room / GRAVITY)
        self.steps_left = max(1, int(0.5 * min(fall, self.room / max(fastest, 1e-300)) / O.dt))

    def step(self):
        if self.steps_left == 0:
            self.look()
        self.steps_left -= 1
        states = [self.states[k] for k in self.near]
        x, v, omega = (numbers(getattr(s, name) for s in states) for name in ("pos", "vel", "angVel"))
        force, torque = np.zeros_like(x), np.zeros_like(x)
        began = time.thread_time()
        self.wall.step(x, v, omega, self.radius[self.near], self.mass[self.near], force, torque, O.dt,
                       setup=not self.began)
        self.spent += time.thread_time() - began
        self.began = True
        for k in np.nonzero(force.any(1))[0]:
            sphere = int(self.ids[self.near[k]])
            O.forces.addF(sphere, Vector3(*force[k].tolist()))
            O.forces.addT(sphere, Vector3(*torque[k].tolist()))


def begin(dt, damping=0.0, more=()):
    """Yade's linear springs with Coulomb friction between spheres, and with facets where there are any."""
    O.reset()
    O.dt = dt
    O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()]),
                 InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()],
                                 [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
                 *more, NewtonIntegrator(damping=damping, gravity=(0, 0, -GRAVITY))]


def add(wall):
    """Behind the forces between spheres, before Yade moves them; in the first step, too."""
    global WALL    # which commands of Yade's engines can see
    WALL = wall
    O.engines = O.engines[:-1] + [PyRunner(command="WALL.step()", iterPeriod=1, initRun=True)] + O.engines[-1:]


def material(stiffness, radius):
    """Its stiffness with one of its kind of the same radius, and with a facet, is E radius; along the contact half."""
    return O.materials.append(FrictMat(young=stiffness / radius, poisson=0.5, frictionAngle=float(np.arctan(FRICTION)),
                                       density=DENSITY))


# ---- a floor with a seam every 10 mm -----------------------------------------------------------------------------


def write_floor(name, cells=(20, 6), edge=0.01):
    with open(name, "w", encoding="ascii") as f:
        f.write("solid floor\n")
        for i in range(cells[0]):
            for j in range(cells[1]):
                a, b, c, d = ((edge * (i + u), edge * (j + w - cells[1] / 2), 0)
                              for u, w in ((0, 0), (1, 0), (1, 1), (0, 1)))
                for facet in ((a, b, c), (a, c, d)):
                    f.write("facet normal 0 0 1\nouter loop\n")
                    f.writelines("vertex %.17g %.17g %.17g\n" % corner for corner in facet)
                    f.write("endloop\nendfacet\n")
        f.write("endsolid floor\n")


def roll(mesh, ours, radius=0.005, speed=0.2, stiffness=1000.0, dt=4e-5, steps=16000):
    """Rows x, z, energy (without that of springs) of a sphere that begins to roll where its weight is its overlap."""
    begin(dt)
    kind = material(stiffness, radius)
    mass = DENSITY * 4 / 3 * np.pi * radius**3
    height = radius - mass * GRAVITY / stiffness
    ball = O.bodies.append(utils.sphere((0.0213, 0.0031, height), radius, material=kind))
    state, rows = O.bodies[ball].state, []
    state.vel, state.angVel = (speed, 0, 0), (0, speed / radius, 0)
    if ours:
        add(MeshWall(stiffness, mesh))
    else:
        O.bodies.append(ymport.stl(mesh, material=kind))

    def note():
        kinetic = 0.5 * mass * (state.vel.squaredNorm() + 0.4 * radius**2 * state.angVel.squaredNorm())
        rows.append((state.pos[0], state.pos[2], kinetic + mass * GRAVITY * (state.pos[2] - height)))

    global NOTE
    NOTE = note
    O.engines = O.engines + [PyRunner(command="NOTE()", iterPeriod=20)]
    O.run(steps, True)
    return np.array(rows)


def floor(folder):
    mesh = os.path.join(folder, "yade_floor.stl")
    write_floor(mesh)
    paths = {name: roll(mesh, ours) for name, ours in WALLS}
    for name, p in paths.items():
        change = 100 * (p[:, 2] / p[0, 2] - 1)
        print(f"floor, {name}: rolls {1e3 * np.ptp(p[:, 0]):.0f} mm, hops {1e6 * np.ptp(p[:, 1]):.2g} um, energy "
              f"{change.min():+.2g} to {change.max():+.2g} %", flush=True)
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(2, 1, figsize=(6, 4.5), sharex=True)
    for name, p in paths.items():
        axes[0].plot(1e3 * p[:, 0], 1e6 * (p[:, 1] - p[0, 1]), lw=1, label=name)
        axes[1].plot(1e3 * p[:, 0], 100 * (p[:, 2] / p[0, 2] - 1), lw=1)
    axes[0].set_ylabel("height, um")
    axes[1].set_ylabel("energy, %")
    axes[1].set_xlabel("x, mm; a seam every 10 mm and on each diagonal")
    figure.legend(loc="upper center", ncols=2)
    figure.savefig(os.path.join(folder, "yade_floor.png"), dpi=110, bbox_inches="tight")
    # On a plane nothing changes. A place of 0.2 is rounded to 3e-17, and 16 000 steps add up to less than 1e-12.
    p = paths["lsdcd.Wall"]
    return np.ptp(p[:, 1]) < 1e-12 and abs(p[:, 2] / p[0, 2] - 1).max() < 1e-9


# ---- a drum that turns ---------------------------------------------------------------------------------------------


def turn(mesh, ours, number, steps, period=2.0):
    """Milliseconds of a core for a step, the least of five measurements, and how many grains are outside at the end."""
    stiffness, radius = drum.STIFFNESS, drum.GRAIN
    turning = [] if ours else [RotationEngine(ids=[], rotationAxis=(0, 1, 0), rotateAroundZero=True,
                                              zeroPoint=(0, 0, 0), angularVelocity=2 * np.pi / period)]
    begin(drum.DT, 0.2, turning)
    kind = material(stiffness, radius)
    on_axis = 2.2 * radius * np.arange(-30, 31)
    places = np.array([(x, y, z) for z in on_axis for x in on_axis for y in on_axis])
    inside = np.hypot(places[:, 0], places[:, 2]) < drum.RADIUS - radius
    inside &= abs(places[:, 1]) < drum.LENGTH / 2 - radius
    places = places[inside][:number] + np.random.default_rng(1).uniform(-0.04, 0.04, (number, 3)) * radius
    for x in places:
        O.bodies.append(utils.sphere(x.tolist(), radius, material=kind))
    if ours:
        add(MeshWall(stiffness, mesh, f"motion rotate 0 0 0 0 1 0 {period}", 2 * np.pi / period * drum.RADIUS))
    else:
        turning[0].ids = O.bodies.append(ymport.stl(mesh, material=kind))
    part, taken = steps // 20, []
    O.run(steps - 5 * part, True)    # most grains have fallen
    for _ in range(5):
        began = time.process_time()
        O.run(part, True)
        taken.append(1e3 * (time.process_time() - began) / part)
    x = numbers(b.state.pos for b in O.bodies if isinstance(b.shape, Sphere))
    outside = (np.hypot(x[:, 0], x[:, 2]) > drum.RADIUS) | (abs(x[:, 1]) > drum.LENGTH / 2)
    return min(taken), int(outside.sum())


def drums(folder, number, steps, walls):
    mesh, ended = os.path.join(folder, "yade_drum.stl"), True
    drum.LENGTH = 0.1
    for drum.SIDES in (48, 480):
        drum.write_drum(mesh)
        for name, ours in walls:
            milliseconds, outside = turn(mesh, ours, number, steps)
            print(f"drum of {4 * drum.SIDES} triangles, {number} grains, {name}: {milliseconds:.2f} ms a step, "
                  f"{outside} outside", flush=True)
            if ours:
                print(f"    {1e3 * WALL.spent / steps:.2f} ms are the library's; {len(WALL.near)} grains are near it",
                      flush=True)
            ended = ended and (outside == 0 or not ours)
    return ended


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else "."
    what = sys.argv[2:]
    good = True
    if not what or what == ["floor"]:
        good = floor(folder)
    if what != ["floor"]:
        number, steps = map(int, what[:2] or (3000, 2400))
        good = drums(folder, number, steps, WALLS[1:] if what[2:] == ["ours"] else WALLS) and good
    return 0 if good else 1


sys.exit(main())
