# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""A sphere on a floor of triangles moves as on fix wall/gran's zplane.

Both codes evaluate the same formulas in another order. Rounding differences of
1e-16 per operation grow with the number of steps at most: 1e-12 leaves room for
10^4 operations. fix wall/gran checks the style hooke/history of 29Sep2021.
"""

import pytest

import lmp
from facts import at_most, fact

CASES = {
    "hooke": "hooke 1e4 NULL 5 NULL 0.5 1",
    "hooke_sticking": "hooke 1e4 NULL 5 400 9.0 1",
    "hooke_without_tangential_damping": "hooke 1e4 NULL 5 NULL 0.5 0",
    "hooke_limit_damping": "hooke 1e4 NULL 120 NULL 0.5 1 limit_damping",
    "hooke_history": "hooke/history 1e4 NULL 5 NULL 0.5 1",
    "hooke_history_sticking": "hooke/history 1e4 4e3 5 2 5.0 1",
    "hooke_history_undamped": "hooke/history 1e4 NULL 0 NULL 0.3 0",
    "hooke_history_limit_damping": "hooke/history 1e4 NULL 120 NULL 0.5 1 limit_damping",
    "hertz_history": "hertz/history 1e5 NULL 50 NULL 0.5 1",
    "hertz_history_sticking": "hertz/history 1e5 4e4 50 20 5.0 1",
    "hertz_history_limit_damping": "hertz/history 1e5 NULL 900 NULL 0.5 1 limit_damping",
}
# In real units a hertz stiffness is given in atmospheres and force is not mass times
# acceleration.
REAL = {"hertz_history_in_real_units": "hertz/history 1e7 NULL 10 NULL 0.5 1"}


prepare = lmp.flat_floor


def compare(folder, name, law, **settings):
    dumps = []
    for wall in (f"wall/gran {law} zplane 0.0 NULL", f"wall/lsdcd {law} mesh floor.stl"):
        dumps.append(folder / f"{name}.{len(dumps)}")
        lmp.run_well(lmp.HERE / "scripts" / "in.one_sphere", folder, wall=wall,
                     out=dumps[-1].name, **settings)
    a, b = (lmp.read_dump(d) for d in dumps)
    touched = sum(abs(row[1][11]) > 0 for row in a.values())
    fact(f"{name}: the sphere touches the floor", touched > 20, f"{touched} steps")
    at_most(f"{name}: trajectory as with wall/gran", lmp.largest_difference(a, b), 1e-12)


@pytest.mark.parametrize("name", CASES)
def test_trajectory(folder, name):
    compare(folder, name, CASES[name], unit="lj", kick=1, dt=1e-4, steps=1000, style="verlet")


@pytest.mark.parametrize("name", REAL)
def test_units_real(folder, name):
    compare(folder, name, REAL[name], unit="real", kick=1e-2, dt=0.01, steps=2000, style="verlet")
