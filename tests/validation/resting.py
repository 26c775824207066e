# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Grains that are held: two between walls, adhesion, and heat."""

import math

import lmp
from suite import AT_MESHES, BETWEEN_GRAINS, G, HOST, Grain, Seen, case, fly


@case("pressed", "Two grains pressed between two walls (MFiX DEM03)")
def pressed(setting):
    radius, kn, gap = 5e-4, 1e3, 1.8e-3
    grains = [Grain((0, 0, 4.5e-4), radius, 20000.0), Grain((0, 0, 1.35e-3), radius, 10000.0)]
    lower, upper = (g.mass * G for g in grains)
    # Three springs in a row: k (d1 - d2) = m1 g, k (d2 - d3) = m2 g, and together they are as long as 4 R is more than the gap.
    d2 = (4 * radius - gap - (lower - upper) / kn) / 3
    exact = {"floor and lower grain": d2 + lower / kn, "grains": d2, "upper grain and lid": d2 - upper / kn}
    dt = math.pi * math.sqrt(grains[1].mass / 2 / kn) / 50
    law = f"hooke {kn!r} {0.5 * math.sqrt(kn / grains[1].mass)!r} tangential linear_nohistory 0.0 0.0 damping mass_velocity"
    if setting.is_mesh:
        walls = f"fix wall all wall/lsdcd granular {law} mesh {setting.wall}.stl scale 0.01 mesh {setting.wall}.stl scale 0.01 move 0 0 {gap!r}\n"
    else:
        walls = lmp.flat_walls(f"fix wall all wall/gran granular {law} zplane 0 {gap!r}")
    states = fly(setting, grains, (-0.02, 0.02, -0.02, 0.02, -1e-3, 3e-3), walls + setting.gravity(), dt, 8000, pair_law=law)
    a, b = states[max(states)]
    seen = dict(zip(exact, (radius - a["z"], 2 * radius - (b["z"] - a["z"]), radius - (gap - b["z"]))))
    for name, overlap in exact.items():
        yield Seen(f"overlap of {name}", "m", seen[name], overlap, "three springs in a row, closed form; the case is MFiX DEM03", 1e-12,
                   "round-off of places, 1e-19 m, over an overlap, 7e-5 m, for each of thousands of steps; what swings is damped to nothing")


@case("jkr", "Pull-off of a grain with jkr that slides over the floor (Johnson, Kendall and Roberts 1971)")
def jkr(setting):
    radius, young, nu, gamma, pull = 1e-3, 1e7, 0.3, 0.1, 1e-4
    # Plane walls of LAMMPS 29Sep2021 have E/(2 (1 - nu)) for a material (doc/other-walls.md); this is their word for the same modulus.
    word = young if setting.is_mesh or lmp.version() > 20211001 else young / (1 + nu)
    law = f"jkr {word!r} 0.0 {nu!r} {gamma!r} tangential linear_history 10.0 0.0 0.3 damping velocity"
    modulus = young / (2 * (1 - nu ** 2))
    force = 3 * math.pi * gamma * radius
    # F and d in the radius a of the contact (doc/theory.md): F is least at this a.
    a3 = 9 * math.pi * gamma * radius ** 2 / (4 * modulus)
    a = a3 ** (1 / 3)
    at = a * a / radius - 2 * math.sqrt(math.pi * gamma * a / modulus)
    dt = 1e-6
    for speed in (0.0, 0.5):
        states = fly(setting, [Grain((-2e-3, 0, radius - 1e-7), radius, 2500.0)], (-0.02, 0.02, -0.02, 0.02, -5e-3, 5e-3), setting.floor(law, 0.01), dt, 10500, 1,
                     move=f"move linear {speed!r} 0.0 {pull!r} units box")
        where = f"sliding at {speed:g} m/s over the floor" if speed else "pulled straight up"
        worst = min(states, key=lambda s: states[s][0]["fz"])
        last = max(s for s in states if states[s][0]["fz"] != 0)
        # Near it the force is 3 pi gamma R (1 - (x/d)^2) or so.
        near = "flat at its greatest, and a step moves the grain by 1.2e-4 of the reach"
        yield Seen(f"{where}: greatest pull", "N", -states[worst][0]["fz"], force, "3 pi gamma R (Johnson, Kendall and Roberts 1971)", 1e-7, near)
        yield Seen(f"{where}: overlap at the greatest pull", "m", radius - states[worst][0]["z"], at, "closed form of JKR", 2.4e-4, "two steps, of 1.2e-4 of the reach")
        if setting.is_mesh:
            yield Seen(f"{where}: overlap as it lets go", "m", radius - states[last][0]["z"], at, "closed form of JKR", 2.4e-4, "two steps, of 1.2e-4 of the reach")
            if speed:
                yield Seen(f"{where}: friction at the greatest pull", "N", -states[worst][0]["fx"], 0.3 * force, "mu (F + 2 F_pulloff)", 1e-7, near)


