# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""fix wall/gran on meshes and primitive."""
import math
import re

from .errors import CannotConvert, Left
from .forms import read
from .geometry import short
from .laws import Contact, Model

STORED = {**dict.fromkeys(("store_force", "store_force_contact", "store_force_contact_stress"), "YES"), "store_force_contact_every": "COUNT"}


class Wall:
    """The words of a fix wall/gran: the model, then words of the wall, then settings of the model."""

    def __init__(self, script, line):
        self.line, self.model, self.ids, self.stored = line, Model(line.words[4:], script.options.pfm), [], False
        self.shape, self.place, self.type, self.shear = None, [], None, []
        w, n, mesh = self.model.rest, 0, False
        while w:
            if w[0] == "mesh":
                mesh, self.shape = w.pop(0), None    # of a mesh and a primitive the last one counts
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
                self.type, self.shape, self.ids, mesh = int(script.number(w[2], line)), w[3], [], False
                del w[:4]
                n_values = 1 if self.shape.endswith("plane") else 3
                self.place = [w.pop(0) for _ in range(n_values)]
            elif w[0] == "shear":
                read("shear", "x|y|z NUMBER", w[1:3])
                self.shear = w[:3]
                del w[:3]
            elif w[0] in STORED:
                read(w[0], STORED[w[0]], w[1:2])
                self.stored = self.stored or w[1] != "no"
                del w[:2]
            else:
                break
        self.model.settings(w, "wall/gran")
        if mesh and not self.ids:
            raise ValueError("mesh without meshes")
        if not mesh and not self.shape:
            raise Left("a form of wall/gran that is older than 3.0", "wall/gran of LAMMPS has these words")


class Walls:
    """fix wall/gran on meshes and primitive."""

    def law_of(self, line, model, wall_type):
        """Words of the wall for each grain type."""
        r, m = self.size(line, model)
        return {i: model.law(Contact(self, line, wall_type, i), r, m) for i in self.grains()}

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
        self.note_friction(line, model, contacts, model.is_granular)
        self.note_stored(line, wall)
        self.note_rolling(line, model, meshes)
        self.check_bodies(line, model, meshes)
        # One fix, so that a grain where meshes meet is pushed once; each mesh has its law.
        laws = [self.law_of(line, model, mesh.type) for mesh in meshes]
        first = laws[0][self.grains()[0]]
        words = [f"fix             {w[1]} {self.group_of(line, meshes)} wall/lsdcd {first}" + self.wear(line, meshes) + " each_contact" * self.wants_each_contact(line)]
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
        self.put(" &\n                ".join(words))

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

    def note_rolling(self, line, model, meshes):
        if not model.rolling:
            return
        turning = [mesh.id for mesh in meshes if mesh.turns(self)]
        if turning:
            self.note(line, f"rolling friction at {', '.join(turning)}, which turn{'s' * (len(turning) == 1)}: LIGGGHTS brakes the spin of the grain, "
                      "here it is the spin against that of the mesh: doc/from-liggghts.md, Traps")
        turned = [mesh.id for mesh in meshes if mesh.body or mesh.has_torque_servo() or self.names_torque(mesh)]
        if turned:
            self.note(line, f"the torque on {', '.join(turned)} has the couple of the rolling friction here, LIGGGHTS leaves it out: "
                      "doc/from-liggghts.md, Traps")

    def names_torque(self, mesh):
        """Whether a line names a torque on a mesh."""
        return any(re.search(rf"f_{mesh.id}\[[456]\]", line.text) for line in self.lines)

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
        if mesh.reference or (moving and self.names_torque(mesh)):
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

    def primitive(self, line, wall):
        w, model, grains = line.words, wall.model, self.grains()
        kind, shape, place, shear = wall.type, wall.shape, wall.place, wall.shear
        model.check()
        if model.yields:
            raise Left(f"model {model.normal} of a plane or cylinder, which LAMMPS's own wall does not have", "a mesh of it: lsdcd generate plane or cylinder")
        self.note_stored(line, wall)
        contacts = [Contact(self, line, kind, i) for i in grains]
        model.drop_zeros(contacts)
        if model.normal == "hertz":
            laws = {"granular " + model.granular(c) for c in contacts}
        else:
            laws = set(self.law_of(line, model, kind).values())
        if model.extra and not model.nearest:
            raise model.left_plane(contacts[0])
        self.note_friction(line, model, contacts, False)
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
            raise model.left_plane(contacts[0], text)
        self.put(text)

    def end_wall(self, name):
        """The meshes of a wall that ends are in none."""
        for mesh in (m for m in self.meshes.values() if m.wall == name):
            mesh.wall = None
