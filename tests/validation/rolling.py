# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Grains that slip, roll and spin on a floor, and on an incline."""

import math

from suite import G, Grain, Seen, case, fly

# A ball of 50 mm on linear springs. It begins where they carry it.
RADIUS, DENSITY, KN = 0.05, 2000.0, 1e5
MASS = Grain((0, 0, 0), RADIUS, DENSITY).mass
SUNK = MASS * G / KN
DAMPING = 60.0    # of the velocity, over the mass
BOX = (-1, 3, -1, 1, -0.2, 0.3)
DT = math.pi * math.sqrt(MASS / KN) / 100

# The same law at each wall. xgammat is a part of the normal damping.
KT = 2 / 7 * KN


def law_of(friction, more=""):
    return f"hooke {KN!r} {DAMPING!r} tangential linear_history {KT!r} 1.0 {friction!r} damping mass_velocity {more}"


def losses(setting):
    """Columns of what the mesh dissipated by sliding, rolling and twisting, with keyword energy."""
    return [f"f_wall[{place}]" for place in (61, 62, 63)] if setting.is_mesh else []


def run_ball(setting, law, seconds, v=(0, 0, 0), spin=(0, 0, 0), gravity="0 0 -1", every=None, move="nve/sphere", pressed=1.0):
    """The dump of a ball, and the energies of losses(). `pressed`: the part of its weight that presses it to the floor."""
    fixes = setting.floor(law, 3.0, "energy") + setting.gravity(G, gravity)
    grain = Grain((0, 0, RADIUS - SUNK * pressed), RADIUS, DENSITY, v, spin)
    columns = losses(setting)
    steps = round(seconds / DT)
    out = fly(setting, [grain], BOX, fixes, DT, steps, every, columns=columns, move=move)
    states, lost = out if columns else (out, [])
    return {s * DT: rows[0] for s, rows in states.items()}, lost


# ---- slip, then roll -----------------------------------------------------------------------

@case("slip-roll", "A ball that slips, then rolls (MFiX DEM04)")
def slip_roll(setting):
    friction, u0 = 0.2, 1.0
    stops = 2 * u0 / (7 * friction * G)
    stretch = friction * MASS * G / KT    # of the spring at its limit
    states, lost = run_ball(setting, law_of(friction), 1.3 * stops, (u0, 0, 0), every=1)
    time, end = max(states.items())
    of = "closed form; the case is MFiX DEM04"
    yield Seen("speed when it rolls", "m/s", end["vx"], 5 / 7 * u0, of, 1e-4,
               "the spring is stretched by h = mu m g/kt as slip ends, and swings: 2/7 h sqrt(7 kt/2/m), 9e-3 of the speed, damped by exp(-t/T) to 1 % of that")
    yield Seen("R w over speed", "1", RADIUS * end["omegay"] / end["vx"], 1.0, of, 1e-4, "as for the speed")
    after = u0 ** 2 * 12 / (49 * friction * G) + 5 / 7 * u0 * (time - stops)
    yield Seen("path", "m", end["x"], after, of, stretch / after, "the spring, as long as h = mu m g/kt = 72 um, is no slip")
    # While it slips friction is constant.
    half = min(states, key=lambda t: abs(t - stops / 2))
    yield Seen("speed at half of the slip", "m/s", states[half]["vx"], u0 - friction * G * half, of,
               friction * G * stretch / u0 / (u0 - friction * G * half), "the spring needs h/u0 = 72 us to its limit, in which mu g h/u0 of the speed is not lost")
    yield Seen("drift to the side", "m", end["y"], 0.0, "symmetry", 1e-15, "none: no number of the wall has a part across", True)
    if lost:
        # The spring at its limit holds h^2 kt/2, which the dashpot takes.
        yield Seen("heat of friction", "J", lost[0], MASS * u0 ** 2 / 7, of, 0.5 * KT * stretch ** 2 / (MASS * u0 ** 2 / 7) * 1.1,
                   "the spring holds kt h^2/2 = 7e-5 J at the end of slip")


# ---- rolling to rest -----------------------------------------------------------------------

ROLLING = 0.05


