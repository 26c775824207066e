# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Makes one HTML file of a run: what to look at first, its numbers, plots, and a view of meshes and grains.

    python3 -m lsdcd.report FOLDER

doc/report.md of the sources says what the page shows."""
from __future__ import annotations

import argparse
import base64
import html
import http.server
import json
import math
import os
import pathlib
import sys
import time
import zlib
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _run_facts as facts, _run_files as files
from ._command import above_zero, run_command
from ._run_files import Array, Entry, Frame, Grains, InputError, Log, MeshWords, Surface, unit_text

HERE = pathlib.Path(__file__).resolve().parent
MOST_FRAMES = 60       # of the view
MOST_POINTS = 400      # of a plot
MESH_BYTES = 200e6     # of files of one mesh that are read
RANGE = 1e9            # of a field, from the largest number to the least that is not 0
QUANTILE = 0.98        # of the numbers that are not 0, at which colours end
FIXED = 90000          # bytes of a page without meshes and grains, roughly
BYTES_OF_GRAIN = 14    # in a frame, roughly
TRIES = 8              # to come below the size that is asked for


def packed(array: Array) -> str:
    return base64.b64encode(zlib.compress(np.ascontiguousarray(array).tobytes(), 9)).decode()


def codes_of(values: Array, largest: float) -> Array:
    """Numbers as 16 bits of their logarithm; those that are not above 0 are 0."""
    if not largest > 0:
        return np.zeros(values.shape, np.uint16)
    with np.errstate(divide="ignore", invalid="ignore"):
        codes = 65535 + np.log(np.where(values > 0, values, np.nan) / largest) * 65534 / math.log(RANGE)
    return np.where(values > 0, np.clip(np.round(codes), 1, 65535), 0).astype(np.uint16)


def colour_top(values: Array) -> float:
    """The number at which colours end."""
    above = values[values > 0]
    return float(np.quantile(above, QUANTILE)) if len(above) else 0.0


# ---- meshes ------------------------------------------------------------------------------


@dataclass
class Moving:
    """A mesh of the view, with its files."""
    name: str
    entries: list[Entry]
    surfaces: list[Surface]
    note: str = ""


def pose_between(a: Array, b: Array) -> tuple[Array, Array] | None:
    """Rotation and shift that take points a to b. None: no rigid motion does."""
    if a.shape != b.shape or not len(a):
        return None
    ca, cb = a.mean(axis=0), b.mean(axis=0)
    u, _, vt = np.linalg.svd((a - ca).T @ (b - cb))
    turn = vt.T @ np.diag([1, 1, np.sign(np.linalg.det(vt.T @ u.T))]) @ u.T
    shift = cb - turn @ ca
    off = np.abs(a @ turn.T + shift - b).max()
    return (turn, shift) if off <= 1e-5 * max(float(np.ptp(a, axis=0).max()), 1e-300) else None


def coarser(surface: Surface, cells: int) -> Surface:
    """A mesh whose corners are those of a lattice, so that small triangles fall together; each that is left has the largest numbers of
    those that fell on it."""
    low, size = surface.points.min(axis=0), max(float(np.ptp(surface.points, axis=0).max()), 1e-300)
    _, first, corner = np.unique(in_one(np.round((surface.points - low) / size * cells), cells + 1), return_index=True, return_inverse=True)
    triangles = corner[surface.triangles]
    kept = np.flatnonzero((triangles[:, 0] != triangles[:, 1]) & (triangles[:, 1] != triangles[:, 2]) & (triangles[:, 2] != triangles[:, 0]))
    _, one, group = np.unique(in_one(np.sort(triangles[kept], axis=1), len(first)), return_index=True, return_inverse=True)
    order = np.argsort(group, kind="stable")
    begins = np.searchsorted(group[order], np.arange(len(one)))
    merged = {name: np.maximum.reduceat(values[kept][order], begins) if len(one) else np.zeros(0) for name, values in surface.fields.items()}
    return Surface(surface.points[first], triangles[kept][one], merged)


def in_one(rows: Array, base: int) -> Array:
    """Rows of three whole numbers below a base as one number each."""
    a, b, c = rows.astype(np.int64).T
    return np.asarray((a * base + b) * base + c)


def thinned(entries: list[Any], most: int) -> list[Any]:
    """At most so many of a list, evenly, with its ends."""
    if len(entries) <= most:
        return entries
    return [entries[round(k)] for k in np.linspace(0, len(entries) - 1, max(most, 2))][-most:]


def mesh_words(folder: pathlib.Path, log: Log) -> list[MeshWords]:
    """Meshes of the log, and series that no mesh of it names."""
    found = list(log.meshes)
    named = {pathlib.Path(mesh.fields).name for mesh in found if mesh.fields}
    for list_file in sorted(folder.glob("*_series.pvd")):
        pattern = list_file.name.replace("_series.pvd", "_*.vtp")
        if pattern not in named:
            found.append(MeshWords(pattern, pattern.replace("_*.vtp", ""), pattern))
    return found


def still_mesh(folder: pathlib.Path, words: MeshWords, notes: list[str]) -> Moving | None:
    """A mesh without a series of files, where its words place it."""
    from . import Error, Mesh
    path = folder / words.file
    if not path.is_file():
        notes.append(f"mesh '{words.title}' is not drawn: it has no mesh_fields, and {words.file} is not in the folder")
        return None
    try:
        mesh = Mesh(path).arrays()
    except Error as error:
        notes.append(f"mesh '{words.title}' is not drawn: {error}")
        return None
    points = files.placed(np.asarray(mesh.vertices, float), words.placement)
    note = f"{words.title} is drawn where it began: mesh_fields shows where it is and what it feels" if words.moves else ""
    return Moving(words.title, [], [Surface(points, mesh.faces.astype(np.int64), {})], note)


def moving_meshes(folder: pathlib.Path, log: Log, most: int, notes: list[str]) -> list[Moving]:
    """Meshes of the view, with at most so many files of each."""
    found = []
    for words in mesh_words(folder, log):
        entries = files.series_of(folder, words.fields, log) if words.fields else []
        fits = int(MESH_BYTES / max([entry.path.stat().st_size for entry in entries], default=1))
        if fits < min(most, len(entries)):
            notes.append(f"of the {len(entries)} large files of mesh '{words.title}' {max(fits, 2)} are shown")
        entries = thinned(entries, min(most, max(fits, 2)))
        mesh = Moving(words.title, [], [])
        for entry in entries:
            try:
                surface = files.read_vtp(entry.path)
            except InputError as error:
                notes.append(f"left out: {error}")
                continue
            if mesh.surfaces and len(surface.triangles) != len(mesh.surfaces[0].triangles):
                notes.append(f"left out: {entry.path.name} has another number of triangles than {mesh.entries[0].path.name}")
                continue
            mesh.entries.append(entry)
            mesh.surfaces.append(surface)
        if mesh.surfaces:
            found.append(mesh)
        else:
            still = still_mesh(folder, words, notes) if words.file != words.fields else None
            if still:
                found.append(still)
    return found


def coarse_meshes(meshes: list[Moving], triangles: int) -> tuple[list[Moving], list[str]]:
    """Meshes of at most so many triangles each, and what is to be said of them."""
    found, said = [], []
    for mesh in meshes:
        n, cells, first = len(mesh.surfaces[0].triangles), int(3 * math.sqrt(triangles)), mesh.surfaces[0]
        while n > triangles and cells > 4:
            first = coarser(mesh.surfaces[0], cells)
            if len(first.triangles) <= triangles:
                break
            cells = int(cells * min(0.8, math.sqrt(triangles / max(len(first.triangles), 1)) * 1.05))
        if first is mesh.surfaces[0]:
            found.append(mesh)
            continue
        shown = [first, *(_as_first(mesh.surfaces[0], surface, cells) for surface in mesh.surfaces[1:])]
        said.append(f"{mesh.name} is drawn with {len(first.triangles)} of its {n} triangles")
        found.append(Moving(mesh.name, mesh.entries, shown, mesh.note))
    return found, said


def _as_first(first: Surface, surface: Surface, cells: int) -> Surface:
    """A later mesh made coarse as the first one is: the same corners fall together, and they move as the first of each does."""
    made = coarser(Surface(first.points, first.triangles, surface.fields), cells)
    low, size = first.points.min(axis=0), max(float(np.ptp(first.points, axis=0).max()), 1e-300)
    corner = np.unique(in_one(np.round((first.points - low) / size * cells), cells + 1), return_index=True)[1]
    return Surface(surface.points[corner], made.triangles, made.fields)


def mesh_data(mesh: Moving, log: Log) -> dict[str, Any]:
    first = mesh.surfaces[0]
    low, size = first.points.min(axis=0), np.ptp(first.points, axis=0)
    frames = []
    for surface in mesh.surfaces:
        pose = pose_between(first.points, surface.points)
        if pose is None:
            low, size = np.minimum(low, surface.points.min(axis=0)), None
        frames.append(pose)
    if size is None:
        high = np.max([surface.points.max(axis=0) for surface in mesh.surfaces], axis=0)
        low = np.min([surface.points.min(axis=0) for surface in mesh.surfaces], axis=0)
        size = high - low
    size = np.where(size > 0, size, 1.0)

    def places(points: Array) -> str:
        return packed(np.round((points - low) / size * 65535).astype(np.uint16))

    wide = len(first.points) > 65535
    fields = {}
    for name in first.fields:
        values = np.array([surface.fields.get(name, np.zeros(len(first.triangles))) for surface in mesh.surfaces])
        largest = float(np.nanmax(values, initial=0.0))
        if largest > 0:
            fields[name] = {"unit": unit_text(files.OF_FIELDS.get(name, ""), log.units), "largest": largest, "top": colour_top(values),
                            "codes": packed(codes_of(values, largest))}
    return {"name": mesh.name, "n": len(first.triangles), "low": low.tolist(), "size": size.tolist(), "points": places(first.points),
            "triangles": packed(first.triangles.astype(np.uint32 if wide else np.uint16)), "wide": wide, "fields": fields,
            "frames": [{"pose": None if pose is None else [*np.round(pose[0].ravel(), 9).tolist(), *pose[1].tolist()],
                        "points": places(surface.points) if pose is None else None} for pose, surface in zip(frames, mesh.surfaces)]}


# ---- the view ----------------------------------------------------------------------------


def nearest_of(steps: list[float], wanted: list[float]) -> list[int]:
    """For each wanted step the place of the closest one."""
    have = np.array(steps, float)
    return [int(np.abs(have - step).argmin()) for step in wanted]


def steps_of_view(meshes: list[Moving], grains: list[Grains], most: int) -> list[float]:
    """The steps of the slider: those of the series with the most files, of meshes or of grains."""
    series: list[list[float]] = [[entry.step for entry in mesh.entries] for mesh in meshes] + [[float(one.step) for one in grains]]
    longest = max(series, key=len)
    if not longest:
        return [0.0] if meshes else []
    return thinned(longest, most)


def read_all_grains(frames: list[Frame], most: int, notes: list[str]) -> list[Grains]:
    """Grains of all snapshots that are whole: the same ones of each, some `most` of the largest."""
    share = most / max([frame.n for frame in frames] + [1])
    found = []
    for frame in frames:
        try:
            grains = files.read_grains(frame, share)
        except InputError as error:
            notes.append(f"left out: {error}")
            return []
        if grains is None:
            notes.append(f"left out: the snapshot of step {frame.step} in {frame.path.name} is not whole")
        else:
            found.append(grains)
    return found


def grains_data(read: list[Grains], most: int, log: Log) -> dict[str, Any] | None:
    """What the page has of grains, some `most` of the largest snapshot. None: there are none."""
    largest_n = max([grains.of for grains in read], default=0)
    shown = [grains.share(most / largest_n) if largest_n > most else grains for grains in read]
    some = [grains for grains in shown if len(grains.place)]
    if not some:
        return None
    low = np.min([grains.place.min(axis=0) for grains in some], axis=0)
    high = np.max([grains.place.max(axis=0) for grains in some], axis=0)
    size = np.where(high > low, high - low, 1.0)
    largest = max(float(grains.radius.max()) for grains in some) or 1.0
    speeds = np.concatenate([grains.speed for grains in some])
    fastest = float(speeds.max())
    ways = [way for way, is_known in (("speed", any(grains.velocity for grains in some)),
                                      ("size", any(np.ptp(grains.radius) > 1e-9 * largest for grains in some)),
                                      ("kind", any(np.ptp(grains.kind) > 0 for grains in some))) if is_known]
    frames = [{"n": len(g.place), "codes": packed(np.vstack([((g.place - low) / size * 65535).round().T, (g.radius / largest * 65535).round(),
                                                             codes_of(g.speed, fastest), g.kind]).astype(np.uint16))} for g in shown]
    return {"low": low.tolist(), "size": size.tolist(), "largest": largest, "largest_speed": fastest, "top_speed": colour_top(speeds) or 1.0,
            "speed_unit": unit_text("velocity", log.units), "size_unit": unit_text("distance", log.units), "ways": ways, "frames": frames,
            "drawn": max(len(grains.place) for grains in shown), "reach": [(low - largest).tolist(), (high + largest).tolist()]}


EMPTY = ("There is nothing to draw: the keyword mesh_fields wall_*.vtp every N of fix wall/lsdcd writes meshes, and "
         "dump ID all custom N grains.dump id type x y z vx vy vz radius writes grains.")


@dataclass
class Amount:
    """How much of a run the page shows."""
    frames: int
    triangles: int
    grains: int

    def less(self, share: float) -> Amount:
        frames = max(2, int(self.frames * max(share ** 0.2, 0.5)))
        return Amount(frames, max(200, int(self.triangles * max(share ** 0.5, 0.4))), max(50, int(self.grains * max(share ** 0.6, 0.3))))


def view_data(meshes: list[Moving], grains: list[Grains], amount: Amount, log: Log) -> dict[str, Any]:
    steps = steps_of_view(meshes, grains, amount.frames)
    shown, said = coarse_meshes([_at_steps(mesh, steps) for mesh in meshes], amount.triangles)
    chosen = [grains[k] for k in sorted(set(nearest_of([one.step for one in grains], steps)))] if grains else []
    of_grains = grains_data(chosen, amount.grains, log)
    bounds = [np.array([surface.points.min(axis=0), surface.points.max(axis=0)]) for mesh in shown for surface in mesh.surfaces]
    if of_grains:
        bounds.append(np.array(of_grains["reach"]))
        of_grains["at"] = nearest_of([one.step for one in chosen], steps)
        n = max(one.of for one in chosen)
        if of_grains["drawn"] < n:
            said.append(f"of {n} grains {of_grains['drawn']} are drawn")
    made = []
    for mesh in shown:
        its = mesh_data(mesh, log)
        its["at"] = nearest_of([entry.step for entry in mesh.entries], steps) if mesh.entries else [0] * len(steps)
        made.append(its)
    said += [mesh.note for mesh in shown if mesh.note]
    return {"times": log.times(np.array(steps, float)).tolist() if bounds else [], "steps": steps,
            "low": np.min([b[0] for b in bounds], axis=0).tolist() if bounds else [0, 0, 0],
            "high": np.max([b[1] for b in bounds], axis=0).tolist() if bounds else [1, 1, 1],
            "meshes": made, "grains": of_grains, "thinned": "; ".join(said), "empty": EMPTY}


def _at_steps(mesh: Moving, steps: list[float]) -> Moving:
    """A mesh with those of its files alone that the slider shows."""
    if not mesh.entries:
        return mesh
    kept = sorted(set(nearest_of([entry.step for entry in mesh.entries], steps)))
    return Moving(mesh.name, [mesh.entries[k] for k in kept], [mesh.surfaces[k] for k in kept], mesh.note)


# ---- plots -------------------------------------------------------------------------------


def plots_data(all_series: list[facts.Series], log: Log) -> tuple[list[dict[str, Any]], list[str]]:
    """Plots, and the axes of times that their series share. Of more rows than a plot has points the least, mean and largest of each point
    are kept."""
    axes: dict[str, int] = {}
    plots = []
    for title, group in facts.plots_of(all_series):
        series = []
        for label, one in zip(facts.labels_of(group), group):
            order = np.argsort(one.times, kind="stable")
            x, y = one.times[order], one.values[order]
            made: dict[str, Any] = {"name": label}
            if len(x) > MOST_POINTS:
                parts = [(x[k], y[k]) for k in np.array_split(np.arange(len(x)), MOST_POINTS)]
                parts = [(a, b[np.isfinite(b)]) for a, b in parts if np.isfinite(b).any()]
                x, y = np.array([a.mean() for a, _ in parts]), np.array([b.mean() for _, b in parts])
                made["low"] = packed(np.array([b.min() for _, b in parts], "<f4"))
                made["high"] = packed(np.array([b.max() for _, b in parts], "<f4"))
            made["axis"] = axes.setdefault(packed(x.astype("<f8")), len(axes))
            made["mean"] = packed(y.astype("<f4"))
            series.append(made)
        plots.append({"title": title, "unit": unit_text(group[0].column.kind, log.units), "series": series})
    return plots, list(axes)


# ---- the page ----------------------------------------------------------------------------


def page_of(data: dict[str, Any]) -> str:
    """The page with its data. They are JSON, which ends no script."""
    words = json.dumps(data, separators=(",", ":"), ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")
    before, rest = (HERE / "report_page.html").read_text(encoding="utf-8").split("@DATA@")
    before = before.replace("@TITLE@", html.escape(f"{data['title']}: lsdcd report"), 1)
    middle, after = rest.split("@SCRIPT@")
    return before + words + middle + (HERE / "report_page.js").read_text(encoding="utf-8") + after


def window_of(log: Log) -> str:
    return "Means are those of the second half of the rows, ± two standard errors (of ten blocks). Below a sum since the beginning is how fast it rises there."


def report(folder: str | os.PathLike[str], megabytes: float = 0.95, follow: float = 0, log_name: str | None = None) -> str:
    """The page of the run in a folder, of at most so many megabytes where that can be. `follow`: after how many seconds the page loads
    itself again while the run goes on; 0: never. Raises InputError for a folder without a run."""
    path = pathlib.Path(folder)
    log = files.read_log(files.find_log(path, log_name))
    if not log.segments and not log.facts and not log.settings:
        raise InputError(f"{log.path} is no log of LAMMPS, or has no line yet: it has neither a command nor a row of thermo output")
    notes: list[str] = []
    all_series = facts.series_of_log(log) + facts.series_of_averages(path, log, notes) + facts.series_of_passages(path, notes)
    plots, axes = plots_data(all_series, log)
    numbers = [row for row in (facts.number_of(series, log) for series in all_series) if row]
    step = log.last_step()
    data: dict[str, Any] = {
        "title": path.resolve().name, "log": log.path.name, "written": time.strftime("%Y-%m-%d %H:%M:%S"),
        "state": "ended with an error" if log.has_error else "finished" if log.done else "running or stopped", "done": log.done, "step": int(step),
        "target": log.target or 0, "follow": 0 if log.done else follow, "time_unit": log.time_unit, "energy_unit": unit_text("energy", log.units),
        "checks": facts.checks_of(log, all_series), "numbers": numbers, "window": window_of(log), "plots": plots, "axes": axes,
        "spectra": facts.spectra_of(path, log, notes), "warnings": log.warnings[:50], "n_warnings": len(log.warnings),
        "settings": log.settings[:200], "facts": log.facts[:100]}
    if not numbers:
        notes.append("the log has no row of thermo output yet")
    meshes = moving_meshes(path, log, MOST_FRAMES, notes)
    dump = files.grain_frames(path, log, notes)
    return sized(data, meshes, dump, megabytes, log, notes)


def sized(data: dict[str, Any], meshes: list[Moving], dump: list[Frame], megabytes: float, log: Log, notes: list[str]) -> str:
    """The page with as much of meshes and grains as its size allows."""
    most = int(megabytes * 1e6)
    n_frames = min(MOST_FRAMES, max([len(dump), *(len(mesh.entries) for mesh in meshes), 1]))
    amount = Amount(n_frames, max(2000, most // 60), max(200, min(100000, (most - FIXED) // (BYTES_OF_GRAIN * n_frames))))
    wanted = [entry.step for entry in max(meshes, key=lambda mesh: len(mesh.entries)).entries] if meshes else []
    wanted = wanted if len(wanted) >= len(dump) else thinned([float(frame.step) for frame in dump], MOST_FRAMES)
    frames = [dump[k] for k in sorted(set(nearest_of([frame.step for frame in dump], wanted)))] if dump else []
    grains = read_all_grains(frames, amount.grains, notes)
    data["notes"] = list(dict.fromkeys(notes))
    page = ""
    for _ in range(TRIES):
        data["view"] = view_data(meshes, grains, amount, log)
        page = page_of(data)
        size = len(page.encode())
        if size <= most:
            return page
        amount = amount.less(most / size)
    return page


def write(text: str, path: pathlib.Path) -> None:
    """Writes a file whole, so that a browser never reads half of it."""
    part = path.with_name(f"{path.name}.part-{os.getpid()}")
    try:
        part.write_text(text, encoding="utf-8")
        part.replace(path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise InputError(f"{path} cannot be written: {error.strerror}") from None


# ---- the command -------------------------------------------------------------------------


HELP = """Makes one HTML file of a run of LAMMPS with LSDCD: what to look at first, named numbers with units and errors, plots, and a view of
meshes and grains that a pointer turns. The file needs nothing else: no network, no server, no other file.

