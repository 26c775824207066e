# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Our wall against LIGGGHTS's, on one core in the same run: `./run bench liggghts`.

100 000 spheres of radii 0.35 to 1 in a closed cylinder (radius 50, height 100) of 2 560, 19 968 and
202 752 triangles; Hertz contacts with shear history, friction and restitution; no contacts between
spheres. *At the wall*: every sphere overlaps the wall and is fixed in place. *Turning*: the same, and
the cylinder turns round its axis. *In bulk*: spheres fill the cylinder and move freely; *late* and *unchecked* differ in
when the programs look how far spheres have gone.

The wall's part of a step is the step with the wall less the step without it, in the same process. *Own*: what the programs'
own timers say: that of fix wall/lsdcd, and those of LIGGGHTS's fixes for walls and meshes. All times are processor time.
Set-up and memory are those of a run of 0 steps with the wall less those of one without. Both
programs read the same spheres and the same mesh, LIGGGHTS as text.
"""
import math
import random
import re
import shutil
import statistics

import rows
from lammps import Program, bench, in_turn, processor_clock
from stl import strip, write_stl

RADIUS, HEIGHT = 50.0, 100.0
SMALLEST, LARGEST = 0.35, 1.0
# Segments round the cylinder and along it: 2 round along + round^2 / 4 triangles.
MESHES = {2560: (64, 12), 19968: (192, 28), 202752: (576, 104)}
CASES = ("at the wall", "turning", "in bulk", "in bulk late", "in bulk unchecked")
NEIGHBORS = {"in bulk late": "delay 10 every 1 check yes", "in bulk unchecked": "delay 0 every 20 check no"}
ORDERS = ("random", "sorted")
YOUNG, POISSON, RESTITUTION, FRICTION, DENSITY = 1e8, 0.3, 0.5, 0.5, 2500.0
DT, SPEED, SKIN = 1e-3, 2.5, 0.2    # in bulk, neighbour lists are built every 20 to 30 steps
SPHERES = 100000
PERIOD = 250.0    # of the turning cylinder: its sides go 2e-3 of a radius in a step


# ---- the scene ---------------------------------------------------------------------------

def closed_cylinder(n_round, n_along):
    """Both caps are square grids that are mapped to the disk, so that no vertex has many triangles."""
    k = n_round // 4

    def disk(i, j):
        """Shirley and Chiu's map of a square, -1 to 1, to the unit disk."""
        a, b = 2 * i / k - 1, 2 * j / k - 1
        if a == 0 and b == 0:
            return 0.0, 0.0
        r, turn = (a, math.pi / 4 * b / a) if abs(a) > abs(b) else (b, math.pi / 2 - math.pi / 4 * a / b)
        return RADIUS * r * math.cos(turn), RADIUS * r * math.sin(turn)

    triangles = []
    for z in (0.0, HEIGHT):
        for i in range(k):
            for j in range(k):
                a, b, c, d = ((*disk(i + p, j + q), z) for p, q in ((0, 0), (1, 0), (1, 1), (0, 1)))
                # The diagonal that runs to the centre, as the other is nearly on the circle.
                outward = (2 * i + 1 - k) * (2 * j + 1 - k) >= 0
                triangles += [(a, b, c), (a, c, d)] if outward else [(a, b, d), (b, c, d)]
    edge = [(0, j) for j in range(k)] + [(i, k) for i in range(k)] + \
        [(k, j) for j in range(k, 0, -1)] + [(i, 0) for i in range(k, 0, -1)]
    ring = [disk(i, j) for i, j in edge]
    rings = [[(*p, HEIGHT * t / n_along) for p in ring + ring[:1]] for t in range(n_along + 1)]
    return triangles + [t for one, other in zip(rings, rings[1:]) for t in strip(one, other)]


