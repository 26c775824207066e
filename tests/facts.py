# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Facts of tests: each is printed, and a test fails with all that do not hold (conftest.py)."""

failed = []


def fact(name, holds, detail=""):
    said = f"{name}: {detail}" if str(detail) else str(name)
    print("PASS" if holds else "FAIL", said)
    if not holds:
        failed.append(said)


def at_most(name, value, limit):
    fact(name, value <= limit, f"{value:.3g} (at most {limit:g})")
