# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What a wall costs a step of a LAMMPS with Kokkos: `./run bench kokkos`.

Beds of spheres (gran/hooke/history/kk) on a flat floor of 2 triangles, in a closed box of
six walls of 20 172 triangles (by hooke/history and by granular mindlin, sds, marshall) and on
a bumpy floor of 1 000 000, timed with fix wall/lsdcd/kk and without any wall from one prepared
state (kokkos_beds.py, kokkos_runs.py).

With a LAMMPS of one's own:
  ./run bench kokkos --lmp FILE --plugin build/lib/lsdcdkkplugin.so --flags "-k on g 1 -sf kk"
Without --lmp: those of LSDCD_KOKKOS_HOSTS, as the build knows them.
"""
import os
import pathlib
import re
import shlex
import shutil
import statistics
import subprocess

import kokkos_runs as runs
import lammps_runs
from kokkos_beds import Bed
from rows import as_csv, cpu, gpu, say, timed

CASES = {"flat": "flat floor", "box": "closed box", "checked": "closed box, check yes",
         "granular": "closed box, granular", "million": "bumpy floor"}
ORDERS = ("random", "sorted")
COPIES = ", copies"
NO_WALL = ", no wall"


# ---- measuring ---------------------------------------------------------------------------

class Rows:
    """Of one bed on one host."""

    def __init__(self, host, bed, named):
        self.host, self.bed = host, bed
        n = os.environ.get("OMP_NUM_THREADS", "1")
        self.device = gpu() if host.on_gpu else f"CPU, {n} thread{'s' * (n != '1')}, {cpu()}"
        self.commit = named
        self.rows = []

    def add(self, more, order, times=None, **what):
        what = {"host": self.host.version.replace(" ", ""), "ranks": self.bed.ranks, **what,
                "flags": self.host.flags.format(ranks=self.bed.ranks).replace(" ", "_")}
        self.rows.append(timed("kokkos", CASES[self.bed.name] + more, self.commit, self.bed.triangles, self.bed.atoms, order,
                               times or [], device=self.device, compiler=self.host.compiler, **what))


def time_steps(host, bed, folder, order, options, settled, rows):
    """With the wall and without in turn, so that what else a machine does meets both."""
    seen = {True: [], False: []}
    for _ in range(options.rounds):
        for wall in seen:
            script = runs.timed_script(host, bed, order, bed.wall() if wall else "", options.steps,
                                       options.chunks)
            seen[wall].append(runs.read_times(host.run_well(script, folder, bed.ranks)))
    times = {wall: [t for s in each for t in s["ms"]] for wall, each in seen.items()}
    ratio = statistics.median(times[True]) / statistics.median(times[False])
    for wall, each in seen.items():
        what = {"steps": options.steps, "builds": sum(s["builds"] for s in each),
                "pair_ms": f"{statistics.median([t for s in each for t in s['pair']]):.4g}"}
        if wall:
            what.update(carried=f"{settled[0]:.3g}", touching=settled[1],
                        wall_steps=sum(s["wall_steps"] for s in each),
                        lists=sum(s["lists"] for s in each), over_no_wall=f"{ratio:.4g}")
        rows.add("" if wall else NO_WALL, order, times[wall], **what)


def time_bodies(host, bed, folder, order, options, rows):
    """Walls without and with a body in turn; prints what a body adds to a step, by the least times."""
    walls = bed.walls_with_body()
    times = {name: [] for name in walls}
    for _ in range(options.rounds):
        for name, wall in walls.items():
            script = runs.timed_script(host, bed, order, wall, options.steps, options.chunks)
            times[name] += runs.read_times(host.run_well(script, folder, bed.ranks))["ms"]
    for name in walls:
        rows.add(name, order, times[name], steps=options.steps)
    for name in walls:
        if not name.endswith("body"):
            continue
        for other in ("at rest", "moves"):
            more = min(times[name]) - min(times[name.replace("body", other)])
            say(f"{CASES[bed.name]}{name}: {1e3 * more:.1f} us a step more than {other}")


def time_lammps_walls(host, bed, folder, order, options, rows):
    """LAMMPS's own walls: some are tens of times as slow, so there are fewer steps."""
    steps = max(10, options.steps // 5)
    for style in ("wall/gran", "wall/gran/kk"):
        if style == "wall/gran/kk" and not host.flat_kk:
            rows.add(", " + style, order, steps=steps, result="not_there")
            continue
        script = runs.timed_script(host, bed, order, bed.wall(style), steps, options.chunks, warm=5)
        output, well = host.run(script, folder, bed.ranks)
        if well:
            rows.add(", " + style, order, runs.read_times(output)["ms"], steps=steps)
        else:
            why = re.search(r"^.*(?:ERROR|error|abort|terminat|Concurrent).*$", output, re.M)
            rows.add(", " + style, order, steps=steps, result="aborts")
            say(f"  {style}: {why.group(0).strip() if why else output[-300:]}")


def count_copies(host, bed, folder, order, options, rows):
    """Of steps without output: those that are not the last of a run."""
    library = folder / "count_copies.so"
    if not library.exists():
        source = pathlib.Path(__file__).with_name("count_copies.cpp")
        subprocess.run([os.environ.get("CXX", "c++"), "-std=c++17", "-O2", "-shared", "-fPIC", "-o",
                        library, source], check=True)
    for wall in (True, False):
        script = runs.timed_script(host, bed, order, bed.wall() if wall else "", options.steps, 1)
        env = {"KOKKOS_TOOLS_LIBS": str(library), "KOKKOS_PROFILE_LIBRARY": str(library),
               "LSDCD_COPIES": str(folder / "copies")}
        host.run_well(script, folder, bed.ranks, env=env)
        steps, seen = [], 0
        for path in folder.glob("copies.*"):
            counts = [tuple(map(int, line.split())) for line in path.read_text().splitlines()]
            steps += counts[1 + runs.WARM:-1]
            seen += sum(s[1] + s[4] for s in counts)
            path.unlink()
        plain, lists = ([s for s in steps if s[0] == k] for k in (0, 1))
        if not plain or not seen:
            say("no copy was seen: this Kokkos was built without its tools interface")
            return

        def mean(rows_, column):
            return f"{sum(s[column] for s in rows_) / len(rows_):.4g}" if rows_ else "none"

        rows.add(("" if wall else NO_WALL) + COPIES, order, steps=len(plain),
                 copies=mean(plain, 1), bytes=mean(plain, 2), largest=max(s[3] for s in plain),
                 within=mean(plain, 4), seen=seen, fused=sum(s[6] for s in steps),
                 list_steps=len(lists),
                 list_copies=mean(lists, 1), list_bytes=mean(lists, 2),
                 list_largest=max((s[3] for s in lists), default=0))


def say_profiler(host, bed, folder, options):
    """Copies that do not go through Kokkos, our engine's among them."""
    for name, wall in (("wall", bed.wall()), ("no_wall", "")):
        (folder / f"in.{name}").write_text(
            runs.timed_script(host, bed, options.orders[0], wall, options.steps, 1))
        say(f"every copy by CUDA, {name} (with --scripts-to DIR and nsys in PATH): cd {folder} && nsys "
            f"profile -t cuda -o {name} {shlex.join(host.command(f'in.{name}', bed.ranks))} && "
            f"nsys stats -r cuda_gpu_mem_time_sum,cuda_gpu_mem_size_sum {name}.nsys-rep")


def measure(host, options, place):
    """Rows of one LAMMPS; beds are made in the folder `place`."""
    say(f"{host.lmp}, LAMMPS {host.version}, {host.flags}")
    found = []
    for each in options.atoms or ([1e6, 8e6] if host.on_gpu else [20000]):
        for ranks in options.ranks:
            for name in options.cases:
                work = place / f"{host.version.replace(' ', '')}-{name}-{each:.0f}-{ranks}"
                work.mkdir(parents=True, exist_ok=True)
                bed = Bed(name, int(each) * ranks, ranks, work, options.triangles)
                settled = runs.prepare(host, bed, work, options.settle,
                                       "random" in options.orders)
                for order in options.orders:
                    rows = Rows(host, bed, options.commit)
                    time_steps(host, bed, work, order, options, settled, rows)
                    if options.bodies and name == "box":
                        time_bodies(host, bed, work, order, options, rows)
                    if options.against and name == "flat":
                        time_lammps_walls(host, bed, work, order, options, rows)
                    if options.copies:
                        count_copies(host, bed, work, order, options, rows)
                    found += rows.rows
                if options.copies and shutil.which("nsys"):
                    say_profiler(host, bed, work, options)
                if not options.scripts_to:
                    shutil.rmtree(work)
    return found


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
        plugin = pathlib.Path(build, "lib", f"lsdcdkkplugin-{name}.so").resolve()
        yield os.path.join(folder, "lmp"), str(plugin)


# ---- words ------------------------------------------------------------------------------

def read_options(words=None):
    p = lammps_runs.parser("kokkos", __doc__)
    p.set_defaults(lmp=None)
    p.add_argument("--plugin", metavar="FILE", help="lsdcdkkplugin.so for it")
    p.add_argument("--flags", default="-k on -sf kk", metavar="WORDS",
                   help="of LAMMPS; {ranks} is the number of processes (default: %(default)s)")
    p.add_argument("--mpi", default="mpirun -np {ranks}", metavar="WORDS",
                   help="what starts several processes (default: %(default)s)")
    p.add_argument("--atoms", type=float, nargs="+", metavar="N",
                   help="per process (default: 1e6 and 8e6 on a GPU, 20000 on a CPU)")
    p.add_argument("--cases", nargs="+", choices=CASES, default=list(CASES))
    p.add_argument("--orders", nargs="+", choices=ORDERS, default=list(ORDERS))
    p.add_argument("--triangles", type=int, default=1000000, metavar="N", help="of the bumpy floor")
    p.add_argument("--steps", type=int, default=100, metavar="N", help="timed as one (default 100)")
    p.add_argument("--chunks", type=int, default=3, metavar="N",
                   help="of these in a run (default 3)")
    p.add_argument("--rounds", type=int, default=2, metavar="N",
                   help="of a run with the wall and one without (default 2)")
    p.add_argument("--settle", type=int, default=3000, metavar="N",
                   help="steps before (default 3000)")
    p.add_argument("--against", action="store_true",
                   help="time LAMMPS's own flat walls on the flat floor, too")
    p.add_argument("--bodies", action="store_true",
                   help="time the closed box, and its floor, as a rigid body, too")
    p.add_argument("--ranks", default="1", metavar="LIST",
                   help='numbers of processes, as "1 2 4": weak scaling')
    p.add_argument("--copies", action="store_true",
                   help="count what Kokkos copies between host and device in a step")
    options = p.parse_args(words)
    options.ranks = [int(word) for word in options.ranks.replace(",", " ").split()]
    if bool(options.lmp) != bool(options.plugin):
        p.error("--lmp and --plugin belong together")
    return options


def main():
    options = read_options()
    if options.quick:
        options.atoms, options.triangles, options.settle = options.atoms or [4000], 20000, 500
    build = os.environ.get("LSDCD_BUILD", "build")
    hosts = [(options.lmp, os.path.abspath(options.plugin))] if options.lmp else built_hosts(build)
    with lammps_runs.work_folder(options.scripts_to) as place:
        print(as_csv([row for lmp, plugin in hosts
                      for row in measure(runs.Host(os.path.abspath(lmp), plugin, options.flags, options.mpi), options, place)]), end="")


if __name__ == "__main__":
    main()
