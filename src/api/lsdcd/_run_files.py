# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Reads what a run of LAMMPS writes: its log, averages, dumps, and the files of LSDCD. A file that is still being written is read as far
as it is whole; what cannot be read is an InputError, with the file, the place and a remedy."""
from __future__ import annotations

import base64
import csv
import gzip
import math
import os
import pathlib
import re
import shlex
import zlib
from dataclasses import dataclass, field
from typing import Any, BinaryIO, Iterator, cast

import numpy as np
from numpy.typing import NDArray

from ._style_outputs import STYLE_OUTPUTS

Array = NDArray[Any]
MARK = b"ITEM: TIMESTEP"
BLOCK = 1 << 22    # bytes that are read at once


class InputError(Exception):
    """A file or word that cannot be used."""


# ---- numbers and their names -------------------------------------------------------------


# What a kind of unit is in each of LAMMPS's units that have names of their own.
UNITS = {
    "si": {"force": "N", "torque": "N m", "energy": "J", "energy/time": "W", "distance": "m", "velocity": "m/s", "volume": "m³", "mass": "kg",
           "mass/time": "kg/s", "pressure": "Pa", "time": "s", "radians": "rad", "radians/time": "rad/s"},
    "cgs": {"force": "dyn", "torque": "dyn cm", "energy": "erg", "energy/time": "erg/s", "distance": "cm", "velocity": "cm/s", "volume": "cm³",
            "mass": "g", "mass/time": "g/s", "pressure": "dyn/cm²", "time": "s", "radians": "rad", "radians/time": "rad/s"},
    "micro": {"force": "pg µm/µs²", "torque": "pg µm²/µs²", "energy": "pg µm²/µs²", "energy/time": "pg µm²/µs³", "distance": "µm",
              "velocity": "µm/µs", "volume": "µm³", "mass": "pg", "mass/time": "pg/µs", "pressure": "pg/(µm µs²)", "time": "µs", "radians": "rad",
              "radians/time": "rad/µs"}}
# Units of LAMMPS's own columns.
OF_LAMMPS = {"Time": "time", "KinEng": "energy", "PotEng": "energy", "TotEng": "energy", "Volume": "volume", "Press": "pressure"}
# Of the fields in files of mesh_fields, as doc/wall_output.rst has them.
OF_FIELDS = {"normal_stress": "pressure", "shear_stress": "pressure", "force": "force", "worn_volume": "volume", "worn_depth": "distance",
             "dissipated_energy": "energy", "impact_energy": "energy", "impact_speed": "velocity"}


def unit_text(kind: str, units: str) -> str:
    """The name of a kind of unit, as "force units", in LAMMPS's `units`; the kind itself where it has no name there."""
    plain = kind.split(";")[0].replace(" units", "").strip()
    return UNITS.get(units, {}).get(plain, plain)


def elements_of(style: str) -> list[tuple[str, str, str]]:
    """(name, kind of unit, what it is) of the numbers of a style, in the order of their elements; of a wall and a compute the last is the
    scalar. Empty: the style is none of LSDCD's."""
    plain = re.sub(r"(/kk|/host|/device)+$", "", style)
    if plain == "wall/lsdcd":
        from . import OUTPUTS
        return [(name, *facts) for name, facts in OUTPUTS.items()]
    return STYLE_OUTPUTS.get(plain, [])


HAVE_SCALAR = ("wall/lsdcd", "lsdcd/energy", "lsdcd/collide")
OTHER_ARRAYS = ("lsdcd/impacts", "lsdcd/collide")    # whose columns are not the elements of the vector


@dataclass
class Column:
    """A series of numbers: what it is, and where it comes from."""
    head: str             # as the file has it: "f_mill[70]"
    name: str             # "drive_work"
    owner: str = ""       # "fix mill", "mesh 2 of fix mill"
    kind: str = ""        # of unit, as in the tables
    meaning: str = ""
    source: str = "log"   # "log" or the file

    @property
    def is_of_lsdcd(self) -> bool:
        return bool(self.owner)


# ---- the log -----------------------------------------------------------------------------


@dataclass
class MeshWords:
    """A mesh of a fix wall/lsdcd, as its words name it."""
    file: str
    name: str = ""
    fields: str = ""      # of mesh_fields
    spectrum: str = ""    # of impact_spectrum
    moves: bool = False
    placement: list[tuple[str, list[float]]] = field(default_factory=list)

    @property
    def title(self) -> str:
        return self.name or pathlib.Path(self.file).stem


