# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""A body that sinks into a wall: how many pairs of triangles meet. collide.py WALL.stl BODY.stl"""
import sys

import lsdcd

body = lsdcd.Body(lsdcd.Mesh(sys.argv[1]), lsdcd.Mesh(sys.argv[2]))
for z in (2, 1.5, 0.5):
    print(len(body.collide(position=(0, 0, z)).wall), end=" ")
print()
