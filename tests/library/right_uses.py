# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Right uses of the package: test_types gives them to mypy --strict, and runs them."""
import pathlib

import numpy as np

import lsdcd
from lsdcd import KeywordName, OutputName, Units, Value

corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]]
mesh = lsdcd.Mesh(corners, [[0, 1, 2], [0, 2, 3]])
LAW = "hooke/history 1e4 5e3 20 NULL 0.5 1"

# Values of words.
of_text: str = "1e4"
steel: list[float | None] = [1e4, 5e3, 20, None, 0.5, 1]
values: dict[str, Value] = {"floor": mesh, "steel": steel}
lsdcd.Wall.check("hooke/history $steel mesh $floor", values)
lsdcd.Wall.check("hooke/history $steel mesh $floor", floor=mesh, steel=(1e4, 5e3, 20, None, 0.5, 1))
lsdcd.Wall.check("hooke/history $steel mesh $floor", floor=mesh, steel=np.array([1e4, 5e3, 20, np.nan, 0.5, 1]))
lsdcd.Wall.check("hooke/history $kn 5e3 20 $none 0.5 $flag mesh $floor", floor=mesh, kn=of_text, none=None, flag=1)
lsdcd.Wall.check("hooke/history $kn 5e3 20 NULL $mu 1 mesh $floor", floor=mesh, kn=np.float32(1e4), mu=np.float64(0.5))
lsdcd.Wall.check(f"{LAW} mesh $file", file=pathlib.Path("floor.stl"))
lsdcd.Wall.check(f"{LAW} mesh $file", file=b"floor.stl")
of_lists = [[0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 2.0]]
table: list[Value] = [of_lists, np.array(of_lists), [[0, 0.5, 0, 0], [1, 0, 0, 1]], ((0, 0, 0, 0), (1, 0, 0, 0.5))]
for rows in table:
    lsdcd.Wall.check(f"{LAW} mesh $floor motion table $rows about 0 0 0", floor=mesh, rows=rows)
lsdcd.Wall.check(f"{LAW} mesh $floor motion table $rows about 0 0 0", floor=mesh, rows=[np.array(row) for row in of_lists])

# A wall.
units: Units = "si"
wall = lsdcd.Wall(f"{LAW} mesh $floor motion variable v_x NULL NULL v_v NULL NULL", (-2, -2, -2), (2, 2, 2), units=units, device="cpu", values={"floor": mesh})
wall.change("mesh floor motion linear $v 0 0", v=0.1)
wall.change("motion table $rows about 0 0 0", {"rows": of_lists})
x, radius, mass = np.array([[0, 0, 0.45]]), np.full(1, 0.5), np.ones(1)
v, omega, force, torque = np.zeros((4, 1, 3))
wall.step(x, v, omega, radius, mass, force, torque, 1e-3, setup=True)
pushed: float = wall.totals("floor").force[2] + wall.outputs("force_z")["force_z"]
names: list[OutputName] = ["force_z", "power"]
told: dict[str, float] = wall.outputs(names, "floor") | wall.outputs([name for name in lsdcd.OUTPUTS if name.startswith("force")], mesh=0)

# The tables.
unit, text = lsdcd.OUTPUTS["force_z"]
word: KeywordName = "scale"
row: lsdcd.Keyword = lsdcd.KEYWORDS[word]
line: str = f"{row.syntax} {row.unit} {row.range} {row.default} {row.meaning}" if row.of_mesh and row.repeats else ""
required = [name for name, keyword in lsdcd.KEYWORDS.items() if not keyword.default]

# Queries.
grid = mesh.grid(cutoff=1, precision="float", device="cpu")
answer = grid.query(np.zeros((3, 3)), "distance triangle", radius=0.5)
distance: object = answer.distance
cutoff: float = grid.facts.cutoff + mesh.facts.area
