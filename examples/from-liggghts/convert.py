#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Convert an input script of LIGGGHTS 3.8 to one of LAMMPS with fix wall/lsdcd.

  convert.py in.chute -o in.chute.lammps      then read every line of it that has LEFT or NOTE

What is converted: materials (property/global) and models become the numbers of the pair style and of the wall;
mesh/surface, wall/gran, move/mesh, massflow/mesh and dump mesh/* become words of fix wall/lsdcd and fix
massflow/lsdcd; what both programs know stays as it is, but for names such as atom_style granular.

What is not converted stays as a comment below a line
  # LEFT in.chute:34: why; do: what to do
and the same list is printed. A line with NOTE is converted, and says what to look at. The script is written
whole or, after an error, not at all. It reads the script once from top to bottom: numbers of materials may be variables
with a plain value (or --var NAME VALUE), loops and ifs stay as they are.

The radius and the density of the grains, which the model hooke needs, come from particletemplate/sphere, from set, from
the file of read_data, or from --radius and --density. Files are looked for beside the script.
doc/from-liggghts.md has a table of all commands.
"""
import argparse
import ast
import functools
import math
import os
import re
import struct
import sys
import tempfile
from pathlib import Path

# Styles of fixes that LAMMPS has too, with the same words.
SAME_FIXES = set("""adapt addforce ave/atom ave/correlate ave/histo ave/time aveforce deform drag dt/reset efield
enforce2d external freeze gravity lineforce momentum move nve nve/limit nve/noforce nve/sphere planeforce print rigid
setforce spring spring/self store/state viscous""".split())
SAME_COMPUTES = set("""centro/atom cluster/atom cna/atom com coord/atom displace/atom erotate/sphere erotate/sphere/atom
group/group gyration ke ke/atom msd pe pe/atom pressure property/atom property/local rdf reduce stress/atom
temp""".split())
MESH_DUMPS = {"mesh/stl", "stl", "mesh/vtk", "mesh/vtm", "mesh/gran/VTK"}
SAME_DUMPS = {"atom", "xyz", "image", "local", "custom", "movie"}
SAME_COMMANDS = set("""atom_modify boundary change_box clear compute_modify create_atoms create_box delete_atoms
dielectric dimension displace_atoms dump_modify echo fix_modify group if jump label lattice log mass minimize neigh_modify
neighbor newton next print processors read_data read_dump region replicate reset_timestep restart run set shell
thermo thermo_modify thermo_style timestep uncompute undump unfix units variable velocity write_data write_dump
write_restart quit info""".split())
GONE_MESH_WORDS = {"heal": 1, "curvature": 1, "curvature_tolerant": 1, "verbose": 1, "precision": 1,
                   "min_feature_length": 1, "element_exclusion_list": 2, "stress": 1}
FORCE, TORQUE = (1, 2, 3), (4, 5, 6)


class CannotConvert(Exception):
    """An error: no script is written."""


class Left(Exception):
    """A command that stays as a comment: why, and what to do."""

    def __init__(self, why, do):
        super().__init__(why)
        self.why, self.do = why, do


class Line:
    def __init__(self, number, text):
        self.number, self.text = number, text
        self.words = words_of(text)


def words_of(text):
    """Words of a command, without its comment; quoted ones in one piece."""
    found = re.findall(r'"[^"]*"|\'[^\']*\'|#.*|[^\s#"\']+', text.replace("&\n", " "))
    return [w for w in found if not w.startswith("#")]


def read_lines(path):
    lines, begun, first = [], "", 1
    for number, text in enumerate(path.read_text().splitlines(), 1):
        first = first if begun else number
        begun += text
        # A line goes on where it ends with &, also before a comment.
        if re.search(r"&\s*(#.*)?$", text):
            begun = re.sub(r"&\s*(#.*)?$", "&\n", begun)
            continue
        lines.append(Line(first, begun))
        begun = ""
    return lines + ([Line(first, begun)] if begun else [])


# ---- meshes ------------------------------------------------------------------------------

def read_stl(path):
    """Triangles of a text or binary STL file."""
    data = path.read_bytes()
    if len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
        rows = (struct.unpack_from("<9f", data, 84 + 50 * k + 12) for k in range((len(data) - 84) // 50))
        return [(r[:3], r[3:6], r[6:]) for r in rows]
    points = [tuple(map(float, p)) for p in re.findall(r"vertex\s+(\S+)\s+(\S+)\s+(\S+)", data.decode(errors="replace"))]
    return list(zip(points[::3], points[1::3], points[2::3]))


def cross(a, b):
    return tuple(a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3] for k in range(3))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def unit(a):
    size = math.sqrt(dot(a, a))
    if size == 0:
        raise CannotConvert("an axis has length 0")
    return tuple(x / size for x in a)


def turned(p, axis, degrees):
    """Rodrigues' formula."""
    t = math.radians(degrees)
    n, c = cross(axis, p), dot(axis, p) * (1 - math.cos(t))
    return tuple(x * math.cos(t) + y * math.sin(t) + z * c for x, y, z in zip(p, n, axis))


class Mesh:
    """A fix mesh/surface."""

    def __init__(self, script, line):
        w = line.words
        self.id, self.group, self.style, self.line = w[1], w[2], w[3], line
        self.file, self.type, self.place, self.words, self.wear = None, 1, [], [], False
        self.servo, self.moves, self.com, self.axis, self.target = None, [], (0.0, 0.0, 0.0), None, None
        self.outputs, self.wall, self.index, self.several = [], None, None, False
        self.parse(script, w[4:])

    def parse(self, script, w):
        number, values = script.number, {}
        while w:
            key = w.pop(0)

            def take(n, key=key):
                if len(w) < n:
                    raise CannotConvert(f"{script.at(self.line)}: {key} has too few values")
                return [w.pop(0) for _ in range(n)]

            if key == "file":
                self.file = take(1)[0]
            elif key in ("generate", "fix", "extrude_planar", "region"):
                raise Left(f"a mesh by {key}", "make a file of it (lsdcd generate makes boxes, cylinders, planes; dump "
                           "mesh/stl in LIGGGHTS writes any mesh) and name that")
            elif key == "type":
                self.type = int(number(take(1)[0], self.line))
            elif key in ("scale", "move"):
                self.place.append((key, take(1 if key == "scale" else 3)))
            elif key == "rotate":
                _, x, y, z, _, angle = take(6)
                self.place.append((key, [x, y, z, angle]))
            elif key == "surface_vel":
                self.words.append("surface_vel " + " ".join(take(3)))
            elif key == "surface_ang_vel":
                _, ox, oy, oz, _, ax, ay, az, _, omega = take(10)
                axis = unit([number(v, self.line) for v in (ax, ay, az)])
                spin = [number(omega, self.line) * a for a in axis]
                self.words.append("surface_angvel " + " ".join(map(short, spin)) + f" {ox} {oy} {oz}")
            elif key == "reference_point":
                self.words.append("torque_about " + " ".join(take(3)))
            elif key == "wear":
                self.wear = take(1)[0] == "finnie"
            elif key in ("com", "axis"):
                values[key] = take(3)
            elif key in ("ctrlPV", "target_val", "vel_max", "kp", "ki", "kd", "mode", "ratio"):
                values[key] = take(1)[0]
            elif key in ("temperature", "mass_temperature"):
                raise Left(f"{key} of a mesh", "the sub-model heat and the keyword temperature of fix wall/lsdcd")
            elif key in GONE_MESH_WORDS:
                take(GONE_MESH_WORDS[key])
            else:
                raise Left(f"the word {key} of a mesh", "fix_wall_lsdcd.rst")
        if self.file is None or not self.file.lower().endswith((".stl", ".obj", ".ply", ".off")):
            raise Left(f"the file {self.file}", "write it as STL")
        if self.style.endswith("/servo"):
            self.add_servo(script, values)
        elif self.style not in ("mesh/surface", "mesh/surface/planar", "mesh/surface/stress"):
            raise Left(f"the module of {self.style}", "mesh/surface/stress; others are not there")

    def add_servo(self, script, v):
        missing = [k for k in ("com", "ctrlPV", "axis", "target_val", "vel_max") if k not in v]
        if missing:
            raise CannotConvert(f"{script.at(self.line)}: a servo without {missing[0]}")
        self.com, self.target = v["com"], v["target_val"]
        self.axis = unit([script.number(x, self.line) for x in v["axis"]])
        along = {(1.0, 0.0, 0.0): "x", (0.0, 1.0, 0.0): "y", (0.0, 0.0, 1.0): "z"}.get(self.axis)
        along = along or "axis " + " ".join(map(short, self.axis))
        speed = v["vel_max"]
        words = f"servo {v['ctrlPV']} {along}"
        if v["ctrlPV"] == "torque":
            words += " through " + " ".join(self.com)
            com = [script.number(x, self.line) for x in self.com]
            arms = [minus(p, com) for t in self.triangles(script) for p in t]
            # LIGGGHTS's vel_max is of the corner that is farthest from the axis.
            speed = short(script.number(speed, self.line) / max(math.sqrt(dot(c, c)) for c in
                                                               (cross(self.axis, a) for a in arms)))
        self.servo = f"{words} {self.target} vmax {speed}"

    def placement(self):
        return "".join(f" {key} {' '.join(values)}" for key, values in self.place)

    def triangles(self, script):
        """Placed."""
        path = script.folder / self.file
        if not path.exists():
            raise CannotConvert(f"{script.at(self.line)}: {path} is not there, and the mesh is needed to convert this")

        def placed(p):
            for key, values in self.place:
                v = [script.number(x, self.line) for x in values]
                if key == "scale":
                    p = tuple(v[0] * x for x in p)
                elif key == "move":
                    p = tuple(x + y for x, y in zip(p, v))
                else:
                    p = turned(p, unit(v[:3]), v[3])
            return p

        return [tuple(placed(p) for p in t) for t in read_stl(path)]

    def output(self, k):
        """What stands for element k of this fix in LAMMPS."""
        if k in FORCE + TORQUE:
            return f"f_{self.wall}[{self.index}][{k}]" if self.several else f"f_{self.wall}[{k}]"
        if k in (7, 8, 9) and self.servo:
            way = f"f_{self.wall}[{self.index}][12]" if self.several else f"f_{self.wall}[12]"
            return self.com[k - 7] if self.axis[k - 7] == 0 else f"({self.com[k - 7]}+({short(self.axis[k - 7])})*{way})"
        return None


def short(x):
    return f"{x:.10g}"


# ---- contact laws ------------------------------------------------------------------------

def tsuji(target):
    """The restitution whose damping is `target` by the fit of Tsuji, Tanaka and Ishida; it falls from 0 to 1."""
    def fit(e):
        return sum(c * e ** k for k, c in enumerate((1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218)))
    if target > fit(0):
        return None
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if fit(middle) > target else (low, middle)
    return low


class Contact:
    """The numbers of LIGGGHTS between the materials i and j."""

    def __init__(self, script, line, i, j):
        self.i, self.j, self.get = i, j, functools.partial(script.property, line)

    def elastic(self):
        e, n = [self.get("youngsModulus", k) for k in (self.i, self.j)], \
               [self.get("poissonsRatio", k) for k in (self.i, self.j)]
        y = 1 / sum((1 - v * v) / x for x, v in zip(e, n))
        g = 1 / sum(2 * (2 - v) * (1 + v) / x for x, v in zip(e, n))
        return y, g

    def beta(self):
        """-ln e / sqrt(ln^2 e + pi^2)."""
        e = self.get("coefficientRestitution", self.i, self.j)
        return -math.log(e) / math.hypot(math.log(e), math.pi)

    def friction(self):
        return self.get("coefficientFriction", self.i, self.j)

    def hooke(self, r, m):
        """Stiffness, and damping per mass."""
        y, v = self.elastic()[0], self.get("characteristicVelocity")
        k = 16 / 15 * math.sqrt(r) * y * (15 * m * v * v / (16 * math.sqrt(r) * y)) ** 0.2
        return k, 2 * self.beta() * math.sqrt(k / m)

    def one_material(self):
        """E and nu of the one material that, touching itself, is as these two."""
        y, g = self.elastic()
        ratio = g / y
        nu = (1 - 4 * ratio) / (1 - 2 * ratio)
        return 2 * y * (1 - nu * nu), nu


class Model:
    """The words after model, in pair_style gran and fix wall/gran."""
    NAMES = ("model", "tangential", "cohesion", "rolling_friction", "surface")

    def __init__(self, words):
        self.normal, self.tangential, self.cohesion, self.rolling, self.off = "hertz", "history", None, None, set()
        self.limit, self.rest, self.reduced = False, [], False
        words = list(words)
        while words:
            w = words.pop(0)
            if w in self.NAMES and words:
                value = words.pop(0)
                name = {"model": "normal", "rolling_friction": "rolling"}.get(w, w)
                setattr(self, name, None if value == "off" else value)
            elif w in ("tangential_damping", "limitForce", "ktToKnUser", "absolute_damping") and words:
                if (words.pop(0) == "on") != (w == "tangential_damping"):
                    self.off.add(w)
            else:
                self.rest = [w, *words]
                break
        self.limit = "limitForce" in self.off
        self.damped = "tangential_damping" not in self.off

    def key(self):
        return (self.normal, self.tangential, self.cohesion, self.rolling, self.limit, self.damped)

    def check(self):
        if getattr(self, "surface", "default") != "default":
            raise Left(f"surface {self.surface}", "spheres only")
        if self.normal not in ("hooke", "hertz", "hooke/stiffness", "hertz/stiffness"):
            raise Left(f"model {self.normal}", "hooke or hertz; others are not there")
        if self.tangential not in ("history", "no_history"):
            raise Left(f"tangential {self.tangential}", "history or no_history")
        if "absolute_damping" in self.off:
            raise Left("absolute_damping", "write the damping over the mass of a grain as gamman")

    def extras(self, c, classic):
        """Rolling and cohesion of the wall, which go with classic styles."""
        words = ""
        if self.rolling in ("cdt", "epsd2") and classic:
            words += f" rolling {self.rolling} {short(c.get('coefficientRollingFriction', c.i, c.j))}"
        elif self.rolling:
            raise Left(f"rolling_friction {self.rolling} with model {self.normal}", "rolling sds k gamma mu of granular "
                       "(k per length: k R^2 is the spring of epsd2), or model hooke with cdt or epsd2")
        if self.cohesion == "sjkr" and classic:
            words += f" cohesion sjkr {short(c.get('cohesionEnergyDensity', c.i, c.j))}"
        elif self.cohesion:
            raise Left(f"cohesion {self.cohesion} with model {self.normal}", "granular jkr or dmt, or model hooke with sjkr")
        return words

    def classic(self, c, r, m):
        """Words of a classic style for a contact whose effective radius and mass are r and m."""
        mu = short(c.friction())
        if self.normal == "hooke":
            k, g = c.hooke(r, m)
            kt, gt = (k * 2 / 7 if "ktToKnUser" in self.off else k), g
        else:
            k, kt, g, gt = (c.get(n, c.i, c.j) for n in ("kn", "kt", "gamman", "gammat"))
        style = {"hooke": "hooke", "hertz": "hertz"}[self.normal.split("/")[0]]
        if self.tangential == "history" or style == "hertz":
            style += "/history"
        if style == "hertz/history" and self.tangential != "history":
            raise Left("hertz/stiffness without history", "granular hertz with tangential linear_nohistory")
        return style, f"{short(k)} {short(kt)} {short(g)} {short(gt)} {mu} {int(self.damped)}"

    def hertz(self, c):
        """Stiffnesses, damping, its share across the normal, friction."""
        y, g = c.elastic()
        return 4 / 3 * y, 8 * g, math.sqrt(5) * c.beta(), math.sqrt(4 * g / y) * self.damped, c.friction()

    def wall(self, c, r, m):
        self.check()
        if self.normal != "hertz":
            style, numbers = self.classic(c, r, m)
            law = f"{style} {numbers}"
            extras = self.extras(c, True)
        else:
            _, _, _, share, mu = self.hertz(c)
            e, nu = c.one_material()
            tangential = "mindlin_slip NULL" if self.tangential == "history" else "linear_nohistory"
            law = (f"granular hertz/material {short(e)} {short(c.get('coefficientRestitution', c.i, c.j))} {short(nu)} "
                   f"damping coeff_restitution tangential {tangential} {short(share)} {short(mu)}")
            extras = self.extras(c, False)
        return law + " limit_damping" * self.limit + extras

    def granular(self, c):
        """The words of pair_coeff and of LAMMPS's own wall, which has other moduli in 29Sep2021."""
        k, kt, damping, share, mu = self.hertz(c)
        e = tsuji(damping)
        if e is None:
            raise Left("a restitution below 0.115", "damping coeff_restitution, from LAMMPS 4Feb2025 on")
        tangential = f"mindlin {short(kt)}" if self.tangential == "history" else "linear_nohistory"
        return (f"hertz {short(k)} {short(e)} tangential {tangential} {short(share)} {short(mu)} damping tsuji" +
                " limit_damping" * self.limit)


# ---- the script --------------------------------------------------------------------------

class Script:
    def __init__(self, path, options):
        self.path, self.folder, self.options = path, path.parent, options
        self.lines = read_lines(path)
        self.variables = dict(options.var or [])
        self.properties, self.meshes, self.gone, self.sizes, self.grain_types = {}, {}, {}, [], set()
        self.templates, self.distributions = {}, {}    # of constant spheres; words of distributions
        self.wall, self.wall_line, self.moves, self.dumps, self.regions, self.box = None, None, {}, [], {}, {}
        self.out, self.left, self.ran, self.pair, self.plain = [], [], 0, None, set()
        self.mirrored = {}
        for line in self.lines:
            try:
                self.collect(line)
            except (IndexError, ValueError):
                raise CannotConvert(f"{self.at(line)}: words are missing or wrong: {line.text.strip()}") from None
        if options.radius and options.density:
            self.sizes = [(options.radius, options.density)]

    def at(self, line):
        return f"{self.path.name}:{line.number}"

    # -- what is known of the whole script

    def number(self, word, line):
        text = re.sub(r"\$\{(\w+)\}|\$(\w)", lambda m: self.variables.get(m[1] or m[2], m[0]), word).strip("\"'")
        try:
            return float(text)
        except ValueError:
            pass
        try:
            return arithmetic(re.sub(r"v_(\w+)", lambda m: self.variables.get(m[1], m[0]), text))
        except (ValueError, SyntaxError, ZeroDivisionError):
            raise CannotConvert(f"{self.at(line)}: '{word}' is no number that is known here; give the values of "
                                "its variables with --var NAME VALUE") from None

    def property(self, line, name, *types):
        if name not in self.properties:
            raise CannotConvert(f"{self.at(line)}: needs fix property/global {name}, which the script does not have")
        where, w = self.properties[name]
        kind, values = w[0], w[1:]
        if kind == "scalar":
            return self.number(values[0], where)
        if kind.startswith("peratomtypepair"):
            n, values = int(self.number(values[0], where)), values[1:]
            k = (types[0] - 1) * n + types[1] - 1
        else:
            k = types[0] - 1
        if k >= len(values):
            raise CannotConvert(f"{self.at(where)}: {name} has no value for the types {types}")
        return self.number(values[k], where)

    def collect(self, line):
        w = line.words
        if not w:
            return
        if w[0] == "variable" and len(w) > 3 and w[2] in ("equal", "index", "string") and w[1] not in self.variables:
            try:
                self.variables[w[1]] = repr(self.number(w[3], line))
            except CannotConvert:
                pass
        elif w[0] == "fix" and len(w) > 3:
            if w[3] == "property/global":
                self.properties[w[4]] = (line, w[5:])
            elif w[3].startswith("mesh/surface"):
                try:
                    self.meshes[w[1]] = Mesh(self, line)
                except Left as left:
                    self.gone[w[1]] = left
            elif w[3] == "particletemplate/sphere":
                self.grain_types.add(int(w[w.index("atom_type") + 1]) if "atom_type" in w else 1)
                if all(k in w and w[w.index(k) + 1] == "constant" for k in ("radius", "density")):
                    self.templates[w[1]] = (w[w.index("atom_type") + 1] if "atom_type" in w else "1",
                                            *(self.number(w[w.index(k) + 2], line) for k in ("radius", "density")))
                if "radius" in w and "density" in w:
                    self.sizes.append(tuple(self.number(w[w.index(k) + 2], line) for k in ("radius", "density")))
            elif w[3] in ("particledistribution/discrete", "particledistribution/discrete/massbased"):
                self.distributions[w[1]] = w[6:]
            elif w[3] == "wall/gran" and "meshes" in w:
                if self.wall:
                    raise CannotConvert(f"{self.at(line)}: a second fix wall/gran with meshes")
                self.wall, self.wall_line = w[1], line
        elif w[0] == "dump" and len(w) > 5 and w[3] in MESH_DUMPS:
            self.dumps.append(line)
        elif w[0] == "read_data":
            self.read_data(line)
        elif w[0] == "create_atoms":
            self.grain_types.add(int(self.number(w[1], line)))
        elif w[0] == "set" and "diameter" in w and "density" in w:
            self.sizes.append((self.number(w[w.index("diameter") + 1], line) / 2,
                               self.number(w[w.index("density") + 1], line)))
        elif w[0] == "region" and len(w) > 8 and w[2] == "block":
            self.regions[w[1]] = w[3:9]
        elif w[0] == "create_box":
            block = self.regions.get(w[2])
            if block:
                self.box = {a: tuple(self.number(x, line) for x in block[2 * k:2 * k + 2]) for k, a in enumerate("xyz")}

    def read_data(self, line):
        name = re.sub(r"\$\{(\w+)\}", lambda m: self.variables.get(m[1], m[0]), line.words[1])
        path = self.folder / name
        if not path.exists():
            return
        text = path.read_text()
        for lo, hi, a in re.findall(r"^\s*(\S+)\s+(\S+)\s+([xyz])lo [xyz]hi", text, re.M):
            self.box[a] = (float(lo), float(hi))
        part = re.search(r"^Atoms.*?\n\s*\n(.*?)(?:\n\s*\n|\Z)", text, re.M | re.S)
        for row in (part[1].splitlines() if part else []):
            w = row.split()
            if len(w) > 6:
                self.grain_types.add(int(w[1]))
                self.sizes.append((float(w[2]) / 2, float(w[3])))

    def size(self, line):
        """Radius and mass of a grain; the mean mass where there are several."""
        if not self.sizes:
            raise CannotConvert(f"{self.at(line)}: model hooke needs the size of a grain: give --radius and --density")
        masses = [4 / 3 * math.pi * r ** 3 * d for r, d in self.sizes]
        m = sum(masses) / len(masses)
        if max(masses) > 1.001 * min(masses):
            self.note(line, "k and gamma of hooke hang on the mass of each grain in LIGGGHTS; here they are those of the "
                      "mean mass")
        return sum(r for r, _ in self.sizes) / len(self.sizes), m

    def grains(self):
        return sorted(self.grain_types) or [1]

    # -- writing

    def put(self, text):
        self.out.append(text)

    def note(self, line, text):
        self.put(f"# NOTE {self.at(line)}: {text}")

    def leave(self, line, why, do):
        self.left.append(f"{self.at(line)}: {why}; do: {do}")
        self.put(f"# LEFT {self.left[-1]}")
        self.put("\n".join("# " + t for t in line.text.splitlines()))

    def convert(self):
        self.put(f"# Converted from {self.path.name} by convert.py of LSDCD. Read the lines with LEFT and NOTE.")
        for line in self.lines:
            if not line.words:
                self.put(line.text)
                continue
            before = len(self.out)
            try:
                self.command(line)
            except (IndexError, ValueError):
                raise CannotConvert(f"{self.at(line)}: words are missing or wrong: {line.text.strip()}") from None
            except Left as left:
                del self.out[before:]
                self.leave(line, left.why, left.do)
                if line.words[0] in ("fix", "dump", "compute"):
                    self.gone[line.words[1]] = left
        return "\n".join(self.out) + "\n"

    def command(self, line):
        w = line.words
        if w[0] == "atom_style":
            if w[1] not in ("granular", "sphere"):
                raise Left(f"atom_style {w[1]}", "spheres only")
            self.put("atom_style      sphere")
        elif w[0] == "communicate":
            self.put("comm_modify     mode " + " ".join(w[1:]))
        elif w[0] == "pair_style":
            self.pair_style(line)
        elif w[0] == "pair_coeff":
            if self.pair is None:
                raise Left("pair_coeff of a pair style that was left", "see there")
            for text in self.pair:
                self.put(text)
            self.pair = []
        elif w[0] == "fix":
            self.fix(line)
        elif w[0] == "dump":
            self.dump(line)
        elif w[0] == "compute" and w[3] not in SAME_COMPUTES:
            raise Left(f"compute {w[3]}", "LAMMPS has no compute of that name with these words")
        elif w[0] in ("unfix", "undump", "uncompute", "fix_modify") and w[1] in self.gone:
            self.put(f"# {' '.join(w)}")
        elif w[0] == "unfix" and w[1] in self.moves:
            self.stop(line)
        elif w[0] == "unfix" and w[1] in self.meshes:
            self.put(f"# unfix {w[1]}: it is part of the fix {self.meshes[w[1]].wall}")
        elif w[0] == "unfix" and w[1] in self.plain:
            self.put(f"# unfix {w[1]}")
        elif w[0] == "fix_modify":
            self.fix_modify(line)
        elif w[0] not in SAME_COMMANDS | {"compute"}:
            raise Left(f"the command {w[0]}", "see the manual of LAMMPS, or convert the file that it names by itself")
        else:
            if w[0] == "run":
                self.ran += 1
            self.pass_on(line)

    def pass_on(self, line):
        text = line.text
        if line.words[0] == "thermo_style":
            for name in [i for i in re.findall(r"[fc]_(\w+)", text) if i in self.gone or i in self.plain]:
                text = re.sub(rf"\s[fc]_{name}(\[\d+\])*(?=\s|$)", "", text)
                self.note(line, f"without {name}, which is not here")
        self.put(self.renamed(line, text))

    def renamed(self, line, text):
        """Outputs of mesh fixes and massflow by their new names."""
        direct = line.words[0] in ("thermo_style", "print")

        def new(m):
            name, k = m[1], int(m[2])
            if name in self.gone or name in self.plain:
                raise Left(f"f_{name}, which is not here", "take another output")
            if name in self.mirrored:
                flow = self.mirrored[name].get(k)
                if flow is None:
                    raise Left(f"element {k} of f_{name}", "fix_massflow_lsdcd.rst lists what there is")
                return flow
            if name not in self.meshes:
                return m[0]
            mesh = self.meshes[name]
            value = mesh.output(k) if mesh.wall else None
            if value is None:
                raise Left(f"element {k} of f_{name}", "fix_wall_lsdcd.rst lists what there is")
            if line.words[0] == "variable" or re.fullmatch(r"f_\w+(\[\d+\])" + "{1,2}" * direct, value):
                return value
            helper = f"{name}_{k}"
            self.put(f"variable        {helper} equal {value}")
            return f"v_{helper}"

        return re.sub(r"f_(\w+)\[(\d+)\]", new, text)

    def pair_style(self, line):
        w = line.words
        if w[1] != "gran":
            raise Left(f"pair_style {' '.join(w[1:])}", "pair_style gran or granular of LAMMPS")
        model, kinds = Model(w[2:]), self.grains()
        if model.rest:
            raise Left(f"the word {model.rest[0]} of pair_style", "see the manual of LAMMPS")
        model.check()
        if model.rolling or model.cohesion:
            raise Left("rolling_friction and cohesion between grains",
                       "pair_style granular with rolling sds, and jkr or dmt; this comes before pair_coeff")
        if model.normal == "hertz":
            self.put("pair_style      granular")
            self.note(line, "damping tsuji has another number than the restitution, so that LAMMPS's pairs return the "
                      "restitution of LIGGGHTS; in 29Sep2021 they have no coeff_restitution")
            self.pair = [f"pair_coeff      {i} {j} {model.granular(Contact(self, line, i, j))}"
                         for i in kinds for j in kinds if i <= j] if len(kinds) > 1 else \
                        [f"pair_coeff      * * {model.granular(Contact(self, line, kinds[0], kinds[0]))}"]
            return
        r, m = self.size(line) if model.normal == "hooke" else (1.0, 1.0)
        laws = {model.classic(Contact(self, line, i, j), r / 2, m / 2) for i in kinds for j in kinds}
        if len(laws) > 1:
            raise Left("model hooke for grains of several materials", "pair_style hybrid, or model hertz")
        style, numbers = laws.pop()
        self.put(f"pair_style      gran/{style} {numbers}" + " limit_damping" * model.limit)
        self.pair = ["pair_coeff      * *"]

    def fix(self, line):
        w = line.words
        name, style = w[1], w[3]
        if style == "property/global":
            self.plain.add(name)
            self.put(f"# {line.text.strip()}")
        elif style.startswith("mesh/surface"):
            if name in self.gone:
                raise self.gone[name]
            self.put(f"# mesh {name}: see the fixes that use it")
        elif style == "wall/gran":
            if "meshes" in w:
                self.mesh_wall(line)
            elif "primitive" in w:
                self.primitive(line)
            else:
                raise Left("a form of wall/gran that is older than 3.0", "wall/gran of LAMMPS has these words")
        elif style == "move/mesh":
            self.move(line)
        elif style == "massflow/mesh":
            self.massflow(line)
        elif style == "check/timestep/gran":
            self.plain.add(name)
            self.note(line, "fix check/timestep/gran has no counterpart; lsdcd timestep names a timestep")
        elif style.startswith("insert/"):
            self.insert(line)
        elif name in self.templates or all(k in self.templates for k in self.distributions.get(name, [""])[::2]):
            self.plain.add(name)
            self.put(f"# {name}: see the fixes that insert grains")
        elif style.startswith(("particletemplate", "particledistribution")):
            raise Left(style, "radii and densities go to fix insert/lsdcd (diam, dens), or to set after create_atoms")
        elif style in SAME_FIXES:
            if style == "ave/time" and "f_" in line.text:
                self.pass_on(line)
            else:
                self.put(self.renamed(line, line.text))
        else:
            raise Left(f"fix {style}", "LAMMPS has no fix of that name with these words")

    def inserted_grains(self, name, line):
        """Words of fix insert/lsdcd for a distribution."""
        parts = self.distributions.get(name, [])
        found = [(self.templates.get(k), self.number(f, line)) for k, f in zip(parts[::2], parts[1::2])]
        if not found or not all(t for t, _ in found):
            raise Left("insertion of grains that are no spheres of constant radius and density",
                       "fix insert/lsdcd, with diam one, range, poly or mass")
        if len({(t[0], t[2]) for t, _ in found}) > 1:
            raise Left("insertion of several types or densities", "a fix insert/lsdcd for each, with its share of the rate")
        grain_type, _, density = found[0][0]
        total = sum(f for _, f in found)
        sizes = f"mass {len(found)} " + " ".join(f"{2 * t[1]:.10g} {f / total:.10g}" for t, f in found)
        if len(found) == 1:
            sizes = f"one {2 * found[0][0][1]:.10g}"
        return f"type {grain_type} diam {sizes} dens {density:.10g}"

    def insert(self, line):
        w = line.words
        form = w[3].split("/", 1)[1]
        options = {k: w[w.index(k) + 1] for k in (
            "distributiontemplate", "seed", "region", "insertion_face", "nparticles", "mass", "massrate", "particlerate",
            "particles_in_region", "mass_in_region", "insert_every") if k in w}
        if form == "stream":
            mesh = self.meshes.get(options.get("insertion_face"))
            if mesh is None:
                raise Left("insert/stream through a face that is not converted", "fix insert/lsdcd mesh FILE")
            place = f"mesh {mesh.file}{mesh.placement()}"
        elif form in ("pack", "rate/region") and "region" in options:
            place = f"region {options['region']}"
        else:
            raise Left(w[3], "fix insert/lsdcd mesh FILE or region ID")
        if form == "pack" and options.get("insert_every", "once") != "once":
            raise Left("insert/pack that fills up again and again", "fix insert/lsdcd with massrate or numberrate")
        amounts = [f"{ours} {options[theirs]}" for theirs, ours in (
            ("massrate", "massrate"), ("particlerate", "numberrate"), ("nparticles", "number"), ("mass", "mass"),
            ("particles_in_region", "number"), ("mass_in_region", "mass")) if options.get(theirs, "INF") != "INF"]
        if not amounts:
            raise Left(f"{w[3]} without its number or mass", "fix insert/lsdcd with number, mass, numberrate or massrate")
        velocity = ""
        if "vel" in w:
            k = w.index("vel")
            spread = w[k + 5:k + 8] if w[k + 1] == "uniform" else []
            if w[k + 1] not in ("constant", "uniform") or len(set(spread)) > 1:
                raise Left(f"velocities of {w[k + 1]}", "vel and jitter of fix insert/lsdcd")
            velocity = " vel " + " ".join(w[k + 2:k + 5]) + "".join(f" jitter {v}" for v in spread[:1])
        self.put(f"fix             {w[1]} {w[2]} insert/lsdcd {place} {self.inserted_grains(options.get('distributiontemplate'), line)} "
                 f"{' '.join(amounts)}{velocity}" + (f" seed {options['seed']}" if "seed" in options else ""))
        self.plain.add(w[1])
        if form == "stream":
            self.note(line, "grains are put on the face itself; depth D puts them up to D in front of it, along its normal")
        if "omega" in w:
            self.note(line, "grains come without a spin")

    def law_of(self, line, model, wall_type):
        """Words of the wall for each grain type."""
        r, m = self.size(line) if model.normal == "hooke" else (1.0, 1.0)
        return {i: model.wall(Contact(self, line, wall_type, i), r, m) for i in self.grains()}

    def mesh_wall(self, line):
        w = line.words
        k = w.index("meshes")
        n = int(self.number(w[w.index("n_meshes") + 1], line))
        ids = w[k + 1:k + 1 + n]
        if len(ids) < max(1, n):
            raise ValueError("meshes")
        model = Model(w[4:w.index("mesh")] + w[k + 1 + n:])
        self.stored(line, model)
        for i in ids:
            if i in self.gone:
                self.leave(line, f"the mesh {i}, which is not converted", "add it as mesh FILE")
                self.out.pop()
            elif i not in self.meshes:
                raise CannotConvert(f"{self.at(line)}: there is no mesh {i}")
        meshes = [self.meshes[i] for i in ids if i in self.meshes]
        # One fix, so that a grain where meshes meet is pushed once; each mesh has its law.
        laws = [self.law_of(line, model, mesh.type) for mesh in meshes]
        first = laws[0][self.grains()[0]]
        words = [f"fix             {w[1]} {w[2]} wall/lsdcd {first}" + self.wear(line, meshes)]
        for index, (mesh, by_type) in enumerate(zip(meshes, laws), 1):
            mesh.wall, mesh.index, mesh.several = w[1], index, len(meshes) > 1
            words.append(self.mesh_words(mesh))
            own = by_type[self.grains()[0]]
            words += [f"law {own}"] * (own != first)
            words += [f"law types {kind} {law}" for kind, law in by_type.items() if law != own]
        self.put(" &\n                ".join(words))

    def stored(self, line, model):
        """Words of fix wall/gran that are no model's."""
        rest = model.rest
        while rest[:1] and rest[0].startswith("store_force"):
            self.note(line, "store_force: the keyword contacts has the forces")
            rest = rest[2:]
        if rest:
            raise Left(f"the word {rest[0]} of wall/gran", "see fix_wall_lsdcd.rst")

    def wear(self, line, meshes):
        worn = [m for m in meshes if m.wear]
        if not worn:
            return ""
        own = {}
        for m in worn:
            of_grains = {self.property(line, "k_finnie", m.type, kind) for kind in self.grains()}
            if len(of_grains) > 1:
                raise Left("wear that differs by the type of the grains", "a mesh has one number")
            own[m] = of_grains.pop()
        k = max(own.values())
        for m in meshes:
            if own.get(m, 0) != k:
                m.words.append(f"wear_factor {short(own.get(m, 0) / k)}")
        self.note(line, f"LIGGGHTS wears by twice its k_finnie, {short(k)}, and by the whole force, not the normal one")
        return f" wear finnie {short(2 * k)}"

    def mesh_words(self, mesh):
        moves = "".join(f" motion {m}" for m in reversed(mesh.moves))
        words = f"mesh {mesh.file}{mesh.placement()}{moves}" + "".join(f" {x}" for x in mesh.words)
        if mesh.servo:
            words += f" {mesh.servo}"
        for line in self.dumps:
            words += self.dump_words(line, mesh)
        return words

    def dump_words(self, line, mesh):
        """Of dump ID group style N file [...] for one mesh."""
        w = line.words
        rest = w[6:]
        named = [i for i in rest if i in self.meshes]
        if named and mesh.id not in named:
            return ""
        path = w[5].replace("*", f"_{mesh.id}_*") if "*" in w[5] else str(Path(w[5]).with_suffix("")) + f"_{mesh.id}"
        keyword, end = ("mesh_stl", ".stl") if w[3] in ("mesh/stl", "stl") else ("mesh_fields", ".vtp")
        return f" {keyword} {re.sub('[.](stl|vtk|vtp|vtm)$', '', path)}{end} every {w[4]}"

    def primitive(self, line):
        w = line.words
        k = w.index("primitive")
        rest = w[k + 1:]
        if rest[:1] != ["type"]:
            raise CannotConvert(f"{self.at(line)}: primitive without type")
        kind, shape, rest = int(self.number(rest[1], line)), rest[2], rest[3:]
        place, rest = (rest[:1], rest[1:]) if shape.endswith("plane") else (rest[:3], rest[3:])
        shear, rest = (rest[:3], rest[3:]) if rest[:1] == ["shear"] else ([], rest)
        model, grains = Model(w[4:k] + rest), self.grains()
        self.stored(line, model)
        model.check()
        if model.normal == "hertz":
            laws = {"granular " + model.granular(Contact(self, line, kind, i)) for i in grains}
            model.extras(Contact(self, line, kind, grains[0]), False)
        else:
            laws = set(self.law_of(line, model, kind).values())
            if model.rolling or model.cohesion:
                raise Left("rolling friction or cohesion of a plane", "a mesh of the plane: lsdcd generate plane")
        if len(laws) > 1:
            raise Left("a plane that touches grains of several materials", "a fix for the group of each type")
        if shape in ("xplane", "yplane", "zplane"):
            at, span = self.number(place[0], line), self.box.get(shape[0])
            if span is None:
                raise Left("a plane where the box is not known here", "say which side: lo NULL, or NULL hi")
            where = f"{shape} " + (f"{place[0]} NULL" if at <= sum(span) / 2 else f"NULL {place[0]}")
        elif shape == "zcylinder" and all(self.number(x, line) == 0 for x in place[1:]):
            where = f"zcylinder {place[0]}"
        else:
            raise Left(f"{shape} about another axis than z through the origin",
                       "a mesh: lsdcd generate cylinder, placed by rotate and move")
        self.put(" ".join([f"fix             {w[1]} {w[2]} wall/gran {laws.pop()} {where}", *shear]))

    def motion(self, line, w):
        style, rest = w[6], w[7:]
        if style == "linear":
            return "linear " + " ".join(rest[:3])
        if style == "wiggle":
            return f"wiggle {' '.join(rest[1:4])} {rest[5]}"
        if style == "rotate":
            return f"rotate {' '.join(rest[1:4])} {' '.join(rest[5:8])} {rest[9]}"
        if style == "viblin":
            raise Left("move/mesh viblin", "motion variable: a displacement C (cos(omega t + phase) - cos(phase)) along "
                       "the axis for each term, and its derivative")
        if style == "linear/variable":
            raise Left("move/mesh linear/variable", "motion variable, which needs the displacement beside the velocity")
        raise Left(f"move/mesh {style}", "not there: a mesh turns at a constant rate, or by a servo")

    def move(self, line):
        w = line.words
        mesh = self.meshes.get(w[5])
        if mesh is None:
            raise Left(f"the mesh {w[5]}, which is not converted", "motion, after its file")
        words = self.motion(line, w)
        active = [m for m in self.moves.values() if m[0] is mesh]
        if any(m[2] != self.ran for m in active):
            raise Left(f"a second motion of {mesh.id} that begins later",
                       "fix_modify motion begins all anew; write both from the start, the outer one last")
        if words.split()[0] != "rotate" and any(m[1].startswith("rotate") for m in active):
            raise Left("a linear motion after a rotation", "not there: LIGGGHTS adds their velocities and turns about the "
                       "axis where it was; write the linear one first to have the axis move along")
        self.moves[w[1]] = [mesh, words, self.ran]
        mesh.moves.append(words)
        if mesh.wall is None:
            if self.wall is None:
                raise Left(f"the mesh {w[5]} is no wall", "fix massflow/lsdcd has no motion")
            if self.wall_line.number < line.number:
                raise Left(f"the mesh {w[5]} is in no wall", "add it to the wall")
            self.note(line, f"a motion of fix {self.wall}")
            if self.ran:
                self.note(line, "it begins where that fix is defined")
            return
        self.put(self.modify(mesh))
        if len(mesh.moves) > 1:
            self.note(line, "the first motion of LIGGGHTS is the outer one; here it is the last")

    def modify(self, mesh):
        which = f" mesh {mesh.index}" if mesh.several else ""
        return f"fix_modify      {mesh.wall}{which} " + (" ".join(f"motion {m}" for m in reversed(mesh.moves)) or "motion none")

    def stop(self, line):
        mesh, words, _ = self.moves.pop(line.words[1])
        mesh.moves.remove(words)
        if mesh.moves:
            raise Left(f"one of several motions of {mesh.id} ends", "fix_modify motion with the others: they begin anew")
        self.put(self.modify(mesh))

    def fix_modify(self, line):
        w = line.words
        mesh = self.meshes.get(w[1])
        if mesh is None or not mesh.servo:
            self.put(line.text)
            return
        which = f" mesh {mesh.index}" if mesh.several else ""
        if w[2:4] == ["servo/integrate", "stop"]:
            self.put(f"fix_modify      {mesh.wall}{which} servo none")
        elif w[2] in ("servo/integrate", "servo/target_val"):
            target = w[3] if w[2] == "servo/target_val" else mesh.target
            mesh.servo = mesh.servo.replace(f" {mesh.target} vmax", f" {target} vmax")
            mesh.target = target
            self.put(f"fix_modify      {mesh.wall}{which} {mesh.servo}")
        else:
            raise Left(f"fix_modify {w[2]}", "fix_modify servo with all its words; it needs no gains")

    def massflow(self, line):
        w = line.words
        mesh = self.meshes.get(w[w.index("mesh") + 1])
        if mesh is None:
            raise Left("massflow/mesh through a mesh that is not converted", "fix massflow/lsdcd mesh FILE")
        if "vec_side" not in w:
            raise Left("massflow/mesh without vec_side", "fix massflow/lsdcd counts along the normals of the triangles")
        k = w.index("vec_side")
        side = [self.number(x, line) for x in w[k + 1:k + 4]]
        forward = all(dot(cross(minus(b, a), minus(c, a)), side) > 0 for a, b, c in mesh.triangles(self))
        delete = "delete_atoms" in w and w[w.index("delete_atoms") + 1] == "yes"
        if delete and not forward:
            raise Left("delete_atoms where the mesh is wound against vec_side",
                       "turn its triangles over: only what passes forward is deleted")
        count = "once" if "once" in w else "each"
        self.put(f"fix             {w[1]} {w[2]} massflow/lsdcd mesh {mesh.file}{mesh.placement()} count {count}" +
                 " delete yes" * delete)
        if not forward:
            self.note(line, f"the mesh is wound against vec_side: f_{w[1]}[4] is the mass and f_{w[1]}[3] the number")
        if "file" in w or "append" in w:
            self.note(line, "no file with each grain that has passed")
        number, mass = (1, 2) if forward else (3, 4)
        self.mirrored[w[1]] = {1: f"f_{w[1]}[{mass}]", 2: f"f_{w[1]}[{number}]", 5: f"f_{w[1]}[8]", 6: f"f_{w[1]}[7]"}
        if forward:
            self.mirrored[w[1]][3] = f"f_{w[1]}[6]"

    def dump(self, line):
        w = line.words
        if line in self.dumps:
            self.gone[w[1]] = Left("a file of the wall", "nothing")
            self.put(f"# dump {w[1]}: see {'mesh_stl' if 'stl' in w[3] else 'mesh_fields'} of the wall")
        elif w[3] in ("custom/vtk", "atom/vtk"):
            columns = w[6:] if w[3] == "custom/vtk" else ["id", "type", "x", "y", "z", "radius"]
            self.put(self.renamed(line, f"dump            {w[1]} {w[2]} custom {w[4]} "
                                  f"{re.sub('[.]vt[kp]$', '.txt', w[5])} {' '.join(columns)}"))
            self.note(line, "text in place of VTK; dump vtk has the same words where LAMMPS has the package VTK")
        elif w[3] in SAME_DUMPS:
            self.put(self.renamed(line, line.text))
        else:
            raise Left(f"dump {w[3]}", "dump custom, or mesh_fields of the wall")


def arithmetic(text):
    """The value of a formula of numbers, + - * / ^ and brackets."""
    def value(node):
        if isinstance(node, ast.Expression):
            return value(node.body)
        if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
            return float(node.value)
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.UAdd)):
            return value(node.operand) * (-1 if isinstance(node.op, ast.USub) else 1)
        if isinstance(node, ast.BinOp):
            a, b = value(node.left), value(node.right)
            for kind, f in ((ast.Add, lambda: a + b), (ast.Sub, lambda: a - b), (ast.Mult, lambda: a * b),
                            (ast.Div, lambda: a / b), (ast.Pow, lambda: a ** b)):
                if isinstance(node.op, kind):
                    return f()
        raise ValueError(text)
    return value(ast.parse(text.replace("^", "**"), mode="eval"))


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("script", type=Path, help="input script of LIGGGHTS")
    p.add_argument("-o", "--out", type=Path, help="file to write (default: standard output)")
    p.add_argument("--radius", type=float, help="of a grain, where the script does not tell (model hooke)")
    p.add_argument("--density", type=float, help="of a grain")
    p.add_argument("--var", nargs=2, action="append", metavar=("NAME", "VALUE"), help="value of a variable")
    a = p.parse_args()
    try:
        script = Script(a.script, a)
        text = script.convert()
    except (CannotConvert, OSError) as error:
        sys.exit(f"convert.py: {error}\nNothing was written.")
    if a.out:
        with tempfile.NamedTemporaryFile("w", dir=a.out.parent, delete=False) as whole:
            whole.write(text)
        os.chmod(whole.name, 0o644)
        os.replace(whole.name, a.out)
    else:
        print(text, end="")
    for left in script.left:
        print(f"left: {left}", file=sys.stderr)
    print(f"commands left: {len(script.left)}" + (f", see LEFT in {a.out}" if a.out and script.left else ""), file=sys.stderr)


if __name__ == "__main__":
    main()
