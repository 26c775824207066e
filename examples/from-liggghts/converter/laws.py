# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Contact laws: property/global, the words after model."""
import functools
import math

from .errors import Left
from .geometry import short


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
        self.other_units = script.other_units
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
        if e != 1:
            self.check_units("the restitution is not what the dashpots of LIGGGHTS return")
        return -math.log(e) / math.hypot(math.log(e), math.pi)

    def check_units(self, what):
        """Dashpots of LIGGGHTS are a part of the critical one only where force is mass times acceleration."""
        if self.other_units:
            raise Left(f"units {self.other_units}, in which {what}", "units si, cgs, micro, nano or lj")

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

# Properties of the rolling models, in the order of the words of LSDCD.
ROLLING = {"cdt": ["coefficientRollingFriction"], "epsd2": ["coefficientRollingFriction"],
           "epsd": ["coefficientRollingFriction", "coefficientRollingViscousDamping"],
           "epsd3": ["coefficientRollingFriction", "coefficientRollingViscousDamping", "rollingStiffness"]}
# Normal models of contacts that yield, each with what is the same here, and what is not (LIGGGHTS 3.8).
YIELDING = ("hooke/hysteresis", "edinburgh")
BRIDGES = ("easo/capillary/viscous", "washino/capillary/viscous")


