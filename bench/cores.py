# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Where the time of a step goes on many cores, and what balancing brings: `./run bench cores --ranks 16`.

Silo (100 000 grains), drum (38 000 of two sizes) and impact (25 000 and a ball) of the benchmark of eight codes, a closed mill of 30 000
balls, and 27 000 grains of two sizes 10:1 that get new lists each 20 steps. Each is filled once, from a lattice, with a modulus that rises
to that of the benchmark, so that it takes a minute on 16 cores, not an hour; LSDCD and LIGGGHTS go on from the same places and velocities,
without springs. A run warms up and is then timed for about --seconds; its times are LAMMPS's own and the wall's, means over processes, in
ms a step.

*Largest over mean* of a time is that of the busiest process over the mean of all. *Weights* of fix balance: none, neigh, time, and *var*,
an atom-style variable 1 + a pairs + b contacts at the wall. Its a and b come from the times of one process: a touching pair takes a times
as long as all else of a grain does, and a contact at the wall b times.

--scripts-to DIR keeps fillings and rows there. Run again with it, the benchmark goes on where it ended: as after --budget SECONDS, which
begins no run that would end later, by what runs have taken so far.
"""
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import time

import rows
from lammps import Program, bench, loop_ms

G = 9.81
# So many times softer grains settle first, and in steps longer by the root of it. Springs of a stiffer law push grains apart that have
# settled with a softer one; the last of these do so within a few hundred steps.
SOFTER = (300, 43, 6.5, 1)
STIFFEN_STEPS = 500
LISTS = {"bin": ("bin", ""), "multi": ("multi", ""), "multi, all": ("multi", "mode multi ")}    # of neighbor, and of comm_modify
WEIGHTS = {"": "", "neigh": " weight neigh 0.8", "time": " weight time 0.8", "var": " weight var cost"}
REBALANCE = 200    # steps
FRICTION = "tangential mindlin_liggghts NULL NULL NULL"
# Of the mill, beside those of dosta.lsdcd.
BALL = """
material ball
  youngs_modulus     1e9    Pa
  poissons_ratio     0.2    1
  density            7800   kg/m3

pair ball ball
  restitution        0.6    1
  sliding_friction   0.4    1

pair ball steel
  restitution        0.6    1
  sliding_friction   0.4    1
"""


class Case:
    """A bed: its box, the commands that fill it, the materials of its atom types, of which the last is the wall's, its meshes and their
    places.

    grain_types: of so many types there are grains. lid: a mesh that closes it until it has settled. dt: timestep, s. settle, flow: s of the
    softest grains with the lid, and then without. turn: axis and period, s, of the meshes. skin: m. below: grains below this z are deleted.
    then: commands at the end. lists: a key of LISTS. neighbors: of neigh_modify."""

    def __init__(self, grains, box, fill, materials, meshes, dt, *, grain_types=1, lid="", settle=0.0, flow=0.0, turn=None, skin=5e-4,
                 below=None, then="", lists="bin", neighbors="every 1 delay 0 check yes"):
        self.grains, self.box, self.fill, self.materials, self.meshes, self.dt, self.lid = grains, box, fill, materials, meshes, dt, lid
        self.grain_types, self.settle, self.flow, self.turn, self.skin, self.below = grain_types, settle, flow, turn, skin, below
        self.then, self.lists, self.neighbors = then, lists, neighbors


LIP = -0.0554222
SPEED = "variable speed atom {0}*random(-1,1,1)\nvelocity all set v_speed v_speed v_speed\n"
TRIM = "group surplus id > {grains}\ndelete_atoms group surplus\ngroup surplus clear\n"


def wide_fill(grains, side):
    """Large grains of 20 mm on a lattice in a box of that side, and small ones of 2 mm on another around them: as much volume of each."""
    large, gap = max(4, round(grains / 1000)), 0.0226
    row = int((side - 0.001) / gap)
    middle = (row - 1) / 2
    at = [(gap * (k % row - middle), gap * (k // row % row - middle), 0.0125 + gap * (k // row**2)) for k in range(large)]
    top = 0.0012 + 1.4 * grains * 0.00225**3 / (side - 0.002)**2 + large * 0.011**3 * 4.2 / side**2
    balls = "".join(f"create_atoms 2 single {x:.6g} {y:.6g} {z:.6g} units box\n"
                    f"region ball{k} sphere {x:.6g} {y:.6g} {z:.6g} 0.0112 side out units box\n" for k, (x, y, z) in enumerate(at))
    half = side / 2 - 0.0012
    return f"""\
