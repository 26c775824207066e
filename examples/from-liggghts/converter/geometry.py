# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Vectors and triangles."""
import math
import re
import struct

from .errors import CannotConvert


def is_binary_stl(data):
    return len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]


def read_stl(data):
    """Triangles of the bytes of a text or binary STL file."""
    if is_binary_stl(data):
        rows = (struct.unpack_from("<9f", data, 84 + 50 * k + 12) for k in range((len(data) - 84) // 50))
        return [(r[:3], r[3:6], r[6:]) for r in rows]
    points = [tuple(map(float, p)) for p in re.findall(r"vertex\s+(\S+)\s+(\S+)\s+(\S+)", data.decode(errors="replace"))]
    return list(zip(points[::3], points[1::3], points[2::3]))


def without_facets(data, numbers):
    """The bytes of an STL file without the facets that a list of LIGGGHTS names, and how many these are: by the lines of `facet` in
    text, by the records in binary. Both are passed once, in order: behind a number that names no facet no other is found."""
    waiting, kept, facet, out = sorted(set(numbers)), [], [], 0
    if is_binary_stl(data):
        records = [data[k:k + 50] for k in range(84, len(data), 50)]
        for count, record in enumerate(records, 1):
            if waiting[:1] == [count]:
                waiting.pop(0)
            else:
                kept.append(record)
        return data[:80] + struct.pack("<I", len(kept)) + b"".join(kept), len(records) - len(kept)
    first = 0
    for number, line in enumerate(data.splitlines(keepends=True), 1):
        word = line.split()[:1]
        if word == [b"facet"]:
            first = number
        if not first:
            kept.append(line)
            continue
        facet.append(line)
        if word == [b"endfacet"]:
            if waiting[:1] == [first]:
                waiting.pop(0)
                out += 1
            else:
                kept += facet
            first, facet = 0, []
    return b"".join(kept + facet), out


def cross(a, b):
    return tuple(a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3] for k in range(3))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def unit(a):
    size = math.sqrt(dot(a, a))
    if size == 0:
        raise CannotConvert("an axis has length 0")
    return tuple(x / size for x in a)


def turned(p, axis, degrees):
    """Rodrigues' formula."""
    t = math.radians(degrees)
    n, c = cross(axis, p), dot(axis, p) * (1 - math.cos(t))
    return tuple(x * math.cos(t) + y * math.sin(t) + z * c for x, y, z in zip(p, n, axis))


def short(x):
    return f"{x:.10g}"
