#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Draw what a script of this folder has written, as a film: film.py drum [FOLDER]

Writes NAME.gif, 200 pixels wide, and NAME.png, one frame 640 pixels wide, into --out. Draws on all cores. Needs numpy and PIL.
"""
import argparse
import base64
import dataclasses
import functools
import multiprocessing
import os
import re
import sys
from pathlib import Path

for library in ("OMP", "OPENBLAS", "MKL"):    # a process draws a frame, on a core of its own
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")
import numpy as np    # noqa: E402
from PIL import Image    # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from look import BLUE, DARK, ORANGE, STEEL, View, below, rgb, viridis    # noqa: E402

FINER = 3     # a pixel is the mean of so many by so many
LIGHT = np.array([-0.4, 0.55, 0.73])    # where it is: right, up, towards the eye
SAND = "#D9C8A5"


@dataclasses.dataclass
class Film:
    title: str
    view: tuple           # as that of dump image
    box: tuple            # what is seen: lo and hi of x, y, z
    bar: tuple            # the scale bar: its length, words
    key: object           # below the still, as look.below has it
    meshes: list          # files; with * the number of a frame's step
    colour: str = "type"    # of grains: type, speed or none
    worn: float = 0       # depth at the end of the scale of the triangles' colours; 0: they have none
    cut: float = -np.inf  # grains with y below it are left out
    hidden: tuple = ()    # files of which triangles in front of `cut` are left out
    moved: tuple = (0, 0, 0)    # how far a mesh at rest is from where its file has it


FILMS = {
    "drum": Film("drum", (84, -78), (-0.215, 0.215, 0, 0.12, -0.215, 0.215), (0.1, "0.1 m"), ("m/s, speed", 0, 2), ["drum_*.stl"], "speed"),
    "valve": Film("valve", (84, -78), (-0.16, 0.16, 0, 0.12, -0.2, 0.3), (0.05, "50 mm"), [(ORANGE, ""), (BLUE, "layers of 40 mm")],
                  ["valve.stl", "rotor_*.stl"]),
    "chute": Film("chute", (60, -62), (-0.02, 0.32, -0.09, 0.09, -0.3, 0.17), (0.05, "50 mm"), ("nm, worn depth", 0, 20),
                  ["plate_*.vtp", "chute_sides.stl", "bin.stl"], "none", 2e-8, 0.0, ("chute_sides.stl", "bin.stl")),
    "hopper": Film("hopper", (84, -78), (-0.05, 0.07, 0, 0.05, -0.06, 0.125), (0.02, "20 mm"), ("m/s, speed", 0, 0.6),
                   ["film_hopper.stl", "film_gate_*.stl"], "speed", cut=0.0, hidden=("film_hopper.stl",)),
    "wheel": Film("wheel", (84, -78), (-0.26, 0.26, 0, 0.12, -0.22, 0.45), (0.1, "0.1 m"), ("m/s, speed", 0, 2.5),
                  ["tank.stl", "wheel_*.stl"], "speed"),
    # Of examples/benchmark.
    "silo": Film("silo", (84, -78), (-0.105, 0.105, -0.105, 0.105, -0.09, 0.2), (0.05, "50 mm"), ("m/s, speed", 0, 1), ["silo_large.stl"],
                 "speed", 0, 0.0, ("silo_large.stl",), (0, 0, -0.0554222)),
    "layers": Film("drum", (84, -78), (-0.105, 0.105, -0.031, 0.031, -0.105, 0.105), (0.05, "50 mm"), [(ORANGE, "2 mm"), (BLUE, "4 mm")],
                   ["drum.stl"], "type", 0, -0.0299, ("drum.stl",), (0, -0.03, 0)),
}


# ---- files ----------------------------------------------------------------------------------

def read_grains(path):
    """Columns by name and the time, of a binary file of dump custom with one frame, as LAMMPS has written it since 2020."""
    data, at = path.read_bytes(), 0

    def take(kind, count=1):
        nonlocal at
        found = np.frombuffer(data, kind, count, at)
        at += found.nbytes
        return found

    magic = -int(take("<i8")[0])
    if magic <= 0:
        raise SystemExit(f"{path}: a binary dump of an older LAMMPS, which has no names of columns")
    take("i1", magic)
    take("<i4", 2)    # endianness, revision
    take("<i8", 2)    # step, grains
    triclinic = take("<i4")[0]
    take("<i4", 6)
    take("<f8", 9 if triclinic else 6)
    columns = int(take("<i4")[0])
    take("i1", int(take("<i4")[0]))    # units
    time = float(take("<f8")[0]) if take("i1")[0] else None
    names = take("i1", int(take("<i4")[0])).tobytes().decode().split()
    chunks = int(take("<i4")[0])
    rows = np.concatenate([take("<f8", int(take("<i4")[0])).reshape(-1, columns) for _ in range(chunks)])
    return dict(zip(names, rows.T)), time


def read_triangles(path):
    """Their corners and, of a file of mesh_fields, how deep each is worn."""
    if path.suffix == ".stl":
        facets = np.frombuffer(path.read_bytes()[84:], np.dtype([("n", "<f4", 3), ("x", "<f4", (3, 3)), ("a", "<u2")]))
        return facets["x"].astype(float), np.zeros(len(facets))
    kinds = {"Float64": np.float64, "Int64": np.int64, "Int32": np.int32}
    arrays = re.findall(r'<DataArray type="(\w+)" Name="(\w+)"[^>]*>([^<]*)<', path.read_text())
    fields = {name: np.frombuffer(base64.b64decode(text)[8:], kinds[kind]) for kind, name, text in arrays}
    return fields["points"].reshape(-1, 3)[fields["connectivity"].reshape(-1, 3)], fields["worn_depth"]


# ---- drawing --------------------------------------------------------------------------------

class Canvas:
    """Pixels that keep the colour of what lies nearest to the eye."""

    def __init__(self, view, finer):
        self.view, self.scale = view, view.scale * finer
        self.size = view.size[0] * finer, view.size[1] * finer
        self.depth = np.full(self.size[0] * self.size[1], -np.inf)
        self.colour = np.ones((len(self.depth), 3))

    def place(self, points):
        """Pixels right and down, and towards the eye."""
        away = points - self.view.centre
        return (self.size[0] / 2 + self.scale * (away @ self.view.right), self.size[1] / 2 - self.scale * (away @ self.view.up),
                self.scale * (away @ self.view.back))

    def put(self, x, y, depth, colour):
        """One pixel for each. Of several at one pixel the last counts: they come in the order of their depth, nearly."""
        x, y = np.floor(x).astype(int), np.floor(y).astype(int)
        inside = (x >= 0) & (x < self.size[0]) & (y >= 0) & (y < self.size[1])
        at = y[inside] * self.size[0] + x[inside]
        near = depth[inside] > self.depth[at]
        at, which = at[near], np.flatnonzero(inside)[near]
        self.depth[at] = depth[which]
        self.colour[at] = colour[which]

    def spheres(self, centres, radii, colours):
        x, y, z = self.place(centres)
        order = np.argsort(z)
        x, y, z, r, colours = x[order], y[order], z[order], self.scale * radii[order], colours[order]
        reach = int(np.ceil(r.max())) if len(r) else -1
        for i in range(-reach, reach + 1):
            for j in range(-reach, reach + 1):
                # Of the pixel's middle from the centre, right and up, over the radius.
                u, w = (np.floor(x) + i + 0.5 - x) / r, -(np.floor(y) + j + 0.5 - y) / r
                on = u * u + w * w < 1
                if not on.any():
                    continue
                u, w = u[on], w[on]
                out = np.sqrt(1 - u * u - w * w)
                bright = 0.35 + 0.65 * np.clip(np.stack([u, w, out], axis=1) @ LIGHT, 0, None)
                self.put(x[on] + i, y[on] + j, z[on] + r[on] * out, colours[on] * bright[:, None])

    def triangles(self, corners, colours):
        """Points half a pixel apart."""
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normal = across / np.maximum(np.linalg.norm(across, axis=1), 1e-300)[:, None]
        facing = np.stack([normal @ axis for axis in (self.view.right, self.view.up, self.view.back)], axis=1)
        facing *= np.where(facing[:, 2] < 0, -1, 1)[:, None]    # both sides are seen
        colours = colours * (0.45 + 0.55 * np.clip(facing @ LIGHT, 0, None))[:, None]
        # The shortest edge first, so that a sliver has few points across.
        edges = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
        corners = np.take_along_axis(corners, ((edges.argmin(axis=1)[:, None] + range(3)) % 3)[..., None], axis=1)
        pieces = np.ceil(2 * self.scale * np.stack([edges.min(axis=1), edges.max(axis=1)], axis=1)).astype(int)
        for n, m in np.unique(pieces, axis=0):
            which = np.flatnonzero((pieces == (n, m)).all(axis=1))
            a, b = np.meshgrid(np.arange(n + 1) / max(n, 1), np.arange(m + 1) / max(m, 1))
            a, b = a[a + b <= 1 + 1e-9], b[a + b <= 1 + 1e-9]
            for some in np.array_split(which, max(1, len(which) * len(a) // 2000000)):
                one, two, three = (corners[some, k, None] for k in range(3))
                points = (one + a[:, None] * (two - one) + b[:, None] * (three - one)).reshape(-1, 3)
                x, y, z = self.place(points)
                order = np.argsort(z)
                self.put(x[order], y[order], z[order], np.repeat(colours[some], len(a), axis=0)[order])

    def picture(self, finer):
        """With lines where the depth jumps."""
        shape = self.size[1], self.size[0]
        depth = np.where(np.isinf(self.depth), self.depth.min(initial=0, where=~np.isinf(self.depth)) - 100, self.depth).reshape(shape)
        jump = np.zeros(shape)
        jump[1:] = np.maximum(jump[1:], np.abs(np.diff(depth, axis=0)))
        jump[:, 1:] = np.maximum(jump[:, 1:], np.abs(np.diff(depth, axis=1)))
        dark = 1 - 0.45 * np.clip(jump / (8 * finer) - 0.5, 0, 1)
        shown = np.clip(self.colour.reshape(*shape, 3) * dark[..., None], 0, 1)
        return Image.fromarray((255 * shown + 0.5).astype(np.uint8)).reduce(finer)


def frame(film, folder, meshes, step, width, finer, text, key):
    """A picture of the state after a step."""
    grains, time = read_grains(folder / f"grains_{step}.bin")
    canvas = Canvas(View(film.view, film.box, width), finer)
    centres = np.stack([grains[c] for c in "xyz"], axis=1)
    low, high = np.reshape(film.box, (3, 2)).T
    shown = (centres[:, 1] > film.cut) & ((centres > low) & (centres < high)).all(axis=1)
    if film.colour == "speed":
        _, least, most = film.key
        speed = np.sqrt(sum(grains[v] ** 2 for v in ("vx", "vy", "vz")))
        colours = viridis((speed - least) / (most - least))
    else:
        palette = [SAND, SAND] if film.colour == "none" else [ORANGE, BLUE]
        colours = np.array([rgb(c) for c in palette])[grains["type"].astype(int) - 1]
    canvas.spheres(centres[shown], grains["radius"][shown], colours[shown])
    for name in film.meshes:
        path = folder / name.replace("*", str(step)) if "*" in name else meshes / name
        corners, worn = read_triangles(path)
        if "*" not in name:
            corners = corners + np.array(film.moved)
        keep = np.ones(len(corners), bool)
        if name in film.hidden:
            keep = corners[:, :, 1].mean(axis=1) > film.cut
        solid = viridis(worn / film.worn) if film.worn and path.suffix == ".vtp" else np.tile(rgb(STEEL), (len(corners), 1))
        canvas.triangles(corners[keep], solid[keep])
    words = f"t = {time:.2f} s" if time is not None else ""
    return below(canvas.picture(finer), View(film.view, film.box, width).scale, film.bar, words, key, text)


def small(frames, most, path, milliseconds, samples=None):
    """Writes a GIF with as many colours as keep it below `most` bytes, the same for all frames: those of `samples`, or of every
    eighth frame."""
    samples = samples or frames[::8]
    sheet = Image.new("RGB", (samples[0].width, samples[0].height * len(samples)))
    for k, one in enumerate(samples):
        sheet.paste(one, (0, k * one.height))
    for colours in (128, 96, 64, 48, 32, 24, 16, 12):
        palette = sheet.quantize(colours, kmeans=2)
        flat = [one.quantize(palette=palette, dither=Image.Dither.NONE) for one in frames]
        flat[0].save(path, save_all=True, append_images=flat[1:], duration=milliseconds, loop=0, optimize=True)
        if path.stat().st_size < most:
            break
    print(f"{path}: {len(frames)} frames of {frames[0].width} x {frames[0].height}, {colours} colours, {path.stat().st_size} bytes")


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    p.add_argument("name", choices=FILMS)
    p.add_argument("folder", type=Path, nargs="?", default=Path("."), help="where the script ran")
    p.add_argument("--meshes", type=Path, help="where the meshes at rest are, if elsewhere")
    p.add_argument("--out", type=Path, default=Path("."))
    p.add_argument("--width", type=int, default=200, help="of the film, pixels")
    p.add_argument("--still", type=float, default=0.7, help="which frame becomes the still: share of the film")
    p.add_argument("--bytes", type=int, default=690000, help="that the film may have")
    p.add_argument("--milliseconds", type=int, default=60, help="that a frame is shown")
    p.add_argument("--jobs", type=int, default=multiprocessing.cpu_count())
    a = p.parse_args()
    film = FILMS[a.name]
    steps = sorted(int(path.stem.split("_")[1]) for path in a.folder.glob("grains_*.bin"))
    if not steps:
        p.error(f"{a.folder} has no grains_*.bin")
    draw = functools.partial(frame, film, a.folder, a.meshes or a.folder)
    a.out.mkdir(parents=True, exist_ok=True)
    with multiprocessing.Pool(a.jobs) as pool:
        frames = [pool.apply_async(draw, (step, a.width, FINER, 12, None)) for step in steps[1:]]
        still = pool.apply_async(draw, (steps[round(a.still * (len(steps) - 1))], 640, 2, 27, film.key))
        frames = [one.get() for one in frames]
        still.get().quantize(256, kmeans=2).save(a.out / f"{a.name}.png", optimize=True)
    small(frames, a.bytes, a.out / f"{a.name}.gif", a.milliseconds)


if __name__ == "__main__":
    main()
