#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Draws the sketches of doc/hard_cases.md: doc/img/hard_cases/NAME.png.

usage: hard_cases_pictures.py [NAME ...]

Left is what goes wrong, in orange and dashed, right what happens here, in blue. They are sketches, not results.
"""
import math
import os
import random
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FOLDER = os.path.join(ROOT, "doc", "img", "hard_cases")
WRONG, RIGHT = "#D55E00", "#0072B2"


class Panel:
    """One side of a sketch; x from -2 to 2, y from -1 to 1."""

    def __init__(self, axis, right):
        self.axis, self.right = axis, right
        self.colour = RIGHT if right else WRONG
        axis.set(xlim=(-2, 2), ylim=(-1, 1), aspect="equal")
        axis.axis("off")

    def wall(self, *points):
        """A section of the wall; dots are where triangles meet."""
        x, y = zip(*points)
        self.axis.plot(x, y, "-", color="black", linewidth=2.5, solid_joinstyle="round", zorder=3)
        self.axis.plot(x[1:-1], y[1:-1], "o", color="black", markersize=6, zorder=4)

    def sphere(self, x, y, radius=0.5, faint=False, colour=None):
        from matplotlib.patches import Circle
        self.axis.add_patch(Circle((x, y), radius, facecolor=colour or ("#f4f4f4" if faint else "#dddddd"),
                                   edgecolor="#777777", linewidth=1, zorder=1 if faint else 2))

    def arrow(self, start, end, colour=None):
        self.axis.annotate("", end, start, zorder=5, arrowprops=dict(
            arrowstyle="-|>", color=colour or self.colour, linewidth=2.5, mutation_scale=16,
            linestyle="-" if self.right or colour else (0, (4, 1.5)), shrinkA=0, shrinkB=0))

    def path(self, *points):
        x, y = zip(*points)
        self.axis.plot(x, y, "-" if self.right else "--", color=self.colour, linewidth=2, zorder=5)

    def text(self, x, y, words):
        self.axis.text(x, y, words, ha="center", va="center", fontsize=13, zorder=6, color=self.colour)


def seams(p):
    p.wall((-2, -0.6), (-1.1, -0.6), (0, -0.6), (0.8, -0.6), (2, -0.6))
    p.sphere(0, -0.15)
    p.arrow((0, -0.15), (0, 0.45 if p.right else 0.95))
    p.text(1.15, 0.5, "force F" if p.right else "2 F on a seam")


def convex(p):
    p.wall((-1.6, -1), (-0.7, -0.65), (0, -0.35), (0.7, -0.65), (1.6, -1))
    p.sphere(0, 0.1)
    if p.right:
        p.arrow((0, 0.1), (0, 0.8))
        p.text(1.25, 0.35, "one contact")
    else:
        for x in (-0.35, 0, 0.35):
            p.arrow((0, 0.1), (x, 0.8))
        p.text(1.25, 0.35, "one for each\ntriangle")


def folds(p):
    p.wall((-2, -0.3), (0, -0.75), (2, -0.3))
    p.sphere(0, -0.28)
    if p.right:
        p.arrow((0, -0.28), (0, 0.35))
        p.text(1.25, 0.6, "stiffness k")
    else:
        p.arrow((0, -0.28), (-0.13, 0.35))
        p.arrow((0, -0.28), (0.13, 0.35))
        p.text(1.25, 0.6, "stiffness 2 k")


def funnels(p):
    p.wall((-1.5, 0.9), (-0.45, -0.8), (0.45, -0.8), (1.5, 0.9))
    p.wall((-0.8, 0.9), (-0.25, -0.8))
    p.wall((0.8, 0.9), (0.25, -0.8))
    p.sphere(0, 0.1, 0.62)
    for side in (-1, 1):
        if p.right or side < 0:
            p.arrow((0.55 * side, -0.2), (0.12 * side, 0.06))
        if p.right or side > 0:
            p.arrow((0.3 * side, -0.42), (0.08 * side, -0.05))
    p.text(-1.4, -0.45, "all sides\ncarry it" if p.right else "these,\nthen the\nothers")


def polygon(n, radius, centre, begin=195, end=345):
    angles = [math.radians(begin + (end - begin) * i / n) for i in range(n + 1)]
    return [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in angles]


def drum(p):
    centre, inner = (0, 1), 1.9 - 0.36
    p.wall(*polygon(8, 1.9, centre))
    at = [(centre[0] + inner * math.cos(a), centre[1] + inner * math.sin(a))
          for a in (math.radians(x) for x in range(215, 326, 2))]
    if p.right:
        p.path(*at)
    else:
        p.path(*[(x, y + 0.12 * abs(math.sin(k * math.pi / 11)) * (1 - k / 60)) for k, (x, y) in enumerate(at)])
    p.sphere(*at[8], 0.34)
    p.text(0, 0.6, "rolls" if p.right else "hops, slows down")


def springs(p):
    p.wall((-2, -0.6), (0, -0.6), (2, -0.6))
    p.sphere(0.25, -0.12, 0.48)
    x = [-1.7 + 1.95 * i / 40 for i in range(41)] if p.right else [0 + 0.25 * i / 40 for i in range(41)]
    p.path(*[(v, -0.8 + 0.09 * math.sin(i * math.pi / 2.5)) for i, v in enumerate(x)])
    p.arrow((0.8, -0.12), (1.6, -0.12), "#555555")
    p.text(0, 0.7, "the spring goes on" if p.right else "a new spring at each seam")


def rolling(p):
    p.wall((-2, 0.05), (-0.9, -0.22), (0.1, -0.46), (1.1, -0.7), (2, -0.92))
    p.sphere(-0.75, 0.25, 0.5)
    path = [(-0.75 + 2.1 * t / 40, 0.25 - 0.51 * t / 40) for t in range(41)]
    if not p.right:
        path = [(x, y + 0.22 * abs(math.sin(k * math.pi / 13))) for k, (x, y) in enumerate(path)]
    p.path(*path)
    p.text(0.85, 0.6, "stays on the wall" if p.right else "lifts off at seams")


def bouncing(p):
    p.wall((-2, -0.7), (-0.6, -0.7), (0.8, -0.7), (2, -0.7))
    for x, low in ((-1.3, False), (-0.6, True)):
        height = -0.1 if low and not p.right else 0.35
        p.sphere(x, -0.4, 0.3)
        p.arrow((x, -0.4), (x, height))
    p.text(0.9, 0.3, "equal" if p.right else "damped twice\non a seam")


def belt(p):
    p.wall((-2, -0.6), (0, -0.6), (2, -0.6))
    p.arrow((-1.6, -0.85), (-0.2, -0.85), "#555555")
    p.sphere(-0.6, -0.13, 0.48)
    p.arrow((-0.6, -0.13), (0.35 if p.right else 0.9, -0.13))
    p.text(0.6, 0.65, "then rolls at 2/7 of it" if p.right else "drag off by the seams")


def energy(p):
    p.wall((-1.7, 0.9), (-1.7, -0.8), (1.7, -0.8), (1.7, 0.9))
    for x, y in ((-1.25, -0.4), (-0.42, -0.4), (0.42, -0.4), (1.25, -0.4)):
        p.sphere(x, y, 0.42)
        if not p.right:
            p.arrow((x, y), (x + 0.2 * math.cos(9 * x), y + 0.5))
    p.text(0, 0.5, "at rest" if p.right else "a bed that boils")


def timestep(p):
    p.wall((-2, -0.5), (0, -0.75), (2, -0.5))
    p.sphere(0, -0.28)
    size = (lambda i: 0.1) if p.right else (lambda i: 0.02 * 2 ** (i / 20))
    p.path(*[(-1.7 + 3.4 * i / 80, 0.62 + size(i) * math.cos(i * math.pi / 4)) for i in range(81)])
    p.text(1.35, 0.1, "stays" if p.right else "grows")


def fast(p):
    p.wall((0, -1), (0, 0), (0, 1))
    p.sphere(-0.9, 0, 0.4)
    if p.right:
        p.sphere(0.15, 0, 0.4, faint=True)
        p.path((-0.9, 0), (0.15, 0))
        p.arrow((0.15, 0.15), (-0.8, 0.3))
        p.text(-1.1, -0.7, "side in")
    else:
        p.sphere(0.25, 0, 0.4, faint=True)
        p.arrow((-0.9, 0), (1.5, 0))
        p.text(1.1, -0.7, "lost")


def triangle(p, corners):
    x, y = zip(*corners, corners[0])
    p.axis.fill(x, y, facecolor="#e8e8e8", edgecolor="black", linewidth=1, alpha=0.8)


def bad_meshes(p):
    for corners in (((-1.9, -0.5), (1.9, -0.5), (-1.8, -0.46)), ((-1.9, 0), (1.9, -0.15), (0, -0.1)),
                    ((-1.5, 0.2), (-0.5, 0.6), (-0.9, -0.4)), ((-1.2, 0.5), (-0.1, 0.1), (-0.4, 0.9)),
                    ((0.5, 0.2), (0.55, 0.9), (0.6, 0.2)), ((0.7, 0.2), (0.72, 0.9), (0.76, 0.2)),
                    ((0.9, 0.2), (0.9, 0.9), (0.92, 0.2))):
        triangle(p, corners)
    p.sphere(-0.55, 0.55, 0.2)
    p.arrow((-0.55, 0.55), (-0.2, 0.95) if p.right else (-0.55, -0.62))
    p.text(0.1, -0.85, "found, exact to round-off" if p.right else "missed: it falls through")


def random_meshes(p):
    r = random.Random(3)
    for _ in range(16):
        x, y = r.uniform(-1.7, 1.7), r.uniform(-0.35, 0.75)
        triangle(p, [(x + r.uniform(-0.4, 0.4), y + r.uniform(-0.25, 0.25)) for _ in range(3)])
    for k in range(6):
        x, y, radius = r.uniform(-1.6, 1.6), r.uniform(-0.35, 0.7), r.uniform(0.1, 0.3)
        p.sphere(x, y, radius, colour=WRONG if k == 1 and not p.right else None)
        if k == 1 and not p.right:
            p.arrow((x - 0.9, y + 0.55), (x - radius, y + radius / 2))
    p.text(0, -0.85, "each contact is found" if p.right else "one is missed")


SKETCHES = dict(seams=seams, convex=convex, folds=folds, funnels=funnels, drum=drum, springs=springs, rolling=rolling, bouncing=bouncing,
                belt=belt, energy=energy, timestep=timestep, fast=fast, bad_meshes=bad_meshes, random=random_meshes)


def draw(name):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from PIL import Image

    figure, axes = plt.subplots(1, 2, figsize=(6.4, 1.9))
    for axis, right in zip(axes, (False, True)):
        SKETCHES[name](Panel(axis, right))
        axis.set_title("LSDCD" if right else "what goes wrong", fontsize=12, color=RIGHT if right else WRONG)
    figure.add_artist(plt.Line2D([0.5, 0.5], [0.05, 0.95], color="#bbbbbb", linewidth=1))
    figure.subplots_adjust(left=0.01, right=0.99, bottom=0.02, top=0.86, wspace=0.06)
    path = os.path.join(FOLDER, name + ".png")
    os.makedirs(FOLDER, exist_ok=True)
    figure.savefig(path + ".part.png", dpi=100)
    plt.close(figure)
    Image.open(path + ".part.png").convert("RGB").quantize(64).save(path + ".part.png")    # a third of the size
    os.replace(path + ".part.png", path)


if __name__ == "__main__":
    for sketch in sys.argv[1:] or SKETCHES:
        draw(sketch)
