# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""A row for each field of the structs of lsdcd.h that make a wall: another value than in its base wall, as Python has it, and
what restore() does where the saved wall had the base's value. `undecided()` finds a field without a row."""
from __future__ import annotations

import atexit
import pathlib
import shutil
import tempfile
from typing import NamedTuple

import numpy as np

import lsdcd
from lsdcd import _c

REFUSED = "refused"    # with what differs
EXACT = "exact"        # the wall goes on as the saved one would
FOLDER = pathlib.Path(tempfile.mkdtemp())
atexit.register(shutil.rmtree, FOLDER)


class Row(NamedTuple):
    base: str      # of BASES
    change: dict   # words of WallMesh ("mesh"), WallSpec ("wall") and Wall ("options") in place of the base's
    restore: str


def plate(size):
    return lsdcd.Mesh(np.array([[-size, -size, 0], [size, -size, 0], [size, size, 0], [-size, size, 0]], float), [[0, 1, 2], [0, 2, 3]])


def box():
    corners = np.array([[x, y, z] for x in (-4, 4) for y in (-4, 4) for z in (-2, 0)], float)
    sides = (0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)
    return lsdcd.Mesh(corners, [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))])


def write_stl(file, mesh):
    facets = ("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in corners) + "endloop\nendfacet\n"
              for corners in mesh.vertices[mesh.faces])
    file.write_text("solid\n" + "".join(facets) + "endsolid\n")


FLOOR, WIDER, BOX = plate(4.0), plate(4.5), box()


def law(**words):
    return lsdcd.Law("hooke/history", **{**dict(kn=1e4, kt=3e3, gamman=5, gammat=None, xmu=0.5, dampflag=1), **words})


def warm(**words):
    numbers = {**dict(e=0.5, xgammat=1, mu=0.4, ks=800), **words}
    return lsdcd.Law.granular(lsdcd.SubModel("hertz/material", E=5e5, e=numbers["e"], nu=0.3),
                              lsdcd.SubModel("mindlin", xgammat=numbers["xgammat"], mu=numbers["mu"]), numbers.get("damping", "tsuji"),
                              rolling=lsdcd.SubModel("sds", k=100, gamma=1, mu=numbers.get("mur", 0.1)),
                              twisting=lsdcd.SubModel("sds", k=100, gamma=1, mu=numbers.get("mut", 0.1)),
                              heat=lsdcd.SubModel("area", h=numbers["ks"]))


TURN = dict(point=(0.1, 0, 0), axis=(0, 0, 1), period=2.0)
TABLE = np.array([[0, 0, 0, 0, 0], [0.05, 0.1, 0, 0, 0.002], [0.1, 0.3, 0, 0.01, 0]])


def table(rows=TABLE, **words):
    return {"motions": [lsdcd.Motion.table(rows, **{**dict(axis=(0, 0, 1)), **words})]}


def servo(**words):
    return {"servo": lsdcd.Servo(**{**dict(axis=(0, 0, 1), target=30, max_speed=0.2), **words})}


def body(**words):
    given = dict(mass=20, inertia=(3, 3, 5, 0, 0, 0), joint="slider", axis=(0, 0, 1), gravity=(0, 0, -1))
    return {"body": lsdcd.RigidBody(**{**given, **words})}


def hinge(**words):
    return body(**{**dict(joint="hinge", point=(0.2, 0, 0), axis=(0, 1, 0)), **words})


TYPED = {"type_laws": [(1, 1, law()), (2, None, law(kn=1.2e4))]}
BELOW = [lsdcd.WallMesh(WIDER, "below", lsdcd.Placement().move(0, 0, -2.05))]
# Words of the first mesh, of the wall, and of Wall(), and the meshes below.
BASES = {
    "floor": {}, "box": {"mesh": {"mesh": BOX}}, "warm": {"wall": {"law": warm()}},
    "typed": {"mesh": TYPED},
    "linear": {"mesh": {"motions": [lsdcd.Motion.linear((0, 0, 0.05))]}}, "wiggle": {"mesh": {"motions": [lsdcd.Motion.wiggle((0, 0, 0.01), 0.5)]}},
    "turn": {"mesh": {"motions": [lsdcd.Motion.rotate(**TURN)]}}, "riggle": {"mesh": {"motions": [lsdcd.Motion.riggle(angle=0.2, **TURN)]}},
    "table": {"mesh": table()}, "file": {"mesh": table(FOLDER / "one.txt")},
    "servo": {"mesh": servo()}, "torque": {"mesh": servo(turns=True, target=3)},
    "slider": {"mesh": {"mesh": BOX, **body()}}, "hinge": {"mesh": {"mesh": BOX, **hinge()}},
    "dense": {"mesh": {"mesh": BOX, "body": lsdcd.RigidBody(0.5)}}, "above": {"mesh": {"mesh": BOX, **body()}, "below": BELOW}, "coated": {"mesh": {"mesh": BOX, **body(coat=(1.0, 0.1))}, "below": BELOW},
    "nodes": {"mesh": {"nodes_by_caller": True}}, "posed": {"mesh": {"posed_by_caller": True}},
    "wears": {"mesh": {"mesh": BOX}, "wall": {"wear": ("archard", 1e-6, 1e5)}},
    "recedes": {"mesh": {"mesh": BOX}, "wall": {"wear": ("archard", 1e-6, 1e5), "wear_deform": (3, 2.0)}},
    "fields": {"mesh": {"fields": (str(FOLDER / "a.*.vtp"), 50), "stl": (str(FOLDER / "a.*.stl"), 50)}},
    "hot": {"wall": {"law": warm(), "energy": True, "friction_heat": 0.25}},
    "hit": {"mesh": {"spectrum": (str(FOLDER / "a.*.csv"), 50)}, "wall": {"impact_speed": 0.01}},
    "averaged": {"wall": {"average": 8}}, "nearest": {"wall": {"nearest": 2, "cell": 2.0}}, "periodic": {"options": {
        "lo": (-4, -4, -4), "hi": (4, 4, 4), "periodic": (True, True, False), "margin": 0.5}}}
