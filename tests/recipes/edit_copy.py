# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Copies of source files, edited."""
import os


def write(folder, path, text):
    to = os.path.join(folder, path)
    os.makedirs(os.path.dirname(to), exist_ok=True)
    with open(to, "w", encoding="utf-8") as f:
        f.write(text)


def edit_copy(src, out, path, edits):
    """Copies src/path to out/path with each (old, new) replaced; an old text must be there once."""
    with open(os.path.join(src, path), encoding="utf-8") as f:
        text = f.read()
    for old, new in edits:
        if text.count(old) != 1:
            raise SystemExit(f"{path} does not have once: {old!r}")
        text = text.replace(old, new)
    write(out, path, text)
