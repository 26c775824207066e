# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Distances of a few points from a mesh: distance.py WALL.stl"""
import sys

import numpy as np

import lsdcd

grid = lsdcd.Mesh(sys.argv[1]).grid(cutoff=1.0)
answer = grid.query(np.array([[0, 0, 0], [0.5, 0.5, 1.25]]), "distance triangle status")
print(*map("{:.17g}".format, answer.distance))
