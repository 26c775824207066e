# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""How many grains a LAMMPS with Kokkos holds in a mesh, and what the wall costs it then: `./run bench scale`.

A closed box full of spheres (that of `./run bench kokkos`), as many for each process, each with a GPU of its own: steps without the
wall, with it and without it again, in one run; memory of a card; times of setting up. Needs a LAMMPS of one's own:
  ./run bench scale --lmp FILE --plugin build/lib/lsdcdkkplugin.so --ranks "1 2 4" --side 292 \\
    --flags "-k on g {ranks} -sf kk -pk kokkos newton off neigh half gpu/aware on comm device"
"""
import math
import os
import re
import shutil
import statistics

import kokkos_beds
import kokkos_runs as runs
import lammps_runs
from rows import as_csv, cpu, gpu, say, timed
from stl import write_stl

SCRIPT = """\
plugin          load {plugin}
units           lj
atom_style      sphere
boundary        f f f
newton          off
comm_modify     vel yes
{processors}
atom_modify     sort 1000 0.0
lattice         {lattice}
region          box block {box} units box
create_box      1 box
{region}
variable        began timer
create_atoms    1 region bed
set             group all diameter 1.0
set             group all density {dense!r}
variable        made timer
pair_style      gran/{law}
pair_coeff      * *
neighbor        {skin} bin
neigh_modify    {neighbours}
fix             move all nve/sphere
fix             pull all gravity {gravity} vector 0 0 -1
thermo_style    custom step atoms
thermo          100000000
timestep        {dt}
run             0
variable        alone timer
variable        grains equal atoms
print           "made $(v_grains:%.0f) grains in $(v_made-v_began) s, set up in $(v_alone-v_made) s"
run             {warm}
{chunks}
shell           {memory} > memory.alone
print           "with the wall"
variable        before timer
fix             wall all wall/lsdcd {law} mesh {mesh}
run             0
variable        after timer
variable        touching equal f_wall[7]
thermo_style    custom step atoms v_touching
run             {warm}
print           "wall set up in $(v_after-v_before) s, touching $(v_touching:%.0f)"
thermo_style    custom step atoms
{chunks}
shell           {memory} > memory.wall
print           "without"
unfix           wall
run             {warm}
{chunks}
"""
MEMORY = "nvidia-smi --query-gpu=memory.used --format=csv,noheader,nounits"


def times(output):
    """ms per step of the runs before the wall, with it and after it."""
    parts = re.split(r"^with the wall$|^without$", output, flags=re.M)
    loops = [re.findall(r"^Loop time of (\S+) on .* for (\d+) steps", part, re.M) for part in parts]
    return [[1e3 * float(t) / int(n) for t, n in found if int(n) > 0][1:] for found in loops]


def memory(path):
    """MiB of the fullest card, or nothing."""
    try:
        return max(int(word) for word in path.read_text().split())
    except (OSError, ValueError):
        return None


def script(host, bed, options):
    return SCRIPT.format(plugin=host.plugin, processors=bed.processors(), lattice=bed.lattice, box=bed.box, region=bed.region,
                         dense=6 / math.pi, law=bed.law, skin=runs.SKIN, neighbours=bed.neighbours, gravity=bed.gravity, dt=runs.DT,
                         warm=runs.WARM, chunks=f"run {options.steps} pre no\n" * options.chunks, memory=MEMORY if host.on_gpu else "true",
                         mesh=bed.mesh)


def rows(host, bed, options, output, work):
    """Without the wall and with it, from what the script has printed."""
    before, wall, after = times(output)
    ratio = statistics.median(wall) / statistics.median(before + after)
    grains, made, alone = re.search(r"^made (\d+) grains in (\S+) s, set up in (\S+) s", output, re.M).groups()
    wall_s, touching = re.search(r"^wall set up in (\S+) s, touching (\d+)", output, re.M).groups()
    device = gpu() if host.on_gpu else f"CPU, 1 thread, {cpu()}"

    def row(name, ms, **found):
        found = {k: v for k, v in found.items() if v is not None}
        return timed("scale", "closed box" + name, options.commit, bed.triangles, int(grains), "sorted", ms, device=device,
                     compiler=host.compiler, host=host.version.replace(" ", ""), ranks=bed.ranks, steps=options.steps, **found,
                     flags=host.flags.format(ranks=bed.ranks).replace(" ", "_"))

    return [row(", no wall", before + after, make_s=f"{float(made):.3g}", setup_s=f"{float(alone):.3g}", mib=memory(work / "memory.alone")),
            row("", wall, setup_s=f"{float(wall_s):.3g}", touching=touching, mib=memory(work / "memory.wall"), over_no_wall=f"{ratio:.4g}")]


def bed_of(ranks, cells, side, work):
    """As many spheres for each process, and a mesh of 12 cells^2 triangles."""
    bed = kokkos_beds.Bed("box", ranks * side**3, ranks, work)
    triangles = kokkos_beds.box(bed.side, cells)
    bed.triangles = len(triangles)
    write_stl(bed.mesh, triangles, "a closed box")
    return bed


def measure(host, options, place):
    found = []
    for ranks in options.ranks:
        for cells in options.cells:
            work = place / f"{ranks}-{cells}"
            work.mkdir(parents=True, exist_ok=True)
            bed = bed_of(ranks, cells, options.side, work)
            output, well = host.run(script(host, bed, options), work, ranks)
            if well:
                found += rows(host, bed, options, output, work)
            else:
                say(f"{ranks} processes failed:\n{output[-1500:]}")
            if not options.scripts_to:
                shutil.rmtree(work)
    return found


def main():
    p = lammps_runs.parser("scale", __doc__)
    p.set_defaults(lmp=None)
    p.add_argument("--plugin", metavar="FILE", help="lsdcdkkplugin.so for it")
    p.add_argument("--flags", default="-k on -sf kk", metavar="WORDS",
                   help="of LAMMPS; {ranks} is the number of processes (default: %(default)s)")
    p.add_argument("--mpi", default="mpirun -np {ranks}", metavar="WORDS", help="what starts several processes (default: %(default)s)")
    p.add_argument("--side", type=int, default=292, metavar="N", help="N^3 spheres for each process (default %(default)s)")
    p.add_argument("--cells", type=int, nargs="+", default=[kokkos_beds.WALL_CELLS], metavar="N",
                   help="the mesh has 12 N^2 triangles (default: %(default)s)")
    p.add_argument("--ranks", default="1", metavar="LIST", help='numbers of processes, as "1 2 4"')
    p.add_argument("--steps", type=int, default=50, metavar="N", help="timed as one (default %(default)s)")
    p.add_argument("--chunks", type=int, default=3, metavar="N", help="of these in a run (default %(default)s)")
    options = p.parse_args()
    options.ranks = [int(word) for word in options.ranks.replace(",", " ").split()]
    if options.quick:
        options.side = min(options.side, 16)
    if not options.lmp or not options.plugin:
        p.error("name a LAMMPS with Kokkos by --lmp and its plugin by --plugin")
    host = runs.Host(os.path.abspath(options.lmp), os.path.abspath(options.plugin), options.flags, options.mpi)
    with lammps_runs.work_folder(options.scripts_to) as place:
        print(as_csv(measure(host, options, place)), end="")


if __name__ == "__main__":
    main()
