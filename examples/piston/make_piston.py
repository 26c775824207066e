#!/usr/bin/env python3
"""Write die.stl, a round cup open at the top, and piston.stl, a short cylinder that fits into it.

The floor of the cup is at z = 0, and so is the face of the piston: the deck moves it up.
"""
import argparse
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import write_stl    # noqa: E402


def disc(ring, z):
    return [((0, 0, z), (*a, z), (*b, z)) for a, b in zip(ring, ring[1:] + ring[:1])]


def side(ring, lo, hi):
    triangles = []
    for a, b in zip(ring, ring[1:] + ring[:1]):
        triangles += [((*a, lo), (*b, lo), (*b, hi)), ((*a, lo), (*b, hi), (*a, hi))]
    return triangles


def main():
    p = argparse.ArgumentParser(description=__doc__,
                                formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    p.add_argument("--radius", type=float, default=7)
    p.add_argument("--height", type=float, default=14)
    p.add_argument("--gap", type=float, default=0.1, help="between piston and cup")
    p.add_argument("--segments", type=int, default=64, help="round the cup")
    p.add_argument("--out", default=".", help="folder")
    a = p.parse_args()

    def ring(radius):
        turns = [2 * math.pi * k / a.segments for k in range(a.segments)]
        return [(radius * math.cos(t), radius * math.sin(t)) for t in turns]

    cup, rod = ring(a.radius), ring(a.radius - a.gap)
    write_stl(Path(a.out) / "die.stl", disc(cup, 0) + side(cup, 0, a.height), "die")
    write_stl(Path(a.out) / "piston.stl", disc(rod, 0) + side(rod, 0, 1) + disc(rod, 1), "piston")


if __name__ == "__main__":
    main()
