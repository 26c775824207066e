# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""LAMMPS with Open MPI, with MPICH and without MPI, each with the plugin that was built for it and with those of the
others. With its own the trajectory is that of lmp-lsdcd; any other is refused in one sentence, and LAMMPS goes on.

The hosts are those of hosts/build_host.sh. One that is not there is named; without any pair there is nothing to run."""

import os
import pathlib

import pytest

import lmp
import scene
from facts import at_most, fact

LAW = "hooke/history 1e4 NULL 120 NULL 0.4 1"
# The name of each host's MPI in the plugin's message, the host, and its plugin.
HOSTS = {"Open MPI": (os.environ.get("LSDCD_HOST", ""), pathlib.Path(lmp.PLUGIN)),
         "MPICH": (os.environ.get("LSDCD_MPICH_HOST", ""), lmp.LIB / "lsdcd-20260704-mpich-plugin.so"),
         "no MPI": (os.environ.get("LSDCD_SERIAL_HOST", ""), lmp.LIB / "lsdcd-20260704-serial-plugin.so")}
REMEDY = {"Open MPI": "-D MPI_CXX_COMPILER=<the mpicxx of its MPI>", "MPICH": "-D MPI_CXX_COMPILER=<the mpicxx of its MPI>",
          "no MPI": "-D LSDCD_HOST_MPI=OFF"}


THERE = {name: pair for name, pair in HOSTS.items() if pair[0] and pair[1].exists()}


def on_host(host, script, folder):
    own, lmp.LMP = lmp.LMP, str(pathlib.Path(host) / "lmp")
    try:
        return lmp.run(script, folder)
    finally:
        lmp.LMP = own


@pytest.mark.skipif(len(THERE) < 2, reason="fewer than two of LAMMPS with Open MPI, with MPICH and without MPI")
def test_plugins_and_hosts(folder):
    scene.write_floor(folder / "floor.stl")
    body = scene.CREATE + scene.forces(LAW) + scene.dump("moves", 100) + "run 1000\n"
    lmp.run_well(body, folder)
    moves = lmp.read_dump(folder / "moves")
    for name, (host, plugin) in THERE.items():
        done = on_host(host, f"plugin load {plugin}\n" + body, folder)
        fact(f"LAMMPS with {name} runs with its plugin", done.returncode == 0, done.stdout[-300:] * bool(done.returncode))
        # Another compiler or flags may round the integrator otherwise.
        if not done.returncode:
            at_most("the trajectory is that of lmp-lsdcd", lmp.largest_difference(moves, lmp.read_dump(folder / "moves")), 1e-9)
        for other, (_, foreign) in THERE.items():
            if other == name:
                continue
            done = on_host(host, f"plugin load {foreign}\nprint 'LAMMPS goes on'\n", folder)
            said = [line for line in done.stdout.splitlines() if "not loaded" in line]
            fact(f"LAMMPS with {name} refuses the plugin for {other}, and goes on",
                 done.returncode == 0 and "LAMMPS goes on" in done.stdout and len(said) == 1 and
                 said[0].startswith("lsdcd plugin not loaded: ") and f" with {other} and" in said[0] and
                 f" with {name}" in said[0].split("this is")[-1] and REMEDY[name] in said[0],
                 f"exit status {done.returncode}, {' '.join(said) or done.stdout[-300:]}")
