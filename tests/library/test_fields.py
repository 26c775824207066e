# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Each field of lsdcd.h that makes a wall goes into it from Python, C, C++ and a script, and comes back from Wall::spec() as one value that
has changed, and nothing beside it. wall_fields.py has a row for each; LSDCD_SPEC_LINES names the library that tells of a wall."""
import ctypes
import math
import os
import pathlib
import re

import numpy as np

import lsdcd
from facts import fact
from wall_fields import ENCODED, FOLDER, LINES, law, rows, script, spec

# Of a mesh that is read and welded by the wall.
OF_A_FILE = ("mesh0.name", "mesh0.file", "mesh0.vertices", "mesh0.welded_vertices", "mesh0.weld")
ROOT = pathlib.Path(__file__).resolve().parents[2]
_lines = ctypes.CDLL(os.environ["LSDCD_SPEC_LINES"])
for name in ("spec_of_wall", "spec_by_cpp", "spec_by_words", "keyword_lines"):
    getattr(_lines, name).restype = ctypes.c_char_p


def lines(told):
    text = told.decode()
    if text.startswith("refused: "):
        raise ValueError(text)
    return dict(line.split(" = ", 1) for line in text.splitlines())


def by_library(change, base):
    """Of Python, which gives C the struct, and of C++."""
    given, options = spec(change, base)
    wall = lsdcd.Wall(given, **options)
    return lines(_lines.spec_of_wall(wall._handle)), lines(_lines.spec_by_cpp(ctypes.byref(given._struct)))


def by_script(*words):
    return lines(_lines.spec_by_words(script(*words).encode()))


def is_same(one, other):
    """Texts with the same words; of numbers the last digit may differ, as a product's of degrees."""
    pairs = list(zip(one.split(" "), other.split(" ")))
    return len(one.split(" ")) == len(other.split(" ")) and all(a == b or is_number(a) and is_number(b) and math.isclose(
        float(a), float(b), rel_tol=1e-14) for a, b in pairs)


def is_number(text):
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def wrong(says, was, is_, mine=""):
    """What of the changes is not as the row says; names of laws, which tell their numbers, are left out."""
    changed = {name: value for name, value in is_.items() if was.get(name) != value and not re.search(r"law\d+\.name$", name)
               and name.startswith(mine)}
    given = [line for line in says.split("; ") if line]
    wanted = dict(line.split(" = ", 1) for line in given if line != "...")
    missing = [f"{name} is {is_.get(name)}, not {value}" for name, value in wanted.items() if not is_same(is_.get(name, ""), value)
               or name not in changed]
    return missing + ([] if "..." in given else [f"{name} = {changed[name]}" for name in changed.keys() - wanted.keys()])


def first_rows():
    seen = {}
    for name, row in rows():
        seen.setdefault(name, row)
    return seen


def test_each_field_comes_to_the_wall():
    rows_of_fields = first_rows()
    fact("each row says what comes to the wall", rows_of_fields.keys() == LINES.keys(), rows_of_fields.keys() ^ LINES.keys())
    for name, row in rows_of_fields.items():
        says, words = LINES[name]
        try:
            (c, cpp), (was, was_cpp) = by_library(row.change, row.base), by_library({}, row.base)
        except ValueError as error:    # lsdcd.Error is one
            fact(f"{name} is taken", False, error)
            continue
        fact(f"{name} by Python and C", not wrong(says, was, c), wrong(says, was, c))
        if not name.startswith("wall_options"):
            fact(f"{name} by C++", not wrong(says, was_cpp, cpp), wrong(says, was_cpp, cpp))
        if words is not None:
            told = wrong(says, by_script(row.base), by_script(row.base, words))
            fact(f"{name} by a script", not told, (told, words))


def test_values_that_c_writes_otherwise():
    for name, (base, change, says, words) in ENCODED.items():
        (c, cpp), (was, was_cpp) = by_library(change, base), by_library({}, base)
        for how, told in (("Python and C", wrong(says, was, c)), ("C++", wrong(says, was_cpp, cpp)),
                          ("a script", wrong(says, by_script(base), by_script(base, words)))):
            fact(f"{name}, by {how}", not told, told)


def test_defaults():
    """A struct of zeros is what Python, C++ and a script leave out."""
    (c, cpp), words = by_library({"wall": {"rmax": 0.0}}, "floor"), by_script("floor", "rmax auto")
    told = wrong("", c, cpp)
    fact("defaults of C++ are those of C", not told, told)
    told = [line for line in wrong("", c, words) if line.split(" = ")[0] not in OF_A_FILE]
    fact("defaults of a script are those of C", not told, told)


def check_alike(name, words, **change):
    """A wall of the library and the words of a script make the same spec, but for a table's rows, which a script's wall reads later."""
    (c, cpp), told = by_library(change, "floor"), by_script("floor", words)
    for how, given in (("C", c), ("C++", cpp)):
        other = [f"{of} is {given.get(of)}, not {value}" for of, value in told.items() if of not in OF_A_FILE
                 and not re.search(r"law\d+\.name$|table_file$|table\.(columns|rows)$", of) and not is_same(given.get(of, ""), value)]
        fact(f"{name} by {how} is that of its words", not other, other)


def sub_model(row, damping="viscoelastic"):
    """With numbers of its ranges, each another one, and its words."""
    numbers = {}
    for k, (name, unit, (_, most)) in enumerate(zip(row.numbers, row.units, row.ranges)):
        of_damping = "e" if damping in ("tsuji", "coeff_restitution") else "eta"
        numbers[name.replace("eta|e", of_damping)] = 1 if unit == "0 or 1" else min(most, 0.3 - 0.05 * k if unit in (
            "1", "of the damping", "length") else 900 + 10 * k)
    return lsdcd.SubModel(row.name, **numbers), " ".join([row.name, *map(repr, numbers.values())])


