#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Draw what a script of this folder has written, as a film: film.py drum [FOLDER]

Writes NAME.gif, 200 pixels wide, and NAME.png, one frame 640 pixels wide, into --out. Draws on all cores.
"""
import argparse
import dataclasses
import os
import sys
from pathlib import Path

for library in ("OMP", "OPENBLAS", "MKL"):    # a process draws a frame, on a core of its own
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")
import numpy as np    # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from look import BLUE, ORANGE, STEEL, View, below, rgb, viridis    # noqa: E402
from lsdcd import film as drawing    # noqa: E402
from lsdcd._run_files import index_binary_dump, read_grains, read_vtp    # noqa: E402

FINER = 3     # a pixel is the mean of so many by so many
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


def read_triangles(path):
    """Their corners and, of a file of mesh_fields, how deep each is worn."""
    if path.suffix == ".stl":
        facets = np.frombuffer(path.read_bytes()[84:], np.dtype([("n", "<f4", 3), ("x", "<f4", (3, 3)), ("a", "<u2")]))
        return facets["x"].astype(float), np.zeros(len(facets))
    surface = read_vtp(path)
    return surface.points[surface.triangles], surface.fields["worn_depth"]


def frame(film, folder, meshes, step, width, finer, text, key):
    """A picture of the state after a step."""
    found, = index_binary_dump(folder / f"grains_{step}.bin")
    grains = read_grains(found)
    view = View(film.view, film.box, width, finer)
    spheres, walls = drawing.Layer(view), drawing.Shell(view)
    low, high = np.reshape(film.box, (3, 2)).T
    shown = (grains.place[:, 1] > film.cut) & ((grains.place > low) & (grains.place < high)).all(axis=1)
    if film.colour == "speed":
        _, least, most = film.key
        colours = viridis((grains.speed - least) / (most - least))
    else:
        palette = [SAND, SAND] if film.colour == "none" else [ORANGE, BLUE]
        colours = np.array([rgb(c) for c in palette])[grains.kind.astype(int) - 1]
    spheres.spheres(grains.place[shown], grains.radius[shown], 255 * colours[shown])
    for name in film.meshes:
        path = folder / name.replace("*", str(step)) if "*" in name else meshes / name
        corners, worn = read_triangles(path)
        if "*" not in name:
            corners = corners + np.array(film.moved)
        keep = np.ones(len(corners), bool)
        if name in film.hidden:
            keep = corners[:, :, 1].mean(axis=1) > film.cut
        solid = viridis(worn / film.worn) if film.worn and path.suffix == ".vtp" else np.tile(rgb(STEEL), (len(corners), 1))
        walls.draw(corners[keep], 255 * solid[keep])
    words = f"t = {found.time:.2f} s" if found.time is not None else ""
    return below(drawing.composed(spheres, walls, solid=True), view.scale / finer, film.bar, words, key, text)


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
    p.add_argument("--jobs", type=int, default=os.cpu_count())
    a = p.parse_args()
    film = FILMS[a.name]
    steps = sorted(int(path.stem.split("_")[1]) for path in a.folder.glob("grains_*.bin"))
    if not steps:
        p.error(f"{a.folder} has no grains_*.bin")
    a.out.mkdir(parents=True, exist_ok=True)
    folders = a.folder, a.meshes or a.folder
    frames = list(drawing.on_cores(lambda k: frame(film, *folders, steps[k + 1], a.width, FINER, 12, None), len(steps) - 1, a.jobs))
    still = frame(film, *folders, steps[round(a.still * (len(steps) - 1))], 640, 2, 27, film.key)
    still.quantize(256, kmeans=2).save(a.out / f"{a.name}.png", optimize=True)
    path = a.out / f"{a.name}.gif"
    colours = drawing.write_film(frames, path, a.milliseconds, a.bytes)
    print(f"{path}: {len(frames)} frames of {frames[0].width} x {frames[0].height}, {colours} colours, {path.stat().st_size} bytes")


if __name__ == "__main__":
    main()
