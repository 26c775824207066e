# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""lsdcd generate writes shapes that lsdcd inspect calls clean, closed where they are, with areas and
volumes of closed forms."""
import math

import stl
from command import refused, run, told
from facts import fact

# Corners are floats, each off by 2^-24 of itself; a volume or an area, of the third or second degree in
# them, by some three times as much, and cancellation in sums over a shape of size 1 costs no more than
# its surface times 2^-24: 1e-6 has room for both.
ROUNDING = 1e-6


def circle(radius, n):
    """Area of the polygon."""
    return n / 2 * math.sin(2 * math.pi / n) * radius**2


def frustum_side(r, top, height, n):
    slant = math.hypot(height, (r - top) * math.cos(math.pi / n))
    return n * (r + top) * math.sin(math.pi / n) * slant


def drum_end(radius, lifters, height, width, n):
    """Polygons from the axis: of each gap's arc, and of each lifter's feet without its bar."""
    half = math.asin(width / 2 / radius)
    gap = 2 * math.pi / lifters - 2 * half
    pieces = max(2, round(n * gap / (2 * math.pi)))
    foot = radius * math.cos(half)
    bar = (foot - (radius - height)) * width
    return lifters * (pieces / 2 * radius**2 * math.sin(gap / pieces) + width * foot / 2 - bar)


def close(a, b, within=ROUNDING):
    return abs(a - b) <= within * abs(b)


def screw_volume_bounds(radius, shaft, pitch, turns, thickness, n):
    """Blade and shaft, and what the diagonals of the blade's skew faces can make of it: no more than
    the tetrahedron of a face's four corners for each."""
    length = 2 * pitch / 10 + turns * pitch + thickness
    turn, rise = 2 * math.pi / n, pitch / n
    a, b = (0, 0, shaft), (shaft * math.sin(turn), rise, shaft * math.cos(turn))
    c, d = (0, 0, radius), (radius * math.sin(turn), rise, radius * math.cos(turn))
    u, v, w = ([q[k] - a[k] for k in range(3)] for q in (b, c, d))
    skew = abs(u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2])
               + u[2] * (v[0] * w[1] - v[1] * w[0])) / 6
    volume = circle(shaft, n) * length + turns * thickness * (circle(radius, n) - circle(shaft, n))
    return volume, turns * n * skew * 2


# Words, --edge, and how many times the equal triangles that would fill the area there may be. Circles have 64 sides, so
# triangles are narrow beside an outlet and on a shaft.
ECONOMY = [("plane --width 0.2 --depth 0.1", 0.01, 1.2), ("box --width 0.2 --depth 0.1 --height 0.3", 0.02, 2.1),
           ("cylinder --radius 60 --height 120", 8, 1.5), ("cylinder --radius 1 --height 2 --segments 6", 0.1, 2.1),
           ("cone --radius 60 --height 120", 8, 2.3), ("hopper --radius 60 --height 120 --cone 60 --outlet 12", 8, 1.5),
           ("hopper --radius 60 --height 120 --outlet 12", 8, 1.5),
           ("vessel --radius 50 --height 100 --cone 50 --outlet 15 --tube 30 --knuckle 12", 6, 1.8),
           ("drum --radius 0.5 --length 0.3 --lifters 8 --segments 64", 0.05, 2),
           ("drum --radius 0.5 --length 0.3 --lifters 8 --closed", 0.05, 2.5), ("drum --radius 0.5 --length 0.3", 0.05, 1.2),
           ("screw --radius 0.06 --shaft 0.015 --pitch 0.1 --turns 3 --thickness 0.004", 0.01, 5.6)]


