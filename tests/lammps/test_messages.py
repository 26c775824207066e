# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""What the fix says: whose warning it is, of which atom, once, and before hours are lost."""

import math
import re

import lmp
import stl
from facts import at_most, fact

BOX = lmp.head("-3 3 -3 3 -1 5") + """\
create_atoms    1 single 2 2 4 units box
create_atoms    1 single 0.3 0.2 0.48 units box
group           spare id 1
delete_atoms    group spare compress no
set             group all diameter 1.0 density 2.0
""" + lmp.pairs() + """\
fix             move all nve/sphere
timestep        0.001
"""


def fix(more="", name="w", mesh="floor.stl", law="hooke 1e4 NULL 5 NULL 0.5 1"):
    return f"fix {name} all wall/lsdcd {law} mesh {mesh} {more}\n"


def drum(lifters, sides=36, radius=2.0, height=1.0):
    def at(k, r, z):
        return (r * math.cos(k), r * math.sin(k), z)

    turn = 2 * math.pi / sides
    triangles = []
    for k in range(sides):
        triangles += stl.quad(at(k * turn, radius, 0), at((k + 1) * turn, radius, 0),
                              at((k + 1) * turn, radius, height), at(k * turn, radius, height))
    for k in range(lifters):
        angle = 2 * math.pi * k / lifters
        triangles += stl.quad(at(angle, radius, 0), at(angle, radius, height),
                              at(angle, 0.8 * radius, height), at(angle, 0.8 * radius, 0))
    return triangles


def lines(text, *words):
    return [line for line in text.split("\n") if all(w in line for w in words)]


def prepare(folder):
    lmp.flat_floor(folder)
    stl.write(folder / "in_mm.stl", [((-50, -50, 0), (50, -50, 0), (50, 50, 0)), ((-50, -50, 0), (50, 50, 0), (-50, 50, 0)),
                                     ((-50, -50, 0), (50, -50, 0), (0, -50, 80))])
    stl.write(folder / "drum.stl", drum(0))
    stl.write(folder / "lifters.stl", drum(4))
    o, x, y, z = (0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2)
    stl.write(folder / "corner.stl", [(o, x, y), (o, y, z), (o, z, x)])


def twice(script, command="run 0\n"):
    return script + 2 * command


