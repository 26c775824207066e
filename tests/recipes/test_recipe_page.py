# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The recipe 'Adding a normal law' of doc/design.md names the files that stiffening.py edits, and its edits are of today's sources.
test_normal_law.py builds them."""

import re
import shutil

import copied_sources
import stiffening
from facts import fact


def test_the_recipe_names_these_files_in_this_order():
    page = (copied_sources.ROOT / "doc" / "design.md").read_text()
    recipe = page.split("\n### Adding a normal law\n")[1].split("\n#")[0]
    steps = re.findall(r"^\d\. (.*(?:\n   .*)*)", recipe, re.M)
    named = [re.search(r"`([\w/]+\.\w+)`", step).group(1) for step in steps]
    fact("the first file of each step is the next of EDITS", named == list(stiffening.EDITS), named)


def test_each_edit_finds_its_place(folder):
    for name in stiffening.EDITS:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(copied_sources.ROOT / name, folder / name)
    stiffening.follow(folder)
    for name in stiffening.EDITS:
        fact(f"{name} is edited", (folder / name).read_text() != (copied_sources.ROOT / name).read_text())
