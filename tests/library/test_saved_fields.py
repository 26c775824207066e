# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Saved states against each keyword of a wall and each function that changes it: what was saved is refused, or the wall goes on as the saved
one, bit for bit, and tells the same of the last step. A keyword, number, option or function that is not decided fails."""
import functools
import re

import numpy as np
import pytest

import lsdcd
from facts import fact
from lsdcd import _c
from wall_words import (BASES, EXACT, FLOOR, INPUT, INPUT_OR_0, NO_ROWS, OF_SCRIPTS, REFUSED, VALUES, keywords_without_row,
                        numbers_of_sub_models_without_row, numbers_without_row, on, options_without_row, plate, rows, set_inputs,
                        sub_models_without_row, wall_of, wall_of_base, wall_of_row, words_of_page_without_row)

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


def saved(base, steps=11):
    wall, grains = wall_of_base(base), Grains()
    grains.go(wall, steps)
    return wall, grains


@functools.lru_cache(maxsize=None)
def state_of(base):
    """What a wall has saved, and the grains then."""
    wall, grains = saved(base)
    return wall.save(), grains


def goes_on(name, is_, was, grains):
    """Both walls tell the same, go on alike and save the same in the end."""
    again = grains.copy()
    told = differing(asked(is_, 0), asked(was, 0))
    fact(f"{name}: the last step is told as before", not told, told)
    both = again.go(is_, 7), grains.go(was, 7)
    fact(f"{name}: goes on bit for bit", np.array_equal(*both) and both[0].any(), abs(both[0] - both[1]).max())
    told = differing(asked(is_, 0), asked(was, 0))
    fact(f"{name}: tells the same later", not told, told)


def says_what_differs(error):
    """Does the error of restore() have each difference, and as one?"""
    told = re.match(r"these are numbers of a different wall: (the .*)\. Make the wall as it was made", str(error))
    parts = [re.fullmatch(r"the .+? is (.*) and was (.*)", part) for part in re.split("; (?=the )", told[1])] if told else [None]
    return error.code == "argument" and all(part and part[1] != part[2] for part in parts)


# ---- all is decided ----------------------------------------------------------------------

def test_every_keyword_is_decided():
    fact("each keyword has a row", not keywords_without_row(), keywords_without_row())


@pytest.mark.parametrize("word", sorted(OF_SCRIPTS))
def test_words_of_scripts_are_refused(word):
    with pytest.raises(lsdcd.Error, match=f"'{word}' is a keyword of scripts"):
        wall_of(on("floor", word))


def test_every_word_of_the_page_is_decided():
    without = words_of_page_without_row()
    fact("each word of the page has a row, or a reason for none", without == NO_ROWS.keys(), without ^ NO_ROWS.keys())


def test_every_sub_model_is_decided():
    fact("each sub-model of each family has a row", not sub_models_without_row(), sub_models_without_row())


def test_every_number_of_a_sub_model_is_decided():
    fact("each number that the library lists has a row", not numbers_of_sub_models_without_row(), numbers_of_sub_models_without_row())


def test_every_number_is_decided():
    fact("each number of the bases has a row", not numbers_without_row(), numbers_without_row())


def test_every_option_is_decided():
    fact("each field of lsdcd_wall_options has a row", not options_without_row(), options_without_row())


def test_rows_are_there_once():
    names = [row.name for row in rows()]
    fact("no row is there twice", len(set(names)) == len(names), sorted({name for name in names if names.count(name) > 1}))


# ---- walls -------------------------------------------------------------------------------

@pytest.mark.parametrize("base", BASES)
def test_same_words(base):
    """A wall of the same words takes the state, whatever it is made of."""
    wall, grains = saved(base)
    again = wall_of_base(base)
    again.restore(wall.save())
    again.restore(wall.save())
    fact("is saved as it was, also where it was restored twice", again.save().tobytes() == wall.save().tobytes())
    goes_on(base, again, wall, grains)


@pytest.mark.parametrize("base", BASES)
def test_other_words(base):
    """Of a wall of other words the state is refused, or the words change no number."""
    for row in rows():
        if row.base != base:
            continue
        (state, grains), other = state_of(base), wall_of_row(row)
        try:
            other.restore(state)
        except lsdcd.Error as error:
            fact(f"{row.name}: refused with what differs", row.restore == REFUSED and says_what_differs(error), error)
            continue
        fact(f"{row.name}: taken", row.restore == EXACT)
        if row.restore != EXACT:
            continue
        whole = wall_of_base(base)
        whole.restore(state)
        goes_on(row.name, other, whole, grains.copy())


@pytest.mark.parametrize("name", INPUT_OR_0)
@pytest.mark.parametrize("is_, was", ((0, 1), (1, 0)), ids=("of 0", "of an input"))
def test_input_or_0(name, is_, was):
    """A state of a wall with a number where the other one has an input is refused, also where the number is 0."""
    try:
        wall_of(INPUT_OR_0[name][is_]).restore(wall_of(INPUT_OR_0[name][was]).save())
        fact("refused", False, INPUT_OR_0[name])
    except lsdcd.Error as error:
        fact("refused with what differs", says_what_differs(error), error)


def test_inputs_are_not_in_a_state():
    """A wall that was restored needs the values of its inputs before the first step, as one that was made."""
    words = on("floor", "surface_vel v_speed 0 0")
    state = wall_of(words).save()
    wall = lsdcd.Wall(words, floor=FLOOR)
    wall.restore(state)
    with pytest.raises(lsdcd.Error, match="v_speed has no value"):
        Grains().go(wall, 1)


# ---- functions that change a wall --------------------------------------------------------

IN_STATE, AGAIN, CHECKED = "the state has it", "is to be made again", "is to be made again, and the state is refused without"
TILTED = plate(4.0).vertices + np.outer(plate(4.0).vertices[:, 0], (0, 0, 0.002))
# Of each function that changes a wall: the wall, what is changed, and whether the state has it.
CHANGES = {
    "set_pose": [("posed", lambda w: w.set_pose(0, (0, 0, 0.002), velocity=(0.1, 0, 0.02), angular_velocity=(0, 0, 0.3)), IN_STATE)],
    "set_nodes": [("nodes", lambda w: w.set_nodes(0, TILTED, 0.1 * TILTED), IN_STATE)],
    "set_input": [(base, name, AGAIN) for base, name in (
        ("belt_by_inputs", "sx"), ("belt_by_inputs", "wz"), ("shear_by_input", "sx"), ("hot", "t"), ("pressed_by_input", "p"), ("pushed", "push"),
        ("body_by_inputs", "motor"), ("body_by_inputs", "fz"), ("body_by_inputs", "tx"), ("variable", "vx"), ("turn_by_inputs", "speed"))],
    "change": [("servo", "servo none", IN_STATE), *((base, words, CHECKED) for base, words in (
        ("linear", "motion linear 0.05 0 0"), ("linear", "mesh floor motion linear 0 0.05 0"), ("linear", "motion none"),
        ("floor", "motion rotate 0 0 0 0 0 1 2"), ("floor", "motion table $rows axis 0 0 0 0 0 1"),
        ("floor", "motion variable v_dx NULL NULL v_vx NULL NULL"),
        ("servo", "motion linear 0.05 0 0"), ("servo", "servo force z 25 vmax 0.2"), ("servo", "servo force z v_push vmax 0.2"),
        ("floor", "servo force z 30 vmax 0.2"), ("slider", "body motor 2"), ("slider", "body limits -3 -1e-6"), ("slider", "body load 0 0 5"),
        ("slider", "body gravity 0 0 -2"), ("slider", "body spring 30 0"), ("slider", "body moment 0 1 0"), ("slider", "body joint planar 0 0 1"),
        ("slider", "body motor v_push"), ("sliding", "body motor v_push"), ("body_by_inputs", "body motor 2")))]}


def do(function, change, wall):
    """Makes a change of CHANGES."""
    if function == "change":
        wall.change(change, **({"rows": VALUES["rows"]} if "$rows" in change else {}))
        set_inputs(wall, change)
    elif function == "set_input":
        wall.set_input(change, 4 * INPUT)
    else:
        change(wall)


def changes_to_try():
    for function, each in CHANGES.items():
        for base, change, in_state in each:
            for later in (0, 5):
                name = f"{function} of {base}{'' if callable(change) else ', ' + change}, {later} steps later"
                yield pytest.param(function, base, change, in_state, later, id=name)


# Others are no change of what a wall is made of.
NO_CHANGES = {"create", "check", "get_mesh", "free", "step_spheres", "renumber", "pack", "unpack", "get_totals", "get_outputs", "get_pose",
              "get_node_count", "get_nodes", "get_node_forces", "get_contacts", "get_impacts", "get_body", "save", "restore", "restore_what_fits"}


def test_every_function_is_decided():
    there = {name[len("lsdcd_wall_"):] for name in _c._HEADER.functions if name.startswith("lsdcd_wall_")}
    decided = CHANGES.keys() | NO_CHANGES
    fact("each function of a wall is a change or none", there == decided, sorted(there ^ decided))


@pytest.mark.parametrize("function, base, change, in_state, later", changes_to_try())
def test_changes(function, base, change, in_state, later):
    """A state after a change goes on where that change was made again, and is refused where it has to be and was not; so it is when
    the wall was changed right before it was saved, and steps before."""
    def after_change():
        wall, grains = saved(base)
        do(function, change, wall)
        grains.go(wall, later)
        return wall, grains
    wall, grains = after_change()
    state, bare = wall.save(), wall_of_base(base)
    try:
        bare.restore(state)
        fact("taken without the change", in_state != CHECKED)
    except lsdcd.Error as error:
        fact("refused without the change", in_state == CHECKED and says_what_differs(error), error)
    if in_state == IN_STATE:
        goes_on("without the change", bare, wall, grains.copy())
        wall, grains = after_change()
    changed = wall_of_base(base)
    do(function, change, changed)
    changed.restore(state)
    goes_on("with the change", changed, wall, grains)


# ---- parts of a state --------------------------------------------------------------------

def test_contacts_of_no_step():
    """Saved numbers have no contacts: a wall without a step says so."""
    wall, again, grains = wall_of(on("floor", "each_contact")), wall_of(on("floor", "each_contact")), Grains()
    grains.go(wall, 11)
    again.restore(wall.save())
    try:
        fact("contacts of a restored wall are refused", False, again.contacts())
    except lsdcd.Error as error:
        fact("contacts of a restored wall are refused", "no step since it was restored" in str(error), error)
    grains.go(again, 1)
    fact("after a step it has them", len(again.contacts().force) > 0)


@pytest.mark.parametrize("before", ("", "average 7", "average 16"))
def test_another_window_of_means(before):
    """What is taken of a state with means over other steps begins a new mean, and says so. The force of step k is k N."""
    def wall_of_means(average, said=None):
        show = None if said is None else lambda text, warning: said.append(text)
        return wall_of(f"hooke 1e4 0 0 0 0 0 mesh $floor {average}", options={"show": show})

    def go(wall, first, last):
        none = np.zeros((1, 3))
        for k in range(first, last + 1):
            wall.step(np.array([[0, 0, 0.5 - 1e-4 * k]]), none, none, np.full(1, 0.5), np.ones(1), none.copy(), none.copy(), 1e-3)
        return -wall.totals().mean_force[2]

    wall, said = wall_of_means(before), []
    go(wall, 1, 41)
    other = wall_of_means("average 8", said)
    other.restore(wall.save(), what_fits=True)
    fact("there is none at first", go(other, 42, 47) == 0)
    fact("the first is of the steps since", abs(go(other, 48, 48) - 45) < 1e-9)
    fact("the second is whole", abs(go(other, 49, 56) - 52.5) < 1e-9)
    fact("it is told", any("and this wall has 8" in text for text in said), said)


def test_stopped_motion_and_what_fits():
    """A wall whose motion was stopped stays where the mesh of the state was, and does not go back to where the motion began."""
    wall, grains = saved("linear")
    stopped = wall_of_base("linear")
    stopped.change("motion none")
    stopped.restore(wall.save(), what_fits=True)
    grains.go(stopped, 3)
    fact("the mesh stays", np.array_equal(stopped.pose(0), wall.pose(0)), stopped.pose(0) - wall.pose(0))