def write_mesh(folder, n_round, n_along):
    """wall.stl, and the same as text: LIGGGHTS takes some binary files for text, by their numbers."""
    triangles = closed_cylinder(n_round, n_along)
    write_stl(folder / "wall.stl", triangles, "closed cylinder")
    with open(folder / "text.stl", "w") as out:
        out.write("solid cylinder\n")
        for corners in triangles:
            out.write("facet normal 0 0 0\nouter loop\n" +
                      "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*c) for c in corners) +
                      "endloop\nendfacet\n")
        out.write("endsolid cylinder\n")


def depth(x, y, n_round):
    """Distance of a point from the flat sides of the cylinder, in the plane."""
    half = math.pi / n_round
    turn = (math.atan2(y, x) - math.pi / 4) % (2 * half) - half    # the ring has a corner at 45 degrees
    return RADIUS * math.cos(half) - math.hypot(x, y) * math.cos(turn)


def at_the_wall(dice, r, n_round):
    """A centre whose sphere overlaps a side or a cap by 1 to 5 % of its radius."""
    gap = r * (1 - dice.uniform(0.01, 0.05))
    if dice.random() < HEIGHT / (HEIGHT + RADIUS):    # sides and caps by their areas
        half = math.pi / n_round
        turn = dice.uniform(-math.pi, math.pi)
        inside = (turn - math.pi / 4) % (2 * half) - half
        rho = (RADIUS * math.cos(half) - gap) / math.cos(inside)
        return rho * math.cos(turn), rho * math.sin(turn), dice.uniform(LARGEST, HEIGHT - LARGEST)
    while True:
        x, y = dice.uniform(-RADIUS, RADIUS), dice.uniform(-RADIUS, RADIUS)
        if depth(x, y, n_round) > LARGEST:
            return x, y, gap if dice.random() < 0.5 else HEIGHT - gap


def in_bulk(dice, r, n_round):
    """A centre anywhere in the cylinder, at most 2 % of its radius too near to the wall."""
    while True:
        x, y, z = dice.uniform(-RADIUS, RADIUS), dice.uniform(-RADIUS, RADIUS), dice.uniform(0, HEIGHT)
        if min(depth(x, y, n_round), z, HEIGHT - z) > 0.98 * r:
            return x, y, z


def write_spheres(folder, case, order, n, n_round):
    """still.data, and moving.data with the same spheres and velocities."""
    dice = random.Random(7)
    place = in_bulk if case.startswith("in bulk") else at_the_wall
    spheres = []
    for _ in range(n):
        r = dice.uniform(SMALLEST, LARGEST)
        spheres.append((r, *place(dice, r, n_round)))
    if order == "sorted":
        spheres.sort(key=lambda s: (int(s[3] / 3), int((s[2] + 60) / 3), int((s[1] + 60) / 3)))
    side = RADIUS + 5
    text = (f"spheres\n\n{n} atoms\n1 atom types\n\n{-side} {side} xlo xhi\n{-side} {side} ylo yhi\n"
            f"-5 {HEIGHT + 5} zlo zhi\n\nAtoms\n\n")
    text += "".join(f"{k} 1 {2 * r:.15g} {DENSITY} {x:.15g} {y:.15g} {z:.15g}\n"
                    for k, (r, x, y, z) in enumerate(spheres, 1))
    (folder / "still.data").write_text(text)
    speeds = (" ".join(f"{dice.uniform(-SPEED, SPEED):.6g}" for _ in range(6)) for _ in spheres)
    (folder / "moving.data").write_text(
        text + "\nVelocities\n\n" + "".join(f"{k} {v}\n" for k, v in enumerate(speeds, 1)))


# ---- scripts -------------------------------------------------------------------------------

OURS = f"""\
units           si
atom_style      sphere
atom_modify     map array sort 0 0
boundary        f f f
newton          off
comm_modify     vel yes cutoff 2.5
read_data       moving.data
pair_style      none
neighbor        {SKIN} bin
neigh_modify    delay 0 every 1 check yes
timestep        {DT}
"""
OUR_WALL = (f"fix wall all wall/lsdcd granular hertz/material {YOUNG} {RESTITUTION} {POISSON} "
            f"tangential mindlin NULL 1.0 {FRICTION} damping tsuji mesh wall.stl\n")

