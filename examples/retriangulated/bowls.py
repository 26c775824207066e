#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Draw the bowl cut two ways as a film, bowl.gif: with fix wall/lsdcd on the left, with LIGGGHTS on the right.

Blue grains roll on bowl.stl, orange ones on recut.stl, drawn behind the blue ones: orange is seen where the two runs differ.
"""
import sys
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import compare                                           # noqa: E402
from look import BLUE, EDGE, INK, ORANGE, STEEL, View, below, font, rgb    # noqa: E402
from lsdcd import film                                   # noqa: E402
from make_walls import DIAMETER, bowl                    # noqa: E402
from runs import make_meshes, options                    # noqa: E402

FINER = 3        # a pixel is the mean of so many by so many
BEHIND = 1e-4    # m: how far orange grains stand back
TEXT, TITLE = 15, 22    # pixels: height of words, and of the line above a picture
STEP = 5e-4      # s, of the scripts
EVERY = 3        # frames of the dump that one of the film stands for


def empty_bowl(view):
    """Returns the bowl alone, drawn."""
    shell = film.Shell(view)
    corners = np.array(bowl(), float)
    shell.draw(corners, np.tile(255 * np.array(rgb(STEEL)), (len(corners), 1)))
    return shell


def panel(shell, one, other, words, time):
    """Draws a program's grains at one time, in both bowls."""
    view, grains = shell.eye, film.Layer(shell.eye)
    sizes = np.full(len(one), DIAMETER / 2)
    for places, colour in ((one, BLUE), (other - BEHIND * view.back, ORANGE)):
        grains.spheres(places, sizes, np.tile(255 * np.array(rgb(colour)), (len(places), 1)))
    farthest = np.linalg.norm(one - other, axis=1).max() / DIAMETER
    key = f"farthest: {farthest:{'.2f' if farthest > 0.005 or farthest == 0 else '.0e'}} diameters"
    picture = below(film.composed(grains, shell, solid=True), view.scale / FINER, (1, "1 m"), time, key, TEXT)
    titled = Image.new("RGB", (picture.width, picture.height + TITLE), "white")
    titled.paste(picture, (0, TITLE))
    ImageDraw.Draw(titled).text((EDGE, 2), words, INK, font(TEXT))
    return titled


def main():
    p = options(__doc__, HERE)
    p.add_argument("--width", type=int, default=236, help="of each half, pixels")
    p.add_argument("--bytes", type=int, default=690000, help="that the film may have")
    a = p.parse_args()
    make_meshes(HERE / "make_walls.py", a.work, "--rain", 1)
    runs = {name: [compare.places(a, name, wall) for wall in ("bowl", "recut")] for name in compare.SCRIPTS}
    shell = empty_bowl(View((28, -60), (-3.6, 3.6, -3.6, 3.6, 0, 1.6), a.width, FINER))
    frames = []
    steps = runs["fix wall/lsdcd"][0][0]
    for k in range(0, len(steps), EVERY):
        halves = [panel(shell, one[1][k], other[1][k], name, f"t = {steps[k] * STEP:.2f} s") for name, (one, other) in runs.items()]
        whole = Image.new("RGB", (sum(half.width for half in halves) + 8, halves[0].height), "white")
        whole.paste(halves[0], (0, 0))
        whole.paste(halves[1], (halves[0].width + 8, 0))
        frames.append(whole)
    grains = [one.crop((one.width // 2, one.height // 4, one.width, one.height // 2 + 60)) for one in frames[::6]]    # with orange ones
    film.write_film(frames, a.work / "bowl.gif", 100, a.bytes, grains)


if __name__ == "__main__":
    main()
