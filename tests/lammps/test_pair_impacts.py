# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""compute lsdcd/impacts: impacts between grains against closed forms, and against the trajectories of a gas, which numpy reads."""

import csv
import itertools
import math

import numpy as np
import pytest

import lmp
from facts import at_most, fact
from test_names import rows_of

HITS = "compute hits all lsdcd/impacts {least} {words}\n"
SHOWN = """\
thermo_style    custom step c_hits[1] c_hits[2] {columns}
thermo_modify   format float %.17g norm no
thermo          1000000
"""


def spectrum(path):
    with open(path, encoding="utf-8") as file:
        lines = list(csv.reader(file))
    fact("the first line names the columns", lines[0] == "type_i type_j energy_from energy_to impacts energy energy_i energy_j".split(), lines[0])
    return [[float(word) for word in line] for line in lines[1:]]


# ---- few grains --------------------------------------------------------------------------

TWO = """\
create_atoms    1 single {a} units box
create_atoms    2 single {b} units box
set             group all diameter 1.0
set             type 1 mass 1
set             type 2 mass 3
group           one id 1
group           two id 2
pair_style      granular/lsdcd
pair_coeff      * * {law}
neighbor        0.1 bin
neigh_modify    delay 0 every 1 check yes
timestep        {dt!r}
{move}
"""
HEADON = "fix move all nve/sphere\nvelocity one set 0.5 0 0\nvelocity two set -0.5 0 0"
HOOKE = "law hooke 1e4 NULL 30 NULL 0 0"
LAWS = (HOOKE, "law hooke/history 1e4 1e4 30 NULL 0.5 1", "hertz/material 1e5 0.5 0.3 tangential mindlin NULL 1 0.5 damping tsuji",
        "jkr 1e6 10 0.25 0.001 damping velocity tangential mindlin NULL 1 0.3")


def script_of(law=HOOKE, a="0 0 0", b="1.0103 0 0", move=HEADON, least=0.01, words="", dt=1e-3, columns="", units="lj", newton="off", types=2, scene=TWO):
    return lmp.head("-3 3 -3 3 -3 3", newton=newton, types=types, units=units) + scene.format(law=law, a=a, b=b, move=move, dt=dt) + \
        HITS.format(least=least, words=words) + SHOWN.format(columns=columns)


def two(folder, run="run 300", ranks=1, **of):
    """[number, energy, ...] at the end."""
    return lmp.read_thermo(lmp.run_well(script_of(**of) + run + "\n", folder, ranks))[-1][1:]


def test_head_on(folder):
    """Two grains of the masses 1 and 3 that meet at 1 along their line, wherever within a step, have one impact of 0.75/2; slower than the least speed
    none. They move freely before, so that the speed is exact."""
    for law in LAWS:
        for b in ("1.01 0 0", "1.0103 0 0", "1.0107 0 0"):
            n, energy = two(folder, law=law, b=b)
            fact(f"{law}, {b}: one impact", n == 1, n)
            at_most(f"{law}, {b}: energy", abs(energy - 0.375), 1e-12)
        fact(f"{law}: not faster than the least speed", two(folder, law=law, least=1.0001)[0] == 0)


def test_no_impact(folder):
    """Grains that were put into overlap, that lie on each other through two runs, and that something pushes into each other."""
    rest = "fix move all nve/sphere"
    jump = "variable dx equal -0.03*(step>50)\nvariable vx equal -0.5\nfix hold one move linear 0 0 0 units box\nfix push two move variable v_dx NULL NULL v_vx NULL NULL"
    for law in LAWS[:2]:
        fact(f"{law}: put there", two(folder, "run 50\nrun 50", law=law, b="0.99 0 0", move=rest, least=1e-6)[0] == 0)
        fact(f"{law}: pushed", two(folder, "run 100", law=law, b="1.02 0 0", move=jump, least=1e-6)[0] == 0)
        fact(f"{law}: as deep as it comes by itself", two(folder, "run 100", law=law, b="1.0299 0 0", move=jump, least=1e-6, dt=1e-2)[0] == 1)