for name, numbers in (("one", TABLE), ("other", TABLE[:2])):
    np.savetxt(FOLDER / f"{name}.txt", numbers)
for name, mesh in (("floor", FLOOR), ("wider", WIDER), ("box", BOX)):
    write_stl(FOLDER / f"{name}.stl", mesh)


LAW = "hooke/history 1e4 3e3 5 NULL 0.5 1"
WARM = "granular hertz/material 5e5 0.5 0.3 tangential mindlin NULL 1 0.4 damping tsuji rolling sds 100 1 0.1 twisting sds 100 1 0.1 heat area 800"
BODY = "mass 20 com 0 0 0 inertia 3 3 5 0 0 0 joint slider 0 0 1 gravity 0 0 -1"
HINGE = BODY.replace("slider 0 0 1", "hinge 0.2 0 0 0 1 0")
TYPE_WORDS = f"law types 1 {LAW} law types 2* {LAW.replace('1e4', '1.2e4', 1)}"
TABLE_WORDS = f"motion table {FOLDER}/one.txt axis 0 0 0 0 0 1"
BELOW_WORDS = f"mesh {FOLDER}/wider.stl move 0 0 -2.05"
# The bases in a script: words of the mesh and the wall.
BASE_WORDS = {
    "warm": f"{WARM} | temperature 0", "typed": TYPE_WORDS, "linear": "motion linear 0 0 0.05", "wiggle": "motion wiggle 0 0 0.01 0.5",
    "turn": "motion rotate 0.1 0 0 0 0 1 2", "riggle": f"motion riggle 0.1 0 0 0 0 1 {0.2 * 180 / np.pi:.17g} 2", "table": TABLE_WORDS,
    "file": TABLE_WORDS, "servo": "servo force z 30 vmax 0.2", "torque": "servo torque z 3 vmax 0.2", "slider": f"body {BODY}", "hinge": f"body {HINGE}",
    "dense": "body density 0.5", "above": f"body {BODY} {BELOW_WORDS}", "coated": f"body {BODY} coat 1 0.1 {BELOW_WORDS}", "nodes": "nodes some",
    "wears": "wear archard 1e-6 1e5", "recedes": "wear archard 1e-6 1e5 deform every 3 factor 2",
    "fields": f"mesh_fields {FOLDER}/a.*.vtp every 50 mesh_stl {FOLDER}/a.*.stl every 50", "averaged": "average 8",
    "hot": f"{WARM} | temperature 0 energy friction_heat 0.25", "hit": f"impact_spectrum {FOLDER}/a.*.csv every 50 impacts 0.01"}
ON_BOX = ("box", "slider", "hinge", "dense", "above", "coated", "wears", "recedes")


def script(base, words=None):
    """The words behind wall/lsdcd."""
    given = BASE_WORDS.get(base, "") if words is None else words
    law_words, bar, rest = given.partition("|")
    if not bar:
        law_words, rest = (WARM if base == "warm" else LAW), given
    usual = [more for more in ("rmax 0.6", "device cpu") if more.split()[0] not in rest.split()]
    return f"{law_words} mesh {FOLDER}/{'box' if base in ON_BOX else 'floor'}.stl {' '.join(usual)} {rest}"


def warm_words(was, is_):
    assert was in WARM
    return f"{WARM.replace(was, is_, 1)} | temperature 0"


def numbers_text(numbers):
    return " ".join(map(repr, np.ravel(numbers).tolist()))


def spec(change, base="floor"):
    """Words of a wall: a WallSpec, and those of Wall()."""
    words = {"wall": {"law": law(), "rmax": 0.6}, "mesh": {"mesh": FLOOR}, "options": {}}
    for more in (BASES[base], change):
        for of, given in more.items():
            words[of] = {**words[of], **given} if of in words else given
    meshes = words.get("meshes") or [lsdcd.WallMesh(**words["mesh"])] + words.get("below", [])
    return lsdcd.WallSpec(meshes=meshes, **words["wall"]), words["options"]


def of_mesh(base, restore, **words):
    return Row(base, {"mesh": words}, restore)


def of_wall(base, restore, **words):
    return Row(base, {"wall": words}, restore)


