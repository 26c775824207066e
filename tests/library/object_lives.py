# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Objects of the Python module that are copied where that is not refused, and that outlive what they are
made from: for valgrind, which sees what is freed twice or used after."""
import copy
import gc

import lsdcd

corners = [[[1, 0, 0], [0, 1, 0], [0, 0, 1]]]
mesh = lsdcd.Mesh(corners)
grid, body = mesh.grid(cutoff=0.5), lsdcd.Body(mesh, mesh)
second = lsdcd.Body(body, mesh)
for owner in (mesh, grid, body):
    try:
        copy.copy(owner)
    except TypeError:
        pass
del mesh, body, owner
gc.collect()
assert grid.query([[0.5, 0.5, 0]]).distance == 0
assert second.collide((0, 0, 0)).collides and not second.collide((5, 0, 0)).collides
