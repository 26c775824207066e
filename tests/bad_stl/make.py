#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Writes the twelve damaged STL files of this folder; each has one fault.

test_bad_stl.cpp has a row for each: what the message must say.
"""
import pathlib
import struct

HERE = pathlib.Path(__file__).parent
A, B, C, D = "0 0 0", "1 0 0", "0 1 0", "0 0 1"


def facet(*vertices):
    lines = ["  facet normal 0 0 0", "    outer loop"]
    lines += [f"      vertex {v}" for v in vertices]
    return "\n".join(lines + ["    endloop", "  endfacet", ""])


def solid(*facets):
    return "solid bad\n" + "".join(facets) + "endsolid bad\n"


def record(*numbers):
    return struct.pack("<12fH", 0, 0, 0, *numbers, 0)


def binary(count, *records):
    return b"solid, says the header".ljust(80) + struct.pack("<I", count) + b"".join(records)


GOOD = facet(A, B, C)
RECORD = record(0, 0, 0, 1, 0, 0, 0, 1, 0)
TEXT = {
    "ascii_truncated": solid(GOOD, GOOD)[:-60],
    "ascii_not_a_number": solid(GOOD, facet(A, "1 zero 0", D)),
    "ascii_decimal_comma": solid(facet(A, "1,5 0 0", D)),
    "ascii_not_finite": solid(GOOD, facet(A, B, "0 0 1e999")),
    "ascii_missing_coordinate": solid(facet("0 0", B, C)),
    "ascii_two_vertices": solid(GOOD, facet(A, B)),
    "ascii_four_vertices": solid(facet(A, B, C, D)),
    "ascii_no_facets": solid(),
    "not_an_stl": "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
}
BINARY = {
    "binary_truncated": binary(3, RECORD, RECORD[:20]),
    "binary_count_too_small": binary(1, RECORD, RECORD),
    "binary_not_finite": binary(2, RECORD, record(0, 0, 0, 1, 0, 0, 0, float("nan"), 0)),
}

for name, text in TEXT.items():
    (HERE / f"{name}.stl").write_bytes(text.encode())
for name, data in BINARY.items():
    (HERE / f"{name}.stl").write_bytes(data)
