# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""lsdcd collide against closed forms: a cube through a floor of squares, counted by hand, and blades that
each cut one triangle; what files hold; and what is refused."""
import math
import re

import numpy as np

import stl
import vtp
from command import refused, run, told
from facts import fact


def floor(n, half):
    """Squares of [-half, half]^2 at z = 0, two triangles each, below and above the diagonal x = y."""
    at = np.linspace(-half, half, n + 1)
    return stl.sheet(n, lambda i, j: (at[i], at[j], 0))


def read_pairs(path):
    rows = [line.split(",") for line in path.read_text().splitlines()]
    return rows[0], np.array(rows[1:], dtype=float).reshape(len(rows) - 1, len(rows[0]))


def read_vtp(path):
    return {name: np.array(numbers) for name, numbers in vtp.read(path).items()}


def test_cube(folder):
    """In the middle of a triangle of a floor of two the cube's four upright sides have 2 triangles each."""
    stl.write(folder / "floor.stl", floor(1, 4))
    stl.write(folder / "cube.stl", stl.box((-0.5,) * 3, (0.5,) * 3))    # sides in x, y, then z, two triangles each
    words = "collide", "floor.stl", "cube.stl"
    middle = "2", "-2"
    for device in ("auto", "cpu"):
        said = told(folder, *words, "--pose", *middle, "0.25", "--device", device)
        fact(f"the cube's upright sides meet the floor, device {device}",
             said["pairs"] == 8 and said["pairs_of_pose"] == [8] and said["colliding"] == 1
             and said["triangles"] == 12 and said["exact"], said)
    above = told(folder, *words, "--pose", *middle, "0.75")
    fact("above it nothing does", above["pairs"] == above["colliding"] == 0)
    fact("standing on it is touching", told(folder, *words, "--pose", *middle, "0.5")["pairs"] == 10)
    fact("without a pose the body is as it is", told(folder, *words)["pairs"] > 8)
    half = math.sqrt(0.5)
    upright = told(folder, *words, "--pose", *middle, "0.25", half, half, 0, 0, "-o", "turned.csv")
    _, rows = read_pairs(folder / "turned.csv")
    # About x by 90 degrees y goes to z: sides in x and z are upright.
    fact("a quaternion turns the body", upright["pairs"] == 8 and
         rows[:, 2].tolist() == [0, 1, 2, 3, 8, 9, 10, 11], rows.tolist())
    told(folder, *words, "--pose", 1, 0, 0, 2, 0, 0, -1, -2, 0, 1, 0, 0.25, "-o", "matrix.csv")
    fact("and so does a matrix", (folder / "matrix.csv").read_text() == (folder / "turned.csv").read_text())
    done = run(folder, *words, "--pose", *middle, "0.25")
    fact("people are told yes", done.returncode == 0 and "collides    yes" in done.stdout, done.stdout)
    done = run(folder, *words, "--pose", *middle, "0.75")
    fact("and no, which is no error", done.returncode == 0 and "collides    no" in done.stdout, done.stdout)
    scaled = told(folder, *words, "--pose", *middle, "0.75", "--body-scale", 2)
    fact("the body's scale is of the body", scaled["pairs"] == 8, scaled)
    placed = told(folder, *words, "--pose", *middle, "0.75", "--body-matrix", 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0)
    fact("and so is its matrix", placed["pairs"] == 8, placed)
    near = told(folder, *words, "--nearest", 1, "--grid", 1)
    fact("nearest lists say that they may miss pairs", not near["exact"] and near["uncertain_pieces"] > 0, near)