def of_options(base, restore, **words):
    return Row(base, {"options": words}, restore)


def of_motion(base, **words):
    kinds = {"linear": (lsdcd.Motion.linear, {"velocity": (0, 0, 0.05)}), "wiggle": (lsdcd.Motion.wiggle, dict(amplitude=(0, 0, 0.01), period=0.5)),
             "turn": (lsdcd.Motion.rotate, TURN), "riggle": (lsdcd.Motion.riggle, {**TURN, "angle": 0.2})}
    make, usual = kinds[base]
    return Row(base, {"mesh": {"motions": [make(**{**usual, **words})]}}, REFUSED)


class OneProcess:
    rank, size, node_rank = 0, 1, 0

    def sum(self, numbers): pass
    def max(self, numbers): pass
    def broadcast(self, data, source): pass


# Of each struct its fields: rows, or why there is none.
SIZE = "the library's"
FIELDS = {
    "lsdcd_wall_spec": {
        "size": SIZE, "law": of_wall("floor", REFUSED, law=law(kt=2e3)),
        "meshes": Row("floor", {"meshes": [lsdcd.WallMesh(WIDER)]}, REFUSED),
        "n_meshes": Row("floor", {"meshes": [lsdcd.WallMesh(FLOOR), lsdcd.WallMesh(BOX)]}, REFUSED),
        "corner": of_wall("floor", REFUSED, corner="sum"), "side": of_wall("box", REFUSED, side="out"),
        "nearest": of_wall("floor", REFUSED, nearest=3), "cell": [of_wall("floor", EXACT, cell=0.7), of_wall("nearest", REFUSED, cell=1.5)],
        "memory": [of_wall("floor", EXACT, memory=2.0**28), of_wall("nearest", REFUSED, memory=2.0**28)],
        "rmax": [of_wall("floor", EXACT, rmax=0.9), of_wall("nearest", REFUSED, rmax=0.9)], "device": of_wall("floor", EXACT, compute="auto"),
        "wear": of_wall("wears", REFUSED, wear=("finnie", 1e-6)), "wear_coefficient": of_wall("wears", REFUSED, wear=("archard", 2e-6, 1e5)),
        "hardness": of_wall("wears", REFUSED, wear=("archard", 1e-6, 2e5)),
        "wear_deform_every": of_wall("recedes", REFUSED, wear_deform=(4, 2.0)), "wear_deform_factor": of_wall("recedes", REFUSED, wear_deform=(3, 1.0)),
        "periodic_ends": of_wall("floor", EXACT, periodic_ends=True), "brief": of_wall("floor", EXACT, brief=True),
        "average_every": [of_wall("averaged", REFUSED, average=7), of_wall("floor", REFUSED, average=8), of_wall("averaged", REFUSED, average=0)],
        "each_contact": of_wall("floor", EXACT, each_contact=True), "energy": of_wall("floor", REFUSED, energy=True),
        "friction_heat": of_wall("hot", REFUSED, friction_heat=0.5), "impact_speed": [of_wall("floor", REFUSED, impact_speed=0.01), of_wall("hit", REFUSED, impact_speed=0.02)], "shapes": of_wall("floor", REFUSED, shapes=True)},
    "lsdcd_wall_mesh": {
        "size": SIZE, "mesh": of_mesh("floor", REFUSED, mesh=WIDER), "name": of_mesh("floor", EXACT, name="another"),
        "placement": of_mesh("floor", REFUSED, placement=lsdcd.Placement().scale(1, 1, 2).move(0, 0, 0.25)), "law": of_mesh("floor", REFUSED, law=law(xmu=0.4)),
        "type_laws": of_mesh("floor", REFUSED, **TYPED), "n_type_laws": of_mesh("typed", REFUSED, type_laws=TYPED["type_laws"][:1]),
        "posed_by_caller": of_mesh("floor", REFUSED, posed_by_caller=True),
        "motions": of_mesh("floor", REFUSED, motions=[lsdcd.Motion.linear((0.1, 0, 0))]),
        "n_motions": of_mesh("linear", REFUSED, motions=[lsdcd.Motion.linear((0, 0, 0.05)), lsdcd.Motion.linear((0.1, 0, 0))]),
        "servo": of_mesh("floor", REFUSED, **servo()), "surface_velocity": of_mesh("floor", REFUSED, surface_velocity=(0.1, 0, 0)),
        "surface_angular_velocity": of_mesh("floor", REFUSED, surface_angular_velocity=(0, 0, 0.5)),
        "surface_centre": of_mesh("floor", REFUSED, surface_centre=(0.3, 0, 0)), "temperature": of_mesh("warm", REFUSED, temperature=400.0),
        "torque_about": of_mesh("floor", REFUSED, torque_about=(0, 0, 0.5)),
        "torque_about_moves": of_mesh("linear", REFUSED, torque_about_moves=True), "wear_factor": of_mesh("wears", REFUSED, wear_factor=3.0),
        "cache": of_mesh("floor", EXACT, cache=FOLDER / "grid.bin"), "fields": of_mesh("fields", EXACT, fields=(str(FOLDER / "b.*.vtp"), 50)),
        "spectrum": of_mesh("hit", EXACT, spectrum=(str(FOLDER / "b.*.csv"), 50)), "spectrum_every": of_mesh("hit", EXACT, spectrum=(str(FOLDER / "a.*.csv"), 60)),
        "stl": of_mesh("fields", EXACT, stl=(str(FOLDER / "b.*.stl"), 50)),
        "fields_every": [of_mesh("fields", REFUSED, fields=(str(FOLDER / "a.*.vtp"), 60)),
                         of_mesh("floor", REFUSED, fields=(str(FOLDER / "a.*.vtp"), 50))],
        "stl_every": of_mesh("fields", EXACT, stl=(str(FOLDER / "a.*.stl"), 60)),
        "nodes_by_caller": of_mesh("floor", REFUSED, nodes_by_caller=True), "pressure": of_mesh("nodes", REFUSED, pressure=2.0),
        "body": of_mesh("box", REFUSED, **body())},
    "lsdcd_wall_options": {
        "size": SIZE, "lo": of_options("periodic", REFUSED, lo=(-4.5, -4, -4)), "hi": of_options("periodic", REFUSED, hi=(4, 4.5, 4)),
        "periodic": [of_options("periodic", REFUSED, periodic=(True, False, False)),
                     of_options("floor", EXACT, lo=(-4, -4, -4), hi=(4, 4, 4))],
        "margin": of_options("periodic", EXACT, margin=0.7), "time": of_options("floor", EXACT, time=3.0),
        "show": of_options("floor", EXACT, show=lambda text, warning: None), "data": "handed to show", "threads": of_options("floor", EXACT, threads=2),
        "host": of_options("floor", EXACT, host=OneProcess()), "stream": "of a device", "device": "test_python_gpu.py",
        "units": "of words, test_words.py"},
    "lsdcd_value": dict.fromkeys(("name", "kind", "mesh", "numbers", "n", "columns", "text"), "of words, test_words.py"),
    "lsdcd_host": dict.fromkeys(("size", "rank", "processes", "node_rank", "data", "sum", "max", "broadcast"),
                                "test_library_processes.cpp: a state is of a process"),
    "lsdcd_law": {
        "size": SIZE, "style": of_wall("floor", REFUSED, law=law(kn=1.1e4)), "normal": of_wall("warm", REFUSED, law=warm(e=0.6)),
        "tangential": of_wall("warm", REFUSED, law=warm(mu=0.3)), "damping": of_wall("warm", REFUSED, law=warm(damping="coeff_restitution")),
        "rolling": of_wall("warm", REFUSED, law=warm(mur=0.2)), "twisting": of_wall("warm", REFUSED, law=warm(mut=0.2)),
        "heat": of_wall("warm", REFUSED, law=warm(ks=900)),
        "cohesion": of_wall("floor", REFUSED, law=lsdcd.Law("hooke/history", kn=1e4, kt=3e3, gamman=5, xmu=0.5, dampflag=1,
                                                            cohesion=lsdcd.SubModel("sjkr", K=100.0))),
        "limit_damping": of_wall("floor", REFUSED, law=law(limit_damping=True))},
    "lsdcd_sub_model": {"name": of_wall("floor", REFUSED, law=lsdcd.Law("hertz/history", kn=1e4, kt=3e3, gamman=5, xmu=0.5, dampflag=1)),
                        "numbers": of_wall("floor", REFUSED, law=law(gamman=6))},
    "lsdcd_type_law": {"size": SIZE, "first_type": of_mesh("typed", REFUSED, type_laws=[TYPED["type_laws"][0], (3, None, law(kn=1.2e4))]),
                       "last_type": of_mesh("typed", REFUSED, type_laws=[TYPED["type_laws"][0], (2, 3, law(kn=1.2e4))]),
                       "law": of_mesh("typed", REFUSED, type_laws=[TYPED["type_laws"][0], (2, None, law(kn=1.3e4))])},
    "lsdcd_motion": {
        "size": SIZE, "kind": Row("wiggle", {"mesh": {"motions": [lsdcd.Motion.cosine((0, 0, 0.01), 0.5)]}}, REFUSED),
        "velocity": of_motion("linear", velocity=(0, 0, 0.04)), "amplitude": of_motion("wiggle", amplitude=(0, 0, 0.02)),
        "point": of_motion("turn", point=(0.2, 0, 0)), "axis": of_motion("turn", axis=(0, 0, -1)), "period": of_motion("turn", period=3.0),
        "angle": of_motion("riggle", angle=0.3), "rows": Row("table", {"mesh": table(TABLE * 1.5)}, REFUSED),
        "n_rows": Row("table", {"mesh": table(TABLE[:2])}, REFUSED), "columns": Row("table", {"mesh": table(TABLE[:, :2])}, REFUSED),
        "straight": Row("table", {"mesh": table(straight=True)}, REFUSED),
        "repeats": Row("table", {"mesh": table(np.vstack([TABLE, [0.15, 0, 0, 0, 0]]), repeats=True)}, REFUSED),
        "degrees": Row("table", {"mesh": table(degrees=True)}, REFUSED), "file": Row("file", {"mesh": table(FOLDER / "other.txt")}, REFUSED)},
    "lsdcd_servo": {
        "size": SIZE, "turns": Row("servo", {"mesh": servo(turns=True)}, REFUSED), "axis": Row("servo", {"mesh": servo(axis=(0, 0, -1))}, REFUSED),
        "point": Row("torque", {"mesh": servo(turns=True, target=3, point=(1, 0, 0))}, REFUSED),
        "target": Row("servo", {"mesh": servo(target=31)}, REFUSED), "max_speed": Row("servo", {"mesh": servo(max_speed=0.3)}, REFUSED),
        "max_gain": Row("servo", {"mesh": servo(max_gain=1e-3)}, REFUSED), "lo": Row("servo", {"mesh": servo(limits=(-1, 0))}, REFUSED),
        "hi": Row("servo", {"mesh": servo(limits=(0, 1))}, REFUSED)},
    "lsdcd_rigid_body": {
        "size": SIZE, "density": Row("dense", {"mesh": {"body": lsdcd.RigidBody(0.6)}}, REFUSED), "mass": Row("slider", {"mesh": body(mass=21)}, REFUSED),
        "centre": Row("hinge", {"mesh": hinge(centre=(0, 0, -1))}, REFUSED),
        "inertia": Row("hinge", {"mesh": hinge(inertia=(3, 4, 5, 0, 0, 0))}, REFUSED),
        "joint": Row("slider", {"mesh": body(joint="planar")}, REFUSED), "point": Row("hinge", {"mesh": hinge(point=(0, 0, 0))}, REFUSED),
        "axis": Row("hinge", {"mesh": hinge(axis=(0, -1, 0))}, REFUSED), "stiffness": Row("slider", {"mesh": body(spring=(30, 0, 0))}, REFUSED),
        "damping": Row("slider", {"mesh": body(spring=(0, 3, 0))}, REFUSED),
        "rest": Row("slider", {"mesh": body(spring=(30, 0, 0.1))}, REFUSED), "lo": Row("slider", {"mesh": body(limits=(-1, 0))}, REFUSED),
        "hi": Row("slider", {"mesh": body(limits=(-2, 1))}, REFUSED), "motor": Row("slider", {"mesh": body(motor=4)}, REFUSED),
        "load": Row("slider", {"mesh": body(load=(0, 0, 5))}, REFUSED), "moment": Row("hinge", {"mesh": hinge(moment=(0, 1, 0))}, REFUSED),
        # The data have them.
        "velocity": Row("slider", {"mesh": body(velocity=(0, 0, -0.1))}, EXACT),
        "angular_velocity": Row("hinge", {"mesh": hinge(angular_velocity=(0, 0.1, 0), velocity=(0, 0, 0.02))}, EXACT),
        "gravity": Row("slider", {"mesh": body(gravity=(0, 0, -2))}, REFUSED), "coat": Row("above", {"mesh": body(coat=(1.0, 0.1))}, REFUSED),
        "coat_spacing": Row("coated", {"mesh": body(coat=(1.1, 0.1))}, REFUSED),
        "coat_radius": Row("coated", {"mesh": body(coat=(1.0, 0.2))}, REFUSED)}}
