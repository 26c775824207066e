#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Draw the section that in.vessel ends with.

    section.py section.dump vessel.stl vessel.png                  # the last frame
    section.py section.dump vessel.stl vessel.png --at 0.2 --movie vessel.gif

Every pixel keeps what is nearest to the viewer, so that no seam shows between triangles.
"""
import argparse
import math
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

WIDTH, HEIGHT, PIXEL = 620, 1000, 2.925e-4  # of the section: pixels, metres
PANEL = 270                                 # pixels of the key beside it
CENTRE = (0.0, 0.0, 0.055)                  # of the box in in.vessel
TILT = math.radians(78)                     # `view 78 -90`: from in front and a little above
LIGHT = np.array([-0.5, 0.5, 1.0]) / math.sqrt(1.5)    # right, up, towards the viewer
WALL = np.array((192, 192, 192))
LAYER = 30                                  # mm, of a type in in.vessel
# viridis, in six steps: ordered for every kind of colour vision, and in grey.
GRAINS = {2: (68, 1, 84), 3: (65, 68, 135), 4: (42, 120, 142),
          5: (34, 168, 132), 6: (122, 209, 81), 7: (253, 231, 37)}
TEXT = (30, 30, 30)


def on_screen(points):
    """Pixels to the right and down, and metres towards the viewer, of points[..., 3]."""
    x, y, z = np.moveaxis(points - np.array(CENTRE), -1, 0)
    up, near = y * math.cos(TILT) + z * math.sin(TILT), z * math.cos(TILT) - y * math.sin(TILT)
    return np.stack([WIDTH / 2 + x / PIXEL, HEIGHT / 2 - up / PIXEL, near], axis=-1)


class Canvas:
    """The nearest surface and the colour of each pixel."""

    def __init__(self, other=None):
        self.nearest = other.nearest.copy() if other else np.full((HEIGHT, WIDTH), -np.inf)
        self.colour = other.colour.copy() if other else np.full((HEIGHT, WIDTH, 3), 255, np.uint8)

    def paint(self, rows, columns, inside, depth, colour, share):
        """A window of pixels, where `inside` and unless something nearer is there."""
        seen = inside & (depth > self.nearest[rows, columns])
        self.nearest[rows, columns][seen] = depth[seen]
        shade = (np.asarray(colour) * np.broadcast_to(share, seen.shape)[..., None])
        self.colour[rows, columns][seen] = shade[seen]

    def draw_sphere(self, at, radius, colour):
        size = radius / PIXEL
        rows, columns, y, x = window(at[1] - size, at[1] + size, at[0] - size, at[0] + size)
        right, up = (x - at[0]) / size, (at[1] - y) / size
        out = 1 - right * right - up * up
        inside, out = out >= 0, np.sqrt(np.maximum(0, out))
        lit = right * LIGHT[0] + up * LIGHT[1] + out * LIGHT[2]
        self.paint(rows, columns, inside, at[2] + radius * out, colour, shade_of(lit))

    def draw_triangle(self, corners, colour):
        a, u, v = corners[0], corners[1] - corners[0], corners[2] - corners[0]
        twice = u[0] * v[1] - u[1] * v[0]
        if twice == 0:    # seen from its edge
            return
        slope = (u[2] * v[1] - u[1] * v[2]) / twice, (u[0] * v[2] - u[2] * v[0]) / twice
        normal = np.array((-slope[0] / PIXEL, slope[1] / PIXEL, 1.0))
        lo, hi = corners.min(axis=0), corners.max(axis=0)
        rows, columns, y, x = window(lo[1], hi[1], lo[0], hi[0])
        x, y = x - a[0], y - a[1]
        # Barycentric; a little is added, so that rounding leaves no seam.
        s, t = (x * v[1] - y * v[0]) / twice, (y * u[0] - x * u[1]) / twice
        inside = (s >= -1e-9) & (t >= -1e-9) & (s + t <= 1 + 1e-9)
        lit = abs(normal @ LIGHT) / np.linalg.norm(normal)
        self.paint(rows, columns, inside, a[2] + x * slope[0] + y * slope[1], colour, shade_of(lit))


def shade_of(lit):
    return 0.25 + 0.75 * np.maximum(0.0, lit)


def window(top, bottom, left, right):
    """Slices of rows and columns, and the places of these."""
    rows = slice(max(0, math.ceil(top)), max(0, min(HEIGHT, math.floor(bottom) + 1)))
    columns = slice(max(0, math.ceil(left)), max(0, min(WIDTH, math.floor(right) + 1)))
    return rows, columns, np.arange(rows.start, rows.stop)[:, None], np.arange(columns.start, columns.stop)[None]


def read_stl(path, scale):
    kind = np.dtype([("normal", "<3f4"), ("corners", "<9f4"), ("more", "<u2")])
    return scale * np.frombuffer(path.read_bytes()[84:], kind)["corners"].astype(float).reshape(-1, 3, 3)


def read_frames(path):
    """Seconds since the first frame, and rows of type, x, y, z, radius of each."""
    first = None
    for text in path.read_text().split("ITEM: TIME\n")[1:]:
        time = float(text.split(None, 1)[0])
        first = time if first is None else first
        rows = text.split("ITEM: ATOMS")[1].split("ITEM:")[0].split("\n", 1)[1]
        yield time - first, np.array(rows.split(), float).reshape(-1, 6)[:, 1:]


def draw(wall, grains):
    canvas = Canvas(wall)
    for at, kind, radius in zip(on_screen(grains[:, 1:4]), grains[:, 0], grains[:, 4]):
        canvas.draw_sphere(at, radius, GRAINS[int(kind)])
    return canvas.colour


def with_key(section, seconds):
    """The section, and beside it the time, what colours mean, and a scale."""
    picture = Image.new("RGB", (WIDTH + PANEL, HEIGHT), "white")
    picture.paste(Image.fromarray(section))
    pen, left = ImageDraw.Draw(picture), WIDTH - 60
    large, font = (ImageFont.truetype("DejaVuSans.ttf", size) for size in (34, 26))
    pen.text((left, 60), f"t = {seconds:.2f} s", TEXT, large)
    pen.text((left, 104), "since the outlet opened", TEXT, font)
    pen.text((left, 500), "Grains by their height", TEXT, font)
    pen.text((left, 532), "before they fell, mm", TEXT, font)
    for k, kind in enumerate(sorted(GRAINS, reverse=True)):
        y, low = 580 + 40 * k, LAYER * (kind - 2)
        pen.rectangle((left, y, left + 50, y + 32), GRAINS[kind])
        pen.text((left + 66, y), f"{low} to {low + LAYER}", TEXT, font)
    bar, y = 0.05 / PIXEL, 900
    pen.line((left, y, left + bar, y), TEXT, 5)
    for x in (left, left + bar):
        pen.line((x, y - 10, x, y + 10), TEXT, 5)
    pen.text((left + bar / 2, y + 16), "50 mm", TEXT, font, anchor="ma")
    return picture


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("dump", type=Path)
    p.add_argument("mesh", type=Path)
    p.add_argument("png", type=Path)
    p.add_argument("--at", type=float, default=math.inf, help="seconds; the frame nearest to it is drawn")
    p.add_argument("--movie", type=Path, help="a GIF of all frames")
    a = p.parse_args()

    wall = Canvas()
    for corners in read_stl(a.mesh, 0.001):
        if corners[:, 1].sum() > 0:    # the half behind the section
            wall.draw_triangle(on_screen(corners), WALL)
    frames = list(read_frames(a.dump))
    seconds, grains = min(reversed(frames), key=lambda frame: abs(frame[0] - min(a.at, frames[-1][0])))
    picture = with_key(draw(wall, grains), seconds)
    picture.quantize(256, dither=Image.Dither.NONE).save(a.png, optimize=True)
    if a.movie:
        # One palette for all frames: what rests then has the same colours in each.
        palette = picture.quantize(256, dither=Image.Dither.NONE)
        half = (picture.width // 2, picture.height // 2)
        small = [with_key(draw(wall, g), t).resize(half, Image.Resampling.LANCZOS)
                 .quantize(palette=palette, dither=Image.Dither.NONE) for t, g in frames]
        small[0].save(a.movie, save_all=True, append_images=small[1:], loop=0, optimize=False,
                      duration=[100] * (len(small) - 1) + [1500])


if __name__ == "__main__":
    main()
