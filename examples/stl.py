# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Triangles of simple shapes, and how they become a binary STL file."""
import argparse
import math
import struct


def options(doc):
    """A parser with --out, the folder that the files go to; --help shows the defaults of all."""
    p = argparse.ArgumentParser(description=doc,
                                formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    p.add_argument("--out", default=".", help="folder")
    return p


def write_stl(path, triangles, title):
    """`triangles` are triples of (x, y, z); the normal is the winding's."""
    with open(path, "wb") as out:
        out.write(title.encode().ljust(80, b" "))
        out.write(struct.pack("<I", len(triangles)))
        for a, b, c in triangles:
            u = [b[k] - a[k] for k in range(3)]
            w = [c[k] - a[k] for k in range(3)]
            n = (u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0])
            size = math.hypot(*n) or 1
            out.write(struct.pack("<12fH", *(x / size for x in n), *a, *b, *c, 0))
    print(f"{path}: {len(triangles)} facets")


def circle(radius, n):
    """n points (x, y)."""
    turns = [2 * math.pi * k / n for k in range(n)]
    return [(radius * math.cos(t), radius * math.sin(t)) for t in turns]


def disc(ring, z):
    return [((0, 0, z), (*a, z), (*b, z)) for a, b in zip(ring, ring[1:] + ring[:1])]


def quad(a, b, c, d):
    """Its corners in their order round it."""
    return [(a, b, c), (a, c, d)]


def strip(one, other):
    """Between two lines of as many points."""
    return [t for a, b, c, d in zip(one, one[1:], other[1:], other) for t in quad(a, b, c, d)]


def extruded(line, y0, y1):
    """Between a line of points (x, z) at y0 and at y1."""
    return strip([(x, y0, z) for x, z in line], [(x, y1, z) for x, z in line])


def side(ring, lo, hi):
    """Of the cylinder over a closed ring of points (x, y)."""
    ring = ring + ring[:1]
    return strip([(*p, lo) for p in ring], [(*p, hi) for p in ring])


def box(lo, hi):
    """Its surface, wound outwards."""
    (x0, y0, z0), (x1, y1, z1) = lo, hi
    floor = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    low, high = [(*p, z0) for p in floor], [(*p, z1) for p in floor]
    return side(floor, z0, z1) + quad(*low[::-1]) + quad(*high)