def test_many(folder):
    """A small blade through the middle of each triangle; it sinks in ten poses, and comes out below."""
    triangles = np.roll(floor(12, 3), 2, axis=2)    # across y
    stl.write(folder / "squares.stl", triangles)
    a, along, up = 0.01, np.array((0.8, 0, 0.6)), np.array((0, 1, 0))
    middle = np.mean(triangles, axis=1)
    blades = [[m - a * along - a * up, m + a * along - a * up, m + a * up] for m in middle]
    stl.write(folder / "blades.stl", blades[::-1])
    heights = np.linspace(0.05, -0.05, 10)
    (folder / "path.txt").write_text("x,y,z,qw,qx,qy,qz\n# sinks\n\n" + "".join(f"0,{y!r},0,1,0,0,0\n" for y in heights.tolist()))
    said = told(folder, "collide", "squares.stl", "blades.stl", "--poses", "path.txt", "-o", "pairs.csv",
                "--segments", "cuts.csv", "--threads", 2)
    # In: the lower edge is below 0 and the tip above.
    inside = [k for k, y in enumerate(heights) if y - a <= 0 <= y + a]
    n = len(triangles)
    fact("each pose has the pairs of its height", len(inside) > 1 and
         said["pairs_of_pose"] == [n if k in inside else 0 for k in range(10)], said["pairs_of_pose"])
    head, rows = read_pairs(folder / "pairs.csv")
    expected = [(k, n - 1 - t, t) for k in inside for t in range(n)]
    fact("pairs are each blade and its triangle, by pose", head == ["pose", "wall_triangle", "body_triangle"]
         and rows.tolist() == [list(map(float, e)) for e in expected])
    head, cuts = read_pairs(folder / "cuts.csv")
    fact("segments have the same pairs first", len(head) == 9 and np.array_equal(cuts[:, :3], rows))
    # At height y a blade is 1 - (a - z) / 2 a from its tip: so wide. Coordinates are below 4.
    width = np.array([2 * a * (a + heights[int(k)]) / (2 * a) for k in cuts[:, 0]])
    rounding = 64 * 4 * 2.3e-16
    across = cuts[:, 6:] - cuts[:, 3:6]
    fact("and are as wide as the blade there", np.abs(np.abs(across @ along) - width).max() < rounding
         and np.abs(across - np.outer(across @ along, along)).max() < rounding
         and np.abs((cuts[:, 3:6] + cuts[:, 6:]) / 2 - middle[cuts[:, 1].astype(int)]).max() < rounding)
    told(folder, "collide", "squares.stl", "blades.stl", "--poses", "path.txt", "--segments", "cuts.vtp",
         "--threads", 1)
    arrays = read_vtp(folder / "cuts.vtp")
    fact("lines for ParaView are these segments", np.array_equal(arrays["points"], cuts[:, 3:].ravel())
         and np.array_equal(arrays["pose"], cuts[:, 0]) and np.array_equal(arrays["wall_triangle"], cuts[:, 1])
         and np.array_equal(arrays["body_triangle"], cuts[:, 2])
         and np.array_equal(arrays["connectivity"], np.arange(2 * len(cuts)))
         and np.array_equal(arrays["offsets"], 2 * np.arange(1, len(cuts) + 1)), arrays)
    done = run(folder, "collide", "squares.stl", "blades.stl", "--poses", "path.txt", "--progress")
    fact("people get a summary, and progress", f"in {len(inside)} of 10 poses, first in pose {inside[0]}" in done.stdout
         and re.search(r" poses?, ", done.stderr), done.stdout + done.stderr)
    # In one plane there is no segment.
    told(folder, "collide", "squares.stl", "squares.stl", "--segments", "flat.csv")
    told(folder, "collide", "squares.stl", "squares.stl", "--segments", "flat.vtp")
    _, flat = read_pairs(folder / "flat.csv")
    fact("pairs in one plane have no segment", len(flat) > n and np.isnan(flat[:, 3:]).all()
         and len(read_vtp(folder / "flat.vtp")["points"]) == 0)


def test_refused(folder):
    words = ("collide", "floor.stl", "cube.stl")
    refused(folder, [*words, "--pose", 1, 2, 3, 4], "has 4 numbers", "x y z qw qx qy qz", code=2)
    refused(folder, [*words, "--pose", 0, 0, 0, 1, 1, 0, 0], "length 1.41", "unit", code=2)
    refused(folder, [*words, "--pose", 0, 0, "1e20"], "pose 0", "rounding errors")
    refused(folder, [*words, "--pose", *[2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]], "not a rotation", code=2)
    refused(folder, [*words, "--pose", 0, 0, "here"], "--pose", "here", code=2)
    refused(folder, [*words, "--pose", 0, 0, 0, "--poses", "path.txt"], "excludes", code=2)
    refused(folder, [*words, "--device", "tpu"], "--device", code=2)
    refused(folder, [*words, "--nearest", 0], "--nearest", code=2)
    refused(folder, ["collide", "floor.stl", "nowhere.stl"], "nowhere.stl")
    refused(folder, [*words, "--poses", "nowhere.txt"], "nowhere.txt")
    refused(folder, [*words, "-o", "pairs.txt"], "pairs.txt", ".csv")
    refused(folder, [*words, "--segments", "cuts.stl"], "cuts.stl", ".vtp")
    refused(folder, [*words, "-o", "a.csv", "--segments", "a.csv"], "the same file")
    refused(folder, [*words, "-o", "no/such/folder.csv"], "no/such/folder.csv")
    refused(folder, [*words, "--grid", "1e-6"], "cell")
    bad = folder / "bad.txt"
    for text, says in (("0 0 0\n0 0\n", ("line 2", "has 2 numbers")), ("x y z\n1 2 oops\n", ("line 2", "'oops'")),
                       ("", ("no pose",)), ("# none\n", ("no pose",)), ("0 0 nan\n", ("line 1", "not finite")),
                       ("0 0 0\n0 0 1e20\n", ("pose 1", "rounding errors")),
                       ("0,,0,0\n", ("line 1", "nothing in column 2")), ("0,1;0,2;0,3\n", ("line 1", "decimal commas")),
                       ("z y x\n0 0 0\n", ("line 1", "with x in column 3")), ("# id x y z\n1 0 0 0\n", ("line 2", "with x in column 2")),
                       ("x y z qx qy qz qw\n0 0 0 0 0 0 1\n", ("line 1", "'qw' in column 7", "x y z qw qx qy qz")),
                       ("x y z\n0 0 0 1 0 0 0\n", ("line 2", "has 7 columns", "line 1 names 3"))):
        bad.write_text(text)
        refused(folder, [*words, "--poses", "bad.txt", "-o", "left.csv"], *says)
