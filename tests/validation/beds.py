# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Beds of grains, cases of minutes: Janssen's column, Beverloo's hopper, a flat-bottomed hopper and a mill. A bed forgets its round-off in no time, so that two
cuts of a mesh agree as two fillings do, unless the numbers of its planes are so round that both give the same bits."""

import math
import re
import subprocess
import sys

import lmp
import stl
from suite import AT_MESHES, MINUTES, ROOT, TWO, Point, Seen, case


def cut(triangles, parts=12):
    """Each triangle as so many slivers that meet in its first corner."""
    made = []
    for a, b, c in triangles:
        points = [tuple(u + (w - u) * k / parts for u, w in zip(b, c)) for k in range(parts)] + [tuple(c)]
        made += [(tuple(a), p, q) for p, q in zip(points, points[1:])]
    return made


# ---- Janssen ---------------------------------------------------------------------------------

TUBE_RADIUS, FLATS = 5.0, 60

# In diameters and masses of a grain; gravity is 1.
COLUMN = lmp.head("-5.5 5.5 -5.5 5.5 -2 70") + """\
lattice         sc 0.66
region          fill cylinder z 0 0 4.4 0.6 {top} units box
create_atoms    1 region fill
variable        size atom 0.9+0.2*random(0,1,{seed})
set             group all diameter v_size
set             group all density 1.9098593171
velocity        all create 0.2 {seed} loop geom
pair_style      gran/hooke/history 2e4 NULL 50 NULL 0.5 0
pair_coeff      * *
neighbor        0.2 bin
neigh_modify    delay 0 every 1 check yes
timestep        5e-4
fix             gravity all gravity 1.0 vector 0 0 -1
fix             move all nve/sphere
fix             wall all wall/lsdcd hooke/history 2e4 NULL 50 NULL 0.5 0 mesh tube.stl mesh floor.stl log brief
fix_modify      wall mesh 1 names tube force_z
fix_modify      wall mesh 2 names floor force_z
variable        mass equal mass(all)
variable        up equal vcm(all,z)
# Steps in which means end are multiples of 24000.
run             {settle}
fix             mean all ave/time 1 4000 4000 v_tube_force_z v_floor_force_z
variable        before equal $(v_up)
run             4000
compute         top all reduce max z
print           "rest $(v_mass:%.15g) $(f_mean[1]:%.15g) $(f_mean[2]:%.15g) $((v_up-v_before)/(4000*dt)*v_mass:%.15g)"
unfix           mean
fix_modify      wall mesh 2 motion linear 0 0 -0.02
fix             mean all ave/time 1 20000 24000 v_floor_force_z
thermo_style    custom step ke c_top
run             24000
print           "moving $(f_mean:%.15g) $(c_top:%.15g)"
"""


def column(setting, top, settle, seed=7):
    """The mass of a column; the forces on tube and floor at rest, and what the bed gains in momentum; the force on the floor as it sinks, and the bed's top."""
    ring = [(TUBE_RADIUS * math.cos(2 * math.pi * k / FLATS), TUBE_RADIUS * math.sin(2 * math.pi * k / FLATS)) for k in range(FLATS)]
    tube = [t for p, q in zip(ring, ring[1:] + ring[:1]) for t in stl.quad((*p, -2.0), (*q, -2.0), (*q, 70.0), (*p, 70.0))]
    floor = [((0.0, 0.0, 0.0), (*p, 0.0), (*q, 0.0)) for p, q in zip(ring, ring[1:] + ring[:1])]
    stl.write(setting.folder / "tube.stl", tube if setting.wall == TWO else cut(tube, 45))
    stl.write(setting.folder / "floor.stl", floor if setting.wall == TWO else cut(floor))
    said = lmp.run_well(COLUMN.format(top=top, settle=settle, seed=seed), setting.folder, timeout=3000)
    rest, moving = (list(map(float, re.search(rf"^{word} (.*)", said, re.M)[1].split())) for word in ("rest", "moving"))
    return (*rest, *moving)


