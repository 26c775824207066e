# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Validation cases: what a case is, the walls that it runs at, the rows that it gives, and scripts with grains.

A case is a function of a Setting, which yields for one wall what it saw beside what is expected. run_case() calls it once for each wall and
joins what they saw in rows. validate.py prints these rows and keeps them, and test_validation.py states them as facts.
"""

import csv
import dataclasses
import io
import math
import pathlib

import lmp
import stl

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
DATA = ROOT / "doc" / "data"
CURVES = DATA / "validation_curves_cpu.csv"
BED_CURVES = DATA / "validation_minutes_curves_cpu.csv"
# How long cases take, or that they need LAMMPS of 2Aug2023 or later; and where their rows are kept.
SECONDS, MINUTES, HOST = "seconds", "minutes", "host"
KEPT = {SECONDS: DATA / "validation_cpu.tsv", MINUTES: DATA / "validation_minutes_cpu.tsv", HOST: DATA / "validation_host_cpu.tsv"}

# LAMMPS's own flat wall, or its own law between grains; two triangles; 1600 slivers. Between grains, the second has pair_style granular/lsdcd.
PLANE, TWO, SLIVERS = "LAMMPS", "two", "slivers"
AT_WALLS = (PLANE, TWO, SLIVERS)
AT_MESHES = (TWO, SLIVERS)
BETWEEN_GRAINS = (PLANE, TWO)
ONLY_OURS = (TWO,)

G = 9.81


# ---- cases and rows ----------------------------------------------------------------------

@dataclasses.dataclass
class Seen:
    """What a case saw at one wall. The tolerance is relative to the expected number, or absolute where `absolute` says so."""
    quantity: str
    unit: str
    seen: float
    expected: float
    source: str
    tolerance: float
    reason: str
    absolute: bool = False


@dataclasses.dataclass
class Point:
    """A point of a curve that a case saw, for a picture of the page."""
    curve: str
    x: float
    value: float


@dataclasses.dataclass
class Row:
    """What all walls of a case saw of a quantity; one of the page's table."""
    case: str
    quantity: str
    unit: str
    expected: float
    source: str
    seen: dict
    tolerance: float
    reason: str
    absolute: bool

    def deviation(self, wall):
        apart = abs(self.seen[wall] - self.expected)
        return apart if self.absolute else apart / abs(self.expected)

    def largest_deviation(self):
        return max(self.deviation(wall) for wall in self.seen)

    def holds(self):
        """Whether all walls are within the tolerance; a number that is none is not."""
        return all(self.deviation(wall) <= self.tolerance for wall in self.seen)

    def same_at_both_cuts(self):
        """Whether both meshes gave the same bits, where both were run. Beds grow round-off, and need not where a case does not say so."""
        return not CASES[self.case].same_bits or TWO not in self.seen or SLIVERS not in self.seen or self.seen[TWO] == self.seen[SLIVERS]


@dataclasses.dataclass
class Case:
    name: str
    title: str
    walls: tuple
    takes: str    # SECONDS, MINUTES or HOST
    function: object
    same_bits: bool    # whether both cuts of a mesh have to give the same bits

    def runs_here(self):
        """Whether this LAMMPS has what the case needs."""
        return self.takes != HOST or lmp.version() >= 20230802


CASES = {}


def case(name, title, walls=AT_WALLS, takes=SECONDS, same_bits=None):
    """Decorates the function of a case, and lists it. Without `same_bits` those of a bed may differ."""
    def listed(function):
        CASES[name] = Case(name, title, walls, takes, function, takes != MINUTES if same_bits is None else same_bits)
        return function
    return listed