lattice sc 0.00225
{balls}
region within block {-half} {half} {-half} {half} 0.0012 {top} units box
region around intersect {large + 1} within {" ".join(f"ball{k}" for k in range(large))}
create_atoms 1 region around
{TRIM.format(grains=grains)}
set type 1 diameter 0.002 density 2500
set type 2 diameter 0.02 density 2500
displace_atoms all random 5e-5 5e-5 5e-5 1 units box
"""


def wide_side(share):
    return 0.1 * max(share, 0.2)**0.5    # m, of the box of the case


def cases(share):
    """All cases, with a share of the grains that they have."""
    n = {name: max(200, round(share * count)) for name, count in
         (("silo", 100000), ("small", 30000), ("large", 8000), ("impact", 25000), ("mill", 30000), ("wide", 27000))}
    side = wide_side(share)
    return {
        "silo": Case(n["silo"], "-0.101 0.101 -0.101 0.101 -0.2 0.33", f"""\
lattice sc 0.0043
region bin cylinder z 0 0 0.0975 0.022 0.325 units box
region cone cone z 0 0 0.03 0.0975 -0.045 0.021 units box
region fill union 2 bin cone
create_atoms 1 region fill
{TRIM.format(grains=n["silo"])}
set group all diameter 0.004 density 2500
displace_atoms all random 5e-5 5e-5 5e-5 1 units box
{SPEED.format(0.5)}""", ("m1", "steel"), {"silo_large.stl": f"move 0. 0. {LIP}"}, lid=f"plane.stl move 0. 0. {LIP}", dt=2.66e-6,
                     settle=0.22, flow=0.08, skin=1e-3, below=LIP - 0.02),
        "drum": Case(n["small"] + n["large"], "-0.101 0.101 -0.031 0.031 -0.101 0.101", f"""\
region drum cylinder y 0 0 0.0975 -0.0275 0.0275 units box
region shell cylinder y 0 0 0.0985 -0.0287 0.0287 units box
lattice sc 0.0043
create_atoms 2 region drum
{TRIM.format(grains=n["large"])}
variable top equal bound(all,zmax)+0.0032
region above block INF INF INF INF ${{top}} INF units box
region rest intersect 2 shell above
lattice sc 0.0022
create_atoms 1 region rest
{TRIM.format(grains=n["small"] + n["large"])}
set type 1 diameter 0.002 density 2500
set type 2 diameter 0.004 density 2000
displace_atoms all random 5e-5 5e-5 5e-5 1 units box
{SPEED.format(0.1)}""", ("m1", "m2", "steel"), {"drum.stl": "move 0. -0.03 0."}, dt=1.59e-6, grain_types=2, settle=0.12,
                     flow=0.2, turn=("0. -1. 0.", math.pi)),
        "impact": Case(n["impact"] + 1, "-0.051 0.051 -0.031 0.031 -0.092 0.312", f"""\
lattice custom 0.001 a1 2.4 0 0 a2 0 2.3 0 a3 0 0 2.2 basis 0 0 0 origin 0.5 0 0.5
region fill block -0.048 0.048 -0.029 0.029 -0.0889 {-0.0889 + (n["impact"] + 1500) * 2.2e-6} units box
create_atoms 1 region fill
{TRIM.format(grains=n["impact"])}
set group all diameter 0.002 density 2500
displace_atoms all random 5e-5 5e-5 5e-5 1 units box
{SPEED.format(0.5)}""", ("m1", "steel"), {"box.stl": "move -0.05 -0.03 -0.0902431"}, dt=1.04e-6, grain_types=2, settle=0.12,
                       lists="multi, all", then="""\
variable top equal bound(all,zmax)+0.0112
create_atoms 2 single 0 0 ${top} units box
set type 2 diameter 0.02 density 7200
group ball type 2
velocity ball set 0 0 -5
run 2500
"""),
        "mill": Case(n["mill"], "-0.16 0.16 -0.01 0.07 -0.16 0.16", f"""\