@dataclass
class Log:
    """What a log says. Rows of several runs follow one another."""
    path: pathlib.Path
    units: str = "lj"
    dt: float = math.nan
    done: bool = False
    styles: dict[str, list[str]] = field(default_factory=dict)     # of f_ID and c_ID: the style and its words
    prefixes: dict[str, tuple[str, str]] = field(default_factory=dict)    # of names: f_ID or c_ID, and the mesh or type
    formulas: dict[str, str] = field(default_factory=dict)         # of equal-style variables
    dumps: list[str] = field(default_factory=list)
    meshes: list[MeshWords] = field(default_factory=list)
    settings: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    facts: list[str] = field(default_factory=list)                 # lines of LSDCD behind the loops
    segments: list[tuple[list[str], float, list[list[float]]]] = field(default_factory=list)
    target: int | None = None                                      # the step at which the last run command ends
    has_error: bool = False
    dangerous: int = 0                                             # builds of neighbor lists that LAMMPS calls so

    def columns(self) -> list[str]:
        return list(dict.fromkeys(name for heads, _, rows in self.segments if rows for name in heads))

    def table(self) -> dict[str, Array]:
        """Numbers of each column, row by row, with nan where a run does not have it. The first row of a run is left out where it repeats the
        last step of the one before."""
        heads = self.columns()
        found: list[list[float]] = []
        last = math.nan
        for names, _, rows in self.segments:
            at = {name: k for k, name in enumerate(names)}
            step = at.get("Step", -1)
            for number, row in enumerate(rows):
                if number == 0 and step >= 0 and row[step] == last and found:
                    found[-1] = [row[at[h]] if h in at else old for h, old in zip(heads, found[-1])]
                    continue
                found.append([row[at[h]] if h in at else math.nan for h in heads])
            if rows and step >= 0:
                last = rows[-1][step]
        table = np.array(found, float).reshape(len(found), len(heads))
        return {h: table[:, k] for k, h in enumerate(heads)}

    def times(self, steps: Array) -> Array:
        """The time of steps: by the column Time where there is one, else by the timestep; without both the steps."""
        steps = np.asarray(steps, float)
        table = self.table()
        if "Time" in table and "Step" in table and len(table["Step"]):
            known = np.isfinite(table["Time"]) & np.isfinite(table["Step"])
            s, t = table["Step"][known], table["Time"][known]
            if len(s) and np.all(np.diff(s) > 0):
                dt = self.dt if math.isfinite(self.dt) else 0.0
                inside = np.interp(steps, s, t)
                return np.where(steps > s[-1], t[-1] + (steps - s[-1]) * dt, np.where(steps < s[0], t[0] + (steps - s[0]) * dt, inside))
        return steps * self.dt if math.isfinite(self.dt) else steps

    @property
    def time_unit(self) -> str:
        return unit_text("time", self.units) if math.isfinite(self.dt) else "steps"

    def last_step(self) -> float:
        for names, _, rows in reversed(self.segments):
            if rows and "Step" in names:
                return rows[-1][names.index("Step")]
        return 0.0


def _numbers(words: list[str]) -> list[float] | None:
    try:
        return [float(word) for word in words]
    except ValueError:
        return None


def _words(line: str) -> list[str]:
    """Words of a command, without its comment."""
    try:
        return shlex.split(line, comments=True, posix=True)
    except ValueError:
        return line.split()


def read_log(path: pathlib.Path) -> Log:
    """Reads a log as far as it is whole. A line without an end is left out, as LAMMPS may be writing it."""
    log = Log(path)
    heads: list[str] = []
    joined = ""
    try:
        with open(path, encoding="utf-8", errors="replace") as lines:
            for line in lines:
                if not line.endswith("\n"):
                    break
                line = line[:-1]
                heads = _thermo_line(log, line, heads)
                if heads and log.segments and log.segments[-1][0] is heads and _is_row(line, heads):
                    continue
                joined += line[:-1] + " " if line.endswith("&") else line
                if not line.endswith("&"):
                    _command(log, joined)
                    joined = ""
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}") from None
    return log


def _is_row(line: str, heads: list[str]) -> bool:
    words = line.split()
    return len(words) == len(heads) and _numbers(words) is not None


def _thermo_line(log: Log, line: str, heads: list[str]) -> list[str]:
    """Takes a line that may be of a table, or be told to the user. Returns the columns of the table that goes on."""
    words = line.split()
    if words[:1] == ["Step"] and len(words) == len(set(words)) or words[:1] == ["Step"] and heads == words:
        if log.segments and not log.segments[-1][2]:
            log.segments.pop()
        log.segments.append((words, log.dt, []))
        return words
    if line.startswith("Loop time of"):
        return []
    if heads and len(words) == len(heads):
        row = _numbers(words)
        if row is not None:
            log.segments[-1][2].append(row)
            return heads
    if line.startswith(("WARNING", "ERROR")):
        log.warnings.append(line.strip())
        log.has_error = log.has_error or line.startswith("ERROR")
        log.done = log.done or line.startswith("ERROR")
    elif line.startswith("Dangerous builds = ") and words[-1].isdigit():
        log.dangerous += int(words[-1])
    elif line.startswith("Total wall time"):
        log.done = True
        log.facts.append(line)
    elif "/lsdcd: " in line or line.startswith("Pair style granular/lsdcd"):
        log.facts.append(line)
    return heads