What it reads of the folder, as far as it is there and whole:
  log.lammps              thermo output, warnings, settings
  mesh_fields FILE.vtp    meshes, coloured by stress, wear, impacts, dissipated energy
  dump ... custom         grains: id type x y z vx vy vz radius
  fix ave/time ... file   means
  impact_spectrum         how often meshes and grains are hit, and how hard
  massflow/lsdcd file     what has passed"""
EXAMPLE = """Example:
  lsdcd report .

While a run goes on, --follow 30 writes the file again every 30 s, and the page in the browser loads itself again; --serve 8000 shows it at
http://127.0.0.1:8000 instead, made anew for each load. From your own computer: ssh -L 8000:127.0.0.1:8000 HOST"""


def port(word: str) -> int:
    if not word.isdigit() or not 1 <= int(word) <= 65535:
        raise argparse.ArgumentTypeError(f"'{word}' is no port, which is a whole number from 1 to 65535")
    return int(word)


def options() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("lsdcd report", description=HELP, epilog=EXAMPLE, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="the folder of the run")
    parser.add_argument("-o", "--output", metavar="FILE", help="the page (default: report.html in the folder)")
    parser.add_argument("--log", metavar="FILE", help="the log, if it is not log.lammps")
    parser.add_argument("--megabytes", type=above_zero, default=0.95, metavar="N",
                        help="how large the page may be: frames, grains and small triangles are left out for that (default: %(default)s)")
    live = parser.add_mutually_exclusive_group()
    live.add_argument("--follow", type=above_zero, metavar="SECONDS", help="write the page again until the run ends")
    live.add_argument("--serve", type=port, metavar="PORT", help="show the page at http://127.0.0.1:PORT, on this computer alone")
    return parser


