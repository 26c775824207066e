# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""coarse_grain L of the wall and between grains, of numbers and of a material file: grains L times as large, with times L times as
long and gravity 1/L, go the way of the real ones. tests/unit/test_coarse_grain.cpp does so for each sub-model.
"""

import re

import lmp
import stl
from facts import at_most, fact

L = 4    # its root is a power of two, so that the two ways differ by few roundings
MATERIAL = """\
units si
material glass
  youngs_modulus 5e6 Pa
  poissons_ratio 0.3 1
  surface_energy 0.05 J/m2
pair glass glass
  sliding_friction 0.3 1
"""
BESIDE = "damping velocity rolling sds 200 1e-4 0.1"
# Of the first type; that of the second; their mixture.
PAIRS = ("1 1 law granular jkr material m.lsdcd glass with eta 2e-3 {0}", "2 2 jkr 2e6 4e-3 0.2 0.02 tangential mindlin NULL 1 0.2 {0}")
WALL = "granular jkr material m.lsdcd glass with eta 2e-3 {0} mesh floor.stl scale {1}"
DUMP = "id x y z vx vy vz omegax omegay omegaz"
STEPS = 4000


def prepare(folder):
    (folder / "m.lsdcd").write_text(MATERIAL)
    stl.write(folder / "floor.stl", stl.sheet(6, lambda i, j: (-0.06 + 0.02 * i, -0.06 + 0.02 * j, 0.0)))


def forces(scale, own="coarse_grain"):
    """The laws and what moves the grains. `own`: the keyword, or none."""
    word = f" {own} {scale}" if own else ""
    return f"pair_style granular/lsdcd{word}\n" + "".join(f"pair_coeff {line.format(BESIDE)}\n" for line in PAIRS) + f"""\
neighbor        {0.002 * scale} bin
neigh_modify    delay 0 every 1 check yes
fix             move all nve/sphere
fix             pull all gravity {10 / scale} vector 0.1 0.05 -1
fix             wall all wall/lsdcd {WALL.format(BESIDE, scale)}{word}
timestep        {1e-6 * scale}
"""


def begin(scale):
    half = 0.05 * scale
    box = f"{-half} {half} {-half} {half} {-0.01 * scale} {half}"
    at = ((1, -0.006, 0.001, 0.0103), (2, 0.0125, 0, 0.0085), (2, 0.0005, 0.0152, 0.0082))
    return lmp.head(box, units="si", types=2) + "".join(
        f"create_atoms {kind} single {x * scale} {y * scale} {z * scale} units box\n" for kind, x, y, z in at) + f"""\
set             type 1 diameter {0.02 * scale} density 2500
set             type 2 diameter {0.016 * scale} density 2500
group           first id 1
group           others subtract all first
velocity        first set 0.3 0.1 -0.2
velocity        others set -0.2 -0.2 -0.1
set             group first omega {10 / scale} {-5 / scale} {20 / scale}
"""


def dump(name):
    return f"dump out all custom 200 {name} {DUMP}\ndump_modify out format float %.17g sort id\n"


def go(folder, scale, name, own="coarse_grain"):
    """The states, with lengths and times over the scale, and the log."""
    text = lmp.run_well(begin(scale) + forces(scale, own) + dump(name) + f"run {STEPS}\n", folder)
    return {step: {atom: [x / scale for x in row[:3]] + row[3:6] + [x * scale for x in row[6:]] for atom, row in state.items()}
            for step, state in lmp.read_dump(folder / name).items()}, text


def test_way(folder):
    real, _ = go(folder, 1, "real", "")
    larger, text = go(folder, L, "larger")
    at_most("larger grains go the way of the real ones", lmp.largest_difference(real, larger), 1e-12)
    fact("without the keyword they do not", lmp.largest_difference(real, go(folder, L, "other", "")[0]) > 1e-3)
    told = re.findall(r"coarse_grain 4: .*", text)
    fact("each log has a line of what becomes what", len(told) == 2 and all(
        words in line for line in told for words in ("gamma 0.05 becomes 0.2", "eta 0.002 becomes 0.032", "rolling sds k 200 becomes 800")), told)
    fact("it has numbers of all types", all(f"types {types}: eta " in told[-1] for types in ("1 1", "1 2", "2 2")), told[-1:])


def test_time(folder):
    """Of the law as it acts."""
    times = {}
    for scale in (1, L):
        times[scale] = [float(t) for t in re.findall(r"lasts ([-\d.e]+)", go(folder, scale, "time")[1])]
    fact("contacts last longer", len(times[1]) > 0 and all(abs(b / a - L) < 1e-3 * L for a, b in zip(times[1], times[L])), times)


def test_restart(folder):
    """Numbers are scaled once, as the file has springs and no numbers."""
    whole = lmp.read_dump(folder / "whole") if lmp.run_well(
        begin(L) + forces(L) + dump("whole") + "run 800\nwrite_restart half\nrun 800\n", folder) else None
    lmp.run_well("atom_modify map array\ncomm_modify vel yes\nnewton off\nread_restart half\n" + forces(L) + dump("rest") + "run 800\n", folder)
    rest = lmp.read_dump(folder / "rest")
    at_most("a run that goes on is the whole one", lmp.largest_difference({step: whole[step] for step in rest}, rest), 0)


def test_refused(folder):
    for words, says in (("coarse_grain 0", "L = 0 is out of range"), ("coarse_grain", "L"), ("coarse_grain 2 3", "'3' is not expected"),
                        ("2 coarse 2", "'coarse' is not expected")):
        lmp.refused(f"pair_style granular/lsdcd {words}", begin(1) + f"pair_style granular/lsdcd {words}\n", folder, says)
    lmp.refused("a wall", begin(1) + "fix w all wall/lsdcd hooke 1e4 NULL 5 NULL 0.5 1 mesh floor.stl coarse_grain 0\n", folder, "coarse_grain")
