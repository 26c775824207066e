# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Every command of doc/tutorial.md, in its order, and the script that opens its result."""
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

import lmp
from facts import at_most, fact

ROOT = lmp.HERE.parent.parent
TUTORIAL = ROOT / "examples" / "tutorial"


def run(command, folder):
    # Its 150 000 steps are short. A process that gives up its core whenever it waits gets it back after
    # milliseconds, where another test runs.
    return subprocess.run(command, cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          stdin=subprocess.DEVNULL, env=dict(lmp.environment(), OMPI_MCA_mpi_yield_when_idle="0"))


def test_commands(folder):
    (folder / "build").mkdir()
    (folder / "build" / "bin").symlink_to(pathlib.Path(lmp.LMP).parent)
    (folder / "examples").symlink_to(ROOT / "examples")
    blocks = re.findall(r"^```sh\n(.*?)^```", (ROOT / "doc" / "tutorial.md").read_text(), re.M | re.S)
    # One heap for each rolling friction is enough to see that the commands work.
    text = "".join(blocks)
    fact("the page asks for several heaps", text.count("--seeds 3") == 1)
    done = run(["bash", "-ec", "set -o pipefail\n" + text.replace("--seeds 3", "--seeds 1")], folder)
    fact("every command ends well", done.returncode == 0, done.stdout[-1500:] if done.returncode else "")
    text = done.stdout
    fact("the part is not clean", "clean       no: 2 duplicate facets, 8 edges" in text)
    fact("repair mends what the page says", all(
        line in text for line in ("welded      12 corners", "dropped     0 degenerate facets, 2 duplicates",
                           "turned      3 facets", "left        48 open edges in 2 boundaries")))
    allowed = float(re.search(r"^timestep +(\S+)", text, re.M)[1])
    used = float(re.search(r"^timestep +(\S+)", (TUTORIAL / "in.hopper").read_text(), re.M)[1])
    fact("the script takes less than the timestep that is told", 0.5 * allowed < used <= allowed, f"{allowed}")
    weight, borne = map(float, re.search(r"weight (\S+) N, .* carry (\S+) N", text).groups())
    # What still moves of 3000 grains that fell: their mean acceleration is below a hundredth of gravity.
    at_most("wall and plate carry the weight", abs(borne / weight - 1), 0.01)
    # Beverloo: 0.58 bulk_density sqrt(g) (D - 1.4 d)^2.5, bulk density 0.6 x 2500, D = 24 mm, d = 4 mm. For
    # outlets of 6 diameters his constants vary by a third from one material to another.
    beverloo = 0.58 * 1500 * 9.81**0.5 * (0.024 - 1.4 * 0.004) ** 2.5
    flow = float(re.search(r"^flow: (\S+)", text, re.M)[1])
    at_most("the flow is like Beverloo's law", abs(flow / beverloo - 1), 1 / 3)
    angles = [float(x) for x in re.findall(r"^\| 0\.\d+ \| (\S+) \|", text, re.M)]
    fact("rolling friction makes heaps steeper", len(angles) == 4 and angles == sorted(angles), str(angles))
    fact("plots and fields are there", all((folder / "build" / "tutorial" / name).exists()
                                         for name in ("repose/repose.png", "hopper_70000.vtp")))


def test_paraview(folder):
    missing = [name for name in ("pvpython", "xvfb-run") if not shutil.which(name)]
    if missing:
        pytest.skip(f"{' and '.join(missing)} missing, install paraview, python3-paraview and xvfb")
    run([sys.executable, TUTORIAL / "make_meshes.py"], folder)
    shutil.copy(folder / "part.stl", folder / "hopper.stl")
    done = run([lmp.LMP, "-in", TUTORIAL / "in.hopper", "-var", "fill", "10000", "-var", "drain", "2"], folder)
    fact("the hopper runs", done.returncode == 0, done.stdout[-500:] if done.returncode else "")
    # ParaView opens a display twice. A server that resets in between may refuse the second time.
    display = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset"]
    done = run([*display, "pvpython", TUTORIAL / "view.py"], folder)
    fact("paraview draws", done.returncode == 0 and (folder / "wall_stress.png").exists(), done.stdout[-500:])