@case("rolling", "A ball that rolls to rest, by each rolling law (Ai et al. 2011)")
def rolling(setting):
    u0, friction, seconds = 1.0, 0.5, 2.0
    # sds: limit mu N, arm R; a spring that yields after 2e-5 m, and its critical dashpot.
    # Law: words, and the way in which its spring yields.
    weight, kn_radius = MASS * G, KN * RADIUS
    laws = {"sds": (f"rolling sds {ROLLING * weight / 2e-5!r} 0.0 {ROLLING!r}", 2e-5)}
    if setting.is_mesh:
        laws.update(cdt=(f"rolling cdt {ROLLING!r}", 0.0), epsd2=(f"rolling epsd2 {ROLLING!r}", ROLLING * weight / KT),
                    epsd=(f"rolling epsd {ROLLING!r} 0.0", weight * RADIUS / (2.25 * kn_radius * ROLLING)),
                    epsd3=(f"rolling epsd3 {ROLLING!r} 0.0 4.5", weight * RADIUS / (4.5 * kn_radius * ROLLING)))
    a = 5 / 7 * ROLLING * G
    for name, (words, way) in laws.items():
        states, lost = run_ball(setting, law_of(friction, words), seconds, (u0, 0, 0), (0, u0 / RADIUS, 0))
        end = states[max(states)]
        t = max(states)
        u = u0 - a * t
        of = "closed form; the case is that of Ai et al. 2011 for one ball"
        # The first step has no torque yet, and none is full until the spring yields.
        late = a * (DT + way / u0)
        why = f"a (dt + s/u0): the first step has no torque, and the spring yields after s = {way * 1e6:.3g} um"
        yield Seen(f"{name}: speed after 2 s", "m/s", end["vx"], u, of, late / u, why)
        yield Seen(f"{name}: path after 2 s", "m", end["x"], u0 * t - a * t * t / 2, of, late * t, f"a t (dt + s/u0), likewise", True)
        if lost:
            # The reach of the models of LIGGGHTS is R - d/2 where the distance is R - d.
            heat = 0.7 * MASS * (u0 ** 2 - u ** 2)
            held = 0.5 * ROLLING * weight * way + 1.4 * MASS * u * late + (heat * SUNK / (2 * RADIUS) * 1.01 if name.startswith("epsd") else 1e-4 * heat)
            yield Seen(f"{name}: heat of rolling", "J", lost[1], heat, of, held, "what the spring holds, 7/5 m u times the error of the speed, and " +
                       ("d/2R: LIGGGHTS's models roll by (R - d/2)/(R - d) of the turn" if name.startswith("epsd") else "d/R: the arm is R, the way that of R - d"), True)


@case("held", "A ball that the spring of rolling holds on a slope")
def held(setting):
    friction, angle, damping = 0.5, math.atan(0.02), 20.0
    down = f"{math.sin(angle)!r} 0.0 {-math.cos(angle)!r}"
    pull = MASS * G * math.sin(angle)
    # Law: words, and the stiffness of its torque against the way rolled, over R.
    laws = {"sds": (f"rolling sds {KT!r} {damping!r} {ROLLING!r}", KT)}
    if setting.is_mesh:
        laws.update(epsd2=(f"rolling epsd2 {ROLLING!r}", KT), epsd=(f"rolling epsd {ROLLING!r} 0.3", 2.25 * KN * ROLLING ** 2))
    for name, (words, stiffness) in laws.items():
        states, _ = run_ball(setting, law_of(friction, words), 4.0, gravity=down, pressed=math.cos(angle))
        end = states[max(states)]
        # LIGGGHTS's models roll by (R - d/2)/(R - d) of the turn, and the way of the centre is R - d/2 of it, or R - d.
        yield Seen(f"{name}: way to rest", "m", end["x"], pull / KT + pull / stiffness, "m g sin (1/kt + 1/k), kt of friction, k of rolling; closed form",
                   1e-9 if name == "sds" else SUNK / RADIUS, "round-off, and the swing, damped to nothing" if name == "sds" else "arms of R, R - d/2 or R - d, d/R = 2.1e-3")


# ---- spin about the normal -----------------------------------------------------------------

