#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Convert an input script of LIGGGHTS 3.8 to one of LAMMPS with fix wall/lsdcd.

  convert.py in.chute -o in.chute.lammps      then read every line of it that has LEFT or NOTE

Materials (property/global) and models become the numbers of the pair style and of the wall; mesh/surface, wall/gran,
move/mesh, massflow/mesh, insert/* and dump mesh/* become words of fix wall/lsdcd, fix massflow/lsdcd and fix
insert/lsdcd; what both programs know stays as it is, but for names such as atom_style granular.

A line is converted with the defaults of LIGGGHTS 3.8, or with --pfm of LIGGGHTS-PFM, or it is left: "commands left: 0"
means the same physics. A line that is left stays as a comment below a line
  # LEFT in.chute:34: why; do: what to do
and so does a line that needs what it makes. The same list is printed, and the exit code is 3; it is 0 where nothing is left, and 1
where nothing was written. A line with NOTE is converted, and says what to look at. The script is written
whole or, after an error, not at all. It reads the script from top to bottom as a program: a variable, an ID or a region is what it
is at that line, the lines of include stand in place of it, and loops and ifs stay as they are. What a loop or an if may change, and
what is needed here as a number, is left (or give --var NAME VALUE).

The radius and the density of the grains, which the model hooke needs, come from particletemplate/sphere, from set, from
the file of read_data, or from --radius and --density. Files are looked for beside the script.
A script that goes on from the restart file of another converted one is converted with --converted-restart.
doc/from-liggghts.md has what you must know or decide.
"""
import argparse
import collections
import copy
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
group/group gyration ke ke/atom msd pe pe/atom pressure property/atom property/local rdf reduce reduce/region stress/atom
temp contact/atom""".split())
MESH_DUMPS = {"mesh/stl", "stl", "mesh/vtk", "mesh/vtm", "mesh/gran/VTK"}
SAME_DUMPS = {"atom", "xyz", "image", "local", "custom", "movie"}
SAME_COMMANDS = set("""atom_modify boundary change_box clear compute_modify create_atoms create_box delete_atoms
dielectric dimension displace_atoms dump_modify echo fix_modify group if jump label lattice log mass minimize neigh_modify
neighbor newton next print processors read_data read_dump region replicate reset_timestep restart run set shell
thermo thermo_modify thermo_style timestep uncompute undump unfix units variable velocity write_data write_dump
write_restart quit info""".split())
MESH_FIELDS = set("""aedges area acorners distaa id interpolate nneigh nneighs overlap owner stress stresscomponents temp vel
wear""".split())    # words of dump mesh/vtk that are no IDs of meshes
PLAIN_COMMANDS = set("""delete_atoms echo jump log next print quit reset_timestep run shell thermo timestep variable velocity
write_data write_dump write_restart""".split())    # the same in both, where they stand in if and run
COLUMNS = set("""angmomx angmomy angmomz diameter element fx fy fz id ix iy iz mass mol mu mux muy muz omegax omegay omegaz proc q
radius tqx tqy tqz type vx vy vz x xs xsu xu y ys ysu yu z zs zsu zu""".split())    # of dump custom in both
SPINS = ("omegax", "omegay", "omegaz")
ATOM_VECTORS = set("fx fy fz id mass mol q type vx vy vz x y z".split())    # of variables in both
GONE_THERMO = {"cu", "erotate", "numbond", "dragtotal"}
SET_WORDS = {**dict.fromkeys("charge density diameter mass mol type vx vy vz x y z".split(), 1), "image": 3, "omega": 3,
             "type/fraction": 3,
             "omegax": 1, "omegay": 1, "omegaz": 1}
GONE_MESH_WORDS = {"heal": 1, "curvature": 1, "curvature_tolerant": 1, "verbose": 1, "precision": 1,
                   "min_feature_length": 1, "element_exclusion_list": 2, "stress": 1}
FORCE, TORQUE = (1, 2, 3), (4, 5, 6)
MAKERS = ("fix", "compute", "variable", "dump")
KINDS = {name[0]: name for name in MAKERS}
ENDERS = {"unfix": "f", "fix_modify": "f", "uncompute": "c", "compute_modify": "c", "undump": "d", "dump_modify": "d"}


class CannotConvert(Exception):
    """An error: no script is written."""


class Left(Exception):
    """A command that stays as a comment: why, what to do, and the nearest commands if they only wait to be taken."""

    def __init__(self, why, do, nearest=""):
        super().__init__(why)
        self.why, self.do, self.nearest = why, do, nearest


def options(words, known):
    """{word: its values} from the words of a command. `known` has the number of values of each word, or one number for
    each first value. A word that is not known ends the command: no word is ever looked for where an ID may stand."""
    values, words = {}, list(words)
    while words:
        key = words.pop(0)
        n = known.get(key)
        if isinstance(n, dict):
            n = n.get(words[0])
        if n is None:
            raise Left(f"the keyword {key}", "doc/from-liggghts.md has what you must decide, doc/fix_wall_lsdcd.rst all keywords; or write the line without it, if it does not matter")
        values[key] = [words.pop(0) for _ in range(n)]
    return values


def is_yes(values, key, default):
    """The value of a word that takes yes or no."""
    value = values.get(key, [default])[0]
    if value not in ("yes", "no"):
        raise Left(f"{key} {value}", "yes or no in its place")
    return value == "yes"


def needed_by(words):
    """Returns the fixes, computes, variables and dumps that a command needs: f_ID, c_ID, v_ID and d_ID."""
    needed = {m[0] or f"v_{m[1] or m[2]}" for m in re.findall(r"\b([fcv]_\w+)|\$\{(\w+)\}|\$([a-zA-Z])", " ".join(words))}
    return needed | {f"{ENDERS[words[0]]}_{words[1]}"} if words[0] in ENDERS and len(words) > 1 else needed


class Line:
    """A command, and what holds at it: its place in the whole program, the variables, the parts that a jump may skip, the loops
    around it, and the number of clear commands before it."""

    def __init__(self, number, text, file):
        self.number, self.text, self.file = number, text, file
        self.words = words_of(text)
        self.index, self.scope, self.skips, self.loops, self.stage = 0, {}, frozenset(), [], 0
        self.included = False    # of include: its lines follow

    def but(self, text):
        """The same command with another text."""
        other = copy.copy(self)
        other.text, other.words = text, words_of(text)
        return other


def words_of(text):
    """Words of a command, without its comment; quoted ones and $(...) in one piece."""
    found = re.findall(r'"[^"]*"|\'[^\']*\'|#.*|(?:\$\((?:[^()]|\([^()]*\))*\)|[^\s#"\'])+', text.replace("&\n", " "))
    return [w for w in found if not w.startswith("#")]


def nested(w):
    """The commands in the words of if and run."""
    if w[0] == "run":
        return [x for x in w[1:] if x[0] in "\"'" and " " in x]
    if w[0] == "if":
        return [x for k, x in enumerate(w) if k > 2 and x not in ("then", "elif", "else") and w[k - 1] != "elif"]
    return []


def commands_in(w):
    """Words of a command and of the commands in it."""
    return [w] + [inner for inner in (words_of(x.strip("\"'")) for x in nested(w)) if inner]


def read_lines(path):
    lines, begun, first = [], "", 1
    # Bytes that are no UTF-8, as in comments in Latin-1, are kept as they are.
    for number, text in enumerate(path.read_text(encoding="utf-8", errors="surrogateescape").split("\n"), 1):
        first = first if begun else number
        begun += text
        # A line goes on where it ends with &, also before a comment.
        if re.search(r"&\s*(#.*)?$", text):
            begun = re.sub(r"&\s*(#.*)?$", "&\n", begun)
            continue
        lines.append(Line(first, begun, path.name))
        begun = ""
    if lines and not lines[-1].text and not begun:
        lines.pop()    # the end of the last line
    return lines + ([Line(first, begun, path.name)] if begun else [])


# ---- variables ---------------------------------------------------------------------------

LEVELS = {level: k for k, levels in enumerate((["||"], ["&&"], ["==", "!="], ["<", "<=", ">", ">="], ["+", "-"], ["*", "/", "%"], ["^"]))
          for level in levels}
TWO = {"||": lambda a, b: a != 0 or b != 0, "&&": lambda a, b: a != 0 and b != 0, "==": lambda a, b: a == b, "!=": lambda a, b: a != b,
       "<": lambda a, b: a < b, "<=": lambda a, b: a <= b, ">": lambda a, b: a > b, ">=": lambda a, b: a >= b,
       "+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b, "/": lambda a, b: a / b, "%": math.fmod, "^": math.pow}
FUNCTIONS = {"sqrt": math.sqrt, "exp": math.exp, "ln": math.log, "log": math.log10, "abs": abs, "sin": math.sin, "cos": math.cos,
             "tan": math.tan, "asin": math.asin, "acos": math.acos, "atan": math.atan, "atan2": math.atan2, "ceil": math.ceil,
             "floor": math.floor, "round": lambda x: math.floor(x + 0.5)}
TOKEN = re.compile(r"\s*((?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[A-Za-z_]\w*|\|\||&&|[=!<>]=|[-+*/%^<>!(),])")
VARIABLE = re.compile(r"\$\{(\w+)\}|\$(\w)|\$\(((?:[^()]|\([^()]*\))*)\)")


def formula(text, variable):
    """The value of a formula of LAMMPS, where variable(NAME) is that of v_NAME: an operator takes what is left of it first, and a
    sign is stronger than ^. ValueError for what is known in a run only."""
    tokens, end = [], 0
    for found in TOKEN.finditer(text):
        if found.start() != end:
            break
        tokens.append(found[1])
        end = found.end()
    if text[end:].strip():
        raise ValueError(text)

    def take(expected=None):
        if not tokens or (expected and tokens[0] != expected):
            raise ValueError(text)
        return tokens.pop(0)

    def operand():
        token = take()
        if token == "(":
            value = terms(0)
            take(")")
        elif token in "-!":
            value = -operand() if token == "-" else float(operand() == 0)
        elif token[0].isdigit() or token[0] == ".":
            value = float(token)
        elif token.startswith("v_"):
            value = variable(token[2:])
        elif token in FUNCTIONS:
            take("(")
            values = [terms(0)]
            while tokens[:1] == [","]:
                take()
                values.append(terms(0))
            take(")")
            value = FUNCTIONS[token](*values)
        elif token == "PI":
            value = math.pi
        else:
            raise ValueError(text)
        return float(value)

    def terms(level):
        value = operand()
        while tokens and LEVELS.get(tokens[0], -1) >= level:
            token = take()
            value = float(TWO[token](value, terms(LEVELS[token] + 1)))
        return value

    try:
        value = terms(0)
    except (TypeError, ArithmeticError) as error:
        raise ValueError(text) from error
    if tokens:
        raise ValueError(text)
    return value


def number_of(name, scope, depth=0):
    """The value of v_NAME in a scope; ValueError where it is not known."""
    style, values = scope.get(name) or ("", [""])
    if depth > 50:
        raise ValueError(f"{name} is a formula of itself")
    return formula(values[0], lambda other: number_of(other, scope, depth + 1)) if style == "equal" else float(values[0])


def text_of(name, scope):
    """The text that stands for ${NAME}, or None."""
    if not scope.get(name):
        return None
    style, values = scope[name]
    try:
        return f"{number_of(name, scope):.15g}" if style == "equal" else values[0]
    except ValueError:
        return None


def expand(text, scope):
    """A text with the values of its variables that are known."""
    def new(m):
        if m[3] is None:
            value = text_of(m[1] or m[2], scope)
            return m[0] if value is None else value
        inner, _, form = m[3].partition(":%")
        try:
            value = formula(inner, lambda name: number_of(name, scope))
            return f"%{form}" % value if form else f"{value:.17g}"
        except (ValueError, TypeError):
            return m[0]
    return VARIABLE.sub(new, text)