def test_units(folder):
    """The energy is LAMMPS's kinetic energy of the relative motion, also where a mass times the square of a velocity is no energy."""
    for units, mv2e in (("real", 48.88821291 ** 2), ("metal", 1.0364269e-4), ("si", 1)):
        dt = 0.01 * math.sqrt(mv2e / 1e4)
        move = f"fix move all nve/sphere\nvelocity two set {-1e-4 / dt!r} 0 0"
        out = lmp.run_well(script_of(law="law hooke 1e4 NULL 0 NULL 0 0", b="1.00005 0 0", move=move, least=1e-9, dt=dt, units=units, columns="ke") +
                           "run 150\n", folder)
        rows = lmp.read_thermo(out)
        at_most(f"{units}: a quarter of the energy of the grain that moves", abs(rows[-1][2] / (rows[0][3] / 4) - 1), 1e-7)    # mvv2e has 9 digits


THREE = TWO.replace("group           one id 1", "create_atoms 1 single {c} units box\nset atom 3 diameter 1.0 mass 1\ngroup still id 1 2\ngroup one id 1")


def test_beside_another(folder):
    """A grain that falls at 1 between two that touch nothing strikes one with c = cos(a), where a is the angle of their normals from its way, and the
    other one with what is left of c: c (1 - s cos(2 a)) with the share s of the first blow that the falling grain has, which is 1 beside grains of fix freeze,
    and 3/4 beside free ones of three times its mass."""
    for degrees in (35, 45, 60):
        s, high = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
        a = math.atan2(s, high - 7e-4)    # where it is after 11 steps
        c = math.cos(a)
        for beside in (0, 2e-3):    # it meets the second one at once, or some steps later
            places = {"a": f"{-s!r} 0 0", "b": f"{s!r} 0 0", "c": f"{beside!r} 0 {math.sqrt(1 - (s - beside) ** 2) + 0.0103!r}"}
            scene = THREE.replace("set             type 1 mass 1\nset             type 2 mass 3", "").replace("{c}", places["c"])
            for held in (True, False):
                hold = "fix hold still freeze\n" if held else ""
                move = f"set group still mass 3\ngroup falls id 3\nset group falls mass 1\nfix move {'falls' if held else 'all'} nve/sphere\n{hold}" + \
                    "velocity falls set 0 0 -1"
                n, energy = two(folder, "run 80", law="law hooke 30 NULL 0 NULL 0 0", a=places["a"], b=places["b"], move=move, scene=scene, least=1e-4)
                mass, share = (1, 1) if held else (0.75, 0.75)
                second = c * (1 - share * math.cos(2 * a))
                name = f"{degrees}, {beside}, {'held' if held else 'free'}"
                fact(f"{name}: two", n == 2, n)
                if beside == 0:
                    at_most(f"{name}: energy", abs(energy - mass / 2 * (c ** 2 + second ** 2)), 1e-9)
                else:    # it has turned a little, and the spring has slowed it
                    at_most(f"{name}: energy", abs(energy / (mass / 2 * (c ** 2 + second ** 2)) - 1), 0.02)


def test_shares(folder):
    """Of the energy of an impact the softer grain takes the share of the other one's stiffness in the sum; equal ones take half."""
    coeff = "pair_coeff 1 1 law hooke 1e4 NULL 0 NULL 0 0\npair_coeff 2 2 law hooke 9e4 NULL 0 NULL 0 0\n"
    scene = TWO.replace("pair_coeff      * * {law}\n", coeff)
    found = two(folder, scene=scene, words="impact_spectrum s_*.csv every 100",
                columns=" ".join(f"c_hits[{row}][{k}]" for row in (1, 2, 3) for k in range(1, 7)))
    rows = [found[2 + 6 * k:8 + 6 * k] for k in range(3)]
    fact("rows are pairs of types", [row[:2] for row in rows] == [[1, 1], [1, 2], [2, 2]] and rows[1][2] == 1 and not any(rows[0][2:] + rows[2][2:]), rows)
    at_most("shares", abs(rows[1][3] - 0.375) + abs(rows[1][4] - 0.9 * 0.375) + abs(rows[1][5] - 0.1 * 0.375), 1e-12)
    of_file = spectrum(folder / "s_300.csv")
    fact("the file has its row", len(of_file) == 1 and of_file[0][:2] == [1, 2] and of_file[0][2] <= 0.375 < of_file[0][3] and of_file[0][4] == 1, of_file)
    at_most("and its energies", max(abs(x - y) for x, y in zip(of_file[0][5:], rows[1][3:])), 1e-12)
    unlike = coeff.replace("2 2 law hooke 9e4", "2 2 law hertz/history 9e4") + "pair_coeff 1 2 law hooke 1e4 NULL 0 NULL 0 0\n"
    found = two(folder, scene=TWO.replace("pair_coeff      * * {law}\n", unlike), columns="c_hits[2][4] c_hits[2][5]")
    fact("of two models each takes half", found[3] == found[2] / 2, found)


