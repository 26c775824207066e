# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The recipe 'Adding a normal law' of doc/design.md, followed in a copy of the sources (stiffening.py), beside closed forms: at a
wall and between grains, in the LAMMPS that is installed and with /kk.

An overlap d of spheres with the reduced radius R has the force k d (1 + d/R) and holds k d^2/2 (1 + 2 d/(3 R)).
"""

import math
import os
import pathlib
import re
import subprocess

import pytest

import copied_sources
import lmp
import stiffening
import stl
from facts import at_most, fact

K, DENSITY = 1000.0, 2.0
LAW = f"stiffening {K} 0 tangential linear_nohistory 0 0 damping velocity"
KOKKOS = ("-k", "on", "-sf", "kk")
PLUGIN = "lsdcdkkplugin-20260704"
UNIT_TESTS = ("test_smallest_model", "test_sub_models", "test_effects")

# Radius and overlap of spheres on a floor; radii, and overlap, of two grains.
SPHERES = ((0.5, 0.01), (0.5, 0.1), (0.3, 0.06), (0.4, 0.2))
GRAINS = ((0.5, 0.5, 0.02), (0.5, 0.3, 0.05), (0.6, 0.2, 0.06))

FORMS = {"plain": {}, "kk": {"host": True, "flags": KOKKOS}}


def prepare(folder):
    options, targets = [], ["contact_tests", "lmp-lsdcd"]
    if os.environ.get("LSDCD_HOST"):
        options = ["-D", f"LSDCD_KOKKOS_HOSTS={os.environ['LSDCD_HOST']}"]
        targets.append(PLUGIN)
    build = copied_sources.built("normal_law", stiffening.follow, targets, options)
    lmp.LMP, lmp.PLUGIN = str(build / "bin" / "lmp-lsdcd"), str(build / "lib" / f"{PLUGIN}.so")
    stl.write(folder / "floor.stl", stl.square(4))


@pytest.fixture(params=FORMS)
def form(request):
    if request.param == "kk" and not lmp.HOST:
        pytest.skip("no LAMMPS 4Jul2026 with Kokkos (tests/lammps/hosts/build_host.sh)")
    return FORMS[request.param]


# ---- unit tests that go through the table of sub-models -----------------------------------------

@pytest.mark.parametrize("name", UNIT_TESTS)
def test_units(folder, name):
    """Stiffnesses beside differences of the force; the rows of the page, a case of the effects; what the log says of it."""
    command = [pathlib.Path(lmp.LMP).parent / "contact_tests", name, "--gtest_brief=1"]
    done = subprocess.run(command, cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    fact(name, done.returncode == 0, done.stdout[-2000:])


# ---- closed forms --------------------------------------------------------------------------

def force(d, radius):
    return K * d * (1 + d / radius)


def energy(d, radius):
    return K * d**2 / 2 * (1 + 2 * d / (3 * radius))


def mass(radius):
    return 4 / 3 * math.pi * radius**3 * DENSITY


def reduced(a, b):
    return a * b / (a + b)


def impact(d, m, radius):
    """The speed at which the largest overlap is d, and how long the contact lasts: twice the integral of dx / v(x), with
    v^2 = k/m (d^2 - x^2 + 2/(3 R) (d^3 - x^3)) and x = d sin u, by Simpson's rule."""
    c, n = 2 * d / (3 * radius), 200
    s = [math.sin(math.pi / 2 * i / n) for i in range(n + 1)]
    values = [math.sqrt((1 + x) / (1 + x + c * (1 + x + x * x))) for x in s]
    total = values[0] + values[-1] + 4 * sum(values[1:-1:2]) + 2 * sum(values[2:-1:2])
    return math.sqrt(2 * energy(d, radius) / m), 2 * math.sqrt(m / K) * total * math.pi / 2 / n / 3


def spheres(at, speeds=None):
    """Lines of spheres of type 1, each (radius, place)."""
    text = ""
    for i, (radius, place) in enumerate(at, 1):
        text += f"create_atoms 1 single {' '.join(map(repr, place))} units box\nset atom {i} diameter {2 * radius!r} density {DENSITY}\n"
    for i, speed in enumerate(speeds or (), 1):
        text += f"group one id {i}\nvelocity one set {' '.join(map(repr, speed))} units box\ngroup one delete\n"
    return text


TOLD = """\
thermo_style    custom step {columns}
thermo_modify   format float %.17g norm no
thermo          1000000
dump            out all custom 1000000 out id x y z vx vy vz fx fy fz
dump_modify     out format float %.17g sort id
{run}
write_dump      all custom end id x y z vx vy vz fx fy fz modify format float %.17g sort id
"""


def run(folder, form, atoms, more, columns, steps, dt, pairs):
    text = lmp.head("-4 4 -4 4 -4 4") + atoms + pairs + more + f"timestep {dt!r}\n"
    if form:
        text = re.sub(r"((wall|granular)/lsdcd)", r"\1/kk", text)
    said = lmp.run_well(text + TOLD.format(columns=columns, run=f"run {steps}"), folder, **form)
    return lmp.read_thermo(said)[-1][1:], next(iter(lmp.read_dump(folder / "end").values())), said


def on_floor(heights):
    return [(radius, (-2.7 + 1.8 * i, 0.3, z)) for i, ((radius, _), z) in enumerate(zip(SPHERES, heights))]


def wall(more=""):
    return f"fix wall all wall/lsdcd granular {LAW} mesh floor.stl{more}\n"


ALONE = lmp.pairs()