DEEP = BOX + "set group all z 0.3\n"
# A contact with k = 1e4 and a mass of pi/3 lasts pi sqrt(m/k) = 0.032. The sphere sinks by 0.2 in its first step.
FAST = BOX + "set group all z 0.6\nvelocity all set 0 0 -3\ntimestep 0.1\n" + fix() + "thermo_modify lost ignore\nrun 3\n"
# Atoms without a diameter have radius 0.5: the box and the mesh are small beside them.
SMALL = BOX.replace("block -3 3 -3 3 -1 5", "block -.06 .06 -.06 .06 -.02 .1").replace("2 2 4", "0 0 .02").replace("0.3 0.2 0.48", "0 0 .05")
FORGOTTEN = SMALL.replace("set             group all diameter 1.0 density 2.0\n", "")
NO_SUCH = ("WARNING: Fix w", "radius 0.5", "box spans", "no such sphere fits", "set group all diameter", "until a diameter is set")
LARGE = ("far larger than the box", "add scale 0.001")
INSERTED = "fix in all insert/lsdcd mesh floor.stl scale {} massrate 1 diam one 0.3 dens 2\n"
COUNTED = "fix o all massflow/lsdcd mesh floor.stl scale {}\n"
HINGED = "body mass 1 com 0 0 0 inertia 1 1 1 0 0 0 joint hinge 0 0 0 0 1 0 limits "
RADIANS = ("WARNING: Fix w", "of its hinge", "in radians")    # a turn is 6.28
# The floor is 10 across in a box from -1 to 5 in z: turned about y, it reaches from -5 to 5.
TURNED, OUT = "motion rotate 0 0 0 {} 1", ("WARNING: Fix w", "will turn out of the box", "in z")
BOTH = BOX + "group one id 2\ngroup none empty\n" + fix()
TWICE = ("WARNING: Fix lid", "'floor.stl' is at the same place in fix w", "twice")
OF_ONE = fix(name="lid").replace(" all ", " one ")
OTHER = "fix wall/gran of this LAMMPS gives different forces for this law: "
DEFAULTS = ("grid auto rmax auto memory 1024 cache none nearest all corner blend side both device auto log full draw edges 1")
# What is said: a script, words of a line, how many lines have them, and, where these are several, the ranks.
SAID = {
    "a drum without lifters is not warned of": (BOX + fix("surface_angvel 0 0 3", mesh="drum.stl") + "run 1\n", ["along their normals"], 0),
    "nor a belt": (BOX + fix("surface_vel 1 0 0") + "run 1\n", ["along their normals"], 0),
    "a warning names the fix and the atom": (DEEP + fix(name="base") + "run 1\n", ["WARNING: Fix base wall/lsdcd: atom 2 appeared"], 1),
    "that of a minimization too": (DEEP + fix(name="base") + "minimize 0 0 1 1\n", ["Fix base wall/lsdcd: the wall has no effect"], 1),
    # The floor is 4 wide and flat, its spheres have radius 0.5.
    "a flat floor in millimetres is told, and its scale": (BOX + fix("scale 1000") + "run 0\n", ["WARNING: Fix w", *LARGE], 1),
    "a mesh smaller than a sphere is told once, with its scale": (
        twice(BOX + fix("scale 0.001")), ["WARNING: Fix w", "spheres have radius 0.5", "'scale 0.001' is not needed"], 1),
    "a floor of the script's units is not": (BOX + fix() + "run 0\n", ["probably in"], 0),
    "an inlet in millimetres": (twice(BOX + INSERTED.format(1000)), ["WARNING: Fix in insert/lsdcd", *LARGE], 1),
    "an inlet of the script's units": (twice(BOX + INSERTED.format(1)), ["WARNING: Fix in insert/lsdcd", *LARGE], 0),
    "a mass flow in millimetres": (twice(BOX + COUNTED.format(1000)), ["WARNING: Fix o massflow/lsdcd", *LARGE], 1),
    "a mass flow of the script's units": (twice(BOX + COUNTED.format(1)), ["WARNING: Fix o massflow/lsdcd", *LARGE], 0),
    "limits of a hinge in degrees": (BOX + fix(HINGED + "0 90") + "run 0\n", RADIANS, 1),
    "limits of a hinge in radians": (BOX + fix(HINGED + "-3 3") + "run 0\n", RADIANS, 0),
    "a diameter that was forgotten, beside a mesh of the right scale": (
        twice(FORGOTTEN + fix("scale 0.001", mesh="in_mm.stl")), NO_SUCH, 1),
    "... whose scale is not blamed for it": (FORGOTTEN + fix("scale 0.001", mesh="in_mm.stl") + "run 0\n", ["is not needed"], 0),
    "a diameter that was forgotten, beside a mesh in millimetres": (twice(FORGOTTEN + fix(mesh="in_mm.stl")), NO_SUCH, 1),
    "... nor is this": (FORGOTTEN + fix(mesh="in_mm.stl") + "run 0\n", ["is not needed"], 0),
    "spheres that fit the box are not told": (
        SMALL.replace("diameter 1.0", "diameter 0.12") + fix("scale 0.001", mesh="in_mm.stl") + "run 0\n", ["no such sphere fits"], 0),
    "a sphere that sank in a step too long is told to shorten it": (FAST, ["sank into the wall", "use a shorter one first"], 1),
    "... and of no stiffer contact": (FAST, ["stiffer contact (a larger kn)"], 0),
    "a group of points is told once": (twice(BOX + "unfix move\nset group all diameter 0\n" + fix()),
                                       ["WARNING: Fix w", "all 1 atoms of group all have radius 0", "set diameter"], 1),
    "a mesh that leaves the box is told once, with the step": (
        twice(BOX + fix("motion linear 0 0 -450"), "run 4\n"), ["WARNING: Fix w", "has moved out of the box", "in step 4"], 1),
    "one that has yet to come in is not": (BOX + fix("move 0 0 9 motion linear 0 0 -450") + "run 8\n", ["has moved out of"], 0),
    "a mesh that will turn out of the box is told once": (twice(BOX + fix(TURNED.format("0 1 0"))), OUT, 1),
    "one that turns within it is not": (BOX + fix(TURNED.format("0 0 1")) + "run 0\n", ["will turn out of"], 0),
    "the same mesh in two fixes is told once": (twice(BOTH + fix(name="lid")), TWICE, 1, 2),
    "at another place it is not": (BOTH + fix(name="lid", more="move 0 0 1e-3") + "run 0\n", TWICE, 0),
    "in groups that share an atom it is": (BOTH + OF_ONE + "run 0\n", TWICE, 1),
    "in groups that share none it is not": (BOTH.replace(" all wall", " none wall") + OF_ONE + "run 0\n", TWICE, 0),
    # Costs are those of another machine: doc/effects.md has them, with its name.
    "the log lists effects": (BOX + fix() + "run 0\n", ["  effects     normal spring, normal damping"], 1),
    "... without times": (BOX + fix() + "run 0\n", [" ns"], 0),
    # Laws that LAMMPS's own fix wall/gran computes otherwise, in every version that was tried.
    "the log names what fix wall/gran computes otherwise": (
        BOX + fix(law="granular hertz 1e6 0.5 tangential mindlin 1e6 1 0.3 damping tsuji") + "run 0\n",
        [OTHER, "damping tsuji lacks a factor of sqrt(2)"], 1),
    "and nothing where that agrees": (BOX + fix(law="granular hertz 1e6 0.5 tangential mindlin 1e6 1 0.3") + "run 0\n", [OTHER], 0),
    "a law that some versions compute otherwise": (
        BOX + fix(law="hertz/history 1e6 NULL 5 NULL 0.5 1") + "run 0\n", [OTHER], int(lmp.has_wrong_walls())),
    "the log says which damping acts where none is named": (
        BOX + fix(law="granular hertz 1e6 0.5 tangential mindlin 1e6 1 0.3 limit_damping") + "run 0\n",
        ["  contact ", "no damping is named: viscoelastic, with the coefficient 0.5"], 1),
    "and nothing where one is": (BOX + fix(law="granular hertz 1e6 0.5 tangential mindlin 1e6 1 0.3 damping velocity") + "run 0\n", ["is named"], 0),
    "words that say the default are taken without a word": (BOX + fix(DEFAULTS) + "run 0\n", ["WARNING"], 0),
    "a run has as many steps as were asked for": (
        BOX + fix() + "run 1\nrun 4 pre no\n", ["Fix w wall/lsdcd: 1 step and the setup: atoms near the wall searched for 1 time, "
                                                "wall neighbor lists made 1 time, 1.00 mesh features each"], 1),
    "and no setup where it had none": (BOX + fix() + "run 1\nrun 4 pre no\n", ["Fix w wall/lsdcd: 4 steps: atoms near"], 1),
    "log brief is one line": (BOX + fix("log brief nearest 3") + "run 4\n", ["wall/lsdcd:"], 1),
    "... without lists": (BOX + fix("log brief nearest 3") + "run 4\n", ["candidates"], 0),
    "the log tells once why lines may not be seen": (
        BOX + fix() + "dump p all image 1 p.*.ppm type type fix w type 0 0 size 64 64\nrun 2\n", ["dump image draws", "diameter is 0"], 1),
}


