# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The structs and functions of lsdcd.h as ctypes has them, read from the header itself, which is beside the package or in it."""
from __future__ import annotations

import ctypes
import os
import re
from typing import Any, Mapping

_KINDS = {"int": ctypes.c_int, "double": ctypes.c_double, "size_t": ctypes.c_size_t, "ptrdiff_t": ctypes.c_ssize_t}


def _pointer(kind: str) -> Any:
    return ctypes.c_char_p if kind == "const char" else ctypes.c_void_p


class Header:
    """`callbacks`: the types of function pointers, by the name of their typedef or of the member.

    structs: by the name in C, as "lsdcd_mesh_facts". functions: the kind of the result and those of the arguments."""

    def __init__(self, callbacks: Mapping[str, Any]) -> None:
        self._callbacks = callbacks
        self.structs: dict[str, Any] = {}
        text = re.sub(r"/\*.*?\*/", " ", _text(), flags=re.DOTALL)
        for name, body in re.findall(r"typedef struct (lsdcd_\w+) \{(.*?)\} \1;", text, re.DOTALL):
            fields = [field for line in body.split(";") for field in self._fields(" ".join(line.split()))]
            self.structs[name] = type(name, (ctypes.Structure,), {"_fields_": fields})
        self.functions = {name: (self._result(result), [self._argument(given) for given in arguments.split(",") if given.strip() != "void"])
                          for result, name, arguments in re.findall(r"LSDCD_API ([\w ]+\*?) ?(lsdcd_\w+)\(([^)]*)\);", text)}

    def _fields(self, line: str) -> list[tuple[str, Any]]:
        """Those of a declaration, "const double *x, y[3]"."""
        if not line:
            return []
        of_function = re.match(r"int \(\*(\w+)\)", line)
        if of_function:
            return [(of_function[1], self._callbacks[of_function[1]])]
        kind, names = re.match(r"((?:const )?\w+) (.*)", line).groups()    # type: ignore[union-attr]
        found = []
        for given in names.split(","):
            star, name, count = re.match(r" ?(\*?) ?(\w+) ?(?:\[(\d+)\])?$", given).groups()    # type: ignore[union-attr]
            one: Any = self._callbacks.get(kind) or _pointer(kind) if star else _KINDS[kind]
            found.append((name, one * int(count) if count else one))
        return found

    def _argument(self, given: str) -> Any:
        kind, stars = re.match(r"\s*((?:const )?\w+) ?((?:\*(?: ?const ?)?)*)", given).groups()    # type: ignore[union-attr]
        return _KINDS[kind] if not stars else _pointer(kind) if stars == "*" else ctypes.c_void_p

    @staticmethod
    def _result(given: str) -> Any:
        return {"int": ctypes.c_int, "void": None}.get(given.strip(), ctypes.c_char_p)


def _text() -> str:
    here = os.path.dirname(os.path.abspath(__file__))
    for folder in (here, os.path.dirname(here)):    # installed, and in the sources
        name = os.path.join(folder, "lsdcd.h")
        if os.path.exists(name):
            with open(name, encoding="utf-8") as f:
                return f.read()
    raise ImportError(f"lsdcd.h is missing beside {here}: install the package as a whole")