THEIRS = f"""\
units           si
atom_style      granular
atom_modify     map array sort 0 0
boundary        f f f
newton          off
communicate     single vel yes
read_data       moving.data
neighbor        {SKIN} bin
neigh_modify    delay 0 every 1 check yes exclude type 1 1
fix             m1 all property/global youngsModulus peratomtype {YOUNG}
fix             m2 all property/global poissonsRatio peratomtype {POISSON}
fix             m3 all property/global coefficientRestitution peratomtypepair 1 {RESTITUTION}
fix             m4 all property/global coefficientFriction peratomtypepair 1 {FRICTION}
pair_style      gran model hertz tangential history
pair_coeff      * *
timestep        {DT}
"""
# Folds of the coarsest mesh are 5.6 degrees: with its default curvature of 0.26 degrees LIGGGHTS
# counts a sphere twice where it overlaps both sides of one.
THEIR_WALL = """\
fix             mesh all mesh/surface file text.stl type 1 curvature 10
fix             wall all wall/gran model hertz tangential history mesh n_meshes 1 meshes mesh
"""
PROGRAMS = {"lsdcd": (OURS, OUR_WALL, "unfix wall\n"),
            "LIGGGHTS": (THEIRS, THEIR_WALL, "unfix wall\nunfix mesh\n")}
QUIET = "thermo 100000000\n"
TIMERS = {"lsdcd": "", "LIGGGHTS": "modify_timing on\n"}


def timed_script(program, case, steps, chunks):
    """Runs with the wall, then as many without."""
    start, wall, no_wall = PROGRAMS[program]
    if case == "turning":
        wall, no_wall = turning(program)
    move = "fix move all nve/sphere\n" if case.startswith("in bulk") else ""
    start = start.replace("delay 0 every 1 check yes", NEIGHBORS.get(case, "delay 0 every 1 check yes"))
    runs = f"run {max(5, steps // 4)}\n" + f"run {steps}\n" * chunks
    return start + wall + move + QUIET + TIMERS[program] + runs + no_wall + runs


def turning(program):
    """The wall's commands with a cylinder that turns, and those that take it away."""
    _, wall, no_wall = PROGRAMS[program]
    if program == "lsdcd":
        return wall.rstrip() + f" motion rotate 0 0 0 0 0 1 {PERIOD}\n", no_wall
    return (wall + f"fix turn all move/mesh mesh mesh rotate origin 0. 0. 0. axis 0. 0. 1. period {PERIOD}\n",
            "unfix turn\n" + no_wall)


def start_script(program, with_wall):
    start, wall, _ = PROGRAMS[program]
    return start + wall * with_wall + QUIET + "run 0\n"


def force_script(program):
    """Forces of spheres without velocity: elastic normal forces alone."""
    start, wall, _ = PROGRAMS[program]
    return (start.replace("moving.data", "still.data") + wall + QUIET +
            "dump d all custom 1 force.dump id fx fy fz\nrun 0\n")


# ---- measuring ---------------------------------------------------------------------------

def forces(path):
    """Size of the force on each sphere, by id."""
    lines = path.read_text().split("ITEM: ATOMS")[1].splitlines()[1:]
    return {int(w[0]): math.sqrt(sum(float(x)**2 for x in w[1:4])) for w in map(str.split, lines)}


def same_work(programs, folder):
    """Sum of the forces over LIGGGHTS's, and the share of spheres whose force differs by over 1 %."""
    found = {}
    for name, program in programs.items():
        program.run(force_script(name), folder)
        found[name] = forces(folder / "force.dump")
    ours, theirs = found["lsdcd"], found["LIGGGHTS"]
    off = sum(abs(f - theirs[k]) > 0.01 * max(f, theirs[k]) for k, f in ours.items())
    return {"force_ratio": f"{sum(ours.values()) / sum(theirs.values()):.5f}",
            "force_differs": f"{off / len(ours):.4f}", "touching": sum(f > 0 for f in ours.values())}


