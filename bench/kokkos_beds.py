"""Beds of spheres for kokkos.py: what a deck says of them, and their meshes."""
import math
import os
import pathlib
import sys

from hard_cases import ROOT

sys.path.insert(0, os.path.join(ROOT, "examples"))
from stl import write_stl    # noqa: E402

VESSEL = pathlib.Path(ROOT, "examples", "vessel")
LAW = "hooke/history 4000 NULL 100 NULL 0.5 1"
SPEED = 20.0    # along the wall
CUBE = math.sqrt(2)    # edge of the lattice's cube of 4 sites, neighbours 1 apart
PLANES = 40    # of spheres on a floor


def near_square(ranks):
    """Two factors, the larger first."""
    for y in range(int(math.sqrt(ranks)), 0, -1):
        if ranks % y == 0:
            return ranks // y, y


class Bed:
    """A bed of `atoms` spheres, its mesh in a file of `folder`, for `ranks` processes."""

    def __init__(self, name, atoms, ranks, folder, million=1000000):
        self.name, self.atoms, self.ranks = name, atoms, ranks
        self.mesh, self.scale = folder / "wall.stl", 1.0
        self.split = near_square(ranks)
        (self.vessel if name == "vessel" else self.floor)(million)

    def floor(self, million):
        (px, py), each = self.split, self.atoms / self.ranks
        cubes = math.ceil(math.sqrt(each / (2 * PLANES)))
        side = [px * cubes * CUBE, py * cubes * CUBE]
        height = PLANES / 2 * CUBE
        waves = [max(1, round(s / 8)) for s in side]

        def z(x, y):
            if self.name == "flat":
                return 0.0
            return 0.1 * (math.sin(2 * math.pi * waves[0] * x / side[0]) *
                          math.cos(2 * math.pi * waves[1] * y / side[1]) - 1)

        nx, ny = (1, 1) if self.name == "flat" else cells_of(million)
        self.triangles = 2 * nx * ny
        write_stl(self.mesh, sheet(z, [s + 4 for s in side], nx, ny), "a floor")
        self.boundary = "p p f"
        self.box = f"0 {side[0]!r} 0 {side[1]!r} -1 {height + 3!r}"
        self.volume = side[0] * side[1] * (height + 4)
        self.region = f"region bed block INF INF INF INF 0.4 {height + 0.4 - 1e-6!r} units box"
        self.motion = f"velocity all set {SPEED} 0 0 sum yes units box"

    def vessel(self, _):
        close_vessel(self.mesh)
        self.triangles = (self.mesh.stat().st_size - 84) // 50
        # The lattice fills a little more than the atoms need; the highest sites go.
        low, high, volume = 0.01, 1000.0, 1.03 * self.atoms / math.sqrt(2)
        while high - low > 1e-9 * high:
            s = (low + high) / 2
            low, high = (s, high) if vessel_volume(s) < volume else (low, s)
        self.scale = s = high
        r = 50 * s + 1
        self.boundary = "f f f"
        self.box = f"{-r!r} {r!r} {-r!r} {r!r} -1 {190 * s!r}"
        self.volume = 4 * r * r * (190 * s + 1)
        tube, low_cone, high_cone, shoulder, side, pipe = vessel_radii(s)
        self.region = f"""\
region tube cylinder z 0 0 {tube!r} 0.6 {30 * s!r} units box
region cone cone z 0 0 {low_cone!r} {high_cone!r} {30 * s!r} {80 * s!r} units box
region shoulder cylinder z 0 0 {shoulder!r} {80 * s!r} {90 * s!r} units box
region column cylinder z 0 0 {side!r} {90 * s!r} {150 * s!r} units box
region inside union 4 tube cone shoulder column
region pipe cylinder z 0 0 {pipe!r} {110 * s - 0.6!r} {190 * s!r} side out units box
region bed intersect 2 inside pipe"""
        turn = SPEED / (50 * s)
        self.motion = (f"variable vx atom -y*{turn!r}\nvariable vy atom x*{turn!r}\n"
                       "velocity all set v_vx v_vy 0 sum yes units box")

    def wall(self, style="wall/lsdcd"):
        if style == "wall/lsdcd":
            return f"fix wall all wall/lsdcd {LAW} mesh {self.mesh} scale {self.scale!r}" + \
                " periodic" * (self.boundary[0] == "p")
        # LAMMPS's own; its suffix must not choose the form.
        return f"suffix off\nfix wall all {style} {LAW} zplane 0.0 NULL\nsuffix on"

    def processors(self):
        return "processors {} {} 1".format(*self.split)


def cells_of(triangles):
    """A grid of about twice as many cells along x as along y."""
    ny = max(1, round(math.sqrt(triangles / 4)))
    return max(1, round(triangles / 2 / ny)), ny


def sheet(z, side, nx, ny):
    """Triangles of z(x, y), from -2 to `side` - 2."""
    def row(j):
        y = -2 + side[1] * j / ny
        return [(x, y, z(x, y)) for x in (-2 + side[0] * i / nx for i in range(nx + 1))]

    triangles, above = [], row(0)
    for j in range(ny):
        below, above = above, row(j + 1)
        for a, b, c, d in zip(below, below[1:], above[1:], above):
            triangles += [(a, b, c), (a, c, d)]
    return triangles


def close_vessel(path):
    """The example's vessel and its outlet's plate in one file."""
    parts = [(VESSEL / name).read_bytes() for name in ("vessel.stl", "outlet.stl")]
    count = sum(int.from_bytes(p[80:84], "little") for p in parts)
    path.write_bytes(b"vessel and outlet, millimetres".ljust(80) + count.to_bytes(4, "little") +
                     b"".join(p[84:] for p in parts))


def vessel_radii(s):
    """Of the lattice: tube, foot and head of the cone, shoulder (the rounding takes some of
    it), cylinder; and of the pipe that is left free."""
    slant = math.hypot(1, 35 / 50)
    return (15 * s - 0.6, 15 * s - 0.6 * slant, 50 * s - (0.6 + 0.6 * s) * slant,
            50 * s - 0.6 - 0.6 * s, 50 * s - 0.6, 12 * s + 0.6)


def vessel_volume(s):
    tube, low, high, shoulder, side, pipe = (max(r, 0.0) for r in vessel_radii(s))
    cone = 50 / 3 * s * (low**2 + low * high + high**2)
    return math.pi * (tube**2 * max(30 * s - 0.6, 0) + cone + 10 * s * shoulder**2 +
                      60 * s * side**2 - (40 * s + 0.6) * pipe**2)
