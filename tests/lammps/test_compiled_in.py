# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""A LAMMPS without PLUGIN that has the styles compiled in, by cmake/packaging/lammps: it lists all of them, and moves spheres as
lmp-lsdcd does. The host is that of hosts/build_host.sh package, which LSDCD_HOST names."""

import re

import lmp
import scene
from facts import at_most, fact

LAW = "hooke/history 1e4 NULL 120 NULL 0.4 1"
STYLES = {"Fix": {"insert/lsdcd", "massflow/lsdcd", "wall/lsdcd"}, "Compute": {"lsdcd/collide", "lsdcd/energy", "lsdcd/impacts"}, "Region": {"mesh/lsdcd"}}


@lmp.needs_host
def test_compiled_in(folder):
    done = lmp.run("plugin list\n", folder, host=True)
    fact("this LAMMPS has no package PLUGIN", "Unknown command: plugin list" in done.stdout, done.stdout[-300:])
    told = lmp.run_well("info styles fix styles compute styles region\n", folder, host=True)
    for kind, names in STYLES.items():
        listed = set(re.search(rf"{kind} styles:\s+((?:\S.*\n)+)", told)[1].split())
        fact(f"{kind} styles: {', '.join(sorted(names))}", names <= listed, str(names - listed))
    # Another compiler or flags may round the integrator otherwise.
    scene.write_floor(folder / "floor.stl")
    body = scene.CREATE + scene.forces(LAW) + scene.dump("moves", 100) + "run 1000\n"
    moves = []
    for host in (False, True):
        lmp.run_well(body, folder, host=host)
        moves.append(lmp.read_dump(folder / "moves"))
    fact("spheres are touched", any(row[9] for rows in moves[1].values() for row in rows.values()))
    at_most("the trajectory is that of lmp-lsdcd", lmp.largest_difference(*moves), 1e-9)