@pytest.mark.parametrize("books", ["", " energy"])
def test_force_and_energy_at_a_wall(folder, form, books):
    """Of spheres that are held in the floor; with the energy balance, too, which has compiled laws of its own."""
    atoms = spheres(on_floor([radius - d for radius, d in SPHERES]))
    told, end, _ = run(folder, form, atoms, wall(books), "f_wall" + " f_wall[71]" * bool(books), 0, 1e-4, ALONE)
    for i, (radius, d) in enumerate(SPHERES, 1):
        wanted = force(d, radius)
        at_most(f"force at {d} of {radius}", math.dist(end[i][6:9], (0, 0, wanted)) / wanted, 1e-12)
    wanted = sum(energy(d, radius) for radius, d in SPHERES)
    for value in told:
        at_most("elastic energy", abs(value / wanted - 1), 1e-12)


def test_force_and_energy_between_grains(folder, form):
    """Of pairs, which have the reduced radius."""
    at, along = [], (1 / 3, 2 / 3, 2 / 3)
    for k, (a, b, d) in enumerate(GRAINS):
        place = (-2.5 + 2.3 * k, 0.1, -0.2)
        at += [(a, place), (b, tuple(x + (a + b - d) * n for x, n in zip(place, along)))]
    told, end, _ = run(folder, form, spheres(at), "", "pe", 0, 1e-4, lmp.pairs("granular/lsdcd", coeff=LAW))
    for k, (a, b, d) in enumerate(GRAINS):
        wanted = force(d, reduced(a, b))
        for i, sign in ((2 * k + 1, -1), (2 * k + 2, 1)):
            at_most(f"force of {a} and {b}", math.dist(end[i][6:9], [sign * wanted * n for n in along]) / wanted, 1e-12)
    wanted = sum(energy(d, reduced(a, b)) for a, b, d in GRAINS)
    at_most("energy", abs(told[0] / wanted - 1), 1e-12)


# Verlet with n steps in a contact is wrong by some (pi/n)^2 of its time, and touch falls anywhere within a step: 2.5e-6 for 2000.
STEPS, TOLERANCE = 2000, 1e-5


def test_bounce_at_a_wall(folder, form):
    """A sphere comes at the speed v, turns back at an overlap d, and leaves with v after the time of the closed form."""
    contacts = [impact(d, mass(radius), radius) for radius, d in SPHERES]
    dt = min(time for _, time in contacts) / STEPS
    gap = 10.5 * dt
    atoms = spheres(on_floor([radius + gap * v for (radius, _), (v, _) in zip(SPHERES, contacts)]), [(0, 0, -v) for v, _ in contacts])
    steps = math.ceil((max(time for _, time in contacts) + 3 * gap) / dt)
    _, end, _ = run(folder, form, atoms, wall() + "fix move all nve/sphere\n", "ke", steps, dt, ALONE)
    for i, ((radius, d), (v, time)) in enumerate(zip(SPHERES, contacts), 1):
        z, vz = end[i][2], end[i][5]
        at_most(f"speed after a bounce with {d} of {radius}", abs(vz / v - 1), TOLERANCE)
        at_most("time of the contact", abs((steps * dt - gap - (z - radius) / vz) / time - 1), TOLERANCE)


def test_bounce_between_grains(folder, form):
    """The same of two grains, of which the first rests."""
    contacts = [impact(d, reduced(mass(a), mass(b)), reduced(a, b)) for a, b, d in GRAINS]
    dt = min(time for _, time in contacts) / STEPS
    gap = 10.5 * dt
    at, speeds = [], []
    for k, ((a, b, _), (v, _)) in enumerate(zip(GRAINS, contacts)):
        at += [(a, (-2.5 + 2.3 * k, 0.1, -0.2)), (b, (-2.5 + 2.3 * k, 0.1, -0.2 + a + b + gap * v))]
        speeds += [(0, 0, 0), (0, 0, -v)]
    steps = math.ceil((max(time for _, time in contacts) + 3 * gap) / dt)
    pairs = lmp.pairs("granular/lsdcd", coeff=LAW)
    _, end, _ = run(folder, form, spheres(at, speeds), "fix move all nve/sphere\n", "ke", steps, dt, pairs)
    for k, ((a, b, _), (v, time)) in enumerate(zip(GRAINS, contacts)):
        one, two = end[2 * k + 1], end[2 * k + 2]
        v_end = two[5] - one[5]
        at_most(f"speed after a bounce of {a} and {b}", abs(v_end / v - 1), TOLERANCE)
        at_most("time of the contact", abs((steps * dt - gap - (two[2] - one[2] - a - b) / v_end) / time - 1), TOLERANCE)


def test_contact_time(folder, form):
    """A step that is too long is warned of with the time of half a period at an overlap of 1 % of the radius, where the slope is
    k (1 + 2/100)."""
    atoms = spheres(on_floor([radius - d for radius, d in SPHERES]))
    _, _, said = run(folder, form, atoms, wall() + "fix move all nve/sphere\n", "ke", 1, 0.1, ALONE)
    told = re.search(r"the shortest contact time (\S+) \(at an overlap of 1 % of the radius\)", " ".join(said.split()))
    shortest = min(math.pi * math.sqrt(mass(radius) / (K * 1.02)) for radius, _ in SPHERES)
    fact("it is warned of", told is not None, said[-500:])
    at_most("contact time", abs(float(told.group(1)) / shortest - 1), 1e-5)


def test_a_restitution_is_refused(folder):
    """No damping that is known returns one."""
    for damping in ("tsuji", "coeff_restitution"):
        law = f"stiffening {K} 0.5 tangential linear_nohistory 0 0 damping {damping}"
        text = lmp.head("-4 4 -4 4 -4 4") + ALONE + f"fix wall all wall/lsdcd granular {law} mesh floor.stl\n"
        lmp.refused(damping, text, folder, "no damping returns with the sub-model 'stiffening'")