def run_case(name, folder, only=None, points=None):
    """The rows of a case, whose files go to the folder. `only`: a wall, where the others are left out. The list `points` gets the Points of each
    curve at the first wall that is run."""
    write_floors(folder)
    rows, curves = {}, {}
    for wall in reversed(CASES[name].walls if only is None else [only]):    # a mesh has all quantities, LAMMPS's own wall not all
        for s in CASES[name].function(Setting(wall, folder)):
            if isinstance(s, Point):
                curves.setdefault(s.curve, (wall, []))
                if curves[s.curve][0] == wall:
                    curves[s.curve][1].append(s)
                continue
            row = rows.setdefault(s.quantity, Row(name, s.quantity, s.unit, s.expected, s.source, {}, s.tolerance, s.reason, s.absolute))
            assert (row.expected, row.tolerance) == (s.expected, s.tolerance), f"{name}: {s.quantity} is expected to depend on the wall"
            row.seen[wall] = s.seen
    if points is not None:
        points += [point for _, its in curves.values() for point in its]
    return list(rows.values())


COLUMNS = ("case", "title", "quantity", "unit", "expected", *AT_WALLS, "deviation", "tolerance", "of", "holds", "source", "reason")


def as_table(rows):
    """Rows as doc/data/validation_cpu.tsv has them."""
    text = io.StringIO()
    writer = csv.writer(text, delimiter="\t", lineterminator="\n")
    writer.writerow(COLUMNS)
    for r in rows:
        writer.writerow([r.case, CASES[r.case].title, r.quantity, r.unit, f"{r.expected:.9g}", *[f"{r.seen[w]:.9g}" if w in r.seen else "" for w in AT_WALLS],
                         f"{r.largest_deviation():.2g}", f"{r.tolerance:.2g}", "absolute" if r.absolute else "relative",
                         "yes" if r.holds() else "no", r.source, r.reason])
    return text.getvalue()


def published(curve, source):
    """Points of a curve that others published, or of an experiment: sorted pairs of x and its value."""
    rows = csv.DictReader((DATA / "validation_published.csv").read_text().splitlines())
    return sorted((float(r["x"]), float(r["value"])) for r in rows if r["curve"] == curve and r["source"].startswith(source))


def kept_rows():
    """Those of the page's tables."""
    return [row for path in KEPT.values()
            for row in csv.DictReader((line for line in path.read_text().splitlines() if not line.startswith("#")), delimiter="\t")]


# ---- walls -------------------------------------------------------------------------------

