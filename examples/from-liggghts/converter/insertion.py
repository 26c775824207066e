# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""fix insert/pack, insert/rate/region, insert/stream."""
import math
import re

from .errors import Left
from .geometry import short
from .forms import options, pairs
from .lines import commands_in, is_yes

# Whether the numbers of a distribution are shares of the mass or of the number.
DISTRIBUTIONS = {"particledistribution/discrete": "mass", "particledistribution/discrete/massbased": "mass",
                 "particledistribution/discrete/numberbased": "poly"}


class Insertion:
    """fix insert/pack, insert/rate/region, insert/stream."""

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
            rest = options(w[3 + n:], {"units": "box|lattice", "side": "in|out"})
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
        found = [(t and t[:3], f) for t, f in found if f != 0]    # a class with the share 0 has no grains
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

    # The values of each word.
    INSERT = {"seed": "COUNT", "distributiontemplate": "NAME", "maxattempt": "COUNT", **dict.fromkeys(("insert_every", "every"), "once|COUNT"),
              "insert_every_time": "once|NUMBER", "start": "COUNT", "random_distribute": "exact|uncorrelated", "omega": "constant NUMBER NUMBER NUMBER",
              **dict.fromkeys("overlapcheck all_in verbose compress_tags".split(), "YES"), "ntry_mc": "COUNT",
              "vel": ["constant NUMBER NUMBER NUMBER", "uniform|gaussian NUMBER NUMBER NUMBER NUMBER NUMBER NUMBER"],
              "orientation": ["random|template", "constant NUMBER NUMBER NUMBER NUMBER"]}
    RATE = dict.fromkeys("nparticles mass massrate particlerate".split(), "INF|NUMBER")
    REGION = {"region": "NAME", "warn_region": "YES", "check_dist_from_subdomain_border": "YES"}
    INSERT_OF = {"pack": {**REGION, "particles_in_region": "NUMBER", "mass_in_region": "NUMBER", "volumefraction_region": "NUMBER"},
                 "rate/region": {**RATE, **REGION},
                 "stream": {**RATE, "insertion_face": "NAME", "extrude_length": "NUMBER", "duration": "COUNT", "duration_time": "NUMBER",
                            "parallel": "YES"}}

    def insert(self, line):
        w = line.words
        form = self.style(w).split("/", 1)[1]
        if form not in self.INSERT_OF:
            raise Left(w[3], "fix insert/lsdcd mesh FILE or region ID")
        known = {**self.INSERT, **self.INSERT_OF[form]}
        v = options(w[4:], known, (("insert_every", "every", "insert_every_time"), ("duration", "duration_time")))
        given = list(pairs(w[4:], known))
        apart, whole, in_box = (is_yes(v, *default) for default in (
            ("overlapcheck", "yes"), ("all_in", "no"), ("check_dist_from_subdomain_border", "yes")))
        v = {k: x[0] if len(x) == 1 else x for k, x in v.items()}
        every = v.get("insert_every", v.get("every", v.get("insert_every_time", "once")))
        if "duration_time" in v or v.get("duration", every) != every:
            raise Left("insert/stream with a duration shorter than insert_every, which comes in pulses",
                       "a fix insert/lsdcd and unfix for each pulse")
        if form == "pack" and every != "once":
            raise Left("insert/pack that fills up again and again", "fix insert/lsdcd with massrate or numberrate")
        if ("massrate" in v or "particlerate" in v) and self.new_timestep(line):
            raise Left(f"{w[3]} with a rate, and another timestep after a run: LIGGGHTS keeps the grains of a step, not of a time",
                       "fix insert/lsdcd for each part, with the rate that you mean")
        if any(key in ("nparticles", "mass") and value == ["INF"] for key, value in given):
            v.update(nparticles="INF", mass="INF")    # a number beside it, before or behind, has no effect
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
            # A constant behind uniform or gaussian is another mean, and the spread stays.
            drawn, *spread = next(([x[0], *x[4:]] for key, x in reversed(given) if key == "vel" and x[0] != "constant"), ["constant"])
            velocity = " vel " + " ".join(v["vel"][1:4])
            if spread:
                velocity += " jitter " + "gaussian " * (drawn == "gaussian") + " ".join(spread[:1] if len(set(spread)) == 1 else spread)
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
        # Fixes with one seed would draw the same numbers.
        first = v.get("seed", "1")
        seeds = [f" seed {first}" if "seed" in v else ""] + [f" seed {self.number(first, line) + k:.0f}" for k in range(1, len(kinds))]
        text = "\n".join(f"fix             {name} {w[2]} insert/lsdcd {place} {grains} {' '.join(parts)}{velocity}{seed}"
                         for (name, grains, parts), seed in zip(self.one_fix_each(line, w[1], kinds, amounts), seeds))
        if "start" in v and (self.step is None or self.known(v["start"], line) != self.step + 1):
            raise Left(f"start {v['start']}", f"end a run one step before that, and put after it: {text}")
        if there:
            text = self.less_what_is_there(line, w[1], v, len(kinds), amounts, text)
        self.sources.append((bounds, self.ran, "once" if form == "pack" else "on"))
        self.feeds[w[1]] = (line, len(self.sources) - 1)
        self.densities.update({f"fix {w[1]} {k}": kind[0].split()[-1] for k, kind in enumerate(kinds)})
        self.count_energy(line)
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

    def count_energy(self, line, more=0):
        """Makes ke right of a single grain, which has no degree of freedom by default, and while grains come. It does not depend on how
        many there are, while there are some; `more` makes up for those that a fix takes away. Temperatures and pressures do."""
        self.taken_away = max(self.taken_away, more)
        if not self.prints(r"\b(temp|press|p[xyz]{2})\b"):
            self.put(f"compute_modify  thermo_temp extra/dof {-self.taken_away} dynamic/dof yes")
            return
        if not any("thermo_temp" in other.words for other in self.lines):
            self.put("compute_modify  thermo_temp dynamic/dof yes")
        self.note_energy(line)

    def prints(self, form):
        """Whether a line of thermo_style or a variable has a text."""
        return any(re.search(form, other.text) for other in self.lines if other.words[:1] in (["thermo_style"], ["variable"]))

    def note_energy(self, line):
        """Says that ke may not be that of LIGGGHTS, which is of all grains, whatever a temperature counts."""
        if not self.noted_energy and self.prints(r"(?<![\w.])(ke|etotal)\b(?!\()"):
            self.noted_energy = True
            self.note(line, "ke is that of the grains and degrees of freedom of temp here, so 0 of a single grain, in LIGGGHTS that of all grains: "
                      "compute ID all ke has it")

    def make(self, bounds):
        """Grains that are made at once. A pack that stands before them and inserts after them counts them."""
        if any(feeds == "once" and ran == self.ran and not self.apart(other, bounds) for other, ran, feeds in self.sources):
            raise Left("grains that are made where an insert/pack before this line will count them", "this line before it")
        self.sources.append((bounds, self.ran, ""))
