# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Values of a program in the words of a wall, as lsdcd_value."""
from __future__ import annotations

import ctypes
import os
from typing import Any, Mapping

import numpy as np

from ._c import _HEADER, _Owner, _c_text

_Value: Any = _HEADER.structs["lsdcd_value"]
_NUMBERS, _MESH, _ROWS, _TEXT = range(4)


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
