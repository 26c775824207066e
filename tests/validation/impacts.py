# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Impacts of grains: the tests of Chung and Ooi (2011), and bouncing to rest (MFiX DEM02)."""

import bisect
import math

from suite import BETWEEN_GRAINS, TWO, G, Grain, Hertz, Seen, Setting, case, cut_limit, fly, hertz_law, impulse, published, returned_by, tsuji, write_floors

CHUNG = "Chung and Ooi 2011"
HERTZ = "closed form (Hertz)"

# Young's modulus, Poisson's ratio, density, radius and speed (of approach) of tests 1 to 4: Pa, kg/m3, m, m/s.
GLASS = (4.8e10, 0.20, 2800.0, 0.010, 20.0)
LIMESTONE = (2.0e10, 0.25, 2500.0, 0.010, 20.0)
ALUMINIUM = (7.0e10, 0.30, 2699.0, 0.10, 0.2)
MAGNESIUM = (4.0e10, 0.35, 1800.0, 0.10, 0.2)
OXIDE = (3.8e11, 0.23, 4000.0, 0.0025, 3.9)
IRON = (1.0e11, 0.25, 7000.0, 0.0025, 3.9)

# Steps in a contact. A step misses the greatest overlap by at most dt/2: (F/m) dt^2/8, which is (5/32) 2.943^2/n^2 = 1.35/n^2 of it, and the force by 1.5
# times that; the steps of velocity Verlet shift both by as much at most.
STEPS = 400
MISSES = "the largest lies between two steps, 1.35/n^2 of the overlap and 2.0/n^2 of the force, and as much again for the step; n = 400 a contact"
OVERLAP_LIMIT, FORCE_LIMIT = 2.7 / STEPS ** 2, 4.0 / STEPS ** 2


def largest_of(states, overlap, force):
    """The largest overlap and force of all steps, and how long there was overlap, by the crossings of 0 between two steps."""
    steps = sorted(states)
    d = [overlap(states[s]) for s in steps]
    crossings = [k + d[k] / (d[k] - d[k + 1]) for k in range(len(d) - 1) if (d[k] > 0) != (d[k + 1] > 0)]
    return max(d), max(force(states[s]) for s in steps), crossings[1] - crossings[0]


def elastic(name, of, exact, found, rebound, v, dt):
    """The rows of an elastic impact."""
    overlap, force, time = found
    yield Seen(f"{name}: largest overlap", "m", overlap, exact.overlap, of, OVERLAP_LIMIT, MISSES)
    yield Seen(f"{name}: largest force", "N", force, exact.force, of, FORCE_LIMIT, MISSES)
    yield Seen(f"{name}: time of contact", "s", time * dt, exact.time, of, 1e-5, "velocity Verlet shortens a period by (2 pi/n)^2/24 = 1.0e-5; n = 400 a half period")
    yield Seen(f"{name}: speed after", "m/s", rebound, v, "closed form", cut_limit(1, STEPS), "energy of the step at touch, (2.943/n)^(5/2) of all, n = 400")


@case("hertz-pair", "Two like spheres, elastic (test 1)", BETWEEN_GRAINS)
def hertz_pair(setting):
    for name, (young, nu, density, radius, v) in (("glass", GLASS), ("limestone", LIMESTONE)):
        mass = Grain((0, 0, 0), radius, density).mass
        exact = Hertz(young / (2 * (1 - nu ** 2)), radius / 2, mass / 2, v)
        dt = exact.time / STEPS
        half = radius + 3.3 * dt * v / 2
        law = hertz_law(setting, young, nu, pair=True)
        states = fly(setting, [Grain((-half, 0, 0), radius, density, (v / 2, 0, 0)), Grain((half, 0, 0), radius, density, (-v / 2, 0, 0))],
                     (-3 * radius, 3 * radius, -radius, radius, -radius, radius), "", dt, STEPS + 12, 1, law)
        found = largest_of(states, lambda s: 2 * radius - (s[1]["x"] - s[0]["x"]), lambda s: abs(s[0]["fx"]))
        yield from elastic(name, f"{HERTZ}; {CHUNG}, test 1", exact, found, abs(states[max(states)][0]["vx"]), v / 2, dt)