def test_said(folder):
    logs = {}    # of scripts that several facts are of
    for name, (script, words, times, *ranks) in SAID.items():
        if (script, *ranks) not in logs:
            logs[script, *ranks] = lmp.run_well(script, folder, *ranks)
        log = logs[script, *ranks]
        fact(name, len(lines(log, *words)) == times, log[-600:])


def test_surfaces_that_push(folder):
    """Along their normals."""
    turning = "surface_angvel 0 0 3"
    for ranks in (1, 2):
        text = lmp.run_well(BOX + fix(turning, mesh="lifters.stl") + "run 1\n", folder, ranks)
        told = lines(text, "WARNING: Fix w wall/lsdcd:", "push 8 of 80 faces")
        fact(f"lifters are told once on {ranks} ranks", len(told) == 1)
        told = told or [""]
        # At the middle of a triangle with two corners outside.
        speed = 3 * (2.0 - 0.4 / 3)
        fact("with the largest speed", f"up to {speed:g} (100 %" in told[0], told[0][:200])
        fact("and what to do", "stays where it is" in told[0] and
             "use the keyword motion" in told[0])


def test_whose_errors(folder):
    done = lmp.run(BOX + fix(name="base", more="sclae 2") + "run 1\n", folder)
    fact("an error names the fix", "Fix base wall/lsdcd: 'sclae'" in done.stdout)
    grow = ("variable d equal 1.0+0.4*(step>2)\nfix grow all adapt 1 atom diameter v_d\n"
            "neigh_modify delay 1000 check no\n")
    done = lmp.run(BOX.replace("sphere\n", "sphere 1\n", 1) + grow + fix("rmax 0.6") + "run 10\n",
                   folder)
    message = done.stdout[done.stdout.find("ERROR"):][:300]
    fact("an engine's error names the atom's ID",
         done.returncode != 0 and "Fix w wall/lsdcd: " in message and "atom 2 " in message,
         message)


