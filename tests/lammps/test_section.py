#!/usr/bin/env python3
"""What examples/vessel/section.py draws is what LAMMPS draws of the same grains and wall."""

import pathlib
import subprocess
import sys
import zlib

import deck

VESSEL = deck.HERE.parent.parent / "examples" / "vessel"


def read_ppm(path):
    kind, width, height, _, data = path.read_bytes().split(None, 4)
    assert kind == b"P6"
    return int(width), int(height), data


def read_png(path):
    """Of section.py, which writes one IDAT of 8-bit RGB rows without filters."""
    data, at, body = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
        if kind == b"IHDR":
            width, height = (int.from_bytes(data[at + k:at + k + 4], "big") for k in (8, 12))
        if kind == b"IDAT":
            body += data[at + 8:at + 8 + size]
        at += size + 12
    rows = zlib.decompress(body)
    step = 3 * width + 1
    return width, height, b"".join(rows[r * step + 1:(r + 1) * step] for r in range(height))


def hue(r, g, b):
    """What is seen: the background, grey of the wall, or the colour of a layer of grains."""
    most, least = max(r, g, b), min(r, g, b)
    if least > 245:
        return "white"
    if most - least < 0.12 * most + 8:
        return "grey"
    angle = ((g - b) if most == r else 2 * most - 2 * least + (b - r) if most == g else
             4 * (most - least) + (r - g)) / (most - least) * 60 % 360
    return min({"red": 0, "orange": 38.8, "gold": 50.6, "green": 146, "blue": 207, "purple": 300,
                "red ": 360}.items(), key=lambda one: abs(one[1] - angle))[0].strip()


def main():
    checks, folder = deck.Checks(), deck.scratch()
    # The vessel a fifth full, once for LAMMPS and once for the script.
    text = (VESSEL / "in.vessel").read_text()
    image = text[text.index("write_dump      all image"):]
    small = {"dir": VESSEL, "fill": 1500, "quiet": 1, "measure": 1, "drain": 100}
    both = text.replace(image, "").replace('if              "${png}', image.replace(
        "vessel.png", "host.ppm") + 'if              "${png}')
    deck.run_well(both, folder, png=0, **small)
    checks.fact("without dump image the deck leaves grains", (folder / "section.dump").exists())
    done = subprocess.run([sys.executable, VESSEL / "section.py", "section.dump",
                           VESSEL / "vessel.stl", "vessel.png"], cwd=folder)
    checks.fact("section.py draws", done.returncode == 0)

    host, own = read_ppm(folder / "host.ppm"), read_png(folder / "vessel.png")
    checks.fact("same size", host[:2] == own[:2], f"{host[:2]} and {own[:2]}")
    counts = {}
    for k in range(0, len(host[2]), 3):
        pair = hue(*host[2][k:k + 3]), hue(*own[2][k:k + 3])
        counts[pair] = counts.get(pair, 0) + 1
    total = sum(counts.values())
    # LAMMPS leaves pixels between its triangles white, and its light is another.
    apart = sum(n for (a, b), n in counts.items() if (a == "white") != (b == "white")) / total
    checks.at_most("background and the rest", apart, 0.03)
    for colour in ("white", "grey", "red", "orange", "gold", "green", "blue", "purple"):
        there = sum(n for (a, _), n in counts.items() if a == colour)
        same = counts.get((colour, colour), 0)
        checks.fact(f"{colour} where LAMMPS has it", there and same > 0.85 * there, f"{same} of {there} pixels")
    checks.done(folder)


if __name__ == "__main__":
    main()
