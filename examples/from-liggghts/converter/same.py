# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Commands that both programs have."""
import re

from .dumps import COLUMNS, OF_PICTURES
from .errors import Left
from .formulas import FUNCTIONS, VARIABLE, expand
from .forms import options, read
from .lines import commands_in, last_value

UNITS = "[units box|lattice]"
THERMO = """step|elapsed|elaplong|dt|time|cpu|tpcpu|spcpu|cpuremain|part|atoms|temp|press|pe|ke|etotal|enthalpy|vol|density|lx|ly|lz|xlo|xhi|ylo|yhi|zlo|zhi|
xy|xz|yz|xlat|ylat|zlat|fmax|fnorm|pxx|pyy|pzz|pxy|pxz|pyz|cella|cellb|cellc|cellalpha|cellbeta|cellgamma""".replace("\n", "")
GONE_THERMO = {"cu", "erotate", "numbond", "dragtotal"}
AVERAGES = "[ave one|running] [ave window COUNT] [start COUNT] [file FILE] [overwrite] [title1 TEXT] [title2 TEXT] [title3 TEXT]"
INPUTS = "(OUTPUT|VARIABLE|x|y|z|vx|vy|vz|fx|fy|fz)+"
# Words of the commands that both programs have, with the same meaning.
COMMANDS = {
    "atom_modify": "[map array|hash] [first NAME] [sort COUNT NUMBER]",
    "boundary": "SIDES SIDES SIDES",
    "change_box": f"NAME [x|y|z final|delta NUMBER NUMBER] [x|y|z scale NUMBER] [x|y|z volume] [xy|xz|yz final|delta NUMBER] [boundary SIDES SIDES SIDES] "
                  f"[ortho] [triclinic] [set] [remap] {UNITS}",
    "clear": "",
    "compute_modify": "NAME [extra COUNT] [dynamic YES]",
    "create_atoms": [f"COUNT box [basis COUNT COUNT] {UNITS}", f"COUNT region NAME [basis COUNT COUNT] {UNITS}",
                     f"COUNT single NUMBER NUMBER NUMBER [remap YES] {UNITS}", f"COUNT random COUNT COUNT NAME {UNITS}"],
    "create_box": "COUNT NAME",
    "delete_atoms": ["group|region NAME [compress YES] [mol YES]", "overlap NUMBER NAME NAME [compress YES] [mol YES]"],
    "dielectric": "NUMBER",
    "dimension": "3",
    "displace_atoms": [f"NAME move VALUE VALUE VALUE {UNITS}", f"NAME ramp x|y|z NUMBER NUMBER x|y|z NUMBER NUMBER {UNITS}",
                       f"NAME random NUMBER NUMBER NUMBER COUNT {UNITS}", f"NAME rotate NUMBER NUMBER NUMBER NUMBER NUMBER NUMBER NUMBER {UNITS}"],
    "echo": "none|screen|log|both",
    "fix_modify": "NAME [energy YES] [temp NAME] [press NAME]",
    "group": ["NAME region|union|intersect NAME+", "NAME subtract NAME NAME+", "NAME delete", "NAME type|id|molecule RANGE+",
              "NAME type|id|molecule <|>|<=|>=|==|!= COUNT", "NAME type|id|molecule <> COUNT COUNT"],
    "if": "TEXT then TEXT+",
    "jump": "FILE NAME?",
    "label": "NAME",
    "lattice": ["none NUMBER?", "sc|bcc|fcc|hcp|diamond|sq|sq2|hex|custom NUMBER [origin NUMBER NUMBER NUMBER] [orient x|y|z COUNT COUNT COUNT] [spacing NUMBER NUMBER NUMBER] "
                "[a1|a2|a3 NUMBER NUMBER NUMBER] [basis NUMBER NUMBER NUMBER]"],
    "log": "FILE append?",
    "mass": "TYPES NUMBER",
    "minimize": "NUMBER NUMBER COUNT COUNT",
    "neigh_modify": "[delay|every|page|one COUNT] [check|once YES] [binsize NUMBER] [include NAME] [exclude type COUNT COUNT] [exclude group NAME NAME] "
                    "[exclude molecule NAME] [exclude none]",
    "neighbor": "NUMBER nsq|bin|multi",
    "newton": "on|off (on|off)?",
    "next": "NAME+",
    "print": "TEXT [append|file FILE] [screen YES]",
    "processors": "GRID GRID GRID [map MAPPING] [grid onelevel|numa] [grid twolevel COUNT GRID GRID GRID] [grid custom FILE] "
                  "[part COUNT COUNT multiple] [file FILE]",
    "read_data": "FILE",
    "read_dump": "FILE COUNT (x|y|z|vx|vy|vz|q|ix|iy|iz|fx|fy|fz)+ [box|replace|purge|trim|scaled YES] [add YES] [label NAME NAME] [format native|xyz]",
    "read_restart": "FILE",
    "region": [f"NAME {shape} [side in|out] {UNITS} [move OR_NULL OR_NULL OR_NULL] [rotate VARIABLE NUMBER NUMBER NUMBER NUMBER NUMBER NUMBER]" for shape in (
        "block EDGE EDGE EDGE EDGE EDGE EDGE", "sphere NUMBER NUMBER NUMBER NUMBER", "cylinder x|y|z NUMBER NUMBER NUMBER EDGE EDGE",
        "cone x|y|z NUMBER NUMBER NUMBER NUMBER EDGE EDGE", "plane NUMBER NUMBER NUMBER NUMBER NUMBER NUMBER",
        "prism EDGE EDGE EDGE EDGE EDGE EDGE NUMBER NUMBER NUMBER", "union|intersect NAMES")] + ["NAME delete"],
    "replicate": "COUNT COUNT COUNT",
    "reset_timestep": "COUNT",
    "restart": "COUNT FILE? FILE?",
    "run": ["COUNT [upto] [start|stop COUNT] [pre|post YES]", "COUNT [upto] [start|stop COUNT] [pre|post YES] [every COUNT NULL|TEXT+]"],
    "set": "atom|type|group|region|mol NAME TEXT+",
    "shell": "TEXT+",
    "thermo": "COUNT|VARIABLE",
    "thermo_modify": "[lost ignore|warn|error] [norm|flush YES] [line one|multi] [format int|float|COUNT TEXT] [temp|press NAME]",
    "thermo_style": ["one|multi", f"custom ({THERMO}|{'|'.join(sorted(GONE_THERMO))}|OUTPUT)+"],
    "timestep": "NUMBER",
    "uncompute": "NAME", "undump": "NAME", "unfix": "NAME",
    "units": "si|cgs|lj|real|metal|electron|micro|nano",
    "variable": ["NAME delete", "NAME index|world|universe TEXT+", "NAME string TEXT", "NAME loop|uloop COUNT COUNT? pad?", "NAME getenv NAME", "NAME file|atomfile FILE", "NAME equal|atom TEXT"],
    "velocity": [f"NAME {style} [temp NAME] [sum|mom|rot YES] [dist uniform|gaussian] [loop all|local|geom] {UNITS}" for style in (
        "create NUMBER COUNT", "set OR_NULL OR_NULL OR_NULL", "scale NUMBER", "ramp vx|vy|vz NUMBER NUMBER x|y|z NUMBER NUMBER", "zero linear|angular")],
    "write_data": "FILE [pair ii|ij]",
    "write_dump": ["NAME atom|xyz FILE", f"NAME image FILE {OF_PICTURES}", f"NAME custom FILE ({'|'.join(sorted(COLUMNS))}|OUTPUT)+"],
    "write_restart": "FILE",
    "quit": "COUNT?",
    "info": "(system|computes|dumps|fixes|groups|regions|variables|time|all)*",
}
IN_SPACE = "[region NAME] [every COUNT] [energy VARIABLE]"
BOX_WORDS = "[x|y|z final|delta NUMBER NUMBER] [x|y|z|xy|xz|yz vel|erate|trate NUMBER] [x|y|z scale NUMBER] [x|y|z volume] [xy|xz|yz final|delta NUMBER] " \
            "[x|y|z|xy|xz|yz wiggle NUMBER NUMBER] [x|y|z|xy|xz|yz variable VARIABLE VARIABLE] [remap x|v|none] [flip YES]"
