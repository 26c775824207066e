# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""device cuda and device cpu give the same trajectory, to the last bit.

Skipped without the CUDA engine or a GPU.
"""

import pytest

import lmp
import scene
from facts import at_most

LAWS = {"hooke": "hooke 1e4 NULL 120 NULL 0.4 1",
        "hooke_history": "hooke/history 1e4 NULL 120 NULL 0.4 1",
        "hertz_history": "hertz/history 1e5 NULL 1500 NULL 0.4 1"}


def go(law, device, folder, ranks=1):
    done = lmp.run(scene.CREATE + scene.forces(law, f"mesh floor.stl device {device}") +
                   scene.dump("moves", 100) + "run 2000\n", folder, ranks)
    if "device cuda: " in done.stdout:
        pytest.skip(next(line for line in done.stdout.split("\n") if "device cuda: " in line))
    if done.returncode:
        raise AssertionError(done.stdout[-4000:])
    return lmp.read_dump(folder / "moves")


prepare = scene.bumpy_floor


def test_device(folder):
    for name, law in LAWS.items():
        for ranks in (1, 2):
            cuda, cpu = (go(law, device, folder, ranks) for device in ("cuda", "cpu"))
            at_most(f"{name} on {ranks} rank{'s' if ranks > 1 else ''}: same trajectory",
                    lmp.largest_difference(cuda, cpu), 0)
