# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Cohesion that acts across a gap, written anew for arrays of contacts: Willett et al. 2000 (equations 12 and 15) in its own R', and Rocky's adhesive
forces. Each has `go_to(d)`, which moves contacts to overlaps d and returns their pulls; d < 0 is a gap."""
import numpy as np


class Bridge:
    """prime: Willett's R', 2 R at a wall and 2 Ri Rj/(Ri + Rj) of two spheres; angles in degrees, of each surface."""

    def __init__(self, tension, angles, volume, prime, contacts):
        theta = np.radians(angles)
        self.volume, self.prime, self.is_there = volume, prime, np.zeros(contacts, bool)
        self.at_touch = 2 * np.pi * prime * tension * np.mean(np.cos(theta))
        self.rupture = (1 + np.mean(theta) / 2) * (volume**(1 / 3) + volume**(2 / 3) / (10 * prime))

    def go_to(self, d):
        gap = np.maximum(-d, 0)
        self.is_there = (d > 0) | (self.is_there & (gap < self.rupture))
        p = gap / 2 * np.sqrt(self.prime / self.volume)
        return np.where(self.is_there, self.at_touch / (1 + 2.1 * p + 10 * p**2), 0)


class Constant:
    def __init__(self, force, delta):
        self.force, self.delta = force, delta

    def go_to(self, d):
        return np.where(d > -self.delta, self.force, 0)


class Linear:
    def __init__(self, stiffness, delta):
        self.stiffness, self.delta = stiffness, delta

    def go_to(self, d):
        return self.stiffness * np.maximum(d + self.delta, 0)
