#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""examples/from-liggghts/convert.py: what it writes and leaves; with `run`, that what it writes gives a port's figures."""
import re
import subprocess
import sys

import lmp

EXAMPLE = lmp.HERE.parent.parent / "examples" / "from-liggghts"
MATERIAL = """\
fix m1 all property/global youngsModulus peratomtype 1e7
fix m2 all property/global poissonsRatio peratomtype 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.5
fix m4 all property/global coefficientFriction peratomtypepair 1 0.4
"""
MESH = "fix cad all mesh/surface/stress file a.stl type 1 {}\n"
WALL = "fix w all wall/gran model hertz tangential history mesh n_meshes 1 meshes cad\n"
# What is written, whole or in part, for what.
WRITTEN = {
    "placement keeps its order": (MESH.format("move 1 0 0 scale 2 rotate axis 0 0 1 angle 90 heal auto_remove_duplicates "
                                              "curvature 3") + WALL,
                                  "mesh a.stl move 1 0 0 scale 2 rotate 0 0 1 90\n"),
    "a surface turns with omega along the axis": (
        MESH.format("surface_ang_vel origin 1 2 3 axis 0 0 2 omega 5") + WALL, "surface_angvel 0 0 5 1 2 3"),
    "a motion before the wall stands in it": (
        MESH.format("") + "fix t all move/mesh mesh cad rotate origin 1 2 3 axis 0 1 0 period 4\n" + WALL,
        "mesh a.stl motion rotate 1 2 3 0 1 0 4"),
    "a motion after the wall changes it": (
        MESH.format("") + WALL + "fix t all move/mesh mesh cad wiggle amplitude 1 0 0 period 4\nunfix t\n",
        "fix_modify      w motion wiggle 1 0 0 4\nfix_modify      w motion none"),
    "of two motions the first comes last": (
        MESH.format("") + WALL + "fix t all move/mesh mesh cad linear 1 0 0\n"
        "fix u all move/mesh mesh cad rotate origin 1 2 3 axis 0 1 0 period 4\n",
        "fix_modify      w motion rotate 1 2 3 0 1 0 4 motion linear 1 0 0"),
    "loads get their new names": (MESH.format("") + WALL + "thermo_style custom step f_cad[3]\n", "step f_w[3]"),
    "wear is doubled": ("fix k all property/global k_finnie peratomtypepair 1 1e-9\n" + MESH.format("wear finnie") + WALL,
                        "wear finnie 2e-09"),
    "a mesh that does not wear says so": (
        "fix k all property/global k_finnie peratomtypepair 1 1e-9\n" + MESH.format("wear finnie") +
        MESH.replace("cad", "lid").replace("a.stl", "b.stl").format("") +
        WALL.replace("n_meshes 1 meshes cad", "n_meshes 2 meshes cad lid"), "mesh b.stl wear_factor 0\n"),
    "of two materials that wear each has its number": (
        "fix n1 all property/global youngsModulus peratomtype 1e7 1e7\nfix n2 all property/global poissonsRatio peratomtype 0.3 0.3\n"
        "fix n3 all property/global coefficientRestitution peratomtypepair 2 0.5 0.5 0.5 0.5\n"
        "fix n4 all property/global coefficientFriction peratomtypepair 2 0.4 0.4 0.4 0.4\n"
        "fix k all property/global k_finnie peratomtypepair 2 4e-9 1e-9 1e-9 0\n" + MESH.format("wear finnie") +
        MESH.replace("cad", "lid").replace("type 1", "type 2").replace("a.stl", "b.stl").format("wear finnie") +
        WALL.replace("n_meshes 1 meshes cad", "n_meshes 2 meshes cad lid") + "create_atoms 1 single 0 0 0\n",
        "wear finnie 8e-09 &\n                mesh a.stl &\n                mesh b.stl wear_factor 0.25\n"),
    "meshes are written by the wall": (MESH.format("") + WALL + "dump d all mesh/stl 300 post/dump*.stl\n",
                                       "mesh_stl post/dump_cad_*.stl every 300"),
    "a plane has the side of the box": (
        "region b block 0 1 0 1 0 1\ncreate_box 1 b\n"
        "fix p all wall/gran model hertz tangential history primitive type 1 zplane 1\n", "zplane NULL 1"),
    "a formula is read": (MESH.format("") + "variable v equal 2*3\nvariable q equal ${v}+1\nfix t all property/global "
                          "characteristicVelocity scalar ${q}\n", "characteristicVelocity scalar ${q}"),
}
# Commands that stay, and the reason.
LEFT = {
    "insertion": ("fix i all insert/pack seed 1 distributiontemplate d\n", "insert/pack"),
    "a motion that speeds up": (MESH.format("") + WALL + "fix t all move/mesh mesh cad riggle origin 0 0 0 axis 0 0 1 "
                                "period 1 amplitude 5\n", "move/mesh riggle"),
    "rotate, then linear": (MESH.format("") + WALL + "fix t all move/mesh mesh cad rotate origin 0 0 0 axis 0 0 1 period 1\n"
                            "fix u all move/mesh mesh cad linear 1 0 0\n", "a linear motion after a rotation"),
    "a mesh that is generated": ("fix cad all mesh/surface generate cube 0.1 63 type 1\n", "a mesh by generate"),
    "superquadrics": ("atom_style superquadric\n", "atom_style superquadric"),
}
# Insertions.
GRAINS = "".join(f"fix p{k} all particletemplate/sphere {k} atom_type 1 density constant 2500 radius constant {r}\n"
                 for k, r in ((1, 0.002), (2, 0.004)))
