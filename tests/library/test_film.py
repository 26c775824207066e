# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Films of runs, lsdcd.film: where grains and meshes are on the picture, colours, frames, and words that are refused."""
import math
import random
import shutil
import subprocess
import sys

import numpy as np
import pytest

from facts import at_most, fact
from runs import TRIANGLE, binary_dump, dump_text, grains, log_text, vtp_text, write_run

Image = pytest.importorskip("PIL.Image", reason="no Pillow (Debian: python3-pil)")
from lsdcd import _run_files as files, film    # noqa: E402

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
    eye = film.Eye(film.view(word), *BOX, 200)
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
    # The picture shows the bounds with the largest radius of the snapshot, from 0 to 1.1, in 1/1.02 of what the words leave of its height.
    at_most("its size", abs(width / ((300 - 18) / 1.02 * 0.2 / 1.1) - 1), 0.06)


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


def test_a_solid_mesh_hides_what_is_behind_it(folder):
    """Of two grains the one behind the plate is not seen, and the plate is not what is behind a second one."""
    at = fresh(folder, "solid")
    (at / "log.lammps").write_text(log_text(["KinEng"], [[1.0]] * 3))
    (at / "grains.dump").write_text(dump_text({0: [[1, 1, 0.3, 0.9, 0.5, 1, 0, 0, 0.1], [2, 2, 0.7, -0.9, 0.5, 1, 0, 0, 0.1]]}))
    square = [[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]]
    for name, y, worn in (("p", 0, 0), ("q", 0.5, 1)):
        (at / f"{name}_0.vtp").write_text(vtp_text([[a, y, c] for a, _, c in square], TRIANGLE[1], {"worn_depth": [worn, worn]}))
        (at / f"{name}_series.pvd").write_text(f'<DataSet timestep="0" part="0" file="{name}_0.vtp"/>\n')
    seen = {}
    for word in ("--solid", "--log=log.lammps"):
        command(".", "-o", "f_*.png", "--view", "front", "--colour", "kind", "--field", "worn_depth", "--width", 200, "--height", 200, word, cwd=at)
        seen[word] = frames_of(at / "f_0.png")[0]
    fact("no blue", not (seen["--solid"][:160, :100, 2] > seen["--solid"][:160, :100, 0] + 60).any())
    fact("but orange", (seen["--solid"][:160, 100:, 0] > seen["--solid"][:160, 100:, 2] + 60).any())
    fact("the plate in front has no worn depth, and the one behind is yellow", np.ptp(seen["--solid"][30, 30]) < 20 and np.ptp(seen["--log=log.lammps"][30, 30]) > 60,
         (seen["--solid"][30, 30], seen["--log=log.lammps"][30, 30]))


def test_a_jump_of_depth_is_a_line(folder):
    """The rim of a grain against paper is darker than its middle, by more than its shade."""
    eye = film.Eye(film.view("front"), *BOX, 100)
    layer = film.Layer(eye)
    layer.spheres(np.array([[0.5, 0, 0.5]]), np.array([0.3]), np.full((1, 3), 255.0))
    pixels = np.array(film.composed(layer, film.Shell(eye), False).convert("L")).astype(float)
    plain = layer.colour.reshape(100, 100, 3)[:, :, 0]
    is_grain = np.isfinite(layer.depth).reshape(100, 100)
    rim = is_grain & ~np.roll(is_grain, 1, axis=0)
    at_most("the middle", np.abs(pixels - plain)[40:60, 40:60].max(), 1.0)
    at_most("the rim", (pixels / plain)[rim].max(), 0.6)


def test_a_top_of_colours(folder):
    """A grain of speed 1 has the last colour where colours end at 1, and a dark one where they end at 10."""
    bright = one_grain(folder, "top", top=1, view="front", width=200)
    dark = one_grain(folder, "top", top=10, view="front", width=200)
    shown = slice(0, 60), slice(0, 60)
    fact("bright", bright[shown].min(axis=2)[is_coloured(bright[shown])].mean() > 2 * dark[shown].min(axis=2)[is_coloured(dark[shown])].mean())


