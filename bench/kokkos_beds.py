# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Beds of spheres for kokkos*.py: what a script says of them, and their meshes."""
import math

import lammps    # noqa: F401, by which stl.py is found
from stl import strip, write_stl

LAW = "hooke/history 4000 NULL 100 NULL 0.5 1"
# As stiff as LAW where the closed box is compressed.
GRANULAR = ("granular hertz/material 65000 0.7 0.25 tangential mindlin NULL 1.0 0.5 "
            "rolling sds 2000 20 0.1 twisting marshall damping coeff_restitution")
# The same without rolling and twisting, which grains have among themselves, too, where a benchmark says "mindlin".
MINDLIN = "hertz/material 65000 0.7 0.25 tangential mindlin NULL 1.0 0.5 damping coeff_restitution"
SPRING = "tangential linear_history 2000 0 0.5"
# Laws of granular/lsdcd, and with the same words of granular walls.
GRANULAR_GRAINS = {"mindlin": MINDLIN, "hysteretic": f"hysteretic 4000 0.7 {SPRING}", "eepa": f"eepa 4000 0.7 0.5 1 1 1 0 {SPRING}",
                   "capillary": f"{MINDLIN} cohesion capillary 1 20 NULL 1e-4"}
# Of grains: {name: (pair style and coefficients, the same law as a wall has it)}
GRAINS = {"hooke": (f"pair_style gran/{LAW}\npair_coeff * *", LAW),
          **{name: (f"pair_style granular/lsdcd\npair_coeff * * {law}", f"granular {law}") for name, law in GRANULAR_GRAINS.items()}}
SPEED = 20.0    # along the wall
CUBE = math.sqrt(2)    # edge of the lattice's cube of 4 sites, neighbours 1 apart
PLANES = 40    # of spheres on a floor
SPACING = 0.985    # of spheres of diameter 1 in the closed box: compressed by 1.5 %
WALL_CELLS = 41    # along and across each of its six walls
DRUM_AROUND, DRUM_RINGS = 360, 69    # segments of a drum, and rings of each lid; twice as many along its shell
DRUM_PERIOD = 3000.0    # time of a turn: at a radius of 250 the wall's acceleration is 1/1000 of gravity
HOPPER_AROUND, HOPPER_RINGS = 180, 28    # segments of a hopper, and rings of each part


def near_square(ranks):
    """Two factors, the larger first."""
    for y in range(int(math.sqrt(ranks)), 0, -1):
        if ranks % y == 0:
            return ranks // y, y