class Program:
    """The lines of a script in the order in which they stand, those of include in place of it. Each line gets its scope: the style
    and values of each variable there, or None where a loop or an if may have changed it."""
    ONCE = {"index", "loop", "world", "universe", "uloop", "file", "atomfile"}    # a second definition has no effect

    def __init__(self, path, given):
        self.path, self.given = path, {name: ("index", [value]) for name, value in given}
        self.unread = False    # whether a file is named that was not read
        self.lines = self.with_includes(read_lines(path), 0)
        self.assigned = collections.Counter(name for line in self.lines for name in self.changed(line))
        for k, line in enumerate(self.lines):
            line.index = k
        self.loops, self.skips = self.jumps()
        for first, last in self.loops:
            for line in self.lines[first:last + 1]:
                line.loops.append((first, last))
        for skip in self.skips:
            for line in self.lines[skip[0]:skip[1] + 1]:
                line.skips |= {skip}
        self.give_scopes()

    def with_includes(self, lines, depth):
        found = []
        for line in lines:
            found.append(line)
            if line.words[:1] != ["include"] or len(line.words) < 2:
                self.unread = self.unread or self.reads_more(line) or any(
                    w[0] == "jump" and w[1:2] not in (["SELF"], [self.path.name]) for w in commands_in(line.words or [""]))
                continue
            # The name may be a variable that has one value.
            single = {name: values for name, values in self.given.items()}
            for w in (other.words for other in found):
                if w[:1] == ["variable"] and w[2:3] in (["index"], ["string"]) and len(w) == 4 and w[1] not in self.given:
                    single[w[1]] = None if w[1] in single else (w[2], [w[3].strip("\"'")])
            path = self.path.parent / expand(line.words[1], single)
            inner = read_lines(path) if path.is_file() and depth < 9 else []
            if inner and not any(c[0] in ("jump", "label") for other in inner for c in commands_in(other.words or [""])):
                line.included = True
                found += self.with_includes(inner, depth + 1)
            else:
                self.unread = True
        return found

    @staticmethod
    def reads_more(line):
        """Whether a command includes a file that was not read."""
        return not line.included and any(w[0] == "include" for w in commands_in(line.words or [""]))

    @staticmethod
    def changed(line):
        """Names of the variables that a command may give a value."""
        names = []
        for w in commands_in(line.words or [""]):
            names += w[1:2] if w[0] == "variable" else w[1:] if w[0] == "next" else []
        return names

    def jumps(self):
        """First and last lines of loops, and of what jumps may skip."""
        labels, loops, skips = {}, [], []
        for line in self.lines:
            if line.words[:1] == ["label"] and len(line.words) > 1:
                labels.setdefault(line.words[1], line.index)
        for line in self.lines:
            for w in commands_in(line.words or [""]):
                if w[0] != "jump" or w[1:2] not in (["SELF"], [self.path.name]):
                    continue
                to = [0] if len(w) < 3 else list(labels.values()) if "$" in w[2] else [labels[w[2]]] if w[2] in labels else []
                loops += [(first, line.index) for first in to if first <= line.index]
                skips += [(line.index + 1, label - 1) for label in to if label > line.index + 1]
        return loops, skips

    def give_scopes(self):
        scope, stage = dict(self.given), 0
        for line in self.lines:
            for first, last in self.loops:
                if first == line.index:
                    scope = self.unknown(scope, [x for x in self.lines[first:last + 1] if x.words[:1] != ["variable"] or
                                                 x.words[2:3] not in [[style] for style in self.ONCE]])
            for first, last in self.skips:
                if last + 1 == line.index:
                    scope = self.unknown(scope, self.lines[first:last + 1])
            stage += line.words[:1] == ["clear"]
            line.scope, line.stage = scope, stage
            self.give_words(line)
            scope = self.after(line, scope)

    def unknown(self, scope, lines):
        """The scope where what these lines give variables is not known."""
        names = {name for line in lines for name in self.changed(line)}
        if any(map(self.reads_more, lines)):
            names |= set(scope)
        return {**scope, **dict.fromkeys(names - set(self.given))}

    @staticmethod
    def give_words(line):
        """Gives a line the words that its variables stand for, as in model ${m}. Numbers stay ${x}, as a user may change them."""
        def new(m):
            style, values = line.scope.get(m[1]) or ("", [])
            return values[0] if style in ("index", "string") and len(values) == 1 and not re.match(r"[-+.\d$]", values[0]) else m[0]

        text = re.sub(r"\$\{(\w+)\}", new, line.text)
        if text != line.text and line.words[:1] != ["variable"]:
            line.words = words_of(text)

    def after(self, line, scope):
        """The scope behind a line."""
        w = line.words
        if w[:1] == ["variable"] and len(w) > 2:
            name, style, *values = w[1:]
            if name in self.given or (style in self.ONCE and name in scope):
                return scope
            # What stands in quotes is not replaced.
            values = [x[1:-1] if x[0] in "\"'" else expand(x, scope) for x in values]
            if style == "delete":
                return {other: value for other, value in scope.items() if other != name}
            if style == "loop" and all(x.isdigit() for x in values) and values and int(values[-1]) < 100000:
                values = [str(k) for k in range(int(values[0]) if len(values) > 1 else 1, int(values[-1]) + 1)]
                style = "index"
            return {**scope, name: (style, values) if style in ("index", "string", "equal") and values else None}
        if w[:1] == ["next"]:
            scope = dict(scope)
            for name in (x for x in w[1:] if x in scope):
                style, values = scope.pop(name) or ("", [])
                if style != "index":
                    scope[name] = None
                elif len(values) > 1:
                    scope[name] = (style, values[1:])
            return scope
        return self.unknown(scope, [line]) if self.changed(line) or self.reads_more(line) else scope


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
        self.id, self.group, self.style, self.line = w[1], w[2], script.style(w), line
        self.file, self.type, self.place, self.words, self.wear = None, 1, [], [], False
        self.servo, self.moves, self.com, self.axis, self.target = None, [], (0.0, 0.0, 0.0), None, None
        self.mass, self.moments, self.suspended, self.held = None, None, False, False    # of 6dof
        self.wall, self.wall_lines, self.index, self.several, self.reference = None, [], None, False, None
        self.written, self.body = set(), ""    # mesh_stl, mesh_fields; words of 6dof
        self.before, self.unsure = [], False    # variables that it needs; whether a jump may have changed its motions
        self.way, self.worn = [0.0, 0.0, 0.0], False    # how runs have moved it, None where that is no known way; whether they wore it
        self.first, self.wall_at = None, None    # ID of its wall, its place there, whether there are others; the line of its wall now
        self.parse(script, [script.carry(x, line, self.before) for x in w[4:]])

    def parse(self, script, w):
        number, values, surface, spin = script.number, {}, None, None
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
                axis, x, y, z, by, angle = take(6)
                if (axis, by) != ("axis", "angle"):
                    raise ValueError(key)
                self.place.append((key, [x, y, z, angle]))
            elif key == "surface_vel":
                surface = take(3)
            elif key == "surface_ang_vel":
                spin = take(10)
            elif key == "reference_point":
                self.reference = take(3)
            elif key == "wear":
                value = take(1)[0]
                if value not in ("finnie", "off"):
                    raise Left(f"wear {value}", "wear finnie or archard")
                self.wear = value == "finnie"
            elif key in ("com", "axis") or (key in ("vel", "angmom", "forceflags", "torqueflags") and self.style.endswith("/6dof")):
                values[key] = take(3)
            elif key == "moi" and self.style.endswith("/6dof"):
                values[key] = take(6)
            elif key == "mass" and self.style.endswith("/6dof"):
                values[key] = take(1)[0]
            elif key == "suspension" and self.style.endswith("/6dof"):
                values[key] = take(8)
            elif key == "rot_flip":
                raise Left(f"{key} of a mesh with 6dof", "limits of a body on a hinge, which stop it without a rebound")
            elif key in ("ctrlPV", "target_val", "vel_max", "kp", "ki", "kd", "mode", "ratio"):
                values[key] = take(1)[0]
            elif key in ("temperature", "mass_temperature"):
                raise Left(f"{key} of a mesh", "the sub-model heat and the keyword temperature of fix wall/lsdcd")
            elif key in GONE_MESH_WORDS:
                take(GONE_MESH_WORDS[key])
            else:
                raise Left(f"the keyword {key} of a mesh", "fix_wall_lsdcd.rst")
        if self.file is None or not self.file.lower().endswith((".stl", ".obj", ".ply", ".off")):
            raise Left(f"the file {self.file}", "write it as STL")
        self.path = script.folder / expand(self.file, self.line.scope)
        if self.path.is_file() and self.path.open("rb").read(1) == b"#":
            raise Left(f"the file {self.file}, which begins with a comment", "the file without its lines before 'solid'")
        if self.style.endswith("/stress/servo"):
            self.add_servo(script, values)
            self.reference = self.reference or list(self.com)
        elif self.style.endswith("/stress/6dof"):
            self.add_body(script, values)
        elif self.style not in ("mesh/surface", "mesh/surface/planar", "mesh/surface/stress"):
            raise Left(f"the module of {self.style}", "mesh/surface/stress; others are not there")
        if surface:
            self.add_surface_vel(script, surface)
        if spin:
            self.add_surface_ang_vel(script, spin)

    def faces(self, script):
        """Corners and normal of each triangle of the placed mesh; None where the file is not there."""
        if not self.path.exists():
            return None
        found = [(t, cross(minus(t[1], t[0]), minus(t[2], t[0]))) for t in self.triangles(script)]
        return [(t, unit(n)) for t, n in found if any(n)]

    # LIGGGHTS lays the velocity into each triangle and then gives it its full size again; here it keeps what lies in
    # the triangle. Both are the same where no triangle is inclined to it. One that it meets head-on has none.

    def add_surface_vel(self, script, words):
        kept, faces = " ".join(words), self.faces(script)
        try:
            v = [script.number(x, self.line) for x in words]
        except Left:
            raise Left("surface_vel of a variable", "the keyword surface_vel takes v_NAME too: give it the velocity along "
                       "the triangles, in the size that LIGGGHTS keeps") from None
        size = math.sqrt(dot(v, v))
        if faces is None:
            script.unchecked.add(self.id)
        elif size and any(1e-3 * size < abs(dot(v, n)) < (1 - 1e-6) * size for _, n in faces):
            ways = [None if abs(dot(v, n)) > (1 - 1e-6) * size else unit(minus(v, [dot(v, n) * x for x in n])) for _, n in faces]
            if None in ways or any(math.dist(way, ways[0]) > 1e-3 for way in ways):
                raise Left("surface_vel on triangles of several slopes, each of which has its full size in LIGGGHTS",
                           "cut the mesh into parts of one slope, each with its surface_vel along it")
            kept = " ".join(short(round(size * x, 9) + 0.0) for x in ways[0])
        self.words.append(f"surface_vel {kept}")

    def add_surface_ang_vel(self, script, words):
        origin, ox, oy, oz, along, ax, ay, az, omega_word, omega = words
        if (origin, along, omega_word) != ("origin", "axis", "omega"):
            raise ValueError("surface_ang_vel")
        axis = unit([script.number(v, self.line) for v in (ax, ay, az)])
        faces = self.faces(script)
        if faces is None:
            script.unchecked.add(self.id)
        else:
            o = [script.number(v, self.line) for v in (ox, oy, oz)]
            for t, n in faces:
                for p in t:
                    v = cross(axis, minus(p, o))
                    # 0.2: the sides of a roll of 16 facets, where the two differ by 2 %.
                    if 0.2 * math.sqrt(dot(v, v)) < abs(dot(v, n)) < (1 - 1e-6) * math.sqrt(dot(v, v)):
                        raise Left("surface_ang_vel on triangles that are inclined to it, which LIGGGHTS lays into each in its "
                                   "full size", "motion rotate, if the part turns; or a mesh of revolution")
        spin = [script.number(omega, self.line) * a for a in axis]
        self.words.append("surface_angvel " + " ".join(map(short, spin)) + f" {ox} {oy} {oz}")

    def add_body(self, script, v):
        missing = [k for k in ("com", "mass", "moi") if k not in v]
        if missing:
            raise CannotConvert(f"{script.at(self.line)}: 6dof without {missing[0]}")
        self.com, self.mass, self.moments = v["com"], v["mass"], [script.number(x, self.line) for x in v["moi"]]
        self.body = f"body mass {self.mass} com {' '.join(self.com)} inertia {' '.join(v['moi'])}"
        self.body += self.joint(script, v)
        self.held = "joint" in self.body
        if "vel" in v:
            self.body += f" velocity {' '.join(v['vel'])}"
        if any(script.number(x, self.line) for x in v.get("angmom", [])):
            xx, yy, zz, xy, xz, yz = (script.number(x, self.line) for x in v["moi"])
            rows = [(xx, xy, xz), (xy, yy, yz), (xz, yz, zz)]
            # omega is the inverse of the tensor times the momentum, by Cramer's rule.
            momentum = [script.number(x, self.line) for x in v["angmom"]]
            size = dot(rows[0], cross(rows[1], rows[2]))
            omega = [dot(momentum, cross(rows[(k + 1) % 3], rows[(k + 2) % 3])) / size for k in range(3)]
            self.body += " omega " + " ".join(map(short, omega))

    def joint(self, script, v):
        """The joint that has the flags of LIGGGHTS, which drop components of force and torque along x, y and z. They hold a turning
        body to an axis only where that axis is a principal one."""
        moves, turns = ([script.number(x, self.line) != 0 for x in v.get(key, "111")] for key in ("forceflags", "torqueflags"))
        speed, spin = ([script.number(x, self.line) for x in v.get(key, "000")] for key in ("vel", "angmom"))
        xy, xz, yz = self.moments[3:]
        principal = (xy == xz == 0, xy == yz == 0, xz == yz == 0)
        held = not any(x and not free for x, free in zip(speed + spin, moves + turns))
        axes = ["1 0 0", "0 1 0", "0 0 1"]
        if all(moves + turns):
            words, axis = "", None
        elif held and sum(moves) == 1 and not any(turns):
            axis = moves.index(True)
            words = f" joint slider {axes[axis]}"
        elif held and not any(moves) and sum(turns) == 1 and principal[turns.index(True)]:
            axis = turns.index(True)
            words = f" joint hinge {' '.join(self.com)} {axes[axis]}"
        elif held and sum(moves) == 2 and sum(turns) == 1 and turns.index(True) == moves.index(False) and principal[turns.index(True)]:
            axis, words = None, f" joint planar {axes[turns.index(True)]}"
        elif held and not any(moves) and all(turns):
            axis, words = None, f" joint ball {' '.join(self.com)}"
        else:
            raise Left("forceflags or torqueflags of a mesh with 6dof, which hold the body to axes that a turn does not follow",
                       f"joint slider, planar, hinge or ball after {self.body}")
        if "suspension" in v:
            if axis is None:
                raise Left("suspension of a mesh with 6dof that has more than one way to move", "spring of a body on a hinge or slider")
            if script.runs() > 1:
                raise Left("suspension of a mesh with 6dof, whose zero begins anew with each run in LIGGGHTS",
                           f"{words.strip()} spring with its stiffness, damping and rest; its zero stays where it was")
            if v["suspension"][::2] != ["k_t", "c_t", "k_r", "c_r"]:
                raise ValueError("suspension")
            words += " spring " + " ".join(v["suspension"][1:4:2] if any(moves) else v["suspension"][5::2])
            self.suspended = True
        return words

    def mobility(self, script):
        """The most that a unit impulse changes the velocity of a point of the body along the impulse. None where the file is not there."""
        faces = self.faces(script)
        if faces is None:
            return None
        com, (xx, yy, zz, xy, xz, yz) = [script.number(x, self.line) for x in self.com], self.moments
        arm = max(math.dist(p, com) for t, _ in faces for p in t)
        least = min(xx, yy, zz)
        if xy or xz or yz:
            # The product of the larger two moments is at most the square of half the trace.
            least = dot((xx, xy, xz), cross((xy, yy, yz), (xz, yz, zz))) / ((xx + yy + zz) / 2) ** 2
        return 1 / script.number(self.mass, self.line) + arm * arm / least

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
        if not self.path.exists():
            raise CannotConvert(f"{script.at(self.line)}: {self.path} is not there, and the mesh is needed to convert this")

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

        triangles = [tuple(placed(p) for p in t) for t in read_stl(self.path)]
        if not triangles:
            raise Left(f"{self.file}, in which no triangle was found", "write it as STL")
        return triangles

    def output(self, k, script):
        """What stands for element k of this fix in LAMMPS. Forces of 6dof have the weight and the suspension in them there."""
        wall, index, several = (self.wall, self.index, self.several) if self.wall else script.later[self.id]
        each = f"f_{wall}" + f"[{index}]" * several
        if self.body and k > 6:
            # The quaternion of LIGGGHTS begins with the principal axes.
            return f"f_{wall}[{k + 8 if k < 10 else k + 11}]" if k < 10 or (k < 14 and not any(self.moments[3:])) else None
        if self.suspended:
            return None
        if self.body and k in FORCE and script.gravities:
            g = script.gravities[0]
            if g is None or len(script.gravities) > 1:
                return None
            return f"({each}[{k}]+{self.mass}*({short(g[k - 1])}))" if g[k - 1] else f"{each}[{k}]"
        if k in FORCE + TORQUE:
            return f"{each}[{k}]"
        if k in (7, 8, 9) and self.servo:
            return self.com[k - 7] if self.axis[k - 7] == 0 else f"({self.com[k - 7]}+({short(self.axis[k - 7])})*{each}[12])"
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
        radii = [s[0] for s in script.sizes if s]
        self.radius = min(radii) if radii else None

    def elastic(self):
        e, n = [self.get("youngsModulus", k) for k in (self.i, self.j)], \
               [self.get("poissonsRatio", k) for k in (self.i, self.j)]
        y = 1 / sum((1 - v * v) / x for x, v in zip(e, n))
        g = 1 / sum(2 * (2 - v) * (1 + v) / x for x, v in zip(e, n))
        return y, g

    def beta(self):
        """-ln e / sqrt(ln^2 e + pi^2)."""
        e = self.get("coefficientRestitution", self.i, self.j)
        if not 0 < e <= 1:
            raise Left(f"a restitution of {short(e)} between the types {self.i} and {self.j}", "one above 0, at most 1")
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
    """The words after model, in pair_style gran and fix wall/gran. Their order is fixed, and a model without its word is
    off, as in contact_models.cpp of LIGGGHTS 3.8; LIGGGHTS-PFM has no_history."""
    ORDER = {"model": "normal", "tangential": "tangential", "cohesion": "cohesion", "rolling_friction": "rolling",
             "surface": "surface"}
    # Settings that are off without their word, but for tangential_damping. Those that are not handled may be off.
    HANDLED = ("tangential_damping", "limitForce", "ktToKnUser", "absolute_damping")
    OTHERS = ("viscous", "computeElasticPotential", "computeDissipatedEnergy", "disableNormalWhenBonded",
              "disableTangentialWhenBonded", "heating_normal_hooke", "heating_normal_hertz", "heating_tangential_history",
              "heating_tracking", "tangential_reduce", "torsionTorque", "torsion")

    def __init__(self, words, pfm):
        self.normal = self.cohesion = self.rolling = None
        self.nearest = False
        self.tangential = "no_history" if pfm else None
        self.surface, self.on, self.rest = "default", {"tangential_damping"}, list(words)
        for word, name in self.ORDER.items():
            if self.rest[:1] == [word]:
                value = self.rest[1]
                setattr(self, name, None if value == "off" else value)
                del self.rest[:2]

    def settings(self, words, of):
        """The words at the end."""
        while words:
            w, value = words.pop(0), words.pop(0) if words else None
            if w not in self.HANDLED + self.OTHERS or value not in ("on", "off") or (value == "on" and w in self.OTHERS):
                raise Left(f"the keyword {w} of {of}", "see fix_wall_lsdcd.rst and the manual of LAMMPS")
            (self.on.add if value == "on" else self.on.discard)(w)

    @property
    def limit(self):
        return "limitForce" in self.on

    @property
    def damped(self):
        return "tangential_damping" in self.on

    def check(self):
        if self.surface != "default":
            raise Left(f"surface {self.surface}", "spheres only")
        if self.normal not in ("hooke", "hertz", "hooke/stiffness", "hertz/stiffness"):
            raise Left(f"model {self.normal or 'off'}", "hooke or hertz; others are not there")
        if self.tangential not in ("history", "no_history", None):
            raise Left(f"tangential {self.tangential}", "history or no_history")
        if "absolute_damping" in self.on:
            raise Left("absolute_damping", "write the damping over the mass of a grain as gamman")

    def friction(self, c):
        """Without a tangential model there is none."""
        return c.friction() if self.tangential else 0.0

    def extras(self, c, classic):
        """Rolling and cohesion of the wall, which go with classic styles."""
        words = ""
        if self.rolling in ("cdt", "epsd2") and classic:
            words += f" rolling {self.rolling} {short(c.get('coefficientRollingFriction', c.i, c.j))}"
        elif self.nearest:
            words += self.nearest_rolling(c)
        elif self.rolling:
            raise self.left_rolling(c)
        if self.cohesion == "sjkr" and classic:
            words += f" cohesion sjkr {short(c.get('cohesionEnergyDensity', c.i, c.j))}"
        elif self.cohesion:
            raise Left(f"cohesion {self.cohesion} with model {self.normal}", "granular jkr or dmt, or model hooke with sjkr")
        return words

    def dissipates(self, c):
        """Whether a contact has a dashpot."""
        if "stiffness" in self.normal:
            return any(c.get(name, c.i, c.j) != 0 for name in ("gamman", "gammat"))
        return c.beta() > 0

    def drop_zeros(self, contacts):
        """Takes out rolling friction and cohesion whose coefficients are 0 in all contacts: they have no torque, no force. Where one has
        some, each needs its words, as a law of a mesh without them has those of the wall."""
        if self.rolling in ("cdt", "epsd2") and not any(c.get("coefficientRollingFriction", c.i, c.j) for c in contacts):
            self.rolling = None
        if self.cohesion in ("sjkr", "sjkr2") and not any(c.get("cohesionEnergyDensity", c.i, c.j) for c in contacts):
            self.cohesion = None
        # LAMMPS's rolling with a spring is the nearest to these.
        self.nearest = self.rolling in ("cdt", "epsd2") and self.normal == "hertz"

    @staticmethod
    def nearest_rolling(c):
        """The rolling of LAMMPS with the limit mu R F of cdt and epsd2, and the spring of epsd2 at an overlap of 0.1 % of the radius."""
        k = short(float(f"{8 * c.elastic()[1] * c.radius * math.sqrt(1e-3):.3g}")) if c.radius else "K"
        return f" rolling sds {k} 0 {short(c.get('coefficientRollingFriction', c.i, c.j))}"

    def left_rolling(self, c, nearest=""):
        why = f"rolling_friction {self.rolling} with model {self.normal}"
        do = "pair_style granular with hooke and rolling sds k 0 mu, k the tangential stiffness for epsd2"
        if self.normal == "hertz" and self.rolling in ("cdt", "epsd2"):
            # epsd2 has the tangential spring times R^2, and both the limit mu R F.
            why += {"cdt": ", which is a torque without a spring: LAMMPS has rolling with a spring only",
                    "epsd2": ", whose spring grows with the overlap: that of LAMMPS does not"}[self.rolling]
            k = 8 * c.elastic()[1]
            do = (f"granular with rolling sds k 0 {short(c.get('coefficientRollingFriction', c.i, c.j))}, k = "
                  f"{short(k)} sqrt(R overlap) at the overlap of most contacts")
            if c.radius:
                do += f", which is {k * c.radius * math.sqrt(1e-3):.3g} at an overlap of 0.1 % of R = {short(c.radius)}"
            do += "; or model hooke with cdt or epsd2 on the wall"
        if nearest:
            do = "the lines with #: below are the nearest" + ", with a number for K" * (c.radius is None) + ": " + do
        return Left(why, do, nearest)

    def classic(self, c, r, m):
        """Words of a classic style for a contact whose effective radius and mass are r and m."""
        mu = short(self.friction(c))
        if self.normal == "hooke":
            k, g = c.hooke(r, m)
            kt, gt = (k * 2 / 7 if "ktToKnUser" in self.on else k), g
        else:
            k, kt, g, gt = (c.get(n, c.i, c.j) for n in ("kn", "kt", "gamman", "gammat"))
        style = {"hooke": "hooke", "hertz": "hertz"}[self.normal.split("/")[0]]
        if self.tangential == "history" or style == "hertz":
            style += "/history"
        if style == "hertz/history" and self.tangential == "no_history":
            raise Left("hertz/stiffness with tangential no_history", "granular hertz with tangential linear_nohistory")
        return style, f"{short(k)} {short(kt)} {short(g)} {short(gt)} {mu} {int(self.damped and bool(self.tangential))}"

    def hertz(self, c):
        """Stiffnesses, damping, its share across the normal, friction."""
        y, g = c.elastic()
        share = math.sqrt(4 * g / y) if self.damped and self.tangential else 0.0
        return 4 / 3 * y, 8 * g, math.sqrt(5) * c.beta(), share, self.friction(c)

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
                " limit_damping" * self.limit + (self.nearest_rolling(c) if self.nearest else ""))


