# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The converted script, line by line."""
import math
import re

from .contacts import Contacts
from .dumps import DUMP_MODIFY, MESH_DUMPS, TEXT_DUMP_WORDS, Dumps
from .errors import CannotConvert, Left
from .flows import Flows
from .forms import pairs, read
from .formulas import VARIABLE, expand, formula, number_of
from .geometry import short, unit
from .insertion import DISTRIBUTIONS, Insertion
from .lines import ENDERS, KINDS, MAKERS, commands_in, last_value, needed_by, nested, unquoted, words_of
from .meshes import Mesh
from .motions import Motions, TURNS
from .program import Program
from .properties import PROPERTY_KINDS, Properties
from .same import BALANCE, COMMANDS, COMPUTES, FIXES, PLAIN_COMMANDS, Same
from .walls import Wall, Walls

# Checks of stiffnesses, timings, threads.
NO_PHYSICS = {"hard_particles": "YES", "soft_particles": "YES", "modify_timing": "on|off|verbose", "partitioner_style": "zoltan (NAME NAME)*",
              "package": "omp GRID (force|force/neigh|neigh|thread-binding|verbose)*"}


class Script(Walls, Motions, Insertion, Flows, Dumps, Contacts, Properties, Same):
    def __init__(self, path, options):
        self.path, self.folder, self.options = path, path.parent, options
        self.program = Program(path, options.var or [])
        self.lines = self.program.lines
        # What is known of the whole script.
        self.properties, self.grain_types, self.all_types = {}, set(), self.program.unread
        self.sizes = [None] * self.program.unread
        self.missing_data, self.data_boxes, self.data_sizes = [], {}, {}    # files of read_data; edges of the box and sizes of grains in them, by line
        self.meshes, self.mesh_of, self.walls, self.unchecked, self.used = {}, {}, {}, set(), set()    # by line; IDs
        self.turning = set()    # IDs of meshes that turn
        self.dumps, self.dumped, self.lattice = [], {}, False
        self.other_units = None    # in which a force of 1 gives a mass of 1 another acceleration than 1
        self.files = {}    # bytes of files to write, by their paths
        self.gravity_names, self.gravities = set(), []    # the acceleration of each fix gravity, None where it is not known
        self.names = {"c_thermo_temp", "c_thermo_press", "c_thermo_pe"} | {
            f"{line.words[0][0]}_{line.words[1]}" for line in self.lines if line.words[:1] in (["fix"], ["compute"]) and line.words[1:]}
        for line in self.lines:
            try:
                self.collect(line)
            except (IndexError, KeyError, ValueError):
                raise CannotConvert(f"{self.at(line)}: words are missing or wrong: {line.text.strip()}") from None
        if options.radius and options.density:
            self.sizes = [(options.radius, options.density)]
        # What is known at a line, in the order of the script.
        self.out, self.left, self.left_variables = [], [], set()
        self.noted, self.noted_dashpot, self.noted_energy, self.units = False, False, False, "lattice" if options.pfm else "box"
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
        self.taken_away = 0    # degrees of freedom, by fix rigid
        self.per_atom = set()    # c_ID, f_ID of what has values of atoms
        self.rows = {}    # of computes of contacts: style, what stands for each column, its word
        self.named, self.named_flows = {}, {}    # outputs that lines have taken, of meshes and of other fixes
        self.densities = {}    # of set, insertions and create_atoms: of the groups or regions, the last one at the end; None: not known
        self.step, self.timestep, self.sources = 0, None, []    # here, None where it is not known; what has made grains

    def at(self, line):
        return f"{line.file}:{line.number}"

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
                self.properties.setdefault(w[4], []).append((line, [PROPERTY_KINDS.get(w[5]), *w[6:]]))
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
                if w[6].startswith(TURNS):
                    self.turning.add(w[5])
        elif w[0] == "dump" and len(w) > 5 and w[3] in MESH_DUMPS and "ghost" not in w[6:]:
            self.dumps.append(line)
            self.dumped[line] = set()
        elif w[0] == "read_data":
            self.read_data(line)
        elif w[0] == "create_atoms":
            self.add_type(self.known(w[1], line))
        elif w[0] == "set":
            for word in (x for x in ("type", "type/fraction") if x in w[3:]):
                self.add_type(self.known(last_value(w[3:], word), line))
            if any(word in w[3:] for word in ("diameter", "density", "mass")):
                size = [self.known(last_value(w[3:], word), line) if word in w[3:] else None for word in ("diameter", "density")]
                self.sizes.append(None if None in size or "mass" in w[3:] else (size[0] / 2, size[1]))
        elif w[0] in ("read_restart", "read_dump"):
            self.all_types = True
        elif w[0] == "unfix" and w[1] in self.gravity_names:
            self.gravities.append(None)
        elif w[0] == "lattice":
            self.lattice = True
        elif w[0] == "units" and w[1] in ("real", "metal", "electron"):
            self.other_units = w[1]

    @staticmethod
    def style(w):
        """The style of a fix. A style of OpenMP is the same one."""
        style = w[3][:-4] if w[3].endswith("/omp") else w[3]
        return "property/global" if style == "custom_property/global" else style

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

    def write_files(self):
        """Writes the meshes that lack triangles. A file of that name that is another one stays, as an error."""
        for path, data in self.files.items():
            if path.exists() and path.read_bytes() != data:
                raise CannotConvert(f"{path} is there, and is not the mesh without the triangles of a list; move it away")
        for path, data in self.files.items():
            path.write_bytes(data)

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
                if line.words[0] == "compute":
                    self.rows.pop(line.words[1], None)
                self.plain.discard(line.words[1])
            if line.words[0] in ("fix", "compute") and len(line.words) > 3:
                of_atoms = line.words[3].endswith("/atom") or line.words[3] == "store/state"
                (self.per_atom.add if of_atoms else self.per_atom.discard)(f"{line.words[0][0]}_{line.words[1]}")
            try:
                self.command(line)
            except (IndexError, KeyError, ValueError):
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

    def command(self, line):
        w = line.words
        if w[0] == "atom_style":
            if w[1] not in ("granular", "sphere", "granular/omp", "sphere/omp") or len(w) > 2:
                raise Left(f"atom_style {' '.join(w[1:])}", "spheres only")
            self.put("atom_style      sphere" + " 1" * any(self.grows(other.words) for other in self.lines))
        elif w[0] == "communicate":
            self.read(line, w[0], "single|multi [group NAME] [cutoff NUMBER] [vel YES]")
            self.put("comm_modify     mode " + " ".join(["single", *w[2:]]))
            if w[1] == "multi":
                self.note(line, "all types of grains have the ghosts of the largest: the mode multi of LAMMPS goes with neighbor multi only")
        elif w[0] in NO_PHYSICS:
            self.read(line, w[0], NO_PHYSICS[w[0]])
            self.put(f"# {line.text.strip()}")
        elif w[0] == "pair_style":
            self.pair_style(line)
        elif w[0] == "pair_coeff":
            if self.pair is None:
                raise Left("pair_coeff of a pair style that was left", "see there")
            self.read(line, w[0], "* *")
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
        elif w[0] == "if" and nested(w) and all(self.only_balances(words_of(unquoted(x))) for x in nested(w)):
            for x in nested(w):
                read("fix balance", BALANCE, [expand(y, line.scope) for y in words_of(unquoted(x))[4:]])
            text = line.text
            for x in nested(w):
                text = text.replace(x, f'"{" ".join(self.balance(words_of(unquoted(x))).split())}"')
            self.put(text)
        elif w[0] in ("if", "run") and any(c[0] not in PLAIN_COMMANDS for c in commands_in(w)[1:]):
            raise Left(f"commands in {w[0]} that are to be converted", "convert them as lines of their own, and put them here")
        elif w[0] == "compute" and w[3] in ("pair/gran/local", "wall/gran/local"):
            self.contacts(line)
        elif w[0] == "compute":
            if w[3] not in COMPUTES:
                raise Left(f"compute {w[3]}", "LAMMPS has no compute of that name with these words")
            self.read(line, f"compute {w[3]}", COMPUTES[w[3]], 4)
            self.pass_on(line)
        elif w[0] in ("unfix", "undump", "uncompute", "fix_modify", "compute_modify", "dump_modify") and w[1] in self.gone:
            self.put(f"# {' '.join(w)}")
            if w[0].startswith("un") and not line.skips:
                del self.gone[w[1]]
        elif w[0] == "clear":
            self.clear()
            self.put(line.text)
        elif w[0] == "dump_modify" and w[1] in self.texts:
            # All of them: each thresh is a condition more.
            kept = [f"{k} {' '.join(v)}" for k, v in pairs(w[2:], TEXT_DUMP_WORDS) if k not in ("binary", "compressor")]
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
            self.densities[w[0]] = None
            if not self.options.converted_restart:
                raise Left("a restart file, which LIGGGHTS writes in another format", "write_data there and read_data here; where "
                           "a converted script has written the file, convert with --converted-restart")
            self.put(line.text)
        elif w[0] == "dump_modify":
            self.read(line, "dump_modify", DUMP_MODIFY)
            self.pass_on(line)
        elif w[0] == "dimension" and self.known(w[1], line) != 3:
            raise Left(f"dimension {w[1]}: the grains of LIGGGHTS are discs there, with the mass pi R^2 density and half of m R^2 as moment of inertia",
                       "a layer of spheres in three dimensions; or set ... density/disc, fix nve/sphere disc, and laws for these masses")
        elif w[0] == "coarsegraining":
            raise Left("coarsegraining, which multiplies kn and gamman by rules of its own, and not kt and gammat",
                       "radii, diameters and lengths of templates times the factor, and coarse_grain L behind pair_style granular/lsdcd and in each fix "
                       "wall/lsdcd, whose numbers are those of the real grains: doc/contact_laws.rst, Coarse graining")
        elif w[0] not in COMMANDS:
            raise Left(f"the command {w[0]}", "see the manual of LAMMPS, or convert the file that it names by itself")
        else:
            unread = self.unread(line)
            if unread and w[0] == "region":
                self.regions.pop(w[1], None)
                raise unread
            self.count_steps(line)
            if unread:
                raise unread
            self.pass_on(line)

    @staticmethod
    def read(line, name, forms, begin=1):
        """Raises Left where a word of a line from `begin` on is none of its forms. Variables that are known stand for their values."""
        read(name, forms, [expand(x, line.scope) for x in line.words[begin:]])

    def fix(self, line):
        w = line.words
        name, style = w[1], self.style(w)
        self.mirrored.pop(name, None)
        if style == "property/global":
            self.read_property(line)
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
            if self.meshes[name].said:
                self.note(line, self.meshes[name].said)
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
            self.read(line, style, "check_every_time? COUNT NUMBER NUMBER [warn YES] [error YES] [vmax NUMBER]", 4)
            self.plain.add(name)
            self.note(line, "fix check/timestep/gran has no counterpart; lsdcd timestep names a timestep" +
                      ("; LIGGGHTS stops where the timestep is too long" if last_value(w[4:], "error") == "yes" else ""))
        elif style.startswith("insert/"):
            self.insert(line)
        elif style.startswith(("particletemplate", "particledistribution")):
            self.templates.pop(name, None)
            self.distributions.pop(name, None)
            kind, *size = self.template(line) if style == "particletemplate/sphere" else (None, None)
            if kind and None not in size:
                self.templates[name] = (short(kind), *size, line)
            if style in DISTRIBUTIONS:
                self.read(line, f"fix {style}", "NUMBER COUNT (NAME NUMBER)+", 4)
                if self.number(w[5], line) != len(w[6:]) / 2:
                    raise Left(f"{w[5]} templates of {style}, which are {len(w[6:]) / 2:g}", "the number of templates that follow")
                self.distributions[name] = (DISTRIBUTIONS[style], w[6:], line)
            if name in self.templates or (name in self.distributions and all(k in self.templates for k in w[6::2])):
                self.plain.add(name)
                self.put(f"# {name}: see the fixes that insert grains")
                return
            raise Left(style, "radii and densities go to fix insert/lsdcd (diam, dens), or to set after create_atoms")
        elif style == "balance" and len(w) == 8:
            self.read(line, "fix balance", BALANCE, 4)
            self.put(self.balance(w))
        elif style in FIXES:
            if style == "nve/limit" and w[4] in ("radius_ratio", "absolute"):
                raise Left(f"nve/limit {w[4]}", "nve/limit of LAMMPS has the largest distance alone")
            self.read(line, f"fix {style}", FIXES[style], 4)
            if self.grows(w):
                self.grow(line)
                return
            if style == "rigid":
                self.count_energy(line, 10**9)    # which takes six of each grain, more than it has
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
