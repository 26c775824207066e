# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Misuses of the Python package's walls, by a table: a call, a wrong value, and a part of the message that refuses it. 1 s.

PYTHONPATH and LSDCD_LIBRARY name the package and its library."""

import numpy as np

import lsdcd
from facts import fact
from lsdcd import Law, Motion, RigidBody, Servo, SubModel

NAN, INF = float("nan"), float("inf")
SQUARE = np.array([[-5, -5, 0], [5, -5, 0], [5, 5, 0], [-5, 5, 0]], float)
MESH = lsdcd.Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]])
HOOKE = {"kn": 1e3, "kt": 300, "gamman": 20, "gammat": 7, "xmu": 0.5, "dampflag": 1}
LAW = Law("hooke/history", **HOOKE)

# Wrong values of each kind of argument, and what is said of them beside its name.
NO_NUMBER = [(None, "is None, not a real number"), ("1", "is '1', not a real number"), (1j, "is 1j, not a real number"),
             ([1], "is [1], not a real number"), (10**400, "is beyond the range of float64")]
NUMBER = [*NO_NUMBER, (NAN, "is nan"), (INF, "is inf"), (-INF, "is -inf")]
LENGTH = [*NUMBER, (-1, "is -1: it is ")]
ABOVE_0 = [*LENGTH, (0, "is 0: it is above 0")]
PERIOD = [*NUMBER, (-1, "is -1: give a period above 0 and, to "), (0, "is 0: it is above 0")]
VECTOR = [(None, "is None, not three numbers"), ("0 0 1", "not real numbers"), ((0, 0), "has the shape (2,), not (3,)"),
          ([[0, 0, 1]], "has the shape (1, 3), not (3,)"), (5, "has the shape (1,), not (3,)"), (("a", 0, 0), "not real numbers"),
          ((None, 0, 0), "not real numbers"), ((0, 0, NAN), "[2]` is nan: give a finite number"),
          ((INF, 0, 0), "[0]` is inf: give a finite number")]
DIRECTION = [*VECTOR, ((0, 0, 0), "is 0 0 0: give a direction")]
FLAG = [(None, "is None, not True or False"), ("no", "is 'no', not True or False"), (2, "is 2, not True or False"),
        (-1, "is -1, not True or False"), (0.0, "is 0.0, not True or False"), ([1], "is [1], not True or False")]
WHOLE = [(None, "is None, not a whole number"), ("2", "is '2', not a whole number"), (1.5, "is 1.5, not a whole number"),
         (NAN, "is nan, not a whole number"), (2**40, "is 1099511627776, and goes from"), (-1, "is -1")]
WORD = [(None, "is None; it is '"), (5, "is 5; it is '"), (b"x", "is b'x'; it is '"), ("", "is ''; it is '"),
        ("no such", "is 'no such'; it is '")]
LIMITS = [(5, "is 5, not (lo, hi)"), ("12", "is '12', not (lo, hi)"), ((1,), "is (1,); it is (lo, hi)"),
          ((1, 2, 3), "is (1, 2, 3); it is (lo, hi)"), (("a", "b"), "is 'a', not a real number"), ((0, 0), "is (0, 0), between which")]
LIST = [(None, "is None, not a list"), (5, "is 5, not a list"), ("text", "is 'text', not a list")]
FILE = [(5, "is 5, not (name, steps)"), ("a.vtp", "is 'a.vtp', not (name, steps)"), (("a",), "is ('a',); it is (name, steps)"),
        ((None, 1), "is (None, 1); it is (name, steps)"), (("", 1), "is ('', 1); it is (name, steps)"),
        (("a.xyz", 1), "must end in"), (("a\0.stl", 1), "has a NUL in it"), ((5, 1), "is 5, not a text")]


def spec(law=LAW, whole=None, **part):
    return lsdcd.WallSpec(law, [lsdcd.WallMesh(MESH, **part)], **(whole or {}))


def wall(law=LAW, whole=None, **part):
    return lsdcd.Wall(spec(law, whole, **part))


def granular(normal=None, tangential=None, damping="tsuji"):
    """A wall of this law, of which some numbers are others."""
    return wall(Law.granular(SubModel("hertz/material", **{"E": 2000, "e": 0.5, "nu": 0.3, **(normal or {})}),
                             SubModel("mindlin", **{"kt": 1, "xgammat": 1, "mu": 0.5, **(tangential or {})}), damping))


def moved(*motions):
    return wall(motions=motions)


def body(**given):
    return wall(body=RigidBody(**{"mass": 1, "inertia": (1, 1, 1, 0, 0, 0), **given}))


def slider(**given):
    return body(joint="slider", axis=(0, 0, 1), **given)


def laws():
    """Rows as misuses() has them."""
    style = lambda name: lambda b: wall(Law("hooke/history", **{**HOOKE, name: b}))    # noqa: E731
    yield "kn", style("kn"), [*NO_NUMBER[1:], (None, "needs the number kn"), (NAN, "is a finite number"), (INF, "is a finite number"), (-1, "is -1: kn of ")]
    for name in ("kt", "gammat"):
        yield name, style(name), [*NO_NUMBER[1:], (NAN, "is a finite number"), (-1, "is -1; it is 0 or more, or None"),
                                  (-2, f"is -2: {name} of ")]
    for name in ("gamman", "xmu"):
        yield name, style(name), [*NO_NUMBER[1:], (None, f"needs the number {name}"), (NAN, "is a finite number"), (-1, f"is -1: {name} of ")]
    yield "dampflag", style("dampflag"), [*NO_NUMBER[1:], (None, "needs the number dampflag"), (2, "is 2: dampflag of "), (0.5, "is 0.5: dampflag of ")]
    yield "style", lambda b: wall(Law(b, **HOOKE)), [("no such", "is 'no such'; a style goes with"), ("", "is ''; a style goes with")]
    yield "name of a sub-model", lambda b: wall(Law(b, **HOOKE)), [(None, "is None, not a text"), (5, "is 5, not a text")]
    yield "limit_damping", lambda b: wall(Law("hooke/history", limit_damping=b, **HOOKE)), FLAG
    yield "rolling", lambda b: wall(Law("hooke/history", rolling=b, **HOOKE)), [
        (5, "is 5, not a SubModel"), ("cdt", "is 'cdt', not a SubModel"), (SubModel("marshall"), "is 'marshall'; a style goes"),
        (SubModel("cdt", MU=-1), "is -1: MU of ")]
    yield "cdt", lambda b: wall(Law("hooke/history", rolling=b, **HOOKE)), [
        (SubModel("cdt"), "needs the number MU"), (SubModel("cdt", mu=1), "needs the number MU"),
        (SubModel("cdt", MU=1, mu=1), "has no number mu")]
    yield "cohesion", lambda b: wall(Law("hooke/history", cohesion=b, **HOOKE)), [
        (5, "is 5, not a SubModel"), (SubModel("cdt", MU=1), "is 'cdt'; a style goes"), (SubModel("sjkr", K=-1), "is -1: K of ")]
    for name in ("E", "e", "nu"):
        yield name, lambda b, name=name: granular({name: b}), [*NO_NUMBER[1:], (None, "needs the number"), (NAN, "is a finite number"),
                                                              (-2, "is -2: ")]
    for name in ("kt", "xgammat", "mu"):
        yield name, lambda b, name=name: granular(None, {name: b}), [*NO_NUMBER[1:], (NAN, "is a finite number"), (-2, "is -2: ")]
    yield "damping", lambda b: granular(damping=b), [("no such", "is 'no such'; a normal sub-model goes with")]
    yield "law", lambda b: spec(b), [(None, "is None, not a Law"), (5, "is 5, not a Law"), ("hooke", "is 'hooke', not a Law")]


def motions():
    for name, call, rows in (
            ("velocity", lambda b: Motion.linear(b), VECTOR), ("amplitude", lambda b: Motion.wiggle(b, 1), VECTOR),
            ("amplitude", lambda b: Motion.cosine(b, 1), VECTOR), ("period", lambda b: Motion.wiggle((0, 0, 1), b), PERIOD),
            ("point", lambda b: Motion.rotate(b, (0, 0, 1), 1), VECTOR), ("axis", lambda b: Motion.rotate((0, 0, 0), b, 1), DIRECTION),
            ("period", lambda b: Motion.rotate((0, 0, 0), (0, 0, 1), b), PERIOD),
            ("velocity", lambda b: Motion.transrot(b, (0, 0, 0), (0, 0, 1), 1), VECTOR),
            ("angle", lambda b: Motion.riggle((0, 0, 0), (0, 0, 1), b, 1), NUMBER),
            ("straight", lambda b: Motion.table([[0, 0, 0, 0], [1, 0, 0, 1]], straight=b), FLAG),
            ("repeats", lambda b: Motion.table([[0, 0, 0, 0], [1, 0, 0, 1]], repeats=b), FLAG),
            ("degrees", lambda b: Motion.table([[0, 0, 0, 0], [1, 0, 0, 1]], degrees=b), FLAG),
            ("axis", lambda b: Motion.table([[0, 0], [1, 1]], axis=b), [((0, 0, 0), "is 0 0 0: give a direction")]),
            ("axis", lambda b: Motion.table([[0, 0, 0, 0], [1, 1, 1, 1]], axis=b), [((0, 0, 1), "a table without angles about an axis")]),
            ("rows", lambda b: Motion.table(b), [
                (None, "not real numbers"), (5, "has the shape ()"), ([], "has the shape (0,)"), ([[0]], "there is 1 number in a row"),
                (np.zeros((2, 3)), "there are 3 numbers in a row"), ([[0, 0, 0, 0]], "there is one row, and a motion needs two or more"),
                ([[1, 0, 0, 0], [0, 1, 1, 1]], "row 1: the time 0 is not after"),
                ([[0, 0, 0, NAN], [1, 0, 0, 0]], "row 0: "), ([["a", 0, 0, 0], [1, 0, 0, 0]], "not real numbers"),
                ([[0] * 8, [1] + [0] * 7], "row 0: "), ("a\0b", "has a NUL in it")]),
            ("table", lambda b: Motion.table(b), [("no such file", "cannot read the table 'no such file'")])):
        yield name, lambda b, call=call: moved(call(b)), rows
    yield "motions", lambda b: wall(motions=b), [*LIST, (["linear"], "[0] is 'linear', not a Motion"), ([LAW], "[0] is Law(")]
    for name, call, rows in (
            ("axis", lambda b: Servo(b, 1, 1), DIRECTION), ("target", lambda b: Servo((0, 0, 1), b, 1), NUMBER),
            ("max_speed", lambda b: Servo((0, 0, 1), 1, b), ABOVE_0), ("turns", lambda b: Servo((0, 0, 1), 1, 1, turns=b), FLAG),
            ("point", lambda b: Servo((0, 0, 1), 1, 1, turns=True, point=b), VECTOR),
            ("point", lambda b: Servo((0, 0, 1), 1, 1, point=b), [((0, 0, 1), "a servo that does not turn does not use it")]),
            ("max_gain", lambda b: Servo((0, 0, 1), 1, 1, max_gain=b), [*NUMBER[1:], (0, "is 0; it is above 0"), (-1, "is -1: it is ")]),
            ("limits", lambda b: Servo((0, 0, 1), 1, 1, limits=b), LIMITS),
            ("lo", lambda b: Servo((0, 0, 1), 1, 1, limits=b), [((1, 2), "is 1: it is 0 or less"), ((NAN, 1), "is nan")]),
            ("hi", lambda b: Servo((0, 0, 1), 1, 1, limits=b), [((-2, -1), "is -1: it is 0 or more"), ((-1, INF), "is inf")])):
        yield name, lambda b, call=call: wall(servo=call(b)), rows
    yield "servo", lambda b: wall(servo=b), [(5, "is 5, not a Servo"), (LAW, "not a Servo"), (Servo, "not a Servo")]


def bodies():
    yield "mass", lambda b: body(mass=b), [*NO_NUMBER, (NAN, "nan"), (-1, "-1"), (0, "a mass of 0 is not above 0")]
    yield "density", lambda b: body(density=b), [*NO_NUMBER, (1, "is 1: the body has the mass 1, too"), (NAN, "is nan")]
    yield "motor", lambda b: slider(motor=b), [*NO_NUMBER, (NAN, "nan")]
    yield "motor", lambda b: body(motor=b), [(1, "works only with a joint hinge or slider")]
    for name in ("centre", "load", "moment", "velocity", "angular_velocity", "gravity"):
        yield name, lambda b, name=name: body(**{name: b}), VECTOR
    yield "axis", lambda b: body(joint="slider", axis=b), DIRECTION
    yield "point", lambda b: body(joint="ball", point=b), VECTOR
    yield "axis", lambda b: body(axis=b), [((0, 0, 1), "is 1: this joint does not use it"), ((0, NAN, 0), "this joint does not use it")]
    yield "point", lambda b: slider(point=b), [((0, 0, 1), "is 1: this joint does not use it")]
    yield "inertia", lambda b: body(inertia=b), [
        (None, "is None, not six numbers"), ("x", "not real numbers"), ((1, 1, 1), "has the shape (3,), not (6,)"),
        ((1, 1, 5, 0, 0, 0), "no body has the principal moments"), ((NAN, 1, 1, 0, 0, 0), "is nan 1 1, which is not finite"), ((0,) * 6, "no body has the principal moments")]
    yield "joint", lambda b: body(joint=b), WORD
    yield "spring", lambda b: slider(spring=b), [
        (None, "is None, not (stiffness, damping, rest)"), (5, "is 5, not (stiffness"), ((1,), "is (1,); it is (stiffness")]
    for name, values in (("stiffness", (-1, 0, 0)), ("stiffness", (NAN, 0, 0)), ("damping", (1, -1, 0)), ("stiffness", ("a", 0, 0))):
        yield name, lambda b: slider(spring=b), [(values, "is")]
    yield "spring", lambda b: body(spring=b), [((1, 0, 0), "works only with a joint hinge or slider")]
    yield "limits", lambda b: slider(limits=b), [*LIMITS, ((1, -1), "are reversed")]
    yield "limits", lambda b: body(limits=b), [((-1, 1), "works only with")]
    yield "coat", lambda b: body(coat=b), [
        (None, "is None, not (spacing, radius)"), (5, "is 5, not (spacing, radius)"), ("yes", "is 'yes', not (spacing"),
        ((1,), "is (1,); it is (spacing, radius)"), ((0, 1), "is (0, 1); spacing and radius are above 0"),
        (True, "feels other meshes")]
    yield "body", lambda b: wall(body=b), [(5, "is 5, not a RigidBody"), (MESH, "not a RigidBody")]
    yield "body", lambda b: wall(body=RigidBody(mass=1, inertia=(1, 1, 1, 0, 0, 0)), **b), [
        ({"posed_by_caller": True}, "a body moves by what acts on it"), ({"motions": [Motion.linear((0, 0, 1))]}, "a body moves by what"),
        ({"servo": Servo((0, 0, 1), 1, 1)}, "a body moves by what acts on it")]


def meshes():
    yield "mesh", lambda b: lsdcd.WallMesh(b), [(None, "is None, not a Mesh"), ("wall.stl", "is 'wall.stl', not a Mesh"),
                                                (MESH.grid(), "not a Mesh")]
    yield "name", lambda b: wall(name=b), [(5, "is 5, not a text"), ("a\0b", "has a NUL in it")]
    yield "placement", lambda b: wall(placement=b), [
        (5, "has the shape"), ("x", "not real numbers"), (np.zeros((3, 3)), "has the shape (3, 3), not (3, 4)"),
        (np.zeros((3, 4)), "is all 0"), (np.full((3, 4), NAN), "[0]` is nan"), (np.ones((3, 4)), "the determinant 0")]
    other, hertz = Law("hooke", **HOOKE), Law("hertz/history", **HOOKE)
    yield "law", lambda b: lsdcd.Wall(lsdcd.WallSpec(LAW, [lsdcd.WallMesh(MESH, law=b)])), [
            (5, "is 5, not a Law"), ("hooke", "is 'hooke', not a Law"), (other, "it has the sub-models hooke, and the wall has hooke/history"),
            (hertz, "it has the sub-models hertz/history")]
    yield "type_laws", lambda b: wall(type_laws=b), [
        *LIST, ([5], "[0] is 5, not (first, last, law)"), ([(1, LAW)], "it is (first, last, law)"), ([(1, 0, LAW)], "is 0; types count from 1"),
        ([(0, 1, LAW)], "first_type` is 0: types count from 1"), ([(2, 1, LAW)], "last_type` is 1: it is at least first_type, 2"),
        ([(1, 2, "x")], "[0] is 'x', not a Law"), ([(1, 2, other)], "it has the sub-models hooke")]
    yield "first_type", lambda b: wall(type_laws=b), [([(1.5, 2, LAW)], "is 1.5, not a whole number"), ([("a", 2, LAW)], "is 'a', not a")]
    for name in ("posed_by_caller", "torque_about_moves", "nodes_by_caller"):
        yield name, lambda b, name=name: wall(**{name: b}), FLAG
    for name in ("surface_velocity", "surface_angular_velocity", "surface_centre", "torque_about"):
        yield name, lambda b, name=name: wall(**{name: b}), VECTOR
    yield "temperature", lambda b: wall(temperature=b), [*NUMBER, (300, "a temperature is given, but no sub-model heat uses it")]
    yield "wear_factor", lambda b: wall(wear_factor=b), [
        *NO_NUMBER, (-1, "is -1; it is above 0"), (2, "a factor is given, but nothing wears"), (0, "a factor is given, but nothing wears")]
    yield "pressure", lambda b: wall(pressure=b), [*NUMBER, (1, "it acts on nodes, and the mesh has none")]
    yield "cache", lambda b: wall(cache=b), [(5, "is 5, not a text"), ("a\0b", "has a NUL in it")]
    yield "cache", lambda b: wall(cache=b, nodes_by_caller=True), [("a.grid", "is made again as its nodes move")]
    for name, end in (("fields", "vtp"), ("stl", "stl")):
        yield name, lambda b, name=name: wall(**{name: b}), FILE
        yield name + "_every", lambda b, name=name: wall(**{name: b}), [
            (("a." + end, 0), "is 0: it is a number of steps"), (("a." + end, -1), "is -1: it is a number of steps"),
            (("a." + end, 1.5), "is 1.5, not a whole number"), (("a." + end, None), "is None, not a whole number")]
    yield "nodes_by_caller", lambda b: wall(nodes_by_caller=True, **b), [
        ({"posed_by_caller": True}, "its nodes alone move such a mesh"), ({"motions": [Motion.linear((0, 0, 1))]}, "its nodes alone"),
        ({"servo": Servo((0, 0, 1), 1, 1)}, "its nodes alone move"), ({"whole": {"nearest": 2}}, "has no lists of the nearest")]
    yield "torque_about_moves", lambda b: wall(nodes_by_caller=True, torque_about_moves=b), [(True, "has no frame in which a point")]
    yield "posed_by_caller", lambda b: wall(posed_by_caller=True, **b), [
        ({"motions": [Motion.linear((0, 0, 1))]}, "the poses of the program alone"), ({"servo": Servo((0, 0, 1), 1, 1)}, "the poses of the")]


def walls():
    whole = lambda name: lambda b: wall(whole={name: b})    # noqa: E731
    one, lifted = lsdcd.WallMesh(MESH), lambda k: lsdcd.WallMesh(MESH, placement=lsdcd.Placement().move(0, 0, k))    # noqa: E731
    yield "meshes", lambda b: lsdcd.Wall(lsdcd.WallSpec(LAW, b)), [
        *LIST, (MESH, "not a list"), (one, "not a list"), ([MESH], "[0] is <Mesh"), ([], "there are 0 meshes, and a wall has 1 to 32"),
        ([one, one], "it is that of meshes[0] at the same place"), ([lifted(k) for k in range(33)], "there are 33 meshes")]
    for name in ("corner", "side", "compute"):
        yield name, whole(name), WORD
    yield "nearest", whole("nearest"), [*WHOLE, (33, "is 33: it is 0 for all, or 1 to 32")]
    for name in ("cell", "rmax", "memory"):
        yield name, whole(name), LENGTH
    yield "wear", whole("wear"), [
        (5, "is 5; it is (\"archard\", K, H)"), ("archard", "is 'archard'; it is"), ((), "is (); it is"), (("archard", 1), "it is (\"archard\", K, H)"),
        (("erosion", 1), "it is (\"archard\", K, H) or"), (("finnie", 1, 2), "it is (\"finnie\", K)"), (("finnie", "a"), "is 'a', not a real")]
    yield "wear_coefficient", whole("wear"), [(("archard", -1, 1), "is -1: it is 0 or more"), (("archard", NAN, 1), "is nan"),
                                              (("finnie", -1), "is -1: it is 0 or more")]
    yield "hardness", whole("wear"), [(("archard", 1, 0), "is 0: it is above 0"), (("archard", 1, -1), "is -1: it is above 0")]
    yield "wear_deform", lambda b: wall(whole={"wear": ("finnie", 1), "wear_deform": b}), [
        (5, "is 5, not (steps, factor)"), ((1,), "is (1,); it is (steps, factor)"), ((0, 1), "both above 0"), ((-1, 1), "both above 0"),
        ((1.5, 1), "is 1.5, not a whole number"), ((1, 0), "both above 0"), ((1, -1), "both above 0"), ((1, NAN), "both above 0"),
        (("a", 1), "is 'a', not a whole number"), ((1, None), "is None, not a real number")]
    yield "wear_deform_every", whole("wear_deform"), [((3, 1), "wear should move the meshes, but nothing wears")]
    for name in ("periodic_ends", "brief", "each_contact"):
        yield name, whole(name), FLAG
    yield "average", whole("average"), WHOLE
    made, box = spec(), {"lo": (-9, -9, -9), "hi": (9, 9, 9)}
    yield "spec", lambda b: lsdcd.Wall(b), [(None, "is None, not a WallSpec"), (3, "is 3, not a WallSpec"), (LAW, "not a WallSpec")]
    for name in ("lo", "hi"):
        yield name, lambda b, name=name: lsdcd.Wall(made, **{**box, name: b}), [
            (None, "give both, or neither"), ("0 0 1", "not real numbers"), ((0, 0), "has the shape (2,), not (3,)"), (5, "has the shape"),
            ((0, 0, NAN), "lo is below hi"), ((-99, 99, 0), "lo is below hi")]
    yield "periodic", lambda b: lsdcd.Wall(made, **box, periodic=b), [
        (None, "is None, not (x, y, z)"), (5, "is 5, not (x, y, z)"), ("yes", "is 'yes', not (x, y, z)"), ((True,), "it is (x, y, z)"),
        ((1, 1, 2), "is 2, not True or False")]
    yield "margin", lambda b: lsdcd.Wall(made, **box, periodic=(True,) * 3, margin=b), [
        *NUMBER, (0, "say how far past a face"), (-1, "say how far past a face")]
    yield "time", lambda b: lsdcd.Wall(made, time=b), [*NO_NUMBER, (NAN, "both are finite"), (INF, "both are finite")]
    yield "threads", lambda b: lsdcd.Wall(made, threads=b), [*WHOLE, (5000, "is 5000; it is 0 to 4096")]
    yield "device", lambda b: lsdcd.Wall(made, device=b), [*WORD, ("auto", "is 'auto'; it is 'cpu' or 'cuda'")]
    yield "show", lambda b: lsdcd.Wall(made, show=b), [(5, "is 5, not a function"), ("x", "is 'x', not a function")]


def calls():
    """Of a wall of one mesh that nothing moves, 'floor'."""
    floor = wall(name="floor")
    mesh = [(1, "is 1; this wall has 1"), (-1, "is -1"), ("lid", "is 'lid', which no mesh is called"), (1.5, "is 1.5, not a whole number")]
    for name in ("totals", "pose", "nodes", "node_forces", "body", "set_pose"):
        yield "mesh", getattr(floor, name), mesh
    yield "mesh", lambda b: floor.set_motion(b, []), mesh
    yield "mesh", lambda b: floor.set_servo(b, None), mesh
    yield "about", lambda b: floor.totals(0, b), VECTOR[1:]
    yield "motions", lambda b: floor.set_motion(0, b), [*LIST, ([5], "[0] is 5, not a Motion")]
    yield "servo", lambda b: floor.set_servo(0, b), [(5, "is 5, not a Servo")]
    yield "body", lambda b: floor.set_body(0, b), [(5, "is 5, not a RigidBody"), (None, "is None, not a RigidBody"),
                                                   (RigidBody(1), "is not a body")]
    yield "posed", lambda b: floor.set_pose(0, b), [((0, 0, 1), "is not posed by the caller")]
    yield "numbers", floor.restore, [([], "these are not the numbers that"), ([1, 2, 3], "these are not"), ("x", "not real numbers"), ([NAN] * 9, "these are not")]
    one = {**{k: np.zeros((1, 3)) for k in ("x", "v", "omega", "force", "torque")}, "radius": np.ones(1), "mass": np.ones(1), "dt": 1e-3}
    step = lambda name: lambda b: floor.step(**{**one, name: b})    # noqa: E731
    for name in ("x", "v", "omega", "force", "torque"):
        yield name, step(name), [(wrong, "is not a contiguous float64 array of shape (1, 3)") for wrong in (
            None, np.zeros((2, 3)), np.zeros(3), np.zeros((1, 3), complex), "x")]
    for name in ("x", "v", "omega"):
        yield name, step(name), [(np.full((1, 3), NAN), "which is not finite")]
    for name in ("radius", "mass"):
        yield name, step(name), [(np.full(1, -1.0), "is -1"), (np.full(1, NAN), "is nan"), (np.zeros((1, 2)), "is not a contiguous float64 array of shape (1,)")]
    yield "dt", step("dt"), [*NO_NUMBER, (0, "is 0, not above 0"), (-1, "is -1, not above 0"), (NAN, "is nan, not above 0")]
    for name in ("setup", "changed", "synchronous"):
        yield name, step(name), FLAG
    yield "reach", step("reach"), [*NO_NUMBER, (-1, "is -1, below 0"), (NAN, "is nan, below 0")]


def misuses():
    """What is called wrongly, a call of one value, and wrong values with parts of what is said of them."""
    for table in (laws, motions, bodies, meshes, walls, calls):
        yield from table()


def test_misuses():
    for name, call, rows in misuses():
        for value, part in rows:
            try:
                call(value)
                told = "it is accepted"
            except (TypeError, ValueError) as error:
                told = str(error)
                if part in told and name in told:
                    continue
            except Exception as error:    # of no kind that a user expects
                told = repr(error)
            fact(f"{name} as {value!r} is refused", False, f"not {part!r} but: {told}")
