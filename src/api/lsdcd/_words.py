# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The keywords of the words of a wall, and values of a program in them, as lsdcd_value."""
from __future__ import annotations

import contextlib
import ctypes
import inspect
import os
import re
from typing import Any, Callable, Iterator, Mapping, cast

import numpy as np

from ._c import _HEADER, Error, _lib, _Owner, _Record, _c_text, _sized
from ._names import KeywordName

_Value: Any = _HEADER.structs["lsdcd_value"]
_KeywordFacts: Any = _HEADER.structs["lsdcd_keyword_facts"]
_NUMBERS, _MESH, _ROWS, _TEXT = range(4)


class Keyword(_Record):
    """A keyword of a wall's words."""
    syntax: str      # "scale s | sx sy sz"
    unit: str        # "length"; "": none
    range: str       # "> 0"; "": any
    default: str     # what holds without it; "": it is required
    meaning: str
    of_mesh: bool    # is it of the mesh before it? Else of the wall
    repeats: bool    # may it be given more than once?


def _all_keywords() -> dict[KeywordName, Keyword]:
    found: dict[KeywordName, Keyword] = {}
    facts = _sized(_KeywordFacts)
    while _lib.lsdcd_keyword_get_facts(len(found), ctypes.byref(facts)) == 0:
        name, values, unit, default = (text.decode() for text in (facts.name, facts.values, facts.unit, facts.fallback))
        found[cast(KeywordName, name)] = Keyword(
            syntax=f"{name} {values}".rstrip(), unit=unit, range=facts.range.decode(), default=default, meaning=facts.meaning.decode(),
            of_mesh=bool(facts.of_mesh), repeats=bool(facts.repeats))
    return found


# Of the words of a wall, as doc/fix_wall_lsdcd.rst explains them.
KEYWORDS: dict[KeywordName, Keyword] = _all_keywords()


class Values:
    """What words name as $NAME: a Mesh; a number, or several in a row, of which None is NULL; rows of a table; a text, which may be a path. Raises
    TypeError and ValueError for something else."""

    def __init__(self, given: Mapping[str, Any], mesh: type[_Owner]) -> None:
        """`mesh`: the class of meshes."""
        self._mesh = mesh
        self.meshes: list[Any] = []
        self._kept: list[Any] = []    # what the structs point to
        self.n = len(given)
        self.structs = (_Value * self.n)(*(self._struct(name, value) for name, value in given.items()))

    def _struct(self, name: Any, value: Any) -> Any:
        made = _Value(name=_c_text(name, "the name of a value"))
        if isinstance(value, _Owner):
            if not isinstance(value, self._mesh):
                raise TypeError(f"{name} is a {type(value).__name__}, not a Mesh")
            if not value._handle:
                raise ValueError(f"{name}: its Mesh has been closed, so that no wall can be made of it")
            self.meshes.append(value)
            made.kind, made.mesh = _MESH, value._handle
        elif isinstance(value, (str, bytes, os.PathLike)):
            made.kind, made.text = _TEXT, _c_text(value, name)
        else:
            numbers = self._numbers(name, value)
            self._kept.append(numbers)
            made.kind = _ROWS if numbers.ndim == 2 else _NUMBERS
            made.numbers, made.n = numbers.ctypes.data, numbers.size
            made.columns = numbers.shape[1] if numbers.ndim == 2 else 0
        return made

    @staticmethod
    def _numbers(name: str, value: Any) -> Any:
        try:
            numbers = np.ascontiguousarray(value, np.float64)
        except (TypeError, ValueError, OverflowError):
            numbers = None
        if numbers is None or isinstance(value, bool):
            raise TypeError(f"{name} is {value!r}: give a Mesh, numbers, rows of numbers or a text")
        if np.ndim(value) > 2:
            raise ValueError(f"{name} is of shape {np.shape(value)}: give a number, (n,) numbers, or (n, columns) rows")
        return numbers


@contextlib.contextmanager
def argument_hint(function: Callable[..., Any]) -> Iterator[None]:
    """Adds to the error of a $NAME without a value that NAME is an argument of the function, and where its value goes."""
    try:
        yield
    except Error as error:
        missing = re.match(r"'[$](\w+)': there is no value of this name", str(error))
        argument = missing and inspect.signature(function).parameters.get(missing[1])
        if not missing or not argument or argument.kind is argument.VAR_KEYWORD:
            raise
        name = missing[1]
        raise Error(f"{error}; {name!r} is an argument of {function.__qualname__}(), so that its value goes into `values`: "
                    f"values={{{name!r}: ...}}", error.code) from None
