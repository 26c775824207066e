# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Data files of atoms that are the vertices of a mesh, with the bonds between them."""
import math

DIAMETER = 0.01


def data(title, atoms, bonds, kinds, bond_kinds, mass, box):
    """Text of the file. `atoms`: (number, type, (x, y, z)); `bonds`: (type, number, number); kinds: how many types there
    are; `mass` of each atom, whatever its diameter; `box`: (lo, hi) along x, y and z."""
    density = mass / (math.pi / 6 * DIAMETER ** 3)
    atoms = [f"{n} {kind} {' '.join(f'{c:.9g}' for c in place)} {DIAMETER} {density:.9g} 0" for n, kind, place in atoms]
    bonds = [f"{b} {kind} {one} {other}" for b, (kind, one, other) in enumerate(bonds, 1)]
    head = [title, "", f"{len(atoms)} atoms", f"{kinds} atom types", f"{len(bonds)} bonds", f"{bond_kinds} bond types", "",
            *(f"{lo:g} {hi:g} {axis}lo {axis}hi" for axis, (lo, hi) in zip("xyz", box))]
    return "\n".join([*head, "", "Atoms", "", *atoms, "", "Bonds", "", *bonds, ""])
