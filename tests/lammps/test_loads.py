# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Stress and wear of the triangles: files, totals, ranks and restart."""

import lmp
import scene
import vtp
from facts import at_most, fact

LAW = "hooke/history 1e4 NULL 120 NULL 0.4 1"
FIRST, SECOND = 300, 400
ON_RANKS = 1e-12    # sums of the same numbers in another order


def apart(a, b, name):
    return max(abs(x - y) for x, y in zip(a[name], b[name])) / max(map(abs, a[name]))


def test_loads(folder):
    scene.write_floor(folder / "floor.stl")
    with_loads = "mesh floor.stl wear archard 0.001 50 mesh_fields {} every 100"

    def forces(name, more=""):
        return scene.forces(LAW, mesh=with_loads.format(name), more=more)

    def go(name, ranks=1, begin=scene.CREATE, steps=FIRST + SECOND, last=""):
        thermo = ("thermo_style custom step f_wall[3] f_wall[7] f_wall[10] "
                  "f_wall[1] f_wall[2]\n"
                  "thermo_modify norm no format float %.17g\nthermo 1\n")
        text = lmp.run_well(begin + forces(name, thermo) + f"run {steps}\n" + last, folder, ranks)
        return lmp.read_thermo(text)

    rows = go("one_*.vtp")
    fields = {s: vtp.read(folder / f"one_{s}.vtp") for s in range(100, FIRST + SECOND + 1, 100)}
    last = fields[FIRST + SECOND]
    fact("a file every 100 steps, none at the start", not (folder / "one_0.vtp").exists())
    fact("a value for every triangle", len(last["worn_volume"]) == 2 * 26 * 26)
    fact("the floor has worn", rows[-1][3] > 0, f"{rows[-1][3]:.3g}")
    at_most("worn volumes sum to the fix's tenth number",
            abs(sum(last["worn_volume"]) / rows[-1][3] - 1), ON_RANKS)
    at_most("contacts average to the mean of the fix's seventh number",
            abs(sum(last["contacts"]) / (sum(r[2] for r in rows[-100:]) / 100) - 1), ON_RANKS)
    mean = [sum(r[k] for r in rows[-100:]) / 100 for k in (4, 5, 1)]
    at_most("forces sum to the mean of the fix's first three numbers",
            max(abs(sum(last["force"][d::3]) / mean[d] - 1) for d in range(3)), ON_RANKS)

    go("two_*.vtp", ranks=2)
    for name in ("worn_volume", "normal_stress", "shear_stress", "contacts", "force"):
        at_most(f"{name} on 2 ranks", apart(last, vtp.read(folder / f"two_{FIRST + SECOND}.vtp"), name),
                1e-9)

    # A run in two pieces, in one input and through a file, in the middle of an average.
    half = FIRST + 50
    go("a_*.vtp", steps=half, last=f"write_restart half.restart\nrun {SECOND - 50}\n")
    for ranks in (1, 2):
        rows = go("b_*.vtp", ranks, scene.SETTINGS + "read_restart half.restart\n", SECOND - 50)
        for step in (FIRST + 100, FIRST + SECOND):
            a, b = (vtp.read(folder / f"{x}_{step}.vtp") for x in "ab")
            for name in ("worn_volume", "normal_stress", "contacts", "force"):
                at_most(f"{name} at {step}, continued on {ranks}", apart(a, b, name),
                        0 if ranks == 1 else 1e-9)

    scene.write_floor(folder / "floor.stl", cells=4)
    text = lmp.run_well(scene.SETTINGS + "read_restart half.restart\n" + forces("c_*.vtp") +
                        "run 10\n", folder)
    fact("another mesh: loads begin at zero, with a warning", "begin at zero" in text)
    scene.write_floor(folder / "floor.stl", side=6.49)
    text = lmp.run_well(scene.SETTINGS + "read_restart half.restart\n" + forces("c_*.vtp") +
                        "run 10\n", folder)
    fact("also of one with as many triangles", "begin at zero" in text)