class Wall:
    """The words of a fix wall/gran: the model, then words of the wall, then settings of the model."""

    def __init__(self, script, line):
        self.line, self.model, self.ids, self.stored = line, Model(line.words[4:], script.options.pfm), [], False
        self.shape, self.place, self.type, self.shear = None, [], None, []
        w, n, mesh = self.model.rest, 0, False
        while w:
            if w[0] == "mesh":
                mesh = w.pop(0)
            elif w[0] == "n_meshes":
                n = int(script.number(w[1], line))
                del w[:2]
            elif w[0] == "meshes" and mesh:
                self.ids = w[1:1 + n]
                if len(self.ids) < max(1, n):
                    raise ValueError("meshes")
                del w[:1 + n]
            elif w[0] == "primitive":
                if w[1] != "type":
                    raise ValueError("primitive without type")
                self.type, self.shape = int(script.number(w[2], line)), w[3]
                del w[:4]
                n_values = 1 if self.shape.endswith("plane") else 3
                self.place = [w.pop(0) for _ in range(n_values)]
            elif w[0] == "shear":
                self.shear = w[:3]
                del w[:3]
            elif w[0] in ("store_force", "store_force_contact", "store_force_contact_every", "store_force_contact_stress"):
                self.stored = self.stored or w[1] != "no"
                del w[:2]
            else:
                break
        self.model.settings(w, "wall/gran")
        if mesh and not self.ids:
            raise ValueError("mesh without meshes")
        if not mesh and not self.shape:
            raise Left("a form of wall/gran that is older than 3.0", "wall/gran of LAMMPS has these words")


# ---- the script --------------------------------------------------------------------------

