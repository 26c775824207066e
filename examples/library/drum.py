# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""A DEM in Python: grains in a drum that turns, whose wall is the library's.

usage: drum.py [FOLDER [SECONDS]]

Writes FOLDER/drum.png and prints the angle of the bed. Units are SI. Grains push each other by a damped spring along
their normal, and rub with Coulomb friction; the wall has LAMMPS's Hertz law with history.
"""
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import lsdcd

RADIUS, LENGTH, SIDES = 0.05, 0.02, 48    # of the drum, about y
N, GRAIN, DENSITY = 260, 0.0022, 2500.0
STIFFNESS, DAMPING, FRICTION = 400.0, 0.15, 0.5    # N/m; N s/m; -
DT, GRAVITY, PERIOD = 4e-5, 9.81, 2.0


def write_drum(name):
    """A cylinder closed by two flat ends, as STL."""
    a = 2 * np.pi * np.arange(SIDES + 1) / SIDES
    x, z = RADIUS * np.cos(a), RADIUS * np.sin(a)
    facets = []
    for i in range(SIDES):
        low, high = [(x[k], -LENGTH / 2, z[k]) for k in (i, i + 1)], [(x[k], LENGTH / 2, z[k]) for k in (i, i + 1)]
        facets += [(low[0], low[1], high[1]), (low[0], high[1], high[0]),
                   (low[0], low[1], (0, -LENGTH / 2, 0)), (high[0], (0, LENGTH / 2, 0), high[1])]
    with open(name, "w", encoding="ascii") as f:
        f.write("solid drum\n")
        for facet in facets:
            f.write("facet normal 0 0 0\nouter loop\n")
            f.writelines("vertex %.17g %.17g %.17g\n" % corner for corner in facet)
            f.write("endloop\nendfacet\n")
        f.write("endsolid drum\n")


class Grains:
    def __init__(self):
        r = np.random.default_rng(1)
        side = 2.2 * GRAIN
        grid = np.array([(i, j, k) for k in range(-14, 15) for i in range(-14, 15) for j in range(-3, 4)]) * side
        inside = (np.hypot(grid[:, 0], grid[:, 2]) < RADIUS - GRAIN) & (abs(grid[:, 1]) < LENGTH / 2 - GRAIN)
        self.x = np.ascontiguousarray(grid[inside][:N] + r.uniform(-0.04, 0.04, (N, 3)) * GRAIN)
        self.radius = np.full(N, GRAIN)
        self.mass = DENSITY * 4 / 3 * np.pi * self.radius**3
        self.v, self.omega = np.zeros((N, 3)), np.zeros((N, 3))
        self.force, self.torque = np.zeros((N, 3)), np.zeros((N, 3))
        self.listed_at = None

    def near_pairs(self):
        """Pairs that may touch before a grain has gone half of what the list has room for."""
        room = 0.5 * GRAIN
        if self.listed_at is None or ((self.x - self.listed_at)**2).sum(1).max() > (room / 2)**2:
            self.listed_at = self.x.copy()
            i, j = np.triu_indices(N, 1)
            near = ((self.x[i] - self.x[j])**2).sum(1) < (2 * GRAIN + room)**2
            self.pairs = i[near], j[near]
        return self.pairs

    def push_each_other(self):
        i, j = self.near_pairs()
        between = self.x[i] - self.x[j]
        distance = np.sqrt((between**2).sum(1))
        overlap = 2 * GRAIN - distance
        touch = overlap > 0
        i, j, overlap = i[touch], j[touch], overlap[touch, None]
        normal = between[touch] / distance[touch, None]
        arm = GRAIN - overlap / 2
        v = self.v[i] - self.v[j] - arm * np.cross(self.omega[i] + self.omega[j], normal)
        along = (v * normal).sum(1, keepdims=True)
        push = np.maximum(STIFFNESS * overlap - DAMPING * along, 0)
        slip = v - along * normal
        speed = np.sqrt((slip**2).sum(1, keepdims=True)) + 1e-12
        force = push * normal - np.minimum(FRICTION * push, DAMPING * speed) * slip / speed
        turn = -arm * np.cross(normal, force)
        np.add.at(self.force, i, force)
        np.add.at(self.force, j, -force)
        np.add.at(self.torque, i, turn)
        np.add.at(self.torque, j, turn)

    def push(self, wall, setup=False):
        self.force[:] = self.torque[:] = 0
        self.force[:, 2] -= GRAVITY * self.mass
        self.push_each_other()
        wall.step(self.x, self.v, self.omega, self.radius, self.mass, self.force, self.torque, DT, setup=setup)

    def kick(self):
        self.v += 0.5 * DT * self.force / self.mass[:, None]
        self.omega += 0.5 * DT * self.torque / (0.4 * self.mass * self.radius**2)[:, None]


def slope(x):
    """Of the bed's surface, in degrees: a line through its highest grains. > 0: it rises along x."""
    column = np.round(x[:, 0] / (3 * GRAIN))
    top = np.array([x[column == c][x[column == c, 2].argmax()] for c in np.unique(column)])
    middle = top[abs(top[:, 0]) < 0.6 * RADIUS]
    return np.degrees(np.arctan(np.polyfit(middle[:, 0], middle[:, 2], 1)[0]))


