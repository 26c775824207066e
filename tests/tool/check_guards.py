#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Checks that an exception of the core leaves no function that LAMMPS calls.

usage: check_guards.py [ROOT]

* Every public function that a style of src/lammps or kokkos overrides is in GUARDS (its destructor is not: it throws nothing).
* Every style that is told to LAMMPS, in SITES, is a guarded one, but for those of NO_CORE.

Prints one line per violation, and exits with 1 if there is one.
"""
import os
import re
import sys

GUARDS = ("src/lammps/guarded_styles.h", "kokkos/guarded_fix_kokkos.h")
SITES = {
    "src/lammps/plugin_styles.cpp": r"(?:create_fix<|create_pair<|create_style<\w+, )(\w+)",
    "kokkos/lsdcdkkplugin.cpp": r"create_fix<(\w+)",
    "cmake/packaging/lammps/fix_lsdcd.h": r"FixStyle\([^,]+,(\w+)",
    "cmake/packaging/lammps/compute_lsdcd.h": r"ComputeStyle\([^,]+,(\w+)",
    "cmake/packaging/lammps/pair_lsdcd.h": r"PairStyle\([^,]+,(\w+)",
    "cmake/packaging/lammps/region_lsdcd.h": r"RegionStyle\([^,]+,(\w+)",
}
NO_CORE = ("FixGravity", "FixGravityLsdcdKokkos")    # LAMMPS's own code, which throws LAMMPS's exceptions alone
STYLE = re.compile(r"^class (\w+) : public [^{]*\b(?:OwnMessages|Fix\w+Lsdcd)\b[^{]*\{(.*?)^(?:private|protected| private| protected):",
                   re.MULTILINE | re.DOTALL)
OVERRIDE = re.compile(r"\b(\w+)\([^;{}]*\)\s*(?:const\s*)?override")


def main():
    root = sys.argv[1] if len(sys.argv) > 1 else "."
    read = lambda name: open(os.path.join(root, name), encoding="utf-8").read()
    guarded = {f for name in GUARDS for f in OVERRIDE.findall(read(name))}
    wrong, styles = [], 0
    for folder in ("src/lammps", "kokkos"):
        for name in sorted(os.listdir(os.path.join(root, folder))):
            if not name.endswith(".h"):
                continue
            for style, public in STYLE.findall(read(f"{folder}/{name}")):
                styles += 1
                for function in OVERRIDE.findall(public):
                    if function != style and function not in guarded:
                        wrong.append(f"{folder}/{name}: {style}::{function}() is in none of {', '.join(GUARDS)}")
    if styles < 9:
        wrong.append(f"found {styles} styles, and there are 9 at least: STYLE matches them no longer")
    for name, pattern in SITES.items():
        made = re.findall(pattern, read(name))
        wrong += [f"{name}: {style} is made without a guard" for style in made if not style.startswith("Guarded") and style not in NO_CORE]
        if not made:
            wrong.append(f"{name}: no style is made there")
    for line in wrong:
        print(line)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