# What the first row of each field says of Wall::spec() (spec_lines.cpp), "..." where more follows, and the words of a script that say the
# same: of the mesh and the wall in place of the base's, behind the law's and "|" if that is another one. None: a script has none.
LINES = {
    "wall_spec.law": ("law0.k_tangent = 2000", "hooke/history 1e4 2e3 5 NULL 0.5 1 |"),
    "wall_spec.meshes": ("mesh0.vertices = 4.5", None), "wall_spec.n_meshes": ("meshes = 2; mesh1.placement.row0 = 1 0 0; ...", f"mesh {FOLDER}/box.stl"),
    "wall_spec.corner": ("corner = 1", "corner sum"), "wall_spec.side": ("side = 2", "side out"), "wall_spec.nearest": ("nearest = 3", "nearest 3"),
    "wall_spec.cell": ("grid_length = 0.7", "grid 0.7"), "wall_spec.memory": ("memory_budget = 268435456", "memory 256"),
    "wall_spec.rmax": ("rmax = 0.9", "rmax 0.9"), "wall_spec.device": ("device = 0", "device auto"),
    "wall_spec.wear": ("wear.model = 2; wear.per_work = 1e-06", "wear finnie 1e-6"),
    "wall_spec.wear_coefficient": ("wear.per_work = 2e-11", "wear archard 2e-6 1e5"), "wall_spec.hardness": ("wear.per_work = 5e-12", "wear archard 1e-6 2e5"),
    "wall_spec.wear_deform_every": ("wear_deform.every = 4", "wear archard 1e-6 1e5 deform every 4 factor 2"),
    "wall_spec.wear_deform_factor": ("wear_deform.factor = 1", "wear archard 1e-6 1e5 deform every 3"),
    "wall_spec.periodic_ends": ("periodic = 1", "periodic"), "wall_spec.brief": ("brief = 1", "log brief"),
    "wall_spec.average_every": ("average_every = 7", "average 7"), "wall_spec.each_contact": ("each_contact = 1", "each_contact"),
    "wall_spec.energy": ("energy = 1; ...", "energy"), "wall_spec.friction_heat": ("friction_heat = 0.5", f"{WARM} | temperature 0 energy friction_heat 0.5"),
    "wall_spec.impact_speed": ("impact_speed = 0.01; ...", "impacts 0.01"),
    "wall_spec.shapes": ("law0.for_shapes = 1; shapes = 1", None),    # atoms say it
    "wall_mesh.mesh": ("mesh0.vertices = 4.5", None), "wall_mesh.name": ("mesh0.name = another", None),
    "wall_mesh.placement": ("mesh0.placement.row2 = 0 0 2; mesh0.placement.shift = 0 0 0.25", "scale 1 1 2 move 0 0 0.25"),
    "wall_mesh.law": ("mesh0.laws = 1; mesh0.law0.k_normal = 10000; mesh0.law0.mu = 0.4; ...", "law hooke/history 1e4 3e3 5 NULL 0.4 1"),
    "wall_mesh.type_laws": ("mesh0.laws = 2; mesh0.law0.first_type = 1; mesh0.law0.last_type = 1; mesh0.law1.k_normal = 12000; ...",
                            f"law types 1 {LAW} law types 2* hooke/history 1.2e4 3e3 5 NULL 0.5 1"),
    "wall_mesh.n_type_laws": ("mesh0.laws = 1", f"law types 1 {LAW}"), "wall_mesh.posed_by_caller": ("mesh0.posed = 1", None),
    "wall_mesh.motions": ("mesh0.motions = 1; mesh0.motion0.kind = 0; mesh0.motion0.velocity = 0.1 0 0; ...", "motion linear 0.1 0 0"),
    "wall_mesh.n_motions": ("mesh0.motions = 2; mesh0.motion1.velocity = 0.1 0 0; ...", "motion linear 0 0 0.05 motion linear 0.1 0 0"),
    "wall_mesh.servo": ("mesh0.servo.present = 1; mesh0.servo.target = 30; mesh0.servo.max_speed = 0.2", "servo force z 30 vmax 0.2"),
    "wall_mesh.surface_velocity": ("mesh0.surface.velocity = 0.1 0 0", "surface_vel 0.1 0 0"),
    "wall_mesh.surface_angular_velocity": ("mesh0.surface.angular = 0 0 0.5", "surface_angvel 0 0 0.5"),
    "wall_mesh.surface_centre": ("mesh0.surface.centre = 0.3 0 0", "surface_angvel 0 0 0 0.3 0 0"),
    "wall_mesh.temperature": ("mesh0.temperature = 400", "temperature 400"), "wall_mesh.torque_about": ("mesh0.torque_about = 0 0 0.5", "torque_about 0 0 0.5"),
    "wall_mesh.torque_about_moves": ("mesh0.torque_about_mesh = 1", "motion linear 0 0 0.05 torque_about mesh"),
    "wall_mesh.wear_factor": ("mesh0.wear_factor = 3", "wear archard 1e-6 1e5 wear_factor 3"), "wall_mesh.cache": (f"mesh0.cache_file = {FOLDER}/grid.bin", f"cache {FOLDER}/grid.bin"),
    "wall_mesh.fields": (f"mesh0.fields.name = {FOLDER}/b.*.vtp", f"mesh_fields {FOLDER}/b.*.vtp every 50 mesh_stl {FOLDER}/a.*.stl every 50"),
    "wall_mesh.spectrum": (f"mesh0.spectrum.name = {FOLDER}/b.*.csv", f"impact_spectrum {FOLDER}/b.*.csv every 50 impacts 0.01"),
    "wall_mesh.spectrum_every": ("mesh0.spectrum.every = 60", f"impact_spectrum {FOLDER}/a.*.csv every 60 impacts 0.01"),
    "wall_mesh.stl": (f"mesh0.stl.name = {FOLDER}/b.*.stl", f"mesh_fields {FOLDER}/a.*.vtp every 50 mesh_stl {FOLDER}/b.*.stl every 50"),
    "wall_mesh.fields_every": ("mesh0.fields.every = 60", f"mesh_fields {FOLDER}/a.*.vtp every 60 mesh_stl {FOLDER}/a.*.stl every 50"),
    "wall_mesh.stl_every": ("mesh0.stl.every = 60", f"mesh_fields {FOLDER}/a.*.vtp every 50 mesh_stl {FOLDER}/a.*.stl every 60"),
    "wall_mesh.nodes_by_caller": ("mesh0.has_nodes = 1", None), "wall_mesh.pressure": ("mesh0.pressure = 2", "nodes some pressure 2"),
    "wall_mesh.body": ("mesh0.body.present = 1; mesh0.body.mass = 20; mesh0.body.moments = 3 3 5; mesh0.body.joint = 2; mesh0.body.has_gravity = 1; "
                       "mesh0.body.gravity = 0 0 -1; ...", f"body {BODY}"),
    "wall_options.lo": ("options.corner = -4.5 -4 -4; options.edges = 8.5 8 8", None),
    "wall_options.hi": ("options.edges = 8 8.5 8", None), "wall_options.periodic": ("options.periodic = 1 0 0", None),
    "wall_options.margin": ("options.margin = 0.7", None), "wall_options.time": ("", None), "wall_options.show": ("", None),
    "wall_options.threads": ("options.threads = 2", None), "wall_options.host": ("", None),
    "law.style": ("law0.k_normal = 11000", "hooke/history 1.1e4 3e3 5 NULL 0.5 1 |"),
    "law.normal": ("law0.eta = 0.3581784074747588", warm_words("0.5 0.3", "0.6 0.3")), "law.tangential": ("law0.mu = 0.3", warm_words("1 0.4", "1 0.3")),
    "law.damping": ("law0.eta = 0.4817692577645866", warm_words("tsuji", "coeff_restitution")),
    "law.rolling": ("law0.rolling.numbers = 100 1 0.2", warm_words("rolling sds 100 1 0.1", "rolling sds 100 1 0.2")),
    "law.twisting": ("law0.twisting.numbers = 100 1 0.2", warm_words("twisting sds 100 1 0.1", "twisting sds 100 1 0.2")),
    "law.heat": ("law0.heat.numbers = 900 0 0", warm_words("area 800", "area 900")),
    "law.cohesion": ("law0.cohesion.model = 1; law0.cohesion.numbers = 100 0 0", "cohesion sjkr 100"),
    "law.limit_damping": ("law0.limit_damping = 1", f"{LAW} limit_damping |"),
    "sub_model.name": ("law0.normal = 1", "hertz/history 1e4 3e3 5 NULL 0.5 1 |"),
    "sub_model.numbers": ("law0.eta = 6; law0.gamma_tangent = 3", "hooke/history 1e4 3e3 6 NULL 0.5 1 |"),
    "type_law.first_type": ("mesh0.law1.first_type = 3", TYPE_WORDS.replace("2*", "3*")), "type_law.last_type": ("mesh0.law1.last_type = 3", TYPE_WORDS.replace("2*", "2*3")),
    "type_law.law": ("mesh0.law1.k_normal = 13000", TYPE_WORDS.replace("1.2e4", "1.3e4")),
    "motion.kind": ("mesh0.motion0.kind = 2", "wiggle z 0.01 0.5"), "motion.velocity": ("mesh0.motion0.velocity = 0 0 0.04", "motion linear 0 0 0.04"),
    "motion.amplitude": ("mesh0.motion0.amplitude = 0 0 0.02", "motion wiggle 0 0 0.02 0.5"),
    "motion.point": ("mesh0.motion0.point = 0.2 0 0", "motion rotate 0.2 0 0 0 0 1 2"), "motion.axis": ("mesh0.motion0.axis = 0 0 -1", "motion rotate 0.1 0 0 0 0 -1 2"),
    "motion.period": ("mesh0.motion0.period = 3", "motion rotate 0.1 0 0 0 0 1 3"),
    "motion.angle": ("mesh0.motion0.angle = 0.3", f"motion riggle 0.1 0 0 0 0 1 {0.3 * 180 / np.pi:.17g} 2"),
    "motion.rows": (f"mesh0.motion0.table.rows = {numbers_text(TABLE * 1.5)}", None), "motion.n_rows": (f"mesh0.motion0.table.rows = {numbers_text(TABLE[:2])}", None),
    "motion.columns": (f"mesh0.motion0.table.columns = 2; mesh0.motion0.table.rows = {numbers_text(TABLE[:, :2])}", None),
    "motion.straight": ("mesh0.motion0.table.linear = 1", f"{TABLE_WORDS} linear"),
    "motion.repeats": (f"mesh0.motion0.table.repeats = 1; mesh0.motion0.table.rows = {numbers_text(np.vstack([TABLE, [0.15, 0, 0, 0, 0]]))}", None),
    "motion.degrees": ("mesh0.motion0.table.degrees = 1", f"{TABLE_WORDS} degrees"),
    "motion.file": (f"mesh0.motion0.table_file = {FOLDER}/other.txt; ...", TABLE_WORDS.replace("one", "other")),
    "servo.turns": ("mesh0.servo.turns = 1", "servo torque z 30 vmax 0.2"), "servo.axis": ("mesh0.servo.axis = 0 0 -1", "servo force axis 0 0 -1 30 vmax 0.2"),
    "servo.point": ("mesh0.servo.point = 1 0 0", "servo torque z through 1 0 0 3 vmax 0.2"), "servo.target": ("mesh0.servo.target = 31", "servo force z 31 vmax 0.2"),
    "servo.max_speed": ("mesh0.servo.max_speed = 0.3", "servo force z 30 vmax 0.3"), "servo.max_gain": ("mesh0.servo.max_gain = 0.001", "servo force z 30 vmax 0.2 gain 1e-3"),
    "servo.lo": ("mesh0.servo.lo = -1; mesh0.servo.hi = 0", "servo force z 30 vmax 0.2 limits -1 0"),
    "servo.hi": ("mesh0.servo.lo = 0; mesh0.servo.hi = 1", "servo force z 30 vmax 0.2 limits 0 1"),
    # A box 8 x 8 x 2: the mass, and M (8^2 + 2^2)/12 and M (8^2 + 8^2)/12.
    "rigid_body.density": ("mesh0.body.density = 0.6; ...", "body density 0.6"), "rigid_body.mass": ("mesh0.body.mass = 21", f"body {BODY.replace('20', '21')}"),
    "rigid_body.centre": ("mesh0.body.centre = 0 0 -1", f"body {HINGE.replace('com 0 0 0', 'com 0 0 -1')}"),
    "rigid_body.inertia": ("mesh0.body.moments = 3 4 5", f"body {HINGE.replace('3 3 5', '3 4 5')}"),
    "rigid_body.joint": ("mesh0.body.joint = 3", f"body {BODY.replace('slider', 'planar')}"),
    "rigid_body.point": ("mesh0.body.point = 0 0 0", f"body {HINGE.replace('0.2 0 0', '0 0 0')}"),
    "rigid_body.axis": ("mesh0.body.axis = 0 -1 0", f"body {HINGE.replace('0 1 0', '0 -1 0')}"),
    "rigid_body.stiffness": ("mesh0.body.stiffness = 30", f"body {BODY} spring 30 0"), "rigid_body.damping": ("mesh0.body.damping = 3", f"body {BODY} spring 0 3"),
    "rigid_body.rest": ("mesh0.body.stiffness = 30; mesh0.body.rest = 0.1", f"body {BODY} spring 30 0 0.1"),
    "rigid_body.lo": ("mesh0.body.lo = -1; mesh0.body.hi = 0", f"body {BODY} limits -1 0"), "rigid_body.hi": ("mesh0.body.lo = -2; mesh0.body.hi = 1", f"body {BODY} limits -2 1"),
    "rigid_body.motor": ("mesh0.body.motor = 4", f"body {BODY} motor 4"), "rigid_body.load": ("mesh0.body.load = 0 0 5", f"body {BODY} load 0 0 5"),
    "rigid_body.moment": ("mesh0.body.moment = 0 1 0", f"body {HINGE} moment 0 1 0"),
    "rigid_body.velocity": ("mesh0.body.velocity = 0 0 -0.1", f"body {BODY} velocity 0 0 -0.1"),
    "rigid_body.angular_velocity": ("mesh0.body.velocity = 0 0 0.02; mesh0.body.omega = 0 0.1 0", f"body {HINGE} omega 0 0.1 0 velocity 0 0 0.02"),
    "rigid_body.gravity": ("mesh0.body.gravity = 0 0 -2", f"body {BODY.replace('0 0 -1', '0 0 -2')}"),
    "rigid_body.coat": ("mesh0.body.coat = 1; mesh0.body.coat.spacing = 1; mesh0.body.coat.radius = 0.1", f"body {BODY} coat 1 0.1 {BELOW_WORDS}"),
    "rigid_body.coat_spacing": ("mesh0.body.coat.spacing = 1.1", f"body {BODY} coat 1.1 0.1 {BELOW_WORDS}"),
    "rigid_body.coat_radius": ("mesh0.body.coat.radius = 0.2", f"body {BODY} coat 1 0.2 {BELOW_WORDS}")}