@case("hertz-wall", "Sphere on a rigid wall, elastic (test 2)")
def hertz_wall(setting):
    for name, (young, nu, density, radius, v) in (("aluminium", ALUMINIUM), ("magnesium", MAGNESIUM)):
        grain = Grain((0, 0, radius), radius, density, (0, 0, -v))
        exact = Hertz(young / (1 - nu ** 2), radius, grain.mass, v)
        dt = exact.time / STEPS
        grain.x = (0, 0, radius + 3.3 * dt * v)
        states = fly(setting, [grain], (-2, 2, -2, 2, -0.1, 0.4), setting.floor(hertz_law(setting, young, nu), 1.0), dt, STEPS + 12, 1)
        found = largest_of(states, lambda s: radius - s[0]["z"], lambda s: s[0]["fz"])
        yield from elastic(name, f"{HERTZ}; {CHUNG}, test 2", exact, found, states[max(states)][0]["vz"], v, dt)


def bounce(setting, material, law, steps=STEPS):
    """The restitution of an impact along the normal."""
    young, nu, density, radius, v = material
    grain = Grain((0, 0, radius), radius, density, (0, 0, -v))
    dt = Hertz(young / (1 - nu ** 2), radius, grain.mass, v).time / steps
    grain.x = (0, 0, radius + 3.3 * dt * v)
    states = fly(setting, [grain], (-0.1, 0.1, -0.1, 0.1, -0.01, 0.02), setting.floor(law, 20 * radius), dt, 3 * steps)
    return states[max(states)][0]["vz"] / v


CUT = "touch and end fall anywhere in a step, where the dashpot acts: e a 1.12 (1 + e^(1/4)) (2.943/n)^(5/4), a that of the dashpot a sqrt(m F/d), n = 400"


@case("restitution", "Restitution from 0.2 to 1 (test 3)")
def restitution(setting):
    for name, material in (("aluminium oxide", OXIDE), ("cast iron", IRON)):
        young, nu = material[:2]
        for e in (0.2, 0.4, 0.6, 0.8, 1.0):
            yield Seen(f"{name}: restitution of {e:g}", "1", bounce(setting, material, hertz_law(setting, young, nu, e)), e, f"{CHUNG}, test 3", cut_limit(e, STEPS), CUT, True)
            if setting.is_mesh and e < 1:
                # The paper's mass is that of one of two like spheres, twice that of their contact.
                exact = returned_by(math.sqrt(2) * tsuji(e))
                yield Seen(f"{name}: restitution of {e:g} by tsuji", "1", bounce(setting, material, hertz_law(setting, young, nu, e).replace("coeff_restitution", "tsuji")), exact,
                           "what its polynomial returns, closed form", cut_limit(e, STEPS), CUT, True)


# ---- oblique -------------------------------------------------------------------------------

ANGLES = (2, 5, 10, 15, 20, 25, 30, 40, 50, 60, 70, 80, 85)
SLIDING = 30    # sliding in the whole contact begins at 28.3 degrees (Maw, Barber and Fawcett 1976), for e = 1
E_OBLIQUE, FRICTION = 0.98, 0.092
ALONG, SPIN, REBOUND = "oblique, tangential restitution", "oblique, spin", "oblique, rebound"
OF_NORMAL = "oblique at a constant normal speed, R spin/(mu v_n)"


def interpolated(points, x):
    """A curve of sorted points, linear between them."""
    k = min(max(bisect.bisect_left([p[0] for p in points], x), 1), len(points) - 1)
    (a, u), (b, w) = points[k - 1], points[k]
    return u + (w - u) * (x - a) / (b - a)


def oblique_impacts(setting, e):
    """Impacts of test 4, {angle: (tangential restitution of the centre, spin, angle of the contact point's rebound)}."""
    young, nu, density, radius, speed = OXIDE
    grains, span = [], 0.0
    time = Hertz(young / (1 - nu ** 2), radius, Grain((0, 0, 0), radius, density).mass, speed).time
    dt = time / STEPS
    for k, angle in enumerate(ANGLES):
        a = math.radians(angle)
        v, u = speed * math.cos(a), speed * math.sin(a)
        grains.append(Grain((5 * radius * (k - 6), 0, radius + 3.3 * dt * v), radius, density, (u, 0, -v)))
    states = fly(setting, grains, (-0.2, 0.2, -0.2, 0.2, -0.01, 0.02), setting.floor(hertz_law(setting, young, nu, e, FRICTION), 0.1), dt, 3 * STEPS)
    found = {}
    for angle, grain, s in zip(ANGLES, grains, states[max(states)]):
        slip = s["vx"] - radius * s["omegay"]
        found[angle] = s["vx"] / grain.v[0], s["omegay"], math.degrees(math.atan2(slip, s["vz"]))
    return found


