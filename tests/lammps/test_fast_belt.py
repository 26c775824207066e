# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""What a grain gains on a fast belt: the figures of doc/contact_laws.rst, beside an integration of the law in Python."""
import math
import re

import lmp
from facts import fact

RADIUS, DENSITY, FALL, BELT, DT = 0.002, 2500.0, 1.0, 4.5, 1e-6
YOUNG, E, NU, MU = 5e6, 0.5, 0.25, 0.5

BELT_SCRIPT = lmp.head("-0.1 1 -0.05 0.05 0 0.1", units="si") + f"""\
create_atoms    1 single 0 0 0.00201
set             atom 1 diameter {2 * RADIUS} density {DENSITY}
set             atom 1 vz -{FALL}
pair_style      zero 0.005
pair_coeff      * *
neighbor        0.001 bin
timestep        {DT}
fix             move all nve/sphere
fix             w all wall/lsdcd granular hertz/material {YOUNG} {E} {NU} damping coeff_restitution &
                tangential ${{tangential}} mesh {lmp.HERE}/scripts/floor.stl scale 0.1 surface_vel {BELT} 0 0
variable        vx equal vx[1]
variable        z equal z[1]
thermo_style    custom step v_z
fix             stop all halt 10 v_z > 0.00202
run             100000
print           "gained $(v_vx)"
"""


def gained(model, xgammat):
    """By velocity Verlet as fix nve/sphere has it: velocities of the middle of the step when forces are found."""
    mass = DENSITY * 4 / 3 * math.pi * RADIUS ** 3
    modulus, shear = YOUNG / (2 * (1 - NU ** 2)), YOUNG / (4 * (2 - NU) * (1 + NU))
    alpha = -2 * math.log(E) / math.hypot(math.pi, math.log(E)) * math.sqrt(5) / 2
    z, vz, vx, wy, spring = 0.00201, -FALL, 0.0, 0.0, 0.0
    force = (0.0, 0.0)
    while vz < 0 or z < RADIUS:
        half = DT / 2 / mass
        turn = half * 2.5 / RADIUS    # of a solid sphere; the torque about y is that of a force below the centre
        vx, vz, wy = vx + half * force[0], vz + half * force[1], wy - turn * force[0]
        z += DT * vz
        overlap, force = RADIUS - z, (0.0, 0.0)
        if overlap <= 0:
            spring = 0.0
        else:
            a = math.sqrt(RADIUS * overlap)
            elastic = 4 / 3 * modulus * a * overlap
            damping = alpha * math.sqrt(mass * elastic / overlap)
            normal = elastic - damping * vz
            slip = vx - wy * RADIUS - BELT
            stiffness, dashpot = 8 * shear * a, xgammat * damping * slip
            limit = MU * abs(normal)
            if model == "mindlin/force":    # a force, against the slip
                spring -= stiffness * DT * slip
                total = spring - dashpot
            else:
                spring += DT * slip
                if model == "mindlin_slip":
                    spring = max(-limit / stiffness, min(limit / stiffness, spring))
                total = -stiffness * spring - dashpot
            if abs(total) > limit:
                total = math.copysign(limit, total)
                if model == "mindlin/force":
                    spring = total + dashpot
                elif model == "mindlin":
                    spring = -(total + dashpot) / stiffness
            force = (total, normal)
        vx, vz, wy = vx + half * force[0], vz + half * force[1], wy - turn * force[0]
    return vx


def test_gain(folder):
    page = (lmp.HERE.parent.parent / "doc" / "contact_laws.rst").read_text()
    said = re.findall(r"\b(0\.\d\d)\s+m/s", page)
    fact("the page has three figures", len(said) == 3, str(said))
    cases = (("mindlin", 1, 0), ("mindlin/force", 1, 1), ("mindlin_slip", 1, 2), ("mindlin", 0, 2))
    for model, xgammat, figure in cases if len(said) == 3 else ():
        tangential, in_page = f"{model} NULL {xgammat} {MU}", said[figure]
        shown = lmp.run_well(BELT_SCRIPT, folder, tangential=tangential)
        found = float(re.search(r"^gained (\S+)", shown, re.M)[1])
        wanted = gained(model, xgammat)
        # A centre near 2e-3 is rounded by 4e-19, of overlaps of 1e-4: 1e-14,
        # and no more than 1e-9 after the ten thousand steps of a bounce.
        fact(f"{tangential}: gains what the law says", abs(found - wanted) < 1e-9 * wanted, f"{found}, {wanted}")
        fact(f"{tangential}: gains what the page says", f"{found:.2f}" == in_page, f"{found}, {in_page}")
