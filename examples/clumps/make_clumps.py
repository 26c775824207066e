#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write plate.stl, a round plate with a rim, tube.stl, a tube that stands on it, and clump1.mol to clump4.mol,
clumps of one to four spheres of diameter 1."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import circle, disc, options, side, write_stl    # noqa: E402


def clumps(apart):
    """Places of spheres that are so far apart, each clump about its centre."""
    h, s = apart / 2, apart / 8**0.5
    return [[(0, 0, 0)],
            [(-h, 0, 0), (h, 0, 0)],
            [(-h, -h / 3**0.5, 0), (h, -h / 3**0.5, 0), (0, 2 * h / 3**0.5, 0)],
            [(s, s, s), (s, -s, -s), (-s, s, -s), (-s, -s, s)]]


def write_molecule(path, places):
    """A LAMMPS molecule file."""
    with open(path, "w", encoding="ascii") as out:
        # REUSE-IgnoreStart
        out.write("# SPDX-FileCopyrightText: 2026 LSDCD contributors\n# SPDX-License-Identifier: BSD-3-Clause\n\n")
        # REUSE-IgnoreEnd
        out.write(f"{len(places)} atoms\n")
        for title, rows in (("Coords", ["%.12g %.12g %.12g" % p for p in places]), ("Types", ["1"] * len(places)),
                            ("Diameters", ["1"] * len(places))):
            out.write(f"\n{title}\n\n" + "".join(f"{i} {row}\n" for i, row in enumerate(rows, 1)))
    print(f"{path}: {len(places)} spheres")


def main():
    p = options(__doc__)
    p.add_argument("--plate", type=float, default=14, help="radius")
    p.add_argument("--tube", type=float, default=4.5, help="radius")
    p.add_argument("--height", type=float, default=26, help="of the tube")
    p.add_argument("--apart", type=float, default=0.7, help="centres of a clump's spheres")
    a = p.parse_args()
    out = Path(a.out)
    rim = circle(a.plate, 48)
    write_stl(out / "plate.stl", disc(rim[::-1], 0) + side(rim, 0, 1), "plate")
    write_stl(out / "tube.stl", side(circle(a.tube, 48), 0, a.height), "tube")
    for places in clumps(a.apart):
        write_molecule(out / f"clump{len(places)}.mol", places)


if __name__ == "__main__":
    main()
