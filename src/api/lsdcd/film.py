# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Draws a run as a film or as pictures: meshes and grains, from a side that a word names.

    python3 -m lsdcd.film FOLDER

Needs Pillow (Debian: python3-pil). doc/report.md of the sources says more."""
from __future__ import annotations

import argparse
import concurrent.futures.process
import dataclasses
import math
import multiprocessing
import os
import pathlib
import signal
import sys
from typing import Any, Callable, Iterator, Sequence

import numpy as np
from PIL import Image, ImageDraw

from . import _run_files as files
from ._command import above_zero, run_command
from ._run_files import Array, Frame, Grains, InputError, Log, Surface, unit_text
from .report import EMPTY, Moving, colour_top, moving_meshes, nearest_of, thinned

FINER = 2              # a pixel is the mean of so many by so many
EDGE = 1.02            # the picture is so many times as wide as what it shows
ROW = 14               # pixels: height of a row of words below
SAMPLE = 3000          # grains of a snapshot, for bounds and colours
GLASS = 0.25           # of what is seen is the mesh in front of grains
LIGHT = np.array([-0.4, 0.55, 0.73])    # where it is: right, up, towards the eye
SAND, STEEL, PAPER, INK = (194, 158, 117), (184, 189, 196), (255, 255, 255), (40, 46, 52)
VIRIDIS = np.array([(68, 1, 84), (71, 44, 122), (59, 81, 139), (44, 113, 142), (33, 144, 141), (39, 173, 129), (92, 200, 99), (170, 220, 50), (253, 231, 37)], float)
HEAT = np.array([(70, 74, 84), (105, 78, 62), (140, 84, 40), (185, 92, 10), (222, 110, 0), (238, 142, 42), (247, 178, 80), (252, 214, 130), (255, 243, 190)], float)
KINDS = np.array([(0, 114, 178), (213, 94, 0), (0, 158, 115), (204, 121, 167), (230, 159, 0), (86, 180, 233), (138, 143, 152), (168, 149, 0)], float)
# From where a word looks: degrees about z from x, and above the plane x y.
VIEWS = {"front": (-90.0, 0.0), "back": (90.0, 0.0), "left": (180.0, 0.0), "right": (0.0, 0.0), "top": (-90.0, 90.0), "bottom": (-90.0, -90.0),
         "corner": (-60.0, 20.0)}


def ramp(colours: Array, share: Array) -> Array:
    """Colours of numbers from 0 to 1."""
    at = np.clip(share, 0, 1) * (len(colours) - 1)
    k = np.minimum(np.asarray(at).astype(int), len(colours) - 2)
    return np.asarray(colours[k] + (colours[k + 1] - colours[k]) * (at - k)[..., None])


class Eye:
    """Where places are on a picture that shows the bounds whole. Without a height the picture is as high as these need, up to twice its
    width. It is drawn with `finer` times as many pixels each way."""

    def __init__(self, view: tuple[float, float], low: Array, high: Array, width: int, height: int | None = None, finer: int = 1) -> None:
        turn, tilt = (math.radians(angle) for angle in view)
        self.back = np.array([math.cos(tilt) * math.cos(turn), math.cos(tilt) * math.sin(turn), math.sin(tilt)])
        self.right = np.array([-math.sin(turn), math.cos(turn), 0.0])
        self.up = np.cross(self.back, self.right)
        self.centre = (low + high) / 2
        corners = np.array([[(low, high)[i][0], (low, high)[j][1], (low, high)[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)]) - self.centre
        across, along, self.deep = (2 * float(np.abs(corners @ axis).max()) for axis in (self.right, self.up, self.back))
        if height is None:
            height = round(min(max(width * along / max(across, 1e-300), width / 20), 2 * width))
        self.finer, self.size = finer, (finer * width, finer * height)
        self.scale = min(self.size[0] / max(across, 1e-300), self.size[1] / max(along, 1e-300)) / EDGE

    def place(self, points: Array) -> tuple[Array, Array, Array]:
        """Pixels right and down, and towards the eye."""
        away = points - self.centre
        return self.size[0] / 2 + self.scale * (away @ self.right), self.size[1] / 2 - self.scale * (away @ self.up), self.scale * (away @ self.back)


class Layer:
    """Pixels that keep what is closest to the eye; `sign` -1: farthest from it."""

    def __init__(self, eye: Eye, sign: float = 1.0) -> None:
        self.eye, self.sign = eye, sign
        n = eye.size[0] * eye.size[1]
        self.depth, self.colour = np.full(n, -np.inf), np.zeros((n, 3))

    def put(self, x: Array, y: Array, depth: Array, colour: Array) -> None:
        """One pixel for each, which come in the order of their depth, the last in front."""
        x, y = np.floor(x).astype(int), np.floor(y).astype(int)
        inside = (x >= 0) & (x < self.eye.size[0]) & (y >= 0) & (y < self.eye.size[1])
        at, which = y[inside] * self.eye.size[0] + x[inside], np.flatnonzero(inside)
        before = self.sign * depth[which] > self.depth[at]
        at, which = at[before], which[before]
        self.depth[at], self.colour[at] = self.sign * depth[which], colour[which]

    def merge(self, other: Layer) -> None:
        """Adds what another layer of the same sign has."""
        before = other.depth > self.depth
        self.depth[before], self.colour[before] = other.depth[before], other.colour[before]

    def spheres(self, centres: Array, radii: Array, colours: Array) -> None:
        x, y, z = self.eye.place(centres)
        order = np.argsort(z)
        x, y, z, r, colours = x[order], y[order], z[order], np.maximum(self.eye.scale * radii[order], 0.71), colours[order]
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


class Shell:
    """A mesh on the picture: what of it is closest to the eye, and what is farthest."""

    def __init__(self, eye: Eye) -> None:
        self.eye, self.near, self.far = eye, Layer(eye), Layer(eye, -1.0)

    def merge(self, other: Shell) -> None:
        self.near.merge(other.near)
        self.far.merge(other.far)

    def draw(self, corners: Array, colours: Array) -> None:
        """Draws triangles as points that are closer than a pixel."""
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normal = across / np.maximum(np.linalg.norm(across, axis=1), 1e-300)[:, None]
        facing = np.stack([normal @ axis for axis in (self.eye.right, self.eye.up, self.eye.back)], axis=1)
        facing *= np.where(facing[:, 2] < 0, -1, 1)[:, None]    # both sides are seen
        colours = colours * (0.45 + 0.55 * np.clip(facing @ LIGHT, 0, None))[:, None]
        # The shortest edge first, so that a sliver has few points across.
        edges = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
        corners = np.take_along_axis(corners, ((edges.argmin(axis=1)[:, None] + np.arange(3)) % 3)[..., None], axis=1)
        pieces = np.ceil(1.5 * self.eye.scale * np.stack([edges.min(axis=1), edges.max(axis=1)], axis=1)).astype(int)
        for n, m in np.unique(pieces, axis=0):
            which = np.flatnonzero((pieces == (n, m)).all(axis=1))
            a, b = np.meshgrid(np.arange(n + 1) / max(n, 1), np.arange(m + 1) / max(m, 1))
            a, b = a[a + b <= 1 + 1e-9], b[a + b <= 1 + 1e-9]
            for some in np.array_split(which, max(1, len(which) * len(a) // 2000000)):
                one, two, three = (corners[some, k, None] for k in range(3))
                x, y, z = self.eye.place((one + a[:, None] * (two - one) + b[:, None] * (three - one)).reshape(-1, 3))
                order = np.argsort(z)
                for layer, sorted_so in ((self.near, order), (self.far, order[::-1])):
                    layer.put(x[sorted_so], y[sorted_so], z[sorted_so], np.repeat(colours[some], len(a), axis=0)[sorted_so])


def composed(grains: Layer, mesh: Shell, solid: bool) -> Image.Image:
    """The picture of grains in a mesh, which is as of glass or hides what is behind it. Lines are drawn where the depth jumps."""
    eye, near, far = grains.eye, mesh.near, mesh.far
    colour, depth = np.tile(np.array(PAPER, float), (len(grains.depth), 1)), np.full(len(grains.depth), -np.inf)

    def lay(layer: Layer, above: Array, share: float = 1.0) -> None:
        colour[above] += share * (layer.colour[above] - colour[above])

    if solid:
        for layer in (near, grains):
            above = layer.depth > depth
            lay(layer, above)
            depth[above] = layer.depth[above]
    else:
        has_mesh, has_grain = np.isfinite(far.depth), np.isfinite(grains.depth)
        lay(far, has_mesh)
        lay(grains, has_grain)
        for layer, place in ((far, -far.depth), (near, near.depth)):    # what is in front of a grain
            lay(layer, has_grain & has_mesh & (place > grains.depth), GLASS)
        depth = np.where(has_grain, grains.depth, -far.depth * np.where(has_mesh, 1, np.nan))
        depth[np.isnan(depth)] = -np.inf
    is_paper = np.isinf(depth)
    depth[is_paper] = depth.min(initial=0, where=~is_paper) - 50 * eye.finer
    shape = eye.size[1], eye.size[0]
    depth, jump = depth.reshape(shape), np.zeros(shape)
    jump[1:] = np.maximum(jump[1:], np.abs(np.diff(depth, axis=0)))
    jump[:, 1:] = np.maximum(jump[:, 1:], np.abs(np.diff(depth, axis=1)))
    dark = 1 - 0.45 * np.clip(jump / (8 * eye.finer) - 0.5, 0, 1)
    shown = np.clip(colour.reshape(*shape, 3) * dark[..., None], 0, 255)
    return Image.fromarray((shown + 0.5).astype(np.uint8)).reduce(eye.finer)


@dataclasses.dataclass
class Scene:
    """A run and how it is drawn."""
    log: Log
    meshes: list[Moving]
    frames: list[Frame]
    steps: list[float]
    eye: Eye
    field: str
    top_of_field: dict[str, float]    # of each mesh
    colour: str
    top_of_colour: float
    cut: float
    solid: bool
    bars: list[tuple[Array, float, str]]    # below the picture: colours, where they end, and of what
    drawn: dict[str, tuple[int, Shell]] = dataclasses.field(default_factory=dict)

    def mesh_colours(self, mesh: Moving, surface: Surface) -> Array:
        top = self.top_of_field.get(mesh.name, 0.0)
        if not top or self.field not in surface.fields:
            return np.tile(np.array(STEEL, float), (len(surface.triangles), 1))
        return ramp(VIRIDIS, surface.fields[self.field] / top)

    def grain_colours(self, grains: Grains) -> Array:
        if self.colour == "kind":
            return np.asarray(KINDS[(grains.kind.astype(int) - 1) % len(KINDS)])
        if self.colour == "plain" or not self.top_of_colour:
            return np.tile(np.array(SAND, float), (len(grains.place), 1))
        return ramp(HEAT, (grains.speed if self.colour == "speed" else 2 * grains.radius) / self.top_of_colour)

    def is_kept(self, points: Array) -> Array:
        """Is a place behind the cut?"""
        return np.asarray((points - self.eye.centre) @ self.eye.back <= self.eye.deep * (0.5 - self.cut))

    def shell(self, mesh: Moving, k: int) -> Shell:
        """A mesh as one of its files has it. The last one is kept, because most meshes stay as they are for long."""
        if mesh.name in self.drawn and self.drawn[mesh.name][0] == k:
            return self.drawn[mesh.name][1]
        surface, shell = mesh.surfaces[k], Shell(self.eye)
        corners = surface.points[surface.triangles]
        kept = self.is_kept(corners.mean(axis=1))
        shell.draw(corners[kept], self.mesh_colours(mesh, surface)[kept])
        self.drawn[mesh.name] = k, shell
        return shell

    def picture(self, k: int) -> Image.Image:
        """The picture of a step of the film."""
        grains_shown, meshes_shown = Layer(self.eye), Shell(self.eye)
        for mesh in self.meshes if self.field != "hidden" else []:
            meshes_shown.merge(self.shell(mesh, nearest_of([entry.step for entry in mesh.entries], [self.steps[k]])[0] if mesh.entries else 0))
        if self.frames and self.colour != "hidden":
            frame = self.frames[nearest_of([frame.step for frame in self.frames], [self.steps[k]])[0]]
            grains = files.read_grains(frame)
            if grains is not None and len(grains.place):
                kept = self.is_kept(grains.place)
                grains_shown.spheres(grains.place[kept], grains.radius[kept], self.grain_colours(grains)[kept])
        return self.labelled(composed(grains_shown, meshes_shown, self.solid), self.log.times(np.array([self.steps[k]]))[0])

    def labelled(self, picture: Image.Image, time: float) -> Image.Image:
        """The picture above the time and what colours mean."""
        whole = Image.new("RGB", (picture.width, picture.height + height_of_words(len(self.bars))), PAPER)
        whole.paste(picture)
        draw, at = ImageDraw.Draw(whole), whole.height - ROW - 2
        draw.text((8, at), f"{time:.4g} {self.log.time_unit}", fill=INK)
        for row, (colours, top, words) in enumerate(self.bars):
            y = at - ROW * row
            for x in range(60):
                colour = ramp(colours, np.array([x / 59]))[0]
                draw.line([(110 + x, y + 2), (110 + x, y + 8)], fill=(int(colour[0]), int(colour[1]), int(colour[2])))
            draw.text((176, y), f"{top:.3g} {words}", fill=INK)
        return whole


def height_of_words(bars: int) -> int:
    return ROW * max(bars, 1) + 4


def colour_bars(given: argparse.Namespace, log: Log, top_of_colour: float, top_of_field: dict[str, float]) -> list[tuple[Array, float, str]]:
    bars = []
    if given.colour in ("speed", "size") and top_of_colour:
        kind, words = ("velocity", "speed") if given.colour == "speed" else ("distance", "diameter")
        bars.append((HEAT, top_of_colour, f"{unit_text(kind, log.units)}: {words}"))
    unit, words = unit_text(files.OF_FIELDS.get(given.field, ""), log.units), given.field.replace("_", " ")
    bars += [(VIRIDIS, top, f"{unit}: {words}{f', {name}' if len(top_of_field) > 1 else ''}") for name, top in top_of_field.items()]
    return bars[:4]


def scene_of(given: argparse.Namespace, notes: list[str]) -> Scene:
    """Reads the run. Bounds and colours are those of all frames, by a sample of the grains."""
    folder = pathlib.Path(given.folder)
    log = files.read_log(files.find_log(folder, given.log))
    meshes, frames = moving_meshes(folder, log, given.frames, notes), files.grain_frames(folder, log, notes)
    series = max([[entry.step for entry in mesh.entries] for mesh in meshes] + [[float(frame.step) for frame in frames]], key=len)
    steps = thinned(series, given.frames) if series else [log.last_step()]
    if not meshes and not frames:
        raise InputError(EMPTY)
    frames = [frames[k] for k in sorted(set(nearest_of([frame.step for frame in frames], steps)))] if frames else []
    seen = [files.read_grains(frame, SAMPLE / max(frame.n, 1)) for frame in frames]
    whole = [(frame, grains) for frame, grains in zip(frames, seen) if grains is not None]
    samples = [grains for _, grains in whole if len(grains.place)]
    bounds = [surface.points for mesh in meshes for surface in mesh.surfaces]
    bounds += [part for grains in samples for part in (grains.place - grains.radius.max(), grains.place + grains.radius.max())]
    if not bounds:
        raise InputError(EMPTY)
    low, high = np.min([b.min(axis=0) for b in bounds], axis=0), np.max([b.max(axis=0) for b in bounds], axis=0)
    names = sorted({name for mesh in meshes for surface in mesh.surfaces for name in surface.fields})
    if given.field not in ("plain", "hidden", *names):
        raise InputError(f"--field {given.field}: the run has no such field; it has {', '.join([*names, 'plain', 'hidden'])}")
    tops = {mesh.name: colour_top(np.concatenate([surface.fields[given.field] for surface in mesh.surfaces if given.field in surface.fields] or [np.zeros(0)]))
            for mesh in meshes}
    values = [grains.speed if given.colour == "speed" else 2 * grains.radius for grains in samples]
    top_of_field = {name: top for name, top in tops.items() if top}
    top_of_colour = (given.top or colour_top(np.concatenate(values))) if values else 0.0
    bars = colour_bars(given, log, top_of_colour, top_of_field)
    eye = Eye(given.view, low, high, given.width, given.height - height_of_words(len(bars)) if given.height else None, FINER)
    return Scene(log, meshes, [frame for frame, _ in whole], steps, eye, given.field, top_of_field, given.colour, top_of_colour, given.cut, given.solid, bars)


# ---- the command -------------------------------------------------------------------------


HELP = """Draws the meshes and grains of a run of LAMMPS as a film (.gif), or as a picture for each step (.png): what mesh_fields and a dump have
written. Grains are seen through the mesh as through glass, or with --solid where it does not hide them."""
EXAMPLE = f"""Example:
  lsdcd film . --view front

