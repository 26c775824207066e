#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Run examples and draw their pictures into doc/img/gallery: gallery.py [NAME ...]

Each example runs to the moment of its picture and writes its grains and meshes into --work; scene.py draws them. With
--draw-only nothing runs, and what an earlier run has written is drawn. rice, tablet and rice-drum are drawn where they are named: they
need --lmp, a LAMMPS with superellipsoids, which finds the plugin by LAMMPS_PLUGIN_PATH. Needs Debian's python3-paraview (or python3-vtk9),
xvfb and python3-pil.
"""
import dataclasses
import math
import os
import re
import resource
import shutil
import subprocess
import sys
from pathlib import Path

import runs

EVERY = 100    # steps: a picture is at a multiple of it, where the meshes are written
WIDTH = 640    # pixels of a picture
GLASS = {"opacity": 0.22}
GRAVITY = 9.81


@dataclasses.dataclass
class Scene:
    view: tuple           # as that of dump image
    box: tuple            # what is seen: lo and hi of x, y, z
    bar: tuple            # the scale bar: its length, words
    key: object           # of the colours: words and a range of the speed, or colours of the types with their words
    meshes: list          # how each is drawn, in the order of the script
    d: float = 0.01       # what the script's length stands for, m, where gravity is 1; 0: the script is in SI units
    of_size: bool = False    # colours are those of sizes and not of types
    cut: tuple = ()       # a point and a normal: grains behind it are drawn
    arrows: list = ()     # lists of points
    script: str = ""      # from examples/, if it is not NAME/in.NAME
    stop: str = ".*write_dump"    # the line of the script that is the moment of the picture; "": its end
    group: str = "all"    # of the atoms that are drawn
    words: tuple = ()     # of the command line
    shaped: bool = False  # the grains are superellipsoids: --lmp is a LAMMPS that has them
    make: tuple = ()      # words of lsdcd, which writes what it needs into --work


def circle(centre, radius, first, last, y=0.0):
    """Points about an axis along y, from one angle to another in degrees, counted from z towards x."""
    count = 24
    angles = [math.radians(first + (last - first) * k / count) for k in range(count + 1)]
    return [(centre[0] + radius * math.sin(a), y, centre[1] + radius * math.cos(a)) for a in angles]


def scenes():
    from look import BLUE, DARK, ORANGE, SKY, VERMILION
    glass, solid = dict(GLASS), {}
    five = (5, "50 mm")

    def shaped(grain):
        return Scene((80, -75), (-0.018, 0.028, -0.018, 0.018, -0.0265, 0.024), (0.01, "10 mm"),
                     [(ORANGE, ""), (BLUE, "layers of 5 mm at the start")], [glass, solid, solid], d=0, script="rice/in.rice",
                     stop="variable +flown", words=("-var", "grain", grain), shaped=True)

    return {
        "first": Scene((80, -65), (-0.101, 0.101, 0, 0.06, -0.101, 0.109), (0.05, "50 mm"), ("m/s, speed", 0, 0.8), [glass],
                       d=0, script="tutorial/in.first", stop="", arrows=[circle((0, 0), 0.101, -35, 35)],
                       make=("generate", "drum", "--radius", "100", "--length", "60", "--lifters", "8", "-o", "drum.stl")),
        "drum": Scene((90, -90), (-11, 11, 0, 5, -11, 11.8), five, ("m/s, speed", 0, 1.6), [solid],
                      arrows=[circle((0, 0), 11, -35, 35)]),
        "hopper": Scene((75, -80), (-8.5, 12.5, -8.5, 8.5, -8, 20), five,
                        [(ORANGE, ""), (BLUE, "layers of 30 mm at the start")],
                        [{"cut": ((0, 0, 0), (0, 1, 0))}, solid], cut=((0, 0, 0), (0, 1, 0))),
        "screw": Scene((65, -20), (-7, 7, 0, 20, -7, 7), five, [(ORANGE, ""), (BLUE, "halves along the tube, 4 turns ago")],
                       [glass, solid]),
        "screen": Scene((115, -65), (-7, 7, -7, 7, -5, 9), five,
                        [(ORANGE, "6 mm"), (SKY, "8 mm"), (BLUE, "9.5 mm"), (VERMILION, "11 mm: too large")], [glass, solid]),
        "flap": Scene((80, -80), (-10.5, 12, 0, 6, -6, 14), five, ("m/s, speed", 0, 1.9), [glass, solid]),
        "wheel": Scene((80, -80), (14, 48, 0, 6, 0, 16), five, ("m/s, speed", 0, 0.6), [glass, solid],
                       arrows=[[(41.5, 0, 13.5), (47.5, 0, 13.5)]]),
        "sagging-belt": Scene((60, -75), (-21, 25, -5, 5, -6, 7), five, ("m/s, speed", 0, 0.9), [{"colour": DARK}, solid],
                              group="grains", arrows=[[(-4, -6, -4), (6, -6, -4)]]),
        "feed": Scene((75, -75), (-5, 5, -5, 5, -1, 9), (2, "20 mm"), [(BLUE, "7 mm"), (ORANGE, "10 mm")], [glass],
                      of_size=True, stop='print +"feed'),
        "rice": shaped("rice"),
        "tablet": shaped("tablet"),
        "rice-drum": Scene((90, -90), (-0.061, 0.061, 0, 0.02, -0.061, 0.0645), (0.02, "20 mm"), ("m/s, speed", 0, 0.3), [solid], d=0,
                           script="rice/in.rice-drum", stop="fix +mean", shaped=True, arrows=[circle((0, 0), 0.061, -35, 35)]),
    }


def state_script(text, name, scene):
    """The script up to the moment of the picture, where it writes the grains; its meshes are written on the way."""
    lines, meshes = [], 0

    def written(match):
        nonlocal meshes
        meshes += 1
        return f"{match[0]} mesh_stl {name}_{meshes}.stl every {EVERY}"

    for line in re.sub(r"&\s*\n\s*", " ", text).split("\n") + [""]:
        if re.match(scene.stop or "$", line) and (scene.stop or any(done.startswith("run ") for done in lines)):
            columns = "id type x y z radius vx vy vz"
            if scene.shaped:
                lines.append("compute shape all property/atom shapex shapey shapez block1 block2 quatw quati quatj quatk")
                columns += " c_shape[*]"
            return "\n".join(lines + [f"run $({EVERY}-step%{EVERY})", f"write_dump {scene.group} custom {name}.atoms {columns}",
                                      f'print "$(time)" file {name}.time', "quit", ""])
        if re.match(r"[^#]*\bwall/lsdcd\b", line):
            line = re.sub(r"\bmesh \S+\.stl", written, line)
        lines.append(line)
    raise SystemExit(f"{name}: the script has no line '{scene.stop}'")


def run(a, name, scene):
    """Its processor time, s."""
    original = runs.ROOT / "examples" / (scene.script or f"{name}/in.{name}")
    if scene.make:
        subprocess.run([Path(a.lmp).resolve().parent / "lsdcd", *scene.make], cwd=a.work, check=True, stdout=subprocess.DEVNULL)
    script = a.work / f"in.{name}"
    script.write_text(state_script(original.read_text(), name, scene))
    command = [Path(a.lmp).resolve(), "-in", script.name, "-log", "none", "-var", "dir", original.parent, *scene.words]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    with runs.environment() as env:
        done = subprocess.run(command, cwd=a.work, env=env, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              stdin=subprocess.DEVNULL)
    if done.returncode:
        raise SystemExit(done.stdout[-2000:])
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def draw(a, name, scene):
    import numpy as np

    import look
    import scene as vtk
    atoms = vtk.read_atoms(a.work / f"{name}.atoms")
    centres = np.stack([atoms["x"], atoms["y"], atoms["z"]], axis=1)
    shown = np.ones(len(centres), bool)
    if scene.cut:
        shown = (centres - scene.cut[0]) @ np.array(scene.cut[1]) > 0
    low, high = np.reshape(scene.box, (3, 2)).T
    shown &= ((centres > low) & (centres < high)).all(axis=1)
    if isinstance(scene.key, tuple):
        speed = np.sqrt(atoms["vx"] ** 2 + atoms["vy"] ** 2 + atoms["vz"] ** 2) * (math.sqrt(GRAVITY * scene.d) if scene.d else 1)
        _, least, most = scene.key
        colours = look.viridis((speed - least) / (most - least))
    else:
        kinds = np.unique(atoms["radius"].round(6), return_inverse=True)[1] if scene.of_size else atoms["type"].astype(int) - 1
        colours = np.array([look.rgb(scene.key[kind % len(scene.key)][0]) for kind in kinds])
    if scene.shaped:
        shape = np.stack([atoms[f"c_shape[{k}]"] for k in range(1, 10)], axis=1)[shown]
        actors = vtk.superellipsoids(centres[shown], shape[:, :3] / 2, shape[:, 3:5], shape[:, 5:], colours[shown])
    else:
        actors = vtk.spheres(centres[shown], atoms["radius"][shown], colours[shown])
    for k, drawn in enumerate(scene.meshes, 1):
        actors += vtk.mesh(a.work / f"{name}_{k}.stl", **drawn)
    camera = vtk.Camera(scene.view, scene.box, WIDTH)
    picture = camera.draw(actors)
    for points in scene.arrows:
        look.arrow(picture, camera, points)
    time = float((a.work / f"{name}.time").read_text()) * (math.sqrt(scene.d / GRAVITY) if scene.d else 1)
    return len(centres), look.below(picture, camera.scale, scene.bar, f"t = {time:.2f} s", scene.key)


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
    for name in a.names or [name for name in known if not known[name].shaped]:
        seconds = 0 if a.draw_only else run(a, name, known[name])
        grains, picture = draw(a, name, known[name])
        picture.quantize(256, kmeans=2).save(folder / f"{name}.png", optimize=True)
        print(f"{folder / name}.png: {grains} grains" + (f", {seconds:.1f} s of one core" if seconds else ""), flush=True)


if __name__ == "__main__":
    main()