def check_economy(folder):
    """Edges are near the limit, not a small part of it."""
    for words, edge, times in ECONOMY:
        mesh = told(folder, "generate", *words.split(), "--edge", edge, "-o", "even.stl")
        ideal = mesh["area"] / (math.sqrt(3) / 4 * edge**2)
        fact(f"few triangles: {words} --edge {edge}", mesh["facets"] <= times * ideal and mesh["largest_edge"] <= edge * (1 + ROUNDING),
             (mesh["facets"], ideal))
    # The sides of the outlet's circle are the shortest edges of the hopper with a cone.
    words, edge, _ = ECONOMY[5]
    mesh = told(folder, "generate", *words.split(), "--edge", edge, "-o", "even.stl")
    fact("no edge of a hopper is shorter than those of its outlet",
         mesh["smallest_edge"] >= 2 * 12 * math.sin(math.pi / 64) * (1 - ROUNDING), mesh["smallest_edge"])
    # Columns, rows and discs of few and odd sides, wide and narrow.
    for words in ("cylinder --radius 1 --height 1.3", "cone --radius 1 --height 1.3", "cone --radius 1 --top 0.3 --height 1.3"):
        for segments in (3, 5, 24, 25):
            for edge in (0.06, 0.27, 1.2):
                mesh = told(folder, "generate", *words.split(), "--segments", segments, "--edge", edge, "-o", "even.stl")
                top = {"cylinder": 1, "cone": 0.3 if "--top" in words else 0}[words.split()[0]]
                volume = circle(1, segments) * 1.3 / 3 * (1 + top + top**2)
                fact(f"closed: {words} --segments {segments} --edge {edge}", mesh["clean"] and mesh["closed"]
                     and mesh["largest_edge"] <= edge * (1 + ROUNDING) and close(mesh["volume"], volume),
                     (mesh["problems"], mesh["volume"], volume))


