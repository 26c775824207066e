# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""What examples/vessel/section.py draws is what LAMMPS draws of the same grains and wall."""

import subprocess
import sys

from PIL import Image

import lmp
from facts import at_most, fact

VESSEL = lmp.HERE.parent.parent / "examples" / "vessel"


# The same picture by LAMMPS: the view, and the colours of section.py.
IMAGE = """write_dump all image host.ppm type diameter &
view 78 -90 zoom 1.85 size 620 1000 box no 0 center s 0.5 0.5 0.5 fix wall type 0 0.0002 &
modify thresh y > 0 backcolor white acolor 1 silver color c2 0.267 0.004 0.329 color c3 0.255 0.267 0.529 &
color c4 0.165 0.471 0.557 color c5 0.133 0.659 0.518 color c6 0.478 0.820 0.318 color c7 0.992 0.906 0.145 &
acolor 2 c2 acolor 3 c3 acolor 4 c4 acolor 5 c5 acolor 6 c6 acolor 7 c7
"""
HUES = {"purple": 288, "indigo": 237, "blue": 193, "teal": 164, "green": 101, "yellow": 54}


def hue(r, g, b):
    """What is seen: the background, grey of the wall, or the colour of a layer of grains."""
    most, least = max(r, g, b), min(r, g, b)
    if least > 245:
        return "white"
    if most - least < 0.12 * most + 8:
        return "grey"
    angle = ((g - b) if most == r else 2 * most - 2 * least + (b - r) if most == g else
             4 * (most - least) + (r - g)) / (most - least) * 60 % 360
    return min(HUES, key=lambda name: min((angle - HUES[name]) % 360, (HUES[name] - angle) % 360))


def test_picture(folder):
    # The vessel a fifth full, once for LAMMPS and once for the script.
    text = (VESSEL / "in.vessel").read_text()
    small = {"dir": VESSEL, "fill": 1500, "quiet": 1, "measure": 1, "drain": 100, "frame": 50}
    drawn = "mesh ${dir}/vessel.stl scale 0.001"
    lmp.run_well(text.replace(drawn, drawn + " draw faces 1 cut 0 -1 0 0") + IMAGE, folder, **small)
    done = subprocess.run([sys.executable, VESSEL / "section.py", "section.dump", VESSEL / "vessel.stl",
                           "vessel.png", "--movie", "vessel.gif"], cwd=folder)
    fact("section.py draws", done.returncode == 0)
    with Image.open(folder / "vessel.gif") as movie:
        fact("a frame when the outlet opens, and every 50 steps", movie.n_frames == 3, str(movie.n_frames))

    host = Image.open(folder / "host.ppm")
    own = Image.open(folder / "vessel.png").convert("RGB")
    fact("same height", host.height == own.height and host.width < own.width, f"{host.size} and {own.size}")
    width = 560    # the key begins there
    host, own = (picture.crop((0, 0, width, picture.height)).tobytes() for picture in (host, own))
    counts = {}
    for k in range(0, len(host), 3):
        pair = hue(*host[k:k + 3]), hue(*own[k:k + 3])
        counts[pair] = counts.get(pair, 0) + 1
    total = sum(counts.values())
    # LAMMPS leaves pixels between its triangles white, and its light is another.
    apart = sum(n for (a, b), n in counts.items() if (a == "white") != (b == "white")) / total
    at_most("background and the rest", apart, 0.03)
    for colour in ("white", "grey", *HUES):
        there = sum(n for (a, _), n in counts.items() if a == colour)
        same = counts.get((colour, colour), 0)
        fact(f"{colour} where LAMMPS has it", there and same > 0.85 * there, f"{same} of {there} pixels")