lattice sc 0.0042
region inside cylinder y 0 0 0.125 0.003 0.057 units box
create_atoms 1 region inside
{TRIM.format(grains=n["mill"])}
set group all diameter 0.0038 density 7800
displace_atoms all random 1e-4 1e-4 1e-4 1 units box
""", ("ball", "steel"), {"mill.stl": ""}, dt=4e-6, flow=0.45, turn=("0. 1. 0.", 1.2), skin=1e-3),
        "wide": Case(n["wide"], f"{-side / 2 - 0.004} {side / 2 + 0.004} {-side / 2 - 0.004} {side / 2 + 0.004} -0.004 0.3",
                     wide_fill(n["wide"], side), ("m1", "m1", "steel"), {"wide.stl": f"move {-side / 2} {-side / 2} 0."}, dt=1.5e-6,
                     grain_types=2, settle=0.12, lists="multi, all", neighbors="every 20 delay 0 check no"),
    }


def write_meshes(folder, lsdcd, share):
    """The walls of the cases, and their materials, softer and softer."""
    side = wide_side(share)
    subprocess.run([sys.executable, rows.ROOT / "examples/benchmark/make_walls.py", "--out", folder, "--lsdcd", lsdcd], check=True)
    for name, words in (("mill.stl", "drum --radius 0.15 --length 0.06 --lifters 8 --height 0.02 --thickness 0.015 --closed"),
                        ("wide.stl", f"box --width {side} --depth {side} --height 0.3")):
        subprocess.run([lsdcd, "generate", *words.split(), "-o", folder / name], check=True, stdout=subprocess.DEVNULL)


# ---- decks ---------------------------------------------------------------------------------

def write_materials(folder):
    """dosta.lsdcd with the mill's balls: law_1.lsdcd, and softer ones."""
    text = (rows.ROOT / "examples/benchmark/dosta.lsdcd").read_text() + BALL
    for softer in SOFTER:
        (folder / f"law_{softer}.lsdcd").write_text(
            re.sub(r"(youngs_modulus\s+)(\S+)", lambda m: f"{m.group(1)}{float(m.group(2)) / softer:.9g}", text))


def numbers(folder):
    """Moduli by material, and restitution and friction by pair, of law_1.lsdcd."""
    found, block = {}, None
    for words in map(str.split, (folder / "law_1.lsdcd").read_text().splitlines()):
        if words and words[0] in ("material", "pair"):
            block = found.setdefault(frozenset(words[1:]), {})
        elif block is not None and len(words) == 3:
            block[words[0]] = float(words[1])
    return found


def head(case, processors="", lists="bin", tiled=False):
    return (f"units si\natom_style sphere\nnewton off\nneighbor {case.skin} {LISTS[lists][0]}\ncomm_modify {LISTS[lists][1]}vel yes\n" +
            "boundary f f f\n" + (f"processors {processors}\n" if processors else "") + "comm_style tiled\n" * tiled)


def forces(case, softer=1, lid=False, contacts=False):
    """Laws, lists, gravity and wall of a deck of LAMMPS."""
    law, n = f"law_{softer}.lsdcd", len(case.materials)
    text = "pair_style granular/lsdcd\n"
    for i in range(n):
        for j in range(i, n):
            on = "" if i == j else f" on {case.materials[j]}"
            text += f"pair_coeff {i + 1} {j + 1} law material {law} {case.materials[i]}{on} {FRICTION}\n"
    first = case.materials[0]
    of_types = "".join(f" types {k + 1} {m}" for k, m in enumerate(case.materials[:case.grain_types]) if m != first)
    turn = f" motion rotate 0. 0. 0. {case.turn[0]} {case.turn[1]:.12g}" if case.turn else ""
    meshes = "".join(f" mesh {mesh} {place}{turn}" for mesh, place in case.meshes.items()) + f" mesh {case.lid}" * bool(lid and case.lid)
    return (text + f"neigh_modify {case.neighbors}\ntimestep {case.dt * softer**0.5:.6g}\n"
            f"fix fall all gravity/lsdcd {G} vector 0 0 -1\nfix move all nve/sphere\n"
            f"fix wall all wall/lsdcd granular material {law} {first}{of_types} on {case.materials[-1]} {FRICTION}{meshes}" +
            " contacts" * contacts + "\n" +
            (f"fix below all massflow/lsdcd mesh plane.stl rotate 1 0 0 180 move 0 0 {case.below} delete yes\n" if case.below else "") +
            "thermo_style custom step atoms ke\nthermo_modify norm no lost warn\nthermo 100000000\n")


FORGET = "unfix fall\nunfix move\nunfix wall\n"


