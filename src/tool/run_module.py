#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Runs a module of the Python package lsdcd for the program: run_module.py report FOLDER ..."""
import importlib
import importlib.util
import os
import pathlib
import runpy
import sys

PREFIX = pathlib.Path(__file__).resolve().parents[2]    # of an installation, or a build folder
FOLDERS = ("@LSDCD_PYTHON_DIR@", "lib/python3/dist-packages")    # where the package is below it
NEEDED = {"numpy": "python3-numpy", "lsdcd": "python3-lsdcd"}    # and Debian's packages
MORE = {"film": {"PIL": "python3-pil"}}


def main():
    module = sys.argv[1]
    sys.path[1:1] = [str(PREFIX / folder) for folder in FOLDERS if (PREFIX / folder).is_dir()]
    library = PREFIX / "lib" / "liblsdcd.so.0"
    if library.is_file():
        os.environ.setdefault("LSDCD_LIBRARY", str(library))
    missing = {name: package for name, package in {**NEEDED, **MORE.get(module, {})}.items() if importlib.util.find_spec(name) is None}
    if missing:
        sys.exit(f"lsdcd {module}: Python ({sys.executable}) has no {', '.join(missing)}: apt install {' '.join(missing.values())}")
    try:
        importlib.import_module("lsdcd")
    except ImportError as error:    # no library, or one of another version
        sys.exit(f"lsdcd {module}: {error}")
    sys.argv[:2] = [f"lsdcd {module}"]
    runpy.run_module(f"lsdcd.{module}", run_name="__main__", alter_sys=True)


if __name__ == "__main__":
    main()