def _command(log: Log, line: str) -> None:
    """Takes a command as the log repeats it. One with a variable stands there again with its value."""
    if "$" in line or not line[:1].islower():
        return
    words = _words(line)
    if not words:
        return
    command, n = words[0], len(words)
    if command in ("fix", "pair_style", "pair_coeff", "timestep", "units", "neighbor", "region", "compute", "fix_modify", "run"):
        log.settings.append(" ".join(words))
    if command == "units" and n > 1:
        log.units = words[1]
        if math.isnan(log.dt) and words[1] in ("si", "cgs"):
            log.dt = 1e-8
    elif command == "timestep" and n > 1:
        dt = _numbers(words[1:2])
        log.dt = dt[0] if dt else log.dt
    elif command == "run" and n > 1 and words[1].isdigit():
        log.target = int(words[1]) + (0 if "upto" in words else int(log.last_step()))
    elif command in ("fix", "compute") and n > 3:
        key = ("f_" if command == "fix" else "c_") + words[1]
        log.styles[key] = words[3:]
        if re.match(r"wall/lsdcd(/|$)", words[3]):
            log.meshes += meshes_of(words[4:])
        if "names" in words[4:] and elements_of(words[3]) and n > words.index("names") + 1 and command == "compute":
            log.prefixes[words[words.index("names") + 1]] = (key, "")
    elif command == "fix_modify" and "names" in words:
        at = words.index("names")
        of = words[at - 1] if at > 3 and words[at - 2] in ("mesh", "type") else ""
        if n > at + 1 and "f_" + words[1] in log.styles:
            log.prefixes[words[at + 1]] = ("f_" + words[1], f"{words[at - 2]} {of}" if of else "")
    elif command == "fix_modify" and n > 5 and words[2] == "mesh" and words[4] == "motion":
        for k, mesh in enumerate(log.meshes, 1):
            if words[3] in (str(k), mesh.name, mesh.file):
                mesh.moves = True
    elif command == "variable" and n > 3 and words[2] == "equal":
        log.formulas[words[1]] = "".join(words[3:])
    elif command == "dump" and n > 5:
        log.dumps.append(words[5])


PLACING = {"scale": (1, 3), "rotate": (4, 4), "move": (3, 3), "matrix": (12, 12)}


def meshes_of(words: list[str]) -> list[MeshWords]:
    """The meshes in the words of a fix wall/lsdcd."""
    found: list[MeshWords] = []
    for at, word in enumerate(words[:-1]):
        if word == "mesh":
            found.append(MeshWords(words[at + 1]))
        elif found and word == "name":
            found[-1].name = words[at + 1]
        elif found and word == "mesh_fields":
            found[-1].fields = words[at + 1]
        elif found and word == "impact_spectrum":
            found[-1].spectrum = words[at + 1]
        elif found and word in ("motion", "body", "servo", "wiggle", "nodes"):
            found[-1].moves = True
        elif found and word in PLACING and words[at - 1] != "motion":
            least, most = PLACING[word]
            numbers = _numbers(words[at + 1:at + 1 + most]) or _numbers(words[at + 1:at + 1 + least])
            if numbers and len(numbers) >= least:
                found[-1].placement.append((word, numbers))
    return found


def placed(points: Array, placement: list[tuple[str, list[float]]]) -> Array:
    """Points (n, 3) after scale, rotate, move and matrix, in their order."""
    for word, v in placement:
        if word == "scale":
            points = points * np.array(v)
        elif word == "move":
            points = points + np.array(v)
        elif word == "matrix":
            m = np.array(v).reshape(3, 4)
            points = points @ m[:, :3].T + m[:, 3]
        else:
            axis = np.array(v[:3]) / (np.linalg.norm(v[:3]) or 1)
            c, s = math.cos(math.radians(v[3])), math.sin(math.radians(v[3]))
            points = points * c + np.cross(axis, points) * s + np.outer(points @ axis, axis) * (1 - c)
    return points


