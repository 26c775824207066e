#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""A sphere lies on a sheet of nine nodes, each of which hangs on a spring. Velocity Verlet moves both."""
import lsdcd
import numpy as np

corners = np.array([[i - 1, j - 1, 0] for i in range(3) for j in range(3)], float)
squares = [(3 * i + j, 3 * i + j + 3, 3 * i + j + 4, 3 * i + j + 1) for i in range(2) for j in range(2)]
mesh = lsdcd.Mesh(corners, [t for a, b, c, d in squares for t in ((a, b, c), (a, c, d))])
wall = lsdcd.Wall("hooke 1000 0 5 NULL 0 0  mesh $sheet nodes caller", sheet=mesh)

rest, dt, weight, spring, node_mass = wall.nodes("sheet"), 1e-3, 10.0, 200.0, 0.1
node, speed = rest.copy(), np.zeros_like(rest)
x, radius, mass = np.array([[0.0, 0.0, 0.5]]), np.full(1, 0.5), np.full(1, 1.0)
v, omega, force, torque = np.zeros((4, 1, 3))

def step(setup=False):
    force[:] = torque[:] = 0
    wall.set_nodes("sheet", node, speed)
    wall.step(x, v, omega, radius, mass, force, torque, dt, setup=setup)
    force[:, 2] -= weight
    return wall.node_forces("sheet") - spring * (node - rest) - 5 * speed

of_nodes = step(setup=True)
for _ in range(10000):
    v += dt / 2 * force
    x += dt * v
    speed += dt / 2 * of_nodes / node_mass
    node += dt * speed
    of_nodes = step()
    v += dt / 2 * force
    speed += dt / 2 * of_nodes / node_mass
carried = -spring * (node - rest)[:, 2].sum()
print(f"the springs carry {carried:.3f}, the weight is {weight:.3f}")
if abs(carried - weight) > 1e-3 * weight:
    raise SystemExit("the sphere has not come to rest")