class Bed:
    """A bed of `atoms` spheres, in a drum or a hopper about as many, its mesh in a file of `folder`, for `ranks` processes. `million`:
    triangles of a bumpy floor; `cells`: along and across each wall of a closed box; `time`: for which the box has room below a hopper."""

    def __init__(self, name, atoms, ranks, folder, million=1000000, cells=WALL_CELLS, time=0.0):
        self.name, self.atoms, self.ranks = name, atoms, ranks
        self.mesh = folder / "wall.stl"
        self.split = near_square(ranks)
        self.law = GRANULAR if name == "granular" else LAW    # of our wall
        self.turns = ""    # words of the mesh
        if name in ("box", "checked", "granular"):
            self.closed_box(cells)
        elif name == "drum":
            self.drum()
        elif name == "hopper":
            self.hopper(time)
        else:
            self.floor(million)

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
        self.lattice = f"fcc {4 / CUBE**3!r} origin 0.25 0.25 0.4"
        self.diameters, self.gravity = "0.97+0.03*random(0,1,7)", 1.0
        self.neighbours = "delay 0 every 1 check yes"
        self.boundary = "p p f"
        self.box = f"0 {side[0]!r} 0 {side[1]!r} -1 {height + 3!r}"
        self.volume = side[0] * side[1] * (height + 4)
        self.region = f"region bed block INF INF INF INF 0.4 {height + 0.4 - 1e-6!r} units box"
        self.motion = f"velocity all set {SPEED} 0 0 sum yes units box"

    def closed_box(self, cells):
        """A simple cubic lattice pushes against all six walls: the outer spheres overlap them by as much
        as their neighbours. It does not move, so neighbour lists are built every 50 steps; "checked" is
        the same as most scripts have it, where LAMMPS looks in each step whether they need to be."""
        (px, py), each = self.split, self.atoms / self.ranks
        along = max(1, round(each**(1 / 3)))
        sites = [px * along, py * along, math.ceil(self.atoms / (px * py * along**2))]
        side = [SPACING * n - (1 - SPACING) for n in sites]
        self.side = side
        triangles = box(side, cells)
        self.triangles = len(triangles)
        write_stl(self.mesh, triangles, "a closed box")
        first = (SPACING - 0.5) / SPACING
        self.lattice = f"sc {SPACING**-3!r} origin" + 3 * f" {first!r}"
        self.diameters, self.gravity = "1.0", 0.1
        self.neighbours = f"delay 0 every {'1 check yes' if self.name == 'checked' else '50 check no'}"
        self.boundary = "f f f"
        self.box = " ".join(f"-1 {s + 1!r}" for s in side)
        self.volume = math.prod(s + 2 for s in side)
        self.region = "region bed block " + " ".join(f"0 {s!r}" for s in side) + " units box"
        self.motion = ""

    def drum(self):
        """Half full and turning about y, as long for each process as its radius."""
        radius = (2 * self.atoms / self.ranks / math.pi)**(1 / 3)
        length = self.ranks * radius

        def around(r, y):
            return [(a, y, b) for a, b, _ in ring(r, 0.0, DRUM_AROUND)]

        lids = [[around(radius * k / DRUM_RINGS, y) for k in range(1, DRUM_RINGS + 1)] for y in (0.0, length)]
        shell = [around(radius, length * k / (2 * DRUM_RINGS)) for k in range(2 * DRUM_RINGS + 1)]
        triangles = [t for rows in (*lids, shell) for one, other in zip(rows, rows[1:]) for t in strip(one, other)]
        for rows, y in zip(lids, (0.0, length)):
            triangles += [((0.0, y, 0.0), a, b) for a, b in zip(rows[0], rows[0][1:])]
        self.triangles = len(triangles)
        write_stl(self.mesh, triangles, "a drum")
        self.turns = f" motion rotate 0 0 0 0 1 0 {DRUM_PERIOD}"
        self.loose()
        self.box = f"{-radius - 1!r} {radius + 1!r} -1 {length + 1!r} {-radius - 1!r} {radius + 1!r}"
        self.region = (f"region shell cylinder y 0 0 {radius - 0.6!r} 0.6 {length - 0.6!r} units box\n"
                       "region lower block INF INF INF INF INF 0 units box\nregion bed intersect 2 shell lower")

    def hopper(self, time):
        """A bin over a funnel from which grains fall. After `time` they have fallen no deeper than the box goes: what they have at the
        outlet is less than a fall through the radius gives."""
        self.radius = (self.atoms / 7.5)**(1 / 3)
        outlet, self.top = max(3.0, 0.12 * self.radius), 3 * self.radius
        levels = [(outlet + (self.radius - outlet) * k / HOPPER_RINGS, self.radius * k / HOPPER_RINGS) for k in range(HOPPER_RINGS + 1)]
        levels += [(self.radius, self.radius + (self.top + 10 - self.radius) * k / HOPPER_RINGS) for k in range(1, HOPPER_RINGS + 1)]
        wall = [t for low, high in zip(levels, levels[1:]) for t in strip(ring(*low, HOPPER_AROUND), ring(*high, HOPPER_AROUND))]
        self.triangles = len(wall)
        write_stl(self.mesh, wall, "a bin over a funnel")
        rim = ring(1.1 * outlet, -1.0, HOPPER_AROUND)
        write_stl(self.mesh.with_name("outlet.stl"), [((0.0, 0.0, -1.0), b, a) for a, b in zip(rim, rim[1:])], "its outlet, down")
        self.loose()
        r, z, fall = self.radius + 1, self.top + 12, 10 + math.sqrt(2 * self.radius) * time + time**2 / 2
        self.box = f"{-r!r} {r!r} {-r!r} {r!r} {-fall!r} {z!r}"
        self.region = (f"region bin cylinder z 0 0 {self.radius - 0.6!r} {self.radius!r} {self.top!r} units box\n"
                       f"region funnel cone z 0 0 {outlet - 0.6!r} {self.radius - 0.6!r} 0 {self.radius!r} units box\n"
                       "region bed union 2 bin funnel")

    def loose(self):
        """Grains of two sizes that settle from a lattice and move."""
        self.lattice, self.diameters, self.gravity = "sc 1.0 origin 0.5 0.5 0.5", "0.95+0.05*random(0,1,7)", 1.0
        self.neighbours, self.boundary = "delay 0 every 1 check yes", "f f f"

    def wall(self, style="wall/lsdcd"):
        if style == "wall/lsdcd":
            return f"fix wall all wall/lsdcd {self.law} mesh {self.mesh}" + \
                " periodic" * (self.boundary[0] == "p") + self.turns
        # LAMMPS's own; its suffix must not choose the form.
        return f"suffix off\nfix wall all {style} {LAW} zplane 0.0 NULL\nsuffix on"

    def walls_with_body(self):
        """Of the closed box: {what is added to the row's case: the wall}. The box is one mesh, or its floor is a mesh of its own
        beside the rest. The last mesh is at rest, moves (1e-9 a unit of time), or is a body on a slider with a spring, so heavy
        that it moves less than 1e-4 while steps are timed."""
        floor, sides = self.mesh.with_name("floor.stl"), self.mesh.with_name("sides.stl")
        triangles = box(self.side, WALL_CELLS)
        write_stl(floor, [t for t in triangles if all(p[2] == 0 for p in t)], "a floor")
        write_stl(sides, [t for t in triangles if any(p[2] != 0 for p in t)], "five walls")
        heavy, stiff = float(self.atoms), 100.0 * self.atoms
        body = (f"body mass {heavy!r} com 0 0 0 inertia {heavy!r} {heavy!r} {heavy!r} 0 0 0 gravity 0 0 0 "
                f"joint slider 0 0 1 spring {stiff!r} {0.1 * heavy!r}")
        walls = {}
        for meshes, name in (((self.mesh,), ""), ((sides, floor), ", two meshes")):
            wall = f"fix wall all wall/lsdcd {self.law} " + " ".join(f"mesh {m}" for m in meshes)
            for words, what in (("", ", at rest"), (" motion linear 0 0 1e-9", ", moves"), (f" {body}", ", body")):
                walls[name + what] = wall + words
        return walls

    def processors(self):
        """Slices along a drum and, where the load moves, along the height of a hopper."""
        return {"drum": "processors 1 * 1", "hopper": "processors 1 1 *"}.get(self.name) or "processors {} {} 1".format(*self.split)