class Script:
    def __init__(self, path, options):
        self.path, self.folder, self.options = path, path.parent, options
        self.program = Program(path, options.var or [])
        self.lines = self.program.lines
        # What is known of the whole script.
        self.properties, self.grain_types, self.all_types = {}, set(), self.program.unread
        self.sizes = [None] * self.program.unread
        self.missing_data, self.data_boxes = [], {}    # files of read_data; edges of the box in them, by line
        self.meshes, self.mesh_of, self.walls, self.unchecked, self.used = {}, {}, {}, set(), set()    # by line; IDs
        self.dumps, self.dumped, self.lattice = [], {}, False
        self.gravity_names, self.gravities = set(), []    # the acceleration of each fix gravity, None where it is not known
        self.names = {"c_thermo_temp", "c_thermo_press", "c_thermo_pe"} | {
            f"{line.words[0][0]}_{line.words[1]}" for line in self.lines if line.words[:1] in (["fix"], ["compute"]) and line.words[1:]}
        for line in self.lines:
            try:
                self.collect(line)
            except (IndexError, ValueError):
                raise CannotConvert(f"{self.at(line)}: words are missing or wrong: {line.text.strip()}") from None
        if options.radius and options.density:
            self.sizes = [(options.radius, options.density)]
        # What is known at a line, in the order of the script.
        self.out, self.left, self.left_variables = [], [], set()
        self.noted, self.noted_dashpot, self.units = False, False, "lattice" if options.pfm else "box"
        self.waiting = set()    # what lines with #: make: f_ID of fixes, and so on with c_, v_ and, of dumps, d_
        self.early, self.later = set(), {}    # meshes that are named before their wall, and its ID and place
        self.ran = 0
        self.clear()

    def clear(self):
        """What the command clear forgets: all but variables."""
        self.meshes, self.gone, self.alive, self.moves, self.plain = {}, {}, set(), {}, set()    # alive: fixes of LAMMPS
        self.templates, self.distributions = {}, {}    # of constant spheres, and words of distributions, with their lines
        self.regions, self.box, self.box_moves, self.faces, self.pair = {}, {}, False, ["f"] * 6, None
        self.mirrored, self.texts, self.parts, self.feeds, self.helpers = {}, set(), {}, {}, {}
        self.computed, self.spun = set(), False
        self.named, self.named_flows = {}, {}    # outputs that lines have taken, of meshes and of other fixes
        self.densities = {}    # of set and insertions: of the groups or regions, the last one at the end; None: not known
        self.step, self.timestep, self.sources = 0, None, []    # here, None where it is not known; what has made grains

    def at(self, line):
        return f"{line.file}:{line.number}"

    # -- what is known of the whole script

    def number(self, word, line):
        """The value of a word at a line."""
        text = expand(word, line.scope).strip("\"'")
        try:
            return float(text)
        except ValueError:
            pass
        try:
            return formula(text, lambda name: number_of(name, line.scope))
        except ValueError:
            raise Left(f"'{word}' of {self.at(line)} is no number that is known here",
                       "give the values of its variables with --var NAME VALUE, or write numbers") from None

    def known(self, word, line):
        """A number, or None."""
        try:
            return self.number(word, line)
        except Left:
            return {"INF": math.inf, "-INF": -math.inf}.get(word)

    def carry(self, word, line, before, to=None):
        """A word that is written at another line than its own: each variable in it that has several values in the script becomes the
        value at its line, or one that keeps it, whose command goes to `before`. `to` is an earlier line, which knows fewer variables."""
        def new(m):
            name = m[1] or m[2]
            if name and self.steady(name, line) and (to is None or to.scope.get(name) == line.scope.get(name)):
                return m[0]
            value = expand(m[0], line.scope)
            if "$" not in value or (name and name in self.program.given):
                return value
            if to is not None:
                raise Left(f"{m[0]}, which is not known where the wall is", "a name without it")
            kept = f"lsdcd_{line.words[1]}_{name or len(before)}"
            if f"variable        {kept} string {m[0]}" not in before:
                before.append(f"variable        {kept} string {m[0]}")
            return f"${{{kept}}}"
        return VARIABLE.sub(new, word)

    def steady(self, name, line, depth=0):
        """Whether a variable has one value in the whole script."""
        found, times = line.scope.get(name), self.program.assigned[name]
        if times == 0 or not found or times > 1 or name in self.program.given:
            return times == 0 and (name in self.program.given or not self.program.unread)

        def other(name):
            if depth > 50 or not self.steady(name, line, depth + 1):
                raise ValueError(name)
            return 1.0

        try:
            text = VARIABLE.sub(lambda m: m[0] if self.program.assigned[m[1] or m[2]] else "1", found[1][0])
            if found[0] == "equal":
                formula(text, other)
        except ValueError:
            return False
        return True

    def sure(self, where, line):
        """Whether a line above, `where`, has always been the last one of its ID at `line`; else raises Left."""
        changed = [x for first, last in line.loops if where.index < first for x in self.lines[first:last + 1]
                   if x is not where and x.words[:2] == where.words[:2]]
        if not where.skips <= line.skips or changed:
            raise Left(f"{' '.join(where.words[:2])} of {self.at(where)}, which a jump may " + ("change" if changed else "skip"),
                       "a script for each case, or other IDs")

    def runs(self):
        """The number of runs; 2 for one in a loop."""
        return sum(2 if line.loops else 1 for line in self.lines for w in commands_in(line.words or [""]) if w[0] == "run")

    def property(self, line, name, *types):
        found = [d for d in self.properties.get(name, []) if d[0].stage == line.stage]
        if not found:
            text = f"needs fix property/global {name}, which the script does not have"
            raise Left(text, "its values in this script") if self.program.unread else CannotConvert(f"{self.at(line)}: {text}")
        before = [d for d in found if d[0].index < line.index][-1:]
        later = [d for d in found if d[0].index > line.index]
        where, w = (before + later)[0]
        self.sure(where, line)
        values = [[expand(x, d[0].scope) for x in d[1]] for d in [(where, w), *later]]
        if any(x != values[0] for x in values):
            raise Left(f"{name}, which changes in the script", "write the law of each stage yourself")
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
        if w[0] == "fix" and len(w) > 3 and self.grows(w):
            self.sizes.append(None)
        elif w[0] == "fix" and len(w) > 3:
            style = self.style(w)
            if style == "gravity":
                g = [self.known(x, line) for x in [w[4], *w[6:9]]]
                self.gravity_names.add(w[1])
                self.gravities.append([g[0] * x for x in unit(g[1:])] if w[5] == "vector" and None not in g and len(g) == 4 else None)
            elif style == "property/global":
                self.properties.setdefault(w[4], []).append((line, w[5:]))
            elif style.startswith("mesh/surface"):
                try:
                    mesh = Mesh(self, line)
                except Left as left:
                    mesh = left
                self.mesh_of[line] = self.meshes[w[1]] = mesh
            elif style == "particletemplate/sphere":
                kind, *size = self.template(line)
                self.add_type(kind)
                self.sizes.append(None if None in size else tuple(size))
            elif style == "wall/gran":
                try:
                    self.walls[line] = wall = Wall(self, line)
                except Left as left:
                    self.walls[line] = left
                    return
                for mesh in (self.meshes.get(i) for i in wall.ids):
                    if isinstance(mesh, Mesh):
                        mesh.wall_lines.append(line)
            elif style == "move/mesh":
                self.used.add(w[5])
        elif w[0] == "dump" and len(w) > 5 and w[3] in MESH_DUMPS and "ghost" not in w[6:]:
            self.dumps.append(line)
            self.dumped[line] = set()
        elif w[0] == "read_data":
            self.read_data(line)
        elif w[0] == "create_atoms":
            self.add_type(self.known(w[1], line))
        elif w[0] == "set":
            for word in (x for x in ("type", "type/fraction") if x in w[3:]):
                self.add_type(self.known(w[w.index(word, 3) + 1], line))
            if any(word in w[3:] for word in ("diameter", "density", "mass")):
                size = [self.known(w[w.index(word, 3) + 1], line) if word in w[3:] else None for word in ("diameter", "density")]
                self.sizes.append(None if None in size or "mass" in w[3:] else (size[0] / 2, size[1]))
        elif w[0] in ("read_restart", "read_dump"):
            self.all_types = True
        elif w[0] == "unfix" and w[1] in self.gravity_names:
            self.gravities.append(None)
        elif w[0] == "lattice":
            self.lattice = True

    def add_type(self, kind):
        """A type that grains may have; None where it is not known."""
        if kind is None:
            self.all_types = True
        else:
            self.grain_types.add(int(kind))

    @staticmethod
    def style(w):
        """The style of a fix. A style of OpenMP is the same one."""
        return w[3][:-4] if w[3].endswith("/omp") else w[3]

    def template(self, line):
        """Type, radius and density of a fix particletemplate/sphere; None where they are not known or not constant."""
        w = line.words
        try:
            v = options(w[5:], {"atom_type": 1, "volume_limit": 1, "relative": 1,
                                "radius": {"constant": 2, "uniform": 3, "gaussian": 3},
                                "density": {"constant": 2, "uniform": 3, "gaussian": 3}})
        except Left:
            v = {}
        size = [self.known(v[k][1], line) if v.get(k, [""])[0] == "constant" and "relative" not in v else None
                for k in ("radius", "density")]
        # A word that is not known may hide the type.
        kind = self.known(w[w.index("atom_type", 5) + 1], line) if "atom_type" in w[5:] else 1
        return kind, *size

    def read_data(self, line):
        name = expand(line.words[1], line.scope)
        path = self.folder / name
        self.data_boxes[line] = {}
        if not path.exists():
            self.missing_data.append(name)
            self.all_types = True
            return
        text = path.read_text(encoding="utf-8", errors="surrogateescape")
        for lo, hi, a in re.findall(r"^\s*(\S+)\s+(\S+)\s+([xyz])lo [xyz]hi", text, re.M):
            self.data_boxes[line][a] = (float(lo), float(hi))
        part = re.search(r"^Atoms.*?\n\s*\n(.*?)(?:\n\s*\n|\Z)", text, re.M | re.S)
        for row in (part[1].splitlines() if part else []):
            w = row.split()
            if len(w) > 6:
                self.grain_types.add(int(w[1]))
                self.sizes.append((float(w[2]) / 2, float(w[3])))

    def size(self, line):
        """Radius and mass of a grain."""
        if not self.sizes and self.missing_data:
            raise Left(f"model hooke needs the size of a grain, and {self.missing_data[0]} is not beside the script",
                       "convert the script in the folder of that file, or give --radius and --density")
        if not self.sizes:
            raise Left("model hooke needs the size of a grain, which this script does not tell", "give --radius and --density")
        masses = [4 / 3 * math.pi * s[0] ** 3 * s[1] if s else math.inf for s in self.sizes]
        if max(masses) > 1.001 * min(masses) or math.inf in masses:
            raise Left("model hooke has a stiffness for each mass, and the grains differ",
                       "model hertz; or --radius and --density, the grain whose stiffness all shall have")
        return self.sizes[0][0], masses[0]

    def grains(self):
        """Types that grains may have: those that the script makes, or all that have a modulus."""
        if self.grain_types and not self.all_types:
            return sorted(self.grain_types)
        moduli = [len(w) - 1 for _, w in self.properties.get("youngsModulus", [])]
        return list(range(1, max(moduli, default=1) + 1))

    # -- writing

    def put(self, text):
        self.out.append(text)

    def note(self, line, text):
        self.put(f"# NOTE {self.at(line)}: {text}")

    def leave(self, line, why, do, nearest="", takes=True):
        """Makes a line a comment. Returns whether the nearest commands wait below it. `takes`: they may be taken."""
        # Where no number waits for a choice, --nearest takes the nearest commands.
        if nearest and takes and self.options.nearest and " K " not in nearest:
            self.note(line, f"--nearest: {why}")
            self.put(nearest)
            return False
        self.left.append(f"{self.at(line)}: {why}; do: {do}")
        self.put(f"# LEFT {self.left[-1]}")
        self.put("\n".join("# " + t for t in line.text.splitlines()))
        for text in nearest.splitlines():
            self.put(f"#: {text}")
        return bool(nearest)

    @staticmethod
    def grows(w):
        """Whether a fix changes diameters, which only an atom style with dynamic radii lets it do."""
        return w[:1] == ["fix"] and w[3:4] == ["adapt"] and w[5:7] == ["atom", "diameter"]

    def convert(self):
        text = self.written()
        walls = [i for wall in self.walls.values() if isinstance(wall, Wall) for i in wall.ids]
        later = {mesh.id: mesh.first for mesh in self.mesh_of.values()
                 if isinstance(mesh, Mesh) and mesh.id in self.early and mesh.first and walls.count(mesh.id) == 1}
        if later:
            # Lines name a mesh before its wall, whose ID and place is known now.
            self.__init__(self.path, self.options)
            self.later = later
            text = self.written()
        return text

    def written(self):
        self.put(f"# Converted from {self.path.name} by convert.py of LSDCD. Read the lines with LEFT and NOTE.")
        for line in self.lines:
            self.come_back(line)
            if not line.words:
                self.put(line.text)
                continue
            before, moved, waits = len(self.out), None, False
            if line.words[0] in ("fix", "dump", "compute") and len(line.words) > 1:
                moved = self.moves.get(line.words[1])
                self.gone.pop(line.words[1], None)
                self.plain.discard(line.words[1])
            try:
                self.command(line)
            except (IndexError, ValueError):
                raise CannotConvert(f"{self.at(line)}: words are missing or wrong: {line.text.strip()}") from None
            except Left as left:
                del self.out[before:]
                waits = self.leave(line, left.why, left.do, left.nearest)
                if line.words[0] == "fix":
                    self.end_replaced(line, moved)
                if line.words[0] in ("fix", "dump", "compute") and not left.nearest:
                    self.gone[line.words[1]] = left
                elif line.words[0] == "variable":
                    self.left_variables.add(f"v_{line.words[1]}")
            else:
                made = rf"fix +{re.escape(line.words[1])} " if line.words[0] == "fix" else None
                if made and any(isinstance(text, str) and re.match(made, text) for text in self.out[before:]):
                    self.alive.add(line.words[1])
            self.hold(line, before)
            if waits and line.words[0] in MAKERS:
                self.waiting.add(f"{line.words[0][0]}_{line.words[1]}")
        return "\n".join(text if isinstance(text, str) else self.mesh_dump(text) for text in self.out) + "\n"

    def hold(self, line, before):
        """Makes commands of a line that need what waits wait, too, as comments with #:."""
        commands, waits, needs = self.out[before:], [], set()
        del self.out[before:]
        for text in commands:
            w = words_of(text) if isinstance(text, str) else []
            needed = self.waiting.intersection(needed_by(w)) if w else set()
            made = f"{w[0][0]}_{w[1]}" if w and w[0] in MAKERS else ""
            if w[:1] == ["clear"]:
                self.waiting.clear()
            if needed:
                waits.append(text)
                needs |= needed
                self.waiting |= {made} - {""}
                rest = [x for x in w if not self.waiting.intersection(needed_by([x]))]
                text = " ".join(rest) if w[0] == "thermo_style" and len(rest) > 2 else None
            else:
                self.waiting.discard(made)
            if text is not None:
                self.put(text)
            if w and w[0] in ENDERS and w[0].startswith("un") and not line.skips:
                self.waiting.discard(f"{ENDERS[w[0]]}_{w[1]}")
        if waits:
            of = ", ".join(f"{KINDS[name[0]]} {name[2:]}" for name in sorted(needs))
            self.leave(line, f"{of}, which waits above as a comment", "take both without #:, or leave both", "\n".join(waits), takes=False)

    def end_replaced(self, line, moved):
        """Ends what a fix with the same ID has made, where the one that would replace it is left."""
        name = line.words[1]
        if moved and name in self.moves:
            del self.moves[name]
            moved[0].moves.remove(moved[1])
        if moved and moved[0].wall:
            self.put(self.modify(moved[0], moved[0].moves))
        if name in self.alive:
            self.alive.discard(name)
            self.end_wall(name)
            self.put(f"unfix           {name}")

    def come_back(self, line):
        """At the first line of a loop: what its lines have done when it comes back."""
        for first, last in (loop for loop in line.loops if loop[0] == line.index):
            cleared = max((x.index for x in self.lines[first:last + 1] if x.words[:1] == ["clear"]), default=first)
            body = [(x, w) for x in self.lines[cleared:last + 1] for w in commands_in(x.words or [""])]
            self.ran, self.step = self.ran + 1, None
            if any(w[0] == "run" for _, w in body):
                self.age(line)
            for x, w in body:
                style = self.style(w) if w[0] == "fix" and len(w) > 3 else ""
                if style == "move/mesh" and w[5:6] and w[5] in self.meshes:
                    self.meshes[w[5]].way = None
                for mesh in map(self.meshes.get, self.walls[x].ids if isinstance(self.walls.get(x), Wall) else []):
                    if mesh and mesh.wear:
                        mesh.worn = True
                if style.startswith("insert/"):
                    ends = any(v[:2] == ["unfix", w[1]] for y, v in body if y.index > x.index and y.skips <= x.skips)
                    self.sources.append((None, -1, "" if ends else "on"))
                if w[0] in ("create_atoms", "read_data", "read_dump", "replicate", "read_restart"):
                    self.sources.append((None, -1, ""))
                if style.startswith("insert/") or w[0] in ("set", "create_atoms", "read_data"):
                    self.densities["?"] = None
                self.spun = self.spun or w[0] == "set"

    def age(self, line):
        """What a run does to meshes, which would begin anew in another wall: a known time at known speeds is a way."""
        w, time = line.words, None
        if w[0] == "run" and w[2:] in ([], ["upto"]) and not line.loops and not line.skips and self.timestep is not None:
            steps, begin = self.known(w[1], line), self.step if len(w) > 2 else 0
            time = (steps - begin) * self.timestep if None not in (steps, begin) else None
        for mesh in self.meshes.values():
            mesh.worn = mesh.worn or bool(mesh.wear and mesh.wall)
            if mesh.servo or mesh.body:
                mesh.way = None
            for _, words, _, style, where in (m for m in self.moves.values() if m[0] is mesh and mesh.way):
                speed = [self.known(x, where) for x in words.split()[1:]] if style == "linear" else [None]
                known = time is not None and None not in speed and not mesh.unsure and not where.skips and not where.loops
                mesh.way = [x + v * time for x, v in zip(mesh.way, speed)] if known else None

    def end_wall(self, name):
        """The meshes of a wall that ends are in none."""
        for mesh in (m for m in self.meshes.values() if m.wall == name):
            mesh.wall = None

    def command(self, line):
        w = line.words
        if w[0] == "atom_style":
            if w[1] not in ("granular", "sphere", "granular/omp", "sphere/omp") or len(w) > 2:
                raise Left(f"atom_style {' '.join(w[1:])}", "spheres only")
            self.put("atom_style      sphere" + " 1" * any(self.grows(other.words) for other in self.lines))
        elif w[0] == "communicate":
            self.put("comm_modify     mode " + " ".join(w[1:]))
        elif w[0] in ("hard_particles", "soft_particles", "modify_timing", "partitioner_style", "package"):
            self.put(f"# {line.text.strip()}")    # checks of stiffnesses, timings, threads: no physics
        elif w[0] == "pair_style":
            self.pair_style(line)
        elif w[0] == "pair_coeff":
            if self.pair is None:
                raise Left("pair_coeff of a pair style that was left", "see there")
            for text in self.pair or [f"# {' '.join(w)}"]:
                self.put(text)
            self.pair = []
        elif w[0] == "fix":
            self.fix(line)
        elif w[0] == "dump":
            self.dump(line)
        elif line.included:
            self.put(f"# {line.text.strip()}: its lines follow")
        elif w[0] == "include":
            raise Left(f"include of {w[1]}, which is not beside the script or has loops of its own",
                       "convert it by itself, and name that; give the values of its variables with --var NAME VALUE")
        elif any(c[0] == "jump" and c[1] not in ("SELF", self.path.name) for c in commands_in(w)):
            raise Left("a jump to another file", "convert that file by itself, and name it here")
        elif w[0] == "if" and nested(w) and all(self.only_balances(words_of(x.strip("\"'"))) for x in nested(w)):
            text = line.text
            for x in nested(w):
                text = text.replace(x, f'"{" ".join(self.balance(words_of(x.strip(chr(34) + chr(39)))).split())}"')
            self.put(text)
        elif w[0] in ("if", "run") and any(c[0] not in PLAIN_COMMANDS for c in commands_in(w)[1:]):
            raise Left(f"commands in {w[0]} that are to be converted", "convert them as lines of their own, and put them here")
        elif w[0] == "compute" and (w[3] not in SAME_COMPUTES or (w[3] == "contact/atom" and len(w) > 4)):
            raise Left(f"compute {w[3]}", "LAMMPS has no compute of that name with these words")
        elif w[0] in ("unfix", "undump", "uncompute", "fix_modify", "compute_modify", "dump_modify") and w[1] in self.gone:
            self.put(f"# {' '.join(w)}")
            if w[0].startswith("un") and not line.skips:
                del self.gone[w[1]]
        elif w[0] == "clear":
            self.clear()
            self.put(line.text)
        elif w[0] == "dump_modify" and w[1] in self.texts:
            kept = options(w[2:], {"binary": 1, "every": 1, "sort": 1, "append": 1, "flush": 1, "first": 1, "pad": 1,
                                   "element": 0, "region": 1, "thresh": 3, "unwrap": 1, "compressor": 1})
            kept = [f"{k} {' '.join(v)}" for k, v in kept.items() if k not in ("binary", "compressor")]
            self.put(f"dump_modify     {w[1]} {' '.join(kept)}" if kept else f"# {' '.join(w)}")
        elif w[0] == "unfix" and w[1] in self.moves:
            self.stop(line)
        elif w[0] == "unfix" and w[1] in self.meshes:
            mesh = self.meshes[w[1]] if line.skips else self.meshes.pop(w[1])
            self.put(f"# unfix {w[1]}: " + (f"it is part of the fix {mesh.wall}" if mesh.wall else "no fix of its own"))
        elif w[0] == "unfix" and w[1] in self.feeds:
            where, k = self.feeds.pop(w[1])
            if line.skips <= where.skips:
                self.sources[k] = (*self.sources[k][:2], "")
            self.alive.discard(w[1])
            for name in self.parts.pop(w[1], [w[1]]):
                self.put(f"unfix {name}")
            for name in reversed(self.helpers.pop(w[1], [])):
                self.put(f"region          {name} delete")
        elif w[0] in ("unfix", "undump", "dump_modify") and w[1] in self.plain:
            self.put(f"# {' '.join(w)}")
            if w[0] != "dump_modify" and not line.skips:
                self.plain.discard(w[1])
                self.templates.pop(w[1], None)
                self.distributions.pop(w[1], None)
        elif w[0] == "fix_modify":
            self.fix_modify(line)
        elif w[0] == "region" and w[2] not in ("delete", "block", "cylinder", "sphere", "cone", "prism", "plane", "union", "intersect"):
            self.regions.pop(w[1], None)
            raise Left(f"region {w[2]}", "LAMMPS has no region of that name; region mesh/lsdcd is the inside of a closed mesh")
        elif w[0] == "read_restart":
            self.step = None
            self.make(None)
            if not self.options.converted_restart:
                raise Left("a restart file, which LIGGGHTS writes in another format", "write_data there and read_data here; where "
                           "a converted script has written the file, convert with --converted-restart")
            self.put(line.text)
        elif w[0] not in SAME_COMMANDS | {"compute"}:
            raise Left(f"the command {w[0]}", "see the manual of LAMMPS, or convert the file that it names by itself")
        else:
            self.count_steps(line)
            self.pass_on(line)

    @staticmethod
    def only_balances(w):
        return w[:1] == ["fix"] and w[3:4] == ["balance"] and len(w) == 8

    def count_steps(self, line):
        """Follows the step, the grains and the box, on which insertions hang, through the commands that both programs know."""
        w = line.words
        if any(c[0] == "run" for c in commands_in(w)):
            self.ran += 1
            if w[:2] != ["run", "0"]:
                self.age(line)
        for c in (c for c in commands_in(w) if c[0] == "timestep"):
            self.timestep = self.known(c[1], line) if c is w and not line.loops and not line.skips else None
        if w[0] == "run":
            try:
                steps = int(self.number(w[1], line))
                upto = w[2:] == ["upto"]
                self.step = steps if upto else None if self.step is None or len(w) > 2 else self.step + steps
            except Left:
                self.step = None
        elif w[0] == "reset_timestep":
            if self.feeds:
                self.step = None
                raise Left(f"reset_timestep beside fix {', '.join(self.feeds)}, which LAMMPS refuses",
                           "unfix before it, and the insertion again with what is still to come")
            try:
                self.step = int(self.number(w[1], line))
            except Left:
                self.step = None
        elif w[0] in ("jump", "if", "label", "next", "minimize", "read_dump"):
            self.step = None
        elif w[0] == "unfix":
            self.alive.discard(w[1])
            self.end_wall(w[1])
        self.follow_box(line)
        if w[0] in ("read_data", "read_dump", "replicate"):
            self.make(None)
        elif w[0] == "create_atoms":
            bounds = [(self.known(x, line),) * 2 for x in w[3:6]] if w[2] == "single" and self.units == "box" else \
                (self.region(w[3]) or [None])[-1] if w[2] == "region" else None
            self.make(bounds)

    def follow_box(self, line):
        """Keeps regions, edges of the box, and whether these move."""
        w = line.words
        if w[0] == "region":
            self.regions[w[1]] = line
            if w[2] == "delete":
                del self.regions[w[1]]
        elif w[0] == "boundary":
            self.faces = [side[k] for side in (x * 2 for x in w[1:4]) for k in (0, 1)]
        elif w[0] == "create_box":
            where = self.regions.get(w[2])
            if where and where.words[2] == "block":
                sides = [self.known(x, where) for x in where.words[3:9]]
                self.box = {} if None in sides else {a: tuple(sides[2 * k:2 * k + 2]) for k, a in enumerate("xyz")}
        elif w[0] == "read_data":
            self.box = self.data_boxes[line]
        elif w[0] in ("change_box", "replicate"):
            self.box, self.box_moves = {}, True
        elif w[0] == "group" and len(w) > 2:
            for name in [x for x in self.densities if x == f"group {w[1]}"]:
                self.densities = {"? " * (x == name) + x: value for x, value in self.densities.items()}

    def pass_on(self, line):
        w, text = line.words, line.text
        if self.lattice and not self.options.pfm and "units" not in w and (
                w[0] in ("region", "create_atoms", "displace_atoms", "change_box", "velocity") or w[3:4] == ["move"]):
            text = re.sub(r"\s*(#.*)?$", r" units box \1", text, count=1).rstrip()
            self.note(line, "units box is the default of LIGGGHTS 3.8; of LIGGGHTS-PFM (--pfm) and LAMMPS it is units lattice")
        if any(c[0] == "jump" for c in commands_in(w)):
            text = re.sub(rf"\bjump(\s+){re.escape(self.path.name)}(?![^\s\"'])", r"jump\1SELF", text)
        if w[0] == "compute" and w[3] == "coord/atom" and w[4] != "cutoff":
            text = " ".join([*w[:4], "cutoff", *w[4:]])
        if w[0] == "compute" and w[3] == "stress/atom" and w[4:5] != ["NULL"]:
            text = " ".join([*w[:4], "NULL", *w[4:]])
        if line.words[0] == "thermo_style":
            for word in (x for x in w[2:] if x in GONE_THERMO or not self.is_here(x)):
                text = re.sub(rf"\s{re.escape(word)}(?=\s|$)", "", text)
                self.note(line, f"without {word}, which is not here")
        elif w[0] == "set":
            values = options(w[3:], SET_WORDS)
            text = self.with_density(line, values, text)
            if values.keys() & SPINS:
                if any(ran != self.ran for _, ran, _ in self.sources) or self.spun:
                    raise Left("set omegax of grains that may turn already", "set ... omega with all three numbers")
                text = " ".join(w[:3] + [x for key, v in values.items() if key not in SPINS for x in (key, *v)] +
                                ["omega"] + [values.get(key, ["0"])[0] for key in SPINS])
            self.spun = self.spun or bool(values.keys() & {*SPINS, "omega"})
        self.put(self.renamed(line, text))

    def with_density(self, line, values, text):
        """LIGGGHTS keeps the density of a grain, and a diameter changes its mass; LAMMPS keeps the mass. So the density goes behind the
        diameter, that of an earlier line, too."""
        w, words = line.words, list(values)
        chosen = " ".join(w[1:3])
        if "density" in values:
            if chosen == "group all":
                self.densities.clear()
            self.densities.pop(chosen, None)    # the last one is that of the last command
            kept = []
            density = self.carry(values["density"][0], line, kept)
            self.densities[chosen] = None if line.skips or kept else density
        if "diameter" not in values:
            return text
        if "mass" in values and words.index("mass") < words.index("diameter"):
            raise Left("set mass before diameter, which gives the mass of the density in LIGGGHTS", "diameter before mass, or the density")
        if "density" in values and words.index("density") > words.index("diameter"):
            return text
        density = values.pop("density", [None])[0]
        if density is None and "mass" not in values:
            found = set(self.densities.values())
            if list(self.densities)[-1:] == [chosen] and self.densities[chosen]:
                density = self.densities[chosen]
            elif len(found) == 1 and None not in found:
                density = found.pop()
            elif not found and not self.all_types and all(other.words[:1] != ["read_data"] for other in self.lines):
                density = "1"    # of create_atoms in both
            else:
                raise Left("set diameter of grains whose density is not known here: LIGGGHTS keeps it, LAMMPS the mass",
                           "set ... diameter D density RHO")
        kept = dict(values)
        values.clear()
        for key, v in kept.items():
            values[key] = v
            if key == "diameter" and density is not None:
                values["density"] = [density]
        return " ".join(w[:3] + [x for key, v in values.items() for x in (key, *v)])

    def is_here(self, word):
        """False of an output of a fix, compute or variable that is not in the converted script."""
        found = re.match(r"([fcv])_(\w+)", word)
        if not found or found[1] == "v":
            return not found or found[0] not in self.left_variables
        return found[0] in self.names and found[2] not in self.gone.keys() | self.plain

    def renamed(self, line, text):
        """Outputs of mesh fixes and massflow by their new names."""
        direct = line.words[0] in ("thermo_style", "print")

        def helper(name, k, value):
            own = f"{name}_{k}" if f"{name}_{k}" not in self.program.assigned else f"lsdcd_{name}_{k}"
            self.put(f"variable        {own} equal {value}")
            return f"v_{own}"

        def new(m):
            name, k = m[1], int(m[2])
            if name in self.gone or name in self.plain:
                raise Left(f"f_{name}, which is not here", "take another output")
            if name in self.mirrored:
                self.named_flows[name] = self.mirrored[name]
                flow = self.mirrored[name].get(k)
                if flow is None:
                    page = "fix_insert_lsdcd.rst" if name in self.parts else "fix_massflow_lsdcd.rst"
                    raise Left(f"element {k} of f_{name}", f"{page} lists what there is")
                if k == 3:
                    self.note(line, f"{flow} is the mean rate over the last 1000 steps, or N by every N of fix {name}")
                return flow if line.words[0] == "variable" or flow.startswith("f_") else helper(name, k, flow)
            if name not in self.meshes:
                return m[0]
            mesh, variable = self.meshes[name], line.words[0] == "variable"
            if not mesh.wall:
                self.early.add(name)
            value = mesh.output(k, self) if mesh.wall or name in self.later else None
            if value is None:
                raise Left(f"element {k} of f_{name}", "wall_output.rst lists what there is")
            self.named.setdefault(name, set()).add((mesh.wall, mesh.index, mesh.several) if mesh.wall else self.later[name])
            # LAMMPS looks for the fix where it is named, but in variables.
            if variable or (mesh.wall and re.fullmatch(r"f_\w+(\[\d+\])" + "{1,2}" * direct, value)):
                return value
            return helper(name, k, value)

        text = re.sub(r"\bf_(\w+)\[(\d+)\]", new, text)
        for name in re.findall(r"\b[fcv]_\w+", text) + [f"v_{x}" for x in re.findall(r"\$\{(\w+)\}", text)]:
            if not self.is_here(name):
                raise Left(f"{name}, which is not here", "take another output")
        if line.words[0] == "variable":
            self.left_variables.discard(f"v_{line.words[1]}")
            for name in sorted(COLUMNS - ATOM_VECTORS - {"element"}):
                if re.search(rf"(?<![\w$}}]){name}\[", text):
                    if name not in self.computed:
                        if line.skips or any(all(x.words[:1] != ["clear"] for x in self.lines[a:b]) for a, b in line.loops):
                            raise Left(f"{name}[...] of a variable in a loop, or where a jump may skip it",
                                       f"compute property/atom {name} before it, and c_ID[...]")
                        self.put(f"compute         lsdcd_{name} all property/atom {name}")
                    self.computed.add(name)
                    text = re.sub(rf"(?<![\w$}}]){name}\[", f"c_lsdcd_{name}[", text)
            for name in re.findall(r"(?<![\w$}])([a-z]\w*)\[", text):
                if name[:2] not in ("f_", "c_", "v_") and name not in ATOM_VECTORS:
                    raise Left(f"{name}[...] in a variable", "an atom-style variable, from what compute property/atom has")
        return text

    def pair_style(self, line):
        w = line.words
        if w[1] not in ("gran", "gran/omp"):
            raise Left(f"pair_style {' '.join(w[1:])}", "pair_style gran or granular of LAMMPS")
        model, kinds = Model(w[2:], self.options.pfm), self.grains()
        model.settings(model.rest, "pair_style")
        model.check()
        self.note_friction(line, model, [Contact(self, line, i, j) for i in kinds for j in kinds])
        contacts = [Contact(self, line, i, j) for i in kinds for j in kinds]
        model.drop_zeros(contacts)
        self.pair = None
        if model.cohesion:
            raise Left("cohesion between grains", "pair_style granular with jkr or dmt; this comes before pair_coeff")
        if model.rolling and not model.nearest:
            raise model.left_rolling(contacts[0])
        if model.normal == "hertz":
            self.put("pair_style      granular")
            self.note(line, "damping tsuji has another number than the restitution, so that LAMMPS's pairs return the "
                      "restitution of LIGGGHTS; in 29Sep2021 they have no coeff_restitution")
            # Types of walls alone have no grains: any law does.
            self.pair = [f"pair_coeff      {i} {j} {model.granular(Contact(self, line, a, b))}"
                         for i, j, a, b in [("*", "*", kinds[0], kinds[0])] +
                         [(a, b, a, b) for a in kinds for b in kinds if a <= b and b != kinds[0]]]
            if model.nearest:
                nearest, self.pair = "\n".join(["pair_style      granular", *self.pair]), []
                raise model.left_rolling(contacts[0], nearest)
            return
        r, m = self.size(line) if model.normal == "hooke" else (1.0, 1.0)
        laws = {model.classic(Contact(self, line, i, j), r / 2, m / 2) for i in kinds for j in kinds}
        if len(laws) > 1:
            raise Left("model hooke for grains of several materials", "pair_style hybrid, or model hertz")
        style, numbers = laws.pop()
        self.put(f"pair_style      gran/{style} {numbers}" + " limit_damping" * model.limit)
        self.pair = ["pair_coeff      * *"]

    def note_friction(self, line, model, contacts=()):
        dashpot = model.tangential == "history" and model.damped and "stiffness" not in (model.normal or "")
        if dashpot and not self.noted_dashpot and any(c.friction() > 0 and c.beta() > 0 for c in contacts):
            self.noted_dashpot = True
            self.note(line, "until the spring has reached mu F, LIGGGHTS adds the dashpot to it, here the sum ends at mu F: doc/from-liggghts.md, "
                      "Traps")
        if not model.tangential and "tangential" not in line.words and not self.noted:
            self.noted = True
            self.note(line, "without the keyword tangential LIGGGHTS 3.8 has no friction; LIGGGHTS-PFM has no_history: --pfm")

    def fix(self, line):
        w = line.words
        name, style = w[1], self.style(w)
        self.mirrored.pop(name, None)
        if style == "property/global":
            self.plain.add(name)
            self.put(f"# {line.text.strip()}")
        elif style.startswith("mesh/surface"):
            self.meshes.pop(name, None)
            if isinstance(self.mesh_of[line], Left):
                raise self.mesh_of[line]
            self.meshes[name] = self.mesh_of[line]
            self.put(f"# mesh {name}: see the fixes that use it")
            for text in self.meshes[name].before:
                self.put(text)
            if name in self.unchecked:
                self.note(line, f"{self.meshes[name].file} is not there: on triangles inclined to the surface's velocity LIGGGHTS "
                          "keeps its full size")
        elif style == "wall/gran":
            self.end_wall(name)    # of a wall that this one replaces
            if isinstance(self.walls[line], Left):
                raise self.walls[line]
            (self.mesh_wall if self.walls[line].ids else self.primitive)(line, self.walls[line])
        elif style == "move/mesh":
            self.move(line)
        elif style == "massflow/mesh":
            self.massflow(line)
        elif style == "check/timestep/gran":
            self.plain.add(name)
            self.note(line, "fix check/timestep/gran has no counterpart; lsdcd timestep names a timestep")
        elif style.startswith("insert/"):
            self.insert(line)
        elif style.startswith(("particletemplate", "particledistribution")):
            self.templates.pop(name, None)
            self.distributions.pop(name, None)
            kind, *size = self.template(line) if style == "particletemplate/sphere" else (None, None)
            if kind and None not in size:
                self.templates[name] = (short(kind), *size, line)
            if style.startswith("particledistribution/discrete"):
                law = {"particledistribution/discrete/numberbased": "poly"}.get(style, "mass")
                self.distributions[name] = (law, w[6:], line)
            if name in self.templates or (name in self.distributions and all(k in self.templates for k in w[6::2])):
                self.plain.add(name)
                self.put(f"# {name}: see the fixes that insert grains")
                return
            raise Left(style, "radii and densities go to fix insert/lsdcd (diam, dens), or to set after create_atoms")
        elif style == "balance" and len(w) == 8:
            self.put(self.balance(w))
        elif style in SAME_FIXES:
            if style == "nve/limit" and w[4] in ("radius_ratio", "absolute"):
                raise Left(f"nve/limit {w[4]}", "nve/limit of LAMMPS has the largest distance alone")
            if self.grows(w):
                self.pass_on(line.but(" ".join(w + ["mass yes"])))    # LIGGGHTS keeps the density
                return
            if style == "dt/reset":
                self.timestep = None
            if style == "deform":
                self.box, self.box_moves = {}, True
            text = line.text if style == w[3] else re.sub(rf"(\s{style})/omp\b", r"\1", line.text)
            if style == "ave/time" and "f_" in line.text:
                self.pass_on(line)
            else:
                self.pass_on(line.but(text))
        else:
            raise Left(f"fix {style}", "LAMMPS has no fix of that name with these words")

    @staticmethod
    def balance(w):
        """fix ID group balance N dimensions iterations threshold, which moves no grain."""
        n, dims, iterations, threshold = w[4:8]
        return f"fix             {w[1]} {w[2]} balance {n} {threshold} shift {dims} {iterations} {threshold}"

    # -- insertion

    def region(self, name):
        """Shape, axis of a cylinder, and lowest and highest x, y, z of a block, cylinder or sphere whose inside stands still; None of
        other regions."""
        where = self.regions.get(name)
        w = where.words if where else []
        n = {"block": 6, "cylinder": 6, "sphere": 4}.get("".join(w[2:3]))
        if n is None:
            return None
        axis = w[3] if w[2] == "cylinder" else ""
        v = [self.known(x, where) for x in w[3 + len(axis):3 + n]]
        try:
            rest = options(w[3 + n:], {"units": 1, "side": 1, "seed": 1, "volume_limit": 1})
        except Left:
            return None
        if None in v or rest.get("side", ["in"]) != ["in"] or (rest.get("units", [self.units]) != ["box"] and self.lattice):
            return None
        if w[2] == "block":
            sides = list(zip(v[::2], v[1::2]))
        else:
            radius = v[2] if axis else v[3]
            sides = [(c - radius, c + radius) for c in v[:2 if axis else 3]]
        if axis:
            sides.insert("xyz".index(axis), (v[3], v[4]))
        # The word INF is the lower end, too.
        return w[2], axis, [(-math.inf if lo == math.inf else lo, hi) for lo, hi in sides]

    def volume(self, name):
        """The volume of a region, the whole one also with all_in."""
        found = self.region(name)
        if found is None:
            raise Left(f"volumefraction_region of region {name}", "fix insert/lsdcd with mass: the fraction times density and volume")
        return math.prod(hi - lo for lo, hi in found[2]) * {"block": 1, "cylinder": math.pi / 4, "sphere": math.pi / 6}[found[0]]

    def put_region(self, name, shape, axis, sides):
        ends = ["INF" if math.isinf(x) else short(x) for side in sides for x in side]
        if shape != "block":
            k = "xyz".index(axis) if axis else 3
            round_sides = sides[:k] + sides[k + 1:]
            ends = ([axis] * bool(axis) + [short((lo + hi) / 2) for lo, hi in round_sides] +
                    [short((round_sides[0][1] - round_sides[0][0]) / 2)] + (ends[2 * k:2 * k + 2] if axis else []))
        self.put(f"region          {name} {shape} {' '.join(ends)}" + " units box" * self.lattice)

    def whole_region(self, line, name, radius, all_in, in_box):
        """The region of the centres. LIGGGHTS keeps each sphere in the region with all_in, and in the box by default."""
        if name in self.regions:
            self.sure(self.regions[name], line)
        if in_box and self.box_moves:
            raise Left(f"insertion into region {name} after a change of the box, whose edges are not known here",
                       "fix insert/lsdcd with a region that ends one radius before the faces of the box")
        found = self.region(name)
        if found is None:
            if all_in:
                raise Left(f"all_in yes with region {name}, which is no block, cylinder or sphere of known numbers",
                           f"a region that is smaller by the radius, {short(radius)}: here a region holds centres")
            return name
        shape, axis, sides = found
        if all_in:
            sides = [(lo + radius, hi - radius) for lo, hi in sides]
        box = [(-math.inf, math.inf)] * 3
        if in_box and self.box:
            box = [(lo + radius * (self.faces[2 * k] != "p"), hi - radius * (self.faces[2 * k + 1] != "p"))
                   for k, (lo, hi) in enumerate(self.box[a] for a in "xyz")]
        inside = [(max(a, lo), min(b, hi)) for (a, b), (lo, hi) in zip(sides, box)]
        if any(lo > hi for lo, hi in inside):
            raise Left(f"region {name} is smaller than a sphere of radius {short(radius)}", "a larger region")
        if not all_in and inside == sides:
            return name
        whole = f"{line.words[1]}_whole"
        self.helpers[line.words[1]] = [whole]
        self.put_region(whole, shape, axis, inside if shape == "block" else sides)
        if inside != sides and shape != "block":
            self.put_region(f"{whole}_box", "block", "", box)
            self.put(f"region          {whole}_in intersect 2 {whole} {whole}_box")
            self.helpers[line.words[1]] += [f"{whole}_box", f"{whole}_in"]
            whole += "_in"
        return whole

    def inserted_grains(self, name, line):
        """Of each type and density of a distribution: words of fix insert/lsdcd, shares of the number and of the mass, radii."""
        law, parts, where = self.distributions.get(name, ("", [], line))
        found = [(self.templates.get(k), self.number(f, where)) for k, f in zip(parts[::2], parts[1::2])]
        for other in [where, *(t[3] for t, _ in found if t)]:
            self.sure(other, line)
        found = [(t and t[:3], f) for t, f in found]
        if not found or not all(t for t, _ in found):
            raise Left("insertion of grains that are no spheres of constant radius and density",
                       "fix insert/lsdcd, with diam one, range, poly or mass")
        masses = [radius ** 3 * density for (_, radius, density), _ in found]
        by_number = [f if law == "poly" else f / m for (_, f), m in zip(found, masses)]
        by_mass = [f * m for f, m in zip(by_number, masses)]
        grains = []
        for kind in dict.fromkeys((t[0], t[2]) for t, _ in found):
            own = [k for k, (t, _) in enumerate(found) if (t[0], t[2]) == kind]
            total = sum(found[k][1] for k in own)
            sizes = f"{law} {len(own)} " + " ".join(f"{2 * found[k][0][1]:.10g} {found[k][1] / total:.10g}" for k in own)
            if len(own) == 1:
                sizes = f"one {2 * found[own[0]][0][1]:.10g}"
            shares = [sum(weights[k] for k in own) / sum(weights) for weights in (by_number, by_mass)]
            grains.append((f"type {kind[0]} diam {sizes} dens {kind[1]:.10g}", *shares, [found[k][0][1] for k in own]))
        # The density of the whole is mass over volume.
        volume = sum(n * t[1] ** 3 for n, (t, _) in zip(by_number, found))
        return grains, sum(by_mass) / volume

    # The number of values of each word.
    INSERT = {"seed": 1, "distributiontemplate": 1, "maxattempt": 1, "insert_every": 1, "every": 1, "insert_every_time": 1,
              "start": 1, "overlapcheck": 1, "all_in": 1, "random_distribute": 1, "verbose": 1, "compress_tags": 1, "omega": 4,
              "vel": {"constant": 4, "uniform": 7, "gaussian": 7}, "orientation": {"random": 1, "template": 1, "constant": 5},
              "ntry_mc": 1}
    RATE = {"nparticles": 1, "mass": 1, "massrate": 1, "particlerate": 1}
    REGION = {"region": 1, "warn_region": 1, "check_dist_from_subdomain_border": 1}
    INSERT_OF = {"pack": {**REGION, "particles_in_region": 1, "mass_in_region": 1, "volumefraction_region": 1},
                 "rate/region": {**RATE, **REGION},
                 "stream": {**RATE, "insertion_face": 1, "extrude_length": 1, "duration": 1, "duration_time": 1, "parallel": 1}}

    def insert(self, line):
        w = line.words
        form = self.style(w).split("/", 1)[1]
        if form not in self.INSERT_OF:
            raise Left(w[3], "fix insert/lsdcd mesh FILE or region ID")
        v = options(w[4:], {**self.INSERT, **self.INSERT_OF[form]})
        apart, whole, in_box = (is_yes(v, *default) for default in (
            ("overlapcheck", "yes"), ("all_in", "no"), ("check_dist_from_subdomain_border", "yes")))
        v = {k: x[0] if len(x) == 1 else x for k, x in v.items()}
        if "duration_time" in v or v.get("duration", v.get("insert_every")) != v.get("insert_every"):
            raise Left("insert/stream with a duration shorter than insert_every, which comes in pulses",
                       "a fix insert/lsdcd and unfix for each pulse")
        if form == "pack" and v.get("insert_every", v.get("every", v.get("insert_every_time", "once"))) != "once":
            raise Left("insert/pack that fills up again and again", "fix insert/lsdcd with massrate or numberrate")
        if ("massrate" in v or "particlerate" in v) and self.new_timestep(line):
            raise Left(f"{w[3]} with a rate, and another timestep after a run: LIGGGHTS keeps the grains of a step, not of a time",
                       "fix insert/lsdcd for each part, with the rate that you mean")
        amounts = [f"{ours} {v[theirs]}" for theirs, ours in (
            ("massrate", "massrate"), ("particlerate", "numberrate"), ("nparticles", "number"), ("mass", "mass"),
            ("particles_in_region", "number"), ("mass_in_region", "mass")) if v.get(theirs, "INF") != "INF"]
        if not amounts and "volumefraction_region" not in v:
            raise Left(f"{w[3]} without its number or mass", "fix insert/lsdcd with number, mass, numberrate or massrate")
        kinds, density = self.inserted_grains(v.get("distributiontemplate"), line)
        radii = sum((kind[3] for kind in kinds), [])
        if "volumefraction_region" in v:
            mass = self.number(v["volumefraction_region"], line) * self.volume(v.get("region")) * density
            amounts.append(f"mass {short(mass)}")
        if not apart:
            raise Left("overlapcheck no", "fix insert/lsdcd puts no grain into another: a lower number")
        if any(self.known(x, line) != 0 for x in v.get("omega", ["constant"])[1:]):
            raise Left("insertion with a spin", "set ... omega of the new grains, as grains come without a spin here")
        velocity = ""
        if "vel" in v:
            spread = v["vel"][4:]
            if v["vel"][0] not in ("constant", "uniform") or len(set(spread)) > 1:
                raise Left(f"velocities of {v['vel'][0]}", "vel and jitter of fix insert/lsdcd")
            velocity = " vel " + " ".join(v["vel"][1:4]) + "".join(f" jitter {x}" for x in spread[:1])
        bounds, there = None, False
        if form == "stream":
            mesh = self.meshes.get(v.get("insertion_face"))
            if mesh is None:
                raise Left("insert/stream through a face that is not converted", "fix insert/lsdcd mesh FILE")
            self.stands_still(mesh, line)
            place = f"mesh {mesh.file}{mesh.placement()}"
        elif "region" not in v:
            raise Left(w[3], "fix insert/lsdcd region ID")
        else:
            bounds = (self.region(v["region"]) or [None])[-1]
            place = f"region {self.whole_region(line, v['region'], max(radii), whole, in_box)}"
            there = form == "pack" and self.may_have_grains(bounds)
        text = "\n".join(f"fix             {name} {w[2]} insert/lsdcd {place} {grains} {' '.join(parts)}{velocity}" +
                         (f" seed {v['seed']}" if "seed" in v else "")
                         for name, grains, parts in self.one_fix_each(line, w[1], kinds, amounts))
        if "start" in v and (self.step is None or self.known(v["start"], line) != self.step + 1):
            raise Left(f"start {v['start']}", f"end a run one step before that, and put after it: {text}")
        if there:
            text = self.less_what_is_there(line, w[1], v, len(kinds), amounts, text)
        self.sources.append((bounds, self.ran, "once" if form == "pack" else "on"))
        self.feeds[w[1]] = (line, len(self.sources) - 1)
        self.densities.update({f"fix {w[1]} {k}": kind[0].split()[-1] for k, kind in enumerate(kinds)})
        if not any("thermo_temp" in other.words for other in self.lines):
            self.put("compute_modify  thermo_temp dynamic/dof yes")    # else ke is 0 while grains come
        self.put(text)
        if form == "pack" and self.is_dense(line, v, kinds, bounds):
            self.note(line, "LIGGGHTS gives up on grains without a place after maxattempt, here they come later: count the grains of both")
        if form != "stream" and whole and max(radii) > min(radii):
            self.note(line, "all grains stay the largest radius off the region's edge; in LIGGGHTS each its own")
        if form == "stream":
            self.note(line, "grains are put on the face itself, where LIGGGHTS lets them go after their way through extrude_length, and "
                      "are whole within its edges" + ("" if whole else "; without all_in yes their centres go up to the edges there"))

    def new_timestep(self, line):
        """Whether the timestep changes after the first run that an insertion sees, and before its unfix."""
        ran = False
        for other in [x for x in self.lines if x.index > line.index] + [x for x in self.lines if x.loops and line.loops]:
            if other.words[:2] == ["unfix", line.words[1]] and other.skips <= line.skips:
                return False
            for w in commands_in(other.words or [""]):
                ran = ran or w[0] == "run"
                if ran and (w[0] == "timestep" or w[3:4] == ["dt/reset"]):
                    return True
        return False

    def is_dense(self, line, v, kinds, bounds):
        """Whether a pack fills so much of its region, or how much is not known, that grains may find no place."""
        if "volumefraction_region" in v:
            return not (self.known(v["volumefraction_region"], line) or 1) <= 0.15
        n, radius = self.known(v.get("particles_in_region", ""), line), max(kinds[0][3])
        if n is None or not bounds or any(math.isinf(x) for side in bounds for x in side):
            return True
        return n * 4 / 3 * math.pi * radius ** 3 > 0.15 * self.volume(v["region"])

    def less_what_is_there(self, line, name, v, kinds, amounts, text):
        """A pack with its number less the grains that are in its region."""
        used = any(re.search(rf"\bf_{name}\b", x.text) or (x.words[:2] == ["unfix", name] and (x.index > line.index or x.loops))
                   for x in self.lines)
        if used or kinds > 1 or "particles_in_region" not in v:
            raise Left("insert/pack into a region that may have grains, which count in LIGGGHTS",
                       "fix insert/lsdcd with the number less these: variable n equal N-count(all,REGION), number ${n}")
        return (f"variable        lsdcd_{name} equal {v['particles_in_region']}-count(all,{v['region']})\n"
                f'if "${{lsdcd_{name}}} > 0" then "{" ".join(text.replace(amounts[0], f"number ${{lsdcd_{name}}}").split())}"')

    def one_fix_each(self, line, name, kinds, amounts):
        """IDs, grains and amounts of a fix for each type and density."""
        if len(kinds) == 1:
            return [(name, kinds[0][0], amounts)]
        names = [name] + [f"{name}_{k}" for k in range(2, len(kinds) + 1)]
        self.parts[name] = names
        self.names.update(f"f_{n}" for n in names)
        self.mirror(line, {k: "(" + "+".join(f"f_{n}[{k}]" for n in names) + ")" for k in (1, 2)})
        shared, before = [], [0.0] * len(amounts)
        values = [(word, self.number(value, line)) for word, value in (a.split() for a in amounts)]
        for fix, (grains, number, mass, _) in zip(names, kinds):
            parts = []
            for k, (word, value) in enumerate(values):
                part = value * (mass if word.startswith("mass") else number)
                # Whole numbers add up to the whole.
                parts.append(f"{word} " + (str(round(before[k] + part) - round(before[k])) if word == "number" else short(part)))
                before[k] += part
            shared.append((fix, grains, parts))
        return shared

    @staticmethod
    def apart(one, other):
        """Whether two regions are known and do not meet."""
        return one and other and None not in sum(one, ()) and any(a[1] < b[0] or b[1] < a[0] for a, b in zip(one, other))

    def may_have_grains(self, bounds):
        """Whether the region of a pack may have grains now. LIGGGHTS counts them in the step of the insertion, up to its number."""
        if any(not self.apart(other, bounds) for other, ran, feeds in self.sources if feeds == "on" or (feeds and ran == self.ran)):
            raise Left("insert/pack into a region that another insertion fills in the same step, which counts in LIGGGHTS",
                       "fix insert/lsdcd with the number less these grains")
        return any(ran != self.ran or not self.apart(other, bounds) for other, ran, _ in self.sources)    # after a run they are anywhere

    def make(self, bounds):
        """Grains that are made at once. A pack that stands before them and inserts after them counts them."""
        if any(feeds == "once" and ran == self.ran and not self.apart(other, bounds) for other, ran, feeds in self.sources):
            raise Left("grains that are made where an insert/pack before this line will count them", "this line before it")
        self.sources.append((bounds, self.ran, ""))

    def law_of(self, line, model, wall_type):
        """Words of the wall for each grain type."""
        r, m = self.size(line) if model.normal == "hooke" else (1.0, 1.0)
        return {i: model.wall(Contact(self, line, wall_type, i), r, m) for i in self.grains()}

    def mesh_wall(self, line, wall):
        w, model = line.words, wall.model
        meshes = [self.meshes[i] for i in wall.ids if i in self.meshes]
        for i in wall.ids:
            if i not in self.meshes and i not in self.gone:
                text = f"there is no mesh {i}"
                raise Left(text, "its fix in this script") if self.program.unread else CannotConvert(f"{self.at(line)}: {text}")
        for mesh in meshes:
            self.begins_here(mesh, line)
        if not meshes:
            raise Left(f"the mesh {wall.ids[0]}, which is not converted", "the wall with mesh FILE; see the mesh for why")
        model.check()
        contacts = [Contact(self, line, mesh.type, i) for mesh in meshes for i in self.grains()]
        model.drop_zeros(contacts)
        self.note_friction(line, model, contacts)
        self.note_stored(line, wall)
        self.check_bodies(line, model, meshes)
        # One fix, so that a grain where meshes meet is pushed once; each mesh has its law.
        laws = [self.law_of(line, model, mesh.type) for mesh in meshes]
        first = laws[0][self.grains()[0]]
        words = [f"fix             {w[1]} {self.group_of(line, meshes)} wall/lsdcd {first}" + self.wear(line, meshes)]
        for index, (mesh, by_type) in enumerate(zip(meshes, laws), 1):
            mesh.wall, mesh.index, mesh.several = mesh.first = w[1], index, len(meshes) > 1
            mesh.wall_at = line
            words.append(self.mesh_words(mesh, line))
            own = by_type[self.grains()[0]]
            words += [f"law {own}"] * (own != first)
            words += [f"law types {kind} {law}" for kind, law in by_type.items() if law != own]
        for i in (i for i in wall.ids if i not in self.meshes):
            self.leave(line, f"the mesh {i}, which is not converted", "add it as mesh FILE")
            self.out.pop()
        for mesh in meshes:
            if self.named.get(mesh.id, set()) - {(mesh.wall, mesh.index, mesh.several)}:
                self.leave(line, f"outputs of {mesh.id} that lines above take from another wall", "these lines again below this one")
                self.out.pop()
        for mesh in (m for m in meshes if any(m.way)):
            self.note(line, f"{mesh.id} begins where its motions have brought it")
        text = " &\n                ".join(words)
        if model.nearest:
            raise model.left_rolling(contacts[0], text)
        self.put(text)

    def begins_here(self, mesh, line):
        """Raises Left for a mesh that does not begin at a wall as its line says, or not always."""
        self.sure(mesh.line, line)
        for other in (m[4] for m in self.moves.values() if m[0] is mesh):
            self.sure(other, line)
        if mesh.wall and mesh.moves:
            raise Left("a second wall of a mesh that moves", "the place where the mesh is then: in a new fix it begins anew")
        if mesh.worn or mesh.way is None:
            raise Left(f"the mesh {mesh.id}, which has {'worn' if mesh.worn else 'moved'} in a run before: in a new fix it begins anew",
                       "one wall from the start, as the wear of the new one begins at 0" if mesh.worn else
                       "the mesh where it is then, by move and rotate after its file; or one wall from the start with all meshes")
        if line.skips and any(other is not line and isinstance(wall, Wall) and mesh.id in wall.ids for other, wall in self.walls.items()):
            raise Left(f"one of several walls of the mesh {mesh.id}, which a jump may skip", "a script for each case")

    def group_of(self, line, meshes):
        """The group that a wall of meshes pushes is that of its meshes in LIGGGHTS. A group of the wall other than all adds atoms that
        depend on the order of the groups."""
        own, groups = line.words[2], {mesh.group for mesh in meshes}
        if own != "all" and groups == {"all"}:
            self.note(line, f"LIGGGHTS pushes the group of the mesh, which is all, not {own}")
        elif own != "all":
            raise Left(f"the groups {own} of a wall and {', '.join(sorted(groups))} of its meshes: LIGGGHTS pushes atoms of both, and of "
                       "others by the order of the groups", "a fix with the group that you mean")
        elif len(groups) > 1:
            raise Left("a wall whose meshes have several groups", "a fix for each group")
        return groups.pop()

    def check_bodies(self, line, model, meshes):
        bodies = [mesh for mesh in meshes if mesh.body]
        if len(bodies) > 1:
            raise Left("several meshes with 6dof in a wall", "a fix wall/lsdcd for each: outputs of bodies are of one")
        for mesh in bodies:
            if not any(model.dissipates(Contact(self, line, mesh.type, i)) for i in self.grains()):
                continue
            mobility = mesh.mobility(self) if self.sizes and all(self.sizes) else None
            weaker = mobility * max(4 / 3 * math.pi * r ** 3 * density for r, density in self.sizes) if mobility else math.inf
            if weaker > 0.05:    # below, a restitution differs by less than 0.02
                raise Left(f"contacts of {mesh.id} that are damped: LIGGGHTS damps with the mass of the grain, here with that of grain and body",
                           f"mesh {mesh.file}{mesh.placement()} {mesh.body}, where the body is far heavier than a grain, or where this is meant")
            self.note(line, f"LIGGGHTS damps the contacts of {mesh.id} with the mass of the grain, here with that of grain and body: the "
                      f"dashpot is weaker by at most {100 * weaker:.2g} %")

    def note_stored(self, line, wall):
        if wall.shear and wall.ids:
            raise Left("shear of a mesh", "surface_vel")
        if wall.stored:
            self.note(line, "store_force: the keyword contacts has the forces")

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

    def mesh_words(self, mesh, wall_line):
        moves = "".join(f" motion {m}" for m in reversed(mesh.moves))
        way = [f"{x:.15g}" for x in mesh.way]
        moved = " move " + " ".join(way) if any(mesh.way) else ""
        words = f"mesh {mesh.file}{mesh.placement()}{moved}{moves}" + "".join(f" {x}" for x in mesh.words)
        moving = mesh.id in self.used or mesh.servo or mesh.body
        torque = any(re.search(rf"f_{mesh.id}\[[456]\]", line.text) for line in self.lines)
        if mesh.reference or (moving and torque):
            # The point of the torque moves with the mesh in LIGGGHTS.
            about = mesh.reference or (mesh.com if mesh.body else "000")
            if moved:
                about = [f"{self.number(x, mesh.line) + way:.15g}" for x, way in zip(about, mesh.way)]
            words += " torque_about " + "mesh " * bool(moving) + " ".join(about)
        if mesh.servo or mesh.body:
            words += f" {mesh.servo or mesh.body}"
        for line in (x for x in self.dumps if x.stage == wall_line.stage):
            words += self.dump_words(line, mesh, wall_line)
        return words

    def dump_words(self, line, mesh, wall_line):
        """Of dump ID group style N file [...] for one mesh."""
        w = line.words
        named = self.dumped_meshes(line)
        if named and mesh.id not in named:
            return ""
        keyword, end = ("mesh_stl", ".stl") if w[3] in ("mesh/stl", "stl") else ("mesh_fields", ".vtp")
        if keyword in mesh.written:
            return ""    # one file of a kind for each mesh: the other dump is left
        try:
            every, name = (self.carry(x, line, [], to=wall_line) for x in w[4:6])
        except Left:
            return ""
        mesh.written.add(keyword)
        self.dumped[line].add(mesh.id)
        path = re.sub(r"_?\*", f"_{mesh.id}_*", name) if "*" in name else str(Path(name).with_suffix("")) + f"_{mesh.id}"
        return f" {keyword} {re.sub('[.](stl|vtk|vtp|vtm)$', '', path)}{end} every {every}"

    @staticmethod
    def dumped_meshes(line):
        """The IDs that a dump of meshes names; none: all meshes."""
        w = line.words
        return [x for k, x in enumerate(w[6:], 6) if x not in ("local", "owned", "ghost", "region") and w[k - 1] != "region" and
                (w[3] in ("mesh/stl", "stl") or x not in MESH_FIELDS)]

    def mesh_dump(self, line):
        """The text in place of a dump of meshes, when all walls are known."""
        w, names, written = line.words, self.dumped_meshes(line), self.dumped[line]
        missing = [i for i in names if i not in written]
        if missing or not written:
            why, do = f"the dump of {', '.join(missing) or 'meshes'} that no converted wall has", "mesh_stl or mesh_fields of the wall with that mesh"
            keyword = "mesh_stl" if "stl" in w[3] else "mesh_fields"
            if any(keyword in m.written for m in self.meshes.values() if m.id in missing or not names):
                why, do = "a second dump of a mesh", f"one of both: a mesh has one {keyword}"
            self.left.append(f"{self.at(line)}: {why}; do: {do}")
            return f"# LEFT {self.left[-1]}\n" + "\n".join("# " + t for t in line.text.splitlines())
        return f"# dump {w[1]}: see {'mesh_stl' if 'stl' in w[3] else 'mesh_fields'} of the wall"

    def primitive(self, line, wall):
        w, model, grains = line.words, wall.model, self.grains()
        kind, shape, place, shear = wall.type, wall.shape, wall.place, wall.shear
        model.check()
        self.note_stored(line, wall)
        contacts = [Contact(self, line, kind, i) for i in grains]
        model.drop_zeros(contacts)
        if model.normal == "hertz":
            laws = {"granular " + model.granular(c) for c in contacts}
            if model.cohesion or (model.rolling and not model.nearest):
                model.extras(contacts[0], False)
        else:
            laws = set(self.law_of(line, model, kind).values())
            if model.rolling or model.cohesion:
                raise Left("rolling friction or cohesion of a plane", "a mesh of the plane: lsdcd generate plane")
        self.note_friction(line, model)
        if len(laws) > 1:
            raise Left("a plane that touches grains of several materials", "a fix for the group of each type")
        if shape in ("xplane", "yplane", "zplane"):
            at, span = self.number(place[0], line), self.box.get(shape[0])
            if span is None:
                raise Left("a plane where the box is not known here", "say which side: lo NULL, or NULL hi")
            where = f"{shape} " + (f"{place[0]} NULL" if at <= sum(span) / 2 else f"NULL {place[0]}")
        elif shape == "zcylinder" and all(self.number(x, line) == 0 for x in place[1:]):
            if shear:
                raise Left("shear of a cylinder", "a mesh with surface_angvel or surface_vel: lsdcd generate cylinder")
            where = f"zcylinder {place[0]}"
            self.note(line, "LAMMPS counts the curvature: model hertz is stiffer by a quarter of the radius of a grain over that "
                      "of the cylinder; from 11Feb2026 on it has no zcylinder. A mesh by lsdcd generate cylinder has neither")
        else:
            raise Left(f"{shape} about another axis than z through the origin",
                       "a mesh: lsdcd generate cylinder, placed by rotate and move")
        text = " ".join([f"fix             {w[1]} {w[2]} wall/gran {laws.pop()} {where}", *shear])
        if model.nearest:
            raise model.left_rolling(contacts[0], text)
        self.put(text)

    def motion(self, line, w):
        style, rest = w[6], w[7:]
        if style == "linear" and len(rest) == 3:
            return "linear " + " ".join(rest)
        if style == "wiggle" and len(rest) == 6 and rest[::4] == ["amplitude", "period"]:
            return f"wiggle {' '.join(rest[1:4])} {rest[5]}"
        if style in ("rotate", "rotate/superposable") and len(rest) == 10 and rest[::4] == ["origin", "axis", "period"]:
            return f"rotate {' '.join(rest[1:4])} {' '.join(rest[5:8])} {rest[9]}"
        if style == "riggle" and len(rest) == 12 and rest[::4] == ["origin", "axis", "period"] and rest[10] == "amplitude":
            return f"riggle {' '.join(rest[1:4])} {' '.join(rest[5:8])} {rest[11]} {rest[9]}"
        if style == "linear/variable" and len(rest) == 3 and all(x.startswith("v_") for x in rest):
            self.note(line, "LIGGGHTS goes on by the speed at the end of a step, here it is the mean of both ends")
            return "variable NULL NULL NULL " + " ".join(rest)
        if style == "rotate/variable" and len(rest) == 10 and rest[::4] == ["origin", "axis", "omega"] and rest[9].startswith("v_"):
            self.note(line, "LIGGGHTS turns by the speed at the end of a step, here it is the mean of both ends")
            return f"rotate {' '.join(rest[1:4])} {' '.join(rest[5:8])} variable NULL {rest[9]}"
        if style == "viblin" and rest[::4][:2] == ["axis", "order"]:
            place, speed = self.waves(line, w[1], rest[4:])
            axis = unit([self.number(x, line) for x in rest[1:4]])
            for name, of in (("x", place), ("v", speed)):
                for k in range(3):
                    self.put(f"variable        {of}{'xyz'[k]} equal {short(axis[k])}*v_{of}")
            return "variable " + " ".join(f"v_{of}{a}" for of in (place, speed) for a in "xyz")
        if style == "vibrot" and rest[::4][:3] == ["origin", "axis", "order"]:
            return f"rotate {' '.join(rest[1:4])} {' '.join(rest[5:8])} variable " + " ".join(
                f"v_{name}" for name in self.waves(line, w[1], rest[8:]))
        if style in ("linear", "wiggle", "rotate", "rotate/superposable", "riggle", "linear/variable", "rotate/variable", "viblin", "vibrot"):
            raise ValueError(style)
        raise Left(f"move/mesh {style}", "motion table for places at times, or motion variable")

    def waves(self, line, name, w):
        """Writes variables of the sum of n waves from their words: order n amplitude C1 ... phase p1 ... period T1 ...; with one period,
        as in LIGGGHTS-PFM, wave k has T/k. The sum is 0 where it begins. Returns the names of the sum and of its derivative."""
        n = int(w[1])
        amplitudes, phases, periods = w[3:3 + n], w[4 + n:4 + 2 * n], w[5 + 2 * n:]
        if [w[0], w[2], w[3 + n], w[4 + 2 * n]] != ["order", "amplitude", "phase", "period"] or len(periods) not in (1, n):
            raise ValueError("waves")
        commands = [(other, c) for other in self.lines for c in commands_in(other.words or [""])]
        run = min([other.index for other, c in commands if c[0] == "run"], default=0)
        if any(c[0] == "timestep" and (other.index > max(line.index, run) or other.loops) or c[3:4] == ["dt/reset"]
               for other, c in commands):
            raise Left("a motion by waves where the timestep changes", "motion table, or variables of the time")
        if any(c[0] == "reset_timestep" and (other.index > line.index or (other.loops and line.loops)) for other, c in commands):
            raise Left("a motion by waves before reset_timestep, which its formula counts on", "motion table, or variables of the time")
        begin = "$(step)" if self.step is None else self.step
        place, speed = f"lsdcd_{name}_s", f"lsdcd_{name}_v"
        self.put(f"variable        lsdcd_{name}_t equal 2*PI*(step-{begin})*dt")
        speeds = [f"{k}/({periods[0]})" if len(periods) < n else f"1/({periods[k - 1]})" for k in range(1, n + 1)]
        turns = [(f"({c})", v, f"v_lsdcd_{name}_t*{v}+({p})", f"({p})") for c, v, p in zip(amplitudes, speeds, phases)]
        self.put(f"variable        {place} equal " + "+".join(f"{c}*(cos({at})-cos{p})" for c, _, at, p in turns))
        self.put(f"variable        {speed} equal -2*PI*(" + "+".join(f"{c}*{v}*sin({at})" for c, v, at, _ in turns) + ")")
        if not self.options.pfm:
            self.note(line, "LIGGGHTS goes on by the speed at the end of a step, here the place is that of the formula")
        return place, speed

    def move(self, line):
        before = []
        w = line.words[:7] + [self.carry(x, line, before) for x in line.words[7:]]
        self.same_mesh(line, w[5])
        replaced = self.moves.pop(w[1], None)
        if replaced:
            replaced[0].moves.remove(replaced[1])
            if replaced[0].moves:
                raise Left(f"one of several motions of {replaced[0].id} is replaced", "fix_modify motion with all that go on: they begin anew")
        mesh = self.meshes.get(w[5])
        if mesh is None:
            raise Left(f"the mesh {w[5]}, which is not converted", "motion, after its file")
        self.sure(mesh.line, line)
        for text in before:
            self.put(text)
        words = self.motion(line, w)
        for name in (x for x in words.split() if x.startswith("v_") and not self.is_here(x)):
            raise Left(f"{name}, which is not here", "another variable")
        active = [m for m in self.moves.values() if m[0] is mesh]
        self.check_motions(line, w, words, mesh, active)
        if mesh.wall is None:
            if not mesh.wall_lines:
                raise Left(f"the mesh {w[5]} is no wall", "fix massflow/lsdcd has no motion")
            following = [other for other in mesh.wall_lines if other.index > line.index]
            if not following:
                raise Left(f"the mesh {w[5]} is in no wall", "add it to the wall")
            self.sure(line, following[0])
            self.note(line, f"a motion of fix {following[0].words[1]}")
        self.moves[w[1]] = [mesh, words, self.ran, w[6], line]
        mesh.moves.append(words)
        if replaced and replaced[0] is not mesh and replaced[0].wall:
            self.put(self.modify(replaced[0], []))
        if mesh.wall is None:
            return
        self.put(self.modify(mesh, mesh.moves))
        if len(mesh.moves) > 1:
            self.note(line, "the first motion of LIGGGHTS is the outer one; here it is the last")

    def same_mesh(self, line, name):
        """Raises Left where the motion that a line replaces or ends may be one of another mesh, or its mesh be in another wall."""
        now = self.moves.get(line.words[1])
        around = [x for first, last in line.loops for x in self.lines[first:last + 1] if x.words[:2] == ["fix", line.words[1]]]
        if any(x.words[5:6] != [name] for x in around) or (now and (
                not now[4].skips <= line.skips or (line.loops and now[0].id != name))):
            raise Left(f"the motion {line.words[1]}, which a jump may have given to another mesh", "an ID for each motion")
        mesh = self.meshes.get(name)
        if mesh and mesh.wall:
            self.same_wall(mesh, line)

    def same_wall(self, mesh, line):
        """Raises Left where a mesh may be in another wall than the last one above."""
        self.sure(mesh.wall_at, line)
        if any(mesh.wall_at.index < first <= x.index <= last for first, last in line.loops for x in mesh.wall_lines):
            raise Left(f"a change of the mesh {mesh.id}, whose wall changes in the loop", "one wall for all turns of the loop")

    def check_motions(self, line, w, words, mesh, active):
        """Raises Left for a motion that does not go with the others of its mesh."""
        if any(m[2] != self.ran for m in active):
            raise Left(f"a second motion of {mesh.id} that begins later",
                       "fix_modify motion begins all anew; write both from the start, the outer one last")
        stays = [x for first, last in line.loops for x in self.lines[first:last + 1] if x is not line and x.words[5:6] == w[5:6] and
                 x.words[1] != w[1] and x.words[0] == "fix" and self.style(x.words) == "move/mesh" and not any(
                     y.words[:2] == ["unfix", x.words[1]] and y.index > x.index and y.skips <= x.skips for y in self.lines[:last + 1])]
        if mesh.unsure or stays or any(m[4].skips != line.skips for m in active):
            raise Left(f"a motion of {mesh.id} beside another one, which a jump may skip or bring back", "one fix_modify motion with both")
        if active and any(x.startswith("riggle") for x in [words, *(m[1] for m in active)]):
            raise Left(f"riggle beside another motion of {mesh.id}", "LIGGGHTS turns about the axis where it was; here it "
                       "moves along with an outer motion: motion riggle and the others, in the order that is meant")
        if words.split()[0] != "rotate" and any(m[1].startswith("rotate") for m in active):
            raise Left("a linear motion after a rotation", "not there: LIGGGHTS adds their velocities and turns about the "
                       "axis where it was; write the linear one first to have the axis move along")
        if words.startswith("rotate"):
            self.check_axes(line, w, words, [m for m in active if m[1].startswith("rotate")])

    def check_axes(self, line, w, words, others):
        """Two turns of one mesh. The axis of LIGGGHTS's rotate stays in space; here the first turn turns the axis of the second,
        as rotate/superposable of LIGGGHTS-PFM does. Both are the same where the axes are parallel."""
        axes = [unit([self.number(x, line) for x in text.split()[4:7]]) for text in [words] + [m[1] for m in others]]
        parallel = all(math.hypot(*cross(axes[0], a)) < 1e-9 for a in axes)
        if len({w[6]} | {m[3] for m in others}) > 1 or (w[6] != "rotate/superposable" and not parallel):
            raise Left("a rotation after another about an axis that is not parallel to it, which stays in space in LIGGGHTS",
                       "not there: here the first rotation turns the axis of the second; rotate/superposable of LIGGGHTS-PFM, too")

    @staticmethod
    def modify(mesh, moves):
        which = f" mesh {mesh.index}" if mesh.several else ""
        return f"fix_modify      {mesh.wall}{which} " + (" ".join(f"motion {m}" for m in reversed(moves)) or "motion none")

    def stop(self, line):
        mesh, words, _, _, where = self.moves[line.words[1]]
        self.same_mesh(line, mesh.id)
        several = len(mesh.moves) > 1
        if line.skips <= where.skips:
            del self.moves[line.words[1]]
            mesh.moves.remove(words)
        else:
            mesh.unsure = True    # a jump may have kept it
        if several:
            raise Left(f"one of several motions of {mesh.id} ends", "fix_modify motion with the others: they begin anew")
        self.put(self.modify(mesh, []) if mesh.wall else f"# {line.text.strip()}")

    def fix_modify(self, line):
        w = line.words
        mesh = self.meshes.get(w[1])
        if mesh is None:
            self.put(line.text)
            return
        if (not mesh.servo and not mesh.body) or mesh.wall is None:
            raise Left(f"fix_modify {w[2]}", "fix_modify of the wall with that mesh: motion, servo or body")
        self.same_wall(mesh, line)
        if mesh.body:
            self.modify_body(line, mesh)
            return
        which = f" mesh {mesh.index}" if mesh.several else ""
        word = w[2].removeprefix("servo/")
        if [word, *w[3:]] == ["integrate", "stop"]:
            self.put(f"fix_modify      {mesh.wall}{which} servo none")
        elif [word, *w[3:]] == ["integrate", "start"] or (word == "target_val" and len(w) == 4):
            kept = []
            target = self.carry(w[3], line, kept) if word == "target_val" else mesh.target
            if mesh.unsure or kept:
                raise Left(f"fix_modify {w[2]} with a target that a jump may change", "fix_modify servo with all its words")
            mesh.unsure = not line.skips <= mesh.line.skips or bool(line.loops)
            mesh.servo = mesh.servo.replace(f" {mesh.target} vmax", f" {target} vmax")
            mesh.target = target
            self.put(f"fix_modify      {mesh.wall}{which} {mesh.servo}")
        else:
            raise Left(f"fix_modify {w[2]}", "fix_modify servo with all its words; it needs no gains")

    def modify_body(self, line, mesh):
        """A free body whose centre stops: LIGGGHTS drops forces and sets the velocity, which is a ball joint where the centre is."""
        w, new = [x.removeprefix("6dof/") for x in line.words[2:]], {}
        while len(w) >= 4 and w[0] in ("forceflags", "vel"):
            new[w[0]], w = [self.number(x, line) for x in w[1:4]], w[4:]
        # Without vel the body would keep its velocity, and a body that is held already has a joint.
        if w or new != {"forceflags": [0, 0, 0], "vel": [0, 0, 0]} or mesh.held:
            raise Left(f"fix_modify {line.words[2]} of a mesh with 6dof", "fix_modify of the wall: body joint, load, moment, spring or limits")
        # LAMMPS knows the place after a run.
        place = [f"$({mesh.output(k, self)}:%.17g)" for k in (7, 8, 9)] if self.ran else mesh.com
        which = f" mesh {mesh.index}" if mesh.several else ""
        mesh.held = True
        self.put(f"fix_modify      {mesh.wall}{which} body joint ball {' '.join(place)}")

    def stands_still(self, mesh, line):
        """Raises Left for a mesh that moves where only a wall can."""
        self.sure(mesh.line, line)
        if mesh.id in self.used or mesh.servo or mesh.body:
            raise Left(f"{self.style(line.words)} of the mesh {mesh.id}, which moves", "a mesh that stands: only walls move")

    def massflow(self, line):
        w = line.words
        v = options(w[4:], {"mesh": 1, "vec_side": 3, "count": 1, "delete_atoms": 1, "file": 1, "append": 1, "writeTime": 0,
                            "screen": 1, "point_at_outlet": 3, "inside_out": 0, "sum_property": 1})
        mesh = self.meshes.get(v["mesh"][0])
        if mesh is None:
            raise Left("massflow/mesh through a mesh that is not converted", "fix massflow/lsdcd mesh FILE")
        self.stands_still(mesh, line)
        if "vec_side" not in v or "point_at_outlet" in v:
            raise Left("massflow/mesh with point_at_outlet", "fix massflow/lsdcd counts along the normals of the triangles, of "
                       "curved meshes too: wind them so that they point to the outlet")
        side = [self.number(x, line) for x in v["vec_side"]]
        ways = {dot(cross(minus(b, a), minus(c, a)), side) > 0 for a, b, c in mesh.triangles(self)}
        if len(ways) > 1:
            raise Left(f"{mesh.file} has triangles wound along vec_side and others against it",
                       f"lsdcd repair {mesh.file} -o FILE winds them alike; then fix massflow/lsdcd, which counts along the winding")
        forward, delete = ways.pop(), is_yes(v, "delete_atoms", "no")
        if delete and not forward:
            raise Left("delete_atoms where the mesh is wound against vec_side",
                       "turn its triangles over: only what passes forward is deleted")
        count = v.get("count", ["multiple"])[0]
        if count not in ("once", "multiple"):
            raise ValueError("count")
        count = {"once": "once", "multiple": "each"}[count]
        self.put(f"fix             {w[1]} {w[2]} massflow/lsdcd mesh {mesh.file}{mesh.placement()} count {count}" +
                 " delete yes" * delete)
        if not forward:
            self.note(line, f"the mesh is wound against vec_side: f_{w[1]}[4] is the mass and f_{w[1]}[3] the number")
        if count == "once":
            self.note(line, "a grain that passes backward first is not counted when it comes again; in LIGGGHTS it is")
        if "file" in v or "append" in v or is_yes(v, "screen", "no"):
            self.note(line, "no file or line with each grain that has passed")
        number, mass = (1, 2) if forward else (3, 4)
        rate = f"f_{w[1]}[6]" if forward else f"(-f_{w[1]}[6])"
        self.mirror(line, {1: f"f_{w[1]}[{mass}]", 2: f"f_{w[1]}[{number}]", 3: rate, 5: f"f_{w[1]}[8]", 6: f"f_{w[1]}[7]"})

    def mirror(self, line, outputs):
        """Sets what stands for the outputs of a fix."""
        name = line.words[1]
        if self.named_flows.get(name, outputs) != outputs:
            self.leave(line, f"outputs of {name} that lines above take from another fix of this ID", "these lines again below this one")
            self.out.pop()
        self.mirrored[name] = outputs

    def dump(self, line):
        w = line.words
        self.texts.discard(w[1])
        if line in self.dumps:
            self.gone[w[1]] = Left("a file of the wall", "nothing")
            self.put(line)
        elif w[3] in ("custom/vtk", "atom/vtk"):
            self.texts.add(w[1])
            columns = self.columns(line, w[6:]) if w[3] == "custom/vtk" else ["id", "type", "x", "y", "z", "radius"]
            self.put(self.renamed(line, f"dump            {w[1]} {w[2]} custom {w[4]} "
                                  f"{re.sub('[.]vt[kp]$', '.txt', w[5])} {' '.join(columns)}"))
            self.note(line, "text in place of VTK; dump vtk has the same words where LAMMPS has the package VTK")
        elif w[3] == "custom":
            self.put(self.renamed(line, " ".join(w[:6] + self.columns(line, w[6:]))))
        elif w[3] in SAME_DUMPS:
            self.put(self.renamed(line, line.text))
        elif w[3] == "decomposition/vtk" or w[3] in MESH_DUMPS:
            self.plain.add(w[1])
            self.put(f"# {' '.join(w)}")
            self.note(line, "no picture of what each process has")
        else:
            raise Left(f"dump {w[3]}", "dump custom, or mesh_fields of the wall")

    def columns(self, line, words):
        kept = [x for x in words if x in COLUMNS or "$" in x or (x[:2] in ("f_", "c_", "v_") and self.is_here(x))]
        for name in (x for x in words if x not in kept):
            self.note(line, f"without {name}, which is not here")
        return kept


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
    p.add_argument("--pfm", action="store_true", help="with the defaults of LIGGGHTS-PFM: tangential no_history, units lattice")
    p.add_argument("--nearest", action="store_true", help="take the nearest commands, which else are comments with #:")
    p.add_argument("--converted-restart", action="store_true", help="read_restart reads a file that a converted script has written")
    p.add_argument("--var", nargs=2, action="append", metavar=("NAME", "VALUE"), help="value of a variable")
    a = p.parse_args()
    try:
        script = Script(a.script, a)
        text = script.convert()
    except (CannotConvert, OSError) as error:
        sys.exit(f"convert.py: {error}\nNothing was written.")
    if a.out:
        with tempfile.NamedTemporaryFile(dir=a.out.parent, delete=False) as whole:
            whole.write(text.encode("utf-8", "surrogateescape"))
        os.chmod(whole.name, 0o644)
        os.replace(whole.name, a.out)
    else:
        sys.stdout.buffer.write(text.encode("utf-8", "surrogateescape"))
    for left in script.left:
        print(f"left: {left}", file=sys.stderr)
    print(f"commands left: {len(script.left)}" + (f", see LEFT in {a.out}" if a.out and script.left else ""), file=sys.stderr)
    sys.exit(3 if script.left else 0)


if __name__ == "__main__":
    main()