@case("janssen", "A column in a tube: weight, and Janssen's floor that sinks", AT_MESHES, MINUTES)
def janssen(setting):
    """With LSDCD_QUICK the low column at rest, a seventh of the time: one load says nothing of Janssen's law."""
    found = {}
    columns = (("low", 13.0, 44000), ("middle", 27.0, 44000), ("high", 46.0, 68000))
    for name, top, settle in columns[:1] if lmp.QUICK else columns:
        mass, tube, floor, gained, load, _ = column(setting, top, settle)
        found[name] = mass, load
        yield Seen(f"{name} column at rest: weight that tube and floor carry, over all", "1", -(tube + floor) / (mass + gained), 1.0, "balance of forces, with the momentum that the bed gains", 2e-6,
                   "the mean begins and ends half a step off, with a load that differs by 1 % or so: 0.01/(2 4000)")
    if lmp.QUICK:
        return
    # One number for three loads, by least squares over a range that ends far beyond both ways.
    def misfit(saturated):
        return sum((-load / (saturated * (1 - math.exp(-mass / saturated))) - 1) ** 2 for mass, load in found.values())
    saturated = min((200 + 2 * k for k in range(900)), key=misfit)
    for mass, load in found.values():
        yield Point("Janssen, load over M8", mass / saturated, -load / saturated)
    for name, (mass, load) in found.items():
        yield Seen(f"{name} column, floor sinking: its load over Janssen's", "1", -load / (saturated * (1 - math.exp(-mass / saturated))), 1.0,
                   "Janssen's law, M8 (1 - exp(-M/M8)), with one M8 for the three columns", 0.1, "the scatter of fillings, some 5 % each")


# ---- Beverloo --------------------------------------------------------------------------------

@case("beverloo", "Flow out of a bin through four outlets (Beverloo 1961)", AT_MESHES, MINUTES)
def beverloo(setting):
    place = ROOT / "examples" / "hopper"
    flows = {}
    for outlet in (4, 5, 6, 7):    # the bin is 16 wide: out of 8, half of that, 8 % more runs than by the line of these
        subprocess.run([sys.executable, place / "make_hopper.py", "--outlet", str(outlet), "--out", setting.folder], check=True, stdout=subprocess.DEVNULL)
        if setting.wall != TWO:
            for name in ("hopper.stl", "gate.stl"):
                stl.write(setting.folder / name, cut(stl.read(setting.folder / name)))
        said = lmp.run_well((place / "in.hopper").read_text(), setting.folder, timeout=3000, outlet=outlet, dir=setting.folder, png=0, measure=10000)
        words = re.search(r"^hopper outlet .*", said, re.M)[0].split()
        row = {a: float(b) for a, b in zip(words[1::2], words[2::2])}
        flows[outlet] = row["flow"] / row["bulk_density"]
        yield Point("Beverloo, (flow/density)^(2/5)", outlet, flows[outlet] ** 0.4)
        yield Seen(f"outlet {outlet}: weight that bin and gate carry, over all", "1", row["borne"], 1.0, "balance of forces", 1e-4, "what the bed still gains in speed, in round-off of the mean")
        yield Seen(f"outlet {outlet}: mass in the bin and counted out, over all", "1", row["kept"], 1.0, "no grain is lost", 1e-9, "digits of the script")
    slope, zero, left = line(list(flows), [f ** 0.4 for f in flows.values()])
    of = "Beverloo's law, C rho sqrt(g) (D - k d)^(5/2)"
    yield Seen("flow^(2/5) over the outlet: what a line leaves, 1 - r^2", "1", left, 0.0, of, 1.4e-2,
               "70 to 400 grains are counted, 1/sqrt(N) of which is 5 to 12 %: 0.4 of that, 3 % in the mean, over roots that spread by 25 % of their mean", True)
    yield Seen("k of the line", "1", zero, 1.4, of, 0.4, "the scatter of a flow at one end, 12 %, is 5 % of the root and moves the line's zero by 0.3; k depends on the grains", True)
    exponent, _, _ = line([math.log(outlet - 1.4) for outlet in flows], [math.log(f) for f in flows.values()])
    yield Seen("exponent with k = 1.4", "1", exponent, 2.5, of, 0.2, "the scatter of a flow at one end, 12 %, over ln(5.6/2.6) = 0.77", True)


