#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Draw triaxial.txt, which in.triaxial has written: deviator and change of volume against the strain, as curve.png."""
import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs    # noqa: E402


def main():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("--file", type=Path, default=Path("triaxial.txt"))
    p.add_argument("--out", type=Path, default=Path("curve.png"))
    a = p.parse_args()
    rows = [[float(w) for w in line.split()] for line in a.file.read_text().splitlines() if not line.startswith("#")]
    _, strain, axial, radial, volume = zip(*rows)
    with runs.plot(a.out, "axial strain, %", "of the pressure") as axes:
        axes.plot([100 * e for e in strain], [one - other for one, other in zip(axial, radial)], label="axial less radial stress")
        axes.plot([100 * e for e in strain], radial, label="radial stress")
        axes.plot([100 * e for e in strain], [-10 * v for v in volume], label="10 times the increase of the volume")
        axes.set_ylim(bottom=-0.1)
        axes.legend(fontsize=8)


if __name__ == "__main__":
    main()