SLIDES = "the limit takes |F|, so that the pull as the contact ends counts as a push, 1e-4 of all; the restitution, 7e-5"


@case("oblique", "Oblique impact at 3.9 m/s (test 4)")
def oblique(setting):
    found = oblique_impacts(setting, E_OBLIQUE)
    radius, speed = OXIDE[3:]
    of = f"closed form of sliding; {CHUNG}, test 4"
    push = FRICTION * (1 + E_OBLIQUE)
    for angle in (a for a in ANGLES if a > SLIDING):
        t = math.tan(math.radians(angle))
        along, spin, rebound = found[angle]
        yield Seen(f"{angle} degrees: tangential restitution", "1", along, 1 - push / t, of, 2e-4, SLIDES, True)
        yield Seen(f"{angle} degrees: spin", "rad/s", spin, 2.5 * push * speed * math.cos(math.radians(angle)) / radius, of, 2e-4, SLIDES)
        yield Seen(f"{angle} degrees: angle of the contact point", "degrees", rebound, math.degrees(math.atan((t - 3.5 * push) / E_OBLIQUE)), of, 0.01, SLIDES, True)
    of = f"curve of {CHUNG}, test 4, as Kratos has it"
    why = "the reading of the curve, a degree of its abscissa where it is steep: {}"
    below = [a for a in ANGLES if 5 < a <= SLIDING]
    for k, (name, unit, curve, limit, words) in enumerate((
            ("tangential restitution", "1", ALONG, 0.02, "0.03 a degree at 10 degrees"),
            ("spin", "rad/s", SPIN, 12.0, "33 rad/s a degree at 10 degrees"),
            ("angle of the contact point", "degrees", REBOUND, 1.5, "1 degree a degree at 10 degrees"))):
        apart = max((found[a][k] - interpolated(published(curve, "Chung"), a) for a in below), key=abs)
        yield Seen(f"10 to 30 degrees: {name}, furthest from the curve", unit, apart, 0.0, of, limit, why.format(words), True)
    apart = max((found[a][0] - interpolated(published(ALONG, "experiment"), a) for a in ANGLES if 20 <= a <= 60), key=abs)
    yield Seen("20 to 60 degrees: tangential restitution, furthest from the experiment", "1", apart, 0.0, "Kharaz, Gorham and Salman 2001, as lethe has it", 0.03,
               "a comparison: at 20 degrees the curves of MFiX and of Chung and Ooi lie 0.02 above the experiment, ours another 0.006", True)