def column_of(log: Log, head: str, depth: int = 0) -> Column:
    """What a column of thermo output or of an average is."""
    found = re.fullmatch(r"([fcv]_)(\w+)((?:\[\d+\])*)", head)
    if not found:
        return Column(head, head, kind=OF_LAMMPS.get(head, ""))
    kind, name, brackets = found.groups()
    numbers = [int(k) for k in re.findall(r"\d+", brackets)]
    if kind == "v_":
        return _variable(log, head, name, depth)
    words = log.styles.get(kind + name, [])
    owner = f"{'fix' if kind == 'f_' else 'compute'} {name}"
    if words[:1] == ["ave/time"] and numbers and depth < 4:
        values = averaged(words)
        if 0 < numbers[-1] <= len(values):
            inner = column_of(log, values[numbers[-1] - 1], depth + 1)
            inner.head, inner.meaning = head, f"mean by fix {name} of {inner.meaning or inner.name}"
            return inner
    known = elements_of(words[0]) if words else []
    plain = re.sub(r"(/kk|/host|/device)+$", "", words[0]) if words else ""
    has_scalar = plain in HAVE_SCALAR
    if not known or not numbers and not has_scalar or len(numbers) == 2 and plain in OTHER_ARRAYS:
        return Column(head, head)
    if len(numbers) == 2:
        owner = f"{'type' if plain == 'massflow/lsdcd' else 'mesh'} {numbers[0]} of {owner}"
    element = numbers[-1] - 1 if numbers else len(known) - 1
    if not 0 <= element < len(known) - (has_scalar if numbers else 0):
        return Column(head, head)
    return Column(head, known[element][0], owner, known[element][1], known[element][2])


def _variable(log: Log, head: str, name: str, depth: int) -> Column:
    for prefix in sorted(log.prefixes, key=len, reverse=True):
        key, of = log.prefixes[prefix]
        rest = name[len(prefix) + 1:]
        if name.startswith(prefix + "_") and name not in log.formulas:
            for element, unit, meaning in elements_of(log.styles[key][0]):
                if element == rest:
                    owner = f"{'fix' if key[0] == 'f' else 'compute'} {key[2:]}"
                    return Column(head, element, f"{of} of {owner}" if of else owner, unit, meaning)
    formula = log.formulas.get(name)
    if formula and re.fullmatch(r"[fc]_\w+(\[\d+\]){0,2}", formula) and depth < 4:
        inner = column_of(log, formula, depth + 1)
        inner.head = head
        return inner
    return Column(head, name, meaning=f"= {formula}" if formula else "")


def averaged(words: list[str]) -> list[str]:
    """The values of a fix ave/time, by its words from the style on."""
    found = []
    for word in words[4:]:
        if not re.match(r"[fcv]_", word):
            break
        found.append(word)
    return found


# ---- files of rows -----------------------------------------------------------------------


def whole_lines(path: pathlib.Path) -> list[str]:
    """The lines of a text that have their ends."""
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}") from None
    return text.split("\n")[:-1]


def read_averages(path: pathlib.Path) -> tuple[list[str], Array]:
    """Columns of a file of fix ave/time, and its rows. Raises InputError for one that holds vectors."""
    heads: list[str] = []
    rows: list[list[float]] = []
    for number, line in enumerate(whole_lines(path), 1):
        if line.startswith("# TimeStep"):
            heads = line[2:].split()
        elif line.startswith("# Row") or "Number-of-rows" in line:
            raise InputError(f"{path.name} has vectors of fix ave/time, which are not drawn")
        elif line.strip() and not line.startswith("#"):
            row = _numbers(line.split())
            if row is None or heads and len(row) != len(heads):
                raise InputError(f"{path.name}:{number}: '{line[:60]}' is no row of {len(heads)} numbers")
            rows.append(row)
    if not heads:
        raise InputError(f"{path.name} has no line '# TimeStep ...', by which fix ave/time names its columns")
    return heads, np.array(rows, float).reshape(len(rows), len(heads))


SPECTRUM = "energy_from,energy_to,impacts,energy"
BETWEEN_GRAINS = f"type_i,type_j,{SPECTRUM},energy_i,energy_j"


def read_spectra(path: pathlib.Path) -> dict[str, list[list[float]]]:
    """Rows of a file of impact_spectrum, as SPECTRUM names them, by whose impacts they are: "" of a mesh, "types 1 and 2" of grains."""
    lines = whole_lines(path)
    if lines[:1] not in ([SPECTRUM], [BETWEEN_GRAINS]):
        raise InputError(f"{path.name}:1: the first line is neither '{SPECTRUM}' nor '{BETWEEN_GRAINS}'")
    n = lines[0].count(",") + 1
    found: dict[str, list[list[float]]] = {}
    for number, words in enumerate(csv.reader(lines[1:]), 2):
        row = _numbers(words)
        if row is None or len(row) != n:
            raise InputError(f"{path.name}:{number}: '{','.join(words)[:60]}' is no row of {n} numbers")
        if lines[0] == SPECTRUM:
            found.setdefault("", []).append(row)
        else:
            found.setdefault(f"types {row[0]:g} and {row[1]:g}", []).append(row[2:6])
    return found


