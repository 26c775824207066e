# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Converts an input script of LIGGGHTS 3.8 to one of LAMMPS: convert.py is its program. A module is a group of commands."""
