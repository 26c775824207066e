# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Facts of tests: each is printed, and a test fails with all that do not hold (conftest.py)."""

failed = []


def fact(name, holds, detail=""):
    print(f"{'PASS' if holds else 'FAIL'} {name}{f': {detail}' if detail != '' else ''}")
    if not holds:
        failed.append(f"{name}: {detail}" if detail != "" else name)


def at_most(name, value, limit):
    fact(name, value <= limit, f"{value:.3g} (at most {limit:g})")
