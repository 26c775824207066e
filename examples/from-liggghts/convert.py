#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Convert an input script of LIGGGHTS 3.8 to one of LAMMPS with fix wall/lsdcd.

  convert.py in.chute -o in.chute.lammps      then read every line of it that has LEFT or NOTE

Materials (property/global) and models become the numbers of the pair style and of the wall; mesh/surface, wall/gran,
move/mesh, massflow/mesh, insert/* and dump mesh/* become words of fix wall/lsdcd, fix massflow/lsdcd and fix
insert/lsdcd; what both programs know stays as it is, but for names such as atom_style granular.

A line is converted with the defaults of LIGGGHTS 3.8, or with --pfm of LIGGGHTS-PFM, or it is left: "commands left: 0"
means the same physics. A line that is left stays as a comment below a line
  # LEFT in.chute:34: why; do: what to do
and so does a line that needs what it makes. The same list is printed, and the exit code is 3; it is 0 where nothing is left, and 1
where nothing was written. A line with NOTE is converted, and says what to look at. The script is written
whole or, after an error, not at all. It reads the script from top to bottom as a program: a variable, an ID or a region is what it
is at that line, the lines of include stand in place of it, and loops and ifs stay as they are. What a loop or an if may change, and
what is needed here as a number, is left (or give --var NAME VALUE).

The radius and the density of the grains, which the model hooke needs, come from particletemplate/sphere, from set, from
the file of read_data, or from --radius and --density. Files are looked for beside the script.
A script that goes on from the restart file of another converted one is converted with --converted-restart.
doc/from-liggghts.md has what you must know or decide.
"""
import argparse
import os
import sys
import tempfile
from pathlib import Path

from converter.errors import CannotConvert
from converter.script import Script


def is_named(script, out):
    """Whether a file is the script, one of its include, or has a name that is a word of theirs."""
    names = {script.path.name} | {name for line in script.lines for name in (line.file, *line.words)}
    return os.path.realpath(out) in {os.path.realpath(script.path.parent / name.strip("\"'")) for name in names}


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("script", type=Path, help="input script of LIGGGHTS")
    p.add_argument("-o", "--out", type=Path, help="file to write (default: standard output)")
    p.add_argument("--radius", type=float, help="of a grain, where the script does not tell (model hooke)")
    p.add_argument("--density", type=float, help="of a grain")
    p.add_argument("--pfm", action="store_true", help="with the defaults of LIGGGHTS-PFM: tangential no_history, units lattice")
    p.add_argument("--nearest", action="store_true", help="take the nearest commands, which else are comments with #:")
    p.add_argument("--converted-restart", action="store_true", help="read_restart reads a file that a converted script has written")
    p.add_argument("--var", nargs=2, action="append", metavar=("NAME", "VALUE"), help="value of a variable")
    a = p.parse_args()
    try:
        script = Script(a.script, a)
        text = script.convert()
        if a.out and is_named(script, a.out):
            raise CannotConvert(f"{a.out} is the script, or a file that it names, and would be replaced: give another name after -o")
        script.write_files()
    except (CannotConvert, OSError) as error:
        sys.exit(f"convert.py: {error}\nNothing was written.")
    if a.out:
        with tempfile.NamedTemporaryFile(dir=a.out.parent, delete=False) as whole:
            whole.write(text.encode("utf-8", "surrogateescape"))
        os.chmod(whole.name, 0o644)
        os.replace(whole.name, a.out)
    else:
        sys.stdout.buffer.write(text.encode("utf-8", "surrogateescape"))
    for left in script.left:
        print(f"left: {left}", file=sys.stderr)
    print(f"commands left: {len(script.left)}" + (f", see LEFT in {a.out}" if a.out and script.left else ""), file=sys.stderr)
    sys.exit(3 if script.left else 0)


if __name__ == "__main__":
    main()
