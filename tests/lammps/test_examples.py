# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Examples run, the long ones for a part of their time. CMakeLists.txt names those that run every day; what the others use is tested by
other scripts, in less time."""

import os
import re
import subprocess
import sys

import pytest

import lmp
from facts import at_most, fact

EXAMPLES = lmp.HERE.parent.parent / "examples"
# in.NAME and, where it has another name, its folder; variables. A script fails itself where what its README names is violated: a balance
# of forces or torques, of mass, a closed form.
SCRIPTS = {"flap": "", "paddle": "", "filling": "", "feed": "", "piston": "", "lid": "", "hopper": "", "screw": "", "screen": "", "belt": "",
           "insertion": "", "rest": "vessel", "drum": "drum speed 0.15", "mill": "mill until 0.05", "wheel": "wheel steps 10000", "clumps": "", "repose": "repose rolling 0.1 cohesion 500", "mixer": "mixer turns 2",
           "sagging-belt": "sagging-belt fill 15000 measure 10000", "triaxial": "triaxial strain 0.05"}
# Programs: wear and forces of a chute's triangles, a chute that is worn through, both with their pictures; a screw feeder without GRANSURF;
# the forces of the LAMMPS that is installed on a plane, but for what the page says; the same wall cut into other triangles (round-off with
# fix wall/lsdcd, a large difference with LIGGGHTS); four tutorials of LIGGGHTS in both programs; forces of a
# silo and a drum cut into other triangles.
PROGRAMS = {"erosion": ["erosion/wear"], "wearing_chute": ["wearing-chute/before_after"], "from_gransurf": ["from-gransurf/compare"],
            "wall_gran_differences": ["flat/differences"],
            "benchmark_triangles": ["benchmark/triangles", "--triangles", "20000", "--grains", "2000", "--seconds", "0.03"],
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


def test_benchmark(folder):
    """The benchmark of eight codes with few grains, each case from its filling on. While the ball is slowed, momentum changes by what
    gravity and the wall give, but for round-off, of momenta a hundred times as large: a run counts the forces at its two ends half, its mean the last one whole."""
    place, steps, step, gravity = EXAMPLES / "benchmark", 4500, 1.04e-6, 9.81
    subprocess.run([sys.executable, place / "make_walls.py", "--out", folder, "--lsdcd", os.environ["LSDCD_TOOL"]], check=True)
    lmp.run_well(place / "in.fill_impact", folder, dir=folder, thousands=5, longest=0.032)
    lmp.run_well(place / "in.fill_silo", folder, dir=folder, grains=2000, longest=0.016)
    lmp.run_well(place / "in.fill_drum", folder, dir=folder, small=1200, large=240, longest=0.036)
    silo = lmp.read_thermo(lmp.run_well(place / "in.silo", folder, dir=folder, seconds=0.041))
    drum = lmp.read_thermo(lmp.run_well(place / "in.drum", folder, dir=folder, seconds=0.041, step=2e-6))
    said = lmp.run_well(f"""include {place / "in.impact"}
variable        momentum equal mass(all)*vcm(all,z)
fix             load all ave/time 1 {steps} {steps} f_wall[3]
thermo_style    custom step v_momentum f_load f_wall[3] v_vz
thermo_modify   format float %.17g
thermo          {steps}
run             {steps}
variable        weight equal mass(all)*{gravity}
print           "weight $(v_weight:%.17g)"
""", folder, dir=folder, height=-0.052, seconds=0)
    (_, before, _, first, fast), (_, after, mean, last, slow) = lmp.read_thermo(said)[-2:]
    weight = float(re.findall(r"^weight (\S+)", said, re.M)[-1])
    given = -(mean + (first - last) / (2 * steps)) - weight
    fact("the bed slows the ball", fast <= -5 and slow > -4.9, f"{fast} {slow}")
    at_most("momentum that neither gravity nor the wall has given, in parts of that of the wall", abs((after - before) / (steps * step) - given) / abs(mean), 1e-10)
    fact("grains leave the silo, and are counted twice", all(row[4] < 2000 and 0 < row[5] <= 2000 - row[4] for row in silo[-1:]), silo)
    fact("the drum carries grains to +x, and they resist", drum[-1][5] < drum[0][5] and drum[-1][8] > 0, drum)


def test_benchmark_logs(folder):
    """table.py reads rows of runs that follow one another, of which the last one has lost its ball and is cut off, and a log without any."""
    sys.path.insert(0, str(EXAMPLES / "benchmark"))
    import table
    titles = "   Step           v_t          KinEng          v_z\n"
    (folder / "impact.log").write_text("1 atom\n\n" + titles + "      0   0             1.25           0.5\n   1000   0.12345678   -1.5e-3        0.25\nLoop time of 1\n" + titles +
                                       "   1000   0.12345678   -1.5e-3        0.25\n   2000   0.24691356   12345678901   -nan\n   3000   0.37")
    (folder / "none.log").write_text("ERROR: Cannot open file bed.data\n")
    read = table.read_log(folder / "impact.log")
    fact("its rows", [read[name].tolist() for name in ("Step", "t", "KinEng")] ==
         [[0, 1000, 2000], [0, 0.12345678, 0.24691356], [1.25, -1.5e-3, 12345678901]] and read["z"].tolist()[:2] == [0.5, 0.25] and read["z"][2] != read["z"][2], read)
    fact("none", len(table.read_log(folder / "none.log")["t"]) == 0)
