#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run examples and put their pictures into doc/img/gallery: gallery.py [NAME ...]

Each picture is that of the example's input script at half its size, for smooth edges, without its white margin, in
64 colours.
"""
from pathlib import Path

from PIL import Image, ImageChops

import runs

NAMES = ("drum", "hopper", "screw", "screen", "mixer", "piston", "insertion", "belt", "clumps", "flap",
         "paddle")
TUTORIALS = ("meshGran", "movingMeshGran", "servoWall", "conveyor")    # of from-liggghts
MARGIN = 12    # pixels


def main():
    p = runs.options(__doc__, Path("gallery"))
    p.add_argument("names", nargs="*", help=" ".join(NAMES + TUTORIALS))
    a = p.parse_args()
    a.work.mkdir(parents=True, exist_ok=True)
    folder = runs.ROOT / "doc" / "img" / "gallery"
    for name in a.names or NAMES + TUTORIALS:
        example = runs.ROOT / "examples" / ("from-liggghts" if name in TUTORIALS else name)
        if name in TUTORIALS:
            runs.make_meshes(example / "make_meshes.py", a.work)
        runs.run_script(a, example / f"in.{name}", dir=example, picture=f"{name}.png")
        picture = Image.open(a.work / f"{name}.png").convert("RGB").reduce(2)
        left, top, right, bottom = ImageChops.difference(picture, Image.new("RGB", picture.size, "white")).getbbox()
        picture.crop((max(0, left - MARGIN), max(0, top - MARGIN), min(picture.width, right + MARGIN),
                      min(picture.height, bottom + MARGIN))).quantize(
            64, dither=Image.Dither.NONE).save(folder / f"{name}.png", optimize=True)
        print(folder / f"{name}.png")


if __name__ == "__main__":
    main()
