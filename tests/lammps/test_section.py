# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""examples/vessel/section.py draws a picture and a movie of what the example dumps."""

import subprocess
import sys

from PIL import Image

import lmp
from facts import fact

VESSEL = lmp.HERE.parent.parent / "examples" / "vessel"

def test_picture(folder):
    # The vessel a fifth full.
    small = {"dir": VESSEL, "fill": 1500, "quiet": 1, "measure": 1, "drain": 100, "frame": 50}
    lmp.run_well((VESSEL / "in.vessel").read_text(), folder, **small)
    done = subprocess.run([sys.executable, VESSEL / "section.py", "section.dump", VESSEL / "vessel.stl",
                           "vessel.png", "--movie", "vessel.gif"], cwd=folder)
    fact("section.py draws", done.returncode == 0)
    with Image.open(folder / "vessel.gif") as movie:
        fact("a frame when the outlet opens, and every 50 steps", movie.n_frames == 3, str(movie.n_frames))
    with Image.open(folder / "vessel.png") as picture:
        fact("and layers of six colours, the wall and the background", len(picture.convert("RGB").getcolors(picture.width * picture.height)) > 8)
