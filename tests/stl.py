# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Meshes of tests, in STL files. A triangle has three points (x, y, z)."""
import pathlib
import struct


def write(path, triangles):
    """As text, in all digits."""
    with open(path, "w") as stl:
        stl.write("solid mesh\n")
        for t in triangles:
            stl.write("facet normal 0 0 0\nouter loop\n" + "".join("vertex %.17g %.17g %.17g\n" % tuple(p) for p in t) +
                      "endloop\nendfacet\n")
        stl.write("endsolid mesh\n")


def read(path):
    """Triangles of a binary file, in floats."""
    data = pathlib.Path(path).read_bytes()
    assert len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]
    return [(r[:3], r[3:6], r[6:]) for r in struct.iter_unpack("<12x9f2x", data[84:])]


def points(path):
    """The corners of a binary file, one number after the other."""
    return [x for t in read(path) for p in t for x in p]


def quad(a, b, c, d):
    return [(a, b, c), (a, c, d)]


def sheet(cells, point):
    """2 cells^2 triangles between `point(i, j)`, where i and j go from 0 to `cells`."""
    return [t for i in range(cells) for j in range(cells)
            for t in quad(point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1))]


def square(half, z=0):
    """Across z, wound upwards."""
    return quad((-half, -half, z), (half, -half, z), (half, half, z), (-half, half, z))


def box(lo, hi, cells=1):
    """Closed, its normals out; each face is cut into 2 cells^2 triangles."""
    triangles = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (lo, hi):
            def point(i, j):
                p = list(side)
                p[u] = lo[u] + (hi[u] - lo[u]) * i / cells
                p[v] = lo[v] + (hi[v] - lo[v]) * j / cells
                return tuple(p)
            triangles += sheet(cells, point if side is hi else lambda i, j: point(j, i))
    return triangles
