# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Films of runs, lsdcd.film: where grains and meshes are on the picture, colours, frames, and words that are refused."""
import math
import shutil
import subprocess
import sys

import numpy as np
import pytest

from facts import at_most, fact
from runs import TRIANGLE, dump_text, log_text, vtp_text, write_run

Image = pytest.importorskip("PIL.Image", reason="no Pillow (Debian: python3-pil)")
from lsdcd import film    # noqa: E402

BOX = np.array([[0.0, 0, 0], [1, 1, 1]])


def fresh(folder, name):
    shutil.rmtree(folder / name, ignore_errors=True)
    (folder / name).mkdir()
    return folder / name


def command(*words, cwd):
    return subprocess.run([sys.executable, "-m", "lsdcd.film", *map(str, words)], cwd=cwd, text=True, capture_output=True, check=False)


def frames_of(path):
    with Image.open(path) as image:
        found = []
        for k in range(getattr(image, "n_frames", 1)):
            image.seek(k)
            found.append(np.array(image.convert("RGB")).astype(int))
    return found


def is_coloured(pixels):
    return np.ptp(pixels, axis=2) > 20    # neither paper nor ink


@pytest.mark.parametrize("word, right, up", (
    ("front", (1, 0, 0), (0, 0, 1)), ("back", (-1, 0, 0), (0, 0, 1)), ("right", (0, 1, 0), (0, 0, 1)), ("left", (0, -1, 0), (0, 0, 1)),
    ("top", (1, 0, 0), (0, 1, 0)), ("bottom", (1, 0, 0), (0, -1, 0)), ("0,90", (0, 1, 0), (-1, 0, 0)),
    ("30,0", (-0.5, math.sqrt(0.75), 0), (0, 0, 1))))
def test_views(word, right, up):
    eye = film.Eye(film.view(word), *BOX, 200, 200)
    at_most("right", np.abs(eye.right - right).max(), 1e-12)
    at_most("up", np.abs(eye.up - up).max(), 1e-12)
    at_most("towards the eye", np.abs(eye.back - np.cross(right, up)).max(), 1e-12)


def one_grain(folder, name, **more):
    """A run of a grain of radius 0.1 in a corner of a cube of 1 that a small one in the opposite corner closes."""
    at = fresh(folder, name)
    (at / "log.lammps").write_text(log_text(["KinEng"], [[1.0]] * 3))
    rows = [[1, 1, 0.1, 0.5, 0.9, 1, 0, 0, 0.1], [2, 2, 0.999, 0.001, 0.001, 0, 0, 0, 0.001]]
    (at / "grains.dump").write_text(dump_text({0: rows}))
    done = command(".", "-o", "frame_*.png", *[word for name, value in more.items() for word in (f"--{name}", value)], cwd=at)
    fact("it ends well", done.returncode == 0, done.stderr)
    return frames_of(at / "frame_0.png")[0]


def test_a_grain_is_where_it_is(folder):
    """From the front x goes right and z up: the grain is a disc of its size, left and above."""
    pixels = one_grain(folder, "where", view="front", colour="kind", width=300, height=300)
    its = is_coloured(pixels)[:150, :150]
    y, x = np.nonzero(its)
    width, height = np.ptp(x) + 1, np.ptp(y) + 1
    fact("a disc", abs(width - height) <= 2 and abs(its.sum() / (math.pi * width * height / 4) - 1) < 0.05, (width, height))
    fact("left and above", x.mean() < 100 and y.mean() < 100, (x.mean(), y.mean()))
    # The picture shows bounds with all radii of a snapshot, from 0 to 1 and so, in 0.94 x 0.92 of its height.
    at_most("its size", abs(width / 300 / (0.47 * 0.92 * 2 * 0.2 / 1.1) - 1), 0.12)


def test_from_the_back_it_is_on_the_other_side(folder):
    pixels = one_grain(folder, "back", view="back", colour="kind", width=300, height=300)
    _, x = np.nonzero(is_coloured(pixels))
    fact("right", x.mean() > 200, x.mean())


