# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What a wall costs a step of a LAMMPS with Kokkos: `./run bench kokkos`.

Beds of spheres (gran/hooke/history/kk) on a flat floor of 2 triangles, in a closed box of six walls of 20 172 triangles (by
hooke/history and by granular mindlin, sds, marshall) and on a bumpy floor of 1 000 000, timed with fix wall/lsdcd/kk and without any
wall from one prepared state. Three scripts make a measurement. The first fills a lattice and, where runs want it, gives the atoms a
random order in memory, without Kokkos: they are put to random places, sorted there by LAMMPS, and put back. The second lets them settle
on our wall and sets them in motion along it. The third begins from what the second has written, with a wall or without, and is timed.

With a LAMMPS of one's own:
  ./run bench kokkos --lmp FILE --plugin build/lib/lsdcdkkplugin.so --flags "-k on g 1 -sf kk"
Without --lmp: those of LSDCD_KOKKOS_HOSTS, as the build knows them.
"""
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess

from kokkos_beds import GRAINS, Bed
from lammps import Program, bench, in_turn, loop_ms
from rows import cpu, gpu, say, timed

CASES = {"flat": "flat floor", "box": "closed box", "checked": "closed box, check yes",
         "granular": "closed box, granular", "million": "bumpy floor"}
ORDERS = {"random": "0 0", "sorted": "1000 0.0"}    # and how LAMMPS sorts atoms then
NO_WALL = ", no wall"
WARM = 20    # steps before those that are timed
# Short steps, so that little is heard of a missing floor while they are timed; at SPEED 50 of them are half the skin.
SETTLE_DT, DT = 1e-3, 5e-5

START = """\
units           lj
atom_style      sphere
boundary        {bed.boundary}
newton          off
comm_modify     vel yes cutoff 2.0
lattice         {bed.lattice}
region          box block {bed.box} units box
create_box      1 box
{bed.region}
create_atoms    1 region bed
group           surplus id > {bed.atoms}
delete_atoms    group surplus compress no
variable        diameter atom {bed.diameters}
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

PLUGIN = """\
plugin          load {plugin}
newton          off
comm_modify     vel yes
{processors}
"""

FORCES = """\
atom_modify     sort {sort}
{pair}
neighbor        0.1 bin
neigh_modify    {bed.neighbours}
fix             move all nve/sphere
fix             pull all gravity {bed.gravity} vector 0 0 -1
"""

# Four times from no motion: the swinging of a tall bed goes.
SETTLED = """\
variable        carried equal -f_wall[3]/(mass(all)*{bed.gravity})
variable        touching equal f_wall[7]
thermo_style    custom step atoms ke v_carried v_touching
thermo          {settle}
timestep        {settle_dt}
run             {half}
{still}
print           "settled: carried $(v_carried:%.4f) touching $(v_touching:%.0f)"
{bed.motion}
timestep        {dt}
run             200
unfix           wall
pair_style      none
write_restart   bed.restart
"""

TIMED = """\
thermo_style    custom step atoms
thermo          100000000
timestep        {dt}
run             {warm}
"""