# ---- a flat-bottomed hopper --------------------------------------------------------------------

# A slice of 2.5 grains, periodic in y, of a bin of 56 grains whose floor has a slot of 11.2 (Anand et al. 2008, as lethe has it).
GRAIN, GRAINS = 2.24e-3, 6790
DEPTH, HALF_BIN, HALF_SLOT = 2.5 * GRAIN, 28 * GRAIN, 5.6 * GRAIN

SLICE = lmp.head(f"-0.065 0.065 0 {DEPTH} -0.12 0.24", "f p f", units="si") + """\
lattice         custom 2.45e-3 a1 1 0 0 a2 0 1.142 0 a3 0 0 1 basis 0.5 0.5 0.5
region          fill block -0.0624 0.0624 INF INF 0.0005 INF units box
create_atoms    1 region fill
group           over id > {grains}
delete_atoms    group over compress no
set             group all diameter {grain} density 2500
displace_atoms  all random 5e-5 5e-5 0 4711 units box
variable        law string "tangential mindlin NULL 1.0 0.2 rolling cdt 0.09 damping coeff_restitution"
pair_style      granular/lsdcd
pair_coeff      * * hertz/material 1e6 0.94 0.3 ${{law}}
neighbor        4e-4 bin
neigh_modify    delay 0 every 1 check yes
timestep        2e-5
fix             gravity all gravity/lsdcd 9.81 vector 0 0 -1
fix             move all nve/sphere
fix             wall all wall/lsdcd granular hertz/material 1e6 0.90 0.3 ${{law}} mesh bin.stl mesh gate.stl log brief
fix_modify      wall names wall force_z
fix             out all massflow/lsdcd mesh out.stl move 0 0 -3e-3 log brief
fix_modify      out names out forward_mass
fix             gone all massflow/lsdcd mesh out.stl scale 2 move 0 0 -0.06 delete yes log brief
fix_modify      gone names gone deleted_mass
variable        before equal $(mass(all))
variable        kept equal (mass(all)+v_gone_deleted_mass)/v_before
thermo_style    custom step v_out_forward_mass v_kept
thermo_modify   norm no format float %.15g
variable        borne equal -v_wall_force_z/(9.81*mass(all))
run             24000
fix             mean all ave/time 1 1000 1000 v_borne
variable        start equal $(vcm(all,z))
run             1000
print           "rest $(f_mean-(vcm(all,z)-v_start)/(1000*dt*9.81):%.15g)"
unfix           mean
reset_timestep  0
thermo          50
# The gate falls faster than grains do until they are out of its way.
fix_modify      wall mesh 2 motion linear 0 0 -1.5
run             32500
"""


@case("flat-hopper", "Flow out of a flat-bottomed hopper (Anand et al. 2008)", AT_MESHES, MINUTES, same_bits=True)
def flat_hopper(setting):
    def strip(p, q):    # between two points (x, z), over the depth of the slice
        return stl.quad((p[0], 0, p[1]), (q[0], 0, q[1]), (q[0], DEPTH, q[1]), (p[0], DEPTH, p[1]))
    corners = ((-HALF_BIN, 0.24), (-HALF_BIN, 0), (-HALF_SLOT, 0)), ((HALF_SLOT, 0), (HALF_BIN, 0), (HALF_BIN, 0.24))
    meshes = {"bin": [t for line in corners for p, q in zip(line, line[1:]) for t in strip(p, q)], "gate": strip(*(line[k] for line, k in zip(corners, (2, 0))))}
    for name, triangles in meshes.items():
        stl.write(setting.folder / f"{name}.stl", triangles if setting.wall == TWO else cut(triangles, 60))
    stl.write(setting.folder / "out.stl", strip((2 * HALF_SLOT, 0), (-2 * HALF_SLOT, 0)))    # wound downwards
    said = lmp.run_well(SLICE.format(grains=GRAINS, grain=GRAIN), setting.folder, timeout=3000)
    rest = float(re.search(r"^rest (.*)", said, re.M)[1])
    passed = {step * 2e-5: (mass, kept) for step, mass, kept in lmp.read_thermo(said)}
    for time in list(passed)[::10]:
        yield Point("flat-bottomed hopper, mass that has left", time, passed[time][0])
    first, last = (min(passed, key=lambda time, at=at: abs(time - at)) for at in (0.142, 0.6))
    yield Seen("at rest: weight that bin and gate carry, over all", "1", rest, 1.0, "balance of forces, with the momentum that the bed gains", 1e-4,
               "the mean begins and ends half a step off, with a load that differs by 10 % or so: 0.1/(2 1000)")
    yield Seen("mass in the bin and taken out, over all", "1", passed[last][1], 1.0, "no grain is lost", 1e-9, "digits of the script")
    yield Seen("flow, 0.142 to 0.6 s after the gate opens", "kg/s", (passed[last][0] - passed[first][0]) / (last - first), 0.09173,
               "lethe's example of this hopper, periodic, with the same laws", 0.03, "another filling: 2800 grains are counted, 1/sqrt(N) of which is 1.9 %; and the reading of a mean")


