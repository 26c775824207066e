# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Scripts of this folder's own: every contact law with effects of a wall, on 150 spheres of several sizes.

scripts() gives them. Each writes what it knows with 17 digits: a dump, totals in the thermo output, a
restart file with the springs. Many go in one LAMMPS process, with `clear` between them.
"""

import itertools
import math
import pathlib
import random
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
import stl

STEPS = 100    # of each of a script's runs: spheres slide and roll over some folds and rims

# ---- laws --------------------------------------------------------------------------------

NORMALS = {
    "hooke": "hooke 1e4 {eta}",
    "hertz": "hertz 5e4 {eta}",
    "hertz_material": "hertz/material 1e5 {eta} 0.3",
    "dmt": "dmt 1e5 {eta} 0.3 2",
    "jkr": "jkr 1e5 {eta} 0.3 2",
}
DAMPINGS = {"none": 0, "velocity": 3, "mass_velocity": 5, "viscoelastic": 40, "tsuji": 0.6,
            "coeff_restitution": 0.7}
OF_RESTITUTION = ("tsuji", "coeff_restitution")    # which dmt and jkr do not take
TANGENTIALS = {
    "linear_nohistory": "linear_nohistory 0.7 0.4",
    "linear_history": "linear_history 3e3 0.6 0.4",
    "linear_history_slip": "linear_history_slip 3e3 0.6 0.4",
    "mindlin": "mindlin {kt} 0.6 0.4",
    "mindlin_force": "mindlin/force {kt} 0.6 0.4",
    "mindlin_slip": "mindlin_slip {kt} 0.6 0.4",
    "mindlin_rescale": "mindlin_rescale {kt} 0.6 0.4",
    "mindlin_rescale_force": "mindlin_rescale/force {kt} 0.6 0.4",
}
ROLLINGS = {"": "", "sds": "rolling sds 2e3 5 0.08"}
TWISTINGS = {"": "", "marshall": "twisting marshall", "sds": "twisting sds 50 0.4 0.02"}
HEATS = {"radius": "heat radius 0.7", "area": "heat area 3"}

CLASSICS = {"hooke": "hooke 1e4 NULL 5 NULL 0.5 {damp}",
            "hooke_history": "hooke/history 1e4 4e3 5 2 0.5 {damp}",
            "hertz_history": "hertz/history 1e5 NULL 50 NULL 0.5 {damp}"}
# Of LIGGGHTS; they stand after the mesh.
ADDED = {"cdt": "rolling cdt 0.1", "epsd2": "rolling epsd2 0.1", "sjkr": "cohesion sjkr 500",
         "epsd": "rolling epsd 0.1 0.3", "epsd3": "rolling epsd3 0.1 0.3 4",
         "cdt-sjkr": "rolling cdt 0.1 cohesion sjkr 500", "epsd2-sjkr": "rolling epsd2 0.1 cohesion sjkr 500"}


def classic():
    """{name: (law, words after the mesh)}"""
    laws = {}
    for (style, words), damp in itertools.product(CLASSICS.items(), (1, 0)):
        name = style + ("" if damp else "-undamped")
        laws[name] = (words.format(damp=damp), "")
        laws[name + "-limit"] = (words.format(damp=damp) + " limit_damping", "")
    for (style, words), (added, more) in itertools.product(CLASSICS.items(), ADDED.items()):
        laws[f"{style}-{added}"] = (words.format(damp=1), more)
    return laws


def granular():
    """Every normal, damping and tangential sub-model with one another; rolling, twisting, their
    absence and limit_damping take turns, so that each meets every other sub-model."""
    laws = {}
    turns = list(itertools.product(ROLLINGS, TWISTINGS))
    for k, normal in enumerate(NORMALS):
        for j, (damping, eta) in enumerate(DAMPINGS.items()):
            adheres = normal in ("dmt", "jkr")
            if adheres and damping in OF_RESTITUTION:
                continue
            for i, (tangential, slide) in enumerate(TANGENTIALS.items()):
                has_young = normal in ("hertz_material", "dmt", "jkr")
                kt = "NULL" if has_young and (i + j) % 2 else "2e4"
                # Each triple alone or with what its turn brings.
                for rolling, twisting in {("", ""), turns[1 + (i + 2 * j + 3 * k) % 5]}:
                    limit = not adheres and (i + j + k) % 4 == 0
                    name = "-".join(w for w in ("granular", normal, damping, tangential, rolling and "roll",
                                                twisting, limit and "limit") if w)
                    laws[name] = (" ".join(w for w in (
                        "granular", NORMALS[normal].format(eta=eta), "damping", damping, "tangential",
                        slide.format(kt=kt), ROLLINGS[rolling], TWISTINGS[twisting],
                        "limit_damping" if limit else "") if w), "")
    return dict(sorted(laws.items()))


# One for every law that is compiled by itself, more or less: what effects are tried with.
FEW = {
    "hooke": ("hooke 1e4 NULL 5 NULL 0.5 1", ""),
    "hooke_history": ("hooke/history 1e4 NULL 5 NULL 0.5 1", ""),
    "hertz_history": ("hertz/history 1e5 NULL 50 NULL 0.5 1", ""),
    "hooke-cdt": ("hooke 1e4 NULL 5 NULL 0.5 1", "rolling cdt 0.1"),
    "hertz_history-epsd2-sjkr": ("hertz/history 1e5 NULL 50 NULL 0.5 1", "rolling epsd2 0.1 cohesion sjkr 500"),
    "slider": ("granular hertz 5e4 0.6 damping tsuji tangential linear_nohistory 0.7 0.4", ""),
    "mindlin": ("granular hertz/material 1e5 40 0.3 tangential mindlin NULL 0.6 0.4", ""),
    "dmt": ("granular dmt 1e5 40 0.3 2 tangential mindlin/force NULL 0.6 0.4", ""),
    "rough": ("granular hertz/material 1e5 0.6 0.3 damping coeff_restitution tangential mindlin_rescale NULL 0.6 0.4 "
              "rolling sds 2e3 5 0.1 twisting marshall", ""),
    "roller": ("granular hooke 1e4 5 damping mass_velocity tangential linear_nohistory 0.7 0.4 "
               "rolling sds 2e3 5 0.1 twisting sds 50 0.4 0.02", ""),
    "jkr": ("granular jkr 1e5 40 0.3 2 tangential mindlin_rescale/force NULL 0.6 0.4 rolling sds 2e3 5 0.1 "
            "twisting marshall", ""),
    "liggghts": ("granular hertz/material 1e5 0.6 0.3 damping coeff_restitution tangential mindlin_liggghts NULL 0.6 0.4", ""),
    "liggghts-slider": ("granular hooke 1e4 5 tangential linear_nohistory_liggghts 0.7 0.4", ""),
    "liggghts-spring": ("granular hooke 1e4 5 damping velocity tangential linear_history_liggghts 3e3 0.6 0.4 limit_damping", ""),
    "liggghts-epsd2": ("granular dmt 1e5 40 0.3 2 tangential mindlin_liggghts NULL 0.6 0.4 rolling epsd2 0.1 cohesion sjkr 500", ""),
}

# ---- effects -----------------------------------------------------------------------------

PLATE = "mesh plate.stl"
SERVO = "servo force z -40 vmax 2.0 limits -0.5 0.5"
WAVE = "variable wave equal 0.02*sin(30*elapsed*dt)\nvariable speed equal 0.6*cos(30*elapsed*dt)\n"
TURN = "motion rotate 0.3 0.2 0 0.2 0.1 1 9"


def effect(words="", wall="", laws=None, boundary="f f f", scene="sheet", before="", after="", between="",
           neigh="delay 0 every 1 check yes", columns="", servo=False, settings=""):
    """words: of the mesh. wall: of the whole wall, at its end. laws: names of those that it takes
    (default: FEW). before, after: lines before and after the fix. between: lines between the two runs."""
    return locals()


CLASSIC = ("hooke", "hooke_history", "hertz_history")
SOME = ("hooke_history", "rough", "jkr")
EFFECTS = {
    "linear": effect("motion linear 0.3 -0.2 0.4"),
    "wiggle": effect("motion wiggle 0.02 0 0.04 0.1"),
    "wiggle_x": effect("wiggle x 0.05 0.03"),
    "transrot": effect("motion transrot 0.4 0.2 0.1 0.1 0.2 -7 0 1 1 8"),
    "two_motions": effect("motion wiggle 0.02 0 0.04 0.1 motion rotate 0.5 0.2 0 0 0.1 1 17"),
    "variable": effect("motion variable NULL NULL v_wave NULL NULL v_speed", before=WAVE),
    "differences": effect("motion variable v_wave NULL NULL NULL NULL NULL", before=WAVE, laws=SOME),
    "shear": effect("shear y 2.0"),
    "surface_vel": effect("surface_vel 1.0 0.5 0", laws=SOME),
    "surface_variable": effect("surface_vel v_wave v_speed 0", before=WAVE, laws=SOME),
    "turntable": effect("surface_angvel 0 0 3 0.1 0.2 0"),
    "machine": effect("surface_vel 1.0 0.5 0 motion rotate 0 0 0 0 0 1 8", laws=SOME),
    "archard": effect("mesh_fields SCRIPT_*.vtp every 30", wall="wear archard 1e-3 1e5"),
    "turning_wear": effect(TURN + " mesh_fields SCRIPT_*.vtp every 100",
                           wall="wear finnie 1e-3"),
    "fields": effect("mesh_fields SCRIPT.vtp every 30"),
    "energy_fields": effect("mesh_fields SCRIPT_*.vtp every 30 impact_spectrum SCRIPT_*.csv every 100",
                            wall="energy impacts 0.01 wear finnie 1e-3"),
    "impacts_of_two": effect(f"mesh_fields SCRIPT_a.vtp every 100 {PLATE} motion rotate 0 0 0 0 0 1 8 "
                             "impact_spectrum SCRIPT_b.csv every 100", wall="impacts 0.01", laws=SOME + ("hooke",)),
    "stl": effect(TURN + " mesh_stl SCRIPT_*.stl every 100", laws=("hooke",)),
    "nearest": effect(wall="nearest 2"),
    "sum": effect(wall="corner sum"),
    "grid": effect(wall="grid 0.3 rmax 0.7 memory 64", laws=SOME),
    "placed": effect("scale 1.1 1 0.9 rotate 0 0 1 30 move 0.1 0 0.05 weld 1e-5 torque_about 1 2 3", laws=SOME),
    "torque_about_mesh": effect(TURN + " torque_about mesh 0.5 0 0", laws=SOME),
    "inside": effect(wall="side in", scene="box"),
    "outside": effect(wall="side out", scene="pillar", laws=SOME),
    "two_meshes": effect(f"{PLATE}"),
    "one_moves": effect(f"{PLATE} motion rotate 0 0 0 0 0 1 8"),
    "both_move": effect(f"motion wiggle 0 0 0.05 0.04 {PLATE} motion linear 0.5 0 0 mesh_stl SCRIPT.stl every 100"),
    "two_with_wear": effect(f"mesh_fields SCRIPT_a.vtp every 100 {PLATE} motion rotate 0 0 0 0 0 1 8 "
                            "mesh_fields SCRIPT_b.vtp every 100", wall="wear finnie 1e-3", laws=SOME + ("hooke",)),
    "two_nearest": effect(f"{PLATE} motion rotate 0 0 0 0 0 1 8", wall="nearest 2", laws=SOME),
    "servo": effect(SERVO, servo=True),
    "servo_torque": effect("servo torque z 5 vmax 2.0", servo=True, laws=SOME),
    "servo_of_two": effect(f"{PLATE} {SERVO}", servo=True, laws=SOME),
    "periodic": effect("", wall="periodic", boundary="p p f"),
    "periodic_turning": effect("", boundary="p p f", scene="paddle", laws=SOME),
    "tilted": effect("", boundary="p p f", scene="tilted", laws=SOME),
    "box_changes": effect("", boundary="p p f", laws=SOME, before="fix grow all deform 5 x scale 1.01 y scale 1.01\n"),
    "shrinking": effect("", boundary="s s f", laws=SOME),
    "plane": effect("", scene="outline", boundary="f f p"),
    "virial": effect(after="fix_modify wall energy yes virial yes\n", columns="press pe pxx pzz pxz",
                     laws=SOME + ("slider",)),
    "virial_turning": effect(TURN, after="fix_modify wall energy yes virial yes\n", columns="press pe pyz",
                             laws=SOME),
    "new_motion": effect(TURN, between="fix_modify wall motion linear 0 0 -0.1\n", laws=SOME),
    "stopped": effect(TURN, between="fix_modify wall motion none\n", laws=SOME),
    "new_servo": effect(SERVO, between="fix_modify wall servo force z -10 vmax 1.0\n", servo=True, laws=SOME),
    "timestep": effect(TURN, between="reset_timestep 1000\ntimestep 2e-4\n", laws=SOME),
    "balance": effect("", before="fix even all balance 20 1.0 shift xyz 5 1.02\n", laws=SOME),
    "balance_turning": effect(TURN, before="fix even all balance 20 1.0 shift xyz 5 1.02\n", laws=SOME),
    # Jumps over folds in one step: a spring goes along or is left by the angle that it turns (kMoved).
    "jumps": effect("motion variable v_jump NULL NULL v_still NULL NULL", laws=SOME,
                    before="variable jump equal 0.25*((step%10)>4)\nvariable still equal 0\n"),
    "rarely": effect("", neigh="delay 10 every 10 check no", laws=SOME),
    "rarely_turning": effect(TURN, neigh="delay 10 every 10 check no", laws=SOME),
    "sorted": effect("", settings="atom_modify sort 7 1.0\n", laws=SOME),
    "growing": effect("", before="variable d equal 0.5+1e-3*step\ngroup some id 1:150:5\n"
                      "fix grow some adapt 20 atom diameter v_d\n", wall="rmax 0.6",
                      settings="atom_style sphere 1\n", laws=SOME),
    "deleted": effect("", between="group odd id 1:150:2\ndelete_atoms group odd compress no\n", laws=SOME),
    "respa": effect("", before="run_style respa 2 2\n", laws=CLASSIC),
    "massflow": effect("", before="fix flow all massflow/lsdcd mesh level.stl\n",
                       columns="f_flow[1] f_flow[2] f_flow[3] f_flow[4] f_flow[5] f_flow[6]", laws=("hooke_history",)),
    "two_fixes": effect("", after="fix other all wall/lsdcd hooke 1e4 NULL 5 NULL 0.5 1 mesh plate.stl\n",
                        columns="f_other f_other[3]", laws=SOME),
}
# Heat needs LAMMPS 4Jul2026.
HEAT = """\
fix             heats all property/atom temperature heatflow ghost yes
set             group all temperature 300
compute         warmth all property/atom temperature
compute         taken all property/atom heatflow
fix             flow all heat/flow constant 0.5
"""
RAMP = "variable ramp equal 300+1000*step*dt\n"

# ---- scenes ------------------------------------------------------------------------------


FOLDS = [(-6, 0.0), (-4, 0.0), (-3, 0.2), (-2, 0.0), (-1, 1.0), (-0.2, 0.2), (0.8, 0.2), (1.4, 1.2), (2.0, 0.2),
         (3.0, 0.4), (4.0, 0.0), (6, 0.0)]    # x and z of the sheet, from flat to 60 degrees both ways


def height(x):
    for (x0, z0), (x1, z1) in zip(FOLDS, FOLDS[1:]):
        if x0 <= x <= x1:
            return z0 + (z1 - z0) * (x - x0) / (x1 - x0)
    return 0.0


def above(x, distance):
    """The z over x that is so far from the folds."""
    def far(z):
        least = math.inf
        for (x0, z0), (x1, z1) in zip(FOLDS, FOLDS[1:]):
            u, w = x1 - x0, z1 - z0
            t = min(1.0, max(0.0, ((x - x0) * u + (z - z0) * w) / (u * u + w * w)))
            least = min(least, math.hypot(x - x0 - t * u, z - z0 - t * w))
        return least

    low, high = height(x), height(x) + 3
    for _ in range(60):
        mid = (low + high) / 2
        low, high = (mid, high) if far(mid) < distance else (low, mid)
    return high


def sheet(side=3.6, full=False):
    """Folded along y, cut into triangles across the folds. Its rims are in the box, unless `full`."""
    xs = [-4, -3, -2, -1, -0.2, 0.8, 1.4, 2.0, 3.0, 4.0]
    xs = [-5, *xs, 5] if full else [-side, *(x for x in xs if -side < x < side), side]
    ys = [-5, -2, 1, 3, 5] if full else [-side, -1.5, 0.4, 2, side]
    triangles = []
    for x0, x1 in zip(xs, xs[1:]):
        for y0, y1 in zip(ys, ys[1:]):
            triangles += stl.quad(*((x, y, height(x) if abs(x) < 5 else 0.0) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))))
    return triangles


def spheres(scene):
    """(radius, place, velocity, turning) of each; they do not meet one another."""
    draw, some = random.Random(4711), []
    cells = [(i, j) for i in range(15) for j in range(10)]
    for i, j in cells:
        radius = draw.choice((0.2, 0.25, 0.3, 0.35)) * draw.uniform(0.95, 1.05)
        x, y = -4.6 + 9.2 * (i + draw.uniform(0.2, 0.8)) / 15, -4.6 + 9.2 * (j + draw.uniform(0.2, 0.8)) / 10
        z = above(x, radius * draw.uniform(0.96, 1.04))
        if scene == "box":    # at the floor of a closed box, some at its sides
            x, y, z = 0.85 * x, 0.85 * y, -0.5 + radius * draw.uniform(0.97, 1.03)
        elif scene == "pillar":    # round a closed block
            angle = math.atan2(y, x)
            far = 2.0 / max(abs(math.cos(angle)), abs(math.sin(angle))) + radius * draw.uniform(0.97, 1.03)
            x, y, z = far * math.cos(angle), far * math.sin(angle), draw.uniform(-0.4, 1.6)
        elif scene == "outline":
            z = 0.0
            y = above(x, radius * draw.uniform(0.96, 1.04))
        # Along the sheet, and a little against it.
        u, v = draw.uniform(-6, 6), draw.uniform(-6, 6)
        velocity = [u, v, u * (height(x + 1e-3) - height(x - 1e-3)) / 2e-3 + draw.uniform(-1.5, 0.2)]
        turning = [draw.uniform(-12, 12) for _ in range(3)]
        if scene == "outline":
            velocity, turning = [u, velocity[2], 0.0], [0.0, 0.0, turning[2]]
        elif scene in ("box", "pillar"):
            velocity = [u / 4, v / 4, draw.uniform(-1.5, 0.2)]
        some.append((radius, (x, y, z), velocity, turning))
    return some


SCENES = ("sheet", "box", "pillar", "outline", "paddle", "tilted")


def write_data(path, scene):
    some = spheres(scene)
    z = (-0.5, 0.5) if scene == "outline" else (-2, 6)
    with open(path, "w") as data:
        data.write(f"spheres\n\n{len(some)} atoms\n1 atom types\n\n-5 5 xlo xhi\n-5 5 ylo yhi\n"
                   f"{z[0]} {z[1]} zlo zhi\n" + ("0.7 0 0 xy xz yz\n" if scene == "tilted" else "") +
                   "\nAtoms # sphere\n\n")
        for n, (radius, at, _, _) in enumerate(some, 1):
            data.write(f"{n} 1 {2 * radius:.17g} {2.0 + n % 3} " + " ".join(f"{v:.17g}" for v in at) + "\n")
        data.write("\nVelocities\n\n")
        for n, (_, _, velocity, turning) in enumerate(some, 1):
            data.write(f"{n} " + " ".join(f"{v:.17g}" for v in velocity + turning) + "\n")


def write_files(folder):
    """All that the scripts read."""
    stl.write(folder / "sheet.stl", sheet())
    stl.write(folder / "full.stl", sheet(full=True))
    for name, (lo, hi, z) in {"plate": (-3, 3.2, 0.1), "level": (-5, 5, 0.5)}.items():
        stl.write(folder / f"{name}.stl", stl.quad((lo, lo, z), (hi, lo, z), (hi, hi, z), (lo, hi, z)))
    stl.write(folder / "box.stl", stl.box((-4, -4, -0.5), (4, 4, 5)))
    stl.write(folder / "pillar.stl", stl.box((-2, -2, -1), (2, 2, 4)))
    stl.write(folder / "paddle.stl", stl.quad((-2, 0, -1), (2, 0, -1), (2, 0, 2), (-2, 0, 2)))
    xs = [-3.6, -3, -2, -1, -0.2, 0.8, 1.4, 2.0, 3.0, 3.6]
    outline = []
    for x0, x1 in zip(xs, xs[1:]):
        outline += stl.quad(*((x, height(x), z) for x, z in ((x0, -0.5), (x1, -0.5), (x1, 0.5), (x0, 0.5))))
    stl.write(folder / "outline.stl", outline)
    for scene in SCENES:
        write_data(folder / f"{scene}.data", scene)


# ---- scripts -------------------------------------------------------------------------------

SETTINGS = """\
units           lj
atom_style      sphere
atom_modify     map array
{settings}{dimension}boundary        {boundary}
newton          off
comm_modify     vel yes cutoff 2.0
"""
FORCES = """\
pair_style      zero 0.9
pair_coeff      * *
neighbor        0.2 bin
neigh_modify    {neigh}
fix             move all nve/sphere
fix             pull all gravity 60.0 vector {pull}
{before}timestep        2.5e-4
fix             wall all wall/lsdcd {law} {mesh} {added} {wall} contacts
{after}thermo_style    custom step atoms {columns} {totals}
thermo_modify   format float %.17g norm no lost ignore
thermo          20
"""
DUMP = ("write_dump all custom {name} id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz {contacts} "
        "modify format float %.17g sort id\n")


def script(name, law, added, one):
    """The text of a script. Files that it writes are named NAME.*, NAME_*."""
    scene = one["scene"]
    mesh = {"sheet": "full.stl" if one["boundary"][0] == "p" else "sheet.stl", "tilted": "full.stl",
            "paddle": "full.stl mesh paddle.stl motion rotate 0 0 0 0 0 1 8"}.get(scene, f"{scene}.stl")
    heated = " heat " in law
    columns = 9 if heated else 8
    totals = 14 if one["servo"] else 11
    words = dict(
        law=law, added=added, mesh=f"mesh {mesh} {one['words']}".replace("SCRIPT", name),
        wall=one["wall"], neigh=one["neigh"], before=one["before"], after=one["after"], columns=one["columns"],
        totals=" ".join(["f_wall", *(f"f_wall[{k}]" for k in range(1, totals + 1))]),
        pull="0.2 -1 0" if scene == "outline" else "0.3 0.1 -1")
    begin = SETTINGS.format(boundary=one["boundary"], settings=one["settings"],
                            dimension="dimension 2\n" if scene == "outline" else "")
    forces = FORCES.format(**words)
    if scene == "outline":
        forces = forces.replace("fix             wall", "fix flat all enforce2d\nfix             wall")
    contacts = " ".join(f"f_wall[{k}]" for k in range(1, columns + 1)) + (" c_warmth c_taken" if heated else "")
    dump = DUMP.format(name="{}", contacts=contacts)
    # Written after the first run and read again: the second run goes on in two ways.
    return (f"clear\nprint \"== {name}\"\n" + begin + f"read_data {scene}.data\n" + forces +
            f"run {STEPS}\n" + dump.format(f"{name}.first.dump") + one["between"] + f"run {STEPS}\n" +
            dump.format(f"{name}.dump") + f"write_restart {name}.restart\n" +
            f"clear\nprint \"== {name}.read\"\n" + begin + f"read_restart {name}.restart\n" + forces +
            f"run {STEPS // 2}\n" + dump.format(f"{name}.read.dump"))


def scripts(every=1):
    """[(name, text, whether it needs LAMMPS 4Jul2026)]; `every`: one of so many, for a sample."""
    rest = {"rest": effect(), "rotate": effect(TURN), "wear": effect(wall="wear finnie 1e-3")}
    laws = {**classic(), **granular()}
    some = []
    for k, (law, (words, added)) in enumerate(laws.items()):
        for j, (name, one) in enumerate(rest.items()):
            if (k + j) % every == 0:
                some.append((f"{law}.{name}", script(f"{law}.{name}", words, added, one), False))
    for j, (name, one) in enumerate(EFFECTS.items()):
        for k, law in enumerate(one["laws"] or FEW):
            if (k + j) % min(every, 3) == 0:
                words, added = FEW[law]
                some.append((f"{law}.{name}", script(f"{law}.{name}", words, added, one), False))
    k = 0
    for normal, eta in (("hooke", 5), ("hertz", 40), ("hertz_material", 40), ("dmt", 40), ("jkr", 40)):
        for kind, (tangential, more) in itertools.product(
                HEATS, (("linear_nohistory", ""), ("mindlin", "rolling sds 2e3 5 0.1 twisting marshall"))):
            law = (f"granular {NORMALS[normal].format(eta=eta)} tangential {TANGENTIALS[tangential].format(kt='2e4')} "
                   f"{more} {HEATS[kind]}")
            for name, one in (("rest", effect("temperature 350", before=HEAT)),
                              ("rotate", effect(TURN + " temperature v_ramp", before=HEAT + RAMP)),
                              ("two_meshes", effect(f"temperature 350 {PLATE} temperature 400", before=HEAT))):
                if k % every == 0:
                    full = f"heat-{normal}-{tangential}-{kind}.{name}"
                    some.append((full, script(full, law, "", one), True))
                k += 1
    return some
