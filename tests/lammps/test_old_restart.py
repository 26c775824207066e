#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Restart files of the last format before 0.10.0 are read, and what goes on from them equals to the last bit what went on
in the program that wrote them.

usage: test_old_restart.py [write]: with the old program in LSDCD_LMP writes the files of the folder old_restart
"""

import pathlib
import shutil
import struct
import sys

import lmp
import scene
import stl

KEPT = lmp.HERE / "old_restart"
NAME = "before_0_10_0"

# Meshes with two terms, a servo, a motion that was stopped, and variables whose velocity is a difference; springs, wear,
# what flows and grains that come in, of which some are late.
MESHES = ("mesh floor.stl motion wiggle 0.05 0 0 0.8 motion rotate 0 0 0 0 0 1 5 "
          "mesh lid.stl servo force x -5 vmax 2 "
          "mesh side.stl motion linear 1 0 0 "
          "mesh side.stl move 4.2 0 0 motion variable v_dx NULL NULL NULL NULL NULL")
LAW = "hooke/history 1e4 NULL 200 NULL 0.5 1"
FIXES = f"""\
timestep        0.001
pair_style      gran/hooke/history 1e4 NULL 20 NULL 0.5 1
pair_coeff      * *
comm_modify     vel yes
neighbor        0.2 bin
neigh_modify    delay 0 every 1 check yes
variable        dx equal 0.05*sin(6*step*dt)
fix             move all nve/sphere
fix             pull all gravity 20.0 vector 0 0 -1
fix             wall all wall/lsdcd {LAW} {{meshes}} wear archard 0.001 50
region          inlet block -0.5 0.5 -0.5 0.5 1.2 1.7 units box
fix             in all insert/lsdcd region inlet numberrate 60 diam range 0.4 0.5 dens 2 number 25 attempts 3
fix             flow all massflow/lsdcd mesh plate.stl
"""
START = f"""\
units           lj
atom_style      sphere
atom_modify     map array
boundary        f f f
newton          off
region          box block -3 3 -3 3 -2 4
create_box      1 box
create_atoms    1 single -0.8 0 0.4 units box
create_atoms    1 single 0.7 0.3 0.4 units box
create_atoms    1 single 0.1 -0.9 0.4 units box
set             group all diameter 0.8 density 2.0
velocity        all set 0.5 0.3 0
"""
NUMBERS = ([f"f_wall[{mesh}][{k}]" for mesh in range(1, 5) for k in range(1, 15)] +
           [f"f_in[{k}]" for k in range(1, 8)] + [f"f_flow[{k}]" for k in range(1, 9)])
GO_ON = """\
run             200
write_dump      all custom after id diameter mass x y z vx vy vz omegax omegay omegaz modify sort id format float %.17g
print           \"""" + " ".join(f"$({name}:%.17g)" for name in NUMBERS) + "\" append after\n"


def write_meshes(folder):
    scene.write_floor(folder / "floor.stl", side=2.8, cells=6)
    stl.write(folder / "lid.stl", stl.quad((1.2, -1, -0.3), (1.2, -1, 1.1), (1.2, 1, 1.1), (1.2, 1, -0.3)))
    stl.write(folder / "side.stl", stl.quad((-2.1, -2, -1), (-2.1, 2, -1), (-2.1, 2, 3), (-2.1, -2, 3)))
    stl.write(folder / "plate.stl", stl.quad((-2, -2, 1), (2, -2, 1), (2, 2, 1), (-2, 2, 1)))


def write_kept():
    """By the program that is to be compared with."""
    folder = lmp.scratch()
    write_meshes(folder)
    lmp.run_well(START + FIXES.format(meshes=MESHES) + "run 150\nfix_modify wall mesh 3 motion none\nrun 150\n"
                 f"write_restart {NAME}.restart\n", folder)
    KEPT.mkdir(exist_ok=True)
    shutil.copy(folder / f"{NAME}.restart", KEPT)
    lmp.run_well(f"newton off\natom_modify map array\nread_restart {NAME}.restart\n" + FIXES.format(meshes=MESHES) + GO_ON,
                 folder)
    shutil.copy(folder / "after", KEPT / f"{NAME}.after")


def proceed(folder, meshes=MESHES, restart=NAME, ranks=1, well=True):
    (folder / "after").unlink(missing_ok=True)
    text = f"newton off\natom_modify map array\nread_restart {restart}.restart\n" + FIXES.format(meshes=meshes) + GO_ON
    done = lmp.run(text, folder, ranks)
    if well and done.returncode:
        sys.exit(f"script failed with {done.returncode}:\n{done.stdout[-3000:]}")
    after = folder / "after"
    return after.read_text() if after.exists() else "", done.stdout


def main():
    if sys.argv[1:] == ["write"]:
        return write_kept()
    checks, folder = lmp.Checks(), lmp.scratch()
    write_meshes(folder)
    shutil.copy(KEPT / f"{NAME}.restart", folder)
    wanted = (KEPT / f"{NAME}.after").read_text()
    after, text = proceed(folder)
    checks.fact("an old file goes on as in the program that wrote it, to the last bit", after == wanted)
    checks.fact("a motion that was stopped stays so, and no mesh has another warning", "mesh 3 'side.stl': the "
                "motion 'linear 1 0 0' was stopped when" in text and text.count("WARNING: Fix wall wall/lsdcd: mesh ") == 1)
    after = proceed(folder, MESHES.replace("0 0 1 5", "0 0 2 5.0").replace("wiggle 0.05", "wiggle 5e-2"))[0]
    checks.fact("numbers that are written otherwise are the same motion", after == wanted)
    after, text = proceed(folder, MESHES.replace("0 0 1 5", "0 0 1 6"))
    checks.fact("another motion begins where the mesh was", after != wanted and
                "the phase is lost" in text and "rotate 0 0 0 0 0 1 6" in text)

    # A file of today, read again: the same numbers go on.
    text = f"newton off\natom_modify map array\nread_restart {NAME}.restart\n" + FIXES.format(meshes=MESHES)
    lmp.run_well(text + "run 0\nwrite_restart today.restart\n", folder)
    today = proceed(folder, restart="today")[0]
    lmp.run_well(text + "run 0\n" + GO_ON.replace("after", "straight"), folder)
    checks.fact("a file of today goes on as without it", today == (folder / "straight").read_text())

    # Data that are none of ours: each fix says what and what to do, and changes nothing.
    data = (folder / "today.restart").read_bytes()
    mark = struct.pack("<d", -0x4c5344434453)
    for style in ("wall/lsdcd", "insert/lsdcd", "massflow/lsdcd"):
        at = data.index(mark, data.index(style.encode()))
        for name, broken in (("foreign", struct.pack("<d", -5)), ("later", data[at:at + 8] + struct.pack("<d", 2))):
            (folder / "other.restart").write_bytes(data[:at] + broken + data[at + len(broken):])
            done = proceed(folder, restart="other", well=False)[1]
            checks.fact(f"{style}: {name} data are refused with a remedy", f" {style}: the restart file cannot be used: " in done and
                        "give the fix another ID" in done and done.count("ERROR") == 1, done[-300:])
    checks.done(folder)


if __name__ == "__main__":
    main()
