#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run examples and draw their pictures into doc/img/gallery: gallery.py [NAME ...]

Each example runs to the moment of its picture and writes its grains and meshes into --work; scene.py draws them. With
--draw-only nothing runs, and what an earlier run has written is drawn. Needs Debian's python3-paraview (or python3-vtk9),
xvfb and python3-pil.
"""
import dataclasses
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import runs

EVERY = 100    # steps: a picture is at a multiple of it, where the meshes are written
WIDTH = 640    # pixels of a picture
TUTORIALS = ("meshGran", "movingMeshGran", "servoWall", "conveyor")    # of from-liggghts
GLASS = {"opacity": 0.22}
BED = [(r"\$\{wall\} \$\{law\} \$\{at\}", "wall/lsdcd ${law} mesh wall.stl")]    # of the scripts that compare walls


@dataclasses.dataclass
class Scene:
    view: tuple           # as that of dump image
    box: tuple            # what is seen: lo and hi of x, y, z
    bar: tuple            # the scale bar: its length, words
    key: object           # of the colours: words and a range for viridis, or colours of the types with their words
    meshes: list          # how each is drawn, in the order of the script; None: not at all
    time: str = "t = {:.0f} √(d/g)"
    unit: float = 1.0     # of that time
    quantity: str = "speed"    # that viridis shows
    cut: tuple = ()       # a point and a normal: grains behind it are drawn
    frame: tuple = ()     # a box whose edges are drawn
    arrows: list = ()     # lists of points
    script: str = ""      # from examples/, if it is not NAME/in.NAME
    stop: str = ".*write_dump"    # the line of the script that is the moment of the picture; "": its end
    edits: list = ()      # of the script: what, with what
    group: str = "all"    # of the atoms that are drawn
    make: tuple = ()      # a script in its folder, or lsdcd, that writes what it needs into --work, and its words


def circle(centre, radius, first, last, y=0.0):
    """Points about an axis along y, from one angle to another in degrees, counted from z towards x."""
    count = 24
    angles = [math.radians(first + (last - first) * k / count) for k in range(count + 1)]
    return [(centre[0] + radius * math.sin(a), y, centre[1] + radius * math.cos(a)) for a in angles]


def scenes():
    from scene import BLUE, DARK, ORANGE, SKY, VERMILION
    glass, solid = dict(GLASS), {}
    five = (5, "5 diameters d")
    return {
        "drum": Scene((90, -90), (-11, 11, 0, 5, -11, 11.8), five, ("√(g d), speed", 0, 5), [solid],
                      arrows=[circle((0, 0), 11, -35, 35)]),
        "first": Scene((80, -65), (-0.101, 0.101, 0, 0.06, -0.101, 0.109), (0.05, "50 mm"), ("m/s, speed", 0, 0.8), [dict(GLASS)],
                       script="tutorial/in.first", stop="", time="t = {:.2f} s", arrows=[circle((0, 0), 0.101, -35, 35)],
                       make=("lsdcd", "generate", "drum", "--radius", "100", "--length", "60", "--lifters", "8", "-o", "drum.stl")),
        "hopper": Scene((75, -80), (-8.5, 12.5, -8.5, 8.5, -8, 20), five,
                        [(ORANGE, ""), (BLUE, "layers of 3 d at the start")],
                        [{"cut": ((0, 0, 0), (0, 1, 0))}, solid], cut=((0, 0, 0), (0, 1, 0))),
        "screw": Scene((65, -20), (-7, 7, 0, 20, -7, 7), five, [(ORANGE, ""), (BLUE, "halves along the tube, 4 turns ago")],
                       [glass, solid]),
        "screen": Scene((115, -65), (-7, 7, -7, 7, -5, 9), (5, "5 apertures a"),
                        [(ORANGE, "0.6 a"), (SKY, "0.8 a"), (BLUE, "0.95 a"), (VERMILION, "1.1 a: too large")],
                        [glass, solid], time="t = {:.0f} √(a/g)"),
        "mixer": Scene((50, -90), (-11.5, 11.5, 0, 6, -6.5, 7), five, [(ORANGE, "left and"), (BLUE, "right after the first turn")],
                       [glass, solid, solid], arrows=[circle((-5, 0), 5.2, -35, 35), circle((5, 0), 5.2, 35, -35)]),
        "piston": Scene((60, -90), (-7.5, 7.5, -7.5, 7.5, -0.5, 14), five, ("d, size", 0.8, 1.1), [glass, solid],
                        quantity="diameter"),
        "flap": Scene((80, -80), (-10.5, 12, 0, 6, -6, 14), five, ("√(g d), speed", 0, 6), [glass, solid]),
        "paddle": Scene((80, -80), (-7, 7, 0, 6, -7, 7), five, ("√(g d), speed", 0, 8), [glass, solid]),
        "lid": Scene((80, -80), (-6.5, 6.5, 0, 6, 0, 9), five, ("d, height", 0, 5), [glass, solid], quantity="z"),
        "wheel": Scene((80, -80), (14, 48, 0, 6, 0, 16), five, ("√(g d), speed", 0, 2), [glass, solid],
                       arrows=[[(41.5, 0, 13.5), (47.5, 0, 13.5)]]),
        "insertion": Scene((75, -60), (-9, 9, -9, 9, -7, 9), five, ("√(g d), speed; the wrong way", 0, 5), [solid]),
        "clumps": Scene((75, 20), (-15, 15, -15, 15, -1, 14), five, "clumps of 3 spheres; 4 colours", [solid, glass]),
        "belt": Scene((75, -75), (-1, 46, -6, 6, -16, 8), (10, "10 diameters d"), ("√(g d), speed", 0, 5),
                      [{"colour": DARK}, glass], arrows=[[(10, -5.5, -1.5), (20, -5.5, -1.5)]]),
        "sagging-belt": Scene((60, -75), (-21, 25, -5, 5, -6, 7), five, ("√(g d), speed", 0, 3), [{"colour": DARK}, solid],
                              group="grains", arrows=[[(-4, -6, -4), (6, -6, -4)]]),
        "triaxial": Scene((80, -70), (-8, 8, -8, 8, -0.5, 16.5), five, [(ORANGE, ""), (BLUE, "layers of 3 d at the start")],
                          [{"opacity": 0.35}, {"shift": (0, 0, -0.1)}, {"shift": (0, 0, 0.1)}], group="grains", stop='print +"triaxial', quantity="type", time="t = {:.0f} d √(ρ/p)"),
        "feed": Scene((75, -75), (-5, 5, -5, 5, -1, 9), (2, "2 diameters d"), [(BLUE, "0.7 d"), (ORANGE, "d")], [glass],
                      quantity="diameter", stop='print +"feed'),
        "filling": Scene((70, -60), (-6, 6, -1, 9, -6, 6), (2, "2 diameters d"), ("√(g d), speed", 0, 4), [glass],
                         stop='print +"grains'),
        "meshGran": Scene((80, -70), (-0.1, 0.45, 0, 0.12, 0, 0.75), (0.1, "100 mm"), ("m/s, speed", 0, 1.6), [glass],
                          time="t = {:.2f} s"),
        "movingMeshGran": Scene((75, -80), (-0.4, 0.4, -0.15, 0.15, 0, 0.6), (0.2, "200 mm"), ("m, height", 0, 0.5), [glass],
                                quantity="z", frame=(-0.4, 0.4, -0.15, 0.15, 0, 0.6), time="t = {:.2f} s"),
        # The plate is drawn 0.3 mm higher, since the soft grains reach so far through it.
        "servoWall": Scene((70, -75), (0, 0.06, 0, 0.06, 0, 0.08), (0.02, "20 mm"), [(ORANGE, "27 grains under 30 N")],
                           [glass, {"colour": DARK, "shift": (0, 0, 3e-4)}], time="t = {:.2f} s"),
        "conveyor": Scene((75, -80), (-0.95, 0.52, -0.15, 0.15, -0.5, 0.22), (0.2, "200 mm"), ("m/s, speed", 0, 2),
                          [glass, glass], time="t = {:.2f} s", arrows=[[(0.2, -0.16, -0.05), (-0.1, -0.16, -0.05)]]),
        "feeder": Scene((70, -30), (-2, 2, -0.5, 16.5, -2, 2), (2, "2 lengths"), [(ORANGE, "49 grains of 0.3 to 0.5 lengths")], [glass, solid],
                        script="from-gransurf/in.feeder", stop='print +"feeder', make=("make_feeder.py", "--out", "."),
                        time="{:.1f} turns of the screw", unit=1000),
        "flat": Scene((75, -75), (-0.0185, 0.0185, -0.0185, 0.0185, -0.001, 0.026), (0.01, "10 mm"), ("mm, height", 0, 22),
                      [glass], script="flat/in.bed", stop="", quantity="z", edits=BED, time="t = {:.2f} s",
                      make=("make_floor.py", "wall.stl", "--side", "0.034", "--cells", "100")),
        "cylinder": Scene((70, -75), (-0.021, 0.021, -0.021, 0.021, -0.001, 0.04), (0.01, "10 mm"), ("mm, height", 0, 21),
                          [glass], script="cylinder/in.bed", stop="", quantity="z", edits=BED, time="t = {:.2f} s",
                          make=("make_cylinder.py", "wall.stl")),
    }


def state_script(text, name, scene):
    """The script up to the moment of the picture, where it writes the grains; its meshes are written on the way."""
    for what, other in scene.edits:
        text, count = re.subn(what, other, text)
        if not count:
            raise SystemExit(f"{name}: the script has no '{what}'")
    lines, meshes = [], 0

    def written(match):
        nonlocal meshes
        meshes += 1
        return f"{match[0]} mesh_stl {name}_{meshes}.stl every {EVERY}"

    for line in re.sub(r"&\s*\n\s*", " ", text).split("\n") + [""]:
        if re.match(scene.stop or "$", line) and (scene.stop or "run             ${steps}" in lines):
            return "\n".join(lines + [f"run $({EVERY}-step%{EVERY})",
                                      f"write_dump {scene.group} custom {name}.atoms id type x y z radius vx vy vz",
                                      f'print "$(time)" file {name}.time', "quit", ""])
        if re.match(r"[^#]*\bwall/lsdcd\b", line):
            line = re.sub(r"\bmesh \S+\.stl", written, line)
        lines.append(line)
    raise SystemExit(f"{name}: the script has no line '{scene.stop}'")


def run(a, name, scene):
    folder = "from-liggghts" if name in TUTORIALS else name
    original = runs.ROOT / "examples" / (scene.script or f"{folder}/in.{name}")
    example = original.parent
    if name in TUTORIALS:
        runs.make_meshes(example / "make_meshes.py", a.work)
    elif scene.make[:1] == ("lsdcd",):
        subprocess.run([Path(a.lmp).resolve().parent / "lsdcd", *scene.make[1:]], cwd=a.work, check=True, stdout=subprocess.DEVNULL)
    elif scene.make:
        subprocess.run([sys.executable, example / scene.make[0], *scene.make[1:]], cwd=a.work, check=True)
    script = a.work / f"in.{name}"
    script.write_text(state_script(original.read_text(), name, scene))
    command = [Path(a.lmp).resolve(), "-in", script.name, "-log", "none", "-var", "dir", example]
    with runs.environment() as env:
        done = subprocess.run(command, cwd=a.work, env=env, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              stdin=subprocess.DEVNULL)
    if done.returncode:
        raise SystemExit(done.stdout[-2000:])


def draw(a, name, scene):
    import numpy as np

    import scene as vtk
    atoms = vtk.read_atoms(a.work / f"{name}.atoms")
    centres = np.stack([atoms["x"], atoms["y"], atoms["z"]], axis=1)
    shown = np.ones(len(centres), bool)
    if scene.cut:
        shown = (centres - scene.cut[0]) @ np.array(scene.cut[1]) > 0
    low, high = np.reshape(scene.box, (3, 2)).T
    shown &= ((centres > low) & (centres < high)).all(axis=1)
    if isinstance(scene.key, tuple):
        of = {"speed": np.sqrt(atoms["vx"] ** 2 + atoms["vy"] ** 2 + atoms["vz"] ** 2), "diameter": 2 * atoms["radius"],
              "z": atoms["z"] * (1000 if "mm" in scene.key[0] else 1)}[scene.quantity]
        _, least, most = scene.key
        colours = vtk.viridis((of - least) / (most - least))
    else:
        palette = [c for c, _ in scene.key] if isinstance(scene.key, list) else [vtk.ORANGE, vtk.BLUE, vtk.SKY, vtk.GREEN]
        kinds = atoms["type"].astype(int) - 1
        if scene.quantity == "diameter":
            kinds = np.unique(atoms["radius"].round(6), return_inverse=True)[1]
        colours = np.array([vtk.rgb(palette[kind % len(palette)]) for kind in kinds])
    actors = vtk.spheres(centres[shown], atoms["radius"][shown], colours[shown])
    for k, look in enumerate(scene.meshes, 1):
        if look is not None:
            actors += vtk.mesh(a.work / f"{name}_{k}.stl", **look)
    if scene.frame:
        actors += vtk.frame(scene.frame)
    camera = vtk.Camera(scene.view, scene.box, WIDTH)
    picture = camera.draw(actors)
    for points in scene.arrows:
        vtk.arrow(picture, camera, points)
    time = scene.time.format(float((a.work / f"{name}.time").read_text()) / scene.unit)
    return vtk.below(picture, camera.scale, scene.bar, time, scene.key)


def main():
    p = runs.options(__doc__, Path("gallery"))
    p.add_argument("--draw-only", action="store_true", help="draw what is in --work")
    p.add_argument("names", nargs="*")
    a = p.parse_args()
    if not os.environ.get("DISPLAY") and not shutil.which("xvfb-run"):
        raise SystemExit("VTK needs a display: install xvfb")
    if not os.environ.get("DISPLAY"):
        os.execvp("xvfb-run", ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset", sys.executable, *sys.argv])
    a.work.mkdir(parents=True, exist_ok=True)
    known = scenes()
    folder = runs.ROOT / "doc" / "img" / "gallery"
    for name in a.names or known:
        if not a.draw_only:
            run(a, name, known[name])
        draw(a, name, known[name]).quantize(256, kmeans=2).save(folder / f"{name}.png", optimize=True)
        print(folder / f"{name}.png", flush=True)


if __name__ == "__main__":
    main()