def test_names(folder):
    """Those of the page."""
    pairs = [(f"all_{name}", f"c_hits[{at}]") for at, name in rows_of("compute_lsdcd_impacts", "1, impacts,")[:2]]
    columns = " ".join(f"v_{name} {element}" for name, element in pairs)
    found = two(folder, words="names all all", columns=columns)[2:]
    fact("each is the element of the page", len(found) == 4 and found[0] == found[1] > 0 and found[2] == found[3] > 0, found)


def test_refusals(folder):
    """What it does not serve is an error with a reason."""
    script = script_of() + "run 1\n"
    for change, word in ((("all lsdcd/impacts", "one lsdcd/impacts"), "of all atoms"), (("lsdcd/impacts 0.01", "lsdcd/impacts"), "V is missing"),
                         (("lsdcd/impacts 0.01", "lsdcd/impacts 0"), "V"), (("lsdcd/impacts 0.01", "lsdcd/impacts 0.01 spectrum"), "'spectrum' is not expected"),
                         (("lsdcd/impacts 0.01", "lsdcd/impacts 0.01 impact_spectrum a.txt every 5"), "must end in .csv"),
                         (("lsdcd/impacts 0.01", "lsdcd/impacts 0.01 impact_spectrum none/a.csv every 5"), "make the folder"),
                         (("run 1", "compute more all lsdcd/impacts 1\nrun 1"), "only one is allowed"),
                         ((f"pair_style      granular/lsdcd\npair_coeff      * * {HOOKE}", "pair_style zero 1.2\npair_coeff * *"), "pair_style granular/lsdcd"),
                         (("run 1", "run_style respa 2 2 pair 1\nrun 1"), "run_style verlet")):
        fact(f"{change} is in the script", change[0] in script)
        lmp.refused(change[1], script.replace(*change), folder, word)


def test_file_of_another(folder):
    """A wall that would replace the spectrum is refused."""
    lmp.flat_floor(folder)
    wall = "fix w all wall/lsdcd hooke 1e4 NULL 0 NULL 0 0 mesh floor.stl impacts 0.1 impact_spectrum {} every 10\n"
    script = script_of(words="impact_spectrum s_*.csv every 10")
    lmp.refused("the same name", script + wall.format("s_*.csv") + "run 1\n", folder, "that compute hits writes")
    lmp.run_well(script + wall.format("w_*.csv") + "run 1\n", folder)


# ---- a gas -------------------------------------------------------------------------------

SIDE, SPACING, DT = 6, 1.15, 5e-4
GAS = """\
lattice         sc {spacing}
create_atoms    1 box
set             group all type/fraction 2 0.4 5
set             group all type/fraction 3 0.2 7
set             type 1 diameter 1.0 mass 1
set             type 2 diameter 0.8 mass 0.5
set             type 3 diameter 1.1 mass 2
velocity        all create 1.0 3487 loop geom
pair_style      granular/lsdcd
pair_coeff      * * {law}
neighbor        0.2 bin
neigh_modify    delay 0 every 1 check yes
timestep        {dt!r}
fix             move all nve/sphere
"""
RADIUS, MASS = np.array([0, 0.5, 0.4, 0.55]), np.array([0, 1, 0.5, 2])
LEAST = 0.4
SPRINGS = "law hooke/history 1e4 5e3 0 0 0.3 0"
BARE = "law hooke 1e4 NULL 0 NULL 0 0"


def gas(law, side=SIDE, newton="off", more="", words="impact_spectrum s.csv every {n}", n=400):
    box = side * SPACING
    head = lmp.head(f"0 {box} 0 {box} 0 {box}", boundary="p p p", newton=newton, types=3)
    pairs = itertools.combinations_with_replacement((1, 2, 3), 2)
    columns = " ".join(f"c_hits[{k}][3] c_hits[{k}][4]" for k, _ in enumerate(pairs, 1))
    return head + GAS.format(spacing=1 / SPACING ** 3, law=law, dt=DT) + HITS.format(least=LEAST, words=words.format(n=n)) + \
        SHOWN.format(columns=columns) + more


