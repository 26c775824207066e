# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""A copy of the sources that a recipe changes, and its build, which both stay in the build folder: what did not change is not
built again."""

import filecmp
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ.get("LSDCD_BUILD", ROOT / "build"))
# Without optimisation, which takes two thirds of the time of a law.
QUICK_TO_COMPILE = ("-D", "CMAKE_BUILD_TYPE=Debug", "-D", "CMAKE_CXX_FLAGS_DEBUG=-O0 -DNDEBUG")
FOLDERS = ("bench", "cmake", "doc", "examples", "kokkos", "potentials", "src", "tests")


def renew(fresh, kept):
    """Makes the folder `kept` one with the files of `fresh`; files that are alike keep their time."""
    for path in sorted(kept.rglob("*"), reverse=True):
        if path.is_file() and not (fresh / path.relative_to(kept)).is_file():
            path.unlink()
    for path in fresh.rglob("*"):
        own = kept / path.relative_to(fresh)
        if path.is_file() and not (own.is_file() and filecmp.cmp(path, own, shallow=False)):
            own.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, own)


def built(name, change, targets, options=()):
    """The build folder of a copy of the sources that change(folder) has changed."""
    kept, build = (BUILD / "recipes" / name / folder for folder in ("source", "build"))
    kept.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=kept.parent) as fresh:
        fresh = pathlib.Path(fresh)
        for folder in FOLDERS:
            shutil.copytree(ROOT / folder, fresh / folder, ignore=shutil.ignore_patterns("__pycache__"))
        for path in ROOT.iterdir():
            if path.is_file():
                shutil.copy(path, fresh)
        change(fresh)
        renew(fresh, kept)
    # Objects of a copy elsewhere are taken from ccache.
    environment = {**os.environ, "CCACHE_BASEDIR": str(kept.parent), "CCACHE_NOHASHDIR": "1"}
    configure = [os.environ.get("LSDCD_CMAKE", "cmake"), "-S", kept, "-B", build, "-G", os.environ.get("LSDCD_GENERATOR", "Ninja"),
                 *QUICK_TO_COMPILE, "-D", "LSDCD_CUDA=OFF", "-D", "LSDCD_TESTS=ON",
                 *shlex.split(os.environ.get("LSDCD_OPTIONS", "")), *options]
    for command in (configure, [configure[0], "--build", build, "-j", str(os.cpu_count()), "--target", *targets]):
        done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=environment)
        if done.returncode:
            errors = [line for line in done.stdout.split("\n") if re.search("error|Error|FAILED", line)]
            raise AssertionError("\n".join(["the sources with the recipe do not build:", *errors[:20], done.stdout[-1000:]]))
    return build
