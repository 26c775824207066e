#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Write plate.stl, a round plate with a rim, and tube.stl, a tube that stands on it."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from stl import circle, disc, options, side, write_stl    # noqa: E402


def main():
    p = options(__doc__)
    p.add_argument("--plate", type=float, default=14, help="radius")
    p.add_argument("--tube", type=float, default=4.5, help="radius")
    p.add_argument("--height", type=float, default=20, help="of the tube")
    a = p.parse_args()
    out = Path(a.out)
    rim = circle(a.plate, 48)
    write_stl(out / "plate.stl", disc(rim[::-1], 0) + side(rim, 0, 1), "plate")
    write_stl(out / "tube.stl", side(circle(a.tube, 48), 0, a.height), "tube")


if __name__ == "__main__":
    main()
