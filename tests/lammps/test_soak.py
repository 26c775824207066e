# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Many steps of a small rotating drum: memory stays what it was and energies are bounded.

LSDCD_STEPS: how many, 20000 unless given; 1e6 take some minutes.
"""

import os
import pathlib
import subprocess
import time

import lmp
import drum
import stl
from facts import at_most, fact

ROOM = 1.0    # MB: pages that malloc keeps
PARTS = 20    # of the run, each with its highest kinetic energy


def resident(pid):
    """MB, or None where the process has ended."""
    try:
        lines = pathlib.Path(f"/proc/{pid}/status").read_text().split("\n")
        return next(int(line.split()[1]) / 1024 for line in lines if line.startswith("VmRSS"))
    except (FileNotFoundError, ProcessLookupError, StopIteration):
        return None


def watch(folder, steps):
    """What LAMMPS says, and (seconds, MB) as it runs."""
    (folder / "in.soak").write_text(drum.BEGIN + f"thermo {max(steps // 1000, 1)}\nrun {steps}\n")
    with open(folder / "out", "w") as out:
        run = subprocess.Popen([lmp.LMP, "-in", "in.soak", "-log", "none", "-nocite"], cwd=folder,
                               env=lmp.environment(), stdout=out, stderr=out)
    seen, began = [], time.time()
    while run.poll() is None:
        now = resident(run.pid)
        if now:
            seen.append((time.time() - began, now))
        time.sleep(0.05)
    text = (folder / "out").read_text()
    if run.returncode:
        raise AssertionError(text[-4000:])
    return text, seen


def test_drum(folder):
    steps = int(os.environ.get("LSDCD_STEPS", "20000"))
    stl.write(folder / "drum.stl", drum.triangles())
    n = drum.write_data(folder / "drum.data")
    text, seen = watch(folder, steps)
    rows = lmp.read_thermo(text)
    fact(f"{steps} steps: no sphere is lost", {row[1] for row in rows} == {n}, str(n))
    # The first half has the start, whatever share of a short run that is.
    end = seen[-1][0]
    early = max(mb for at, mb in seen if at < 0.5 * end)
    late = max(mb for at, mb in seen if at > 0.9 * end)
    at_most(f"memory of {early:.1f} MB grows by, in MB", late - early, ROOM)
    energies = [row[2] for row in rows]
    cuts = [k * len(energies) // PARTS for k in range(PARTS + 1)]
    parts = [max(energies[a:b]) for a, b in zip(cuts, cuts[1:])]
    print("highest kinetic energy of each twentieth: " + " ".join(f"{e:.3g}" for e in parts))
    # All that there is to fall through, by spheres of density 2 and a diameter of 0.7 at most.
    fall = n * 2.0 * 0.18 * 9.81 * 2 * drum.RADIUS
    at_most("kinetic energy over that of a fall through the drum", max(energies) / fall, 1)
    # A bed that is carried round has the drum's speed, and slides: no more than the first fall has.
    at_most("and in the second half over that in the first", max(parts[PARTS // 2:]) / max(parts[:PARTS // 2]), 1)
    print(f"{seen[-1][0]:.0f} s, {max(mb for _, mb in seen):.1f} MB at most")
