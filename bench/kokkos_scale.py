# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""How many grains a LAMMPS with Kokkos holds in a mesh, and what the wall costs a step then: `./run bench scale`.

As many spheres for each process, each with a GPU of its own, in a closed box where a lattice of them touches each other, in a drum of
some 2e5 triangles that turns, half full, and in a hopper that empties: steps without the wall, with it and without it again, in one run;
memory of a card; times of setting up. Grains in the drum and in the hopper settle first; those without the wall are timed after it.

With a LAMMPS of one's own:
  ./run bench scale --lmp FILE --plugin build/lib/lsdcdkkplugin.so --ranks "1 2 4" --side 292 \\
    --flags "-k on g {ranks} -sf kk -pk kokkos newton off neigh half gpu/aware on comm device"
"""
import re
import shutil
import statistics

from kokkos import DT, FORCES, NO_WALL, ORDERS, SETTLE_DT, WARM, WORDS, first_script, on_hosts, plugin_script
from kokkos_beds import GRAINS, WALL_CELLS, Bed
from lammps import bench, loop_ms
from rows import say

SCENES = {"box": "closed box", "drum": "turning drum", "hopper": "emptying hopper"}

SCRIPT = """\
variable        made timer
run             0
variable        alone timer
print           "made in $(v_made-v_began) s, set up in $(v_alone-v_made) s"
run             {warm}
{chunks}
shell           {memory} > memory.alone
print           "with the wall"
variable        before timer
{wall}
run             0
variable        after timer
variable        touching equal f_wall[7]
{settle}
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


def memory(path):
    """MiB of the fullest card, or nothing."""
    try:
        return max(int(word) for word in path.read_text().split())
    except (OSError, ValueError):
        return None


def time_scene(host, bed, grains, options, work):
    """Without the wall and with it; `grains`: the law of grains, which the wall has, too."""
    pair, bed.law = GRAINS[grains]
    moves = bed.name != "box"
    ask = "nvidia-smi --query-gpu=memory.used --format=csv,noheader,nounits" if host.on_gpu else "true"
    quiet = f"thermo_style custom step atoms\nthermo 100000000\ntimestep {SETTLE_DT if moves else DT}\n"
    run = host.run(plugin_script(host, bed) + "variable began timer\n" + first_script(bed) +
                   FORCES.format(bed=bed, sort=ORDERS["sorted"], pair=pair) + quiet +
                   SCRIPT.format(warm=WARM, chunks=f"run {options.steps}\n" * options.chunks, memory=ask, wall=bed.wall(),
                                 settle=f"run {options.settle}" * moves),
                   work, bed.ranks, may_fail=True)
    if run.failed:
        say(f"{bed.ranks} processes failed:\n{run.output[-1500:]}")
        return []
    bed.atoms = int(re.search(r"^bed of (\d+) atoms", run.output, re.M).group(1))
    before, wall, after = (loop_ms(part)[1:] for part in re.split(r"^with the wall$|^without$", run.output, flags=re.M))
    if moves:    # grains lay still before, and settling is a run of its own
        before, wall = [], wall[1:]
    made, alone = re.search(r"^made in (\S+) s, set up in (\S+) s", run.output, re.M).groups()
    wall_s, touching = re.search(r"^wall set up in (\S+) s, touching (\d+)", run.output, re.M).groups()
    case = SCENES[bed.name] + f", {grains}" * (grains != "hooke")

    def row(name, ms, **what):
        return host.row("scale", case + name, bed, options.commit, "sorted", ms, steps=options.steps, **what)

    return [row(NO_WALL, before + after, make_s=f"{float(made):.3g}", setup_s=f"{float(alone):.3g}", mib=memory(work / "memory.alone")),
            row("", wall, setup_s=f"{float(wall_s):.3g}", touching=touching, mib=memory(work / "memory.wall"),
                over_no_wall=f"{statistics.median(wall) / statistics.median(before + after):.4g}")]


def measure_scale(host, options, place):
    found = []
    for ranks in options.ranks:
        for name in options.scenes:
            for cells in options.cells if name == "box" else [WALL_CELLS]:
                for grains in options.grains:
                    work = place / f"{ranks}-{name}-{cells}-{grains}"
                    work.mkdir(parents=True, exist_ok=True)
                    steps = options.settle + 2 * WARM + 2 * options.steps * options.chunks
                    bed = Bed(name, ranks * options.side**3, ranks, work, cells=cells, time=steps * SETTLE_DT)
                    found += time_scene(host, bed, grains, options, work)
                    if not options.scripts_to:
                        shutil.rmtree(work)
    return found


OF_SCALE = [
    ("--steps", dict(type=int, default=50, metavar="N", help="timed as one (default %(default)s)")),
    ("--side", dict(type=int, default=292, metavar="N", help="N^3 spheres for each process (default %(default)s)")),
    ("--scenes", dict(nargs="+", choices=SCENES, default=["box"], help="(default: box)")),
    ("--grains", dict(nargs="+", choices=GRAINS, default=["hooke"], help="the law of grains and of the wall: gran/hooke/history of "
                      "LAMMPS, or one of granular/lsdcd: mindlin is Hertz and Mindlin, capillary the same with bridges (default: hooke)")),
    ("--settle", dict(type=int, default=1000, metavar="N", help="steps before those of a drum and a hopper (default %(default)s)")),
    ("--cells", dict(type=int, nargs="+", default=[WALL_CELLS], metavar="N",
                     help="the mesh of the box has 12 N^2 triangles (default: %(default)s)"))]

if __name__ == "__main__":
    bench("scale", __doc__, on_hosts(measure_scale), WORDS + OF_SCALE, quick={"side": 16})