def slivers(columns=400):
    """A square of half side 1 across z, cut into strips of irregular width with slanted sides. A vertex is at the origin."""
    def x(i, row):
        return 2 * (i + 0.35 * math.sin(7.0 * (i - columns // 2) * row)) / columns - 1

    def corner(i, row):
        return (x(i, row) if 0 < i < columns else 2.0 * i / columns - 1, (-1.0, 0.0, 1.0)[row - 1], 0.0)
    return [t for i in range(columns) for row in (1, 2)
            for t in stl.quad(corner(i, row), corner(i + 1, row), corner(i + 1, row + 1), corner(i, row + 1))]


def write_floors(folder):
    stl.write(folder / "two.stl", stl.square(1.0))
    stl.write(folder / "slivers.stl", slivers())


class Setting:
    """One wall of a case, and the folder of its files."""

    def __init__(self, wall, folder):
        self.wall, self.folder = wall, folder
        self.is_mesh = wall != PLANE

    def floor(self, law, half, more="", keywords=""):
        """Lines with a wall across z at 0, a square of this half side where it is a mesh. `more`: words of a mesh; `keywords`: of any wall."""
        if not self.is_mesh:
            return lmp.flat_walls(f"fix wall all wall/gran granular {law} zplane 0 NULL {keywords}")
        return f"fix wall all wall/lsdcd granular {law} mesh {self.wall}.stl scale {half!r} {keywords} {more}\n"

    def gravity(self, size=G, direction="0 0 -1"):
        return f"fix gravity all gravity{'/lsdcd' if self.is_mesh else ''} {size!r} vector {direction}\n"

    def pairs(self, law, cut):
        """Lines with a law between grains, LAMMPS's own or ours."""
        if not law:
            return f"pair_style zero {cut!r}\npair_coeff * *\n"
        if self.is_mesh:
            return f"pair_style granular/lsdcd\npair_coeff * * {law}\n"
        return lmp.flat_walls("pair_style granular") + f"pair_coeff * * {law}\n"    # with -sf kk granular is ours


# ---- scripts with grains -----------------------------------------------------------------

@dataclasses.dataclass
class Grain:
    x: tuple
    radius: float
    density: float
    v: tuple = (0.0, 0.0, 0.0)
    spin: tuple = (0.0, 0.0, 0.0)

    @property
    def mass(self):
        return 4 / 3 * math.pi * self.radius ** 3 * self.density


def words(numbers):
    return " ".join(repr(float(n)) for n in numbers)


# What a dump has of a grain, in this order.
STATE = ("x", "y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz", "fx", "fy", "fz")


def change(script):
    """Returns the script that is run; faults.py has another function in its place."""
    return script


def placed(grains, omega):
    """Lines that make grains; a spin is set by the words of `omega`."""
    made = ""
    for i, g in enumerate(grains, 1):
        made += (f"create_atoms 1 single {words(g.x)} units box\nset atom {i} diameter {2 * g.radius!r} density {g.density!r}\n"
                 f"set atom {i} {omega.format(*map(float, g.spin))}\ngroup one id {i}\nvelocity one set {words(g.v)} units box\ngroup one delete\n")
    return made


def states_of(folder):
    """What state.dump has: {step: [grain: {name of STATE: number}]}."""
    dump = lmp.read_dump(folder / "state.dump")
    return {step: [dict(zip(STATE, rows[i])) for i in sorted(rows)] for step, rows in dump.items()}


def fly(setting, grains, box, fixes, dt, steps, every=None, pair_law="", move="nve/sphere", columns=()):
    """Runs grains, which feel each other by `pair_law` only, for so many steps. Returns {step: [grain: {name of STATE: number}]}, for each `every` steps
    or the first and the last; with `columns`, also the last row of thermo output of these."""
    if not isinstance(setting, Setting):
        return setting.fly(grains, box, fixes, dt, steps, every or steps)
    cut = 2.5 * max(g.radius for g in grains)
    script = lmp.head(words(box), units="si") + placed(grains, "omega {0!r} {1!r} {2!r}") + setting.pairs(pair_law, cut) + f"""\
neighbor        {0.1 * cut!r} bin
neigh_modify    delay 0 every 1 check yes
fix             move all {move}
{fixes}
timestep        {dt!r}
dump            state all custom {every or steps} state.dump id {' '.join(STATE)}
dump_modify     state format float %.17g sort id
thermo_style    custom step {' '.join(columns)}
thermo_modify   format float %.17g norm no lost ignore
thermo          {steps}
run             {steps}
"""
    said = lmp.run_well(change(script), setting.folder)
    states = states_of(setting.folder)
    return (states, lmp.read_thermo(said)[-1][1:]) if columns else states


# ---- laws and closed forms that several cases share ----------------------------------------

def dashpot_for(e):
    """The dashpot with which a Hertz contact returns e, over sqrt(m F/d), d its overlap (Brilliantov et al. 1996)."""
    return -math.sqrt(5) * math.log(e) / math.sqrt(math.pi ** 2 + math.log(e) ** 2)


def returned_by(dashpot):
    """The restitution of such a dashpot: dashpot_for(), solved for e."""
    return math.exp(-math.pi * dashpot / math.sqrt(5 - dashpot ** 2))


def tsuji(e):
    """The polynomial of `damping tsuji` in LAMMPS's manual (Tsuji, Tanaka and Ishida 1992)."""
    return 1.2728 + e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))))


