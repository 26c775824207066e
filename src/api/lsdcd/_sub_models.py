# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The formulas of contact laws: their names, numbers, units and ranges."""
from __future__ import annotations

import ctypes

from ._c import _lib, _Record, _sized, _SubModelFacts


class SubModelFacts(_Record):
    """What lsdcd_sub_model_facts says of a formula of contact laws."""
    family: str           # "style", "normal", or the word in front of its name, such as "tangential"
    name: str
    source: str           # what it is, and where its formula comes from
    beside_style: bool    # may it stand beside a classic style, or is it one? Else it goes with `granular` alone
    numbers: tuple[str, ...]              # their names
    units: tuple[str, ...]                # "1": none
    ranges: tuple[tuple[float, float], ...]
    may_be_derived: tuple[bool, ...]      # where NULL is a number


def sub_models() -> list[SubModelFacts]:
    """All formulas that this library has."""
    found: list[SubModelFacts] = []
    facts = _sized(_SubModelFacts)
    while _lib.lsdcd_sub_model_get_facts(len(found), ctypes.byref(facts)) == 0:
        each = range(facts.n)
        found.append(SubModelFacts(
            family=facts.family.decode(), name=facts.name.decode(), source=facts.source.decode(),
            beside_style=bool(facts.beside_style), numbers=tuple(facts.number[k].decode() for k in each),
            units=tuple(facts.unit[k].decode() for k in each), ranges=tuple((facts.least[k], facts.most[k]) for k in each),
            may_be_derived=tuple(bool(facts.may_be_derived[k]) for k in each)))
    return found
