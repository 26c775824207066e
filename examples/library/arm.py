# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""A two-link arm draws a paddle through a bed: poses go in, force and torque come out, and the arm feels them.

usage: arm.py [FOLDER [SECONDS [TIMESTEP]]]

The arm has hinges about y at its shoulder and its elbow, where motors hold the angles on a path, and masses at the ends of
its links. Grains are those of the DEM in drum.py. Both programs make the same steps: half a kick, a drift, the forces,
half a kick. So what the paddle gives the grains it takes from the arm in the same step, and the angular momentum of
grains and arm about the shoulder is what the motor, gravity and the tray gave, to rounding. The energy of the arm is what
motors and grains gave, but for the error of its steps, which is a quarter where the step is halved. Prints both books, and
writes FOLDER/arm.png. Units are SI.
"""
import os
import sys

import numpy as np

import drum
import lsdcd

L, MASS, SHOULDER = np.array([0.06, 0.06]), np.array([0.03, 0.02]), np.array([-0.03, 0, 0.06])    # of both links
SIZE, HALF = np.array([0.076, 0.02, 0.04]), np.array([0.01, 0.008, 0.001])    # of the tray; half of the paddle
HOLD, BRAKE = np.array([3.0, 1.5]), np.array([0.03, 0.01])                    # of the motors: N m, N m s


def box(lo, hi, sides):
    """Its corners and the triangles of its sides."""
    quads = [(0, 2, 3, 1), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5), (4, 5, 7, 6)][:sides]
    corners = [[(lo, hi)[k >> d & 1][d] for d in range(3)] for k in range(8)]
    return lsdcd.Mesh(corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))], np.uint32))


class Arm:
    """Angles q, downwards from the horizontal and from the first link, and their momenta p, of which the first is the
    angular momentum about the shoulder."""
    def __init__(self):
        self.q, self.p, self.work, self.taken = self.target(0), np.zeros(2), 0.0, 0.0

    def target(self, t):
        """The angles with which the paddle goes down, and then through the bed."""
        s = np.clip([t / 0.15, t / 0.3 - 0.5], 0, 1)
        down, along = s * s * (3 - 2 * s)
        x, z = np.array([0.015 + 0.04 * along, 0.045 - 0.029 * down]) - SHOULDER[::2]
        bend = np.arccos((x * x + z * z - L @ L) / (2 * L.prod()))
        return np.array([np.arctan2(-z, x) - np.arctan2(L[1] * np.sin(bend), L[0] + L[1] * np.cos(bend)), bend])

    def rates(self, q, p):
        far, last = L.prod() * MASS[1] * np.cos(q[1]), L[1]**2 * MASS[1]
        return np.linalg.solve([[L[0]**2 * MASS.sum() + last + 2 * far, last + far], [last + far, last]], p)

    def hinges(self):
        """Shoulder, elbow and wrist."""
        links = [length * np.array([np.cos(a), 0, -np.sin(a)]) for length, a in zip(L, np.cumsum(self.q))]
        return SHOULDER, SHOULDER + links[0], SHOULDER + links[0] + links[1]

    def gravity(self):
        """Moments about the shoulder and the elbow."""
        shoulder, elbow, wrist = self.hinges()
        last = MASS[1] * (wrist - elbow)[0]
        return drum.GRAVITY * np.array([MASS.sum() * (elbow - shoulder)[0] + last, last])

    def energy(self):
        return 0.5 * self.p @ self.rates(self.q, self.p) + drum.GRAVITY * MASS @ [h[2] for h in self.hinges()[1:]]

    def kick(self, dt, motors, grains, ahead):
        """`ahead`: the speed in the middle of the step, of which centrifugal forces are, is that after the kick."""
        first, before = self.p, self.rates(self.q, self.p)
        for _ in range(4 if ahead else 1):
            a, b = self.rates(self.q, self.p)
            turning = -L.prod() * MASS[1] * np.sin(self.q[1]) * a * (a + b)
            self.p = first + dt * (motors + grains + self.gravity() + [0, turning])
        mean = 0.5 * (before + self.rates(self.q, self.p))
        self.work, self.taken = self.work + dt * motors @ mean, self.taken + dt * grains @ mean

    def drift(self, dt):
        first, rate = self.q, self.rates(self.q, self.p)
        for _ in range(4):
            self.q = first + 0.5 * dt * (rate + self.rates(self.q, self.p))

    def move(self, wall):
        """Its pose goes in, with the velocity of the middle of the step."""
        (a, b), angle, axis = self.rates(self.q, self.p), self.q.sum(), np.array([0, 1, 0])
        shoulder, elbow, wrist = self.hinges()
        v = a * np.cross(axis, wrist - shoulder) + b * np.cross(axis, wrist - elbow)
        wall.set_pose("paddle", wrist, (np.cos(angle / 2), 0, np.sin(angle / 2), 0), v, (a + b) * axis)

    def moments(self, wall):
        """What the grains do to it comes out."""
        return np.array([wall.totals("paddle", hinge).torque[1] for hinge in self.hinges()[:2]])


def angular_momentum(grains):
    spin = 0.4 * grains.mass * grains.radius**2 * grains.omega[:, 1]
    return (grains.mass * np.cross(grains.x - SHOULDER, grains.v)[:, 1] + spin).sum()


def draw(grains, arm, name):
    drum.plt.rcParams["font.size"] = 14
    figure, axes = drum.plt.subplots(figsize=(6.6, 4.5))
    tip, along = arm.hinges()[2], (arm.hinges()[2] - arm.hinges()[1]) / L[1]
    axes.plot(*1e3 * np.array([[0, SIZE[2]], [0, 0], [SIZE[0], 0], [SIZE[0], SIZE[2]]]).T, "k-", lw=2)
    axes.plot(*1e3 * np.array(arm.hinges())[:, ::2].T, "o-", color="tab:orange", lw=4, ms=8)
    axes.plot(*1e3 * np.array([tip - HALF[0] * along, tip + HALF[0] * along])[:, ::2].T, "-", color="tab:red", lw=5)
    for i in np.argsort(-grains.x[:, 1]):
        axes.add_patch(drum.plt.Circle(1e3 * grains.x[i, ::2], 1e3 * drum.GRAIN, lw=0.3, ec="k",
                                       fc=drum.plt.cm.viridis(np.linalg.norm(grains.v[i]) / 0.2)))
    scale = drum.plt.Normalize(0, 0.2)
    figure.colorbar(drum.plt.cm.ScalarMappable(scale, "viridis"), ax=axes, label="speed, m/s", shrink=0.8)
    axes.set(xlabel="x, mm", ylabel="z, mm", aspect="equal")
    figure.savefig(name, dpi=100, bbox_inches="tight")


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else "."
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 0.4
    dt = drum.DT = float(sys.argv[3]) if len(sys.argv) > 3 else drum.DT
    wall = lsdcd.Wall("hertz/history 2e6 1e6 1e5 5e4 0.5 1  mesh $tray  mesh $paddle motion caller",
                      tray=box((0, -SIZE[1] / 2, 0), SIZE * [1, 0.5, 1], 5), paddle=box(-HALF, HALF, 6))
    arm, grains = Arm(), drum.Grains()
    rows = np.array([(i + 0.53, j - 1.5, k + 0.53) for k in range(4) for j in range(4) for i in range(17)])
    grains.x[:] = 2.04 * drum.GRAIN * rows[:drum.N]

    def forces(t, setup=False):
        arm.move(wall)
        grains.push(wall, setup)
        return HOLD * (arm.target(t) - arm.q) - BRAKE * arm.rates(arm.q, arm.p), arm.moments(wall)

    def kick(motors, moments, ahead):
        """All of it, and what gave angular momentum about the shoulder: motor, gravity, and the tray."""
        outside = [motors[0], arm.gravity()[0], drum.GRAVITY * grains.mass @ (grains.x - SHOULDER)[:, 0],
                   -wall.totals("tray", SHOULDER).torque[1]]
        grains.kick()
        arm.kick(0.5 * dt, motors, moments, ahead)
        return 0.5 * dt * sum(outside), 0.5 * dt * (sum(map(abs, outside)) + abs(moments[0]))

    (motors, moments), most = forces(0, setup=True), 0.0
    energy, momentum = arm.energy(), arm.p[0] + angular_momentum(grains)
    given, size = 0.0, 0.0
    for step in range(round(seconds / dt)):
        first = kick(motors, moments, True)
        arm.drift(dt)
        grains.x += dt * grains.v
        motors, moments = forces((step + 1) * dt)
        second = kick(motors, moments, False)
        given, size, most = given + first[0] + second[0], size + first[1] + second[1], max(most, abs(moments[0]))
    missing = abs(arm.p[0] + angular_momentum(grains) - momentum - given)
    print(f"the grains' moment about the shoulder was up to {most:.3g} N m, their work on the arm {1e3 * arm.taken:.4g} mJ")
    lost, work = abs(arm.energy() - energy - arm.work - arm.taken), abs(arm.work) + abs(arm.taken)
    print(f"angular momentum: {missing:.2g} of {size:.3g} N m s is missing")
    print(f"energy: {lost:.2g} of {work:.3g} J is missing")
    draw(grains, arm, os.path.join(folder, "arm.png"))
    # Sums of each step have 300 numbers, none larger than all that was given. In a swing of frequency w work by the mean of
    # speeds is wrong by (w dt)^2/12 of it, and the arm has none faster than that of its stiffer motor and its last mass.
    swing = HOLD.max() / (MASS[1] * L[1]**2) * dt**2 / 12
    return 0 if most > 0 and missing < 300 * 2.3e-16 * size and lost < swing * work else 1


if __name__ == "__main__":
    sys.exit(main())
