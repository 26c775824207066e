# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Walls by words, and for each keyword and number another one, with what restore() does where the saved wall had that of the base. The checks
at the end find what has no row: keywords, sub-models and their numbers by what the library lists where it refuses a word, other words by the
manual page, other numbers by the bases."""
from __future__ import annotations

import atexit
import difflib
import pathlib
import re
import shutil
import tempfile
from typing import NamedTuple

import numpy as np

import lsdcd
from lsdcd import _c

REFUSED = "refused"    # with what differs
EXACT = "exact"        # the wall goes on as the saved one would
FOLDER = pathlib.Path(tempfile.mkdtemp())
PAGE = pathlib.Path(__file__).resolve().parents[2] / "doc/fix_wall_lsdcd.rst"
atexit.register(shutil.rmtree, FOLDER)


class Row(NamedTuple):
    name: str
    base: str        # of BASES
    words: str       # of the wall that is to take the state
    values: dict     # in place of VALUES
    options: dict    # of Wall() in place of the base's
    restore: str


def plate(size):
    return lsdcd.Mesh(np.array([[-size, -size, 0], [size, -size, 0], [size, size, 0], [-size, size, 0]], float), [[0, 1, 2], [0, 2, 3]])


def box():
    corners = np.array([[x, y, z] for x in (-4, 4) for y in (-4, 4) for z in (-2, 0)], float)
    sides = (0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)
    return lsdcd.Mesh(corners, [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))])


def write_stl(file, triangles):
    facets = ("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in corners) + "endloop\nendfacet\n"
              for corners in triangles)
    file.write_text("solid\n" + "".join(facets) + "endsolid\n")


class OneProcess:
    rank, size, node_rank = 0, 1, 0

    def sum(self, numbers): pass
    def max(self, numbers): pass
    def broadcast(self, data, source): pass


FLOOR, WIDER, BOX = plate(4.0), plate(4.5), box()
TABLE = np.array([[0, 0, 0, 0, 0], [0.05, 0.1, 0, 0, 0.002], [0.1, 0.3, 0, 0.01, 0]])
VALUES = {"floor": FLOOR, "box": BOX, "below": WIDER, "rows": TABLE, "shifts": TABLE[:, [0, 2, 3, 4]],
          "period": np.vstack([TABLE, [0.15, 0, 0, 0, 0]]), "deck": FLOOR, "steel": [1e4, 3e3, 5, None, 0.5, 1], "cache": FOLDER / "a grid.bin",
          "place": np.hstack([1.1 * np.eye(3), np.zeros((3, 1))])}
INPUT = 0.05    # what each v_NAME is
for name, mesh in (("floor", FLOOR), ("wider", WIDER)):
    write_stl(FOLDER / f"{name}.stl", mesh.vertices[mesh.faces])
write_stl(FOLDER / "gap.stl", FLOOR.vertices[FLOOR.faces] + np.array([0, 0.0625, 0]) * np.array([0, 1])[:, None, None])
for name, numbers in (("one", TABLE), ("other", TABLE[:2])):
    np.savetxt(FOLDER / f"{name}.txt", numbers)
MATERIALS = FOLDER / "some.lsdcd"
MATERIALS.write_text("units si\n" + "".join(f"""material {name}
  youngs_modulus {young} Pa
  poissons_ratio {poisson} 1
  density 2500 kg/m3
""" for name, young, poisson in (("pellet", "5e5", "0.3"), ("lining", "4e5", "0.3"), ("rubber", "3e5", "0.4"))) + "".join(f"""pair {one} {other}
  restitution 0.5 1
  sliding_friction {friction} 1