def test_a_mesh_in_front_is_glass(folder):
    """A grain behind a plate shines through, and one in front of it hides it."""
    colours = {}
    for name, y in (("behind", 0.9), ("before", -0.9)):
        at = fresh(folder, name)
        (at / "log.lammps").write_text(log_text(["KinEng"], [[1.0]] * 3))
        (at / "grains.dump").write_text(dump_text({0: [[1, 1, 0.5, y, 0.5, 1, 0, 0, 0.1]]}))
        (at / "p_0.vtp").write_text(vtp_text([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]], TRIANGLE[1], {"normal_stress": [1, 1]}))
        (at / "p_series.pvd").write_text('<DataSet timestep="0" part="0" file="p_0.vtp"/>\n')
        done = command(".", "-o", "f_*.png", "--view", "front", "--colour", "kind", "--width", 200, "--height", 200, cwd=at)
        fact("it ends well", done.returncode == 0, done.stderr)
        pixels = frames_of(at / "f_0.png")[0]
        y, x = np.nonzero(is_coloured(pixels) & (pixels[:, :, 2] > pixels[:, :, 0] + 30))
        colours[name] = pixels[int(y.mean()), int(x.mean())]
    fact("behind it is paler", (colours["behind"] > colours["before"])[0], colours)
    fact("but seen", colours["behind"][2] - colours["behind"][0] > 30, colours)


def test_colours_of_a_field(folder):
    """One triangle has all of the worn depth, and is yellow; the other, which has none, is violet."""
    at = fresh(folder, "field")
    (at / "log.lammps").write_text(log_text(["KinEng"], [[1.0]] * 3))
    (at / "p_0.vtp").write_text(vtp_text([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]], TRIANGLE[1], {"worn_depth": [1, 0]}))
    (at / "p_series.pvd").write_text('<DataSet timestep="0" part="0" file="p_0.vtp"/>\n')
    done = command(".", "-o", "f_*.png", "--view", "front", "--field", "worn_depth", "--width", 200, "--height", 200, cwd=at)
    pixels = frames_of(at / "f_0.png")[0]
    right, left = pixels[120, 150], pixels[60, 60]
    fact("it ends well", done.returncode == 0, done.stderr)
    fact("yellow", right[0] > 2 * right[2] and right[1] > 2 * right[2], right)
    fact("violet", left[2] > left[1] and left[0] > left[1], left)


def test_frames(folder):
    """A film has as many frames as are asked for, and takes as long."""
    at = fresh(folder, "frames")
    write_run(at)
    done = command(".", "--frames", 4, "--seconds", 2, "--width", 100, "--height", 80, cwd=at)
    fact("it ends well", done.returncode == 0 and "film.gif: 4 frames" in done.stdout, done.stderr)
    with Image.open(at / "film.gif") as image:
        fact("frames and size", (image.n_frames, image.size) == (4, (100, 80)), (image.n_frames, image.size))
        fact("500 ms each", image.info["duration"] == 500, image.info)
    found = frames_of(at / "film.gif")
    fact("they differ", all((a != b).any() for a, b in zip(found, found[1:])))


def test_pictures_have_the_step_in_their_names(folder):
    at = fresh(folder, "steps")
    write_run(at)
    command(".", "-o", "a_*.png", "--frames", 3, "--width", 60, "--height", 60, cwd=at)
    fact("first, middle and last", sorted(path.name for path in at.glob("a_*.png")) == ["a_0.png", "a_200.png", "a_500.png"], sorted(at.glob("a_*.png")))


@pytest.mark.parametrize("words, code, said", (
    (["."], 1, "has no log of LAMMPS"),
    (["empty"], 1, "There is nothing to draw: the keyword mesh_fields"),
    (["run", "-o", "film.mp4"], 1, "end the name in .gif or .png"),
    (["run", "-o", "film.png"], 1, "give the name one *"),
    (["run", "--field", "colour"], 1, "the run has no such field; it has contacts, normal_stress, plain, hidden"),
    (["run", "--view", "above"], 2, "'above' is no view: front, back"),
    (["run", "--view", "0,100"], 2, "with a tilt from -90 to 90"),
    (["run", "--width", "10"], 2, "'10' is no number of pixels from 50 to 4000"),
    (["run", "--cut", "1"], 2, "'1' is no share"),
    (["run", "--frames", "0"], 2, "'0' is no whole number from 1 to 10000"),
    (["run", "--seconds", "-1"], 2, "'-1' is no number above 0"),
    (["run", "--colour", "red"], 2, "invalid choice: 'red'")))
def test_refused(folder, words, code, said):
    at = fresh(folder, "refused")
    (at / "run").mkdir()
    (at / "empty").mkdir()
    (at / "empty" / "log.lammps").write_text("units si\nStep KinEng\n0 1\n")
    write_run(at / "run")
    done = command(*words, cwd=at)
    fact(f"{' '.join(words)}: {said}", done.returncode == code and said in done.stderr and "Traceback" not in done.stderr, done.stderr[-300:])