--view takes {', '.join(VIEWS)}, or two angles in degrees, TURN,TILT: about z from x, and above the plane x y. So front is -90,0."""


def view(word: str) -> tuple[float, float]:
    if word in VIEWS:
        return VIEWS[word]
    try:
        turn, tilt = (float(part) for part in word.split(","))
    except ValueError:
        turn = tilt = math.nan
    if not (math.isfinite(turn) and -90 <= tilt <= 90):
        raise argparse.ArgumentTypeError(f"'{word}' is no view: {', '.join(VIEWS)}, or TURN,TILT in degrees, with a tilt from -90 to 90")
    return turn, tilt


def count_of(least: int, most: int, what: str = "whole number") -> Callable[[str], int]:
    def read(word: str) -> int:
        if not (word.isascii() and word.isdigit()) or not least <= int(word) <= most:
            raise argparse.ArgumentTypeError(f"'{word}' is no {what} from {least} to {most}")
        return int(word)
    return read


pixels, count = count_of(50, 4000, "number of pixels"), count_of(1, 10000)


def share(word: str) -> float:
    try:
        number = float(word)
    except ValueError:
        number = math.nan
    if not 0 <= number < 1:
        raise argparse.ArgumentTypeError(f"'{word}' is no share from 0 to below 1")
    return number


def options() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("lsdcd film", description=HELP, epilog=EXAMPLE, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="the folder of the run")
    parser.add_argument("-o", "--output", metavar="FILE", help="film.gif in the folder is the default; frame_*.png: a picture for each step, which the * stands for")
    parser.add_argument("--view", type=view, default=VIEWS["corner"], metavar="VIEW", help="from where (default: corner)")
    parser.add_argument("--colour", choices=("speed", "size", "kind", "plain", "hidden"), default="speed", help="of grains (default: %(default)s)")
    parser.add_argument("--field", default="plain", metavar="NAME", help="by which meshes are coloured: normal_stress, worn_depth, impact_energy, "
                        "dissipated_energy and others of mesh_fields, plain, or hidden (default: %(default)s)")
    parser.add_argument("--top", type=above_zero, metavar="NUMBER", help="the speed or size at which colours of grains end, so that those of several films mean the same "
                        "(default: what 98 %% do not exceed)")
    parser.add_argument("--solid", action="store_true", help="meshes hide what is behind them")
    parser.add_argument("--cut", type=share, default=0.0, metavar="SHARE", help="take away this share of what is in front (default: 0)")
    parser.add_argument("--width", type=pixels, default=480, help="of the picture, pixels (default: %(default)s)")
    parser.add_argument("--height", type=pixels, help="likewise (default: what the bounds need)")
    parser.add_argument("--frames", type=count, default=60, metavar="N", help="at most so many, evenly over the run (default: %(default)s)")
    parser.add_argument("--seconds", type=above_zero, default=6.0, help="how long the film takes (default: %(default)s)")
    parser.add_argument("--bytes", type=count_of(1000, 10**12), metavar="N", help="take fewer colours until the film has no more bytes than that")
    parser.add_argument("--jobs", type=count, default=os.cpu_count() or 1, metavar="N", help="frames that are drawn at once (default: one a core)")
    parser.add_argument("--log", metavar="FILE", help="the log, if it is not log.lammps")
    return parser


_draw: Callable[[int], Image.Image]    # of the processes that on_cores starts


def _drawn(k: int) -> Image.Image:
    return _draw(k)


def _let_the_parent_stop() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def on_cores(draw: Callable[[int], Image.Image], count: int, jobs: int) -> Iterator[Image.Image]:
    """Pictures 0 to count - 1 in their order; `jobs` processes draw them."""
    global _draw
    if min(jobs, count) < 2 or "fork" not in multiprocessing.get_all_start_methods():
        yield from map(draw, range(count))
        return
    _draw = draw
    jobs = min(jobs, count)
    with concurrent.futures.ProcessPoolExecutor(jobs, multiprocessing.get_context("fork"), _let_the_parent_stop) as pool:
        try:
            yield from pool.map(_drawn, range(count), chunksize=max(1, min(8, count // jobs)))
        except concurrent.futures.process.BrokenProcessPool:
            raise InputError(f"a process that drew was stopped, maybe for lack of memory: draw fewer frames at once, as with --jobs {jobs // 2}") from None
        finally:
            pool.shutdown(cancel_futures=True)


def write_film(frames: Sequence[Image.Image], path: pathlib.Path, milliseconds: int, most: float = math.inf, samples: Sequence[Image.Image] = ()) -> int:
    """Writes a GIF whose frames have the same colours, those of `samples` or of some frames: as many as keep it at `most` bytes, or 12. Returns how many."""
    samples = samples or frames[::max(1, len(frames) // 8)]
    sheet = Image.new("RGB", (samples[0].width, samples[0].height * len(samples)))
    for k, one in enumerate(samples):
        sheet.paste(one, (0, k * one.height))
    for colours in (256, 128, 96, 64, 48, 32, 24, 16, 12):
        palette = sheet.quantize(colours, kmeans=2)
        table = np.array(palette.getpalette()).reshape(-1, 3)
        table[table.sum(axis=1).argmax()] = PAPER    # the lightest, which else is a grey by some bits
        palette.putpalette(table.ravel().tolist())
        flat = [one.quantize(palette=palette, dither=Image.Dither.NONE) for one in frames]
        saved(flat[0], path, save_all=True, append_images=flat[1:], duration=milliseconds, loop=0, optimize=True)
        if path.stat().st_size <= most:
            break
    return colours


def saved(image: Image.Image, path: pathlib.Path, **more: Any) -> None:
    """Writes a file whole."""
    part = path.with_name(f"{path.stem}.part{path.suffix}")
    try:
        image.save(part, **more)
        part.replace(path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise InputError(f"{path} cannot be written: {error.strerror or error}") from None


def run(given: argparse.Namespace) -> None:
    output = pathlib.Path(given.output) if given.output else pathlib.Path(given.folder) / "film.gif"
    if output.suffix not in (".gif", ".png"):
        raise InputError(f"--output {output}: end the name in .gif or .png")
    if output.suffix == ".png" and output.name.count("*") != 1:
        raise InputError(f"--output {output}: give the name one *, which stands for the step: frame_*.png")
    notes: list[str] = []
    scene = scene_of(given, notes)
    for note in notes:
        print(note)
    pictures = on_cores(scene.picture, len(scene.steps), given.jobs)
    if output.suffix == ".png":
        for step, picture in zip(scene.steps, pictures):
            saved(picture, output.with_name(output.name.replace("*", f"{step:.0f}")))
        print(f"{output}: {len(scene.steps)} frame{'s' if len(scene.steps) > 1 else ''}")
    else:
        frames = list(pictures)
        colours = write_film(frames, output, max(20, round(1000 * given.seconds / len(frames))), given.bytes or math.inf)
        print(f"{output}: {len(frames)} frame{'s' if len(frames) > 1 else ''}, {colours} colours, {output.stat().st_size} bytes")


if __name__ == "__main__":
    sys.exit(run_command("film", options(), run))
