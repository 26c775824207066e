#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Writes lsdcd/_names.py: the names in the library's tables as types, which type checkers and editors read; and lsdcd/_style_outputs.py:
the numbers of the other styles of LAMMPS, by the tables of their pages, which a test holds to those of the program.

  cmake --build build --target python_names

A test fails where the files are not those of the tables. They are kept with the sources, as a build for another processor cannot ask its library.
"""
import csv
import json
import pathlib

PACKAGE = pathlib.Path(__file__).resolve().parent / "lsdcd"
FILE, STYLES_FILE = PACKAGE / "_names.py", PACKAGE / "_style_outputs.py"
PAGES = PACKAGE.parent.parent.parent / "doc"
PAGE_OF = {"massflow/lsdcd": "fix_massflow_lsdcd", "insert/lsdcd": "fix_insert_lsdcd", "lsdcd/energy": "compute_lsdcd_energy",
           "lsdcd/impacts": "compute_lsdcd_impacts", "lsdcd/collide": "compute_lsdcd_collide"}
HEAD = '''# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Names in the tables of keywords and outputs. Written by make_names.py, from the library."""
from typing import Literal
'''


def literal(name, members):
    return f"\n{name} = Literal[\n" + "".join(f'    "{member}",\n' for member in members) + "]\n"


def text():
    import lsdcd    # whose library lists the names
    return HEAD + literal("KeywordName", lsdcd.KEYWORDS) + literal("OutputName", lsdcd.OUTPUTS)


STYLES_HEAD = '''# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The numbers of styles of LAMMPS beside fix wall/lsdcd, in their order: name, kind of unit, what they are. Written by make_names.py, from
the pages of the styles."""

# The last row of lsdcd/energy and lsdcd/collide is the scalar.
STYLE_OUTPUTS: dict[str, list[tuple[str, str, str]]] = {
'''


def rows_of_page(page):
    """The first table of elements on a page: a row for each number."""
    table = (PAGES / f"{page}.rst").read_text(encoding="utf-8").split(":header: element, name, what it is, units\n")[1].split("\n\n")[1]
    rows = csv.reader((line.strip() for line in table.splitlines()), skipinitialspace=True)
    return [(name, unit, meaning) for _, names, meaning, unit, *_ in rows for name in names.split(", ")]


def styles_text():
    rows = {style: "".join(f"        ({', '.join(map(json.dumps, row))}),\n" for row in rows_of_page(page)) for style, page in PAGE_OF.items()}
    return STYLES_HEAD + "".join(f'    "{style}": [\n{lines}    ],\n' for style, lines in rows.items()) + "}\n"


if __name__ == "__main__":
    FILE.write_text(text(), encoding="utf-8")
    STYLES_FILE.write_text(styles_text(), encoding="utf-8")
