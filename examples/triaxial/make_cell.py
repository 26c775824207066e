#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write membrane.stl, a tube about z of nearly regular triangles that is open at both ends; membrane.data, an atom at each of
its vertices with a bond along each edge; and bottom.stl and top.stl, the plates.

Atoms of type 3 are the nodes that are free, of type 4 those at the bottom, of type 5 those at the top. Bonds of type 1 lie in a
ring, of type 2 between rings.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import nodes    # noqa: E402
from stl import circle, disc, options, write_stl    # noqa: E402


def tube(a):
    """Nodes by ring, and triangles of (ring, number), wound outwards: each ring is turned by half a node against the last."""
    n, rings = a.around, a.rings
    places = [[(a.radius * math.cos(2 * math.pi * (k + i / 2) / n), a.radius * math.sin(2 * math.pi * (k + i / 2) / n),
                a.height * i / rings) for k in range(n)] for i in range(rings + 1)]
    faces = []
    for i in range(rings):
        for k in range(n):
            following = (k + 1) % n
            faces += [((i, k), (i, following), (i + 1, k)), ((i, following), (i + 1, following), (i + 1, k))]
    return places, faces


def data(a, places, faces):
    number = {(i, k): i * a.around + k + 1 for i in range(a.rings + 1) for k in range(a.around)}
    atoms = [(n, 4 if i == 0 else 5 if i == a.rings else 3, places[i][k]) for (i, k), n in number.items()]
    edges = sorted({tuple(sorted((f[k], f[(k + 1) % 3]))) for f in faces for k in range(3)})
    bonds = [(1 if one[0] == other[0] else 2, number[one], number[other]) for one, other in edges]
    half = a.radius + 3
    return nodes.data("A membrane whose vertices are atoms", atoms, bonds, 5, 2, a.mass,
                      ((-half, half), (-half, half), (-1, a.height + 1)))


def main():
    p = options(__doc__)
    p.add_argument("--radius", type=float, default=5.0, help="of the membrane")
    p.add_argument("--height", type=float, default=20)
    p.add_argument("--around", type=int, default=28, help="nodes of a ring")
    p.add_argument("--rings", type=int, default=20, help="pieces of the height")
    p.add_argument("--mass", type=float, default=0.3, help="of a node")
    p.add_argument("--beyond", type=float, default=1.5, help="how far the plates reach beyond the membrane")
    a = p.parse_args()
    places, faces = tube(a)
    out = Path(a.out)
    write_stl(out / "membrane.stl", [tuple(places[i][k] for i, k in face) for face in faces], "membrane")
    (out / "membrane.data").write_text(data(a, places, faces))
    plate = circle(a.radius + a.beyond, 48)
    write_stl(out / "bottom.stl", disc(plate, 0.0), "bottom")
    write_stl(out / "top.stl", disc(plate, a.height), "top")


if __name__ == "__main__":
    main()