def test_the_height_is_that_of_the_bounds():
    for high, height in ((0.5, 50), (1, 100), (5, 200), (0, 5)):
        eye = film.Eye(film.view("front"), np.zeros(3), np.array([1, 1, high]), 100)
        fact("half as high, as high, at most twice, at least a twentieth", eye.size == (100, height), eye.size)


def test_jobs_draw_the_same(folder):
    at = fresh(folder, "jobs")
    write_run(at)
    for jobs in (1, 3):
        done = command(".", "-o", f"f{jobs}_*.png", "--width", 80, "--jobs", jobs, cwd=at)
        fact("it ends well", done.returncode == 0, done.stderr)
    one = sorted(at.glob("f1_*.png"))
    fact("bytes", len(one) > 3 and all(path.read_bytes() == (at / f"f3{path.name[2:]}").read_bytes() for path in one), len(one))


def test_a_film_of_few_bytes(folder):
    at = fresh(folder, "bytes")
    write_run(at)
    sizes = []
    for words in ([], ["--bytes", 5000]):
        done = command(".", "--width", 80, *words, cwd=at)
        sizes.append((at / "film.gif").stat().st_size)
        fact("it says how many", f"colours, {sizes[-1]} bytes" in done.stdout, done.stdout)
    fact("fewer", sizes[1] < sizes[0], sizes)


@pytest.mark.parametrize("processes", (1, 3))
def test_a_binary_dump_draws_as_its_text(folder, processes):
    at = fresh(folder, "binary")
    rows = np.array([[float(f"{value:.6g}") for value in row] for row in grains(200)])
    for name, columns in (("text", ""), ("binary", "dump a all custom 100 grains_*.bin id type x y z vx vy vz radius\n")):
        (at / name).mkdir()
        (at / name / "log.lammps").write_text(columns + log_text(["KinEng"], [[1.0]] * 3))
    for step, order in ((0, rows), (100, rows[::-1])):
        (at / "binary" / f"grains_{step}.bin").write_bytes(binary_dump({step: order}, processes))
    (at / "text" / "grains.dump").write_text(dump_text({0: rows, 100: rows[::-1]}))
    for name in ("text", "binary"):
        done = command(name, "-o", f"{name}_*.png", "--width", 80, cwd=at)
        fact("it ends well", done.returncode == 0, done.stderr)
    for step in (0, 100):
        fact("the same bytes", (at / f"text_{step}.png").read_bytes() == (at / f"binary_{step}.png").read_bytes(), step)


def test_a_binary_dump_that_is_cut_off_or_damaged(folder):
    at = fresh(folder, "cut")
    whole = binary_dump({0: grains(20), 100: grains(20)}, 2)
    for length in range(0, len(whole), 37):
        (at / "g.bin").write_bytes(whole[:length])
        try:
            frames = files.index_binary_dump(at / "g.bin")
        except files.InputError:
            fact("within the first bytes", length < 40, length)
            continue
        fact("whole frames", len(frames) == (length * 2 >= len(whole)), (length, len(frames)))
    chance = random.Random(5)
    for _ in range(500):
        damaged = bytearray(whole)
        for _ in range(3):
            damaged[chance.randrange(len(damaged))] = chance.randrange(256)
        (at / "g.bin").write_bytes(damaged)
        try:
            for frame in files.index_binary_dump(at / "g.bin"):
                files.read_grains(frame)
        except files.InputError:
            pass


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
    fact("paper is white", all((pixels[-1, -1] == 255).all() for pixels in found), [pixels[-1, -1] for pixels in found])
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
    (["run", "--bytes", "10"], 2, "'10' is no whole number from 1000"),
    (["run", "--jobs", "0"], 2, "'0' is no whole number from 1 to 10000"),
    (["run", "--top", "0"], 2, "'0' is no number above 0"),
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
