# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What each fix adds to a step of a hopper in a LAMMPS with Kokkos, in steps in which it has nothing to do: `./run bench hopper`.

A bin over a funnel is made full of grains on a lattice, which settle while the first ones leave. Then the same bed goes on, with the wall
alone and with one thing more in turn: mass flow through the outlet, insertion whose next grain is far away, wear, stress files that are
not due, files of the mesh, and all of them. `insertion, each 100 steps` has work to do, and *plain* are forms without /kk.

With a LAMMPS of one's own:
  ./run bench hopper --lmp FILE --plugin build/lib/lsdcdkkplugin.so --flags "-k on g 1 -sf kk -pk kokkos newton off neigh half"
--copies names a command that a script runs between runs, with the file to which it appends numbers of copies so far and their bytes, to the
host and to the device: then rows have them for a step.
"""
import math
import re
import statistics
import sys

from kokkos import WARM, WORDS, on_hosts, plugin_script
from kokkos_beds import LAW
from lammps import bench, loop_ms
from rows import say
from stl import strip, write_stl

DT = 1e-3
AROUND, RINGS = 180, 28    # segments, and rings of each part

SCRIPT = """\
units           lj
atom_style      sphere
boundary        f f f
lattice         sc 1.0 origin 0.5 0.5 0.5
region          box block {box} units box
create_box      1 box
region          bin cylinder z 0 0 {inner!r} {radius!r} {top!r} units box
region          funnel cone z 0 0 {low!r} {inner!r} 0 {radius!r} units box
region          grains union 2 bin funnel
create_atoms    1 region grains
variable        diameter atom 0.95+0.05*random(0,1,7)
set             group all diameter v_diameter
set             group all density 1.9098593
variable        count equal atoms
print           "bed of $(v_count:%.0f) atoms"
pair_style      gran/{law}
pair_coeff      * *
neighbor        0.1 bin
neigh_modify    delay 0 every 1 check yes
fix             move all nve/sphere
fix             pull all gravity 1.0 vector 0 0 -1
timestep        {dt}
thermo_style    custom step atoms
thermo          100000000
region          above block -2 2 -2 2 {top!r} {above!r} units box
variable        touching equal f_wall[7]
"""
WALL = "fix wall all wall/lsdcd {law} mesh wall.stl log brief"
FLOW = "fix flow all massflow/lsdcd mesh outlet.stl every 100000 log brief"
FEED = "fix feed all insert/lsdcd region above numberrate {rate!r} diam one 1.0 dens 1.9098593 every {every}"


class Hopper:
    """Of about `atoms` grains of diameter 1."""

    def __init__(self, atoms, folder):
        self.ranks, self.atoms = 1, int(atoms)
        self.radius = (atoms / 7.5)**(1 / 3)
        self.outlet = max(3.0, 0.12 * self.radius)
        self.top = 3 * self.radius
        levels = [(self.outlet + (self.radius - self.outlet) * k / RINGS, self.radius * k / RINGS) for k in range(RINGS + 1)]
        levels += [(self.radius, self.radius + (self.top + 10 - self.radius) * k / RINGS) for k in range(1, RINGS + 1)]
        wall = [t for low, high in zip(levels, levels[1:]) for t in strip(ring(*low), ring(*high))]
        self.triangles = len(wall)
        write_stl(folder / "wall.stl", wall, "a bin over a funnel")
        rim = ring(1.1 * self.outlet, -1.0)
        write_stl(folder / "outlet.stl", [((0.0, 0.0, -1.0), b, a) for a, b in zip(rim, rim[1:])], "its outlet, down")

    def processors(self):
        return "processors 1 1 *"

    def script(self, steps):
        """Grains that leave fall for so many steps in the box; what they have at the outlet is less than a fall through the radius gives."""
        time = steps * DT
        r, z, fall = self.radius + 1, self.top + 12, 10 + math.sqrt(2 * self.radius) * time + time**2 / 2
        return SCRIPT.format(box=f"{-r!r} {r!r} {-r!r} {r!r} {-fall!r} {z!r}", inner=self.radius - 0.6, low=self.outlet - 0.6,
                             radius=self.radius, top=self.top, above=self.top + 8, law=LAW, dt=DT)


def ring(radius, z):
    return [(radius * math.cos(2 * math.pi * k / AROUND), radius * math.sin(2 * math.pi * k / AROUND), z) for k in range(AROUND)] + [(radius, 0.0, z)]


def feed(steps):
    return FEED.format(rate=1 / (steps * DT), every=steps)


def variants(against):
    """{case: (words of the wall, other fixes)}; those without /kk last, as LAMMPS then exchanges atoms on the host."""
    wear, stress, files = "wear archard 1e-4 1.0", "mesh_fields fields_*.vtp every 100000000", "mesh_stl wall_*.stl every 100000000"
    rare = 10**6
    found = {"wall": ("", ""), "mass flow": ("", FLOW), "insertion": ("", feed(rare)), "wear": (wear, ""), "stress": (stress, ""),
             "files": (files, ""), "all": (f"{wear} {stress} {files}", f"{FLOW}\n{feed(rare)}"),
             "insertion, each 100 steps": ("", feed(100)),
             "mass flow, delete yes": ("", FLOW + " delete yes")}
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
    ends = "".join(f"unfix {i}\n" for i in re.findall(r"^fix (\w+)", fixes, re.M))
    return f'print "case {name}"\nunfix wall\n{WALL.format(law=LAW)} {words}\n{fixes}\nrun {WARM}\n{runs}{ends}'


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
        deck = Hopper(atoms, work)
        cases = variants(options.against)
        # The wall alone comes before each other case, and at the end.
        order = [name for other in cases for name in ({"wall": ()}.get(other, ("wall", other)))] + ["wall"]
        steps = options.settle + len(order) * (WARM + options.steps * (options.chunks + 3 * bool(options.copies)))
        text = plugin_script(host, deck) + deck.script(steps) + WALL.format(law=LAW) + f"\nrun {options.settle}\n" + \
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
            found.append(host.row("hopper", f"hopper, {name}", deck, options.commit, "sorted", times[k], steps=options.steps,
                                  touching=touching, **more, **copies[k]))
            say(f"{name}: {found[-1]['facts']}")
    return found


if __name__ == "__main__":
    sys.argv[0] = "hopper"
    bench("hopper", __doc__, on_hosts(measure_hopper), WORDS + [
        ("--steps", dict(type=int, default=200, metavar="N", help="timed as one (default %(default)s)")),
        ("--atoms", dict(type=float, nargs="+", metavar="N", help="default: 1e6 on a GPU, 20000 on a CPU")),
        ("--settle", dict(type=int, default=4000, metavar="N", help="steps before (default %(default)s)")),
        ("--against", dict(action="store_true", help="time the forms without /kk, too")),
        ("--copies", dict(metavar="COMMAND", help="appends how many copies there were to the file that it is given"))],
        quick={"atoms": [3000], "settle": 200, "steps": 40})