def start_costs(program, name, folder, repeats):
    """Set-up seconds and peak memory, MB, that the wall adds to a run of 0 steps: medians over pairs of
    runs with it and without, one after the other, as the first runs of a machine at rest are slow."""
    pairs = [[program.run(start_script(name, w), folder) for w in (True, False)]
             for _ in range(repeats)]

    def added(what):
        return statistics.median(getattr(wall, what) - getattr(none, what) for wall, none in pairs)

    return {"setup_s": f"{added('seconds'):.3g}", "memory_mb": f"{added('peak_mb'):.4g}"}


def own_ms(program, output, runs, steps):
    """By the program's own timers, ms per step of each run of `steps` steps with the wall, of which there are `runs`: the
    last of them."""
    if program == "lsdcd":
        parts = re.findall(r"timing breakdown of the wall.*\n.*\n.*\n((?:  \w+ *\|.*\n)+)", output, re.M)
        seconds = [sum(float(line.split("|")[2]) for line in part.splitlines()) for part in parts]
    else:
        loops = output.split("Loop time of")[1:]
        seconds = [sum(float(t) for t in re.findall(r"^Fix (?:\S*mesh\S*|wall) \S+ time \(%\) = (\S+)", loop, re.M))
                   for loop in loops]
    return [1e3 * s / steps for s in seconds[1:1 + runs]]


def compare(options, folder):
    theirs = shutil.which(options.liggghts)
    if not theirs:
        raise SystemExit("there is no liggghts (Debian package liggghts)")
    clock = processor_clock(folder)
    programs = {"lsdcd": Program(options.lmp), "LIGGGHTS": Program(theirs)}
    timed_programs = {"lsdcd": Program(options.lmp, clock=clock), "LIGGGHTS": Program(theirs, clock=clock)}
    found = []
    for triangles in options.triangles:
        n_round, n_along = MESHES[triangles]
        write_mesh(folder, n_round, n_along)
        start = None
        for case in options.cases:
            for order in options.orders:
                write_spheres(folder, case, order, options.spheres, n_round)
                if start is None:
                    start = {name: start_costs(p, name, folder, 5) for name, p in programs.items()}
                check = same_work(programs, folder)
                steps = options.steps * (10 if case.startswith("in bulk") else 1)
                script = {name: timed_script(name, case, steps, options.chunks) for name in programs}
                runs = in_turn(options.repeats, programs, lambda name: [timed_programs[name].run(script[name], folder)])
                for name, mine in runs.items():
                    wall, plain = ([t for r in mine for t in r.step_ms()[part]]
                                   for part in (slice(1, 1 + options.chunks), slice(2 + options.chunks, None)))
                    own = [t for r in mine for t in own_ms(name, r.output, options.chunks, steps)]
                    found.append(rows.timed("liggghts", f"{case}, {name}", options.commit, triangles, options.spheres, order,
                                            [a - b for a, b in zip(wall, plain)], steps=steps,
                                            builds=sum(b for r in mine for b in r.builds()[1:1 + options.chunks]),
                                            no_wall_ms=f"{statistics.median(plain):.4g}",
                                            own_ms=f"{statistics.median(own):.4g}",
                                            own_least=f"{min(own):.4g}", own_most=f"{max(own):.4g}",
                                            **start[name], **check))
    return found


def main():
    bench("liggghts", __doc__, compare, steps=20, quick={"triangles": [2560], "spheres": 5000, "repeats": 1}, words=[
        ("--liggghts", dict(default="liggghts", metavar="FILE", help="the program (default: in PATH)")),
        ("--triangles", dict(type=int, nargs="+", choices=MESHES, default=list(MESHES))),
        ("--cases", dict(nargs="+", choices=CASES, default=list(CASES), help="in bulk steps are ten times as many")),
        ("--orders", dict(nargs="+", choices=ORDERS, default=list(ORDERS))),
        ("--spheres", dict(type=int, default=SPHERES, metavar="N"))])


if __name__ == "__main__":
    main()
