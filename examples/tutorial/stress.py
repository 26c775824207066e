#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Are the facets of a mesh large enough for a picture of its stress?

    stress.py FILE.vtp ... [--below Z]

For each file of `mesh_fields`: facets, the share of them that no grain has touched, the median of the others' normal stress, and the
largest. --below counts facets whose corners are all below that height only.
"""
import argparse
import array
import base64
import pathlib
import re
import statistics

KINDS = {"Float64": "d", "Int64": "q", "Int32": "i"}


def read_vtp(path):
    """Arrays by name: base64 after the size in 8 bytes."""
    fields = re.findall(r'<DataArray type="(Float64|Int64|Int32)" Name="(\w+)"[^>]*>([^<]*)<', path.read_text())
    return {name: array.array(KINDS[kind], base64.b64decode(text)[8:]) for kind, name, text in fields}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    parser.add_argument("--below", type=float, default=float("inf"), metavar="Z")
    given = parser.parse_args()
    for path in given.files:
        if not path.is_file():
            there = sorted(other.name for other in path.parent.glob("*.vtp"))
            parser.error(f"{path} is not there" + (f"; {path.parent} has {', '.join(there)}" if there else ""))
        fields = read_vtp(path)
        if "normal_stress" not in fields:
            parser.error(f"{path} has no normal_stress: it is no file of mesh_fields")
        heights = fields["points"][2::3]
        corners = fields["connectivity"]
        low = [max(heights[corner] for corner in corners[3 * k:3 * k + 3]) < given.below for k in range(len(corners) // 3)]
        stress = [value for value, counts in zip(fields["normal_stress"], low) if counts]
        touched = [value for value in stress if value > 0]
        if not touched:
            print(f"{path.name}: " + (f"{len(stress)} facets, all untouched" if stress else f"no facet below {given.below}"))
            continue
        print(f"{path.name}: {len(stress)} facets, {100 * (1 - len(touched) / len(stress)):.0f} % untouched, "
              f"median {statistics.median(touched):.0f} Pa, largest {max(touched):.0f} Pa")


if __name__ == "__main__":
    main()