def spectrum_of_grains(log: Log) -> str:
    """The name of the file in which a compute lsdcd/impacts has its spectrum; empty: there is none."""
    for words in log.styles.values():
        if words[0] == "lsdcd/impacts" and "impact_spectrum" in words[:-1]:
            return words[words.index("impact_spectrum") + 1]
    return ""


PASSAGES = "# step time id type diameter"


def read_passages(path: pathlib.Path) -> Array:
    """(time, direction) of each passage in a file of fix massflow/lsdcd."""
    lines = whole_lines(path)
    if not lines or not lines[0].startswith(PASSAGES):
        raise InputError(f"{path.name}:1: the first line is not '{PASSAGES} ...'")
    rows = []
    for number, line in enumerate(lines[1:], 2):
        row = _numbers(line.split())
        if row is None or len(row) != 12:
            raise InputError(f"{path.name}:{number}: '{line[:60]}' is no row of 12 numbers")
        rows.append((row[1], row[-1]))
    return np.array(rows, float).reshape(len(rows), 2)


# ---- meshes ------------------------------------------------------------------------------


KINDS = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1", "UInt32": "<u4"}


@dataclass
class Surface:
    points: Array               # (n, 3)
    triangles: Array            # (m, 3)
    fields: dict[str, Array]    # of triangles


def read_vtp(path: pathlib.Path) -> Surface:
    """Reads a file of mesh_fields. Raises InputError for one that is not whole or of another program."""
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise InputError(f"{path.name} cannot be read: {error.strerror}") from None
    if not text.rstrip().endswith("</VTKFile>"):
        raise InputError(f"{path.name} is not whole: its last line is not </VTKFile>; copy it again")
    arrays: dict[str, Array] = {}
    for kind, name, more, data in re.findall(r'<DataArray type="(\w+)" Name="([^"]+)"([^>]*)>([^<]*)<', text):
        components = re.search(r'NumberOfComponents="(\d+)"', more)
        try:
            numbers = np.frombuffer(base64.b64decode(data.strip(), validate=True)[8:], KINDS[kind])
        except (ValueError, KeyError):
            raise InputError(f"{path.name}: the array '{name}' is damaged, or not as mesh_fields writes it") from None
        arrays[name] = numbers.reshape(-1, int(components[1])) if components and int(components[1]) > 1 and numbers.size % int(components[1]) == 0 \
            else numbers
    if not {"points", "connectivity"} <= arrays.keys() or arrays["points"].ndim != 2 or arrays["connectivity"].size % 3:
        raise InputError(f"{path.name} has no triangles as mesh_fields writes them")
    triangles = arrays["connectivity"].reshape(-1, 3).astype(np.int64)
    if triangles.size and not 0 <= triangles.min() <= triangles.max() < len(arrays["points"]):
        raise InputError(f"{path.name}: a triangle has a corner that there is not")
    fields = {name: (np.linalg.norm(a, axis=1) if a.ndim == 2 else a).astype(float) for name, a in arrays.items()
              if len(a) == len(triangles) and name not in ("points", "connectivity", "offsets", "TimeValue", "step")}
    return Surface(arrays["points"].astype(float), triangles, fields)


@dataclass
class Entry:
    step: float
    time: float
    path: pathlib.Path


def step_in(name: str, pattern: str = "") -> float:
    """The step in the name of a file: what stands for * in `pattern`, or the last number."""
    if "*" in pattern:
        head, tail = pathlib.Path(pattern).name.split("*", 1)
        found = re.fullmatch(re.escape(head) + r"(\d+)" + re.escape(tail), name)
        if found:
            return float(found[1])
    numbers = re.findall(r"\d+", name.rsplit(".", 1)[0])
    return float(numbers[-1]) if numbers else 0.0


def series_of(folder: pathlib.Path, pattern: str, log: Log) -> list[Entry]:
    """Files of one mesh_fields: those that are there, in the order of their steps, with the times of their list."""
    path = folder / pattern
    listed: dict[str, float] = {}
    pvd = path.with_name(path.name.replace("*", "series")).with_suffix(".pvd")
    if pvd.is_file():
        text = pvd.read_text(encoding="utf-8", errors="replace")
        for time, name in re.findall(r'timestep="([^"]+)"[^>]*?file="([^"]+)"/>', text):
            number = _numbers([time])
            if number:
                listed[name.replace("&lt;", "<").replace("&quot;", '"').replace("&amp;", "&")] = number[0]
    if "*" not in path.name:
        there = [path] if path.is_file() else []
    else:
        head, tail = path.name.split("*", 1)
        there = [p for p in path.parent.iterdir() if re.fullmatch(re.escape(head) + r"\d+" + re.escape(tail), p.name)] \
            if path.parent.is_dir() else []
    if listed and there and "*" in path.name:    # what another run has left there is not in the list
        there = [p for p in there if p.name in listed] or there
    entries = [Entry(step_in(p.name, path.name) if "*" in path.name else log.last_step(), 0.0, p) for p in there]
    for entry in entries:
        entry.time = listed.get(entry.path.name, float(log.times(np.array([entry.step]))[0]))
    return sorted(entries, key=lambda e: e.step)


