# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""fix mesh/surface with its modules."""
import math
from pathlib import Path

from .errors import CannotConvert, Left
from .forms import pairs
from .formulas import expand
from .geometry import cross, dot, minus, read_stl, short, turned, unit, without_facets

VECTOR = "NUMBER NUMBER NUMBER"
STYLES = ("mesh/surface", "mesh/surface/planar", "mesh/surface/stress", "mesh/surface/stress/servo", "mesh/surface/stress/6dof")
# Words that need a decision, and what to do.
TRANSLATED = {
    **{x: (f"a mesh by {x}", "make a file of it (lsdcd generate makes boxes, cylinders, planes; dump mesh/stl in LIGGGHTS writes any mesh) and "
           "name that") for x in ("generate", "fix", "extrude_planar", "region")},
    "rot_flip": ("rot_flip of a mesh with 6dof", "limits of a body on a hinge, which stop it without a rebound"),
    **{x: (f"{x} of a mesh", "the sub-model heat and the keyword temperature of fix wall/lsdcd") for x in ("temperature", "mass_temperature")}}
# The values of each word of a mesh, and those of its modules.
MESH_WORDS = {"file": "FILE", "type": "COUNT", "scale": "NUMBER", "move": VECTOR, "rotate": f"axis {VECTOR} angle NUMBER", "surface_vel": VECTOR,
              "surface_ang_vel": f"origin {VECTOR} axis {VECTOR} omega NUMBER", "heal": "auto_remove_duplicates|no", "curvature": "NUMBER",
              "curvature_tolerant": "YES", "verbose": "YES", "precision": "NUMBER", "min_feature_length": "NUMBER", "element_exclusion_list": "read|write FILE"}
STRESS_WORDS = {"reference_point": VECTOR, "wear": "off|finnie", "stress": "on|off|yes|no"}
SERVO_WORDS = {"com": VECTOR, "axis": VECTOR, "ctrlPV": "force|torque", "target_val": "NUMBER|VARIABLE", **dict.fromkeys("vel_max kp ki kd ratio".split(), "NUMBER"), "mode": "auto"}
BODY_WORDS = {**dict.fromkeys("com vel angmom".split(), VECTOR), **dict.fromkeys(("forceflags", "torqueflags"), "NUMBER NUMBER NUMBER"), "mass": "NUMBER",
              "moi": f"{VECTOR} {VECTOR}", "suspension": "k_t NUMBER c_t NUMBER k_r NUMBER c_r NUMBER"}
# Of servos and bodies: words of which the first one counts. Of all others it is the last one.
KEPT = ("com", "mass", "moi")
FORCE, TORQUE = (1, 2, 3), (4, 5, 6)


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
        self.excluded, self.data, self.said = None, None, ""    # a list of triangles to leave out, the bytes of the mesh without them, a note
        self.spins = False    # by surface_ang_vel
        self.before, self.unsure = [], False    # variables that it needs; whether a jump may have changed its motions
        self.way, self.worn = [0.0, 0.0, 0.0], False    # how runs have moved it, None where that is no known way; whether they wore it
        self.first, self.wall_at = None, None    # ID of its wall, its place there, whether there are others; the line of its wall now
        self.parse(script, [script.carry(x, line, self.before) for x in w[4:]])

    def known_words(self):
        known = {**MESH_WORDS, **{key: Left(*why) for key, why in TRANSLATED.items()}}
        if self.style.startswith("mesh/surface/stress"):
            known.update(STRESS_WORDS)
        known.update({"mesh/surface/stress/servo": SERVO_WORDS, "mesh/surface/stress/6dof": BODY_WORDS}.get(self.style, {}))
        return known

    def parse(self, script, w):
        number, values, surface, spin = script.number, {}, None, None
        if self.style not in STYLES:
            raise Left(f"the module of {self.style}", "mesh/surface/stress; others are not there")
        for key, v in pairs(w, self.known_words(), " of a mesh"):
            if key == "file":
                self.file = v[0]
            elif key == "type":
                self.type = int(number(v[0], self.line))
            elif key in ("scale", "move"):
                self.place.append((key, v))
            elif key == "rotate":
                self.place.append((key, [*v[1:4], v[5]]))
            elif key == "surface_vel":
                surface = v
            elif key == "surface_ang_vel":
                spin = v
            elif key == "reference_point":
                self.reference = v
            elif key == "wear":
                self.wear = v[0] == "finnie"
            elif key == "element_exclusion_list":
                self.excluded = v[1] if v[0] == "read" else None
            elif key in values and key in KEPT:
                continue
            else:
                values[key] = v if len(v) > 1 else v[0]
        if self.file is None or not self.file.lower().endswith((".stl", ".obj", ".ply", ".off")):
            raise Left(f"the file {self.file}", "write it as STL")
        self.path = script.folder / expand(self.file, self.line.scope)
        if self.excluded:
            self.leave_out(script)
        if self.style.endswith("/stress/servo"):
            self.add_servo(script, values)
            self.reference = list(self.com)    # com replaces reference_point
        elif self.style.endswith("/stress/6dof"):
            self.add_body(script, values)
            self.reference = None
        if surface:
            self.add_surface_vel(script, surface)
        if spin:
            self.spins = True
            self.add_surface_ang_vel(script, spin)

    def turns(self, script):
        """Whether the mesh, or its surface, ever has an angular velocity."""
        return (self.id in script.turning or self.spins or self.has_torque_servo() or
                bool(self.body and "joint slider" not in self.body))

    def has_torque_servo(self):
        return bool(self.servo and self.servo.startswith("servo torque"))

    def leave_out(self, script):
        """Leaves out the triangles that a list names: the mesh becomes another file."""
        where = script.folder / expand(self.excluded, self.line.scope)
        if not self.path.is_file() or not where.is_file() or self.path.suffix.lower() != ".stl":
            raise Left(f"element_exclusion_list read {self.excluded}, with the mesh {self.file}", "both files beside the script; the mesh as STL")
        whole = self.path.read_bytes()
        self.data, n = without_facets(whole, [int(x) for x in where.read_text().split()])
        scale = math.prod(script.number(values[0], self.line) for key, values in self.place if key == "scale")
        area = scale ** 2 * sum(math.sqrt(dot(c, c)) / 2 * sign for data, sign in ((whole, 1), (self.data, -1)) for c in (
            cross(minus(t[1], t[0]), minus(t[2], t[0])) for t in read_stl(data)))
        kept = Path(expand(self.file, self.line.scope))
        self.file = str(kept.with_name(f"{kept.stem}_kept.stl"))
        self.path = script.folder / self.file
        script.files[self.path] = self.data
        self.said = f"{self.file} has no triangles of {self.excluded}: {n} with an area of {area:.6g} are left out"

    def faces(self, script):
        """Corners and normal of each triangle of the placed mesh; None where the file is not there."""
        if self.data is None and not self.path.exists():
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
        if self.data is None and not self.path.exists():
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

        triangles = [tuple(placed(p) for p in t) for t in read_stl(self.path.read_bytes() if self.data is None else self.data)]
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