FIXES = {
    "adapt": "COUNT [atom diameter VARIABLE] [reset|scale YES]",
    "addforce": f"VALUE VALUE VALUE {IN_SPACE}",
    "ave/atom": f"COUNT COUNT COUNT {INPUTS}",
    "ave/correlate": "COUNT COUNT COUNT OUTPUT+ [type auto|upper|lower|auto/upper|auto/lower|full] [ave one|running] [start COUNT] [prefactor NUMBER] [file FILE] "
                     "[overwrite] [title1 TEXT] [title2 TEXT] [title3 TEXT]",
    "ave/histo": f"COUNT COUNT COUNT NUMBER NUMBER COUNT {INPUTS} [mode scalar|vector] [beyond ignore|end|extra] {AVERAGES}",
    "ave/time": f"COUNT COUNT COUNT OUTPUT+ [mode scalar|vector] [off COUNT] {AVERAGES}",
    "aveforce": "OR_NULL OR_NULL OR_NULL [region NAME]",
    "deform": f"COUNT {BOX_WORDS} {UNITS}",
    "drag": "OR_NULL OR_NULL OR_NULL NUMBER NUMBER",
    "dt/reset": f"COUNT OR_NULL OR_NULL NUMBER {UNITS}",
    "efield": "VALUE VALUE VALUE",
    "enforce2d": "",
    "external": ["pf/callback COUNT COUNT", "pf/array COUNT"],
    "freeze": "",
    "gravity": ["VALUE vector VALUE VALUE VALUE", "VALUE chute VALUE", "VALUE spherical VALUE VALUE"],
    "lineforce": "NUMBER NUMBER NUMBER",
    "momentum": "COUNT [linear 0|1 0|1 0|1] [angular]",
    "move": [f"linear OR_NULL OR_NULL OR_NULL {UNITS}", f"wiggle OR_NULL OR_NULL OR_NULL NUMBER {UNITS}",
             f"rotate NUMBER NUMBER NUMBER NUMBER NUMBER NUMBER NUMBER {UNITS}", f"variable OR_NULL OR_NULL OR_NULL OR_NULL OR_NULL OR_NULL {UNITS}"],
    "nve": "",
    "nve/limit": "NUMBER",
    "nve/noforce": "",
    "nve/sphere": "[update dipole]",
    "planeforce": "NUMBER NUMBER NUMBER",
    "print": "COUNT TEXT [append|file FILE] [screen YES] [title TEXT]",
    "rigid": [f"{bodies} [force TYPES on|off on|off on|off] [torque TYPES on|off on|off on|off]" for bodies in ("single", "molecule", "group NAMES")],
    "setforce": "OR_NULL OR_NULL OR_NULL [region NAME]",
    "spring": ["tether NUMBER OR_NULL OR_NULL OR_NULL NUMBER", "couple NAME NUMBER OR_NULL OR_NULL OR_NULL NUMBER"],
    "spring/self": "NUMBER (xyz|xy|xz|yz|x|y|z)?",
    "store/state": "COUNT (id|mol|type|mass|x|y|z|xs|ys|zs|xu|yu|zu|ix|iy|iz|vx|vy|vz|fx|fy|fz|q|radius|omegax|omegay|omegaz|tqx|tqy|tqz|OUTPUT)+ [com YES]",
    "viscous": "NUMBER [scale COUNT NUMBER]",
}
BALANCE = "COUNT DIMENSIONS COUNT NUMBER"
COMPUTES = {
    "centro/atom": "COUNT|fcc|bcc", "cluster/atom": "NUMBER", "cna/atom": "NUMBER", "com": "", "contact/atom": "", "coord/atom": "cutoff? NUMBER",
    "displace/atom": "", "erotate/sphere": "", "erotate/sphere/atom": "", "group/group": "NAME", "gyration": "", "ke": "", "ke/atom": "",
    "msd": "[com YES]", "pe": "", "pe/atom": "", "pressure": "NAME (ke|pair|bond|fix|virial)*",
    "property/atom": f"({'|'.join(sorted(COLUMNS - {'element'}))})+", "property/local": "(natom1|natom2|patom1|patom2|ntype1|ntype2|ptype1|ptype2|batom1|batom2|btype)+",
    "rdf": "COUNT (COUNT COUNT)*", "reduce": f"sum|min|max|ave {INPUTS} [replace COUNT COUNT]",
    "reduce/region": f"NAME sum|min|max|ave {INPUTS} [replace COUNT COUNT]", "stress/atom": "NULL? (ke|pair|bond|fix|virial)*", "temp": "",
}
PLAIN_COMMANDS = set("""delete_atoms echo jump log next print quit reset_timestep run shell thermo timestep variable velocity
write_data write_dump write_restart""".split())    # the same in both, where they stand in if and run
SPINS = ("omegax", "omegay", "omegaz")
ATOM_VECTORS = set("fx fy fz id mass mol q type vx vy vz x y z".split())    # of variables in both
SET_WORDS = {**dict.fromkeys("charge density diameter mass vx vy vz x y z".split(), "VALUE"), "type": "COUNT", "mol": "COUNT",
             "image": "COUNT|NULL COUNT|NULL COUNT|NULL", "omega": "VALUE VALUE VALUE", "type/fraction": "COUNT NUMBER COUNT",
             **dict.fromkeys(SPINS, "VALUE")}