# ---- grains ------------------------------------------------------------------------------


@dataclass
class Frame:
    """Where a snapshot of a dump stands in its file."""
    step: int
    n: int
    box: Array                 # (3, 2)
    columns: list[str]
    path: pathlib.Path
    begin: int                 # of its rows, in bytes
    end: int
    binary: bool = False
    time: float | None = None


def _opened(path: pathlib.Path) -> BinaryIO:
    return cast(BinaryIO, gzip.open(path, "rb")) if path.suffix == ".gz" else open(path, "rb")


def _marks(file: BinaryIO) -> Iterator[int]:
    """Where snapshots begin."""
    at, rest = 0, b""
    while block := file.read(BLOCK):
        text = rest + block
        found = text.find(MARK)
        while found >= 0:
            if found == 0 and at == 0 or found > 0 and text[found - 1:found] == b"\n" or found == 0:
                yield at + found
            found = text.find(MARK, found + 1)
        keep = min(len(MARK) - 1, len(text))
        at += len(text) - keep
        rest = text[len(text) - keep:]
    yield at + len(rest)


def index_dump(path: pathlib.Path) -> list[Frame]:
    """Snapshots of a text dump, without their rows. What is cut off in the last one shows when it is read."""
    frames = []
    try:
        with _opened(path) as file:
            marks = list(_marks(file))
            for begin, end in zip(marks, marks[1:]):
                file.seek(begin)
                head = file.read(min(end - begin, 4096))
                frame = _head(path, head, begin, end)
                if frame:
                    frames.append(frame)
    except (OSError, EOFError, zlib.error) as error:
        raise InputError(f"{path.name} cannot be read: {error}") from None
    if not frames and marks == [0] and path.stat().st_size > 4096:
        raise InputError(f"{path.name} is no text dump of LAMMPS (dump ID group custom ...)")
    return frames


def _head(path: pathlib.Path, head: bytes, begin: int, end: int) -> Frame | None:
    """The frame of a snapshot. None: its head is not whole, or of no atoms' dump."""
    at = head.find(b"ITEM: ATOMS")
    stop = head.find(b"\n", at)
    if at < 0 or stop < 0:
        return None
    lines = head[:at].decode("ascii", "replace").splitlines()
    try:
        step = int(lines[lines.index("ITEM: TIMESTEP") + 1])
        n = int(lines[lines.index("ITEM: NUMBER OF ATOMS") + 1])
        bounds = next(k for k, line in enumerate(lines) if line.startswith("ITEM: BOX BOUNDS"))
        box = np.array([[float(word) for word in line.split()[:2]] for line in lines[bounds + 1:bounds + 4]]).reshape(3, 2)
    except (ValueError, StopIteration, IndexError):
        return None
    return Frame(step, n, box, head[at + 11:stop].decode("ascii", "replace").split(), path, begin + stop + 1, end)


def index_binary_dump(path: pathlib.Path) -> list[Frame]:
    """Snapshots of a binary dump, as LAMMPS writes it since 2020, without their rows and without one that is cut off."""
    frames: list[Frame] = []
    size = path.stat().st_size
    try:
        with open(path, "rb") as file:
            while file.tell() < size:
                frames.append(_binary_frame(path, file, size))
    except EOFError:    # the run goes on, or has been stopped
        pass
    except OSError as error:
        raise InputError(f"{path.name} cannot be read: {error}") from None
    return frames


def _binary_frame(path: pathlib.Path, file: BinaryIO, size: int) -> Frame:
    """The snapshot that begins here, up to its end. Raises EOFError where it is not whole."""
    def take(kind: str, count: int = 1) -> Array:
        length = np.dtype(kind).itemsize * count
        if not 0 <= length <= size - file.tell():
            raise EOFError
        return np.frombuffer(file.read(length), kind)

    magic = -int(take("<i8")[0])
    if not 0 < magic < 64 or not take("u1", magic).tobytes().startswith(b"DUMP") or int(take("<i4")[0]) != 1:
        raise InputError(f"{path.name} is no binary dump (dump ID group custom N FILE.bin ...) of a LAMMPS of 2020 or later")
    take("<i4")    # revision
    step, n = (int(number) for number in take("<i8", 2))
    tilted = int(take("<i4")[0])
    take("<i4", 6)    # kinds of boundaries
    box = take("<f8", 9 if tilted else 6)[:6].reshape(3, 2)
    width = int(take("<i4")[0])
    take("u1", int(take("<i4")[0]))    # units
    time = float(take("<f8")[0]) if take("u1")[0] else None
    columns = take("u1", int(take("<i4")[0])).tobytes().decode("ascii", "replace").split()
    if width != len(columns):
        raise InputError(f"{path.name} is damaged at step {step}: {width} columns with {len(columns)} names")
    begin = file.tell()
    for _ in range(int(take("<i4")[0])):    # processes, each with its rows
        numbers = int(take("<i4")[0])
        if not 0 <= 8 * numbers <= size - file.tell():
            raise EOFError
        file.seek(8 * numbers, 1)
    return Frame(step, n, box, columns, path, begin, file.tell(), True, time)