# Values that C writes otherwise: their base, change, lines and words.
ENCODED = {
    "a mesh that never wears": ("wears", {"mesh": {"wear_factor": 0.0}}, "mesh0.wear_factor = 0", "wear archard 1e-6 1e5 wear_factor 0"),
    "a coat whose lengths are chosen": ("above", {"mesh": body(coat=True)}, "mesh0.body.coat = 1", f"body {BODY} coat auto {BELOW_WORDS}"),
    "a law of all types from 3 on": ("typed", {"mesh": {"type_laws": [TYPED["type_laws"][0], (3, None, law(kn=1.2e4))]}},
                                     "mesh0.law1.first_type = 3", TYPE_WORDS.replace("2*", "3*"))}
# Structs that are given to each step, answers, and what is of no wall.
OTHERS = {"of each step": ("spheres", "wall_step"), "answers": ("wall_totals", "wall_contacts", "wall_impacts", "body_state"),
          "of no wall": ("mesh_facts", "mesh_arrays", "grid_options", "grid_facts", "query", "contacts", "shape_facts", "shapes", "body_options",
                         "body_facts", "collision", "sub_model_facts", "override", "materials")}


def undecided():
    """Fields and structs of the header without a row, and rows without a field."""
    header = {name: {field for field, _ in struct._fields_} for name, struct in _c._HEADER.structs.items()}
    for names in OTHERS.values():
        for name in names:
            header.pop("lsdcd_" + name)
    return {f"{name}.{field}" for name in header.keys() | FIELDS.keys()
            for field in header.get(name, set()) ^ set(FIELDS.get(name, ()))}


def rows():
    """A name and a row for each of them."""
    for struct, fields in FIELDS.items():
        for field, given in fields.items():
            for row in [] if isinstance(given, str) else [given] if isinstance(given, Row) else given:
                yield f"{struct[len('lsdcd_'):]}.{field}", row