def word_of_lammps(e):
    """The number behind which LAMMPS's own `damping tsuji` returns e. LAMMPS multiplies the polynomial by sqrt(m F/d) with the mass m of
    the contact, where the paper has that of a sphere, so that 0.5 would return 0.62; 29Sep2021 has no other damping that takes a restitution."""
    low, high = 0.0, 1.0
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if tsuji(middle) > dashpot_for(e) else (low, middle)
    return middle


class Hertz:
    """An elastic impact at speed v: E of the contact, its radius and mass (Hertz 1882; Johnson 1985)."""

    def __init__(self, modulus, radius, mass, v):
        self.overlap = (15 * mass * v ** 2 / (16 * modulus * math.sqrt(radius))) ** 0.4
        self.force = 4 / 3 * modulus * math.sqrt(radius) * self.overlap ** 1.5
        # 4/5 sqrt(pi) Gamma(2/5)/Gamma(9/10)
        self.time = 0.8 * math.sqrt(math.pi) * math.gamma(0.4) / math.gamma(0.9) * self.overlap / v


def impulse(e):
    """The integral of |F| over an impact with dashpot_for(e), over m v: a damped contact pulls before it ends, so that this is more than
    1 + e. It depends on e alone, so that m, v and the stiffness are 1 here. The midpoint rule is right to 1e-6."""
    dashpot, x, v, push, dt = dashpot_for(e), 0.0, 1.0, 0.0, 1e-4
    while True:
        half = x + v * dt / 2
        force = max(half, 0) ** 1.5 + dashpot * max(half, 0) ** 0.25 * v
        middle = v - force * dt / 2
        force = max(half, 0) ** 1.5 + dashpot * max(half, 0) ** 0.25 * middle
        v -= force * dt
        x = half + v * dt / 2
        if x <= 0:
            return push
        push += abs(force) * dt


def cut_limit(e, steps):
    """How far the restitution of a damped Hertz impact may be off where touch and end fall anywhere in a step: the dashpot acts with overlaps of up to
    v dt, before and after, which changes a speed v by dashpot sqrt(5/4) (2.943/n)^(5/4) v; that at the end has e^(1/4). The elastic force is off by (2.943/n)^(5/2)/2."""
    if e == 1:
        return (2.943 / steps) ** 2.5 / 2
    return e * dashpot_for(e) * math.sqrt(1.25) * (1 + e ** 0.25) * (2.943 / steps) ** 1.25


def hertz_law(setting, young, nu, e=1.0, friction=0.0, pair=False, slides=False):
    """The law of Hertz and Mindlin, at a rigid wall or between two grains of the material. At a mesh, and between grains by our pair style, it is in the
    words of a material; LAMMPS takes a wall to be of the grain's material, so that a rigid one has twice its modulus. In LAMMPS's own styles it is in
    numbers: 29Sep2021 computes those of a wall from a material with another modulus (doc/other-walls.md). `slides`: friction at its limit."""
    if not isinstance(setting, Setting):
        return dict(young=young, nu=nu, e=e, friction=friction)
    stiff = 1 if pair else 2
    if setting.is_mesh:
        normal, kt = f"hertz/material {stiff * young!r} {0.0 if e == 1 else e!r} {nu!r}", "NULL"
    else:
        kn = 4 / 3 * stiff * young / (2 * (1 - nu ** 2))
        normal, kt = f"hertz {kn!r} {0.0 if e == 1 else word_of_lammps(e)!r}", repr(8 * stiff * young / (4 * (2 - nu) * (1 + nu)))
    tangential = "linear_nohistory 0.0 0.0"
    if friction:    # of the two that are at the limit in any slip, LAMMPS has the second one only
        tangential = (f"mindlin_slip {kt}" if setting.is_mesh else "linear_nohistory") + " 1.0" if slides else f"mindlin {kt} 1.0"
        tangential += f" {friction!r}"
    return f"{normal} tangential {tangential} damping {'velocity' if e == 1 else 'coeff_restitution' if setting.is_mesh else 'tsuji'}"