def test_uncertified(folder):
    """nearest: after the first run, and when ten times as many answers were not certified; here
    one in every step and one at every start. f_ID[9] has how many there are now."""
    every = (BOX + "unfix move\nset group all x 0.45 y 0.44 z 0.43\n" +
             fix("nearest 1 grid 0.1", mesh="corner.stl") +
             "run {} every 2 NULL\nprint 'not certified now: $(f_w[9])'\n")
    for steps, times in ((2, 1), (10, 1), (100, 2)):
        text = lmp.run_well(every.format(steps), folder)
        fact("f_ID[9] counts the answer", len(lines(text, "not certified now: 1")) == 1)
        told = lines(text, "not certified exact")
        fact(f"nearest is told {times} times in {steps} steps, two a part",
             len(told) == times, "\n".join(told))


def test_squeezed_through(folder):
    """A plate goes down through the floor, with a sphere in between."""
    text = lmp.run(BOX + "set group all x 0 y 0 z 0.5\n" + fix("mesh floor.stl move 0 0 1 motion linear 0 0 -3") +
                   "thermo 100\nrun 3000\n", folder, ranks=2).stdout
    through = "sank into the wall by 99.9705 % of its radius 0.5 in step 332, pressed by mesh 1 'floor.stl' and mesh 2 'floor.stl'"
    fact("a sphere that is squeezed through a mesh is named with both before it is lost", len(lines(
        text.split("ERROR: Lost atoms")[0], "WARNING: Fix w", "atom 2", through)) == 1 and "Lost atoms" in text, text[-2000:])


def test_why_no_cuda(folder):
    """Why there is no CUDA, as the build was configured."""
    text = lmp.run_well(BOX + fix() + "run 0\n", folder)
    cache = lmp.LIB.parent / "CMakeCache.txt"
    left_out = "LSDCD_CUDA:BOOL=OFF" in cache.read_text() if cache.exists() else None
    if left_out is not None:
        device = lines(text, "  device      ")[0]
        fact("the log tells a build without the CUDA engine from one without its toolkit",
             ("left out of this build by LSDCD_CUDA=OFF" in device) == left_out and
             not (left_out and "toolkit" in device), device)

    release = re.search(r"^project\(lsdcd VERSION (\S+)", (lmp.HERE.parents[1] / "CMakeLists.txt").read_text(), re.M)[1]
    fact("the log has the version", lines(text, "  version     ") == ["  version     " + release])


