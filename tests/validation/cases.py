# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""All cases, in the order of the page: modules list their cases as they are read."""

import beds
import impacts
import resting
import rolling
import yielding
from suite import CASES

ORDER = ("hertz-wall", "hertz-pair", "restitution", "bouncing", "oblique", "oblique-normal", "spinning", "spinning-pair", "slip-roll", "incline", "rolling",
         "held", "spin-down", "pressed", "held-force", "jkr", "bridge", "yielding", "yielding-pair", "janssen", "beverloo", "flat-hopper", "mill",
         "heat-pair", "heat-wall")
assert sorted(ORDER) == sorted(CASES), "a case is missing in the order of the page"
CASES = {name: CASES[name] for name in ORDER}
MODULES = (impacts, rolling, resting, yielding, beds)