# ---- a mill ----------------------------------------------------------------------------------

# Behind the first output of examples/mill: means of the turns that follow, and the charge's angular momentum about the axis at both ends.
LIFTED = """\
compute         turns all property/atom omegay
variable        spin atom 0.1*mass*v_d^2*c_turns
compute         spin all reduce sum v_spin
# LAMMPS's angmom() is about the centre of mass.
variable        angular equal angmom(all,y)+mass(all)*(xcm(all,z)*vcm(all,x)-xcm(all,x)*vcm(all,z))+c_spin
variable        lever equal 9.81*mass(all)*xcm(all,x)
fix             means all ave/time 1 {count} {count} v_wall_torque_y v_lever
thermo_style    custom step v_angular v_work v_balance
run             0
variable        before equal $(v_angular:%.17g)
run             {count}
print           "lifted $(f_means[1]:%.15g) $(f_means[2]:%.15g) $((v_angular-v_before)/({count}*dt):%.15g) $(v_work:%.15g) $({count}*dt:%.15g)"
print           "closed $(v_balance:%.15g) $(v_begin:%.15g)"
"""


@case("mill", "A ball mill: torque, work and losses of a turn", AT_MESHES, MINUTES)
def mill(setting):
    place, count, period = ROOT / "examples" / "mill", 36000, 1.2
    mesh = stl.read(place / "mill.stl")
    stl.write(setting.folder / "mill.stl", mesh if setting.wall == TWO else cut(mesh, 3))
    script = (place / "in.mill").read_text()
    until = script.index("run             $(v_last-step)")
    said = lmp.run_well(script[:until] + LIFTED.format(count=count), setting.folder, timeout=3000, dir=setting.folder, steps=50)
    torque, lever, gained, work, time = map(float, re.search(r"^lifted (.*)", said, re.M)[1].split())
    balance, begin = map(float, re.search(r"^closed (.*)", said, re.M)[1].split())
    ends = "the mean begins and ends half a step off, with a torque of up to three times the mean: 3/36000"
    yield Seen("torque of the mill, over that of the lifted charge and what it gains in angular momentum", "1", -torque / (gained - lever), 1.0,
               "balance of angular momentum: M g x of its centre", 1e-4, ends)
    yield Seen("work of the drive, over torque times angle", "1", work / (-torque * 2 * math.pi * time / period), 1.0, "mechanics", 1e-4, ends)
    yield Seen("change of the energy balance, over the work of the drive", "1", (balance - begin) / work, 0.0, "conservation of energy", 9e-4,
               "what examples/mill asks for: 1e-4 with 150 steps in a contact, and 9 times that with 50", True)


def line(x, y):
    """Slope and zero of the line of least squares, and what it leaves of the squares, 1 - r^2."""
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    sxy = sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y))
    sxx, syy = (sum((a - mean) ** 2 for a in u) for u, mean in ((x, mean_x), (y, mean_y)))
    return sxy / sxx, mean_x - mean_y * sxx / sxy, 1 - sxy ** 2 / (sxx * syy)