""" for one, other, friction in (("pellet", "lining", "0.4"), ("pellet", "rubber", "0.5"), ("rubber", "lining", "0.6"), ("rubber", "rubber", "0.7"),
                                 ("pellet", "pellet", "0.8"))))


# ---- bases -------------------------------------------------------------------------------
# A word of a base may have others behind it: "30|31|=30.0" is 30, and rows have 31, of which the state is refused, and 30.0, of which it is taken.

STYLE = "hooke/history 1e4 3e3 5 NULL 0.5 1"
WARM = "granular hertz/material 5e5 0.5 0.3 tangential mindlin NULL 1 0.4 damping tsuji rolling sds 100 1 0.1 twisting sds 100 1 0.1 heat area 800"
MASS = "mass 20 com 0 0 0 inertia 3 3 5 0 0 0"
SLIDER, HINGE = f"body {MASS} joint slider 0 0 1 gravity 0 0 -1", f"body {MASS} joint hinge 0.2 0 0 0 1 0 gravity 0 0 -1"
UNDER = "mesh $below move 0 0 -2.05"
ORIGIN = "0|0.1 0|0.1 0|0.1"
ALL_MASS = f"mass 20|21 com {ORIGIN} inertia 3|4 3|4 5|5.5 0|0.1 0|0.1 0|0.1"
UP = "0|0.1 0|0.1 1|-1"    # a direction


def on(mesh, words="", law=STYLE):
    return f"{law} mesh ${mesh} rmax 0.6 {words}"


def hot(law, words="temperature 0"):
    return on("floor", words, law)


BASES = {
    "floor": f"{STYLE} mesh $floor rmax 0.6|=0.9|=auto", "box": on("box"),
    "file": f"{STYLE} mesh {FOLDER}/floor.stl|{FOLDER}/wider.stl name floor|=another rmax 0.6 weld 0|=1e-3",
    "gap": f"{STYLE} mesh {FOLDER}/gap.stl rmax 0.6 weld 0|0.1", "named": on("floor", "name deck|=another"),
    "valued": on("floor", law="hooke/history $steel"),
    "placed": on("floor", f"scale 1.1|1.2 1|1.2 1|1.5 rotate {UP} 30|31 move 0|0.1 0|0.1 0|-0.01"), "scaled": on("floor", "scale 1.1|1.2"),
    "by_matrix": on("floor", "matrix 1|1.1 0|0.1 0|0.1 0|0.1 0|0.1 1|1.1 0|0.1 0|0.1 0|0.1 0|0.1 1|1.1 0|-0.01"),
    # Laws.
    "hooke": on("floor", law="hooke|hooke/history 1e4|1.1e4 3e3|2e3 5|6 4|3 0.5|0.4 1|0"),
    "history": on("floor", law="hooke/history|hertz/history 1e4|1.1e4 3e3|2e3|NULL 5|6 NULL|=2.5|2 0.5|0.4 1|0"),
    "soft": on("floor", law=f"hooke/history 1e4 NULL|={2e4 / 7!r}|3e3 5 2.5 0.5 0|1"),
    "hertz": on("floor", law="hertz/history|hooke/history 2e4|2.1e4 3e3|2e3 5|6 4|3 0.5|0.4 1|0"),
    "slips": on("floor", law="granular hooke|hertz 1e4|1.1e4 5|6 tangential linear_nohistory|linear_nohistory_liggghts 1|2 0.4|0.3 "
                "damping velocity|mass_velocity twisting none"),
    "springs": hot("granular hertz|hooke 2e4|2.1e4 5|6 tangential linear_history|linear_history_slip|linear_history_liggghts 3e3|2e3 1|2 0.4|0.3 "
                   "damping mass_velocity|velocity|viscoelastic|none rolling cdt|epsd2 0.1|0.2 heat radius|area 2|3", "temperature 0|400|=0.0"),
    "warm": hot("granular hertz/material 5e5|6e5 0.5|0.6 0.3|0.2 tangential mindlin|mindlin/force|mindlin_slip NULL|2e5 1|2 0.4|0.3 "
                "damping tsuji|coeff_restitution rolling sds 100|110 1|2 0.1|0.2 twisting sds 100|110 1|2 0.1|0.2 heat area|radius 800|900",
                "temperature 0|400|=0.0"),
    "sticks": on("floor", law="granular dmt|jkr 5e5|6e5 5|6 0.3|0.2 0.1|0.2 tangential mindlin/force|mindlin 2e5|3e5 1|2 0.4|0.3 "
                 "damping viscoelastic|velocity rolling epsd2|cdt 0.1|0.2"),
    "holds": on("floor", law="granular jkr|dmt 5e5|6e5 5|6 0.3|0.2 0.1|0.2 tangential mindlin_rescale|mindlin_rescale/force 2e5|3e5 1|2 0.4|0.3 "
                "damping velocity|viscoelastic rolling epsd 0.1|0.2 0.3|0.4 twisting marshall|none"),
    "liggghts": on("floor", law="granular hertz/material 5e5|6e5 0.5|0.6 0.3|0.2 tangential mindlin_liggghts|mindlin NULL|2e5 1|2 0.4|0.3 "
                   "damping coeff_restitution|tsuji rolling epsd3 0.1|0.2 0.3|0.4 2.25|2 cohesion sjkr 100|200"),
    "yields": on("floor", law="granular hysteretic|hysteretic/size 1e4|1.1e4 0.5|0.6 tangential linear_nohistory 1 0.4"),
    "yields_by_size": on("floor", law="granular hysteretic/size|hysteretic/edem 2e4|2.1e4 0.5|0.6 tangential linear_nohistory 1 0.4"),
    "yields_as_edem": on("floor", law="granular hysteretic/edem|hysteretic 2e4|2.1e4 0.5|0.6 tangential linear_nohistory 1 0.4"),
    "yields_and_pulls": on("floor", law="granular eepa 1e4|1.1e4 0.5|0.6 0.5|0.4 10|11 1|1.5 1|1.5 -0.1|-0.2 tangential linear_nohistory 1 0.4"),
    "pulls_by_slope": on("floor", law="granular lepa 1e4|1.1e4 5|6 5e4|6e4 1e3|2e3 0.1|0.2 tangential linear_nohistory 1 0.4"),
    "flattens": on("floor", law="granular thornton 5e5|6e5 5|6 0.3|0.2 1e4|2e4 tangential linear_nohistory 1 0.4"),
    "bridges": on("floor", law="granular hooke 1e4 5 tangential linear_nohistory 1 0.4 cohesion capillary|capillary/share 3|4 20|30 NULL|70 1e-4|2e-4"),
    "bridges_by_share": on("floor", law="granular hooke 1e4 5 tangential linear_nohistory 1 0.4 cohesion capillary/share|capillary 3|4 20|30 70|=70.0 1e-4|2e-4"),
    "pulls": on("floor", law="granular hooke 1e4 5 tangential linear_nohistory 1 0.4 cohesion constant|linear 5|6 0.03|0.04"),
    "pulls_by_weight": on("floor", law="granular hooke 1e4 5 tangential linear_nohistory 1 0.4 cohesion constant/weight 0.7|0.8 9.8|9.9 0.03|0.04"),
    "pulls_as_a_spring": on("floor", law="granular hooke 1e4 5 tangential linear_nohistory 1 0.4 cohesion linear|constant 100|110 0.03|0.04"),
    "slipping": on("floor", law="granular hooke 1e4 5 tangential linear_history_slip|linear_history 3e3|2e3 1|2 0.4|0.3 damping velocity"),
    "as_liggghts": on("floor", law="granular hooke 1e4 5 tangential linear_history_liggghts|linear_history 3e3|2e3 1|2 0.4|0.3 damping velocity"),
    "midpoint": on("floor", law="granular hooke 1e4 5 tangential linear_nohistory_liggghts|linear_nohistory 1|2 0.4|0.3 damping none|velocity"),
    "slip_of_mindlin": on("floor", law="granular hertz 2e4 5 tangential mindlin_slip|mindlin 2e4|3e4 1|2 0.4|0.3 damping velocity"),
    "force_of_mindlin": on("floor", law="granular hertz 2e4 5 tangential mindlin_rescale/force|mindlin_rescale 2e4|3e4 1|2 0.4|0.3 damping velocity"),
    "rolls": on("floor", "rolling sds 100|110 1|2 0.1|0.2 cohesion sjkr 100|200"), "rolls_cdt": on("floor", "rolling cdt|epsd2 0.1|0.2"),
    "rolls_epsd2": on("floor", "rolling epsd2|cdt 0.1|0.2"), "rolls_epsd": on("floor", "rolling epsd 0.1|0.2 0.3|0.4"),
    "rolls_epsd3": on("floor", "rolling epsd3 0.1|0.2 0.3|0.4 2.25|2"), "coheres": on("floor", "cohesion sjkr 100|200|=100.0"),
    "own": on("floor", "law hooke/history 1e4|1.1e4 3e3|2e3 5|6 NULL|=2.5|2 0.4|0.5 1|0"),
    "typed": on("floor", f"law types 1|2|1*2 {STYLE} law types 2*|3*|2*3 hooke/history 1.2e4|1.3e4 3e3|2e3 5|6 NULL|=2.5 0.5|0.4 1|0"),
    "material": on("floor", "material lining|rubber with sliding_friction 0.3|0.4",
                   f"granular material {MATERIALS} pellet|rubber types 2|3 rubber|pellet on rubber|lining with restitution 0.5|0.6"),
    # Motions.
    "linear": on("floor", "motion linear 0|0.1 0|0.1 0.05|0.04"), "wiggle": on("floor", "motion wiggle 0|0.1 0|0.1 0.01|0.02 0.5|0.6"),
    "cosine": on("floor", "wiggle z|x 0.01|0.02 0.5|0.6"), "turn": on("floor", f"motion rotate 0.1|0.2 0|0.1 0|0.1 {UP} 2|3"),
    "transrot": on("floor", f"motion transrot 0|0.1 0|0.1 0.05|0.04 0.1|0.2 0|0.1 0|0.1 {UP} 2|3"),
    "riggle": on("floor", f"motion riggle 0.1|0.2 0|0.1 0|0.1 {UP} 11|12 2|3"),
    "table": on("floor", f"motion table $rows|{FOLDER}/other.txt axis {ORIGIN} {UP}"),
    "table_about": on("floor", f"motion table $shifts about {ORIGIN}"),
    "table_file": on("floor", f"motion table {FOLDER}/one.txt|{FOLDER}/other.txt axis 0 0 0 0 0 1"),
    "table_period": on("floor", "motion table $period axis 0 0 0 0 0 1"),
    "variable": on("floor", "motion variable v_dx|v_other|NULL v_dy|v_other|NULL v_dz|v_other|NULL "
                   "v_vx|v_other|NULL v_vy|v_other|NULL v_vz|v_other|NULL"),
    "turn_by_inputs": on("floor", f"motion rotate 0.1|0.2 0|0.1 0|0.1 {UP} variable v_angle|v_other|NULL v_speed|v_other|NULL"),
    "posed": on("floor", "motion caller"),
    "belt": on("floor", "surface_vel 0.1|0.2 0|0.1 0|0.1 surface_angvel 0|0.1 0|0.1 0.5|0.6 0.3|0.4 0|0.1 0|0.1"),
    "belt_by_inputs": on("floor", "surface_vel v_sx|v_other|1 v_sy|v_other|1 v_sz|v_other|1 "
                         "surface_angvel v_wx|v_other|1 v_wy|v_other|1 v_wz|v_other|1"),
    "shear": on("floor", "shear x|y 0.1|0.2"), "shear_by_input": on("floor", "shear x|y v_sx|v_other|1"),
    # Servos and bodies.
    "servo": on("floor", "servo force z 30 vmax 0.2"), "torque": on("floor", "servo torque z 3 vmax 0.2"),
    "held": on("floor", "servo force|torque z|x 30|31|v_push vmax 0.2|0.3 gain 1e-3|2e-3 limits -1|-2 1|2"),
    "slanted": on("floor", f"servo force axis {UP}|=2 30|31|0 vmax 0.2|0.3"),
    "pushed": on("floor", "servo force z|x v_push|v_other|30|0 vmax 0.2|0.3"),
    "twisted": on("floor", "servo torque z|x through 0|1 0|1 0|1 3|4|v_push vmax 0.2|0.3 gain 1e-3|2e-3 limits -1|-2 1|2"),
    "slider": on("box", "body mass 20|21 com 0 0 0 inertia 3 3 5 0 0 0 joint slider 0 0 1 gravity 0 0 -1|-2"),
    "hinge": on("box", "body mass 20 com 0 0 0|-1 inertia 3 3|4 5 0 0 0 joint hinge 0.2|0 0 0 0 1|-1 0 gravity 0 0 -1"),
    "dense": on("box", "body density 0.5|0.6"), "free": on("box", f"body {ALL_MASS} joint free"),
    "sliding": on("box", f"body {ALL_MASS} joint slider {UP}|=2 spring 30|40 3|4 0.1|0.2 limits -1|-2 1|2 motor 4|5 load 0|1 0|1 5|6 "
                  "moment 0|1 0|1 0|1 gravity 0|0.1 0|0.1 -1|-2"),
    "hinged": on("box", f"body {ALL_MASS} joint hinge 0.2|0 0|0.1 0|0.1 0|0.1 1|-1|=2 0|0.1 spring 30|40 3|4 0.1|0.2 limits -1|-2 1|2 motor 4|5 "
                 "gravity 0|0.1 0|0.1 -1|-2"),
    "planar": on("box", f"body {MASS} joint planar|slider {UP}|=2"),
    "moving": on("box", f"{SLIDER} velocity 0 0 -0.1|=-0.2"), "turning": on("box", f"{HINGE} omega 0 0.1 0 velocity 0 0 0.02"),
    "ball": on("box", f"body {MASS} joint ball {ORIGIN} omega 0.1|=0.2 0|=0.1 0|=0.1"),
    "flying": on("box", f"body {MASS} velocity 0|=0.1 0|=0.1 0|=0.1 omega 0|=0.1 0|=0.1 0|=0.1"),
    "body_by_inputs": on("box", f"body {MASS} joint slider 0 0 1 motor v_motor|v_other|4 load v_fx|v_other|1 v_fy|v_other|1 v_fz|v_other|1 "
                         "moment v_tx|v_other|1 v_ty|v_other|1 v_tz|v_other|1"),
    "above": on("box", f"{SLIDER} {UNDER}"), "coated": on("box", f"{SLIDER} coat 1|1.1 0.1|0.2 mesh $below move 0|0.1 0|0.1 -2.05|-2.06"),
    "coated_auto": on("box", f"{SLIDER} coat auto|no {UNDER}"),
    # What deforms.
    "nodes": on("floor", "nodes caller"), "pressed": on("floor", "nodes caller pressure 1|2"),
    "pressed_by_input": on("floor", "nodes caller pressure v_p|v_other|1"),
    "wears": on("box", "wear archard 1e-6|2e-6 1e5|2e5"), "wears_faster": on("box", "wear archard 1e-6 1e5 wear_factor 2|3|0|=2.0"),
    "wears_by_angle": on("box", "wear finnie 1e-6|2e-6"),
    "wears_by_impact": on("box", "wear oka 1e-6|2e-6 1.2|2 0.7|1 2|1 2.3|2 0.2|0 10|20 1e-3|2e-3 0.01|0.02"),
    "recedes": on("box", "wear archard 1e-6|2e-6 1e5|2e5 deform every 3|4 factor 2|1"),
    # What is told, and how it is found.
    "fields": on("floor", f"mesh_fields {FOLDER}/a.*.vtp|={FOLDER}/b.*.vtp every 50|60 mesh_stl {FOLDER}/a.*.stl|={FOLDER}/b.*.stl every 50|=60"),
    "hit": on("floor", f"impact_spectrum {FOLDER}/a.*.csv|={FOLDER}/b.*.csv every 50|=60 impacts 0.01|0.02"), "averaged": on("floor", "average 8|7"),
    "hot": hot(WARM, "temperature v_t|v_other|400 energy friction_heat 0.25|0.5"), "about": on("floor", f"torque_about {ORIGIN}"),
    "about_mesh": on("floor", f"motion linear 0 0 0.05 torque_about mesh {ORIGIN}"),
    "one_sided": on("box", "side out|both|in corner sum|blend"), "cut_corners": on("box", "corner blend|sum"),
    "cached": on("floor", f"cache {FOLDER}/one.bin|={FOLDER}/other.bin|=none|=$cache log brief|=full device cpu|=auto"),
    "found": f"{STYLE} mesh $floor rmax 0.6|=0.9|=auto grid 1|=0.7|=auto memory 512|=256 nearest all|3",
    "nearest": f"{STYLE} mesh $floor rmax 0.6|0.9 nearest 2|3|all grid 2|1.5|auto memory 512|256",
    "nearest_alone": f"{STYLE} mesh $floor rmax 0.6|0.9 nearest 2 grid 2|1.5",
    "boxed": on("floor")}
OPTIONS = {"boxed": {"lo": (-4, -4, -4), "hi": (4, 4, 4), "periodic": (True, True, False), "margin": 0.5}}    # of Wall(), of these bases

# ---- rows --------------------------------------------------------------------------------
# Words behind those of a base.
MORE = [
    ("floor", "corner sum", REFUSED), ("floor", "corner blend", EXACT), ("box", "side out", REFUSED), ("box", "side both", EXACT),
    ("floor", "coarse_grain 2", REFUSED), ("floor", "coarse_grain 1", EXACT), ("floor", "nearest 3", REFUSED), ("floor", "nearest all", EXACT), ("floor", "grid 0.7", EXACT), ("floor", "grid auto", EXACT),
    ("floor", "memory 256", EXACT), ("nearest_alone", "memory 256", REFUSED), ("floor", "device auto", EXACT), ("floor", "periodic", EXACT),
    ("floor", "log brief", EXACT), ("floor", "average 8", REFUSED), ("floor", "each_contact", EXACT), ("floor", "energy", REFUSED),
    ("floor", "impacts 0.01", REFUSED), ("floor", "shapes", REFUSED), ("floor", "mesh $box", REFUSED), ("floor", "name another", EXACT),
    ("floor", "scale 1 1 2 move 0 0 0.25", REFUSED), ("floor", "scale 1", EXACT), ("floor", "move 0 0 0", EXACT), ("floor", "rotate 0 0 1 0", EXACT),
    ("floor", "matrix 1 0 0 0 0 1 0 0 0 0 1 0", EXACT), ("floor", "matrix 0.5 0 0 0 0 1 0 0 0 0 1 0 scale 2 1 1", EXACT),
    ("floor", f"law {STYLE}", REFUSED), ("floor", f"law {STYLE.replace('0.5', '0.4')}", REFUSED), ("floor", f"law types 1 {STYLE}", REFUSED),
    ("floor", f"law types 1 {STYLE} law types 2* {STYLE.replace('1e4', '1.2e4')}", REFUSED), ("floor", "motion caller", REFUSED),
    ("floor", "motion linear 0.1 0 0", REFUSED), ("linear", "motion linear 0.1 0 0", REFUSED), ("floor", "wiggle z 0.01 0.5", REFUSED),
    ("floor", "servo force z 30 vmax 0.2", REFUSED), ("floor", "surface_vel 0.1 0 0", REFUSED), ("floor", "surface_vel 0 0 0", EXACT),
    ("floor", "surface_angvel 0 0 0.5", REFUSED), ("floor", "surface_angvel 0 0 0 0.3 0 0", REFUSED), ("floor", "shear x 0.1", REFUSED),
    ("floor", "torque_about 0 0 0.5", REFUSED), ("linear", "torque_about mesh", REFUSED), ("floor", "torque_about 0 0 0", EXACT),
    ("floor", f"cache {FOLDER}/grid.bin", EXACT), ("floor", "cache none", EXACT), ("floor", f"mesh_fields {FOLDER}/a.*.vtp every 50", REFUSED),
    ("floor", f"mesh_stl {FOLDER}/a.*.stl every 50", EXACT),
    ("floor", "nodes caller", REFUSED), ("nodes", "pressure 2", REFUSED), ("nodes", "pressure 0", EXACT), ("box", SLIDER, REFUSED),
    ("floor", "rolling cdt 0.1", REFUSED), ("floor", "cohesion sjkr 100", REFUSED), ("floor", "cohesion sjkr 0", EXACT),
    ("box", "wear archard 1e-6 1e5", REFUSED), ("wears", "wear_factor 3", REFUSED), ("wears_by_angle", "wear_factor 1", EXACT),
    ("wears_by_angle", "deform every 3", REFUSED),
    ("servo", "gain 1e-3", REFUSED), ("servo", "limits -1 0", REFUSED), ("servo", "limits 0 1", REFUSED),
    ("slider", "spring 30 0", REFUSED), ("slider", "spring 0 3", REFUSED), ("slider", "spring 30 0 0.1", REFUSED), ("slider", "limits -1 0", REFUSED),
    ("slider", "limits -2 1", REFUSED), ("slider", "motor 4", REFUSED), ("slider", "motor 0", EXACT), ("slider", "load 0 0 5", REFUSED),
    ("slider", "load 0 0 0", EXACT), ("hinge", "moment 0 1 0", REFUSED), ("hinge", "moment 0 0 0", EXACT), ("slider", "velocity 0 0 -0.1", EXACT),
    ("hinge", "omega 0 0.1 0 velocity 0 0 0.02", EXACT), ("slider", "coat no", EXACT),
    ("table", "cubic", EXACT), ("table", "linear", REFUSED), ("table", "degrees", REFUSED), ("table_period", "repeat", REFUSED)]
# Words of a base, and others in their place.
REPLACED = [
    ("scaled", "scale 1.1", "matrix $place", EXACT), ("scaled", "scale 1.1", "matrix 1.1 0 0 0 0 1.1 0 0 0 0 1.2 0", REFUSED),
    ("floor", "$floor", "$deck", EXACT), ("floor", "$floor", f"{FOLDER}/floor.stl", EXACT), ("floor", "$floor", f"{FOLDER}/wider.stl", REFUSED),
    ("valued", "$steel", "1e4 3e3 5 NULL 0.5 1", EXACT), ("floor", "0.5 1 mesh", "0.5 1 limit_damping mesh", REFUSED),
    ("slips", "twisting none", "limit_damping", REFUSED), ("slips", "twisting none", "", EXACT),
    ("slips", "twisting none", "rolling none twisting none", EXACT), ("slips", "twisting none", "heat none twisting none", EXACT),
    ("slips", "twisting none", "twisting marshall", REFUSED), ("slips", "twisting none", "cohesion sjkr 100", REFUSED),
    ("springs", "heat radius 2", "heat area 800", REFUSED), ("typed", f" law types 2* {STYLE.replace('1e4', '1.2e4')}", "", REFUSED),
    ("material", "material lining with sliding_friction 0.3", "", REFUSED), ("material", "with sliding_friction 0.3", "", REFUSED),
    ("material", "types 2 rubber", "", REFUSED), ("material", "with restitution 0.5", "", EXACT),
    ("wiggle", "motion wiggle 0 0 0.01 0.5", "wiggle z 0.01 0.5", REFUSED), ("table", "$rows", f"{FOLDER}/one.txt", REFUSED),
    ("table", "$rows axis 0 0 0 0 0 1", "$period axis 0 0 0 0 0 1 repeat", REFUSED), ("servo", "force", "torque", REFUSED),
    ("table_about", "about 0 0 0", "", EXACT), ("posed", "motion caller", "", REFUSED), ("shear", "shear x 0.1", "surface_vel 0.1 0 0", EXACT),
    ("torque", "z 3", "z through 1 0 0 3", REFUSED), ("slider", "slider 0 0 1", "planar 0 0 1", REFUSED),
    ("slider", "slider 0 0 1", "ball 0 0 0", REFUSED), ("slider", "slider 0 0 1", "free", REFUSED),
    ("slider", "slider 0 0 1", "hinge 0 0 0 0 0 1", REFUSED),
    ("turning", "omega 0 0.1 0 velocity 0 0 0.02", "omega 0 0.2 0 velocity 0 0 0.04", EXACT),
    ("flying", "velocity", "joint free velocity", EXACT),
    ("slider", "gravity 0 0 -1", "", REFUSED), ("dense", "density 0.5", "density 0.5 gravity 0 0 0", EXACT),
    ("above", "gravity 0 0 -1", "gravity 0 0 -1 coat 1 0.1", REFUSED), ("above", "gravity 0 0 -1", "gravity 0 0 -1 coat auto", REFUSED),
    ("coated", "coat 1 0.1", "coat auto", REFUSED), ("about_mesh", "mesh 0 0 0", "0 0 0", REFUSED), ("about_mesh", "mesh 0 0 0", "mesh", EXACT),
    ("wears", "archard 1e-6 1e5", "finnie 1e-6", REFUSED), ("wears", "archard 1e-6 1e5", "archard 2e-6 2e5", EXACT),
    ("recedes", "deform every 3 factor 2", "", REFUSED), ("recedes", "factor 2", "", REFUSED), ("averaged", "average 8", "", REFUSED),
    ("fields", f"mesh_fields {FOLDER}/a.*.vtp every 50", "", REFUSED), ("hit", f"impact_spectrum {FOLDER}/a.*.csv every 50", "", EXACT)]
# A base, and other values of the program.
OTHER_VALUES = [
    ("another mesh", "floor", {"floor": WIDER}, REFUSED), ("the same mesh made again", "floor", {"floor": plate(4.0)}, EXACT),
    ("another number", "valued", {"steel": [1e4, 3e3, 6, None, 0.5, 1]}, REFUSED),
    ("NULL by its value", "valued", {"steel": [1e4, 3e3, 5, 2.5, 0.5, 1]}, EXACT),
    ("other rows", "table", {"rows": TABLE * 1.5}, REFUSED), ("fewer rows", "table", {"rows": TABLE[:2]}, REFUSED),
    ("rows of an angle alone", "table", {"rows": TABLE[:, :2]}, REFUSED), ("the same rows as lists", "table", {"rows": TABLE.tolist()}, EXACT)]
# Of each field of lsdcd_wall_options rows, or why there is none.
OF_OPTIONS = {
    "size": "the library's", "lo": [("boxed", {"lo": (-4.5, -4, -4)}, REFUSED)], "hi": [("boxed", {"hi": (4, 4.5, 4)}, REFUSED)],
    "periodic": [("boxed", {"periodic": (True, False, False)}, REFUSED), ("floor", {"lo": (-4, -4, -4), "hi": (4, 4, 4)}, EXACT)],
    "margin": [("boxed", {"margin": 0.7}, EXACT)], "time": [("floor", {"time": 3.0}, EXACT)],
    "show": [("floor", {"show": lambda text, warning: None}, EXACT)], "data": "handed to show", "threads": [("floor", {"threads": 2}, EXACT)],
    "host": [("floor", {"host": OneProcess()}, EXACT)], "stream": "of a device", "device": "test_python_gpu.py",
    "units": [("floor", {"units": "cgs"}, EXACT), ("material", {"units": "cgs"}, REFUSED)]}
# An input as the only one of its kind, and 0 in its place: the library has both as 0 when a wall is made.
INPUT_OR_0 = {
    "surface_vel": (on("floor", "surface_vel v_s 0 0"), on("floor")), "shear": (on("floor", "shear x v_s"), on("floor", "shear x 0")),
    "surface_angvel": (on("floor", "surface_angvel 0 0 v_s"), on("floor")),
    "pressure": (on("floor", "nodes caller pressure v_p"), on("floor", "nodes caller")),
    "temperature": (hot(WARM, "temperature v_t"), hot(WARM, "temperature 0")), "motor": (on("box", f"{SLIDER} motor v_m"), on("box", SLIDER)),
    "load": (on("box", f"{SLIDER} load v_f 0 0"), on("box", SLIDER)), "moment": (on("box", f"{HINGE} moment 0 v_t 0"), on("box", HINGE))}


def plain(words):
    """The words of a base without others."""
    return " ".join(word.split("|")[0] for word in words.split())


def has_number(word):
    """Is it a number, or what may stand in its place?"""
    return bool(re.fullmatch(r"[-+]?[\d.]+(e[-+]?\d+)?|NULL|v_\w+", word))


def place(words, at):
    """The word before a place that is no number, and how far behind it the place is."""
    before = next(k for k in range(at - 1, -2, -1) if k < 0 or not has_number(words[k]))
    return "" if before < 0 else words[before], at - before


def rows():
    for base, given in BASES.items():
        marked, words = given.split(), plain(given).split()
        for at, word in enumerate(marked):
            for other in word.split("|")[1:]:
                other_words = [*words[:at], other.lstrip("="), *words[at + 1:]]
                distance = place(words, at)[1]
                behind = " ".join(words[max(at - distance - 1, 0):at - distance + 1])
                yield Row(f"{base}: {other.lstrip('=')}, not {words[at]}, as word {distance} behind '{behind}'", base, " ".join(other_words), {}, {},
                          EXACT if other.startswith("=") else REFUSED)
    for base, more, restore in MORE:
        yield Row(f"{base}: with {more}", base, f"{plain(BASES[base])} {more}", {}, {}, restore)
    for base, was, is_, restore in REPLACED:
        words = plain(BASES[base])
        assert was in words, (base, was)
        yield Row(f"{base}: {is_ or 'nothing'}, not {was}", base, words.replace(was, is_), {}, {}, restore)
    for name, base, values, restore in OTHER_VALUES:
        yield Row(f"{base}: {name}", base, plain(BASES[base]), values, {}, restore)
    for field, given in OF_OPTIONS.items():
        for base, options, restore in [] if isinstance(given, str) else given:
            yield Row(f"{base}: option {field}, {options}", base, plain(BASES[base]), {}, options, restore)


def wall_of(words, values=None, options=None):
    """A wall whose inputs all have a value."""
    all_values = {**VALUES, **(values or {})}
    wall = lsdcd.Wall(words, values={name: value for name, value in all_values.items() if f"${name}" in words.split()}, **(options or {}))
    set_inputs(wall, words)
    return wall


def set_inputs(wall, words):
    for name in sorted(set(re.findall(r"\bv_(\w+)", words))):
        wall.set_input(name, INPUT)


def wall_of_base(base):
    return wall_of(plain(BASES[base]), None, OPTIONS.get(base))


def wall_of_row(row):
    return wall_of(row.words, row.values, {**OPTIONS.get(row.base, {}), **row.options})


# ---- what has no row ---------------------------------------------------------------------

def refusal(words):
    """What the library says of words that it refuses."""
    try:
        lsdcd.Wall.check(words, floor=FLOOR)
    except lsdcd.Error as error:
        return str(error)
    raise ValueError(f"not refused: {words}")


def keywords():
    return refusal(f"{on('floor')} no_such_keyword").split("; those are ")[1].split(", ")


def changes():
    """Words that a row changes, adds or leaves out, and those that changed words are behind: words and where."""
    names = set(keywords())
    for row in rows():
        words, other = plain(BASES[row.base]).split(), row.words.split()
        for what, i, j, k, n in difflib.SequenceMatcher(None, words, other, autojunk=False).get_opcodes():
            if what == "equal":
                continue
            yield from ((words, at) for at in range(i, j))
            yield from ((other, at) for at in range(k, n))
            if what != "insert":
                yield words, max(i - place(words, i)[1], 0)
                yield words, next((at for at in range(i, -1, -1) if words[at] in names), 0)


def changed_words():
    return {words[at] for words, at in changes()}


def changed_numbers():
    """Places of numbers that a row has changed alone."""
    return {place(words, at) for words, marked in ((plain(given).split(), given.split()) for given in BASES.values())
            for at, word in enumerate(marked) if "|" in word}


def numbers_without_row():
    there = {place(words, at) for words in (plain(given).split() for given in BASES.values()) for at, word in enumerate(words) if has_number(word)}
    return there - changed_numbers()


OF_SCRIPTS = {"contacts", "draw", "cut"}    # keywords that the library refuses
# Words of the page that no row has, and why.
NO_ROWS = {**dict.fromkeys((*OF_SCRIPTS, "edges", "faces", "contours"), "of scripts"), "cuda": "test_python_gpu.py",
           "wall/lsdcd/kk": "of LAMMPS", "fix_modify": "of LAMMPS"}


def keywords_without_row():
    """Behind `motion` wiggle and rotate are no keywords."""
    return set(keywords()) - {words[at] for words, at in changes() if words[max(at - 1, 0)] != "motion"}


def words_of_page_without_row():
    syntax = PAGE.read_text(encoding="utf-8").split("Examples\n\"\"\"", 1)[0]
    return set(re.findall(r"\*([a-z_/]+)\*", syntax)) - changed_words()


def sub_models():
    """Of each sub-model of `granular` its family, its name, and how many numbers it has."""
    law = "granular hooke 1e4 5 tangential linear_nohistory 1 0.4"
    begins = {"granular": "granular", "tangential": "granular hooke 1e4 5 tangential",
              **{family: f"{law} {family}" for family in ("damping", "rolling", "twisting", "heat", "cohesion")}}
    for family, begin in begins.items():
        for name in refusal(f"{begin} no_such_model mesh $floor").split("Syntax: ")[1].split(" ")[-1].split("|"):
            syntax = re.search(rf"must be a number.* Syntax: (?:{family} )?{name} (.*)", refusal(f"{begin} {name} no_number mesh $floor"))
            yield family, name, len(syntax[1].split(" ")) if syntax else 0


def sub_models_without_row():
    changed = {tuple(words[max(at - 1, 0):at + 1]) for words, at in changes()}
    return {f"{family} {name}" for family, name, _ in sub_models() if (family, name) not in changed}


def numbers_of_sub_models_without_row():
    return {f"{family} {name}, number {k + 1}" for family, name, n in sub_models() for k in range(n) if (name, k + 1) not in changed_numbers()}


def options_without_row():
    return {name for name, _ in _c._HEADER.structs["lsdcd_wall_options"]._fields_} ^ OF_OPTIONS.keys()
