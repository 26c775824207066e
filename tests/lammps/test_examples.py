# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Examples run, the long ones for a part of their time. CMakeLists.txt names those that run every day; what the others use is tested by
other scripts, in less time."""

import re
import subprocess
import sys

import pytest

import lmp
from facts import fact

EXAMPLES = lmp.HERE.parent.parent / "examples"
# in.NAME and, where it has another name, its folder; variables. A script fails itself where what its README names is violated: a balance
# of forces or torques, of mass, a closed form.
SCRIPTS = {"flap": "", "paddle": "", "filling": "", "feed": "", "piston": "", "lid": "", "hopper": "", "screw": "", "screen": "", "belt": "",
           "insertion": "", "rest": "vessel", "drum": "drum speed 0.15", "wheel": "wheel steps 10000", "clumps": "", "mixer": "mixer turns 2",
           "sagging-belt": "sagging-belt fill 15000 measure 10000", "triaxial": "triaxial strain 0.05"}
# Programs: wear and forces of a chute's triangles, a chute that is worn through, both with their pictures; a screw feeder without GRANSURF;
# the forces of the LAMMPS that is installed on a plane, but for what the page says; the same wall cut into other triangles (round-off with
# fix wall/lsdcd, a large difference with LIGGGHTS); four tutorials of LIGGGHTS in both programs.
PROGRAMS = {"erosion": ["erosion/wear"], "wearing_chute": ["wearing-chute/before_after"], "from_gransurf": ["from-gransurf/compare"],
            "wall_gran_differences": ["flat/differences"],
            "retriangulated": ["retriangulated/compare", "--only", "fix wall/lsdcd"],
            "retriangulated_liggghts": ["retriangulated/compare", "--only", "LIGGGHTS 3.8"],
            "from_liggghts": ["from-liggghts/compare", "--program", "fix wall/lsdcd"],
            "from_liggghts_liggghts": ["from-liggghts/compare", "--both"]}
SAYS = {"wall_gran_differences": r"hooke/history +[0-9.]+e-1[67].*hertz/history +[0-9.]+e-1[67].*damping tsuji +1[.]4e-01.*"
                                 r"with mindlin +[0-9.]+e-1[67]"}


@pytest.mark.parametrize("name", SCRIPTS)
def test_script(folder, name):
    place, *words = SCRIPTS[name].split() or [name]
    lmp.run_well(EXAMPLES / place / f"in.{name}", folder, timeout=900, dir=EXAMPLES / place, **dict(zip(words[::2], words[1::2])))


@pytest.mark.parametrize("name", PROGRAMS)
def test_program(folder, name):
    program, *words = PROGRAMS[name]
    done = subprocess.run([sys.executable, EXAMPLES / f"{program}.py", *words, "--work", folder / name], env=lmp.environment(), text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode == 77:
        pytest.skip(done.stdout[-300:])
    fact(f"{program}.py ends well", done.returncode == 0 and re.search(SAYS.get(name, ""), done.stdout, re.S), done.stdout[-2000:])