@case("spin-down", "A ball that spins down about the normal")
def spin_down(setting):
    spin, length = 20.0, 0.002
    inertia = 0.4 * MASS * RADIUS ** 2
    stiffness = length * MASS * G / 1e-3    # yields after a turn of 1e-3
    states, lost = run_ball(setting, law_of(0.5, f"twisting sds {stiffness!r} 0.0 {length!r}"), 0.5, spin=(0, 0, spin))
    t, end = max(states), states[max(states)]
    left = spin - length * MASS * G / inertia * t
    of = "closed form: the torque is mu m g, mu a length"
    yield Seen("spin after 0.5 s", "rad/s", end["omegaz"], left, of,
               length * MASS * G / inertia * (DT + 1e-3 / spin) / left, "the first step has no torque, 0.1 ms, and the spring of twist yields 0.05 ms later")
    yield Seen("path", "m", math.hypot(end["x"], end["y"]), 0.0, "symmetry", 1e-15, "none: no force has a part across", True)
    # A spin that the spring of twist turns round before it yields.
    small = 0.5 * length * MASS * G / math.sqrt(stiffness * inertia)
    quarter = math.pi / 2 * math.sqrt(inertia / stiffness)
    swung, _ = run_ball(setting, law_of(0.5, f"twisting sds {stiffness!r} 0.0 {length!r}"), quarter, spin=(0, 0, small))
    t = max(swung)
    yield Seen("spin after a quarter of a swing, over that at first", "1", swung[t]["omegaz"] / small, math.cos(math.pi / 2 * t / quarter), "closed form, cos(t sqrt(k/I))",
               math.pi / 24 * (math.pi / 2 * DT / quarter) ** 2, "velocity Verlet is ahead by (w dt)^2/24 of the phase, 1.3e-5, and as much again", True)
    if lost:
        yield Seen("heat of twisting", "J", lost[2], 0.5 * inertia * (spin ** 2 - left ** 2), of, 3e-4,
                   "what the spring holds, k 1e-3^2/2 or 7e-5 of all, and the error of the spin")


# ---- an incline ------------------------------------------------------------------------------

@case("incline", "An incline: when a block slips, how a ball rolls and slips")
def incline(setting):
    friction = 0.3
    of = "closed form (Newton)"
    # The spring swings as it is loaded at once; from half of the time on only the slope acts.
    why = "round-off of speeds over the difference of two; the swing of the spring, in the first 0.1 s, is damped by exp(-30 t)"

    def sloped(part, seconds, move):
        angle = math.atan(part * friction)
        down = f"{math.sin(angle)!r} 0.0 {-math.cos(angle)!r}"
        states, _ = run_ball(setting, law_of(friction), seconds, gravity=down, move=move, pressed=math.cos(angle), every=round(seconds / DT / 2))
        first, last = sorted(states)[1:3]
        change = {name: (states[last][name] - states[first][name]) / (last - first) for name in ("vx", "omegay")}
        return angle, states[last], change
    for part in (0.99, 1.01, 1.5):
        # fix nve: it does not turn, as a block.
        angle, end, change = sloped(part, 2.0, "nve")
        name = f"block, tan = {part:g} mu"
        if part < 1:
            yield Seen(f"{name}: speed after 2 s", "m/s", end["vx"], 0.0, of, 1e-9, "it slips while the spring swings, and is then held: the swing is damped by exp(-30 t)", True)
        else:
            yield Seen(f"{name}: acceleration", "m/s2", change["vx"], G * (math.sin(angle) - friction * math.cos(angle)), of, 1e-9, why)
    for part in (0.5, 2.0):    # of 7/2 mu, where a ball begins to slip
        angle, end, change = sloped(3.5 * part, 1.0 if part < 1 else 0.6, "nve/sphere")
        rolls = part < 1
        a = 5 / 7 * G * math.sin(angle) if rolls else G * (math.sin(angle) - friction * math.cos(angle))
        name = f"ball, tan = {part:g} (7/2) mu"
        yield Seen(f"{name}: acceleration", "m/s2", change["vx"], a, of, 1e-9, why)
        yield Seen(f"{name}: R times that of its spin", "m/s2", RADIUS * change["omegay"], a if rolls else 2.5 * friction * G * math.cos(angle), of, 1e-9, why)
