# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Wrong walls by each keyword, of which the library says what the fix says: words that are cut, missing, misspelt, out of range, twice, before their
mesh, beside words that exclude them. LSDCD_WRONG_WALLS says how many (400); each kind of wrong word has some of each keyword."""
import itertools
import json
import os
import random
import re

import pytest

import fix_refusals
import lsdcd
from facts import fact
from test_words import BEGIN, LAWS, STYLE, needs_lmp, run, write_meshes
from wall_words import OF_SCRIPTS, keywords

WALLS = int(os.environ.get("LSDCD_WRONG_WALLS", "400"))

# Right words of each keyword, from which wrong ones are made.
RIGHT = {
    "mesh": ("mesh block.stl",), "name": ("name part",), "scale": ("scale 2", "scale 1 2 3"), "rotate": ("rotate 0 0 1 30",), "move": ("move 0 0 1",),
    "matrix": ("matrix 1 0 0 0.5 0 1 0 0 0 0 2 0",), "weld": ("weld 1e-6",), "cache": ("cache grid.bin", "cache none"),
    "motion": ("motion linear 0.1 0 0", "motion wiggle 0 0 0.1 2", "motion rotate 0 0 0 0 0 1 2", "motion transrot 0 0 0.1 0 0 0 0 0 1 2",
               "motion variable v_x NULL NULL v_y NULL NULL", "motion rotate 0 0 0 0 0 1 variable v_x v_y", "motion riggle 0 0 0 0 0 1 5 2",
               "motion table lever.txt axis 0 0 0 0 0 1 cubic repeat degrees", "motion table lever.txt about 0 0 0 linear"),
    "wiggle": ("wiggle z 0.1 2",), "shear": ("shear x 0.5", "shear y v_x"), "surface_vel": ("surface_vel 1 0 0", "surface_vel v_x v_y 0"),
    "surface_angvel": ("surface_angvel 0 0 1", "surface_angvel v_x 0 0 1 2 3"),
    "servo": ("servo force z 25 vmax 0.5 gain 1 limits -1 2", "servo torque axis 0 0 1 through 0 0 0 v_x vmax 2"),
    "body": ("body mass 3 com 0 0 0 inertia 2 2.5 3 0 0 0.1 velocity 0 0 0.5 omega 0.1 0.2 0 coat no",
             "body mass 1 com 0 0 0 inertia 1 1 1 0 0 0 joint hinge 0 0 0 0 1 0 motor 0.5 limits -1 1 gravity 0 0 -1",
             "body mass 1 com 0 0 0 inertia 1 1 1 0 0 0 joint slider 0 0 1 spring 100 1 0.5 load 0 v_x 3 moment 0 0 v_y",
             "body mass 1 com 0 0 0 inertia 1 1 1 0 0 0 joint planar 0 0 1 coat 0.5 0.25", "body density 2 joint ball 0 0 0"),
    "nodes": ("nodes all",), "pressure": ("pressure 5", "pressure v_x"), "wear_factor": ("wear_factor 2",),
    "wear": ("wear archard 1e-3 1e3", "wear finnie 1e-6 deform every 10 factor 2"), "law": (f"law {STYLE}", f"law types 1*2 {STYLE}"),
    "temperature": ("temperature 300", "temperature v_x"), "rolling": ("rolling sds 100 1 0.1", "rolling epsd3 0.1 0.2 2.25"), "cohesion": ("cohesion sjkr 10",),
    "corner": ("corner sum",), "mesh_fields": ("mesh_fields a.vtp every 5",), "impact_spectrum": ("impact_spectrum a.csv every 5",),
    "mesh_stl": ("mesh_stl a.stl every 5",), "torque_about": ("torque_about 0 0 1", "torque_about mesh 0 0 1"), "contacts": ("contacts",),
    "each_contact": ("each_contact",), "average": ("average 5",), "energy": ("energy",), "friction_heat": ("friction_heat 0.5",), "impacts": ("impacts 0.1",), "coarse_grain": ("coarse_grain 2",),
    "log": ("log brief",), "draw": ("draw faces 1",), "cut": ("cut 0 0 1 0.5",), "device": ("device cpu",), "grid": ("grid 0.5", "grid auto"), "rmax": ("rmax 0.75",),
    "memory": ("memory 64",), "nearest": ("nearest 3", "nearest all"), "side": ("side both",), "periodic": ("periodic",)}
# Numbers in the place of one, most of which are none there.
NUMBERS = ("x", "nan", "1e999", "0x10", "-1", "0", "0.5", "1e300", "v_", "v_x", "NULL")

# What the library has in the place of LAMMPS's words: patterns of the fix's text, and what is there.
OF_LAMMPS = (
    (r"fix wall/lsdcd", "wall"),    # the command
    (r"(?<=; those are )(.*)contacts, draw, cut, (.*)", r"\1\2, shapes"),    # keywords of scripts, and of programs
    (r"Syntax: motion ", "Syntax: motion caller | "), (r"Syntax: nodes GROUP", "Syntax: nodes caller"),    # what each moves a mesh by
    (r"'motion linear", "'motion caller | linear"), (r"'nodes GROUP'", "'nodes caller'"))
# What one of both alone refuses: the fix, as LAMMPS is old, has two types of atoms, and a box; the library, as LAMMPS alone has the word.
OF_FIX_ALONE = ("the sub-model heat needs a LAMMPS with fix heat/flow", "there is no atom type", "the mesh is outside the box")
OF_LIBRARY_ALONE = (*(f"'{word}' is a keyword of scripts" for word in OF_SCRIPTS), "in 'nodes', a program has no groups of atoms: write nodes caller")


def is_number(word):
    return bool(re.fullmatch(r"[-+]?[\d.]+(e[-+]?\d+)?", word))


def misspelt(word):
    """With a letter less, one more, two swapped, and something else."""
    return [word[:-1], word + "s", word[1] + word[0] + word[2:], "nothing_like_it"] if len(word) > 1 else [word + "s", "nothing_like_it"]


def wrong_values(words):
    """The words of a keyword with fewer of them, one more, and others in their places: what is wrong, and the words."""
    for n in range(1, len(words)):
        yield "too few words", words[:n]
        yield "too few words before another keyword", [*words[:n], "grid", "0.5"]
    yield "one more number", [*words, "7"]
    yield "one more word", [*words, "word"]
    for k in range(1, len(words)):
        others = NUMBERS if is_number(words[k]) or words[k].startswith("v_") else misspelt(words[k])
        for other in others:
            yield "another number" if others is NUMBERS else "another word", [*words[:k], other, *words[k + 1:]]
        yield "without a word", words[:k] + words[k + 1:]


def wrong_laws():
    for law in (*LAWS, f"{STYLE} limit_damping", "granular hooke 1000 20 tangential linear_history 300 1 0.4 heat area 5 cohesion sjkr 10"):
        for what, words in wrong_values(law.split()):
            yield f"law: {what}", f"{' '.join(words)} mesh floor.stl"
        for word in misspelt(law.split()[0]):
            yield "law: another style", f"{law.replace(law.split()[0], word, 1)} mesh floor.stl"
        yield "law: no mesh", law


def wrong_keywords():
    for keyword, examples in RIGHT.items():
        for example in examples:
            yield f"{keyword}: alone", f"{STYLE} mesh floor.stl {example}"
            for what, words in wrong_values(example.split()):
                yield f"{keyword}: {what}", f"{STYLE} mesh floor.stl {' '.join(words)}"
            yield f"{keyword}: twice", f"{STYLE} mesh floor.stl {example} {example}"
            yield f"{keyword}: of granular", f"{LAWS[3]} mesh floor.stl {example}"
            yield f"{keyword}: of the second mesh", f"{STYLE} mesh floor.stl mesh floor.stl move 0 0 3 {example} {example}"
        for word in misspelt(keyword)[:-1]:
            yield f"{keyword}: misspelt", f"{STYLE} mesh floor.stl {word} {examples[0].split(maxsplit=1)[-1]}"
        yield f"{keyword}: before its mesh", f"{STYLE} {examples[0]} mesh floor.stl mesh floor.stl move 0 0 3"
        yield f"{keyword}: without a mesh", f"{STYLE} {examples[0]}"
    for one, other in itertools.combinations([examples[0] for examples in RIGHT.values()], 2):
        yield f"{one.split()[0]}: beside others", f"{STYLE} mesh block.stl {one} {other}"


def chosen(walls, n):
    """Some of each kind first, as many of each, then others."""
    pick, by_kind = random.Random(4711), {}
    for kind, words in walls:
        by_kind.setdefault(kind, []).append(words)
    for of_kind in by_kind.values():
        pick.shuffle(of_kind)
    return list(dict.fromkeys(words for row in itertools.zip_longest(*by_kind.values()) for words in row if words))[:n]


def refusal_of(make, words):
    try:
        make(words)
    except lsdcd.Error as error:
        return str(error)
    return None


def text_of(line):
    """The text of the fix in the line of LAMMPS."""
    said = line and re.match(r"ERROR: Fix wall wall/lsdcd: (.*?)(?: \([^() ]*\.cpp:\d+\))?\n$", line)
    return said[1] if said else line


def is_as(fix, library):
    if fix is None or library is None:
        alone, of = (library, OF_LIBRARY_ALONE) if fix is None else (fix, OF_FIX_ALONE)
        return alone is None or any(text in alone for text in of)
    near = re.match(rf"('\S+' is not a keyword); the nearest is '({'|'.join(OF_SCRIPTS)})\b", fix)
    if near:    # which is no keyword of the library
        return library.startswith(near[1])
    for pattern, there in OF_LAMMPS:
        fix = re.sub(pattern, there, fix)
    return fix == library or library.startswith(OF_LIBRARY_ALONE)


def test_every_keyword_has_right_words():
    fact("each keyword of the table", set(RIGHT) == set(keywords()) - {"shapes"} | set(OF_SCRIPTS), set(RIGHT) ^ set(keywords()))


@needs_lmp
def test_wrong_walls(folder, monkeypatch):
    """Each says what the fix says, in check() and in Wall()."""
    walls = chosen([*wrong_keywords(), *wrong_laws()], WALLS)
    write_meshes(folder)
    (folder / "walls.json").write_text(json.dumps(walls))
    monkeypatch.setenv("OMPI_MCA_btl", "self")    # a copy of a process talks to nobody
    inputs = "variable x equal 0.5\nvariable y equal 0.25\n"
    done = run(folder, BEGIN + inputs + fix_refusals.SCRIPT.format(fix_refusals.__file__))
    assert done.returncode == 0, done.stdout[-3000:]
    monkeypatch.chdir(folder)
    said, differ, n = json.loads((folder / "said.json").read_text()), [], 0
    for words, line in zip(walls, said):
        fix, library = text_of(line), refusal_of(lsdcd.Wall, words)
        n += fix is not None
        if not is_as(fix, library):
            differ.append(f"{words}\n  fix:     {fix}\n  library: {library}")
        by_check = refusal_of(lsdcd.Wall.check, words)
        if by_check is not None and by_check != library:
            differ.append(f"{words}\n  check: {by_check}\n  wall:  {library}")
    fact("most of them are wrong", n > 0.7 * len(walls) and n >= 200, (n, len(walls)))
    fact("the library says what the fix says", not differ, f"{len(differ)} differ\n" + "\n".join(differ[:40]))
