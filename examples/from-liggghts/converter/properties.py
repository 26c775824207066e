# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Materials and grains: property/global, pair_style, what grains there are."""
import math
import re

from .errors import CannotConvert, Left
from .formulas import expand
from .laws import Contact, Model
from .forms import options
from .lines import last_value

# The same arrays in LIGGGHTS.
PROPERTY_KINDS = {"scalar": "scalar", **dict.fromkeys(("vector", "peratomtype", "atomtype"), "vector"),
                  **dict.fromkeys(("matrix", "peratomtypepair", "atomtypepair"), "matrix")}
# What models and fixes of LIGGGHTS-PUBLIC, -PFM and -INL read.
PROPERTY_NAMES = set("""abrasiveWearSeverity adhesionExponent artViscAlpha artViscBeta artViscEta attritionLimit betaConstant characteristicVelocity
coalescenceModelSettings coalescenceModelSwitches coeffFrictionStiffness coefficientAdhesionStiffness coefficientFriction
coefficientFrictionLubricated coefficientMaxElasticStiffness coefficientPlasticityDepth coefficientRestitution coefficientRestitutionLog
coefficientRollingFriction coefficientRollingViscousDamping coefficientYieldRatio coeffRollingStiffness cohesionDistanceSettings
cohesionEnergyDensity cohesionModelSwitches cohesionStrength contactAngle CriticalStokes equilibriumDist erosiveWearSeverity
fluidViscosity FluidViscosity forceLimit FrictionViscosity gamman gamman_abs gammat gammat_abs hamakerConstant historyIndex
initialCohesiveStress k_finnie kn kt lbVolumeFraction liquidDensity liquidVolume LoadingStiffness lubricationCutoff maxCohesiveStress
MaximumRestitution maxLiquidContent maxSeparationDistanceRatio minParticleDist minSeparationDistanceRatio morseConstant
normalDampingCoefficient overlapExponent poissonsRatio pullOffForce rollingStiffness roughnessAbsolute roughnessRelative sl speedOfSound
stiffnessRatio surfaceEnergy surfaceLiquidContentInitial surfaceRoughness surfaceTension switchModel tangentialMultiplier
tangentialStiffness tensCorrDeltaP tensCorrEpsilon thermalCapacity thermalConductivity thermalEmissivity UnloadingStiffness velocityLimit
youngsModulus youngsModulusOriginal""".split())
PROPERTY_FAMILIES = re.compile(r"\w+Bond(nonlinear)?|\w+PerUnitArea\w*|[a-z]+Custom|(tortuosity|porosity|pore_diameter|density|k0|Ea)_\w+")    # of bonds and reactions