def filling(case, name):
    """Writes NAME.data."""
    forget = FORGET + "unfix below\n" * bool(case.below)
    text = head(case, lists=case.lists) + f"region box block {case.box}\ncreate_box {len(case.materials)} box\n" + case.fill
    text += f"fix even all balance {REBALANCE} 1.1 shift xyz 20 1.02\n"
    soft = case.dt * SOFTER[0]**0.5
    for seconds, lid in ((case.settle, True), (case.flow, False)):
        if seconds > 0:
            text += forces(case, SOFTER[0], lid) + f"run {math.ceil(seconds / soft)}\n" + forget
    for softer in SOFTER[1:]:
        text += forces(case, softer, lid=case.flow == 0) + f"run {STIFFEN_STEPS}\n" + (forget if softer != 1 else "")
    # delete_atoms counts atoms anew: write_data names those that were there at first, also where a soft grain has left the box.
    return text + case.then + f"group lost empty\ndelete_atoms group lost\nwrite_data {name}.data nocoeff\n"


def balance_words(balance, weight, ab):
    """Commands of fix balance, and of the weight by a variable."""
    if not balance:
        return ""
    how = "rcb" if balance == "rcb" else f"{balance} 20 1.02"
    cost = ""
    if weight == "var":
        cost = f"compute touch all contact/atom\nvariable cost atom 1+{ab[0] / 2:.4g}*c_touch+{ab[1]:.4g}*f_wall[1]\n"
    return f"{cost}fix even all balance {REBALANCE} 1.05 {how}{WEIGHTS[weight]}\n"


def ours(case, name, item, warm, steps, ab):
    count = "compute touch all contact/atom\ncompute touching all reduce sum c_touch\nthermo_style custom step atoms c_touching f_wall[7]\n"
    return (head(case, item.processors, item.lists, item.balance == "rcb") + f"read_data {name}.data\n" +
            forces(case, contacts=item.weight == "var") + balance_words(item.balance, item.weight, ab) +
            count * (item.ranks == 1) + f"run {warm}\nrun {steps}\n")


def theirs(case, name, item, warm, steps, folder):
    """A deck of LIGGGHTS, which has no fix balance."""
    table, n = numbers(folder), case.materials
    each = " ".join(f"{table[frozenset([m])]['youngs_modulus']:.9g}" for m in n)

    def of_pairs(what):
        return " ".join(f"{table[frozenset([a, b])][what]:.9g}" for a in n for b in n)

    mesh = [f"fix mesh{k} all mesh/surface file text_{file} type {len(n)} {place}" for k, (file, place) in enumerate(case.meshes.items())]
    names = " ".join(f"mesh{k}" for k in range(len(mesh)))
    turn = [f"fix turn{k} all move/mesh mesh mesh{k} rotate origin 0. 0. 0. axis {case.turn[0]} period {case.turn[1]:.12g}"
            for k in range(len(mesh)) if case.turn]
    return "\n".join([
        "units si", "atom_style granular", "atom_modify map array", "newton off", "communicate single vel yes", "boundary f f f",
        f"processors {item.processors}" if item.processors else "", f"read_data {name}.data", f"neighbor {case.skin} bin",
        "neigh_modify every 1 delay 0 check yes", f"timestep {case.dt}", "hard_particles yes",
        f"fix m1 all property/global youngsModulus peratomtype {each}",
        f"fix m2 all property/global poissonsRatio peratomtype {' '.join(['0.2'] * len(n))}",
        f"fix m3 all property/global coefficientRestitution peratomtypepair {len(n)} {of_pairs('restitution')}",
        f"fix m4 all property/global coefficientFriction peratomtypepair {len(n)} {of_pairs('sliding_friction')}",
        "pair_style gran model hertz tangential history", "pair_coeff * *", f"fix fall all gravity {G} vector 0 0 -1", *mesh, *turn,
        f"fix wall all wall/gran model hertz tangential history mesh n_meshes {len(mesh)} meshes {names}", "fix move all nve/sphere",
        "modify_timing on", "thermo 100000000", f"run {warm}", f"run {steps}", ""])


