# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Meshes for input scripts. A triangle has three points (x, y, z)."""


def write(path, triangles):
    with open(path, "w") as stl:
        stl.write("solid mesh\n")
        for t in triangles:
            stl.write("facet normal 0 0 0\nouter loop\n" + "".join("vertex %.17g %.17g %.17g\n" % tuple(p) for p in t) +
                      "endloop\nendfacet\n")
        stl.write("endsolid mesh\n")


def quad(a, b, c, d):
    return [(a, b, c), (a, c, d)]


def sheet(cells, point):
    """2 cells^2 triangles between `point(i, j)`, where i and j go from 0 to `cells`."""
    return [t for i in range(cells) for j in range(cells)
            for t in quad(point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1))]
