# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""No command of lsdcd writes over a file that it reads, under whatever name, over another that it writes,
or to a name that says another format."""
import os

from command import refused, run
from facts import fact

QUICK = " --spheres 100 --moving 2 --repeats 1 --seconds 1 --device cpu"    # should one go on
READS = [    # what is read, words that would write over it
    ("wall.stl", "tradeoff wall.stl --radius 0.1 --plot link.png" + QUICK),
    ("wall.stl", "repair wall.stl -o ./wall.stl"),
    ("wall.stl", "convert wall.stl --units mm -o wall.stl"),
    ("points.csv", "distance wall.stl points.csv --radius 0.1 -o points.csv"),
    ("points.csv", "distance wall.stl points.csv --radius 0.1 -o link.csv"),
    ("poses.csv", "collide wall.stl body.stl --poses poses.csv -o folder/../poses.csv"),
    ("poses.csv", "collide wall.stl body.stl --poses poses.csv --segments poses.csv"),
]
TWICE = ["collide wall.stl body.stl -o a.csv --segments ./a.csv"]
ENDINGS = [    # words, what is said
    ("tradeoff wall.stl --radius 0.1 --csv t.stl" + QUICK, "--csv t.stl: end the name in .csv"),
    ("tradeoff wall.stl --radius 0.1 --plot t.pdf" + QUICK, "--plot t.pdf: end the name in .png"),
    ("accuracy --spheres 1000 --csv a.txt", "--csv a.txt: end the name in .csv"),
    ("generate box --width 1 --depth 1 --height 1 -o x.txt", "--output x.txt: end the name in .stl"),
]


def test_outputs(folder):
    (folder / "folder").mkdir()
    for name in ("wall.stl", "body.stl"):
        run(folder, *"generate box --width 1 --depth 1 --height 1 -o".split(), name)
    for name in ("points.csv", "poses.csv"):
        (folder / name).write_text("0,0,0\n")
    (folder / "link.csv").symlink_to("points.csv")
    os.link(folder / "wall.stl", folder / "link.png")
    for name, words in READS:
        before = (folder / name).read_bytes()
        refused(folder, words.split(), "would replace " + name, "give another name")
        fact(f"and {name} is as it was", (folder / name).read_bytes() == before)
    for words in TWICE:
        refused(folder, words.split(), "the same file")
    for words, said in ENDINGS:
        refused(folder, words.split(), said)