def text_mesh(path):
    """text_NAME.stl beside a binary NAME.stl: LIGGGHTS takes some binary files for text, by their numbers."""
    data = path.read_bytes()
    with open(path.with_name(f"text_{path.name}"), "w") as out:
        out.write("solid mesh\n")
        for k in range(int.from_bytes(data[80:84], "little")):
            corners = struct.unpack_from("<9f", data, 84 + 50 * k + 12)
            out.write("facet normal 0 0 0\nouter loop\n" +
                      "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*corners[i:i + 3]) for i in (0, 3, 6)) + "endloop\nendfacet\n")
        out.write("endsolid mesh\n")


# ---- what is measured ------------------------------------------------------------------------

class Item:
    """A run: who goes first has the lowest rank in turn."""

    def __init__(self, turn, case, program, ranks, threads=1, processors="", balance="", weight="", lists="bin"):
        self.turn, self.case, self.program, self.ranks, self.threads = turn, case, program, ranks, threads
        self.processors, self.balance, self.weight, self.lists = processors, balance, weight, lists

    def order(self):
        """What is tried, as its row names it."""
        words = [f"processors {self.processors}"] * bool(self.processors) + [f"fix balance {self.balance or 'none'}"]
        words += [f"weight {self.weight}"] * bool(self.weight) + [f"lists {self.lists}"] * (self.lists != "bin")
        words += [f"{self.threads} threads"] * (self.threads > 1)
        return ", ".join(words)


# Of each bed: shapes of the grid of processes, and the balance that is good there, as its grains lie; tried with each number of processes.
GRIDS = {"silo": ("* * 1", "* * 2"), "drum": ("* 1 *", "* * 1"), "impact": ("* * 1", "* * 2"), "mill": ("* 1 *", "* * 1")}
BEST = "shift xyz"


def items(options, known):
    """All runs, in turn: first what each bed takes with the most processes, in both programs, then how it grows, then the rest."""
    most, made = max(options.ranks), []
    for name in options.cases:
        lists = known[name].lists
        if name == "wide":
            for ranks in sorted({1, most}):
                even = {"balance": BEST, "weight": "neigh"} if ranks > 1 else {}
                made += [Item(1, name, "lsdcd", ranks, lists=each, **even) for each in LISTS]
            continue
        made += [Item(0, name, "lsdcd", most, lists=lists), Item(0, name, "lsdcd", most, balance=BEST, weight="neigh", lists=lists),
                 Item(0, name, "LIGGGHTS", most)]
        for ranks in options.ranks:
            made.append(Item(1 if ranks == 1 else 3, name, "lsdcd", ranks, lists=lists))
            if 1 < ranks < most:
                made.append(Item(3, name, "lsdcd", ranks, balance=BEST, weight="neigh", lists=lists))
        made += [Item(2, name, "lsdcd", most, balance=BEST, weight=weight, lists=lists) for weight in ("", "time", "var")]
        made += [Item(2, name, "lsdcd", most, balance=f"shift {axis}", weight="neigh", lists=lists) for axis in "xyz"]
        made.append(Item(2, name, "lsdcd", most, balance="rcb", weight="neigh", lists="bin"))
        for grid in GRIDS[name]:
            made += [Item(2, name, "lsdcd", most, processors=grid, lists=lists), Item(2, name, "LIGGGHTS", most, processors=grid),
                     Item(2, name, "lsdcd", most, processors=grid, balance="shift " + free_axes(grid), weight="neigh", lists=lists)]
        made += [Item(4, name, "lsdcd", most // n, threads=n, balance=BEST * (most > n), weight="neigh" * (most > n), lists=lists)
                 for n in (2, 4) if most % n == 0]
        if known[name].lists != "bin":
            made.append(Item(4, name, "lsdcd", most, balance=BEST, weight="neigh"))
    unique = {(i.case, i.program, i.ranks, i.order()): i for i in sorted(made, key=lambda i: i.turn, reverse=True)}
    return sorted(unique.values(), key=lambda i: i.turn)


def free_axes(grid):
    return "".join(axis for axis, n in zip("xyz", grid.split()) if n != "1")


# ---- times -----------------------------------------------------------------------------------

def sections(part, steps):
    """LAMMPS's table of a run: mean ms a step by section, and largest over mean."""
    lines = re.findall(r"^(?:Pair|Neigh|Comm|Output|Modify|Other) +\|.*", part, re.M)
    found = [[word.strip() for word in line.split("|")][:4] for line in lines]
    mean = {name: float(avg) for name, _, avg, _ in found}
    over = {name: float(most) / float(avg) for name, _, avg, most in found if most and float(avg) > 0}
    return {name: 1e3 * value / steps for name, value in mean.items()}, over


def wall_times(part, steps):
    """The wall's table: mean ms a step by section, and largest over mean."""
    table = re.search(r"timing breakdown of the wall.*\n.*\n.*\n((?:  \w+ *\|.*\n)+)", part)
    cells = [[word.strip() for word in line.split("|")] for line in table.group(1).splitlines()] if table else []
    return {c[0]: 1e3 * float(c[2]) / steps for c in cells}, {c[0]: float(c[3]) / float(c[2]) for c in cells if float(c[2]) > 0}


def times_of(output, item, steps):
    """Facts of the row of a run, and its ms a step."""
    part = output.split("Loop time of")[-1]
    before, facts = output.split("Loop time of")[-2], {}
    ms = loop_ms(output)[-1]
    if item.program == "lsdcd":
        mean, over = sections(part, steps)
        wall, wall_over = wall_times(part if "breakdown of the wall" in part else before, steps)
        facts.update({name.lower(): f"{value:.4g}" for name, value in mean.items()})
        facts.update({f"wall_{name.lower()}": f"{value:.4g}" for name, value in wall.items()})
        if "Pair" in over:
            facts["pair_over_mean"] = f"{over['Pair']:.3f}"
        if "Forces" in wall_over:
            facts["wall_over_mean"] = f"{wall_over['Forces']:.3f}"
    else:
        for name, key in (("Pair", "pair"), ("Neigh", "neigh"), ("Comm", "comm"), ("Other", "other"), ("Modify", "modify")):
            found = re.search(rf"^{name} +time \(%\) = (\S+)", part, re.M)
            if found:
                facts[key] = f"{1e3 * float(found.group(1)) / steps:.4g}"
        fixes = [float(t) for t in re.findall(r"^Fix (?:\S*mesh\S*|wall|turn\S*) \S+ time \(%\) = (\S+)", part, re.M)]
        facts["wall_forces"] = f"{1e3 * sum(fixes) / steps:.4g}"
    grains = re.search(r"^Nlocal: +(\S+) ave +(\S+) max", part, re.M)
    if grains:
        facts["grains_over_mean"] = f"{float(grains.group(2)) / float(grains.group(1)):.3f}"
    builds = re.search(r"^Neighbor list builds = (\d+)", part, re.M)
    facts["steps_a_list"] = f"{steps / max(1, int(builds.group(1))):.3g}" if builds else ""
    grid = re.search(r"(\d+) by (\d+) by (\d+) MPI processor grid", output)
    if grid:
        facts["grid"] = "x".join(grid.groups())
    return ms, {name: value for name, value in facts.items() if value != ""}


def fitted(output, facts, grains):
    """How many times as long as the rest of a grain a touching pair and a contact at the wall take, of a run of one process."""
    at = re.findall(r"^ *\d+ +\d+ +(\S+) +(\S+) *$", output, re.M)
    pairs, contacts = float(at[-1][0]) / 2, float(at[-1][1])
    pair, wall = float(facts["pair"]), float(facts.get("wall_forces", 0))
    rest = (sum(float(facts.get(k, 0)) for k in ("neigh", "comm", "modify", "other")) - wall) / grains
    return (pair / pairs / rest if pairs else 0.0, wall / contacts / rest if contacts else 0.0)


class Kept:
    """Rows in a file of the work folder, by which a benchmark goes on."""

    def __init__(self, folder):
        self.path = folder / "rows.csv"
        self.rows = rows.parse(self.path.read_text()) if self.path.exists() else []

    def add(self, row):
        self.rows.append(row)
        part = self.path.with_name("rows.part")
        part.write_text(rows.as_csv(self.rows))
        os.replace(part, self.path)

    def find(self, case, order, ranks):
        return next((r for r in self.rows if (r["case"], r["order"], rows.facts(r)["ranks"]) == (case, order, str(ranks))), None)


def triangles_of(folder, case):
    return sum(int.from_bytes((folder / mesh).read_bytes()[80:84], "little") for mesh in case.meshes)


def measure(options, folder):
    began = time.monotonic()
    known, kept = cases(options.share), Kept(folder)
    ours_path, liggghts = os.path.abspath(options.lmp), shutil.which(options.liggghts)
    if not liggghts:
        rows.say(f"there is no {options.liggghts} (Debian package liggghts): LSDCD alone is measured")
    write_materials(folder)
    if not (folder / "wide.stl").exists():
        write_meshes(folder, os.path.join(os.path.dirname(ours_path), "lsdcd"), options.share)
        for mesh in folder.glob("[!t]*.stl"):
            text_mesh(mesh)
    most, took = max(options.ranks), {}

    def so_far():
        return time.monotonic() - began

    def left():
        return options.budget - so_far()

    def program(item):
        path = liggghts if item.program == "LIGGGHTS" else ours_path
        return Program(path, options.flags if item.program == "lsdcd" else "", options.mpi, threads=str(item.threads))

    for item in items(options, known):
        case, name = known[item.case], f"{item.case}, {item.program}"
        if kept.find(name, item.order(), item.ranks) or (item.program == "LIGGGHTS" and not liggghts):
            continue
        expected = took.get((item.case, item.program, item.ranks), 0)
        if left() < expected or left() < 0:
            rows.say(f"no time for {name}, {item.ranks} processes, {item.order()}: it takes {expected:.0f} s, {left():.0f} s are left")
            continue
        start = time.monotonic()
        if not (folder / f"{item.case}.data").exists():
            Program(ours_path, options.flags, options.mpi).run(filling(case, item.case), folder, most)
            rows.say(f"{item.case} is filled in {time.monotonic() - start:.1f} s, {so_far():.0f} s in all")
            start = time.monotonic()
        alone = kept.find(f"{item.case}, lsdcd", Item(0, item.case, "lsdcd", 1, lists=item.lists).order(), 1)
        ab = tuple(float(rows.facts(alone)[k]) for k in ("a", "b")) if alone and "a" in rows.facts(alone) else None
        if item.weight == "var" and not ab:
            rows.say(f"{name}, {item.order()}: its a and b come from a run of 1 process, and there is none")
            continue
        guess = case.grains * 400e-6 / item.ranks * (1.5 if item.ranks > 1 else 1)    # ms a step
        steps = int(min(5000, max(100, 1000 * options.seconds / guess)))
        warm = max(steps // 4, 2 * REBALANCE + 1 if item.balance else 20)
        deck = (case, item.case, item, warm, steps)
        text = ours(*deck, ab) if item.program == "lsdcd" else theirs(*deck, folder)
        run = program(item).run(text, folder, item.ranks, may_fail=True)
        if run.failed:
            (folder / "failed.txt").write_text(text + "\n" + run.output)
            rows.say(f"{name}, {item.ranks} processes, {item.order()} failed:\n{run.output[-600:]}")
            continue
        ms, facts = times_of(run.output, item, steps)
        if item.ranks == 1 and item.program == "lsdcd":
            facts.update(zip("ab", (f"{v:.4g}" for v in fitted(run.output, facts, case.grains))))
        cores = item.ranks * item.threads
        kept.add(rows.timed("cores", name, options.commit, triangles_of(folder, case), case.grains, item.order(), [ms],
                            device=f"CPU, {cores} core{'s' * (cores > 1)}, {rows.cpu()}", ranks=item.ranks, threads=item.threads,
                            steps=steps, **facts))
        took[item.case, item.program, item.ranks] = time.monotonic() - start
        rows.say(f"  {time.monotonic() - start:.1f} s, {so_far():.0f} s in all")
    if not kept.rows:
        raise SystemExit("nothing was measured")
    return kept.rows


def main():
    cores = os.cpu_count() or 1
    powers = [n for n in (1, 2, 4, 8, 16, 32, 64) if n <= cores]
    bench("cores", __doc__, measure, quick={"share": 0.05, "seconds": 0.3}, words=[
        ("--liggghts", dict(default="liggghts", metavar="FILE", help="the program (default: in PATH)")),
        ("--flags", dict(default="", metavar="WORDS", help="of LAMMPS, for all runs")),
        ("--mpi", dict(default="mpirun -np {ranks}", metavar="WORDS", help="what starts several processes (default: %(default)s)")),
        ("--ranks", dict(type=int, nargs="+", default=powers, metavar="N", help="processes (default: powers of 2 up to all cores)")),
        ("--cases", dict(nargs="+", choices=list(cases(1)), default=list(cases(1)))),
        ("--share", dict(type=float, default=1.0, metavar="S", help="of the grains of each case")),
        ("--seconds", dict(type=float, default=1.5, metavar="S", help="timed in a run, about (default %(default)s)")),
        ("--budget", dict(type=float, default=math.inf, metavar="S", help="begin no run that would end later"))])


if __name__ == "__main__":
    main()
