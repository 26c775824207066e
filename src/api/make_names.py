#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Writes lsdcd/_names.py: the names in the library's tables as types, which type checkers and editors read.

  cmake --build build --target python_names

A test fails where the file is not that of the tables. It is kept with the sources, as a build for another processor cannot ask its library.
"""
import pathlib

FILE = pathlib.Path(__file__).resolve().parent / "lsdcd" / "_names.py"
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


if __name__ == "__main__":
    FILE.write_text(text(), encoding="utf-8")
