#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Puts a fault into the scripts of all validation cases of seconds, one after another, and tells which cases see it: a number or a word other than the case
asks for, as if the code took it wrong. A fault that no case sees is named at the end.

usage: faults.py [--jobs N] [FAULT ...]
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "lammps")]

import suite
from cases import CASES


def times(factor):
    """Replaces what the second group of a pattern matched by so many times the number."""
    return lambda found: found[1] + repr(float(found[2]) * factor)


def plus(more):
    return lambda found: found[1] + repr(float(found[2]) + more)


NUMBER = r"(\d[\d.e+-]*)"
# Name: part of the code, pattern, replacement. Of friction: its law has one or two words before mu.
FAULTS = {
    "hertz-modulus": ("normal law", rf"(hertz/material ){NUMBER}", times(1.01)),
    "hooke-stiffness": ("normal law", rf"(hooke ){NUMBER}", times(1.01)),
    "hertz-is-hooke": ("normal law", r"hertz/material (\S+) (\S+) \S+ (.*?)mindlin(_slip)? NULL", r"hooke \1 \2 \3linear_history \1"),
    "nu": ("normal law", rf"(hertz/material \S+ \S+ ){NUMBER}", plus(0.01)),
    "restitution": ("damping", r"(hertz/material \S+ )(0\.[1-9]\d*)", plus(0.003)),
    "dashpot": ("damping", rf"(hooke \S+ ){NUMBER}", times(1.02)),
    "no-dashpot": ("damping", r"damping \S+", "damping velocity"),
    "tsuji-of-lammps": ("damping", r"(hertz/material \S+ )(0\.[1-9]\d*)(?=.*tsuji)", lambda found: found[1] + repr(suite.returned_by(suite.tsuji(float(found[2]))))),
    "limit-damping": ("damping", r"(damping coeff_restitution)", r"\1 limit_damping"),
    "friction": ("friction", rf"((?:mindlin|mindlin_slip|linear_history) \S+ \S+ ){NUMBER}", times(1.01)),
    "tangential-stiffness": ("friction", rf"(linear_history ){NUMBER}", times(1.1)),
    "mindlin-stiffness": ("friction", r"mindlin NULL", "mindlin 1e11"),
    "no-tangential-dashpot": ("friction", r"((?:mindlin|mindlin_slip|linear_history) \S+) 1\.0", r"\1 0.0"),
    "mindlin-is-rescaled": ("friction", r"mindlin NULL", "mindlin_rescale NULL"),
    "rolling": ("rolling", rf"(rolling (?:sds \S+ \S+|cdt|epsd2|epsd|epsd3) ){NUMBER}", times(1.01)),
    "no-rolling": ("rolling", r"rolling (sds \S+ \S+ \S+|cdt \S+|epsd2 \S+|epsd3 \S+ \S+ \S+|epsd \S+ \S+)", ""),
    "rolling-stiffness": ("rolling", rf"(rolling sds ){NUMBER}", times(1.1)),
    "twisting": ("rolling", rf"(twisting sds \S+ \S+ ){NUMBER}", times(1.01)),
    "twisting-stiffness": ("rolling", rf"(twisting sds ){NUMBER}", times(1.1)),
    "jkr-surface-energy": ("jkr", rf"(jkr \S+ \S+ \S+ ){NUMBER}", times(1.01)),
    "jkr-modulus": ("jkr", rf"(jkr ){NUMBER}", times(1.01)),
    "jkr-is-dmt": ("jkr", r"granular jkr", "granular dmt"),
    "dmt-surface-energy": ("cohesion", rf"(dmt \S+ \S+ \S+ ){NUMBER}", times(1.01)),
    "sjkr": ("cohesion", rf"(sjkr ){NUMBER}", times(1.01)),
    "bridge-tension": ("cohesion", rf"(capillary ){NUMBER}", times(1.001)),
    "bridge-angle": ("cohesion", rf"(capillary \S+ ){NUMBER}", plus(0.5)),
    "bridge-volume": ("cohesion", rf"(capillary \S+ \S+ NULL ){NUMBER}", times(1.01)),
    "hysteretic-stiffness": ("yielding", rf"(hysteretic ){NUMBER}", times(1.001)),
    "hysteretic-restitution": ("yielding", rf"(hysteretic \S+ ){NUMBER}", times(1.001)),
    "eepa-plasticity": ("yielding", rf"(eepa \S+ \S+ ){NUMBER}", times(1.001)),
    "eepa-surface-energy": ("yielding", rf"(eepa \S+ \S+ \S+ ){NUMBER}(?<! 0\.0)", times(1.01)),
    "thornton-pressure": ("yielding", rf"(thornton \S+ \S+ \S+ ){NUMBER}", times(1.001)),
    "gravity": ("gravity", rf"(gravity/lsdcd ){NUMBER}", times(1.001)),
    "gravity-leans": ("gravity", r"vector 0 0 -1", "vector 0.001 0 -1"),
    "no-rotation": ("rotation", r"nve/sphere", "nve"),
    "spin-reversed": ("rotation", r"(set atom \d+ omega \S+ )(\S+)", times(-1)),
    "mass": ("rotation", r"(density )(\S+)", times(1.01)),
    "radius": ("rotation", r"(diameter )(\S+)", times(1.001)),
    "wall-lower": ("mesh", r"(mesh \w+\.stl scale \S+)", r"\1 move 0 0 -1e-7"),
    "coarse-steps": ("step", r"(timestep +)(\S+)", times(4)),
}


def seen_by(job):
    """The rows of a case that see a fault, by their quantities; or why there are none."""
    name, case = job
    _, pattern, replacement = FAULTS[name]
    changed = []

    def change(script):
        script, count = re.subn(pattern, replacement, script)
        changed.append(count)
        return script
    suite.change = change
    suite.CASES[case].walls = (suite.TWO,)
    with tempfile.TemporaryDirectory(prefix="lsdcd-") as folder:
        try:
            rows = suite.run_case(case, pathlib.Path(folder))
        except Exception as error:    # a script that ends with an error, or a quantity that cannot be computed
            return case, sum(changed), [f"{type(error).__name__}"], 0
    return case, sum(changed), [r.quantity for r in rows if not r.holds()], len(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("names", nargs="*", metavar="FAULT")
    args = parser.parse_args()
    unseen, quick = [], [name for name, case in CASES.items() if case.takes == suite.SECONDS]
    with concurrent.futures.ProcessPoolExecutor(args.jobs) as pool:
        names = args.names or list(FAULTS)
        found = pool.map(seen_by, [(name, case) for name in names for case in quick])
        for name in names:
            its = [next(found) for _ in quick]
            told = [f"{case} {len(out)} of {count}" if count else f"{case}: {out[0]}" for case, changes, out, count in its if changes and out]
            blind = [case for case, changes, out, _ in its if changes and not out]
            print(f"{FAULTS[name][0]:10} {name:22} " + ("; ".join(told) or "NOT SEEN") + (f" (not by {', '.join(blind)})" if blind else ""), flush=True)
            if not told:
                unseen.append(name)
    print(f"{len(names) - len(unseen)} of {len(names)} faults are seen" + (f"; not {', '.join(unseen)}" if unseen else ""))
    return 1 if unseen else 0


if __name__ == "__main__":
    sys.exit(main())
