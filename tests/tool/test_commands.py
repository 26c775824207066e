# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Every command of lsdcd through its command line: its help has an example that works, its words are
taken and others refused, and a table of good and bad uses does what it should. A new command needs a
row in NEEDS and in GOOD. LSDCD_QUICK=1 has another example of `accuracy`, whose own makes fine grids for 35 s."""
import json
import math
import os
import re
import shlex
import subprocess

import stl
from command import TOOL, refused, run
from facts import at_most, fact
from triangles import cube

# What is missing where a command stands alone.
NEEDS = {"inspect": "file is required", "repair": "file is required", "convert": "file is required",
         "generate": "subcommand is required", "grid": "file is required", "distance": "mesh is required", "collide": "wall is required",
         "material": "file is required", "timestep": "--radius is required", "shape": "lengths is required",
         "clump": "give a mesh and --spheres, or --list", "tradeoff": "file is required", "accuracy": None, "effects": None, "check": None,
         "report": "required: folder", "film": "required: folder"}
# Words that make an example quick.
QUICK = {"tradeoff": "--spheres 100 --moving 2 --repeats 1 --seconds 0.2 --device cpu --plot none", "check": "--seconds 0"}

FINE_GRIDS = "accuracy table2 --spheres 1e5 --csv table2.csv"    # the example in its help
ACCURACY = (FINE_GRIDS, ["0.994025", "table2.csv"])
if os.environ.get("LSDCD_QUICK"):
    ACCURACY = ("accuracy mesh --spheres 1000 --repeats 1 --most-triangles 200 --csv mesh.csv", ["0.4 3 ", "mesh.csv"])
# A table without a mesh: its title.
NO_MESH = "accuracy mesh --spheres 1000 --most-triangles 100"

# Words, and what is printed; of --json, keys.
GOOD = [
    ("inspect wall.stl", ["facets      12", "closed, normals point out", "clean       yes"]),
    ("inspect wall.stl --matrix 2 0 0 5 0 0 2 6 0 -2 0 7 --json", {"facets": 12, "volume": 8, "closed": True, "clean": True}),
    ("inspect wall.stl --scale 2 --json", {"facets": 12, "volume": 8, "closed": True, "clean": True}),
    ("inspect apart.stl --weld 0.01 --json", {"vertices": 8, "closed": True}),
    ("inspect apart.stl --json", {"vertices": 9, "closed": False, "clean": True}),
    ("inspect two.stl", ["normals of some shells point in", "no: 12 facets of closed shells wound against the others"]),
    ("inspect cut.stl", ["closed, but cuts or touches itself", "pairs of facets that cut or touch"]),
    ("inspect knot.stl", ["closed, but cuts or touches itself"]),
    ("inspect cut.stl --json", {"closed": True, "oriented": False, "clean": False}),
    ("distance knot.stl points.csv --radius 1 -o d.csv --json", {"sides": True}),
    ("distance two.stl points.csv --radius 1 -o d.csv --json", {"sides": True}),
    ("grid wall.stl --radius 0.1", ["mesh wall.stl", "cutoff 0.1"]),
    ("grid wall.stl --radius 0.1 --grid 0.25 --json", {"length": 0.25, "cutoff": 0.1}),
    ("repair apart.stl --weld 0.01 -o mended.stl --json", {"welded_corners": 3, "moved": 0.005, "left": []}),
    ("convert wall.stl -o wall.off", ["wall.off: 12 facets from (0, 0, 0) to (1, 1, 1)"]),
    ("generate box --width 1 --depth 2 --height 3 -o made.stl --json", {"volume": 6}),
    ("distance wall.stl points.csv --radius 1 -o d.csv --json", {"points": 2, "found": 1}),
    ("collide wall.stl body.stl --pose 0.5 0.5 0.5", ["collides    yes", "12 triangles"]),
    ("collide wall.stl body.stl --pose 3 0 0 --json", {"poses": 1, "colliding": 0, "pairs": 0}),
    ("material glass.lsdcd", ["material glass", "density", "kg/m3"]),
    ("material glass.lsdcd glass --on aluminium", ["granular hertz/material", "tangential"]),
    ("material glass.lsdcd glass --normal dmt --with surface_energy 0.5", ["granular dmt 6.9e+10 0 0.23 0.5"]),
    ("material glass.lsdcd glass --units cgs --with restitution 0.5", ["hertz/material 6.9e+11 0.5 0.23"]),
    # G = 2e6 and nu = 0.25: pi 0.002 sqrt(2500 / 2e6) / 0.917375.
    ("timestep --young 5e6 --poisson 0.25 --density 2500 --radius 0.002 --speed 1",
     ["Rayleigh time      0.0002422", "timestep           2.72e-05    set by the impact of grain on grain",
      "kn 3.55556e+06 on grains", "Overlaps exceed 0.05"]),
    ("timestep --young 5e6 --poisson 0.25 --density 2500 --radius 0.003 0.002 --speed 0.001",
     ["smallest radius    0.002\n", "timestep           4.84e-05    set by the Rayleigh time"]),
    # 16 times the speed takes 16^(-1/5) of the time: 0.0006256 -> 0.0003593.
    ("timestep --young 5e6 --poisson 0.25 --density 2500 --radius 0.002 --speed 1 --wall-speed 15",
     ["16         0.0003593", "set by the impact on the wall"]),
    # A wall that does not yield has twice the E* of two grains.
    ("timestep --young 5e6 --poisson 0.25 --density 2500 --radius 0.002 --speed 1 --wall-young 1e30",
     ["3.55556e+06 on grains, 7.11111e+06 on the wall"]),
    ("timestep glass.lsdcd glass --on steel --radius 0.001 --speed 1", ["set by the Rayleigh time"]),
    # A sphere of radius 1 and mass 3 on a spring of 12: pi sqrt(3/12) at a wall, a tenth of that over sqrt(2).
    ("shape 2 2 2 --density 0.716197244 --kn 12", ["volume             4.1887902 ", "mass               3\n", "least mass         1 of", "contact            1.571 at a wall, 1.111 between two", "timestep           0.111 ",
                                                  "set group all shape 2 2 2\n"]),
    # J = (a^2 + c^2)/5 across the axis, and a normal's longest arm is c - a: 1/(1 + 5 16/26).
    ("shape 2 2 10 --json", {"volume": 20.943951023931955, "inertia_over_mass": [5.2, 5.2, 0.4], "curvature_radius": 0.2, "circumscribed_radius": 5}),
    ("shape 2 2 10", ["least mass         0.2453 of", "half-axes          1 1 5, block 2 2"]),
    # 2 a b c e1 e2 B(e1/2 + 1, e1) B(e2/2, e2/2) with e = 2/n.
    ("shape 6 4 2 --block 4 8 --density 1", ["volume             41.0492894", "set group all block 4 8"]),
    # Two spheres of radius 1, 1 apart: twice 4/3 pi less a lens of 5/12 pi.
    ("clump --list pair.txt --json", {"volume": 9 / 4 * math.pi, "spheres": 2, "covered": 1, "radius": 1.5}),
    ("clump --list pair.txt --scale 0.1 --density 2000 -o pair.mol", ["mass               14.1371669 ", "centre of mass     0.25 0 0\n", "left out           1 sphere of the list", "pair.mol: a molecule of 2 spheres"]),
    ("clump wall.stl --spheres 2 --least-radius 0.49", ["spheres            1, radii 0.49999", "volume           1    -47.6 %"]),
    ("clump wall.stl --list pair.txt", ["volume           1    +607 %"]),
    ("tradeoff wall.stl --radius 0.1 " + QUICK["tradeoff"], ["default", "rows in tradeoff.csv"]),
    ACCURACY,
    # Between grains: the number of the pair in the list and three numbers, with a rolling model three more; none of a belt.
    ("effects", ["hooke", "B/contact    B/pair", "56        32  hertz/history", "80        56  rolling sds", "0         -  surface_vel"]),
    # Other programs are those of test_check.
    ("check --seconds 0", ["CPU step  works", "All that is here works."]),
    ("check --seconds 0 --json", {"works": True}),
    # The same numbers for programs.
    ("timestep --young 5e6 --poisson 0.25 --density 2500 --radius 0.002 --speed 1 --json",
     {"smallest_radius": 0.002, "set_by": "the impact of grain on grain", "too_soft": True}),
    ("material glass.lsdcd glass --on aluminium --json", {}),
    ("effects --json", {}),
    ("report . -o page.html", ["page.html: 0.0"]),
    ("film . --width 60 --height 60 -o still.gif", ["still.gif: 1 frame"]),
]

NO_FILE = "No such file or directory"
BAD = [    # words, exit code, what is said
    ("grid wall.stl", 2, ["--radius is required"]),
    ("grid wall.stl --radius 0", 2, ["--radius", "0 is not a number above 0"]),
    ("grid wall.stl --radius big", 2, ["--radius", "big"]),
    ("grid wall.stl --radius 1 --grid -1", 2, ["--grid", "-1"]),
    ("grid wall.stl --radius 1 --memory 0", 2, ["--memory", "0"]),
    ("grid wall.stl --radius 0.1 --memory 0.001", 1, ["memory budget", "MB: give that"]),
    ("repair wall.stl", 2, ["--output is required"]),
    ("repair wall.stl -o no/there.stl", 1, ["no/there.stl", NO_FILE]),
    ("convert wall.stl -o wall.png", 1, ["wall.png", ".stl, .obj, .ply or .off"]),
    ("generate cube", 2, ["'cube' is not a command", "box"]),
    ("distance wall.stl", 2, ["points is required"]),
    ("distance wall.stl nowhere.csv --radius 1 -o d.csv", 1, ["nowhere.csv", NO_FILE]),
    ("distance wall.stl points.csv --radius 1 -o d.txt", 1, ["d.txt", ".csv", ".npy"]),
    ("distance wall.stl points.csv --radius -1 -o d.csv", 2, ["--radius", "-1"]),
    ("collide wall.stl", 2, ["body is required"]),
    ("collide wall.stl body.stl --pose 0 0", 2, ["--pose"]),
    ("collide wall.stl body.stl --pose 0 0 0 2 0 0 0", 2, ["quaternion"]),
    ("material nothing.lsdcd", 1, ["nothing.lsdcd", "glass.lsdcd"]),
    ("material glass.lsdcd glas", 1, ["glas", "glass"]),
    ("material glass.lsdcd glass --with restituion 0.5", 1, ["'restituion' is not a property", "'restitution'", "[--with"]),
    ("material glass.lsdcd glass --kn 1000", 2, ["--kn and --mass"]),
    ("material glass.lsdcd glass --units miles", 2, ["miles", "cgs"]),
    ("material glass.lsdcd glass --normal hooke", 2, ["hooke", "hertz/material"]),
    ("timestep --radius 1 --speed 1", 2, ["--young", "material file"]),
    ("shape 1 1", 2, ["lengths"]),
    ("shape 1 1 0", 2, ["lengths", "0 is not a number above 0"]),
    ("shape 1 1 1 --kn 5", 2, ["--kn", "--density"]),
    ("shape 1 1 1 --block 1.5 2", 1, ["exponent", "1.5", "from 2, an ellipsoid, to 20"]),
    ("clump wall.stl", 2, ["--spheres: is required"]),
    ("clump wall.stl --spheres 0", 2, ["--spheres", "0 not in range 1 to 100000"]),
    ("clump wall.stl --spheres 2 --list pair.txt", 2, ["--list", "--spheres"]),
    ("clump --list pair.txt --principal", 2, ["--principal: is of the molecule file: give --output"]),
    ("clump --list pair.txt --type 2", 2, ["--type: is of the molecule file: give --output"]),
    ("clump wall.stl --spheres 2 --stick-out 1", 2, ["--stick-out", "below 1"]),
    ("clump wall.stl --spheres 2 --density 0", 2, ["--density", "0 is not a number above 0"]),
    ("clump wall.stl --spheres 2 --least-radius 0.6", 1, ["wall.stl", "radius of 0.6", "smaller --least-radius"]),
    ("clump two.stl --spheres 2", 1, ["two.stl", "12 facets of closed shells wound against the others", "lsdcd repair"]),
    ("clump cut.stl --spheres 2", 1, ["cut.stl", "pairs of facets that cut or touch each other", "unite parts"]),
    ("clump open.stl --spheres 2", 1, ["open.stl", "3 edges are open"]),
    ("clump --list pair.txt --stick-out 0.1", 2, ["--stick-out", "a list is taken as it is"]),
    ("clump --list pair.txt --scale 1 2 3", 2, ["--scale", "one factor above 0"]),
    ("clump --list pair.txt --matrix 1 0 0 0 0 1 0 0 0 0 1 0", 2, ["--matrix", "lsdcd convert"]),
    ("clump --list pair.txt -o pair.txt", 1, ["would replace pair.txt"]),
    ("clump --list pair.txt -o no/pair.mol", 1, ["no/pair.mol", NO_FILE]),
    ("clump --list points.csv", 1, ["points.csv: line 1 has 3 columns", "x y z radius"]),
    ("clump --list flat.txt", 1, ["flat.txt: line 3 has a radius of -1", "above 0"]),
    ("clump --list empty.txt", 1, ["empty.txt", "no spheres"]),
    ("timestep --radius 0 --speed 1", 2, ["--radius", "0 is not a number above 0"]),
    ("timestep --radius 1", 2, ["--speed is required"]),
    ("timestep --radius 1 --speed 1 --poisson 0.6", 2, ["--poisson", "0.6"]),
    ("timestep --radius 1 --speed 1 --on steel", 2, ["--on", "material of a file"]),
    ("timestep glass.lsdcd --radius 1 --speed 1", 2, ["name"]),
    ("timestep glass.lsdcd glas --radius 1 --speed 1", 1, ["glas", "glass"]),
    ("tradeoff wall.stl --radius 0.1 --csv no/t.csv", 1, ["no/t.csv", NO_FILE]),
    ("tradeoff wall.stl", 2, ["--radius is required"]),
    ("tradeoff wall.stl --radius x", 2, ["--radius", "x"]),
    ("tradeoff wall.stl --radius -1", 2, ["--radius", "-1"]),
    ("tradeoff wall.stl --radius 1 --below 0", 2, ["--below", "0 is not a number above 0"]),
    ("tradeoff wall.stl --radius 1 --seconds 0", 2, ["--seconds", "0 is not a number above 0"]),
    ("generate box --width 1e-9 --depth 1e-9 --height 1e-9 --edge 1e-14 -o made.stl", 1, ["--edge 1e-14"]),
    ("distance wall.stl points.csv --radius -1e-9 -o d.csv", 2, ["--radius", "-1e-9 is not a number above 0"]),
    ("accuracy table9", 2, ["table9", "table2"]),
    ("accuracy --spheres 0", 2, ["0 is not a number from 1 to"]),
    ("accuracy --spheres 1000 --segments 2", 2, ["--segments", "3"]),
    ("accuracy --spheres 1000 --repeats 0", 2, ["--repeats"]),
    ("accuracy --spheres 1000 --csv no/a.csv", 1, ["no/a.csv", NO_FILE]),
    ("check --seconds -1", 2, ["--seconds", "-1 is not a number of 0 or more"]),
    ("check --lmp ./nowhere", 1, ["--lmp ./nowhere: there is no such file"]),
    ("check --plugin nowhere.so", 1, ["--plugin nowhere.so: there is no such file"]),
    ("effects --measure", 2, ["'--measure' is not an option of lsdcd effects"]),
    ("inspect wall.stl --scal 2", 2, ["'--scal' is not an option of lsdcd inspect", "'--scale'"]),
    ("inspect wall.stl --colour red", 2, ["'--colour' is not", "lsdcd inspect --help"]),
    ("grid wall.stl --radiu 1", 2, ["'--radiu'", "'--radius'"]),
    ("generate box --widht=1", 2, ["'--widht' is not an option of lsdcd generate box", "'--width'"]),
    ("--versio", 2, ["'--versio' is not an option of lsdcd;", "'--version'"]),
    ("tradeoff wall.stl --radius 1 --device tpu", 2, ["--device", "cuda"]),
]
# Of all that read a mesh.
OF_A_MESH = ["inspect {}", "grid {} --radius 1", "tradeoff {} --radius 1", "distance {} points.csv --radius 1 -o d.csv",
             "repair {} -o new.stl", "collide {} body.stl", "convert {} -o new.stl", "clump {} --spheres 2 -o new.mol"]
BAD += [(f"{command.format(mesh)} {words}", code, said) for mesh, words, code, said, commands in (
    ("nowhere.stl", "", 1, ["nowhere.stl", NO_FILE], OF_A_MESH),
    ("text.stl", "", 1, ["text.stl", "not an STL"], OF_A_MESH),
    ("/dev/zero", "", 1, ["/dev/zero", "it is a device"], OF_A_MESH[:1]),
    ("line.stl", "", 1, ["line.stl", "its 1 facet has no area"], OF_A_MESH[1:6]),
    ("wall.stl", "--scale 1 2", 2, ["one factor or three"], OF_A_MESH[:4] + OF_A_MESH[5:]),
    ("wall.stl", "--scale 0", 2, ["--scale", "0 is not a number other than 0"], OF_A_MESH[:4] + OF_A_MESH[5:]),
    ("wall.stl", "--matrix 1 0 0 0 0 1 0 0", 2, ["--matrix", "12"], OF_A_MESH[:4] + OF_A_MESH[5:]),
    ("wall.stl", "--matrix 1 2 3 0 2 4 6 0 0 0 1 0", 2, ["--matrix: the determinant of the rows 1 2 3, 2 4 6, 0 0 1 is 0"], OF_A_MESH[:4] + OF_A_MESH[5:]),
    ("wall.stl", "--weld -1", 2, ["--weld", "-1"], OF_A_MESH[:6]),
    ("wall.stl", "--weld 9", 1, ["weld tolerance of 9"], OF_A_MESH[:6]),
) for command in commands]


def same(value, wanted):
    return abs(value - wanted) <= 1e-6 * abs(wanted) if isinstance(wanted, float) else value == wanted


def scene(folder):
    box = cube()
    for name in ("wall.stl", "body.stl"):
        stl.write(folder / name, box)
    stl.write(folder / "two.stl", [*box, *cube(at=(3, 0, 0))[:, ::-1]])    # the second inside out
    stl.write(folder / "cut.stl", [*box, *cube(at=(0.5, 0.5, 0.5))])
    knot = box.copy()
    knot[(knot == 0).all(axis=2)] = (2, 0.5, 0.25)    # a corner, through the face across
    stl.write(folder / "knot.stl", knot)
    box[0, 0] += (0.003, 0.004, 0)
    stl.write(folder / "apart.stl", box)
    stl.write(folder / "line.stl", [[(0, 0, 0), (1, 0, 0), (2, 0, 0)]])
    stl.write(folder / "open.stl", cube()[1:])
    (folder / "points.csv").write_text("0.5,0.5,1.25\n9,9,9\n")
    (folder / "pair.txt").write_text("x y z radius\n2 0 0 1\n3 0 0 1    \n# within the first\n2 0.2 0 0.5\n")
    (folder / "flat.txt").write_text("0,0,0,1\n\n1,0,0,-1\n")
    (folder / "empty.txt").write_text("# nothing\n")
    (folder / "text.stl").write_text("no mesh at all\n")
    (folder / "log.lammps").write_text("units si\ntimestep 1e-5\nStep KinEng\n0 1\n100 2\nLoop time of 1\nTotal wall time: 0:00:01\n")
    (folder / "grains.dump").write_text("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
                                        "ITEM: ATOMS id type x y z radius\n1 1 0.5 0.5 0.5 0.1\n")
    run(folder, "convert", "wall.stl", "-o", "wall.obj")


def check_full_output(folder, commands):
    """Of each command one use that prints a text, one that prints JSON, and its help, on a full disk: 1 s."""
    uses = {(words.split()[0], "--json" in words): words for words, _ in reversed(GOOD)}
    uses = [words.replace("--seconds 0.2", "--seconds 0.01").replace(ACCURACY[0], NO_MESH) for words in uses.values()]
    with open("/dev/full", "wb") as full:
        for words in [*uses, *(f"{command} --help" for command in commands), "generate box --help", "--help", "--version"]:
            done = subprocess.run([TOOL, *words.split()], cwd=folder, stdout=full, stderr=subprocess.PIPE, text=True)
            fact(f"a full output fails: {words}", done.returncode == 1 and
                 "lsdcd: the standard output: " in done.stderr, (done.returncode, done.stderr[-200:]))


def check_json(folder, commands):
    """Every command has --json, as doc/tool.md says, but those that write CSV, HTML and pictures."""
    for command in sorted(set(commands) - {"tradeoff", "accuracy", "report", "film"}):
        words = [command, "box"] if command == "generate" else [command]
        fact(f"{command} has --json", "--json" in run(folder, *words, "--help").stdout)
    materials = json.loads(run(folder, "material", "glass.lsdcd", "--json").stdout)["materials"]
    fact("values of materials have units and sources", "glass" in [material["first"] for material in materials] and
         all(set(said) == {"value", "unit", "source"} for material in materials for said in material["properties"].values()))
    (folder / "latin.lsdcd").write_bytes("units si\nmaterial clay\nyoungs_modulus 5e6 Pa # Müller\n".encode("latin-1"))
    latin = run(folder, "material", "latin.lsdcd", "--json")
    fact("a source that is no UTF-8 is shown without its byte", latin.returncode == 0 and json.loads(latin.stdout)["materials"][0][
        "properties"]["youngs_modulus"]["source"] == "M\ufffdller", latin.stderr)
    check_linear(folder)
    both = [run(folder, *"material glass.lsdcd glass --on aluminium".split(), *more).stdout for more in ([], ["--json"])]
    fact("and the words for a script are the same", " ".join(json.loads(both[1])["words"]) in both[0], both[1])


def check_linear(folder):
    """The words of a linear spring return the restitution, by its equation of motion in small steps, of a grain at a wall (its mass m), of two
    (m/2) and of two unlike ones; friction and Poisson's ratio are the file's."""
    for e in (0.1, 0.5, 0.83, 0.97):
        for masses, effective in (((1.4e-5,), {"wall": 1.4e-5, "two grains": 0.7e-5}), ((1e-5, 3e-5), {"grains of both masses": 0.75e-5})):
            told = json.loads(run(folder, *f"material glass.lsdcd glass --with restitution {e} --kn 1000 --mass".split(), *map(str, masses),
                                  "--json").stdout)["linear"]
            fact(f"restitution {e}, masses {masses}: words", set(told) == set(effective), told)
            for of, mass in effective.items():
                words = told[of].split()
                k, gamma, kt, mu = (float(words[i]) for i in (1, 2, 5, 7))
                z, v, dt = 0.0, -1.0, 1e-3 / math.sqrt(k / mass)
                while z < 0 or v < 0:    # by the middle of each step, of second order
                    zm, vm = z + dt / 2 * v, v + dt / 2 * (-k / mass * z - gamma * v)
                    z, v = z + dt * vm, v + dt * (-k / mass * zm - gamma * vm)
                # The release is found to a step of 1e-3 of a radian, in which the speed changes by gamma dt at most.
                at_most(f"restitution {e}, {of}", abs(v / e - 1), gamma * dt + 1e-5)
                fact(f"restitution {e}, {of}: other words", words[:1] + words[3:5] + words[8:] == ["hooke", "tangential", "linear_history", "damping", "mass_velocity"]
                     and abs(kt / k - 2 * 0.77 / 1.77) < 1e-5 and mu == 0.092, told[of])


def test_commands(folder):
    scene(folder)
    said = run(folder, "--help").stdout
    alone = run(folder)
    fact("lsdcd alone prints its help", alone.returncode == 0 and alone.stdout == said, alone.stdout[:300] + alone.stderr)
    commands = re.findall(r"^  ([a-z]+)  ", said.split("Subcommands:")[1], re.M)
    fact("every command has a row here", set(commands) == set(NEEDS) == {g[0].split()[0] for g in GOOD},
         set(commands) ^ set(NEEDS))
    listed = said.split("Subcommands:\n")[1].split("\n\n")[0].splitlines()
    fact("each has one line in --help", len(listed) == len(commands), listed)
    for command in commands:
        done = run(folder, command, "--help")
        examples = re.findall(r"^  lsdcd (.*)$", done.stdout, re.M)
        fact(f"{command} --help has one example", done.returncode == 0 and len(examples) == 1 and
             (examples[0] + " ").startswith(command + " "), examples)
        words = (examples[0] + " " + QUICK.get(command, "")).strip()
        if words not in [FINE_GRIDS, *(row[0] for row in GOOD)]:    # those are run below
            alone = folder / f"of-{command}"
            alone.mkdir()
            scene(alone)
            done = run(alone, *shlex.split(words))
            fact(f"and it works: {words}", done.returncode == 0, done.stderr[-300:])
        if NEEDS[command]:
            refused(folder, [command], NEEDS[command], code=2)
        refused(folder, [command, "--bogus"], code=2)

    for words, wanted in GOOD:
        done = run(folder, *words.split())
        if "--json" in words:
            all_of = json.loads(done.stdout)
            holds = bool(all_of) and all(same(all_of[key], value) for key, value in wanted.items())
        else:
            holds = all(text in done.stdout for text in wanted)
        fact(words, done.returncode == 0 and holds, done.stderr + done.stdout[:0 if holds else 2000])
    for words, code, wanted in BAD:
        refused(folder, words.split(), *wanted, code=code)
    check_full_output(folder, commands)
    check_json(folder, commands)
