# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Misuses of the Python package's walls, by a table: a call, a wrong value, and a part of the message that refuses it. 1 s.

PYTHONPATH and LSDCD_LIBRARY name the package and its library."""

import numpy as np

import lsdcd
from facts import fact

NAN, INF = float("nan"), float("inf")
SQUARE = np.array([[-5, -5, 0], [5, -5, 0], [5, 5, 0], [-5, 5, 0]], float)
MESH = lsdcd.Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]])
WORDS = "hooke/history 1e3 300 20 7 0.5 1 mesh $floor"

# Wrong values of each kind of argument, and what is said of them beside its name.
NO_NUMBER = [(None, "is None, not a real number"), ("1", "is '1', not a real number"), (1j, "is 1j, not a real number"),
             ([1], "is [1], not a real number"), (10**400, "is beyond the range of float64")]
NUMBER = [*NO_NUMBER, (NAN, "is nan"), (INF, "is inf"), (-INF, "is -inf")]
VECTOR = [(None, "is None, not three numbers"), ("0 0 1", "not real numbers"), ((0, 0), "has the shape (2,), not (3,)"),
          ([[0, 0, 1]], "has the shape (1, 3), not (3,)"), (5, "has the shape (1,), not (3,)"), (("a", 0, 0), "not real numbers"),
          ((None, 0, 0), "not real numbers"), ((0, 0, NAN), "[2]` is nan: give a finite number"),
          ((INF, 0, 0), "[0]` is inf: give a finite number")]
FLAG = [(None, "is None, not True or False"), ("no", "is 'no', not True or False"), (2, "is 2, not True or False"),
        (-1, "is -1, not True or False"), (0.0, "is 0.0, not True or False"), ([1], "is [1], not True or False")]
WHOLE = [(None, "is None, not a whole number"), ("2", "is '2', not a whole number"), (1.5, "is 1.5, not a whole number"),
         (NAN, "is nan, not a whole number"), (2**40, "is 1099511627776, and goes from"), (-1, "is -1")]
WORD = [(None, "is None; it is '"), (5, "is 5; it is '"), (b"x", "is b'x'; it is '"), ("", "is ''; it is '"),
        ("no such", "is 'no such'; it is '")]


def wall(**options):
    return lsdcd.Wall(WORDS, floor=MESH, **options)


def walls():
    """Rows as misuses() has them."""
    yield "words", lambda b: lsdcd.Wall(b), [(None, "is null"), (3, "is 3, not a text"), (MESH, "not a text"), ("a\0b", "has a NUL in it")]
    yield "floor", lambda b: lsdcd.Wall(WORDS, floor=b), [
        ([[0, 0, 0]], "is no mesh: make one of the numbers"), (MESH.grid(), "is a Grid, not a Mesh"), ({}, "give a Mesh, numbers"), (True, "give a Mesh, numbers"),
        (np.zeros((2, 2, 2)), "is of shape (2, 2, 2)"), ("a\0b", "has a NUL in it"), ([], "has no numbers"), ([[NAN]], "is nan, not finite")]
    yield "no such.stl", lambda b: lsdcd.Wall(WORDS, floor=b), [("no such.stl", "cannot read the mesh")]
    yield "value", lambda b: lsdcd.Wall(WORDS, values=b), [({"floor": MESH, 5: 1}, "name of a value is 5, not a text"), ({}, "there is no value of this name")]
    yield "units", lambda b: wall(units=b), [(5, "is 5, not a text")]
    box = {"lo": (-9, -9, -9), "hi": (9, 9, 9)}
    for name in ("lo", "hi"):
        yield name, lambda b, name=name: wall(**{**box, name: b}), [
            (None, "give both, or neither"), ("0 0 1", "not real numbers"), ((0, 0), "has the shape (2,), not (3,)"), (5, "has the shape"),
            ((0, 0, NAN), "lo is below hi"), ((-99, 99, 0), "lo is below hi")]
    yield "periodic", lambda b: wall(**box, periodic=b), [
        (None, "is None, not (x, y, z)"), (5, "is 5, not (x, y, z)"), ("yes", "is 'yes', not (x, y, z)"), ((True,), "it is (x, y, z)"),
        ((1, 1, 2), "is 2, not True or False")]
    yield "margin", lambda b: wall(**box, periodic=(True,) * 3, margin=b), [
        *NUMBER, (0, "say how far past a face"), (-1, "say how far past a face")]
    yield "time", lambda b: wall(time=b), [*NO_NUMBER, (NAN, "both are finite"), (INF, "both are finite")]
    yield "threads", lambda b: wall(threads=b), [*WHOLE, (5000, "is 5000; it is 0 to 4096")]
    yield "device", lambda b: wall(device=b), [*WORD, ("auto", "is 'auto'; it is 'cpu' or 'cuda'")]
    yield "show", lambda b: wall(show=b), [(5, "is 5, not a function"), ("x", "is 'x', not a function")]


def calls():
    """Of a wall of one mesh that nothing moves, 'floor'."""
    floor = wall()
    mesh = [(1, "is 1; this wall has 1"), (-1, "is -1"), ("lid", "is 'lid': no mesh is called 'lid'"), (1.5, "is 1.5, not a whole number")]
    for name in ("totals", "pose", "nodes", "node_forces", "body", "set_pose"):
        yield "mesh", getattr(floor, name), mesh
    yield "about", lambda b: floor.totals(0, b), VECTOR[1:]
    yield "words", floor.change, [(None, "is null"), (5, "is 5, not a text")]
    yield "name", lambda b: floor.set_input(b, 1), [(None, "is null"), (5, "is 5, not a text")]
    yield "value", lambda b: floor.set_input("speed", b), NO_NUMBER
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
    for table in (walls, calls):
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