def test_sub_models():
    """Each of them, beside a style and in a granular law, with what it needs."""
    for row in lsdcd.sub_models():
        model, words = sub_model(row, row.name)
        if row.field == "style":
            check_alike(f"the style {row.name}", f"{words} |", wall={"law": lsdcd.Law(row.name, **model.numbers), "rmax": 0.6})
            continue
        if row.beside_style and row.name != "none":
            check_alike(f"{row.field} {row.name} beside a style", f"{row.field} {words}", wall={"law": law(**{row.field: model}), "rmax": 0.6})
        damping = row.name if row.field == "damping" else "viscoelastic"
        of_damping = "e" if damping in ("tsuji", "coeff_restitution") else "eta"
        parts = {"normal": (lsdcd.SubModel("hertz/material", E=2000, nu=0.3, **{of_damping: 0.4}), "hertz/material 2000 0.4 0.3"),
                 "tangential": (lsdcd.SubModel("linear_history", kt=300, xgammat=0.5, mu=0.4), "linear_history 300 0.5 0.4")}
        parts[row.field] = (row.name, row.name) if row.field == "damping" else (model, words)
        given = {field: part for field, (part, _) in parts.items()}
        said = "granular " + " ".join(text if field == "normal" else f"{field} {text}" for field, (_, text) in parts.items())
        hot = row.field == "heat" and row.name != "none"
        check_alike(f"{row.field} {row.name}", f"{said} | {'temperature 350' if hot else ''}",
                    wall={"law": lsdcd.Law.granular(**given), "rmax": 0.6}, **({"mesh": {"temperature": 350}} if hot else {}))


def test_motions_and_placements():
    """Of each kind, several of them, tables of rows and files; placements in the order of their words."""
    motion, rows_of_table = lsdcd.Motion, np.array([[0, 0, 0, 0, 0, 0, 0], [0.005, 0, 0.1, 0.02, 0.1, 0, 0.05], [0.02, 0, 0, 0, 0, 0, 0]])
    angles = np.array([[0, 0], [0.01, 0.5], [0.02, 0]])
    arm, turn = str(FOLDER / "arm.txt"), str(FOLDER / "turn.txt")
    np.savetxt(arm, rows_of_table)
    np.savetxt(turn, angles, header="degrees", delimiter=", ")
    for words, *motions in (
            ("linear 0.1 0 0.2", motion.linear((0.1, 0, 0.2))), ("wiggle 0 0 0.01 0.3", motion.wiggle((0, 0, 0.01), 0.3)),
            ("rotate 1 2 0 0 0.6 0.8 3 motion linear 0 0 0.1", motion.rotate((1, 2, 0), (0, 0.6, 0.8), 3), motion.linear((0, 0, 0.1))),
            ("transrot 0 0 0.1 1 2 0 0 0 1 3", motion.transrot((0, 0, 0.1), (1, 2, 0), (0, 0, 1), 3)),
            ("riggle 1 2 0 0 0 1 90 3", motion.riggle((1, 2, 0), (0, 0, 1), math.pi / 2, 3)),
            *((f"table {arm} about 1 2 0 linear repeat", motion.table(given, (1, 2, 0), straight=True, repeats=True)) for given in (rows_of_table, arm)),
            *((f"table {turn} axis 1 0 0 0 1 0 degrees", motion.table(given, (1, 0, 0), (0, 1, 0), degrees=True)) for given in (angles, turn))):
        check_alike(f"motion {words}", f"motion {words}", mesh={"motions": motions})
    check_alike("a placement", "scale 0.7 -1.3 2 rotate 0.1 0.02 1 33 rotate 1 0 0 7 move 0.1 0.2 0.03", mesh={
        "placement": lsdcd.Placement().scale(0.7, -1.3, 2).rotate((0.1, 0.02, 1), 33).rotate((1, 0, 0), 7).move(0.1, 0.2, 0.03)})


def test_page_has_the_keywords():
    """The syntax, the default and the meaning of each keyword of a script."""
    page = (ROOT / "doc/fix_wall_lsdcd.rst").read_text(encoding="utf-8")
    syntax, rest = page.split("Examples\n\"\"\"", 1)
    body, defaults = rest.split("Default\n\"\"\"", 1)
    pages = body + "".join((ROOT / "doc" / name).read_text(encoding="utf-8") for name in (
        "moving_walls.rst", "bodies.rst", "contact_laws.rst", "wall_output.rst", "energy.md", "deforming_walls.md", "wear.md"))
    values = dict(re.findall(r"([a-z_]+)\s=\s([^,]+)", " ".join(defaults.split("\n.. _")[0].split())))
    for line in _lines.keyword_lines().decode().splitlines():
        name, takes, fallback = line.split("\t")
        fact(f"{name}: the page has its syntax", re.search(rf"^ *\*?{name}\*? ", syntax, re.MULTILINE) or f"{name} file" in syntax, takes)
        fact(f"{name}: the pages have its meaning", re.search(rf"[*`]{name}\b", pages), name)
        if fallback in ("none", "off", "required") or fallback.startswith("the wall's"):
            fact(f"{name}: the page has its default", name not in values or values[name] == fallback, values.get(name))
        else:
            usual = re.split(r":| beside| MB|[.]$", fallback)[0].strip()
            fact(f"{name}: the page has its default", values.get(name, "").startswith(usual), (fallback, values.get(name)))
    fact("the rest is off", "All other keywords are off." in defaults)