def test_times(folder):
    """Where its time went; radii grow, and with them the grid."""
    grow = "variable d equal 1.0+0.4*(step>2)\nfix grow all adapt 1 atom diameter v_d\n"
    timed = BOX.replace("sphere\n", "sphere 1\n", 1) + grow + fix("mesh_stl timed_*.stl every 2 {}") + "run {}\n"

    def table(more, steps):
        text = lmp.run_well(timed.format(more, steps), folder)
        title = lines(text, "timing breakdown of the wall")
        return title, [line.split("|") for line in text.split("\n") if re.match(r"  \w+ +\| [\d.]", line)]

    title, rows = table("", 10)
    fact("a run ends with the wall's times",
         len(title) == 1 and re.search(r"^Fix w wall/lsdcd: .*, [\d.]+ % of the loop time:$", title[0]) and
         [row[0].strip() for row in rows if "Waiting" not in row[0]] == ["Search", "Forces", "Grids", "Files"],
         f"{title} {rows}")
    shares, of_loop = (sum(float(row[column]) for row in rows) for column in (5, 6))
    rounding = 0.005 * len(rows) + 1e-9
    at_most("their shares add up to 100 %", abs(shares - 100), rounding)
    told = float(re.search(r"(\S+) % of", title[0])[1])
    at_most("and those of the loop to that of the wall", abs(of_loop - told), rounding + 0.005)
    fact("no more than which it is", 0 < told < 100)
    for what, more, steps in (("log brief", "log brief", 10), ("a run of 0 steps", "", 0)):
        fact(f"{what} has no such times", table(more, steps) == ([], []))


def test_files_of_fields(folder):
    """Files of fields: before the run, and nothing is left by the look."""
    done = lmp.run(BOX + fix("mesh_fields no/such.vtp every 1000") + "print ran\nrun 1\n", folder)
    fact("mesh_fields into a missing folder stops before the run",
         done.returncode != 0 and "no/such.vtp" in done.stdout and
         "make the folder" in done.stdout and "Step" not in done.stdout,
         done.stdout[-300:])
    (folder / "out").mkdir()
    lmp.run_well(BOX + fix("mesh_fields out/f_*.vtp every 1000") + "run 1\n", folder)
    fact("the look at the folder leaves nothing", not list((folder / "out").iterdir()))


def test_lists_that_last_too_short(folder):
    """A grain that goes half the skin in each step or two."""
    lmp.flat_floor(folder)
    text = lmp.run_well(BOX + "neighbor 0.001 bin\n" + fix() + "velocity all set 0.5 0 0\nrun 1000\nrun 1000\n", folder)
    said = re.findall(r"lists lasted only \S+ steps: a skin of (\S+) would serve in place of 0.001", text)
    fact("a run says so once", len(said) == 1, said)
    # So many times as long as 20 steps are of what LAMMPS counted; two digits are written.
    builds = int(re.search(r"Neighbor list builds = (\d+)", text).group(1))
    at_most("with the skin for 20 steps", abs(float(said[0]) / (0.001 * 20 * builds / 1000) - 1), 0.05)


def test_lists_that_others_force(folder):
    lmp.flat_floor(folder)
    text = lmp.run_well(BOX + fix() + "fix even all balance 2 1.0 shift x 5 1.1\nvelocity all set 0.1 0 0\nrun 1000\n", folder)
    builds = int(re.search(r"Neighbor list builds = (\d+)", text).group(1))
    fact("lists that fix balance makes say nothing of the skin", builds >= 499 and "lists lasted" not in text, builds)
