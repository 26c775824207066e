# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Impacts of grains whose contacts yield: hysteretic springs, elasto-plastic adhesion, and a sphere that is elastic and perfectly plastic."""

import dataclasses
import math

from impacts import largest_of
from suite import AT_MESHES, ONLY_OURS, Grain, Seen, case, fly

RADIUS, DENSITY, SPEED = 5e-3, 2000.0, 1.0
# Steps in half a period of the stiffest spring of a contact, that of its unloading.
STEPS = 400
WIDTH = math.pi / STEPS
CORNERS = "touch, the turn from loading to unloading, the corners of the law and the end each lie anywhere in a step and shift the energy by at most (pi/n)^2/4 of all; n = 400"
BETWEEN = "the largest lies between two steps, (pi/n)^2/8 of the overlap and of the force, and as much again for the step; n = 400 a half period"
ADHESIVE = "closed form (Thakur et al. 2014)"
SMOOTH = " tangential linear_nohistory 0.0 0.0"


@dataclasses.dataclass
class Yielding:
    """A law, the closed forms of its impact, and the stiffness of its unloading at the largest overlap."""
    law: str
    source: str
    restitution: float
    overlap: float
    force: float
    unloading: float


def hysteretic(e, mass, radius):
    """Loads by k1 and unloads by k1/e^2 (Walton and Braun 1986)."""
    k1 = 1e5
    overlap = SPEED * math.sqrt(mass / k1)
    return Yielding(f"hysteretic {k1!r} {e!r}", "closed form (Walton and Braun 1986)", e, overlap, k1 * overlap, k1 / e ** 2)


def eepa(n, plasticity, mass, radius):
    """No adhesion: the energy that unloading by k2 (d^n - q) returns, of the one that loading by k1 d^n takes."""
    k1 = 1e5 if n == 1 else 1e7
    s = plasticity ** (1 / n)
    returned = (1 - s ** (n + 1) - (n + 1) * s ** n * (1 - s)) / (1 - plasticity)
    overlap = ((n + 1) * mass * SPEED ** 2 / (2 * k1)) ** (1 / (n + 1))
    return Yielding(f"eepa {k1!r} 1.0 {plasticity!r} 0.0 {n!r} {n!r} 0.0", ADHESIVE, math.sqrt(returned), overlap, k1 * overlap ** n,
                    n * k1 / (1 - plasticity) * overlap ** (n - 1))


def adhesive_eepa(gamma, mass, radius, cut):
    """With adhesion, n = chi = 1: unloading meets the adhesive branch at dmin, from which its area, f dmin/2, is lost, too. `cut`: the radius of the circle in
    which the surfaces cut each other, by the overlap."""
    k1, plasticity = 1e5, 0.75
    k2 = k1 / (1 - plasticity)
    overlap = SPEED * math.sqrt(mass / k1)
    rest = plasticity * overlap
    pull = min(1.5 * math.pi * gamma * cut(rest), k2 * rest / 2)
    least = rest - pull / k2
    kinetic = mass * SPEED ** 2 / 2
    left = k2 * (overlap - rest) ** 2 / 2 - k2 * (least - rest) ** 2 / 2 - pull * least / 2
    return Yielding(f"eepa {k1!r} 1.0 {plasticity!r} {gamma!r} 1.0 1.0 0.0", ADHESIVE, math.sqrt(left / kinetic), overlap, k1 * overlap, k2)


def thornton(mass, radius):
    """Hertz up to the pressure py, then linear; it unloads along Hertz with the radius to which it was flattened."""
    young, nu, py = 1e9, 0.3, 1e7
    modulus = young / (2 * (1 - nu ** 2))
    limit = radius * (math.pi * py / (2 * modulus)) ** 2
    share = 16 * modulus * math.sqrt(radius) * limit ** 2.5 / (15 * mass * SPEED ** 2)    # (Vy/V)^2
    root = math.sqrt(share)
    e = math.sqrt(6 * math.sqrt(3) / 5 * (1 - share / 6)) * (root / (root + 2 * math.sqrt((6 - share) / 5))) ** 0.25
    # Energy: Hertz up to the limit, then F = F_y + pi py R (d - d_y).
    f_limit, slope = 4 / 3 * modulus * math.sqrt(radius) * limit ** 1.5, math.pi * py * radius
    left = mass * SPEED ** 2 / 2 * (1 - share)
    beyond = (-f_limit + math.sqrt(f_limit ** 2 + 2 * slope * left)) / slope
    deep = f_limit + slope * beyond
    flat = 4 / 3 * modulus / deep * ((2 * deep + f_limit) / (2 * math.pi * py)) ** 1.5
    return Yielding(f"thornton {young!r} 0.0 {nu!r} {py!r}", "closed form (Thornton 1997)", e, limit + beyond, deep, 2 * modulus * math.sqrt(flat) *
                    (deep / (4 / 3 * modulus * math.sqrt(flat))) ** (1 / 3))