def lots(ids: Array) -> Array:
    """A number from 0 to 1 for each grain, by its id: those below a share are the same grains in each snapshot."""
    return (ids.astype(np.int64) * 2654435761 % 2 ** 32) / 2 ** 32


def read_rows(frame: Frame, wanted: list[str], share: float) -> tuple[dict[str, Array], Array] | None:
    """Columns of a share of the grains of a snapshot, in the order of their ids, and their lots. None: the snapshot is not whole."""
    if frame.binary:
        return _binary_rows(frame, wanted, share)
    with _opened(frame.path) as file:
        file.seek(frame.begin)
        text = file.read(frame.end - frame.begin)
    data = np.frombuffer(text, np.uint8)
    ends = np.flatnonzero(data == 10)
    if len(ends) < frame.n:
        return None
    if frame.n == 0:
        return {name: np.empty(0) for name in wanted}, np.empty(0)
    ends = ends[:frame.n]
    begins = np.concatenate([[0], ends[:-1] + 1])
    try:
        ids = _ids(frame, text, data, begins, ends)
        drawn = lots(ids)
        chosen = np.flatnonzero(drawn < share)
        chosen = chosen[np.argsort(ids[chosen], kind="stable")]
        rows = [text[begins[k]:ends[k]].split() for k in chosen]
        if any(len(row) != len(frame.columns) for row in rows):
            return None
        columns = {name: np.array([float(row[k]) for row in rows]) for name in wanted for k in [frame.columns.index(name)]}
    except (ValueError, IndexError):
        return None
    return columns, drawn[chosen]


def _binary_rows(frame: Frame, wanted: list[str], share: float) -> tuple[dict[str, Array], Array] | None:
    data, at, parts = np.fromfile(frame.path, "u1", frame.end - frame.begin, offset=frame.begin), 4, []
    while at + 4 <= len(data):
        end = at + 4 + 8 * int(data[at:at + 4].view("<i4")[0])
        parts.append(data[at + 4:end].tobytes())
        at = end
    numbers = np.frombuffer(b"".join(parts), "<f8")
    if len(numbers) != frame.n * len(frame.columns):
        return None
    rows = dict(zip(frame.columns, numbers.reshape(frame.n, len(frame.columns)).T))
    ids = rows.get("id", np.arange(frame.n))
    if not np.isfinite(ids).all():
        return None
    drawn = lots(ids)
    chosen = np.flatnonzero(drawn < share)
    chosen = chosen[np.argsort(ids[chosen], kind="stable")]
    return {name: rows[name][chosen] for name in wanted}, drawn[chosen]


def _ids(frame: Frame, text: bytes, data: Array, begins: Array, ends: Array) -> Array:
    """Ids of all rows; their numbers where there are none."""
    if "id" not in frame.columns:
        return np.arange(frame.n)
    leading = _leading_numbers(data, begins, ends) if frame.columns[0] == "id" else None
    if leading is not None:
        return leading
    column = frame.columns.index("id")
    return np.array([int(float(text[b:e].split(None, column + 1)[column])) for b, e in zip(begins, ends)])


def _leading_numbers(data: Array, begins: Array, ends: Array) -> Array | None:
    """Whole numbers at the beginning of lines. None: a line begins otherwise."""
    value = np.zeros(len(begins), np.int64)
    at = begins.copy()
    going = np.ones(len(begins), bool)
    for _ in range(20):
        digit = np.where(at < ends, data[np.minimum(at, len(data) - 1)], 32)
        going &= (digit >= 48) & (digit <= 57)
        if not going.any():
            break
        value = np.where(going, 10 * value + digit - 48, value)
        at = at + going
    return value if np.all(at > begins) else None


PLACES = (("x", "y", "z"), ("xu", "yu", "zu"), ("xs", "ys", "zs"), ("xsu", "ysu", "zsu"))


def place_columns(columns: list[str]) -> tuple[str, str, str] | None:
    return next((place for place in PLACES if set(place) <= set(columns)), None)