class Host(Program):
    """A LAMMPS with Kokkos, and the plugin for it."""

    def __init__(self, lmp, plugin, flags, mpi):
        super().__init__(lmp, flags, mpi, threads=os.environ.get("OMP_NUM_THREADS", "1"))
        self.plugin = os.path.abspath(plugin)
        for path in (self.path, self.plugin):
            if not os.path.exists(path):
                raise SystemExit(f"there is no {path}")
        text = subprocess.run([self.path, "-help"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=self.env).stdout
        backend = re.search(r"KOKKOS package API:\s*(.*)", text)
        if not backend:
            raise SystemExit(f"{lmp} has no KOKKOS package:\n{text[:500]}")
        on_gpu = "CUDA" in backend.group(1) and re.search(r"\bg(pus)? ", flags) is not None
        n = self.env["OMP_NUM_THREADS"]
        self.on_gpu, self.device = on_gpu, gpu() if on_gpu else f"CPU, {n} thread{'s' * (n != '1')}, {cpu()}"
        self.version = re.search(r"- (\d+ \w+ \d+)", text).group(1).replace(" ", "")
        self.compiler = re.search(r"Compiler:\s*(.*?)( with OpenMP|$)", text, re.M).group(1)
        self.flat_kk = "wall/gran/kk" in text

    def row(self, program, case, bed, commit, order, times=(), **what):
        what = {"host": self.version, "ranks": bed.ranks, **what, "flags": self.flags.format(ranks=bed.ranks).replace(" ", "_")}
        return timed(program, case, commit, bed.triangles, bed.atoms, order, list(times), device=self.device, compiler=self.compiler,
                     **{name: value for name, value in what.items() if value is not None})


# ---- kokkos: beds with and without a wall ----------------------------------------------------------

def first_script(bed):
    return START.format(bed=bed, dense=6 / math.pi)    # mass 1 at diameter 1


def plugin_script(host, bed):
    return PLUGIN.format(plugin=host.plugin, processors=bed.processors())


def script_from(host, bed, file, wall, sort="0 0"):
    return plugin_script(host, bed) + f"read_restart {file}\n" + FORCES.format(bed=bed, sort=sort, pair=GRAINS["hooke"][0]) + wall + "\n"


def prepare(host, bed, folder, settle, shuffled):
    """Leaves bed.restart in the folder; returns what the wall carries of the bed's weight when it has settled, and contacts with it.
    Without `shuffled`, for runs in which LAMMPS sorts its atoms, it spares the time that a random order takes."""
    shuffle = SHUFFLE.format(bin=(bed.volume / bed.atoms)**(1 / 3)) if shuffled else ""
    output = host.run(first_script(bed) + shuffle + "write_restart lattice.restart\n", folder, plain=True).output
    made = int(re.search(r"^bed of (\d+) atoms", output, re.M).group(1))
    if made != bed.atoms:
        raise SystemExit(f"{bed.name}: the lattice has {made} sites for {bed.atoms} atoms")
    still = f"velocity all set 0 0 0\nrun {settle // 8}\n" * 4
    output = host.run(script_from(host, bed, "lattice.restart", bed.wall()) +
                      SETTLED.format(bed=bed, settle=settle, settle_dt=SETTLE_DT, half=settle // 2, still=still, dt=DT),
                      folder, bed.ranks).output
    (folder / "lattice.restart").unlink()
    carried, touching = re.search(r"^settled: carried (\S+) touching (\S+)", output, re.M).groups()
    return {"carried": f"{float(carried):.3g}", "touching": touching}


def timed_script(host, bed, order, wall, steps, chunks, warm=WARM):
    return script_from(host, bed, "bed.restart", wall, ORDERS[order]) + TIMED.format(dt=DT, warm=warm) + f"run {steps}\n" * chunks


def time_steps(host, bed, folder, order, options, settled):
    times = in_turn(options.rounds, (bed.wall(), ""), lambda wall: loop_ms(host.run(
        timed_script(host, bed, order, wall, options.steps, options.chunks), folder, bed.ranks).output)[1:])
    with_wall, without = map(statistics.median, times.values())
    over = {**settled, "over_no_wall": f"{with_wall / without:.4g}"}
    return [host.row("kokkos", CASES[bed.name] + NO_WALL * (not wall), bed, options.commit, order, ms, steps=options.steps, **(over if wall else {}))
            for wall, ms in times.items()]


def time_bodies(host, bed, folder, order, options):
    """Walls without and with a body in turn; prints what a body adds to a step, by the least times."""
    walls = bed.walls_with_body()
    times = in_turn(options.rounds, walls, lambda name: loop_ms(host.run(
        timed_script(host, bed, order, walls[name], options.steps, options.chunks), folder, bed.ranks).output)[1:])
    for name in walls:
        for other in ("at rest", "moves") * name.endswith("body"):
            more = min(times[name]) - min(times[name.replace("body", other)])
            say(f"{CASES[bed.name]}{name}: {1e3 * more:.1f} us a step more than {other}")
    return [host.row("kokkos", CASES[bed.name] + name, bed, options.commit, order, ms, steps=options.steps)
            for name, ms in times.items()]


def time_lammps_walls(host, bed, folder, order, options):
    """LAMMPS's own walls: some are tens of times as slow, so there are fewer steps."""
    steps, found = max(10, options.steps // 5), []
    for style in ("wall/gran", "wall/gran/kk"):
        times, result = [], "not_there"
        if style == "wall/gran" or host.flat_kk:
            run = host.run(timed_script(host, bed, order, bed.wall(style), steps, options.chunks, warm=5), folder, bed.ranks, may_fail=True)
            times, result = ([], "aborts") if run.failed else (run.step_ms()[1:], None)
            if run.failed:
                say(f"  {style}: {run.output[-300:]}")
        found.append(host.row("kokkos", CASES[bed.name] + ", " + style, bed, options.commit, order, times, steps=steps, result=result))
    return found


def measure_beds(host, options, place):
    """Rows of one LAMMPS; beds are made in the folder `place`."""
    found = []
    for each in options.atoms or ([1e6, 8e6] if host.on_gpu else [20000]):
        for ranks in options.ranks:
            for name in options.cases:
                work = place / f"{host.version}-{name}-{each:.0f}-{ranks}"
                work.mkdir(parents=True, exist_ok=True)
                bed = Bed(name, int(each) * ranks, ranks, work, options.triangles)
                settled = prepare(host, bed, work, options.settle, "random" in options.orders)
                for order in options.orders:
                    found += time_steps(host, bed, work, order, options, settled)
                    if options.bodies and name == "box":
                        found += time_bodies(host, bed, work, order, options)
                    if options.against and name == "flat":
                        found += time_lammps_walls(host, bed, work, order, options)
                if not options.scripts_to:
                    shutil.rmtree(work)
    return found


# ---- words ------------------------------------------------------------------------------

def built_hosts(build):
    """Folders of LAMMPS that the build has a plugin for, each with that plugin."""
    cache = pathlib.Path(build, "CMakeCache.txt")
    found = re.search(r"^LSDCD_KOKKOS_HOSTS:\w+=(.+)$", cache.read_text() if cache.exists() else "",
                      re.M)
    if not found:
        raise SystemExit(f"{build} knows no LAMMPS with Kokkos: name one with --lmp, --plugin and "
                         "--flags, or configure with -D LSDCD_KOKKOS_HOSTS=FOLDER "
                         "(tests/lammps/hosts/build_host.sh)")
    for folder in found.group(1).split(";"):
        text = pathlib.Path(folder, "host.cmake").read_text()
        name = re.search(r"LSDCD_HOST_VERSION \"?(\d+)", text).group(1)
        kind = re.search(r"LSDCD_HOST_KIND \"(\w+)\"", text)
        name += f"-{kind.group(1)}" if kind else ""
        yield os.path.join(folder, "lmp"), os.path.join(build, "lib", f"lsdcdkkplugin-{name}.so")


def on_hosts(measure):
    """What bench() wants of a function that measures one LAMMPS."""
    def all_hosts(options, place):
        options.ranks = [int(word) for word in options.ranks.replace(",", " ").split()]
        hosts = [(options.lmp, options.plugin)] if options.plugin else built_hosts(os.environ.get("LSDCD_BUILD", "build"))
        return [row for lmp, plugin in hosts for row in measure(Host(lmp, plugin, options.flags, options.mpi), options, place)]
    return all_hosts


WORDS = [
    ("--plugin", dict(metavar="FILE", help="lsdcdkkplugin.so for the LAMMPS of --lmp")),
    ("--flags", dict(default="-k on -sf kk", metavar="WORDS",
                     help="of LAMMPS; {ranks} is the number of processes (default: %(default)s)")),
    ("--mpi", dict(default="mpirun -np {ranks}", metavar="WORDS", help="what starts several processes (default: %(default)s)")),
    ("--ranks", dict(default="1", metavar="LIST", help='numbers of processes, as "1 2 4": weak scaling')),
    ("--chunks", dict(type=int, default=3, metavar="N", help="timed in a run (default %(default)s)"))]
OF_BEDS = [
    ("--steps", dict(type=int, default=100, metavar="N", help="timed as one (default %(default)s)")),
    ("--atoms", dict(type=float, nargs="+", metavar="N", help="per process (default: 1e6 and 8e6 on a GPU, 20000 on a CPU)")),
    ("--cases", dict(nargs="+", choices=CASES, default=list(CASES))),
    ("--orders", dict(nargs="+", choices=ORDERS, default=list(ORDERS))),
    ("--triangles", dict(type=int, default=1000000, metavar="N", help="of the bumpy floor")),
    ("--rounds", dict(type=int, default=2, metavar="N", help="of a run with the wall and one without (default %(default)s)")),
    ("--settle", dict(type=int, default=3000, metavar="N", help="steps before (default %(default)s)")),
    ("--against", dict(action="store_true", help="time LAMMPS's own flat walls on the flat floor, too")),
    ("--bodies", dict(action="store_true", help="time the closed box, and its floor, as a rigid body, too"))]

if __name__ == "__main__":
    bench("kokkos", __doc__, on_hosts(measure_beds), WORDS + OF_BEDS, quick={"atoms": [4000], "triangles": 20000, "settle": 500})
