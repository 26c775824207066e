# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Commands that both programs have."""
import re

from .dumps import COLUMNS
from .errors import Left
from .lines import commands_in, options

# Styles of fixes that LAMMPS has too, with the same words.
SAME_FIXES = set("""adapt addforce ave/atom ave/correlate ave/histo ave/time aveforce deform drag dt/reset efield
enforce2d external freeze gravity lineforce momentum move nve nve/limit nve/noforce nve/sphere planeforce print rigid
setforce spring spring/self store/state viscous""".split())
SAME_COMPUTES = set("""centro/atom cluster/atom cna/atom com coord/atom displace/atom erotate/sphere erotate/sphere/atom
group/group gyration ke ke/atom msd pe pe/atom pressure property/atom property/local rdf reduce reduce/region stress/atom
temp contact/atom""".split())
SAME_COMMANDS = set("""atom_modify boundary change_box clear compute_modify create_atoms create_box delete_atoms
dielectric dimension displace_atoms dump_modify echo fix_modify group if jump label lattice log mass minimize neigh_modify
neighbor newton next print processors read_data read_dump region replicate reset_timestep restart run set shell
thermo thermo_modify thermo_style timestep uncompute undump unfix units variable velocity write_data write_dump
write_restart quit info""".split())
PLAIN_COMMANDS = set("""delete_atoms echo jump log next print quit reset_timestep run shell thermo timestep variable velocity
write_data write_dump write_restart""".split())    # the same in both, where they stand in if and run
SPINS = ("omegax", "omegay", "omegaz")
ATOM_VECTORS = set("fx fy fz id mass mol q type vx vy vz x y z".split())    # of variables in both
GONE_THERMO = {"cu", "erotate", "numbond", "dragtotal"}
SET_WORDS = {**dict.fromkeys("charge density diameter mass mol type vx vy vz x y z".split(), 1), "image": 3, "omega": 3,
             "type/fraction": 3,
             "omegax": 1, "omegay": 1, "omegaz": 1}


class Same:
    """Commands that both programs have."""

    @staticmethod
    def only_balances(w):
        return w[:1] == ["fix"] and w[3:4] == ["balance"] and len(w) == 8

    @staticmethod
    def balance(w):
        """fix ID group balance N dimensions iterations threshold, which moves no grain."""
        n, dims, iterations, threshold = w[4:8]
        return f"fix             {w[1]} {w[2]} balance {n} {threshold} shift {dims} {iterations} {threshold}"

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
