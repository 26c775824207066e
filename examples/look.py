# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What all pictures of examples share: colours, where a point of the scene is seen, and the scale bar, the time and the
colour key below. Needs numpy, PIL and LSDCD's shared library, of the folder build or installed."""
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(1, str(ROOT / "src" / "api"))
for library in (ROOT / "build" / "lib" / "liblsdcd.so.0", ROOT / "build-kokkos" / "lib" / "liblsdcd.so.0"):
    if library.exists():
        os.environ.setdefault("LSDCD_LIBRARY", str(library))
import numpy as np    # noqa: E402
from PIL import Image, ImageDraw, ImageFont    # noqa: E402

from lsdcd.film import VIRIDIS, Eye, ramp    # noqa: E402

FONT = "DejaVuSans.ttf"
TEXT = 27     # pixels: read at half of a width of 640
INK = (30, 30, 30)
MARGIN = 12    # pixels
EDGE = 10    # pixels that bar, key and time stay clear of the left and right edge

# Okabe and Ito: told apart by every kind of colour vision.
ORANGE, BLUE, SKY, GREEN, YELLOW, VERMILION = ("#E69F00", "#0072B2", "#56B4E9", "#009E73", "#F0E442", "#D55E00")
STEEL, DARK = "#B8BDC4", "#50555C"


def font(pixels):
    try:
        return ImageFont.truetype(FONT, pixels)
    except OSError:    # not installed; Matplotlib brings it
        import matplotlib
        return ImageFont.truetype(str(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / FONT), pixels)


def rgb(colour):
    return tuple(int(colour[k:k + 2], 16) / 255 for k in (1, 3, 5))


def viridis(share):
    """Colours of numbers from 0 to 1, which are cut off beyond."""
    return ramp(VIRIDIS, np.asarray(share, float)) / 255


class View(Eye):
    """Looks along a direction as `view` of dump image has it, without perspective, at a box of the scene."""

    def __init__(self, view, box, width, finer=1):
        low, high = np.reshape(box, (3, 2)).T.astype(float)
        super().__init__((view[1], 90 - view[0]), low, high, width, finer=finer)
        self.far = np.linalg.norm(high - low)

    def pixel(self, point):
        right, down, _ = self.place(np.asarray(point, float))
        return right, down


def arrow(picture, camera, points, colour=INK):
    """A line through points of the scene, with a head at its end."""
    way = [camera.pixel(p) for p in points]
    draw = ImageDraw.Draw(picture)
    draw.line(way, fill=colour, width=5, joint="curve")
    tip, before = np.array(way[-1]), np.array(way[-2])
    along = (tip - before) / np.linalg.norm(tip - before)
    side = np.array([-along[1], along[0]])
    draw.polygon([tuple(tip + 14 * along), tuple(tip - 8 * along + 11 * side), tuple(tip - 8 * along - 11 * side)], fill=colour)


def below(picture, scale, bar, time, key, text=TEXT):
    """The picture with its scale bar (length, words), the time and the key: words alone, pairs of a colour and words, or
    (words, least, most) of a range of viridis. `text` is the height of the words in pixels."""
    f, k = font(text), text / TEXT
    high, width, margin, edge = text + round(14 * k), picture.width, round(MARGIN * k), round(EDGE * k)
    pieces = []    # of the key: width, draw at x, y
    if isinstance(key, str):
        pieces.append((f.getlength(key), lambda d, x, y, words=key: d.text((x, y), words, INK, f)))
    elif isinstance(key, tuple):
        words, least, most = key
        low, up = f"{least:g}", f"{most:g} {words}"

        def ramp(d, x, y):
            d.text((x, y), low, INK, f)
            x += f.getlength(low) + 10 * k
            wide = round(140 * k)
            for i in range(wide):
                d.line((x + i, y + 4 * k, x + i, y + text), fill=tuple(int(round(255 * c)) for c in viridis(i / (wide - 1))))
            d.text((x + 150 * k, y), up, INK, f)
        pieces.append((f.getlength(low) + 160 * k + f.getlength(up), ramp))
    else:
        for colour, words in key or ():
            def dot(d, x, y, colour=colour, words=words):
                d.ellipse((x, y + 4 * k, x + 24 * k, y + 28 * k), fill=colour)
                d.text((x + 32 * k, y), words, INK, f)
            pieces.append((32 * k + f.getlength(words) if words else 12 * k, dot))
    lines, x = [[]], 0    # as many pieces a line as it has room for
    for wide, paint in pieces:
        if x and x + wide > width - 2 * edge:
            lines.append([])
            x = 0
        lines[-1].append((x, paint))
        x += wide + 24 * k
    whole = Image.new("RGB", (width, picture.height + margin + high * (1 + (len(lines) if pieces else 0))), "white")
    whole.paste(picture, (0, 0))
    draw, y = ImageDraw.Draw(whole), picture.height + margin
    length = bar[0] * scale
    draw.line((edge, y + 16 * k, edge + length, y + 16 * k), fill=INK, width=max(1, round(5 * k)))
    for x in (edge, edge + length):
        draw.line((x, y + 6 * k, x, y + 26 * k), fill=INK, width=max(1, round(3 * k)))
    draw.text((edge + length + 14 * k, y), bar[1], INK, f)
    if time:
        draw.text((width - f.getlength(time) - edge, y), time, INK, f)
    if time and length + 14 * k + f.getlength(bar[1]) + 20 * k > width - 2 * edge - f.getlength(time):
        raise SystemExit(f"'{bar[1]}' and '{time}' do not fit beside each other")
    for line in lines if pieces else ():
        y += high
        for x, paint in line:
            paint(draw, edge + x, y)
    return whole