def frames(path, n):
    """Types and unwrapped places of each step of a dump of n atoms."""
    with open(path, encoding="utf-8") as file:
        while file.readline():
            for _ in range(8):
                file.readline()
            rows = np.array(" ".join(itertools.islice(file, n)).split(), float).reshape(n, 5)
            rows = rows[np.argsort(rows[:, 0])]
            yield rows[:, 1].astype(int), rows[:, 2:]


def struck(path, n, box):
    """{types: energies} of all impacts of a trajectory: each pair that overlaps and did not a step before, with speeds that are differences of
    places. Of a grain with several contacts those that were there before, and then the new ones, the fastest first, take from its velocity
    what a blow without rebound would."""
    found = {}
    touched, last, near = set(), None, None
    for step, (types, x) in enumerate(frames(path, n)):
        radius, mass = RADIUS[types], MASS[types]
        if step % 40 == 0:    # a grain of speed 6 moves by 0.12 until then
            d = x[:, None] - x[None]
            d -= box * np.round(d / box)
            i, j = np.nonzero(np.triu((d ** 2).sum(-1) < (radius[:, None] + radius[None] + 0.3) ** 2, 1))
            near = i, j
        i, j = near
        d = x[i] - x[j]
        d -= box * np.round(d / box)
        distance = np.sqrt((d ** 2).sum(-1))
        at = np.flatnonzero(distance < radius[i] + radius[j])
        touching = {(int(i[k]), int(j[k])): d[k] / distance[k] for k in at}
        new = {pair for pair in touching if pair not in touched and last is not None}
        if new:
            v = (x - last) / DT
            of_grain = {}
            for pair in touching:
                for grain in pair:
                    of_grain.setdefault(grain, []).append(pair)

            def approach(pair):
                return -float((v[pair[0]] - v[pair[1]]) @ touching[pair])

            def taken_at(grain, until):
                """What the other contacts of a grain take from its velocity before this one begins."""
                before = sorted(of_grain[grain], key=lambda pair: (pair in new, -approach(pair)))
                taken = np.zeros(3)
                for pair in before[:before.index(until)]:
                    n = touching[pair] if pair[0] == grain else -touching[pair]
                    other = pair[1] if pair[0] == grain else pair[0]
                    taken += mass[other] / (mass[grain] + mass[other]) * max(0, approach(pair) - float(taken @ n)) * n
                return taken
            for pair in new:
                a, b = pair
                left = approach(pair) - float((taken_at(a, pair) - taken_at(b, pair)) @ touching[pair])
                if approach(pair) > 0 and left > LEAST:
                    reduced = mass[a] * mass[b] / (mass[a] + mass[b])
                    found.setdefault(tuple(sorted((int(types[a]), int(types[b])))), []).append((reduced * left ** 2 / 2, len(of_grain[a]) + len(of_grain[b]) > 2))
        touched, last = set(touching), x
    return found


DUMP = "dump all all custom 1 gas.dump id type xu yu zu\ndump_modify all format float %.17g\n"


def compare(name, found, row, path):
    """Number and energy of each pair of types, and its bins, are those of these impacts."""
    pairs = list(itertools.combinations_with_replacement((1, 2, 3), 2))
    for k, types in enumerate(pairs):
        energies = [energy for energy, _ in found.get(types, [])]
        fact(f"{name}, types {types}: number", row[3 + 2 * k] == len(energies), (row[3 + 2 * k], len(energies)))
        at_most(f"{name}, types {types}: energy", abs(row[4 + 2 * k] - math.fsum(energies)) / max(math.fsum(energies), 1e-9), 1e-9)
    worst = 0
    rows = spectrum(path)
    for i, j, begin, end, n, energy, *_ in rows:
        inside = [e for e, _ in found.get((int(i), int(j)), []) if begin <= e < end]
        worst = max(worst, abs(n - len(inside)), abs(energy - math.fsum(inside)))
    at_most(f"{name}: each bin", worst, 1e-9)
    fact(f"{name}: all of them are in bins", sum(row[4] for row in rows) == sum(map(len, found.values())))