def serve(given: argparse.Namespace) -> None:
    """Answers a browser on this computer, until it is interrupted."""
    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            if self.path.split("?")[0] not in ("/", "/index.html"):
                self.send_error(404)
                return
            try:
                text, code = report(given.folder, given.megabytes, 10, given.log), 200
            except InputError as error:
                text, code = f"<!doctype html><title>lsdcd report</title><p>{html.escape(str(error))}", 503
            body = text.encode()
            self.send_response(code)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.send_header("Content-Length", str(len(body)))
            self.send_header("Cache-Control", "no-store")
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, format: str, *args: Any) -> None:
            pass

    try:
        server = http.server.ThreadingHTTPServer(("127.0.0.1", given.serve), Handler)
    except OSError as error:
        raise InputError(f"--serve {given.serve}: {error.strerror}; choose another port") from None
    print(f"http://127.0.0.1:{given.serve}/    Ctrl-C ends it", flush=True)
    with server:
        server.serve_forever()


def follow(given: argparse.Namespace, output: pathlib.Path) -> None:
    """Writes the page again and again until the run has ended. A folder that has no log yet is waited for."""
    while True:
        ended = False
        try:
            text = report(given.folder, given.megabytes, given.follow, given.log)
            write(text, output)
            ended = '"done":true' in text
            print(f"{time.strftime('%H:%M:%S')} {output}: {len(text.encode()) / 1e6:.2f} MB", flush=True)
        except InputError as error:
            print(f"{time.strftime('%H:%M:%S')} {error}", flush=True)
        if ended:
            return
        time.sleep(given.follow)


def run(given: argparse.Namespace) -> None:
    folder = pathlib.Path(given.folder)
    output = pathlib.Path(given.output) if given.output else folder / "report.html"
    if output.suffix not in (".html", ".htm"):
        raise InputError(f"--output {output}: end the name in .html")
    if given.serve:
        serve(given)
    elif given.follow:
        follow(given, output)
    else:
        text = report(folder, given.megabytes, 0, given.log)
        write(text, output)
        print(f"{output}: {len(text.encode()) / 1e6:.2f} MB")


if __name__ == "__main__":
    sys.exit(run_command("report", options(), run))