@case("held-force", "Force on a grain that is held in the wall")
def held_force(setting):
    radius, young, nu, gamma, energy, depth = 1e-3, 1e7, 0.3, 0.1, 3e4, 1e-5
    modulus = young / (2 * (1 - nu ** 2))
    word = young if setting.is_mesh or lmp.version() > 20211001 else young / (1 + nu)    # as for jkr
    push = 4 / 3 * modulus * math.sqrt(radius) * depth ** 1.5
    tangential = "tangential linear_nohistory 0.0 0.0 damping velocity"
    laws = {"hertz": (f"hertz/material {word!r} 0.0 {nu!r} {tangential}", push, "Hertz 1882"),
            "dmt": (f"dmt {word!r} 0.0 {nu!r} {gamma!r} {tangential}", push - 4 * math.pi * gamma * radius, "Derjaguin, Muller and Toporov 1975")}
    if setting.is_mesh:
        laws["sjkr"] = (f"hertz/material {word!r} 0.0 {nu!r} {tangential} cohesion sjkr {energy!r}", push - energy * math.pi * (2 * radius - depth) * depth,
                        "the pull times the area in which the plane cuts the grain")
    for name, (law, force, of) in laws.items():
        states = fly(setting, [Grain((0, 0, radius - depth), radius, 2500.0)], (-0.02, 0.02, -0.02, 0.02, -5e-3, 5e-3), setting.floor(law, 0.01), 1e-6, 1,
                     move="move linear 0.0 0.0 0.0 units box")
        yield Seen(f"{name}: force at an overlap of R/100", "N", states[1][0]["fz"], force, of, 1e-12, "round-off of the place over the overlap, 1e-19/1e-5, and some more")


@case("bridge", "A liquid bridge that is pulled until it breaks (Willett et al. 2000)", AT_MESHES)
def bridge(setting):
    radius, tension, angle, volume, speed, steps = 1e-3, 0.072, 20.0, 1e-12, 0.01, 4000
    law = f"hooke 1e4 0.0 tangential linear_nohistory 0.0 0.0 damping velocity cohesion capillary {tension!r} {angle!r} NULL {volume!r}"
    # Between two spheres of this radius; a plane has that of twice the grain's.
    derjaguin, theta = 2 * radius, math.radians(angle)
    reach = (1 + theta / 2) * (volume ** (1 / 3) + volume ** (2 / 3) / (10 * derjaguin))

    def pull(gap):
        p = gap / 2 * math.sqrt(derjaguin / volume)
        return 2 * math.pi * derjaguin * tension * math.cos(theta) / (1 + 2.1 * p + 10 * p * p)

    dt, depth = 1.1 * reach / speed / steps, 1e-7
    states = fly(setting, [Grain((0, 0, radius - depth), radius, 2500.0)], (-0.02, 0.02, -0.02, 0.02, -5e-3, 5e-3), setting.floor(law, 0.01), dt, steps, 1,
                 move=f"move linear 0.0 0.0 {speed!r} units box")
    seen = {step: (s[0]["z"] - radius, -s[0]["fz"]) for step, s in states.items()}
    of, places = "Willett et al. 2000, equation 12", "round-off of the place, 1e-19 m, over the gap, and some more"
    for share in (0.1, 0.3, 0.6, 0.9):
        step = round(share * steps / 1.1)
        yield Seen(f"pull at {share:g} of the rupture distance", "N", seen[step][1], pull(step * speed * dt - depth), of, 1e-9, places)
    last = max(gap for gap, force in seen.values() if force > 0)
    yield Seen("gap in which it breaks", "m", last, reach, "Willett et al. 2000, equation 15", 1.2 / steps, "a step of the pull, 1.1/4000 of the reach")
    # The integral of 1/(1 + 2.1 p + 10 p^2).
    root, per_gap = math.sqrt(40 - 2.1 ** 2), math.sqrt(derjaguin / volume) / 2

    def integral(gap):
        return 2 / root * math.atan((20 * per_gap * gap + 2.1) / root)
    first = math.ceil(depth / (speed * dt)) * speed * dt - depth
    exact = pull(0.0) / per_gap * (integral(reach) - integral(first))
    pulled = sorted(v for v in seen.values() if v[1] > 0 and v[0] >= 0)
    work = sum((b[0] - a[0]) * (a[1] + b[1]) / 2 for a, b in zip(pulled, pulled[1:]))
    yield Seen("work of the pull until it breaks", "J", work, exact, "closed form of its integral", 1e-4,
               "the last step before it breaks, 1/3600 of the way, has a pull of less than a third of the mean")


