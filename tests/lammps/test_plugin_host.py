# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""One script gives the same numbers under lmp-lsdcd and under a LAMMPS with PLUGIN.

LSDCD_PLUGIN_HOST names that LAMMPS, of the version that the plugin is built for; without
it the one that hosts/build_host.sh built is taken, with a plugin of its own. Without
either there is nothing to run.
"""

import os
import pathlib
import re
import subprocess

import pytest

import lmp
import scene
from facts import at_most, fact

HOST = os.environ.get("LSDCD_PLUGIN_HOST", "")
PLUGIN = lmp.LIB / "lsdcdplugin.so"
if not HOST:
    HOST, PLUGIN = lmp.HOST, pathlib.Path(lmp.PLUGIN)
LAW = "hooke/history 1e4 NULL 120 NULL 0.4 1"


@pytest.mark.skipif(not HOST, reason="no LAMMPS with PLUGIN (LSDCD_PLUGIN_HOST, tests/lammps/hosts/build_host.sh)")
def test_plugin_host(folder):
    # Their names differ from one installation to another; the program that opens the plugin has them.
    linked = [line for file in (PLUGIN, PLUGIN.with_name(PLUGIN.stem + "-styles.so")) for line in
              subprocess.run(["readelf", "-d", file], check=True, capture_output=True, text=True).stdout.splitlines()
              if "(NEEDED)" in line]
    fact("the plugin links neither LAMMPS nor MPI", linked and not any(re.search("lib(mpi|lammps)", line) for line in linked))
    scene.write_floor(folder / "floor.stl")
    own, moves = lmp.LMP, []
    body = scene.CREATE + scene.forces(LAW) + scene.dump("moves", 100) + "run 1000\n"
    for program, load in ((own, ""), (HOST, f"plugin load {PLUGIN}\n")):
        lmp.LMP = program
        lmp.run_well(load + body, folder)
        moves.append(lmp.read_dump(folder / "moves"))
    # Another compiler or flags may round the integrator otherwise.
    at_most("same trajectory", lmp.largest_difference(*moves), 1e-9)

    lmp.LMP = HOST
    text = lmp.run_well(f"plugin load {PLUGIN}\nplugin list\n" + body +
                        f"clear\nplugin load {PLUGIN}\n" + body +
                        "undump moves\nplugin unload fix wall/lsdcd\n"
                        "plugin unload fix massflow/lsdcd\nplugin unload fix insert/lsdcd\nplugin unload fix gravity/lsdcd\nplugin unload compute lsdcd/collide\nplugin unload compute lsdcd/energy\nplugin unload compute lsdcd/impacts\n"
                        "plugin unload region mesh/lsdcd\nplugin unload pair granular/lsdcd\nplugin unload fix SPRINGS/LSDCD\n"
                        "plugin list\nrun 10\n", folder)
    # Newer hosts keep their plugins through clear.
    came = text.count("Loading plugin: fix wall/lsdcd") + text.count("Restoring plugin: fix wall/lsdcd")
    fact("load, clear, load, unload", came == 2 and "loaded plugins: 0" in text)
    for gone in scene.WITHOUT_SPRINGS:
        text = lmp.run_well(f"plugin load {PLUGIN}\n" + scene.SPRINGS_OF_PAIRS + gone + f"\nprint 'still here'\nplugin load {PLUGIN}\n", folder)
        fact(f"{gone.splitlines()[0]} after a run with springs", "\nstill here" in text, text[-400:])
    # The second time the file is found by a path from another folder, and is in memory already.
    own = folder / "own"
    own.mkdir()
    for file in (PLUGIN, PLUGIN.with_name(PLUGIN.stem + "-styles.so")):
        (own / file.name.replace(PLUGIN.stem, "lsdcdplugin")).symlink_to(file)
    unload = "".join(f"plugin unload {style}/lsdcd\n" for style in
                     ("fix wall", "fix massflow", "fix insert", "fix gravity", "region mesh"))
    unload += "plugin unload compute lsdcd/collide\nplugin unload compute lsdcd/energy\nplugin unload compute lsdcd/impacts\nplugin unload pair granular/lsdcd\nplugin unload fix SPRINGS/LSDCD\n"
    text = lmp.run_well("plugin load own/lsdcdplugin.so\n" + unload +
                        "shell cd own\nplugin load ./lsdcdplugin.so\nshell cd ..\n" + body, folder)
    fact("loaded by another relative path after it was unloaded",
         text.count("Loading plugin: fix wall/lsdcd") == 2)
    text = lmp.run_well(body, folder, env={"LAMMPS_PLUGIN_PATH": str(own)})
    fact("LAMMPS_PLUGIN_PATH counts its two files as one plugin", f"Loaded 1 plugins from {own}" in text)
    fact("on 2 ranks", "Loop time" in lmp.run_well(f"plugin load {PLUGIN}\n" + body, folder, 2))