def laws(mass, radius, cut):
    """Names and laws of all impacts, for the mass and radius of a contact; `cut` as of adhesive_eepa()."""
    for e in (0.3, 0.5, 0.9):
        yield f"hysteretic, e {e:g}", hysteretic(e, mass, radius)
    yield "eepa, n 1", eepa(1.0, 0.75, mass, radius)
    yield "eepa, n 1.5", eepa(1.5, 0.75, mass, radius)
    yield "eepa, n 1, adhesive", adhesive_eepa(500.0, mass, radius, cut)
    yield "thornton", thornton(mass, radius)


def rows(name, exact, states, overlap, force, rebound):
    largest, push, _ = largest_of(states, overlap, force)
    yield Seen(f"{name}: largest overlap", "m", largest, exact.overlap, exact.source, WIDTH ** 2 / 4, BETWEEN)
    yield Seen(f"{name}: largest force", "N", push, exact.force, exact.source, WIDTH ** 2 / 4, BETWEEN)
    yield Seen(f"{name}: restitution", "1", rebound, exact.restitution, exact.source, WIDTH ** 2, CORNERS)


def step_of(exact, mass):
    return math.pi * math.sqrt(mass / exact.unloading) / STEPS


def steps_of(exact, dt):
    """So many that the grain is gone: overlap grows at SPEED and falls at no less than its restitution."""
    return int((2 + 1.2 / exact.restitution) * math.pi / 2 * exact.overlap / SPEED / dt) + 20


@case("yielding", "Sphere on a rigid wall whose contact yields", AT_MESHES)
def yielding(setting):
    mass = Grain((0, 0, 0), RADIUS, DENSITY).mass
    for name, exact in laws(mass, RADIUS, lambda d: math.sqrt(d * (2 * RADIUS - d))):
        dt = step_of(exact, mass)
        grain = Grain((0, 0, RADIUS + 3.3 * dt * SPEED), RADIUS, DENSITY, (0, 0, -SPEED))
        states = fly(setting, [grain], (-0.1, 0.1, -0.1, 0.1, -0.01, 0.05), setting.floor(exact.law + SMOOTH, 0.1), dt, steps_of(exact, dt), 1)
        yield from rows(name, exact, states, lambda s: RADIUS - s[0]["z"], lambda s: s[0]["fz"], states[max(states)][0]["vz"] / SPEED)


@case("yielding-pair", "Two like spheres whose contact yields", ONLY_OURS)
def yielding_pair(setting):
    mass = Grain((0, 0, 0), RADIUS, DENSITY).mass / 2
    for name, exact in laws(mass, RADIUS / 2, lambda d: math.sqrt(RADIUS ** 2 - (RADIUS - d / 2) ** 2)):
        dt = step_of(exact, mass)
        half = RADIUS + 3.3 * dt * SPEED / 2
        grains = [Grain((-half, 0, 0), RADIUS, DENSITY, (SPEED / 2, 0, 0)), Grain((half, 0, 0), RADIUS, DENSITY, (-SPEED / 2, 0, 0))]
        states = fly(setting, grains, (-0.05, 0.05, -0.02, 0.02, -0.02, 0.02), "", dt, steps_of(exact, dt), 1, exact.law + SMOOTH)
        yield from rows(name, exact, states, lambda s: 2 * RADIUS - (s[1]["x"] - s[0]["x"]), lambda s: abs(s[0]["fx"]),
                        (states[max(states)][1]["vx"] - states[max(states)][0]["vx"]) / SPEED)
