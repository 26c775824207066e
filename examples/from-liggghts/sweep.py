#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Convert all input scripts of folders that have meshes, and say what was left.

  sweep.py LIGGGHTS-PFM/examples LIGGGHTS-INL/examples

Nothing is written beside the scripts. doc/notes/liggghts-scripts.md says what came out.
"""
import argparse
import collections
import re
import types
from pathlib import Path

from converter.errors import CannotConvert
from converter.script import Script

# Endings of files that name meshes but are no input scripts.
OTHERS = set(".txt .html .pdf .stl .vtk .md .log .py .sh .tex .svg .png .m .cpp .h".split())


def scripts(folder):
    """Files with a line `fix ID group mesh/surface...`."""
    for path in sorted(folder.rglob("*")):
        if path.is_file() and path.suffix not in OTHERS and re.search(rb"^\s*fix\s+\S+\s+\S+\s+mesh/surface", path.read_bytes(), re.M):
            yield path


def swept(path, converted_restart=False, pfm=False):
    """Commands of a script, and the reasons of those that are left; the error in place of them where nothing can be written."""
    options = types.SimpleNamespace(radius=None, density=None, var=None, converted_restart=converted_restart, pfm=pfm, nearest=False)
    try:
        script = Script(path, options)
        script.convert()
    except CannotConvert as error:
        return 0, str(error)
    return sum(bool(line.words) for line in script.lines), [re.sub(r"^[^:]*:\d+: |; do: .*", "", left) for left in script.left]


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("folder", type=Path, nargs="+", help="folder with input scripts of LIGGGHTS")
    p.add_argument("--converted-restart", action="store_true", help="as of convert.py")
    p.add_argument("--pfm", action="store_true", help="as of convert.py")
    a = p.parse_args()
    found = {path: swept(path, a.converted_restart, a.pfm) for folder in a.folder for path in scripts(folder)}
    reasons, of = collections.Counter(), collections.defaultdict(set)
    for path, (commands, left) in found.items():
        print(f"{path}: " + (f"{len(left)} of {commands} left" if isinstance(left, list) else left))
        for reason in left if isinstance(left, list) else []:
            reasons[reason] += 1
            of[reason].add(path)
    print()
    for reason, n in reasons.most_common():
        print(f"{n} in {len(of[reason])}: {reason}")
    whole = [left for _, left in found.values() if isinstance(left, list)]
    print(f"\n{len(found)} scripts: {len(whole)} written, {sum(not left for left in whole)} with nothing left; "
          f"{sum(n for n, _ in found.values())} commands, {sum(reasons.values())} left")


if __name__ == "__main__":
    main()