def oblique_of_normal(setting, ratios):
    """Impacts of test 5, by v_t/(mu v_n): R spin/(mu v_n), and the speed of the contact point over mu v_n. Both depend on Poisson's ratio alone, so that this
    may be any steel."""
    young, nu, density, radius, v, friction = 2.1e11, 0.3, 7800.0, 1e-5, 5.0, 0.3
    dt = Hertz(young / (1 - nu ** 2), radius, Grain((0, 0, 0), radius, density).mass, v).time / STEPS
    grains = [Grain((3 * radius * (k - len(ratios) // 2), 0, radius + 3.3 * dt * v), radius, density, (x * friction * v, 0, -v)) for k, x in enumerate(ratios)]
    states = fly(setting, grains, (-1e-3, 1e-3, -1e-3, 1e-3, -1e-4, 1e-4), setting.floor(hertz_law(setting, young, nu, 1.0, friction), 6e-4), dt, STEPS + 20)
    last = dict(zip(ratios, states[max(states)]))
    # Spin about y is positive where friction brakes x; the paper draws it as negative.
    spin = {x: -radius * s["omegay"] / (friction * v) for x, s in last.items()}
    return spin, {x: s["vx"] / (friction * v) + spin[x] for x, s in last.items()}


@case("oblique-normal", "Oblique impact at a constant normal speed (test 5)")
def oblique_normal(setting):
    ratios = (2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0, 12.0, 20.0)
    spin, point = oblique_of_normal(setting, ratios)
    for x in (x for x in ratios if x > 7):
        yield Seen(f"v_t/(mu v_n) = {x:g}: R spin/(mu v_n)", "1", spin[x], -5.0, f"closed form of sliding; {CHUNG}, test 5", 1e-4,
                   "the speed after, 1e-5, and the spring, which is at its limit after a step of 400")
        yield Seen(f"v_t/(mu v_n) = {x:g}: the contact point's", "1", point[x], x - 7, f"closed form of sliding; {CHUNG}, test 5", 5e-4,
                   "7/5 of the error of the spin, over x - 7 = 1")
    apart = max((spin[x] - interpolated(published(OF_NORMAL, "FEM"), x) for x in ratios if x <= 6), key=abs)
    yield Seen("v_t/(mu v_n) from 2 to 6: R spin/(mu v_n), furthest from the FEM", "1", apart, 0.0, "FEM of Wu et al. 2003 as Kratos has it", 0.4,
               "a comparison, 8 % of the spin of full sliding: Mindlin's spring has no partial slip, the FEM has", True)


def slip_after(slip, e, friction, v):
    """The slip that is left where friction is at its limit, which is that of |F|, in all of an impact."""
    return slip - 3.5 * friction * impulse(e) * v


SLIP_SOURCE = "3.5 mu/tan times the integral of |F|, by quadrature; {}, sliding"
SLIP_REASON = "3.5 mu/tan times how far the restitution may be off, n = 400"


@case("spinning", "Spinning sphere on a rigid wall, sliding (test 6)")
def spinning(setting):
    young, nu, density, radius, v = ALUMINIUM
    friction, e = 0.4, 0.5
    angles = (75, 78, 80, 83, 85)
    grain = Grain((0, 0, 0), radius, density)
    dt = Hertz(young / (1 - nu ** 2), radius, grain.mass, v).time / STEPS
    slips = [v * math.tan(math.radians(a)) for a in angles]
    grains = [Grain((3 * radius * (k - 2), 0, radius + 3.3 * dt * v), radius, density, (0, 0, -v), (0, -slip / radius, 0)) for k, slip in enumerate(slips)]
    states = fly(setting, grains, (-2, 2, -2, 2, -0.1, 0.4), setting.floor(hertz_law(setting, young, nu, e, friction, slides=True), 1.5), dt, 3 * STEPS)
    for angle, slip, s in zip(angles, slips, states[max(states)]):
        yield Seen(f"{angle} degrees: slip after over slip before", "1", (s["vx"] - radius * s["omegay"]) / slip, slip_after(slip, e, friction, v) / slip,
                   SLIP_SOURCE.format(f"{CHUNG}, test 6"), 3.5 * friction * cut_limit(e, STEPS) / math.tan(math.radians(angle)), SLIP_REASON, True)


@case("spinning-pair", "Spheres that spin together and against each other (tests 7 and 8)", BETWEEN_GRAINS)
def spinning_pair(setting):
    young, nu, density, radius, v = ALUMINIUM
    friction, e = 0.4, 0.5
    law = hertz_law(setting, young, nu, e, friction, pair=True, slides=True)
    exact = Hertz(young / (2 * (1 - nu ** 2)), radius / 2, Grain((0, 0, 0), radius, density).mass / 2, 2 * v)
    dt = exact.time / STEPS
    box = (-1, 1, -1, 1, -1, 1)

    def meet(left, right, law):
        states = fly(setting, [left, right], box, "", dt, 3 * STEPS, None, law)
        return states[max(states)]
    for spin in (0.17498, 1.15470, 22.86010):
        half = radius + 3.3 * dt * v
        a, b = meet(Grain((-half, 0, 0), radius, density, (v, 0, 0), (0, 0, spin)), Grain((half, 0, 0), radius, density, (-v, 0, 0), (0, 0, -spin)), law)
        yield Seen(f"like spheres, {spin:g} rad/s against each other: spin after", "rad/s", a["omegaz"], spin, f"surfaces that do not slip; {CHUNG}, test 7", 1e-12, "round-off")
        yield Seen(f"like spheres, {spin:g} rad/s against each other: speed across", "m/s", a["vy"], 0.0, f"surfaces that do not slip; {CHUNG}, test 7", 1e-12, "round-off", True)
    small, heavy = 0.6 * radius, 3 * density
    for angle in (75, 80, 85):
        slip = v * math.tan(math.radians(angle))
        a, b = meet(Grain((-radius - 3.3 * dt * v, 0, 0), radius, density, (v, 0, 0), (0, 0, slip / radius)), Grain((small, 0, 0), small, heavy), law)
        left = (a["vy"] + radius * a["omegaz"]) - (b["vy"] - small * b["omegaz"])
        yield Seen(f"unlike spheres, one at rest, {angle} degrees: slip after over slip before", "1", left / slip, slip_after(slip, e, friction, v) / slip,
                   SLIP_SOURCE.format(f"{CHUNG}, test 8"), 3.5 * friction * cut_limit(e, STEPS) / math.tan(math.radians(angle)), SLIP_REASON, True)
        yield Seen(f"unlike spheres, one at rest, {angle} degrees: restitution", "1", (b["vx"] - a["vx"]) / v, e, f"{CHUNG}, test 8", cut_limit(e, STEPS), CUT, True)


def curves(folder):
    """What the page draws beside published points: rows of curve, x and value, with two triangles."""
    write_floors(folder)
    setting = Setting(TWO, folder)
    for angle, values in oblique_impacts(setting, E_OBLIQUE).items():
        yield from ((curve, angle, value) for curve, value in zip((ALONG, SPIN, REBOUND), values))
    spin, _ = oblique_of_normal(setting, [0.25 * k for k in range(1, 33)])
    yield from ((OF_NORMAL, x, value) for x, value in spin.items())


# ---- bouncing to rest ------------------------------------------------------------------------

def speed_after(v, stiffness, gamma, g):
    """Of a grain that comes with v and has weight: x'' = g - w^2 x - gamma x', x the overlap, until x is 0 again."""
    w, b = math.sqrt(stiffness), gamma / 2
    f, sunk = math.sqrt(w * w - b * b), g / (w * w)
    c = (v - b * sunk) / f    # x = sunk + exp(-b t) (c sin f t - sunk cos f t)

    def x(t):
        return sunk + math.exp(-b * t) * (c * math.sin(f * t) - sunk * math.cos(f * t))
    low, high = 0.5 * math.pi / f, 1.9 * math.pi / f
    for _ in range(200):
        t = (low + high) / 2
        low, high = (t, high) if x(t) > 0 else (low, t)
    return -math.exp(-b * t) * ((f * c - b * -sunk) * math.cos(f * t) + (f * sunk - b * c) * math.sin(f * t))


@case("bouncing", "Bouncing to rest (MFiX DEM02)")
def bouncing(setting):
    radius, density, height = 0.1, 2600.0, 0.5
    mass = Grain((0, 0, 0), radius, density).mass
    for kn, steps in ((5e4, 1000), (5e6, 400)):
        for e in (0.5, 0.8, 1.0):
            gamma = -2 * math.log(e) * math.sqrt(kn / mass) / math.sqrt(math.pi ** 2 + math.log(e) ** 2)
            dt = math.pi / math.sqrt(kn / mass - gamma ** 2 / 4) / steps
            tops, v = [], math.sqrt(2 * G * (height - radius))
            for _ in range(3):
                v = speed_after(v, kn / mass, gamma, G)
                tops.append(v * v / (2 * G))
            # Until the third top.
            time = math.sqrt(2 * (height - radius) / G) + sum(2 * math.sqrt(2 * h / G) for h in tops[:2]) + 3.6 * dt * steps + math.sqrt(2 * tops[2] / G) / 2
            law = f"hooke {kn!r} {gamma!r} tangential linear_nohistory 0.0 0.0 damping mass_velocity"
            states = fly(setting, [Grain((0, 0, height), radius, density)], (-2, 2, -2, 2, -1, 2), setting.floor(law, 1.0) + setting.gravity(), dt,
                         round(time / dt), 20)
            seen, before = [], -1.0
            for step in sorted(states):
                s = states[step][0]
                if s["z"] > radius and s["vz"] > 0 > before:    # it has left; flight keeps its energy to the bit or so
                    seen.append(s["z"] - radius + s["vz"] ** 2 / (2 * G))
                if s["z"] > radius:
                    before = s["vz"]
            for k, (top, exact) in enumerate(zip(seen, tops), 1):
                # Touch and leaving fall anywhere in a step: the dashpot acts for up to half a step more or less at either end, as a part -2 ln(e)/n of v
                # a step, and the spring's energy is off by (pi/n)^2/4 at either end.
                limit = k * (4 * -math.log(e) / steps + (math.pi / steps) ** 2 / 2 + 1e-6)
                yield Seen(f"{kn:g} N/m, e = {e:g}: top {k} above touch", "m", top, exact, "damped oscillator with weight, closed form; the case is MFiX DEM02", limit,
                           "k (-4 ln(e)/n + (pi/n)^2/2): the dashpot at both ends of k contacts, cut by a step, and the spring there; n = 1000 and 400")