# ---- heat ------------------------------------------------------------------------------------

HEATS = {"radius": ("2 k a dT (Vargas and McCarthy 2001)", lambda k, a: 2 * k * a), "area": ("h pi a^2 dT", lambda h, a: h * math.pi * a * a)}
CAPACITY, CONDUCTIVITY = 800.0, {"radius": 50.0, "area": 1e6}
EULER = 2000    # steps of fix heat/flow in which a difference of temperatures falls to 1/e


def warmed(setting, grains, law, temperatures, wall, dt, rate, pair_law=""):
    """Temperatures of grains at rest after a time 1/rate."""
    fixes = "fix kept all property/atom temperature heatflow ghost yes\n" + "".join(f"set atom {i} temperature {t!r}\n" for i, t in enumerate(temperatures, 1))
    columns = [f"c_t{i}" for i in range(1, len(grains) + 1)]
    fixes += (f"fix heat all heat/flow constant {CAPACITY!r}\ncompute t all property/atom temperature\n" + wall +
              "".join(f"group g{i} id {i}\ncompute t{i} g{i} reduce sum c_t\n" for i in range(1, len(grains) + 1)))
    assert abs(EULER * dt * rate - 1) < 1e-9
    return fly(setting, grains, (-0.02, 0.02, -0.02, 0.02, -0.02, 0.02), fixes, dt, EULER, move="move linear 0 0 0 units box", pair_law=pair_law, columns=columns)[1]


EXPLICIT = "fix heat/flow takes explicit steps: (1 - 1/n)^n is 1/e less 1/2n of it, n = 2000; and 4 % of that"


@case("heat-pair", "Heat between two grains in contact", BETWEEN_GRAINS, HOST)
def heat_pair(setting):
    """Two unlike grains, held at an overlap: their difference falls by a rate that is the conductance over each heat capacity."""
    overlap = 2e-6
    a, b = Grain((0, 0, 0), 1e-3, 2500.0), Grain((0, 0, 2.5e-3 - overlap), 1.5e-3, 4000.0)
    radius = math.sqrt(a.radius * b.radius / (a.radius + b.radius) * overlap)
    for word, (source, conductance) in HEATS.items():
        law = f"hertz/material 1e7 0.0 0.3 tangential linear_nohistory 0.0 0.0 damping velocity heat {word} {CONDUCTIVITY[word]!r}"
        rate = conductance(CONDUCTIVITY[word], radius) / CAPACITY * (1 / a.mass + 1 / b.mass)
        t = warmed(setting, (a, b), law, (400.0, 300.0), "", 1 / rate / EULER, rate, pair_law=law)
        yield Seen(f"heat {word}: difference of temperatures after 1/rate, over that of the beginning", "1", (t[0] - t[1]) / 100.0, math.exp(-1), source, 1.04 / 2 / EULER, EXPLICIT)
        yield Seen(f"heat {word}: heat of both, over that of the beginning", "1", (a.mass * t[0] + b.mass * t[1]) / (a.mass * 400 + b.mass * 300), 1.0,
                   "conservation of energy", 1e-12, "round-off of 2000 steps")


@case("heat-wall", "Heat from a wall into a grain", takes=HOST)
def heat_wall(setting):
    """A grain held at an overlap, at a wall of another temperature."""
    overlap = 2e-6
    grain = Grain((0, 0, 1e-3 - overlap), 1e-3, 2500.0)
    for word, (source, conductance) in HEATS.items():
        law = f"hertz/material 1e7 0.0 0.3 tangential linear_nohistory 0.0 0.0 damping velocity heat {word} {CONDUCTIVITY[word]!r}"
        rate = conductance(CONDUCTIVITY[word], math.sqrt(grain.radius * overlap)) / CAPACITY / grain.mass
        t = warmed(setting, (grain,), law, (300.0,), setting.floor(law, 0.01, keywords="temperature 400.0"), 1 / rate / EULER, rate)
        yield Seen(f"heat {word}: what is left of the difference after 1/rate", "1", (400.0 - t[0]) / 100.0, math.exp(-1), source, 1.04 / 2 / EULER, EXPLICIT)
