# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Saved states against each field of lsdcd.h and each function that changes a wall: what was saved is refused, or the wall goes on
as the saved one, bit for bit, and tells the same of the last step. A field or function that is not decided fails."""
import re

import numpy as np

import lsdcd
from facts import fact
from lsdcd import _c
from wall_fields import BASES, EXACT, REFUSED, body, plate, rows, servo, spec, undecided

DT, N = 5e-4, 4


class Grains:
    """Grains of three types that press, slide and spin on a mesh about z = 0, near its edge, too, on ways of their own."""

    def __init__(self, wall=None):
        self.x = np.array([[-1.0, 0.3, 0.48], [0.5, -1.2, 0.49], [3.7, 1.9, 0.47], [0.2, 2.2, 0.49]])
        self.v = np.array([[0.2, 0.1, -0.1], [-0.3, 0, 0], [0.1, 0.2, 0], [0, 0, -0.2]])
        self.omega = 0.5 * np.cos(self.x)
        self.temperature, self.type = 300 + np.arange(N) * 1.0, np.array([1, 2, 3, 1], np.int32)

    def go(self, wall, steps):
        """Goes on, and returns all forces."""
        told = []
        for k in range(steps):
            self.x += DT * self.v
            force, torque, heat = np.zeros((N, 3)), np.zeros((N, 3)), np.zeros(N)
            wall.step(self.x, self.v, self.omega, np.full(N, 0.5), np.ones(N), force, torque, DT, temperature=self.temperature,
                      heat=heat, type=self.type)
            told.append(np.concatenate([force.ravel(), torque.ravel(), heat]))
        return np.array(told)

    def copy(self):
        other = Grains()
        for name, array in vars(self).items():
            setattr(other, name, array.copy())
        return other


def call(of, *given):
    """What a method answers, or None where it refuses."""
    try:
        return of(*given)
    except lsdcd.Error:
        return None


def asked(wall, mesh):
    """All that a wall tells of its last step."""
    answers = {"totals": wall.totals(mesh), "of all": wall.totals(), "about": wall.totals(mesh, (1, 2, 3)), "pose": wall.pose(mesh),
               "body": call(wall.body, mesh), "nodes": call(wall.nodes, mesh), "node_forces": call(wall.node_forces, mesh)}
    return {name: vars(answer) if isinstance(answer, lsdcd.WallTotals) or isinstance(answer, lsdcd.BodyState) else {"": answer}
            for name, answer in answers.items() if answer is not None}


def differing(is_, was):
    return [f"{name}.{field}".rstrip(".") for name in was for field in was[name]
            if not np.array_equal(is_[name][field], was[name][field], equal_nan=True)]


def made(change, base):
    what, options = spec(change, base)
    return lsdcd.Wall(what, **options)


def saved(base, steps=11):
    wall, grains = made({}, base), Grains()
    grains.go(wall, steps)
    return wall, grains


def goes_on(name, is_, was, grains):
    """Both walls tell the same, go on alike and save the same in the end."""
    again = grains.copy()
    told = differing(asked(is_, 0), asked(was, 0))
    fact(f"{name}: the last step is told as before", not told, told)
    both = again.go(is_, 7), grains.go(was, 7)
    fact(f"{name}: goes on bit for bit", np.array_equal(*both) and both[0].any(), abs(both[0] - both[1]).max())
    told = differing(asked(is_, 0), asked(was, 0))
    fact(f"{name}: tells the same later", not told, told)


def test_every_field_is_decided():
    fact("each field of a struct that makes a wall has a row", not undecided(), sorted(undecided()))


def test_states_of_walls():
    """A wall of the same fields takes the state, whatever it is made of."""
    for base in BASES:
        wall, grains = saved(base)
        again = made({}, base)
        again.restore(wall.save())
        again.restore(wall.save())
        fact(f"{base}: is saved as it was, also where it was restored twice", again.save().tobytes() == wall.save().tobytes())
        goes_on(base, again, wall, grains)


def test_other_fields():
    """Of a wall with another field the state is refused, or the field changes no number."""
    states = {base: saved(base) for base in {row.base for _, row in rows()}}
    for name, row in rows():
        wall, grains = states[row.base]
        state, other = wall.save(), made(row.change, row.base)
        try:
            other.restore(state)
        except lsdcd.Error as error:
            told = re.match(r"these are numbers of a different wall: (the .*)\. Make the wall of the spec", str(error))
            parts = [re.fullmatch(r"the .+? is (.*) and was (.*)", part) for part in re.split("; (?=the )", told[1])] if told else [None]
            fact(f"{name}: refused with what differs", row.restore == REFUSED and error.code == "argument" and
                 all(part and part[1] != part[2] for part in parts), error)
            continue
        fact(f"{name}: taken", row.restore == EXACT, row.change)
        if row.restore != EXACT:
            continue
        whole = made({}, row.base)
        whole.restore(state)
        goes_on(name, other, whole, grains.copy())


TILTED = plate(4.0).vertices + np.outer(plate(4.0).vertices[:, 0], (0, 0, 0.002))
# Of each function that changes a wall: the wall, what is changed, and whether the state has it, or the change is made again before.
CHANGES = {
    "lsdcd_wall_set_pose": ("posed", lambda w: w.set_pose(0, (0, 0, 0.002), velocity=(0.1, 0, 0.02), angular_velocity=(0, 0, 0.3)), True),
    "lsdcd_wall_set_nodes": ("nodes", lambda w: w.set_nodes(0, TILTED, 0.1 * TILTED), True),
    "lsdcd_wall_set_motion": ("linear", lambda w: w.set_motion(0, [lsdcd.Motion.linear((0.05, 0, 0))]), False),
    "lsdcd_wall_change": ("linear", lambda w: w.change("motion linear 0.05 0 0"), False),
    "lsdcd_wall_set_servo": ("servo", lambda w: w.set_servo(0, servo(target=25)["servo"]), False),
    "lsdcd_wall_set_body": ("slider", lambda w: w.set_body(0, body(motor=2)["body"]), False)}
MORE_CHANGES = (
    ("set_motion: none", "linear", lambda w: w.set_motion(0, []), False),
    ("set_motion: of a mesh at rest", "floor", lambda w: w.set_motion(0, [lsdcd.Motion.rotate((0, 0, 0), (0, 0, 1), 2)]), False),
    ("set_motion: beside a servo", "servo", lambda w: w.set_motion(0, [lsdcd.Motion.linear((0.05, 0, 0))]), False),
    ("set_servo: none", "servo", lambda w: w.set_servo(0, None), True),
    ("set_servo: of a mesh at rest", "floor", lambda w: w.set_servo(0, servo()["servo"]), False),
    ("set_body: limits that do not hold 0", "slider", lambda w: w.set_body(0, body(limits=(-3, -1e-6))["body"]), False))
# Others are no change of what a wall is made of.
NO_CHANGES = {"from_spec", "create", "check", "get_mesh", "set_input", "free", "step_spheres", "renumber", "pack", "unpack", "get_totals", "get_outputs",
              "get_pose", "get_node_count", "get_nodes",
              "get_node_forces", "get_contacts", "get_impacts", "get_body", "save", "restore", "restore_what_fits"}


def test_every_function_is_decided():
    there = {name for name in _c._HEADER.functions if name.startswith("lsdcd_wall_")}
    decided = set(CHANGES) | {"lsdcd_wall_" + name for name in NO_CHANGES}
    fact("each function of a wall is a change or none", there == decided, sorted(there ^ decided))


def test_changes():
    """A state after a change goes on where that change was made again, and is refused where it has to be and was not; so it is when
    the wall was changed right before it was saved, and steps before."""
    for name, base, change, in_state in [(name, *row) for name, row in CHANGES.items()] + list(MORE_CHANGES):
        for later in (0, 5):
            wall, grains = saved(base)
            change(wall)
            grains.go(wall, later)
            state, says = wall.save(), f"{name}, {later} steps later"
            bare = made({}, base)
            try:
                bare.restore(state)
                fact(f"{says}: taken without the change", in_state)
            except lsdcd.Error as error:
                fact(f"{says}: refused without the change", not in_state and "a different wall" in str(error), error)
            if in_state:
                goes_on(says, bare, wall, grains.copy())
                wall, grains = saved(base)
                change(wall)
                grains.go(wall, later)
            changed = made({}, base)
            change(changed)
            changed.restore(state)
            goes_on(f"{says}, with the change", changed, wall, grains)


def test_contacts_of_no_step():
    """Saved numbers have no contacts: a wall without a step says so."""
    wall, grains = made({"wall": {"each_contact": True}}, "floor"), Grains()
    grains.go(wall, 11)
    again = made({"wall": {"each_contact": True}}, "floor")
    again.restore(wall.save())
    try:
        fact("contacts of a restored wall are refused", False, again.contacts())
    except lsdcd.Error as error:
        fact("contacts of a restored wall are refused", "no step since it was restored" in str(error), error)
    grains.go(again, 1)
    fact("after a step it has them", len(again.contacts().force) > 0)


def test_another_window_of_means():
    """What is taken of a state with means over other steps begins a new mean, and says so. The force of step k is k N."""
    def wall_of(average, said=None):
        given = lsdcd.WallSpec(lsdcd.Law("hooke", kn=1e4, kt=0, gamman=0, gammat=0, xmu=0, dampflag=0), [lsdcd.WallMesh(plate(1.0))], average=average)
        return lsdcd.Wall(given, show=None if said is None else lambda text, warning: said.append(text))

    def go(wall, first, last):
        none = np.zeros((1, 3))
        for k in range(first, last + 1):
            wall.step(np.array([[0, 0, 0.5 - 1e-4 * k]]), none, none, np.full(1, 0.5), np.ones(1), none.copy(), none.copy(), 1e-3)
        return -wall.totals().mean_force[2]

    for before in (0, 7, 16):
        wall, said = wall_of(before), []
        go(wall, 1, 41)
        other = wall_of(8, said)
        other.restore(wall.save(), what_fits=True)
        fact(f"average 8 after {before}: there is none at first", go(other, 42, 47) == 0)
        fact(f"average 8 after {before}: the first is of the steps since", abs(go(other, 48, 48) - 45) < 1e-9)
        fact(f"average 8 after {before}: the second is whole", abs(go(other, 49, 56) - 52.5) < 1e-9)
        fact(f"average 8 after {before}: it is told", any("and this wall has 8" in text for text in said), said)


def test_stopped_motion_and_what_fits():
    """A wall whose motion was stopped stays where the mesh of the state was, and does not go back to where the motion began."""
    wall, grains = saved("linear")
    stopped = made({}, "linear")
    stopped.set_motion(0, [])
    stopped.restore(wall.save(), what_fits=True)
    grains.go(stopped, 3)
    fact("the mesh stays", np.array_equal(stopped.pose(0), wall.pose(0)), stopped.pose(0) - wall.pose(0))