def test_generate(folder):
    end_area = drum_end(1, 5, 0.2, 0.1, 96)
    shapes = {    # words, closed, area, volume
        "plane": ("--width 2 --depth 3", False, 6, None),
        "box": ("--width 1 --depth 2 --height 3", True, 22, 6),
        "cylinder": ("--radius 1 --height 2 --segments 50", True,
                     2 * circle(1, 50) + frustum_side(1, 1, 2, 50), 2 * circle(1, 50)),
        "cylinder ": ("--radius 1 --height 2 --segments 50 --open", False, frustum_side(1, 1, 2, 50), None),
        "cone": ("--radius 1 --height 2", True, circle(1, 64) + frustum_side(1, 0, 2, 64),
                 circle(1, 64) * 2 / 3),
        "cone ": ("--radius 1 --top 2 --height 2 --segments 7", True,
                  circle(1, 7) + circle(2, 7) + frustum_side(1, 2, 2, 7), circle(1, 7) * 2 / 3 * 7),
        "hopper": ("--radius 1 --height 3 --cone 0.8 --outlet 0.3", False,
                   frustum_side(1, 1, 3, 64) + frustum_side(1, 0.3, 0.8, 64), None),
        "hopper ": ("--radius 1 --height 3 --outlet 0.3", False,
                    frustum_side(1, 1, 3, 64) + circle(1, 64) - circle(0.3, 64), None),
        "vessel": ("--radius 1 --height 2 --cone 1 --outlet 0.3 --tube 0.6", False,
                   frustum_side(1, 1, 2, 64) + frustum_side(1, 0.3, 1, 64)
                   + frustum_side(0.3, 0.3, 0.6, 64), None),
        "vessel ": ("--radius 1 --height 2 --cone 1 --outlet 0.3 --tube 0.6 --knuckle 0.2", False, None, None),
        "drum": ("--radius 1 --length 2 --lifters 5 --height 0.2 --thickness 0.1 --segments 96 --closed",
                 True, None, 2 * end_area),
        "drum ": ("--radius 1 --length 2 --lifters 5", False, None, None),
        "drum  ": ("--radius 1 --length 2 --closed --segments 40", True, None, 2 * circle(1, 40)),
        "drum   ": ("--radius 1 --length 2 --lifters 2 --closed", True, None, None),
    }
    for name, (words, closed, area, volume) in shapes.items():
        for edge in ("", " --edge 0.2"):
            if edge and "--segments" not in words and name.strip() not in ("plane", "box"):
                words += " --segments 64"    # the same polygon
            file = f"{name.strip()}.stl"
            what = f"{name.strip()} {words}{edge}"
            made = told(folder, "generate", name.strip(), *(words + edge).split(), "-o", file)
            mesh = told(folder, "inspect", file)
            fact(f"clean: {what}", mesh["clean"] and made["clean"], mesh["problems"])
            fact(f"{'closed' if closed else 'open'}: {what}", mesh["closed"] == closed)
            if area:
                fact(f"area: {what}", close(mesh["area"], area), (mesh["area"], area))
            if volume:
                fact(f"volume: {what}", close(mesh["volume"], volume), (mesh["volume"], volume))
            if edge:
                fact(f"no edge above 0.2: {what}", mesh["largest_edge"] <= 0.2 * (1 + ROUNDING),
                     mesh["largest_edge"])
    words = "--radius 1 --shaft 0.3 --pitch 0.8 --turns 3 --thickness 0.1 --segments 40"
    for edge in ("", " --edge 0.1"):
        told(folder, "generate", "screw", *(words + edge).split(), "-o", "screw.stl")
        mesh = told(folder, "inspect", "screw.stl")
        volume, skew = screw_volume_bounds(1, 0.3, 0.8, 3, 0.1, 40)
        fact(f"screw{edge}: clean and closed", mesh["clean"] and mesh["closed"], mesh["problems"])
        fact(f"screw{edge}: volume", abs(mesh["volume"] - volume) <= skew + ROUNDING * volume,
             (mesh["volume"], volume, skew))
    # Right-handed: as the angle from z to x grows, the blade's rim moves along +y.
    told(folder, "generate", "screw", *words.split(), "-o", "screw.stl")
    rim = sorted({(p[1], p[0], p[2]) for t in stl.read(folder / "screw.stl") for p in t
                  if math.hypot(p[0], p[2]) > 0.99})
    y, x, z = rim[0]
    fact("the screw's blade begins at z", abs(x) < 1e-6 and z > 0.99 and close(y, 0.08))
    after = [p for p in rim if abs(math.atan2(p[1], p[2]) - 2 * math.pi / 40) < 1e-3][0]
    fact("and is right-handed", close(after[0], 0.08 + 0.8 / 40), after)

    knuckle = stl.read(folder / "vessel.stl")    # the last one, with knuckles
    centre = (1 - 0.2, None)
    turn = math.atan2(0.7, 1) / 2    # half of the bend from the cone to the cylinder
    centre = (0.8, 1.6 + 0.2 * math.tan(turn))
    on_arc = [p for t in knuckle for p in t
              if 1.6 - 0.2 * math.tan(turn) * math.cos(2 * turn) <= p[2] <= centre[1] + 1e-6 and
              math.hypot(p[0], p[1]) > 0.9]
    # Points of the arc itself, and of its chords where --edge has split them: their sagitta.
    off = max(abs(math.hypot(math.hypot(p[0], p[1]) - centre[0], p[2] - centre[1]) - 0.2) for p in on_arc)
    fact("the knuckle has its radius", 0 < len(on_arc) and off < 0.2 * (1 - math.cos(math.pi / 64)) + 0.01,
         off)

    check_economy(folder)

    done = run(folder, "generate", "box", "--width", 1, "--depth", 2, "--height", 3, "-o", "box.stl")
    fact("people get a table", done.returncode == 0 and "closed, normals point out" in done.stdout
         and "clean       yes" in done.stdout, done.stdout)
    box = "generate box --width 1 --depth 2 -o none.stl".split()
    refused(folder, box, "--height is required", code=2)
    for bad in ("0", "-1", "nan", "inf", "1m"):
        refused(folder, [*box, "--height", bad], "--height", bad, "length", code=2)
    refused(folder, "generate cylinder --radius 1 --height 1 --segments 2 -o none.stl".split(),
            "--segments", code=2)
    refused(folder, "generate hopper --radius 1 --height 1 --outlet 2 -o none.stl".split(),
            "--outlet is 2", "--radius, 1")
    refused(folder, "generate screw --radius 1 --shaft .5 --pitch 1 --turns 2 --thickness 1 -o a.stl".split(),
            "--thickness is 1", "--pitch")
    refused(folder, "generate drum --radius 1 --length 1 --lifters 9 --thickness .9 -o a.stl".split(),
            "--thickness is 0.9", "lifters")
    refused(folder, ("generate vessel --radius 1 --height 2 --cone 1 --outlet .3 --tube .6 --knuckle 9 "
                     "-o a.stl").split(), "--knuckle 9", "largest")
    refused(folder, "generate plane --width 1 --depth 1e-16 -o a.stl".split(), "a.stl is not written", "--edge")
    refused(folder, "generate plane --width 1 --depth 1 --edge 1e-5 -o a.stl".split(), "--edge", "20 million")
    refused(folder, "generate plane --width 1 --depth 1 -o no/a.stl".split(), "no/a.stl")
    for shape in ("", *(s for s in shapes if s == s.strip()), "screw"):
        done = run(folder, "generate", *shape.split(), "--help")
        example = [l.split() for l in done.stdout.splitlines() if l.startswith("  lsdcd generate")]
        fact(f"--help {shape} has an example that works", len(example) == 1 and
             run(folder, *example[0][1:]).returncode == 0, example)
