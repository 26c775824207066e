# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The plugin in a host that it was not built for: one sentence with what it found, what it is for
and the remedy, and no style.

The host is a small program that answers the questions of LAMMPS's C interface as it is told, and
opens the plugin as LAMMPS does. It has no name of LAMMPS's classes, and of MPI only what is given.
"""

import os
import re
import shutil
import subprocess

import lmp
from facts import fact

PLUGIN = lmp.LIB / "lsdcdplugin.so"
# host PLUGIN VERSION MPI TAGINT BIGINT RANK
HOST = r"""
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
static char **told;
int lammps_version(void *lmp) { return atoi(told[2]); }
int lammps_config_has_mpi_support(void) { return atoi(told[3]); }
int lammps_extract_setting(void *lmp, const char *name)
{
  if (strcmp(name, "tagint") == 0) return atoi(told[4]);
  if (strcmp(name, "bigint") == 0) return atoi(told[5]);
  return strcmp(name, "universe_rank") == 0 && lmp ? atoi(told[6]) : -1;
}
static void add(void **plugin, void *lmp) { printf("STYLE %s\n", (char *) plugin[2]); }
int main(int argc, char **argv)
{
  void *file = dlopen(argv[1], RTLD_NOW | RTLD_GLOBAL);
  told = argv;
  if (!file) return printf("NOT OPENED: %s\n", dlerror()) < 0;
  ((void (*)(void *, void *, void *)) dlsym(file, "lammpsplugin_init"))(&told, file, add);
  return 0;
}
"""
# An MPI library: a name that only it has, and what it says it is.
LIBRARY = r"""
#include <string.h>
int MARK;
int PMPI_Get_library_version(char *text, int *length)
{
  strcpy(text, SAYS);
  *length = strlen(text);
  return 0;
}
"""
LIBRARIES = {"Open MPI": ("ompi_mpi_comm_world", "Open MPI v4.1.4, package: Debian OpenMPI, ident: 4.1.4"),
             "MPICH": ("MPIR_Dup_fn", "MPICH Version:\\t4.0.2\\nMPICH Release date:\\tThu Apr 7")}
SIZES = {"LAMMPS_SMALLBIG": (4, 8), "LAMMPS_BIGBIG": (8, 8), "LAMMPS_SMALLSMALL": (4, 4)}


def compile_c(source, output, *flags):
    subprocess.run([lmp.CXX, "-x", "c", "-w", *flags, "-", "-o", output, "-ldl"], input=source, text=True, check=True)
    return output


def compile_guard(folder, mpi_header):
    """The file that is loaded, with what a LAMMPS 4Jul2026 and its mpi.h define."""
    folder.mkdir()
    (folder / "mpi.h").write_text(mpi_header + "\n")
    (folder / "lmptype.h").write_text("namespace LAMMPS_NS { typedef int tagint; typedef long bigint; }\n")
    subprocess.run([lmp.CXX, "-std=c++17", "-shared", "-fPIC", "-I", folder, "-DLSDCD_HOST_VERSION=20260704",
                    '-DLSDCD_STYLES="lsdcdplugin-styles.so"', lmp.HERE.parent.parent / "src" / "lammps" / "plugin_guard.cpp",
                    "-o", folder / "lsdcdplugin.so", "-ldl"], check=True)
    return folder / "lsdcdplugin.so"


def load(host, libraries, version, sizes, mpi=1, rank=0, plugin=PLUGIN):
    """The host's exit status, and what it and the plugin wrote."""
    done = subprocess.run([host, plugin, str(version), str(mpi), *map(str, SIZES[sizes]), str(rank)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60,
                          env=dict(os.environ, LD_PRELOAD=":".join(map(str, libraries))))
    return done.returncode, done.stdout


def test_refusals(folder):
    host = compile_c(HOST, folder / "host", "-rdynamic")
    libraries = {name: compile_c(LIBRARY, folder / (name.replace(" ", "") + ".so"), "-shared", "-fPIC",
                                 f"-DMARK={mark}", f'-DSAYS="{says}"') for name, (mark, says) in LIBRARIES.items()}
    def refused(name, *words, **told):
        status, text = load(host, **told)
        lines = text.splitlines()
        fact(name, status == 0 and len(lines) == 1 and
             lines[0].startswith("lsdcd plugin not loaded: it was built for LAMMPS version ") and
             all(word in text for word in words), f"exit status {status}, {text.strip()}")
        return text

    text = refused("another version is refused", "this is version 20380119 with Open MPI v4.1.4 and",
                   "Rebuild it against this LAMMPS: cmake", libraries=[libraries["Open MPI"]], version=20380119,
                   sizes="LAMMPS_SMALLBIG")
    built = re.search(r"built for LAMMPS version (\d+) with (.+) and integers (\w+), this", text)
    if not built:
        return
    version, mpi, sizes = built.groups()
    other_mpi = "MPICH" if mpi == "Open MPI" else "Open MPI"
    same = {"libraries": [libraries[mpi]], "version": version, "sizes": sizes}

    refused("a host without a version is refused", "this is an unknown version", **{**same, "version": 0})
    refused("a LAMMPS without MPI is refused", "with no MPI and", "-D LSDCD_HOST_MPI=OFF",
            **{**same, "libraries": [], "mpi": 0})
    for other in SIZES.keys() - {sizes}:
        refused(f"{other} is refused", f"and integers {other}.", f"-D LSDCD_HOST_SIZES={other}",
                **{**same, "sizes": other})
    other_says = {"MPICH": "with MPICH Version: 4.0.2 and", "Open MPI": "with Open MPI v4.1.4 and"}[other_mpi]
    refused("another MPI library is refused", other_says, "-D MPI_CXX_COMPILER=",
            **{**same, "libraries": [libraries[other_mpi]]})
    refused("another MPI library is refused though ours is in the process, too", other_says,
            **{**same, "libraries": [libraries[other_mpi], libraries[mpi]]})
    refused("an MPI library that says nothing is refused", "with an unknown MPI library and",
            **{**same, "libraries": []})
    refused("all that differs is said at once", "this is version 20380119 with ", "integers LAMMPS_BIGBIG.",
            "-D LSDCD_HOST_SIZES=LAMMPS_BIGBIG -D MPI_CXX_COMPILER=", libraries=[libraries[other_mpi]],
            version=20380119, sizes="LAMMPS_BIGBIG")
    status, text = load(host, **{**same, "version": 20380119}, rank=1)
    fact("other processes than the first are silent", (status, text) == (0, ""), text)
    refused("a host that says it fits and has other classes is refused", "undefined symbol", "Rebuild it", **same)
    alone = folder / "alone" / "lsdcdplugin.so"
    alone.parent.mkdir()
    shutil.copy(PLUGIN, alone)
    refused("a plugin without its other file is refused", f"{alone.parent}/lsdcdplugin-styles.so",
            "Keep both files in one folder", **same, plugin=alone)

    # Of a plugin that is built for a LAMMPS without MPI, the first file only: it lets that LAMMPS in where it
    # looks for its second.
    serial = {"plugin": compile_guard(folder / "serial", "#define MPI_STUBS"), "version": 20260704, "sizes": "LAMMPS_SMALLBIG"}
    refused("a plugin without MPI takes a LAMMPS without MPI", "its other file does not open", libraries=[], mpi=0, **serial)
    for name, library in libraries.items():
        refused(f"a plugin without MPI refuses a LAMMPS with {name}", "with no MPI and integers", f"with {name} ",
                "-D LSDCD_HOST_MPI=ON -D MPI_CXX_COMPILER=", libraries=[library], **serial)
