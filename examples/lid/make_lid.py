#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write box.stl, a floor with two walls along y, and lid.stl, a closed plate that fits between these walls.

Both reach through the period of the script's box along y. The lid's lower face is at z = 0.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import box, extruded, options, write_stl    # noqa: E402


def main():
    p = options(__doc__)
    p.add_argument("--width", type=float, default=12, help="between the walls")
    p.add_argument("--height", type=float, default=16, help="of the walls")
    p.add_argument("--length", type=float, default=6, help="along y")
    p.add_argument("--gap", type=float, default=0.1, help="between lid and walls")
    p.add_argument("--thickness", type=float, default=1, help="of the lid")
    a = p.parse_args()
    half = a.width / 2
    line = [(half, a.height), (half, 0), (-half, 0), (-half, a.height)]
    out = Path(a.out)
    write_stl(out / "box.stl", extruded(line, 0, a.length), "box")
    lid = box((-half + a.gap, a.gap / 2, 0), (half - a.gap, a.length - a.gap / 2, a.thickness))
    write_stl(out / "lid.stl", lid, "lid")


if __name__ == "__main__":
    main()
