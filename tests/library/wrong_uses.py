# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Wrong uses of the package: a line that ends with the code of an error has that one in mypy --strict, and raises one, and others have none."""
import numpy as np

import lsdcd

mesh = lsdcd.Mesh([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]])
grid = mesh.grid(cutoff=1)
LAW = "hooke/history 1e4 5e3 20 NULL 0.5 1"
wall = lsdcd.Wall(f"{LAW} mesh $floor motion caller", floor=mesh)
MATERIALS = "granular material glass.lsdcd glass on aluminium mesh $floor"

lsdcd.Wall(7, floor=mesh)    # arg-type
lsdcd.Wall(f"{LAW} mesh $floor", values=[mesh])    # arg-type
lsdcd.Wall(f"{LAW} mesh $floor", floor=[mesh])    # list-item
lsdcd.Wall(f"{LAW} mesh $floor", floor={"vertices": [], "faces": []})    # arg-type
lsdcd.Wall(f"{LAW} mesh $floor scale $s", floor=mesh, s={1.5})    # arg-type
lsdcd.Wall(f"{LAW} mesh $floor scale $s", floor=mesh, s=1.5j)    # arg-type
lsdcd.Wall(f"{LAW} mesh $floor scale $s", {"floor": mesh, "s": 1.5})    # arg-type
lsdcd.Wall(f"{LAW} mesh $floor", floor=mesh, device="tpu")    # arg-type
lsdcd.Wall(f"{LAW} mesh $floor", floor=mesh, periodic=1)    # arg-type
lsdcd.Wall.check(MATERIALS, floor=mesh, units="imperial")    # arg-type
lsdcd.Wall.check(f"{LAW} mesh $floor", {1: mesh})    # dict-item
wall.change("motion linear $v 0 0", v=mesh.facts)    # arg-type
wall.set_input("x")    # call-arg
wall.outputs(["forse_z"])    # list-item
wall.outputs([1])    # list-item
wall.outputs("force_z").force_z    # attr-defined
wall.totals("floor").forse    # attr-defined
wall.totals(0.5)    # arg-type
wall.set_pose("floor", postion=(0, 0, 1))    # call-arg
lsdcd.OUTPUTS["forse_z"]    # index
lsdcd.KEYWORDS["sacle"]    # index
lsdcd.KEYWORDS["scale"].syntaks    # attr-defined
mesh.grid(precision="half")    # arg-type
mesh.grid(device="tpu")    # arg-type
grid.query(np.zeros(3), threads="two")    # arg-type
grid.facts.cut_off    # attr-defined
lsdcd.Body(grid, grid)    # arg-type