ONE = GRAINS + "fix d all particledistribution/discrete 3 1 p1 1\n"
WRITTEN.update({
    "a pack of one size": (ONE + "fix i all insert/pack seed 7 distributiontemplate d vel constant 0 0 -2 "
                           "particles_in_region 90 region r\n",
                           "fix             i all insert/lsdcd region r type 1 diam one 0.004 dens 2500 number 90 vel 0 0 -2 seed 7\n"),
    "a rate of two sizes by mass": (
        GRAINS + "fix d all particledistribution/discrete/massbased 3 2 p1 0.5 p2 0.5\nfix i all insert/rate/region seed 7 "
        "distributiontemplate d nparticles 90 massrate 0.1 insert_every 1000 region r\n",
        "insert/lsdcd region r type 1 diam mass 2 0.004 0.5 0.008 0.5 dens 2500 massrate 0.1 number 90 seed 7\n"),
    "a stream through a face": (
        ONE + MESH.format("scale 2") + "fix i all insert/stream seed 7 distributiontemplate d nparticles INF particlerate 20 "
        "overlapcheck yes vel uniform 0 0 -2 0.1 0.1 0.1 insertion_face cad extrude_length 0.1\n",
        "insert/lsdcd mesh a.stl scale 2 type 1 diam one 0.004 dens 2500 numberrate 20 vel 0 0 -2 jitter 0.1 seed 7\n"),
})
LEFT.update({
    "a pack without a number": (ONE + "fix i all insert/pack seed 1 distributiontemplate d region r volumefraction_region 0.3\n",
                                "insert/pack without its number or mass"),
    "a pack that is filled up": (ONE + "fix i all insert/pack seed 1 distributiontemplate d region r insert_every 9 "
                                 "particles_in_region 9\n", "insert/pack that fills up again and again"),
    "grains that are not known": ("fix i all insert/pack seed 1 distributiontemplate d region r particles_in_region 9\n",
                                  "insertion of grains that are no spheres"),
})
REFUSED = {
    "a mesh that is missing": (MATERIAL + WALL.replace("meshes cad", "meshes b") + MESH.format(""), "there is no mesh b"),
    "a number that is not known": (MATERIAL.replace("1e7", "${young}") + MESH.format("") + WALL, "'${young}' is no number"),
    "a property that is missing": (MATERIAL.split("fix m3")[0] + MESH.format("") + WALL, "needs fix property/global"),
    "a command without its words": ("fix w all wall/gran model hertz mesh n_meshes 1 meshes\n", "words are missing"),
    "a motion without its words": (MATERIAL + MESH.format("") + WALL + "fix t all move/mesh mesh cad wiggle\n", "words are missing"),
}


def convert(folder, text, name="in.there"):
    """The finished process, and what was written, or None."""
    (folder / name).write_text(text)
    out = folder / "in.here"
    out.unlink(missing_ok=True)
    done = subprocess.run([sys.executable, EXAMPLE / "convert.py", folder / name, "-o", out], text=True, capture_output=True)
    return done, out.read_text() if out.exists() else None


def words(checks, folder):
    for what, (text, expected) in WRITTEN.items():
        done, out = convert(folder, MATERIAL + text)
        checks.fact(what, done.returncode == 0 and expected in out and "\n# LEFT" not in out, done.stderr)
    for what, (text, reason) in LEFT.items():
        done, out = convert(folder, MATERIAL + text)
        line = MATERIAL.count("\n") + text.count("\n")
        form = rf"^# LEFT in\.there:{line}: {re.escape(reason)}.*; do: \S.*\n# {re.escape(text.splitlines()[-1])}$"
        checks.fact(f"left: {what}", done.returncode == 0 and re.search(form, out, re.M) and
                    f"in.there:{line}" in done.stderr, done.stderr)
    for what, (text, reason) in REFUSED.items():
        done, out = convert(folder, text)
        checks.fact(f"refused, and nothing written: {what}", done.returncode == 1 and out is None and reason in done.stderr and
                    "in.there:" in done.stderr, done.stderr)
    # A file that is there stays.
    (folder / "in.here").write_text("kept")
    subprocess.run([sys.executable, EXAMPLE / "convert.py", folder / "in.there", "-o", folder / "in.here"], capture_output=True)
    checks.fact("an error leaves the older file", (folder / "in.here").read_text() == "kept")
    checks.fact("no other file is left", {p.name for p in folder.iterdir()} == {"in.there", "in.here"})
    help_text = subprocess.run([sys.executable, EXAMPLE / "convert.py", "--help"], text=True, capture_output=True).stdout
    checks.fact("--help teaches", all(w in help_text for w in ("LEFT", "NOTE", "--radius", "from-liggghts.md")))


