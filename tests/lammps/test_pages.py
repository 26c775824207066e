# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Every LAMMPS code block of the pages, in lmp-lsdcd; tests/tool/pages.py says what a block is.

A whole script, which begins with units, runs for 0 steps. Other lines run in a small scene, one after the other: a
fix that is there already is removed first, and a line that begins with a keyword gets a fix before it. A mesh that is
not there is a cube in the scene. Blocks that begin with `# in.NAME` are files, which test_recipes.py runs to their end.
"""
import re
import shlex
import subprocess
import sys

import lmp
import stl
from facts import fact

sys.path.insert(0, str(lmp.HERE.parent / "tool"))
from pages import ROOT, all_pages    # noqa: E402

# Two molecules of four atoms, each the other moved by 1 along x; no two molecules touch.
PLACES = [(-0.5, 0, 0), (-0.4, 0, 0), (-0.5, 0.1, 0), (-0.5, 0, 0.1)]
SCENE = """\
units           si
atom_style      sphere
atom_modify     map array
comm_modify     vel yes cutoff 0.5
boundary        f f f
newton          off
fix             molecules all property/atom mol ghost yes
region          box block -2 2 -2 2 -2 2
create_box      2 box
""" + "".join(f"create_atoms    1 single {x + move} {y} {z}\n" for move in (0, 1) for x, y, z in PLACES) + """\
set             group all diameter 0.08 density 2500
set             atom 1*4 mol 1
set             atom 5*8 mol 2
group           grains type 1
group           clumps type 1
group           tool molecule 1
pair_style      zero 0.1
pair_coeff      * *
timestep        1e-7
thermo_style    custom step
"""
FIX = "fix w all wall/lsdcd hertz/history 1e5 NULL 50 NULL 0.5 1 mesh floor.stl"
# A LAMMPS that is older than heat stops there, when all words of the line have been read.
NO_HEAT = "the sub-model heat needs a LAMMPS with fix heat/flow"


def run(script, folder):
    """Once more without the lines with heat, where these cannot run."""
    done = lmp.run(script, folder, env={"LSDCD_POTENTIALS": str(ROOT / "potentials")})
    if NO_HEAT in done.stdout:
        return run(re.sub(r"^fix (\S+) .* heat (radius|area) .*$", r"fix \1 all viscous 0", script, flags=re.M), folder)
    return done


def keywords():
    """First words of the keywords of fix wall/lsdcd, from its help."""
    shown = subprocess.run([lmp.LMP, "-h"], env=lmp.environment(), text=True, stdout=subprocess.PIPE).stdout
    return set(re.findall(r"^  ([a-z_]+) ", shown.split("keywords\n")[1].split("\n\n")[0], re.M))


def cube(path, half, flat=False):
    corners = [(x, y, z) for x in (-half, half) for y in (-half, half) for z in (-half, half)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    if flat:
        faces = faces[:1]
    stl.write(path, [t for face in faces for t in stl.quad(*(corners[k] for k in face))])


def with_meshes(line, folder):
    """The line with meshes that are there: one file for each scale."""
    def replace(match):
        scale = re.match(r"(?:(?!\bmesh\b).)*?\bscale (\S+)", line[match.end():])
        name = f"{match[2]}_{scale[1] if scale else 1}.stl"
        half = 0.3 if match[2] == "box" else 1.2    # a box is inside of the others
        cube(folder / name, half / float(scale[1] if scale else 1), flat="insert/lsdcd mesh" in line)
        return f"mesh{match[1]} {name}"
    return re.sub(r"\bmesh(/lsdcd|) ([\w-]+)\.(?:stl|obj|ply|off)\b", replace, line)


def script_of(block, folder, known):
    """Of single lines."""
    text = re.sub(r"&\s*\n\s*", " ", block.text)
    lines, fixes, computes = block.before + [""], set(), set()
    for name in sorted(set(re.findall(r"\bv_(\w+)", text)) - set(re.findall(r"variable +(\w+)", text))):
        lines.append(f"variable {name} equal 0.1")
    text = [line.split("#")[0].strip() for line in text.split("\n")]
    for line in filter(None, text):
        words = line.split()
        if words[0] in known:
            line = f"{FIX} {line}"
            words = line.split()
        uses = "w" not in fixes and (words[:2] == ["fix_modify", "w"] or re.search(r"\b[fF]_w\b", line))
        if uses or words[:2] == ["fix_modify", "w"]:    # each with as many meshes as it names
            second = " mesh lid.stl scale 0.9" + " body density 1000 joint slider 0 0 1" * (" body " in line)
            lines += ["unfix w"] * ("w" in fixes) + [with_meshes(FIX + second * ("mesh 2" in line), folder)]
            fixes.add("w")
        if words[0] == "fix":
            lines += [f"unfix {words[1]}"] * (words[1] in fixes)
            fixes.add(words[1])
        if words[0] == "compute":
            lines += ["thermo_style custom step", f"uncompute {words[1]}"] * (words[1] in computes)
            computes.add(words[1])
        lines.append(with_meshes(line, folder))
        if words[0].startswith("fix"):
            lines.append("run 0 post no")
    return SCENE + "\n".join(lines) + "\nrun 0 post no\n"


def whole_script(page, block, folder):
    """Meshes are made by the commands that the page names in its text."""
    for command in re.findall(r"`(\S*lsdcd generate [^`]*)`", page.text):
        tool = lmp.pathlib.Path(lmp.LMP).parent / "lsdcd"
        subprocess.run([tool, *shlex.split(command)[1:]], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return re.sub(r"^run +\d+", "run 0", block.text, flags=re.M)


def test_blocks(folder):
    known = keywords()
    (folder / "grain_atoms.txt").write_text("".join("%g %g %g\n" % place for place in PLACES))
    (folder / "arm.txt").write_text("0 0 0 0 0 0 0\n0.25 0.1 0 0.05 0 0.3 0\n")
    (folder / "cam.csv").write_text("0, 0\n0.1, 12.5\n0.2, 0\n")
    count = 0
    for page in all_pages().values():
        for block in page.blocks:
            if block.language != "lammps" or block.form or re.match(r"# in\.\w+\n", block.text):
                continue
            count += 1
            whole = re.match(r"units\b", block.text)
            script = whole_script(page, block, folder) if whole else script_of(block, folder, known)
            done = run(script, folder)
            error = re.search(r"^ERROR.*(?:\n.*)?", done.stdout, re.M)
            fact(f"{block} runs", done.returncode == 0, error[0] if error else "")
    fact("there are blocks", count > 5)