# What a formula may have in both programs.
FORMULA_NAMES = {"PI", *FUNCTIONS, *"random normal ramp stagger logfreq stride vdisplace swiggle cwiggle".split(), *THERMO.split("|")}
OF_GROUPS = "count|mass|charge|xcm|vcm|fcm|bound|gyration|ke|angmom|torque|inertia|omega|sum|min|max|ave|trap|gmask|rmask|grmask|next"


def read_formula(text):
    """Raises Left for a name in a formula that LAMMPS does not have in the same sense."""
    rest = re.sub(rf"\b({OF_GROUPS})\([^()]*\)", "1", VARIABLE.sub("1", text.strip("\"'")))
    rest = re.sub(r"\b[fcv]_\w+", "1", rest)
    for name, bracket in re.findall(r"(?<![\w.])([A-Za-z_]\w*)(\[?)", rest):
        if not bracket and name not in FORMULA_NAMES and name not in ATOM_VECTORS | COLUMNS:
            raise Left(f"the word {name} of a formula", "what LAMMPS has in its place: the page of variable in its manual")


class Same:
    """Commands that both programs have."""

    @staticmethod
    def unread(line):
        """A Left where a word of a command that both programs have, or of one in it, is not one of both; None where each is read."""
        try:
            for k, words in enumerate(commands_in(line.words)):
                w = [expand(x, line.scope) for x in words]
                read(w[0], COMMANDS[w[0]], w[1:])
                if w[0] == "variable" and w[2] in ("equal", "atom"):
                    read_formula(w[3])
        except Left as left:
            return left
        return None

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
            self.check_time(line)
        elif w[0] in ("jump", "if", "label", "next", "minimize", "read_dump"):
            self.step = None
        elif w[0] == "unfix":
            self.alive.discard(w[1])
            self.end_wall(w[1])
        self.follow_box(line)
        if w[0] in ("read_data", "read_dump", "replicate"):
            self.make(None)
            self.densities.update({w[0]: None} if w[0] != "replicate" else {})
        elif w[0] == "create_atoms":
            bounds = [(self.known(x, line),) * 2 for x in w[3:6]] if w[2] == "single" and self.units == "box" else \
                (self.region(w[3]) or [None])[-1] if w[2] == "region" else None
            self.make(bounds)
            self.densities.pop("created", None)
            self.densities["created"] = "1"    # in both
        single = w[0] == "create_atoms" and w[2] == "single" and not line.loops and sum(x.words[:1] == w[:1] for x in self.lines) == 1
        if single or (w[0] == "read_data" and len(self.data_sizes[line]) == 1):
            self.count_energy(line)

    def check_time(self, line):
        """Raises Left for reset_timestep where a variable hangs on the time, which is the step times the timestep behind it in LIGGGHTS; in LAMMPS the
        time goes on."""
        named = {x.words[0] for x in self.lines if any(re.search(r"(?<![\w${])time\b", text) for text in x.words[3 if x.words[:1] == ["variable"] else 1:])}
        if "variable" in named:
            raise Left("reset_timestep of a script with time in a variable: it begins anew in LIGGGHTS, and goes on here", "step*dt in place of time")
        if "thermo_style" in named or "print" in named:
            self.note(line, "the time that is printed goes on, in LIGGGHTS it is the step times the timestep from here on")

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
        if w[:2] == ["compute_modify", "thermo_temp"] and not self.prints(r"\b(temp|press|p[xyz]{2})\b"):
            self.put(f"# {line.text.strip()}: ke does not hang on it in LIGGGHTS")
            self.count_energy(line)
            return
        if w[:2] == ["compute_modify", "thermo_temp"] or (w[0] == "thermo_modify" and last_value(w, "temp")):
            self.note_energy(line)
        if w[0] == "compute_modify":    # newer versions of LAMMPS know these names alone
            text = " ".join(f"{x}/dof" if k > 1 and x in ("extra", "dynamic") else x for k, x in enumerate(w))
        if w[0] == "compute" and w[3].startswith("reduce") and self.rows.keys() & set(re.findall(r"\bc_(\w+)\[", text)):
            self.note(line, "these are rows of contacts: newer versions of LAMMPS, as Debian 13's, want the words inputs local at the end")
        if line.words[0] == "thermo_style":
            for word in (x for x in w[2:] if x in GONE_THERMO or not self.is_here(x)):
                text = re.sub(rf"\s{re.escape(word)}(?=\s|$)", "", text)
                self.note(line, f"without {word}, which is not here")
        elif w[0] == "set":
            values = options(w[3:], SET_WORDS)
            if sum(1 + len(v) for v in values.values()) < len(w) - 3:
                text = " ".join(w[:3] + [x for key, v in values.items() for x in (key, *v)])    # without words that a later one replaces
            text = self.with_density(line, values, text)
            if values.keys() & SPINS and "omega" in values:
                raise Left("set of omega beside one of its components", "set ... omega with all three numbers")
            if values.keys() & SPINS:
                if not values.keys() >= set(SPINS) and (any(ran != self.ran for _, ran, _ in self.sources) or self.spun):
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
            if chosen == "group all" or (w[1] == "type" and not self.all_types and self.grain_types == {self.known(w[2], line)}):
                self.densities.clear()
            self.densities.pop(chosen, None)    # the last one is that of the last command
            kept = []
            density = self.carry(values["density"][0], line, kept)
            self.densities[chosen] = None if line.skips or kept else density
            if not self.all_types and all(f"type {kind}" in self.densities for kind in self.grain_types):
                self.densities.pop("created", None)
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

    def grow(self, line):
        """fix adapt N atom diameter v_NAME [scale|reset yes|no], which keeps the density in LIGGGHTS."""
        w = line.words
        ends = next((k for k, x in enumerate(w) if k > 4 and x in ("scale", "reset")), len(w))
        if last_value(w[ends:], "scale") == "yes":
            raise Left("scale yes of fix adapt, which is a factor of the diameter of each time in LIGGGHTS, and of the first one in LAMMPS",
                       "the diameter itself, as an equal-style variable")
        of_atoms = [x[2:] for x in w[7:ends:3] if any(y.words[:3] == ["variable", x[2:], "atom"] for y in self.lines)]
        if of_atoms:
            raise Left(f"the atom-style variable {of_atoms[-1]} of fix adapt, where LAMMPS has equal-style ones",
                       f"where all diameters grow by a factor F: variable k equal F^(1+floor(step/{w[4]})), and fix {w[1]} {w[2]} adapt {w[4]} "
                       "atom diameter v_k scale yes mass yes; a run that begins later takes F once more in LIGGGHTS")
        # LIGGGHTS resets no diameter at the end of a run.
        self.pass_on(line.but(" ".join(w[:ends] + ["mass yes"])))

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
        text = re.sub(r"\bc_(\w+)\[(\d+)\]", lambda m: self.row_column(m[1], int(m[2])) if m[1] in self.rows else m[0], text)
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
                                       f"compute property/atom {name} before it, and C_ID[...]")
                        self.put(f"compute         lsdcd_{name} all property/atom {name}")
                    self.computed.add(name)
                    text = re.sub(rf"(?<![\w$}}]){name}\[", f"C_lsdcd_{name}[", text)
            # Values of one atom have a capital letter, on which LAMMPS of 2025 insists.
            if line.words[2:3] == ["equal"]:
                text = re.sub(r"\b([cf])(_\w+)(?=\[)", lambda m: m[1].upper() + m[2] if m[0] in self.per_atom else m[0], text)
            for name in re.findall(r"(?<![\w$}])([a-z]\w*)\[", text):
                if name[:2] not in ("f_", "c_", "v_") and name not in ATOM_VECTORS:
                    raise Left(f"{name}[...] in a variable", "an atom-style variable, from what compute property/atom has")
        return text
