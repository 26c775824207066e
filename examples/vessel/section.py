#!/usr/bin/env python3
"""Draw the section that in.vessel ends with: section.py section.dump vessel.stl vessel.png

For a LAMMPS without `dump image`, such as Debian's own of 4 Jul 2026. Every pixel keeps what is
nearest to the viewer; standard library only.
"""
import math
import pathlib
import struct
import sys
import zlib

WIDTH, HEIGHT, PIXEL = 620, 1000, 2.925e-4   # pixels, metres
CENTRE = (0.0, 0.0, 0.055)                  # of the deck's box
TILT = math.radians(78)                     # `view 78 -90`: from in front and a little above
SIN, COS = math.sin(TILT), math.cos(TILT)
LIGHT = tuple(c / math.sqrt(1.5) for c in (-0.5, 0.5, 1.0))    # right, up, towards the viewer
SILVER = (192, 192, 192)
GRAINS = {2: (178, 34, 34), 3: (255, 165, 0), 4: (255, 215, 0), 5: (46, 139, 87),
          6: (70, 130, 180), 7: (128, 0, 128)}

nearest = [-math.inf] * (WIDTH * HEIGHT)
picture = bytearray(b"\xff" * (3 * WIDTH * HEIGHT))


def on_screen(p):
    """Pixels to the right and down, and metres towards the viewer."""
    x, y, z = (p[k] - CENTRE[k] for k in range(3))
    return WIDTH / 2 + x / PIXEL, HEIGHT / 2 - (y * COS + z * SIN) / PIXEL, z * COS - y * SIN


def paint(column, row, depth, colour, normal):
    """One pixel, unless something nearer is there; the normal is the screen's, of either side."""
    at = row * WIDTH + column
    if depth <= nearest[at]:
        return
    nearest[at] = depth
    lit = sum(a * b for a, b in zip(normal, LIGHT))
    share = 0.25 + 0.75 * max(0.0, lit if normal[2] > 0 else -lit)
    picture[3 * at:3 * at + 3] = bytes(int(c * share) for c in colour)


def columns(lo, hi):
    return range(max(0, math.ceil(lo)), min(WIDTH - 1, math.floor(hi)) + 1)


def rows(lo, hi):
    return range(max(0, math.ceil(lo)), min(HEIGHT - 1, math.floor(hi)) + 1)


def draw_sphere(centre, radius, colour):
    x, y, depth = on_screen(centre)
    size = radius / PIXEL
    for row in rows(y - size, y + size):
        up = (y - row) / size
        half = size * math.sqrt(max(0.0, 1 - up * up))
        for column in columns(x - half, x + half):
            right = (column - x) / size
            out = math.sqrt(max(0.0, 1 - up * up - right * right))
            paint(column, row, depth + radius * out, colour, (right, up, out))


def draw_triangle(corners, colour):
    a, b, c = (on_screen(p) for p in corners)
    u, v = ([q[k] - a[k] for k in range(3)] for q in (b, c))
    twice = u[0] * v[1] - u[1] * v[0]
    if twice == 0:    # seen from its edge
        return
    slope = [(u[2] * v[1] - u[1] * v[2]) / twice, (u[0] * v[2] - u[2] * v[0]) / twice]
    normal = (-slope[0] / PIXEL, slope[1] / PIXEL, 1.0)
    size = math.hypot(*normal)
    normal = tuple(n / size for n in normal)
    for row in rows(min(a[1], b[1], c[1]), max(a[1], b[1], c[1])):
        # Where the row crosses the edges.
        cuts = [p[0] + (row - p[1]) * (q[0] - p[0]) / (q[1] - p[1])
                for p, q in ((a, b), (b, c), (c, a)) if min(p[1], q[1]) <= row <= max(p[1], q[1]) and p[1] != q[1]]
        for column in columns(min(cuts), max(cuts)) if cuts else ():
            depth = a[2] + (column - a[0]) * slope[0] + (row - a[1]) * slope[1]
            paint(column, row, depth, colour, normal)


def read_stl(path, scale):
    data = pathlib.Path(path).read_bytes()
    for facet in struct.iter_unpack("<12fH", data[84:]):
        yield [[scale * x for x in facet[k:k + 3]] for k in (3, 6, 9)]


def write_png(path):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    lines = b"".join(b"\0" + picture[3 * WIDTH * row:3 * WIDTH * (row + 1)] for row in range(HEIGHT))
    pathlib.Path(path).write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)) +
        chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b""))


def main():
    dump, mesh, png = sys.argv[1:]
    for line in pathlib.Path(dump).read_text().split("ITEM: ATOMS")[1].splitlines()[1:]:
        _, kind, *numbers = line.split()
        x, y, z, radius = map(float, numbers)
        draw_sphere((x, y, z), radius, GRAINS[int(kind)])
    for corners in read_stl(mesh, 0.001):
        if sum(p[1] for p in corners) > 0:    # the half behind the section
            draw_triangle(corners, SILVER)
    write_png(png)


if __name__ == "__main__":
    main()