@dataclass
class Grains:
    """Some of the grains of a snapshot."""
    step: int
    place: Array     # (n, 3)
    radius: Array    # (n,)
    speed: Array     # (n,)
    kind: Array      # (n,)
    lot: Array       # (n,), lots()
    velocity: bool   # has the dump velocities?
    of: int          # how many the snapshot has

    def share(self, share: float) -> Grains:
        """Those whose lots are below a share."""
        kept = self.lot < share
        return Grains(self.step, self.place[kept], self.radius[kept], self.speed[kept], self.kind[kept], self.lot[kept], self.velocity, self.of)


def read_grains(frame: Frame, share: float = 1.0) -> Grains | None:
    """A share of the grains of a snapshot. None: the snapshot is not whole."""
    place = place_columns(frame.columns)
    if place is None:
        raise InputError(f"{frame.path.name} has no columns x y z: write dump ID all custom N FILE id type x y z vx vy vz radius")
    more = [name for name in ("type", "radius", "diameter", "vx", "vy", "vz") if name in frame.columns]
    read = read_rows(frame, [*place, *more], share)
    if read is None:
        return None
    rows, lot = read
    x = np.column_stack([rows[name] for name in place])
    if "s" in place[0]:
        x = frame.box[:, 0] + x * (frame.box[:, 1] - frame.box[:, 0])
    n = len(x)
    size = float(np.ptp(frame.box, axis=1).max())
    radius = rows["radius"] if "radius" in rows else rows["diameter"] / 2 if "diameter" in rows else np.full(n, size / 100)
    moving = {"vx", "vy", "vz"} <= rows.keys()
    speed = np.sqrt(rows["vx"] ** 2 + rows["vy"] ** 2 + rows["vz"] ** 2) if moving else np.zeros(n)
    good = np.isfinite(x).all(axis=1) & np.isfinite(radius) & np.isfinite(speed)
    kind = rows.get("type", np.ones(n))
    return Grains(frame.step, x[good], radius[good], speed[good], kind[good], lot[good], moving, frame.n)


def dump_files(folder: pathlib.Path, log: Log) -> list[pathlib.Path]:
    """Dumps of grains: those that the log names, else those whose names say so."""
    found: list[pathlib.Path] = []
    for name in log.dumps:
        if "*" in name:
            found += sorted((folder / name).parent.glob(pathlib.Path(name).name), key=lambda p: step_in(p.name, name))
        elif (folder / name).is_file():
            found.append(folder / name)
    if not found:
        found = sorted({*folder.glob("*.dump"), *folder.glob("dump.*"), *folder.glob("*.lammpstrj")})
    images = (".png", ".jpg", ".jpeg", ".ppm", ".mp4", ".avi", ".vtk", ".vtp", ".vtu", ".zst")
    return [path for path in dict.fromkeys(found) if path.is_file() and path.suffix not in images]


def grain_frames(folder: pathlib.Path, log: Log, notes: list[str]) -> list[Frame]:
    """Snapshots of the dump with the most of them that has places of grains, one for each step."""
    best: dict[int, Frame] = {}
    by_series: dict[str, dict[int, Frame]] = {}
    for path in dump_files(folder, log):
        try:
            frames = [frame for frame in (index_binary_dump if path.suffix == ".bin" else index_dump)(path) if place_columns(frame.columns)]
        except InputError as error:
            notes.append(str(error))
            continue
        series = by_series.setdefault(re.sub(r"\d+", "*", path.name), {})
        for frame in frames:
            series[frame.step] = frame
    for series in by_series.values():
        if len(series) > len(best):
            best = series
    return [best[step] for step in sorted(best)]


def find_log(folder: pathlib.Path, name: str | None = None) -> pathlib.Path:
    """The log of a run. Raises InputError where there is none."""
    if not folder.is_dir():
        raise InputError(f"'{folder}' is no folder: name the one in which the run wrote its log")
    if name is not None:
        for path in (folder / name, pathlib.Path(name)):
            if path.is_file():
                return path
        raise InputError(f"there is no log '{name}' in {folder}")
    if (folder / "log.lammps").is_file():
        return folder / "log.lammps"
    others = sorted((p for p in [*folder.glob("log.*"), *folder.glob("*.log")] if p.is_file()), key=lambda p: p.stat().st_mtime)
    if not others:
        raise InputError(f"{folder} has no log of LAMMPS (log.lammps): name the folder of the run, or the log with --log FILE")
    return others[-1]


def starts_with(path: pathlib.Path, text: str) -> bool:
    try:
        with open(path, "rb") as file:
            return file.read(len(text)) == text.encode()
    except OSError:
        return False


def files_in(folder: pathlib.Path) -> list[pathlib.Path]:
    return sorted(p for p in folder.iterdir() if p.is_file() and not os.path.basename(p).startswith("."))
