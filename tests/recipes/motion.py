#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Adds `motion cycloid Ax Ay Az period` to copies of the files that doc/design.md names, as it tells.

usage: motion.py SRC OUT     the sources, and where the copies go

In each period the mesh goes by A, and is at rest where a period begins and ends.
"""
import sys

from edit_copy import edit_copy

EDITS = {
    "motion/motion.h": [
        ("enum class MotionKind {\n  linear,\n", "enum class MotionKind {\n  linear,\n  cycloid,\n"),
        ("// length; of wiggle and cosine", "// length; of wiggle, cosine and cycloid")],
    "motion/motion.cpp": [
        ("    case MotionKind::variable:\n",
         "    case MotionKind::cycloid: {\n"
         "      sine_cosine(t, m.period, s, c);\n"
         "      const Real turns = static_cast<Real>(t / m.period);\n"
         "      shift = (turns - s / kTwoPi) * m.amplitude;\n"
         "      velocity = ((1 - c) / m.period) * m.amplitude;\n"
         "      return;\n    }\n"
         "    case MotionKind::variable:\n")],
    "input/motion_words.cpp": [
        ('"linear Vx Vy Vz | wiggle', '"linear Vx Vy Vz | cycloid Ax Ay Az period | wiggle'),
        ("{MotionKind::linear,   MotionKind::wiggle,", "{MotionKind::linear, MotionKind::cycloid, MotionKind::wiggle,"),
        ('w.choice({"linear", "wiggle",', 'w.choice({"linear", "cycloid", "wiggle",'),
        ("  if (m.kind == MotionKind::wiggle) m.amplitude",
         "  const bool has_amplitude = m.kind == MotionKind::wiggle || m.kind == MotionKind::cycloid;\n"
         "  if (has_amplitude) m.amplitude"),
        ("  if (has_period || m.kind == MotionKind::wiggle)\n", "  if (has_period || has_amplitude)\n")],
}


def main():
    src, out = sys.argv[1:]
    for path, edits in EDITS.items():
        edit_copy(src, out, path, edits)


if __name__ == "__main__":
    main()