def ring(radius, z, segments):
    return [(radius * math.cos(2 * math.pi * k / segments), radius * math.sin(2 * math.pi * k / segments), z) for k in range(segments)] + [(radius, 0.0, z)]


def cells_of(triangles):
    """A grid of about twice as many cells along x as along y."""
    ny = max(1, round(math.sqrt(triangles / 4)))
    return max(1, round(triangles / 2 / ny)), ny


def sheet(z, side, nx, ny):
    """Triangles of z(x, y), from -2 to `side` - 2."""
    def row(j):
        y = -2 + side[1] * j / ny
        return [(x, y, z(x, y)) for x in (-2 + side[0] * i / nx for i in range(nx + 1))]

    rows = [row(j) for j in range(ny + 1)]
    return [t for one, other in zip(rows, rows[1:]) for t in strip(one, other)]


def box(side, n):
    """Triangles of a closed box from the origin to `side`, n x n cells on each of its six walls."""
    triangles = []
    for axis in range(3):
        u, w = (axis + 1) % 3, (axis + 2) % 3

        def at(i, j, height):
            p = [0.0, 0.0, 0.0]
            p[axis], p[u], p[w] = height, side[u] * i / n, side[w] * j / n
            return tuple(p)

        for height in (0.0, side[axis]):
            rows = [[at(i, j, height) for i in range(n + 1)] for j in range(n + 1)]
            triangles += [t for one, other in zip(rows, rows[1:]) for t in strip(one, other)]
    return triangles