def draw(grains, wall, name, time):
    plt.rcParams["font.size"] = 14
    figure, axes = plt.subplots(figsize=(5, 5))
    a = 2 * np.pi * np.arange(SIDES + 1) / SIDES
    pose = wall.pose()
    rim = np.stack([RADIUS * np.cos(a), 0 * a, RADIUS * np.sin(a)], 1) @ pose[:, :3].T + pose[:, 3]
    axes.plot(1e3 * rim[:, 0], 1e3 * rim[:, 2], "k-", lw=2)
    axes.plot(1e3 * rim[0, 0], 1e3 * rim[0, 2], "ko", ms=8)    # a mark that turns
    speed = np.sqrt((grains.v**2).sum(1))
    for i in np.argsort(-grains.x[:, 1]):
        axes.add_patch(plt.Circle(1e3 * grains.x[i, ::2], 1e3 * GRAIN, lw=0.3, ec="k",
                                  fc=plt.cm.viridis(speed[i] / (2 * np.pi * RADIUS / PERIOD))))
    scale = plt.Normalize(0, 2 * np.pi * RADIUS / PERIOD)
    figure.colorbar(plt.cm.ScalarMappable(scale, "viridis"), ax=axes, label="speed, m/s", shrink=0.8)
    turn = np.radians(np.linspace(120, 60, 20))    # about +y, which points away: clockwise
    arc = 1e3 * 1.08 * RADIUS * np.stack([np.cos(turn), np.sin(turn)])
    axes.plot(*arc, "k-", lw=2)
    axes.annotate("", arc[:, -1], arc[:, -2], arrowprops=dict(arrowstyle="-|>", lw=2, fc="k", mutation_scale=20))
    axes.set(xlabel="x, mm", ylabel="z, mm", aspect="equal", title=f"after {time:.2f} s")
    figure.savefig(name, dpi=120, bbox_inches="tight")


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else "."
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 1.5
    mesh = os.path.join(folder, "drum.stl")
    write_drum(mesh)
    # Gas of grains that fall; the drum turns about y as soon as they are there.
    wall = lsdcd.Wall("hertz/history 2e6 1e6 1e5 5e4 0.5 1  mesh $drum  motion rotate 0 0 0 0 1 0 $period",
                      drum=lsdcd.Mesh(mesh), period=PERIOD)
    grains = Grains()
    grains.push(wall, setup=True)
    steps = int(seconds / DT)
    for step in range(steps):
        grains.kick()
        grains.x += DT * grains.v
        grains.push(wall)
        grains.kick()
        if step % (steps // 10 or 1) == 0:
            print(f"{step * DT:5.2f} s, {wall.totals().contacts:.0f} contacts with the wall", flush=True)
    draw(grains, wall, os.path.join(folder, "drum.png"), seconds)
    inside = np.hypot(grains.x[:, 0], grains.x[:, 2]).max() < RADIUS
    print(f"the bed is inclined by {slope(grains.x):.0f} degrees; all grains are inside: {inside}")
    return 0 if inside else 1


if __name__ == "__main__":
    sys.exit(main())
