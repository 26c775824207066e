# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Laws of contacts that yield, written anew from their papers, for arrays of contacts: Walton and Braun 1986, Thakur et al. 2014, Luding 2008 and
Thornton 1997. Each has `go_to(d)`, which moves contacts to overlaps d > 0 and returns their elastic forces."""
import numpy as np


class Hysteretic:
    """Loads by k1 d and unloads by k1/e^2 (d - rest), along which the contact heals."""

    def __init__(self, k1, e, n):
        self.k1, self.k2, self.rest = k1, k1 / e**2, np.zeros(n)

    def go_to(self, d):
        self.rest = np.minimum(self.rest, d)
        loads = self.k2 * (d - self.rest) > self.k1 * d
        self.rest = np.where(loads, (1 - self.k1 / self.k2) * d, self.rest)
        return np.where(loads, self.k1 * d, self.k2 * (d - self.rest))


def circle_at_wall(radius):
    return lambda d: np.sqrt(d * (2 * radius - d))


def circle_of_spheres(a, b):
    """In which two spheres of these radii cut each other, by the law of cosines."""
    def of(d):
        apart = a + b - d
        along = (apart**2 + a**2 - b**2) / (2 * apart)
        return np.sqrt(a**2 - along**2)
    return of


class Eepa:
    """circle: the radius of the circle in which the surfaces cut each other, by the overlap."""

    def __init__(self, k1, plasticity, gamma, n, chi, f0, circle, contacts):
        self.k1, self.k2, self.gamma, self.n, self.chi, self.f0, self.circle = k1, k1 / (1 - plasticity), gamma, n, chi, f0, circle
        self.plasticity, self.q, self.slope = plasticity, np.zeros(contacts), np.zeros(contacts)

    def go_to(self, d):
        powered = d**self.n
        yields = self.plasticity * powered > self.q
        self.q = np.where(yields, self.plasticity * powered, self.q)
        rest = self.q**(1 / self.n)
        pull = np.minimum(1.5 * np.pi * self.gamma * self.circle(rest), self.k2 * self.q / 2)
        self.slope = np.where(yields, pull / (self.q - pull / self.k2)**(self.chi / self.n), self.slope)
        f = self.k2 * (powered - self.q)
        branch = -self.slope * d**self.chi
        self.q = np.where(f < branch, powered - branch / self.k2, self.q)
        return self.f0 + np.maximum(f, branch)


class Lepa:
    """x: the greatest overlap; the slope of unloading is k1 + (kp - k1) x/limit. size: R at a wall, 2 Ri Rj/(Ri + Rj) of two spheres."""

    def __init__(self, k1, kp, kc, phi, size, contacts):
        self.k1, self.kp, self.kc, self.x = k1, kp, kc, np.zeros(contacts)
        self.limit = kp / (kp - k1) * phi * 2 * size

    def go_to(self, d):
        self.x = np.minimum(np.maximum(self.x, d), self.limit)
        slope = self.k1 + (self.kp - self.k1) * self.x / self.limit
        f = slope * (d - (1 - self.k1 / slope) * self.x)
        pulls = f < -self.kc * d
        root = np.sqrt(d**2 + 4 * (self.k1 + self.kc) * d * self.limit / (self.kp - self.k1))
        self.x = np.where(pulls, (d + root) / 2, self.x)
        return np.where(pulls, -self.kc * d, f)


class Thornton:
    def __init__(self, modulus, py, radius, contacts):
        self.modulus, self.py, self.radius, self.x = modulus, py, radius, np.zeros(contacts)

    def go_to(self, d):
        self.x = np.maximum(self.x, d)
        hertz = 4 / 3 * self.modulus
        limit = self.radius * (np.pi * self.py / (2 * self.modulus))**2
        f_limit = hertz * np.sqrt(self.radius) * limit**1.5
        deep = f_limit + np.pi * self.py * self.radius * (self.x - limit)
        flat = hertz / deep * ((2 * deep + f_limit) / (2 * np.pi * self.py))**1.5
        rest = self.x - (deep / (hertz * np.sqrt(flat)))**(2 / 3)
        plastic = hertz * np.sqrt(flat) * np.maximum(d - rest, 0)**1.5
        return np.where(self.x > limit, plastic, hertz * np.sqrt(self.radius) * d**1.5)