def test_gas(folder):
    """A dense gas of grains of three sizes, in which a quarter of all impacts are beside others: number, energy and bins of each pair of types are those that
    numpy finds in the trajectory, with springs and without, with newton off and on, and on 1, 2 and 4 processes, whose trajectories are the same to 1e-12."""
    for law in (SPRINGS, BARE):
        lmp.run_well(gas(law) + DUMP + "run 400\n", folder)
        found = struck(folder / "gas.dump", SIDE ** 3, SIDE * SPACING)
        many = [beside for of in found.values() for _, beside in of]
        fact(f"{law}: many impacts, of which some are beside others", len(many) > 100 and 0.1 < np.mean(many) < 0.6, (len(many), np.mean(many)))
        for newton, ranks in (("off", 1), ("off", 2), ("off", 4), ("on", 1), ("on", 4)):
            row = lmp.read_thermo(lmp.run_well(gas(law, newton=newton) + "run 400\n", folder, ranks))[-1]
            compare(f"{law}, newton {newton}, {ranks} processes", found, row, folder / "s.csv")


@pytest.mark.parametrize("newton, ranks", (("off", 1), ("off", 2), ("on", 4)))
def test_many(folder, newton, ranks):
    """1e4 impacts in such a gas."""
    side, n = 12, 4000
    row = lmp.read_thermo(lmp.run_well(gas(SPRINGS, side, newton, n=n) + DUMP + f"run {n}\n", folder, ranks))[-1]
    found = struck(folder / "gas.dump", side ** 3, side * SPACING)
    fact("1e4 impacts", sum(map(len, found.values())) >= 1e4, sum(map(len, found.values())))
    compare(f"newton {newton}, {ranks} processes", found, row, folder / "s.csv")


def same_spectra(name, one, other):
    fact(f"{name}: the same bins", [row[:5] for row in one] == [row[:5] for row in other], (one, other))
    at_most(f"{name}: energies", max(abs(a[5] - b[5]) for a, b in zip(one, other)), 1e-9)


def test_restart(folder):
    """A run in two parts, and one that goes on from a restart file on other processes, have the impacts of the run in one: contacts that last over the
    restart are not counted again, also where pairs keep nothing but that they touch. Another least speed begins anew."""
    for law in (SPRINGS, BARE):
        lmp.run_well(gas(law) + "run 400\n", folder)
        whole = spectrum(folder / "s.csv")
        lmp.run_well(gas(law) + "run 200\nwrite_restart half.restart\nrun 200\n", folder, 2)
        same_spectra(f"{law}: two runs", spectrum(folder / "s.csv"), whole)
        script = gas(law)
        again = "atom_modify map array\nnewton off\nread_restart half.restart\ncomm_modify vel yes\n" + script[script.index("pair_style"):]
        for ranks in (1, 4):
            lmp.run_well(again + "run 200\n", folder, ranks)
            same_spectra(f"{law}: restarted on {ranks}", spectrum(folder / "s.csv"), whole)
    said = lmp.run_well(again.replace(f"impacts {LEAST}", "impacts 0.9") + "run 0\n", folder)
    fact("another speed is told", "they are counted anew" in said and lmp.read_thermo(said)[-1][1] == 0, said[-500:])


def test_moves_nothing(folder):
    """Impacts change no bit of a trajectory, nor does it change impacts that energy is booked."""
    moved = "write_dump all custom end.dump id x y z vx vy vz modify sort id format float %.17g\n"
    ends, spectra = [], []
    for law, of in itertools.product((SPRINGS, BARE), ("with", "without", "booked")):
        script = gas(law) + ("compute books all lsdcd/energy\n" if of == "booked" else "")
        if of == "without":
            script = script[:script.index("compute hits")]
        lmp.run_well(script + "run 200\n" + moved + "run 200\n", folder)
        ends.append((folder / "end.dump").read_bytes())
        spectra.append(spectrum(folder / "s.csv"))
    fact("the same places and velocities", ends[0] == ends[1] == ends[2] and ends[3] == ends[4] == ends[5])
    fact("the same impacts with books", spectra[0] == spectra[2] and spectra[3] == spectra[5])
