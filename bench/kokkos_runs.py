# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Runs of the beds of kokkos.py in a LAMMPS with Kokkos.

Three scripts make a measurement. The first fills a lattice and, where runs want it, gives the
atoms a random order in memory, without Kokkos: they are put to random places, sorted there by
LAMMPS, and put back. The second lets them settle on our wall and sets them in motion along it. The
third begins from what the second has written, with a wall or without, and is timed.
"""
import math
import os
import re
import shlex
import subprocess

from kokkos_beds import LAW

SKIN = 0.1
WARM = 20    # steps before those that are timed
# Short steps, so that little is heard of a missing floor while they are timed; at SPEED 50
# of them are half the skin.
SETTLE_DT, DT = 1e-3, 5e-5

START = """\
units           lj
atom_style      sphere
boundary        {boundary}
newton          off
comm_modify     vel yes cutoff 2.0
lattice         {lattice}
region          box block {box} units box
create_box      1 box
{region}
create_atoms    1 region bed
group           surplus id > {atoms}
delete_atoms    group surplus compress no
variable        diameter atom {diameters}
set             group all diameter v_diameter
set             group all density {dense!r}
variable        count equal atoms
print           "bed of $(v_count:%.0f) atoms"
"""

# Velocities keep the places while LAMMPS sorts.
SHUFFLE = """\
variable        x atom x
variable        y atom y
variable        z atom z
velocity        all set v_x v_y v_z units box
variable        rx atom random(xlo,xhi,11)
variable        ry atom random(ylo,yhi,12)
variable        rz atom random(zlo,zhi,13)
set             group all x v_rx y v_ry z v_rz
atom_modify     sort 1 {bin!r}
run             0
variable        x atom vx
variable        y atom vy
variable        z atom vz
set             group all x v_x y v_y z v_z
velocity        all set 0 0 0
"""

FROM_FILE = """\
plugin          load {plugin}
newton          off
comm_modify     vel yes
{processors}
read_restart    {file}
atom_modify     sort {sort}
pair_style      gran/{law}
pair_coeff      * *
neighbor        {skin} bin
neigh_modify    {neighbours}
fix             move all nve/sphere
fix             pull all gravity {gravity} vector 0 0 -1
{wall}
"""

SETTLED = """\
variable        carried equal -f_wall[3]/(mass(all)*{gravity})
variable        touching equal f_wall[7]
thermo_style    custom step atoms ke v_carried v_touching
thermo          {settle}
timestep        {settle_dt}
run             {half}
{still}
print           "settled: carried $(v_carried:%.4f) touching $(v_touching:%.0f)"
{motion}
timestep        {dt}
run             200
unfix           wall
pair_style      none
write_restart   {out}
"""

TIMED = """\
thermo_style    custom step atoms
thermo          100000000
timestep        {dt}
run             {warm}
"""


# ---- hosts -------------------------------------------------------------------------------

class Host:
    """A LAMMPS with Kokkos, the plugin for it and the words that start it; in `flags` and
    `mpi` stands {ranks} for their number."""

    def __init__(self, lmp, plugin, flags, mpi):
        self.lmp, self.plugin, self.flags, self.mpi = lmp, plugin, flags, mpi
        for path in (lmp, plugin):
            if not os.path.exists(path):
                raise SystemExit(f"there is no {path}")
        text = subprocess.run([lmp, "-help"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, env=environment()).stdout
        backend = re.search(r"KOKKOS package API:\s*(.*)", text)
        if not backend:
            raise SystemExit(f"{lmp} has no KOKKOS package:\n{text[:500]}")
        self.on_gpu = "CUDA" in backend.group(1) and re.search(r"\bg(pus)? ", flags) is not None
        self.version = re.search(r"- (\d+ \w+ \d+)", text).group(1)
        self.compiler = re.search(r"Compiler:\s*(.*?)( with OpenMP|$)", text, re.M).group(1)
        self.flat_kk = "wall/gran/kk" in text

    def command(self, script, ranks=1, kokkos=True):
        words = [self.lmp, "-in", script, "-log", "none", "-nocite"]
        words += shlex.split(self.flags.format(ranks=ranks)) if kokkos else []
        return (shlex.split(self.mpi.format(ranks=ranks)) if ranks > 1 else []) + words

    def run(self, text, folder, ranks=1, kokkos=True, env=None):
        """Output and whether it went well."""
        (folder / "in.script").write_text(text)
        done = subprocess.run(self.command("in.script", ranks, kokkos), cwd=folder, text=True,
                              env={**environment(), **(env or {})}, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
        return done.stdout, done.returncode == 0

    def run_well(self, *args, **kwargs):
        output, well = self.run(*args, **kwargs)
        if not well:
            raise SystemExit(f"{self.lmp} failed:\n{output[-4000:]}")
        return output


def environment():
    # Open MPI refuses root, and more ranks than cores.
    return {"OMP_NUM_THREADS": "1", **os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1",
            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
            "OMPI_MCA_hwloc_base_binding_policy": "none"}


# ---- runs --------------------------------------------------------------------------------

def still(steps):
    """Takes the swinging of a tall bed out: four times it begins from no motion."""
    return f"velocity all set 0 0 0\nrun {steps}\n" * 4


def script_from(host, bed, file, wall, sort="0 0"):
    return FROM_FILE.format(plugin=host.plugin, processors=bed.processors(), sort=sort, file=file,
                            law=LAW, skin=SKIN, gravity=bed.gravity,
                            neighbours=bed.neighbours, wall=wall)


def prepare(host, bed, folder, settle, shuffled=True):
    """Leaves bed.restart in the folder; returns what the wall carries of the bed's weight
    when it has settled, and contacts with it. Without `shuffled`, for runs in which LAMMPS
    sorts its atoms, it spares the time that a random order takes."""
    start = START.format(boundary=bed.boundary, lattice=bed.lattice, box=bed.box,
                         region=bed.region, atoms=bed.atoms, diameters=bed.diameters,
                         dense=6 / math.pi)    # mass 1 at diameter 1
    shuffle = SHUFFLE.format(bin=(bed.volume / bed.atoms)**(1 / 3)) if shuffled else ""
    output = host.run_well(start + shuffle + "write_restart lattice.restart\n", folder,
                           kokkos=False)
    made = int(re.search(r"^bed of (\d+) atoms", output, re.M).group(1))
    if made != bed.atoms:
        raise SystemExit(f"{bed.name}: the lattice has {made} sites for {bed.atoms} atoms")
    output = host.run_well(
        script_from(host, bed, "lattice.restart", bed.wall()) +
        SETTLED.format(gravity=bed.gravity, settle=settle, settle_dt=SETTLE_DT,
                       half=settle // 2, still=still(settle // 8), dt=DT,
                       motion=bed.motion, out="bed.restart"), folder, bed.ranks)
    (folder / "lattice.restart").unlink()
    carried, touching = re.search(r"^settled: carried (\S+) touching (\S+)", output, re.M).groups()
    return float(carried), int(touching)


def timed_script(host, bed, order, wall, steps, chunks, warm=WARM):
    sort = {"random": "0 0", "sorted": "1000 0.0"}[order]
    return (script_from(host, bed, "bed.restart", wall, sort) + TIMED.format(dt=DT, warm=warm) +
            f"run {steps}\n" * chunks)


def read_times(output):
    """Of the timed runs, without the first: ms per step of each, of which pairs, builds of
    neighbour lists; steps and choices of near atoms that our fix says."""
    loops = re.findall(r"^Loop time of (\S+) on .* for (\d+) steps", output, re.M)[1:]
    pair = re.findall(r"^Pair\s*\|\s*\S+\s*\|\s*(\S+)", output, re.M)[1:]
    builds = re.findall(r"^Neighbor list builds = (\d+)", output, re.M)[1:]
    lists = re.findall(r": (\d+) steps?( and the setup)?: atoms near the wall chosen (\d+) time", output)[1:]
    return {"ms": [1e3 * float(t) / int(n) for t, n in loops],
            "pair": [1e3 * float(p) / int(n) for p, (_, n) in zip(pair, loops)],
            "builds": sum(map(int, builds)),
            "wall_steps": sum(int(steps) + bool(setup) for steps, setup, _ in lists),
            "lists": sum(int(chosen) for _, _, chosen in lists)}