def two_materials(checks, folder):
    """Grains of one type on a wall of another: E and nu of the one material whose contact with itself is theirs."""
    both = """\
set group all diameter 0.02 density 2500
create_atoms 1 single 0 0 0
fix m1 all property/global youngsModulus peratomtype 1e7 2e8
fix m2 all property/global poissonsRatio peratomtype 0.3 0.2
fix m3 all property/global coefficientRestitution peratomtypepair 2 0.5 0.6 0.6 0.7
fix m4 all property/global coefficientFriction peratomtypepair 2 0.4 0.3 0.3 0.2
""" + MESH.format("").replace("type 1", "type 2") + WALL
    _, out = convert(folder, both)
    e, restitution, nu, share, mu = map(float, re.search(
        r"hertz/material (\S+) (\S+) (\S+) damping coeff_restitution tangential mindlin_slip NULL (\S+) (\S+)", out).groups())
    # 1/E* and 1/G* are sums over the two materials.
    star = 1 / ((1 - 0.3**2) / 1e7 + (1 - 0.2**2) / 2e8)
    shear = 1 / (2 * 1.7 * 1.3 / 1e7 + 2 * 1.8 * 1.2 / 2e8)
    # Ten digits are written.
    checks.at_most("E*", abs(e / (2 * (1 - nu**2)) / star - 1), 1e-8)
    checks.at_most("G*", abs(e / (4 * (2 - nu) * (1 + nu)) / shear - 1), 1e-8)
    checks.at_most("tangential damping", abs(share - 2 * (shear / star) ** 0.5), 1e-9)
    checks.fact("restitution and friction of the pair", (restitution, mu) == (0.6, 0.3))


def several_materials(checks, folder):
    """Grains of types 1 and 2, meshes of types 1 and 3: one fix, and a law for each pair that differs."""
    numbers = "fix m{} all property/global {} {} {}\n"
    pairs = {(1, 1): 0.1, (1, 2): 0.2, (1, 3): 0.3, (2, 2): 0.4, (2, 3): 0.3, (3, 3): 0.6}
    mu = " ".join(str(pairs[min(i, j), max(i, j)]) for i in (1, 2, 3) for j in (1, 2, 3))
    text = "".join(numbers.format(k, *words) for k, words in enumerate((
        ("youngsModulus", "peratomtype", "1e7 1e7 1e7"), ("poissonsRatio", "peratomtype", "0.3 0.3 0.3"),
        ("coefficientRestitution", "peratomtypepair", "3" + " 0.5" * 9), ("coefficientFriction", "peratomtypepair", "3 " + mu))))
    text += "".join(f"create_atoms {kind} single 0 0 0\n" for kind in (1, 2))
    text += MESH.format("") + MESH.replace("cad", "lid").replace("type 1", "type 3").replace("a.stl", "b.stl").format("")
    text += WALL.replace("n_meshes 1 meshes cad", "n_meshes 2 meshes cad lid")
    done, out = convert(folder, text)
    wall = [line.split() for line in re.search(r"^fix +w (?:.*&\n)*.*", out, re.M)[0].split("&\n")]
    # The last number of each law is the friction.
    checks.fact("several materials: one fix with a law for each pair",
                [(words[0], words[-1]) for words in wall] == [("fix", "0.1"), ("mesh", "a.stl"), ("law", "0.2"),
                                                              ("mesh", "b.stl"), ("law", "0.3")] and
                wall[2][:4] == ["law", "types", "2", "granular"] and wall[4][1] == "granular" and
                len(re.findall("^fix .*wall/lsdcd", out, re.M)) == 1 and "\n# LEFT" not in out, f"{wall}")


def figures(text, name):
    return re.findall(rf"^{name} [a-z]+ .*", text, re.M)


def run(checks, folder):
    """The numbers of the laws have the same ten digits, so both runs have the same bits."""
    subprocess.run([sys.executable, EXAMPLE / "make_meshes.py", "--out", folder], check=True, stdout=subprocess.DEVNULL)
    for name in ("meshGran", "movingMeshGran", "servoWall", "conveyor", "transfer"):
        done, out = convert(folder, (EXAMPLE / f"in.{name}.liggghts").read_text())
        checks.fact(f"{name}: nothing is left", out is not None and "\n# LEFT" not in out, done.stderr)
        port = figures(lmp.run_well(EXAMPLE / f"in.{name}", folder, png=0), name)
        converted = figures(lmp.run_well(folder / "in.here", folder), name)
        checks.fact(f"{name}: the converted script gives the port's figures", len(port) == 1 and converted == port,
                    f"{port} {converted}")


if __name__ == "__main__":
    facts = lmp.Checks()
    place = lmp.scratch()
    if sys.argv[1:] == ["run"]:
        run(facts, place)
    else:
        words(facts, place)
        two_materials(facts, place)
        several_materials(facts, place)
    facts.done(place)