class Properties:
    """Materials and grains: property/global, pair_style, what grains there are."""

    def property(self, line, name, *types):
        found = [d for d in self.properties.get(name, []) if d[0].stage == line.stage]
        if not found:
            text = f"needs fix property/global {name}, which the script does not have"
            raise Left(text, "its values in this script") if self.program.unread else CannotConvert(f"{self.at(line)}: {text}")
        before = [d for d in found if d[0].index < line.index][-1:]
        later = [d for d in found if d[0].index > line.index]
        where, w = (before + later)[0]
        self.sure(where, line)
        if w[0] is None:
            raise Left(f"{name} of {self.at(where)}, which is left", "one of its kinds: " + ", ".join(PROPERTY_KINDS))
        values = [[expand(x, d[0].scope) for x in d[1] if x] for d in [(where, w), *later]]
        if any(x != values[0] for x in values):
            raise Left(f"{name}, which changes in the script", "write the law of each stage yourself")
        kind, values = w[0], w[1:]
        if kind == "scalar":
            return self.number(values[0], where)
        if kind == "matrix":
            n, values = int(self.number(values[0], where)), values[1:]
            k = (types[0] - 1) * n + types[1] - 1
        else:
            k = types[0] - 1
        if k >= len(values):
            raise CannotConvert(f"{self.at(where)}: {name} has no value for the types {types}")
        return self.number(values[k], where)

    def read_property(self, line):
        """Raises Left where a fix property/global has a name, a kind or a number of values that LIGGGHTS does not."""
        name, kind, *values = line.words[4:]
        if name not in PROPERTY_NAMES and not PROPERTY_FAMILIES.fullmatch(name):
            raise Left(f"the property {name}", "a name that a model of LIGGGHTS reads")
        self.read(line, f"property {name}", f"{'|'.join(PROPERTY_KINDS)} NUMBER+", 5)
        columns = self.known(values[0], line)
        if (PROPERTY_KINDS[kind] == "scalar" and len(values) != 1) or (
                PROPERTY_KINDS[kind] == "matrix" and columns and len(values) != 1 + columns * columns):
            raise Left(f"{name} {kind} with {len(values)} numbers", "one number of a scalar; of pairs the number of types, and a number for each pair")

    def add_type(self, kind):
        """A type that grains may have; None where it is not known."""
        if kind is None:
            self.all_types = True
        else:
            self.grain_types.add(int(kind))

    def template(self, line):
        """Type, radius and density of a fix particletemplate/sphere; None where they are not known or not constant."""
        w = line.words
        try:
            v = options(w[5:], {"atom_type": "COUNT", "volume_limit": "NUMBER", "relative": "YES", **dict.fromkeys(
                ("radius", "density"), ["constant NUMBER", "uniform NUMBER NUMBER", "gaussian NUMBER NUMBER"])})
        except Left:
            v = {}
        size = [self.known(v[k][1], line) if v.get(k, [""])[0] == "constant" and v.get("relative", ["no"]) == ["no"] else None
                for k in ("radius", "density")]
        # A word that is not known may hide the type.
        kind = last_value(w[5:], "atom_type")
        return (1 if kind is None else self.known(kind, line)), *size

    def read_data(self, line):
        name = expand(line.words[1], line.scope)
        path = self.folder / name
        self.data_boxes[line], self.data_sizes[line] = {}, []
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
                self.data_sizes[line].append((float(w[2]) / 2, float(w[3])))
        self.sizes += self.data_sizes[line]

    def size(self, line, model):
        """Radius and mass of the grains, for a model whose stiffness depends on them; 1, 1 for another one."""
        if not model.has_one_size:
            return 1.0, 1.0
        what = f"model {model.normal}"
        if not self.sizes and self.missing_data:
            raise Left(f"{what} needs the size of a grain, and {self.missing_data[0]} is not beside the script",
                       "convert the script in the folder of that file, or give --radius and --density")
        if not self.sizes:
            raise Left(f"{what} needs the size of a grain, which this script does not tell", "give --radius and --density")
        masses = [4 / 3 * math.pi * s[0] ** 3 * s[1] if s else math.inf for s in self.sizes]
        if max(masses) > 1.001 * min(masses) or math.inf in masses:
            raise Left(f"{what} has a stiffness for each mass, and the grains differ",
                       "model hertz; or --radius and --density, the grain whose stiffness all shall have")
        return self.sizes[0][0], masses[0]

    def grains(self):
        """Types that grains may have: those that the script makes, or all that have a modulus."""
        if self.grain_types and not self.all_types:
            return sorted(self.grain_types)
        moduli = [len(w) - 1 for _, w in self.properties.get("youngsModulus", [])]
        return list(range(1, max(moduli, default=1) + 1))

    def pair_style(self, line):
        w = line.words
        if w[1] not in ("gran", "gran/omp"):
            raise Left(f"pair_style {' '.join(w[1:])}", "pair_style gran or granular of LAMMPS")
        model, kinds = Model(w[2:], self.options.pfm), self.grains()
        model.settings(model.rest, "pair_style")
        model.check()
        contacts = [Contact(self, line, i, j) for i in kinds for j in kinds]
        model.drop_zeros(contacts)
        self.note_friction(line, model, contacts, model.is_granular)
        self.pair = None
        pairs = [("*", "*", kinds[0], kinds[0])] + [(a, b, a, b) for a in kinds for b in kinds if a <= b and b != kinds[0]]
        r, m = self.size(line, model)
        if model.extra or model.is_granular:    # LAMMPS's granular slips at other arms, and stops at mu F with the dashpot
            laws = [(i, j, model.law(Contact(self, line, a, b), r / 2, m / 2, pair=True)) for i, j, a, b in pairs]
            self.put("pair_style      granular/lsdcd")
            self.pair = [f"pair_coeff      {i} {j} law {law}" for i, j, law in laws]
            return
        laws = {model.classic(Contact(self, line, i, j), r / 2, m / 2) for i in kinds for j in kinds}
        if len(laws) > 1:
            raise Left("model hooke for grains of several materials", "pair_style hybrid, or model hertz")
        style, numbers = laws.pop()
        self.put(f"pair_style      gran/{style} {numbers}" + " limit_damping" * model.limit)
        self.pair = ["pair_coeff      * *"]

    def note_friction(self, line, model, contacts, exact):
        """`exact`: the friction of LSDCD for LIGGGHTS stands here."""
        dashpot = model.tangential == "history" and model.damped and not exact
        if dashpot and not self.noted_dashpot and any(c.friction() > 0 and model.drags(c) for c in contacts):
            self.noted_dashpot = True
            self.note(line, "until the spring has reached mu F, LIGGGHTS adds the dashpot to it, here the sum ends at mu F: doc/from-liggghts.md, "
                      "Traps")
        if not model.tangential and "tangential" not in line.words and not self.noted:
            self.noted = True
            self.note(line, "without the keyword tangential LIGGGHTS 3.8 has no friction; LIGGGHTS-PFM has no_history: --pfm")