class Model:
    """The words after model, in pair_style gran and fix wall/gran. Their order is fixed, and a model without its word is
    off, as in contact_models.cpp of LIGGGHTS 3.8; LIGGGHTS-PFM has no_history."""
    ORDER = {"model": "normal", "tangential": "tangential", "cohesion": "cohesion", "rolling_friction": "rolling",
             "surface": "surface"}
    # Settings that are off without their word, but for tangential_damping, and limitForce of edinburgh and luding. Those that are not handled may be off.
    HANDLED = ("tangential_damping", "limitForce", "ktToKnUser", "absolute_damping", "fixKc")
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
        if self.normal in ("edinburgh", "luding"):
            self.on.add("limitForce")

    def settings(self, words, of):
        """The words at the end."""
        while words:
            w, value = words.pop(0), words.pop(0) if words else None
            if w in (*self.ORDER, "mesh", "primitive", "n_meshes", "meshes", "shear"):
                raise Left(f"the keyword {w} of {of}, which LIGGGHTS refuses at this place", "its order: " + ", ".join(self.ORDER) +
                           (", the words of the wall" if of == "wall/gran" else "") + ", settings as limitForce on")
            if w not in self.HANDLED + self.OTHERS or value not in ("on", "off"):
                raise Left(f"the keyword {w} of {of}", "see fix_wall_lsdcd.rst and the manual of LAMMPS")
            (self.on.add if value == "on" else self.on.discard)(w)
        for w in (x for x in self.OTHERS if x in self.on):
            raise Left(f"the keyword {w} of {of}", "see fix_wall_lsdcd.rst and the manual of LAMMPS")

    @property
    def limit(self):
        return "limitForce" in self.on

    @property
    def yields(self):
        return self.normal in YIELDING

    @property
    def is_granular(self):
        """Whether its law is one of granular, with the friction of LIGGGHTS."""
        return self.normal == "hertz" or self.yields

    @property
    def has_one_size(self):
        """Whether its stiffness is that of one radius and mass."""
        return self.normal == "hooke" or self.yields

    @property
    def damped(self):
        return "tangential_damping" in self.on

    def check(self):
        if self.surface != "default":
            raise Left(f"surface {self.surface}", "spheres only")
        if self.normal == "luding":
            raise Left("model luding, which keeps its slope along the adhesive branch, so that its force jumps where it turns",
                       "granular lepa k1 eta kp kc phi, whose slope follows: k1 is LoadingStiffness, kp and kc its parts, phi coefficientPlasticityDepth "
                       "at a mesh and half of it between grains")
        if self.normal not in ("hooke", "hertz", "hooke/stiffness", "hertz/stiffness", *YIELDING):
            raise Left(f"model {self.normal or 'off'}", "hooke or hertz, hooke/hysteresis or edinburgh; others are not there")
        if self.tangential not in ("history", "no_history", None):
            raise Left(f"tangential {self.tangential}", "history or no_history")
        if "absolute_damping" in self.on:
            raise Left("absolute_damping", "write the damping over the mass of a grain as gamman")

    def friction(self, c):
        """Without a tangential model there is none."""
        return c.friction() if self.tangential else 0.0

    @property
    def extra(self):
        """Whether it has rolling friction or cohesion, which LAMMPS's own styles do not have."""
        return bool(self.rolling or self.cohesion)

    def extras(self, c):
        """Words of rolling friction and cohesion."""
        words = ""
        if self.rolling:
            if self.rolling not in ROLLING:
                raise Left(f"rolling_friction {self.rolling}", "cdt, epsd2, epsd or epsd3")
            viscous = "coefficientRollingViscousDamping"
            if viscous in ROLLING[self.rolling] and c.get(viscous, c.i, c.j) != 0:
                c.check_units(f"{viscous} is not the part of the critical dashpot")
            words += f" rolling {self.rolling} " + " ".join(short(c.get(name, c.i, c.j)) for name in ROLLING[self.rolling])
        if self.cohesion:
            if self.cohesion in BRIDGES:
                raise Left(f"cohesion {self.cohesion}, whose bridge has another formula, a viscous force and liquid that flows, and at a mesh a second "
                           "grain in place of the plane", "cohesion capillary gamma theta NULL V, a bridge of constant volume")
            if self.cohesion != "sjkr":
                raise Left(f"cohesion {self.cohesion}", "sjkr, or granular jkr or dmt")
            words += f" cohesion sjkr {short(c.get('cohesionEnergyDensity', c.i, c.j))}"
        return words

    def dissipates(self, c):
        """Whether a contact has a dashpot."""
        if "stiffness" in self.normal:
            return any(c.get(name, c.i, c.j) != 0 for name in ("gamman", "gammat"))
        return c.beta() > 0

    def drags(self, c):
        """Whether a contact has a dashpot across its normal."""
        return c.get("gammat", c.i, c.j) > 0 if "stiffness" in self.normal else c.beta() > 0

    def drop_zeros(self, contacts):
        """Takes out rolling friction and cohesion whose coefficients are 0 in all contacts: they have no torque, no force. Where one has
        some, each needs its words, as a law of a mesh without them has those of the wall."""
        if self.rolling in ROLLING and not any(c.get("coefficientRollingFriction", c.i, c.j) for c in contacts):
            self.rolling = None
        if self.cohesion in ("sjkr", "sjkr2") and not any(c.get("cohesionEnergyDensity", c.i, c.j) for c in contacts):
            self.cohesion = None
        # LAMMPS's rolling with a spring is the nearest to these, on its own walls.
        self.nearest = self.rolling in ("cdt", "epsd2") and self.normal == "hertz" and not self.cohesion

    @staticmethod
    def nearest_rolling(c):
        """The rolling of LAMMPS with the limit mu R F of cdt and epsd2, and the spring of epsd2 at an overlap of 0.1 % of the radius."""
        k = short(float(f"{8 * c.elastic()[1] * c.radius * math.sqrt(1e-3):.3g}")) if c.radius else "K"
        return f" rolling sds {k} 0 {short(c.get('coefficientRollingFriction', c.i, c.j))}"

    def left_plane(self, c, nearest=""):
        """A Left for rolling friction or cohesion of LAMMPS's own wall."""
        why = "rolling friction or cohesion of a plane or cylinder, of which LAMMPS's own wall has others"
        do = "a mesh of it: lsdcd generate plane or cylinder"
        if nearest:
            do = "the lines with #: below are the nearest" + ", with a number for K" * (c.radius is None) + "; or " + do
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

    def has_limit(self, c):
        """Whether friction or rolling ends at a part of the normal force."""
        return self.friction(c) > 0 or self.rolling in ("epsd", "epsd2", "epsd3")

    def hysteresis(self, c, r, m, pair):
        """The normal sub-model for hooke/hysteresis, and the stiffness of its friction."""
        kn, damping = c.hooke(r, m)
        steepest, pull, depth = (c.get(f"coefficient{name}", c.i, c.j) for name in ("MaxElasticStiffness", "AdhesionStiffness", "PlasticityDepth"))
        # With the reduced radius of two grains the depth counts twice here.
        words = f"lepa {short(kn)} {short(damping * m)} {short(kn * steepest)} {short(kn * pull)} {short(depth / 2 if pair else depth)}"
        if pull > 0 and self.has_limit(c):
            raise Left("model hooke/hysteresis with a coefficientAdhesionStiffness above 0 and friction, whose limit is mu times the force there, and "
                       "here times the force and the pull of the adhesive branch", f"granular {words} where that is meant")
        return words, short(kn)

    def edinburgh(self, c, r, pair):
        """The normal sub-model for edinburgh without adhesion, which has none at meshes, and the stiffness of its friction."""
        y, g = c.elastic()
        n, e = c.get("overlapExponent"), c.get("coefficientRestitution", c.i, c.j)
        pull_off, surface = c.get("pullOffForce", c.i, c.j), c.get("surfaceEnergy", c.i, c.j)
        lam = 1 - 1 / c.get("UnloadingStiffness", c.i, c.j)
        k1 = 2 * y * r if n == 1 else 4 / 3 * y * math.sqrt(r)
        surface = surface if pair else 0.0
        chi = c.get("adhesionExponent") if surface else n
        words = f"eepa {short(k1)} {short(e)} {short(lam)} {short(surface)} {short(n)} {short(chi)} {short(pull_off)}"
        why = ""
        if "fixKc" in self.on:
            why = "fixKc, by which the adhesive slope is a part of the stiffness"
        elif n not in (1, 1.5):
            why = f"an overlapExponent of {short(n)}, which is 1 or 1.5 here"
        elif surface > 0:
            why = "surfaceEnergy between grains: where a contact reloads from the adhesive branch it computes the slope of that anew, which stays here"
        elif e < 1 and n == 1.5:
            why = "a coefficientRestitution below 1 and overlapExponent 1.5, where its dashpot has the units of a linear spring"
        elif e < 1 and pull_off == 0 and self.limit:
            why = "limitForce, which is on without the word: with a coefficientRestitution below 1 it cuts the pull of the dashpot, which eepa keeps"
        elif pull_off != 0 and self.has_limit(c):
            why = "pullOffForce and friction, whose limit is mu times the force there, and here times the force less the pull-off force"
        elif self.rolling not in (None, "epsd2") and n == 1.5:
            why = "rolling friction and overlapExponent 1.5, where that takes the stiffness of a power of the overlap for one of the overlap"
        if why:
            raise Left(f"model edinburgh with {why}", f"granular {words} where that is meant")
        return words, short(2 * y if n == 1 else 8 * g)

    def yielding(self, c, r, m, pair):
        """Words of a law whose contacts yield."""
        if self.cohesion:
            raise Left(f"cohesion {self.cohesion} beside model {self.normal}", "one of both")
        if self.normal == "hooke/hysteresis":
            normal, kt = self.hysteresis(c, r, m, pair)
            damping, spring = "velocity", "linear_history_liggghts"
        else:
            normal, kt = self.edinburgh(c, r, pair)
            damping, spring = "coeff_restitution", "mindlin_liggghts"
        share = "1" if self.damped and self.tangential else "0"
        if self.tangential == "history":
            tangential = f"{spring} {kt} {share}"
        else:
            tangential = f"linear_nohistory_liggghts {share}" if self.tangential else "linear_nohistory 0"
        return f"granular {normal} damping {damping} tangential {tangential} {short(self.friction(c))}" + self.extras(c)

    def law(self, c, r, m, pair=False):
        """Words of a law of LSDCD, which begin with a classic style, or with granular. `r`, `m`: effective radius and mass."""
        self.check()
        if self.yields:
            return self.yielding(c, r, m, pair)
        if self.normal != "hertz":
            style, numbers = self.classic(c, r, m)
            return f"{style} {numbers}" + " limit_damping" * self.limit + self.extras(c)
        _, _, _, share, mu = self.hertz(c)
        e, nu = c.one_material()
        if self.tangential == "history":
            tangential = f"mindlin_liggghts NULL {'NULL' if share else '0'}"
        else:
            tangential = f"linear_nohistory_liggghts {short(share)}" if self.tangential else "linear_nohistory 0"
        if self.rolling == "epsd2" and self.tangential != "history":
            if self.tangential:
                raise Left("rolling_friction epsd2, whose stiffness is that of tangential history, with no_history", "tangential history, or epsd")
            tangential = "mindlin_liggghts NULL 0"    # without friction, as mu is 0
        return (f"granular hertz/material {short(e)} {short(c.get('coefficientRestitution', c.i, c.j))} {short(nu)} "
                f"damping coeff_restitution tangential {tangential} {short(mu)}" + " limit_damping" * self.limit + self.extras(c))

    def granular(self, c):
        """The words of LAMMPS's own wall, which has other moduli in 29Sep2021."""
        k, kt, damping, share, mu = self.hertz(c)
        e = tsuji(damping)
        if e is None:
            raise Left("a restitution below 0.115", "damping coeff_restitution, from LAMMPS 4Feb2025 on")
        tangential = f"mindlin {short(kt)}" if self.tangential == "history" else "linear_nohistory"
        return (f"hertz {short(k)} {short(e)} tangential {tangential} {short(share)} {short(mu)} damping tsuji" +
                " limit_damping" * self.limit + (self.nearest_rolling(c) if self.nearest else ""))
