# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What each fix adds to a step of a hopper in a LAMMPS with Kokkos, in steps in which it has nothing to do: `./run bench hopper`.

A bin over a funnel is made full of grains on a lattice, which settle while the first ones leave. Then the same bed goes on, with the wall
alone and with one thing more in turn: mass flow through the outlet, insertion whose next grain is far away, wear, stress files that are
not due, files of the mesh, and all of them. `insertion, each 100 steps` has work to do, and *plain* are forms without /kk. Books of energy
and impacts have work in each step; those between grains come with `--grains mindlin`.

With a LAMMPS of one's own:
  ./run bench hopper --lmp FILE --plugin build/lib/lsdcdkkplugin.so --flags "-k on g 1 -sf kk -pk kokkos newton off neigh half"
--copies names a command that a script runs between runs, with the file to which it appends numbers of copies so far and their bytes, to the
host and to the device: then rows have them for a step.
"""

import re
import statistics
import sys

from kokkos import FORCES, ORDERS, WARM, WORDS, first_script, on_hosts, plugin_script
from kokkos_beds import GRAINS, Bed
from lammps import bench, loop_ms
from rows import say

DT = 1e-3

BED = """\
timestep        {dt}
thermo_style    custom step atoms
thermo          100000000
region          above block -2 2 -2 2 {top!r} {above!r} units box
variable        touching equal f_wall[7]
"""
WALL = "fix wall all wall/lsdcd {law} mesh wall.stl log brief"
FLOW = "fix flow all massflow/lsdcd mesh outlet.stl every 100000 log brief"
FEED = "fix feed all insert/lsdcd region above numberrate {rate!r} diam one 1.0 dens 1.9098593 every {every}"


def feed(steps):
    return FEED.format(rate=1 / (steps * DT), every=steps)


def variants(grains, against):
    """{case: (words of the wall, other fixes)}; those without /kk last, as LAMMPS then exchanges atoms on the host."""
    wear, stress, files = "wear archard 1e-4 1.0", "mesh_fields fields_*.vtp every 100000000", "mesh_stl wall_*.stl every 100000000"
    rare = 10**6
    found = {"wall": ("", ""), "mass flow": ("", FLOW), "insertion": ("", feed(rare)), "wear": (wear, ""), "stress": (stress, ""),
             "files": (files, ""), "all": (f"{wear} {stress} {files}", f"{FLOW}\n{feed(rare)}"),
             "insertion, each 100 steps": ("", feed(100)),
             "mass flow, delete yes": ("", FLOW + " delete yes"),
             "energy": ("energy", ""), "energy by triangle": (f"energy {stress}", ""), "impacts": ("impacts 1e-3", ""),
             "energy and impacts": ("energy impacts 1e-3", "")}
    if grains == "mindlin":
        found["energy of grains and wall"] = "energy", "compute books all lsdcd/energy"
    if against:
        for name, fixes in (("insertion, plain", feed(rare)), ("mass flow, plain", FLOW)):
            found[name] = "", f"suffix off\n{fixes}\nsuffix on"
    return found


def measured(name, words, fixes, options):
    """A script's part: the wall as it is wanted, and as many runs as are timed."""
    mark = f"shell {options.copies} copies.txt\n" if options.copies else ""
    runs = f"run {options.steps}\n" * options.chunks
    if mark:
        runs += f"{mark}run {options.steps}\n{mark}run {2 * options.steps}\n{mark}"
    ends = "".join(f"un{style} {i}\n" for style, i in re.findall(r"^(fix|compute) (\w+)", fixes, re.M))
    return f'print "case {name}"\nunfix wall\n{WALL.format(law=GRAINS[options.grains][1])} {words}\n{fixes}\nrun {WARM}\n{runs}{ends}'


def read_copies(path, steps):
    """Of each case in turn: what a step copies, from runs of N and 2 N steps."""
    if not path.exists():
        return []
    rows = [[int(word) for word in line.split()] for line in path.read_text().splitlines()]
    names = "to_host", "bytes_to_host", "to_device", "bytes_to_device", "large"
    return [{name: f"{(c[k] - 2 * b[k] + a[k]) / steps:.4g}" for k, name in enumerate(names)} for a, b, c in zip(rows[::3], rows[1::3], rows[2::3])]


def measure_hopper(host, options, place):
    found = []
    for atoms in options.atoms or ([1e6] if host.on_gpu else [20000]):
        work = place / f"{host.version}-{atoms:.0f}"
        work.mkdir(parents=True, exist_ok=True)
        cases = variants(options.grains, options.against)
        cases = {name: cases[name] for name in cases if name == "wall" or not options.cases or name in options.cases}
        # The wall alone comes before each other case, and at the end.
        order = [name for other in cases for name in ({"wall": ()}.get(other, ("wall", other)))] + ["wall"]
        steps = options.settle + len(order) * (WARM + options.steps * (options.chunks + 3 * bool(options.copies)))
        deck = Bed("hopper", int(atoms), 1, work, time=steps * DT)
        text = plugin_script(host, deck) + first_script(deck) + FORCES.format(bed=deck, sort=ORDERS["sorted"], pair=GRAINS[options.grains][0]) + \
            BED.format(dt=DT, top=deck.top, above=deck.top + 8) + WALL.format(law=GRAINS[options.grains][1]) + f"\nrun {options.settle}\n" + \
            'print "touching $(v_touching:%.0f)"\n' + "".join(measured(name, *cases[name], options) for name in order)
        output = host.run(text, work).output
        deck.atoms = int(re.search(r"^bed of (\d+) atoms", output, re.M).group(1))
        touching = re.search(r"^touching (\d+)", output, re.M).group(1)
        parts = re.split(r"^case .*$", output, flags=re.M)[1:]
        times = [loop_ms(part)[1:1 + options.chunks] for part in parts]
        copies = read_copies(work / "copies.txt", options.steps) or [{}] * len(order)
        for k, name in enumerate(order):
            if name == "wall" and k > 0:
                continue
            alone = times[k - 1] + times[k + 1] if k > 0 else times[0]
            more = {} if k == 0 else {"over_wall": f"{statistics.median(times[k]) / statistics.median(alone):.4g}"}
            law = "" if options.grains == "hooke" else f", {options.grains}"
            found.append(host.row("hopper", f"hopper{law}, {name}", deck, options.commit, "sorted", times[k], steps=options.steps,
                                  touching=touching, **more, **copies[k]))
            say(f"{name}: {found[-1]['facts']}")
    return found


if __name__ == "__main__":
    sys.argv[0] = "hopper"
    bench("hopper", __doc__, on_hosts(measure_hopper), WORDS + [
        ("--steps", dict(type=int, default=200, metavar="N", help="timed as one (default %(default)s)")),
        ("--atoms", dict(type=float, nargs="+", metavar="N", help="default: 1e6 on a GPU, 20000 on a CPU")),
        ("--grains", dict(choices=GRAINS, default="hooke", help="as of ./run bench scale (default: %(default)s)")),
        ("--cases", dict(nargs="+", choices=variants("mindlin", True), metavar="NAME", help="of those that are printed (default: all)")),
        ("--settle", dict(type=int, default=4000, metavar="N", help="steps before (default %(default)s)")),
        ("--against", dict(action="store_true", help="time the forms without /kk, too")),
        ("--copies", dict(metavar="COMMAND", help="appends how many copies there were to the file that it is given"))],
        quick={"atoms": [3000], "settle": 200, "steps": 40})
